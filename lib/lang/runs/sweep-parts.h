/* sweep-parts.h -- a sweep between its statement (sweep.c) and the making of its rows (sweep-rows.c).
 */
#ifndef QDOT_LANG_SWEEP_PARTS_H
#define QDOT_LANG_SWEEP_PARTS_H

#include "lang/runs/columns.h"
#include "lang/runs/members.h"
#include "lang/session/row-tables.h"

typedef struct {
    qdot_cursor *c;
    qdot_members members;
    qdot_columns columns;
    const char *name;
    long threads;     /* processes at work at once; 0: as many as there are processors */
    const char *path; /* of the file that keeps the rows; NULL: none */
    const qdot_token *path_at;
    qdot_text said;   /* what it is known by in that file */
    qdot_row_table *table;
    bool *done;       /* [members] */
    size_t told;      /* rows that JSON has, the first of all */
    size_t n_done, failed, resumed; /* rows; of those that are done */
    bool interrupted;
    double kept_at, keeping; /* when the file was written last, how long that took */
    size_t row;              /* that is being made */
} qdot_sweep;

/* Make all rows of the empty table, but for those that the file has; after Ctrl-C those that are done
 * are left. */
QDOT_MUST_CHECK qdot_status qdot_sweep_make_rows(qdot_sweep *s);

#endif
