/* action.c -- finds the ranges of a coordinate between turning points, and the loop integral of its momentum there. */
#include "mech/hamilton/action.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/integral.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/inequality/contradiction.h"
#include "normal/inequality/sign.h"
#include "normal/integral/definite.h"
#include "normal/integral/ends.h"
#include "normal/integral/loop.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/solve.h"

enum { MOST_PLACES = 10, MOST_SETS = 3, MOST_SIGNED = 12, LARGEST_MIDDLE = 8 };

typedef enum { TURNING, POLE, WALL, FAR } place_kind; /* f = 0; 1/f = 0; the end of the domain; no end */

typedef struct {
    place_kind kind;
    qdot_expr at, when; /* when: the set of conditions under which it exists; nil: always */
} place;

typedef struct {
    qdot_scene *s;
    qdot_pool *pool;
    qdot_expr x, f, shift;
    qdot_facts facts; /* of the scene, and the regime */
    size_t n;
    place at[MOST_PLACES];
    bool complete; /* these are all zeros and poles */
    qdot_expr lo, hi; /* of the domain; nil: none */
    qdot_action *out;
} search;

/* The sign of e, proved, as it stands or simplified: 1, -1, or 0: not known. */
static int
sign_of(search *a, qdot_expr e)
{
    int sign = 0;

    if (e != QDOT_NIL && qdot_sign(a->pool, e, &a->facts, &sign) == QDOT_OK && sign == 0)
        (void)qdot_grave(qdot_sign(a->pool, qdot_simplify(a->pool, e, &a->facts), &a->facts, &sign));
    return sign;
}

/* --- places ------------------------------------------------------------------------------------ */

/* Add the zeros of g in the domain. */
static qdot_status
add_places_at_zeros(search *a, qdot_expr g, place_kind kind)
{
    qdot_solutions roots = {0};
    qdot_status status;

    if (g == QDOT_NIL || !qdot_expr_contains(a->pool, g, a->x))
        return qdot_grave(qdot_pool_check(a->pool));
    status = qdot_solve_inside(a->pool, g, a->x, QDOT_NIL, &a->facts, &roots);
    a->complete &= status == QDOT_OK && roots.complete && !roots.single && !roots.recurs;
    for (size_t i = 0; i < roots.root.n && a->complete; i++) {
        const qdot_root *root = &roots.root.at[i];

        if (root->condition == QDOT_FALSE)
            continue;
        a->complete = root->period == QDOT_NIL && root->value != a->x && !qdot_expr_contains(a->pool, root->value, a->x) &&
                      a->n < MOST_PLACES;
        if (a->complete)
            a->at[a->n++] = (place){kind, root->value, root->condition};
    }
    qdot_solutions_clear(&roots);
    return qdot_grave(status);
}

static qdot_status
find_places(search *a)
{
    const qdot_symbol *symbol = qdot_expr_symbol(a->pool, a->x);

    a->complete = true;
    a->lo = symbol->lo;
    a->hi = symbol->hi;
    QDOT_TRY(add_places_at_zeros(a, a->f, TURNING));
    return a->complete ? add_places_at_zeros(a, qdot_simplify(a->pool, qdot_div(a->pool, QDOT_ONE, a->f), &a->facts), POLE) : QDOT_OK;
}

/* --- one regime ----------------------------------------------------------------------------------- */

/* Order places [n] by value; false: not proved. */
static bool
sort_places(search *a, size_t n, place *p)
{
    for (size_t i = 1; i < n; i++)
        for (size_t k = i; k > 0; k--) {
            const int sign = sign_of(a, qdot_sub(a->pool, p[k].at, p[k - 1].at));
            const place moved = p[k];

            if (sign == 0)
                return false;
            if (sign > 0)
                break;
            p[k] = p[k - 1];
            p[k - 1] = moved;
        }
    return true;
}

/* The limit of f, or whatever it is, at a place; its slope there. */
static qdot_expr
at_place(search *a, qdot_expr e, const place *p)
{
    const qdot_expr value = qdot_subs(a->pool, e, 1, &a->x, &p->at);

    return value == QDOT_NIL || qdot_pool_failed(a->pool) ? ((void)qdot_grave(qdot_pool_check(a->pool)), QDOT_NIL)
                                                         : qdot_simplify(a->pool, value, &a->facts);
}

/* The first k for which f |x - end|^k has a limit at the end of a range, *there, from the side (1 above, -1 below) inside;
 * HIGHEST: none. So the order of a pole, f of the form c/|x - end|^k near it. */
enum { HIGHEST = 4 };
static int
order_at(search *a, const place *end, int side, qdot_expr *there)
{
    const qdot_expr width = qdot_mul(a->pool, qdot_expr_int(a->pool, side), qdot_sub(a->pool, a->x, end->at));

    for (int k = 0; k < HIGHEST; k++) {
        const qdot_expr e = qdot_simplify(a->pool, qdot_mul(a->pool, a->f, qdot_pow_int(a->pool, width, k)), &a->facts);
        qdot_end limit = {.kind = QDOT_END_UNKNOWN};

        if (e != QDOT_NIL && qdot_end_value(a->pool, e, a->x, end->at, side, &a->facts, &limit) == QDOT_OK && limit.kind == QDOT_END_VALUE) {
            *there = limit.value;
            return k;
        }
    }
    return HIGHEST;
}

/* The sign of e, which is not 0 for generic constants. */
static int
generic_sign(search *a, qdot_expr e)
{
    const uint8_t known = e == QDOT_NIL || e == QDOT_ZERO ? 0 : qdot_expr_sign(a->pool, e);
    const int sign = e == QDOT_ZERO ? 0 : sign_of(a, e);

    return sign != 0 || (known & (QDOT_GE0 | QDOT_LE0)) == 0 ? sign : known & QDOT_GE0 ? 1 : -1;
}

/* The sign of f between two neighbours, of which it has no zero or pole inside: near a wall, or in the middle. */
static int
sign_between(search *a, const place *from, const place *to)
{
    qdot_pool *pool = a->pool;
    qdot_expr mid, there;
    int sign = 0;

    for (int side = 1; side >= -1 && sign == 0; side -= 2) {
        const place *end = side > 0 ? from : to;

        if (end->kind == WALL && order_at(a, end, side, &there) < HIGHEST)
            sign = generic_sign(a, there);
    }
    if (sign != 0)
        return sign;
    mid = from->kind == FAR && to->kind == FAR ? QDOT_ZERO
          : from->kind == FAR                  ? qdot_sub(pool, to->at, QDOT_ONE)
          : to->kind == FAR                    ? qdot_add(pool, from->at, QDOT_ONE)
                                               : qdot_mul(pool, QDOT_HALF, qdot_add(pool, from->at, to->at));
    mid = qdot_simplify(pool, mid, &a->facts);
    if (mid == QDOT_NIL || qdot_expr_size(pool, mid) > LARGEST_MIDDLE)
        return 0;
    return sign_of(a, at_place(a, a->f, &(place){TURNING, mid, QDOT_NIL}));
}

/* Whether f changes its sign at a place: 1, it does, 0: it does not, -1: not known. A slope that is not 0 somewhere is 0 for
 * special parameters only. */
static int
changes_sign(search *a, const place *p)
{
    qdot_decision d;
    qdot_expr there;

    if (p->kind == POLE) {
        const int order = order_at(a, p, 1, &there);

        return order == HIGHEST || there == QDOT_ZERO ? -1 : order % 2;
    }
    there = p->kind == TURNING ? at_place(a, qdot_diff(a->pool, a->f, a->x), p) : QDOT_NIL;
    return there != QDOT_NIL && qdot_decide_equal(a->pool, there, QDOT_ZERO, &a->facts, &d) == QDOT_OK && d.verdict == QDOT_REFUTED ? 1 : -1;
}

/* The signs of f between all neighbours: each by itself, then from its neighbours, then by its slope. */
static void
find_signs(search *a, size_t n, const place *all, int *sign)
{
    for (size_t i = 0; i + 1 < n; i++)
        sign[i] = sign_between(a, &all[i], &all[i + 1]);
    for (size_t i = 1; i + 1 < n; i++)
        if (sign[i] == 0 && sign[i - 1] != 0 && changes_sign(a, &all[i]) >= 0)
            sign[i] = changes_sign(a, &all[i]) ? -sign[i - 1] : sign[i - 1];
    for (size_t i = n - 1; i-- > 1;)
        if (sign[i - 1] == 0 && sign[i] != 0 && changes_sign(a, &all[i]) >= 0)
            sign[i - 1] = changes_sign(a, &all[i]) ? -sign[i] : sign[i];
    for (size_t i = 0; i + 1 < n; i++) {
        const qdot_expr slope = qdot_diff(a->pool, a->f, a->x);

        if (sign[i] == 0 && all[i].kind == TURNING)
            sign[i] = sign_of(a, at_place(a, slope, &all[i]));
        if (sign[i] == 0 && all[i + 1].kind == TURNING)
            sign[i] = -sign_of(a, at_place(a, slope, &all[i + 1]));
    }
}

/* 2 int sqrt(f) between two places. */
static qdot_status
integrate_between(search *a, const place *from, const place *to, qdot_action_regime *out)
{
    qdot_pool *pool = a->pool;
    qdot_definite_answer answer;
    const qdot_expr root = qdot_sqrt(pool, a->f), two = qdot_expr_int(pool, 2);
    int order[2];

    for (int i = 0; i < 2; i++) {
        const place *end = i == 0 ? from : to;
        qdot_expr there;

        order[i] = end->kind == TURNING ? 0 : order_at(a, end, i == 0 ? 1 : -1, &there);
        out->wall |= end->kind != TURNING && order[i] == 0;
    }
    if (order[0] > 1 || order[1] > 1) {
        a->out->verdict = QDOT_ACTION_FALLS;
        return qdot_pool_check(pool);
    }
    out->value = out->wall ? QDOT_NIL : qdot_loop(pool, a->f, a->x, from->at, to->at, &a->facts);
    if (out->value != QDOT_NIL || qdot_grave(qdot_pool_check(pool)) != QDOT_OK)
        return qdot_pool_check(pool);
    QDOT_TRY(qdot_definite(pool, root, a->x, from->at, to->at, &a->facts, &answer));
    if (answer.kind == QDOT_DEFINITE_DIVERGES)
        a->out->verdict = QDOT_ACTION_FALLS;
    else
        out->value = qdot_mul(pool, two, answer.kind == QDOT_DEFINITE_FOUND ? answer.value
                                                                            : qdot_integral(pool, root, a->x, from->at, to->at));
    return qdot_pool_check(pool);
}

/* A full turn of an angle without turning points. */
static qdot_status
integrate_turn(search *a, qdot_action_regime *out)
{
    qdot_pool *pool = a->pool;
    const qdot_expr ends[] = {qdot_neg(pool, QDOT_PI), QDOT_PI}, part[] = {a->shift, qdot_sqrt(pool, a->f)};

    out->rotation = true;
    out->value = QDOT_ZERO;
    for (int i = 0; i < 2; i++) {
        qdot_definite_answer answer = {.kind = QDOT_DEFINITE_FOUND};

        answer.value = i == 1 ? qdot_loop_turn(pool, a->f, a->x, &a->facts) : QDOT_NIL;
        if (answer.value == QDOT_NIL)
            QDOT_TRY(qdot_definite(pool, part[i], a->x, ends[0], ends[1], &a->facts, &answer));
        out->value = qdot_add(pool, out->value, answer.kind == QDOT_DEFINITE_FOUND ? answer.value
                                                                                   : qdot_integral(pool, part[i], a->x, ends[0], ends[1]));
    }
    return qdot_pool_check(pool);
}

/* Whether x -> -x exchanges the well that begins at a with the one that ends at d. */
static bool
are_mirrored(search *s, const place *a, const place *d)
{
    qdot_pool *pool = s->pool;
    const qdot_expr back = qdot_neg(pool, s->x);

    return a->at != QDOT_NIL && d->at != QDOT_NIL && qdot_subs(pool, s->f, 1, &s->x, &back) == s->f &&
           qdot_is_zero(pool, qdot_add(pool, a->at, d->at), &s->facts);
}

/* The regime whose places, n of them, are all there are; *out has a value if the motion is bounded. */
static qdot_status
find_in_regime(search *a, size_t n, place *p, qdot_action_regime *out)
{
    qdot_pool *pool = a->pool;
    place all[MOST_PLACES + 2];
    int sign[MOST_PLACES + 1];
    const place far = {FAR, QDOT_NIL, QDOT_NIL};
    const qdot_expr turn = qdot_mul(pool, qdot_expr_int(pool, 2), QDOT_PI);
    const bool round = a->lo == QDOT_NIL && a->hi == QDOT_NIL && qdot_is_angle(pool, a->f, a->x, &a->facts);
    size_t count = 0, first = 0;

    for (size_t i = 0, sorted = sort_places(a, n, p); i < n && !sorted; i++)
        p[i].at = qdot_simplify(pool, p[i].at, &a->facts);
    if (!sort_places(a, n, p)) {
        a->out->verdict = QDOT_ACTION_NO_POINTS;
        return QDOT_OK;
    }
    if (!round)
        all[count++] = (place){a->lo == QDOT_NIL ? FAR : WALL, a->lo, QDOT_NIL};
    for (size_t i = 0; i < n; i++)
        all[count++] = p[i];
    if (!round)
        all[count++] = (place){a->hi == QDOT_NIL ? FAR : WALL, a->hi, QDOT_NIL};
    else if (n > 0) /* the last range of an angle ends at the first place, a turn later */
        all[count++] = (place){p[0].kind, qdot_simplify(pool, qdot_add(pool, p[0].at, turn), &a->facts), QDOT_NIL};
    if (n > 0 && a->lo != QDOT_NIL && qdot_is_zero(pool, qdot_sub(pool, p[0].at, a->lo), &a->facts))
        all[0] = all[1];
    if (round && n == 0)
        return sign_between(a, &far, &far) > 0 ? integrate_turn(a, out) : QDOT_OK;
    find_signs(a, count, all, sign);
    for (size_t i = 0; i + 1 < count; i++) {
        qdot_action_regime one = {0};

        if (all[i].kind == FAR || all[i + 1].kind == FAR || all[i].at == all[i + 1].at)
            continue;
        if (sign[i] == 0)
            a->out->verdict = QDOT_ACTION_NO_POINTS;
        if (sign[i] <= 0)
            continue;
        QDOT_TRY(integrate_between(a, &all[i], &all[i + 1], &one));
        if (out->value != QDOT_NIL && one.value != QDOT_NIL && are_mirrored(a, &all[first], &all[i + 1]))
            *out = one; /* of two equal wells the one on the right, where roots of x^2 are x */
        if (out->value != QDOT_NIL && one.value != QDOT_NIL && !qdot_is_zero(pool, qdot_sub(pool, out->value, one.value), &a->facts))
            a->out->verdict = QDOT_ACTION_SEVERAL;
        if (out->value == QDOT_NIL) {
            *out = one;
            first = i;
        }
    }
    return qdot_pool_check(pool);
}

/* --- regimes --------------------------------------------------------------------------------------- */

/* The relations of a set under which it does not hold, given that those of `known` do: the opposite of its one relation
 * that does not follow; nil: more than one, QDOT_FALSE: it holds. */
static qdot_expr
opposite_of(search *a, qdot_expr set, const qdot_facts *known)
{
    qdot_expr left = QDOT_FALSE;

    for (uint32_t i = 0; set != QDOT_NIL && i < qdot_expr_count(a->pool, set); i++) {
        const qdot_expr relation = qdot_expr_arg(a->pool, set, i);
        const qdot_expr gap = qdot_sub(a->pool, qdot_expr_arg(a->pool, relation, 1), qdot_expr_arg(a->pool, relation, 0));

        if (qdot_condition(a->pool, gap, false, known) == QDOT_TRUE)
            continue;
        if (left != QDOT_FALSE)
            return QDOT_NIL;
        left = qdot_condition(a->pool, qdot_neg(a->pool, gap), true, known);
    }
    return left;
}

/* The conditions of a set without factors of a sign that is known from the others: b > 0 and b (a - b) < 0 is b > 0 and
 * a < b. */
static qdot_expr
without_signs(search *a, qdot_expr set, const qdot_facts *scene)
{
    qdot_pool *pool = a->pool;
    qdot_expr done = QDOT_NIL, room[QDOT_CONDITIONS_MOST];

    for (uint32_t i = 0; set != QDOT_NIL && set != QDOT_FALSE && i < qdot_expr_count(pool, set); i++) {
        const qdot_expr relation = qdot_expr_arg(pool, set, i);
        qdot_expr others = QDOT_NIL,
                  gap = qdot_simplify(pool, qdot_sub(pool, qdot_expr_arg(pool, relation, 1), qdot_expr_arg(pool, relation, 0)), scene), left = gap;

        for (uint32_t k = 0; k < qdot_expr_count(pool, set); k++)
            if (k != i)
                others = qdot_conditions_and(pool, others, qdot_expr_arg(pool, set, k));
        a->facts = qdot_facts_and(pool, scene, others, room);
        for (uint32_t k = 1; gap != QDOT_NIL && qdot_expr_kind(pool, gap) == QDOT_PROD && k < qdot_expr_count(pool, gap); k += 2) {
            const qdot_expr factor = qdot_pow(pool, qdot_expr_arg(pool, gap, k), qdot_expr_arg(pool, gap, k + 1));
            const int sign = sign_of(a, factor);

            if (sign != 0)
                left = qdot_div(pool, left, sign > 0 ? factor : qdot_neg(pool, factor));
        }
        done = qdot_conditions_and(pool, done, left == gap ? relation : qdot_condition(pool, left, qdot_expr_node(pool, relation)->op == QDOT_LT, scene));
    }
    return set == QDOT_FALSE ? set : done;
}

/* Find the action where the sets of conditions in `mask` hold, and the others do not. */
static qdot_status
add_regime(search *a, size_t sets, const qdot_expr *set, unsigned mask, const qdot_facts *scene)
{
    qdot_pool *pool = a->pool;
    qdot_expr room[QDOT_CONDITIONS_MOST], holds = QDOT_NIL;
    qdot_action_regime one = {0};
    place p[MOST_PLACES];
    size_t n = 0;
    bool contradicts = false;

    for (size_t k = 0; k < sets; k++)
        if (mask >> k & 1)
            holds = qdot_conditions_all(pool, holds, qdot_conditions_generic(pool, set[k]));
    if (holds == QDOT_FALSE)
        return QDOT_OK;
    holds = without_signs(a, holds, scene);
    a->facts = qdot_facts_and(pool, scene, holds, room);
    for (size_t k = 0; k < sets; k++) {
        qdot_expr opposite;

        if (mask >> k & 1)
            continue;
        opposite = opposite_of(a, set[k], &a->facts);
        if (opposite == QDOT_FALSE)
            return QDOT_OK;
        if (opposite == QDOT_NIL) /* it fails in more than one way: only where nothing else is bounded that matters */
            return qdot_pool_check(pool);
        if (opposite != QDOT_TRUE)
            holds = qdot_conditions_and(pool, holds, opposite);
        a->facts = qdot_facts_and(pool, scene, holds, room);
    }
    QDOT_TRY(qdot_contradiction(pool, &a->facts, &contradicts));
    if (contradicts || holds == QDOT_FALSE)
        return QDOT_OK;
    for (size_t i = 0; i < a->n; i++) {
        bool is = a->at[i].when == QDOT_NIL;

        for (size_t k = 0; k < sets && !is; k++)
            is = (mask >> k & 1) && set[k] == a->at[i].when;
        if (is)
            p[n++] = a->at[i];
    }
    QDOT_TRY(find_in_regime(a, n, p, &one));
    if (one.value == QDOT_NIL)
        return QDOT_OK;
    one.condition = qdot_conditions_reduce(pool, holds, scene);
    one.value = qdot_simplify(pool, one.value, &a->facts);
    return qdot_vec_push(&a->out->regime, one);
}

/* The regimes of f as it stands, under the scene's assumptions. */
static qdot_status
find_regimes(search *a)
{
    const qdot_facts scene = a->facts;
    qdot_expr set[MOST_SETS];
    size_t sets = 0;

    QDOT_TRY(find_places(a));
    for (size_t i = 0; i < a->n && a->complete; i++) {
        size_t k = 0;

        if (a->at[i].when == QDOT_NIL)
            continue;
        while (k < sets && set[k] != a->at[i].when)
            k++;
        if (k == sets && sets == MOST_SETS)
            a->complete = false;
        else if (k == sets)
            set[sets++] = a->at[i].when;
    }
    if (!a->complete)
        a->out->verdict = QDOT_ACTION_NO_POINTS;
    for (unsigned mask = 1u << sets; mask-- > 0 && a->complete;)
        QDOT_TRY(add_regime(a, sets, set, mask, &scene));
    return qdot_pool_check(a->pool);
}

/* Constants of which only the sign is known, replaced by symbols that are positive: c = sign * symbol. */
typedef struct {
    size_t n;
    qdot_expr constant[MOST_SIGNED], is[MOST_SIGNED], symbol[MOST_SIGNED], back[MOST_SIGNED];
} signed_constants;

static void
add_signed(qdot_pool *pool, signed_constants *c, qdot_expr constant, int sign)
{
    const qdot_expr symbol = qdot_symbol_get(pool, QDOT_PARAM, "positive#");

    qdot_symbol_hide(pool, symbol);
    if (symbol == QDOT_NIL || c->n == MOST_SIGNED)
        return;
    qdot_symbol_domain(pool, symbol, QDOT_ZERO, true, QDOT_NIL, false);
    c->constant[c->n] = constant;
    c->symbol[c->n] = symbol;
    c->is[c->n] = sign > 0 ? symbol : qdot_neg(pool, symbol);
    c->back[c->n++] = sign > 0 ? constant : qdot_neg(pool, constant);
}

/* Find the regimes with E of this sign (0: as it is known), and what is found in terms of E. */
static qdot_status
find_with_energy(qdot_scene *s, const qdot_separation *all, const qdot_separated *x, int sign, qdot_action *out)
{
    qdot_pool *pool = s->pool;
    search a = {.s = s, .pool = pool, .x = x->q, .shift = x->shift, .facts = qdot_scene_facts(s), .out = out};
    signed_constants c = {0};
    const size_t before = out->regime.n;

    for (uint32_t i = 0; all->signs != QDOT_NIL && i < qdot_expr_count(pool, all->signs); i++)
        add_signed(pool, &c, qdot_expr_arg(pool, qdot_expr_arg(pool, all->signs, i), 1), 1);
    if (sign != 0)
        add_signed(pool, &c, all->energy, sign);
    a.f = qdot_subs(pool, x->square, c.n, c.constant, c.is);
    a.f = c.n > 0 ? qdot_simplify(pool, a.f, &a.facts) : a.f;
    a.shift = qdot_subs(pool, a.shift, c.n, c.constant, c.is);
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(find_regimes(&a));
    for (size_t i = before; i < out->regime.n; i++) {
        qdot_action_regime *one = &out->regime.at[i];

        one->value = qdot_subs(pool, one->value, c.n, c.symbol, c.back);
        if (one->condition != QDOT_NIL)
            one->condition = qdot_subs(pool, one->condition, c.n, c.symbol, c.back);
        if (sign != 0)
            one->condition = qdot_conditions_and(pool, one->condition, sign > 0 ? qdot_rel(pool, QDOT_LT, QDOT_ZERO, all->energy)
                                                                                : qdot_rel(pool, QDOT_LT, all->energy, QDOT_ZERO));
    }
    return qdot_pool_check(pool);
}

/* The conditions of a set that do not follow from the sign of E; *all: their union with those gathered so far. */
static void
gather_conditions(qdot_scene *s, qdot_expr set, qdot_expr sign, qdot_expr *all)
{
    const qdot_facts of_scene = qdot_scene_facts(s);
    qdot_expr room[QDOT_CONDITIONS_MOST];
    const qdot_facts other = qdot_facts_and(s->pool, &of_scene, qdot_list(s->pool, 1, &sign), room);

    for (uint32_t i = 0; set != QDOT_NIL && i < qdot_expr_count(s->pool, set); i++) {
        const qdot_expr relation = qdot_expr_arg(s->pool, set, i);
        const qdot_expr gap = qdot_sub(s->pool, qdot_expr_arg(s->pool, relation, 1), qdot_expr_arg(s->pool, relation, 0));

        /* it holds for the other sign of E: it is no condition on that side; or it is the sign itself */
        if (qdot_condition(s->pool, gap, true, &other) == QDOT_TRUE)
            *all = qdot_conditions_and(s->pool, *all, relation);
        else if (qdot_expr_arg(s->pool, relation, 0) != qdot_expr_arg(s->pool, sign, 1) || qdot_expr_arg(s->pool, relation, 1) != qdot_expr_arg(s->pool, sign, 0))
            *all = QDOT_FALSE;
    }
}

/* The conditions of a set but the sign of E, each as it is written where nothing is replaced. */
static qdot_expr
without_sign(qdot_scene *s, qdot_expr set, qdot_expr sign)
{
    qdot_pool *pool = s->pool;
    const qdot_facts facts = qdot_scene_facts(s);
    qdot_expr rest = QDOT_NIL;

    for (uint32_t i = 0; set != QDOT_NIL && i < qdot_expr_count(pool, set); i++) {
        const qdot_expr relation = qdot_expr_arg(pool, set, i);
        const qdot_expr gap = qdot_sub(pool, qdot_expr_arg(pool, relation, 1), qdot_expr_arg(pool, relation, 0));

        if (relation != sign)
            rest = qdot_conditions_and(pool, rest, qdot_condition(pool, qdot_simplify(pool, gap, &facts), qdot_expr_node(pool, relation)->op == QDOT_LT, &facts));
    }
    return rest;
}

/* Join a regime with E < 0 and one with E > 0 that have the same value, where beside the sign of E their conditions are the
 * same, or the conditions of each hold for the other sign of E. */
static void
join_signs(qdot_scene *s, qdot_expr E, qdot_action *out)
{
    qdot_pool *pool = s->pool;
    const qdot_expr negative = qdot_rel(pool, QDOT_LT, E, QDOT_ZERO), positive = qdot_rel(pool, QDOT_LT, QDOT_ZERO, E);

    for (size_t i = 0; i < out->regime.n; i++)
        for (size_t k = i + 1; k < out->regime.n; k++) {
            qdot_action_regime *a = &out->regime.at[i], *b = &out->regime.at[k];
            qdot_expr all = QDOT_NIL;

            if (a->value != b->value)
                continue;
            all = without_sign(s, a->condition, negative);
            if (all != without_sign(s, b->condition, positive)) {
                all = QDOT_NIL;
                gather_conditions(s, a->condition, positive, &all);
                if (all != QDOT_FALSE)
                    gather_conditions(s, b->condition, negative, &all);
            }
            if (all == QDOT_FALSE)
                continue;
            a->condition = all;
            for (size_t j = k; j + 1 < out->regime.n; j++)
                out->regime.at[j] = out->regime.at[j + 1];
            out->regime.n--;
        }
}

qdot_status
qdot_action_find(qdot_scene *s, const qdot_separation *all, size_t which, qdot_action *out)
{
    const qdot_separated *x = &all->of[which];
    const bool open = qdot_expr_symbol(s->pool, all->energy) != NULL && (qdot_expr_sign(s->pool, all->energy) & (QDOT_GE0 | QDOT_LE0)) == 0 &&
                      qdot_expr_contains(s->pool, x->square, all->energy);

    *out = (qdot_action){.verdict = QDOT_ACTION_UNBOUND};
    for (int sign = open ? -1 : 0; sign <= (open ? 1 : 0); sign += 2)
        QDOT_TRY(find_with_energy(s, all, x, sign, out));
    if (open)
        join_signs(s, all->energy, out);
    if (out->regime.n > 0 && out->verdict != QDOT_ACTION_SEVERAL)
        out->verdict = QDOT_ACTION_FOUND;
    return qdot_pool_check(s->pool);
}

void
qdot_action_clear(qdot_action *a)
{
    qdot_free(a->regime.at);
    *a = (qdot_action){0};
}
