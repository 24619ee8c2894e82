/* assumed.h -- the assumptions of a check: the facts of the scene and the conditions after
 * `when`. */
#ifndef QDOT_LANG_ASSUMED_H
#define QDOT_LANG_ASSUMED_H

#include "lang/syntax/record.h"

typedef struct {
    qdot_vec(qdot_expr) relations, conditions; /* expressions that are 0; inequalities (REL) */
    qdot_vec(qdot_expr) from, to; /* replacements (from by to) made in every expression first */
    bool motion, stated; /* motion: `eom` was assumed; stated: an equation other than a constraint was assumed */
} qdot_assumed;

/* Add the facts of the scene to an empty set of facts. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_assumed_begin(qdot_session *session, qdot_assumed *f);
void qdot_assumed_free(qdot_assumed *f);
/* Add a condition after `when`: `eom`, the label of a constraint, or a relation. */
QDOT_MUST_CHECK qdot_status qdot_assumed_add(qdot_record *r, const qdot_filled *part, qdot_assumed *f);
/* `eom`: replace accelerations and multipliers by their solution, and add the constraints on q
 * and q'. */
QDOT_MUST_CHECK qdot_status qdot_assumed_motion(qdot_session *session, qdot_assumed *f);
/* Add the equation of constraint i and its time derivatives; the one that contains accelerations only if wanted. */
QDOT_MUST_CHECK qdot_status qdot_assumed_constraint(qdot_session *session, qdot_assumed *f,
                                                    size_t i, bool accelerations);
/* Write every momentum in the facts as dL/dq'; an equation of a momentum becomes a relation of velocities. */
QDOT_MUST_CHECK qdot_status qdot_assumed_in_velocities(qdot_session *session, qdot_assumed *f);
/* Replace loop indices in the facts by their present values. */
QDOT_MUST_CHECK qdot_status qdot_assumed_hold(qdot_session *session, qdot_assumed *f);
/* The expression e after all replacements of the facts. */
qdot_expr qdot_assumed_replace(qdot_session *session, const qdot_assumed *f, qdot_expr e);

#endif
