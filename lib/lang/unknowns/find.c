/* find.c -- the search of the statement `find`: values of unknowns for which conditions on a run hold. */
#include <math.h>
#include <string.h>

#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "lang/answer/answer.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/runs.h"
#include "lang/session/values.h"
#include "lang/unknowns/find-trial.h"
#include "num/zero.h"
#include "sim/study/floquet.h"

/* a motion whose extent is below this fraction of that of the guess is considered to have shrunk to rest */
static const double shrunk = 0.1;
/* and below this one to be at rest, where the solution of equations of first order is 1e-160 and not 0 */
static const double at_rest = 1e-9;

typedef struct {
    qdot_find *f;
    qdot_find_trial now;
    double *unit;       /* [n] units (scales) of the unknowns, if multiple shooting improved the guess */
    double *before;     /* [n] errors of the unknowns found by multiple shooting */
    double *start;      /* [start_open.n] start values that constraints may change, at the solution */
    bool bounded;       /* the unknown has bounds: bisection is possible without derivatives */
    size_t rank;        /* number of unknowns determined by multiple shooting */
    double *slope_error; /* [m x n] errors of the derivatives of the residuals by the unknowns */
    double length;      /* duration of the run at the guess */
    double reach;       /* size of the guessed orbit (sim/study/floquet.h) */
    qdot_error failure; /* the error of the latest trial that failed */
} hunt;

/* --- the start of the run ---------------------------------------------------------------------- */

static bool
is_unknown(const qdot_find *f, qdot_expr symbol)
{
    for (size_t i = 0; i < f->unknowns.n; i++)
        if (f->unknowns.at[i].symbol == symbol)
            return true;
    return false;
}

/* Where unknowns of the start and values that it names beside them leave constraints of positions (or velocities) too
 * few to solve for, those values follow: the ones nearest to what was named. */
static qdot_status
choose_open_start_values(const qdot_find *f, bool velocities)
{
    qdot_session *session = f->c->session;
    const qdot_scene *scene = session->scene;
    size_t held = 0, named = 0, before = session->values->start_open.n, open = scene->coordinates.n;
    bool some = false;

    for (size_t i = 0; i < scene->constraints.n; i++)
        held += scene->constraints.at[i].kind == QDOT_HOLONOMIC
                || (velocities && scene->constraints.at[i].kind == QDOT_VELOCITY);
    for (size_t i = 0; i < scene->coordinates.n; i++) {
        const qdot_expr q = scene->coordinates.at[i], jet = qdot_symbol_jet(session->pool, q, velocities);

        some = some || is_unknown(f, q) || is_unknown(f, jet);
        open -= is_unknown(f, jet);
        if (is_unknown(f, jet) || qdot_session_value_started(session, jet) == QDOT_NIL)
            continue;
        named++;
        QDOT_TRY(qdot_vec_push(&session->values->start_open, jet));
    }
    if (!some || open - named >= held || open > held) /* enough coordinates are free, or it is unknown which are */
        session->values->start_open.n = before;
    return QDOT_OK;
}

/* The values of open start variables in the solution's run, which are kept after `find`: numbers
 * [start_open.n]. */
static qdot_status
read_open_start_values(const hunt *h, double *numbers)
{
    const qdot_session *session = h->f->c->session;
    const double t0 = qdot_run_get_report(h->now.trial.run)->t0;

    return session->values->start_open.n == 0
               ? QDOT_OK
               : qdot_run_values(h->now.trial.run, session->values->start_open.n, session->values->start_open.at, 1,
                                 &t0, numbers, NULL);
}

static qdot_status
store_open_start_values(qdot_session *session, const double *numbers)
{
    for (size_t i = 0; i < session->values->start_open.n; i++) {
        qdot_text name = {0};
        qdot_status status = qdot_print(session->pool, session->values->start_open.at[i], QDOT_PLAIN, &name);

        if (status == QDOT_OK)
            status = qdot_session_put(session, session->values->start_open.at[i],
                                      qdot_measured_rational(session->pool, numbers[i]));
        if (status == QDOT_OK)
            status = qdot_answer_notice(session, "by the constraints %s starts at %.10g", qdot_text_str(&name),
                                        numbers[i]);
        qdot_text_clear(&name);
        QDOT_TRY(status);
    }
    session->values->start_open.n = 0;
    return qdot_pool_check(session->pool);
}

/* --- evaluating the conditions --------------------------------------------------------------- */

static qdot_status
evaluate_residuals(const double *u, double *f, double *error, double *slope, void *user)
{
    hunt *h = user;
    qdot_status status = qdot_find_trial_open(&h->now, u);

    if (status == QDOT_OK)
        status = qdot_find_trial_numbers(&h->now, f, error);
    for (size_t i = 0; i < h->now.m && status == QDOT_OK; i++)
        if (isinf(f[i])) /* an infinite value with infinite error would count as a zero */
            status = qdot_fail(QDOT_EDOMAIN, "a condition is larger than a double holds");
    if (status == QDOT_OK && slope != NULL) {
        status = qdot_find_trial_slopes(&h->now, slope, h->slope_error);
        if (h->bounded && status != QDOT_OK && qdot_grave(status) == QDOT_OK) {
            slope[0] = NAN;
            status = QDOT_OK;
        }
    }
    if (status == QDOT_OK)
        return QDOT_OK;
    qdot_find_trial_close(&h->now);
    if (qdot_trial_all_fail(status))
        return status;
    h->failure = *qdot_last_error();
    f[0] = NAN;
    return QDOT_OK;
}

static qdot_status
find_extent_of_motion(hunt *h, const double *u, double *reach, bool *rests)
{
    qdot_session *session = h->f->c->session;
    qdot_named_run *named;

    QDOT_TRY(qdot_find_trial_open(&h->now, u));
    QDOT_TRY(qdot_runs_find(session, NULL, &named));
    QDOT_TRY(qdot_floquet_reach(session->scene, named->run, reach));
    return qdot_floquet_rests(session->scene, named->run, rests);
}

/* A motion near a rest, where F is of higher order, so small that it returns within its errors. Conditions that fix all
 * unknowns are of first order. */
static bool
has_shrunk_to_rest(const hunt *h, double reach, size_t rank)
{
    return reach <= shrunk * h->reach && rank < h->f->unknowns.n && h->rank < h->f->unknowns.n;
}

/* Whether the solution is a periodic orbit, if one is wanted; a motion at rest also returns after any time. */
static qdot_status
is_wanted_orbit(const double *u, size_t rank, bool *is, void *user)
{
    hunt *h = user;
    double reach;
    bool rests;

    QDOT_TRY(find_extent_of_motion(h, u, &reach, &rests));
    *is = !rests && !has_shrunk_to_rest(h, reach, rank);
    return QDOT_OK;
}

/* --- reports of the search --------------------------------------------------------------- */

/* Append values of the unknowns, such as "theta' = 2.1, T = 3". */
static void
write_unknowns(const qdot_find *f, const double *u, int digits, qdot_text *out)
{
    for (size_t i = 0; i < f->unknowns.n; i++)
        qdot_text_format(out, "%s%s = %.*g", i > 0 ? ", " : "", f->unknowns.at[i].label, digits, u[i]);
}

static double
largest_relative_error(const hunt *h, const qdot_zero_result *r)
{
    double most = 0;

    for (size_t i = 0; i < h->now.m; i++)
        most = fmax(most, fabs(r->f[i]));
    return most;
}

static qdot_status
hint_at_improvement(const hunt *h)
{
    const char *name = h->f->unknowns.at[0].label;

    if (h->now.m > h->f->unknowns.n)
        return qdot_hint(
            "another guess; more conditions than unknowns may have no solution");
    return h->bounded
               ? qdot_hint("other bounds: find %.80s = A..B such that ...", name)
               : qdot_hint("another guess, or bounds: find %.80s = A..B such that ...",
                           name);
}

/* The index of the unknown with the largest relative error. */
static size_t
least_known_unknown(const hunt *h, const qdot_zero_result *r)
{
    size_t worst = 0;

    for (size_t j = 1; j < h->f->unknowns.n; j++)
        if (r->error[j] * fabs(r->u[worst]) > r->error[worst] * fabs(r->u[j]))
            worst = j;
    return worst;
}

/* Report why no solution was found, as an error at the conditions. */
static qdot_status
report_no_solution(const hunt *h, const qdot_zero_result *r)
{
    const char *at;
    qdot_text place = {0};
    size_t j;

    h->f->c->error_at = h->f->conditions.at[0].from->start;
    write_unknowns(h->f, r->u, r->answer == QDOT_ZERO_NONE ? 3 : 10, &place);
    at = qdot_text_str(&place);
    switch (r->answer) {
    case QDOT_ZERO_NOWHERE:
        h->f->c->error_at = h->f->unknowns.at[0].place->start;
        (void)qdot_fail(QDOT_EFAILED, "at %.150s: %.300s", at, h->failure.message);
        break;
    case QDOT_ZERO_FLAT:
        (void)qdot_fail(QDOT_EFAILED,
                        "the conditions do not change with the unknowns at %.150s, where "
                        "they are %.3g off",
                        at, largest_relative_error(h, r));
        break;
    case QDOT_ZERO_JUMP:
        (void)qdot_fail(QDOT_EFAILED,
                        "the difference of the two sides changes its sign at %.150s, and "
                        "does not vanish "
                        "there: it is %.3g",
                        at, r->f[0]);
        break;
    case QDOT_ZERO_VAGUE:
        j = least_known_unknown(h, r);
        (void)qdot_fail(QDOT_EFAILED,
                        "at %.150s the conditions hold within their errors, which leave %.80s open by %.3g", at,
                        h->f->unknowns.at[j].label, r->error[j]);
        break;
    case QDOT_ZERO_SLOW:
        (void)qdot_fail(
            QDOT_EFAILED,
            "not found after %zu steps: at %.150s the conditions are %.3g off", r->steps,
            at, largest_relative_error(h, r));
        break;
    default:
        (void)qdot_fail(
            QDOT_EFAILED,
            "no solution found: the search ended at %.150s, where the conditions are %.3g off",
            at, largest_relative_error(h, r));
        (void)hint_at_improvement(h);
    }
    qdot_text_clear(&place);
    return qdot_last_error()->status;
}

/* Give a notice that the solution is one of a family, or that others may exist between the bounds. */
static qdot_status
give_notice_of_others(const hunt *h, const qdot_zero_result *r)
{
    if (r->rank >= h->f->unknowns.n)
        return !isfinite(h->f->low.at[0]) ? QDOT_OK
                                          : qdot_answer_notice(h->f->c->session, "there may be others between the bounds: "
                                                                                 "one solution was searched for");
    if (r->vague_rank)
        return qdot_answer_notice(h->f->c->session,
                                  "perhaps one of a family: to first order the conditions fix %zu of %zu unknowns",
                                  r->rank, h->f->unknowns.n);
    return qdot_answer_notice(h->f->c->session,
                              "one of a family: the conditions fix %zu of %zu unknowns",
                              r->rank, h->f->unknowns.n);
}

/* Write a limit of the run, exactly. One that was found is a double: it is written in 17 digits at most and becomes
 * the number that these are, so that the text makes the same run again. */
static qdot_status
write_time(qdot_session *session, qdot_expr *time, qdot_text *out)
{
    qdot_pool *pool = session->pool;
    qdot_text number = {0};
    double t;

    if (qdot_expr_kind(pool, *time) == QDOT_NUM) {
        QDOT_TRY(qdot_session_number(session, *time, &t, NULL));
        if (qdot_expr_of_double(pool, t) == *time) {
            qdot_text_double(&number, fabs(t), qdot_double_digits(t, 1));
            *time = qdot_expr_decimal(pool, qdot_text_str(&number), number.n);
            *time = t < 0 ? qdot_neg(pool, *time) : *time;
            if (number.failed)
                qdot_pool_fail(pool);
            qdot_text_clear(&number);
        }
    }
    QDOT_TRY(qdot_pool_check(pool));
    return qdot_print(pool, *time, QDOT_PLAIN, out);
}

/* Write the operands with which the statement `run` would repeat the run; its limits become the numbers written. */
static qdot_status
write_run_operands(const qdot_find *f, qdot_expr *from, qdot_expr *to, qdot_text *out)
{
    QDOT_TRY(write_time(f->c->session, from, out));
    qdot_text_add(out, "..");
    QDOT_TRY(write_time(f->c->session, to, out));
    qdot_text_add(out, " tol ");
    qdot_text_double(out, f->run.tol, qdot_double_digits(f->run.tol, 1));
    if (f->run.method != NULL)
        qdot_text_format(out, " method %s", f->run.method);
    return qdot_text_status(out);
}

/* --- after the search ------------------------------------------------------------------------ */

/* Store the run for the solution as the latest run of the session. */
static qdot_status
store_solution_run(const qdot_find *f, qdot_expr from, qdot_expr to)
{
    qdot_session *session = f->c->session;
    qdot_request request = {0};
    qdot_run *run = NULL;
    qdot_text text = {0};
    char next[32];
    qdot_status status = write_run_operands(f, &from, &to, &text);

    if (status == QDOT_OK)
        status = qdot_run_options_fill(session, &f->run, from, to, &request);
    if (status == QDOT_OK)
        status = qdot_run_new(session->scene, &request.request, &run);
    if (f->run.name == NULL)
        qdot_runs_next_name(session, next, sizeof next);
    if (status == QDOT_OK)
        status = qdot_runs_keep(session, f->run.name != NULL ? f->run.name : next,
                                qdot_text_str(&text), &request.request, run);
    else
        qdot_run_free(run);
    qdot_text_clear(&text);
    qdot_request_free(&request);
    return status;
}

/* Refuse a run of duration 0, which returns to any start. */
static qdot_status
check_duration_positive(const hunt *h)
{
    double length;

    QDOT_TRY(qdot_find_trial_length(&h->now, &length));
    if (length > 1e-9 * h->length)
        return QDOT_OK;
    h->f->c->error_at = h->f->conditions.at[0].from->start;
    return qdot_fail(QDOT_EFAILED, "no orbit found: the time until the return went to 0");
}

/* Give a notice if the run of a periodic orbit ends after its period, not at the time that was given. */
static qdot_status
give_notice_of_end(const hunt *h)
{
    const qdot_find *f = h->f;
    double to, said;

    if (!f->returns || f->run_at == NULL)
        return QDOT_OK;
    QDOT_TRY(qdot_session_number(h->f->c->session, h->now.to, &to, NULL));
    QDOT_TRY(qdot_session_number(h->f->c->session, f->run.to, &said, NULL));
    if (fabs(to - said) <= 1e-9 * fabs(to))
        return QDOT_OK;
    return qdot_answer_notice(h->f->c->session, "the run ends after the return, at %.10g, not at %.10g",
                              to, said);
}

static qdot_status
report_shrunk_motion(const hunt *h, const qdot_zero_result *r)
{
    qdot_text place = {0};

    h->f->c->error_at = h->f->conditions.at[0].from->start;
    write_unknowns(h->f, r->u, 10, &place);
    (void)qdot_fail(QDOT_EFAILED, "no orbit found: from the guess the motion shrinks to an equilibrium, so far to %.150s",
                    qdot_text_str(&place));
    qdot_text_clear(&place);
    return qdot_hint("another guess, or other values of the start that stay as they are");
}

/* Set the unknowns that are declared to the values found; the run for the solution becomes the latest run. */
static qdot_status
adopt_solution(hunt *h, const qdot_zero_result *r)
{
    const qdot_find *f = h->f;
    qdot_session *session = f->c->session;
    double reach = INFINITY;
    bool rests = false;

    QDOT_TRY(qdot_find_trial_open(&h->now, r->u));
    QDOT_TRY(read_open_start_values(h, h->start));
    QDOT_TRY(check_duration_positive(h));
    QDOT_TRY(give_notice_of_end(h));
    if (f->returns)
        QDOT_TRY(find_extent_of_motion(h, r->u, &reach, &rests));
    if (!rests && has_shrunk_to_rest(h, reach, r->rank))
        return report_shrunk_motion(h, r);
    rests |= reach <= at_rest * h->reach;
    qdot_find_trial_close(&h->now);
    for (size_t i = 0; i < f->unknowns.n; i++)
        if (!qdot_expr_is_class(session->pool, f->unknowns.at[i].symbol, QDOT_FORMAL))
            QDOT_TRY(qdot_slope_names_put(session, 1, &f->unknowns.at[i], &h->now.values[i]));
    QDOT_TRY(store_open_start_values(session, h->start));
    QDOT_TRY(store_solution_run(f, h->now.from, h->now.to));
    for (size_t i = 0; i < f->unknowns.n; i++)
        QDOT_TRY(
            qdot_answer_quantity(session, f->unknowns.at[i].label, f->unknowns.at[i].symbol, r->u[i], r->error[i]));
    if (rests)
        QDOT_TRY(qdot_answer_notice(
            session, "this is an equilibrium: velocities and accelerations are 0 at the start"));
    return give_notice_of_others(h, r);
}

/* --- searching again along the motion -------------------------------------------------------- */

/* Where each unknown stands among the coordinates and velocities that must return, which are all unknown. False: they
 * are not, or more is asked for. */
static bool
find_indices_of_unknowns(const hunt *h, size_t *place)
{
    const qdot_session *session = h->f->c->session;
    const size_t n = session->scene->coordinates.n;

    if (!h->f->returns || h->now.m != 2 * n || h->f->unknowns.n != 2 * n)
        return false;
    for (size_t j = 0; j < 2 * n; j++) {
        place[j] = 0;
        while (place[j] < 2 * n &&
               h->f->unknowns.at[j].symbol != qdot_symbol_jet(session->pool,
                                                              session->scene->coordinates.at[place[j] % n],
                                                              place[j] >= n))
            place[j]++;
        if (place[j] == 2 * n)
            return false;
    }
    return true;
}

/* Where motions are damped, that of the guess may come to an orbit to which Newton's method does not lead: start anew
 * from each return, u <- u + f(u), until that moves u by a thousandth of what it did. *returns: how many; 0: it comes to none. */
static qdot_status
evaluate_returns(hunt *h, const size_t *place, double *f, double *error, double *u, size_t *returns)
{
    enum { most = 400, trend = 32 };
    const qdot_find *of = h->f;
    double first = 0, before = INFINITY;

    *returns = 0;
    for (size_t k = 0; k <= most; k++) {
        double left = 0;

        QDOT_TRY(evaluate_residuals(u, f, error, NULL, h));
        for (size_t i = 0; i < h->now.m; i++)
            left = isfinite(f[i]) ? fmax(left, fabs(f[i])) : INFINITY;
        if (k == 0)
            first = left;
        if (left <= 1e-3 * first) {
            *returns = k;
            return QDOT_OK;
        }
        if (!isfinite(left) || (k % trend == 0 && left > 0.8 * before))
            return QDOT_OK;
        before = k % trend == 0 ? left : before;
        for (size_t j = 0; j < h->f->unknowns.n; j++) {
            u[j] += f[place[j]];
            if (!(u[j] >= of->low.at[j] && u[j] <= of->high.at[j]))
                return QDOT_OK;
        }
    }
    return QDOT_OK;
}

/* After a failed search try again from the time at which the guess returns most closely; r is
 * unchanged if that does not help. */
static qdot_status
search_at_later_returns(hunt *h, const qdot_zero_problem *p, qdot_zero_result *r)
{
    const size_t n = h->f->unknowns.n;
    size_t returns = 0, *place = qdot_calloc(n, sizeof *place);
    double *room = qdot_calloc(2 * n + 2 * h->now.m, sizeof *room);
    qdot_zero_result again = {
        .u = room, .error = room + n, .f = room + 2 * n, .f_error = room + 2 * n + h->now.m};
    qdot_status status = place != NULL && room != NULL ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK && find_indices_of_unknowns(h, place)) {
        memcpy(again.u, h->f->guess.at, n * sizeof *again.u);
        status = evaluate_returns(h, place, again.f, again.f_error, again.u, &returns);
        if (status == QDOT_OK && returns > 0)
            status = qdot_zero_find(p, &again);
        if (status == QDOT_OK && returns > 0 && again.answer == QDOT_ZERO_FOUND) {
            memcpy(r->u, again.u, n * sizeof *r->u);
            memcpy(r->error, again.error, n * sizeof *r->error);
            r->answer = again.answer;
            r->rank = again.rank;
            status = qdot_answer_notice(
                h->f->c->session, "no return near the guess was found: this is the one that its motion comes to after %zu returns",
                returns);
        }
    }
    qdot_free(place);
    qdot_free(room);
    return status;
}

/* --- the whole search ---------------------------------------------------------------------- */

static qdot_status
search_solution(hunt *h, qdot_zero_result *r)
{
    const qdot_find *f = h->f;
    qdot_zero_problem p = {.n = f->unknowns.n,
                                 .m = h->now.m,
                                 .at = evaluate_residuals,
                                 .user = h,
                                 .low = f->low.at,
                                 .high = f->high.at,
                                 .slope_error = h->slope_error,
                                 .size = h->now.size};

    memcpy(r->u, f->guess.at, p.n * sizeof *r->u);
    for (size_t i = 0; i < p.n; i++)
        h->unit[i] = r->u[i] != 0 ? fabs(r->u[i]) : 1;
    QDOT_TRY(qdot_find_trial_limits(&h->now, r->u)); /* check the time limits before the first run */
    QDOT_TRY(qdot_find_trial_length(&h->now, &h->length));
    p.verify = true;
    if (f->returns) {
        qdot_shooting_result shot = {.u = r->u, .error = h->before};
        bool rests;

        QDOT_TRY(find_extent_of_motion(h, r->u, &h->reach, &rests));
        p.wanted = rests ? NULL : is_wanted_orbit;
        if (!rests)
            QDOT_TRY(qdot_find_shoot(f, &shot));
        h->rank = shot.rank;
        p.unit = shot.found ? h->unit : NULL;
        p.verify = !shot.found;
        p.once = shot.found; /* if no run can follow the orbit for a whole period, do not search from other points */
    }
    QDOT_TRY(qdot_zero_find(&p, r));
    if (r->answer != QDOT_ZERO_FOUND && !p.once)
        QDOT_TRY(search_at_later_returns(h, &p, r));
    if (r->rank < h->rank) { /* strong growth hides decaying directions from a single run: use the larger rank */
        for (size_t i = 0; i < p.n; i++)
            r->error[i] = fmax(r->error[i], h->before[i]);
        r->rank = h->rank;
    }
    return r->answer == QDOT_ZERO_FOUND ? adopt_solution(h, r) : report_no_solution(h, r);
}

qdot_status
qdot_find_carry_out(qdot_find *f)
{
    const size_t n = f->unknowns.n, m = qdot_find_count(f);
    hunt h = {.f = f,
              .now = {.f = f, .m = m},
              .bounded = n == 1 && m == 1 && isfinite(f->low.at[0])};
    double *room = qdot_calloc(5 * n + 3 * m + m * n + 2 * f->c->session->scene->coordinates.n + 1, sizeof *room);
    qdot_zero_result r = {
        .u = room, .error = room + n, .f = room + 5 * n, .f_error = room + 5 * n + m};
    qdot_status status = QDOT_ENOMEM;

    h.now.at = room + 2 * n;
    h.unit = room + 3 * n;
    h.before = room + 4 * n;
    h.now.size = room + 5 * n + 2 * m;
    h.slope_error = h.now.size + m;
    h.start = h.slope_error + m * n;
    h.now.values = qdot_calloc(n + m + 1, sizeof *h.now.values);
    if (room != NULL && h.now.values != NULL) {
        h.now.e = h.now.values + n;
        status = choose_open_start_values(f, false);
    }
    if (status == QDOT_OK)
        status = choose_open_start_values(f, true);
    if (status == QDOT_OK)
        status = search_solution(&h, &r);
    qdot_find_trial_close(&h.now);
    f->c->session->values->start_open.n = 0;
    qdot_free(h.now.values);
    qdot_free(room);
    return status;
}
