/* row-tables.c -- tables of rows that a session keeps by name. */
#include "lang/session/row-tables.h"

#include <stdio.h>
#include <string.h>

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
