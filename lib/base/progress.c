/* progress.c -- measures the progress of a long computation, and decides when to show it. */
#include "base/progress.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "base/clock.h"

_Thread_local qdot_progress *qdot_progress_open;

/* Times in seconds: before a line is first shown; between two lines; between two readings of the clock. */
static const double patience = 0.5, show_every = 0.1, look_every = 0.05;

void
qdot_progress_begin(double t0, double t1, const char *format, ...)
{
    qdot_progress *p = qdot_progress_open;
    va_list ap;

    if (!p)
        return;
    va_start(ap, format);
    vsnprintf(p->text, sizeof p->text, format, ap);
    va_end(ap);
    p->what = p->within[0] != '\0' ? p->within : p->text;
    p->t0 = p->t = t0;
    p->t1 = t1;
    p->steps = 0;
    p->pause = p->until = 1;
    p->begun = qdot_wall_now();
    if (!p->shown && p->opened == 0)
        p->opened = p->begun;
    p->speed = 0;
    p->left = NAN;
}

void
qdot_progress_within(const char *format, ...)
{
    qdot_progress *p = qdot_progress_open;
    va_list ap;

    if (!p)
        return;
    va_start(ap, format);
    vsnprintf(p->within, sizeof p->within, format, ap);
    va_end(ap);
}

void
qdot_progress_look(qdot_progress *p)
{
    const double at = qdot_wall_now(), spent = at - p->begun;
    const double done = (p->t - p->t0) / (p->t1 - p->t0);

    /* set the number of steps that take about look_every seconds, but do not change it suddenly */
    p->pause = spent > 0 ? (uint64_t)fmin(2.0 * (double)p->pause + 1,
                                          (double)p->steps * look_every / spent)
                         : 2 * p->pause;
    p->until = p->steps + (p->pause > 0 ? p->pause : 1);
    if (at - p->opened < patience || at - p->last < show_every)
        return;
    p->speed = spent > 0 ? (double)p->steps / spent : 0;
    p->left = done > 0 && spent > look_every ? spent * (1 - done) / done : NAN;
    p->shown = true;
    p->last = at;
    p->show(p);
}

void
qdot_progress_clear(void)
{
    qdot_progress *p = qdot_progress_open;

    if (!p)
        return;
    if (p->shown)
        p->clear();
    p->shown = false;
    p->opened = 0;
    p->within[0] = '\0';
}
