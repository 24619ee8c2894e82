/* complete.c -- completions of a word. */
#include "lang/commands/complete.h"

#include <stdlib.h>
#include <string.h>

#include "lang/commands/statement.h"
#include "lang/functions/builtin.h"
#include "lang/functions/quantity.h"
#include "lang/session/labels.h"

typedef struct {
    const char *prefix;
    qdot_vec(char *) words;
    qdot_status status;
} completion;

static void
offer(completion *c, const char *word)
{
    char *copy;

    if (c->status != QDOT_OK || strncmp(word, c->prefix, strlen(c->prefix)) != 0)
        return;
    copy = qdot_strdup(word);
    c->status = copy == NULL ? QDOT_ENOMEM : qdot_vec_push(&c->words, copy);
}

static int
by_spelling(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static void
offer_labels(completion *c, const qdot_scene *scene)
{
    qdot_words labels = {0};

    qdot_labels_add(scene, &labels);
    for (size_t i = 0; i < labels.n; i++)
        offer(c, labels.at[i]);
    qdot_free(labels.at);
#define OFFER(list)                                                                      \
    for (size_t i = 0; i < scene->list.n; i++)                                           \
        if (scene->list.at[i].name != NULL)                                              \
            offer(c, scene->list.at[i].name);
    OFFER(gravities)
    OFFER(potentials)
    OFFER(dissipations)
    OFFER(forces)
    OFFER(torques)
    OFFER(events)
#undef OFFER
}

qdot_status
qdot_complete(qdot_session *session, const char *prefix, char ***words, size_t *n)
{
    completion c = {.prefix = prefix};
    size_t kept = 0;

    for (size_t i = 0; qdot_statement_at(i) != NULL; i++)
        offer(&c, qdot_statement_at(i)->word);
    for (size_t i = 0; qdot_builtin_at(i) != NULL; i++)
        offer(&c, qdot_builtin_at(i)->name);
    for (size_t i = 0; qdot_quantity_at(i) != NULL; i++)
        offer(&c, qdot_quantity_at(i)->name);
    for (int i = 0; i < QDOT_FUNCTION_COUNT; i++)
        offer(&c, qdot_fun_name((qdot_fun_id)i));
    for (size_t i = 0; qdot_names_at(session->names, i) != NULL; i++)
        offer(&c, qdot_names_at(session->names, i)->name);
    offer_labels(&c, session->scene);
    for (size_t i = 0; i < session->runs.n; i++)
        offer(&c, session->runs.at[i].name);

    if (c.words.n > 0)
        qsort(c.words.at, c.words.n, sizeof *c.words.at, by_spelling);
    for (size_t i = 0; i < c.words.n; i++) {
        if (kept > 0 && strcmp(c.words.at[kept - 1], c.words.at[i]) == 0)
            qdot_free(c.words.at[i]);
        else
            c.words.at[kept++] = c.words.at[i];
    }
    *words = c.words.at;
    *n = kept;
    if (c.status != QDOT_OK) {
        while (kept > 0)
            qdot_free(c.words.at[--kept]);
        qdot_free(c.words.at);
        *words = NULL;
        *n = 0;
    }
    return c.status;
}
