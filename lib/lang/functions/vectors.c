/* vectors.c -- functions of vectors and matrices, of positions r(q) and line elements. */
#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/value-kind.h"
#include "lang/functions/algebra.h"
#include "lang/functions/builtin.h"
#include "mech/geometry/geometry.h"
#include "mech/geometry/metric.h"
#include "mech/hamilton/hamilton.h"

/* --- vectors and matrices ----------------------------------------------------------- */

#define ONE(word, function)                                                              \
    qdot_status qdot_call_##word(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)   \
    {                                                                                    \
        (void)n;                                                                         \
        return qdot_algebra_give_short(s, function(s->pool, args[0]), value);            \
    }
#define TWO(word, function)                                                              \
    qdot_status qdot_call_##word(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)   \
    {                                                                                    \
        (void)n;                                                                         \
        return qdot_algebra_give_short(s, function(s->pool, args[0], args[1]), value);   \
    }
TWO(dot, qdot_dot)
TWO(cross, qdot_cross)
ONE(norm, qdot_norm)
ONE(transpose, qdot_transpose)
ONE(det, qdot_det)
ONE(inverse, qdot_inverse)
ONE(trace, qdot_trace)
#undef ONE
#undef TWO

/* --- geometry of r(q), or of a line element ----------------------------------------- */

static qdot_status
place_check(qdot_session *s, const char *name, qdot_expr R)
{
    if (qdot_expr_is_scalar(s->pool, R) || qdot_expr_kind(s->pool, R) == QDOT_VEC)
        return QDOT_OK;
    return qdot_fail(QDOT_ETYPE, "%s(R) takes a vector r(q), not %s", name,
                     qdot_value_kind_words(s->pool, R));
}

/* Define the handler of a function whose only argument is a position vector R. */
#define OF_PLACE(word, module)                                                           \
    qdot_status qdot_call_##word(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)   \
    {                                                                                    \
        (void)n;                                                                         \
        QDOT_TRY(place_check(s, #word, args[0]));                                        \
        return qdot_value_kind_give(s->pool, module##_##word(s->scene, args[0]), value); \
    }
/* Define the handler of a function of a field and of the position vector R in whose frame it is given. */
#define OF_FIELD(word)                                                                   \
    qdot_status qdot_call_##word(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)   \
    {                                                                                    \
        (void)n;                                                                         \
        QDOT_TRY(place_check(s, #word, args[1]));                                        \
        return qdot_value_kind_give(                                                     \
            s->pool, qdot_geometry_##word(s->scene, args[0], args[1]), value);           \
    }
OF_PLACE(ds2, qdot_mech)
OF_PLACE(speed2, qdot_mech)
OF_PLACE(metric, qdot_mech)
OF_PLACE(christoffel, qdot_geometry)
OF_PLACE(riemann, qdot_geometry)
OF_PLACE(ricci, qdot_geometry)
OF_PLACE(scalar_curvature, qdot_geometry)
OF_PLACE(kretschmann, qdot_geometry)
OF_PLACE(einstein, qdot_geometry)
OF_PLACE(weyl, qdot_geometry)
OF_PLACE(geodesic, qdot_geometry)
OF_PLACE(volume_element, qdot_geometry)
OF_PLACE(scale_factors, qdot_geometry)
OF_FIELD(gradient)
OF_FIELD(divergence)
OF_FIELD(curl)
OF_FIELD(laplacian)

#undef OF_PLACE
#undef OF_FIELD

qdot_status
qdot_call_routhian(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    for (uint32_t i = 0; i < n; i++) {
        if (!qdot_expr_is_coordinate(s->pool, args[i]))
            return qdot_fail(QDOT_ETYPE, "routhian( ) takes coordinates");
        for (uint32_t j = 0; j < i; j++)
            if (args[j] == args[i])
                return qdot_fail(QDOT_EINVAL, "`%.200s` is named twice",
                                 qdot_expr_symbol(s->pool, args[i])->name);
    }
    return qdot_value_kind_give(s->pool, qdot_hamilton_routhian(s->scene, n, args), value);
}
