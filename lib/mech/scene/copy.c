/* copy.c -- copies the masses and forces of a scene into another one. */
#include "mech/scene/scene.h"

static qdot_status
copy_spring_or_damper(qdot_scene *to, const qdot_link *link, bool damper)
{
    qdot_link copy = *link;

    return damper ? qdot_scene_damper(to, &copy) : qdot_scene_spring(to, &copy);
}

static qdot_status
copy_term(qdot_scene *to, qdot_scene_kind kind, const qdot_term *term)
{
    return qdot_scene_term(to, kind, term->name, term->e);
}

qdot_status
qdot_scene_copy_things(const qdot_scene *s, qdot_scene *to)
{
    QDOT_TRY(qdot_higher_refuse(s, "other coordinates"));
    for (size_t i = 0; i < s->particles.n; i++)
        QDOT_TRY(qdot_scene_particle(to, s->particles.at[i].name, s->particles.at[i].mass,
                                     s->particles.at[i].position));
    for (size_t i = 0; i < s->bodies.n; i++)
        QDOT_TRY(qdot_scene_body(to, s->bodies.at[i].name, &s->bodies.at[i], QDOT_NIL));
    for (size_t i = 0; i < s->gravities.n; i++)
        QDOT_TRY(copy_term(to, QDOT_GRAVITY, &s->gravities.at[i]));
    for (size_t i = 0; i < s->potentials.n; i++)
        QDOT_TRY(copy_term(to, QDOT_POTENTIAL, &s->potentials.at[i]));
    for (size_t i = 0; i < s->springs.n; i++)
        QDOT_TRY(copy_spring_or_damper(to, &s->springs.at[i], false));
    for (size_t i = 0; i < s->dampers.n; i++)
        QDOT_TRY(copy_spring_or_damper(to, &s->dampers.at[i], true));
    for (size_t i = 0; i < s->dissipations.n; i++)
        QDOT_TRY(copy_term(to, QDOT_DISSIPATION, &s->dissipations.at[i]));
    for (size_t i = 0; i < s->forces.n; i++)
        QDOT_TRY(qdot_scene_force(to, &s->forces.at[i]));
    for (size_t i = 0; i < s->torques.n; i++)
        QDOT_TRY(qdot_scene_torque(to, &s->torques.at[i]));
    for (size_t i = 0; i < s->states.n; i++) {
        QDOT_TRY(qdot_vec_push(&to->states, s->states.at[i]));
        qdot_scene_changed(to);
    }
    if (s->lagrangian != QDOT_NIL)
        QDOT_TRY(qdot_scene_lagrangian(to, s->lagrangian));
    return QDOT_OK;
}
