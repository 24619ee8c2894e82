/* csv.c -- columns as comma-separated values. */
#include "show/show.h"

#include <string.h>

#include "base/interrupt.h"
#include "base/sink.h"

enum { EXACT = 17, CHUNK = 1 << 16 };

/* RFC 4180, 2.5-2.7: quotes round a field that holds a comma, a quote or a line break;
 * quotes within it are doubled. A blank at either end is kept by quoting too. */
static void
csv_add_field(qdot_text *line, const char *field)
{
    size_t n = strlen(field);

    if (strpbrk(field, ",\"\r\n") == NULL &&
        (n == 0 || (field[0] != ' ' && field[n - 1] != ' '))) {
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

static qdot_status
put_rows(qdot_sink *sink, size_t columns, const qdot_column *column,
         char *const *const *texts, size_t rows, qdot_text *text)
{
    for (size_t j = 0; j < columns; j++) {
        if (j > 0)
            qdot_text_char(text, ',');
        csv_add_field(text, column[j].label);
    }
    qdot_text_char(text, '\n');
    for (size_t i = 0; i < rows; i++) {
        for (size_t j = 0; j < columns; j++) {
            if (j > 0)
                qdot_text_char(text, ',');
            if (texts != NULL && texts[j] != NULL)
                csv_add_field(text, texts[j][i]);
            else
                qdot_text_double(text, column[j].at[i], EXACT);
        }
        qdot_text_char(text, '\n');
        if (text->n >= CHUNK) {
            QDOT_TRY(qdot_text_status(text));
            QDOT_TRY(qdot_interrupt_check());
            QDOT_TRY(qdot_sink_put(sink, text->at, text->n));
            qdot_text_truncate(text, 0);
        }
    }
    QDOT_TRY(qdot_text_status(text));
    return qdot_sink_put(sink, qdot_text_str(text), text->n);
}

qdot_status
qdot_table_csv_texts(size_t columns, const qdot_column *column, char *const *const *texts,
                     size_t rows, const char *path)
{
    qdot_text text = {0};
    qdot_sink sink;
    qdot_status status;

    if (columns == 0)
        return qdot_fail(QDOT_EINVAL, "a table needs a column");
    QDOT_TRY(qdot_sink_open(&sink, path));
    status = put_rows(&sink, columns, column, texts, rows, &text);
    qdot_text_clear(&text);
    if (status != QDOT_OK) {
        qdot_sink_abandon(&sink);
        return status;
    }
    return qdot_sink_close(&sink);
}

qdot_status
qdot_table_csv(size_t columns, const qdot_column *column, size_t rows, const char *path)
{
    return qdot_table_csv_texts(columns, column, NULL, rows, path);
}
