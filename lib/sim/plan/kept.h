/* kept.h -- plans kept with their scene: a run that asks for the same equations takes them as they
 * are.
 *
 * A plan is const and knows no start, no limits and, within bounds, no tolerance; runs, the kept
 * ones too, hold a use of it each (qdot_plan_free gives it back). The latest few are kept until the
 * scene changes, where nothing switches: for the same values, method, treatment of drift, and
 *
 *     the same tolerance   with constraints, whose form depends on it
 *     the same side of QDOT_ODE_LEADING_TOL
 *     the same start too   where what cancels at it decided about momenta (sim/plan/routh.h)
 *
 * Tests  tests/sim/plan/test_tree-alone.c
 */
#ifndef QDOT_SIM_KEPT_H
#define QDOT_SIM_KEPT_H

#include "sim/form/derived.h"

/* The cached plan for this request, with its reference count raised; NULL if there is none. */
qdot_plan *qdot_kept_find(const qdot_scene *scene, const qdot_run_request *request);

/* Keep a plan that was made of the request, of a scene in which nothing switches. Without memory it is
 * not kept. */
void qdot_kept_add(qdot_scene *scene, const qdot_run_request *request, qdot_plan *plan);

#endif
