/* constrained-series.c -- order by order: residuals of the constraints ahead, tape, solve, correct. */
#include "sim/form/constrained-series.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "num/series.h"
#include "sim/form/expansion.h"
#include "sim/model/constrained.h"
#include "sim/model/constraints.h"

enum { most_order = 44, lanes = 8 };

/* Orders found by a residual-corrected solve: an error of the inverse is the same at every
 * order of a step, and so a drift of the energy instead of noise. With 0 that of the
 * Cartesian pendulum grows as t; from 3 on as the square root of t. Series shorter than the
 * other are for tolerances at which no rounding counts. */
enum { refined = 3, least_refined = 18 };

/* Constraints are nearly dependent where less than this is left of their best. */
static const double nearly = 0.3;

/* Of what is left of their independence now, where a place ahead at which nothing is is believed:
 * what Newton's method leaves there, and the highest of the orders it looks at. */
static const double settled = 1e-6, shown = 0.5;

/* A moving entry of M or A: of `to`, a place in the equations, +-sum_j entry_j of_{k - j}
 * is taken off, number `product` of those sums. */
typedef struct {
    size_t to, product;
    double sign;
} coupling;

/* The constraints of a kind. */
typedef struct {
    qdot_taylor *taylor;
    double *newest, *other, *t; /* rows of its inputs: by its kind, see constraints.h */
    double *velocity;           /* of an acceleration constraint */
    size_t stride;
} kind_series;

struct qdot_constrained_series {
    const qdot_plan *plan;
    const qdot_constraints *c;
    const qdot_series_kernels *kernels;
    qdot_expansion x; /* f, M */
    kind_series kinds[3];
    qdot_saddle saddle;
    double best;  /* its best quality so far */
    double *weak; /* [m + n] scratch */
    qdot_ode_series series;
    double unit;
    double *a, *lambda;  /* [n x stride], [m x stride] series of q'', -lambda */
    double *newest;      /* [n] */
    const double **f;    /* [n] series */
    const double **M;    /* [n_masses] */
    const double **A;    /* [n_slopes] */
    const double **rows; /* [m] series of the constraints */
    bool moves;          /* an output of `motion` does */
    bool damped;
    coupling *couplings;
    size_t n_couplings;
    size_t products, members;  /* sums of products; filled up to full vectors */
    const double **entry, **of; /* [products] series */
    double *entries, *others;   /* [orders x members] their coefficients, by order */
    double *sums;               /* [members] */
    double up[most_order + 2];  /* k/unit */
};

/* --- one order ---------------------------------------------------------------------- */

/* Coefficient `order` of coordinate or velocity rows into those of another tape. */
static void
copy_order(const double *from, size_t stride, double *to, size_t to_stride, size_t n,
           int order)
{
    for (size_t i = 0; i < n; i++)
        to[i * to_stride + (size_t)order] = from[i * stride + (size_t)order];
}

static void
clear_order(double *to, size_t stride, size_t n, int order)
{
    for (size_t i = 0; i < n; i++)
        to[i * stride + (size_t)order] = 0;
}

/* The constraints with their newest coefficient 0, as far ahead as their kind is. */
static void
look_ahead(qdot_constrained_series *e, int k)
{
    const size_t n = e->plan->n;
    kind_series *h = e->kinds + QDOT_HOLONOMIC, *v = e->kinds + QDOT_VELOCITY;
    kind_series *a = e->kinds + QDOT_ACCELERATION;

    if (h->taylor) {
        clear_order(h->newest, h->stride, n, k + 2);
        qdot_taylor_order(h->taylor, k + 2);
    }
    if (v->taylor) {
        copy_order(e->x.q, e->x.stride, v->other, v->stride, n, k + 1);
        clear_order(v->newest, v->stride, n, k + 1);
        qdot_taylor_order(v->taylor, k + 1);
    }
    if (a->taylor) {
        copy_order(e->x.q, e->x.stride, a->other, a->stride, n, k);
        copy_order(e->x.v, e->x.stride, a->velocity, a->stride, n, k);
        clear_order(a->newest, a->stride, n, k);
        qdot_taylor_order(a->taylor, k);
    }
}

/* What row r of the constraints asks of A_0 a_k. */
static double
wanted(const qdot_constrained_series *e, size_t r, int k)
{
    const double *f = e->rows[r], one = e->up[k + 1], two = one * e->up[k + 2];
    const double a = e->damped ? QDOT_CONSTRAINED_RATE : 0;

    switch (e->c->rows[r].kind) {
    case QDOT_HOLONOMIC:
        return e->damped ? -two * f[k + 2] - a * (2 * one * f[k + 1] + a * f[k])
                         : -two * f[k + 2];
    case QDOT_VELOCITY:
        return e->damped ? -one * f[k + 1] - a * f[k] : -one * f[k + 1];
    case QDOT_ACCELERATION: break;
    }
    return -f[k];
}

/* Coefficient k of accelerations and multipliers is known: what follows from it. Divided
 * by k: the rounding of a factor 1/k would be the same at every step, and a drift. */
static void
bring_up_to_date(qdot_constrained_series *e, int k)
{
    const size_t n = e->plan->n;
    const double unit = e->unit, one = k + 1, two = k + 2;
    kind_series *h = e->kinds + QDOT_HOLONOMIC, *v = e->kinds + QDOT_VELOCITY;
    kind_series *a = e->kinds + QDOT_ACCELERATION;

    for (size_t i = 0; i < n; i++) {
        e->newest[i] = unit * e->a[i * e->x.stride + (size_t)k] / one;
        e->x.v[i * e->x.stride + (size_t)k + 1] = e->newest[i];
    }
    if (v->taylor)
        qdot_taylor_correct(v->taylor, k + 1, e->newest);
    for (size_t i = 0; i < n; i++) {
        e->newest[i] = unit * e->newest[i] / two;
        e->x.q[i * e->x.stride + (size_t)k + 2] = e->newest[i];
    }
    if (h->taylor)
        qdot_taylor_correct(h->taylor, k + 2, e->newest);
    if (!a->taylor)
        return;
    if (k == 0) { /* order 0 is not affine */
        copy_order(e->a, e->x.stride, a->newest, a->stride, n, 0);
        qdot_taylor_order(a->taylor, 0);
        return;
    }
    for (size_t i = 0; i < n; i++)
        e->newest[i] = e->a[i * e->x.stride + (size_t)k];
    qdot_taylor_correct(a->taylor, k, e->newest);
}

static qdot_status
factor(qdot_constrained_series *e)
{
    const qdot_constraints *c = e->c;
    const size_t n = e->plan->n;
    qdot_saddle *s = &e->saddle;

    for (size_t k = 0; k < c->n_masses; k++) {
        size_t i = c->masses[k].row, j = c->masses[k].column;

        s->M[i * n + j] = s->M[j * n + i] = e->M[k][0];
    }
    for (size_t k = 0; k < c->n_slopes; k++)
        s->A[c->slopes[k].row * n + c->slopes[k].column] = c->sign[k] * e->A[k][0];
    return qdot_constrained_factor(e->plan, s);
}

/* Off the right-hand side x what lower orders have given already. */
static void
take_off(qdot_constrained_series *e, int k, double *x)
{
    const size_t members = e->members;
    double *entries = e->entries + (size_t)k * members;

    for (size_t j = 0; j < e->products; j++)
        entries[j] = e->entry[j][k];
    if (k == 0)
        return;
    e->kernels->dots(members, (size_t)k, e->entries + members,
                     e->others + (size_t)(k - 1) * members, e->sums);
    for (size_t j = 0; j < e->n_couplings; j++)
        x[e->couplings[j].to] -= e->couplings[j].sign * e->sums[e->couplings[j].product];
}

/* Order k, orders below being there. */
static qdot_status
order(qdot_constrained_series *e, int k, int precise)
{
    const size_t n = e->plan->n, m = e->c->m;
    double *x = e->saddle.x, *others = e->others + (size_t)k * e->members;

    look_ahead(e, k);
    if (e->moves || k == 0)
        qdot_taylor_order(e->x.taylor, k);
    if (k == 0)
        QDOT_TRY(factor(e));
    for (size_t i = 0; i < n; i++)
        x[i] = e->f[i][k];
    for (size_t r = 0; r < m; r++)
        x[n + r] = wanted(e, r, k);
    take_off(e, k, x);
    if (k <= precise)
        qdot_saddle_solve_refined(&e->saddle);
    else
        qdot_saddle_apply(&e->saddle);
    for (size_t i = 0; i < n; i++)
        e->a[i * e->x.stride + (size_t)k] = x[i];
    for (size_t r = 0; r < m; r++)
        e->lambda[r * e->x.stride + (size_t)k] = x[n + r];
    for (size_t j = 0; j < e->products; j++)
        others[j] = e->of[j][k];
    bring_up_to_date(e, k);
    return QDOT_OK;
}

/* Order 0 of all inputs, and 1 of the coordinates, at (t, y). */
static void
load(qdot_constrained_series *e, double t, const double *y)
{
    qdot_expansion_begin(&e->x, t, y, e->unit);
    for (int kind = 0; kind < 3; kind++) {
        kind_series *s = e->kinds + kind;

        if (!s->taylor)
            continue;
        s->t[0] = t;
        s->t[1] = e->unit;
        qdot_taylor_draw(s->taylor, t);
    }
}

/* Before the first factorisation. */
static qdot_status
look_beside(qdot_constrained_series *e, double t, const double *y)
{
    const size_t n = e->plan->n;
    double *in = qdot_malloc((2 * n + 1) * sizeof *in);
    qdot_status status = QDOT_ENOMEM;

    if (in) {
        memcpy(in, y, 2 * n * sizeof *in);
        in[2 * n] = t;
        status = qdot_constrained_look_beside(e->plan, &e->saddle, NULL, in);
    }
    qdot_free(in);
    return status;
}

static qdot_status
begin(double t, const double *y, double unit, void *user)
{
    qdot_constrained_series *e = user;
    const size_t n = e->plan->n;
    kind_series *h = e->kinds + QDOT_HOLONOMIC, *v = e->kinds + QDOT_VELOCITY;

    if (unit != e->unit) {
        e->unit = unit;
        for (int k = 1; k < most_order + 2; k++)
            e->up[k] = k / unit;
    }
    load(e, t, y);
    if (e->c->m > 1 && e->saddle.rank == QDOT_SADDLE_UNKNOWN)
        QDOT_TRY(look_beside(e, t, y));
    for (int k = 0; h->taylor && k < 2; k++) {
        copy_order(e->x.q, e->x.stride, h->newest, h->stride, n, k);
        qdot_taylor_order(h->taylor, k);
    }
    if (v->taylor) {
        copy_order(e->x.q, e->x.stride, v->other, v->stride, n, 0);
        copy_order(e->x.v, e->x.stride, v->newest, v->stride, n, 0);
        qdot_taylor_order(v->taylor, 0);
    }
    QDOT_TRY(order(e, 0, refined));
    for (size_t i = 0; i < n; i++)
        if (!isfinite(e->a[i * e->x.stride]))
            return qdot_fail(QDOT_EDOMAIN, "the acceleration of %s is undefined",
                             e->plan->names[i]);
    return QDOT_OK;
}

static qdot_status
extend(int p, void *user)
{
    qdot_constrained_series *e = user;

    qdot_saddle_prepare(&e->saddle);
    for (int k = 1; k < p; k++)
        QDOT_TRY(order(e, k, p < least_refined ? 0 : refined));
    return QDOT_OK;
}

/* Near a place where the constraints are dependent a direction of the accelerations is
 * found by dividing rounding by what is left of their independence, twice over: the slope
 * of the constraints is as uncertain. Each order adds one more such division, which the
 * length of the step balances. */
static double
noise(void *user)
{
    qdot_constrained_series *e = user;
    double left;

    if (e->saddle.direct)
        return 0;
    e->best = fmax(e->best, e->saddle.quality);
    left = e->saddle.quality / e->best;
    return left < nearly ? fmin(1e-9, 100 * DBL_EPSILON / (left * left)) : 0;
}

/* The weakest combination of rows, along its own direction, is a scalar series that passes
 * 0 where they are dependent; its first root, from the lowest orders, if these show one. */
static double
ahead(void *user)
{
    qdot_constrained_series *e = user;
    const qdot_constraints *c = e->c;
    double sigma[4] = {0}, s, left, *row = e->weak, *column = e->weak + c->m;

    if (e->saddle.rank == 0)
        return 0;
    qdot_saddle_weakest(&e->saddle, row, column);
    for (size_t k = 0; k < c->n_slopes; k++)
        for (int j = 0; j < 4; j++)
            sigma[j] += c->sign[k] * row[c->slopes[k].row]
                        * column[c->slopes[k].column] * e->A[k][j];
    s = -sigma[0] / sigma[1];
    for (int k = 0; k < 20; k++) {
        double f = sigma[0] + s * (sigma[1] + s * (sigma[2] + s * sigma[3]));

        s -= f / (sigma[1] + s * (2 * sigma[2] + s * 3 * sigma[3]));
    }
    left = sigma[0] + s * (sigma[1] + s * (sigma[2] + s * sigma[3]));
    if (!(s > 0 && fabs(left) < settled * fabs(sigma[0])
          && fabs(s * s * s * sigma[3]) < shown * fabs(sigma[0])))
        return 0;
    return s * fabs(e->unit);
}

/* --- building ----------------------------------------------------------------------- */

/* f is 0 once it is corrected: only damping reads it again. */
static qdot_status
ask_for_corrections(qdot_constrained_series *e, qdot_constraint_kind kind)
{
    const size_t slopes = e->c->n_slopes, rows = e->c->count[kind];
    bool *kept = qdot_calloc(rows + slopes + 1, sizeof *kept);
    qdot_status status;

    if (!kept)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < rows + slopes; i++)
        kept[i] = e->damped || i >= rows;
    status = qdot_taylor_affine(e->kinds[kind].taylor, e->plan->n, kept);
    qdot_free(kept);
    return status;
}

static qdot_status
make_kind(qdot_constrained_series *e, qdot_constraint_kind kind, bool shaken)
{
    kind_series *s = e->kinds + kind;
    const size_t n = e->plan->n, first = kind == QDOT_ACCELERATION ? n : 0;

    if (!e->c->series[kind])
        return QDOT_OK;
    QDOT_TRY(qdot_taylor_new_shaken(e->c->series[kind], shaken, most_order, &s->taylor));
    QDOT_TRY(ask_for_corrections(e, kind));
    s->stride = qdot_taylor_stride(s->taylor);
    s->newest = qdot_taylor_input(s->taylor, 0);
    s->other = qdot_taylor_input(s->taylor, n);
    s->velocity = qdot_taylor_input(s->taylor, first + n);
    s->t = qdot_taylor_input(s->taylor, first + 2 * n);
    return QDOT_OK;
}

static void
couple(qdot_constrained_series *e, size_t to, double sign, const double *entry,
       const double *of)
{
    size_t j = 0;

    while (j < e->products && (e->entry[j] != entry || e->of[j] != of))
        j++;
    e->entry[j] = entry;
    e->of[j] = of;
    if (j == e->products)
        e->products++;
    e->couplings[e->n_couplings++] = (coupling){to, j, sign};
}

/* Where outputs are found, and which entries move. */
static qdot_status
find_outputs(qdot_constrained_series *e)
{
    const qdot_constraints *c = e->c;
    const size_t n = e->plan->n, most = 2 * c->n_masses + c->n_slopes + 1;
    size_t at[3];

    e->couplings = qdot_calloc(most, sizeof *e->couplings);
    e->entry = qdot_calloc(most, sizeof *e->entry);
    e->of = qdot_calloc(most, sizeof *e->of);
    if (!e->couplings || !e->entry || !e->of)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++) {
        e->f[i] = qdot_taylor_output(e->x.taylor, i);
        e->moves |= !qdot_taylor_is_constant(e->x.taylor, i);
    }
    for (size_t k = 0; k < c->n_masses; k++) {
        size_t i = c->masses[k].row, j = c->masses[k].column;

        e->M[k] = qdot_taylor_output(e->x.taylor, n + k);
        if (qdot_taylor_is_constant(e->x.taylor, n + k))
            continue;
        e->moves = true;
        couple(e, i, 1, e->M[k], e->a + j * e->x.stride);
        if (i != j)
            couple(e, j, 1, e->M[k], e->a + i * e->x.stride);
    }
    for (int kind = 0; kind < 3; kind++)
        at[kind] = c->count[kind];
    for (size_t k = 0; k < c->n_slopes; k++) {
        size_t row = c->slopes[k].row;
        qdot_constraint_kind kind = c->rows[row].kind;
        qdot_taylor *taylor = e->kinds[kind].taylor;
        size_t output = at[kind]++;

        e->A[k] = qdot_taylor_output(taylor, output);
        if (!qdot_taylor_is_constant(taylor, output))
            couple(e, c->slopes[k].column, c->sign[k], e->A[k],
                   e->lambda + row * e->x.stride);
    }
    for (size_t r = 0; r < c->m; r++)
        e->rows[r] =
            qdot_taylor_output(e->kinds[c->rows[r].kind].taylor, c->rows[r].of_kind);
    e->members = (e->products + lanes - 1) / lanes * lanes;
    e->entries = qdot_calloc((most_order + 1) * e->members + 1, sizeof *e->entries);
    e->others = qdot_calloc((most_order + 1) * e->members + 1, sizeof *e->others);
    e->sums = qdot_calloc(e->members + 1, sizeof *e->sums);
    return e->entries && e->others && e->sums ? QDOT_OK : QDOT_ENOMEM;
}

/* Orders of forces end two below that of q. */
static double
near(int p, double s, void *user)
{
    const qdot_constrained_series *e = user;

    if (e->moves)
        s = qdot_taylor_near(e->x.taylor, p - 2, s);
    for (int kind = 0; kind < 3; kind++)
        if (e->kinds[kind].taylor)
            s = qdot_taylor_near(e->kinds[kind].taylor, p - 2, s);
    return s;
}

static bool
has_exponentials(const qdot_constrained_series *e)
{
    bool some = qdot_taylor_has_exponentials(e->x.taylor);

    for (int kind = 0; kind < 3; kind++)
        some = some || (e->kinds[kind].taylor
                        && qdot_taylor_has_exponentials(e->kinds[kind].taylor));
    return some;
}

static qdot_status
make(qdot_constrained_series *e, bool shaken)
{
    const qdot_plan *p = e->plan;
    const qdot_constraints *c = e->c;
    qdot_taylor *motion;

    e->damped = p->treatment == QDOT_RUN_BAUMGARTE;
    QDOT_TRY(qdot_taylor_new_shaken(c->motion, shaken, most_order, &motion));
    e->x = qdot_expansion_of(motion, p->n);
    for (int kind = 0; kind < 3; kind++)
        QDOT_TRY(make_kind(e, (qdot_constraint_kind)kind, shaken));
    e->a = qdot_calloc(p->n * e->x.stride, sizeof *e->a);
    e->lambda = qdot_calloc(c->m * e->x.stride, sizeof *e->lambda);
    e->newest = qdot_calloc(p->n, sizeof *e->newest);
    e->weak = qdot_calloc(c->m + p->n, sizeof *e->weak);
    e->f = qdot_calloc(p->n, sizeof *e->f);
    e->M = qdot_calloc(c->n_masses + 1, sizeof *e->M);
    e->A = qdot_calloc(c->n_slopes + 1, sizeof *e->A);
    e->rows = qdot_calloc(c->m, sizeof *e->rows);
    if (!e->a || !e->lambda || !e->newest || !e->weak || !e->f || !e->M || !e->A ||
        !e->rows)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_saddle_init(&e->saddle, p->n, c->m, p->indefinite));
    QDOT_TRY(qdot_saddle_pattern(&e->saddle, c->n_masses, c->masses, c->n_slopes,
                                 c->slopes));
    QDOT_TRY(find_outputs(e));
    e->series = (qdot_ode_series){.most = most_order - 4,
                                  .x = e->x.q,
                                  .stride = e->x.stride,
                                  .checked = p->n,
                                  .cost = p->expansions,
                                  .begin = begin,
                                  .extend = extend,
                                  .noise = noise,
                                  .ahead = ahead,
                                  .near = has_exponentials(e) ? near : NULL,
                                  .user = e};
    return QDOT_OK;
}

qdot_status
qdot_constrained_series_new(const qdot_plan *plan, bool shaken,
                            qdot_constrained_series **tied)
{
    qdot_constrained_series *e = qdot_calloc(1, sizeof *e);
    qdot_status status;

    *tied = NULL;
    if (!e)
        return QDOT_ENOMEM;
    e->plan = plan;
    e->c = plan->constraints;
    e->kernels = qdot_series_kernels_get();
    status = make(e, shaken);
    if (status != QDOT_OK) {
        qdot_constrained_series_free(e);
        return status;
    }
    *tied = e;
    return QDOT_OK;
}

void
qdot_constrained_series_free(qdot_constrained_series *e)
{
    if (!e)
        return;
    qdot_taylor_free(e->x.taylor);
    for (int kind = 0; kind < 3; kind++)
        qdot_taylor_free(e->kinds[kind].taylor);
    qdot_saddle_clear(&e->saddle);
    qdot_free(e->a);
    qdot_free(e->lambda);
    qdot_free(e->newest);
    qdot_free(e->weak);
    qdot_free(e->f);
    qdot_free(e->M);
    qdot_free(e->A);
    qdot_free(e->rows);
    qdot_free(e->couplings);
    qdot_free(e->entry);
    qdot_free(e->of);
    qdot_free(e->entries);
    qdot_free(e->others);
    qdot_free(e->sums);
    qdot_free(e);
}

const qdot_ode_series *
qdot_constrained_series_get(const qdot_constrained_series *e)
{
    return &e->series;
}

double
qdot_constrained_series_convolutions(const qdot_constrained_series *e)
{
    double sum = qdot_taylor_convolutions(e->x.taylor) + (double)e->products;

    for (int kind = 0; kind < 3; kind++)
        if (e->kinds[kind].taylor)
            sum += qdot_taylor_convolutions(e->kinds[kind].taylor);
    return sum;
}

qdot_work
qdot_constrained_series_work(const qdot_constrained_series *e)
{
    const qdot_saddle *s = &e->saddle;
    const double all = (double)(e->plan->n + e->c->m);
    qdot_work w = {.coordinates = (double)e->plan->n,
                   .length = (double)qdot_taylor_length(e->x.taylor),
                   .convolutions = qdot_constrained_series_convolutions(e),
                   .calls = (double)qdot_tape_calls(e->plan->tape),
                   .unknowns = all,
                   .squares = all * all,
                   .filled = s->patterned ? (double)s->sparse.filled : all * all,
                   .inverted = s->inverse != NULL};

    for (int kind = 0; kind < 3; kind++) /* evaluated, and corrected */
        if (e->kinds[kind].taylor)
            w.length += 2 * (double)qdot_taylor_length(e->kinds[kind].taylor);
    return w;
}

size_t
qdot_constrained_series_factored(const qdot_constrained_series *e)
{
    return e->saddle.factored;
}
