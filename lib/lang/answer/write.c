/* write.c -- answers written: texts, as they stand or as JSON. */
#include "lang/answer/write.h"

#include <string.h>

#include "base/progress.h"

qdot_status
qdot_write(FILE *file, qdot_text *text)
{
    qdot_status status = qdot_text_status(text);

    qdot_progress_clear();
    if (status == QDOT_OK && fwrite(qdot_text_str(text), 1, text->n, file) != text->n)
        status = qdot_fail(QDOT_EIO, "standard output cannot be written");
    if (status == QDOT_OK && fflush(file) != 0)
        status = qdot_fail(QDOT_EIO, "standard output cannot be written");
    qdot_text_clear(text);
    return status;
}

FILE *
qdot_write_stream(const qdot_session *session)
{
    return session->out == session->pages ? session->screen : session->out;
}

bool
qdot_write_colours(const qdot_session *session)
{
    return (session->colours & QDOT_COLOURS_ANSWERS) != 0 &&
           (session->console == NULL || session->out == session->console);
}

void
qdot_write_field(qdot_text *line, const char *before, const char *text)
{
    qdot_text_add(line, before);
    qdot_text_json(line, text);
}

qdot_status
qdot_answer_text(qdot_session *session, const char *name, const char *text)
{
    qdot_text line = {0};
    size_t n = strlen(text);

    if (session->json) {
        qdot_write_field(&line, "{\"kind\":\"text\",\"name\":", name);
        qdot_write_field(&line, ",\"text\":", text);
        qdot_text_add(&line, "}\n");
    } else {
        qdot_text_add_n(&line, text, n);
        if (n == 0 || text[n - 1] != '\n')
            qdot_text_char(&line, '\n');
    }
    return qdot_write(session->out, &line);
}

qdot_status
qdot_answer_written(qdot_session *session, const char *name, qdot_status status,
                    qdot_text *text)
{
    if (status == QDOT_OK)
        status = qdot_text_status(text);
    if (status == QDOT_OK)
        status = qdot_answer_text(session, name, qdot_text_str(text));
    qdot_text_clear(text);
    return status;
}
