/* write.c -- writes answers to their stream or page, as text or JSON. */
#include "lang/answer/write.h"

#include <inttypes.h>
#include <string.h>

#include "base/progress.h"
#include "base/sink.h"
#include "base/wrap.h"
#include "lang/answer/shown-text.h"
#include "lang/session/output.h"
#include "lang/session/typed.h"
#include "show/formula-page.h"

/* Write a finished text to the stream, or add it to the page that collects answers; then free it. */
static qdot_status
write_out(const qdot_session *session, FILE *file, qdot_text *text)
{
    const bool paged = session->output->page != NULL && file == session->output->out;
    qdot_status status = qdot_text_status(text);

    qdot_progress_clear();
    if (status == QDOT_OK && paged) {
        qdot_formula_page_text(session->output->page, qdot_text_str(text), text->n);
        status = session->output->page->status;
        qdot_text_clear(text);
        return status;
    }
    if (status == QDOT_OK && !qdot_sink_write_to(file, qdot_text_str(text), text->n))
        status = qdot_fail(QDOT_EIO, "standard output cannot be written");
    qdot_text_clear(text);
    return status;
}

size_t
qdot_write_width(const qdot_session *session, const FILE *file)
{
    size_t columns, rows;

    if (file != session->output->err && (file == session->output->console ? session->output->console_json : session->output->json))
        return 0;
    if (file == session->output->pages)
        file = session->output->screen;
    return qdot_terminal_size(file, &columns, &rows) ? columns : 0;
}

qdot_status
qdot_write(const qdot_session *session, FILE *file, qdot_text *text)
{
    const size_t width = qdot_write_width(session, file);
    qdot_text wrapped = {0};

    if (qdot_text_status(text) == QDOT_OK &&
        (width > 0 || strchr(qdot_text_str(text), QDOT_WRAP_CELL[0]) != NULL)) {
        qdot_wrap(qdot_text_str(text), width, &wrapped);
        qdot_text_clear(text);
        *text = wrapped;
    }
    return write_out(session, file, text);
}

qdot_status
qdot_write_object(const qdot_session *session, FILE *file, qdot_text *object)
{
    /* whether the object is an answer shown directly, not one that goes to a file by `to FILE` */
    const bool answer = session->output->console == NULL || file == session->output->console;

    if (qdot_text_status(object) == QDOT_OK && answer && session->typed->under_way) {
        qdot_text_truncate(object, object->n - strlen("}\n"));
        qdot_text_format(object, ",\"statement\":%zu,\"line\":%" PRIu32 "}\n", session->typed->number,
                         session->typed->line);
    }
    return qdot_write(session, file, object);
}

qdot_status
qdot_write_answer(const qdot_session *session, qdot_status status, qdot_text *object)
{
    if (status == QDOT_OK)
        status = qdot_write_object(session, session->output->out, object);
    qdot_text_clear(object);
    return status;
}

bool
qdot_write_displays(const qdot_session *session)
{
    const qdot_output *o = session->output;

    return o->display && o->json && (o->console == NULL || o->out == o->console);
}

FILE *
qdot_write_stream(const qdot_session *session)
{
    return session->output->out == session->output->pages ? session->output->screen : session->output->out;
}

bool
qdot_write_colours(const qdot_session *session)
{
    return (session->output->colours & QDOT_COLOURS_ANSWERS) != 0 &&
           (session->output->console == NULL || session->output->out == session->output->console);
}

void
qdot_write_field(qdot_text *line, const char *before, const char *text)
{
    qdot_text_add(line, before);
    qdot_text_json(line, text);
}

/* Write a text as an object of JSON; html: how it is typeset, or NULL. */
static qdot_status
write_text_object(qdot_session *session, const char *name, const char *text, const char *html)
{
    qdot_text line = {0}, plain = {0};

    qdot_wrap(text, 0, &plain);
    qdot_write_field(&line, "{\"kind\":\"text\",\"name\":", name);
    if (html != NULL)
        qdot_shown_fields(qdot_text_str(&plain), html, &line);
    else if (qdot_write_displays(session))
        qdot_shown_text("text", qdot_text_str(&plain), &line);
    else
        qdot_write_field(&line, ",\"text\":", qdot_text_str(&plain));
    qdot_text_add(&line, "}\n");
    line.failed = line.failed || plain.failed;
    qdot_text_clear(&plain);
    return qdot_write_object(session, session->output->out, &line);
}

static qdot_status
write_answer(qdot_session *session, const char *name, const char *text, bool drawn)
{
    qdot_text line = {0};
    size_t n = strlen(text);

    if (session->output->json)
        return write_text_object(session, name, text, NULL);
    qdot_text_add_n(&line, text, n);
    if (n == 0 || text[n - 1] != '\n')
        qdot_text_char(&line, '\n');
    return drawn ? write_out(session, session->output->out, &line) : qdot_write(session, session->output->out, &line);
}

qdot_status
qdot_answer_text(qdot_session *session, const char *name, const char *text)
{
    return write_answer(session, name, text, false);
}

qdot_status
qdot_answer_typeset(qdot_session *session, const char *name, const char *text, const char *html)
{
    return write_text_object(session, name, text, html);
}

/* Write a text if `status` is QDOT_OK; free it in any case. Returns the first failure. */
static qdot_status
write_and_clear_text(qdot_session *session, const char *name, qdot_status status, qdot_text *text, bool drawn)
{
    if (status == QDOT_OK)
        status = qdot_text_status(text);
    if (status == QDOT_OK)
        status = write_answer(session, name, qdot_text_str(text), drawn);
    qdot_text_clear(text);
    return status;
}

qdot_status
qdot_answer_written(qdot_session *session, const char *name, qdot_status status,
                    qdot_text *text)
{
    return write_and_clear_text(session, name, status, text, false);
}

qdot_status
qdot_answer_drawn(qdot_session *session, const char *name, qdot_status status, qdot_text *text)
{
    return write_and_clear_text(session, name, status, text, true);
}

qdot_status
qdot_answer_shown(qdot_session *session, const char *kind, const char *mime, const char *name, qdot_status status,
                  qdot_text *text)
{
    qdot_text line = {0};

    if (status == QDOT_OK)
        status = qdot_text_status(text);
    if (status == QDOT_OK) {
        qdot_write_field(&line, "{\"kind\":", kind);
        qdot_write_field(&line, ",\"mime\":", mime);
        qdot_write_field(&line, ",\"name\":", name);
        qdot_write_field(&line, ",\"data\":", qdot_text_str(text));
        qdot_text_add(&line, "}\n");
    }
    qdot_text_clear(text);
    return qdot_write_answer(session, status, &line);
}
