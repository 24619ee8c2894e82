/* lanes-near.c -- finds, in each vector lane, where arguments of exponentials or divisors limit a step. */
#include "series/lanes-near.h"

#include <math.h>
#include <string.h>

#include "series/near.h"

enum { L = QDOT_LANES };

static bool
may_hide_short_forces(int op)
{
    return qdot_recurrence_exponential(op) > 0 || qdot_recurrence_divisor(op);
}

bool
qdot_lanes_may_hide(const qdot_lanes *lanes)
{
    const qdot_program *p = qdot_lanes_program(lanes);

    for (size_t i = p->still; i < p->length; i++)
        if (may_hide_short_forces(p->steps.at[i].op))
            return true;
    return false;
}

/* Copy the Taylor series of a row of the program in one lane to consecutive numbers. */
static void
copy_series(const qdot_lanes_rows *rows, qdot_program_row row, size_t lane, int p, double *x)
{
    const double *from = rows->coefficients + row * rows->stride * L + lane;

    for (int k = 0; k <= p; k++)
        x[k] = from[(size_t)k * L];
}

static qdot_program_row
divisor_row(const qdot_program_step *step)
{
    const char which = qdot_recurrence_divisor(step->op);

    return which == 'x' ? step->x : which == 'y' ? step->y : step->z;
}

/* Find the lanes in which a row (a divisor) may fall far enough within the step, from the magnitudes of its terms. */
static void
find_lanes_that_may_vanish(const qdot_lanes_rows *rows, qdot_program_row row, int p, const double *s, bool *may)
{
    const double *b = rows->coefficients + row * rows->stride * L;
    double sum[L] = {0};

    for (int k = p; k > 0; k--)
        for (size_t l = 0; l < L; l++)
            sum[l] = (sum[l] + fabs(b[(size_t)k * L + l])) * s[l];
    for (size_t l = 0; l < L; l++)
        may[l] = qdot_near_sizes_may_fall(fabs(b[l]), sum[l]);
}

/* The largest part of step s, in one lane, over which a divisor stays away from 0. */
static double
safe_step_for_divisor(const qdot_lanes_rows *rows, const qdot_program_step *step, size_t lane, int p,
                      double s)
{
    double b[QDOT_SERIES_MOST + 1], quotient[QDOT_SERIES_MOST + 1];

    if (step->op == QDOT_T_DIV) {
        copy_series(rows, step->to, lane, p, quotient);
        if (!qdot_near_diverges(p, quotient, s))
            return s;
    }
    copy_series(rows, divisor_row(step), lane, p, b);
    return qdot_near_divisor(p, b, step->op == QDOT_T_SQRT, s);
}

static double
safe_step_for_argument(const qdot_lanes_rows *rows, const qdot_program_step *step, size_t lane, int p, double s)
{
    double u[QDOT_SERIES_MOST + 1];

    copy_series(rows, step->x, lane, p, u);
    return qdot_near_argument(p, u, qdot_recurrence_exponential(step->op), s);
}

void
qdot_lanes_near(qdot_lanes *lanes, int p, const double *s, const double *least, double *near)
{
    const qdot_lanes_rows rows = qdot_lanes_get_rows(lanes);

    memcpy(near, s, L * sizeof *near);
    for (size_t i = rows.program->still; i < rows.program->length; i++) {
        const qdot_program_step *step = rows.program->steps.at + i;
        const bool exponential = qdot_recurrence_exponential(step->op) > 0;
        bool may[L];

        if (!may_hide_short_forces(step->op))
            continue;
        if (!exponential)
            find_lanes_that_may_vanish(&rows, divisor_row(step), p, near, may);
        for (size_t l = 0; l < L; l++) {
            if (isnan(s[l]))
                continue;
            if (exponential)
                near[l] = qdot_near_taken(near[l], safe_step_for_argument(&rows, step, l, p, near[l]),
                                          QDOT_NEAR_FINER * least[l]);
            else if (may[l])
                near[l] = qdot_near_taken(near[l], safe_step_for_divisor(&rows, step, l, p, near[l]), least[l]);
        }
    }
}
