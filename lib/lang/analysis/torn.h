/* torn.h -- splits a text into tokens although parts of it are no text of the language.
 *
 * Where a bracket is never closed, a text in quotes is not ended, a character has no meaning, the line is blanked and the
 * rest is read. Blanks keep every byte in its place.
 *
 * Tests  tests/lang/analysis/test_analysis.c
 */
#ifndef QDOT_LANG_TORN_H
#define QDOT_LANG_TORN_H

#include "lang/analysis/remark.h"
#include "lang/source/source.h"

/* The source of the text without the lines at fault, for each of which a remark is appended. The caller frees both.
 * QDOT_ENOMEM, QDOT_ELIMIT: there is none. */
QDOT_MUST_CHECK qdot_status qdot_torn_source(const char *name, const char *text, size_t length, qdot_source **source,
                                             qdot_remark_list *remarks);

#endif
