/* What is assumed, as values of parameters and as domains of unknowns. */
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>

#include "normal/kit.h"

#include <cmocka.h>

#include "normal/solve/assumptions.h"

/* What p + 2*k is under relations that are 0. */
static void
equations_give_values(void **state)
{
    static const struct {
        const char *relation[2], *sum;
    } rows[] = {
        {{"p - k", "0"}, "3*k"},   {{"p - 1", "k - 2"}, "5"},     {{"p - k", "k - 3"}, "9"},
        {{"k - 3", "p - k"}, "9"}, {{"p*k - 1", "0"}, "2*k + 1/k"}, {{"p^2 - k^2", "0"}, "p + 2*k"},
        {{"p*k", "0"}, "p + 2*k"}, {{"p - k", "p - k"}, "3*k"},   {{"x - p", "0"}, "p + 2*k"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        qdot_expr zero[] = {text_read(pool, rows[i].relation[0]), text_read(pool, rows[i].relation[1])},
                  x = text_read(pool, "x");
        qdot_assumptions a;

        assert_int_equal(qdot_assumptions_read(pool, &(qdot_facts){.n_relations = 2, .relations = zero},
                                               qdot_list(pool, 1, &x), &a),
                         QDOT_OK);
        assert_string_equal(shown(qdot_assumptions_put(pool, &a, text_read(pool, "p + 2*k"))), rows[i].sum);
        qdot_assumptions_clear(&a);
    }
}

/* Inequalities of an unknown are its domain, the others stay facts. */
static void
inequalities_of_unknowns_are_domains(void **state)
{
    qdot_expr x = text_read(pool, "x"), p = text_read(pool, "p"), zero = text_read(pool, "p - k"),
              conditions[] = {qdot_rel(pool, QDOT_LT, QDOT_ZERO, p), qdot_rel(pool, QDOT_LT, x, p)};
    const qdot_facts facts = {.n_relations = 1, .relations = &zero, .n_conditions = 2, .conditions = conditions};
    qdot_assumptions a;

    (void)state;
    assert_int_equal(qdot_assumptions_read(pool, &facts, qdot_list(pool, 1, &x), &a), QDOT_OK);
    assert_int_equal(a.facts.n_conditions, 1);
    assert_int_equal(a.facts.conditions[0], conditions[0]);
    assert_string_equal(shown(a.domain), "[x < k]");
    qdot_assumptions_clear(&a);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(equations_give_values, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(inequalities_of_unknowns_are_domains, open_pool, close_pool),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
