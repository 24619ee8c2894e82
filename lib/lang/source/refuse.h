/* refuse.h -- errors and hints for characters that the language does not have. */
#ifndef QDOT_LANG_REFUSE_H
#define QDOT_LANG_REFUSE_H

#include <stddef.h>

#include "base/status.h"

/* Fail at the byte `at` of `text`: name the character, and hint at what to write. QDOT_ESYNTAX. */
qdot_status qdot_refuse(const char *text, size_t at);
/* Fail for a bracket at `open` that is never closed, with the corrected line as a hint. QDOT_ESYNTAX. */
qdot_status qdot_refuse_open(const char *text, size_t open);
/* Fail for a closing bracket without an opening one, with the line without it as a hint. QDOT_ESYNTAX. */
qdot_status qdot_refuse_close(const char *text, size_t close);
/* Fail for a text without closing quote, which opens at `open`. QDOT_ESYNTAX. */
qdot_status qdot_refuse_text(const char *text, size_t open);
/* Refuse a backslash inside a line, a command of LaTeX. QDOT_ESYNTAX. */
qdot_status qdot_refuse_backslash(const char *text, size_t at);

#endif
