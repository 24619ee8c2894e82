/* root-parts.c -- groups the terms of an expression by the product of roots that they contain. */
#include "normal/field/root-parts.h"

#include <stdlib.h>
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"

bool
qdot_root_parts_many(qdot_pool *pool, qdot_expr e)
{
    qdot_expr base[QDOT_ROOTS_MANY];
    qdot_walk w;
    int n = 0;

    if (qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return false;
    for (size_t i = 0; i < w.n && n < QDOT_ROOTS_MANY; i++) {
        if (qdot_expr_kind(pool, w.at[i]) != QDOT_PROD)
            continue;
        for (uint32_t k = 1; k < qdot_expr_count(pool, w.at[i]) && n < QDOT_ROOTS_MANY; k += 2) {
            const qdot_expr x = qdot_expr_arg(pool, w.at[i], k);
            const fmpq *power =
                qdot_expr_rational(pool, qdot_expr_arg(pool, w.at[i], k + 1));
            int known = 0;

            if (qdot_expr_kind(pool, x) != QDOT_SUM || power == NULL ||
                fmpz_is_one(fmpq_denref(power)))
                continue;
            while (known < n && base[known] != x)
                known++;
            if (known == n)
                base[n++] = x;
        }
    }
    qdot_walk_end(&w);
    return n == QDOT_ROOTS_MANY;
}

/* The product of roots in a term: b^(e - floor(e)) for every factor b^e whose base contains variables. */
static qdot_expr
term_roots(qdot_pool *pool, qdot_expr term)
{
    const uint32_t constant = QDOT_HAS_PARAM | QDOT_HAS_FUN;
    qdot_expr roots = QDOT_ONE;

    if (qdot_expr_kind(pool, term) != QDOT_PROD)
        return roots;
    for (uint32_t i = 1; i < qdot_expr_count(pool, term); i += 2) {
        const qdot_expr base = qdot_expr_arg(pool, term, i);
        const fmpq *power = qdot_expr_rational(pool, qdot_expr_arg(pool, term, i + 1));
        fmpq_t part;

        if (power == NULL || fmpz_is_one(fmpq_denref(power)) ||
            (qdot_expr_node(pool, base)->holds & ~constant) == 0)
            continue;
        fmpq_init(part);
        fmpz_fdiv_r(fmpq_numref(part), fmpq_numref(power), fmpq_denref(power));
        fmpz_set(fmpq_denref(part), fmpq_denref(power));
        roots = qdot_mul(pool, roots, qdot_pow(pool, base, qdot_expr_fmpq(pool, part)));
        fmpq_clear(part);
    }
    return roots;
}

/* A term of expression j, with the index of the row to which its product of roots belongs. */
struct placed {
    size_t row, j;
    qdot_expr term;
};

typedef struct {
    qdot_pool *pool;
    qdot_root_parts *to;
    size_t first; /* index of the first row that this call adds */
    qdot_vec(struct placed) placed;
} division;

/* Record `term` of expression j in the row of its product of roots. */
static qdot_status
record_term(division *d, size_t j, qdot_expr term)
{
    const qdot_expr key = term_roots(d->pool, term);
    size_t k = d->first;

    if (key == QDOT_NIL)
        return qdot_pool_check(d->pool);
    while (k < d->to->roots.n && d->to->roots.at[k] != key)
        k++;
    if (k == d->to->roots.n) {
        QDOT_TRY(qdot_vec_push(&d->to->roots, key));
        for (size_t i = 0; i < d->to->n; i++)
            QDOT_TRY(qdot_vec_push(&d->to->entries, QDOT_ZERO));
    }
    return qdot_vec_push(&d->placed, ((struct placed){k, j, term}));
}

static qdot_status
division_sort_terms(division *d, const qdot_expr *E)
{
    qdot_pool *pool = d->pool;

    for (size_t j = 0; j < d->to->n; j++) {
        const qdot_expr e = qdot_expand(pool, E[j]);

        QDOT_TRY(qdot_pool_check(pool));
        if (qdot_expr_kind(pool, e) != QDOT_SUM) {
            if (e != QDOT_ZERO)
                QDOT_TRY(record_term(d, j, e));
            continue;
        }
        if (qdot_expr_arg(pool, e, 0) != QDOT_ZERO)
            QDOT_TRY(record_term(d, j, qdot_expr_arg(pool, e, 0)));
        for (uint32_t i = 1; i < qdot_expr_count(pool, e); i += 2)
            QDOT_TRY(record_term(d, j, qdot_mul(pool, qdot_expr_arg(pool, e, i + 1),
                                                qdot_expr_arg(pool, e, i))));
    }
    return QDOT_OK;
}

static int
compare_by_entry(const void *left, const void *right)
{
    const struct placed *a = left, *b = right;

    return a->row != b->row ? (a->row > b->row) - (a->row < b->row)
                            : (a->j > b->j) - (a->j < b->j);
}

/* Add the terms of each entry at once; adding them one by one would make a node for every partial sum. */
static qdot_status
division_add_terms(division *d)
{
    qdot_vec(qdot_expr) terms = {0};
    qdot_status status = QDOT_OK;

    if (d->placed.n > 0)
        qsort(d->placed.at, d->placed.n, sizeof *d->placed.at, compare_by_entry);
    for (size_t i = 0; i < d->placed.n && status == QDOT_OK; i++) {
        const struct placed *p = d->placed.at + i;

        status = qdot_vec_push(&terms, p->term);
        if (status == QDOT_OK &&
            (i + 1 == d->placed.n || compare_by_entry(p, p + 1) != 0)) {
            d->to->entries.at[p->row * d->to->n + p->j] =
                qdot_sum(d->pool, terms.n, terms.at);
            status = qdot_pool_check(d->pool);
            terms.n = 0;
        }
    }
    qdot_free(terms.at);
    return status;
}

qdot_status
qdot_root_parts_add(qdot_pool *pool, qdot_root_parts *parts, const qdot_expr *E)
{
    division d = {.pool = pool, .to = parts, .first = parts->roots.n};
    qdot_status status = division_sort_terms(&d, E);

    if (status == QDOT_OK && parts->roots.n == d.first + 1) /* keep the factor as it was written, not expanded */
        memcpy(parts->entries.at + d.first * parts->n, E, parts->n * sizeof *E);
    else if (status == QDOT_OK)
        status = division_add_terms(&d);
    qdot_free(d.placed.at);
    return status;
}

void
qdot_root_parts_clear(qdot_root_parts *parts)
{
    qdot_free(parts->entries.at);
    qdot_free(parts->roots.at);
    *parts = (qdot_root_parts){0};
}
