/* tensors.c -- covariant derivative, Lie derivative, commutator. */
#include "mech/geometry/tensors.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/geometry/forms.h"
#include "mech/geometry/manifold.h"
#include "mech/scene/access.h"
#include "normal/simplify/simplify.h"

static qdot_expr
differential_of(qdot_pool *pool, qdot_expr q)
{
    return qdot_symbol_of(pool, QDOT_DIFFERENTIAL, q);
}

/* Whether V is a vector of n components, else the pool keeps the failure. */
static bool
has_components(qdot_scene *s, qdot_expr V, uint32_t n)
{
    if (V == QDOT_NIL)
        return false;
    if (qdot_mech_dimension(s->pool, V) == n)
        return true;
    qdot_mech_fail(s, QDOT_ETYPE, "a vector field needs %u component%s, one for each coordinate", n, n == 1 ? "" : "s");
    return false;
}

static bool
is_square(qdot_scene *s, qdot_expr T, uint32_t n)
{
    if (qdot_expr_node(s->pool, T)->op == n && qdot_expr_count(s->pool, T) == n * n)
        return true;
    qdot_mech_fail(s, QDOT_ETYPE, "a tensor with two indices is a %u x %u matrix here", n, n);
    return false;
}

/* --- covariant derivative ---------------------------------------------------------------------- */

/* Whether V is a sum of f_i dq_i; its components w [n]. */
static bool
one_form_components(const qdot_manifold *m, qdot_expr V, qdot_expr *w)
{
    qdot_expr rest = V;

    for (uint32_t i = 0; i < m->n; i++) {
        qdot_expr dq = differential_of(m->pool, m->q[i]);

        w[i] = qdot_diff(m->pool, V, dq);
        rest = qdot_sub(m->pool, rest, qdot_mul(m->pool, w[i], dq));
    }
    rest = qdot_manifold_tidy(m, rest);
    for (uint32_t i = 0; i < m->n && rest == QDOT_ZERO; i++)
        if (w[i] == QDOT_NIL || (qdot_mech_holds(m->s, w[i]) & QDOT_HAS_DIFFERENTIAL))
            rest = QDOT_ONE;
    if (rest != QDOT_ZERO && rest != QDOT_NIL)
        qdot_mech_fail(m->s, QDOT_ETYPE, "a one-form is a sum of f*dq over the coordinates of the metric");
    return rest == QDOT_ZERO;
}

/* d_j V^i + G^i_jk V^k, or d_j w_i - G^k_ij w_k of the components V. */
static qdot_expr
derivative_of_component(qdot_manifold *m, const qdot_expr *V, bool upper, uint32_t i, uint32_t j)
{
    qdot_pool *pool = m->pool;
    qdot_expr sum = qdot_diff(pool, V[i], m->q[j]);

    for (uint32_t k = 0; k < m->n; k++) {
        qdot_expr G = upper ? qdot_manifold_christoffel(m, i, j, k) : qdot_neg(pool, qdot_manifold_christoffel(m, k, i, j));

        sum = qdot_add(pool, sum, qdot_mul(pool, G, V[k]));
    }
    return qdot_manifold_tidy(m, sum);
}

/* d_k T_ij - G^a_ik T_aj - G^a_jk T_ia. */
static qdot_expr
derivative_of_entry(qdot_manifold *m, qdot_expr T, uint32_t i, uint32_t j, uint32_t k)
{
    qdot_pool *pool = m->pool;
    const uint32_t n = m->n;
    qdot_expr sum = qdot_diff(pool, qdot_expr_arg(pool, T, i * n + j), m->q[k]);

    for (uint32_t a = 0; a < n; a++) {
        sum = qdot_sub(pool, sum,
                       qdot_mul(pool, qdot_manifold_christoffel(m, a, i, k), qdot_expr_arg(pool, T, a * n + j)));
        sum = qdot_sub(pool, sum,
                       qdot_mul(pool, qdot_manifold_christoffel(m, a, j, k), qdot_expr_arg(pool, T, i * n + a)));
    }
    return qdot_manifold_tidy(m, sum);
}

static qdot_expr
covariant_of_matrix(qdot_manifold *m, qdot_expr T, qdot_expr *work)
{
    const uint32_t n = m->n;
    qdot_expr *rows = work + n * n;

    for (uint32_t i = 0; i < n; i++) {
        for (uint32_t j = 0; j < n * n; j++)
            work[j] = derivative_of_entry(m, T, i, j / n, j % n);
        rows[i] = qdot_matrix(m->pool, n, n, work);
    }
    return qdot_list(m->pool, n, rows);
}

static qdot_expr
covariant_of_components(qdot_manifold *m, const qdot_expr *V, bool upper, qdot_expr *work)
{
    for (uint32_t i = 0; i < m->n * m->n; i++)
        work[i] = derivative_of_component(m, V, upper, i / m->n, i % m->n);
    return qdot_matrix(m->pool, m->n, m->n, work);
}

static qdot_expr
covariant_of_scalar(const qdot_manifold *m, qdot_expr f, qdot_expr *work)
{
    for (uint32_t i = 0; i < m->n; i++)
        work[i] = qdot_manifold_tidy(m, qdot_diff(m->pool, f, m->q[i]));
    return m->n == 1 ? work[0] : qdot_vector(m->pool, m->n, work);
}

qdot_expr
qdot_tensors_covariant(qdot_scene *s, qdot_expr V, qdot_expr R)
{
    qdot_manifold m;
    qdot_expr result = QDOT_NIL, *work, *w;

    if (V == QDOT_NIL || !qdot_manifold_begin(&m, s, R))
        return QDOT_NIL;
    work = qdot_calloc((size_t)m.n * m.n + 2 * m.n, sizeof *work);
    if (work == NULL) {
        qdot_pool_fail(s->pool);
        qdot_manifold_end(&m);
        return QDOT_NIL;
    }
    w = work + m.n * m.n + m.n;
    if (qdot_expr_kind(s->pool, V) == QDOT_MAT) {
        if (is_square(s, V, m.n))
            result = covariant_of_matrix(&m, V, work);
    } else if (qdot_expr_kind(s->pool, V) == QDOT_VEC) {
        if (has_components(s, V, m.n)) {
            for (uint32_t i = 0; i < m.n; i++)
                w[i] = qdot_expr_arg(s->pool, V, i);
            result = covariant_of_components(&m, w, true, work);
        }
    } else if (!qdot_expr_is_scalar(s->pool, V)) {
        qdot_mech_fail(s, QDOT_ETYPE, "covariant takes a number, a vector, a one-form or a matrix");
    } else if (!(qdot_mech_holds(s, V) & QDOT_HAS_DIFFERENTIAL)) {
        result = covariant_of_scalar(&m, V, work);
    } else if (one_form_components(&m, V, w)) {
        result = covariant_of_components(&m, w, false, work);
    }
    qdot_free(work);
    qdot_manifold_end(&m);
    return result;
}

/* --- Lie derivative and commutator ---------------------------------------------------------------- */

/* X^k d_k e. */
static qdot_expr
derivative_along(qdot_scene *s, qdot_expr e, qdot_expr X, uint32_t n, const qdot_expr *q)
{
    qdot_expr sum = QDOT_ZERO;

    for (uint32_t k = 0; k < n; k++)
        sum = qdot_add(s->pool, sum,
                       qdot_mul(s->pool, qdot_mech_component(s->pool, X, k), qdot_diff(s->pool, e, q[k])));
    return sum;
}

qdot_expr
qdot_tensors_commutator(qdot_scene *s, qdot_expr X, qdot_expr Y, uint32_t n, const qdot_expr *q)
{
    qdot_facts facts = qdot_scene_facts(s);
    qdot_expr *parts, result;

    if (!has_components(s, X, n) || !has_components(s, Y, n))
        return QDOT_NIL;
    parts = qdot_calloc(n, sizeof *parts);
    if (parts == NULL)
        return qdot_pool_fail(s->pool);
    for (uint32_t i = 0; i < n; i++) {
        qdot_expr forth = derivative_along(s, qdot_mech_component(s->pool, Y, i), X, n, q);
        qdot_expr back = derivative_along(s, qdot_mech_component(s->pool, X, i), Y, n, q);

        parts[i] = qdot_simplify(s->pool, qdot_sub(s->pool, forth, back), &facts);
    }
    result = n == 1 ? parts[0] : qdot_vector(s->pool, n, parts);
    qdot_free(parts);
    return result;
}

/* The sum over i of (dw/d(dq_i)) d_k X^i dq_k. */
static qdot_expr
change_of_differentials(qdot_scene *s, qdot_expr w, qdot_expr X, uint32_t n, const qdot_expr *q)
{
    qdot_pool *pool = s->pool;
    qdot_expr sum = QDOT_ZERO;

    for (uint32_t i = 0; i < n; i++) {
        qdot_expr slope = qdot_diff(pool, w, differential_of(pool, q[i])), step = QDOT_ZERO;

        for (uint32_t k = 0; k < n && slope != QDOT_ZERO; k++)
            step = qdot_add(pool, step, qdot_mul(pool, qdot_diff(pool, qdot_mech_component(pool, X, i), q[k]),
                                                 differential_of(pool, q[k])));
        sum = qdot_add(pool, sum, qdot_mul(pool, slope, step));
    }
    return sum;
}

static qdot_expr
lie_of_matrix(qdot_scene *s, qdot_expr T, qdot_expr X, uint32_t n, const qdot_expr *q)
{
    qdot_pool *pool = s->pool;
    qdot_facts facts = qdot_scene_facts(s);
    qdot_expr *entries = qdot_calloc((size_t)n * n, sizeof *entries), result;

    if (entries == NULL)
        return qdot_pool_fail(pool);
    for (uint32_t e = 0; e < n * n; e++) {
        const uint32_t i = e / n, j = e % n;
        qdot_expr sum = derivative_along(s, qdot_expr_arg(pool, T, e), X, n, q);

        for (uint32_t k = 0; k < n; k++) {
            qdot_expr Xk = qdot_mech_component(pool, X, k);

            sum = qdot_add(pool, sum, qdot_mul(pool, qdot_expr_arg(pool, T, k * n + j), qdot_diff(pool, Xk, q[i])));
            sum = qdot_add(pool, sum, qdot_mul(pool, qdot_expr_arg(pool, T, i * n + k), qdot_diff(pool, Xk, q[j])));
        }
        entries[e] = qdot_simplify(pool, sum, &facts);
    }
    result = qdot_matrix(pool, n, n, entries);
    qdot_free(entries);
    return result;
}

qdot_expr
qdot_tensors_lie(qdot_scene *s, qdot_expr V, qdot_expr X, uint32_t n, const qdot_expr *q)
{
    qdot_facts facts = qdot_scene_facts(s);
    qdot_kind kind = qdot_expr_kind(s->pool, V);

    if (V == QDOT_NIL || !has_components(s, X, n))
        return QDOT_NIL;
    if (kind == QDOT_VEC)
        return qdot_tensors_commutator(s, X, V, n, q);
    if (kind == QDOT_MAT)
        return is_square(s, V, n) ? lie_of_matrix(s, V, X, n, q) : QDOT_NIL;
    if (!qdot_expr_is_scalar(s->pool, V))
        return qdot_mech_fail(s, QDOT_ETYPE, "lie_derivative takes a number, a vector, a form or a matrix");
    if (qdot_forms_has_product(s, V))
        return qdot_forms_lie(s, V, X, n, q);
    return qdot_simplify(s->pool, qdot_add(s->pool, derivative_along(s, V, X, n, q), change_of_differentials(s, V, X, n, q)),
                         &facts);
}
