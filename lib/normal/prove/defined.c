/* defined.c -- finds the nodes that are always evaluated, and the conditions under which they are defined. */
#include "normal/prove/defined.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "normal/field/factor.h"

#define WORK 200000

struct job {
    qdot_pool *pool;
    qdot_defined_gap tell;
    void *user;
};

/* --- splitting a condition ------------------------------------------------------------- */

/* Split g = c (a^2 - x^2), c > 0, a >= 0 (a number or of known sign), into two linear conditions. */
static qdot_status
split_difference_of_squares(struct job *j, qdot_expr g, bool weak, bool *done)
{
    qdot_pool *pool = j->pool;
    qdot_expr square = QDOT_NIL, c = QDOT_NIL, rest = QDOT_NIL, a;
    int64_t k;

    *done = false;
    if (qdot_expr_kind(pool, g) != QDOT_SUM)
        return QDOT_OK;
    for (uint32_t i = 1; i < qdot_expr_count(pool, g); i += 2) {
        qdot_expr t = qdot_expr_arg(pool, g, i);

        if (qdot_expr_kind(pool, t) == QDOT_PROD && qdot_expr_count(pool, t) == 3 &&
            qdot_expr_kind(pool, qdot_expr_arg(pool, t, 1)) == QDOT_SYM &&
            qdot_expr_to_int(pool, qdot_expr_arg(pool, t, 2), &k) && k == 2 &&
            fmpq_sgn(qdot_expr_rational(pool, qdot_expr_arg(pool, g, i + 1))) < 0) {
            if (square != QDOT_NIL)
                return QDOT_OK;
            square = qdot_expr_arg(pool, t, 1);
            c = qdot_expr_arg(pool, g, i + 1);
            rest = qdot_sub(pool, g, qdot_mul(pool, c, t));
        }
    }
    if (square == QDOT_NIL || rest == QDOT_NIL || qdot_expr_contains(pool, rest, square) ||
        !(qdot_expr_node(pool, rest)->sign & QDOT_GE0))
        return QDOT_OK;
    a = qdot_sqrt(pool, qdot_neg(pool, qdot_div(pool, rest, c)));
    if (a == QDOT_NIL)
        return QDOT_OK;
    *done = true;
    QDOT_TRY(j->tell(j->user, qdot_sub(pool, a, square), weak));
    return j->tell(j->user, qdot_add(pool, a, square), weak);
}

static qdot_status
report_condition_of_factor(struct job *j, qdot_expr g, bool weak)
{
    uint8_t sign = g == QDOT_NIL ? QDOT_GE0 : qdot_expr_node(j->pool, g)->sign;
    bool done;

    if ((sign & QDOT_GE0) && (weak || (sign & QDOT_NE0)))
        return QDOT_OK;
    QDOT_TRY(split_difference_of_squares(j, g, weak, &done));
    return done ? QDOT_OK : j->tell(j->user, g, weak);
}

/* Find the product of the factors of p whose sign is not known. */
static qdot_status
product_of_unknown_factors(qdot_field *f, const fmpz_mpoly_t p, bool weak, qdot_expr *product)
{
    qdot_factors factors;
    qdot_status status = qdot_factor(f, &factors, p);
    qdot_pool *pool = f->pool;

    if (status == QDOT_OK && fmpz_sgn(factors.content) < 0)
        *product = qdot_neg(pool, *product);
    for (slong i = 0; i < factors.n && status == QDOT_OK; i++) {
        qdot_expr b = qdot_field_expr(f, factors.poly + i);
        uint8_t sign = qdot_expr_sign(pool, b);
        bool even = factors.exp[i] % 2 == 0;

        if (even)
            sign = (uint8_t)(QDOT_GE0 | (sign & QDOT_NE0));
        /* keep a factor that may be 0: where it is 0 the condition tells nothing of the other factors */
        if (weak && !(sign & QDOT_NE0))
            *product = qdot_mul(pool, *product,
                                qdot_pow_int(pool, b, (int64_t)factors.exp[i]));
        else if (sign & QDOT_LE0)
            *product = qdot_neg(pool, *product);
        else if (!(sign & QDOT_GE0))
            *product = qdot_mul(pool, *product, b);
    }
    qdot_factor_clear(f, &factors);
    return status;
}

qdot_status
qdot_defined_apart(qdot_pool *pool, qdot_expr gap, bool weak, qdot_defined_gap tell,
                   void *user)
{
    struct job j = {pool, tell, user};
    qdot_expr product = QDOT_NIL;
    qdot_status status = QDOT_OK;
    qdot_field f;

    if (gap == QDOT_NIL || !qdot_expr_is_scalar(pool, gap))
        return QDOT_OK;
    qdot_field_begin(&f, pool, 1, &gap, WORK);
    if (qdot_field_goes(&f)) {
        qdot_ratio r;

        qdot_field_cancelled(&f, &r, gap);
        if (qdot_field_goes(&f) && !fmpz_mpoly_is_zero(r.n, f.ctx)) {
            product = QDOT_ONE;
            status = product_of_unknown_factors(&f, r.n, weak, &product);
            if (status == QDOT_OK) /* the condition: denominator != 0 */
                status = product_of_unknown_factors(&f, r.d, false, &product);
        }
        qdot_ratio_clear(&f, &r);
    }
    if (f.state == QDOT_FIELD_FAILED && status == QDOT_OK)
        status = f.status;
    qdot_field_end(&f);
    QDOT_TRY(qdot_grave(status));
    product = status == QDOT_OK && product != QDOT_NIL ? qdot_expand(pool, product) : gap;
    return report_condition_of_factor(&j, product, weak);
}

/* --- conditions for each node to be defined --------------------------------------------- */

static qdot_status
report_condition(struct job *j, qdot_expr gap, bool weak)
{
    uint8_t sign = gap == QDOT_NIL ? QDOT_POS : qdot_expr_node(j->pool, gap)->sign;

    if ((sign & QDOT_GE0) && (weak || (sign & QDOT_NE0)))
        return QDOT_OK;
    return qdot_defined_apart(j->pool, gap, weak, j->tell, j->user);
}

static qdot_status
report_conditions_of_function(struct job *j, qdot_expr e)
{
    qdot_pool *pool = j->pool;
    unsigned op = qdot_expr_node(pool, e)->op;
    qdot_expr u = qdot_expr_arg(pool, e, 0);

    switch (op) {
    case QDOT_LOG: return report_condition(j, u, false);
    case QDOT_ACOSH: return report_condition(j, qdot_sub(pool, u, QDOT_ONE), true);
    case QDOT_ASIN:
    case QDOT_ACOS:
    case QDOT_ATANH:
        QDOT_TRY(report_condition(j, qdot_sub(pool, QDOT_ONE, u), op != QDOT_ATANH));
        return report_condition(j, qdot_add(pool, QDOT_ONE, u), op != QDOT_ATANH);
    default: return QDOT_OK;
    }
}

/* Whether b^x may be a factor taken out of a root in the same product, and may be zero. */
static bool
may_be_taken_out_of_root(const qdot_pool *pool, qdot_expr b, qdot_expr x)
{
    const fmpq *k = qdot_expr_rational(pool, x);
    uint8_t sign = qdot_expr_node(pool, b)->sign;

    if ((sign & QDOT_NE0) || (k != NULL && fmpq_sgn(k) < 0))
        return false;
    return (sign & QDOT_GE0) || k == NULL || !fmpz_is_one(fmpq_denref(k)) ||
           fmpz_is_even(fmpq_numref(k));
}

static qdot_status
report_conditions_of_product(struct job *j, qdot_expr e)
{
    qdot_pool *pool = j->pool;
    uint32_t n = qdot_expr_count(pool, e);

    for (uint32_t i = 1; i < n; i += 2) {
        const fmpq *x = qdot_expr_rational(pool, qdot_expr_arg(pool, e, i + 1));
        bool alone = true;

        if (x == NULL || fmpz_is_one(fmpq_denref(x)))
            continue;
        for (uint32_t k = 1; k < n; k += 2)
            alone &= k == i || !may_be_taken_out_of_root(pool, qdot_expr_arg(pool, e, k),
                                                         qdot_expr_arg(pool, e, k + 1));
        if (alone)
            QDOT_TRY(report_condition(j, qdot_expr_arg(pool, e, i), fmpq_sgn(x) > 0));
    }
    return QDOT_OK;
}

qdot_status
qdot_defined(qdot_pool *pool, size_t n, const qdot_expr *e, qdot_defined_gap tell, void *user)
{
    struct job j = {pool, tell, user};
    qdot_status status = QDOT_OK;
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin_n(pool, n, e, &w));
    for (size_t i = 0; i < n; i++)
        if (e[i] != QDOT_NIL)
            qdot_walk_set(&w, e[i], 1);
    for (size_t i = w.n; i-- > 0 && status == QDOT_OK;) { /* parents before children */
        qdot_expr at = w.at[i];
        qdot_kind kind = qdot_expr_kind(pool, at);

        if (!qdot_walk_get(&w, at) || kind == QDOT_NUM || kind == QDOT_SYM ||
            kind == QDOT_LOGIC || kind == QDOT_REL ||
            (kind == QDOT_FUN && qdot_expr_node(pool, at)->op == QDOT_IF))
            continue;
        for (uint32_t k = 0; k < qdot_expr_count(pool, at); k++)
            if (qdot_walk_index(&w, qdot_expr_arg(pool, at, k)) != SIZE_MAX)
                qdot_walk_set(&w, qdot_expr_arg(pool, at, k), 1);
        if (kind == QDOT_FUN)
            status = report_conditions_of_function(&j, at);
        else if (kind == QDOT_PROD)
            status = report_conditions_of_product(&j, at);
    }
    qdot_walk_end(&w);
    return status;
}
