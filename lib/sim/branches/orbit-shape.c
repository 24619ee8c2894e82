/* orbit-shape.c -- samples an orbit at a few hundred times, and finds where a velocity is 0 between
 * two of them. */
#include "sim/branches/orbit-shape.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

enum { PLACES = 257, HALVINGS = 60 };

typedef struct {
    qdot_orbit_read *r;
    size_t n, m; /* number of coordinates; number of expressions sampled */
    double *values; /* [PLACES x m] values at equally spaced times over a period */
    double *one;    /* [m] values at one time */
} shape;

static double
time_of_sample(const shape *s, size_t k)
{
    return s->r->orbit->t0 + s->r->orbit->T * (double)k / (PLACES - 1);
}

static qdot_status
sample_orbit(shape *s, qdot_orbit_read *r)
{
    double times[PLACES];

    *s = (shape){.r = r, .n = r->flow->n, .m = r->flow->m};
    s->values = qdot_malloc((PLACES + 1) * s->m * sizeof *s->values);
    if (s->values == NULL)
        return QDOT_ENOMEM;
    s->one = s->values + PLACES * s->m;
    for (size_t k = 0; k < PLACES; k++)
        times[k] = time_of_sample(s, k);
    return qdot_flow_read(r->flow, r->orbit, &r->at, PLACES, times, s->values);
}

/* Evaluate the sampled expressions at one time of the orbit, into s->one. */
static qdot_status
evaluate_at_time(shape *s, double time)
{
    return qdot_flow_read(s->r->flow, s->r->orbit, &s->r->at, 1, &time, s->one);
}

static double
sampled_value(const shape *s, size_t k, size_t i)
{
    return s->values[k * s->m + i];
}

/* The sample at which q_i is largest; *least is its smallest value. */
static size_t
sample_of_maximum(const shape *s, size_t i, double *least)
{
    size_t best = 0;

    *least = sampled_value(s, 0, i);
    for (size_t k = 1; k < PLACES; k++) {
        *least = fmin(*least, sampled_value(s, k, i));
        if (sampled_value(s, k, i) > sampled_value(s, best, i))
            best = k;
    }
    return best;
}

/* Find the state at which q_i is largest, near sample k of the closed orbit, into s->one. */
static qdot_status
find_turning_point(shape *s, size_t i, size_t k)
{
    const size_t v = s->n + i;
    double from, to, middle = time_of_sample(s, k);

    if (k == PLACES - 1)
        k = 0;
    if (!(sampled_value(s, k, v) < 0)) {
        from = time_of_sample(s, k);
        to = time_of_sample(s, k + 1);
    } else {
        from = time_of_sample(s, k > 0 ? k - 1 : PLACES - 2);
        to = time_of_sample(s, k > 0 ? k : PLACES - 1);
    }
    for (int step = 0; step < HALVINGS && from < to; step++) {
        middle = from + (to - from) / 2;
        QDOT_TRY(evaluate_at_time(s, middle));
        if (s->one[v] > 0)
            from = middle;
        else if (s->one[v] < 0)
            to = middle;
        else
            break;
        if (middle == from + (to - from) / 2)
            break;
    }
    return evaluate_at_time(s, middle);
}

qdot_status
qdot_orbit_shape(qdot_orbit_read *r, double *most, double *size)
{
    const size_t n = r->flow->n;
    shape s;
    qdot_status status = sample_orbit(&s, r);

    *size = 0;
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        double least;
        const size_t k = sample_of_maximum(&s, i, &least);

        status = find_turning_point(&s, i, k);
        most[i] = fmax(sampled_value(&s, k, i), s.one[i]);
        *size = fmax(*size, (most[i] - least) / 2);
    }
    qdot_free(s.values);
    return status;
}

qdot_status
qdot_orbit_changes(qdot_orbit_read *r, double *change)
{
    shape s;
    const qdot_status status = sample_orbit(&s, r);

    for (size_t i = 0; i < 2 * s.n && status == QDOT_OK; i++) {
        double least;
        const size_t k = sample_of_maximum(&s, i, &least);

        change[i] = (sampled_value(&s, k, i) - least) / 2;
    }
    qdot_free(s.values);
    return status;
}

qdot_status
qdot_orbit_turn(qdot_orbit_read *r, size_t *phase, double *z)
{
    const size_t n = r->flow->n;
    shape s;
    double most = 0;
    size_t best = 0, where = 0;
    qdot_status status = sample_orbit(&s, r);

    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        double least;
        const size_t k = sample_of_maximum(&s, i, &least);

        if (sampled_value(&s, k, i) - least > most) {
            most = sampled_value(&s, k, i) - least;
            best = i;
            where = k;
        }
    }
    if (status == QDOT_OK)
        status = find_turning_point(&s, best, where);
    if (status == QDOT_OK) {
        memcpy(z, s.one, 2 * n * sizeof *z);
        *phase = n + best;
        z[*phase] = 0;
    }
    qdot_free(s.values);
    return status;
}
