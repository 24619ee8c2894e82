/* curvature.c -- connection, curvature and geodesics. */
#include "mech/geometry/geometry.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "mech/geometry/manifold.h"
#include "mech/geometry/metric.h"
#include "mech/scene/access.h"
#include "normal/simplify/simplify.h"

/* R^i_jkl = g^ia R_ajkl. */
static qdot_expr
riemann_component(qdot_manifold *m, uint32_t i, uint32_t j, uint32_t k, uint32_t l)
{
    qdot_expr sum = QDOT_ZERO;

    if (k > l)
        return qdot_neg(m->pool, riemann_component(m, i, j, l, k));
    for (uint32_t a = 0; a < m->n; a++)
        if (m->inverse[i * m->n + a] != QDOT_ZERO)
            sum = qdot_add(m->pool, sum,
                           qdot_mul(m->pool, m->inverse[i * m->n + a], qdot_manifold_riemann(m, a, j, k, l)));
    return qdot_manifold_tidy(m, sum);
}

/* R_jl = g^ik R_ijkl. */
static qdot_expr
ricci_component(qdot_manifold *m, uint32_t j, uint32_t l)
{
    qdot_expr *kept = &m->ricci[j * m->n + l], sum = QDOT_ZERO;

    if (*kept != QDOT_NIL)
        return *kept;
    for (uint32_t i = 0; i < m->n; i++)
        for (uint32_t k = 0; k < m->n; k++)
            if (m->inverse[i * m->n + k] != QDOT_ZERO)
                sum = qdot_add(m->pool, sum,
                               qdot_mul(m->pool, m->inverse[i * m->n + k], qdot_manifold_riemann(m, i, j, k, l)));
    *kept = m->ricci[l * m->n + j] = qdot_manifold_tidy(m, sum);
    return *kept;
}

static qdot_expr
christoffel_entry(qdot_manifold *m, const uint32_t *prefix, uint32_t j, uint32_t k)
{
    return qdot_manifold_christoffel(m, prefix[0], j, k);
}

static qdot_expr
christoffel_matrix(qdot_manifold *m, const uint32_t *prefix, uint32_t i)
{
    (void)prefix;
    return qdot_manifold_matrix(m, &i, christoffel_entry);
}

static qdot_expr
riemann_entry(qdot_manifold *m, const uint32_t *prefix, uint32_t k, uint32_t l)
{
    return riemann_component(m, prefix[0], prefix[1], k, l);
}

static qdot_expr
riemann_row(qdot_manifold *m, const uint32_t *prefix, uint32_t j)
{
    return qdot_manifold_matrix(m, (uint32_t[]){prefix[0], j}, riemann_entry);
}

static qdot_expr
riemann_matrices(qdot_manifold *m, const uint32_t *prefix, uint32_t i)
{
    (void)prefix;
    return qdot_manifold_list(m, &i, riemann_row);
}

/* R = g^jl R_jl. */
static qdot_expr
scalar_curvature(qdot_manifold *m)
{
    qdot_expr sum = QDOT_ZERO;

    if (m->scalar != QDOT_NIL)
        return m->scalar;
    for (uint32_t j = 0; j < m->n; j++)
        for (uint32_t l = 0; l < m->n; l++)
            if (m->inverse[j * m->n + l] != QDOT_ZERO)
                sum = qdot_add(m->pool, sum,
                               qdot_mul(m->pool, m->inverse[j * m->n + l], ricci_component(m, j, l)));
    return m->scalar = qdot_manifold_tidy(m, sum);
}

/* R^ij_kl = sum over a < b of (g^ia g^jb - g^ib g^ja) R_abkl. */
static qdot_expr
riemann_of_pairs(qdot_manifold *m, uint32_t i, uint32_t j, uint32_t k, uint32_t l)
{
    qdot_pool *pool = m->pool;
    const qdot_expr *up = m->inverse;
    const uint32_t n = m->n;
    qdot_expr sum = QDOT_ZERO;

    for (uint32_t a = 0; a < n; a++)
        for (uint32_t b = a + 1; b < n; b++) {
            qdot_expr factor = qdot_sub(pool, qdot_mul(pool, up[i * n + a], up[j * n + b]),
                                        qdot_mul(pool, up[i * n + b], up[j * n + a]));

            if (factor != QDOT_ZERO)
                sum = qdot_add(pool, sum, qdot_mul(pool, factor, qdot_manifold_riemann(m, a, b, k, l)));
        }
    return qdot_manifold_tidy(m, sum);
}

/* R_ijkl R^ijkl = 4 tr X^2, X the matrix of the R^ij_kl over the pairs i < j and k < l. */
static qdot_expr
kretschmann(qdot_manifold *m)
{
    qdot_pool *pool = m->pool;
    const uint32_t size = m->pairs;
    qdot_expr *X = qdot_calloc((size_t)size * size + 1, sizeof *X), sum = QDOT_ZERO;
    uint32_t row = 0;

    if (X == NULL)
        return qdot_pool_fail(pool);
    for (uint32_t i = 0; i < m->n; i++)
        for (uint32_t j = i + 1; j < m->n; j++, row++) {
            uint32_t column = 0;

            for (uint32_t k = 0; k < m->n; k++)
                for (uint32_t l = k + 1; l < m->n; l++, column++)
                    X[row * size + column] = riemann_of_pairs(m, i, j, k, l);
        }
    for (row = 0; row < size; row++)
        for (uint32_t column = row; column < size; column++) {
            qdot_expr e = qdot_mul(pool, X[row * size + column], X[column * size + row]);

            sum = qdot_add(pool, sum, row == column ? e : qdot_mul(pool, qdot_expr_int(pool, 2), e));
        }
    qdot_free(X);
    return qdot_manifold_tidy(m, qdot_mul(pool, qdot_expr_int(pool, 4), sum));
}

/* G_jl = R_jl - 1/2 g_jl R. */
static qdot_expr
einstein_entry(qdot_manifold *m, const uint32_t *prefix, uint32_t j, uint32_t l)
{
    qdot_expr half = qdot_mul(m->pool, QDOT_HALF, qdot_mul(m->pool, m->g[j * m->n + l], scalar_curvature(m)));

    (void)prefix;
    return qdot_manifold_tidy(m, qdot_sub(m->pool, ricci_component(m, j, l), half));
}

/* C_ijkl = R_ijkl - (g_ik R_jl - g_il R_jk - g_jk R_il + g_jl R_ik)/(n - 2) + R (g_ik g_jl - g_il g_jk)/((n - 1)(n - 2)). */
static qdot_expr
weyl_down(qdot_manifold *m, uint32_t i, uint32_t j, uint32_t k, uint32_t l)
{
    qdot_pool *pool = m->pool;
    const qdot_expr *g = m->g;
    const uint32_t n = m->n;
    qdot_expr traces, both;

    if (i == j || k == l)
        return QDOT_ZERO;
    traces = qdot_sum(pool, 4,
                      (qdot_expr[]){qdot_mul(pool, g[i * n + k], ricci_component(m, j, l)),
                                    qdot_neg(pool, qdot_mul(pool, g[i * n + l], ricci_component(m, j, k))),
                                    qdot_neg(pool, qdot_mul(pool, g[j * n + k], ricci_component(m, i, l))),
                                    qdot_mul(pool, g[j * n + l], ricci_component(m, i, k))});
    both = qdot_sub(pool, qdot_mul(pool, g[i * n + k], g[j * n + l]), qdot_mul(pool, g[i * n + l], g[j * n + k]));
    both = both == QDOT_ZERO ? both : qdot_mul(pool, scalar_curvature(m), both);
    return qdot_sum(pool, 3,
                    (qdot_expr[]){qdot_manifold_riemann(m, i, j, k, l),
                                  qdot_neg(pool, qdot_div(pool, traces, qdot_expr_int(pool, (int64_t)n - 2))),
                                  qdot_div(pool, both, qdot_expr_int(pool, ((int64_t)n - 1) * ((int64_t)n - 2)))});
}

/* C^i_jkl = g^ia C_ajkl. */
static qdot_expr
weyl_entry(qdot_manifold *m, const uint32_t *prefix, uint32_t k, uint32_t l)
{
    qdot_expr sum = QDOT_ZERO;

    if (k > l)
        return qdot_neg(m->pool, weyl_entry(m, prefix, l, k));
    for (uint32_t a = 0; a < m->n; a++)
        if (m->inverse[prefix[0] * m->n + a] != QDOT_ZERO)
            sum = qdot_add(m->pool, sum,
                           qdot_mul(m->pool, m->inverse[prefix[0] * m->n + a], weyl_down(m, a, prefix[1], k, l)));
    return qdot_manifold_tidy(m, sum);
}

static qdot_expr
weyl_row(qdot_manifold *m, const uint32_t *prefix, uint32_t j)
{
    return qdot_manifold_matrix(m, (uint32_t[]){prefix[0], j}, weyl_entry);
}

static qdot_expr
weyl_matrices(qdot_manifold *m, const uint32_t *prefix, uint32_t i)
{
    (void)prefix;
    return qdot_manifold_list(m, &i, weyl_row);
}

static qdot_expr
ricci_entry(qdot_manifold *m, const uint32_t *prefix, uint32_t j, uint32_t l)
{
    (void)prefix;
    return ricci_component(m, j, l);
}

static qdot_expr
geodesic_equation(qdot_manifold *m, const uint32_t *prefix, uint32_t i)
{
    qdot_pool *pool = m->pool;
    qdot_expr sum = qdot_symbol_jet(pool, m->q[i], 2);

    (void)prefix;
    for (uint32_t j = 0; j < m->n; j++)
        for (uint32_t k = 0; k < m->n; k++)
            sum = qdot_add(pool, sum,
                           qdot_product(pool, 3,
                                        (qdot_expr[]){qdot_manifold_christoffel(m, i, j, k),
                                                      qdot_symbol_jet(pool, m->q[j], 1),
                                                      qdot_symbol_jet(pool, m->q[k], 1)}));
    return qdot_rel(pool, QDOT_EQ, qdot_manifold_tidy(m, sum), QDOT_ZERO);
}

static qdot_expr
list_for_metric(qdot_scene *s, qdot_expr R,
                qdot_expr (*f)(qdot_manifold *m, const uint32_t *prefix, uint32_t i))
{
    qdot_manifold m;
    qdot_expr result;

    if (!qdot_manifold_begin(&m, s, R))
        return QDOT_NIL;
    result = qdot_manifold_list(&m, NULL, f);
    qdot_manifold_end(&m);
    return result;
}

qdot_expr
qdot_geometry_christoffel(qdot_scene *s, qdot_expr R)
{
    return list_for_metric(s, R, christoffel_matrix);
}

qdot_expr
qdot_geometry_riemann(qdot_scene *s, qdot_expr R)
{
    return list_for_metric(s, R, riemann_matrices);
}

qdot_expr
qdot_geometry_geodesic(qdot_scene *s, qdot_expr R)
{
    return list_for_metric(s, R, geodesic_equation);
}

static qdot_expr
matrix_for_metric(qdot_scene *s, qdot_expr R,
                  qdot_expr (*f)(qdot_manifold *m, const uint32_t *prefix, uint32_t row, uint32_t column))
{
    qdot_manifold m;
    qdot_expr result;

    if (!qdot_manifold_begin(&m, s, R))
        return QDOT_NIL;
    result = qdot_manifold_matrix(&m, NULL, f);
    qdot_manifold_end(&m);
    return result;
}

qdot_expr
qdot_geometry_ricci(qdot_scene *s, qdot_expr R)
{
    return matrix_for_metric(s, R, ricci_entry);
}

qdot_expr
qdot_geometry_einstein(qdot_scene *s, qdot_expr R)
{
    return matrix_for_metric(s, R, einstein_entry);
}

qdot_expr
qdot_geometry_weyl(qdot_scene *s, qdot_expr R)
{
    qdot_manifold m;
    qdot_expr result = QDOT_NIL;

    if (!qdot_manifold_begin(&m, s, R))
        return QDOT_NIL;
    if (m.n < 3)
        qdot_mech_fail(s, QDOT_ETYPE, "weyl needs 3 or more coordinates; here there %s %u", m.n == 1 ? "is" : "are", m.n);
    else
        result = qdot_manifold_list(&m, NULL, weyl_matrices);
    qdot_manifold_end(&m);
    return result;
}

/* A number that belongs to a metric. */
static qdot_expr
number_for_metric(qdot_scene *s, qdot_expr R, qdot_expr (*f)(qdot_manifold *m))
{
    qdot_manifold m;
    qdot_expr result;

    if (!qdot_manifold_begin(&m, s, R))
        return QDOT_NIL;
    result = f(&m);
    qdot_manifold_end(&m);
    return result;
}

qdot_expr
qdot_geometry_scalar_curvature(qdot_scene *s, qdot_expr R)
{
    return number_for_metric(s, R, scalar_curvature);
}

qdot_expr
qdot_geometry_kretschmann(qdot_scene *s, qdot_expr R)
{
    return number_for_metric(s, R, kretschmann);
}

static qdot_expr
volume_element(qdot_manifold *m)
{
    /* of space and time det g < 0 */
    const qdot_expr det = qdot_expr_sign(m->pool, m->det) & QDOT_LE0 ? qdot_neg(m->pool, m->det) : m->det;

    return qdot_manifold_tidy(m, qdot_sqrt(m->pool, det));
}

qdot_expr
qdot_geometry_volume_element(qdot_scene *s, qdot_expr R)
{
    return number_for_metric(s, R, volume_element);
}
