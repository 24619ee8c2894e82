/* formula-page.c -- writes answers as aligned equations and paragraphs, in LaTeX or HTML. */
#include "show/formula-page.h"

#include <ctype.h>
#include <stdint.h>
#include <string.h>

#include "formula/width.h"
#include "formula/write.h"
#include "show/formulas.h"
#include "show/page.h"

/* The width of a line on a printed page, in characters. */
enum { LINE = 76 };

typedef qdot_formula_page page;

static bool
is_latex(const page *p)
{
    return p->kind == QDOT_PAGE_LATEX;
}

static void
page_record_failure(page *p, qdot_status status)
{
    if (p->status == QDOT_OK)
        p->status = status;
}

/* --- widths of texts -------------------------------------------------------------------- */

/* The approximate width of a LaTeX command: a function's name counts its letters, an accent nothing. */
static size_t
latex_command_width(const char *word, size_t n)
{
    static const char *const bare[] = {"left", "right",  "dot",          "ddot", "frac",
                                       "sqrt", "mathrm", "operatorname", "text"};
    static const char *const spelled[] = {"sin", "cos", "tan",  "sec",  "csc",  "cot",
                                          "log", "exp", "sinh", "cosh", "tanh", "arcsin"};

    for (size_t i = 0; i < sizeof bare / sizeof *bare; i++)
        if (strlen(bare[i]) == n && strncmp(word, bare[i], n) == 0)
            return 0;
    for (size_t i = 0; i < sizeof spelled / sizeof *spelled; i++)
        if (strlen(spelled[i]) == n && strncmp(word, spelled[i], n) == 0)
            return n;
    return 1;
}

/* The approximate width of a LaTeX text in characters. */
static size_t
latex_width(const char *at, size_t n)
{
    size_t width = 0;

    for (size_t i = 0; i < n; i++) {
        if (at[i] == '\\' && i + 1 < n && isalpha((unsigned char)at[i + 1])) {
            size_t k = 1;

            while (i + k < n && isalpha((unsigned char)at[i + k]))
                k++;
            width += latex_command_width(at + i + 1, k - 1);
            i += k - 1;
        } else if (strchr("{}^_ ", at[i]) == NULL && (at[i] & 0xc0) != 0x80) {
            width++;
        }
    }
    return width;
}

/* Whether a node of a formula is a text typed in LaTeX: the name of an answer, or latex(...). */
static bool
is_typed_latex(const qdot_formula_node *node)
{
    return node->kind == QDOT_FORMULA_TEXT && node->what == QDOT_TEXT_WORDS;
}

/* --- the parts of a formula --------------------------------------------------------------- */

/* Write the parts of a formula one after another, and record the total width before each part. */
static qdot_status
page_write_parts(page *p, const qdot_formula *f, qdot_formula_id formula)
{
    size_t width = 0;

    qdot_text_truncate(&p->written, 0);
    p->parts.part.n = p->cuts.n = 0;
    QDOT_TRY(qdot_formula_find_parts(f, formula, &p->parts));
    for (size_t i = 0; i < p->parts.part.n; i++) {
        const qdot_formula_node *node = qdot_formula_at(f, p->parts.part.at[i]);
        const bool label = (node->flags & QDOT_FORMULA_LABEL) && p->paint != NULL;
        const size_t from = p->written.n;
        size_t letters;

        QDOT_TRY(qdot_vec_push(
            &p->cuts, ((qdot_page_cut){from, width, qdot_formula_sign_duty(node)})));
        qdot_text_add(&p->written, label ? p->paint : "");
        QDOT_TRY(is_latex(p)
                     ? qdot_formula_write_latex_part(f, p->parts.part.at[i], qdot_formula_before_part(&p->parts, i),
                                                     &p->written)
                     : qdot_formula_write_page(f, p->parts.part.at[i], qdot_formula_before_part(&p->parts, i),
                                               &p->written));
        qdot_text_add(&p->written, label ? p->end : "");
        QDOT_TRY(qdot_text_status(&p->written));
        QDOT_TRY(qdot_formula_width(f, p->parts.part.at[i], &letters));
        width += is_latex(p) && is_typed_latex(node) ? latex_width(p->written.at + from, p->written.n - from) : letters;
    }
    return qdot_vec_push(&p->cuts,
                         ((qdot_page_cut){p->written.n, width, QDOT_DUTY_NONE}));
}

/* The width of the parts [from, to) of the formula. */
static size_t
width_of_parts(const page *p, size_t from, size_t to)
{
    return p->cuts.at[to].width - p->cuts.at[from].width;
}

static void
page_copy_parts(page *p, size_t from, size_t to)
{
    qdot_text_add_n(&p->out, p->written.at + p->cuts.at[from].at,
                    p->cuts.at[to].at - p->cuts.at[from].at);
}

/* --- rows of a block -------------------------------------------------------------------- */

/* A row of an aligned equation: the parts left of the sign (= or +), the sign, and the parts right of it. */
typedef struct {
    size_t left, left_end, sign, right, right_end;
    bool indented;
} row;

static const size_t none = SIZE_MAX;

/* The line of a heading goes on into the equations below it: a paragraph that ends there would be
 * followed by an empty line. */
static void
join_heading_to_block(page *p)
{
    static const char end[] = "}\\par\n";

    if (qdot_ends_in(qdot_text_str(&p->out), end)) {
        qdot_text_truncate(&p->out, p->out.n - strlen(end));
        qdot_text_add(&p->out, "}\n");
    }
}

static void
latex_row(page *p, const row *r)
{
    if (!p->block)
        join_heading_to_block(p);
    qdot_text_add(&p->out, p->told    ? ""
                           : p->block ? " \\\\\n    "
                                      : "\\begin{align*}\n    ");
    p->told = false;
    if (p->label.n > 0) {
        qdot_text_format(&p->out, "%% %s\n    ", qdot_text_str(&p->label));
        qdot_text_truncate(&p->label, 0);
    }
    page_copy_parts(p, r->left, r->left_end);
    qdot_text_add(&p->out, r->left < r->left_end ? " &" : "&");
    if (r->indented)
        qdot_text_add(&p->out, " \\quad {}");
    if (r->sign != none) {
        const size_t at = p->cuts.at[r->sign].at, n = p->cuts.at[r->sign + 1].at - at;
        const bool trimmed = r->indented && p->written.at[at] == ' ';

        qdot_text_add_n(&p->out, p->written.at + at + trimmed, n - trimmed);
    }
    qdot_text_add(&p->out, r->sign == none ? " " : "");
    page_copy_parts(p, r->right, r->right_end);
}

/* Write a row in MathML; a sign at the start of a table cell must still be spaced like a binary sign. */
static void
mathml_row(page *p, const row *r)
{
    static const char tag[] = "<mo";

    if (!p->block)
        qdot_text_add(&p->out, "<math xmlns=\"http://www.w3.org/1998/Math/MathML\" "
                               "display=\"block\"><mtable displaystyle=\"true\">\n");
    qdot_text_add(&p->out, "<mtr><mtd class=\"left\">");
    page_copy_parts(p, r->left, r->left_end);
    qdot_text_add(&p->out, "</mtd><mtd class=\"right\">");
    if (r->indented)
        qdot_text_add(&p->out, "<mspace width=\"2em\"/>");
    if (r->sign != none) {
        const size_t at = p->cuts.at[r->sign].at + strlen(tag),
                     end = p->cuts.at[r->sign + 1].at;

        qdot_text_add(&p->out, "<mo form=\"infix\"");
        qdot_text_add_n(&p->out, p->written.at + at, end - at);
    }
    page_copy_parts(p, r->right, r->right_end);
    qdot_text_add(&p->out, "</mtd></mtr>\n");
}

static void
page_add_row(page *p, const row *r)
{
    if (is_latex(p))
        latex_row(p, r);
    else
        mathml_row(p, r);
    p->block = true;
}

static void
end_equation_block(page *p)
{
    if (p->block)
        qdot_text_add(&p->out, is_latex(p) ? "\n\\end{align*}\n" : "</mtable></math>\n");
    p->block = false;
}

/* Parts [from, to) behind r's sign, in lines that fit, divided before signs between terms. The first line has the left
 * side and the sign of r. */
static void
add_formula_rows(page *p, size_t from, size_t to, row r)
{
    size_t taken = width_of_parts(p, r.left, r.left_end);

    for (size_t k = from;;) {
        size_t best = none;

        if (taken + width_of_parts(p, from, to) > LINE)
            for (; k < to; k++) {
                if (p->cuts.at[k].duty != QDOT_DUTY_TERMS || k <= from)
                    continue;
                if (best != none && taken + width_of_parts(p, from, k) > LINE)
                    break;
                best = k;
            }
        r.right = from;
        r.right_end = best != none ? best : to;
        page_add_row(p, &r);
        if (best == none)
            return;
        r = (row){.sign = best, .indented = true};
        from = best + 1;
        k = from;
        taken = 3;
    }
}

/* Write an answer's name that precedes a colon: in LaTeX later, as a comment; in HTML above the equations. */
static void
add_label(page *p, size_t to)
{
    if (is_latex(p)) {
        qdot_text_truncate(&p->label, 0);
        qdot_text_add_n(&p->label, p->written.at, p->cuts.at[to].at);
        return;
    }
    end_equation_block(p);
    qdot_text_add(&p->out, "<p class=\"label\">" QDOT_FORMULA_MATH);
    page_copy_parts(p, 0, to);
    qdot_text_add(&p->out, QDOT_FORMULA_MATH_END "</p>\n");
}

/* The index of the first part from k on that has either role (`one` or `other`); the end if none. */
static size_t
find_part_by_role(const page *p, size_t k, qdot_formula_duty one, qdot_formula_duty other)
{
    while (k + 1 < p->cuts.n && p->cuts.at[k].duty != one && p->cuts.at[k].duty != other)
        k++;
    return k;
}

/* Add one formula as rows of the block: aligned at its relation; with a left side that is too wide, all of it from the
 * alignment on. */
static qdot_status
page_add_formula(page *p, const qdot_formula *f, qdot_formula_id formula)
{
    row r = {.sign = none};
    size_t from = 0, end, relation;

    QDOT_TRY(page_write_parts(p, f, formula));
    end = p->cuts.n - 1;
    relation = find_part_by_role(p, 0, QDOT_DUTY_COLON, QDOT_DUTY_RELATION);
    if (p->cuts.at[relation].duty == QDOT_DUTY_COLON) {
        add_label(p, relation);
        from = relation + 1;
        relation = find_part_by_role(p, from, QDOT_DUTY_RELATION, QDOT_DUTY_RELATION);
    }
    if (relation == end) {
        add_formula_rows(p, from, end, r);
        return QDOT_OK;
    }
    if (width_of_parts(p, from, relation) > LINE / 2) {
        add_formula_rows(p, from, relation, r);
    } else {
        r.left = from;
        r.left_end = relation;
    }
    r.sign = relation;
    add_formula_rows(p, relation + 1, end, r);
    return QDOT_OK;
}

/* --- paragraphs of text ----------------------------------------------------------------- */

static void
latex_escape(const char *text, size_t length, qdot_text *out)
{
    static const struct {
        char from;
        const char *to;
    } rows[] = {{'\\', "\\textbackslash{}"},
                {'{', "\\{"},
                {'}', "\\}"},
                {'$', "\\$"},
                {'&', "\\&"},
                {'#', "\\#"},
                {'_', "\\_"},
                {'%', "\\%"},
                {'^', "\\textasciicircum{}"},
                {'~', "\\textasciitilde{}"},
                {'<', "\\textless{}"},
                {'>', "\\textgreater{}"}};

    for (size_t i = 0; i < length; i++) {
        size_t k = 0;

        while (k < sizeof rows / sizeof *rows && rows[k].from != text[i])
            k++;
        if (k < sizeof rows / sizeof *rows)
            qdot_text_add(out, rows[k].to);
        else
            qdot_text_char(out, text[i]);
    }
}

static void
escape_text(page *p, const char *text, size_t n)
{
    if (is_latex(p))
        latex_escape(text, n, &p->out);
    else
        qdot_text_html(&p->out, text, n, false);
}

/* The texts that a line begins with, before its first formula: in p->written. *formula: that formula, 0: none; *last:
 * nothing stands behind it. */
static qdot_status
read_text_before_formula(page *p, const qdot_formula *f, qdot_formula_id line, qdot_formula_id *formula,
                         bool *last)
{
    qdot_formula_id c = 0;

    qdot_text_truncate(&p->written, 0);
    *formula = 0;
    *last = false;
    while ((c = qdot_formula_child(f, line, c)) != 0) {
        const qdot_formula_node *node = qdot_formula_at(f, c);

        if (node->kind != QDOT_FORMULA_TEXT) {
            *formula = c;
            *last = qdot_formula_child(f, line, c) == 0;
            break;
        }
        qdot_text_add_n(&p->written, f->text.at + node->child, node->n);
    }
    return qdot_text_status(&p->written);
}

/* Append a formula inline within a text. */
static qdot_status
add_inline_formula(page *p, const qdot_formula *f, qdot_formula_id formula)
{
    qdot_text_add(&p->out, is_latex(p) ? "\\(" : QDOT_FORMULA_MATH);
    QDOT_TRY(is_latex(p) ? qdot_formula_write_latex(f, formula, &p->out)
                         : qdot_formula_write_mathml(f, formula, &p->out));
    qdot_text_add(&p->out, is_latex(p) ? "\\)" : QDOT_FORMULA_MATH_END);
    return QDOT_OK;
}

static qdot_status
page_add_text(page *p, const qdot_formula *f, qdot_formula_id line, const char *lead,
              bool more)
{
    const bool title = qdot_page_is_heading(lead, more), latex = is_latex(p);
    size_t blanks = strspn(lead, " ");
    qdot_formula_id c = 0;

    end_equation_block(p);
    qdot_text_add(&p->out,
                  latex   ? title ? "\\par\\medskip\\noindent\\textbf{" : "\\noindent "
                  : title ? "<h2>"
                          : "<p>");
    while ((c = qdot_formula_child(f, line, c)) != 0) {
        const qdot_formula_node *node = qdot_formula_at(f, c);

        if (node->kind != QDOT_FORMULA_TEXT) {
            QDOT_TRY(add_inline_formula(p, f, c));
            blanks = 0;
        } else if (blanks < node->n) {
            escape_text(p, f->text.at + node->child + blanks, node->n - blanks);
            blanks = 0;
        } else {
            blanks -= node->n;
        }
    }
    qdot_text_add(&p->out, latex   ? title ? "}\\par\n" : "\\par\n"
                           : title ? "</h2>\n"
                                   : "</p>\n");
    return QDOT_OK;
}

/* Append the words before a colon that is followed by one formula, as in `kinetic energy of bob: `. */
static void
add_words(page *p, const char *words, size_t n)
{
    const bool latex = is_latex(p), open = p->block;

    if (latex && open) {
        qdot_text_add(&p->out, " \\\\\n    \\intertext{");
    } else {
        end_equation_block(p);
        qdot_text_add(&p->out, latex ? "\\noindent " : "<p class=\"label\">");
    }
    escape_text(p, words, n);
    qdot_text_add(&p->out, latex ? open ? "}\n    " : "\n" : "</p>\n");
    p->told = latex && open;
}

static qdot_status
page_add_line(page *p, const qdot_formula *f, qdot_formula_id line)
{
    qdot_formula_id formula;
    size_t blanks, n;
    const char *lead;
    bool last;

    if (p->kind == QDOT_PAGE_REPORT)
        return qdot_page_line(&p->out, f, line);
    QDOT_TRY(read_text_before_formula(p, f, line, &formula, &last));
    lead = qdot_text_str(&p->written);
    n = p->written.n;
    blanks = strspn(lead, " ");
    if (last && blanks == n)
        return page_add_formula(p, f, formula);
    if (last && blanks > 0 && qdot_ends_in(lead, ": ")) {
        add_words(p, lead + blanks, n - blanks - 1);
        return page_add_formula(p, f, formula);
    }
    if (formula != 0 || blanks < n)
        return page_add_text(p, f, line, lead, formula != 0);
    end_equation_block(p);
    return QDOT_OK;
}

/* --- beginning and ending a page ---------------------------------------------------------- */

void
qdot_formula_page_line(qdot_formula_page *p, const qdot_formula *f, qdot_formula_id line)
{
    if (p->status == QDOT_OK)
        page_record_failure(p, page_add_line(p, f, line));
}

void
qdot_formula_page_text(qdot_formula_page *p, const char *lines, size_t n)
{
    qdot_formula f = {0};

    for (const char *const end = lines + n; lines < end && p->status == QDOT_OK;) {
        const char *stop = memchr(lines, '\n', (size_t)(end - lines));
        qdot_formula_id line;

        stop = stop != NULL ? stop : end;
        qdot_formula_empty(&f);
        line = qdot_formula_new(&f, QDOT_FORMULA_SPAN, 0, 0);
        qdot_formula_add_text(&f, line, QDOT_TEXT_WORDS, lines, (size_t)(stop - lines));
        page_record_failure(p, qdot_formula_status(&f));
        qdot_formula_page_line(p, &f, line);
        lines = stop + 1;
    }
    qdot_formula_clear(&f);
}

qdot_status
qdot_formula_page_end(qdot_formula_page *p, qdot_text *out)
{
    end_equation_block(p);
    page_record_failure(p, qdot_text_status(&p->out));
    if (p->status == QDOT_OK)
        qdot_text_add_n(out, qdot_text_str(&p->out), p->out.n);
    return p->status == QDOT_OK ? qdot_text_status(out) : p->status;
}

void
qdot_formula_page_clear(qdot_formula_page *p)
{
    qdot_text_clear(&p->out);
    qdot_text_clear(&p->label);
    qdot_text_clear(&p->written);
    qdot_formula_parts_clear(&p->parts);
    qdot_free(p->cuts.at);
    *p = (qdot_formula_page){0};
}

static const char css[] =
    "mtd.left { text-align: right; padding: 0.35em 0; }\n"
    "mtd.right { text-align: left; padding: 0.35em 0; }\n"
    "math { font-family: 'Latin Modern Math', 'STIX Two Math', math; }\n"
    "math[display=block] { margin: 0.6em 0; overflow-x: auto; }\n"
    "p { margin: 0.3em 0; white-space: pre-wrap; }\n"
    "p.label { margin: 0.8em 0 0; opacity: 0.65; }\n"
    "h2 { font-size: 1.1em; margin: 1.4em 0 0.4em; }\n";

qdot_status
qdot_formula_page_html(qdot_formula_page *p, const char *title, qdot_text *out)
{
    qdot_text_add(out,
                  "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n"
                  "<meta charset=\"utf-8\">\n"
                  "<meta name=\"viewport\" content=\"width=device-width\">\n<title>");
    qdot_text_html(out, title, strlen(title), false);
    qdot_text_format(out,
                     "</title>\n<style>\n"
                     "body { font-family: serif; margin: 2em auto; max-width: 60em; "
                     "padding: 0 1em; }\n%s</style>\n</head>\n<body>\n",
                     css);
    QDOT_TRY(qdot_formula_page_end(p, out));
    qdot_formulas_foot(out);
    qdot_text_add(out, "</body>\n</html>\n");
    return qdot_text_status(out);
}
