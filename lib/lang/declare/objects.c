/* objects.c -- reads operands that several statements share, about particles, bodies, springs ... */
#include "lang/declare/objects.h"

#include "lang/commands/warnings.h"
#include "lang/session/labels.h"

qdot_status
qdot_object_label(qdot_record *r, const char **label)
{
    const qdot_filled *name = qdot_record_hole(r, NULL, "NAME");

    *label = NULL;
    return name != NULL ? qdot_record_name(r, name, label) : QDOT_OK;
}

qdot_status
qdot_object_term(qdot_record *r, const qdot_filled *term, qdot_scene_kind kind)
{
    qdot_scene *scene = r->cursor.session->scene;
    const char *label;
    qdot_expr e;

    QDOT_TRY(qdot_object_label(r, &label));
    QDOT_TRY(qdot_record_scalar(r, term, &e));
    if (label != NULL && qdot_scene_has_label(scene, label))
        r->cursor.error_at = r->start->start;
    else
        qdot_record_blame(r, term);
    QDOT_TRY(qdot_scene_term(scene, kind, label, e));
    return qdot_warnings_twice(r->cursor.session, kind);
}

qdot_status
qdot_object_particle_or_body(qdot_record *r, const qdot_filled *place, size_t k, char **label)
{
    const qdot_session *session = r->cursor.session;
    const char *name;

    *label = NULL;
    QDOT_TRY(qdot_record_bare_name(r, place, k, &name));
    if (name != NULL && qdot_names_find(session->names, name) == NULL &&
        (qdot_scene_find_particle(session->scene, name) != NULL ||
         qdot_scene_find_body(session->scene, name) != NULL))
        *label = (char *)name;
    return QDOT_OK;
}

qdot_status
qdot_object_ends(qdot_record *r, qdot_link *link)
{
    const qdot_filled *end = qdot_record_hole(r, "between", "A");
    const char *name;

    QDOT_TRY(qdot_object_label(r, &name));
    link->name = (char *)name;
    for (int i = 0; i < 2; i++, end = qdot_record_hole(r, "between", "B")) {
        QDOT_TRY(qdot_record_point(r, end, &link->at[i]));
        QDOT_TRY(qdot_object_particle_or_body(r, end, 0, &link->end[i]));
    }
    return QDOT_OK;
}

qdot_status
qdot_object_target(qdot_record *r, const qdot_filled *on, bool label_first, qdot_expr *coordinate,
                   const char **label)
{
    qdot_session *session = r->cursor.session;
    const qdot_name *known;
    const char *name, *nearest;
    qdot_words words = {0};
    bool labelled;

    *coordinate = QDOT_NIL;
    *label = NULL;
    QDOT_TRY(qdot_record_name(r, on, &name));
    known = qdot_names_find(session->names, name);
    labelled = qdot_scene_find_particle(session->scene, name) != NULL ||
               qdot_scene_find_body(session->scene, name) != NULL;
    if (known != NULL && known->kind == QDOT_NAME_COORD && !(labelled && label_first)) {
        *coordinate = known->value;
        return QDOT_OK;
    }
    if (labelled) {
        *label = name;
        return QDOT_OK;
    }
    qdot_record_blame(r, on);
    (void)qdot_fail(QDOT_ENAME, "there is no coordinate, particle or body `%s`", name);
    qdot_labels_add(session->scene, &words);
    nearest = qdot_names_nearest(session->names, name, words.n, words.at);
    qdot_free(words.at);
    return nearest != NULL ? qdot_hint("did you mean `%s`?", nearest)
                           : qdot_hint("`coord %.60s` declares a coordinate, "
                                       "`particle %.60s mass m at (x, y)` a particle",
                                       name, name);
}
