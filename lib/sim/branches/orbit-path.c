/* orbit-path.c -- F and F' of periodic orbits from integration with sensitivities; stability and
 * multipliers. */
#include "sim/branches/orbit-path.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/constant.h"
#include "normal/prove/decide.h"
#include "sim/branches/orbit-period.h"
#include "sim/branches/orbit-shape.h"
#include "sim/model/substitute.h"
#include "sim/study/floquet.h"
#include "tape/derivative.h"

/* As fractions: a velocity that changes less over an orbit is 0; an orbit smaller than this against
 * the first is a rest. */
static const double nothing = 1e-9, at_rest = 1e-4;

/* A coordinate is constant if its change over an orbit, relative to its size, is smaller than this. */
static const double still = 1e-12;

/* A multiplier grows if |mu| - 1 exceeds this, and three times its error. */
static const double grows = 1e-6;

/* A multiplier whose error exceeds this, relative to max(1, |mu|), is unknown. */
static const double blurred = 0.03;

/* Newton's corrections end below `exact`, which the errors of runs bound; the shortest and longest step along a
 * curve. */
static const double exact = 1e-12, shortest = 1e-6, longest = 2e-2;

size_t
qdot_orbit_path_most(size_t n)
{
    return 2 * n * QDOT_FLOW_MOST_SEGMENTS + 3 + 3 * n;
}

/* --- one evaluation of F -------------------------------------------------------------------- */

/* The number of variables by which the flow is differentiated: 2n, and p if it is a parameter of the scene. */
static size_t
variable_count(const qdot_orbit_path *x)
{
    return x->flow[0].z + x->flow[0].p;
}

/* The index in y of the state at the start of segment k; 0 (the first state) also after the last segment. */
static size_t
segment_start_index(const qdot_orbit_path *x, size_t k)
{
    return k % x->K == 0 ? 0 : 2 * x->n + 1 + x->conserved + (k % x->K - 1) * 2 * x->n;
}

static qdot_flow_orbit
orbit_at_point(const qdot_orbit_path *x, const double *y)
{
    return (qdot_flow_orbit){.K = x->K,
                             .t0 = x->t0,
                             .T = y[2 * x->n],
                             .first = y,
                             .others = y + 2 * x->n + 1 + x->conserved,
                             .parameters = y + x->path.n};
}

/* Expressions: q, q', q'', then h: at the start of segment k (end 0) and its end (1); their slopes by unknown j of
 * the flow. */
static double
segment_value(const qdot_orbit_path *x, size_t k, size_t end, size_t i)
{
    return x->values[(2 * k + end) * x->flow[0].m + i];
}

static double
segment_derivative(const qdot_orbit_path *x, size_t k, size_t end, size_t i, size_t j)
{
    return x->slopes[((2 * k + end) * x->flow[0].m + i) * variable_count(x) + j];
}

/* Integrate the segments of the orbit y, and store their values and derivatives. */
static qdot_status
integrate_segments(qdot_orbit_path *x, const double *y)
{
    const qdot_flow_orbit o = orbit_at_point(x, y);
    qdot_flow *const f = &x->flow[x->by];
    const size_t two = 2 * f->m, width = variable_count(x);

    if (!(o.T > 0) || !isfinite(o.T))
        return qdot_fail(QDOT_EDOMAIN, "the period is not positive");
    for (size_t k = 0; k < x->K; k++) {
        QDOT_TRY(qdot_flow_go(f, qdot_flow_state(f, &o, k), o.parameters, qdot_flow_time(&o, k),
                              qdot_flow_time(&o, k + 1), 0));
        memcpy(x->values + k * two, f->value, two * sizeof *x->values);
        memcpy(x->slopes + k * two * width, f->by, two * width * sizeof *x->slopes);
    }
    return QDOT_OK;
}

/* Write the difference between the end of segment k and the start of the next, and its derivatives,
 * into F and J. */
static void
fill_segment_gap(qdot_orbit_path *x, const double *y, size_t k, double *F, double *J)
{
    const size_t z = 2 * x->n, m = x->path.n + 1, from = segment_start_index(x, k), to = segment_start_index(x, k + 1);
    const qdot_flow *const f = &x->flow[0];
    const double *const values = x->values + 2 * k * f->m, *const slopes = x->slopes + 2 * k * f->m * variable_count(x);

    for (size_t i = 0; i < z; i++) {
        F[i] = segment_value(x, k, 1, i) - y[to + i];
        for (size_t j = 0; j < z; j++)
            J[i * m + from + j] = segment_derivative(x, k, 1, i, j);
        if (variable_count(x) > z)
            J[i * m + x->path.n] = segment_derivative(x, k, 1, i, z);
        J[i * m + to + i] -= 1;
        J[i * m + z] = qdot_flow_by_period(f, values, slopes, k, x->K, i);
    }
}

/* Fill F (gaps between segments, phase condition) and its Jacobian from the latest evaluation. */
static void
fill_equations(qdot_orbit_path *x, const double *y)
{
    qdot_path *path = &x->path;
    const size_t z = 2 * x->n, m = path->n + 1, energy = 3 * x->n, last = (x->K - 1) * z;
    double *F = path->F, *J = path->J;

    memset(J, 0, path->n * m * sizeof *J);
    for (size_t k = 0; k < x->K; k++)
        fill_segment_gap(x, y, k, F + k * z, J + k * z * m);
    for (size_t i = 0; i < z && x->conserved; i++) {
        J[(last + i) * m + z + 1] = segment_derivative(x, 0, 0, energy, i);
        F[last + i] += y[z + 1] * segment_derivative(x, 0, 0, energy, i);
    }
    F += last;
    J += last * m;
    J += z * m;
    if (x->driven) {
        double in[1] = {y[path->n]}, period = 0, slope = 0;

        qdot_derivative_eval(x->period, in, 0, 1, &period, &slope, x->period_work);
        F[z] = y[z] - period;
        J[z] = 1;
        J[path->n] = -slope;
    } else {
        F[z] = y[x->phase] - x->held;
        J[x->phase] = 1;
        path->gauge = segment_value(x, 0, 0, x->n + x->phase) / x->rate;
    }
    if (!x->conserved)
        return;
    J += m;
    if (x->of.family == QDOT_ORBIT_START) {
        for (size_t i = 0; i < z; i++)
            J[i] = x->flow[0].unknowns[i] == x->of.parameter;
        J[path->n] = -1;
        F[z + 1] = -y[path->n];
        for (size_t i = 0; i < z; i++)
            F[z + 1] += J[i] * y[i];
        return;
    }
    F[z + 1] = segment_value(x, 0, 0, energy) -
               (x->of.family == QDOT_ORBIT_ENERGY ? y[path->n] : x->energy);
    for (size_t j = 0; j < variable_count(x); j++)
        J[j < z ? j : path->n] = segment_derivative(x, 0, 0, energy, j);
    if (x->of.family == QDOT_ORBIT_ENERGY)
        J[path->n] = -1;
}

/* Evaluate F and F' at y, or reuse the last evaluation if y is the same. An orbit whose phase
 * condition has changed sign is rejected. */
static void
evaluate_orbit_equations(qdot_path *path, const double *y)
{
    qdot_orbit_path *x = (qdot_orbit_path *)path;
    qdot_status status;

    if (x->known && memcmp(x->y, y, (path->n + 1) * sizeof *y) == 0)
        return;
    x->known = false;
    path->F[0] = NAN;
    for (size_t i = 0; i <= path->n; i++)
        if (!isfinite(y[i]))
            return;
    status = path->failure == QDOT_OK ? integrate_segments(x, y) : path->failure;
    if (status != QDOT_OK) {
        path->failure = qdot_grave(status);
        snprintf(path->reason, sizeof path->reason, "%.150s", qdot_last_error()->message);
        return;
    }
    fill_equations(x, y);
    if (!(path->gauge > 0))
        path->F[0] = NAN;
    memcpy(x->y, y, (path->n + 1) * sizeof *y);
    x->known = true;
}

/* Fill B, the factors of the monodromy matrix, from the latest evaluation. */
static qdot_status
fill_transfer_matrices(qdot_orbit_path *x, const double *y)
{
    const qdot_flow_orbit o = orbit_at_point(x, y);
    qdot_flow *const f = &x->flow[x->by];
    const size_t step = f->m * variable_count(x);

    return qdot_flow_factors(f, &o, x->slopes + step, 2 * step, &x->c, x->B);
}

bool
qdot_orbit_path_monodromy(qdot_orbit_path *x, const double *y)
{
    evaluate_orbit_equations(&x->path, y);
    if (!x->known)
        return false;
    x->path.failure = qdot_grave(fill_transfer_matrices(x, y));
    return x->path.failure == QDOT_OK;
}

void
qdot_orbit_path_ask(qdot_orbit_path *x, size_t by)
{
    x->known = x->known && x->by == by;
    x->by = by;
}

/* --- judging an orbit ------------------------------------------------------------------------- */

/* Fill B, the transfer matrices of the run in use (fine or coarse), and E, their difference from the other run's. */
static bool
fill_matrices_and_errors(qdot_orbit_path *x, const double *y)
{
    const size_t by = x->by, count = x->K * x->c * x->c, step = x->flow[by].m * variable_count(x);
    const qdot_flow_orbit o = orbit_at_point(x, y);
    qdot_status status;
    bool good;

    qdot_orbit_path_ask(x, !by);
    good = qdot_orbit_path_monodromy(x, y);
    memcpy(x->E, x->B, count * sizeof *x->E);
    qdot_orbit_path_ask(x, by);
    if (!good || !qdot_orbit_path_monodromy(x, y))
        return false;
    qdot_flow_errors(count, x->B, x->E);
    status = qdot_flow_rounding(&x->flow[by], &o, x->slopes + step, 2 * step, x->sizes, x->E);
    x->path.failure = qdot_grave(status);
    return status == QDOT_OK;
}

/* The number of multipliers that are 1 for every orbit: one for a time shift, one more for conserved energy. */
static size_t
trivial_multiplier_count(const qdot_orbit_path *x)
{
    return x->driven ? 0 : x->conserved ? 2 : 1;
}

static void
judge_by_multipliers(const qdot_orbit_path *x, const qdot_floquet *f, qdot_path_point *a)
{
    double product = 1;

    a->growing = 0;
    a->phase = a->growth = 0;
    a->blurred = f->trivial < trivial_multiplier_count(x); /* fewer trivial multipliers than expected: one has a large error */
    for (size_t k = 0; k < f->n; k++) {
        const double size = hypot(f->re[k], f->im[k]);

        a->blurred = a->blurred || !(f->error[k] <= blurred * fmax(1, size));
        a->growing += f->error[k] != 0 && size > 1 + fmax(grows, 3 * f->error[k]);
        if (f->error[k] != 0 && (f->im[k] > 0 || (f->im[k] == 0 && f->re[k] < -1)))
            a->phase += atan2(f->im[k], f->re[k]);
        if (f->error[k] != 0 && size > 1)
            a->growth += log(size);
        product *= f->im[k] == 0 ? f->re[k] + 1 : hypot(f->re[k] + 1, f->im[k]);
        a->y[x->path.n + 1 + x->n + k] = size;
    }
    a->flip = product > 0 ? 1 : -1;
    a->stability = f->verdict == QDOT_FLOQUET_UNSTABLE    ? QDOT_UNSTABLE
                   : f->verdict == QDOT_FLOQUET_UNDECIDED ? QDOT_STABILITY_UNDECIDED
                   : f->asymptotic && f->trivial < f->n   ? QDOT_STABLE
                                                          : QDOT_STABLE_TO_FIRST_ORDER;
}

/* A reader of states along the orbit that was evaluated last. */
static qdot_orbit_read
orbit_reader(qdot_orbit_path *x, const qdot_flow_orbit *o)
{
    return (qdot_orbit_read){.flow = &x->flow[x->by], .orbit = o, .at = x->K - 1};
}

static qdot_status
find_orbit_extent(qdot_orbit_path *x, const double *y, double *most, double *size)
{
    const qdot_flow_orbit o = orbit_at_point(x, y);
    qdot_orbit_read r = orbit_reader(x, &o);

    return qdot_orbit_shape(&r, most, size);
}

/* Judge an orbit: its stability, the largest values of coordinates, its multipliers. */
static qdot_status
judge_orbit(qdot_path *path, qdot_path_point *a)
{
    qdot_orbit_path *x = (qdot_orbit_path *)path;
    qdot_floquet f = {0};
    double size = 0;
    qdot_status status;

    a->stability = QDOT_STABILITY_UNDECIDED;
    a->growing = -1;
    a->flip = 0;
    for (size_t i = path->n + 1; i < path->width; i++)
        a->y[i] = NAN;
    a->blurred = true;
    if (!fill_matrices_and_errors(x, a->y))
        return path->failure;
    status = qdot_floquet_of(x->K, x->c, x->B, x->E, trivial_multiplier_count(x), x->asymptotic, &f);
    if (status == QDOT_OK)
        judge_by_multipliers(x, &f, a);
    else
        status = qdot_grave(status);
    if (status == QDOT_OK)
        status = find_orbit_extent(x, a->y, a->y + path->n + 1, &size);
    a->rests = !x->driven && size < at_rest * x->size;
    qdot_floquet_clear(&f);
    return status;
}

/* --- making the path ------------------------------------------------------------------------ */

static qdot_status
orbit_allocate(qdot_orbit_path *x)
{
    const size_t two = x->K * 2 * x->flow[0].m, factors = x->K * 4 * x->n * x->n;

    x->values = qdot_calloc(two * (1 + variable_count(x)) + 2 * factors + x->path.n + 1 + 2 * x->n, sizeof *x->values);
    if (!x->values)
        return QDOT_ENOMEM;
    x->slopes = x->values + two;
    x->B = x->slopes + two * variable_count(x);
    x->E = x->B + factors;
    x->y = x->E + factors;
    x->sizes = x->y + x->path.n + 1;
    return QDOT_OK;
}

/* Make the flow maps with fine and coarse tolerance; find the number of segments that the first orbit needs. */
static qdot_status
make_flow_maps(qdot_orbit_path *x)
{
    const qdot_orbit_of *of = &x->of;
    const qdot_expr h = x->conserved ? qdot_mech_energy(of->scene) : QDOT_NIL;
    const size_t p = of->family == QDOT_ORBIT_PARAMETER;

    for (size_t k = 0; k < 2; k++)
        QDOT_TRY(qdot_flow_begin(&x->flow[k], of->scene, of->request, p, &of->parameter, h, qdot_flow_tolerance[k],
                                 of->T));
    x->K = of->segments;
    if (x->K > 0)
        return QDOT_OK;
    return qdot_flow_segments_of_orbit(&x->flow[0], of->z, &of->p, x->t0, of->T, NULL, &x->K);
}

/* Compute the states between segments one after the other, by integrating from the start of the orbit. */
static qdot_status
compute_segment_states(qdot_orbit_path *x, double *y)
{
    const qdot_flow_orbit o = orbit_at_point(x, y);
    qdot_flow *const f = &x->flow[0];

    for (size_t k = 0; k + 1 < x->K; k++) {
        QDOT_TRY(qdot_flow_go(f, qdot_flow_state(f, &o, k), o.parameters, qdot_flow_time(&o, k),
                              qdot_flow_time(&o, k + 1), 1));
        memcpy(y + segment_start_index(x, k + 1), f->value, f->z * sizeof *y);
    }
    return QDOT_OK;
}

/* Choose the phase condition and the first state y: at the start, or at a turning point of a coordinate. */
static qdot_status
choose_phase(qdot_orbit_path *x, const double *change, double *y)
{
    const size_t z = 2 * x->n;
    double best = 0;

    x->phase = z;
    for (size_t i = 0; i < x->n; i++) { /* hold a velocity fixed at 0, at a turning point of its coordinate */
        const double rate = fabs(segment_value(x, 0, 0, z + i)) / change[x->n + i];

        if (x->flow[0].unknowns[x->n + i] != x->of.parameter && change[i] > 0 && rate > best &&
            fabs(y[x->n + i]) <= nothing * change[x->n + i]) {
            best = rate;
            x->phase = x->n + i;
        }
    }
    if (x->phase < z) {
        y[x->phase] = x->held = 0;
        x->rate = segment_value(x, 0, 0, x->n + x->phase);
        return QDOT_OK;
    }
    if (x->of.family != QDOT_ORBIT_START) {
        const qdot_flow_orbit o = orbit_at_point(x, y);
        qdot_orbit_read r = orbit_reader(x, &o);

        x->held = 0;
        return qdot_orbit_turn(&r, &x->phase, y);
    }
    for (size_t i = 0; i < x->n; i++) {
        const double rate = fabs(y[x->n + i]) / change[i];

        if (x->flow[0].unknowns[i] != x->of.parameter && rate > best) {
            best = rate;
            x->phase = i;
            x->held = y[i];
            x->rate = y[x->n + i];
        }
    }
    return x->phase < z ? QDOT_OK
                        : qdot_fail(QDOT_EINVAL, "no other initial value can be kept fixed: begin "
                                                 "where a velocity is 0");
}

/* The sizes of the unknowns: the change of each of z over the orbit; for those that are constant, that of the
 * others of their kind. */
static qdot_status
orbit_find_sizes(qdot_orbit_path *x, const double *y, double *size)
{
    const size_t n = x->n;
    const qdot_flow_orbit o = orbit_at_point(x, y);
    qdot_orbit_read r = orbit_reader(x, &o);
    double most[2] = {0, 0}, far = 0;

    QDOT_TRY(qdot_orbit_changes(&r, size));
    for (size_t i = 0; i < 2 * n; i++)
        most[i / n] = fmax(most[i / n], size[i]);
    for (size_t i = 0; i < n; i++)
        far = fmax(far, fabs(x->of.z[i]));
    if (most[0] <= still * far)
        most[0] = most[1] = 0; /* the orbit is at rest at coordinates other than 0 */
    x->size = most[0];
    if (!x->driven && !(most[0] > 0 && most[1] > 0)) {
        (void)qdot_fail(QDOT_EINVAL, "the run is at rest");
        return qdot_hint("continue equilibria in Omega = 0..10");
    }
    for (size_t i = 0; i < 2 * n; i++)
        if (!(size[i] > nothing * most[i / n]))
            size[i] = most[i / n] > 0 ? most[i / n] : 1;
    size[2 * n] = x->of.T;
    if (x->conserved)
        size[2 * n + 1] = 1;
    for (size_t k = 1; k < x->K; k++)
        memcpy(size + segment_start_index(x, k), size, 2 * n * sizeof *size);
    return QDOT_OK;
}

/* Make the first point of the branch: y with the states between segments, and the typical size of
 * each component. */
static qdot_status
make_first_point(qdot_orbit_path *x, double *size, double *y)
{
    const size_t z = 2 * x->n, n = x->path.n;

    memcpy(y, x->of.z, z * sizeof *y);
    y[z] = x->of.T;
    if (x->conserved)
        y[z + 1] = 0;
    y[n] = x->of.p;
    QDOT_TRY(compute_segment_states(x, y));
    QDOT_TRY(integrate_segments(x, y));
    QDOT_TRY(fill_transfer_matrices(x, y)); /* also determines the number of multipliers */
    QDOT_TRY(orbit_find_sizes(x, y, size));
    if (!x->driven)
        QDOT_TRY(choose_phase(x, size, y));
    if (x->phase < z && !(fabs(x->rate) > 0)) { /* the rate is not set: the start point has been moved */
        QDOT_TRY(compute_segment_states(x, y));
        QDOT_TRY(integrate_segments(x, y));
        x->rate = segment_value(x, 0, 0, x->n + x->phase);
    }
    x->energy = x->conserved ? segment_value(x, 0, 0, 3 * x->n) : 0;
    if (x->of.family == QDOT_ORBIT_ENERGY)
        y[n] = x->energy;
    return QDOT_OK;
}

static qdot_status
make_period_function(qdot_orbit_path *x)
{
    const qdot_orbit_of *of = &x->of;
    qdot_expr p = of->family == QDOT_ORBIT_PARAMETER ? of->parameter : QDOT_NIL, period;

    QDOT_TRY(qdot_orbit_period(of->scene, of->request, p, of->p, of->T, of->least, of->most, &period));
    QDOT_TRY(qdot_tape_new(of->scene->pool, 1, &of->parameter, 1, &period, &x->period));
    x->period_work = qdot_malloc((qdot_derivative_work(x->period) + 1) * sizeof(double));
    return x->period_work ? QDOT_OK : QDOT_ENOMEM;
}

/* Whether it is proved that the scene's events leave the energy h unchanged. */
static qdot_status
events_keep_energy(const qdot_orbit_path *x, bool *keep)
{
    qdot_scene *s = x->of.scene;
    const qdot_run_request *r = x->of.request;
    const qdot_facts facts = qdot_scene_facts(s);
    const qdot_expr h = qdot_mech_energy(s);

    for (size_t k = 0; k < s->events.n && *keep; k++) {
        const qdot_event *e = &s->events.at[k];
        qdot_expr change;

        if (e->targets.n == 0)
            continue;
        change = qdot_sub(s->pool, qdot_subs(s->pool, h, e->targets.n, e->targets.at, e->values.at), h);
        change = qdot_substitute(s->pool, change, r->n_values, r->symbols, r->values);
        QDOT_TRY(qdot_pool_check(s->pool));
        *keep = qdot_is_zero(s->pool, change, &facts);
    }
    return QDOT_OK;
}

/* Check that the scene is of a kind whose orbits can be followed, and that p can be the family's parameter. */
static qdot_status
check_family(qdot_orbit_path *x)
{
    qdot_scene *s = x->of.scene;

    bool lagrangian;

    QDOT_TRY(qdot_floquet_is_lagrangian(s, &lagrangian));
    x->asymptotic = !lagrangian;
    QDOT_TRY(qdot_orbit_is_driven(s, x->of.request, &x->driven));
    if (!x->driven)
        QDOT_TRY(qdot_mech_energy_conserved(s, &x->conserved));
    if (x->conserved)
        QDOT_TRY(events_keep_energy(x, &x->conserved));
    if (x->of.family != QDOT_ORBIT_PARAMETER && !x->conserved)
        return qdot_fail(QDOT_EINVAL, "the energy is not conserved: at one value of the parameters "
                                      "orbits form no family");
    return QDOT_OK;
}

qdot_status
qdot_orbit_path_begin(qdot_orbit_path *x, const qdot_orbit_of *of, double *size, double *y)
{
    qdot_path *path = &x->path;

    *x = (qdot_orbit_path){.of = *of, .n = of->scene->coordinates.n};
    x->phase = 2 * x->n;
    QDOT_TRY(check_family(x));
    QDOT_TRY(qdot_constant_double(of->scene->pool, of->request->t0, &x->t0));
    if (x->driven)
        QDOT_TRY(make_period_function(x));
    QDOT_TRY(make_flow_maps(x));
    QDOT_TRY(qdot_path_begin(path, 2 * x->n * x->K + 1 + x->conserved));
    path->coordinates = 2 * x->n + 1;
    path->half = of->segments > 0 ? segment_start_index(x, x->K / 2) : 0;
    path->least = of->least;
    path->most = of->most;
    path->exact = exact;
    path->shortest = shortest;
    path->longest = longest;
    path->least_jump = 2;
    path->halvings = 0;
    path->at = evaluate_orbit_equations;
    path->judge = judge_orbit;
    x->domain = qdot_calloc(2 * path->n, sizeof *x->domain);
    x->angle = qdot_calloc(path->n, sizeof *x->angle);
    if (!x->domain || !x->angle)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < path->n; i++) {
        x->domain[i] = i == 2 * x->n ? 0 : -INFINITY;
        x->domain[path->n + i] = INFINITY;
    }
    path->lo = x->domain;
    path->hi = x->domain + path->n;
    path->angle = x->angle;
    QDOT_TRY(orbit_allocate(x));
    QDOT_TRY(make_first_point(x, size, y));
    memcpy(x->sizes, size, 2 * x->n * sizeof *size);
    path->width = path->n + 1 + x->n + x->c;
    size[path->n] = of->most - of->least;
    for (size_t i = path->n + 1; i < path->width; i++)
        size[i] = i - path->n - 1 < x->n ? size[i - path->n - 1] : 1;
    qdot_path_scale(path, size);
    return QDOT_OK;
}

void
qdot_orbit_path_end(qdot_orbit_path *x)
{
    for (size_t k = 0; k < 2; k++)
        qdot_flow_end(&x->flow[k]);
    qdot_tape_free(x->period);
    qdot_free(x->period_work);
    qdot_free(x->values);
    qdot_free(x->domain);
    qdot_free(x->angle);
    qdot_path_end(&x->path);
    *x = (qdot_orbit_path){0};
}
