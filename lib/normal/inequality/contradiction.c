/* contradiction.c -- finds contradictions by testing each condition against those before it. */
#include "normal/inequality/contradiction.h"

#include "expr/node.h"
#include "expr/walk.h"
#include "normal/inequality/boxes.h"
#include "normal/inequality/less.h"

enum { MOST = 8, LARGEST = 200 };

static bool
has_few_small_facts(const qdot_pool *pool, const qdot_facts *facts)
{
    if (facts->n_conditions + facts->n_relations > MOST)
        return false;
    for (size_t i = 0; i < facts->n_conditions; i++)
        if (qdot_expr_size(pool, facts->conditions[i]) > LARGEST)
            return false;
    for (size_t i = 0; i < facts->n_relations; i++)
        if (qdot_expr_size(pool, facts->relations[i]) > LARGEST)
            return false;
    return true;
}

/* Find whether left < right (or <=) is proved under `facts`: *found. */
static qdot_status
less_is_proved(qdot_pool *pool, qdot_expr left, qdot_expr right, bool strict,
               const qdot_facts *facts, bool *found)
{
    qdot_decision d;

    QDOT_TRY(qdot_decide_less(pool, left, right, strict, facts, &d));
    *found = d.verdict == QDOT_PROVED;
    return QDOT_OK;
}

static qdot_status
condition_is_refuted(qdot_pool *pool, qdot_expr c, const qdot_facts *before, bool *found)
{
    if (c == QDOT_FALSE)
        *found = true;
    if (qdot_expr_kind(pool, c) != QDOT_REL || qdot_expr_node(pool, c)->op == QDOT_EQ)
        return QDOT_OK;
    /* u < v is false where v <= u is proved, u <= v where v < u is proved */
    return less_is_proved(pool, qdot_expr_arg(pool, c, 1), qdot_expr_arg(pool, c, 0),
                          qdot_expr_node(pool, c)->op == QDOT_LE, before, found);
}

qdot_status
qdot_contradiction(qdot_pool *pool, const qdot_facts *facts, bool *found)
{
    qdot_facts before = {0};

    *found = false;
    if (!has_few_small_facts(pool, facts))
        return QDOT_OK;
    before.conditions = facts->conditions;
    before.relations = facts->relations;
    for (size_t i = 0; i < facts->n_conditions && !*found; i++) {
        before.n_conditions = i;
        QDOT_TRY(condition_is_refuted(pool, facts->conditions[i], &before, found));
    }
    if (!*found && facts->n_conditions > 0)
        QDOT_TRY(qdot_boxes_exclude(pool, facts, found));
    before.n_conditions = facts->n_conditions;
    for (size_t i = 0; i < facts->n_relations && !*found; i++) {
        before.n_relations = i;
        QDOT_TRY(less_is_proved(pool, QDOT_ZERO, facts->relations[i], true, &before, found));
        if (!*found)
            QDOT_TRY(less_is_proved(pool, facts->relations[i], QDOT_ZERO, true, &before, found));
    }
    return QDOT_OK;
}
