/* undone.h -- what undoes an event in a run that goes back in time.
 *
 *     event bounce: y = 0 falling then y' = -e*y'        before it    y' = -y'/e
 *     event wrap: x = 1 rising then x = x - 1            before it    x = x + 1, where x = 0
 *     event lap: x = 1 rising then x = 0                 the same, for x was 1
 *
 * The values that `then` sets are equations for those before it, solved where they are linear in these, block by block; one
 * that `then` forgets (x = 0) follows from the equation of the event. The event has just occurred where its function is 0
 * with the values before it.
 *
 * Tests  tests/sim/model/test_undone.c, tests/script/events/backward.lag
 */
#ifndef QDOT_SIM_UNDONE_H
#define QDOT_SIM_UNDONE_H

#include "normal/field/facts.h"

typedef struct {
    qdot_expr function; /* 0 at states just after the event; nil: no such function is known */
    qdot_expr *values;  /* [n] values before the event in terms of the state after it; owned */
    const char *why;    /* why these values cannot be determined; NULL: they are known */
} qdot_undone;

/* Find what undoes the event f = 0 then targets[i] = values[i], i < n; all in the same symbols. Errors: those of the pool,
 * QDOT_ENOMEM, QDOT_EINTERRUPTED. */
QDOT_MUST_CHECK qdot_status qdot_undone_find(qdot_pool *pool, qdot_expr f, size_t n, const qdot_expr *targets,
                                             const qdot_expr *values, qdot_undone *out);
void qdot_undone_clear(qdot_undone *undone);

#endif
