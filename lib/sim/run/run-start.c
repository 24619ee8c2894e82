/* run-start.c -- reads the time limits and the start of a run, and projects the start onto the constraints. */
#include "sim/run/run-start.h"

#include <math.h>
#include <string.h>

#include "expr/build.h"
#include "expr/node.h"
#include "sim/digits/digits.h"
#include "sim/form/tables.h"
#include "sim/model/massless.h"
#include "sim/start/start.h"
#include "tape/shake.h"

/* Refuse time limits that differ but round to the same double. */
static qdot_status
check_time_limits(qdot_run *run, const qdot_run_request *request)
{
    qdot_pool *pool = run->plan->pool;
    double length, low;
    int side;

    QDOT_TRY(qdot_plan_number(run->plan, qdot_sub(pool, request->t1, request->t0), &length, &side, &low));
    if (length == 0)
        return QDOT_OK;
    qdot_fail(QDOT_EINVAL, "the limits are %.3g apart, but round to the same double",
              fabs(length));
    return qdot_hint("run 0..%.15g, with times counted from there", length);
}

static qdot_status
read_start(qdot_run *run, const qdot_run_request *request)
{
    size_t n = run->plan->n;
    int side;

    run->start_low = qdot_calloc(2 * n, sizeof *run->start_low);
    run->start = qdot_calloc(2 * n, sizeof *run->start);
    run->units = qdot_calloc(2 * n, sizeof *run->units);
    if (!run->start || !run->start_low || !run->units)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_plan_number(run->plan, request->t0, &run->t0, &run->t0_side, &run->t0_low));
    QDOT_TRY(qdot_plan_number(run->plan, request->t1, &run->t1, &run->t1_side, &run->t1_low));
    if (run->t0 == run->t1 && request->t0 != request->t1)
        QDOT_TRY(check_time_limits(run, request));
    for (size_t i = 0; i < n; i++) {
        QDOT_TRY(qdot_plan_number(run->plan, request->q0[i], &run->start[i], &side,
                          &run->start_low[i]));
        QDOT_TRY(qdot_plan_number(run->plan, request->v0[i], &run->start[n + i], &side,
                          &run->start_low[n + i]));
    }
    return QDOT_OK;
}

/* Read run->apart, the given errors of the start; parameters that events set have none. */
static qdot_status
read_start_errors(qdot_run *run, const qdot_run_request *request)
{
    const size_t n = run->plan->n, named = n - request->n_states;

    if (request->apart == NULL)
        return QDOT_OK;
    run->apart = qdot_calloc(4 * n + 1, sizeof *run->apart);
    if (run->apart == NULL)
        return QDOT_ENOMEM;
    for (size_t part = 0; part < 4; part++) /* q and q' of the first shifted start, then of the second */
        for (size_t i = 0; i < named; i++)
            run->apart[part * n + i] = request->apart[part * named + i];
    return QDOT_OK;
}

static qdot_status
check_spring_lengths(const qdot_run *run, const qdot_scene *scene)
{
    for (size_t i = 0; i < scene->springs.n; i++) {
        const qdot_link *spring = &scene->springs.at[i];
        qdot_expr rest = qdot_plan_substitute(run->plan, spring->rest);

        QDOT_TRY(qdot_pool_check(run->plan->pool));
        if ((qdot_expr_node(run->plan->pool, rest)->sign & QDOT_NEG) == QDOT_NEG) {
            (void)qdot_fail(QDOT_EINVAL, "the rest length of %s%.100s is negative",
                            spring->name ? "spring " : "a spring",
                            spring->name ? spring->name : "");
            return qdot_hint("`rest 0`, or none, makes a spring that pulls at any length");
        }
    }
    return QDOT_OK;
}

/* Move the start state onto the constraints. */
static qdot_status
project_start(qdot_run *run, qdot_scene *scene, const qdot_run_request *request,
              const qdot_domains *domains)
{
    bool anew;

    if (!run->plan->constraints)
        return QDOT_OK;
    QDOT_TRY(qdot_start_settle(scene, run->plan, request, domains, run->start,
                               run->start_low, &run->notice));
    if (request->digits > 0)
        QDOT_TRY(qdot_digits_say_start(run, scene, request));
    QDOT_TRY(qdot_stage_settle(&run->stage, run->start, &anew));
    run->plan = run->stage.modes.at[0]->plan;
    return QDOT_OK;
}

static qdot_status
check_start_in_domains(qdot_run *run)
{
    const qdot_domain *d = qdot_domains_outside(&run->stage.domains, run->start);

    if (d) {
        const char *name = run->plan->names[d->coordinate];

        qdot_fail(QDOT_EDOMAIN, "the start %s = %.15g is outside its domain %.200s", name,
                  run->start[d->coordinate], d->text);
        return qdot_hint("start %s = ...", name);
    }
    /* make the equations of the run itself now, as they remember what is found about the constraints */
    QDOT_TRY(qdot_course_prepare(&run->course));
    QDOT_TRY(qdot_course_begin_history(&run->course, run->t0, run->start));
    return qdot_bind_check(run->course.binds.at[0], run->t0, run->start, run->start_low);
}

/* Project the start onto the constraints and check it. A massless coordinate that decides a switch
 * keeps its given value. */
static qdot_status
project_and_check_start(qdot_run *run, qdot_scene *scene, const qdot_run_request *request)
{
    const size_t n = run->plan->n;
    double *said = qdot_malloc((4 * n + 1) * sizeof *said);
    const size_t words = run->notice.n;
    qdot_status status = said ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK) {
        memcpy(said, run->start, 2 * n * sizeof *said);
        memcpy(said + 2 * n, run->start_low, 2 * n * sizeof *said);
        status = project_start(run, scene, request, &run->stage.domains);
    }
    /* settle the given start again, now with the plan for the sides of switches at the start */
    if (status == QDOT_OK && qdot_massless_switch(run->plan, &run->stage.switches)) {
        qdot_text_truncate(&run->notice, words);
        memcpy(run->start, said, 2 * n * sizeof *said);
        status = qdot_start_settle(scene, run->plan, request, &run->stage.domains, run->start, run->start_low, &run->notice);
        qdot_text_truncate(&run->notice, words);
    }
    if (status == QDOT_OK)
        status = check_start_in_domains(run);
    for (size_t i = 0; i < 2 * n && status == QDOT_OK && qdot_massless_switch(run->plan, &run->stage.switches); i++)
        if (run->plan->massless[i % n]) {
            run->start[i] = said[i];
            run->start_low[i] = said[2 * n + i];
        }
    qdot_free(said);
    return status;
}

/* Fail if the run would come to the end of a table of data, unless an event or a domain may end it before, or the equations
 * switch: perhaps to others that do not read it. */
static qdot_status
check_tables(const qdot_run *run, const qdot_scene *scene)
{
    QDOT_TRY(qdot_tables_refuse_jumps(run->plan, run->start, run->t0, run->t1));
    for (size_t i = 0; i < scene->events.n; i++)
        if (scene->events.at[i].stop)
            return QDOT_OK;
    return run->stage.domains.n > 0 || run->stage.switches.surfaces.n > 0 ? QDOT_OK : qdot_tables_reach(run->plan, run->t0, run->t1);
}

qdot_status
qdot_run_start(qdot_run *run, qdot_scene *scene, const qdot_run_request *request)
{
    QDOT_TRY(read_start(run, request));
    QDOT_TRY(read_start_errors(run, request));
    QDOT_TRY(check_spring_lengths(run, scene));
    QDOT_TRY(check_tables(run, scene));
    return project_and_check_start(run, scene, request);
}

qdot_status
qdot_run_name_redundant(qdot_run *run, qdot_scene *scene, const qdot_run_request *request)
{
    if (run->report.independent >= run->report.m)
        return QDOT_OK;
    return qdot_start_redundant(scene, run->plan, request, run->start, run->start_low,
                                &run->notice);
}
