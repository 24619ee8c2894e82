/* test_name.c -- names as they are spelled, in a line and drawn. */
#include "kit.h"

#include "formula/name.h"
#include "formula/write.h"

static void
is(const char *name, uint32_t order, const char *line, const char *latex, const char *mathml)
{
    qdot_name_digits digits;
    qdot_text out = {0};
    qdot_formula_id all = SPAN(END);

    qdot_name_line(name, order, qdot_name_index(name, &digits), &out);
    assert_string_equal(qdot_text_str(&out), line);
    qdot_text_truncate(&out, 0);
    qdot_formula_add_name(&f, all, name, order);
    assert_int_equal(qdot_formula_status(&f), QDOT_OK);
    assert_int_equal(qdot_formula_write_latex(&f, all, &out), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), latex);
    qdot_text_truncate(&out, 0);
    assert_int_equal(qdot_formula_write_mathml(&f, all, &out), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), mathml);
    qdot_text_clear(&out);
}

static void
letters_are_greek_or_stand_as_they_are(void **state)
{
    (void)state;
    is("x", 0, "x", "x", "<mi>x</mi>");
    is("theta", 0, "θ", "\\theta", "<mi>θ</mi>");
    is("deltatheta", 0, "δθ", "\\delta \\theta", "<mi>δθ</mi>");
    is("thetas", 0, "thetas", "\\mathrm{thetas}", "<mi>thetas</mi>");
    is("Omega", 0, "Ω", "\\Omega", "<mi>Ω</mi>");
    assert_null(qdot_name_greek("ö"));
    assert_string_equal(qdot_name_greek("ωx"), "omega");
}

static void
indices_stand_below(void **state)
{
    (void)state;
    is("theta1", 0, "θ₁", "\\theta_{1}", "<msub><mi>θ</mi><mrow><mn>1</mn></mrow></msub>");
    is("omega_0", 0, "ω₀", "\\omega_{0}", "<msub><mi>ω</mi><mrow><mn>0</mn></mrow></msub>");
    is("x[12]", 0, "x₁₂", "x_{12}", "<msub><mi>x</mi><mrow><mn>12</mn></mrow></msub>");
    is("V_eff", 0, "V_eff", "V_{\\mathrm{eff}}", "<msub><mi>V</mi><mrow><mi>eff</mi></mrow></msub>");
    is("A[1,phi]", 0, "A[1,φ]", "A_{1,\\phi}",
       "<msub><mi>A</mi><mrow><mn>1</mn><mo>,</mo><mi>φ</mi></mrow></msub>");
    is("r2_max[3]", 0, "r₂_max[3]", "r_{2,\\mathrm{max},3}",
       "<msub><mi>r</mi><mrow><mn>2</mn><mo>,</mo><mi>max</mi><mo>,</mo><mn>3</mn></mrow></msub>");
}

static void
derivatives_have_dots_over_one_letter(void **state)
{
    (void)state;
    is("theta1", 1, "θ\u0307₁", "\\dot{\\theta}_{1}",
       "<msub><mover accent=\"true\"><mi>θ</mi><mo>˙</mo></mover><mrow><mn>1</mn></mrow></msub>");
    is("x", 2, "x\u0308", "\\ddot{x}", "<mover accent=\"true\"><mi>x</mi><mo>¨</mo></mover>");
    is("x", 3, "x′′′", "\\dddot{x}", "<mover accent=\"true\"><mi>x</mi><mo>⃛</mo></mover>");
    is("xy", 1, "xy′", "\\dot{\\mathrm{xy}}", "<mover accent=\"true\"><mi>xy</mi><mo>˙</mo></mover>");
}

/* Only digits, and nothing else below, may be lowered. */
static void
an_index_of_digits_is_found(void **state)
{
    qdot_name_digits d;

    (void)state;
    assert_true(qdot_name_index("phi[12]", &d));
    assert_int_equal(d.letters, 3);
    assert_true(d.brackets);
    assert_int_equal(d.n, 2);
    assert_memory_equal(d.at, "12", 2);
    assert_true(qdot_name_index("x_7", &d));
    assert_false(d.brackets);
    assert_false(qdot_name_index("x1", &d));
    assert_false(qdot_name_index("x1_7", &d));
    assert_false(qdot_name_index("x_a", &d));
    assert_false(qdot_name_index("x_1[2]", &d));
    assert_false(qdot_name_index("x[1,2]", &d));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(letters_are_greek_or_stand_as_they_are),
        TEST(indices_stand_below),
        TEST(derivatives_have_dots_over_one_letter),
        TEST(an_index_of_digits_is_found),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
