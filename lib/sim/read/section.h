/* section.h -- Poincaré's section: where a run crosses a surface, and what it is like there.
 *
 *     g(q, q', t, q'') = 0,  crossed upwards or downwards as t grows, or either way
 *
 * Every root of the stored steps is found (sim/course/crossings.h). It stands at a double of t; what
 * is read there is taken to the root itself by slopes. The error of a number is its distance from
 * those at the same crossings of the companions, so a motion that is only late has exact points.
 *
 * Tests  tests/script/studies/poincare.sh
 */
#ifndef QDOT_SIM_SECTION_H
#define QDOT_SIM_SECTION_H

#include "sim/run/run.h"

typedef struct {
    qdot_expr g;
    int way; /* as t grows: 1: g rises through 0, -1: falls; 0: both, and touches of 0 */
    size_t m;
    const qdot_expr *exprs; /* [m] expressions to evaluate at the crossings */
    const double *limits;   /* [2] limits of time; NULL: the whole run */
} qdot_section_of;

typedef struct {
    size_t n, m;     /* number of crossings, in the order of the run; number of expressions */
    double *t, *t_errors;    /* [n] times of the crossings and their errors */
    double *values, *errors; /* [n x m] values and their errors; NaN: undefined, error unknown */
    double lost; /* time from which crossings are unknown (sim/course/crossings.h); NaN: all are known */
} qdot_section;

/* Start from {.lost = NAN}; clear it in any case. QDOT_EDOMAIN: g is undefined somewhere; QDOT_ENOTBUILT: a run
 * with `digits`. */
QDOT_MUST_CHECK qdot_status qdot_section_find(qdot_run *run, const qdot_section_of *of,
                                              qdot_section *s);
void qdot_section_clear(qdot_section *s);

#endif
