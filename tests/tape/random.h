/* random.h -- random expressions of coordinates, the same ones on every machine. */
#ifndef QDOT_TESTS_TAPE_RANDOM_H
#define QDOT_TESTS_TAPE_RANDOM_H

#include <stdint.h>
#include <stdio.h>

#include "expr/expr.h"

static uint64_t seed = 12345;

static inline unsigned
roll(unsigned n)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)((seed >> 33) % n);
}

static inline qdot_expr
coordinate(qdot_pool *pool, const char *family, int k)
{
    char name[32];

    snprintf(name, sizeof name, "%s[%d]", family, k);
    return qdot_symbol_get(pool, QDOT_COORD, name);
}

static inline qdot_expr
small_number(qdot_pool *pool)
{
    return qdot_expr_ratio(pool, (int64_t)roll(9) - 4, 1 + (int64_t)roll(4));
}

/* One more node above some of the first n of `have`. */
static inline qdot_expr
random_node(qdot_pool *pool, const qdot_expr *have, unsigned n)
{
    static const qdot_fun_id calm[] = {QDOT_SIN, QDOT_COS, QDOT_SIN, QDOT_COS, QDOT_TAN,
                                       QDOT_SEC, QDOT_ATAN, QDOT_TANH, QDOT_ASINH, QDOT_ABS,
                                       QDOT_SINH, QDOT_COSH, QDOT_EXP};
    qdot_expr x = have[roll(n)], y = have[roll(n)];
    qdot_expr square = qdot_add(pool, qdot_pow_int(pool, x, 2), QDOT_ONE);
    qdot_expr two[2] = {x, y};

    switch (roll(12)) {
    case 0: return qdot_add(pool, x, y);
    case 1: return qdot_sub(pool, x, y);
    case 2: return qdot_add(pool, qdot_mul(pool, small_number(pool), x),
                            qdot_mul(pool, small_number(pool), y));
    case 3: return qdot_mul(pool, x, y);
    case 4: return qdot_pow_int(pool, x, 2 + (int64_t)roll(3));
    case 5: return qdot_pow_int(pool, square, -1 - (int64_t)roll(3));
    case 6: return qdot_pow(pool, square, qdot_expr_ratio(pool, (int64_t)roll(7) - 3, 2));
    case 7: return qdot_fun1(pool, QDOT_SIN, qdot_add(pool, qdot_mul(pool, small_number(pool), x),
                                                      qdot_add(pool, small_number(pool), y)));
    case 8: return x == y ? x : qdot_fun(pool, roll(2) ? QDOT_MIN : QDOT_MAX, 2, two);
    case 9: return qdot_mul(pool, qdot_add(pool, QDOT_PI, small_number(pool)), x);
    case 10: {
        qdot_expr three[3] = {qdot_rel(pool, QDOT_LT, x, y), y, x};

        return qdot_fun(pool, QDOT_IF, 3, three);
    }
    default: return qdot_fun1(pool, calm[roll(sizeof calm / sizeof *calm)], x);
    }
}

#endif
