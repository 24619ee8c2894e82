/* operators.c -- gradient, divergence, curl, Laplacian. */
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

static qdot_expr
scale_factor(const qdot_manifold *m, uint32_t i)
{
    return qdot_manifold_tidy(m, qdot_sqrt(m->pool, m->g[i * m->n + i]));
}

static qdot_expr
scale_factor_entry(qdot_manifold *m, const uint32_t *prefix, uint32_t i)
{
    (void)prefix;
    return scale_factor(m, i);
}

qdot_expr
qdot_geometry_scale_factors(qdot_scene *s, qdot_expr R)
{
    qdot_manifold m;
    qdot_expr result;

    if (!qdot_manifold_begin(&m, s, R))
        return QDOT_NIL;
    result = qdot_manifold_list(&m, NULL, scale_factor_entry);
    qdot_manifold_end(&m);
    return result;
}

/* Whether F has as many components as there are coordinates. */
static bool
components_fit(const qdot_manifold *m, qdot_expr F)
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

/* The contravariant component g^ij d_j f of the gradient. */
static qdot_expr
raised_derivative(const qdot_manifold *m, qdot_expr f, uint32_t i)
{
    qdot_expr sum = QDOT_ZERO;

    for (uint32_t j = 0; j < m->n; j++)
        if (m->inverse[i * m->n + j] != QDOT_ZERO)
            sum = qdot_add(m->pool, sum, qdot_mul(m->pool, m->inverse[i * m->n + j], qdot_diff(m->pool, f, m->q[j])));
    return sum;
}

/* A component of the gradient along the unit vector e_i: h_i g^ij d_j f, which is (1/h_i) d_i f if g is diagonal. */
static qdot_expr
gradient_component(const qdot_manifold *m, qdot_expr f, uint32_t i)
{
    qdot_expr e = m->diagonal ? qdot_div(m->pool, qdot_diff(m->pool, f, m->q[i]), scale_factor(m, i))
                              : qdot_mul(m->pool, scale_factor(m, i), raised_derivative(m, f, i));

    return qdot_manifold_tidy(m, e);
}

static bool
is_scalar_field(const qdot_manifold *m, qdot_expr f)
{
    if (f != QDOT_NIL && qdot_expr_is_scalar(m->pool, f))
        return true;
    if (f != QDOT_NIL)
        qdot_mech_fail(m->s, QDOT_ETYPE, "a scalar field belongs here");
    return false;
}

/* d_i e + 1/2 (d_i det g / det g) e: the part of the divergence that a contravariant component e contributes. */
static qdot_expr
divergence_term(const qdot_manifold *m, qdot_expr e, uint32_t i)
{
    qdot_pool *pool = m->pool;
    qdot_expr growth = qdot_div(pool, qdot_diff(pool, m->det, m->q[i]),
                                qdot_mul(pool, qdot_expr_int(pool, 2), m->det));

    return qdot_add(pool, qdot_diff(pool, e, m->q[i]), qdot_mul(pool, growth, e));
}

/* d_i h_j / h_j, computed as d_i g_jj / (2 g_jj) without the root h_j, whose sign need not be known. */
static qdot_expr
log_scale_derivative(const qdot_manifold *m, uint32_t i, uint32_t j)
{
    qdot_expr g = m->g[j * m->n + j];

    return qdot_div(m->pool, qdot_diff(m->pool, g, m->q[i]),
                    qdot_mul(m->pool, qdot_expr_int(m->pool, 2), g));
}

qdot_expr
qdot_geometry_gradient(qdot_scene *s, qdot_expr f, qdot_expr R)
{
    qdot_manifold m;
    qdot_expr result = QDOT_NIL, *parts;

    if (!qdot_manifold_begin(&m, s, R))
        return QDOT_NIL;
    parts = qdot_calloc(m.n, sizeof *parts);
    if (parts == NULL) {
        qdot_pool_fail(m.pool);
    } else if (is_scalar_field(&m, f)) {
        for (uint32_t i = 0; i < m.n; i++)
            parts[i] = gradient_component(&m, f, i);
        result = m.n == 1 ? parts[0] : qdot_vector(m.pool, m.n, parts);
    }
    qdot_free(parts);
    qdot_manifold_end(&m);
    return result;
}

qdot_expr
qdot_geometry_divergence(qdot_scene *s, qdot_expr F, qdot_expr R)
{
    qdot_manifold m;
    qdot_expr sum = QDOT_ZERO;

    if (!qdot_manifold_begin(&m, s, R))
        return QDOT_NIL;
    if (!components_fit(&m, F))
        sum = QDOT_NIL;
    for (uint32_t i = 0; i < m.n && sum != QDOT_NIL; i++) {
        qdot_expr e = divergence_term(&m, qdot_mech_component(m.pool, F, i), i);

        e = qdot_sub(m.pool, e,
                     qdot_mul(m.pool, qdot_mech_component(m.pool, F, i), log_scale_derivative(&m, i, i)));
        sum = qdot_add(m.pool, sum, qdot_div(m.pool, e, scale_factor(&m, i)));
    }
    sum = sum == QDOT_NIL ? sum : qdot_manifold_tidy(&m, sum);
    qdot_manifold_end(&m);
    return sum;
}

qdot_expr
qdot_geometry_laplacian(qdot_scene *s, qdot_expr f, qdot_expr R)
{
    qdot_manifold m;
    qdot_expr sum = QDOT_ZERO;

    if (!qdot_manifold_begin(&m, s, R))
        return QDOT_NIL;
    if (!is_scalar_field(&m, f))
        sum = QDOT_NIL;
    for (uint32_t i = 0; i < m.n && sum != QDOT_NIL; i++) {
        sum = qdot_add(m.pool, sum, divergence_term(&m, raised_derivative(&m, f, i), i));
    }
    sum = sum == QDOT_NIL ? sum : qdot_manifold_tidy(&m, sum);
    qdot_manifold_end(&m);
    return sum;
}

/* +1 or -1 as the frame is right- or left-handed in the space R lies in; 1 where it spans a
 * surface in space or where only ds^2 is known. */
static qdot_expr
frame_handedness(const qdot_manifold *m)
{
    qdot_pool *pool = m->pool;
    qdot_expr entries[9], sign = QDOT_ONE;
    uint32_t n = m->n;

    if (qdot_mech_dimension(pool, m->R) != n)
        return QDOT_ONE;
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t d = 0; d < n; d++)
            entries[i * n + d] = qdot_diff(pool, qdot_mech_component(pool, m->R, d), m->q[i]);
    for (uint32_t i = 0; i < n && m->diagonal; i++)
        sign = qdot_mul(pool, sign, scale_factor(m, i));
    if (!m->diagonal)
        sign = qdot_sqrt(pool, m->det);
    return qdot_manifold_tidy(m, qdot_div(pool, qdot_det(pool, qdot_matrix(pool, n, n, entries)), sign));
}

/* d_i (h_j F_j) / (h_i h_j), one half of a component of the curl: (1/h_i) (d_i F_j + F_j d_i h_j / h_j). */
static qdot_expr
curl_half(const qdot_manifold *m, qdot_expr F, uint32_t i, uint32_t j)
{
    qdot_pool *pool = m->pool;
    qdot_expr Fj = qdot_mech_component(pool, F, j);
    qdot_expr e = qdot_add(pool, qdot_diff(pool, Fj, m->q[i]),
                           qdot_mul(pool, Fj, log_scale_derivative(m, i, j)));

    return qdot_div(pool, e, scale_factor(m, i));
}

/* The covariant component g_kl F_l/h_l of a field. */
static qdot_expr
lowered_component(const qdot_manifold *m, qdot_expr F, uint32_t k)
{
    qdot_pool *pool = m->pool;
    qdot_expr sum = QDOT_ZERO;

    for (uint32_t l = 0; l < m->n; l++)
        if (m->g[k * m->n + l] != QDOT_ZERO)
            sum = qdot_add(pool, sum,
                           qdot_mul(pool, m->g[k * m->n + l],
                                    qdot_div(pool, qdot_mech_component(pool, F, l), scale_factor(m, l))));
    return sum;
}

/* A component of the curl, along e_k where there are three coordinates, i, j, k in cyclic order: (d_i (h_j F_j) -
 * d_j (h_i F_i)) / (h_i h_j); if g is not diagonal h_k (d_i f_j - d_j f_i)/w of the covariant components f. */
static qdot_expr
curl_component(const qdot_manifold *m, qdot_expr F, uint32_t i, uint32_t j)
{
    qdot_pool *pool = m->pool;
    qdot_expr e;

    if (m->diagonal)
        return qdot_sub(pool, curl_half(m, F, i, j), curl_half(m, F, j, i));
    e = qdot_sub(pool, qdot_diff(pool, lowered_component(m, F, j), m->q[i]),
                 qdot_diff(pool, lowered_component(m, F, i), m->q[j]));
    if (m->n == 3)
        e = qdot_mul(pool, e, scale_factor(m, 3 - i - j));
    return qdot_div(pool, e, qdot_sqrt(pool, m->det));
}

qdot_expr
qdot_geometry_curl(qdot_scene *s, qdot_expr F, qdot_expr R)
{
    qdot_manifold m;
    qdot_expr result = QDOT_NIL, c[3], turn;

    if (!qdot_manifold_begin(&m, s, R))
        return QDOT_NIL;
    if (m.n != 2 && m.n != 3) {
        qdot_mech_fail(s, QDOT_ETYPE, "curl needs 2 or 3 coordinates; here there %s %u",
                       m.n == 1 ? "is" : "are", m.n);
    } else if (components_fit(&m, F)) {
        turn = frame_handedness(&m);
        if (m.n == 2) {
            result = qdot_manifold_tidy(&m, qdot_mul(m.pool, turn, curl_component(&m, F, 0, 1)));
        } else {
            for (uint32_t i = 0; i < 3; i++)
                c[i] = qdot_manifold_tidy(&m, qdot_mul(m.pool, turn, curl_component(&m, F, (i + 1) % 3, (i + 2) % 3)));
            result = qdot_vector(m.pool, 3, c);
        }
    }
    qdot_manifold_end(&m);
    return result;
}
