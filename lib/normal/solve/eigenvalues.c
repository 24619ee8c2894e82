/* eigenvalues.c -- the eigenvalues of a matrix of constants, enclosed in balls. */
#include "normal/solve/eigenvalues.h"

#include <math.h>

#include <flint/fmpq_mat.h>
#include <flint/fmpq_poly.h>

#include "expr/exact.h"
#include "expr/polynomial/flint.h"
#include "normal/refute/ball.h"
#include "normal/solve/complex-roots.h"

#if __FLINT_RELEASE >= 30000
#include <flint/acb_mat.h>
#else
#include <acb_mat.h>
#endif

typedef struct {
    qdot_pool *pool;
    size_t n;
    const qdot_expr *A;
    double *re, *im, *error;
    qdot_status status;
} job;

/* The entries in balls; false: one of them has no value. */
static bool
fill_matrix(const job *j, qdot_ball *ball, acb_mat_t M, slong prec)
{
    qdot_ball_eval(ball, prec, NULL, NULL);
    for (size_t i = 0; i < j->n * j->n; i++) {
        arb_srcptr value = qdot_ball_get(ball, j->A[i]);

        if (value == NULL)
            return false;
        acb_set_arb(acb_mat_entry(M, (slong)(i / j->n), (slong)(i % j->n)), value);
    }
    return true;
}

/* Read the enclosures; whether all are known to the last bit of a double. */
static bool
read_enclosures(const job *j, acb_srcptr E)
{
    bool sharp = true;

    for (size_t i = 0; i < j->n; i++) {
        const double radius = hypot(mag_get_d(arb_radref(acb_realref(E + i))), mag_get_d(arb_radref(acb_imagref(E + i))));

        j->re[i] = arf_get_d(arb_midref(acb_realref(E + i)), ARF_RND_NEAR);
        j->im[i] = arb_contains_zero(acb_imagref(E + i)) ? 0 : arf_get_d(arb_midref(acb_imagref(E + i)), ARF_RND_NEAR);
        j->error[i] = radius + fabs(arf_get_d(arb_midref(acb_imagref(E + i)), ARF_RND_NEAR) - j->im[i]);
        sharp = sharp && isfinite(radius) && j->error[i] <= 1e-17 * (1e-3 + hypot(j->re[i], j->im[i]));
        j->error[i] += 1.2e-16 * hypot(j->re[i], j->im[i]);
    }
    return sharp;
}

static void
enclose(void *user)
{
    job *j = user;
    const slong n = (slong)j->n;
    acb_mat_t M, R;
    acb_ptr E, approximate;
    qdot_ball ball;
    bool sharp = false, found = false;

    j->status = qdot_ball_begin(&ball, j->pool, j->n * j->n, j->A);
    if (j->status != QDOT_OK)
        return;
    acb_mat_init(M, n, n);
    acb_mat_init(R, n, n);
    E = _acb_vec_init(n);
    approximate = _acb_vec_init(n);
    for (slong prec = 128; prec <= 2048 && !sharp; prec *= 2) {
        if (!fill_matrix(j, &ball, M, prec)) {
            j->status = qdot_fail(QDOT_EDOMAIN, "an entry of the matrix has no value");
            break;
        }
        (void)acb_mat_approx_eig_qr(approximate, NULL, R, M, NULL, 0, prec);
        if (acb_mat_eig_multiple(E, M, approximate, R, prec) == 0)
            continue;
        found = true;
        sharp = read_enclosures(j, E);
    }
    if (j->status == QDOT_OK && !found)
        j->status = qdot_fail(QDOT_EFAILED, "the eigenvalues cannot be enclosed");
    _acb_vec_clear(E, n);
    _acb_vec_clear(approximate, n);
    acb_mat_clear(M);
    acb_mat_clear(R);
    qdot_ball_end(&ball);
}

/* Whether eigenvalue a stands before b: by real part, then by imaginary part, each equal within the errors. */
static bool
stands_before(const job *j, size_t a, size_t b)
{
    const double slack = 4 * (j->error[a] + j->error[b]);

    return j->re[a] < j->re[b] - slack || (j->re[a] <= j->re[b] + slack && j->im[a] < j->im[b]);
}

static void
sort_eigenvalues(job *j)
{
    for (size_t a = 1; a < j->n; a++)
        for (size_t b = a; b > 0 && stands_before(j, b, b - 1); b--) {
            double *const list[] = {j->re, j->im, j->error};

            for (int k = 0; k < 3; k++) {
                const double keep = list[k][b];

                list[k][b] = list[k][b - 1];
                list[k][b - 1] = keep;
            }
        }
}

/* --- of rational numbers: the roots of the characteristic polynomial, exact in their multiplicities ---- */

static bool
is_rational(const job *j)
{
    for (size_t i = 0; i < j->n * j->n; i++)
        if (qdot_expr_rational(j->pool, j->A[i]) == NULL)
            return false;
    return true;
}

static void
find_rational(void *user)
{
    job *j = user;
    const slong n = (slong)j->n;
    fmpq_mat_t M;
    fmpq_poly_t p;
    fmpz_poly_t f;

    fmpq_mat_init(M, n, n);
    fmpq_poly_init(p);
    fmpz_poly_init(f);
    for (slong i = 0; i < n * n; i++)
        fmpq_set(fmpq_mat_entry(M, i / n, i % n), qdot_expr_rational(j->pool, j->A[i]));
    fmpq_mat_charpoly(p, M);
    fmpq_poly_get_numerator(f, p);
    qdot_complex_roots_of(f, j->re, j->im);
    for (size_t k = 0; k < j->n; k++)
        j->error[k] = 1.2e-16 * hypot(j->re[k], j->im[k]);
    fmpz_poly_clear(f);
    fmpq_poly_clear(p);
    fmpq_mat_clear(M);
}

qdot_status
qdot_eigenvalues_of_constants(qdot_pool *pool, size_t n, const qdot_expr *A, double *re, double *im, double *error)
{
    job j = {.pool = pool, .n = n, .A = A, .re = re, .im = im, .error = error};

    QDOT_TRY(qdot_flint_run(pool, is_rational(&j) ? find_rational : enclose, &j));
    QDOT_TRY(j.status);
    sort_eigenvalues(&j);
    return QDOT_OK;
}
