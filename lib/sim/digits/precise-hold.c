/* precise-hold.c -- projects states onto the constraints with all requested digits. */
#include "sim/digits/precise-hold.h"

#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "num/real.h"
#include "series/precise.h"
#include "sim/model/constraints.h"

#define RN MPFR_RNDN

enum { MOST_ITERATIONS = 60, SCRATCH = 4 };

struct qdot_precise_hold {
    const qdot_plan *plan;
    mpfr_prec_t bits;
    qdot_precise *metric, *rows[2]; /* programs for M, A; for position, velocity constraints F */
    size_t count[2];                /* number of constraints F in each of the two programs */
    /* The constraints in use (on positions or on velocities), and their unknowns: */
    bool velocities;
    size_t m, kept; /* number of constraints in use; of those that contain a free value */
    size_t *free;   /* [f] indices of the free unknowns */
    size_t f;
    size_t *row;   /* [kept] indices of the constraints that contain a free value */
    size_t *order; /* [n + m] pivot order of the factors */
    double *scale; /* [n + m] scale factors of the rows */
    qdot_reals numbers;
    mpfr_t *x0;                 /* [n] the given values, before the projection */
    mpfr_t *W, *A, *A_moved;    /* weights W [n x n]; A and A at the moved point [m x n] */
    mpfr_t *K, *b, *y, *lambda; /* linear system K [(n + m)^2]; b, y [n + m]; lambda [m] */
    mpfr_t *w;                  /* [SCRATCH] numbers for intermediate results */
};

void
qdot_precise_hold_free(qdot_precise_hold *h)
{
    if (!h)
        return;
    qdot_precise_free(h->metric);
    qdot_precise_free(h->rows[0]);
    qdot_precise_free(h->rows[1]);
    qdot_free(h->free);
    qdot_free(h->row);
    qdot_free(h->order);
    qdot_free(h->scale);
    qdot_reals_clear(&h->numbers);
    qdot_free(h);
}

static qdot_status
allocate_projection(qdot_precise_hold *h)
{
    const qdot_constraints *c = h->plan->constraints;
    const qdot_tape *const tapes[] = {c->positions, c->velocities};
    const size_t n = h->plan->n, m = c->m, all = n + m;
    mpfr_t *at;

    QDOT_TRY(qdot_precise_new(h->plan->pool, c->metric, 0, h->bits, &h->metric));
    for (size_t k = 0; k < 2; k++)
        if (tapes[k] && qdot_tape_outputs(tapes[k]) > 0) {
            QDOT_TRY(qdot_precise_new(h->plan->pool, tapes[k], 0, h->bits, &h->rows[k]));
            h->count[k] = qdot_tape_outputs(tapes[k]);
        }
    h->free = qdot_calloc(n + 1, sizeof *h->free);
    h->row = qdot_calloc(m + 1, sizeof *h->row);
    h->order = qdot_calloc(all + 1, sizeof *h->order);
    h->scale = qdot_calloc(all + 1, sizeof *h->scale);
    if (!h->free || !h->row || !h->order || !h->scale)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_reals_init(
        &h->numbers, n + n * n + 2 * m * n + all * all + 2 * all + m + SCRATCH, h->bits));
    at = h->numbers.at;
    h->x0 = at;
    h->W = h->x0 + n;
    h->A = h->W + n * n;
    h->A_moved = h->A + m * n;
    h->K = h->A_moved + m * n;
    h->b = h->K + all * all;
    h->y = h->b + all;
    h->lambda = h->y + all;
    h->w = h->lambda + m;
    return QDOT_OK;
}

qdot_status
qdot_precise_hold_new(const qdot_plan *plan, mpfr_prec_t bits, qdot_precise_hold **hold)
{
    qdot_precise_hold *h;
    qdot_status status;

    *hold = NULL;
    if (!plan->constraints)
        return QDOT_OK;
    h = qdot_calloc(1, sizeof *h);
    if (!h)
        return QDOT_ENOMEM;
    h->plan = plan;
    h->bits = bits;
    status = allocate_projection(h);
    if (status == QDOT_OK)
        *hold = h;
    else
        qdot_precise_hold_free(h);
    return status;
}

/* --- matrices at a state ------------------------------------------------------------- */

static void
evaluate_program(const qdot_precise_hold *h, qdot_precise *program, mpfr_srcptr t,
                 const mpfr_t *y)
{
    const size_t n = 2 * h->plan->n;

    for (size_t i = 0; i < n; i++)
        mpfr_set(qdot_precise_input(program, i)[0], y[i], RN);
    mpfr_set(qdot_precise_input(program, n)[0], t, RN);
    qdot_precise_order(program, 0);
}

/* Evaluate the mass matrix into W (unless NULL), and the matrix of the constraints in use into A. */
static void
evaluate_matrices(qdot_precise_hold *h, mpfr_srcptr t, const mpfr_t *y, mpfr_t *W, mpfr_t *A)
{
    const qdot_constraints *c = h->plan->constraints;
    const size_t n = h->plan->n;
    size_t at = 0;

    evaluate_program(h, h->metric, t, y);
    for (size_t i = 0; W && i < n * n; i++)
        mpfr_set_si(W[i], 0, RN);
    for (size_t k = 0; W && k < c->n_masses; k++) {
        const size_t i = c->masses[k].row, j = c->masses[k].column;
        const mpfr_t *value = qdot_precise_output(h->metric, k);

        mpfr_set(W[i * n + j], value[0], RN);
        mpfr_set(W[j * n + i], value[0], RN);
        /* move massless coordinates only, with all digits */
        if (i == j && h->plan->massless && h->plan->massless[i])
            mpfr_set_ui_2exp(W[i * n + i], 1, -2 * (mpfr_exp_t)h->bits, RN);
    }
    for (size_t i = 0; i < h->m * n; i++)
        mpfr_set_si(A[i], 0, RN);
    for (size_t r = 0, s = 0; r < c->m; r++) {
        const bool here = h->velocities ? c->rows[r].kind != QDOT_ACCELERATION
                                        : c->rows[r].kind == QDOT_HOLONOMIC;

        for (; s < c->n_slopes && c->slopes[s].row == r; s++)
            if (here)
                mpfr_set(A[at * n + c->slopes[s].column],
                         qdot_precise_output(h->metric, c->n_masses + s)[0], RN);
        at += here;
    }
}

/* Find log2 of the largest violation |F| among the constraints in use. */
static double
log2_largest_violation(const qdot_precise_hold *h)
{
    double log2 = -INFINITY;

    for (size_t k = 0; k < h->kept; k++) {
        const double now =
            qdot_real_log2(qdot_precise_output(h->rows[h->velocities], h->row[k])[0]);

        log2 = isnan(now) ? INFINITY : fmax(log2, now);
    }
    return log2;
}

/* Use only the constraints that contain a free coordinate. */
static void
choose_constraints(qdot_precise_hold *h)
{
    const size_t n = h->plan->n;

    h->kept = 0;
    for (size_t k = 0; k < h->m; k++) {
        bool holds = false;

        for (size_t i = 0; i < h->f; i++)
            holds = holds || !mpfr_zero_p(h->A[k * n + h->free[i]]);
        if (holds)
            h->row[h->kept++] = k;
    }
}

/* Choose the coordinates that may be changed: those whose flag equals `free`; not parameters that
 * events set. */
static void
choose_level_and_unknowns(qdot_precise_hold *h, bool velocities, const bool *flag, bool free)
{
    h->velocities = velocities;
    h->m = h->count[velocities];
    h->f = 0;
    for (size_t i = 0; i < h->plan->n - h->plan->n_states; i++)
        if (flag[i] == free)
            h->free[h->f++] = i;
}

/* --- the linear system --------------------------------------------------------------- */

/* Assemble the matrix K = [W A^T; A 0] for the free coordinates and the constraints in use. */
static void
assemble_matrix(qdot_precise_hold *h)
{
    const size_t n = h->plan->n, f = h->f, all = f + h->kept;

    for (size_t i = 0; i < all * all; i++)
        mpfr_set_si(h->K[i], 0, RN);
    for (size_t i = 0; i < f; i++)
        for (size_t j = 0; j < f; j++)
            mpfr_set(h->K[i * all + j], h->W[h->free[i] * n + h->free[j]], RN);
    for (size_t k = 0; k < h->kept; k++)
        for (size_t i = 0; i < f; i++) {
            const mpfr_t *a = &h->A[h->row[k] * n + h->free[i]];

            mpfr_set(h->K[i * all + f + k], *a, RN);
            mpfr_set(h->K[(f + k) * all + i], *a, RN);
        }
}

/* Solve the linear system K x = b; the solution x replaces b. */
static qdot_status
solve_linear_system(qdot_precise_hold *h)
{
    const size_t all = h->f + h->kept;
    size_t failed;

    QDOT_TRY(qdot_interrupt_check());
    if (qdot_real_lu(all, h->K, h->order, h->scale, &failed, h->w) != QDOT_OK)
        return qdot_fail(QDOT_EDOMAIN, "`digits` cannot bring a state onto constraints that depend "
                                       "on each other");
    qdot_real_solve(all, (const mpfr_t *)h->K, h->order, h->b, h->y, h->w);
    return QDOT_OK;
}

/* Copy the constraint violations as -F into b, after the entries of the free coordinates. */
static void
copy_violations(qdot_precise_hold *h)
{
    for (size_t k = 0; k < h->kept; k++)
        mpfr_neg(h->b[h->f + k],
                 qdot_precise_output(h->rows[h->velocities], h->row[k])[0], RN);
}

/* --- projection after an event ------------------------------------------------------- */

static qdot_status
project_onto_constraints(qdot_precise_hold *h, mpfr_srcptr t, mpfr_t *y)
{
    mpfr_t *x = y + (h->velocities ? h->plan->n : 0);
    double before = INFINITY;

    for (int k = 0; k < MOST_ITERATIONS; k++) {
        double now;

        evaluate_matrices(h, t, (const mpfr_t *)y, h->W, h->A);
        choose_constraints(h);
        evaluate_program(h, h->rows[h->velocities], t, (const mpfr_t *)y);
        now = log2_largest_violation(h);
        if (now <= 16 - (double)h->bits ||
            (now < 48 - (double)h->bits && now >= before - 1))
            return QDOT_OK;
        if (h->kept == 0 || now == INFINITY || (k > 8 && now >= before))
            break;
        before = now;
        assemble_matrix(h);
        for (size_t i = 0; i < h->f; i++)
            mpfr_set_si(h->b[i], 0, RN);
        copy_violations(h);
        QDOT_TRY(solve_linear_system(h));
        for (size_t i = 0; i < h->f; i++)
            mpfr_add(x[h->free[i]], x[h->free[i]], h->b[i], RN);
    }
    return qdot_fail(QDOT_EDOMAIN,
                     "an event sets values that the constraints do not allow");
}

qdot_status
qdot_precise_hold_put(qdot_precise_hold *h, mpfr_srcptr t, mpfr_t *y, const bool *q_set,
                      const bool *v_set)
{
    const bool *const set[] = {q_set, v_set};

    for (size_t k = 0; k < 2; k++) {
        if (!set[k] || !h->rows[k])
            continue;
        choose_level_and_unknowns(h, k == 1, set[k], false);
        QDOT_TRY(project_onto_constraints(h, t, y));
    }
    return QDOT_OK;
}

/* --- projection of a start ----------------------------------------------------------- */

/* Add sum_k lambda_k d(A_k)/dx, the constraints' curvature, by finite differences, to the upper left of K. */
static void
add_constraint_curvature(qdot_precise_hold *h, mpfr_srcptr t, mpfr_t *y)
{
    const size_t n = h->plan->n, all = h->f + h->kept;
    mpfr_t *x = y + (h->velocities ? n : 0);

    for (size_t j = 0; j < h->f; j++) {
        mpfr_ptr old = h->w[2], step = h->w[3], sum = h->w[0];

        mpfr_set(old, x[h->free[j]], RN);
        mpfr_set_si_2exp(step, 1, -(mpfr_exp_t)(h->bits / 2), RN);
        mpfr_add(x[h->free[j]], old, step, RN);
        mpfr_sub(step, x[h->free[j]], old, RN);
        evaluate_matrices(h, t, (const mpfr_t *)y, NULL, h->A_moved);
        mpfr_set(x[h->free[j]], old, RN);
        for (size_t i = 0; i < h->f; i++) {
            mpfr_set_si(sum, 0, RN);
            for (size_t k = 0; k < h->kept; k++) {
                const size_t at = h->row[k] * n + h->free[i];

                mpfr_sub(h->w[1], h->A_moved[at], h->A[at], RN);
                mpfr_mul(h->w[1], h->w[1], h->lambda[k], RN);
                mpfr_add(sum, sum, h->w[1], RN);
            }
            mpfr_div(sum, sum, step, RN);
            mpfr_add(h->K[i * all + j], h->K[i * all + j], sum, RN);
        }
    }
}

/* Compute the right-hand side b = -(W (x - a) + A^T lambda) for the free values (a: the given values). */
static void
compute_gradient(qdot_precise_hold *h, const mpfr_t *x)
{
    const size_t n = h->plan->n;

    for (size_t i = 0; i < h->f; i++) {
        mpfr_ptr b = h->b[i], term = h->w[1];

        mpfr_set_si(b, 0, RN);
        for (size_t j = 0; j < h->f; j++) {
            mpfr_sub(term, h->x0[h->free[j]], x[h->free[j]], RN);
            mpfr_mul(term, term, h->W[h->free[i] * n + h->free[j]], RN);
            mpfr_add(b, b, term, RN);
        }
        for (size_t k = 0; k < h->kept; k++) {
            mpfr_mul(term, h->lambda[k], h->A[h->row[k] * n + h->free[i]], RN);
            mpfr_sub(b, b, term, RN);
        }
    }
}

/* Make one Newton step towards the nearest state on the constraints; *moved: log2 of its length. */
static qdot_status
make_newton_step(qdot_precise_hold *h, mpfr_srcptr t, mpfr_t *y, double *moved)
{
    mpfr_t *x = y + (h->velocities ? h->plan->n : 0);

    evaluate_matrices(h, t, (const mpfr_t *)y, NULL, h->A);
    choose_constraints(h);
    assemble_matrix(h);
    evaluate_program(h, h->rows[h->velocities], t, (const mpfr_t *)y);
    copy_violations(h);
    compute_gradient(h, (const mpfr_t *)x);
    add_constraint_curvature(h, t, y);
    QDOT_TRY(solve_linear_system(h));
    *moved = -INFINITY;
    for (size_t i = 0; i < h->f; i++) {
        const double log2 = qdot_real_log2(h->b[i]);

        mpfr_add(x[h->free[i]], x[h->free[i]], h->b[i], RN);
        *moved = isnan(log2) ? INFINITY : fmax(*moved, log2);
    }
    for (size_t k = 0; k < h->kept; k++)
        mpfr_add(h->lambda[k], h->lambda[k], h->b[h->f + k], RN);
    return QDOT_OK;
}

qdot_status
qdot_precise_hold_nearest(qdot_precise_hold *h, mpfr_srcptr t, mpfr_t *y, bool velocities,
                          const bool *free, bool massive, const double *near)
{
    const size_t n = h->plan->n;
    mpfr_t *x = y + (velocities ? n : 0);
    double before = INFINITY;
    qdot_status status = QDOT_OK;

    if (!h->rows[velocities])
        return QDOT_OK;
    choose_level_and_unknowns(h, velocities, free, true);
    evaluate_matrices(h, t, (const mpfr_t *)y, h->W, h->A);
    for (size_t i = 0; !massive && i < n * n; i++)
        mpfr_set_si(h->W[i], i % (n + 1) == 0, RN);
    for (size_t i = 0; i < n; i++)
        mpfr_set(h->x0[i], x[i], RN);
    for (size_t i = 0; i < h->f; i++)
        mpfr_set_d(x[h->free[i]], near[h->free[i]], RN);
    for (size_t k = 0; k < h->m; k++)
        mpfr_set_si(h->lambda[k], 0, RN);
    for (int k = 0; k < MOST_ITERATIONS; k++) {
        double moved;

        status = make_newton_step(h, t, y, &moved);
        if (status != QDOT_OK)
            break;
        if (moved <= 24 - (double)h->bits ||
            (moved < 64 - (double)h->bits && moved >= before - 1))
            return QDOT_OK;
        if (moved == INFINITY || (k > 12 && moved >= before))
            break;
        before = moved;
    }
    for (size_t i = 0; i < n; i++)
        mpfr_set(x[i], h->x0[i], RN);
    return status == QDOT_OK ? qdot_fail(QDOT_EDOMAIN, "not found") : status;
}
