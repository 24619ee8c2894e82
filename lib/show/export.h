/* export.h -- equations as source text in C, Python, Julia, Matlab (and Octave), JavaScript.
 *
 * What is written is described neutrally: names, tapes, start values. The motion is
 *
 *     M(q, t) q'' = f(q, q', t) + A^T lambda,   A q'' = gamma
 *
 * as tapes (export-parts.h).
 *
 * Operations of a tape that are used once stand within expressions, others get a name. Each language
 * has a table of its operations and a template (export-language.h).
 *
 * Tests  tests/show/test_export.c, tests/script/files/export.sh, tests/meta/exports.test (compiled and run)
 */
#ifndef QDOT_SHOW_EXPORT_H
#define QDOT_SHOW_EXPORT_H

#include "base/text.h"
#include "show/export-parts.h"

/* Append the source. Errors: QDOT_EINVAL (the file's name makes no name in the language, a
 * number that no double holds), QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_export_system_write(const qdot_export_system *system,
                                                     const qdot_export_language *language,
                                                     qdot_text *out);
QDOT_MUST_CHECK qdot_status qdot_export_expression_write(const qdot_export_expression *e,
                                                         const qdot_export_language *language,
                                                         qdot_text *out);

#endif
