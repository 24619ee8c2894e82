/* width.h -- about how wide a formula is in print.
 *
 * Tests  tests/formula/test_write.c
 */
#ifndef QDOT_FORMULA_WIDTH_H
#define QDOT_FORMULA_WIDTH_H

#include "formula/formula.h"

/* Set *letters to the letters, digits, signs and brackets of the node (QDOT_NOTATION_DRAWN) and of all below it: more
 * than its width where they stand above each other. Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_formula_width(const qdot_formula *f, qdot_formula_id id, size_t *letters);

#endif
