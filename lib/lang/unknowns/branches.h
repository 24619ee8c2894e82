/* branches.h -- branches of equilibria and their bifurcations as rows, as JSON and in words.
 *
 *     {"kind":"row","name":"branch[1]","values":[Omega, theta],"stable":true}     null: undecided
 *     {"kind":"row","name":"bifurcation","type":"pitchfork","values":[Omega, theta]}
 *
 * Two tables: of the points of all branches (branch, parameter, coordinates, stable 1 or 0, which
 * bifurcation it is), and of the bifurcations, whose rows say their type.
 *
 * Tests  tests/script/continue.lag, continue-files.sh
 */
#ifndef QDOT_LANG_BRANCHES_H
#define QDOT_LANG_BRANCHES_H

#include "lang/session/session.h"
#include "sim/study/continuation.h"

/* What was followed. */
typedef struct {
    const qdot_equilibrium_curve *curve;
    const qdot_continuation *found;
    double least, most; /* of the parameter */
} qdot_branches;

/* Columns of the table of branches before and behind the coordinates: branch, p; stable, bifurcation. */
enum { QDOT_BRANCH_BEFORE = 2, QDOT_BRANCH_BEHIND = 2 };

/* Keep both tables: `name`, and `marks`. */
QDOT_MUST_CHECK qdot_status qdot_branches_keep(qdot_session *session, const qdot_branches *b,
                                               const char *name, const char *marks);
/* Tell what was found. */
QDOT_MUST_CHECK qdot_status qdot_branches_answer(qdot_session *session, const qdot_branches *b);

#endif
