/* refuse.h -- what to say of bytes with which nothing of the language begins. */
#ifndef QDOT_LANG_REFUSE_H
#define QDOT_LANG_REFUSE_H

#include <stddef.h>

#include "base/status.h"

/* Fail at the byte `at` of `text`: what stands there, and what to write. QDOT_ESYNTAX. */
qdot_status qdot_refuse(const char *text, size_t at);
/* A bracket that `open` opens and nothing closes: its line with what is missing. QDOT_ESYNTAX. */
qdot_status qdot_refuse_open(const char *text, size_t open);
/* A closing bracket for which none is open: the line without it. QDOT_ESYNTAX. */
qdot_status qdot_refuse_close(const char *text, size_t close);
/* A text without its closing quote, which opens at `open`. QDOT_ESYNTAX. */
qdot_status qdot_refuse_text(const char *text, size_t open);
/* A backslash inside a line: LaTeX. QDOT_ESYNTAX. */
qdot_status qdot_refuse_backslash(const char *text, size_t at);

#endif
