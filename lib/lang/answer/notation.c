/* notation.c -- formulas of books in words of answers, atom by atom. */
#include "lang/answer/notation.h"

#include <ctype.h>
#include <string.h>

typedef struct {
    const char *plain, *unicode, *latex, *mathml;
} spelling;

static const spelling words[] = {
    {"sum", "Σ", "\\sum", "<mo>∑</mo>"},
    {"lambda", "λ", "\\lambda ", "<mi>λ</mi>"},
    {"omega", "ω", "\\omega ", "<mi>ω</mi>"},
    {"delta", "δ", "\\delta ", "<mi>δ</mi>"},
    {"left", "left", "\\text{left}", "<mtext>left</mtext>"},
    {"right", "right", "\\text{right}", "<mtext>right</mtext>"},
    {"1/2", "½", "\\tfrac{1}{2}", "<mfrac><mn>1</mn><mn>2</mn></mfrac>"},
    {"0", "0", "0", "<mn>0</mn>"},
};

static const spelling signs[] = {
    {" = ", " = ", " = ", "<mo>=</mo>"},  {" + ", " + ", " + ", "<mo>+</mo>"},
    {" - ", " − ", " - ", "<mo>−</mo>"},  {"-", "−", "-", "<mo>−</mo>"},
    {".", "·", " \\cdot ", "<mo>·</mo>"}, {", ", ", ", ", ", "<mo>,</mo>"},
    {"(", "(", "(", "<mo>(</mo>"},        {")", ")", ")", "<mo>)</mo>"},
    {" ", " ", " ", "<mo>&#x2062;</mo>"}};

static const char *
in_style(const spelling *s, qdot_style style)
{
    return style == QDOT_LATEX ? s->latex : style == QDOT_MATHML ? s->mathml : s->unicode;
}

static const spelling *
spelling_find(const spelling *table, size_t count, const char *at)
{
    for (size_t i = 0; i < count; i++)
        if (strncmp(at, table[i].plain, strlen(table[i].plain)) == 0)
            return &table[i];
    return NULL;
}

/* A letter with dots above, or a word of the table; returns what follows. */
static const char *
add_base(const char *at, qdot_style style, qdot_text *out)
{
    static const char *const dots[][3] = {{"\u0307", "\\dot{", "˙"},
                                          {"\u0308", "\\ddot{", "¨"}};
    const spelling *word = spelling_find(words, sizeof words / sizeof *words, at);
    const char letter = *at;
    size_t primes;

    if (word) {
        qdot_text_add(out, in_style(word, style));
        return at + strlen(word->plain);
    }
    primes = strspn(++at, "'");
    if (primes == 0 || primes > 2) {
        qdot_text_format(out, style == QDOT_MATHML ? "<mi>%c</mi>" : "%c", letter);
    } else if (style == QDOT_MATHML) {
        qdot_text_format(out, "<mover><mi>%c</mi><mo>%s</mo></mover>", letter,
                         dots[primes - 1][2]);
    } else if (style == QDOT_LATEX) {
        qdot_text_format(out, "%s%c}", dots[primes - 1][1], letter);
    } else {
        qdot_text_format(out, "%c%s", letter, dots[primes - 1][0]);
    }
    return at + primes;
}

/* A base and its square. */
static const char *
add_atom(const char *at, qdot_style style, qdot_text *out)
{
    const size_t from = out->n;
    qdot_text base = {0};

    at = add_base(at, style, &base);
    if (strncmp(at, "^2", 2) != 0) {
        qdot_text_add(out, qdot_text_str(&base));
    } else {
        qdot_text_format(out,
                         style == QDOT_MATHML  ? "<msup>%s<mn>2</mn></msup>"
                         : style == QDOT_LATEX ? "%s^{2}"
                                               : "%s²",
                         qdot_text_str(&base));
        at += 2;
    }
    out->failed = out->failed || base.failed || out->n < from;
    qdot_text_clear(&base);
    return at;
}

void
qdot_notation_over(const char *up, const char *down, qdot_style style, qdot_text *out)
{
    qdot_text_format(out,
                     style == QDOT_MATHML
                         ? "<mfrac><mrow>%s</mrow><mrow>%s</mrow></mfrac>"
                     : style == QDOT_LATEX ? "\\frac{%s}{%s}"
                                           : "%s/%s",
                     up, down);
}

/* d/dt, dV/dq, dT/dq': partial but for the first. */
static const char *
add_slope(const char *at, qdot_style style, qdot_text *out)
{
    const bool whole = at[1] == '/';
    const char *const d = style == QDOT_MATHML  ? whole ? "<mi>d</mi>" : "<mo>∂</mo>"
                          : style == QDOT_LATEX ? whole ? "d" : "\\partial "
                          : whole               ? "d"
                                                : "∂";
    qdot_text up = {0}, down = {0};

    qdot_text_add(&up, d);
    if (!whole)
        (void)add_base(at + 1, style, &up);
    qdot_text_add(&down, d);
    at = add_base(at + (whole ? 3 : 4), style, &down);
    qdot_notation_over(qdot_text_str(&up), qdot_text_str(&down), style, out);
    out->failed = out->failed || up.failed || down.failed;
    qdot_text_clear(&up);
    qdot_text_clear(&down);
    return at;
}

/* Whether `dX/dY` or `d/dt` stands there. */
static bool
is_slope(const char *at)
{
    return at[0] == 'd' &&
           (strncmp(at + 1, "/d", 2) == 0 ||
            (isalpha((unsigned char)at[1]) && strncmp(at + 2, "/d", 2) == 0));
}

void
qdot_notation(const char *formula, qdot_style style, qdot_text *out)
{
    if (style == QDOT_PLAIN) {
        qdot_text_add(out, formula);
        return;
    }
    while (*formula != '\0') {
        const spelling *sign = spelling_find(signs, sizeof signs / sizeof *signs, formula);

        if (sign) {
            qdot_text_add(out, in_style(sign, style));
            formula += strlen(sign->plain);
        } else if (is_slope(formula)) {
            formula = add_slope(formula, style, out);
        } else {
            formula = add_atom(formula, style, out);
        }
    }
}
