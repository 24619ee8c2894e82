/* absent.c -- tests on which coordinates a function depends, by evaluating it with each one changed. */
#include "sim/model/absent.h"

#include <math.h>

#include "base/memory.h"
#include "series/lanes.h"

/* A relative change larger than this shows that the function depends on the coordinate that was changed. */
static const double noise = 1e-11;

/* An irregular sample value for coordinate i, in (0.3, 1.7): an interval that lies in most domains. */
static double
sample_value(size_t i)
{
    return 0.3 + 1.4 * fmod(0.5545497 * (double)(i + 1), 1);
}

/* Evaluate h with each coordinate i changed, and with none (i = n), eight at a time; results h [n + 1]. */
static void
evaluate_with_each_changed(const qdot_tape *tape, size_t n, size_t round, double *h, double *in, double *work)
{
    double out[QDOT_LANES];

    for (size_t j = 0; j < (2 * n + 1) * QDOT_LANES; j++)
        in[j] = sample_value(j / QDOT_LANES + 7 * round);
    for (size_t i = 0; i <= n; i += QDOT_LANES) {
        for (size_t l = 0; l < QDOT_LANES && i + l < n; l++)
            in[(i + l) * QDOT_LANES + l] = sample_value(i + l + 7 * round + 3);
        qdot_lanes_eval(tape, in, out, work);
        for (size_t l = 0; l < QDOT_LANES && i + l <= n; l++) {
            h[i + l] = out[l];
            in[(i + l) * QDOT_LANES + l] = sample_value(i + l + 7 * round);
        }
    }
}

qdot_status
qdot_absent_find(const qdot_tape *tape, size_t n, bool *absent)
{
    double *in = qdot_malloc(QDOT_LANES * (2 * n + 1) * sizeof *in);
    double *work = qdot_malloc(QDOT_LANES * (qdot_tape_work(tape) + 1) * sizeof *work);
    double *h = qdot_malloc((n + 1) * sizeof *h);
    qdot_status status = in && work && h ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < n; i++)
        absent[i] = true;
    for (size_t round = 0; round < 2 && status == QDOT_OK; round++) {
        evaluate_with_each_changed(tape, n, round, h, in, work);
        for (size_t i = 0; i < n; i++)
            absent[i] = absent[i] && !(fabs(h[i] - h[n]) > noise * (1 + fabs(h[n])));
    }
    qdot_free(in);
    qdot_free(work);
    qdot_free(h);
    return status;
}
