/* typed-name.h -- names of answers, as they were typed, in the letters of formulas: eom[theta1] is eom[θ₁].
 *
 * Tests  tests/lang/answer/test_styles.c
 */
#ifndef QDOT_LANG_TYPED_NAME_H
#define QDOT_LANG_TYPED_NAME_H

#include "expr/print-name.h"
#include "formula/formula.h"
#include "lang/session/parts.h"

/* Append the name as WORDS with these flags: in LaTeX \mathrm{eom}_{\theta}, divided at the signs between its terms.
 * Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_typed_name_add(qdot_session *session, const char *name, qdot_style style,
                                                qdot_formula *f, qdot_formula_id parent, unsigned flags);

/* Append a name as text: as LaTeX, with the letters of formulas (unicode, MathML), or as typed
 * (plain). QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_typed_name_print(qdot_session *session, const char *name, qdot_style style,
                                                  qdot_text *out);

#endif
