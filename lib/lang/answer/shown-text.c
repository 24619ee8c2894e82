/* shown-text.c -- what a person reads of an answer of words or of cells, as text and as HTML. */
#include "lang/answer/shown-text.h"

#include <string.h>

static void
write_string(qdot_text *object, const char *before, const char *text)
{
    qdot_text_add(object, before);
    qdot_text_json(object, text);
}

/* The length of a text without the newlines at its end. */
static size_t
length_of_lines(const char *text)
{
    size_t n = strlen(text);

    while (n > 0 && text[n - 1] == '\n')
        n--;
    return n;
}

void
qdot_shown_text(const char *class, const char *text, qdot_text *object)
{
    qdot_text html = {0};

    qdot_text_format(&html, "<pre class=\"%s\">", class);
    qdot_text_html(&html, text, length_of_lines(text), false);
    qdot_text_add(&html, "</pre>\n");
    qdot_shown_fields(text, qdot_text_str(&html), object);
    object->failed = object->failed || html.failed;
    qdot_text_clear(&html);
}

void
qdot_shown_fields(const char *text, const char *html, qdot_text *object)
{
    qdot_text lines = {0};

    qdot_text_add_n(&lines, text, length_of_lines(text));
    write_string(object, ",\"text\":", qdot_text_str(&lines));
    write_string(object, ",\"html\":", html);
    object->failed = object->failed || lines.failed;
    qdot_text_clear(&lines);
}

/* --- rows of tables ----------------------------------------------------------------------- */

qdot_shown_row
qdot_shown_row_begin(bool heads)
{
    qdot_shown_row row = {.tag = heads ? "th" : "td"};

    qdot_text_add(&row.html, "<tr>");
    return row;
}

void
qdot_shown_cell(qdot_shown_row *row, const char *cell, bool words)
{
    qdot_text_add(&row->list, row->list.n > 0 ? "," : "");
    qdot_text_json(&row->list, cell);
    qdot_text_add(&row->text, row->text.n > 0 ? "  " : "");
    qdot_text_add(&row->text, cell);
    qdot_text_format(&row->html, "<%s%s>", row->tag, words ? " class=\"words\"" : "");
    qdot_text_html(&row->html, cell, strlen(cell), false);
    qdot_text_format(&row->html, "</%s>", row->tag);
}

void
qdot_shown_row_end(qdot_shown_row *row, qdot_text *object)
{
    qdot_text_add(&row->html, "</tr>\n");
    qdot_text_add(object, ",\"cells\":[");
    qdot_text_add(object, qdot_text_str(&row->list));
    qdot_text_char(object, ']');
    qdot_shown_fields(qdot_text_str(&row->text), qdot_text_str(&row->html), object);
    object->failed = object->failed || row->list.failed || row->text.failed || row->html.failed;
    qdot_text_clear(&row->list);
    qdot_text_clear(&row->text);
    qdot_text_clear(&row->html);
}

/* --- how the classes look ------------------------------------------------------------------- */

const char qdot_shown_style[] =
    ".qdot pre { margin: 0.3em 0; white-space: pre-wrap; }\n"
    ".qdot p { margin: 0.3em 0; white-space: pre-wrap; }\n"
    ".qdot p.label { margin: 0.8em 0 0; opacity: 0.65; }\n"
    ".qdot h2 { font-size: 1.1em; margin: 1.4em 0 0.4em; }\n"
    ".qdot math[display=block] { display: block math; width: fit-content; max-width: 100%; margin: 0.6em 0; "
    "overflow-x: auto; overflow-y: hidden; }\n"
    /* without a font for mathematics the dots of derivatives would touch their letters */
    ".qdot mover > mo { padding-bottom: 0.1em; }\n"
    ".qdot mtd.left { text-align: right; padding: 0.35em 0; }\n"
    ".qdot mtd.right { text-align: left; padding: 0.35em 0; }\n"
    ".qdot table, table.qdot { border-collapse: collapse; font-variant-numeric: tabular-nums; }\n"
    ".qdot th, .qdot td { padding: 0.15em 0.7em; text-align: right; white-space: nowrap; }\n"
    ".qdot td.words, .qdot th.words, .qdot .run th, .qdot .run td { text-align: left; }\n"
    ".qdot .run td { white-space: normal; }\n"
    ".qdot caption { text-align: left; caption-side: top; font-weight: bold; }\n"
    ".qdot .check p { display: inline; }\n"
    ".qdot .check.holds p { color: #1a7f37; }\n"
    ".qdot .check.fails p { color: #cf222e; }\n"
    ".qdot .check.undecided p { color: #9a6700; }\n"
    ".qdot .notice { border-left: 3px solid #bf8700; padding-left: 0.6em; }\n"
    ".qdot .error { border-left: 3px solid #cf222e; padding-left: 0.6em; }\n";
