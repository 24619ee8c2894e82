/* Simultaneous equations: against sets of solutions known beforehand. */
#include <setjmp.h>

#include "normal/kit.h"

#include <cmocka.h>

#include "base/memory.h"
#include "normal/solve/simultaneous.h"

/* The solutions in order, `; ` between them, each with its conditions behind `|`; ` ...` if there may be others. */
static const char *
listed(size_t n, const char *const *f, const char *const *u)
{
    static qdot_text all;
    qdot_expr equation[3], unknown[3];
    qdot_simultaneous set;

    qdot_text_clear(&all);
    for (size_t i = 0; i < n; i++) {
        unknown[i] = text_read(pool, u[i]);
        equation[i] = text_read(pool, f[i]);
    }
    assert_int_equal(
        qdot_simultaneous_all(pool, n, equation, unknown, QDOT_NIL, NULL, &set), QDOT_OK);
    for (size_t k = 0; k < set.found.n; k++) {
        const qdot_simultaneous_solution *one = &set.found.at[k];

        qdot_text_add(&all, k > 0 ? "; " : "");
        qdot_text_add(&all, shown(one->values));
        if (one->conditions == QDOT_NIL)
            continue;
        qdot_text_add(&all, " |");
        qdot_text_add(&all, shown(one->conditions));
    }
    for (size_t k = 0; k < set.special.n; k++) {
        qdot_text_add(&all, k == 0 ? " special " : ", ");
        qdot_text_add(&all, shown(set.special.at[k]));
    }
    qdot_text_add(&all, set.complete ? "" : " ...");
    qdot_simultaneous_clear(&set);
    return qdot_text_str(&all);
}

typedef struct {
    const char *f[3], *u[3], *solutions;
} row;

static void
rows_hold(size_t n, const row *rows)
{
    for (size_t i = 0; i < n; i++) {
        size_t unknowns = rows[i].f[2] != NULL ? 3 : 2;
        const char *seen = listed(unknowns, rows[i].f, rows[i].u);

        if (strcmp(seen, rows[i].solutions) != 0)
            fail_msg("%s, %s: %s, not %s", rows[i].f[0], rows[i].f[1], seen, rows[i].solutions);
    }
}
#define HOLD(rows) rows_hold(sizeof rows / sizeof *rows, rows)

static void
all_solutions_are_listed_once(void **state)
{
    static const row rows[] = {
        {{"x + y - 3", "x*y - 2"}, {"x", "y"}, "[x = 1, y = 2]; [x = 2, y = 1]"},
        {{"x*y", "x + y - 1"}, {"x", "y"}, "[x = 0, y = 1]; [x = 1, y = 0]"},
        {{"x*(x^2 + y^2) - x", "y*(x^2 + y^2) - 2*y"}, {"x", "y"},
         "[x = -1, y = 0]; [x = 0, y = -sqrt(2)]; [x = 0, y = 0]; [x = 0, y = sqrt(2)]; [x = 1, y = 0]"},
        {{"x^2 + y^2 + z^2 - 3", "x - y", "y - z"}, {"x", "y", "z"},
         "[x = -1, y = -1, z = -1]; [x = 1, y = 1, z = 1]"},
        {{"x*y - 1", "x + y"}, {"x", "y"}, ""},
        {{"1/x - y", "x - y"}, {"x", "y"}, "[x = -1, y = -1]; [x = 1, y = 1]"},
        {{"x/y - 1", "x*(y - 2)"}, {"x", "y"}, "[x = 2, y = 2]"},
        {{"x^5 - x + 1", "y - x"}, {"x", "y"}, " ..."},
    };

    (void)state;
    HOLD(rows);
}

/* Where a coefficient that holds an unknown vanishes, where it is an unknown parameter, where nothing is left. */
static void
no_branch_is_lost(void **state)
{
    static const row rows[] = {
        {{"x*y", "x*z", "y + z - 1"}, {"x", "y", "z"}, "[x = 0, z = 1 - y]"},
        {{"(x - y)*x", "(x - y)*y"}, {"x", "y"}, "[y = x]"},
        {{"p*k - p", "p + k - c"}, {"p", "k"}, "[p = 0, k = c]; [p = c - 1, k = 1]"},
        {{"p*k - 1", "p - k"}, {"p", "k"}, "[p = -1, k = -1]; [p = 1, k = 1]"},
        {{"p*k", "p^2 - p"}, {"p", "k"}, "[p = 1, k = 0]; [p = 0]"},
        /* one case of the first is without y; so is what is left of it at x = y */
        {{"sign(x - y) + 2*x - 3", "sign(x - y) - 2*y"}, {"x", "y"}, "[x = 1, y = 1/2]"},
        {{"sign(x - y) + x - 1", "x + y - 2"}, {"x", "y"}, "[x = 1, y = 1]"},
    };

    (void)state;
    HOLD(rows);
}

static void
solutions_lie_in_the_domain_and_say_when_they_exist(void **state)
{
    static const row rows[] = {
        {{"x^2 + y^2 - k", "x - y"}, {"x", "y"},
         "[x = -sqrt(k/2), y = -sqrt(k/2)] |[k > 0]; [x = sqrt(k/2), y = sqrt(k/2)] |[k > 0]"},
        {{"r^2 - 4", "x - r"}, {"r", "x"}, "[r = 2, x = 2]"},
        {{"r - k", "x - r^2"}, {"r", "x"}, "[r = k, x = k^2] |[k > 0]"},
        {{"sin(theta) - 1/2", "x - cos(theta)"}, {"theta", "x"},
         "[theta = 1/6*pi, x = 1/2*sqrt(3)]; [theta = 5/6*pi, x = -1/2*sqrt(3)]"},
        {{"sqrt(x) - y", "x + y - 6"}, {"x", "y"}, "[x = 4, y = 2]"},
        {{"abs(x) - x", "y - 1"}, {"x", "y"}, "[y = 1] |[x >= 0]"},
        /* sqrt(x^2 + r^2) at x = 0, r = p + 1 is r only where r > 0 */
        {{"x*(1 - 1/sqrt(x^2 + r^2))", "r*(1 - 1/sqrt(x^2 + r^2)) - p"}, {"x", "r"},
         "[x = 0, r = p + 1] |[p + 1 > 0] special -p"},
    };

    (void)state;
    HOLD(rows);
}

static void
families_keep_their_integer(void **state)
{
    static const row rows[] = {
        {{"sin(x) - 1/2", "x + y"}, {"x", "y"},
         "[x = 2*pi*n + 1/6*pi, y = -1/6*pi*(12*n + 1)]; [x = 1/6*pi*(12*n + 5), y = -1/6*pi*(12*n + 5)]"},
        {{"sin(phi)", "psi - phi"}, {"phi", "psi"},
         "[phi = 2*pi*n, psi = 2*pi*n]; [phi = 2*pi*n + pi, psi = 2*pi*n + pi]"},
        {{"cos(pi*x)", "y - x^2"}, {"x", "y"},
         "[x = 2*n - 1/2, y = 1/4*(4*n - 1)^2]; [x = 2*n + 1/2, y = 1/4*(4*n + 1)^2]"},
        {{"cos(r)", "x - r"}, {"r", "x"},
         "[r = 2*pi*n + 1/2*pi, x = 1/2*pi*(4*n + 1)] |[2*pi*n + 1/2*pi > 0]; "
         "[r = 1/2*pi*(4*n + 3), x = 1/2*pi*(4*n + 3)] |[1/2*pi*(4*n + 3) > 0]"},
        {{"sin(pi*x)", "y - x", "y^2 - y"}, {"x", "y", "z"}, "[x = 0, y = 0]; [x = 1, y = 1]"},
    };

    (void)state;
    HOLD(rows);
}

/* Where a divisor of parameters alone is 0, or what must be 0 is of them alone, the set may be another. */
static void
special_parameters_are_noted(void **state)
{
    static const row rows[] = {
        {{"k*x + y - 1", "x + y"}, {"x", "y"}, "[x = 1/(k - 1), y = 1/(1 - k)] special k - 1"},
        {{"x + y - k", "2*x + 2*y - c"}, {"x", "y"}, " special 2*k - c"},
        {{"m*x - y", "x + y - 1"}, {"x", "y"}, "[x = 1/(m + 1), y = m/(m + 1)]"}, /* m > 0 in text.h */
    };

    (void)state;
    HOLD(rows);
}

/* Two attracting centres: the powers of the distances follow from both equations, and then the distances. */
static void
equations_linear_in_powers_are_solved_for_them(void **state)
{
    static const row rows[] = {
        {{"x - (1 - k)*(x + k)/((x + k)^2 + y^2)^(3/2) - k*(x + k - 1)/((x + k - 1)^2 + y^2)^(3/2)",
          "y - (1 - k)*y/((x + k)^2 + y^2)^(3/2) - k*y/((x + k - 1)^2 + y^2)^(3/2)"}, {"x", "y"},
         "[x = 1/2*(1 - 2*k), y = -1/2*sqrt(3)]; [x = 1/2*(1 - 2*k), y = 1/2*sqrt(3)] special k - 1, k ..."},
        {{"1/sqrt(x + y) + 1/sqrt(x - y) - 3/2", "1/sqrt(x + y) - 1/sqrt(x - y) - 1/2"}, {"x", "y"},
         "[x = 5/2, y = -3/2]"},
        {{"1/sqrt(x + y) + 1/sqrt(x - y) - 1", "1/sqrt(x + y) - 1/sqrt(x - y) - 2"}, {"x", "y"}, ""},
    };

    (void)state;
    HOLD(rows);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(all_solutions_are_listed_once, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(no_branch_is_lost, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(solutions_lie_in_the_domain_and_say_when_they_exist, open_pool,
                                        close_pool),
        cmocka_unit_test_setup_teardown(families_keep_their_integer, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(equations_linear_in_powers_are_solved_for_them, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(special_parameters_are_noted, open_pool, close_pool),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
