/* batch.c -- steps by Taylor series in lanes that go their own ways. */
#include "ode/batch.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "num/series.h"
#include "ode/taylor-numbers.h"

enum { L = QDOT_LANES, most_rescales = 8, most_tries = 60 };

static const size_t max_steps = 50000000;

/* The part of the way that a step goes whose series ends. */
static const double part_of_way = 0.31830988618379067;

typedef struct {
    size_t member;
    bool active;
    bool tried;   /* a step is to be confirmed */
    bool ended;   /* the last series ended, and its step was good */
    bool ends;    /* the one being tried is such a one */
    double t1, direction;
    double end, most; /* of the step tried; no longer ones for now */
    int tries, rescales;
} lane;

typedef struct {
    const qdot_ode_batch *system;
    const qdot_batch_kernels *kernels;
    qdot_batch_run *run;
    size_t n, waiting; /* components; the next member */
    lane lanes[L];
    double t[L], unit[L], old_unit[L], s[L];
    double h[L]; /* of the steps tried */
    int64_t tried[L]; /* which are, all bits set or none */
    double *y, *carry, *next, *next_carry, *value, *slope, *first; /* [n groups] */
    double log_aim, log_term, fall; /* as in taylor.c */
} batch;

/* --- members come and go ------------------------------------------------------------ */

/* Lane l stands at a member's start; without one it stays where it is, unheeded. */
static void
take(batch *b, size_t l)
{
    qdot_batch_run *run = b->run;
    lane *a = b->lanes + l;

    while (b->waiting < run->members) {
        size_t m = b->waiting++;

        run->results[m] = (qdot_batch_result){.t = run->t0[m]};
        if (run->t0[m] == run->t1[m])
            continue;
        *a = (lane){.member = m, .active = true, .t1 = run->t1[m], .most = INFINITY};
        a->direction = run->t1[m] < run->t0[m] ? -1 : 1;
        b->t[l] = run->t0[m];
        b->unit[l] = a->direction;
        for (size_t i = 0; i < b->n; i++) {
            b->y[i * L + l] = run->y[m * b->n + i];
            b->carry[i * L + l] = 0;
        }
        if (b->system->take)
            b->system->take(l, m, b->system->user);
        return;
    }
    a->active = a->tried = false;
}

static void
leave(batch *b, size_t l, qdot_batch_outcome outcome)
{
    lane *a = b->lanes + l;
    qdot_batch_result *r = b->run->results + a->member;

    r->outcome = outcome;
    r->t = b->t[l];
    for (size_t i = 0; i < b->n; i++)
        b->run->y[a->member * b->n + i] = b->y[i * L + l];
    take(b, l);
}

/* --- steps -------------------------------------------------------------------------- */

static void
begin(batch *b)
{
    double t[L], *y = b->value; /* free here */

    memcpy(y, b->y, b->n * L * sizeof *y);
    for (size_t l = 0; l < L; l++) {
        b->tried[l] = b->lanes[l].tried ? -1 : 0;
        t[l] = b->lanes[l].tried ? b->lanes[l].end : b->t[l];
    }
    b->kernels->blend(b->n, b->tried, b->next, y);
    b->system->begin(t, y, b->unit, b->system->user);
}

static const double *
coefficient(const batch *b, size_t i, int k)
{
    return b->system->x + (i * b->system->stride + (size_t)k) * L;
}

/* As `confirms` of taylor.c, of all lanes. */
static void
confirm(const batch *b, int64_t *good, int64_t *defined)
{
    const qdot_ode_batch *system = b->system;
    double steps[L], now[L];

    for (size_t l = 0; l < L; l++) {
        steps[l] = b->h[l] / b->old_unit[l];
        now[l] = b->h[l] / b->unit[l];
    }
    b->kernels->confirm(b->n, system->checked, system->x, system->stride, b->slope, b->first,
                        b->next, steps, now, 10 * (b->run->order + 1) * b->run->tol,
                        64 * DBL_EPSILON, good, defined);
}

/* Lane l, whose state is that of the end by now. */
static void
accept(batch *b, size_t l)
{
    lane *a = b->lanes + l;

    b->t[l] = a->end;
    a->most = INFINITY;
    a->tries = a->rescales = 0;
    a->ended = a->ends;
    b->run->results[a->member].steps++;
}

/* Back to where the step began, which then is to be a quarter of it. */
static void
reject(batch *b, size_t l)
{
    lane *a = b->lanes + l;

    b->run->results[a->member].rejected++;
    a->most = 0.25 * fabs(b->h[l]);
    a->ended = false;
    b->unit[l] = a->direction * qdot_step_unit(a->most);
    if (++a->tries > most_tries || a->most < qdot_step_floor(b->t[l]))
        leave(b, l, QDOT_BATCH_STUCK);
}

/* What the series begun tells of the steps tried. Whether some lane must begin anew. */
static bool
judge(batch *b)
{
    int64_t good[L], defined[L], taken[L];
    bool again = false;

    confirm(b, good, defined);
    for (size_t l = 0; l < L; l++)
        taken[l] = good[l] & b->tried[l];
    b->kernels->blend(b->n, taken, b->next, b->y);
    b->kernels->blend(b->n, taken, b->next_carry, b->carry);
    for (size_t l = 0; l < L; l++) {
        lane *a = b->lanes + l;

        if (!a->active)
            continue;
        if (!a->tried) {
            if (!defined[l]) {
                leave(b, l, QDOT_BATCH_UNDEFINED);
                again = true;
            }
            continue;
        }
        a->tried = false;
        if (taken[l]) {
            const qdot_batch_result *r = b->run->results + a->member;

            accept(b, l);
            if (b->t[l] != a->t1 && r->steps + r->rejected < max_steps)
                continue;
            leave(b, l, b->t[l] == a->t1 ? QDOT_BATCH_DONE : QDOT_BATCH_LIMIT);
        } else
            reject(b, l);
        again = true;
    }
    return again;
}

/* Try a step of h at most: cut to end on a double, on t1 where that is near. */
static void
try_step(batch *b, size_t l, double h)
{
    lane *a = b->lanes + l;
    double rest = a->direction * (a->t1 - b->t[l]), end = a->t1;

    a->ends = isinf(h);
    if (a->ends)
        h = a->ended ? rest : part_of_way * rest;
    h = qdot_smaller(h, a->most);
    if (h < rest * (1 - 1e-12)) {
        end = b->t[l] + a->direction * (h > 0.5 * rest ? 0.5 * rest : h);
        if (!(a->direction * (a->t1 - end) > 0))
            end = a->t1;
    }
    a->end = end;
    b->h[l] = end - b->t[l];
    if (end != a->t1 && qdot_step_is_too_short(b->t[l], fabs(b->h[l]))) {
        leave(b, l, QDOT_BATCH_STUCK);
        return;
    }
    a->tried = true;
    b->s[l] = (end == a->t1 ? b->h[l] + b->run->t1_low : b->h[l]) / b->unit[l];
}

/* log2 of the steps in units, as `log_step` of taylor.c. */
static void
log_steps(const batch *b, const double *weight, double *steps)
{
    const qdot_ode_batch *system = b->system;
    const int p = b->run->order;
    double upper[L], lower[L];

    b->kernels->log_steps(b->n, system->x, system->stride, p / 2 + 1, p, weight, 0,
                          b->fall, upper);
    b->kernels->log_steps(b->n, system->x, system->stride, 2, p / 2, weight, b->log_term, 0,
                          lower);
    for (size_t l = 0; l < L; l++) {
        const double step = upper[l] + b->log_aim / p;

        steps[l] = isnan(lower[l])                       ? NAN
                   : isinf(step) || !(lower[l] < step) ? step
                                                         : lower[l];
    }
}

/* A step for each lane from the series that is there, or another unit for it. */
static void
choose_steps(batch *b)
{
    const int p = b->run->order;
    double steps[L], whole[L], *weight = b->value; /* free here */
    bool known = false; /* `whole`, the same from all orders */

    b->kernels->weights(b->n, b->y, weight);
    log_steps(b, weight, steps);
    for (size_t l = 0; l < L; l++) {
        lane *a = b->lanes + l;
        double step = steps[l], far = step;

        b->s[l] = 0;
        b->old_unit[l] = b->unit[l];
        if (!a->active)
            continue;
        if (isnan(step)) {
            far = -10 - 40 * a->rescales;
        } else if (isinf(step)) {
            if (!known)
                b->kernels->log_steps(b->n, b->system->x, b->system->stride, 1, p, weight,
                                      0, 0, whole);
            known = true;
            far = fmax(0, whole[l] + b->log_aim / p);
        }
        if (fabs(far) > 8 && !isinf(far) && a->rescales < most_rescales) {
            b->unit[l] = ldexp(b->unit[l], (int)fmax(-300, fmin(300, floor(far))));
            a->rescales++;
            if (fabs(b->unit[l]) >= DBL_MIN && isfinite(b->unit[l]))
                continue;
            leave(b, l, QDOT_BATCH_STUCK);
        } else if (isnan(step)) {
            b->h[l] = b->unit[l]; /* the point is good, only what is beyond it is not */
            reject(b, l);
        } else
            try_step(b, l, fabs(b->unit[l]) * qdot_rough_exp2(step));
    }
}

/* The end of each lane's step, and what will be asked of it. */
static void
go(batch *b)
{
    const qdot_ode_batch *system = b->system;

    b->kernels->tails(b->n, system->x, system->stride, b->run->order, b->s, b->value,
                      b->slope);
    b->kernels->advance(b->n, system->checked, system->x, system->stride, b->s, b->old_unit,
                        b->value, b->y, b->carry, b->next, b->next_carry);
    for (size_t i = system->checked; i < b->n; i++)
        memcpy(b->first + i * L, coefficient(b, i, 1), L * sizeof *b->first);
    for (size_t l = 0; l < L; l++)
        if (b->lanes[l].tried)
            b->unit[l] = qdot_step_unit(b->h[l]);
}

static bool
is_active(const batch *b)
{
    for (size_t l = 0; l < L; l++)
        if (b->lanes[l].active)
            return true;
    return false;
}

static qdot_status
loop(batch *b)
{
    const qdot_ode_batch *system = b->system;

    for (size_t l = 0; l < L; l++)
        take(b, l);
    while (is_active(b)) {
        QDOT_TRY(qdot_interrupt_check());
        begin(b);
        while (judge(b)) /* a member may be undefined where it starts */
            begin(b);
        if (!is_active(b))
            break;
        system->extend(b->run->order, system->user);
        b->run->expansions++;
        choose_steps(b);
        go(b);
    }
    return QDOT_OK;
}

static qdot_status
check(const qdot_ode_batch *system, const qdot_batch_run *run)
{
    if (system->n == 0)
        return qdot_fail(QDOT_EINVAL, "there is nothing to integrate");
    if (run->order < 2 || run->order > QDOT_SERIES_MOST)
        return qdot_fail(QDOT_EINVAL, "an order of %d is out of range", run->order);
    if (!(run->tol >= 1e-16 && run->tol <= 1)) {
        qdot_fail(QDOT_EINVAL, "tolerance %g is out of range", run->tol);
        return qdot_hint("a double holds 1e-16 of itself; take 1e-16 to 1");
    }
    for (size_t m = 0; m < run->members; m++) {
        if (!isfinite(run->t0[m]) || !isfinite(run->t1[m]))
            return qdot_fail(QDOT_EINVAL, "the limits of member %zu are not finite", m + 1);
        for (size_t i = 0; i < system->n; i++)
            if (!isfinite(run->y[m * system->n + i]))
                return qdot_fail(QDOT_EINVAL, "initial value %zu of member %zu is not finite",
                                 i + 1, m + 1);
    }
    return QDOT_OK;
}

qdot_status
qdot_ode_batch_run(const qdot_ode_batch *system, qdot_batch_run *run)
{
    batch b = {.system = system,
               .kernels = qdot_batch_kernels_get(),
               .run = run,
               .n = system->n,
               .log_aim = log2(qdot_step_aim(run->tol, false))};
    size_t size = system->n * L;
    double *memory;
    qdot_status status;

    b.log_term = qdot_step_term(b.log_aim);
    b.fall = qdot_step_fall(b.log_aim, run->order);
    run->expansions = 0;
    QDOT_TRY(check(system, run));
    memory = qdot_calloc(7 * size, sizeof *memory);
    if (!memory)
        return QDOT_ENOMEM;
    b.y = memory;
    b.carry = b.y + size;
    b.next = b.carry + size;
    b.next_carry = b.next + size;
    b.value = b.next_carry + size;
    b.slope = b.value + size;
    b.first = b.slope + size;
    for (size_t l = 0; l < L; l++)
        b.unit[l] = b.old_unit[l] = 1;
    status = loop(&b);
    qdot_free(memory);
    return status;
}
