/* number.c -- numbers by their value: quotients, integers, decimals. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/pool.h"

#include <math.h>
#include <stdlib.h>

#include <flint/fmpz.h>

#include "base/text.h"

qdot_expr
qdot_expr_ratio(qdot_pool *pool, int64_t n, int64_t d)
{
    fmpq_t x;
    fmpz_t num, den;
    qdot_expr e;

    if (d == 0)
        return qdot_pool_refuse(pool, QDOT_EDOMAIN, "division by zero");
    fmpq_init(x);
    if (d > 0 && d < QDOT_SMALL && n > -QDOT_SMALL && n < QDOT_SMALL) {
        qdot_rational_make(x, n, d);
        return qdot_expr_fmpq(pool, x);
    }
    fmpz_init(num);
    fmpz_init(den);
    qdot_integer_set(num, n);
    qdot_integer_set(den, d);
    fmpq_set_fmpz_frac(x, num, den);
    e = qdot_expr_fmpq(pool, x);
    fmpz_clear(num);
    fmpz_clear(den);
    fmpq_clear(x);
    return e;
}

qdot_expr
qdot_expr_int(qdot_pool *pool, int64_t n)
{
    return n == 0    ? QDOT_ZERO
           : n == 1  ? QDOT_ONE
           : n == -1 ? QDOT_MINUS_ONE
                     : qdot_expr_ratio(pool, n, 1);
}

qdot_expr
qdot_expr_fmpz(qdot_pool *pool, const fmpz_t n)
{
    qdot_expr e;
    fmpq_t x;

    fmpq_init(x);
    fmpz_set(fmpq_numref(x), n);
    e = qdot_expr_fmpq(pool, x);
    fmpq_clear(x);
    return e;
}

/* Make the number digits * 10^exponent if its numerator and denominator fit into machine words; else return false. */
static bool
make_small_decimal(qdot_pool *pool, const char *digits, size_t n, int64_t exponent, qdot_expr *e)
{
    enum { MOST = 18 }; /* most digits that fit: 10^18 < 2^62 */
    int64_t top = 0, bottom = 1;
    fmpq x = {0, 1};

    if (n == 0 || n > MOST || exponent < -MOST || (exponent > 0 && (int64_t)n + exponent > MOST))
        return false;
    for (size_t i = 0; i < n; i++) {
        if (digits[i] < '0' || digits[i] > '9')
            return false;
        top = 10 * top + (digits[i] - '0');
    }
    for (; exponent > 0; exponent--)
        top *= 10;
    for (; exponent < 0; exponent++)
        bottom *= 10;
    qdot_rational_make(&x, top, bottom);
    *e = qdot_expr_fmpq(pool, &x);
    return true;
}

qdot_expr
qdot_expr_of_double(qdot_pool *pool, double x)
{
    int exponent;
    const int64_t mantissa = (int64_t)ldexp(frexp(x, &exponent), 53);

    return qdot_mul(pool, qdot_expr_int(pool, mantissa),
                    qdot_pow_int(pool, qdot_expr_int(pool, 2), exponent - 53));
}

qdot_expr
qdot_expr_decimal(qdot_pool *pool, const char *text, size_t length)
{
    qdot_text digits = {0};
    int64_t point = 0, exponent = 0;
    bool after = false, negative = false;
    size_t i = 0;
    fmpz_t n, ten;
    fmpq_t x;
    qdot_expr e = QDOT_NIL;

    for (; i < length && text[i] != 'e' && text[i] != 'E'; i++) {
        if (text[i] == '.') {
            after = true;
            continue;
        }
        qdot_text_char(&digits, text[i]);
        point += after;
    }
    if (i < length) {
        i++;
        if (i < length && (text[i] == '-' || text[i] == '+'))
            negative = text[i++] == '-';
        for (; i < length && exponent < 100000000; i++)
            exponent = exponent * 10 + (text[i] - '0');
    }
    exponent = (negative ? -exponent : exponent) - point;
    if (digits.n > 1000000 || llabs(exponent) > 1000000) {
        qdot_text_clear(&digits);
        return qdot_pool_refuse(pool, QDOT_ELIMIT,
                                "an exact number of more than 10^6 digits");
    }
    if (qdot_text_status(&digits) == QDOT_OK &&
        make_small_decimal(pool, qdot_text_str(&digits), digits.n, exponent, &e)) {
        qdot_text_clear(&digits);
        return e;
    }
    fmpz_init(n);
    fmpz_init_set_ui(ten, 10);
    fmpq_init(x);
    if (qdot_text_status(&digits) != QDOT_OK) {
        qdot_pool_fail(pool);
    } else if (fmpz_set_str(n, qdot_text_str(&digits), 10) != 0) {
        qdot_pool_refuse(pool, QDOT_ESYNTAX, "not a number");
    } else {
        fmpz_pow_ui(ten, ten, (ulong)llabs(exponent));
        fmpz_set(fmpq_numref(x), n);
        if (exponent >= 0) {
            fmpz_mul(fmpq_numref(x), n, ten);
        } else {
            fmpz_set(fmpq_denref(x), ten);
            fmpq_canonicalise(x);
        }
        e = qdot_expr_fmpq(pool, x);
    }
    fmpz_clear(n);
    fmpz_clear(ten);
    fmpq_clear(x);
    qdot_text_clear(&digits);
    return e;
}
