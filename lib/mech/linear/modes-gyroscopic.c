/* modes-gyroscopic.c -- modes of M y'' + Gamma y' + H y = 0 with an antisymmetric Gamma, or an H that is not symmetric.
 *
 * y = Re(a e^(i w t)) with a complex amplitude a: the coordinates of a mode do not pass 0 together. The polynomial
 * det(M s^2 + Gamma s + H) is even in s: with s^2 = -W
 *
 *     P(W) = sum over even k of (-W)^(k/2) D_k,   D_k the coefficient of s^k in det(H - W M + s Gamma),
 *
 * and a = u + i v is a zero of (H - W M + i w Gamma), a real system of twice the size for (u, v). A root W = 0 stands for
 * displacements that stay, the null space of H.
 *
 * Source  Landau & Lifshitz, Mechanics, section 39; Meirovitch, SIAM J. Appl. Math. (AIAA J. 12 (1974) 1337).
 * Tests   tests/script/rests/modes-steady.lag
 */
#include "mech/linear/modes-parts.h"

#include <math.h>

#include <gsl/gsl_complex_math.h>
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_linalg.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "normal/simplify/positive.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/solve.h"
#include "num/lu.h"

/* --- exact -------------------------------------------------------------------------------- */

/* P(W), the characteristic polynomial in W = w^2. */
static qdot_expr
characteristic_polynomial(const qdot_modes_job *j, qdot_expr W)
{
    qdot_pool *pool = j->pool;
    const size_t n = j->m.n;
    const qdot_expr s = qdot_symbol_get(pool, QDOT_FORMAL, "s");
    qdot_expr *A = qdot_calloc(n * n, sizeof *A), e, sum = QDOT_ZERO, by = QDOT_ONE;
    int64_t factorial = 1;

    if (A == NULL)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < n * n; i++)
        A[i] = qdot_add(pool, qdot_sub(pool, j->m.H[i], qdot_mul(pool, W, j->m.M[i])), qdot_mul(pool, s, j->m.Gamma[i]));
    e = n == 1 ? A[0] : qdot_det(pool, qdot_matrix(pool, (uint32_t)n, (uint32_t)n, A));
    qdot_free(A);
    for (size_t k = 0; k <= n; k++) {
        const qdot_expr there = qdot_subs(pool, e, 1, &s, (qdot_expr[]){QDOT_ZERO});

        if (k % 2 == 0) {
            sum = qdot_add(pool, sum, qdot_product(pool, 3, (qdot_expr[]){qdot_expr_ratio(pool, 1, factorial), by, there}));
            by = qdot_neg(pool, qdot_mul(pool, by, W));
        }
        e = qdot_diff(pool, e, s);
        factorial *= (int64_t)k + 1;
    }
    return sum;
}

/* z = a z - b p in complex numbers, z and p [n] real parts, then [n] imaginary ones, simplified. */
static qdot_status
combine(const qdot_modes_job *j, const qdot_expr *a, qdot_expr *z, const qdot_expr *b, const qdot_expr *p)
{
    qdot_pool *pool = j->pool;
    const size_t n = j->m.n;

    for (size_t i = 0; i < n; i++) {
        const qdot_expr re[4] = {qdot_mul(pool, a[0], z[i]), qdot_neg(pool, qdot_mul(pool, a[1], z[n + i])),
                                 qdot_neg(pool, qdot_mul(pool, b[0], p[i])), qdot_mul(pool, b[1], p[n + i])},
                        im[4] = {qdot_mul(pool, a[0], z[n + i]), qdot_mul(pool, a[1], z[i]),
                                 qdot_neg(pool, qdot_mul(pool, b[0], p[n + i])), qdot_neg(pool, qdot_mul(pool, b[1], p[i]))};

        z[i] = qdot_simplify(pool, qdot_sum(pool, 4, re), &j->facts);
        z[n + i] = qdot_simplify(pool, qdot_sum(pool, 4, im), &j->facts);
    }
    return qdot_pool_check(pool);
}

/* Remove from z [2 n] its components along the vectors `kept` [count x 2 n]: each of these is not 0 at its `pivot`, where
 * those after it are 0. *pivot_of_z: where z is not 0 then; n: it is 0, z depends on the kept ones. */
static qdot_status
reduce_by_kept(const qdot_modes_job *j, size_t count, const qdot_expr *kept, const size_t *pivot, qdot_expr *z,
               size_t *pivot_of_z)
{
    const size_t n = j->m.n;

    for (size_t k = 0; k < count; k++) {
        const qdot_expr *p = kept + k * 2 * n, at_p[2] = {p[pivot[k]], p[n + pivot[k]]},
                        at_z[2] = {z[pivot[k]], z[n + pivot[k]]};

        if (at_z[0] != QDOT_ZERO || at_z[1] != QDOT_ZERO)
            QDOT_TRY(combine(j, at_p, z, at_z, p));
    }
    *pivot_of_z = 0;
    while (*pivot_of_z < n && qdot_modes_is_zero(j, z[*pivot_of_z]) && qdot_modes_is_zero(j, z[n + *pivot_of_z]))
        ++*pivot_of_z;
    return qdot_pool_check(j->pool);
}

/* Add count/2 complex modes of the frequency w from a real basis z [count x 2 n] of (re, im): it holds i a with each a. z is
 * overwritten. */
static qdot_status
add_complex_modes(qdot_modes_job *j, qdot_expr w, size_t count, qdot_expr *z)
{
    const size_t n = j->m.n;
    size_t pivot[QDOT_MODES_MOST_EXACT + 1], kept = 0;

    for (size_t k = 0; k < count && 2 * kept < count; k++) {
        qdot_expr *one = z + k * 2 * n;

        QDOT_TRY(reduce_by_kept(j, kept, z, pivot, one, &pivot[kept]));
        if (pivot[kept] == n)
            continue;
        QDOT_TRY(qdot_modes_add_complex(j, w, one, one + n));
        for (size_t i = 0; i < 2 * n; i++) /* kept vectors stand first */
            z[kept * 2 * n + i] = one[i];
        kept++;
    }
    return QDOT_OK;
}

/* Add the modes whose amplitude is in the null space of A [rows x rows], at most `most`: real ones if rows = n. If rows =
 * 2 n it is (re, im), and of each mode the null space has two dimensions. */
static qdot_status
add_null_space(qdot_modes_job *j, qdot_expr w, size_t rows, qdot_expr *A, size_t most)
{
    const size_t n = j->m.n;
    qdot_expr *z = qdot_calloc(rows * rows + n, sizeof *z), *zero = z + rows * rows;
    size_t count = 0;
    qdot_status status = z == NULL ? QDOT_ENOMEM : qdot_modes_null_space(j, rows, A, z, &count);

    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        zero[i] = QDOT_ZERO;
    if (status == QDOT_OK && rows > n)
        status = count % 2 == 0 && count <= 2 * most ? add_complex_modes(j, w, count, z) : QDOT_ELIMIT;
    for (size_t k = 0; rows == n && k < count && k < most && status == QDOT_OK; k++)
        status = qdot_modes_add_complex(j, w, z + k * n, zero);
    qdot_free(z);
    return status;
}

/* Of two roots, w = (sqrt(s + 2 p) -+ sqrt(s - 2 p))/2 with s = W1 + W2, p = sqrt(W1 W2), into w [2], where that is
 * shorter: sqrt(Omega^2 + w0^2) -+ Omega of Foucault's pendulum. */
static qdot_status
shorten_two_frequencies(const qdot_modes_job *j, const qdot_root *root, qdot_expr *w)
{
    qdot_pool *pool = j->pool;
    const qdot_expr s = qdot_simplify(pool, qdot_add(pool, root[0].value, root[1].value), &j->facts);
    const qdot_expr square = qdot_simplify(pool, qdot_mul(pool, root[0].value, root[1].value), &j->facts);
    qdot_expr p, sum, gap, sign, pair[2];

    QDOT_TRY(qdot_pool_check(pool));
    if (qdot_positive(pool, square, &j->facts, 0, NULL) != QDOT_TRUE)
        return qdot_pool_check(pool);
    p = qdot_mul(pool, qdot_expr_int(pool, 2), qdot_sqrt(pool, square));
    sum = qdot_simplify(pool, qdot_add(pool, s, p), &j->facts);
    gap = qdot_simplify(pool, qdot_sub(pool, s, p), &j->facts);
    QDOT_TRY(qdot_pool_check(pool));
    if ((qdot_expr_sign(pool, sum) & QDOT_GE0) == 0 || (qdot_expr_sign(pool, gap) & QDOT_GE0) == 0)
        return QDOT_OK;
    sum = qdot_div(pool, qdot_sqrt(pool, sum), qdot_expr_int(pool, 2));
    gap = qdot_div(pool, qdot_sqrt(pool, gap), qdot_expr_int(pool, 2));
    pair[0] = qdot_simplify(pool, qdot_sub(pool, sum, gap), &j->facts);
    pair[1] = qdot_simplify(pool, qdot_add(pool, sum, gap), &j->facts);
    sign = qdot_sub(pool, qdot_mul(pool, pair[0], pair[0]), root[0].value);
    QDOT_TRY(qdot_pool_check(pool));
    if (qdot_expr_size(pool, pair[0]) + qdot_expr_size(pool, pair[1]) >=
        qdot_expr_size(pool, w[0]) + qdot_expr_size(pool, w[1]))
        return QDOT_OK;
    for (int k = 0; k < 2; k++) /* the roots may stand in either order */
        w[k] = pair[qdot_modes_is_zero(j, sign) ? k : 1 - k];
    return qdot_pool_check(pool);
}

/* Add the modes of a root W with frequency w, at most `most`. */
static qdot_status
add_modes_of_square(qdot_modes_job *j, qdot_expr W, qdot_expr w, size_t most)
{
    qdot_pool *pool = j->pool;
    const size_t n = j->m.n, rows = W == QDOT_ZERO || !j->gyroscopic ? n : 2 * n;
    qdot_expr *A = qdot_calloc(rows * rows, sizeof *A);
    qdot_status status = A == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t i = 0; i < n * n && status == QDOT_OK; i++) {
        const size_t r = i / n, c = i % n;
        const qdot_expr stiff = qdot_simplify(pool, qdot_sub(pool, j->m.H[i], qdot_mul(pool, W, j->m.M[i])), &j->facts);

        A[r * rows + c] = stiff;
        if (rows == n)
            continue;
        A[(n + r) * rows + n + c] = stiff;
        A[(n + r) * rows + c] = qdot_mul(pool, w, j->m.Gamma[i]);
        A[r * rows + n + c] = qdot_neg(pool, A[(n + r) * rows + c]);
        status = qdot_pool_check(pool);
    }
    if (status == QDOT_OK)
        status = add_null_space(j, w, rows, A, most);
    qdot_free(A);
    return status;
}

qdot_status
qdot_modes_gyroscopic(qdot_modes_job *j, bool *done)
{
    const qdot_expr W = qdot_symbol_get(j->pool, QDOT_FORMAL, "omega^2");
    const size_t n = j->m.n;
    qdot_expr w[QDOT_MODES_MOST_EXACT];
    bool stays = false;
    qdot_solutions roots;
    qdot_status status;

    *done = false;
    if (n > QDOT_MODES_MOST_EXACT)
        return QDOT_OK;
    status = qdot_solve(j->pool, characteristic_polynomial(j, W), W, &j->facts, &roots);
    roots.complete = roots.complete && roots.root.n <= n;
    for (size_t k = 0; k < roots.root.n && roots.complete && status == QDOT_OK; k++)
        status = qdot_modes_frequency(j, roots.root.at[k].value, &w[k]);
    if (roots.root.n == 2 && roots.complete && status == QDOT_OK)
        status = shorten_two_frequencies(j, roots.root.at, w);
    for (size_t k = 0; k < roots.root.n && roots.complete && status == QDOT_OK; k++) {
        const bool zero = qdot_modes_is_zero(j, roots.root.at[k].value);

        stays = stays || zero;
        if (!zero)
            status = add_modes_of_square(j, roots.root.at[k].value, w[k], n);
    }
    if (stays && status == QDOT_OK && j->frequency.n < n)
        status = add_modes_of_square(j, QDOT_ZERO, QDOT_ZERO, n - j->frequency.n);
    *done = status == QDOT_OK && roots.complete && (j->frequency.n == n || (stays && j->frequency.n > 0));
    qdot_solutions_clear(&roots);
    return status == QDOT_ELIMIT ? QDOT_OK : status;
}

/* --- numbers ------------------------------------------------------------------------------ */

/* F [2n x 2n] of (y, y')' = F (y, y'): the rows y'' = -M^-1 (H y + Gamma y'). */
static qdot_status
first_order_matrix(size_t n, const double *M, const double *Gamma, const double *H, gsl_matrix *F)
{
    double *LU = qdot_calloc(n * n + n, sizeof *LU), *x = LU + n * n;
    qdot_lu_row *rows = qdot_calloc(n, sizeof *rows);
    qdot_status status = LU == NULL || rows == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t i = 0; i < n * n && status == QDOT_OK; i++)
        LU[i] = M[i];
    if (status == QDOT_OK && !qdot_lu_factor(n, LU, rows))
        status = qdot_fail(QDOT_ESINGULAR, "the mass matrix is singular there");
    for (size_t c = 0; c < 2 * n && status == QDOT_OK; c++) {
        for (size_t r = 0; r < n; r++)
            x[r] = -(c < n ? H : Gamma)[r * n + c % n];
        qdot_lu_solve(n, LU, rows, x);
        for (size_t r = 0; r < n; r++) {
            gsl_matrix_set(F, n + r, c, x[r]);
            gsl_matrix_set(F, r, c, c == n + r ? 1 : 0);
        }
    }
    qdot_free(LU);
    qdot_free(rows);
    return status;
}

/* Add the modes that do not move, H y = 0: the right singular vectors of H of its `most` smallest singular values. */
static qdot_status
add_numbers_at_rest(qdot_modes_job *j, size_t most, const double *H, const double *N)
{
    const size_t n = j->m.n;
    gsl_matrix *U = gsl_matrix_alloc(n, n), *V = gsl_matrix_alloc(n, n);
    gsl_vector *s = gsl_vector_alloc(n), *work = gsl_vector_alloc(n);
    double *re = qdot_calloc(2 * n, sizeof *re);
    qdot_status status = U == NULL || V == NULL || s == NULL || work == NULL || re == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t i = 0; i < n * n && status == QDOT_OK; i++)
        U->data[i] = H[i];
    if (status == QDOT_OK && gsl_linalg_SV_decomp(U, V, s, work) != GSL_SUCCESS)
        status = qdot_fail(QDOT_EFAILED, "the modes cannot be found in numbers");
    for (size_t k = n - most; k < n && status == QDOT_OK; k++) {
        for (size_t i = 0; i < n; i++)
            re[i] = gsl_matrix_get(V, i, k);
        status = qdot_modes_add_numbers(j, 0, N, re, re + n);
    }
    gsl_matrix_free(U);
    gsl_matrix_free(V);
    gsl_vector_free(s);
    gsl_vector_free(work);
    qdot_free(re);
    return status;
}

qdot_status
qdot_modes_gyroscopic_numbers(qdot_modes_job *j, const double *M, const double *Gamma, const double *H, const double *N)
{
    const size_t n = j->m.n;
    gsl_matrix *F = gsl_matrix_alloc(2 * n, 2 * n);
    gsl_vector_complex *s = gsl_vector_complex_alloc(2 * n);
    gsl_matrix_complex *Y = gsl_matrix_complex_alloc(2 * n, 2 * n);
    gsl_eigen_nonsymmv_workspace *work = gsl_eigen_nonsymmv_alloc(2 * n);
    double *re = qdot_calloc(2 * n, sizeof *re), most = 0;
    size_t still = 0;
    qdot_status status = F == NULL || s == NULL || Y == NULL || work == NULL || re == NULL
                             ? QDOT_ENOMEM : first_order_matrix(n, M, Gamma, H, F);

    if (status == QDOT_OK && gsl_eigen_nonsymmv(F, s, Y, work) != GSL_SUCCESS)
        status = qdot_fail(QDOT_EFAILED, "the modes cannot be found in numbers");
    for (size_t k = 0; k < 2 * n && status == QDOT_OK; k++)
        most = fmax(most, gsl_complex_abs(gsl_vector_complex_get(s, k)));
    for (size_t k = 0; k < 2 * n && status == QDOT_OK; k++)
        still += gsl_complex_abs(gsl_vector_complex_get(s, k)) <= 1e-6 * most;
    if (status == QDOT_OK && still > 1)
        status = add_numbers_at_rest(j, still / 2, H, N);
    for (size_t k = 0; k < 2 * n && status == QDOT_OK; k++) {
        const gsl_complex one = gsl_vector_complex_get(s, k);

        if (gsl_complex_abs(one) <= 1e-6 * most)
            continue;
        if (fabs(GSL_REAL(one)) > 1e-7 * most)
            status = qdot_modes_fail_unstable();
        if (GSL_IMAG(one) < 0)
            continue;
        for (size_t i = 0; i < n; i++) {
            re[i] = GSL_REAL(gsl_matrix_complex_get(Y, i, k));
            re[n + i] = GSL_IMAG(gsl_matrix_complex_get(Y, i, k));
        }
        if (status == QDOT_OK)
            status = qdot_modes_add_numbers(j, GSL_IMAG(one), N, re, re + n);
    }
    gsl_matrix_free(F);
    gsl_vector_complex_free(s);
    gsl_matrix_complex_free(Y);
    if (work != NULL)
        gsl_eigen_nonsymmv_free(work);
    qdot_free(re);
    return status;
}
