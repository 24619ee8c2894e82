/* operands.h -- reads the expressions to be evaluated along runs, for tables and curves. */
#ifndef QDOT_LANG_OPERANDS_H
#define QDOT_LANG_OPERANDS_H

#include "lang/session/runs.h"
#include "lang/syntax/record.h"

typedef struct {
    char *label;               /* the expression as typed; owned */
    qdot_session *session;
    qdot_run *run;             /* the run along which to evaluate; NULL: the latest */
    const qdot_token *from, *to; /* its tokens from .. to - 1 */
    bool mixed;                /* the expression combines several runs; `run` is the first */
    bool vector;               /* the expression is a vector: the path of a point */
    qdot_runs_columns columns; /* the components of the expression, one column for each */
} qdot_operand;

typedef qdot_vec(qdot_operand) qdot_operands;

void qdot_operand_clear(qdot_operand *o);
void qdot_operands_free(qdot_operands *list);
/* Read operand k of a part of the statement: EXPR or RUN.EXPR. After an error, too, the operand must be cleared. */
QDOT_MUST_CHECK qdot_status qdot_operand_find(qdot_record *r, const qdot_filled *part, size_t k,
                                              qdot_operand *o);
/* Find the operands `E1, a.E2, ...`: this part and the parts of the same name after it. */
QDOT_MUST_CHECK qdot_status qdot_operands_find(qdot_record *r, const qdot_filled *first,
                                               qdot_operands *list);
/* Let operands that name no run use the latest run; QDOT_EINVAL if there is no run. */
QDOT_MUST_CHECK qdot_status qdot_operands_find_runs(qdot_session *session,
                                                    qdot_operands *list);
/* Along its run at times [rows]: values [components * rows], component by component, and the
 * errors of these; NULL: not wanted. */
QDOT_MUST_CHECK qdot_status qdot_operands_values(const qdot_operand *o, size_t rows,
                                                 const double *times, double *values,
                                                 double *errors);

#endif
