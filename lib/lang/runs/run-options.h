/* run-options.h -- limits and options of a run, in `run`, `plan`, `sweep`, `poincare` and `find`. */
#ifndef QDOT_LANG_RUN_OPTIONS_H
#define QDOT_LANG_RUN_OPTIONS_H

#include "base/text.h"
#include "lang/runs/request.h"
#include "lang/session/trial.h"
#include "lang/syntax/record.h"
#include "sim/model/request.h"

/* The options of a run as text, for the usage texts of statements, except for the name of the run. */
#define QDOT_RUN_USAGE "[tol E | digits N] " QDOT_RUN_USAGE_OTHERS
#define QDOT_RUN_USAGE_OTHERS                                                            \
    "[method NAME] [with NAME = VALUE, ...] [constraints project|baumgarte|none]"

typedef struct {
    qdot_expr from, to;
    double tol;
    int64_t digits; /* requested number of digits; 0: the run is computed in doubles */
    const char *method, *name;
    const qdot_token *method_at;
    qdot_run_treatment treatment;
    qdot_pairs with;
    qdot_text text; /* text of the statement without its name */
} qdot_run_options;

/* What the parts [from, to) of a statement say: limits, where they begin with T0..T1, options and
 * a name. From {.tol = 1e-12}; free it in any case. */
QDOT_MUST_CHECK qdot_status qdot_run_options_find(qdot_record *r, const qdot_filled *from,
                                                  const qdot_filled *to, qdot_run_options *o);
/* Whether the option `with` gives a start value. */
bool qdot_run_options_name_start(const qdot_pool *pool, const qdot_run_options *o);
/* Set the session's values to those of the option `with`; the caller saves and restores them. */
QDOT_MUST_CHECK qdot_status qdot_run_options_put(qdot_session *session, const qdot_run_options *o);
/* The request of the present values, those of `with` in place of them, of these options, and of the
 * limits from..to, which may hold such values. */
QDOT_MUST_CHECK qdot_status qdot_run_options_fill(qdot_session *session, const qdot_run_options *o,
                                                  qdot_expr from, qdot_expr to,
                                                  qdot_request *request);
/* Make a run with these options as a trial: it is the latest run until the trial ends. QDOT_EFAILED: it failed. */
QDOT_MUST_CHECK qdot_status qdot_run_options_try(qdot_trial *trial, const qdot_run_options *o, qdot_expr from,
                                                 qdot_expr to);
void qdot_run_options_free(qdot_run_options *o);
/* Set the place of an error with that status: at the method's name (NULL: none was given) if it is unknown or not built. */
void qdot_run_options_place(qdot_cursor *c, const qdot_token *method, qdot_status status);

#endif
