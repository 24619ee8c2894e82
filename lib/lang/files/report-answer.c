/* report-answer.c -- collects the answers of statements for the page of a report. */
#include "lang/files/report-answer.h"

#include <stdlib.h>
#include <string.h>

#include "lang/session/history.h"
#include "lang/session/output.h"
#include "lang/syntax/match.h"
#include "show/animation.h"

qdot_status
qdot_report_answer_begin(qdot_session *s, qdot_style style, qdot_report_answer *k)
{
    *k = (qdot_report_answer){.out = s->output->out,
                .console = s->output->console,
                .json = s->output->json,
                .console_json = s->output->console_json,
                .style = s->output->style,
                .page = {.kind = QDOT_PAGE_REPORT},
                .page_before = s->output->page,
                .history = s->history->values.n,
                .history_over = s->history->over.n};
    k->file = open_memstream(&k->text, &k->length);
    if (k->file == NULL)
        return qdot_fail(QDOT_ENOMEM, "no memory for the report");
    if (s->output->console == NULL) {
        s->output->console = s->output->out;
        s->output->console_json = s->output->json;
    }
    s->output->out = k->file;
    s->output->json = false;
    s->output->style = style;
    s->output->page = style == QDOT_MATHML ? &k->page : NULL;
    return QDOT_OK;
}

qdot_status
qdot_report_answer_end(qdot_session *s, qdot_report_answer *k, qdot_status status,
                       qdot_text *text)
{
    bool whole = fclose(k->file) == 0;

    s->output->out = k->out;
    s->output->console = k->console;
    s->output->json = k->json;
    s->output->console_json = k->console_json;
    s->output->style = k->style;
    s->output->page = k->page_before;
    s->history->values.n = k->history;
    if (s->history->over.n > k->history_over)
        s->history->over.n = k->history_over;
    if (status == QDOT_OK && !whole)
        status = qdot_fail(QDOT_ENOMEM, "no memory for the report");
    if (status == QDOT_OK) {
        qdot_text_add_n(text, k->text, k->length);
        status = qdot_formula_page_end(&k->page, text);
    } else if (qdot_grave(status) == QDOT_OK) {
        status = qdot_report_not_found(text);
    }
    qdot_formula_page_clear(&k->page);
    free(k->text); /* allocated by open_memstream */
    return status;
}

qdot_status
qdot_report_answer_of(const qdot_cursor *cursor, const qdot_statement *statement, qdot_text *text)
{
    qdot_record r = qdot_record_alone(cursor, statement);
    qdot_report_answer k;

    QDOT_TRY(qdot_report_answer_begin(cursor->session, QDOT_MATHML, &k));
    return qdot_report_answer_end(cursor->session, &k, qdot_match_handle(statement, &r), text);
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
