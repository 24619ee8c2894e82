/* report-answer.c -- collects the answers of statements for the page of a report. */
#include "lang/files/report-answer.h"

#include <stdlib.h>
#include <string.h>

#include "show/animation.h"

qdot_status
qdot_report_answer_begin(qdot_session *s, qdot_style style, qdot_report_answer *k)
{
    *k = (qdot_report_answer){.out = s->out,
                .console = s->console,
                .json = s->json,
                .console_json = s->console_json,
                .style = s->style,
                .page = {.kind = QDOT_PAGE_REPORT},
                .page_before = s->page,
                .history = s->history.n,
                .history_over = s->history_over.n};
    k->file = open_memstream(&k->text, &k->length);
    if (k->file == NULL)
        return qdot_fail(QDOT_ENOMEM, "no memory for the report");
    if (s->console == NULL) {
        s->console = s->out;
        s->console_json = s->json;
    }
    s->out = k->file;
    s->json = false;
    s->style = style;
    s->page = style == QDOT_MATHML ? &k->page : NULL;
    return QDOT_OK;
}

qdot_status
qdot_report_answer_end(qdot_session *s, qdot_report_answer *k, qdot_status status,
                       qdot_text *text)
{
    bool whole = fclose(k->file) == 0;

    s->out = k->out;
    s->console = k->console;
    s->json = k->json;
    s->console_json = k->console_json;
    s->style = k->style;
    s->page = k->page_before;
    s->history.n = k->history;
    if (s->history_over.n > k->history_over)
        s->history_over.n = k->history_over;
    if (status == QDOT_OK && !whole)
        status = qdot_fail(QDOT_ENOMEM, "no memory for the report");
    if (status == QDOT_OK) {
        qdot_text_add_n(text, k->text, k->length);
        status = qdot_formula_page_end(&k->page, text);
    } else if (qdot_grave(status) == QDOT_OK) {
        status = qdot_report_not_found(text);
    }
    qdot_formula_page_clear(&k->page);
    free(k->text); /* from open_memstream */
    return status;
}

qdot_status
qdot_report_answer_of(const qdot_cursor *cursor, const qdot_statement *statement, qdot_text *text)
{
    qdot_record r = qdot_record_alone(cursor, statement);
    qdot_report_answer k;

    QDOT_TRY(qdot_report_answer_begin(cursor->session, QDOT_MATHML, &k));
    return qdot_report_answer_end(cursor->session, &k, statement->handler(&r), text);
}

qdot_status
qdot_report_line(qdot_text *page, const char *words)
{
    qdot_formula_page p = {.kind = QDOT_PAGE_REPORT};
    qdot_status status;

    qdot_formula_page_text(&p, words, strlen(words));
    status = qdot_formula_page_end(&p, page);
    qdot_formula_page_clear(&p);
    return status;
}

qdot_status
qdot_report_not_found(qdot_text *page)
{
    qdot_text words = {0};
    qdot_status status;

    qdot_text_format(&words, "Not found: %s", qdot_last_error()->message);
    status = qdot_text_status(&words);
    if (status == QDOT_OK)
        status = qdot_report_line(page, words.at);
    qdot_text_clear(&words);
    return status;
}

void
qdot_report_heading(qdot_text *page, const char *title)
{
    qdot_text_add(page, "<h2>");
    qdot_animation_escape(page, title);
    qdot_text_add(page, "</h2>\n");
}
