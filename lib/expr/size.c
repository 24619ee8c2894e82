/* size.c -- counts the operations in an expression; each node stores its count, up to 32 bits. */
#include "base/memory.h"
#include "expr/exact.h"
#include "expr/pool.h"
#include "expr/walk.h"

static uint64_t
add_saturating(uint64_t a, uint64_t b)
{
    return a > UINT64_MAX - b ? UINT64_MAX : a + b;
}

/* The number of operations of a subexpression: from the walk w, or if that is NULL from its node. */
static uint64_t
child_size(const qdot_pool *pool, const qdot_walk *w, qdot_expr e)
{
    return w == NULL ? NODE(pool, e)->size : qdot_walk_get(w, e);
}

/* The number of operations counted for a rational: one for a division, one for a minus sign. */
static uint64_t
size_of_number(const fmpq *x)
{
    return !fmpz_is_one(fmpq_denref(x)) + (uint64_t)(qdot_rational_sgn(x) < 0);
}

static bool
begins_with_minus(const qdot_pool *pool, qdot_expr sum)
{
    const qdot_expr *args = ARGS(pool, sum);

    for (uint32_t i = 0; i < NODE(pool, sum)->n; i += 2)
        if (qdot_rational_sgn(RATIONAL(pool, args[i])) > 0 ||
            (i > 0 && qdot_rational_sgn(RATIONAL(pool, args[i])) < 0 &&
             qdot_expr_turnable(pool, args[i - 1]) != QDOT_NIL))
            return false;
    return true;
}

static bool
is_integer_rational(const fmpq *x)
{
    return fmpz_is_one(fmpq_denref(x));
}

static bool
is_unit_fraction(const fmpq *x) /* +-1/n: the numerator 1 is not written beside a factor */
{
    return fmpz_is_pm1(fmpq_numref(x));
}

static uint64_t
size_of_sum(const qdot_pool *pool, qdot_expr e, const qdot_walk *w)
{
    const qdot_expr *args = ARGS(pool, e);
    /* the minus of a term counts as the operator that joins it, if a term without minus can come first */
    uint64_t size = begins_with_minus(pool, e);

    for (uint32_t i = 1; i < NODE(pool, e)->n; i += 2) {
        const fmpq *c = RATIONAL(pool, args[i + 1]);

        size = add_saturating(size, child_size(pool, w, args[i]));
        size = add_saturating(size, (uint64_t)!is_integer_rational(c) + !is_unit_fraction(c) + (i > 1));
    }
    if (args[0] != QDOT_ZERO)
        size = add_saturating(size, 1 + (uint64_t)!is_integer_rational(RATIONAL(pool, args[0])));
    return size;
}

static uint64_t
size_of_product(const qdot_pool *pool, qdot_expr e, const qdot_walk *w)
{
    const qdot_expr *args = ARGS(pool, e);
    const fmpq *c = RATIONAL(pool, args[0]);
    uint64_t size = qdot_rational_sgn(c) < 0 && qdot_expr_turnable(pool, e) == QDOT_NIL;
    uint64_t operands = (uint64_t)!is_unit_fraction(c) + !is_integer_rational(c);
    bool above = !is_unit_fraction(c);

    for (uint32_t i = 1; i < NODE(pool, e)->n; i += 2) {
        const fmpq *x = NUMBER(pool, args[i + 1]);

        above |= x == NULL || qdot_rational_sgn(x) > 0;
        operands++;
        size = add_saturating(size, child_size(pool, w, args[i]));
        if (x == NULL)
            size = add_saturating(add_saturating(size, 1), child_size(pool, w, args[i + 1]));
        else if (!is_unit_fraction(x) || !is_integer_rational(x)) /* the exponent is written: a power or a root */
            size = add_saturating(size, 1);
    }
    return add_saturating(size, operands - above); /* a quotient counts as one more operation: 1/x divides too */
}

static uint64_t
size_of_node(const qdot_pool *pool, qdot_expr e, const qdot_walk *w)
{
    const qdot_node *node = NODE(pool, e);
    const qdot_expr *args = ARGS(pool, e);
    uint32_t n = node->kind == QDOT_UFUN ? node->n / 2 : node->n;
    uint64_t size = 0;

    switch (node->kind) {
    case QDOT_NUM: return size_of_number(RATIONAL(pool, e));
    case QDOT_SUM: return size_of_sum(pool, e, w);
    case QDOT_PROD: return size_of_product(pool, e, w);
    default:
        for (uint32_t i = 0; i < n; i++)
            size = add_saturating(size, child_size(pool, w, args[i]));
        for (uint32_t i = n; i < node->n; i++) /* the orders of derivatives of a UFUN */
            size = add_saturating(size, args[i] != QDOT_ZERO);
        return add_saturating(size, node->kind == QDOT_FUN || node->kind == QDOT_LOGIC || node->kind == QDOT_INTEGRAL);
    }
}

uint32_t
qdot_size_kept(const qdot_pool *pool, qdot_expr e)
{
    uint64_t size = size_of_node(pool, e, NULL);

    return size > QDOT_SIZE_LARGE ? QDOT_SIZE_LARGE : (uint32_t)size;
}

uint64_t
qdot_expr_size(const qdot_pool *pool, qdot_expr e)
{
    qdot_walk w;
    uint64_t size = 0;

    if (e == QDOT_NIL)
        return 0;
    if (NODE(pool, e)->size < QDOT_SIZE_LARGE)
        return NODE(pool, e)->size;
    if (qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return 0;
    for (size_t i = 0; i < w.n; i++)
        w.value[i] = size = size_of_node(pool, w.at[i], &w);
    qdot_walk_end(&w);
    return size;
}
