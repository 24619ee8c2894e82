/* equilibria.h -- answers a list of equilibria or of steady motions, with their stability. */
#ifndef QDOT_LANG_ASK_EQUILIBRIA_H
#define QDOT_LANG_ASK_EQUILIBRIA_H

#include "lang/functions/equilibria.h"
#include "lang/syntax/record.h"

/* Carry out the statement `equilibria` or `steady`: find, remember and answer; noun: what one of them is called. */
QDOT_MUST_CHECK qdot_status qdot_equilibria_answer(qdot_record *r, qdot_equilibria_search *find, const char *noun);

#endif
