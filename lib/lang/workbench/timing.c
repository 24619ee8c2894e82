/* timing.c -- the statement `timing`: turns the report of each statement's CPU time on or off. */
#include "lang/workbench/timing.h"

#include "expr/pool.h"
#include "lang/answer/answer.h"
#include "lang/session/output.h"
#include "lang/syntax/record.h"

static qdot_status
carry_out_timing(qdot_record *r)
{
    r->cursor.session->output->timing = qdot_record_word(r, "on") != NULL;
    return QDOT_OK;
}

QDOT_STATEMENT(timing) = {
    .word = "timing",
    .group = QDOT_WORKBENCH,
    .usage = "timing on | off",
    .summary = "print the CPU time of every statement",
    .example = "timing on",
    .handler = carry_out_timing,
};

void
qdot_timing_report(qdot_session *session, clock_t since)
{
    qdot_text text = {0};
    const double s = (double)(clock() - since) / CLOCKS_PER_SEC;

    qdot_text_add(&text, "cpu ");
    qdot_text_double(&text, s * 1e3, 3);
    qdot_text_format(&text, " ms; %zu nodes in ", qdot_pool_count(session->pool));
    qdot_text_double(&text, (double)qdot_pool_bytes(session->pool) / 1e6, 3);
    qdot_text_add(&text, " MB");
    (void)!qdot_answer_text(session, "timing", qdot_text_str(&text));
    qdot_text_clear(&text);
}
