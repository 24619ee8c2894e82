/* reactions.c -- `reactions`: the constraints' forces on each particle and body. */
#include "mech/study/reactions.h"

#include "lang/answer/answer.h"
#include "lang/answer/formula.h"
#include "lang/answer/sheet.h"
#include "lang/syntax/record.h"

static qdot_status reactions_print(qdot_record *r);

QDOT_STATEMENT(reactions) = {
    .word = "reactions",
    .group = QDOT_ASKING,
    .usage = "reactions",
    .summary = "the constraints' forces on each particle and body, by their multipliers",
    .example = "reactions",
    .alone = true,
    .handler = reactions_print,
};

static bool
reaction_is_zero(const qdot_pool *pool, qdot_expr e)
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
reaction_print(qdot_session *session, const qdot_reaction *r, qdot_text *out)
{
    qdot_pool *pool = session->pool;

    if (r->name == NULL)
        QDOT_TRY(qdot_formula_marked(session, r->coordinate, out));
    else
        qdot_text_add(out, r->name);
    if (r->name == NULL || r->torque == QDOT_NIL || !reaction_is_zero(pool, r->force)) {
        qdot_text_add(out, r->name == NULL ? ": generalized reaction " : ": force ");
        QDOT_TRY(qdot_formula_marked(session, r->force, out));
        if (r->torque == QDOT_NIL || reaction_is_zero(pool, r->torque))
            return QDOT_OK;
        qdot_text_add(out, " at its centre, torque ");
    } else {
        qdot_text_add(out, ": torque ");
    }
    return qdot_formula_marked(session, r->torque, out);
}

static qdot_status
reactions_print(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_reaction *list = NULL;
    qdot_text text = {0};
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
    QDOT_TRY(qdot_vec_push(&session->history, value));
    if (session->json)
        QDOT_TRY(qdot_answer_expr(session, "reactions", value));
    status = qdot_mech_reactions(session->scene, &list, &n);
    sheet = qdot_sheet_begin(session);
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        qdot_text_add(&text, i > 0 ? "\n" : "");
        status = reaction_print(session, &list[i], &text);
    }
    if (n == 0)
        qdot_text_add(&text, "the constraints act on nothing");
    status = qdot_sheet_end(session, &sheet, "reactions", status, &text);
    qdot_free(list);
    return status;
}
