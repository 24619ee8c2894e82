/* start-slopes.c -- how velocities at the start of a run depend on an unknown, where momenta or speeds are given. */
#include "lang/slopes/start-slopes.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "lang/session/bind.h"
#include "lang/session/speeds.h"
#include "lang/session/start-kind.h"
#include "lang/session/values.h"
#include "mech/dynamics/quantity.h"
#include "normal/solve/linear.h"
#include "sim/model/substitute.h"

typedef struct {
    qdot_session *session;
    const qdot_start_slopes_of *x;
    size_t n, m;         /* coordinates; those of S */
    size_t *of;          /* [m] the coordinates of S */
    qdot_expr *P, *given; /* [m] what has a given value, and dp/du of this */
    qdot_expr *A, *b, *solved; /* [m*m], [m], [m] */
} work;

/* Whether coordinate i starts with its momentum: that is the unknown, or it was named, or nothing of it was. */
static bool
starts_with_momentum(const work *w, size_t i)
{
    const qdot_expr q = w->session->scene->coordinates.at[i], v = qdot_symbol_jet(w->session->pool, q, 1),
                    p = qdot_symbol_of(w->session->pool, QDOT_MOMENTUM, q);

    if (w->x->unknown == p || w->x->unknown == v)
        return w->x->unknown == p;
    if (!qdot_session_starts_by_momenta(w->session))
        return false;
    return qdot_session_value_started(w->session, p) != QDOT_NIL || qdot_session_value_started(w->session, v) == QDOT_NIL;
}

/* e at the start of the run. */
static qdot_expr
at_start(const work *w, qdot_expr e)
{
    qdot_pool *pool = w->session->pool;
    const qdot_conditions *c = w->x->of;
    const qdot_expr t = QDOT_T;

    for (size_t i = 0; i < w->n && e != QDOT_NIL; i++) {
        const qdot_expr q = w->session->scene->coordinates.at[i], from[] = {q, qdot_symbol_jet(pool, q, 1)},
                        to[] = {c->q0.at[i], c->v0.at[i]};

        e = qdot_subs(pool, e, 2, from, to);
    }
    e = e == QDOT_NIL ? e : qdot_subs(pool, e, 1, &t, &c->t0);
    return e == QDOT_NIL ? e : qdot_substitute(pool, e, c->symbols.n, c->symbols.at, c->values.at);
}

/* dp/du of the value that was given for the momentum or speed p. */
static qdot_expr
slope_of_given(const work *w, qdot_expr p)
{
    const qdot_expr given = qdot_session_value_started(w->session, p);

    if (w->x->unknown == p)
        return QDOT_ONE;
    if (w->x->values == NULL || given == QDOT_NIL)
        return QDOT_ZERO;
    return qdot_diff(w->session->pool, qdot_session_bind(w->session, given), w->x->unknown);
}

/* The equation of coordinate number k of S. */
static qdot_status
make_equation(const work *w, size_t k, const qdot_expr *start)
{
    qdot_pool *pool = w->session->pool;
    const qdot_scene *scene = w->session->scene;
    const qdot_conditions *c = w->x->of;
    const qdot_expr P = w->P[k];
    qdot_expr b = w->given[k];

    for (size_t j = 0; j < 2 * w->n; j++) {
        const qdot_expr jet = qdot_symbol_jet(pool, scene->coordinates.at[j % w->n], j >= w->n), slope = qdot_diff(pool, P, jet);
        size_t own = 0;

        while (own < w->m && j != w->n + w->of[own])
            own++;
        if (own < w->m)
            w->A[k * w->m + own] = at_start(w, slope);
        else
            b = qdot_sub(pool, b, qdot_mul(pool, slope, start[j]));
    }
    for (size_t i = 0; i < c->symbols.n && w->x->values != NULL; i++)
        b = qdot_sub(pool, b, qdot_mul(pool, qdot_diff(pool, P, c->symbols.at[i]), qdot_diff(pool, w->x->values[i], w->x->unknown)));
    w->b[k] = at_start(w, b);
    return qdot_pool_check(pool);
}

static qdot_status
solve_equations(const work *w, qdot_expr *start)
{
    const qdot_facts facts = {0};
    uint32_t pivot;
    qdot_status status = QDOT_OK;

    for (size_t k = 0; k < w->m && status == QDOT_OK; k++)
        status = make_equation(w, k, start);
    if (status == QDOT_OK)
        status = qdot_solve_linear(w->session->pool, (uint32_t)w->m, w->A, w->b, w->solved, &pivot, &facts);
    if (status == QDOT_ESINGULAR)
        return qdot_fail(QDOT_ESINGULAR, "at the start what is given does not determine the velocities");
    for (size_t k = 0; k < w->m && status == QDOT_OK; k++)
        start[w->n + w->of[k]] = w->solved[k];
    return status;
}

/* Find S, the P_i and what is given where the start gives momenta. */
static qdot_status
collect_momenta(work *w)
{
    qdot_pool *pool = w->session->pool;
    qdot_scene *scene = w->session->scene;

    for (size_t i = 0; i < w->n; i++)
        if (starts_with_momentum(w, i)) {
            const qdot_expr q = scene->coordinates.at[i];

            w->P[w->m] = qdot_mech_momentum(scene, q);
            w->given[w->m] = slope_of_given(w, qdot_symbol_of(pool, QDOT_MOMENTUM, q));
            w->of[w->m++] = i;
        }
    QDOT_TRY(qdot_pool_check(pool));
    return w->m == 0 || scene->constraints.n == 0
               ? QDOT_OK
               : qdot_fail(QDOT_ENOTBUILT, "not built yet: derivatives of runs with constraints whose start gives momenta");
}

/* All coordinates, by the equations A q' = b of speeds and constraints: P = A q' - b without the speed in b. */
static qdot_status
collect_speeds(work *w, const qdot_speeds *speeds)
{
    qdot_pool *pool = w->session->pool;
    qdot_scene *scene = w->session->scene;
    const size_t n = w->n;

    QDOT_TRY(qdot_speeds_rows(scene, speeds, w->A, w->b));
    for (size_t i = 0; i < n; i++) {
        w->of[i] = i;
        w->given[i] = QDOT_ZERO;
        w->P[i] = qdot_neg(pool, w->b[i]);
        for (size_t k = 0; k < speeds->n; k++) {
            const qdot_expr zero = QDOT_ZERO;

            w->given[i] = qdot_add(pool, w->given[i], qdot_mul(pool, qdot_diff(pool, w->b[i], speeds->symbol[k]),
                                                               slope_of_given(w, speeds->symbol[k])));
            w->P[i] = qdot_subs(pool, w->P[i], 1, &speeds->symbol[k], &zero);
        }
        for (size_t j = 0; j < n; j++)
            w->P[i] = qdot_add(pool, w->P[i], qdot_mul(pool, w->A[i * n + j], qdot_symbol_jet(pool, scene->coordinates.at[j], 1)));
    }
    w->m = n;
    return qdot_pool_check(pool);
}

static qdot_status
collect_given(work *w)
{
    qdot_session *session = w->session;
    qdot_speeds speeds;
    qdot_status status;

    if (!qdot_session_is_speed(session, w->x->unknown) && !qdot_session_starts_by_speeds(session))
        return collect_momenta(w);
    QDOT_TRY(qdot_session_speeds(session, &speeds));
    status = collect_speeds(w, &speeds);
    qdot_free((void *)speeds.symbol);
    return status;
}

qdot_status
qdot_start_slopes(qdot_session *session, const qdot_start_slopes_of *x, qdot_expr *start)
{
    const size_t n = session->scene->coordinates.n;
    work w = {.session = session, .x = x, .n = n};
    qdot_status status;

    w.of = qdot_calloc(n + 1, sizeof *w.of);
    w.A = qdot_calloc(n * n + 4 * n + 1, sizeof *w.A);
    status = w.of == NULL || w.A == NULL ? QDOT_ENOMEM : QDOT_OK;
    if (status == QDOT_OK) {
        w.b = w.A + n * n;
        w.solved = w.b + n;
        w.P = w.solved + n;
        w.given = w.P + n;
        status = collect_given(&w);
    }
    if (status == QDOT_OK && w.m > 0)
        status = solve_equations(&w, start);
    qdot_free(w.of);
    qdot_free(w.A);
    return status == QDOT_OK ? qdot_pool_check(session->pool) : status;
}
