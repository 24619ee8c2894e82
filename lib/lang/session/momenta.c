/* momenta.c -- converts expressions between momenta p[q] and velocities q'. */
#include "lang/session/momenta.h"

#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/quantity.h"
#include "mech/study/hamilton.h"

static const uint32_t moving = QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION;

static uint32_t
node_holds(const qdot_session *s, qdot_expr e)
{
    return e == QDOT_NIL ? 0 : qdot_expr_node(s->pool, e)->holds;
}

/* Whether the scene has a Lagrangian, so that momenta and velocities are related. */
static bool
is_related(const qdot_scene *scene)
{
    return scene->coordinates.n > 0 && (scene->particles.n > 0 || scene->bodies.n > 0 ||
                                        scene->lagrangian != QDOT_NIL);
}

qdot_expr
qdot_momenta_to_velocities(qdot_session *session, qdot_expr e)
{
    if (!(node_holds(session, e) & QDOT_HAS_MOMENTUM) || !is_related(session->scene))
        return e;
    return qdot_hamilton_in_velocities(session->scene, e);
}

static bool
symbol_is_held(const qdot_session *s, uint32_t n, const qdot_expr *e, qdot_expr symbol)
{
    for (uint32_t i = 0; i < n; i++)
        if (e[i] != QDOT_NIL && qdot_expr_contains(s->pool, e[i], symbol))
            return true;
    return false;
}

/* Whether the momentum of q depends on coordinates and time only, as where L is linear in q'. */
static bool
is_of_places(const qdot_session *s, qdot_expr q)
{
    const qdot_expr p = qdot_mech_momentum(s->scene, q);

    return p != QDOT_NIL && !(node_holds(s, p) & (moving | QDOT_HAS_MOMENTUM));
}

bool
qdot_momenta_meet(const qdot_session *session, uint32_t n, const qdot_expr *e)
{
    qdot_pool *pool = session->pool;
    const qdot_scene *scene = session->scene;
    uint32_t all = 0;

    for (uint32_t i = 0; i < n; i++)
        all |= node_holds(session, e[i]);
    if (!(all & QDOT_HAS_MOMENTUM) || !is_related(scene))
        return false;
    for (size_t i = 0; i < scene->coordinates.n; i++) {
        const qdot_expr q = scene->coordinates.at[i];

        if (symbol_is_held(session, n, e, qdot_symbol_of(pool, QDOT_MOMENTUM, q)) &&
            (symbol_is_held(session, n, e, qdot_symbol_jet(pool, q, 1)) ||
             symbol_is_held(session, n, e, qdot_symbol_jet(pool, q, 2)) || is_of_places(session, q)))
            return true;
    }
    return false;
}

qdot_expr
qdot_momenta_for(qdot_session *session, qdot_expr e, qdot_expr symbol)
{
    const uint32_t variable = node_holds(session, symbol), held = node_holds(session, e);
    const qdot_expr both[] = {e, symbol};

    if (!(variable & QDOT_HAS_MOMENTUM))
        return qdot_momenta_meet(session, 2, both) ? qdot_momenta_to_velocities(session, e) : e;
    if (!(held & QDOT_HAS_VELOCITY) || (held & QDOT_HAS_ACCELERATION) ||
        !is_related(session->scene))
        return e;
    return qdot_hamilton_in_momenta(session->scene, e);
}
