/* workprecision.h -- what accuracy costs: every method over a ladder of tolerances,
 * against a reference that is made here.
 *
 * The reference is a run by Taylor series in MPFR to 20 digits with its own error
 * (precise.h); of a scene with constraints that this cannot do a run in doubles at tol 1e-15
 * with the error it states. For each method and tol = 1e-3, 1e-4, ... 1e-15, of the end state y,
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
 * Events with `then` or `stop` and switches divide the runs as they do any (course.h); their
 * location is part of the time. Where an event ends them its time is compared, too; the energy
 * is followed where no event changes the state.
 *
 * A run whose error is a tenth of the motion's variation (horizon.h) is a row that says
 * that no digit is right; one that fails, or that takes more evaluations than are worth waiting for, is a row
 * that says so. The run whose energy is followed is not one of those timed.
 *
 * Source  Hairer, Norsett & Wanner I, II.10; SciMLBenchmarks (the diagrams).
 * Tests   tests/sim/test_workprecision.c
 */
#ifndef QDOT_SIM_WORKPRECISION_H
#define QDOT_SIM_WORKPRECISION_H

#include <stdint.h>

#include "sim/run/run.h"

typedef struct {
    const char *method;
    double tol, err, scd, time_min, time_median; /* NaN where it failed */
    uint64_t evals, steps, rejected;
    double energy_err; /* NaN: not conserved, or failed */
    double constraint_err; /* NaN: no constraints, or failed */
    char status[300];  /* "done", "done: no digit is right", or "failed: " and why */
} qdot_workprecision_row;

/* Of a method that this scene has no use for, and why. */
typedef struct {
    const char *method;
    char reason[300];
} qdot_workprecision_unfit;

typedef struct {
    double budget; /* operations that a run may take, about; 0: 3e8 */
    size_t n, capacity;
    qdot_workprecision_row *rows; /* method by method, tolerances falling */
    size_t n_unfit, unfit_capacity;
    qdot_workprecision_unfit *unfit;
    double ref_err; /* of the reference, as err */
    bool constraints; /* the scene has some */
} qdot_workprecision;

/* request: values, start and limits; its method and tolerance are not looked at. Start
 * *out from {0}, a budget set if wanted; clear it in any case. Errors: as qdot_run_new; QDOT_EFAILED where the
 * reference does not reach its end. */
QDOT_MUST_CHECK qdot_status qdot_workprecision_measure(qdot_scene *scene,
                                                       const qdot_run_request *request,
                                                       qdot_workprecision *out);
void qdot_workprecision_clear(qdot_workprecision *w);

#endif
