/* kind.c -- items of a scene without a label: counted, compared, removed by number. */
#include <string.h>

#include "mech/scene/access.h"
#include "mech/scene/scene.h"

/* The k-th torque that was declared with `force`, or with `torque`; the number of torques where
 * there are not as many. */
static size_t
find_torque_or_force(const qdot_scene *s, bool force, size_t k)
{
    size_t i = 0;

    for (; i < s->torques.n; i++)
        if (s->torques.at[i].force == force && k-- == 0)
            return i;
    return i;
}

size_t
qdot_scene_torque_at(const qdot_scene *s, qdot_scene_kind kind, size_t k)
{
    return kind == QDOT_TORQUE ? find_torque_or_force(s, false, k)
                               : find_torque_or_force(s, true, k - s->forces.n);
}

size_t
qdot_scene_count(const qdot_scene *s, qdot_scene_kind kind)
{
    size_t with_force = 0;

    for (size_t i = 0; i < s->torques.n; i++)
        with_force += s->torques.at[i].force;
    switch (kind) {
    case QDOT_GRAVITY: return s->gravities.n;
    case QDOT_POTENTIAL: return s->potentials.n;
    case QDOT_SPRING: return s->springs.n;
    case QDOT_DAMPER: return s->dampers.n;
    case QDOT_DISSIPATION: return s->dissipations.n;
    case QDOT_FORCE: return s->forces.n + with_force;
    case QDOT_TORQUE: return s->torques.n - with_force;
    }
    return 0;
}

/* Remove the item with index k from a list. */
#define TAKE(list, k)                                                                    \
    do {                                                                                 \
        memmove(&(list).at[k], &(list).at[(k) + 1],                                      \
                ((list).n - (k) - 1) * sizeof *(list).at);                               \
        (list).n--;                                                                      \
    } while (0)

qdot_status
qdot_scene_remove_at(qdot_scene *s, qdot_scene_kind kind, size_t k)
{
    size_t torque;

    qdot_scene_forget_dropped(s);
    if (k >= qdot_scene_count(s, kind))
        return qdot_fail(QDOT_EINVAL, "there is no number %zu to be removed", k + 1);
    switch (kind) {
    case QDOT_GRAVITY: TAKE(s->gravities, k); break;
    case QDOT_POTENTIAL: TAKE(s->potentials, k); break;
    case QDOT_SPRING: TAKE(s->springs, k); break;
    case QDOT_DAMPER: TAKE(s->dampers, k); break;
    case QDOT_DISSIPATION: TAKE(s->dissipations, k); break;
    case QDOT_FORCE:
        if (k < s->forces.n) {
            TAKE(s->forces, k);
            break;
        }
        /* fallthrough */
    case QDOT_TORQUE:
        torque = qdot_scene_torque_at(s, kind, k);
        TAKE(s->torques, torque);
        break;
    }
    qdot_scene_changed(s);
    return QDOT_OK;
}

/* --- equal declarations --------------------------------------------------------------- */

static bool
terms_are_equal(const qdot_term *a, const qdot_term *b)
{
    return !a->name && !b->name && a->e == b->e;
}

static bool
springs_are_equal(const qdot_link *a, const qdot_link *b)
{
    return !a->name && !b->name && a->at[0] == b->at[0] && a->at[1] == b->at[1] &&
           a->stiffness == b->stiffness && a->rest == b->rest;
}

static bool
labels_are_equal(const char *a, const char *b)
{
    return a && b ? strcmp(a, b) == 0 : a == b;
}

static bool
forces_are_equal(const qdot_force *a, const qdot_force *b)
{
    return !a->name && !b->name && a->force == b->force && a->point == b->point &&
           a->material == b->material && labels_are_equal(a->on, b->on);
}

static bool
torques_are_equal(const qdot_torque *a, const qdot_torque *b)
{
    return !a->name && !b->name && a->torque == b->torque &&
           a->coordinate == b->coordinate && a->body == b->body;
}

/* Return whether same(a, b) holds for the last item b of a list and any earlier item a. */
#define LAST_AGAIN(list, same)                                                           \
    do {                                                                                 \
        for (size_t i_ = 0; i_ + 1 < (list).n; i_++)                                     \
            if (same(&(list).at[i_], &(list).at[(list).n - 1]))                          \
                return true;                                                             \
        return false;                                                                    \
    } while (0)

bool
qdot_scene_said_twice(const qdot_scene *s, qdot_scene_kind kind)
{
    switch (kind) {
    case QDOT_GRAVITY: return false; /* a second gravity field replaces the first */
    case QDOT_POTENTIAL: LAST_AGAIN(s->potentials, terms_are_equal);
    case QDOT_SPRING: LAST_AGAIN(s->springs, springs_are_equal);
    case QDOT_DAMPER: LAST_AGAIN(s->dampers, springs_are_equal);
    case QDOT_DISSIPATION: LAST_AGAIN(s->dissipations, terms_are_equal);
    case QDOT_FORCE: LAST_AGAIN(s->forces, forces_are_equal);
    case QDOT_TORQUE: LAST_AGAIN(s->torques, torques_are_equal);
    }
    return false;
}
