/* table.c -- stores the cells of a table that owns its rows, and reads cells of any table. */
#include "table/table.h"

#include <math.h>

#include "base/memory.h"
#include "base/number-text.h"

/* --- tables that own their rows --------------------------------------------------------- */

qdot_status
qdot_table_begin(qdot_dataset *t, size_t n, const qdot_table_column *columns)
{
    t->columns = qdot_calloc(n + 1, sizeof *t->columns);
    if (t->columns == NULL)
        return QDOT_ENOMEM;
    t->n = n;
    for (size_t i = 0; i < n; i++)
        t->columns[i] = columns[i];
    t->own.room = 0;
    return QDOT_OK;
}

/* Allocate memory for more cells, and update the columns' pointers to their cells. */
static void
table_enlarge(qdot_dataset *t)
{
    const size_t room = t->own.room == 0 ? 16 * t->n : 2 * t->own.room;
    double *values = qdot_realloc(t->own.values, room * sizeof *values), *errors;
    char **texts;

    t->own.values = values != NULL ? values : t->own.values;
    errors = qdot_realloc(t->own.errors, room * sizeof *errors);
    t->own.errors = errors != NULL ? errors : t->own.errors;
    texts = qdot_realloc(t->own.texts, room * sizeof *texts);
    t->own.texts = texts != NULL ? texts : t->own.texts;
    if (values == NULL || errors == NULL || texts == NULL) {
        t->own.failed = true;
        return;
    }
    t->own.room = room;
    for (size_t i = 0; i < t->n; i++) {
        qdot_table_column *c = &t->columns[i];

        c->values = t->own.values + i;
        c->errors = t->own.errors + i;
        c->texts = t->own.texts + i;
        c->stride = c->text_stride = t->n;
    }
}

static void
table_append_cell(qdot_dataset *t, double value, double error, char *text)
{
    if (t->own.n == t->own.room && !t->own.failed)
        table_enlarge(t);
    if (t->own.failed) {
        qdot_free(text);
        return;
    }
    t->own.values[t->own.n] = value;
    t->own.errors[t->own.n] = error;
    t->own.texts[t->own.n++] = text;
    t->rows = t->own.n / t->n;
}

void
qdot_table_add_number(qdot_dataset *t, double value, double error)
{
    table_append_cell(t, value, error, NULL);
}

void
qdot_table_add_text(qdot_dataset *t, const char *text)
{
    char *copy = text != NULL ? qdot_strdup(text) : NULL;

    t->own.failed = t->own.failed || (text != NULL && copy == NULL);
    table_append_cell(t, NAN, NAN, copy);
}

void
qdot_table_add_written(qdot_dataset *t, qdot_text *text)
{
    t->own.failed = t->own.failed || text->failed;
    qdot_table_add_text(t, qdot_text_str(text));
    qdot_text_clear(text);
}

qdot_status
qdot_table_status(const qdot_dataset *t)
{
    return t->own.failed ? QDOT_ENOMEM : QDOT_OK;
}

void
qdot_table_clear(qdot_dataset *t)
{
    for (size_t i = 0; i < t->own.n; i++)
        qdot_free(t->own.texts[i]);
    qdot_free(t->own.values);
    qdot_free(t->own.errors);
    qdot_free(t->own.texts);
    qdot_free(t->columns);
    *t = (qdot_dataset){0};
}

/* --- reading cells ---------------------------------------------------------------------- */

qdot_table_cell
qdot_table_at(const qdot_dataset *t, size_t row, size_t column)
{
    const qdot_table_column *c = &t->columns[column];
    const size_t k = t->order != NULL ? t->order[row] : row;
    const size_t at = k * (c->stride > 0 ? c->stride : 1);
    qdot_table_cell cell = {NAN, NAN, NULL};

    if (c->values != NULL)
        cell.value = c->values[at];
    if (c->errors != NULL)
        cell.error = c->errors[at];
    if (c->texts != NULL)
        cell.text = c->texts[k * (c->text_stride > 0 ? c->text_stride : 1)];
    if (c->kind == QDOT_CELL_TEXT && cell.text == NULL)
        cell.text = c->absent;
    else if (c->kind == QDOT_CELL_TEXT && c->present != NULL)
        cell.text = c->present;
    return cell;
}

qdot_status
qdot_table_select(const qdot_dataset *t, unsigned where, qdot_dataset *out)
{
    *out = *t;
    out->columns = NULL;
    if (t->n == 0)
        return qdot_fail(QDOT_EINVAL, "a table needs a column");
    QDOT_TRY(qdot_table_status(t));
    out->columns = qdot_calloc(t->n, sizeof *out->columns);
    if (out->columns == NULL)
        return QDOT_ENOMEM;
    out->n = 0;
    for (size_t j = 0; j < t->n; j++)
        if (qdot_table_shows(t, j, where))
            out->columns[out->n++] = t->columns[j];
    return QDOT_OK;
}

static void
table_add_with_unit(const char *text, const char *unit, qdot_text *out)
{
    qdot_text_add(out, text);
    if (unit != NULL)
        qdot_text_format(out, " [%s]", unit);
}

void
qdot_table_add_head(const qdot_dataset *t, size_t column, qdot_text *out)
{
    const qdot_table_column *c = &t->columns[column];

    table_add_with_unit(c->head != NULL ? c->head : c->name, c->unit, out);
}

void
qdot_table_add_name(const qdot_dataset *t, size_t column, qdot_text *out)
{
    table_add_with_unit(t->columns[column].name, t->columns[column].unit, out);
}

static void
table_print_number(const qdot_table_column *c, const qdot_table_cell *cell, int digits, qdot_text *out)
{
    const qdot_number_form form = digits > 0 ? QDOT_NUMBER_GENERAL : c->form;

    switch (form) {
    case QDOT_NUMBER_GENERAL: qdot_text_double(out, cell->value, digits > 0 ? digits : c->digits); break;
    case QDOT_NUMBER_FIXED: qdot_text_format(out, "%.*f", c->digits, cell->value); break;
    case QDOT_NUMBER_SCIENTIFIC: qdot_text_format(out, "%.*e", c->digits, cell->value); break;
    case QDOT_NUMBER_SCIENTIFIC_OR_0:
        if (cell->value == 0)
            qdot_text_char(out, '0');
        else
            qdot_text_format(out, "%.*e", c->digits, cell->value);
        break;
    case QDOT_NUMBER_MEASURED: qdot_number_text(out, cell->value, cell->error); break;
    case QDOT_NUMBER_BOUND: qdot_number_text_bound(out, cell->value); break;
    }
}

void
qdot_table_print_cell(const qdot_dataset *t, size_t row, size_t column, int digits, const char *none, qdot_text *out)
{
    const qdot_table_column *c = &t->columns[column];
    const qdot_table_cell cell = qdot_table_at(t, row, column);
    const bool measured = digits == 0 && c->form == QDOT_NUMBER_MEASURED;

    if (c->kind == QDOT_CELL_TEXT || cell.text != NULL)
        qdot_text_add(out, cell.text != NULL ? cell.text : "");
    else if (isnan(cell.value) || (measured && !qdot_number_is_known(cell.value, cell.error)))
        qdot_text_add(out, none);
    else if (c->kind == QDOT_CELL_FLAG)
        qdot_text_add(out, cell.value != 0 ? "yes" : "no");
    else
        table_print_number(c, &cell, digits, out);
}
