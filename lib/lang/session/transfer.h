/* transfer.h -- expressions moved from one pool to another.
 *
 * A pool never forgets what it knows of a symbol. So `reset scene` starts with a new pool
 * and carries over what is kept: a coordinate declared anew then has no old domain behind
 * it.
 */
#ifndef QDOT_LANG_TRANSFER_H
#define QDOT_LANG_TRANSFER_H

#include "expr/expr.h"

/* e of `from`, built in `to`, with the symbols' declared domains. Symbols come into
 * being in the order of their ids. Nil on failure, which `to` keeps. */
qdot_expr qdot_transfer(const qdot_pool *from, qdot_pool *to, qdot_expr e);

#endif
