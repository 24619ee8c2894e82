/* contact.c -- makes switching surfaces for events whose contacts may last (bodies that stay together). */
#include "sim/model/contact.h"

#include <stdio.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "sim/model/substitute.h"

/* Whether u depends on t with a velocity that jumps: a moving wall that would hit the body again. */
static qdot_status
has_velocity_jumps(qdot_pool *pool, qdot_expr u, bool *jerks)
{
    *jerks = false;
    if (!(qdot_expr_node(pool, u)->holds & QDOT_HAS_TIME))
        return QDOT_OK;
    QDOT_TRY(qdot_jumps(pool, u, QDOT_HAS_TIME, jerks));
    return *jerks ? QDOT_OK : qdot_jumps(pool, qdot_diff(pool, u, QDOT_T), UINT32_MAX, jerks);
}

/* Whether the contact at an event may last: it sets velocities, at most coordinates too, and u
 * depends on q and t only. */
static bool
may_contact_last(const qdot_scene *scene, const qdot_event *event, qdot_expr u)
{
    const uint32_t others = QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER;
    bool changes = false; /* the event changes some velocity; an assignment like x' = x' does not */

    if (event->stop || event->targets.n == 0
        || !(qdot_expr_node(scene->pool, u)->holds & QDOT_HAS_COORD)
        || (qdot_expr_node(scene->pool, u)->holds & others))
        return false;
    for (size_t i = 0; i < event->targets.n; i++) {
        const uint32_t holds = qdot_expr_node(scene->pool, event->targets.at[i])->holds;

        if (!(holds & (QDOT_HAS_VELOCITY | QDOT_HAS_COORD)))
            return false;
        changes |= (holds & QDOT_HAS_VELOCITY) && event->values.at[i] != event->targets.at[i];
    }
    return changes;
}

static qdot_status
append_contact_surface(qdot_switches *s, size_t event, qdot_expr u, int way)
{
    qdot_surface x = {.u = u, .contact = true, .event = event, .reaction = -way};
    char name[32];

    snprintf(name, sizeof name, "contact %zu", ++s->contacts);
    x.side = qdot_symbol_get(s->pool, QDOT_FORMAL, name);
    QDOT_TRY(qdot_pool_check(s->pool));
    return qdot_vec_push(&s->surfaces, x);
}

qdot_status
qdot_contacts_find(const qdot_scene *scene, const qdot_run_request *r, qdot_switches *s)
{
    for (size_t i = 0; i < scene->events.n && !r->lanes; i++) {
        const qdot_event *event = &scene->events.at[i];
        const qdot_expr u = qdot_substitute(
            s->pool, qdot_sub(s->pool, event->left, event->right), r->n_values, r->symbols,
            r->values);
        bool jerks;

        QDOT_TRY(qdot_pool_check(s->pool));
        if (!may_contact_last(scene, event, u))
            continue;
        QDOT_TRY(has_velocity_jumps(s->pool, u, &jerks));
        if (jerks)
            continue;
        for (int way = -1; way <= 1; way += 2)
            if (event->way == 0 || event->way == way)
                QDOT_TRY(append_contact_surface(s, i, u, way));
    }
    return QDOT_OK;
}

size_t
qdot_contacts_surface(const qdot_switches *s, size_t event, int way)
{
    for (size_t i = qdot_switches_own(s); i < s->surfaces.n; i++)
        if (s->surfaces.at[i].event == event && s->surfaces.at[i].reaction == -way)
            return i;
    return SIZE_MAX;
}

bool
qdot_contacts_moves(const qdot_switches *s, size_t surface)
{
    return (qdot_expr_node(s->pool, s->surfaces.at[surface].u)->holds & QDOT_HAS_TIME) != 0;
}
