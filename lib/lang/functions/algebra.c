/* algebra.c -- functions that differentiate, take the sides of equations, substitute and factor. */
#include "lang/functions/algebra.h"

#include <inttypes.h>

#include "base/memory.h"
#include "base/text.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/print-name.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/value-kind.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/functions/builtin.h"
#include "lang/session/bind.h"
#include "lang/session/evaluation.h"
#include "lang/session/momenta.h"
#include "lang/session/speeds.h"
#include "mech/geometry/forms.h"
#include "mech/scene/things.h"
#include "normal/simplify/circle.h"
#include "normal/simplify/kinks.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/solve.h"

enum { READ_SIZE = 300 }; /* largest number of operations in an expression that a human reader can take in */

qdot_status
qdot_algebra_give_short(qdot_session *s, qdot_expr result, qdot_expr *value)
{
    qdot_facts facts = qdot_scene_facts(s->scene);

    if (result != QDOT_NIL && qdot_expr_size(s->pool, result) <= READ_SIZE)
        result = qdot_simplify(s->pool, result, &facts);
    return qdot_value_kind_give(s->pool, result, value);
}

/* --- derivatives: diff, ddt ---------------------------------------------------------- */

/* Whether e depends on time only through coordinates: it contains no explicit t, nor anything else that moves. */
static bool
depends_on_time_by_coordinates(const qdot_pool *pool, qdot_expr e)
{
    uint32_t holds = qdot_expr_node(pool, e)->holds;

    if (qdot_expr_kind(pool, e) == QDOT_SYM)
        return holds & (QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION);
    return (holds & QDOT_HAS_COORD) &&
           !(holds & (QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_MOMENTUM |
                      QDOT_HAS_TIME));
}

/* Give a notice for diff(e, t) = 0 where e contains t only through coordinates: ddt was probably meant. */
static qdot_status
give_notice_of_partial_derivative(qdot_session *session, qdot_expr e)
{
    enum { LONGEST = 60 };
    qdot_text text = {0};
    qdot_status status;

    if (!depends_on_time_by_coordinates(session->pool, e))
        return QDOT_OK;
    status = qdot_print(session->pool, e, QDOT_PLAIN, &text);
    if (status == QDOT_OK)
        status = qdot_text_status(&text);
    if (status == QDOT_OK) {
        const char *shown = text.n <= LONGEST ? qdot_text_str(&text) : "...";

        status = qdot_answer_notice_once(
            session,
            "diff(%s, t) is partial, coordinates held, and so 0; along a motion: ddt(%s)",
            shown, shown);
    }
    qdot_text_clear(&text);
    return status;
}

qdot_status
qdot_call_diff(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    qdot_expr e = args[0];
    int64_t times = 1;

    if (qdot_expr_kind(s->pool, args[1]) != QDOT_SYM || args[1] == QDOT_PI ||
        args[1] == QDOT_TRUE || args[1] == QDOT_FALSE) {
        qdot_fail(QDOT_ETYPE,
                  "diff(e, x) takes a symbol for x: a parameter, a coordinate, "
                  "a velocity or t");
        if (qdot_expr_kind(s->pool, args[1]) == QDOT_UFUN)
            return qdot_hint("as in diff(x(s), s)");
        if (qdot_expr_kind(s->pool, args[1]) == QDOT_NUM && s->evaluation->loops > 0)
            return qdot_hint("an index has its value: subs(diff(e, l), l = k) for k = [1, 2]");
        return QDOT_ETYPE;
    }
    if (qdot_session_speeds_meet(s, 2, (qdot_expr[]){e, args[1]}))
        return qdot_fail(QDOT_EINVAL, "diff(e, x) takes speeds and velocities apart: e is written in one, x is of the other");
    if (n == 3)
        QDOT_TRY(qdot_session_integer(s, args[2], &times));
    if (times < 0)
        return qdot_fail(QDOT_EDOMAIN, "a derivative is taken 0, 1, 2 ... times, not %" PRId64,
                         times);
    if (args[1] == QDOT_T && times > 0)
        QDOT_TRY(give_notice_of_partial_derivative(s, e));
    e = qdot_momenta_for(s, e, args[1]);
    if (times > 0)
        e = qdot_kinks_cancel(s->pool, e);
    for (; times > 0 && e != QDOT_NIL && e != QDOT_ZERO; times--)
        e = qdot_diff(s->pool, e, args[1]);
    return e == args[0] ? qdot_value_kind_give(s->pool, e, value)
                        : qdot_algebra_give_short(s, e, value);
}

/* The matrix of dF_i/dx_j, F and x vectors or lists. */
qdot_status
qdot_call_jacobian(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    uint32_t rows = qdot_expr_count(s->pool, args[0]), columns = qdot_expr_count(s->pool, args[1]);
    qdot_status status = QDOT_OK;
    qdot_expr *entries;

    for (uint32_t i = 0; i < n; i++)
        if (qdot_expr_kind(s->pool, args[i]) != QDOT_VEC && qdot_expr_kind(s->pool, args[i]) != QDOT_LIST) {
            qdot_fail(QDOT_ETYPE, "jacobian(F, (x, y)) takes two vectors or lists, not %s",
                      qdot_value_kind_words(s->pool, args[i]));
            return qdot_hint("the derivative of one number is diff(e, x)");
        }
    if (rows == 0 || columns == 0)
        return qdot_fail(QDOT_EINVAL, "a list in jacobian(F, [x, y]) is empty");
    entries = qdot_malloc((size_t)rows * columns * sizeof *entries);
    if (entries == NULL)
        return QDOT_ENOMEM;
    for (uint32_t k = 0; k < rows * columns && status == QDOT_OK; k++) {
        const qdot_expr pair[] = {qdot_expr_arg(s->pool, args[0], k / columns),
                                  qdot_expr_arg(s->pool, args[1], k % columns)};

        status = qdot_call_diff(s, 2, pair, &entries[k]);
    }
    if (status == QDOT_OK)
        status = qdot_value_kind_give(s->pool, qdot_matrix(s->pool, rows, columns, entries), value);
    qdot_free(entries);
    return status;
}

qdot_status
qdot_call_ddt(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    (void)n;
    return qdot_algebra_give_short(
        s, qdot_ddt(s->pool, qdot_momenta_to_velocities(s, args[0])), value);
}

/* --- sides of equations; rewriting --------------------------------------------------- */

typedef enum { LEFT, RIGHT, DIFFERENCE } side;

static qdot_expr
get_equation_side(qdot_pool *pool, qdot_expr equation, side which)
{
    qdot_expr left = qdot_expr_arg(pool, equation, 0);
    qdot_expr right = qdot_expr_arg(pool, equation, 1);

    return which == LEFT ? left : which == RIGHT ? right : qdot_sub(pool, left, right);
}

/* Find one side of an equation, or of each equation in a list or vector. */
static qdot_status
find_equation_sides(qdot_session *s, const char *name, qdot_expr e, side which, qdot_expr *value)
{
    qdot_pool *pool = s->pool;
    qdot_kind kind = qdot_expr_kind(pool, e);
    uint32_t n = qdot_expr_count(pool, e);
    qdot_expr *members, odd = e;
    bool sound = kind == QDOT_LIST || kind == QDOT_VEC;

    if (qdot_value_kind_is_equation(pool, e))
        return qdot_value_kind_give(s->pool, get_equation_side(pool, e, which), value);
    for (uint32_t i = 0; sound && i < n; i++)
        if (!qdot_value_kind_is_equation(pool, qdot_expr_arg(pool, e, i))) {
            odd = qdot_expr_arg(pool, e, i);
            sound = false;
        }
    if (!sound)
        return qdot_fail(QDOT_ETYPE, "%s takes an equation, not %s", name,
                         qdot_value_kind_words(pool, odd));
    members = qdot_malloc(n * sizeof *members);
    if (members == NULL)
        return QDOT_ENOMEM;
    for (uint32_t i = 0; i < n; i++)
        members[i] = get_equation_side(pool, qdot_expr_arg(pool, e, i), which);
    e = kind == QDOT_LIST ? qdot_list(pool, n, members) : qdot_vector(pool, n, members);
    qdot_free(members);
    return qdot_value_kind_give(s->pool, e, value);
}

#define SIDE(word, which)                                                                \
    qdot_status qdot_call_##word(qdot_session *s, uint32_t n, const qdot_expr *args,  \
                                    qdot_expr *value)                                    \
    {                                                                                    \
        (void)n;                                                                         \
        return find_equation_sides(s, #word, args[0], which, value);                                   \
    }
SIDE(lhs, LEFT)
SIDE(rhs, RIGHT)
SIDE(residual, DIFFERENCE)
#undef SIDE

qdot_status
qdot_call_expand(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    const qdot_status status = qdot_value_kind_give(s->pool, qdot_expand(s->pool, args[0]), value);

    (void)n;
    return status != QDOT_ELIMIT ? status : qdot_hint("left as a product it has values and derivatives; series(e, x = 0, 3) gives its terms up to x^3");
}

qdot_status
qdot_call_collect(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    (void)n;
    if (!qdot_expr_is_scalar(s->pool, args[1]) ||
        qdot_expr_kind(s->pool, args[1]) == QDOT_NUM)
        return qdot_fail(QDOT_ETYPE,
                         "collect(e, x) takes a symbol or an expression for x");
    return qdot_value_kind_give(s->pool, qdot_collect(s->pool, args[0], args[1]), value);
}

qdot_status
qdot_call_simplify(qdot_session *s, uint32_t n, const qdot_expr *args,
                      qdot_expr *value)
{
    qdot_facts facts = qdot_scene_facts(s->scene);

    (void)n;
    return qdot_value_kind_give(s->pool, qdot_simplify(s->pool, args[0], &facts), value);
}

/* An expression contains either momenta or velocities and accelerations, never both. */
static const uint32_t of_motion =
    QDOT_HAS_MOMENTUM | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION;

/* --- replacements: subs ------------------------------------------------------------- */

qdot_status
qdot_algebra_gather(qdot_session *s, const char *name, qdot_expr e, qdot_replacements *r)
{
    qdot_kind kind = qdot_expr_kind(s->pool, e);
    bool many = kind == QDOT_LIST || kind == QDOT_VEC;
    uint32_t n = many ? qdot_expr_count(s->pool, e) : 1;

    for (uint32_t i = 0; i < n; i++) {
        qdot_expr one = many ? qdot_expr_arg(s->pool, e, i) : e, left;

        if (!qdot_value_kind_is_equation(s->pool, one)) {
            qdot_fail(QDOT_ETYPE, "%s takes equations, not %s", name,
                      qdot_value_kind_words(s->pool, one));
            return qdot_hint("as in %s", qdot_builtin_find(name)->usage);
        }
        left = qdot_expr_arg(s->pool, one, 0);
        if (qdot_expr_kind(s->pool, left) == QDOT_NUM)
            return qdot_fail(QDOT_ETYPE, "%s cannot replace a number", name);
        QDOT_TRY(qdot_vec_push(&r->from, left));
        QDOT_TRY(qdot_vec_push(&r->to, qdot_expr_arg(s->pool, one, 1)));
    }
    return QDOT_OK;
}

void
qdot_algebra_drop(qdot_replacements *r)
{
    qdot_free(r->from.at);
    qdot_free(r->to.at);
}

qdot_status
qdot_call_subs(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    qdot_replacements r = {0};
    qdot_status status = QDOT_OK;
    qdot_expr e = args[0];

    for (uint32_t i = 1; i < n && status == QDOT_OK; i++)
        status = qdot_algebra_gather(s, "subs", args[i], &r);
    for (size_t i = 0; i < r.from.n; i++)
        if (qdot_expr_node(s->pool, r.from.at[i])->holds & of_motion)
            e = qdot_momenta_for(s, e, r.from.at[i]);
    if (status == QDOT_OK)
        status = qdot_value_kind_give(
            s->pool, qdot_circle_join(s->pool, qdot_forms_subs(s->scene, e, r.from.n, r.from.at, r.to.at)), value);
    qdot_algebra_drop(&r);
    return status;
}

/* --- factorisation ---------------------------------------------- */

qdot_status
qdot_call_factor(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    (void)n;
    return qdot_value_kind_give(s->pool, qdot_solve_product(s->pool, args[0]), value);
}
