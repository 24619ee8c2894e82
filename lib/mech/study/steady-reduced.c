/* steady-reduced.c -- steady motions by the equations of motion in independent velocities. */
#include "mech/study/steady-reduced.h"

#include <stdint.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/function.h"
#include "expr/list.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "mech/dynamics/quantity.h"
#include "mech/linear/elimination.h"
#include "mech/scene/access.h"
#include "mech/scene/scene.h"
#include "mech/study/steady-momenta.h"
#include "normal/inequality/less.h"
#include "normal/simplify/positive.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/conditions.h"
#include "normal/solve/solve.h"

enum { MOST_WORK = 12000 };

typedef struct {
    qdot_scene *s;
    qdot_pool *pool;
    qdot_facts facts;
    qdot_elimination x;
    size_t n, m;                /* numbers of coordinates and of independent velocities */
    size_t *order, *independent; /* [n] coordinates, those that nothing holds first; [m] those of the independent velocities */
    qdot_expr *N, *M, *R;       /* [n x m], [m x m], [m] */
    bool *rests;                /* [n] the equations hold the coordinate */
} reduced_motion;

static qdot_expr
independent_rate(const reduced_motion *r, size_t a)
{
    return qdot_symbol_jet(r->pool, r->s->coordinates.at[r->independent[a]], 1);
}

/* --- the equations in independent velocities --------------------------------------------------- */

/* Coordinates that occur in no mass, force or constraint first: their velocities become the dependent ones. */
static void
order_coordinates(reduced_motion *r, qdot_expr M, qdot_expr f)
{
    size_t at = 0;

    for (int held = 0; held < 2; held++)
        for (size_t i = 0; i < r->n; i++) {
            const qdot_expr q = r->s->coordinates.at[i];
            bool is = qdot_expr_contains(r->pool, M, q) || qdot_expr_contains(r->pool, f, q);

            for (size_t k = 0; k < r->s->constraints.n; k++)
                is = is || qdot_expr_contains(r->pool, r->s->constraints.at[k].f, q);
            if (is == (held == 1))
                r->order[at++] = i;
        }
}

/* The slopes of constraint k along the velocities, in that order. */
static qdot_status
read_velocity_constraint(reduced_motion *r, size_t k, qdot_expr *row)
{
    const qdot_constraint *c = &r->s->constraints.at[k];
    qdot_expr rest = c->f;

    if (c->kind != QDOT_VELOCITY)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: steady motions with velocity constraints beside others (%.100s)", c->name);
    for (size_t i = 0; i < r->n; i++) {
        const qdot_expr rate = qdot_symbol_jet(r->pool, r->s->coordinates.at[r->order[i]], 1), zero = QDOT_ZERO;

        row[i] = qdot_elimination_short(&r->x, qdot_diff(r->pool, c->f, rate));
        rest = qdot_subs(r->pool, rest, 1, &rate, &zero);
    }
    QDOT_TRY(qdot_pool_check(r->pool));
    if (!qdot_elimination_is_zero(&r->x, rest) || (qdot_mech_holds(r->s, c->f) & QDOT_HAS_TIME) != 0)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: steady motions where constraint %.100s moves by itself", c->name);
    return QDOT_OK;
}

/* N from the constraints. */
static qdot_status
eliminate_velocities(reduced_motion *r)
{
    const size_t n = r->n, c = r->s->constraints.n;
    qdot_expr *row = qdot_calloc(n + n * n + 1, sizeof *row), *N = row + n;
    qdot_echelon e;
    qdot_status status = row == NULL ? QDOT_ENOMEM : qdot_echelon_begin(&e, c, n, n);
    size_t a = 0;

    if (row == NULL)
        return status;
    for (size_t k = 0; k < c && status == QDOT_OK; k++) {
        bool independent;

        status = read_velocity_constraint(r, k, row);
        if (status == QDOT_OK)
            status = qdot_echelon_add(&r->x, &e, row, &independent);
    }
    if (status == QDOT_OK) {
        r->m = n - e.rank;
        qdot_echelon_null_space(r->pool, &e, N);
        for (size_t i = 0; i < n * r->m; i++)
            r->N[r->order[i / r->m] * r->m + i % r->m] = N[i];
        for (size_t i = 0; i < n; i++)
            if (!qdot_echelon_leads(&e, i))
                r->independent[a++] = r->order[i];
    }
    qdot_echelon_end(&e);
    qdot_free(row);
    return status == QDOT_OK ? qdot_pool_check(r->pool) : status;
}

/* The velocity of coordinate i in the independent ones. */
static qdot_expr
velocity_of(const reduced_motion *r, size_t i)
{
    qdot_expr sum = QDOT_ZERO;

    for (size_t a = 0; a < r->m; a++)
        sum = qdot_add(r->pool, sum, qdot_mul(r->pool, r->N[i * r->m + a], independent_rate(r, a)));
    return sum;
}

/* N' u of coordinate i: its acceleration while u is constant. */
static qdot_expr
drift_of(const reduced_motion *r, size_t i)
{
    qdot_expr sum = QDOT_ZERO;

    for (size_t a = 0; a < r->m; a++)
        for (size_t k = 0; k < r->n; k++) {
            const qdot_expr slope = qdot_diff(r->pool, r->N[i * r->m + a], r->s->coordinates.at[k]);

            if (slope != QDOT_ZERO)
                sum = qdot_add(r->pool, sum, qdot_product(r->pool, 3, (qdot_expr[]){slope, velocity_of(r, k),
                                                                                   independent_rate(r, a)}));
        }
    return sum;
}

static qdot_status
reduce_equations(reduced_motion *r, qdot_expr M, qdot_expr f)
{
    const size_t n = r->n, m = r->m;
    qdot_expr *from = qdot_calloc(4 * n + 1, sizeof *from), *to = from + n, *drift = to + n, *force = drift + n;

    if (from == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++) {
        from[i] = qdot_symbol_jet(r->pool, r->s->coordinates.at[i], 1);
        to[i] = velocity_of(r, i);
        drift[i] = drift_of(r, i);
    }
    for (size_t i = 0; i < n; i++) {
        force[i] = qdot_neg(r->pool, qdot_subs(r->pool, qdot_expr_arg(r->pool, f, (uint32_t)i), n, from, to));
        for (size_t k = 0; k < n; k++)
            if (drift[k] != QDOT_ZERO)
                force[i] = qdot_add(r->pool, force[i], qdot_mul(r->pool, qdot_expr_arg(r->pool, M, (uint32_t)(i * n + k)), drift[k]));
    }
    for (size_t a = 0; a < m; a++) {
        qdot_expr sum = QDOT_ZERO;

        for (size_t i = 0; i < n; i++)
            sum = qdot_add(r->pool, sum, qdot_mul(r->pool, r->N[i * m + a], force[i]));
        r->R[a] = qdot_elimination_short(&r->x, sum);
        for (size_t b = 0; b < m; b++) {
            sum = QDOT_ZERO;
            for (size_t i = 0; i < n * n; i++)
                sum = qdot_add(r->pool, sum, qdot_product(r->pool, 3, (qdot_expr[]){r->N[i / n * m + a],
                                                                                    qdot_expr_arg(r->pool, M, (uint32_t)i),
                                                                                    r->N[i % n * m + b]}));
            r->M[a * m + b] = qdot_elimination_short(&r->x, sum);
        }
    }
    qdot_free(from);
    return qdot_pool_check(r->pool);
}

static void
find_resting(reduced_motion *r)
{
    for (size_t i = 0; i < r->n; i++) {
        const qdot_expr q = r->s->coordinates.at[i];

        for (size_t k = 0; k < r->m * r->m; k++)
            r->rests[i] = r->rests[i] || qdot_expr_contains(r->pool, r->M[k], q);
        for (size_t k = 0; k < r->m; k++)
            r->rests[i] = r->rests[i] || qdot_expr_contains(r->pool, r->R[k], q);
    }
}

static void
reduced_end(reduced_motion *r)
{
    qdot_free(r->order);
    qdot_free(r->N);
    qdot_free(r->rests);
}

static qdot_status
reduced_begin(reduced_motion *r, qdot_scene *s)
{
    const qdot_expr M = qdot_released(s->pool, qdot_mech_numeric_mass(s)), f = qdot_released(s->pool, qdot_mech_numeric_forcing(s));
    const size_t n = s->coordinates.n;

    *r = (reduced_motion){.s = s, .pool = s->pool, .facts = qdot_scene_facts(s), .n = n};
    r->x = (qdot_elimination){.pool = s->pool, .facts = &r->facts, .most = MOST_WORK};
    QDOT_TRY(qdot_pool_check(s->pool));
    r->order = qdot_calloc(2 * n + 1, sizeof *r->order);
    r->N = qdot_calloc(2 * n * n + n + 1, sizeof *r->N);
    r->rests = qdot_calloc(n + 1, sizeof *r->rests);
    if (r->order == NULL || r->N == NULL || r->rests == NULL)
        return QDOT_ENOMEM;
    r->independent = r->order + n;
    r->M = r->N + n * n;
    r->R = r->M + n * n;
    if ((qdot_mech_holds(s, f) & (QDOT_HAS_TIME | QDOT_HAS_MULTIPLIER)) != 0 || (qdot_mech_holds(s, M) & QDOT_HAS_TIME) != 0)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: unknown rates of steady motions where forces hold t or multipliers");
    order_coordinates(r, M, f);
    QDOT_TRY(eliminate_velocities(r));
    QDOT_TRY(reduce_equations(r, M, f));
    find_resting(r);
    return QDOT_OK;
}

/* --- solving -------------------------------------------------------------------------------------- */

static bool
turns(const reduced_motion *r, size_t a)
{
    return !r->rests[r->independent[a]];
}

/* e where the resting coordinates rest. */
static qdot_expr
while_resting(const reduced_motion *r, qdot_expr e)
{
    const qdot_expr zero = QDOT_ZERO;

    for (size_t a = 0; a < r->m; a++) {
        const qdot_expr rate = independent_rate(r, a);

        if (!turns(r, a))
            e = qdot_subs(r->pool, e, 1, &rate, &zero);
    }
    return e == QDOT_NIL ? e : qdot_simplify(r->pool, e, &r->facts);
}

/* The equation of steady motions: R = 0, and the velocities of resting coordinates 0. *e is 0 where there is none. */
static qdot_status
steady_equation(const reduced_motion *r, qdot_expr *e)
{
    *e = QDOT_ZERO;
    for (size_t a = 0; a < r->m + r->n; a++) {
        const qdot_expr one = a < r->m                 ? while_resting(r, r->R[a])
                              : r->rests[a - r->m] ? while_resting(r, velocity_of(r, a - r->m))
                                                       : QDOT_ZERO;

        QDOT_TRY(qdot_pool_check(r->pool));
        if (one == QDOT_ZERO || one == *e)
            continue;
        if (*e != QDOT_ZERO)
            return qdot_fail(QDOT_ENOTBUILT, "not built yet: steady motions of several equations with velocity constraints or "
                                             "unknown rates");
        *e = one;
    }
    return QDOT_OK;
}

/* Add the motion in which `unknown` has a value: coordinates and rates as equations. */
static qdot_status
add_steady_motion(const reduced_motion *r, qdot_expr unknown, const qdot_root *root, qdot_equilibria *out)
{
    qdot_expr list = qdot_list(r->pool, 0, NULL);
    qdot_equilibrium one = {.exists = root->condition}, *at;

    for (int order = 0; order < 2; order++)
        for (size_t i = 0; i < r->n; i++) {
            const qdot_expr q = r->s->coordinates.at[i], symbol = qdot_symbol_jet(r->pool, q, (uint32_t)order);
            qdot_expr value = order == 0 ? q : while_resting(r, velocity_of(r, i)), equation;

            if (r->rests[i] == (order == 1))
                continue;
            value = qdot_subs(r->pool, value, 1, &unknown, &root->value);
            equation = qdot_rel(r->pool, QDOT_EQ, symbol, value == QDOT_NIL ? value : qdot_simplify(r->pool, value, &r->facts));
            list = qdot_list_appended(r->pool, list, 1, &equation);
        }
    QDOT_TRY(qdot_pool_check(r->pool));
    one.equations = list;
    one.stability = QDOT_STABILITY_UNDECIDED;
    at = qdot_realloc(out->at, (out->n + 1) * sizeof *at);
    if (at == NULL)
        return QDOT_ENOMEM;
    out->at = at;
    out->at[out->n++] = one;
    return QDOT_OK;
}

/* Solve the equation for one unknown, if it occurs and a formula is found that has at most so many roots: *solved. */
static qdot_status
solve_for(const reduced_motion *r, qdot_expr e, qdot_expr unknown, size_t most, qdot_equilibria *out, bool *solved)
{
    qdot_solutions roots = {0};
    qdot_status status = QDOT_OK;

    *solved = false;
    if (e != QDOT_ZERO && !qdot_expr_contains(r->pool, e, unknown))
        return QDOT_OK;
    if (e != QDOT_ZERO)
        status = qdot_expr_is_class(r->pool, unknown, QDOT_COORD) && qdot_expr_symbol(r->pool, unknown)->order == 0
                     ? qdot_solve_inside(r->pool, e, unknown, QDOT_NIL, &r->facts, &roots)
                     : qdot_solve(r->pool, e, unknown, &r->facts, &roots);
    *solved = status == QDOT_OK && e != QDOT_ZERO && roots.complete && roots.root.n <= most;
    for (size_t i = 0; i < roots.root.n && status == QDOT_OK && *solved; i++)
        status = add_steady_motion(r, unknown, &roots.root.at[i], out);
    for (size_t i = 0; i < roots.divisor.n && status == QDOT_OK && *solved; i++) {
        out->special = out->special == QDOT_NIL ? qdot_list(r->pool, 0, NULL) : out->special;
        out->special = qdot_list_appended(r->pool, out->special, 1, &roots.divisor.at[i]);
    }
    out->complete = true;
    qdot_solutions_clear(&roots);
    return status == QDOT_OK ? qdot_pool_check(r->pool) : status;
}

static qdot_status
refuse_unknown(const reduced_motion *r, qdot_expr unknown)
{
    (void)qdot_fail(QDOT_EINVAL, "`%.100s` is no free rate of the steady motions", qdot_expr_symbol(r->pool, unknown)->name);
    for (size_t a = 0; a < r->m; a++)
        if (turns(r, a))
            return qdot_hint("steady in %.100s", qdot_expr_symbol(r->pool, independent_rate(r, a))->name);
    return qdot_hint("equilibria");
}

/* Solve for the rate that is asked for. */
static qdot_status
solve_for_rate(const reduced_motion *r, qdot_expr e, qdot_expr unknown, qdot_equilibria *out)
{
    bool is = false, solved;

    for (size_t a = 0; a < r->m; a++)
        is = is || (turns(r, a) && independent_rate(r, a) == unknown);
    if (!is)
        return refuse_unknown(r, unknown);
    QDOT_TRY(solve_for(r, e, unknown, SIZE_MAX, out, &solved));
    return solved ? QDOT_OK
                  : qdot_fail(QDOT_EFAILED, "the relation of the steady motions is not solved for `%.100s`",
                              qdot_expr_symbol(r->pool, unknown)->name);
}

/* Solve for the resting coordinate, else for a rate: one of which there is a single value, if there is such a one. */
static qdot_status
solve_for_any(const reduced_motion *r, qdot_expr e, qdot_equilibria *out)
{
    bool solved = false;

    for (size_t i = 0; i < r->n && !solved; i++)
        if (r->rests[i])
            QDOT_TRY(solve_for(r, e, r->s->coordinates.at[i], SIZE_MAX, out, &solved));
    for (int several = 0; several < 2; several++)
        for (size_t a = r->m; a-- > 0 && !solved;)
            if (turns(r, a))
                QDOT_TRY(solve_for(r, e, independent_rate(r, a), several ? SIZE_MAX : 1, out, &solved));
    if (!solved && e == QDOT_ZERO)
        return add_steady_motion(r, QDOT_T, &(qdot_root){.value = QDOT_T}, out);
    return solved ? QDOT_OK : qdot_fail(QDOT_EFAILED, "no formula is found for the steady motions");
}

/* --- stability ------------------------------------------------------------------------------------ */

/* The value of e at the steady motion `one`. */
static qdot_expr
value_in_motion(const reduced_motion *r, const qdot_equilibrium *one, qdot_expr e)
{
    e = while_resting(r, e);
    for (uint32_t i = 0; i < qdot_expr_count(r->pool, one->equations) && e != QDOT_NIL; i++) {
        const qdot_expr equation = qdot_expr_arg(r->pool, one->equations, i), symbol = qdot_expr_arg(r->pool, equation, 0),
                        value = qdot_expr_arg(r->pool, equation, 1);

        e = qdot_subs(r->pool, e, 1, &symbol, &value);
    }
    return e == QDOT_NIL ? e : qdot_simplify(r->pool, e, &r->facts);
}

/* The matrix of the linear motion, [k + m] rows: of the resting coordinates, then of the independent velocities. */
static qdot_status
characteristic_polynomial(const reduced_motion *r, const qdot_equilibrium *one, qdot_expr lambda, qdot_expr *p)
{
    size_t k = 0, size, at = 0, *resting = qdot_calloc(r->n + 1, sizeof *resting);
    qdot_expr *A;

    if (resting == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < r->n; i++)
        if (r->rests[i])
            resting[k++] = i;
    size = k + r->m;
    A = qdot_calloc(size * size + 1, sizeof *A);
    for (size_t row = 0; row < size && A != NULL; row++)
        for (size_t column = 0; column < size; column++, at++) {
            const qdot_expr e = row < k ? qdot_neg(r->pool, velocity_of(r, resting[row])) : r->R[row - k];
            const qdot_expr by = column < k ? r->s->coordinates.at[resting[column]] : independent_rate(r, column - k);

            A[at] = value_in_motion(r, one, qdot_diff(r->pool, e, by));
            if (row < k && row == column)
                A[at] = qdot_add(r->pool, A[at], lambda);
            if (row >= k && column >= k)
                A[at] = qdot_add(r->pool, A[at], qdot_mul(r->pool, lambda, value_in_motion(r, one, r->M[(row - k) * r->m + column - k])));
        }
    *p = A == NULL ? QDOT_NIL : qdot_expand(r->pool, qdot_det(r->pool, qdot_matrix(r->pool, (uint32_t)size, (uint32_t)size, A)));
    qdot_free(resting);
    qdot_free(A);
    return A == NULL ? QDOT_ENOMEM : qdot_pool_check(r->pool);
}

/* Ask that e is positive: a condition is added; *never: it is proved negative. */
static qdot_status
ask_positive(const reduced_motion *r, const qdot_facts *facts, qdot_expr e, qdot_equilibrium *one, bool *open, bool *never)
{
    const qdot_expr answer = qdot_positive(r->pool, e, facts, 0, NULL);
    qdot_decision d;

    QDOT_TRY(qdot_pool_check(r->pool));
    if (answer == QDOT_FALSE) {
        QDOT_TRY(qdot_decide_less(r->pool, e, QDOT_ZERO, false, facts, &d));
        *never = d.verdict == QDOT_PROVED;
        *open = !*never;
    } else if (answer != QDOT_TRUE) {
        one->stable_when = qdot_conditions_and(r->pool, one->stable_when, answer);
    }
    return QDOT_OK;
}

/* By the quadratic a lambda^2 + b lambda + c that is left when lambda is divided out. */
static qdot_status
judge_by_roots(const reduced_motion *r, qdot_equilibrium *one)
{
    const qdot_expr lambda = qdot_symbol_get(r->pool, QDOT_FORMAL, "lambda#steady");
    qdot_expr p, c[3] = {QDOT_ZERO, QDOT_ZERO, QDOT_ZERO}, room[QDOT_CONDITIONS_MOST];
    const qdot_facts facts = qdot_facts_and(r->pool, &r->facts, one->exists, room);
    bool open = false, never = false;
    size_t rates = 0, degree = 0;

    for (size_t i = 0; i < r->n; i++)
        degree += r->rests[i];
    for (size_t a = 0; a < r->m; a++)
        rates += turns(r, a);
    if (degree + r->m != rates + 2) /* more than one coordinate rests */
        return QDOT_OK;
    QDOT_TRY(characteristic_polynomial(r, one, lambda, &p));
    for (size_t k = 0; k < 3; k++)
        c[k] = qdot_simplify(r->pool, qdot_coefficient(r->pool, p, lambda, (long)(rates + k)), &facts);
    for (size_t k = 0; k < rates; k++)
        open = open || qdot_simplify(r->pool, qdot_coefficient(r->pool, p, lambda, (long)k), &facts) != QDOT_ZERO;
    QDOT_TRY(qdot_pool_check(r->pool));
    for (size_t k = 0; k < 2 && !open; k++)
        if (k == 0 || c[k] != QDOT_ZERO)
            QDOT_TRY(ask_positive(r, &facts, qdot_simplify(r->pool, qdot_div(r->pool, c[k], c[2]), &facts), one, &open, &never));
    if (never)
        one->stable_when = QDOT_NIL;
    one->stability = never ? QDOT_UNSTABLE : open ? QDOT_STABILITY_UNDECIDED : QDOT_STABLE_TO_FIRST_ORDER;
    if (open)
        one->stable_when = QDOT_NIL;
    return qdot_pool_check(r->pool);
}

static qdot_status
judge_all(const reduced_motion *r, qdot_equilibria *out)
{
    qdot_expr *turning = qdot_calloc(r->m + 1, sizeof *turning);
    size_t n = 0;
    bool conservative = false;
    qdot_status status = turning == NULL ? QDOT_ENOMEM : qdot_steady_is_conservative(r->s, &conservative);

    for (size_t a = 0; a < r->m && status == QDOT_OK; a++)
        if (turns(r, a))
            turning[n++] = r->s->coordinates.at[r->independent[a]];
    for (size_t i = 0; i < out->n && status == QDOT_OK; i++) {
        status = judge_by_roots(r, &out->at[i]);
        if (status == QDOT_OK && conservative && out->at[i].stability != QDOT_UNSTABLE)
            status = qdot_steady_at_momenta(r->s, n, turning, &out->at[i]);
    }
    qdot_free(turning);
    return status;
}

qdot_status
qdot_steady_reduced(qdot_scene *s, qdot_expr unknown, qdot_equilibria *out)
{
    reduced_motion r;
    qdot_expr e = QDOT_ZERO;
    bool free_rate = false;
    qdot_status status = reduced_begin(&r, s);

    *out = (qdot_equilibria){0};
    for (size_t a = 0; a < r.m && status == QDOT_OK; a++)
        free_rate = free_rate || turns(&r, a);
    if (status == QDOT_OK && !free_rate) {
        (void)qdot_fail(QDOT_EINVAL, "the equations of motion hold every coordinate: steady motions are the equilibria");
        status = qdot_hint("equilibria");
    }
    if (status == QDOT_OK)
        status = steady_equation(&r, &e);
    if (status == QDOT_OK)
        status = unknown != QDOT_NIL ? solve_for_rate(&r, e, unknown, out) : solve_for_any(&r, e, out);
    if (status == QDOT_OK)
        status = judge_all(&r, out);
    reduced_end(&r);
    return status;
}
