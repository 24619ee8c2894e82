/* test_formula.c -- trees of formulas: lists of children, sharing, passing through, failure. */
#include "kit.h"

#include "base/interrupt.h"
#include "formula/walk.h"
#include "formula/write.h"

static void
reads(qdot_formula_id id, const char *expected)
{
    qdot_text out = {0};

    assert_int_equal(qdot_formula_status(&f), QDOT_OK);
    assert_int_equal(qdot_formula_write_line(&f, id, QDOT_NOTATION_LINE, &out), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), expected);
    qdot_text_clear(&out);
}

static void
children_stand_in_the_order_they_were_appended(void **state)
{
    const qdot_formula_id row = qdot_formula_new(&f, QDOT_FORMULA_ROW, 0, 0);

    (void)state;
    reads(row, "");
    for (char c = 'a'; c <= 'e'; c++)
        qdot_formula_add_text(&f, row, QDOT_TEXT_NAME, &c, 1);
    reads(row, "abcde");
}

/* An empty node that is filled later stands where it was put. */
static void
a_place_is_filled_later(void **state)
{
    qdot_formula_id hole, row;

    (void)state;
    row = SPAN(NAME("a"), hole = SPAN(END), NAME("c"));
    reads(row, "ac");
    qdot_formula_append(&f, hole, NAME("b"));
    reads(row, "abc");
}

static void
two_nodes_share_their_children(void **state)
{
    const qdot_formula_id sum = ROUND(NAME("a"), sign(QDOT_SIGN_PLUS), NAME("b")), place = SPAN(END);
    const qdot_formula_id row = SPAN(sum, sign(QDOT_SIGN_TIMES), place, NAME("c"));
    const size_t nodes = f.nodes.n;

    (void)state;
    qdot_formula_share(&f, place, sum);
    assert_int_equal(f.nodes.n, nodes);
    reads(row, "(a + b)\u202F(a + b)c");
}

static void
a_span_of_one_becomes_that(void **state)
{
    const qdot_formula_id one = SPAN(NAME("a")), two = SPAN(NAME("a"), NAME("b")), none = SPAN(END);
    const qdot_formula_id hole = SPAN(END), later = SPAN(hole), row = SPAN(one, two, none, later);

    (void)state;
    qdot_formula_unwrap(&f, one);
    qdot_formula_unwrap(&f, later);
    qdot_formula_append(&f, hole, NAME("c"));
    qdot_formula_unwrap(&f, two);
    qdot_formula_unwrap(&f, none);
    assert_int_equal(qdot_formula_at(&f, one)->kind, QDOT_FORMULA_TEXT);
    assert_int_equal(qdot_formula_at(&f, two)->kind, QDOT_FORMULA_SPAN);
    reads(row, "aabc");
}

/* --- passing through -------------------------------------------------------------------------- */

static qdot_status
seen_enter(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    qdot_text_format(walk->user, "%d", node->kind);
    return QDOT_OK;
}

static qdot_status
seen_between(qdot_formula_walk *walk, const qdot_formula_node *node, uint32_t k)
{
    (void)node;
    qdot_text_format(walk->user, "<%u ", k);
    return QDOT_OK;
}

static qdot_status
seen_leave(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    (void)node;
    qdot_text_add(walk->user, ">");
    return walk->open.n > 5 ? qdot_fail(QDOT_ELIMIT, "too deep") : QDOT_OK;
}

static void
each_node_is_entered_and_left_once(void **state)
{
    const qdot_formula_id all = OVER(ROW(NAME("a"), sign(QDOT_SIGN_PLUS)), ROOT(END));
    qdot_text seen = {0};
    qdot_formula_walk walk = {
        .formula = &f, .user = &seen, .enter = seen_enter, .between = seen_between, .leave = seen_leave};
    char expected[64];

    (void)state;
    snprintf(expected, sizeof expected, "%d%d%d<1 %d><1 %d>>", QDOT_FORMULA_FRACTION, QDOT_FORMULA_ROW,
             QDOT_FORMULA_TEXT, QDOT_FORMULA_SIGN, QDOT_FORMULA_ROOT);
    assert_int_equal(qdot_formula_pass(&walk, all), QDOT_OK);
    assert_string_equal(qdot_text_str(&seen), expected);
    qdot_text_clear(&seen);
}

/* No recursion: a million brackets, and the status of a function ends the walk. */
static void
depth_is_no_limit(void **state)
{
    enum { DEPTH = 1000000 };
    qdot_formula_id id = NAME("x");
    qdot_text out = {0};
    qdot_formula_walk walk = {.formula = &f, .user = &out, .enter = seen_enter, .leave = seen_leave};

    (void)state;
    for (int i = 0; i < DEPTH; i++)
        id = ROUND(id);
    assert_int_equal(qdot_formula_write_line(&f, id, QDOT_NOTATION_LINE, &out), QDOT_OK);
    assert_int_equal(out.n, 2 * DEPTH + 1);
    qdot_text_truncate(&out, 0);
    assert_int_equal(qdot_formula_pass(&walk, id), QDOT_ELIMIT);
    qdot_text_clear(&out);
}

static void
a_walk_can_be_interrupted(void **state)
{
    qdot_formula_id id = NAME("x");
    qdot_text out = {0};

    (void)state;
    for (int i = 0; i < 1000; i++)
        id = ROUND(id);
    qdot_interrupt_set_at(3);
    assert_int_equal(qdot_formula_write_line(&f, id, QDOT_NOTATION_LINE, &out), QDOT_EINTR);
    qdot_interrupt_set_at(-1);
    qdot_interrupt_clear();
    qdot_text_clear(&out);
}

/* --- failure ---------------------------------------------------------------------------------- */

static void
nil_absorbs(void **state)
{
    qdot_text out = {0};

    (void)state;
    qdot_formula_append(&f, 0, 0);
    qdot_formula_count(&f, 0, 3);
    qdot_formula_share(&f, 0, 0);
    qdot_formula_unwrap(&f, 0);
    assert_int_equal(qdot_formula_write_line(&f, 0, QDOT_NOTATION_LINE, &out), QDOT_OK);
    assert_int_equal(out.n, 0);
    assert_int_equal(qdot_formula_status(&f), QDOT_OK);
}

/* Memory that runs out anywhere is told at the end, and no node is half there. */
static void
memory_that_runs_out_is_told(void **state)
{
    qdot_status status = QDOT_ENOMEM;
    int64_t n;

    (void)state;
    for (n = 0; status != QDOT_OK; n++) {
        qdot_formula_id row;

        qdot_formula_clear(&f);
        qdot_memory_fail_at(n);
        row = qdot_formula_new(&f, QDOT_FORMULA_ROW, 0, 0);
        for (int i = 0; i < 100; i++)
            qdot_formula_add_text(&f, row, QDOT_TEXT_NAME, "theta", 5);
        status = qdot_formula_status(&f);
        qdot_memory_fail_at(-1);
        assert_true(status == QDOT_OK || status == QDOT_ENOMEM);
    }
    assert_true(n > 4);
}

static void
an_empty_formula_is_filled_anew(void **state)
{
    (void)state;
    reads(NAME("a"), "a");
    qdot_formula_empty(&f);
    assert_int_equal(f.nodes.n, 0);
    reads(SPAN(NAME("b"), NAME("c")), "bc");
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(children_stand_in_the_order_they_were_appended),
        TEST(a_place_is_filled_later),
        TEST(two_nodes_share_their_children),
        TEST(a_span_of_one_becomes_that),
        TEST(each_node_is_entered_and_left_once),
        TEST(depth_is_no_limit),
        TEST(a_walk_can_be_interrupted),
        TEST(nil_absorbs),
        TEST(memory_that_runs_out_is_told),
        TEST(an_empty_formula_is_filled_anew),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
