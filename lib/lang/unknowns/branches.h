/* branches.h -- branches of equilibria or of orbits and their bifurcations as rows, as JSON and in words.
 *
 *     {"kind":"row","name":"branch[1]","values":[Omega, theta],"stable":true}     null: undecided
 *     {"kind":"row","name":"bifurcation","type":"pitchfork","values":[Omega, theta]}
 *
 * Two tables: of the points of all branches (branch, parameter, coordinates, stable 1 or 0, which
 * bifurcation it is), and of the bifurcations, whose rows say their type.
 *
 * Tests  tests/script/continue/continue.lag, continue-files.sh
 */
#ifndef QDOT_LANG_BRANCHES_H
#define QDOT_LANG_BRANCHES_H

#include "lang/session/parts.h"
#include "sim/branches/continuation.h"

/* The branches found by `continue`, with the names of their unknowns. */
typedef struct {
    const qdot_continuation *found;
    const char *const *names; /* [found->width] names of unknowns, parameter, further quantities */
    const qdot_expr *of;      /* [found->width] what these are, for their units; nil: plain numbers */
    char *const *units;       /* [found->width] their units, NULL: none; or NULL: no units */
    const size_t *columns; /* [n_columns] indices of the quantities shown as columns, besides p */
    size_t n_columns, n_told, n_drawn; /* of the columns the first n_told appear in the text, the first n_drawn in the figure */
    bool orbits;
} qdot_branches;

/* Number of columns of a table of branches before the quantities (branch, p) and after them (stable, bifurcation). */
enum { QDOT_BRANCH_BEFORE = 2, QDOT_BRANCH_BEHIND = 2 };

/* Store two tables in the session: the branches under `name`, their bifurcations under `marks`. */
QDOT_MUST_CHECK qdot_status qdot_branches_keep(qdot_session *session, const qdot_branches *b,
                                               const char *name, const char *marks);
/* Print the branches that were found. */
QDOT_MUST_CHECK qdot_status qdot_branches_answer(qdot_session *session, const qdot_branches *b);

#endif
