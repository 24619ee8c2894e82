/* statement-count.c -- counts typed statements, keeps their texts, and reports their ends in JSON. */
#include "lang/workbench/statement-count.h"

#include "lang/answer/write.h"
#include "lang/session/outcome.h"
#include "lang/session/output.h"
#include "lang/session/typed.h"

void
qdot_typed_begin(qdot_session *session, const qdot_source *source, size_t at)
{
    qdot_typed *typed = session->typed;
    uint32_t column;

    if (typed->texts != 1 || typed->under_way)
        return;
    typed->under_way = true;
    typed->number++;
    typed->refuted = session->outcome->refuted;
    session->outcome->refuted = false;
    if (session->output->json && source != NULL) /* only JSON answers contain the number of the statement */
        qdot_source_locate(source, at, &typed->line, &column);
}

/* The status of a statement for JSON: 0; 1 if it failed or refuted a check; 2 if it could not be parsed. */
static int
json_status(const qdot_session *session, qdot_status status)
{
    return status == QDOT_ESYNTAX ? 2 : status != QDOT_OK || session->outcome->refuted ? 1 : 0;
}

void
qdot_typed_end(qdot_session *session, const char *text, size_t length, qdot_status status)
{
    qdot_typed *typed = session->typed;
    qdot_text line = {0};

    if (typed->texts != 1 || !typed->under_way)
        return;
    if (status == QDOT_OK) {
        qdot_text_add_n(&typed->all, text, length);
        qdot_text_char(&typed->all, '\n');
    }
    if (typed->told) {
        qdot_text_format(&line, "{\"kind\":\"done\",\"statement\":%zu,\"status\":%d}\n", typed->number,
                         json_status(session, status));
        (void)!qdot_write(session, session->output->out, &line);
    }
    session->outcome->refuted = session->outcome->refuted || typed->refuted;
    typed->under_way = false;
}
