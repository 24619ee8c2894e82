/* long-sum.c -- finds which terms of a long sum hold which coordinate. */
#include "mech/dynamics/long-sum.h"

#include <stdlib.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "mech/scene/cache.h"

enum { long_from = 32 };

/* A coordinate with its number, in the order of symbols. */
typedef struct {
    qdot_expr symbol;
    uint32_t i;
} numbered;

typedef struct {
    uint32_t i, term; /* term `term` of the sum holds coordinate i */
} holding;

static int
compare_symbols(const void *left, const void *right)
{
    const numbered *a = left, *b = right;

    return a->symbol < b->symbol ? -1 : a->symbol > b->symbol;
}

/* All pairs of a coordinate and a term of V that holds it. */
typedef struct {
    numbered *coordinates; /* [n] sorted */
    size_t n;
    qdot_vec(holding) pairs;
} search;

static qdot_status
note_coordinates_of_term(search *f, const qdot_pool *pool, qdot_expr term, uint32_t number)
{
    qdot_status status = QDOT_OK;
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin(pool, term, &w));
    for (size_t k = 0; k < w.n && status == QDOT_OK; k++) {
        const numbered key = {.symbol = w.at[k]};
        const numbered *found = qdot_expr_kind(pool, w.at[k]) == QDOT_SYM
                                    ? bsearch(&key, f->coordinates, f->n, sizeof key, compare_symbols)
                                    : NULL;

        if (found)
            status = qdot_vec_push(&f->pairs, ((holding){found->i, number}));
    }
    qdot_walk_end(&w);
    return status;
}

static qdot_status
find_terms(search *f, const qdot_scene *s, qdot_expr V)
{
    f->n = s->coordinates.n;
    f->coordinates = qdot_calloc(f->n + 1, sizeof *f->coordinates);
    if (!f->coordinates)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < f->n; i++)
        f->coordinates[i] = (numbered){s->coordinates.at[i], (uint32_t)i};
    qsort(f->coordinates, f->n, sizeof *f->coordinates, compare_symbols);
    for (uint32_t k = 1; k < qdot_expr_count(s->pool, V); k += 2)
        QDOT_TRY(note_coordinates_of_term(f, s->pool, qdot_expr_arg(s->pool, V, k), k));
    return QDOT_OK;
}

/* Set part[i] to the sum of the terms that hold coordinate i. */
static qdot_status
make_parts(search *f, qdot_pool *pool, qdot_expr V, qdot_expr *part)
{
    size_t *first = qdot_calloc(f->n + 2, sizeof *first);
    qdot_expr *terms = qdot_calloc(f->pairs.n + 1, sizeof *terms);

    for (size_t k = 0; first && terms && k < f->pairs.n; k++)
        first[f->pairs.at[k].i + 2]++;
    for (size_t i = 2; first && terms && i < f->n + 2; i++)
        first[i] += first[i - 1];
    for (size_t k = 0; first && terms && k < f->pairs.n; k++) {
        const uint32_t at = f->pairs.at[k].term;

        terms[first[f->pairs.at[k].i + 1]++] = qdot_mul(pool, qdot_expr_arg(pool, V, at + 1), qdot_expr_arg(pool, V, at));
    }
    for (size_t i = 0; first && terms && i < f->n; i++)
        part[i] = qdot_sum(pool, first[i + 1] - first[i], terms + first[i]);
    qdot_free(first);
    qdot_free(terms);
    return first && terms ? QDOT_OK : QDOT_ENOMEM;
}

static qdot_status
divide_sum(qdot_scene *s, qdot_expr V, qdot_divided_sum *to)
{
    search f = {0};
    qdot_status status = find_terms(&f, s, V);

    *to = (qdot_divided_sum){.sum = V, .part = qdot_calloc(s->coordinates.n + 1, sizeof *to->part)};
    if (status == QDOT_OK)
        status = to->part ? make_parts(&f, s->pool, V, to->part) : QDOT_ENOMEM;
    if (status == QDOT_OK)
        status = qdot_vec_push(&qdot_derived_get(s)->divided, *to);
    if (status != QDOT_OK)
        qdot_free(to->part);
    qdot_free(f.coordinates);
    qdot_free(f.pairs.at);
    return status;
}

qdot_expr
qdot_long_sum_with(qdot_scene *s, qdot_expr V, size_t i)
{
    qdot_derived *d = qdot_derived_get(s);
    qdot_divided_sum divided;

    if (V == QDOT_NIL || qdot_expr_kind(s->pool, V) != QDOT_SUM || qdot_expr_count(s->pool, V) <= 1 + 2 * long_from)
        return V;
    for (size_t k = 0; k < d->divided.n; k++)
        if (d->divided.at[k].sum == V)
            return d->divided.at[k].part[i];
    if (divide_sum(s, V, &divided) != QDOT_OK)
        return qdot_pool_fail(s->pool);
    return divided.part[i];
}
