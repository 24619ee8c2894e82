/* within.c -- simplifies arcsin(sin(x)) and the like by comparing bounds of x with the range of the
 * inverse function. */
#include "normal/prove/within.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"

/* Whether bound <= n pi/2 (or >= if `below`), for a rational bound or a rational multiple of pi. */
static bool
is_bounded_by_quarter_turns(const qdot_pool *pool, qdot_expr bound, int n, bool below)
{
    const fmpq *x = qdot_expr_rational(pool, bound);
    fmpq_t limit, c;
    int order = 0;
    bool known = true;

    if (bound == QDOT_NIL)
        return false;
    fmpq_init(limit);
    fmpq_init(c);
    if (x != NULL) { /* rational bounds 333/106 < pi < 355/113, each on the safe side */
        bool less = (n > 0) != below;

        fmpq_set(c, x);
        fmpq_set_si(limit, n * (less ? 333 : 355), 2 * (less ? 106 : 113));
    } else if (bound == QDOT_PI) {
        fmpq_one(c);
        fmpq_set_si(limit, n, 2);
    } else if (qdot_expr_kind(pool, bound) == QDOT_PROD &&
               qdot_expr_count(pool, bound) == 3 &&
               qdot_expr_arg(pool, bound, 1) == QDOT_PI &&
               qdot_expr_arg(pool, bound, 2) == QDOT_ONE) {
        fmpq_set(c, qdot_expr_rational(pool, qdot_expr_arg(pool, bound, 0)));
        fmpq_set_si(limit, n, 2);
    } else {
        known = false;
    }
    if (known)
        order = fmpq_cmp(c, limit);
    fmpq_clear(limit);
    fmpq_clear(c);
    return known && (below ? order >= 0 : order <= 0);
}

/* Whether x is a symbol declared within [from, to], in units of pi/2 (quarter turns). */
static bool
lies_within(const qdot_pool *pool, qdot_expr x, int64_t from, int64_t to)
{
    const qdot_symbol *s = qdot_expr_symbol(pool, x);

    return s != NULL && is_bounded_by_quarter_turns(pool, s->lo, from, true) &&
           is_bounded_by_quarter_turns(pool, s->hi, to, false);
}

/* The angle phi for which y = p sin(phi), x = p cos(phi), p > 0; nil if y and x do not have this form. */
static qdot_expr
find_polar_angle(qdot_pool *pool, qdot_expr y, qdot_expr x)
{
    qdot_expr atoms = qdot_expr_atoms(pool, y, false);

    for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(pool, atoms); i++) {
        qdot_expr u = qdot_expr_arg(pool, atoms, i), p;
        const qdot_symbol *s = qdot_expr_symbol(pool, u);

        if (!lies_within(pool, u, -2, 2) ||
            (s->lo != QDOT_NIL && !s->lo_open && !is_bounded_by_quarter_turns(pool, s->lo, -1, true)))
            continue;
        p = qdot_div(pool, y, qdot_fun1(pool, QDOT_SIN, u));
        if (p != QDOT_NIL && qdot_expr_node(pool, p)->sign == QDOT_POS &&
            qdot_div(pool, x, qdot_fun1(pool, QDOT_COS, u)) == p)
            return u;
    }
    return QDOT_NIL;
}

static qdot_expr
replace_inverse_function(qdot_pool *pool, qdot_expr e, void *user)
{
    qdot_expr x, u;

    (void)user;
    if (qdot_expr_kind(pool, e) != QDOT_FUN)
        return QDOT_NIL;
    if (qdot_expr_is_function(pool, e, QDOT_ATAN2))
        return find_polar_angle(pool, qdot_expr_arg(pool, e, 0), qdot_expr_arg(pool, e, 1));
    x = qdot_expr_arg(pool, e, 0);
    if (qdot_expr_kind(pool, x) != QDOT_FUN)
        return QDOT_NIL;
    u = qdot_expr_arg(pool, x, 0);
    if ((qdot_expr_is_function(pool, e, QDOT_ACOS) && qdot_expr_is_function(pool, x, QDOT_COS) &&
         lies_within(pool, u, 0, 2)) ||
        (qdot_expr_is_function(pool, e, QDOT_ASIN) && qdot_expr_is_function(pool, x, QDOT_SIN) &&
         lies_within(pool, u, -1, 1)) ||
        (qdot_expr_is_function(pool, e, QDOT_ATAN) && qdot_expr_is_function(pool, x, QDOT_TAN) &&
         lies_within(pool, u, -1, 1)))
        return u;
    return QDOT_NIL;
}

qdot_expr
qdot_within_values(qdot_pool *pool, qdot_expr e)
{
    return qdot_walk_map(pool, e, replace_inverse_function, NULL);
}
