/* test_verdicts.c -- random identities, true and false: a verdict is never wrong.
 *
 * QDOT_TEST_PAIRS says how many pairs (2000), QDOT_TEST_SEED where they begin (1), QDOT_TEST_SHOW that
 * what stays undecided be shown (1: of the class; 2: all). What is false is known from values in MPFR (number.h), what is true from how it was built (pairs.h).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>
#include <inttypes.h>

#include "expr/print.h"
#include "normal/prove/decide.h"

#include "normal/number.h"
#include "normal/pairs.h"

enum { POINTS = 10, LARGEST = 400 };

typedef struct {
    int64_t truths, proved, open, open_inside; /* equal by construction */
    int64_t falsehoods, refuted,
        hidden; /* that a value shows to differ; hidden: not refuted */
    int64_t skipped, wrong;
} tally;

static int64_t
setting(const char *name, int64_t otherwise)
{
    const char *text = getenv(name);

    return text == NULL ? otherwise : atol(text);
}

static void
tell(const qdot_pool *pool, const char *what, uint64_t seed, pair p)
{
    qdot_text l = {0}, r = {0};

    if (qdot_print(pool, p.l, QDOT_PLAIN, &l) == QDOT_OK &&
        qdot_print(pool, p.r, QDOT_PLAIN, &r) == QDOT_OK)
        fprintf(stderr, "# %s, pair %" PRIu64 ": check %s == %s\n", what, (uint64_t)seed,
                l.at, r.at);
    qdot_text_clear(&l);
    qdot_text_clear(&r);
}

/* What is known beside a pair: symbols have the values `means`, said as relation or condition. */
typedef struct {
    qdot_facts facts;
    size_t n;
    qdot_expr said[2], symbol[2], means[2];
} knowledge;

/* Whether a value shows them to differ. */
static bool
differ(qdot_pool *pool, pair p, const knowledge *known)
{
    if (known != NULL) {
        p.l = qdot_subs(pool, p.l, known->n, known->symbol, known->means);
        p.r = qdot_subs(pool, p.r, known->n, known->symbol, known->means);
        if (qdot_pool_check(pool) != QDOT_OK)
            return false;
    }
    for (unsigned k = 0; k < POINTS; k++)
        if (number_compare(pool, p.l, p.r, k) > 0)
            return true;
    return false;
}

static void
count_truth(pairs *g, pair p, const knowledge *known, uint64_t seed, tally *n)
{
    qdot_decision d;

    n->truths++;
    assert_int_equal(
        qdot_decide_equal(g->pool, p.l, p.r, known == NULL ? NULL : &known->facts, &d),
        QDOT_OK);
    if (d.verdict == QDOT_PROVED) {
        n->proved++;
    } else if (d.verdict == QDOT_REFUTED) {
        n->wrong++;
        tell(g->pool, differ(g->pool, p, known) ? "not a truth" : "refuted, though true",
             seed, p);
    } else {
        n->open++;
        n->open_inside += g->inside;
        if (setting("QDOT_TEST_SHOW", 0) > !g->inside)
            tell(g->pool, g->inside ? "undecided" : "undecided, no wonder", seed, p);
    }
}

static void
count_falsehood(pairs *g, pair p, const knowledge *known, uint64_t seed, tally *n)
{
    qdot_decision d;
    bool false_for_sure = differ(g->pool, p, known);

    assert_int_equal(
        qdot_decide_equal(g->pool, p.l, p.r, known == NULL ? NULL : &known->facts, &d),
        QDOT_OK);
    if (!false_for_sure) {
        n->skipped++;
        return;
    }
    n->falsehoods++;
    if (d.verdict == QDOT_REFUTED) {
        n->refuted++;
    } else if (d.verdict == QDOT_PROVED) {
        n->wrong++;
        tell(g->pool, "proved, though false", seed, p);
    } else {
        n->hidden++;
        if (setting("QDOT_TEST_SHOW", 0))
            tell(g->pool, "not refuted", seed, p);
    }
}

/* `symbol` has the value `means`. */
static void
let(knowledge *k, qdot_expr symbol, qdot_expr means)
{
    k->symbol[k->n] = symbol;
    k->means[k->n++] = means;
}

static void
condition(pairs *g, knowledge *k, qdot_expr l, qdot_expr r)
{
    k->said[k->facts.n_conditions++] = qdot_rel(g->pool, QDOT_LT, l, r);
}

/* Conditions; what follows from them is put beside p. */
static void
learn_condition(pairs *g, pair *p, knowledge *k)
{
    qdot_pool *pool = g->pool;
    qdot_expr x = g->any[0], y = g->any[1], pick[2] = {x, y};

    switch (pairs_random(g, 4)) {
    case 0: { /* x > 0 */
        qdot_expr size = fun(g, QDOT_ABS, x);

        condition(g, k, QDOT_ZERO, x);
        let(k, x, fun(g, QDOT_EXP, x));
        p->l = qdot_subs(pool, p->l, 1, &x, &size);
        break;
    }
    case 1: /* x < y */
        condition(g, k, x, y);
        let(k, y, add(g, x, fun(g, QDOT_EXP, y)));
        p->l = add(g, p->l, fun(g, QDOT_ABS, sub(g, x, y)));
        p->r = add(g, p->r, sub(g, y, x));
        break;
    case 2: /* x < y */
        condition(g, k, x, y);
        let(k, y, add(g, x, fun(g, QDOT_EXP, y)));
        p->l = add(g, p->l, qdot_fun(pool, QDOT_MAX, 2, pick));
        p->r = add(g, p->r, y);
        break;
    default: /* -1 < x < 1 */
        condition(g, k, QDOT_MINUS_ONE, x);
        condition(g, k, x, QDOT_ONE);
        let(k, x, fun(g, QDOT_TANH, x));
        p->l = add(g, p->l, qdot_sqrt(pool, power(g, sub(g, x, QDOT_ONE), 2)));
        p->r = add(g, p->r, sub(g, QDOT_ONE, x));
    }
}

/* A relation z s = e, or x^2 + y^2 = r^2. False where z is in s or e. */
static bool
learn_relation(pairs *g, pair *p, knowledge *k)
{
    qdot_pool *pool = g->pool;
    qdot_expr x = g->any[0], y = g->any[1], z = g->any[2], r = g->positive[2];

    k->facts.n_relations = 1;
    if (pairs_random(g, 3) == 0) {
        qdot_expr sum = add(g, power(g, x, 2), power(g, y, 2));
        pair q = pairs_make(g, 1);

        k->said[0] = sub(g, sum, power(g, r, 2));
        let(k, x, mul(g, r, fun(g, QDOT_COS, x)));
        let(k, y, mul(g, r, fun(g, QDOT_SIN, x)));
        p->l = add(g, p->l, mul(g, sum, q.l));
        p->r = add(g, p->r, mul(g, q.r, power(g, r, 2)));
    } else {
        pair e = pairs_rational(g, 1), s = pairs_positive(g, 1);
        qdot_expr means = qdot_div(pool, e.l, s.l);

        if (qdot_pool_check(pool) != QDOT_OK || means == QDOT_NIL ||
            qdot_expr_contains(pool, means, z))
            return false;
        let(k, z, means);
        k->said[0] = qdot_sub(pool, qdot_mul(pool, z, s.r), e.r);
        p->r = qdot_subs(pool, p->r, 1, &z, &means);
    }
    return true;
}

/* Something known; p then holds by it. False if there is none. */
static bool
learn(pairs *g, pair *p, knowledge *k)
{
    bool relation = pairs_random(g, 2) == 0;

    *k = (knowledge){0};
    if (relation && !learn_relation(g, p, k))
        return false;
    if (!relation)
        learn_condition(g, p, k);
    k->facts.relations = k->facts.conditions = k->said;
    return true;
}

static void
one_pair(uint64_t seed, bool learned, tally *n)
{
    pairs g;
    pair p;
    knowledge known;

    assert_true(pairs_begin(&g, seed));
    g.inside = true;
    p = pairs_make(&g, 1 + (int)pairs_random(&g, 3));
    if (learned && !learn(&g, &p, &known))
        p.l = QDOT_NIL;
    if (qdot_pool_check(g.pool) != QDOT_OK || p.l == QDOT_NIL || p.r == QDOT_NIL ||
        qdot_expr_size(g.pool, p.l) + qdot_expr_size(g.pool, p.r) > LARGEST) {
        n->skipped++; /* undefined everywhere, or large */
    } else if (pairs_random(&g, 2) == 0) {
        count_truth(&g, p, learned ? &known : NULL, seed, n);
    } else {
        p.r = pairs_near(&g, p.r);
        if (qdot_pool_check(g.pool) != QDOT_OK || p.r == QDOT_NIL)
            n->skipped++;
        else
            count_falsehood(&g, p, learned ? &known : NULL, seed, n);
    }
    qdot_pool_free(g.pool);
}

static void
many_pairs(bool learned)
{
    int64_t wanted = setting("QDOT_TEST_PAIRS", 2000), from = setting("QDOT_TEST_SEED", 1);
    tally n = {0};

    if (learned)
        wanted /= 4;
    for (int64_t i = 0; i < wanted; i++)
        one_pair((uint64_t)(from + i), learned, &n);
    fprintf(stderr,
            "# %" PRId64 " pairs%s: %" PRId64 " true, proved %" PRId64 ", undecided %" PRId64 " (%" PRId64 " of the class); %" PRId64 " "
            "false, refuted %" PRId64 ", undecided %" PRId64 "; %" PRId64 " left out; %" PRId64 " wrong\n",
            wanted, learned ? " with facts" : "", n.truths, n.proved, n.open,
            n.open_inside, n.falsehoods, n.refuted, n.hidden, n.skipped, n.wrong);
    assert_int_equal(n.wrong, 0);
    /* a test that finds nothing to decide is none */
    assert_true(n.proved > wanted / 5 && n.refuted > wanted / 10);
    assert_true(n.open_inside <= n.truths / (learned ? 30 : 100));
}

static void
no_verdict_is_wrong(void **state)
{
    (void)state;
    many_pairs(false);
}

static void
no_verdict_under_facts_is_wrong(void **state)
{
    (void)state;
    many_pairs(true);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_verdict_is_wrong),
                                       cmocka_unit_test(no_verdict_under_facts_is_wrong)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
