/* row-columns.c -- presents the rows of many runs as a table. */
#include "lang/session/row-columns.h"

#include "base/memory.h"

enum { GAP = 2 };

void
qdot_row_columns_free(qdot_row_columns *x)
{
    for (size_t i = 0; x->labels != NULL && i < x->n_labels; i++)
        qdot_text_clear(&x->labels[i]);
    qdot_free(x->labels);
    qdot_free(x->table.columns);
    qdot_free(x->parameters);
    qdot_free(x->numbers);
    qdot_free(x->order);
    *x = (qdot_row_columns){0};
}

static qdot_status
allocate_columns(const qdot_row_table *t, bool some, qdot_row_columns *x)
{
    x->n_labels = t->n - t->n_swept;
    x->labels = qdot_calloc(x->n_labels + 1, sizeof *x->labels);
    x->table.columns = qdot_calloc(qdot_row_columns_count(t) + 3, sizeof *x->table.columns);
    x->parameters = qdot_calloc(t->n_parameters + 1, sizeof *x->parameters);
    if (!x->labels || !x->table.columns || !x->parameters)
        return QDOT_ENOMEM;
    if (!some)
        return QDOT_OK;
    x->numbers = qdot_calloc(t->rows + 1, sizeof *x->numbers);
    x->order = qdot_calloc(t->rows + 1, sizeof *x->order);
    return x->numbers && x->order ? QDOT_OK : QDOT_ENOMEM;
}

/* Select the finished rows, and add a column with their numbers. */
static void
add_row_numbers(const qdot_row_table *t, const bool *done, qdot_row_columns *x)
{
    for (size_t k = 0; k < t->rows; k++) {
        x->numbers[k] = (double)k;
        if (done[k])
            x->order[x->table.rows++] = k;
    }
    x->table.order = x->order;
    x->table.columns[x->table.n++] =
        (qdot_table_column){.name = "row", .in = QDOT_IN_DATA, .values = x->numbers};
}

static qdot_status
add_value_columns(const qdot_row_table *t, qdot_row_columns *x)
{
    for (size_t i = 0; i < t->n; i++)
        x->table.columns[x->table.n++] = (qdot_table_column){.name = t->labels[i],
                                                             .unit = t->units[i],
                                                             .form = QDOT_NUMBER_MEASURED,
                                                             .gap = GAP,
                                                             .measured = true,
                                                             .values = t->values + i,
                                                             .errors = t->errors + i,
                                                             .stride = t->n};
    for (size_t i = 0; i < x->n_labels; i++) {
        qdot_text_format(&x->labels[i], "error of %s", t->labels[t->n_swept + i]);
        QDOT_TRY(qdot_text_status(&x->labels[i]));
        x->table.columns[x->table.n++] = (qdot_table_column){.name = qdot_text_str(&x->labels[i]),
                                                             .unit = t->units[t->n_swept + i],
                                                             .in = QDOT_IN_DATA,
                                                             .gap = GAP,
                                                             .values = t->errors + t->n_swept + i,
                                                             .stride = t->n};
    }
    return QDOT_OK;
}

/* Add the column that says how each row ended and why; for a table with notes, the column of notes. */
static void
add_column_of_reasons(const qdot_row_table *t, qdot_row_columns *x)
{
    const bool failures = t->note == NULL;

    x->table.columns[x->table.n++] = (qdot_table_column){.name = "status",
                                                         .in = QDOT_IN_ANSWERS,
                                                         .kind = QDOT_CELL_TEXT,
                                                         .field = "status",
                                                         .texts = t->reasons,
                                                         .present = failures ? "failed" : "done",
                                                         .absent = "done"};
    x->table.columns[x->table.n++] =
        (qdot_table_column){.name = failures ? "reason" : t->note,
                            .in = QDOT_IN_ANSWERS | QDOT_IN_FILES | (failures ? 0 : QDOT_IN_TERMINAL | QDOT_IN_CSV),
                            .kind = QDOT_CELL_TEXT,
                            .left = true,
                            .gap = GAP,
                            .field = failures ? "reason" : t->note,
                            .texts = t->reasons};
}

qdot_status
qdot_row_columns_of(const qdot_row_table *t, const bool *done, qdot_row_columns *x)
{
    QDOT_TRY(allocate_columns(t, done != NULL, x));
    x->table.name = x->table.title = t->name;
    if (done != NULL)
        add_row_numbers(t, done, x);
    else
        x->table.rows = t->rows;
    QDOT_TRY(add_value_columns(t, x));
    add_column_of_reasons(t, x);
    for (size_t i = 0; i < t->n_parameters; i++)
        x->parameters[i] = (qdot_table_fact){t->parameters[i], NULL, t->parameter_values[i]};
    x->table.n_parameters = t->n_parameters;
    x->table.parameters = x->parameters;
    return QDOT_OK;
}
