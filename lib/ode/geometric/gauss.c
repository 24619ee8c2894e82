/* gauss.c -- Gauss collocation of orders 4, 6, 8 and 12 in (q, p).
 *
 *     P_i = p + h sum_j a_ij F_j,   Q_i = q + h sum_j a_ij W_j,   i = 1 .. s
 *     W_i = v(t_i, Q_i, P_i),       F_i = F(t_i, Q_i, W_i),       t_i = t + c_i h
 *     p <- p + h sum_i b_i F_i,     q <- q + h sum_i b_i W_i
 *
 * is iterated in this order until the positions of the stages, q + h sum a_ij W_j, change by nothing or
 * no longer by less than before: what is left is rounding, without a direction of its own. The
 * iteration begins with the polynomials of F and W of the step before.
 *
 * Source  Hairer, Lubich & Wanner, Geometric Numerical Integration, II.1.3, VIII.5, VIII.6;
 *         num/collocation.h.
 */
#include <math.h>
#include <string.h>

#include "num/collocation.h"
#include "num/sum.h"
#include "ode/geometric/geometric.h"

enum { most_iterations = 60, least_iterations = 3 };

/* Where changes stop to fall above this, relative to the positions, the iteration does not converge. */
static const double converged = 1e-10;

/* Work space. Coefficients are pairs of doubles, the second ones after all the first. */
typedef struct {
    size_t s, n;
    double *a, *b, *c, *ahead; /* [2 x s x s], [2 x s], [s], [s x s] L_j(1 + c_i) */
    double *F, *W, *Z;         /* [s x n]; Z = h sum a_ij W_j */
    double *x, *p;             /* [n] */
} stages;

static stages
stages_of(const qdot_geometric *g)
{
    const size_t s = (size_t)g->kernel->stages, n = g->n;
    double *at = g->work;
    stages w = {.s = s, .n = n, .a = at};

    w.b = w.a + 2 * s * s;
    w.c = w.b + 2 * s;
    w.ahead = w.c + s;
    w.F = w.ahead + s * s;
    w.W = w.F + s * n;
    w.Z = w.W + s * n;
    w.x = w.Z + s * n;
    w.p = w.x + n;
    return w;
}

static void
begin(qdot_geometric *g)
{
    const stages w = stages_of(g);
    const size_t s = w.s;
    qdot_collocation m;

    qdot_collocation_gauss((int)s, &m);
    for (size_t i = 0; i < s; i++) {
        w.b[i] = m.b[i].hi;
        w.b[s + i] = m.b[i].lo;
        w.c[i] = m.c[i].hi;
        for (size_t j = 0; j < s; j++) {
            double x = 0;

            w.a[i * s + j] = m.a[i][j].hi;
            w.a[s * s + i * s + j] = m.a[i][j].lo;
            for (size_t k = s; k-- > 0;)
                x = x * (1 + m.c[i].hi) + m.l[j][k].hi;
            w.ahead[i * s + j] = x;
        }
    }
}

/* sum_j (a_j + low_j) x_jk over the rows of x [s x n] */
static inline double
combine(size_t s, size_t n, const double *a, const double *low, const double *x, size_t k)
{
    double sum = 0, rest = 0;

    for (size_t j = 0; j < s; j++) {
        sum += a[j] * x[j * n + k];
        rest += low[j] * x[j * n + k];
    }
    return sum + rest;
}

/* F and W to begin with: from the step before, of the same length, or those of the start. */
static qdot_status
guess(qdot_geometric *g, const stages *w, double t, double h)
{
    const size_t s = w->s, n = w->n;
    double column[QDOT_COLLOCATION_MOST];

    if (g->known && h == g->h) {
        for (int half = 0; half < 2; half++)
            for (size_t k = 0; k < n; k++) {
                double *x = half ? w->W : w->F;

                for (size_t i = 0; i < s; i++) {
                    column[i] = 0;
                    for (size_t j = 0; j < s; j++)
                        column[i] += w->ahead[i * s + j] * x[j * n + k];
                }
                for (size_t i = 0; i < s; i++)
                    x[i * n + k] = column[i];
            }
        return QDOT_OK;
    }
    QDOT_TRY(qdot_geometric_velocity(g, t, g->y, g->y + n, w->W));
    QDOT_TRY(qdot_geometric_force(g, t, g->y, w->W, w->F));
    for (size_t i = 1; i < s; i++) {
        memcpy(w->W + i * n, w->W, n * sizeof *w->W);
        memcpy(w->F + i * n, w->F, n * sizeof *w->F);
    }
    return QDOT_OK;
}

/* Z from W; the largest change of a position. */
static double
move(const qdot_geometric *g, const stages *w, double h)
{
    const size_t s = w->s, n = w->n;
    double most = 0;

    for (size_t i = 0; i < s; i++)
        for (size_t k = 0; k < n; k++) {
            const double z = h * combine(s, n, w->a + i * s, w->a + s * s + i * s, w->W, k);
            const double change = fabs(z - w->Z[i * n + k]), size = fabs(g->y[k]) + fabs(z);

            w->Z[i * n + k] = z;
            if (!(change <= most * size))
                most = change / size;
        }
    return most;
}

/* Once round: P, W, Z, F. */
static qdot_status
iterate(qdot_geometric *g, const stages *w, double t, double h, double *change)
{
    const size_t s = w->s, n = w->n;
    const double *q = g->y, *p = q + n, *q_low = g->low, *p_low = q_low + n;

    for (size_t i = 0; i < s; i++) {
        for (size_t k = 0; k < n; k++) {
            w->x[k] = q[k] + (q_low[k] + w->Z[i * n + k]);
            w->p[k] = p[k] + (p_low[k]
                              + h * combine(s, n, w->a + i * s, w->a + s * s + i * s, w->F, k));
        }
        QDOT_TRY(qdot_geometric_velocity(g, t + w->c[i] * h, w->x, w->p, w->W + i * n));
    }
    *change = move(g, w, h);
    for (size_t i = 0; i < s; i++) {
        for (size_t k = 0; k < n; k++)
            w->x[k] = q[k] + (q_low[k] + w->Z[i * n + k]);
        QDOT_TRY(qdot_geometric_force(g, t + w->c[i] * h, w->x, w->W + i * n, w->F + i * n));
    }
    return QDOT_OK;
}

static qdot_status
gauss(qdot_geometric *g, double t, double h)
{
    const stages w = stages_of(g);
    const size_t s = w.s, n = w.n;
    double before = INFINITY, change;

    QDOT_TRY(guess(g, &w, t, h));
    g->known = false;
    move(g, &w, h);
    for (int k = 1;; k++) {
        QDOT_TRY(iterate(g, &w, t, h, &change));
        if (k >= least_iterations && change < converged && (change == 0 || change >= before))
            break;
        if (k == most_iterations || !isfinite(change))
            return qdot_fail(QDOT_EDOMAIN, "the stages of a step of %.2g do not converge", h);
        before = change;
    }
    for (size_t k = 0; k < n; k++) {
        qdot_sum_advance(&g->y[k], &g->low[k], h * combine(s, n, w.b, w.b + s, w.W, k));
        qdot_sum_advance(&g->y[n + k], &g->low[n + k], h * combine(s, n, w.b, w.b + s, w.F, k));
    }
    g->known = true;
    return QDOT_OK;
}

#define GAUSS(order, s)                                                                       \
    const qdot_geometric_kernel qdot_gauss##order = {                                         \
        order, false, s, 3 * (s) + 2, 3 * (s) * (s) + 3 * (s), begin, gauss};

GAUSS(4, 2)
GAUSS(6, 3)
GAUSS(8, 4)
GAUSS(12, 6)
