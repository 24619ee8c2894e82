/* precise.c -- integrates by Taylor series in MPFR numbers, and stores the points of a run. */
#include "ode/precise.h"

#include <math.h>
#include <string.h>

#include "base/clock.h"
#include "base/interrupt.h"
#include "base/memory.h"
#include "base/progress.h"
#include "ode/step-decisions.h"

enum { least_order = 8 };

#define RN MPFR_RNDN

typedef struct {
    const qdot_precise_system *system;
    const qdot_precise_options *options;
    qdot_precise_run *run;
    size_t n;
    int p, direction;
    double log2_tol;
    qdot_reals numbers;
    mpfr_t *y, *next, *slope, *first; /* [n] state, end of the step; derivatives at the end and at the start */
    mpfr_ptr t, t1, h, end, rest, w, v;
    bool extended;
    qdot_error undefined; /* the last error of the right-hand side f */
    bool met;             /* whether f has failed */
} state;

int
qdot_precise_order_for(double log2_tol, const double cost[3])
{
    double L = -log2_tol * M_LN2, least = INFINITY;
    int best = least_order;

    for (int p = least_order; p < 2 * L + 2 * least_order; p++) {
        double c = (cost[0] + cost[1] * p + cost[2] * p * p) * exp(L / p);

        if (c < least) {
            least = c;
            best = p;
        }
    }
    return best;
}

/* --- stored points of a run ---------------------------------------------------------- */

void
qdot_precise_run_clear(qdot_precise_run *run)
{
    for (size_t i = 0; i < run->n_chunks; i++)
        qdot_reals_clear(run->chunks + i);
    qdot_free(run->chunks);
    qdot_free(run->inside);
    *run = (qdot_precise_run){0};
}

mpfr_t *
qdot_precise_point(const qdot_precise_run *run, size_t k)
{
    return run->chunks[k / QDOT_PRECISE_CHUNK].at
           + k % QDOT_PRECISE_CHUNK * (run->n + 1);
}

const double *
qdot_precise_inside(const qdot_precise_run *run, size_t k)
{
    return run->inside + k * QDOT_PRECISE_INSIDE * (run->n + 1);
}

/* After so many points the total is estimated; a run that would exceed the second number is
 * stopped: far more than memory holds. */
enum { looks = 1 << 14 };
static const double hopeless = 1e10;

/* Reserve memory for one more point, in chunks; done between steps. */
static qdot_status
precise_reserve(qdot_precise_run *run, double max_bytes)
{
    const size_t numbers = QDOT_PRECISE_CHUNK * (run->n + 1);

    QDOT_TRY(qdot_grow(&run->inside, &run->inside_capacity,
                       (run->count + 1) * QDOT_PRECISE_INSIDE * (run->n + 1),
                       sizeof *run->inside));
    if (run->count < run->n_chunks * QDOT_PRECISE_CHUNK)
        return QDOT_OK;
    if (qdot_reals_size(numbers, run->bits) * (double)(run->n_chunks + 1) > max_bytes)
        return qdot_fail(QDOT_ELIMIT, "a run of %zu steps does not fit into %.3g GB",
                         run->count, max_bytes / 1e9);
    QDOT_TRY(
        qdot_grow(&run->chunks, &run->capacity, run->n_chunks + 1, sizeof *run->chunks));
    QDOT_TRY(qdot_reals_init(run->chunks + run->n_chunks, numbers, run->bits));
    run->n_chunks++;
    return QDOT_OK;
}

static void
store_point(qdot_precise_run *run, mpfr_srcptr t, const mpfr_t *y)
{
    mpfr_t *point = qdot_precise_point(run, run->count++);

    mpfr_set(point[0], t, RN);
    for (size_t i = 0; i < run->n; i++)
        mpfr_set(point[1 + i], y[i], RN);
}

void
qdot_precise_cut(qdot_precise_run *run, mpfr_srcptr t, const mpfr_t *y)
{
    run->count--;
    store_point(run, t, y);
    run->result.t = mpfr_get_d(t, RN);
}

/* --- the length of a step ------------------------------------------------------------ */

/* The logarithm log2 max(1, |y|) of a number. */
static double
log2_size(mpfr_srcptr y)
{
    double l = qdot_real_log2(y);

    return l > 0 ? l : 0;
}

/* log2 of the step; INFINITY where orders from ... p hold nothing; NaN where they are not
 * finite. */
static double
log2_of_step(const state *s, int from)
{
    const qdot_precise_system *system = s->system;
    double least = INFINITY;

    for (size_t i = 0; i < s->n; i++) {
        const mpfr_t *x = system->x + i * system->stride;
        double allowed = log2_size(s->y[i]);

        for (int k = from; k <= s->p; k++) {
            double size = qdot_real_log2(x[k]);

            if (isnan(size))
                return NAN;
            if (size > -INFINITY)
                least = fmin(least, (allowed - size) / k);
        }
    }
    return least + s->log2_tol / s->p;
}

static qdot_status
precise_begin_series(state *s, mpfr_srcptr t, const mpfr_t *y)
{
    s->extended = false;
    return s->system->begin(t, y, s->system->user);
}

static qdot_status
precise_extend_series(state *s)
{
    if (!s->extended) {
        s->run->result.stats.evaluations++;
        QDOT_TRY(s->system->extend(s->p, s->system->user));
        s->extended = true;
    }
    return QDOT_OK;
}

/* --- evaluating the series ----------------------------------------------------------- */

/* Evaluate y = sum_k x_k h^k, and its slope [n] unless NULL. */
static void
precise_evaluate(const qdot_precise_system *system, int p, mpfr_srcptr h, mpfr_t *y, mpfr_t *slope,
                 mpfr_ptr w)
{
    for (size_t i = 0; i < system->n; i++) {
        const mpfr_t *x = system->x + i * system->stride;

        mpfr_set(y[i], x[p], RN);
        if (slope)
            mpfr_mul_ui(slope[i], x[p], (uint64_t)p, RN);
        for (int k = p - 1; k >= 0; k--) {
            mpfr_mul(y[i], y[i], h, RN);
            mpfr_add(y[i], y[i], x[k], RN);
            if (slope && k > 0) {
                mpfr_mul(slope[i], slope[i], h, RN);
                mpfr_mul_ui(w, x[k], (uint64_t)k, RN);
                mpfr_add(slope[i], slope[i], w, RN);
            }
        }
    }
}

/* Places inside the step, from the series in doubles: x_k h^k = (x_k 2^(e k)) m^k with
 * h = m 2^e keeps the powers within what a double holds. */
static void
sample_step_in_doubles(const state *s)
{
    const qdot_precise_system *system = s->system;
    double *to = s->run->inside
                 + (s->run->count - 1) * QDOT_PRECISE_INSIDE * (s->n + 1);
    mpfr_exp_t e;
    const double m = mpfr_get_d_2exp(&e, s->h, RN), t = mpfr_get_d(s->t, RN);

    for (int i = 1; i <= QDOT_PRECISE_INSIDE; i++, to += s->n + 1) {
        const double part = (double)i / (QDOT_PRECISE_INSIDE + 1);

        to[0] = t + ldexp(part * m, (int)e);
        for (size_t j = 0; j < s->n; j++) {
            const mpfr_t *x = system->x + j * system->stride;
            double y = 0;

            for (int k = s->p; k >= 0; k--) {
                mpfr_exp_t exponent;
                double c = mpfr_get_d_2exp(&exponent, x[k], RN);

                y = y * part * m
                    + ldexp(c, (int)fmax(-2000, fmin(2000, (double)(exponent + e * k))));
            }
            to[1 + j] = y;
        }
    }
}

/* Whether the derivative of the Taylor polynomial agrees with the equations at its end. */
static bool
is_confirmed_at_end(const state *s)
{
    const qdot_precise_system *system = s->system;
    const double share = log2(qdot_step_share(s->p, 1)) + s->log2_tol;
    const double h = qdot_real_log2(s->h), rounding = 8 - (double)system->bits;

    for (size_t i = system->checked; i < s->n; i++) {
        mpfr_srcptr f = system->x[i * system->stride + 1];
        double size = log2_size(s->next[i]), slopes, defect;

        mpfr_sub(s->w, s->slope[i], f, RN);
        defect = qdot_real_log2(s->w) + h;
        slopes = fmax(qdot_real_log2(s->slope[i]), qdot_real_log2(s->first[i])) + h;
        if (isnan(defect)
            || defect > fmax(share + size, rounding + fmax(slopes, size)))
            return false;
    }
    return true;
}

static void
keep_first_derivatives(state *s)
{
    for (size_t i = 0; i < s->n; i++)
        mpfr_set(s->first[i], s->system->x[i * s->system->stride + 1], RN);
}

/* Whether it also is inside the step, at places without a pattern. The series is begun
 * anew afterwards. */
static qdot_status
is_confirmed_inside(state *s, bool *good)
{
    qdot_status status = QDOT_OK;

    for (size_t k = 0; k < QDOT_STEP_PLACES && *good && status == QDOT_OK; k++) {
        mpfr_mul_d(s->v, s->h, qdot_step_places[k], RN);
        precise_evaluate(s->system, s->p, s->v, s->next, s->slope, s->w);
        keep_first_derivatives(s);
        mpfr_add(s->v, s->v, s->t, RN);
        status = precise_begin_series(s, s->v, s->next);
        if (status == QDOT_OK) {
            *good = is_confirmed_at_end(s);
            status = precise_begin_series(s, s->t, s->y);
        }
        if (status == QDOT_OK)
            status = precise_extend_series(s);
    }
    return status;
}

/* --- the loop over steps ------------------------------------------------------------- */

/* Try a step of s->h to s->end. On QDOT_OK and *good it has been accepted, and the series is
 * begun at its end. */
static qdot_status
precise_try_step(state *s, bool unsure, bool *good)
{
    *good = true;
    if (unsure)
        QDOT_TRY(is_confirmed_inside(s, good));
    if (!*good)
        return QDOT_OK;
    precise_evaluate(s->system, s->p, s->h, s->next, s->slope, s->w);
    keep_first_derivatives(s);
    sample_step_in_doubles(s);
    QDOT_TRY(precise_begin_series(s, s->end, s->next));
    *good = is_confirmed_at_end(s);
    if (!*good)
        return QDOT_OK;
    mpfr_set(s->t, s->end, RN);
    for (size_t i = 0; i < s->n; i++)
        mpfr_swap(s->y[i], s->next[i]);
    s->run->result.stats.steps++;
    return QDOT_OK;
}

static qdot_status
fail_with_small_step(const state *s)
{
    double t = mpfr_get_d(s->t, RN);

    if (s->met)
        return qdot_fail(QDOT_EFAILED, "stopped at t = %.17g: %s", t,
                         s->undefined.message);
    qdot_fail(QDOT_EFAILED, "stopped at t = %.17g: no step keeps the error small enough",
              t);
    return qdot_hint("the solution has a singularity there");
}

/* Set h and the end of the step from the desired length; near t1 the end is t1 itself. */
static void
set_step_end(state *s, double log2_h)
{
    double rest;

    mpfr_sub(s->rest, s->t1, s->t, RN);
    rest = qdot_real_log2(s->rest);
    if (log2_h >= rest - 1e-9) {
        mpfr_set(s->h, s->rest, RN);
        mpfr_set(s->end, s->t1, RN);
        return;
    }
    if (log2_h > rest - 1)
        mpfr_div_2ui(s->h, s->rest, 1, RN);
    else {
        /* use few bits for h, so that times are added without rounding as long as possible */
        double whole = floor(log2_h);

        mpfr_set_d(s->h, s->direction * floor(exp2(log2_h - whole + 20)), RN);
        mpfr_mul_2si(s->h, s->h, (mpfr_exp_t)whole - 20, RN);
    }
    mpfr_add(s->end, s->t, s->h, RN);
    mpfr_sub(s->h, s->end, s->t, RN);
}

static qdot_status
advance_one_step(state *s)
{
    double most = INFINITY, least;
    qdot_ode_stats *stats = &s->run->result.stats;

    least = fmax(log2_size(s->t), -60) - (double)s->system->bits + 4;
    for (int tries = 0;; tries++) {
        double log2_h = NAN;
        bool good = false;
        qdot_status status = QDOT_OK;

        QDOT_TRY(qdot_interrupt_check());
        if (tries > 0)
            status = precise_begin_series(s, s->t, s->y);
        if (status == QDOT_OK)
            status = precise_extend_series(s);
        if (status == QDOT_OK) {
            log2_h = log2_of_step(s, s->p / 2 + 1);
            if (isnan(log2_h))
                status = qdot_fail(QDOT_EDOMAIN, "the solution is not finite beyond it");
            else if (s->system->near)
                log2_h = s->system->near(s->p, log2_h, s->system->user);
        }
        if (status == QDOT_OK) {
            bool unsure = isinf(log2_h);

            log2_h = fmin(log2_h, most);
            set_step_end(s, log2_h);
            log2_h = qdot_real_log2(s->h);
            if (log2_h < least && !mpfr_equal_p(s->end, s->t1))
                return fail_with_small_step(s);
            status = precise_try_step(s, unsure, &good);
            if (status == QDOT_OK && good)
                return QDOT_OK;
        }
        if (status != QDOT_OK && !qdot_ode_may_be_undefined(status))
            return status;
        stats->rejected++;
        s->met = status != QDOT_OK;
        if (status != QDOT_OK)
            s->undefined = *qdot_last_error();
        most = log2_h + log2(qdot_step_quarter);
        if (isnan(most) || tries == QDOT_STEP_ATTEMPTS || most < least)
            return fail_with_small_step(s);
    }
}

static qdot_status
precise_loop(state *s)
{
    const double max_bytes = s->options->max_bytes > 0 ? s->options->max_bytes : 2e9;
    const uint64_t max_steps = s->options->max_steps ? s->options->max_steps : 50000000;
    qdot_ode_result *result = &s->run->result;
    qdot_status status;

    QDOT_TRY(precise_reserve(s->run, max_bytes));
    store_point(s->run, s->t, s->y);
    if (mpfr_equal_p(s->t, s->t1))
        return QDOT_OK;
    status = precise_begin_series(s, s->t, s->y);
    if (qdot_ode_may_be_undefined(status)) {
        s->undefined = *qdot_last_error();
        s->met = true;
        return fail_with_small_step(s);
    }
    QDOT_TRY(status);
    while (!mpfr_equal_p(s->t, s->t1) && result->outcome != QDOT_ODE_STOPPED) {
        bool stop = false;

        if (result->stats.steps + result->stats.rejected >= max_steps)
            return qdot_fail(QDOT_ELIMIT, "stopped at t = %.17g after %llu steps",
                             mpfr_get_d(s->t, RN), (unsigned long long)max_steps);
        QDOT_TRY(precise_reserve(s->run, max_bytes));
        QDOT_TRY(advance_one_step(s));
        qdot_progress_at(mpfr_get_d(s->t, RN));
        store_point(s->run, s->t, s->y);
        if (s->run->count % looks == 0)
            QDOT_TRY(qdot_ode_check_pace(mpfr_get_d(qdot_precise_point(s->run, 0)[0], RN), mpfr_get_d(s->t, RN),
                                         mpfr_get_d(s->t1, RN), s->run->count, hopeless,
                                         "a shorter run, or other units of time"));
        if (s->options->accepted)
            QDOT_TRY(s->options->accepted(s->t, (const mpfr_t *)s->y, &stop,
                                          s->options->user));
        if (stop)
            result->outcome = QDOT_ODE_STOPPED;
    }
    return QDOT_OK;
}

static qdot_status
precise_prepare(state *s, mpfr_srcptr t0, mpfr_srcptr t1, const mpfr_t *y0)
{
    mpfr_ptr *singles[] = {&s->t, &s->t1, &s->h, &s->end, &s->rest, &s->w, &s->v};
    const size_t n = s->n, extra = sizeof singles / sizeof *singles;

    if (!mpfr_number_p(t0) || !mpfr_number_p(t1))
        return qdot_fail(QDOT_EINVAL, "the limits of the run are not finite");
    if (s->p < 1 || s->p > s->system->most)
        return qdot_fail(QDOT_EINVAL, "an order of %d is out of range", s->p);
    QDOT_TRY(qdot_reals_init(&s->numbers, 4 * n + extra, s->system->bits));
    s->y = s->numbers.at;
    s->next = s->y + n;
    s->slope = s->next + n;
    s->first = s->slope + n;
    for (size_t i = 0; i < extra; i++)
        *singles[i] = s->first[n + i];
    mpfr_set(s->t, t0, RN);
    mpfr_set(s->t1, t1, RN);
    for (size_t i = 0; i < n; i++)
        mpfr_set(s->y[i], y0[i], RN);
    s->direction = mpfr_less_p(t1, t0) ? -1 : 1;
    return QDOT_OK;
}

qdot_status
qdot_precise_integrate(const qdot_precise_system *system,
                       const qdot_precise_options *options, mpfr_srcptr t0,
                       mpfr_srcptr t1, const mpfr_t *y0, qdot_precise_run *run)
{
    double start = qdot_cpu_now();
    state s = {.system = system,
               .options = options,
               .run = run,
               .n = system->n,
               .p = options->order,
               .log2_tol = options->log2_tol};
    qdot_status status;

    qdot_precise_run_clear(run);
    run->n = system->n;
    run->bits = system->bits;
    run->order = options->order;
    status = precise_prepare(&s, t0, t1, y0);
    if (status == QDOT_OK)
        status = precise_loop(&s);
    run->result.t =
        mpfr_get_d(run->count ? qdot_precise_point(run, run->count - 1)[0] : t0, RN);
    qdot_reals_clear(&s.numbers);
    run->result.stats.cpu = qdot_cpu_now() - start;
    if (status != QDOT_OK) {
        run->result.outcome = QDOT_ODE_FAILED;
        memcpy(run->result.reason, qdot_last_error()->message,
               sizeof run->result.reason);
    }
    return status;
}

/* --- states between points ----------------------------------------------------------- */

/* The index of the last stored point at or before t, in the direction of the run. */
static size_t
find_point_before(const qdot_precise_run *run, mpfr_srcptr t, bool backwards)
{
    size_t lo = 0, hi = run->count;

    while (hi - lo > 1) {
        size_t middle = lo + (hi - lo) / 2;
        int order = mpfr_cmp(t, qdot_precise_point(run, middle)[0]);

        if (backwards ? order <= 0 : order >= 0)
            lo = middle;
        else
            hi = middle;
    }
    return lo;
}

qdot_status
qdot_precise_at(const qdot_precise_run *run, const qdot_precise_system *system,
                mpfr_srcptr t, size_t *near, mpfr_t *y)
{
    mpfr_srcptr first, last;
    const mpfr_t *point;
    bool backwards;
    qdot_reals w;
    size_t k;

    if (run->count == 0)
        return qdot_fail(QDOT_EDOMAIN, "there is no run");
    first = qdot_precise_point(run, 0)[0];
    last = qdot_precise_point(run, run->count - 1)[0];
    backwards = mpfr_less_p(last, first) != 0;
    if (!mpfr_number_p(t) || mpfr_cmp(t, backwards ? last : first) < 0
        || mpfr_cmp(t, backwards ? first : last) > 0)
        return qdot_fail(QDOT_EDOMAIN,
                         "t = %.15g is outside the run, which covers %.15g to %.15g",
                         mpfr_get_d(t, RN), mpfr_get_d(first, RN), mpfr_get_d(last, RN));
    k = find_point_before(run, t, backwards);
    point = (const mpfr_t *)qdot_precise_point(run, k);
    if (mpfr_equal_p(t, point[0])) {
        for (size_t i = 0; i < run->n; i++)
            mpfr_set(y[i], point[1 + i], RN);
        return QDOT_OK;
    }
    if (*near != k) {
        *near = SIZE_MAX;
        QDOT_TRY(system->begin(point[0], point + 1, system->user));
        QDOT_TRY(system->extend(run->order, system->user));
        *near = k;
    }
    QDOT_TRY(qdot_reals_init(&w, 2, system->bits));
    mpfr_sub(w.at[0], t, point[0], RN);
    precise_evaluate(system, run->order, w.at[0], y, NULL, w.at[1]);
    qdot_reals_clear(&w);
    return QDOT_OK;
}
