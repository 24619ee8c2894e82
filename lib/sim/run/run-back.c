/* run-back.c -- reports the assumptions that a backward run has made about events. */
#include "sim/run/run-back.h"

static bool
has_occurred(const qdot_run *run, size_t event)
{
    for (size_t i = 0; i < run->course.occurrences.n; i++)
        if (run->course.occurrences.at[i].event == event)
            return true;
    return false;
}

qdot_status
qdot_run_back_tell(qdot_run *run)
{
    qdot_text *to = NULL;

    for (size_t i = 0; i < run->stage.events.n && run->stage.back; i++) {
        const qdot_staged_event *e = &run->stage.events.at[i];

        if (!e->undoing || !e->then || e->undoing->keeps_speed || e->way == 0 || !has_occurred(run, i))
            continue;
        if (to)
            qdot_text_add(to, ", ");
        else
            to = qdot_run_next_notice(run);
        qdot_text_format(to, "%.100s", e->name);
    }
    if (!to)
        return QDOT_OK;
    qdot_text_add(to, ": undone, back in time; the possibility that the motion crossed there the other way, without it, "
                      "is ignored");
    return qdot_text_status(to);
}
