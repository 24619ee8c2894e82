/* timing.c -- the statement `timing`: turns the report of each statement's CPU time on or off. */
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
