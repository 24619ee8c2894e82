/* transfer.h -- expressions moved from one pool to another.
 *
 * A pool never forgets the domain of a symbol. So `reset scene` starts a new pool and transfers
 * the expressions that are kept: a coordinate declared anew then does not have its old domain.
 */
#ifndef QDOT_LANG_TRANSFER_H
#define QDOT_LANG_TRANSFER_H

#include "expr/id.h"

/* e of `from`, built in `to`, with the symbols' declared domains. Symbols come into
 * being in the order of their ids. Nil on failure, which `to` keeps. */
qdot_expr qdot_transfer(const qdot_pool *from, qdot_pool *to, qdot_expr e);

#endif
