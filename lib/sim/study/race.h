/* race.h -- one scene in every formulation it allows, each at a ladder of tolerances.
 *
 *     as given, with projection | Baumgarte's damping | nothing against drift
 *     in minimal coordinates (mech/coordinates/minimal.h), where the constraints can be solved
 *
 * The end error of a run is the largest difference of a coordinate or velocity of the scene
 * as given from those of a reference, relative to max(1, |value|). The reference is the
 * scene as given, projected, at the least tolerance, with the error stated by that run.
 *
 * Tests  tests/script/studies/race.sh
 */
#ifndef QDOT_SIM_RACE_H
#define QDOT_SIM_RACE_H

#include "sim/run/run.h"

enum { QDOT_RACE_FORMULATIONS = 4, QDOT_RACE_TOLERANCES = 6 };

typedef struct {
    const char *method;        /* name of the method; NULL: not run at this tolerance */
    double tol, error;         /* tolerance and error of the end state; NaN: the run failed */
    double energy, constraint; /* drifts of energy and of constraints; NaN: none */
    double cpu;                /* CPU seconds of the integration, the smallest of several runs */
} qdot_race_entry;

typedef struct {
    const char *name; /* name of the formulation, "as given, projected" ...; NULL: not run */
    char *reason;     /* why the formulation was not run; owned */
    qdot_race_entry entry[QDOT_RACE_TOLERANCES];
} qdot_race_lane;

typedef struct {
    qdot_race_lane lane[QDOT_RACE_FORMULATIONS];
    size_t coordinates, minimal; /* number of coordinates as given; in minimal coordinates, 0: no such form */
    double reference_tol, reference_error;
    char *notice; /* notice about the start; NULL: none */
    bool interrupted; /* interrupted by Ctrl-C: only some rows are filled */
} qdot_race;

/* request: its tol, method and treatment are not used. Errors: as qdot_run_new; QDOT_EFAILED
 * if the reference does not reach the end. */
QDOT_MUST_CHECK qdot_status qdot_race_hold(qdot_scene *scene,
                                           const qdot_run_request *request,
                                           qdot_race *race);
void qdot_race_clear(qdot_race *race);

#endif
