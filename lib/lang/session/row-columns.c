/* row-columns.c -- the rows of a table column by column. */
#include "lang/session/row-columns.h"

#include "base/memory.h"

void
qdot_row_columns_free(qdot_row_columns *x)
{
    for (size_t i = 0; x->labels != NULL && i < x->n; i++)
        qdot_text_clear(&x->labels[i]);
    qdot_free(x->labels);
    qdot_free(x->values);
    qdot_free(x->columns);
    qdot_free(x->texts);
    qdot_free(x->reasons);
    *x = (qdot_row_columns){0};
}

static qdot_status
row_columns_allocate(qdot_row_columns *x)
{
    x->values = qdot_calloc(x->n * x->rows + 1, sizeof *x->values);
    x->labels = qdot_calloc(x->n, sizeof *x->labels);
    x->columns = qdot_calloc(x->n + 1, sizeof *x->columns);
    x->texts = qdot_calloc(x->n + 1, sizeof *x->texts);
    x->reasons = qdot_calloc(x->rows + 1, sizeof *x->reasons);
    return x->values && x->labels && x->columns && x->texts && x->reasons ? QDOT_OK : QDOT_ENOMEM;
}

static qdot_status
label_columns(const qdot_row_table *t, size_t first, qdot_row_columns *x)
{
    for (size_t i = 0; i < x->n; i++) {
        qdot_text *label = &x->labels[i];

        if (i < first)
            qdot_text_add(label, "row");
        else if (i - first < t->n)
            qdot_text_add(label, t->labels[i - first]);
        else
            qdot_text_format(label, "error of %s", t->labels[i - first - t->n + t->n_swept]);
        QDOT_TRY(qdot_text_status(label));
        x->columns[i] = (qdot_column){qdot_text_str(label), x->values + i * x->rows};
    }
    x->columns[x->n].label = t->note != NULL ? t->note : "reason";
    x->texts[x->n] = x->reasons;
    return QDOT_OK;
}

qdot_status
qdot_row_columns_fill(const qdot_row_table *t, const bool *done, qdot_row_columns *x)
{
    static char none[] = "";
    const size_t first = done != NULL;
    size_t at = 0;

    for (size_t k = 0; k < t->rows; k++)
        x->rows += done == NULL || done[k];
    x->n = first + qdot_row_columns_count(t);
    QDOT_TRY(row_columns_allocate(x));
    QDOT_TRY(label_columns(t, first, x));
    for (size_t k = 0; k < t->rows; k++) {
        double *const column = x->values + at;

        if (done != NULL && !done[k])
            continue;
        if (first == 1)
            column[0] = (double)k;
        for (size_t i = 0; i < t->n; i++)
            column[(first + i) * x->rows] = t->values[k * t->n + i];
        for (size_t i = t->n_swept; i < t->n; i++)
            column[(first + t->n + i - t->n_swept) * x->rows] = t->errors[k * t->n + i];
        x->reasons[at++] = t->reasons[k] != NULL ? t->reasons[k] : none;
    }
    return QDOT_OK;
}

qdot_data_fact *
qdot_row_columns_parameters(const qdot_row_table *t)
{
    qdot_data_fact *all = qdot_calloc(t->n_parameters + 1, sizeof *all);

    for (size_t i = 0; i < t->n_parameters && all != NULL; i++)
        all[i] = (qdot_data_fact){t->parameters[i], NULL, t->parameter_values[i]};
    return all;
}
