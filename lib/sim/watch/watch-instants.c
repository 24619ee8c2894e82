/* watch-instants.c -- roots of functions of t alone that only rounding of their operations separates are of one instant:
 * their events act in the order of their statements.
 *
 * Such a function is read in two doubles by every method. Its root is known to a small part of a double of t, so one at a
 * number as 3 is put there, though sin(pi t) is not exactly 0.
 */
#include <math.h>

#include "sim/watch/watch-parts.h"

qdot_status
qdot_watch_clock_rounding(qdot_watch *w, qdot_root *root, double slope)
{
    double noise;

    if (!w->clock[root->function] || slope == 0)
        return QDOT_OK;
    QDOT_TRY(w->reader.read(root->t, w->in, w->reader.user));
    QDOT_TRY(qdot_watch_operations(w, root->t, qdot_watch_is_fine(w, root->function), root->function, &noise));
    root->rounding = noise / slope;
    return QDOT_OK;
}

double
qdot_watch_negligible_rounding(const qdot_root *root, double step)
{
    return root->rounding <= 0.5 * QDOT_WATCH_NEGLIGIBLE * step ? root->rounding : 0;
}

void
qdot_watch_put_on_double(const qdot_watch *w, const qdot_watch_part *p, qdot_root *root)
{
    const double before = nextafter(root->t, -w->direction * INFINITY), step = fabs(root->t - before),
                 rounding = qdot_watch_negligible_rounding(root, step);

    if (rounding == 0 || before == p->a || !qdot_watch_is_fine(w, root->function) || root->late + rounding < step)
        return;
    root->t = before;
    root->late = 0;
}

/* By how much time root a is later than root b, in the direction of the run. */
static double
delay_between_roots(const qdot_watch *w, const qdot_root *a, const qdot_root *b)
{
    return w->direction * (a->t - b->t) - (a->late - b->late);
}

/* The doubles of t by which rounding may move a root that is said to be of the same instant as another. Where a function
 * has hardly any slope rounding moves its root by far more: that tells nothing of where it is. */
static const double most_doubles = 16;

/* Whether a root is a crossing of a function of t only, known to a few doubles of t. */
static bool
is_accurate_root_of_time(const qdot_watch *w, const qdot_root *root)
{
    const double step = nextafter(fabs(root->t), INFINITY) - fabs(root->t);

    return w->clock[root->function] && root->way != 0 && !root->stays && !root->pole
           && root->rounding <= most_doubles * step;
}

/* Move the earlier of two roots to the time of the later, where both functions have changed sign. */
static void
set_same_time(qdot_root *a, qdot_root *b, double direction)
{
    qdot_root *earlier = direction * (b->t - a->t) > 0 ? a : b;
    const double t = (earlier == a ? b : a)->t, by = fabs(t - earlier->t);

    earlier->late += by;
    earlier->moved += by;
    earlier->t = t;
}

bool
qdot_watch_join_instants(qdot_watch *w)
{
    double most = 0;
    bool any = false;

    for (size_t i = 0; i < w->roots.n; i++)
        if (is_accurate_root_of_time(w, &w->roots.at[i]))
            most = fmax(most, w->roots.at[i].rounding);
    for (size_t i = 1; i < w->roots.n; i++) {
        qdot_root *root = &w->roots.at[i];

        if (!is_accurate_root_of_time(w, root))
            continue;
        for (size_t k = i; k-- > 0;) {
            qdot_root *other = &w->roots.at[k];

            if (fabs(root->t - other->t) > root->late + root->rounding + most)
                break;
            if (is_accurate_root_of_time(w, other) && other->t != root->t
                && fabs(delay_between_roots(w, root, other)) <= root->rounding + other->rounding) {
                set_same_time(root, other, w->direction);
                any = true;
            }
        }
    }
    return any;
}
