/* watch-exclusion.c -- proves, by bounds over complex discs, that a watched function has no root in an interval. */
#include <float.h>
#include <math.h>

#include "sim/watch/watch-parts.h"

/* Whether interval arithmetic excludes a zero of the function; used if complex discs give no bound. */
static bool
interval_excludes_zero(qdot_watch *w, const qdot_watch_part *p, int nodes, size_t i, bool *enclosed)
{
    const qdot_interval *box = w->bounds.box + i;

    if (w->now.on[i])
        return false;
    if (!*enclosed)
        qdot_polynomial_bounds_enclose(&w->bounds, p->a, p->b, nodes);
    *enclosed = true;
    return box->lo > 0 || box->hi < 0;
}

/* Discs of a function that is in many digits are in doubles: their size is so many times the rounding of its operations where
 * that is all there is. */
static const double of_rounding = 256;

qdot_watch_verdict
qdot_watch_judge(qdot_watch *w, const qdot_watch_part *p, int nodes)
{
    qdot_watch_verdict worst = QDOT_PART_GOOD;
    const double part = fabs(p->b - p->a) / w->length;
    bool enclosed = false;

    qdot_polynomial_bounds_look(&w->bounds, p->a, p->b, nodes, w->now.on, w->now.g0);
    for (size_t i = 0; i < w->m; i++) {
        const double miss = w->bounds.miss[i];
        qdot_watch_verdict v = isnan(miss) ? QDOT_PART_PARTED : QDOT_PART_HALVED;

        if (!w->live[i] || miss < w->clear[i] || miss <= qdot_watch_least(w, p, i) || miss <= of_rounding * w->hidden[i] ||
            qdot_polynomial_bounds_is_hollow(&w->bounds, i, part) ||
            interval_excludes_zero(w, p, nodes, i, &enclosed))
            continue;
        worst = v > worst ? v : worst;
    }
    return worst;
}

static bool
discs_exclude_zero(const qdot_watch *w, size_t i)
{
    return fabs(w->bounds.out[i]) > (1 + 0x1p-20) * w->bounds.out_radius[i] &&
           qdot_watch_sign(w->bounds.out[i]) == w->start.sign[i];
}

/* Whether the bounds of function i on the step exclude 0, even a touch of 0. */
static bool
bounds_exclude_zero(const qdot_watch *w, size_t i)
{
    static const double near = 0x1p-10;
    const qdot_interval *box = w->bounds.box + i;

    return w->start.sign[i] > 0   ? box->lo > near * box->hi
           : w->start.sign[i] < 0 ? box->hi < near * box->lo
                                  : false;
}

/* Bound all functions over the step: by complex discs, and by intervals if discs do not exclude all zeros. */
void
qdot_watch_bound(qdot_watch *w, const qdot_ode_expanded *step)
{
    bool all = true;

    w->bound_at_step = w->boxed_at_step = false;
    if (!step || w->accelerations)
        return;
    qdot_polynomial_bounds_series(&w->bounds, w->reader.system->series, step);
    w->bound_at_step = true;
    for (size_t i = 0; i < w->m; i++)
        all = all && discs_exclude_zero(w, i);
    if (all)
        return;
    qdot_polynomial_bounds_box(&w->bounds);
    w->boxed_at_step = true;
}

bool
qdot_watch_excludes(const qdot_watch *w, size_t i)
{
    return w->bound_at_step &&
           (discs_exclude_zero(w, i) || (w->boxed_at_step && bounds_exclude_zero(w, i)));
}
