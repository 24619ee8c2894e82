/* collocation.c -- zeros of Legendre's polynomials, and integrals of Lagrange's. */
#include "num/collocation.h"

#include <stdbool.h>

/* P_s(x) - by P_(s-1)(x), s >= 1 */
static qdot_two
legendre(int s, double by, qdot_two x)
{
    qdot_two before = {1, 0}, p = x;

    for (int k = 1; k < s; k++) {
        const qdot_two next = qdot_two_div_double(
            qdot_two_sub(qdot_two_mul_double(qdot_two_mul(x, p), 2 * k + 1),
                         qdot_two_mul_double(before, k)),
            k + 1);

        before = p;
        p = next;
    }
    return qdot_two_sub(p, qdot_two_mul_double(before, by));
}

/* The zero of that between low and high, where its sign changes: by bisection, then by secants. */
static qdot_two
zero_between(int s, double by, double low, double high)
{
    const bool rises = legendre(s, by, (qdot_two){high, 0}).hi > 0;
    qdot_two x;
    double slope;

    for (int k = 0; k < 40; k++) {
        const double middle = 0.5 * (low + high);
        const bool above = (legendre(s, by, (qdot_two){middle, 0}).hi > 0) == rises;

        *(above ? &high : &low) = middle;
    }
    x = (qdot_two){0.5 * (low + high), 0};
    slope = qdot_two_sub(legendre(s, by, (qdot_two){x.hi + 1e-7, 0}),
                         legendre(s, by, (qdot_two){x.hi - 1e-7, 0}))
                .hi /
            2e-7;
    for (int k = 0; k < 4; k++)
        x = qdot_two_sub(x, qdot_two_div_double(legendre(s, by, x), slope));
    return x;
}

/* The zeros of P_s(2c - 1) - by P_(s-1)(2c - 1), by 0 or 1, into c [s]. A cell of the grid holds
 * one at most for so few, and no zero lies on an edge. */
static void
find_nodes(int s, double by, qdot_two *c)
{
    enum { CELLS = 500 };
    int found = 0;

    for (int k = 0; k < CELLS && found < s; k++) {
        const double low = -1 + 2 * (k - 0.317) / CELLS, high = low + 2.0 / CELLS;

        if (by != 0 && found == s - 1)
            break;
        if ((legendre(s, by, (qdot_two){low, 0}).hi > 0) !=
            (legendre(s, by, (qdot_two){high, 0}).hi > 0))
            c[found++] = qdot_two_scale(
                qdot_two_add_double(zero_between(s, by, low, high), 1), 0.5);
    }
    if (by != 0)
        c[s - 1] = (qdot_two){1, 0};
}

/* L_j as a polynomial: the product of (x - c_k)/(c_j - c_k) over k != j. */
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
make(int stages, int order, double by, qdot_collocation *m)
{
    *m = (qdot_collocation){.stages = stages, .order = order};
    find_nodes(stages, by, m->c);
    for (int j = 0; j < stages; j++)
        find_lagrange(m, j);
    for (int i = 0; i < stages; i++)
        qdot_collocation_weights(m, m->c[i], m->a[i]);
    qdot_collocation_weights(m, (qdot_two){1, 0}, m->b);
}

void
qdot_collocation_gauss(int stages, qdot_collocation *m)
{
    make(stages, 2 * stages, 0, m);
}

void
qdot_collocation_radau(int stages, qdot_collocation *m)
{
    make(stages, 2 * stages - 1, 1, m);
}
