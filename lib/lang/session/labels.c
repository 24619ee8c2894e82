/* labels.c -- the labels of particles, bodies, springs, dampers, constraints and so on in a scene. */
#include "lang/session/labels.h"

#include "base/spelling.h"
#include "base/text.h"

enum { MOST_LISTED = 8 };

static void
append_word(qdot_words *list, const char *word)
{
    if (word != NULL)
        (void)qdot_vec_push(list, word); /* if memory runs out the hint lacks this word */
}

void
qdot_labels_add(const qdot_scene *s, qdot_words *list)
{
    for (size_t i = 0; i < s->particles.n; i++)
        append_word(list, s->particles.at[i].name);
    for (size_t i = 0; i < s->bodies.n; i++)
        append_word(list, s->bodies.at[i].name);
    for (size_t i = 0; i < s->springs.n; i++)
        append_word(list, s->springs.at[i].name);
    for (size_t i = 0; i < s->dampers.n; i++)
        append_word(list, s->dampers.at[i].name);
    for (size_t i = 0; i < s->constraints.n; i++)
        append_word(list, s->constraints.at[i].label);
}

void
qdot_labels_add_applied(const qdot_scene *s, qdot_words *list)
{
    for (size_t i = 0; i < s->gravities.n; i++)
        append_word(list, s->gravities.at[i].name);
    for (size_t i = 0; i < s->potentials.n; i++)
        append_word(list, s->potentials.at[i].name);
    for (size_t i = 0; i < s->dissipations.n; i++)
        append_word(list, s->dissipations.at[i].name);
    for (size_t i = 0; i < s->forces.n; i++)
        append_word(list, s->forces.at[i].name);
    for (size_t i = 0; i < s->torques.n; i++)
        append_word(list, s->torques.at[i].name);
    for (size_t i = 0; i < s->events.n; i++)
        append_word(list, s->events.at[i].name);
}

qdot_status
qdot_labels_hint(const char *name, const qdot_words *known)
{
    const char *nearest = qdot_spelling_nearest(name, known->n, known->at);
    qdot_text text = {0};
    qdot_status status = qdot_last_error()->status;

    if (nearest != NULL)
        return qdot_hint("did you mean `%s`?", nearest);
    for (size_t i = 0; i < known->n && i < MOST_LISTED; i++)
        qdot_text_format(&text, "%s`%.60s`", i > 0 ? ", " : "", known->at[i]);
    if (text.n > 0 && !text.failed)
        status = qdot_hint("there %s %s%s", known->n == 1 ? "is" : "are", text.at,
                           known->n > MOST_LISTED ? ", ..." : "");
    qdot_text_clear(&text);
    return status;
}

qdot_status
qdot_labels_unknown(const qdot_scene *scene, const char *what, const char *label)
{
    qdot_words list = {0};
    const char *nearest;

    qdot_fail(QDOT_ENAME, "there is no %s `%.200s`", what, label);
    qdot_labels_add(scene, &list);
    nearest = qdot_spelling_nearest(label, list.n, list.at);
    qdot_free(list.at);
    return nearest != NULL ? qdot_hint("did you mean `%s`?", nearest) : QDOT_ENAME;
}
