/* groups.c -- products of powers without dimension: a basis of integer exponents, made short. */
#include "dimensions/groups.h"

#include <string.h>

#include "base/memory.h"

/* Rows: what must vanish; columns: the x. Reduced to echelon form in place; pivot[i]: the column of row i. */
static bool
reduce_rows(size_t rows, size_t n, qdot_exponent *a, size_t *rank, size_t *pivot)
{
    const qdot_exponent zero = {0, 1};

    *rank = 0;
    for (size_t k = 0; k < n && *rank < rows; k++) {
        size_t i = *rank;
        qdot_exponent inverse;

        while (i < rows && a[i * n + k].n == 0)
            i++;
        if (i == rows)
            continue;
        for (size_t j = 0; j < n; j++) {
            const qdot_exponent swap = a[i * n + j];

            a[i * n + j] = a[*rank * n + j];
            a[*rank * n + j] = swap;
        }
        inverse = a[*rank * n + k];
        inverse = qdot_exponent_make(inverse.n < 0 ? -(int64_t)inverse.d : inverse.d, inverse.n < 0 ? -(int64_t)inverse.n : inverse.n);
        for (size_t j = 0; j < n; j++)
            a[*rank * n + j] = qdot_exponent_addmul(zero, a[*rank * n + j], inverse);
        for (size_t r = 0; r < rows; r++) {
            const qdot_exponent factor = {-a[r * n + k].n, a[r * n + k].d};

            for (size_t j = 0; r != *rank && factor.n != 0 && j < n; j++)
                a[r * n + j] = qdot_exponent_addmul(a[r * n + j], a[*rank * n + j], factor);
        }
        pivot[(*rank)++] = k;
    }
    for (size_t i = 0; i < rows * n; i++)
        if (a[i].d == 0)
            return false;
    return true;
}

/* How long a group is to read: its symbols, then its powers. */
static int64_t
length_of(size_t n, const int32_t *p)
{
    int64_t length = 0;

    for (size_t i = 0; i < n; i++)
        length += p[i] == 0 ? 0 : 8 + (p[i] < 0 ? -(int64_t)p[i] : p[i]);
    return length;
}

/* Divide the exponents by their greatest common divisor: with x^2/y^2 x/y has no dimension either. */
static void
divide_by_common_factor(size_t n, int32_t *power)
{
    int64_t divisor = 0;

    for (size_t i = 0; i < n; i++)
        for (int64_t x = power[i] < 0 ? -(int64_t)power[i] : power[i]; x != 0;) {
            const int64_t rest = divisor % x;

            divisor = x;
            x = rest;
        }
    for (size_t i = 0; i < n && divisor > 1; i++)
        power[i] /= (int32_t)divisor;
}

/* Replace groups by products of two of them while that makes one shorter. */
static void
shorten_groups(size_t count, size_t n, int32_t *power, int32_t *trial)
{
    bool again = true;

    while (again) {
        again = false;
        for (size_t i = 0; i < count; i++)
            for (size_t k = 0; k < count; k++)
                for (int s = -1; s <= 1 && i != k; s += 2) {
                    for (size_t j = 0; j < n; j++)
                        trial[j] = power[i * n + j] + s * power[k * n + j];
                    divide_by_common_factor(n, trial);
                    if (length_of(n, trial) < length_of(n, power + i * n)) {
                        memcpy(power + i * n, trial, n * sizeof *trial);
                        again = true;
                    }
                }
    }
}

/* Turn groups over so that more factors stand above the bar than below it, or, where they are as many, the first one above; sort
 * the groups, the shortest first. */
static void
order_groups(size_t count, size_t n, int32_t *power, int32_t *trial)
{
    for (size_t i = 0; i < count; i++) {
        int64_t sum = 0;
        size_t first = n;

        for (size_t j = n; j-- > 0;) {
            sum += power[i * n + j] > 0 ? 1 : power[i * n + j] < 0 ? -1 : 0;
            first = power[i * n + j] != 0 ? j : first;
        }
        if (sum < 0 || (sum == 0 && first < n && power[i * n + first] < 0))
            for (size_t j = 0; j < n; j++)
                power[i * n + j] = -power[i * n + j];
    }
    for (size_t i = 1; i < count; i++) {
        size_t k = i;

        memcpy(trial, power + i * n, n * sizeof *trial);
        for (; k > 0 && length_of(n, power + (k - 1) * n) > length_of(n, trial); k--)
            memcpy(power + k * n, power + (k - 1) * n, n * sizeof *trial);
        memcpy(power + k * n, trial, n * sizeof *trial);
    }
}

/* The group with the free column k, all others 0: integers without a common factor. */
static bool
group_of_column(size_t n, const qdot_exponent *a, size_t rank, const size_t *pivot, size_t k, int32_t *power)
{
    int64_t common = 1;

    for (size_t i = 0; i < rank; i++) {
        const qdot_exponent part = qdot_exponent_make(a[i * n + k].d, common);

        common = part.d == 0 ? 0 : (int64_t)part.n * common; /* their least common multiple */
        if (common == 0 || common > INT32_MAX)
            return false;
    }
    memset(power, 0, n * sizeof *power);
    power[k] = (int32_t)common;
    for (size_t i = 0; i < rank; i++) {
        const int64_t value = -(int64_t)a[i * n + k].n * (common / a[i * n + k].d);

        if (value > INT32_MAX || value < -INT32_MAX)
            return false;
        power[pivot[i]] = (int32_t)value;
    }
    divide_by_common_factor(n, power);
    return true;
}

qdot_status
qdot_groups_find(size_t rows, size_t n, qdot_exponent *a, size_t *count, int32_t **power)
{
    size_t *pivot = qdot_calloc(n + 1, sizeof *pivot), rank = 0, at = 0;
    bool exact;

    *count = 0;
    *power = NULL;
    if (pivot == NULL)
        return QDOT_ENOMEM;
    exact = reduce_rows(rows, n, a, &rank, pivot);
    *power = qdot_calloc((n - rank + 1) * n + 1, sizeof **power); /* a row more, for trials */
    for (size_t k = 0; k < n && *power != NULL && exact; k++) {
        if (at < rank && pivot[at] == k) {
            at++;
            continue;
        }
        exact = group_of_column(n, a, rank, pivot, k, *power + *count * n);
        ++*count;
    }
    qdot_free(pivot);
    if (*power == NULL)
        return QDOT_ENOMEM;
    if (!exact)
        return qdot_fail(QDOT_ELIMIT, "the exponents of dimensions grow too large");
    shorten_groups(*count, n, *power, *power + *count * n);
    order_groups(*count, n, *power, *power + *count * n);
    return QDOT_OK;
}
