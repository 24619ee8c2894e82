/* radau-linear.c -- fills and factors the matrices of a Radau step, and solves with them. */
#include "ode/radau-linear.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "num/lu.h"
#include "ode/run.h"

void
qdot_radau_linear_clear(qdot_radau_linear *l)
{
    qdot_free(l->room);
    qdot_free(l->rows[0]);
    qdot_free(l->pattern);
    qdot_free(l->order);
    *l = (qdot_radau_linear){0};
}

qdot_status
qdot_radau_linear_init(qdot_radau_linear *l, const qdot_ode_system *system)
{
    const qdot_ode_mass_form *form = system->mass_form;
    const size_t v = form ? form->m : system->n, m = v + (form ? form->k : 0), cells = m * m;
    const qdot_part parts[] = {{&l->dq, cells},    {&l->dv, cells},    {&l->mass, cells},
                               {&l->dt, m},        {&l->put[0], m},    {&l->put[1], m},
                               {&l->re[0], cells}, {&l->re[1], cells}, {&l->im[1], cells},
                               {&l->re[2], cells}, {&l->im[2], cells}, {&l->re[3], cells},
                               {&l->im[3], cells}};

    *l = (qdot_radau_linear){.system = system, .m = m, .v = v, .p = system->n - v};
    QDOT_TRY(qdot_calloc_parts(&l->room, sizeof parts / sizeof parts[0], parts));
    l->rows[0] = qdot_calloc(QDOT_RADAU_SPACES * m, sizeof *l->rows[0]);
    l->pattern = qdot_calloc(cells, sizeof *l->pattern);
    l->order = qdot_calloc(2 * m, sizeof *l->order);
    if (!l->rows[0] || !l->pattern || !l->order)
        return QDOT_ENOMEM;
    l->scratch = l->order + m;
    for (size_t i = 0; i < m; i++)
        l->order[i] = i;
    for (size_t k = 1; k < QDOT_RADAU_SPACES; k++)
        l->rows[k] = l->rows[0] + k * m;
    return QDOT_OK;
}

static qdot_status
check_finite(const double *x, size_t n, const char *what)
{
    return qdot_ode_all_finite(x, n) ? QDOT_OK
                                     : qdot_fail(QDOT_EDOMAIN, "the %s is not finite", what);
}

qdot_status
qdot_radau_residual(const qdot_radau_linear *l, double t, const double *y,
                    const double *a, const double *z, double *r)
{
    const qdot_ode_mass_form *form = l->system->mass_form;

    if (form) {
        QDOT_TRY(form->residual(t, y, a, z, r, form->user));
    } else {
        QDOT_TRY(l->system->rhs(t, y, r, l->system->user));
        for (size_t i = 0; i < l->m; i++)
            r[i] -= a[i];
    }
    return check_finite(r, l->m, "right-hand side");
}

/* Choose a new order of the unknowns if entries are non-zero that were 0 so far. */
static void
update_pattern(qdot_radau_linear *l)
{
    enum { few = 4 };
    const size_t m = l->m;
    bool more = false;

    for (size_t i = 0; i < m && m > few; i++)
        for (size_t j = 0; j < m; j++) {
            const size_t at = i * m + j;

            if (l->pattern[at] || (l->mass[at] == 0 && l->dq[at] == 0 && l->dv[at] == 0))
                continue;
            more = l->pattern[at] = l->pattern[j * m + i] = true;
        }
    if (more)
        qdot_lu_order(m, l->pattern, l->order, l->scratch);
}

qdot_status
qdot_radau_slopes(qdot_radau_linear *l, double t, const double *y, const double *a, double *z)
{
    const qdot_ode_mass_form *form = l->system->mass_form;
    const size_t m = l->m;

    if (form) {
        QDOT_TRY(form->slopes(t, y, a, z, l->dq, l->dv, l->mass, form->user));
    } else {
        QDOT_TRY(l->system->jacobian(t, y, l->dv, l->dt, l->system->user));
        for (size_t i = 0; i < m; i++)
            l->mass[i * m + i] = 1;
    }
    QDOT_TRY(check_finite(l->dq, m * m, "Jacobian"));
    QDOT_TRY(check_finite(l->mass, m * m, "Jacobian"));
    QDOT_TRY(check_finite(l->dv, m * m, "Jacobian"));
    update_pattern(l);
    return QDOT_OK;
}

static bool
factor_for_eigenspace(qdot_radau_linear *l, size_t k, double h)
{
    const double a = l->basis->lambda_re[k], b = l->basis->lambda_im[k],
                 size = a * a + b * b;
    const double M_re = a / h, q_re = l->p ? h * a / size : 0;
    const double M_im = b / h, q_im = l->p ? -h * b / size : 0;
    double *re = l->re[k], *im = l->im[k];
    const size_t m = l->m;

    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < m; j++) {
            const size_t from = l->order[i] * m + l->order[j], at = i * m + j;

            re[at] = M_re * l->mass[from] - l->dv[from] - q_re * l->dq[from];
            if (k > 0)
                im[at] = M_im * l->mass[from] - q_im * l->dq[from];
        }
    return k == 0 ? qdot_lu_factor(m, re, l->rows[k])
                  : qdot_lu_factor_complex(m, re, im, l->rows[k]);
}

bool
qdot_radau_factor(qdot_radau_linear *l, const qdot_radau_basis *basis, double h)
{
    l->basis = basis;
    for (size_t k = 0; k < basis->spaces; k++)
        if (!factor_for_eigenspace(l, k, h))
            return false;
    return true;
}

void
qdot_radau_solve(const qdot_radau_linear *l, size_t k, double *re, double *im)
{
    double *x = l->put[0], *y = l->put[1];

    for (size_t i = 0; i < l->m; i++) {
        x[i] = re[l->order[i]];
        y[i] = k ? im[l->order[i]] : 0;
    }
    if (k == 0)
        qdot_lu_solve(l->m, l->re[0], l->rows[0], x);
    else
        qdot_lu_solve_complex(l->m, l->re[k], l->im[k], l->rows[k], x, y);
    for (size_t i = 0; i < l->m; i++) {
        re[l->order[i]] = x[i];
        if (k > 0)
            im[l->order[i]] = y[i];
    }
}

void
qdot_radau_weigh(const qdot_radau_linear *l, const double *v, const double *q, double *b)
{
    const size_t m = l->m;

    for (size_t i = 0; i < m; i++) {
        double sum = 0;

        for (size_t j = 0; j < l->v; j++)
            sum += l->mass[i * m + j] * v[j] + (q ? l->dq[i * m + j] * q[j] : 0);
        b[i] = sum;
    }
}

void
qdot_radau_noise(const qdot_radau_linear *l, const double *y, const double *a, const double *z,
                 double *b)
{
    const size_t m = l->m;

    for (size_t i = 0; i < m; i++) {
        double sum = 0;

        for (size_t j = l->v; j < m; j++)
            sum += fabs(l->dv[i * m + j] * z[j - l->v]);
        for (size_t j = 0; j < l->v; j++) {
            const size_t at = i * m + j;

            sum += fabs(l->dv[at] * y[l->p + j]) + fabs(l->mass[at] * a[j]) +
                   (l->p ? fabs(l->dq[at] * y[j]) : 0);
        }
        b[i] = DBL_EPSILON * (i % 2 ? -sum : sum);
    }
}
