/* method-run.h -- a scene made ready for one method, without companions: for studies of methods.
 *
 * The plan, the system, the start (brought onto the constraints) and, if asked for, where h is proved conserved,
 *
 *     (h(t) - h(t0)) / max(1, |h(t0)|)
 *
 * Tests  tests/sim/study/test_workprecision.c, test_longtime.c
 */
#ifndef QDOT_SIM_METHOD_RUN_H
#define QDOT_SIM_METHOD_RUN_H

#include "sim/bind/bind.h"
#include "sim/course/stage.h"

/* A run for a study of methods. Must not be copied: its stage points to the request. */
typedef struct {
    qdot_run_request request;
    qdot_stage stage;
    qdot_plan *plan; /* how to compute the motion with the sides of all switching surfaces as at the start; owned by `stage` */
    qdot_bind *bind;
    qdot_constrained *held; /* constraint solver; NULL: no constraints */
    bool pieces;            /* events or switches may divide the run into pieces */
    double t0, t1, t1_low;
    double *start, *low, *y; /* [2n] exact start is start + low; y is scratch */
    qdot_tape *energy;       /* the energy h; NULL: not conserved, or not requested */
    double *in, *work, energy0;
} qdot_method_run;

/* Start *m from {0}; clear it in any case. Errors: as qdot_run_new; QDOT_ENOTBUILT: the method does
 * not fit. */
QDOT_MUST_CHECK qdot_status qdot_method_run_init(qdot_method_run *m, qdot_scene *scene,
                                                 const qdot_run_request *request,
                                                 const char *method, double tol);
void qdot_method_run_clear(qdot_method_run *m);

/* Derive the energy of the scene, if the energy is conserved. */
QDOT_MUST_CHECK qdot_status qdot_method_run_find_energy(qdot_method_run *m, qdot_scene *scene);

/* Find the start of the scene projected onto its constraints, as exact constants [2n]. */
QDOT_MUST_CHECK qdot_status qdot_method_run_settled(qdot_scene *scene,
                                                    const qdot_run_request *request,
                                                    qdot_expr *start);

/* The error of the conserved energy at (t, y), relative to max(1, |initial energy|). */
double qdot_method_run_energy_error(qdot_method_run *m, double t, const double *y);

#endif
