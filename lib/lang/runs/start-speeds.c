/* start-speeds.c -- a start that gives speeds: the velocities at the beginning of a run. */
#include <math.h>

#include "base/memory.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/runs/request.h"
#include "lang/session/bind.h"
#include "lang/session/speeds.h"
#include "lang/session/start-kind.h"
#include "lang/session/values.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/scene.h"
#include "normal/solve/linear.h"

/* The symbols that have values at the start, with these: coordinates, speeds, t. */
typedef struct {
    uint32_t n;
    qdot_expr *symbol, *value;
} place;

static void
set_place(place *p, qdot_expr symbol, qdot_expr value)
{
    p->symbol[p->n] = symbol;
    p->value[p->n++] = value;
}

/* A speed that is not named is 0. */
static void
fill_place(qdot_session *session, const qdot_request *o, const qdot_speeds *speeds, place *p)
{
    const qdot_scene *scene = session->scene;
    const qdot_values *values = session->values;

    for (size_t i = 0; i < scene->coordinates.n; i++)
        set_place(p, scene->coordinates.at[i], o->q0.at[i]);
    for (size_t k = 0; k < speeds->n; k++) {
        const size_t at = qdot_expr_place(values->start_symbols.n, values->start_symbols.at, speeds->symbol[k]);
        const bool named = at < values->start_symbols.n;

        set_place(p, speeds->symbol[k], named ? qdot_session_bind(session, values->start_values.at[at]) : QDOT_ZERO);
    }
    set_place(p, QDOT_T, o->request.t0);
}

static qdot_expr
at_place(qdot_session *session, const place *p, qdot_expr e)
{
    e = e == QDOT_NIL ? e : qdot_session_bind(session, e);
    return e == QDOT_NIL ? e : qdot_subs(session->pool, e, p->n, p->symbol, p->value);
}

/* Positions are not solved for beside speeds, whose meaning may depend on them. */
static qdot_status
check_positions(qdot_session *session, const place *p)
{
    const qdot_scene *scene = session->scene;

    for (size_t k = 0; k < scene->constraints.n; k++) {
        const qdot_constraint *c = &scene->constraints.at[k];
        double distance;

        if (c->kind != QDOT_HOLONOMIC)
            continue;
        QDOT_TRY(qdot_session_number(session, at_place(session, p, c->f), &distance, NULL));
        if (!(fabs(distance) > 1e-12))
            continue;
        (void)qdot_fail(QDOT_EINVAL, "the start breaks constraint %.100s: left - right is %.6g, not 0, and beside speeds no "
                        "coordinate is solved for", c->name, distance);
        return qdot_hint("give coordinates that keep it");
    }
    return QDOT_OK;
}

/* Solve A q' = b at the place for the velocities. */
static qdot_status
solve_velocities(qdot_session *session, const qdot_speeds *speeds, const place *p, qdot_request *o)
{
    qdot_scene *scene = session->scene;
    const size_t n = scene->coordinates.n;
    const qdot_facts facts = qdot_scene_facts(scene);
    qdot_expr *A = qdot_calloc(n * n + n, sizeof *A);
    uint32_t pivot = 0;
    qdot_status status = A == NULL ? QDOT_ENOMEM : qdot_speeds_rows(scene, speeds, A, A + n * n);

    for (size_t i = 0; i < n * n + n && status == QDOT_OK; i++) {
        A[i] = at_place(session, p, A[i]);
        status = qdot_pool_check(session->pool);
    }
    if (status == QDOT_OK)
        status = qdot_solve_linear(session->pool, (uint32_t)n, A, A + n * n, o->v0.at, &pivot, &facts);
    if (status == QDOT_ESINGULAR) {
        status = qdot_fail(QDOT_EINVAL, "at the start the speeds do not determine %.100s'",
                           qdot_expr_symbol(session->pool, scene->coordinates.at[pivot])->name);
        status = qdot_hint("give the velocities of coordinates");
    }
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        o->v_named.at[i] = qdot_scene_state_of(scene, scene->coordinates.at[i]) == NULL;
    qdot_free(A);
    return status;
}

qdot_status
qdot_request_speeds(qdot_session *session, qdot_request *o)
{
    qdot_speeds speeds;
    place p = {0};
    size_t most;
    qdot_status status;

    if (!qdot_session_starts_by_speeds(session))
        return QDOT_OK;
    QDOT_TRY(qdot_session_speeds(session, &speeds));
    most = session->scene->coordinates.n + speeds.n + 1;
    p.symbol = qdot_calloc(2 * most, sizeof *p.symbol);
    status = p.symbol == NULL ? QDOT_ENOMEM : QDOT_OK;
    if (status == QDOT_OK) {
        p.value = p.symbol + most;
        fill_place(session, o, &speeds, &p);
        status = qdot_pool_check(session->pool);
    }
    if (status == QDOT_OK)
        status = check_positions(session, &p);
    if (status == QDOT_OK)
        status = solve_velocities(session, &speeds, &p, o);
    qdot_free(p.symbol);
    qdot_free((void *)speeds.symbol);
    return status;
}
