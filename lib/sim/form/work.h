/* work.h -- what an expansion of a form consists of, counted: facts for sim/plan/cost.h.
 *
 * A form tells what it has; what is not there is 0.
 *
 * Tests  tests/sim/plan/test_cost.c
 */
#ifndef QDOT_SIM_WORK_H
#define QDOT_SIM_WORK_H

#include "series/motion.h"
#include "sim/model/equations.h"

typedef struct {
    double coordinates;
    double length; /* number of program steps executed by compiled kernels, repetitions counted */
    double convolutions; /* products of two series in the program, each evaluated anew at every order */
    double calls;        /* calls of elementary functions, once for each expansion */
    double operations;   /* operations of the tape that computes K */
    /* Of blocks of n >= 2 unknowns that are solved for together: sums of n, n^2, n^3; of
     * those that are factored in every expansion: sums of n, n^3. */
    double unknowns, squares, cubes;
    double factored, factored_cubes;
    /* Constraints by their own coefficients: numbers in the factor of [M A^T; A 0]; whether
     * its inverse is made. */
    double filled;
    bool inverted;
    /* Along a tree: nodes; convolutions of whole vectors, which like parts have too; products of the sweeps, and
     * of their beginning. */
    double nodes, vectors, products, begun;
    bool code; /* machine code can be generated, if the processor supports it */
} qdot_work;

/* Of a motion of the plan, whose blocks are the plan's or, with constraints, one; `tape`: of the
 * equations, of a residual that of M. Whether it may be code is not known here. */
qdot_work qdot_work_of_motion(const qdot_plan *plan, const qdot_motion *motion,
                              const qdot_tape *tape);

#endif
