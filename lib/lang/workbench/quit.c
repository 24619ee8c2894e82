/* quit.c -- the statement `quit`: ends the script or the session. */
#include "lang/session/outcome.h"
#include "lang/syntax/record.h"

static qdot_status
carry_out_quit(qdot_record *r)
{
    r->cursor.session->outcome->quit = true;
    return QDOT_OK;
}

QDOT_STATEMENT(quit) = {
    .word = "quit",
    .group = QDOT_WORKBENCH,
    .usage = "quit",
    .summary = "leave",
    .example = "quit",
    .alone = true,
    .handler = carry_out_quit,
};
