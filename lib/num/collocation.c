/* collocation.c -- computes nodes (zeros of Legendre polynomials) and weights (integrals of
 * Lagrange polynomials). */
#include "num/collocation.h"

#include <stdbool.h>

/* Families of nodes: zeros of Legendre's P_s, P_s - P_(s-1), P_s - P_(s-2); each value is the difference of degrees. */
typedef enum { GAUSS, RADAU, LOBATTO } family;

/* The Legendre polynomial P_s(x) minus P_(s-1) for Radau, P_(s-2) for Lobatto; s >= 1, for Lobatto s >= 2. */
static qdot_two
node_polynomial(int s, family of, qdot_two x)
{
    qdot_two p[3] = {x, {1, 0}, {0, 0}}; /* the Legendre polynomials P_k, P_(k-1), P_(k-2) */

    for (int k = 1; k < s; k++) {
        p[2] = p[1];
        p[1] = p[0];
        p[0] = qdot_two_div_double(
            qdot_two_sub(qdot_two_mul_double(qdot_two_mul(x, p[1]), 2 * k + 1),
                         qdot_two_mul_double(p[2], k)),
            k + 1);
    }
    return of == GAUSS ? p[0] : qdot_two_sub(p[0], p[of]);
}

/* The polynomial whose zeros are the nodes of the method, at x, in doubles. */
static double
node_polynomial_double(int s, family of, double x)
{
    double p[3] = {x, 1, 0};

    for (int k = 1; k < s; k++) {
        p[2] = p[1];
        p[1] = p[0];
        p[0] = ((2 * k + 1) * x * p[1] - k * p[2]) / (k + 1);
    }
    return of == GAUSS ? p[0] : p[0] - p[of];
}

/* The zero of the polynomial between low and high, where its sign changes: by bisection, then with a constant
 * slope. */
static qdot_two
find_zero_between(int s, family of, double low, double high)
{
    const bool rises = node_polynomial_double(s, of, high) > 0;
    qdot_two x;
    double slope;

    for (int k = 0; k < 40; k++) {
        const double middle = 0.5 * (low + high);

        *((node_polynomial_double(s, of, middle) > 0) == rises ? &high : &low) = middle;
    }
    x = (qdot_two){0.5 * (low + high), 0};
    slope =
        (node_polynomial_double(s, of, x.hi + 1e-6) - node_polynomial_double(s, of, x.hi - 1e-6)) / 2e-6;
    for (int k = 0; k < 4; k++)
        x = qdot_two_sub(x, qdot_two_div_double(node_polynomial(s, of, x), slope));
    return x;
}

/* The nodes into c [s]. A cell of the grid holds one zero at most for so few, and no zero but an
 * end lies on an edge. */
static void
find_nodes(int s, family of, qdot_two *c)
{
    enum { CELLS = 150 };
    const int most = of == GAUSS ? s : s - 1;
    int found = 0;

    for (int k = 0; k < CELLS && found < most; k++) {
        const double low = -1 + 2 * (k - 0.317) / CELLS, high = low + 2.0 / CELLS;

        if ((node_polynomial_double(s, of, low) > 0) != (node_polynomial_double(s, of, high) > 0))
            c[found++] = qdot_two_scale(
                qdot_two_add_double(find_zero_between(s, of, low, high), 1), 0.5);
    }
    if (of == LOBATTO)
        c[0] = (qdot_two){0, 0};
    if (of != GAUSS)
        c[s - 1] = (qdot_two){1, 0};
}

/* Find the coefficients of Lagrange's polynomial L_j: the product of (x - c_k)/(c_j - c_k) over k != j. */
static void
find_lagrange(qdot_collocation *m, int j)
{
    qdot_two *l = m->l[j];
    int degree = 0;

    l[0] = (qdot_two){1, 0};
    for (int k = 0; k < m->stages; k++) {
        const qdot_two apart = qdot_two_sub(m->c[j], m->c[k]);

        if (k == j)
            continue;
        l[++degree] = (qdot_two){0, 0};
        for (int p = degree; p >= 0; p--) {
            const qdot_two up = p > 0 ? l[p - 1] : (qdot_two){0, 0};

            l[p] = qdot_two_div(qdot_two_sub(up, qdot_two_mul(m->c[k], l[p])), apart);
        }
    }
}

void
qdot_collocation_weights(const qdot_collocation *m, qdot_two x, qdot_two *w)
{
    for (int j = 0; j < m->stages; j++) {
        qdot_two sum = {0, 0};

        for (int k = m->stages; k-- > 0;)
            sum = qdot_two_add(qdot_two_mul(sum, x),
                               qdot_two_div_double(m->l[j][k], k + 1));
        w[j] = qdot_two_mul(sum, x);
    }
}

static void
fill_coefficients(int stages, family of, qdot_collocation *m)
{
    *m = (qdot_collocation){.stages = stages, .order = 2 * stages - (int)of};
    find_nodes(stages, of, m->c);
    for (int j = 0; j < stages; j++)
        find_lagrange(m, j);
    for (int i = 0; i < stages; i++)
        qdot_collocation_weights(m, m->c[i], m->a[i]);
    qdot_collocation_weights(m, (qdot_two){1, 0}, m->b);
}

void
qdot_collocation_gauss(int stages, qdot_collocation *m)
{
    fill_coefficients(stages, GAUSS, m);
}

void
qdot_collocation_radau(int stages, qdot_collocation *m)
{
    fill_coefficients(stages, RADAU, m);
}

void
qdot_collocation_lobatto(int stages, qdot_collocation *m)
{
    fill_coefficients(stages, LOBATTO, m);
}
