/* builtin.c -- the table of the language's functions, used for calls and for help. */
#include "lang/functions/builtin.h"

#include <stdint.h>
#include <string.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/tensor.h"
#include "expr/value-kind.h"
#include "expr/walk.h"
#include "lang/answer/expression.h"
#include "lang/functions/equilibria.h"
#include "lang/session/along.h"
#include "lang/session/member.h"
#include "lang/session/range.h"
#include "mech/geometry/metric.h"

/* --- calls of elementary functions -------------------------------------------------- */

static qdot_expr
apply_to_scalar(qdot_pool *pool, qdot_expr scalar, void *user)
{
    return qdot_fun1(pool, *(const qdot_fun_id *)user, scalar);
}

/* Of one argument on every scalar inside it; of more, of numbers. min and max of one list
 * or vector are those of its members, of one number that moves those of its run, or
 * of the latest. */
static qdot_status
apply_elementary(qdot_session *s, qdot_fun_id id, uint32_t n, const qdot_expr *args,
                 qdot_expr *value)
{
    qdot_kind kind = qdot_expr_kind(s->pool, args[0]);
    qdot_expr *members;
    uint32_t count;

    if (n == 1 && id != QDOT_MIN && id != QDOT_MAX)
        return qdot_value_kind_give(
            s->pool, qdot_value_map(s->pool, args[0], apply_to_scalar, &id), value);
    if (n == 1 && qdot_expr_is_scalar(s->pool, args[0]) &&
        ((qdot_expr_node(s->pool, args[0])->holds &
          (QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER)) ||
         qdot_member_any(s, args[0])))
        return qdot_range_value(s, NULL, qdot_fun_name(id), 1, args, NULL, value);
    if (n > 1 || (kind != QDOT_LIST && kind != QDOT_VEC) ||
        qdot_expr_count(s->pool, args[0]) == 0) {
        for (uint32_t i = 0; i < n; i++)
            if (!qdot_expr_is_scalar(s->pool, args[i]))
                return qdot_fail(QDOT_ETYPE, "%s takes numbers, not %s",
                                 qdot_fun_name(id),
                                 qdot_value_kind_words(s->pool, args[i]));
        return qdot_value_kind_give(s->pool, qdot_fun(s->pool, id, n, args), value);
    }
    count = qdot_expr_count(s->pool, args[0]);
    members = qdot_malloc(count * sizeof *members);
    if (members == NULL)
        return QDOT_ENOMEM;
    for (uint32_t i = 0; i < count; i++)
        members[i] = qdot_expr_arg(s->pool, args[0], i);
    qdot_status status = count == 1 ? qdot_value_kind_give(s->pool, members[0], value)
                                    : apply_elementary(s, id, count, members, value);
    qdot_free(members);
    return status;
}

#define X(ID, ...)                                                                       \
    static qdot_status call_##ID(qdot_session *s, uint32_t n, const qdot_expr *args,     \
                                 qdot_expr *value)                                       \
    {                                                                                    \
        return apply_elementary(s, QDOT_##ID, n, args, value);                                 \
    }
#include "expr/function.def"
#undef X

static qdot_expr
square_root_of_scalar(qdot_pool *pool, qdot_expr scalar, void *user)
{
    (void)user;
    return qdot_sqrt(pool, scalar);
}

static qdot_status
call_sqrt(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    (void)n;
    return qdot_value_kind_give(s->pool, qdot_value_map(s->pool, args[0], square_root_of_scalar, NULL),
                                value);
}

/* --- size and LaTeX text of an expression ------------------------------------------- */

qdot_status
qdot_call_size(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    uint64_t size = qdot_expr_size(s->pool, args[0]);

    (void)n;
    return qdot_value_kind_give(
        s->pool, qdot_expr_int(s->pool, size > INT64_MAX ? INT64_MAX : (int64_t)size), value);
}

/* Find the LaTeX text of an expression; for a list a list of texts. */
qdot_status
qdot_call_latex(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    bool list = qdot_expr_kind(s->pool, args[0]) == QDOT_LIST;
    uint32_t count = list ? qdot_expr_count(s->pool, args[0]) : 1;
    qdot_expr *members = qdot_calloc(count + 1, sizeof *members);
    qdot_status status = members == NULL ? QDOT_ENOMEM : QDOT_OK;

    (void)n;
    for (uint32_t i = 0; i < count && status == QDOT_OK; i++) {
        qdot_text text = {0};

        status = qdot_expression_print(
            s, list ? qdot_expr_arg(s->pool, args[0], i) : args[0], QDOT_LATEX, &text);
        if (status == QDOT_OK)
            members[i] = qdot_symbol_get(s->pool, QDOT_WORDS, qdot_text_str(&text));
        qdot_text_clear(&text);
    }
    if (status == QDOT_OK)
        status = qdot_value_kind_give(
            s->pool, list ? qdot_list(s->pool, count, members) : members[0], value);
    qdot_free(members);
    return status;
}

/* --- stability of an equilibrium ------------------------------------------------------- */

qdot_status
qdot_call_stability(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    (void)n;
    return qdot_equilibria_stability(s, args[0], value);
}

/* --- numbers of a run --------------------------------------------------------------- */

#define OF_RANGE(word)                                                                   \
    qdot_status qdot_call_##word(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)   \
    {                                                                                    \
        return qdot_range_value(s, NULL, #word, n, args, NULL, value);                   \
    }
OF_RANGE(mean)
OF_RANGE(drift)
#undef OF_RANGE

qdot_status
qdot_call_value(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    return qdot_along_value(s, NULL, n, args, value);
}

/* `sum` is evaluated by the parser's own form (lang/language/parse.c); this is never called. */
qdot_status
qdot_call_sum(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    (void)s, (void)n, (void)args, (void)value;
    return qdot_fail(QDOT_EINVAL, "a form of the language is not a function");
}

/* The coordinates by which the entries of a function of the position R, its last argument, are indexed. */
static qdot_expr
coordinates_of_last_argument(qdot_session *s, uint32_t n, const qdot_expr *args)
{
    return qdot_mech_metric_coordinates(s->scene, args[n - 1]);
}

/* --- the table of functions --------------------------------------------------------- */

#define ELEMENTARY(ID, name, least, most, traits, lo, hi, inverse, operation, value, ball, image, usage, \
                   summary, example)                                                              \
    {name,    least,   most,                                                             \
     call_##ID, usage, summary, example, QDOT_##ID == QDOT_IF ? QDOT_BUILTIN_FORM : 0, NULL},

static const qdot_builtin rows[] = {
#define X ELEMENTARY
#define KINKED(...)
#include "expr/function.def"
#undef X
    {"sqrt", 1, 1, call_sqrt, "sqrt(x)", "square root, x >= 0", "sqrt(9/4)", 0, NULL},
#define X(...)
#define KINKED ELEMENTARY
#include "expr/function.def"
#undef X
#define FUNCTION(word, least, most, flags, over, usage, summary, example) \
    {#word, least, most, qdot_call_##word, usage, summary, example, flags, over},
#include "lang/functions/builtin.def"
};

const qdot_builtin *
qdot_builtin_at(size_t i)
{
    return i < sizeof rows / sizeof *rows ? &rows[i] : NULL;
}

const qdot_builtin *
qdot_builtin_find(const char *name)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (rows[i].name[0] == name[0] && strcmp(rows[i].name, name) == 0)
            return &rows[i];
    return NULL;
}
