/* print-number.c -- numbers as text. */
#include <stdio.h>
#include <string.h>

#include <flint/flint.h>
#include <flint/fmpz.h>

#include "base/memory.h"
#include "expr/print-name.h"
#include "expr/rational.h"

static const char *const superscript[] = {"⁰", "¹", "²", "³", "⁴",
                                          "⁵", "⁶", "⁷", "⁸", "⁹"};

static void
raised_digits(const char *digits, size_t n, qdot_text *out)
{
    for (size_t i = 0; i < n; i++)
        qdot_text_add(out, superscript[digits[i] - '0']);
}

static const struct {
    int p, q;
    const char *glyph;
} fractions[] = {
    {1, 2, "½"}, {1, 3, "⅓"}, {2, 3, "⅔"}, {1, 4, "¼"}, {3, 4, "¾"},
    {1, 6, "⅙"}, {5, 6, "⅚"}, {1, 8, "⅛"}, {3, 8, "⅜"}, {5, 8, "⅝"}, {7, 8, "⅞"},
};

/* The sign for |x|, NULL if there is none. */
static const char *
glyph(const fmpq_t x)
{
    for (size_t i = 0; i < sizeof fractions / sizeof *fractions; i++)
        if (qdot_integer_is(fmpq_denref(x), fractions[i].q) &&
            (qdot_integer_is(fmpq_numref(x), fractions[i].p) ||
             qdot_integer_is(fmpq_numref(x), -fractions[i].p)))
            return fractions[i].glyph;
    return NULL;
}

/* |x| as a decimal number: its numerator times factor^times 10^-places. */
struct decimal {
    ulong factor, times, places;
};

/* The most digits of a decimal number that are longer than its fraction. */
enum { LONGEST_DECIMAL = 40 };

/* How often q holds 5 and 2, taken out of it. Small ones do not ask for FLINT, which is loaded late. */
static bool
fives_and_twos(const fmpz_t q, ulong *fives, ulong *twos)
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
    *fives = (ulong)fmpz_remove(rest, q, five);
    *twos = (ulong)fmpz_remove(rest, rest, two);
    all = fmpz_is_one(rest);
    fmpz_clear(rest);
    fmpz_clear(five);
    fmpz_clear(two);
    return all;
}

/* How many digits n has, or one more. */
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

/* Whether x = p/q is written so: q holds a factor 5 and beside it 2 alone. */
static bool
as_decimal(const fmpq_t x, struct decimal *d)
{
    ulong fives, twos;
    size_t more;

    if (!fives_and_twos(fmpq_denref(x), &fives, &twos) || fives == 0)
        return false;
    d->factor = twos > fives ? 5 : 2;
    d->times = twos > fives ? twos - fives : fives - twos;
    d->places = twos > fives ? twos : fives;
    more = twos > fives ? d->times * 7 / 10 : d->times * 31 / 100; /* digits by the factor */
    return count_digits(fmpq_numref(x)) + more <= LONGEST_DECIMAL ||
           more <= count_digits(fmpq_denref(x));
}

bool
qdot_print_is_decimal(const fmpq_t x)
{
    struct decimal d;

    return as_decimal(x, &d);
}

bool
qdot_print_is_compact(const fmpq_t x)
{
    return fmpz_is_one(fmpq_denref(x)) || glyph(x) != NULL || qdot_print_is_decimal(x);
}

void
qdot_print_order(uint32_t order, qdot_style style, bool bare, qdot_text *out)
{
    char digits[16];

    if (order == 1 && !bare)
        return;
    snprintf(digits, sizeof digits, "%u", order);
    if (style == QDOT_UNICODE)
        raised_digits(digits, strlen(digits), out);
    else
        qdot_text_format(out, bare ? "%s" : "^{%s}", digits);
}

static void
small_integer(int64_t n, qdot_text *out)
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
integer(const fmpz_t n, qdot_text *out)
{
    char few[64], *digits = few;

    if (!COEFF_IS_MPZ(*n)) {
        small_integer(*n, out);
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

/* Zeros behind the point before a power of ten is written. */
enum { MOST_ZEROS = 3 };

/* The digits of |n| factor^times. */
static void
decimal_digits(const fmpz_t n, const struct decimal *d, qdot_text *out)
{
    fmpz_t whole;

    if (!COEFF_IS_MPZ(*n)) {
        const ulong limit = UINT64_MAX / 5;
        ulong product = *n < 0 ? -(ulong)*n : (ulong)*n, k = 0;

        for (; k < d->times && product <= limit; k++)
            product *= d->factor;
        if (k == d->times) {
            qdot_text_format(out, "%lu", product);
            return;
        }
    }
    fmpz_init(whole);
    fmpz_set_ui(whole, d->factor);
    fmpz_pow_ui(whole, whole, d->times);
    fmpz_mul(whole, whole, n);
    fmpz_abs(whole, whole);
    integer(whole, out);
    fmpz_clear(whole);
}

/* 9.81, 0.05; below 1e-4 with a power of ten, 6.67e-11. *product: that is drawn as a product. */
static void
decimal_write(const fmpq_t x, const struct decimal *d, qdot_style style, qdot_text *out, bool *product)
{
    static const char *const power[][2] = {
        [QDOT_PLAIN] = {"e-", ""},
        [QDOT_UNICODE] = {"e-", ""},
        [QDOT_LATEX] = {" \\cdot 10^{-", "}"},
        [QDOT_MATHML] = {"</mn><mo>⋅</mo><msup><mn>10</mn><mrow><mo>−</mo><mn>",
                         "</mn></mrow></msup>"}};
    qdot_text digits = {0};
    size_t n;

    *product = false;
    decimal_digits(fmpq_numref(x), d, &digits);
    n = digits.n;
    if (qdot_text_status(&digits) != QDOT_OK) {
        out->failed = true;
        return;
    }
    qdot_text_add(out, style == QDOT_MATHML ? "<mn>" : "");
    if (d->places > n + MOST_ZEROS) {
        *product = style == QDOT_LATEX || style == QDOT_MATHML;
        qdot_text_char(out, digits.at[0]);
        qdot_text_add(out, n > 1 ? "." : "");
        qdot_text_add_n(out, digits.at + 1, n - 1);
        qdot_text_format(out, "%s%lu%s", power[style][0], d->places - n + 1, power[style][1]);
    } else {
        size_t whole = n > d->places ? n - d->places : 0;

        qdot_text_add_n(out, whole > 0 ? digits.at : "0", whole > 0 ? whole : 1);
        qdot_text_char(out, '.');
        for (size_t i = n; i < d->places; i++)
            qdot_text_char(out, '0');
        qdot_text_add_n(out, digits.at + whole, n - whole);
    }
    qdot_text_add(out, style == QDOT_MATHML && !*product ? "</mn>" : "");
    qdot_text_clear(&digits);
}

/* x as a decimal number, with its sign; bracket as of qdot_print_number. */
static void
print_decimal(const fmpq_t x, const struct decimal *d, qdot_style style, int bracket, qdot_text *out)
{
    bool minus = qdot_rational_sgn(x) < 0, product, wrap, mathml = style == QDOT_MATHML;
    qdot_text text = {0};

    decimal_write(x, d, style, &text, &product);
    wrap = (bracket > 0 && minus) || (bracket == 2 && product);
    if (wrap)
        qdot_text_add(out, mathml ? "<mrow><mo>(</mo>" : "(");
    else
        qdot_text_add(out, mathml && (minus || product) ? "<mrow>" : "");
    if (minus)
        qdot_text_add(out, mathml ? "<mo>−</mo>" : style == QDOT_UNICODE ? "−" : "-");
    qdot_text_add_n(out, qdot_text_str(&text), text.n);
    if (wrap)
        qdot_text_add(out, mathml ? "<mo>)</mo></mrow>" : ")");
    else
        qdot_text_add(out, mathml && (minus || product) ? "</mrow>" : "");
    out->failed = out->failed || text.failed;
    qdot_text_clear(&text);
}

/* <mn>3</mn>, <mfrac>...</mfrac>, its sign before it. */
static void
number_mathml(const fmpq_t x, int bracket, qdot_text *out)
{
    bool whole = fmpz_is_one(fmpq_denref(x)), minus = qdot_rational_sgn(x) < 0;
    bool wrap = (bracket > 0 && minus) || (bracket == 2 && !whole);
    fmpz_t top;

    qdot_text_add(out, wrap ? "<mrow><mo>(</mo>" : minus ? "<mrow>" : "");
    qdot_text_add(out, minus ? "<mo>−</mo>" : "");
    qdot_text_add(out, whole ? "<mn>" : "<mfrac><mn>");
    fmpz_init(top);
    fmpz_abs(top, fmpq_numref(x));
    integer(top, out);
    fmpz_clear(top);
    if (!whole) {
        qdot_text_add(out, "</mn><mn>");
        integer(fmpq_denref(x), out);
    }
    qdot_text_add(out, whole ? "</mn>" : "</mn></mfrac>");
    qdot_text_add(out, wrap ? "<mo>)</mo></mrow>" : minus ? "</mrow>" : "");
}

void
qdot_print_number(const fmpq_t x, qdot_style style, bool raised, int bracket,
                  qdot_text *out)
{
    bool whole = fmpz_is_one(fmpq_denref(x));
    bool wrap = (bracket > 0 && qdot_rational_sgn(x) < 0) || (bracket == 2 && !whole);
    struct decimal d;
    const bool minus = qdot_rational_sgn(x) < 0;
    qdot_text top = {0};

    if (raised) { /* an integer */
        qdot_text digits = {0};

        integer(fmpq_numref(x), &digits);
        raised_digits(qdot_text_str(&digits), digits.n, out);
        qdot_text_clear(&digits);
        return;
    }
    if (as_decimal(x, &d)) {
        print_decimal(x, &d, style, bracket, out);
        return;
    }
    if (style == QDOT_MATHML) {
        number_mathml(x, bracket, out);
        return;
    }
    if (wrap)
        qdot_text_char(out, '(');
    if (style == QDOT_UNICODE && !whole) {
        const char *sign = glyph(x);

        if (sign != NULL) {
            qdot_text_add(out, qdot_rational_sgn(x) < 0 ? "−" : "");
            qdot_text_add(out, sign);
            if (wrap)
                qdot_text_char(out, ')');
            return;
        }
    }
    if (minus)
        qdot_text_add(out, style == QDOT_UNICODE ? "−" : "-");
    qdot_text_add(out, style == QDOT_LATEX && !whole ? "\\frac{" : "");
    integer(fmpq_numref(x), &top);
    qdot_text_add(out, qdot_text_str(&top) + minus);
    out->failed = out->failed || top.failed;
    qdot_text_clear(&top);
    if (!whole) {
        qdot_text_add(out, style == QDOT_LATEX ? "}{" : "/");
        integer(fmpq_denref(x), out);
        if (style == QDOT_LATEX)
            qdot_text_char(out, '}');
    }
    if (wrap)
        qdot_text_char(out, ')');
}
