/* solve-conditions.h -- what is told of a set of solutions: its conditions, and values of parameters at which it is
 * another one.
 *
 *     a x = b:   x = b/a exists when a != 0
 *     a x = 0:   for a = 0 every x is a solution
 *
 * Tests  tests/script/solve/solve-special.lag
 */
#ifndef QDOT_LANG_SOLVE_CONDITIONS_H
#define QDOT_LANG_SOLVE_CONDITIONS_H

#include "base/text.h"
#include "lang/session/session.h"
#include "normal/solve/solve-special.h"

/* Tell the sets at special values, and where it is not known whether the set is another one. */
QDOT_MUST_CHECK qdot_status qdot_solve_notice_specials(qdot_session *session, qdot_expr x,
                                                       const qdot_specials *specials);

/* Tell `where a = 0 the solutions may be others`, of a LIST of equations that hold there. */
QDOT_MUST_CHECK qdot_status qdot_solve_notice_open(qdot_session *session, qdot_expr where);

/* Tell `WORDS C and D`, conditions that concern all solutions; nil: there are none, nothing is told. */
QDOT_MUST_CHECK qdot_status qdot_solve_notice_all(qdot_session *session, const char *words, qdot_expr conditions);

/* A root as a value: x, or the relations that say which x are roots; with a notice of its conditions. */
QDOT_MUST_CHECK qdot_status qdot_solve_root_value(qdot_session *session, qdot_expr x,
                                                  const qdot_root *root, qdot_expr *value);

/* The conditions, ` and ` between them, the first behind `word`. */
QDOT_MUST_CHECK qdot_status qdot_solve_print_conditions(qdot_pool *pool, const char *word,
                                                        qdot_expr conditions,
                                                        qdot_text *text);

/* Tell `SOLUTION exists when C and D`, of one that has conditions. */
QDOT_MUST_CHECK qdot_status qdot_solve_notice_conditions(qdot_session *session,
                                                         qdot_expr solution,
                                                         qdot_expr conditions);

#endif
