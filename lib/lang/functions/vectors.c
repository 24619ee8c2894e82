/* vectors.c -- functions of vectors and matrices, of positions r(q) and line elements. */
#include "base/memory.h"
#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/value-kind.h"
#include "lang/functions/algebra.h"
#include "lang/functions/builtin.h"
#include "mech/geometry/geometry.h"
#include "mech/geometry/metric.h"
#include "mech/study/hamilton.h"

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
OF_PLACE(geodesic, qdot_geometry)
OF_PLACE(volume_element, qdot_geometry)
OF_PLACE(scale_factors, qdot_geometry)
OF_FIELD(gradient)
OF_FIELD(divergence)
OF_FIELD(curl)
OF_FIELD(laplacian)

typedef struct {
    qdot_session *session;
    qdot_expr f, g; /* the two functions; g nil: the vector whose components are mapped */
} bracket;

static qdot_expr
bracket_with(qdot_pool *pool, qdot_expr scalar, void *user)
{
    bracket *b = user, inner = {b->session, scalar, QDOT_NIL};

    if (b->g == QDOT_NIL)
        return qdot_hamilton_poisson(b->session->scene, b->f, scalar);
    return qdot_value_map(pool, b->g, bracket_with, &inner);
}

/* The matrix of {f_i, g_j}, f and g vectors or lists. */
static qdot_status
bracket_matrix(qdot_session *s, qdot_expr f, qdot_expr g, qdot_expr *value)
{
    const uint32_t rows = qdot_expr_count(s->pool, f), columns = qdot_expr_count(s->pool, g);
    qdot_expr *entries = qdot_malloc(((size_t)rows * columns + 1) * sizeof *entries);

    if (entries == NULL)
        return QDOT_ENOMEM;
    for (uint32_t k = 0; k < rows * columns; k++)
        entries[k] = qdot_hamilton_poisson(s->scene, qdot_expr_arg(s->pool, f, k / columns),
                                           qdot_expr_arg(s->pool, g, k % columns));
    *value = qdot_matrix(s->pool, rows, columns, entries);
    qdot_free(entries);
    return qdot_value_kind_check(s->pool, *value);
}

static bool
is_row(const qdot_pool *pool, qdot_expr e)
{
    return (qdot_expr_kind(pool, e) == QDOT_VEC || qdot_expr_kind(pool, e) == QDOT_LIST) && qdot_expr_count(pool, e) > 0;
}

/* Compute {f, g}, component by component where f or g is a vector; of two vectors the matrix. */
qdot_status
qdot_call_poisson(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    bracket b = {s, QDOT_NIL, args[1]};

    (void)n;
    if (is_row(s->pool, args[0]) && is_row(s->pool, args[1]))
        return bracket_matrix(s, args[0], args[1], value);
    if (!qdot_expr_is_scalar(s->pool, args[0]) && !qdot_expr_is_scalar(s->pool, args[1]))
        return qdot_fail(QDOT_ETYPE, "poisson(f, g) takes numbers and vectors");
    return qdot_value_kind_give(
        s->pool, qdot_value_map(s->pool, args[0], bracket_with, &b), value);
}
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
