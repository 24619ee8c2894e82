/* treat.h -- inside of lang/analysis: one statement after the other.
 *
 * Tests  tests/lang/analysis/test_analysis.c
 */
#ifndef QDOT_LANG_TREAT_H
#define QDOT_LANG_TREAT_H

#include "lang/analysis/analysis.h"

/* Carry out piece i, or parse it, append what is to be said of it, and set the state behind it. QDOT_ENOMEM.
 * QDOT_EINTR: it was interrupted (base/interrupt), and has to be treated anew once what it has changed has been taken back. */
QDOT_MUST_CHECK qdot_status qdot_treat_piece(qdot_analysis *a, size_t i);

#endif
