/* labels.c -- the labels of a scene's things with mass, springs, dampers and constraints. */
#include "lang/session/labels.h"

#include "base/spelling.h"

static void
add(qdot_words *list, const char *word)
{
    if (word != NULL)
        (void)qdot_vec_push(list, word); /* a hint less, if there is no memory */
}

void
qdot_labels_add(const qdot_scene *s, qdot_words *list)
{
    for (size_t i = 0; i < s->particles.n; i++)
        add(list, s->particles.at[i].name);
    for (size_t i = 0; i < s->bodies.n; i++)
        add(list, s->bodies.at[i].name);
    for (size_t i = 0; i < s->springs.n; i++)
        add(list, s->springs.at[i].name);
    for (size_t i = 0; i < s->dampers.n; i++)
        add(list, s->dampers.at[i].name);
    for (size_t i = 0; i < s->constraints.n; i++)
        add(list, s->constraints.at[i].label);
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
