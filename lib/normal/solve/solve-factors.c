/* solve-factors.c -- writes an expression as a product of factors, for solving equations factor by factor. */
#include "normal/solve/solve-factors.h"

#include <stdio.h>
#include <stdlib.h>

#include <flint/ulong_extras.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/polynomial/flint.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "normal/field/factor.h"
#include "normal/field/prepare.h"
#include "normal/simplify/simplify.h"

enum { WORK = 2000000, WORK_OF_PRODUCT = 100000000 };

/* Multiply a product by p in irreducible factors, with their exponents times `turn` (1 or -1), and by its content. */
static qdot_status
multiply_by_factors(qdot_field *f, const fmpz_mpoly_t p, int64_t turn, qdot_expr *product,
                    qdot_expr **list, size_t *n, size_t *capacity)
{
    qdot_pool *pool = f->pool;
    qdot_factors factors;
    qdot_status status = qdot_factor(f, &factors, p);
    fmpq_t content;

    fmpq_init(content);
    if (status == QDOT_OK) {
        fmpz_set(fmpq_numref(content), factors.content);
        *product = qdot_mul(pool, *product,
                            qdot_pow_int(pool, qdot_expr_fmpq(pool, content), turn));
    }
    for (slong i = 0; i < factors.n && status == QDOT_OK; i++) {
        qdot_expr e = qdot_field_expr(f, factors.poly + i);

        *product = qdot_mul(pool, *product, qdot_pow_int(pool, e, turn * factors.exp[i]));
        if (list == NULL)
            continue;
        status = qdot_grow(list, capacity, *n + 1, sizeof **list);
        if (status == QDOT_OK)
            (*list)[(*n)++] = e;
    }
    fmpq_clear(content);
    qdot_factor_clear(f, &factors);
    return status;
}

/* Find the product of factors and, if asked for, the factors of the numerator (*list stays NULL if
 * over budget). */
static qdot_status
find_factors(qdot_pool *pool, qdot_expr e, qdot_expr *product, qdot_expr **list, size_t *n)
{
    qdot_expr prepared = qdot_prepare(pool, e);
    size_t capacity = 0;
    qdot_status status = qdot_pool_check(pool);
    qdot_field f;

    QDOT_TRY(status);
    *product = QDOT_NIL;
    qdot_field_begin(&f, pool, 1, &prepared, list == NULL ? WORK_OF_PRODUCT : WORK);
    f.patient = list == NULL;
    if (qdot_field_goes(&f)) {
        qdot_expr result = QDOT_ONE;
        qdot_ratio r;

        qdot_field_cancelled(&f, &r, prepared);
        if (fmpz_mpoly_is_zero(r.n, f.ctx)) {
            result = QDOT_ZERO;
        } else if (qdot_field_goes(&f)) {
            status = multiply_by_factors(&f, r.n, 1, &result, list, n, &capacity);
            if (status == QDOT_OK)
                status = multiply_by_factors(&f, r.d, -1, &result, NULL, NULL, NULL);
        }
        if (status == QDOT_OK && qdot_field_goes(&f))
            *product = result;
        qdot_ratio_clear(&f, &r);
    }
    if (status == QDOT_OK && f.state == QDOT_FIELD_FAILED)
        status = f.status;
    qdot_field_end(&f);
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    return status;
}

/* --- roots of parameters, replaced by symbols -------------------------------------------- */

/* Parameters written by v >= 0, v^n = base, where base^(1/n) stands: the field has no relations to factor modulo then.
 * x^3 - 3 x^2 sqrt(c) + 3 x c - c sqrt(c) is (x - v)^3. */
enum { MOST_ROOTS = 4, MOST_ORDER = 12 };

struct roots {
    uint32_t n;
    qdot_expr v[MOST_ROOTS], root[MOST_ROOTS]; /* symbols v that replace roots; a root may contain symbols of earlier roots */
};

/* A parameter in which `base` is linear, with a number as coefficient *slope; nil if there is none. */
static qdot_expr
linear_parameter(qdot_pool *pool, qdot_expr base, qdot_expr *slope)
{
    const qdot_expr atoms = qdot_expr_atoms(pool, base, true);

    for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(pool, atoms); i++) {
        const qdot_expr p = qdot_expr_arg(pool, atoms, i);

        *slope = qdot_expr_is_class(pool, p, QDOT_PARAM) ? qdot_diff(pool, base, p) : QDOT_ZERO;
        if (*slope != QDOT_NIL && *slope != QDOT_ZERO && qdot_expr_rational(pool, *slope) != NULL)
            return p;
    }
    return QDOT_NIL;
}

/* The least n <= MOST_ORDER for which all powers of base in the nodes of w are integer powers of base^(1/n). */
static ulong
common_order(const qdot_pool *pool, const qdot_walk *w, qdot_expr base)
{
    ulong n = 1;

    for (size_t i = 0; i < w->n; i++) {
        const uint32_t count = qdot_expr_kind(pool, w->at[i]) == QDOT_PROD ? qdot_expr_count(pool, w->at[i]) : 0;

        for (uint32_t k = 1; k + 1 < count; k += 2) {
            const fmpq *q = qdot_expr_rational(pool, qdot_expr_arg(pool, w->at[i], k + 1));

            if (qdot_expr_arg(pool, w->at[i], k) == base && q != NULL && fmpz_cmp_ui(fmpq_denref(q), MOST_ORDER) <= 0)
                n *= fmpz_get_ui(fmpq_denref(q)) / n_gcd(n, fmpz_get_ui(fmpq_denref(q)));
        }
    }
    return n <= MOST_ORDER ? n : 1;
}

/* Whether p stands under roots of base alone, among the nodes of w, and in no magnitude: sqrt(1 - a) or |a| would be longer
 * by v than by a. */
static bool
is_under_one_root(const qdot_pool *pool, const qdot_walk *w, qdot_expr base, qdot_expr p)
{
    bool one = true;

    for (size_t i = 0; i < w->n && one; i++) {
        const uint32_t count = qdot_expr_kind(pool, w->at[i]) == QDOT_PROD ? qdot_expr_count(pool, w->at[i]) : 0;

        one = !(qdot_expr_is_function(pool, w->at[i], QDOT_ABS) || qdot_expr_is_function(pool, w->at[i], QDOT_SIGN)) ||
              !qdot_expr_contains(pool, w->at[i], p);
        for (uint32_t k = 1; k + 1 < count && one; k += 2) {
            const qdot_expr of = qdot_expr_arg(pool, w->at[i], k);
            const fmpq *q = qdot_expr_rational(pool, qdot_expr_arg(pool, w->at[i], k + 1));

            one = of == base || (q != NULL && fmpz_is_one(fmpq_denref(q))) || !qdot_expr_contains(pool, of, p);
        }
    }
    return one;
}

/* The expression e with the first root of a linear function of a parameter replaced by a symbol v; else e. */
static qdot_expr
replace_root_by_symbol(qdot_pool *pool, qdot_expr e, struct roots *r)
{
    qdot_expr base = QDOT_NIL, p = QDOT_NIL, slope = QDOT_NIL, value, zero = QDOT_ZERO;
    char name[24];
    ulong order = 1;
    qdot_walk w;

    if (qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < w.n && order == 1; i++) {
        const uint32_t count = qdot_expr_kind(pool, w.at[i]) == QDOT_PROD ? qdot_expr_count(pool, w.at[i]) : 0;

        for (uint32_t k = 1; k + 1 < count && order == 1; k += 2) {
            const fmpq *q = qdot_expr_rational(pool, qdot_expr_arg(pool, w.at[i], k + 1));

            base = qdot_expr_arg(pool, w.at[i], k);
            if (q == NULL || fmpz_is_one(fmpq_denref(q)))
                continue;
            p = linear_parameter(pool, base, &slope);
            order = p == QDOT_NIL || !is_under_one_root(pool, &w, base, p) ? 1 : common_order(pool, &w, base);
        }
    }
    qdot_walk_end(&w);
    if (order == 1)
        return e;
    snprintf(name, sizeof name, "(root %u)", r->n);
    r->v[r->n] = qdot_symbol_get(pool, QDOT_FORMAL, name);
    qdot_symbol_domain(pool, r->v[r->n], QDOT_ZERO, false, QDOT_NIL, false);
    r->root[r->n] = qdot_pow(pool, base, qdot_expr_ratio(pool, 1, (int64_t)order));
    value = qdot_sub(pool, qdot_pow_int(pool, r->v[r->n++], (int64_t)order), qdot_subs(pool, base, 1, &p, &zero));
    value = qdot_div(pool, value, slope);
    return value == QDOT_NIL ? QDOT_NIL : qdot_subs(pool, e, 1, &p, &value);
}

static qdot_expr
replace_roots_by_symbols(qdot_pool *pool, qdot_expr e, struct roots *r)
{
    qdot_expr last = QDOT_NIL;

    while (e != QDOT_NIL && e != last && r->n < MOST_ROOTS) {
        last = e;
        e = replace_root_by_symbol(pool, e, r);
    }
    return e;
}

static qdot_expr
restore_roots(qdot_pool *pool, qdot_expr e, const struct roots *r)
{
    for (uint32_t i = r->n; e != QDOT_NIL && i-- > 0;)
        e = qdot_subs(pool, e, 1, &r->v[i], &r->root[i]);
    return e;
}

/* --- factors, within the budget ---------------------------------------------------------- */

struct factoring {
    qdot_pool *pool;
    qdot_expr e, result;
};

static void
list_factors_task(void *user)
{
    struct factoring *x = user;
    struct roots roots = {0};
    qdot_expr product = QDOT_NIL, *list = NULL, e = replace_roots_by_symbols(x->pool, x->e, &roots);
    size_t n = 0;
    qdot_status status = qdot_pool_check(x->pool);

    if (status == QDOT_EDOMAIN) { /* the expression is nowhere real in this form */
        e = x->e;
        roots.n = 0;
        status = QDOT_OK;
    }
    if (status == QDOT_OK)
        status = find_factors(x->pool, e, &product, &list, &n);

    if (status != QDOT_OK)
        x->result = qdot_pool_fail(x->pool);
    else if (product == QDOT_NIL || product == QDOT_ZERO)
        x->result = qdot_list(x->pool, 1, product == QDOT_NIL ? &x->e : &product);
    else
        x->result = restore_roots(x->pool, qdot_list(x->pool, (uint32_t)n, list), &roots);
    qdot_free(list);
}

qdot_expr
qdot_solve_factors(qdot_pool *pool, qdot_expr e)
{
    struct factoring x = {pool, e, QDOT_NIL};
    qdot_status status = qdot_flint_run(pool, list_factors_task, &x);

    if (status == QDOT_ELIMIT)
        return qdot_list(pool, 1, &e);
    return status == QDOT_OK ? x.result : qdot_pool_fail(pool);
}

/* --- functions that are not taken apart ------------------------------------------------------ */

enum { MOST_FUNCTIONS = 32 };

/* Functions in an expression, and the symbols that replace them. */
struct unrelated {
    uint32_t n;
    qdot_expr of[MOST_FUNCTIONS], as[MOST_FUNCTIONS];
};

static qdot_expr
replace_function_by_symbol(qdot_pool *pool, qdot_expr node, void *user)
{
    struct unrelated *u = user;
    char name[32];

    if (qdot_expr_kind(pool, node) != QDOT_FUN)
        return QDOT_NIL;
    for (uint32_t i = 0; i < u->n; i++)
        if (u->of[i] == node)
            return u->as[i];
    if (u->n == MOST_FUNCTIONS)
        return node;
    snprintf(name, sizeof name, "(function %u)", u->n);
    u->of[u->n] = node;
    return u->as[u->n++] = qdot_symbol_get(pool, QDOT_FORMAL, name);
}

/* How many factors stand above, each as often as its power says; 0: one of them can be said
 * shorter, as sin(x)^2 + cos(x)^2 can. */
static int64_t
count_factors(qdot_pool *pool, qdot_expr e)
{
    bool product = qdot_expr_kind(pool, e) == QDOT_PROD;
    uint32_t n = product ? qdot_expr_count(pool, e) : 2;
    int64_t count = 0, power;

    for (uint32_t i = 1; i < n; i += 2) {
        qdot_expr base = product ? qdot_expr_arg(pool, e, i) : e,
                  shorter = qdot_simplify(pool, base, NULL);

        if (shorter == QDOT_NIL ||
            qdot_expr_size(pool, shorter) < qdot_expr_size(pool, base))
            return 0;
        if (!product || !qdot_expr_to_int(pool, qdot_expr_arg(pool, e, i + 1), &power))
            power = 1;
        count += power > 0 ? power : 0;
    }
    return count;
}

/* The product by all that relates functions to each other, or the one in which they stand for
 * themselves, sin(y)^2 for (1 - cos(y)) (1 + cos(y)): more factors, then fewer operations. */
static qdot_expr
find_shortest_product(qdot_pool *pool, qdot_expr e, void *user)
{
    struct unrelated u = {0};
    qdot_expr related = QDOT_NIL, apart = QDOT_NIL, bare;
    int64_t more;

    (void)user;
    if (find_factors(pool, e, &related, NULL, NULL) != QDOT_OK)
        return qdot_pool_fail(pool);
    related = related == QDOT_NIL ? e : related;
    bare = qdot_walk_map(pool, e, replace_function_by_symbol, &u);
    if (bare == QDOT_NIL || u.n == 0)
        return bare == QDOT_NIL ? QDOT_NIL : related;
    if (find_factors(pool, bare, &apart, NULL, NULL) != QDOT_OK)
        return qdot_pool_fail(pool);
    if (apart == QDOT_NIL || related == QDOT_ZERO)
        return related;
    apart = qdot_subs(pool, apart, u.n, u.as, u.of);
    if (apart == QDOT_NIL)
        return QDOT_NIL;
    more = count_factors(pool, apart);
    more = more == 0 ? -1 : more - count_factors(pool, related);
    return more > 0 || (more == 0 &&
                        qdot_expr_size(pool, apart) < qdot_expr_size(pool, related))
               ? apart
               : related;
}

static void
make_product_task(void *user)
{
    struct factoring *x = user;

    x->result = qdot_value_map(x->pool, x->e, find_shortest_product, NULL);
}

qdot_expr
qdot_solve_product(qdot_pool *pool, qdot_expr e)
{
    struct factoring x = {pool, e, e};
    qdot_status status = e == QDOT_NIL ? QDOT_OK : qdot_flint_run(pool, make_product_task, &x);

    if (status == QDOT_ELIMIT)
        return e;
    return status == QDOT_OK ? x.result : qdot_pool_fail(pool);
}
