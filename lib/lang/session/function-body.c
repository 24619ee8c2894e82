/* function-body.c -- the body of a defined function: tokens of a source text, with a count of its users. */
#include "lang/session/function-body.h"

#include "lang/source/source.h"

qdot_function_body *
qdot_function_body_new(const qdot_source *source, const qdot_token *from,
                       const qdot_token *to)
{
    qdot_function_body *body = qdot_calloc(1, sizeof *body);

    if (body == NULL)
        return NULL;
    body->uses = 1;
    body->source = qdot_source_keep(source);
    body->from = from;
    body->to = to;
    return body;
}

qdot_function_body *
qdot_function_body_keep(qdot_function_body *body)
{
    if (body != NULL)
        body->uses++;
    return body;
}

void
qdot_function_body_release(qdot_function_body *body)
{
    if (body == NULL || --body->uses > 0)
        return;
    qdot_source_free(body->source);
    qdot_free(body->captured.at);
    qdot_free(body);
}
