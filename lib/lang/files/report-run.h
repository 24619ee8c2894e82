/* report-run.h -- the runs on the page of a report: their facts, curves and animations. */
#ifndef QDOT_LANG_REPORT_RUN_H
#define QDOT_LANG_REPORT_RUN_H

#include "base/text.h"
#include "lang/session/parts.h"
#include "lang/session/runs.h"

enum { QDOT_REPORT_RUNS = 8 }; /* largest number of runs on one page, as a figure has so many line styles */

/* Append the sections of runs [n], 1 <= n <= QDOT_REPORT_RUNS: for each its facts and its report, of
 * several also a table; the course of every coordinate, all runs in one figure; a moving picture of each,
 * where things have places. Errors: those of qdot_animated_make. */
QDOT_MUST_CHECK qdot_status qdot_report_runs(qdot_session *session, size_t n,
                                             const qdot_named_run *const *runs,
                                             qdot_text *page);

#endif
