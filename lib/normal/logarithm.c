/* logarithm.c -- sums of logarithms that are zero. */
#include "base/memory.h"
#include "normal/factor.h"
#include "normal/prove.h"
#include "normal/zero.h"

enum { MOST_GROUPS = 30, MOST_POWER = 24 };

static bool
is_logarithm(const qdot_field *f, slong v)
{
    qdot_expr e = f->gen[v].expr;

    return f->gen[v].kind == QDOT_GEN_PLAIN && qdot_expr_kind(f->pool, e) == QDOT_FUN &&
           qdot_expr_node(f->pool, e)->op == QDOT_LOG;
}

/* The product of A^k for a sum p of k log A; nil if p is anything else. */
static qdot_expr
as_product(qdot_field *f, const fmpz_mpoly_t p)
{
    slong length = fmpz_mpoly_length(p, f->ctx);
    ulong *exp = qdot_malloc(((size_t)f->n + 1) * sizeof *exp);
    qdot_expr e = exp == NULL ? QDOT_NIL : QDOT_ONE;
    fmpz_t content, k;

    fmpz_init(content);
    fmpz_init(k);
    _fmpz_vec_content(content, p->coeffs, length);
    for (slong i = 0; i < length && e != QDOT_NIL; i++) {
        slong at = -1;

        fmpz_mpoly_get_term_exp_ui(exp, p, i, f->ctx);
        for (slong v = 0; v < f->n; v++)
            if (exp[v] != 0)
                at = at < 0 && exp[v] == 1 && is_logarithm(f, v) ? v : f->n;
        fmpz_mpoly_get_term_coeff_fmpz(k, p, i, f->ctx);
        fmpz_divexact(k, k, content);
        if (at < 0 || at == f->n || fmpz_cmp_si(k, MOST_POWER) > 0 ||
            fmpz_cmp_si(k, -MOST_POWER) < 0)
            e = QDOT_NIL;
        else
            e = qdot_mul(f->pool, e,
                         qdot_pow_int(f->pool, qdot_expr_arg(f->pool, f->gen[at].expr, 0),
                                      fmpz_get_si(k)));
    }
    fmpz_clear(content);
    fmpz_clear(k);
    qdot_free(exp);
    return e;
}

qdot_status
qdot_zero_logarithms(qdot_zero *z, const fmpz_mpoly_t p, bool *zero)
{
    qdot_field *f = z->f;
    bool *by = qdot_malloc(((size_t)f->n + 1) * sizeof *by), any = false;
    qdot_status status = QDOT_OK;
    qdot_groups groups;

    if (by == NULL)
        return QDOT_ENOMEM;
    for (slong v = 0; v < f->n; v++) {
        by[v] = !is_logarithm(f, v);
        any |= !by[v] && fmpz_mpoly_degree_si(p, v, f->ctx) > 0;
    }
    *zero = false;
    if (any) {
        status = qdot_factor_group(f, &groups, p, by);
        *zero = status == QDOT_OK && groups.n <= MOST_GROUPS;
        for (slong i = 0; i < groups.n && status == QDOT_OK && *zero; i++) {
            qdot_expr product = as_product(f, groups.poly + i);

            *zero = product != QDOT_NIL;
            if (*zero)
                status = qdot_prove_equal(f->pool, product, QDOT_ONE, NULL, zero);
        }
        qdot_factor_ungroup(f, &groups);
    }
    qdot_free(by);
    return status;
}
