/* stability-corners.c -- whether a scene stays near a corner of its potential, of several coordinates.
 *
 * Let the potential V have kinks where u_k(q) = 0, with a_k = du_k/dq at the place q0: the forces F hold s_k = sign(u_k).
 * Its derivative in a direction d at q0,
 *
 *     V'(d) = -sum_i F_i(q0, s) d_i,   s_k = sign(a_k . d),
 *
 * is linear in each cell of the arrangement of planes a_k . d = 0, so it is positive in all directions across them, those
 * with a_k . d != 0 for some k, if it is positive along the rays in which the planes meet. Then
 *
 *     V(q) >= V(q') + c |u(q)|,   c > 0,
 *
 * q' a place where all u_k = 0: V has a strict minimum at q0 if it has one among those. By an energy that does not grow
 * the rest is stable (Lagrange's theorem). Where V'(d) < 0 the motion that begins along the direction of steepest descent,
 * q0 + c d t^2/2, leaves the place.
 *
 * Source  A. S. Lewis, Active sets, nonsmoothness, and sensitivity, SIAM J. Optim. 13 (2002) 702 (sharpness).
 * Tests   tests/mech/study/test_stability.c
 */
#include <stdio.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/mass-matrix.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/study/stability-parts.h"
#include "normal/prove/decide.h"
#include "normal/simplify/positive.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/conditions.h"
#include "normal/solve/null-space.h"

enum { MOST_COORDINATES = 5, MOST_KINKS = 6 };

typedef struct {
    qdot_judgement *j;
    qdot_equilibrium *e;
    qdot_pool *pool;
    size_t n, m;                               /* numbers of coordinates and of kinks */
    qdot_expr u[MOST_KINKS], s[MOST_KINKS]; /* for each kink: the expression that is 0 there, and a symbol for its sign */
    qdot_expr a[MOST_KINKS * MOST_COORDINATES];
    qdot_expr F[MOST_COORDINATES]; /* generalized forces near the place, in terms of these symbols */
    qdot_expr there[MOST_COORDINATES];         /* generalized forces exactly at the place */
    bool rough;                                /* whether derivatives of the forces jump, too */
} corner;

/* --- kinks of the forces -------------------------------------------------------------------- */

static qdot_expr
value_at_equilibrium(const corner *c, qdot_expr e)
{
    return qdot_simplify(c->pool, qdot_rest_value(c->j->s, c->e->equations, e), &c->j->facts);
}

/* Find the kinks of the forces at the equilibrium; *known: all of them are of a kind that this file can treat. */
static qdot_status
find_kinks(corner *c, bool *known)
{
    qdot_expr forces = c->j->judge->by_signs;
    qdot_status status = QDOT_OK;
    qdot_walk w;

    *known = true;
    QDOT_TRY(qdot_walk_begin(c->pool, forces, &w));
    for (size_t i = 0; i < w.n && *known && status == QDOT_OK; i++) {
        uint32_t op = qdot_expr_node(c->pool, w.at[i])->op;
        qdot_expr u;

        if (qdot_expr_kind(c->pool, w.at[i]) != QDOT_FUN || !qdot_stability_has_kink(op) ||
            (qdot_mech_holds(c->j->s, w.at[i]) & QDOT_HAS_COORD) == 0)
            continue;
        u = qdot_expr_arg(c->pool, w.at[i], 0);
        *known = op == QDOT_ABS || op == QDOT_SIGN;
        if (!*known || !qdot_is_zero(c->pool, qdot_rest_value(c->j->s, c->e->equations, u), &c->j->facts))
            continue;
        if (op == QDOT_ABS) {
            c->rough = true;
            continue;
        }
        *known = c->m < MOST_KINKS;
        if (*known)
            c->u[c->m++] = u;
        status = qdot_pool_check(c->pool);
    }
    qdot_walk_end(&w);
    return status;
}

/* Replace the signs in the forces by the symbols of their kinks. */
static qdot_status
replace_signs_by_symbols(corner *c)
{
    qdot_expr list = c->j->judge->by_signs, from[MOST_KINKS];

    for (size_t k = 0; k < c->m; k++)
        from[k] = qdot_fun1(c->pool, QDOT_SIGN, c->u[k]);
    list = c->m == 0 ? list : qdot_subs(c->pool, list, c->m, from, c->s);
    QDOT_TRY(qdot_pool_check(c->pool));
    for (size_t i = 0; i < c->n; i++) {
        c->F[i] = qdot_expr_arg(c->pool, list, (uint32_t)i);
        c->there[i] = value_at_equilibrium(c, c->F[i]);
    }
    return qdot_pool_check(c->pool);
}

/* Compute the forces with symbols in place of signs; drop kinks at which no force jumps. */
static qdot_status
compute_forces(corner *c)
{
    size_t kept = 0;

    for (size_t k = 0; k < c->m; k++) {
        char name[40];

        snprintf(name, sizeof name, "(side of kink %zu)", k + 1);
        c->s[k] = qdot_symbol_get(c->pool, QDOT_FORMAL, name);
    }
    QDOT_TRY(replace_signs_by_symbols(c));
    for (size_t k = 0; k < c->m; k++) {
        bool jumps = false;

        for (size_t i = 0; i < c->n; i++)
            jumps = jumps || qdot_expr_contains(c->pool, c->there[i], c->s[k]);
        c->rough = c->rough || !jumps;
        if (!jumps)
            continue;
        c->u[kept] = c->u[k];
        c->s[kept++] = c->s[k];
    }
    c->m = kept;
    return replace_signs_by_symbols(c);
}

/* Compute the gradients of the kink functions u_k; *known: all are numbers, and none is 0. */
static qdot_status
compute_kink_gradients(corner *c, bool *known)
{
    *known = true;
    for (size_t k = 0; k < c->m; k++) {
        bool zero = true;

        for (size_t i = 0; i < c->n; i++) {
            qdot_expr a = value_at_equilibrium(c, qdot_diff(c->pool, c->u[k], c->j->s->coordinates.at[i]));

            QDOT_TRY(qdot_pool_check(c->pool));
            *known = *known && qdot_expr_rational(c->pool, a) != NULL;
            zero = zero && a == QDOT_ZERO;
            c->a[k * c->n + i] = a;
        }
        *known = *known && !zero;
    }
    return QDOT_OK;
}

/* --- directions away from the equilibrium --------------------------------------------------- */

static qdot_expr
scalar_product(const corner *c, const qdot_expr *v, const qdot_expr *w)
{
    qdot_expr sum = QDOT_ZERO;

    for (size_t i = 0; i < c->n; i++)
        sum = qdot_add(c->pool, sum, qdot_mul(c->pool, v[i], w[i]));
    return sum;
}

/* The directional derivative of the potential energy V along d (sign 1) or -d (sign -1), simplified. */
static qdot_expr
energy_slope_along(const corner *c, const qdot_expr *d, int sign)
{
    qdot_expr side[MOST_KINKS], sum;

    for (size_t k = 0; k < c->m; k++) {
        const fmpq *p = qdot_expr_rational(c->pool, scalar_product(c, c->a + k * c->n, d));

        side[k] = qdot_expr_int(c->pool, p == NULL ? 0 : sign * fmpq_sgn(p));
    }
    sum = qdot_neg(c->pool, scalar_product(c, c->there, d));
    sum = c->m == 0 ? sum : qdot_subs(c->pool, sum, c->m, c->s, side);
    return qdot_simplify(c->pool, sign > 0 ? sum : qdot_neg(c->pool, sum), &c->j->facts);
}

typedef enum { RISES, FALLS, OPEN } course;

/* Find whether the potential energy V rises along d and -d; record the conditions under which it does. */
static qdot_status
decide_along_ray(corner *c, const qdot_expr *d, course *how)
{
    for (int sign = -1; sign <= 1 && *how == RISES; sign += 2) {
        qdot_expr slope = energy_slope_along(c, d, sign), answer;

        QDOT_TRY(qdot_pool_check(c->pool));
        QDOT_TRY(qdot_judgement_ask(c->j, slope, &answer));
        if (answer != QDOT_FALSE)
            continue;
        *how = OPEN;
        if (qdot_positive(c->pool, qdot_neg(c->pool, slope), &c->j->facts, c->j->known.n, c->j->known.at) == QDOT_TRUE)
            *how = FALLS;
        QDOT_TRY(qdot_pool_check(c->pool));
    }
    return QDOT_OK;
}

/* A direction in which the planes of the kinks in `which` meet that crosses another one, d [n]; *found: there is one, up to
 * directions in which all planes meet. `rank`: of all planes. */
static qdot_status
find_intersection_ray(const corner *c, unsigned which, size_t rank, qdot_expr *d, bool *found)
{
    qdot_expr rows[MOST_KINKS * MOST_COORDINATES], *basis = NULL;
    size_t count = 0, m = 0;

    for (size_t k = 0; k < c->m; k++)
        for (size_t i = 0; i < c->n && (which >> k & 1) != 0; i++)
            rows[count++] = c->a[k * c->n + i];
    for (size_t i = 0; i < c->n && count == 0; i++) /* without planes the matrix is a single row of zeros */
        rows[i] = QDOT_ZERO;
    QDOT_TRY(qdot_null_space(c->pool, count == 0 ? 1 : count / c->n, c->n, rows, &basis, &m));
    *found = false;
    for (size_t v = 0; v < m && m == c->n - rank + 1 && !*found; v++)
        for (size_t k = 0; k < c->m && !*found; k++)
            if (scalar_product(c, c->a + k * c->n, basis + v * c->n) != QDOT_ZERO) {
                for (size_t i = 0; i < c->n; i++)
                    d[i] = basis[v * c->n + i];
                *found = true;
            }
    qdot_free(basis);
    return qdot_pool_check(c->pool);
}

static qdot_status
decide_along_all_rays(corner *c, size_t rank, course *how)
{
    for (unsigned which = 0; which < 1u << c->m && *how == RISES; which++) {
        qdot_expr d[MOST_COORDINATES];
        size_t bits = 0;
        bool found;

        for (size_t k = 0; k < c->m; k++)
            bits += which >> k & 1;
        if (bits != rank - 1)
            continue;
        QDOT_TRY(find_intersection_ray(c, which, rank, d, &found));
        if (found)
            QDOT_TRY(decide_along_ray(c, d, how));
    }
    return QDOT_OK;
}

/* --- the intersection of all planes of kinks -------------------------------------------------- */

/* Whether L contains no terms linear in velocities, that is, no gyroscopic forces. */
static bool
is_without_gyroscopic_terms(const corner *c)
{
    qdot_scene *s = c->j->s;
    bool natural = true;

    for (size_t i = 0; i < c->n && natural; i++) {
        qdot_expr p = qdot_diff(c->pool, qdot_mech_lagrangian(s), qdot_mech_jet(s, i, 1));

        natural = p != QDOT_NIL && qdot_rest_value(s, qdot_list(c->pool, 0, NULL), p) == QDOT_ZERO;
    }
    return natural;
}

/* q0 + sum_v z_v N_v, N [p * n], to at [n]; *on: every u_k stays 0 there, and the forces W [p] along the N_v, as functions of
 * z, are 0 at q0. */
static qdot_status
forces_where_kinks_meet(const corner *c, size_t p, const qdot_expr *N, const qdot_expr *z, qdot_expr *W, bool *on)
{
    qdot_pool *pool = c->pool;
    const qdot_expr *q = c->j->s->coordinates.at;
    qdot_expr at[MOST_COORDINATES], none[MOST_COORDINATES];

    for (size_t i = 0; i < c->n; i++) {
        at[i] = qdot_rest_value(c->j->s, c->e->equations, q[i]);
        for (size_t v = 0; v < p; v++)
            at[i] = qdot_add(pool, at[i], qdot_mul(pool, z[v], N[v * c->n + i]));
    }
    QDOT_TRY(qdot_pool_check(pool));
    *on = true;
    for (size_t k = 0; k < c->m && *on; k++)
        *on = qdot_is_zero(pool, qdot_subs(pool, c->u[k], c->n, q, at), &c->j->facts);
    for (size_t v = 0; v < p; v++)
        none[v] = QDOT_ZERO;
    for (size_t v = 0; v < p && *on; v++) {
        W[v] = QDOT_ZERO;
        for (size_t i = 0; i < c->n; i++)
            W[v] = qdot_add(pool, W[v], qdot_mul(pool, N[v * c->n + i], qdot_subs(pool, c->F[i], c->n, q, at)));
        *on = qdot_is_zero(pool, qdot_subs(pool, W[v], p, z, none), &c->j->facts);
    }
    return qdot_pool_check(pool);
}

/* Find how the energy V changes along a line on which all kink functions u_k stay 0, from the force W(z) on each side. */
static qdot_status
decide_along_line(corner *c, qdot_expr z, qdot_expr W, course *how)
{
    qdot_expr eps = qdot_symbol_get(c->pool, QDOT_FORMAL, "epsilon"), answer;

    qdot_symbol_domain(c->pool, eps, QDOT_ZERO, true, QDOT_NIL, false);
    *how = RISES;
    for (int side = -1; side <= 1 && *how == RISES; side += 2) {
        qdot_expr to = side < 0 ? qdot_neg(c->pool, eps) : eps, back = qdot_subs(c->pool, W, 1, &z, &to);
        int sign;
        bool known;

        if (side > 0)
            back = qdot_neg(c->pool, back);
        QDOT_TRY(qdot_pool_check(c->pool));
        QDOT_TRY(qdot_judgement_one_side(c->j, back, eps, &back, &sign, &known));
        if (!known || back == QDOT_NIL)
            *how = OPEN;
        else if (sign < 0)
            *how = FALLS;
        else if (sign == 0 && !qdot_is_generic(c->pool, back))
            *how = OPEN;
        if (*how != RISES)
            break;
        QDOT_TRY(qdot_judgement_ask(c->j, back, &answer));
        if (answer == QDOT_FALSE)
            *how = OPEN;
    }
    return QDOT_OK;
}

/* Find how the energy V changes in the directions N [p * n] in which all kink functions u_k stay 0. */
static qdot_status
decide_where_kinks_meet(corner *c, size_t p, const qdot_expr *N, course *how)
{
    qdot_pool *pool = c->pool;
    qdot_expr z[MOST_COORDINATES], none[MOST_COORDINATES], W[MOST_COORDINATES], H[MOST_COORDINATES * MOST_COORDINATES];
    qdot_definite definite;
    bool on;

    *how = OPEN;
    for (size_t v = 0; v < p; v++) {
        char name[24];

        snprintf(name, sizeof name, "(along %zu)", v + 1);
        z[v] = qdot_symbol_get(pool, QDOT_FORMAL, name);
        none[v] = QDOT_ZERO;
    }
    QDOT_TRY(forces_where_kinks_meet(c, p, N, z, W, &on));
    if (!on)
        return QDOT_OK;
    if (p == 1)
        return decide_along_line(c, z[0], W[0], how);
    if (c->rough)
        return QDOT_OK;
    for (size_t v = 0; v < p; v++)
        for (size_t w = 0; w < p; w++) {
            qdot_expr slope = qdot_neg(pool, qdot_subs(pool, qdot_diff(pool, W[v], z[w]), p, z, none));

            H[v * p + w] = qdot_simplify(pool, slope, &c->j->facts);
        }
    QDOT_TRY(qdot_pool_check(pool));
    if (!qdot_judgement_is_symmetric(c->j, p, H, 1))
        return QDOT_OK;
    QDOT_TRY(qdot_judgement_definiteness(c->j, p, H, &definite));
    if (definite == QDOT_DEFINITE_POSITIVE || definite == QDOT_DEFINITE_CONDITIONAL)
        *how = RISES;
    else if (definite == QDOT_NEGATIVE_SOMEWHERE && is_without_gyroscopic_terms(c))
        *how = FALLS;
    return QDOT_OK;
}

/* --- the verdict on stability ------------------------------------------------------------------- */

static qdot_status
corner_mass_is_definite(corner *c, bool *yes)
{
    qdot_expr M[MOST_COORDINATES * MOST_COORDINATES];

    for (size_t i = 0; i < c->n * c->n; i++)
        M[i] = value_at_equilibrium(c, qdot_mass_of_lagrangian(c->j->s, i / c->n, i % c->n));
    QDOT_TRY(qdot_pool_check(c->pool));
    return qdot_judgement_is_definite(c->j, c->n, M, yes);
}

qdot_status
qdot_stability_by_corner(qdot_judgement *j, qdot_equilibrium *e)
{
    const qdot_judgement_point before = qdot_judgement_mark(j);
    qdot_scene *s = j->s;
    corner c = {.j = j, .e = e, .pool = s->pool, .n = s->coordinates.n};
    course how = RISES;
    qdot_expr *N = NULL;
    size_t p = 0;
    bool known;
    qdot_status status;

    if (j->judge->by_signs == QDOT_NIL || c.n > MOST_COORDINATES || s->constraints.n > 0 || j->judge->velocity_kink ||
        qdot_expr_count(c.pool, e->equations) != c.n || qdot_expr_count(c.pool, j->judge->by_signs) != c.n)
        return QDOT_OK;
    QDOT_TRY(find_kinks(&c, &known));
    if (!known || c.m == 0)
        return QDOT_OK;
    QDOT_TRY(compute_forces(&c));
    QDOT_TRY(compute_kink_gradients(&c, &known));
    if (!known || c.m == 0)
        return QDOT_OK;
    QDOT_TRY(corner_mass_is_definite(&c, &known));
    if (!known)
        return QDOT_OK;
    QDOT_TRY(qdot_null_space(c.pool, c.m, c.n, c.a, &N, &p));
    status = decide_along_all_rays(&c, c.n - p, &how);
    if (status == QDOT_OK && how == RISES && p > 0)
        status = decide_where_kinks_meet(&c, p, N, &how);
    qdot_free(N);
    QDOT_TRY(status);
    if (how == RISES) {
        e->stability = QDOT_STABLE;
        return QDOT_OK;
    }
    qdot_judgement_back_to(j, before);
    if (how == FALLS)
        e->stability = QDOT_UNSTABLE;
    return QDOT_OK;
}
