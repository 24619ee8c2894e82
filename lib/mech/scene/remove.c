/* remove.c -- removes items of a scene by their labels, with the forces that act on them, and states. */
#include <ctype.h>
#include <string.h>

#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/scene/access.h"
#include "mech/scene/body-joint.h"
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

static bool
is_joined_to(const qdot_body_joint *joint, const char *label)
{
    return qdot_label_is(joint->end[0], label) || qdot_label_is(joint->end[1], label);
}

/* Whether the constraint is one of a joint of the body with that label. */
static bool
is_of_joint_of(const qdot_scene *s, const qdot_constraint *c, const char *label)
{
    const qdot_body_joint *joint = qdot_scene_find_joint(s, c->label);

    return joint && is_joined_to(joint, label);
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
    DROP(s->joints, "joint", p, is_joined_to(p, label));
    return QDOT_OK;
}

/* --- what is read by others ------------------------------------------------------------ */

/* Whether a declaration holds the name, with no letter, digit or _ next to it. */
static bool
holds_name(const char *text, const char *name)
{
    const size_t n = strlen(name);

    for (const char *at = strstr(text, name); at; at = strstr(at + 1, name))
        if ((at == text || !(isalnum((unsigned char)at[-1]) || at[-1] == '_')) && !(isalnum((unsigned char)at[n]) || at[n] == '_'))
            return true;
    return false;
}

/* Append the first declaration that reads the state or multiplier, as it would be typed; nothing: none was found. */
static qdot_status
print_reader(const qdot_scene *s, const char *name, qdot_text *out)
{
    qdot_text all = {0};
    qdot_status status = QDOT_OK;

    for (size_t k = 0; k < s->states.n && out->n == 0 && status == QDOT_OK; k++) { /* each by itself */
        qdot_text_clear(&all);
        status = qdot_scene_print_state(s, s->states.at[k].z, &all);
        if (holds_name(qdot_text_str(&all), name))
            qdot_text_add(out, qdot_text_str(&all));
    }
    qdot_text_clear(&all);
    if (status == QDOT_OK)
        status = qdot_scene_print_things(s, &all);
    for (char *line = all.at, *end; status == QDOT_OK && out->n == 0 && line && *line; line = end + 1) {
        end = line + strcspn(line, "\n");
        *end = '\0';
        if (holds_name(line, name) && strncmp(line, "state ", 6) != 0)
            qdot_text_add(out, line);
    }
    qdot_text_clear(&all);
    return status == QDOT_OK ? qdot_text_status(out) : status;
}

/* The label in a printed declaration: "push" of "force push: -z on p", "w" of "state w' = z"; *length 0: it has none. */
static const char *
label_in(const char *reader, size_t *length)
{
    const char *label = reader + strcspn(reader, " ");

    label += *label == ' ';
    *length = strcspn(label, " :'");
    if (label[*length] != ':' && strncmp(reader, "state ", 6) != 0 && strncmp(reader, "particle ", 9) != 0 &&
        strncmp(reader, "body ", 5) != 0)
        *length = 0;
    return label;
}

/* Fail because the scene reads a state or multiplier, with the declaration that does. */
static qdot_status
refuse_removal(const qdot_scene *s, const char *name)
{
    enum { LONGEST = 200 };
    qdot_text reader = {0};
    qdot_status status = print_reader(s, name, &reader);
    size_t length;
    const char *label = label_in(qdot_text_str(&reader), &length);

    if (status == QDOT_OK)
        status = qdot_fail(QDOT_EINVAL, "%s is read by `%.*s%s`", name, LONGEST, reader.n ? qdot_text_str(&reader) : "the scene",
                           reader.n > LONGEST ? "..." : "");
    if (status == QDOT_EINVAL)
        status = length > 0 ? qdot_hint("`remove %.*s` first", (int)length, label)
                            : qdot_hint("take that out first; `undo` takes back the statements since");
    qdot_text_clear(&reader);
    return status;
}

/* Whether a force, torque or dissipation that is not removed with `label` holds x. `on_thing`: label is that of a particle
 * or body, `body` the latter's index. */
static bool
is_held_by_what_stays(const qdot_scene *s, qdot_expr x, const char *label, bool on_thing, int body)
{
    bool held = false;

    for (size_t i = 0; i < s->forces.n; i++) {
        const qdot_force *f = &s->forces.at[i];

        held = held || (!(on_thing && qdot_label_is(f->on, label)) && qdot_expr_contains(s->pool, f->force, x));
    }
    for (size_t i = 0; i < s->torques.n; i++)
        held = held || (!acts_on_body(&s->torques.at[i], body) && qdot_expr_contains(s->pool, s->torques.at[i].torque, x));
    for (size_t i = 0; i < s->dissipations.n; i++)
        held = held || qdot_expr_contains(s->pool, s->dissipations.at[i].e, x);
    return held;
}

/* Whether a constraint goes with `label`. */
static bool
goes_with(const qdot_scene *s, const qdot_constraint *c, const char *label, int body)
{
    return qdot_label_is(c->label, label) || (body >= 0 && is_of_joint_of(s, c, label));
}

/* Fail if the multiplier of a constraint that goes with `label` is read by what stays. */
static qdot_status
check_multipliers(const qdot_scene *s, const char *label, bool on_thing, int body)
{
    qdot_text name = {0};
    qdot_status status = QDOT_OK;

    for (size_t k = 0; k < s->constraints.n && status == QDOT_OK; k++) {
        const qdot_constraint *c = &s->constraints.at[k];

        if (!goes_with(s, c, label, body) || !is_held_by_what_stays(s, c->multiplier, label, on_thing, body))
            continue;
        status = qdot_print(s->pool, c->multiplier, QDOT_PLAIN, &name);
        if (status == QDOT_OK)
            status = refuse_removal(s, qdot_text_str(&name));
    }
    qdot_text_clear(&name);
    return status;
}

/* --- things ------------------------------------------------------------------------------ */

qdot_status
qdot_scene_remove(qdot_scene *s, const char *label)
{
    const qdot_body *b = qdot_scene_find_body(s, label);
    int body = b ? (int)(b - s->bodies.at) : -1;
    const qdot_body_joint *joint;
    bool found = false, on_thing = b || qdot_scene_find_particle(s, label);

    qdot_scene_forget_dropped(s);
    if (qdot_scene_find_event(s, label)) { /* events do not affect the mechanics: removing one leaves derived results valid */
        FILTER(s->events, p, qdot_label_is(p->name, label));
        return found ? QDOT_OK : QDOT_EFAILED;
    }
    joint = qdot_scene_find_joint(s, label);
    if (joint && joint->places) {
        qdot_fail(QDOT_EINVAL, "joint %s has placed %s, which keeps its place", label, joint->end[1]);
        return qdot_hint("`remove %.60s` takes the body with it; `undo` takes back the statements since", joint->end[1]);
    }
    if (!qdot_scene_has_label(s, label))
        return qdot_fail(QDOT_ENAME, "nothing in the scene is labelled %s", label);
    QDOT_TRY(check_multipliers(s, label, on_thing, body));
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
    FILTER(s->constraints, p, goes_with(s, p, label, body));
    FILTER(s->joints, p, qdot_label_is(p->name, label) || (body >= 0 && is_joined_to(p, label)));
    qdot_scene_changed(s);
    return found ? QDOT_OK : qdot_fail(QDOT_ENAME, "nothing is labelled %s", label);
}

/* --- states ---------------------------------------------------------------------------- */

qdot_status
qdot_scene_remove_state(qdot_scene *s, qdot_expr z)
{
    const size_t i = qdot_expr_place(s->coordinates.n, s->coordinates.at, z);
    const char *name = qdot_expr_symbol(s->pool, z)->name;
    qdot_state gone;
    size_t k = 0;

    while (k < s->states.n && s->states.at[k].z != z)
        k++;
    if (k == s->states.n || i == s->coordinates.n)
        return qdot_fail(QDOT_ENAME, "%s is no state", name);
    qdot_scene_forget_dropped(s);
    gone = s->states.at[k];
    memmove(&s->states.at[k], &s->states.at[k + 1], (s->states.n - k - 1) * sizeof gone);
    s->states.n--;
    if (qdot_scene_reads(s, z)) { /* its own rate may read it */
        const qdot_status status = refuse_removal(s, name);

        memmove(&s->states.at[k + 1], &s->states.at[k], (s->states.n - k) * sizeof gone);
        s->states.at[k] = gone;
        s->states.n++;
        return status;
    }
    QDOT_TRY(qdot_pool_check(s->pool));
    memmove(&s->coordinates.at[i], &s->coordinates.at[i + 1], (s->coordinates.n - i - 1) * sizeof z);
    s->coordinates.n--;
    qdot_scene_changed(s);
    return QDOT_OK;
}
