/* real-zeros.c -- encloses all complex zeros in balls and keeps the real ones. */
#include "normal/inequality/real-zeros.h"

#include <stdbool.h>
#include <stdlib.h>

#include <flint/fmpq_poly.h>

#include "base/memory.h"

enum { MOST_DEGREE = 160 };

static int
by_middle(const void *a, const void *b)
{
    return arf_cmp(arb_midref((arb_srcptr)a), arb_midref((arb_srcptr)b));
}

slong
qdot_real_zeros(const fmpz_poly_t p, arb_ptr *zeros)
{
    slong degree = fmpz_poly_degree(p), n = 0;
    bool apart = false;
    acb_ptr all;

    *zeros = NULL;
    if (degree <= 0)
        return 0;
    if (degree > MOST_DEGREE)
        return -1;
    all = _acb_vec_init(degree);
    *zeros = _arb_vec_init(degree);
    for (slong prec = 96; prec <= 1536 && !apart; prec *= 4) {
        arb_fmpz_poly_complex_roots(all, p, 0, prec);
        n = 0;
        for (slong i = 0; i < degree; i++)
            if (acb_is_real(all + i))
                arb_set(*zeros + n++, acb_realref(all + i));
        qsort(*zeros, (size_t)n, sizeof **zeros, by_middle);
        apart = true;
        for (slong i = 0; i + 1 < n; i++)
            apart &= !arb_overlaps(*zeros + i, *zeros + i + 1);
    }
    _acb_vec_clear(all, degree);
    return apart ? n : -1;
}

void
qdot_between_zeros(fmpq_t x, arb_srcptr a, arb_srcptr b)
{
    arf_t lo, hi, t;
    fmpz_t n;

    arf_init(lo);
    arf_init(hi);
    arf_init(t);
    fmpz_init(n);
    if (a != NULL)
        arb_get_ubound_arf(lo, a, 128);
    if (b != NULL)
        arb_get_lbound_arf(hi, b, 128);
    for (slong k = 0;; k++) {
        if (a != NULL) {
            arf_mul_2exp_si(t, lo, k);
            arf_floor(t, t);
            arf_get_fmpz(n, t, ARF_RND_DOWN);
            fmpz_add_ui(n, n, 1);
        } else if (b != NULL) {
            arf_mul_2exp_si(t, hi, k);
            arf_ceil(t, t);
            arf_get_fmpz(n, t, ARF_RND_DOWN);
            fmpz_sub_ui(n, n, 1);
        } else {
            fmpz_zero(n);
        }
        arf_set_fmpz(t, n);
        arf_mul_2exp_si(t, t, -k);
        if (a == NULL || b == NULL || arf_cmp(t, hi) < 0)
            break;
    }
    arf_get_fmpq(x, t);
    arf_clear(lo);
    arf_clear(hi);
    arf_clear(t);
    fmpz_clear(n);
}

void
qdot_polynomial_over(fmpz_poly_t r, const fmpz_mpoly_struct *p, slong k,
                     const slong *symbol, const fmpq *x, const fmpz_mpoly_ctx_t ctx)
{
    ulong *exp = qdot_malloc(((size_t)fmpz_mpoly_ctx_nvars(ctx) + 1) * sizeof *exp);
    fmpq_poly_t sum;
    fmpq_t a, b;

    fmpz_poly_zero(r);
    if (exp == NULL)
        return;
    fmpq_poly_init(sum);
    fmpq_init(a);
    fmpq_init(b);
    for (slong i = 0; i < fmpz_mpoly_length(p, ctx); i++) {
        slong d;

        fmpz_mpoly_get_term_exp_ui(exp, p, i, ctx);
        fmpq_set_fmpz(a, p->coeffs + i);
        for (slong j = 0; j < k; j++) {
            fmpq_pow_si(b, x + j, (slong)exp[symbol[j]]);
            fmpq_mul(a, a, b);
        }
        d = (slong)exp[symbol[k]];
        fmpq_poly_get_coeff_fmpq(b, sum, d);
        fmpq_add(a, a, b);
        fmpq_poly_set_coeff_fmpq(sum, d, a);
    }
    fmpq_poly_get_numerator(r, sum);
    fmpz_poly_primitive_part(r, r);
    fmpq_clear(a);
    fmpq_clear(b);
    fmpq_poly_clear(sum);
    qdot_free(exp);
}
