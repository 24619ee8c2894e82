/* test_read.c -- formulas as they are typed: in a line, in gnuplot's text, in LaTeX. */
#include "kit.h"

#include "formula/read.h"
#include "formula/write.h"

static void
reads(const char *typed, const char *line, const char *gnuplot, const char *latex)
{
    const qdot_formula_id flat = SPAN(END), drawn = SPAN(END);
    qdot_text out = {0};

    qdot_formula_read(&f, flat, typed, QDOT_NOTATION_LINE);
    qdot_formula_read(&f, drawn, typed, QDOT_NOTATION_DRAWN);
    assert_int_equal(qdot_formula_status(&f), QDOT_OK);
    assert_int_equal(qdot_formula_write_line(&f, flat, QDOT_NOTATION_LINE, &out), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), line);
    qdot_text_truncate(&out, 0);
    assert_int_equal(qdot_formula_write_gnuplot(&f, drawn, &out), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), gnuplot);
    qdot_text_truncate(&out, 0);
    assert_int_equal(qdot_formula_write_latex(&f, drawn, &out), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), latex);
    qdot_text_clear(&out);
}

static void
names_have_indices_dots_and_primes(void **state)
{
    (void)state;
    reads("theta1'", "θ\u0307₁", "θ\u0307₁", "\\dot{\\theta}_{1}");
    reads("x_max''", "x\u0308_max", "x\u0308_{max}", "\\ddot{x}_{\\mathrm{max}}");
    reads("speed_1'", "speed₁′", "speed₁′", "\\dot{\\mathrm{speed}}_{1}");
    reads("A[1,2]", "A[1,2]", "A_{1,2}", "A_{1,2}");
    reads("p[theta1]", "p[θ₁]", "p_{θ₁}", "p_{\\theta_{1}}");
    reads("x_é", "x_é", "x_{é}", "x_{\\text{é}}");
    reads("bob.x'", "bob.x\u0307", "bob.x\u0307", "\\mathrm{bob}.\\dot{x}");
}

static void
powers_stand_above_what_is_below(void **state)
{
    (void)state;
    reads("x^2", "x²", "x^{2}", "x^{2}");
    reads("theta_1^2", "θ₁²", "θ₁^{2}", "\\theta_{1}^{2}");
    reads("V_eff^2", "V_eff²", "V@^{2}_{/*0.97 eff}", "V_{\\mathrm{eff}}^{2}");
    reads("V_eff^n", "V_eff^n", "V_{eff}^{n}", "V_{\\mathrm{eff}}^{n}");
    reads("x^-1", "x^−1", "x^{−1}", "x^{-1}");
    reads("(a + b)^(n + 1)", "(a + b)^(n + 1)", "(a + b)^{n+1}", "\\left(a + b\\right)^{n + 1}");
    reads("x^2^3", "x^2³", "x\\^(2^{3})", "x^{2^{3}}"); /* as the language does: x^(2^3) */
    reads("x^(n + 1)^2*y", "x^(n + 1)²\u202Fy", "x\\^((n + 1)^{2})·y", "x^{\\left(n + 1\\right)^{2}} y");
    reads("2^-x^n", "2^−x^n", "2\\^(−x^{n})", "2^{-x^{n}}");
    reads("e^(x^2)", "e^(x²)", "e\\^(x^{2})", "e^{x^{2}}"); /* gnuplot's letters get smaller once */
    reads("sin²(x)", "sin²(x)", "sin^{2}(x)", "\\mathrm{sin}^{2}\\left(x\\right)");
}

static void
sides_of_fractions_hold_together(void **state)
{
    (void)state;
    reads("m*l^2/2", "m\u202Fl²/2", "m·l^{2}/2", "\\frac{m l^{2}}{2}");
    reads("(a + b)/(2*m)", "(a + b)/(2\u202Fm)", "(a + b)/(2·m)", "\\frac{a + b}{2 m}");
    reads("a/b*c - d/e", "a/b\u202Fc − d/e", "a/b·c − d/e", "\\frac{a}{b} c - \\frac{d}{e}");
    reads("a/(b/c)", "a/(b/c)", "a/(b/c)", "\\frac{a}{\\frac{b}{c}}");
    reads("-(a)/b", "−(a)/b", "−a/b", "-\\frac{a}{b}");
    reads("x^(1/2)", "x^(1/2)", "x^{1/2}", "x^{\\frac{1}{2}}");
}

static void
functions_and_roots_have_their_argument(void **state)
{
    (void)state;
    reads("atan2(y, x)", "atan2(y, x)", "atan2(y, x)", "\\operatorname{atan2}\\left(y, x\\right)");
    reads("f1(x)", "f₁(x)", "f₁(x)", "f_{1}\\left(x\\right)");
    reads("sqrt(x + 1)/2", "√(x + 1)/2", "√(x + 1)/2", "\\frac{\\sqrt{x + 1}}{2}");
    reads("√2", "√2", "√2", "\\sqrt{2}");
    reads("sqrt(theta_1')", "√(θ\u0307₁)", "√θ\u0307₁", "\\sqrt{\\dot{\\theta}_{1}}");
    reads("abs(x - y)^2", "|x − y|²", "|x − y|^{2}", "\\left|x - y\\right|^{2}");
    reads("e^-sin(x)", "e^−sin(x)", "e^{−sin(x)}", "e^{-\\sin\\left(x\\right)}");
    reads("e^sin(x)", "e^sin(x)", "e^{sin(x)}", "e^{\\sin\\left(x\\right)}");
    reads("[x', y]'", "[x\u0307, y]′", "[x\u0307, y]′", "\\left[\\dot{x}, y\\right]'");
}

static void
signs_words_and_numbers(void **state)
{
    (void)state;
    reads("a <= 1e-9, b=-2.5e6", "a ≤ 1e-9, b = −2.5e6", "a ≤ 10^{−9}, b = −2.5·10^{6}",
          "a \\le 10^{-9}, b = -2.5 \\cdot 10^{6}");
    reads("phi_b vs x", "φ_b vs x", "φ_{b}\u200b vs x", "\\phi_{b} \\text{ vs } x");
    reads("E in [km/h]", "E in [km/h]", "E in [km/h]",
          "E \\text{ in } \\left[\\frac{\\mathrm{km}}{h}\\right]");
    reads("0.5*9.81*t^2", "0.5·9.81\u202Ft²", "0.5·9.81·t^{2}", "0.5 \\cdot 9.81 t^{2}");
    reads("2*3^n/4*5", "2·3^n/4·5", "2·3^{n}/4·5", "\\frac{2 \\cdot 3^{n}}{4} \\cdot 5");
    reads("a*-b", "a·−b", "a·−b", "a \\cdot -b");
}

/* Any text is read, and what is no formula stands as it was typed. */
static void
what_is_no_formula_stays(void **state)
{
    (void)state;
    reads("", "", "", "");
    reads("sin(x", "sin(x", "sin(x", "\\mathrm{sin(x}");
    reads("([x)]", "([x)]", "([x)]", "\\mathrm{([x)]}");
    reads("a/", "a/", "a/", "\\frac{a}{}");
    reads("^2", "^2", "\\^2", "\\mathrm{\\hat{}}2");
    reads("10% {a}", "10% {a}", "10% \\{a\\}", "10\\mathrm{\\%} \\mathrm{\\{}a\\mathrm{\\}}");
}

/* Also those that end within a fraction, a power, a bracket. */
static void
every_beginning_of_a_text_is_read(void **state)
{
    static const char typed[] = "-theta1'^2*(a + b)/sqrt(x_1[2]) - [sin(x)^(n - 1), √2/3e-5] vs y''";

    (void)state;
    for (size_t n = 0; n < sizeof typed; n++) {
        char part[sizeof typed];
        qdot_text out = {0};
        qdot_formula_id all;

        memcpy(part, typed, n);
        part[n] = '\0';
        all = SPAN(END);
        qdot_formula_read(&f, all, part, QDOT_NOTATION_LINE);
        assert_int_equal(qdot_formula_write_line(&f, all, QDOT_NOTATION_LINE, &out), QDOT_OK);
        all = SPAN(END);
        qdot_formula_read(&f, all, part, QDOT_NOTATION_DRAWN);
        assert_int_equal(qdot_formula_write_gnuplot(&f, all, &out), QDOT_OK);
        assert_int_equal(qdot_formula_write_latex(&f, all, &out), QDOT_OK);
        assert_int_equal(qdot_formula_status(&f), QDOT_OK);
        qdot_text_clear(&out);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(names_have_indices_dots_and_primes), TEST(powers_stand_above_what_is_below),
        TEST(sides_of_fractions_hold_together),   TEST(functions_and_roots_have_their_argument),
        TEST(signs_words_and_numbers),            TEST(what_is_no_formula_stays),
        TEST(every_beginning_of_a_text_is_read),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
