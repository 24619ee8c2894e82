/* bordered.h -- accelerations and multipliers under few constraints, by machine code.
 *
 *     [ M_0  A_0^T ] [  a_k ]   [  f_k  ]    k  [ M_j  A_j^T ] [  a_{k-j} ]
 *     [ A_0    0   ] [ -l_k ] = [ gamma_k ] - sum  [ A_j    0   ] [ -l_{k-j} ]
 *                                            j=1
 *
 * is one more block of the program of M q'' = f (motion-of-equations.h), so that a whole expansion
 * is a single call (motion-series.h). Constraints are differentiated here, which takes more
 * convolutions than their own coefficients (sim/form/motion-of-constraints.h), and the inverse is
 * found without a correction: it is for tolerances from QDOT_ELIMINATED_TOL on, as the form
 * of eliminated.h is, and for n + m up to QDOT_BORDERED_MOST.
 *
 * It exists as code only. Before that is written, and at a state where a row of A has less
 * than a third of its length left beyond the others, another series is begun; where the
 * first state is one, nothing is written.
 *
 * Tests  tests/sim/form/test_bordered.c
 */
#ifndef QDOT_SIM_BORDERED_H
#define QDOT_SIM_BORDERED_H

#include "sim/model/equations.h"

/* The equations of this form, of a plan with constraints, complete but for what sim/plan decides: a
 * tape for plan->bordered, of which plan->motion is to be made; NULL where the form is not for the
 * plan, the tolerance or the processor. Errors: those of lowering. */
QDOT_MUST_CHECK qdot_status qdot_bordered_make(const qdot_plan *plan, double tol,
                                               qdot_tape **tape);

#endif
