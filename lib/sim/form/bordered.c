/* bordered.c -- order 0 by hand, the others by the program. */
#include "sim/form/bordered.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "num/bordered.h"
#include "sim/form/eliminated.h"
#include "sim/form/expansion.h"
#include "sim/form/guarded.h"
#include "sim/model/constrained.h"
#include "sim/model/constraints.h"
#include "sim/model/power-quotient.h"

enum { most_order = 44, highest = most_order - 4, most = QDOT_BORDERED_MOST };

/* The orders that are one vector (series/taylor-code.h); loops where there are two, with the first
 * orders; instructions that are kept decoded. */
enum { narrow = 18 };
static const double loops = 3.7, decoded = 3000;

/* Squared sine below which the other series finds its way. */
static const double least_sine = 0.1;

struct qdot_bordered {
    const qdot_constraints *c;
    size_t n, m;
    qdot_expansion x;
    const double **outputs; /* f [n], M, A, gamma [m] */
    double *const *a;       /* [n + m] q'', -lambda */
    double *inverse;        /* [n + m x n + m] the program's */
    size_t couplings;       /* moving entries, both triangles */
    bool diagonal;          /* M */
    bool looked;            /* at the first state */
    qdot_ode_series own;
    qdot_guarded guarded; /* that, where it fits */
};

/* --- an expansion -------------------------------------------------------------------- */

static bool
invert(const qdot_bordered *e)
{
    const qdot_constraints *c = e->c;
    const size_t n = e->n, all = n + e->m;
    const double *const *entry = e->outputs + n;
    double K[most][most] = {{0}};

    for (size_t k = 0; k < c->n_masses; k++, entry++)
        K[c->masses[k].row][c->masses[k].column] =
            K[c->masses[k].column][c->masses[k].row] = **entry;
    for (size_t k = 0; k < c->n_slopes; k++, entry++)
        K[n + c->slopes[k].row][c->slopes[k].column] =
            K[c->slopes[k].column][n + c->slopes[k].row] = **entry;
    if (!(e->diagonal ? qdot_bordered_invert_diagonal
                      : qdot_bordered_invert)(n, e->m, K, least_sine))
        return false;
    for (size_t i = 0; i < all; i++)
        memcpy(e->inverse + i * all, K[i], all * sizeof **K);
    return true;
}

/* Order 0 of the unknowns; whether it is finite. */
static bool
solve(const qdot_bordered *e)
{
    const size_t n = e->n, all = n + e->m;
    const double *const *f = e->outputs, *inverse = e->inverse;
    const double *const *gamma = f + n + e->c->n_masses + e->c->n_slopes;
    double right[most], nothing = 0; /* a sum of zeros, if all is finite */

    for (size_t j = 0; j < all; j++)
        right[j] = j < n ? *f[j] : *gamma[j - n];
    for (size_t i = 0; i < all; i++, inverse += all) {
        double sum = 0;

        for (size_t j = 0; j < all; j++)
            sum += inverse[j] * right[j];
        *e->a[i] = sum;
        nothing += 0 * sum;
    }
    return nothing == 0;
}

/* At a first state that is not for it no code is written, kept or not. */
static qdot_status
begin(double t, const double *y, double unit, void *user)
{
    qdot_bordered *e = user;
    bool fits;

    qdot_expansion_begin(&e->x, t, y, unit);
    qdot_taylor_order(e->x.taylor, 0);
    fits = invert(e) && solve(e);
    if (!fits && !e->looked)
        qdot_taylor_refuse_code(e->x.taylor, "constraints depend on each other at the start");
    e->looked = true;
    if (!fits)
        return qdot_fail(QDOT_EDOMAIN, "constraints depend on each other");
    qdot_taylor_begin_links(e->x.taylor, unit);
    return QDOT_OK;
}

static qdot_status
extend(int p, void *user)
{
    const qdot_bordered *e = user;

    qdot_taylor_extend(e->x.taylor, 1, p - 1);
    return QDOT_OK;
}

/* Orders of forces end two below that of q. */
static double
near(int p, double s, void *user)
{
    return qdot_taylor_near(((const qdot_bordered *)user)->x.taylor, p - 2, s);
}

/* --- building ------------------------------------------------------------------------ */

/* Entries of the whole matrix by rows. */
static size_t
list_entries(const qdot_bordered *e, qdot_taylor_entry *to)
{
    const qdot_constraints *c = e->c;
    const size_t n = e->n, first = n + c->n_masses;
    size_t count = 0;

    for (size_t i = 0; i < n + e->m; i++) {
        for (size_t k = 0; k < c->n_masses; k++) {
            const size_t row = c->masses[k].row, column = c->masses[k].column;

            if (row == i || column == i)
                to[count++] = (qdot_taylor_entry){i, row == i ? column : row, n + k};
        }
        for (size_t k = 0; k < c->n_slopes; k++) {
            const size_t row = n + c->slopes[k].row, column = c->slopes[k].column;

            if (row == i || column == i)
                to[count++] = (qdot_taylor_entry){i, row == i ? column : row, first + k};
        }
    }
    return count;
}

static qdot_status
solve_for_all(qdot_bordered *e)
{
    const qdot_constraints *c = e->c;
    const size_t n = e->n, m = e->m, gamma = n + c->n_masses + c->n_slopes;
    qdot_taylor_entry *entries = qdot_calloc(2 * (c->n_masses + c->n_slopes) + 1,
                                             sizeof *entries);
    size_t f[most], count;
    double *matrices = NULL;
    qdot_status status;

    if (!entries)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n + m; i++)
        f[i] = i < n ? i : gamma + (i - n);
    count = list_entries(e, entries);
    for (size_t k = 0; k < count; k++)
        e->couplings += !qdot_taylor_is_constant(e->x.taylor, entries[k].output);
    status = qdot_taylor_solve_entries(
        e->x.taylor, &(qdot_taylor_equations){n + m, f, count, entries, 0}, &e->a, &matrices);
    qdot_free(entries);
    if (status == QDOT_OK)
        e->inverse = matrices + (n + m) * (n + m);
    return status;
}

/* Nanoseconds, as measured on a machine of 2023; only their ratios matter. Without the
 * projection: with it loose tolerances had orders that take a second vector, and paid for it
 * when the code is written (a car axis: 8 % fewer steps, a quarter more time). */
static void
estimate_written(qdot_bordered *e, const qdot_plan *p)
{
    const double all = (double)(e->n + e->m), sums = qdot_bordered_convolutions(e);
    const double length = (double)qdot_taylor_length(e->x.taylor);
    const double instructions = 7 * length + 12 * sums + 1.5 * all * all; /* of an order */
    qdot_ode_code *code = &e->own.code;
    double *cost = code->cost;

    code->worth = 400;
    code->digits = QDOT_ODE_DIGITS;
    cost[0] = 160 + 20 * (double)qdot_tape_calls(p->tape) + 3 * length + 20 * all +
              0.5 * all * all * all;
    cost[1] = 3 + 0.4 * length + 0.6 * sums + all * all;
    cost[2] = 0.03 * sums;
    /* More vectors are loops of their own, read anew in every step where all of them are more
     * than a processor keeps decoded. */
    code->narrow = narrow;
    code->of_vector = 16;
    code->wider = loops * instructions > decoded ? 0.3 * instructions : 0;
}

static qdot_status
make(qdot_bordered *e, const qdot_plan *p, bool shaken, const qdot_ode_series *other)
{
    const qdot_tape *tape = p->bordered ? p->bordered : p->tape;
    const size_t n = e->n, outputs = qdot_tape_outputs(tape);
    qdot_taylor *taylor;

    QDOT_TRY(qdot_taylor_new_moving(tape, shaken, most_order, 2 * n + 1, n + e->m,
                                    &taylor));
    e->x = qdot_expansion_of(taylor, n);
    e->diagonal = true;
    for (size_t k = 0; k < e->c->n_masses; k++)
        e->diagonal = e->diagonal && e->c->masses[k].row == e->c->masses[k].column;
    e->outputs = qdot_calloc(outputs + 1, sizeof *e->outputs);
    if (!e->outputs)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < outputs; i++)
        e->outputs[i] = qdot_taylor_output(e->x.taylor, i);
    QDOT_TRY(solve_for_all(e));
    for (size_t i = 0; i < n; i++)
        QDOT_TRY(qdot_taylor_link(e->x.taylor, n + i, i, e->a[i]));
    e->own = (qdot_ode_series){.most = highest,
                               .x = e->x.q,
                               .stride = e->x.stride,
                               .checked = n,
                               .code = qdot_expansion_code(e->x.taylor),
                               .begin = begin,
                               .extend = extend,
                               .near = qdot_taylor_has_exponentials(e->x.taylor) ? near : NULL,
                               .user = e};
    estimate_written(e, p);
    qdot_guarded_init(&e->guarded, &e->own, other, true);
    memcpy(e->guarded.series.cost, other->cost, sizeof other->cost);
    return QDOT_OK;
}

qdot_status
qdot_bordered_new(const qdot_plan *plan, bool shaken, const qdot_ode_series *other,
                  qdot_bordered **bordered)
{
    qdot_bordered *e = qdot_calloc(1, sizeof *e);
    qdot_status status;

    *bordered = NULL;
    if (!e)
        return QDOT_ENOMEM;
    e->c = plan->constraints;
    e->n = plan->n;
    e->m = e->c->m;
    status = make(e, plan, shaken, other);
    if (status != QDOT_OK) {
        qdot_bordered_free(e);
        return status;
    }
    *bordered = e;
    return QDOT_OK;
}

void
qdot_bordered_free(qdot_bordered *e)
{
    if (!e)
        return;
    qdot_taylor_free(e->x.taylor);
    qdot_free(e->outputs);
    qdot_free(e);
}

const qdot_ode_series *
qdot_bordered_series(const qdot_bordered *e)
{
    return &e->guarded.series;
}

double
qdot_bordered_convolutions(const qdot_bordered *e)
{
    return qdot_taylor_convolutions(e->x.taylor) + (double)e->couplings;
}

size_t
qdot_bordered_code(const qdot_bordered *e, const char **why)
{
    return qdot_taylor_code_bytes(e->x.taylor, why);
}

/* --- which is taken ------------------------------------------------------------------ */

/* f, M, A, gamma of a plan; NULL: no memory. */
static qdot_expr *
equations(const qdot_plan *p, size_t *count)
{
    const qdot_constraints *c = p->constraints;
    qdot_expr *out = qdot_calloc(p->n + c->n_masses + c->n_slopes + c->m, sizeof *out);
    size_t n = 0;

    for (size_t i = 0; out && i < p->n; i++)
        out[n++] = qdot_power_quotient(p->pool, p->f[i]);
    for (size_t k = 0; out && k < c->n_masses; k++)
        out[n++] = p->M[c->masses[k].row * p->n + c->masses[k].column];
    for (size_t k = 0; out && k < c->n_slopes; k++)
        out[n++] = c->A[k];
    for (size_t k = 0; out && k < c->m; k++)
        out[n++] = c->gamma[k];
    *count = n;
    return out;
}

qdot_status
qdot_bordered_find(qdot_plan *p, double tol)
{
    qdot_expr *out;
    size_t count;
    qdot_status status;

    if (!(tol >= QDOT_ELIMINATED_TOL) || !p->smooth || !p->method->series || p->indefinite ||
        p->eliminated || p->treatment == QDOT_RUN_BAUMGARTE ||
        p->n + p->constraints->m > QDOT_BORDERED_MOST || !qdot_taylor_may_be_code())
        return QDOT_OK;
    out = equations(p, &count);
    status = out ? qdot_pool_check(p->pool) : QDOT_ENOMEM;
    if (status == QDOT_OK)
        status = qdot_tape_new(p->pool, 2 * p->n + 1, p->inputs, count, out, &p->bordered);
    qdot_free(out);
    return status;
}
