/* row-table.c -- rows of numbers of many runs. */
#include "lang/session/row-table.h"

#include "base/memory.h"

qdot_row_table *
qdot_row_table_new(const char *name, size_t n_swept, size_t n, const char *const *labels,
                   size_t most)
{
    qdot_row_table *t = qdot_calloc(1, sizeof *t);
    bool good;

    if (t == NULL)
        return NULL;
    t->uses = 1;
    t->n = n;
    t->n_swept = n_swept;
    t->name = qdot_strdup(name);
    t->labels = qdot_calloc(n + 1, sizeof *t->labels);
    t->values = qdot_calloc(most * n + 1, sizeof *t->values);
    t->errors = qdot_calloc(most * n + 1, sizeof *t->errors);
    t->reasons = qdot_calloc(most + 1, sizeof *t->reasons);
    good = t->name && t->labels && t->values && t->errors && t->reasons;
    for (size_t i = 0; i < n && good; i++) {
        t->labels[i] = qdot_strdup(labels[i]);
        good = t->labels[i] != NULL;
    }
    if (good)
        return t;
    qdot_row_table_release(t);
    return NULL;
}

void
qdot_row_table_release(qdot_row_table *t)
{
    if (t == NULL || --t->uses > 0)
        return;
    for (size_t i = 0; t->labels != NULL && i < t->n; i++)
        qdot_free(t->labels[i]);
    for (size_t i = 0; t->reasons != NULL && i < t->rows; i++)
        qdot_free(t->reasons[i]);
    qdot_free(t->name);
    qdot_free(t->labels);
    qdot_free(t->values);
    qdot_free(t->errors);
    qdot_free(t->reasons);
    qdot_free(t);
}
