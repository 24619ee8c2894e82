/* energy.c -- the kinetic energy T, the Lagrangian L, the energy function h = sum p q' - L, and derivatives of L. */
#include "mech/dynamics/energy.h"

#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/dynamics/kinematics.h"

#include "expr/calculus.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "mech/dynamics/mass-matrix.h"
#include "mech/dynamics/potential.h"
#include "mech/dynamics/ostrogradsky.h"
#include "mech/dynamics/quantity.h"
#include "mech/dynamics/squares.h"
#include "mech/scene/access.h"
#include "mech/scene/cache.h"
#include "normal/form/common.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"

/* The quadratic part of T: 1/2 sum M_ij q_i' q_j', with common factors, in canonical order. */
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
quadratic_part_by_squares(qdot_scene *s)
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

/* T grouped by degree in velocities, as m*W*(x*y' - y*x') + 1/2*m*(x'^2 + y'^2), if that is shorter; else T. */
static qdot_expr
shorter_by_degree(qdot_scene *s, qdot_expr T)
{
    qdot_expr b = qdot_mech_tidy_whole(s, linear_part(s)), sum;

    if (b == QDOT_ZERO || b == QDOT_NIL || T == QDOT_NIL)
        return T;
    sum = qdot_common_out(s->pool, qdot_mech_tidy_whole(s, quadratic_part(s)));
    sum = qdot_add(s->pool, sum, qdot_add(s->pool, b, qdot_mech_tidy(s, s->derived->c)));
    return qdot_expr_size(s->pool, sum) < qdot_expr_size(s->pool, T) ? sum : T;
}

/* T with part of it written as a sum of squares, if that is shorter, else T; others: the remaining terms. */
static qdot_expr
shorter_by_squares(qdot_scene *s, qdot_expr T, qdot_expr others)
{
    qdot_expr squares = quadratic_part_by_squares(s);

    if (squares == QDOT_NIL || T == QDOT_NIL)
        return T;
    squares = qdot_add(s->pool, squares, qdot_mech_tidy(s, others));
    return qdot_expr_size(s->pool, squares) < qdot_expr_size(s->pool, T) ? squares : T;
}

qdot_expr
qdot_mech_numeric_kinetic(qdot_scene *s)
{
    if (!qdot_mass_get(s))
        return QDOT_NIL;
    return qdot_add(s->pool, quadratic_part(s),
                    qdot_add(s->pool, linear_part(s), qdot_derived_get(s)->c));
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
    return d->kinetic = shorter_by_squares(s, shorter_by_degree(s, T), others);
}

qdot_expr
qdot_mech_lagrangian(qdot_scene *s)
{
    qdot_expr T, V;

    if (s->higher_lagrangian != QDOT_NIL)
        return s->higher_lagrangian;
    if (qdot_mech_stated(s))
        return s->lagrangian;
    T = qdot_mech_kinetic(s);
    V = qdot_mech_potential(s);
    return qdot_sub(s->pool, T, V);
}

enum { MOST_ADDED = 2000 };

/* The number of terms that e has when it is multiplied out. */
static uint32_t
expanded_terms(qdot_pool *pool, qdot_expr e)
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
sum_energy_parts(qdot_scene *s)
{
    qdot_pool *pool = s->pool;
    qdot_expr T = qdot_common_out(pool, qdot_mech_tidy_whole(s, quadratic_part(s)));
    qdot_expr V = qdot_potential_raw(s), c = qdot_derived_get(s)->c;

    if (V == QDOT_NIL || (qdot_mech_holds(s, V) & QDOT_HAS_VELOCITY))
        return QDOT_NIL;
    T = shorter_by_squares(s, T, QDOT_ZERO);
    c = qdot_neg(pool, qdot_mech_tidy(s, c));
    V = qdot_mech_tidy(s, V);
    if (c != QDOT_ZERO && qdot_expr_size(pool, V) < MOST_ADDED &&
        expanded_terms(pool, qdot_add(pool, c, V)) < expanded_terms(pool, c) + expanded_terms(pool, V))
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
    if (s->higher.n > 0)
        return d->energy = qdot_ostrogradsky_energy(s);
    /* with F = L or -V: h = sum q' dF/dq' - F; and from T its quadratic part minus its constant part */
    F = qdot_mech_stated(s) ? s->lagrangian : qdot_neg(pool, qdot_potential_raw(s));
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
    F = qdot_mech_stated(s) ? QDOT_NIL : sum_energy_parts(s);
    if (F != QDOT_NIL)
        h = F;
    return d->energy = h;
}

/* --- slopes of L ---------------------------------------------------------------------- */

/* Whether L contains t explicitly, judged by positions, fields and masses, before the mass matrix is computed. */
static bool
contains_time(qdot_scene *s)
{
    qdot_kinematics k = {0};
    uint32_t holds = qdot_mech_holds(s, qdot_potential_but_gravity(s));

    if (qdot_kinematics_terms(s, &k) != QDOT_OK)
        qdot_pool_fail(s->pool);
    for (size_t p = 0; p < k.terms.n; p++)
        holds |= qdot_mech_holds(s, k.terms.at[p].w) | qdot_mech_holds(s, k.terms.at[p].x)
                 | qdot_mech_holds(s, k.terms.at[p].y);
    qdot_free(k.terms.at);
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
    if (x == QDOT_T && !contains_time(s))
        return !qdot_pool_failed(s->pool);
    if (!qdot_mass_get(s))
        return false;
    for (size_t i = 0; i < s->coordinates.n && !*has; i++) {
        const qdot_symbol *symbol = qdot_expr_symbol(s->pool, x);

        if (symbol->class == QDOT_COORD && symbol->order == 1) {
            size_t j;

            if (!qdot_mech_index(s, symbol->base, &j))
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
    V = qdot_potential_raw(s);
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
    T = qdot_mech_numeric_kinetic(s);
    if (T == QDOT_NIL)
        return QDOT_NIL;
    return qdot_sub(pool, qdot_diff(pool, T, x), qdot_diff(pool, qdot_potential_raw(s), x));
}

static bool
is_independent_of(qdot_scene *s, qdot_expr e, qdot_expr x, const qdot_facts *facts)
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
            if (!is_independent_of(s, qdot_mass_entry(s, i, j), x, &facts))
                return false;
    for (size_t i = 0; i < s->coordinates.n; i++)
        if (!is_independent_of(s, qdot_derived_get(s)->b[i], x, &facts))
            return false;
    return is_independent_of(s, qdot_sub(s->pool, qdot_derived_get(s)->c, qdot_potential_raw(s)), x,
                             &facts);
}
