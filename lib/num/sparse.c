/* sparse.c -- sparse LDL^T factorisation: minimum degree ordering, fill-in pattern, factorisation by rows. */
#include "num/sparse.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "num/sum.h"

/* A pivot below this fraction of its original entry may be the rounding error of 0. */
static const double semidefinite = 1e-12;

void
qdot_sparse_clear(qdot_sparse *s)
{
    qdot_free(s->order);
    qdot_free(s->given_start);
    qdot_free(s->row_start);
    qdot_free(s->column_start);
    qdot_free(s->given);
    qdot_free(s->row_column);
    qdot_free(s->row_at);
    qdot_free(s->column_row);
    qdot_free(s->L);
    qdot_free(s->inverse);
    qdot_free(s->y);
    qdot_free(s->low);
    *s = (qdot_sparse){0};
}

/* --- the order of elimination ------------------------------------------------------- */

/* The graph of the unknowns that are not eliminated yet; neighbours share an entry of the matrix. */
typedef struct {
    size_t n, positive;
    bool *beside;   /* [n x n] whether two unknowns are neighbours */
    size_t *degree; /* [n] number of neighbours; SIZE_MAX: eliminated */
    size_t *waits;  /* [n] number of neighbours among the positive unknowns */
    uint32_t *near; /* [n] scratch: the neighbours of one unknown */
} graph;

static void
join_unknowns(graph *g, uint32_t a, uint32_t b)
{
    if (a == b || g->beside[a * g->n + b])
        return;
    g->beside[a * g->n + b] = g->beside[b * g->n + a] = true;
    g->degree[a]++;
    g->degree[b]++;
    g->waits[a] += b < g->positive;
    g->waits[b] += a < g->positive;
}

static uint32_t
choose_next_pivot(const graph *g)
{
    uint32_t best = 0;
    size_t least = SIZE_MAX;

    for (uint32_t u = 0; u < g->n; u++)
        if (g->degree[u] < least && (u < g->positive || g->waits[u] == 0)) {
            least = g->degree[u];
            best = u;
        }
    return best;
}

/* Eliminate the unknown u: its neighbours become neighbours of each other; returns their number. */
static size_t
eliminate_unknown(graph *g, uint32_t u)
{
    size_t count = 0;

    for (uint32_t v = 0; v < g->n; v++)
        if (g->beside[u * g->n + v]) {
            g->near[count++] = v;
            g->beside[v * g->n + u] = false;
            g->degree[v]--;
            g->waits[v] -= u < g->positive;
        }
    g->degree[u] = SIZE_MAX;
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < i; j++)
            join_unknowns(g, g->near[i], g->near[j]);
    return count;
}

typedef qdot_vec(uint32_t) numbers;

/* Find the order of elimination, and the neighbours of each unknown at its elimination: the columns of L. */
static qdot_status
find_order(qdot_sparse *s, graph *g, numbers *columns)
{
    for (size_t k = 0; k < s->n; k++) {
        uint32_t u = choose_next_pivot(g);
        size_t count = eliminate_unknown(g, u);

        s->order[k] = u;
        s->column_start[k + 1] = s->column_start[k] + count;
        for (size_t i = 0; i < count; i++)
            QDOT_TRY(qdot_vec_push(columns, g->near[i]));
    }
    return QDOT_OK;
}

static qdot_status
find_sparse_order(qdot_sparse *s, size_t count, const qdot_sparse_entry *entries, numbers *columns)
{
    const size_t n = s->n;
    graph g = {.n = n, .positive = s->positive};
    qdot_status status = QDOT_ENOMEM;

    g.beside = qdot_calloc(n * n + 1, sizeof *g.beside);
    g.degree = qdot_calloc(n + 1, sizeof *g.degree);
    g.waits = qdot_calloc(n + 1, sizeof *g.waits);
    g.near = qdot_calloc(n + 1, sizeof *g.near);
    if (g.beside && g.degree && g.waits && g.near) {
        for (size_t i = 0; i < count; i++)
            join_unknowns(&g, entries[i].row, entries[i].column);
        status = find_order(s, &g, columns);
    }
    qdot_free(g.beside);
    qdot_free(g.degree);
    qdot_free(g.waits);
    qdot_free(g.near);
    return status;
}

/* --- the pattern of L --------------------------------------------------------------- */

static int
by_number(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;

    return (x > y) - (x < y);
}

static int
compare_by_row(const void *a, const void *b)
{
    const qdot_sparse_entry *x = a, *y = b;

    return (x->row > y->row) - (x->row < y->row);
}

static void
replace_counts_by_starts(size_t n, size_t *start)
{
    for (size_t k = 0; k < n; k++)
        start[k + 1] += start[k];
}

/* Store the columns of the factor L, each ascending by position, and the same entries by rows. */
static qdot_status
store_pattern(qdot_sparse *s, const uint32_t *place, const numbers *columns)
{
    const size_t n = s->n;
    size_t *at = qdot_calloc(n + 1, sizeof *at);

    s->filled = columns->n;
    s->column_row = qdot_calloc(s->filled + 1, sizeof *s->column_row);
    s->row_column = qdot_calloc(s->filled + 1, sizeof *s->row_column);
    s->row_at = qdot_calloc(s->filled + 1, sizeof *s->row_at);
    s->L = qdot_calloc(s->filled + 1, sizeof *s->L);
    if (!at || !s->column_row || !s->row_column || !s->row_at || !s->L) {
        qdot_free(at);
        return QDOT_ENOMEM;
    }
    for (size_t i = 0; i < s->filled; i++) {
        s->column_row[i] = place[columns->at[i]];
        s->row_start[s->column_row[i] + 1]++;
    }
    replace_counts_by_starts(n, s->row_start);
    memcpy(at, s->row_start, n * sizeof *at);
    for (size_t k = 0; k < n; k++) {
        size_t from = s->column_start[k], to = s->column_start[k + 1];

        qsort(s->column_row + from, to - from, sizeof *s->column_row, by_number);
        for (size_t i = from; i < to; i++) {
            size_t e = at[s->column_row[i]]++;

            s->row_column[e] = (uint32_t)k;
            s->row_at[e] = i;
        }
    }
    qdot_free(at);
    return QDOT_OK;
}

/* Store the given entries, permuted to the lower triangle, row by row. */
static qdot_status
store_entries(qdot_sparse *s, const uint32_t *place, size_t count,
              const qdot_sparse_entry *entries)
{
    s->given = qdot_calloc(count + 1, sizeof *s->given);
    if (!s->given)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < count; i++) {
        uint32_t a = place[entries[i].row], b = place[entries[i].column];

        s->given[i] = (qdot_sparse_entry){a > b ? a : b, a > b ? b : a, entries[i].value};
        s->given_start[s->given[i].row + 1]++;
    }
    qsort(s->given, count, sizeof *s->given, compare_by_row);
    replace_counts_by_starts(s->n, s->given_start);
    return QDOT_OK;
}

qdot_status
qdot_sparse_init(qdot_sparse *s, size_t n, size_t positive, size_t count,
                 const qdot_sparse_entry *entries)
{
    uint32_t *place = qdot_calloc(n + 1, sizeof *place);
    numbers columns = {0};
    qdot_status status = QDOT_ENOMEM;

    *s = (qdot_sparse){.n = n, .positive = positive};
    s->order = qdot_calloc(n + 1, sizeof *s->order);
    s->given_start = qdot_calloc(n + 2, sizeof *s->given_start);
    s->row_start = qdot_calloc(n + 2, sizeof *s->row_start);
    s->column_start = qdot_calloc(n + 2, sizeof *s->column_start);
    s->inverse = qdot_calloc(n + 1, sizeof *s->inverse);
    s->y = qdot_calloc(n + 1, sizeof *s->y);
    s->low = qdot_calloc(n + 1, sizeof *s->low);
    if (place && s->order && s->given_start && s->row_start && s->column_start &&
        s->inverse && s->y && s->low)
        status = find_sparse_order(s, count, entries, &columns);
    for (size_t k = 0; status == QDOT_OK && k < n; k++)
        place[s->order[k]] = (uint32_t)k;
    if (status == QDOT_OK)
        status = store_pattern(s, place, &columns);
    if (status == QDOT_OK)
        status = store_entries(s, place, count, entries);
    qdot_free(columns.at);
    qdot_free(place);
    return status;
}

/* --- factorisation and solution ----------------------------------------------------- */

/* Compute row k of L, and entry k of D; *made: the value from which D was computed, to judge its accuracy. */
static double
factor_row(qdot_sparse *s, size_t k, double *made)
{
    double d = 0, *y = s->y;

    for (size_t e = s->given_start[k]; e < s->given_start[k + 1]; e++) {
        if (s->given[e].column == k)
            d = *s->given[e].value;
        else
            y[s->given[e].column] = *s->given[e].value;
    }
    *made = fabs(d);
    for (size_t e = s->row_start[k]; e < s->row_start[k + 1]; e++) {
        const size_t i = s->row_column[e], end = s->row_at[e];
        const double x = y[i], l = x * s->inverse[i], change = l * x;

        y[i] = 0;
        for (size_t p = s->column_start[i]; p < end; p++)
            y[s->column_row[p]] -= s->L[p] * x;
        s->L[end] = l;
        d -= change;
        if (s->order[k] >= s->positive && change > 0)
            *made += change;
    }
    return d;
}

double
qdot_sparse_factor(qdot_sparse *s)
{
    double least = 1;

    s->definite = true;
    for (size_t k = 0; k < s->n; k++) {
        const bool positive = s->order[k] < s->positive;
        double made, d = factor_row(s, k, &made);
        double left = (positive ? d : -d) / made;

        if (positive && !(left > semidefinite))
            s->definite = false;
        if (!(left > 0 && left < INFINITY))
            return 0;
        least = left < least ? left : least;
        s->inverse[k] = 1 / d;
    }
    return least;
}

void
qdot_sparse_solve(const qdot_sparse *s, double *b)
{
    double *y = s->y;

    for (size_t k = 0; k < s->n; k++)
        y[k] = b[s->order[k]];
    for (size_t k = 0; k < s->n; k++)
        for (size_t p = s->column_start[k]; p < s->column_start[k + 1]; p++)
            y[s->column_row[p]] -= s->L[p] * y[k];
    for (size_t k = s->n; k-- > 0;) {
        double x = y[k] * s->inverse[k];

        for (size_t p = s->column_start[k]; p < s->column_start[k + 1]; p++)
            x -= s->L[p] * y[s->column_row[p]];
        y[k] = x;
        b[s->order[k]] = x;
    }
    memset(y, 0, s->n * sizeof *y);
}

/* Subtract a product from a number in two doubles: *hi + *low -= a x. */
static inline void
two_subtract_product(double a, double x, double *hi, double *low)
{
    double p = -a * x, rest = fma(-a, x, -p), lost;

    *hi = qdot_two_sum(*hi, p, &lost);
    *low += lost + rest;
}

void
qdot_sparse_subtract(const qdot_sparse *s, const double *x, double *b)
{
    memset(s->low, 0, s->n * sizeof *s->low);
    for (size_t e = 0; e < s->given_start[s->n]; e++) {
        const qdot_sparse_entry *g = s->given + e;
        const uint32_t i = s->order[g->row], j = s->order[g->column];

        two_subtract_product(*g->value, x[j], b + i, s->low + i);
        if (i != j)
            two_subtract_product(*g->value, x[i], b + j, s->low + j);
    }
    for (size_t i = 0; i < s->n; i++)
        b[i] += s->low[i];
}
