/* stage-pucks.c -- evaluates the quantities of sliding discs, and how slow a disc must be to count as resting. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "sim/course/stage.h"
#include "sim/model/puck.h"

/* Time in which a disc at its regularisation radius stops, relative to the largest |t|: 64 rounding errors. */
static const double stop = 0x1p-46;
/* A radius in local errors of velocities; and the time to stop for a method without series, which does
 * not come nearer to rest. */
static const double errors = 4, errors_without_series = 1000;
static const double stop_without_series = 0x1p-24;

/* The distance to rest that may be neglected, in units of the local error of the integration. */
static const double way_left_out = 1;

static size_t
output_count(const qdot_puck *puck, size_t n)
{
    return puck->k * (2 + puck->k + n);
}

/* Write a disc's expressions into out: velocities d_i, their rates without q'' terms, G_ij, dd_i/dq'_j. */
static void
write_disc_expressions(const qdot_stage *s, const qdot_puck *puck, const qdot_expr *in, qdot_expr *out)
{
    qdot_pool *pool = s->switches.pool;
    const size_t n = s->n, k = puck->k;
    qdot_expr *slopes = out + 2 * k + k * k;

    memcpy(out + 2 * k, puck->metric, k * k * sizeof *out);
    for (size_t a = 0; a < k; a++) {
        qdot_expr rate = qdot_diff(pool, puck->rest[a], QDOT_T);

        for (size_t i = 0; i < n; i++) {
            slopes[a * n + i] = i < n - s->n_states
                                    ? qdot_diff(pool, puck->rest[a], in[n + i])
                                    : QDOT_ZERO;
            if (i < n - s->n_states)
                rate = qdot_add(
                    pool, rate,
                    qdot_mul(pool, in[n + i], qdot_diff(pool, puck->rest[a], in[i])));
        }
        out[a] = puck->rest[a];
        out[k + a] = rate;
    }
}

qdot_status
qdot_stage_puck(const qdot_stage *s, size_t puck, double t, const double *y,
                qdot_puck_state *of)
{
    const size_t n = s->n, k = s->switches.pucks.at[puck].k,
                 all = qdot_tape_outputs(s->pucks);
    size_t at = 0;
    double *in = qdot_calloc(2 * n + 1 + all + qdot_tape_work(s->pucks) + 1, sizeof *in);
    double *out = in + 2 * n + 1, square = 0;

    if (!in)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < puck; i++)
        at += output_count(&s->switches.pucks.at[i], n);
    memcpy(in, y, 2 * n * sizeof *in);
    in[2 * n] = t;
    qdot_tape_eval(s->pucks, in, out, out + all);
    out += at;
    of->k = k;
    memcpy(of->d, out, k * sizeof *out);
    memcpy(of->rate, out + k, k * sizeof *out);
    memcpy(of->G, out + 2 * k, k * k * sizeof *out);
    if (of->slopes)
        memcpy(of->slopes, out + 2 * k + k * k, k * n * sizeof *out);
    for (size_t a = 0; a < k; a++)
        for (size_t b = 0; b < k; b++)
            square += of->d[a] * of->G[a * k + b] * of->d[b];
    of->speed = sqrt(square);
    qdot_free(in);
    return QDOT_OK;
}

/* Find the largest |B_ij|/M_ii of a disc at the start, which tells how much its friction can change q'_i. */
static qdot_status
find_friction_at_start(qdot_stage *s, const qdot_puck *puck, const qdot_expr *symbols,
                       const double *in, double *most)
{
    const qdot_switches *w = &s->switches;
    const qdot_facts facts = qdot_scene_facts(s->scene);
    const size_t n = s->n - s->n_states, m = n * (puck->k + 1);
    qdot_expr *e = qdot_calloc(m, sizeof *e);
    qdot_tape *tape = NULL;
    double *out = NULL;
    qdot_status status = e ? QDOT_OK : QDOT_ENOMEM;

    *most = 0;
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        qdot_expr f = qdot_expr_arg(w->pool, w->forcing, (uint32_t)i);

        status = qdot_puck_hold(w->pool, puck, &facts, 1, &f);
        e[i] = qdot_expr_arg(w->pool, w->mass, (uint32_t)(i * n + i));
        for (size_t a = 0; a < puck->k && status == QDOT_OK; a++) {
            const qdot_expr B = qdot_diff(w->pool, f, puck->share[a]);

            status = qdot_pool_check(w->pool);
            if (status == QDOT_OK)
                e[n * (a + 1) + i] = B;
        }
    }
    if (status == QDOT_OK)
        status = qdot_tape_new(w->pool, 2 * s->n + 1, symbols, m, e, &tape);
    if (status == QDOT_OK)
        out = qdot_calloc(m + qdot_tape_work(tape) + 1, sizeof *out);
    if (status == QDOT_OK && !out)
        status = QDOT_ENOMEM;
    if (status == QDOT_OK)
        qdot_tape_eval(tape, in, out, out + m);
    for (size_t i = n; i < m && status == QDOT_OK; i++)
        if (isfinite(out[i] / out[i % n]))
            *most = fmax(*most, fabs(out[i] / out[i % n]));
    qdot_free(out);
    qdot_tape_free(tape);
    qdot_free(e);
    return qdot_grave(status); /* ignore other failures here: they are reported where the value is needed */
}

static qdot_status
make_disc_tape(qdot_stage *s, qdot_expr *in)
{
    const size_t n = s->n;
    size_t all = 0, at = 0;
    qdot_expr *out;
    qdot_status status;

    for (size_t i = 0; i < s->switches.pucks.n; i++)
        all += output_count(&s->switches.pucks.at[i], n);
    out = qdot_calloc(all, sizeof *out);
    if (!out)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < s->switches.pucks.n; i++) {
        write_disc_expressions(s, &s->switches.pucks.at[i], in, out + at);
        at += output_count(&s->switches.pucks.at[i], n);
    }
    status = qdot_pool_check(s->switches.pool);
    if (status == QDOT_OK)
        status = qdot_tape_new(s->switches.pool, 2 * n + 1, in, all, out, &s->pucks);
    qdot_free(out);
    return status;
}

static bool
method_has_series(const qdot_run_request *request)
{
    return !request->method || strcmp(request->method, "auto") == 0 ||
           strcmp(request->method, "taylor") == 0;
}

qdot_status
qdot_stage_pucks(qdot_stage *s, double t, const double *y, double latest)
{
    const size_t n = s->n;
    qdot_expr *symbols = qdot_calloc(2 * n + 1, sizeof *symbols);
    double *in = qdot_calloc(2 * n + 1, sizeof *in);
    const bool series = method_has_series(s->request);
    qdot_status status = symbols && in ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK) {
        qdot_stage_inputs(s, symbols);
        memcpy(in, y, 2 * n * sizeof *in);
        in[2 * n] = t;
        status = make_disc_tape(s, symbols);
    }
    for (size_t i = 0; i < s->switches.pucks.n && status == QDOT_OK; i++) {
        qdot_puck *puck = &s->switches.pucks.at[i];
        qdot_puck_state now = {0};
        double friction, fast, radius;

        status = find_friction_at_start(s, puck, symbols, in, &friction);
        if (status == QDOT_OK)
            status = qdot_stage_puck(s, i, t, y, &now);
        if (status != QDOT_OK)
            break;
        fast = fmax(friction * latest, isfinite(now.speed) ? now.speed : 0);
        radius = (series ? errors : errors_without_series) * s->request->tol *
                 (fast > 0 ? fmin(fast, 1) : 1);
        if (!series)
            radius = fmax(radius, stop_without_series * friction * latest);
        if (friction > 0) /* choose the radius so small that the path omitted at the end is well below tol */
            radius = fmin(radius, sqrt(2 * friction * way_left_out * s->request->tol));
        radius = fmax(stop * friction * latest, radius);
        if (isnormal(radius * radius)) /* round the radius to a power of two, so that multiplying by it is exact */
            puck->radius = exp2(ilogb(radius));
    }
    qdot_free(in);
    qdot_free(symbols);
    return status;
}
