/* formula-page.c -- lines of answers as blocks of aligned equations and paragraphs. */
#include "show/formula-page.h"
#include "show/formulas.h"
#include "show/scripts.h"

#include <ctype.h>
#include <stdint.h>
#include <string.h>

#include "base/memory.h"

/* In units of about a letter: a line of a page of print. */
enum { LINE = 76 };

typedef enum { LATEX, MATHML } page_kind;
typedef enum { LABEL, RELATION, SIGN } cut_kind;

/* A place outside all brackets where a formula may be divided: the bytes of the sign there. */
typedef struct {
    cut_kind kind;
    size_t at, n;
} cut;

typedef struct {
    page_kind kind;
    qdot_text *out;
    bool block; /* a block of equations is open */
    bool told;  /* ... and its last row is ended, by words */
    const char *label; /* what names the next row, in LaTeX */
    size_t label_n;
    qdot_vec(cut) cuts; /* of the present formula */
} page;

static const char latex_begin[] = "\\(", latex_end[] = "\\)";
static const char mathml_begin[] = "<math xmlns=\"http://www.w3.org/1998/Math/MathML\">",
                  mathml_end[] = "</math>";

static const char *
begin_mark(const page *p)
{
    return p->kind == LATEX ? latex_begin : mathml_begin;
}

static const char *
end_mark(const page *p)
{
    return p->kind == LATEX ? latex_end : mathml_end;
}

static bool
line_begins(const char *text, const char *with)
{
    return strncmp(text, with, strlen(with)) == 0;
}

/* --- where a formula may be divided ----------------------------------------------------- */

typedef struct {
    cut_kind kind;
    const char *sign;
} sign_row;

static qdot_status
add_cut(page *p, const sign_row *rows, size_t n, const char *formula, size_t at)
{
    for (size_t i = 0; i < n; i++)
        if (line_begins(formula + at, rows[i].sign))
            return qdot_vec_push(&p->cuts,
                                 ((cut){rows[i].kind, at, strlen(rows[i].sign)}));
    return QDOT_OK;
}

/* Brackets in LaTeX: braces, \left ... \right, \begin ... \end. */
static int
latex_depth(const char *at)
{
    if (*at == '{' || line_begins(at, "\\left") || line_begins(at, "\\begin"))
        return 1;
    return *at == '}' || line_begins(at, "\\right") || line_begins(at, "\\end") ? -1 : 0;
}

static qdot_status
latex_cuts(page *p, const char *formula, size_t n)
{
    static const sign_row rows[] = {
        {LABEL, ": "},          {RELATION, " = "},     {RELATION, " < "},
        {RELATION, " > "},      {RELATION, " \\le "},  {RELATION, " \\ge "},
        {SIGN, " + "},          {SIGN, " - "},
    };
    int depth = 0;

    for (size_t i = 0; i < n; i++) {
        depth += latex_depth(formula + i);
        if (depth == 0)
            QDOT_TRY(add_cut(p, rows, sizeof rows / sizeof *rows, formula, i));
        if (formula[i] == '\\' && i + 1 < n && !isalpha((unsigned char)formula[i + 1]))
            i++; /* \{ is no brace */
    }
    return QDOT_OK;
}

static qdot_status
mathml_cuts(page *p, const char *formula, size_t n)
{
    static const sign_row rows[] = {
        {LABEL, "<mo>:</mo>"},       {RELATION, "<mo>=</mo>"}, {RELATION, "<mo>&lt;</mo>"},
        {RELATION, "<mo>&gt;</mo>"}, {RELATION, "<mo>≤</mo>"}, {RELATION, "<mo>≥</mo>"},
        {SIGN, "<mo>+</mo>"},        {SIGN, "<mo>−</mo>"},
    };
    bool operand = false; /* a sign behind one joins two terms */
    int depth = 0;

    for (size_t i = 0; i < n; i++) {
        if (formula[i] != '<')
            continue;
        if (formula[i + 1] == '/') {
            depth--;
            continue;
        }
        if (depth == 0 && operand)
            QDOT_TRY(add_cut(p, rows, sizeof rows / sizeof *rows, formula, i));
        if (depth == 0)
            operand = !line_begins(formula + i, "<mo>");
        depth++;
    }
    return QDOT_OK;
}

static qdot_status
find_cuts(page *p, const char *formula, size_t n)
{
    p->cuts.n = 0;
    return p->kind == LATEX ? latex_cuts(p, formula, n)
                                      : mathml_cuts(p, formula, n);
}

/* --- width ------------------------------------------------------------------------------ */

/* A word of LaTeX: letters of functions count, marks above a letter do not. */
static size_t
word_width(const char *word, size_t n)
{
    static const char *const bare[] = {"left", "right",  "dot",          "ddot", "frac",
                                       "sqrt", "mathrm", "operatorname", "text"};
    static const char *const spelled[] = {"sin", "cos", "tan", "sec",  "csc",  "cot",
                                          "log", "exp", "sinh", "cosh", "tanh", "arcsin"};

    for (size_t i = 0; i < sizeof bare / sizeof *bare; i++)
        if (strlen(bare[i]) == n && strncmp(word, bare[i], n) == 0)
            return 0;
    for (size_t i = 0; i < sizeof spelled / sizeof *spelled; i++)
        if (strlen(spelled[i]) == n && strncmp(word, spelled[i], n) == 0)
            return n;
    return 1;
}

/* About how many letters wide: half for what stands in a fraction. */
static size_t
latex_width(const char *at, size_t n)
{
    size_t width = 0;

    for (size_t i = 0; i < n; i++) {
        if (at[i] == '\\' && i + 1 < n && isalpha((unsigned char)at[i + 1])) {
            size_t k = 1;

            while (i + k < n && isalpha((unsigned char)at[i + k]))
                k++;
            width += word_width(at + i + 1, k - 1);
            i += k - 1;
        } else if (strchr("{}^_ ", at[i]) == NULL && (at[i] & 0xc0) != 0x80) {
            width++;
        }
    }
    return width;
}

static size_t
mathml_width(const char *at, size_t n)
{
    size_t width = 0;

    for (size_t i = 0; i < n; i++) {
        if (at[i] == '<') {
            while (i < n && at[i] != '>')
                i++;
        } else if (at[i] == '&') {
            width += !line_begins(at + i, "&#x206");
            while (i < n && at[i] != ';')
                i++;
        } else {
            width += (at[i] & 0xc0) != 0x80;
        }
    }
    return width;
}

static size_t
formula_width(const page *p, const char *at, size_t n)
{
    return p->kind == LATEX ? latex_width(at, n) : mathml_width(at, n);
}

/* --- rows of a block -------------------------------------------------------------------- */

/* A row: what stands left of the aligned sign, the sign, what follows. */
typedef struct {
    const char *left, *sign, *right;
    size_t left_n, sign_n, right_n;
    bool indented;
} row;

/* The line of a heading goes on into the equations below it: a paragraph that ends there would be
 * followed by an empty line. */
static void
join_heading(page *p)
{
    static const char end[] = "}\\par\n";

    if (qdot_ends_in(qdot_text_str(p->out), end)) {
        qdot_text_truncate(p->out, p->out->n - strlen(end));
        qdot_text_add(p->out, "}\n");
    }
}

static void
latex_row(page *p, const row *r)
{
    if (!p->block)
        join_heading(p);
    qdot_text_add(p->out, p->told    ? ""
                          : p->block ? " \\\\\n    "
                                     : "\\begin{align*}\n    ");
    p->told = false;
    if (p->label_n > 0) {
        qdot_text_add(p->out, "% ");
        qdot_text_add_n(p->out, p->label, p->label_n);
        qdot_text_add(p->out, "\n    ");
        p->label_n = 0;
    }
    qdot_text_add_n(p->out, r->left, r->left_n);
    qdot_text_add(p->out, r->left_n > 0 ? " &" : "&");
    if (r->indented)
        qdot_text_add(p->out, " \\quad {}");
    if (r->sign_n > 0 && *r->sign == ' ' && r->indented)
        qdot_text_add_n(p->out, r->sign + 1, r->sign_n - 1);
    else
        qdot_text_add_n(p->out, r->sign, r->sign_n);
    qdot_text_add(p->out, r->sign_n == 0 ? " " : "");
    qdot_text_add_n(p->out, r->right, r->right_n);
}

/* A sign that begins a cell is still one between two terms. */
static void
mathml_row(page *p, const row *r)
{
    const char *const before = "<mtd class=\"right\">";

    if (!p->block)
        qdot_text_add(p->out, "<math xmlns=\"http://www.w3.org/1998/Math/MathML\" "
                              "display=\"block\"><mtable displaystyle=\"true\">\n");
    qdot_text_add(p->out, "<mtr><mtd class=\"left\">");
    qdot_page_add_mathml(p->out, r->left, r->left_n);
    qdot_text_format(p->out, "</mtd>%s", before);
    if (r->indented)
        qdot_text_add(p->out, "<mspace width=\"2em\"/>");
    if (r->sign_n > 0) {
        qdot_text_add(p->out, "<mo form=\"infix\"");
        qdot_text_add_n(p->out, r->sign + 3, r->sign_n - 3);
    }
    qdot_page_add_mathml(p->out, r->right, r->right_n);
    qdot_text_add(p->out, "</mtd></mtr>\n");
}

static void
page_add_row(page *p, const row *r)
{
    if (p->kind == LATEX)
        latex_row(p, r);
    else
        mathml_row(p, r);
    p->block = true;
}

static void
end_block(page *p)
{
    if (p->block)
        qdot_text_add(p->out, p->kind == LATEX ? "\n\\end{align*}\n"
                                                         : "</mtable></math>\n");
    p->block = false;
}

/* Bytes from ... to of the formula behind r's sign, in lines that fit: cuts k on may be used. The
 * first line has the left side and sign of r. */
static void
add_lines(page *p, const char *formula, size_t from, size_t to, row r, size_t k)
{
    size_t taken = r.left_n > 0 ? formula_width(p, r.left, r.left_n) : 0;

    for (size_t best = SIZE_MAX; from < to; best = SIZE_MAX) {
        size_t end = to;

        if (taken + formula_width(p, formula + from, to - from) > LINE) {
            for (; k < p->cuts.n && p->cuts.at[k].at < to; k++) {
                if (p->cuts.at[k].kind != SIGN || p->cuts.at[k].at <= from)
                    continue;
                if (best != SIZE_MAX &&
                    taken + formula_width(p, formula + from, p->cuts.at[k].at - from) > LINE)
                    break;
                best = k;
            }
            if (best != SIZE_MAX)
                end = p->cuts.at[best].at;
        }
        r.right = formula + from;
        r.right_n = end - from;
        page_add_row(p, &r);
        if (end == to)
            return;
        r = (row){.left = "",
                  .sign = formula + p->cuts.at[best].at,
                  .sign_n = p->cuts.at[best].n,
                  .indented = true};
        from = end + p->cuts.at[best].n;
        k = best + 1;
        taken = 3;
    }
}

/* The name before a colon: a comment before the next row; above the block in HTML. */
static void
add_label(page *p, const char *label, size_t n)
{
    p->label = label;
    p->label_n = n;
    if (p->kind == LATEX)
        return;
    end_block(p);
    qdot_text_format(p->out, "<p class=\"label\">%s", mathml_begin);
    qdot_text_add_n(p->out, label, n);
    qdot_text_format(p->out, "%s</p>\n", mathml_end);
}

/* One formula as rows of the block: aligned at its relation; with a left side that is too wide, all
 * of it from the alignment on. */
static qdot_status
add_formula(page *p, const char *formula, size_t n)
{
    size_t k = 0, from = 0, relation;
    row r = {.left = ""};

    QDOT_TRY(find_cuts(p, formula, n));
    if (p->cuts.n > 0 && p->cuts.at[0].kind == LABEL) {
        add_label(p, formula, p->cuts.at[0].at);
        from = p->cuts.at[0].at + p->cuts.at[0].n;
        k = 1;
    }
    for (relation = k; relation < p->cuts.n; relation++)
        if (p->cuts.at[relation].kind == RELATION)
            break;
    if (relation == p->cuts.n) {
        add_lines(p, formula, from, n, r, k);
        return QDOT_OK;
    }
    r.sign = formula + p->cuts.at[relation].at;
    r.sign_n = p->cuts.at[relation].n;
    if (formula_width(p, formula + from, p->cuts.at[relation].at - from) > LINE / 2) {
        add_lines(p, formula, from, p->cuts.at[relation].at, (row){.left = ""}, k);
    } else {
        r.left = formula + from;
        r.left_n = p->cuts.at[relation].at - from;
    }
    add_lines(p, formula, p->cuts.at[relation].at + p->cuts.at[relation].n, n, r,
              relation + 1);
    return QDOT_OK;
}

/* --- text ------------------------------------------------------------------------------- */

static void
latex_escape(const char *text, size_t length, qdot_text *out)
{
    static const struct {
        char from;
        const char *to;
    } rows[] = {{'\\', "\\textbackslash{}"}, {'{', "\\{"}, {'}', "\\}"},
                {'$', "\\$"}, {'&', "\\&"}, {'#', "\\#"}, {'_', "\\_"}, {'%', "\\%"},
                {'^', "\\textasciicircum{}"}, {'~', "\\textasciitilde{}"},
                {'<', "\\textless{}"}, {'>', "\\textgreater{}"}};

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
escape(const page *p, const char *text, size_t n)
{
    if (p->kind == LATEX)
        latex_escape(text, n, p->out);
    else
        qdot_text_html(p->out, text, n, false);
}

/* The formula that begins at or after `at`; *n its bytes with both marks; NULL: none. */
static const char *
next_formula(const page *p, const char *at, const char *end, size_t *n)
{
    const char *found = strstr(at, begin_mark(p)), *last;

    if (found == NULL || found >= end)
        return NULL;
    last = strstr(found, end_mark(p));
    if (last == NULL || last >= end)
        return NULL;
    *n = (size_t)(last - found) + strlen(end_mark(p));
    return found;
}

/* "3. Title": how many bytes the title begins behind; 0: it is none. */
static size_t
heading(const char *line, size_t n)
{
    size_t digits = strspn(line, "0123456789");

    return digits > 0 && digits + 2 < n && line_begins(line + digits, ". ") ? digits + 2 : 0;
}

static void
page_add_text(page *p, const char *line, size_t n)
{
    const char *const end = line + n;
    const size_t blanks = strspn(line, " ");
    bool title = heading(line, n) > 0, latex = p->kind == LATEX;
    const char *formula;
    size_t size;

    end_block(p);
    line += blanks;
    qdot_text_add(p->out, latex ? title ? "\\par\\medskip\\noindent\\textbf{" : "\\noindent "
                          : title ? "<h2>"
                                  : "<p>");
    while ((formula = next_formula(p, line, end, &size)) != NULL) {
        escape(p, line, (size_t)(formula - line));
        qdot_text_add_n(p->out, formula, size);
        line = formula + size;
    }
    escape(p, line, (size_t)(end - line));
    qdot_text_add(p->out, latex ? title ? "}\\par\n" : "\\par\n"
                          : title ? "</h2>\n"
                                  : "</p>\n");
}

/* The words before a colon and one formula, `    kinetic energy of bob: `. */
static void
add_words(page *p, const char *words, size_t n)
{
    const bool latex = p->kind == LATEX, open = p->block;

    if (latex && open) {
        qdot_text_add(p->out, " \\\\\n    \\intertext{");
    } else {
        end_block(p);
        qdot_text_add(p->out, latex ? "\\noindent " : "<p class=\"label\">");
    }
    escape(p, words, n);
    qdot_text_add(p->out, latex ? open ? "}\n    " : "\n" : "</p>\n");
    p->told = latex && open;
}

static qdot_status
page_add_line(page *p, const char *line, size_t n)
{
    const size_t blanks = strspn(line, " "), mark = strlen(begin_mark(p));
    const char *formula;
    size_t size;

    formula = next_formula(p, line, line + n, &size);
    if (formula == line + blanks && blanks + size == n)
        return add_formula(p, formula + mark, size - mark - strlen(end_mark(p)));
    if (formula != NULL && blanks > 0 && formula + size == line + n &&
        line_begins(formula - 2, ": ")) {
        add_words(p, line + blanks, (size_t)(formula - line) - blanks - 1);
        return add_formula(p, formula + mark, size - mark - strlen(end_mark(p)));
    }
    if (blanks < n)
        page_add_text(p, line, n);
    else
        end_block(p);
    return QDOT_OK;
}

static qdot_status
add_answers(page_kind kind, const char *answers, qdot_text *out)
{
    page p = {.kind = kind, .out = out};
    qdot_status status = QDOT_OK;

    while (*answers != '\0' && status == QDOT_OK) {
        size_t n = strcspn(answers, "\n");

        status = page_add_line(&p, answers, n);
        answers += n + (answers[n] == '\n');
    }
    end_block(&p);
    qdot_free(p.cuts.at);
    return status == QDOT_OK ? qdot_text_status(out) : status;
}

qdot_status
qdot_page_latex(const char *answers, qdot_text *out)
{
    return add_answers(LATEX, answers, out);
}

qdot_status
qdot_page_mathml(const char *answers, qdot_text *out)
{
    return add_answers(MATHML, answers, out);
}

const char qdot_page_css[] =
    "mtd.left { text-align: right; padding: 0.35em 0; }\n"
    "mtd.right { text-align: left; padding: 0.35em 0; }\n"
    "math { font-family: 'Latin Modern Math', 'STIX Two Math', math; }\n"
    "math[display=block] { margin: 0.6em 0; overflow-x: auto; }\n"
    "p { margin: 0.3em 0; white-space: pre-wrap; }\n"
    "p.label { margin: 0.8em 0 0; opacity: 0.65; }\n"
    "h2 { font-size: 1.1em; margin: 1.4em 0 0.4em; }\n";

qdot_status
qdot_page_html(const char *title, const char *answers, qdot_text *out)
{
    qdot_text_add(out, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n"
                       "<meta charset=\"utf-8\">\n"
                       "<meta name=\"viewport\" content=\"width=device-width\">\n<title>");
    qdot_text_html(out, title, strlen(title), false);
    qdot_text_format(out,
                     "</title>\n<style>\n"
                     "body { font-family: serif; margin: 2em auto; max-width: 60em; "
                     "padding: 0 1em; }\n%s</style>\n</head>\n<body>\n",
                     qdot_page_css);
    QDOT_TRY(qdot_page_mathml(answers, out));
    qdot_formulas_foot(out);
    qdot_text_add(out, "</body>\n</html>\n");
    return qdot_text_status(out);
}
