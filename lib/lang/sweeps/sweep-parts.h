/* sweep-parts.h -- a sweep between its statement (sweep.c) and the making of its rows (sweep-rows.c).
 */
#ifndef QDOT_LANG_SWEEP_PARTS_H
#define QDOT_LANG_SWEEP_PARTS_H

#include "base/file-lock.h"
#include "lang/sweeps/columns.h"
#include "lang/sweeps/members.h"
#include "lang/session/row-tables.h"

typedef struct {
    qdot_record *record;
    qdot_cursor *c; /* of it */
    qdot_members members;
    qdot_columns columns;
    const char *name;
    long threads;     /* processes at work at once; 0: as many as there are processors */
    const char *path; /* of the file that keeps the rows; NULL: none */
    const qdot_token *path_at;
    qdot_file_lock lock; /* of it */
    qdot_text said;   /* the text by which the file identifies the sweep */
    qdot_row_table *table;
    bool *done;       /* [members] */
    size_t told;      /* rows that JSON has, the first of all */
    size_t n_done, failed, resumed; /* rows; of those that are done */
    bool interrupted;
    double kept_at, keeping; /* when the file was written last, how long that took */
    size_t row;              /* the row that is being made */
    struct qdot_sweep_lanes *lanes; /* that make rows side by side; NULL: none */
} qdot_sweep;

/* What a sweep would do, in words: its members, whether they go by lanes, and, from a few of them that
 * are run, how long it takes; s as for qdot_sweep_make_rows. */
QDOT_MUST_CHECK qdot_status qdot_sweep_tell_plan(qdot_sweep *s, qdot_text *text);

/* Carry out the statement `plan sweep ...`. */
QDOT_MUST_CHECK qdot_status qdot_sweep_plan(qdot_record *r);

/* Make row k of the table in this process. Failures such as QDOT_EFAILED concern this row. */
QDOT_MUST_CHECK qdot_status qdot_sweep_fill_row(qdot_sweep *s, size_t k);

/* Make all rows of the empty table, but for those that the file has; after Ctrl-C those that are done
 * are left. */
QDOT_MUST_CHECK qdot_status qdot_sweep_make_rows(qdot_sweep *s);

#endif
