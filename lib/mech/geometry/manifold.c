/* manifold.c -- metric, inverse and Christoffel symbols of a place or line element, each found once. */
#include "mech/geometry/manifold.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/tensor.h"
#include "mech/geometry/metric.h"
#include "mech/scene/access.h"
#include "normal/simplify/simplify.h"

qdot_expr
qdot_manifold_tidy(const qdot_manifold *m, qdot_expr e)
{
    return qdot_simplify(m->pool, e, &m->facts);
}

void
qdot_manifold_end(qdot_manifold *m)
{
    qdot_free(m->q);
    qdot_free(m->riemann);
}

static bool
is_diagonal(const qdot_manifold *m)
{
    for (uint32_t i = 0; i < m->n; i++)
        for (uint32_t j = 0; j < m->n; j++)
            if (i != j && m->g[i * m->n + j] != QDOT_ZERO)
                return false;
    return true;
}

/* Compute det g and its inverse; if g is diagonal n entries suffice. */
static void
metric_invert(qdot_manifold *m)
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
        m->det = qdot_manifold_tidy(m, m->det);
        return;
    }
    inverse = qdot_matrix(pool, n, n, m->g);
    m->det = qdot_manifold_tidy(m, qdot_det(pool, inverse));
    if (m->det == QDOT_ZERO) {
        qdot_mech_fail(m->s, QDOT_EDOMAIN, "the metric is singular: its determinant is 0");
        return;
    }
    inverse = qdot_inverse(pool, inverse);
    for (uint32_t i = 0; i < n * n && inverse != QDOT_NIL; i++)
        m->inverse[i] = qdot_manifold_tidy(m, qdot_expr_arg(pool, inverse, i));
}

bool
qdot_manifold_begin(qdot_manifold *m, qdot_scene *s, qdot_expr R)
{
    qdot_expr over = qdot_mech_metric_coordinates(s, R), g = qdot_mech_metric(s, R);
    uint32_t n;

    *m = (qdot_manifold){.s = s, .pool = s->pool, .facts = qdot_scene_facts(s), .R = R};
    if (over == QDOT_NIL || g == QDOT_NIL)
        return false;
    m->n = n = qdot_expr_count(s->pool, over);
    m->pairs = n * (n - 1) / 2;
    m->q = qdot_calloc(n + 3 * n * n + n * n * n, sizeof *m->q);
    if (m->q == NULL) {
        qdot_pool_fail(s->pool);
        return false;
    }
    m->g = m->q + n;
    m->inverse = m->g + n * n;
    m->ricci = m->inverse + n * n;
    m->gamma = m->ricci + n * n;
    for (uint32_t i = 0; i < n; i++)
        m->q[i] = qdot_expr_arg(s->pool, over, i);
    for (uint32_t i = 0; i < n * n; i++)
        m->g[i] = qdot_expr_arg(s->pool, g, i);
    metric_invert(m);
    if (qdot_pool_failed(s->pool)) {
        qdot_manifold_end(m);
        return false;
    }
    return true;
}

qdot_expr
qdot_manifold_christoffel(qdot_manifold *m, uint32_t i, uint32_t j, uint32_t k)
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
    sum = qdot_manifold_tidy(m, qdot_mul(pool, QDOT_HALF, sum));
    *kept = m->gamma[(i * n + k) * n + j] = sum;
    return sum;
}

qdot_expr
qdot_manifold_matrix(qdot_manifold *m, const uint32_t *prefix,
             qdot_expr (*f)(qdot_manifold *m, const uint32_t *prefix, uint32_t row, uint32_t column))
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

qdot_expr
qdot_manifold_list(qdot_manifold *m, const uint32_t *prefix,
           qdot_expr (*f)(qdot_manifold *m, const uint32_t *prefix, uint32_t i))
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


/* --- curvature with all indices down ----------------------------------------------------------- */

/* The number of the pair i < j. */
static uint32_t
number_of_pair(const qdot_manifold *m, uint32_t i, uint32_t j)
{
    return i * m->n - i * (i + 1) / 2 + (j - i - 1);
}

/* R_ijkl = 1/2 (d_j d_k g_il + d_i d_l g_jk - d_i d_k g_jl - d_j d_l g_ik) + g_ab (G^a_jk G^b_il - G^a_jl G^b_ik). */
static qdot_expr
compute_riemann(qdot_manifold *m, uint32_t i, uint32_t j, uint32_t k, uint32_t l)
{
    qdot_pool *pool = m->pool;
    const qdot_expr *g = m->g, *q = m->q;
    const uint32_t n = m->n;
    qdot_expr sum = qdot_sum(
        pool, 4,
        (qdot_expr[]){qdot_diff(pool, qdot_diff(pool, g[i * n + l], q[j]), q[k]),
                      qdot_diff(pool, qdot_diff(pool, g[j * n + k], q[i]), q[l]),
                      qdot_neg(pool, qdot_diff(pool, qdot_diff(pool, g[j * n + l], q[i]), q[k])),
                      qdot_neg(pool, qdot_diff(pool, qdot_diff(pool, g[i * n + k], q[j]), q[l]))});

    sum = qdot_mul(pool, QDOT_HALF, sum);
    for (uint32_t a = 0; a < n; a++)
        for (uint32_t b = 0; b < n; b++) {
            qdot_expr pair;

            if (g[a * n + b] == QDOT_ZERO)
                continue;
            pair = qdot_sub(pool,
                            qdot_mul(pool, qdot_manifold_christoffel(m, a, j, k), qdot_manifold_christoffel(m, b, i, l)),
                            qdot_mul(pool, qdot_manifold_christoffel(m, a, j, l), qdot_manifold_christoffel(m, b, i, k)));
            sum = qdot_add(pool, sum, qdot_mul(pool, g[a * n + b], pair));
        }
    return qdot_manifold_tidy(m, sum);
}

/* Antisymmetric in i, j and in k, l; symmetric under exchange of the pairs. */
qdot_expr
qdot_manifold_riemann(qdot_manifold *m, uint32_t i, uint32_t j, uint32_t k, uint32_t l)
{
    const bool negative = (i > j) != (k > l);
    const uint32_t first = i < j ? number_of_pair(m, i, j) : number_of_pair(m, j, i);
    const uint32_t second = k < l ? number_of_pair(m, k, l) : number_of_pair(m, l, k);
    qdot_expr *kept;

    if (i == j || k == l)
        return QDOT_ZERO;
    if (m->riemann == NULL)
        m->riemann = qdot_calloc((size_t)m->pairs * m->pairs, sizeof *m->riemann);
    if (m->riemann == NULL)
        return qdot_pool_fail(m->pool);
    kept = &m->riemann[first * m->pairs + second];
    if (*kept == QDOT_NIL)
        *kept = m->riemann[second * m->pairs + first] =
            i < j ? k < l ? compute_riemann(m, i, j, k, l) : compute_riemann(m, i, j, l, k)
            : k < l ? compute_riemann(m, j, i, k, l) : compute_riemann(m, j, i, l, k);
    return negative ? qdot_neg(m->pool, *kept) : *kept;
}
