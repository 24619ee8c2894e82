/* variational.c -- the variational integrator of order 10, also under holonomic constraints.
 *
 * A path of degree s - 1 over the step makes the sum of Lagrange's function over Lobatto's places,
 *
 *     h sum_i b_i L(t_i, X_i, W_i),
 *
 * stationary under g(t_i, X_i) = 0. As equations that is the pair of Lobatto's methods IIIA and IIIB,
 * for s = 2 RATTLE:
 *
 *     X_i = q + h sum_j a_ij W_j,    P_i = p + h sum_j ab_ij G_j,    ab_ij = b_j (1 - a_ji/b_i)
 *     W_i = v(t_i, X_i, P_i),        G_j = F(t_j, X_j, W_j) + A(X_j)^T lambda_j
 *     0 = g(t_i, X_i),  i = 2 .. s:                lambda_1 .. lambda_(s-1), as ab_is = 0
 *     q <- X_s,   p <- p + h sum_j b_j G_j,   0 = dg/dt there:          lambda_s
 *
 * Both constraints so hold up to rounding at every end. The multipliers are corrected, in each round
 * of the iteration, by
 *
 *     lambda_k -= sum_i (C^-1)_ki S^-1 g_i / h^2,   C_ik = sum_j a_ij ab_jk,   S = A M^-1 A^T at q,
 *
 * Newton's method but for terms of order h, and X_i by -M^-1 A^T S^-1 g_i before F and A are taken there.
 *
 * Order. Of s = 3 ... 7, six places took least evaluations for errors below 1e-8 and a fifth more than
 * the best at 1e-5; 17 steps of RATTLE composed to order 8 took twice as many at 1e-8 and 2.7 times at
 * 1e-10 (doc/methods.md).
 *
 * Source  Hairer, Lubich & Wanner, Geometric Numerical Integration, VI.6.2 (thm. 6.4), VII.1.3, VII.1.4;
 *         L. O. Jay, SIAM J. Numer. Anal. 33 (1996) 368.
 */
#include <string.h>

#include "num/lu.h"
#include "ode/geometric/stages.h"

/* The number of nodes; how many times changes may fail to decrease, as multipliers and positions
 * correct each other. */
enum { stages = 6, patience = 2 };

/* Work space of the method, which follows that of stages.h; m is the number of constraints. */
typedef struct {
    qdot_stages at;
    size_t m;
    double *ab;          /* [2 x s x s] the method's coefficients as pairs of doubles; the last column is 0 */
    double *inverse;     /* [(s-1) x (s-1)] inverse of the weight matrix C */
    double *beyond; /* [(s-1) x (s-1)] extrapolation from the first s - 1 nodes to those of the next step, as `ahead` */
    double *G;           /* [s x n] generalized forces at the nodes */
    double *lambda, *nu; /* [(s-1) x m] Lagrange multipliers at the nodes; their corrections */
    double *g, *sum;     /* [m] constraint values; [n] a sum of vectors */
} step_state;

static step_state
work_space_of(const qdot_geometric *g)
{
    const size_t s = stages, r = s - 1;
    step_state w = {.at = qdot_stages_of(g),
                    .m = g->system->bonds ? g->system->bonds->m : 0};

    w.ab = w.at.rest;
    w.inverse = w.ab + 2 * s * s;
    w.beyond = w.inverse + r * r;
    w.G = w.beyond + r * r;
    w.lambda = w.G + s * g->n;
    w.nu = w.lambda + r * w.m;
    w.g = w.nu + r * w.m;
    w.sum = w.g + w.m;
    return w;
}

/* Find the inverse of the matrix C of weights of the method, column by column. */
static void
invert_weight_matrix(const step_state *w)
{
    enum { r = stages - 1 };
    double C[r * r], column[r];
    qdot_lu_row rows[r];

    for (size_t i = 0; i < r; i++)
        for (size_t k = 0; k < r; k++) {
            C[i * r + k] = 0;
            for (size_t j = 0; j < stages; j++)
                C[i * r + k] += w->at.a[(i + 1) * stages + j] * w->ab[j * stages + k];
        }
    (void)qdot_lu_factor(r, C, rows); /* C is never singular */
    for (size_t k = 0; k < r; k++) {
        for (size_t i = 0; i < r; i++)
            column[i] = i == k;
        qdot_lu_solve(r, C, rows, column);
        for (size_t i = 0; i < r; i++)
            w->inverse[i * r + k] = column[i];
    }
}

static void
begin_variational(qdot_geometric *g)
{
    const size_t s = stages, r = s - 1;
    const step_state w = work_space_of(g);
    qdot_collocation m;

    qdot_collocation_lobatto(stages, &m);
    qdot_stages_begin(&w.at, &m);
    for (size_t i = 0; i < s; i++)
        for (size_t j = 0; j < r; j++) {
            const qdot_two part = qdot_two_div(m.a[j][i], m.b[i]);
            const qdot_two ab =
                qdot_two_mul(m.b[j], qdot_two_sub((qdot_two){1, 0}, part));

            w.ab[i * s + j] = ab.hi;
            w.ab[s * s + i * s + j] = ab.lo;
        }
    for (size_t i = 0; i < r; i++)
        for (size_t j = 0; j < r; j++) {
            double x = 1;

            for (size_t k = 0; k < r; k++)
                x *= k == j ? 1 : (1 + w.at.c[i] - w.at.c[k]) / (w.at.c[j] - w.at.c[k]);
            w.beyond[i * r + j] = x;
        }
    invert_weight_matrix(&w);
}

/* Add the reactions of the constraints, A^T lambda, to the forces F at stage i. */
static qdot_status
add_reactions_at_stage(const qdot_geometric *g, const step_state *w, double t, size_t i,
                       const double *lambda, double *F)
{
    const qdot_ode_bonds *bonds = g->system->bonds;

    return w->m ? bonds->pull(t, w->at.X + i * w->at.n, lambda, F, bonds->user) : QDOT_OK;
}

/* Correct the multipliers by the constraint residuals at stages 2 ... s, and move these stages onto the constraints. */
static qdot_status
correct(const qdot_geometric *g, const step_state *w, double t, double h)
{
    const qdot_ode_bonds *bonds = g->system->bonds;
    const size_t r = stages - 1, m = w->m;

    for (size_t i = 0; i < r; i++) {
        double *X = w->at.X + (i + 1) * w->at.n;

        QDOT_TRY(bonds->positions(t + w->at.c[i + 1] * h, X, w->g, bonds->user));
        bonds->solve(w->g, w->nu + i * m, w->sum, bonds->user);
        for (size_t k = 0; k < w->at.n; k++)
            X[k] -= w->sum[k];
    }
    for (size_t k = 0; k < r; k++)
        for (size_t i = 0; i < r; i++) {
            const double part = w->inverse[k * r + i] / (h * h);

            for (size_t l = 0; l < m; l++)
                w->lambda[k * m + l] -= part * w->nu[i * m + l];
        }
    return QDOT_OK;
}

/* Compute the total forces G [s - 1] at the nodes, including the reactions of constraints. */
static qdot_status
add_constraint_forces(const qdot_geometric *g, const step_state *w, double t, double h)
{
    const size_t n = w->at.n;

    memcpy(w->G, w->at.F, (stages - 1) * n * sizeof *w->G);
    for (size_t i = 0; i + 1 < stages; i++)
        QDOT_TRY(add_reactions_at_stage(g, w, t + w->at.c[i] * h, i, w->lambda + i * w->m, w->G + i * n));
    return QDOT_OK;
}

/* Iterate once for the stages: update P, W, X, the multipliers lambda, and the forces F, G. */
static qdot_status
iterate_variational_stages(qdot_geometric *g, const qdot_stages *at, double t, double h, double *change)
{
    const step_state w = work_space_of(g);
    const size_t n = at->n;

    for (size_t i = 0; i < stages; i++) {
        for (size_t k = 0; k < n; k++)
            at->p[k] = qdot_stages_at(at, w.ab, i, g->y[n + k], g->low[n + k], h, w.G, k);
        QDOT_TRY(qdot_geometric_velocity(g, t + at->c[i] * h, at->X + i * n, at->p,
                                         at->W + i * n));
    }
    *change = qdot_stages_move(g, at, h);
    if (w.m)
        QDOT_TRY(correct(g, &w, t, h));
    for (size_t i = 0; i + 1 < stages; i++)
        QDOT_TRY(qdot_geometric_force(g, t + at->c[i] * h, at->X + i * n, at->W + i * n,
                                      at->F + i * n));
    return add_constraint_forces(g, &w, t, h);
}

/* The end of p, by the velocities: linear in the last multipliers; the second time corrects what
 * rounding left. S is then that of the next step. */
static qdot_status
project_end_momenta(qdot_geometric *g, const step_state *w, double t)
{
    const qdot_ode_bonds *bonds = g->system->bonds;
    const size_t n = w->at.n;
    double *p = g->y + n, *low = g->low + n;

    QDOT_TRY(bonds->prepare(t, g->y, bonds->user));
    for (int k = 0; k < 2; k++) {
        QDOT_TRY(qdot_geometric_velocity(g, t, g->y, p, w->at.p));
        QDOT_TRY(bonds->velocities(t, g->y, w->at.p, w->g, bonds->user));
        bonds->solve(w->g, w->nu, w->sum, bonds->user);
        memset(w->sum, 0, n * sizeof *w->sum);
        QDOT_TRY(bonds->pull(t, g->y, w->nu, w->sum, bonds->user));
        for (size_t i = 0; i < n; i++)
            qdot_sum_advance(&p[i], &low[i], -w->sum[i]);
    }
    return QDOT_OK;
}

/* Set the first guess of F, W, X, lambda, G at the stages of a step. */
static qdot_status
guess_stages(qdot_geometric *g, const step_state *w, double t, double h)
{
    const bool on = g->known && h == g->h;

    QDOT_TRY(qdot_stages_guess(g, &w->at, t, h));
    if (w->m && !g->known)
        QDOT_TRY(g->system->bonds->prepare(t, g->y, g->system->bonds->user));
    if (on)
        qdot_stages_go_on(stages - 1, w->m, w->beyond, w->lambda);
    else
        memset(w->lambda, 0, (stages - 1) * w->m * sizeof *w->lambda);
    return add_constraint_forces(g, w, t, h);
}

static qdot_status
variational(qdot_geometric *g, double t, double h)
{
    const step_state w = work_space_of(g);
    const size_t n = g->n, last = (stages - 1) * n;

    QDOT_TRY(guess_stages(g, &w, t, h));
    g->known = false;
    QDOT_TRY(qdot_stages_iterate(g, &w.at, t, h, w.m ? patience : 1, iterate_variational_stages));
    QDOT_TRY(qdot_geometric_force(g, t + h, w.at.X + last, w.at.W + last, w.at.F + last));
    memcpy(w.G + last, w.at.F + last, n * sizeof *w.G);
    for (size_t k = 0; k < n; k++) {
        qdot_stages_advance(&w.at, &g->y[k], &g->low[k], h, w.at.W, k);
        qdot_stages_advance(&w.at, &g->y[n + k], &g->low[n + k], h, w.G, k);
    }
    if (w.m)
        QDOT_TRY(project_end_momenta(g, &w, t + h));
    g->known = true;
    return QDOT_OK;
}

const qdot_geometric_kernel qdot_variational = {
    .order = 2 * stages - 2,
    .stages = stages,
    .rows = QDOT_STAGES_ROWS(stages) + stages + 1,
    .more =
        QDOT_STAGES_MORE(stages) + 2 * stages * stages + 2 * (stages - 1) * (stages - 1),
    .of_bonds = 2 * (stages - 1) + 1,
    .begin = begin_variational,
    .step = variational,
};
