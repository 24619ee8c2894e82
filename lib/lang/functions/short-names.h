/* short-names.h -- notices for values of the language that a declaration uses by their short
 * name.
 *
 * `constraint rod: x^2 + y^2 = L^2` without a parameter L contains the Lagrange function, which
 * is hardly intended. Tests: tests/script/language/declarations.lag, tests/bad/contacts/taken-*.lag.
 */
#ifndef QDOT_LANG_SHORT_NAMES_H
#define QDOT_LANG_SHORT_NAMES_H

#include "lang/functions/quantity.h"

/* The longer name of the same quantity, such as lagrange_function for L; NULL if there is none. */
const char *qdot_short_names_long(const qdot_quantity *row);

/* The bare name of a value was read: kept if it has a longer one. status: what making the value
 * gave; where that is an error its hint tells how the name becomes one's own. Returns status. */
QDOT_MUST_CHECK qdot_status qdot_short_names_note(qdot_session *session,
                                                  const qdot_quantity *row,
                                                  qdot_status status);

/* A notice of what was kept since it was last forgotten, once for each name; where the statement
 * failed (status) and its error has no hint, the hint says it. Returns status, or why no notice
 * could be given. */
void qdot_short_names_forget(qdot_session *session);
QDOT_MUST_CHECK qdot_status qdot_short_names_tell(qdot_session *session,
                                                  qdot_status status);

#endif
