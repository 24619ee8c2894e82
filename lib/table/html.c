/* html.c -- writes a table as HTML, on a page of its own or within another page. */
#include "table/html.h"

#include <string.h>

#include "base/memory.h"
#include "table/file.h"

/* The number of digits of numbers in a table on an HTML page of its own. */
enum { PAGE_DIGITS = 12 };

static void
html_add_text(const char *text, qdot_text *out)
{
    qdot_text_html(out, text, strlen(text), false);
}

/* What differs between a table within an HTML page and a table on a page of its own. */
typedef struct {
    bool names; /* show the names of columns, not their headings */
    int digits;
    const char *none;
} html_style;

static void
html_add_heads(const qdot_dataset *t, const html_style *style, qdot_text *out)
{
    qdot_text head = {0};

    qdot_text_add(out, "<tr>");
    for (size_t j = 0; j < t->n; j++) {
        qdot_text_truncate(&head, 0);
        (style->names ? qdot_table_add_name : qdot_table_add_head)(t, j, &head);
        qdot_text_add(out, "<th>");
        html_add_text(qdot_text_str(&head), out);
        qdot_text_add(out, "</th>");
    }
    qdot_text_add(out, "</tr>");
    out->failed = out->failed || head.failed;
    qdot_text_clear(&head);
}

static void
html_add_row(const qdot_dataset *t, const html_style *style, size_t row, qdot_text *out)
{
    qdot_text cell = {0};

    qdot_text_add(out, "<tr>");
    for (size_t j = 0; j < t->n; j++) {
        qdot_text_truncate(&cell, 0);
        qdot_table_print_cell(t, row, j, style->digits, style->none, &cell);
        qdot_text_add(out, "<td>");
        html_add_text(qdot_text_str(&cell), out);
        qdot_text_add(out, "</td>");
    }
    qdot_text_add(out, "</tr>\n");
    out->failed = out->failed || cell.failed;
    qdot_text_clear(&cell);
}

qdot_status
qdot_table_html_part(const qdot_dataset *t, qdot_text *out)
{
    static const html_style style = {false, 0, "\u2013"};
    qdot_dataset shown;

    QDOT_TRY(qdot_table_select(t, QDOT_IN_TERMINAL, &shown));
    qdot_text_add(out, "<table>\n");
    html_add_heads(&shown, &style, out);
    qdot_text_char(out, '\n');
    for (size_t k = 0; k < t->rows; k++)
        html_add_row(&shown, &style, k, out);
    qdot_text_add(out, "</table>\n");
    qdot_free(shown.columns);
    return qdot_text_status(out);
}

/* --- a page of its own ------------------------------------------------------------------ */

static const html_style page_style = {true, PAGE_DIGITS, "nan"};

static void
html_add_facts(size_t n, const qdot_table_fact *facts, qdot_text *out)
{
    for (size_t i = 0; i < n; i++) {
        qdot_text_add(out, "<dt>");
        html_add_text(facts[i].name, out);
        qdot_text_add(out, "</dt><dd>");
        if (facts[i].text != NULL)
            html_add_text(facts[i].text, out);
        else
            qdot_text_double(out, facts[i].number, PAGE_DIGITS);
        qdot_text_add(out, "</dd>\n");
    }
}

static void
html_add_page_head(const qdot_dataset *t, qdot_text *out)
{
    const char *title = t->title != NULL ? t->title : "";

    qdot_text_add(out, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                       "<title>");
    html_add_text(title, out);
    qdot_text_add(out, "</title>\n<style>\n"
                       "body { font-family: sans-serif; margin: 2em; }\n"
                       "dl { display: grid; grid-template-columns: max-content auto; gap: 0.2em 1em; }\n"
                       "dd { margin: 0; }\n"
                       "table { border-collapse: collapse; font-variant-numeric: tabular-nums; }\n"
                       "th, td { padding: 0.2em 0.8em; text-align: right; }\n"
                       "thead th { border-bottom: 1px solid; position: sticky; top: 0; "
                       "background: Canvas; }\n"
                       "tbody tr:nth-child(even) { background: #8882; }\n"
                       "</style>\n</head>\n<body>\n<h1>");
    html_add_text(title, out);
    qdot_text_add(out, "</h1>\n<dl>\n");
    html_add_facts(t->n_facts, t->facts, out);
    html_add_facts(t->n_parameters, t->parameters, out);
    qdot_text_add(out, "</dl>\n<table>\n<thead>");
    html_add_heads(t, &page_style, out);
    qdot_text_add(out, "</thead>\n<tbody>\n");
}

static void
html_add_page_row(const qdot_dataset *t, size_t row, qdot_text *out)
{
    html_add_row(t, &page_style, row, out);
}

static void
html_add_page_foot(const qdot_dataset *t, qdot_text *out)
{
    (void)t;
    qdot_text_add(out, "</tbody>\n</table>\n</body>\n</html>\n");
}

qdot_status
qdot_table_html(const qdot_dataset *t, const char *path)
{
    static const qdot_table_format format = {html_add_page_head, html_add_page_row, html_add_page_foot};

    return qdot_table_file(t, QDOT_IN_FILES, &format, path);
}
