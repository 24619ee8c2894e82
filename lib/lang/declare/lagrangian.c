/* lagrangian.c -- the statement `lagrangian`: states the Lagrangian. */
#include "base/text.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "lang/answer/answer.h"
#include "lang/syntax/record.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/scene.h"

static qdot_status declare_lagrangian(qdot_record *r);

QDOT_STATEMENT(lagrangian) = {
    .word = "lagrangian",
    .group = QDOT_DECLARING,
    .usage = "lagrangian L",
    .summary = "state the Lagrangian itself, in place of particles and bodies; it may hold second and higher derivatives",
    .example = "lagrangian m*x'^2/2 - k*x^2/2",
    .handler = declare_lagrangian,
};

/* Say that a total derivative was left out of the Lagrangian that was given, if it was. */
static qdot_status
tell_left_out(qdot_session *session, qdot_expr given)
{
    const qdot_expr L = qdot_mech_lagrangian(session->scene);
    qdot_text text = {0};
    qdot_status status;

    if (L == qdot_higher_in_motion(session->scene, given))
        return qdot_pool_check(session->pool);
    status = qdot_print(session->pool, L, QDOT_PLAIN, &text);
    if (status == QDOT_OK)
        status = qdot_text_status(&text);
    if (status == QDOT_OK)
        status = qdot_answer_notice(session, "a total derivative is left out, which adds nothing to the equations: L is %s",
                                    qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

static qdot_status
declare_lagrangian(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_expr L;
    bool higher;

    QDOT_TRY(qdot_record_scalar(r, qdot_record_hole(r, NULL, "L"), &L));
    L = qdot_higher_in_jets(session->scene, L);
    QDOT_TRY(qdot_pool_check(session->pool));
    higher = (qdot_expr_node(session->pool, L)->holds & QDOT_HAS_ACCELERATION) != 0;
    r->cursor.error_at = r->start->start;
    QDOT_TRY(qdot_scene_lagrangian(session->scene, L));
    return higher ? tell_left_out(session, L) : QDOT_OK;
}
