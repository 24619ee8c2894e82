/* zero-step.c -- the Newton step by singular values, with error estimates. */
#include "num/zero-parts.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Singular values below this fraction of the largest one count as 0. */
static const double least_singular = 1e-8;
/* Of the unit of a function: with a larger error hardly anything moves it, its slopes are rounding; it counts by
 * this error then. */
static const double finest = 1e-10;
/* An unknown does not count as affecting F if its relative change changes F by less than this part. */
static const double least_slope = 1e-12;
/* The length of steps is limited where a singular value of J is below this part of the largest one seen so far. */
static const double nearly_singular = 0.3;
/* F counts as 0 below this fraction of the terms whose difference it is, unless its errors are larger. */
static const double least_part = 1e-6;
/* The order of a zero, up to highest_order, is estimated only if F exceeds its error by the factor `clear`. */
static const double clear = 100, highest_order = 20;
/* An unknown counts as not determined if its error exceeds this fraction of its value, or of its unit. */
static const double least_known = 0.1;

qdot_status
qdot_zero_evaluate(qdot_zero_search *s)
{
    s->r->steps++;
    return s->p->at(s->r->u, s->r->f, s->r->f_error, s->slope, s->p->user);
}

double
qdot_zero_within(const qdot_zero_problem *p, size_t j, double u)
{
    if (p->low != NULL)
        u = fmax(u, p->low[j]);
    return p->high != NULL ? fmin(u, p->high[j]) : u;
}

/* --- the Newton step ------------------------------------------------------------------------- */

double
qdot_zero_norm(const qdot_zero_search *s, const double *f)
{
    double sum = 0;

    for (size_t i = 0; i < s->p->m; i++)
        sum += f[i] / s->unit_f[i] * (f[i] / s->unit_f[i]);
    return sqrt(sum);
}

void
qdot_zero_choose_units(qdot_zero_search *s)
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
        if (s->small[i] == 0) /* set only once, at the guess */
            s->small[i] = fmax(fmax(1e-3 * fabs(s->r->f[i]), 1e-9 * s->unit_f[i]),
                               s->p->size != NULL ? least_part * s->p->size[i] : 0);
    }
}

/* Decompose the Jacobian J = U S V^T in the chosen units, filled up to at least as many rows as columns. */
static void
decompose_jacobian(qdot_zero_search *s)
{
    const size_t n = s->p->n, m = s->p->m;

    gsl_matrix_set_zero(s->U);
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < n; j++)
            gsl_matrix_set(s->U, i, j, s->slope[i * n + j] * s->unit[j] / s->unit_f[i]);
    (void)gsl_linalg_SV_decomp(s->U, s->V, s->singular, s->work);
}

/* Compute the Newton step [n] for values f [m] with the present Jacobian; returns its length in units of the unknowns. */
double
qdot_zero_take_step(const qdot_zero_search *s, const double *f, double *step)
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

bool
qdot_zero_is_predicted(const qdot_zero_search *s, const double *f, double part)
{
    const double size = qdot_zero_norm(s, s->r->f);
    double sum = 0;

    for (size_t i = 0; i < s->p->m; i++) {
        double to = s->r->f[i];

        for (size_t j = 0; j < s->p->n; j++)
            to += part * s->slope[i * s->p->n + j] * s->step[j];
        sum += to / s->unit_f[i] * (to / s->unit_f[i]);
    }
    return size - qdot_zero_norm(s, f) > 0.5 * (size - sqrt(sum));
}

/* Whether all function values f [m] are 0 within their errors [m] and rounding. */
bool
qdot_zero_is_within_errors(const qdot_zero_search *s, const double *f, const double *error)
{
    for (size_t i = 0; i < s->p->m; i++)
        if (!(fabs(f[i]) <= fmin(1e-13 * s->unit_f[i] +
                                     (isnan(error[i]) ? 1e-9 * s->unit_f[i] : 10 * error[i]),
                                 s->small[i])))
            return false;
    return true;
}

/* A bound below which singular values of J at a zero may be due to errors of J; 0 if J is exact. */
static double
jacobian_noise(const qdot_zero_search *s)
{
    const size_t n = s->p->n, m = s->p->m;
    double sum = 0;

    if (s->p->slope_error == NULL || !qdot_zero_is_within_errors(s, s->r->f, s->r->f_error))
        return 0;
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < n; j++) {
            const double one = s->p->slope_error[i * n + j] * s->unit[j] / s->unit_f[i];

            sum += isnan(one) ? 0 : one * one;
        }
    return sqrt(sum);
}

/* Find the step, the errors of the unknowns and the rank of J. False: J is 0 to rounding, or not finite. */
bool
qdot_zero_find_step(qdot_zero_search *s)
{
    const size_t n = s->p->n, m = s->p->m;
    const double size = qdot_zero_norm(s, s->r->f);
    double most, noise;

    memset(s->step, 0, n * sizeof *s->step);
    memset(s->whole, 0, n * sizeof *s->whole);
    memset(s->from_error, 0, n * sizeof *s->from_error);
    s->r->rank = 0;
    for (size_t i = 0; i < m * n; i++)
        if (!isfinite(s->slope[i]))
            return false;
    decompose_jacobian(s);
    most = gsl_vector_get(s->singular, 0);
    noise = fmax(least_singular * most, jacobian_noise(s));
    s->strongest = fmax(s->strongest, most);
    while (s->r->rank < n && gsl_vector_get(s->singular, s->r->rank) > noise)
        s->r->rank++;
    s->mu = 0;
    (void)qdot_zero_take_step(s, s->r->f, s->whole);
    s->mu = s->damping * fmin(size * size, 1) * most * most;
    s->length = qdot_zero_take_step(s, s->r->f, s->step);
    while (s->length > s->reach && s->mu < s->strongest * s->strongest && s->r->rank > 0 &&
           gsl_vector_get(s->singular, s->r->rank - 1) < nearly_singular * s->strongest) {
        s->mu = fmax(2 * s->mu, 1e-6 * s->strongest * s->strongest);
        s->length = qdot_zero_take_step(s, s->r->f, s->step);
    }
    if (s->damping == 0 && s->length > s->reach) {
        for (size_t j = 0; j < n; j++)
            s->step[j] *= s->reach / s->length;
        s->length = s->reach;
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

/* --- accuracy of the result ------------------------------------------------------------------- */

/* Whether the Newton step is so small that errors of F and rounding can explain it. */
bool
qdot_zero_step_is_nothing(const qdot_zero_search *s)
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

/* Whether F is 0 within its errors and rounding of u, which are small beside what F was at the guess, or beside what
 * it is made of: where the last bit of u moves F by as much as the guess was off, nothing is found. */
bool
qdot_zero_is_zero(const qdot_zero_search *s)
{
    const size_t n = s->p->n;

    for (size_t i = 0; i < s->p->m; i++) {
        const double error = s->r->f_error[i];
        double reach = 1e-13 * s->unit_f[i];

        reach += isnan(error) ? 1e-9 * s->unit_f[i] : 10 * error;
        for (size_t j = 0; j < n; j++)
            if (isfinite(s->slope[i * n + j]))
                reach += fabs(s->slope[i * n + j]) * 4 * DBL_EPSILON * fabs(s->r->u[j]);
        if (!(fabs(s->r->f[i]) <= fmin(reach, s->small[i])))
            return false;
    }
    return true;
}

/* The order of the zero that the steps lead to, by this place and the last one: at u the step w is -(u -
 * zero)/order. */
void
qdot_zero_estimate_order(qdot_zero_search *s)
{
    const size_t n = s->p->n;
    double both = 0, square = 0;
    bool is_clear = false;

    for (size_t i = 0; i < s->p->m; i++)
        is_clear = is_clear || fabs(s->r->f[i]) > clear * (isnan(s->r->f_error[i]) ? 1e-9 * s->unit_f[i]
                                                                                  : s->r->f_error[i]);
    if (!is_clear)
        return;
    for (size_t j = 0; j < n && s->has_last; j++) {
        const double du = (s->r->u[j] - s->last_u[j]) / s->unit[j];

        square += du * du;
        both += du * (s->last[j] - s->whole[j]) / s->unit[j];
    }
    if (square > 0)
        s->order = both > square / highest_order ? fmax(1, square / both) : highest_order;
    memcpy(s->last_u, s->r->u, n * sizeof *s->last_u);
    memcpy(s->last, s->whole, n * sizeof *s->last);
    s->has_last = true;
}

/* Compute the errors of the unknowns; a zero with large errors is called vague. */
void
qdot_zero_state_errors(qdot_zero_search *s)
{
    qdot_zero_result *r = s->r;

    for (size_t j = 0; j < s->p->n; j++) {
        r->error[j] = s->order * (fabs(s->whole[j]) + s->from_error[j]) + DBL_EPSILON * fabs(r->u[j]);
        if (r->answer == QDOT_ZERO_FOUND && r->error[j] > least_known * fmax(s->unit[j], fabs(r->u[j])))
            r->answer = QDOT_ZERO_VAGUE;
    }
}

