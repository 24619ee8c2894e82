/* complex-roots.c -- the complex roots of a polynomial with rational coefficients. */
#include "normal/solve/complex-roots.h"

#include <math.h>

#include <flint/fmpq_poly.h>
#include <flint/fmpz_poly_factor.h>

#include "expr/exact.h"
#include "num/arb.h"
#include "expr/polynomial/flint.h"

/* Append the roots of f to re and im, which hold *at roots so far. The roots of f are simple; those of the whole polynomial,
 * of which f is a factor, have the multiplicity `times`, and so often each is written. */
static void
write_roots(const fmpz_poly_t f, slong times, double *re, double *im, size_t *at)
{
    const slong n = fmpz_poly_degree(f);
    acb_ptr roots = _acb_vec_init(n);
    slong pair;

    arb_fmpz_poly_complex_roots(roots, f, 0, 80);
    for (slong k = 0; k < n; k += pair) {
        pair = arb_is_zero(acb_imagref(roots + k)) ? 1 : 2; /* conjugate roots stand together */
        for (slong t = 0; t < times * pair; t++, ++*at) {
            re[*at] = arf_get_d(arb_midref(acb_realref(roots + k + t % pair)), ARF_RND_NEAR);
            im[*at] = arf_get_d(arb_midref(acb_imagref(roots + k + t % pair)), ARF_RND_NEAR);
        }
    }
    _acb_vec_clear(roots, n);
}

void
qdot_complex_roots_of(const fmpz_poly_t f, double *re, double *im)
{
    fmpz_poly_factor_t factors;
    size_t at = 0;

    fmpz_poly_factor_init(factors);
    fmpz_poly_factor_squarefree(factors, f);
    for (slong i = 0; i < factors->num; i++)
        write_roots(factors->p + i, factors->exp[i], re, im, &at);
    fmpz_poly_factor_clear(factors);
}

typedef struct {
    qdot_pool *pool;
    size_t n;
    const qdot_expr *c;
    double *re, *im;
} job;

static void
find_roots(void *user)
{
    job *j = user;
    fmpq_poly_t p;
    fmpz_poly_t f;

    fmpq_poly_init(p);
    fmpz_poly_init(f);
    for (size_t k = 0; k <= j->n; k++)
        fmpq_poly_set_coeff_fmpq(p, (slong)k, qdot_expr_rational(j->pool, j->c[k]));
    fmpq_poly_get_numerator(f, p);
    qdot_complex_roots_of(f, j->re, j->im);
    fmpz_poly_clear(f);
    fmpq_poly_clear(p);
}

qdot_status
qdot_complex_roots(qdot_pool *pool, size_t n, const qdot_expr *c, double *re, double *im)
{
    job j = {.pool = pool, .n = n, .c = c, .re = re, .im = im};

    for (size_t k = 0; k <= n; k++)
        if (c[k] == QDOT_NIL || qdot_expr_rational(pool, c[k]) == NULL)
            return qdot_fail(QDOT_EINVAL, "the roots of a polynomial with coefficients that are no rational numbers");
    QDOT_TRY(qdot_flint_run(pool, find_roots, &j));
    for (size_t k = 0; k < n; k++)
        if (fabs(re[k]) < 0x1p-60 * fabs(im[k]))
            re[k] = 0;
    return QDOT_OK;
}
