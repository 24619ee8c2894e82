/* unresolved-forces.c -- searches the steps of a run for forces that act only between the points evaluated. */
#include "sim/error/unresolved-forces.h"

#include "sim/bind/pulses.h"
#include "sim/course/reader.h"

typedef struct {
    qdot_disc_hiding hiding; /* kinds of forces that the method may have missed */
    const qdot_plan *plan;   /* plan whose tape is examined for such forces; NULL: none yet */
    qdot_trajectory_cursor *cursor;
    qdot_pulses pulses;
    size_t piece;
} search;

static qdot_status
read_stored_state(double t, double *y, void *user)
{
    search *s = user;

    return qdot_trajectory_read_piece(s->cursor, s->piece, t, y);
}

static qdot_status
begin_plan(search *s, const qdot_plan *plan)
{
    s->plan = plan;
    qdot_pulses_clear(&s->pulses);
    return qdot_pulses_init(&s->pulses, plan, plan->tape, s->hiding,
                            QDOT_CHEBYSHEV_MOST);
}

static qdot_status
search_steps(search *s, const qdot_course *course, bool *found, double *t)
{
    const qdot_trajectory *tr = &course->tr;

    for (size_t k = 0; k < tr->pieces.n && !*found; k++) {
        const qdot_trajectory_piece *p = tr->pieces.at + k;
        const size_t end = k + 1 < tr->pieces.n ? p[1].first : tr->count;
        const qdot_plan *plan = course->stage->modes.at[p->mode]->plan;

        if (!plan->tape || !qdot_disc_may_hide(plan->tape, s->hiding))
            continue;
        if (plan != s->plan)
            QDOT_TRY(begin_plan(s, plan));
        s->piece = k;
        for (size_t j = p->first; j + 1 < end && !*found; j++) {
            qdot_pulses_step step = {.a = tr->t[j],
                                     .b = tr->t[j + 1],
                                     .tol = tr->tol,
                                     .from = tr->y + j * tr->n,
                                     .to = tr->y + (j + 1) * tr->n,
                                     .read = tr->method->geometric ? NULL : read_stored_state,
                                     .user = s};

            QDOT_TRY(qdot_pulses_look(&s->pulses, &step));
            *found = step.missed;
            *t = step.t;
        }
    }
    return QDOT_OK;
}

qdot_status
qdot_unresolved_forces_find(const qdot_course *course, bool *found, double *t)
{
    const qdot_ode_method *method = course->tr.method;
    search s = {0};
    qdot_status status;
    const bool by_series = method && (method->series || course->tr.turns.n > 0);

    *found = false;
    if (!by_series && !(method && method->geometric))
        return QDOT_OK;
    s.hiding = by_series ? QDOT_HIDES_EXPONENTIALS : QDOT_HIDES_QUOTIENTS;
    status = qdot_trajectory_open(&course->tr, qdot_course_systems(course), &s.cursor);
    if (status == QDOT_OK)
        status = search_steps(&s, course, found, t);
    qdot_trajectory_close(s.cursor);
    qdot_pulses_clear(&s.pulses);
    return qdot_grave(status);
}
