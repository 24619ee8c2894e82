/* printed.h -- a cache of the texts of printed subexpressions, owned by the pool.
 *
 * It has a slot for each hash, which keeps the newest text. `how` encodes everything except the
 * node that the text depends on: style, context, signs.
 */
#ifndef QDOT_EXPR_PRINTED_H
#define QDOT_EXPR_PRINTED_H

#include "base/text.h"
#include "expr/expr.h"

typedef struct qdot_printed qdot_printed;

qdot_printed *qdot_printed_new(void); /* NULL: no memory */
void qdot_printed_free(qdot_printed *printed);

/* Empty the cache: the text of a node has changed. */
void qdot_printed_forget(qdot_printed *printed);

/* Append the text of e if it is kept. */
bool qdot_printed_copy(const qdot_printed *printed, qdot_expr e, uint32_t how, qdot_text *out);

/* Keep the text of `out` from `from` on, unless it is too short or too long to be worth it.
 * Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_printed_keep(qdot_printed *printed, qdot_expr e, uint32_t how,
                                              const qdot_text *out, size_t from);

#endif
