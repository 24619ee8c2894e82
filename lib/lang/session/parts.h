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
    /* From here on: fields that the statement `reset` clears. */
    qdot_pool *pool;
    struct qdot_scene *scene;              /* the declared scene: mech/scene/things.h */
    struct qdot_names *names;              /* declared and defined names: names.h */
    struct qdot_values *values;            /* values given by `set`, `start`, `scale`: values.h */
    struct qdot_history *history;          /* answers %1, %2, ...: history.h */
    struct qdot_run_list *runs;            /* the runs by name: runs.h */
    struct qdot_row_table_list *tables;    /* tables of many runs by name: row-tables.h */
    struct qdot_kept_studies *studies;     /* stored studies of work and precision: conditions.h */
    struct qdot_measured_list *measured;   /* numbers from runs used in expressions: measured.h */
    struct qdot_member_list *members; /* values a.EXPR along runs used in expressions: member.h */
    struct qdot_evaluation *evaluation;    /* state of the present statement: evaluation.h */
    struct qdot_units *units;              /* what is known of dimensions: units.h */
    struct qdot_text_list *told;           /* notices that are given only once: text-list.h */
    struct qdot_text_list *remarks;        /* lines with remarks of files of sessions that were read
                                              (lang/declare/session-remarks.h) */
    /* From here on: fields that the statement `reset` keeps. */
    struct qdot_output *output;            /* streams and form of answers: output.h */
    struct qdot_outcome *outcome;          /* results of all statements so far: outcome.h */
    struct qdot_typed *typed;              /* the present statement and all before it: typed.h */
    struct qdot_text_list *including; /* files being read, to detect cycles and resolve relative paths */
    struct qdot_undo *undo;                /* records for `undo`; NULL: no statement yet */
    void (*undo_free)(struct qdot_undo *undo); /* frees `undo`; set together with it */
} qdot_session;

#endif
