/* figure-label.c -- labels of a figure: literal texts, formulas in gnuplot's markup. */
#include <ctype.h>
#include <string.h>

#include "base/utf8.h"
#include "expr/print-name.h"
#include "show/figure-parts.h"

/* Whether gnuplot takes the text in single quotes literally. */
static bool
is_simple(const char *text)
{
    for (const char *c = text; *c != '\0';) {
        size_t n = qdot_utf8_length(c);

        if (n == 0 || *c == '\'' || (unsigned char)*c < 0x20 || *c == 0x7f)
            return false;
        c += n;
    }
    return true;
}

/* Single quotes where they will do. Between double quotes gnuplot reads \042 as the character of that octal code, so
 * every character that could mean something to it (quotes, backslash, backquote ...)
 * is written so; digits too, which it would take into the code before them. A line
 * break would end the command: it becomes a blank, as other control characters do. */
void
qdot_figure_add_quoted(qdot_text *script, const char *text)
{
    text = text != NULL ? text : "";
    if (is_simple(text)) {
        qdot_text_format(script, "'%s'", text);
        return;
    }
    qdot_text_char(script, '"');
    for (const char *c = text; *c != '\0';) {
        size_t n = qdot_utf8_length(c);

        if (n == 0)
            qdot_text_add(script, "\xEF\xBF\xBD");
        else if (n > 1 || isalpha((unsigned char)*c))
            qdot_text_add_n(script, c, n);
        else if ((unsigned char)*c < 0x20 || *c == 0x7f)
            qdot_text_char(script, ' ');
        else
            qdot_text_format(script, "\\%03o", (unsigned char)*c);
        c += n > 0 ? n : 1;
    }
    qdot_text_char(script, '"');
}

/* --- formulas in gnuplot's markup --------------------------------------------------- */

static bool
label_is_letter(const char *c)
{
    return isalpha((unsigned char)*c) || (unsigned char)*c >= 0x80;
}

static bool
continues_name(const char *c)
{
    return label_is_letter(c) || isdigit((unsigned char)*c) || *c == '_';
}

/* The bracket that closes the bracket at `open`; NULL if it is not closed. */
static const char *
closing_bracket(const char *open)
{
    int depth = 0;

    for (const char *c = open; *c != '\0'; c++) {
        depth += (*c == '(' || *c == '[') - (*c == ')' || *c == ']');
        if (depth == 0)
            return c;
    }
    return NULL;
}

/* Append the exponent after `^`; returns its end. */
static const char *
label_add_power(qdot_text *out, const char *c, bool markup)
{
    const char *end = c;

    if (*c == '(' && closing_bracket(c) != NULL)
        end = closing_bracket(c) + 1;
    else if (isdigit((unsigned char)*c))
        while (isdigit((unsigned char)*end))
            end++;
    else if (label_is_letter(c))
        while (continues_name(end))
            end++;
    qdot_text inner = {0};

    qdot_text_add_n(&inner, c + (*c == '('), (size_t)(end - c) - (*c == '(' ? 2 : 0));
    if (!markup || inner.n == 0 || strchr(inner.at, '^') != NULL) { /* no towers */
        qdot_text_add(out, markup ? "\\^" : "^");
        qdot_text_clear(&inner);
        return c;
    }
    qdot_text_add(out, "^{");
    qdot_figure_add_formula(out, qdot_text_str(&inner), markup);
    qdot_text_char(out, '}');
    out->failed = out->failed || inner.failed;
    qdot_text_clear(&inner);
    return end;
}

/* name in unicode style, its `[...]` and `_...` as subscripts where there is markup; letters: whether
 * its first letter stands here, which is no subscript. *after: a power there, digits, is set above the
 * index, and it moves on. */
static void
add_subscripted(qdot_text *out, const char *text, bool letters, const char **after, bool markup)
{
    const char *below = strpbrk(text + (letters && text[0] != '\0'), "_[");
    const bool raised = **after == '^' && isdigit((unsigned char)(*after)[1]);
    size_t n;

    if (!markup || below == NULL) {
        qdot_text_add(out, text);
        return;
    }
    qdot_text_add_n(out, text, (size_t)(below - text));
    if (raised) { /* above the index, which takes the room */
        qdot_text_char(out, '@');
        *after = label_add_power(out, *after + 1, markup);
    }
    /* use another size: gnuplot's SVG omits the size if it equals that of the exponent */
    qdot_text_add(out, raised ? "_{/*0.97 " : "_{");
    n = strlen(++below);
    for (size_t i = 0; i < n; i++)
        if (below[i] == '[' || below[i] == '_')
            qdot_text_char(out, ',');
        else if (below[i] != ']')
            qdot_text_char(out, below[i]);
    qdot_text_char(out, '}');
}

/* The name at `c` with its index and primes; where it ends. One or two primes stand as dots over
 * a single letter. */
static const char *
label_add_name(qdot_text *out, const char *c, bool markup)
{
    qdot_text name = {0}, shown = {0}, letters = {0};
    const char *start = c, *none = "";
    size_t primes = 0, first;

    while (continues_name(c))
        c++;
    qdot_text_add_n(&name, start, (size_t)(c - start));
    if (*c == '[' && closing_bracket(c) != NULL) {
        const char *end = closing_bracket(c) + 1;

        qdot_text_add_n(&name, c, (size_t)(end - c));
        c = end;
    }
    for (; *c == '\''; c++)
        primes++;
    qdot_print_name(NULL, qdot_text_str(&name), QDOT_UNICODE, &shown);
    /* find the end of the letters, before digits, `_` and brackets */
    for (first = 0; qdot_text_str(&name)[first] != '\0' && label_is_letter(name.at + first); first++)
        ;
    qdot_text_add_n(&letters, qdot_text_str(&name), first);
    qdot_text_truncate(&name, 0);
    if (first > 0)
        qdot_print_name(NULL, qdot_text_str(&letters), QDOT_UNICODE, &name);
    if (primes > 0 && primes < 3 && qdot_utf8_columns(qdot_text_str(&name), name.n) == 1) {
        qdot_text_add(out, qdot_text_str(&name));
        qdot_text_add(out, primes == 1 ? "\u0307" : "\u0308");
        add_subscripted(out, qdot_text_str(&shown) + name.n, false, &c, markup);
    } else {
        add_subscripted(out, qdot_text_str(&shown), true, primes > 0 ? &none : &c, markup);
        for (; primes > 0; primes--)
            qdot_text_add(out, "′");
    }
    out->failed = out->failed || name.failed || shown.failed || letters.failed;
    qdot_text_clear(&name);
    qdot_text_clear(&shown);
    qdot_text_clear(&letters);
    return c;
}

/* Append a number, 1e-9 as 10^-9; returns its end. */
static const char *
label_add_number(qdot_text *out, const char *c, bool markup)
{
    const char *start = c, *end;

    while (isdigit((unsigned char)*c) || *c == '.')
        c++;
    end = c + (*c == 'e' || *c == 'E');
    end += end > c && (*end == '-' || *end == '+');
    if (end == c || !isdigit((unsigned char)*end) || !markup) {
        qdot_text_add_n(out, start, (size_t)(c - start));
        return c;
    }
    if (c - start != 1 || *start != '1') {
        qdot_text_add_n(out, start, (size_t)(c - start));
        qdot_text_add(out, "·");
    }
    qdot_text_add(out, end[-1] == '-' ? "10^{−" : "10^{");
    for (; isdigit((unsigned char)*end); end++)
        qdot_text_char(out, *end);
    qdot_text_char(out, '}');
    return end;
}

/* Append a blank; after an index a zero-width space comes first, as readers of SVG drop a blank there. */
static void
add_blank(qdot_text *out, bool markup)
{
    const bool lowered = markup && out->n > 0 && out->at[out->n - 1] == '}';

    qdot_text_add(out, lowered ? "\u200b " : " ");
}

void
qdot_figure_add_formula(qdot_text *out, const char *formula, bool markup)
{
    for (const char *c = formula; *c != '\0';) {
        if (label_is_letter(c)) {
            c = label_add_name(out, c, markup);
            continue;
        }
        if (isdigit((unsigned char)*c)) {
            c = label_add_number(out, c, markup);
            continue;
        }
        if (*c == '^') {
            c = label_add_power(out, c + 1, markup);
            continue;
        }
        if (*c == '*')
            qdot_text_add(out, "·");
        else if (*c == ' ')
            add_blank(out, markup);
        else if (*c == '-')
            qdot_text_add(out, "−");
        else if (*c == '\'')
            qdot_text_add(out, "′");
        else if (markup && strchr("_{}@&~\\", *c) != NULL)
            qdot_text_format(out, "\\%c", *c);
        else
            qdot_text_char(out, *c);
        c++;
    }
}

/* --- writing labels ----------------------------------------------------------------- */

void
qdot_figure_add_markup(qdot_text *out, const qdot_figure_label *label)
{
    if (label->text != NULL && label->formula) {
        qdot_figure_add_formula(out, label->text, true);
        return;
    }
    for (const char *c = label->text != NULL ? label->text : ""; *c != '\0'; c++) {
        if (strchr("^_{}@&~\\", *c) != NULL)
            qdot_text_char(out, '\\');
        qdot_text_char(out, *c);
    }
}

qdot_figure_label
qdot_figure_curve_label(const qdot_panel *panel, size_t k)
{
    return k < panel->n_legend ? (qdot_figure_label){panel->legend[k], false} : panel->curves[k].label;
}

void
qdot_figure_add_label(qdot_text *script, const qdot_figure_label *label)
{
    qdot_text markup = {0};

    if (label->formula)
        qdot_figure_add_markup(&markup, label);
    else if (label->text != NULL)
        qdot_text_add(&markup, label->text);
    qdot_figure_add_quoted(script, qdot_text_str(&markup));
    qdot_text_add(script, label->formula ? " enhanced" : " noenhanced");
    script->failed = script->failed || markup.failed;
    qdot_text_clear(&markup);
}

size_t
qdot_figure_label_width(const qdot_figure_label *label)
{
    return label->text != NULL ? qdot_utf8_columns(label->text, strlen(label->text)) : 0;
}
