/* print-product.c -- products, powers and roots as formulas.
 *
 * The root of what is positive comes apart when it is built: sqrt(k/m) is k^(1/2) m^(-1/2). It is
 * written as one root again, which reads back as the same product.
 */
#include <string.h>

#include <flint/flint.h>
#include <flint/fmpz.h>

#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/print-parts.h"
#include "expr/unit.h"
#include "units/dimension.h"

/* The factors of a product that are written under one root sign. */
struct root {
    bool any, above;  /* several factors share one root sign; it is above the fraction bar */
    bool decimal;     /* the number under the root is written as a decimal one */
    uint32_t last;    /* the last of these factors above (or below) the bar: the root is written there */
    fmpq_t c, number; /* the coefficient before the product, and the number under the root */
};

/* Whether the factor b^e is written in the denominator. */
static bool
is_in_denominator(const qdot_pool *pool, qdot_expr e)
{
    const fmpq *x = qdot_expr_rational(pool, e);

    return x != NULL ? qdot_rational_sgn(x) < 0
                     : NODE(pool, e)->kind == QDOT_PROD && qdot_expr_is_negative(pool, e);
}

/* --- printing powers -------------------------------------------------------------------------- */

/* Print |n/d| for integers n and d that are not nodes of the pool. */
static void
print_absolute_quotient(printer *p, const fmpz_t n, const fmpz_t d)
{
    fmpq_t x;

    fmpq_init(x);
    fmpz_abs(fmpq_numref(x), n);
    if (d != NULL)
        fmpz_set(fmpq_denref(x), d);
    qdot_print_number(p, x, 0);
    fmpq_clear(x);
}

/* Print a number as an exponent, in LaTeX with a slash as in r^{1/3}; size: print its absolute value. */
static void
print_number_exponent(printer *p, const fmpq *x, bool size)
{
    fmpq_t c;

    fmpq_init(c);
    qdot_rational_set(c, x);
    if (size)
        fmpq_abs(c, c);
    if (!fmpz_is_one(fmpq_denref(c)) && !qdot_print_says_decimal(p, c)) {
        const bool minus = qdot_rational_sgn(c) < 0;
        qdot_formula_id outer = p->at;

        if (minus) {
            outer = print_begin_row(p);
            print_sign(p, QDOT_SIGN_NEGATIVE);
        }
        print_begin(p, QDOT_FORMULA_FRACTION, 0, QDOT_FORMULA_SLANTED);
        fmpz_abs(fmpq_numref(c), fmpq_numref(c));
        print_absolute_quotient(p, fmpq_numref(c), NULL);
        print_absolute_quotient(p, fmpq_denref(c), NULL);
        p->at = outer;
    } else {
        qdot_print_number(p, c, 0);
    }
    fmpq_clear(c);
}

/* Print the exponent of a power, negated in a denominator; within a line of text, a `bare` one gets no brackets. */
static void
print_exponent_expression(printer *p, qdot_expr e, bool turned, bool bare)
{
    const fmpq *x = qdot_expr_rational(p->pool, e);
    const qdot_formula_id outer = print_begin_one(p);

    if (!is_drawn(p))
        print_begin_bracket(p, !bare);
    if (x != NULL && is_drawn(p))
        print_number_exponent(p, x, turned);
    else
        child(p, e, turned ? MAGNITUDE : TOP);
    p->at = outer;
}

/* What a power begins with is to be appended from here on; p->at is to be set to what is returned. integer: the
 * exponent is a positive integer, which a line has as superscripts. */
static qdot_formula_id
begin_power(printer *p, bool integer)
{
    return print_begin(p, QDOT_FORMULA_POWER, 0,
                       integer && p->notation == QDOT_NOTATION_LINE ? QDOT_FORMULA_RAISED : 0);
}

static bool
exponent_is_integer(const qdot_pool *pool, qdot_expr e, bool turned)
{
    const fmpq *x = qdot_expr_rational(pool, e);

    return x != NULL && fmpz_is_one(fmpq_denref(x)) && (qdot_rational_sgn(x) > 0 || turned);
}

/* Print an exponent, with its sign reversed in a denominator. */
static void
print_exponent(printer *p, qdot_expr e, bool turned)
{
    const qdot_pool *pool = p->pool;
    const fmpq *x = qdot_expr_rational(pool, e);
    bool integer = exponent_is_integer(pool, e, turned), bare = integer; /* `bare`: printed without brackets */

    if (integer && p->notation == QDOT_NOTATION_LINE) {
        print_absolute_quotient(p, fmpq_numref(x), NULL);
        return;
    }
    if (x != NULL)
        bare = integer || ((qdot_rational_sgn(x) > 0 || turned) && qdot_print_says_decimal(p, x));
    else if (turned) /* print -n as n: the sign of the coefficient is left out */
        bare = NODE(pool, e)->n == 3 && ARGS(pool, e)[0] == QDOT_MINUS_ONE &&
               ARGS(pool, e)[2] == QDOT_ONE &&
               NODE(pool, ARGS(pool, e)[1])->kind == QDOT_SYM;
    else
        bare = NODE(pool, e)->kind == QDOT_SYM;
    print_exponent_expression(p, e, turned, bare);
}

/* Whether e is sin ... cot; Jacobi's sn and cn, sin and cos of an amplitude, are written as other functions are. */
static bool
is_circular_function(const qdot_pool *pool, qdot_expr e)
{
    return NODE(pool, e)->kind == QDOT_FUN && NODE(pool, e)->op <= QDOT_COT &&
           !qdot_expr_is_function(pool, ARGS(pool, e)[0], QDOT_JACOBI_AM);
}

/* Print sin(x)^2 as sin²(x). */
static void
print_power_of_function(printer *p, qdot_expr b, qdot_expr e, bool turned)
{
    const char *name = qdot_fun_name(NODE(p->pool, b)->op);
    const qdot_formula_id all = print_begin(p, QDOT_FORMULA_APPLY, 0, 0),
                          apply = begin_power(p, exponent_is_integer(p->pool, e, turned)), power = print_begin_one(p);

    qdot_formula_add_text(p->out, p->at, QDOT_TEXT_FUNCTION, name, strlen(name));
    p->at = power;
    print_exponent(p, e, turned);
    p->at = apply;
    print_begin_bracket(p, true);
    children(p, b, 0, NODE(p->pool, b)->n);
    p->at = all;
}

/* Whether e is 1/2 or -1/2. */
static bool
is_half_exponent(const qdot_pool *pool, qdot_expr e)
{
    const fmpq *x = qdot_expr_rational(pool, e);

    return x != NULL && qdot_integer_is(fmpq_denref(x), 2) && fmpz_is_pm1(fmpq_numref(x));
}

static bool
exponent_is_even(const fmpq *x)
{
    return x != NULL && fmpz_is_one(fmpq_denref(x)) && fmpz_is_even(fmpq_numref(x));
}

/* Whether e can follow the sign √ without brackets. */
static bool
needs_no_brackets_under_root(const qdot_pool *pool, qdot_expr e)
{
    return NODE(pool, e)->kind == QDOT_SYM ||
           (NODE(pool, e)->kind == QDOT_NUM &&
            fmpz_is_one(fmpq_denref(RATIONAL(pool, e))) &&
            qdot_rational_sgn(RATIONAL(pool, e)) > 0);
}

/* b as a base or a factor; an even power is written of the side that is not negative:
 * (cosh(v) - cos(u))^2. */
static void
print_base(printer *p, qdot_expr b, const fmpq *x, bool turned, int context)
{
    turned |= exponent_is_even(x) && NODE(p->pool, b)->kind == QDOT_SUM &&
              (NODE(p->pool, b)->sign & QDOT_LE0);
    qdot_print_part(p, (struct part){.e = b, .context = context, .turned = turned});
}

/* Print b^e, below the fraction bar as b^-e; flip: print (-b)^e instead, for an odd e. */
static void
print_factor(printer *p, qdot_expr b, qdot_expr e, bool down, int context, bool flip)
{
    const qdot_pool *pool = p->pool;
    const fmpq *x = qdot_expr_rational(pool, e);
    bool half = is_half_exponent(pool, e) && (down || qdot_rational_sgn(x) > 0);
    qdot_formula_id outer, power;

    if (half) {
        outer = print_begin(p, QDOT_FORMULA_ROOT, 0,
                            p->notation == QDOT_NOTATION_LINE && needs_no_brackets_under_root(pool, b) ? QDOT_FORMULA_BARE : 0);
        child(p, b, TOP);
        p->at = outer;
    } else if (down ? e == QDOT_MINUS_ONE : e == QDOT_ONE) {
        print_base(p, b, x, flip, context);
    } else if (p->notation != QDOT_NOTATION_SCRIPT && is_circular_function(pool, b) && x != NULL &&
               fmpz_is_one(fmpq_denref(x)) && (down || qdot_rational_sgn(x) > 0)) {
        print_power_of_function(p, b, e, down);
    } else {
        outer = begin_power(p, exponent_is_integer(pool, e, down));
        power = print_begin_one(p);
        print_base(p, b, x, flip, BASE);
        p->at = power;
        print_exponent(p, e, down);
        p->at = outer;
    }
}

/* --- factors under a common root ---------------------------------------------------------------- */

/* Whether the constructors take b^x, x half an odd number, out of the root of a product. */
static bool
is_taken_out_of_root(const qdot_pool *pool, qdot_expr b, qdot_expr x)
{
    const fmpq *e = qdot_expr_rational(pool, x);

    return e != NULL && qdot_integer_is(fmpq_denref(e), 2) && qdot_unit_symbol_base(pool, b) < 0 &&
           NODE(pool, b)->kind != QDOT_NUM && NODE(pool, b)->kind != QDOT_PROD &&
           (NODE(pool, b)->sign & QDOT_GE0);
}

/* Whether a factor of unknown sign stays under the root sign when the printed product is read back. */
static bool
stays_under_root(const qdot_pool *pool, qdot_expr b, qdot_expr x)
{
    return x == QDOT_HALF && !(NODE(pool, b)->sign & QDOT_GE0) &&
           (NODE(pool, b)->kind == QDOT_SUM || qdot_expr_is_atom(pool, b));
}

static bool
is_number_root(const qdot_pool *pool, qdot_expr b, qdot_expr x)
{
    return NODE(pool, b)->kind == QDOT_NUM && x == QDOT_HALF;
}

static bool
is_under_root(const qdot_pool *pool, const struct root *r, qdot_expr b, qdot_expr x)
{
    return r->any &&
           (is_taken_out_of_root(pool, b, x) || stays_under_root(pool, b, x) || is_number_root(pool, b, x));
}

/* The factors of c e that go under one root, at least two of them. c sqrt(n), c = a/b, is
 * a/(b/g) sqrt((n/g)/g) with g = gcd(n, b): 1/3 sqrt(6) is sqrt(2/3). */
static void
find_common_root(const printer *p, const fmpq *c, qdot_expr e, struct root *r)
{
    const qdot_pool *pool = p->pool;
    uint32_t n = NODE(pool, e)->kind == QDOT_PROD ? NODE(pool, e)->n : 0, out = 0, in = 0;
    const fmpq *number = NULL;

    r->any = r->above = false;
    for (uint32_t i = 1; i < n; i += 2) {
        qdot_expr b = ARGS(pool, e)[i], x = ARGS(pool, e)[i + 1];

        out += is_taken_out_of_root(pool, b, x);
        in += stays_under_root(pool, b, x);
        if (is_number_root(pool, b, x))
            number = RATIONAL(pool, b);
    }
    r->any = in <= 1 && out + in > 0 && out + in + (number != NULL) > 1;
    if (!r->any)
        return;
    for (uint32_t i = 1; i < n; i += 2) { /* the last factor above the bar; if there is none, below it */
        qdot_expr b = ARGS(pool, e)[i], x = ARGS(pool, e)[i + 1];
        bool up = !is_in_denominator(pool, x);

        if (is_under_root(pool, r, b, x) && up >= r->above) {
            r->last = i;
            r->above = up;
        }
    }
    fmpq_init(r->c);
    fmpq_init(r->number);
    qdot_rational_set(r->c, c);
    fmpq_one(r->number);
    if (number != NULL) {
        fmpz_t g;

        fmpz_init(g);
        fmpz_gcd(g, fmpq_numref(number), fmpq_denref(c));
        fmpz_divexact(fmpq_denref(r->c), fmpq_denref(c), g);
        fmpz_divexact(fmpq_numref(r->number), fmpq_numref(number), g);
        fmpz_set(fmpq_denref(r->number), g);
        fmpz_clear(g);
    }
    r->decimal = qdot_print_says_decimal(p, r->number);
}

static void
clear_root(struct root *r)
{
    if (!r->any)
        return;
    fmpq_clear(r->c);
    fmpq_clear(r->number);
}

/* Print the factor b^(k/2) of a product under the product's root sign, as b^|k|. */
static void
print_power_under_root(printer *p, qdot_expr b, qdot_expr x, int context)
{
    ulong k = fmpz_get_ui(fmpq_numref(RATIONAL(p->pool, x)));
    uint32_t power = (uint32_t)((slong)k < 0 ? -k : k);
    qdot_formula_id outer, row;

    if (power == 1) {
        child(p, b, context);
        return;
    }
    outer = begin_power(p, true);
    row = print_begin_one(p);
    child(p, b, BASE);
    p->at = row;
    qdot_print_integer(p, power);
    p->at = outer;
}

/* Print the numerator or denominator of the fraction that stands under the root sign. */
static void
print_radicand_part(printer *p, qdot_expr e, const struct root *r, bool down, uint32_t count,
                    bool fraction)
{
    const qdot_pool *pool = p->pool;
    const fmpz *number = down ? fmpq_denref(r->number) : fmpq_numref(r->number);
    bool first = true, shown = count == 0 || (r->decimal ? !down : !fmpz_is_one(number));

    if (shown)
        print_absolute_quotient(p, number, r->decimal ? fmpq_denref(r->number) : NULL);
    for (uint32_t i = 1; i < NODE(pool, e)->n; i += 2) {
        qdot_expr b = ARGS(pool, e)[i], x = ARGS(pool, e)[i + 1];

        if (!is_under_root(pool, r, b, x) || NODE(pool, b)->kind == QDOT_NUM ||
            (is_in_denominator(pool, x) == r->above) != down)
            continue;
        if (!first || shown)
            print_sign(p, QDOT_SIGN_TIMES);
        print_power_under_root(p, b, x,
                               is_drawn(p) && count + shown == 1 ? TOP
                               : down && count + shown == 1      ? BASE
                               : fraction || count + shown > 1   ? FACTOR
                                                     : TOP);
        first = false;
    }
}

static void
print_common_root(printer *p, qdot_expr e, const struct root *r)
{
    const qdot_pool *pool = p->pool;
    uint32_t count[2] = {0, 0};
    bool below_bar = !r->decimal && !fmpz_is_one(fmpq_denref(r->number));
    bool fraction, several;
    qdot_formula_id outer, bar;

    for (uint32_t i = 1; i < NODE(pool, e)->n; i += 2) {
        qdot_expr b = ARGS(pool, e)[i], x = ARGS(pool, e)[i + 1];

        if (is_under_root(pool, r, b, x) && NODE(pool, b)->kind != QDOT_NUM)
            count[is_in_denominator(pool, x) == r->above]++;
    }
    fraction = count[1] > 0 || below_bar;
    several = count[1] + below_bar > 1 && !is_drawn(p);
    outer = print_begin(p, QDOT_FORMULA_ROOT, 0, 0);
    if (fraction) {
        print_begin(p, QDOT_FORMULA_FRACTION, 0, 0);
        bar = print_begin_row(p);
        print_radicand_part(p, e, r, false, count[0], fraction);
        p->at = bar;
        print_begin_row(p);
        print_begin_bracket(p, several);
        print_radicand_part(p, e, r, true, count[1], fraction);
    } else {
        print_radicand_part(p, e, r, false, count[0], fraction);
    }
    p->at = outer;
}

/* --- printing products ------------------------------------------------------------------------ */

/* The number of factors in the denominator (or numerator), where those under the root sign count as one. */
static uint32_t
count_factors(const qdot_pool *pool, qdot_expr e, const struct root *r, bool down)
{
    uint32_t count = r->any && r->above != down;

    if (NODE(pool, e)->kind != QDOT_PROD)
        return e != QDOT_ONE && !down && qdot_unit_symbol_base(pool, e) < 0;
    for (uint32_t i = 1; i < NODE(pool, e)->n; i += 2)
        count += qdot_unit_symbol_base(pool, ARGS(pool, e)[i]) < 0 && is_in_denominator(pool, ARGS(pool, e)[i + 1]) == down &&
                 !is_under_root(pool, r, ARGS(pool, e)[i], ARGS(pool, e)[i + 1]);
    return count;
}

/* The sign between a number and the factor b^e after it. */
static qdot_formula_sign
sign_after_number(const printer *p, const fmpq *number, qdot_expr b, qdot_expr e)
{
    if (NODE(p->pool, b)->kind != QDOT_NUM)
        return QDOT_SIGN_TIMES;
    /* a short number before a root needs no product sign: 2 √3 */
    return is_half_exponent(p->pool, e) && qdot_print_is_compact(p, number) ? QDOT_SIGN_TIMES
                                                                : QDOT_SIGN_DOT;
}

/* Where a factor stands: of parameters, the roots of their sums behind them, functions and the
 * others: a sqrt(b + c) x sin(alpha). */
static uint32_t
factor_print_rank(const qdot_pool *pool, qdot_expr b, qdot_expr x)
{
    const fmpq *k = qdot_expr_rational(pool, x);

    if (NODE(pool, b)->kind == QDOT_FUN ||
        (NODE(pool, b)->holds & ~(uint32_t)(QDOT_HAS_PARAM | QDOT_HAS_FUN | QDOT_HAS_FORMAL)))
        return 2;
    return NODE(pool, b)->kind == QDOT_SUM && k != NULL && !fmpz_is_one(fmpq_denref(k));
}

/* The factors of e above (below) the bar; number: what stands before them already, or NULL;
 * turned: the base that is written as its negative. */
static void
print_factors(printer *p, qdot_expr e, const struct root *r, bool down, const fmpq *number,
              int context, qdot_expr turned)
{
    const qdot_pool *pool = p->pool;
    bool first = true;

    if (NODE(pool, e)->kind != QDOT_PROD) {
        if (number != NULL)
            print_sign(p, sign_after_number(p, number, e, QDOT_ONE));
        child(p, e, context);
        return;
    }
    for (uint32_t k = 0; k < 3 * (NODE(pool, e)->n / 2); k++) {
        uint32_t i = 1 + 2 * (k % (NODE(pool, e)->n / 2));
        qdot_expr b = ARGS(pool, e)[i], x = ARGS(pool, e)[i + 1];
        bool under = is_under_root(pool, r, b, x);

        if (factor_print_rank(pool, b, x) != k / (NODE(pool, e)->n / 2) || qdot_unit_symbol_base(pool, b) >= 0 ||
            (under ? i != r->last || r->above == down : is_in_denominator(pool, x) != down))
            continue;
        if (first && number != NULL)
            print_sign(p, under ? QDOT_SIGN_TIMES : sign_after_number(p, number, b, x));
        else if (!first)
            print_sign(p, NODE(pool, b)->kind == QDOT_NUM && !under ? QDOT_SIGN_DOT : QDOT_SIGN_TIMES);
        if (under)
            print_common_root(p, e, r);
        else
            print_factor(p, b, x, down, context, b == turned || (p->turning && b == p->below));
        first = false;
    }
}

static bool
has_pi_in_denominator(const qdot_pool *pool, qdot_expr e)
{
    for (uint32_t i = 1; NODE(pool, e)->kind == QDOT_PROD && i < NODE(pool, e)->n; i += 2)
        if (ARGS(pool, e)[i] == QDOT_PI && is_in_denominator(pool, ARGS(pool, e)[i + 1]))
            return true;
    return false;
}

/* --- numbers with units ----------------------------------------------------------------------- */

/* The powers of the base units in e; false: there are none. A power that is no small number is left to the product. */
static bool
find_units(const qdot_pool *pool, qdot_expr e, qdot_dimension *unit)
{
    bool any = false;

    *unit = qdot_dimension_none();
    for (uint32_t i = 1; NODE(pool, e)->kind == QDOT_PROD && i < NODE(pool, e)->n; i += 2) {
        const int base = qdot_unit_symbol_base(pool, ARGS(pool, e)[i]);
        const fmpq *x = base < 0 ? NULL : qdot_expr_rational(pool, ARGS(pool, e)[i + 1]);

        if (x == NULL)
            continue;
        unit->of[base] = qdot_exponent_make(fmpz_get_si(fmpq_numref(x)), fmpz_get_si(fmpq_denref(x)));
        any = true;
    }
    if (qdot_unit_symbol_base(pool, e) >= 0) {
        unit->of[qdot_unit_symbol_base(pool, e)] = (qdot_exponent){1, 1};
        any = true;
    }
    return any;
}

/* The unit behind a number: ` [m/s^2]`. */
static void
print_unit(printer *p, qdot_dimension unit)
{
    qdot_text text = {0};

    qdot_text_add(&text, " [");
    qdot_dimension_unit(unit, &text);
    qdot_text_char(&text, ']');
    if (qdot_text_status(&text) == QDOT_OK)
        qdot_formula_add_text(p->out, p->at, QDOT_TEXT_WORDS, text.at, text.n);
    else
        p->status = QDOT_ENOMEM;
    qdot_text_clear(&text);
}

/* n/2^k as a decimal number, for k up to 9: 0.5, 2.25. */
static bool
print_binary_fraction(printer *p, const fmpq *x)
{
    const slong k = fmpz_fits_si(fmpq_denref(x)) ? __builtin_ctzll((uint64_t)fmpz_get_si(fmpq_denref(x))) : 0;
    qdot_text digits = {0};
    char *all;
    fmpz_t n;

    if (k < 1 || k > 9 || !qdot_integer_is(fmpq_denref(x), 1 << k) || fmpz_sizeinbase(fmpq_numref(x), 10) > 30)
        return false;
    fmpz_init(n);
    fmpz_abs(n, fmpq_numref(x));
    for (slong i = 0; i < k; i++)
        fmpz_mul_ui(n, n, 5);
    all = fmpz_get_str(NULL, 10, n);
    for (slong i = (slong)strlen(all); i <= k; i++)
        qdot_text_char(&digits, '0');
    qdot_text_add(&digits, all);
    if (qdot_text_status(&digits) == QDOT_OK) {
        qdot_formula_add_text(p->out, p->at, QDOT_TEXT_NUMBER, digits.at, digits.n - (size_t)k);
        qdot_formula_add_text(p->out, p->at, QDOT_TEXT_NUMBER, ".", 1);
        qdot_formula_add_text(p->out, p->at, QDOT_TEXT_NUMBER, digits.at + digits.n - k, (size_t)k);
    } else {
        p->status = QDOT_ENOMEM;
    }
    flint_free(all);
    fmpz_clear(n);
    qdot_text_clear(&digits);
    return true;
}

/* The number c before its unit, in brackets if it is a fraction. */
static void
print_number_with_unit(printer *p, qdot_expr c, const fmpq *x, qdot_dimension unit)
{
    const qdot_formula_id outer = p->at;

    if (print_binary_fraction(p, x)) {
        print_unit(p, unit);
        return;
    }
    print_begin_bracket(p, !fmpz_is_one(fmpq_denref(x)) && !qdot_print_says_decimal(p, x));
    if (c == QDOT_NIL)
        print_absolute_quotient(p, fmpq_numref(x), fmpq_denref(x));
    else
        child(p, c, MAGNITUDE);
    p->at = outer;
    print_unit(p, unit);
}

void
qdot_print_scaled(printer *p, qdot_expr c, qdot_expr e, int context, bool flip)
{
    const qdot_pool *pool = p->pool;
    const fmpq *x = RATIONAL(pool, c);
    bool drawn = is_drawn(p);
    struct root r;
    bool turning = p->below_turned && context >= 0 && is_over_below(p, e);
    bool negative = context >= 0 && (qdot_rational_sgn(x) < 0) != turning;
    qdot_expr turned = flip || negative ? turnable(p, e) : QDOT_NIL;
    bool minus = negative && turned == QDOT_NIL;

    find_common_root(p, x, e, &r);
    if (r.any)
        x = r.c;

    bool decimal = qdot_print_says_decimal(p, x);
    qdot_dimension unit;
    const bool units = find_units(pool, e, &unit);
    bool fraction = !decimal && !units && !fmpz_is_one(fmpq_denref(x));
    uint32_t up = count_factors(pool, e, &r, false),
             down = count_factors(pool, e, &r, true);
    /* where the number's denominator goes: 1/2*m/r, but 1/(2*r) if the numerator is otherwise
     * empty, and h/(2*pi) */
    bool inside = fraction && down > 0 && (up == 0 || drawn || has_pi_in_denominator(pool, e));
    bool number = up == 0 || decimal || units || !fmpz_is_pm1(fmpq_numref(x)) ||
                  (fraction && !inside);
    bool several = !drawn && (down > 1 || inside), frac = drawn && down > 0;
    uint32_t written = number + up + down;
    bool bracket = context == BASE
                       ? written > 1 || minus || e == QDOT_ONE || up + down > 0 || units
                       : context == FACTOR && (minus || down > 0 || fraction);

    const qdot_formula_id outer = print_begin_bracket(p, bracket);
    qdot_formula_id bar;

    p->turning = turning;
    if (minus)
        print_sign(p, QDOT_SIGN_NEGATIVE);
    if (down > 0)
        print_begin(p, QDOT_FORMULA_FRACTION, 0, 0);
    bar = down > 0 ? print_begin_row(p) : p->at;
    if (units) {
        print_number_with_unit(p, r.any ? QDOT_NIL : c, x, unit);
    } else if (number && r.any) {
        print_absolute_quotient(p, fmpq_numref(x), inside ? NULL : fmpq_denref(x));
    } else if (number) {
        child(p, c, inside ? NUMERATOR : MAGNITUDE);
    }
    if (up > 0)
        print_factors(p, e, &r, false, number ? x : NULL,
                      frac && number + up == 1 ? TOP
                      : written > 1 || minus   ? FACTOR
                      : context < 0            ? TERM
                                         : context,
                      turned);
    if (down > 0) {
        p->at = bar;
        print_begin_row(p);
        print_begin_bracket(p, several);
        if (inside && r.any)
            print_absolute_quotient(p, fmpq_denref(x), NULL);
        else if (inside)
            child(p, c, DENOMINATOR);
        print_factors(p, e, &r, true, inside ? x : NULL,
                      frac && down == 1 && !inside ? TOP
                      : several || frac            ? FACTOR
                                             : BASE,
                      turned);
    }
    p->at = outer;
    p->turning = false;
    clear_root(&r);
}
