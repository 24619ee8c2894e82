/* access.h -- helper functions for reading a scene, used throughout mech/. Internal to mech/. */
#ifndef QDOT_MECH_ACCESS_H
#define QDOT_MECH_ACCESS_H

#include <string.h>

#include "base/text.h"
#include "mech/scene/things.h"

/* Whether two labels are equal; NULL means no label, which equals nothing. */
static inline bool
qdot_label_is(const char *a, const char *b)
{
    return a && b && strcmp(a, b) == 0;
}

/* Fail with a status and a message, and record the failure in the pool; gives nil. */
#define qdot_mech_fail(s, ...) (qdot_fail(__VA_ARGS__), qdot_pool_fail((s)->pool))
uint32_t qdot_mech_holds(const qdot_scene *s, qdot_expr e);
/* The number of components of r: 1 for a scalar, the size of a VEC, 0 for anything else; component
 * d; the dot product. */
uint32_t qdot_mech_dimension(const qdot_pool *pool, qdot_expr r);
qdot_expr qdot_mech_component(const qdot_pool *pool, qdot_expr r, uint32_t d);
qdot_expr qdot_mech_dot(qdot_pool *pool, qdot_expr a, qdot_expr b); /* scalar product; of two scalars their product */
/* The expression e simplified with the facts of the scene; e itself if it has too many operations. */
qdot_expr qdot_mech_tidy(qdot_scene *s, qdot_expr e);
/* A sum of simplified parts, simplified as a whole if it is short; otherwise unchanged. */
qdot_expr qdot_mech_tidy_whole(qdot_scene *s, qdot_expr e);
/* The symbol of coordinate i (order 0), its velocity (1) or its acceleration (2). */
qdot_expr qdot_mech_jet(qdot_scene *s, size_t i, uint32_t order);
/* Find the index of a coordinate in the scene; if there is none fail with QDOT_ENAME and return false. */
bool qdot_mech_index(qdot_scene *s, qdot_expr q, size_t *i);
/* The LIST of the values of(s, q), one for each of the first n coordinates q. */
qdot_expr qdot_mech_each(qdot_scene *s, size_t n, qdot_expr (*of)(qdot_scene *s, qdot_expr q));
/* The expression e with every acceleration set to 0. */
qdot_expr qdot_mech_at_rest(qdot_scene *s, qdot_expr e);
bool qdot_mech_stated(const qdot_scene *s);
/* Record QDOT_EINVAL in the pool unless the scene has T and V. */
bool qdot_mech_needs_particles(qdot_scene *s, const char *what);
/* Dimension of the scene's space: 1, 2, 3; 0 while no declaration determines it. */
uint32_t qdot_scene_dimension(const qdot_scene *s);
void qdot_scene_forget_dropped(qdot_scene *s);
QDOT_MUST_CHECK qdot_status qdot_scene_drop(qdot_scene *s, const char *kind,
                                            const char *name);
/* Copy a text so that the copy lives as long as the scene; *copy is NULL for NULL. */
QDOT_MUST_CHECK qdot_status qdot_scene_copy_text(qdot_scene *s, const char *text, char **copy);
/* Index among the torques of the k-th of a kind (QDOT_TORQUE, or QDOT_FORCE beyond the forces).
 *  */
size_t qdot_scene_torque_at(const qdot_scene *s, qdot_scene_kind kind, size_t k);
QDOT_MUST_CHECK qdot_status qdot_event_print(const qdot_scene *s, const qdot_event *e,
                                             qdot_text *out);

#endif
