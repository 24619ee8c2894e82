/* notice.c -- writes notices: each time, once in a session, or once in a statement. */
#include <stdarg.h>
#include <string.h>

#include "base/terminal.h"
#include "expr/print.h"
#include "lang/answer/answer.h"
#include "lang/session/evaluation.h"
#include "lang/session/output.h"
#include "lang/session/text-list.h"

enum { NOTICE = 4096 }; /* bytes of a notice at the most, with its end */

static qdot_status
write_notice(qdot_session *session, const char *message)
{
    FILE *const file = session->output->console != NULL ? session->output->console : session->output->out;
    const bool colours = qdot_write_colours(session);
    qdot_text line = {0};

    if (session->output->console != NULL ? session->output->console_json : session->output->json) {
        qdot_write_field(&line, "{\"kind\":\"notice\",\"message\":", message);
        qdot_text_add(&line, "}\n");
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
