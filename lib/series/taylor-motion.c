/* taylor-motion.c -- stages of a motion, and what follows when its unknowns are found. */
#include "series/taylor-motion.h"

#include "series/taylor-steps.h"

qdot_status
qdot_taylor_of_motion(const qdot_motion *motion, bool shaken, int most,
                      qdot_taylor **taylor)
{
    qdot_taylor *t = NULL;
    qdot_status status;

    *taylor = NULL;
    if (most < 0 || most + 1 > QDOT_SERIES_MOST)
        return qdot_fail(QDOT_EINVAL, "an order of %d is out of range", most);
    t = qdot_calloc(1, sizeof *t);
    if (!t)
        return QDOT_ENOMEM;
    t->motion = motion;
    status = qdot_taylor_settle(t, &motion->program, most + 1, 0, motion->program.length,
                                shaken);
    if (status == QDOT_OK)
        status = qdot_taylor_follow_motion(t);
    if (status != QDOT_OK) {
        qdot_taylor_free(t);
        return status;
    }
    *taylor = t;
    return QDOT_OK;
}

void
qdot_taylor_set_unit(qdot_taylor *t, double unit)
{
    t->unit = unit;
    for (size_t i = 0; i < t->length; i++)
        if (t->steps[i].op == QDOT_T_RATE)
            t->steps[i].c = 1 / unit;
}

const double *
qdot_taylor_series(const qdot_taylor *t, qdot_program_row row)
{
    return qdot_taylor_place(t, row);
}

/* Order k of an integral is so much of order k - 1 of what it is of. */
static double
part(const qdot_taylor *t, int k)
{
    return t->unit / k;
}

static void
clear(const qdot_taylor *t, qdot_program_row row, int k)
{
    if (row != QDOT_NO_ROW)
        qdot_taylor_place(t, row)[k] = 0;
}

void
qdot_taylor_stage(qdot_taylor *t, int k)
{
    const qdot_motion *m = t->motion;

    for (size_t i = 0; i < m->solved.n && k >= 0; i++) {
        const qdot_motion_unknown *u = m->unknowns.at + m->solved.at[i];

        clear(t, u->row, k);
        clear(t, u->once, k + 1);
        clear(t, u->twice, k + 2);
    }
    qdot_taylor_order_leading(t, k);
    for (size_t i = 0; i < m->unknowns.n && k >= 0; i++) {
        const qdot_motion_unknown *u = m->unknowns.at + i;
        double *once = qdot_taylor_place(t, u->once),
               *twice = qdot_taylor_place(t, u->twice);

        if (u->value == QDOT_NO_ROW || !once)
            continue;
        once[k + 1] = part(t, k + 1) * qdot_taylor_place(t, u->value)[k];
        if (twice)
            twice[k + 2] = part(t, k + 2) * once[k + 1];
    }
}

void
qdot_taylor_change(qdot_taylor *t, int k, const double *by)
{
    const qdot_motion *m = t->motion;

    for (size_t i = 0; i < m->solved.n; i++) {
        const qdot_motion_unknown *u = m->unknowns.at + m->solved.at[i];
        const double once = t->unit * by[i] / (k + 1), twice = t->unit * once / (k + 2);

        if (u->row != QDOT_NO_ROW)
            qdot_taylor_change_row(t, qdot_taylor_place(t, u->row), k, by[i]);
        if (u->once != QDOT_NO_ROW)
            qdot_taylor_change_row(t, qdot_taylor_place(t, u->once), k + 1, once);
        if (u->twice != QDOT_NO_ROW)
            qdot_taylor_change_row(t, qdot_taylor_place(t, u->twice), k + 2, twice);
    }
    qdot_taylor_follow(t, k);
}

qdot_lanes_rows
qdot_taylor_get_rows(const qdot_taylor *t)
{
    return (qdot_lanes_rows){&t->motion->program, t->coefficients, t->stride, 1};
}

void
qdot_taylor_set_inverses(const qdot_taylor *t)
{
    double *inverse = t->coefficients + t->rows * t->stride;

    for (size_t i = 0; i < t->length; i++)
        inverse[i] = t->steps[i].c;
}
