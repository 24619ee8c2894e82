/* json.c -- writes a table as JSON, as a file or as answers. */
#include "table/json.h"

#include <math.h>

#include "base/number-text.h"
#include "table/file.h"

/* --- rows as answers -------------------------------------------------------------------- */

static void
json_add_cell(const qdot_dataset *t, size_t row, size_t column, qdot_text *out)
{
    const qdot_table_cell cell = qdot_table_at(t, row, column);

    switch (t->columns[column].kind) {
    case QDOT_CELL_TEXT:
        if (cell.text != NULL)
            qdot_text_json(out, cell.text);
        else
            qdot_text_add(out, "null");
        break;
    case QDOT_CELL_FLAG: qdot_text_add(out, isnan(cell.value) ? "null" : cell.value != 0 ? "true" : "false"); break;
    case QDOT_CELL_NUMBER:
        if (cell.text != NULL)
            qdot_text_add(out, cell.text);
        else
            qdot_number_text_json(out, cell.value);
        break;
    }
}

static bool
json_is_in_values(const qdot_dataset *t, size_t column)
{
    return qdot_table_shows(t, column, QDOT_IN_ANSWERS) && t->columns[column].field == NULL;
}

/* Append `"values":[...]`, and `"errors":[...]` if some column has errors. */
static void
json_add_values(const qdot_dataset *t, size_t row, qdot_text *out)
{
    const char *before = ",\"values\":[";
    bool measured = false;

    for (size_t j = 0; j < t->n; j++) {
        if (!json_is_in_values(t, j))
            continue;
        qdot_text_add(out, before);
        json_add_cell(t, row, j, out);
        before = ",";
        measured = measured || t->columns[j].measured;
    }
    qdot_text_char(out, ']');
    before = ",\"errors\":[";
    for (size_t j = 0; j < t->n && measured; j++) {
        if (!json_is_in_values(t, j))
            continue;
        qdot_text_add(out, before);
        qdot_number_text_json(out, qdot_table_at(t, row, j).error);
        before = ",";
    }
    qdot_text_add(out, measured ? "]" : "");
}

/* Append `,"units":["s","m/s",null]` for the columns that stand there, if some column has a unit. */
static void
json_add_units(const qdot_dataset *t, unsigned where, qdot_text *out)
{
    const char *before = ",\"units\":[";
    bool some = false;

    for (size_t j = 0; j < t->n; j++)
        some = some || t->columns[j].unit != NULL;
    for (size_t j = 0; j < t->n && some; j++) {
        if (where == QDOT_IN_ANSWERS ? !json_is_in_values(t, j) : !qdot_table_shows(t, j, where))
            continue;
        qdot_text_add(out, before);
        if (t->columns[j].unit != NULL)
            qdot_text_json(out, t->columns[j].unit);
        else
            qdot_text_add(out, "null");
        before = ",";
    }
    qdot_text_add(out, some ? "]" : "");
}

void
qdot_table_json_columns(const qdot_dataset *t, const char *name, qdot_text *out)
{
    const char *before = "";

    qdot_text_add(out, "{\"kind\":\"columns\",\"name\":");
    qdot_text_json(out, t->name != NULL ? t->name : name);
    qdot_text_add(out, ",\"columns\":[");
    for (size_t j = 0; j < t->n; j++) {
        if (!json_is_in_values(t, j))
            continue;
        qdot_text_add(out, before);
        qdot_text_json(out, t->columns[j].name);
        before = ",";
    }
    qdot_text_char(out, ']');
    json_add_units(t, QDOT_IN_ANSWERS, out);
    qdot_text_add(out, "}\n");
}

void
qdot_table_json_row(const qdot_dataset *t, size_t row, qdot_text *out)
{
    bool values = false;

    qdot_text_add(out, "{\"kind\":\"row\"");
    if (t->name != NULL) {
        qdot_text_add(out, ",\"name\":");
        qdot_text_json(out, t->name);
    }
    for (size_t j = 0; j < t->n; j++) {
        if (!qdot_table_shows(t, j, QDOT_IN_ANSWERS))
            continue;
        if (t->columns[j].field != NULL) {
            qdot_text_format(out, ",\"%s\":", t->columns[j].field);
            json_add_cell(t, row, j, out);
        } else if (!values) {
            json_add_values(t, row, out);
            values = true;
        }
    }
    qdot_text_add(out, "}\n");
}

/* --- a table as a JSON file ------------------------------------------------------------- */

static void
json_add_facts(size_t n, const qdot_table_fact *facts, qdot_text *out)
{
    for (size_t i = 0; i < n; i++) {
        qdot_text_add(out, i > 0 ? "," : "");
        qdot_text_json(out, facts[i].name);
        qdot_text_char(out, ':');
        if (facts[i].text != NULL)
            qdot_text_json(out, facts[i].text);
        else
            qdot_number_text_json(out, facts[i].number);
    }
}

static void
json_add_head(const qdot_dataset *t, qdot_text *out)
{
    qdot_text_char(out, '{');
    json_add_facts(t->n_facts, t->facts, out);
    qdot_text_add(out, t->n_facts > 0 ? ",\n\"parameters\":{" : "\"parameters\":{");
    json_add_facts(t->n_parameters, t->parameters, out);
    qdot_text_add(out, "},\n\"columns\":[");
    for (size_t j = 0; j < t->n; j++) {
        qdot_text_add(out, j > 0 ? "," : "");
        qdot_text_json(out, t->columns[j].name);
    }
    qdot_text_char(out, ']');
    json_add_units(t, QDOT_IN_FILES, out);
    qdot_text_add(out, ",\n\"rows\":[");
}

static void
json_add_row(const qdot_dataset *t, size_t row, qdot_text *out)
{
    qdot_text_add(out, row > 0 ? ",\n[" : "\n[");
    for (size_t j = 0; j < t->n; j++) {
        const qdot_table_cell cell = qdot_table_at(t, row, j);

        qdot_text_add(out, j > 0 ? "," : "");
        if (t->columns[j].kind == QDOT_CELL_TEXT)
            qdot_text_json(out, cell.text != NULL ? cell.text : "");
        else
            qdot_number_text_json(out, cell.value);
    }
    qdot_text_char(out, ']');
}

static void
json_add_foot(const qdot_dataset *t, qdot_text *out)
{
    (void)t;
    qdot_text_add(out, "]}\n");
}

qdot_status
qdot_table_json(const qdot_dataset *t, const char *path)
{
    static const qdot_table_format format = {json_add_head, json_add_row, json_add_foot};

    return qdot_table_file(t, QDOT_IN_FILES, &format, path);
}
