/* crawl.h -- detects runs whose steps have become so short that they will not arrive.
 *
 * A method may step over a place beyond which there is no solution, and then creep along it with
 * tiny steps, each within its tolerance. A run crawls if nearly all of 2000 consecutive steps
 * were below 2^-24 of the longest step taken, and more such steps would be needed than the run
 * has left. Close passages take steps as short, but only a few hundred.
 *
 * Tests  tests/script/constraints/constraint-ends.sh
 */
#ifndef QDOT_ODE_CRAWL_H
#define QDOT_ODE_CRAWL_H

#include <math.h>
#include <stdint.h>

#include "base/status.h"

typedef struct {
    double t;       /* end of the previous step */
    double longest; /* length of the longest step taken so far */
    unsigned short_steps;
} qdot_ode_crawl;

/* Look after a step that ended at t; the run to t1 may take `left` more. QDOT_EFAILED: it crawls.
 *  */
static inline qdot_status
qdot_ode_crawl_look(qdot_ode_crawl *c, double t, double t1, uint64_t left)
{
    const double h = fabs(t - c->t);

    c->t = t;
    c->longest = h > c->longest ? h : c->longest;
    if (h > 0x1p-24 * c->longest || fabs(t1 - t) < h * (double)left)
        c->short_steps -= c->short_steps > 0;
    else if (++c->short_steps > 2000)
        return qdot_fail(QDOT_EFAILED,
                         "stopped at t = %.17g: steps came down to %.2g and get nowhere", t, h);
    return QDOT_OK;
}

#endif
