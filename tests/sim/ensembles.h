/* ensembles.h -- members against runs of their own, for the tests of ensembles. */
#ifndef QDOT_TESTS_SIM_ENSEMBLES_H
#define QDOT_TESTS_SIM_ENSEMBLES_H

#include "sim/scenes.h"

#include <inttypes.h>
#include <math.h>

#include "sim/ensemble/ensemble.h"

/* A run of the same scene alone: its end, and the error it states. */
static inline double
alone(fixture *f, const double *start, double *end)
{
    size_t n = f->scene->coordinates.n;
    const qdot_run_report *report;
    double error;
    qdot_run *r;

    for (size_t i = 0; i < n; i++) {
        char text[2][64];

        snprintf(text[0], sizeof text[0], "%.40f", start[i]);
        snprintf(text[1], sizeof text[1], "%.40f", start[n + i]);
        f->q0[i] = number(f, text[0]);
        f->v0[i] = number(f, text[1]);
    }
    f->request.q0 = f->q0;
    f->request.v0 = f->v0;
    f->request.method = "taylor";
    r = run(f);
    report = qdot_run_get_report(r);
    assert_int_equal(report->status, QDOT_RUN_DONE);
    memcpy(end, report->q, n * sizeof *end);
    memcpy(end + n, report->v, n * sizeof *end);
    error = report->error;
    qdot_run_free(r);
    f->request.q0 = f->request.v0 = NULL;
    return error;
}

static inline double
distance(const double *a, const double *b, size_t n)
{
    double worst = 0;

    for (size_t i = 0; i < n; i++)
        worst = fmax(worst, fabs(a[i] - b[i]) / fmax(1, fabs(b[i])));
    return worst;
}

static inline qdot_ensemble *
prepare(fixture *f, size_t n_varied, const qdot_expr *varied)
{
    qdot_ensemble *e = NULL;

    f->request.q0 = f->request.v0 = NULL;
    f->request.method = "auto";
    must(qdot_ensemble_new(f->scene, &f->request, n_varied, varied, &e));
    return e;
}

/* Ends the failing of allocation k; whether all went well without it. */
static inline bool
went_well(int64_t k, qdot_status status)
{
    qdot_memory_fail_at(-1);
    if (status != QDOT_OK && status != QDOT_ENOMEM)
        fail_msg("allocation %" PRId64 ": %s", k, qdot_last_error()->message);
    return status == QDOT_OK;
}

#endif
