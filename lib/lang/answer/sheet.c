/* sheet.c -- answers in which formulas stand, for a terminal, a text, a page. */
#include "lang/answer/sheet.h"

#include <inttypes.h>
#include <string.h>

#include "base/terminal.h"
#include "base/utf8.h"
#include "base/wrap.h"
#include "formula/write.h"
#include "lang/answer/formula.h"
#include "lang/answer/write.h"
#include "show/formula-page.h"
#include "show/layout.h"

/* Whether answers are blocks of aligned equations that are not a file's. */
static bool
makes_blocks(const qdot_session *session)
{
    return !session->json && !session->marked && !session->flat &&
           (session->style == QDOT_LATEX || session->style == QDOT_MATHML);
}

qdot_sheet
qdot_sheet_begin(qdot_session *session)
{
    qdot_sheet s = {.style = session->style, .marked = session->marked};

    s.laid_out = session->style == QDOT_UNICODE && !session->flat && !session->json &&
                 qdot_terminal_size(qdot_write_stream(session),
                                    &s.columns, &s.rows);
    session->marked = session->marked || makes_blocks(session);
    if (s.laid_out)
        session->style = QDOT_MATHML;
    return s;
}

/* --- on a terminal --------------------------------------------------------------------- */

/* A line may end behind each word. */
void
qdot_sheet_words(const char *text, size_t n, qdot_text *out)
{
    while (n > 0) {
        const size_t blanks = strspn(text, " ");
        size_t word = blanks + strcspn(text + blanks, " ");

        word = word < n ? word + 1 : n; /* with the blank behind it */
        qdot_text_add(out, "<mtext>");
        qdot_formula_escape(text, word, out);
        qdot_text_add(out, "</mtext>");
        text += word;
        n -= word;
    }
}

/* One line as one formula; false: there is none in it. */
static bool
as_formula(const char *line, size_t n, qdot_text *out)
{
    static const char begin[] = QDOT_PRINT_MATH, end[] = "</math>";
    const char *const stop = line + n;
    bool any = false;

    while (line < stop) {
        const char *open = memmem(line, (size_t)(stop - line), begin, sizeof begin - 1);
        const char *close = NULL;

        if (open != NULL)
            close = memmem(open, (size_t)(stop - open), end, sizeof end - 1);
        if (close == NULL) {
            qdot_sheet_words(line, (size_t)(stop - line), out);
            return any;
        }
        qdot_sheet_words(line, (size_t)(open - line), out);
        qdot_text_add_n(out, open + sizeof begin - 1,
                        (size_t)(close - open) - (sizeof begin - 1));
        line = close + sizeof end - 1;
        any = true;
    }
    return any;
}

/* The contents of a line that is one formula and no more, which is ended there; NULL: it is not. */
static char *
only_formula(char *line, size_t n)
{
    static const char begin[] = QDOT_PRINT_MATH, end[] = "</math>";
    const size_t first = sizeof begin - 1, last = sizeof end - 1;
    char *const inside = line + first;

    if (n < first + last || memcmp(line, begin, first) != 0 ||
        memmem(inside, n - first, end, last) != line + n - last)
        return NULL;
    line[n - last] = '\0';
    return inside;
}

/* The lines, which are written over. */
static qdot_status
lay_out(const qdot_session *session, const qdot_sheet *s, char *at, qdot_text *out,
        qdot_layout_size *size)
{
    const bool colours = qdot_write_colours(session);
    const qdot_layout_request request = {.width = s->columns,
                                         .shown = s->whole ? SIZE_MAX : s->rows,
                                         .paint = colours ? QDOT_NAME_COLOUR : NULL,
                                         .end = QDOT_COLOUR_END};
    qdot_text formula = {0};
    qdot_status status = QDOT_OK;

    while (*at != '\0' && status == QDOT_OK) {
        const size_t n = strcspn(at, "\n");
        const bool more = at[n] == '\n';
        const char *const only = only_formula(at, n);

        qdot_text_truncate(&formula, 0);
        if (only != NULL) {
            status = qdot_layout_part(only, &request, out, size);
        } else if (as_formula(at, n, &formula) || qdot_utf8_columns(at, n) > s->columns) {
            status = qdot_text_status(&formula);
            if (status == QDOT_OK)
                status = qdot_layout_part(formula.at, &request, out, size);
        } else {
            qdot_text_add_n(out, at, n);
            qdot_text_char(out, '\n');
            size->lines++;
        }
        at += n + more;
    }
    qdot_text_clear(&formula);
    return status;
}

/* What is higher than the terminal: its first half, how much it is, and how all of it is seen. */
static void
sheet_cut(const qdot_sheet *s, const qdot_layout_size *size, qdot_text *text)
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
    qdot_text_add(&last, "; `% to \"all.txt\"` writes all of it, `style flat` shows it\n");
    qdot_wrap(qdot_text_str(&last), s->columns, text);
    text->failed = text->failed || last.failed;
    qdot_text_clear(&last);
}

/* --- the end --------------------------------------------------------------------------- */

static qdot_status
sheet_draw(qdot_session *session, const qdot_sheet *s, const char *name, qdot_text *lines)
{
    qdot_layout_size size = {0};
    qdot_text drawn = {0};
    qdot_status status =
        lines->n > 0 ? lay_out(session, s, lines->at, &drawn, &size) : QDOT_OK;

    if (status == QDOT_OK)
        sheet_cut(s, &size, &drawn);
    return qdot_answer_drawn(session, name, status, &drawn);
}

qdot_status
qdot_sheet_end(qdot_session *session, const qdot_sheet *s, const char *name,
               qdot_status status, qdot_text *lines)
{
    const bool block = session->marked && !s->marked;

    session->style = s->style;
    session->marked = s->marked;
    if (status == QDOT_OK)
        status = qdot_text_status(lines);
    if (status == QDOT_OK && block) {
        qdot_text_add(&session->block, qdot_text_str(lines));
        if (lines->n > 0 && lines->at[lines->n - 1] != '\n')
            qdot_text_char(&session->block, '\n');
        status = qdot_text_status(&session->block);
    } else if (status == QDOT_OK && s->laid_out) {
        status = sheet_draw(session, s, name, lines);
    } else {
        return (session->flat ? qdot_answer_drawn : qdot_answer_written)(session, name, status,
                                                                         lines);
    }
    qdot_text_clear(lines);
    return status;
}

qdot_status
qdot_sheet_flush(qdot_session *session)
{
    qdot_text lines = session->block, page = {0};
    qdot_status status;

    if (lines.n == 0)
        return QDOT_OK;
    session->block = (qdot_text){0};
    status = session->style == QDOT_LATEX
                 ? qdot_page_latex(qdot_text_str(&lines), &page)
                 : qdot_page_mathml(qdot_text_str(&lines), &page);
    qdot_text_clear(&lines);
    return qdot_answer_drawn(session, "formulas", status, &page);
}
