/* motion.c -- functions of expressions along the motion: rate. */
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/value-kind.h"
#include "lang/functions/builtin.h"
#include "lang/session/momenta.h"
#include "lang/session/speeds.h"
#include "mech/dynamics/quantity.h"
#include "mech/dynamics/rate.h"
#include "mech/scene/things.h"
#include "mech/hamilton/phase-constraints.h"

/* The rate of e in velocities or, as speeds and momenta have rates of their own, in these. */
static qdot_expr
rate_of_scalar(qdot_pool *pool, qdot_expr e, void *session)
{
    qdot_session *s = session;

    if (qdot_session_in_speeds(s, e))
        return qdot_session_speeds_rate(s, e);
    e = qdot_session_speeds_replaced(s, e);
    if (e == QDOT_NIL)
        return e;
    if ((qdot_expr_node(pool, e)->holds & (QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION)) ||
        qdot_mech_holds_momentum_rate(s->scene, e))
        e = qdot_momenta_unify(session, e);
    return e == QDOT_NIL ? e : qdot_phase_constraints_put(s->scene, qdot_rate_of(s->scene, e));
}

qdot_status
qdot_call_rate(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    const qdot_scene *scene = s->scene;
    const qdot_expr e = args[0];

    (void)n;
    if ((qdot_expr_node(s->pool, e)->holds & (QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_MOMENTUM)) &&
        scene->particles.n == 0 &&
        scene->bodies.n == 0 && scene->lagrangian == QDOT_NIL && scene->hamiltonian == QDOT_NIL) {
        qdot_fail(QDOT_EINVAL, "the scene has nothing that moves, so accelerations are unknown");
        return qdot_hint("ddt(...) keeps them; or declare a `particle`, a `body` or a `lagrangian`");
    }
    return qdot_value_kind_give(s->pool, qdot_value_map(s->pool, e, rate_of_scalar, s), value);
}
