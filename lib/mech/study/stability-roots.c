/* stability-roots.c -- decides whether the linear motion near an equilibrium grows, decays or stays bounded. */
#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "mech/scene/access.h"
#include "mech/study/stability-parts.h"
#include "normal/inequality/half-plane.h"
#include "normal/inequality/less.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/solve.h"

/* Coordinates y that are coupled with each other by the matrices M, Gamma or H, [n * n] each. */
typedef struct {
    size_t n;
    qdot_expr *M, *Gamma, *H;
} block;

typedef enum { GROWS, DECAYS, BOUNDED, OPEN } motion;

/* --- Hurwitz's criterion; damping ------------------------------------------------------------ */

static qdot_expr
determinant2(qdot_pool *pool, qdot_expr a, qdot_expr b, qdot_expr c, qdot_expr d)
{
    return qdot_sub(pool, qdot_mul(pool, a, d), qdot_mul(pool, b, c));
}

/* Whether all roots s of det(M s^2 + Gamma s + H), n = 1 or 2, have negative real parts: by the
 * coefficients and, of degree 4, a1 a2 a3 - a0 a3^2 - a1^2 a4; whose being negative proves a root
 * with a positive one. */
static qdot_status
judge_by_hurwitz(qdot_judgement *j, const block *b, qdot_definite *how)
{
    qdot_pool *pool = j->s->pool;
    const qdot_expr *M = b->M, *G = b->Gamma, *H = b->H;
    qdot_expr a[6];

    if (b->n == 1) {
        a[0] = qdot_mul(pool, M[0], G[0]);
        a[1] = qdot_mul(pool, M[0], H[0]);
        return qdot_judgement_all_positive(j, 2, a, how);
    }
    a[0] = determinant2(pool, M[0], M[1], M[2], M[3]);
    a[1] = qdot_add(pool, determinant2(pool, M[0], M[1], G[2], G[3]), determinant2(pool, G[0], G[1], M[2], M[3]));
    a[2] = qdot_sum(pool, 3,
                    (qdot_expr[]){determinant2(pool, M[0], M[1], H[2], H[3]),
                                  determinant2(pool, H[0], H[1], M[2], M[3]),
                                  determinant2(pool, G[0], G[1], G[2], G[3])});
    a[3] = qdot_add(pool, determinant2(pool, G[0], G[1], H[2], H[3]), determinant2(pool, H[0], H[1], G[2], G[3]));
    a[4] = determinant2(pool, H[0], H[1], H[2], H[3]);
    a[5] = qdot_sub(
        pool,
        qdot_sub(pool, qdot_product(pool, 3, (qdot_expr[]){a[1], a[2], a[3]}),
                 qdot_product(pool, 3, (qdot_expr[]){a[0], a[3], a[3]})),
        qdot_product(pool, 3, (qdot_expr[]){a[1], a[1], a[4]}));
    return qdot_judgement_all_positive(j, 6, a, how);
}

/* Whether e != 0 is proved factor by factor; divisors of the equilibrium are known not to vanish. */
static qdot_status
is_nonzero(qdot_judgement *j, qdot_expr e, bool *yes)
{
    qdot_pool *pool = j->s->pool;
    qdot_expr factors, nonzero = j->judge->nonzero;

    *yes = e != QDOT_NIL && !qdot_is_zero(pool, e, &j->facts);
    factors = *yes ? qdot_solve_factors(pool, e) : QDOT_NIL;
    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; *yes && i < qdot_expr_count(pool, factors); i++) {
        qdot_expr one = qdot_expr_arg(pool, factors, i);
        bool known = false;

        for (uint32_t k = 0; nonzero != QDOT_NIL && k < qdot_expr_count(pool, nonzero) && !known; k++)
            known = qdot_expr_arg(pool, nonzero, k) == one;
        if (!known)
            QDOT_TRY(qdot_judgement_is_sure(j, one, false, yes));
    }
    return QDOT_OK;
}

/* Gamma antisymmetric, n = 2: det = a W^2 + b W + c of W = s^2, if nothing goes with s. All W negative
 * and different: bounded; else a root with a positive real part: so if b <= 0 and c != 0. */
static qdot_status
judge_undamped_pair(qdot_judgement *j, const block *x, qdot_definite *how)
{
    qdot_pool *pool = j->s->pool;
    const qdot_expr *M = x->M, *G = x->Gamma, *H = x->H;
    qdot_expr odd, a, b, c;
    qdot_decision d;
    bool nonzero;

    *how = QDOT_DEFINITE_UNKNOWN;
    odd = qdot_add(pool, determinant2(pool, G[0], G[1], H[2], H[3]), determinant2(pool, H[0], H[1], G[2], G[3]));
    if (odd == QDOT_NIL || !qdot_is_zero(pool, odd, &j->facts))
        return qdot_pool_check(pool);
    a = determinant2(pool, M[0], M[1], M[2], M[3]);
    b = qdot_sum(pool, 3,
                 (qdot_expr[]){determinant2(pool, M[0], M[1], H[2], H[3]),
                               determinant2(pool, H[0], H[1], M[2], M[3]),
                               determinant2(pool, G[0], G[1], G[2], G[3])});
    c = determinant2(pool, H[0], H[1], H[2], H[3]);
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(qdot_decide_less(pool, b, QDOT_ZERO, false, &j->facts, &d));
    if (d.verdict == QDOT_PROVED) {
        QDOT_TRY(is_nonzero(j, c, &nonzero));
        *how = QDOT_NEGATIVE_SOMEWHERE;
        if (nonzero)
            return QDOT_OK;
    }
    return qdot_judgement_all_positive(
        j, 3,
        (qdot_expr[]){c, b,
                      qdot_sub(pool, qdot_mul(pool, b, b),
                               qdot_product(pool, 3,
                                            (qdot_expr[]){qdot_expr_int(pool, 4), a, c}))},
        how);
}

/* Compute Gamma + Gamma^T, owned by the caller. */
static qdot_status
twice_damping(qdot_judgement *j, size_t n, const qdot_expr *Gamma, qdot_expr **out)
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

/* Judge a block with complete damping and symmetric H: it decays where H is positive definite (Kelvin). */
static qdot_status
judge_completely_damped(qdot_judgement *j, const block *x, qdot_definite *how)
{
    qdot_expr *D;
    qdot_status status = twice_damping(j, x->n, x->Gamma, &D);

    if (status == QDOT_OK)
        status = qdot_judgement_definiteness(j, x->n, D, how);
    qdot_free(D);
    QDOT_TRY(status);
    if (*how == QDOT_DEFINITE_POSITIVE || *how == QDOT_DEFINITE_CONDITIONAL)
        QDOT_TRY(qdot_judgement_definiteness(j, x->n, x->H, how));
    if (*how == QDOT_NEGATIVE_SOMEWHERE)
        *how = QDOT_DEFINITE_UNKNOWN;
    return QDOT_OK;
}

enum { MOST_UNBALANCED = 3 }; /* largest number of coordinates */

/* Whether det H < 0 is proved under the condition that all expressions zero [n] are 0. */
static qdot_status
determinant_is_negative_where(qdot_judgement *j, size_t n, const qdot_expr *zero, qdot_expr detH, bool *yes)
{
    qdot_facts facts = j->facts;
    qdot_expr *all = qdot_malloc((facts.n_relations + n + 1) * sizeof *all);
    qdot_decision d;
    qdot_status status;

    *yes = false;
    if (all == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < facts.n_relations; i++)
        all[i] = facts.relations[i];
    for (size_t i = 0; i < n; i++)
        all[facts.n_relations + i] = zero[i];
    facts.relations = all;
    facts.n_relations += n;
    status = qdot_decide_less(j->s->pool, detH, QDOT_ZERO, true, &facts, &d);
    *yes = status == QDOT_OK && d.verdict == QDOT_PROVED;
    qdot_free(all);
    return status;
}

/* Whether the roots s of p = det(M s^2 + Gamma s + H) have the sum 0 and are not symmetric to 0: p has no term in
 * s^(2n-1), but another odd one that is proved not to be 0. Then one of them has a positive real part, for imaginary
 * roots alone, with their conjugates, are symmetric. Where the odd terms are 0, det H < 0 makes one positive. */
static qdot_status
has_unbalanced_roots(qdot_judgement *j, const block *x, bool *yes)
{
    qdot_pool *pool = j->s->pool;
    const qdot_expr s = qdot_symbol_get(pool, QDOT_FORMAL, "s"), zero = QDOT_ZERO;
    qdot_expr entry[MOST_UNBALANCED * MOST_UNBALANCED], odd[MOST_UNBALANCED], p, detH;

    *yes = false;
    if (x->n > MOST_UNBALANCED)
        return QDOT_OK;
    for (size_t i = 0; i < x->n * x->n; i++)
        entry[i] = qdot_sum(pool, 3,
                            (qdot_expr[]){qdot_mul(pool, x->M[i], qdot_pow_int(pool, s, 2)),
                                          qdot_mul(pool, x->Gamma[i], s), x->H[i]});
    p = qdot_det(pool, qdot_matrix(pool, (uint32_t)x->n, (uint32_t)x->n, entry));
    detH = qdot_simplify(pool, qdot_subs(pool, p, 1, &s, &zero), &j->facts);
    for (size_t k = 0; k < x->n; k++) { /* odd[k]: the coefficient of s^(2k+1), times (2k+1)! */
        p = qdot_diff(pool, p, s);
        odd[k] = qdot_simplify(pool, qdot_subs(pool, p, 1, &s, &zero), &j->facts);
        p = qdot_diff(pool, p, s);
        QDOT_TRY(qdot_pool_check(pool));
    }
    if (!qdot_is_zero(pool, odd[x->n - 1], &j->facts))
        return qdot_pool_check(pool);
    for (size_t k = 0; k + 1 < x->n && !*yes; k++)
        QDOT_TRY(is_nonzero(j, odd[k], yes));
    if (!*yes && x->n > 1)
        QDOT_TRY(determinant_is_negative_where(j, x->n - 1, odd, detH, yes));
    return qdot_pool_check(pool);
}

/* --- motion of one block ------------------------------------------------------------------ */

static bool
block_is_constant(const qdot_judgement *j, const block *x)
{
    bool yes = true;

    for (size_t i = 0; i < x->n * x->n && yes; i++)
        yes = qdot_expr_is_constant(j->s->pool, x->M[i]) && qdot_expr_is_constant(j->s->pool, x->Gamma[i]) &&
              qdot_expr_is_constant(j->s->pool, x->H[i]);
    return yes;
}

static qdot_status
judge_constant_block(qdot_judgement *j, const block *x, motion *what)
{
    bool even = qdot_judgement_is_symmetric(j, x->n, x->M, 1) &&
                qdot_judgement_is_symmetric(j, x->n, x->H, 1) &&
                qdot_judgement_is_symmetric(j, x->n, x->Gamma, -1);
    qdot_half_plane p;

    QDOT_TRY(qdot_half_plane_of(j->s->pool, x->n, x->M, x->Gamma, x->H, even, &p));
    *what = p.grows ? GROWS : p.decays ? DECAYS : p.bounded ? BOUNDED : OPEN;
    return QDOT_OK;
}

/* Set *what by the sign of a form: `otherwise` if it is positive definite, GROWS if it is negative
 * somewhere. If the sign is not known, drop the conditions noted since `before`. */
static void
set_motion_by_sign(qdot_judgement *j, qdot_judgement_point before, qdot_definite how, motion otherwise,
                   motion *what)
{
    if (how == QDOT_DEFINITE_POSITIVE || how == QDOT_DEFINITE_CONDITIONAL) {
        *what = otherwise;
    } else if (how == QDOT_NEGATIVE_SOMEWHERE) {
        *what = GROWS;
        qdot_judgement_drop_conditions(j, before);
    } else {
        qdot_judgement_back_to(j, before);
    }
}

static qdot_status
judge_symbolic_block(qdot_judgement *j, const block *x, bool mass, motion *what)
{
    const qdot_judgement_point before = qdot_judgement_mark(j);
    bool undamped = qdot_judgement_is_symmetric(j, x->n, x->Gamma, -1),
         potential = qdot_judgement_is_symmetric(j, x->n, x->H, 1);
    qdot_definite how = QDOT_DEFINITE_UNKNOWN;

    if (!undamped && x->n <= 2)
        QDOT_TRY(judge_by_hurwitz(j, x, &how));
    else if (!undamped && potential)
        QDOT_TRY(judge_completely_damped(j, x, &how));
    set_motion_by_sign(j, before, how, DECAYS, what);
    if (*what != OPEN || !mass)
        return QDOT_OK;
    if (!undamped || !potential) {
        bool unbalanced;

        QDOT_TRY(has_unbalanced_roots(j, x, &unbalanced));
        *what = unbalanced ? GROWS : OPEN;
        if (unbalanced)
            return QDOT_OK;
    }
    how = QDOT_DEFINITE_UNKNOWN;
    if (potential && qdot_judgement_is_damping(j, x->n, x->Gamma))
        QDOT_TRY(qdot_judgement_definiteness(j, x->n, x->H, &how));
    if (!qdot_judgement_is_symmetric(j, x->n, x->Gamma, 1)) {
        if (how == QDOT_NEGATIVE_SOMEWHERE) /* H is not positive, but gyroscopic terms may stabilise */
            how = QDOT_DEFINITE_UNKNOWN;
        /* two undamped coordinates may be stable although H is indefinite */
        if (how == QDOT_DEFINITE_CONDITIONAL && undamped && x->n == 2) {
            qdot_judgement_back_to(j, before);
            QDOT_TRY(judge_undamped_pair(j, x, &how));
            set_motion_by_sign(j, before, how, BOUNDED, what);
            if (*what != OPEN)
                return QDOT_OK;
            QDOT_TRY(qdot_judgement_definiteness(j, x->n, x->H, &how));
        }
    }
    set_motion_by_sign(j, before, how, BOUNDED, what);
    if (*what != OPEN || !undamped || x->n != 2)
        return QDOT_OK;
    QDOT_TRY(judge_undamped_pair(j, x, &how));
    set_motion_by_sign(j, before, how, BOUNDED, what);
    return QDOT_OK;
}

static qdot_status
judge_block(qdot_judgement *j, const block *x, motion *what)
{
    bool mass;

    *what = OPEN;
    QDOT_TRY(qdot_judgement_is_definite(j, x->n, x->M, &mass));
    if (!mass && x->n != 1)
        return QDOT_OK;
    if (mass && block_is_constant(j, x))
        QDOT_TRY(judge_constant_block(j, x, what));
    return *what == OPEN ? judge_symbolic_block(j, x, mass, what) : QDOT_OK;
}

/* --- motion of all blocks ----------------------------------------------------------------- */

/* Set of[n] to the number of the block of coupled coordinates to which each y belongs; returns the number of blocks. */
static size_t
number_blocks(const qdot_linear_motion *m, size_t *of)
{
    size_t count = 0;
    bool changed = true;

    for (size_t a = 0; a < m->n; a++)
        of[a] = a;
    while (changed) {
        changed = false;
        for (size_t i = 0; i < m->n * m->n; i++) {
            size_t a = i / m->n, b = i % m->n;
            bool coupled = m->M[i] != QDOT_ZERO || m->Gamma[i] != QDOT_ZERO || m->H[i] != QDOT_ZERO;

            if (!coupled || of[a] == of[b])
                continue;
            changed = true;
            of[a] = of[b] = of[a] < of[b] ? of[a] : of[b];
        }
    }
    for (size_t a = 0; a < m->n; a++)
        of[a] = of[a] == a ? count++ : of[of[a]];
    return count;
}

/* Copy block k; its matrices follow one another from x->M on. */
static void
copy_block(const qdot_linear_motion *m, const size_t *of, size_t k, block *x)
{
    const qdot_expr *from[3] = {m->M, m->Gamma, m->H};
    qdot_expr *to = x->M;

    x->n = 0;
    for (size_t a = 0; a < m->n; a++)
        x->n += of[a] == k;
    for (int which = 0; which < 3; which++)
        for (size_t i = 0; i < m->n * m->n; i++)
            if (of[i / m->n] == k && of[i % m->n] == k)
                *to++ = from[which][i];
    x->Gamma = x->M + x->n * x->n;
    x->H = x->Gamma + x->n * x->n;
}

/* Whether the motion of one block grows, decided without the conditions recorded for other blocks. */
static qdot_status
some_block_grows(qdot_judgement *j, const size_t *of, size_t count, block *x, bool *yes)
{
    *yes = false;
    for (size_t k = 0; k < count && !*yes; k++) {
        const qdot_judgement_point before = qdot_judgement_mark(j);
        motion one;

        copy_block(&j->m, of, k, x);
        QDOT_TRY(judge_block(j, x, &one));
        *yes = one == GROWS;
        if (!*yes)
            qdot_judgement_back_to(j, before);
        else
            qdot_judgement_drop_conditions(j, before);
    }
    return QDOT_OK;
}

/* Judge the whole motion: GROWS if one block grows; else the weakest verdict of all blocks, under
 * all conditions. */
static qdot_status
judge_whole_motion(qdot_judgement *j, size_t *of, block *x, motion *all)
{
    const qdot_judgement_point before = qdot_judgement_mark(j);
    size_t count = number_blocks(&j->m, of);
    motion worst = DECAYS;
    bool grows;

    QDOT_TRY(some_block_grows(j, of, count, x, &grows));
    for (size_t k = 0; k < count && !grows; k++) {
        motion one;

        copy_block(&j->m, of, k, x);
        QDOT_TRY(judge_block(j, x, &one));
        if (one == GROWS) /* decide growth alone, since the block's conditions may contradict those of another block */
            one = OPEN;
        worst = one > worst ? one : worst;
    }
    if (worst == OPEN)
        qdot_judgement_back_to(j, before);
    *all = grows ? GROWS : worst;
    return QDOT_OK;
}

qdot_status
qdot_stability_by_roots(qdot_judgement *j, qdot_equilibrium *e)
{
    const qdot_judgement_point before = qdot_judgement_mark(j);
    const size_t n = j->m.n;
    size_t *of = qdot_calloc(n + 1, sizeof *of);
    block x = {.M = qdot_calloc(3 * n * n + 1, sizeof *x.M)};
    motion all = OPEN;
    qdot_status status = of == NULL || x.M == NULL ? QDOT_ENOMEM : QDOT_OK;

    if (status == QDOT_OK && j->regular)
        status = judge_whole_motion(j, of, &x, &all);
    qdot_free(of);
    qdot_free(x.M);
    QDOT_TRY(status);
    if (all == GROWS)
        e->stability = QDOT_UNSTABLE;
    else if (j->n < n) /* a family of equilibria: motion along it neither grows nor decays */
        qdot_judgement_back_to(j, before);
    else if (all == DECAYS || (all == BOUNDED && j->m.exact))
        e->stability = QDOT_STABLE;
    else if (all == BOUNDED)
        e->stability = QDOT_STABLE_TO_FIRST_ORDER;
    return QDOT_OK;
}
