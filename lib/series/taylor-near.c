/* taylor-near.c -- limits a step by arguments of exponentials and by divisors, for programs in doubles. */
#include <math.h>

#include "num/past.h"
#include "num/samples.h"
#include "series/near.h"
#include "series/taylor-steps.h"
#include "series/taylor.h"

bool
qdot_taylor_may_hide(const qdot_taylor *t)
{
    for (size_t i = t->still; i < t->length; i++)
        if (qdot_recurrence_exponential(t->steps[i].op) > 0 || qdot_recurrence_divisor(t->steps[i].op)
            || t->steps[i].zero == QDOT_OP_LOOKUP)
            return true;
    return false;
}

static double
safe_step_for_divisor(const qdot_taylor_step *step, int p, double s)
{
    const char which = qdot_recurrence_divisor(step->op);
    const double *b = which == 'x' ? step->x : which == 'y' ? step->y : step->z;

    if (!qdot_near_may_fall(p, b, s))
        return s;
    /* do not count poles of a quotient at which the numerator is 0, too */
    if (step->op == QDOT_T_DIV && !qdot_near_diverges(p, step->to, s))
        return s;
    return qdot_near_divisor(p, b, step->op == QDOT_T_SQRT, s);
}

/* The part of a step of s until the argument of a table of data passes a knot; not below QDOT_NEAR_FINER `least`. Of a history
 * of a run, steps end where qdot_past_next says. */
static double
safe_step_for_table(const qdot_taylor_step *step, int p, double s, double least)
{
    double lo, hi;

    if (!qdot_samples_finds(step->z[0]) || qdot_past_has(step->z[0]))
        return s;
    qdot_samples_bounds(step->z[0], step->x[0], &lo, &hi);
    return fmin(s, fmax(qdot_near_knot(p, step->x, lo, hi, s), QDOT_NEAR_FINER * least));
}

double
qdot_taylor_near(const qdot_taylor *t, int p, double s, double least)
{
    for (size_t i = t->still; i < t->length; i++) {
        const qdot_taylor_step *step = t->steps + i;
        const double times = qdot_recurrence_exponential(step->op);

        if (step->zero == QDOT_OP_LOOKUP)
            s = safe_step_for_table(step, p, s, least);
        else if (times > 0)
            s = qdot_near_taken(s, qdot_near_argument(p, step->x, times, s),
                                QDOT_NEAR_FINER * least);
        else if (qdot_recurrence_divisor(step->op))
            s = qdot_near_taken(s, safe_step_for_divisor(step, p, s), least);
    }
    return s;
}
