/* spec.h -- random formulas for the tests of expr/: built by the constructors, and computed apart
 * from them in long double.
 *
 * A formula is a list of steps, each an operation on earlier ones. formula_value() computes it as
 * it was written; node_value() computes what the constructors made of it.
 */
#ifndef TESTS_EXPR_SPEC_H
#define TESTS_EXPR_SPEC_H

#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>
#include <inttypes.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "expr/calculus.h"
#include "expr/expr.h"
#include "expr/print.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "num/integer.h"

enum { SYMBOLS = 9, STEPS = 24 };

/* A pool with symbols of every kind of domain; value[i] is where symbol[i] stands. */
typedef struct {
    qdot_pool *pool;
    qdot_expr symbol[SYMBOLS];
    long double value[SYMBOLS];
} place;

static uint64_t random_state = 88172645463325252u;

static inline uint32_t
random_below(uint32_t n)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return (uint32_t)(random_state >> 33) % n;
}

static inline long double
random_between(long double lo, long double hi)
{
    return lo + (hi - lo) * random_below(1000003) / 1000003.0L;
}

/* a, b free; m > 0; n < 0; k >= 0; x free, x'; 0 < theta < pi; -pi/2 <= alpha <= pi/2. */
static inline void
place_open(place *p)
{
    static const char *const param[] = {"a", "b", "m", "n", "k"};
    qdot_expr half_pi;

    p->pool = qdot_pool_new();
    assert_non_null(p->pool);
    for (int i = 0; i < 5; i++)
        p->symbol[i] = qdot_symbol_get(p->pool, QDOT_PARAM, param[i]);
    p->symbol[5] = qdot_symbol_get(p->pool, QDOT_COORD, "x");
    p->symbol[6] = qdot_symbol_jet(p->pool, p->symbol[5], 1);
    p->symbol[7] = qdot_symbol_get(p->pool, QDOT_COORD, "theta");
    p->symbol[8] = qdot_symbol_get(p->pool, QDOT_COORD, "alpha");
    half_pi = qdot_mul(p->pool, QDOT_HALF, QDOT_PI);
    qdot_symbol_domain(p->pool, p->symbol[2], QDOT_ZERO, true, QDOT_NIL, false);
    qdot_symbol_domain(p->pool, p->symbol[3], QDOT_NIL, false, QDOT_ZERO, true);
    qdot_symbol_domain(p->pool, p->symbol[4], QDOT_ZERO, false, QDOT_NIL, false);
    qdot_symbol_domain(p->pool, p->symbol[7], QDOT_ZERO, true, QDOT_PI, true);
    qdot_symbol_domain(p->pool, p->symbol[8], qdot_neg(p->pool, half_pi), false, half_pi,
                       false);
    assert_int_equal(qdot_pool_check(p->pool), QDOT_OK);
}

static inline void
place_close(place *p)
{
    qdot_pool_free(p->pool);
}

static inline void
place_move(place *p)
{
    for (int i = 0; i < SYMBOLS; i++)
        p->value[i] = random_between(-2, 2);
    p->value[2] = random_between(0.1L, 2);
    p->value[3] = random_between(-2, -0.1L);
    p->value[4] = random_below(8) == 0 ? 0 : random_between(0, 2);
    p->value[7] = random_between(0.05L, 3.09L);
    p->value[8] = random_between(-1.57L, 1.57L);
}

/* --- functions, apart from the table of the library ----------------------------------------- */

static inline long double
function_value(qdot_fun_id id, const long double *x)
{
    switch (id) {
    case QDOT_SIN: return sinl(*x);
    case QDOT_COS: return cosl(*x);
    case QDOT_TAN: return tanl(*x);
    case QDOT_SEC: return 1 / cosl(*x);
    case QDOT_CSC: return 1 / sinl(*x);
    case QDOT_COT: return 1 / tanl(*x);
    case QDOT_ASIN: return asinl(*x);
    case QDOT_ACOS: return acosl(*x);
    case QDOT_ATAN: return atanl(*x);
    case QDOT_ATAN2: return x[0] == 0 && x[1] == 0 ? NAN : atan2l(x[0], x[1]);
    case QDOT_SINH: return sinhl(*x);
    case QDOT_COSH: return coshl(*x);
    case QDOT_TANH: return tanhl(*x);
    case QDOT_ASINH: return asinhl(*x);
    case QDOT_ACOSH: return acoshl(*x);
    case QDOT_ATANH: return atanhl(*x);
    case QDOT_EXP: return expl(*x);
    case QDOT_LOG: return logl(*x);
    case QDOT_ERF: return erfl(*x);
    case QDOT_ERFC: return erfcl(*x);
    case QDOT_ABS: return fabsl(*x);
    case QDOT_SIGN: return (*x > 0) - (*x < 0);
    case QDOT_MIN: return x[0] < x[1] ? x[0] : x[1];
    case QDOT_MAX: return x[0] > x[1] ? x[0] : x[1];
    case QDOT_MOD: return x[0] - x[1] * floorl(x[0] / x[1]);
    case QDOT_FLOOR: return floorl(*x);
    default: return NAN;
    }
}

/* --- formulas --------------------------------------------------------------------------------- */

typedef enum {
    NUMBER,
    SYMBOL,
    PLUS,
    MINUS,
    TIMES,
    OVER,
    POWER,
    ROOT,
    CALL,
    OPERATIONS
} operation;

typedef struct {
    operation op;
    int64_t p, q; /* NUMBER p/q; SYMBOL p; POWER ^p; ROOT ^(p/q); CALL function p */
    int a, b;  /* operands: earlier steps */
} step;

typedef struct {
    step at[STEPS];
    int n;
} formula;

/* The operations with no kinks and no poles of their own: for derivatives, for expansion. */
enum { SMOOTH = 1, RATIONAL = 2 };

static inline formula
formula_random(int n, int mode)
{
    static const qdot_fun_id smooth[] = {
        QDOT_SIN,  QDOT_COS,   QDOT_TAN, QDOT_ATAN,  QDOT_SINH, QDOT_COSH,
        QDOT_TANH, QDOT_ASINH, QDOT_EXP, QDOT_LOG,   QDOT_ASIN, QDOT_ACOS,
        QDOT_SEC,  QDOT_CSC,   QDOT_COT, QDOT_ACOSH, QDOT_ATANH};
    formula f = {.n = n};

    for (int i = 0; i < n; i++) {
        step *s = &f.at[i];

        s->op = i < 3 ? (operation)random_below(2) : (operation)random_below(OPERATIONS);
        if (mode == RATIONAL && (s->op == ROOT || s->op == CALL))
            s->op = TIMES;
        s->a = i > 0 ? (int)random_below((uint32_t)i) : 0;
        s->b = i > 0 ? (int)random_below((uint32_t)i) : 0;
        s->p = (int64_t)random_below(7) - 3;
        s->q = 1 + (int64_t)random_below(4);
        if (s->op == SYMBOL)
            s->p = (int64_t)random_below(SYMBOLS);
        if (s->op == ROOT)
            s->q = 2 + (int64_t)random_below(3);
        if (s->op == CALL)
            s->p = mode == SMOOTH
                       ? (int64_t)smooth[random_below(sizeof smooth / sizeof *smooth)]
                       : (int64_t)random_below(QDOT_FUNCTION_COUNT - 1 - (QDOT_ABS - QDOT_ELLIPTIC_K));
        if (s->op == CALL && s->p >= QDOT_ELLIPTIC_K) /* elliptic integrals and functions have a test of their own */
            s->p += QDOT_ABS - QDOT_ELLIPTIC_K;
    }
    return f;
}

/* Every step's value in v; the last one's is returned. NAN: undefined, or so large that nothing
 * could be compared. */
static inline long double
formula_value(const formula *f, const place *p, long double *v)
{
    for (int i = 0; i < f->n; i++) {
        const step *s = &f->at[i];
        long double a = i > 0 ? v[s->a] : 0, b = i > 0 ? v[s->b] : 0, two[] = {a, b};

        switch (s->op) {
        case NUMBER: v[i] = (long double)s->p / s->q; break;
        case SYMBOL: v[i] = p->value[s->p]; break;
        case PLUS: v[i] = a + b; break;
        case MINUS: v[i] = a - b; break;
        case TIMES: v[i] = a * b; break;
        case OVER: v[i] = a / b; break;
        case POWER: v[i] = s->p == 0 ? 1 : powl(a, s->p); break;
        case ROOT: v[i] = powl(a, (long double)s->p / s->q); break;
        default: v[i] = function_value((qdot_fun_id)s->p, two);
        }
        if (!(fabsl(v[i]) < 1e5L) ||
            (s->op != NUMBER && v[i] != 0 && fabsl(v[i]) < 1e-5L))
            v[i] = NAN;
    }
    return v[f->n - 1];
}

static inline qdot_expr
formula_build(const formula *f, const place *p)
{
    qdot_expr e[STEPS], power;
    qdot_pool *pool = p->pool;

    for (int i = 0; i < f->n; i++) {
        const step *s = &f->at[i];
        qdot_expr a = i > 0 ? e[s->a] : QDOT_NIL, b = i > 0 ? e[s->b] : QDOT_NIL,
                  two[] = {a, b};
        qdot_fun_id id = (qdot_fun_id)s->p;

        switch (s->op) {
        case NUMBER: e[i] = qdot_expr_ratio(pool, s->p, s->q); break;
        case SYMBOL: e[i] = p->symbol[s->p]; break;
        case PLUS: e[i] = qdot_add(pool, a, b); break;
        case MINUS: e[i] = qdot_sub(pool, a, b); break;
        case TIMES: e[i] = qdot_mul(pool, a, b); break;
        case OVER: e[i] = qdot_div(pool, a, b); break;
        case POWER: e[i] = qdot_pow_int(pool, a, s->p); break;
        case ROOT:
            power = qdot_expr_ratio(pool, s->p, s->q);
            e[i] = qdot_pow(pool, a, power);
            break;
        default:
            e[i] = qdot_fun(pool, id,
                            id == QDOT_ATAN2 || id == QDOT_MOD || id == QDOT_MIN ||
                                    id == QDOT_MAX
                                ? 2
                                : 1,
                            two);
        }
    }
    return e[f->n - 1];
}

/* The formula on stderr, for a failure. */
static inline void
formula_show(const formula *f, const long double *v)
{
    static const char *const names[] = {"number", "symbol", "+",    "-",   "*",
                                        "/",      "power",  "root", "call"};

    for (int i = 0; i < f->n; i++)
        print_error("%2d: %s p=%" PRId64 " q=%" PRId64 " of %d, %d -> %.12Lg\n", i, names[f->at[i].op],
                    f->at[i].p, f->at[i].q, f->at[i].a, f->at[i].b, v[i]);
}

/* --- nodes ------------------------------------------------------------------------------------ */

static inline long double
rational_value(const fmpq *x)
{
    return (long double)qdot_integer_get(fmpq_numref(x)) / qdot_integer_get(fmpq_denref(x));
}

static inline long double
symbol_value(const place *p, qdot_expr e)
{
    if (e == QDOT_PI)
        return acosl(-1);
    for (int i = 0; i < SYMBOLS; i++)
        if (p->symbol[i] == e)
            return p->value[i];
    fail_msg("an unknown symbol");
    return NAN;
}

/* e where the symbols have their values; *claims (if wanted): whether every sign is true. */
static inline long double
node_value(const place *p, qdot_expr e, bool *claims)
{
    qdot_walk w;
    long double *v, result;

    assert_int_equal(qdot_walk_begin(p->pool, e, &w), QDOT_OK);
    v = calloc(w.n, sizeof *v);
    for (size_t i = 0; i < w.n; i++) {
        const qdot_node *node = qdot_expr_node(p->pool, w.at[i]);
        const qdot_expr *args = qdot_expr_args(p->pool, w.at[i]);
        long double x[8] = {0};

#define AT(k) v[qdot_walk_index(&w, args[k])]
        switch (node->kind) {
        case QDOT_NUM: v[i] = rational_value(qdot_expr_rational(p->pool, w.at[i])); break;
        case QDOT_SYM: v[i] = symbol_value(p, w.at[i]); break;
        case QDOT_SUM:
            v[i] = AT(0);
            for (uint32_t k = 1; k < node->n; k += 2)
                v[i] += AT(k) * AT(k + 1);
            break;
        case QDOT_PROD:
            v[i] = AT(0);
            for (uint32_t k = 1; k < node->n; k += 2)
                v[i] *= powl(AT(k), AT(k + 1));
            break;
        case QDOT_FUN:
            for (uint32_t k = 0; k < node->n && k < 8; k++)
                x[k] = AT(k);
            v[i] = function_value(node->op, x);
            break;
        default: fail_msg("a node that has no value");
        }
#undef AT
        /* rounding must not decide */
        if (claims != NULL && (fabsl(v[i]) > 1e-12L || node->kind <= QDOT_SYM))
            *claims &= !((node->sign & QDOT_GE0) && v[i] < 0) &&
                       !((node->sign & QDOT_LE0) && v[i] > 0) &&
                       !((node->sign & QDOT_NE0) && v[i] == 0);
    }
    result = v[w.n - 1];
    free(v);
    qdot_walk_end(&w);
    return result;
}

static inline bool
near(long double a, long double b, long double relative)
{
    return fabsl(a - b) <= relative * (1 + fabsl(a) + fabsl(b));
}

/* --- text -------------------------------------------------------------------------------------- */

/* e in a style, in a buffer that the next call but three reuses. */
static inline const char *
text_of(const qdot_pool *pool, qdot_expr e, qdot_style style)
{
    static char kept[4][65536];
    static int next;
    qdot_text out = {0};
    char *buffer = kept[next++ % 4];

    assert_int_equal(qdot_print(pool, e, style, &out), QDOT_OK);
    snprintf(buffer, sizeof kept[0], "%s", qdot_text_str(&out));
    qdot_text_clear(&out);
    return buffer;
}

#define assert_prints(pool, e, text)                                                     \
    assert_string_equal(text_of(pool, e, QDOT_PLAIN), text)

#endif
