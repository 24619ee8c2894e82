/* test_print.c -- plain text reads back to the same expression; unicode and LaTeX as books. */
#include "expr/kit.h"
#include "expr/reader.h"

#include "expr/print-formula.h"

static void
says(qdot_expr e, const char *plain, const char *unicode, const char *latex)
{
    assert_int_equal(qdot_pool_check(p.pool), QDOT_OK);
    assert_string_equal(text_of(p.pool, e, QDOT_PLAIN), plain);
    assert_string_equal(text_of(p.pool, e, QDOT_UNICODE), unicode);
    assert_string_equal(text_of(p.pool, e, QDOT_LATEX), latex);
}

/* Whether every bracket is closed. */
static bool
balanced(const char *text)
{
    int round = 0, curly = 0, square = 0;

    for (; *text != '\0'; text++) {
        round += (*text == '(') - (*text == ')');
        curly += (*text == '{') - (*text == '}');
        square += (*text == '[') - (*text == ']');
        if (round < 0 || curly < 0 || square < 0)
            return false;
    }
    return round == 0 && curly == 0 && square == 0;
}

/* Whether every element is closed by its own name, no text being bare. */
static bool
is_mathml(const char *text)
{
    char open[64][16];
    int depth = 0;

    while (*text != '\0') {
        size_t n = strcspn(text, ">");

        if (*text != '<' && depth == 0)
            return false;
        if (*text != '<') {
            text += strcspn(text, "<");
            continue;
        }
        if (text[1] == '/') {
            if (depth == 0 || strlen(open[--depth]) != n - 2 ||
                strncmp(open[depth], text + 2, n - 2) != 0)
                return false;
        } else {
            const size_t name = strcspn(text + 1, " >"); /* attributes stand behind it */

            if (depth == 64 || name > 15)
                return false;
            snprintf(open[depth++], 16, "%.*s", (int)name, text + 1);
        }
        text += n + 1;
    }
    return depth == 0;
}

static void
plain_text_reads_back(void **state)
{
    reader r = {.pool = p.pool, .names = p.symbol, .n_names = SYMBOLS};
    int read = 0;

    (void)state;
    for (int trial = 0; trial < 30000; trial++) {
        formula f = formula_random(4 + (int)random_below(STEPS - 4), 0);
        qdot_expr e = formula_build(&f, &p), back;
        const char *text;

        if (qdot_pool_check(p.pool) != QDOT_OK || qdot_expr_size(p.pool, e) > 500)
            continue;
        text = text_of(p.pool, e, QDOT_PLAIN);
        assert_true(balanced(text));
        back = read_text(&r, text);
        assert_int_equal(qdot_pool_check(p.pool), QDOT_OK);
        if (back != e)
            fail_msg("%s is read as %s", text, text_of(p.pool, back, QDOT_PLAIN));
        assert_true(balanced(text_of(p.pool, e, QDOT_UNICODE)));
        assert_true(balanced(text_of(p.pool, e, QDOT_LATEX)));
        if (qdot_expr_size(p.pool, e) < 50)
            assert_true(is_mathml(text_of(p.pool, e, QDOT_MATHML)));
        read++;
    }
    assert_true(read > 10000);
}

/* The same steps in another pool, where every id is another one. */
static void
text_does_not_depend_on_ids(void **state)
{
    (void)state;
    for (int trial = 0; trial < 3000; trial++) {
        formula f = formula_random(STEPS, 0), other = formula_random(STEPS, 0);
        qdot_expr e = formula_build(&f, &p), again;
        qdot_status status = qdot_pool_check(p.pool);
        place q;

        if (status != QDOT_OK || qdot_expr_size(p.pool, e) > 500)
            continue;
        place_open(&q);
        (void)formula_build(&other, &q);
        (void)!qdot_pool_check(q.pool);
        again = formula_build(&f, &q);
        assert_int_equal(qdot_pool_check(q.pool), QDOT_OK);
        assert_string_equal(text_of(p.pool, e, QDOT_PLAIN),
                            text_of(q.pool, again, QDOT_PLAIN));
        place_close(&q);
    }
}

static void
kinetic_energy_is_written_as_in_a_book(void **state)
{
    qdot_expr e =
        times(QDOT_HALF, times(p.symbol[2], qdot_pow_int(p.pool, p.symbol[6], 2)));

    (void)state;
    says(e, "1/2*m*x'^2", "½ m x\u0307²", "\\frac{1}{2} m \\dot{x}^{2}");
    e = qdot_symbol_jet(p.pool, p.symbol[7], 1);
    says(times(e, qdot_symbol_jet(p.pool, p.symbol[7], 2)), "theta'*theta''",
         "θ\u0307 θ\u0308", "\\dot{\\theta} \\ddot{\\theta}");
}

static void
exact_decimals_stay_exact(void **state)
{
    (void)state;
    says(times(qdot_expr_decimal(p.pool, "9.81", 4), p.symbol[2]), "9.81*m",
         "9.81 m", "9.81 m");
    says(number(-3, 4), "-3/4", "−¾", "-\\frac{3}{4}");
}

static void
roots_have_their_sign(void **state)
{
    qdot_expr x = p.symbol[5], sum = qdot_add(p.pool, x, p.symbol[7]);

    (void)state;
    says(qdot_sqrt(p.pool, number(2, 1)), "sqrt(2)", "√2", "\\sqrt{2}");
    says(qdot_sqrt(p.pool, number(8, 1)), "2*sqrt(2)", "2 √2", "2 \\sqrt{2}");
    says(qdot_sqrt(p.pool, number(1, 2)), "1/2*sqrt(2)", "½ √2", "\\frac{1}{2} \\sqrt{2}");
    says(times(number(3, 7), qdot_sqrt(p.pool, number(2, 1))), "3/7*sqrt(2)", "3/7·√2",
         "\\frac{3}{7} \\cdot \\sqrt{2}");
    says(qdot_sqrt(p.pool, sum), "sqrt(x + theta)", "√(x + θ)", "\\sqrt{x + \\theta}");
    says(qdot_pow(p.pool, x, number(-1, 2)), "1/sqrt(x)", "1/√x", "\\frac{1}{\\sqrt{x}}");
    says(qdot_pow(p.pool, x, number(3, 2)), "x^(3/2)", "x^(3/2)", "x^{3/2}");
}

static qdot_expr
root(qdot_expr e)
{
    return qdot_sqrt(p.pool, e);
}

/* What is positive comes apart under a root, and is written as one. */
static void
one_root_is_written(void **state)
{
    qdot_expr m = p.symbol[2], k = qdot_symbol_get(p.pool, QDOT_PARAM, "K"),
              x = p.symbol[5];
    qdot_expr all[3], e;
    reader r = {.pool = p.pool, .names = all, .n_names = 3};

    (void)state;
    qdot_symbol_domain(p.pool, k, QDOT_ZERO, true, QDOT_NIL, false);
    all[0] = m, all[1] = k, all[2] = x;
    says(root(qdot_div(p.pool, k, m)), "sqrt(K/m)", "√(K/m)", "\\sqrt{\\frac{K}{m}}");
    says(root(qdot_div(p.pool, times(number(2, 1), k), times(number(3, 1), m))),
         "sqrt(2*K/(3*m))", "√(2 K/(3 m))", "\\sqrt{\\frac{2 K}{3 m}}");
    says(root(qdot_div(p.pool, k, qdot_pow_int(p.pool, m, 3))), "sqrt(K/m^3)", "√(K/m³)",
         "\\sqrt{\\frac{K}{m^{3}}}");
    says(qdot_pow(p.pool, times(k, m), number(-1, 2)), "1/sqrt(m*K)", "1/√(m K)",
         "\\frac{1}{\\sqrt{m K}}");
    says(times(number(1, 2), root(times(k, x))), "1/2*sqrt(K*x)", "½ √(K x)",
         "\\frac{1}{2} \\sqrt{K x}");
    for (int trial = 0; trial < 20000; trial++) {
        e = number((int64_t)random_below(9) - 4, 1 + (int64_t)random_below(12));
        for (int i = 0; i < 4; i++) {
            qdot_expr b = all[random_below(3)];

            if (random_below(3) == 0)
                b = qdot_add(p.pool, all[random_below(3)],
                             times(number(2, 3), all[random_below(3)]));
            if (random_below(5) == 0)
                b = number(1 + (int64_t)random_below(30), 1 + (int64_t)random_below(9));
            e = times(e, qdot_pow(p.pool, b, number((int64_t)random_below(9) - 4, 2)));
        }
        if (random_below(2))
            e = qdot_add(p.pool, e, x);
        if (qdot_pool_check(p.pool) != QDOT_OK)
            continue;
        if (read_text(&r, text_of(p.pool, e, QDOT_PLAIN)) != e)
            fail_msg("%s is read as another", text_of(p.pool, e, QDOT_PLAIN));
        assert_true(is_mathml(text_of(p.pool, e, QDOT_MATHML)));
    }
}

static void
signs_are_those_of_a_book(void **state)
{
    qdot_expr a = p.symbol[0], b = p.symbol[1], x = p.symbol[5], theta = p.symbol[7];
    qdot_expr d = qdot_sub(p.pool, qdot_fun1(p.pool, QDOT_COSH, x),
                           qdot_fun1(p.pool, QDOT_COS, theta));
    qdot_expr c = qdot_sub(p.pool, QDOT_ONE, times(a, qdot_fun1(p.pool, QDOT_COS, x)));

    (void)state;
    assert_prints(p.pool, qdot_pow_int(p.pool, d, 2), "(cosh(x) - cos(theta))^2");
    assert_prints(p.pool, qdot_pow_int(p.pool, d, -1), "1/(cosh(x) - cos(theta))");
    assert_prints(p.pool, qdot_pow_int(p.pool, qdot_sub(p.pool, b, a), 3), "(b - a)^3");
    assert_prints(p.pool, qdot_pow_int(p.pool, qdot_sub(p.pool, b, a), 2), "(a - b)^2");
    assert_prints(p.pool, c, "1 - a*cos(x)");
    assert_prints(p.pool, qdot_neg(p.pool, c), "a*cos(x) - 1");
    assert_prints(p.pool, qdot_add(p.pool, b, times(a, qdot_fun1(p.pool, QDOT_COS, x))),
                  "b + a*cos(x)");
    assert_prints(p.pool, qdot_add(p.pool, b, times(a, x)), "a*x + b");
}

static void
mathml_is_presentation(void **state)
{
    qdot_expr x = p.symbol[5], theta = p.symbol[7], e;

    (void)state;
    e = times(QDOT_HALF, qdot_pow_int(p.pool, qdot_symbol_jet(p.pool, theta, 1), 2));
    assert_string_equal(
        text_of(p.pool, e, QDOT_MATHML),
        "<mfrac><mn>1</mn><mn>2</mn></mfrac><mo>&#x2062;</mo><msup><mrow>"
        "<mover accent=\"true\"><mi>θ</mi><mo>˙</mo></mover></mrow><mrow><mn>2</mn></mrow>"
        "</msup>");
    e = qdot_rel(p.pool, QDOT_LT, qdot_sqrt(p.pool, x),
                 qdot_fun1(p.pool, QDOT_SIN, theta));
    assert_string_equal(
        text_of(p.pool, e, QDOT_MATHML),
        "<msqrt><mi>x</mi></msqrt><mo>&lt;</mo><mi>sin</mi><mo>&#x2061;</mo>"
        "<mrow><mo>(</mo><mi>θ</mi><mo>)</mo></mrow>");
    assert_string_equal(
        text_of(p.pool, qdot_symbol_of(p.pool, QDOT_MOMENTUM, theta), QDOT_MATHML),
        "<msub><mi>p</mi><mi>θ</mi></msub>");
}

static void
quotients_are_bracketed_where_they_must(void **state)
{
    qdot_expr a = p.symbol[0], b = p.symbol[1], x = p.symbol[5];
    qdot_expr sum = qdot_add(p.pool, a, b), quotient = qdot_div(p.pool, a, b);

    (void)state;
    says(qdot_div(p.pool, a, times(number(2, 1), x)), "1/2*a/x", "½ a/x",
         "\\frac{a}{2 x}");
    says(qdot_div(p.pool, QDOT_ONE, times(number(2, 1), x)), "1/(2*x)", "1/(2 x)",
         "\\frac{1}{2 x}");
    says(qdot_div(p.pool, x, times(a, b)), "x/(a*b)", "x/(a b)", "\\frac{x}{a b}");
    says(qdot_div(p.pool, x, sum), "x/(a + b)", "x/(a + b)", "\\frac{x}{a + b}");
    says(qdot_pow(p.pool, quotient, x), "(a/b)^x", "(a/b)^x",
         "\\left(\\frac{a}{b}\\right)^{x}");
    says(qdot_neg(p.pool, quotient), "-a/b", "−a/b", "-\\frac{a}{b}");
    says(qdot_pow_int(p.pool, sum, -2), "1/(a + b)^2", "1/(a + b)²",
         "\\frac{1}{\\left(a + b\\right)^{2}}");
}

static void
functions_are_named_as_in_a_book(void **state)
{
    qdot_expr theta = p.symbol[7], e = qdot_fun1(p.pool, QDOT_SIN, theta);

    (void)state;
    says(e, "sin(theta)", "sin(θ)", "\\sin\\left(\\theta\\right)");
    says(qdot_pow_int(p.pool, e, 2), "sin(theta)^2", "sin²(θ)",
         "\\sin^{2}\\left(\\theta\\right)");
    says(qdot_pow_int(p.pool, e, -1), "1/sin(theta)", "1/sin(θ)",
         "\\frac{1}{\\sin\\left(\\theta\\right)}");
    says(qdot_fun1(p.pool, QDOT_ATAN, theta), "atan(theta)", "atan(θ)",
         "\\arctan\\left(\\theta\\right)");
    says(qdot_fun1(p.pool, QDOT_ASINH, theta), "asinh(theta)", "asinh(θ)",
         "\\operatorname{asinh}\\left(\\theta\\right)");
    says(qdot_fun1(p.pool, QDOT_ABS, p.symbol[5]), "abs(x)", "abs(x)",
         "\\left|x\\right|");
}

static void
families_are_subscripts(void **state)
{
    qdot_expr theta1 = qdot_symbol_get(p.pool, QDOT_COORD, "theta1");
    qdot_expr theta2 = qdot_symbol_get(p.pool, QDOT_COORD, "theta[2]");
    qdot_expr mass = qdot_symbol_get(p.pool, QDOT_PARAM, "mass[1]");

    (void)state;
    says(theta1, "theta1", "θ₁", "\\theta_{1}");
    says(qdot_symbol_jet(p.pool, theta2, 1), "theta[2]'", "θ\u0307₂",
         "\\dot{\\theta}_{2}");
    says(mass, "mass[1]", "mass₁", "\\mathrm{mass}_{1}");
    says(qdot_symbol_of(p.pool, QDOT_DELTA, theta1), "delta[theta1]", "δθ₁",
         "\\delta \\theta_{1}");
    says(qdot_symbol_of(p.pool, QDOT_DIFFERENTIAL, theta1), "dtheta1", "dθ₁",
         "d\\theta_{1}");
}

static void
derivatives_of_functions_are_written_in_each_style(void **state)
{
    qdot_expr s = qdot_symbol_get(p.pool, QDOT_COORD, "s"), st[] = {s, QDOT_T},
              a = p.symbol[0];
    qdot_expr at[] = {a, QDOT_T}, e;
    uint32_t f, g;

    (void)state;
    assert_int_equal(qdot_ufun_declare(p.pool, "f", 1, &s, &f), QDOT_OK);
    assert_int_equal(qdot_ufun_declare(p.pool, "phi", 2, st, &g), QDOT_OK);
    says(qdot_ufun_apply(p.pool, f, &s, NULL), "f(s)", "f(s)", "f(s)");
    says(qdot_ufun_apply(p.pool, f, &s, (uint32_t[]){2}), "diff(f(s), s, 2)", "f′′(s)",
         "f''(s)");
    says(qdot_ufun_apply(p.pool, f, &a, (uint32_t[]){1}), "f'(a)", "f′(a)", "f'(a)");
    says(qdot_ufun_apply(p.pool, f, &a, (uint32_t[]){4}), "subs(diff(f(s), s, 4), s = a)",
         "f⁽⁴⁾(a)", "f^{(4)}(a)");
    e = qdot_ufun_apply(p.pool, g, st, (uint32_t[]){1, 0});
    says(e, "diff(phi(s, t), s)", "diff(φ(s, t), s)", "\\frac{\\partial \\phi}{\\partial s}");
    says(qdot_pow_int(p.pool, e, 2), "diff(phi(s, t), s)^2", "diff(φ(s, t), s)²",
         "\\left(\\frac{\\partial \\phi}{\\partial s}\\right)^{2}");
    says(qdot_ufun_apply(p.pool, g, st, (uint32_t[]){2, 1}),
         "diff(diff(phi(s, t), s, 2), t)", "diff(diff(φ(s, t), s, 2), t)",
         "\\frac{\\partial^{3} \\phi}{\\partial s^{2} \\partial t}");
    says(qdot_ufun_apply(p.pool, g, at, (uint32_t[]){1, 0}),
         "subs(diff(phi(s, t), s), s = a)", "subs(diff(φ(s, t), s), s = a)",
         "\\frac{\\partial \\phi}{\\partial s}(a, t)");
}

static void
undefined_functions_read_back(void **state)
{
    qdot_expr s = qdot_symbol_get(p.pool, QDOT_COORD, "s"), st[] = {s, QDOT_T},
              names[SYMBOLS + 1];
    uint32_t u[2];
    reader r = {.pool = p.pool,
                .names = names,
                .n_names = SYMBOLS + 1,
                .functions = u,
                .n_functions = 2};

    (void)state;
    memcpy(names, p.symbol, sizeof p.symbol);
    names[SYMBOLS] = s;
    assert_int_equal(qdot_ufun_declare(p.pool, "f", 1, &s, &u[0]), QDOT_OK);
    assert_int_equal(qdot_ufun_declare(p.pool, "g", 2, st, &u[1]), QDOT_OK);
    for (int trial = 0; trial < 3000; trial++) {
        formula x = formula_random(5, SMOOTH), y = formula_random(4, SMOOTH);
        qdot_expr args[] = {formula_build(&x, &p), formula_build(&y, &p)}, e;
        uint32_t orders[] = {random_below(5), random_below(3)}, which = random_below(2);

        if (qdot_pool_check(p.pool) != QDOT_OK)
            continue;
        if (random_below(2))
            args[0] = s;
        if (random_below(2))
            args[1] = QDOT_T;
        e = qdot_ufun_apply(p.pool, u[which], args, orders);
        e = qdot_add(p.pool, qdot_pow_int(p.pool, e, (int64_t)random_below(5) - 2),
                     p.symbol[5]);
        assert_int_equal(read_text(&r, text_of(p.pool, e, QDOT_PLAIN)), e);
    }
}

static void
values_of_every_kind_are_written(void **state)
{
    qdot_expr x = p.symbol[5], a = p.symbol[0], u[] = {x, a, QDOT_ZERO, QDOT_ONE}, e,
              less;

    (void)state;
    less = qdot_rel(p.pool, QDOT_LE, x, a);
    says(less, "x <= a", "x ≤ a", "x \\le a");
    e = qdot_logic(p.pool, QDOT_OR, 2,
                   (qdot_expr[]){less, qdot_rel(p.pool, QDOT_LT, a, QDOT_ZERO)});
    says(qdot_logic(p.pool, QDOT_NOT, 1, &e), "not (x <= a or a < 0)",
         "not (x ≤ a or a < 0)", "\\neg \\left(x \\le a \\vee a < 0\\right)");
    says(qdot_vector(p.pool, 4, u), "(x, a, 0, 1)", "(x, a, 0, 1)",
         "\\left(x, a, 0, 1\\right)");
    says(qdot_matrix(p.pool, 2, 2, u), "[x, a; 0, 1]", "[x, a; 0, 1]",
         "\\begin{pmatrix}x & a \\\\ 0 & 1\\end{pmatrix}");
    assert_prints(p.pool, qdot_list(p.pool, 0, NULL), "[]");
}

static void
nothing_cannot_be_printed(void **state)
{
    qdot_text out = {0};

    (void)state;
    assert_int_equal(qdot_print(p.pool, QDOT_NIL, QDOT_PLAIN, &out), QDOT_EINVAL);
    /* where the pool failed, as after Ctrl-C, that is why */
    qdot_pool_budget(p.pool, 0);
    assert_int_equal(qdot_print(p.pool, qdot_fun1(p.pool, QDOT_SIN, QDOT_PI), QDOT_PLAIN, &out), QDOT_ELIMIT);
    qdot_pool_budget(p.pool, UINT64_MAX);
    assert_int_equal(qdot_pool_check(p.pool), QDOT_ELIMIT);
    qdot_text_clear(&out);
}

/* What stands twice is shared in each formula, the caller's and that of texts, whichever was made before; a failure
 * leaves nothing half done behind. */
static void
formulas_share_what_stands_twice(void **state)
{
    const qdot_style styles[] = {QDOT_PLAIN, QDOT_UNICODE, QDOT_LATEX, QDOT_MATHML};

    (void)state;
    for (int trial = 0; trial < 2000; trial++) {
        formula spec = formula_random(4 + (int)random_below(STEPS - 4), 0);
        qdot_expr e = formula_build(&spec, &p);
        const qdot_style style = styles[trial % 4];
        qdot_formula f = {0};
        qdot_text alone = {0}, twice = {0};
        qdot_formula_id all;

        if (qdot_pool_check(p.pool) != QDOT_OK || qdot_expr_size(p.pool, e) > 200)
            continue;
        assert_int_equal(qdot_print(p.pool, e, style, &alone), QDOT_OK);
        if (trial % 3 == 0) {
            qdot_memory_fail_at((int64_t)random_below(12));
            qdot_status status = qdot_print(p.pool, e, styles[(trial + 1) % 4], &twice);
            assert_true(status == QDOT_OK || status == QDOT_ENOMEM);
            qdot_memory_fail_at(-1);
            qdot_text_clear(&twice);
        }
        all = qdot_formula_new(&f, QDOT_FORMULA_SPAN, 0, 0);
        for (int k = 0; k < 2; k++) {
            assert_int_equal(
                qdot_print_formula(p.pool, e, QDOT_NIL, qdot_print_notation(style), &f, all), QDOT_OK);
            assert_int_equal(qdot_print(p.pool, e, style, &twice), QDOT_OK);
            assert_string_equal(qdot_text_str(&twice), qdot_text_str(&alone));
            qdot_text_truncate(&twice, 0);
        }
        assert_int_equal(qdot_print_written(&f, all, style, &twice), QDOT_OK);
        assert_int_equal(twice.n, 2 * alone.n);
        assert_memory_equal(twice.at, alone.at, alone.n);
        assert_memory_equal(twice.at + alone.n, alone.at, alone.n);
        qdot_text_clear(&alone);
        qdot_text_clear(&twice);
        qdot_formula_clear(&f);
    }
}

/* A number or a name alone is printed whole or not at all, and so is what is printed next. */
static void
a_name_alone_is_whole_or_no_memory(void **state)
{
    const qdot_expr leaf[] = {qdot_expr_ratio(p.pool, 22, 7), qdot_symbol_get(p.pool, QDOT_PARAM, "alpha")};
    const char *const text[] = {"22/7", "alpha"};

    (void)state;
    for (size_t i = 0; i < 2; i++)
        for (int64_t n = 1; n < 40; n++) {
            qdot_text failed = {0}, next = {0};
            qdot_status status;

            qdot_memory_fail_at(n);
            status = qdot_print(p.pool, leaf[i], QDOT_PLAIN, &failed);
            qdot_memory_fail_at(-1);
            if (status == QDOT_OK)
                assert_string_equal(qdot_text_str(&failed), text[i]);
            else
                assert_int_equal(status, QDOT_ENOMEM);
            assert_int_equal(qdot_print(p.pool, leaf[i], QDOT_PLAIN, &next), QDOT_OK);
            assert_string_equal(qdot_text_str(&next), text[i]);
            qdot_text_clear(&failed);
            qdot_text_clear(&next);
        }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(plain_text_reads_back),
        TEST(text_does_not_depend_on_ids),
        TEST(kinetic_energy_is_written_as_in_a_book),
        TEST(exact_decimals_stay_exact),
        TEST(roots_have_their_sign),
        TEST(one_root_is_written),
        TEST(signs_are_those_of_a_book),
        TEST(mathml_is_presentation),
        TEST(quotients_are_bracketed_where_they_must),
        TEST(functions_are_named_as_in_a_book),
        TEST(families_are_subscripts),
        TEST(derivatives_of_functions_are_written_in_each_style),
        TEST(undefined_functions_read_back),
        TEST(values_of_every_kind_are_written),
        TEST(nothing_cannot_be_printed),
        TEST(formulas_share_what_stands_twice),
        TEST(a_name_alone_is_whole_or_no_memory),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
