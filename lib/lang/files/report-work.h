/* report-work.h -- work and precision on the page of a report. */
#ifndef QDOT_LANG_REPORT_WORK_H
#define QDOT_LANG_REPORT_WORK_H

#include "lang/session/session.h"

/* Measure every method over a ladder of tolerances, with the session's present values and start over the
 * time of a run; append a figure of error against time and a table. Errors: those of
 * qdot_request_fill and qdot_workprecision_measure. */
QDOT_MUST_CHECK qdot_status qdot_report_work(qdot_session *session,
                                             const qdot_run_report *report,
                                             qdot_text *page);

#endif
