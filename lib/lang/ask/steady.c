/* steady.c -- the statement `steady`: lists the steady motions of the scene, with their stability. */
#include "lang/ask/equilibria.h"

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
    return qdot_equilibria_answer(r, qdot_equilibria_steady, "steady motion");
}
