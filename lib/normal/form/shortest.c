/* shortest.c -- makes equivalent forms of an expression and keeps the one with the fewest operations. */
#include "normal/form/shortest.h"

#include <math.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/memo.h"
#include "expr/node.h"
#include "expr/polynomial/flint.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "normal/field/factor.h"
#include "normal/field/ideal.h"
#include "normal/field/prepare.h"
#include "normal/field/root-parts.h"
#include "normal/form/form.h"
#include "normal/form/products.h"
#include "normal/form/simple.h"

enum { MOST_TERMS = 2000, MOST_TURNS = 4 };


/* --- candidates for the shortest form ---------------------------------------------- */

struct simplifier {
    qdot_pool *pool;
    qdot_field *f;
    qdot_form form;
    qdot_expr best;
    bool too_long; /* the quotient is too long to try any of its forms */
};

static void
keep_if_shortest(struct simplifier *s, qdot_expr e)
{
    qdot_form_keep(s->pool, &s->best, e);
}

static bool
is_cosine(const qdot_field *f, slong v)
{
    return f->gen[v].kind == QDOT_GEN_COS || f->gen[v].kind == QDOT_GEN_COSH;
}

/* r = from with c^2 = 1 - s^2 in the angle whose cosine is v, or in all (f->n) or none (-1), cancelled;
 * false: that cannot be. */
static bool
cosines_to_sines(qdot_field *f, qdot_ratio *r, const qdot_ratio *from, slong v)
{
    qdot_ratio_set(f, r, from);
    for (slong c = 0; c < f->n && qdot_field_goes(f); c++)
        if (c == v || (v == f->n && is_cosine(f, c))) {
            if (qdot_factor_flip(f, r->n, r->n, c) != QDOT_OK ||
                qdot_factor_flip(f, r->d, r->d, c) != QDOT_OK)
                return false;
        }
    if (!qdot_field_goes(f) || fmpz_mpoly_is_zero(r->d, f->ctx))
        return false;
    qdot_ratio_cancel(f, r);
    return qdot_field_goes(f);
}

/* Try the quotient as a form with c^2 = 1 - s^2 inserted for each angle in its denominator: factors may cancel then. */
static void
try_sine_forms(struct simplifier *s, const qdot_ratio *from)
{
    qdot_field *f = s->f;
    int turns = 0;

    for (slong v = 0; v < f->n && turns < MOST_TURNS && qdot_field_goes(f); v++) {
        qdot_ratio r;

        if (!is_cosine(f, v) ||
            (fmpz_mpoly_degree_si(from->d, v, f->ctx) == 0 &&
             fmpz_mpoly_degree_si(from->d, f->gen[v].pair, f->ctx) == 0))
            continue;
        turns++;
        qdot_ratio_init(f, &r);
        if (cosines_to_sines(f, &r, from, v))
            qdot_form_say_quotient(&s->form, &r, &s->best);
        qdot_ratio_clear(f, &r);
    }
}

/* n/d with d = r^2 d' as (n r/r^2)/(r d'), where n r is r^2 times something: (a r - b)/b, b = r^2, is
 * (a - r)/r. */
static void
try_cancelling_root(struct simplifier *s, const qdot_ratio *from)
{
    qdot_field *f = s->f;
    int turns = 0;

    for (slong v = 0; v < f->n && turns < MOST_TURNS && qdot_field_goes(f); v++) {
        fmpz_mpoly_t root;
        qdot_ratio x, r;

        if (f->gen[v].kind != QDOT_GEN_ROOT || f->gen[v].order != 2 ||
            fmpz_mpoly_degree_si(from->n, v, f->ctx) == 0 ||
            fmpz_mpoly_degree_si(from->d, v, f->ctx) > 0)
            continue;
        turns++;
        fmpz_mpoly_init(root, f->ctx);
        qdot_ratio_init(f, &x);
        fmpz_mpoly_gen(root, v, f->ctx);
        qdot_field_mul(f, x.n, from->n, root);
        fmpz_mpoly_set(x.d, from->d, f->ctx);
        for (slong c = -1; c <= f->n && qdot_field_goes(f); c++) {
            qdot_expr e = QDOT_NIL;

            if (c >= 0 && c < f->n &&
                (!is_cosine(f, c) || fmpz_mpoly_degree_si(x.d, c, f->ctx) < 2))
                continue;
            qdot_ratio_init(f, &r);
            if (cosines_to_sines(f, &r, &x, c) && fmpz_mpoly_total_degree_si(r.d, f->ctx) <
                                          fmpz_mpoly_total_degree_si(x.d, f->ctx)) {
                qdot_form_say_quotient(&s->form, &r, &e);
                keep_if_shortest(s, qdot_div(s->pool, e, f->gen[v].expr));
            }
            qdot_ratio_clear(f, &r);
        }
        qdot_ratio_clear(f, &x);
        fmpz_mpoly_clear(root, f->ctx);
    }
}

static void
try_all_forms(struct simplifier *s, const qdot_ratio *r)
{
    qdot_field *f = s->f;

    if (fmpz_mpoly_length(r->n, f->ctx) + fmpz_mpoly_length(r->d, f->ctx) > MOST_TERMS) {
        s->too_long = true;
        return;
    }
    qdot_form_say_quotient(&s->form, r, &s->best);
    if (!fmpz_mpoly_is_one(r->d, f->ctx))
        try_cancelling_root(s, r);
    if (qdot_form_has_trig(&s->form, r->d)) {
        try_sine_forms(s, r);
        keep_if_shortest(s, qdot_products_tangents(s->pool, s->best));
    }
}

/* --- functions and bases in their original form, where that is shorter ------------- */

struct origins {
    qdot_map map;
};

static qdot_expr
origin(qdot_pool *pool, qdot_expr node, void *user)
{
    const struct origins *o = user;
    uint32_t before;

    if (!qdot_map_get(&o->map, node, &before))
        return QDOT_NIL;
    /* of two equally long forms prefer the sum: sqrt(v^2 - x^2), not sqrt((v - x)*(v + x)) */
    return qdot_expr_size(pool, before) <
                   qdot_expr_size(pool, node) +
                       (qdot_expr_kind(pool, before) == QDOT_SUM &&
                        qdot_expr_kind(pool, node) == QDOT_PROD)
               ? before
               : QDOT_NIL;
}

/* Combine powers x of sums in a product, selected by bits of `with`, to the root from which they were split. */
static qdot_expr
as_one_root(qdot_pool *pool, const qdot_map *map, qdot_expr e, qdot_expr x, uint32_t with)
{
    qdot_expr bases = QDOT_ONE, powers = QDOT_ONE;
    uint32_t before;

    for (uint32_t i = 0; i < 32 && 2 * i + 2 < qdot_expr_count(pool, e); i++)
        if (with >> i & 1) {
            qdot_expr b = qdot_expr_arg(pool, e, 2 * i + 1);

            bases = qdot_mul(pool, bases, b);
            powers = qdot_mul(pool, powers, qdot_pow(pool, b, x));
        }
    if (bases == QDOT_NIL || powers == QDOT_NIL || !qdot_map_get(map, bases, &before))
        return QDOT_NIL;
    return qdot_mul(pool, qdot_div(pool, e, powers), qdot_pow(pool, before, x));
}

/* Rejoin roots of sums that were split: all with the same exponent, or two of them. */
static qdot_expr
rejoin_roots(qdot_pool *pool, const qdot_map *map, qdot_expr e)
{
    uint32_t n = (qdot_expr_count(pool, e) - 1) / 2;

    for (uint32_t i = 0; i < n && i < 32; i++) {
        qdot_expr x = qdot_expr_arg(pool, e, 2 * i + 2), one;
        const fmpq *k = qdot_expr_rational(pool, x);
        uint32_t alike = 0;

        if (k == NULL || fmpz_is_one(fmpq_denref(k)))
            continue;
        for (uint32_t j = i; j < n && j < 32; j++)
            if (qdot_expr_arg(pool, e, 2 * j + 2) == x &&
                qdot_expr_kind(pool, qdot_expr_arg(pool, e, 2 * j + 1)) == QDOT_SUM)
                alike |= UINT32_C(1) << j;
        if ((alike & (alike - 1)) == 0)
            continue;
        one = as_one_root(pool, map, e, x, alike);
        for (uint32_t j = i + 1; j < n && j < 32 && one == QDOT_NIL; j++)
            if (alike >> i & alike >> j & 1)
                one = as_one_root(pool, map, e, x,
                                  UINT32_C(1) << i | UINT32_C(1) << j);
        if (one != QDOT_NIL)
            return one;
    }
    return QDOT_NIL;
}

static qdot_expr
join_roots(qdot_pool *pool, qdot_expr e, void *user)
{
    enum { TIMES = 4 };

    for (int k = 0; k < TIMES && qdot_expr_kind(pool, e) == QDOT_PROD; k++) {
        qdot_expr one = rejoin_roots(pool, user, e);

        if (one == QDOT_NIL || one == e)
            break;
        e = one;
    }
    return e;
}

/* --- simplifying a scalar ---------------------------------------------------------- */

/* Clear a failure that occurred while a form of the expression was tried, except out of memory and Ctrl-C. */
static void
clear_failure(qdot_pool *pool)
{
    if (qdot_grave(qdot_pool_check(pool)) != QDOT_OK)
        qdot_pool_fail(pool);
}

/* Whether e holds the exponential of a number, one `below` 0 too, that no double holds, or nearly so: a
 * common factor of Gaussian pulses exp(-30*(t - k)^2) leaves such ones of k. */
static bool
exceeds_double_range(qdot_pool *pool, qdot_expr e, bool below)
{
    static const double most = 300;
    bool beyond = false;
    qdot_walk walk;

    if (e == QDOT_NIL || qdot_walk_begin(pool, e, &walk) != QDOT_OK)
        return false;
    for (size_t i = 0; i < walk.n && !beyond; i++)
        if (qdot_expr_kind(pool, walk.at[i]) == QDOT_FUN
            && qdot_expr_node(pool, walk.at[i])->op == QDOT_EXP) {
            const fmpq *x = qdot_expr_rational(pool, qdot_expr_arg(pool, walk.at[i], 0));

            beyond = x && (below || fmpq_sgn(x) > 0)
                     && fabs(fmpz_get_d(fmpq_numref(x))) > most * fmpz_get_d(fmpq_denref(x));
        }
    qdot_walk_end(&walk);
    return beyond;
}

struct request {
    const qdot_facts *facts;
    int64_t work; /* budget of operations for one scalar */
    bool spent;   /* whether some budget was used up */
    qdot_map simplified; /* maps an argument of a function or root to its simplest form */
};

/* The shortest form of e; arguments of functions and bases of roots are not changed. */
static qdot_expr
shortest_outer(qdot_pool *pool, qdot_expr e, struct request *request)
{
    const qdot_facts *facts = request->facts;
    size_t nr = facts == NULL ? 0 : facts->n_relations;
    struct origins origins = {{0}};
    struct simplifier s = {.pool = pool};
    qdot_expr *all;
    qdot_field f;

    if (e == QDOT_NIL || qdot_pool_failed(pool) || !qdot_expr_is_scalar(pool, e) ||
        (nr == 0 && qdot_simple_is_done(pool, e)))
        return e;
    all = qdot_malloc((nr + 1) * sizeof *all);
    if (all == NULL)
        return qdot_pool_fail(pool);
    all[0] = qdot_prepare_from(pool, e, &origins.map);
    for (size_t i = 0; i < nr; i++)
        all[1 + i] = qdot_prepare(pool, facts->relations[i]);
    qdot_field_begin(&f, pool, nr + 1, all, request->work);
    s.f = &f;
    if (qdot_field_goes(&f) && qdot_form_begin(&s.form, &f) == QDOT_OK) {
        qdot_ratio r;

        qdot_field_cancelled(&f, &r, all[0]);
        if (qdot_field_goes(&f))
            try_all_forms(&s, &r);
        if (nr > 0 && qdot_field_goes(&f) &&
            qdot_ideal_reduce_ratio(&f, &r, nr, all + 1) == QDOT_OK && qdot_field_goes(&f))
            try_all_forms(&s, &r);
        qdot_ratio_clear(&f, &r);
        qdot_form_end(&s.form);
        s.best = qdot_products_signs(pool, s.best);
        if (s.best != QDOT_NIL && (qdot_expr_node(pool, s.best)->holds & QDOT_HAS_FUN))
            keep_if_shortest(&s, qdot_products_out(pool, s.best));
        if (s.best != QDOT_NIL && (qdot_expr_node(pool, s.best)->holds & QDOT_HAS_FUN))
            keep_if_shortest(&s, qdot_products_numbers(pool, s.best));
        if (s.best != QDOT_NIL && origins.map.n > 0) {
            qdot_expr back = qdot_walk_replace(pool, s.best, QDOT_PROD, join_roots, &origins.map);

            if (back != QDOT_NIL &&
                qdot_expr_size(pool, back) <= qdot_expr_size(pool, s.best))
                s.best = back;
            back = qdot_walk_map(pool, s.best, origin, &origins);
            if (back != QDOT_NIL &&
                qdot_expr_size(pool, back) <= qdot_expr_size(pool, s.best))
                s.best = back;
        }
    }
    if (f.state == QDOT_FIELD_FAILED && qdot_grave(f.status) != QDOT_OK)
        qdot_pool_fail(pool);
    request->spent |= f.state == QDOT_FIELD_OVER || s.too_long;
    qdot_field_end(&f);
    qdot_map_clear(&origins.map);
    qdot_free(all);
    clear_failure(pool);
    if (qdot_pool_failed(pool))
        return QDOT_NIL;
    if ((qdot_expr_node(pool, e)->holds & QDOT_HAS_FUN) && exceeds_double_range(pool, s.best, true)
        && !exceeds_double_range(pool, e, false))
        return e;
    keep_if_shortest(&s, e);
    return s.best;
}

/* Whether a term of a sum contains a power of a sum. */
static bool
has_power_of_sum(const qdot_pool *pool, qdot_expr e)
{
    for (uint32_t i = 1; i < qdot_expr_count(pool, e); i += 2) {
        const qdot_expr term = qdot_expr_arg(pool, e, i);

        for (uint32_t k = 1;
             qdot_expr_kind(pool, term) == QDOT_PROD && k < qdot_expr_count(pool, term); k += 2)
            if (qdot_expr_kind(pool, qdot_expr_arg(pool, term, k)) == QDOT_SUM &&
                qdot_expr_arg(pool, term, k + 1) != QDOT_ONE)
                return true;
    }
    return false;
}

/* Whether e is a sum of at least three terms, which may contain a complete square. */
static bool
has_three_terms(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_kind(pool, e) == QDOT_SUM && qdot_expr_count(pool, e) >= 7;
}

static bool
is_root(const qdot_pool *pool, qdot_expr exponent)
{
    const fmpq *x = qdot_expr_rational(pool, exponent);

    return x != NULL && !fmpz_is_one(fmpq_denref(x));
}

/* The result of shortest_outer for e, looked up if e was simplified before: a root may occur in many terms. */
static qdot_expr
shortest_outer_once(qdot_pool *pool, qdot_expr e, struct request *request)
{
    qdot_expr simplest;
    uint32_t before;

    if (qdot_map_get(&request->simplified, e, &before))
        return before;
    simplest = shortest_outer(pool, e, request);
    if (simplest != QDOT_NIL && qdot_map_set(&request->simplified, e, simplest) != QDOT_OK)
        return qdot_pool_fail(pool);
    return simplest;
}

/* An argument or base in its shortest form. Squares of sums, which show a distance, are given up for half as many
 * operations only. */
static qdot_expr
shorten_argument(qdot_pool *pool, qdot_expr e, struct request *request)
{
    bool squares = qdot_expr_kind(pool, e) == QDOT_SUM && has_power_of_sum(pool, e);
    qdot_expr best;

    if (!has_three_terms(pool, e) && !squares)
        return e;
    best = shortest_outer_once(pool, e, request);
    return has_three_terms(pool, e) || best == QDOT_NIL ||
                   2 * qdot_expr_size(pool, best) <= qdot_expr_size(pool, e)
               ? best
               : e;
}

/* Simplify long arguments of functions and long bases of roots, inner ones first. */
static qdot_expr
shorten_arguments(qdot_pool *pool, qdot_expr e, struct request *request)
{
    qdot_expr result = e;
    qdot_walk w;

    if (e == QDOT_NIL || qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return e;
    for (size_t i = 0; i < w.n && result != QDOT_NIL; i++) {
        qdot_kind kind = qdot_expr_kind(pool, w.at[i]);
        uint32_t n = qdot_expr_count(pool, w.at[i]);
        qdot_expr few[32], *args = n > 32 ? qdot_malloc(n * sizeof *args) : few;
        bool changed = false;

        if (args == NULL)
            break;
        for (uint32_t k = 0; k < n; k++) {
            qdot_expr old = qdot_expr_arg(pool, w.at[i], k);
            bool inside = kind == QDOT_FUN || (kind == QDOT_UFUN && 2 * k < n) ||
                          (kind == QDOT_PROD && k % 2 == 1 &&
                           is_root(pool, qdot_expr_arg(pool, w.at[i], k + 1)));

            args[k] = (qdot_expr)qdot_walk_get(&w, old);
            if (inside)
                args[k] = shorten_argument(pool, args[k], request);
            changed |= args[k] != old;
        }
        result = changed ? qdot_rebuild(pool, w.at[i], args) : w.at[i];
        qdot_walk_set(&w, w.at[i], result);
        if (args != few)
            qdot_free(args);
    }
    qdot_walk_end(&w);
    return result;
}

/* What stands with each product of roots by itself, if these are many: over one denominator with
 * all of them it would be larger by orders. *whole: it is not yet simplified. */
static qdot_expr
simplify_by_roots(qdot_pool *pool, qdot_expr e, struct request *request, bool *whole)
{
    const bool spent = request->spent;
    qdot_root_parts parts = {.n = 1};
    qdot_expr sum = QDOT_ZERO;

    *whole = true;
    if (!qdot_root_parts_many(pool, e))
        return e;
    if (qdot_root_parts_add(pool, &parts, &e) == QDOT_OK) {
        *whole = parts.entries.n < QDOT_ROOTS_MANY;
        request->spent = false;
        for (size_t k = 0; k < parts.entries.n && !request->spent; k++)
            sum = qdot_add(pool, sum,
                           *whole ? parts.entries.at[k]
                                  : shorten_arguments(pool, shortest_outer(pool, parts.entries.at[k], request),
                                                      request));
        if (request->spent) /* stop, because if one part exceeds the budget, similar parts would, too */
            sum = e;
        request->spent |= spent;
        /* the expanded sum counts only if it still has roots or was simplified part by part */
        if (sum != QDOT_NIL && (!*whole || qdot_root_parts_many(pool, sum)))
            qdot_form_keep(pool, &sum, e);
    }
    qdot_root_parts_clear(&parts);
    clear_failure(pool);
    return qdot_pool_failed(pool) ? QDOT_NIL : sum;
}

static qdot_expr
shorten_scalar(qdot_pool *pool, qdot_expr e, void *user)
{
    const qdot_facts *facts = ((const struct request *)user)->facts;
    const bool free = facts == NULL || facts->n_relations == 0;
    qdot_expr best = free ? qdot_simple_seen(pool, e) : QDOT_NIL;
    bool whole = true;

    if (best != QDOT_NIL)
        return best;
    best = free ? simplify_by_roots(pool, e, user, &whole) : e;
    if (whole)
        best = shortest_outer(pool, best, user);
    if (best != QDOT_NIL && qdot_expr_is_scalar(pool, best))
        qdot_form_keep(pool, &best, shorten_arguments(pool, best, user));
    return best;
}

struct simplifying {
    qdot_pool *pool;
    qdot_expr e, result;
    struct request request;
};

static void
simplify_value(void *user)
{
    struct simplifying *x = user;

    x->result = qdot_value_map(x->pool, x->e, shorten_scalar, &x->request);
    qdot_map_clear(&x->request.simplified);
}

qdot_expr
qdot_shortest_within(qdot_pool *pool, qdot_expr e, const qdot_facts *facts, int64_t work,
                     bool *spent)
{
    struct simplifying x = {pool, e, e, {.facts = facts, .work = work}};
    qdot_status status;

    *spent = false;
    if (e == QDOT_NIL || qdot_pool_failed(pool))
        return QDOT_NIL;
    if (qdot_expr_is_scalar(pool, e) && (facts == NULL || facts->n_relations == 0)) {
        qdot_expr seen = qdot_simple_seen(pool, e);

        if (seen != QDOT_NIL)
            return seen;
    }
    status = qdot_flint_run(pool, simplify_value, &x);
    if (qdot_grave(status) != QDOT_OK)
        return qdot_pool_fail(pool);
    *spent = x.request.spent || status != QDOT_OK;
    return status == QDOT_OK ? x.result : e;
}

/* The stored result of a simplification of one expression. */
struct simplified {
    qdot_expr result;
    bool spent;
};

qdot_expr
qdot_shortest(qdot_pool *pool, qdot_expr e, const qdot_facts *facts)
{
    /* the result can be stored unless it depends on relations; conditions do not change it */
    const bool keep = (facts == NULL || facts->n_relations == 0) && !qdot_pool_failed(pool);
    struct simplified s;

    if (!keep || !qdot_memo_find(pool, e, QDOT_MEMO_SHORTEST, &s, sizeof s)) {
        s.result = qdot_shortest_within(pool, e, facts, QDOT_SHORTEST_WORK, &s.spent);
        if (keep && s.result != QDOT_NIL && !qdot_interrupt_is_set())
            qdot_memo_keep(pool, e, QDOT_MEMO_SHORTEST, &s, sizeof s);
    }
    if (s.spent)
        qdot_pool_unfinished(pool);
    return s.result;
}
