/* stability-signs.c -- expressions that must be positive for a verdict: proved, or recorded as conditions. */
#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "mech/scene/access.h"
#include "mech/study/stability-parts.h"
#include "normal/inequality/less.h"
#include "normal/prove/decide.h"
#include "normal/simplify/positive.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/conditions.h"
#include "normal/solve/solutions.h"

enum {
    MOST_ASKED = 150,  /* largest conditions (in operations) that are tested for redundancy */
    MOST_MINORS = 12,  /* largest matrix whose leading minors are determinants; of larger ones pivots are taken */
    LONGEST_PIVOT = 300,
};

/* --- definite or not ---------------------------------------------------------------------- */

static qdot_status
record_claim(qdot_judgement *j, qdot_expr e)
{
    return (qdot_mech_holds(j->s, e) & QDOT_HAS_COORD) != 0 || qdot_solve_integers(j->s->pool, e) > 0
               ? qdot_vec_push(&j->claims, e)
               : QDOT_OK;
}

/* Ask whether e > 0: true, false, or a condition, which is recorded. */
qdot_status
qdot_judgement_ask(qdot_judgement *j, qdot_expr e, qdot_expr *answer)
{
    *answer = qdot_positive(j->s->pool, e, &j->facts, j->known.n, j->known.at);
    QDOT_TRY(qdot_pool_check(j->s->pool));
    if (*answer != QDOT_FALSE)
        QDOT_TRY(record_claim(j, e));
    if (*answer == QDOT_TRUE || *answer == QDOT_FALSE)
        return QDOT_OK;
    QDOT_TRY(qdot_vec_push(&j->when, *answer));
    return qdot_vec_push(&j->known, qdot_positive_of(j->s->pool, *answer));
}

qdot_judgement_point
qdot_judgement_mark(const qdot_judgement *j)
{
    return (qdot_judgement_point){j->when.n, j->known.n, j->claims.n};
}

/* Drop the conditions recorded since the mark m: a claim that was refuted needs no conditions. */
void
qdot_judgement_drop_conditions(qdot_judgement *j, qdot_judgement_point m)
{
    j->when.n = m.when;
    j->known.n = m.known;
}

void
qdot_judgement_back_to(qdot_judgement *j, qdot_judgement_point m)
{
    qdot_judgement_drop_conditions(j, m);
    j->claims.n = m.claims;
}

/* The leading principal minor number k of the matrix A [n*n], simplified. */
static qdot_expr
leading_minor(qdot_judgement *j, size_t n, const qdot_expr *A, size_t k)
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

/* The k-th pivot of A [n*n], minor k divided by minor k - 1, which has the sign of minor k where those before it are
 * positive. E [n*n] is A with k - 1 columns eliminated, and one more afterwards; 0 if the pivot grows too long. */
static qdot_expr
next_pivot(qdot_judgement *j, size_t n, qdot_expr *E, size_t k)
{
    qdot_pool *pool = j->s->pool;
    const qdot_expr *row = E + (k - 1) * n, pivot = row[k - 1];

    if (pivot == QDOT_NIL || qdot_is_zero(pool, pivot, &j->facts) || qdot_expr_size(pool, pivot) > LONGEST_PIVOT)
        return pivot == QDOT_NIL ? QDOT_NIL : QDOT_ZERO;
    for (size_t i = k; i < n; i++) {
        const qdot_expr by = qdot_div(pool, E[i * n + k - 1], pivot);

        for (size_t c = k; by != QDOT_ZERO && c < n; c++)
            if (row[c] != QDOT_ZERO)
                E[i * n + c] = qdot_simplify(pool, qdot_sub(pool, E[i * n + c], qdot_mul(pool, by, row[c])), &j->facts);
    }
    return pivot;
}

/* Whether e, a leading minor or another of a row of expressions, is proved below 0 wherever those before it are not, a set
 * of conditions: then no parameters make all of them positive. */
static qdot_status
is_never_definite(qdot_judgement *j, qdot_expr before, qdot_expr e, bool *yes)
{
    qdot_pool *pool = j->s->pool;
    qdot_expr room[QDOT_CONDITIONS_MOST];
    qdot_facts facts = qdot_facts_and(pool, &j->facts, before, room);
    qdot_decision d;

    *yes = false;
    if ((qdot_mech_holds(j->s, e) & QDOT_HAS_COORD) != 0 || qdot_solve_integers(pool, e) > 0 ||
        qdot_expr_size(pool, e) > MOST_ASKED)
        return QDOT_OK;
    QDOT_TRY(qdot_decide_less(pool, e, QDOT_ZERO, true, &facts, &d));
    *yes = d.verdict == QDOT_PROVED;
    return QDOT_OK;
}

/* As qdot_judgement_definiteness; E [n*n] a copy of A for the pivots of a large one, or NULL. */
static qdot_status
judge_definiteness(qdot_judgement *j, size_t n, const qdot_expr *A, qdot_expr *E, qdot_definite *how)
{
    qdot_pool *pool = j->s->pool;
    const qdot_judgement_point before = qdot_judgement_mark(j);
    qdot_expr not_negative = QDOT_NIL; /* the conditions 0 <= minor of all smaller leading minors */

    *how = QDOT_DEFINITE_UNKNOWN;
    for (size_t i = 0; i < n; i++) {
        qdot_expr sign = qdot_positive(pool, qdot_neg(pool, A[i * n + i]), &j->facts,
                                       j->known.n, j->known.at);

        QDOT_TRY(qdot_pool_check(pool));
        if (sign == QDOT_TRUE) {
            *how = QDOT_NEGATIVE_SOMEWHERE;
            return record_claim(j, qdot_neg(pool, A[i * n + i]));
        }
    }
    for (size_t k = 1; k <= n; k++) {
        qdot_expr e = E != NULL ? next_pivot(j, n, E, k) : leading_minor(j, n, A, k), answer;
        const bool first = j->when.n == before.when;
        bool zero, never = false;

        QDOT_TRY(qdot_pool_check(pool));
        zero = qdot_is_zero(pool, e, &j->facts);
        QDOT_TRY(qdot_judgement_ask(j, e, &answer));
        if (!zero && j->when.n > before.when)
            QDOT_TRY(is_never_definite(j, not_negative, first ? qdot_positive_of(pool, answer) : e, &never));
        if (never) {
            qdot_judgement_back_to(j, before);
            *how = QDOT_NEGATIVE_SOMEWHERE;
            return QDOT_OK;
        }
        if (answer == QDOT_FALSE) {
            if (zero || j->when.n > before.when)
                return QDOT_OK;
            *how = QDOT_NEGATIVE_SOMEWHERE;
            return record_claim(j, qdot_neg(pool, e));
        }
        not_negative = qdot_conditions_and(pool, not_negative, qdot_rel(pool, QDOT_LE, QDOT_ZERO, e));
    }
    *how = j->when.n > before.when ? QDOT_DEFINITE_CONDITIONAL : QDOT_DEFINITE_POSITIVE;
    return QDOT_OK;
}

/* Positive definite? A negative diagonal entry, or a minor that is negative wherever those before it are not: negative
 * somewhere. Conditions are noted. */
qdot_status
qdot_judgement_definiteness(qdot_judgement *j, size_t n, const qdot_expr *A, qdot_definite *how)
{
    qdot_expr *E = NULL;
    qdot_status status;

    if (n > MOST_MINORS) {
        E = qdot_calloc(n * n, sizeof *E);
        if (E == NULL)
            return QDOT_ENOMEM;
        for (size_t i = 0; i < n * n; i++)
            E[i] = A[i];
    }
    status = judge_definiteness(j, n, A, E, how);
    qdot_free(E);
    return status;
}

/* Whether A is positive definite without further conditions. */
qdot_status
qdot_judgement_is_definite(qdot_judgement *j, size_t n, const qdot_expr *A, bool *yes)
{
    qdot_judgement_point before = qdot_judgement_mark(j);
    qdot_definite how;

    QDOT_TRY(qdot_judgement_definiteness(j, n, A, &how));
    qdot_judgement_back_to(j, before);
    *yes = how == QDOT_DEFINITE_POSITIVE;
    return QDOT_OK;
}

bool
qdot_judgement_is_symmetric(qdot_judgement *j, size_t n, const qdot_expr *A, int sign)
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

/* Whether the symmetric part of Gamma is proved not negative: zero, or diagonal with known signs. */
bool
qdot_judgement_is_damping(qdot_judgement *j, size_t n, const qdot_expr *Gamma)
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

/* The set of conditions that no divisor in the formulas of the equilibria is 0. */
static qdot_expr
divisors_differ_from_zero(const qdot_judgement *j)
{
    const qdot_expr nonzero = j->judge->nonzero;
    qdot_expr set = QDOT_NIL;

    for (uint32_t i = 0; nonzero != QDOT_NIL && i < qdot_expr_count(j->s->pool, nonzero); i++)
        set = qdot_conditions_and_nonzero(j->s->pool, set, qdot_expr_arg(j->s->pool, nonzero, i));
    return set;
}

/* Ask that all are positive, one after another. *how: QDOT_DEFINITE_POSITIVE, QDOT_DEFINITE_CONDITIONAL; QDOT_NEGATIVE_SOMEWHERE
 * where one is proved below 0 whatever the parameters, or wherever those before it are not; else QDOT_DEFINITE_UNKNOWN. */
qdot_status
qdot_judgement_all_positive(qdot_judgement *j, size_t n, qdot_expr *e, qdot_definite *how)
{
    qdot_pool *pool = j->s->pool;
    qdot_judgement_point before = qdot_judgement_mark(j);
    qdot_expr not_negative = divisors_differ_from_zero(j); /* also 0 <= e for all e before the present one */

    for (size_t k = 0; k < n; k++) {
        qdot_expr below;

        e[k] = qdot_simplify(pool, e[k], &j->facts);
        QDOT_TRY(qdot_pool_check(pool));
        below = qdot_positive(pool, qdot_neg(pool, e[k]), &j->facts, j->known.n, j->known.at);
        QDOT_TRY(qdot_pool_check(pool));
        *how = QDOT_NEGATIVE_SOMEWHERE;
        if (below == QDOT_TRUE)
            return record_claim(j, qdot_neg(pool, e[k]));
    }
    *how = QDOT_DEFINITE_UNKNOWN;
    for (size_t k = 0; k < n; k++) {
        qdot_expr answer;
        bool never;

        QDOT_TRY(qdot_judgement_ask(j, e[k], &answer));
        if (answer == QDOT_FALSE) {
            QDOT_TRY(is_never_definite(j, not_negative, e[k], &never));
            if (never) {
                qdot_judgement_back_to(j, before);
                *how = QDOT_NEGATIVE_SOMEWHERE;
            }
            return QDOT_OK;
        }
        not_negative = qdot_conditions_and(pool, not_negative, qdot_rel(pool, QDOT_LE, QDOT_ZERO, e[k]));
    }
    *how = j->when.n > before.when ? QDOT_DEFINITE_CONDITIONAL : QDOT_DEFINITE_POSITIVE;
    return QDOT_OK;
}

/* Whether e != 0 (or e > 0 if `above`) is proved wherever the facts and the noted conditions hold. */
qdot_status
qdot_judgement_is_sure(qdot_judgement *j, qdot_expr e, bool above, bool *yes)
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

/* The number of operations in all conditions noted. */
static uint64_t
length_of_conditions(const qdot_judgement *j)
{
    uint64_t sum = 0;

    for (size_t i = 0; i < j->when.n; i++)
        sum += qdot_expr_size(j->s->pool, j->when.at[i]);
    return sum;
}

/* Whether condition i follows of one other: a > 0 of b > 0 where a - b is positive, by the scalars
 * [n] that are positive without conditions; or of all others. */
static qdot_status
follows(qdot_judgement *j, size_t i, size_t n, bool *yes)
{
    qdot_pool *pool = j->s->pool;
    const qdot_expr own = j->when.at[i], e = qdot_positive_of(pool, own);

    *yes = false;
    for (size_t k = 0; k < j->when.n && !*yes; k++) {
        qdot_expr more = qdot_sub(pool, e, qdot_positive_of(pool, j->when.at[k]));

        *yes = k != i && qdot_positive(pool, more, &j->facts, n, j->known.at) == QDOT_TRUE;
        QDOT_TRY(qdot_pool_check(pool));
    }
    if (*yes || j->when.n < 2 || length_of_conditions(j) > MOST_ASKED)
        return QDOT_OK;
    j->when.at[i] = j->when.at[--j->when.n];
    QDOT_TRY(qdot_judgement_is_sure(j, e, true, yes));
    j->when.at[j->when.n++] = j->when.at[i];
    j->when.at[i] = own;
    return QDOT_OK;
}

qdot_status
qdot_judgement_drop_implied(qdot_judgement *j, size_t n)
{
    for (size_t i = j->when.n; i-- > 0;) {
        bool yes;

        QDOT_TRY(follows(j, i, n, &yes));
        if (!yes)
            continue;
        for (size_t m = i + 1; m < j->when.n; m++)
            j->when.at[m - 1] = j->when.at[m];
        j->when.n--;
    }
    return QDOT_OK;
}
