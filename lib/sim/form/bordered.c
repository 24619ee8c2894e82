/* bordered.c -- order 0 by hand, the others by the program; else by the other series. */
#include "sim/form/bordered.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "num/bordered.h"
#include "sim/form/eliminated.h"
#include "sim/model/constrained.h"
#include "sim/model/constraints.h"
#include "sim/model/power-quotient.h"
#include "series/taylor.h"

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
    qdot_taylor *taylor;
    double *q, *v, *t; /* the inputs' rows, `stride` apart */
    size_t stride;
    const double **outputs; /* f [n], M, A, gamma [m] */
    double *const *a;       /* [n + m] q'', -lambda */
    double *inverse;        /* [n + m x n + m] the program's */
    size_t couplings;       /* moving entries, both triangles */
    bool diagonal;          /* M */
    int p;                  /* the order at hand */
    bool looked, fits;      /* at the first state: whether its rows are independent */
    const qdot_ode_series *other, *now; /* `now`: the one begun last; NULL: this one */
    qdot_ode_series series;
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

/* Order 0 at (t, y); whether there is one. */
static bool
begin_own(qdot_bordered *e, double t, const double *y, double unit)
{
    const size_t n = e->n;
    double *q = e->q, *v = e->v;

    for (size_t i = 0; i < n; i++, q += e->stride, v += e->stride) {
        q[0] = y[i];
        q[1] = unit * y[n + i];
        v[0] = y[n + i];
    }
    e->t[0] = t;
    e->t[1] = unit;
    qdot_taylor_draw(e->taylor, t);
    qdot_taylor_order(e->taylor, 0);
    return invert(e) && solve(e);
}

static qdot_status
begin(double t, const double *y, double unit, void *user)
{
    qdot_bordered *e = user;
    const qdot_ode_series *other = e->other;
    const bool code = qdot_taylor_is_code(e->taylor, e->p - 1);
    const bool own = (code || !e->looked) && begin_own(e, t, y, unit);

    e->now = NULL;
    e->series.x = e->q;
    e->series.stride = e->stride;
    e->fits = e->looked ? e->fits : own;
    e->looked = true;
    if (code && own) {
        qdot_taylor_begin_links(e->taylor, unit);
        return QDOT_OK;
    }
    QDOT_TRY(other->begin(t, y, unit, other->user));
    e->now = other;
    e->series.x = other->x;
    e->series.stride = other->stride;
    return QDOT_OK;
}

static qdot_status
extend(int p, void *user)
{
    const qdot_bordered *e = user;

    if (e->now)
        return e->now->extend(p, e->now->user);
    qdot_taylor_extend(e->taylor, 1, p - 1);
    return QDOT_OK;
}

static double
noise(void *user)
{
    const qdot_bordered *e = user;

    return e->now && e->now->noise ? e->now->noise(e->now->user) : 0;
}

static double
ahead(void *user)
{
    const qdot_bordered *e = user;

    return e->now && e->now->ahead ? e->now->ahead(e->now->user) : 0;
}

/* Orders of forces end two below that of q. */
static double
near(int p, double s, void *user)
{
    const qdot_bordered *e = user;

    if (e->now)
        return e->now->near ? e->now->near(p, s, e->now->user) : s;
    return qdot_taylor_near(e->taylor, p - 2, s);
}

static qdot_status
prepare(int p, void *user)
{
    qdot_bordered *e = user;

    e->p = p;
    return e->other->prepare ? e->other->prepare(p, e->other->user) : QDOT_OK;
}

/* Where the first state is not one for it, there is none, kept or not. */
static qdot_status
write_code(int p, void *user)
{
    qdot_bordered *e = user;

    e->p = p;
    if (e->fits || !e->looked)
        return qdot_taylor_prepare(e->taylor, p - 1);
    qdot_taylor_drop_code(e->taylor);
    return QDOT_OK;
}

static bool
take_code(int p, void *user)
{
    const qdot_bordered *e = user;

    return qdot_taylor_take_kept(e->taylor, p - 1);
}

static bool
is_code(int p, void *user)
{
    const qdot_bordered *e = user;

    return qdot_taylor_is_code(e->taylor, p - 1);
}

static void
drop_code(void *user)
{
    const qdot_bordered *e = user;

    qdot_taylor_drop_code(e->taylor);
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
        e->couplings += !qdot_taylor_is_constant(e->taylor, entries[k].output);
    status = qdot_taylor_solve_entries(e->taylor, n + m, f, count, entries, 0, &e->a,
                                       &matrices);
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
    const double length = (double)qdot_taylor_length(e->taylor);
    const double instructions = 7 * length + 12 * sums + 1.5 * all * all; /* of an order */
    double *cost = e->series.written;

    e->series.digits = QDOT_ODE_DIGITS;
    cost[0] = 160 + 20 * (double)qdot_tape_calls(p->tape) + 3 * length + 20 * all +
              0.5 * all * all * all;
    cost[1] = 3 + 0.4 * length + 0.6 * sums + all * all;
    cost[2] = 0.03 * sums;
    /* More vectors are loops of their own, read anew in every step where all of them are more
     * than a processor keeps decoded. */
    e->series.narrow = narrow;
    e->series.of_vector = 16;
    e->series.wider = loops * instructions > decoded ? 0.3 * instructions : 0;
}

static qdot_status
make(qdot_bordered *e, const qdot_plan *p, bool shaken, const qdot_ode_series *other)
{
    const qdot_tape *tape = p->bordered ? p->bordered : p->tape;
    const size_t n = e->n, outputs = qdot_tape_outputs(tape);

    QDOT_TRY(qdot_taylor_new_moving(tape, shaken, most_order, 2 * n + 1, n + e->m,
                                    &e->taylor));
    e->stride = qdot_taylor_stride(e->taylor);
    e->q = qdot_taylor_input(e->taylor, 0);
    e->v = qdot_taylor_input(e->taylor, n);
    e->t = qdot_taylor_input(e->taylor, 2 * n);
    e->diagonal = true;
    for (size_t k = 0; k < e->c->n_masses; k++)
        e->diagonal = e->diagonal && e->c->masses[k].row == e->c->masses[k].column;
    e->outputs = qdot_calloc(outputs + 1, sizeof *e->outputs);
    if (!e->outputs)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < outputs; i++)
        e->outputs[i] = qdot_taylor_output(e->taylor, i);
    QDOT_TRY(solve_for_all(e));
    for (size_t i = 0; i < n; i++)
        QDOT_TRY(qdot_taylor_link(e->taylor, n + i, i, e->a[i]));
    e->series = (qdot_ode_series){.most = other->most < highest ? other->most : highest,
                                  .x = e->q,
                                  .stride = e->stride,
                                  .checked = n,
                                  .cost = {other->cost[0], other->cost[1], other->cost[2]},
                                  .prepare = prepare,
                                  .write = write_code,
                                  .take = take_code,
                                  .there = is_code,
                                  .drop = drop_code,
                                  .worth = 400,
                                  .begin = begin,
                                  .extend = extend,
                                  .noise = other->noise ? noise : NULL,
                                  .ahead = other->ahead ? ahead : NULL,
                                  .near = other->near || qdot_taylor_has_exponentials(e->taylor)
                                              ? near : NULL,
                                  .user = e};
    estimate_written(e, p);
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
    e->other = other;
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
    qdot_taylor_free(e->taylor);
    qdot_free(e->outputs);
    qdot_free(e);
}

const qdot_ode_series *
qdot_bordered_series(const qdot_bordered *e)
{
    return &e->series;
}

double
qdot_bordered_convolutions(const qdot_bordered *e)
{
    return qdot_taylor_convolutions(e->taylor) + (double)e->couplings;
}

size_t
qdot_bordered_code(const qdot_bordered *e, const char **why)
{
    return qdot_taylor_code_bytes(e->taylor, why);
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
