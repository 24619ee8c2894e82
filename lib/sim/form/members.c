/* members.c -- order by order: tape, solve, integrate twice, for all lanes. */
#include "sim/form/members.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "ode/taylor.h"
#include "series/lanes-code.h"
#include "series/taylor.h"

enum { L = QDOT_LANES, most_order = 44 };

/* Numbers of the code: units of time, their squares, what an order of q'' is multiplied by,
 * right-hand sides of a block, then the inverses. A larger block than this has none. */
enum {
    most_solved = 16,
    UNIT = 0,
    UNIT_SQUARE,
    ONCE,
    TWICE,
    RIGHT,
    INVERSES = RIGHT + most_solved
};

/* An entry of M that moves: of row i, times the acceleration j. */
typedef struct {
    size_t i, j; /* within the block */
    const double *M;
} coupling;

typedef struct {
    const size_t *index; /* [n] its coordinates */
    size_t number;       /* of the code's, the first of its inverse */
    const double **f; /* [n] series of the block's f */
    const double **M; /* lower triangle by rows */
    coupling *couplings;
    size_t n_couplings;
    double *A;           /* [n x n groups] of M_0, from below; its factor, of two rows itself */
    double *inverse;     /* [n x n groups] */
    double *x, *y;       /* [n groups] right-hand side, solution */
} block_series;

/* For one kind of processor (members.def): x = f_k - sum M_j a_{k-j}; solved_k = x; the
 * next orders of q and v. */
typedef struct {
    void (*couple)(size_t n, int k, const block_series *s, const double *const *a,
                   qdot_batch_dot *dot);
    void (*keep)(size_t n, int k, const block_series *s, size_t stride, double *solved);
    void (*integrate)(size_t n, int k, const double *unit, const double *const *a,
                      const double *const *rates, double *q, double *v, size_t stride);
} members_kernels;

struct qdot_members {
    const qdot_members_model *model;
    const qdot_batch_kernels *kernels;
    const members_kernels *orders;
    qdot_lanes *lanes;
    const double *parameters;
    double unit[L];
    double *q, *v, *t;      /* rows of the inputs */
    size_t stride;          /* groups */
    const double **outputs; /* of the tape */
    block_series *blocks;   /* [blocks] */
    const double **rates;   /* [n] series of q' where the momentum is kept, or NULL, and */
    const double **a;       /* [n] of q'' of the others: an output of the tape, or */
    double *solved;         /* [n x stride groups] */
    int to;                 /* order of q'' that */
    qdot_lanes_code *code;  /* goes to; NULL: kernels run */
};

static size_t
block_size(const qdot_members *m, size_t b)
{
    return m->model->structure.start[b + 1] - m->model->structure.start[b];
}

/* --- one order ---------------------------------------------------------------------- */

#define BATCH_BODY "sim/form/members.def"
#include "num/batch-kinds.def"

static const members_kernels *const kinds[] = {
    &portable_members,
#ifdef QDOT_X86_KINDS
    &avx2_members,
    &avx512_members,
#endif
};

static void
factor(qdot_members *m, size_t b)
{
    const block_series *s = m->blocks + b;
    size_t n = block_size(m, b), at = 0;

    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++)
            memcpy(s->A + (i * n + j) * L, s->M[at++], L * sizeof *s->A);
    if (n == 2)
        m->kernels->invert_two(s->A, s->inverse);
    else
        m->kernels->factor(n, s->A);
}

static void
invert(qdot_members *m)
{
    for (size_t b = 0; b < m->model->structure.blocks; b++)
        if (block_size(m, b) > 2)
            m->kernels->invert(block_size(m, b), m->blocks[b].A, m->blocks[b].inverse);
}

/* a_k of every coordinate, orders below k being there; then orders k + 1 of velocities
 * and coordinates. */
static void
order(qdot_members *m, int k)
{
    qdot_lanes_order(m->lanes, k);
    for (size_t b = 0; b < m->model->structure.blocks; b++) {
        const block_series *s = m->blocks + b;
        size_t n = block_size(m, b);

        if (n == 1)
            continue;
        m->orders->couple(n, k, s, m->a, m->kernels->dot[k]);
        if (k == 0)
            factor(m, b);
        if (k > 0 || n == 2) {
            m->kernels->multiply(n, s->inverse, s->x, s->y);
        } else {
            memcpy(s->y, s->x, n * L * sizeof *s->y);
            m->kernels->solve(n, s->A, s->y);
        }
        m->orders->keep(n, k, s, m->stride, m->solved);
    }
    m->orders->integrate(m->model->n, k, m->unit, m->a, m->rates, m->q, m->v, m->stride);
}

static void
begin(const double *t, const double *y, const double *unit, void *user)
{
    qdot_members *m = user;
    size_t n = m->model->n;

    memcpy(m->unit, unit, sizeof m->unit);
    for (size_t i = 0; i < n; i++) {
        memcpy(m->q + i * m->stride * L, y + i * L, L * sizeof *y);
        memcpy(m->v + i * m->stride * L, y + (n + i) * L, L * sizeof *y);
    }
    for (size_t c = 0; c < m->model->n_kept; c++)
        memcpy(qdot_lanes_input(m->lanes, 2 * n + 1 + m->model->varied + c),
               y + (n + m->model->kept[c]) * L, L * sizeof *y);
    memcpy(m->t, t, L * sizeof *t);
    memcpy(m->t + L, unit, L * sizeof *unit);
    qdot_lanes_draw(m->lanes, t);
    order(m, 0);
}

static void
run_code(qdot_members *m)
{
    double *unit = qdot_lanes_code_number(m->code, UNIT);
    double *square = qdot_lanes_code_number(m->code, UNIT_SQUARE);

    for (size_t l = 0; l < L; l++) {
        unit[l] = m->unit[l];
        square[l] = m->unit[l] * m->unit[l];
    }
    for (size_t b = 0; b < m->model->structure.blocks; b++) {
        const size_t n = block_size(m, b);

        if (n == 1)
            continue;
        memcpy(qdot_lanes_code_number(m->code, m->blocks[b].number), m->blocks[b].inverse,
               n * n * L * sizeof(double));
        for (size_t i = 0; i < n; i++) {
            const size_t at = m->blocks[b].index[i];

            memcpy(qdot_lanes_code_row(m->code, at), m->a[at], L * sizeof **m->a);
        }
    }
    qdot_lanes_code_run(m->code);
}

static void
extend(int p, void *user)
{
    qdot_members *m = user;

    invert(m);
    if (m->code && p == m->to + 1) {
        run_code(m);
        return;
    }
    for (int k = 1; k < p; k++)
        order(m, k);
}

static void
take(size_t lane, size_t member, void *user)
{
    qdot_members *m = user;

    for (size_t i = 0; i < m->model->varied; i++)
        qdot_lanes_input(m->lanes, 2 * m->model->n + 1 + i)[lane] =
            m->parameters[member * m->model->varied + i];
}

/* --- the same as machine code ------------------------------------------------------- */

static qdot_lanes_row
input(const qdot_lanes_writer *w, qdot_members *m, size_t i)
{
    return qdot_lanes_row_of(w, qdot_lanes_input(m->lanes, i));
}

/* Of q'', by coordinate: a row of the program or of the code's own. */
static qdot_lanes_row
acceleration(const qdot_lanes_writer *w, const qdot_members *m, size_t i)
{
    const double *end = m->solved + m->model->n * m->stride * L;

    return m->a[i] >= m->solved && m->a[i] < end ? qdot_lanes_further_row(w, i)
                                                 : qdot_lanes_row_of(w, m->a[i]);
}

/* x = f_k - sum_{j=1..k} M_j a_{k-j}, row i of a block. */
static void
write_right_hand_side(qdot_lanes_writer *w, const qdot_members *m, const block_series *s,
                      size_t i, int k)
{
    qdot_lanes_pair pairs[most_solved];
    size_t n = 0;
    qdot_lanes_sum x;

    for (size_t c = 0; c < s->n_couplings; c++)
        if (s->couplings[c].i == i)
            pairs[n++] =
                (qdot_lanes_pair){qdot_lanes_row_of(w, s->couplings[c].M),
                                  acceleration(w, m, s->index[s->couplings[c].j])};
    x = qdot_lanes_dots(w, n, pairs, k);
    for (size_t c = 0; c < n; c++)
        qdot_lanes_add_product(w, &x, false, (qdot_lanes_at){pairs[c].y, 0},
                               (qdot_lanes_at){pairs[c].x, k});
    qdot_lanes_take_from(w, &x, (qdot_lanes_at){qdot_lanes_row_of(w, s->f[i]), k});
    qdot_lanes_store(w, x, qdot_lanes_number(w, RIGHT + i));
}

static void
write_block(qdot_lanes_writer *w, const qdot_members *m, size_t b, int k)
{
    const block_series *s = m->blocks + b;
    const size_t n = block_size(m, b);

    for (size_t i = 0; i < n; i++)
        write_right_hand_side(w, m, s, i, k);
    for (size_t i = 0; i < n; i++) {
        qdot_lanes_sum a = QDOT_LANES_NOTHING;

        for (size_t j = 0; j < n; j++)
            qdot_lanes_add_product(w, &a, false, qdot_lanes_number(w, RIGHT + j),
                                   qdot_lanes_number(w, s->number + i * n + j));
        qdot_lanes_store(w, a, (qdot_lanes_at){acceleration(w, m, s->index[i]), k});
    }
}

/* 1/(k + 1), 1/((k + 1)(k + 2)); and in low orders what these are beyond their doubles, for
 * which a division is exact but for the last bit (series/taylor.h). */
static double
once(int k)
{
    return 1.0 / (k + 1);
}

static double
twice(int k)
{
    return 1.0 / ((k + 1) * (k + 2));
}

static double
beyond(double inverse, int k, int divisor)
{
    return k <= QDOT_TAYLOR_EXACT ? fma(-inverse, divisor, 1) / divisor : 0;
}

static double
once_beyond(int k)
{
    return beyond(once(k), k, k + 1);
}

static double
twice_beyond(int k)
{
    return beyond(twice(k), k, (k + 1) * (k + 2));
}

/* factor = unit^n/divisor, and to = factor a */
static void
write_factor(qdot_lanes_writer *w, size_t unit, qdot_lanes_by_order *inverse, int k,
             size_t factor)
{
    qdot_lanes_sum sum = QDOT_LANES_NOTHING;

    qdot_lanes_add_product(w, &sum, false, qdot_lanes_number(w, unit),
                           qdot_lanes_scalar_of(w, inverse, k));
    qdot_lanes_store(w, sum, qdot_lanes_number(w, factor));
}

static void
write_integral(qdot_lanes_writer *w, const qdot_members *m, qdot_lanes_at a, size_t unit,
               qdot_lanes_by_order *more, size_t factor, qdot_lanes_at to)
{
    qdot_lanes_sum sum = QDOT_LANES_NOTHING;

    /* orders of the loop are beyond these */
    if (m->to >= QDOT_TAYLOR_EXACT_FROM && a.order <= QDOT_TAYLOR_EXACT) {
        qdot_lanes_add_product(w, &sum, false, qdot_lanes_number(w, unit),
                               qdot_lanes_scalar_of(w, more, a.order));
        qdot_lanes_scale(w, &sum, a);
    }
    qdot_lanes_add_product(w, &sum, false, qdot_lanes_number(w, factor), a);
    qdot_lanes_store(w, sum, to);
}

/* An order of q'', k + 1 of velocities, k + 2 of coordinates; of q', k + 1 of coordinates. */
static void
write_order(qdot_lanes_writer *w, int k, void *user)
{
    qdot_members *m = user;
    const size_t n = m->model->n;

    qdot_lanes_steps(w, k);
    write_factor(w, UNIT, once, k, ONCE);
    write_factor(w, UNIT_SQUARE, twice, k, TWICE);
    for (size_t b = 0; b < m->model->structure.blocks; b++)
        if (block_size(m, b) > 1)
            write_block(w, m, b, k);
    for (size_t i = 0; i < n; i++) {
        qdot_lanes_at a;

        if (m->rates[i]) {
            write_integral(w, m, (qdot_lanes_at){qdot_lanes_row_of(w, m->rates[i]), k}, UNIT,
                           once_beyond, ONCE, (qdot_lanes_at){input(w, m, i), k + 1});
            continue;
        }
        a = (qdot_lanes_at){acceleration(w, m, i), k};
        write_integral(w, m, a, UNIT_SQUARE, twice_beyond, TWICE,
                       (qdot_lanes_at){input(w, m, i), k + 2});
        write_integral(w, m, a, UNIT, once_beyond, ONCE,
                       (qdot_lanes_at){input(w, m, n + i), k + 1});
    }
}

/* Order 2 of coordinates is there an order late. */
static void
write_expansion(qdot_lanes_writer *w, void *user)
{
    qdot_members *m = user;
    const size_t n = m->model->n;

    write_factor(w, UNIT, once, 1, ONCE);
    for (size_t i = 0; i < n; i++)
        if (!m->rates[i])
            write_integral(w, m, (qdot_lanes_at){input(w, m, n + i), 1}, UNIT, once_beyond,
                           ONCE, (qdot_lanes_at){input(w, m, i), 2});
    qdot_lanes_orders(w, 1, 0, m->to >= QDOT_TAYLOR_EXACT_FROM ? QDOT_TAYLOR_EXACT + 1 : 1,
                      m->to, write_order, m);
}

/* --- building ----------------------------------------------------------------------- */

static qdot_status
find_couplings(qdot_members *m, block_series *s, size_t n, size_t at)
{
    s->couplings = qdot_calloc(n * n, sizeof *s->couplings);
    s->A = qdot_calloc(n * n * L, sizeof *s->A);
    s->inverse = qdot_calloc(n * n * L, sizeof *s->inverse);
    s->x = qdot_calloc(n * L, sizeof *s->x);
    s->y = qdot_calloc(n * L, sizeof *s->y);
    if (!s->couplings || !s->A || !s->inverse || !s->x || !s->y)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++, at++) {
            if (qdot_lanes_is_constant(m->lanes, at))
                continue;
            s->couplings[s->n_couplings++] = (coupling){i, j, m->outputs[at]};
            if (i != j)
                s->couplings[s->n_couplings++] = (coupling){j, i, m->outputs[at]};
        }
    return QDOT_OK;
}

static qdot_status
find_outputs(qdot_members *m)
{
    size_t at = 0;

    for (size_t i = 0; i < qdot_tape_outputs(m->model->tape); i++)
        m->outputs[i] = qdot_lanes_output(m->lanes, i);
    for (size_t b = 0; b < m->model->structure.blocks; b++) {
        const size_t *index = m->model->structure.index + m->model->structure.start[b];
        block_series *s = m->blocks + b;
        size_t n = block_size(m, b);

        s->index = index;
        s->f = m->outputs + at;
        at += n;
        for (size_t i = 0; i < n; i++)
            m->a[index[i]] = n == 1 ? s->f[0] : m->solved + index[i] * m->stride * L;
        if (n == 1)
            continue;
        s->M = m->outputs + at;
        QDOT_TRY(find_couplings(m, s, n, at));
        at += n * (n + 1) / 2;
    }
    for (size_t c = 0; c < m->model->n_kept; c++)
        m->rates[m->model->kept[c]] = m->outputs[at++];
    return QDOT_OK;
}

static qdot_status
write_code(qdot_members *m, int most)
{
    size_t numbers = INVERSES;

    m->to = most - 1;
    for (size_t b = 0; b < m->model->structure.blocks; b++) {
        const size_t n = block_size(m, b);

        m->blocks[b].number = numbers;
        if (n > most_solved)
            return QDOT_OK;
        if (n > 1)
            numbers += n * n;
    }
    return qdot_lanes_code_new(m->lanes, m->model->n, numbers, write_expansion, m,
                               &m->code);
}

static qdot_status
make(qdot_members *m, const qdot_tape *tape, int most)
{
    size_t n = m->model->n;

    QDOT_TRY(qdot_lanes_new_moving(tape, most, 2 * n + 1, &m->lanes));
    m->stride = qdot_lanes_stride(m->lanes);
    m->q = qdot_lanes_input(m->lanes, 0);
    m->v = qdot_lanes_input(m->lanes, n);
    m->t = qdot_lanes_input(m->lanes, 2 * n);
    m->a = qdot_calloc(n, sizeof *m->a);
    m->rates = qdot_calloc(n, sizeof *m->rates);
    m->solved = qdot_calloc(n * m->stride * L, sizeof *m->solved);
    m->outputs = qdot_calloc(qdot_tape_outputs(tape) + 1, sizeof *m->outputs);
    m->blocks = qdot_calloc(m->model->structure.blocks + 1, sizeof *m->blocks);
    if (!m->a || !m->rates || !m->solved || !m->outputs || !m->blocks)
        return QDOT_ENOMEM;
    QDOT_TRY(find_outputs(m));
    return write_code(m, most);
}

qdot_status
qdot_members_new(const qdot_members_model *model, const qdot_tape *tape, int most,
                 qdot_members **members)
{
    qdot_members *m = qdot_calloc(1, sizeof *m);
    qdot_status status;

    *members = NULL;
    if (!m)
        return QDOT_ENOMEM;
    m->model = model;
    m->kernels = qdot_batch_kernels_get();
    m->orders = kinds[qdot_batch_kind()];
    status = make(m, tape, most);
    if (status != QDOT_OK) {
        qdot_members_free(m);
        return status;
    }
    *members = m;
    return QDOT_OK;
}

void
qdot_members_free(qdot_members *m)
{
    if (!m)
        return;
    for (size_t b = 0; m->blocks && b < m->model->structure.blocks; b++) {
        qdot_free(m->blocks[b].couplings);
        qdot_free(m->blocks[b].A);
        qdot_free(m->blocks[b].inverse);
        qdot_free(m->blocks[b].x);
        qdot_free(m->blocks[b].y);
    }
    qdot_lanes_code_free(m->code);
    qdot_lanes_free(m->lanes);
    qdot_free(m->outputs);
    qdot_free(m->blocks);
    qdot_free(m->a);
    qdot_free(m->rates);
    qdot_free(m->solved);
    qdot_free(m);
}

void
qdot_members_set(qdot_members *m, const double *parameters)
{
    m->parameters = parameters;
}

/* Momenta at the end of a state. */
static size_t
still(const qdot_members *m)
{
    size_t k = 0;

    while (k < m->model->n && m->rates[m->model->n - 1 - k])
        k++;
    return k;
}

qdot_ode_batch
qdot_members_system(qdot_members *m)
{
    return (qdot_ode_batch){.n = 2 * m->model->n,
                            .still = still(m),
                            .checked = m->model->n,
                            .x = m->q,
                            .stride = m->stride,
                            .take = take,
                            .begin = begin,
                            .extend = extend,
                            .user = m};
}

/* Nanoseconds for all lanes, as measured with AVX-512; only their ratios matter. */
static void
estimate(const qdot_members_model *model, double length, double convolutions, double *c)
{
    const double n = (double)model->n;

    c[0] = 300 + 100 * (double)qdot_tape_calls(model->tape) + 5 * length + 20 * n;
    c[1] = 2 * length + 3 * convolutions + 10 * n;
    c[2] = 0.1 * convolutions;
    for (size_t b = 0; b < model->structure.blocks; b++) {
        double m = (double)(model->structure.start[b + 1] - model->structure.start[b]);

        if (m == 1)
            continue;
        c[0] += m * m * m / 6;
        c[1] += 5 * m + m * m;
        c[2] += 0.1 * m * m;
    }
}

/* The same of machine code: five scenes at orders 8 to 26, to 8 %. */
static void
estimate_written(const qdot_members_model *model, double convolutions, double *c)
{
    const double n = (double)model->n;

    c[0] = 60 + 60 * n + 60 * (double)qdot_tape_calls(model->tape);
    c[1] = 10 * n;
    for (size_t b = 0; b < model->structure.blocks; b++) {
        double m = (double)(model->structure.start[b + 1] - model->structure.start[b]);

        c[0] += m * m * m / 6;
        convolutions += m * (m - 1);
    }
    c[2] = 0.123 * convolutions;
}

qdot_status
qdot_members_order(const qdot_members_model *model, double tol, int *order)
{
    qdot_ode_series series = {.most = most_order - 4};
    double length, convolutions;
    qdot_taylor *taylor;

    QDOT_TRY(qdot_taylor_new_moving(model->tape, false, 0, 2 * model->n + 1, 0, &taylor));
    length = (double)qdot_taylor_length(taylor);
    convolutions = qdot_taylor_convolutions(taylor);
    qdot_taylor_free(taylor);
    estimate(model, length, convolutions, series.cost);
    if (qdot_lanes_may_be_code())
        estimate_written(model, convolutions, series.written);
    /* A few orders beyond the least cost hardly more, and where no pole is near, as of a stiff
     * spring, steps gain more by an order than its model has them gain. */
    *order = qdot_ode_taylor_order(&series, pow(tol, 1.15), false, 0);
    return QDOT_OK;
}
