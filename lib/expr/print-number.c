/* print-number.c -- prints numbers in formulas. */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include <flint/flint.h>
#include <flint/fmpz.h>

#include "base/memory.h"
#include "expr/print-parts.h"
#include "expr/rational.h"
#include "expr/walk.h"

static const struct {
    int p, q;
    const char *glyph;
} fractions[] = {
    {1, 2, "½"}, {1, 3, "⅓"}, {2, 3, "⅔"}, {1, 4, "¼"}, {3, 4, "¾"},
    {1, 6, "⅙"}, {5, 6, "⅚"}, {1, 8, "⅛"}, {3, 8, "⅜"}, {5, 8, "⅝"}, {7, 8, "⅞"},
};

/* The character for the fraction |x|, such as ½; NULL if there is none. */
static const char *
fraction_character(const fmpq_t x)
{
    for (size_t i = 0; i < sizeof fractions / sizeof *fractions; i++)
        if (qdot_integer_is(fmpq_denref(x), fractions[i].q) &&
            (qdot_integer_is(fmpq_numref(x), fractions[i].p) ||
             qdot_integer_is(fmpq_numref(x), -fractions[i].p)))
            return fractions[i].glyph;
    return NULL;
}

/* The absolute value of x = p/q as a decimal number: |p| times factor^times times 10^-places. */
struct decimal {
    uint64_t factor, times, places;
};

/* A decimal number with more digits than its fraction is used only up to this many digits. */
enum { LONGEST_DECIMAL = 40 };

/* Find the exponents of 5 and 2 in q; whether q has no other prime factors. Small q are treated without FLINT. */
static bool
count_fives_and_twos(const fmpz_t q, uint64_t *fives, uint64_t *twos)
{
    fmpz_t rest, five, two;
    bool all;

    *fives = *twos = 0;
    if (!COEFF_IS_MPZ(*q)) {
        slong n = *q;

        for (; n % 5 == 0; n /= 5)
            ++*fives;
        for (; n % 2 == 0; n /= 2)
            ++*twos;
        return n == 1;
    }
    fmpz_init(rest);
    fmpz_init_set_ui(five, 5);
    fmpz_init_set_ui(two, 2);
    *fives = (uint64_t)fmpz_remove(rest, q, five);
    *twos = (uint64_t)fmpz_remove(rest, rest, two);
    all = fmpz_is_one(rest);
    fmpz_clear(rest);
    fmpz_clear(five);
    fmpz_clear(two);
    return all;
}

/* The number of decimal digits of n, or one more. */
static size_t
count_digits(const fmpz_t n)
{
    size_t count = 1;

    if (COEFF_IS_MPZ(*n))
        return fmpz_sizeinbase(n, 10);
    for (slong rest = *n / 10; rest != 0; rest /= 10)
        count++;
    return count;
}

/* Whether x = p/q is written as a decimal: q has a factor 5 and otherwise only factors 2. */
static bool
find_decimal_form(const fmpq_t x, struct decimal *d)
{
    uint64_t fives, twos;
    size_t more;

    if (!count_fives_and_twos(fmpq_denref(x), &fives, &twos) || fives == 0)
        return false;
    d->factor = twos > fives ? 5 : 2;
    d->times = twos > fives ? twos - fives : fives - twos;
    d->places = twos > fives ? twos : fives;
    /* number of decimal digits that multiplying the numerator by factor^times (2^k or 5^k) adds */
    more = twos > fives ? d->times * 7 / 10 : d->times * 31 / 100;
    return count_digits(fmpq_numref(x)) + more <= LONGEST_DECIMAL ||
           more <= count_digits(fmpq_denref(x));
}

static bool
is_decimal(const fmpq_t x)
{
    struct decimal d;

    return find_decimal_form(x, &d);
}

bool
qdot_print_says_decimal(const printer *p, const fmpq_t x)
{
    return !p->fractions && is_decimal(x);
}

/* The numbers of an expression: fractions without a decimal form, as 5/3; decimals; of these the ones whose fraction is
 * long. Fractions with a denominator 2, 4, 8 ... go with both. */
struct numbers {
    bool fraction, decimal, long_decimal;
};

enum { LARGEST_SHORT = 20 }; /* largest numerator and denominator of a short fraction: 1/5, 3/20; 9.81 stays decimal */

static void
note_number_kind(const fmpq_t x, struct numbers *seen)
{
    static const fmpz largest[1] = {LARGEST_SHORT};
    uint64_t fives, twos;

    if (fmpz_is_one(fmpq_denref(x)))
        return;
    if (is_decimal(x)) {
        seen->decimal = true;
        seen->long_decimal |= fmpz_cmpabs(fmpq_numref(x), largest) > 0 || fmpz_cmp(fmpq_denref(x), largest) > 0;
    } else {
        seen->fraction |= !count_fives_and_twos(fmpq_denref(x), &fives, &twos);
    }
}

/* Note which kinds of numbers (decimals, fractions) are among the arguments of a node, exponents left out. */
static void
note_argument_kinds(const qdot_pool *pool, qdot_expr e, struct numbers *seen)
{
    const qdot_node *node = NODE(pool, e);
    const uint32_t step = node->kind == QDOT_PROD ? 2 : 1;

    for (uint32_t i = 0; i < node->n; i += i == 0 ? 1 : step) {
        const qdot_expr k = ARGS(pool, e)[i];

        if (NODE(pool, k)->kind == QDOT_NUM)
            note_number_kind(RATIONAL(pool, k), seen);
    }
    for (uint32_t i = 1; i < node->n; i += 2) /* 2/5*pi: a part of pi is a fraction; c*pi + ... is the pair pi, c of a sum */
        if (ARGS(pool, e)[i] == QDOT_PI &&
            (node->kind == QDOT_PROD || (node->kind == QDOT_SUM && ARGS(pool, e)[i + 1] != QDOT_ONE)))
            seen->fraction = true;
}

qdot_status
qdot_print_wants_fractions(const qdot_pool *pool, qdot_expr e, bool *wants)
{
    struct numbers seen = {0};
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin(pool, e, &w));
    for (size_t i = 0; i < w.n; i++)
        if (NODE(pool, w.at[i])->kind != QDOT_NUM && NODE(pool, w.at[i])->kind != QDOT_SYM)
            note_argument_kinds(pool, w.at[i], &seen);
    qdot_walk_end(&w);
    *wants = seen.fraction && seen.decimal && !seen.long_decimal;
    return QDOT_OK;
}

bool
qdot_print_is_compact(const printer *p, const fmpq_t x)
{
    return fmpz_is_one(fmpq_denref(x)) || fraction_character(x) != NULL || qdot_print_says_decimal(p, x);
}

static void
append_small_integer(int64_t n, qdot_text *out)
{
    char digits[24], *at = digits + sizeof digits;
    uint64_t left = n < 0 ? -(uint64_t)n : (uint64_t)n;

    *--at = '\0';
    do
        *--at = (char)('0' + left % 10);
    while ((left /= 10) != 0);
    if (n < 0)
        *--at = '-';
    qdot_text_add(out, at);
}

static void
append_integer(const fmpz_t n, qdot_text *out)
{
    char few[64], *digits = few;

    if (!COEFF_IS_MPZ(*n)) {
        append_small_integer(*n, out);
        return;
    }
    if (fmpz_sizeinbase(n, 10) + 2 > sizeof few) {
        digits = qdot_malloc(fmpz_sizeinbase(n, 10) + 2);
        if (digits == NULL) {
            out->failed = true;
            return;
        }
    }
    fmpz_get_str(digits, 10, n);
    qdot_text_add(out, digits);
    if (digits != few)
        qdot_free(digits);
}

/* A number with more zeros after the point than this is written with a power of ten. */
enum { MOST_ZEROS = 3 };

/* Append the digits of |n| factor^times, that is, of a decimal number without its point. */
static void
append_numerator_digits(const fmpz_t n, const struct decimal *d, qdot_text *out)
{
    fmpz_t whole;

    if (!COEFF_IS_MPZ(*n)) {
        const uint64_t limit = UINT64_MAX / 5;
        uint64_t product = *n < 0 ? -(uint64_t)*n : (uint64_t)*n, k = 0;

        for (; k < d->times && product <= limit; k++)
            product *= d->factor;
        if (k == d->times) {
            qdot_text_format(out, "%" PRIu64, product);
            return;
        }
    }
    fmpz_init(whole);
    fmpz_set_ui(whole, (ulong)d->factor);
    fmpz_pow_ui(whole, whole, (ulong)d->times);
    fmpz_mul(whole, whole, n);
    fmpz_abs(whole, whole);
    append_integer(whole, out);
    fmpz_clear(whole);
}

/* Append the digits [n] with a decimal point, such as 9.81 or 0.05; small: only the mantissa 6.67 of 6.67e-11. */
static void
append_decimal(const char *digits, size_t n, uint64_t places, bool small, qdot_text *out)
{
    const size_t whole = small ? 1 : n > places ? n - places : 0;

    qdot_text_add_n(out, whole > 0 ? digits : "0", whole > 0 ? whole : 1);
    qdot_text_add(out, small && n == 1 ? "" : ".");
    for (size_t i = n; i < places && !small; i++)
        qdot_text_char(out, '0');
    qdot_text_add_n(out, digits + whole, n - whole);
}

/* Append the absolute value of x as a decimal number within a line of text, such as 9.81 or 6.67e-11. */
static void
append_decimal_in_line(const char *digits, size_t n, uint64_t places, bool small, qdot_text *out)
{
    append_decimal(digits, n, places, small, out);
    if (small)
        qdot_text_format(out, "e-%" PRIu64, places - n + 1);
}

/* Append a decimal number as a drawn formula: 6.67 10^-11. */
static void
print_drawn_decimal(printer *p, const char *digits, size_t n, uint64_t places, bool small)
{
    qdot_formula *f = p->out;
    size_t from = f->text.n;
    qdot_formula_id power, row;

    append_decimal(digits, n, places, small, &f->text);
    qdot_formula_add_tail(f, p->at, QDOT_TEXT_NUMBER, from);
    if (!small)
        return;
    print_sign(p, QDOT_SIGN_DOT);
    power = qdot_formula_add(f, p->at, QDOT_FORMULA_POWER, 0, 0);
    qdot_formula_add_text(f, power, QDOT_TEXT_NUMBER, "10", 2);
    row = qdot_formula_add(f, power, QDOT_FORMULA_ROW, 0, 0);
    qdot_formula_add_sign(f, row, QDOT_SIGN_NEGATIVE);
    from = f->text.n;
    qdot_text_format(&f->text, "%" PRIu64, places - n + 1);
    qdot_formula_add_tail(f, row, QDOT_TEXT_NUMBER, from);
}

/* Print x as a decimal number with its sign; `bracket` as for qdot_print_number. */
static void
print_decimal(printer *p, const fmpq_t x, const struct decimal *d, int bracket)
{
    const bool minus = qdot_rational_sgn(x) < 0;
    const qdot_formula_id outer = p->at;
    qdot_text digits = {0};
    bool small, product, wrap;

    append_numerator_digits(fmpq_numref(x), d, &digits);
    if (qdot_text_status(&digits) != QDOT_OK) {
        p->status = QDOT_ENOMEM;
        qdot_text_clear(&digits);
        return;
    }
    small = d->places > digits.n + MOST_ZEROS;
    product = small && is_drawn(p);
    wrap = (bracket > 0 && minus) || (bracket == 2 && product);
    if (wrap)
        print_begin(p, QDOT_FORMULA_BRACKET, QDOT_BRACKET_ROUND, QDOT_FORMULA_FIXED);
    else if (is_drawn(p) && (minus || product))
        print_begin(p, QDOT_FORMULA_ROW, 0, 0);
    if (minus)
        print_sign(p, QDOT_SIGN_NEGATIVE);
    if (is_drawn(p)) {
        print_drawn_decimal(p, digits.at, digits.n, d->places, small);
    } else {
        const size_t from = p->out->text.n;

        append_decimal_in_line(digits.at, digits.n, d->places, small, &p->out->text);
        qdot_formula_add_tail(p->out, p->at, QDOT_TEXT_NUMBER, from);
    }
    qdot_text_clear(&digits);
    p->at = outer;
}

/* Append the digits of |n| for an integer n. */
static void
print_absolute_integer(printer *p, const fmpz_t n)
{
    qdot_text *out = &p->out->text;
    const size_t from = out->n;

    append_integer(n, out);
    if (out->n > from && out->at[from] == '-') { /* drop the minus sign: print |n| */
        memmove(out->at + from, out->at + from + 1, out->n - from);
        out->n--;
    }
    qdot_formula_add_tail(p->out, p->at, QDOT_TEXT_NUMBER, from);
}

void
qdot_print_integer(printer *p, uint32_t n)
{
    const size_t from = p->out->text.n;

    append_small_integer(n, &p->out->text);
    qdot_formula_add_tail(p->out, p->at, QDOT_TEXT_NUMBER, from);
}

void
qdot_print_number(printer *p, const fmpq_t x, int bracket)
{
    const bool whole = fmpz_is_one(fmpq_denref(x)), minus = qdot_rational_sgn(x) < 0;
    const bool wrap = (bracket > 0 && minus) || (bracket == 2 && !whole);
    const char *sign = p->notation == QDOT_NOTATION_LINE && !whole ? fraction_character(x) : NULL;
    const qdot_formula_id outer = p->at;
    struct decimal d;

    if (!p->fractions && find_decimal_form(x, &d)) {
        print_decimal(p, x, &d, bracket);
        return;
    }
    if (wrap)
        print_begin(p, QDOT_FORMULA_BRACKET, QDOT_BRACKET_ROUND, QDOT_FORMULA_FIXED);
    else if (is_drawn(p) && minus)
        print_begin(p, QDOT_FORMULA_ROW, 0, 0);
    if (minus)
        print_sign(p, QDOT_SIGN_NEGATIVE);
    if (sign != NULL) {
        qdot_formula_add_text(p->out, p->at, QDOT_TEXT_NUMBER, sign, strlen(sign));
    } else {
        if (!whole)
            print_begin(p, QDOT_FORMULA_FRACTION, 0, 0);
        print_absolute_integer(p, fmpq_numref(x));
        if (!whole)
            print_absolute_integer(p, fmpq_denref(x));
    }
    p->at = outer;
}
