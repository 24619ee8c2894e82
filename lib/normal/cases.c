/* cases.c -- orders times signs, each a substitution. */
#include "normal/cases.h"

#include "expr/calculus.h"
#include "expr/walk.h"
#include "normal/prove.h"

enum { LEAVES = 4, SIGNS = 3, NODES = 24 };

static bool
is_function(const qdot_pool *pool, qdot_expr e, qdot_fun_id id)
{
    return qdot_expr_kind(pool, e) == QDOT_FUN && qdot_expr_node(pool, e)->op == id;
}

static bool
is_extreme(const qdot_pool *pool, qdot_expr e)
{
    return is_function(pool, e, QDOT_MAX) || is_function(pool, e, QDOT_MIN);
}

static bool
is_signed(const qdot_pool *pool, qdot_expr e)
{
    return is_function(pool, e, QDOT_ABS) || is_function(pool, e, QDOT_SIGN);
}

/* --- inverse functions within their values --------------------------------------------- */

/* Whether bound <= n/2 pi (below: >=), for a rational or a rational times pi. */
static bool
bounded(const qdot_pool *pool, qdot_expr bound, long n, bool below)
{
    const fmpq *x = qdot_expr_rational(pool, bound);
    fmpq_t limit, c;
    int order = 0;
    bool known = true;

    if (bound == QDOT_NIL)
        return false;
    fmpq_init(limit);
    fmpq_init(c);
    if (x != NULL) { /* 355/113 is above pi, 333/106 below: on the safe side */
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

/* Whether x is a symbol declared within [from, to], in units of pi/2. */
static bool
lies_within(const qdot_pool *pool, qdot_expr x, long from, long to)
{
    const qdot_symbol *s = qdot_expr_symbol(pool, x);

    return s != NULL && bounded(pool, s->lo, from, true) &&
           bounded(pool, s->hi, to, false);
}

/* The angle of which y = p sin(x), x = p cos(x), p > 0; nil: none. */
static qdot_expr
angle_of(qdot_pool *pool, qdot_expr y, qdot_expr x)
{
    qdot_expr atoms = qdot_expr_atoms(pool, y, false);

    for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(pool, atoms); i++) {
        qdot_expr u = qdot_expr_arg(pool, atoms, i), p;
        const qdot_symbol *s = qdot_expr_symbol(pool, u);

        if (!lies_within(pool, u, -2, 2) ||
            (s->lo != QDOT_NIL && !s->lo_open && !bounded(pool, s->lo, -1, true)))
            continue;
        p = qdot_div(pool, y, qdot_fun1(pool, QDOT_SIN, u));
        if (p != QDOT_NIL && qdot_expr_node(pool, p)->sign == QDOT_POS &&
            qdot_div(pool, x, qdot_fun1(pool, QDOT_COS, u)) == p)
            return u;
    }
    return QDOT_NIL;
}

static qdot_expr
within_values(qdot_pool *pool, qdot_expr e, void *user)
{
    qdot_expr x, u;

    (void)user;
    if (qdot_expr_kind(pool, e) != QDOT_FUN)
        return QDOT_NIL;
    if (is_function(pool, e, QDOT_ATAN2))
        return angle_of(pool, qdot_expr_arg(pool, e, 0), qdot_expr_arg(pool, e, 1));
    x = qdot_expr_arg(pool, e, 0);
    if (qdot_expr_kind(pool, x) != QDOT_FUN)
        return QDOT_NIL;
    u = qdot_expr_arg(pool, x, 0);
    if ((is_function(pool, e, QDOT_ACOS) && is_function(pool, x, QDOT_COS) &&
         lies_within(pool, u, 0, 2)) ||
        (is_function(pool, e, QDOT_ASIN) && is_function(pool, x, QDOT_SIN) &&
         lies_within(pool, u, -1, 1)) ||
        (is_function(pool, e, QDOT_ATAN) && is_function(pool, x, QDOT_TAN) &&
         lies_within(pool, u, -1, 1)))
        return u;
    return QDOT_NIL;
}

/* --- what there is to tell apart -------------------------------------------------------- */

struct cases {
    qdot_pool *pool;
    qdot_expr side[2];
    qdot_expr leaf[LEAVES], sign[SIGNS]; /* arguments: of max and min, of abs and sign */
    size_t n_leaves, n_signs;
    bool zero[SIGNS]; /* there is a sign(...): its zero is a case */
    qdot_expr node[NODES],
        to[NODES]; /* the functions, inner ones first, and their values */
    size_t n;
    bool too_much;
};

static size_t
place_in(const qdot_expr *list, size_t n, qdot_expr e)
{
    size_t i = 0;

    while (i < n && list[i] != e)
        i++;
    return i;
}

static void
add_leaf(struct cases *c, qdot_expr e)
{
    if (place_in(c->leaf, c->n_leaves, e) < c->n_leaves)
        return;
    if (c->n_leaves == LEAVES)
        c->too_much = true;
    else
        c->leaf[c->n_leaves++] = e;
}

static void
add_node(struct cases *c, qdot_expr e)
{
    const qdot_pool *pool = c->pool;

    if (c->n == NODES) {
        c->too_much = true;
        return;
    }
    c->node[c->n++] = e;
    if (is_extreme(pool, e)) {
        for (uint32_t i = 0; i < qdot_expr_count(pool, e); i++)
            if (!is_extreme(pool, qdot_expr_arg(pool, e, i)))
                add_leaf(c, qdot_expr_arg(pool, e, i));
    } else {
        qdot_expr u = qdot_expr_arg(pool, e, 0);
        size_t k = place_in(c->sign, c->n_signs, u);

        if (k == SIGNS) {
            c->too_much = true;
            return;
        }
        if (k == c->n_signs) {
            c->sign[c->n_signs++] = u;
            c->zero[k] = false;
        }
        c->zero[k] |= is_function(pool, e, QDOT_SIGN);
    }
}

/* Whether a function that is told apart stands inside e. */
static qdot_status
look_inside(struct cases *c, qdot_expr e)
{
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin(c->pool, e, &w));
    for (size_t i = 0; i < w.n; i++)
        c->too_much |= is_extreme(c->pool, w.at[i]) || is_signed(c->pool, w.at[i]);
    qdot_walk_end(&w);
    return QDOT_OK;
}

static qdot_status
gather(struct cases *c)
{
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin_n(c->pool, 2, c->side, &w));
    for (size_t i = 0; i < w.n; i++)
        if (is_extreme(c->pool, w.at[i]) || is_signed(c->pool, w.at[i]))
            add_node(c, w.at[i]);
    qdot_walk_end(&w);
    for (size_t i = 0; i < c->n_leaves && !c->too_much; i++)
        QDOT_TRY(look_inside(c, c->leaf[i]));
    for (size_t i = 0; i < c->n_signs && !c->too_much; i++)
        QDOT_TRY(look_inside(c, c->sign[i]));
    return QDOT_OK;
}

/* --- a case ------------------------------------------------------------------------------ */

/* order[]: the leaves, ascending; sign[]: 1, -1 or 0. */
static void
put_in(struct cases *c, const size_t *order, const int *sign)
{
    qdot_pool *pool = c->pool;
    size_t rank[LEAVES];

    for (size_t i = 0; i < c->n_leaves; i++)
        rank[order[i]] = i;
    for (size_t k = 0; k < c->n; k++) {
        qdot_expr e = c->node[k], u = qdot_expr_arg(pool, e, 0);
        size_t best = SIZE_MAX;
        int s;

        if (!is_extreme(pool, e)) {
            s = sign[place_in(c->sign, c->n_signs, u)];
            c->to[k] = is_function(pool, e, QDOT_SIGN) ? qdot_expr_int(pool, s)
                       : s == 0                        ? QDOT_ZERO
                       : s > 0                         ? u
                                                       : qdot_neg(pool, u);
            continue;
        }
        for (uint32_t i = 0; i < qdot_expr_count(pool, e); i++) {
            qdot_expr x = qdot_expr_arg(pool, e, i);
            size_t inner = place_in(c->node, k, x), at;

            at = place_in(c->leaf, c->n_leaves, inner < k ? c->to[inner] : x);
            if (best == SIZE_MAX ||
                (is_function(pool, e, QDOT_MAX) ? rank[at] > rank[best]
                                                : rank[at] < rank[best]))
                best = at;
        }
        c->to[k] = c->leaf[best];
    }
}

/* Whether all of e counts: a branch that is not taken may be undefined. */
static bool
has_no_branches(const struct cases *c)
{
    bool none = true;
    qdot_walk w;

    if (qdot_walk_begin_n(c->pool, 2, c->side, &w) != QDOT_OK)
        return false;
    for (size_t i = 0; i < w.n; i++)
        none &= !is_function(c->pool, w.at[i], QDOT_IF);
    qdot_walk_end(&w);
    return none;
}

/* At the zero of a sign a side that divides by it has no value, and nothing is claimed there. */
static bool
nothing_is_claimed(const struct cases *c, qdot_status status, const int *sign)
{
    bool at_zero = false;

    for (size_t i = 0; i < c->n_signs; i++)
        at_zero |= sign[i] == 0;
    return status == QDOT_EDOMAIN && at_zero && has_no_branches(c);
}

static qdot_status
prove(struct cases *c, const size_t *order, const int *sign, const qdot_facts *facts,
      bool *equal)
{
    qdot_expr side[2], zero[SIGNS];
    qdot_facts known = facts == NULL ? (qdot_facts){0} : *facts;

    put_in(c, order, sign);
    for (int i = 0; i < 2; i++)
        side[i] = qdot_subs(c->pool, c->side[i], c->n, c->node, c->to);
    known.n_relations = 0;
    known.relations = zero;
    for (size_t i = 0; i < c->n_signs; i++)
        if (sign[i] == 0)
            zero[known.n_relations++] = c->sign[i];
    *equal = false;
    if (qdot_pool_failed(c->pool)) { /* a division by zero */
        qdot_status status = qdot_pool_check(c->pool);

        *equal = nothing_is_claimed(c, status, sign);
        return status == QDOT_ENOMEM || status == QDOT_EINTR ? status : QDOT_OK;
    }
    return qdot_prove_equal(c->pool, side[0], side[1], &known, equal);
}

/* The next order, as a number with its digits counts up; false: that was the last. */
static bool
next_order(size_t *order, size_t n)
{
    size_t i = n, k = n, keep;

    while (i > 1 && order[i - 2] >= order[i - 1])
        i--;
    if (i <= 1)
        return false;
    while (order[k - 1] <= order[i - 2])
        k--;
    keep = order[i - 2];
    order[i - 2] = order[k - 1];
    order[k - 1] = keep;
    for (k = n; i < k; i++, k--) {
        keep = order[i - 1];
        order[i - 1] = order[k - 1];
        order[k - 1] = keep;
    }
    return true;
}

static bool
next_signs(const struct cases *c, int *sign)
{
    for (size_t i = 0; i < c->n_signs; i++) {
        if (sign[i] == 1) {
            sign[i] = -1;
            return true;
        }
        if (sign[i] == -1 && c->zero[i]) {
            sign[i] = 0;
            return true;
        }
        sign[i] = 1;
    }
    return false;
}

qdot_status
qdot_prove_cases(qdot_pool *pool, qdot_expr left, qdot_expr right,
                 const qdot_facts *facts, bool *equal)
{
    struct cases c = {.pool = pool};
    size_t order[LEAVES];
    int sign[SIGNS];

    *equal = false;
    if (facts != NULL && facts->n_relations > 0)
        return QDOT_OK;
    c.side[0] = qdot_walk_map(pool, left, within_values, NULL);
    c.side[1] = qdot_walk_map(pool, right, within_values, NULL);
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(gather(&c));
    if (c.too_much)
        return QDOT_OK;
    if (c.n == 0)
        return c.side[0] == left && c.side[1] == right
                   ? QDOT_OK
                   : qdot_prove_equal(pool, c.side[0], c.side[1], facts, equal);
    for (size_t i = 0; i < c.n_leaves; i++)
        order[i] = i;
    do {
        for (size_t i = 0; i < c.n_signs; i++)
            sign[i] = 1;
        do
            QDOT_TRY(prove(&c, order, sign, facts, equal));
        while (*equal && next_signs(&c, sign));
    } while (*equal && next_order(order, c.n_leaves));
    return QDOT_OK;
}
