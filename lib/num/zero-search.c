/* zero-search.c -- Newton's method with shortened steps, from a guess and from points around it. */
#include "num/zero-parts.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include <gsl/gsl_errno.h>

#include "base/memory.h"

/* Each new search starts this many times farther from the guess than the one before; the first starts at 0.04. */
static const double farther = 1.6;
/* Where J is nearly singular, the first step is no longer than first_reach, in units of the unknowns, and each one after
 * a whole step no longer than `reaching` times that. */
static const double first_reach = 0.1, reaching = 4;
/* How strongly large values |F| shorten the steps of a search at first. */
static const double damping = 0.01;
/* The most steps of a search, halvings of a step, steps within which |F| must halve, and further searches. */
enum { MOST_STEPS = 60, MOST_HALVINGS = 24, PATIENCE = 8, TRIES = 8 };

/* --- steps that reduce |F| --------------------------------------------------------------------- */

/* Move along the step, halved until |F|, or the next step with this J, becomes smaller. *gone: that
 * succeeded. */
static qdot_status
walk_along_step(qdot_zero_search *s, bool *gone)
{
    const size_t n = s->p->n;
    const double size = qdot_zero_norm(s, s->r->f);
    double part = 1;

    *gone = false;
    for (int h = 0; h < MOST_HALVINGS && !*gone; h++, part /= 2) {
        bool moved = false;

        s->reach = part == 1 ? fmax(s->reach, reaching * s->length) : part * s->length;
        for (size_t j = 0; j < n; j++) {
            s->u[j] = qdot_zero_within(s->p, j, s->r->u[j] + part * s->step[j]);
            moved = moved || s->u[j] != s->r->u[j];
        }
        if (!moved)
            break;
        QDOT_TRY(s->p->at(s->u, s->f, s->error, NULL, s->p->user));
        if (s->damping == 0)
            *gone = qdot_zero_is_predicted(s, s->f, part);
        else
            *gone = qdot_zero_norm(s, s->f) < size /* false also for NaN */
                    || qdot_zero_take_step(s, s->f, s->trial) < (1 - part / 4) * s->length;
    }
    if (*gone)
        memcpy(s->r->u, s->u, n * sizeof *s->u);
    return QDOT_OK;
}

/* Search by Newton's method from r->u; give up if |F| does not halve within PATIENCE steps. */
static qdot_status
search_from_start(qdot_zero_search *s)
{
    qdot_zero_result *r = s->r;
    double before = INFINITY;

    QDOT_TRY(qdot_zero_evaluate(s));
    r->answer = QDOT_ZERO_NOWHERE;
    s->gave_up = false;
    if (isnan(r->f[0]))
        return QDOT_OK;
    qdot_zero_choose_units(s);
    s->reach = s->p->unit != NULL && s->damping > 0 ? INFINITY : first_reach; /* units are given with a good guess */
    s->strongest = 0;
    s->order = 1;
    s->has_last = false;
    for (size_t step = 1; step < MOST_STEPS; step++) {
        const double size = qdot_zero_norm(s, r->f);
        bool gone;

        if (!qdot_zero_find_step(s)) {
            r->answer = qdot_zero_is_zero(s) ? QDOT_ZERO_FOUND : step == 1 ? QDOT_ZERO_FLAT : QDOT_ZERO_NONE;
            break;
        }
        qdot_zero_estimate_order(s);
        r->answer = QDOT_ZERO_SLOW;
        gone = !qdot_zero_step_is_nothing(s) || !qdot_zero_is_zero(s);
        if (gone && step % PATIENCE == 0) {
            gone = size < before / 2;
            s->gave_up = !gone;
            before = size;
        }
        if (gone)
            QDOT_TRY(walk_along_step(s, &gone));
        if (!gone) {
            r->answer = qdot_zero_is_zero(s) ? QDOT_ZERO_FOUND : QDOT_ZERO_NONE;
            break;
        }
        QDOT_TRY(qdot_zero_evaluate(s));
        if (isnan(r->f[0]))
            break;
    }
    qdot_zero_state_errors(s);
    return QDOT_OK;
}

/* Copy the result of a search from one structure to another. */
static void
copy_result(const qdot_zero_search *s, const qdot_zero_result *from, qdot_zero_result *to)
{
    const size_t n = s->p->n, m = s->p->m;

    to->answer = from->answer;
    to->rank = from->rank;
    memcpy(to->u, from->u, n * sizeof *to->u);
    memcpy(to->error, from->error, n * sizeof *to->error);
    memcpy(to->f, from->f, m * sizeof *to->f);
    memcpy(to->f_error, from->f_error, m * sizeof *to->f_error);
}

/* A search, and whether it led to a zero that is wanted. Where J is nearly singular, damping by |F| can make the steps so
 * short that |F| hardly falls. The search then goes on from there without damping, with steps that may grow as long as
 * J predicts F at their ends; if these find no zero, its result is the place where the damped search ended (crept). */
static qdot_status
search_with_and_without_damping(qdot_zero_search *s, qdot_zero_result *crept, bool *done)
{
    const qdot_zero_problem *p = s->p;

    QDOT_TRY(search_from_start(s));
    if (s->gave_up && s->r->answer == QDOT_ZERO_NONE && !p->once) {
        copy_result(s, s->r, crept);
        s->damping = 0;
        QDOT_TRY(search_from_start(s));
        s->damping = damping;
        if (s->r->answer != QDOT_ZERO_FOUND)
            copy_result(s, crept, s->r);
    }
    *done = s->r->answer == QDOT_ZERO_FOUND;
    return *done && p->wanted ? p->wanted(s->r->u, s->r->rank, done, p->user) : QDOT_OK;
}

/* Whether this search found a zero, or came nearer to one than *best, measured in the units of F [m] at the guess. */
static bool
is_better_result(const qdot_zero_search *s, const double *unit_f, const qdot_zero_result *best)
{
    double most = 0, most_best = 0;

    if (s->r->answer == QDOT_ZERO_FOUND || best->answer == QDOT_ZERO_FOUND)
        return best->answer != QDOT_ZERO_FOUND;
    for (size_t i = 0; i < s->p->m; i++) {
        most = fmax(most, fabs(s->r->f[i]) / unit_f[i]);
        most_best = fmax(most_best, fabs(best->f[i]) / unit_f[i]);
    }
    return s->r->answer == QDOT_ZERO_NONE && best->answer == QDOT_ZERO_NONE && most < most_best;
}

/* Newton's method from the guess; in vain, from places around it, ever farther off. If all are in vain the answer
 * is a zero that is not wanted, else what the guess led to. */
qdot_status
qdot_zero_descend(qdot_zero_search *s)
{
    const size_t n = s->p->n, m = s->p->m;
    double *guess = qdot_calloc(5 * (n + m) + 1, sizeof *guess), *unit_f = guess + 5 * n + 4 * m;
    qdot_zero_result best = {.u = guess + n,
                             .error = guess + 2 * n,
                             .f = guess + 3 * n,
                             .f_error = guess + 3 * n + m},
                     crept = {.u = best.f + 2 * m,
                              .error = best.f + 2 * m + n,
                              .f = best.f + 2 * m + 2 * n,
                              .f_error = best.f + 3 * m + 2 * n};
    uint64_t drawn = 1;
    bool done = false;
    qdot_status status;

    if (guess == NULL)
        return QDOT_ENOMEM;
    memcpy(guess, s->r->u, n * sizeof *guess);
    status = search_with_and_without_damping(s, &crept, &done);
    copy_result(s, s->r, &best);
    memcpy(unit_f, s->unit_f, m * sizeof *unit_f);
    for (int k = 1; k <= TRIES && status == QDOT_OK && !done && !s->p->once; k++) {
        if (best.answer == QDOT_ZERO_FLAT || best.answer == QDOT_ZERO_NOWHERE)
            break;
        for (size_t j = 0; j < n; j++) {
            drawn = drawn * 6364136223846793005u + 1442695040888963407u;
            s->r->u[j] = qdot_zero_within(s->p, j,
                                guess[j] + s->unit[j] * pow(farther, k) / 40 *
                                               ((double)(drawn >> 33) / 1073741824.0 - 1));
        }
        status = search_with_and_without_damping(s, &crept, &done);
        if (is_better_result(s, unit_f, &best))
            copy_result(s, s->r, &best);
    }
    if (!done)
        copy_result(s, &best, s->r);
    qdot_free(guess);
    return status;
}

/* --- the whole search ---------------------------------------------------------------------------- */

static bool
allocate_search(qdot_zero_search *s)
{
    const size_t n = s->p->n, m = s->p->m, rows = m > n ? m : n;
    double *room = qdot_calloc(m * n + 8 * n + 4 * m + 1, sizeof *room);

    s->slope = room;
    if (room == NULL)
        return false;
    s->u = s->slope + m * n;
    s->unit = s->u + n;
    s->step = s->unit + n;
    s->whole = s->step + n;
    s->from_error = s->whole + n;
    s->trial = s->from_error + n;
    s->last_u = s->trial + n;
    s->last = s->last_u + n;
    s->f = s->last + n;
    s->error = s->f + m;
    s->unit_f = s->error + m;
    s->small = s->unit_f + m;
    s->U = gsl_matrix_alloc(rows, n);
    s->V = gsl_matrix_alloc(n, n);
    s->singular = gsl_vector_alloc(n);
    s->work = gsl_vector_alloc(n);
    return s->U && s->V && s->singular && s->work;
}

qdot_status
qdot_zero_find(const qdot_zero_problem *p, qdot_zero_result *r)
{
    qdot_zero_search s = {.p = p, .r = r, .damping = damping};
    const bool between = p->n == 1 && p->m == 1 && p->low != NULL && p->high != NULL &&
                         isfinite(p->low[0]) && isfinite(p->high[0]);
    gsl_error_handler_t *before = gsl_set_error_handler_off();
    qdot_status status = QDOT_ENOMEM;

    r->steps = 0;
    if (allocate_search(&s))
        status = between ? qdot_zero_find_between(&s) : qdot_zero_descend(&s);
    if (status == QDOT_OK)
        status = qdot_zero_verify_family(&s);
    gsl_matrix_free(s.U);
    gsl_matrix_free(s.V);
    gsl_vector_free(s.singular);
    gsl_vector_free(s.work);
    qdot_free(s.slope);
    gsl_set_error_handler(before);
    return status;
}
