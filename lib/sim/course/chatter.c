/* chatter.c -- the error of results while the motion oscillates too fast about a surface to be followed. */
#include "sim/course/chatter.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

static bool
is_chattering_at(const qdot_course *c, const qdot_course_chatter *x, double t)
{
    return c->early == 0 && (t - x->t) * (t - x->end) <= 0;
}

bool
qdot_chatters_at(const qdot_course *c, double t)
{
    for (size_t k = 0; k < c->chatters.n; k++)
        if (is_chattering_at(c, &c->chatters.at[k], t))
            return true;
    return false;
}

/* A bound of |u|: v^2/(2 a) with the weaker of the accelerations from both sides, and the effect of
 * v since the start. */
static double
oscillation_amplitude_at(const qdot_course *c, const qdot_course_chatter *x, double t, const double *y)
{
    const size_t n = c->tr.n / 2;
    const double *slopes = x->along + n, most = x->place + x->speed * fabs(t - x->t);
    double *rates = x->steady ? NULL : qdot_malloc(6 * n * sizeof *rates), least = INFINITY;
    bool known = rates != NULL;

    if (x->steady)
        return x->place;

    for (size_t k = 0; k < 3 && known; k++) {
        const qdot_ode_system *system = &c->systems.at[x->mode[k]];

        known = system->rhs(t, y, rates + 2 * n * k, system->user) == QDOT_OK;
    }
    for (size_t k = 0; k < 3 && known; k += 2) {
        double a = 0;

        for (size_t i = 0; i < n; i++)
            a += (k == 0 ? 1 : -1) * slopes[i] * (rates[(2 * k + 1) * n + i] - rates[3 * n + i]);
        least = fmin(least, a);
    }
    qdot_free(rates);
    return known && least > 0 ? fmin(most, x->place + x->speed * x->speed / (2 * least)) : most;
}

void
qdot_chatter_add_state(const qdot_course *c, double t, const double *y, double *errors)
{
    const size_t n = c->tr.n / 2;

    for (size_t k = 0; k < c->chatters.n; k++) {
        const qdot_course_chatter *x = &c->chatters.at[k];

        const double place = is_chattering_at(c, x, t) ? oscillation_amplitude_at(c, x, t, y) : 0;

        for (size_t i = 0; i < n && is_chattering_at(c, x, t); i++) {
            errors[i] += place * fabs(x->along[i]);
            errors[n + i] += x->speed * fabs(x->along[i]);
        }
    }
}

/* Raise most[j] to the largest |g_j(y') - g_j(y)|, y' being y [2n] moved by + or - the oscillation's amplitude or speed. */
static qdot_status
find_change_by_oscillation(const qdot_course_chatter *x, double place, size_t n, qdot_reader *r, double t, const double *y,
                           const double *values, double *g, double *most)
{
    static const double parts[][2] = {{0, 1}, {0, -1}, {1, 0}, {-1, 0}};
    double *in = r->courses[0].in;

    for (size_t k = 0; k < sizeof parts / sizeof *parts; k++) {
        for (size_t i = 0; i < n; i++) {
            in[i] = y[i] + parts[k][0] * place * x->along[i];
            in[n + i] = y[n + i] + parts[k][1] * x->speed * x->along[i];
        }
        QDOT_TRY(qdot_reader_evaluate(r, t, g));
        for (size_t j = 0; j < r->of.m; j++)
            most[j] = fmax(most[j], fabs(g[j] - values[j]));
    }
    return QDOT_OK;
}

qdot_status
qdot_chatter_add(const qdot_course *c, qdot_reader *r, double t, const double *values, double *errors)
{
    const size_t n = c->tr.n, m = r->of.m;
    double *y = qdot_malloc((n + 2 * m + 1) * sizeof *y), *g = y + n, *most = g + m;
    qdot_status status = y ? QDOT_OK : QDOT_ENOMEM;

    if (!y)
        return status;
    memcpy(y, r->courses[0].in, n * sizeof *y);
    for (size_t k = 0; k < c->chatters.n && status == QDOT_OK; k++) {
        if (!is_chattering_at(c, &c->chatters.at[k], t))
            continue;
        memset(most, 0, m * sizeof *most);
        status = find_change_by_oscillation(&c->chatters.at[k], oscillation_amplitude_at(c, &c->chatters.at[k], t, y), n / 2, r, t, y, values, g,
                                            most);
        for (size_t j = 0; j < m && status == QDOT_OK; j++)
            errors[j] += most[j];
    }
    memcpy(r->courses[0].in, y, n * sizeof *y);
    qdot_free(y);
    return status;
}
