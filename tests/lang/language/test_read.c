/* test_read.c -- the grammar: precedence, brackets, readers of operands, errors. */
#include "expr/node.h"
#include "expr/symbol.h"
#include "lang/reading.h"

#include "lang/language/compiled.h"

static void
precedence_is_the_contracts(void **state)
{
    reading r;

    (void)state;
    reading_open(&r);
    assert_same(&r, "2 + 3*4^2", "50");
    assert_same(&r, "-2^2", "0 - 4");
    assert_same(&r, "2^-2", "1/4");
    assert_same(&r, "2^3^2", "512");
    assert_same(&r, "2**3", "8");
    assert_same(&r, "2^-1^2", "1/2");
    assert_same(&r, "7 - 2 - 1", "4");
    assert_same(&r, "24/4/3*2", "4");
    assert_same(&r, "2*-3", "-6");
    assert_same(&r, "- - 2", "+2");
    assert_same(&r, "-m*g", "0 - (m*g)");
    assert_same(&r, "m - g + s", "(m + s) - g");
    assert_same(&r, "m/g/s", "m/(g*s)");
    assert_same(&r, "not m < g and g < s or s < m",
                "((not (m < g)) and (g < s)) or (s < m)");
    assert_same(&r, "m < g < s", "m < g and g < s");
    assert_same(&r, "m > g >= 0", "g < m and 0 <= g");
    assert_same(&r, "m == g", "m = g");
    assert_same(&r, "9.81 - 981/100", "0");
    assert_same(&r, "1e-3", "1/1000");
    reading_close(&r);
}

static void
long_sums_and_products_are_gathered(void **state)
{
    qdot_text sum = {0}, product = {0};
    reading r;

    (void)state;
    reading_open(&r);
    for (int i = 0; i < 50; i++) {
        qdot_text_add(&sum, i % 2 == 0 ? "m + " : "g - ");
        qdot_text_add(&product, i % 2 == 0 ? "m*" : "g/");
    }
    qdot_text_add(&sum, "1");
    qdot_text_add(&product, "s");
    /* m + g - m + g - m + g ... - 1: the first m is added, the other 24 taken off */
    assert_same(&r, sum.at, "25*g - 23*m - 1");
    /* m*g/m*g/m*g ... /s */
    assert_same(&r, product.at, "g^25/m^23/s");
    qdot_text_clear(&sum);
    qdot_text_clear(&product);
    reading_close(&r);
}

static void
brackets_make_vectors_matrices_lists(void **state)
{
    reading r;
    qdot_expr e;

    (void)state;
    reading_open(&r);
    assert_int_equal(reading_value(&r, "(m, g)", &e), QDOT_OK);
    assert_int_equal(qdot_expr_kind(r.session->pool, e), QDOT_VEC);
    assert_int_equal(reading_value(&r, "(m)", &e), QDOT_OK);
    assert_int_equal(qdot_expr_kind(r.session->pool, e), QDOT_SYM);
    assert_int_equal(reading_value(&r, "[m, g; s, 1]", &e), QDOT_OK);
    assert_int_equal(qdot_expr_kind(r.session->pool, e), QDOT_MAT);
    assert_int_equal(qdot_expr_node(r.session->pool, e)->op, 2);
    assert_int_equal(reading_value(&r, "[m]", &e), QDOT_OK);
    assert_int_equal(qdot_expr_kind(r.session->pool, e), QDOT_LIST);
    assert_int_equal(reading_value(&r, "[]", &e), QDOT_OK);
    assert_int_equal(qdot_expr_count(r.session->pool, e), 0);
    assert_same(&r, "(m, g, s)[2]", "g");
    assert_same(&r, "[1, 2; 3, 4][2, 1]", "3");
    assert_same(&r, "[[1, 2], [3, 4]][2][1]", "3");
    assert_same(&r, "[1, 2; 3, 4]*(5, 6)", "(17, 39)");
    assert_fails(&r, "[1, 2; 3]", QDOT_ETYPE, 8, "one length", "");
    assert_fails(&r, "()", QDOT_ESYNTAX, 1, "expected an expression, found `)`", "");
    reading_close(&r);
}

/* 100,000 brackets, of every kind; a long line. */
static void
depth_and_length_break_nothing(void **state)
{
    static const struct {
        const char *open, *close;
    } kinds[] = {{"(", ")"},       {"[", "]"},    {"-(", ")"},
                 {"(1, ", ")[2]"}, {"sin(", ")"}, {"if(1 < 2, ", ", 0)"},
                 {"2^-", ""},      {"not ", ""}};
    enum { DEPTH = 100000 };
    qdot_text text = {0};
    reading r;
    qdot_expr e;

    (void)state;
    reading_open(&r);
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        bool power = strcmp(kinds[k].open, "2^-") == 0;

        qdot_text_truncate(&text, 0);
        for (int i = 0; i < (power ? 3 : DEPTH); i++)
            qdot_text_add(&text, kinds[k].open);
        qdot_text_add(&text, strcmp(kinds[k].open, "not ") == 0 ? "m < g" : "m");
        for (int i = 0; i < (power ? 3 : DEPTH); i++)
            qdot_text_add(&text, kinds[k].close);
        if (reading_value(&r, text.at, &e) != QDOT_OK)
            fail_msg("%s: %s", kinds[k].open, qdot_text_str(&r.message));
    }
    qdot_text_truncate(&text, 0);
    for (int i = 0; i < DEPTH; i++)
        qdot_text_format(&text, "%d*m + ", i);
    qdot_text_add(&text, "g");
    assert_int_equal(reading_value(&r, text.at, &e), QDOT_OK);
    assert_int_equal(qdot_expr_count(r.session->pool, e), 5); /* 0, m, c, g, 1 */
    qdot_text_clear(&text);
    reading_close(&r);
}

static void
missing_times_is_pointed_at(void **state)
{
    reading r;

    (void)state;
    reading_open(&r);
    assert_fails(&r, "2 m", QDOT_ESYNTAX, 1, "`*` is missing", "write 2*m");
    assert_fails(&r, "2m", QDOT_ESYNTAX, 1, "`*` is missing", "write 2*m");
    assert_fails(&r, "(2 m)", QDOT_ESYNTAX, 2, "`*` is missing", "write 2*m");
    assert_fails(&r, "m g", QDOT_ESYNTAX, 1, "`*` is missing", "write m*g");
    assert_fails(&r, "m 2", QDOT_ESYNTAX, 1, "`*` is missing", "write m*2");
    assert_fails(&r, "2(m + 1)", QDOT_ESYNTAX, 1, "`*` is missing", "write 2*(");
    assert_fails(&r, "m (g + 1)", QDOT_ESYNTAX, 1, "`*` is missing", "write m*(");
    assert_fails(&r, "(m)(g)", QDOT_ESYNTAX, 3, "`*` is missing", "write (m)*(g)");
    assert_fails(&r, "theta' m", QDOT_ESYNTAX, 6, "`*` is missing", "");
    assert_fails(&r, "m(g)", QDOT_ESYNTAX, 0, "`m` is not a function", "m*(...)");
    assert_fails(&r, "m nonsense", QDOT_ESYNTAX, 2, "found `nonsense`", "`*`");
    reading_close(&r);
}

static void
forms_of_other_systems_have_hints(void **state)
{
    reading r;

    (void)state;
    reading_open(&r);
    assert_fails(&r, "sin^2(m*g)", QDOT_ESYNTAX, 0, "is a function", "write sin(m*g)^2");
    assert_fails(&r, "Sin[m]", QDOT_ENAME, 0, "unknown name `Sin`", "write sin(m)");
    assert_fails(&r, "Sin(m)", QDOT_ENAME, 0, "unknown function `Sin`", "write sin(m)");
    assert_fails(&r, "sin[m]", QDOT_ESYNTAX, 0, "is a function", "write sin(m)");
    assert_fails(&r, "D(m^2, m)", QDOT_ENAME, 0, "`D`", "write diff(m^2, m)");
    assert_fails(&r, "1 + thetadot", QDOT_ENAME, 4, "`thetadot`", "write theta'");
    assert_fails(&r, "theta_ddot", QDOT_ENAME, 0, "`theta_ddot`", "write theta''");
    assert_fails(&r, "sqrt m", QDOT_ESYNTAX, 0, "is a function", "write sqrt(m)");
    assert_fails(&r, "ln(m)", QDOT_ENAME, 0, "`ln`", "write log(m)");
    assert_fails(&r, "m < g && g < s", QDOT_ESYNTAX, 6, "`&&`", "write `and`");
    assert_fails(&r, "m != g", QDOT_ESYNTAX, 2, "`!=`", "`not (1 = 2)` is a condition");
    assert_fails(&r, "m % g", QDOT_ESYNTAX, 2, "`%`", "mod(a, b)");
    assert_fails(&r, "5. + m", QDOT_ESYNTAX, 1, "decimal point", "5.0");
    /* a declared name wins over the hint */
    declare_param(&r, "D");
    declare_param(&r, "Sin");
    assert_fails(&r, "D(m)", QDOT_ESYNTAX, 0, "not a function", "D*(");
    assert_same(&r, "Sin*2", "2*Sin");
    reading_close(&r);
}

static void
unknown_names_get_the_nearest(void **state)
{
    reading r;

    (void)state;
    reading_open(&r);
    assert_fails(&r, "m*thta", QDOT_ENAME, 2, "unknown name `thta`",
                 "did you mean `theta`?");
    assert_fails(&r, "simplfy(m)", QDOT_ENAME, 0, "unknown function `simplfy`",
                 "`simplify`");
    assert_fails(&r, "mass_matrx", QDOT_ENAME, 0, "unknown name", "`mass_matrix`");
    assert_fails(&r, "qq[1]", QDOT_ENAME, 0, "unknown name `qq[1]`", "`q[1]`");
    assert_fails(&r, "q[3]", QDOT_ENAME, 0, "`q[3]` is not declared", "");
    assert_fails(&r, "q", QDOT_ENAME, 0, "is a family", "q[1]");
    reading_close(&r);
}

static void
faults_stand_at_their_token(void **state)
{
    reading r;

    (void)state;
    reading_open(&r);
    assert_fails(&r, "m + 1/0", QDOT_EDOMAIN, 5, "division by zero", "");
    assert_fails(&r, "m + (1, 2)", QDOT_ETYPE, 2, "", "");
    assert_fails(&r, "m - g + 1 - (1, 2) + 5", QDOT_ETYPE, 10, "", "");
    assert_fails(&r, "2*(1, 2)*(3, 4)*s", QDOT_ETYPE, 8, "", "");
    assert_fails(&r, "m < (1, 2)", QDOT_ETYPE, 2, "compares numbers, not a vector", "");
    assert_fails(&r, "m and g", QDOT_ETYPE, 2, "joins conditions, not a number", "");
    assert_fails(&r, "m = g = s", QDOT_ESYNTAX, 6, "two relations", "brackets");
    assert_fails(&r, "m +", QDOT_ESYNTAX, 3, "found the end", "");
    assert_fails(&r, "m + )", QDOT_ESYNTAX, 4, "closes nothing", "");
    assert_fails(&r, "(m, g", QDOT_ESYNTAX, 0, "never closed", "");
    assert_fails(&r, "m'", QDOT_ETYPE, 0, "parameter", "ddt(...)");
    assert_fails(&r, "(m*theta)'", QDOT_ESYNTAX, 9, "prime", "ddt(...)");
    assert_fails(&r, "log(0)", QDOT_EDOMAIN, 0, "", "");
    assert_fails(&r, "diff(m)", QDOT_ETYPE, 0, "2 or 3 arguments, not 1", "diff(e, x)");
    assert_fails(&r, "sum(m, 1, 2)", QDOT_ESYNTAX, 0, "sum(EXPR, k, a, b)", "");
    assert_fails(&r, "if(m, 1, 2)", QDOT_ETYPE, 0, "condition", "");
    assert_fails(&r, "\"text\"", QDOT_ESYNTAX, 0, "text in quotes", "");
    reading_close(&r);
}

static void
ranges_need_a_run(void **state)
{
    static const char *const words[] = {
        "drift(m)", "max(m, 0..3)", "mean(m, 0..3)"};
    reading r;
    qdot_expr e;

    (void)state;
    reading_open(&r);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        assert_int_equal(reading_value(&r, words[i], &e), QDOT_EINVAL);
        assert_non_null(strstr(qdot_text_str(&r.message), "there is no run yet"));
    }
    reading_close(&r);
}

/* --- readers of operands ------------------------------------------------------------ */

static void
begin(reading *r, const char *text, qdot_source **source, qdot_cursor *c)
{
    size_t at;

    assert_int_equal(qdot_source_new("a.lag", text, strlen(text), source, &at), QDOT_OK);
    *c = (qdot_cursor){
        .session = r->session, .source = *source, .at = (*source)->tokens.at};
}

static void
operands_end_before_option_words(void **state)
{
    qdot_source *source;
    qdot_compiled program;
    qdot_cursor c;
    qdot_expr e;
    reading r;
    const char *name;

    (void)state;
    reading_open(&r);
    begin(&r, "m*g at (m, g) rest 2..m*3; bob[1+1]; bob[1/2]", &source, &c);
    assert_int_equal(qdot_read_scalar(&c, &e), QDOT_OK);
    assert_true(qdot_cursor_accept_word(&c, "at"));
    assert_int_equal(qdot_compiled_parse(&c, QDOT_PARSE_SIDE, &program), QDOT_OK);
    assert_int_equal(qdot_compiled_point(&c, &program, &e), QDOT_OK);
    qdot_compiled_free(&program);
    assert_int_equal(qdot_expr_kind(r.session->pool, e), QDOT_VEC);
    assert_true(qdot_cursor_accept_word(&c, "rest"));
    assert_int_equal(qdot_read_scalar(&c, &e), QDOT_OK);
    assert_true(qdot_cursor_accept_op(&c, ".."));
    assert_int_equal(qdot_read_scalar(&c, &e), QDOT_OK);
    assert_int_equal(qdot_cursor_expect_end(&c), QDOT_OK);
    c.at++;
    assert_int_equal(qdot_read_name(&c, &name), QDOT_OK);
    assert_string_equal(name, "bob[2]");
    assert_true(qdot_cursor_is_end(&c));
    c.at++;
    assert_int_equal(qdot_read_name(&c, &name), QDOT_ETYPE);
    qdot_source_free(source);

    begin(&r, "(1, 2); theta = 1", &source, &c);
    assert_int_equal(qdot_read_scalar(&c, &e), QDOT_ETYPE);
    assert_int_equal(c.error_at, 0);
    c.at++;
    assert_int_equal(qdot_compiled_parse(&c, QDOT_PARSE_SIDE, &program), QDOT_OK);
    qdot_compiled_free(&program);
    assert_true(qdot_cursor_is_op(&c, "="));
    qdot_source_free(source);

    begin(&r, "mass", &source, &c);
    assert_int_equal(qdot_cursor_expect_op(&c, ":"), QDOT_ESYNTAX);
    assert_string_equal(qdot_last_error()->message, "expected `:`, found `mass`");
    qdot_source_free(source);

    begin(&r, "m mas 3", &source, &c);
    assert_int_equal(qdot_read_scalar(&c, &e), QDOT_OK);
    assert_int_equal(qdot_cursor_expected(&c, "`mass` or `at`"), QDOT_ESYNTAX);
    assert_string_equal(qdot_last_error()->message,
                        "expected `mass` or `at`, found `mas`");
    assert_string_equal(qdot_last_error()->hint, "did you mean `mass`?");
    qdot_source_free(source);
    reading_close(&r);
}

/* Every prefix and every change of one byte gives a value or an error, no crash. */
static void
mangled_texts_are_answered(void **state)
{
    static const char text[] =
        "sum(q[k]'^2/2, k, 1, 2) + if(m < g, [1, 2; 3, 4][1, 2], x'(s))"
        "*diff(y(s, t), s) - (m, g)[1] and %3 .. a.(theta)";
    static const char bytes[] = "()[]{},;'.%^*/+-<>=0ak \n\\\"#!&|";
    char changed[sizeof text];
    reading r;
    qdot_expr e;

    (void)state;
    reading_open(&r);
    for (size_t i = 0; i < sizeof text - 1; i++) {
        memcpy(changed, text, sizeof text);
        changed[i] = '\0';
        (void)!reading_value(&r, changed, &e);
        for (size_t k = 0; k < sizeof bytes - 1; k++) {
            memcpy(changed, text, sizeof text);
            changed[i] = bytes[k];
            (void)!reading_value(&r, changed, &e);
        }
    }
    assert_same(&r, "1 + 1", "2");
    reading_close(&r);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(precedence_is_the_contracts),
        cmocka_unit_test(long_sums_and_products_are_gathered),
        cmocka_unit_test(brackets_make_vectors_matrices_lists),
        cmocka_unit_test(depth_and_length_break_nothing),
        cmocka_unit_test(missing_times_is_pointed_at),
        cmocka_unit_test(forms_of_other_systems_have_hints),
        cmocka_unit_test(unknown_names_get_the_nearest),
        cmocka_unit_test(faults_stand_at_their_token),
        cmocka_unit_test(ranges_need_a_run),
        cmocka_unit_test(operands_end_before_option_words),
        cmocka_unit_test(mangled_texts_are_answered),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
