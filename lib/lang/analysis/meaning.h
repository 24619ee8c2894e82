/* meaning.h -- inside of lang/analysis: whether the names of an expression that is not evaluated are known.
 *
 * Tests  tests/lang/analysis/test_analysis.c
 */
#ifndef QDOT_LANG_MEANING_H
#define QDOT_LANG_MEANING_H

#include "lang/analysis/analysis.h"
#include "lang/workbench/look.h"

/* What is looked at: the tokens of a piece. */
typedef struct {
    const qdot_analysis *a;
    const qdot_token *from, *to;
    bool uncertain;
} qdot_meaning;

/* For qdot_look: fail with QDOT_ENAME at the first name of the expression that means nothing; data: a qdot_meaning. */
QDOT_MUST_CHECK qdot_status qdot_meaning_expression(void *data, qdot_cursor *c, const qdot_compiled *program);

/* Whether the name is one whose meaning is not known here. */
bool qdot_meaning_is_unknown(const qdot_analysis *a, const char *name);
/* Take the label of a run or table away from those; *removed: whether it was one. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_meaning_remove_label(qdot_analysis *a, const char *name, bool *removed);
/* Add a name to those; label: that of a run. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_meaning_add_unknown(qdot_analysis *a, const char *name, bool label);
/* Whether the tokens depend on what an analysis does not have: runs, names whose meaning is not known, answers %. */
bool qdot_meaning_depends(const qdot_analysis *a, const qdot_token *from, const qdot_token *to);
/* How the name at k binds itself within the tokens: as an argument or the index of a sum, f(u) = u^2, sum(k, k, 1, 3); as the index
 * of a loop, k^2 for k = 1..3, which may also be a parameter. */
typedef enum { QDOT_BOUND_NOT, QDOT_BOUND_ARGUMENT, QDOT_BOUND_LOOP } qdot_bound_kind;
qdot_bound_kind qdot_meaning_binds(const qdot_token *from, const qdot_token *to, const qdot_token *k);

#endif
