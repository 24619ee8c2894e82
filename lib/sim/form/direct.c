/* direct.c -- order by order: tape, solve, integrate twice. */
#include "sim/form/direct.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "num/kinds.h"
#include "num/series.h"
#include "sim/form/blocks.h"
#include "sim/form/expansion.h"

enum { most_order = 48 };

/* Unknowns of a larger block are not solved for by machine code, number by number. */
enum { most_linked = 6 };

/* An entry of M that moves: of row i, times the acceleration j. */
typedef struct {
    size_t i; /* within the block */
    const double *M, *a;
} coupling;

typedef struct {
    const double *const *f; /* [n] series of the block's f */
    const double *const *M; /* lower triangle by rows; NULL: constant */
    double *const *a;       /* [n] what is solved for; NULL: an output */
    double *matrices;       /* as qdot_taylor_solve has them */
    coupling *couplings;
    size_t n_couplings;
} block_series;

/* A momentum that is kept: its first double, the next one on the side of its second, and
 * the chance of that. */
typedef struct {
    double hi, lo, far, chance;
} momentum;

struct qdot_direct {
    const qdot_plan *plan;
    const qdot_series_kernels *kernels;
    qdot_expansion x;
    qdot_blocks solvers;
    qdot_ode_series series;
    double unit;
    const double **outputs; /* [outputs of the tape] */
    block_series *blocks;   /* [blocks] */
    const double **a;       /* [n] series of q'': an output of the tape, or solved for */
    bool diagonal;          /* all are outputs */
    bool linked;            /* the program knows all that it takes to go on alone */
    const double **rates;   /* [n_kept] series of velocities that are outputs */
    const double *hi, *lo;  /* [n_kept] their momenta; borrowed */
    momentum *momenta;      /* [n_kept] as they were drawn last */
    bool plain;             /* of those, hi alone */
    double inverse[most_order + 2];
    int exact; /* QDOT_TAYLOR_EXACT, or less */
};

/* f_k of a block less what M of orders above 0 takes of it. */
static void
right_hand_side(const qdot_direct *e, size_t b, int k)
{
    const qdot_plan_block *block = e->plan->blocks + b;
    const block_series *s = e->blocks + b;
    double *x = e->solvers.at[b].x;

    for (size_t i = 0; i < block->n; i++)
        x[i] = s->f[i][k];
    if (k > 0 && s->n_couplings > 0) {
        qdot_series_dot *dot = e->kernels->dot[k];

        for (size_t c = 0; c < s->n_couplings; c++) {
            const coupling *m = s->couplings + c;

            x[m->i] -= dot(m->M + 1, m->a + k - 1);
        }
    }
}

static qdot_status
factor(qdot_direct *e, size_t b)
{
    const block_series *s = e->blocks + b;
    size_t n = e->plan->blocks[b].n;
    double *to = e->solvers.at[b].a;
    size_t at = 0;

    if (!s->M)
        return QDOT_OK;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++)
            to[i * n + j] = s->M[at++][0];
    return qdot_blocks_factor(&e->solvers, b);
}

/* a_k of every coordinate, orders below k being there. */
static qdot_status
accelerations(qdot_direct *e, int k)
{
    const qdot_plan *p = e->plan;

    qdot_taylor_order(e->x.taylor, k);
    for (size_t b = 0; b < p->structure.blocks; b++) {
        const qdot_plan_block *block = p->blocks + b;
        const double *x = e->solvers.at[b].x;

        if (block->n == 1)
            continue;
        right_hand_side(e, b, k);
        if (k == 0)
            QDOT_TRY(factor(e, b));
        if (k <= QDOT_BLOCKS_SOLVED)
            qdot_blocks_solve(&e->solvers, b);
        else
            qdot_blocks_apply(&e->solvers, b);
        for (size_t i = 0; i < block->n; i++)
            e->blocks[b].a[i][k] = x[i];
    }
    return QDOT_OK;
}

/* Order k + 1 of velocities and, an order before they are wanted, k + 2 of coordinates. */
static void
integrate(qdot_direct *e, int k)
{
    const double once = e->unit * e->inverse[k + 1];
    const double twice = once * (e->unit * e->inverse[k + 2]);

    for (size_t i = 0; i < e->plan->n; i++) {
        double a;

        if (!e->a[i])
            continue;
        a = e->a[i][k];
        if (k <= e->exact) {
            e->x.v[i * e->x.stride + (size_t)k + 1] = e->unit * a / (k + 1);
            e->x.q[i * e->x.stride + (size_t)k + 2] =
                e->unit * (e->unit * a) / ((k + 1) * (k + 2));
            continue;
        }
        e->x.v[i * e->x.stride + (size_t)k + 1] = once * a;
        e->x.q[i * e->x.stride + (size_t)k + 2] = twice * a;
    }
    for (size_t c = 0; c < e->plan->n_kept; c++)
        e->x.q[e->plan->kept[c] * e->x.stride + (size_t)k + 1] =
            k <= e->exact ? e->unit * e->rates[c][k] / (k + 1)
                                   : once * e->rates[c][k];
}

/* Coefficients below p of velocities that follow from momenta, where others read them. */
static void
show_rates(qdot_direct *e, int p)
{
    for (size_t c = 0; c < e->plan->n_kept; c++) {
        double *v = e->x.v + e->plan->kept[c] * e->x.stride;

        memcpy(v, e->rates[c], (size_t)p * sizeof *v);
        v[p] = 0;
    }
}

/* What the momenta are from t on. */
static void
draw_momenta(qdot_direct *e, double t)
{
    const size_t n = e->plan->n;

    for (size_t c = 0; c < e->plan->n_kept; c++) {
        momentum *m = e->momenta + c;
        double *to = e->x.t + (c + 1) * e->x.stride;

        *to = e->hi[c];
        if (e->plain || e->lo[c] == 0)
            continue;
        if (m->hi != e->hi[c] || m->lo != e->lo[c]) {
            *m = (momentum){.hi = e->hi[c], .lo = e->lo[c]};
            m->far = nextafter(m->hi, m->lo > 0 ? INFINITY : -INFINITY);
            m->chance = m->lo / (m->far - m->hi);
        }
        if (qdot_taylor_chance(t, n + c) < m->chance)
            *to = m->far;
    }
}

/* Which of them is undefined. */
static qdot_status
say_undefined(const qdot_direct *e)
{
    const qdot_plan *p = e->plan;

    for (size_t i = 0; i < p->n; i++)
        if (e->a[i] && !isfinite(e->a[i][0]))
            return qdot_fail(QDOT_EDOMAIN, "the acceleration of %s is undefined",
                             p->names[i]);
    for (size_t c = 0; c < p->n_kept; c++)
        if (!isfinite(e->rates[c][0]))
            return qdot_fail(QDOT_EDOMAIN, "the velocity of %s is undefined",
                             p->names[p->kept[c]]);
    return QDOT_OK;
}

static qdot_status
begin(double t, const double *y, double unit, void *user)
{
    qdot_direct *e = user;
    const size_t n = e->plan->n, kept = e->plan->n_kept;
    double nothing = 0; /* a sum of zeros, if all is finite */

    e->unit = unit;
    qdot_expansion_begin(&e->x, t, y, unit);
    if (e->hi)
        draw_momenta(e, t);
    if (e->diagonal) {
        qdot_taylor_begin(e->x.taylor, unit);
    } else {
        QDOT_TRY(accelerations(e, 0));
        if (e->linked)
            qdot_taylor_begin_links(e->x.taylor, unit);
        else
            integrate(e, 0);
    }
    for (size_t i = 0; i < n; i++)
        nothing += e->a[i] ? 0 * e->a[i][0] : 0;
    for (size_t c = 0; c < kept; c++)
        nothing += 0 * e->rates[c][0];
    if (nothing != 0)
        return say_undefined(e);
    if (kept > 0)
        show_rates(e, 1);
    return QDOT_OK;
}

static qdot_status
prepare(int p, void *user)
{
    qdot_direct *e = user;

    e->exact = p > QDOT_TAYLOR_EXACT_FROM ? QDOT_TAYLOR_EXACT : 0;
    return QDOT_OK;
}

/* The matrices of what the program solves for. */
static void
hand_over(qdot_direct *e)
{
    for (size_t b = 0; b < e->plan->structure.blocks; b++) {
        const qdot_solver *s = e->solvers.at + b;
        const size_t n = e->plan->blocks[b].n;
        double *to = e->blocks[b].matrices;

        if (n == 1)
            continue;
        for (size_t i = 0; i < n; i++) {
            memcpy(to + i * n, s->a + i * n, (i + 1) * sizeof *to);
            memcpy(to + (n + i) * n, s->inverse + i * s->m, n * sizeof *to);
        }
    }
}

static qdot_status
extend(int p, void *user)
{
    qdot_direct *e = user;

    if (e->diagonal) {
        qdot_taylor_extend(e->x.taylor, 1, p - 1);
        show_rates(e, p);
        return QDOT_OK;
    }
    for (size_t b = 0; b < e->plan->structure.blocks; b++)
        if (e->plan->blocks[b].n > 1 && !e->plan->blocks[b].constant)
            qdot_blocks_invert(&e->solvers, b);
    if (e->linked && qdot_taylor_is_code(e->x.taylor, p - 1)) {
        hand_over(e);
        qdot_taylor_extend(e->x.taylor, 1, p - 1);
        show_rates(e, p);
        return QDOT_OK;
    }
    for (int k = 1; k < p; k++) {
        QDOT_TRY(accelerations(e, k));
        integrate(e, k);
    }
    show_rates(e, p);
    return QDOT_OK;
}

/* --- building ----------------------------------------------------------------------- */

/* The series of a block's accelerations, f being the tape's outputs from `from` on and M, if
 * it is not constant, those behind. */
static qdot_status
unknowns(qdot_direct *e, size_t b, size_t from)
{
    const qdot_plan_block *block = e->plan->blocks + b;
    const size_t n = block->n, entries = block->constant ? 0 : n * (n + 1) / 2;
    block_series *s = e->blocks + b;
    size_t *outputs = qdot_calloc(n + entries, sizeof *outputs);
    qdot_status status;

    if (!outputs)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n + entries; i++)
        outputs[i] = from + i;
    status = qdot_taylor_solve(e->x.taylor, n, outputs, entries > 0 ? outputs + n : NULL,
                               QDOT_BLOCKS_SOLVED, &s->a, &s->matrices);
    qdot_free(outputs);
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        e->a[block->index[i]] = s->a[i];
    return status;
}

/* Where the tape's outputs are found, and which entries of M move. */
static qdot_status
find_outputs(qdot_direct *e, size_t count)
{
    const qdot_plan *p = e->plan;
    size_t at = 0;

    e->diagonal = p->structure.blocks == p->n - p->n_kept;
    for (size_t i = 0; i < count; i++)
        e->outputs[i] = qdot_taylor_output(e->x.taylor, i);
    for (size_t b = 0; b < p->structure.blocks; b++) {
        const qdot_plan_block *block = p->blocks + b;
        block_series *s = e->blocks + b;
        size_t n = block->n;

        s->f = e->outputs + at;
        at += n;
        if (n == 1) {
            e->a[block->index[0]] = s->f[0];
            continue;
        }
        QDOT_TRY(unknowns(e, b, at - n));
        if (block->constant)
            continue;
        s->M = e->outputs + at;
        s->couplings = qdot_calloc(n * n, sizeof *s->couplings);
        if (!s->couplings)
            return QDOT_ENOMEM;
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j <= i; j++, at++) {
                if (qdot_taylor_is_constant(e->x.taylor, at))
                    continue;
                s->couplings[s->n_couplings++] =
                    (coupling){i, e->outputs[at], e->a[block->index[j]]};
                if (i != j)
                    s->couplings[s->n_couplings++] =
                        (coupling){j, e->outputs[at], e->a[block->index[i]]};
            }
    }
    for (size_t c = 0; c < p->n_kept; c++)
        e->rates[c] = e->outputs[at++];
    return QDOT_OK;
}

/* Orders of forces end two below that of q. */
static double
near(int p, double s, void *user)
{
    return qdot_taylor_near(((const qdot_direct *)user)->x.taylor, p - 2, s);
}

/* Nanoseconds, as measured on a machine of 2023; only their ratios matter. */
static void
estimate_cost(qdot_direct *e)
{
    const qdot_plan *p = e->plan;
    double *c = e->series.cost, convolutions = qdot_direct_convolutions(e);

    c[0] = 60 + 15.0 * (double)qdot_tape_calls(p->tape) +
           2.0 * (double)qdot_taylor_length(e->x.taylor) + 10.0 * (double)p->n;
    c[1] = 1.5 + 1.2 * (double)qdot_taylor_length(e->x.taylor) + 3.5 * convolutions +
           2.0 * (double)p->n;
    c[2] = 0.12 * convolutions;
    for (size_t b = 0; b < p->structure.blocks; b++) {
        double n = (double)p->blocks[b].n;

        if (n == 1)
            continue;
        c[1] += 5 * n + 0.5 * n * n;
        if (!p->blocks[b].constant)
            c[0] += 5 * n + 0.2 * n * n * n;
    }
}

/* The same of machine code (doc/methods.md). What every step takes is known better here, for
 * it decides. By AVX-512 an order costs little; by AVX2 the orders of a further vector cost as much as the
 * instructions that it is read by; by SSE2 all vectors do. */
static void
estimate_written(qdot_direct *e)
{
    static const struct {
        double order, pair, vector;
    } costs[] = {{1.8, 0.15, 0}, {1, 0.03, 16}, {1, 0.03, 0}}; /* by kind */
    const size_t kind = qdot_kind_is_here(2) ? 2 : qdot_kind_is_here(1);
    const qdot_plan *p = e->plan;
    const double length = (double)qdot_taylor_length(e->x.taylor);
    qdot_ode_code *code = &e->series.code;
    double *c = code->cost, convolutions = qdot_direct_convolutions(e);

    if (!e->linked)
        return;
    *code = qdot_expansion_code(e->x.taylor);
    code->worth = 800 + 5000 / (length + 1);
    if (!qdot_taylor_may_be_code())
        return;
    code->digits = e->diagonal ? 24 : QDOT_ODE_DIGITS;
    code->by_stability = e->diagonal && kind > 1;
    c[0] = 160 + 20 * (double)qdot_tape_calls(p->tape) + 3 * length + 10 * (double)p->n;
    c[1] = costs[kind].order * (3 + 0.4 * length + 0.6 * convolutions);
    c[2] = costs[kind].pair * convolutions;
    code->wider = costs[kind].vector * convolutions;
    code->narrow = 10;
    code->of_vector = 8;
    for (size_t b = 0; b < p->structure.blocks; b++) {
        const double n = (double)p->blocks[b].n;

        if (n > 1) {
            c[0] += 20 * n + n * n * n;
            c[1] += n * n;
        }
    }
}

static qdot_status
make(qdot_direct *e, const qdot_plan *p, bool shaken)
{
    size_t outputs = qdot_tape_outputs(p->tape);
    qdot_taylor *taylor;

    QDOT_TRY(qdot_taylor_new_moving(p->tape, shaken, most_order, 2 * p->n + 1,
                                    p->n, &taylor));
    e->x = qdot_expansion_of(taylor, p->n);
    e->a = qdot_calloc(p->n, sizeof *e->a);
    e->outputs = qdot_calloc(outputs + 1, sizeof *e->outputs);
    e->blocks = qdot_calloc(p->structure.blocks + 1, sizeof *e->blocks);
    e->rates = qdot_calloc(p->n_kept + 1, sizeof *e->rates);
    e->momenta = qdot_calloc(p->n_kept + 1, sizeof *e->momenta);
    if (!e->a || !e->outputs || !e->blocks || !e->rates || !e->momenta)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_blocks_init(&e->solvers, p, shaken));
    for (size_t b = 0; b < p->structure.blocks; b++)
        if (p->blocks[b].n > 1) {
            QDOT_TRY(qdot_blocks_prepare(&e->solvers, b));
            if (p->blocks[b].constant)
                qdot_blocks_invert(&e->solvers, b);
        }
    QDOT_TRY(find_outputs(e, outputs));
    e->linked = !p->indefinite || e->diagonal;
    for (size_t b = 0; b < p->structure.blocks; b++)
        e->linked = e->linked && p->blocks[b].n <= most_linked;
    for (size_t i = 0; i < p->n && e->linked; i++)
        if (e->a[i])
            QDOT_TRY(qdot_taylor_link(e->x.taylor, p->n + i, i, e->a[i]));
    for (size_t c = 0; c < p->n_kept && e->linked; c++)
        QDOT_TRY(qdot_taylor_link(e->x.taylor, p->kept[c], SIZE_MAX, e->rates[c]));
    e->plain = shaken;
    for (int k = 1; k < most_order + 2; k++)
        e->inverse[k] = 1.0 / k;
    e->series = (qdot_ode_series){.most = most_order - 4,
                                  .x = e->x.q,
                                  .stride = e->x.stride,
                                  .checked = p->n,
                                  .prepare = prepare,
                                  .begin = begin,
                                  .extend = extend,
                                  .near = qdot_taylor_has_exponentials(e->x.taylor) ? near : NULL,
                                  .user = e};
    estimate_cost(e);
    estimate_written(e);
    return QDOT_OK;
}

qdot_status
qdot_direct_new(const qdot_plan *plan, bool shaken, qdot_direct **direct)
{
    qdot_direct *e = qdot_calloc(1, sizeof *e);
    qdot_status status;

    *direct = NULL;
    if (!e)
        return QDOT_ENOMEM;
    e->plan = plan;
    e->kernels = qdot_series_kernels_get();
    status = make(e, plan, shaken);
    if (status != QDOT_OK) {
        qdot_direct_free(e);
        return status;
    }
    *direct = e;
    return QDOT_OK;
}

void
qdot_direct_free(qdot_direct *e)
{
    if (!e)
        return;
    for (size_t b = 0; e->blocks && b < e->plan->structure.blocks; b++)
        qdot_free(e->blocks[b].couplings);
    qdot_taylor_free(e->x.taylor);
    qdot_blocks_clear(&e->solvers);
    qdot_free(e->outputs);
    qdot_free(e->rates);
    qdot_free(e->momenta);
    qdot_free(e->blocks);
    qdot_free(e->a);
    qdot_free(e);
}

void
qdot_direct_keep(qdot_direct *e, const double *hi, const double *lo)
{
    e->hi = hi;
    e->lo = lo;
}

const double *
qdot_direct_output(const qdot_direct *e, size_t i)
{
    return e->outputs[i];
}

const qdot_ode_series *
qdot_direct_series(const qdot_direct *e)
{
    return &e->series;
}

double
qdot_direct_convolutions(const qdot_direct *e)
{
    double sum = qdot_taylor_convolutions(e->x.taylor);

    for (size_t b = 0; b < e->plan->structure.blocks; b++)
        sum += (double)e->blocks[b].n_couplings;
    return sum;
}

size_t
qdot_direct_code(const qdot_direct *e, const char **why)
{
    const size_t bytes = qdot_taylor_code_bytes(e->x.taylor, why);

    if (bytes == 0 && !*why)
        *why = e->linked ? "machine code is not asked for"
                         : "machine code solves for few unknowns, with M definite";
    return bytes;
}

size_t
qdot_direct_factored(const qdot_direct *e)
{
    return e->solvers.factored;
}
