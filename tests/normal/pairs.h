/* pairs.h -- random pairs of expressions: equal by construction, or changed a little.
 *
 * Both sides of a pair grow together: what is put above a pair (u, u') is a theorem, its left
 * side over u, its right side over u'. `pairs_near` changes one node of one side.
 *
 * Names: x, y, z, u coordinates; r > 0, 0 < theta < pi; x' a velocity; a, b > 0, -1 < w < 1, v > 1
 * and c, k parameters; t; f(s) an undefined function.
 */
#ifndef QDOT_TESTS_NORMAL_PAIRS_H
#define QDOT_TESTS_NORMAL_PAIRS_H

#include <stdint.h>

#include "expr/calculus.h"
#include "expr/expr.h"
#include "expr/walk.h"

typedef struct {
    qdot_pool *pool;
    uint64_t seed;
    uint32_t f;
    qdot_expr positive[4], any[8], within, beyond;
    bool inside; /* nothing outside the class that is decided has been used */
} pairs;

typedef struct {
    qdot_expr l, r;
} pair;

static unsigned
pairs_random(pairs *g, unsigned n)
{
    g->seed ^= g->seed << 13;
    g->seed ^= g->seed >> 7;
    g->seed ^= g->seed << 17;
    return (unsigned)((g->seed >> 33) % n);
}

static bool
pairs_begin(pairs *g, uint64_t seed)
{
    static const char *const positive[] = {"a", "b"}, *const any[] = {"x", "y", "z", "u"};
    qdot_expr s;

    *g = (pairs){.pool = qdot_pool_new(), .seed = seed * 0x9E3779B97F4A7C15u + 1};
    if (g->pool == NULL)
        return false;
    for (int i = 0; i < 8; i++)
        pairs_random(g, 2);
    s = qdot_symbol_get(g->pool, QDOT_FORMAL, "s");
    if (qdot_ufun_declare(g->pool, "f", 1, &s, &g->f) != QDOT_OK)
        return false;
    for (int i = 0; i < 2; i++)
        g->positive[i] = qdot_symbol_get(g->pool, QDOT_PARAM, positive[i]);
    g->positive[2] = qdot_symbol_get(g->pool, QDOT_COORD, "r");
    for (int i = 0; i < 3; i++)
        qdot_symbol_domain(g->pool, g->positive[i], QDOT_ZERO, true, QDOT_NIL, false);
    g->positive[3] = qdot_symbol_get(g->pool, QDOT_COORD, "theta");
    qdot_symbol_domain(g->pool, g->positive[3], QDOT_ZERO, true, QDOT_PI, true);
    g->within = qdot_symbol_get(g->pool, QDOT_PARAM, "w");
    qdot_symbol_domain(g->pool, g->within, QDOT_MINUS_ONE, true, QDOT_ONE, true);
    g->beyond = qdot_symbol_get(g->pool, QDOT_PARAM, "v");
    qdot_symbol_domain(g->pool, g->beyond, QDOT_ONE, true, QDOT_NIL, false);
    for (int i = 0; i < 4; i++)
        g->any[i] = qdot_symbol_get(g->pool, QDOT_COORD, any[i]);
    g->any[4] = qdot_symbol_get(g->pool, QDOT_PARAM, "c");
    g->any[5] = qdot_symbol_get(g->pool, QDOT_PARAM, "k");
    g->any[6] = qdot_symbol_jet(g->pool, g->any[0], 1);
    g->any[7] = QDOT_T;
    return true;
}

/* --- short names for what is built ------------------------------------------------------ */

static qdot_expr
num(pairs *g, int64_t n, int64_t d)
{
    return qdot_expr_ratio(g->pool, n, d);
}

static qdot_expr
add(pairs *g, qdot_expr a, qdot_expr b)
{
    return qdot_add(g->pool, a, b);
}

static qdot_expr
sub(pairs *g, qdot_expr a, qdot_expr b)
{
    return qdot_sub(g->pool, a, b);
}

static qdot_expr
mul(pairs *g, qdot_expr a, qdot_expr b)
{
    return qdot_mul(g->pool, a, b);
}

static qdot_expr
quo(pairs *g, qdot_expr a, qdot_expr b)
{
    return qdot_div(g->pool, a, b);
}

static qdot_expr
power(pairs *g, qdot_expr a, int64_t n)
{
    return qdot_pow_int(g->pool, a, n);
}

static qdot_expr
fun(pairs *g, qdot_fun_id id, qdot_expr a)
{
    return qdot_fun1(g->pool, id, a);
}

static qdot_expr
half(pairs *g, qdot_expr a)
{
    return quo(g, a, num(g, 2, 1));
}

/* --- theorems ------------------------------------------------------------------------- */

static pair pairs_make(pairs *g, int depth);

/* Positive wherever it is defined. */
static pair
pairs_positive(pairs *g, int depth)
{
    pair u, v;
    qdot_expr e;

    if (depth <= 0) {
        e = g->positive[pairs_random(g, 4)];
        return (pair){e, e};
    }
    switch (pairs_random(g, 6)) {
    case 0:
        u = pairs_make(g, depth - 1);
        return (pair){add(g, power(g, u.l, 2), QDOT_ONE),
                      add(g, QDOT_ONE, power(g, u.r, 2))};
    case 1:
        u = pairs_positive(g, depth - 1), v = pairs_positive(g, depth - 1);
        return (pair){add(g, u.l, v.l), add(g, v.r, u.r)};
    case 2:
        u = pairs_positive(g, depth - 1), v = pairs_positive(g, depth - 1);
        return (pair){mul(g, u.l, v.l), mul(g, v.r, u.r)};
    case 3:
        u = pairs_make(g, 0);
        return (pair){fun(g, QDOT_COSH, u.l),
                      half(g, add(g, fun(g, QDOT_EXP, u.r),
                                  fun(g, QDOT_EXP, qdot_neg(g->pool, u.r))))};
    case 4:
        u = pairs_make(g, 0);
        return (pair){fun(g, QDOT_EXP, u.l), power(g, fun(g, QDOT_EXP, half(g, u.r)), 2)};
    default: e = g->positive[pairs_random(g, 4)]; return (pair){e, e};
    }
}

/* An argument of a transcendental function: small. */
static pair
pairs_angle(pairs *g)
{
    qdot_expr a = g->any[pairs_random(g, 8)], b = g->any[pairs_random(g, 8)];
    qdot_expr e;

    switch (pairs_random(g, 6)) {
    case 0: e = add(g, a, b); break;
    case 1: e = sub(g, a, g->positive[3]); break;
    case 2: e = mul(g, num(g, 1 + pairs_random(g, 5), 1 + pairs_random(g, 3)), a); break;
    case 3: e = mul(g, a, b); return (pair){e, e};
    case 4: e = g->positive[3]; break;
    default: e = a;
    }
    return (pair){e, e};
}

/* Sums of angles that functions give. */
static pair
pairs_inverse(pairs *g)
{
    qdot_pool *p = g->pool;
    pair u = pairs_angle(g), s = pairs_positive(g, 1), q = pairs_positive(g, 0);
    qdot_expr two = num(g, 2, 1), quarter = half(g, QDOT_PI), w;

    g->inside = false;
    switch (pairs_random(g, 6)) {
    case 0:
        return (pair){fun(g, QDOT_ATAN, s.l),
                      sub(g, quarter, fun(g, QDOT_ATAN, quo(g, QDOT_ONE, s.r)))};
    case 1:
        w = quo(g, sub(g, s.r, q.r), add(g, QDOT_ONE, mul(g, s.r, q.r)));
        return (pair){sub(g, fun(g, QDOT_ATAN, s.l), fun(g, QDOT_ATAN, q.l)),
                      fun(g, QDOT_ATAN, w)};
    case 2:
        w = qdot_sqrt(p, add(g, QDOT_ONE, power(g, u.r, 2)));
        return (pair){fun(g, QDOT_ATAN, u.l), fun(g, QDOT_ASIN, quo(g, u.r, w))};
    case 3:
        w = qdot_sqrt(p, add(g, QDOT_ONE, power(g, u.r, 2)));
        w = quo(g, u.r, add(g, QDOT_ONE, w));
        return (pair){fun(g, QDOT_ATAN, u.l), mul(g, two, fun(g, QDOT_ATAN, w))};
    case 4:
        return (pair){
            sub(g, mul(g, two, fun(g, QDOT_ATAN, fun(g, QDOT_EXP, u.l))), quarter),
            fun(g, QDOT_ATAN, fun(g, QDOT_SINH, u.r))};
    default:
        w = num(g, 1 + pairs_random(g, 9), 10 + pairs_random(g, 9));
        return (pair){
            mul(g, two, fun(g, QDOT_ATAN, w)),
            fun(g, QDOT_ATAN, quo(g, mul(g, two, w), sub(g, QDOT_ONE, mul(g, w, w))))};
    }
}

/* sin, cos, tan and their relatives. */
static pair
pairs_circular(pairs *g)
{
    qdot_pool *p = g->pool;
    pair u = pairs_angle(g), v = pairs_angle(g);
    qdot_expr su = fun(g, QDOT_SIN, u.r), cu = fun(g, QDOT_COS, u.r);
    qdot_expr sv = fun(g, QDOT_SIN, v.r), cv = fun(g, QDOT_COS, v.r);
    qdot_expr two = num(g, 2, 1), q;

    switch (pairs_random(g, 16)) {
    case 0:
        return (pair){fun(g, QDOT_SIN, add(g, u.l, v.l)),
                      add(g, mul(g, su, cv), mul(g, cu, sv))};
    case 1:
        return (pair){fun(g, QDOT_COS, sub(g, u.l, v.l)),
                      add(g, mul(g, cu, cv), mul(g, su, sv))};
    case 2:
        return (pair){fun(g, QDOT_SIN, mul(g, two, u.l)), mul(g, two, mul(g, su, cu))};
    case 3:
        return (pair){fun(g, QDOT_COS, mul(g, two, u.l)),
                      sub(g, QDOT_ONE, mul(g, two, power(g, su, 2)))};
    case 4:
        return (pair){power(g, fun(g, QDOT_SIN, half(g, u.l)), 2),
                      half(g, sub(g, QDOT_ONE, cu))};
    case 5:
        return (pair){fun(g, QDOT_TAN, half(g, u.l)), quo(g, su, add(g, QDOT_ONE, cu))};
    case 6: return (pair){fun(g, QDOT_TAN, u.l), quo(g, su, cu)};
    case 7:
        return (pair){power(g, fun(g, QDOT_SEC, u.l), 2),
                      add(g, QDOT_ONE, power(g, fun(g, QDOT_TAN, u.r), 2))};
    case 8:
        return (pair){mul(g, fun(g, QDOT_CSC, u.l), fun(g, QDOT_COT, u.l)),
                      quo(g, cu, power(g, su, 2))};
    case 9: return (pair){add(g, power(g, su, 2), mul(g, cu, cu)), QDOT_ONE};
    case 10:
        return (pair){power(g, fun(g, QDOT_COS, u.l), 3),
                      quo(g,
                          add(g, mul(g, num(g, 3, 1), cu),
                              fun(g, QDOT_COS, mul(g, num(g, 3, 1), u.r))),
                          num(g, 4, 1))};
    case 11:
        q = mul(g, num(g, 1 + pairs_random(g, 11), 6), QDOT_PI);
        return (pair){
            fun(g, QDOT_COS, add(g, u.l, q)),
            sub(g, mul(g, cu, fun(g, QDOT_COS, q)), mul(g, su, fun(g, QDOT_SIN, q)))};
    case 12:
        return (pair){add(g, fun(g, QDOT_SIN, u.l), fun(g, QDOT_SIN, v.l)),
                      mul(g, two,
                          mul(g, fun(g, QDOT_SIN, half(g, add(g, u.r, v.r))),
                              fun(g, QDOT_COS, half(g, sub(g, u.r, v.r)))))};
    case 13:
        q = fun(g, QDOT_ATAN, u.l);
        return (pair){fun(g, QDOT_COS, mul(g, two, q)),
                      quo(g, sub(g, QDOT_ONE, power(g, u.r, 2)),
                          add(g, QDOT_ONE, power(g, u.r, 2)))};
    case 14:
        q = fun(g, QDOT_ASIN, u.l);
        return (pair){
            fun(g, QDOT_SIN, mul(g, two, q)),
            mul(g, two, mul(g, u.r, qdot_sqrt(p, sub(g, QDOT_ONE, power(g, u.r, 2)))))};
    default: return (pair){su, qdot_neg(p, fun(g, QDOT_SIN, qdot_neg(p, u.r)))};
    }
}

/* sinh, cosh, exp, log. */
static pair
pairs_growing(pairs *g)
{
    qdot_pool *p = g->pool;
    pair u = pairs_angle(g), v = pairs_angle(g), s = pairs_positive(g, 1);
    qdot_expr eu = fun(g, QDOT_EXP, u.r), ev = fun(g, QDOT_EXP, v.r);
    qdot_expr back = fun(g, QDOT_EXP, qdot_neg(p, u.r));
    qdot_expr su = fun(g, QDOT_SINH, u.r), cu = fun(g, QDOT_COSH, u.r),
              two = num(g, 2, 1);

    switch (pairs_random(g, 10)) {
    case 0: return (pair){fun(g, QDOT_SINH, u.l), half(g, sub(g, eu, back))};
    case 1: return (pair){fun(g, QDOT_COSH, u.l), half(g, add(g, eu, back))};
    case 2: return (pair){fun(g, QDOT_EXP, add(g, u.l, v.l)), mul(g, eu, ev)};
    case 3:
        return (pair){fun(g, QDOT_COSH, add(g, u.l, v.l)),
                      add(g, mul(g, cu, fun(g, QDOT_COSH, v.r)),
                          mul(g, su, fun(g, QDOT_SINH, v.r)))};
    case 4:
        return (pair){fun(g, QDOT_SINH, mul(g, two, u.l)), mul(g, two, mul(g, su, cu))};
    case 5: return (pair){QDOT_ONE, sub(g, power(g, cu, 2), power(g, su, 2))};
    case 6:
        return (pair){fun(g, QDOT_TANH, half(g, u.l)), quo(g, su, add(g, QDOT_ONE, cu))};
    case 7: return (pair){fun(g, QDOT_EXP, fun(g, QDOT_LOG, s.l)), s.r};
    case 8:
        g->inside = false;
        return (pair){fun(g, QDOT_LOG, mul(g, s.l, eu)),
                      add(g, fun(g, QDOT_LOG, s.r), u.r)};
    default:
        return (pair){fun(g, QDOT_TANH, u.l), quo(g, sub(g, power(g, eu, 2), QDOT_ONE),
                                                  add(g, power(g, eu, 2), QDOT_ONE))};
    }
}

/* Roots and absolute values. */
static pair
pairs_root(pairs *g, int depth)
{
    qdot_pool *p = g->pool;
    pair u = pairs_make(g, depth), v = pairs_make(g, 0);
    pair s = pairs_positive(g, depth), q = pairs_positive(g, 0);
    qdot_expr two = num(g, 2, 1);

    switch (pairs_random(g, 11)) {
    case 8: /* the sign of a difference is not known */
        g->inside = false;
        return (pair){qdot_sqrt(p, sub(g, add(g, s.l, q.l),
                                       mul(g, two, qdot_sqrt(p, mul(g, s.l, q.l))))),
                      fun(g, QDOT_ABS, sub(g, qdot_sqrt(p, q.r), qdot_sqrt(p, s.r)))};
    case 9:
        u = pairs_angle(g);
        return (pair){qdot_sqrt(p, half(g, sub(g, QDOT_ONE, fun(g, QDOT_COS, u.l)))),
                      fun(g, QDOT_ABS, fun(g, QDOT_SIN, half(g, u.r)))};
    case 10:
        return (pair){
            qdot_sqrt(p, sub(g, QDOT_ONE, power(g, fun(g, QDOT_COS, g->positive[3]), 2))),
            fun(g, QDOT_SIN, g->positive[3])};
    case 0: return (pair){qdot_sqrt(p, power(g, u.l, 2)), fun(g, QDOT_ABS, u.r)};
    case 1: return (pair){power(g, qdot_sqrt(p, s.l), 2), s.r};
    case 2: return (pair){qdot_sqrt(p, power(g, s.l, 2)), s.r};
    case 3:
        return (pair){qdot_sqrt(p, mul(g, s.l, q.l)),
                      mul(g, qdot_sqrt(p, s.r), qdot_sqrt(p, q.r))};
    case 4:
        return (pair){fun(g, QDOT_ABS, mul(g, u.l, v.l)),
                      mul(g, fun(g, QDOT_ABS, u.r), fun(g, QDOT_ABS, v.r))};
    case 5:
        return (pair){
            quo(g, sub(g, s.l, q.l), sub(g, qdot_sqrt(p, s.l), qdot_sqrt(p, q.l))),
            add(g, qdot_sqrt(p, s.r), qdot_sqrt(p, q.r))};
    case 6:
        g->inside = false;
        return (pair){qdot_sqrt(p, add(g, add(g, s.l, q.l),
                                       mul(g, two, qdot_sqrt(p, mul(g, s.l, q.l))))),
                      add(g, qdot_sqrt(p, q.r), qdot_sqrt(p, s.r))};
    default: return (pair){power(g, fun(g, QDOT_ABS, u.l), 2), power(g, u.r, 2)};
    }
}

/* Algebraic numbers. */
static pair
pairs_number(pairs *g)
{
    qdot_pool *p = g->pool;
    int64_t m = 2 + pairs_random(g, 20), n = 1 + pairs_random(g, 12),
         k = pairs_random(g, 30);
    qdot_expr rm = qdot_sqrt(p, num(g, m, 1)), rn = qdot_sqrt(p, num(g, n, 3));
    qdot_expr two = num(g, 2, 1), angle = mul(g, num(g, k, n), QDOT_PI);
    qdot_expr cube = add(g, rm, num(g, n, 2));

    g->inside = false;
    switch (pairs_random(g, 6)) {
    case 0:
        return (pair){qdot_sqrt(p, add(g, num(g, 3 * m + n, 3),
                                       mul(g, two, qdot_sqrt(p, num(g, m * n, 3))))),
                      add(g, rm, rn)};
    case 1:
        return (pair){qdot_sqrt(p, sub(g, num(g, 3 * m + n, 3),
                                       mul(g, two, qdot_sqrt(p, num(g, m * n, 3))))),
                      3 * m >= n ? sub(g, rm, rn) : sub(g, rn, rm)};
    case 2:
        return (pair){
            fun(g, QDOT_COS, mul(g, two, angle)),
            sub(g, mul(g, two, power(g, fun(g, QDOT_COS, angle), 2)), QDOT_ONE)};
    case 3:
        return (pair){qdot_pow(p, qdot_expand(p, power(g, cube, 3)), num(g, 1, 3)), cube};
    case 4:
        return (pair){quo(g, QDOT_ONE, add(g, rm, rn)),
                      quo(g, sub(g, rm, rn), num(g, 3 * m - n, 3))};
    default:
        return (pair){fun(g, QDOT_SIN, angle),
                      mul(g, two,
                          mul(g, fun(g, QDOT_SIN, half(g, angle)),
                              fun(g, QDOT_COS, half(g, angle))))};
    }
}

/* Arithmetic. */
static pair
pairs_rational(pairs *g, int depth)
{
    pair u = pairs_make(g, depth - 1), v = pairs_make(g, depth - 1);
    pair w = pairs_make(g, depth - 2), s = pairs_positive(g, depth - 2);
    qdot_expr two = num(g, 2, 1),
              n = num(g, 1 + pairs_random(g, 9), 1 + pairs_random(g, 7));

    switch (pairs_random(g, 9)) {
    case 0: return (pair){add(g, u.l, v.l), add(g, v.r, u.r)};
    case 1: return (pair){mul(g, u.l, v.l), mul(g, v.r, u.r)};
    case 2:
        return (pair){mul(g, add(g, u.l, v.l), w.l),
                      add(g, mul(g, u.r, w.r), mul(g, v.r, w.r))};
    case 3:
        return (pair){power(g, sub(g, u.l, v.l), 2),
                      add(g, power(g, u.r, 2),
                          sub(g, power(g, v.r, 2), mul(g, two, mul(g, u.r, v.r))))};
    case 4:
        return (pair){mul(g, add(g, u.l, v.l), sub(g, u.l, v.l)),
                      sub(g, power(g, u.r, 2), power(g, v.r, 2))};
    case 5:
        return (pair){add(g, quo(g, u.l, s.l), mul(g, v.l, n)),
                      quo(g, add(g, u.r, mul(g, n, mul(g, v.r, s.r))), s.r)};
    case 6: return (pair){sub(g, u.l, mul(g, n, v.l)), sub(g, u.r, mul(g, v.r, n))};
    case 7:
        return (pair){sub(g, add(g, u.l, w.l), v.l),
                      sub(g, sub(g, u.r, v.r), sub(g, QDOT_ZERO, w.r))};
    default:
        return (pair){quo(g, mul(g, u.l, s.l), s.r),
                      quo(g, u.r, n) == QDOT_NIL ? QDOT_NIL : mul(g, quo(g, u.r, n), n)};
    }
}

/* --- cases, steps, bounds, powers, inverse functions --------------------------------------- */

static qdot_expr
fun2(pairs *g, qdot_fun_id id, qdot_expr a, qdot_expr b)
{
    qdot_expr args[2] = {a, b};

    return qdot_fun(g->pool, id, 2, args);
}

static qdot_expr
choice(pairs *g, qdot_rel_op op, qdot_expr l, qdot_expr r, qdot_expr yes, qdot_expr no)
{
    qdot_expr args[3] = {qdot_rel(g->pool, op, l, r), yes, no};

    return qdot_fun(g->pool, QDOT_IF, 3, args);
}

/* Whether a derivative of e is one wherever e has a value. */
static bool
smooth(pairs *g, qdot_expr e)
{
    bool good = true;
    qdot_walk w;

    if (e == QDOT_NIL || qdot_walk_begin(g->pool, e, &w) != QDOT_OK)
        return false;
    for (size_t i = 0; i < w.n; i++)
        if (qdot_expr_kind(g->pool, w.at[i]) == QDOT_FUN)
            switch (qdot_expr_node(g->pool, w.at[i])->op) {
            case QDOT_SIGN:
            case QDOT_MIN:
            case QDOT_MAX:
            case QDOT_MOD:
            case QDOT_FLOOR:
            case QDOT_IF: good = false; break;
            default: break;
            }
    qdot_walk_end(&w);
    return good;
}

/* abs, sign, min, max, if, floor, mod. */
static pair
pairs_cases(pairs *g, int depth)
{
    pair u = pairs_make(g, depth), v = pairs_make(g, 0);
    qdot_expr n = num(g, 1 + pairs_random(g, 5), 1), two = num(g, 2, 1);
    qdot_expr m = quo(g, n, num(g, 1 + pairs_random(g, 3), 1));
    qdot_expr gap = fun(g, QDOT_ABS, sub(g, u.r, v.r));

    g->inside = false;
    switch (pairs_random(g, 16)) {
    case 0:
        return (pair){choice(g, QDOT_LT, QDOT_ZERO, u.l, u.l, qdot_neg(g->pool, u.l)),
                      fun(g, QDOT_ABS, u.r)};
    case 1: return (pair){choice(g, QDOT_LE, u.l, v.l, u.l, v.l), fun2(g, QDOT_MIN, u.r, v.r)};
    case 2:
        return (pair){fun2(g, QDOT_MAX, u.l, v.l), half(g, add(g, add(g, u.r, v.r), gap))};
    case 3:
        return (pair){fun2(g, QDOT_MIN, u.l, v.l),
                      sub(g, add(g, u.r, v.r), fun2(g, QDOT_MAX, u.r, v.r))};
    case 4:
        return (pair){mul(g, fun2(g, QDOT_MIN, u.l, v.l), fun2(g, QDOT_MAX, u.l, v.l)),
                      mul(g, u.r, v.r)};
    case 5:
        return (pair){sub(g, fun2(g, QDOT_MAX, u.l, v.l), fun2(g, QDOT_MIN, u.l, v.l)), gap};
    case 6: return (pair){mul(g, fun(g, QDOT_SIGN, u.l), fun(g, QDOT_ABS, u.l)), u.r};
    case 7:
        return (pair){fun(g, QDOT_SIGN, mul(g, u.l, v.l)),
                      mul(g, fun(g, QDOT_SIGN, u.r), fun(g, QDOT_SIGN, v.r))};
    case 8: return (pair){fun(g, QDOT_ABS, u.l), fun2(g, QDOT_MAX, u.r, qdot_neg(g->pool, u.r))};
    case 9: return (pair){fun(g, QDOT_FLOOR, add(g, u.l, n)), add(g, fun(g, QDOT_FLOOR, u.r), n)};
    case 10:
        return (pair){fun2(g, QDOT_MOD, u.l, m),
                      sub(g, u.r, mul(g, m, fun(g, QDOT_FLOOR, quo(g, u.r, m))))};
    case 11:
        return (pair){fun2(g, QDOT_MOD, add(g, u.l, mul(g, two, m)), m),
                      fun2(g, QDOT_MOD, u.r, m)};
    case 12: return (pair){power(g, fun(g, QDOT_SIGN, u.l), 3), fun(g, QDOT_SIGN, u.r)};
    case 13:
        return (pair){fun2(g, QDOT_MAX, u.l, fun2(g, QDOT_MIN, u.l, v.l)), u.r};
    case 14:
        return (pair){choice(g, QDOT_LT, u.l, v.l, power(g, u.l, 2), mul(g, u.l, u.l)),
                      power(g, u.r, 2)};
    default:
        return (pair){choice(g, QDOT_LT, u.l, n, QDOT_ONE, QDOT_MINUS_ONE),
                      qdot_neg(g->pool, choice(g, QDOT_LE, n, u.r, QDOT_ONE, QDOT_MINUS_ONE))};
    }
}

/* What declared bounds say. */
static pair
pairs_bounded(pairs *g)
{
    qdot_pool *p = g->pool;
    qdot_expr w = g->within, v = g->beyond, th = g->positive[3], two = num(g, 2, 1);
    qdot_expr n = num(g, 1 + pairs_random(g, 4), 1), x = pairs_random(g, 2) == 0 ? w : v;

    g->inside = false;
    switch (pairs_random(g, 14)) {
    case 0: return (pair){fun(g, QDOT_ABS, sub(g, w, n)), sub(g, n, w)};
    case 1: return (pair){qdot_sqrt(p, power(g, sub(g, QDOT_ONE, v), 2)), sub(g, v, QDOT_ONE)};
    case 2:
        return (pair){qdot_sqrt(p, sub(g, power(g, v, 2), QDOT_ONE)),
                      mul(g, qdot_sqrt(p, sub(g, v, QDOT_ONE)),
                          qdot_sqrt(p, add(g, v, QDOT_ONE)))};
    case 3:
        return (pair){mul(g, qdot_sqrt(p, add(g, QDOT_ONE, w)), qdot_sqrt(p, sub(g, QDOT_ONE, w))),
                      qdot_sqrt(p, sub(g, QDOT_ONE, power(g, w, 2)))};
    case 4: return (pair){fun2(g, QDOT_MAX, w, v), v};
    case 5: return (pair){fun(g, QDOT_SIGN, sub(g, v, w)), QDOT_ONE};
    case 6: return (pair){fun(g, QDOT_ACOS, fun(g, QDOT_COS, th)), th};
    case 7:
        return (pair){fun2(g, QDOT_ATAN2, mul(g, v, fun(g, QDOT_SIN, th)),
                           mul(g, v, fun(g, QDOT_COS, th))),
                      th};
    case 8:
        return (pair){fun(g, QDOT_ATANH, w),
                      half(g, fun(g, QDOT_LOG, quo(g, add(g, QDOT_ONE, w), sub(g, QDOT_ONE, w))))};
    case 9:
        return (pair){fun(g, QDOT_ACOSH, v),
                      fun(g, QDOT_LOG, add(g, v, qdot_sqrt(p, sub(g, power(g, v, 2), QDOT_ONE))))};
    case 10:
        return (pair){qdot_sqrt(p, sub(g, QDOT_ONE, power(g, fun(g, QDOT_SIN, half(g, th)), 2))),
                      fun(g, QDOT_COS, half(g, th))};
    case 11:
        return (pair){fun(g, QDOT_ABS, fun(g, QDOT_COS, x)),
                      qdot_sqrt(p, half(g, add(g, QDOT_ONE, fun(g, QDOT_COS, mul(g, two, x)))))};
    case 12:
        return (pair){choice(g, QDOT_LT, w, v, w, v), w};
    default:
        return (pair){add(g, fun(g, QDOT_ASIN, w), fun(g, QDOT_ACOS, w)), half(g, QDOT_PI)};
    }
}

/* Rational powers of what is positive. */
static pair
pairs_powers(pairs *g, int depth)
{
    qdot_pool *p = g->pool;
    pair s = pairs_positive(g, depth), q = pairs_positive(g, 0), u = pairs_make(g, 0);
    int64_t d = 2 + (int64_t)pairs_random(g, 4), n = 1 + (int64_t)pairs_random(g, 6);
    qdot_expr x = num(g, n, d), y = num(g, 1 + pairs_random(g, 4), 2 + pairs_random(g, 3));
    qdot_expr root = num(g, 1, d);

    switch (pairs_random(g, 9)) {
    case 0:
        return (pair){mul(g, qdot_pow(p, s.l, x), qdot_pow(p, s.l, y)),
                      qdot_pow(p, s.r, add(g, x, y))};
    case 1:
        return (pair){qdot_pow(p, qdot_pow(p, s.l, x), y), qdot_pow(p, s.r, mul(g, x, y))};
    case 2:
        return (pair){qdot_pow(p, mul(g, s.l, q.l), x),
                      mul(g, qdot_pow(p, s.r, x), qdot_pow(p, q.r, x))};
    case 3: return (pair){power(g, qdot_pow(p, s.l, root), d), s.r};
    case 4:
        return (pair){qdot_pow(p, quo(g, s.l, q.l), root),
                      quo(g, qdot_pow(p, s.r, root), qdot_pow(p, q.r, root))};
    case 5:
        return (pair){qdot_pow(p, power(g, u.l, 2), num(g, 3, 2)),
                      power(g, fun(g, QDOT_ABS, u.r), 3)};
    case 6:
        return (pair){qdot_pow(p, power(g, u.l, 4), num(g, 1, 4)), fun(g, QDOT_ABS, u.r)};
    case 7:
        return (pair){quo(g, sub(g, s.l, q.l), sub(g, qdot_pow(p, s.l, num(g, 1, 3)),
                                                   qdot_pow(p, q.l, num(g, 1, 3)))),
                      add(g, add(g, qdot_pow(p, s.r, num(g, 2, 3)),
                                 qdot_pow(p, mul(g, s.r, q.r), num(g, 1, 3))),
                          qdot_pow(p, q.r, num(g, 2, 3)))};
    default:
        return (pair){qdot_pow(p, s.l, num(g, -n, d)), quo(g, QDOT_ONE, qdot_pow(p, s.r, x))};
    }
}

/* Functions of inverse functions, and these in other words. */
static pair
pairs_under(pairs *g)
{
    qdot_pool *p = g->pool;
    pair u = pairs_make(g, 0), s = pairs_positive(g, 1);
    qdot_expr one = QDOT_ONE, two = num(g, 2, 1), square = power(g, u.r, 2);
    qdot_expr below = qdot_sqrt(p, sub(g, one, square)),
              above = qdot_sqrt(p, add(g, one, square));
    qdot_expr v = g->beyond;

    switch (pairs_random(g, 14)) {
    case 0: return (pair){fun(g, QDOT_TAN, fun(g, QDOT_ACOS, u.l)), quo(g, below, u.r)};
    case 1: return (pair){fun(g, QDOT_COS, fun(g, QDOT_ASIN, u.l)), below};
    case 2: return (pair){fun(g, QDOT_COSH, fun(g, QDOT_ASINH, u.l)), above};
    case 3: return (pair){fun(g, QDOT_TANH, fun(g, QDOT_ASINH, u.l)), quo(g, u.r, above)};
    case 4:
        return (pair){fun(g, QDOT_SINH, fun(g, QDOT_ACOSH, v)),
                      qdot_sqrt(p, sub(g, power(g, v, 2), one))};
    case 5: return (pair){fun(g, QDOT_SINH, fun(g, QDOT_ATANH, u.l)), quo(g, u.r, below)};
    case 6:
        return (pair){fun(g, QDOT_COS, mul(g, two, fun(g, QDOT_ACOS, u.l))),
                      sub(g, mul(g, two, square), one)};
    case 7:
        return (pair){fun(g, QDOT_TAN, half(g, fun(g, QDOT_ASIN, u.l))),
                      quo(g, u.r, add(g, one, below))};
    case 8:
        return (pair){fun(g, QDOT_COS, fun2(g, QDOT_ATAN2, u.l, s.l)),
                      quo(g, s.r, qdot_sqrt(p, add(g, square, power(g, s.r, 2))))};
    case 9:
        g->inside = false;
        return (pair){fun(g, QDOT_ASINH, u.l), fun(g, QDOT_LOG, add(g, u.r, above))};
    case 10:
        g->inside = false;
        return (pair){fun(g, QDOT_LOG, power(g, s.l, 3)),
                      mul(g, num(g, 3, 1), fun(g, QDOT_LOG, s.r))};
    case 11:
        g->inside = false;
        return (pair){fun(g, QDOT_ASIN, fun(g, QDOT_TANH, u.l)),
                      fun(g, QDOT_ATAN, fun(g, QDOT_SINH, u.r))};
    case 12:
        g->inside = false;
        return (pair){fun(g, QDOT_ATAN, u.l), fun2(g, QDOT_ATAN2, u.r, one)};
    default:
        return (pair){fun(g, QDOT_EXP, fun(g, QDOT_ASINH, u.l)), add(g, u.r, above)};
    }
}

/* What is done to both sides alike, or to one of them without a change of its value. */
static pair
pairs_transform(pairs *g, int depth)
{
    pair u = pairs_make(g, depth - 1), v = pairs_make(g, depth - 2);
    qdot_expr x = g->any[pairs_random(g, 6)];

    switch (pairs_random(g, 5)) {
    case 0:
        if (!smooth(g, u.l) || !smooth(g, u.r))
            return u;
        return (pair){qdot_diff(g->pool, u.l, x), qdot_diff(g->pool, u.r, x)};
    case 1:
        return (pair){qdot_subs(g->pool, u.l, 1, &x, &v.l),
                      qdot_subs(g->pool, u.r, 1, &x, &v.r)};
    case 2: return (pair){qdot_expand(g->pool, u.l), u.r};
    case 3:
        return (pair){qdot_ufun_apply(g->pool, g->f, &u.l, NULL),
                      qdot_ufun_apply(g->pool, g->f, &u.r, NULL)};
    default: return (pair){u.r, u.l};
    }
}

static pair
pairs_make(pairs *g, int depth)
{
    qdot_expr e;

    if (depth <= 0) {
        e = pairs_random(g, 5) == 0 ? g->positive[pairs_random(g, 4)]
                                    : g->any[pairs_random(g, 8)];
        return (pair){e, e};
    }
    switch (pairs_random(g, 16)) {
    case 15: return pairs_powers(g, depth - 1);
    case 14: return pairs_under(g);
    case 13: return pairs_bounded(g);
    case 12: return pairs_cases(g, depth - 1);
    case 11: return pairs_inverse(g);
    case 10: return pairs_number(g);
    case 0:
    case 1:
    case 2: return pairs_circular(g);
    case 3: return pairs_growing(g);
    case 4: return pairs_root(g, depth - 1);
    case 5:
    case 6: return pairs_transform(g, depth);
    default: return pairs_rational(g, depth);
    }
}

/* --- a small change --------------------------------------------------------------------- */

static qdot_expr
pairs_other_function(pairs *g, qdot_expr e)
{
    static const qdot_fun_id swap[][2] = {
        {QDOT_SIN, QDOT_COS},   {QDOT_COS, QDOT_SIN},  {QDOT_SINH, QDOT_COSH},
        {QDOT_COSH, QDOT_SINH}, {QDOT_TAN, QDOT_COT},  {QDOT_SEC, QDOT_CSC},
        {QDOT_ASIN, QDOT_ATAN}, {QDOT_EXP, QDOT_COSH}, {QDOT_ATAN, QDOT_ASIN},
        {QDOT_ACOS, QDOT_ASIN}, {QDOT_ASINH, QDOT_ATAN}, {QDOT_SIGN, QDOT_ATAN},
        {QDOT_FLOOR, QDOT_SIN}};
    unsigned op = qdot_expr_node(g->pool, e)->op;

    for (size_t i = 0; i < sizeof swap / sizeof *swap; i++)
        if (op == swap[i][0])
            return fun(g, swap[i][1], qdot_expr_arg(g->pool, e, 0));
    if (op == QDOT_ABS)
        return qdot_expr_arg(g->pool, e, 0);
    return qdot_neg(g->pool, e);
}

/* e with one node changed, everywhere it stands. */
__attribute__((unused)) static qdot_expr
pairs_near(pairs *g, qdot_expr e)
{
    qdot_walk w;
    qdot_expr node, other, small;
    int64_t k = 1 + (int64_t)pairs_random(g, 40);

    if (qdot_walk_begin(g->pool, e, &w) != QDOT_OK)
        return QDOT_NIL;
    node = w.at[pairs_random(g, (unsigned)w.n)];
    if (pairs_random(g, 4) == 0)
        node = e;
    qdot_walk_end(&w);
    small = power(g, num(g, 10, 1), -k);
    switch (pairs_random(g, 4)) {
    case 0: other = mul(g, node, add(g, QDOT_ONE, small)); break;
    case 1: other = add(g, node, small); break;
    case 2: other = qdot_neg(g->pool, node); break;
    default:
        if (qdot_expr_kind(g->pool, node) == QDOT_FUN)
            other = pairs_other_function(g, node);
        else if (qdot_expr_kind(g->pool, node) == QDOT_SYM)
            other = g->any[pairs_random(g, 8)];
        else
            other = mul(g, node, g->positive[pairs_random(g, 4)]);
    }
    return qdot_subs(g->pool, e, 1, &node, &other);
}

#endif
