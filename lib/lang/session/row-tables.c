/* row-tables.c -- tables of rows that a session keeps by name. */
#include "lang/session/row-tables.h"

#include <stdio.h>
#include <string.h>

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

/* The index of that name; the number of tables: there is none. */
static size_t
index_of(const qdot_session *session, const char *name)
{
    size_t i = 0;

    while (i < session->tables.n && strcmp(session->tables.at[i]->name, name) != 0)
        i++;
    return i;
}

qdot_status
qdot_row_tables_keep(qdot_session *session, qdot_row_table *table)
{
    const size_t old = index_of(session, table->name);
    qdot_status status;

    if (old < session->tables.n) {
        qdot_row_table_release(session->tables.at[old]);
        memmove(&session->tables.at[old], &session->tables.at[old + 1],
                (session->tables.n - old - 1) * sizeof *session->tables.at);
        session->tables.n--;
    }
    status = qdot_vec_push(&session->tables, table);
    if (status != QDOT_OK)
        qdot_row_table_release(table);
    return status;
}

qdot_row_table *
qdot_row_tables_find(const qdot_session *session, const char *name)
{
    const size_t i = index_of(session, name);

    return i < session->tables.n ? session->tables.at[i] : NULL;
}

void
qdot_row_tables_next_name(const qdot_session *session, char *name, size_t size)
{
    size_t k = session->tables.n;

    do
        snprintf(name, size, "sweep%zu", ++k);
    while (qdot_row_tables_find(session, name) != NULL);
}
