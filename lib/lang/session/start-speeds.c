/* start-speeds.c -- the velocities that a start by speeds gives. */
#include "lang/session/start-speeds.h"

#include "base/memory.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/session/bind.h"
#include "lang/session/speeds.h"
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

/* The number that the start gives, 0 where it gives none, with the values of parameters. */
static qdot_expr
value_of_start(qdot_session *session, qdot_expr symbol)
{
    const qdot_expr value = qdot_session_value_started(session, symbol);

    return value == QDOT_NIL ? QDOT_ZERO : qdot_session_bind(session, value);
}

static qdot_status
solve_at_place(qdot_session *session, const qdot_speeds *speeds, const place *p, qdot_expr *v0)
{
    qdot_scene *scene = session->scene;
    const size_t n = scene->coordinates.n;
    const qdot_facts facts = qdot_scene_facts(scene);
    qdot_expr *A = qdot_calloc(n * n + n, sizeof *A);
    uint32_t pivot = 0;
    qdot_status status = A == NULL ? QDOT_ENOMEM : qdot_speeds_rows(scene, speeds, A, A + n * n);

    for (size_t i = 0; i < n * n + n && status == QDOT_OK; i++) {
        A[i] = qdot_session_bind(session, A[i]);
        A[i] = A[i] == QDOT_NIL ? A[i] : qdot_subs(session->pool, A[i], p->n, p->symbol, p->value);
        status = qdot_pool_check(session->pool);
    }
    if (status == QDOT_OK)
        status = qdot_solve_linear(session->pool, (uint32_t)n, A, A + n * n, v0, &pivot, &facts);
    if (status == QDOT_ESINGULAR) {
        (void)qdot_fail(QDOT_EINVAL, "at the start the speeds do not determine %.100s'",
                        qdot_expr_symbol(session->pool, scene->coordinates.at[pivot])->name);
        status = qdot_hint("give the velocities of coordinates");
    }
    qdot_free(A);
    return status;
}

qdot_status
qdot_session_start_velocities(qdot_session *session, size_t n, const qdot_expr *unknowns, const qdot_expr *q0, qdot_expr t0,
                              qdot_expr *v0)
{
    const qdot_scene *scene = session->scene;
    qdot_speeds speeds;
    place p = {0};
    size_t most;
    qdot_status status;

    QDOT_TRY(qdot_session_speeds(session, &speeds));
    most = scene->coordinates.n + speeds.n + 1;
    p.symbol = qdot_calloc(2 * most, sizeof *p.symbol);
    status = p.symbol == NULL ? QDOT_ENOMEM : QDOT_OK;
    if (status == QDOT_OK) {
        p.value = p.symbol + most;
        for (size_t i = 0; i < scene->coordinates.n; i++)
            set_place(&p, scene->coordinates.at[i], q0 != NULL ? q0[i] : value_of_start(session, scene->coordinates.at[i]));
        for (size_t k = 0; k < speeds.n; k++) {
            const qdot_expr u = speeds.symbol[k];

            set_place(&p, u, qdot_expr_place(n, unknowns, u) < n ? u : value_of_start(session, u));
        }
        set_place(&p, QDOT_T, t0);
        status = qdot_pool_check(session->pool);
    }
    if (status == QDOT_OK)
        status = solve_at_place(session, &speeds, &p, v0);
    qdot_free(p.symbol);
    qdot_free((void *)speeds.symbol);
    return status;
}
