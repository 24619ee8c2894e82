/* decide.c -- equality: a quick look at points, a proof, a long look at points, a harder
 * proof. */
#include "normal/prove/decide.h"

#include <math.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/polynomial/flint.h"
#include "expr/walk.h"
#include "normal/prove/cases.h"
#include "normal/prove/equal.h"
#include "normal/prove/nth-part.h"
#include "normal/prove/prove.h"
#include "normal/prove/unify.h"
#include "normal/refute/sample.h"

#define LARGE 2000 /* in nodes: larger expressions are compared at fewer points */
#define SMALL 400  /* in nodes: smaller expressions are compared at edges of domains, too */
#define MOST_EDGES 160

/* --- looking for a counterexample -------------------------------------------------- */

struct look {
    int points;    /* number of points at which both sides are compared */
    int tries;     /* largest number of points tried, as some are outside domains */
    slong prec[4]; /* precisions in bits, ascending; ended by 0 */
    bool edges;    /* take points at edges of domains: qdot_sample_edge */
};

static const struct look quick = {2, 24, {96, 0}, false};
static const struct look closer = {2, 24, {512, 0}, false};
static const struct look thorough = {16, 240, {128, 512, 2048, 0}, false};
/* under conditions, which may hold only in a small region: look longer */
static const struct look patient = {60, 720, {128, 0}, false};
/* the effort for special values of one symbol */
static const struct look edges = {MOST_EDGES, MOST_EDGES, {128, 512, 0}, true};

static double
to_double(arb_srcptr x)
{
    return arf_get_d(arb_midref(x), ARF_RND_NEAR);
}

/* The number of digits to which both sides of an equation agree; the ball of the difference contains 0. */
static int
count_equal_digits(const arb_t difference, arb_srcptr left)
{
    double radius = mag_get_d_log2_approx(arb_radref(difference));
    slong size = arf_abs_bound_lt_2exp_si(arb_midref(left)); /* exponent: |left| < 2^size */

    if (mag_is_zero(arb_radref(difference)))
        return 9999;
    radius -= size > 0 ? (double)size : 0;
    return radius > 0 ? 0 : (int)fmin(-radius * 0.30103, 9999);
}

/* Both sides of an equation, compared at points where all members of `defined` (a LIST) have values. */
struct sides {
    qdot_expr left, right, defined;
};

static bool
all_are_defined(const qdot_sample *s, qdot_expr list)
{
    for (uint32_t i = 0; i < qdot_expr_count(s->pool, list); i++)
        if (qdot_ball_get(&s->ball, qdot_expr_arg(s->pool, list, i)) == NULL)
            return false;
    return true;
}

/* Compare the sides of an equation at one point. 1: they differ; 0: they agree so far; -1: no point was found. */
static int
compare_at_point(qdot_sample *s, const struct sides *sides, const struct look *look,
                 qdot_decision *d, int *digits)
{
    int result = -1;
    arb_t difference;

    arb_init(difference);
    for (int i = 0; i < 4 && look->prec[i] > 0; i++) {
        bool here = qdot_sample_eval(s, look->prec[i]);
        arb_srcptr l = qdot_ball_get(&s->ball, sides->left);
        arb_srcptr r = qdot_ball_get(&s->ball, sides->right);

        if (!here || l == NULL || r == NULL || !all_are_defined(s, sides->defined)) {
            if (i > 0)
                break;
            continue;
        }
        arb_sub(difference, l, r, look->prec[i]);
        result = 0;
        if (!arb_contains_zero(difference)) {
            result = 1;
            d->left = to_double(l);
            d->right = to_double(r);
            break;
        }
        *digits = count_equal_digits(difference, l);
        if (arb_is_zero(difference))
            break;
    }
    arb_clear(difference);
    return result;
}

/* The values at a point of the symbols in both sides of an equation, and of symbols related to these by assumptions. */
static qdot_expr
relevant_values(qdot_pool *pool, qdot_expr point, const qdot_expr *sides,
                const qdot_facts *facts)
{
    uint32_t n = point == QDOT_NIL ? 0 : qdot_expr_count(pool, point), kept = 0;
    size_t assumed = facts == NULL ? 0 : facts->n_relations + facts->n_conditions;
    bool *in = qdot_calloc(n + 1, sizeof *in), more = true;
    qdot_expr *rows = qdot_calloc(n + 1, sizeof *rows);

    for (uint32_t i = 0; in != NULL && i < n; i++)
        for (int k = 0; k < 3; k++)
            in[i] |=
                sides[k] != QDOT_NIL &&
                qdot_expr_contains(pool, sides[k],
                                   qdot_expr_arg(pool, qdot_expr_arg(pool, point, i), 0));
    while (in != NULL && more) {
        more = false;
        for (size_t r = 0; r < assumed; r++) {
            qdot_expr e = r < facts->n_relations
                              ? facts->relations[r]
                              : facts->conditions[r - facts->n_relations];
            bool tied = false;

            for (uint32_t i = 0; i < n; i++)
                tied |=
                    in[i] &&
                    qdot_expr_contains(
                        pool, e, qdot_expr_arg(pool, qdot_expr_arg(pool, point, i), 0));
            for (uint32_t i = 0; i < n && tied; i++)
                if (!in[i] &&
                    qdot_expr_contains(
                        pool, e, qdot_expr_arg(pool, qdot_expr_arg(pool, point, i), 0)))
                    in[i] = more = true;
        }
    }
    for (uint32_t i = 0; in != NULL && rows != NULL && i < n; i++)
        if (in[i])
            rows[kept++] = qdot_expr_arg(pool, point, i);
    point =
        in == NULL || rows == NULL ? qdot_pool_fail(pool) : qdot_list(pool, kept, rows);
    qdot_free(in);
    qdot_free(rows);
    return point;
}

static qdot_status
compare_sides(qdot_pool *pool, const struct sides *sides, const qdot_facts *facts,
              const struct look *look, qdot_decision *d)
{
    qdot_expr e[3] = {sides->left, sides->right, sides->defined};
    int wanted = look->points;
    qdot_sample s;

    QDOT_TRY(qdot_sample_begin(&s, pool, 3, e, facts));
    if (s.ball.walk.n > LARGE && wanted > 3)
        wanted = 3;
    for (int k = 0; s.possible && k < look->tries && d->points < wanted; k++) {
        int digits = 0, here;

        if (qdot_interrupt_is_set()) {
            qdot_sample_end(&s);
            return qdot_interrupt_check();
        }
        if ((k > 24 && d->points == 0 && s.ball.walk.n > LARGE) ||
            (look->edges && s.ball.walk.n > SMALL))
            break;
        if (!look->edges)
            qdot_sample_point(&s, k);
        else if (!qdot_sample_edge(&s, k))
            break;
        here = compare_at_point(&s, sides, look, d, &digits);
        if (here == 0) {
            d->points++;
            if (digits < d->digits || d->points == 1)
                d->digits = digits;
        } else if (here == 1) {
            d->verdict = QDOT_REFUTED;
            d->at = relevant_values(pool, qdot_sample_list(&s), e, facts);
            break;
        }
    }
    qdot_sample_end(&s);
    return qdot_pool_failed(pool) ? qdot_pool_check(pool) : QDOT_OK;
}

static qdot_status
compare_at_points(qdot_pool *pool, qdot_expr left, qdot_expr right, const qdot_facts *facts,
                  const struct look *look, qdot_decision *d)
{
    struct sides sides = {left, right,
                          facts != NULL && facts->defined != QDOT_NIL
                              ? facts->defined
                              : qdot_list(pool, 0, NULL)};

    return compare_sides(pool, &sides, facts, look, d);
}

/* The arguments of undefined functions in e, as a LIST; nil on failure. */
static qdot_expr
arguments(qdot_pool *pool, qdot_expr e)
{
    qdot_expr atoms = qdot_expr_atoms(pool, e, true), list = QDOT_NIL;
    qdot_status status = QDOT_OK;
    qdot_vec(qdot_expr) all = {0};

    for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(pool, atoms); i++) {
        qdot_expr f = qdot_expr_arg(pool, atoms, i);

        if (qdot_expr_kind(pool, f) != QDOT_UFUN)
            continue;
        for (uint32_t k = 0; 2 * k < qdot_expr_count(pool, f) && status == QDOT_OK; k++)
            status = qdot_vec_push(&all, qdot_expr_arg(pool, f, k));
    }
    if (atoms != QDOT_NIL && status == QDOT_OK)
        list = qdot_list(pool, (uint32_t)all.n, all.at);
    qdot_free(all.at);
    return status == QDOT_OK ? list : qdot_pool_fail(pool);
}

/* --- deciding an equation ---------------------------------------------------------- */

static qdot_status
require_scalars(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    if (a == QDOT_NIL || b == QDOT_NIL)
        return qdot_pool_failed(pool) ? qdot_pool_check(pool)
                                      : qdot_fail(QDOT_EINVAL, "nothing to compare");
    if (!qdot_expr_is_scalar(pool, a) || !qdot_expr_is_scalar(pool, b))
        return qdot_fail(QDOT_ETYPE,
                         "numbers are compared here, not vectors or equations");
    return QDOT_OK;
}

/* The concatenation of two LISTs. */
static qdot_expr
join_lists(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    uint32_t m = qdot_expr_count(pool, a), n = qdot_expr_count(pool, b);
    qdot_expr *all = qdot_malloc((m + n + 1) * sizeof *all), list;

    if (all == NULL)
        return qdot_pool_fail(pool);
    for (uint32_t i = 0; i < m + n; i++)
        all[i] = i < m ? qdot_expr_arg(pool, a, i) : qdot_expr_arg(pool, b, i - m);
    list = qdot_list(pool, m + n, all);
    qdot_free(all);
    return list;
}

/* Once more, with undefined functions of equal arguments made one: at a point where two
 * of them have arguments that cannot be told apart nothing is known. */
static qdot_status
compare_with_unified_functions(qdot_pool *pool, qdot_expr left, qdot_expr right, const qdot_facts *facts,
                               qdot_decision *d)
{
    static const qdot_unify_way way = {qdot_prove_harder, qdot_prove_cases, true};
    /* unify only inside the arguments of undefined functions */
    qdot_expr e[3] = {left, right, QDOT_NIL}, both[2];
    bool any = false, changed = true;
    struct sides sides;

    e[2] = arguments(pool, qdot_list(pool, 2, e));
    if (e[2] == QDOT_NIL)
        return qdot_pool_failed(pool) ? qdot_pool_check(pool) : QDOT_OK;
    for (int round = 0; round < 3 && changed; round++) { /* repeat, because functions may be nested */
        QDOT_TRY(qdot_unify(pool, 3, e, facts, &way, &changed));
        any |= changed;
    }
    if (!any)
        return QDOT_OK;
    both[0] = e[2];
    both[1] = facts == NULL ? QDOT_NIL : facts->defined;
    if (both[1] != QDOT_NIL)
        e[2] = join_lists(pool, both[0], both[1]);
    sides = (struct sides){e[0], e[1], e[2]};
    return compare_sides(pool, &sides, facts, &thorough, d);
}

/* Prove an equation with the relations between multiples of inverse functions; do nothing if there are none. */
static qdot_status
prove_by_inverse_parts(qdot_pool *pool, qdot_expr left, qdot_expr right, const qdot_facts *facts,
                       bool *equal)
{
    qdot_facts more = facts == NULL ? (qdot_facts){0} : *facts;
    qdot_expr e[2] = {left, right};
    qdot_nth_parts all = {0};
    qdot_status status = qdot_nth_part_relations(pool, 2, e, &all);
    size_t found = all.n;

    for (size_t i = 0; i < more.n_relations && status == QDOT_OK && found > 0; i++)
        status = qdot_vec_push(&all, more.relations[i]);
    more.n_relations = all.n;
    more.relations = all.at;
    if (status == QDOT_OK && found > 0)
        status = qdot_prove_equal(pool, left, right, &more, equal);
    qdot_free(all.at);
    return status;
}

static qdot_status
decide_equal(qdot_pool *pool, qdot_expr left, qdot_expr right, const qdot_facts *facts,
             qdot_decision *d)
{
    bool equal;

    *d = (qdot_decision){.verdict = QDOT_UNDECIDED};
    QDOT_TRY(require_scalars(pool, left, right));
    if (left == right) {
        d->verdict = QDOT_PROVED;
        return QDOT_OK;
    }
    QDOT_TRY(compare_at_points(pool, left, right, facts, &quick, d));
    if (d->verdict == QDOT_REFUTED)
        return QDOT_OK;
    QDOT_TRY(qdot_prove_equal(pool, left, right, facts, &equal));
    d->points = 0;
    if (!equal)
        QDOT_TRY(compare_at_points(pool, left, right, facts, &thorough, d));
    if (!equal && d->verdict == QDOT_UNDECIDED)
        QDOT_TRY(qdot_prove_harder(pool, left, right, facts, &equal));
    if (!equal && d->verdict == QDOT_UNDECIDED)
        QDOT_TRY(qdot_prove_defined(pool, left, right, facts, &equal, NULL));
    if (!equal && d->verdict == QDOT_UNDECIDED)
        QDOT_TRY(prove_by_inverse_parts(pool, left, right, facts, &equal));
    if (!equal && d->verdict == QDOT_UNDECIDED)
        QDOT_TRY(qdot_prove_cases(pool, left, right, facts, &equal));
    if (!equal && d->verdict == QDOT_UNDECIDED && d->points > 0 && facts != NULL &&
        facts->n_conditions > 0) {
        qdot_decision more = {.verdict = QDOT_UNDECIDED};

        QDOT_TRY(compare_at_points(pool, left, right, facts, &patient, &more));
        if (more.verdict == QDOT_REFUTED)
            *d = more;
    }
    if (d->verdict == QDOT_UNDECIDED) {
        qdot_decision more = {.verdict = QDOT_UNDECIDED};

        QDOT_TRY(compare_at_points(pool, left, right, facts, &edges, &more));
        if (more.verdict == QDOT_REFUTED) { /* a counterexample overrides a proof, which does not hold where a divisor is 0 */
            *d = more;
            equal = false;
        }
    }
    if (equal)
        *d = (qdot_decision){.verdict = QDOT_PROVED};
    else if (d->points == 0 && d->verdict == QDOT_UNDECIDED)
        QDOT_TRY(compare_with_unified_functions(pool, left, right, facts, d));
    if (d->verdict == QDOT_REFUTED)
        d->points = d->digits = 0;
    return QDOT_OK;
}

struct equality {
    qdot_pool *pool;
    qdot_expr left, right;
    const qdot_facts *facts;
    qdot_decision d;
    bool zero;
    qdot_status status;
};

static void
decide_equality_task(void *user)
{
    struct equality *x = user;

    x->status = decide_equal(x->pool, x->left, x->right, x->facts, &x->d);
}

qdot_status
qdot_decide_equal(qdot_pool *pool, qdot_expr left, qdot_expr right,
                  const qdot_facts *facts, qdot_decision *d)
{
    struct equality x = {pool, left, right, facts, {.verdict = QDOT_UNDECIDED}, 0, 0};
    qdot_status status = qdot_flint_run(pool, decide_equality_task, &x);

    *d = status == QDOT_OK ? x.d : (qdot_decision){.verdict = QDOT_UNDECIDED};
    return status == QDOT_ELIMIT ? QDOT_OK : status != QDOT_OK ? status : x.status;
}

/* Whether x->left is proved to be zero. */
static void
decide_zero_task(void *user)
{
    struct equality *x = user;
    qdot_pool *pool = x->pool;
    qdot_expr e = x->left;
    const qdot_facts *facts = x->facts;
    qdot_decision d = {.verdict = QDOT_UNDECIDED};
    bool zero = false;
    qdot_status status;

    status = compare_at_points(pool, e, QDOT_ZERO, facts, &quick, &d);
    if (status == QDOT_OK && d.verdict != QDOT_REFUTED)
        status = qdot_prove_equal(pool, e, QDOT_ZERO, facts, &zero);
    if (status == QDOT_OK && d.verdict != QDOT_REFUTED && !zero && d.points > 0) {
        d.points = 0;
        status = compare_at_points(pool, e, QDOT_ZERO, facts, &closer, &d);
        if (status == QDOT_OK && d.verdict != QDOT_REFUTED)
            status = qdot_prove_harder(pool, e, QDOT_ZERO, facts, &zero);
    }
    x->zero = zero;
    x->status = status;
}

bool
qdot_is_zero(qdot_pool *pool, qdot_expr e, const qdot_facts *facts)
{
    struct equality x = {pool, e, QDOT_ZERO, facts, {.verdict = QDOT_UNDECIDED}, 0, 0};
    qdot_status status;

    if (e == QDOT_ZERO)
        return true;
    if (e == QDOT_NIL || qdot_pool_failed(pool) || !qdot_expr_is_scalar(pool, e))
        return false;
    if (qdot_expr_kind(pool, e) == QDOT_NUM || qdot_expr_kind(pool, e) == QDOT_SYM)
        if (facts == NULL || facts->n_relations == 0)
            return false;
    status = qdot_flint_run(pool, decide_zero_task, &x);
    if (status == QDOT_ELIMIT)
        return false;
    if (status != QDOT_OK || x.status != QDOT_OK)
        qdot_pool_fail(pool);
    return status == QDOT_OK && x.status == QDOT_OK && x.zero;
}
