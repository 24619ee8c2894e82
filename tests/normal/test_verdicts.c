/* test_verdicts.c -- random identities, true and false: a verdict is never wrong.
 *
 * QDOT_TEST_PAIRS says how many pairs (2000), QDOT_TEST_SEED where they begin (1). What is false
 * is known from values in MPFR (number.h), what is true from how it was built (pairs.h).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "expr/print.h"
#include "normal/decide.h"

#include "number.h"
#include "pairs.h"

enum { POINTS = 6, LARGEST = 400 };

typedef struct {
    long truths, proved, open, open_inside; /* equal by construction */
    long falsehoods, refuted, hidden; /* that a value shows to differ; hidden: not refuted */
    long skipped, wrong;
} tally;

static long
setting(const char *name, long otherwise)
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
        fprintf(stderr, "# %s, pair %lu: check %s == %s\n", what, (unsigned long)seed, l.at,
                r.at);
    qdot_text_clear(&l);
    qdot_text_clear(&r);
}

/* Whether a value shows them to differ; *seen: how many points there were. */
static bool
differ(const qdot_pool *pool, pair p, int *seen)
{
    *seen = 0;
    for (unsigned k = 0; k < POINTS; k++) {
        int here = number_compare(pool, p.l, p.r, k);

        if (here > 0)
            return true;
        *seen += here == 0;
    }
    return false;
}

static void
count_truth(pairs *g, pair p, uint64_t seed, tally *n)
{
    qdot_decision d;
    int seen;

    n->truths++;
    assert_int_equal(qdot_decide_equal(g->pool, p.l, p.r, NULL, &d), QDOT_OK);
    if (d.verdict == QDOT_PROVED) {
        n->proved++;
    } else if (d.verdict == QDOT_REFUTED) {
        n->wrong++;
        tell(g->pool, differ(g->pool, p, &seen) ? "not a truth" : "refuted, though true",
             seed, p);
    } else {
        n->open++;
        n->open_inside += g->inside;
        if (g->inside && setting("QDOT_TEST_SHOW", 0))
            tell(g->pool, "undecided", seed, p);
    }
}

static void
count_falsehood(pairs *g, pair p, uint64_t seed, tally *n)
{
    qdot_decision d;
    int seen;
    bool false_for_sure = differ(g->pool, p, &seen);

    assert_int_equal(qdot_decide_equal(g->pool, p.l, p.r, NULL, &d), QDOT_OK);
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

static void
one_pair(uint64_t seed, tally *n)
{
    pairs g;
    pair p;
    qdot_expr wrong;

    assert_true(pairs_begin(&g, seed));
    g.inside = true;
    p = pairs_make(&g, 1 + (int)pairs_random(&g, 3));
    if (qdot_pool_check(g.pool) != QDOT_OK || p.l == QDOT_NIL || p.r == QDOT_NIL ||
        qdot_expr_size(g.pool, p.l) + qdot_expr_size(g.pool, p.r) > LARGEST) {
        n->skipped++; /* undefined everywhere, or large */
    } else if (pairs_random(&g, 2) == 0) {
        count_truth(&g, p, seed, n);
    } else {
        wrong = pairs_near(&g, p.r);
        if (qdot_pool_check(g.pool) != QDOT_OK || wrong == QDOT_NIL)
            n->skipped++;
        else
            count_falsehood(&g, (pair){p.l, wrong}, seed, n);
    }
    qdot_pool_free(g.pool);
}

static void
no_verdict_is_wrong(void **state)
{
    long wanted = setting("QDOT_TEST_PAIRS", 2000), from = setting("QDOT_TEST_SEED", 1);
    tally n = {0};

    (void)state;
    for (long i = 0; i < wanted; i++)
        one_pair((uint64_t)(from + i), &n);
    fprintf(stderr,
            "# %ld pairs: %ld true, proved %ld, undecided %ld (%ld of the class); %ld "
            "false, refuted %ld, undecided %ld; %ld left out; %ld wrong\n",
            wanted, n.truths, n.proved, n.open, n.open_inside, n.falsehoods, n.refuted,
            n.hidden, n.skipped, n.wrong);
    assert_int_equal(n.wrong, 0);
    /* a test that finds nothing to decide is none */
    assert_true(n.proved > wanted / 4 && n.refuted > wanted / 10);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_verdict_is_wrong)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
