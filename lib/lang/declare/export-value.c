/* export-value.c -- exports an expression: converts it to a tape (list of operations) with its symbols as inputs. */
#include <math.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/declare/export-given.h"
#include "lang/declare/export-scene.h"
#include "lang/session/measured.h"

typedef qdot_vec(qdot_expr) expressions;
typedef qdot_vec(qdot_export_name) names;

/* Append the scalar components of e; for an equation its left side minus its right side. */
static qdot_status
append_scalar_components(qdot_session *s, qdot_expr e, expressions *to)
{
    qdot_pool *pool = s->pool;
    qdot_kind kind = qdot_expr_kind(pool, e);

    if (kind == QDOT_REL && qdot_expr_node(pool, e)->op == QDOT_EQ)
        e = qdot_sub(pool, qdot_expr_arg(pool, e, 0), qdot_expr_arg(pool, e, 1));
    else if (!qdot_expr_is_scalar(pool, e))
        return qdot_fail(QDOT_ETYPE, "numbers, equations, and vectors, matrices, lists of these can be "
                                     "exported");
    e = qdot_export_bound(s, e);
    QDOT_TRY(qdot_pool_check(pool));
    return qdot_vec_push(to, e);
}

/* Find the symbols in the expressions of `list`; those without a value come first. */
static qdot_status
find_arguments(qdot_session *s, const expressions *list, expressions *inputs, names *to)
{
    qdot_expr all = qdot_list(s->pool, (uint32_t)list->n, list->at);
    qdot_expr atoms = all == QDOT_NIL ? QDOT_NIL : qdot_expr_atoms(s->pool, all, false);

    QDOT_TRY(qdot_pool_check(s->pool));
    for (int with_value = 0; with_value < 2; with_value++)
        for (uint32_t i = 0; i < qdot_expr_count(s->pool, atoms); i++) {
            qdot_expr atom = qdot_expr_arg(s->pool, atoms, i);
            double value;

            if (qdot_expr_is_class(s->pool, atom, QDOT_CONST))
                continue;
            QDOT_TRY(qdot_export_value_of(s, atom, &value));
            if (isnan(value) != !with_value)
                continue;
            QDOT_TRY(qdot_vec_push(inputs, atom));
            QDOT_TRY(qdot_vec_push(to, ((qdot_export_name){qdot_expr_symbol(s->pool, atom)->name, value})));
        }
    return QDOT_OK;
}

static qdot_export_block
shape_of_value(const qdot_pool *pool, qdot_expr e)
{
    qdot_kind kind = qdot_expr_kind(pool, e);
    size_t n = qdot_expr_count(pool, e);

    if (kind == QDOT_MAT)
        return (qdot_export_block){"out", n / qdot_expr_node(pool, e)->op,
                                   qdot_expr_node(pool, e)->op};
    if (kind == QDOT_VEC || kind == QDOT_LIST)
        return (qdot_export_block){"out", n, 0};
    return (qdot_export_block){NULL, 0, 0};
}

qdot_status
qdot_export_value(qdot_session *session, const char *name, qdot_expr e, const char *file,
                  const qdot_export_language *language, qdot_text *out)
{
    qdot_pool *pool = session->pool;
    qdot_export_expression x = {.file = file, .origin = name};
    expressions inputs = {0}, outputs = {0};
    names arguments = {0};
    qdot_tape *tape = NULL;
    qdot_status status = QDOT_OK;

    e = qdot_measured_as_rationals(session, e);
    QDOT_TRY(qdot_pool_check(pool));
    x.value.blocks = 1;
    x.value.block[0] = shape_of_value(pool, e);
    if (x.value.block[0].array == NULL)
        status = append_scalar_components(session, e, &outputs);
    for (uint32_t i = 0;
         x.value.block[0].array != NULL && i < qdot_expr_count(pool, e) && status == QDOT_OK; i++)
        status = append_scalar_components(session, qdot_expr_arg(pool, e, i), &outputs);
    if (status == QDOT_OK && outputs.n == 0)
        status = qdot_fail(QDOT_EINVAL, "an empty list: there is nothing to export");
    if (status == QDOT_OK)
        status = find_arguments(session, &outputs, &inputs, &arguments);
    if (status == QDOT_OK)
        status = qdot_tape_new(pool, inputs.n, inputs.at, outputs.n, outputs.at, &tape);
    x.k = inputs.n;
    x.arguments = arguments.at;
    x.value.tape = tape;
    if (status == QDOT_OK)
        status = qdot_export_expression_write(&x, language, out);
    qdot_tape_free(tape);
    qdot_free(inputs.at);
    qdot_free(outputs.at);
    qdot_free(arguments.at);
    return status;
}
