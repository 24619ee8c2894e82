/* event.c -- declares, finds and prints the events of a scene. */
#include <string.h>

#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "mech/scene/access.h"
#include "mech/scene/scene.h"

const qdot_event *
qdot_scene_find_event(const qdot_scene *s, const char *label)
{
    for (size_t i = 0; i < s->events.n; i++)
        if (strcmp(s->events.at[i].name, label) == 0)
            return &s->events.at[i];
    return NULL;
}

const qdot_event *
qdot_scene_acting_event(const qdot_scene *s)
{
    for (size_t i = 0; i < s->events.n; i++)
        if (s->events.at[i].stop || s->events.at[i].targets.n > 0)
            return &s->events.at[i];
    return NULL;
}

static qdot_status
check_event(const qdot_scene *s, const qdot_event *e)
{
    const uint32_t strange = QDOT_HAS_FORMAL | QDOT_HAS_MOMENTUM | QDOT_HAS_DIFFERENTIAL |
                             QDOT_HAS_DELTA;
    const uint32_t motion = QDOT_HAS_TIME | QDOT_HAS_COORD | QDOT_HAS_VELOCITY |
                            QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER;
    uint32_t holds;

    if (!qdot_expr_is_scalar(s->pool, e->left) || !qdot_expr_is_scalar(s->pool, e->right))
        return qdot_fail(QDOT_ETYPE, "an event is an equation of numbers");
    holds = qdot_expr_node(s->pool, e->left)->holds |
            qdot_expr_node(s->pool, e->right)->holds;
    for (size_t i = 0; i < e->values.n; i++) {
        if (!qdot_expr_is_scalar(s->pool, e->values.at[i]))
            return qdot_fail(QDOT_ETYPE, "`then` assigns numbers");
        holds |= qdot_expr_node(s->pool, e->values.at[i])->holds & strange;
    }
    if (holds & strange)
        return qdot_fail(QDOT_EINVAL, "an event holds coordinates, velocities, "
                                      "accelerations, multipliers, t and parameters");
    if (!(holds & motion))
        return qdot_fail(QDOT_EINVAL, "nothing moves in this event");
    for (size_t i = 0; i < e->targets.n; i++)
        for (size_t k = 0; k < i; k++)
            if (e->targets.at[k] == e->targets.at[i])
                return qdot_fail(QDOT_EINVAL, "`then` gives %.100s two values",
                                 qdot_expr_symbol(s->pool, e->targets.at[i])->name);
    return QDOT_OK;
}

/* Replace an array of [n] expressions by a copy in the scene's arena. */
static qdot_status
copy_expressions(qdot_scene *s, size_t n, qdot_expr **at)
{
    qdot_expr *own = qdot_arena_take(s->texts, (n + 1) * sizeof *own);

    if (!own)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++)
        own[i] = (*at)[i];
    *at = own;
    return QDOT_OK;
}

qdot_status
qdot_scene_event(qdot_scene *s, const qdot_event *event)
{
    qdot_event own = *event;

    QDOT_TRY(qdot_scene_need_new_label(s, event->name));
    QDOT_TRY(check_event(s, event));
    QDOT_TRY(qdot_scene_copy_text(s, event->name, &own.name));
    QDOT_TRY(copy_expressions(s, own.targets.n, &own.targets.at));
    QDOT_TRY(copy_expressions(s, own.values.n, &own.values.at));
    return qdot_vec_push(&s->events, own);
}

qdot_status
qdot_event_print(const qdot_scene *s, const qdot_event *e, qdot_text *out)
{
    qdot_text_format(out, "event %s: ", e->name);
    QDOT_TRY(qdot_print(s->pool, e->left, QDOT_PLAIN, out));
    qdot_text_add(out, " = ");
    QDOT_TRY(qdot_print(s->pool, e->right, QDOT_PLAIN, out));
    qdot_text_add(out, e->way > 0 ? " rising" : e->way < 0 ? " falling" : "");
    qdot_text_add(out, e->stop ? " stop" : "");
    for (size_t i = 0; i < e->targets.n; i++) {
        qdot_text_add(out, i ? ", " : " then ");
        QDOT_TRY(qdot_print(s->pool, e->targets.at[i], QDOT_PLAIN, out));
        qdot_text_add(out, " = ");
        QDOT_TRY(qdot_print(s->pool, e->values.at[i], QDOT_PLAIN, out));
    }
    qdot_text_char(out, '\n');
    return QDOT_OK;
}
