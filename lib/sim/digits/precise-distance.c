/* precise-distance.c -- the distance of the two runs of a pair, and whether more digits reduce
 * it. */
#include <float.h>
#include <math.h>

#include "num/sort.h"
#include "sim/digits/precise-pair.h"

#define RN MPFR_RNDN

/* log10 of the distance beyond which two runs count as unrelated. */
const double qdot_precise_parted = -4;

/* Further times, as fractions of the run, at which the distance is taken; without a pattern that
 * a period could share. */
static const double places[] = {0.5131, 0.5573, 0.6217, 0.6749, 0.7271,
                                0.7853, 0.8311, 0.8929, 0.9467};
enum { PLACES = sizeof places / sizeof places[0] };

/* Find log10 of the distance of two states a and b, max_i |a_i - b_i| / max(1, |b_i|). */
static double
log10_distance_of_states(size_t n, const mpfr_t *a, const mpfr_t *b, mpfr_ptr w)
{
    double most = -INFINITY;

    for (size_t i = 0; i < n; i++) {
        mpfr_sub(w, a[i], b[i], RN);
        most = fmax(most, qdot_real_log2(w) - fmax(0, qdot_real_log2(b[i])));
    }
    return most / QDOT_LOG2_10;
}

/* The companion's state at the end t of the run. Both may have ended on t1, which is not
 * the same number in both to the last bit. */
static qdot_status
find_end_of_companion(const qdot_precise_side *a, qdot_precise_side *b, mpfr_srcptr t, mpfr_t *y)
{
    const mpfr_t *end = (const mpfr_t *)qdot_precise_last(b);
    const bool there = a->guide && a->guide->reason[0] == '\0'
                       && a->guide->stopped_by == SIZE_MAX;

    if (a->guide && !there) { /* an event or a failure ended both runs: compare their end states, although at different times */
        for (size_t i = 0; i < a->guide->tr.n; i++)
            mpfr_set(y[i], end[1 + i], RN);
        return QDOT_OK;
    }
    if (!mpfr_equal_p(t, a->start.at[1]) || !mpfr_equal_p(end[0], b->start.at[1]))
        return qdot_precise_state(b, t, y);
    for (size_t i = 0; i < b->segments.at[0].run.n; i++)
        mpfr_set(y[i], end[1 + i], RN);
    return QDOT_OK;
}

qdot_status
qdot_precise_compare(qdot_precise_pair *pair)
{
    qdot_precise_side *a = &pair->run, *b = &pair->companion;
    const size_t n = pair->n;
    mpfr_srcptr t0 = qdot_precise_first(a)[0];
    const mpfr_t *end = (const mpfr_t *)qdot_precise_last(a);
    double between[PLACES];
    size_t known = 0;
    qdot_reals w;
    mpfr_t *ya, *yb;
    qdot_status status;

    pair->log10_error = NAN;
    QDOT_TRY(qdot_reals_init(&w, 2 * n + 2, b->start.bits));
    ya = w.at + 2, yb = ya + n;
    status = find_end_of_companion(a, b, end[0], yb);
    if (status == QDOT_OK) {
        pair->log10_error = log10_distance_of_states(n, end + 1, (const mpfr_t *)yb, w.at[0]);
        if (a->guide && a->guide->stopped_by != SIZE_MAX)
            pair->log10_error =
                fmax(pair->log10_error,
                     log10_distance_of_states(1, end, (const mpfr_t *)qdot_precise_last(b), w.at[0]));
        for (size_t k = 0; k < PLACES && status == QDOT_OK; k++) {
            mpfr_sub(w.at[1], end[0], t0, RN);
            mpfr_mul_d(w.at[1], w.at[1], places[k], RN);
            mpfr_add(w.at[1], w.at[1], t0, RN);
            status = qdot_precise_state(a, w.at[1], ya);
            if (status == QDOT_OK)
                status = qdot_precise_state(b, w.at[1], yb);
            if (status == QDOT_OK)
                between[known++] =
                    log10_distance_of_states(n, (const mpfr_t *)ya, (const mpfr_t *)yb, w.at[0]);
        }
        qdot_sort(known, between);
        if (known > 0)
            pair->log10_error = fmax(pair->log10_error, between[known / 2]);
        pair->log10_error = fmax(pair->log10_error, -a->digits);
    }
    qdot_reals_clear(&w);
    return qdot_grave(status);
}

/* --- whether more digits help -------------------------------------------------------- */

/* Find log10 of the distance of the run from its companion run at the fraction `part` of the run's duration. */
static qdot_status
find_distance_at(qdot_precise_pair *pair, double part, qdot_reals *w, double *log10_distance)
{
    mpfr_t *ya = w->at + 2, *yb = ya + pair->n;
    mpfr_srcptr t0 = qdot_precise_first(&pair->run)[0];

    mpfr_sub(w->at[1], qdot_precise_last(&pair->run)[0], t0, RN);
    mpfr_mul_d(w->at[1], w->at[1], part, RN);
    mpfr_add(w->at[1], w->at[1], t0, RN);
    QDOT_TRY(qdot_precise_state(&pair->run, w->at[1], ya));
    QDOT_TRY(qdot_precise_state(&pair->companion, w->at[1], yb));
    *log10_distance = log10_distance_of_states(pair->n, (const mpfr_t *)ya, (const mpfr_t *)yb, w->at[0]);
    return QDOT_OK;
}

/* Find the time *t at which the run and its companion run have separated, tested at times 9 % apart; NaN: unknown. */
static qdot_status
find_time_of_separation(qdot_precise_pair *pair, double *t)
{
    int together = 97, apart = 0;
    qdot_reals w;
    qdot_status status;

    *t = NAN;
    QDOT_TRY(qdot_reals_init(&w, 2 * pair->n + 2, pair->companion.start.bits));
    do {
        const int middle = (together + apart + 1) / 2;
        double d = 0;

        status = find_distance_at(pair, exp2(-middle / 8.0), &w, &d);
        *(d > qdot_precise_parted ? &apart : &together) = middle;
    } while (together - apart > 1 && status == QDOT_OK);
    if (status == QDOT_OK && together < 97) {
        status = find_distance_at(pair, exp2(-apart / 8.0), &w, t);
        *t = mpfr_get_d(w.at[1], RN);
    }
    qdot_reals_clear(&w);
    return qdot_grave(status);
}

qdot_status
qdot_precise_check_progress(qdot_precise_pair *pair, qdot_precise_progress *p)
{
    const double more = pair->run.digits - p->digits;
    double t;

    if (isnan(pair->log10_error))
        return QDOT_OK;
    if (pair->log10_error > qdot_precise_parted) {
        const double t0 = mpfr_get_d(qdot_precise_first(&pair->run)[0], RN);

        QDOT_TRY(find_time_of_separation(pair, &t));
        if (fabs(t - t0) < 1.2 * fabs(p->t - t0)) {
            qdot_fail(QDOT_EFAILED,
                      "carrying %.0f digits the motion is lost about t = %.4g, as with half as "
                      "many: digits do not help past it",
                      pair->run.digits, t);
            return qdot_hint("a singularity, such as where constraints stop being independent");
        }
        p->t = t;
        return QDOT_OK;
    }
    if (p->digits == 0) {
        p->digits = pair->run.digits;
        p->log10_error = pair->log10_error;
    } else if (more >= 8 && p->log10_error - pair->log10_error < 0.6 * more) {
        const bool ends = pair->guide && pair->guide->ends.n > 0;

        qdot_fail(QDOT_EFAILED,
                  "%.0f digits more have brought %.1f: the motion %sgoes through a singularity, "
                  "behind which no digits are sure",
                  more, p->log10_error - pair->log10_error,
                  ends ? "meets an event or a switch without speed, whose time has fewer digits, or it " : "");
        return qdot_hint(ends ? "a run in doubles states the error of its times"
                              : "such as a cusp, where a constraint has no direction");
    }
    return QDOT_OK;
}
