/* steady.c -- the statement `steady`: lists the steady motions of the scene, with their stability. */
#include "lang/ask/equilibria.h"
#include "lang/session/history.h"
#include "lang/syntax/record.h"

static qdot_status carry_out_steady(qdot_record *r);

QDOT_STATEMENT(steady) = {
    .word = "steady",
    .group = QDOT_ASKING,
    .usage = "steady [in Q']",
    .summary = "the steady motions, with their stability: the rates of cyclic coordinates constant, all others at rest; solved "
               "for the coordinates, or for a rate",
    .example = "steady in phi'",
    .alone = true,
    .nameable = true,
    .linear = true,
    .handler = carry_out_steady,
};

static qdot_status
carry_out_steady(qdot_record *r)
{
    const qdot_filled *rate = qdot_record_hole(r, "in", NULL);
    qdot_expr *in = &r->cursor.session->history->steady_in, unknown = QDOT_NIL;
    const qdot_expr before = *in;
    qdot_status status;

    if (rate != NULL)
        QDOT_TRY(qdot_record_coordinate(r, rate, &unknown));
    *in = unknown;
    status = qdot_equilibria_answer(r, qdot_equilibria_steady, "steady motion");
    if (status != QDOT_OK) /* steady[1] stays one of the list that was answered */
        *in = before;
    return status;
}
