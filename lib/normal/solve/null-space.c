/* null-space.c -- finds the null space of a matrix for all values of coordinates and velocities. */
#include "normal/solve/null-space.h"

#include <stdlib.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "expr/build.h"
#include "expr/node.h"
#include "expr/polynomial/flint.h"
#include "expr/symbol.h"
#include "normal/field/factor.h"
#include "normal/field/prepare.h"
#include "normal/field/root-parts.h"

enum { WORK = 40000000 };

/* The coefficient of one monomial (in coordinates and velocities) in one column of a row. */
typedef struct {
    const ulong *key; /* [gens] exponents of the monomial */
    slong gens;
    size_t column;
    const fmpz_mpoly_struct *coefficient;
} piece;

typedef struct {
    qdot_pool *pool;
    qdot_field *f;
    size_t n;
    bool *moving;       /* [gens] whether the variable (generator) varies: it is not made of parameters only */
    qdot_ratio *row;    /* [n] the present row */
    qdot_ratio *pivots; /* [rank x n] rows in reduced echelon form, 1 at the pivot */
    size_t *column;     /* [rank] the pivot column of each reduced row */
    size_t rank;
} elimination;

/* Compare two monomials for sorting; in a field without variables there is only one, without a key. */
static int
compare_monomials(const piece *x, const piece *y)
{
    return x->gens > 0 ? memcmp(x->key, y->key, (size_t)x->gens * sizeof *x->key) : 0;
}

static int
compare_pieces(const void *a, const void *b)
{
    const piece *x = a, *y = b;
    int order = compare_monomials(x, y);

    return order != 0 ? order : x->column < y->column ? -1 : x->column > y->column;
}

static bool
is_zero(const elimination *e, const qdot_ratio *r)
{
    return fmpz_mpoly_is_zero(r->n, e->f->ctx);
}

/* Subtract c times the row b from the row a, [n] each. */
static void
subtract_multiple(elimination *e, qdot_ratio *a, const qdot_ratio *c, const qdot_ratio *b)
{
    qdot_ratio factor, product;

    qdot_ratio_init(e->f, &factor);
    qdot_ratio_init(e->f, &product);
    qdot_ratio_set(e->f, &factor, c);
    for (size_t j = 0; j < e->n && qdot_field_goes(e->f); j++) {
        if (is_zero(e, &b[j]))
            continue;
        qdot_ratio_mul(e->f, &product, &factor, &b[j]);
        qdot_ratio_sub(e->f, &a[j], &a[j], &product);
        qdot_ratio_cancel(e->f, &a[j]);
    }
    qdot_ratio_clear(e->f, &factor);
    qdot_ratio_clear(e->f, &product);
}

/* Reduce the present row by the pivot rows; if it does not become zero it is a new pivot row. */
static void
reduce_by_pivots(elimination *e)
{
    qdot_field *f = e->f;
    qdot_ratio *fresh = e->pivots + e->rank * e->n, head;
    size_t at = 0;

    for (size_t k = 0; k < e->rank && qdot_field_goes(f); k++)
        if (!is_zero(e, &e->row[e->column[k]]))
            subtract_multiple(e, e->row, &e->row[e->column[k]], e->pivots + k * e->n);
    while (at < e->n && is_zero(e, &e->row[at]))
        at++;
    if (at == e->n || !qdot_field_goes(f))
        return;
    qdot_ratio_init(f, &head);
    qdot_ratio_set(f, &head, &e->row[at]);
    for (size_t j = 0; j < e->n; j++) {
        if (!is_zero(e, &e->row[j])) {
            qdot_ratio_div(f, &fresh[j], &e->row[j], &head);
            qdot_ratio_cancel(f, &fresh[j]);
        }
    }
    qdot_ratio_clear(f, &head);
    for (size_t k = 0; k < e->rank && qdot_field_goes(f); k++)
        if (!is_zero(e, &e->pivots[k * e->n + at]))
            subtract_multiple(e, e->pivots + k * e->n, &e->pivots[k * e->n + at], fresh);
    e->column[e->rank++] = at;
}

/* Add the equations of the pieces [n], one for each monomial, whose coefficients must vanish separately. */
static qdot_status
add_equations_of_pieces(elimination *e, piece *pieces, size_t n)
{
    qdot_field *f = e->f;

    if (n > 1)
        qsort(pieces, n, sizeof *pieces, compare_pieces);
    for (size_t a = 0, b; a < n && e->rank < e->n && qdot_field_goes(f); a = b) {
        QDOT_TRY(qdot_interrupt_check());
        for (size_t j = 0; j < e->n; j++)
            fmpz_mpoly_zero(e->row[j].n, f->ctx), fmpz_mpoly_one(e->row[j].d, f->ctx);
        for (b = a; b < n && compare_monomials(&pieces[a], &pieces[b]) == 0; b++)
            fmpz_mpoly_set(e->row[pieces[b].column].n, pieces[b].coefficient, f->ctx);
        reduce_by_pivots(e);
    }
    return QDOT_OK;
}

/* Find the least common multiple of the denominators of a row. */
static void
find_common_denominator(elimination *e, const qdot_expr *row, fmpz_mpoly_t lcm)
{
    qdot_field *f = e->f;
    fmpz_mpoly_t g;

    fmpz_mpoly_init(g, f->ctx);
    fmpz_mpoly_one(lcm, f->ctx);
    for (size_t j = 0; j < e->n && qdot_field_goes(f); j++) {
        const qdot_ratio *r = qdot_field_value(f, row[j]);

        if (fmpz_mpoly_divides(g, lcm, r->d, f->ctx))
            continue;
        qdot_field_gcd(f, g, lcm, r->d);
        if (!fmpz_mpoly_divides(g, r->d, g, f->ctx))
            fmpz_mpoly_set(g, r->d, f->ctx);
        qdot_field_mul(f, lcm, lcm, g);
    }
    fmpz_mpoly_clear(g, f->ctx);
}

/* Split a row of the matrix E into one equation for each monomial. */
static qdot_status
split_row(elimination *e, const qdot_expr *row)
{
    qdot_field *f = e->f;
    qdot_groups *groups = qdot_calloc(e->n, sizeof *groups);
    qdot_vec(piece) pieces = {0};
    qdot_status status = QDOT_OK;
    fmpz_mpoly_t lcm, p;

    if (groups == NULL)
        return QDOT_ENOMEM;
    fmpz_mpoly_init(lcm, f->ctx);
    fmpz_mpoly_init(p, f->ctx);
    find_common_denominator(e, row, lcm);
    for (size_t j = 0; j < e->n && status == QDOT_OK && qdot_field_goes(f); j++) {
        const qdot_ratio *r = qdot_field_value(f, row[j]);

        if (fmpz_mpoly_is_zero(r->n, f->ctx))
            continue;
        if (!fmpz_mpoly_divides(p, lcm, r->d,
                                f->ctx)) { /* not divisible, because the quotient was reduced by relations */
            qdot_ratio x, y;

            qdot_ratio_init(f, &x);
            qdot_ratio_init(f, &y);
            fmpz_mpoly_set(x.n, lcm, f->ctx);
            qdot_ratio_mul(f, &y, r, &x);
            qdot_ratio_cancel(f, &y);
            if (!fmpz_mpoly_is_one(y.d, f->ctx))
                status = QDOT_ELIMIT;
            fmpz_mpoly_set(p, y.n, f->ctx);
            qdot_ratio_clear(f, &x);
            qdot_ratio_clear(f, &y);
        } else {
            qdot_field_mul(f, p, p, r->n);
        }
        if (status == QDOT_OK && qdot_field_goes(f))
            status = qdot_factor_group(f, &groups[j], p, e->moving);
        for (slong k = 0; k < groups[j].n && status == QDOT_OK; k++) {
            piece one = {groups[j].key + k * f->n, f->n, j, groups[j].poly + k};

            status = qdot_vec_push(&pieces, one);
        }
    }
    if (status == QDOT_OK && qdot_field_goes(f))
        status = add_equations_of_pieces(e, pieces.at, pieces.n);
    for (size_t j = 0; j < e->n; j++)
        qdot_factor_ungroup(f, &groups[j]);
    fmpz_mpoly_clear(lcm, f->ctx);
    fmpz_mpoly_clear(p, f->ctx);
    qdot_free(pieces.at);
    qdot_free(groups);
    return status;
}

/* Make a vector of the null space for each column without a pivot. */
static qdot_status
make_null_vectors(elimination *e, qdot_expr **basis, size_t *m)
{
    qdot_expr *v = qdot_calloc(e->n * (e->n - e->rank) + 1, sizeof *v);
    size_t count = 0;

    if (v == NULL)
        return QDOT_ENOMEM;
    for (size_t j = 0; j < e->n; j++) {
        bool pivot = false;
        qdot_expr *at = v + count * e->n;

        for (size_t k = 0; k < e->rank; k++)
            pivot |= e->column[k] == j;
        if (pivot)
            continue;
        for (size_t i = 0; i < e->n; i++)
            at[i] = i == j ? QDOT_ONE : QDOT_ZERO;
        for (size_t k = 0; k < e->rank; k++)
            at[e->column[k]] =
                qdot_neg(e->pool, qdot_field_ratio_expr(e->f, &e->pivots[k * e->n + j]));
        count++;
    }
    *basis = v;
    *m = count;
    return qdot_pool_check(e->pool);
}

static qdot_status
elimination_begin(elimination *e)
{
    qdot_field *f = e->f;
    const uint32_t constant = QDOT_HAS_PARAM | QDOT_HAS_FUN;

    e->moving = qdot_calloc((size_t)f->n + 1, sizeof *e->moving);
    e->row = qdot_calloc(e->n * (e->n + 1), sizeof *e->row);
    e->column = qdot_calloc(e->n, sizeof *e->column);
    if (e->moving == NULL || e->row == NULL || e->column == NULL)
        return QDOT_ENOMEM;
    e->pivots = e->row + e->n;
    for (size_t i = 0; i < e->n * (e->n + 1); i++)
        qdot_ratio_init(f, &e->row[i]);
    for (slong v = 0; v < f->n; v++)
        e->moving[v] = (qdot_expr_node(e->pool, f->gen[v].expr)->holds & ~constant) != 0;
    return QDOT_OK;
}

static void
elimination_end(elimination *e)
{
    if (e->row != NULL && e->pivots != NULL)
        for (size_t i = 0; i < e->n * (e->n + 1); i++)
            qdot_ratio_clear(e->f, &e->row[i]);
    qdot_free(e->row);
    qdot_free(e->column);
    qdot_free(e->moving);
}

/* Prepare the matrix E, and split each row by its roots into rows without roots. */
static qdot_status
split_rows_by_roots(qdot_pool *pool, size_t rows, size_t n, const qdot_expr *E,
                    qdot_root_parts *parts)
{
    qdot_expr *row = qdot_malloc((n + 1) * sizeof *row);
    size_t done = 0;
    qdot_status status = row != NULL ? QDOT_OK : QDOT_ENOMEM;

    parts->n = n;
    for (size_t i = 0; i < rows && status == QDOT_OK; i++) {
        for (size_t j = 0; j < n; j++)
            row[j] = qdot_prepare(pool, E[i * n + j]);
        status = qdot_pool_check(pool);
        if (status == QDOT_OK)
            status = qdot_root_parts_add(pool, parts, row);
        for (; status == QDOT_OK && done < parts->entries.n; done++)
            if (parts->roots.at[done / n] != QDOT_ONE)
                parts->entries.at[done] = qdot_div(pool, parts->entries.at[done],
                                                   parts->roots.at[done / n]);
    }
    for (size_t j = 0; parts->roots.n == 0 && j < n && status == QDOT_OK; j++)
        status = qdot_vec_push(&parts->entries, QDOT_ZERO); /* a zero row: no condition on this column */
    qdot_free(row);
    return status;
}

static qdot_status
null_space(qdot_pool *pool, size_t rows, size_t n, const qdot_expr *E, qdot_expr **basis,
           size_t *m)
{
    qdot_root_parts parts = {0};
    elimination e = {.pool = pool, .n = n};
    qdot_status status = split_rows_by_roots(pool, rows, n, E, &parts);
    qdot_field f;

    *basis = NULL;
    *m = 0;
    if (status != QDOT_OK) {
        qdot_root_parts_clear(&parts);
        return status;
    }
    qdot_field_begin(&f, pool, parts.entries.n, parts.entries.at, WORK);
    e.f = &f;
    if (qdot_field_goes(&f))
        status = elimination_begin(&e);
    for (size_t i = 0; i < parts.entries.n && status == QDOT_OK && qdot_field_goes(&f); i += n)
        status = split_row(&e, parts.entries.at + i);
    if (status == QDOT_OK && qdot_field_goes(&f))
        status = make_null_vectors(&e, basis, m);
    if (status == QDOT_OK && f.state == QDOT_FIELD_FAILED)
        status = f.status;
    if (status == QDOT_ELIMIT || (status == QDOT_OK && !qdot_field_goes(&f)))
        status = qdot_fail(QDOT_ELIMIT, "the linear relations are too large to be found");
    elimination_end(&e);
    qdot_field_end(&f);
    qdot_root_parts_clear(&parts);
    return status;
}

struct relations {
    qdot_pool *pool;
    size_t rows, n;
    const qdot_expr *E;
    qdot_expr *basis;
    size_t m;
    qdot_status status;
};

static void
find_null_space_task(void *user)
{
    struct relations *x = user;

    x->status = null_space(x->pool, x->rows, x->n, x->E, &x->basis, &x->m);
}

qdot_status
qdot_null_space(qdot_pool *pool, size_t rows, size_t n, const qdot_expr *E,
                qdot_expr **basis, size_t *m)
{
    struct relations x = {.pool = pool, .rows = rows, .n = n, .E = E};

    *basis = NULL;
    *m = 0;
    QDOT_TRY(qdot_flint_run(pool, find_null_space_task, &x));
    *basis = x.basis;
    *m = x.m;
    return x.status;
}
