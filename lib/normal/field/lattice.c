/* lattice.c -- treats arguments of functions as vectors: finds their directions, rank, and base angles. */
#include "normal/field/lattice.h"

#include <flint/fmpq_mat.h>
#include <flint/fmpz_mat.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"

#define FARTHEST 200
#define FEW 16 /* up to this number a linear search is used */

static qdot_status
monomial(qdot_lattice *l, qdot_expr mono, uint32_t *index)
{
    if (qdot_map_get(&l->monos, mono, index))
        return QDOT_OK;
    for (size_t i = 0; i < l->n_monos && l->n_monos <= FEW; i++)
        if (l->mono[i] == mono) {
            *index = (uint32_t)i;
            return QDOT_OK;
        }
    QDOT_TRY(qdot_grow(&l->mono, &l->monos_capacity, l->n_monos + 1, sizeof *l->mono));
    *index = (uint32_t)l->n_monos;
    l->mono[l->n_monos++] = mono;
    for (size_t i = l->n_monos == FEW + 1 ? 0 : l->n_monos - 1;
         i < l->n_monos && l->n_monos > FEW; i++)
        QDOT_TRY(qdot_map_set(&l->monos, l->mono[i], (uint32_t)i));
    return QDOT_OK;
}

static qdot_status
lattice_add_term(qdot_lattice *l, qdot_lattice_row *row, qdot_expr mono, const fmpq_t c,
                 bool offsets)
{
    uint32_t index;

    if (fmpq_is_zero(c))
        return QDOT_OK;
    if (offsets && mono == QDOT_PI && fmpz_cmp_si(fmpq_denref(c), 12) <= 0 &&
        12 % fmpz_get_si(fmpq_denref(c)) == 0) {
        fmpq_add(&row->pi, &row->pi, c);
        return QDOT_OK;
    }
    QDOT_TRY(monomial(l, mono, &index));
    QDOT_TRY(qdot_grow(&row->term, &row->capacity, row->n + 1, sizeof *row->term));
    row->term[row->n].mono = index;
    fmpq_init(&row->term[row->n].c);
    fmpq_set(&row->term[row->n].c, c);
    row->n++;
    return QDOT_OK;
}

/* Write e = c * rest with a rational c, where the rest has no coefficient. */
static qdot_expr
split_off_coefficient(qdot_pool *pool, qdot_expr e, fmpq_t c)
{
    qdot_expr first, inverse;

    fmpq_one(c);
    if (qdot_expr_kind(pool, e) == QDOT_NUM) {
        fmpq_set(c, qdot_expr_rational(pool, e));
        return QDOT_ONE;
    }
    if (qdot_expr_kind(pool, e) != QDOT_PROD)
        return e;
    first = qdot_expr_arg(pool, e, 0);
    if (first == QDOT_ONE)
        return e;
    fmpq_set(c, qdot_expr_rational(pool, first));
    inverse = qdot_div(pool, QDOT_ONE, first);
    return qdot_mul(pool, inverse, e);
}

/* Parse an argument as c times a sum, or c times a term: 2*(x + y) is 2*x + 2*y. */
static qdot_status
parse_argument(qdot_lattice *l, qdot_pool *pool, qdot_lattice_row *row, qdot_expr arg,
               bool offsets)
{
    qdot_status status = QDOT_OK;
    qdot_expr rest;
    fmpq_t c, x;

    fmpq_init(c);
    fmpq_init(x);
    rest = split_off_coefficient(pool, arg, c);
    if (rest == QDOT_NIL) {
        status = qdot_pool_check(pool);
    } else if (qdot_expr_kind(pool, rest) == QDOT_SUM) {
        uint32_t n = qdot_expr_count(pool, rest);

        fmpq_mul(x, c, qdot_expr_rational(pool, qdot_expr_arg(pool, rest, 0)));
        status = lattice_add_term(l, row, QDOT_ONE, x, offsets);
        for (uint32_t i = 1; i + 1 < n && status == QDOT_OK; i += 2) {
            fmpq_mul(x, c, qdot_expr_rational(pool, qdot_expr_arg(pool, rest, i + 1)));
            status = lattice_add_term(l, row, qdot_expr_arg(pool, rest, i), x, offsets);
        }
    } else {
        status = lattice_add_term(l, row, rest, c, offsets);
    }
    fmpq_clear(c);
    fmpq_clear(x);
    return status;
}

bool
qdot_lattice_find(const qdot_lattice *l, qdot_expr arg, uint32_t *index)
{
    if (l->n_rows > FEW)
        return qdot_map_get(&l->rows, arg, index);
    for (size_t i = 0; i < l->n_rows; i++)
        if (l->row[i].arg == arg) {
            *index = (uint32_t)i;
            return true;
        }
    return false;
}

qdot_status
qdot_lattice_add(qdot_lattice *l, qdot_pool *pool, qdot_expr arg, bool offsets,
                 uint32_t *index)
{
    qdot_lattice_row *row;

    if (qdot_lattice_find(l, arg, index))
        return QDOT_OK;
    QDOT_TRY(qdot_grow(&l->row, &l->rows_capacity, l->n_rows + 1, sizeof *l->row));
    *index = (uint32_t)l->n_rows;
    row = &l->row[l->n_rows++];
    *row = (qdot_lattice_row){.arg = arg};
    fmpq_init(&row->pi);
    for (size_t i = l->n_rows == FEW + 1 ? 0 : l->n_rows - 1;
         i < l->n_rows && l->n_rows > FEW; i++)
        QDOT_TRY(qdot_map_set(&l->rows, l->row[i].arg, (uint32_t)i));
    return parse_argument(l, pool, row, arg, offsets);
}

/* Set g to the greatest common divisor of the rationals g and c. */
static void
gcd(fmpq_t g, const fmpq_t c)
{
    if (fmpq_is_zero(g))
        fmpq_abs(g, c);
    else
        fmpq_gcd(g, g, c);
}

static qdot_status
lattice_set_coordinate(qdot_lattice_row *row, size_t j, const fmpq_t c, const fmpq_t unit)
{
    fmpq_t x;
    bool fits;

    fmpq_init(x);
    fmpq_div(x, c, unit);
    fits = fmpz_is_one(fmpq_denref(x)) && fmpz_cmp_si(fmpq_numref(x), FARTHEST) <= 0 &&
           fmpz_cmp_si(fmpq_numref(x), -FARTHEST) >= 0;
    if (fits)
        row->at[j] = fmpz_get_si(fmpq_numref(x));
    fmpq_clear(x);
    return fits ? QDOT_OK
                : qdot_fail(QDOT_ELIMIT, "an angle is a multiple beyond %d", FARTHEST);
}

static qdot_expr
combine_terms(qdot_lattice *l, qdot_pool *pool, size_t n, const qdot_lattice_term *term,
              const fmpq_t unit, const fmpq_t scalar)
{
    qdot_expr *terms = qdot_malloc((n + 1) * sizeof *terms), sum;
    fmpq_t c;

    if (terms == NULL)
        return qdot_pool_fail(pool);
    fmpq_init(c);
    for (size_t i = 0; i < n; i++) {
        fmpq_div(c, &term[i].c, scalar);
        fmpq_mul(c, c, unit);
        terms[i] = qdot_mul(pool, qdot_expr_fmpq(pool, c), l->mono[term[i].mono]);
    }
    sum = qdot_sum(pool, n, terms);
    fmpq_clear(c);
    qdot_free(terms);
    return sum;
}

struct direction {
    size_t row; /* index of the argument that defines the direction; its scalar is 1 */
    fmpq unit;  /* greatest common divisor of the scalars of all arguments in this direction */
};

/* Whether row b is a rational multiple of row a; *q is b/a. Terms are sorted by
 * monomial. */
static bool
are_parallel(const qdot_lattice_row *a, const qdot_lattice_row *b, fmpq_t q)
{
    fmpq_t x;
    bool same = a->n == b->n && a->n > 0;

    if (!same)
        return false;
    fmpq_init(x);
    fmpq_div(q, &b->term[0].c, &a->term[0].c);
    for (size_t i = 0; i < a->n && same; i++) {
        fmpq_div(x, &b->term[i].c, &a->term[i].c);
        same = a->term[i].mono == b->term[i].mono && fmpq_equal(x, q);
    }
    fmpq_clear(x);
    return same;
}

static void
sort_terms(qdot_lattice_row *row)
{
    for (size_t i = 1; i < row->n; i++)
        for (size_t j = i; j > 0 && row->term[j - 1].mono > row->term[j].mono; j--) {
            qdot_lattice_term swap = row->term[j];

            row->term[j] = row->term[j - 1];
            row->term[j - 1] = swap;
        }
}

/* Whether directions are independent; multiples of pi are ignored beside symbols: x and x + pi/5
 * belong together. */
static bool
are_independent(const qdot_lattice *l, size_t n, const struct direction *d)
{
    size_t alone = 0;
    fmpq_mat_t m;
    bool full;

    if (n <= 1)
        return true;
    if (n > l->n_monos)
        return false;
    fmpq_mat_init(m, (slong)n, (slong)l->n_monos);
    for (size_t i = 0; i < n; i++) {
        const qdot_lattice_row *row = &l->row[d[i].row];

        alone += row->n == 1 && l->mono[row->term[0].mono] == QDOT_PI;
        for (size_t k = 0; k < row->n; k++)
            if (l->mono[row->term[k].mono] != QDOT_PI)
                fmpq_set(fmpq_mat_entry(m, i, row->term[k].mono), &row->term[k].c);
    }
    full = (size_t)fmpq_mat_rref(m, m) + alone == n;
    fmpq_mat_clear(m);
    return full;
}

static qdot_status
use_directions_as_bases(qdot_lattice *l, qdot_pool *pool, size_t n, struct direction *d)
{
    qdot_status status = QDOT_OK;
    fmpq_t one, q;

    l->n_bases = n;
    fmpq_init(one);
    fmpq_init(q);
    fmpq_one(one);
    for (size_t i = 0; i < n; i++) {
        const qdot_lattice_row *row = &l->row[d[i].row];

        l->base[i] = combine_terms(l, pool, row->n, row->term, &d[i].unit, one);
        if (l->base[i] != QDOT_NIL && qdot_expr_is_negative(pool, l->base[i])) {
            l->base[i] = qdot_neg(pool, l->base[i]);
            fmpq_neg(&d[i].unit, &d[i].unit);
        }
        for (size_t r = 0; r < l->n_rows && status == QDOT_OK; r++)
            if (are_parallel(row, &l->row[r], q))
                status = lattice_set_coordinate(&l->row[r], i, q, &d[i].unit);
    }
    fmpq_clear(one);
    fmpq_clear(q);
    return status;
}

static qdot_status
use_monomials_as_bases(qdot_lattice *l, qdot_pool *pool)
{
    qdot_status status = QDOT_OK;
    fmpq_t unit;

    l->n_bases = l->n_monos;
    fmpq_init(unit);
    for (size_t j = 0; j < l->n_monos && status == QDOT_OK; j++) {
        fmpq_zero(unit);
        for (size_t r = 0; r < l->n_rows; r++)
            for (size_t k = 0; k < l->row[r].n; k++)
                if (l->row[r].term[k].mono == j)
                    gcd(unit, &l->row[r].term[k].c);
        l->base[j] = qdot_mul(pool, qdot_expr_fmpq(pool, unit), l->mono[j]);
        for (size_t r = 0; r < l->n_rows && status == QDOT_OK; r++)
            for (size_t k = 0; k < l->row[r].n && status == QDOT_OK; k++)
                if (l->row[r].term[k].mono == j)
                    status = lattice_set_coordinate(&l->row[r], j, &l->row[r].term[k].c, unit);
    }
    fmpq_clear(unit);
    return status;
}

qdot_status
qdot_lattice_solve(qdot_lattice *l, qdot_pool *pool)
{
    size_t most = l->n_rows > l->n_monos ? l->n_rows : l->n_monos, n = 0;
    struct direction *d = qdot_calloc(most + 1, sizeof *d);
    qdot_status status = QDOT_OK;
    fmpq_t q;

    l->base = qdot_calloc(most + 1, sizeof *l->base);
    if (d == NULL || l->base == NULL) {
        qdot_free(d);
        return QDOT_ENOMEM;
    }
    fmpq_init(q);
    for (size_t r = 0; r < l->n_rows && status == QDOT_OK; r++) {
        size_t i = 0;

        l->row[r].at = qdot_calloc(most + 1, sizeof *l->row[r].at);
        if (l->row[r].at == NULL)
            status = QDOT_ENOMEM;
        sort_terms(&l->row[r]);
        if (l->row[r].n == 0)
            continue;
        while (i < n && !are_parallel(&l->row[d[i].row], &l->row[r], q))
            i++;
        if (i == n) {
            d[n].row = r;
            fmpq_init(&d[n].unit);
            fmpq_one(&d[n++].unit);
        } else {
            gcd(&d[i].unit, q);
        }
    }
    if (status == QDOT_OK)
        status = are_independent(l, n, d) ? use_directions_as_bases(l, pool, n, d)
                                      : use_monomials_as_bases(l, pool);
    for (size_t i = 0; i < n; i++)
        fmpq_clear(&d[i].unit);
    fmpq_clear(q);
    qdot_free(d);
    return status;
}

void
qdot_lattice_clear(qdot_lattice *l)
{
    for (size_t r = 0; r < l->n_rows; r++) {
        for (size_t k = 0; k < l->row[r].n; k++)
            fmpq_clear(&l->row[r].term[k].c);
        fmpq_clear(&l->row[r].pi);
        qdot_free(l->row[r].term);
        qdot_free(l->row[r].at);
    }
    qdot_free(l->row);
    qdot_free(l->mono);
    qdot_free(l->base);
    qdot_map_clear(&l->rows);
    qdot_map_clear(&l->monos);
    *l = (qdot_lattice){0};
}
