/* saved.c -- copies of the arrays of a scene, byte by byte. */
#include "mech/scene/saved.h"

#include <string.h>

#include "base/memory.h"

static void
free_saved_arrays(qdot_scene_saved *saved)
{
    for (size_t k = 0; k < QDOT_SCENE_PARTS; k++)
        qdot_free(saved->at[k]);
    *saved = (qdot_scene_saved){0};
}

qdot_status
qdot_scene_save(qdot_scene *s, qdot_scene_saved *saved)
{
    saved->lagrangian = s->lagrangian;
    saved->higher_lagrangian = s->higher_lagrangian;
    saved->hamiltonian = s->hamiltonian;
    saved->version = s->version;
    for (size_t k = 0; k < QDOT_SCENE_PARTS; k++) {
        const qdot_scene_part part = qdot_scene_part_at(s, k);
        const size_t bytes = *part.n * part.size;

        saved->at[k] = qdot_malloc(bytes + 1);
        if (saved->at[k] == NULL) {
            free_saved_arrays(saved);
            return QDOT_ENOMEM;
        }
        if (bytes > 0)
            memcpy(saved->at[k], *(void **)part.at, bytes);
    }
    return QDOT_OK;
}

void
qdot_scene_restore(qdot_scene *s, qdot_scene_saved *saved)
{
    if (saved->at[0] == NULL)
        return;
    for (size_t k = 0; k < QDOT_SCENE_PARTS; k++) {
        const qdot_scene_part part = qdot_scene_part_at(s, k);
        const size_t bytes = *part.n * part.size;

        if (bytes > 0)
            memcpy(*(void **)part.at, saved->at[k], bytes);
    }
    s->lagrangian = saved->lagrangian;
    s->higher_lagrangian = saved->higher_lagrangian;
    s->hamiltonian = saved->hamiltonian;
    s->version = saved->version;
    free_saved_arrays(saved);
}
