/* zero-between.c -- finds a zero of one function of one unknown between bounds, by Newton's method
 * and bisection. */
#include "num/zero-parts.h"

#include <float.h>
#include <math.h>

/* The most steps of the method; the number of parts of the interval that are searched for a change of sign. */
enum { MOST_STEPS = 60, PARTS = 16 };

/* Evaluate the only function of the problem at u; NaN if undefined. Its error goes to s->error[0]. */
static qdot_status
evaluate_at(qdot_zero_search *s, double u, double *f)
{
    QDOT_TRY(s->p->at(&u, f, s->error, NULL, s->p->user));
    return QDOT_OK;
}

/* Find the first interval of a grid whose ends differ in sign, or its point of smallest |f|. *end
 * [2], *f [2]. */
static qdot_status
search_sign_change(qdot_zero_search *s, double *end, double *f, bool *found)
{
    const double low = s->p->low[0], high = s->p->high[0];
    double last = NAN, least = INFINITY, at = low;

    *found = false;
    for (int i = 0; i <= PARTS && !*found; i++) {
        const double u = i == PARTS ? high : low + (high - low) * i / PARTS;
        double one;

        QDOT_TRY(evaluate_at(s, u, &one));
        *found = (last < 0 && one >= 0) || (last > 0 && one <= 0);
        if (*found) {
            end[0] = at;
            end[1] = u;
            f[0] = last;
            f[1] = one;
        }
        if (fabs(one) < least) {
            least = fabs(one);
            s->r->u[0] = u;
        }
        last = one;
        at = u;
    }
    return QDOT_OK;
}

/* The next u to try: by Newton's method if it stays between the ends and converges fast enough; else the middle. */
static double
next_trial_value(const qdot_zero_search *s, const double *end, double slope, double last_move)
{
    const double u = s->r->u[0], to = u - s->r->f[0] / slope;
    const double a = fmin(end[0], end[1]), b = fmax(end[0], end[1]);

    return to > a && to < b && fabs(to - u) < last_move / 2 ? to : a + (b - a) / 2;
}

/* Find the zero between ends [2], where the function values f [2] differ in sign, by Newton's method and bisection. */
static qdot_status
refine_between_ends(qdot_zero_search *s, double *end, double *f)
{
    qdot_zero_result *r = s->r;
    double move = INFINITY;

    r->u[0] = end[0] + (end[1] - end[0]) / 2;
    for (r->steps = 0; r->steps < MOST_STEPS;) {
        const double before = r->u[0];
        double width;

        QDOT_TRY(qdot_zero_evaluate(s));
        if (isnan(r->f[0])) {
            r->answer = QDOT_ZERO_NOWHERE;
            return QDOT_OK;
        }
        if (r->steps == 1) {
            qdot_zero_choose_units(s);
            s->order = 1;
        }
        if (!(s->slope[0] != 0) ||
            !isfinite(s->slope[0])) /* the derivative is not known: use the slope of the chord between the ends */
            s->slope[0] = (f[1] - f[0]) / (end[1] - end[0]);
        (void)qdot_zero_find_step(s);
        qdot_zero_estimate_order(s);
        width = fabs(end[1] - end[0]);
        if (qdot_zero_step_is_nothing(s) || r->f[0] == 0 ||
            width <= 4 * DBL_EPSILON * fmax(fabs(end[0]), fabs(end[1]))) {
            r->answer = qdot_zero_is_zero(s) ? QDOT_ZERO_FOUND : QDOT_ZERO_JUMP;
            break;
        }
        end[(r->f[0] < 0) == (f[0] < 0) ? 0 : 1] = r->u[0];
        f[(r->f[0] < 0) == (f[0] < 0) ? 0 : 1] = r->f[0];
        r->u[0] = next_trial_value(s, end, s->slope[0], move);
        move = fabs(r->u[0] - before);
    }
    qdot_zero_state_errors(s);
    return QDOT_OK;
}

qdot_status
qdot_zero_find_between(qdot_zero_search *s)
{
    double end[2] = {s->p->low[0], s->p->high[0]}, f[2];
    bool found;

    QDOT_TRY(evaluate_at(s, end[0], &f[0]));
    QDOT_TRY(evaluate_at(s, end[1], &f[1]));
    found = (f[0] < 0 && f[1] > 0) || (f[0] > 0 && f[1] < 0);
    if (!found)
        QDOT_TRY(search_sign_change(s, end, f, &found));
    s->r->answer = QDOT_ZERO_SLOW;
    return found ? refine_between_ends(s, end, f) : qdot_zero_descend(s);
}

