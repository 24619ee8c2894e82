/* runs.h -- the runs of a session by name; values at a time along one of them. */
#ifndef QDOT_LANG_RUNS_H
#define QDOT_LANG_RUNS_H

#include "lang/session/conditions.h"
#include "lang/session/measured.h"
#include "sim/course/report.h"
#include "sim/model/request.h"

/* Shared by the session and the states that `undo` keeps. */
typedef struct {
    char *name; /* name of the run: "a", "run1" */
    char *text; /* the statement without the name: "run 0..20 tol 1e-9" */
    qdot_run *run;
    uint64_t version; /* version of the scene as declared when the run was made */
    qdot_conditions *conditions; /* values under which the run was made; NULL: not recorded */
    unsigned *uses;
} qdot_named_run;
void qdot_named_run_release(qdot_named_run *run); /* count one use of the run less; the last one frees it */

typedef struct qdot_run_list {
    qdot_vec(qdot_named_run);
} qdot_run_list;

/* Find the run with that name; for NULL the latest run. QDOT_ENAME if there is none. */
QDOT_MUST_CHECK qdot_status qdot_runs_find(qdot_session *session, const char *name,
                                           qdot_named_run **run);
/* The same, for numbers along it: QDOT_EINVAL where a loop holds a parameter or a start at another value
 * than the run was made with. */
QDOT_MUST_CHECK qdot_status qdot_runs_read(qdot_session *session, const char *name,
                                           qdot_named_run **run);
/* Whether the session has a run with a name NAME[...]. */
bool qdot_runs_is_family(const qdot_session *session, const char *name);
/* Keep the run, made as `request` asked, under its name; an older one of that name goes. Takes
 * ownership of the run in any case. */
QDOT_MUST_CHECK qdot_status qdot_runs_keep(qdot_session *session, const char *name,
                                           const char *text,
                                           const qdot_run_request *request, qdot_run *run);
/* Remove run i of session->runs. */
void qdot_runs_drop(qdot_session *session, size_t i);
/* The index of the run with that name; session->runs->n if there is none. */
size_t qdot_runs_index(const qdot_session *session, const char *name);
/* Find the first unused name among run1, run2, ..., counting from the number of runs. */
void qdot_runs_next_name(const qdot_session *session, char *name, size_t size);

/* Append an expression, or the components of a vector or list, to columns. */
typedef qdot_vec(qdot_expr) qdot_runs_columns;
QDOT_MUST_CHECK qdot_status qdot_runs_flatten(qdot_session *session, qdot_expr e,
                                              qdot_runs_columns *columns);

/* Columns that name no run inside at a time, as numbers m [columns], in doubles or with the digits
 * of the run. */
QDOT_MUST_CHECK qdot_status qdot_runs_measure(qdot_session *session, const char *run,
                                              const qdot_runs_columns *columns,
                                              qdot_expr time, qdot_measured *m);
/* Evaluate one expression at a time of a single run, to the run's number of digits, or in doubles. */
QDOT_MUST_CHECK qdot_status qdot_runs_measure_one(qdot_session *session, const char *run,
                                                  qdot_expr e, qdot_expr time,
                                                  qdot_measured *m);

#endif
