/* precise-value.c -- evaluates any expression along a run with `digits`; the companion run gives its error. */
#include <math.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "expr/constant.h"
#include "expr/print.h"
#include "sim/course/reader.h"
#include "sim/digits/precise-pair.h"
#include "sim/digits/precise.h"
#include "sim/model/sliding.h"

#define RN MPFR_RNDN

/* Evaluates expressions at states of the run, or of its companion run. */
typedef struct {
    const qdot_reading *of;
    qdot_precise_side *side;
    qdot_precise *program;
    size_t segment;     /* the segment of the run that is read */
    qdot_reals numbers; /* memory for t and y [2n] */
} reader;

static void
reader_clear(reader *r)
{
    qdot_precise_free(r->program);
    qdot_reals_clear(&r->numbers);
}

static qdot_status
reader_init(reader *r, const qdot_reading *of, qdot_precise_side *side)
{
    *r = (reader){.of = of, .side = side};
    QDOT_TRY(qdot_reals_init(&r->numbers, 1 + 2 * of->plan->n, side->start.bits));
    QDOT_TRY(qdot_tape_check_digits(of->tape));
    return qdot_precise_new(of->plan->pool, of->tape, 0, side->start.bits, &r->program);
}

/* Evaluate the program of the expressions at the time t and the state y. */
static qdot_status
reader_evaluate(reader *r, mpfr_srcptr t, const mpfr_t *y)
{
    return qdot_precise_evaluate(r->side, r->side->segments.at[r->segment].mode, r->of->plan,
                                 r->program, r->of->accelerations, t, y);
}

/* Evaluate at the time numbers.at[0]; because of rounding it may lie slightly outside the run. */
static qdot_status
reader_read_at(reader *r)
{
    mpfr_ptr t = r->numbers.at[0];
    mpfr_srcptr ends[2];
    int way;

    if (r->side->segments.n == 0 || r->side->segments.at[0].run.count == 0)
        return qdot_fail(QDOT_EDOMAIN, "there is no run");
    ends[0] = qdot_precise_first(r->side)[0];
    ends[1] = qdot_precise_last(r->side)[0];
    way = mpfr_less_p(ends[1], ends[0]) ? -1 : 1;
    for (int i = 0; i < 2; i++) {
        bool beyond = (i == 1 ? way : -way) * mpfr_cmp(t, ends[i]) > 0;

        if (beyond && mpfr_get_d(t, RN) == mpfr_get_d(ends[i], RN))
            mpfr_set(t, ends[i], RN);
    }
    r->segment = qdot_precise_segment_at(r->side, t);
    QDOT_TRY(qdot_precise_state_in(r->side, r->segment, t, r->numbers.at + 1));
    return reader_evaluate(r, t, (const mpfr_t *)r->numbers.at + 1);
}

/* Evaluate the expressions at the first or last point of a piece of the run. */
static qdot_status
evaluate_at_piece_end(reader *r, size_t piece, bool last)
{
    const qdot_precise_side *s = r->side;
    const mpfr_t *point;
    size_t k = 0;

    while (k < s->segments.n && (s->segments.at[k].run.count == 0 || piece-- > 0))
        k++;
    if (k == s->segments.n)
        return qdot_fail(QDOT_EDOMAIN, "there is no such piece of the run");
    r->segment = k;
    point = (const mpfr_t *)qdot_precise_point(&s->segments.at[k].run,
                                               last ? s->segments.at[k].run.count - 1 : 0);
    return reader_evaluate(r, point[0], point + 1);
}

/* --- reading run and companion ------------------------------------------------------- */

/* Evaluates the same expressions along the run and along its companion run. */
typedef struct {
    qdot_precise_pair *pair;
    qdot_reading of;
    reader run, companion;
} readers;

static void
readers_clear(readers *r)
{
    reader_clear(&r->run);
    reader_clear(&r->companion);
    qdot_tape_free(r->of.tape);
}

static qdot_status
readers_init(readers *r, qdot_precise_pair *pair, size_t m, const qdot_expr *exprs)
{
    *r = (readers){.pair = pair};
    for (size_t j = 0; j < m && pair->plan->read_side; j++)
        if (qdot_plan_reading(pair->plan, exprs[j]) != qdot_plan_substitute(pair->plan, exprs[j]))
            return qdot_fail(QDOT_ENOTBUILT,
                             "not built yet: with `digits`, values of what switches on a surface "
                             "along which the motion slides");
    QDOT_TRY(qdot_reader_lower(pair->plan, m, exprs, &r->of));
    QDOT_TRY(reader_init(&r->run, &r->of, &pair->run));
    return reader_init(&r->companion, &r->of, &pair->companion);
}

static qdot_status
fail_undefined(const readers *r, size_t j)
{
    qdot_text text = {0};
    qdot_status status = qdot_print(r->pair->plan->pool, r->of.exprs[j], QDOT_PLAIN, &text);

    if (status == QDOT_OK)
        status = qdot_fail(QDOT_EDOMAIN, "%.200s is undefined at t = %.15g",
                           qdot_text_str(&text),
                           mpfr_get_d(r->run.numbers.at[0], MPFR_RNDN));
    qdot_text_clear(&text);
    return status;
}

/* Where both runs are evaluated: the time stored in the readers, or an end of a piece. */
typedef struct {
    bool end, last;
    size_t piece;
} place;

static qdot_status
evaluate_at_place(reader *r, place at)
{
    return at.end ? evaluate_at_piece_end(r, at.piece, at.last) : reader_read_at(r);
}

/* Evaluate along the run; distances from the companion run's values go to errors [m] (may be NULL). */
static qdot_status
evaluate_on_both_runs(readers *r, place at, double *errors)
{
    const qdot_precise_pair *pair = r->pair;
    qdot_status status;

    QDOT_TRY(evaluate_at_place(&r->run, at));
    for (size_t j = 0; j < r->of.m; j++)
        if (!mpfr_number_p(qdot_precise_output(r->run.program, j)[0]))
            return fail_undefined(r, j);
    if (!errors)
        return QDOT_OK;
    status = isnan(pair->log10_error) ? QDOT_EDOMAIN : evaluate_at_place(&r->companion, at);
    if (qdot_grave(status) != QDOT_OK)
        return status;
    for (size_t j = 0; j < r->of.m; j++) {
        mpfr_srcptr x = qdot_precise_output(r->run.program, j)[0];
        mpfr_ptr w = r->companion.numbers.at[0]; /* borrow numbers of the companion run, which has been evaluated already */
        double size = fmax(0, qdot_real_log2(x));

        errors[j] = NAN;
        if (status != QDOT_OK)
            continue;
        mpfr_sub(w, qdot_precise_output(r->companion.program, j)[0], x, RN);
        errors[j] = qdot_precise_power(fmax(qdot_real_log2(w) / QDOT_LOG2_10,
                                            size / QDOT_LOG2_10 - pair->run.digits));
    }
    return QDOT_OK;
}

/* Set the exact time at which the reader r evaluates; nil: the end of the run. */
static qdot_status
set_time(const qdot_plan *plan, qdot_expr time, reader *r)
{
    if (time != QDOT_NIL)
        return qdot_precise_constant(plan, time, r->numbers.at[0]);
    if (r->side->segments.n == 0 || r->side->segments.at[0].run.count == 0)
        return qdot_fail(QDOT_EDOMAIN, "there is no run");
    mpfr_set(r->numbers.at[0], qdot_precise_last(r->side)[0], RN);
    return QDOT_OK;
}

/* Evaluate on both runs: values [m] of the run, and errors [m] by the difference of the two. */
static qdot_status
evaluate_with_errors(readers *r, size_t m, place at, qdot_expr *values, double *errors)
{
    qdot_pool *pool = r->pair->plan->pool;
    qdot_status status = evaluate_on_both_runs(r, at, errors);

    for (size_t j = 0; j < m && status == QDOT_OK; j++) {
        values[j] = qdot_constant_of_real(pool, qdot_precise_output(r->run.program, j)[0]);
        status = qdot_pool_check(pool);
    }
    return status;
}

qdot_status
qdot_precise_pair_values(qdot_precise_pair *pair, size_t m, const qdot_expr *exprs,
                         qdot_expr time, qdot_expr *values, double *errors)
{
    readers r;
    qdot_status status = readers_init(&r, pair, m, exprs);

    if (status == QDOT_OK)
        status = set_time(pair->plan, time, &r.run);
    if (status == QDOT_OK)
        status = set_time(pair->plan, time, &r.companion);
    if (status == QDOT_OK)
        status = evaluate_with_errors(&r, m, (place){0}, values, errors);
    readers_clear(&r);
    return status;
}

qdot_status
qdot_precise_pair_end_values(qdot_precise_pair *pair, size_t m, const qdot_expr *exprs, size_t piece,
                             bool last, qdot_expr *values, double *errors)
{
    readers r;
    qdot_status status = readers_init(&r, pair, m, exprs);

    if (status == QDOT_OK)
        status = evaluate_with_errors(&r, m, (place){true, last, piece}, values, errors);
    readers_clear(&r);
    return status;
}

qdot_status
qdot_precise_pair_sample_values(qdot_precise_pair *pair, size_t m, const qdot_expr *exprs,
                                size_t k, const double *times, double *values,
                                double *errors)
{
    readers r;
    qdot_status status = readers_init(&r, pair, m, exprs);

    for (size_t i = 0; i < k && status == QDOT_OK; i++) {
        status = qdot_interrupt_check();
        mpfr_set_d(r.run.numbers.at[0], times[i], RN);
        mpfr_set_d(r.companion.numbers.at[0], times[i], RN);
        if (status == QDOT_OK)
            status = evaluate_on_both_runs(&r, (place){0}, errors ? errors + i * m : NULL);
        for (size_t j = 0; j < m && status == QDOT_OK; j++) {
            double x = mpfr_get_d(qdot_precise_output(r.run.program, j)[0], RN);

            values[i * m + j] = x;
            if (errors)
                errors[i * m + j] += 0x1p-53 * fabs(x);
        }
    }
    readers_clear(&r);
    return status;
}

/* --- drifts of conserved quantities -------------------------------------------------- */

/* A segment: the drift from w[0], which is what it starts with where `anew`. Where the
 * equations switch its ends are on neither side. */
static qdot_status
measure_drift_in_segment(reader *r, bool anew, bool cut, mpfr_t *w, qdot_drift *drift)
{
    const qdot_precise_run *run = &r->side->segments.at[r->segment].run;

    for (size_t k = anew ? 0 : 1; k < run->count - cut; k++) {
        const mpfr_t *point = (const mpfr_t *)qdot_precise_point(run, k);
        mpfr_srcptr c = qdot_precise_output(r->program, 0)[0];
        double change;

        QDOT_TRY(qdot_interrupt_check());
        QDOT_TRY(reader_evaluate(r, point[0], point + 1));
        if (k == 0)
            mpfr_set(w[0], c, RN);
        mpfr_sub(w[1], c, w[0], RN);
        change = exp2(qdot_real_log2(w[1]) - fmax(0, qdot_real_log2(w[0])));
        if (!(change <= drift->drift)) /* also true for a NaN, which then stays */
            drift->drift = change;
    }
    return QDOT_OK;
}

static qdot_status
measure_drift_of_run(reader *r, qdot_drift *drift)
{
    const qdot_precise_side *s = r->side;
    qdot_status status = QDOT_OK;
    qdot_reals w;

    QDOT_TRY(qdot_reals_init(&w, 2, s->start.bits));
    drift->drift = 0;
    for (size_t k = 0; k < s->segments.n && status == QDOT_OK; k++) {
        bool cut = k + 1 < s->segments.n && !s->segments.at[k + 1].jumped;

        r->segment = k;
        if (s->segments.at[k].run.count > 0)
            status = measure_drift_in_segment(r, k == 0 || s->segments.at[k].jumped, cut, w.at, drift);
    }
    qdot_reals_clear(&w);
    return status;
}

qdot_status
qdot_precise_pair_drifts(qdot_precise_pair *pair, qdot_drifts *drifts)
{
    for (size_t i = 0; i < drifts->n; i++) {
        reader r = {0};
        qdot_reading of;
        qdot_status status =
            qdot_reader_lower(pair->plan, 1, &drifts->at[i].quantity, &of);

        if (status == QDOT_OK)
            status = reader_init(&r, &of, &pair->run);
        if (status == QDOT_OK)
            status = measure_drift_of_run(&r, drifts->at + i);
        reader_clear(&r);
        qdot_tape_free(of.tape);
        QDOT_TRY(status);
    }
    return QDOT_OK;
}
