/* sign.c -- the sign of an expression by its structure. */
#include "normal/inequality/sign.h"

#include <flint/fmpq.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/polynomial/flint.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/field/normal-form.h"
#include "normal/inequality/factor-signs.h"
#include "normal/inequality/inequality.h"
#include "normal/inequality/rising.h"

/* Of nested steps, of questions to the prover of inequalities, and of operations in what it is asked. */
enum { DEEPEST = 6, MOST_PROOFS = 16, LARGEST = 40 };

typedef struct {
    qdot_pool *pool;
    const qdot_facts *facts;
    int left; /* proofs that may still be tried */
} prover;

static qdot_status prove_sign(prover *x, qdot_expr e, int depth, int *sign);

/* The sign of b^k, a factor of a product: 1, -1, or 0: not known. */
static qdot_status
sign_of_factor_power(prover *x, qdot_expr b, qdot_expr k, int depth, int *sign)
{
    qdot_pool *pool = x->pool;
    int64_t whole;

    QDOT_TRY(prove_sign(x, b, depth, sign));
    if (qdot_expr_to_int(pool, k, &whole))
        *sign = whole % 2 == 0 ? *sign * *sign : *sign;
    else
        *sign = *sign > 0 ? 1 : 0;
    return QDOT_OK;
}

static qdot_status
sign_of_factors(prover *x, qdot_expr e, int depth, int *sign)
{
    qdot_pool *pool = x->pool;
    const fmpq *c = qdot_expr_rational(pool, qdot_expr_arg(pool, e, 0));

    *sign = c == NULL ? 0 : fmpq_sgn(c);
    for (uint32_t i = 1; i < qdot_expr_count(pool, e) && *sign != 0; i += 2) {
        int factor;

        QDOT_TRY(sign_of_factor_power(x, qdot_expr_arg(pool, e, i), qdot_expr_arg(pool, e, i + 1), depth, &factor));
        *sign *= factor;
    }
    return QDOT_OK;
}

/* e as c g(u), g a positive power u^(m/n) that is no whole one, or a function that rises or falls everywhere. *which: the
 * same number for the same g; *way: 1 g rises with u, -1 it falls. False: e is of another form. */
static bool
read_monotonic(qdot_pool *pool, qdot_expr e, qdot_expr *c, qdot_expr *u, unsigned *which, int *way)
{
    qdot_expr part = e;
    const fmpq *k;

    *c = QDOT_ONE;
    if (qdot_expr_kind(pool, e) == QDOT_PROD) {
        part = QDOT_NIL;
        *c = qdot_expr_arg(pool, e, 0);
        for (uint32_t i = 1; i < qdot_expr_count(pool, e); i += 2) {
            const qdot_expr b = qdot_expr_arg(pool, e, i), power = qdot_expr_arg(pool, e, i + 1);

            k = qdot_expr_rational(pool, power);
            if (part == QDOT_NIL && k != NULL && !fmpz_is_one(fmpq_denref(k)) && fmpq_sgn(k) > 0 &&
                (qdot_expr_kind(pool, b) == QDOT_SUM || qdot_expr_kind(pool, b) == QDOT_PROD))
                part = qdot_pow(pool, b, power);
            else if (part == QDOT_NIL && power == QDOT_ONE && qdot_expr_kind(pool, b) == QDOT_FUN)
                part = b;
            else
                *c = qdot_mul(pool, *c, qdot_pow(pool, b, power));
        }
    }
    if (part == QDOT_NIL)
        return false;
    *u = qdot_expr_arg(pool, part, 0);
    *way = 1;
    if (qdot_expr_kind(pool, part) == QDOT_PROD) {
        *u = qdot_expr_arg(pool, part, 1);
        *which = QDOT_FUNCTION_KINDS + qdot_expr_arg(pool, part, 2); /* the exponent */
        return true;
    }
    *which = qdot_expr_node(pool, part)->op;
    if (qdot_expr_is_function_that(pool, part, QDOT_FUN_FALLING))
        *way = -1;
    return *way < 0 || qdot_expr_is_function_that(pool, part, QDOT_FUN_RISING);
}

/* The sign of a + b, if the terms are a = c g(u) and b = -c g(v): that of c and of u - v. */
static qdot_status
sign_of_difference(prover *x, qdot_expr a, qdot_expr b, int depth, int *sign)
{
    qdot_pool *pool = x->pool;
    qdot_expr c, d, u, v;
    unsigned g, h;
    int way, same, factor;

    *sign = 0;
    if (!read_monotonic(pool, a, &c, &u, &g, &way) || !read_monotonic(pool, b, &d, &v, &h, &same) || g != h ||
        qdot_add(pool, c, d) != QDOT_ZERO)
        return QDOT_OK;
    QDOT_TRY(prove_sign(x, c, depth, &factor));
    if (factor != 0)
        QDOT_TRY(prove_sign(x, qdot_sub(pool, u, v), depth, sign));
    *sign *= factor * way;
    return QDOT_OK;
}

/* The sign of a sum of terms c n_i log(u_i), n_i integers, which is c log(P), P = prod u_i^n_i: that of c and of P - 1. */
static qdot_status
sign_of_logarithms(prover *x, qdot_expr e, int depth, int *sign)
{
    qdot_pool *pool = x->pool;
    qdot_expr product = QDOT_ONE, first = QDOT_NIL, c, u;
    int way, factor;
    unsigned g;

    *sign = 0;
    for (uint32_t i = 1; i < qdot_expr_count(pool, e); i += 2) {
        int64_t n;

        if (!read_monotonic(pool, qdot_mul(pool, qdot_expr_arg(pool, e, i), qdot_expr_arg(pool, e, i + 1)), &c, &u, &g, &way) || g != QDOT_LOG)
            return QDOT_OK;
        if (first == QDOT_NIL)
            first = c;
        if (!qdot_expr_to_int(pool, qdot_div(pool, c, first), &n))
            return QDOT_OK;
        product = qdot_mul(pool, product, qdot_pow_int(pool, u, n));
    }
    QDOT_TRY(prove_sign(x, first, depth, &factor));
    if (factor != 0)
        QDOT_TRY(prove_sign(x, qdot_normal(pool, qdot_sub(pool, product, QDOT_ONE), NULL), depth, sign));
    *sign *= factor;
    return QDOT_OK;
}

/* Term number i of a sum; number 0 is its constant, which may be 0. */
static qdot_expr
term_of(qdot_pool *pool, qdot_expr e, uint32_t i)
{
    return i == 0 ? qdot_expr_arg(pool, e, 0) : qdot_mul(pool, qdot_expr_arg(pool, e, 2 * i - 1), qdot_expr_arg(pool, e, 2 * i));
}

/* The sign of e = A + root: where A and root differ in sign, that of A if A^2 > root^2, else the other one. */
static qdot_status
sign_beside_root(prover *x, qdot_expr e, qdot_expr root, int depth, int *sign)
{
    qdot_pool *pool = x->pool;
    const qdot_expr A = qdot_sub(pool, e, root);
    qdot_expr squares;
    int of_root, of_A;

    *sign = 0;
    QDOT_TRY(prove_sign(x, root, depth, &of_root));
    if (of_root == 0)
        return QDOT_OK;
    QDOT_TRY(prove_sign(x, A, depth, &of_A));
    if (of_A == of_root)
        *sign = of_A;
    if (of_A == 0 || of_A == of_root)
        return QDOT_OK;
    squares = qdot_normal(pool, qdot_sub(pool, qdot_mul(pool, A, A), qdot_mul(pool, root, root)), NULL);
    QDOT_TRY(prove_sign(x, squares, depth, sign));
    *sign *= of_A;
    return QDOT_OK;
}

static qdot_status
sign_of_sum(prover *x, qdot_expr e, int depth, int *sign)
{
    qdot_pool *pool = x->pool;
    const uint32_t terms = (qdot_expr_count(pool, e) + 1) / 2;
    int all = 0;

    *sign = 0;
    if (terms == 3 && term_of(pool, e, 0) == QDOT_ZERO) {
        QDOT_TRY(sign_of_difference(x, term_of(pool, e, 1), term_of(pool, e, 2), depth, sign));
        if (*sign != 0)
            return QDOT_OK;
    }
    if (term_of(pool, e, 0) == QDOT_ZERO) {
        QDOT_TRY(sign_of_logarithms(x, e, depth, sign));
        if (*sign != 0)
            return QDOT_OK;
    }
    for (uint32_t i = 0; i < terms; i++) {
        const qdot_expr term = term_of(pool, e, i);
        int one;

        if (term == QDOT_ZERO)
            continue;
        QDOT_TRY(prove_sign(x, term, depth, &one));
        if (one == 0 || (all != 0 && one != all)) {
            all = 0;
            break;
        }
        all = one;
    }
    *sign = all;
    for (uint32_t i = 1; i < terms && *sign == 0; i++)
        if (qdot_has_square_root(pool, term_of(pool, e, i)))
            QDOT_TRY(sign_beside_root(x, e, term_of(pool, e, i), depth, sign));
    return QDOT_OK;
}

/* The sign of the sum e brought to one denominator: where its normal form is n^j ... d^-k ..., by the signs of the factors. */
static qdot_status
sign_of_quotient(prover *x, qdot_expr e, int depth, int *sign)
{
    qdot_pool *pool = x->pool;
    const qdot_expr q = qdot_normal(pool, e, NULL);

    return q != QDOT_NIL && qdot_expr_kind(pool, q) == QDOT_PROD ? sign_of_factors(x, q, depth, sign)
                                                                 : qdot_grave(qdot_pool_check(pool));
}

static qdot_status
sign_of_function(prover *x, qdot_expr e, int depth, int *sign)
{
    qdot_pool *pool = x->pool;
    const qdot_expr u = qdot_expr_arg(pool, e, 0);

    *sign = 0;
    if (qdot_expr_is_function(pool, e, QDOT_LOG) || qdot_expr_is_function(pool, e, QDOT_ACOSH))
        QDOT_TRY(prove_sign(x, qdot_sub(pool, u, QDOT_ONE), depth, sign));
    if (qdot_expr_is_function(pool, e, QDOT_ACOS))
        QDOT_TRY(prove_sign(x, qdot_sub(pool, QDOT_ONE, u), depth, sign));
    if (!qdot_expr_is_function(pool, e, QDOT_LOG))
        *sign = *sign > 0;
    return QDOT_OK;
}

/* The number c for which a term of g other than its constant has in c g the coefficient that it has in e, sums; nil: none. */
static qdot_expr
common_multiple(qdot_pool *pool, qdot_expr e, qdot_expr g)
{
    for (uint32_t i = 1; i < qdot_expr_count(pool, g); i += 2)
        for (uint32_t k = 1; k < qdot_expr_count(pool, e); k += 2)
            if (qdot_expr_arg(pool, g, i) == qdot_expr_arg(pool, e, k))
                return qdot_div(pool, qdot_expr_arg(pool, e, k + 1), qdot_expr_arg(pool, g, i + 1));
    return QDOT_NIL;
}

/* The sign of the sum e = c g + r, of a condition 0 < g or 0 <= g, a number c and terms r with the sign of c. */
static int
sign_beside_condition(const prover *x, qdot_expr e)
{
    qdot_pool *pool = x->pool;

    e = qdot_expand(pool, e);
    for (size_t i = 0; x->facts != NULL && i < x->facts->n_conditions && e != QDOT_NIL && qdot_expr_kind(pool, e) == QDOT_SUM; i++) {
        const qdot_expr condition = x->facts->conditions[i];
        const bool strict = qdot_expr_kind(pool, condition) == QDOT_REL && qdot_expr_node(pool, condition)->op == QDOT_LT;
        qdot_expr g, c, r;

        if (!strict && !(qdot_expr_kind(pool, condition) == QDOT_REL && qdot_expr_node(pool, condition)->op == QDOT_LE))
            continue;
        g = qdot_expand(pool, qdot_sub(pool, qdot_expr_arg(pool, condition, 1), qdot_expr_arg(pool, condition, 0)));
        c = g != QDOT_NIL && qdot_expr_kind(pool, g) == QDOT_SUM ? common_multiple(pool, e, g) : QDOT_NIL;
        if (c == QDOT_NIL)
            continue;
        r = qdot_expand(pool, qdot_sub(pool, e, qdot_mul(pool, c, g)));
        for (int s = 1; s >= -1 && r != QDOT_NIL; s -= 2) {
            const uint8_t strictly = s > 0 ? QDOT_POS : QDOT_NEG, wanted = strict ? (s > 0 ? QDOT_GE0 : QDOT_LE0) : strictly;

            if ((qdot_expr_sign(pool, c) & strictly) == strictly && ((strict && r == QDOT_ZERO) || (qdot_expr_sign(pool, r) & wanted) == wanted))
                return s;
        }
    }
    return 0;
}

static qdot_status
sign_by_proof(prover *x, qdot_expr e, int *sign)
{
    qdot_pool *pool = x->pool;

    *sign = sign_beside_condition(x, e);
    if (*sign != 0 || qdot_pool_failed(pool))
        return qdot_grave(qdot_pool_check(pool));
    e = x->left == 0 ? QDOT_NIL : qdot_without_signed_factors(pool, e);
    if (e == QDOT_NIL || qdot_expr_size(pool, e) > LARGEST)
        return qdot_grave(qdot_pool_check(pool));
    for (int s = 1; s >= -1; s -= 2) {
        qdot_expr at = QDOT_NIL;
        bool proved = false;

        if (x->left > 0)
            x->left--;
        QDOT_TRY(qdot_grave(qdot_inequality(pool, s > 0 ? e : qdot_neg(pool, e), true, x->facts, &proved, &at)));
        if (proved) {
            *sign = s;
            return QDOT_OK;
        }
    }
    return QDOT_OK;
}

/* *yes: e holds neither roots nor functions. */
static qdot_status
is_rational_function(qdot_pool *pool, qdot_expr e, bool *yes)
{
    qdot_walk w;

    *yes = false;
    QDOT_TRY(qdot_walk_begin(pool, e, &w));
    *yes = !(qdot_expr_node(pool, e)->holds & QDOT_HAS_FUN);
    for (size_t i = 0; i < w.n && *yes; i++)
        for (uint32_t k = 2; qdot_expr_kind(pool, w.at[i]) == QDOT_PROD && k < qdot_expr_count(pool, w.at[i]); k += 2) {
            int64_t n;

            *yes = *yes && qdot_expr_to_int(pool, qdot_expr_arg(pool, w.at[i], k), &n);
        }
    qdot_walk_end(&w);
    return QDOT_OK;
}

/* Whether one of the conditions holds the symbol e. */
static bool
is_conditioned(const prover *x, qdot_expr e)
{
    for (size_t i = 0; x->facts != NULL && i < x->facts->n_conditions; i++)
        if (qdot_expr_contains(x->pool, x->facts->conditions[i], e))
            return true;
    return false;
}

/* The sign of a symbol: that of a bound of its domain, which is an expression, or from the conditions. */
static qdot_status
sign_of_symbol(prover *x, qdot_expr e, int depth, int *sign)
{
    const qdot_expr lo = qdot_expr_symbol(x->pool, e)->lo, hi = qdot_expr_symbol(x->pool, e)->hi;

    if (lo != QDOT_NIL && qdot_expr_rational(x->pool, lo) == NULL)
        QDOT_TRY(prove_sign(x, lo, depth, sign));
    if (*sign == 1)
        return QDOT_OK;
    if (hi != QDOT_NIL && qdot_expr_rational(x->pool, hi) == NULL)
        QDOT_TRY(prove_sign(x, hi, depth, sign));
    if (*sign == -1)
        return QDOT_OK;
    *sign = 0;
    return is_conditioned(x, e) ? sign_by_proof(x, e, sign) : QDOT_OK;
}

static qdot_status
prove_sign(prover *x, qdot_expr e, int depth, int *sign)
{
    qdot_pool *pool = x->pool;
    bool rational;
    uint8_t known;

    *sign = 0;
    if (e == QDOT_NIL || depth > DEEPEST)
        return qdot_grave(qdot_pool_check(pool));
    known = qdot_expr_sign(pool, e);
    if ((known & QDOT_POS) == QDOT_POS || (known & QDOT_NEG) == QDOT_NEG) {
        *sign = (known & QDOT_POS) == QDOT_POS ? 1 : -1;
        return QDOT_OK;
    }
    if (qdot_expr_kind(pool, e) == QDOT_SYM)
        return sign_of_symbol(x, e, depth + 1, sign);
    QDOT_TRY(is_rational_function(pool, e, &rational));
    if (rational && qdot_expr_kind(pool, e) == QDOT_SUM) {
        QDOT_TRY(sign_by_proof(x, e, sign));
        return *sign != 0 ? QDOT_OK : sign_of_quotient(x, e, depth + 1, sign);
    }
    switch (qdot_expr_kind(pool, e)) {
    case QDOT_PROD: return sign_of_factors(x, e, depth + 1, sign);
    case QDOT_SUM: QDOT_TRY(sign_of_sum(x, e, depth + 1, sign)); break;
    case QDOT_FUN: QDOT_TRY(sign_of_function(x, e, depth + 1, sign)); break;
    default: break;
    }
    if (*sign == 0)
        QDOT_TRY(sign_by_proof(x, e, sign));
    return *sign == 0 && qdot_expr_kind(pool, e) == QDOT_SUM ? sign_of_quotient(x, e, depth + 1, sign) : QDOT_OK;
}

struct sign_question {
    prover x;
    qdot_expr e;
    int sign;
    qdot_status status;
};

static void
sign_task(void *user)
{
    struct sign_question *q = user;

    q->status = prove_sign(&q->x, q->e, 0, &q->sign);
}

qdot_status
qdot_sign(qdot_pool *pool, qdot_expr e, const qdot_facts *facts, int *sign)
{
    struct sign_question q = {.x = {pool, facts, MOST_PROOFS}, .e = e};
    const qdot_status status = qdot_flint_run(pool, sign_task, &q);

    *sign = status == QDOT_OK && q.status == QDOT_OK ? q.sign : 0;
    return status == QDOT_ELIMIT ? QDOT_OK : status != QDOT_OK ? status : q.status;
}
