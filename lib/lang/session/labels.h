/* labels.h -- the labels of a scene. */
#ifndef QDOT_LANG_LABELS_H
#define QDOT_LANG_LABELS_H

#include "base/memory.h"
#include "mech/scene/scene.h"

typedef qdot_vec(const char *) qdot_words;

/* Append the labels of particles and bodies, borrowed from the scene; fewer if memory runs out. */
void qdot_labels_add(const qdot_scene *scene, qdot_words *list);

/* Append the labels of forces, springs and other things that act, and of events. */
void qdot_labels_add_applied(const qdot_scene *scene, qdot_words *list);

/* Fail with QDOT_ENAME: "there is no particle or body `bod`", with the nearest label as a hint. */
qdot_status qdot_labels_unknown(const qdot_scene *scene, const char *what,
                                const char *label);

/* Hint at the failure that `name` is none of these: the nearest, else which there are. The status of
 * the failure. */
qdot_status qdot_labels_hint(const char *name, const qdot_words *known);

#endif
