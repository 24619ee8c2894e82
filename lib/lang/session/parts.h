/* parts.h -- a session by its parts, each of which has a header of its own.
 *
 * A session reads statements from sources (scripts, -e texts, prompt lines) and writes answers.
 * Who uses a part includes its header beside this one, so that a part may change without
 * all other files being compiled again. lang/session/session.h begins and ends a session.
 */
#ifndef QDOT_LANG_PARTS_H
#define QDOT_LANG_PARTS_H

#include "expr/id.h"

typedef struct qdot_session {
    /* Fields that `reset` clears. */
    qdot_pool *pool;
    struct qdot_scene *scene;              /* mech/scene/things.h */
    struct qdot_names *names;              /* names.h */
    struct qdot_values *values;            /* of `set`, `start`, `scale`: values.h */
    struct qdot_history *history;          /* %1, %2, ...: history.h */
    struct qdot_run_list *runs;            /* runs.h */
    struct qdot_row_table_list *tables;    /* of many runs: row-tables.h */
    struct qdot_kept_studies *studies;     /* of work and precision: conditions.h */
    struct qdot_measured_list *measured;   /* numbers of runs within expressions: measured.h */
    struct qdot_member_list *members;      /* a.EXPR within expressions: member.h */
    struct qdot_evaluation *evaluation;    /* of the present statement: evaluation.h */
    struct qdot_text_list *told;           /* notices that are given once: text-list.h */
    struct qdot_text_list *remarks;        /* lines with remarks of files of sessions that were read
                                              (lang/declare/session-remarks.h) */
    /* Fields that `reset` keeps. */
    struct qdot_output *output;            /* where answers go, and in what form: output.h */
    struct qdot_outcome *outcome;          /* of what was read so far: outcome.h */
    struct qdot_typed *typed;              /* the statement under way, and all before it: typed.h */
    struct qdot_text_list *including;      /* files being read, for include cycles and relative paths */
    struct qdot_undo *undo;                /* NULL: no statement yet */
    void (*undo_free)(struct qdot_undo *undo); /* set with it */
} qdot_session;

#endif
