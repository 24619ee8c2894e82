/* precise-start.c -- solves the constraints of a start state by Newton's method with residuals in MPFR. */
#include "sim/digits/precise-start.h"

#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "num/real.h"
#include "num/row-space.h"
#include "sim/model/constraints.h"
#include "series/precise.h"

#define RN MPFR_RNDN

/* A constraint is independent if this fraction, at least, of its gradient is orthogonal to the other gradients. */
static const double dependent = 1e-9;

/* The constraint equations for the positions, or for the velocities, of a start state. */
typedef struct {
    const qdot_plan *plan;
    const double *y;   /* [2n] the start in doubles */
    const bool *named; /* [n] the user gave this value; NULL: all were given */
    bool velocities;
    mpfr_t *start;  /* [2 + 2n] t0, t1 and the start state with all digits */
    mpfr_t *x;      /* [n] the part of the start state that is changed: positions or velocities */
    size_t m;       /* number of equations */
    qdot_precise *program;
    double *A, *b, *dx, *work; /* scratch: A [m x n], b [m], dx [n] */
    qdot_row_space space;
} level;

/* Find log2 of the largest residual of the constraint equations at the start. */
static double
find_residual(level *l)
{
    const size_t n = 2 * l->plan->n;
    double log2 = -INFINITY;

    for (size_t i = 0; i < n; i++)
        mpfr_set(qdot_precise_input(l->program, i)[0], l->start[2 + i], RN);
    mpfr_set(qdot_precise_input(l->program, n)[0], l->start[0], RN);
    qdot_precise_order(l->program, 0);
    for (size_t k = 0; k < l->m; k++) {
        const double now = qdot_real_log2(qdot_precise_output(l->program, k)[0]);

        log2 = isnan(now) ? INFINITY : fmax(log2, now);
    }
    return log2;
}

/* Find the derivatives of the equations by the free values at y; returns whether they determine
 * these values. */
static bool
evaluate_jacobian(level *l, double *in, double *out)
{
    const qdot_constraints *c = l->plan->constraints;
    const size_t n = l->plan->n;
    size_t at = 0, unknown = 0;

    memcpy(in, l->y, 2 * n * sizeof *in);
    in[2 * n] = mpfr_get_d(l->start[0], RN);
    qdot_tape_eval(c->metric, in, out, l->work);
    for (size_t r = 0, s = 0; r < c->m; r++) {
        const bool here = l->velocities ? c->rows[r].kind != QDOT_ACCELERATION
                                        : c->rows[r].kind == QDOT_HOLONOMIC;

        for (; s < c->n_slopes && c->slopes[s].row == r; s++)
            if (here && !l->named[c->slopes[s].column])
                l->A[at * n + c->slopes[s].column] = out[c->n_masses + s];
        at += here;
    }
    for (size_t i = 0; i < n; i++) {
        bool stands = false;

        for (size_t k = 0; k < l->m; k++)
            stands = stands || l->A[k * n + i] != 0;
        if (stands)
            mpfr_set_d(l->x[i], l->y[l->velocities * n + i], RN);
        unknown += stands;
    }
    qdot_row_space_factor(&l->space, l->A, dependent, false);
    return l->space.rank == unknown;
}

/* Iterate Newton's method from the values in doubles while it converges, until the residual is at
 * most 2^-bits. */
static qdot_status
iterate(level *l, mpfr_prec_t bits)
{
    double before = INFINITY;

    for (double now = find_residual(l); now < before - 4 && now > -(double)bits; now = find_residual(l)) {
        const mpfr_exp_t scale = (mpfr_exp_t)floor(now); /* scale residuals by 2^-now: doubles end at 2^-1074 */

        QDOT_TRY(qdot_interrupt_check());
        for (size_t k = 0; k < l->m; k++) {
            mpfr_exp_t e;
            const double part = mpfr_get_d_2exp(&e, qdot_precise_output(l->program, k)[0], RN);

            l->b[k] = -ldexp(part, (int)fmax(-2000, (double)(e - scale)));
        }
        qdot_row_space_shortest(&l->space, l->b, l->dx, NULL);
        for (size_t i = 0; i < l->plan->n; i++) {
            mpfr_t step;

            if (l->named[i]) /* keep what the user gave: its part of dx is only rounding */
                continue;
            mpfr_init2(step, 64);
            mpfr_set_d(step, l->dx[i], RN);
            mpfr_mul_2si(step, step, scale, RN);
            mpfr_add(l->x[i], l->x[i], step, RN);
            mpfr_clear(step);
        }
        before = now;
    }
    return QDOT_OK;
}

static qdot_status
solve_constraints(level *l, const qdot_tape *tape, double enough, mpfr_prec_t bits)
{
    const qdot_tape *metric = l->plan->constraints->metric;
    const size_t n = l->plan->n, outputs = qdot_tape_outputs(metric);
    double *in;
    qdot_status status;

    l->m = qdot_tape_outputs(tape);
    in = qdot_calloc(2 * n + 1 + outputs + qdot_tape_work(metric) + l->m * n + l->m + n + 1,
                     sizeof *in);
    status = in ? qdot_row_space_init(&l->space, l->m, n) : QDOT_ENOMEM;
    if (status == QDOT_OK)
        status = qdot_precise_new(l->plan->pool, tape, 0, bits, &l->program);
    if (status == QDOT_OK && find_residual(l) > enough) {
        l->A = in + 2 * n + 1 + outputs;
        l->b = l->A + l->m * n;
        l->dx = l->b + l->m;
        l->work = l->dx + n;
        if (evaluate_jacobian(l, in, in + 2 * n + 1))
            status = iterate(l, bits);
    }
    qdot_precise_free(l->program);
    qdot_row_space_clear(&l->space);
    qdot_free(in);
    return status;
}

qdot_status
qdot_precise_start_solve(const qdot_plan *plan, const qdot_run_request *request,
                         const double *y, double enough, mpfr_prec_t bits, mpfr_t *start)
{
    const bool *const named[] = {request->q_named, request->v_named};
    const qdot_constraints *c = plan->constraints;
    const qdot_tape *const tapes[] = {c->positions, c->velocities};

    for (size_t k = 0; k < 2; k++) {
        level l = {.plan = plan,
                   .y = y,
                   .named = named[k],
                   .velocities = k == 1,
                   .start = start,
                   .x = start + 2 + k * plan->n};

        if (tapes[k] && qdot_tape_outputs(tapes[k]) > 0 && named[k])
            QDOT_TRY(solve_constraints(&l, tapes[k], enough, bits));
    }
    return QDOT_OK;
}
