/* parts.c -- a table of the arrays of a scene (address, length, item size), for saving and restoring its state. */
#include "mech/scene/scene.h"

qdot_scene_part
qdot_scene_part_at(qdot_scene *s, size_t k)
{
#define PART(list) {&(list).at, &(list).n, &(list).capacity, sizeof *(list).at}
    const qdot_scene_part parts[QDOT_SCENE_PARTS] = {
        PART(s->events),     PART(s->coordinates), PART(s->particles),    PART(s->bodies),
        PART(s->gravities),  PART(s->potentials),  PART(s->springs),      PART(s->dampers),
        PART(s->dissipations), PART(s->forces),    PART(s->torques),      PART(s->constraints),
        PART(s->assumed),    PART(s->conditions),  PART(s->relations),  PART(s->states),
        PART(s->inputs),     PART(s->outputs),     PART(s->higher),      PART(s->joints),
    };
#undef PART

    return parts[k];
}
