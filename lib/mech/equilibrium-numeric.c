/* equilibrium-numeric.c -- roots of the equations at rest from many starts, each refined. */
#include <math.h>

#include <gsl/gsl_multiroots.h>

#include "base/interrupt.h"
#include "mech/derived.h"
#include "mech/equilibrium.h"

enum { STARTS = 240, STEPS = 200, MOST = 100 };

typedef struct {
    qdot_pool *pool;
    size_t n;
    const qdot_expr *u, *r;
    qdot_status status;
} problem;

static int
evaluate(const gsl_vector *x, void *user, gsl_vector *f)
{
    problem *p = user;

    p->status =
        qdot_generic_evaluate(p->pool, p->n, p->r, p->n, p->u, x->data, 1, f->data);
    if (p->status != QDOT_OK)
        return GSL_EFAILED;
    for (size_t i = 0; i < p->n; i++)
        if (!isfinite(f->data[i]))
            return GSL_EDOM;
    return GSL_SUCCESS;
}

static double
size_at(problem *p, const double *x, double *f)
{
    double size = 0;

    p->status = qdot_generic_evaluate(p->pool, p->n, p->r, p->n, p->u, x, 1, f);
    for (size_t i = 0; i < p->n; i++)
        size = isfinite(f[i]) ? fmax(size, fabs(f[i])) : INFINITY;
    return size;
}

static double
bound(const qdot_pool *pool, qdot_expr e, double otherwise)
{
    double v;

    if (e == QDOT_NIL ||
        qdot_generic_evaluate(pool, 1, &e, 0, NULL, NULL, 1, &v) != QDOT_OK ||
        qdot_expr_node(pool, e)->holds & ~(uint32_t)QDOT_HAS_FUN)
        return otherwise;
    return v;
}

/* Where the unknown may be; an angle is turned into -pi < q <= pi where the equations repeat. */
static bool
settle(problem *p, double *x, double *f)
{
    for (size_t i = 0; i < p->n; i++) {
        const qdot_symbol *q = qdot_expr_symbol(p->pool, p->u[i]);
        double lo = bound(p->pool, q->lo, -INFINITY),
               hi = bound(p->pool, q->hi, INFINITY);
        double was = x[i],
               turned = was - 2 * M_PI * ceil((was - M_PI) / (2 * M_PI) - 1e-9);

        if (was <= lo || was >= hi)
            return false;
        if (q->class != QDOT_COORD || isfinite(lo) || isfinite(hi) || turned == was)
            continue;
        x[i] = turned;
        if (!(size_at(p, x, f) < 1e-8))
            x[i] = was;
    }
    return p->status == QDOT_OK;
}

static bool
is_new(const double *found, size_t count, size_t n, const double *x)
{
    for (size_t k = 0; k < count; k++) {
        double apart = 0;

        for (size_t i = 0; i < n; i++)
            apart = fmax(apart, fabs(found[k * n + i] - x[i]) / fmax(1, fabs(x[i])));
        if (apart < 1e-7)
            return false;
    }
    return true;
}

static bool
refine(problem *p, gsl_multiroot_fsolver *solver, gsl_vector *x)
{
    gsl_multiroot_function F = {evaluate, p->n, p};

    if (gsl_multiroot_fsolver_set(solver, &F, x) != GSL_SUCCESS)
        return false;
    for (int k = 0; k < STEPS; k++) {
        if (gsl_multiroot_fsolver_iterate(solver) != GSL_SUCCESS)
            break;
        if (gsl_multiroot_test_residual(solver->f, 1e-14) == GSL_SUCCESS)
            break;
    }
    return gsl_multiroot_test_residual(solver->f, 1e-9) == GSL_SUCCESS;
}

/* Ascending, by the first unknown, then the next. */
static void
sort(double *found, size_t count, size_t n)
{
    for (size_t a = 1; a < count; a++)
        for (size_t b = a; b > 0; b--) {
            double *x = found + (b - 1) * n, *y = found + b * n;
            size_t i = 0;

            while (i < n && fabs(x[i] - y[i]) < 1e-9)
                i++;
            if (i == n || x[i] < y[i])
                break;
            for (i = 0; i < n; i++) {
                double keep = x[i];

                x[i] = y[i];
                y[i] = keep;
            }
        }
}

qdot_status
qdot_equilibrium_search(qdot_scene *s, size_t n, const qdot_expr *u, const qdot_expr *r,
                        double **found, size_t *count)
{
    problem p = {.pool = s->pool, .n = n, .u = u, .r = r};
    gsl_error_handler_t *before = gsl_set_error_handler_off();
    gsl_multiroot_fsolver *solver =
        gsl_multiroot_fsolver_alloc(gsl_multiroot_fsolver_hybrids, n);
    gsl_vector *x = gsl_vector_alloc(n);
    double *f = qdot_calloc(n, sizeof *f);
    qdot_status status = QDOT_OK;

    *count = 0;
    *found = qdot_calloc(MOST * n, sizeof **found);
    if (solver == NULL || x == NULL || f == NULL || *found == NULL)
        status = QDOT_ENOMEM;
    for (uint64_t k = 0; k < STARTS && *count < MOST && status == QDOT_OK; k++) {
        status = qdot_interrupt_check();
        for (size_t i = 0; i < n; i++) {
            const qdot_symbol *q = qdot_expr_symbol(s->pool, u[i]);
            bool bounded = q->lo != QDOT_NIL || q->hi != QDOT_NIL;

            gsl_vector_set(
                x, i, (bounded ? 1 : 2.2) * qdot_generic_value(s->pool, u[i], k + 1));
        }
        if (status == QDOT_OK && refine(&p, solver, x) &&
            settle(&p, solver->x->data, f) &&
            is_new(*found, *count, n, solver->x->data)) {
            for (size_t i = 0; i < n; i++)
                (*found)[*count * n + i] =
                    fabs(solver->x->data[i]) < 1e-14 ? 0 : solver->x->data[i];
            ++*count;
        }
        if (status == QDOT_OK && p.status != QDOT_OK)
            status = p.status;
    }
    sort(*found, *count, n);
    gsl_multiroot_fsolver_free(solver);
    gsl_vector_free(x);
    qdot_free(f);
    gsl_set_error_handler(before);
    if (status != QDOT_OK) {
        qdot_free(*found);
        *found = NULL;
    }
    return status;
}
