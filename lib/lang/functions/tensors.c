/* tensors.c -- covariant and Lie derivatives, commutators of vector fields; vectors in forms. */
#include "base/text.h"
#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/value-kind.h"
#include "lang/functions/builtin.h"
#include "mech/geometry/forms.h"
#include "mech/geometry/metric.h"
#include "mech/geometry/tensors.h"

qdot_status
qdot_call_covariant(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    (void)n;
    return qdot_value_kind_give(s->pool, qdot_tensors_covariant(s->scene, args[0], args[1]), value);
}

/* The coordinates over which the components of fields are meant, a LIST: those of the third argument, a list, a place
 * or a line element; else all that are declared. */
static qdot_status
find_coordinates(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *list)
{
    qdot_pool *pool = s->pool;

    if (n < 3)
        return qdot_value_kind_give(
            pool, qdot_list(pool, (uint32_t)s->scene->coordinates.n, s->scene->coordinates.at), list);
    *list = args[2];
    if (qdot_expr_kind(pool, args[2]) != QDOT_LIST)
        return qdot_value_kind_give(pool, qdot_mech_metric_coordinates(s->scene, args[2]), list);
    for (uint32_t i = 0; i < qdot_expr_count(pool, *list); i++) {
        qdot_expr q = qdot_expr_arg(pool, *list, i);

        if (!qdot_expr_is_coordinate(pool, q) && q != QDOT_T)
            return qdot_fail(QDOT_ETYPE, "a list of coordinates belongs here, as in [r, theta]");
    }
    return QDOT_OK;
}

/* Hint that a third argument names the coordinates, as [r, phi] where the vector has two components. */
static void
hint_at_coordinates(qdot_session *s, const qdot_expr *q, size_t n, size_t components)
{
    qdot_text list = {0};

    for (size_t i = 0; i < n && (i < components || i == 0); i++)
        qdot_text_format(&list, "%s%.60s", i > 0 ? ", " : "", qdot_expr_symbol(s->pool, q[i])->name);
    if (!list.failed)
        (void)qdot_hint("a third argument names the coordinates, as in [%s]", qdot_text_str(&list));
    qdot_text_clear(&list);
}

typedef qdot_expr derivative(qdot_scene *s, qdot_expr a, qdot_expr b, uint32_t n, const qdot_expr *q);

/* Call `take` with the coordinates of the arguments. */
static qdot_status
over_coordinates(qdot_session *s, uint32_t n, const qdot_expr *args, derivative *take, qdot_expr *value)
{
    qdot_vec(qdot_expr) q = {0};
    qdot_status status;
    qdot_expr list;

    QDOT_TRY(find_coordinates(s, n, args, &list));
    status = qdot_expr_count(s->pool, list) == 0 ? qdot_fail(QDOT_EINVAL, "there are no coordinates") : QDOT_OK;
    for (uint32_t i = 0; i < qdot_expr_count(s->pool, list) && status == QDOT_OK; i++)
        status = qdot_vec_push(&q, qdot_expr_arg(s->pool, list, i));
    if (status == QDOT_OK)
        status = qdot_value_kind_give(s->pool, take(s->scene, args[0], args[1], (uint32_t)q.n, q.at), value);
    if (status != QDOT_OK && n == 2 && q.n > 0)
        hint_at_coordinates(s, &q.at[0], q.n, qdot_expr_count(s->pool, args[qdot_expr_kind(s->pool, args[1]) == QDOT_VEC]));
    qdot_free(q.at);
    return status;
}

qdot_status
qdot_call_lie_derivative(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    return over_coordinates(s, n, args, qdot_tensors_lie, value);
}

qdot_status
qdot_call_commutator(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    return over_coordinates(s, n, args, qdot_tensors_commutator, value);
}

qdot_status
qdot_call_interior_product(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    return over_coordinates(s, n, args, qdot_forms_interior, value);
}
