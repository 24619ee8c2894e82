/* sort.h -- sorts numbers in ascending order. */
#ifndef QDOT_NUM_SORT_H
#define QDOT_NUM_SORT_H

#include <stdlib.h>

static inline int
qdot_sort_compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;

    return (x > y) - (x < y);
}

/* Sort x [n], which contains no NaN, in ascending order. */
static inline void
qdot_sort(size_t n, double *x)
{
    if (n > 0)
        qsort(x, n, sizeof *x, qdot_sort_compare);
}

#endif
