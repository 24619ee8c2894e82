/* test_styles.c -- what plain and unicode style print is read as the same expression; decimals. */
#include "lang/reading.h"
#include "lang/session/history.h"

static const char scene[] =
    "param m, m1, g, L, a > 0, b, omega_0, k[1], w > 1\n"
    "coord x, y, r > 0, 0 < theta < pi, theta1, q[1], q[2], z[1], z1, phi\n"
    "function f(x), h(x, y), n(t)\n";

static uint64_t seed;

static unsigned
pick(unsigned n)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)(seed >> 33) % n;
}

/* A random expression of the scene, as text. */
static void
grow(qdot_text *out, int depth)
{
    static const char *const leaves[] = {
        "m", "m1", "g", "L", "a", "b", "omega_0", "k[1]", "w", "x", "y", "r", "theta", "theta1",
        "q[1]", "q[2]", "z[1]", "z1", "phi", "x'", "theta1'", "q[1]'", "theta''", "phi'",
        "z[1]'", "omega_0", "2", "3", "1/2", "9.81", "0.05", "3/7", "1e-7", "7/8", "pi", "t",
        "f(x)", "f'(x)", "n(t)", "h(x, y)", "diff(h(x, y), x)", "p[theta]", "lambda[e]", "dr",
        "deltatheta", "1/640", "22/15"};
    static const char *const functions[] = {"sin", "cos", "tan", "exp", "sqrt", "abs", "log",
                                            "atan", "cosh"};
    static const char *const operators[] = {"+", "-", "*", "*", "*", "/"};
    static const char *const powers[] = {"2", "3", "(-1)", "(-2)", "(1/2)", "(3/2)", "(1/5)",
                                         "(-1/2)", "12"};

    switch (depth <= 0 ? 0 : pick(5)) {
    case 0: qdot_text_add(out, leaves[pick(sizeof leaves / sizeof *leaves)]); break;
    case 1:
        qdot_text_format(out, "%s(", functions[pick(sizeof functions / sizeof *functions)]);
        grow(out, depth - 1);
        qdot_text_char(out, ')');
        break;
    case 2:
        qdot_text_char(out, '(');
        grow(out, depth - 1);
        qdot_text_format(out, ")^%s", powers[pick(sizeof powers / sizeof *powers)]);
        break;
    default:
        qdot_text_char(out, '(');
        grow(out, depth - 1);
        qdot_text_add(out, operators[pick(sizeof operators / sizeof *operators)]);
        grow(out, depth - 1);
        qdot_text_char(out, ')');
    }
}

/* The value of a text that is one expression; nil if it has none. */
static qdot_expr
value_of(qdot_session *session, const char *text)
{
    size_t before = session->history->values.n;

    if (qdot_script_run_text(session, "a", text, strlen(text)) != 0 ||
        session->history->values.n != before + 1)
        return QDOT_NIL;
    return session->history->values.at[before];
}

static void
assert_read_back(qdot_session *session, qdot_expr e, qdot_style style, bool *plain)
{
    qdot_text text = {0}, other = {0};
    qdot_expr again;

    assert_int_equal(qdot_print(session->pool, e, style, &text), QDOT_OK);
    again = value_of(session, text.at);
    if (again != e) {
        assert_int_equal(qdot_print(session->pool, e, QDOT_PLAIN, &other), QDOT_OK);
        fail_msg("%s was printed as %s, read as something else: %s", other.at, text.at,
                 again == QDOT_NIL ? qdot_last_error()->message : "");
    }
    for (const char *c = text.at; *c != '\0'; c++)
        *plain = *plain && (*c & 0x80) == 0;
    qdot_text_clear(&text);
    qdot_text_clear(&other);
}

static void
what_is_printed_is_read(void **state)
{
    FILE *nowhere = fopen("/dev/null", "w");
    qdot_session *session = qdot_session_new(nowhere, nowhere);
    unsigned read = 0;

    (void)state;
    assert_non_null(session);
    assert_int_equal(qdot_script_run_text(session, "a", scene, sizeof scene - 1), 0);
    assert_int_equal(qdot_script_run_text(session, "a",
                                          "lagrangian m*(x'^2 + y'^2 + theta'^2)/2\n"
                                          "constraint e: x^2 + y^2 = 1",
                                          67),
                     0);
    seed = 3;
    for (int i = 0; i < 4000; i++) {
        qdot_text text = {0};
        qdot_expr e;
        bool plain = true, all = true;

        grow(&text, 4);
        assert_int_equal(qdot_text_status(&text), QDOT_OK);
        e = value_of(session, text.at);
        if (e != QDOT_NIL) { /* not 1/0, log(0) */
            read++;
            assert_read_back(session, e, QDOT_PLAIN, &plain);
            assert_true(plain);
            assert_read_back(session, e, QDOT_UNICODE, &all);
        }
        qdot_text_clear(&text);
    }
    assert_true(read > 3500);
    qdot_session_free(session);
    fclose(nowhere);
}

static void
signs_are_read(void **state)
{
    reading r;

    (void)state;
    reading_open(&r);
    assert_same(&r, "½", "1/2");
    assert_same(&r, "m²", "m^2");
    assert_same(&r, "m⁻¹²", "m^-12");
    assert_same(&r, "½²", "1/4");
    assert_same(&r, "sin²(m)", "sin(m)^2");
    assert_same(&r, "−sin³(m)²", "-sin(m)^6");
    assert_same(&r, "θ̇²", "theta'^2");
    assert_same(&r, "θ̈", "theta''");
    assert_same(&r, "q₁", "q[1]");
    assert_same(&r, "q̇₂", "q[2]'");
    assert_same(&r, "ẋ(m)", "x'(m)");
    assert_same(&r, "m\u202Fg", "m*g");
    assert_same(&r, "m · g × s", "m*g*s");
    assert_same(&r, "√m", "sqrt(m)");
    assert_same(&r, "√2\u202F√(m + 1)", "sqrt(2)*sqrt(m + 1)");
    assert_same(&r, "x⁽⁴⁾(s)", "diff(x(s), s, 4)");
    assert_fails(&r, "m + √2²", QDOT_ESYNTAX, 8, "which comes first", "");
    assert_fails(&r, "sin⁻¹(m)", QDOT_ESYNTAX, 3, "negative power", "asin");
    assert_fails(&r, "m + ²", QDOT_ESYNTAX, 4, "raised digit", "^2");
    reading_close(&r);
}

static void
decimals_are_exact(void **state)
{
    static const struct {
        const char *text, *printed;
    } cases[] = {
        {"981/100", "9.81"},       {"1/20", "0.05"},
        {"-7/5", "-1.4"},          {"1/2", "1/2"},
        {"1/8", "1/8"},            {"1/3", "1/3"},
        {"1/15", "1/15"},          {"1/640", "0.0015625"},
        {"6.67e-11", "6.67e-11"},  {"1/10000", "0.0001"},
        {"1/100000", "1e-5"},      {"12345678901234567890/3125", "3950617248395061.7248"},
        {"m/5", "0.2*m"},          {"1/(5*m)", "0.2/m"},
        {"3*m/(2.5*g)", "1.2*m/g"}, {"m^(1/5)", "m^0.2"},
        {"1/(5*2^200)", "1/8034690221294951377709810461705813012611014968913964176506880"},
    };
    reading r;

    (void)state;
    reading_open(&r);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_string_equal(reading_plain(&r, cases[i].text), cases[i].printed);
    reading_close(&r);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_printed_is_read),
        cmocka_unit_test(signs_are_read),
        cmocka_unit_test(decimals_are_exact),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
