/* loop.h -- runs loops such as `for k = a..b, j = [1, 2, 5]`. */
#ifndef QDOT_LANG_LOOP_H
#define QDOT_LANG_LOOP_H

#include "lang/language/cursor.h"
#include "lang/source/token.h"

typedef struct {
    char *name;
    const qdot_token *behind; /* the token after the index's range */
    bool listed;              /* the index runs over a list; otherwise over at..last */
    long at, last;
    qdot_vec(qdot_expr) values;
    size_t next;
    bool held; /* the index is a declared parameter or coordinate, set for each pass */
} qdot_loop_index;

typedef struct {
    qdot_session *session;
    const qdot_source *source;
    const qdot_token *clause, *end; /* the first token after `for`; the token after the clause */
    qdot_vec(
        qdot_loop_index) indices; /* outermost first; each name is bound in session->names */
    size_t error_at;
    bool open; /* counted in session->loops */
} qdot_loop;

enum { QDOT_LOOP_PASSES = 10000000 }; /* largest number of passes of one index */

/* Bind the indices to the first pass, then to the next; *more: there is such a pass. A
 * range may depend on the indices before it. After an error or the last pass nothing
 * is bound. The clause at the cursor goes to `end`; NULL: to the end of the statement. */
QDOT_MUST_CHECK qdot_status qdot_loop_begin(qdot_loop *loop, const qdot_cursor *c,
                                            const qdot_token *end, bool *more);
QDOT_MUST_CHECK qdot_status qdot_loop_next(qdot_loop *loop, bool *more);
/* Unbind all loop indices and free the loop. */
void qdot_loop_end(qdot_loop *loop);

#endif
