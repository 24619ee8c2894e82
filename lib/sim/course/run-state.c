/* run-state.c -- records in a run why it ended, and why its error is unknown. */
#include "sim/course/run-state.h"

qdot_text *
qdot_run_next_notice(qdot_run *run)
{
    if (run->notice.n > 0)
        qdot_text_char(&run->notice, '\n');
    return &run->notice;
}

qdot_status
qdot_run_say_why(qdot_run *run, const char *reason)
{
    run->report.status = QDOT_RUN_FAILED;
    run->reason = qdot_strdup(reason);
    run->report.reason = run->reason;
    return run->reason ? QDOT_OK : QDOT_ENOMEM;
}

qdot_status
qdot_run_say_doubt(qdot_run *run, const char *doubt)
{
    qdot_free(run->doubt);
    run->doubt = qdot_strdup(doubt);
    return run->doubt ? QDOT_OK : QDOT_ENOMEM;
}

qdot_status
qdot_run_say_course(qdot_run *run)
{
    const qdot_course *c = &run->course;

    if (c->stopped_by != SIZE_MAX) {
        char reason[200];

        snprintf(reason, sizeof reason, "the event %.150s",
                 run->stage.events.at[c->stopped_by].name);
        QDOT_TRY(qdot_run_say_why(run, reason));
        run->report.status = QDOT_RUN_STOPPED;
        return QDOT_OK;
    }
    return c->reason[0] != '\0' ? qdot_run_say_why(run, c->reason) : QDOT_OK;
}
