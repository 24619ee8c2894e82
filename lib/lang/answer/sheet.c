/* sheet.c -- answers that contain formulas: for a terminal, as plain text, or for a page (LaTeX or HTML). */
#include "lang/answer/sheet.h"

#include <inttypes.h>
#include <stdarg.h>
#include <string.h>

#include "base/number-text.h"
#include "base/terminal.h"
#include "base/utf8.h"
#include "base/wrap.h"
#include "expr/print-formula.h"
#include "formula/layout.h"
#include "formula/write.h"
#include "lang/answer/expression.h"
#include "lang/answer/typed-name.h"
#include "lang/answer/write.h"
#include "lang/session/output.h"
#include "show/formula-page.h"

/* --- beginning an answer ------------------------------------------------------------------ */

static void
begin_next_line(qdot_sheet *s)
{
    s->at = s->line = qdot_formula_add(&s->formula, s->lines, QDOT_FORMULA_SPAN, 0, 0);
}

static qdot_sheet
sheet_begin(qdot_session *session, qdot_sheet_form form, qdot_style style)
{
    qdot_sheet s = {
        .session = session, .form = form, .style = style, .page = session->output->page};

    s.notation =
        form == QDOT_SHEET_DRAWN ? QDOT_NOTATION_DRAWN : qdot_print_notation(style);
    s.lines = qdot_formula_new(&s.formula, QDOT_FORMULA_SPAN, 0, 0);
    begin_next_line(&s);
    return s;
}

qdot_sheet
qdot_sheet_begin_html(qdot_session *session)
{
    return sheet_begin(session, QDOT_SHEET_PAGE, QDOT_MATHML);
}

/* Where a program displays answers: begin the same answer for a page of HTML, too. */
static void
begin_typeset(qdot_sheet *s)
{
    if (!qdot_write_displays(s->session))
        return;
    s->typeset = qdot_malloc(sizeof *s->typeset);
    if (s->typeset != NULL)
        *s->typeset = qdot_sheet_begin_html(s->session);
    else
        s->formula.failed = true;
}

qdot_sheet
qdot_sheet_begin(qdot_session *session)
{
    const bool equations =
        !session->output->json && !session->output->flat &&
        (session->output->style == QDOT_LATEX || session->output->style == QDOT_MATHML);
    qdot_sheet_form form =
        session->output->page != NULL || equations ? QDOT_SHEET_PAGE : QDOT_SHEET_LINES;
    size_t columns = 0, rows = 0;
    qdot_sheet s;

    if (session->output->style == QDOT_UNICODE && !session->output->flat && !session->output->json &&
        qdot_terminal_size(qdot_write_stream(session), &columns, &rows))
        form = QDOT_SHEET_DRAWN;
    s = sheet_begin(session, form, session->output->style);
    s.broken = !session->output->flat;
    s.columns = columns;
    s.rows = rows;
    begin_typeset(&s);
    return s;
}

qdot_sheet
qdot_sheet_begin_words(qdot_session *session)
{
    qdot_sheet s =
        sheet_begin(session, session->output->page != NULL ? QDOT_SHEET_PAGE : QDOT_SHEET_LINES,
                    session->output->style);

    s.broken = true;
    begin_typeset(&s);
    return s;
}

qdot_sheet
qdot_sheet_begin_text(qdot_session *session, qdot_style style)
{
    return sheet_begin(session, QDOT_SHEET_LINES, style);
}

void
qdot_sheet_clear(qdot_sheet *s)
{
    if (s->typeset != NULL)
        qdot_formula_clear(&s->typeset->formula);
    qdot_free(s->typeset);
    s->typeset = NULL;
    qdot_formula_clear(&s->formula);
}

/* --- adding words, numbers and formulas --------------------------------------------------- */

/* Append text to the line; on a terminal a line may break after each word. */
static void
add_words_to_sheet(qdot_sheet *s, const char *text, size_t n)
{
    while (n > 0) {
        size_t word = n;

        if (s->form == QDOT_SHEET_DRAWN) {
            word = strspn(text, " ");
            word += strcspn(text + word, " \n");
            word = word < n ? word + 1 : n; /* to the end of the word, with the blank after it */
        }
        qdot_formula_add_text(&s->formula, s->at, QDOT_TEXT_WORDS, text, word);
        text += word;
        n -= word;
    }
}

void
qdot_sheet_words(qdot_sheet *s, const char *text)
{
    if (s->typeset != NULL)
        qdot_sheet_words(s->typeset, text);
    for (;;) {
        const size_t n = strcspn(text, "\n");

        add_words_to_sheet(s, text, n);
        if (text[n] == '\0')
            return;
        begin_next_line(s);
        text += n + 1;
    }
}

void
qdot_sheet_format(qdot_sheet *s, const char *format, ...)
{
    char few[512], *many = NULL;
    va_list ap, again;
    int n;

    va_start(ap, format);
    va_copy(again, ap);
    n = vsnprintf(few, sizeof few, format, ap);
    va_end(ap);
    if (n >= (int)sizeof few && (many = qdot_malloc((size_t)n + 1)) != NULL)
        vsnprintf(many, (size_t)n + 1, format, again);
    va_end(again);
    s->formula.failed =
        s->formula.failed || n < 0 || (n >= (int)sizeof few && many == NULL);
    if (n >= 0)
        qdot_sheet_words(s, many != NULL ? many : few);
    qdot_free(many);
}

/* Append a text to the present line of the answer, and free the text. */
static void
add_text_to_sheet(qdot_sheet *s, qdot_text *text)
{
    qdot_sheet_words(s, qdot_text_str(text));
    s->formula.failed = s->formula.failed || text->failed;
    qdot_text_clear(text);
}

void
qdot_sheet_double(qdot_sheet *s, double x, int digits)
{
    qdot_text number = {0};

    qdot_text_double(&number, x, digits);
    add_text_to_sheet(s, &number);
}

void
qdot_sheet_known(qdot_sheet *s, double x, double error)
{
    qdot_text number = {0};

    qdot_number_text_known(&number, x, error);
    add_text_to_sheet(s, &number);
}

void
qdot_sheet_open(qdot_sheet *s)
{
    if (s->typeset != NULL)
        qdot_sheet_open(s->typeset);
    s->at = qdot_formula_add(&s->formula, s->line, QDOT_FORMULA_SPAN, 0, 0);
}

void
qdot_sheet_close(qdot_sheet *s)
{
    if (s->typeset != NULL)
        qdot_sheet_close(s->typeset);
    s->at = s->line;
}

void
qdot_sheet_sign(qdot_sheet *s, qdot_formula_sign sign)
{
    if (s->typeset != NULL)
        qdot_sheet_sign(s->typeset, sign);
    qdot_formula_add_sign(&s->formula, s->at, sign);
}

qdot_status
qdot_sheet_expr(qdot_sheet *s, qdot_expr e)
{
    if (s->typeset != NULL)
        QDOT_TRY(qdot_sheet_expr(s->typeset, e));
    return qdot_expression_add(s->session, e, s->notation, &s->formula, s->at);
}

/* Append a name such that a line may break after each of its words. */
static qdot_status
add_name_by_words(qdot_sheet *s, const char *name, unsigned flags)
{
    const size_t from = s->formula.nodes.n;
    qdot_text text = {0};
    const qdot_status status = qdot_typed_name_print(s->session, name, s->style, &text);

    if (status == QDOT_OK)
        add_words_to_sheet(s, qdot_text_str(&text), text.n);
    for (size_t i = from; i < s->formula.nodes.n; i++)
        s->formula.nodes.at[i].flags |= (uint8_t)flags;
    qdot_text_clear(&text);
    return status;
}

qdot_status
qdot_sheet_name(qdot_sheet *s, const char *name, unsigned flags)
{
    if (s->typeset != NULL)
        QDOT_TRY(qdot_sheet_name(s->typeset, name, flags));
    if (s->form == QDOT_SHEET_DRAWN)
        return add_name_by_words(s, name, flags);
    return qdot_typed_name_add(s->session, name, s->style, &s->formula, s->at, flags);
}

qdot_status
qdot_sheet_formula(qdot_sheet *s, qdot_expr e)
{
    qdot_sheet_open(s);
    QDOT_TRY(qdot_sheet_expr(s, e));
    qdot_sheet_close(s);
    return QDOT_OK;
}

qdot_status
qdot_sheet_each(qdot_sheet *s, qdot_status (*write)(qdot_sheet *one, void *data), void *data)
{
    struct qdot_sheet *const typeset = s->typeset;
    qdot_status status;

    s->typeset = NULL; /* what `write` adds to one is not added to the other */
    status = write(s, data);
    if (status == QDOT_OK && typeset != NULL)
        status = write(typeset, data);
    s->typeset = typeset;
    return status;
}

bool
qdot_sheet_at_begin(const qdot_sheet *s)
{
    return qdot_formula_child(&s->formula, s->line, 0) == 0;
}

bool
qdot_sheet_is_empty(const qdot_sheet *s)
{
    return qdot_sheet_at_begin(s) &&
           qdot_formula_child(&s->formula, s->lines, 0) == s->line;
}

/* --- lines of text ------------------------------------------------------------------------- */

/* Append a formula to a text, with its name in colour. */
static qdot_status
write_formula(const qdot_sheet *s, qdot_formula_id formula, bool colours, qdot_text *out)
{
    const qdot_formula *f = &s->formula;

    qdot_text_add(out, s->style == QDOT_MATHML ? QDOT_FORMULA_MATH : "");
    for (qdot_formula_id c = 0; (c = qdot_formula_child(f, formula, c)) != 0;) {
        const bool painted =
            colours && (qdot_formula_at(f, c)->flags & QDOT_FORMULA_LABEL);

        qdot_text_add(out, painted ? QDOT_NAME_COLOUR : "");
        QDOT_TRY(qdot_print_written(f, c, s->style, out));
        qdot_text_add(out, painted ? QDOT_COLOUR_END : "");
    }
    qdot_text_add(out, s->style == QDOT_MATHML ? QDOT_FORMULA_MATH_END : "");
    return qdot_text_status(out);
}

static qdot_status
write_line(const qdot_sheet *s, qdot_formula_id line, bool colours, qdot_text *out)
{
    const qdot_formula *f = &s->formula;

    for (qdot_formula_id c = 0; (c = qdot_formula_child(f, line, c)) != 0;) {
        const qdot_formula_node *node = qdot_formula_at(f, c);

        if (node->kind == QDOT_FORMULA_TEXT)
            qdot_text_add_n(out, f->text.at + node->child, node->n);
        else
            QDOT_TRY(write_formula(s, c, colours, out));
    }
    return qdot_text_status(out);
}

static qdot_status
write_lines(const qdot_sheet *s, bool colours, qdot_text *out)
{
    bool first = true;

    QDOT_TRY(qdot_formula_status(&s->formula));
    for (qdot_formula_id line = 0;
         (line = qdot_formula_child(&s->formula, s->lines, line)) != 0; first = false) {
        qdot_text_add(out, first ? "" : "\n");
        QDOT_TRY(write_line(s, line, colours, out));
    }
    return qdot_text_status(out);
}

/* Whether `line` is an empty last line, which only follows the last line break. */
static bool
is_empty_last_line(const qdot_sheet *s, qdot_formula_id line)
{
    return line == s->line && qdot_sheet_at_begin(s);
}

/* --- on a terminal --------------------------------------------------------------------------- */

static bool
has_formula(const qdot_formula *f, qdot_formula_id line)
{
    for (qdot_formula_id c = 0; (c = qdot_formula_child(f, line, c)) != 0;)
        if (qdot_formula_at(f, c)->kind != QDOT_FORMULA_TEXT)
            return true;
    return false;
}

static qdot_status
lay_out_lines(const qdot_sheet *s, qdot_text *out, qdot_layout_size *size)
{
    const bool colours = qdot_write_colours(s->session);
    const qdot_layout_request request = {.width = s->columns,
                                         .shown = s->whole ? SIZE_MAX : s->rows,
                                         .paint = colours ? QDOT_NAME_COLOUR : NULL,
                                         .end = QDOT_COLOUR_END};
    const qdot_formula *f = &s->formula;

    QDOT_TRY(qdot_formula_status(f));
    for (qdot_formula_id line = 0; (line = qdot_formula_child(f, s->lines, line)) != 0;) {
        const size_t from = out->n;

        if (is_empty_last_line(s, line))
            break;
        if (has_formula(f, line)) {
            QDOT_TRY(qdot_layout_part(f, line, &request, out, size));
            continue;
        }
        QDOT_TRY(write_line(s, line, false, out));
        if (out->n > from &&
            qdot_utf8_columns(out->at + from, out->n - from) > s->columns) {
            qdot_text_truncate(out, from);
            QDOT_TRY(qdot_layout_part(f, line, &request, out, size));
        } else {
            qdot_text_char(out, '\n');
            size->lines++;
        }
    }
    return qdot_text_status(out);
}

/* If the text is higher than the terminal: keep its first half, with a note how long it is and how
 * to see all. */
static void
shorten_to_terminal(const qdot_sheet *s, const qdot_layout_size *size, qdot_text *text)
{
    const size_t shown = s->rows / 2;
    qdot_text last = {0};
    size_t at = 0;

    if (s->whole || size->lines < s->rows || qdot_text_status(text) != QDOT_OK)
        return;
    for (size_t i = 0; i < shown; i++)
        at += strcspn(text->at + at, "\n") + 1;
    qdot_text_truncate(text, at);
    qdot_text_format(&last, "... %zu of %zu lines", shown, size->lines);
    if (s->operations > 0)
        qdot_text_format(&last, ", %" PRIu64 " operations", s->operations);
    qdot_text_add(&last,
                  "; `% to \"all.txt\"` writes all of it, `style flat` shows it\n");
    qdot_wrap(qdot_text_str(&last), s->columns, text);
    text->failed = text->failed || last.failed;
    qdot_text_clear(&last);
}

/* --- finishing an answer --------------------------------------------------------------- */

static qdot_status
print_sheet(const qdot_sheet *s, const char *name)
{
    qdot_layout_size size = {0};
    qdot_text drawn = {0};
    const qdot_status status = lay_out_lines(s, &drawn, &size);

    if (status == QDOT_OK)
        shorten_to_terminal(s, &size, &drawn);
    return qdot_answer_drawn(s->session, name, status, &drawn);
}

/* Find the page block (LaTeX or MathML) for the equations of the present statement; make it if it is missing. */
static qdot_formula_page *
find_or_make_page_block(qdot_session *session)
{
    if (session->output->block == NULL) {
        session->output->block = qdot_calloc(1, sizeof *session->output->block);
        if (session->output->block == NULL)
            return NULL;
        session->output->block->kind =
            session->output->style == QDOT_LATEX ? QDOT_PAGE_LATEX : QDOT_PAGE_MATHML;
        session->output->block->paint = qdot_write_colours(session) ? QDOT_NAME_COLOUR : NULL;
        session->output->block->end = QDOT_COLOUR_END;
    }
    return session->output->block;
}

static qdot_status
add_lines_to_page(const qdot_sheet *s, qdot_formula_page *page)
{
    QDOT_TRY(qdot_formula_status(&s->formula));
    for (qdot_formula_id line = 0;
         (line = qdot_formula_child(&s->formula, s->lines, line)) != 0;)
        if (!is_empty_last_line(s, line))
            qdot_formula_page_line(page, &s->formula, line);
    return page->status;
}

static qdot_status
add_sheet_to_page(const qdot_sheet *s)
{
    qdot_formula_page *page = s->page != NULL ? s->page : find_or_make_page_block(s->session);

    return page != NULL ? add_lines_to_page(s, page) : QDOT_ENOMEM;
}

/* Append the answer as a part of a page of HTML. */
static qdot_status
write_html(const qdot_sheet *s, qdot_text *out)
{
    qdot_formula_page page = {.kind = QDOT_PAGE_MATHML};
    qdot_status status = add_lines_to_page(s, &page);

    if (status == QDOT_OK)
        status = qdot_formula_page_end(&page, out);
    qdot_formula_page_clear(&page);
    return status;
}

/* Answer lines of text, with the part of a page of HTML in which they are typeset. */
static qdot_status
answer_typeset(const qdot_sheet *s, const char *name, const qdot_text *lines)
{
    qdot_text html = {0};
    qdot_status status = write_html(s->typeset, &html);

    if (status == QDOT_OK)
        status = qdot_answer_typeset(s->session, name, qdot_text_str(lines), qdot_text_str(&html));
    qdot_text_clear(&html);
    return status;
}

qdot_status
qdot_sheet_html(qdot_sheet *s, qdot_status status, qdot_text *out)
{
    if (status == QDOT_OK)
        status = write_html(s, out);
    qdot_sheet_clear(s);
    return status;
}

qdot_status
qdot_sheet_text(qdot_sheet *s, qdot_status status, qdot_text *out)
{
    if (status == QDOT_OK)
        status = write_lines(s, false, out);
    qdot_sheet_clear(s);
    return status;
}

qdot_status
qdot_sheet_end(qdot_sheet *s, const char *name, qdot_status status)
{
    qdot_text lines = {0};

    if (status == QDOT_OK && s->form == QDOT_SHEET_PAGE)
        status = add_sheet_to_page(s);
    else if (status == QDOT_OK && s->form == QDOT_SHEET_DRAWN)
        status = print_sheet(s, name);
    else if (status == QDOT_OK && s->typeset != NULL) {
        status = write_lines(s, false, &lines);
        if (status == QDOT_OK)
            status = answer_typeset(s, name, &lines);
        qdot_text_clear(&lines);
    } else if (status == QDOT_OK)
        status = (s->broken ? qdot_answer_written : qdot_answer_drawn)(
            s->session, name, write_lines(s, qdot_write_colours(s->session), &lines),
            &lines);
    qdot_sheet_clear(s);
    return status;
}

void
qdot_sheet_forget(qdot_session *session)
{
    if (session->output->block != NULL)
        qdot_formula_page_clear(session->output->block);
    qdot_free(session->output->block);
    session->output->block = NULL;
}

qdot_status
qdot_sheet_flush(qdot_session *session)
{
    qdot_text page = {0};
    qdot_status status;

    if (session->output->block == NULL)
        return QDOT_OK;
    status = qdot_formula_page_end(session->output->block, &page);
    qdot_sheet_forget(session);
    return qdot_answer_drawn(session, "formulas", status, &page);
}
