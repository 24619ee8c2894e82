/* series.c -- Taylor series in several symbols, also where a quotient is 0/0 at the point.
 *
 * In x = a + ray u, y = b + ray v ... a series in x, y is one in `ray`, whose coefficients are polynomials
 * in u, v. Where all derivatives exist at ray = 0 they are the coefficients. Where one does not, sums,
 * products, powers and functions are taken apart into Laurent series: sin(x)/x is (x - ...)/x. What then
 * has a negative power or a coefficient that is no polynomial has no Taylor series, nor has
 * what switches at the point: abs(x), floor(x), if(x > 0, ...).
 *
 * Source  powers by Miller's recurrence: Knuth, TAOCP 2, 4.7.
 * Tests   tests/script/solve/series-removable.lag, tests/bad/definitions/series-none.sh
 */
#include "normal/calculus/series.h"

#include "base/interrupt.h"
#include "base/memory.h"
#include "base/text.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elliptic.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/value-kind.h"
#include "expr/walk.h"
#include "normal/calculus/switch.h"
#include "normal/prove/decide.h"
#include "normal/simplify/circle.h"
#include "normal/simplify/simplify.h"

/* MOST_LEADING: orders searched for a leading coefficient. MOST_DEPTH: nesting that is expanded. */
enum { MOST_LEADING = 64, MOST_DEPTH = 100 };

typedef struct {
    qdot_pool *pool;
    qdot_facts facts;
    qdot_expr ray;
    size_t n;                                 /* length of the three lists below */
    const qdot_expr *symbols;                 /* the symbols x in which the series is expanded */
    qdot_vec(qdot_expr) places, steps, moves; /* x on a ray, a + ray u; its direction u; the distance x - a */
    int depth;
} course;

/* A truncated Laurent series: sum c[i] ray^(least + i). */
typedef struct {
    int64_t least;
    qdot_vec(qdot_expr) c;
} laurent;

static qdot_status laurent_series(course *x, qdot_expr e, int64_t most, laurent *s);

/* --- the terms of the answer -------------------------------------------------------- */

/* Whether the term is a product with a sum that contains one of the expansion variables. */
static bool
is_nested(const course *x, qdot_expr term)
{
    for (uint32_t i = 1; qdot_expr_kind(x->pool, term) == QDOT_PROD &&
                         i < qdot_expr_count(x->pool, term);
         i += 2) {
        qdot_expr base = qdot_expr_arg(x->pool, term, i);

        for (size_t k = 0; qdot_expr_kind(x->pool, base) == QDOT_SUM && k < x->steps.n; k++)
            if (qdot_expr_contains(x->pool, base, x->steps.at[k]))
                return true;
    }
    return false;
}

/* The terms of one degree in the ray parameter, with products of sums multiplied out. */
static qdot_expr
expand_products(const course *x, qdot_expr scalar)
{
    bool nested;

    if (scalar == QDOT_NIL)
        return scalar;
    nested = is_nested(x, scalar);
    for (uint32_t i = 1; qdot_expr_kind(x->pool, scalar) == QDOT_SUM && !nested &&
                         i < qdot_expr_count(x->pool, scalar);
         i += 2)
        nested = is_nested(x, qdot_expr_arg(x->pool, scalar, i));
    return nested ? qdot_expand(x->pool, scalar) : scalar;
}

/* The expression e with ray = 1 and the original symbols in place of their distances from the expansion point. */
static qdot_expr
restore_symbols(const course *x, qdot_expr e)
{
    const qdot_expr one = QDOT_ONE;

    e = qdot_subs(x->pool, e, 1, &x->ray, &one);
    return qdot_subs(x->pool, e, x->steps.n, x->steps.at, x->moves.at);
}

static qdot_status
fail_without_series(course *x, qdot_expr e, const char *why)
{
    qdot_text text = {0};
    qdot_expr shown = restore_symbols(x, e);
    qdot_status status = qdot_pool_check(x->pool);

    if (status == QDOT_OK)
        status = qdot_print(x->pool, shown, QDOT_PLAIN, &text);
    if (status == QDOT_OK || status == QDOT_EDOMAIN)
        status = text.n > 0 && text.n < 100
                     ? qdot_fail(QDOT_EDOMAIN, "`%s` has no Taylor series there: %s",
                                 qdot_text_str(&text), why)
                     : qdot_fail(QDOT_EDOMAIN, "there is no Taylor series there: %s", why);
    qdot_text_clear(&text);
    return status;
}

static qdot_status
check_no_switches(course *x, qdot_expr e)
{
    qdot_expr part;

    QDOT_TRY(qdot_switch_find(x->pool, e, x->ray, &x->facts, &part));
    return part == QDOT_NIL ? QDOT_OK
                            : fail_without_series(x, qdot_expr_is_scalar(x->pool, part) ? part : e,
                                                  "it switches at the point");
}

/* --- arithmetic of series ----------------------------------------------------------- */

static qdot_expr
coefficient(const laurent *s, int64_t k)
{
    return k < s->least || k - s->least >= (int64_t)s->c.n ? QDOT_ZERO : s->c.at[k - s->least];
}

static void
laurent_clear(laurent *s)
{
    qdot_free(s->c.at);
    *s = (laurent){0};
}

static qdot_status
shorten_coefficient(course *x, qdot_expr *e)
{
    *e = qdot_simplify(x->pool, *e, &x->facts);
    return qdot_value_kind_check(x->pool, *e);
}

/* Drop leading coefficients of a series that are 0. */
static void
drop_leading_zeros(course *x, laurent *s)
{
    size_t zeros = 0;

    while (zeros < s->c.n && qdot_is_zero(x->pool, s->c.at[zeros], &x->facts))
        zeros++;
    for (size_t i = zeros; i < s->c.n; i++)
        s->c.at[i - zeros] = s->c.at[i];
    s->c.n -= zeros;
    s->least += (int64_t)zeros;
}

/* Multiply the series s by b, truncated after ray^most. */
static qdot_status
multiply_series(course *x, laurent *s, const laurent *b, int64_t most)
{
    laurent made = {.least = s->least + b->least};
    qdot_status status = QDOT_OK;

    for (int64_t k = made.least; k <= most && status == QDOT_OK; k++) {
        qdot_expr sum = QDOT_ZERO;

        for (int64_t i = s->least; i <= k - b->least; i++)
            sum = qdot_add(x->pool, sum,
                           qdot_mul(x->pool, coefficient(s, i), coefficient(b, k - i)));
        status = qdot_value_kind_check(x->pool, sum);
        if (status == QDOT_OK)
            status = shorten_coefficient(x, &sum);
        if (status == QDOT_OK)
            status = qdot_vec_push(&made.c, sum);
    }
    laurent_clear(s);
    *s = made;
    return status;
}

/* Find b^q for a series b with b_0 != 0, by Miller's recurrence: k b_0 a_k = sum_j (q j - k + j)
 * b_j a_{k-j}. */
static qdot_status
laurent_power(course *x, const laurent *b, qdot_expr q, int64_t least, int64_t most, laurent *s)
{
    qdot_pool *pool = x->pool;
    qdot_expr a = qdot_pow(pool, b->c.at[0], q);

    s->least = least;
    for (int64_t k = 0; k <= most - least; k++) {
        if (k > 0) {
            a = QDOT_ZERO;
            for (int64_t j = 1; j <= k; j++) {
                qdot_expr weight = qdot_add(pool, qdot_mul(pool, q, qdot_expr_int(pool, j)),
                                            qdot_expr_int(pool, j - k));

                weight = qdot_mul(pool, weight, coefficient(b, b->least + j));
                a = qdot_add(pool, a, qdot_mul(pool, weight, s->c.at[k - j]));
            }
            a = qdot_div(pool, a, qdot_mul(pool, qdot_expr_int(pool, k), b->c.at[0]));
        }
        QDOT_TRY(qdot_value_kind_check(pool, a));
        QDOT_TRY(shorten_coefficient(x, &a));
        QDOT_TRY(qdot_vec_push(&s->c, a));
        QDOT_TRY(qdot_interrupt_check());
    }
    return QDOT_OK;
}

/* --- series of subexpressions ------------------------------------------------------- */

/* Whether e contains 0^a, whose value depends on a. */
static bool
contains_power_of_zero(const qdot_pool *pool, qdot_expr e)
{
    qdot_walk w;
    bool found = false;

    if (qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return false;
    for (size_t i = 0; i < w.n && !found; i++)
        for (uint32_t k = 1; qdot_expr_kind(pool, w.at[i]) == QDOT_PROD &&
                             k < qdot_expr_count(pool, w.at[i]);
             k += 2)
            found = found || qdot_expr_arg(pool, w.at[i], k) == QDOT_ZERO;
    qdot_walk_end(&w);
    return found;
}

/* Find the Taylor coefficients D^k e / k! at symbol = at. QDOT_EDOMAIN if one of them does not exist. */
static qdot_status
derivatives(course *x, qdot_expr e, qdot_expr symbol, qdot_expr at, int64_t most, laurent *s)
{
    s->least = 0;
    for (int64_t k = 0; k <= most; k++) {
        qdot_expr c;

        if (k > 0 && e != QDOT_ZERO)
            e = qdot_div(x->pool, qdot_diff(x->pool, e, symbol), qdot_expr_int(x->pool, k));
        QDOT_TRY(qdot_value_kind_check(x->pool, e));
        c = expand_products(x, qdot_subs(x->pool, e, 1, &symbol, &at));
        QDOT_TRY(qdot_value_kind_check(x->pool, c));
        if (contains_power_of_zero(x->pool, c))
            return QDOT_EDOMAIN;
        QDOT_TRY(qdot_vec_push(&s->c, c));
        QDOT_TRY(qdot_interrupt_check());
    }
    return QDOT_OK;
}

/* Find the order of the first term of e that does not vanish. */
static qdot_status
find_leading_order(course *x, qdot_expr e, int64_t *least)
{
    for (int64_t most = 4; most <= MOST_LEADING; most *= 2) {
        laurent s = {0};
        qdot_status status = laurent_series(x, e, most, &s);
        bool found;

        if (status == QDOT_OK)
            drop_leading_zeros(x, &s);
        found = s.c.n > 0;
        *least = s.least;
        laurent_clear(&s);
        QDOT_TRY(status);
        if (found)
            return QDOT_OK;
    }
    return fail_without_series(x, e, "no term of it is known to differ from 0");
}

static qdot_status
series_of_sum(course *x, qdot_expr e, int64_t most, laurent *s)
{
    const uint32_t n = qdot_expr_count(x->pool, e);
    laurent *parts = qdot_calloc(n + 1, sizeof *parts);
    int64_t least = 0;
    qdot_status status = parts == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (uint32_t i = 1; i < n && status == QDOT_OK; i += 2) {
        status = laurent_series(x, qdot_expr_arg(x->pool, e, i), most, &parts[i]);
        least = parts[i].least < least ? parts[i].least : least;
    }
    s->least = least;
    for (int64_t k = least; k <= most && status == QDOT_OK; k++) {
        qdot_expr sum = k == 0 ? qdot_expr_arg(x->pool, e, 0) : QDOT_ZERO;

        for (uint32_t i = 1; i < n; i += 2)
            sum = qdot_add(x->pool, sum,
                           qdot_mul(x->pool, coefficient(&parts[i], k),
                                    qdot_expr_arg(x->pool, e, i + 1)));
        status = qdot_value_kind_check(x->pool, sum);
        if (status == QDOT_OK)
            status = qdot_vec_push(&s->c, sum);
    }
    for (uint32_t i = 0; parts != NULL && i < n; i++)
        laurent_clear(&parts[i]);
    qdot_free(parts);
    return status;
}

/* Find the series of base^q up to the power ray^most, where the series of the base begins with ray^first. */
static qdot_status
series_of_power(course *x, qdot_expr base, qdot_expr q, int64_t first, int64_t most, laurent *s)
{
    laurent b = {0};
    int64_t times = 0;
    qdot_status status;

    if (qdot_expr_contains(x->pool, q, x->ray) ||
        (first != 0 && !qdot_expr_to_int(x->pool, q, &times)))
        return fail_without_series(x, qdot_pow(x->pool, base, q), "it is no power series in the symbols");
    if (times * first > most) {
        s->least = most + 1;
        return QDOT_OK;
    }
    status = laurent_series(x, base, first + most - times * first, &b);
    if (status == QDOT_OK)
        drop_leading_zeros(x, &b);
    if (status == QDOT_OK)
        status = laurent_power(x, &b, q, times * first, most, s);
    laurent_clear(&b);
    return status;
}

static qdot_status
series_of_product(course *x, qdot_expr e, int64_t most, laurent *s)
{
    qdot_pool *pool = x->pool;
    const uint32_t n = qdot_expr_count(pool, e);
    qdot_expr outside = qdot_expr_arg(pool, e, 0);
    int64_t *first = qdot_calloc(n + 1, sizeof *first), total = 0, times;
    qdot_status status = first == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (uint32_t i = 1; i < n && status == QDOT_OK; i += 2) {
        const qdot_expr base = qdot_expr_arg(pool, e, i), q = qdot_expr_arg(pool, e, i + 1);

        if (!qdot_expr_contains(pool, base, x->ray))
            continue;
        status = find_leading_order(x, base, &first[i]);
        if (status == QDOT_OK && first[i] != 0 && qdot_expr_to_int(pool, q, &times))
            total += times * first[i];
    }
    for (uint32_t i = 1; i < n && status == QDOT_OK; i += 2) {
        const qdot_expr base = qdot_expr_arg(pool, e, i), q = qdot_expr_arg(pool, e, i + 1);

        if (!qdot_expr_contains(pool, base, x->ray) && !qdot_expr_contains(pool, q, x->ray))
            outside = qdot_mul(pool, outside, qdot_pow(pool, base, q));
    }
    if (status == QDOT_OK)
        status = qdot_value_kind_check(pool, outside);
    if (status == QDOT_OK)
        status = qdot_vec_push(&s->c, outside);
    s->least = 0;
    for (uint32_t i = 1; i < n && status == QDOT_OK; i += 2) {
        const qdot_expr base = qdot_expr_arg(pool, e, i), q = qdot_expr_arg(pool, e, i + 1);
        laurent part = {0};
        int64_t own = 0;

        if (!qdot_expr_contains(pool, base, x->ray) && !qdot_expr_contains(pool, q, x->ray))
            continue;
        if (first[i] != 0 && qdot_expr_to_int(pool, q, &times))
            own = times * first[i];
        /* expand only to the order that is still needed after multiplying with the other factors */
        status = series_of_power(x, base, q, first[i], most - (total - own), &part);
        if (status == QDOT_OK)
            status = multiply_series(x, s, &part, most - total + s->least + own);
        laurent_clear(&part);
    }
    qdot_free(first);
    return status;
}

/* The functions tan, cot, sec, csc as quotients of sine and cosine; other functions unchanged. */
static qdot_expr
as_quotient(qdot_pool *pool, qdot_expr e)
{
    const qdot_expr u = qdot_expr_arg(pool, e, 0);

    switch ((qdot_fun_id)qdot_expr_node(pool, e)->op) {
    case QDOT_TAN:
        return qdot_div(pool, qdot_fun1(pool, QDOT_SIN, u), qdot_fun1(pool, QDOT_COS, u));
    case QDOT_COT:
        return qdot_div(pool, qdot_fun1(pool, QDOT_COS, u), qdot_fun1(pool, QDOT_SIN, u));
    case QDOT_SEC: return qdot_div(pool, QDOT_ONE, qdot_fun1(pool, QDOT_COS, u));
    case QDOT_CSC: return qdot_div(pool, QDOT_ONE, qdot_fun1(pool, QDOT_SIN, u));
    default: return e;
    }
}

/* Find the Taylor coefficients of a function of one argument at a; QDOT_EDOMAIN if one of them does not exist. */
static qdot_status
function_coefficients(course *x, qdot_fun_id id, qdot_expr a, int64_t most, laurent *s)
{
    const qdot_expr z = qdot_symbol_get(x->pool, QDOT_FORMAL, "a place");

    if (a != QDOT_ZERO || qdot_elliptic_coefficient(x->pool, id, 0) == QDOT_NIL)
        return derivatives(x, qdot_fun1(x->pool, id, z), z, a, most, s);
    s->least = 0;
    for (int64_t k = 0; k <= most; k++)
        QDOT_TRY(qdot_vec_push(&s->c, qdot_elliptic_coefficient(x->pool, id, k)));
    return qdot_pool_check(x->pool);
}

/* Find the series of f(a + h), where h has no term of order 0. */
static qdot_status
series_of_function(course *x, qdot_expr e, int64_t most, laurent *s)
{
    qdot_pool *pool = x->pool;
    const qdot_node *node = qdot_expr_node(pool, e);
    laurent inner = {0}, outer = {0};
    qdot_status status;

    if (node->n != 1)
        return fail_without_series(x, e, "a derivative does not exist at the point");
    const qdot_fun_id id = (qdot_fun_id)node->op;
    if (as_quotient(pool, e) != e)
        return laurent_series(x, as_quotient(pool, e), most, s);
    status = laurent_series(x, qdot_expr_arg(pool, e, 0), most, &inner);
    if (status == QDOT_OK)
        drop_leading_zeros(x, &inner);
    if (status == QDOT_OK && inner.least < 0)
        status = fail_without_series(x, e, "its argument grows without bound at the point");
    if (status == QDOT_OK &&
        qdot_switch_at(x->pool, id, coefficient(&inner, 0), &x->facts))
        status = fail_without_series(x, e, "it switches at the point");
    if (status == QDOT_OK) {
        status = function_coefficients(x, id, coefficient(&inner, 0), most, &outer);
        if (status == QDOT_EDOMAIN)
            status = fail_without_series(x, e, "a derivative does not exist at the point");
    }
    if (status == QDOT_OK && inner.c.n > 0 && inner.least == 0) {
        inner.c.at[0] = QDOT_ZERO;
    }
    s->least = 0;
    for (int64_t k = most; k >= 0 && status == QDOT_OK; k--) { /* Horner's scheme */
        if (s->c.n > 0)
            status = multiply_series(x, s, &inner, most);
        while (status == QDOT_OK && s->least > 0) { /* add zeros so that the list starts at order 0 */
            laurent whole = {0};

            for (int64_t i = 0; i < s->least + (int64_t)s->c.n && status == QDOT_OK; i++)
                status = qdot_vec_push(&whole.c, coefficient(s, i));
            laurent_clear(s);
            *s = whole;
        }
        if (status == QDOT_OK && s->c.n == 0)
            status = qdot_vec_push(&s->c, QDOT_ZERO);
        if (status == QDOT_OK)
            s->c.at[0] = qdot_add(pool, s->c.at[0], coefficient(&outer, k));
    }
    laurent_clear(&inner);
    laurent_clear(&outer);
    return status == QDOT_OK ? qdot_pool_check(pool) : status;
}

/* Find the series of e up to the power `most` of the variable. */
static qdot_status
laurent_series(course *x, qdot_expr e, int64_t most, laurent *s)
{
    qdot_status status;

    *s = (laurent){0};
    QDOT_TRY(qdot_interrupt_check());
    if (!qdot_expr_contains(x->pool, e, x->ray))
        return qdot_vec_push(&s->c, e);
    status = derivatives(x, e, x->ray, QDOT_ZERO, most > 0 ? most : 0, s);
    if (status != QDOT_EDOMAIN)
        return status;
    laurent_clear(s);
    if (x->depth >= MOST_DEPTH)
        return fail_without_series(x, e, "it is nested too deep");
    x->depth++;
    switch (qdot_expr_kind(x->pool, e)) {
    case QDOT_SUM: status = series_of_sum(x, e, most, s); break;
    case QDOT_PROD: status = series_of_product(x, e, most, s); break;
    case QDOT_FUN: status = series_of_function(x, e, most, s); break;
    default: status = fail_without_series(x, e, "it is not defined at the point");
    }
    x->depth--;
    return status;
}

/* --- the series of an expression ---------------------------------------------------- */

/* Whether all factors that contain `step` have positive integer exponents. */
static bool
has_whole_powers(qdot_pool *pool, qdot_expr product, qdot_expr step)
{
    for (uint32_t j = 1; j < qdot_expr_node(pool, product)->n; j += 2) {
        int64_t times;

        if (qdot_expr_contains(pool, qdot_expr_arg(pool, product, j), step) &&
            (!qdot_expr_to_int(pool, qdot_expr_arg(pool, product, j + 1), &times) ||
             times <= 0))
            return false;
    }
    return true;
}

static bool
is_polynomial(const course *x, qdot_expr e)
{
    qdot_walk w;
    bool sound = qdot_walk_begin(x->pool, e, &w) == QDOT_OK;

    for (size_t i = 0; i < w.n && sound; i++) {
        const qdot_node *node = qdot_expr_node(x->pool, w.at[i]);

        for (size_t k = 0; k < x->steps.n && sound; k++)
            sound = node->kind == QDOT_FUN || node->kind == QDOT_UFUN
                        ? !qdot_expr_contains(x->pool, w.at[i], x->steps.at[k])
                        : node->kind != QDOT_PROD ||
                              has_whole_powers(x->pool, w.at[i], x->steps.at[k]);
    }
    qdot_walk_end(&w);
    return sound;
}

typedef struct {
    course *x;
    int64_t most;
} degree;

/* The Taylor series of a scalar along the ray through the expansion point. */
static qdot_expr
series_along_ray(qdot_pool *pool, qdot_expr scalar, void *user)
{
    const degree *d = user;
    course *x = d->x;
    laurent s = {0};
    qdot_expr f = qdot_circle_join(pool, qdot_subs(pool, scalar, x->n, x->symbols, x->places.at)), sum = QDOT_ZERO;
    qdot_status status = qdot_value_kind_check(pool, f);

    if (status == QDOT_OK)
        status = check_no_switches(x, f);
    if (status == QDOT_OK)
        status = laurent_series(x, f, d->most, &s);
    if (status == QDOT_OK)
        for (int64_t k = s.least; k < 0 && status == QDOT_OK; k++)
            if (!qdot_is_zero(pool, coefficient(&s, k), &x->facts))
                status = fail_without_series(x, f, "it grows without bound at the point");
    for (int64_t k = 0; k <= d->most && status == QDOT_OK; k++) {
        qdot_expr c = qdot_circle_join(pool, coefficient(&s, k));

        if (!is_polynomial(x, c)) {
            status = shorten_coefficient(x, &c);
            if (status == QDOT_OK && !is_polynomial(x, c))
                status = fail_without_series(x, f, "its value depends on the path to the point");
        }
        sum = qdot_add(pool, sum, expand_products(x, c));
    }
    laurent_clear(&s);
    return status == QDOT_OK ? sum : qdot_pool_fail(pool);
}

/* Prepare the substitutions for an expansion about the point `at`. */
static qdot_status
set_expansion_rays(course *x, const qdot_expr *at)
{
    qdot_pool *pool = x->pool;

    for (size_t i = 0; i < x->n; i++) {
        qdot_text name = {0};
        qdot_status status;

        qdot_text_format(&name, "ray %zu", i);
        status = qdot_text_status(&name);
        if (status == QDOT_OK)
            status = qdot_vec_push(&x->steps, qdot_symbol_get(pool, QDOT_FORMAL, name.at));
        qdot_text_clear(&name);
        QDOT_TRY(status);
        QDOT_TRY(qdot_vec_push(&x->moves, qdot_sub(pool, x->symbols[i], at[i])));
        QDOT_TRY(qdot_vec_push(&x->places, qdot_add(pool, at[i],
                                                    qdot_mul(pool, x->ray, x->steps.at[i]))));
    }
    return qdot_pool_check(pool);
}

qdot_status
qdot_series(qdot_pool *pool, const qdot_facts *facts, qdot_expr e, size_t n,
            const qdot_expr *symbols, const qdot_expr *at, int64_t most, qdot_expr *value)
{
    course x = {.pool = pool,
                .facts = *facts,
                .ray = qdot_symbol_get(pool, QDOT_FORMAL, "ray"),
                .n = n,
                .symbols = symbols};
    degree d = {&x, most};
    qdot_status status = set_expansion_rays(&x, at);

    if (status == QDOT_OK) {
        qdot_expr sum = qdot_value_map(pool, e, series_along_ray, &d);

        status = qdot_value_kind_check(pool, sum);
        if (status == QDOT_OK) {
            *value = restore_symbols(&x, sum);
            status = qdot_value_kind_check(pool, *value);
        }
    }
    qdot_free(x.places.at);
    qdot_free(x.steps.at);
    qdot_free(x.moves.at);
    return status;
}
