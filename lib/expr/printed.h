/* printed.h -- where expressions stand already in the formula that is being made, and a formula for those that become
 * text at once. Owned by the pool.
 *
 * It has a slot for each hash, which keeps the newest node. `how` encodes everything except the expression that the
 * node depends on: notation, context, signs.
 */
#ifndef QDOT_EXPR_PRINTED_H
#define QDOT_EXPR_PRINTED_H

#include "expr/id.h"
#include "formula/formula.h"

typedef struct qdot_printed qdot_printed;

qdot_printed *qdot_printed_new(void); /* returns NULL if memory runs out */
void qdot_printed_free(qdot_printed *printed);

/* Forget all stored nodes, because expressions now print differently. */
void qdot_printed_forget(qdot_printed *printed);

/* The formula object used for text output; it is kept for reuse while it is small. */
qdot_formula *qdot_printed_formula(qdot_printed *printed);

/* Remember nodes of `formula` from now on; the nodes remembered of any other formula are forgotten. */
void qdot_printed_begin(qdot_printed *printed, qdot_formula *formula);

/* The node in which e was printed before; 0 if none is known. */
qdot_formula_id qdot_printed_find(const qdot_printed *printed, qdot_expr e, uint32_t how);

/* Store the node in which e was printed. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_printed_keep(qdot_printed *printed, qdot_expr e, uint32_t how, qdot_formula_id id);

#endif
