/* stability-friction.c -- rests that dry friction holds.
 *
 * Let friction -f_i sign(q_i'), f_i > 0, act on coordinates i in S, each strictly below its limit: |F_i| < f_i, F
 * the other forces. Beside such a place, with V the potential and d > 0,
 *
 *     L = T + V - V_0 - sum_S V_i (q_i - q_i0) + d sum_S |q_i - q_i0|,   dL/dt <= 0,
 *
 * for the friction takes at least (|F_i| + d) |q_i'| of power. L has a strict minimum there if V has one in the other
 * coordinates while those of S are fixed: the rest is stable. If S is all of them no energy law is needed: the
 * power of all forces together is at most -d sum |q_i'|. If V falls in the other coordinates and their
 * motion with S fixed, which friction keeps so, is not gyroscopic, the rest is unstable.
 *
 * At an end of an interval of one coordinate |F| = f. Where the force beyond the end points back inside and the
 * energy never grows, T + V + f q (towards the inside) takes the place of L; where it points away the end is left.
 *
 * Source  Lyapunov's and Lagrange's theorems for the L above.
 * Tests   tests/mech/study/test_equilibrium-bands.c
 */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/mass-matrix.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/study/stability-parts.h"
#include "normal/prove/decide.h"
#include "normal/refute/constant.h"
#include "normal/simplify/positive.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/conditions.h"

typedef struct {
    qdot_judgement j;
    qdot_equilibrium *e;
    qdot_expr inside;     /* a LIST of strict inequalities: the conditions and the range of equilibrium e */
    qdot_expr *limit;     /* [coordinates] largest friction force f_i; nil: no friction */
    qdot_expr *force;     /* [coordinates] the other forces F_i */
} held;

/* --- coordinates held by friction ---------------------------------------------------------- */

/* Index of the coordinate of whose velocity u is a constant multiple; s->coordinates.n if there is none. */
static size_t
slipping_coordinate(qdot_scene *s, qdot_expr u)
{
    for (size_t i = 0; i < s->coordinates.n; i++) {
        qdot_expr v = qdot_mech_jet(s, i, 1), c = qdot_diff(s->pool, u, v);

        if (c == QDOT_NIL || c == QDOT_ZERO)
            continue;
        if (qdot_mech_holds(s, c) == 0 && qdot_sub(s->pool, u, qdot_mul(s->pool, c, v)) == QDOT_ZERO)
            return i;
        break;
    }
    return s->coordinates.n;
}

/* Whether the equation of motion of coordinate i jumps only because of friction on this coordinate. */
static qdot_status
jumps_only_by_own_friction(held *h, size_t i, bool *yes)
{
    qdot_scene *s = h->j.s;
    qdot_expr slips = h->j.judge->slips;
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin(s->pool, qdot_mech_equation(s, s->coordinates.at[i]), &w));
    for (size_t k = 0; k < w.n && *yes; k++) {
        uint32_t op = qdot_expr_node(s->pool, w.at[k])->op;

        if (qdot_expr_kind(s->pool, w.at[k]) != QDOT_FUN || !qdot_stability_has_kink(op) ||
            op == QDOT_ABS || (qdot_mech_holds(s, w.at[k]) & QDOT_HAS_VELOCITY) == 0)
            continue;
        *yes = op == QDOT_SIGN && h->limit[i] != QDOT_NIL &&
               qdot_expr_place(qdot_expr_count(s->pool, slips), qdot_expr_args(s->pool, slips),
                               qdot_expr_arg(s->pool, w.at[k], 0)) <
                   qdot_expr_count(s->pool, slips) &&
               slipping_coordinate(s, qdot_expr_arg(s->pool, w.at[k], 0)) == i;
    }
    qdot_walk_end(&w);
    return QDOT_OK;
}

/* Whether the forces at rest are differentiable everywhere. */
static qdot_status
forces_are_differentiable(held *h, bool *yes)
{
    qdot_pool *pool = h->j.s->pool;
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin(pool, h->j.judge->forces, &w));
    for (size_t k = 0; k < w.n && *yes; k++)
        *yes = qdot_expr_kind(pool, w.at[k]) != QDOT_FUN ||
               !qdot_stability_has_kink(qdot_expr_node(pool, w.at[k])->op);
    qdot_walk_end(&w);
    return QDOT_OK;
}

/* Split the force on each coordinate i into friction, at most f_i, and other forces F_i; *yes if that is possible. */
static qdot_status
split_off_friction(held *h, bool *yes)
{
    qdot_judge *judge = h->j.judge;
    qdot_scene *s = judge->s;
    qdot_pool *pool = s->pool;
    uint32_t sides = qdot_expr_count(pool, judge->friction);

    for (size_t i = 0; i < s->coordinates.n; i++)
        h->force[i] = qdot_expr_arg(pool, judge->forces, (uint32_t)i);
    for (uint32_t k = 0; k < sides && *yes; k++) {
        qdot_expr side = qdot_expr_arg(pool, judge->friction, k), none = QDOT_ZERO;
        size_t i = slipping_coordinate(s, qdot_expr_arg(pool, judge->slips, k));

        *yes = i < s->coordinates.n && h->limit[i] == QDOT_NIL;
        for (size_t n = 0; n < s->coordinates.n && *yes; n++) {
            qdot_expr slope = qdot_diff(pool, h->force[n], side);

            *yes = slope != QDOT_NIL &&
                   (n == i ? !qdot_expr_contains(pool, slope, side) : slope == QDOT_ZERO);
            if (n != i)
                continue;
            /* for c < 0, the limit of sign(c q') is the slope itself */
            h->limit[i] = qdot_neg(pool, slope);
            if (qdot_positive(pool, h->limit[i], &h->j.facts, h->j.known.n, h->j.known.at) !=
                QDOT_TRUE)
                h->limit[i] = slope;
            *yes = *yes && qdot_positive(pool, h->limit[i], &h->j.facts, h->j.known.n,
                                         h->j.known.at) == QDOT_TRUE;
            h->force[i] = qdot_subs(pool, h->force[i], 1, &side, &none);
        }
        QDOT_TRY(qdot_pool_check(pool));
    }
    for (size_t i = 0; i < s->coordinates.n && *yes; i++)
        QDOT_TRY(jumps_only_by_own_friction(h, i, yes));
    return *yes ? forces_are_differentiable(h, yes) : QDOT_OK;
}

/* Whether friction is below its limit: by the conditions of the region, or by further conditions, which are recorded. */
static qdot_status
friction_is_below_limit(held *h, bool *yes)
{
    qdot_scene *s = h->j.s;
    qdot_pool *pool = s->pool;

    for (size_t i = 0; i < s->coordinates.n && *yes; i++) {
        qdot_expr F = qdot_rest_value(s, h->e->equations, h->force[i]),
                  f = h->limit[i] == QDOT_NIL ? QDOT_NIL
                                              : qdot_rest_value(s, h->e->equations, h->limit[i]);

        QDOT_TRY(qdot_pool_check(pool));
        if (f == QDOT_NIL || (qdot_mech_holds(s, qdot_sub(pool, f, F)) & QDOT_HAS_COORD) != 0)
            continue;
        for (int sign = -1; sign <= 1 && *yes; sign += 2) {
            qdot_expr gap = sign < 0 ? qdot_sub(pool, f, F) : qdot_add(pool, f, F), answer;

            QDOT_TRY(qdot_judgement_ask(&h->j, qdot_simplify(pool, gap, &h->j.facts), &answer));
            *yes = answer != QDOT_FALSE;
        }
    }
    return QDOT_OK;
}

/* --- the other coordinates --------------------------------------------------------------- */

/* Compute M, Gamma, H for the coordinates that friction does not hold at rest; if `whole`, M for all coordinates. */
static qdot_status
compute_matrices(held *h, size_t n, qdot_expr *M, qdot_expr *Gamma, qdot_expr *H)
{
    qdot_scene *s = h->j.s;
    qdot_pool *pool = s->pool;
    size_t a = 0;

    for (size_t i = 0; i < s->coordinates.n; i++) {
        const qdot_expr gap = qdot_motion_residual(s, i);
        size_t b = 0;

        QDOT_TRY(qdot_pool_check(pool));
        for (size_t k = 0; k < s->coordinates.n && h->limit[i] == QDOT_NIL; k++) {
            if (h->limit[k] != QDOT_NIL)
                continue;
            M[a * n + b] = qdot_rest_value(s, h->e->equations, qdot_mass_of_lagrangian(s, i, k));
            H[a * n + b] = qdot_rest_value(
                s, h->e->equations,
                qdot_neg(pool, qdot_diff(pool, h->force[i], s->coordinates.at[k])));
            Gamma[a * n + b] = qdot_rest_value(s, h->e->equations,
                                               qdot_diff(pool, gap, qdot_mech_jet(s, k, 1)));
            M[a * n + b] = qdot_simplify(pool, M[a * n + b], &h->j.facts);
            H[a * n + b] = qdot_simplify(pool, H[a * n + b], &h->j.facts);
            Gamma[a * n + b] = qdot_simplify(pool, Gamma[a * n + b], &h->j.facts);
            b++;
        }
        a += h->limit[i] == QDOT_NIL;
    }
    return qdot_pool_check(pool);
}

static qdot_status
judge_by_other_coordinates(held *h)
{
    qdot_scene *s = h->j.s;
    size_t n = 0;
    qdot_expr *M;
    qdot_definite how = QDOT_DEFINITE_UNKNOWN;
    qdot_status status;
    bool mass = false;

    for (size_t i = 0; i < s->coordinates.n; i++)
        n += h->limit[i] == QDOT_NIL;
    if (n == 0) {
        h->e->stability = QDOT_STABLE;
        return QDOT_OK;
    }
    if (h->j.judge->law == QDOT_ENERGY_UNKNOWN)
        return QDOT_OK;
    M = qdot_calloc(3 * n * n, sizeof *M);
    if (M == NULL)
        return QDOT_ENOMEM;
    status = compute_matrices(h, n, M, M + n * n, M + 2 * n * n);
    if (status == QDOT_OK && qdot_judgement_is_symmetric(&h->j, n, M + 2 * n * n, 1))
        status = qdot_judgement_definiteness(&h->j, n, M + 2 * n * n, &how);
    if (how == QDOT_DEFINITE_POSITIVE || how == QDOT_DEFINITE_CONDITIONAL)
        h->e->stability = QDOT_STABLE;
    if (how == QDOT_NEGATIVE_SOMEWHERE && status == QDOT_OK)
        status = qdot_judgement_is_definite(&h->j, n, M, &mass);
    if (mass && qdot_judgement_is_symmetric(&h->j, n, M + n * n, 1)) {
        h->e->stability = QDOT_UNSTABLE;
        h->j.when.n = 0;
    }
    qdot_free(M);
    return status;
}

/* Whether the mass matrix M of all coordinates is positive definite, so that T bounds every velocity. */
static qdot_status
friction_mass_is_definite(held *h, bool *yes)
{
    qdot_scene *s = h->j.s;
    size_t n = s->coordinates.n;
    qdot_expr *M = qdot_calloc(n * n, sizeof *M);
    qdot_definite how;
    qdot_status status = M == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t i = 0; i < n * n && status == QDOT_OK; i++)
        M[i] = qdot_simplify(
            s->pool,
            qdot_rest_value(s, h->e->equations, qdot_mass_of_lagrangian(s, i / n, i % n)),
            &h->j.facts);
    if (status == QDOT_OK)
        status = qdot_pool_check(s->pool);
    if (status == QDOT_OK)
        status = qdot_judgement_definiteness(&h->j, n, M, &how);
    *yes = status == QDOT_OK &&
           (how == QDOT_DEFINITE_POSITIVE || how == QDOT_DEFINITE_CONDITIONAL);
    qdot_free(M);
    return status;
}

/* --- ends of a band of equilibria -------------------------------------------------------- */

/* Whether the force at an end of the range of the only coordinate points inward. */
static qdot_status
force_points_inside(held *h, qdot_expr end, bool upper, bool *yes)
{
    qdot_scene *s = h->j.s;
    qdot_pool *pool = s->pool;
    qdot_expr u = s->coordinates.at[0], F = qdot_subs(pool, h->force[0], 1, &u, &end);
    const qdot_symbol *symbol = qdot_expr_symbol(pool, u);

    *yes = false;
    if (upper)
        F = qdot_neg(pool, F);
    QDOT_TRY(qdot_pool_check(pool));
    if (end == symbol->lo || end == symbol->hi) /* an end given by the coordinate's domain, where friction is not at its limit */
        return QDOT_OK;
    if (qdot_expr_is_constant(pool, F)) {
        qdot_constant_sign sign;

        QDOT_TRY(qdot_constant_decide(pool, F, &sign));
        *yes = sign == QDOT_CONSTANT_POSITIVE;
        return QDOT_OK;
    }
    *yes = qdot_positive(pool, qdot_simplify(pool, F, &h->j.facts), &h->j.facts, h->j.known.n,
                         h->j.known.at) == QDOT_TRUE;
    return qdot_pool_check(pool);
}

/* The relation with < instead of <=; nil if it has no <=. */
static qdot_expr
make_strict(qdot_pool *pool, qdot_expr relation)
{
    return qdot_expr_node(pool, relation)->op == QDOT_LE
               ? qdot_rel(pool, QDOT_LT, qdot_expr_arg(pool, relation, 0),
                          qdot_expr_arg(pool, relation, 1))
               : QDOT_NIL;
}

/* Add conditions that exclude those ends of an interval of stable equilibria at which nothing is proved. */
static qdot_status
exclude_undecided_ends(held *h)
{
    qdot_scene *s = h->j.s;
    qdot_pool *pool = s->pool;

    for (int part = 0; part < 2; part++) {
        qdot_expr list = part == 0 ? h->e->exists : h->e->range;

        for (uint32_t i = 0; list != QDOT_NIL && i < qdot_expr_count(pool, list); i++) {
            qdot_expr one = qdot_expr_arg(pool, list, i), strict = make_strict(pool, one);
            bool upper = qdot_expr_arg(pool, one, 0) == s->coordinates.at[0], inside = false;

            if (strict == QDOT_NIL || (qdot_mech_holds(s, one) & QDOT_HAS_COORD) == 0)
                continue;
            if (part == 1 && s->coordinates.n == 1 && h->j.judge->law != QDOT_ENERGY_UNKNOWN)
                QDOT_TRY(force_points_inside(h, qdot_expr_arg(pool, one, upper ? 1 : 0), upper, &inside));
            if (!inside)
                QDOT_TRY(qdot_vec_push(&h->j.when, strict));
        }
    }
    return qdot_pool_check(pool);
}

/* --- the verdict on stability ------------------------------------------------------------ */

static qdot_status
judge_held_by_friction(held *h, bool *judged)
{
    qdot_scene *s = h->j.s;
    qdot_pool *pool = s->pool;
    bool sure;
    size_t known;

    for (uint32_t i = 0; i < qdot_expr_count(pool, h->inside); i++)
        QDOT_TRY(qdot_vec_push(&h->j.known,
                               qdot_positive_of(pool, qdot_expr_arg(pool, h->inside, i))));
    known = h->j.known.n;
    *judged = true;
    QDOT_TRY(split_off_friction(h, judged));
    if (*judged)
        QDOT_TRY(friction_is_below_limit(h, judged));
    if (*judged)
        QDOT_TRY(friction_mass_is_definite(h, judged));
    if (!*judged || (h->e->touched && h->j.judge->law == QDOT_ENERGY_UNKNOWN))
        return QDOT_OK;
    QDOT_TRY(judge_by_other_coordinates(h));
    QDOT_TRY(qdot_judgement_confirm(&h->j, &sure));
    if (!sure)
        h->e->stability = QDOT_STABILITY_UNDECIDED;
    QDOT_TRY(qdot_judgement_drop_implied(&h->j, known));
    if (h->e->stability == QDOT_STABLE)
        QDOT_TRY(exclude_undecided_ends(h));
    if (h->e->stability == QDOT_STABLE && h->j.when.n > 0)
        h->e->stable_when = qdot_list(pool, (uint32_t)h->j.when.n, h->j.when.at);
    return qdot_pool_check(pool);
}

/* All conditions of equilibrium e, with < instead of <=. */
static qdot_expr
strict_conditions(qdot_pool *pool, const qdot_equilibrium *e)
{
    qdot_expr all = QDOT_NIL;

    for (int part = 0; part < 2; part++) {
        qdot_expr list = part == 0 ? e->exists : e->range;

        for (uint32_t i = 0; list != QDOT_NIL && i < qdot_expr_count(pool, list); i++) {
            qdot_expr one = qdot_expr_arg(pool, list, i), strict = make_strict(pool, one);

            all = qdot_conditions_and(pool, all, strict != QDOT_NIL ? strict : one);
        }
    }
    return all == QDOT_NIL ? qdot_list(pool, 0, NULL) : all;
}

qdot_status
qdot_stability_judge_held(qdot_judge *judge, qdot_equilibrium *e, bool *judged)
{
    qdot_scene *s = judge->s;
    held h = {.j = {.judge = judge, .s = s}, .e = e, .inside = strict_conditions(s->pool, e)};
    qdot_expr *own = NULL;
    qdot_status status = qdot_pool_check(s->pool);

    *judged = false;
    if (status != QDOT_OK || s->constraints.n > 0 || judge->timed || h.inside == QDOT_FALSE)
        return status;
    h.limit = qdot_calloc(2 * s->coordinates.n + 1, sizeof *h.limit);
    if (h.limit == NULL)
        return QDOT_ENOMEM;
    h.force = h.limit + s->coordinates.n;
    status = qdot_rest_facts(s, h.inside, &h.j.facts, &own);
    if (status == QDOT_OK)
        status = judge_held_by_friction(&h, judged);
    qdot_free(h.limit);
    qdot_free(own);
    qdot_free(h.j.known.at);
    qdot_free(h.j.when.at);
    qdot_free(h.j.claims.at);
    return status;
}
