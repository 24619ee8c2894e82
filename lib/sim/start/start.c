/* start.c -- decides which start values are kept, solves for the others, and describes the result. */
#include "sim/start/start.h"

#include <math.h>
#include <string.h>

#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/integrated.h"
#include "mech/hamilton/phase-symbols.h"
#include "num/row-space.h"
#include "sim/model/constraints.h"
#include "sim/model/delay.h"
#include "sim/start/nearest.h"

static const double breaks = 1e-14; /* a constraint is violated beyond this error, relative to max(1, |x|) */

enum { MOST_LISTED = 24, MOST_ANSWERED = 4 };

/* A level of a start state, positions or velocities, with the equations that restrict it. */
typedef struct {
    qdot_scene *scene;
    const qdot_plan *plan;
    const qdot_run_request *request;
    bool velocities;
    bool massless;   /* the equations of coordinates without mass, which move alone; else the
                        scene's constraints */
    enum { NOT_ELIMINATED, POSITIONS, MOMENTA } eliminated; /* the constraints that the forces keep, on positions or momenta; no others */
    size_t n;
    size_t m;
    qdot_expr *F;        /* [m] left sides of the equations */
    size_t *constraint;  /* [m] index of the constraint to which each F belongs */
    double *distance;    /* [m] violation |F| at the requested start */
    bool *free;          /* [n] whether the solution may change the value */
    qdot_nearest near;
    const double *before; /* [2n] the start state as requested */
    const qdot_given *given;
} level;

/* --- the equations of a level ------------------------------------------------------- */

/* Constraint k: first those of the scene as declared, then equations of the plan (massless coordinates). */
static qdot_constraints_row
constraint_at(const level *l, size_t k)
{
    const qdot_constraint *of_scene = l->scene->constraints.at + k;

    qdot_expr mu;

    return l->eliminated
               ? (qdot_constraints_row){of_scene->name, QDOT_HOLONOMIC, of_scene->f, of_scene->multiplier}
           : k < l->scene->constraints.n
               ? (qdot_constraints_row){of_scene->name, of_scene->kind,
                                        qdot_integrated_rate(l->scene, k, &mu),
                                        of_scene->multiplier}
               : l->plan->constraints->rows[k];
}

static qdot_status
append_equation(level *l, size_t k, qdot_expr F)
{
    qdot_expr t = QDOT_T;

    F = qdot_plan_substitute(l->plan, F);
    if (F != QDOT_NIL && l->plan->delayed)
        F = qdot_delay_at_start(l->plan->pool, F);
    QDOT_TRY(qdot_pool_check(l->plan->pool));
    F = qdot_subs(l->plan->pool, F, 1, &t, &l->request->t0);
    QDOT_TRY(qdot_pool_check(l->plan->pool));
    l->F[l->m] = F;
    l->constraint[l->m++] = k;
    return QDOT_OK;
}

static qdot_status
append_eliminated(level *l)
{
    for (size_t k = 0; k < l->scene->eliminated.n; k++) {
        const qdot_eliminated *x = &l->scene->eliminated.at[k];
        const qdot_expr F = l->eliminated == MOMENTA ? x->rate : x->position;

        if (F != QDOT_NIL)
            QDOT_TRY(append_equation(l, k, F));
    }
    return QDOT_OK;
}

static qdot_status
begin_level(level *l)
{
    const qdot_scene *scene = l->scene;
    size_t c = scene->constraints.n + l->plan->n_massless + scene->eliminated.n;

    l->F = qdot_calloc(c + 1, sizeof *l->F);
    l->constraint = qdot_calloc(c + 1, sizeof *l->constraint);
    l->distance = qdot_calloc(c + 1, sizeof *l->distance);
    l->free = qdot_calloc(l->n + 1, sizeof *l->free);
    if (!l->F || !l->constraint || !l->distance || !l->free)
        return QDOT_ENOMEM;
    if (l->eliminated)
        return append_eliminated(l);
    for (size_t k = 0; k < scene->constraints.n + l->plan->n_massless; k++) {
        const qdot_constraints_row row = constraint_at(l, k);

        if (l->massless != (k >= scene->constraints.n))
            continue;
        if (row.kind == QDOT_HOLONOMIC)
            QDOT_TRY(append_equation(l, k, l->velocities ? qdot_ddt(scene->pool, row.f) : row.f));
        else if (row.kind == QDOT_VELOCITY && l->velocities)
            QDOT_TRY(append_equation(l, k, row.f));
    }
    return QDOT_OK;
}

static void
clear_level(level *l)
{
    qdot_free(l->F);
    qdot_free(l->constraint);
    qdot_free(l->distance);
    qdot_free(l->free);
}

/* Whether coordinate i belongs to this level; massless coordinates and others have separate levels. */
static bool
belongs_to_level(const level *l, size_t i)
{
    if (l->eliminated)
        return (qdot_phase_space_momentum(l->scene, l->plan->inputs[i]) != QDOT_NIL) == (l->eliminated == MOMENTA);
    return l->massless == (l->plan->massless && l->plan->massless[i]);
}

/* Whether i is a coordinate of this level and not a parameter that events set. */
static bool
is_coordinate_of_level(const level *l, size_t i)
{
    return i < l->n - l->plan->n_states && belongs_to_level(l, i);
}

/* Set up the search for the nearest solution of the equations F [m]. */
static qdot_nearest
prepare_search(const level *l, size_t m, const qdot_expr *F, const qdot_domains *domains)
{
    return (qdot_nearest){.pool = l->plan->pool,
                          .inputs = 2 * l->n,
                          .symbol = l->plan->inputs,
                          .first = l->velocities ? l->n : 0,
                          .n = l->n,
                          .m = m,
                          .F = F,
                          .given = l->given,
                          .domains = l->velocities ? NULL : domains};
}

/* --- words of messages -------------------------------------------------------------- */

static void
print_unknown_name(const level *l, size_t i, qdot_text *out)
{
    qdot_text_format(out, "%s%s", l->plan->names[i], l->velocities ? "'" : "");
}

/* Append a list such as "constraint rod" or "constraints a, pin[2] and b". */
static void
print_constraints(const level *l, const bool *which, qdot_text *out)
{
    size_t count = 0, done = 0;

    for (size_t k = 0; k < l->m; k++)
        count += which[k];
    qdot_text_add(out, l->massless ? "the " : count == 1 ? "constraint " : "constraints ");
    for (size_t k = 0; k < l->m; k++) {
        const char *name = constraint_at(l, l->constraint[k]).name;
        const char *comma = strchr(name, ',');

        if (!which[k])
            continue;
        if (done > 0)
            qdot_text_add(out, done + 1 == count ? " and " : ", ");
        done++;
        if (comma)
            qdot_text_format(out, "%.*s[%s]", (int)(comma - name), name,
                             comma + 1 + strspn(comma + 1, " "));
        else
            qdot_text_add(out, name);
    }
}

static qdot_status
print_violated_constraints(const level *l, qdot_text *out)
{
    bool *which = qdot_calloc(l->m + 1, sizeof *which);

    if (!which)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < l->m; k++)
        which[k] = !(l->distance[k] <= breaks);
    print_constraints(l, which, out);
    qdot_free(which);
    return QDOT_OK;
}

/* Fail with the message `text`, whose memory is freed. */
static qdot_status
fail_with_text(qdot_text *text, qdot_status built)
{
    if (built == QDOT_OK)
        built = qdot_text_status(text);
    if (built == QDOT_OK)
        built = qdot_fail(QDOT_EINVAL, "%s", qdot_text_str(text));
    qdot_text_clear(text);
    return built;
}

static qdot_status
fail_no_solution(const level *l, const double *residual)
{
    qdot_constraints_row row;
    qdot_text text = {0};
    qdot_status status;
    size_t worst = 0, broken = 0;

    for (size_t k = 1; k < l->m; k++)
        if (!(l->distance[k] <= l->distance[worst]))
            worst = k;
    row = constraint_at(l, l->constraint[worst]);
    qdot_text_add(&text, "the start breaks ");
    status = print_violated_constraints(l, &text);
    for (size_t k = 0; k < l->m; k++)
        broken += !(l->distance[k] <= breaks);
    qdot_text_add(&text, (l->velocities && row.kind == QDOT_HOLONOMIC) || l->eliminated == MOMENTA
                             ? ": the rate of left - right"
                             : ": left - right");
    if (broken > 1)
        qdot_text_format(&text, " of %.100s", row.name);
    qdot_text_format(&text, " is %.6g, not 0", residual[worst]);
    status = fail_with_text(&text, status);
    return status == QDOT_EINVAL
               ? qdot_hint("without `exactly` the start is moved onto the constraints")
               : status;
}

/* Append the values of a solution x that differ from those of another one, as "x = 1, y = 0". */
static void
print_differing_values(const level *l, const double *x, const double *other, qdot_text *out)
{
    size_t listed = 0;

    for (size_t i = 0; i < l->n; i++) {
        if (!(fabs(x[i] - other[i]) > 1e-6 * (1 + fabs(x[i]))))
            continue;
        if (listed == MOST_ANSWERED) {
            qdot_text_add(out, " ...");
            return;
        }
        qdot_text_add(out, listed++ > 0 ? ", " : " ");
        print_unknown_name(l, i, out);
        qdot_text_format(out, " = %.6g", x[i]);
    }
}

static qdot_status
fail_several_solutions(const level *l, const double *at, const double *other, bool all)
{
    const double *x = at + (l->velocities ? l->n : 0);
    qdot_text text = {0}, name = {0};
    qdot_status status = QDOT_OK;
    size_t i = 0;

    for (size_t j = 1; j < l->n; j++)
        if (fabs(x[j] - other[j]) > fabs(x[i] - other[i]))
            i = j;
    print_unknown_name(l, i, &name);
    status = qdot_text_status(&name);
    qdot_text_add(&text, "the start breaks ");
    if (status == QDOT_OK)
        status = print_violated_constraints(l, &text);
    qdot_text_add(&text, ", and two answers are equally near:");
    print_differing_values(l, x, other, &text);
    qdot_text_add(&text, " and");
    print_differing_values(l, other, x, &text);
    status = fail_with_text(&text, status);
    if (status == QDOT_EINVAL)
        status = all ? qdot_hint("start %s = ...: a value nearer to one of them",
                                 qdot_text_str(&name))
                     : qdot_hint("name one more value: start %s = %.6g",
                                 qdot_text_str(&name), x[i]);
    qdot_text_clear(&name);
    return status;
}

static qdot_status
add_notice_of_moves(const level *l, const double *at, qdot_text *notice)
{
    size_t first = l->velocities ? l->n : 0, listed = 0, left = 0;
    double most = 0;

    if (notice->n > 0)
        qdot_text_add(notice, "\n");
    qdot_text_add(notice, "the start breaks ");
    QDOT_TRY(print_violated_constraints(l, notice));
    qdot_text_add(notice, l->massless || l->eliminated ? "; moved:" : "; moved least, in the metric of M:");
    for (size_t i = 0; i < l->n; i++) {
        double from = l->before[first + i], by = at[first + i] - from;

        if (!(fabs(by) > breaks * fmax(1, fabs(from))) || (l->eliminated && !belongs_to_level(l, i)))
            continue;
        if (listed == MOST_LISTED) {
            left++;
            most = fmax(most, fabs(by));
            continue;
        }
        qdot_text_add(notice, listed++ > 0 ? ", " : " ");
        print_unknown_name(l, i, notice);
        qdot_text_format(notice, " from %.12g to %.12g (by %.3g)", from, at[first + i],
                         by);
    }
    if (left > 0)
        qdot_text_format(notice, ", and %zu more, at most by %.3g", left, most);
    return qdot_text_status(notice);
}

/* --- contradictory equations -------------------------------------------------------- */

/* Whether the equations marked in `kept` have a common solution within the domains of the coordinates. */
static qdot_status
have_common_solution(const level *l, const bool *kept, const qdot_domains *domains,
                     const double *start, bool *can)
{
    size_t m = 0;
    qdot_expr *F = qdot_calloc(l->m + 1, sizeof *F);
    double *at = qdot_calloc(3 * l->n + 1, sizeof *at);
    qdot_nearest_outcome outcome = QDOT_NEAREST_FOUND;
    qdot_nearest near;
    qdot_status status = F && at ? QDOT_OK : QDOT_ENOMEM;

    for (size_t k = 0; k < l->m && status == QDOT_OK; k++)
        if (kept[k])
            F[m++] = l->F[k];
    near = prepare_search(l, m, F, domains);
    if (status == QDOT_OK && m > 0) {
        status = qdot_nearest_begin(&near);
        if (status == QDOT_OK) {
            memcpy(at, start, 2 * l->n * sizeof *at);
            status = qdot_nearest_find(&near, l->free, NULL, at, at + 2 * l->n, &outcome);
            qdot_nearest_end(&near);
        }
    }
    *can = outcome != QDOT_NEAREST_NONE;
    qdot_free(F);
    qdot_free(at);
    return status;
}

/* If no state satisfies all constraints: name a minimal set that contradicts itself, by removing
 * others one by one. */
static qdot_status
name_contradicting_constraints(const level *l, const qdot_domains *domains, const double *start)
{
    bool *kept = qdot_calloc(l->m + 1, sizeof *kept), can;
    qdot_status status = kept ? QDOT_OK : QDOT_ENOMEM;
    qdot_text text = {0};
    size_t count = l->m;

    for (size_t k = 0; k < l->m && status == QDOT_OK; k++)
        kept[k] = true;
    for (size_t k = l->m; k-- > 0 && status == QDOT_OK;) {
        kept[k] = false;
        status = have_common_solution(l, kept, domains, start, &can);
        if (status == QDOT_OK && can)
            kept[k] = true;
        else
            count--;
    }
    if (status == QDOT_OK) {
        qdot_text_format(&text, "no %s found that keep%s ",
                         l->velocities ? "velocities were" : "position was",
                         l->velocities ? "" : "s");
        print_constraints(l, kept, &text);
        if (count > 1)
            qdot_text_add(&text, ": they contradict each other");
        status = fail_with_text(&text, status);
    }
    if (status == QDOT_EINVAL)
        status = l->massless
                     ? qdot_hint("no mass moves with these coordinates: masses or damping")
                     : qdot_hint("check their parameters%s",
                                 count > 1 ? ", or remove one of them" : "");
    qdot_free(kept);
    return status;
}

/* --- solving one level -------------------------------------------------------------- */

/* Evaluate the mass matrix M at the start, into W, as the metric in which values move least. */
static qdot_status
evaluate_metric(const level *l, double *W)
{
    qdot_pool *pool = l->plan->pool;
    const size_t n = l->n, m = n - l->plan->n_states;
    qdot_expr M = qdot_mech_numeric_mass(l->scene), t = QDOT_T;
    qdot_expr *entries = qdot_calloc(n * n + 1, sizeof *entries);
    qdot_status status = entries ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK && M != QDOT_NIL)
        M = qdot_plan_substitute(l->plan, M);
    if (status == QDOT_OK && M != QDOT_NIL)
        M = qdot_subs(pool, M, 1, &t, &l->request->t0);
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    for (size_t i = 0; i < n * n && status == QDOT_OK; i++)
        entries[i] = is_coordinate_of_level(l, i / n) && is_coordinate_of_level(l, i % n)
                         ? qdot_expr_arg(pool, M, (uint32_t)(i / n * m + i % n))
                     : i / n == i % n ? QDOT_ONE
                                      : QDOT_ZERO;
    if (status == QDOT_OK)
        status = qdot_given_evaluate(l->given, n * n, entries, W);
    for (size_t i = 0; i < n * n && status == QDOT_OK; i++) {
        const bool massless = l->plan->massless && l->plan->massless[i / n];

        if (!isfinite(W[i]) || (massless && i % (n + 1) == 0))
            W[i] = i % (n + 1) == 0;
    }
    qdot_free(entries);
    return status;
}

/* Move all values as little as possible, even those given by the user, onto the constraints. */
static qdot_status
move_all_values(level *l, const qdot_domains *domains, double *y, double *other,
                qdot_text *notice)
{
    double *W = qdot_calloc(l->n * l->n + 1, sizeof *W);
    qdot_nearest_outcome outcome = QDOT_NEAREST_NONE;
    qdot_status status = W ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < l->n; i++)
        l->free[i] = is_coordinate_of_level(l, i);
    if (status == QDOT_OK)
        status = evaluate_metric(l, W);
    if (status == QDOT_OK)
        status = qdot_nearest_find(&l->near, l->free, W, y, other, &outcome);
    qdot_free(W);
    QDOT_TRY(status);
    if (outcome == QDOT_NEAREST_NONE)
        return name_contradicting_constraints(l, domains, y);
    if (outcome == QDOT_NEAREST_SEVERAL)
        return fail_several_solutions(l, y, other, true);
    return add_notice_of_moves(l, y, notice);
}

/* Solve for the values that were not given; if these cannot satisfy the equations, move all values. */
static qdot_status
solve_level(level *l, const qdot_domains *domains, double *y, qdot_text *notice)
{
    const bool *named = l->velocities ? l->request->v_named : l->request->q_named;
    qdot_nearest_outcome outcome = QDOT_NEAREST_NONE;
    double *other = qdot_calloc(l->n + 1, sizeof *other);
    qdot_status status = other ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < l->n; i++)
        l->free[i] = named && !named[i] && belongs_to_level(l, i);
    if (status == QDOT_OK)
        status = qdot_nearest_find(&l->near, l->free, NULL, y, other, &outcome);
    if (status == QDOT_OK && outcome == QDOT_NEAREST_SEVERAL)
        status = fail_several_solutions(l, y, other, false);
    else if (status == QDOT_OK && outcome == QDOT_NEAREST_NONE)
        status = move_all_values(l, domains, y, other, notice);
    qdot_free(other);
    return status;
}

static double
largest_violation(const level *l, const double *y)
{
    double most = 0, size = 1;

    for (size_t i = 0; i < l->n; i++)
        size = fmax(size, fabs(y[l->near.first + i]));
    for (size_t k = 0; k < l->m; k++)
        most = !(l->distance[k] / size <= most) ? l->distance[k] / size : most;
    return most;
}

/* Fail if a coordinate without a given value occurs in no constraint, although it must not be 0. */
static qdot_status
check_unconstrained_values(const level *l, const qdot_domains *domains, const double *y)
{
    const bool *named = l->request->q_named;

    for (size_t i = 0; named && !l->velocities && i < domains->n; i++) {
        const qdot_domain *d = &domains->at[i];
        double x = y[d->coordinate];

        if (!belongs_to_level(l, d->coordinate) ||
            ((d->lo_open ? x > d->lo : x >= d->lo) && (d->hi_open ? x < d->hi : x <= d->hi)))
            continue;
        if (named[d->coordinate] || qdot_expr_is_in_any(l->plan->pool, l->plan->inputs[d->coordinate], l->m, l->F))
            continue;
        qdot_fail(QDOT_EDOMAIN, "the start %s = 0 is outside its domain %.200s",
                  l->plan->names[d->coordinate], d->text);
        return qdot_hint("start %s = ...: what was never named starts at 0",
                         l->plan->names[d->coordinate]);
    }
    return QDOT_OK;
}

static qdot_status
solve_and_describe_level(level *l, const qdot_domains *domains, double *y, double *low, qdot_text *notice)
{
    double *residual = qdot_calloc(l->m + 1, sizeof *residual), broken;
    qdot_status status = residual ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_nearest_distance(&l->near, y, l->distance, residual);
    broken = status == QDOT_OK ? largest_violation(l, y) : 0;
    for (size_t i = 0; i < l->n; i++)
        l->free[i] = is_coordinate_of_level(l, i);
    if (status == QDOT_OK && !(broken <= breaks)) {
        status = l->request->exactly ? fail_no_solution(l, residual) : solve_level(l, domains, y, notice);
        for (size_t i = 0; i < l->n; i++)
            if (l->free[i])
                low[l->near.first + i] = 0;
    }
    if (status == QDOT_OK && broken != 0)
        status = qdot_nearest_refine(&l->near, l->free, y, low);
    qdot_free(residual);
    return status;
}

/* --- redundant constraints ---------------------------------------------------------- */

/* Evaluate the gradients A of the constraints at the start: by q or q', according to each constraint's kind. */
static qdot_status
evaluate_gradients(const level *l, double *A)
{
    qdot_scene *scene = l->scene;
    qdot_pool *pool = l->plan->pool;
    size_t n = l->n, c = scene->constraints.n;
    qdot_expr *entries = qdot_calloc(c * n + 1, sizeof *entries), t = QDOT_T;
    qdot_status status = entries ? QDOT_OK : QDOT_ENOMEM;

    for (size_t k = 0; k < c * n && status == QDOT_OK; k++) {
        const qdot_constraint *one = &scene->constraints.at[k / n];
        qdot_expr e, mu;

        if (!is_coordinate_of_level(l, k % n)) {
            entries[k] = QDOT_ZERO;
            continue;
        }
        e = qdot_diff(
            pool, qdot_integrated_rate(scene, k / n, &mu),
            qdot_symbol_jet(pool, scene->coordinates.at[k % n], (uint32_t)one->kind));
        e = e == QDOT_NIL ? e : qdot_plan_substitute(l->plan, e);
        entries[k] = e == QDOT_NIL ? e : qdot_subs(pool, e, 1, &t, &l->request->t0);
    }
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    if (status == QDOT_OK)
        status = qdot_given_evaluate(l->given, c * n, entries, A);
    qdot_free(entries);
    return status;
}

qdot_status
qdot_start_redundant(qdot_scene *scene, const qdot_plan *plan,
                     const qdot_run_request *request, const double *y, const double *low,
                     qdot_text *notice)
{
    size_t n = plan->n, c = scene->constraints.n;
    qdot_given given;
    level l = {.scene = scene, .plan = plan, .request = request, .n = n, .given = &given};
    double *A = qdot_calloc(c * n + 1, sizeof *A);
    bool *which = qdot_calloc(c + 1, sizeof *which);
    qdot_row_space rows = {0};
    qdot_status status = A && which ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_row_space_init(&rows, c, n);
    given = (qdot_given){0};
    if (status == QDOT_OK)
        status = qdot_given_init(&given, plan, request, y, low);
    if (status == QDOT_OK)
        status = begin_level(&l);
    for (size_t k = 0; k < c && status == QDOT_OK; k++)
        l.constraint[k] = k;
    l.m = c;
    if (status == QDOT_OK)
        status = evaluate_gradients(&l, A);
    if (status == QDOT_OK) {
        qdot_row_space_factor(&rows, A, 1e-9, true);
        for (size_t k = rows.rank; k < c; k++)
            which[rows.order[k]] = true;
        if (rows.rank < c) {
            if (notice->n > 0)
                qdot_text_add(notice, "\n");
            print_constraints(&l, which, notice);
            qdot_text_add(notice, c - rows.rank == 1 ? " says" : " say");
            qdot_text_add(notice, " nothing new at the start, beside those before");
            status = qdot_text_status(notice);
        }
    }
    clear_level(&l);
    qdot_given_clear(&given);
    qdot_row_space_clear(&rows);
    qdot_free(A);
    qdot_free(which);
    return status;
}

qdot_status
qdot_start_settle(qdot_scene *scene, const qdot_plan *plan,
                  const qdot_run_request *request, const qdot_domains *domains, double *y,
                  double *low, qdot_text *notice)
{
    const level levels[] = {{.velocities = false}, {.eliminated = POSITIONS}, {.eliminated = MOMENTA},
                            {.massless = true}, {.velocities = true}, {.velocities = true, .massless = true}};
    size_t n = plan->n;
    double *before = qdot_calloc(2 * n + 1, sizeof *before);
    qdot_status status = before ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK)
        memcpy(before, y, 2 * n * sizeof *before);
    for (size_t part = 0; part < sizeof levels / sizeof *levels && status == QDOT_OK; part++) {
        qdot_given given = {0};
        level l = {.scene = scene,
                   .plan = plan,
                   .given = &given,
                   .request = request,
                   .velocities = levels[part].velocities,
                   .massless = levels[part].massless,
                   .eliminated = levels[part].eliminated,
                   .n = n,
                   .before = before};

        status = begin_level(&l);
        if (status == QDOT_OK && l.m > 0)
            status = qdot_given_init(&given, plan, request, y, low);
        if (status == QDOT_OK && l.m > 0) {
            l.near = prepare_search(&l, l.m, l.F, domains);
            status = check_unconstrained_values(&l, domains, y);
            if (status == QDOT_OK)
                status = qdot_nearest_begin(&l.near);
            if (status == QDOT_OK) {
                status = solve_and_describe_level(&l, domains, y, low, notice);
                qdot_nearest_end(&l.near);
            }
        }
        clear_level(&l);
        qdot_given_clear(&given);
    }
    qdot_free(before);
    return status;
}
