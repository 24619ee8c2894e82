/* conditions.h -- under what conditions a run was made, and the studies made under them.
 *
 * Tests  tests/lang/session/test_conditions.c, tests/script/files/report-runs.sh
 */
#ifndef QDOT_LANG_CONDITIONS_H
#define QDOT_LANG_CONDITIONS_H

#include "sim/study/workprecision.h"

/* The scene, parameter values, start and limits of a run; the method of integration is not part of them. */
typedef struct {
    uint64_t version; /* version of the scene */
    qdot_vec(qdot_expr) symbols, values; /* parameters and their values */
    qdot_vec(qdot_expr) q0, v0;
    qdot_vec(bool) q_named, v_named;
    bool exactly;
    qdot_expr t0, t1;
    qdot_expr said[2]; /* the two time limits of the run as they were written; nil: t0, t1 */
} qdot_conditions;

/* Copy the conditions of a run request to *conditions, which must be {0}; clear it in any case. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_conditions_take(const qdot_scene *scene,
                                                 const qdot_run_request *request,
                                                 qdot_conditions *conditions);
void qdot_conditions_clear(qdot_conditions *conditions);

/* A run request with these conditions, tolerance 1e-12 and method auto; it borrows their arrays. */
qdot_run_request qdot_conditions_request(const qdot_conditions *conditions);

/* Whether two runs have the same version of the scene, and the same values, start and limits. */
bool qdot_conditions_same(const qdot_conditions *a, const qdot_conditions *b);

/* A work-precision study made under these conditions. */
typedef struct {
    qdot_conditions conditions;
    qdot_workprecision measured;
} qdot_kept_study;

typedef struct qdot_kept_studies {
    qdot_vec(qdot_kept_study);
} qdot_kept_studies;

/* The work-precision study made under these conditions, or NULL; borrowed. */
const qdot_workprecision *qdot_studies_find(const qdot_kept_studies *studies,
                                            const qdot_conditions *conditions);

/* Keep a study, the latest eight of them. Takes what both arguments own and leaves {0}, in any case.
 * QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_studies_keep(qdot_kept_studies *studies,
                                              qdot_conditions *conditions,
                                              qdot_workprecision *measured);
void qdot_studies_clear(qdot_kept_studies *studies);

#endif
