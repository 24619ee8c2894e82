/* kinks.c -- removes kinks of |u|, max and min that cancel each other. */
#include "normal/simplify/kinks.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/simplify/simplify.h"

/* Expressions with more operations than this are not changed. */
enum { MOST_OPERATIONS = 1000 };

/* The kinks found in an expression. */
typedef struct {
    qdot_vec(qdot_expr) absolute; /* the different |u| that remain */
    size_t decided;               /* number of |u| in which u has one sign everywhere */
    bool failed;
} kinks;

/* --- the sign of u inside other absolute values ------------------------------------------------- */

/* Whether u = c w with a number c, or a parameter c of known sign; *sign: the sign of c. */
static bool
sign_of_multiple(qdot_pool *pool, qdot_expr u, qdot_expr w, int *sign)
{
    const uint8_t known = qdot_ratio_sign(pool, u, w);

    *sign = (known & QDOT_GE0) && (known & QDOT_LE0) ? 0 : (known & QDOT_GE0) ? 1 : -1;
    return known & (QDOT_GE0 | QDOT_LE0);
}

/* 1: u >= 0, -1: u <= 0 everywhere, from its form, or because it is a multiple of w for both signs
 * of w in |w|; 0: unknown. */
static int
sign_everywhere(qdot_pool *pool, qdot_expr u)
{
    static const qdot_fun_id one[] = {QDOT_ABS};
    const uint8_t known = qdot_expr_node(pool, u)->sign;
    const qdot_expr inner = qdot_expr_find_function(pool, u, 1, one, QDOT_NIL);
    qdot_expr w;
    int above, below;

    if (known & (QDOT_GE0 | QDOT_LE0))
        return known & QDOT_GE0 ? 1 : -1;
    if (inner == QDOT_NIL)
        return 0;
    w = qdot_expr_arg(pool, inner, 0);
    if (!sign_of_multiple(pool, qdot_expand(pool, qdot_subs(pool, u, 1, &inner, &w)), w, &above))
        return 0;
    w = qdot_neg(pool, w); /* now the case w < 0, in which |w| is -w */
    if (!sign_of_multiple(pool, qdot_expand(pool, qdot_subs(pool, u, 1, &inner, &w)), w, &below))
        return 0;
    return above >= 0 && below >= 0 ? 1 : above <= 0 && below <= 0 ? -1 : 0;
}

/* --- removing kinks ------------------------------------------------------------------------------- */

static qdot_expr
write_absolute_value(qdot_pool *pool, qdot_expr u, kinks *k)
{
    qdot_expr e;
    int sign;

    u = qdot_expand(pool, u);
    if (u == QDOT_NIL)
        return u;
    sign = sign_everywhere(pool, u);
    k->decided += sign != 0;
    if (sign != 0)
        return sign > 0 ? u : qdot_neg(pool, u);
    e = qdot_fun(pool, QDOT_ABS, 1, &u);
    if (qdot_expr_is_function(pool, e, QDOT_ABS) && qdot_expr_place(k->absolute.n, k->absolute.at, e) == k->absolute.n)
        k->failed |= qdot_vec_push(&k->absolute, e) != QDOT_OK;
    return e;
}

/* A node with replaced children by absolute values. Each is noted before the sum is built, where it may cancel: so this is
 * not left to qdot_rewrite_extreme. */
static qdot_expr
write_by_absolute_values(qdot_pool *pool, qdot_expr e, void *user)
{
    kinks *k = user;
    const bool greatest = qdot_expr_is_function(pool, e, QDOT_MAX);
    qdot_expr a, b, difference;

    if (qdot_expr_is_function(pool, e, QDOT_ABS))
        return write_absolute_value(pool, qdot_expr_arg(pool, e, 0), k);
    if ((!greatest && !qdot_expr_is_function(pool, e, QDOT_MIN)) || qdot_expr_count(pool, e) != 2)
        return e;
    a = qdot_expr_arg(pool, e, 0);
    b = qdot_expr_arg(pool, e, 1);
    difference = write_absolute_value(pool, qdot_sub(pool, a, b), k);
    return qdot_mul(pool, QDOT_HALF,
                    qdot_add(pool, qdot_add(pool, a, b), greatest ? difference : qdot_neg(pool, difference)));
}

/* Count the different nodes of e that are |u|, max or min. */
static qdot_status
count_kinks(const qdot_pool *pool, qdot_expr e, size_t *count)
{
    qdot_walk w;

    *count = 0;
    QDOT_TRY(qdot_walk_begin(pool, e, &w));
    for (size_t i = 0; i < w.n; i++)
        *count += qdot_expr_is_function(pool, w.at[i], QDOT_ABS) || qdot_expr_is_function(pool, w.at[i], QDOT_MAX) ||
                  qdot_expr_is_function(pool, w.at[i], QDOT_MIN);
    qdot_walk_end(&w);
    return QDOT_OK;
}

qdot_expr
qdot_kinks_cancel(qdot_pool *pool, qdot_expr e)
{
    kinks k = {0};
    qdot_expr joined;
    size_t before, after;

    if (e == QDOT_NIL || !(qdot_expr_node(pool, e)->holds & QDOT_HAS_FUN) ||
        qdot_expr_size(pool, e) > MOST_OPERATIONS || count_kinks(pool, e, &before) != QDOT_OK || before < 2)
        return e;
    joined = qdot_expand(pool, qdot_walk_replace(pool, e, QDOT_FUN, write_by_absolute_values, &k));
    if (joined != QDOT_NIL && (k.failed || count_kinks(pool, joined, &after) != QDOT_OK ||
                               after >= k.absolute.n + k.decided))
        joined = e;
    qdot_free(k.absolute.at);
    return joined;
}
