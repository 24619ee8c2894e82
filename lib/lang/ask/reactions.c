/* reactions.c -- the statement `reactions`: lists the constraints' forces on each particle and body. */
#include "mech/study/reactions.h"

#include "expr/node.h"
#include "lang/answer/answer.h"
#include "lang/answer/sheet.h"
#include "lang/session/history.h"
#include "lang/session/output.h"
#include "lang/syntax/record.h"
#include "mech/scene/body-joint.h"

static qdot_status carry_out_reactions(qdot_record *r);

QDOT_STATEMENT(reactions) = {
    .word = "reactions",
    .group = QDOT_ASKING,
    .usage = "reactions",
    .summary = "the constraints' forces on each particle and body, by their multipliers",
    .example = "reactions",
    .alone = true,
    .handler = carry_out_reactions,
};

static bool
is_zero_reaction(const qdot_pool *pool, qdot_expr e)
{
    for (uint32_t i = 0; qdot_expr_kind(pool, e) == QDOT_VEC; i++) {
        if (i == qdot_expr_count(pool, e))
            return true;
        if (qdot_expr_arg(pool, e, i) != QDOT_ZERO)
            return false;
    }
    return e == QDOT_ZERO;
}

static qdot_status
print_reaction(qdot_sheet *sheet, const qdot_reaction *r)
{
    qdot_pool *pool = sheet->session->pool;

    if (r->name == NULL)
        QDOT_TRY(qdot_sheet_formula(sheet, r->coordinate));
    else
        qdot_sheet_words(sheet, r->name);
    if (r->name == NULL || r->torque == QDOT_NIL || !is_zero_reaction(pool, r->force)) {
        qdot_sheet_words(sheet, r->name == NULL ? ": generalized reaction " : ": force ");
        QDOT_TRY(qdot_sheet_formula(sheet, r->force));
        if (r->torque == QDOT_NIL || is_zero_reaction(pool, r->torque))
            return QDOT_OK;
        qdot_sheet_words(sheet, " at its centre, torque ");
    } else {
        qdot_sheet_words(sheet, ": torque ");
    }
    return qdot_sheet_formula(sheet, r->torque);
}

/* The force and the torque of each joint on its second body, where the multipliers tell them. */
static qdot_status
print_joints(qdot_sheet *sheet, size_t before)
{
    qdot_scene *scene = sheet->session->scene;

    for (size_t i = 0; i < scene->joints.n; i++) {
        const qdot_body_joint *joint = &scene->joints.at[i];
        qdot_expr force, torque;
        const qdot_status status = qdot_body_joint_reaction(scene, joint, &force, &torque);

        if (status == QDOT_EINVAL)
            continue;
        QDOT_TRY(status);
        qdot_sheet_format(sheet, "%s%s on %s: force ", before++ > 0 ? "\n" : "", joint->name,
                          joint->end[1] != NULL ? joint->end[1] : "the ground");
        QDOT_TRY(qdot_sheet_formula(sheet, force));
        if (is_zero_reaction(sheet->session->pool, torque))
            continue;
        qdot_sheet_words(sheet, " at the joint, torque ");
        QDOT_TRY(qdot_sheet_formula(sheet, torque));
    }
    return QDOT_OK;
}

static qdot_status
carry_out_reactions(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_reaction *list = NULL;
    qdot_sheet sheet;
    qdot_status status;
    qdot_expr value;
    size_t n = 0;

    if (session->scene->constraints.n == 0) {
        (void)qdot_fail(QDOT_EINVAL, "the scene has no constraints");
        return qdot_hint("constraint rod: x^2 + y^2 = L^2");
    }
    value = qdot_mech_reaction_list(session->scene);
    QDOT_TRY(qdot_pool_check(session->pool));
    QDOT_TRY(qdot_vec_push(&session->history->values, value));
    if (session->output->json && !session->output->display) /* the lines below say the same */
        QDOT_TRY(qdot_answer_expr(session, "reactions", value));
    status = qdot_mech_reactions(session->scene, &list, &n);
    sheet = qdot_sheet_begin(session);
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        qdot_sheet_words(&sheet, i > 0 ? "\n" : "");
        status = print_reaction(&sheet, &list[i]);
    }
    if (status == QDOT_OK)
        status = print_joints(&sheet, n);
    if (n == 0 && session->scene->joints.n == 0)
        qdot_sheet_words(&sheet, "the constraints act on nothing");
    status = qdot_sheet_end(&sheet, "reactions", status);
    qdot_free(list);
    return status;
}
