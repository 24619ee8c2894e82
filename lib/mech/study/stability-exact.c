/* stability-exact.c -- whether a scene stays near a place that is known exactly: by an energy,
 * by the roots of the linear motion, by the force on either side. */
#include "expr/calculus.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "mech/dynamics/mass-matrix.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/study/linear-motion.h"
#include "mech/study/lyapunov.h"
#include "mech/study/stability.h"
#include "normal/inequality/less.h"
#include "normal/prove/decide.h"
#include "normal/simplify/positive.h"
#include "normal/simplify/simplify.h"

/* One place. */
typedef struct {
    qdot_judge *judge;
    qdot_scene *s;
    qdot_facts facts;
    qdot_vec(qdot_expr) known; /* scalars that are positive */
    qdot_vec(qdot_expr) when;  /* RELs */
    /* Of a family of places, what was taken to be positive and holds its coordinates: a parameter is
     * generic, a coordinate runs through every value. */
    qdot_vec(qdot_expr) claims;
    qdot_linear_motion m;
    qdot_expr *M, *Gamma, *H;  /* of those y whose place is told, [n * n] */
    size_t n;
    bool regular;              /* the constraints have the rank there that they have elsewhere */
} judgement;

/* --- definite or not ---------------------------------------------------------------------- */

static qdot_status
claim(judgement *j, qdot_expr e)
{
    return qdot_mech_holds(j->s, e) & QDOT_HAS_COORD ? qdot_vec_push(&j->claims, e) : QDOT_OK;
}

/* Ask e > 0: true, false, or a condition that is noted. */
static qdot_status
ask(judgement *j, qdot_expr e, qdot_expr *answer)
{
    *answer = qdot_positive(j->s->pool, e, &j->facts, j->known.n, j->known.at);
    QDOT_TRY(qdot_pool_check(j->s->pool));
    if (*answer != QDOT_FALSE)
        QDOT_TRY(claim(j, e));
    if (*answer == QDOT_TRUE || *answer == QDOT_FALSE)
        return QDOT_OK;
    QDOT_TRY(qdot_vec_push(&j->when, *answer));
    return qdot_vec_push(&j->known, qdot_positive_of(j->s->pool, *answer));
}

/* How many conditions were noted so far; and back to that. */
typedef struct {
    size_t when, known, claims;
} mark;

static mark
mark_of(const judgement *j)
{
    return (mark){j->when.n, j->known.n, j->claims.n};
}

/* Forget the conditions since then: what was refuted needs none. */
static void
drop_conditions(judgement *j, mark m)
{
    j->when.n = m.when;
    j->known.n = m.known;
}

static void
back_to(judgement *j, mark m)
{
    drop_conditions(j, m);
    j->claims.n = m.claims;
}

/* Leading minors of A [n*n], simplified. */
static qdot_expr
minor_of(judgement *j, size_t n, const qdot_expr *A, size_t k)
{
    qdot_pool *pool = j->s->pool;
    qdot_expr *part, e;

    if (k == 1)
        return A[0];
    part = qdot_calloc(k * k, sizeof *part);
    if (part == NULL)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < k * k; i++)
        part[i] = A[i / k * n + i % k];
    e = qdot_det(pool, qdot_matrix(pool, (uint32_t)k, (uint32_t)k, part));
    qdot_free(part);
    return qdot_simplify(pool, e, &j->facts);
}

typedef enum { POSITIVE, CONDITIONAL, NEGATIVE_SOMEWHERE, UNKNOWN } definite;

/* Positive definite? A negative minor behind positive ones, or a negative diagonal entry: negative
 * somewhere. Conditions are noted. */
static qdot_status
definiteness(judgement *j, size_t n, const qdot_expr *A, definite *how)
{
    qdot_pool *pool = j->s->pool;
    size_t before = j->when.n;

    *how = UNKNOWN;
    for (size_t i = 0; i < n; i++) {
        qdot_expr sign = qdot_positive(pool, qdot_neg(pool, A[i * n + i]), &j->facts,
                                       j->known.n, j->known.at);

        QDOT_TRY(qdot_pool_check(pool));
        if (sign == QDOT_TRUE) {
            *how = NEGATIVE_SOMEWHERE;
            return claim(j, qdot_neg(pool, A[i * n + i]));
        }
    }
    for (size_t k = 1; k <= n; k++) {
        qdot_expr e = minor_of(j, n, A, k), answer;
        bool zero;

        QDOT_TRY(qdot_pool_check(pool));
        zero = qdot_is_zero(pool, e, &j->facts);
        QDOT_TRY(ask(j, e, &answer));
        if (answer == QDOT_FALSE) {
            if (zero || j->when.n > before)
                return QDOT_OK;
            *how = NEGATIVE_SOMEWHERE;
            return claim(j, qdot_neg(pool, e));
        }
    }
    *how = j->when.n > before ? CONDITIONAL : POSITIVE;
    return QDOT_OK;
}

/* Whether A is positive definite without further conditions. */
static qdot_status
is_proved_definite(judgement *j, size_t n, const qdot_expr *A, bool *yes)
{
    mark before = mark_of(j);
    definite how;

    QDOT_TRY(definiteness(j, n, A, &how));
    back_to(j, before);
    *yes = how == POSITIVE;
    return QDOT_OK;
}

static bool
is_symmetric(judgement *j, size_t n, const qdot_expr *A, int sign)
{
    qdot_pool *pool = j->s->pool;

    for (size_t i = 0; i < n; i++)
        for (size_t k = i; k < n; k++) {
            qdot_expr other = A[k * n + i];

            other = sign > 0 ? qdot_sub(pool, A[i * n + k], other)
                             : qdot_add(pool, A[i * n + k], other);
            if (!qdot_is_zero(pool, other, &j->facts))
                return false;
        }
    return true;
}

/* Whether the symmetric part of Gamma is proved not negative: none, or diagonal of known signs. */
static bool
is_damping(judgement *j, size_t n, const qdot_expr *Gamma)
{
    qdot_pool *pool = j->s->pool;
    bool fine = true;

    for (size_t i = 0; i < n && fine; i++)
        for (size_t k = 0; k < n && fine; k++) {
            qdot_expr e = qdot_add(pool, Gamma[i * n + k], Gamma[k * n + i]);

            fine = e != QDOT_NIL &&
                   (i == k ? (qdot_expr_node(pool, e)->sign & QDOT_GE0) != 0
                           : qdot_is_zero(pool, e, &j->facts));
        }
    return fine;
}

/* Gamma + Gamma^T, owned by the caller. */
static qdot_status
twice_damping(judgement *j, size_t n, const qdot_expr *Gamma, qdot_expr **out)
{
    qdot_pool *pool = j->s->pool;

    *out = qdot_calloc(n * n + 1, sizeof **out);
    if (*out == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n * n; i++)
        (*out)[i] = qdot_simplify(
            pool, qdot_add(pool, Gamma[i], Gamma[i % n * n + i / n]), &j->facts);
    return qdot_pool_check(pool);
}

/* --- polynomials of Hurwitz ------------------------------------------------------------------ */

/* Ask that all are positive, one after another. *how: POSITIVE, CONDITIONAL; NEGATIVE_SOMEWHERE
 * where one is proved below 0 whatever the parameters; else UNKNOWN. */
static qdot_status
all_positive(judgement *j, size_t n, qdot_expr *e, definite *how)
{
    qdot_pool *pool = j->s->pool;
    mark before = mark_of(j);

    for (size_t k = 0; k < n; k++) {
        qdot_expr below;

        e[k] = qdot_simplify(pool, e[k], &j->facts);
        QDOT_TRY(qdot_pool_check(pool));
        below = qdot_positive(pool, qdot_neg(pool, e[k]), &j->facts, j->known.n, j->known.at);
        QDOT_TRY(qdot_pool_check(pool));
        *how = NEGATIVE_SOMEWHERE;
        if (below == QDOT_TRUE)
            return claim(j, qdot_neg(pool, e[k]));
    }
    *how = UNKNOWN;
    for (size_t k = 0; k < n; k++) {
        qdot_expr answer;

        QDOT_TRY(ask(j, e[k], &answer));
        if (answer == QDOT_FALSE)
            return QDOT_OK;
    }
    *how = j->when.n > before.when ? CONDITIONAL : POSITIVE;
    return QDOT_OK;
}

static qdot_expr
det2(qdot_pool *pool, qdot_expr a, qdot_expr b, qdot_expr c, qdot_expr d)
{
    return qdot_sub(pool, qdot_mul(pool, a, d), qdot_mul(pool, b, c));
}

/* Whether all roots s of det(M s^2 + Gamma s + H), n = 1 or 2, have negative real parts: by the
 * coefficients and, of degree 4, a1 a2 a3 - a0 a3^2 - a1^2 a4; whose being negative proves a root
 * with a positive one. */
static qdot_status
hurwitz(judgement *j, definite *how)
{
    qdot_pool *pool = j->s->pool;
    const qdot_expr *M = j->M, *G = j->Gamma, *H = j->H;
    qdot_expr a[6];

    if (j->n == 1) {
        a[0] = qdot_mul(pool, M[0], G[0]);
        a[1] = qdot_mul(pool, M[0], H[0]);
        return all_positive(j, 2, a, how);
    }
    a[0] = det2(pool, M[0], M[1], M[2], M[3]);
    a[1] = qdot_add(pool, det2(pool, M[0], M[1], G[2], G[3]), det2(pool, G[0], G[1], M[2], M[3]));
    a[2] = qdot_sum(pool, 3,
                    (qdot_expr[]){det2(pool, M[0], M[1], H[2], H[3]),
                                  det2(pool, H[0], H[1], M[2], M[3]),
                                  det2(pool, G[0], G[1], G[2], G[3])});
    a[3] = qdot_add(pool, det2(pool, G[0], G[1], H[2], H[3]), det2(pool, H[0], H[1], G[2], G[3]));
    a[4] = det2(pool, H[0], H[1], H[2], H[3]);
    a[5] = qdot_sub(
        pool,
        qdot_sub(pool, qdot_product(pool, 3, (qdot_expr[]){a[1], a[2], a[3]}),
                 qdot_product(pool, 3, (qdot_expr[]){a[0], a[3], a[3]})),
        qdot_product(pool, 3, (qdot_expr[]){a[1], a[1], a[4]}));
    return all_positive(j, 6, a, how);
}

/* det(-w^2 M + i w Gamma + H) = a w^4 - b w^2 + c, Gamma antisymmetric, n = 2: two positive w^2
 * that differ, or a root with a positive real part. */
static qdot_status
gyroscopic(judgement *j, definite *how)
{
    qdot_pool *pool = j->s->pool;
    const qdot_expr *M = j->M, *H = j->H;
    qdot_expr g = j->Gamma[1], a, b, c;

    a = det2(pool, M[0], M[1], M[2], M[3]);
    b = qdot_sum(
        pool, 4,
        (qdot_expr[]){
            qdot_mul(pool, M[0], H[3]), qdot_mul(pool, M[3], H[0]),
            qdot_product(pool, 3, (qdot_expr[]){qdot_expr_int(pool, -2), M[1], H[1]}),
            qdot_mul(pool, g, g)});
    c = det2(pool, H[0], H[1], H[2], H[3]);
    return all_positive(
        j, 3,
        (qdot_expr[]){c, b,
                      qdot_sub(pool, qdot_mul(pool, b, b),
                               qdot_product(pool, 3,
                                            (qdot_expr[]){qdot_expr_int(pool, 4), a, c}))},
        how);
}

/* --- one degree of freedom, either side ------------------------------------------------- */

/* The first derivative by eps that is not 0 at eps = 0 of e: its sign, 0 where that is not
 * known. */
static qdot_status
leading_sign(judgement *j, qdot_expr e, qdot_expr eps, int *sign)
{
    qdot_pool *pool = j->s->pool;
    qdot_expr zero = QDOT_ZERO;

    *sign = 0;
    for (int k = 0; k <= 7; k++) {
        qdot_expr value = qdot_simplify(pool, qdot_subs(pool, e, 1, &eps, &zero), &j->facts),
                  up, down;
        qdot_status status = qdot_pool_check(pool);

        if (status != QDOT_OK)
            return status == QDOT_EDOMAIN ? QDOT_OK : status;
        if (!qdot_is_zero(pool, value, &j->facts)) {
            up = qdot_positive(pool, value, &j->facts, j->known.n, j->known.at);
            down = qdot_positive(pool, qdot_neg(pool, value), &j->facts, j->known.n,
                                 j->known.at);
            *sign = up == QDOT_TRUE ? 1 : down == QDOT_TRUE ? -1 : 0;
            return qdot_pool_check(pool);
        }
        e = qdot_diff(pool, e, eps);
    }
    return qdot_pool_check(pool);
}

/* The potential of one coordinate rises on either side, or falls on one, by the force at q0 +-
 * eps: also where H = 0, or where the force jumps. */
static qdot_status
by_sides(judgement *j, qdot_equilibrium *e)
{
    qdot_scene *s = j->s;
    qdot_pool *pool = s->pool;
    qdot_expr q = s->coordinates.at[0], mass, up,
              eps = qdot_symbol_get(pool, QDOT_FORMAL, "epsilon"), place;
    int sign[2];

    if (qdot_expr_count(pool, e->equations) != 1 || qdot_expr_count(pool, j->judge->at_rest) != 1)
        return QDOT_OK;
    qdot_symbol_domain(pool, eps, QDOT_ZERO, true, QDOT_NIL, false);
    place = qdot_expr_arg(pool, qdot_expr_arg(pool, e->equations, 0), 1);
    mass = qdot_simplify(pool, qdot_rest_value(s, e->equations, qdot_mass_of_lagrangian(s, 0, 0)),
                         &j->facts);
    QDOT_TRY(qdot_pool_check(pool));
    up = qdot_positive(pool, mass, &j->facts, j->known.n, j->known.at);
    QDOT_TRY(qdot_pool_check(pool));
    if (up != QDOT_TRUE)
        return QDOT_OK;
    for (int side = 0; side < 2; side++) { /* what pushes back: -F where q grows */
        qdot_expr at = side == 0 ? qdot_add(pool, place, eps) : qdot_sub(pool, place, eps),
                  F = qdot_subs(pool, qdot_expr_arg(pool, j->judge->at_rest, 0), 1, &q, &at);

        QDOT_TRY(qdot_pool_check(pool));
        QDOT_TRY(leading_sign(j, side == 0 ? qdot_neg(pool, F) : F, eps, &sign[side]));
    }
    if (sign[0] > 0 && sign[1] > 0)
        e->stability = QDOT_STABLE;
    else if ((sign[0] < 0 || sign[1] < 0) && !j->judge->velocity_kink)
        e->stability = QDOT_UNSTABLE;
    return QDOT_OK;
}

/* --- the verdict ------------------------------------------------------------------------ */

static qdot_stability
conclude(definite how, qdot_stability verdict)
{
    return how == POSITIVE || how == CONDITIONAL ? verdict : QDOT_STABILITY_UNDECIDED;
}

/* By an energy that has a strict minimum at rest. */
static qdot_status
by_energy(judgement *j, qdot_equilibrium *e)
{
    definite how;
    mark before = mark_of(j);

    if (j->judge->law == QDOT_ENERGY_UNKNOWN)
        return QDOT_OK;
    QDOT_TRY(definiteness(j, j->n, j->H, &how));
    if (how == POSITIVE || how == CONDITIONAL)
        QDOT_TRY(definiteness(j, j->m.n, j->m.M, &how));
    if (how == POSITIVE && j->when.n > before.when)
        how = CONDITIONAL;
    e->stability = conclude(how, QDOT_STABLE);
    if (e->stability != QDOT_STABLE)
        back_to(j, before);
    return QDOT_OK;
}

/* A direction in which the energy falls, no gyroscopic terms: det(M s^2 + Gamma s + H) has a root
 * s > 0. */
static qdot_status
by_falling(judgement *j, qdot_equilibrium *e)
{
    definite how;
    bool mass;
    mark before = mark_of(j);

    if (!j->regular || !is_symmetric(j, j->m.n, j->m.Gamma, 1) ||
        !is_symmetric(j, j->n, j->H, 1))
        return QDOT_OK;
    QDOT_TRY(definiteness(j, j->n, j->H, &how));
    drop_conditions(j, before);
    if (how == NEGATIVE_SOMEWHERE)
        QDOT_TRY(is_proved_definite(j, j->m.n, j->m.M, &mass));
    if (how == NEGATIVE_SOMEWHERE && mass)
        e->stability = QDOT_UNSTABLE;
    else
        back_to(j, before);
    return QDOT_OK;
}

/* Where the equilibrium fixes all coordinates: by the roots of the linear motion. */
static qdot_status
by_roots(judgement *j, qdot_equilibrium *e)
{
    mark before = mark_of(j);
    definite how = UNKNOWN;
    qdot_expr *D = NULL;
    bool mass, no_damping = is_symmetric(j, j->n, j->Gamma, -1);

    if (!j->regular || j->n != j->m.n)
        return QDOT_OK;
    QDOT_TRY(is_proved_definite(j, j->n, j->M, &mass));
    if (!mass && j->n != 1)
        return QDOT_OK;
    if (!no_damping && j->n <= 2) {
        QDOT_TRY(hurwitz(j, &how));
    } else if (!no_damping && is_symmetric(j, j->n, j->H, 1)) { /* complete damping: Kelvin */
        qdot_status status = twice_damping(j, j->n, j->Gamma, &D);

        if (status == QDOT_OK)
            status = definiteness(j, j->n, D, &how);
        qdot_free(D);
        QDOT_TRY(status);
        if (how == POSITIVE || how == CONDITIONAL)
            QDOT_TRY(definiteness(j, j->n, j->H, &how));
        if (how == NEGATIVE_SOMEWHERE)
            how = UNKNOWN;
    }
    if (how == NEGATIVE_SOMEWHERE) {
        e->stability = QDOT_UNSTABLE;
        drop_conditions(j, before);
        return QDOT_OK;
    }
    e->stability = conclude(how, QDOT_STABLE);
    if (e->stability != QDOT_STABLE)
        back_to(j, before);
    return QDOT_OK;
}

/* Otherwise: whether the linear motion is bounded. */
static qdot_status
to_first_order(judgement *j, qdot_equilibrium *e)
{
    mark before = mark_of(j);
    definite how = UNKNOWN;
    bool mass;
    qdot_stability verdict = j->m.exact ? QDOT_STABLE : QDOT_STABLE_TO_FIRST_ORDER;

    if (!j->regular || j->n != j->m.n || !is_symmetric(j, j->n, j->H, 1))
        return QDOT_OK;
    QDOT_TRY(is_proved_definite(j, j->n, j->M, &mass));
    if (!mass)
        return QDOT_OK;
    if (is_damping(j, j->n, j->Gamma))
        QDOT_TRY(definiteness(j, j->n, j->H, &how));
    if (how != POSITIVE && how != CONDITIONAL && j->n == 2 &&
        is_symmetric(j, 2, j->Gamma, -1)) {
        back_to(j, before);
        QDOT_TRY(gyroscopic(j, &how));
        if (how == NEGATIVE_SOMEWHERE) {
            drop_conditions(j, before);
            e->stability = QDOT_UNSTABLE;
            return QDOT_OK;
        }
    }
    e->stability = conclude(how, verdict);
    if (e->stability != verdict)
        back_to(j, before);
    return QDOT_OK;
}

/* --- kinks ---------------------------------------------------------------------------------- */

/* Whether the equations at rest have no slopes at the place: |u|, sign u where u = 0; of what
 * else jumps it is not looked into where. */
static qdot_status
kink_at(const judgement *j, qdot_expr equations, bool *yes)
{
    qdot_pool *pool = j->s->pool;
    qdot_walk w;
    qdot_status status = QDOT_OK;

    *yes = false;
    QDOT_TRY(qdot_walk_begin(pool, j->judge->at_rest, &w));
    for (size_t i = 0; i < w.n && !*yes && status == QDOT_OK; i++) {
        uint32_t op = qdot_expr_node(pool, w.at[i])->op;
        qdot_expr u;

        if (qdot_expr_kind(pool, w.at[i]) != QDOT_FUN || !qdot_stability_has_kink(op) ||
            (qdot_mech_holds(j->s, w.at[i]) & QDOT_HAS_COORD) == 0)
            continue;
        if (op != QDOT_ABS && op != QDOT_SIGN) {
            *yes = true;
            break;
        }
        u = qdot_rest_value(j->s, equations, qdot_expr_arg(pool, w.at[i], 0));
        status = qdot_pool_check(pool);
        *yes = status == QDOT_OK && qdot_is_zero(pool, u, &j->facts);
    }
    qdot_walk_end(&w);
    return status;
}

/* --- families -------------------------------------------------------------------------- */

/* Whether e != 0, with `above` e > 0, is proved wherever the facts and the noted conditions hold. */
static qdot_status
is_sure(judgement *j, qdot_expr e, bool above, bool *yes)
{
    qdot_pool *pool = j->s->pool;
    qdot_facts facts = j->facts;
    qdot_expr *all = qdot_malloc((facts.n_conditions + j->when.n + 1) * sizeof *all);
    qdot_status status = QDOT_OK;

    *yes = false;
    if (all == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < facts.n_conditions; i++)
        all[i] = facts.conditions[i];
    for (size_t i = 0; i < j->when.n; i++)
        all[facts.n_conditions + i] = j->when.at[i];
    facts.conditions = all;
    facts.n_conditions += j->when.n;
    for (int side = above ? 1 : 0; side < 2 && !*yes && status == QDOT_OK; side++) {
        qdot_decision d;

        status = qdot_decide_less(pool, side ? QDOT_ZERO : e, side ? e : QDOT_ZERO, true, &facts, &d);
        *yes = status == QDOT_OK && d.verdict == QDOT_PROVED;
    }
    qdot_free(all);
    return status;
}


/* Whether what the verdict rests on holds all along a family: else it is left open. */
static qdot_status
confirm_family(judgement *j, qdot_equilibrium *e)
{
    bool yes = true;

    if (e->stability == QDOT_STABILITY_UNDECIDED)
        return QDOT_OK;
    for (size_t i = 0; i < j->claims.n && yes; i++)
        QDOT_TRY(is_sure(j, j->claims.at[i], true, &yes));
    for (size_t r = 0; r < j->m.rank && yes; r++)
        if (qdot_mech_holds(j->s, j->m.pivot[r]) & QDOT_HAS_COORD)
            QDOT_TRY(is_sure(j, j->m.pivot[r], false, &yes));
    if (!yes)
        e->stability = QDOT_STABILITY_UNDECIDED;
    return QDOT_OK;
}

/* --- one place -------------------------------------------------------------------------- */

/* The blocks of those y whose place is told: all but coordinates that stand in no equation at
 * rest, along which a family of rests is alike. */
static qdot_status
take_blocks(judgement *j)
{
    size_t m = j->m.n;
    bool *told = qdot_calloc(m + 1, sizeof *told);

    j->M = qdot_calloc(3 * m * m + 1, sizeof *j->M);
    if (told == NULL || j->M == NULL) {
        qdot_free(told);
        return QDOT_ENOMEM;
    }
    for (size_t a = 0; a < m; a++) {
        told[a] = qdot_stability_is_told(j->judge, j->m.which[a]);
        j->n += told[a];
    }
    j->Gamma = j->M + j->n * j->n;
    j->H = j->Gamma + j->n * j->n;
    for (int k = 0; k < 3; k++) {
        const qdot_expr *from = j->m.M + (size_t)k * m * m;
        size_t at = (size_t)k * j->n * j->n;

        for (size_t a = 0; a < m; a++)
            for (size_t b = 0; b < m; b++)
                if (told[a] && told[b])
                    j->M[at++] = from[a * m + b];
    }
    qdot_free(told);
    return QDOT_OK;
}

static qdot_status
by_linear_motion(judgement *j, qdot_equilibrium *e)
{
    qdot_dof dof;
    qdot_status status = qdot_linear_motion_about(j->s, e->equations, e->exists, &j->m);

    if (status == QDOT_EDOMAIN) /* no slopes there */
        return QDOT_OK;
    QDOT_TRY(status);
    QDOT_TRY(take_blocks(j));
    QDOT_TRY(qdot_mech_dof(j->s, &dof));
    j->regular = j->m.rank == dof.independent;
    if (j->n == 0) { /* nothing can move, but along what changes nothing */
        if (j->m.n == 0 && !j->judge->timed)
            e->stability = QDOT_STABLE;
        return QDOT_OK;
    }
    QDOT_TRY(by_energy(j, e));
    if (j->judge->velocity_kink || j->judge->timed || !j->m.damped)
        return QDOT_OK;
    if (e->stability == QDOT_STABILITY_UNDECIDED)
        QDOT_TRY(by_falling(j, e));
    if (e->stability == QDOT_STABILITY_UNDECIDED)
        QDOT_TRY(by_roots(j, e));
    if (e->stability == QDOT_STABILITY_UNDECIDED)
        QDOT_TRY(to_first_order(j, e));
    return QDOT_OK;
}

/* Leave out what another condition says already: a > 0 follows from b > 0 where a - b is
 * positive. known [n]: scalars that are positive without any of them. */
static qdot_status
drop_implied(judgement *j, size_t n)
{
    qdot_pool *pool = j->s->pool;

    for (size_t i = j->when.n; i-- > 0;)
        for (size_t k = 0; k < j->when.n; k++) {
            qdot_expr more = qdot_sub(pool, qdot_positive_of(pool, j->when.at[i]),
                                      qdot_positive_of(pool, j->when.at[k]));
            bool follows = k != i && qdot_positive(pool, more, &j->facts, n, j->known.at)
                                         == QDOT_TRUE;

            QDOT_TRY(qdot_pool_check(pool));
            if (!follows)
                continue;
            for (size_t m = i + 1; m < j->when.n; m++)
                j->when.at[m - 1] = j->when.at[m];
            j->when.n--;
            break;
        }
    return QDOT_OK;
}

static qdot_status
exact_place(judgement *j, qdot_equilibrium *e)
{
    qdot_scene *s = j->s;
    bool kink;
    size_t known;

    for (uint32_t i = 0; e->exists != QDOT_NIL && i < qdot_expr_count(s->pool, e->exists); i++)
        QDOT_TRY(qdot_vec_push(
            &j->known, qdot_positive_of(s->pool, qdot_expr_arg(s->pool, e->exists, i))));
    known = j->known.n;
    QDOT_TRY(kink_at(j, e->equations, &kink));
    if (!kink)
        QDOT_TRY(by_linear_motion(j, e));
    if (e->stability == QDOT_STABILITY_UNDECIDED && s->coordinates.n == 1 &&
        s->constraints.n == 0 && j->judge->law != QDOT_ENERGY_UNKNOWN)
        QDOT_TRY(by_sides(j, e));
    QDOT_TRY(confirm_family(j, e));
    QDOT_TRY(drop_implied(j, known));
    if ((e->stability == QDOT_STABLE || e->stability == QDOT_STABLE_TO_FIRST_ORDER) &&
        j->when.n > 0)
        e->stable_when = qdot_list(s->pool, (uint32_t)j->when.n, j->when.at);
    return qdot_pool_check(s->pool);
}

qdot_status
qdot_stability_judge_exact(qdot_judge *judge, qdot_equilibrium *e)
{
    judgement j = {.judge = judge, .s = judge->s};
    qdot_expr *own = NULL;
    qdot_status status = qdot_rest_facts(judge->s, e->exists, &j.facts, &own);

    if (status == QDOT_OK)
        status = exact_place(&j, e);
    qdot_linear_motion_clear(&j.m);
    qdot_free(j.M);
    qdot_free(own);
    qdot_free(j.known.at);
    qdot_free(j.when.at);
    qdot_free(j.claims.at);
    return status;
}
