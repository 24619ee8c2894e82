/* precise-bind.c -- expands the motion in Taylor series of MPFR numbers, order by order. */
#include "sim/form/precise-bind.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "series/precise.h"
#include "sim/form/blocks.h"
#include "sim/form/canonical.h"
#include "sim/form/motion-of-equations.h"
#include "sim/form/motion-of-residual.h"
#include "sim/model/constrained.h"
#include "sim/model/constraints.h"

static const double most_bytes = 2e9;

/* A block of unknowns that are coupled by the matrix K. */
typedef struct {
    size_t first, n;
    mpfr_t *lu;    /* [n x n] LU factors of the block's matrix K */
    mpfr_t *x, *y; /* [n] right-hand side, solution */
    size_t *order; /* [n] pivot order of the rows */
    double *scale; /* [n] scale factors of the rows */
} solver;

struct qdot_precise_bind {
    const qdot_plan *plan;
    qdot_motion own;
    const qdot_motion *motion; /* series program of the equations of motion, or of Hamilton's equations */
    qdot_precise *series;
    qdot_precise *momenta; /* with Hamilton's equations: program for the momenta from q, q', t */
    int late;              /* 1: stage k of the series gives velocities of order k; 0: of order k + 1 */
    qdot_precise_system system;
    mpfr_t *q, *v, *t; /* Taylor coefficients of the inputs; rows are `stride` apart */
    size_t stride;
    solver *solvers; /* [blocks] a solver for each block of K */
    size_t blocks;
    bool fixed;         /* K is constant */
    bool is_factored;   /* K is constant and has been factored */
    qdot_reals numbers; /* memory of 2 scratch numbers, `by` [solved], and the arrays of the solvers */
    mpfr_t *w, *by;
    double *widest; /* [constraints] largest squared norm of each constraint's gradient so far */
    qdot_precise *held[2]; /* residuals of position and of velocity constraints; NULL: no such constraints */
    size_t factored;
};

/* --- constraints in MPFR ------------------------------------------------------------- */

/* The k-th stored element of the constraint matrix A, read from an output of the plan's tape. */
static const mpfr_t *
constraint_matrix_element(const qdot_precise_bind *e, size_t k)
{
    return qdot_precise_output(e->series, e->plan->n + e->plan->constraints->n_masses + k);
}

/* A row that has shrunk far below the largest that it was has no direction left that the error
 * of the run did not make, of whose size it is when a velocity in it is its root. */
static qdot_status
check_for_vanishing_gradient(qdot_precise_bind *e)
{
    const qdot_constraints *c = e->plan->constraints;
    const double faded = ldexp(1, -(int)e->system.bits / 2);
    size_t s = 0;

    for (size_t k = 0; k < c->m; k++) {
        double sum = 0;

        for (; s < c->n_slopes && c->slopes[s].row == k; s++) {
            const double x =
                mpfr_get_d(constraint_matrix_element(e, s)[0], MPFR_RNDN);

            sum += x * x;
        }
        if (sum > e->widest[k])
            e->widest[k] = sum;
        else if (sum < faded * e->widest[k])
            return qdot_constrained_without_direction(c, k);
    }
    return QDOT_OK;
}

/* log2 of the largest |A_ki u_i|, or of 1; u: a row of inputs. *at: the first of the slopes of
 * row k, then that of the next row. */
static double
log2_largest_term(const qdot_precise_bind *e, size_t k, const mpfr_t *u, size_t *at)
{
    const qdot_constraints *c = e->plan->constraints;
    double most = 0;

    for (; *at < c->n_slopes && c->slopes[*at].row == k; ++*at)
        most = fmax(most,
                    qdot_real_log2(constraint_matrix_element(e, *at)[0])
                        + qdot_real_log2(u[c->slopes[*at].column * e->stride]));
    return most;
}

/* Nothing is projected, and what drifts is of the last digits: where constraints are off by more than
 * a quarter of them can tell, a step has passed a place behind which q'' = ... is not what they say,
 * as y = sqrt(x) is left at y = 0. */
static qdot_status
check_residuals(qdot_precise_bind *e, const mpfr_t *y)
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
            const double terms = log2_largest_term(e, k, u, &at);

            if (c->rows[k].kind > (order ? QDOT_VELOCITY : QDOT_HOLONOMIC))
                continue;
            /* this form of the test also rejects a NaN */
            if (!(qdot_real_log2(qdot_precise_output(e->held[order], out++)[0]) - terms
                  <= allowed))
                return qdot_fail(QDOT_EDOMAIN, "constraint %s does not hold beyond it",
                                 c->rows[k].name);
        }
    }
    return QDOT_OK;
}

static qdot_status
make_residual_programs(qdot_precise_bind *e)
{
    const qdot_constraints *c = e->plan->constraints;
    const qdot_tape *tapes[] = {c->positions, c->velocities};

    for (size_t i = 0; i < 2; i++)
        if (tapes[i] && qdot_tape_outputs(tapes[i]) > 0)
            QDOT_TRY(qdot_precise_new(e->plan->pool, tapes[i], 0, e->system.bits,
                                      &e->held[i]));
    return QDOT_OK;
}

/* --- accelerations order by order ---------------------------------------------------- */

/* Read the matrix K of a block from its entries, or column by column from the program. */
static void
copy_matrix(const qdot_precise_bind *e, const solver *s)
{
    const qdot_motion *m = e->motion;

    for (size_t j = 0; j < s->n && m->entries.n == 0; j++)
        qdot_precise_column(e->series, s->first, s->n, j, s->lu + j);
    for (size_t i = 0; i < s->n * s->n && m->entries.n > 0; i++)
        mpfr_set_zero(s->lu[i], 1);
    for (size_t k = 0; k < m->entries.n; k++) {
        const qdot_motion_entry *x = m->entries.at + k;
        /* the difference wraps around and exceeds n if the index lies before the block */
        const size_t i = x->i - s->first, j = x->j - s->first;
        const mpfr_t *value = qdot_precise_row(e->series, x->at);

        if (i >= s->n || j >= s->n)
            continue;
        mpfr_set(s->lu[i * s->n + j], value[0], MPFR_RNDN);
        mpfr_set(s->lu[j * s->n + i], value[0], MPFR_RNDN);
    }
}

/* Report that the matrix K of a block is singular, and the coordinate in whose row that shows. */
static qdot_status
report_singular(const qdot_precise_bind *e, const solver *s, size_t failed)
{
    const qdot_plan *p = e->plan;
    const size_t at = e->motion->unknowns.at[e->motion->solved.at[s->first + failed]].twice;
    const qdot_plan_block one = {.n = 1, .index = &at};

    if (p->constraints)
        return qdot_fail(QDOT_ESINGULAR, "the constraints are not independent, or no mass "
                                         "moves along them: `digits` wants that");
    return qdot_blocks_singular(p, &one, 0);
}

static qdot_status
factor_matrices(qdot_precise_bind *e)
{
    if (e->fixed && e->is_factored)
        return QDOT_OK;
    if (e->plan->constraints)
        QDOT_TRY(check_for_vanishing_gradient(e));
    for (size_t b = 0; b < e->blocks; b++) {
        solver *s = e->solvers + b;
        size_t failed;

        copy_matrix(e, s);
        e->factored++;
        if (qdot_real_lu(s->n, s->lu, s->order, s->scale, &failed, e->w) != QDOT_OK)
            return report_singular(e, s, failed);
    }
    e->is_factored = true;
    return QDOT_OK;
}

/* Compute the accelerations of order k from the lower orders, then integrate them to velocities and coordinates. */
static qdot_status
compute_accelerations_order(qdot_precise_bind *e, int k)
{
    qdot_precise_stage(e->series, k);
    if (k < 0)
        return QDOT_OK;
    if (k == 0)
        QDOT_TRY(factor_matrices(e));
    for (size_t b = 0; b < e->blocks; b++) {
        solver *s = e->solvers + b;

        for (size_t i = 0; i < s->n; i++)
            mpfr_neg(s->x[i],
                     qdot_precise_row(e->series, e->motion->equations.at[s->first + i])[k],
                     MPFR_RNDN);
        qdot_real_solve(s->n, (const mpfr_t *)s->lu, s->order, s->x, s->y, e->w);
        for (size_t i = 0; i < s->n; i++)
            mpfr_set(e->by[s->first + i], s->x[i], MPFR_RNDN);
    }
    qdot_precise_change(e->series, k, (const mpfr_t *)e->by);
    return QDOT_OK;
}

/* Compute the canonical momenta of the state that was put into the inputs. */
static void
find_momenta(qdot_precise_bind *e)
{
    const size_t n = e->plan->n;

    for (size_t i = 0; i < 2 * n + 1; i++)
        mpfr_set(qdot_precise_input(e->momenta, i)[0], e->q[i * e->stride], MPFR_RNDN);
    qdot_precise_order(e->momenta, 0);
    for (size_t i = 0; i < n; i++)
        mpfr_set(qdot_precise_input(e->series, 2 * n + 1 + i)[0],
                 qdot_precise_output(e->momenta, i)[0], MPFR_RNDN);
}

static qdot_status
begin_precise_series(mpfr_srcptr t, const mpfr_t *y, void *user)
{
    qdot_precise_bind *e = user;
    size_t n = e->plan->n;

    for (size_t i = 0; i < n; i++) {
        mpfr_set(e->q[i * e->stride], y[i], MPFR_RNDN);
        mpfr_set(e->q[i * e->stride + 1], y[n + i], MPFR_RNDN);
        mpfr_set(e->v[i * e->stride], y[n + i], MPFR_RNDN);
    }
    mpfr_set(e->t[0], t, MPFR_RNDN);
    mpfr_set_ui(e->t[1], 1, MPFR_RNDN);
    if (e->momenta)
        find_momenta(e);
    for (int k = qdot_motion_first(e->motion); k <= e->late; k++)
        QDOT_TRY(compute_accelerations_order(e, k));
    for (size_t i = 0; i < n; i++)
        if (!mpfr_number_p(qdot_precise_bind_acceleration(e, i)))
            return qdot_fail(QDOT_EDOMAIN, "the acceleration of %s is undefined",
                             e->plan->names[i]);
    return e->plan->constraints ? check_residuals(e, y) : QDOT_OK;
}

static qdot_status
extend_precise_series(int p, void *user)
{
    qdot_precise_bind *e = user;

    for (int k = 1 + e->late; k < p + e->late; k++) {
        QDOT_TRY(qdot_interrupt_check()); /* check here, too: one order may take long */
        QDOT_TRY(compute_accelerations_order(e, k));
    }
    return QDOT_OK;
}

/* --- making the bind ----------------------------------------------------------------- */

static qdot_status
make_solvers(qdot_precise_bind *e)
{
    const qdot_motion *m = e->motion;
    size_t wanted = 2 + m->solved.n;
    mpfr_t *next;

    e->blocks = m->blocks.n > 0 ? m->blocks.n - 1 : 0;
    e->solvers = qdot_calloc(e->blocks + 1, sizeof *e->solvers);
    if (!e->solvers)
        return QDOT_ENOMEM;
    for (size_t b = 0; b < e->blocks; b++) {
        const size_t n = m->blocks.at[b + 1] - m->blocks.at[b];

        e->solvers[b] = (solver){.first = m->blocks.at[b], .n = n};
        wanted += n * (n + 2);
    }
    QDOT_TRY(qdot_reals_init(&e->numbers, wanted, e->system.bits));
    e->w = e->numbers.at;
    e->by = e->w + 2;
    next = e->by + m->solved.n;
    e->fixed = m->entries.n > 0;
    for (size_t k = 0; k < m->entries.n; k++)
        e->fixed = e->fixed && m->program.rows.at[m->entries.at[k].at].still;
    for (size_t b = 0; b < e->blocks; b++) {
        solver *s = e->solvers + b;

        s->lu = next;
        s->x = s->lu + s->n * s->n;
        s->y = s->x + s->n;
        next = s->y + s->n;
        s->order = qdot_calloc(s->n, sizeof *s->order);
        s->scale = qdot_calloc(s->n, sizeof *s->scale);
        if (!s->order || !s->scale)
            return QDOT_ENOMEM;
    }
    return QDOT_OK;
}

/* Find a step so short that the last terms are negligible (log2 of it); forces have two orders less than q. */
static double
find_log2_of_step(int p, double log2_h, void *user)
{
    return qdot_precise_near(((const qdot_precise_bind *)user)->series, p - 2, log2_h);
}

static qdot_status
make_precise_series(qdot_precise_bind *e, int most, mpfr_prec_t bits)
{
    const qdot_plan *p = e->plan;

    QDOT_TRY(p->canonical
                 ? qdot_precise_new(p->pool, p->canonical->momenta, 0, bits, &e->momenta)
             : p->residual || p->motion ? QDOT_OK
                                        : qdot_motion_of_equations(p, &e->own));
    e->late = p->canonical != NULL;
    e->motion = p->canonical ? &p->canonical->motion
                : p->residual ? &p->residual->motion
                : p->motion   ? p->motion
                              : &e->own;
    if ((double)e->motion->program.rows.n * qdot_reals_size((size_t)most + 3, bits) > most_bytes)
        return qdot_fail(QDOT_ELIMIT,
                         "Taylor series of order %d with %" PRId64 " bits do not fit into %g GB",
                         most, (int64_t)bits, most_bytes / 1e9);
    QDOT_TRY(qdot_precise_of_motion(p->pool, e->motion, most, bits, &e->series));
    e->stride = qdot_precise_stride(e->series);
    e->q = qdot_precise_input(e->series, 0);
    e->v = qdot_precise_input(e->series, p->n);
    e->t = qdot_precise_input(e->series, 2 * p->n);
    e->system = (qdot_precise_system){.n = 2 * p->n,
                                      .checked = p->n,
                                      .bits = mpfr_get_prec(e->t[0]),
                                      .most = most,
                                      .x = (const mpfr_t *)e->q,
                                      .stride = e->stride,
                                      .begin = begin_precise_series,
                                      .extend = extend_precise_series,
                                      .near = find_log2_of_step,
                                      .user = e};
    QDOT_TRY(make_solvers(e));
    if (!p->constraints)
        return QDOT_OK;
    e->widest = qdot_calloc(p->constraints->m, sizeof *e->widest);
    return e->widest ? make_residual_programs(e) : QDOT_ENOMEM;
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
    status = make_precise_series(e, most, bits);
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
    for (size_t b = 0; e->solvers && b < e->blocks; b++) {
        qdot_free(e->solvers[b].order);
        qdot_free(e->solvers[b].scale);
    }
    qdot_precise_free(e->series);
    qdot_precise_free(e->held[0]);
    qdot_precise_free(e->held[1]);
    qdot_precise_free(e->momenta);
    qdot_motion_clear(&e->own);
    qdot_reals_clear(&e->numbers);
    qdot_free(e->solvers);
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
    return e->v[i * e->stride + 1];
}

void
qdot_precise_bind_multiplier(const qdot_precise_bind *e, size_t k, mpfr_ptr lambda)
{
    const qdot_motion_unknown *u = e->motion->unknowns.at + e->plan->n + k;

    mpfr_neg(lambda, qdot_precise_row(e->series, u->row)[0], MPFR_RNDN);
}

size_t
qdot_precise_bind_factored(const qdot_precise_bind *e)
{
    return e->factored;
}
