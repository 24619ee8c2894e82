/* system.h -- inside of lib/api: a session that answers calls instead of a person.
 *
 * A call begins with qdot_api_begin, which gives the session three streams in memory, and ends with
 * qdot_api_end, which keeps what was said. In between qdot_api_read carries out one text that is no
 * statement.
 *
 * Tests  tests/api/test_api.c, tests/meta/embed.test
 */
#ifndef QDOT_API_SYSTEM_H
#define QDOT_API_SYSTEM_H

#include <stdatomic.h>
#include <stdio.h>

#include "base/interrupt.h"
#include "base/progress.h"
#include "base/text.h"
#include "lang/language/cursor.h"
#include "qdot.h"

enum { QDOT_API_ANSWERS, QDOT_API_ERRORS, QDOT_API_NOTICES, QDOT_API_STREAMS };

struct qdot_system {
    qdot_session *session;
    atomic_size_t uses; /* number of holders: the caller, one for each motion and each function */
    struct {
        FILE *file; /* stream for output, open during a call */
        char *text; /* output of the latest call, from open_memstream; NULL: none */
        size_t length;
    } stream[QDOT_API_STREAMS];
    bool keeps_undo;  /* also when a call ends */
    char *source;     /* what errors call the text of qdot_system_ask(); NULL: ask */
    qdot_error error; /* failure of the latest call; QDOT_OK: none */
    qdot_interrupt interrupt; /* set by qdot_system_interrupt */
    struct {
        qdot_progress progress; /* first, so that what it is part of is found from it */
        qdot_progress_hook hook; /* NULL: nobody wants to know */
        void *data;
    } watcher;
    /* what the thread of a call had before it; a hook may call another system */
    qdot_interrupt *outer_interrupt;
    qdot_progress *outer_progress;
};

/* Begin a call of the library. If it returns QDOT_ENOMEM, qdot_api_end must still be called. */
QDOT_MUST_CHECK qdot_status qdot_api_begin(qdot_system *system);
/* End a call with this status and return it as a result; QDOT_ENOMEM if its messages found no memory. */
qdot_result qdot_api_end(qdot_system *system, qdot_status status);

/* Delete the records for `undo`, which would keep every past run in memory. */
void qdot_api_delete_undo_records(qdot_session *session);

/* The same for a call that returns a text: on success it becomes *out, the caller's; else it is cleared and *out is NULL. */
qdot_result qdot_api_end_with_text(qdot_system *system, qdot_status status, qdot_text *text, char **out);

/* Record the success of a call that needs neither begin nor end. */
qdot_result qdot_api_accept(qdot_system *system);
/* End a call at once because of a wrong argument, with the error message "CALL: what is wrong" (printf format). */
qdot_result qdot_api_refuse(qdot_system *system, const char *format, ...) QDOT_PRINTF(2, 3);

/* The type of a function that reads the tokens of a text, from the first to the last. */
typedef qdot_status (*qdot_api_reader)(qdot_cursor *c, void *data);
/* Let `reader` read the whole text; an error is reported as an error of the library call named `call`. */
QDOT_MUST_CHECK qdot_status qdot_api_read(qdot_system *system, const char *call, const char *text,
                                          qdot_api_reader reader, void *data);
/* For a reader: take a text that is a name, "a", "f[2]", as the language reads it. An error is then of no place in it. */
QDOT_MUST_CHECK qdot_status qdot_api_read_name(qdot_cursor *c, const char **name);

/* Count one user of the system less; the last one frees it. */
void qdot_api_release(qdot_system *system);

#endif
