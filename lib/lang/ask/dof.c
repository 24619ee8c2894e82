/* dof.c -- the statement `dof`: lists coordinates and constraints, and counts the degrees of freedom. */
#include "expr/exact.h"
#include "lang/answer/answer.h"
#include "lang/declare/constraints.h"
#include "lang/session/history.h"
#include "lang/syntax/record.h"

static qdot_status carry_out_dof(qdot_record *r);

QDOT_STATEMENT(dof) = {
    .word = "dof",
    .group = QDOT_ASKING,
    .usage = "dof",
    .summary = "coordinates, independent constraints, degrees of freedom",
    .example = "dof",
    .alone = true,
    .handler = carry_out_dof,
};

static qdot_status
carry_out_dof(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_expr value;
    qdot_text text = {0};
    qdot_dof dof;

    QDOT_TRY(qdot_mech_dof(session->scene, &dof));
    value = qdot_expr_int(session->pool, (int64_t)dof.freedom);
    QDOT_TRY(qdot_pool_check(session->pool));
    QDOT_TRY(qdot_vec_push(&session->history->values, value));
    QDOT_TRY(qdot_answer_expr(session, "dof", value));
    qdot_text_format(&text,
                     "coordinates %zu, constraints %zu, of them independent %zu: "
                     "n = %zu - %zu = %zu",
                     dof.coordinates, dof.constraints, dof.independent, dof.coordinates,
                     dof.independent, dof.freedom);
    if (dof.states > 0)
        qdot_text_format(&text, "\nstates of first order: %zu", dof.states);
    if (dof.cartesian)
        qdot_text_format(&text, "\nn = N*D - C = %zu*%zu - %zu = %zu", dof.particles,
                         dof.dimension, dof.independent, dof.freedom);
    qdot_constraints_print_redundant(session->scene, &dof, &text);
    return qdot_answer_written(session, "dof", QDOT_OK, &text);
}
