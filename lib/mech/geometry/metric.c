/* metric.c -- ds^2 = sum (dr/dq_i . dr/dq_j) dq_i dq_j of a place r(q, t), and back
 * again. */
#include "mech/geometry/metric.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/scene/access.h"
#include "normal/form/common.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"

/* Whether the argument R is a line element in the differentials dq, not a position. */
static bool
is_line_element(const qdot_scene *s, qdot_expr R)
{
    return qdot_mech_holds(s, R) & QDOT_HAS_DIFFERENTIAL;
}

static bool
check_metric_argument(qdot_scene *s, qdot_expr R)
{
    uint32_t n = qdot_mech_dimension(s->pool, R);

    if (R == QDOT_NIL)
        return false;
    if (n == 0 || (is_line_element(s, R) && n != 1)) {
        qdot_mech_fail(s, QDOT_ETYPE,
                       "a position r(q) or a line element in dq belongs here");
        return false;
    }
    if (qdot_mech_holds(s, R) &
        (QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_DELTA |
         QDOT_HAS_MULTIPLIER | QDOT_HAS_MOMENTUM)) {
        qdot_mech_fail(s, QDOT_EINVAL, "a position cannot contain velocities");
        return false;
    }
    return true;
}

/* The quadratic form sum of g_ij s_i s_j, where s are the differentials dq and dt, or the velocities q' and 1. */
static qdot_expr
metric_form(qdot_scene *s, qdot_expr R, bool velocities)
{
    qdot_pool *pool = s->pool;
    qdot_facts facts = qdot_scene_facts(s);
    size_t n = s->coordinates.n;
    qdot_expr *slope, *step, sum = QDOT_ZERO;

    if (!check_metric_argument(s, R))
        return QDOT_NIL;
    slope = qdot_calloc(2 * n + 2, sizeof *slope);
    if (!slope)
        return qdot_pool_fail(pool);
    step = slope + n + 1;
    for (size_t i = 0; i <= n; i++) {
        qdot_expr q = i < n ? s->coordinates.at[i] : QDOT_T;

        slope[i] = is_line_element(s, R) ? qdot_symbol_of(pool, QDOT_DIFFERENTIAL, q)
                                    : qdot_diff(pool, R, q);
        step[i] = !velocities ? qdot_symbol_of(pool, QDOT_DIFFERENTIAL, q)
                  : i < n     ? qdot_mech_jet(s, i, 1)
                              : QDOT_ONE;
    }
    if (is_line_element(s, R)) {
        sum = velocities ? qdot_subs(pool, R, n + 1, slope, step) : R;
        qdot_free(slope);
        return sum;
    }
    for (size_t i = 0; i <= n; i++)
        for (size_t j = i; j <= n; j++) {
            qdot_expr g = qdot_mech_dot(pool, slope[i], slope[j]);

            if (g == QDOT_ZERO || g == QDOT_NIL)
                continue;
            g = qdot_simplify(pool, g, &facts);
            g = qdot_mul(pool, g, qdot_mul(pool, step[i], step[j]));
            sum = qdot_add(pool, sum,
                           i == j ? g : qdot_mul(pool, qdot_expr_int(pool, 2), g));
        }
    qdot_free(slope);
    return qdot_common_out(pool, qdot_mech_tidy(s, sum));
}

qdot_expr
qdot_mech_ds2(qdot_scene *s, qdot_expr R)
{
    return metric_form(s, R, false);
}

qdot_expr
qdot_mech_speed2(qdot_scene *s, qdot_expr R)
{
    return metric_form(s, R, true);
}

qdot_expr
qdot_mech_metric_coordinates(qdot_scene *s, qdot_expr R)
{
    qdot_pool *pool = s->pool;
    size_t n = s->coordinates.n, m = 0;
    qdot_expr *members, list;

    if (!check_metric_argument(s, R))
        return QDOT_NIL;
    members = qdot_calloc(n + 1, sizeof *members);
    if (!members)
        return qdot_pool_fail(pool);
    if (is_line_element(s, R) && qdot_expr_contains(pool, R, qdot_symbol_of(pool, QDOT_DIFFERENTIAL, QDOT_T)))
        members[m++] = QDOT_T;
    for (size_t i = 0; i < n; i++) {
        qdot_expr q = s->coordinates.at[i];
        qdot_expr mark =
            is_line_element(s, R) ? qdot_symbol_of(pool, QDOT_DIFFERENTIAL, q) : q;

        if (qdot_expr_contains(pool, R, mark))
            members[m++] = q;
    }
    list = qdot_list(pool, (uint32_t)m, members);
    qdot_free(members);
    return list;
}

/* Find g_ij of a line element as half its second derivatives; check that it has no other terms. */
static qdot_expr
metric_coefficients(qdot_scene *s, qdot_expr R, qdot_expr over, qdot_expr *g, uint32_t n)
{
    qdot_pool *pool = s->pool;
    qdot_facts facts = qdot_scene_facts(s);
    qdot_expr left = R;

    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = i; j < n; j++) {
            qdot_expr di =
                qdot_symbol_of(pool, QDOT_DIFFERENTIAL, qdot_expr_arg(pool, over, i));
            qdot_expr dj =
                qdot_symbol_of(pool, QDOT_DIFFERENTIAL, qdot_expr_arg(pool, over, j));
            qdot_expr e = qdot_diff(pool, qdot_diff(pool, R, di), dj);

            e = qdot_simplify(pool, qdot_mul(pool, QDOT_HALF, e), &facts);
            if (qdot_mech_holds(s, e) & QDOT_HAS_DIFFERENTIAL)
                return qdot_mech_fail(s, QDOT_ETYPE,
                                      "a line element is a quadratic form in the dq");
            g[i * n + j] = g[j * n + i] = e;
            left = qdot_sub(pool, left,
                            qdot_mul(pool, qdot_expr_int(pool, i == j ? 1 : 2),
                                     qdot_mul(pool, e, qdot_mul(pool, di, dj))));
        }
    if (left == QDOT_NIL)
        return QDOT_NIL;
    if (left != QDOT_ZERO && !qdot_is_zero(pool, left, &facts))
        return qdot_mech_fail(s, QDOT_ETYPE,
                              "a line element is a quadratic form in the dq");
    return QDOT_ONE;
}

qdot_expr
qdot_mech_metric(qdot_scene *s, qdot_expr R)
{
    qdot_pool *pool = s->pool;
    qdot_facts facts = qdot_scene_facts(s);
    qdot_expr over = qdot_mech_metric_coordinates(s, R), *g, result = QDOT_ONE;
    uint32_t n;

    if (over == QDOT_NIL)
        return QDOT_NIL;
    n = qdot_expr_count(pool, over);
    if (n == 0)
        return qdot_mech_fail(s, QDOT_EINVAL,
                              "it contains no coordinate, so it has no metric");
    g = qdot_calloc((size_t)n * n, sizeof *g);
    if (!g)
        return qdot_pool_fail(pool);
    if (is_line_element(s, R))
        result = metric_coefficients(s, R, over, g, n);
    else
        for (uint32_t i = 0; i < n; i++)
            for (uint32_t j = i; j < n; j++) {
                qdot_expr e =
                    qdot_mech_dot(pool, qdot_diff(pool, R, qdot_expr_arg(pool, over, i)),
                                  qdot_diff(pool, R, qdot_expr_arg(pool, over, j)));

                if (e != QDOT_NIL)
                    e = qdot_simplify(pool, e, &facts);
                g[i * n + j] = g[j * n + i] = e;
            }
    if (result != QDOT_NIL)
        result = qdot_matrix(pool, n, n, g);
    qdot_free(g);
    return result;
}
