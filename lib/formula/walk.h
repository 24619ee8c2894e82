/* walk.h -- a formula passed through in reading order, without recursion.
 *
 * Each node is entered, then its children one after the other, then it is left. A leaf is only entered.
 *
 * Tests  tests/formula/test_formula.c
 */
#ifndef QDOT_FORMULA_WALK_H
#define QDOT_FORMULA_WALK_H

#include "formula/formula.h"

/* A node whose children are being traversed. */
typedef struct {
    qdot_formula_id id, child; /* the node, and the child of it that was visited last; 0: none yet */
    uint32_t k;                /* index of the child visited last */
} qdot_formula_frame;

typedef struct qdot_formula_walk qdot_formula_walk;

struct qdot_formula_walk {
    const qdot_formula *formula;
    qdot_vec(qdot_formula_frame) open; /* the nodes that contain the node being visited, outermost first */
    void *user;
    qdot_status (*enter)(qdot_formula_walk *walk, const qdot_formula_node *node);
    /* Called between child k - 1 and child k > 0 of a node, as between the two sides of a fraction; not within a
     * SPAN, whose children follow each other. NULL: nothing stands there. */
    qdot_status (*between)(qdot_formula_walk *walk, const qdot_formula_node *node, uint32_t k);
    qdot_status (*leave)(qdot_formula_walk *walk, const qdot_formula_node *node);
};

/* Traverse a node and all its descendants. Errors: QDOT_ENOMEM, QDOT_EINTR, those of the callbacks. */
QDOT_MUST_CHECK qdot_status qdot_formula_pass(qdot_formula_walk *walk, qdot_formula_id id);

/* The parent of the node being visited; NULL: it has none. */
static inline const qdot_formula_node *
qdot_formula_outer(const qdot_formula_walk *walk)
{
    return walk->open.n > 0 ? qdot_formula_at(walk->formula, walk->open.at[walk->open.n - 1].id) : NULL;
}

#endif
