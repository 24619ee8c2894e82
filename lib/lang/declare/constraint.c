/* constraint.c -- `constraint`: A = B, also of velocities and accelerations. */
#include "expr/node.h"
#include "lang/answer/answer.h"
#include "lang/declare/constraints.h"
#include "lang/declare/objects.h"
#include "lang/session/member.h"

static qdot_status constraint_declare(qdot_record *r);

QDOT_STATEMENT(constraint) = {
    .word = "constraint",
    .group = QDOT_DECLARING,
    .usage = "constraint [NAME:] A = B",
    .summary = "a constraint; its kind is the highest derivative it holds; lambda[NAME] is its "
               "multiplier",
    .example = "constraint rod: x^2 + y^2 = L^2",
    .handler = constraint_declare,
};

/* Notice: a component that reads 0 = 0 is no constraint; `kept` is the number of the others. */
static qdot_status
constraint_tell_dropped(qdot_session *session, const char *label, qdot_expr left, size_t kept)
{
    size_t given = qdot_expr_kind(session->pool, left) == QDOT_VEC
                       ? qdot_expr_count(session->pool, left)
                       : 1;

    if (kept >= given)
        return QDOT_OK;
    if (given == 1)
        return qdot_answer_notice(session, "the constraint%s%s says 0 = 0 and is left out",
                                  label != NULL ? " " : "", label != NULL ? label : "");
    return qdot_answer_notice(session,
                              "%zu of the %zu components of the constraint%s%s "
                              "say 0 = 0 and are left out",
                              given - kept, given, label != NULL ? " " : "",
                              label != NULL ? label : "");
}

/* Notice if all constraints from index `before` on were declared earlier; returns whether that is so. */
static bool
constraint_tell_same(qdot_session *session, size_t before, qdot_status *status)
{
    const qdot_scene *scene = session->scene;

    for (size_t k = before; k < scene->constraints.n; k++) {
        size_t i = 0;

        while (i < before && scene->constraints.at[i].f != scene->constraints.at[k].f)
            i++;
        if (i == before)
            return false;
    }
    if (before == scene->constraints.n)
        return false;
    *status = qdot_answer_notice(session, "the scene has this constraint already: beside the "
                                          "first it is redundant");
    return true;
}

static qdot_status
constraint_declare(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    const qdot_filled *equation = qdot_record_hole(r, NULL, "A");
    const char *label;
    qdot_expr left, right;
    qdot_status status;
    size_t before;

    QDOT_TRY(qdot_object_label(r, &label));
    QDOT_TRY(qdot_record_equation(r, equation, false, &left, &right));
    qdot_record_blame(r, equation);
    QDOT_TRY(qdot_member_refuse(session, left));
    QDOT_TRY(qdot_member_refuse(session, right));
    before = session->scene->constraints.n;
    QDOT_TRY(qdot_scene_constraint(session->scene, label, left, right));
    QDOT_TRY(constraint_tell_dropped(session, label, left, session->scene->constraints.n - before));
    if (constraint_tell_same(session, before, &status))
        return status;
    return qdot_constraints_tell_disguise(session, before);
}
