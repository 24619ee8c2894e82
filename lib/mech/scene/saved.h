/* saved.h -- the state of a scene, while other expressions stand in its arrays.
 *
 * What events own (`targets`, `values`) is not in it.
 *
 * Tests  tests/script/sweeps/loops-over-declared.lag, far.lag
 */
#ifndef QDOT_MECH_SAVED_H
#define QDOT_MECH_SAVED_H

#include "mech/scene/scene.h"

typedef struct {
    unsigned char *at[QDOT_SCENE_PARTS];
    qdot_expr lagrangian, higher_lagrangian, hamiltonian;
    uint64_t version;
} qdot_scene_saved;

/* Save the declarations, into {0}; restore them, which also frees the copy. Restoring without a
 * copy does nothing. */
QDOT_MUST_CHECK qdot_status qdot_scene_save(qdot_scene *s, qdot_scene_saved *saved);
void qdot_scene_restore(qdot_scene *s, qdot_scene_saved *saved);

#endif
