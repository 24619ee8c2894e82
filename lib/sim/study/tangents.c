/* tangents.c -- projects states onto the constraints by Newton's method, and finds tangents to them. */
#include "sim/study/tangents.h"

#include <math.h>
#include <string.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>

#include "base/memory.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "mech/dynamics/integrated.h"
#include "sim/model/massless.h"
#include "sim/model/substitute.h"

/* Singular values smaller than this fraction of the largest count as 0. */
static const double least_singular = 1e-9;
/* `rounding`: a relative change of a state that counts as none. `left`: a residual of F that counts
 * as 0, relative to its terms. */
static const double rounding = 4e-15, left = 1e-9;
enum { STEPS = 30 };

static void
add_condition(qdot_scene *s, const qdot_run_request *r, qdot_expr f, bool of_positions, qdot_expr *F, size_t *rows)
{
    F[(*rows)++] = qdot_substitute(s->pool, f, r->n_values, r->symbols, r->values);
    if (of_positions)
        F[(*rows)++] = qdot_substitute(s->pool, qdot_ddt(s->pool, f), r->n_values, r->symbols, r->values);
}

/* Write F: conditions on states from constraints and from massless coordinates, as expressions. */
static void
write_conditions(qdot_scene *s, const qdot_run_request *r, const qdot_massless *massless, qdot_expr *F, size_t *rows)
{
    qdot_expr mu;

    *rows = 0;
    for (size_t c = 0; c < s->constraints.n; c++)
        if (s->constraints.at[c].kind != QDOT_ACCELERATION)
            add_condition(s, r, qdot_integrated_rate(s, c, &mu), s->constraints.at[c].kind == QDOT_HOLONOMIC, F, rows);
    for (size_t c = 0; c < massless->n; c++)
        add_condition(s, r, massless->equations[c], massless->of_positions[c], F, rows);
}

/* Whether the motion never leaves the surface f = const in space to which a velocity constraint holds it, by itself
 * or with the others together. */
static qdot_status
has_known_integral(qdot_scene *s, size_t c, bool *yes)
{
    qdot_expr mu;

    *yes = false;
    if (s->constraints.at[c].kind != QDOT_VELOCITY)
        return QDOT_OK;
    *yes = qdot_integrated_of(s, c, &mu) != QDOT_NIL;
    QDOT_TRY(qdot_pool_check(s->pool));
    return *yes ? QDOT_OK : qdot_mech_is_holonomic(s, yes);
}

/* The slopes of such a surface by q, in the rows of F behind those of the conditions: df/dq_i' of the constraint. F there
 * is 0, on whichever leaf the state is. */
static qdot_status
write_integrals(qdot_tangents *x, qdot_scene *s, const qdot_run_request *r, qdot_expr *slopes)
{
    const size_t n = x->z / 2, all = x->z + x->p;

    for (size_t c = 0; c < s->constraints.n; c++) {
        bool leaf;
        qdot_expr mu, f;

        QDOT_TRY(has_known_integral(s, c, &leaf));
        if (!leaf)
            continue;
        f = qdot_integrated_rate(s, c, &mu);
        for (size_t i = 0; i < n; i++)
            slopes[x->leaves * all + i] =
                qdot_substitute(s->pool, qdot_diff(s->pool, f, qdot_symbol_jet(s->pool, s->coordinates.at[i], 1)),
                                r->n_values, r->symbols, r->values);
        for (size_t i = n; i < all; i++)
            slopes[x->leaves * all + i] = QDOT_ZERO;
        x->leaves++;
    }
    return qdot_pool_check(s->pool);
}

/* Lower F and its gradients, then those of the integrals that label leaves, as functions of z, p,
 * t. Room: F [most], gradients [most x all]. */
static qdot_status
make_tapes_of_conditions(qdot_tangents *x, qdot_scene *s, const qdot_run_request *request, const qdot_massless *massless,
                         const qdot_expr *parameters)
{
    const size_t n = x->z / 2, all = x->z + x->p, most = 2 * massless->n + 3 * s->constraints.n;
    qdot_expr *in = qdot_calloc(2 * (all + 1) + most * (1 + all), sizeof *in), *const F = in + all + 1;
    qdot_status status = in ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < all && in; i++)
        in[i] = i < x->z ? qdot_symbol_jet(s->pool, s->coordinates.at[i % n], i >= n) : parameters[i - x->z];
    if (status == QDOT_OK) {
        in[all] = QDOT_T;
        write_conditions(s, request, massless, F, &x->rows);
        for (size_t k = 0; k < x->rows; k++)
            for (size_t i = 0; i < all; i++)
                F[x->rows + k * all + i] = qdot_diff(s->pool, F[k], in[i]);
        status = write_integrals(x, s, request, F + x->rows * (1 + all));
    }
    if (status == QDOT_OK && x->rows > 0)
        status = qdot_tape_new(s->pool, all + 1, in, x->rows * (1 + all) + x->leaves * all, F, &x->tape);
    qdot_free(in);
    return status;
}

static qdot_status
tangents_allocate(qdot_tangents *x)
{
    const size_t rows = x->rows + x->leaves, all = x->z + x->p, high = rows > x->z ? rows : x->z;

    x->in = qdot_calloc(all + 1 + x->rows + rows * all + qdot_tape_work(x->tape) + 1, sizeof *x->in);
    x->U = gsl_matrix_alloc(high, x->z);
    x->V = gsl_matrix_alloc(x->z, x->z);
    x->S = gsl_vector_alloc(x->z);
    x->room = gsl_vector_alloc(x->z);
    if (!x->in || !x->U || !x->V || !x->S || !x->room)
        return QDOT_ENOMEM;
    x->out = x->in + all + 1;
    x->work = x->out + x->rows + rows * all;
    return QDOT_OK;
}

qdot_status
qdot_tangents_begin(qdot_tangents *x, qdot_scene *scene, const qdot_run_request *request, size_t p,
                    const qdot_expr *parameters)
{
    qdot_massless massless = {0};
    qdot_status status;

    *x = (qdot_tangents){.z = 2 * scene->coordinates.n, .p = p};
    status = qdot_massless_of_scene(scene, request, &massless);
    if (status == QDOT_OK && scene->constraints.n + massless.n > 0)
        status = make_tapes_of_conditions(x, scene, request, &massless, parameters);
    qdot_massless_clear(&massless);
    return status == QDOT_OK && x->rows > 0 ? tangents_allocate(x) : status;
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

/* Evaluate F, factor F_z = U S V^T at x->in; leaves: with constraints' integrals. False: not finite. */
static bool
decompose(qdot_tangents *x, bool leaves)
{
    const size_t rows = x->rows + (leaves ? x->leaves : 0), all = x->z + x->p;
    const double *const slopes = x->out + x->rows;
    gsl_error_handler_t *before = gsl_set_error_handler_off();

    qdot_tape_eval(x->tape, x->in, x->out, x->work);
    gsl_matrix_set_zero(x->U);
    for (size_t k = 0; k < x->rows + rows * all; k++)
        if (!isfinite(x->out[k])) {
            gsl_set_error_handler(before);
            return false;
        }
    for (size_t k = 0; k < rows; k++)
        for (size_t i = 0; i < x->z; i++)
            gsl_matrix_set(x->U, k, i, slopes[k * all + i]);
    (void)gsl_linalg_SV_decomp(x->U, x->V, x->S, x->room);
    gsl_set_error_handler(before);
    for (x->rank = 0; x->rank < x->z; x->rank++)
        if (!(gsl_vector_get(x->S, x->rank) > least_singular * gsl_vector_get(x->S, 0)))
            break;
    return true;
}

/* Subtract F_z^+ b (pseudo-inverse; b [rows]) from `to`; returns the change relative to max(1, |to|). */
static double
subtract_least_correction(const qdot_tangents *x, const double *b, double *to)
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

/* Whether F is 0 within the rounding of its terms, which is estimated from its gradients. */
static bool
are_conditions_met(const qdot_tangents *x)
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
    for (size_t i = 0; i < x->p; i++)
        x->in[x->z + i] = parameters[i];
    x->in[x->z + x->p] = t;
    for (int step = 0; step < STEPS; step++, before = moved) {
        memcpy(x->in, state, x->z * sizeof *state);
        if (!decompose(x, false))
            break;
        moved = subtract_least_correction(x, x->out, state);
        if ((moved <= rounding || (moved < 1e-12 && moved >= before)) && are_conditions_met(x))
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
    (void)subtract_least_correction(x, x->out, slope);
}

size_t
qdot_tangents_basis(qdot_tangents *x, double *basis)
{
    const bool leaves = x->leaves > 0 && decompose(x, true);
    const size_t rank = x->tape != NULL ? x->rank : 0;

    for (size_t k = rank; k < x->z; k++)
        for (size_t i = 0; i < x->z; i++)
            basis[(k - rank) * x->z + i] = x->tape != NULL ? gsl_matrix_get(x->V, i, k) : i == k;
    if (leaves) /* keep the decomposition at the state for qdot_tangents_project */
        (void)decompose(x, false);
    return x->z - rank;
}
