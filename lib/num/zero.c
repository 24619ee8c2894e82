/* zero.c -- Newton's method by singular values, with shortened steps; bisection between bounds. */
#include "num/zero.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>

#include "base/memory.h"

/* Singular values below so much of the largest count as 0; how strongly |F| shortens steps. */
static const double least_singular = 1e-8, damping = 0.01;
/* Of the unit of a function: with a larger error hardly anything moves it, its slopes are rounding; it counts by this error then. */
static const double finest = 1e-10;
/* Unknowns whose change by themselves changes F by less than this part of it do not move F. */
static const double least_slope = 1e-12;
/* How many times farther from the guess each search begins than the one before, the first at 0.04. */
static const double farther = 1.6;
/* Where a singular value is below so much of the largest, the first step is no longer than first_reach, in units of
 * the unknowns, and each one after a whole step no longer than `reaching` times that. */
static const double nearly_singular = 0.3, first_reach = 0.1, reaching = 4;
/* An unknown whose error is more than so much of it, or of its unit, is not known. */
static const double least_known = 0.1;
/* Steps; halvings of one; parts of an interval that are searched for a change of sign; steps in which |F| must
 * halve; searches besides the first. */
enum { MOST_STEPS = 60, MOST_HALVINGS = 24, PARTS = 16, PATIENCE = 8, TRIES = 8 };

typedef struct {
    const qdot_zero_problem *p;
    qdot_zero_result *r;
    double *slope;             /* [m x n] J at r->u */
    double *u, *f, *error;     /* [n], [m], [m] where a step leads */
    double *trial;             /* [n] */
    double *unit, *unit_f;     /* [n], [m] of unknowns and functions */
    double *small;             /* [m] below this a function may count as 0 */
    double mu, length;         /* of the step, in units of the unknowns */
    double reach;              /* the step is no longer than that */
    double *step, *whole;      /* [n] the step, and what it were by mu = 0, of any length */
    double *from_error;        /* [n] what errors of F make of it */
    gsl_matrix *U, *V;
    gsl_vector *singular, *work;
} search;

/* --- the step -------------------------------------------------------------------------------- */

static double
norm(const search *s, const double *f)
{
    double sum = 0;

    for (size_t i = 0; i < s->p->m; i++)
        sum += f[i] / s->unit_f[i] * (f[i] / s->unit_f[i]);
    return sqrt(sum);
}

static void
choose_units(search *s)
{
    const size_t n = s->p->n, m = s->p->m;
    double most = 0;

    for (size_t j = 0; j < n; j++)
        s->unit[j] = s->p->unit != NULL ? s->p->unit[j] : s->r->u[j] != 0 ? fabs(s->r->u[j]) : 1;
    for (size_t i = 0; i < m; i++) {
        double sum = 0;

        for (size_t j = 0; j < n; j++)
            sum += fabs(s->slope[i * n + j]) * s->unit[j];
        sum = fmax(sum, fabs(s->r->f[i]));
        s->unit_f[i] = sum;
        most = fmax(most, sum);
    }
    for (size_t i = 0; i < m; i++) {
        if (s->r->f_error[i] > finest * s->unit_f[i])
            s->unit_f[i] = fmax(s->unit_f[i], fmin(s->r->f_error[i] / finest, most));
        s->unit_f[i] = s->unit_f[i] > 0 ? s->unit_f[i] : 1;
        if (s->small[i] == 0) /* at the guess */
            s->small[i] = fmax(1e-3 * fabs(s->r->f[i]), 1e-9 * s->unit_f[i]);
    }
}

/* J = U S V^T in these units, more rows than columns or as many. */
static void
decompose(search *s)
{
    const size_t n = s->p->n, m = s->p->m;

    gsl_matrix_set_zero(s->U);
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < n; j++)
            gsl_matrix_set(s->U, i, j, s->slope[i * n + j] * s->unit[j] / s->unit_f[i]);
    (void)gsl_linalg_SV_decomp(s->U, s->V, s->singular, s->work);
}

/* The step [n] that values f [m] ask for with this J; its length in units of the unknowns. */
static double
take_step(const search *s, const double *f, double *step)
{
    const size_t n = s->p->n, m = s->p->m;
    double sum = 0;

    memset(step, 0, n * sizeof *step);
    for (size_t k = 0; k < s->r->rank; k++) {
        const double one = gsl_vector_get(s->singular, k);
        double along = 0;

        for (size_t i = 0; i < m; i++)
            along += gsl_matrix_get(s->U, i, k) * f[i] / s->unit_f[i];
        for (size_t j = 0; j < n; j++)
            step[j] -= s->unit[j] * gsl_matrix_get(s->V, j, k) * along * one /
                       (one * one + s->mu);
    }
    for (size_t j = 0; j < n; j++)
        sum += step[j] / s->unit[j] * (step[j] / s->unit[j]);
    return sqrt(sum);
}

/* The step, the errors of the unknowns, the rank. False: J is 0, to rounding, or not finite. */
static bool
find_step(search *s)
{
    const size_t n = s->p->n, m = s->p->m;
    const double size = norm(s, s->r->f);
    double most;

    memset(s->step, 0, n * sizeof *s->step);
    memset(s->whole, 0, n * sizeof *s->whole);
    memset(s->from_error, 0, n * sizeof *s->from_error);
    s->r->rank = 0;
    for (size_t i = 0; i < m * n; i++)
        if (!isfinite(s->slope[i]))
            return false;
    decompose(s);
    most = gsl_vector_get(s->singular, 0);
    while (s->r->rank < n &&
           gsl_vector_get(s->singular, s->r->rank) > least_singular * most)
        s->r->rank++;
    s->mu = 0;
    (void)take_step(s, s->r->f, s->whole);
    s->mu = damping * fmin(size * size, 1) * most * most;
    s->length = take_step(s, s->r->f, s->step);
    while (s->length > s->reach && s->mu < most * most && s->r->rank > 0 &&
           gsl_vector_get(s->singular, s->r->rank - 1) < nearly_singular * most) {
        s->mu = fmax(2 * s->mu, 1e-6 * most * most);
        s->length = take_step(s, s->r->f, s->step);
    }
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < m; i++) {
            double inverse = 0;

            for (size_t k = 0; k < s->r->rank; k++)
                inverse += gsl_matrix_get(s->V, j, k) * gsl_matrix_get(s->U, i, k) /
                           gsl_vector_get(s->singular, k);
            s->from_error[j] +=
                fabs(inverse) * s->unit[j] * s->r->f_error[i] / s->unit_f[i];
        }
    return s->r->rank > 0 && most > least_slope;
}

/* --- where it ends ---------------------------------------------------------------------------- */

/* Whether the step says nothing more than the errors of F and rounding. */
static bool
step_is_nothing(const search *s)
{
    for (size_t j = 0; j < s->p->n; j++) {
        const double error = s->from_error[j],
                     rounding = 4 * DBL_EPSILON * fabs(s->r->u[j]);

        if (!(fabs(s->whole[j]) <=
              fmax(isnan(error) ? 1e-11 * s->unit[j] : error, rounding)))
            return false;
    }
    return true;
}

/* Whether F is 0 within its errors and those of u, which are small beside what F was at the guess, or beside what
 * it is made of: where the last bit of u moves F by as much as the guess was off, nothing is found. */
static bool
is_zero(const search *s)
{
    const size_t n = s->p->n;

    for (size_t i = 0; i < s->p->m; i++) {
        const double error = s->r->f_error[i];
        double reach = 1e-13 * s->unit_f[i];

        reach += isnan(error) ? 1e-9 * s->unit_f[i] : 10 * error;
        for (size_t j = 0; j < n; j++)
            if (isfinite(s->slope[i * n + j]))
                reach += fabs(s->slope[i * n + j]) *
                         (fabs(s->whole[j]) + 4 * DBL_EPSILON * fabs(s->r->u[j]));
        if (!(fabs(s->r->f[i]) <= fmin(reach, s->small[i])))
            return false;
    }
    return true;
}

/* Errors of the unknowns; a zero whose place they leave open is vague. */
static void
state_errors(search *s)
{
    qdot_zero_result *r = s->r;

    for (size_t j = 0; j < s->p->n; j++) {
        r->error[j] = fabs(s->whole[j]) + s->from_error[j] + DBL_EPSILON * fabs(r->u[j]);
        if (r->answer == QDOT_ZERO_FOUND && r->error[j] > least_known * fmax(s->unit[j], fabs(r->u[j])))
            r->answer = QDOT_ZERO_VAGUE;
    }
}

/* --- shortened steps --------------------------------------------------------------------------- */

static qdot_status
evaluate(search *s)
{
    s->r->steps++;
    return s->p->at(s->r->u, s->r->f, s->r->f_error, s->slope, s->p->user);
}

static double
within(const qdot_zero_problem *p, size_t j, double u)
{
    if (p->low != NULL)
        u = fmax(u, p->low[j]);
    return p->high != NULL ? fmin(u, p->high[j]) : u;
}

/* Go along the step, halved until |F|, or the step that follows from it with this J, is smaller. *gone: it was. */
static qdot_status
go(search *s, bool *gone)
{
    const size_t n = s->p->n;
    const double size = norm(s, s->r->f);
    double part = 1;

    *gone = false;
    for (int h = 0; h < MOST_HALVINGS && !*gone; h++, part /= 2) {
        bool moved = false;

        s->reach = part == 1 ? fmax(s->reach, reaching * s->length) : part * s->length;
        for (size_t j = 0; j < n; j++) {
            s->u[j] = within(s->p, j, s->r->u[j] + part * s->step[j]);
            moved = moved || s->u[j] != s->r->u[j];
        }
        if (!moved)
            break;
        QDOT_TRY(s->p->at(s->u, s->f, s->error, NULL, s->p->user));
        *gone = norm(s, s->f) < size /* not of a NaN */
                || take_step(s, s->f, s->trial) < (1 - part / 4) * s->length;
    }
    if (*gone)
        memcpy(s->r->u, s->u, n * sizeof *s->u);
    return QDOT_OK;
}

/* Newton's method from r->u on. A search whose |F| has not halved in some steps is given up. */
static qdot_status
descend_once(search *s)
{
    qdot_zero_result *r = s->r;
    double before = INFINITY;

    QDOT_TRY(evaluate(s));
    r->answer = QDOT_ZERO_NOWHERE;
    if (isnan(r->f[0]))
        return QDOT_OK;
    choose_units(s);
    s->reach = s->p->unit != NULL ? INFINITY : first_reach; /* units are of a good guess */
    for (size_t step = 1; step < MOST_STEPS; step++) {
        const double size = norm(s, r->f);
        bool gone;

        if (!find_step(s)) {
            r->answer = is_zero(s) ? QDOT_ZERO_FOUND : QDOT_ZERO_FLAT;
            break;
        }
        r->answer = QDOT_ZERO_SLOW;
        gone = !step_is_nothing(s) || !is_zero(s);
        if (gone && step % PATIENCE == 0) {
            gone = size < before / 2;
            before = size;
        }
        if (gone)
            QDOT_TRY(go(s, &gone));
        if (!gone) {
            r->answer = is_zero(s) ? QDOT_ZERO_FOUND : QDOT_ZERO_NONE;
            break;
        }
        QDOT_TRY(evaluate(s));
        if (isnan(r->f[0]))
            break;
    }
    state_errors(s);
    return QDOT_OK;
}

/* What a search led to, from one place to another. */
static void
copy_result(const search *s, const qdot_zero_result *from, qdot_zero_result *to)
{
    const size_t n = s->p->n, m = s->p->m;

    to->answer = from->answer;
    to->rank = from->rank;
    memcpy(to->u, from->u, n * sizeof *to->u);
    memcpy(to->error, from->error, n * sizeof *to->error);
    memcpy(to->f, from->f, m * sizeof *to->f);
    memcpy(to->f_error, from->f_error, m * sizeof *to->f_error);
}

/* A search, and whether it led to a zero that is wanted. */
static qdot_status
search_once(search *s, bool *done)
{
    const qdot_zero_problem *p = s->p;

    QDOT_TRY(descend_once(s));
    *done = s->r->answer == QDOT_ZERO_FOUND;
    return *done && p->wanted ? p->wanted(s->r->u, s->r->rank, done, p->user) : QDOT_OK;
}

/* Newton's method from the guess; in vain, from places around it, ever farther off. If all are in vain the answer
 * is a zero that is not wanted, else what the guess led to. */
static qdot_status
descend(search *s)
{
    const size_t n = s->p->n, m = s->p->m;
    double *guess = qdot_calloc(3 * n + 2 * m + 1, sizeof *guess);
    qdot_zero_result best = {.u = guess + n,
                             .error = guess + 2 * n,
                             .f = guess + 3 * n,
                             .f_error = guess + 3 * n + m};
    uint64_t drawn = 1;
    bool done = false;
    qdot_status status;

    if (guess == NULL)
        return QDOT_ENOMEM;
    memcpy(guess, s->r->u, n * sizeof *guess);
    status = search_once(s, &done);
    copy_result(s, s->r, &best);
    for (int k = 1; k <= TRIES && status == QDOT_OK && !done && !s->p->once; k++) {
        if (best.answer == QDOT_ZERO_FLAT || best.answer == QDOT_ZERO_NOWHERE)
            break;
        for (size_t j = 0; j < n; j++) {
            drawn = drawn * 6364136223846793005u + 1442695040888963407u;
            s->r->u[j] = within(s->p, j,
                                guess[j] + s->unit[j] * pow(farther, k) / 40 *
                                               ((double)(drawn >> 33) / 1073741824.0 - 1));
        }
        status = search_once(s, &done);
        if (s->r->answer == QDOT_ZERO_FOUND && best.answer != QDOT_ZERO_FOUND)
            copy_result(s, s->r, &best);
    }
    if (!done)
        copy_result(s, &best, s->r);
    qdot_free(guess);
    return status;
}

/* --- one unknown between bounds ------------------------------------------------------------------ */

/* f(u) of the one function, NaN where it cannot be had; its error into s->error[0]. */
static qdot_status
value_at(search *s, double u, double *f)
{
    QDOT_TRY(s->p->at(&u, f, s->error, NULL, s->p->user));
    return QDOT_OK;
}

/* Take the narrowest part of a grid whose ends differ in sign, or its point of least |f|. *end [2], *f [2]. */
static qdot_status
search_signs(search *s, double *end, double *f, bool *found)
{
    const double low = s->p->low[0], high = s->p->high[0];
    double last = NAN, least = INFINITY, at = low;

    *found = false;
    for (int i = 0; i <= PARTS && !*found; i++) {
        const double u = i == PARTS ? high : low + (high - low) * i / PARTS;
        double one;

        QDOT_TRY(value_at(s, u, &one));
        *found = (last < 0 && one >= 0) || (last > 0 && one <= 0);
        if (*found) {
            end[0] = at;
            end[1] = u;
            f[0] = last;
            f[1] = one;
        }
        if (fabs(one) < least) {
            least = fabs(one);
            s->r->u[0] = u;
        }
        last = one;
        at = u;
    }
    return QDOT_OK;
}

/* The next place: by the slope if that stays between the ends and shrinks fast enough; else the middle. */
static double
next_place(const search *s, const double *end, double slope, double last_move)
{
    const double u = s->r->u[0], to = u - s->r->f[0] / slope;
    const double a = fmin(end[0], end[1]), b = fmax(end[0], end[1]);

    return to > a && to < b && fabs(to - u) < last_move / 2 ? to : a + (b - a) / 2;
}

/* Newton and bisection between ends [2] where f [2] differs in sign. */
static qdot_status
enclose(search *s, double *end, double *f)
{
    qdot_zero_result *r = s->r;
    double move = INFINITY;

    r->u[0] = end[0] + (end[1] - end[0]) / 2;
    for (r->steps = 0; r->steps < MOST_STEPS;) {
        const double before = r->u[0];
        double width;

        QDOT_TRY(evaluate(s));
        if (isnan(r->f[0])) {
            r->answer = QDOT_ZERO_NOWHERE;
            return QDOT_OK;
        }
        if (r->steps == 1)
            choose_units(s);
        if (!(s->slope[0] != 0) ||
            !isfinite(s->slope[0])) /* none is known: the chord's */
            s->slope[0] = (f[1] - f[0]) / (end[1] - end[0]);
        (void)find_step(s);
        width = fabs(end[1] - end[0]);
        if (step_is_nothing(s) || r->f[0] == 0 ||
            width <= 4 * DBL_EPSILON * fmax(fabs(end[0]), fabs(end[1]))) {
            r->answer = is_zero(s) ? QDOT_ZERO_FOUND : QDOT_ZERO_JUMP;
            break;
        }
        end[(r->f[0] < 0) == (f[0] < 0) ? 0 : 1] = r->u[0];
        f[(r->f[0] < 0) == (f[0] < 0) ? 0 : 1] = r->f[0];
        r->u[0] = next_place(s, end, s->slope[0], move);
        move = fabs(r->u[0] - before);
    }
    state_errors(s);
    return QDOT_OK;
}

static qdot_status
find_between(search *s)
{
    double end[2] = {s->p->low[0], s->p->high[0]}, f[2];
    bool found;

    QDOT_TRY(value_at(s, end[0], &f[0]));
    QDOT_TRY(value_at(s, end[1], &f[1]));
    found = (f[0] < 0 && f[1] > 0) || (f[0] > 0 && f[1] < 0);
    if (!found)
        QDOT_TRY(search_signs(s, end, f, &found));
    s->r->answer = QDOT_ZERO_SLOW;
    return found ? enclose(s, end, f) : descend(s);
}

/* --- all ----------------------------------------------------------------------------------------- */

static bool
allocate(search *s)
{
    const size_t n = s->p->n, m = s->p->m, rows = m > n ? m : n;
    double *room = qdot_calloc(m * n + 6 * n + 4 * m + 1, sizeof *room);

    s->slope = room;
    if (room == NULL)
        return false;
    s->u = s->slope + m * n;
    s->unit = s->u + n;
    s->step = s->unit + n;
    s->whole = s->step + n;
    s->from_error = s->whole + n;
    s->trial = s->from_error + n;
    s->f = s->trial + n;
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
    search s = {.p = p, .r = r};
    const bool between = p->n == 1 && p->m == 1 && p->low != NULL && p->high != NULL &&
                         isfinite(p->low[0]) && isfinite(p->high[0]);
    gsl_error_handler_t *before = gsl_set_error_handler_off();
    qdot_status status = QDOT_ENOMEM;

    r->steps = 0;
    if (allocate(&s))
        status = between ? find_between(&s) : descend(&s);
    gsl_matrix_free(s.U);
    gsl_matrix_free(s.V);
    gsl_vector_free(s.singular);
    gsl_vector_free(s.work);
    qdot_free(s.slope);
    gsl_set_error_handler(before);
    return status;
}
