/* start-momenta.c -- a start that gives momenta: the velocities at the beginning of a run. */
#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/runs/request.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/start-kind.h"
#include "lang/session/values.h"
#include "mech/dynamics/quantity.h"
#include "mech/hamilton/legendre.h"
#include "normal/solve/zeros.h"

/* A start in momenta: of the coordinates q [n], numbers `at` of the scene, momenta p = value. */
typedef struct {
    uint32_t n;
    qdot_expr *q, *p, *value;
    size_t *at;
} start;

/* Collect the coordinates whose momentum is named or unknown, or of which nothing is named: that momentum is 0. */
static void
collect_start_momenta(qdot_session *session, const qdot_start_by_momenta *o, start *s)
{
    const qdot_scene *scene = session->scene;

    for (size_t i = 0; i < scene->coordinates.n; i++) {
        const qdot_expr q = scene->coordinates.at[i], p = qdot_symbol_of(session->pool, QDOT_MOMENTUM, q);
        const qdot_expr given = qdot_session_value_started(session, p);
        const bool unknown = qdot_expr_place(o->k, o->unknowns, p) < o->k, named = unknown || given != QDOT_NIL;

        if ((!named && o->v_named[i]) || qdot_scene_state_of(scene, q) != NULL) /* a state has no momentum */
            continue;
        s->q[s->n] = q;
        s->p[s->n] = p;
        s->value[s->n] = unknown ? p : named ? qdot_session_bind(session, given) : QDOT_ZERO;
        o->v_named[i] = named;
        s->at[s->n++] = i;
    }
}

/* L at the start, as a function of the velocities that are sought. */
static qdot_expr
lagrangian_at_start(qdot_session *session, const qdot_start_by_momenta *o, const start *s)
{
    qdot_pool *pool = session->pool;
    qdot_expr L = qdot_mech_lagrangian(session->scene), t = QDOT_T;

    for (size_t i = 0; i < session->scene->coordinates.n && L != QDOT_NIL; i++) {
        const qdot_expr q = session->scene->coordinates.at[i], v = qdot_symbol_jet(pool, q, 1);

        L = qdot_subs(pool, L, 1, &q, &o->q0[i]);
        if (qdot_expr_place(s->n, s->q, q) == s->n)
            L = qdot_subs(pool, L, 1, &v, &o->v0[i]);
    }
    L = qdot_subs(pool, L, 1, &t, &o->t0);
    return L == QDOT_NIL ? L : qdot_session_bind(session, L);
}

/* Fail, because p = dL/dq' does not determine the velocities, or that is not known. */
static qdot_status
report_undetermined(const qdot_session *session, const start *s, const qdot_zeros *zeros)
{
    const char *q = qdot_expr_symbol(session->pool, s->q[0])->name;

    if (zeros->complete && zeros->doubts == 0 && zeros->count == 1)
        (void)qdot_fail(QDOT_EDOMAIN, "at the start the momenta do not determine the velocities: d2L/dq'dq' is singular there");
    else if (zeros->complete && zeros->doubts == 0)
        (void)(zeros->count == 0 ? qdot_fail(QDOT_EDOMAIN, "no velocity at the start has these momenta")
                                 : qdot_fail(QDOT_EDOMAIN, "%zu velocities at the start have these momenta, such as %.80s' = %.12g",
                                             zeros->count, q, zeros->at[0]));
    else
        (void)qdot_fail(QDOT_EDOMAIN, "the velocities that have these momenta at the start were not found, or others may have them");
    return qdot_hint("start %s' = ... gives a velocity", q);
}

/* Solve p = dL/dq' in numbers, L at the start: the only zero, proved. */
static qdot_status
solve_in_numbers(qdot_session *session, const qdot_start_by_momenta *o, const start *s, qdot_expr L)
{
    qdot_pool *pool = session->pool;
    qdot_expr *F = qdot_calloc(2 * (size_t)s->n + 1, sizeof *F), *v = F + s->n;
    qdot_zeros_range *range = qdot_calloc(s->n + 1, sizeof *range);
    qdot_zeros zeros = {0};
    qdot_status status = F == NULL || range == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (uint32_t i = 0; i < s->n && status == QDOT_OK; i++) {
        v[i] = qdot_symbol_jet(pool, s->q[i], 1);
        F[i] = qdot_sub(pool, qdot_diff(pool, L, v[i]), s->value[i]);
        range[i] = (qdot_zeros_range){.lo = QDOT_NIL, .hi = QDOT_NIL, .held = QDOT_NIL};
    }
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    if (status == QDOT_OK)
        status = qdot_zeros_find(pool, s->n, F, v, range, 0, &zeros);
    if (status == QDOT_OK && (zeros.count != 1 || !zeros.complete || zeros.doubts > 0 || !zeros.simple[0]))
        status = report_undetermined(session, s, &zeros);
    for (uint32_t i = 0; i < s->n && status == QDOT_OK; i++)
        o->v0[s->at[i]] = qdot_measured_rational(pool, zeros.at[i]);
    qdot_zeros_clear(&zeros);
    qdot_free(F);
    qdot_free(range);
    return status == QDOT_OK ? qdot_pool_check(pool) : status;
}

/* Solve p = dL/dq' at the start, by a formula or else in numbers. */
static qdot_status
solve_start_momenta(qdot_session *session, const qdot_start_by_momenta *o, const start *s, bool *in_numbers)
{
    const qdot_expr L = lagrangian_at_start(session, o, s);
    qdot_legendre l = {0};
    qdot_status status;

    QDOT_TRY(qdot_pool_check(session->pool));
    if (qdot_legendre_begin(&l, session->scene, QDOT_COORD, L, s->n, s->q))
        for (uint32_t i = 0; i < s->n; i++)
            o->v0[s->at[i]] = qdot_subs(session->pool, l.solved[i], s->n, s->p, s->value);
    qdot_legendre_end(&l);
    status = qdot_pool_check(session->pool);
    *in_numbers = status == QDOT_EDOMAIN && o->k == 0 && s->n <= QDOT_ZEROS_MOST_UNKNOWNS;
    return *in_numbers ? solve_in_numbers(session, o, s, L) : status;
}

qdot_status
qdot_start_by_momenta_solve(qdot_session *session, const qdot_start_by_momenta *o, bool *in_numbers)
{
    const size_t n = session->scene->coordinates.n;
    start s = {0};
    qdot_status status = QDOT_OK;

    QDOT_TRY(qdot_higher_refuse(session->scene, "a start by momenta"));
    s.q = qdot_calloc(3 * n + 1, sizeof *s.q);
    s.at = qdot_calloc(n + 1, sizeof *s.at);
    if (s.q == NULL || s.at == NULL)
        status = QDOT_ENOMEM;
    if (status == QDOT_OK) {
        s.p = s.q + n;
        s.value = s.p + n;
        collect_start_momenta(session, o, &s);
        status = solve_start_momenta(session, o, &s, in_numbers);
    }
    qdot_free(s.q);
    qdot_free(s.at);
    return status;
}

qdot_status
qdot_request_momenta(qdot_session *session, qdot_request *o)
{
    const qdot_start_by_momenta of = {.q0 = o->q0.at, .v0 = o->v0.at, .v_named = o->v_named.at, .t0 = o->request.t0};

    if (!qdot_session_starts_by_momenta(session))
        return QDOT_OK;
    return qdot_start_by_momenta_solve(session, &of, &o->momenta_in_numbers);
}
