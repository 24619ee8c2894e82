/* definition-check.h -- what an equation sign may not be written to, with the line that was meant.
 *
 * A definition never hides the language, a label or a coordinate. Each of these is an error whose hint
 * is a whole line that can be typed as it stands:
 *
 *   potential = -k/x            potential -k/x
 *   lambda = 3                  param lambda = 3
 *   bob = (1, 2)                start x = 1, y = 2
 *   theta = 1, theta' = 2       start theta' = 2
 *   x = r*cos(theta)            constraint x = r*cos(theta)
 *   theta'' = -sin(theta)       check eom[theta] == (theta'' = -sin(theta))
 *   eom[theta] = ...            check eom[theta] == (...)
 *
 * Tests  tests/lang/hints.def, tests/bad/definitions/definition-hides.sh
 */
#ifndef QDOT_LANG_DEFINITION_CHECK_H
#define QDOT_LANG_DEFINITION_CHECK_H

#include "lang/language/cursor.h"

/* Look at the statement at the cursor, which ends at `end` (with its `for`). QDOT_ENAME with the hint
 * where it defines what cannot be defined; QDOT_OK for all other statements. */
QDOT_MUST_CHECK qdot_status qdot_definition_check(qdot_cursor *c, const qdot_token *end);

#endif
