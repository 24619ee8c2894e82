/* polynomials.c -- a set of polynomials as an open-addressing hash table. */
#include "normal/field/polynomials.h"

#include "base/memory.h"

/* Hash the exponents and the low bits of the coefficients of p. False: no memory. */
static bool
hash_polynomial(const qdot_field *f, const fmpz_mpoly_t p, uint64_t *hash)
{
    ulong few[32], *exp = f->n > 32 ? qdot_malloc((size_t)f->n * sizeof *exp) : few;

    if (exp == NULL)
        return false;
    *hash = 0xcbf29ce484222325u;
    for (slong i = 0; i < fmpz_mpoly_length(p, f->ctx); i++) {
        fmpz_mpoly_get_term_exp_ui(exp, p, i, f->ctx);
        *hash = (*hash ^ fmpz_get_ui(p->coeffs + i)) * 0x9e3779b97f4a7c15u;
        for (slong v = 0; v < f->n; v++)
            *hash = (*hash ^ exp[v]) * 0x9e3779b97f4a7c15u, *hash ^= *hash >> 29;
    }
    if (exp != few)
        qdot_free(exp);
    return true;
}

/* The slot of p, or the free slot where it belongs; the table has one. */
static size_t
find_polynomial_slot(const qdot_field *f, const qdot_polynomials *t, const fmpz_mpoly_t p, uint64_t hash)
{
    size_t k = hash & (t->places - 1);

    while (t->place[k] != 0 && (t->hash[t->place[k] - 1] != hash ||
                                !fmpz_mpoly_equal(t->at + t->place[k] - 1, p, f->ctx)))
        k = (k + 1) & (t->places - 1);
    return k;
}

slong
qdot_polynomials_find(qdot_field *f, const qdot_polynomials *t, const fmpz_mpoly_t p)
{
    uint64_t hash;

    if (t->places == 0)
        return -1;
    if (!hash_polynomial(f, p, &hash)) {
        qdot_pool_fail(f->pool);
        return -1;
    }
    return (slong)t->place[find_polynomial_slot(f, t, p, hash)] - 1;
}

/* Make room for one more polynomial, with half of the slots free. */
static qdot_status
polynomials_make_room(const qdot_field *f, qdot_polynomials *t)
{
    size_t places = t->places ? 2 * t->places : 64;
    uint32_t *all;

    QDOT_TRY(qdot_grow(&t->at, &t->at_capacity, t->n + 1, sizeof *t->at));
    QDOT_TRY(qdot_grow(&t->hash, &t->hash_capacity, t->n + 1, sizeof *t->hash));
    if (t->places >= 2 * (t->n + 1))
        return QDOT_OK;
    all = qdot_calloc(places, sizeof *all);
    if (all == NULL)
        return QDOT_ENOMEM;
    qdot_free(t->place);
    t->place = all;
    t->places = places;
    for (size_t i = 0; i < t->n; i++)
        t->place[find_polynomial_slot(f, t, t->at + i, t->hash[i])] = (uint32_t)i + 1;
    return QDOT_OK;
}

qdot_status
qdot_polynomials_add(qdot_field *f, qdot_polynomials *t, const fmpz_mpoly_t p)
{
    uint64_t hash;

    QDOT_TRY(polynomials_make_room(f, t));
    if (!hash_polynomial(f, p, &hash))
        return QDOT_ENOMEM;
    fmpz_mpoly_init(t->at + t->n, f->ctx);
    fmpz_mpoly_set(t->at + t->n, p, f->ctx);
    t->hash[t->n] = hash;
    t->place[find_polynomial_slot(f, t, p, hash)] = (uint32_t)t->n + 1;
    t->n++;
    return QDOT_OK;
}

void
qdot_polynomials_clear(qdot_field *f, qdot_polynomials *t)
{
    for (size_t i = 0; i < t->n; i++)
        fmpz_mpoly_clear(t->at + i, f->ctx);
    qdot_free(t->at);
    qdot_free(t->hash);
    qdot_free(t->place);
    *t = (qdot_polynomials){0};
}
