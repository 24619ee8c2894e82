/* report.h -- the report of a run, as text and as JSON. */
#ifndef QDOT_LANG_REPORT_H
#define QDOT_LANG_REPORT_H

#include "lang/session/parts.h"
#include "sim/course/report.h"

/* Answer {"kind":"run"}, the report of a run: its end state, errors and work. */
QDOT_MUST_CHECK qdot_status qdot_report_run(qdot_session *session, const char *name,
                                            const qdot_run_report *report);

#endif
