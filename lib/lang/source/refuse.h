/* refuse.h -- refuses characters that the language does not have, with error messages and hints. */
#ifndef QDOT_LANG_REFUSE_H
#define QDOT_LANG_REFUSE_H

#include <stddef.h>

#include "base/status.h"

/* Fail with QDOT_ESYNTAX because of the character at byte `at` of `text`: name it, and hint at what to write. */
qdot_status qdot_refuse(const char *text, size_t at);
/* Fail because the bracket at `open` is never closed, with the corrected line as a hint. QDOT_ESYNTAX. */
qdot_status qdot_refuse_open(const char *text, size_t open);
/* Fail because of a closing bracket without an opening one, with the line without it as a hint. QDOT_ESYNTAX. */
qdot_status qdot_refuse_close(const char *text, size_t close);
/* Fail because the quoted text that begins at `open` has no closing quote. QDOT_ESYNTAX. */
qdot_status qdot_refuse_text(const char *text, size_t open);
/* Refuse a backslash inside a line, a command of LaTeX. QDOT_ESYNTAX. */
qdot_status qdot_refuse_backslash(const char *text, size_t at);

#endif
