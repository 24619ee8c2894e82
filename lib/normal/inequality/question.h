/* question.h -- makes an inequality and its conditions algebraic by the substitutions of
 * inequality.h. For inequality.c alone.
 */
#ifndef QDOT_NORMAL_QUESTION_H
#define QDOT_NORMAL_QUESTION_H

#include "normal/inequality/cells.h"

enum { QDOT_QUESTION_CONDITIONS = 16 };

/* The question whether e >= 0 (or > 0) wherever the conditions hold. */
typedef struct {
    qdot_expr e;
    qdot_cells_condition condition[QDOT_QUESTION_CONDITIONS];
    size_t n;
    bool too_much;
    int64_t *work; /* the remaining budget of operations for all questions together */
    bool chosen; /* part of a case of an if(...): isolated points and curves count, too */
    bool exact; /* a counterexample refutes also the question as it was before the substitutions */
} qdot_question;

void qdot_question_demand(qdot_question *q, qdot_expr gap, bool weak);

/* Replace floor, mod, max and min in q->e, then bring it into the form that a field needs. */
void qdot_question_whole_parts(qdot_pool *pool, qdot_question *q);

/* Replace all functions except roots by symbols with bounds. q->e contains neither absolute values nor if. */
void qdot_question_reduce(qdot_pool *pool, qdot_question *q);

#endif
