/* algebra.c -- replacements, solutions, factors, eigenvalues. */
#include "lang/algebra.h"

#include "base/memory.h"
#include "base/text.h"
#include "expr/calculus.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "lang/code.h"
#include "normal/prove/decide.h"
#include "normal/solve/solve.h"

static qdot_status
give(qdot_session *s, qdot_expr result, qdot_expr *value)
{
    *value = result;
    return qdot_resolve_check(s->pool, result);
}

static bool
is_equation(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_kind(pool, e) == QDOT_REL && qdot_expr_node(pool, e)->op == QDOT_EQ;
}

/* --- subs --------------------------------------------------------------------------- */

qdot_status
qdot_algebra_gather(qdot_session *s, const char *name, qdot_expr e, qdot_replacements *r)
{
    qdot_kind kind = qdot_expr_kind(s->pool, e);
    bool many = kind == QDOT_LIST || kind == QDOT_VEC;
    uint32_t n = many ? qdot_expr_count(s->pool, e) : 1;

    for (uint32_t i = 0; i < n; i++) {
        qdot_expr one = many ? qdot_expr_arg(s->pool, e, i) : e, left;

        if (!is_equation(s->pool, one)) {
            qdot_fail(QDOT_ETYPE, "%s takes equations, not %s", name,
                      qdot_resolve_kind(s->pool, one));
            return qdot_hint("as in %s", qdot_builtin_find(name)->usage);
        }
        left = qdot_expr_arg(s->pool, one, 0);
        if (qdot_expr_kind(s->pool, left) == QDOT_NUM)
            return qdot_fail(QDOT_ETYPE, "%s cannot replace a number", name);
        QDOT_TRY(qdot_vec_push(&r->from, left));
        QDOT_TRY(qdot_vec_push(&r->to, qdot_expr_arg(s->pool, one, 1)));
    }
    return QDOT_OK;
}

void
qdot_algebra_drop(qdot_replacements *r)
{
    qdot_free(r->from.at);
    qdot_free(r->to.at);
}

qdot_status
qdot_algebra_subs(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    qdot_replacements r = {0};
    qdot_status status = QDOT_OK;

    for (uint32_t i = 1; i < n && status == QDOT_OK; i++)
        status = qdot_algebra_gather(s, "subs", args[i], &r);
    if (status == QDOT_OK)
        status =
            give(s, qdot_subs(s->pool, args[0], r.from.n, r.from.at, r.to.at), value);
    qdot_algebra_drop(&r);
    return status;
}

/* --- factor, solve, eigenvalues ----------------------------------------------------- */

qdot_status
qdot_algebra_factor(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    (void)n;
    return give(s, qdot_solve_product(s->pool, args[0]), value);
}

/* solve(a = b, x), solve(e, x) of e = 0: the values of x, a list. */
qdot_status
qdot_algebra_solve(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    qdot_facts facts = qdot_scene_facts(s->scene);
    qdot_expr f = is_equation(s->pool, args[0])
                      ? qdot_sub(s->pool, qdot_expr_arg(s->pool, args[0], 0),
                                 qdot_expr_arg(s->pool, args[0], 1))
                      : args[0];
    qdot_root *roots = NULL;
    qdot_expr *values;
    size_t count = 0;
    bool complete;

    (void)n;
    if (qdot_expr_kind(s->pool, args[1]) != QDOT_SYM || args[1] <= QDOT_FALSE)
        return qdot_fail(QDOT_ETYPE, "solve(a = b, x) takes a symbol for x");
    if (!qdot_expr_is_scalar(s->pool, f))
        return qdot_fail(QDOT_ETYPE, "solve takes an equation between numbers, not %s",
                         qdot_resolve_kind(s->pool, args[0]));
    QDOT_TRY(qdot_solve(s->pool, f, args[1], &facts, &roots, &count, &complete));
    if (!complete) {
        qdot_free(roots);
        qdot_fail(QDOT_EFAILED, "this equation cannot be solved exactly%s",
                  count > 0 ? " for every x" : "");
        return qdot_hint("linear, quadratic, factorable and trigonometric equations can");
    }
    values = qdot_malloc((count + 1) * sizeof *values);
    for (size_t i = 0; values != NULL && i < count; i++)
        values[i] = roots[i].value;
    *value = values == NULL ? qdot_pool_fail(s->pool)
                            : qdot_list(s->pool, (uint32_t)count, values);
    qdot_free(values);
    qdot_free(roots);
    return qdot_resolve_check(s->pool, *value);
}

/* Every root of det(M - x 1), as often as it is one. */
static qdot_status
roots_of(qdot_session *s, qdot_expr det, qdot_expr x, uint32_t n, qdot_expr *value)
{
    qdot_pool *pool = s->pool;
    qdot_facts facts = qdot_scene_facts(s->scene);
    qdot_expr *values = qdot_malloc((n + 1) * sizeof *values);
    qdot_root *roots = NULL;
    uint32_t found = 0;
    size_t count = 0;
    bool complete = false;
    qdot_status status = QDOT_ENOMEM;

    if (values != NULL)
        status = qdot_solve(pool, det, x, &facts, &roots, &count, &complete);
    for (size_t i = 0; i < count && status == QDOT_OK; i++)
        for (qdot_expr p = det; found < n; p = qdot_diff(pool, p, x)) {
            if (p == QDOT_NIL ||
                !qdot_is_zero(pool, qdot_subs(pool, p, 1, &x, &roots[i].value), &facts))
                break;
            values[found++] = roots[i].value;
        }
    if (status == QDOT_OK && !complete)
        status = qdot_fail(QDOT_EFAILED, "the characteristic polynomial cannot be solved "
                                         "exactly");
    else if (status == QDOT_OK && found < n)
        status = qdot_fail(QDOT_EDOMAIN, "only %u of %u eigenvalues are real", found, n);
    if (status == QDOT_OK)
        status = give(s, qdot_list(pool, n, values), value);
    qdot_free(roots);
    qdot_free(values);
    return status;
}

qdot_status
qdot_algebra_eigenvalues(qdot_session *s, uint32_t n, const qdot_expr *args,
                         qdot_expr *value)
{
    qdot_pool *pool = s->pool;
    qdot_expr x = qdot_symbol_get(pool, QDOT_FORMAL, "eigenvalue"), *entries, det;
    uint32_t size;

    (void)n;
    if (qdot_expr_kind(pool, args[0]) != QDOT_MAT)
        return qdot_fail(QDOT_ETYPE, "eigenvalues takes a matrix, not %s",
                         qdot_resolve_kind(pool, args[0]));
    size = qdot_expr_node(pool, args[0])->op;
    if (size * size != qdot_expr_count(pool, args[0]))
        return qdot_fail(QDOT_ETYPE, "eigenvalues takes a square matrix");
    entries = qdot_malloc((size_t)size * size * sizeof *entries);
    if (entries == NULL)
        return QDOT_ENOMEM;
    for (uint32_t i = 0; i < size * size; i++) {
        entries[i] = qdot_expr_arg(pool, args[0], i);
        if (i % (size + 1) == 0)
            entries[i] = qdot_sub(pool, entries[i], x);
    }
    det = qdot_det(pool, qdot_matrix(pool, size, size, entries));
    qdot_free(entries);
    QDOT_TRY(qdot_resolve_check(pool, det));
    return roots_of(s, det, x, size, value);
}
