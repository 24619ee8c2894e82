/* loop.h -- runs loops such as `for k = a..b, j = [1, 2, 5]`. */
#ifndef QDOT_LANG_LOOP_H
#define QDOT_LANG_LOOP_H

#include "lang/syntax/record.h"

typedef struct {
    char *name;
    const qdot_filled *behind; /* the part of the statement after the values of the index */
    bool listed;               /* the index runs over the values of a list; otherwise over the integers at..last */
    int64_t at, last;
    qdot_vec(qdot_expr) values;
    size_t next;
    bool held; /* the index is a declared parameter or coordinate, whose value is set for each pass of the loop */
} qdot_loop_index;

typedef struct {
    qdot_session *session;
    qdot_record *record;            /* holds the `for` clause; error_at of its cursor is the place of a failure */
    const qdot_filled *clause, *end; /* the parts clause ... end - 1 of the record, after the word `for` */
    qdot_vec(
        qdot_loop_index) indices; /* outermost first; each name is bound in session->names */
    bool open; /* counted in session->loops */
} qdot_loop;

enum { QDOT_LOOP_PASSES = 10000000 }; /* largest number of passes of one index */

/* Bind the indices to the first pass, then to the next; *more: there is such a pass. A
 * range may depend on the indices before it. After an error or the last pass nothing
 * is bound. The clause is the parts [clause, end) of the record: those behind the word `for`, as in
 * lang/syntax/loop-clause.h; the record must stay. */
QDOT_MUST_CHECK qdot_status qdot_loop_begin(qdot_loop *loop, qdot_record *record, const qdot_filled *clause,
                                            const qdot_filled *end, bool *more);
QDOT_MUST_CHECK qdot_status qdot_loop_next(qdot_loop *loop, bool *more);
/* Unbind all loop indices and free the loop. */
void qdot_loop_end(qdot_loop *loop);

#endif
