/* geometry.c -- Christoffel symbols, curvature, geodesics; grad, div, curl, Laplace. */
#include "mech/geometry/geometry.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "mech/geometry/metric.h"
#include "mech/scene/access.h"
#include "normal/simplify/simplify.h"

/* The metric of positions R, and properties that follow from it: the determinant, whether it is diagonal. */
typedef struct {
    qdot_scene *s;
    qdot_pool *pool;
    qdot_facts facts;
    qdot_expr R, det;
    uint32_t n;
    bool diagonal;
    qdot_expr *q;       /* [n] coordinates */
    qdot_expr *g;       /* [n*n] metric g_ij */
    qdot_expr *inverse; /* [n*n] inverse metric g^ij */
    qdot_expr *gamma;   /* [n*n*n] Christoffel symbols; nil until requested */
} geometry;

static qdot_expr
simplify_entry(const geometry *m, qdot_expr e)
{
    return qdot_simplify(m->pool, e, &m->facts);
}

static void
geometry_end(geometry *m)
{
    qdot_free(m->q);
}

static bool
is_diagonal(const geometry *m)
{
    for (uint32_t i = 0; i < m->n; i++)
        for (uint32_t j = 0; j < m->n; j++)
            if (i != j && m->g[i * m->n + j] != QDOT_ZERO)
                return false;
    return true;
}

/* Compute det g and its inverse; if g is diagonal n entries suffice. */
static void
metric_invert(geometry *m)
{
    qdot_pool *pool = m->pool;
    uint32_t n = m->n;
    qdot_expr inverse;

    m->diagonal = is_diagonal(m);
    if (m->diagonal) {
        m->det = QDOT_ONE;
        for (uint32_t i = 0; i < n; i++) {
            m->det = qdot_mul(pool, m->det, m->g[i * n + i]);
            for (uint32_t j = 0; j < n; j++)
                m->inverse[i * n + j] = QDOT_ZERO;
            m->inverse[i * n + i] = qdot_pow_int(pool, m->g[i * n + i], -1);
        }
        m->det = simplify_entry(m, m->det);
        return;
    }
    inverse = qdot_matrix(pool, n, n, m->g);
    m->det = simplify_entry(m, qdot_det(pool, inverse));
    if (m->det == QDOT_ZERO) {
        qdot_mech_fail(m->s, QDOT_EDOMAIN, "the metric is singular: its determinant is 0");
        return;
    }
    inverse = qdot_inverse(pool, inverse);
    for (uint32_t i = 0; i < n * n && inverse != QDOT_NIL; i++)
        m->inverse[i] = simplify_entry(m, qdot_expr_arg(pool, inverse, i));
}

static bool
geometry_begin(geometry *m, qdot_scene *s, qdot_expr R)
{
    qdot_expr over = qdot_mech_metric_coordinates(s, R), g = qdot_mech_metric(s, R);
    uint32_t n;

    *m = (geometry){.s = s, .pool = s->pool, .facts = qdot_scene_facts(s), .R = R};
    if (over == QDOT_NIL || g == QDOT_NIL)
        return false;
    m->n = n = qdot_expr_count(s->pool, over);
    m->q = qdot_calloc(n + 2 * n * n + n * n * n, sizeof *m->q);
    if (m->q == NULL) {
        qdot_pool_fail(s->pool);
        return false;
    }
    m->g = m->q + n;
    m->inverse = m->g + n * n;
    m->gamma = m->inverse + n * n;
    for (uint32_t i = 0; i < n; i++)
        m->q[i] = qdot_expr_arg(s->pool, over, i);
    for (uint32_t i = 0; i < n * n; i++)
        m->g[i] = qdot_expr_arg(s->pool, g, i);
    metric_invert(m);
    if (qdot_pool_failed(s->pool)) {
        geometry_end(m);
        return false;
    }
    return true;
}

/* --- connection and curvature ------------------------------------------------------------- */

static qdot_expr
christoffel_symbol(geometry *m, uint32_t i, uint32_t j, uint32_t k)
{
    qdot_pool *pool = m->pool;
    uint32_t n = m->n;
    qdot_expr *kept = &m->gamma[(i * n + j) * n + k], sum = QDOT_ZERO;

    if (*kept != QDOT_NIL)
        return *kept;
    for (uint32_t l = 0; l < n; l++) {
        qdot_expr slope;

        if (m->inverse[i * n + l] == QDOT_ZERO)
            continue;
        slope = qdot_sum(pool, 3,
                         (qdot_expr[]){qdot_diff(pool, m->g[l * n + k], m->q[j]),
                                       qdot_diff(pool, m->g[l * n + j], m->q[k]),
                                       qdot_neg(pool, qdot_diff(pool, m->g[j * n + k], m->q[l]))});
        sum = qdot_add(pool, sum, qdot_mul(pool, m->inverse[i * n + l], slope));
    }
    sum = simplify_entry(m, qdot_mul(pool, QDOT_HALF, sum));
    *kept = m->gamma[(i * n + k) * n + j] = sum;
    return sum;
}

static qdot_expr
riemann_component(geometry *m, uint32_t i, uint32_t j, uint32_t k, uint32_t l)
{
    qdot_pool *pool = m->pool;
    qdot_expr sum;

    if (k == l)
        return QDOT_ZERO;
    sum = qdot_sub(pool, qdot_diff(pool, christoffel_symbol(m, i, l, j), m->q[k]),
                   qdot_diff(pool, christoffel_symbol(m, i, k, j), m->q[l]));
    for (uint32_t a = 0; a < m->n; a++)
        sum = qdot_sum(pool, 3,
                       (qdot_expr[]){sum,
                                     qdot_mul(pool, christoffel_symbol(m, i, k, a), christoffel_symbol(m, a, l, j)),
                                     qdot_neg(pool, qdot_mul(pool, christoffel_symbol(m, i, l, a),
                                                             christoffel_symbol(m, a, k, j)))});
    return simplify_entry(m, sum);
}

static qdot_expr
ricci_component(geometry *m, uint32_t j, uint32_t l)
{
    qdot_expr sum = QDOT_ZERO;

    for (uint32_t i = 0; i < m->n; i++)
        sum = qdot_add(m->pool, sum, riemann_component(m, i, j, i, l));
    return simplify_entry(m, sum);
}

/* The n x n matrix whose entry in row i and column j is f(m, prefix, i, j). */
static qdot_expr
build_matrix(geometry *m, const uint32_t *prefix,
             qdot_expr (*f)(geometry *m, const uint32_t *prefix, uint32_t row, uint32_t column))
{
    uint32_t n = m->n;
    qdot_expr *entries = qdot_calloc((size_t)n * n, sizeof *entries), result;

    if (entries == NULL)
        return qdot_pool_fail(m->pool);
    for (uint32_t i = 0; i < n * n; i++)
        entries[i] = f(m, prefix, i / n, i % n);
    result = qdot_matrix(m->pool, n, n, entries);
    qdot_free(entries);
    return result;
}

/* The LIST with the members f(m, prefix, i), i = 1 ... n. */
static qdot_expr
build_list(geometry *m, const uint32_t *prefix,
           qdot_expr (*f)(geometry *m, const uint32_t *prefix, uint32_t i))
{
    qdot_expr *members = qdot_calloc(m->n, sizeof *members), result;

    if (members == NULL)
        return qdot_pool_fail(m->pool);
    for (uint32_t i = 0; i < m->n; i++)
        members[i] = f(m, prefix, i);
    result = qdot_list(m->pool, m->n, members);
    qdot_free(members);
    return result;
}

static qdot_expr
christoffel_entry(geometry *m, const uint32_t *prefix, uint32_t j, uint32_t k)
{
    return christoffel_symbol(m, prefix[0], j, k);
}

static qdot_expr
christoffel_matrix(geometry *m, const uint32_t *prefix, uint32_t i)
{
    (void)prefix;
    return build_matrix(m, &i, christoffel_entry);
}

static qdot_expr
riemann_entry(geometry *m, const uint32_t *prefix, uint32_t k, uint32_t l)
{
    return riemann_component(m, prefix[0], prefix[1], k, l);
}

static qdot_expr
riemann_row(geometry *m, const uint32_t *prefix, uint32_t j)
{
    return build_matrix(m, (uint32_t[]){prefix[0], j}, riemann_entry);
}

static qdot_expr
riemann_matrices(geometry *m, const uint32_t *prefix, uint32_t i)
{
    (void)prefix;
    return build_list(m, &i, riemann_row);
}

static qdot_expr
ricci_entry(geometry *m, const uint32_t *prefix, uint32_t j, uint32_t l)
{
    (void)prefix;
    return ricci_component(m, j, l);
}

static qdot_expr
geodesic_equation(geometry *m, const uint32_t *prefix, uint32_t i)
{
    qdot_pool *pool = m->pool;
    qdot_expr sum = qdot_symbol_jet(pool, m->q[i], 2);

    (void)prefix;
    for (uint32_t j = 0; j < m->n; j++)
        for (uint32_t k = 0; k < m->n; k++)
            sum = qdot_add(pool, sum,
                           qdot_product(pool, 3,
                                        (qdot_expr[]){christoffel_symbol(m, i, j, k),
                                                      qdot_symbol_jet(pool, m->q[j], 1),
                                                      qdot_symbol_jet(pool, m->q[k], 1)}));
    return qdot_rel(pool, QDOT_EQ, simplify_entry(m, sum), QDOT_ZERO);
}

static qdot_expr
scale_factor(const geometry *m, uint32_t i)
{
    return simplify_entry(m, qdot_sqrt(m->pool, m->g[i * m->n + i]));
}

static qdot_expr
scale_factor_entry(geometry *m, const uint32_t *prefix, uint32_t i)
{
    (void)prefix;
    return scale_factor(m, i);
}

static qdot_expr
list_for_metric(qdot_scene *s, qdot_expr R,
                qdot_expr (*f)(geometry *m, const uint32_t *prefix, uint32_t i))
{
    geometry m;
    qdot_expr result;

    if (!geometry_begin(&m, s, R))
        return QDOT_NIL;
    result = build_list(&m, NULL, f);
    geometry_end(&m);
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

qdot_expr
qdot_geometry_scale_factors(qdot_scene *s, qdot_expr R)
{
    return list_for_metric(s, R, scale_factor_entry);
}

qdot_expr
qdot_geometry_ricci(qdot_scene *s, qdot_expr R)
{
    geometry m;
    qdot_expr result;

    if (!geometry_begin(&m, s, R))
        return QDOT_NIL;
    result = build_matrix(&m, NULL, ricci_entry);
    geometry_end(&m);
    return result;
}

qdot_expr
qdot_geometry_scalar_curvature(qdot_scene *s, qdot_expr R)
{
    geometry m;
    qdot_expr sum = QDOT_ZERO;

    if (!geometry_begin(&m, s, R))
        return QDOT_NIL;
    for (uint32_t j = 0; j < m.n; j++)
        for (uint32_t l = 0; l < m.n; l++)
            if (m.inverse[j * m.n + l] != QDOT_ZERO)
                sum = qdot_add(m.pool, sum,
                               qdot_mul(m.pool, m.inverse[j * m.n + l], ricci_component(&m, j, l)));
    sum = simplify_entry(&m, sum);
    geometry_end(&m);
    return sum;
}

qdot_expr
qdot_geometry_volume_element(qdot_scene *s, qdot_expr R)
{
    geometry m;
    qdot_expr w;

    if (!geometry_begin(&m, s, R))
        return QDOT_NIL;
    w = simplify_entry(&m, qdot_sqrt(m.pool, m.det));
    geometry_end(&m);
    return w;
}

/* --- vector operators ---------------------------------------------------------------------- */

static bool
begin_orthogonal(geometry *m, qdot_scene *s, qdot_expr R)
{
    if (!geometry_begin(m, s, R))
        return false;
    if (m->diagonal)
        return true;
    qdot_mech_fail(s, QDOT_ETYPE, "the vector operators need orthogonal coordinates; here the "
                                  "metric has entries off its diagonal");
    geometry_end(m);
    return false;
}

/* Whether F has as many components as there are coordinates. */
static bool
components_fit(const geometry *m, qdot_expr F)
{
    uint32_t n = qdot_mech_dimension(m->pool, F);

    if (F == QDOT_NIL)
        return false;
    if (n == m->n)
        return true;
    qdot_mech_fail(m->s, QDOT_ETYPE, "the field needs %u component%s, one for each coordinate of r, not %u",
                   m->n, m->n == 1 ? "" : "s", n);
    return false;
}

static bool
is_scalar_field(const geometry *m, qdot_expr f)
{
    if (f != QDOT_NIL && qdot_expr_is_scalar(m->pool, f))
        return true;
    if (f != QDOT_NIL)
        qdot_mech_fail(m->s, QDOT_ETYPE, "a scalar field belongs here");
    return false;
}

/* d_i e + 1/2 (d_i det g / det g) e: the part of the divergence that a contravariant component e contributes. */
static qdot_expr
divergence_term(const geometry *m, qdot_expr e, uint32_t i)
{
    qdot_pool *pool = m->pool;
    qdot_expr growth = qdot_div(pool, qdot_diff(pool, m->det, m->q[i]),
                                qdot_mul(pool, qdot_expr_int(pool, 2), m->det));

    return qdot_add(pool, qdot_diff(pool, e, m->q[i]), qdot_mul(pool, growth, e));
}

/* d_i h_j / h_j, computed as d_i g_jj / (2 g_jj) without the root h_j, whose sign need not be known. */
static qdot_expr
log_scale_derivative(const geometry *m, uint32_t i, uint32_t j)
{
    qdot_expr g = m->g[j * m->n + j];

    return qdot_div(m->pool, qdot_diff(m->pool, g, m->q[i]),
                    qdot_mul(m->pool, qdot_expr_int(m->pool, 2), g));
}

qdot_expr
qdot_geometry_gradient(qdot_scene *s, qdot_expr f, qdot_expr R)
{
    geometry m;
    qdot_expr result = QDOT_NIL, *parts;

    if (!begin_orthogonal(&m, s, R))
        return QDOT_NIL;
    parts = qdot_calloc(m.n, sizeof *parts);
    if (parts == NULL) {
        qdot_pool_fail(m.pool);
    } else if (is_scalar_field(&m, f)) {
        for (uint32_t i = 0; i < m.n; i++)
            parts[i] = simplify_entry(&m, qdot_div(m.pool, qdot_diff(m.pool, f, m.q[i]), scale_factor(&m, i)));
        result = m.n == 1 ? parts[0] : qdot_vector(m.pool, m.n, parts);
    }
    qdot_free(parts);
    geometry_end(&m);
    return result;
}

qdot_expr
qdot_geometry_divergence(qdot_scene *s, qdot_expr F, qdot_expr R)
{
    geometry m;
    qdot_expr sum = QDOT_ZERO;

    if (!begin_orthogonal(&m, s, R))
        return QDOT_NIL;
    if (!components_fit(&m, F))
        sum = QDOT_NIL;
    for (uint32_t i = 0; i < m.n && sum != QDOT_NIL; i++) {
        qdot_expr e = divergence_term(&m, qdot_mech_component(m.pool, F, i), i);

        e = qdot_sub(m.pool, e,
                     qdot_mul(m.pool, qdot_mech_component(m.pool, F, i), log_scale_derivative(&m, i, i)));
        sum = qdot_add(m.pool, sum, qdot_div(m.pool, e, scale_factor(&m, i)));
    }
    sum = sum == QDOT_NIL ? sum : simplify_entry(&m, sum);
    geometry_end(&m);
    return sum;
}

qdot_expr
qdot_geometry_laplacian(qdot_scene *s, qdot_expr f, qdot_expr R)
{
    geometry m;
    qdot_expr sum = QDOT_ZERO;

    if (!begin_orthogonal(&m, s, R))
        return QDOT_NIL;
    if (!is_scalar_field(&m, f))
        sum = QDOT_NIL;
    for (uint32_t i = 0; i < m.n && sum != QDOT_NIL; i++) {
        qdot_expr e = qdot_mul(m.pool, m.inverse[i * m.n + i], qdot_diff(m.pool, f, m.q[i]));

        sum = qdot_add(m.pool, sum, divergence_term(&m, e, i));
    }
    sum = sum == QDOT_NIL ? sum : simplify_entry(&m, sum);
    geometry_end(&m);
    return sum;
}

/* +1 or -1 as the frame is right- or left-handed in the space R lies in; 1 where it spans a
 * surface in space or where only ds^2 is known. */
static qdot_expr
frame_handedness(const geometry *m)
{
    qdot_pool *pool = m->pool;
    qdot_expr entries[9], sign = QDOT_ONE;
    uint32_t n = m->n;

    if (qdot_mech_dimension(pool, m->R) != n)
        return QDOT_ONE;
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t d = 0; d < n; d++)
            entries[i * n + d] = qdot_diff(pool, qdot_mech_component(pool, m->R, d), m->q[i]);
    for (uint32_t i = 0; i < n; i++)
        sign = qdot_mul(pool, sign, scale_factor(m, i));
    return simplify_entry(m, qdot_div(pool, qdot_det(pool, qdot_matrix(pool, n, n, entries)), sign));
}

/* d_i (h_j F_j) / (h_i h_j), one half of a component of the curl: (1/h_i) (d_i F_j + F_j d_i h_j / h_j). */
static qdot_expr
curl_half(const geometry *m, qdot_expr F, uint32_t i, uint32_t j)
{
    qdot_pool *pool = m->pool;
    qdot_expr Fj = qdot_mech_component(pool, F, j);
    qdot_expr e = qdot_add(pool, qdot_diff(pool, Fj, m->q[i]),
                           qdot_mul(pool, Fj, log_scale_derivative(m, i, j)));

    return qdot_div(pool, e, scale_factor(m, i));
}

/* A component of the curl: (d_i (h_j F_j) - d_j (h_i F_i)) / (h_i h_j). */
static qdot_expr
curl_component(const geometry *m, qdot_expr F, uint32_t i, uint32_t j)
{
    return qdot_sub(m->pool, curl_half(m, F, i, j), curl_half(m, F, j, i));
}

qdot_expr
qdot_geometry_curl(qdot_scene *s, qdot_expr F, qdot_expr R)
{
    geometry m;
    qdot_expr result = QDOT_NIL, c[3], turn;

    if (!begin_orthogonal(&m, s, R))
        return QDOT_NIL;
    if (m.n != 2 && m.n != 3) {
        qdot_mech_fail(s, QDOT_ETYPE, "curl needs 2 or 3 coordinates; here there %s %u",
                       m.n == 1 ? "is" : "are", m.n);
    } else if (components_fit(&m, F)) {
        turn = frame_handedness(&m);
        if (m.n == 2) {
            result = simplify_entry(&m, qdot_mul(m.pool, turn, curl_component(&m, F, 0, 1)));
        } else {
            for (uint32_t i = 0; i < 3; i++)
                c[i] = simplify_entry(&m, qdot_mul(m.pool, turn, curl_component(&m, F, (i + 1) % 3, (i + 2) % 3)));
            result = qdot_vector(m.pool, 3, c);
        }
    }
    geometry_end(&m);
    return result;
}
