/* table.c -- a copy of a table of the session, column by column. */
#include <string.h>

#include "api/system.h"
#include "base/memory.h"
#include "lang/session/row-tables.h"

/* One column: numbers with their errors, or texts. */
typedef struct {
    const char *name, *unit;
    double *numbers, *errors; /* [rows]; NULL: a column of text */
    const char **texts;       /* [rows]; NULL: a column of numbers */
} column;

struct qdot_table {
    qdot_arena *arena; /* has all that the table is made of */
    size_t rows, columns;
    column *at; /* [columns] */
};

/* The copy of a text in the arena; NULL if memory runs out. */
static const char *
copy_text(qdot_arena *arena, const char *text)
{
    return qdot_arena_strndup(arena, text, strlen(text));
}

static qdot_status
copy_numbers(qdot_arena *arena, const qdot_row_table *from, size_t i, column *to)
{
    to->name = copy_text(arena, from->labels[i]);
    to->unit = copy_text(arena, from->units[i] != NULL ? from->units[i] : "");
    to->numbers = qdot_arena_take(arena, (from->rows + 1) * sizeof *to->numbers);
    to->errors = qdot_arena_take(arena, (from->rows + 1) * sizeof *to->errors);
    if (to->name == NULL || to->unit == NULL || to->numbers == NULL || to->errors == NULL)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < from->rows; k++) {
        to->numbers[k] = from->values[k * from->n + i];
        to->errors[k] = from->errors[k * from->n + i];
    }
    return QDOT_OK;
}

/* The column of notes, or of the reasons why rows failed. */
static qdot_status
copy_reasons(qdot_arena *arena, const qdot_row_table *from, column *to)
{
    to->name = from->note != NULL ? from->note : "reason"; /* both are constants of the library */
    to->unit = "";
    to->texts = qdot_arena_take(arena, (from->rows + 1) * sizeof *to->texts);
    if (to->texts == NULL)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < from->rows; k++) {
        to->texts[k] = from->reasons[k] != NULL ? copy_text(arena, from->reasons[k]) : "";
        if (to->texts[k] == NULL)
            return QDOT_ENOMEM;
    }
    return QDOT_OK;
}

static bool
has_reasons(const qdot_row_table *from)
{
    bool any = from->note != NULL;

    for (size_t k = 0; k < from->rows && !any; k++)
        any = from->reasons[k] != NULL;
    return any;
}

static qdot_status
copy_table(const qdot_row_table *from, qdot_table *to)
{
    to->rows = from->rows;
    to->at = qdot_arena_take(to->arena, (from->n + 1) * sizeof *to->at);
    if (to->at == NULL)
        return QDOT_ENOMEM;
    memset(to->at, 0, (from->n + 1) * sizeof *to->at);
    for (size_t i = 0; i < from->n; i++)
        QDOT_TRY(copy_numbers(to->arena, from, i, &to->at[to->columns++]));
    return has_reasons(from) ? copy_reasons(to->arena, from, &to->at[to->columns++]) : QDOT_OK;
}

/* Read the name of a table and find it. */
static qdot_status
read_table_name(qdot_cursor *c, void *data)
{
    const qdot_row_table **table = data;
    const char *name;

    QDOT_TRY(qdot_api_read_name(c, &name));
    *table = qdot_row_tables_find(c->session, name);
    return *table != NULL ? QDOT_OK : qdot_fail(QDOT_ENAME, "there is no table `%.100s`", name);
}

/* The table of this name, of NULL the latest; NULL, with a failure, if there is none. */
static const qdot_row_table *
find_table(qdot_system *system, const char *name)
{
    const qdot_session *session = system->session;
    const qdot_row_table *found = NULL;

    if (name != NULL)
        return qdot_api_read(system, "table", name, read_table_name, &found) == QDOT_OK ? found : NULL;
    if (session->tables->n > 0)
        return session->tables->at[session->tables->n - 1];
    (void)qdot_fail(QDOT_ENAME, "table: no table has been made");
    return NULL;
}

qdot_result
qdot_system_table(qdot_system *system, const char *name, qdot_table **table)
{
    const qdot_row_table *from = NULL;
    qdot_table *t = NULL;
    qdot_status status;

    if (table != NULL)
        *table = NULL;
    if (system == NULL)
        return QDOT_RESULT_INVALID;
    if (table == NULL)
        return qdot_api_refuse(system, "table: the table is NULL");
    status = qdot_api_begin(system);
    if (status == QDOT_OK) {
        from = find_table(system, name);
        status = from != NULL ? QDOT_OK : qdot_last_error()->status;
    }
    if (status == QDOT_OK) {
        t = qdot_calloc(1, sizeof *t);
        status = t != NULL ? QDOT_OK : QDOT_ENOMEM;
    }
    if (status == QDOT_OK) {
        t->arena = qdot_arena_new();
        status = t->arena != NULL ? copy_table(from, t) : QDOT_ENOMEM;
    }
    if (status == QDOT_OK)
        *table = t;
    else
        qdot_table_free(t);
    if (status == QDOT_ENOMEM)
        (void)qdot_fail(QDOT_ENOMEM, "table: out of memory");
    return qdot_api_end(system, status);
}

void
qdot_table_free(qdot_table *table)
{
    if (table == NULL)
        return;
    qdot_arena_free(table->arena);
    qdot_free(table);
}

/* --- reading a table ------------------------------------------------------------------------ */

/* Column i; an empty one if there is none. */
static column
get_column(const qdot_table *table, size_t i)
{
    return table != NULL && i < table->columns ? table->at[i] : (column){0};
}

size_t
qdot_table_rows(const qdot_table *table)
{
    return table != NULL ? table->rows : 0;
}

size_t
qdot_table_columns(const qdot_table *table)
{
    return table != NULL ? table->columns : 0;
}

const char *
qdot_table_column_name(const qdot_table *table, size_t i)
{
    return get_column(table, i).name;
}

const char *
qdot_table_column_unit(const qdot_table *table, size_t i)
{
    return get_column(table, i).unit;
}

const double *
qdot_table_numbers(const qdot_table *table, size_t i)
{
    return get_column(table, i).numbers;
}

const double *
qdot_table_errors(const qdot_table *table, size_t i)
{
    return get_column(table, i).errors;
}

const char *
qdot_table_cell(const qdot_table *table, size_t i, size_t row)
{
    const column c = get_column(table, i);

    return c.texts != NULL && row < table->rows ? c.texts[row] : NULL;
}
