/* fit.c -- whether a scene can be run as an ensemble in vector lanes (SIMD), judged by the plan of one run. */
#include "sim/ensemble/fit.h"

#include <math.h>
#include <string.h>

#include "sim/bind/bind.h"
#include "sim/course/stage.h"
#include "sim/form/tables.h"
#include "sim/plan/plan.h"

static qdot_status
copy_domain_bounds(const qdot_domains *domains, qdot_ensemble_bounds *bounds)
{
    for (size_t i = 0; i < domains->n; i++) {
        const double ends[] = {domains->at[i].lo, domains->at[i].hi};

        for (int k = 0; k < 2; k++)
            if (isfinite(ends[k]))
                QDOT_TRY(qdot_vec_push(bounds, ((qdot_ensemble_bound){domains->at[i].coordinate,
                                                                      ends[k]})));
    }
    return QDOT_OK;
}

/* The reason of the system of a plan, or of a part of it. Where constraints lose their directions lanes
 * leave a member to a run alone. */
static const char *
why_system_unsuitable(const qdot_ode_system *system, bool constrained)
{
    for (size_t k = 0; k < system->n_parts; k++) {
        const char *reason = why_system_unsuitable(system->parts[k].system, constrained);

        if (reason)
            return reason;
    }
    if (system->n_parts > 0)
        return NULL;
    if (!system->series)
        return "the equations have no Taylor series";
    return system->series->noise && !constrained ? "the equations may be singular on the way" : NULL;
}

static qdot_status
check_plan(const qdot_plan *plan, qdot_text *why)
{
    qdot_bind *bind = NULL;
    const char *reason;
    qdot_status status;
    qdot_ode_system system;

    if (strcmp(plan->method->name, "taylor") != 0) {
        qdot_text_format(why, "method %s has no lanes", plan->method->name);
        return qdot_text_status(why);
    }
    if (qdot_tables_any(plan)) {
        qdot_text_add(why, "the equations read tables of data");
        return qdot_text_status(why);
    }
    if (plan->leading) {
        qdot_text_add(why, "the tolerance asks for more than doubles");
        return qdot_text_status(why);
    }
    status = qdot_bind_new(plan, false, &bind);
    if (status == QDOT_OK) {
        system = qdot_bind_system(bind);
        reason = why_system_unsuitable(&system, plan->constraints != NULL);
        if (reason)
            qdot_text_add(why, reason);
    }
    qdot_bind_free(bind);
    return status == QDOT_OK ? qdot_text_status(why) : status;
}

qdot_status
qdot_ensemble_fit(qdot_scene *scene, const qdot_run_request *request,
                  qdot_ensemble_bounds *bounds, qdot_text *why)
{
    const qdot_event *acting = qdot_scene_acting_event(scene);
    qdot_stage stage = {0};
    qdot_status status;

    if (scene->constraints.n > 0 && request->treatment != QDOT_RUN_PROJECT)
        qdot_text_add(why, "lanes treat constraints by projection only");
    else if (acting)
        qdot_text_format(why, "the event %s %s a run", acting->name, acting->stop ? "stops" : "changes");
    else if (request->digits > 0)
        qdot_text_add(why, "`digits` has no lanes");
    else if (request->scales)
        qdot_text_add(why, "the scene has scales");
    if (why->n > 0)
        return qdot_text_status(why);
    status = qdot_stage_begin(&stage, scene, request);
    if (status == QDOT_OK && stage.switches.surfaces.n > 0)
        qdot_text_add(why, "the equations switch");
    else if (status == QDOT_OK)
        status = check_plan(stage.modes.at[0]->plan, why);
    if (status == QDOT_OK)
        status = copy_domain_bounds(&stage.domains, bounds);
    qdot_stage_clear(&stage);
    return status == QDOT_OK ? qdot_text_status(why) : status;
}
