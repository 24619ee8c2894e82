/* question.h -- an inequality and its conditions, made algebraic: what inequality.h says is put in. For
 * inequality.c alone.
 */
#ifndef QDOT_NORMAL_QUESTION_H
#define QDOT_NORMAL_QUESTION_H

#include "normal/inequality/cells.h"

enum { QDOT_QUESTION_CONDITIONS = 16 };

/* Is e >= 0 (or > 0) where the conditions hold? */
typedef struct {
    qdot_expr e;
    qdot_cells_condition condition[QDOT_QUESTION_CONDITIONS];
    size_t n;
    bool too_much;
    int64_t *work; /* what is left of the budget of all questions */
    bool chosen; /* by an if: what no open set holds counts too */
    bool exact; /* a point where it fails is a point of the question that was asked */
} qdot_question;

void qdot_question_demand(qdot_question *q, qdot_expr gap, bool weak);

/* Replace floor, mod, max and min in e, and prepare e. */
void qdot_question_whole_parts(qdot_pool *pool, qdot_question *q);

/* Replace all functions except roots. q->e holds neither absolute values nor if. */
void qdot_question_reduce(qdot_pool *pool, qdot_question *q);

#endif
