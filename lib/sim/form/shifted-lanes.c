/* shifted-lanes.c -- order by order as residual-series.c, for all lanes. */
#include "sim/form/shifted-lanes.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "ode/taylor.h"
#include "sim/form/blocks.h"
#include "series/lanes-code.h"
#include "tape/shake.h"
#include "series/taylor.h"

enum { L = QDOT_LANES, most_order = 44 };

/* Numbers of the code: squares of units of time, inverses of them, these times the order; then
 * x'' [functions], R [n] and the inverses of the blocks. A larger block than this has none. */
enum { UNIT_SQUARE, PER_UNIT, M_PER_UNIT, NUMBERS, most_solved = 16 };

typedef struct {
    double *A, *inverse; /* [n x n groups] of M_0: its factor; inverse */
    double *x, *y;       /* [n groups] */
    size_t number;       /* of the code's, the first of its inverse */
} solver;

/* For one kind of processor (shifted-lanes.def). */
typedef struct {
    void (*accelerate)(qdot_shifted_lanes *s, int k);
    void (*gather)(qdot_shifted_lanes *s, int k);
    void (*integrate)(qdot_shifted_lanes *s, int m);
} orders;

struct qdot_shifted_lanes {
    const orders *orders;
    const qdot_plan *plan;
    const qdot_residual *residual;
    const qdot_batch_kernels *kernels;
    qdot_lanes *places;
    qdot_tape *masses; /* shaken; NULL: the residual's */
    double *weight;    /* [n_weights] */
    double unit[L];
    double *q, *v, *t;       /* rows of the inputs of `places` */
    size_t stride;           /* groups */
    const double **d;        /* [functions] series of the differences */
    const double **slope;    /* [n_slopes] series */
    const double **Q;        /* [n] series of forces; NULL: zero */
    solver *solvers;         /* [blocks] */
    double *x, *sum;         /* [functions groups] of the order at hand */
    double *F;               /* [functions x stride groups] by order */
    double *R;               /* [n groups] */
    double *in, *out, *work; /* of `masses`, groups */
    int to;                  /* order of q that */
    qdot_lanes_code *code;   /* goes to; NULL: kernels run */
    qdot_lanes_pair *pairs;  /* [n_slopes] while it is written */
    qdot_lanes_row *inputs;  /* [n] likewise */
    qdot_lanes_row *differences; /* [functions] */
};

/* --- one order ---------------------------------------------------------------------- */

#define BATCH_BODY "sim/form/shifted-lanes.def"
#include "num/batch-kinds.def"

static const orders *const kinds[] = {
    &portable_orders,
#ifdef QDOT_X86_KINDS
    &avx2_orders,
    &avx512_orders,
#endif
};

/* unit^2 q'' of order k in place of -R. */
static void
solve(qdot_shifted_lanes *s, int k)
{
    for (size_t b = 0; b < s->plan->structure.blocks; b++) {
        const qdot_plan_block *block = s->plan->blocks + b;
        const solver *at = s->solvers + b;
        size_t n = block->n;

        for (size_t i = 0; i < n; i++)
            memcpy(at->x + i * L, s->R + block->index[i] * L, L * sizeof *at->x);
        if (k > 0) {
            s->kernels->multiply(n, at->inverse, at->x, at->y);
        } else {
            memcpy(at->y, at->x, n * L * sizeof *at->y);
            s->kernels->solve(n, n, at->A, at->y);
        }
        for (size_t i = 0; i < n; i++)
            memcpy(s->R + block->index[i] * L, at->y + i * L, L * sizeof *at->y);
    }
}

/* Coefficients m >= 2 of q and m - 1 of v. */
static void
order(qdot_shifted_lanes *s, int m)
{
    const size_t n = s->plan->n;

    for (size_t i = 0; i < n; i++)
        memset(s->q + (i * s->stride + (size_t)m) * L, 0, L * sizeof *s->q);
    qdot_lanes_order(s->places, m);
    s->orders->accelerate(s, m - 2);
    s->orders->gather(s, m - 2);
    solve(s, m - 2);
    s->orders->integrate(s, m);
    qdot_lanes_correct(s->places, m, n, s->R);
    s->orders->accelerate(s, m - 2);
}

/* M_0 of every block, factored. */
static void
factor(qdot_shifted_lanes *s, const double *t, const double *y)
{
    const qdot_plan *p = s->plan;
    const double *out = s->out;

    memcpy(s->in, y, 2 * p->n * L * sizeof *y);
    memcpy(s->in + 2 * p->n * L, t, L * sizeof *t);
    qdot_lanes_eval_near(s->masses ? s->masses : s->residual->masses, s->in, s->out, s->work);
    for (size_t b = 0; b < p->structure.blocks; b++) {
        const qdot_plan_block *block = p->blocks + b;
        size_t n = block->n;

        if (block->constant)
            continue;
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j <= i; j++, out += L)
                memcpy(s->solvers[b].A + (i * n + j) * L, out, L * sizeof *out);
        s->kernels->factor(n, n, s->solvers[b].A);
    }
}

static void
begin(const double *t, const double *y, const double *unit, void *user)
{
    qdot_shifted_lanes *s = user;
    size_t n = s->plan->n;

    memcpy(s->unit, unit, sizeof s->unit);
    for (size_t i = 0; i < n; i++)
        for (size_t l = 0; l < L; l++) {
            s->q[i * s->stride * L + l] = y[i * L + l];
            s->v[i * s->stride * L + l] = y[(n + i) * L + l];
            s->q[(i * s->stride + 1) * L + l] = unit[l] * y[(n + i) * L + l];
        }
    memcpy(s->t, t, L * sizeof *t);
    memcpy(s->t + L, unit, L * sizeof *unit);
    qdot_lanes_draw(s->places, t);
    factor(s, t, y);
    qdot_lanes_order(s->places, 0);
    qdot_lanes_order(s->places, 1);
    order(s, 2);
}

/* What the code begins with: F of order 0 and the inverses of M_0. */
static void
run_code(const qdot_shifted_lanes *s)
{
    double *square = qdot_lanes_code_number(s->code, UNIT_SQUARE);
    double *inverse = qdot_lanes_code_number(s->code, PER_UNIT);

    for (size_t l = 0; l < L; l++) {
        square[l] = s->unit[l] * s->unit[l];
        inverse[l] = 1 / s->unit[l];
    }
    for (size_t b = 0; b < s->plan->structure.blocks; b++) {
        const size_t n = s->plan->blocks[b].n;

        memcpy(qdot_lanes_code_number(s->code, s->solvers[b].number),
               s->solvers[b].inverse, n * n * L * sizeof *s->F);
    }
    for (size_t f = 0; f < s->residual->functions; f++)
        memcpy(qdot_lanes_code_row(s->code, f), s->F + f * s->stride * L,
               L * sizeof *s->F);
    qdot_lanes_code_run(s->code);
}

static void
extend(int p, void *user)
{
    qdot_shifted_lanes *s = user;

    for (size_t b = 0; b < s->plan->structure.blocks; b++)
        if (!s->plan->blocks[b].constant)
            s->kernels->invert(s->plan->blocks[b].n, s->plan->blocks[b].n, s->solvers[b].A,
                               s->solvers[b].inverse);
    if (s->code && p + 1 == s->to) {
        run_code(s);
        return;
    }
    for (int m = 3; m <= p + 1; m++)
        order(s, m);
}

/* --- the same as machine code ------------------------------------------------------- */

static double
factor_of(int m)
{
    return (double)m * (m - 1);
}

static double
minus_inverse_of(int m)
{
    return m > 1 ? -1.0 / (m * (m - 1)) : 0;
}

/* In low orders what that is beyond its double (series/taylor.h). */
static double
minus_beyond(int m)
{
    const double minus = minus_inverse_of(m);

    return m > 1 && m - 2 <= QDOT_TAYLOR_EXACT ? -fma(minus, m * (m - 1), 1) / (m * (m - 1))
                                               : 0;
}

static double
itself(int m)
{
    return m;
}

static qdot_lanes_at
input(const qdot_lanes_writer *w, const qdot_shifted_lanes *s, size_t i, int m)
{
    return (qdot_lanes_at){qdot_lanes_row_of(w, s->q + i * s->stride * L), m};
}

static qdot_lanes_at
second_derivative(const qdot_lanes_writer *w, size_t f)
{
    return qdot_lanes_number(w, NUMBERS + f);
}

static qdot_lanes_at
remainder_of(const qdot_lanes_writer *w, const qdot_shifted_lanes *s, size_t i)
{
    return qdot_lanes_number(w, NUMBERS + s->residual->functions + i);
}

/* No other weight is of what that one is of. */
static bool
is_alone(const qdot_residual *r, size_t weight)
{
    for (size_t i = 0; i < r->n_weights; i++)
        if (i != weight && r->weights[i].from == r->weights[weight].from)
            return false;
    return true;
}

static void
add_weighted(qdot_lanes_writer *w, const qdot_shifted_lanes *s, qdot_lanes_sum *F,
             size_t weight)
{
    const qdot_residual *r = s->residual;
    const qdot_lanes_at x = second_derivative(w, r->weights[weight].from);

    if (s->weight[weight] != 1)
        qdot_lanes_add_product(w, F, false, qdot_lanes_scalar(w, s->weight[weight]), x);
    else if (*F == QDOT_LANES_NOTHING && is_alone(r, weight))
        *F = qdot_lanes_continue_last(w, x);
    else
        qdot_lanes_add(w, F, false, x);
}

/* As `accelerate`. */
static void
write_forces(qdot_lanes_writer *w, const qdot_shifted_lanes *s, int m)
{
    const qdot_residual *r = s->residual;

    for (size_t f = 0; f < r->functions; f++) {
        qdot_lanes_sum x = QDOT_LANES_NOTHING;

        if (r->parent[f] != UINT32_MAX)
            x = qdot_lanes_continue(w, second_derivative(w, r->parent[f]));
        qdot_lanes_add_product(w, &x, false, qdot_lanes_scalar_of(w, factor_of, m),
                               (qdot_lanes_at){qdot_lanes_row_of(w, s->d[f]), m});
        qdot_lanes_store(w, x, second_derivative(w, f));
    }
    for (size_t f = r->functions; f-- > 0;) {
        qdot_lanes_sum F = QDOT_LANES_NOTHING;

        for (size_t i = 0; i < r->n_weights; i++)
            if (r->weights[i].to == f)
                add_weighted(w, s, &F, i);
        for (size_t child = f + 1; child < r->functions; child++)
            if (r->parent[child] == f)
                qdot_lanes_add(w, &F, false,
                               (qdot_lanes_at){qdot_lanes_further_row(w, child), m - 2});
        qdot_lanes_store(w, F, (qdot_lanes_at){qdot_lanes_further_row(w, f), m - 2});
    }
    for (size_t f = 0; f < r->functions; f++)
        qdot_lanes_unread(w, second_derivative(w, f));
}

/* As `gather`, for one coordinate; k > 0. */
static void
write_remainder(qdot_lanes_writer *w, const qdot_shifted_lanes *s, size_t i, int k)
{
    const qdot_residual *r = s->residual;
    qdot_lanes_pair *pairs = s->pairs;
    size_t n = 0;
    qdot_lanes_sum R;

    for (size_t j = 0; j < r->n_slopes; j++)
        if (r->slopes[j].coordinate == i)
            pairs[n++] =
                (qdot_lanes_pair){qdot_lanes_row_of(w, s->slope[j]),
                                  qdot_lanes_further_row(w, r->slopes[j].function)};
    R = qdot_lanes_dots(w, n, pairs, k);
    for (size_t j = 0; j < n; j++)
        qdot_lanes_add_product(w, &R, false, (qdot_lanes_at){pairs[j].x, k},
                               (qdot_lanes_at){pairs[j].y, 0});
    if (s->Q[i])
        qdot_lanes_add_product(w, &R, true, qdot_lanes_number(w, UNIT_SQUARE),
                               (qdot_lanes_at){qdot_lanes_row_of(w, s->Q[i]), k});
    for (size_t j = 0; j < n; j++)
        qdot_lanes_add_product(w, &R, false, (qdot_lanes_at){pairs[j].x, 0},
                               (qdot_lanes_at){pairs[j].y, k});
    qdot_lanes_store(w, R, remainder_of(w, s, i));
}

/* Coefficients m of q and m - 1 of v. Remainders of the first coordinates, for which forces of
 * all others are summed, come last. */
static void
write_solution(qdot_lanes_writer *w, const qdot_shifted_lanes *s, size_t b, int m)
{
    const qdot_plan_block *block = s->plan->blocks + b;
    const size_t n = block->n;

    for (size_t i = 0; i < n; i++) {
        const qdot_lanes_at q = input(w, s, block->index[i], m);
        qdot_lanes_sum a = QDOT_LANES_NOTHING, v = a;

        for (size_t j = n; j-- > 0;)
            qdot_lanes_add_product(w, &a, false, remainder_of(w, s, block->index[j]),
                                   qdot_lanes_number(w, s->solvers[b].number +
                                                            (i > j ? i * n + j : j * n + i)));
        if (s->to > QDOT_TAYLOR_EXACT_FROM) {
            qdot_lanes_store(w, a, q);
            a = QDOT_LANES_NOTHING;
            qdot_lanes_add_product(w, &a, false, q, qdot_lanes_scalar_of(w, minus_beyond, m));
            qdot_lanes_add_product(w, &a, false, q,
                                   qdot_lanes_scalar_of(w, minus_inverse_of, m));
        } else {
            qdot_lanes_scale(w, &a, qdot_lanes_scalar_of(w, minus_inverse_of, m));
        }
        qdot_lanes_store(w, a, q);
        qdot_lanes_add_product(w, &v, false, q, qdot_lanes_number(w, M_PER_UNIT));
        qdot_lanes_store(w, v, input(w, s, s->plan->n + block->index[i], m - 1));
    }
}

/* As `order`. */
static void
write_order(qdot_lanes_writer *w, int m, void *user)
{
    const qdot_shifted_lanes *s = user;
    const size_t n = s->plan->n, functions = s->residual->functions;
    qdot_lanes_sum m_per_unit = QDOT_LANES_NOTHING;

    for (size_t i = 0; i < n; i++)
        s->inputs[i] = input(w, s, i, m).row;
    for (size_t f = 0; f < functions; f++)
        s->differences[f] = qdot_lanes_row_of(w, s->d[f]);
    qdot_lanes_steps_without(w, m, n, s->inputs, functions, s->differences);
    write_forces(w, s, m);
    for (size_t i = n; i-- > 0;)
        write_remainder(w, s, i, m - 2);
    for (size_t f = 0; f < functions; f++)
        qdot_lanes_unread(w, (qdot_lanes_at){qdot_lanes_further_row(w, f), m - 2});
    qdot_lanes_add_product(w, &m_per_unit, false, qdot_lanes_number(w, PER_UNIT),
                           qdot_lanes_scalar_of(w, itself, m));
    qdot_lanes_store(w, m_per_unit, qdot_lanes_number(w, M_PER_UNIT));
    for (size_t b = 0; b < s->plan->structure.blocks; b++)
        write_solution(w, s, b, m);
    for (size_t i = 0; i < n; i++)
        qdot_lanes_unread(w, remainder_of(w, s, i));
    qdot_lanes_unread(w, qdot_lanes_number(w, M_PER_UNIT));
    qdot_lanes_steps_with(w, m);
    write_forces(w, s, m);
}

static void
write_expansion(qdot_lanes_writer *w, void *user)
{
    qdot_shifted_lanes *s = user;

    qdot_lanes_orders(w, 3, 2, 3, s->to, write_order, s);
}

/* Rows of the program that are read by order must be there from orders before the code's. */
static qdot_status
write_code(qdot_shifted_lanes *s, int most)
{
    size_t numbers = NUMBERS + s->residual->functions + s->plan->n;

    s->to = most + 1;
    for (size_t b = 0; b < s->plan->structure.blocks; b++) {
        const size_t n = s->plan->blocks[b].n;

        s->solvers[b].number = numbers;
        if (n > most_solved)
            return QDOT_OK;
        numbers += n * n;
    }
    s->pairs = qdot_calloc(s->residual->n_slopes + 1, sizeof *s->pairs);
    s->inputs = qdot_calloc(s->plan->n, sizeof *s->inputs);
    s->differences = qdot_calloc(s->residual->functions + 1, sizeof *s->differences);
    if (!s->pairs || !s->inputs || !s->differences)
        return QDOT_ENOMEM;
    return qdot_lanes_code_new(s->places, s->residual->functions, numbers, write_expansion,
                               s, &s->code);
}

/* --- building ----------------------------------------------------------------------- */

static qdot_status
make_solver(qdot_shifted_lanes *s, size_t b, bool shaken)
{
    const qdot_plan_block *block = s->plan->blocks + b;
    solver *at = s->solvers + b;
    size_t n = block->n;

    at->A = qdot_calloc(n * n * L, sizeof *at->A);
    at->inverse = qdot_calloc(n * n * L, sizeof *at->inverse);
    at->x = qdot_calloc(n * L, sizeof *at->x);
    at->y = qdot_calloc(n * L, sizeof *at->y);
    if (!at->A || !at->inverse || !at->x || !at->y)
        return QDOT_ENOMEM;
    if (!block->constant)
        return QDOT_OK;
    for (size_t i = 0; i < n * n; i++)
        for (size_t l = 0; l < L; l++)
            at->A[i * L + l] =
                shaken ? qdot_shake_double(block->M[i], block->side[i]) : block->M[i];
    s->kernels->factor(n, n, at->A);
    s->kernels->invert(n, n, at->A, at->inverse);
    return QDOT_OK;
}

static qdot_status
make_tapes(qdot_shifted_lanes *s, bool shaken, int most)
{
    const qdot_residual *r = s->residual;
    qdot_tape *copy = NULL;
    qdot_status status;

    if (shaken) {
        QDOT_TRY(qdot_tape_shake(r->masses, &s->masses));
        QDOT_TRY(qdot_tape_shake(r->places, &copy));
    }
    status = qdot_lanes_new_moving(copy ? copy : r->places, most + 1, 2 * s->plan->n + 1,
                                   &s->places);
    qdot_tape_free(copy);
    return status;
}

static qdot_status
make(qdot_shifted_lanes *s, bool shaken, int most)
{
    const qdot_plan *p = s->plan;
    const qdot_residual *r = s->residual;

    QDOT_TRY(make_tapes(s, shaken, most));
    s->stride = qdot_lanes_stride(s->places);
    s->q = qdot_lanes_input(s->places, 0);
    s->v = qdot_lanes_input(s->places, p->n);
    s->t = qdot_lanes_input(s->places, 2 * p->n);
    s->d = qdot_calloc(r->functions + 1, sizeof *s->d);
    s->slope = qdot_calloc(r->n_slopes + 1, sizeof *s->slope);
    s->Q = qdot_calloc(p->n, sizeof *s->Q);
    s->weight = qdot_calloc(r->n_weights + 1, sizeof *s->weight);
    s->solvers = qdot_calloc(p->structure.blocks, sizeof *s->solvers);
    s->x = qdot_calloc(r->functions * L + 1, sizeof *s->x);
    s->sum = qdot_calloc(r->functions * L + 1, sizeof *s->sum);
    s->F = qdot_calloc(r->functions * s->stride * L + 1, sizeof *s->F);
    s->R = qdot_calloc(p->n * L, sizeof *s->R);
    s->in = qdot_calloc((2 * p->n + 1) * L, sizeof *s->in);
    s->out = qdot_calloc(qdot_tape_outputs(r->masses) * L + 1, sizeof *s->out);
    s->work = qdot_calloc(qdot_tape_work(r->masses) * L + 1, sizeof *s->work);
    if (!s->d || !s->slope || !s->Q || !s->weight || !s->solvers || !s->x || !s->sum || !s->F || !s->R || !s->in ||
        !s->out || !s->work)
        return QDOT_ENOMEM;
    for (size_t f = 0; f < r->functions; f++)
        s->d[f] = qdot_lanes_output(s->places, f);
    for (size_t j = 0; j < r->n_slopes; j++)
        s->slope[j] = qdot_lanes_output(s->places, r->slopes[j].output);
    for (size_t i = 0; i < p->n; i++)
        if (r->force[i] != UINT32_MAX)
            s->Q[i] = qdot_lanes_output(s->places, r->force[i]);
    for (size_t w = 0; w < r->n_weights; w++)
        s->weight[w] = shaken ? qdot_shake_double(r->weights[w].w, r->weights[w].side)
                              : r->weights[w].w;
    for (size_t b = 0; b < p->structure.blocks; b++)
        QDOT_TRY(make_solver(s, b, shaken));
    return write_code(s, most);
}

/* Nanoseconds for all lanes, as measured with AVX-512; only their ratios matter. */
static qdot_status
choose_order(const qdot_plan *plan, double tol, int *order)
{
    const qdot_residual *r = plan->residual;
    qdot_ode_series series = {.most = most_order - 4};
    double *c = series.cost, length, convolutions, n = (double)plan->n;
    qdot_taylor *taylor;

    QDOT_TRY(qdot_taylor_new(r->places, 0, &taylor));
    length = (double)qdot_taylor_length(taylor);
    convolutions = qdot_taylor_convolutions(taylor) + (double)r->n_slopes;
    qdot_taylor_free(taylor);
    c[0] = 300 + 100 * (double)qdot_tape_calls(r->places) + 5 * length + 20 * n +
           2 * (double)qdot_tape_operations(r->masses) + n * n * n / 3;
    c[1] = 4 * length + 3 * convolutions + 15 * n + n * n +
           8.0 * (double)(r->functions + r->n_weights);
    c[2] = 0.1 * convolutions;
    if (qdot_lanes_may_be_code() && n <= most_solved) {
        double *w = series.code.cost;

        w[0] = c[0] + 500 + 100 * n;
        w[1] = 0.2 * c[1];
        w[2] = 0.2 * convolutions;
    }
    *order = qdot_ode_taylor_order(&series, tol, false, 0);
    return QDOT_OK;
}

qdot_status
qdot_shifted_lanes_new(const qdot_plan *plan, bool shaken, double tol, int *order,
                       qdot_shifted_lanes **lanes)
{
    qdot_shifted_lanes *s;
    qdot_status status;

    *lanes = NULL;
    if (*order == 0)
        QDOT_TRY(choose_order(plan, tol, order));
    s = qdot_calloc(1, sizeof *s);
    if (!s)
        return QDOT_ENOMEM;
    s->plan = plan;
    s->residual = plan->residual;
    s->kernels = qdot_batch_kernels_get();
    s->orders = kinds[qdot_batch_kind()];
    status = make(s, shaken, *order);
    if (status != QDOT_OK) {
        qdot_shifted_lanes_free(s);
        return status;
    }
    *lanes = s;
    return QDOT_OK;
}

void
qdot_shifted_lanes_free(qdot_shifted_lanes *s)
{
    if (!s)
        return;
    for (size_t b = 0; s->solvers && b < s->plan->structure.blocks; b++) {
        qdot_free(s->solvers[b].A);
        qdot_free(s->solvers[b].inverse);
        qdot_free(s->solvers[b].x);
        qdot_free(s->solvers[b].y);
    }
    qdot_lanes_code_free(s->code);
    qdot_free(s->pairs);
    qdot_free(s->inputs);
    qdot_free(s->differences);
    qdot_lanes_free(s->places);
    qdot_tape_free(s->masses);
    qdot_free(s->d);
    qdot_free(s->slope);
    qdot_free(s->Q);
    qdot_free(s->solvers);
    qdot_free(s->weight);
    qdot_free(s->x);
    qdot_free(s->sum);
    qdot_free(s->F);
    qdot_free(s->R);
    qdot_free(s->in);
    qdot_free(s->out);
    qdot_free(s->work);
    qdot_free(s);
}

qdot_ode_batch
qdot_shifted_lanes_system(qdot_shifted_lanes *s)
{
    return (qdot_ode_batch){.n = 2 * s->plan->n,
                            .checked = s->plan->n,
                            .x = s->q,
                            .stride = s->stride,
                            .begin = begin,
                            .extend = extend,
                            .user = s};
}
