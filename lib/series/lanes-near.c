/* lanes-near.c -- arguments of exponentials, and divisors, of one lane of a program. */
#include "series/lanes-near.h"

#include "series/near.h"

static bool
may_hide(int op)
{
    return qdot_recurrence_exponential(op) > 0 || qdot_recurrence_divisor(op);
}

bool
qdot_lanes_may_hide(const qdot_lanes *lanes)
{
    const qdot_program *p = qdot_lanes_program(lanes);

    for (size_t i = p->still; i < p->length; i++)
        if (may_hide(p->steps.at[i].op))
            return true;
    return false;
}

/* The series of a row in a lane, side by side. */
static void
take_series(const qdot_lanes_rows *rows, qdot_program_row row, size_t lane, int p, double *x)
{
    const double *from = rows->coefficients + row * rows->stride * rows->group + lane;

    for (int k = 0; k <= p; k++)
        x[k] = from[(size_t)k * rows->group];
}

static double
near_divisor(const qdot_lanes_rows *rows, const qdot_program_step *step, size_t lane, int p,
             double s)
{
    const char which = qdot_recurrence_divisor(step->op);
    double b[QDOT_SERIES_MOST + 1], quotient[QDOT_SERIES_MOST + 1];

    take_series(rows, which == 'x' ? step->x : which == 'y' ? step->y : step->z, lane, p, b);
    if (!qdot_near_may_fall(p, b, s))
        return s;
    if (step->op == QDOT_T_DIV) {
        take_series(rows, step->to, lane, p, quotient);
        if (!qdot_near_diverges(p, quotient, s))
            return s;
    }
    return qdot_near_divisor(p, b, step->op == QDOT_T_SQRT, s);
}

double
qdot_lanes_near(qdot_lanes *lanes, size_t lane, int p, double s, double least)
{
    const qdot_lanes_rows rows = qdot_lanes_get_rows(lanes);

    for (size_t i = rows.program->still; i < rows.program->length; i++) {
        const qdot_program_step *step = rows.program->steps.at + i;
        const double times = qdot_recurrence_exponential(step->op);
        double u[QDOT_SERIES_MOST + 1];

        if (!may_hide(step->op))
            continue;
        if (times > 0) {
            take_series(&rows, step->x, lane, p, u);
            s = qdot_near_taken(s, qdot_near_argument(p, u, times, s), QDOT_NEAR_FINER * least);
        } else {
            s = qdot_near_taken(s, near_divisor(&rows, step, lane, p, s), least);
        }
    }
    return s;
}
