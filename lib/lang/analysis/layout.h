/* layout.h -- how a script is laid out: spaces, indentation, what can be folded.
 *
 *   x=1            x = 1
 *   f( a,b )       f(a, b)
 *   a +b           a + b         a*b, a+b, a * b stay as they were typed
 *
 * A statement in a block is indented by 4 for each brace, a line that goes on by 4 or more beyond its statement. Comments stay
 * where they stand in their line, statements written as the screen shows formulas (½ m v²) as they are. If the tokens would not
 * be the same, nothing is changed. To lay out twice changes nothing more.
 *
 * Tests  tests/lang/analysis/test_layout.c, tests/meta/lsp.test
 */
#ifndef QDOT_LANG_LAYOUT_H
#define QDOT_LANG_LAYOUT_H

#include "lang/analysis/analysis.h"

/* Text in place of a stretch. */
typedef struct {
    qdot_stretch at;
    char *text; /* owned */
} qdot_edit;

typedef qdot_vec(qdot_edit) qdot_edit_list;

/* Append what is to be changed of the text, in order; nothing if a part of it could not be split into tokens. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_layout_edits(const qdot_analysis *a, qdot_edit_list *edits);
void qdot_layout_clear(qdot_edit_list *edits);

/* Append the stretches that can be folded to their first line: blocks, statements of several lines, runs of comments. */
typedef struct {
    qdot_stretch at;
    bool comment;
} qdot_fold;
typedef qdot_vec(qdot_fold) qdot_fold_list;
QDOT_MUST_CHECK qdot_status qdot_layout_folds(const qdot_analysis *a, qdot_fold_list *folds);

#endif
