/* printed.h -- texts of subexpressions that were printed, to be copied where they stand again.
 *
 * A cache, owned by the pool: a slot for each hash, the newest text stays. `how` is everything but
 * the node that its text depends on: style, context, signs.
 */
#ifndef QDOT_EXPR_PRINTED_H
#define QDOT_EXPR_PRINTED_H

#include "base/text.h"
#include "expr/expr.h"

typedef struct qdot_printed qdot_printed;

qdot_printed *qdot_printed_new(void); /* NULL: no memory */
void qdot_printed_free(qdot_printed *printed);

/* Of all that is kept nothing: the text of a node has changed. */
void qdot_printed_forget(qdot_printed *printed);

/* Append the text of e if it is kept. */
bool qdot_printed_copy(const qdot_printed *printed, qdot_expr e, uint32_t how, qdot_text *out);

/* Keep what stands in `out` from `from` on, unless it is too short or too long to gain by it.
 * Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_printed_keep(qdot_printed *printed, qdot_expr e, uint32_t how,
                                              const qdot_text *out, size_t from);

#endif
