/* notice.c -- tells of notices, each time, once in a session or once in a statement, of files and of errors. */
#include <inttypes.h>
#include <stdarg.h>
#include <string.h>

#include "base/sink.h"
#include "base/terminal.h"
#include "expr/print.h"
#include "lang/answer/answer.h"
#include "lang/answer/shown-text.h"
#include "lang/session/evaluation.h"
#include "lang/session/output.h"
#include "lang/session/text-list.h"
#include "lang/session/typed.h"
#include "lang/source/source.h"

enum { NOTICE = 4096 }; /* bytes of a notice at the most, with its end */

static qdot_status
write_notice(qdot_session *session, const char *message)
{
    FILE *const file = session->output->console != NULL ? session->output->console : session->output->out;
    const bool colours = qdot_write_colours(session);
    qdot_text line = {0}, said = {0};

    if (session->output->console != NULL ? session->output->console_json : session->output->json) {
        qdot_text_format(&said, "notice: %s", message);
        qdot_write_field(&line, "{\"kind\":\"notice\",\"message\":", message);
        if (session->output->display)
            qdot_shown_text("notice", qdot_text_str(&said), &line);
        qdot_text_add(&line, "}\n");
        line.failed = line.failed || said.failed;
        qdot_text_clear(&said);
        return qdot_write_object(session, file, &line);
    }
    qdot_text_format(&line, "%snotice:%s %s\n", colours ? QDOT_YELLOW : "", colours ? QDOT_COLOUR_END : "", message);
    return qdot_write(session, file, &line);
}

qdot_status
qdot_answer_notice(qdot_session *session, const char *format, ...)
{
    char message[NOTICE];
    va_list ap;

    va_start(ap, format);
    vsnprintf(message, sizeof message, format, ap);
    va_end(ap);
    return write_notice(session, message);
}

qdot_status
qdot_answer_notice_of(qdot_session *session, const char *format, qdot_expr e)
{
    qdot_text text = {0};
    qdot_status status = qdot_print(session->pool, e, QDOT_PLAIN, &text);

    if (status == QDOT_OK)
        status = qdot_answer_notice(session, format, qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

/* Give the notice and add it to the list `told`, unless it is in the list already; NULL: give it always. */
static qdot_status
give_notice_once(qdot_session *session, qdot_text_list *told, const char *message)
{
    char *copy;

    if (told == NULL)
        return write_notice(session, message);
    for (size_t i = 0; i < told->n; i++)
        if (strcmp(told->at[i], message) == 0)
            return QDOT_OK;
    copy = qdot_strdup(message);
    if (copy == NULL)
        return QDOT_ENOMEM;
    if (qdot_vec_push(told, copy) != QDOT_OK) {
        qdot_free(copy);
        return QDOT_ENOMEM;
    }
    return write_notice(session, message);
}

/* If `status` is QDOT_OK give the text as a notice, as give_notice_once does; free it. */
static qdot_status
give_text_once(qdot_session *session, qdot_text_list *told, qdot_status status, qdot_text *text)
{
    if (status == QDOT_OK)
        status = qdot_text_status(text);
    if (status == QDOT_OK)
        status = give_notice_once(session, told, qdot_text_str(text));
    qdot_text_clear(text);
    return status;
}

qdot_status
qdot_answer_notice_text(qdot_session *session, qdot_status status, qdot_text *text)
{
    return give_text_once(session, NULL, status, text);
}

qdot_status
qdot_answer_notice_once_text(qdot_session *session, qdot_status status, qdot_text *text)
{
    return give_text_once(session, session->told, status, text);
}

qdot_status
qdot_answer_condition_text(qdot_session *session, qdot_status status, qdot_text *text)
{
    return give_text_once(session, &session->evaluation->told, status, text);
}

qdot_status
qdot_answer_notice_once(qdot_session *session, const char *format, ...)
{
    char message[NOTICE];
    va_list ap;

    va_start(ap, format);
    vsnprintf(message, sizeof message, format, ap);
    va_end(ap);
    return give_notice_once(session, session->told, message);
}

qdot_status
qdot_answer_condition(qdot_session *session, const char *format, ...)
{
    char message[NOTICE];
    va_list ap;

    va_start(ap, format);
    vsnprintf(message, sizeof message, format, ap);
    va_end(ap);
    return give_notice_once(session, &session->evaluation->told, message);
}

/* --- files and errors ------------------------------------------------------------------ */

qdot_status
qdot_answer_file(qdot_session *session, const char *path)
{
    qdot_text line = {0}, said = {0};

    qdot_text_format(&said, "wrote %s\n", path);
    if (!session->output->json)
        return qdot_write(session, session->output->out, &said);
    qdot_write_field(&line, "{\"kind\":\"file\",\"path\":", path);
    if (qdot_write_displays(session))
        qdot_shown_text("file", qdot_text_str(&said), &line);
    qdot_text_add(&line, "}\n");
    line.failed = line.failed || said.failed;
    qdot_text_clear(&said);
    return qdot_write_answer(session, QDOT_OK, &line);
}

qdot_status
qdot_answer_in_file(qdot_session *session, const char *path, const qdot_text *text)
{
    QDOT_TRY(qdot_text_status(text));
    QDOT_TRY(qdot_sink_write(path, qdot_text_str(text), text->n));
    return qdot_answer_file(session, path);
}

static void
write_error_as_json(qdot_session *session, const qdot_source *source, size_t at,
                    const qdot_error *error, const char *report)
{
    qdot_text line = {0};
    uint32_t number = 0, column = 0;

    qdot_text_add(&line, "{\"kind\":\"error\",\"file\":");
    if (source != NULL) {
        qdot_source_locate(source, at, &number, &column);
        qdot_text_json(&line, source->name);
        qdot_text_format(&line, ",\"line\":%u,\"column\":%u", number, column);
    } else {
        qdot_text_add(&line, "null,\"line\":null,\"column\":null");
    }
    qdot_write_field(&line, ",\"message\":", error->message);
    qdot_text_add(&line, ",\"hint\":");
    if (error->hint[0] != '\0')
        qdot_text_json(&line, error->hint);
    else
        qdot_text_add(&line, "null");
    if (session->output->display)
        qdot_shown_text("error", report, &line);
    if (session->typed->under_way)
        qdot_text_format(&line, ",\"statement\":%zu", session->typed->number);
    qdot_text_add(&line, "}\n");
    (void)!qdot_write(session, session->output->out, &line);
}

/* Write the error as a person reads it: its place, the line with a caret below it, the hint. */
static void
write_report(const qdot_source *source, size_t at, const qdot_error *error, bool colours, size_t width, qdot_text *text)
{
    if (source != NULL) {
        qdot_source_report(source, at, error, colours, width, text);
        return;
    }
    qdot_text_format(text, "%serror:%s %s\n", colours ? QDOT_RED : "", colours ? QDOT_COLOUR_END : "", error->message);
    if (error->hint[0] != '\0')
        qdot_text_format(text, "%shint:%s %s\n", colours ? QDOT_CYAN : "", colours ? QDOT_COLOUR_END : "", error->hint);
}

void
qdot_answer_error(qdot_session *session, const qdot_source *source, size_t at)
{
    qdot_error error = *qdot_last_error(); /* copied, since the statements below may fail too */
    const bool colours = (session->output->colours & QDOT_COLOURS_ERRORS) != 0;
    qdot_text text = {0};

    write_report(source, at, &error, colours, qdot_write_width(session, session->output->err), &text);
    fflush(session->output->out);
    if (qdot_write(session, session->output->err, &text) != QDOT_OK)
        fprintf(session->output->err, "error: %s\n", error.message); /* out of memory: print at least the message */
    if (session->output->json) {
        write_report(source, at, &error, false, 0, &text);
        write_error_as_json(session, source, at, &error, qdot_text_str(&text));
        qdot_text_clear(&text);
    }
    (void)qdot_fail_again(&error);
}
