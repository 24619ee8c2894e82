/* radau-basis.c -- eigenvalues and eigenvectors of A^-1 of the Radau methods, computed once. */
#include "ode/radau-basis.h"

#include <complex.h>
#include <math.h>
#include <pthread.h>

#include "num/collocation.h"
#include "num/lu.h"

enum { MOST = QDOT_RADAU_MOST };

static qdot_radau_basis bases[QDOT_RADAU_KINDS];

/* Find the coefficients of the polynomial N(x) whose zeros are the nodes of the method. */
static void
find_nodal_polynomial(const qdot_radau_basis *b, double *N)
{
    N[0] = 1;
    for (size_t k = 0; k < b->stages; k++) {
        N[k + 1] = N[k];
        for (size_t p = k; p > 0; p--)
            N[p] = N[p - 1] - b->c[k] * N[p];
        N[0] *= -b->c[k];
    }
}

/* The k-th derivative of the polynomial N at x. */
static double
derivative_of_polynomial(size_t degree, const double *N, size_t k, double x)
{
    double sum = 0;

    for (size_t p = degree + 1; p-- > k;) {
        double falling = N[p];

        for (size_t j = 0; j < k; j++)
            falling *= (double)(p - j);
        sum = sum * x + falling;
    }
    return sum;
}

/* Find all roots lambda of sum_k N^(k)(0) lambda^(s-k), the eigenvalues of A^-1, by Weierstrass' iteration. */
static void
find_eigenvalues(size_t s, const double *N, double complex *lambda)
{
    double p[MOST + 1], moved = 1;

    for (size_t k = 0; k <= s; k++)
        p[k] = derivative_of_polynomial(s, N, k, 0);
    for (size_t i = 0; i < s; i++) /* choose start points on a circle, no two of them complex conjugates */
        lambda[i] = 6 + 6 * cexp(2 * acos(-1) * I * ((double)i + 0.3) / (double)s);
    for (int tries = 0; tries < 200 && moved > 1e-15; tries++) {
        moved = 0;
        for (size_t i = 0; i < s; i++) {
            double complex value = 0, apart = p[0];

            for (size_t k = 0; k <= s; k++)
                value = value * lambda[i] + p[k];
            for (size_t j = 0; j < s; j++)
                apart *= j == i ? 1 : lambda[i] - lambda[j];
            lambda[i] -= value / apart;
            moved = fmax(moved, cabs(value / apart) / cabs(lambda[i]));
        }
    }
}

/* Sort the eigenvalues into the basis: first the real one, then one of each conjugate pair. */
static void
sort_eigenvalues(qdot_radau_basis *b, const double complex *lambda)
{
    size_t at = 1;

    for (size_t i = 0; i < b->stages; i++) {
        const double size = cabs(lambda[i]);

        if (cimag(lambda[i]) > 1e-6 * size) {
            b->lambda_re[at] = creal(lambda[i]);
            b->lambda_im[at++] = cimag(lambda[i]);
        } else if (cimag(lambda[i]) > -1e-6 * size) {
            b->lambda_re[0] = creal(lambda[i]);
        }
    }
    b->spaces = at;
}

/* Set column k of the matrix of eigenvectors of A^-1; for a conjugate pair also the next column. */
static void
set_eigenvector(qdot_radau_basis *b, const double *N, size_t k, double *re, double *im)
{
    const size_t s = b->stages, column = k ? 2 * k - 1 : 0;
    const double complex mu = 1 / (b->lambda_re[k] + I * b->lambda_im[k]);

    for (size_t i = 0; i < s; i++) {
        double complex u = 0;

        for (size_t d = s; d > 0; d--)
            u = u * mu + derivative_of_polynomial(s, N, d, b->c[i]);
        re[i * s + column] = creal(u);
        im[i * s + column] = cimag(u);
        b->right_re[k][i] = (k ? 2 : 1) * creal(u);
        b->right_im[k][i] = (k ? 2 : 1) * cimag(u);
        if (k > 0) {
            re[i * s + column + 1] = creal(u);
            im[i * s + column + 1] = -cimag(u);
        }
    }
}

/* Find the left eigenvectors w_k, the rows of the inverse of the matrix of eigenvectors. */
static void
find_eigenvectors(qdot_radau_basis *b, const double *N)
{
    const size_t s = b->stages;
    double re[MOST * MOST], im[MOST * MOST];
    qdot_lu_row rows[MOST];

    for (size_t k = 0; k < b->spaces; k++)
        set_eigenvector(b, N, k, re, im);
    (void)qdot_lu_factor_complex(s, re, im, rows);
    for (size_t i = 0; i < s; i++) {
        double x[MOST] = {0}, y[MOST] = {0};

        x[i] = 1;
        qdot_lu_solve_complex(s, re, im, rows, x, y);
        for (size_t k = 0; k < b->spaces; k++) {
            b->left_re[k][i] = x[k ? 2 * k - 1 : 0];
            b->left_im[k][i] = y[k ? 2 * k - 1 : 0];
        }
    }
}

/* (A^-1)_ij, the slope at c_i of the polynomial that is 1 at c_j, 0 at 0 and the other nodes:
 * x L_j(x)/c_j. */
static void
find_inverse_matrix(qdot_radau_basis *b, const qdot_collocation *m)
{
    for (size_t i = 0; i < b->stages; i++)
        for (size_t j = 0; j < b->stages; j++) {
            qdot_two sum = {0, 0};

            for (size_t k = b->stages; k-- > 0;)
                sum = qdot_two_add(qdot_two_mul(sum, m->c[i]),
                                   qdot_two_mul_double(m->l[j][k], (double)(k + 1)));
            b->inverse[i][j] = qdot_two_div(sum, m->c[j]).hi;
        }
}

/* Find the weights 1/(c_j prod (c_j - c_k)) of interpolation at the nodes c_j. */
static void
find_interpolation_weights(qdot_radau_basis *b)
{
    for (size_t j = 0; j < b->stages; j++) {
        double product = b->c[j];

        for (size_t k = 0; k < b->stages; k++)
            product *= k == j ? 1 : b->c[j] - b->c[k];
        b->weight[j] = 1 / product;
    }
}

static void
make_basis(qdot_radau_basis *b, size_t stages)
{
    double N[MOST + 1];
    double complex lambda[MOST];
    qdot_collocation m;

    qdot_collocation_radau((int)stages, &m);
    b->stages = stages;
    for (size_t i = 0; i < stages; i++) {
        b->c[i] = m.c[i].hi;
        b->first[i] = m.l[i][0].hi;
        for (size_t j = 0; j < stages; j++)
            b->a[i][j] = m.a[i][j].hi;
    }
    find_inverse_matrix(b, &m);
    find_interpolation_weights(b);
    find_nodal_polynomial(b, N);
    find_eigenvalues(stages, N, lambda);
    sort_eigenvalues(b, lambda);
    find_eigenvectors(b, N);
}

static void
make_basis_of_3_stages(void)
{
    make_basis(bases, 3);
}

static void
make_basis_of_5_stages(void)
{
    make_basis(bases + 1, 5);
}

static void
make_basis_of_7_stages(void)
{
    make_basis(bases + 2, 7);
}

const qdot_radau_basis *
qdot_radau_basis_get(size_t kind)
{
    static pthread_once_t once[] = {PTHREAD_ONCE_INIT, PTHREAD_ONCE_INIT,
                                    PTHREAD_ONCE_INIT};
    static void (*const makers[])(void) = {make_basis_of_3_stages, make_basis_of_5_stages, make_basis_of_7_stages};

    pthread_once(once + kind, makers[kind]);
    return bases + kind;
}

void
qdot_radau_interpolate(const qdot_radau_basis *b, double x, double *w)
{
    double before = x, behind = 1;

    for (size_t j = 0; j < b->stages; j++) {
        w[j] = before * b->weight[j];
        before *= x - b->c[j];
    }
    for (size_t j = b->stages; j-- > 0;) {
        w[j] *= behind;
        behind *= x - b->c[j];
    }
}
