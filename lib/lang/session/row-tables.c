/* row-tables.c -- the tables of rows that a session keeps by name. */
#include "lang/session/row-tables.h"

#include <stdio.h>
#include <string.h>

#include "expr/node.h"
#include "expr/symbol.h"
#include "lang/session/bind.h"
#include "lang/session/names.h"
#include "lang/session/trial.h"
#include "lang/session/values.h"

/* The index of the table with the given name; the number of tables if there is none. */
static size_t
index_of_table(const qdot_session *session, const char *name)
{
    size_t i = 0;

    while (i < session->tables->n && strcmp(session->tables->at[i]->name, name) != 0)
        i++;
    return i;
}

bool
qdot_row_tables_drop(qdot_session *session, const char *name)
{
    qdot_row_table_list *tables = session->tables;
    const size_t i = index_of_table(session, name);

    if (i == tables->n)
        return false;
    qdot_row_table_release(tables->at[i]);
    memmove(&tables->at[i], &tables->at[i + 1], (tables->n - i - 1) * sizeof *tables->at);
    tables->n--;
    return true;
}

qdot_status
qdot_row_tables_keep(qdot_session *session, qdot_row_table *table)
{
    qdot_status status;

    (void)qdot_row_tables_drop(session, table->name);
    status = qdot_vec_push(session->tables, table);
    if (status != QDOT_OK)
        qdot_row_table_release(table);
    return status;
}

qdot_row_table *
qdot_row_tables_find(const qdot_session *session, const char *name)
{
    const size_t i = index_of_table(session, name);

    return i < session->tables->n ? session->tables->at[i] : NULL;
}

void
qdot_row_tables_next_name(const qdot_session *session, char *name, size_t size)
{
    size_t k = session->tables->n;

    do
        snprintf(name, size, "sweep%zu", ++k);
    while (qdot_row_tables_find(session, name) != NULL);
}

static qdot_status
record_parameter(qdot_row_table *t, const char *name, double value)
{
    const size_t n = t->n_parameters + 1;
    char **names = qdot_realloc(t->parameters, n * sizeof *names);
    double *values;

    t->parameters = names ? names : t->parameters;
    values = qdot_realloc(t->parameter_values, n * sizeof *values);
    t->parameter_values = values ? values : t->parameter_values;
    if (!names || !values)
        return QDOT_ENOMEM;
    names[n - 1] = qdot_strdup(name);
    if (names[n - 1] == NULL)
        return QDOT_ENOMEM;
    values[n - 1] = value;
    t->n_parameters = n;
    return QDOT_OK;
}

/* Set the symbols open [n] to themselves, so that values that depend on them can be recognised. */
static void
set_to_themselves(qdot_session *session, size_t n, const qdot_expr *open)
{
    for (size_t i = 0; i < session->values->set_symbols.n; i++)
        for (size_t k = 0; k < n; k++)
            if (session->values->set_symbols.at[i] == open[k])
                session->values->set_values.at[i] = open[k];
}

qdot_status
qdot_row_tables_note_parameters(qdot_session *session, qdot_row_table *table, size_t n,
                                const qdot_expr *open)
{
    const uint32_t varies = ~(uint32_t)QDOT_HAS_FUN;
    const qdot_name *name;
    qdot_trial trial;
    qdot_status status = QDOT_OK;

    QDOT_TRY(qdot_trial_begin(&trial, session));
    set_to_themselves(session, n, open);
    for (size_t i = 0; (name = qdot_names_at(session->names, i)) != NULL && status == QDOT_OK; i++) {
        qdot_expr value;
        double x;

        if (name->kind != QDOT_NAME_PARAM)
            continue;
        value = qdot_session_bind(session, name->value);
        status = qdot_pool_check(session->pool);
        if (qdot_grave(status) == QDOT_OK && status != QDOT_OK) { /* skip a parameter that has no value */
            status = QDOT_OK;
            continue;
        }
        if (status != QDOT_OK || (qdot_expr_node(session->pool, value)->holds & varies) != 0)
            continue;
        status = qdot_session_number(session, value, &x, NULL);
        if (status == QDOT_OK)
            status = record_parameter(table, name->name, x);
        else
            status = qdot_grave(status);
    }
    qdot_trial_end(&trial);
    return status;
}
