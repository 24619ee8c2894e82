/* modes.c -- normal modes about an equilibrium: what has them, and their order. Formulas are found in modes-exact.c and
 * modes-gyroscopic.c, numbers in modes-numbers.c. */
#include "mech/linear/modes.h"
#include "mech/linear/modes-parts.h"

#include <math.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/generic.h"
#include "mech/dynamics/integrated.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "normal/inequality/less.h"
#include "normal/prove/decide.h"
#include "normal/refute/ball.h"
#include "normal/simplify/positive.h"
#include "normal/simplify/rationalize.h"
#include "normal/simplify/simplify.h"

bool
qdot_modes_is_zero(const qdot_modes_job *j, qdot_expr e)
{
    return e == QDOT_ZERO || qdot_is_zero(j->pool, e, &j->facts);
}

qdot_expr
qdot_modes_bound(const qdot_modes_job *j, qdot_expr e)
{
    return j->bind == NULL || e == QDOT_NIL ? e : j->bind(j->user, e);
}

/* Eliminate coordinates without mass, which follow the other coordinates as in statics. */
static qdot_status
eliminate_massless(qdot_modes_job *j)
{
    size_t left;

    QDOT_TRY(qdot_linear_motion_condense(j->s, &j->facts, &j->m, &left));
    if (left == SIZE_MAX && j->m.n > 0)
        return QDOT_OK;
    (void)qdot_fail(QDOT_ESINGULAR, "nothing with mass moves with %.200s: it has no modes",
                    qdot_expr_symbol(j->pool, j->s->coordinates.at[left == SIZE_MAX ? 0 : left])->name);
    return qdot_hint("declare only the coordinates that the scene uses");
}

/* *yes: the argument of a sign in e, or the difference between both sides of an `if`'s condition, is proved to be 0 at
 * the place, so that e jumps there. */
static qdot_status
expression_jumps_at(const qdot_modes_job *j, qdot_expr e, qdot_expr place, bool *yes)
{
    qdot_pool *pool = j->pool;
    qdot_status status = QDOT_OK;
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin(pool, e, &w));
    for (size_t i = 0; i < w.n && !*yes && status == QDOT_OK; i++) {
        uint32_t op = qdot_expr_kind(pool, w.at[i]) == QDOT_FUN ? qdot_expr_node(pool, w.at[i])->op : QDOT_ABS;
        qdot_expr u = op == QDOT_SIGN || op == QDOT_IF ? qdot_expr_arg(pool, w.at[i], 0) : QDOT_NIL;

        if (u == QDOT_NIL || (qdot_mech_holds(j->s, u) & (QDOT_HAS_COORD | QDOT_HAS_VELOCITY)) == 0)
            continue;
        if (op == QDOT_IF && qdot_expr_kind(pool, u) != QDOT_REL)
            continue;
        if (op == QDOT_IF)
            u = qdot_sub(pool, qdot_expr_arg(pool, u, 1), qdot_expr_arg(pool, u, 0));
        *yes = qdot_modes_is_zero(j, qdot_rest_value(j->s, place, u));
        status = qdot_pool_check(pool);
    }
    qdot_walk_end(&w);
    return status == QDOT_EDOMAIN ? QDOT_OK : status;
}

/* Refuse points without linear motion: at a corner, between one-sided springs, or under dry friction. */
static qdot_status
check_smooth(const qdot_modes_job *j, qdot_expr place)
{
    qdot_scene *s = j->s;
    bool jumps = false;

    for (size_t i = 0; i < s->coordinates.n && !jumps; i++) {
        const qdot_expr gap = qdot_motion_residual(s, i);

        QDOT_TRY(expression_jumps_at(j, qdot_mech_equation(s, s->coordinates.at[i]), place, &jumps));
        for (size_t k = 0; k < s->coordinates.n && !jumps; k++)
            QDOT_TRY(expression_jumps_at(j, qdot_diff(j->pool, gap, s->coordinates.at[k]), place, &jumps));
    }
    QDOT_TRY(qdot_pool_check(j->pool));
    return jumps ? qdot_fail(QDOT_ETYPE, "the forces or their slopes jump at the equilibrium: there is no linear motion "
                                         "about it, so it has no normal modes")
                 : QDOT_OK;
}

/* Whether |value|, that of e at the place, is no more than relative errors of 1e-6 in the coordinates of the place (of
 * 1e-6 where they are below 1) make of it, to first order. */
static bool
is_within_rounding_error(const qdot_modes_job *j, qdot_expr e, qdot_expr place, double value)
{
    double sum = 0;

    for (size_t k = 0; k < j->s->coordinates.n; k++) {
        const qdot_expr q = j->s->coordinates.at[k];
        double slope = 0, at = 0;

        if (qdot_ball_double(j->pool, qdot_modes_bound(j, qdot_rest_value(j->s, place, qdot_diff(j->pool, e, q))), NULL, NULL,
                             &slope) &&
            qdot_ball_double(j->pool, qdot_modes_bound(j, qdot_rest_value(j->s, place, q)), NULL, NULL, &at))
            sum += fabs(slope) * fmax(1, fabs(at));
    }
    return fabs(value) <= 1e-6 * sum;
}

/* An error if an equation of motion is refuted at rest at the place, beyond rounding: it is no equilibrium.
 * Equations that hold a multiplier are passed over, because its value there need not be known. */
static qdot_status
check_is_equilibrium(const qdot_modes_job *j, qdot_expr place)
{
    for (size_t i = 0; i < j->s->coordinates.n; i++) {
        const qdot_expr gap = qdot_motion_residual(j->s, i);
        qdot_expr there;
        qdot_decision decision;
        bool pulled = false;

        for (size_t k = 0; k < j->s->constraints.n; k++)
            pulled = pulled || qdot_expr_contains(j->pool, gap, j->s->constraints.at[k].multiplier);
        if (pulled)
            continue;
        there = qdot_modes_bound(j, qdot_rest_value(j->s, place, gap));
        QDOT_TRY(qdot_pool_check(j->pool));
        QDOT_TRY(qdot_decide_equal(j->pool, there, QDOT_ZERO, &j->facts, &decision));
        if (decision.verdict != QDOT_REFUTED || is_within_rounding_error(j, gap, place, decision.left))
            continue;
        (void)qdot_fail(QDOT_EINVAL, "that is no equilibrium: the equation of %s does not hold at rest there",
                        qdot_expr_symbol(j->pool, j->s->coordinates.at[i])->name);
        return qdot_hint("modes at equilibria[1]");
    }
    return qdot_pool_check(j->pool);
}

/* Whether X [n x n] is proved equal to its transpose (sign 1), or to minus its transpose (sign -1). */
static bool
is_symmetric(const qdot_modes_job *j, const qdot_expr *X, int sign)
{
    const size_t n = j->m.n;

    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k <= i; k++) {
            const qdot_expr a = X[i * n + k], b = X[k * n + i];

            if (!qdot_modes_is_zero(j, sign > 0 ? qdot_sub(j->pool, a, b) : qdot_add(j->pool, a, b)))
                return false;
        }
    return true;
}

/* Whether a row of M is 0, so that an unknown has no mass. Beside Gamma such an unknown follows the velocities of the others,
 * too, while qdot_linear_motion_condense eliminates it as in statics, from the forces H y alone. */
static bool
something_is_without_mass(const qdot_modes_job *j)
{
    const size_t n = j->m.n;

    for (size_t i = 0; i < n; i++) {
        bool moves = false;

        for (size_t k = 0; k < n && !moves; k++)
            moves = !qdot_modes_is_zero(j, j->m.M[i * n + k]);
        if (!moves)
            return true;
    }
    return false;
}

static qdot_status
check_linear_motion(qdot_modes_job *j)
{
    const size_t n = j->m.n;

    if (n == 0)
        return qdot_fail(QDOT_EINVAL, "nothing can move there: there are no modes");
    for (size_t i = 0; i < n * n; i++)
        j->gyroscopic = j->gyroscopic || !qdot_modes_is_zero(j, j->m.Gamma[i]);
    j->symmetric = is_symmetric(j, j->m.H, 1);
    QDOT_TRY(qdot_pool_check(j->pool));
    /* rotation and magnetic fields have an antisymmetric Gamma, damping has not */
    if (j->gyroscopic && !is_symmetric(j, j->m.Gamma, -1)) {
        (void)qdot_fail(QDOT_ETYPE, "the motion about the equilibrium has damping: it has no normal modes");
        return qdot_hint("linearize at equilibria[1]");
    }
    if (!j->symmetric && !j->bound_by_velocities)
        return qdot_fail(QDOT_ETYPE, "the forces have no potential: there are no normal modes");
    if (j->gyroscopic && something_is_without_mass(j))
        return qdot_fail(QDOT_ESINGULAR, "something moves without mass under gyroscopic forces: there are no normal modes");
    return j->gyroscopic ? qdot_pool_check(j->pool) : eliminate_massless(j);
}

qdot_status
qdot_modes_fail_unstable(void)
{
    return qdot_fail(QDOT_EDOMAIN, "the equilibrium is not stable: there is no oscillation about it");
}

qdot_status
qdot_modes_frequency(const qdot_modes_job *j, qdot_expr square, qdot_expr *w)
{
    qdot_pool *pool = j->pool;

    if (qdot_positive(pool, square, &j->facts, 0, NULL) == QDOT_FALSE && !qdot_modes_is_zero(j, square))
        return qdot_pool_failed(pool) ? qdot_pool_check(pool) : qdot_modes_fail_unstable();
    *w = qdot_simplify(pool, qdot_sqrt(pool, square), &j->facts);
    return qdot_pool_check(pool) == QDOT_EDOMAIN ? qdot_modes_fail_unstable() : qdot_pool_check(pool);
}

/* The displacement of coordinate i, sum_a N_ia y_a, for amplitudes y of the unknowns. */
static qdot_expr
displacement(const qdot_modes_job *j, size_t i, const qdot_expr *y)
{
    const size_t m = j->m.n;
    qdot_expr x = QDOT_ZERO;

    for (size_t a = 0; a < m; a++)
        if (j->m.N[i * m + a] != QDOT_ZERO && y[a] != QDOT_ZERO)
            x = qdot_add(j->pool, x, qdot_mul(j->pool, j->m.N[i * m + a], y[a]));
    return x;
}

static qdot_expr
short_displacement(const qdot_modes_job *j, size_t i, const qdot_expr *y)
{
    return qdot_simplify(j->pool, displacement(j, i, y), &j->facts);
}

qdot_status
qdot_modes_add(qdot_modes_job *j, qdot_expr w, const qdot_expr *y)
{
    qdot_pool *pool = j->pool;
    qdot_expr first = QDOT_NIL;

    QDOT_TRY(qdot_vec_push(&j->frequency, w));
    for (size_t i = 0; i < j->s->coordinates.n; i++) {
        qdot_expr x = short_displacement(j, i, y);

        QDOT_TRY(qdot_pool_check(pool));
        if (first == QDOT_NIL && !qdot_modes_is_zero(j, x))
            first = x;
        if (first != QDOT_NIL)
            x = qdot_rationalize(pool, qdot_div(pool, x, first), &j->facts);
        QDOT_TRY(qdot_pool_check(pool));
        QDOT_TRY(qdot_vec_push(&j->amplitude, x));
    }
    return QDOT_OK;
}

qdot_status
qdot_modes_add_as_it_is(qdot_modes_job *j, qdot_expr w, const qdot_expr *y)
{
    QDOT_TRY(qdot_vec_push(&j->frequency, w));
    for (size_t i = 0; i < j->s->coordinates.n; i++)
        QDOT_TRY(qdot_vec_push(&j->amplitude, displacement(j, i, y)));
    return qdot_pool_check(j->pool);
}

/* (a + i b)/(c + i d) with by = [c, d]: a real expression, or a list [re, im]. */
static qdot_expr
complex_quotient(const qdot_modes_job *j, const qdot_expr *by, qdot_expr a, qdot_expr b)
{
    qdot_pool *pool = j->pool;
    const qdot_expr c = by[0], d = by[1];
    const qdot_expr square = qdot_add(pool, qdot_mul(pool, c, c), qdot_mul(pool, d, d));
    qdot_expr part[2] = {
        qdot_add(pool, qdot_mul(pool, a, c), qdot_mul(pool, b, d)),
        qdot_sub(pool, qdot_mul(pool, b, c), qdot_mul(pool, a, d)),
    };

    for (int k = 0; k < 2; k++)
        part[k] = qdot_rationalize(pool, qdot_simplify(pool, qdot_div(pool, part[k], square), &j->facts), &j->facts);
    return qdot_modes_is_zero(j, part[1]) ? part[0] : qdot_list(pool, 2, part);
}

qdot_status
qdot_modes_add_complex(qdot_modes_job *j, qdot_expr w, const qdot_expr *re, const qdot_expr *im)
{
    qdot_expr first[2] = {QDOT_ZERO, QDOT_ZERO};

    QDOT_TRY(qdot_vec_push(&j->frequency, w));
    for (size_t i = 0; i < j->s->coordinates.n; i++) {
        qdot_expr a = short_displacement(j, i, re), b = short_displacement(j, i, im);

        QDOT_TRY(qdot_pool_check(j->pool));
        if (first[0] == QDOT_ZERO && first[1] == QDOT_ZERO) {
            first[0] = qdot_modes_is_zero(j, a) ? QDOT_ZERO : a;
            first[1] = qdot_modes_is_zero(j, b) ? QDOT_ZERO : b;
        }
        a = first[0] == QDOT_ZERO && first[1] == QDOT_ZERO ? QDOT_ZERO : complex_quotient(j, first, a, b);
        QDOT_TRY(qdot_pool_check(j->pool));
        QDOT_TRY(qdot_vec_push(&j->amplitude, a));
    }
    return QDOT_OK;
}

/* --- order -------------------------------------------------------------------------------- */

/* Compare frequencies: *order is 1 if a <= b, -1 if a > b, by declared signs and assumptions; else 0. */
static qdot_status
frequency_order(const qdot_modes_job *j, qdot_expr a, qdot_expr b, int *order)
{
    qdot_pool *pool = j->pool;
    qdot_expr d = qdot_sub(pool, qdot_mul(pool, b, b), qdot_mul(pool, a, a));
    qdot_decision decision;
    uint8_t sign;

    d = qdot_simplify(pool, d, &j->facts);
    QDOT_TRY(qdot_pool_check(pool));
    sign = qdot_expr_node(pool, d)->sign;
    *order = sign & QDOT_GE0 ? 1 : sign & QDOT_LE0 ? -1 : 0;
    for (int way = 1; way >= -1 && *order == 0; way -= 2) {
        QDOT_TRY(qdot_decide_less(pool, way > 0 ? QDOT_ZERO : d, way > 0 ? d : QDOT_ZERO,
                                  false, &j->facts, &decision));
        if (decision.verdict == QDOT_PROVED)
            *order = way;
    }
    return QDOT_OK;
}

/* The order of a and b at the parameter values; parameters without value get a generic one. */
static int
compare_numerically(const qdot_modes_job *j, qdot_expr a, qdot_expr b)
{
    qdot_expr pair[2] = {a, b};
    double v[2];

    for (int k = 0; k < 2; k++)
        pair[k] = qdot_modes_bound(j, pair[k]);
    if (pair[0] == QDOT_NIL || pair[1] == QDOT_NIL ||
        qdot_generic_evaluate(j->pool, 2, pair, NULL, v) != QDOT_OK)
        return 1;
    return v[0] > v[1] + 1e-12 * fabs(v[1]) ? -1 : 1;
}

static void
exchange_modes(qdot_modes_job *j, size_t a, size_t b)
{
    size_t width = j->s->coordinates.n;
    qdot_expr keep = j->frequency.at[a];

    j->frequency.at[a] = j->frequency.at[b];
    j->frequency.at[b] = keep;
    for (size_t i = 0; i < width; i++) {
        keep = j->amplitude.at[a * width + i];
        j->amplitude.at[a * width + i] = j->amplitude.at[b * width + i];
        j->amplitude.at[b * width + i] = keep;
    }
}

/* Sort the modes by ascending frequency. */
static qdot_status
frequencies_sort(qdot_modes_job *j)
{
    for (size_t a = 1; a < j->frequency.n; a++)
        for (size_t b = a; b > 0; b--) {
            qdot_expr left = j->frequency.at[b - 1], right = j->frequency.at[b];
            int order = 1;

            if (j->numeric)
                order = compare_numerically(j, left, right);
            else if (left != right)
                QDOT_TRY(frequency_order(j, left, right, &order));
            if (order == 0) {
                j->unordered = true;
                order = compare_numerically(j, left, right);
            }
            if (order > 0)
                break;
            exchange_modes(j, b - 1, b);
        }
    return QDOT_OK;
}

/* --- modes, exact or numerical ------------------------------------------------------------- */

void
qdot_modes_clear(qdot_modes *m)
{
    qdot_free(m->frequency);
    qdot_free(m->amplitude);
    *m = (qdot_modes){0};
}

/* The linear motion about the place, to j->m: where the forces have values but no slopes, as -x^(1/2) at 0, there is
 * none. */
static qdot_status
modes_linearise(qdot_modes_job *j, qdot_expr equations)
{
    qdot_status status = qdot_linear_motion_about(j->s, equations, QDOT_NIL, &j->m);

    for (size_t i = 0; i < j->s->coordinates.n && status == QDOT_EDOMAIN; i++) {
        (void)qdot_rest_value(j->s, equations, qdot_motion_residual(j->s, i));
        QDOT_TRY(qdot_pool_check(j->pool)); /* fails if the equations have no value at the equilibrium */
    }
    if (status != QDOT_EDOMAIN)
        return status;
    return qdot_fail(QDOT_ETYPE, "the forces have no slopes at the equilibrium: there is no linear motion about it, so "
                                 "it has no normal modes");
}

/* Velocity constraints bind displacements as positions do, G x' = 0, so that x moves in the tangent space of G at the
 * place. Refuse those that depend on positions alone at rest, and those of accelerations. */
static qdot_status
check_constraints(qdot_modes_job *j)
{
    qdot_scene *s = j->s;
    bool holonomic;

    QDOT_TRY(qdot_mech_is_holonomic(s, &holonomic));
    j->bound_by_velocities = !holonomic;
    for (size_t k = 0; k < s->constraints.n && !holonomic; k++) {
        const qdot_constraint *c = &s->constraints.at[k];

        if (c->kind == QDOT_ACCELERATION)
            return qdot_fail(QDOT_ETYPE, "normal modes need constraints of positions or velocities, not of accelerations "
                                         "as %.100s", c->name);
        if (c->kind == QDOT_HOLONOMIC)
            continue;
        if (!qdot_modes_is_zero(j, qdot_rest_value(s, qdot_list(j->pool, 0, NULL), c->f)))
            return qdot_fail(QDOT_ETYPE, "normal modes need constraints that hold at rest everywhere: %.100s has terms "
                                         "without velocities", c->name);
    }
    return qdot_pool_check(j->pool);
}

qdot_status
qdot_modes_about(qdot_scene *s, qdot_expr equations, bool numbers, qdot_binder bind,
                 void *user, qdot_modes *out)
{
    qdot_modes_job j = {.s = s,
                        .pool = s->pool,
                        .facts = qdot_scene_facts(s),
                        .bind = bind,
                        .user = user};
    bool done = false;
    qdot_status status;

    *out = (qdot_modes){0};
    QDOT_TRY(qdot_scene_need_no_states(s, "modes"));
    QDOT_TRY(check_constraints(&j));
    QDOT_TRY(modes_linearise(&j, equations));
    status = check_is_equilibrium(&j, equations);
    if (status == QDOT_OK)
        status = check_linear_motion(&j);
    if (status == QDOT_OK)
        status = check_smooth(&j, equations);
    if (status == QDOT_OK && !numbers)
        status = j.gyroscopic ? qdot_modes_gyroscopic(&j, &done) : qdot_modes_exact(&j, &done);
    if (status == QDOT_OK && !done) {
        j.frequency.n = j.amplitude.n = 0;
        status = qdot_modes_in_numbers(&j);
    }
    if (status == QDOT_OK)
        status = frequencies_sort(&j);
    qdot_linear_motion_clear(&j.m);
    out->n = j.frequency.n;
    out->frequency = j.frequency.at;
    out->amplitude = j.amplitude.at;
    out->numeric = j.numeric;
    out->unordered = j.unordered;
    if (status != QDOT_OK)
        qdot_modes_clear(out);
    return status;
}
