/* elimination.c -- Gauss's elimination on rows of expressions. */
#include "mech/linear/elimination.h"

#include <math.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"

/* Numbers are rounded to this many bits after each step, so that they do not grow. */
enum {
    BITS = 128,
    LONG_CONSTANT = 20 /* operations */
};

/* Round a rational number to BITS significant bits; what is below 2^-90 becomes 0: it is the rounding of earlier steps
 * in numbers of ordinary size. */
static qdot_expr
rounded_number(qdot_pool *pool, qdot_expr e)
{
    const fmpq *x = qdot_expr_rational(pool, e);
    slong size, shift;
    fmpz_t p;
    fmpq_t y;

    if (x == NULL || (fmpz_bits(fmpq_numref(x)) <= BITS && fmpz_bits(fmpq_denref(x)) <= BITS))
        return e;
    size = (slong)fmpz_bits(fmpq_numref(x)) - (slong)fmpz_bits(fmpq_denref(x));
    if (size < -90)
        return QDOT_ZERO;
    shift = BITS - size;
    fmpz_init(p);
    fmpq_init(y);
    if (shift >= 0)
        fmpz_mul_2exp(p, fmpq_numref(x), (ulong)shift);
    else
        fmpz_tdiv_q_2exp(p, fmpq_numref(x), (ulong)-shift);
    fmpz_tdiv_q(p, p, fmpq_denref(x));
    fmpz_set(fmpq_numref(y), p);
    if (shift >= 0)
        fmpq_div_2exp(y, y, (ulong)shift);
    else
        fmpq_mul_2exp(y, y, (ulong)-shift);
    e = qdot_expr_fmpq(pool, y);
    fmpz_clear(p);
    fmpq_clear(y);
    return e;
}

/* Whether e is a constant that numbers say better, as a sum of products of sin(1/4) and cos(2/3). */
static bool
is_long_constant(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_node(pool, e)->size > LONG_CONSTANT && qdot_expr_is_constant(pool, e);
}

qdot_expr
qdot_elimination_short(qdot_elimination *x, qdot_expr e)
{
    if (e == QDOT_NIL || qdot_expr_kind(x->pool, e) == QDOT_SYM)
        return e;
    if (qdot_expr_kind(x->pool, e) == QDOT_NUM)
        return x->numbers ? rounded_number(x->pool, e) : e;
    x->work += qdot_expr_node(x->pool, e)->size;
    if (x->most > 0 && (x->work > x->most || is_long_constant(x->pool, e))) {
        (void)qdot_fail(QDOT_ELIMIT, "the linear motion is too long to be written in symbols");
        return qdot_pool_fail(x->pool);
    }
    return qdot_simplify(x->pool, e, x->facts);
}

bool
qdot_elimination_is_zero(const qdot_elimination *x, qdot_expr e)
{
    return e == QDOT_ZERO || (e != QDOT_NIL && !x->numbers && qdot_is_zero(x->pool, e, x->facts));
}

qdot_expr
qdot_elimination_minus(qdot_elimination *x, qdot_expr a, qdot_expr b, qdot_expr c)
{
    if (b == QDOT_ZERO || c == QDOT_ZERO)
        return a;
    return qdot_elimination_short(x, qdot_sub(x->pool, a, qdot_mul(x->pool, b, c)));
}

qdot_status
qdot_echelon_begin(qdot_echelon *e, size_t rows, size_t lead, size_t width)
{
    *e = (qdot_echelon){.width = width, .lead = lead};
    e->row = qdot_calloc(rows * width + 1, sizeof *e->row);
    e->pivot = qdot_calloc(rows + 1, sizeof *e->pivot);
    return e->row == NULL || e->pivot == NULL ? QDOT_ENOMEM : QDOT_OK;
}

void
qdot_echelon_end(qdot_echelon *e)
{
    qdot_free(e->row);
    qdot_free(e->pivot);
    *e = (qdot_echelon){0};
}

/* Subtract `by` times the row `other` from `row`. */
static qdot_status
subtract_multiple(qdot_elimination *x, size_t width, qdot_expr *row, qdot_expr by, const qdot_expr *other)
{
    for (size_t i = 0; i < width && by != QDOT_ZERO; i++)
        row[i] = qdot_elimination_minus(x, row[i], by, other[i]);
    return qdot_pool_check(x->pool);
}

/* The column in which the row may lead: the first entry that is not 0, in numbers the first that is not small beside the
 * largest; `lead` if there is none. */
static size_t
leading_column(const qdot_elimination *x, const qdot_echelon *e, const qdot_expr *row)
{
    double most = 0;
    size_t j = 0;

    if (!x->numbers) {
        while (j < e->lead && qdot_elimination_is_zero(x, row[j]))
            j++;
        return j;
    }
    for (size_t i = 0; i < e->lead; i++) {
        const double size = fabs(fmpq_get_d(qdot_expr_rational(x->pool, row[i])));

        most = size > most ? size : most;
    }
    if (most < 1e-10)
        return e->lead;
    while (fabs(fmpq_get_d(qdot_expr_rational(x->pool, row[j]))) < 1e-3 * most)
        j++;
    return j;
}

qdot_status
qdot_echelon_add(qdot_elimination *x, qdot_echelon *e, qdot_expr *row, bool *independent)
{
    qdot_expr *own = e->row + e->rank * e->width;
    size_t j;

    QDOT_TRY(qdot_pool_check(x->pool));
    for (size_t r = 0; r < e->rank; r++)
        QDOT_TRY(subtract_multiple(x, e->width, row, row[e->pivot[r]], e->row + r * e->width));
    j = leading_column(x, e, row);
    *independent = j < e->lead;
    if (!*independent)
        return qdot_pool_check(x->pool);
    for (size_t i = 0; i < e->width; i++)
        own[i] = i == j ? QDOT_ONE
                 : row[i] == QDOT_ZERO
                     ? QDOT_ZERO
                     : qdot_elimination_short(x, qdot_div(x->pool, row[i], row[j]));
    QDOT_TRY(qdot_pool_check(x->pool));
    for (size_t r = 0; r < e->rank; r++)
        QDOT_TRY(subtract_multiple(x, e->width, e->row + r * e->width, e->row[r * e->width + j], own));
    e->pivot[e->rank++] = j;
    return qdot_pool_check(x->pool);
}

bool
qdot_echelon_leads(const qdot_echelon *e, size_t j)
{
    for (size_t r = 0; r < e->rank; r++)
        if (e->pivot[r] == j)
            return true;
    return false;
}

void
qdot_echelon_null_space(qdot_pool *pool, const qdot_echelon *e, qdot_expr *N)
{
    const size_t m = e->lead - e->rank;

    for (size_t i = 0; i < e->lead * m; i++)
        N[i] = QDOT_ZERO;
    for (size_t j = 0, a = 0; j < e->lead; j++) {
        if (qdot_echelon_leads(e, j))
            continue;
        N[j * m + a] = QDOT_ONE;
        for (size_t r = 0; r < e->rank; r++)
            N[e->pivot[r] * m + a] = qdot_neg(pool, e->row[r * e->width + j]);
        a++;
    }
}
