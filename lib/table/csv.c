/* csv.c -- writes a table as comma-separated values. */
#include "table/csv.h"

#include <math.h>
#include <string.h>

#include "table/file.h"

enum { EXACT = 17 };

/* RFC 4180, 2.5-2.7: quotes round a field that holds a comma, a quote or a line break;
 * quotes within it are doubled. A blank at either end is kept by quoting too. */
static void
csv_add_field(qdot_text *line, const char *field)
{
    size_t n = strlen(field);

    if (strpbrk(field, ",\"\r\n") == NULL && (n == 0 || (field[0] != ' ' && field[n - 1] != ' '))) {
        qdot_text_add(line, field);
        return;
    }
    qdot_text_char(line, '"');
    for (const char *c = field; *c != '\0'; c++) {
        if (*c == '"')
            qdot_text_char(line, '"');
        qdot_text_char(line, *c);
    }
    qdot_text_char(line, '"');
}

static void
csv_add_cell(const qdot_dataset *t, size_t row, size_t column, qdot_text *out)
{
    const qdot_table_column *c = &t->columns[column];
    const qdot_table_cell cell = qdot_table_at(t, row, column);

    if (c->kind == QDOT_CELL_TEXT || cell.text != NULL)
        csv_add_field(out, cell.text != NULL ? cell.text : "");
    else if (!c->blank || !isnan(cell.value))
        qdot_text_double(out, cell.value, c->exact > 0 ? c->exact : EXACT);
}

static void
csv_add_row(const qdot_dataset *t, size_t row, qdot_text *out)
{
    for (size_t j = 0; j < t->n; j++) {
        qdot_text_add(out, j > 0 ? "," : "");
        csv_add_cell(t, row, j, out);
    }
    qdot_text_char(out, '\n');
}

static void
csv_add_names(const qdot_dataset *t, qdot_text *out)
{
    qdot_text name = {0};

    for (size_t j = 0; j < t->n; j++) {
        qdot_text_truncate(&name, 0);
        qdot_table_add_name(t, j, &name);
        qdot_text_add(out, j > 0 ? "," : "");
        csv_add_field(out, qdot_text_str(&name));
    }
    qdot_text_char(out, '\n');
    out->failed = out->failed || name.failed;
    qdot_text_clear(&name);
}

qdot_status
qdot_table_csv(const qdot_dataset *t, const char *path)
{
    static const qdot_table_format format = {csv_add_names, csv_add_row, NULL};

    return qdot_table_file(t, QDOT_IN_CSV, &format, path);
}
