/* delay.c -- delayed coordinates as lookups in the history of the run. */
#include "sim/model/delay.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "num/past.h"
#include "tape/instruction.h"

static qdot_expr
lookup(qdot_pool *pool, qdot_expr x, long long handle)
{
    return qdot_fun(pool, QDOT_LOOKUP, 2, (qdot_expr[]){x, qdot_expr_int(pool, (int64_t)handle)});
}

qdot_expr
qdot_delay_value(qdot_pool *pool, qdot_expr u, bool velocity)
{
    const qdot_expr x = velocity ? qdot_symbol_jet(pool, u, 1) : u, piece = lookup(pool, u, qdot_past_piece(x));
    const qdot_expr begin = lookup(pool, piece, qdot_past_knot(x)), rate = lookup(pool, piece, qdot_past_rate(x));
    const qdot_expr w = qdot_mul(pool, qdot_sub(pool, u, begin), rate);
    qdot_expr value = lookup(pool, piece, qdot_past_coefficient(x, QDOT_PAST_ORDER));

    for (int k = QDOT_PAST_ORDER - 1; k >= 0; k--)
        value = qdot_add(pool, lookup(pool, piece, qdot_past_coefficient(x, k)), qdot_mul(pool, w, value));
    return value;
}

/* Whether a node is a lookup in a history, and its handle. */
static bool
is_of_history(const qdot_pool *pool, qdot_expr node, int64_t *handle)
{
    return qdot_expr_kind(pool, node) == QDOT_FUN && qdot_expr_node(pool, node)->op == QDOT_LOOKUP &&
           qdot_expr_to_int(pool, qdot_expr_arg(pool, node, 1), handle) && qdot_past_has((double)*handle);
}

/* Of a polynomial in a piece all coefficients but c_0 become 0, and that x(u). */
static qdot_expr
value_as_written(qdot_pool *pool, qdot_expr node, void *user)
{
    qdot_expr piece;
    uint32_t called;
    int64_t handle;

    (void)user;
    if (!is_of_history(pool, node, &handle))
        return QDOT_NIL;
    piece = qdot_expr_arg(pool, node, 0);
    if (!qdot_past_is_value((double)handle, &called) || qdot_expr_kind(pool, piece) != QDOT_FUN)
        return QDOT_ZERO;
    return qdot_delayed(pool, qdot_symbol_jet(pool, called, 0), qdot_expr_arg(pool, piece, 0),
                        qdot_expr_is_coordinate(pool, called) ? 0 : 1);
}

qdot_expr
qdot_delay_written(qdot_pool *pool, qdot_expr e)
{
    return qdot_walk_map(pool, e, value_as_written, NULL);
}

typedef struct {
    size_t n;
    const qdot_expr *from, *to;
} names;

static qdot_expr
rename_history(qdot_pool *pool, qdot_expr node, void *user)
{
    const names *of = user;
    uint32_t called;
    int64_t handle;

    if (!is_of_history(pool, node, &handle))
        return QDOT_NIL;
    (void)qdot_past_is_value((double)handle, &called);
    for (size_t i = 0; i < of->n; i++)
        if (of->from[i] == called)
            return lookup(pool, qdot_walk_map(pool, qdot_expr_arg(pool, node, 0), rename_history, user),
                          qdot_past_rename((double)handle, of->to[i]));
    return QDOT_NIL;
}

qdot_expr
qdot_delay_rename(qdot_pool *pool, qdot_expr e, size_t n, const qdot_expr *from, const qdot_expr *to)
{
    names of = {n, from, to};

    return qdot_walk_map(pool, e, rename_history, &of);
}

/* Of a lookup in a history, its value in the piece before the start, where positions are those of the start and velocities 0. */
static qdot_expr
value_before_start(qdot_pool *pool, qdot_expr node, void *user)
{
    uint32_t called;
    int64_t handle;

    (void)user;
    if (!is_of_history(pool, node, &handle))
        return QDOT_NIL;
    return qdot_past_is_value((double)handle, &called) && qdot_expr_is_coordinate(pool, called) ? called : QDOT_ZERO;
}

qdot_expr
qdot_delay_at_start(qdot_pool *pool, qdot_expr e)
{
    return qdot_walk_map(pool, e, value_before_start, NULL);
}

static qdot_expr
replace_time_but_in_delays(qdot_pool *pool, qdot_expr node, void *user)
{
    const qdot_expr *time = user;

    if (node == QDOT_T)
        return *time;
    return qdot_expr_kind(pool, node) == QDOT_UFUN && qdot_ufun_delayed(pool, qdot_expr_node(pool, node)->op) != QDOT_NIL ? node
                                                                                                            : QDOT_NIL;
}

qdot_expr
qdot_delay_replace_time(qdot_pool *pool, qdot_expr e, qdot_expr time)
{
    const qdot_expr t = QDOT_T;

    if (e == QDOT_NIL)
        return QDOT_NIL;
    return qdot_has_delayed(pool, e) ? qdot_walk_map(pool, e, replace_time_but_in_delays, &time) : qdot_subs(pool, e, 1, &t, &time);
}

qdot_status
qdot_delay_find_knots(const qdot_tape *tape, size_t time, qdot_knots *knots)
{
    qdot_knots all = {0};
    qdot_status status = qdot_knots_find(tape, time, &all);

    for (size_t k = 0; k < all.n && status == QDOT_OK; k++) {
        if (!qdot_past_has(all.at[k].handle))
            continue;
        if (all.at[k].b != 1)
            status = qdot_fail(QDOT_ENOTBUILT, "not built yet: delays that change in a run");
        else if (!(all.at[k].a < 0))
            status = qdot_fail(QDOT_EINVAL, "a delay must be positive: x(t - tau), tau > 0");
        else
            status = qdot_vec_push(knots, all.at[k]);
    }
    qdot_free(all.at);
    return status;
}

bool
qdot_delay_reads(const qdot_tape *tape)
{
    for (size_t k = 0; tape != NULL && k < tape->constants; k++)
        if (qdot_past_has(tape->constant[k]))
            return true;
    return false;
}
