/* watch-jumps.c -- signs of watched functions behind the jump of a table of data at a function of time. */
#include <math.h>
#include <string.h>

#include "num/past.h"
#include "num/samples.h"
#include "sim/watch/watch-parts.h"

qdot_status
qdot_watch_find_jumps(qdot_watch *w)
{
    qdot_knots all = {0};
    qdot_status status = qdot_knots_find(w->tape, 2 * w->n, &all);

    for (size_t k = 0; k < all.n && status == QDOT_OK; k++)
        if (!qdot_past_has(all.at[k].handle) && qdot_samples_jumps(all.at[k].handle))
            status = qdot_vec_push(&w->jumps, all.at[k]);
    qdot_free(all.at);
    return status;
}

bool
qdot_watch_is_over_jump(const qdot_watch *w, double from, double to)
{
    for (size_t k = 0; k < w->jumps.n; k++) {
        const qdot_knots_line *l = &w->jumps.at[k];

        if (qdot_samples_lookup(l->handle, l->a + l->b * from) != qdot_samples_lookup(l->handle, l->a + l->b * to))
            return true;
    }
    return false;
}

/* The sign of g_i behind the jump, where its value is in w->final; 0 also where rounding is all of it. */
static qdot_status
sign_behind_jump(qdot_watch *w, double t, size_t i, int *sign)
{
    double noise;

    *sign = qdot_watch_sign(w->final[i]);
    if (*sign == 0)
        return QDOT_OK;
    memcpy(w->in, w->end, 2 * w->n * sizeof *w->in);
    QDOT_TRY(qdot_watch_operations(w, t, false, i, &noise));
    if (fabs(w->final[i]) <= noise)
        *sign = 0;
    return QDOT_OK;
}

double
qdot_watch_time_beside(const qdot_watch *w, double t, double by)
{
    return !qdot_watch_is_over_jump(w, t, t + by) ? t + by : !qdot_watch_is_over_jump(w, t, t - by) ? t - by : t;
}

void
qdot_watch_mark_pieces(qdot_watch *w)
{
    for (size_t k = 0; k < w->roots.n; k++)
        w->roots.at[k].jump = w->roots.at[k].jump || (w->roots.at[k].stays && w->reads_tables[w->roots.at[k].function]);
}

qdot_status
qdot_watch_pass_jump(qdot_watch *w, double t)
{
    for (size_t i = 0; i < w->m; i++) {
        const int before = w->start.on[i] ? 0 : w->start.sign[i];
        int behind;

        QDOT_TRY(sign_behind_jump(w, t, i, &behind));
        if (behind != before)
            QDOT_TRY(qdot_watch_push(w, (qdot_root){.function = i,
                                                    .t = t,
                                                    .way = behind != 0 ? behind : -before,
                                                    .residual = behind != 0 ? 0 : fabs(w->final[i]),
                                                    .exact = behind == 0,
                                                    .pole = behind != 0,
                                                    .stays = behind == 0,
                                                    .jump = true}));
        w->live[i] = true;
        w->first[i] = before;
        w->now.sign[i] = behind;
        w->now.on[i] = behind == 0;
        w->now.g0[i] = w->final[i];
        w->now.blurred[i] = w->now.sharp[i] = false;
        w->now.offset[i] = 0;
    }
    return QDOT_OK;
}
