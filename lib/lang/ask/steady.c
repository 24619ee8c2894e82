/* steady.c -- the statement `steady`: lists the steady motions of the scene, with their stability. */
#include "lang/ask/equilibria.h"
#include "lang/session/history.h"
#include "lang/syntax/record.h"

static qdot_status carry_out_steady(qdot_record *r);

QDOT_STATEMENT(steady) = {
    .word = "steady",
    .group = QDOT_ASKING,
    .usage = "steady",
    .summary = "the steady motions, with their stability: the rates of cyclic coordinates constant, all others at rest",
    .example = "steady",
    .alone = true,
    .nameable = true,
    .handler = carry_out_steady,
};

static qdot_status
carry_out_steady(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_equilibria all;
    qdot_expr value;
    qdot_status status;

    r->cursor.error_at = r->start[-1].start; /* errors point at the word `steady` */
    status = qdot_equilibria_steady(session, &all);
    if (status == QDOT_OK)
        status = qdot_equilibria_list(session, &all, &value);
    if (status == QDOT_OK)
        status = qdot_vec_push(&session->history->values, value);
    if (status == QDOT_OK)
        status = qdot_equilibria_answer(session, "steady", "steady motion", &all);
    qdot_equilibria_clear(&all);
    return status;
}
