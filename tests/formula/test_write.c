/* test_write.c -- formulas in each language. */
#include "kit.h"

#include "base/interrupt.h"
#include "formula/width.h"
#include "formula/write.h"

static void
says(qdot_formula_id id, const char *latex, const char *mathml)
{
    qdot_text out = {0};

    assert_int_equal(qdot_formula_status(&f), QDOT_OK);
    assert_int_equal(qdot_formula_write_latex(&f, id, &out), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), latex);
    qdot_text_truncate(&out, 0);
    assert_int_equal(qdot_formula_write_mathml(&f, id, &out), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), mathml);
    qdot_text_clear(&out);
}

/* In a script, unless that has another tree, and in a line for the eye. */
static void
stands_in_a_line(qdot_formula_id id, const char *script, const char *line)
{
    qdot_text out = {0};

    assert_int_equal(qdot_formula_status(&f), QDOT_OK);
    assert_int_equal(qdot_formula_write_line(&f, id, QDOT_NOTATION_SCRIPT, &out), QDOT_OK);
    if (script != NULL)
        assert_string_equal(qdot_text_str(&out), script);
    qdot_text_truncate(&out, 0);
    assert_int_equal(qdot_formula_write_line(&f, id, QDOT_NOTATION_LINE, &out), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), line);
    qdot_text_clear(&out);
}

static void
texts_have_their_role(void **state)
{
    (void)state;
    says(NAME("x"), "x", "<mi>x</mi>");
    says(NAME("θ"), "\\theta", "<mi>θ</mi>");
    says(NAME("δθ"), "\\delta \\theta", "<mi>δθ</mi>");
    says(NAME("V_max"), "\\mathrm{V\\_max}", "<mi>V_max</mi>");
    says(ROW(NAME("k"), sign(QDOT_SIGN_TIMES), NAME("mass"), sign(QDOT_SIGN_TIMES), NAME("l"),
             sign(QDOT_SIGN_TIMES), NAME("m")),
         "k \\mathrm{mass} l m",
         "<mrow><mi>k</mi><mo>&#x2062;</mo><mi>mass</mi><mo>&#x2062;</mo><mi>l</mi><mo>&#x2062;</mo><mi>m</mi></mrow>");
    says(SPAN(NAME("mass"), sign(QDOT_SIGN_TIMES), POWER(ROW(NAME("length")), NUMBER("2")), sign(QDOT_SIGN_TIMES),
              NAME("rate"), sign(QDOT_SIGN_TIMES), APPLY(FUNCTION("sin"), ROUND(NAME("x")))),
         "\\mathrm{mass} \\, \\mathrm{length}^{2} \\mathrm{rate} \\sin\\left(x\\right)",
         "<mi>mass</mi><mo>&#x2062;</mo><msup><mrow><mi>length</mi></mrow><mn>2</mn></msup><mo>&#x2062;</mo>"
         "<mi>rate</mi><mo>&#x2062;</mo><mi>sin</mi><mo>&#x2061;</mo><mrow><mo>(</mo><mi>x</mi><mo>)</mo></mrow>");
    says(NUMBER("12"), "12", "<mn>12</mn>");
    says(FUNCTION("asin"), "\\arcsin", "<mi>asin</mi>");
    says(FUNCTION("si"), "\\operatorname{si}", "<mi>si</mi>");
    says(text(QDOT_TEXT_WORDS, "a & b < c"), "a & b < c", "<mtext>a &amp; b &lt; c</mtext>");
}

static void
fractions_roots_and_powers_are_drawn(void **state)
{
    (void)state;
    says(OVER(NUMBER("1"), NUMBER("2")), "\\frac{1}{2}", "<mfrac><mn>1</mn><mn>2</mn></mfrac>");
    says(POWER(ROW(NAME("x")),
               ROW(node(QDOT_FORMULA_FRACTION, 0, QDOT_FORMULA_SLANTED, NUMBER("1"), NUMBER("3"), END))),
         "x^{1/3}",
         "<msup><mrow><mi>x</mi></mrow><mrow><mfrac><mn>1</mn><mn>3</mn></mfrac></mrow></msup>");
    says(ROOT(NUMBER("2"), sign(QDOT_SIGN_TIMES), NAME("a")), "\\sqrt{2 a}",
         "<msqrt><mn>2</mn><mo>&#x2062;</mo><mi>a</mi></msqrt>");
    says(APPLY(POWER(ROW(FUNCTION("sin")), ROW(NUMBER("2"))), ROUND(NAME("x"))), "\\sin^{2}\\left(x\\right)",
         "<msup><mrow><mi>sin</mi></mrow><mrow><mn>2</mn></mrow></msup><mo>&#x2061;</mo><mrow><mo>(</mo><mi>x</mi>"
         "<mo>)</mo></mrow>");
}

/* Dots up to the fourth in LaTeX, the third in MathML; then the order stands behind the index. */
static void
derivatives_have_dots_primes_and_orders(void **state)
{
    (void)state;
    says(DOTS(1, NAME("θ")), "\\dot{\\theta}", "<mover accent=\"true\"><mi>θ</mi><mo>˙</mo></mover>");
    says(INDEX(DOTS(2, NAME("q")), ROW(NUMBER("1"))), "\\ddot{q}_{1}",
         "<msub><mover accent=\"true\"><mi>q</mi><mo>¨</mo></mover><mrow><mn>1</mn></mrow></msub>");
    says(DOTS(4, NAME("q")), "\\ddddot{q}", "<msup><mi>q</mi><mrow><mo>(</mo><mn>4</mn><mo>)</mo></mrow></msup>");
    says(DOTS(5, NAME("q")), "q^{(5)}", "<msup><mi>q</mi><mrow><mo>(</mo><mn>5</mn><mo>)</mo></mrow></msup>");
    says(INDEX(DOTS(5, NAME("q")), ROW(NUMBER("1"))), "q_{1}^{(5)}",
         "<msub><msup><mi>q</mi><mrow><mo>(</mo><mn>5</mn><mo>)</mo></mrow></msup><mrow><mn>1</mn></mrow></msub>");
    says(PRIMES(2, NAME("f")), "f''", "<msup><mrow><mi>f</mi></mrow><mo>′′</mo></msup>");
    says(PRIMES(4, NAME("f")), "f^{(4)}", "<msup><mrow><mi>f</mi></mrow><mo>(4)</mo></msup>");
}

static void
brackets_have_shapes_and_sizes(void **state)
{
    (void)state;
    says(SQUARE(NAME("a"), sign(QDOT_SIGN_COMMA), NAME("b")), "\\left[a, b\\right]",
         "<mrow><mo>[</mo><mi>a</mi><mo>,</mo><mi>b</mi><mo>]</mo></mrow>");
    says(BARS(NAME("a")), "\\left|a\\right|", "<mrow><mo>|</mo><mi>a</mi><mo>|</mo></mrow>");
    says(FIXED(sign(QDOT_SIGN_NEGATIVE), NUMBER("2")), "(-2)",
         "<mrow><mo>(</mo><mo>−</mo><mn>2</mn><mo>)</mo></mrow>");
}

static void
tables_and_cases_have_cells(void **state)
{
    (void)state;
    says(TABLE(2, NUMBER("1"), NUMBER("2"), NUMBER("3"), NUMBER("4")), "\\begin{pmatrix}1 & 2 \\\\ 3 & 4\\end{pmatrix}",
         "<mrow><mo>(</mo><mtable><mtr><mtd><mn>1</mn></mtd><mtd><mn>2</mn></mtd></mtr><mtr><mtd><mn>3</mn></mtd><mtd>"
         "<mn>4</mn></mtd></mtr></mtable><mo>)</mo></mrow>");
    says(CASES(NAME("a"), NAME("b"), NAME("c")),
         "\\begin{cases} a & \\text{if } b \\\\ c & \\text{otherwise} \\end{cases}",
         "<mrow><mo>{</mo><mtable columnalign=\"left\"><mtr><mtd><mi>a</mi></mtd><mtd><mtext>if&#xA0;</mtext><mi>b</mi>"
         "</mtd></mtr><mtr><mtd><mi>c</mi></mtd><mtd><mtext>otherwise</mtext></mtd></mtr></mtable></mrow>");
    stands_in_a_line(TABLE(2, NUMBER("1"), NUMBER("2"), NUMBER("3"), NUMBER("4")), "[1, 2; 3, 4]", "[1, 2; 3, 4]");
    stands_in_a_line(TABLE(2, NUMBER("1"), NUMBER("2")), "[1, 2;]", "[1, 2;]");
}

static void
a_line_has_slashes_and_superscripts(void **state)
{
    (void)state;
    stands_in_a_line(SPAN(sign(QDOT_SIGN_NEGATIVE),
                          OVER(NAME("a"), ROUND(NUMBER("2"), sign(QDOT_SIGN_TIMES), NAME("b")))),
                     "-a/(2*b)", "−a/(2\u202Fb)");
    stands_in_a_line(POWER(NAME("x"), ROUND(sign(QDOT_SIGN_NEGATIVE), NUMBER("2"))), "x^(-2)", "x^(−2)");
    stands_in_a_line(POWER(NAME("x"), NUMBER("102")), "x^102", "x^102");
    stands_in_a_line(node(QDOT_FORMULA_POWER, 0, QDOT_FORMULA_RAISED, NAME("x"), NUMBER("102"), END), NULL, "x¹⁰²");
    stands_in_a_line(ROOT(NAME("x"), sign(QDOT_SIGN_PLUS), NUMBER("1")), "sqrt(x + 1)", "√(x + 1)");
    stands_in_a_line(node(QDOT_FORMULA_ROOT, 0, QDOT_FORMULA_BARE, NUMBER("2"), END), NULL, "√2");
    stands_in_a_line(APPLY(PRIMES(2, NAME("f")), ROUND(NAME("t"))), "f''(t)", "f′′(t)");
    stands_in_a_line(PRIMES(12, NAME("f")), NULL, "f⁽¹²⁾");
}

static void
is_on_a_page(qdot_formula_id id, const char *mathml)
{
    qdot_text out = {0};

    assert_int_equal(qdot_formula_status(&f), QDOT_OK);
    assert_int_equal(qdot_formula_write_page(&f, id, (qdot_formula_before){0}, &out), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), mathml);
    qdot_text_clear(&out);
}

static void
names_of_several_letters_are_parted_on_pages(void **state)
{
    (void)state;
    is_on_a_page(SPAN(NAME("mass"), sign(QDOT_SIGN_TIMES), NAME("length"), sign(QDOT_SIGN_TIMES), NAME("l")),
                 "<mi>mass</mi><mo>&#x2062;</mo><mspace width=\"0.17em\"></mspace><mi>length</mi><mo>&#x2062;</mo>"
                 "<mi>l</mi>");
}

/* An index and a power are set at one place, also where the power holds another. */
static void
index_and_power_are_one_above_the_other_on_pages(void **state)
{
    (void)state;
    is_on_a_page(POWER(ROW(INDEX(NAME("L"), NUMBER("1"))), ROW(NUMBER("2"))),
                 "<msubsup><mi>L</mi><mn>1</mn><mrow><mn>2</mn></mrow></msubsup>");
    is_on_a_page(POWER(ROW(SPAN(INDEX(NAME("a"), NUMBER("1")))), ROW(POWER(ROW(NAME("b")), NUMBER("2")))),
                 "<msubsup><mi>a</mi><mn>1</mn><mrow><msup><mrow><mi>b</mi></mrow><mn>2</mn></msup></mrow></msubsup>");
    is_on_a_page(POWER(INDEX(NAME("v"), NAME("a")), NUMBER("2")), "<msubsup><mi>v</mi><mi>a</mi><mn>2</mn></msubsup>");
    is_on_a_page(POWER(ROW(NAME("b")), NUMBER("2")), "<msup><mrow><mi>b</mi></mrow><mn>2</mn></msup>");
    is_on_a_page(POWER(ROW(INDEX(NAME("a"), NUMBER("1")), NAME("b")), NUMBER("2")),
                 "<msup><mrow><msub><mi>a</mi><mn>1</mn></msub><mi>b</mi></mrow><mn>2</mn></msup>");
    is_on_a_page(PRIMES(1, INDEX(NAME("f"), NUMBER("1"))), "<msubsup><mi>f</mi><mn>1</mn><mo>′</mo></msubsup>");
    is_on_a_page(POWER(NAME("a"), INDEX(NAME("b"), NUMBER("1"))),
                 "<msup><mi>a</mi><msub><mi>b</mi><mn>1</mn></msub></msup>");
}

#define FLAT(x) "<mrow><mo stretchy=\"false\">(</mo>" x "<mo stretchy=\"false\">)</mo></mrow>"

/* Brackets about one line do not stretch; those about a fraction do, and they may hold others. */
static void
flat_brackets_do_not_stretch_on_pages(void **state)
{
    (void)state;
    is_on_a_page(ROUND(NAME("a")), FLAT("<mi>a</mi>"));
    is_on_a_page(ROUND(OVER(NAME("a"), ROUND(NAME("b")))),
                 "<mrow><mo>(</mo><mfrac><mi>a</mi>" FLAT("<mi>b</mi>") "</mfrac><mo>)</mo></mrow>");
    is_on_a_page(SQUARE(NAME("a")), "<mrow><mo>[</mo><mi>a</mi><mo>]</mo></mrow>");
}

/* A thin space before sin x and sin^2 x behind a factor; not before a letter. */
static void
functions_stand_apart_on_pages(void **state)
{
#define FACTOR "<mi>L</mi><mo>&#x2062;</mo>"
#define SPACE "<mspace width=\"0.17em\"></mspace>"
    const qdot_formula_sign times = QDOT_SIGN_TIMES;

    (void)state;
    is_on_a_page(SPAN(NAME("L"), sign(times), SPAN(APPLY(FUNCTION("sin"), NAME("u")))),
                 FACTOR SPACE "<mi>sin</mi><mo>&#x2061;</mo><mi>u</mi>");
    is_on_a_page(SPAN(NAME("L"), sign(times), APPLY(POWER(ROW(FUNCTION("sin")), NUMBER("2")), NAME("u"))),
                 FACTOR SPACE "<msup><mrow><mi>sin</mi></mrow><mn>2</mn></msup><mo>&#x2061;</mo><mi>u</mi>");
    is_on_a_page(SPAN(NAME("L"), sign(times), APPLY(NAME("f"), NAME("u"))),
                 FACTOR "<mi>f</mi><mo>&#x2061;</mo><mi>u</mi>");
    is_on_a_page(SPAN(NAME("L"), sign(times), NAME("mass")), FACTOR "<mi>mass</mi>");
}

/* Above before below in LaTeX, below before above in MathML. */
static void
tensors_have_their_indices(void **state)
{
    (void)state;
    says(node(QDOT_FORMULA_TENSOR, 0, 0, NAME("Γ"), ROW(NAME("r")), ROW(NAME("θ"), sign(QDOT_SIGN_BLANK), NAME("θ")), END),
         "\\Gamma^{r}{}_{\\theta \\theta}",
         "<msubsup><mi>Γ</mi><mrow><mi>θ</mi><mi>θ</mi></mrow><mrow><mi>r</mi></mrow></msubsup>");
    says(INDEX(NAME("T"), text(QDOT_TEXT_LABEL, "bob_1")), "T_{\\mathrm{bob\\_1}}",
         "<msub><mi>T</mi><mtext>bob_1</mtext></msub>");
}

static void
has_letters(qdot_formula_id id, size_t expected)
{
    size_t letters;

    assert_int_equal(qdot_formula_width(&f, id, &letters), QDOT_OK);
    assert_int_equal(letters, expected);
}

/* Signs, brackets and letters; no marks above, nothing that is not seen. */
static void
letters_are_counted(void **state)
{
    (void)state;
    has_letters(SPAN(NUMBER("12"), sign(QDOT_SIGN_TIMES), DOTS(1, NAME("θ")), sign(QDOT_SIGN_PLUS), NAME("mass")), 8);
    has_letters(APPLY(FUNCTION("sin"), ROUND(OVER(NAME("a"), NAME("b")))), 7);
    has_letters(SPAN(PRIMES(2, NAME("f")), PRIMES(12, NAME("f")), DOTS(5, NAME("q"))), 3 + 5 + 4);
    has_letters(CASES(NAME("a"), NAME("b"), NAME("c")), strlen("{aifbcotherwise") + 1);
    has_letters(TABLE(2, NAME("a"), NAME("b")), 4);
}

static void
memory_that_runs_out_is_told(void **state)
{
    const qdot_formula_id id = OVER(ROOT(NAME("θ")), INDEX(NAME("x"), ROW(NUMBER("1"))));
    qdot_status (*const writers[])(const qdot_formula *, qdot_formula_id, qdot_text *) = {
        qdot_formula_write_latex, qdot_formula_write_mathml};

    (void)state;
    for (size_t i = 0; i < sizeof writers / sizeof *writers; i++) {
        qdot_status status = QDOT_ENOMEM;
        int64_t n;

        for (n = 0; status != QDOT_OK; n++) {
            qdot_text out = {0};

            qdot_memory_fail_at(n);
            status = writers[i](&f, id, &out);
            qdot_memory_fail_at(-1);
            assert_true(status == QDOT_OK || status == QDOT_ENOMEM);
            qdot_text_clear(&out);
        }
        assert_true(n > 2);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(texts_have_their_role),
        TEST(fractions_roots_and_powers_are_drawn),
        TEST(derivatives_have_dots_primes_and_orders),
        TEST(brackets_have_shapes_and_sizes),
        TEST(tables_and_cases_have_cells),
        TEST(a_line_has_slashes_and_superscripts),
        TEST(names_of_several_letters_are_parted_on_pages),
        TEST(index_and_power_are_one_above_the_other_on_pages),
        TEST(flat_brackets_do_not_stretch_on_pages),
        TEST(functions_stand_apart_on_pages),
        TEST(tensors_have_their_indices),
        TEST(letters_are_counted),
        TEST(memory_that_runs_out_is_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
