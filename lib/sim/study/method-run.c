/* method-run.c -- prepares a run by one given method (plan, system and start), for studies of methods. */
#include "sim/study/method-run.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "expr/exact.h"
#include "sim/model/constrained.h"
#include "sim/plan/plan.h"
#include "sim/start/start.h"

void
qdot_method_run_clear(qdot_method_run *m)
{
    qdot_bind_free(m->bind);
    qdot_stage_clear(&m->stage);
    qdot_tape_free(m->energy);
    qdot_free(m->start);
    qdot_free(m->in);
}

double
qdot_method_run_energy_error(qdot_method_run *m, double t, const double *y)
{
    const size_t n = 2 * m->plan->n;
    double h;

    memcpy(m->in, y, n * sizeof *y);
    m->in[n] = t;
    qdot_tape_eval(m->energy, m->in, &h, m->work);
    return (h - m->energy0) / fmax(1, fabs(m->energy0));
}

static qdot_status
read_start(qdot_method_run *m, const qdot_run_request *request)
{
    const size_t n = m->plan->n;
    double low;
    int side;

    m->start = qdot_calloc(6 * n, sizeof *m->start);
    if (!m->start)
        return QDOT_ENOMEM;
    m->low = m->start + 2 * n;
    m->y = m->low + 2 * n;
    QDOT_TRY(qdot_plan_number(m->plan, request->t0, &m->t0, &side, &low));
    QDOT_TRY(qdot_plan_number(m->plan, request->t1, &m->t1, &side, &m->t1_low));
    for (size_t i = 0; i < n; i++) {
        QDOT_TRY(qdot_plan_number(m->plan, request->q0[i], &m->start[i], &side, &m->low[i]));
        QDOT_TRY(qdot_plan_number(m->plan, request->v0[i], &m->start[n + i], &side, &m->low[n + i]));
    }
    return QDOT_OK;
}

/* Choose the mode again after projecting the start, which may have moved across a switching surface. */
static qdot_status
update_mode_of_start(qdot_method_run *m)
{
    bool anew;

    qdot_bind_free(m->bind); /* free the old equations, as they refer to a plan that may be freed next */
    m->bind = NULL;
    m->held = NULL;
    QDOT_TRY(qdot_stage_settle(&m->stage, m->start, &anew));
    m->plan = m->stage.modes.at[0]->plan;
    QDOT_TRY(qdot_bind_new(m->plan, false, &m->bind));
    QDOT_TRY(qdot_bind_scale(m->bind, m->stage.scales));
    m->held = qdot_bind_held(m->bind);
    return QDOT_OK;
}

/* Move the start state onto the constraints. */
static qdot_status
project_study_start(qdot_method_run *m, qdot_scene *scene, const qdot_run_request *request)
{
    qdot_domains domains = {0};
    qdot_text notice = {0};
    qdot_status status;

    m->held = qdot_bind_held(m->bind);
    if (!m->held)
        return QDOT_OK;
    status = qdot_domains_find(m->plan, &domains);
    if (status == QDOT_OK)
        status =
            qdot_start_settle(scene, m->plan, request, &domains, m->start, m->low, &notice);
    if (status == QDOT_OK && m->stage.switches.surfaces.n > 0)
        status = update_mode_of_start(m);
    if (status == QDOT_OK)
        status = qdot_bind_check(m->bind, m->t0, m->start, m->low);
    qdot_text_clear(&notice);
    qdot_domains_clear(&domains);
    return status;
}

qdot_status
qdot_method_run_find_energy(qdot_method_run *m, qdot_scene *scene)
{
    const qdot_plan *p = m->plan;
    const size_t n = 2 * p->n;
    bool conserved = false;
    qdot_expr h;

    QDOT_TRY(qdot_mech_energy_conserved(scene, &conserved));
    if (!conserved)
        return QDOT_OK;
    h = qdot_plan_substitute(p, qdot_mech_energy(scene));
    QDOT_TRY(qdot_pool_check(p->pool));
    QDOT_TRY(qdot_tape_new(p->pool, n + 1, p->inputs, 1, &h, &m->energy));
    m->in = qdot_calloc(n + 1 + qdot_tape_work(m->energy) + 1, sizeof *m->in);
    if (!m->in)
        return QDOT_ENOMEM;
    m->work = m->in + n + 1;
    memcpy(m->in, m->start, n * sizeof *m->in);
    m->in[n] = m->t0;
    qdot_tape_eval(m->energy, m->in, &m->energy0, m->work);
    return QDOT_OK;
}

qdot_status
qdot_method_run_init(qdot_method_run *m, qdot_scene *scene, const qdot_run_request *request,
                     const char *method, double tol)
{
    m->request = *request;
    m->request.method = method;
    m->request.digits = 0;
    m->request.tol = tol;
    QDOT_TRY(qdot_stage_begin(&m->stage, scene, &m->request));
    m->plan = m->stage.modes.at[0]->plan;
    m->pieces = m->stage.switches.surfaces.n > 0;
    for (size_t i = 0; i < m->stage.events.n; i++)
        m->pieces = m->pieces || qdot_staged_event_acts(&m->stage.events.at[i]);
    QDOT_TRY(qdot_bind_new(m->plan, false, &m->bind));
    QDOT_TRY(qdot_bind_scale(m->bind, m->stage.scales));
    QDOT_TRY(read_start(m, request));
    return project_study_start(m, scene, request);
}

qdot_status
qdot_method_run_settled(qdot_scene *scene, const qdot_run_request *request, qdot_expr *start)
{
    const size_t n = scene->coordinates.n;
    qdot_method_run m = {0};
    qdot_status status = qdot_method_run_init(&m, scene, request, "auto", request->tol);

    for (size_t i = 0; i < 2 * n && status == QDOT_OK; i++)
        start[i] = qdot_expr_of_double(scene->pool, m.start[i]);
    qdot_method_run_clear(&m);
    return status == QDOT_OK ? qdot_pool_check(scene->pool) : status;
}
