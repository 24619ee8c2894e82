/* seen.c -- returns the observed events and intermediate states of ensemble members, with their errors. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "expr/walk.h"
#include "ode/companion.h"
#include "sim/ensemble/parts.h"
#include "tape/disc.h"

/* Whether an event's function g depends on a velocity that a conserved momentum replaces in the state. */
static bool
depends_on_replaced_velocity(const qdot_ensemble *e, qdot_expr g)
{
    for (size_t c = 0; c < qdot_ensemble_kept(e); c++)
        if (qdot_expr_contains(e->plan->pool, g, e->plan->inputs[e->plan->n + qdot_ensemble_equations(e)->kept[c]]))
            return true;
    return false;
}

qdot_status
qdot_ensemble_follow(qdot_ensemble *e, const qdot_ensemble_watching *watching,
                     uint64_t most_steps)
{
    size_t places;
    const double *part = qdot_companion_places(&places);

    for (size_t i = 0; i < watching->n_events; i++)
        if (depends_on_replaced_velocity(e, watching->events[i].function))
            return qdot_fail(QDOT_ENOTBUILT, "not built yet: ensembles with an event that reads a "
                                             "velocity whose momentum is kept");
    if (qdot_ensemble_kept(e) > 0 && e->plan->tape
        && qdot_disc_may_hide(e->plan->tape, QDOT_HIDES_EXPONENTIALS))
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: ensembles that keep momenta and look for "
                                         "forces which act for less than a step");
    e->watching = watching;
    e->most_steps = most_steps;
    e->n_times = (places + 1) / 2;
    e->times = qdot_calloc(e->n_times + 1, sizeof *e->times);
    if (!e->times)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < e->n_times; k++) /* only every second requested time is stored here */
        e->times[k] = e->t0 + part[2 * k] * (e->t1 - e->t0);
    return QDOT_OK;
}

void
qdot_ensemble_companions(qdot_ensemble *e, size_t companions)
{
    e->companions = companions;
}

bool
qdot_ensemble_left(const qdot_ensemble *e, size_t m)
{
    const qdot_ensemble_pass *p = e->passes;
    const qdot_batch_outcome outcome = p->run.results[m].outcome;

    return e->reasons[m] || qdot_ensemble_steps_doubtful(p->steps, m) ||
           (outcome != QDOT_BATCH_DONE && outcome != QDOT_BATCH_LEFT);
}

/* The batch's state y as q, parameters, q', 0 for the rates of parameters; `raw`: y has momenta for the
 * velocities. */
static void
write_whole_state(const qdot_ensemble *e, double t, double *y, bool raw, double *whole)
{
    const size_t n = e->n, kept = qdot_ensemble_kept(e), bytes = sizeof *y;

    memcpy(whole, y, n * bytes);
    memcpy(whole + n, y + 2 * n, e->varied * bytes);
    memcpy(whole + n + e->varied, y + n, n * bytes);
    memset(whole + 2 * n + e->varied, 0, e->varied * bytes);
    if (!raw || kept == 0)
        return;
    for (size_t c = 0; c < kept; c++)
        e->passes[0].momenta[c] = y[n + qdot_ensemble_equations(e)->kept[c]];
    qdot_ensemble_momenta_derive(e->momenta, t, e->passes[0].momenta, y);
    memcpy(whole + n + e->varied, y + n, n * bytes);
    for (size_t c = 0; c < kept; c++) /* put the conserved momenta back in the place of velocities */
        y[n + qdot_ensemble_equations(e)->kept[c]] = e->passes[0].momenta[c];
}

static bool
reached_end_time(const qdot_ensemble_pass *p, const qdot_ensemble *e, size_t m)
{
    return p->run.results[m].outcome == QDOT_BATCH_DONE && p->t1[m] != e->t0;
}

bool
qdot_ensemble_state(const qdot_ensemble *e, size_t k, size_t m, size_t place, double *whole)
{
    const qdot_ensemble_pass *p = e->passes + k;

    if (place < e->n_times) {
        if (qdot_ensemble_steps_passed(p->steps, m) <= place)
            return false;
        write_whole_state(e, e->times[place], qdot_ensemble_steps_state(p->steps, m, place), true, whole);
        return true;
    }
    if (!reached_end_time(p, e, m))
        return false;
    write_whole_state(e, e->t1, p->run.y + m * qdot_ensemble_width(e), false, whole);
    return true;
}

size_t
qdot_ensemble_points(const qdot_ensemble *e, size_t k, size_t m)
{
    const qdot_ensemble_pass *p = e->passes + k;

    return reached_end_time(p, e, m)
               ? qdot_ensemble_steps_starts(p->steps, m)->n / (1 + qdot_ensemble_width(e)) + 1
               : 0;
}

void
qdot_ensemble_point(const qdot_ensemble *e, size_t k, size_t m, size_t i, double *t, double *whole)
{
    const qdot_ensemble_pass *p = e->passes + k;
    const qdot_ensemble_starts *starts = qdot_ensemble_steps_starts(p->steps, m);
    double *at = starts->at + i * (1 + qdot_ensemble_width(e));

    if (i * (1 + qdot_ensemble_width(e)) < starts->n) {
        *t = at[0];
        write_whole_state(e, *t, at + 1, true, whole);
        return;
    }
    *t = e->t1; /* also for a companion run, whose end time differs only by rounding */
    write_whole_state(e, *t, p->run.y + m * qdot_ensemble_width(e), false, whole);
}

int
qdot_ensemble_order(const qdot_ensemble *e, size_t k)
{
    return e->passes[k].run.order;
}

double
qdot_ensemble_tolerance(const qdot_ensemble *e, size_t k)
{
    return e->passes[k].run.tol;
}

void
qdot_ensemble_limits(const qdot_ensemble *e, double *t0, double *t1, double *tol)
{
    *t0 = e->t0;
    *t1 = e->t1;
    *tol = e->tol;
}

double
qdot_ensemble_event_time(const qdot_ensemble *e, size_t k, size_t m, size_t event, size_t which)
{
    return qdot_ensemble_steps_event(e->passes[k].steps, m, event, which);
}

size_t
qdot_ensemble_event_count(const qdot_ensemble *e, size_t m, size_t event)
{
    return qdot_ensemble_steps_count(e->passes[0].steps, m, event);
}

size_t
qdot_ensemble_places(const qdot_ensemble *e)
{
    return e->n_times;
}

double
qdot_ensemble_time(const qdot_ensemble *e, size_t place)
{
    return place < e->n_times ? e->times[place] : e->t1;
}

const double *
qdot_ensemble_sizes(const qdot_ensemble *e, size_t m)
{
    return qdot_ensemble_steps_sizes(e->passes[0].steps, m);
}

const qdot_plan *
qdot_ensemble_plan(const qdot_ensemble *e)
{
    return e->plan;
}

bool
qdot_ensemble_reads(const qdot_ensemble *e, size_t k)
{
    const qdot_plan *p = e->plan;
    const qdot_expr of = p->inputs[e->n + k];
    bool reads = p->constraints || !p->M;

    for (size_t i = 0; i < p->n && !reads; i++) {
        reads = qdot_expr_contains(p->pool, p->f[i], of);
        for (size_t j = 0; j < p->n && !reads; j++)
            reads = qdot_expr_contains(p->pool, p->M[i * p->n + j], of);
    }
    return reads;
}
