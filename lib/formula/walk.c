/* walk.c -- goes through a formula in reading order, with a stack of open nodes. */
#include "formula/walk.h"

#include "base/interrupt.h"

static qdot_status
enter_node(qdot_formula_walk *walk, qdot_formula_id id)
{
    const qdot_formula_node *node = qdot_formula_at(walk->formula, id);

    QDOT_TRY(walk->enter(walk, node));
    if (qdot_formula_is_leaf(node))
        return QDOT_OK;
    return qdot_vec_push(&walk->open, ((qdot_formula_frame){.id = id}));
}

/* Step to the next child of the innermost open node, or leave that node. */
static qdot_status
step_to_next_node(qdot_formula_walk *walk)
{
    qdot_formula_frame *f = walk->open.at + walk->open.n - 1;
    const qdot_formula_node *node = qdot_formula_at(walk->formula, f->id);

    if (f->child == node->child) { /* the last child, or there are no children */
        walk->open.n--;
        return walk->leave(walk, node);
    }
    f->k += f->child != 0;
    f->child = qdot_formula_at(walk->formula, f->child != 0 ? f->child : node->child)->next;
    if (f->k > 0 && node->kind != QDOT_FORMULA_SPAN && walk->between != NULL)
        QDOT_TRY(walk->between(walk, node, f->k));
    return enter_node(walk, f->child);
}

qdot_status
qdot_formula_pass(qdot_formula_walk *walk, qdot_formula_id id)
{
    qdot_status status = walk->formula->nodes.n > id ? enter_node(walk, id) : QDOT_OK;

    for (unsigned i = 0; status == QDOT_OK && walk->open.n > 0; i++) {
        status = step_to_next_node(walk);
        if (status == QDOT_OK && i % 64 == 0)
            status = qdot_interrupt_check();
    }
    qdot_free(walk->open.at);
    walk->open.at = NULL;
    walk->open.n = walk->open.capacity = 0;
    return status;
}
