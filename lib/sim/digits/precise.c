/* precise.c -- makes a run and its companion run in MPFR, with as many digits as they need. */
#include "sim/digits/precise.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "base/process.h"
#include "base/progress.h"
#include "expr/constant.h"
#include "sim/digits/precise-course.h"
#include "sim/digits/precise-hold.h"
#include "sim/digits/precise-start.h"
#include "sim/model/constraints.h"
#include "sim/plan/cost.h"

#define RN MPFR_RNDN

/* Change that rounding to doubles may cause in a start value to be preserved, relative to max(1, |x|). */
static const double moved_by = 1e-13;

enum {
    first_digits = 19,    /* digits of the first pass, which measures how errors grow */
    guard_digits = 3,
    companion_digits = 3, /* number of extra digits that the companion run has */
    companion_orders = 5,
    guard_bits = 32,
    most_passes = 8
};

qdot_status
qdot_precise_check(const qdot_scene *scene, const qdot_run_request *request)
{
    const char *method = request->method;

    if (scene->constraints.n > 0 && request->treatment != QDOT_RUN_PROJECT) {
        qdot_fail(QDOT_EINVAL, "`digits` carries enough of them to need no treatment of drift");
        return qdot_hint("digits %d", request->digits);
    }
    if (scene->eliminated.n > 0)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: digits beside constraints and an H from which no Lagrangian follows");
    if (request->digits < 1 || request->digits > QDOT_PRECISE_MOST_DIGITS) {
        qdot_fail(QDOT_EINVAL, "%d digits cannot be asked for: 1 to %d can",
                  request->digits, QDOT_PRECISE_MOST_DIGITS);
        return qdot_hint("digits 30");
    }
    if (method && strcmp(method, "auto") != 0 && strcmp(method, "taylor") != 0) {
        qdot_fail(QDOT_EINVAL,
                  "method %.100s has no arbitrary precision: `digits` is by Taylor series",
                  method);
        return qdot_hint("method taylor");
    }
    return QDOT_OK;
}

qdot_run_request
qdot_precise_request(const qdot_run_request *request)
{
    qdot_run_request r = *request;

    r.method = "taylor";
    r.tol = 1e-15; /* tolerance of the guiding run in doubles */
    return r;
}

/* --- one run of the pair ------------------------------------------------------------- */

static void
clear_side(qdot_precise_side *s)
{
    qdot_precise_course_clear(s);
    for (size_t i = 0; i < s->n_binds; i++)
        qdot_precise_bind_free(s->binds[i]);
    qdot_free(s->binds);
    for (size_t i = 0; i < s->segments.n; i++)
        qdot_precise_run_clear(&s->segments.at[i].run);
    qdot_free(s->segments.at);
    qdot_reals_clear(&s->times);
    qdot_reals_clear(&s->start);
    qdot_free(s->y);
    *s = (qdot_precise_side){.near = SIZE_MAX};
}

/* Find a bound *log2 of the largest residual of a tape of constraints at the start, with all digits. */
static qdot_status
find_largest_residual(const qdot_precise_side *s, const qdot_plan *plan, const qdot_tape *tape, double *log2)
{
    const size_t n = 2 * plan->n;
    qdot_precise *program;

    if (!tape)
        return QDOT_OK;
    QDOT_TRY(qdot_precise_new(plan->pool, tape, 0, s->start.bits, &program));
    for (size_t i = 0; i < n; i++)
        mpfr_set(qdot_precise_input(program, i)[0], s->start.at[2 + i], RN);
    mpfr_set(qdot_precise_input(program, n)[0], s->start.at[0], RN);
    qdot_precise_order(program, 0);
    for (size_t k = 0; k < qdot_tape_outputs(tape); k++)
        *log2 = fmax(*log2, qdot_real_log2(qdot_precise_output(program, k)[0]));
    qdot_precise_free(program);
    return QDOT_OK;
}

/* Whether a start value that the user gave (position or velocity) was changed by the solution in doubles. */
static bool
has_given_value_moved(const qdot_precise_side *s, const qdot_precise_pair *pair, bool velocities)
{
    const bool *named = velocities ? pair->request->v_named : pair->request->q_named;
    const size_t first = velocities ? pair->plan->n : 0;

    for (size_t i = 0; i < pair->plan->n; i++) {
        const double given = mpfr_get_d(s->start.at[2 + first + i], RN);

        if ((!named || named[i])
            && !(fabs(pair->settled[first + i] - given) <= moved_by * fmax(1, fabs(given))))
            return true;
    }
    return false;
}

/* Find the positions (or velocities) on the constraints nearest to those found in doubles. */
static qdot_status
find_nearest_start(const qdot_precise_side *s, const qdot_precise_pair *pair, qdot_precise_hold *hold,
                   bool velocities)
{
    const qdot_plan *plan = pair->plan;
    const bool *named = velocities ? pair->request->v_named : pair->request->q_named;
    const double *near = pair->settled + (velocities ? plan->n : 0);
    bool *free = qdot_calloc(plan->n + 1, sizeof *free);
    bool any = false;
    qdot_status status = free ? QDOT_EDOMAIN : QDOT_ENOMEM;

    for (size_t i = 0; free && i < plan->n; i++)
        any = (free[i] = named && !named[i]) || any;
    if (free && any && !has_given_value_moved(s, pair, velocities))
        status = qdot_precise_hold_nearest(hold, s->start.at[0], s->start.at + 2, velocities,
                                           free, false, near);
    for (size_t i = 0; free && i < plan->n; i++)
        free[i] = true;
    if (status == QDOT_EDOMAIN)
        status = qdot_precise_hold_nearest(hold, s->start.at[0], s->start.at + 2, velocities,
                                           free, true, near);
    qdot_free(free);
    return status == QDOT_EDOMAIN ? QDOT_OK : status; /* undefined values are no failure: the caller checks the constraints */
}

/* Bring the start onto the constraints in all digits. Values that these determine are solved for;
 * else the nearest start is found, as in doubles. */
static qdot_status
precise_settle_start(const qdot_precise_side *s, const qdot_precise_pair *pair, int digits)
{
    const qdot_plan *plan = pair->plan;
    const double enough = -(digits + guard_digits) * QDOT_LOG2_10;
    qdot_precise_hold *hold = NULL;
    double log2 = -INFINITY;
    qdot_status status = QDOT_OK;

    if (!plan->constraints)
        return QDOT_OK;
    QDOT_TRY(qdot_precise_start_solve(plan, pair->request, pair->settled, enough, s->start.bits,
                                      s->start.at));
    for (size_t k = 0; k < 2 && status == QDOT_OK; k++) {
        const qdot_tape *tape =
            k == 0 ? plan->constraints->positions : plan->constraints->velocities;

        log2 = -INFINITY;
        status = find_largest_residual(s, plan, tape, &log2);
        if (status != QDOT_OK || log2 <= enough)
            continue;
        if (!hold)
            status = qdot_precise_hold_new(plan, s->start.bits, &hold);
        if (status == QDOT_OK)
            status = find_nearest_start(s, pair, hold, k == 1);
        log2 = -INFINITY;
        if (status == QDOT_OK)
            status = find_largest_residual(s, plan, tape, &log2);
        if (status == QDOT_OK && !(log2 <= enough))
            break;
    }
    qdot_precise_hold_free(hold);
    QDOT_TRY(status);
    if (log2 <= enough)
        return QDOT_OK;
    qdot_fail(QDOT_EINVAL, "the start breaks constraints that depend on each other, which "
                           "`digits` cannot mend");
    return qdot_hint("start with every value exact, as x = sin(2), y = -cos(2)");
}

/* Prepare one run with `digits`: all that needs the pool of expressions, which threads must not share. */
static qdot_status
prepare_side(qdot_precise_side *s, const qdot_precise_pair *pair, double digits, int orders_more)
{
    const qdot_run_request *request = pair->request;
    const size_t n = pair->plan->n;
    mpfr_prec_t bits = (mpfr_prec_t)ceil(digits * QDOT_LOG2_10) + guard_bits;
    double cost[3];
    size_t modes;

    clear_side(s);
    s->digits = digits;
    s->log2_tol = -digits * QDOT_LOG2_10;
    s->guide = pair->guide;
    modes = s->guide ? s->guide->stage->modes.n : 1;
    s->binds = qdot_calloc(modes, sizeof *s->binds);
    if (!s->binds)
        return QDOT_ENOMEM;
    s->n_binds = modes;
    qdot_cost_precise(pair->plan, bits, cost);
    s->order = qdot_precise_order_for(-digits * QDOT_LOG2_10, cost) + orders_more;
    QDOT_TRY(qdot_precise_bind_new(pair->plan, s->order, bits, &s->binds[0]));
    QDOT_TRY(qdot_reals_init(&s->start, 2 + 2 * n, bits));
    s->y = qdot_calloc(2 * n, sizeof *s->y);
    if (!s->y)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_precise_constant(pair->plan, request->t0, s->start.at[0]));
    QDOT_TRY(qdot_precise_constant(pair->plan, request->t1, s->start.at[1]));
    for (size_t i = 0; i < n; i++) {
        QDOT_TRY(qdot_precise_constant(pair->plan, request->q0[i], s->start.at[2 + i]));
        QDOT_TRY(qdot_precise_constant(pair->plan, request->v0[i], s->start.at[2 + n + i]));
    }
    QDOT_TRY(precise_settle_start(s, pair, (int)fmin(digits - guard_digits, pair->digits)));
    return s->guide ? qdot_precise_course_init(s) : QDOT_OK;
}

/* Called after each step: stop if a coordinate has left its domain. */
static qdot_status
stop_outside_domain(mpfr_srcptr t, const mpfr_t *y, bool *stop, void *user)
{
    qdot_precise_side *s = user;

    (void)t;
    for (size_t i = 0; i < s->segments.at[0].run.n; i++)
        s->y[i] = mpfr_get_d(y[i], RN);
    return qdot_domains_watch(0, s->y, stop, s->domains);
}

static void
integrate_side(qdot_precise_side *s)
{
    qdot_precise_options options = {.log2_tol = s->log2_tol, .order = s->order};
    qdot_precise_run *run;

    s->near = SIZE_MAX;
    if (s->guide) {
        qdot_precise_course_run(s);
        return;
    }
    if (s->domains && s->domains->n > 0) {
        s->domains->left = NULL;
        options.accepted = stop_outside_domain;
        options.user = s;
    }
    s->status = qdot_vec_push(&s->segments, (qdot_precise_segment){0});
    if (s->status != QDOT_OK)
        return;
    run = &s->segments.at[0].run;
    s->status = qdot_precise_integrate(qdot_precise_bind_system(s->binds[0]), &options,
                                       s->start.at[0], s->start.at[1],
                                       (const mpfr_t *)s->start.at + 2, run);
    s->result = run->result;
}

static void *
side_thread(void *user)
{
    qdot_precise_side *s = user;

    qdot_interrupt_own = s->interrupt;
    integrate_side(s);
    mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE);
    return NULL;
}

/* Whether a run that ended with this status keeps the points computed so far. */
static bool
run_is_kept(qdot_status status)
{
    return status == QDOT_OK || status == QDOT_EFAILED || status == QDOT_EDOMAIN
           || status == QDOT_ESINGULAR;
}

/* Whether a run of the pair (the run or its companion run) has any points. */
static bool
has_points(const qdot_precise_side *s)
{
    return s->segments.n > 0 && s->segments.at[s->segments.n - 1].run.count > 0;
}

/* If the last step ended outside the domain of a coordinate, shorten it to the last double of t inside. */
static qdot_status
cut_at_domain(qdot_precise_side *s)
{
    qdot_precise_run *run = &s->segments.at[0].run;
    const size_t last = run->count - 1, n = run->n;
    qdot_reals w;
    mpfr_t *inside, *outside, *middle, *y;
    qdot_status status = qdot_reals_init(&w, 3 + 2 * n, s->start.bits);

    QDOT_TRY(status);
    inside = w.at, outside = w.at + 1, middle = w.at + 2, y = w.at + 3;
    mpfr_set(*inside, qdot_precise_point(run, last - 1)[0], RN);
    mpfr_set(*outside, qdot_precise_point(run, last)[0], RN);
    for (int k = 0; k < 64 && status == QDOT_OK; k++) {
        mpfr_add(*middle, *inside, *outside, RN);
        mpfr_div_2ui(*middle, *middle, 1, RN);
        status = qdot_precise_state(s, *middle, y);
        for (size_t i = 0; i < n; i++)
            s->y[i] = mpfr_get_d(y[i], RN);
        mpfr_set(qdot_domains_outside(s->domains, s->y) ? *outside : *inside, *middle, RN);
    }
    if (status == QDOT_OK)
        status = qdot_precise_state(s, *inside, y);
    if (status == QDOT_OK)
        qdot_precise_cut(run, *inside, (const mpfr_t *)y);
    s->result.t = run->result.t;
    qdot_reals_clear(&w);
    return status;
}

/* --- run and companion --------------------------------------------------------------- */

/* Carry out both runs of the pair with `digits` and compare them. QDOT_OK if there is a run, even
 * an incomplete one. */
static qdot_status
integrate_pair(qdot_precise_pair *pair, double digits, qdot_domains *domains)
{
    qdot_precise_side *a = &pair->run, *b = &pair->companion;
    pthread_t thread;
    bool running;

    pair->log10_error = NAN;
    QDOT_TRY(prepare_side(a, pair, digits, 0));
    QDOT_TRY(prepare_side(b, pair, digits + companion_digits, companion_orders));
    a->domains = domains;
    qdot_progress_begin(mpfr_get_d(a->start.at[0], RN), mpfr_get_d(a->start.at[1], RN),
                        "run in %.0f digits", digits);
    b->interrupt = qdot_interrupt_own;
    running = QDOT_MAY_THREAD && pthread_create(&thread, NULL, side_thread, b) == 0;
    integrate_side(a);
    if (running)
        pthread_join(thread, NULL);
    else
        integrate_side(b);
    if (!run_is_kept(a->status))
        return a->status;
    if (!a->guide && domains->left)
        QDOT_TRY(cut_at_domain(a));
    if (has_points(a) && has_points(b))
        QDOT_TRY(qdot_precise_compare(pair));
    return b->status == QDOT_EINTR || b->status == QDOT_ENOMEM ? b->status : QDOT_OK;
}

/* The number of digits with which both runs must be repeated; 0: the result is accurate enough. */
static double
digits_needed(const qdot_precise_pair *pair)
{
    const double wanted = -pair->digits - log10(2);
    double digits = pair->run.digits, more;

    if (isnan(pair->log10_error)) /* the run failed before its end, so nothing tells how many digits are needed */
        return digits >= pair->digits + 2 * guard_digits
                   ? 0
                   : pair->digits + 2 * guard_digits;
    if (pair->log10_error <= wanted)
        return 0;
    /* run and companion run differ entirely: not even the growth of errors is known */
    if (pair->log10_error > qdot_precise_parted)
        return fmax(2 * digits, pair->digits + guard_digits);
    more = pair->digits + guard_digits + (pair->log10_error + digits);
    return fmax(more, digits + guard_digits);
}

static qdot_status
repeat_until_accurate(qdot_precise_pair *pair, qdot_domains *domains)
{
    qdot_precise_progress progress = {.t = NAN};
    double digits = first_digits;

    for (int passes = 0; digits > 0;) {
        if (passes == most_passes)
            return qdot_fail(QDOT_EFAILED,
                             "%d digits were not reached: carrying %.0f left an error of "
                             "10^%.1f",
                             pair->digits, pair->run.digits, pair->log10_error);
        QDOT_TRY(integrate_pair(pair, digits, domains));
        QDOT_TRY(qdot_precise_check_progress(pair, &progress));
        /* double the digits while the runs still separate; such attempts do not count as passes */
        if (!(pair->log10_error > qdot_precise_parted))
            passes++;
        digits = digits_needed(pair);
        if (digits > 4 * QDOT_PRECISE_MOST_DIGITS)
            return qdot_fail(QDOT_ELIMIT,
                             "the scene amplifies errors beyond what %d digits hold",
                             4 * QDOT_PRECISE_MOST_DIGITS);
    }
    return QDOT_OK;
}

qdot_status
qdot_precise_pair_new(const qdot_plan *plan, const qdot_run_request *request,
                      const double *start, qdot_domains *domains, const qdot_course *guide,
                      qdot_precise_pair **out)
{
    qdot_precise_pair *pair = qdot_calloc(1, sizeof *pair);
    qdot_status status;

    *out = NULL;
    if (!pair)
        return QDOT_ENOMEM;
    pair->plan = plan;
    pair->n = 2 * plan->n;
    pair->digits = request->digits;
    pair->request = request;
    pair->guide = guide;
    pair->settled = start;
    status = repeat_until_accurate(pair, domains);
    pair->request = NULL;
    pair->settled = NULL;
    if (status == QDOT_EINTR && has_points(&pair->run))
        pair->log10_error = NAN; /* the run may have been interrupted before it had enough digits */
    else if (status != QDOT_OK) {
        qdot_precise_pair_free(pair);
        return status;
    }
    *out = pair;
    return status;
}

void
qdot_precise_pair_free(qdot_precise_pair *pair)
{
    if (!pair)
        return;
    clear_side(&pair->run);
    clear_side(&pair->companion);
    qdot_free(pair);
}

/* --- results of the pair ------------------------------------------------------------- */

const qdot_ode_result *
qdot_precise_pair_result(const qdot_precise_pair *pair)
{
    return &pair->run.result;
}

double
qdot_precise_pair_error(const qdot_precise_pair *pair)
{
    return qdot_precise_power(pair->log10_error);
}

double
qdot_precise_pair_tol(const qdot_precise_pair *pair)
{
    return qdot_precise_power(-pair->run.digits);
}

size_t
qdot_precise_pair_factored(const qdot_precise_pair *pair)
{
    size_t sum = 0;

    for (size_t i = 0; i < pair->run.n_binds; i++)
        if (pair->run.binds[i])
            sum += qdot_precise_bind_factored(pair->run.binds[i]);
    return sum;
}

qdot_expr
qdot_precise_pair_end(const qdot_precise_pair *pair, size_t i)
{
    return qdot_constant_of_real(pair->plan->pool, qdot_precise_last(&pair->run)[1 + i]);
}

qdot_expr
qdot_precise_pair_time(const qdot_precise_pair *pair, size_t i, double *error)
{
    const qdot_precise_side *a = &pair->run, *b = &pair->companion;
    qdot_reals w;

    *error = NAN;
    if (i >= a->times.n || i >= b->times.n || !mpfr_number_p(a->times.at[i])
        || qdot_reals_init(&w, 1, b->start.bits) != QDOT_OK)
        return QDOT_NIL;
    mpfr_sub(w.at[0], a->times.at[i], b->times.at[i], RN);
    if (mpfr_number_p(w.at[0]))
        *error = qdot_precise_power(fmax(qdot_real_log2(w.at[0]) / QDOT_LOG2_10,
                                         fmax(0, qdot_real_log2(a->times.at[i])) / QDOT_LOG2_10
                                             - a->digits));
    qdot_reals_clear(&w);
    return qdot_constant_of_real(pair->plan->pool, a->times.at[i]);
}

/* Append a point to the trajectory in doubles if its time lies after that of the last point, up to t_end. */
static qdot_status
append_point(qdot_trajectory *tr, bool first, double t, double t_end, const double *y)
{
    if (!first && tr->count > 0
        && !((t_end - t) * (t - tr->t[tr->count - 1]) >= 0 && t != tr->t[tr->count - 1]))
        return QDOT_OK;
    QDOT_TRY(qdot_grow(&tr->t, &tr->t_capacity, tr->count + 1, sizeof *tr->t));
    QDOT_TRY(qdot_grow(&tr->y, &tr->y_capacity, (tr->count + 1) * tr->n, sizeof *tr->y));
    tr->t[tr->count] = t;
    memcpy(tr->y + tr->count * tr->n, y, tr->n * sizeof *y);
    tr->count++;
    return QDOT_OK;
}

static qdot_status
sample_segment(const qdot_precise_pair *pair, const qdot_precise_segment *segment,
               qdot_trajectory *tr)
{
    const qdot_precise_run *run = &segment->run;
    const double t_end = mpfr_get_d(qdot_precise_point(run, run->count - 1)[0], RN);
    double *y = pair->run.y;

    QDOT_TRY(qdot_vec_push(&tr->pieces,
                           ((qdot_trajectory_piece){tr->count, segment->mode,
                                                    segment->jumped})));
    for (size_t k = 0; k < run->count; k++) {
        const mpfr_t *point = (const mpfr_t *)qdot_precise_point(run, k);

        for (size_t i = 0; k > 0 && i < QDOT_PRECISE_INSIDE; i++) {
            const double *row = qdot_precise_inside(run, k - 1) + i * (pair->n + 1);

            QDOT_TRY(append_point(tr, false, row[0], t_end, row + 1));
        }
        for (size_t i = 0; i < pair->n; i++)
            y[i] = mpfr_get_d(point[1 + i], RN);
        QDOT_TRY(append_point(tr, k == 0, mpfr_get_d(point[0], RN), t_end, y));
    }
    return QDOT_OK;
}

qdot_status
qdot_precise_pair_sample(const qdot_precise_pair *pair, qdot_trajectory *tr)
{
    const qdot_precise_side *s = &pair->run;

    qdot_trajectory_clear(tr);
    tr->n = pair->n;
    tr->method = pair->plan->method;
    tr->tol = 1e-15;
    tr->result = s->result;
    for (size_t k = 0; k < s->segments.n; k++)
        if (s->segments.at[k].run.count > 0)
            QDOT_TRY(sample_segment(pair, &s->segments.at[k], tr));
    return QDOT_OK;
}
