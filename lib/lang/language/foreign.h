/* foreign.h -- recognises the syntax of other systems and of beginners, and suggests the line to
 * type (foreign.def). */
#ifndef QDOT_LANG_FOREIGN_H
#define QDOT_LANG_FOREIGN_H

#include "base/text.h"
#include "lang/language/cursor.h"

/* The statement [from, to) failed with the last error, at the byte c->error_at. Where its form is
 * in the table the error gets its message, caret and hint. Returns the error's status. */
qdot_status qdot_foreign_hint(qdot_cursor *c, const qdot_token *from,
                              const qdot_token *to);

/* A notice on a statement that was carried out and is seldom meant so, or NULL. The text is
 * valid until `text` is changed. */
const char *qdot_foreign_notice(const qdot_cursor *c, const qdot_token *from,
                                const qdot_token *to, qdot_text *text);

#endif
