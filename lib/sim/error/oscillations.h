/* oscillations.h -- fast oscillations that a stiff method has gone over.
 *
 * Radau IIA and its kin damp what oscillates many times within a step, also where the equations do not. What
 * had velocities below the tolerance is then missing in the run and in its companions alike, though accelerations hold it |lambda|
 * times as large. With J = df/dy, J v_k = lambda_k v_k, the largest velocity in v_k being 1, and
 * y'' = df/dt + J f = sum_k lambda_k c_k v_k, modes k are gone over where
 *
 *     Im lambda_k > |Re lambda_k|,    |lambda_k| h > 2 pi,    h the longest step of the run,
 *
 * and A^2 = sum_k |2 c_k|^2 over them is the square of the acceleration in them, little of the slow motion included. At the
 * start and at points about the end of the first step that is too long this falls by what is lost, and at t
 *
 *     error of g = 2 a sum_k |(dg/dy) v_k| / |lambda_k|,    a = (max A - min A) e^(least |Re lambda_k| (t0 - t)).
 *
 * a/|lambda_k| at most 100 tolerances of a velocity: more is in the estimate of a step's error. What was followed for more than
 * 50 steps is known by the companions; what an event excites later is not looked for.
 *
 * Tests  tests/script/methods/fast-oscillations.sh
 */
#ifndef QDOT_SIM_OSCILLATIONS_H
#define QDOT_SIM_OSCILLATIONS_H

#include "sim/course/course.h"
#include "sim/course/reader.h"

typedef struct qdot_oscillations qdot_oscillations;

/* Make *out; NULL if the run has passed over no oscillation. Errors: QDOT_ENOMEM. The course is borrowed. */
QDOT_MUST_CHECK qdot_status qdot_oscillations_new(const qdot_course *course,
                                                  qdot_oscillations **out);
void qdot_oscillations_free(qdot_oscillations *o);

/* Add what they make of the expressions [m] of the reader, along that course alone, to errors [m]; values [m] were
 * read last, at t. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_oscillations_add(qdot_oscillations *o, qdot_reader *r, double t,
                                                  const double *values, double *errors);

#endif
