/* output.c -- the statement `output`: expressions that are observed, for the matrices C and D of `linearize`. */
#include "base/memory.h"
#include "lang/syntax/record.h"
#include "mech/scene/scene.h"

static qdot_status declare_outputs(qdot_record *r);

QDOT_STATEMENT(output) = {
    .word = "output",
    .group = QDOT_DECLARING,
    .usage = "output EXPR, ...",
    .summary = "what is observed, for C and D of `linearize`; said again it replaces the outputs before",
    .example = "output theta, x'",
    .nameable = true,
    .handler = declare_outputs,
};

static qdot_status
declare_outputs(qdot_record *r)
{
    qdot_vec(qdot_expr) list = {0};
    qdot_status status = QDOT_OK;

    for (const qdot_filled *part = qdot_record_hole(r, NULL, "EXPR"); part != NULL && status == QDOT_OK;
         part = qdot_record_next(r, part, "EXPR")) {
        qdot_expr e;

        status = qdot_record_scalar(r, part, &e);
        if (status == QDOT_OK)
            status = qdot_vec_push(&list, e);
    }
    if (status == QDOT_OK)
        status = qdot_scene_outputs(r->cursor.session->scene, list.n, list.at);
    qdot_free(list.at);
    return status;
}
