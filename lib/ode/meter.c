/* meter.c -- records the computing work of a run along its time, to compare it with that of another run. */
#include "ode/meter.h"

#include <float.h>
#include <math.h>

/* A mark (time, work) is stored whenever the work has grown by this fraction, and at least by `least` (ns). */
static const double part = 0.125, least = 5e4;

static const double stands_still = 0.02;

/* Beside f: its Jacobian by exact derivatives, a column; a factorisation, over n^3; and what a
 * stepper does for each evaluation, and each component of it. */
static const double of_column = 0.5, of_cube = 0.5, of_call = 50, of_component = 4;

void
qdot_ode_meter_begin(qdot_ode_meter *m, double t0, double t1)
{
    m->direction = t1 < t0 ? -1 : 1;
    m->t0 = t0;
    m->work = 0;
    m->far = t0;
    m->next = least;
    m->judged = 0;
    m->over = false;
    atomic_store(&m->count, 0);
    atomic_store(&m->ended, false);
}

static void
set_mark(qdot_ode_meter *m)
{
    const size_t k = atomic_load_explicit(&m->count, memory_order_relaxed);

    m->next = m->work + fmax(least, part * m->work);
    if (k == QDOT_ODE_MARKS)
        return;
    m->marks[k] = (qdot_ode_mark){m->far, m->work};
    atomic_store_explicit(&m->count, k + 1, memory_order_release);
}

/* Find the work that the run `run` had done at time t; false if that is not known yet. */
static bool
find_work_at(const qdot_ode_meter *run, double t, double *work)
{
    /* read `ended` first: a run that has ended sets no more marks */
    const bool ended = atomic_load_explicit(&run->ended, memory_order_acquire);
    const size_t count = atomic_load_explicit(&run->count, memory_order_acquire);

    for (size_t k = 0; k < count; k++)
        if (run->direction * (run->marks[k].t - t) >= 0) {
            *work = run->marks[k].work;
            return true;
        }
    if (ended)
        *work = run->work;
    return ended;
}

/* Whether t lies beyond the end of the run with which this one is compared, if that has ended. */
static bool
is_beyond_end_of_other(const qdot_ode_meter *m, double t)
{
    return m->direction * (t - m->beside->far) > 4 * DBL_EPSILON * fabs(m->beside->far);
}

/* Whether so much is too much at t, where that is known. What is done beyond the end of the run
 * depends on when that is heard of, and is not judged. */
static bool
exceeds_limit(const qdot_ode_meter *m, double t, double work, bool *known)
{
    double w;

    *known = find_work_at(m->beside, m->direction * INFINITY, &w);
    if (*known && is_beyond_end_of_other(m, t))
        return false;
    if (*known && m->spent + work > m->factor * w + m->allowance)
        return true;
    if (m->whole_only)
        return false;
    *known = find_work_at(m->beside, t, &w);
    return *known && work > m->early_factor * w + m->early;
}

qdot_status
qdot_ode_meter_add(qdot_ode_meter *m, double t, double work)
{
    m->work += work;
    if (m->direction * (t - m->far) > 0)
        m->far = t;
    if (m->most > 0 && m->work > m->most)
        return qdot_fail(QDOT_ELIMIT, "the run takes more work than it may");
    if (m->work < m->next)
        return QDOT_OK;
    set_mark(m);
    if (!m->beside)
        return QDOT_OK;
    for (bool known; m->judged < atomic_load(&m->count); m->judged++) {
        const qdot_ode_mark *mark = m->marks + m->judged;

        m->over = m->over || exceeds_limit(m, mark->t, mark->work, &known);
        if (m->over)
            return qdot_fail(QDOT_ELIMIT, QDOT_ODE_METER_REASON, m->factor);
        if (!known)
            return QDOT_OK;
    }
    return QDOT_OK;
}

void
qdot_ode_meter_end(qdot_ode_meter *m)
{
    atomic_store_explicit(&m->ended, true, memory_order_release);
}

bool
qdot_ode_meter_exceeds(const qdot_ode_meter *m, double *work)
{
    const size_t count = atomic_load(&m->count);
    bool known;

    for (size_t k = 0; k < count && m->beside; k++)
        if (exceeds_limit(m, m->marks[k].t, m->marks[k].work, &known)) {
            *work = m->marks[k].work;
            return true;
        }
    *work = m->work;
    return m->beside && exceeds_limit(m, m->far, m->work, &known);
}

bool
qdot_ode_meter_is_stuck(const qdot_ode_meter *m)
{
    double half = m->t0;

    for (size_t k = 0; k < atomic_load(&m->count) && m->marks[k].work <= 0.5 * m->work; k++)
        half = m->marks[k].t;
    return fabs(m->far - half) < stands_still * fabs(half - m->t0);
}

double
qdot_ode_expansion_work(const qdot_ode_series *series, int p)
{
    const double *c = series->cost.kernels;

    return c[0] + c[1] * p + c[2] * p * p;
}

double
qdot_ode_work(const qdot_ode_system *system, const qdot_ode_stats *stats)
{
    const double n = (double)system->n;
    const double f = (system->series ? qdot_ode_expansion_work(system->series, 1) : n * n)
                     + of_call + of_component * n;

    return f * ((double)stats->evaluations + of_column * n * (double)stats->jacobians)
           + of_cube * n * n * n * (double)stats->factorisations;
}
