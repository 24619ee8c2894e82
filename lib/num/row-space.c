/* row-space.c -- the row space of a matrix, by LQ factorisation with pivoting. */
#include "num/row-space.h"

#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"

void
qdot_row_space_clear(qdot_row_space *f)
{
    qdot_free(f->order);
    qdot_free(f->rows);
    qdot_free(f->diagonal);
    qdot_free(f->size);
    qdot_free(f->beta);
    qdot_free(f->z);
    *f = (qdot_row_space){0};
}

qdot_status
qdot_row_space_init(qdot_row_space *f, size_t m, size_t n)
{
    *f = (qdot_row_space){.m = m, .n = n};
    f->order = qdot_calloc(m + 1, sizeof *f->order);
    f->rows = qdot_calloc(m * n + 1, sizeof *f->rows);
    f->diagonal = qdot_calloc(m + 1, sizeof *f->diagonal);
    f->size = qdot_calloc(m + 1, sizeof *f->size);
    f->beta = qdot_calloc(m + 1, sizeof *f->beta);
    f->z = qdot_calloc(m + n + 1, sizeof *f->z);
    if (f->order && f->rows && f->diagonal && f->size && f->beta && f->z)
        return QDOT_OK;
    qdot_row_space_clear(f);
    return QDOT_ENOMEM;
}

static double
vector_length(const double *x, size_t n)
{
    double most = 0, sum = 0;

    for (size_t i = 0; i < n; i++)
        most = fmax(most, fabs(x[i]));
    if (!(most > 0) || !isfinite(most))
        return most;
    for (size_t i = 0; i < n; i++)
        sum += (x[i] / most) * (x[i] / most);
    return most * sqrt(sum);
}

/* Apply a reflection: x [n] -= beta (v . x) v. */
static void
apply_reflection(const double *v, double beta, size_t n, double *x)
{
    double dot = 0;

    for (size_t i = 0; i < n; i++)
        dot += v[i] * x[i];
    dot *= beta;
    for (size_t i = 0; i < n; i++)
        x[i] -= dot * v[i];
}

/* The next row to factor: the first whose remainder exceeds tol, or that with the largest remainder; m if none. */
static size_t
next_row(const qdot_row_space *f, size_t k, double tol, bool in_order)
{
    size_t best = f->m;
    double most = tol;

    for (size_t i = k; i < f->m; i++) {
        double left = vector_length(f->rows + f->order[i] * f->n + k, f->n - k);

        if (!(left > most))
            continue;
        best = i;
        if (in_order)
            break;
        most = left;
    }
    return best;
}

void
qdot_row_space_factor(qdot_row_space *f, const double *A, double tol, bool in_order)
{
    size_t n = f->n;

    memcpy(f->rows, A, f->m * n * sizeof *f->rows);
    for (size_t i = 0; i < f->m; i++) {
        f->order[i] = i;
        f->size[i] = vector_length(A + i * n, n);
        for (size_t j = 0; j < n && f->size[i] > 0; j++)
            f->rows[i * n + j] /= f->size[i];
    }
    for (f->rank = 0; f->rank < f->m && f->rank < n; f->rank++) {
        size_t k = f->rank, next = next_row(f, k, tol, in_order), row;
        double *v, norm, head;

        if (next == f->m || qdot_interrupt_is_set())
            break;
        row = f->order[next];
        memmove(f->order + k + 1, f->order + k, (next - k) * sizeof *f->order);
        f->order[k] = row;
        v = f->rows + row * n + k;
        norm = v[0] > 0 ? -vector_length(v, n - k) : vector_length(v, n - k);
        head = v[0] - norm;
        /* the Householder vector v = row - norm e_1, whose reflection maps the row to norm e_1 */
        f->beta[row] = -1 / (norm * head);
        v[0] = head;
        for (size_t i = k + 1; i < f->m; i++)
            apply_reflection(v, f->beta[row], n - k, f->rows + f->order[i] * n + k);
        f->diagonal[row] = norm;
    }
}

/* Replace x by Q (z, 0), that is, from the coordinates of the orthogonal factor Q to the original ones. */
static void
multiply_by_q(const qdot_row_space *f, double *x)
{
    for (size_t k = f->rank; k-- > 0;) {
        size_t row = f->order[k];

        apply_reflection(f->rows + row * f->n + k, f->beta[row], f->n - k, x + k);
    }
}

void
qdot_row_space_shortest(qdot_row_space *f, const double *b, double *x, double *lambda)
{
    size_t n = f->n, rank = f->rank;
    double *z = f->z;

    for (size_t k = 0; k < rank; k++) {
        size_t row = f->order[k];
        double v = b[row] / f->size[row];

        for (size_t j = 0; j < k; j++)
            v -= f->rows[row * n + j] * z[j];
        z[k] = v / f->diagonal[row];
    }
    memset(x, 0, n * sizeof *x);
    memcpy(x, z, rank * sizeof *x);
    multiply_by_q(f, x);
    if (!lambda)
        return;
    memset(lambda, 0, f->m * sizeof *lambda);
    for (size_t k = rank; k-- > 0;) {
        size_t row = f->order[k];
        double v = z[k];

        for (size_t j = k + 1; j < rank; j++)
            v -= f->rows[f->order[j] * n + k] * z[j];
        z[k] = v / f->diagonal[row];
        lambda[row] = z[k] / f->size[row];
    }
}

void
qdot_row_space_tangent(qdot_row_space *f, double *x)
{
    for (size_t k = 0; k < f->rank; k++) {
        size_t row = f->order[k];

        apply_reflection(f->rows + row * f->n + k, f->beta[row], f->n - k, x + k);
    }
    memset(x, 0, f->rank * sizeof *x);
    multiply_by_q(f, x);
}
