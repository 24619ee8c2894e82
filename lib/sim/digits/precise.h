/* precise.h -- `digits N`: a run whose end state has N correct digits.
 *
 * Two runs in MPFR go in parallel on two threads: the run itself under a tolerance of
 * 10^-D with numbers of some 32 bits more, and a companion under 10^-(D+3), of another
 * order, with constants, start and limits evaluated to more bits. Their distance
 *
 *     error = max_i |y_i - y*_i| / max(1, |y*_i|)    at the end
 *
 * (or the median of the same over nine times of the latter half, if that is larger: the two may
 * be near by chance at one time), never below 10^-D, is the error stated; the companion's own
 * error is smaller by 10^3. D is found from the scene:
 *
 *     a pair at D = 19 measures the amplification A = error 10^D (D is doubled until
 *     the pair still agrees at its end), then D = N + log10 A + 3, and again with more
 *     until error <= 10^-N / 2.
 *
 * States are not projected onto the constraints: drift is part of the error that is measured.
 * Values that the start does not name are solved for if the constraints determine them
 * (sim/digits/precise-start.h); any other start that breaks the constraints is moved to the nearest
 * one that keeps them, as in doubles (sim/digits/precise-hold.h). After an event that sets values
 * the others are brought onto the constraints likewise.
 *
 * A chaotic scene only needs more digits. Requests that a run in doubles refuses are refused with
 * the same message before. Values along the run come from the series of its steps; their error is
 * the distance from the companion's.
 *
 * Tests  tests/sim/digits/test_precise.c: the reference states of independent programs.
 */
#ifndef QDOT_SIM_PRECISE_H
#define QDOT_SIM_PRECISE_H

#include "sim/course/course.h"
#include "sim/course/drift.h"
#include "sim/model/domain.h"
#include "sim/model/equations.h"

/* The most digits that may be requested. */
enum { QDOT_PRECISE_MOST_DIGITS = 10000 };

typedef struct qdot_precise_pair qdot_precise_pair;

/* Check that request->digits, its method and its treatment of constraints are allowed; QDOT_EINVAL if not. */
QDOT_MUST_CHECK qdot_status qdot_precise_check(const qdot_scene *scene,
                                               const qdot_run_request *request);

/* The request, changed to the method taylor, for making the plan and for qdot_precise_pair_new. */
qdot_run_request qdot_precise_request(const qdot_run_request *request);

/* Carry out both runs of a request, whose plan has the method taylor; plan borrowed. start [2n]:
 * in doubles, on the constraints. guide: the run in doubles if events or switches divide it,
 * borrowed; else NULL (sim/digits/precise-course.h). QDOT_OK whenever there is a run, kept in
 * *pair; its result may be a failure. QDOT_EINTR with *pair: the run so far. */
QDOT_MUST_CHECK qdot_status qdot_precise_pair_new(const qdot_plan *plan,
                                                  const qdot_run_request *request,
                                                  const double *start,
                                                  qdot_domains *domains,
                                                  const struct qdot_course *guide,
                                                  qdot_precise_pair **pair);
void qdot_precise_pair_free(qdot_precise_pair *pair);

/* The integration result of the run itself; further functions: its error, tolerance, factorisations. */
const qdot_ode_result *qdot_precise_pair_result(const qdot_precise_pair *pair);
double qdot_precise_pair_error(const qdot_precise_pair *pair); /* estimated log10 of the error; NaN: unknown */
double qdot_precise_pair_tol(const qdot_precise_pair *pair);
size_t qdot_precise_pair_factored(const qdot_precise_pair *pair);

/* Component i of the end state (q, q') as an exact rational number: the binary number that was computed. */
qdot_expr qdot_precise_pair_end(const qdot_precise_pair *pair, size_t i);

/* The time of occurrence i, in the order of the run in doubles, and its error; nil and NaN if unknown. */
qdot_expr qdot_precise_pair_time(const qdot_precise_pair *pair, size_t i, double *error);

/* Fill tr with the points of the run as doubles and some within each step, near enough to each
 * other for the steps of a run in doubles. */
QDOT_MUST_CHECK qdot_status qdot_precise_pair_sample(const qdot_precise_pair *pair,
                                                     qdot_trajectory *tr);

/* Expressions [m] at a time, an exact constant (nil: the end, as each run has it): values [m] rationals, errors [m] (absolute;
 * NaN unknown; may be NULL). Errors: as qdot_run_values. */
QDOT_MUST_CHECK qdot_status qdot_precise_pair_values(qdot_precise_pair *pair, size_t m,
                                                     const qdot_expr *exprs,
                                                     qdot_expr time, qdot_expr *values,
                                                     double *errors);

/* Values of expressions at the first or the last point of a piece, of each run at its own: the states on either side of
 * an event. */
QDOT_MUST_CHECK qdot_status qdot_precise_pair_end_values(qdot_precise_pair *pair, size_t m,
                                                         const qdot_expr *exprs, size_t piece,
                                                         bool last, qdot_expr *values,
                                                         double *errors);

/* Like qdot_precise_pair_values, at times [k] in doubles; values [k x m] are rounded to doubles. */
QDOT_MUST_CHECK qdot_status qdot_precise_pair_sample_values(
    qdot_precise_pair *pair, size_t m, const qdot_expr *exprs, size_t k,
    const double *times, double *values, double *errors);

/* Measure again, at the points of the run with `digits`, the drifts that were measured in doubles. */
QDOT_MUST_CHECK qdot_status qdot_precise_pair_drifts(qdot_precise_pair *pair,
                                                     qdot_drifts *drifts);

#endif
