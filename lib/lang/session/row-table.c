/* row-table.c -- a table with a row of numbers for each of many runs. */
#include "lang/session/row-table.h"

#include <math.h>

#include "base/memory.h"

qdot_row_table *
qdot_row_table_new(const char *name, size_t n_swept, size_t n, const char *const *labels)
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
    t->units = qdot_calloc(n + 1, sizeof *t->units);
    good = t->name && t->labels && t->units;
    for (size_t i = 0; i < n && good; i++) {
        t->labels[i] = qdot_strdup(labels[i]);
        good = t->labels[i] != NULL;
    }
    if (good)
        return t;
    qdot_row_table_release(t);
    return NULL;
}

qdot_status
qdot_row_table_set_unit(qdot_row_table *t, size_t i, const char *unit)
{
    qdot_free(t->units[i]);
    t->units[i] = *unit != '\0' ? qdot_strdup(unit) : NULL;
    return *unit == '\0' || t->units[i] != NULL ? QDOT_OK : QDOT_ENOMEM;
}

static qdot_status
allocate_rows(qdot_row_table *t, size_t room)
{
    double *values = qdot_realloc(t->values, room * t->n * sizeof *values), *errors;
    char **reasons;

    t->values = values ? values : t->values;
    errors = qdot_realloc(t->errors, room * t->n * sizeof *errors);
    t->errors = errors ? errors : t->errors;
    reasons = qdot_realloc(t->reasons, room * sizeof *reasons);
    t->reasons = reasons ? reasons : t->reasons;
    if (!values || !errors || !reasons)
        return QDOT_ENOMEM;
    t->room = room;
    return QDOT_OK;
}

qdot_status
qdot_row_table_add(qdot_row_table *t)
{
    if (t->rows == t->room)
        QDOT_TRY(allocate_rows(t, t->room == 0 ? 16 : 2 * t->room));
    for (size_t i = t->rows * t->n; i < (t->rows + 1) * t->n; i++)
        t->values[i] = t->errors[i] = NAN;
    t->reasons[t->rows++] = NULL;
    return QDOT_OK;
}

qdot_status
qdot_row_table_add_all(qdot_row_table *t, size_t rows)
{
    if (t->rows + rows > t->room)
        QDOT_TRY(allocate_rows(t, t->rows + rows));
    for (size_t k = 0; k < rows; k++)
        QDOT_TRY(qdot_row_table_add(t));
    return QDOT_OK;
}

size_t
qdot_row_table_row_bytes(const qdot_row_table *t)
{
    return t->n * (sizeof *t->values + sizeof *t->errors) + sizeof *t->reasons;
}

void
qdot_row_table_release(qdot_row_table *t)
{
    if (t == NULL || --t->uses > 0)
        return;
    for (size_t i = 0; t->labels != NULL && i < t->n; i++)
        qdot_free(t->labels[i]);
    for (size_t i = 0; t->units != NULL && i < t->n; i++)
        qdot_free(t->units[i]);
    for (size_t i = 0; t->reasons != NULL && i < t->rows; i++)
        qdot_free(t->reasons[i]);
    for (size_t i = 0; i < t->n_parameters; i++)
        qdot_free(t->parameters[i]);
    qdot_free(t->parameters);
    qdot_free(t->parameter_values);
    qdot_function_body_release(t->members);
    qdot_row_table_release(t->marks);
    qdot_free(t->name);
    qdot_free(t->labels);
    qdot_free(t->units);
    qdot_free(t->values);
    qdot_free(t->errors);
    qdot_free(t->reasons);
    qdot_free(t);
}
