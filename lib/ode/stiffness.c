/* stiffness.c -- whether thousands of steps lie on a line. */
#include "ode/stiffness.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/memory.h"

/* Steps from a place to the next, in all 4000. */
static const int waits[QDOT_ODE_STIFF_PLACES] = {1, 397, 512, 331, 467, 389, 541, 443, 491, 429};

/* Of the change, what a line may be off by. */
static const double share = 1e-2;

static const double work_default = 5e9;

void
qdot_ode_stiffness_clear(qdot_ode_stiffness *s)
{
    qdot_free(s->y);
    *s = (qdot_ode_stiffness){0};
}

static bool
is_line(const qdot_ode_stiffness *s, size_t n, double tol)
{
    const size_t last = s->count - 1;
    const double *a = s->y, *b = s->y + last * n;

    for (size_t k = 1; k < last; k++) {
        const double x = (s->t[k] - s->t[0]) / (s->t[last] - s->t[0]), *y = s->y + k * n;

        for (size_t i = 0; i < n; i++) {
            const double by = fabs(y[i] - (a[i] + x * (b[i] - a[i])));

            if (!(by <= share * fabs(b[i] - a[i]) + tol * fmax(1, fabs(y[i]))))
                return false;
        }
    }
    return true;
}

static int
steps_between(void)
{
    int sum = 0;

    for (size_t k = 1; k < QDOT_ODE_STIFF_PLACES; k++)
        sum += waits[k];
    return sum;
}

/* Keep the state; whether there are places enough to judge. */
static qdot_status
keep(qdot_ode_stiffness *s, const qdot_ode_stiff_step *at, bool *enough)
{
    if (!s->y)
        s->y = qdot_malloc(QDOT_ODE_STIFF_PLACES * at->n * sizeof *s->y);
    if (!s->y)
        return QDOT_ENOMEM;
    memcpy(s->y + s->count * at->n, at->y, at->n * sizeof *s->y);
    s->t[s->count++] = at->t;
    *enough = s->count == QDOT_ODE_STIFF_PLACES;
    s->wait = waits[*enough ? 0 : s->count];
    return QDOT_OK;
}

qdot_status
qdot_ode_stiffness_look(qdot_ode_stiffness *s, const qdot_ode_stiff_step *at,
                        const qdot_ode_options *options, bool *stiff)
{
    const double worth = options->stiff_work > 0 ? options->stiff_work : work_default;
    double step, left;
    bool enough;

    if (--s->wait > 0)
        return QDOT_OK;
    QDOT_TRY(keep(s, at, &enough));
    if (!enough)
        return QDOT_OK;
    step = (at->t - s->t[0]) / steps_between();
    left = fabs((at->t1 - at->t) / step);
    *stiff = left * at->work > worth && is_line(s, at->n, at->tol);
    s->count = 0;
    if (!*stiff)
        return QDOT_OK;
    return qdot_fail(QDOT_ELIMIT,
                     "stopped at t = %.4g: the scene is stiff there: stability allows steps of "
                     "%.1g, of which %.0e are left; method msbdf needs few, or method bsimp",
                     at->t, fabs(step), left);
}
