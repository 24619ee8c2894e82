/* boxes.c -- excludes all values of the symbols in a set of conditions, box by box. */
#include "normal/inequality/boxes.h"

#include <math.h>

#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "normal/refute/ball.h"
#include "normal/refute/enclosure.h"

/* Largest number of symbols, of conditions, of boxes looked at, and of halvings of one box. */
enum { MOST_SYMBOLS = 2, MOST_CONDITIONS = 12, MOST_PARTS = 300, DEEPEST = 24 };

typedef struct {
    size_t n, m;                   /* numbers of symbols and of conditions */
    qdot_expr symbol[MOST_SYMBOLS];
    qdot_expr gap[MOST_CONDITIONS]; /* right - left of a condition a < b or a <= b */
    bool strict[MOST_CONDITIONS];
} search;

typedef struct {
    qdot_interval side[MOST_SYMBOLS];
    int depth;
} box;

typedef enum { NO_POINT, EVERY_POINT, UNKNOWN } verdict;

/* Read the conditions a < b and a <= b. Others are left out, so that fewer points are excluded. */
static void
read_conditions(qdot_pool *pool, const qdot_facts *facts, search *s)
{
    for (size_t i = 0; i < facts->n_conditions && s->m < MOST_CONDITIONS; i++) {
        const qdot_expr c = facts->conditions[i];

        if (qdot_expr_kind(pool, c) != QDOT_REL || qdot_expr_node(pool, c)->op == QDOT_EQ)
            continue;
        s->strict[s->m] = qdot_expr_node(pool, c)->op == QDOT_LT;
        s->gap[s->m++] = qdot_sub(pool, qdot_expr_arg(pool, c, 1), qdot_expr_arg(pool, c, 0));
    }
}

/* Read the symbols of the conditions. *few: there is at least one, not too many, and nothing else is unknown. */
static qdot_status
read_symbols(qdot_pool *pool, search *s, bool *few)
{
    const qdot_expr atoms = qdot_expr_atoms(pool, qdot_list(pool, (uint32_t)s->m, s->gap), true);

    QDOT_TRY(qdot_pool_check(pool));
    *few = true;
    for (uint32_t i = 0; i < qdot_expr_count(pool, atoms) && *few; i++) {
        const qdot_expr one = qdot_expr_arg(pool, atoms, i);

        *few = s->n < MOST_SYMBOLS && qdot_expr_kind(pool, one) == QDOT_SYM;
        if (*few)
            s->symbol[s->n++] = one;
    }
    *few = *few && s->n > 0;
    return QDOT_OK;
}

/* Whether the base of a power with a symbol in its exponent may be negative: there it is real at single places, which
 * bounds leave out, as (-2)^2 of b^c. */
static qdot_status
has_isolated_points(qdot_pool *pool, const search *s, bool *yes)
{
    const qdot_expr bases = qdot_expr_bases_of_powers(pool, s->m, s->gap, s->n, s->symbol);

    QDOT_TRY(qdot_pool_check(pool));
    *yes = false;
    for (uint32_t i = 0; i < qdot_expr_count(pool, bases) && !*yes; i++)
        *yes = (qdot_expr_sign(pool, qdot_expr_arg(pool, bases, i)) & QDOT_GE0) == 0;
    return QDOT_OK;
}

/* What interval bounds tell of the conditions in a box: they hold at no point, at every point, or unknown. */
static verdict
judge_box(const search *s, qdot_enclosure *bounds, const box *b)
{
    verdict all = EVERY_POINT;

    qdot_enclosure_eval(bounds, b->side, false);
    for (size_t i = 0; i < s->m; i++) {
        const qdot_enclosure_value *v = qdot_enclosure_get(bounds, i);

        if (v->state == QDOT_ENCLOSURE_NOWHERE || v->y.hi < 0 || (s->strict[i] && v->y.hi <= 0))
            return NO_POINT;
        if (v->state != QDOT_ENCLOSURE_WHOLE || !(v->y.lo > 0))
            all = UNKNOWN;
    }
    return all;
}

/* Where to halve an interval: a bounded one in the middle; another one at 0, or at twice its finite end, at least 1. */
static double
dividing_point(qdot_interval a)
{
    if (isfinite(a.lo) && isfinite(a.hi))
        return a.lo / 2 + a.hi / 2;
    if (isinf(a.lo) && isinf(a.hi))
        return 0;
    return isfinite(a.lo) ? fmax(1, 2 * a.lo) : fmin(-1, 2 * a.hi);
}

/* Halve the box along the side that was halved least. */
static void
halve_box(const search *s, const box *b, box *left, box *right)
{
    const size_t j = (size_t)b->depth % s->n;
    const double at = dividing_point(b->side[j]);

    *left = *right = *b;
    left->side[j].hi = right->side[j].lo = at;
    left->depth = right->depth = b->depth + 1;
}

/* Whether the conditions are proved to fail in all parts of the domain, which is divided into boxes. */
static bool
excludes_all(const search *s, qdot_enclosure *bounds, const box *whole)
{
    box todo[DEEPEST + 2];
    size_t n = 0;

    todo[n++] = *whole;
    for (int parts = 0; n > 0; parts++) {
        const box b = todo[--n];
        const verdict v = judge_box(s, bounds, &b);

        if (v == NO_POINT)
            continue;
        if (v == EVERY_POINT || b.depth == DEEPEST || parts == MOST_PARTS)
            return false;
        halve_box(s, &b, &todo[n], &todo[n + 1]);
        n += 2;
    }
    return true;
}

qdot_status
qdot_boxes_exclude(qdot_pool *pool, const qdot_facts *facts, bool *never)
{
    search s = {0};
    qdot_enclosure *bounds;
    box whole = {0};
    qdot_status status;
    bool few, single;

    *never = false;
    read_conditions(pool, facts, &s);
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(read_symbols(pool, &s, &few));
    if (!few || s.m == 0)
        return QDOT_OK;
    QDOT_TRY(has_isolated_points(pool, &s, &single));
    if (single)
        return QDOT_OK;
    for (size_t j = 0; j < s.n; j++)
        whole.side[j] = qdot_ball_domain(pool, s.symbol[j]);
    QDOT_TRY(qdot_pool_check(pool));
    status = qdot_enclosure_new(pool, s.m, s.gap, s.n, s.symbol, &bounds);
    if (status == QDOT_ETYPE)
        return QDOT_OK;
    QDOT_TRY(status);
    *never = excludes_all(&s, bounds, &whole);
    qdot_enclosure_free(bounds);
    return QDOT_OK;
}
