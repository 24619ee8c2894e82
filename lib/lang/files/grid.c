/* grid.c -- evaluates expressions along runs into a grid, a column of numbers for each. */
#include "lang/session/units.h"
#include "lang/files/grid.h"

#include <string.h>

#include "lang/answer/table-answer.h"
#include "lang/runs/data-file.h"

/* The number of significant digits in answers. */
enum { DIGITS = 10 };

void
qdot_grid_free(qdot_grid *g)
{
    for (size_t i = 0; g->labels != NULL && i < g->table.n; i++)
        qdot_free(g->labels[i]);
    for (size_t i = 0; g->units != NULL && i < g->table.n; i++)
        qdot_free(g->units[i]);
    qdot_free(g->labels);
    qdot_free(g->units);
    qdot_free(g->values);
    qdot_free(g->errors);
    qdot_free(g->table.columns);
}

static qdot_status
allocate_grid(qdot_grid *g, size_t n, size_t rows)
{
    g->table.n = n;
    g->table.rows = rows;
    g->values = qdot_calloc(n * rows, sizeof *g->values);
    g->labels = qdot_calloc(n, sizeof *g->labels);
    g->units = qdot_calloc(n, sizeof *g->units);
    g->table.columns = qdot_calloc(n, sizeof *g->table.columns);
    if (g->values == NULL || g->labels == NULL || g->units == NULL || g->table.columns == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++)
        g->table.columns[i] = (qdot_table_column){.digits = DIGITS, .gap = 2, .values = g->values + i * rows};
    return QDOT_OK;
}

/* Let the columns have errors; those of times stay 0. */
static qdot_status
allocate_errors(qdot_grid *g, size_t n, size_t rows)
{
    g->errors = qdot_calloc(n * rows, sizeof *g->errors);
    if (g->errors == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++) {
        g->table.columns[i].errors = g->errors + i * rows;
        g->table.columns[i].measured = true;
    }
    return QDOT_OK;
}

/* Write the label of column i, of the expression e: "R", or "R[2]" for one of several components; and its unit. */
static qdot_status
label_column(qdot_grid *g, size_t i, qdot_session *session, qdot_expr e, const char *label, size_t component,
             size_t components)
{
    qdot_text text = {0};

    qdot_text_add(&text, label);
    if (components > 1)
        qdot_text_format(&text, "[%zu]", component + 1);
    g->labels[i] = text.at;
    g->table.columns[i].name = text.at;
    QDOT_TRY(qdot_text_status(&text));
    QDOT_TRY(qdot_units_label_of(session, e, &g->units[i]));
    g->table.columns[i].unit = g->units[i];
    return QDOT_OK;
}

qdot_status
qdot_grid_fill(qdot_grid *g, const qdot_operands *list, size_t rows, const double *times)
{
    size_t n = 1, next = 1;

    for (size_t i = 0; i < list->n; i++)
        n += list->at[i].columns.n;
    QDOT_TRY(allocate_grid(g, n, rows));
    memcpy(g->values, times, rows * sizeof *times);
    if (g->measured)
        QDOT_TRY(allocate_errors(g, n, rows));
    QDOT_TRY(label_column(g, 0, list->at[0].session, QDOT_T, "t", 0, 1));
    for (size_t i = 0; i < list->n; i++) {
        const qdot_operand *o = &list->at[i];

        QDOT_TRY(qdot_operands_values(o, rows, times, g->values + next * rows,
                                      g->errors != NULL ? g->errors + next * rows : NULL));
        for (size_t k = 0; k < o->columns.n; k++)
            QDOT_TRY(label_column(g, next + k, o->session, o->columns.at[k], o->label, k, o->columns.n));
        next += o->columns.n;
    }
    return QDOT_OK;
}

qdot_status
qdot_grid_write(qdot_session *session, qdot_grid *g, qdot_run *run, const char *path)
{
    return path != NULL ? qdot_data_file_write(session, run, &g->table, path)
                        : qdot_answer_table(session, "table", &g->table);
}
