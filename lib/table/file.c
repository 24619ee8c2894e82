/* file.c -- writes a table to a file, row by row. */
#include "table/file.h"

#include "base/interrupt.h"
#include "base/memory.h"
#include "base/sink.h"

enum { CHUNK = 1 << 16 };

/* Write the text collected so far to the file, if it has at least `least` bytes. */
static qdot_status
write_collected_text(qdot_sink *sink, qdot_text *text, size_t least)
{
    if (text->n < least)
        return qdot_text_status(text);
    QDOT_TRY(qdot_text_status(text));
    QDOT_TRY(qdot_interrupt_check());
    QDOT_TRY(qdot_sink_put(sink, qdot_text_str(text), text->n));
    qdot_text_truncate(text, 0);
    return QDOT_OK;
}

static qdot_status
write_all_rows(const qdot_dataset *t, const qdot_table_format *format, qdot_sink *sink, qdot_text *text)
{
    if (format->head != NULL)
        format->head(t, text);
    for (size_t k = 0; k < t->rows; k++) {
        format->row(t, k, text);
        QDOT_TRY(write_collected_text(sink, text, CHUNK));
    }
    if (format->foot != NULL)
        format->foot(t, text);
    return write_collected_text(sink, text, 0);
}

static qdot_status
write_table(const qdot_dataset *t, const qdot_table_format *format, const char *path)
{
    qdot_text text = {0};
    qdot_sink sink;
    qdot_status status;

    QDOT_TRY(qdot_sink_open(&sink, path));
    status = write_all_rows(t, format, &sink, &text);
    qdot_text_clear(&text);
    if (status == QDOT_OK)
        return qdot_sink_close(&sink);
    qdot_sink_abandon(&sink);
    return status;
}

qdot_status
qdot_table_file(const qdot_dataset *t, unsigned where, const qdot_table_format *format, const char *path)
{
    qdot_dataset shown;
    qdot_status status = qdot_table_select(t, where, &shown);

    if (status == QDOT_OK)
        status = write_table(&shown, format, path);
    qdot_free(shown.columns);
    return status;
}
