/* items.c -- sums of key * value, in which the values of equal keys are added. */
#include "normal/form/items.h"

#include "base/memory.h"

/* Add key * value to the items: a key = c key' with primitive key' adds c value to the item of key'. */
qdot_status
qdot_items_add(qdot_field *f, qdot_items *items, const fmpz_mpoly_t key,
               const fmpz_mpoly_t value)
{
    fmpz_mpoly_t primitive, scaled;
    qdot_status status = QDOT_OK;
    size_t i = 0;
    fmpz_t c;

    fmpz_init(c);
    fmpz_mpoly_init(primitive, f->ctx);
    fmpz_mpoly_init(scaled, f->ctx);
    qdot_field_primitive(f, c, primitive, key, true);
    fmpz_mpoly_scalar_mul_fmpz(scaled, value, c, f->ctx);
    while (i < items->n && !fmpz_mpoly_equal(items->at[i].key, primitive, f->ctx))
        i++;
    if (i == items->n) {
        status = qdot_grow(&items->at, &items->capacity, items->n + 1, sizeof *items->at);
        if (status == QDOT_OK) {
            fmpz_mpoly_init(items->at[i].key, f->ctx);
            fmpz_mpoly_init(items->at[i].sum, f->ctx);
            fmpz_mpoly_swap(items->at[i].key, primitive, f->ctx);
            items->n++;
        }
    }
    if (status == QDOT_OK)
        fmpz_mpoly_add(items->at[i].sum, items->at[i].sum, scaled, f->ctx);
    fmpz_clear(c);
    fmpz_mpoly_clear(primitive, f->ctx);
    fmpz_mpoly_clear(scaled, f->ctx);
    return status;
}

void
qdot_items_clear(qdot_field *f, qdot_items *items)
{
    for (size_t i = 0; i < items->n; i++) {
        fmpz_mpoly_clear(items->at[i].key, f->ctx);
        fmpz_mpoly_clear(items->at[i].sum, f->ctx);
    }
    qdot_free(items->at);
    *items = (qdot_items){0};
}

/* Parts of a trigonometric polynomial whose degrees in each angle have the same parity:
 * only these can be combined. Adds each part, times value, to the items. */
qdot_status
qdot_items_add_parts(qdot_field *f, qdot_items *items, const fmpz_mpoly_t trig,
                     const fmpz_mpoly_t value)
{
    slong length = fmpz_mpoly_length(trig, f->ctx);
    ulong *exp = qdot_malloc(((size_t)f->n + 1) * sizeof *exp);
    unsigned char *done = qdot_calloc((size_t)length + 1, 1);
    uint64_t *parity = qdot_calloc((size_t)length + 1, sizeof *parity);
    qdot_status status = QDOT_OK;
    fmpz_mpoly_t sum, term;

    if (exp == NULL || done == NULL || parity == NULL) {
        qdot_free(exp);
        qdot_free(done);
        qdot_free(parity);
        return QDOT_ENOMEM;
    }
    for (slong i = 0; i < length; i++) {
        fmpz_mpoly_get_term_exp_ui(exp, trig, i, f->ctx);
        for (slong v = 0; v < f->n; v++)
            if (exp[v] % 2 != 0) {
                slong w = (slong)f->gen[v].pair;

                parity[i] ^= (uint64_t)1 << ((v < w ? v : w) % 64);
            }
    }
    fmpz_mpoly_init(sum, f->ctx);
    fmpz_mpoly_init(term, f->ctx);
    for (slong i = 0; i < length && status == QDOT_OK; i++) {
        if (done[i])
            continue;
        fmpz_mpoly_zero(sum, f->ctx);
        for (slong j = i; j < length; j++)
            if (parity[j] == parity[i]) {
                done[j] = 1;
                fmpz_mpoly_get_term(term, trig, j, f->ctx);
                fmpz_mpoly_add(sum, sum, term, f->ctx);
            }
        status = qdot_items_add(f, items, sum, value);
    }
    fmpz_mpoly_clear(sum, f->ctx);
    fmpz_mpoly_clear(term, f->ctx);
    qdot_free(exp);
    qdot_free(done);
    qdot_free(parity);
    return status;
}
