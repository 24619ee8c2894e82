/* watch-ends.c -- zeros of watched functions exactly at the end of a run, and at its start. */
#include <float.h>
#include <math.h>

#include "sim/watch/watch-parts.h"

/* Whether function i crosses 0 within one double after t, where the run ends: it then counts as a
 * zero at the end. */
static qdot_status
is_about_to_cross_zero(qdot_watch *w, size_t i, double t, bool *is)
{
    const double before = nextafter(t, -w->direction * INFINITY);
    double g;

    *is = false;
    if (!qdot_watch_can_two(w, i) || !w->live[i] || w->now.on[i]
        || w->now.sign[i] == 0 || before == w->t)
        return QDOT_OK;
    w->wants[i] = true;
    QDOT_TRY(qdot_watch_value_two(w, t, w->g));
    g = w->g[i];
    QDOT_TRY(qdot_watch_value_two(w, before, w->g));
    *is = qdot_watch_sign(g) == w->now.sign[i] && fabs(g) <= w->now.sign[i] * (w->g[i] - g);
    return QDOT_OK;
}

qdot_status
qdot_watch_end_on_zero(qdot_watch *w, double t)
{
    for (size_t i = 0; i < w->m; i++) {
        bool about;

        QDOT_TRY(is_about_to_cross_zero(w, i, t, &about));
        if (w->grazed[i])
            QDOT_TRY(qdot_watch_push(w, (qdot_root){.function = i,
                                                    .t = t,
                                                    .residual = fabs(w->now.g0[i]),
                                                    .exact = true}));
        else if (about || (w->now.g0[i] == 0 && w->now.sign[i] != 0 && w->live[i]))
            QDOT_TRY(qdot_watch_push(
                w, (qdot_root){
                       .function = i, .t = t, .way = -w->now.sign[i], .exact = true}));
    }
    return QDOT_OK;
}

/* Whether the state in z at time t equals the start state within rounding. */
static bool
is_start_state(const qdot_watch *w, double t, const double *z)
{
    const double by = 4 * DBL_EPSILON;

    if (w->bounds.reads_time && fabs(t - w->t) > by * fmax(w->least, fabs(t)))
        return false;
    for (size_t k = 0; k < 2 * w->n; k++)
        if (fabs(z[k] - w->y[k]) > by * fmax(w->least, fabs(z[k])))
            return false;
    return true;
}

qdot_status
qdot_watch_forget_start(qdot_watch *w)
{
    size_t n = 0;

    for (size_t i = 0; i < w->roots.n; i++) {
        const qdot_root *root = &w->roots.at[i];
        bool is = false;

        if (root->way == 0 || root->stays) {
            QDOT_TRY(w->reader.read(root->t, w->z, w->reader.user));
            is = is_start_state(w, root->t, w->z);
        }
        if (!is)
            w->roots.at[n++] = *root;
    }
    w->roots.n = n;
    return QDOT_OK;
}
