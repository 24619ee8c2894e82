/* find-read.c -- the statement `find`: reads its unknowns, its conditions and its run. */
#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "lang/unknowns/find-parts.h"

#include <math.h>
#include <string.h>

#include "lang/answer/answer.h"
#include "lang/commands/set.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/runs.h"
#include "lang/session/units.h"
#include "lang/syntax/record-times.h"
#include "sim/model/simple-zeros.h"

static qdot_status carry_out_find(qdot_record *r);

QDOT_STATEMENT(find) = {
    .word = "find",
    .group = QDOT_NUMBERS,
    .usage = "find NAME = A..B, NAME = GUESS, ... such that CONDITION, returns after T, ... "
             "[run T0..T1 " QDOT_RUN_USAGE "] [as NAME]",
    .summary = "parameters, initial values and times for which conditions on a run hold, each with its error, by "
               "Newton's method with exact slopes, and bisection between bounds; `returns after T`: a periodic orbit. They "
               "hold from then on, and the run is the latest",
    .example = "find theta' = 0..5 such that value(theta, 3) = 0",
    .handler = carry_out_find,
};

static void
free_find(qdot_find *f)
{
    for (size_t i = 0; i < f->unknowns.n; i++)
        qdot_free(f->unknowns.at[i].label);
    for (; f->pushed > 0; f->pushed--)
        qdot_names_pop(f->c->session->names);
    qdot_free(f->unknowns.at);
    qdot_free(f->guess.at);
    qdot_free(f->low.at);
    qdot_free(f->high.at);
    qdot_free(f->conditions.at);
    qdot_run_options_free(&f->run);
}

/* --- reading the unknowns ---------------------------------------------------------------- */

/* Whether is(of, name) is true for one of the names that occur in the expression. */
static bool
any_name_satisfies(const qdot_compiled *program, bool (*is)(const void *of, const char *name), const void *of)
{
    uint32_t k = 0;

    for (const char *name; (name = qdot_compiled_next_name(program, &k)) != NULL;)
        if (is(of, name))
            return true;
    return false;
}

static bool
is_same_name(const void *of, const char *name)
{
    return strcmp(of, name) == 0;
}

static bool
is_event_name(const void *scene, const char *name)
{
    return qdot_scene_find_event(scene, name) != NULL;
}

/* Whether the name occurs among the conditions that follow the words `such that`. */
static bool
conditions_use_name(const qdot_record *r, const char *name)
{
    const qdot_token *such = qdot_record_word(r, "such")->from;

    for (size_t i = 0; i < r->compiled.n; i++)
        if (r->compiled.at[i].from > such && any_name_satisfies(&r->compiled.at[i], is_same_name, name))
            return true;
    return false;
}

/* Bind an undeclared name, which the conditions use as an unknown, to a new symbol. */
static qdot_status
bind_undeclared_unknown(qdot_find *f, const qdot_filled *part, const char *name, qdot_slope_name *x)
{
    qdot_session *session = f->c->session;

    *x = (qdot_slope_name){.place = part->from, .label = qdot_strdup(name)};
    x->symbol = qdot_symbol_get(session->pool, QDOT_FORMAL, name);
    if (x->label == NULL || x->symbol == QDOT_NIL)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_names_push(session->names, name, x->symbol));
    f->pushed++;
    return QDOT_OK;
}

static qdot_status
find_unknown_symbol(qdot_find *f, const qdot_filled *part, qdot_slope_name *x)
{
    const char *name;

    *x = (qdot_slope_name){.place = part->from};
    if (qdot_set_is_momentum(f->c->session, part))
        return qdot_slope_name_find(f->record, part, x);
    QDOT_TRY(qdot_record_name(f->record, part, &name));
    if (qdot_names_find(f->c->session->names, name) == NULL && part->primes == part->to && conditions_use_name(f->record, name))
        return bind_undeclared_unknown(f, part, name, x);
    QDOT_TRY(qdot_slope_name_find(f->record, part, x));
    return qdot_set_need_read(f->record, part, x->symbol);
}

static qdot_status
evaluate_bound(qdot_find *f, const qdot_filled *part, qdot_expr e, double *value)
{
    const qdot_expr x = f->unknowns.at[f->unknowns.n - 1].symbol;

    QDOT_TRY(qdot_set_check_dimension(f->record, part, x, e));
    qdot_record_blame(f->record, part);
    QDOT_TRY(qdot_session_number(f->c->session, e, value, NULL));
    return isfinite(*value) ? QDOT_OK
                            : qdot_fail(QDOT_EDOMAIN, "a guess is a finite number");
}

/* Read the bounds `A..B` of an unknown, or its `GUESS`. */
static qdot_status
read_bounds_or_guess(qdot_find *f, const qdot_filled *part)
{
    double low = -INFINITY, high = INFINITY, guess;
    qdot_expr from, to;

    if (part->n == 2) {
        QDOT_TRY(qdot_record_range(f->record, part, &from, &to));
        QDOT_TRY(evaluate_bound(f, part, from, &low));
        QDOT_TRY(evaluate_bound(f, part, to, &high));
        guess = low + (high - low) / 2;
        if (!(low < high))
            return qdot_fail(QDOT_EINVAL, "nothing lies between %.10g and %.10g", low,
                             high);
    } else {
        QDOT_TRY(qdot_record_scalar(f->record, part, &from));
        QDOT_TRY(evaluate_bound(f, part, from, &guess));
    }
    QDOT_TRY(qdot_vec_push(&f->guess, guess));
    QDOT_TRY(qdot_vec_push(&f->low, low));
    return qdot_vec_push(&f->high, high);
}

static qdot_status
read_unknowns(qdot_find *f)
{
    const qdot_filled *such = qdot_record_word(f->record, "such");

    for (const qdot_filled *part = qdot_record_hole(f->record, "find", "NAME"); part != NULL && part < such;
         part = qdot_record_next(f->record, part, "NAME")) {
        qdot_slope_name x;
        const qdot_status status = find_unknown_symbol(f, part, &x);

        QDOT_TRY(qdot_slope_names_take(f->c, &f->unknowns, &x, status));
        QDOT_TRY(read_bounds_or_guess(f, part + 2));
    }
    return QDOT_OK;
}

/* --- reading conditions and run ------------------------------------------------------------ */

/* Read the conditions, joined by `and`, that were typed for one placeholder of the usage. */
static qdot_status
read_joined_conditions(qdot_find *f, const qdot_filled *part)
{
    const qdot_compiled *sides = &f->record->compiled.at[part->first];

    for (size_t k = 0; k < part->n; k++) {
        qdot_find_condition x = {
            .from = sides[k].from, .side = {&sides[k], &sides[k]}, .returns = sides[k].is_period};

        if (x.returns)
            x.from -= 2; /* the words `returns after` */
        else
            x.side[1] = &sides[++k];
        f->returns = f->returns || x.returns;
        QDOT_TRY(qdot_vec_push(&f->conditions, x));
    }
    return QDOT_OK;
}

static qdot_status
read_conditions(qdot_find *f)
{
    const qdot_record *r = f->record;

    for (const qdot_filled *part = qdot_record_word(r, "that"); part < r->parts.at + r->parts.n; part++)
        if (qdot_filled_is(part, "CONDITION") || qdot_filled_is(part, "T"))
            QDOT_TRY(read_joined_conditions(f, part));
    return QDOT_OK;
}

/* Use the latest run, if it belongs to this scene, for the conditions of `find`. */
static qdot_status
find_latest_run(qdot_find *f)
{
    qdot_session *session = f->c->session;
    qdot_named_run *named;

    if (session->runs->n == 0)
        return QDOT_OK;
    QDOT_TRY(qdot_runs_find(session, NULL, &named));
    if (named->conditions->version != session->scene->version)
        return QDOT_OK;
    f->latest = qdot_run_get_report(named->run);
    f->latest_from = named->conditions->t0;
    f->latest_to = named->conditions->t1;
    f->run.tol = f->latest->tol;
    f->run.treatment = f->latest->treatment;
    if (f->latest->digits > 0) {
        f->run.tol = 1e-12;
        return qdot_answer_notice(session, "%s has %d digits; values that are found have the digits of a double", named->name,
                                  f->latest->digits);
    }
    f->run.method = f->latest->method;
    return QDOT_OK;
}

/* Read `run T0..T1 [options]` and `as NAME`, which stand after the conditions. */
static qdot_status
read_run_options(qdot_find *f)
{
    const qdot_filled *run = qdot_record_word(f->record, "run"), *name = qdot_record_hole(f->record, "as", "NAME"),
                      *end = f->record->parts.at + f->record->parts.n;

    if (name != NULL)
        QDOT_TRY(qdot_record_name(f->record, name, &f->run.name));
    if (run == NULL)
        return find_latest_run(f);
    f->run_at = run->from;
    QDOT_TRY(qdot_run_options_find(f->record, run + 1, end, &f->run));
    qdot_record_blame(f->record, run);
    return f->run.digits == 0 ? QDOT_OK : qdot_fail(QDOT_ENOTBUILT, "not built yet: find with `digits`");
}

/* --- time limits of the run ------------------------------------------------------------------ */

/* Find the period T in the condition `returns after T`. */
static qdot_status
evaluate_period(const qdot_find *f, const qdot_find_condition *x, qdot_expr *T)
{
    return qdot_compiled_scalar(f->c, x->side[0], T);
}

/* Bound a period that is itself an unknown by a quarter of its guess from below: with T = 0
 * everything returns. */
static qdot_status
bound_period_below(qdot_find *f)
{
    for (size_t i = 0; i < f->conditions.n; i++) {
        qdot_expr T;

        if (!f->conditions.at[i].returns)
            continue;
        QDOT_TRY(evaluate_period(f, &f->conditions.at[i], &T));
        for (size_t k = 0; k < f->unknowns.n; k++)
            if (f->unknowns.at[k].symbol == T && isinf(f->low.at[k])) {
                const double least = f->guess.at[k] / 4;

                f->low.at[k] = least > 0 ? least : -INFINITY;
                f->high.at[k] = least < 0 ? least : INFINITY;
            }
    }
    return QDOT_OK;
}

/* Whether a condition of the search contains the time of an event. */
static bool
any_condition_has_event_time(const qdot_find *f)
{
    for (size_t i = 0; i < f->conditions.n; i++)
        for (int k = 0; k < 2; k++)
            if (any_name_satisfies(f->conditions.at[i].side[k], is_event_name, f->c->session->scene))
                return true;
    return false;
}

/* Set *time to the later of *time and `other`, as seen from the time `from`; nil stands for no time. */
static qdot_status
set_to_later_time(qdot_session *session, qdot_expr from, qdot_expr *time, qdot_expr other)
{
    double t[3];

    if (other == QDOT_NIL || *time == QDOT_NIL) {
        *time = *time == QDOT_NIL ? other : *time;
        return QDOT_OK;
    }
    QDOT_TRY(qdot_session_number(session, from, &t[0], NULL));
    QDOT_TRY(qdot_session_number(session, *time, &t[1], NULL));
    QDOT_TRY(qdot_session_number(session, other, &t[2], NULL));
    if (fabs(t[2] - t[0]) > fabs(t[1] - t[0]))
        *time = other;
    return QDOT_OK;
}

qdot_status
qdot_find_limits(const qdot_find *f, qdot_expr *from, qdot_expr *to)
{
    qdot_session *session = f->c->session;

    *from = f->run_at != NULL   ? f->run.from
            : f->latest != NULL ? f->latest_from
                                : QDOT_ZERO;
    *to = f->run_at != NULL && !f->returns ? f->run.to : QDOT_NIL;
    if (*to != QDOT_NIL)
        return QDOT_OK;
    for (size_t i = 0; i < f->conditions.n; i++) {
        qdot_expr T;

        if (!f->conditions.at[i].returns)
            continue;
        QDOT_TRY(evaluate_period(f, &f->conditions.at[i], &T));
        QDOT_TRY(set_to_later_time(session, *from, to, qdot_add(session->pool, *from, T)));
    }
    if (f->returns)
        return qdot_pool_check(session->pool);
    *to = qdot_record_farthest_time(f->record, f->conditions.at[0].from, *from);
    if (f->latest != NULL && (*to == QDOT_NIL || any_condition_has_event_time(f)))
        QDOT_TRY(set_to_later_time(session, *from, to, f->latest_to));
    if (*to != QDOT_NIL)
        return QDOT_OK;
    f->c->error_at = f->conditions.at[0].from->start;
    (void)qdot_fail(QDOT_EINVAL, "the length of the run is not known");
    return qdot_hint("value(%.80s, 3) = 0, or `run 0..3` after the conditions",
                     session->scene->coordinates.n > 0
                         ? qdot_expr_symbol(session->pool, session->scene->coordinates.at[0])->name
                         : "theta");
}

/* --- reading all operands ------------------------------------------------------------------ */

static qdot_status
read_find_operands(qdot_find *f)
{
    QDOT_TRY(read_unknowns(f));
    QDOT_TRY(read_conditions(f));
    QDOT_TRY(read_run_options(f));
    return bound_period_below(f);
}

/* --- residuals of the conditions ------------------------------------------------------------- */

size_t
qdot_find_count(const qdot_find *f)
{
    size_t n = 0;

    for (size_t i = 0; i < f->conditions.n; i++)
        n += f->conditions.at[i].returns ? 2 * f->c->session->scene->coordinates.n : 1;
    return n;
}

/* Append the residuals for a return to the start: q and q' after the time T minus their initial values. */
static qdot_status
append_return_residuals(const qdot_find *f, const qdot_find_condition *x, qdot_expr from,
                        qdot_expr *e)
{
    qdot_session *session = f->c->session;
    const size_t n = session->scene->coordinates.n;
    qdot_expr T;

    QDOT_TRY(evaluate_period(f, x, &T));
    for (size_t i = 0; i < 2 * n; i++) {
        const qdot_expr jet =
            qdot_symbol_jet(session->pool, session->scene->coordinates.at[i % n], i >= n);
        qdot_expr first, last;

        QDOT_TRY(qdot_slopes_at_time(session, jet, from, &first));
        QDOT_TRY(
            qdot_slopes_at_time(session, jet, qdot_add(session->pool, from, T), &last));
        e[i] = qdot_sub(session->pool, last, first);
    }
    return qdot_pool_check(session->pool);
}

static qdot_status
evaluate_equation(const qdot_find *f, const qdot_find_condition *x, qdot_expr *e)
{
    qdot_session *session = f->c->session;
    qdot_expr side[2], touching;

    for (int i = 0; i < 2; i++)
        QDOT_TRY(qdot_compiled_value(f->c, x->side[i], &side[i]));
    f->c->error_at = x->from->start;
    for (int i = 0; i < 2; i++) {
        if (!qdot_expr_is_scalar(session->pool, side[i]))
            return qdot_fail(QDOT_ETYPE, "a condition is between numbers");
        QDOT_TRY(qdot_slopes_at_end(session, &side[i]));
    }
    if (!qdot_expr_is_constant(session->pool, side[0]) && !qdot_expr_is_constant(session->pool, side[1]))
        QDOT_TRY(qdot_units_join(session, side[0], side[1], "%s is compared with %s"));
    /* replace u^9 by u: its zero would be known only to the ninth root of a rounding error, and
     * u^1001 underflows near it */
    *e = qdot_sub(session->pool, side[0], side[1]);
    touching = qdot_touching_zeros(session->pool, *e);
    *e = qdot_simple_zeros(session->pool, touching != QDOT_NIL ? touching : *e);
    return qdot_pool_check(session->pool);
}

qdot_status
qdot_find_residuals(const qdot_find *f, qdot_expr from, qdot_expr *e)
{
    for (size_t i = 0; i < f->conditions.n; i++) {
        const qdot_find_condition *x = &f->conditions.at[i];

        f->c->error_at = x->from->start;
        if (x->returns) {
            QDOT_TRY(append_return_residuals(f, x, from, e));
            e += 2 * f->c->session->scene->coordinates.n;
            continue;
        }
        QDOT_TRY(evaluate_equation(f, x, e++));
    }
    return QDOT_OK;
}

/* --- the statement `find` -------------------------------------------------------------------- */

static qdot_status
carry_out_find(qdot_record *r)
{
    qdot_find f = {.record = r, .c = &r->cursor, .run.tol = 1e-12};
    qdot_status status = read_find_operands(&f);

    if (status == QDOT_OK)
        status = qdot_find_carry_out(&f);
    qdot_run_options_place(f.c, f.run.method_at, status);
    free_find(&f);
    return status;
}
