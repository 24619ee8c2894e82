/* figure-label.c -- labels of a figure: literal texts, and formulas as they were typed, in gnuplot's markup. */
#include <ctype.h>
#include <string.h>

#include "base/utf8.h"
#include "formula/name.h"
#include "formula/read.h"
#include "formula/write.h"
#include "show/figure-parts.h"

/* Whether gnuplot takes the text in single quotes literally. */
static bool
is_quotable_text(const char *text)
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
    if (is_quotable_text(text)) {
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

/* --- formulas ------------------------------------------------------------------------- */

typedef enum { IN_LINE, IN_GNUPLOT, IN_LATEX } language;

static qdot_status
add_formula_in_language(qdot_text *out, const qdot_formula *f, qdot_formula_id id, language to)
{
    switch (to) {
    case IN_LINE: return qdot_formula_write_line(f, id, QDOT_NOTATION_LINE, out);
    case IN_GNUPLOT: return qdot_formula_write_gnuplot(f, id, out);
    default: return qdot_formula_write_latex(f, id, out);
    }
}

/* Append a text: if it is a formula, typeset, otherwise letter by letter. */
static void
add_typed_text(qdot_text *out, const char *typed, bool formula, language to)
{
    qdot_formula f = {0};
    const qdot_formula_id all = qdot_formula_new(&f, QDOT_FORMULA_SPAN, 0, 0);
    qdot_status status;

    if (formula)
        qdot_formula_read(&f, all, typed, to == IN_LINE ? QDOT_NOTATION_LINE : QDOT_NOTATION_DRAWN);
    else
        qdot_formula_add_text(&f, all, QDOT_TEXT_LABEL, typed, strlen(typed));
    status = qdot_formula_status(&f);
    if (status == QDOT_OK)
        status = add_formula_in_language(out, &f, all, to);
    out->failed = out->failed || status != QDOT_OK;
    qdot_formula_clear(&f);
}

void
qdot_figure_add_line(qdot_text *out, const char *formula)
{
    add_typed_text(out, formula, true, IN_LINE);
}

/* --- writing labels ----------------------------------------------------------------- */

void
qdot_figure_add_markup(qdot_text *out, const qdot_figure_label *label)
{
    add_typed_text(out, label->text != NULL ? label->text : "", label->formula, IN_GNUPLOT);
}

/* Append a unit in brackets; each exponent between `open` and `close`. */
static void
add_unit(qdot_text *out, const char *unit, const char *open, const char *close)
{
    if (unit == NULL || *unit == '\0')
        return;
    qdot_text_add(out, " [");
    while (*unit != '\0') {
        const bool bracket = unit[0] == '^' && unit[1] == '(';
        const size_t n = bracket ? strcspn(unit + 2, ")") : strspn(unit + 1, "-0123456789");

        if (*unit != '^') {
            qdot_text_char(out, (unsigned char)*unit++);
            continue;
        }
        unit += bracket ? 2 : 1;
        qdot_text_format(out, "%s%.*s%s", open, (int)n, unit, close);
        unit += n + (bracket && unit[n] == ')');
    }
    qdot_text_add(out, "]");
}

void
qdot_figure_add_unit_markup(qdot_text *out, const char *unit)
{
    add_unit(out, unit, "^{", "}");
}

void
qdot_figure_add_unit_latex(qdot_text *out, const char *unit)
{
    add_unit(out, unit, "$^{", "}$");
}

/* Append one letter as LaTeX shows it in any font encoding; returns the bytes that were read. */
static size_t
add_latex_letter(qdot_text *out, const char *at)
{
    static const struct {
        const char *letter, *latex;
    } others[] = {{"\\", "\\textbackslash{}"}, {"^", "\\textasciicircum{}"}, {"~", "\\textasciitilde{}"},
                  {"<", "\\textless{}"},        {">", "\\textgreater{}"},       {"|", "\\textbar{}"},
                  {"−", "$-$"},                  {"·", "$\\cdot$"}};
    const char *greek = qdot_name_greek(at);

    if (greek != NULL) {
        qdot_text_format(out, "$\\%s$", greek);
        return 2;
    }
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (strncmp(at, others[i].letter, strlen(others[i].letter)) == 0) {
            qdot_text_add(out, others[i].latex);
            return strlen(others[i].letter);
        }
    qdot_text_add(out, strchr("#$%&_{}", *at) != NULL ? "\\" : "");
    qdot_text_char(out, (unsigned char)*at < 0x20 ? ' ' : *at);
    return 1;
}

void
qdot_figure_add_latex(qdot_text *out, const qdot_figure_label *label)
{
    const char *text = label->text != NULL ? label->text : "";

    if (label->formula && *text != '\0') {
        qdot_text_char(out, '$');
        add_typed_text(out, text, true, IN_LATEX);
        qdot_text_char(out, '$');
        return;
    }
    while (*text != '\0')
        text += add_latex_letter(out, text);
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
