/* value.c -- any expression along a run, and its error. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "expr/print.h"
#include "sim/horizon.h"
#include "sim/integrated.h"
#include "sim/precise.h"
#include "sim/reader.h"
#include "sim/size.h"

/* --- asking ------------------------------------------------------------------------- */

static qdot_status
undefined(const qdot_run *run, qdot_expr e, double t)
{
    qdot_text text = {0};
    qdot_status status = qdot_print(run->plan->pool, e, QDOT_PLAIN, &text);

    if (status == QDOT_OK)
        status = qdot_fail(QDOT_EDOMAIN, "%.200s is undefined at t = %.15g",
                           qdot_text_str(&text), t);
    qdot_text_clear(&text);
    return status;
}

/* The piece of a run that a time falls in: the later of two. */
static size_t
piece_at(const qdot_trajectory *tr, double t)
{
    size_t k = qdot_trajectory_locate(tr, t, 0), low = 0, high = tr->pieces.n;

    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;

        if (tr->pieces.at[middle].first <= k)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static qdot_status
read_errors(qdot_run *run, const qdot_tape *tape, bool accelerations,
            const qdot_expr *exprs, size_t k, const double *times, const double *values,
            double *errors)
{
    size_t m = qdot_tape_outputs(tape);
    bool whole;
    qdot_reader r = {0};
    double *spread, *sizes;
    qdot_status status;

    for (size_t i = 0; i < k * m; i++)
        errors[i] = NAN;
    QDOT_TRY(qdot_run_companion(run));
    whole = qdot_run_comparable(run);
    if (!whole && isnan(run->report.horizon))
        return QDOT_OK;
    spread = qdot_calloc(m + k * m + 1, sizeof *spread);
    if (!spread)
        return QDOT_ENOMEM;
    sizes = spread + m;
    status = qdot_horizon_spread(run, tape, accelerations, spread);
    if (status == QDOT_OK)
        status = qdot_size_along(run->plan, &run->course, m, exprs, k, times, sizes);
    if (status == QDOT_OK)
        status = qdot_reader_init(&r, run->plan, tape, &run->companion, accelerations);
    for (size_t i = 0; i < k && status == QDOT_OK; i++) {
        bool beyond = qdot_horizon_passed(run, times[i]);
        double *e = errors + i * m;

        if (beyond && !whole)
            continue;
        status = qdot_interrupt_check();
        if (status == QDOT_OK)
            status = qdot_reader_at(&r, piece_at(&run->course.tr, times[i]), times[i], e);
        if (status == QDOT_EDOMAIN || status == QDOT_EFAILED
            || status == QDOT_ESINGULAR) {
            for (size_t j = 0; j < m; j++)
                e[j] = NAN;
            status = QDOT_OK;
            continue;
        }
        for (size_t j = 0; j < m && status == QDOT_OK; j++) {
            double x = values[i * m + j];

            e[j] = fmax(fabs(e[j] - x), beyond ? spread[j] : 0)
                   + DBL_EPSILON * fmax(sizes[i * m + j], fabs(x));
        }
    }
    qdot_reader_clear(&r);
    qdot_free(spread);
    return status;
}

static qdot_status
read_values(qdot_run *run, const qdot_tape *tape, bool accelerations,
            const qdot_expr *exprs, size_t k, const double *times, double *values)
{
    size_t m = qdot_tape_outputs(tape);
    qdot_reader r = {0};
    qdot_status status =
        qdot_reader_init(&r, run->plan, tape, &run->course, accelerations);

    for (size_t i = 0; i < k && status == QDOT_OK; i++) {
        status = qdot_interrupt_check();
        if (status == QDOT_OK)
            status = qdot_reader_at(&r, SIZE_MAX, times[i], values + i * m);
        for (size_t j = 0; j < m && status == QDOT_OK; j++)
            if (!isfinite(values[i * m + j]))
                status = undefined(run, exprs[j], times[i]);
    }
    qdot_reader_clear(&r);
    return status;
}

qdot_status
qdot_run_values(qdot_run *run, size_t m, const qdot_expr *exprs, size_t k,
                const double *times, double *values, double *errors)
{
    bool accelerations;
    qdot_tape *tape;
    qdot_status status;

    if (run->precise)
        return qdot_precise_pair_sample_values(run->precise, m, exprs, k, times, values,
                                               errors);
    QDOT_TRY(qdot_reader_lower(run->plan, m, exprs, &tape, &accelerations));
    status = read_values(run, tape, accelerations, exprs, k, times, values);
    if (status == QDOT_OK && errors)
        status = read_errors(run, tape, accelerations, exprs, k, times, values, errors);
    qdot_tape_free(tape);
    return status;
}
