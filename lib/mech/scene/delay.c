/* delay.c -- where a scene may hold coordinates at an earlier time, x(t - tau): in forces, torques, rates of states and events. */
#include "expr/symbol.h"
#include "mech/scene/scene.h"

qdot_status
qdot_scene_refuse_delays(const qdot_scene *s, qdot_expr e, const char *what)
{
    if (e == QDOT_NIL || !qdot_has_delayed(s->pool, e))
        return QDOT_OK;
    qdot_fail(QDOT_ENOTBUILT, "not built yet: %s that holds a delay", what);
    return qdot_hint("forces, torques and rates of states may hold one: force F(x(t - tau)) on p");
}

static bool
event_has_delays(qdot_pool *pool, const qdot_event *e)
{
    bool has = qdot_has_delayed(pool, e->left) || qdot_has_delayed(pool, e->right);

    for (size_t k = 0; k < e->values.n && !has; k++)
        has = qdot_has_delayed(pool, e->values.at[k]);
    return has;
}

bool
qdot_scene_has_delays(const qdot_scene *s)
{
    bool has = false;

    for (size_t i = 0; i < s->forces.n && !has; i++)
        has = qdot_has_delayed(s->pool, s->forces.at[i].force);
    for (size_t i = 0; i < s->torques.n && !has; i++)
        has = qdot_has_delayed(s->pool, s->torques.at[i].torque);
    for (size_t i = 0; i < s->states.n && !has; i++)
        has = qdot_has_delayed(s->pool, s->states.at[i].rate);
    for (size_t i = 0; i < s->outputs.n && !has; i++)
        has = qdot_has_delayed(s->pool, s->outputs.at[i]);
    for (size_t i = 0; i < s->events.n && !has; i++)
        has = event_has_delays(s->pool, &s->events.at[i]);
    return has;
}
