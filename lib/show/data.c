/* data.c -- columns as JSON and as a page of HTML. */
#include "show/data.h"

#include <math.h>

#include "base/interrupt.h"
#include "base/sink.h"
#include "show/formula-page.h"

enum { EXACT = 17, CHUNK = 1 << 16 };

/* Write what has gathered, if it is much. */
static qdot_status
pass_on(qdot_sink *sink, qdot_text *text, size_t least)
{
    if (text->n < least)
        return QDOT_OK;
    QDOT_TRY(qdot_text_status(text));
    QDOT_TRY(qdot_interrupt_check());
    QDOT_TRY(qdot_sink_put(sink, qdot_text_str(text), text->n));
    qdot_text_truncate(text, 0);
    return QDOT_OK;
}

typedef qdot_status writer(const qdot_data *data, int digits, qdot_sink *sink, qdot_text *text);

static qdot_status
data_write_file(const qdot_data *data, int digits, writer *write, const char *path)
{
    qdot_text text = {0};
    qdot_sink sink;
    qdot_status status;

    if (data->columns == 0)
        return qdot_fail(QDOT_EINVAL, "a table needs a column");
    QDOT_TRY(qdot_sink_open(&sink, path));
    status = write(data, digits, &sink, &text);
    if (status == QDOT_OK)
        status = pass_on(&sink, &text, 0);
    qdot_text_clear(&text);
    if (status != QDOT_OK) {
        qdot_sink_abandon(&sink);
        return status;
    }
    return qdot_sink_close(&sink);
}

/* --- JSON ------------------------------------------------------------------------------- */

static void
json_number(qdot_text *text, double x)
{
    if (isfinite(x))
        qdot_text_double(text, x, EXACT);
    else
        qdot_text_add(text, "null");
}

static void
json_facts(qdot_text *text, size_t n, const qdot_data_fact *facts)
{
    for (size_t i = 0; i < n; i++) {
        qdot_text_add(text, i > 0 ? "," : "");
        qdot_text_json(text, facts[i].name);
        qdot_text_char(text, ':');
        if (facts[i].text != NULL)
            qdot_text_json(text, facts[i].text);
        else
            json_number(text, facts[i].number);
    }
}

static void
json_cell(qdot_text *text, const qdot_data *data, size_t j, size_t i)
{
    if (qdot_data_has_texts(data, j))
        qdot_text_json(text, data->texts[j][i]);
    else
        json_number(text, data->column[j].at[i]);
}

static qdot_status
write_json(const qdot_data *data, int digits, qdot_sink *sink, qdot_text *text)
{
    (void)digits;
    qdot_text_char(text, '{');
    json_facts(text, data->n_facts, data->facts);
    qdot_text_add(text, data->n_facts > 0 ? ",\n\"parameters\":{" : "\"parameters\":{");
    json_facts(text, data->n_parameters, data->parameters);
    qdot_text_add(text, "},\n\"columns\":[");
    for (size_t j = 0; j < data->columns; j++) {
        qdot_text_add(text, j > 0 ? "," : "");
        qdot_text_json(text, data->column[j].label);
    }
    qdot_text_add(text, "],\n\"rows\":[");
    for (size_t i = 0; i < data->rows; i++) {
        qdot_text_add(text, i > 0 ? ",\n[" : "\n[");
        for (size_t j = 0; j < data->columns; j++) {
            qdot_text_add(text, j > 0 ? "," : "");
            json_cell(text, data, j, i);
        }
        qdot_text_char(text, ']');
        QDOT_TRY(pass_on(sink, text, CHUNK));
    }
    qdot_text_add(text, "]}\n");
    return QDOT_OK;
}

qdot_status
qdot_data_json(const qdot_data *data, const char *path)
{
    return data_write_file(data, EXACT, write_json, path);
}

/* --- HTML ------------------------------------------------------------------------------- */

static void
html_text(qdot_text *text, const char *what)
{
    size_t n = 0;

    while (what[n] != '\0')
        n++;
    qdot_page_escape(what, n, text);
}

static void
html_facts(qdot_text *text, size_t n, const qdot_data_fact *facts, int digits)
{
    for (size_t i = 0; i < n; i++) {
        qdot_text_add(text, "<dt>");
        html_text(text, facts[i].name);
        qdot_text_add(text, "</dt><dd>");
        if (facts[i].text != NULL)
            html_text(text, facts[i].text);
        else
            qdot_text_double(text, facts[i].number, digits);
        qdot_text_add(text, "</dd>\n");
    }
}

static qdot_status
write_html(const qdot_data *data, int digits, qdot_sink *sink, qdot_text *text)
{
    qdot_text_add(text, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                        "<title>");
    html_text(text, data->title);
    qdot_text_add(text, "</title>\n<style>\n"
                        "body { font-family: sans-serif; margin: 2em; }\n"
                        "dl { display: grid; grid-template-columns: max-content auto; gap: 0.2em 1em; }\n"
                        "dd { margin: 0; }\n"
                        "table { border-collapse: collapse; font-variant-numeric: tabular-nums; }\n"
                        "th, td { padding: 0.2em 0.8em; text-align: right; }\n"
                        "thead th { border-bottom: 1px solid; position: sticky; top: 0; "
                        "background: Canvas; }\n"
                        "tbody tr:nth-child(even) { background: #8882; }\n"
                        "</style>\n</head>\n<body>\n<h1>");
    html_text(text, data->title);
    qdot_text_add(text, "</h1>\n<dl>\n");
    html_facts(text, data->n_facts, data->facts, digits);
    html_facts(text, data->n_parameters, data->parameters, digits);
    qdot_text_add(text, "</dl>\n<table>\n<thead><tr>");
    for (size_t j = 0; j < data->columns; j++) {
        qdot_text_add(text, "<th>");
        html_text(text, data->column[j].label);
        qdot_text_add(text, "</th>");
    }
    qdot_text_add(text, "</tr></thead>\n<tbody>\n");
    for (size_t i = 0; i < data->rows; i++) {
        qdot_text_add(text, "<tr>");
        for (size_t j = 0; j < data->columns; j++) {
            qdot_text_add(text, "<td>");
            if (qdot_data_has_texts(data, j))
                html_text(text, data->texts[j][i]);
            else
                qdot_text_double(text, data->column[j].at[i], digits);
            qdot_text_add(text, "</td>");
        }
        qdot_text_add(text, "</tr>\n");
        QDOT_TRY(pass_on(sink, text, CHUNK));
    }
    qdot_text_add(text, "</tbody>\n</table>\n</body>\n</html>\n");
    return QDOT_OK;
}

qdot_status
qdot_data_html(const qdot_data *data, int digits, const char *path)
{
    return data_write_file(data, digits, write_html, path);
}
