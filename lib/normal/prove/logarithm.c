/* logarithm.c -- proves that sums of logarithms are zero. */
#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "normal/field/factor.h"
#include "normal/prove/zero.h"

enum { MOST_GROUPS = 30, MOST_POWER = 24 };

static bool
is_logarithm_variable(const qdot_field *f, slong v)
{
    qdot_expr e = f->gen[v].expr;

    return f->gen[v].kind == QDOT_GEN_PLAIN && qdot_expr_kind(f->pool, e) == QDOT_FUN &&
           qdot_expr_node(f->pool, e)->op == QDOT_LOG;
}

/* The product of A^k for a sum p/c of k log A, c the content of p, *divided; nil if p is anything
 * else. */
static qdot_expr
logarithms_as_product(qdot_field *f, const fmpz_mpoly_t p, qdot_expr *divided)
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
                at = at < 0 && exp[v] == 1 && is_logarithm_variable(f, v) ? v : f->n;
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
    {
        fmpq_t c;

        fmpq_init(c);
        fmpq_set_fmpz(c, content);
        *divided = qdot_expr_fmpq(f->pool, c);
        fmpq_clear(c);
    }
    fmpz_clear(content);
    fmpz_clear(k);
    qdot_free(exp);
    return e;
}

/* m (k1 log A1 + ...) + rest, m the only monomial before logarithms: 0 if the product of all A^k is
 * exp(-rest/m). */
static qdot_status
compare_logarithms_with_rest(const qdot_zero *z, const qdot_groups *groups, bool *zero)
{
    qdot_field *f = z->f;
    qdot_pool *pool = f->pool;
    qdot_expr product, content, rest;
    qdot_status status = QDOT_OK;
    slong with = -1;
    ulong *none; /* exponents of the constant monomial 1 */
    fmpz_mpoly_t key, others, c, logs;

    for (slong i = 0; i < groups->n; i++)
        if (!fmpz_mpoly_is_fmpz(groups->poly + i, f->ctx)) {
            if (with >= 0)
                return QDOT_OK;
            with = i;
        }
    if (with < 0)
        return QDOT_OK;
    none = qdot_calloc((size_t)f->n + 1, sizeof *none);
    if (none == NULL)
        return QDOT_ENOMEM;
    fmpz_mpoly_init(key, f->ctx);
    fmpz_mpoly_init(others, f->ctx);
    fmpz_mpoly_init(c, f->ctx);
    fmpz_mpoly_init(logs, f->ctx);
    for (slong i = 0; i < groups->n; i++) {
        fmpz_mpoly_zero(key, f->ctx);
        fmpz_mpoly_push_term_si_ui(key, 1, groups->key + i * f->n, f->ctx);
        if (i == with) { /* the term without a logarithm belongs to the remaining sum */
            fmpz_t number;

            fmpz_init(number);
            fmpz_mpoly_get_coeff_fmpz_ui(number, groups->poly + i, none, f->ctx);
            fmpz_mpoly_scalar_mul_fmpz(c, key, number, f->ctx);
            fmpz_mpoly_sub_fmpz(logs, groups->poly + i, number, f->ctx);
            fmpz_clear(number);
        } else {
            fmpz_mpoly_mul(c, key, groups->poly + i, f->ctx);
        }
        fmpz_mpoly_add(others, others, c, f->ctx);
    }
    fmpz_mpoly_zero(key, f->ctx);
    fmpz_mpoly_push_term_si_ui(key, 1, groups->key + with * f->n, f->ctx);
    product = logarithms_as_product(f, logs, &content);
    rest = qdot_neg(pool, qdot_div(pool, qdot_field_expr(f, others),
                                   qdot_mul(pool, content, qdot_field_expr(f, key))));
    if (product != QDOT_NIL && rest != QDOT_NIL)
        status = z->prove(pool, product, qdot_fun1(pool, QDOT_EXP, rest),
                                  z->n_positive, z->positive, z->sure, zero);
    fmpz_mpoly_clear(key, f->ctx);
    fmpz_mpoly_clear(others, f->ctx);
    fmpz_mpoly_clear(c, f->ctx);
    fmpz_mpoly_clear(logs, f->ctx);
    qdot_free(none);
    return status;
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
        by[v] = !is_logarithm_variable(f, v);
        any |= !by[v] && fmpz_mpoly_degree_si(p, v, f->ctx) > 0;
    }
    *zero = false;
    if (any) {
        status = qdot_factor_group(f, &groups, p, by);
        *zero = status == QDOT_OK && groups.n <= MOST_GROUPS;
        for (slong i = 0; i < groups.n && status == QDOT_OK && *zero; i++) {
            qdot_expr content, product = logarithms_as_product(f, groups.poly + i, &content);

            *zero = product != QDOT_NIL;
            if (*zero)
                status = z->prove(f->pool, product, QDOT_ONE, z->n_positive,
                                          z->positive, z->sure, zero);
        }
        if (status == QDOT_OK && !*zero && groups.n <= MOST_GROUPS && qdot_field_goes(f))
            status = compare_logarithms_with_rest(z, &groups, zero);
        qdot_factor_ungroup(f, &groups);
    }
    qdot_free(by);
    return status;
}
