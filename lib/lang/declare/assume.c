/* assume.c -- the statement `assume`: relations that the engine may use from here on.
 *
 * All relations are read before the first is kept. None is kept if they are proved to contradict each other, an
 * earlier one, or a declared domain.
 */
#include "expr/build.h"
#include "expr/integral.h"
#include "expr/node.h"
#include "lang/commands/value-check.h"
#include "lang/syntax/record.h"
#include "mech/scene/scene.h"
#include "normal/inequality/contradiction.h"

static qdot_status carry_out_assume(qdot_record *r);

QDOT_STATEMENT(assume) = {
    .word = "assume",
    .group = QDOT_DECLARING,
    .usage = "assume RELATION, ...",
    .summary = "relations that the engine may use",
    .example = "assume diff(x(s), s)^2 + diff(y(s), s)^2 = 1",
    .handler = carry_out_assume,
};

typedef qdot_vec(qdot_assumption) assumptions;
typedef qdot_vec(qdot_expr) exprs;

/* Read one assumption; `0 < a < c` counts as two. */
static qdot_status
read_assumption_relation(qdot_record *r, const qdot_filled *part, assumptions *said)
{
    const qdot_pool *pool = r->cursor.session->pool;
    const bool greater = qdot_filled_holds_sign(part, '>');
    qdot_expr e;
    bool several;
    uint32_t n;

    QDOT_TRY(qdot_record_value(r, part, &e));
    qdot_record_blame(r, part);
    QDOT_TRY(qdot_infinity_refuse(pool, e));
    several = qdot_expr_kind(pool, e) == QDOT_LOGIC && qdot_expr_node(pool, e)->op == QDOT_AND;
    n = several ? qdot_expr_count(pool, e) : 1;
    for (uint32_t i = 0; i < n; i++) {
        const qdot_assumption one = {.relation = several ? qdot_expr_arg(pool, e, i) : e,
                                     .turned = greater && !several};

        QDOT_TRY(qdot_vec_push(said, one));
    }
    return QDOT_OK;
}

/* Copy the facts of the scene and the new assumptions into the arrays relations, conditions. */
static qdot_status
gather_facts(qdot_session *session, const assumptions *said, exprs *relations, exprs *conditions)
{
    const qdot_facts own = qdot_scene_facts(session->scene);
    qdot_pool *pool = session->pool;

    for (size_t i = 0; i < own.n_relations; i++)
        QDOT_TRY(qdot_vec_push(relations, own.relations[i]));
    for (size_t i = 0; i < own.n_conditions; i++)
        QDOT_TRY(qdot_vec_push(conditions, own.conditions[i]));
    for (size_t i = 0; i < said->n; i++) {
        const qdot_expr e = said->at[i].relation;

        if (qdot_expr_kind(pool, e) != QDOT_REL)
            continue;
        if (qdot_expr_node(pool, e)->op != QDOT_EQ)
            QDOT_TRY(qdot_vec_push(conditions, e));
        else if (qdot_expr_is_scalar(pool, qdot_expr_arg(pool, e, 0)) &&
                 qdot_expr_is_scalar(pool, qdot_expr_arg(pool, e, 1)))
            QDOT_TRY(qdot_vec_push(relations,
                                   qdot_sub(pool, qdot_expr_arg(pool, e, 0), qdot_expr_arg(pool, e, 1))));
    }
    return qdot_pool_check(pool);
}

static qdot_status
refuse_contradiction(qdot_session *session, const assumptions *said)
{
    exprs relations = {0}, conditions = {0};
    qdot_status status = gather_facts(session, said, &relations, &conditions);
    bool found = false;

    if (status == QDOT_OK) {
        const qdot_facts all = {.n_relations = relations.n,
                                .relations = relations.at,
                                .n_conditions = conditions.n,
                                .conditions = conditions.at};

        status = qdot_contradiction(session->pool, &all, &found);
    }
    qdot_free(relations.at);
    qdot_free(conditions.at);
    if (status == QDOT_OK && found) {
        (void)qdot_fail(QDOT_EINVAL, "this contradicts itself, what is assumed already, or a declared domain");
        return qdot_hint("what is assumed of parameters is forgotten by `reset`, of the scene by `reset scene`");
    }
    return status;
}

static qdot_status
add_assumptions(qdot_session *session, const assumptions *said)
{
    for (size_t i = 0; i < said->n; i++)
        if (qdot_expr_kind(session->pool, said->at[i].relation) == QDOT_REL)
            QDOT_TRY(qdot_value_check_assumption(session, &said->at[i]));
    QDOT_TRY(refuse_contradiction(session, said));
    for (size_t i = 0; i < said->n; i++)
        QDOT_TRY(qdot_scene_assume(session->scene, said->at[i].relation, said->at[i].turned));
    return QDOT_OK;
}

static qdot_status
carry_out_assume(qdot_record *r)
{
    assumptions said = {0};
    qdot_status status = QDOT_OK;

    for (const qdot_filled *part = qdot_record_hole(r, NULL, "RELATION"); part != NULL && status == QDOT_OK;
         part = qdot_record_next(r, part, "RELATION"))
        status = read_assumption_relation(r, part, &said);
    if (status == QDOT_OK) {
        r->cursor.error_at = r->start->start;
        status = add_assumptions(r->cursor.session, &said);
    }
    qdot_free(said.at);
    return status;
}
