/* elementary.c -- elementary functions: special values, parity, inverse pairs, derivatives. */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/elliptic.h"
#include "expr/exact.h"
#include "expr/integral.h"
#include "expr/jacobi.h"
#include "expr/pool.h"
#include "expr/walk.h"

#include <flint/fmpz.h>

static qdot_expr
make_function_node(qdot_pool *pool, qdot_fun_id id, uint32_t n, const qdot_expr *args)
{
    return qdot_pool_intern(pool, QDOT_FUN, (uint16_t)id, n, args,
                            qdot_sign_of_function(pool, id, args));
}

bool
qdot_expr_is_function_that(const qdot_pool *pool, qdot_expr e, unsigned traits)
{
    return NODE(pool, e)->kind == QDOT_FUN && qdot_fun_is(NODE(pool, e)->op, traits);
}

bool
qdot_expr_is_function(const qdot_pool *pool, qdot_expr e, qdot_fun_id id)
{
    return NODE(pool, e)->kind == QDOT_FUN && NODE(pool, e)->op == id;
}

qdot_expr
qdot_expr_find_function(qdot_pool *pool, qdot_expr e, size_t n, const qdot_fun_id *ids, qdot_expr x)
{
    qdot_expr found = QDOT_NIL;
    qdot_walk w;

    if (qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < w.n && found == QDOT_NIL; i++)
        for (size_t k = 0; k < n && found == QDOT_NIL; k++)
            if (qdot_expr_is_function(pool, w.at[i], ids[k]) &&
                (x == QDOT_NIL || qdot_expr_contains(pool, w.at[i], x)))
                found = w.at[i];
    qdot_walk_end(&w);
    return found;
}

static qdot_expr
first_argument(const qdot_pool *pool, qdot_expr e)
{
    return ARGS(pool, e)[0];
}

/* --- circular functions at rational multiples of pi ---------------------------------------- */

/* Split x into c pi + rest with a rational c; returns the rest. */
static qdot_expr
split_multiple_of_pi(qdot_pool *pool, qdot_expr x, fmpq_t c)
{
    const qdot_node *node = NODE(pool, x);

    fmpq_zero(c);
    if (node->kind == QDOT_SUM) {
        for (uint32_t i = 1; i < node->n; i += 2)
            if (ARGS(pool, x)[i] == QDOT_PI) {
                qdot_rational_set(c, RATIONAL(pool, ARGS(pool, x)[i + 1]));
                return qdot_sub(pool, x, qdot_mul(pool, ARGS(pool, x)[i + 1], QDOT_PI));
            }
    } else if (qdot_expr_unscale(pool, x, c) == QDOT_PI) {
        return QDOT_ZERO;
    }
    fmpq_zero(c);
    return x;
}

/* sin(k pi/12) for 0 <= k <= 6, as a sum of two terms of the form a sqrt(b). */
static qdot_expr
sine_of_twelfths(qdot_pool *pool, int64_t k)
{
    qdot_expr root2 = qdot_sqrt(pool, qdot_expr_int(pool, 2));
    qdot_expr root3 = qdot_sqrt(pool, qdot_expr_int(pool, 3));
    qdot_expr root6 = qdot_sqrt(pool, qdot_expr_int(pool, 6));
    qdot_expr quarter = qdot_expr_ratio(pool, 1, 4);

    switch (k) {
    case 0: return QDOT_ZERO;
    case 1:
        return qdot_add(pool, qdot_mul(pool, quarter, root6),
                        qdot_neg(pool, qdot_mul(pool, quarter, root2)));
    case 2: return QDOT_HALF;
    case 3: return qdot_mul(pool, QDOT_HALF, root2);
    case 4: return qdot_mul(pool, QDOT_HALF, root3);
    case 5:
        return qdot_add(pool, qdot_mul(pool, quarter, root6),
                        qdot_mul(pool, quarter, root2));
    default: return QDOT_ONE;
    }
}

/* sin(k pi/12) for any integer k. */
static qdot_expr
sine_of_any_twelfth(qdot_pool *pool, int64_t k)
{
    k = ((k % 24) + 24) % 24;
    if (k >= 12)
        return qdot_neg(pool, sine_of_any_twelfth(pool, k - 12));
    return sine_of_twelfths(pool, k <= 6 ? k : 12 - k);
}

/* a/b for two values of the sine at multiples of pi/12; QDOT_EDOMAIN for b = 0. */
static qdot_expr
quotient_of_values(qdot_pool *pool, qdot_fun_id id, qdot_expr a, qdot_expr b)
{
    if (b == QDOT_ZERO)
        return qdot_pool_refuse(pool, QDOT_EDOMAIN,
                                "%s is undefined here: division by zero",
                                qdot_fun_name(id));
    return qdot_div(pool, a, b);
}

/* The circular functions at k pi/12, by those of the double angle, which hold one root only:
 * tan x = (1 - cos 2x)/sin 2x, cot x = (1 + cos 2x)/sin 2x, 1/cos x = 2 sin x/sin 2x. */
static qdot_expr
circular_value_at_twelfth(qdot_pool *pool, qdot_fun_id id, int64_t k)
{
    qdot_expr s = sine_of_any_twelfth(pool, k), c = sine_of_any_twelfth(pool, k + 6);
    qdot_expr s2 = sine_of_any_twelfth(pool, 2 * k), c2 = sine_of_any_twelfth(pool, 2 * k + 6);
    bool halves = k % 2 != 0;

    switch (id) {
    case QDOT_SIN: return s;
    case QDOT_COS: return c;
    case QDOT_TAN:
    case QDOT_COT:
        if (!halves)
            return id == QDOT_TAN ? quotient_of_values(pool, id, s, c) : quotient_of_values(pool, id, c, s);
        c2 = quotient_of_values(pool, id, c2, s2);
        s2 = quotient_of_values(pool, id, QDOT_ONE, s2);
        return id == QDOT_TAN ? qdot_sub(pool, s2, c2) : qdot_add(pool, s2, c2);
    default:
        if (!halves)
            return quotient_of_values(pool, id, QDOT_ONE, id == QDOT_SEC ? c : s);
        s2 = quotient_of_values(pool, id, qdot_expr_int(pool, 2), s2);
        return qdot_expand(pool, qdot_mul(pool, s2, id == QDOT_SEC ? s : c));
    }
}

/* Write f(x + quarters pi/2), with f a circular function, by f or its co-function at x. */
static qdot_expr
shift_by_quarter_turns(qdot_pool *pool, qdot_fun_id id, qdot_expr x, int64_t quarters)
{
    static const struct {
        qdot_fun_id to;
        int sign;
    } rows[6][4] = {
        {{QDOT_SIN, 1}, {QDOT_COS, 1}, {QDOT_SIN, -1}, {QDOT_COS, -1}},
        {{QDOT_COS, 1}, {QDOT_SIN, -1}, {QDOT_COS, -1}, {QDOT_SIN, 1}},
        {{QDOT_TAN, 1}, {QDOT_COT, -1}, {QDOT_TAN, 1}, {QDOT_COT, -1}},
        {{QDOT_SEC, 1}, {QDOT_CSC, -1}, {QDOT_SEC, -1}, {QDOT_CSC, 1}},
        {{QDOT_CSC, 1}, {QDOT_SEC, 1}, {QDOT_CSC, -1}, {QDOT_SEC, -1}},
        {{QDOT_COT, 1}, {QDOT_TAN, -1}, {QDOT_COT, 1}, {QDOT_TAN, -1}},
    };
    int row = (int)id - QDOT_SIN;
    qdot_expr e = qdot_fun1(pool, rows[row][quarters].to, x);

    return rows[row][quarters].sign < 0 ? qdot_neg(pool, e) : e;
}

/* The function of x, after a leading minus of x was taken out by parity: sin(-x) = -sin(x). */
static qdot_expr
apply_parity(qdot_pool *pool, qdot_fun_id id, qdot_expr x)
{
    bool odd = id != QDOT_COS && id != QDOT_SEC;
    qdot_expr e;

    if (!qdot_expr_is_negative(pool, x))
        return make_function_node(pool, id, 1, &x);
    e = qdot_fun1(pool, id, qdot_neg(pool, x));
    return odd ? qdot_neg(pool, e) : e;
}

static qdot_expr
simplify_circular(qdot_pool *pool, qdot_fun_id id, qdot_expr x)
{
    static const qdot_fun_id inverse_of[] = {QDOT_ASIN, QDOT_ACOS, QDOT_ATAN};
    fmpq_t c, twelve;
    qdot_expr rest, e = QDOT_NIL;

    if (id <= QDOT_TAN && qdot_expr_is_function(pool, x, inverse_of[id - QDOT_SIN]))
        return first_argument(pool, x);
    if (x != QDOT_ZERO && !(NODE(pool, x)->touches & NODE(pool, QDOT_PI)->touches))
        return apply_parity(pool, id, x);
    fmpq_init(c);
    fmpq_init(twelve);
    rest = split_multiple_of_pi(pool, x, c);
    qdot_rational_mul(twelve, c, &(fmpq){12, 1});
    if (rest == QDOT_ZERO && fmpz_is_one(fmpq_denref(twelve))) {
        int64_t k = (int64_t)fmpz_fdiv_ui(fmpq_numref(twelve), 24);

        e = circular_value_at_twelfth(pool, id, k);
    } else if (rest != QDOT_ZERO && rest != QDOT_NIL && !fmpq_is_zero(c) &&
               fmpz_divisible_si(fmpq_numref(twelve), 6) &&
               fmpz_is_one(fmpq_denref(twelve))) {
        e = shift_by_quarter_turns(pool, id, rest, (int64_t)fmpz_fdiv_ui(fmpq_numref(twelve), 24) / 6);
    } else {
        e = apply_parity(pool, id, x);
    }
    fmpq_clear(c);
    fmpq_clear(twelve);
    return e;
}

/* --- inverse circular functions at exactly known values ----------------------------------- */

static qdot_expr
simplify_inverse_circular(qdot_pool *pool, qdot_fun_id id, qdot_expr x)
{
    const fmpq *v = NUMBER(pool, x);
    bool out = v != NULL && (fmpq_cmp_si(v, 1) > 0 || fmpq_cmp_si(v, -1) < 0);

    if (id == QDOT_ACOS) {
        if (out)
            return qdot_pool_refuse(pool, QDOT_EDOMAIN, "acos is defined from -1 to 1");
        if (!NODE(pool, x)->holds) {
            qdot_expr s = simplify_inverse_circular(pool, QDOT_ASIN, x);

            if (s != QDOT_NIL && !(NODE(pool, s)->holds & QDOT_HAS_FUN))
                return qdot_sub(pool, qdot_mul(pool, QDOT_HALF, QDOT_PI), s);
        }
        return make_function_node(pool, id, 1, &x);
    }
    if (id == QDOT_ASIN && out)
        return qdot_pool_refuse(pool, QDOT_EDOMAIN, "asin is defined from -1 to 1");
    if (!(NODE(pool, x)->holds)) {
        for (int64_t k = -6; k <= 6; k++) {
            qdot_expr value = QDOT_NIL;

            if (id == QDOT_ASIN)
                value = sine_of_any_twelfth(pool, k);
            else if (k > -6 && k < 6)
                value = circular_value_at_twelfth(pool, QDOT_TAN, k);
            if (value == x && value != QDOT_NIL)
                return qdot_mul(pool, qdot_expr_ratio(pool, k, 12), QDOT_PI);
        }
    }
    if (qdot_expr_is_negative(pool, x))
        return qdot_neg(pool, simplify_inverse_circular(pool, id, qdot_neg(pool, x)));
    return make_function_node(pool, id, 1, &x);
}

/* --- hyperbolic functions, exponentials, logarithms ---------------------------------------- */

static qdot_expr
simplify_hyperbolic(qdot_pool *pool, qdot_fun_id id, qdot_expr x)
{
    bool even = qdot_fun_is(id, QDOT_FUN_EVEN);

    if (qdot_expr_is_function(pool, x, qdot_fun_facts_of(id)->inverse) && id != QDOT_ACOSH)
        return first_argument(pool, x);
    if (id == QDOT_ACOSH && qdot_expr_is_function(pool, x, QDOT_COSH))
        return qdot_fun1(pool, QDOT_ABS, first_argument(pool, x));
    if (x == QDOT_ZERO && id != QDOT_ACOSH)
        return even ? QDOT_ONE : QDOT_ZERO;
    if (id == QDOT_ACOSH && x == QDOT_ONE)
        return QDOT_ZERO;
    if (qdot_fun_is(id, QDOT_FUN_AREA) && NUMBER(pool, x) != NULL) {
        const fmpq *v = NUMBER(pool, x);

        if (id == QDOT_ACOSH && fmpq_cmp_si(v, 1) < 0)
            return qdot_pool_refuse(pool, QDOT_EDOMAIN, "acosh is defined from 1 up");
        if (id == QDOT_ATANH && (fmpq_cmp_si(v, 1) >= 0 || fmpq_cmp_si(v, -1) <= 0))
            return qdot_pool_refuse(pool, QDOT_EDOMAIN,
                                    "atanh is defined between -1 and 1");
    }
    if (id != QDOT_ACOSH && qdot_expr_is_negative(pool, x)) {
        qdot_expr e = qdot_fun1(pool, id, qdot_neg(pool, x));

        return even ? e : qdot_neg(pool, e);
    }
    return make_function_node(pool, id, 1, &x);
}

static qdot_expr
simplify_exp(qdot_pool *pool, qdot_expr x)
{
    if (x == QDOT_ZERO)
        return QDOT_ONE;
    if (qdot_expr_is_function(pool, x, QDOT_LOG))
        return first_argument(pool, x);
    if (NODE(pool, x)->kind == QDOT_PROD &&
        NODE(pool, x)->n == 3 && /* exp(k log a) = a^k */
        ARGS(pool, x)[2] == QDOT_ONE && qdot_expr_is_function(pool, ARGS(pool, x)[1], QDOT_LOG))
        return qdot_pow(pool, first_argument(pool, ARGS(pool, x)[1]), ARGS(pool, x)[0]);
    return make_function_node(pool, QDOT_EXP, 1, &x);
}

/* erf is odd, erfc(-x) = 2 - erfc(x). */
static qdot_expr
simplify_error_function(qdot_pool *pool, qdot_fun_id id, qdot_expr x)
{
    if (x == QDOT_ZERO)
        return id == QDOT_ERF ? QDOT_ZERO : QDOT_ONE;
    if (qdot_expr_is_negative(pool, x)) {
        qdot_expr e = qdot_neg(pool, qdot_fun1(pool, id, qdot_neg(pool, x)));

        return id == QDOT_ERF ? e : qdot_add(pool, qdot_expr_int(pool, 2), e);
    }
    return make_function_node(pool, id, 1, &x);
}

static qdot_expr
simplify_logarithm(qdot_pool *pool, qdot_expr x)
{
    const fmpq *v = NUMBER(pool, x);

    if (x == QDOT_ONE)
        return QDOT_ZERO;
    if (v != NULL && qdot_rational_sgn(v) <= 0)
        return qdot_pool_refuse(pool, QDOT_EDOMAIN,
                                "log is defined for positive numbers only");
    if (qdot_expr_is_function(pool, x, QDOT_EXP))
        return first_argument(pool, x);
    return make_function_node(pool, QDOT_LOG, 1, &x);
}

/* --- absolute value, sign, max, min, floor and the like -------------------------------------- */

static qdot_expr
simplify_absolute_value(qdot_pool *pool, qdot_expr x)
{
    fmpq_t c;
    qdot_expr rest, e;

    if (NODE(pool, x)->sign & QDOT_GE0)
        return x;
    if (NODE(pool, x)->sign & QDOT_LE0)
        return qdot_neg(pool, x);
    fmpq_init(c);
    rest = qdot_expr_unscale(pool, x, c);
    if (NODE(pool, x)->kind == QDOT_PROD && !fmpq_is_one(c)) {
        fmpq_abs(c, c);
        e = qdot_mul(pool, qdot_expr_fmpq(pool, c), qdot_fun1(pool, QDOT_ABS, rest));
    } else if (NODE(pool, x)->kind == QDOT_SUM && qdot_expr_is_negative(pool, x)) {
        e = qdot_fun1(pool, QDOT_ABS, qdot_neg(pool, x));
    } else {
        e = make_function_node(pool, QDOT_ABS, 1, &x);
    }
    fmpq_clear(c);
    return e;
}

/* The product x without those factors that are known to be positive; it has the same sign. */
static qdot_expr
drop_positive_factors(qdot_pool *pool, qdot_expr x)
{
    qdot_expr rest = QDOT_ONE;
    uint32_t n;

    if (x == QDOT_NIL || NODE(pool, x)->kind != QDOT_PROD || NODE(pool, x)->n <= 3)
        return x;
    n = NODE(pool, x)->n;
    for (uint32_t i = 1; i < n; i += 2)
        if ((NODE(pool, ARGS(pool, x)[i])->sign & QDOT_POS) != QDOT_POS)
            rest = qdot_mul(pool, rest,
                            qdot_pow(pool, ARGS(pool, x)[i], ARGS(pool, x)[i + 1]));
    return rest;
}

static qdot_expr
simplify_sign(qdot_pool *pool, qdot_expr x)
{
    uint8_t s = NODE(pool, x)->sign;

    if ((s & QDOT_POS) == QDOT_POS)
        return QDOT_ONE;
    if ((s & QDOT_NEG) == QDOT_NEG)
        return QDOT_MINUS_ONE;
    if (x == QDOT_ZERO)
        return QDOT_ZERO;
    if (qdot_expr_is_negative(pool, x))
        return qdot_neg(pool, simplify_sign(pool, qdot_neg(pool, x)));
    x = drop_positive_factors(pool, qdot_expr_strip(pool, x));
    return x == QDOT_NIL ? x : make_function_node(pool, QDOT_SIGN, 1, &x);
}

/* Whether `other` decides that a number is not needed among the arguments of min or max: max(u, 0) is u
 * where u >= 0 is known. */
static bool
makes_number_redundant(const qdot_pool *pool, qdot_fun_id id, qdot_expr number, qdot_expr other)
{
    const bool max = id == QDOT_MAX;

    return NUMBER(pool, other) == NULL && (NODE(pool, number)->sign & (max ? QDOT_LE0 : QDOT_GE0))
           && (NODE(pool, other)->sign & (max ? QDOT_GE0 : QDOT_LE0));
}

static qdot_expr
simplify_min_or_max(qdot_pool *pool, qdot_fun_id id, uint32_t n, const qdot_expr *args)
{
    qdot_expr best = args[0], few[16];
    uint32_t k = 0;

    for (uint32_t i = 0; i < n; i++) {
        const fmpq *v = NUMBER(pool, args[i]),
                   *b = NUMBER(pool, best);

        if (v == NULL || b == NULL)
            break;
        if (i + 1 == n)
            k = 1;
        if ((id == QDOT_MIN) == (qdot_rational_cmp(v, b) < 0) && !qdot_rational_equal(v, b))
            best = args[i];
    }
    if (k == 1 || n == 1)
        return best;
    for (uint32_t i = 0; i < n && n <= 16; i++) {
        bool needed = true;

        for (uint32_t j = 0; j < n && needed && NUMBER(pool, args[i]) != NULL; j++)
            needed = !makes_number_redundant(pool, id, args[i], args[j]);
        if (needed)
            few[k++] = args[i];
    }
    if (k == 0 || k == n)
        return make_function_node(pool, id, n, args);
    return k == 1 ? few[0] : make_function_node(pool, id, k, few);
}

static qdot_expr
simplify_floor(qdot_pool *pool, qdot_expr x)
{
    const fmpq *v = NUMBER(pool, x);
    fmpz_t whole;
    fmpq_t q;
    qdot_expr e;

    if (v == NULL)
        return make_function_node(pool, QDOT_FLOOR, 1, &x);
    fmpz_init(whole);
    fmpq_init(q);
    fmpz_fdiv_q(whole, fmpq_numref(v), fmpq_denref(v));
    fmpq_set_fmpz(q, whole);
    e = qdot_expr_fmpq(pool, q);
    fmpz_clear(whole);
    fmpq_clear(q);
    return e;
}

static qdot_expr
simplify_mod(qdot_pool *pool, const qdot_expr *args)
{
    if (args[1] == QDOT_ZERO)
        return qdot_pool_refuse(pool, QDOT_EDOMAIN, "mod by zero");
    if (args[0] == QDOT_ZERO && (NODE(pool, args[1])->sign & QDOT_NE0))
        return QDOT_ZERO;
    if (NUMBER(pool, args[0]) == NULL ||
        NUMBER(pool, args[1]) == NULL)
        return make_function_node(pool, QDOT_MOD, 2, args);
    return qdot_sub(
        pool, args[0],
        qdot_mul(pool, args[1], simplify_floor(pool, qdot_div(pool, args[0], args[1]))));
}

static qdot_expr
simplify_atan2(qdot_pool *pool, const qdot_expr *args)
{
    qdot_expr y = args[0], x = args[1];

    if (y == QDOT_ZERO && x == QDOT_ZERO)
        return qdot_pool_refuse(pool, QDOT_EDOMAIN, "atan2(0, 0) is undefined");
    if ((NODE(pool, x)->sign & QDOT_POS) == QDOT_POS)
        return qdot_fun1(pool, QDOT_ATAN, qdot_div(pool, y, x));
    if (NUMBER(pool, x) != NULL && NUMBER(pool, y) != NULL) {
        qdot_expr half = qdot_mul(pool, QDOT_HALF, QDOT_PI);
        bool up = qdot_rational_sgn(NUMBER(pool, y)) >= 0;

        if (x == QDOT_ZERO)
            return up ? half : qdot_neg(pool, half);
        return qdot_add(pool, qdot_fun1(pool, QDOT_ATAN, qdot_div(pool, y, x)),
                        up ? QDOT_PI : qdot_neg(pool, QDOT_PI));
    }
    return make_function_node(pool, QDOT_ATAN2, 2, args);
}

static qdot_expr
simplify_if(qdot_pool *pool, const qdot_expr *args)
{
    qdot_kind kind = NODE(pool, args[0])->kind;

    if (args[0] == QDOT_TRUE || args[0] == QDOT_FALSE)
        return args[args[0] == QDOT_TRUE ? 1 : 2];
    if (kind == QDOT_REL && NODE(pool, args[0])->op == QDOT_EQ) {
        const fmpq *l = NUMBER(pool, first_argument(pool, args[0]));
        const fmpq *r = NUMBER(pool, ARGS(pool, args[0])[1]);

        if (first_argument(pool, args[0]) == ARGS(pool, args[0])[1])
            return args[1];
        if (l != NULL && r != NULL)
            return args[2];
    }
    if (kind != QDOT_REL && kind != QDOT_LOGIC)
        return qdot_pool_refuse(pool, QDOT_ETYPE,
                                "the condition of if must be a comparison such as x > 0");
    if (!qdot_pool_is_scalar(pool, args[1]) || !qdot_pool_is_scalar(pool, args[2]))
        return qdot_pool_refuse(pool, QDOT_ETYPE, "if chooses between numbers");
    if (args[1] == args[2])
        return args[1];
    pool->choices = true;
    return make_function_node(pool, QDOT_IF, 3, args);
}

qdot_expr
qdot_hold(qdot_pool *pool, qdot_expr e)
{
    if (FAILED(pool) || e == QDOT_NIL)
        return QDOT_NIL;
    if (!qdot_pool_is_scalar(pool, e))
        return qdot_pool_refuse(pool, QDOT_ETYPE, "hold takes numbers");
    if (NODE(pool, e)->kind != QDOT_SUM && NODE(pool, e)->kind != QDOT_PROD &&
        !qdot_expr_is_function(pool, e, QDOT_LOG))
        return e;
    if (NODE(pool, e)->kind == QDOT_PROD &&
        qdot_rational_sgn(NUMBER(pool, first_argument(pool, e))) < 0)
        return qdot_neg(pool, qdot_hold(pool, qdot_neg(pool, e)));
    return make_function_node(pool, QDOT_HOLD, 1, &e);
}

qdot_expr
qdot_fun(qdot_pool *pool, qdot_fun_id id, uint32_t n, const qdot_expr *args)
{
    qdot_expr e;

    if (FAILED(pool))
        return QDOT_NIL;
    if (id == QDOT_HOLD)
        return qdot_hold(pool, args[0]);
    if ((int)n < qdot_fun_facts_of(id)->least || (qdot_fun_facts_of(id)->most >= 0 && (int)n > qdot_fun_facts_of(id)->most))
        return qdot_pool_refuse(pool, QDOT_ETYPE, "%s takes %d argument%s, not %u",
                                qdot_fun_facts_of(id)->name, qdot_fun_facts_of(id)->least,
                                qdot_fun_facts_of(id)->least == 1 ? "" : "s", n);
    for (uint32_t i = 0; i < n; i++) {
        if (args[i] == QDOT_NIL)
            return QDOT_NIL;
        if (id != QDOT_IF && !qdot_pool_is_scalar(pool, args[i]))
            return qdot_pool_refuse(pool, QDOT_ETYPE, "%s takes numbers", qdot_fun_facts_of(id)->name);
        if ((NODE(pool, args[i])->holds & QDOT_HAS_INFINITY) != 0 && qdot_infinity_refuse(pool, args[i]) != QDOT_OK)
            return qdot_pool_fail(pool);
    }
    switch (id) {
    case QDOT_SIN:
    case QDOT_COS:
    case QDOT_TAN:
    case QDOT_SEC:
    case QDOT_CSC:
    case QDOT_COT: return simplify_circular(pool, id, args[0]);
    case QDOT_ASIN:
    case QDOT_ACOS:
    case QDOT_ATAN: return simplify_inverse_circular(pool, id, args[0]);
    case QDOT_ATAN2: return simplify_atan2(pool, args);
    case QDOT_SINH:
    case QDOT_COSH:
    case QDOT_TANH:
    case QDOT_ASINH:
    case QDOT_ACOSH:
    case QDOT_ATANH: return simplify_hyperbolic(pool, id, args[0]);
    case QDOT_EXP: return simplify_exp(pool, args[0]);
    case QDOT_LOG: return simplify_logarithm(pool, args[0]);
    case QDOT_ERF:
    case QDOT_ERFC: return simplify_error_function(pool, id, args[0]);
    case QDOT_ELLIPTIC_K:
    case QDOT_ELLIPTIC_E:
    case QDOT_ELLIPTIC_F:
    case QDOT_ELLIPTIC_PI:
        e = qdot_elliptic_simplify(pool, id, n, args);
        return e != QDOT_NIL || FAILED(pool) ? e : make_function_node(pool, id, n, args);
    case QDOT_JACOBI_AM:
    case QDOT_JACOBI_SN:
    case QDOT_JACOBI_CN:
    case QDOT_JACOBI_DN:
        e = qdot_jacobi_simplify(pool, id, args);
        return e != QDOT_NIL || FAILED(pool) ? e : make_function_node(pool, id, n, args);
    case QDOT_ABS: return simplify_absolute_value(pool, args[0]);
    case QDOT_SIGN: return simplify_sign(pool, args[0]);
    case QDOT_MIN:
    case QDOT_MAX: return simplify_min_or_max(pool, id, n, args);
    case QDOT_MOD: return simplify_mod(pool, args);
    case QDOT_FLOOR: return simplify_floor(pool, args[0]);
    case QDOT_IF: return simplify_if(pool, args);
    case QDOT_LOOKUP: return make_function_node(pool, id, n, args);
    default: return qdot_pool_refuse(pool, QDOT_EINVAL, "no such function");
    }
}

qdot_expr
qdot_fun1(qdot_pool *pool, qdot_fun_id id, qdot_expr x)
{
    return qdot_fun(pool, id, 1, &x);
}

/* --- derivatives of elementary functions -------------------------------------------------------- */

static qdot_expr
one_plus_scaled_square(qdot_pool *pool, int64_t c, qdot_expr x) /* 1 + c x^2 */
{
    return qdot_add(pool, QDOT_ONE,
                    qdot_mul(pool, qdot_expr_int(pool, c), qdot_pow_int(pool, x, 2)));
}

static qdot_expr
scaled_gaussian(qdot_pool *pool, int64_t c, qdot_expr x) /* c e^(-x^2)/sqrt(pi) */
{
    return qdot_mul(
        pool,
        qdot_mul(pool, qdot_expr_int(pool, c),
                 qdot_pow(pool, QDOT_PI, qdot_expr_ratio(pool, -1, 2))),
        qdot_fun1(pool, QDOT_EXP, qdot_neg(pool, qdot_pow_int(pool, x, 2))));
}

static qdot_expr
reciprocal_square_root(qdot_pool *pool, qdot_expr x)
{
    return qdot_pow(pool, x, qdot_expr_ratio(pool, -1, 2));
}

qdot_expr
qdot_fun_derivative(qdot_pool *pool, qdot_fun_id id, uint32_t n, const qdot_expr *args,
                    uint32_t i)
{
    qdot_expr a[3] = {args[0], n > 1 ? args[1] : QDOT_NIL, n > 2 ? args[2] : QDOT_NIL};
    qdot_expr x = a[0], r;

    switch (id) {
    case QDOT_SIN: return qdot_fun1(pool, QDOT_COS, x);
    case QDOT_COS: return qdot_neg(pool, qdot_fun1(pool, QDOT_SIN, x));
    case QDOT_TAN: return one_plus_scaled_square(pool, 1, qdot_fun1(pool, QDOT_TAN, x));
    case QDOT_SEC:
        return qdot_mul(pool, qdot_fun1(pool, QDOT_SEC, x), qdot_fun1(pool, QDOT_TAN, x));
    case QDOT_CSC:
        return qdot_neg(pool, qdot_mul(pool, qdot_fun1(pool, QDOT_CSC, x),
                                       qdot_fun1(pool, QDOT_COT, x)));
    case QDOT_COT: return qdot_neg(pool, one_plus_scaled_square(pool, 1, qdot_fun1(pool, QDOT_COT, x)));
    case QDOT_ASIN: return reciprocal_square_root(pool, one_plus_scaled_square(pool, -1, x));
    case QDOT_ACOS: return qdot_neg(pool, reciprocal_square_root(pool, one_plus_scaled_square(pool, -1, x)));
    case QDOT_ATAN: return qdot_div(pool, QDOT_ONE, one_plus_scaled_square(pool, 1, x));
    case QDOT_ATAN2:
        r = qdot_add(pool, qdot_pow_int(pool, a[0], 2), qdot_pow_int(pool, a[1], 2));
        return i == 0 ? qdot_div(pool, a[1], r) : qdot_neg(pool, qdot_div(pool, a[0], r));
    case QDOT_SINH: return qdot_fun1(pool, QDOT_COSH, x);
    case QDOT_COSH: return qdot_fun1(pool, QDOT_SINH, x);
    case QDOT_TANH: return one_plus_scaled_square(pool, -1, qdot_fun1(pool, QDOT_TANH, x));
    case QDOT_ASINH: return reciprocal_square_root(pool, one_plus_scaled_square(pool, 1, x));
    case QDOT_ACOSH:
        return reciprocal_square_root(pool, qdot_sub(pool, qdot_pow_int(pool, x, 2), QDOT_ONE));
    case QDOT_ATANH: return qdot_div(pool, QDOT_ONE, one_plus_scaled_square(pool, -1, x));
    case QDOT_EXP: return qdot_fun1(pool, QDOT_EXP, x);
    case QDOT_LOG: return qdot_div(pool, QDOT_ONE, x);
    case QDOT_ERF: return scaled_gaussian(pool, 2, x);
    case QDOT_ERFC: return scaled_gaussian(pool, -2, x);
    case QDOT_ELLIPTIC_K:
    case QDOT_ELLIPTIC_E:
    case QDOT_ELLIPTIC_F:
    case QDOT_ELLIPTIC_PI: return qdot_elliptic_derivative(pool, id, n, args, i);
    case QDOT_JACOBI_AM:
    case QDOT_JACOBI_DN: return qdot_jacobi_derivative(pool, id, args, i);
    case QDOT_ABS: return qdot_fun1(pool, QDOT_SIGN, x);
    case QDOT_SIGN:
    case QDOT_LOOKUP:
    case QDOT_FLOOR: return QDOT_ZERO;
    case QDOT_HOLD: return QDOT_ONE;
    case QDOT_MOD:
        return i == 0 ? QDOT_ONE
                      : qdot_neg(pool,
                                 qdot_fun1(pool, QDOT_FLOOR, qdot_div(pool, a[0], a[1])));
    case QDOT_IF:
        if (i == 0)
            return QDOT_ZERO;
        a[1] = i == 1 ? QDOT_ONE : QDOT_ZERO;
        a[2] = i == 2 ? QDOT_ONE : QDOT_ZERO;
        return qdot_fun(pool, id, 3, a);
    default: return qdot_pool_refuse(pool, QDOT_EINVAL, "no derivative of this function");
    }
}
