/* look.h -- statements that are parsed but not carried out, and their expressions, for who analyses a text.
 *
 * Tests  tests/lang/analysis/test_analysis.c
 */
#ifndef QDOT_LANG_LOOK_H
#define QDOT_LANG_LOOK_H

#include "lang/language/compiled.h"
#include "lang/syntax/form.h"
#include "lang/syntax/record.h"

/* `expression` gets each expression of a statement as it was parsed; it fails with the place in the cursor. NULL: they are only parsed. */
typedef struct {
    qdot_status (*expression)(void *data, qdot_cursor *c, const qdot_compiled *program);
    void *data;
} qdot_look;

/* Hand over the expressions of a statement that has been read by its usage. */
QDOT_MUST_CHECK qdot_status qdot_look_at_record(const qdot_look *look, qdot_record *record);
/* Parse the statement at the cursor, of a form that begins with no word of the language, and hand its expressions over. */
QDOT_MUST_CHECK qdot_status qdot_look_at_wordless(const qdot_look *look, qdot_cursor *c, qdot_form form);

#endif
