/* remove.c -- removes items of a scene by their labels, with the forces that act on them. */
#include <string.h>

#include "mech/scene/access.h"
#include "mech/scene/scene.h"

qdot_status
qdot_scene_drop(qdot_scene *s, const char *kind, const char *name)
{
    qdot_text text = {0};
    char *copy;
    qdot_status status;

    qdot_text_add(&text, kind);
    qdot_text_add(&text, name ? name : "");
    status = qdot_text_status(&text);
    copy = status == QDOT_OK ? qdot_strdup(qdot_text_str(&text)) : NULL;
    qdot_text_clear(&text);
    if (!copy)
        return QDOT_ENOMEM;
    if (qdot_vec_push(&s->dropped, copy) == QDOT_OK)
        return QDOT_OK;
    qdot_free(copy);
    return QDOT_ENOMEM;
}

static bool
is_attached_to(const qdot_link *link, const char *label)
{
    return qdot_label_is(link->end[0], label) || qdot_label_is(link->end[1], label);
}

/* Whether a torque acts on the body with the given index (-1: none). */
static bool
acts_on_body(const qdot_torque *torque, int body)
{
    return body >= 0 && torque->coordinate == QDOT_NIL && torque->body == body;
}

/* Remove from a list the items for which the condition `gone` is true. */
#define FILTER(list, item, gone)                                                         \
    do {                                                                                 \
        size_t kept_ = 0;                                                                \
        for (size_t i_ = 0; i_ < (list).n; i_++) {                                       \
            __typeof__((list).at) item = &(list).at[i_];                                 \
            if (gone) {                                                                  \
                found = true;                                                            \
            } else {                                                                     \
                (list).at[kept_++] = *item;                                              \
            }                                                                            \
        }                                                                                \
        (list).n = kept_;                                                                \
    } while (0)

/* Record the items of a list for which `goes` is true, by names such as "spring s1" or "a spring", for a notice. */
#define DROP(list, what, item, goes)                                                     \
    do {                                                                                 \
        for (size_t i_ = 0; i_ < (list).n; i_++) {                                       \
            __typeof__((list).at) item = &(list).at[i_];                                 \
            if (goes)                                                                    \
                QDOT_TRY(item->name ? qdot_scene_drop(s, what " ", item->name)           \
                                    : qdot_scene_drop(s, "a " what, NULL));              \
        }                                                                                \
    } while (0)

/* Record what acts on the thing to be removed; called before anything is removed. */
static qdot_status
record_dependents(qdot_scene *s, const char *label, int body)
{
    DROP(s->springs, "spring", p, is_attached_to(p, label));
    DROP(s->dampers, "damper", p, is_attached_to(p, label));
    DROP(s->forces, "force", p, qdot_label_is(p->on, label));
    DROP(s->torques, "torque", p, acts_on_body(p, body));
    return QDOT_OK;
}

qdot_status
qdot_scene_remove(qdot_scene *s, const char *label)
{
    const qdot_body *b = qdot_scene_find_body(s, label);
    int body = b ? (int)(b - s->bodies.at) : -1;
    bool found = false, on_thing = b || qdot_scene_find_particle(s, label);

    qdot_scene_forget_dropped(s);
    if (qdot_scene_find_event(s, label)) { /* events do not affect the mechanics: removing one leaves derived results valid */
        FILTER(s->events, p, qdot_label_is(p->name, label));
        return found ? QDOT_OK : QDOT_EFAILED;
    }
    if (!qdot_scene_has_label(s, label))
        return qdot_fail(QDOT_ENAME, "nothing in the scene is labelled %s", label);
    if (on_thing)
        QDOT_TRY(record_dependents(s, label, body));
    FILTER(s->particles, p, qdot_label_is(p->name, label));
    FILTER(s->bodies, p, qdot_label_is(p->name, label));
    FILTER(s->springs, p, qdot_label_is(p->name, label) || (on_thing && is_attached_to(p, label)));
    FILTER(s->dampers, p, qdot_label_is(p->name, label) || (on_thing && is_attached_to(p, label)));
    FILTER(s->forces, p, qdot_label_is(p->name, label) || (on_thing && qdot_label_is(p->on, label)));
    FILTER(s->torques, p, qdot_label_is(p->name, label) || acts_on_body(p, body));
    for (size_t i = 0; body >= 0 && i < s->torques.n; i++)
        s->torques.at[i].body -= s->torques.at[i].body > body;
    FILTER(s->gravities, p, qdot_label_is(p->name, label));
    FILTER(s->potentials, p, qdot_label_is(p->name, label));
    FILTER(s->dissipations, p, qdot_label_is(p->name, label));
    FILTER(s->constraints, p, qdot_label_is(p->label, label));
    qdot_scene_changed(s);
    return found ? QDOT_OK : qdot_fail(QDOT_ENAME, "nothing is labelled %s", label);
}
