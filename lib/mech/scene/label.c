/* label.c -- finds the items of a scene by their labels; particles and bodies by their numbers. */
#include <stddef.h>

#include "mech/scene/access.h"
#include "mech/scene/scene.h"

const qdot_particle *
qdot_scene_find_particle(const qdot_scene *s, const char *label)
{
    for (size_t i = 0; i < s->particles.n; i++)
        if (qdot_label_is(s->particles.at[i].name, label))
            return &s->particles.at[i];
    return NULL;
}

const qdot_body *
qdot_scene_find_body(const qdot_scene *s, const char *label)
{
    for (size_t i = 0; i < s->bodies.n; i++)
        if (qdot_label_is(s->bodies.at[i].name, label))
            return &s->bodies.at[i];
    return NULL;
}

qdot_massive
qdot_scene_massive(const qdot_scene *s, size_t k)
{
    if (k < s->particles.n) {
        const qdot_particle *p = &s->particles.at[k];

        return (qdot_massive){p->name, p->mass, p->position, NULL};
    }
    const qdot_body *b = &s->bodies.at[k - s->particles.n];

    return (qdot_massive){b->name, b->mass, b->position, b};
}

/* Whether an item of s->list has the label in the given field. */
#define HAS(list, field)                                                                 \
    has_label(s->list.at, s->list.n, sizeof *s->list.at,                                       \
              offsetof(__typeof__(*s->list.at), field), label)

static bool
has_label(const void *at, size_t n, size_t size, size_t offset, const char *label)
{
    for (size_t i = 0; i < n; i++)
        if (qdot_label_is(*(char *const *)((const char *)at + i * size + offset), label))
            return true;
    return false;
}

bool
qdot_scene_is_family(const qdot_scene *s, const char *label)
{
    for (size_t i = 0; i < s->particles.n; i++)
        if (qdot_is_member_of(s->particles.at[i].name, label))
            return true;
    for (size_t i = 0; i < s->bodies.n; i++)
        if (qdot_is_member_of(s->bodies.at[i].name, label))
            return true;
    return false;
}

bool
qdot_scene_has_label(const qdot_scene *s, const char *label)
{
    if (qdot_scene_find_particle(s, label) || qdot_scene_find_body(s, label))
        return true;
    return HAS(gravities, name) || HAS(potentials, name) || HAS(dissipations, name) ||
           HAS(springs, name) || HAS(dampers, name) || HAS(forces, name) ||
           HAS(torques, name) || HAS(constraints, label) || HAS(joints, name) ||
           HAS(events, name);
}

uint32_t
qdot_scene_dimension(const qdot_scene *s)
{
    if (s->particles.n)
        return qdot_mech_dimension(s->pool, s->particles.at[0].position);
    if (s->bodies.n)
        return qdot_mech_dimension(s->pool, s->bodies.at[0].position);
    if (s->gravities.n)
        return qdot_mech_dimension(s->pool, s->gravities.at[0].e);
    if (s->forces.n)
        return qdot_mech_dimension(s->pool, s->forces.at[0].point);
    if (s->springs.n)
        return qdot_mech_dimension(s->pool, s->springs.at[0].at[0]);
    if (s->dampers.n)
        return qdot_mech_dimension(s->pool, s->dampers.at[0].at[0]);
    return 0;
}

qdot_expr
qdot_scene_position(const qdot_scene *s, const char *label)
{
    const qdot_particle *p = qdot_scene_find_particle(s, label);
    const qdot_body *b = p ? NULL : qdot_scene_find_body(s, label);

    if (p)
        return p->position;
    if (b)
        return b->position;
    qdot_fail(QDOT_ENAME, "there is no particle or body %s", label ? label : "");
    return qdot_pool_fail(s->pool);
}
