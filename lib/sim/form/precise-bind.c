/* precise-bind.c -- order by order in MPFR: tape, solve, integrate twice. */
#include "sim/form/precise-bind.h"

#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "sim/form/blocks.h"
#include "sim/model/constrained.h"
#include "sim/model/constraints.h"
#include "tape/constant.h"
#include "series/precise.h"
#include "series/taylor.h"

static const double most_bytes = 2e9;

/* An entry of M that moves: of row i, times the acceleration j. */
typedef struct {
    size_t i, j; /* within the block */
    const mpfr_t *M;
} coupling;

typedef struct {
    const mpfr_t *const *f; /* [n] series of the block's f */
    const mpfr_t *const *M; /* lower triangle by rows; NULL: constant */
    mpfr_t *lu;             /* [n x n] */
    mpfr_t *x, *y;          /* [n] */
    size_t *order;          /* [n] */
    double *scale;          /* [n] */
    coupling *couplings;
    size_t n_couplings;
} solver;

struct qdot_precise_bind {
    const qdot_plan *plan;
    qdot_precise *tape;
    qdot_precise_system system;
    mpfr_t *q, *v, *t; /* the inputs' rows, `stride` apart */
    size_t stride;
    const mpfr_t **outputs; /* [outputs of the tape] */
    const mpfr_t **a;       /* [n] series of q'': an output of the tape, or of solved */
    solver *solvers;        /* [blocks]; with constraints one, of n + m unknowns */
    qdot_reals solved;      /* [n x stride]; with constraints [n + m] */
    qdot_reals numbers;     /* of the solvers; then 2 of scratch */
    mpfr_t *w;
    mp_limb_t *work;
    double *widest; /* [constraints] the largest squared norm of each row of A so far */
    qdot_precise *held[2]; /* residuals of positions, of velocities; NULL without such rows */
    size_t factored;
};

void
qdot_precise_bind_cost(const qdot_plan *p, mpfr_prec_t bits, double cost[3])
{
    const double limbs = ceil((double)bits / 64), term = 9 + 1.3 * limbs * limbs;
    const double operation = 40 + 1.3 * limbs * limbs;
    double length = (double)qdot_tape_operations(p->tape);
    double convolutions = p->constraints ? length : p->convolutions_derived;

    cost[0] = 60 * operation * (double)qdot_tape_calls(p->tape) + operation * length;
    cost[1] = operation * (length + 4 * (double)p->n) + convolutions * 40;
    cost[2] = 0.5 * convolutions * term;
    for (size_t b = 0; b < p->structure.blocks; b++) {
        double n = (double)p->blocks[b].n;

        if (n > 1) {
            cost[1] += 2 * n * n * operation;
            cost[0] += 2 * n * n * n / 3 * operation;
        }
    }
}

/* --- with constraints ---------------------------------------------------------------- */

/* The unknowns are q'' and -lambda; output `at` stands in row i, column j of
 *
 *     [ M  A^T ]
 *     [ A   0  ]
 *
 * and in row j, column i. The output of entry number k; false behind the last. */
static bool
entry(const qdot_precise_bind *e, size_t k, size_t *i, size_t *j, size_t *at)
{
    const size_t n = e->plan->n;
    const qdot_constraints *c = e->plan->constraints;

    *at = n + k;
    if (k < c->n_masses) {
        *i = c->masses[k].row;
        *j = c->masses[k].column;
        return true;
    }
    k -= c->n_masses;
    if (k >= c->n_slopes)
        return false;
    *i = n + c->slopes[k].row;
    *j = c->slopes[k].column;
    return true;
}

/* A row that has shrunk far below the largest that it was has no direction left that the error
 * of the run did not make, of whose size it is when a velocity in it is its root. */
static qdot_status
find_faded(qdot_precise_bind *e)
{
    const qdot_constraints *c = e->plan->constraints;
    const double faded = ldexp(1, -(int)e->system.bits / 2);
    size_t s = 0;

    for (size_t k = 0; k < c->m; k++) {
        double sum = 0;

        for (; s < c->n_slopes && c->slopes[s].row == k; s++) {
            const double x =
                mpfr_get_d(e->outputs[e->plan->n + c->n_masses + s][0], MPFR_RNDN);

            sum += x * x;
        }
        if (sum > e->widest[k])
            e->widest[k] = sum;
        else if (sum < faded * e->widest[k])
            return qdot_constrained_without_direction(c, k);
    }
    return QDOT_OK;
}

static qdot_status
factor_tied(qdot_precise_bind *e)
{
    const size_t size = e->plan->n + e->plan->constraints->m;
    solver *s = e->solvers;
    size_t failed, i, j, at;

    QDOT_TRY(find_faded(e));
    for (i = 0; i < size * size; i++)
        mpfr_set_zero(s->lu[i], 1);
    for (size_t k = 0; entry(e, k, &i, &j, &at); k++) {
        mpfr_set(s->lu[i * size + j], e->outputs[at][0], MPFR_RNDN);
        mpfr_set(s->lu[j * size + i], e->outputs[at][0], MPFR_RNDN);
    }
    e->factored++;
    if (qdot_real_lu(size, s->lu, s->order, s->scale, &failed, e->w) != QDOT_OK)
        return qdot_fail(QDOT_ESINGULAR, "the constraints are not independent, or no mass "
                                         "moves along them: `digits` wants that");
    return QDOT_OK;
}

static qdot_status
accelerations_tied(qdot_precise_bind *e, int k)
{
    const qdot_constraints *c = e->plan->constraints;
    const size_t n = e->plan->n, size = n + c->m;
    const size_t gamma = n + c->n_masses + c->n_slopes;
    solver *s = e->solvers;

    qdot_precise_order(e->tape, k);
    if (k == 0)
        QDOT_TRY(factor_tied(e));
    for (size_t i = 0; i < size; i++)
        mpfr_set(s->x[i], e->outputs[i < n ? i : gamma + i - n][k], MPFR_RNDN);
    for (size_t at = 0; k > 0 && at < s->n_couplings; at++) {
        const coupling *m = s->couplings + at;

        qdot_real_dot(e->w[0], m->M + 1,
                      (const mpfr_t *)e->solved.at + m->j * e->stride + k - 1, (size_t)k,
                      e->work);
        mpfr_sub(s->x[m->i], s->x[m->i], e->w[0], MPFR_RNDN);
    }
    qdot_real_solve(size, (const mpfr_t *)s->lu, s->order, s->x, s->y, e->w);
    for (size_t i = 0; i < size; i++)
        mpfr_set(e->solved.at[i * e->stride + (size_t)k], s->x[i], MPFR_RNDN);
    return QDOT_OK;
}

/* log2 of the largest |A_ki u_i|, or of 1; u: a row of inputs. *at: the first of the slopes of
 * row k, then that of the next row. */
static double
log2_terms(const qdot_precise_bind *e, size_t k, const mpfr_t *u, size_t *at)
{
    const qdot_constraints *c = e->plan->constraints;
    double most = 0;

    for (; *at < c->n_slopes && c->slopes[*at].row == k; ++*at)
        most = fmax(most,
                    qdot_real_log2(e->outputs[e->plan->n + c->n_masses + *at][0])
                        + qdot_real_log2(u[c->slopes[*at].column * e->stride]));
    return most;
}

/* Nothing is projected, and what drifts is of the last digits: where constraints are off by more than
 * a quarter of them can tell, a step has passed a place behind which q'' = ... is not what they say,
 * as y = sqrt(x) is left at y = 0. */
static qdot_status
find_left(qdot_precise_bind *e, const mpfr_t *y)
{
    const qdot_constraints *c = e->plan->constraints;
    const size_t inputs = 2 * e->plan->n;
    const double allowed = -(double)e->system.bits / 4;

    for (size_t order = 0; order < 2; order++) {
        const mpfr_t *u = order ? e->v : e->q;
        size_t at = 0, out = 0;

        if (!e->held[order])
            continue;
        for (size_t i = 0; i < inputs; i++)
            mpfr_set(qdot_precise_input(e->held[order], i)[0], y[i], MPFR_RNDN);
        mpfr_set(qdot_precise_input(e->held[order], inputs)[0], e->t[0], MPFR_RNDN);
        qdot_precise_order(e->held[order], 0);
        for (size_t k = 0; k < c->m; k++) {
            const double terms = log2_terms(e, k, u, &at);

            if (c->rows[k].kind > (order ? QDOT_VELOCITY : QDOT_HOLONOMIC))
                continue;
            /* NaN is no value of what the run could follow either */
            if (!(qdot_real_log2(qdot_precise_output(e->held[order], out++)[0]) - terms
                  <= allowed))
                return qdot_fail(QDOT_EDOMAIN, "constraint %s does not hold beyond it",
                                 c->rows[k].name);
        }
    }
    return QDOT_OK;
}

static qdot_status
make_held(qdot_precise_bind *e)
{
    const qdot_constraints *c = e->plan->constraints;
    const qdot_tape *tapes[] = {c->positions, c->velocities};

    for (size_t i = 0; i < 2; i++)
        if (tapes[i] && qdot_tape_outputs(tapes[i]) > 0)
            QDOT_TRY(qdot_precise_new(e->plan->pool, tapes[i], 0, e->system.bits,
                                      &e->held[i]));
    return QDOT_OK;
}

static qdot_status
make_tied(qdot_precise_bind *e)
{
    const qdot_constraints *c = e->plan->constraints;
    const size_t size = e->plan->n + c->m;
    solver *s = e->solvers;
    size_t i, j, at;

    QDOT_TRY(qdot_reals_init(&e->numbers, 2 + size * (size + 2), e->system.bits));
    e->w = e->numbers.at;
    s->lu = e->w + 2;
    s->x = s->lu + size * size;
    s->y = s->x + size;
    s->order = qdot_calloc(size, sizeof *s->order);
    s->scale = qdot_calloc(size, sizeof *s->scale);
    e->widest = qdot_calloc(c->m, sizeof *e->widest);
    s->couplings = qdot_calloc(2 * (c->n_masses + c->n_slopes) + 1, sizeof *s->couplings);
    if (!s->order || !s->scale || !e->widest || !s->couplings)
        return QDOT_ENOMEM;
    for (i = 0; i < e->plan->n; i++)
        e->a[i] = (const mpfr_t *)e->solved.at + i * e->stride;
    for (size_t k = 0; entry(e, k, &i, &j, &at); k++) {
        if (qdot_precise_is_constant(e->tape, at))
            continue;
        s->couplings[s->n_couplings++] = (coupling){i, j, e->outputs[at]};
        if (i != j)
            s->couplings[s->n_couplings++] = (coupling){j, i, e->outputs[at]};
    }
    return make_held(e);
}

/* --- the accelerations --------------------------------------------------------------- */

static qdot_status
factor(qdot_precise_bind *e, size_t b)
{
    const qdot_plan *p = e->plan;
    const qdot_plan_block *block = p->blocks + b;
    solver *s = e->solvers + b;
    size_t failed, at = 0;

    for (size_t i = 0; s->M && i < block->n; i++)
        for (size_t j = 0; j <= i; j++, at++) {
            mpfr_set(s->lu[i * block->n + j], s->M[at][0], MPFR_RNDN);
            mpfr_set(s->lu[j * block->n + i], s->M[at][0], MPFR_RNDN);
        }
    e->factored++;
    if (qdot_real_lu(block->n, s->lu, s->order, s->scale, &failed, e->w) != QDOT_OK)
        return qdot_blocks_singular(p, block, failed);
    return QDOT_OK;
}

/* a_k of every coordinate, orders below k being there. */
static qdot_status
accelerations(qdot_precise_bind *e, int k)
{
    const qdot_plan *p = e->plan;

    if (p->constraints)
        return accelerations_tied(e, k);
    qdot_precise_order(e->tape, k);
    for (size_t b = 0; b < p->structure.blocks; b++) {
        const qdot_plan_block *block = p->blocks + b;
        solver *s = e->solvers + b;

        if (block->n == 1)
            continue;
        if (k == 0 && s->M)
            QDOT_TRY(factor(e, b));
        for (size_t i = 0; i < block->n; i++)
            mpfr_set(s->x[i], s->f[i][k], MPFR_RNDN);
        for (size_t c = 0; k > 0 && c < s->n_couplings; c++) {
            const coupling *m = s->couplings + c;

            qdot_real_dot(e->w[0], m->M + 1, e->a[block->index[m->j]] + k - 1, (size_t)k,
                          e->work);
            mpfr_sub(s->x[m->i], s->x[m->i], e->w[0], MPFR_RNDN);
        }
        qdot_real_solve(block->n, (const mpfr_t *)s->lu, s->order, s->x, s->y, e->w);
        for (size_t i = 0; i < block->n; i++)
            mpfr_set(e->solved.at[block->index[i] * e->stride + (size_t)k], s->x[i],
                     MPFR_RNDN);
    }
    return QDOT_OK;
}

/* Orders k + 1 of velocities and coordinates. */
static void
integrate(qdot_precise_bind *e, int k)
{
    for (size_t i = 0; i < e->plan->n; i++) {
        size_t at = i * e->stride + (size_t)k;

        mpfr_div_ui(e->q[at + 1], e->v[at], (unsigned long)k + 1, MPFR_RNDN);
        mpfr_div_ui(e->v[at + 1], e->a[i][k], (unsigned long)k + 1, MPFR_RNDN);
    }
}

static qdot_status
begin(mpfr_srcptr t, const mpfr_t *y, void *user)
{
    qdot_precise_bind *e = user;
    size_t n = e->plan->n;

    for (size_t i = 0; i < n; i++) {
        mpfr_set(e->q[i * e->stride], y[i], MPFR_RNDN);
        mpfr_set(e->v[i * e->stride], y[n + i], MPFR_RNDN);
    }
    mpfr_set(e->t[0], t, MPFR_RNDN);
    mpfr_set_ui(e->t[1], 1, MPFR_RNDN);
    QDOT_TRY(accelerations(e, 0));
    for (size_t i = 0; i < n; i++)
        if (!mpfr_number_p(e->a[i][0]))
            return qdot_fail(QDOT_EDOMAIN, "the acceleration of %s is undefined",
                             e->plan->names[i]);
    integrate(e, 0);
    return e->plan->constraints ? find_left(e, y) : QDOT_OK;
}

static qdot_status
extend(int p, void *user)
{
    qdot_precise_bind *e = user;

    for (int k = 1; k < p; k++) {
        QDOT_TRY(qdot_interrupt_check()); /* an order may take long */
        QDOT_TRY(accelerations(e, k));
        integrate(e, k);
    }
    return QDOT_OK;
}

/* --- building ------------------------------------------------------------------------ */

static qdot_status
constant_block(qdot_precise_bind *e, size_t b)
{
    const qdot_plan *p = e->plan;
    const qdot_plan_block *block = p->blocks + b;
    solver *s = e->solvers + b;

    for (size_t i = 0; i < block->n; i++)
        for (size_t j = 0; j < block->n; j++)
            QDOT_TRY(qdot_constant_real(p->pool,
                                        p->M[block->index[i] * p->n + block->index[j]],
                                        s->lu[i * block->n + j]));
    return factor(e, b);
}

/* Which entries of M move; *at: the first of its outputs. */
static qdot_status
find_couplings(qdot_precise_bind *e, size_t b, size_t *at)
{
    const size_t n = e->plan->blocks[b].n;
    solver *s = e->solvers + b;

    s->M = e->outputs + *at;
    s->couplings = qdot_calloc(n * n, sizeof *s->couplings);
    if (!s->couplings)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++, ++*at) {
            if (qdot_precise_is_constant(e->tape, *at))
                continue;
            s->couplings[s->n_couplings++] = (coupling){i, j, e->outputs[*at]};
            if (i != j)
                s->couplings[s->n_couplings++] = (coupling){j, i, e->outputs[*at]};
        }
    return QDOT_OK;
}

static qdot_status
make_solvers(qdot_precise_bind *e)
{
    const qdot_plan *p = e->plan;
    size_t at = 0, wanted = 2;
    mpfr_t *next;

    for (size_t b = 0; b < p->structure.blocks; b++)
        if (p->blocks[b].n > 1)
            wanted += p->blocks[b].n * (p->blocks[b].n + 2);
    QDOT_TRY(qdot_reals_init(&e->numbers, wanted, e->system.bits));
    e->w = e->numbers.at;
    next = e->w + 2;
    for (size_t b = 0; b < p->structure.blocks; b++) {
        const qdot_plan_block *block = p->blocks + b;
        solver *s = e->solvers + b;
        size_t n = block->n;

        s->f = e->outputs + at;
        at += n;
        for (size_t i = 0; i < n; i++)
            e->a[block->index[i]] =
                n == 1 ? s->f[0]
                       : (const mpfr_t *)e->solved.at + block->index[i] * e->stride;
        if (n == 1)
            continue;
        s->lu = next;
        s->x = s->lu + n * n;
        s->y = s->x + n;
        next = s->y + n;
        s->order = qdot_calloc(n, sizeof *s->order);
        s->scale = qdot_calloc(n, sizeof *s->scale);
        if (!s->order || !s->scale)
            return QDOT_ENOMEM;
        QDOT_TRY(block->constant ? constant_block(e, b) : find_couplings(e, b, &at));
    }
    return QDOT_OK;
}

/* Orders of forces end two below that of q. */
static double
near(int p, double log2_h, void *user)
{
    return qdot_precise_near(((const qdot_precise_bind *)user)->tape, p - 2, log2_h);
}

static qdot_status
make(qdot_precise_bind *e, int most, mpfr_prec_t bits)
{
    const qdot_plan *p = e->plan;
    const size_t outputs = qdot_tape_outputs(p->tape);
    const size_t m = p->constraints ? p->constraints->m : 0;
    const double rows = 3 * (double)qdot_tape_operations(p->tape) + 4 * (double)p->n;

    if (rows * qdot_reals_size((size_t)most + 1, bits) > most_bytes)
        return qdot_fail(QDOT_ELIMIT,
                         "Taylor series of order %d with %ld bits do not fit into %g GB",
                         most, (long)bits, most_bytes / 1e9);
    QDOT_TRY(qdot_precise_new(p->pool, p->tape, most, bits, &e->tape));
    e->stride = qdot_precise_stride(e->tape);
    e->q = qdot_precise_input(e->tape, 0);
    e->v = qdot_precise_input(e->tape, p->n);
    e->t = qdot_precise_input(e->tape, 2 * p->n);
    e->outputs = qdot_calloc(outputs + 1, sizeof *e->outputs);
    e->a = qdot_calloc(p->n, sizeof *e->a);
    e->solvers = qdot_calloc(p->structure.blocks + 1, sizeof *e->solvers);
    e->work = qdot_calloc(qdot_real_dot_work(bits), sizeof *e->work);
    if (!e->outputs || !e->a || !e->solvers || !e->work)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_reals_init(&e->solved, (p->n + m) * e->stride, bits));
    for (size_t i = 0; i < outputs; i++)
        e->outputs[i] = qdot_precise_output(e->tape, i);
    e->system = (qdot_precise_system){.n = 2 * p->n,
                                      .checked = p->n,
                                      .bits = e->solved.bits,
                                      .most = most,
                                      .x = (const mpfr_t *)e->q,
                                      .stride = e->stride,
                                      .begin = begin,
                                      .extend = extend,
                                      .near = near,
                                      .user = e};
    return p->constraints ? make_tied(e) : make_solvers(e);
}

qdot_status
qdot_precise_bind_new(const qdot_plan *plan, int most, mpfr_prec_t bits,
                      qdot_precise_bind **bind)
{
    qdot_precise_bind *e = qdot_calloc(1, sizeof *e);
    qdot_status status;

    *bind = NULL;
    if (!e)
        return QDOT_ENOMEM;
    e->plan = plan;
    status = make(e, most, bits);
    if (status != QDOT_OK) {
        qdot_precise_bind_free(e);
        return status;
    }
    *bind = e;
    return QDOT_OK;
}

void
qdot_precise_bind_free(qdot_precise_bind *e)
{
    if (!e)
        return;
    for (size_t b = 0; e->solvers && b <= e->plan->structure.blocks; b++) {
        qdot_free(e->solvers[b].order);
        qdot_free(e->solvers[b].scale);
        qdot_free(e->solvers[b].couplings);
    }
    qdot_precise_free(e->tape);
    qdot_precise_free(e->held[0]);
    qdot_precise_free(e->held[1]);
    qdot_reals_clear(&e->solved);
    qdot_reals_clear(&e->numbers);
    qdot_free(e->outputs);
    qdot_free(e->a);
    qdot_free(e->solvers);
    qdot_free(e->work);
    qdot_free(e->widest);
    qdot_free(e);
}

const qdot_precise_system *
qdot_precise_bind_system(const qdot_precise_bind *e)
{
    return &e->system;
}

mpfr_srcptr
qdot_precise_bind_acceleration(const qdot_precise_bind *e, size_t i)
{
    return e->a[i][0];
}

void
qdot_precise_bind_multiplier(const qdot_precise_bind *e, size_t k, mpfr_ptr lambda)
{
    mpfr_neg(lambda, e->solved.at[(e->plan->n + k) * e->stride], MPFR_RNDN);
}

size_t
qdot_precise_bind_factored(const qdot_precise_bind *e)
{
    return e->factored;
}
