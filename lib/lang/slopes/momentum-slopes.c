/* momentum-slopes.c -- how velocities at the start of a run depend on an unknown, where momenta are given. */
#include "lang/slopes/momentum-slopes.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/session/bind.h"
#include "lang/session/start-kind.h"
#include "lang/session/values.h"
#include "mech/dynamics/quantity.h"
#include "normal/solve/linear.h"
#include "sim/model/substitute.h"

typedef struct {
    qdot_session *session;
    const qdot_momentum_slopes_of *x;
    size_t n, m;         /* coordinates; those of S */
    size_t *of;          /* [m] the coordinates of S */
    qdot_expr *A, *b, *solved; /* [m*m], [m], [m] */
} work;

/* Whether coordinate i starts with its momentum: that is the unknown, or it was named, or nothing of it was. */
static bool
starts_with_momentum(const work *w, size_t i)
{
    const qdot_values *values = w->session->values;
    const qdot_expr q = w->session->scene->coordinates.at[i], v = qdot_symbol_jet(w->session->pool, q, 1),
                    p = qdot_symbol_of(w->session->pool, QDOT_MOMENTUM, q);

    if (w->x->unknown == p || w->x->unknown == v)
        return w->x->unknown == p;
    if (!qdot_session_starts_by_momenta(w->session))
        return false;
    return qdot_expr_place(values->start_symbols.n, values->start_symbols.at, p) < values->start_symbols.n ||
           qdot_expr_place(values->start_symbols.n, values->start_symbols.at, v) == values->start_symbols.n;
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

/* dp_i/du of the value that was given for the momentum of coordinate i. */
static qdot_expr
slope_of_given_momentum(const work *w, size_t i)
{
    const qdot_values *values = w->session->values;
    qdot_pool *pool = w->session->pool;
    const qdot_expr p = qdot_symbol_of(pool, QDOT_MOMENTUM, w->session->scene->coordinates.at[i]);
    const size_t at = qdot_expr_place(values->start_symbols.n, values->start_symbols.at, p);

    if (w->x->unknown == p)
        return QDOT_ONE;
    if (w->x->values == NULL || at == values->start_symbols.n)
        return QDOT_ZERO;
    return qdot_diff(pool, qdot_session_bind(w->session, values->start_values.at[at]), w->x->unknown);
}

/* The equation of coordinate number k of S. */
static qdot_status
make_equation(const work *w, size_t k, const qdot_expr *start)
{
    qdot_pool *pool = w->session->pool;
    const qdot_scene *scene = w->session->scene;
    const qdot_conditions *c = w->x->of;
    const qdot_expr P = qdot_mech_momentum(w->session->scene, scene->coordinates.at[w->of[k]]);
    qdot_expr b = slope_of_given_momentum(w, w->of[k]);

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
        return qdot_fail(QDOT_ESINGULAR, "at the start the momenta do not determine the velocities");
    for (size_t k = 0; k < w->m && status == QDOT_OK; k++)
        start[w->n + w->of[k]] = w->solved[k];
    return status;
}

qdot_status
qdot_momentum_slopes(qdot_session *session, const qdot_momentum_slopes_of *x, qdot_expr *start)
{
    work w = {.session = session, .x = x, .n = session->scene->coordinates.n};
    qdot_status status = QDOT_OK;

    w.of = qdot_calloc(w.n + 1, sizeof *w.of);
    w.A = qdot_calloc(w.n * w.n + 2 * w.n + 1, sizeof *w.A);
    if (w.of == NULL || w.A == NULL)
        status = QDOT_ENOMEM;
    for (size_t i = 0; i < w.n && status == QDOT_OK; i++)
        if (starts_with_momentum(&w, i))
            w.of[w.m++] = i;
    if (status == QDOT_OK && w.m > 0 && session->scene->constraints.n > 0)
        status = qdot_fail(QDOT_ENOTBUILT, "not built yet: derivatives of runs with constraints whose start gives momenta");
    if (status == QDOT_OK && w.m > 0) {
        w.b = w.A + w.m * w.m;
        w.solved = w.b + w.m;
        status = solve_equations(&w, start);
    }
    qdot_free(w.of);
    qdot_free(w.A);
    return status == QDOT_OK ? qdot_pool_check(session->pool) : status;
}
