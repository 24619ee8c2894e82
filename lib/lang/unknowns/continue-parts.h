/* continue-parts.h -- what `continue` is asked, and its branches of orbits.
 *
 *     continue equilibria|orbit in NAME = A..B [as NAME]
 *
 * Tests  tests/script/continue/continue.lag, continue-orbit.lag, tests/bad/continue/continue.sh
 */
#ifndef QDOT_LANG_CONTINUE_PARTS_H
#define QDOT_LANG_CONTINUE_PARTS_H

#include "lang/language/cursor.h"
#include "lang/source/token.h"
#include "lang/unknowns/branches.h"

typedef struct {
    bool orbit;
    qdot_expr parameter; /* the parameter that is varied; nil: the energy of an orbit */
    const qdot_token *place, *range_at; /* tokens of the parameter and of its range A..B */
    double least, most;
    const char *name, *marks; /* names of the tables of branches and of bifurcations; `marks` owned */
    char *own;
} qdot_continue_wish;

/* Follow a branch of periodic orbits from the latest run that is one. */
QDOT_MUST_CHECK qdot_status qdot_continue_orbit(qdot_session *session, const qdot_continue_wish *w);
/* Store and print the branches that were found, even if they are incomplete. */
QDOT_MUST_CHECK qdot_status qdot_continue_conclude(qdot_session *session, const qdot_continue_wish *w,
                                                   const qdot_branches *b, qdot_status status);

#endif
