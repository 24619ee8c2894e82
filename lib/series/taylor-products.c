/* taylor-products.c -- lists the products of entries of K with unknowns, and sums them in vectors. */
#include "series/taylor-products.h"

#include "base/memory.h"

enum { lanes = 8 };

/* One part of a result: from component `to` of x subtract sum number `of`, times a sign. */
typedef struct {
    size_t to, of;
    double sign;
} part;

struct qdot_taylor_products {
    size_t n, members;          /* number of convolution sums; this number rounded up to full vectors */
    const double **entry, **by; /* [n] the rows of the two factors of each product */
    double *entries, *unknowns; /* [orders x members] coefficients of both factors, order by order */
    double *sums;               /* [members] the values of all sums at one order */
    part *parts;
    size_t n_parts;
};

/* --- making the list of products ----------------------------------------------------- */

static void
append_coupling(qdot_taylor_products *p, const double *positive, size_t to, const qdot_taylor_coupling *c)
{
    const double *entry = positive ? positive : c->M;
    size_t j = 0;

    while (j < p->n && (p->entry[j] != entry || p->by[j] != c->a))
        j++;
    p->entry[j] = entry;
    p->by[j] = c->a;
    p->n += j == p->n;
    p->parts[p->n_parts++] = (part){to, j, positive ? -1 : 1};
}

/* List the products M a, of a matrix with unknowns, of all blocks. */
static void
add_all_products(qdot_taylor_products *p, const qdot_taylor *t)
{
    size_t first = 0;

    for (size_t b = 0; b < t->n_blocks; b++) {
        const qdot_taylor_block *block = t->blocks + b;

        for (size_t i = 0; i < block->n_couplings; i++) {
            const qdot_taylor_coupling *c = block->couplings + i;

            append_coupling(p, t->negated[qdot_taylor_row(t, c->M)], first + c->i, c);
        }
        first += block->n;
    }
}

static qdot_status
make_products(qdot_taylor_products *p, const qdot_taylor *t, int most)
{
    size_t count = 1;

    for (size_t b = 0; b < t->n_blocks; b++)
        count += t->blocks[b].n_couplings;
    p->entry = qdot_calloc(count, sizeof *p->entry);
    p->by = qdot_calloc(count, sizeof *p->by);
    p->parts = qdot_calloc(count, sizeof *p->parts);
    if (!p->entry || !p->by || !p->parts)
        return QDOT_ENOMEM;
    add_all_products(p, t);
    p->members = (p->n + lanes - 1) / lanes * lanes;
    p->entries = qdot_calloc((size_t)most * p->members + 1, sizeof *p->entries);
    p->unknowns = qdot_calloc((size_t)most * p->members + 1, sizeof *p->unknowns);
    p->sums = qdot_calloc(p->members + 1, sizeof *p->sums);
    return p->entries && p->unknowns && p->sums ? QDOT_OK : QDOT_ENOMEM;
}

qdot_status
qdot_taylor_products_new(const qdot_taylor *t, int most, qdot_taylor_products **products)
{
    qdot_taylor_products *p = qdot_calloc(1, sizeof *p);

    *products = p;
    return p ? make_products(p, t, most) : QDOT_ENOMEM;
}

size_t
qdot_taylor_products_count(const qdot_taylor_products *p)
{
    return p->n;
}

void
qdot_taylor_products_free(qdot_taylor_products *p)
{
    if (!p)
        return;
    qdot_free(p->entry);
    qdot_free(p->by);
    qdot_free(p->entries);
    qdot_free(p->unknowns);
    qdot_free(p->sums);
    qdot_free(p->parts);
    qdot_free(p);
}

/* --- subtracting and recording an order ---------------------------------------------- */

void
qdot_taylor_products_take_off(qdot_taylor_products *p, const qdot_series_kernels *kernels,
                              int k, double *x)
{
    const size_t members = p->members;
    double *entries = p->entries + (size_t)k * members;

    for (size_t j = 0; j < p->n; j++)
        entries[j] = p->entry[j][k];
    if (k == 0 || p->n == 0)
        return;
    kernels->dots(members, (size_t)k, p->entries + members,
                  p->unknowns + (size_t)(k - 1) * members, p->sums);
    for (size_t j = 0; j < p->n_parts; j++)
        x[p->parts[j].to] -= p->parts[j].sign * p->sums[p->parts[j].of];
}

void
qdot_taylor_products_note(qdot_taylor_products *p, int k)
{
    double *unknowns = p->unknowns + (size_t)k * p->members;

    for (size_t j = 0; j < p->n; j++)
        unknowns[j] = p->by[j][k];
}
