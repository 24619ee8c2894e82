/* forms.h -- evaluates sum(EXPR, k, a, b) and if(C, A, B); *pc: the next code. */
#ifndef QDOT_LANG_FORMS_H
#define QDOT_LANG_FORMS_H

#include "lang/language/machine.h"

QDOT_MUST_CHECK qdot_status qdot_forms_sum(qdot_machine *m, const qdot_postfix *code,
                                           uint32_t *pc);
/* The summand has been evaluated: add it and go on. The SUM_BEGIN that began the sum stands before
 * frame.resume. */
QDOT_MUST_CHECK qdot_status qdot_forms_sum_next(qdot_machine *m, uint32_t *pc);
/* Report the failure of a sum with too many terms to be added one by one, for which no formula was found. */
qdot_status qdot_forms_too_many_terms(const qdot_sum_frame *f, qdot_status status);
QDOT_MUST_CHECK qdot_status qdot_forms_if(qdot_machine *m, const qdot_postfix *code,
                                          uint32_t *pc);
void qdot_forms_else(qdot_machine *m, const qdot_postfix *code, uint32_t *pc);
QDOT_MUST_CHECK qdot_status qdot_forms_end(qdot_machine *m);

#endif
