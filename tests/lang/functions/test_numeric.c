/* test_numeric.c -- numeric(E, n) is as near to E as it says; decimals beside symbols. */
#include <math.h>

#include "expr/build.h"
#include "lang/reading.h"
#include "lang/session/history.h"
#include "lang/session/measured.h"

#include "lang/session/bind.h"

/* The number that a text gave: its digits and its error. */
static qdot_measured
number_of(qdot_session *session, const char *e, int digits)
{
    char text[200];

    snprintf(text, sizeof text, "numeric(%s, %d)", e, digits);
    assert_int_equal(qdot_script_run_text(session, "a", text, strlen(text)), 0);
    assert_true(session->measured->n > 0);
    return session->measured->at[session->measured->n - 1];
}

static void
errors_cover(void **state)
{
    static const char *const constants[] = {
        "pi", "-1/3", "sqrt(2)/1e6", "exp(-20*pi)", "sin(1e10)", "atan(7)*3e8", "9.81", "2^-60",
        "log(10)", "1/8", "123456789/7", "sqrt(sqrt(5) - 2)", "tanh(30)", "abs(-pi)^pi"};
    static const int digits[] = {1, 2, 5, 15, 16, 17, 40};
    FILE *nowhere = fopen("/dev/null", "w");
    qdot_session *session = qdot_session_new(nowhere, nowhere);

    (void)state;
    for (size_t i = 0; i < sizeof constants / sizeof *constants; i++) {
        qdot_measured exact = number_of(session, constants[i], 80);

        for (size_t k = 0; k < sizeof digits / sizeof *digits; k++) {
            qdot_measured m = number_of(session, constants[i], digits[k]);
            double off;

            assert_int_equal(qdot_session_number(
                                 session, qdot_sub(session->pool, m.exact, exact.exact), &off, NULL),
                             QDOT_OK);
            if (fabs(off) > m.error * (1 + 1e-12) ||
                m.error > pow(10, 1 - digits[k]) * fabs(exact.value))
                fail_msg("%s to %d digits: off by %g, said %g", constants[i], digits[k], off,
                         m.error);
        }
    }
    qdot_session_free(session);
    fclose(nowhere);
}

static void
symbols_stay(void **state)
{
    static const struct {
        const char *e, *decimals;
    } rows[] = {
        {"m*pi/3", "1.047197551196598*m"},
        {"m*sqrt(2)*pi + m*x + 1/3", "4.442882938158366*m + m*x + 0.3333333333333333"},
        {"numeric((2/3)*m, 3)", "0.667*m"},
        {"m^(1/3) + x^pi", "m^(1/3) + x^3.141592653589793"},
    };
    FILE *nowhere = fopen("/dev/null", "w");
    qdot_session *session = qdot_session_new(nowhere, nowhere);
    static const char scene[] = "param m\ncoord x";

    (void)state;
    assert_int_equal(qdot_script_run_text(session, "a", scene, strlen(scene)), 0);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[200];

        snprintf(text, sizeof text, "numeric(%s)\n%s", rows[i].e, rows[i].decimals);
        assert_int_equal(qdot_script_run_text(session, "a", text, strlen(text)), 0);
        assert_int_equal(session->history->values.at[2 * i], session->history->values.at[2 * i + 1]);
    }
    qdot_session_free(session);
    fclose(nowhere);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_cover),
        cmocka_unit_test(symbols_stay),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
