/* check-parts.h -- what the files of the statement `check` share. */
#ifndef QDOT_LANG_CHECK_PARTS_H
#define QDOT_LANG_CHECK_PARTS_H

#include "lang/declare/assumed.h"
#include "lang/session/evaluation.h"
#include "normal/prove/decide.h"

typedef enum { QDOT_CHECK_EQUAL, QDOT_CHECK_PROPORTIONAL, QDOT_CHECK_LESS, QDOT_CHECK_LESS_EQUAL } qdot_check_comparison;

/* The claim of a statement, as it was read. */
typedef struct {
    bool not, conserved, within, integrable;
    bool turned; /* the claim was a > b; decided as b < a */
    qdot_expr left, right;
    qdot_check_comparison how;
    double tol;
    qdot_passed passed; /* subexpressions that were evaluated while the sides of the claim were read */
} qdot_check_question;

/* Decide and answer `left == right`, `~`, `<` or `<=` under the assumptions f, exactly or, `within`, in numbers. */
QDOT_MUST_CHECK qdot_status qdot_check_compare(qdot_cursor *c, qdot_check_question *q, qdot_assumed *f);
/* Decide and answer `conserved left`: whether the rate of the value on the left is 0 along the motion (check-conserved.c). */
QDOT_MUST_CHECK qdot_status qdot_check_conserved(qdot_cursor *c, qdot_check_question *q, qdot_assumed *f);

/* All facts known for the decision of the claim, in the form that the functions qdot_decide_... take. */
qdot_facts qdot_check_known_facts(qdot_session *session, const qdot_assumed *f, const qdot_check_question *q);
/* The verdict on two values of one shape: the worst of those on their components. */
QDOT_MUST_CHECK qdot_status qdot_check_by_components(qdot_session *session, qdot_expr left, qdot_expr right,
                                                     qdot_check_comparison how, const qdot_facts *known, qdot_decision *decision);
/* If nothing was refuted: give a notice if the conditions contradict each other. */
QDOT_MUST_CHECK qdot_status qdot_check_contradiction(qdot_session *session, const qdot_assumed *f, const qdot_facts *known);
/* Answer the verdict, with left and right as they were compared; a claim that does not hold is remembered. */
QDOT_MUST_CHECK qdot_status qdot_check_answer(qdot_session *session, const qdot_check_question *q, qdot_expr left, qdot_expr right,
                                              const qdot_decision *decision);

#endif
