/* newton.c -- Newton's iteration with the derivatives of a tape. */
#include "sim/branches/newton.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "normal/solve/isolate.h"
#include "tape/derivative.h"

/* Newton steps that no longer shrink below this relative length may be dominated by rounding. */
static const double blurred = 1e-5;

enum {
    STEPS = 30,
    MOST_PROVED = 40 /* largest number of unknowns for a proof, which needs n^2 expressions */
};

qdot_status
qdot_newton_begin(qdot_newton *s, qdot_pool *pool, size_t n)
{
    *s = (qdot_newton){.pool = pool, .n = n};
    s->x = qdot_calloc(2 * n + 1, sizeof *s->x);
    s->f_value = qdot_calloc(2 * n + n * n + 1, sizeof *s->f_value);
    s->rows = qdot_calloc(n + 1, sizeof *s->rows);
    if (!s->x || !s->f_value || !s->rows)
        return QDOT_ENOMEM;
    s->f = s->x + n;
    s->step = s->f_value + n;
    s->J = s->step + n;
    return QDOT_OK;
}

qdot_status
qdot_newton_lower(qdot_newton *s)
{
    QDOT_TRY(qdot_pool_check(s->pool));
    QDOT_TRY(qdot_tape_new(s->pool, s->n, s->x, s->n, s->f, &s->tape));
    s->work = qdot_malloc(qdot_derivative_work(s->tape) * sizeof *s->work);
    return s->work ? QDOT_OK : QDOT_ENOMEM;
}

void
qdot_newton_end(qdot_newton *s)
{
    qdot_tape_free(s->tape);
    qdot_free(s->x);
    qdot_free(s->f_value);
    qdot_free(s->rows);
    qdot_free(s->work);
    *s = (qdot_newton){0};
}

/* Make one Newton step; returns its length relative to max(1, |x|), INFINITY if J is singular. */
static double
newton_step_length(qdot_newton *s, double *x)
{
    double most = 0;

    qdot_derivative_eval(s->tape, x, 0, s->n, s->f_value, s->J, s->work);
    for (size_t i = 0; i < s->n; i++)
        s->step[i] = -s->f_value[i];
    if (!qdot_lu_factor(s->n, s->J, s->rows))
        return INFINITY;
    qdot_lu_solve(s->n, s->J, s->rows, s->step);
    for (size_t i = 0; i < s->n; i++) {
        if (!isfinite(s->step[i]))
            return INFINITY;
        most = fmax(most, fabs(s->step[i]) / fmax(1, fabs(x[i])));
    }
    for (size_t i = 0; i < s->n; i++)
        x[i] += s->step[i];
    return most;
}

static qdot_status
prove_solution(qdot_newton *s, double *x, double *error)
{
    qdot_isolate isolate;

    for (size_t i = 0; i < s->n; i++)
        error[i] = 2 * fabs(s->step[i]) + 2e-16 * fabs(x[i]);
    s->regular = s->n > MOST_PROVED;
    if (s->regular)
        return QDOT_OK;
    QDOT_TRY(qdot_isolate_begin(&isolate, s->pool, s->n, s->f, s->x));
    for (size_t i = 0; i < s->n; i++)
        s->f_value[i] = x[i];
    s->regular = qdot_isolate_prove(&isolate, s->f_value, s->step);
    if (s->regular)
        for (size_t i = 0; i < s->n; i++) {
            x[i] = s->f_value[i];
            error[i] = s->step[i];
        }
    qdot_isolate_end(&isolate);
    return QDOT_OK;
}

/* Iterate Newton's method from x until only rounding is left; then prove that a solution exists there. */
static qdot_status
iterate(qdot_newton *s, double *x, double *error, bool *found)
{
    double before = INFINITY, length = INFINITY;

    *found = false;
    for (int k = 0; k < STEPS; k++) {
        length = newton_step_length(s, x);
        if (!(length < 1e3))
            return QDOT_OK;
        *found = length < 1e-9;
        if (length < 1e-15 || (*found && length > before / 2))
            break;
        before = length;
    }
    if (*found || length > blurred || s->n > MOST_PROVED)
        return *found ? prove_solution(s, x, error) : QDOT_OK;
    QDOT_TRY(prove_solution(s, x, error)); /* doubles cannot separate two close zeros, but ball arithmetic may */
    *found = s->regular;
    return QDOT_OK;
}

qdot_status
qdot_newton_solve(qdot_newton *s, double *x, double *error, bool *found)
{
    const size_t n = s->n;
    double *start = qdot_malloc((2 * n + 1) * sizeof *start), *start_error = start + n;
    qdot_status status = start ? QDOT_OK : QDOT_ENOMEM;

    *found = s->regular = false;
    if (status == QDOT_OK) {
        memcpy(start, x, n * sizeof *x);
        status = iterate(s, x, error, found);
    }
    if (status == QDOT_OK && !s->regular && n <= MOST_PROVED) { /* rounding may have led away from a good guess: test that */
        memset(s->step, 0, n * sizeof *s->step);
        status = prove_solution(s, start, start_error);
        if (status == QDOT_OK && s->regular) {
            *found = true;
            memcpy(x, start, n * sizeof *x);
            memcpy(error, start_error, n * sizeof *error);
        }
    }
    qdot_free(start);
    return status;
}
