/* nearest.c -- the equations lowered, measured in balls, and refined. The search itself:
 * nearest-search.c. */
#include "sim/start/nearest.h"

#include <math.h>
#include <string.h>

#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "normal/refute/ball.h"

enum { MOST_REFINEMENTS = 150 };

void
qdot_nearest_end(qdot_nearest *p)
{
    qdot_tape_free(p->tape);
    qdot_tape_free(p->curved);
    qdot_free(p->A);
    qdot_free(p->place);
    qdot_free(p->linear);
    qdot_free(p->constant);
    qdot_free(p->value);
    qdot_free(p->work);
}

/* --- evaluation in ball arithmetic -------------------------------------------------- */

/* A point at which F and A are evaluated; its unknowns have the exact given values, or at + low, or are 0. */
typedef struct {
    const qdot_nearest *p;
    enum { AS_GIVEN, MOVED, AT_ZERO } unknowns;
    const double *at, *low;
} point;

static bool
point_value_of(void *user, qdot_expr atom, arb_t value, slong prec)
{
    const point *x = user;
    const qdot_nearest *p = x->p;
    size_t i = 0;

    while (i < p->inputs && p->symbol[i] != atom)
        i++;
    if (i == p->inputs)
        return false;
    if (x->unknowns == AS_GIVEN || i < p->first || i >= p->first + p->n) {
        arb_set(value, p->given->at + i);
    } else if (x->unknowns == AT_ZERO) {
        arb_zero(value);
    } else {
        arb_t low;

        arb_init(low);
        arb_set_d(value, x->at[i]);
        arb_set_d(low, x->low[i]);
        arb_add(value, value, low, prec);
        arb_clear(low);
    }
    return true;
}

/* Evaluate the expressions e [m] at a point, each rounded only once. */
static qdot_status
point_evaluate(const point *x, size_t m, const qdot_expr *e, double *out)
{
    qdot_ball ball;

    QDOT_TRY(qdot_ball_begin(&ball, x->p->pool, m, e));
    qdot_ball_eval(&ball, QDOT_GIVEN_BITS, point_value_of, (void *)x);
    for (size_t k = 0; k < m; k++)
        out[k] = qdot_given_double(qdot_ball_get(&ball, e[k]));
    qdot_ball_end(&ball);
    return QDOT_OK;
}

/* --- evaluating F and A ------------------------------------------------------------- */

static bool
contains_unknowns(const qdot_nearest *p, qdot_expr e)
{
    const qdot_expr atoms = qdot_expr_atoms(p->pool, e, false);

    for (uint32_t k = 0; k < qdot_expr_count(p->pool, atoms); k++)
        for (size_t i = 0; i < p->n; i++)
            if (qdot_expr_arg(p->pool, atoms, k) == p->symbol[p->first + i])
                return true;
    return false;
}

/* Find the equations F_k that are linear, and their constant coefficients; `out` [m + m*n]: F and A. */
static qdot_status
find_linear_equations(qdot_nearest *p, const qdot_expr *out)
{
    const size_t m = p->m, n = p->n;
    const point zero = {.p = p, .unknowns = AT_ZERO};

    p->linear = qdot_calloc(m + 1, sizeof *p->linear);
    p->constant = qdot_calloc(m + m * n + 1, sizeof *p->constant);
    if (!p->linear || !p->constant)
        return QDOT_ENOMEM;
    QDOT_TRY(point_evaluate(&zero, m + m * n, out, p->constant));
    for (size_t k = 0; k < m; k++) {
        p->linear[k] = isfinite(p->constant[k]);
        for (size_t e = m + k * n; e < m + (k + 1) * n && p->linear[k]; e++)
            p->linear[k] = isfinite(p->constant[e]) && !contains_unknowns(p, out[e]);
    }
    return qdot_pool_check(p->pool);
}

qdot_status
qdot_nearest_begin(qdot_nearest *p)
{
    size_t m = p->m, n = p->n, size = m + m * n;
    qdot_expr *out = qdot_calloc(size + 1, sizeof *out);
    qdot_status status = out ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK) {
        p->A = out + m;
        memcpy(out, p->F, m * sizeof *out);
        for (size_t k = 0; k < m; k++)
            for (size_t i = 0; i < n; i++)
                p->A[k * n + i] = qdot_diff(p->pool, p->F[k], p->symbol[p->first + i]);
        status = qdot_pool_check(p->pool);
    }
    if (status == QDOT_OK)
        status = qdot_tape_new(p->pool, p->inputs, p->symbol, size, out, &p->tape);
    if (status == QDOT_OK) {
        p->value = qdot_calloc(size + 1, sizeof *p->value);
        p->work = qdot_calloc(qdot_tape_work(p->tape) + 1, sizeof *p->work);
        status = p->value && p->work ? QDOT_OK : QDOT_ENOMEM;
    }
    if (status == QDOT_OK)
        status = find_linear_equations(p, out);
    p->A = NULL;
    if (status == QDOT_OK) {
        p->A = out;
        memmove(out, out + m, m * n * sizeof *out);
    } else {
        qdot_free(out);
        qdot_nearest_end(p);
    }
    return status;
}

void
qdot_nearest_evaluate(qdot_nearest *p, const double *at)
{
    const size_t m = p->m, n = p->n;

    qdot_tape_eval(p->tape, at, p->value, p->work);
    for (size_t k = 0; k < m; k++) {
        const double *slopes = p->constant + m + k * n;

        if (!p->linear[k])
            continue;
        p->value[k] = p->constant[k];
        for (size_t i = 0; i < n; i++)
            p->value[k] += slopes[i] * at[p->first + i];
        memcpy(p->value + m + k * n, slopes, n * sizeof *slopes);
    }
}

double
qdot_nearest_length(const double *x, size_t n)
{
    double sum = 0;

    for (size_t i = 0; i < n; i++)
        sum = hypot(sum, x[i]);
    return sum;
}

qdot_status
qdot_nearest_distance(qdot_nearest *p, const double *at, double *distance, double *residual)
{
    const double *A = p->value + p->m;
    const point start = {.p = p, .unknowns = AS_GIVEN};

    QDOT_TRY(point_evaluate(&start, p->m, p->F, distance));
    qdot_nearest_evaluate(p, at);
    for (size_t k = 0; k < p->m; k++) {
        double F = distance[k], slope = qdot_nearest_length(A + k * p->n, p->n);

        if (residual)
            residual[k] = F;
        distance[k] = F == 0 ? 0 : isfinite(slope) ? fabs(F) / slope : INFINITY;
    }
    return QDOT_OK;
}

/* --- the last digits ----------------------------------------------------------------
 *
 * Where A vanishes at the answer (a rod at its dead point) each step only halves what is
 * left: hence so many. */

typedef struct {
    qdot_row_space rows;
    double *F, *A, *step;
    size_t *index, n; /* [n] indices of the free unknowns */
} refinement;

static qdot_status
refine_solution(qdot_nearest *p, refinement *r, double *at, double *low)
{
    const point moved = {.p = p, .unknowns = MOVED, .at = at, .low = low};

    for (int k = 0; k < MOST_REFINEMENTS; k++) {
        double most = 0;

        QDOT_TRY(point_evaluate(&moved, p->m, p->F, r->F));
        qdot_nearest_evaluate(p, at);
        for (size_t i = 0; i < p->m; i++) {
            r->F[i] = -r->F[i];
            for (size_t j = 0; j < r->n; j++)
                r->A[i * r->n + j] = p->value[p->m + i * p->n + r->index[j]];
        }
        qdot_row_space_factor(&r->rows, r->A, 1e-10, false);
        qdot_row_space_shortest(&r->rows, r->F, r->step, NULL);
        for (size_t j = 0; j < r->n; j++) {
            size_t i = p->first + r->index[j];
            double beyond = low[i] + r->step[j], sum = at[i] + beyond;

            if (!isfinite(sum))
                return QDOT_OK;
            most = fmax(most, fabs(r->step[j]) / fmax(1, fabs(at[i])));
            low[i] = beyond - (sum - at[i]);
            at[i] = sum;
        }
        if (most < 1e-30)
            break;
    }
    return QDOT_OK;
}

qdot_status
qdot_nearest_refine(qdot_nearest *p, const bool *free, double *at, double *low)
{
    refinement r = {0};
    size_t m = p->m;
    qdot_status status;

    r.index = qdot_calloc(p->n + 1, sizeof *r.index);
    r.F = qdot_calloc(m + m * p->n + p->n + 1, sizeof *r.F);
    status = r.index && r.F ? QDOT_OK : QDOT_ENOMEM;
    if (status == QDOT_OK) {
        r.A = r.F + m;
        r.step = r.A + m * p->n;
        for (size_t i = 0; i < p->n; i++)
            if (free[i])
                r.index[r.n++] = i;
        status = qdot_row_space_init(&r.rows, m, r.n);
    }
    if (status == QDOT_OK && r.n > 0)
        status = refine_solution(p, &r, at, low);
    qdot_row_space_clear(&r.rows);
    qdot_free(r.index);
    qdot_free(r.F);
    return status;
}
