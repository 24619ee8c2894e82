/* reference.h -- expressions evaluated on the DAG in long double, with a bound of what
 * rounding may do in double. Written without anything of tape/. */
#ifndef QDOT_TESTS_TAPE_REFERENCE_H
#define QDOT_TESTS_TAPE_REFERENCE_H

#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include <mpfr.h>

#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/walk.h"

/* A value and the bound of its error. */
typedef struct {
    long double v, err;
} reference_value;

static const long double eps = 0x1p-52L;

static inline reference_value
rational(const fmpq *x)
{
    char *digits = fmpq_get_str(NULL, 10, x);
    mpfr_t m;
    mpq_t q;
    reference_value r;

    mpfr_init2(m, 64);
    mpq_init(q);
    mpq_set_str(q, digits, 10);
    flint_free(digits);
    mpfr_set_q(m, q, MPFR_RNDN);
    mpq_clear(q);
    r.v = mpfr_get_ld(m, MPFR_RNDN);
    r.err = eps * fabsl(r.v);
    mpfr_clear(m);
    return r;
}

static inline long double
call(unsigned op, long double x)
{
    switch (op) {
    case QDOT_SIN: return sinl(x);
    case QDOT_COS: return cosl(x);
    case QDOT_TAN: return tanl(x);
    case QDOT_SEC: return 1 / cosl(x);
    case QDOT_CSC: return 1 / sinl(x);
    case QDOT_COT: return 1 / tanl(x);
    case QDOT_ASIN: return asinl(x);
    case QDOT_ACOS: return acosl(x);
    case QDOT_ATAN: return atanl(x);
    case QDOT_SINH: return sinhl(x);
    case QDOT_COSH: return coshl(x);
    case QDOT_TANH: return tanhl(x);
    case QDOT_ASINH: return asinhl(x);
    case QDOT_ACOSH: return acoshl(x);
    case QDOT_ATANH: return atanhl(x);
    case QDOT_EXP: return expl(x);
    case QDOT_LOG: return logl(x);
    case QDOT_ERF: return erfl(x);
    case QDOT_ERFC: return erfcl(x);
    case QDOT_ABS: return fabsl(x);
    case QDOT_SIGN: return (x > 0) - (x < 0);
    case QDOT_FLOOR: return floorl(x);
    default: fail_msg("function %u has no reference", op); return 0;
    }
}

static inline reference_value
function(unsigned op, const reference_value *x, unsigned n)
{
    reference_value r = {0};

    if (op == QDOT_MIN || op == QDOT_MAX) {
        r = x[0];
        for (unsigned i = 1; i < n; i++) {
            if (op == QDOT_MIN ? x[i].v < r.v : x[i].v > r.v)
                r.v = x[i].v;
            r.err = fmaxl(r.err, x[i].err);
        }
    } else if (op == QDOT_MOD) {
        r.v = x[0].v - x[1].v * floorl(x[0].v / x[1].v);
        r.err = x[0].err + fabsl(x[0].v / x[1].v) * x[1].err + eps * fabsl(x[0].v);
    } else if (op == QDOT_ATAN2) {
        r.v = atan2l(x[0].v, x[1].v);
        r.err = 8 * eps + (x[0].err + x[1].err) / hypotl(x[0].v, x[1].v);
    } else if (op == QDOT_IF) {
        r = x[0].v != 0 ? x[1] : x[2];
    } else {
        long double h = fmaxl(x[0].err, 0x1p-40L * fmaxl(1, fabsl(x[0].v)));

        r.v = call(op, x[0].v);
        r.err = fabsl(call(op, x[0].v + h) - call(op, x[0].v - h)) / h * x[0].err
                + 30 * eps * (1 + fabsl(r.v)) * (1 + fabsl(r.v)); /* sums of angles */
    }
    return r;
}

static inline reference_value
node_value(const qdot_pool *pool, qdot_expr e, const reference_value *x, unsigned n)
{
    const qdot_node *node = qdot_expr_node(pool, e);
    reference_value r = {0};

    switch (node->kind) {
    case QDOT_NUM:
        return rational(qdot_expr_rational(pool, e));
    case QDOT_SYM:
        if (e == QDOT_PI)
            return (reference_value){M_PIl, eps * 4};
        fail_msg("a symbol without a value");
        return r;
    case QDOT_SUM:
        r = x[0];
        for (unsigned i = 1; i < n; i += 2) {
            long double t = x[i].v * x[i + 1].v;

            r.v += t;
            r.err += fabsl(x[i + 1].v) * x[i].err + 3 * eps * fabsl(t) + eps * fabsl(r.v);
        }
        return r;
    case QDOT_PROD:
        r.v = x[0].v;
        for (unsigned i = 1; i < n; i += 2)
            r.v *= powl(x[i].v, x[i + 1].v);
        r.err = (n + 4) * eps * fabsl(r.v);
        for (unsigned i = 1; i < n; i += 2)
            r.err += fabsl(r.v)
                     * (fabsl(x[i + 1].v / x[i].v) * x[i].err
                        + 4 * eps * fabsl(x[i + 1].v)
                        + fabsl(logl(fabsl(x[i].v))) * x[i + 1].err);
        return r;
    case QDOT_FUN:
        return function(node->op, x, n);
    case QDOT_REL:
        r.v = node->op == QDOT_LT   ? x[0].v < x[1].v
              : node->op == QDOT_LE ? x[0].v <= x[1].v
                                    : x[0].v == x[1].v;
        return r;
    case QDOT_LOGIC:
        r.v = node->op == QDOT_NOT ? !x[0].v : node->op == QDOT_AND;
        for (unsigned i = 0; i < n && node->op != QDOT_NOT; i++)
            r.v = node->op == QDOT_AND ? r.v && x[i].v : r.v || x[i].v;
        return r;
    default:
        fail_msg("kind %u has no reference", node->kind);
        return r;
    }
}

static inline reference_value
reference(qdot_pool *pool, qdot_expr e, size_t n, const qdot_expr *inputs,
          const long double *at)
{
    qdot_walk w;
    reference_value *v, result;

    assert_int_equal(qdot_walk_begin(pool, e, &w), QDOT_OK);
    v = calloc(w.n, sizeof *v);
    for (size_t i = 0; i < w.n; i++) {
        qdot_kind kind = qdot_expr_kind(pool, w.at[i]);
        unsigned count = kind == QDOT_NUM || kind == QDOT_SYM
                             ? 0
                             : qdot_expr_count(pool, w.at[i]);
        reference_value *x = calloc(count + 1, sizeof *x);
        bool input = false;

        for (size_t k = 0; k < n; k++)
            if (w.at[i] == inputs[k]) {
                v[i] = (reference_value){at[k], 0};
                input = true;
            }
        for (unsigned k = 0; k < count; k++)
            x[k] = v[qdot_walk_index(&w, qdot_expr_arg(pool, w.at[i], k))];
        if (!input)
            v[i] = node_value(pool, w.at[i], x, count);
        free(x);
    }
    result = v[qdot_walk_index(&w, e)];
    free(v);
    qdot_walk_end(&w);
    return result;
}

#endif
