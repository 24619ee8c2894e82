/* less.c -- inequalities: signs of factors, ends of the ranges of cosines, boxes; else
 * a point. */
#include "normal/inequality/less.h"

#include <math.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/memo.h"
#include "expr/node.h"
#include "expr/polynomial/flint.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/field/prepare.h"
#include "normal/form/shortest.h"
#include "normal/inequality/constant-bounds.h"
#include "normal/inequality/factor-signs.h"
#include "normal/inequality/inequality.h"
#include "normal/inequality/rising.h"
#include "normal/inequality/sign.h"
#include "normal/refute/sample.h"

enum { MOST_BOXES = 3000, MOST_SIDES = 3, TRIES = 200, FEW_TRIES = 8 };

/* --- shifting domains to zero; boxes ----------------------------------------------- */

/* x = lo + y or hi - y, y >= 0, for every bound that is a number but not zero;
 * expanded. */
static qdot_expr
shift_to_bounds(qdot_pool *pool, qdot_expr e)
{
    qdot_expr atoms = qdot_expr_atoms(pool, e, false), result = e;
    uint32_t n = atoms == QDOT_NIL ? 0 : qdot_expr_count(pool, atoms);

    for (uint32_t i = 0; i < n; i++) {
        qdot_expr x = qdot_expr_arg(pool, atoms, i), y, to;
        const qdot_symbol *s = qdot_expr_symbol(pool, x);
        qdot_expr lo = s->lo, hi = s->hi;
        bool open = lo != QDOT_NIL ? s->lo_open : s->hi_open;
        char name[64];

        if ((lo == QDOT_NIL && hi == QDOT_NIL) || lo == QDOT_ZERO)
            continue;
        snprintf(name, sizeof name, open ? "(shift %u)" : "(shift %u]", i);
        y = qdot_symbol_get(pool, QDOT_FORMAL, name);
        qdot_symbol_domain(pool, y, QDOT_ZERO, open, QDOT_NIL, false);
        to = lo != QDOT_NIL ? qdot_add(pool, lo, y) : qdot_sub(pool, hi, y);
        result = qdot_subs(pool, result, 1, &x, &to);
    }
    return result == e ? e : qdot_expand(pool, result);
}

struct box {
    double lo[MOST_SIDES], hi[MOST_SIDES];
};

struct boxes {
    qdot_expr atom[MOST_SIDES];
    const struct box *box;
    uint32_t n;
};

static bool
box_side(void *user, qdot_expr atom, arb_t value, slong prec)
{
    const struct boxes *b = user;
    arf_t lo, hi;

    for (uint32_t i = 0; i < b->n; i++)
        if (b->atom[i] == atom) {
            arf_init(lo);
            arf_init(hi);
            arf_set_d(lo, b->box->lo[i]);
            arf_set_d(hi, b->box->hi[i]);
            arb_set_interval_arf(value, lo, hi, prec);
            if (arf_sgn(lo) >= 0) /* rounding may not move the end 0 out of the domain of roots */
                arb_nonnegative_part(value, value);
            arf_clear(lo);
            arf_clear(hi);
            return true;
        }
    return false;
}

/* Whether e > 0 on the whole (closed) box of its symbols' domains: halved until every
 * part says so. */
static bool
is_positive_on_box(qdot_pool *pool, qdot_expr e)
{
    qdot_expr atoms = qdot_expr_atoms(pool, e, true);
    struct boxes b = {.n = atoms == QDOT_NIL ? 99 : qdot_expr_count(pool, atoms)};
    struct box *stack;
    size_t depth = 0, done = 0;
    qdot_ball ball;
    bool positive = true;

    if (b.n > MOST_SIDES)
        return false;
    stack = qdot_malloc((MOST_BOXES + 2) * sizeof *stack);
    if (stack == NULL)
        return false;
    for (uint32_t i = 0; i < b.n && positive; i++) {
        qdot_interval domain = qdot_interval_whole;

        b.atom[i] = qdot_expr_arg(pool, atoms, i);
        if (qdot_expr_kind(pool, b.atom[i]) == QDOT_SYM)
            domain = qdot_ball_domain(pool, b.atom[i]);
        stack[0].lo[i] = domain.lo;
        stack[0].hi[i] = domain.hi;
        positive = isfinite(domain.lo) && isfinite(domain.hi);
    }
    if (!positive || qdot_ball_begin(&ball, pool, 1, &e) != QDOT_OK) {
        qdot_free(stack);
        return false;
    }
    depth = 1;
    while (depth > 0 && positive) {
        struct box box = stack[--depth];
        arb_srcptr value;
        uint32_t widest = 0;

        b.box = &box;
        qdot_ball_eval(&ball, 53, box_side, &b);
        value = qdot_ball_get(&ball, e);
        if (value != NULL && arb_is_positive(value))
            continue;
        positive = ++done < MOST_BOXES && depth + 2 < MOST_BOXES && b.n > 0 &&
                   !(value != NULL && arb_is_nonpositive(value)) && !qdot_interrupt_is_set();
        for (uint32_t i = 1; i < b.n; i++)
            if (box.hi[i] - box.lo[i] > box.hi[widest] - box.lo[widest])
                widest = i;
        if (positive && box.hi[widest] - box.lo[widest] < 1e-9)
            positive = false;
        if (positive) {
            double middle = (box.lo[widest] + box.hi[widest]) / 2;

            stack[depth] = stack[depth + 1] = box;
            stack[depth].hi[widest] = stack[depth + 1].lo[widest] = middle;
            depth += 2;
        }
    }
    qdot_ball_end(&ball);
    qdot_free(stack);
    return positive;
}

/* --- deciding left < right --------------------------------------------------------- */

static bool
sign_suffices(uint8_t sign, bool strict)
{
    return strict ? (sign & QDOT_POS) == QDOT_POS : (sign & QDOT_GE0) != 0;
}

/* Whether d is seen to be negative at one of a few points of the declared domains: then no proof is tried, which would
 * simplify and factor d in vain. */
static bool
is_negative_somewhere(qdot_pool *pool, qdot_expr d)
{
    bool negative = false;
    qdot_sample s;

    if (d == QDOT_NIL || qdot_sample_begin(&s, pool, 1, &d, NULL) != QDOT_OK)
        return false;
    for (int k = 0; s.possible && k < FEW_TRIES && !negative; k++) {
        qdot_sample_point(&s, k);
        if (qdot_sample_eval(&s, 64)) {
            arb_srcptr value = qdot_ball_get(&s.ball, d);

            negative = value != NULL && arb_is_negative(value);
        }
    }
    qdot_sample_end(&s);
    return negative;
}

static bool
proved(qdot_pool *pool, qdot_expr d, bool strict, const qdot_facts *facts)
{
    qdot_expr s;

    if (sign_suffices(qdot_expr_sign(pool, d), strict))
        return true;
    s = qdot_with_less_constants(pool, d, false);
    if (s != QDOT_NIL && sign_suffices(qdot_expr_sign(pool, s), strict))
        return true;
    d = qdot_known_signs(pool, d, facts);
    if ((facts == NULL || facts->n_relations == 0) && is_negative_somewhere(pool, d))
        return false;
    s = qdot_shortest(pool, d, facts);
    if (s == QDOT_NIL)
        return false;
    if (sign_suffices(qdot_expr_sign(pool, s), strict) || sign_suffices(qdot_sign_by_factors(pool, s), strict))
        return true;
    d = shift_to_bounds(pool, s);
    if (d != s &&
        (sign_suffices(qdot_expr_sign(pool, d), strict) || sign_suffices(qdot_sign_by_factors(pool, d), strict)))
        return true;
    return is_positive_on_box(pool, s);
}

/* Whether the fact 0 < |u| (gap = |u|) can help to prove 0 < d: d contains |u|, or is u times a number. */
static bool
is_of_nonzero(qdot_pool *pool, qdot_expr d, qdot_expr gap, const qdot_facts *facts)
{
    qdot_expr ratio;

    if (qdot_expr_contains(pool, d, gap))
        return true;
    ratio = qdot_shortest(pool, qdot_div(pool, d, qdot_expr_arg(pool, gap, 0)), facts);
    return ratio == QDOT_NIL || qdot_expr_rational(pool, ratio) != NULL;
}

/* Whether all divisors in e are proved not to be 0, and e contains no function with a pole. */
static bool
divisors_are_nonzero(qdot_pool *pool, qdot_expr e)
{
    bool good = e != QDOT_NIL;
    qdot_walk w;

    if (!good || qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return false;
    for (size_t i = 0; i < w.n && good; i++) {
        good = !qdot_expr_is_function_that(pool, w.at[i], QDOT_FUN_POLE);
        for (uint32_t k = 1; qdot_expr_kind(pool, w.at[i]) == QDOT_PROD && k < qdot_expr_count(pool, w.at[i]); k += 2)
            good = good && ((qdot_expr_sign(pool, qdot_expr_arg(pool, w.at[i], k + 1)) & QDOT_POS) == QDOT_POS ||
                            (qdot_expr_sign(pool, qdot_expr_arg(pool, w.at[i], k)) & QDOT_NE0) != 0);
    }
    qdot_walk_end(&w);
    return good;
}

/* Prove d > 0 from a condition u < v: if d is a positive multiple of v - u, or at least v - u. */
static bool
proved_by_condition(qdot_pool *pool, qdot_expr d, bool strict, const qdot_facts *facts)
{
    for (size_t i = 0; facts != NULL && i < facts->n_conditions; i++) {
        qdot_expr c = facts->conditions[i], gap, rest;
        bool sharp;

        if (qdot_expr_kind(pool, c) != QDOT_REL || qdot_expr_node(pool, c)->op == QDOT_EQ)
            continue;
        sharp = qdot_expr_node(pool, c)->op == QDOT_LT;
        gap = qdot_sub(pool, qdot_expr_arg(pool, c, 1), qdot_expr_arg(pool, c, 0));
        if (strict && !sharp)
            continue;
        if (qdot_expr_is_function(pool, gap, QDOT_ABS) && !is_of_nonzero(pool, d, gap, facts))
            continue;
        rest = qdot_sub(pool, d, gap);
        if (qdot_is_zero(pool, rest, facts) || proved(pool, rest, false, facts))
            return true;
        if (gap == QDOT_ZERO)
            continue;
        rest = qdot_div(pool, d, gap);
        if (!sharp) /* divide d by the gap: where the gap is 0, d = 0 if the ratio is defined there */
            rest = qdot_shortest(pool, rest, facts);
        if ((sharp || divisors_are_nonzero(pool, rest)) && proved(pool, rest, strict, facts))
            return true;
    }
    return false;
}

/* Look for a point where left - right is certainly not negative (strict), or certainly positive. */
static qdot_status
refute(qdot_pool *pool, qdot_expr left, qdot_expr right, bool strict,
       const qdot_facts *facts, qdot_decision *d)
{
    qdot_expr none = qdot_list(pool, 0, NULL);
    qdot_expr e[3] = {
        left, right, facts != NULL && facts->defined != QDOT_NIL ? facts->defined : none};
    qdot_sample s;
    arb_t gap;

    QDOT_TRY(qdot_sample_begin(&s, pool, 3, e, facts));
    arb_init(gap);
    for (int k = 0; s.possible && k < TRIES && d->verdict == QDOT_UNDECIDED; k++) {
        if (qdot_interrupt_is_set())
            break;
        qdot_sample_point(&s, k);
        for (slong prec = 64; prec <= 1024; prec *= 4) {
            bool here = qdot_sample_eval(&s, prec);
            arb_srcptr l = qdot_ball_get(&s.ball, left),
                       r = qdot_ball_get(&s.ball, right);

            if (!here || l == NULL || r == NULL)
                continue;
            for (uint32_t i = 0; i < qdot_expr_count(pool, e[2]); i++)
                here &= qdot_ball_get(&s.ball, qdot_expr_arg(pool, e[2], i)) != NULL;
            if (!here)
                continue;
            arb_sub(gap, l, r, prec);
            if (!arb_contains_zero(gap) || arb_is_zero(gap)) {
                if (arb_is_positive(gap) || (strict && arb_is_zero(gap))) {
                    d->verdict = QDOT_REFUTED;
                    d->at = qdot_sample_list(&s);
                    d->left = arf_get_d(arb_midref(l), ARF_RND_NEAR);
                    d->right = arf_get_d(arb_midref(r), ARF_RND_NEAR);
                } else {
                    d->points++;
                }
                break;
            }
        }
    }
    arb_clear(gap);
    qdot_sample_end(&s);
    QDOT_TRY(qdot_interrupt_is_set() ? qdot_interrupt_check() : QDOT_OK);
    return qdot_pool_failed(pool) ? qdot_pool_check(pool) : QDOT_OK;
}

/* Refute left < right at a point, a LIST of symbol = rational, where right - left was found negative (or zero). */
static qdot_status
refute_at_point(qdot_pool *pool, qdot_expr left, qdot_expr right, bool strict,
                const qdot_facts *facts, qdot_expr at, qdot_decision *d)
{
    qdot_expr none = qdot_list(pool, 0, NULL);
    qdot_expr e[4] = {left, right, qdot_sub(pool, right, left),
                      facts != NULL && facts->defined != QDOT_NIL ? facts->defined
                                                                  : none};
    arb_srcptr l, r, gap;
    bool here = true;
    qdot_ball ball;

    for (int k = 0; k < 4; k++)
        for (uint32_t i = 0; i < qdot_expr_count(pool, at) && e[k] != QDOT_NIL; i++) {
            qdot_expr row = qdot_expr_arg(pool, at, i);
            qdot_expr x = qdot_expr_arg(pool, row, 0), v = qdot_expr_arg(pool, row, 1);

            e[k] = qdot_subs(pool, e[k], 1, &x, &v);
        }
    if (e[0] == QDOT_NIL || e[1] == QDOT_NIL || e[2] == QDOT_NIL || e[3] == QDOT_NIL)
        return qdot_pool_check(pool) == QDOT_EDOMAIN ? QDOT_OK
                                                     : qdot_last_error()->status;
    QDOT_TRY(qdot_ball_begin(&ball, pool, 4, e));
    qdot_ball_eval(&ball, 512, NULL, NULL);
    l = qdot_ball_get(&ball, e[0]);
    r = qdot_ball_get(&ball, e[1]);
    gap = qdot_ball_get(&ball, e[2]);
    for (uint32_t i = 0; i < qdot_expr_count(pool, e[3]); i++)
        here &= qdot_ball_get(&ball, qdot_expr_arg(pool, e[3], i)) != NULL;
    if (here && l != NULL && r != NULL && gap != NULL &&
        (arb_is_negative(gap) || (strict && arb_is_zero(gap)))) {
        d->verdict = QDOT_REFUTED;
        d->at = at;
        d->left = arf_get_d(arb_midref(l), ARF_RND_NEAR);
        d->right = arf_get_d(arb_midref(r), ARF_RND_NEAR);
    }
    qdot_ball_end(&ball);
    return QDOT_OK;
}

/* Whether gap is |u|, there are no conditions, and points with u > 0 and with u < 0 are found. Then u is 0 somewhere in the
 * box of the declared domains, or jumps over 0, and there is no use in trying to prove 0 < |u|. */
static qdot_status
has_both_signs(qdot_pool *pool, qdot_expr gap, const qdot_facts *facts, bool *yes)
{
    qdot_decision above = {.verdict = QDOT_UNDECIDED}, below = {.verdict = QDOT_UNDECIDED};
    qdot_expr u;

    *yes = false;
    if (!qdot_expr_is_function(pool, gap, QDOT_ABS) || (facts != NULL && facts->n_conditions > 0))
        return QDOT_OK;
    u = qdot_expr_arg(pool, gap, 0);
    QDOT_TRY(refute(pool, QDOT_ZERO, u, false, facts, &above));
    if (above.verdict == QDOT_REFUTED)
        QDOT_TRY(refute(pool, u, QDOT_ZERO, false, facts, &below));
    *yes = below.verdict == QDOT_REFUTED;
    return QDOT_OK;
}

/* *holds: 0 < gap (strict) or 0 <= gap is proved with rational bounds in place of the constants in sums, of the gap and of
 * the conditions: what is transcendental in these stands in the way of a proof by cells. */
static qdot_status
by_rational_constants(qdot_pool *pool, qdot_expr gap, bool strict, const qdot_facts *facts, bool *holds)
{
    const qdot_expr less = qdot_with_less_constants(pool, gap, true);
    qdot_facts weaker = facts == NULL ? (qdot_facts){0} : *facts;
    bool changed = less != QDOT_NIL;
    qdot_expr *conditions = qdot_malloc((weaker.n_conditions + 1) * sizeof *conditions), at;
    qdot_status status = conditions == NULL ? QDOT_ENOMEM : QDOT_OK;
    size_t n = 0;

    *holds = false;
    for (size_t i = 0; status == QDOT_OK && i < weaker.n_conditions; i++) {
        conditions[n] = qdot_weaker_condition(pool, weaker.conditions[i]);
        changed = changed || conditions[n] != weaker.conditions[i];
        n += conditions[n] != QDOT_NIL;
    }
    weaker.conditions = conditions;
    weaker.n_conditions = n;
    gap = less == QDOT_NIL ? gap : less;
    if (status == QDOT_OK)
        status = qdot_grave(qdot_pool_check(pool));
    if (status == QDOT_OK && changed && !qdot_holds_constant_function(pool, gap)) {
        *holds = proved(pool, gap, strict, &weaker) || proved_by_condition(pool, gap, strict, &weaker);
        if (!*holds)
            status = qdot_inequality(pool, qdot_without_signed_factors(pool, gap), strict, &weaker, holds, &at);
    }
    qdot_free(conditions);
    return status;
}

static qdot_status
less_decide(qdot_pool *pool, qdot_expr left, qdot_expr right, bool strict,
            const qdot_facts *facts, qdot_decision *d)
{
    qdot_expr gap, risen, at = QDOT_NIL;
    qdot_decision simpler = {.verdict = QDOT_UNDECIDED};
    bool holds, given_up = false;

    *d = (qdot_decision){.verdict = QDOT_UNDECIDED};
    if (left == QDOT_NIL || right == QDOT_NIL)
        return qdot_pool_failed(pool) ? qdot_pool_check(pool)
                                      : qdot_fail(QDOT_EINVAL, "nothing to compare");
    if (!qdot_expr_is_scalar(pool, left) || !qdot_expr_is_scalar(pool, right))
        return qdot_fail(QDOT_ETYPE,
                         "numbers are compared here, not vectors or equations");
    gap = qdot_sub(pool, right, left);
    if (gap != QDOT_NIL && (proved(pool, gap, strict, facts) ||
                            proved_by_condition(pool, gap, strict, facts))) {
        d->verdict = QDOT_PROVED;
        return QDOT_OK;
    }
    /* a division by zero during the proof proves nothing */
    QDOT_TRY(qdot_grave(qdot_pool_check(pool)));
    QDOT_TRY(refute(pool, left, right, strict, facts, d));
    if (d->verdict == QDOT_UNDECIDED && gap != QDOT_NIL && strict)
        QDOT_TRY(has_both_signs(pool, gap, facts, &given_up));
    if (d->verdict != QDOT_UNDECIDED || given_up)
        return QDOT_OK;
    risen = qdot_without_rising(pool, gap, strict);
    if (risen != gap && risen != QDOT_NIL)
        QDOT_TRY(less_decide(pool, QDOT_ZERO, risen, strict, facts, &simpler));
    holds = simpler.verdict == QDOT_PROVED;
    if (!holds)
        QDOT_TRY(qdot_inequality(pool, qdot_without_signed_factors(pool, gap), strict, facts, &holds, &at));
    if (holds)
        d->verdict = QDOT_PROVED;
    else if (at != QDOT_NIL)
        QDOT_TRY(refute_at_point(pool, left, right, strict, facts, at, d));
    if (d->verdict == QDOT_UNDECIDED)
        QDOT_TRY(by_rational_constants(pool, gap, strict, facts, &holds));
    if (d->verdict == QDOT_UNDECIDED && !holds) {
        int sign;

        QDOT_TRY(qdot_sign(pool, gap, facts, &sign));
        holds = sign == 1;
    }
    if (d->verdict == QDOT_UNDECIDED && !holds && facts != NULL && facts->n_conditions > 0) {
        qdot_facts fewer = *facts; /* some conditions are in the way of a proof that needs none of them */
        qdot_decision without;

        fewer.n_conditions = 0;
        QDOT_TRY(qdot_decide_less(pool, left, right, strict, &fewer, &without));
        holds = without.verdict == QDOT_PROVED;
    }
    if (d->verdict == QDOT_UNDECIDED && holds)
        d->verdict = QDOT_PROVED;
    return QDOT_OK;
}

struct order {
    qdot_pool *pool;
    qdot_expr left, right;
    bool strict;
    const qdot_facts *facts;
    qdot_decision d;
    qdot_status status;
};

static void
decide_less_task(void *user)
{
    struct order *x = user;

    x->status = less_decide(x->pool, x->left, x->right, x->strict, x->facts, &x->d);
}

/* --- questions that were answered before -------------------------------------------- */

/* The stored answer of a decision; also whether a simplification on the way stopped at its budget. */
struct decided {
    qdot_decision d;
    bool unfinished;
};

/* The two sides and all facts as one expression, under which an answer is stored. Nil: it cannot be. */
static qdot_expr
question_as_list(qdot_pool *pool, qdot_expr left, qdot_expr right, const qdot_facts *facts)
{
    static const qdot_facts nothing = {0};
    const qdot_facts *f = facts == NULL ? &nothing : facts;
    qdot_expr all[5] = {left, right, QDOT_NIL, QDOT_NIL, f->defined};

    if (left == QDOT_NIL || right == QDOT_NIL || qdot_pool_failed(pool))
        return QDOT_NIL;
    all[2] = qdot_list(pool, (uint32_t)f->n_conditions, f->conditions);
    all[3] = qdot_list(pool, (uint32_t)f->n_relations, f->relations);
    return qdot_list(pool, f->defined == QDOT_NIL ? 4 : 5, all);
}

qdot_status
qdot_decide_less(qdot_pool *pool, qdot_expr left, qdot_expr right, bool strict,
                 const qdot_facts *facts, qdot_decision *d)
{
    struct order x = {pool, left, right, strict, facts, {.verdict = QDOT_UNDECIDED}, 0};
    const qdot_expr question = question_as_list(pool, left, right, facts);
    const uint32_t asked = QDOT_MEMO_LESS | (uint32_t)strict | (uint32_t)(facts != NULL && facts->exact) << 1 |
                           (facts == NULL ? 0 : facts->free_derivatives) << 2;
    struct decided known;
    bool before;
    qdot_status status;

    if (qdot_memo_find(pool, question, asked, &known, sizeof known)) {
        if (known.unfinished)
            qdot_pool_unfinished(pool);
        *d = known.d;
        return QDOT_OK;
    }
    before = qdot_pool_unfinished_taken(pool);
    status = qdot_flint_run(pool, decide_less_task, &x);
    *d = status == QDOT_OK ? x.d : (qdot_decision){.verdict = QDOT_UNDECIDED};
    known = (struct decided){*d, qdot_pool_unfinished_taken(pool)};
    if (before || known.unfinished)
        qdot_pool_unfinished(pool);
    if (status == QDOT_OK && x.status == QDOT_OK && !qdot_pool_failed(pool) && !qdot_interrupt_is_set())
        qdot_memo_keep(pool, question, asked, &known, sizeof known);
    return status == QDOT_ELIMIT ? QDOT_OK : status != QDOT_OK ? status : x.status;
}

/* --- |u|, sign u and if, as far as conditions decide them ---------------------------- */

/* The facts without the conditions that hold |u|, sign u or an if: asked about what such a condition says, they would ask
 * about these nodes again, without end or once for every order of them. Conditions are copied to `left`
 * [facts->n_conditions]. */
static qdot_facts
facts_without_choices(qdot_pool *pool, const qdot_facts *facts, qdot_expr *left)
{
    static const qdot_fun_id choices[] = {QDOT_ABS, QDOT_SIGN, QDOT_IF};
    qdot_facts rest = *facts;

    rest.n_conditions = 0;
    rest.conditions = left;
    for (size_t i = 0; i < facts->n_conditions; i++)
        if (qdot_expr_find_function(pool, facts->conditions[i], 3, choices, QDOT_NIL) == QDOT_NIL)
            left[rest.n_conditions++] = facts->conditions[i];
    return rest;
}

/* Replace |u| by u or -u, sign(u) by 1 or -1, if the facts decide the sign of u; nil if they do not. */
static qdot_expr
replace_by_known_sign(qdot_pool *pool, qdot_expr node, const qdot_facts *facts)
{
    const bool sign = qdot_expr_node(pool, node)->op == QDOT_SIGN;
    const qdot_expr u = qdot_expr_arg(pool, node, 0);
    qdot_decision above, below;

    if (qdot_decide_less(pool, QDOT_ZERO, u, sign, facts, &above) != QDOT_OK ||
        qdot_decide_less(pool, u, QDOT_ZERO, sign, facts, &below) != QDOT_OK)
        return qdot_pool_fail(pool);
    if (above.verdict == QDOT_PROVED)
        return sign ? QDOT_ONE : u;
    if (below.verdict == QDOT_PROVED)
        return sign ? QDOT_MINUS_ONE : qdot_neg(pool, u);
    return QDOT_NIL;
}

/* The truth of a comparison by the facts: 1 proved, -1 refuted, 0 neither. */
static int
truth_of_comparison(qdot_pool *pool, qdot_expr c, const qdot_facts *facts)
{
    const uint32_t op = qdot_expr_node(pool, c)->op;
    const qdot_expr a = qdot_expr_arg(pool, c, 0), b = qdot_expr_arg(pool, c, 1);
    qdot_decision is, is_not;

    if (op == QDOT_EQ)
        return 0;
    if (qdot_decide_less(pool, a, b, op == QDOT_LT, facts, &is) != QDOT_OK ||
        qdot_decide_less(pool, b, a, op != QDOT_LT, facts, &is_not) != QDOT_OK) {
        (void)qdot_pool_fail(pool);
        return 0;
    }
    return is.verdict == QDOT_PROVED ? 1 : is_not.verdict == QDOT_PROVED ? -1 : 0;
}

/* The truth of the condition of an if, comparisons joined by and, or, not: 1 proved, -1 refuted, 0 neither. */
static int
truth_of_condition(qdot_pool *pool, qdot_expr c, const qdot_facts *facts)
{
    const uint32_t op = qdot_expr_node(pool, c)->op;
    int least = 1, most = -1;

    if (c == QDOT_TRUE || c == QDOT_FALSE)
        return c == QDOT_TRUE ? 1 : -1;
    if (qdot_expr_kind(pool, c) == QDOT_REL)
        return truth_of_comparison(pool, c, facts);
    if (qdot_expr_kind(pool, c) != QDOT_LOGIC)
        return 0;
    for (uint32_t i = 0; i < qdot_expr_count(pool, c); i++) {
        const int one = truth_of_condition(pool, qdot_expr_arg(pool, c, i), facts);

        least = one < least ? one : least;
        most = one > most ? one : most;
    }
    return op == QDOT_NOT ? -least : op == QDOT_AND ? least : most;
}

/* The value of |u|, sign(u) or if(c, u, v) under the facts; nil if it is undecided, and for other nodes. */
static qdot_expr
replace_decided_node(qdot_pool *pool, qdot_expr node, void *user)
{
    const qdot_facts *facts = user;
    const uint32_t op = qdot_expr_node(pool, node)->op;
    qdot_facts rest;
    qdot_expr *left, known = QDOT_NIL;

    if (qdot_expr_kind(pool, node) != QDOT_FUN || (op != QDOT_ABS && op != QDOT_SIGN && op != QDOT_IF))
        return QDOT_NIL;
    left = qdot_malloc(facts->n_conditions * sizeof *left);
    if (left == NULL)
        return qdot_pool_fail(pool);
    rest = facts_without_choices(pool, facts, left);
    if (op == QDOT_IF) {
        const int is = truth_of_condition(pool, qdot_expr_arg(pool, node, 0), &rest);

        known = is == 0 ? QDOT_NIL : qdot_known_signs(pool, qdot_expr_arg(pool, node, is > 0 ? 1 : 2), facts);
    } else {
        known = replace_by_known_sign(pool, node, &rest);
    }
    qdot_free(left);
    return known;
}

qdot_expr
qdot_known_signs(qdot_pool *pool, qdot_expr e, const qdot_facts *facts)
{
    if (e == QDOT_NIL || facts == NULL || facts->n_conditions == 0)
        return e;
    return qdot_walk_map(pool, e, replace_decided_node, (void *)(uintptr_t)facts);
}
