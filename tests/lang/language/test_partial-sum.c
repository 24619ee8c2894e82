/* test_partial-sum.c -- which sums a loop goes on with; what they are is in
 * tests/script/solve/partial-sums.lag. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "lang/session/output.h"
#include "lang/session/session.h"
#include "lang/workbench/script.h"
#include "lang/language/partial-sum.h"

static qdot_session *
after(const char *text)
{
    FILE *out = fopen("/dev/null", "w");
    qdot_session *session;

    assert_non_null(out);
    session = qdot_session_new(out, out);
    assert_non_null(session);
    assert_int_equal(qdot_script_run_text(session, "test", text, strlen(text)), 0);
    return session;
}

static void
end(qdot_session *session)
{
    FILE *out = session->output->out;

    qdot_session_free(session);
    fclose(out);
}

#define CHAIN "param l[k] for k = 1..9; coord theta[k] for k = 1..9;"

static void
sums_of_a_chain_are_kept_to_their_end(void **state)
{
    qdot_session *s = after(CHAIN "particle bob[k] mass 1 at (sum(l[j]*sin(theta[j]), j, 1, k),"
                                  " -sum(l[j]*cos(theta[j]), j, 1, k)) for k = 1..9");

    (void)state;
    assert_int_equal(s->evaluation->partial_sums.n, 2);
    for (size_t i = 0; i < 2; i++) {
        const qdot_partial_sum *sum = s->evaluation->partial_sums.at + i;

        assert_int_equal(sum->first, 1);
        assert_int_equal(sum->last, 9);
        assert_ptr_equal(qdot_partial_sum_find(s, sum->place, 1, 12), sum);
        assert_null(qdot_partial_sum_find(s, sum->place, 1, 8));
        assert_null(qdot_partial_sum_find(s, sum->place, 2, 12));
    }
    end(s);
}

static void
sums_that_depend_on_more_are_not_kept(void **state)
{
    static const char *const texts[] = {
        CHAIN "x[k] = sum(k*l[j], j, 1, k) for k = 1..3",          /* the loop's index */
        CHAIN "n = 2; x[k] = sum(n*l[j], j, 1, k) for k = 1..3",   /* a value */
        CHAIN "x[1] = 1; x[k] = sum(x[j], j, 1, k - 1) for k = 2..4", /* members that are values */
        CHAIN "f(a) = a; x[k] = sum(f(l[j]), j, 1, k) for k = 1..3",  /* a function of a user */
        CHAIN "x = sum(l[j], j, 1, 5)",                             /* no loop */
    };

    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        qdot_session *s = after(texts[i]);

        if (s->evaluation->partial_sums.n != 0)
            fail_msg("kept: %s", texts[i]);
        end(s);
    }
}

static void
the_next_loop_begins_with_none(void **state)
{
    qdot_session *s = after(CHAIN "x[k] = sum(l[j], j, 1, k) for k = 1..3;"
                                  "y[k] = k for k = 1..2");

    (void)state;
    assert_int_equal(s->evaluation->partial_sums.n, 0);
    end(s);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_of_a_chain_are_kept_to_their_end),
        cmocka_unit_test(sums_that_depend_on_more_are_not_kept),
        cmocka_unit_test(the_next_loop_begins_with_none),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
