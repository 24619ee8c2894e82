/* condition-forms.c -- simpler forms of conditions 0 < g and 0 <= g if g contains |v| or square roots. */
#include "normal/solve/condition-forms.h"

#include <math.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/inequality/constant-bounds.h"
#include "normal/inequality/rising.h"
#include "normal/refute/ball.h"

/* MOST_CHOICES: nodes such as |u| that are replaced by their possible values; LARGEST: operations
 * of an examined expression; MOST_ROOT: m of an m-th root. */
enum { MOST_CHOICES = 4, LARGEST = 80, MOST_ROOT = 24 };

/* A node |u|, sign u, max(u, v) or min(u, v) of e, and what its value may be, other [2]: u or -u, 1 or -1, u or v. Nil:
 * there is none. */
static qdot_expr
find_switching_function(qdot_pool *pool, qdot_expr e, qdot_expr *other)
{
    qdot_expr found = QDOT_NIL;
    qdot_walk w;

    if (qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < w.n && found == QDOT_NIL; i++) {
        uint32_t op = qdot_expr_node(pool, w.at[i])->op, n = qdot_expr_count(pool, w.at[i]);
        qdot_expr u;

        if (qdot_expr_kind(pool, w.at[i]) != QDOT_FUN || n == 0)
            continue;
        u = qdot_expr_arg(pool, w.at[i], 0);
        if (op != QDOT_ABS && op != QDOT_SIGN && ((op != QDOT_MAX && op != QDOT_MIN) || n != 2))
            continue;
        found = w.at[i];
        other[0] = op == QDOT_SIGN ? QDOT_ONE : u;
        other[1] = op == QDOT_ABS    ? qdot_neg(pool, u)
                   : op == QDOT_SIGN ? QDOT_MINUS_ONE
                                     : qdot_expr_arg(pool, found, 1);
    }
    qdot_walk_end(&w);
    return found;
}

/* Whether e vanishes identically for some choice of the values of all such nodes; `depth` of them
 * are chosen already. */
static bool
vanishes_for_some_choice(qdot_pool *pool, qdot_expr e, int depth)
{
    qdot_expr other[2], choice = find_switching_function(pool, e, other);

    if (choice == QDOT_NIL)
        return depth > 0 && qdot_expand(pool, e) == QDOT_ZERO;
    for (int k = 0; k < 2 && depth < MOST_CHOICES; k++) {
        qdot_expr there = qdot_subs(pool, e, 1, &choice, &other[k]);

        if (there == QDOT_NIL) {
            qdot_status status = qdot_pool_check(pool);

            if (status != QDOT_OK && status != QDOT_EDOMAIN)
                (void)qdot_pool_fail(pool);
        } else if (vanishes_for_some_choice(pool, there, depth + 1)) {
            return true;
        }
    }
    return false;
}

bool
qdot_holds_root(qdot_pool *pool, qdot_expr e)
{
    bool found = false;
    qdot_walk w;

    if (qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return true;
    for (size_t i = 0; i < w.n && !found; i++)
        for (uint32_t k = 2; qdot_expr_kind(pool, w.at[i]) == QDOT_PROD && k < qdot_expr_count(pool, w.at[i]); k += 2) {
            const fmpq *q = qdot_expr_rational(pool, qdot_expr_arg(pool, w.at[i], k));

            found = found || q == NULL || !fmpz_is_one(fmpq_denref(q));
        }
    qdot_walk_end(&w);
    return found;
}

bool
qdot_vanishes_in_regions(qdot_pool *pool, qdot_expr e)
{
    return e != QDOT_NIL && qdot_expr_size(pool, e) <= LARGEST && vanishes_for_some_choice(pool, e, 0);
}

qdot_expr
qdot_condition_of_logarithms(qdot_pool *pool, qdot_expr gap)
{
    const uint32_t n = gap != QDOT_NIL && qdot_expr_kind(pool, gap) == QDOT_SUM ? qdot_expr_count(pool, gap) : 0;
    qdot_expr above = QDOT_ONE, below = QDOT_ONE, c = QDOT_NIL;
    unsigned open = 0; /* number of arguments not known to be positive */

    if (n < 5)
        return QDOT_NIL;
    for (uint32_t i = 1; i + 1 < n; i += 2) {
        qdot_expr log = qdot_expr_arg(pool, gap, i), k = qdot_expr_arg(pool, gap, i + 1), A,
                  size = qdot_expr_is_negative(pool, k) ? qdot_neg(pool, k) : k;

        if (!qdot_expr_is_function(pool, log, QDOT_LOG) || (c != QDOT_NIL && size != c))
            return QDOT_NIL;
        c = size;
        A = qdot_expr_arg(pool, log, 0);
        if ((qdot_expr_node(pool, A)->sign & QDOT_POS) != QDOT_POS && (size != k || open++ > 0))
            return QDOT_NIL;
        *(size == k ? &above : &below) = qdot_mul(pool, size == k ? above : below, A);
    }
    c = qdot_neg(pool, qdot_div(pool, qdot_expr_arg(pool, gap, 0), c));
    return qdot_sub(pool, above, c == QDOT_ZERO ? below : qdot_mul(pool, below, qdot_fun1(pool, QDOT_EXP, c)));
}

qdot_expr
qdot_condition_without_magnitude(qdot_pool *pool, qdot_expr gap, bool strict)
{
    qdot_expr magnitude, v, rest, slope, zero = QDOT_ZERO, one = QDOT_ONE;
    bool same, opposite;
    const fmpq *k;

    if (gap == QDOT_NIL || qdot_expr_kind(pool, gap) != QDOT_SUM)
        return QDOT_NIL;
    magnitude = qdot_expr_find_function(pool, gap, 1, (qdot_fun_id[]){QDOT_ABS}, QDOT_NIL);
    if (magnitude == QDOT_NIL)
        return QDOT_NIL;
    v = qdot_expr_arg(pool, magnitude, 0);
    rest = qdot_subs(pool, gap, 1, &magnitude, &zero);
    slope = qdot_expand(pool, qdot_sub(pool, qdot_subs(pool, gap, 1, &magnitude, &one), rest));
    if (rest == QDOT_NIL || slope == QDOT_NIL) {
        if (qdot_pool_check(pool) != QDOT_EDOMAIN)
            (void)qdot_pool_fail(pool);
        return QDOT_NIL;
    }
    k = qdot_expr_rational(pool, slope);
    if (k == NULL || qdot_expand(pool, qdot_sub(pool, gap, qdot_add(pool, rest, qdot_mul(pool, slope, magnitude)))) !=
                         QDOT_ZERO)
        return QDOT_NIL;
    same = qdot_expand(pool, qdot_sub(pool, rest, qdot_mul(pool, slope, v))) == QDOT_ZERO;
    opposite = qdot_expand(pool, qdot_add(pool, rest, qdot_mul(pool, slope, v))) == QDOT_ZERO;
    if (!same && !opposite)
        return QDOT_NIL;
    if (fmpq_sgn(k) > 0) /* k |v| + k v and k |v| - k v with k > 0 are never negative */
        return !strict ? QDOT_ONE : same ? v : qdot_neg(pool, v);
    return strict ? QDOT_MINUS_ONE : opposite ? v : qdot_neg(pool, v);
}

static bool
contains_square_root(qdot_pool *pool, qdot_expr e)
{
    bool found = false;
    qdot_walk w;

    if (qdot_walk_begin(pool, e, &w) != QDOT_OK) {
        (void)qdot_pool_fail(pool);
        return false;
    }
    for (size_t i = 0; i < w.n && !found; i++)
        found = qdot_has_square_root(pool, w.at[i]);
    qdot_walk_end(&w);
    return found;
}

/* A product of powers as c B^(g/m), m > 1 the common denominator of their exponents, g the common divisor of numerators.
 * *base: the one base that is not known to be never negative, *odd: it has an odd exponent in B, so that B has its sign.
 * False: it has no such form, or there are two such bases. */
static bool
read_power(qdot_pool *pool, qdot_expr e, qdot_expr *c, qdot_expr *B, qdot_expr *inverse, qdot_expr *base, bool *odd)
{
    const uint32_t n = qdot_expr_kind(pool, e) == QDOT_PROD ? qdot_expr_count(pool, e) : 0;
    unsigned unknown = 0;
    bool good = n > 0;
    fmpz_t m, g;

    fmpz_init_set_si(m, 1);
    fmpz_init(g);
    *base = QDOT_NIL;
    *odd = false;
    for (uint32_t i = 1; i + 1 < n && good; i += 2) {
        const fmpq *k = qdot_expr_rational(pool, qdot_expr_arg(pool, e, i + 1));

        if ((qdot_expr_node(pool, qdot_expr_arg(pool, e, i))->sign & QDOT_GE0) == 0) {
            unknown++;
            *base = qdot_expr_arg(pool, e, i);
        }
        good = k != NULL && unknown <= 1;
        if (good) {
            fmpz_lcm(m, m, fmpq_denref(k));
            fmpz_gcd(g, g, fmpq_numref(k));
        }
    }
    good = good && fmpz_cmp_si(m, 1) > 0 && fmpz_cmp_si(m, MOST_ROOT) <= 0 && fmpz_cmp_si(g, MOST_ROOT) <= 0;
    if (good) {
        *inverse = qdot_expr_ratio(pool, fmpz_get_si(m), fmpz_get_si(g));
        *c = qdot_expr_arg(pool, e, 0);
        *B = QDOT_ONE;
        for (uint32_t i = 1; i + 1 < n; i += 2) {
            const qdot_expr k = qdot_mul(pool, qdot_expr_arg(pool, e, i + 1), *inverse);

            if (qdot_expr_arg(pool, e, i) == *base)
                *odd = k != QDOT_NIL && fmpz_is_odd(fmpq_numref(qdot_expr_rational(pool, k)));
            *B = qdot_mul(pool, *B, qdot_pow(pool, qdot_expr_arg(pool, e, i), k));
        }
    }
    fmpz_clear(g);
    fmpz_clear(m);
    return good && *B != QDOT_NIL;
}

qdot_expr
qdot_condition_of_power(qdot_pool *pool, qdot_expr gap, qdot_expr *base)
{
    qdot_expr constant, c, B, inverse, end;
    bool above, odd;
    double d;

    if (gap == QDOT_NIL)
        return QDOT_NIL;
    constant = qdot_constant_terms(pool, gap);
    if (!read_power(pool, qdot_sub(pool, gap, constant), &c, &B, &inverse, base, &odd) ||
        qdot_constant_double(pool, constant, &d) != QDOT_OK)
        return QDOT_NIL;
    above = !qdot_expr_is_negative(pool, c);
    if (above ? d > 0 : d <= 0)
        return QDOT_NIL;
    if (above && odd)
        *base = QDOT_NIL; /* B is above a number that is not negative */
    end = qdot_pow(pool, qdot_neg(pool, qdot_div(pool, constant, c)), inverse);
    return above ? qdot_sub(pool, B, end) : qdot_sub(pool, end, B);
}

qdot_expr
qdot_condition_beside_root(qdot_pool *pool, qdot_expr gap, bool *above)
{
    const uint32_t n = gap != QDOT_NIL && qdot_expr_kind(pool, gap) == QDOT_SUM ? qdot_expr_count(pool, gap) : 0;
    qdot_expr root = QDOT_NIL, rest = QDOT_ZERO, constant;
    double c;

    if (n == 0 || qdot_expr_size(pool, gap) > LARGEST)
        return QDOT_NIL;
    constant = qdot_constant_terms(pool, gap);
    for (uint32_t i = 1; i + 1 < n; i += 2) {
        qdot_expr t = qdot_expr_arg(pool, gap, i), term = qdot_mul(pool, t, qdot_expr_arg(pool, gap, i + 1));

        if (qdot_expr_is_constant(pool, t))
            continue;
        if (!contains_square_root(pool, t))
            rest = qdot_add(pool, rest, term);
        else if (root != QDOT_NIL || qdot_expr_kind(pool, t) != QDOT_PROD || (qdot_expr_node(pool, t)->sign & QDOT_GE0) == 0)
            return QDOT_NIL;
        else
            root = term;
    }
    if (root == QDOT_NIL || qdot_constant_double(pool, constant, &c) != QDOT_OK || c == 0)
        return QDOT_NIL;
    *above = !qdot_expr_is_negative(pool, root);
    return *above == (c > 0) ? qdot_sub(pool, qdot_pow_int(pool, root, 2), qdot_pow_int(pool, rest, 2)) : QDOT_NIL;
}

qdot_expr
qdot_condition_squared(qdot_pool *pool, qdot_expr gap)
{
    qdot_expr part[2] = {QDOT_ZERO, QDOT_ZERO};
    uint32_t n, terms = 0;

    if (gap == QDOT_NIL || qdot_expr_kind(pool, gap) != QDOT_SUM || qdot_expr_size(pool, gap) > LARGEST ||
        !contains_square_root(pool, gap))
        return QDOT_NIL;
    n = qdot_expr_count(pool, gap);
    for (uint32_t i = 0; i < n; i += i == 0 ? 1 : 2) { /* entries c0, c1, t1, c2, t2, ...: look at coefficients */
        qdot_expr term = qdot_expr_arg(pool, gap, i);
        bool minus;

        if (i > 0)
            term = qdot_mul(pool, term, qdot_expr_arg(pool, gap, i + 1));
        if (term == QDOT_ZERO)
            continue;
        if (term == QDOT_NIL)
            return QDOT_NIL;
        minus = qdot_expr_is_negative(pool, term);
        if (minus)
            term = qdot_neg(pool, term);
        if (term == QDOT_NIL || (qdot_expr_node(pool, term)->sign & QDOT_GE0) == 0 || part[minus] != QDOT_ZERO)
            return QDOT_NIL;
        part[minus] = term;
        terms++;
    }
    return terms == 2 ? qdot_sub(pool, qdot_pow_int(pool, part[0], 2), qdot_pow_int(pool, part[1], 2)) : QDOT_NIL;
}

/* --- functions around the parameter -------------------------------------------------------- */

/* The monotonic function whose inverse is h; QDOT_FUNCTION_KINDS if there is none. */
static qdot_fun_id
inverse_of(qdot_fun_id h)
{
    return qdot_fun_is(h, QDOT_FUN_RISING) || qdot_fun_is(h, QDOT_FUN_FALLING) ? qdot_fun_facts_of(h)->inverse
                                                                                : QDOT_FUNCTION_KINDS;
}

/* Whether h(at) equals the number rather than the value on another branch; compared in doubles. */
static bool
is_value(qdot_pool *pool, qdot_fun_id h, qdot_expr at, qdot_expr number)
{
    double a, b;

    return qdot_ball_double(pool, qdot_fun1(pool, h, at), NULL, NULL, &a) &&
           qdot_ball_double(pool, number, NULL, NULL, &b) &&
           fabs(a - b) <= 1e-9 * fmax(1, fabs(b));
}

qdot_expr
qdot_condition_unfolded(qdot_pool *pool, qdot_expr relation)
{
    for (int i = 0; i < 2 && qdot_expr_kind(pool, relation) == QDOT_REL; i++) {
        qdot_expr side = qdot_expr_arg(pool, relation, (uint32_t)i),
                  number = qdot_expr_arg(pool, relation, (uint32_t)(1 - i)), u, at;
        qdot_rel_op op = qdot_expr_node(pool, relation)->op;
        qdot_fun_id h, inverse;
        bool swap = i == 1;
        const qdot_expr d = qdot_constant_terms(pool, side);

        number = qdot_sub(pool, number, d);
        side = qdot_sub(pool, side, d);
        if (number == QDOT_NIL || side == QDOT_NIL)
            return QDOT_NIL;
        if (qdot_expr_kind(pool, side) == QDOT_PROD && qdot_expr_count(pool, side) == 3 &&
            qdot_expr_arg(pool, side, 2) == QDOT_ONE) {
            qdot_expr c = qdot_expr_arg(pool, side, 0);

            swap ^= qdot_expr_is_negative(pool, c);
            number = qdot_div(pool, number, c);
            side = qdot_expr_arg(pool, side, 1);
        }
        if (qdot_expr_kind(pool, side) != QDOT_FUN || qdot_expr_count(pool, side) != 1 ||
            number == QDOT_NIL || !qdot_expr_is_constant(pool, number) || qdot_expr_is_constant(pool, side))
            continue;
        h = qdot_expr_node(pool, side)->op;
        inverse = inverse_of(h);
        if (inverse == QDOT_FUNCTION_KINDS)
            continue;
        at = qdot_fun1(pool, inverse, number);
        if (at == QDOT_NIL && qdot_pool_check(pool) != QDOT_EDOMAIN)
            return qdot_pool_fail(pool);
        if (at == QDOT_NIL || !is_value(pool, h, at, number))
            continue;
        u = qdot_expr_arg(pool, side, 0);
        swap ^= qdot_fun_is(h, QDOT_FUN_FALLING);
        relation = swap ? qdot_rel(pool, op, at, u) : qdot_rel(pool, op, u, at);
        i = -1; /* start again, because functions may be nested: log(atan(u)) */
    }
    return relation;
}

qdot_expr
qdot_argument_at_zero(qdot_pool *pool, qdot_expr u)
{
    qdot_fun_id inverse = qdot_expr_kind(pool, u) == QDOT_FUN && qdot_expr_count(pool, u) == 1
                              ? inverse_of(qdot_expr_node(pool, u)->op)
                              : QDOT_FUNCTION_KINDS;
    qdot_expr at = inverse == QDOT_FUNCTION_KINDS ? QDOT_NIL : qdot_fun1(pool, inverse, QDOT_ZERO);

    if (at == QDOT_NIL) { /* the inverse has no value: exp is never 0 */
        if (qdot_pool_check(pool) != QDOT_OK && qdot_pool_check(pool) != QDOT_EDOMAIN)
            return qdot_pool_fail(pool);
        return u;
    }
    return is_value(pool, qdot_expr_node(pool, u)->op, at, QDOT_ZERO)
               ? qdot_sub(pool, qdot_expr_arg(pool, u, 0), at)
               : u;
}
