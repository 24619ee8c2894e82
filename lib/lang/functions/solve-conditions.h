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
#include "lang/session/parts.h"
#include "normal/solve/solve-special.h"

/* Give notices of the solutions at special parameter values, and of values where these are not known. */
QDOT_MUST_CHECK qdot_status qdot_solve_notice_specials(qdot_session *session, qdot_expr x,
                                                       const qdot_specials *specials);

/* Give the notice `where a = 0 the solutions may be others`, for a LIST of equations of special parameter values. */
QDOT_MUST_CHECK qdot_status qdot_solve_notice_open(qdot_session *session, qdot_expr where);

/* Notice that F [n] may have other zeros x [m] where the base of a power is not positive: if `single`, of a power with x[0]
 * in its exponent, or else if there is a power with a parameter in its exponent whose base may be negative. */
QDOT_MUST_CHECK qdot_status qdot_solve_notice_powers(qdot_session *session, size_t n, const qdot_expr *F, size_t m,
                                                     const qdot_expr *x, bool single, const qdot_facts *facts);

/* Give the notice `WORDS C and D` for conditions that concern all solutions; nothing if they are nil. */
QDOT_MUST_CHECK qdot_status qdot_solve_notice_all(qdot_session *session, const char *words, qdot_expr conditions);

/* Give a root as a value, without its conditions; if every x with certain relations is a root, give the relations. */
QDOT_MUST_CHECK qdot_status qdot_solve_root_value(qdot_pool *pool, qdot_expr x, const qdot_root *root, qdot_expr *value);

/* Print conditions joined by ` and `, the first one after `word`. */
QDOT_MUST_CHECK qdot_status qdot_solve_print_conditions(qdot_pool *pool, const char *word,
                                                        qdot_expr conditions,
                                                        qdot_text *text);

/* Give the notice `SOLUTION exists when C and D`, if the solution has conditions. */
QDOT_MUST_CHECK qdot_status qdot_solve_notice_conditions(qdot_session *session,
                                                         qdot_expr solution,
                                                         qdot_expr conditions);

#endif
