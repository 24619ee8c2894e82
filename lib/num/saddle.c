/* saddle.c -- solves saddle-point systems: pivoted QR of A^T, projected M, complete orthogonal
 * decomposition. */
#include "num/saddle.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "num/cholesky.h"
#include "num/series.h"
#include "num/sum.h"

/* A row is dependent if its remainder is below the first number when the rank is found; the rank
 * is lost later if a remainder is below the second. */
static const double dependent = 1e-9, lost = 1e-13;

/* The sparse factors are used if the independence of the rows is above `trusted`, and above
 * `usual` times its largest value; above `more` times that value the null space checks it. */
static const double trusted = 1e-3, usual = 0.2, more = 1.25;

/* A mass below the first fraction of the largest is rounding; the scale of an unknown follows its
 * mass down to the second fraction of its largest. */
static const double nothing = 0x1p-92, lightest = 0x1p-14;

/* The scale of a row that others may replace follows its size down to this fraction of its
 * largest. */
static const double shrunk = 0x1p-10;

/* Up to this many unknowns the inverse is computed if there are many right-hand sides. */
enum { most_inverted = 24, lanes = 8 };

static double
multiplier_weight(const qdot_saddle *s, size_t k)
{
    return s->weight ? s->weight[k] : 1;
}

static size_t
padded_row_width(const qdot_saddle *s)
{
    return (s->n + s->m + lanes - 1) / lanes * lanes;
}

qdot_status
qdot_saddle_init(qdot_saddle *s, size_t n, size_t m, bool indefinite)
{
    const size_t all = n + m + lanes;
    bool inverted = n + m <= most_inverted;

    *s = (qdot_saddle){.n = n, .m = m, .rank = QDOT_SADDLE_UNKNOWN, .quality = 1};
    s->indefinite = indefinite;
    s->M = qdot_calloc(n * n, sizeof *s->M);
    s->A = qdot_calloc(m * n + 1, sizeof *s->A);
    s->x = qdot_calloc(all, sizeof *s->x);
    s->pivot = qdot_calloc(m + 1, sizeof *s->pivot);
    s->widest = qdot_calloc(m + 1, sizeof *s->widest);
    s->heaviest = qdot_calloc(n, sizeof *s->heaviest);
    s->d = qdot_calloc(n, sizeof *s->d);
    s->e = qdot_calloc(m + 1, sizeof *s->e);
    s->S = qdot_calloc(n * n, sizeof *s->S);
    s->Q = qdot_calloc(n * n, sizeof *s->Q);
    s->R = qdot_calloc(m * n + 1, sizeof *s->R);
    s->beta = qdot_calloc(m + 1, sizeof *s->beta);
    s->N = qdot_calloc(n * n, sizeof *s->N);
    s->V = qdot_calloc(m * m + 1, sizeof *s->V);
    s->T = qdot_calloc(m * m + 1, sizeof *s->T);
    s->u = qdot_calloc(all, sizeof *s->u);
    s->w = qdot_calloc(all, sizeof *s->w);
    s->y = qdot_calloc(all, sizeof *s->y);
    s->keep = qdot_calloc(all, sizeof *s->keep);
    if (inverted)
        s->inverse = qdot_calloc(padded_row_width(s) * (n + m), sizeof *s->inverse);
    s->start = qdot_calloc(m + 1, sizeof *s->start);
    s->column = qdot_calloc(m * n + 1, sizeof *s->column);
    if (!s->start || !s->column || !s->M || !s->A || !s->x || !s->pivot || !s->widest ||
        !s->heaviest || !s->d || !s->e || !s->S || !s->Q ||
        !s->R || !s->beta || !s->N || !s->V || !s->T || !s->u || !s->w || !s->y ||
        !s->keep || (inverted && !s->inverse))
        return QDOT_ENOMEM;
    for (size_t e = 0; e < m * n; e++)
        s->column[e] = (uint32_t)(e % n);
    for (size_t k = 0; k <= m; k++)
        s->start[k] = k * n;
    return qdot_ldlt_init(&s->ldlt, n);
}

void
qdot_saddle_clear(qdot_saddle *s)
{
    double *arrays[] = {s->M, s->A, s->x, s->d, s->e, s->S, s->Q,       s->R,
                        s->beta, s->N, s->V, s->T, s->u, s->w, s->y, s->keep,
                        s->inverse, s->widest, s->heaviest};

    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        qdot_free(arrays[i]);
    qdot_free(s->pivot);
    qdot_free(s->start);
    qdot_free(s->column);
    qdot_ldlt_clear(&s->ldlt);
    qdot_sparse_clear(&s->sparse);
    *s = (qdot_saddle){0};
}

/* --- the sparsity pattern ----------------------------------------------------------- */

qdot_status
qdot_saddle_pattern(qdot_saddle *s, size_t masses, const qdot_saddle_entry *of_M,
                    size_t slopes, const qdot_saddle_entry *of_A)
{
    const size_t n = s->n;
    qdot_sparse_entry *all = qdot_calloc(masses + slopes + 1, sizeof *all);
    qdot_status status;

    if (!all)
        return QDOT_ENOMEM;
    for (size_t e = 0; e < masses; e++)
        all[e] = (qdot_sparse_entry){of_M[e].row, of_M[e].column,
                                     s->M + of_M[e].row * n + of_M[e].column};
    memset(s->start, 0, (s->m + 1) * sizeof *s->start);
    for (size_t e = 0; e < slopes; e++) {
        all[masses + e] =
            (qdot_sparse_entry){(uint32_t)(n + of_A[e].row), of_A[e].column,
                                s->A + of_A[e].row * n + of_A[e].column};
        s->column[e] = of_A[e].column;
        s->start[of_A[e].row + 1]++;
    }
    for (size_t k = 0; k < s->m; k++)
        s->start[k + 1] += s->start[k];
    status = qdot_sparse_init(&s->sparse, n + s->m, n, masses + slopes, all);
    s->patterned = status == QDOT_OK && !s->indefinite;
    qdot_free(all);
    return status;
}

double
qdot_saddle_row(const qdot_saddle *s, size_t k, const double *x)
{
    const double *A = s->A + k * s->n;
    double sum = 0;

    for (size_t e = s->start[k]; e < s->start[k + 1]; e++)
        sum += A[s->column[e]] * x[s->column[e]];
    return sum;
}

double
qdot_saddle_row_size(const qdot_saddle *s, size_t k, const double *x, double least)
{
    const double *A = s->A + k * s->n;
    double sum = 0;

    for (size_t e = s->start[k]; e < s->start[k + 1]; e++) {
        const double size = fabs(x[s->column[e]]);

        sum += fabs(A[s->column[e]]) * (size > least ? size : least);
    }
    return sum;
}

static double
dot_product(size_t n, const double *a, const double *b)
{
    double sum = 0;

    for (size_t i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

static void
add_multiple(size_t n, double c, const double *a, double *y)
{
    for (size_t i = 0; i < n; i++)
        y[i] += c * a[i];
}

/* --- factorisation of the system ---------------------------------------------------- */

/* A power of two that scales x to about 1; if `root`, one whose square does; 1 for x = 0. */
static double
scale_to_one(double x, bool root)
{
    int k = x > 0 && isfinite(x) ? ilogb(x) : 0;

    return ldexp(1, -(root ? k / 2 : k));
}

/* By each unknown's mass, or by the least of what it was; one that never had a mass counts
 * as the heaviest. */
static void
scale_unknowns(qdot_saddle *s)
{
    double most = 0;

    for (size_t i = 0; i < s->n; i++)
        most = fmax(most, fabs(s->M[i * s->n + i]));
    for (size_t i = 0; i < s->n; i++) {
        double mass = fabs(s->M[i * s->n + i]), *was = s->heaviest + i;

        if (!(mass > nothing * most))
            mass = 0;
        *was = fmax(*was, mass);
        if (*was == 0)
            *was = most;
        s->d[i] = scale_to_one(fmax(mass, lightest * *was), true);
    }
}

/* The size by which row k of A D, which has the norm `norm`, is scaled; greater if the row has shrunk much. */
static double
reference_size_of_row(const qdot_saddle *s, size_t k, double norm)
{
    const double *A = s->A + k * s->n;
    double least;

    if (s->rank == s->m || !(norm > 0))
        return norm;
    least = shrunk * sqrt(s->widest[k] / dot_product(s->n, A, A));
    return least > 1 ? least * norm : norm;
}

/* Compute S = D M D and the rows of R = E A D, where D and E are diagonal scales. */
static void
scale_matrices(qdot_saddle *s)
{
    const size_t n = s->n;

    scale_unknowns(s);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            s->S[i * n + j] = s->d[i] * s->M[i * n + j] * s->d[j];
    for (size_t k = 0; k < s->m; k++) {
        double *row = s->R + k * n;

        for (size_t i = 0; i < n; i++)
            row[i] = s->A[k * n + i] * s->d[i];
        s->e[k] = scale_to_one(reference_size_of_row(s, k, sqrt(dot_product(n, row, row))), false);
        for (size_t i = 0; i < n; i++)
            row[i] *= s->e[k];
        s->pivot[k] = k;
    }
}

/* Move the remaining column of largest norm to position k as pivot; returns its norm. */
static double
choose_pivot_column(qdot_saddle *s, size_t k)
{
    const size_t n = s->n;
    double most = -1;
    size_t best = k;

    for (size_t j = k; j < s->m; j++) {
        double norm = dot_product(n - k, s->R + j * n + k, s->R + j * n + k);

        if (norm > most) {
            most = norm;
            best = j;
        }
    }
    if (best != k) {
        size_t row = s->pivot[k];

        s->pivot[k] = s->pivot[best];
        s->pivot[best] = row;
        for (size_t i = 0; i < n; i++) {
            double x = s->R[k * n + i];

            s->R[k * n + i] = s->R[best * n + i];
            s->R[best * n + i] = x;
        }
    }
    return sqrt(most);
}

/* Apply a reflection: x -= beta v (v . x) with v = (1, column k below its diagonal). */
static void
apply_reflection(const qdot_saddle *s, size_t k, double *x)
{
    const double *v = s->R + k * s->n;
    double sum = x[k] + dot_product(s->n - k - 1, v + k + 1, x + k + 1);

    sum *= s->beta[k];
    x[k] -= sum;
    add_multiple(s->n - k - 1, -sum, v + k + 1, x + k + 1);
}

/* Apply the Householder reflection that eliminates column k below row k, where it has the given norm. */
static void
reflect_column(qdot_saddle *s, size_t k, double norm)
{
    const size_t n = s->n;
    double *column = s->R + k * n, head = column[k];
    double diagonal = head > 0 ? -norm : norm;

    if (norm == 0) {
        s->beta[k] = 0;
        return;
    }
    s->beta[k] = (diagonal - head) / diagonal;
    for (size_t i = k + 1; i < n; i++)
        column[i] /= head - diagonal;
    column[k] = diagonal;
    for (size_t j = k + 1; j < s->m; j++)
        apply_reflection(s, k, s->R + j * n);
}

/* Factor A^T by Householder reflections: find the triangle R, the reflections and the rank. */
static qdot_status
factor_constraints(qdot_saddle *s, size_t *failed)
{
    const size_t n = s->n, most = s->m < n ? s->m : n;
    const bool known = s->rank != QDOT_SADDLE_UNKNOWN;
    double first = 0, norm = 0;
    size_t k;

    s->quality = 1;
    s->surplus = 0;
    for (k = 0; k < most; k++) {
        QDOT_TRY(qdot_interrupt_check());
        norm = choose_pivot_column(s, k);
        if (!isfinite(norm))
            break;
        if (k == 0)
            first = norm;
        if (known ? k == s->rank : !(norm > dependent * first)) {
            s->surplus = first > 0 ? norm / first : 0;
            break;
        }
        s->quality = first > 0 ? norm / first : 0;
        if (known && !(norm > lost * first))
            break;
        reflect_column(s, k, norm);
    }
    s->last = k;
    if (!isfinite(norm) || (known && k < s->rank)) {
        *failed = n + (k < s->m ? s->pivot[k] : 0);
        return qdot_fail(QDOT_ESINGULAR, "the rows of the constraints are dependent");
    }
    s->rank = k;
    s->last = k > 0 ? k - 1 : 0;
    return QDOT_OK;
}

static void
form_Q(qdot_saddle *s)
{
    const size_t n = s->n;

    memset(s->Q, 0, n * n * sizeof *s->Q);
    for (size_t j = 0; j < n && !qdot_interrupt_is_set(); j++) {
        double *column = s->Q + j * n;

        column[j] = 1;
        for (size_t k = s->rank; k-- > 0;) /* multiply the reflections: Q e_j = H_1 ... H_r e_j */
            apply_reflection(s, k, column);
    }
}

/* Multiply by the scaled mass matrix: y = S x. */
static void
multiply_by_mass(const qdot_saddle *s, const double *x, double *y)
{
    for (size_t i = 0; i < s->n; i++)
        y[i] = dot_product(s->n, s->S + i * s->n, x);
}

static qdot_status
factor_in_null_space(qdot_saddle *s, size_t *failed)
{
    const size_t n = s->n, r = s->rank, f = n - r;
    size_t where = 0;
    qdot_status status;

    for (size_t j = 0; j < f; j++) {
        QDOT_TRY(qdot_interrupt_check());
        multiply_by_mass(s, s->Q + (r + j) * n, s->w);
        for (size_t i = j; i < f; i++)
            s->N[i * f + j] = dot_product(n, s->Q + (r + i) * n, s->w);
    }
    if (f == 0)
        return qdot_interrupt_check();
    s->ldlt.n = f;
    status = s->indefinite ? qdot_ldlt_factor(&s->ldlt, s->N, &where)
                           : qdot_cholesky_factor(s->N, f, NULL, &where);
    if (status == QDOT_OK)
        return QDOT_OK;
    /* report the unknown that moves most in the direction in which the matrix is singular */
    *failed = 0;
    for (size_t i = 1; i < n; i++)
        if (fabs(s->Q[(r + where) * n + i]) > fabs(s->Q[(r + where) * n + *failed]))
            *failed = i;
    return status;
}

/* R E^-1 W (unscaled multipliers over their weights) = T^T V^T, V's columns orthonormal, by
 * Gram-Schmidt twice. V by columns, T by rows. */
static void
orthogonalise_multipliers(qdot_saddle *s)
{
    const size_t m = s->m, r = s->rank;

    for (size_t j = 0; j < r; j++) {
        double *v = s->V + j * m, norm;

        for (size_t k = 0; k < m; k++)
            v[k] = k < j ? 0
                         : s->R[k * s->n + j] / s->e[s->pivot[k]] * multiplier_weight(s, s->pivot[k]);
        for (size_t i = 0; i < j; i++)
            s->T[i * m + j] = 0;
        for (int twice = 0; twice < 2; twice++)
            for (size_t i = 0; i < j; i++) {
                double c = dot_product(m, s->V + i * m, v);

                s->T[i * m + j] += c;
                add_multiple(m, -c, s->V + i * m, v);
            }
        norm = sqrt(dot_product(m, v, v));
        s->T[j * m + j] = norm;
        for (size_t k = 0; k < m; k++)
            v[k] /= norm;
    }
}

/* Factor by the pattern and return the independence of the rows; without a mass somewhere the
 * pattern is not used again. */
static double
factor_sparse(qdot_saddle *s)
{
    const double left = sqrt(qdot_sparse_factor(&s->sparse));

    s->patterned = s->sparse.definite;
    return left;
}

/* Factor by the sparsity pattern of M and A; false if that is impossible or not accurate enough. */
static bool
factor_sparse_if_accurate(qdot_saddle *s)
{
    const bool known = s->rank == s->m;
    double left;

    if (!s->patterned || (!known && s->rank != QDOT_SADDLE_UNKNOWN))
        return false;
    left = factor_sparse(s);
    if (!s->patterned)
        return false;
    if (left > more * s->record) {
        s->record = left;
        return false;
    }
    return known && left > trusted && left > usual * s->record;
}

qdot_status
qdot_saddle_factor_fully(qdot_saddle *s, size_t *failed)
{
    s->factored++;
    s->direct = false;
    scale_matrices(s);
    QDOT_TRY(factor_constraints(s, failed));
    form_Q(s);
    QDOT_TRY(factor_in_null_space(s, failed));
    if (s->rank < s->m)
        orthogonalise_multipliers(s);
    return QDOT_OK;
}

qdot_status
qdot_saddle_factor(qdot_saddle *s, size_t *failed)
{
    if (!factor_sparse_if_accurate(s))
        return qdot_saddle_factor_fully(s, failed);
    s->factored++;
    s->direct = true;
    return QDOT_OK;
}

double
qdot_saddle_independence(qdot_saddle *s)
{
    const size_t factored = s->factored;
    qdot_error before = *qdot_last_error();
    size_t failed;
    double found = 0;

    if (s->patterned && s->rank == s->m) {
        found = factor_sparse(s);
        if (s->patterned)
            return found;
        found = 0;
    }
    if (qdot_saddle_factor_fully(s, &failed) == QDOT_OK)
        found = s->rank > 0 ? s->quality : 1;
    else
        qdot_fail_again(&before);
    s->factored = factored;
    return found;
}

/* --- solution of the system --------------------------------------------------------- */

/* Find the Lagrange multipliers mu in original scale from u = Y^T (b - M x). */
static void
multipliers(qdot_saddle *s, double *u, double *mu)
{
    const size_t n = s->n, m = s->m, r = s->rank;

    if (r == m) {
        for (size_t j = r; j-- > 0;) {
            for (size_t k = j + 1; k < r; k++)
                u[j] -= s->R[k * n + j] * u[k];
            u[j] /= s->R[j * n + j];
            mu[s->pivot[j]] = u[j] * s->e[s->pivot[j]];
        }
        return;
    }
    for (size_t j = 0; j < r; j++) {
        for (size_t i = 0; i < j; i++)
            u[j] -= s->T[i * m + j] * u[i];
        u[j] /= s->T[j * m + j];
    }
    for (size_t k = 0; k < m; k++) {
        double sum = 0;

        for (size_t j = 0; j < r; j++)
            sum += s->V[j * m + k] * u[j];
        mu[s->pivot[k]] = sum * multiplier_weight(s, s->pivot[k]);
    }
}

/* Solve the system by the null space of A. */
static void
solve_in_null_space(qdot_saddle *s)
{
    const size_t n = s->n, r = s->rank, f = n - r;
    double *x = s->x, *c = s->x + n, *u = s->u, *w = s->w, *y = s->y;

    for (size_t j = 0; j < r; j++) {
        double sum = c[s->pivot[j]] * s->e[s->pivot[j]];

        for (size_t i = 0; i < j; i++)
            sum -= s->R[j * n + i] * u[i];
        u[j] = sum / s->R[j * n + j];
    }
    memset(y, 0, n * sizeof *y);
    for (size_t j = 0; j < r; j++)
        add_multiple(n, u[j], s->Q + j * n, y);
    for (size_t i = 0; i < n; i++)
        x[i] *= s->d[i];
    if (f > 0) {
        multiply_by_mass(s, y, w);
        for (size_t i = 0; i < n; i++)
            w[i] = x[i] - w[i];
        for (size_t j = 0; j < f; j++)
            u[j] = dot_product(n, s->Q + (r + j) * n, w);
        if (s->indefinite)
            qdot_ldlt_solve(&s->ldlt, s->N, u);
        else
            qdot_cholesky_solve(s->N, f, NULL, u);
        for (size_t j = 0; j < f; j++)
            add_multiple(n, u[j], s->Q + (r + j) * n, y);
    }
    multiply_by_mass(s, y, w);
    for (size_t i = 0; i < n; i++)
        w[i] = x[i] - w[i];
    for (size_t j = 0; j < r; j++)
        u[j] = dot_product(n, s->Q + j * n, w);
    for (size_t i = 0; i < n; i++)
        x[i] = y[i] * s->d[i];
    multipliers(s, u, c);
}

void
qdot_saddle_solve(qdot_saddle *s)
{
    if (s->direct)
        qdot_sparse_solve(&s->sparse, s->x);
    else
        solve_in_null_space(s);
}

/* Add the product a b to a sum, in twice the precision. */
static void
add_product(qdot_sum *sum, double a, double b)
{
    double p = a * b;

    qdot_sum_add(sum, p);
    sum->carry += fma(a, b, -p);
}

/* Subtract K x from the right-hand side b, in twice the precision. */
static void
subtract_product(const qdot_saddle *s, const double *x, double *b)
{
    const size_t n = s->n, m = s->m;

    for (size_t i = 0; i < n + m; i++) {
        qdot_sum left = {.sum = b[i]};

        for (size_t j = 0; j < n; j++)
            add_product(&left, i < n ? -s->M[i * n + j] : -s->A[(i - n) * n + j], x[j]);
        for (size_t k = 0; i < n && k < m; k++)
            add_product(&left, -s->A[k * n + i], x[n + k]);
        b[i] = qdot_sum_value(&left);
    }
}

void
qdot_saddle_solve_refined(qdot_saddle *s)
{
    const size_t all = s->n + s->m;
    double *x = s->x, *b = s->keep;

    memcpy(b, x, all * sizeof *b);
    qdot_saddle_solve(s);
    if (s->direct)
        qdot_sparse_subtract(&s->sparse, x, b);
    else
        subtract_product(s, x, b);
    for (size_t i = 0; i < all; i++) {
        double first = x[i];

        x[i] = b[i];
        b[i] = first;
    }
    qdot_saddle_solve(s);
    add_multiple(all, 1, b, x);
}

void
qdot_saddle_prepare(qdot_saddle *s)
{
    const size_t all = s->n + s->m, w = padded_row_width(s);

    for (size_t j = 0; s->inverse && j < all; j++) {
        memset(s->x, 0, all * sizeof *s->x);
        s->x[j] = 1;
        qdot_saddle_solve(s);
        memcpy(s->inverse + j * w, s->x, all * sizeof *s->x);
    }
}

void
qdot_saddle_apply(qdot_saddle *s)
{
    const size_t all = s->n + s->m;

    if (!s->inverse) {
        qdot_saddle_solve(s);
        return;
    }
    qdot_series_kernels_get()->multiply(padded_row_width(s), all, s->inverse, s->x, s->keep);
    memcpy(s->x, s->keep, all * sizeof *s->x);
}
