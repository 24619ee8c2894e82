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
    qdot_cursor *c; /* cursor of `record` */
    qdot_members members;
    qdot_columns columns;
    const char *name;
    int64_t threads;     /* number of parallel processes; 0: one for each processor */
    const char *path; /* name of the file that stores the rows; NULL: none */
    const qdot_token *path_at;
    qdot_file_lock lock; /* lock of that file */
    qdot_text said;   /* text by which the file identifies the sweep: its statement, a hash of the scene */
    qdot_row_table *table;
    bool *done;       /* [members] whether the row of this run of the sweep is complete */
    size_t told;      /* number of rows already written as JSON */
    size_t n_done, failed, resumed; /* numbers of complete rows, of failed rows, and of rows taken from the file */
    bool interrupted;
    double kept_at, keeping; /* time of the last write to the file, and the duration of that write */
    size_t row;              /* index of the row that is being made */
    struct qdot_sweep_lanes *lanes; /* makes several rows at once in vector lanes; NULL: not used */
} qdot_sweep;

/* What a sweep would do, in words: its members, whether they go by lanes, and, from a few of them that
 * are run, how long it takes; s as for qdot_sweep_make_rows. */
QDOT_MUST_CHECK qdot_status qdot_sweep_tell_plan(qdot_sweep *s, qdot_text *text);

/* Carry out the statement `plan sweep ...`. */
QDOT_MUST_CHECK qdot_status qdot_sweep_plan(qdot_record *r);

/* Make row k of the table in this process. A failure such as QDOT_EFAILED concerns that row only. */
QDOT_MUST_CHECK qdot_status qdot_sweep_fill_row(qdot_sweep *s, size_t k);

/* Make all rows of the empty table, but for those that the file has; after Ctrl-C those that are done
 * are left. */
QDOT_MUST_CHECK qdot_status qdot_sweep_make_rows(qdot_sweep *s);

#endif
