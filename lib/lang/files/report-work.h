/* report-work.h -- adds the work-precision study of a run to the page of a report. */
#ifndef QDOT_LANG_REPORT_WORK_H
#define QDOT_LANG_REPORT_WORK_H

#include "base/text.h"
#include "lang/session/parts.h"
#include "lang/session/runs.h"

/* Append, for runs [n], a figure of error against time and a table: every method over a ladder of
 * tolerances, with the values, the start and the limits of the run. A study that was made of these is
 * taken again, and runs that differ in method and tolerance only share one. Errors: those of
 * qdot_workprecision_measure. */
QDOT_MUST_CHECK qdot_status qdot_report_work(qdot_session *session, size_t n,
                                             const qdot_named_run *const *runs,
                                             qdot_text *page);

#endif
