/* tangents.c -- Newton's method onto constraints, and their null space. */
#include "sim/study/tangents.h"

#include <math.h>
#include <string.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>

#include "base/memory.h"
#include "expr/calculus.h"
#include "mech/dynamics/integrated.h"
#include "sim/model/substitute.h"

/* Singular values below so much of the largest count as 0. */
static const double least_singular = 1e-9;
/* Of a state: a change that is rounding. Of what F is made of: what is left of it. */
static const double rounding = 4e-15, left = 1e-9;
enum { STEPS = 30 };

/* F as expressions [rows]. */
static void
write_conditions(qdot_scene *s, const qdot_run_request *r, qdot_expr *F)
{
    size_t row = 0;

    for (size_t c = 0; c < s->constraints.n; c++) {
        const qdot_constraint *of = &s->constraints.at[c];
        qdot_expr f, mu;

        if (of->kind == QDOT_ACCELERATION)
            continue;
        f = qdot_integrated_rate(s, c, &mu);
        F[row++] = qdot_substitute(s->pool, f, r->n_values, r->symbols, r->values);
        if (of->kind == QDOT_HOLONOMIC)
            F[row++] = qdot_substitute(s->pool, qdot_ddt(s->pool, f), r->n_values, r->symbols, r->values);
    }
}

/* F and its slopes, from z, p, t. */
static qdot_status
lower(qdot_tangents *x, qdot_scene *s, const qdot_run_request *request, const qdot_expr *parameters)
{
    const size_t n = x->z / 2, all = x->z + x->p;
    qdot_expr *in = qdot_calloc(all + 1 + x->rows * (1 + all), sizeof *in), *const F = in + all + 1;
    qdot_status status = in ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < all && in; i++)
        in[i] = i < x->z ? qdot_symbol_jet(s->pool, s->coordinates.at[i % n], i >= n) : parameters[i - x->z];
    if (status == QDOT_OK) {
        in[all] = QDOT_T;
        write_conditions(s, request, F);
        for (size_t k = 0; k < x->rows; k++)
            for (size_t i = 0; i < all; i++)
                F[x->rows + k * all + i] = qdot_diff(s->pool, F[k], in[i]);
        status = qdot_pool_check(s->pool);
    }
    if (status == QDOT_OK)
        status = qdot_tape_new(s->pool, all + 1, in, x->rows * (1 + all), F, &x->tape);
    qdot_free(in);
    return status;
}

qdot_status
qdot_tangents_begin(qdot_tangents *x, qdot_scene *scene, const qdot_run_request *request, size_t p,
                    const qdot_expr *parameters)
{
    const size_t z = 2 * scene->coordinates.n;
    size_t high;

    *x = (qdot_tangents){.z = z, .p = p};
    for (size_t c = 0; c < scene->constraints.n; c++)
        x->rows += scene->constraints.at[c].kind == QDOT_HOLONOMIC  ? 2
                   : scene->constraints.at[c].kind == QDOT_VELOCITY ? 1
                                                                    : 0;
    if (x->rows == 0)
        return QDOT_OK;
    QDOT_TRY(lower(x, scene, request, parameters));
    high = x->rows > z ? x->rows : z;
    x->in = qdot_calloc(z + p + 1 + x->rows * (1 + z + p) + qdot_tape_work(x->tape) + 1, sizeof *x->in);
    x->U = gsl_matrix_alloc(high, z);
    x->V = gsl_matrix_alloc(z, z);
    x->S = gsl_vector_alloc(z);
    x->room = gsl_vector_alloc(z);
    if (!x->in || !x->U || !x->V || !x->S || !x->room)
        return QDOT_ENOMEM;
    x->out = x->in + z + p + 1;
    x->work = x->out + x->rows * (1 + z + p);
    return QDOT_OK;
}

void
qdot_tangents_end(qdot_tangents *x)
{
    qdot_tape_free(x->tape);
    qdot_free(x->in);
    gsl_matrix_free(x->U);
    gsl_matrix_free(x->V);
    gsl_vector_free(x->S);
    gsl_vector_free(x->room);
    *x = (qdot_tangents){0};
}

/* F and F_z = U S V^T at x->in. False: they are not finite. */
static bool
decompose(qdot_tangents *x)
{
    const double *const slopes = x->out + x->rows;
    gsl_error_handler_t *before = gsl_set_error_handler_off();

    qdot_tape_eval(x->tape, x->in, x->out, x->work);
    gsl_matrix_set_zero(x->U);
    for (size_t k = 0; k < x->rows * (1 + x->z + x->p); k++)
        if (!isfinite(x->out[k])) {
            gsl_set_error_handler(before);
            return false;
        }
    for (size_t k = 0; k < x->rows; k++)
        for (size_t i = 0; i < x->z; i++)
            gsl_matrix_set(x->U, k, i, slopes[k * (x->z + x->p) + i]);
    (void)gsl_linalg_SV_decomp(x->U, x->V, x->S, x->room);
    gsl_set_error_handler(before);
    for (x->rank = 0; x->rank < x->z; x->rank++)
        if (!(gsl_vector_get(x->S, x->rank) > least_singular * gsl_vector_get(x->S, 0)))
            break;
    return true;
}

/* to -= F_z^+ b [rows]; returns how far relative to max(1, |to|) it moved. */
static double
subtract(const qdot_tangents *x, const double *b, double *to)
{
    double most = 0;

    for (size_t i = 0; i < x->z; i++) {
        double by = 0;

        for (size_t k = 0; k < x->rank; k++) {
            double along = 0;

            for (size_t j = 0; j < x->rows; j++)
                along += gsl_matrix_get(x->U, j, k) * b[j];
            by += gsl_matrix_get(x->V, i, k) * along / gsl_vector_get(x->S, k);
        }
        most = fmax(most, fabs(by) / fmax(1, fabs(to[i])));
        to[i] -= by;
    }
    return most;
}

/* Whether F is 0 as far as its slopes know it: where they vanish, no change says so. */
static bool
is_met(const qdot_tangents *x)
{
    for (size_t k = 0; k < x->rows; k++) {
        const double *const slopes = x->out + x->rows + k * (x->z + x->p);
        double size = left;

        for (size_t i = 0; i < x->z; i++)
            size += fabs(slopes[i]) * fmax(1, fabs(x->in[i]));
        if (!(fabs(x->out[k]) <= left * size))
            return false;
    }
    return true;
}

qdot_status
qdot_tangents_settle(qdot_tangents *x, double t, const double *parameters, double *state)
{
    double moved = INFINITY, before = INFINITY;

    if (x->tape == NULL)
        return QDOT_OK;
    memcpy(x->in + x->z, parameters, x->p * sizeof *parameters);
    x->in[x->z + x->p] = t;
    for (int step = 0; step < STEPS; step++, before = moved) {
        memcpy(x->in, state, x->z * sizeof *state);
        if (!decompose(x))
            break;
        moved = subtract(x, x->out, state);
        if ((moved <= rounding || (moved < 1e-12 && moved >= before)) && is_met(x))
            return QDOT_OK;
    }
    return qdot_fail(QDOT_EFAILED, "a state cannot be brought onto the constraints");
}

void
qdot_tangents_project(const qdot_tangents *x, size_t by, double *slope)
{
    const double *const slopes = x->out + x->rows;
    const size_t all = x->z + x->p;

    if (x->tape == NULL)
        return;
    for (size_t k = 0; k < x->rows; k++) {
        x->out[k] = by == SIZE_MAX ? 0 : slopes[k * all + x->z + by];
        for (size_t i = 0; i < x->z; i++)
            x->out[k] += slopes[k * all + i] * slope[i];
    }
    (void)subtract(x, x->out, slope);
}

void
qdot_tangents_basis(const qdot_tangents *x, double *basis)
{
    const size_t rank = x->tape != NULL ? x->rank : 0;

    for (size_t k = rank; k < x->z; k++)
        for (size_t i = 0; i < x->z; i++)
            basis[(k - rank) * x->z + i] = x->tape != NULL ? gsl_matrix_get(x->V, i, k) : i == k;
}
