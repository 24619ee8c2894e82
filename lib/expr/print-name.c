/* print-name.c -- symbols as text. */
#include "expr/print-name.h"

#include <stdio.h>
#include <string.h>

#include "base/memory.h"

static const struct {
    const char *spelled, *letter;
} greek[] = {
    {"alpha", "α"},  {"beta", "β"},   {"gamma", "γ"}, {"delta", "δ"},   {"epsilon", "ε"},
    {"zeta", "ζ"},   {"eta", "η"},    {"theta", "θ"}, {"iota", "ι"},    {"kappa", "κ"},
    {"lambda", "λ"}, {"mu", "μ"},     {"nu", "ν"},    {"xi", "ξ"},      {"pi", "π"},
    {"rho", "ρ"},    {"sigma", "σ"},  {"tau", "τ"},   {"upsilon", "υ"}, {"phi", "φ"},
    {"chi", "χ"},    {"psi", "ψ"},    {"omega", "ω"}, {"Gamma", "Γ"},   {"Delta", "Δ"},
    {"Upsilon", "Υ"},
    {"Theta", "Θ"},  {"Lambda", "Λ"}, {"Xi", "Ξ"},    {"Pi", "Π"},      {"Sigma", "Σ"},
    {"Phi", "Φ"},    {"Psi", "Ψ"},    {"Omega", "Ω"},
};

static const char *const subscript[] = {"₀", "₁", "₂", "₃", "₄", "₅", "₆", "₇", "₈", "₉"};

static bool
is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* A name in its parts: letters, the digits behind them, what stands behind `_`, an index in
 * brackets: theta1, omega_0, V_eff, A[1,2]. */
struct parts {
    const char *letter; /* a Greek one, or NULL */
    bool greek;         /* all of it Greek letters, one or more: theta, deltatheta */
    size_t letters, digits_at, digits, below_at, below, index_at, index;
};

/* The row of the Greek letter that `at` begins with and behind which Greek letters, or nothing,
 * stand; -1: there is none. Names are short. */
static int
next_greek(const char *at, size_t length)
{
    enum { LONGEST = 64 };
    bool ends[LONGEST + 1] = {[0] = true}; /* of the last k letters: all Greek */

    if (length == 0 || length > LONGEST)
        return -1;
    for (size_t k = 1; k <= length; k++)
        for (size_t i = 0; i < sizeof greek / sizeof *greek; i++) {
            size_t n = strlen(greek[i].spelled);

            if (n > k || !ends[k - n] ||
                strncmp(at + length - k, greek[i].spelled, n) != 0)
                continue;
            if (k == length)
                return (int)i;
            ends[k] = true;
        }
    return -1;
}

static bool
is_greek(const char *at, size_t length)
{
    return next_greek(at, length) >= 0;
}

/* The letters of a name that is Greek throughout. */
static void
greek_letters(const char *at, size_t length, qdot_style style, qdot_text *out)
{
    for (bool first = true; length > 0; first = false) {
        int i = next_greek(at, length);
        size_t n = strlen(greek[i].spelled);

        if (style == QDOT_LATEX)
            qdot_text_format(out, "%s\\%s", first ? "" : " ", greek[i].spelled);
        else
            qdot_text_add(out, greek[i].letter);
        at += n;
        length -= n;
    }
}

static struct parts
name_split(const char *name)
{
    struct parts p = {0};
    size_t n = strcspn(name, "["), head = strcspn(name, "_");

    if (head == 0 || head + 1 >= n)
        head = n;
    p.letters = head;
    while (p.letters > 1 && is_digit(name[p.letters - 1]))
        p.letters--;
    p.digits_at = p.letters;
    p.digits = head - p.letters;
    if (head < n) {
        p.below_at = head + 1;
        p.below = n - head - 1;
    }
    if (name[n] == '[') {
        p.index_at = n + 1;
        p.index = strlen(name) - n - 2;
    }
    for (size_t i = 0; i < sizeof greek / sizeof *greek; i++)
        if (strlen(greek[i].spelled) == p.letters &&
            strncmp(greek[i].spelled, name, p.letters) == 0)
            p.letter = greek[i].letter;
    p.greek = p.letter != NULL || is_greek(name, p.letters);
    return p;
}

static bool
all_digits(const char *text, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (!is_digit(text[i]))
            return false;
    return n > 0;
}

static void
print_lowered(const char *digits, size_t n, qdot_text *out)
{
    for (size_t i = 0; i < n; i++)
        qdot_text_add(out, subscript[digits[i] - '0']);
}

static void parts_of(const char *at, size_t length, char between, qdot_style style,
                     qdot_text *out);

/* What stands in the brackets of a name, part by part. */
static void
print_index(const char *name, qdot_style style, qdot_text *out)
{
    struct parts p = name_split(name);

    parts_of(name + p.index_at, p.index, ',', style, out);
}

static bool
name_is_known(const qdot_pool *pool, const char *name, size_t letters, const char *pattern,
              const char *digits, size_t n_digits)
{
    qdot_text other = {0};
    bool is;

    qdot_text_add_n(&other, name, letters);
    qdot_text_format(&other, pattern, (int)n_digits, digits);
    is = qdot_text_status(&other) != QDOT_OK ||
         qdot_symbol_is_known(pool, qdot_text_str(&other));
    qdot_text_clear(&other);
    return is;
}

/* Whether x[1], x_1 may stand as x₁, which is else x1, else x[1]: no name that comes before is
 * there. */
static bool
index_is_lowered(const qdot_pool *pool, const char *name, const struct parts *p)
{
    bool index = p->index > 0;
    const char *digits = name + (index ? p->index_at : p->below_at);
    size_t n = index ? p->index : p->below;

    if (p->digits > 0 || (index && p->below > 0) || !all_digits(digits, n))
        return false;
    return pool == NULL ||
           (!name_is_known(pool, name, p->letters, "%.*s", digits, n) &&
            (index || !name_is_known(pool, name, p->letters, "[%.*s]", digits, n)));
}

/* θ̇₁: what the language reads as the name and its primes. */
static void
name_unicode(const qdot_pool *pool, const char *name, uint32_t order, qdot_text *out)
{
    struct parts p = name_split(name);
    bool lowered = index_is_lowered(pool, name, &p);
    bool one = (p.letter != NULL || p.letters == 1) && (p.index == 0 || lowered);

    if (p.greek)
        greek_letters(name, p.letters, QDOT_UNICODE, out);
    else
        qdot_text_add_n(out, name, p.letters);
    if (one && (order == 1 || order == 2))
        qdot_text_add(out, order == 1 ? "\u0307" : "\u0308");
    print_lowered(name + p.digits_at, p.digits, out);
    if (lowered) {
        print_lowered(name + (p.index > 0 ? p.index_at : p.below_at),
                      p.index > 0 ? p.index : p.below, out);
    } else if (p.below > 0) {
        qdot_text_char(out, '_');
        parts_of(name + p.below_at, p.below, '_', QDOT_UNICODE, out);
    }
    if (!lowered && p.index > 0) {
        qdot_text_char(out, '[');
        parts_of(name + p.index_at, p.index, ',', QDOT_UNICODE, out);
        qdot_text_char(out, ']');
    }
    if (!one || order > 2)
        for (uint32_t i = 0; i < order; i++)
            qdot_text_add(out, "′");
}

static void
name_latex(const char *name, uint32_t order, qdot_text *out)
{
    static const char *const dots[] = {"", "\\dot{", "\\ddot{", "\\dddot{", "\\ddddot{"};
    struct parts p = name_split(name);

    qdot_text_add(out, dots[order > 4 ? 0 : order]);
    if (p.greek) {
        greek_letters(name, p.letters, QDOT_LATEX, out);
    } else if (p.letters == 1) {
        qdot_text_add_n(out, name, p.letters);
    } else {
        qdot_text_add(out, "\\mathrm{");
        for (size_t i = 0; i < p.letters; i++) {
            if (name[i] == '_')
                qdot_text_char(out, '\\');
            qdot_text_char(out, name[i]);
        }
        qdot_text_char(out, '}');
    }
    if (order > 0 && order <= 4)
        qdot_text_char(out, '}');
    if (p.digits + p.below + p.index > 0) {
        qdot_text_add(out, "_{");
        qdot_text_add_n(out, name + p.digits_at, p.digits);
        if (p.digits > 0 && p.below > 0)
            qdot_text_char(out, ',');
        parts_of(name + p.below_at, p.below, '_', QDOT_LATEX, out);
        if (p.digits + p.below > 0 && p.index > 0)
            qdot_text_char(out, ',');
        if (p.index > 0)
            print_index(name, QDOT_LATEX, out);
        qdot_text_char(out, '}');
    }
    if (order > 4)
        qdot_text_format(out, "^{(%u)}", order);
}

/* θ̈₁ as <msub><mover><mi>θ</mi><mo>¨</mo></mover><mn>1</mn></msub>. */
static void
name_mathml(const char *name, uint32_t order, qdot_text *out)
{
    struct parts p = name_split(name);
    bool below = p.digits + p.below + p.index > 0;

    if (below)
        qdot_text_add(out, "<msub>");
    if (order > 0)
        qdot_text_add(out, order < 4 ? "<mover>" : "<msup>");
    qdot_text_add(out, "<mi>");
    if (p.greek)
        greek_letters(name, p.letters, QDOT_MATHML, out);
    else
        qdot_text_add_n(out, name, p.letters);
    qdot_text_add(out, "</mi>");
    if (order > 0 && order < 4)
        qdot_text_format(out, "<mo>%s</mo></mover>",
                         order == 1   ? "˙"
                         : order == 2 ? "¨"
                                      : "⃛");
    else if (order > 0)
        qdot_text_format(out, "<mrow><mo>(</mo><mn>%u</mn><mo>)</mo></mrow></msup>",
                         order);
    if (!below)
        return;
    qdot_text_add(out, "<mrow>");
    if (p.digits > 0) {
        qdot_text_add(out, "<mn>");
        qdot_text_add_n(out, name + p.digits_at, p.digits);
        qdot_text_add(out, p.below + p.index > 0 ? "</mn><mo>,</mo>" : "</mn>");
    }
    parts_of(name + p.below_at, p.below, '_', QDOT_MATHML, out);
    qdot_text_add(out, p.below > 0 && p.index > 0 ? "<mo>,</mo>" : "");
    if (p.index > 0)
        print_index(name, QDOT_MATHML, out);
    qdot_text_add(out, "</mrow></msub>");
}

void
qdot_print_name(const qdot_pool *pool, const char *name, qdot_style style, qdot_text *out)
{
    switch (style) {
    case QDOT_PLAIN: qdot_text_add(out, name); break;
    case QDOT_UNICODE: name_unicode(pool, name, 0, out); break;
    case QDOT_LATEX: name_latex(name, 0, out); break;
    case QDOT_MATHML: name_mathml(name, 0, out); break;
    }
}

/* Names and numbers apart by a sign, in a subscript apart by commas; in a line by that sign. */
static void
parts_of(const char *at, size_t length, char between, qdot_style style, qdot_text *out)
{
    const char *apart = style == QDOT_MATHML                       ? "<mo>,</mo>"
                        : style == QDOT_UNICODE && between == '_' ? "_"
                                                                  : ",";

    for (size_t i = 0; i < length;) {
        size_t n = i;
        char *part;

        while (n < length && at[n] != between)
            n++;
        n -= i;
        part = qdot_strndup(at + i + (at[i] == ' '), n - (at[i] == ' '));
        if (part == NULL) {
            out->failed = true;
            return;
        }
        qdot_text_add(out, i > 0 ? apart : "");
        if (all_digits(part, strlen(part)))
            qdot_text_format(out, style == QDOT_MATHML ? "<mn>%s</mn>" : "%s", part);
        else if (style == QDOT_UNICODE && strchr(part, '[') != NULL)
            qdot_text_add(out, part); /* a member's brackets stay */
        else
            qdot_print_name(NULL, part, style, out);
        qdot_free(part);
        i += n + 1;
    }
}

static void
escape(const char *text, qdot_text *out)
{
    qdot_text_add(out, "<mtext>");
    for (; *text != '\0'; text++)
        if (*text == '&' || *text == '<')
            qdot_text_add(out, *text == '&' ? "&amp;" : "&lt;");
        else
            qdot_text_char(out, *text);
    qdot_text_add(out, "</mtext>");
}

/* What stands before and behind the name of the coordinate in a symbol about it. */
static const struct {
    const char *before[4], *behind[4]; /* by style */
} about[] = {
    [QDOT_MOMENTUM] = {{"p[", "p[", "p_{", "<msub><mi>p</mi>"},
                       {"]", "]", "}", "</msub>"}},
    [QDOT_DIFFERENTIAL] = {{"d", "d", "d", "<mrow><mi>d</mi>"}, {"", "", "", "</mrow>"}},
    [QDOT_DELTA] = {{"delta[", "δ", "\\delta ", "<mrow><mi>δ</mi>"},
                    {"]", "", "", "</mrow>"}},
};

/* By style: what opens and closes brackets around a number; what stands between its digits and its power of ten (NULL: it
 * is written 1.5e-9), behind that power, and behind digits without one. */
static const struct {
    const char *open, *times, *raised, *alone, *close;
} number_words[] = {
    {"(", NULL, "", "", ")"},
    {"(", NULL, "", "", ")"},
    {"(", " \\cdot 10^{", "}", "", ")"},
    {"<mrow><mo>(</mo><mn>", "</mn><mo>·</mo><msup><mn>10</mn><mn>", "</mn></msup>", "</mn>", "<mo>)</mo></mrow>"},
};

/* Where the digits end in the name of a symbol that stands for a number; NULL: it stands for none. */
static const char *
number_end(const qdot_symbol *s)
{
    return s->class == QDOT_FORMAL ? strchr(s->name, '#') : NULL;
}

bool
qdot_symbol_is_number(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_kind(pool, e) == QDOT_SYM && number_end(qdot_expr_symbol(pool, e)) != NULL;
}

/* A symbol that stands for a number, such as `-1.5e-9#3`: what stands before the #, in brackets where it has a sign or
 * would stand beside another number without a sign between. */
static void
number_name(const char *name, size_t length, qdot_style style, qdot_text *out)
{
    const bool brackets = style != QDOT_PLAIN || *name == '-';
    const char *power = number_words[style].times != NULL ? memchr(name, 'e', length) : NULL;

    qdot_text_add(out, brackets ? number_words[style].open : "");
    qdot_text_add_n(out, name, power != NULL ? (size_t)(power - name) : length);
    if (power != NULL) {
        qdot_text_add(out, number_words[style].times);
        power += power[1] == '+' ? 2 : 1;
        qdot_text_add_n(out, power, length - (size_t)(power - name));
    }
    qdot_text_add(out, power != NULL ? number_words[style].raised : number_words[style].alone);
    qdot_text_add(out, brackets ? number_words[style].close : "");
}

void
qdot_print_symbol(const qdot_pool *pool, qdot_expr e, qdot_style style, qdot_text *out)
{
    const qdot_symbol *s = qdot_expr_symbol(pool, e);
    const char *mark = number_end(s);
    const char *name =
        s->base != QDOT_NIL ? qdot_expr_symbol(pool, s->base)->name : s->name;
    bool of_coordinate = s->class == QDOT_MOMENTUM || s->class == QDOT_DIFFERENTIAL ||
                         s->class == QDOT_DELTA;

    if (s->class == QDOT_WORDS && style == QDOT_MATHML) {
        escape(s->name, out);
        return;
    }
    if (mark != NULL) {
        number_name(s->name, (size_t)(mark - s->name), style, out);
        return;
    }
    if (style == QDOT_PLAIN || s->class == QDOT_WORDS) {
        qdot_text_add(out, s->name);
        return;
    }
    if (of_coordinate)
        qdot_text_add(out, about[s->class].before[style]);
    switch (style) {
    case QDOT_UNICODE: name_unicode(pool, name, s->order, out); break;
    case QDOT_LATEX: name_latex(name, s->order, out); break;
    default: name_mathml(name, s->order, out); break;
    }
    if (of_coordinate)
        qdot_text_add(out, about[s->class].behind[style]);
}

const char *
qdot_print_latex_word(qdot_fun_id id)
{
    static const char *const words[QDOT_FUNCTION_KINDS] = {
        [QDOT_SIN] = "\\sin",     [QDOT_COS] = "\\cos",     [QDOT_TAN] = "\\tan",
        [QDOT_SEC] = "\\sec",     [QDOT_CSC] = "\\csc",     [QDOT_COT] = "\\cot",
        [QDOT_ASIN] = "\\arcsin", [QDOT_ACOS] = "\\arccos", [QDOT_ATAN] = "\\arctan",
        [QDOT_SINH] = "\\sinh",   [QDOT_COSH] = "\\cosh",   [QDOT_TANH] = "\\tanh",
        [QDOT_EXP] = "\\exp",     [QDOT_LOG] = "\\log",     [QDOT_MIN] = "\\min",
        [QDOT_MAX] = "\\max",
    };

    return words[id];
}
