/* Switches: which functions choose by the sign of one u, what they are on its sides, and which sides have u = 0. */
#include <setjmp.h>

#include "normal/kit.h"

#include <cmocka.h>

#include "normal/solve/conditions.h"
#include "normal/solve/sides.h"

/* The sides of the first choice in e, `relations e there`, `; ` between them; `0 e there` for a jump. */
static const char *
sides_of(qdot_expr e)
{
    static qdot_text all;
    qdot_sides sides;

    qdot_text_clear(&all);
    assert_int_equal(qdot_sides_of(pool, e, qdot_sides_choice(pool, e, QDOT_NIL), &sides), QDOT_OK);
    for (size_t i = 0; i < sides.n; i++) {
        qdot_text_add(&all, i == 0 ? "" : "; ");
        qdot_text_add(&all, shown(sides.relations[i]));
        qdot_text_add(&all, " ");
        qdot_text_add(&all, shown(qdot_sides_put(&sides, i, e)));
    }
    if (sides.jump != QDOT_NIL) {
        qdot_text_add(&all, "; 0 ");
        qdot_text_add(&all, shown(qdot_sides_put(&sides, sides.n, e)));
    }
    qdot_sides_clear(&sides);
    return qdot_text_str(&all);
}

static void
sides_are(qdot_expr e, const char *sides)
{
    const char *seen = sides_of(e);

    if (strcmp(seen, sides) != 0)
        fail_msg("%s, not %s", seen, sides);
}

static void
all_functions_of_one_switch_are_put(void **state)
{
    (void)state;
    sides_are(text_read(pool, "max(x - y, 0) + 3*max(y - x, 0)"), "[x - y >= 0] x - y; [x - y <= 0] 3*(y - x)");
    sides_are(text_read(pool, "abs(2*x) + sign(-x)"), "[x > 0] 2*x - 1; [x < 0] 1 - 2*x; 0 0");
    sides_are(text_read(pool, "min(x, y) + abs(m*x - m*y)"), "[x <= y] x - m*x + m*y; [y <= x] m*x + y - m*y");
    sides_are(text_read(pool, "1/abs(x) + x"), "[x > 0] x + 1/x; [x < 0] x - 1/x");
    sides_are(text_read(pool, "max(x, y, 1)"), "[y <= x, x >= 1] x; [x <= y, y >= 1] y; [x <= 1, y <= 1] 1");
    sides_are(text_read(pool, "max(abs(x), y)"), "[x >= 0] max(x, y); [x <= 0] max(-x, y)");
}

/* if(0 < u, 1, 2) or if(0 <= u, 1, 2). */
static qdot_expr
step(const char *u, qdot_rel_op op)
{
    qdot_expr part[] = {qdot_rel(pool, op, QDOT_ZERO, text_read(pool, u)), QDOT_ONE, qdot_expr_int(pool, 2)};

    return qdot_fun(pool, QDOT_IF, 3, part);
}

static void
an_end_belongs_to_the_sides_that_agree_there(void **state)
{
    qdot_expr part[] = {QDOT_ZERO, QDOT_ONE, QDOT_MINUS_ONE};
    qdot_sides sides;

    (void)state;
    sides_are(step("x", QDOT_LT), "[x > 0] 1; [x <= 0] 2");
    sides_are(step("x", QDOT_LE), "[x >= 0] 1; [x < 0] 2");
    sides_are(qdot_add(pool, step("x", QDOT_LT), text_read(pool, "max(x, 0)")), "[x > 0] x + 1; [x <= 0] 2");
    sides_are(qdot_add(pool, step("x", QDOT_LT), step("-x", QDOT_LT)), "[x > 0] 3; [x < 0] 3; 0 4");
    sides_are(qdot_add(pool, step("x", QDOT_LT), step("x", QDOT_LE)), "[x > 0] 2; [x < 0] 4; 0 3");
    part[0] = qdot_rel(pool, QDOT_EQ, text_read(pool, "x"), QDOT_ONE);
    part[0] = qdot_fun(pool, QDOT_IF, 3, part);
    assert_int_equal(qdot_sides_of(pool, part[0], part[0], &sides), QDOT_OK);
    assert_int_equal(sides.n, 0);
    qdot_sides_clear(&sides);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(all_functions_of_one_switch_are_put, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(an_end_belongs_to_the_sides_that_agree_there, open_pool, close_pool),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
