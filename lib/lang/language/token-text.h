/* token-text.h -- writes tokens as a person would type them. */
#ifndef QDOT_LANG_TOKEN_TEXT_H
#define QDOT_LANG_TOKEN_TEXT_H

#include "base/text.h"
#include "lang/session/parts.h"
#include "lang/source/token.h"

/* The source text of the tokens [from, to), spaces as a person would set them; an index
 * of a loop under way is replaced by its value. */
void qdot_token_text(qdot_session *session, const qdot_token *from,
                     const qdot_token *to, qdot_text *out);
/* As qdot_token_text, but the names of loop indices are not replaced by their values. */
void qdot_token_text_written(qdot_session *session, const qdot_token *from,
                             const qdot_token *to, qdot_text *out);

#endif
