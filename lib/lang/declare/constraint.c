/* constraint.c -- the statement `constraint`: requires A = B, for positions, velocities or accelerations. */
#include "expr/node.h"
#include "lang/answer/answer.h"
#include "lang/declare/constraints.h"
#include "lang/declare/objects.h"
#include "lang/session/member.h"

static qdot_status declare_constraint(qdot_record *r);

QDOT_STATEMENT(constraint) = {
    .word = "constraint",
    .group = QDOT_DECLARING,
    .usage = "constraint [NAME:] A = B",
    .summary = "a constraint; its kind is the highest derivative it holds; lambda[NAME] is its "
               "multiplier",
    .example = "constraint rod: x^2 + y^2 = L^2",
    .handler = declare_constraint,
};

/* Give a notice that a component 0 = 0 is no constraint; `kept` is the number of the other components. */
static qdot_status
give_notice_of_dropped(qdot_session *session, const char *label, qdot_expr left, size_t kept)
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

/* Give a notice if all constraints from index `before` on were declared before; returns whether they were. */
static bool
give_notice_of_repeated(qdot_session *session, size_t before, qdot_status *status)
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
declare_constraint(qdot_record *r)
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
    QDOT_TRY(give_notice_of_dropped(session, label, left, session->scene->constraints.n - before));
    if (give_notice_of_repeated(session, before, &status))
        return status;
    return qdot_constraints_tell_disguise(session, before);
}
