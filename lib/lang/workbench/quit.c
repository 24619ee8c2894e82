/* quit.c -- `quit`: no statement is carried out any more. */
#include "lang/commands/statement.h"
#include "lang/syntax/record.h"

static qdot_status
quit_leave(qdot_record *r)
{
    r->cursor.session->quit = true;
    return QDOT_OK;
}

const qdot_statement qdot_statement_quit = {
    .word = "quit",
    .group = QDOT_WORKBENCH,
    .usage = "quit",
    .summary = "leave",
    .example = "quit",
    .alone = true,
    .handler = quit_leave,
};
