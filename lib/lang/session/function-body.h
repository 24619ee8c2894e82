/* function-body.h -- the text of a function's body, or of the right side of a definition, with a
 * count of its users. */
#ifndef QDOT_LANG_FUNCTION_BODY_H
#define QDOT_LANG_FUNCTION_BODY_H

#include "lang/source/token.h"

typedef struct qdot_function_body {
    unsigned uses;
    qdot_source *source;             /* the source text, which is kept as long as the body */
    const qdot_token *from, *to;     /* the tokens from ... to - 1 of the body */
    qdot_vec(const char *) captured; /* names of the loop indices around the definition */
} qdot_function_body;

/* A function body: the tokens [from, to) of a source, with reference count 1; NULL if out of memory. */
qdot_function_body *qdot_function_body_new(const qdot_source *source, const qdot_token *from,
                                           const qdot_token *to);
qdot_function_body *qdot_function_body_keep(qdot_function_body *body); /* count one more use; NULL gives NULL */
void qdot_function_body_release(qdot_function_body *body);    /* count one use less; the last one frees it */

#endif
