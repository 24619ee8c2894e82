/* shooting.c -- finds periodic orbits by multiple shooting: segments, states between them, and gaps. */
#include "sim/study/shooting.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "expr/constant.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "num/zero.h"
#include "tape/derivative.h"

/* The largest growth of disturbances with which a single run supplies the first guess of the states
 * between segments. */
static const double trusted[] = {30, 5, 1};

/* The scale of the states between segments, relative to the extent of the motion: large, so that
 * they change freely. */
static const double free_states = 30;

/* A solution is a different orbit if its unknowns differ from the guesses by more than this, relatively. */
static const double near = 0.5;

/* An orbit is an equilibrium if velocities and accelerations are below this fraction of the states' sizes. */
static const double at_rest = 1e-6;

/* The tolerance with which segments are integrated. */
static const double tolerance = 1e-12;

typedef struct {
    const qdot_shooting_of *of;
    size_t z, k;           /* length 2n of a state; number of unknowns */
    size_t K;              /* number of segments */
    qdot_flow flow;
    qdot_expr *parameters; /* [flow.p] the parameters among the unknowns */
    size_t *place;         /* [flow.p] index, among the unknowns, of each parameter */
    double *p;             /* [flow.p] values of the parameters */
    qdot_tape *tape;       /* [z + 1] start and period as functions of the unknowns u [k] */
    double *tape_work;
    double t0;
    double *first, *slope; /* start and period [z + 1]; their derivatives by the unknowns u [(z + 1) x k] */
    double *size;          /* [z] range of each component along the orbit */
    double *best;          /* [2k] orbit nearest to the guess: unknowns, then errors */
    double *states;        /* [K x z] states at the starts of the segments; NULL: not requested */
    size_t rank;           /* rank of the equations in u at this orbit */
} shooting;

/* --- guesses for start and states ------------------------------------------------------------ */

/* Evaluate start and period at the unknowns u, with their derivatives by u. */
static void
evaluate_start_and_period(shooting *x, const double *u)
{
    qdot_derivative_eval(x->tape, u, 0, x->k, x->first, x->slope, x->tape_work);
}

/* Integrate the motion from a state by qdot_flow_go, with the parameter values contained in u. */
static qdot_status
integrate_from_state(shooting *x, const double *u, const double *state, double from, double to, size_t count)
{
    for (size_t i = 0; i < x->flow.p; i++)
        x->p[i] = u[x->place[i]];
    return qdot_flow_go(&x->flow, state, x->p, from, to, count);
}

/* States [K + 1] along the run, forwards or back from one end, up to a growth of `trust`; known[]
 * marks those found. */
static qdot_status
integrate_segment_states(shooting *x, const double *u, bool back, double trust, double *states, bool *known)
{
    const double T = x->first[x->z], from = back ? x->t0 + T : x->t0;

    for (size_t k = 1; k < x->K; k++) {
        const size_t at = back ? x->K - k : k;
        qdot_status status;

        if (known[at])
            break;
        status = integrate_from_state(x, u, x->first, from, x->t0 + T * (double)at / (double)x->K, 1);
        if (status != QDOT_OK)
            return qdot_grave(status);
        if (!(qdot_flow_growth(&x->flow, 0, x->size) < trust))
            break;
        memcpy(states + at * x->z, x->flow.value, x->z * sizeof *states);
        known[at] = true;
    }
    return QDOT_OK;
}

/* Guess the states between the segments of the orbit: by integration from both ends, and interpolation. */
static qdot_status
guess_states(shooting *x, const double *u, double trust, double *states, bool *known)
{
    memset(known, 0, (x->K + 1) * sizeof *known);
    known[0] = known[x->K] = true;
    memcpy(states, x->first, x->z * sizeof *states);
    memcpy(states + x->K * x->z, x->first, x->z * sizeof *states);
    QDOT_TRY(integrate_segment_states(x, u, false, trust, states, known));
    QDOT_TRY(integrate_segment_states(x, u, true, trust, states, known));
    for (size_t a = 0; a < x->K;) {
        size_t b = a + 1;

        while (!known[b])
            b++;
        for (size_t k = a + 1; k < b; k++)
            for (size_t i = 0; i < x->z; i++)
                states[k * x->z + i] = states[a * x->z + i]
                                       + (states[b * x->z + i] - states[a * x->z + i])
                                             * (double)(k - a) / (double)(b - a);
        a = b;
    }
    return QDOT_OK;
}

/* --- gaps between segments --------------------------------------------------------------------- */

/* Add sign * M times the derivatives of the state at the start of segment `at` to J; rows of M [z x
 * (z + p)], or the unit matrix if NULL. */
static void
add_state_derivatives(const shooting *x, size_t at, const double *M, double sign, double *J)
{
    const size_t all = x->k + (x->K - 1) * x->z, width = x->z + x->flow.p;

    for (size_t i = 0; i < x->z; i++)
        for (size_t j = 0; j < x->z; j++) {
            const double m = M != NULL ? M[i * width + j] : i == j;

            if (at % x->K != 0)
                J[i * all + x->k + (at - 1) * x->z + j] += sign * m;
            for (size_t l = 0; l < x->k && at % x->K == 0; l++)
                J[i * all + l] += sign * m * x->slope[j * x->k + l];
        }
}

/* Find the gap after segment s and its derivatives, from the flow map over that segment. */
static void
fill_gap_after_segment(const shooting *x, const double *next, size_t s, double *f, double *J)
{
    const qdot_flow *const g = &x->flow;
    const size_t all = x->k + (x->K - 1) * x->z, width = x->z + g->p;
    const double *const end = g->value + g->m, *const by = g->by + g->m * width;

    for (size_t i = 0; i < x->z; i++)
        f[i] = end[i] - next[i];
    if (J == NULL)
        return;
    memset(J, 0, x->z * all * sizeof *J);
    add_state_derivatives(x, s, by, 1, J);
    add_state_derivatives(x, s + 1, NULL, -1, J);
    for (size_t i = 0; i < x->z; i++) {
        const double rate = qdot_flow_by_period(g, g->value, g->by, s, x->K, i);

        for (size_t l = 0; l < x->k; l++)
            J[i * all + l] += rate * x->slope[x->z * x->k + l];
        for (size_t l = 0; l < g->p; l++)
            J[i * all + x->place[l]] += by[i * width + x->z + l];
    }
}

static qdot_status
evaluate_gaps(const double *u, double *f, double *error, double *slope, void *user)
{
    shooting *x = user;
    const size_t all = x->k + (x->K - 1) * x->z;
    double T;

    evaluate_start_and_period(x, u);
    T = x->first[x->z];
    for (size_t s = 0; s < x->K; s++) {
        const double *from = s == 0 ? x->first : u + x->k + (s - 1) * x->z;
        const double *next = s + 1 == x->K ? x->first : u + x->k + s * x->z;
        const double t = x->t0 + T * (double)s / (double)x->K;
        const qdot_status status =
            isfinite(T) ? integrate_from_state(x, u, from, t, t + T / (double)x->K, 0) : QDOT_EDOMAIN;

        if (status != QDOT_OK) {
            f[0] = NAN;
            return qdot_grave(status);
        }
        for (size_t i = 0; i < x->z; i++)
            error[s * x->z + i] = 10 * tolerance * fmax(x->size[i], fabs(x->flow.value[x->flow.m + i]));
        fill_gap_after_segment(x, next, s, f + s * x->z, slope == NULL ? NULL : slope + s * x->z * all);
    }
    return QDOT_OK;
}

/* --- the search for the orbit -------------------------------------------------------------------- */

/* The largest distance of an unknown in u from its guess, relative to the guess or to the extent of
 * the motion. */
static double
distance_from_guess(const shooting *x, const double *u, const double *guess)
{
    double most = 0;

    for (size_t j = 0; j < x->k; j++) {
        const size_t i = qdot_expr_place(x->z, x->flow.unknowns, x->of->unknowns[j]);
        const double size = fmax(fabs(guess[j]), i < x->z ? x->size[i] : 0);

        most = fmax(most, fabs(u[j] - guess[j]) / (size > 0 ? size : 1));
    }
    return most;
}

/* Whether the states between the segments differ from the start, so that the orbit is no equilibrium. */
static bool
is_moving(const shooting *x, const double *states)
{
    for (size_t s = 1; s < x->K; s++)
        for (size_t i = 0; i < x->z; i++)
            if (fabs(states[(s - 1) * x->z + i] - x->first[i]) > at_rest * x->size[i])
                return true;
    return false;
}

/* A search with states from so much of the guess's run. An orbit that is nearer to it than *off becomes the best
 * [2k]. */
static qdot_status
search_orbit(shooting *x, double trust, const double *u, double *best, double *off)
{
    const size_t all = x->k + (x->K - 1) * x->z, m = x->K * x->z;
    double *room = qdot_calloc(5 * all + 2 * m + (x->K + 1) * x->z, sizeof *room);
    bool *known = qdot_calloc(x->K + 1, sizeof *known);
    qdot_zero_result r = {.u = room, .error = room + all, .f = room + 5 * all, .f_error = room + 5 * all + m};
    double *const unit = room + 2 * all, *const low = unit + all, *const high = low + all,
           *const states = r.f_error + m;
    const qdot_zero_problem p = {
        .n = all, .m = m, .at = evaluate_gaps, .user = x, .low = low, .high = high, .unit = unit, .once = true};
    qdot_status status = room && known ? QDOT_OK : QDOT_ENOMEM;

    evaluate_start_and_period(x, u);
    if (status == QDOT_OK)
        status = guess_states(x, u, trust, states, known);
    for (size_t j = 0; j < all && status == QDOT_OK; j++) {
        const size_t i = j < x->k ? 0 : (j - x->k) % x->z;

        r.u[j] = j < x->k ? u[j] : states[x->z + j - x->k];
        unit[j] = j >= x->k ? free_states * x->size[i] : u[j] != 0 ? fabs(u[j]) : 1;
        low[j] = j < x->k ? x->of->low[j] : -INFINITY;
        high[j] = j < x->k ? x->of->high[j] : INFINITY;
    }
    if (status == QDOT_OK)
        status = qdot_zero_find(&p, &r);
    if (status == QDOT_OK && r.answer == QDOT_ZERO_FOUND) {
        const double this = distance_from_guess(x, r.u, u);

        evaluate_start_and_period(x, r.u);
        if (this < *off && (x->of->followed || is_moving(x, r.u + x->k))) {
            *off = this;
            memcpy(best, r.u, x->k * sizeof *best);
            memcpy(best + x->k, r.error, x->k * sizeof *best);
            if (x->states != NULL) {
                memcpy(x->states, x->first, x->z * sizeof *states);
                memcpy(x->states + x->z, r.u + x->k, (x->K - 1) * x->z * sizeof *states);
            }
            x->rank = r.rank > all - x->k ? r.rank - (all - x->k) : 0;
        }
    }
    qdot_free(room);
    qdot_free(known);
    return status;
}

/* --- making and carrying out the search -------------------------------------------------------- */

static qdot_status
shooting_allocate(shooting *x)
{
    x->parameters = qdot_calloc(x->k + 1, sizeof *x->parameters);
    x->place = qdot_calloc(x->k + 1, sizeof *x->place);
    x->first = qdot_calloc((x->z + 1) * (1 + x->k) + x->z + 3 * x->k, sizeof *x->first);
    if (!x->parameters || !x->place || !x->first)
        return QDOT_ENOMEM;
    x->slope = x->first + x->z + 1;
    x->size = x->slope + (x->z + 1) * x->k;
    x->best = x->size + x->z;
    x->p = x->best + 2 * x->k;
    return QDOT_OK;
}

/* Compile start and period, as functions of the unknowns u, to a tape. */
static qdot_status
make_start_tape(shooting *x)
{
    qdot_pool *pool = x->of->scene->pool;
    qdot_expr *e = qdot_calloc(x->z + 1, sizeof *e);
    qdot_status status = e ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK) {
        memcpy(e, x->of->start, x->z * sizeof *e);
        e[x->z] = x->of->period;
        status = qdot_tape_new(pool, x->k, x->of->unknowns, x->z + 1, e, &x->tape);
    }
    if (status == QDOT_OK) {
        x->tape_work = qdot_malloc((qdot_derivative_work(x->tape) + 1) * sizeof *x->tape_work);
        status = x->tape_work ? QDOT_OK : QDOT_ENOMEM;
    }
    qdot_free(e);
    return status;
}

static qdot_status
shooting_begin(shooting *x, const double *u)
{
    const qdot_shooting_of *of = x->of;
    qdot_scene *s = of->scene;
    size_t p = 0;

    QDOT_TRY(shooting_allocate(x));
    for (size_t k = 0; k < x->k; k++)
        if (qdot_expr_is_class(s->pool, of->unknowns[k], QDOT_PARAM)) {
            x->parameters[p] = of->unknowns[k];
            x->place[p++] = k;
        }
    QDOT_TRY(make_start_tape(x));
    QDOT_TRY(qdot_constant_double(s->pool, of->request->t0, &x->t0));
    evaluate_start_and_period(x, u);
    for (size_t i = 0; i < p; i++)
        x->p[i] = u[x->place[i]];
    return qdot_flow_begin(&x->flow, s, of->request, p, x->parameters, QDOT_NIL, tolerance, x->first[x->z]);
}

static void
shooting_end(shooting *x)
{
    qdot_flow_end(&x->flow);
    qdot_tape_free(x->tape);
    qdot_free(x->tape_work);
    qdot_free(x->parameters);
    qdot_free(x->place);
    qdot_free(x->first);
}

qdot_status
qdot_shooting_find(const qdot_shooting_of *of, qdot_shooting_result *r)
{
    shooting x = {.of = of, .z = 2 * of->scene->coordinates.n, .k = of->k};
    double off = near;
    qdot_status status = QDOT_OK;

    r->found = false;
    r->segments = 1;
    if (of->scene->constraints.n > 0 && memcmp(of->start, of->unknowns, x.z * sizeof *of->start) != 0)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: multiple shooting under constraints");
    status = shooting_begin(&x, r->u);
    if (status == QDOT_OK)
        status = qdot_flow_segments_of_guess(&x.flow, x.first, x.p, x.t0, x.first[x.z], x.size, &x.K);
    if (status == QDOT_OK)
        r->segments = x.K = of->segments > 0 ? of->segments : x.K;
    x.states = r->states;
    if (status == QDOT_OK && of->followed)
        status = search_orbit(&x, INFINITY, r->u, x.best, &off);
    for (size_t k = 0; k < sizeof trusted / sizeof *trusted && status == QDOT_OK && x.K > 1 && !of->followed; k++)
        status = search_orbit(&x, trusted[k], r->u, x.best, &off);
    r->found = status == QDOT_OK && off < near;
    if (r->found) {
        memcpy(r->u, x.best, x.k * sizeof *r->u);
        memcpy(r->error, x.best + x.k, x.k * sizeof *r->error);
        r->rank = x.rank;
    }
    shooting_end(&x);
    return status;
}
