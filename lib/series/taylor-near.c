/* taylor-near.c -- arguments of exponentials, and divisors, in a program of doubles. */
#include <float.h>
#include <math.h>

#include "series/near.h"
#include "series/taylor-steps.h"
#include "series/taylor.h"

static const double digits = DBL_MANT_DIG * 0.6931471805599453;

bool
qdot_taylor_may_hide(const qdot_taylor *t)
{
    for (size_t i = t->still; i < t->length; i++)
        if (qdot_recurrence_exponential(t->steps[i].op) > 0
            || qdot_recurrence_divisor(t->steps[i].op))
            return true;
    return false;
}

/* So that the argument u of an exponential, so many times, is not carried too far. */
static double
near_argument(const double *u, int p, double times, double s)
{
    double sizes[QDOT_SERIES_MOST + 1];
    const double limit = qdot_near_limit(p, times * u[0], digits) / times;

    if (qdot_near_sum(p, u, s) <= limit)
        return s;
    for (int k = 1; k <= p; k++)
        sizes[k] = log2(fabs(u[k]));
    return exp2(qdot_near_log2(p, sizes, limit, log2(s)));
}

static double
near_divisor(const qdot_taylor_step *step, int p, double s)
{
    const char which = qdot_recurrence_divisor(step->op);
    const double *b = which == 'x' ? step->x : which == 'y' ? step->y : step->z;

    if (!qdot_near_may_fall(p, b, s))
        return s;
    /* a quotient's zeros over zeros are no places of their own */
    if (step->op == QDOT_T_DIV && !qdot_near_diverges(p, step->to, s))
        return s;
    return qdot_near_divisor(p, b, step->op == QDOT_T_SQRT, s);
}

double
qdot_taylor_near(const qdot_taylor *t, int p, double s)
{
    for (size_t i = t->still; i < t->length; i++) {
        const qdot_taylor_step *step = t->steps + i;
        const double times = qdot_recurrence_exponential(step->op);

        if (times > 0)
            s = near_argument(step->x, p, times, s);
        else if (qdot_recurrence_divisor(step->op))
            s = near_divisor(step, p, s);
    }
    return s;
}
