/* energy.c -- T, V, L and the Jacobi energy h = sum p q' - L.
 *
 * By Lagrange's equations
 *
 *     dh/dt = -dL/dt + sum (Q_i + R_i) q_i'
 *
 * with Q what is applied beside V and R the reactions, so h is conserved when dL/dt and
 * the power of Q vanish and every constraint works at no power: f (q, t) = 0 at -lambda
 * df/dt, f(q, q', t) = 0 at lambda sum df/dq' q', f(q'') at lambda sum df/dq'' q'.
 */
#include "expr/calculus.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "mech/dynamics/squares.h"
#include "mech/scene/derived.h"
#include "normal/form/common.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"

qdot_expr
qdot_link_square(qdot_scene *s, bool damper, size_t k)
{
    qdot_derived *d = qdot_derived_get(s);
    qdot_expr **cache = damper ? &d->square_damper : &d->square_spring;
    const qdot_link *link = damper ? &s->dampers.at[k] : &s->springs.at[k];
    qdot_expr u;

    if (!qdot_derived_array(s, cache, damper ? s->dampers.n : s->springs.n))
        return QDOT_NIL;
    if ((*cache)[k] == QDOT_NIL) {
        u = qdot_value_sub(s->pool, link->at[0], link->at[1]);
        (*cache)[k] = qdot_mech_tidy(s, qdot_mech_dot(s->pool, u, u));
    }
    return (*cache)[k];
}

/* k/2 (d - rest)^2, without a root where rest = 0. */
qdot_expr
qdot_spring_potential(qdot_scene *s, size_t k)
{
    qdot_pool *pool = s->pool;
    const qdot_link *spring = &s->springs.at[k];
    qdot_expr square = qdot_link_square(s, false, k);

    if (spring->rest != QDOT_ZERO)
        square =
            qdot_pow_int(pool, qdot_sub(pool, qdot_sqrt(pool, square), spring->rest), 2);
    return qdot_mul(pool, QDOT_HALF, qdot_mul(pool, spring->stiffness, square));
}

qdot_expr
qdot_potential_with_velocities(qdot_scene *s)
{
    qdot_expr V = QDOT_ZERO;

    for (size_t i = 0; i < s->potentials.n; i++)
        if (qdot_mech_holds(s, s->potentials.at[i].e) & QDOT_HAS_VELOCITY)
            V = qdot_add(s->pool, V, s->potentials.at[i].e);
    return V;
}

qdot_expr
qdot_potential_but_gravity(qdot_scene *s)
{
    qdot_expr V = QDOT_ZERO;

    for (size_t i = 0; i < s->potentials.n; i++)
        V = qdot_add(s->pool, V, s->potentials.at[i].e);
    for (size_t i = 0; i < s->springs.n; i++)
        V = qdot_add(s->pool, V, qdot_spring_potential(s, i));
    return V;
}

/* V before simplification. */
static qdot_expr
raw_potential(qdot_scene *s)
{
    qdot_pool *pool = s->pool;
    qdot_expr V = QDOT_ZERO;

    if (s->gravities.n) {
        qdot_kinematics *k = qdot_kinematics_get(s);
        const qdot_groups *place = k ? qdot_kinematics_place(s, k) : NULL;

        if (!place)
            return QDOT_NIL;
        V = qdot_neg(pool, qdot_kinematics_gravity(s, k, place));
    }
    return qdot_add(pool, V, qdot_potential_but_gravity(s));
}

/* 1/2 sum M_ij q_i' q_j', scaled terms in order. */
static qdot_expr
quadratic_part(qdot_scene *s)
{
    size_t n = s->coordinates.n, m = 0;
    qdot_expr *terms = qdot_calloc(n * (n + 1) / 2 + 1, sizeof *terms), sum;

    if (!terms)
        return qdot_pool_fail(s->pool);
    for (size_t i = 0; i < n; i++)
        for (size_t j = i; j < n; j++) {
            qdot_expr e = qdot_mass_entry(s, i, j);

            if (e == QDOT_ZERO)
                continue;
            e = qdot_mul(
                s->pool, e,
                qdot_mul(s->pool, qdot_mech_jet(s, i, 1), qdot_mech_jet(s, j, 1)));
            terms[m++] = i == j ? qdot_mul(s->pool, QDOT_HALF, e) : e;
        }
    sum = qdot_sum(s->pool, m, terms);
    qdot_free(terms);
    return sum;
}

static qdot_expr
linear_part(qdot_scene *s)
{
    qdot_expr sum = QDOT_ZERO;

    for (size_t i = 0; i < s->coordinates.n; i++)
        if (s->derived->b[i] != QDOT_ZERO)
            sum = qdot_add(s->pool, sum,
                           qdot_mul(s->pool, s->derived->b[i], qdot_mech_jet(s, i, 1)));
    return sum;
}

/* 1/2 q'.M q' with the coupled pairs and triples of velocities that make it worth while as squares;
 * nil where there are none. */
static qdot_expr
quadratic_by_squares(qdot_scene *s)
{
    enum { MOST_COORDINATES = 24, MOST_OPERATIONS = 80 };
    qdot_pool *pool = s->pool;
    size_t n = s->coordinates.n, block[MOST_COORDINATES];
    const qdot_expr *M = s->derived->M;
    qdot_expr sum = QDOT_NIL;
    bool any = false, done;
    qdot_squares q;

    if (n < 2 || n > MOST_COORDINATES)
        return QDOT_NIL;
    qdot_squares_blocks(n, M, block);
    qdot_squares_begin(&q, s);
    for (size_t i = 0; i < n; i++) {
        qdot_expr A[9], v[3];
        size_t which[3], m = 0, size = 0;

        for (size_t k = i; k < n && block[i] == i; k++)
            if (block[k] == i) {
                if (m < 3)
                    which[m] = k;
                m++;
            }
        for (size_t a = 0; a < m && m <= 3; a++) {
            v[a] = qdot_mech_jet(s, which[a], 1);
            for (size_t b = 0; b < m; b++) {
                A[a * m + b] = M[which[a] * n + which[b]];
                size += qdot_expr_size(pool, A[a * m + b]);
            }
        }
        if (m > 3 || size > MOST_OPERATIONS)
            goto out;
        if (m == 1 && A[0] != QDOT_ZERO && qdot_squares_add(&q, A[0], v[0]) != QDOT_OK)
            goto out;
        if (m > 1) {
            if (!qdot_squares_worth(s, m, A) ||
                qdot_squares_complete(&q, m, A, v, &done) != QDOT_OK || !done)
                goto out;
            any = true;
        }
    }
    if (any)
        sum = qdot_squares_sum(&q);
out:
    qdot_squares_clear(&q);
    return sum;
}

/* T by degrees in velocities where that is shorter: m*W*(x*y' - y*x') + 1/2*m*(x'^2 + y'^2). */
static qdot_expr
or_degrees(qdot_scene *s, qdot_expr T)
{
    qdot_expr b = qdot_mech_tidy_whole(s, linear_part(s)), sum;

    if (b == QDOT_ZERO || b == QDOT_NIL || T == QDOT_NIL)
        return T;
    sum = qdot_common_out(s->pool, qdot_mech_tidy_whole(s, quadratic_part(s)));
    sum = qdot_add(s->pool, sum, qdot_add(s->pool, b, qdot_mech_tidy(s, s->derived->c)));
    return qdot_expr_size(s->pool, sum) < qdot_expr_size(s->pool, T) ? sum : T;
}

/* T with this sum of squares where that is shorter; others: the terms that are none. */
static qdot_expr
or_squares(qdot_scene *s, qdot_expr T, qdot_expr others)
{
    qdot_expr squares = quadratic_by_squares(s);

    if (squares == QDOT_NIL || T == QDOT_NIL)
        return T;
    squares = qdot_add(s->pool, squares, qdot_mech_tidy(s, others));
    return qdot_expr_size(s->pool, squares) < qdot_expr_size(s->pool, T) ? squares : T;
}

qdot_expr
qdot_mech_kinetic(qdot_scene *s)
{
    qdot_derived *d = qdot_derived_get(s);
    qdot_expr T, others;

    if (d->kinetic != QDOT_NIL)
        return d->kinetic;
    if (!qdot_mech_needs_particles(s, "T") || !qdot_mass_get(s))
        return QDOT_NIL;
    others = qdot_add(s->pool, linear_part(s), d->c);
    T = qdot_add(s->pool, quadratic_part(s), others);
    T = qdot_common_out(s->pool, qdot_mech_tidy_whole(s, T));
    return d->kinetic = or_squares(s, or_degrees(s, T), others);
}

qdot_expr
qdot_mech_potential(qdot_scene *s)
{
    qdot_derived *d = qdot_derived_get(s);
    qdot_expr V;

    if (d->potential != QDOT_NIL)
        return d->potential;
    if (!qdot_mech_needs_particles(s, "V"))
        return QDOT_NIL;
    V = qdot_mech_tidy(s, raw_potential(s));
    return d->potential = V;
}

qdot_expr
qdot_mech_lagrangian(qdot_scene *s)
{
    qdot_expr T, V;

    if (qdot_mech_stated(s))
        return s->lagrangian;
    T = qdot_mech_kinetic(s);
    V = qdot_mech_potential(s);
    return qdot_sub(s->pool, T, V);
}

enum { MOST_ADDED = 2000 };

/* Terms of e, multiplied out. */
static uint32_t
terms(qdot_pool *pool, qdot_expr e)
{
    e = e == QDOT_NIL ? e : qdot_expand(pool, e);
    if (e == QDOT_NIL || e == QDOT_ZERO)
        return 0;
    if (qdot_expr_kind(pool, e) != QDOT_SUM)
        return 1;
    return (qdot_expr_count(pool, e) - 1) / 2 + (qdot_expr_arg(pool, e, 0) != QDOT_ZERO);
}

/* h as a person adds it up: the part of T of second degree, less that of none, and V; nil where
 * some of it cancels. */
static qdot_expr
energy_by_parts(qdot_scene *s)
{
    qdot_pool *pool = s->pool;
    qdot_expr T = qdot_common_out(pool, qdot_mech_tidy_whole(s, quadratic_part(s)));
    qdot_expr V = raw_potential(s), c = qdot_derived_get(s)->c;

    if (V == QDOT_NIL || (qdot_mech_holds(s, V) & QDOT_HAS_VELOCITY))
        return QDOT_NIL;
    T = or_squares(s, T, QDOT_ZERO);
    c = qdot_neg(pool, qdot_mech_tidy(s, c));
    V = qdot_mech_tidy(s, V);
    if (c != QDOT_ZERO && qdot_expr_size(pool, V) < MOST_ADDED &&
        terms(pool, qdot_add(pool, c, V)) < terms(pool, c) + terms(pool, V))
        return QDOT_NIL;
    return qdot_add(pool, T, qdot_add(pool, c, V));
}

qdot_expr
qdot_mech_energy(qdot_scene *s)
{
    qdot_pool *pool = s->pool;
    qdot_derived *d = qdot_derived_get(s);
    qdot_expr F, h;

    if (d->energy != QDOT_NIL)
        return d->energy;
    /* Of F = L or -V: sum q' dF/dq' - F; of T: its quadratic part less c. */
    F = qdot_mech_stated(s) ? s->lagrangian : qdot_neg(pool, raw_potential(s));
    h = qdot_neg(pool, F);
    if (qdot_mech_holds(s, F) & QDOT_HAS_VELOCITY)
        for (size_t i = 0; i < s->coordinates.n; i++) {
            qdot_expr v = qdot_mech_jet(s, i, 1);

            h = qdot_add(pool, h, qdot_mul(pool, v, qdot_diff(pool, F, v)));
        }
    if (!qdot_mech_stated(s)) {
        if (!qdot_mass_get(s))
            return QDOT_NIL;
        h = qdot_add(pool, h, qdot_sub(pool, quadratic_part(s), qdot_derived_get(s)->c));
    }
    h = qdot_mech_tidy_whole(s, h);
    F = qdot_mech_stated(s) ? QDOT_NIL : energy_by_parts(s);
    if (F != QDOT_NIL)
        h = F;
    return d->energy = h;
}

/* --- slopes of L ----------------------------------------------------------------------
 * */

/* Whether t stands in anything that L is made of: seen before M is derived. */
static bool
time_stands(qdot_scene *s)
{
    const qdot_kinematics *k = qdot_kinematics_get(s);
    uint32_t holds = qdot_mech_holds(s, qdot_potential_but_gravity(s));

    for (size_t p = 0; k && p < k->terms.n; p++)
        holds |= qdot_mech_holds(s, k->terms.at[p].w) | qdot_mech_holds(s, k->terms.at[p].x)
                 | qdot_mech_holds(s, k->terms.at[p].y);
    for (size_t i = 0; i < s->gravities.n; i++)
        holds |= qdot_mech_holds(s, s->gravities.at[i].e);
    return (holds & QDOT_HAS_TIME) != 0;
}

bool
qdot_lagrangian_has(qdot_scene *s, qdot_expr x, bool *has)
{
    qdot_expr V;

    if (qdot_mech_stated(s)) {
        *has = qdot_expr_contains(s->pool, s->lagrangian, x);
        return !qdot_pool_failed(s->pool);
    }
    *has = false;
    if (x == QDOT_T && !time_stands(s))
        return !qdot_pool_failed(s->pool);
    if (!qdot_mass_get(s))
        return false;
    for (size_t i = 0; i < s->coordinates.n && !*has; i++) {
        const qdot_symbol *symbol = qdot_expr_symbol(s->pool, x);

        if (symbol->class == QDOT_COORD && symbol->order == 1) {
            size_t j;

            if (!qdot_derived_index(s, symbol->base, &j))
                return false;
            *has |=
                qdot_mass_entry(s, i, j) != QDOT_ZERO || s->derived->b[j] != QDOT_ZERO;
            continue;
        }
        for (size_t j = i; j < s->coordinates.n && !*has; j++)
            *has = qdot_expr_contains(s->pool, qdot_mass_entry(s, i, j), x);
        *has = *has || qdot_expr_contains(s->pool, s->derived->b[i], x);
    }
    if (*has)
        return !qdot_pool_failed(s->pool);
    V = raw_potential(s);
    if (V == QDOT_NIL)
        return false;
    *has = qdot_expr_contains(s->pool, s->derived->c, x) ||
           qdot_expr_contains(s->pool, V, x);
    return !qdot_pool_failed(s->pool);
}

qdot_expr
qdot_lagrangian_slope(qdot_scene *s, qdot_expr x)
{
    qdot_pool *pool = s->pool;
    qdot_expr T;

    if (qdot_mech_stated(s))
        return qdot_diff(pool, s->lagrangian, x);
    if (!qdot_mass_get(s))
        return QDOT_NIL;
    T = qdot_add(pool, quadratic_part(s),
                 qdot_add(pool, linear_part(s), qdot_derived_get(s)->c));
    return qdot_sub(pool, qdot_diff(pool, T, x), qdot_diff(pool, raw_potential(s), x));
}

static bool
is_still(qdot_scene *s, qdot_expr e, qdot_expr x, const qdot_facts *facts)
{
    e = qdot_diff(s->pool, e, x);
    return e == QDOT_ZERO || qdot_is_zero(s->pool, e, facts);
}

bool
qdot_lagrangian_is_still(qdot_scene *s, qdot_expr x)
{
    const qdot_facts facts = qdot_scene_facts(s);
    bool has;

    if (!qdot_lagrangian_has(s, x, &has))
        return false;
    if (!has)
        return true;
    if (qdot_mech_stated(s) || qdot_potential_with_velocities(s) != QDOT_ZERO)
        return qdot_is_zero(s->pool, qdot_lagrangian_slope(s, x), &facts);
    /* velocities stand beside the entries of M and b alone: each slope has to vanish, and
     * most often the first that has one does not */
    for (size_t i = 0; i < s->coordinates.n; i++)
        for (size_t j = i; j < s->coordinates.n; j++)
            if (!is_still(s, qdot_mass_entry(s, i, j), x, &facts))
                return false;
    for (size_t i = 0; i < s->coordinates.n; i++)
        if (!is_still(s, qdot_derived_get(s)->b[i], x, &facts))
            return false;
    return is_still(s, qdot_sub(s->pool, qdot_derived_get(s)->c, raw_potential(s)), x,
                    &facts);
}

/* --- conservation ---------------------------------------------------------------------
 * */

/* -dL/dt + sum Q q', Q what is applied beside V. */
static qdot_expr
applied_power(qdot_scene *s)
{
    qdot_pool *pool = s->pool;
    qdot_expr power = QDOT_ZERO;
    bool has;

    if (!qdot_lagrangian_has(s, QDOT_T, &has))
        return QDOT_NIL;
    if (has)
        power = qdot_neg(pool, qdot_lagrangian_slope(s, QDOT_T));
    for (size_t i = 0; i < s->coordinates.n; i++) {
        qdot_expr Q = qdot_force_total(s, i, false, true);

        power = qdot_add(pool, power, qdot_mul(pool, Q, qdot_mech_jet(s, i, 1)));
    }
    return power;
}

static qdot_expr
constraint_power(qdot_scene *s, size_t k)
{
    qdot_pool *pool = s->pool;
    qdot_expr power = QDOT_ZERO;

    if (s->constraints.at[k].kind == QDOT_HOLONOMIC)
        return qdot_diff(pool, s->constraints.at[k].f, QDOT_T);
    for (size_t i = 0; i < s->coordinates.n; i++)
        power = qdot_add(
            pool, power,
            qdot_mul(pool, qdot_constraint_slope(s, k, i), qdot_mech_jet(s, i, 1)));
    return power;
}

/* dh/dt, with the multipliers' symbols. */
static qdot_expr
energy_rate(qdot_scene *s)
{
    qdot_expr rate = applied_power(s);

    for (size_t k = 0; k < s->constraints.n; k++) {
        qdot_expr power = constraint_power(s, k);

        if (s->constraints.at[k].kind == QDOT_HOLONOMIC)
            power = qdot_neg(s->pool, power); /* q' df/dq = -df/dt */
        rate = qdot_add(s->pool, rate,
                        qdot_mul(s->pool, s->constraints.at[k].multiplier, power));
    }
    return rate;
}

/* dp/dt of coordinate i, likewise. */
static qdot_expr
momentum_rate(qdot_scene *s, size_t i)
{
    qdot_pool *pool = s->pool;

    return qdot_sum(pool, 3,
                    (qdot_expr[]){qdot_lagrangian_slope(s, s->coordinates.at[i]),
                                  qdot_force_total(s, i, false, true),
                                  qdot_constraint_reaction(s, i)});
}

static bool
is_free_of_velocities(qdot_scene *s, qdot_expr e)
{
    return e != QDOT_NIL && (qdot_mech_holds(s, e) & (QDOT_HAS_VELOCITY |
                                                      QDOT_HAS_ACCELERATION)) == 0;
}

/* E less a quantity whose rate needs no accelerations: what is left, free of velocities; else
 * nil. */
static qdot_expr
rest_beside(qdot_scene *s, qdot_expr E, qdot_expr known)
{
    const qdot_facts facts = qdot_scene_facts(s);
    qdot_expr rest = E == known ? QDOT_ZERO : qdot_sub(s->pool, E, known);

    if (is_free_of_velocities(s, rest))
        return rest;
    rest = qdot_simplify(s->pool, rest, &facts);
    return is_free_of_velocities(s, rest) ? rest : QDOT_NIL;
}

qdot_expr
qdot_mech_rate(qdot_scene *s, qdot_expr E)
{
    qdot_expr rest;

    if (is_free_of_velocities(s, E))
        return qdot_ddt(s->pool, E);
    rest = rest_beside(s, E, qdot_mech_energy(s));
    if (rest != QDOT_NIL)
        return qdot_add(s->pool, energy_rate(s), qdot_ddt(s->pool, rest));
    for (size_t i = 0; i < s->coordinates.n && !qdot_pool_failed(s->pool); i++) {
        rest = rest_beside(s, E, qdot_mech_momentum(s, s->coordinates.at[i]));
        if (rest != QDOT_NIL)
            return qdot_add(s->pool, momentum_rate(s, i), qdot_ddt(s->pool, rest));
    }
    return QDOT_NIL;
}

qdot_status
qdot_mech_energy_conserved(qdot_scene *s, bool *conserved)
{
    qdot_pool *pool = s->pool;
    qdot_derived *d = qdot_derived_get(s);
    qdot_facts facts = qdot_scene_facts(s), on_manifold = facts;
    qdot_expr *relations = NULL, power;
    qdot_status status = qdot_pool_check(pool);

    QDOT_TRY(status);
    *conserved = d->conserved;
    if (d->conserved_known)
        return QDOT_OK;
    if (s->constraints.n)
        status = qdot_constraint_facts(s, &relations, &on_manifold);
    if (status == QDOT_OK) {
        power = applied_power(s);
        *conserved = power != QDOT_NIL &&
                     (qdot_is_zero(pool, power, &facts) ||
                      (s->constraints.n && qdot_is_zero(pool, power, &on_manifold)));
        for (size_t k = 0; k < s->constraints.n && *conserved; k++) {
            qdot_expr f = s->constraints.at[k].f;

            /* Linear and homogeneous in q', its power is f itself. */
            power = constraint_power(s, k);
            *conserved = power != QDOT_NIL &&
                         (qdot_is_zero(pool, power, &facts) ||
                          qdot_is_zero(pool, qdot_sub(pool, power, f), &facts) ||
                          qdot_is_zero(pool, power, &on_manifold));
        }
        status = qdot_pool_check(pool);
    }
    qdot_free(relations);
    if (status == QDOT_OK) {
        d = qdot_derived_get(s);
        d->conserved_known = true;
        d->conserved = *conserved;
    }
    return status;
}
