/* path.c -- stores the points of an ensemble member as the trajectory of a single run. */
#include "sim/ensemble/path.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "ode/taylor.h"
#include "sim/course/run-state.h"
#include "sim/plan/plan.h"

/* Make the stage of a single run in which the varied parameters are states, so that its plan can
 * expand each step. */
static qdot_status
make_stage_of_plan(const qdot_ensemble_path_of *of, qdot_stage *stage)
{
    qdot_mode *mode = qdot_calloc(1, sizeof *mode);
    qdot_parameter_states states;
    qdot_status status;

    if (!mode || qdot_vec_push(&stage->modes, mode) != QDOT_OK) {
        qdot_free(mode);
        return QDOT_ENOMEM;
    }
    status = qdot_parameter_states_open(&states, of->scene, of->request, of->n_varied, of->varied);
    states.request.method = "taylor";
    if (status == QDOT_OK)
        status = qdot_plan_new(of->scene, &states.request, &mode->plan);
    qdot_parameter_states_clear(&states);
    QDOT_TRY(status);
    stage->n = mode->plan->n;
    stage->n_states = mode->plan->n_states;
    stage->switches.pool = mode->plan->pool;
    return QDOT_OK;
}

static qdot_course *
course_of_pass(qdot_run *run, size_t pass)
{
    return pass == 0 ? &run->course : pass == 1 ? &run->companion : &run->twin;
}

static qdot_status
make_run_of_ensemble(const qdot_ensemble_path_of *of, qdot_run *run)
{
    qdot_run_report *report = &run->report;

    QDOT_TRY(make_stage_of_plan(of, &run->stage));
    run->plan = run->stage.modes.at[0]->plan;
    for (size_t pass = 0; pass < QDOT_ENSEMBLE_PASSES; pass++) {
        qdot_course *c = course_of_pass(run, pass);

        c->stage = &run->stage;
        c->shaken = pass == 1;
        QDOT_TRY(qdot_course_prepare(c));
    }
    qdot_ensemble_limits(of->ensemble, &run->t0, &run->t1, &report->tol);
    report->t0 = run->t0;
    report->t1 = run->t1;
    report->horizon = report->standstill = report->energy_drift = NAN;
    report->n = run->plan->n - run->plan->n_states;
    return QDOT_OK;
}

qdot_status
qdot_ensemble_path_new(const qdot_ensemble_path_of *of, qdot_run **out)
{
    qdot_run *run = qdot_calloc(1, sizeof *run);
    qdot_status status = run ? make_run_of_ensemble(of, run) : QDOT_ENOMEM;

    *out = NULL;
    if (status != QDOT_OK)
        qdot_run_free(run);
    else
        *out = run;
    return status;
}

/* Copy the points that a pass stored for an ensemble member into that member's course. */
static qdot_status
course_fill(const qdot_ensemble *e, size_t pass, size_t member, qdot_course *c)
{
    const qdot_ode_series *series = c->systems.at[0].series;
    const size_t points = qdot_ensemble_points(e, pass, member), n = 2 * c->stage->n;
    qdot_trajectory *tr = &c->tr;

    qdot_trajectory_clear(tr);
    tr->n = n;
    tr->method = c->stage->modes.at[0]->plan->method;
    tr->tol = qdot_ensemble_tolerance(e, pass);
    tr->order_more = qdot_ensemble_order(e, pass) - qdot_ode_taylor_order(series, tr->tol, false, 0);
    tr->t = qdot_calloc(points, sizeof *tr->t);
    tr->y = qdot_calloc(points * n, sizeof *tr->y);
    if (!tr->t || !tr->y)
        return QDOT_ENOMEM;
    tr->t_capacity = points;
    tr->y_capacity = points * n;
    for (; tr->count < points; tr->count++)
        qdot_ensemble_point(e, pass, member, tr->count, tr->t + tr->count, tr->y + tr->count * n);
    tr->result.stats.steps = points - 1;
    return qdot_vec_push(&tr->pieces, (qdot_trajectory_piece){0});
}

qdot_status
qdot_ensemble_path_take(const qdot_ensemble *e, size_t member, qdot_run *run, bool *there)
{
    *there = true;
    for (size_t pass = 0; pass < QDOT_ENSEMBLE_PASSES && *there; pass++) {
        *there = qdot_ensemble_points(e, pass, member) > 0;
        if (*there)
            QDOT_TRY(course_fill(e, pass, member, course_of_pass(run, pass)));
    }
    run->has_companion = run->has_twin = *there;
    return QDOT_OK;
}
