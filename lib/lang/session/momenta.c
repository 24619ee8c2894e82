/* momenta.c -- converts expressions between momenta p[q] and velocities q'. */
#include "lang/session/momenta.h"

#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/session/evaluation.h"
#include "lang/session/speeds.h"
#include "mech/dynamics/quantity.h"
#include "mech/hamilton/hamilton.h"
#include "mech/hamilton/phase-constraints.h"
#include "mech/hamilton/phase-symbols.h"

static const uint32_t moving = QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION;

static uint32_t
symbol_kinds_in(const qdot_session *s, qdot_expr e)
{
    return e == QDOT_NIL ? 0 : qdot_expr_node(s->pool, e)->holds;
}

/* Whether the scene has a Lagrangian, so that momenta and velocities are related. */
static bool
has_lagrangian(const qdot_scene *scene)
{
    return scene->coordinates.n > 0 && (scene->particles.n > 0 || scene->bodies.n > 0 ||
                                        scene->lagrangian != QDOT_NIL);
}

qdot_expr
qdot_momenta_to_velocities(qdot_session *session, qdot_expr e)
{
    e = qdot_session_speeds_replaced(session, e);
    if (!session->evaluation->declares)
        e = qdot_phase_constraints_put(session->scene, e);
    if (!(symbol_kinds_in(session, e) & QDOT_HAS_MOMENTUM)
        || (!has_lagrangian(session->scene) && !qdot_phase_space_needed(session->scene)))
        return e;
    return qdot_hamilton_in_velocities(session->scene, e);
}

qdot_expr
qdot_momenta_unify(qdot_session *session, qdot_expr e)
{
    return qdot_phase_space_needed(session->scene) ? qdot_hamilton_in_momenta(session->scene, e)
                                                   : qdot_momenta_to_velocities(session, e);
}

/* Whether the momentum of q depends on coordinates and time only, as it does where L is linear in q'. */
static bool
momentum_is_without_velocity(const qdot_session *s, qdot_expr q)
{
    const qdot_expr p = qdot_mech_momentum(s->scene, q);

    return p != QDOT_NIL && !(symbol_kinds_in(s, p) & (moving | QDOT_HAS_MOMENTUM));
}

bool
qdot_momenta_meet(const qdot_session *session, uint32_t n, const qdot_expr *e)
{
    qdot_pool *pool = session->pool;
    const qdot_scene *scene = session->scene;
    uint32_t all = 0;

    for (uint32_t i = 0; i < n; i++)
        all |= symbol_kinds_in(session, e[i]);
    if (qdot_phase_space_needed(scene))
        return (all & QDOT_HAS_MOMENTUM) && (all & QDOT_HAS_VELOCITY);
    if (!(all & QDOT_HAS_MOMENTUM) || !has_lagrangian(scene))
        return false;
    for (size_t i = 0; i < scene->coordinates.n; i++) {
        const qdot_expr q = scene->coordinates.at[i];

        if (qdot_expr_is_in_any(pool, qdot_symbol_of(pool, QDOT_MOMENTUM, q), n, e) &&
            (qdot_expr_is_in_any(pool, qdot_symbol_jet(pool, q, 1), n, e) ||
             qdot_expr_is_in_any(pool, qdot_symbol_jet(pool, q, 2), n, e) || momentum_is_without_velocity(session, q)))
            return true;
    }
    return false;
}

qdot_expr
qdot_momenta_for(qdot_session *session, qdot_expr e, qdot_expr symbol)
{
    const uint32_t variable = symbol_kinds_in(session, symbol), held = symbol_kinds_in(session, e);
    const qdot_expr both[] = {e, symbol};

    if (!(variable & QDOT_HAS_MOMENTUM))
        return qdot_momenta_meet(session, 2, both) ? qdot_momenta_to_velocities(session, e) : e;
    if (!(held & QDOT_HAS_VELOCITY) || (held & QDOT_HAS_ACCELERATION) ||
        (!has_lagrangian(session->scene) && session->scene->hamiltonian == QDOT_NIL))
        return e;
    return qdot_hamilton_in_momenta(session->scene, e);
}
