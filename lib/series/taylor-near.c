/* taylor-near.c -- the arguments of exponentials in a program of doubles. */
#include <float.h>
#include <math.h>

#include "series/near.h"
#include "series/taylor-steps.h"
#include "series/taylor.h"

static const double digits = DBL_MANT_DIG * 0.6931471805599453;

bool
qdot_taylor_has_exponentials(const qdot_taylor *t)
{
    for (size_t i = t->still; i < t->length; i++)
        if (qdot_recurrence_exponential(t->steps[i].op) > 0)
            return true;
    return false;
}

static bool
is_within(const double *u, int p, double limit, double s)
{
    double sum = 0;

    for (int k = p; k >= 1; k--)
        sum = (sum + fabs(u[k])) * s;
    return sum <= limit;
}

double
qdot_taylor_near(const qdot_taylor *t, int p, double s)
{
    double sizes[QDOT_SERIES_MOST + 1];

    for (size_t i = t->still; i < t->length; i++) {
        const qdot_taylor_step *step = t->steps + i;
        const double times = qdot_recurrence_exponential(step->op), *u = step->x;
        double limit;

        if (!(times > 0))
            continue;
        limit = qdot_near_limit(p, times * u[0], digits) / times;
        if (is_within(u, p, limit, s))
            continue;
        for (int k = 1; k <= p; k++)
            sizes[k] = log2(fabs(u[k]));
        s = exp2(qdot_near_log2(p, sizes, limit, log2(s)));
    }
    return s;
}
