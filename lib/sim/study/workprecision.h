/* workprecision.h -- cost of accuracy: every method over a ladder of tolerances, against a
 * reference run.
 *
 * The reference is a run by Taylor series in MPFR to 20 digits with its own error (precise.h); if
 * that is not possible for a scene with constraints, a run in doubles at tol 1e-15 with its
 * stated error. For each method and tol = 1e-3, 1e-4, ... 1e-15, with the end state y,
 *
 *     err         max_i |y_i - ref_i| / max(1, |ref_i|)    (relative error)
 *     scd         -log10 err, its significant correct digits
 *     energy_err  max |h(t) - h(t0)| / max(1, |h(t0)|) over the steps, where h is proved
 *                 conserved
 *     constraint_err   the largest |f| of holonomic constraints over the steps, of velocity
 *                 constraints where there are no others
 *     time        CPU seconds of the integration alone, this thread, no companion: the
 *                 least and the median of three to nine runs
 *
 * Events with `then` or `stop` and switches divide the runs as usual (course.h); the time
 * includes locating them. If an event ends the runs its time is compared, too; the energy is
 * followed if no event changes the state.
 *
 * The row of a run whose error is a tenth of the motion's variation (horizon.h) says that no
 * digit is right; that of a run that failed or took too many evaluations says so. The run whose
 * energy is followed is not one of those timed.
 *
 * Source  Hairer, Norsett & Wanner I, II.10; SciMLBenchmarks (the diagrams).
 * Tests   tests/sim/study/test_workprecision.c
 */
#ifndef QDOT_SIM_WORKPRECISION_H
#define QDOT_SIM_WORKPRECISION_H

#include <stdint.h>

#include "sim/run/run.h"
#include "sim/study/left-out.h"

typedef struct {
    const char *method;
    double tol, err, scd, time_min, time_median; /* tolerance, error, correct digits, CPU times; NaN: failed */
    uint64_t evals, steps, rejected;
    double energy_err; /* error of the conserved energy; NaN: not conserved, or the run failed */
    double constraint_err; /* largest constraint residual; NaN: no constraints, or failed */
    char status[300];  /* "done", "done: no digit is right", or "failed: " and the reason */
} qdot_workprecision_row;

typedef struct {
    double budget; /* largest number of operations of a run, approximately; 0: 3e8 */
    size_t n, capacity;
    qdot_workprecision_row *rows; /* [n] rows method by method, with decreasing tolerance */
    qdot_methods_left_out left_out;
    double ref_err; /* error of the reference run, measured in the same way as `err` */
    bool interrupted; /* interrupted by Ctrl-C: only some rows are filled */
    bool constraints; /* the scene has constraints */
} qdot_workprecision;

/* request: values, start and limits; its method and tolerance are not used. Start *out from {0},
 * with a budget if wanted; clear it in any case. Errors: as qdot_run_new; QDOT_EFAILED if the
 * reference does not reach its end. */
QDOT_MUST_CHECK qdot_status qdot_workprecision_measure(qdot_scene *scene,
                                                       const qdot_run_request *request,
                                                       qdot_workprecision *out);
void qdot_workprecision_clear(qdot_workprecision *w);

#endif
