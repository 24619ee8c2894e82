/* sides.c -- finds the functions, such as |u| and max(a, b) with u = a - b, that switch where u = 0; puts in their
 * values for u > 0 and u < 0. */
#include "normal/solve/sides.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/list.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "normal/simplify/simplify.h"

qdot_expr
qdot_sides_choice(qdot_pool *pool, qdot_expr e, qdot_expr x)
{
    static const qdot_fun_id choices[] = {QDOT_ABS, QDOT_SIGN, QDOT_MAX, QDOT_MIN, QDOT_IF};

    return qdot_expr_find_function(pool, e, sizeof choices / sizeof *choices, choices, x);
}

/* --- switching functions --------------------------------------------------------------------------- */

/* A function that switches at left = right (|u|, sign, max, min, if): its values on either side and in between. */
typedef struct {
    qdot_expr left, right;
    qdot_expr above, below, equal; /* value for left > right, <, =; nil: not a function of one difference */
} chooser;

static chooser
read_switch(qdot_pool *pool, qdot_expr e)
{
    const chooser none = {QDOT_NIL, QDOT_NIL, QDOT_NIL, QDOT_NIL, QDOT_NIL};
    qdot_expr a, b, c;

    if (qdot_expr_kind(pool, e) != QDOT_FUN)
        return none;
    a = qdot_expr_arg(pool, e, 0);
    switch (qdot_expr_node(pool, e)->op) {
    case QDOT_ABS: return (chooser){a, QDOT_ZERO, a, qdot_neg(pool, a), QDOT_ZERO};
    case QDOT_SIGN: return (chooser){a, QDOT_ZERO, QDOT_ONE, QDOT_MINUS_ONE, QDOT_ZERO};
    case QDOT_MAX:
    case QDOT_MIN:
        if (qdot_expr_count(pool, e) != 2)
            return none;
        b = qdot_expr_arg(pool, e, 1);
        return qdot_expr_node(pool, e)->op == QDOT_MAX ? (chooser){a, b, a, b, a} : (chooser){b, a, a, b, a};
    case QDOT_IF:
        b = qdot_expr_arg(pool, e, 1);
        c = qdot_expr_arg(pool, e, 2);
        if (qdot_expr_kind(pool, a) != QDOT_REL || qdot_expr_node(pool, a)->op == QDOT_EQ)
            return none;
        return (chooser){qdot_expr_arg(pool, a, 1), qdot_expr_arg(pool, a, 0), b, c,
                         qdot_expr_node(pool, a)->op == QDOT_LT ? c : b};
    default: return none;
    }
}

/* The sign of c in v = c u, if it is proved from the form of v/u: 1 or -1; else 0. */
static int
sign_of_ratio(qdot_pool *pool, qdot_expr v, qdot_expr u)
{
    const uint8_t sign = qdot_ratio_sign(pool, v, u);

    return (sign & QDOT_POS) == QDOT_POS ? 1 : (sign & QDOT_NEG) == QDOT_NEG ? -1 : 0;
}

/* --- replacing them on either side ------------------------------------------------------------------ */

/* Collect in s->choice the functions of e that switch where u changes sign; with[2]: which sides agree with u = 0. */
static qdot_status
collect_switches(qdot_sides *s, qdot_expr e, qdot_expr u, bool *with)
{
    qdot_pool *pool = s->pool;
    qdot_vec(chooser) found = {0};
    qdot_status status;
    qdot_walk w;

    with[0] = with[1] = true;
    QDOT_TRY(qdot_walk_begin(pool, e, &w));
    status = qdot_pool_check(pool);
    for (size_t i = 0; i < w.n && status == QDOT_OK; i++) {
        chooser one = read_switch(pool, w.at[i]);
        int sign = one.above == QDOT_NIL ? 0 : sign_of_ratio(pool, qdot_sub(pool, one.left, one.right), u);

        status = qdot_pool_check(pool);
        if (status != QDOT_OK || sign == 0)
            continue;
        if (sign < 0) {
            qdot_expr above = one.above;

            one.above = one.below;
            one.below = above;
        }
        if (qdot_expr_is_function(pool, w.at[i], QDOT_SIGN))
            with[0] = with[1] = false;
        else if (qdot_expr_is_function(pool, w.at[i], QDOT_IF)) {
            with[0] = with[0] && one.equal == one.above;
            with[1] = with[1] && one.equal == one.below;
        }
        status = qdot_vec_push(&s->choice, w.at[i]);
        if (status == QDOT_OK)
            status = qdot_vec_push(&found, one);
    }
    qdot_walk_end(&w);
    for (int side = 0; side < 3; side++)
        for (size_t i = 0; i < found.n && status == QDOT_OK; i++)
            status = qdot_vec_push(&s->value, side == 0   ? found.at[i].above
                                              : side == 1 ? found.at[i].below
                                                          : found.at[i].equal);
    qdot_free(found.at);
    return status;
}

/* Add the two sides of a switch: left > right and left < right. */
static qdot_status
add_two_sides(qdot_sides *s, qdot_expr e, const chooser *by)
{
    qdot_pool *pool = s->pool;
    qdot_expr u = qdot_sub(pool, by->left, by->right), relation;
    bool with[2];
    qdot_status status = qdot_pool_check(pool);

    QDOT_TRY(status);
    QDOT_TRY(collect_switches(s, e, u, with));
    s->n = 2;
    (void)qdot_sides_put(s, 2, e);
    status = qdot_pool_check(pool);
    if (status == QDOT_EDOMAIN) /* e has no value at u = 0, because a divisor is 0 there */
        with[0] = with[1] = false;
    else if (status == QDOT_OK && !with[0] && !with[1])
        s->jump = u;
    else if (status != QDOT_OK)
        return status;
    relation = qdot_rel(pool, with[0] ? QDOT_LE : QDOT_LT, by->right, by->left);
    s->relations[0] = qdot_list(pool, 1, &relation);
    relation = qdot_rel(pool, with[1] ? QDOT_LE : QDOT_LT, by->left, by->right);
    s->relations[1] = qdot_list(pool, 1, &relation);
    return qdot_pool_check(pool);
}

/* For max or min of several arguments: one side for each argument that may be selected. */
static qdot_status
add_side_for_each_argument(qdot_sides *s, qdot_expr choice)
{
    qdot_pool *pool = s->pool;
    bool largest = qdot_expr_node(pool, choice)->op == QDOT_MAX;
    uint32_t n = qdot_expr_count(pool, choice);

    if (n > QDOT_SIDES_MOST)
        return QDOT_OK;
    QDOT_TRY(qdot_vec_push(&s->choice, choice));
    for (uint32_t i = 0; i < n; i++) {
        qdot_expr it = qdot_expr_arg(pool, choice, i), there = qdot_list(pool, 0, NULL);

        for (uint32_t k = 0; k < n; k++) {
            qdot_expr other = qdot_expr_arg(pool, choice, k),
                      relation = largest ? qdot_rel(pool, QDOT_LE, other, it) : qdot_rel(pool, QDOT_LE, it, other);

            if (k != i)
                there = qdot_list_appended(pool, there, 1, &relation);
        }
        s->relations[i] = there;
        QDOT_TRY(qdot_vec_push(&s->value, it));
    }
    s->n = n;
    return qdot_pool_check(pool);
}

qdot_status
qdot_sides_of(qdot_pool *pool, qdot_expr e, qdot_expr choice, qdot_sides *out)
{
    const chooser by = read_switch(pool, choice);

    *out = (qdot_sides){.pool = pool, .jump = QDOT_NIL};
    if (by.above != QDOT_NIL)
        return add_two_sides(out, e, &by);
    return qdot_expr_is_function(pool, choice, QDOT_IF) ? qdot_pool_check(pool) : add_side_for_each_argument(out, choice);
}

qdot_expr
qdot_sides_put(const qdot_sides *s, size_t side, qdot_expr e)
{
    return qdot_subs(s->pool, e, s->choice.n, s->choice.at, s->value.at + side * s->choice.n);
}

void
qdot_sides_clear(qdot_sides *s)
{
    qdot_free(s->choice.at);
    qdot_free(s->value.at);
    *s = (qdot_sides){0};
}
