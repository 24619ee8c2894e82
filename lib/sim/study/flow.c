/* flow.c -- the flow map: states after a time, with derivatives by the initial state and by parameters. */
#include "sim/study/flow.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/symbol.h"
#include "num/balance.h"

/* Below, a motion has not grown: one segment does. How much it may grow in one, of a guess that is far off, of an
 * orbit. */
static const double tame = 30, growth_of_guess = 2, growth_of_orbit = 1e3;

const double qdot_flow_tolerance[2] = {1e-13, 1e-11};

/* The relative rounding error that both flow maps share, so that their difference does not show it. */
static const double alike = 1e-14;

/* The rounding error left in sums whose terms cancel, relative to the largest derivative. */
static const double cancelled = 8 * DBL_EPSILON;

static qdot_status
flow_allocate(qdot_flow *x)
{
    const size_t width = x->z + x->p;

    x->exprs = qdot_calloc(x->m + width, sizeof *x->exprs);
    x->names = qdot_calloc(width, sizeof *x->names);
    x->in = qdot_calloc(width + QDOT_FLOW_LOOKS * x->m * (1 + width), sizeof *x->in);
    if (!x->exprs || !x->names || !x->in)
        return QDOT_ENOMEM;
    x->unknowns = x->exprs + x->m;
    x->value = x->in + width;
    x->by = x->value + QDOT_FLOW_LOOKS * x->m;
    return QDOT_OK;
}

qdot_status
qdot_flow_begin(qdot_flow *x, qdot_scene *scene, const qdot_run_request *request, size_t p,
                const qdot_expr *parameters, qdot_expr more, double tol, double length)
{
    const size_t n = scene->coordinates.n;
    qdot_response_of of;

    *x = (qdot_flow){.n = n, .z = 2 * n, .p = p, .m = 3 * n + (more != QDOT_NIL), .request = *request};
    QDOT_TRY(flow_allocate(x));
    for (size_t i = 0; i < 3 * n; i++)
        x->exprs[i] = qdot_symbol_jet(scene->pool, scene->coordinates.at[i % n], (uint32_t)(i / n));
    if (more != QDOT_NIL)
        x->exprs[3 * n] = more;
    for (size_t i = 0; i < x->z + p; i++)
        x->unknowns[i] = i < x->z ? x->exprs[i] : parameters[i - x->z];
    QDOT_TRY(qdot_pool_check(scene->pool));
    for (size_t i = 0; i < x->z + p; i++)
        x->names[i] = qdot_expr_symbol(scene->pool, x->unknowns[i])->name;
    x->request.q0 = x->unknowns;
    x->request.v0 = x->unknowns + n;
    x->request.q_named = x->request.v_named = NULL;
    x->request.tol = tol;
    x->request.t1 = qdot_add(scene->pool, request->t0, qdot_expr_of_double(scene->pool, length));
    of = (qdot_response_of){.scene = scene,
                            .request = &x->request,
                            .k = x->z + p,
                            .unknowns = x->unknowns,
                            .names = x->names,
                            .whole = true,
                            .m = x->m,
                            .exprs = x->exprs};
    return qdot_response_new(&of, &x->response);
}

void
qdot_flow_end(qdot_flow *x)
{
    qdot_response_free(x->response);
    qdot_free(x->exprs);
    qdot_free(x->names);
    qdot_free(x->in);
    *x = (qdot_flow){0};
}

static void
set_unknowns(qdot_flow *x, const double *state, const double *parameters)
{
    memcpy(x->in, state, x->z * sizeof *state);
    if (x->p > 0)
        memcpy(x->in + x->z, parameters, x->p * sizeof *parameters);
}

qdot_status
qdot_flow_go(qdot_flow *x, const double *state, const double *parameters, double from, double to, size_t count)
{
    double times[QDOT_FLOW_LOOKS] = {from, to};

    set_unknowns(x, state, parameters);
    for (size_t i = 0; i < count; i++)
        times[i] = i + 1 == count ? to : from + (to - from) * (double)(i + 1) / (double)count;
    QDOT_TRY(qdot_response_run(x->response, x->in, from, to));
    return qdot_response_read(x->response, count > 0 ? count : 2, times, x->value, x->by);
}

/* Units of the states in which the derivatives along the last motion have similar sizes; the
 * largest coordinate unit is 1. */
static qdot_status
find_component_units(const qdot_flow *x, double *unit)
{
    const size_t z = x->z, width = z + x->p;
    double *most = qdot_calloc(z * z, sizeof *most), largest = 0;

    if (most == NULL)
        return QDOT_ENOMEM;
    for (size_t at = 0; at < QDOT_FLOW_LOOKS; at++)
        for (size_t i = 0; i < z; i++)
            for (size_t j = 0; j < z; j++)
                most[i * z + j] = fmax(most[i * z + j], fabs(x->by[(at * x->m + i) * width + j]));
    qdot_balance(z, most, unit);
    for (size_t i = 0; i < x->n; i++)
        largest = fmax(largest, unit[i]);
    for (size_t i = 0; i < z; i++)
        unit[i] /= largest;
    qdot_free(most);
    return QDOT_OK;
}

/* How far each state goes over the last motion, until look `last`; where it stays, as far as the others of its kind,
 * or its unit, if it is given. size [z] */
static void
find_segment_sizes(const qdot_flow *x, const double *state, size_t last, const double *unit, double *size)
{
    double most[2] = {0, 0};

    for (size_t i = 0; i < x->z; i++) {
        size[i] = 0;
        for (size_t at = 0; at <= last; at++)
            size[i] = fmax(size[i], fabs(x->value[at * x->m + i] - state[i]));
        most[i / x->n] = fmax(most[i / x->n], size[i]);
    }
    for (size_t i = 0; i < x->z; i++)
        if (!(size[i] > 1e-3 * most[i / x->n]))
            size[i] = most[i / x->n] > 0 ? most[i / x->n] : unit != NULL ? unit[i] : 1;
}

double
qdot_flow_growth(const qdot_flow *x, size_t look, const double *size)
{
    const double *by = x->by + look * x->m * (x->z + x->p);
    double most = 0;

    for (size_t i = 0; i < x->z; i++)
        for (size_t j = 0; j < x->z; j++)
            most = fmax(most, fabs(by[i * (x->z + x->p) + j]) * size[j] / size[i]);
    return most;
}

static size_t
choose_segment_count(double growth, double each, double looks)
{
    return isfinite(growth) ? (size_t)fmin(QDOT_FLOW_MOST_SEGMENTS, ceil(log(growth) / log(each) * looks))
                            : QDOT_FLOW_MOST_SEGMENTS;
}

qdot_status
qdot_flow_segments_of_guess(qdot_flow *x, const double *state, const double *parameters, double t0, double T,
                            double *size, size_t *segments)
{
    const qdot_status status = qdot_flow_go(x, state, parameters, t0, t0 + T, QDOT_FLOW_LOOKS);
    double most = 0;
    size_t at = 0;

    *segments = QDOT_FLOW_MOST_SEGMENTS;
    for (size_t i = 0; i < x->z; i++)
        size[i] = 1;
    if (status != QDOT_OK)
        return qdot_grave(status);
    for (; at < QDOT_FLOW_LOOKS && most < tame; at++) {
        find_segment_sizes(x, state, at, NULL, size);
        most = qdot_flow_growth(x, at, size);
    }
    *segments = most < tame ? 1 : choose_segment_count(most, growth_of_guess, QDOT_FLOW_LOOKS / (double)at);
    return QDOT_OK;
}

qdot_status
qdot_flow_segments_of_orbit(qdot_flow *x, const double *state, const double *parameters, double t0, double T,
                            double *sizes, size_t *segments)
{
    qdot_status status = qdot_flow_go(x, state, parameters, t0, t0 + T, QDOT_FLOW_LOOKS);
    double *unit = qdot_malloc(2 * x->z * sizeof *unit), *size = unit + x->z, most = 0;

    *segments = QDOT_FLOW_MOST_SEGMENTS;
    if (unit == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < x->z; i++)
        size[i] = 1;
    if (status == QDOT_OK)
        status = find_component_units(x, unit);
    if (status == QDOT_OK) {
        find_segment_sizes(x, state, QDOT_FLOW_LOOKS - 1, unit, size);
        for (size_t at = 0; at < QDOT_FLOW_LOOKS; at++)
            most = fmax(most, qdot_flow_growth(x, at, size));
        *segments = most < tame ? 1 : choose_segment_count(most, growth_of_orbit, 1);
    }
    if (sizes != NULL)
        memcpy(sizes, size, x->z * sizeof *sizes);
    qdot_free(unit);
    return qdot_grave(status);
}

/* --- flows along periodic orbits ------------------------------------------------------------- */

double
qdot_flow_time(const qdot_flow_orbit *o, size_t k)
{
    return k == o->K ? o->t0 + o->T : o->t0 + o->T * (double)k / (double)o->K;
}

double
qdot_flow_by_period(const qdot_flow *x, const double *values, const double *slopes, size_t k, size_t K, size_t i)
{
    const size_t width = x->z + x->p;
    const double *const end = values + x->m, *const by = slopes + (x->m + i) * width;
    double rate = (double)(k + 1) / (double)K * end[x->n + i];

    for (size_t j = 0; j < x->z; j++)
        rate -= (double)k / (double)K * by[j] * values[x->n + j];
    return rate;
}

const double *
qdot_flow_state(const qdot_flow *x, const qdot_flow_orbit *o, size_t k)
{
    return k % o->K == 0 ? o->first : o->others + (k % o->K - 1) * x->z;
}

qdot_status
qdot_flow_read(qdot_flow *x, const qdot_flow_orbit *o, size_t *at, size_t count, const double *times,
               double *values)
{
    for (size_t i = 0, end; i < count; i = end) {
        size_t k = 0;

        while (k + 1 < o->K && times[i] > qdot_flow_time(o, k + 1))
            k++;
        for (end = i + 1; end < count && (k + 1 == o->K || times[end] <= qdot_flow_time(o, k + 1));)
            end++;
        if (*at != k)
            QDOT_TRY(qdot_flow_go(x, qdot_flow_state(x, o, k), o->parameters, qdot_flow_time(o, k),
                                  qdot_flow_time(o, k + 1), 1));
        *at = k;
        QDOT_TRY(qdot_response_read(x->response, end - i, times + i, values + i * x->m, NULL));
    }
    return QDOT_OK;
}

/* Compute to^T S from, the derivatives S in the bases `from` and `to`; out [c x c], S [z x (z + p)], bases [c x z]. */
static void
transform_to_basis(const qdot_flow *x, size_t c, const double *from, const double *to, const double *S, double *out)
{
    memset(out, 0, c * c * sizeof *out);
    for (size_t a = 0; a < c; a++)
        for (size_t b = 0; b < c; b++)
            for (size_t i = 0; i < x->z; i++)
                for (size_t j = 0; j < x->z; j++)
                    out[a * c + b] += to[a * x->z + i] * S[i * (x->z + x->p) + j] * from[b * x->z + j];
}

/* Find the directions allowed by the constraints at the starts of the segments: N [K x z x z], c of each. */
static qdot_status
find_allowed_directions(qdot_flow *x, const qdot_flow_orbit *o, size_t *c, double *N)
{
    for (size_t k = 0; k < o->K; k++) {
        set_unknowns(x, qdot_flow_state(x, o, k), o->parameters);
        QDOT_TRY(qdot_response_tangents(x->response, x->in, qdot_flow_time(o, k), c, N + k * x->z * x->z));
    }
    return QDOT_OK;
}

qdot_status
qdot_flow_factors(qdot_flow *x, const qdot_flow_orbit *o, const double *ends, size_t step, size_t *c, double *B)
{
    const size_t zz = x->z * x->z;
    double *N = qdot_calloc(o->K * zz, sizeof *N);
    const qdot_status status = N ? find_allowed_directions(x, o, c, N) : QDOT_ENOMEM;

    for (size_t k = 0; k < o->K && status == QDOT_OK; k++)
        transform_to_basis(x, *c, N + k * zz, N + (k + 1) % o->K * zz, ends + k * step, B + k * *c * *c);
    qdot_free(N);
    return status;
}

void
qdot_flow_errors(size_t count, const double *B, double *coarse)
{
    for (size_t i = 0; i < count; i++)
        coarse[i] = fabs(coarse[i] - B[i]) + alike * fabs(B[i]);
}

/* Estimate rounding errors R [z x (z + p)]: a few epsilons of S's largest entry, in units size [z]. */
static void
estimate_rounding(const qdot_flow *x, const double *S, const double *size, double *R)
{
    const size_t width = x->z + x->p;
    double most = 0;

    for (size_t i = 0; i < x->z; i++)
        for (size_t j = 0; j < x->z; j++)
            most = fmax(most, fabs(S[i * width + j]) * size[j] / size[i]);
    for (size_t i = 0; i < x->z; i++)
        for (size_t j = 0; j < x->z; j++)
            R[i * width + j] = cancelled * most * size[i] / size[j];
}

qdot_status
qdot_flow_rounding(qdot_flow *x, const qdot_flow_orbit *o, const double *ends, size_t step, const double *size,
                   double *E)
{
    const size_t zz = x->z * x->z, width = x->z + x->p;
    double *N = qdot_calloc((o->K + 1) * zz + x->z * width, sizeof *N), *by = N + o->K * zz, *R = by + zz;
    size_t c = 0;
    const qdot_status status = N ? find_allowed_directions(x, o, &c, N) : QDOT_ENOMEM;

    for (size_t i = 0; i < o->K * zz && status == QDOT_OK; i++)
        N[i] = fabs(N[i]);
    for (size_t k = 0; k < o->K && status == QDOT_OK; k++) {
        estimate_rounding(x, ends + k * step, size, R);
        transform_to_basis(x, c, N + k * zz, N + (k + 1) % o->K * zz, R, by);
        for (size_t i = 0; i < c * c; i++)
            E[k * c * c + i] += by[i];
    }
    qdot_free(N);
    return status;
}
