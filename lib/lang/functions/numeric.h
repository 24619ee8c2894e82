/* numeric.h -- numeric(E), numeric(E, digits): the number of an expression.
 *
 * The result is like a number from a run: it has an error, which propagates. If symbols remain,
 * the constants beside them become decimals, of 16 digits unless given.
 *
 * Tests  tests/script/solve/numeric.lag, tests/bad/solve/numeric-*.lag
 */
#ifndef QDOT_LANG_NUMERIC_H
#define QDOT_LANG_NUMERIC_H

#include "lang/session/parts.h"

/* args [n]: E, perhaps how many digits. E is taken with the values of `set`.
 * QDOT_EDOMAIN: a part of it is undefined, not real, or not told from 0. */
QDOT_MUST_CHECK qdot_status qdot_numeric(qdot_session *session, uint32_t n,
                                         const qdot_expr *args, qdot_expr *value);

#endif
