/* session.h -- creates and frees a session. Its parts: lang/session/parts.h. */
#ifndef QDOT_LANG_SESSION_H
#define QDOT_LANG_SESSION_H

#include <stdio.h>

#include "base/text.h"
#include "lang/session/parts.h"
#include "table/csv-read.h"

qdot_session *qdot_session_new(FILE *out, FILE *err); /* returns NULL if memory runs out */
void qdot_session_free(qdot_session *session);

/* Append the path of a file that is read, `name` as the present script says it: "dir/other.lag" for
 * "other.lag" in "dir/this.lag". */
void qdot_session_path(const qdot_session *session, const char *name, qdot_text *path);
/* Read a file of data, `name` as in qdot_session_path. Errors: those of qdot_csv_read. */
QDOT_MUST_CHECK qdot_status qdot_session_read_csv(const qdot_session *session, const char *name, qdot_csv *csv);
/* Exchange, between two sessions, everything that `reset` forgets; settings such as style and files stay. */
void qdot_session_exchange(qdot_session *session, qdot_session *other);

#endif
