/* test_analysis.c -- what a script that is being written says: faults, names, after changes as from the beginning. */
#include "lang/analysis/analysed.h"

#include "lang/analysis/names.h"

static void
says(void **state, const char *text, const char *expected)
{
    analyse(*state, text);
    has_remarks(*state, expected);
}

static void
each_statement_has_its_fault(void **state)
{
    says(state, "coord x\nx + y1\nparam m >\nrun 0..5 tl 3\nm = \"a\"\n",
         "12-14 error: unknown name `y1` | `param y1` declares a parameter, `coord y1` a coordinate\n"
         "24-24 error: expected an expression, found the end of the statement | as in param m, L > 0, g = 9.81\n"
         "34-36 error: expected `tol`, `digits`, `method`, `with`, `constraints` or `as`, found `tl` | did you mean `tol`?\n"
         "43-46 error: expected an expression, found a text in quotes\n");
}

static void
the_rest_of_a_torn_text_is_read(void **state)
{
    says(state, "coord x\nprint (x\nx + yy\n",
         "14-15 error: `(` is never closed | write print (x)\n"
         "21-23 error: unknown name `yy` | `param yy` declares a parameter, `coord yy` a coordinate\n");
}

static void
what_takes_long_is_parsed_only(void **state)
{
    says(state, "coord x\nlagrangian x'^2/2 - x^2/2\nrun 0..1e12 as a\nE = value(a.x, 3)\nE + 1\ntable a.(x + thta) every 1\n",
         "88-92 error: unknown name `thta` | `param thta` declares a parameter, `coord thta` a coordinate\n");
    says(state, "coord x\nspeed w = 2*x'\nlagrangian x'^2/2\nstart x' = 1\nrun 0..1 as a\nstart a\nstart w = 0.25\n", "");
    says(state, "coord x\nsweep x = 0..1 count 3 run 0..1 : x as s\ntable s\nfit x to \"none.csv\" : t, x\n", "");
}

static void
names_that_a_statement_binds_are_known(void **state)
{
    static const char scene[] = "coord x, y\nstate z' = y\nlagrangian x'^2/2\nrun 0..1\n";
    static const char *const lines[] = {"value(integral(x*u, u, 0, 1), 1)\n", "plot limit(sin(u)/u, u = 0)*x\n",
                                        "sweep x = normal(0, 1) count 3 seed 1 run 0..1 : x\n",
                                        "sweep x = uniform(0, 1), y = normal(1, 2) count 3 seed 1 run 0..1 : integral(x*u, u, 0, 1)\n",
                                        "plot bode 1/(s + 1), s for w = 0.1..10\n"};

    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        char text[200];

        (void)snprintf(text, sizeof text, "%s%s", scene, lines[i]);
        says(state, text, "");
    }
    says(state, "coord x\nlagrangian x'^2/2\nrun 0..1\nplot 1/(s + 1)\n",
         "43-44 error: unknown name `s` | `param s` declares a parameter, `coord s` a coordinate\n");
}

static void
reset_forgets_names_of_runs(void **state)
{
    says(state, "coord x\nlagrangian x'^2/2\nrun 0..1 as r\nE = value(x, 1)\nreset\ncoord r > 0, E\nlagrangian r'^2/2 + E'^2\ncyclic\nc = r + q1\n",
         "117-119 error: unknown name `q1` | `param q1` declares a parameter, `coord q1` a coordinate\n");
    says(state, "coord x\nlagrangian x'^2/2\nrun 0..1 as r\nE = value(r.x, 1)\nE + 1\nreset scene\nE + q1\n",
         "80-82 error: unknown name `q1` | `param q1` declares a parameter, `coord q1` a coordinate\n");
    says(state, "param a\ncoord x\nlagrangian x'^2/2\nrun 0..1 as a\nstart a\n", "");
    /* the label of a run hides nothing */
    says(state, "coord x, r\nlagrangian x'^2/2 + r'^2/2\nrun 0..1 as r\nc = r + q1\n",
         "60-62 error: unknown name `q1` | `param q1` declares a parameter, `coord q1` a coordinate\n");
}

static void
a_removed_run_has_no_values(void **state)
{
    says(state, "coord x\nlagrangian x'^2/2\nrun 0..1 as r\nrun 0..1 as s\nvalue(r.x, 1)\nremove r\nvalue(s.x, 1)\nvalue(r.x, 1)\n"
                "x + q1\nrun 0..1 as r\nvalue(r.x, 1)\n",
         "97-98 error: there is no run `r` | `a.theta` is theta along the run a; a product is written a*theta\n"
         "109-111 error: unknown name `q1` | `param q1` declares a parameter, `coord q1` a coordinate\n");
    says(state, "coord x\nlagrangian x'^2/2\nrun 0..1\nremove run1\n", "");
}

static void
no_file_is_written(void **state)
{
    says(state, "coord x\nlagrangian x'^2/2\nL to \"/nowhere/a.tex\"\nexport c eom to \"/nowhere/a.c\"\n", "");
}

static void
a_refuted_check_is_a_warning(void **state)
{
    says(state, "check 1 == 2\n", "0-12 warning: refuted: left = 1, right = 2\n");
}

static void
a_fault_has_no_train(void **state)
{
    says(state, "coord x\nr = (x, zz)\nparticle p mass 1 at r\nT\n",
         "16-18 error: unknown name `zz` | `param zz` declares a parameter, `coord zz` a coordinate\n");
}

static void
blocks_and_loops(void **state)
{
    says(state, "coord q[k] for k = 1..3\n{ lagrangian q[k]'^2/2\n  run 0..1 as a\n  f = value(a.q[1], 1)\n  print f + k } for k = 1..2\n", "");
    says(state, "param m\n{ print m + n1*k } for k = 1..2\n",
         "20-22 error: unknown name `n1` | `param n1` declares a parameter, `coord n1` a coordinate\n");
}

static void
a_change_says_the_same_as_the_whole(void **state)
{
    static const char *const texts[] = {"param m > 0, k\ncoord x\nlagrangian m*x'^2/2 - k*x^2/2\neom\ncheck conserved energy\nx + z1\n",
                                        "param m > 0\ncoord x\nlagrangian m*x'^2/2 - k*x^2/2\neom\n", "coord x\ncoord x = 3\n", "",
                                        "param m > 0, k\ncoord x\nlagrangian m*x'^2/2 - k*x^2/2\neom\ncheck 1 == 2\n"};
    qdot_analysis *a = *state;

    for (int round = 0; round < 40; round++) {
        const char *text = texts[round*7 % 5];
        qdot_analysis *fresh = qdot_analysis_new("/nowhere/script.lag", false, NULL);
        qdot_remark x, y;

        analyse(a, text);
        analyse(fresh, text);
        for (size_t i = 0; qdot_analysis_remark(fresh, i, &x); i++) {
            assert_true(qdot_analysis_remark(a, i, &y));
            assert_string_equal(x.message, y.message);
            assert_int_equal(x.at.from, y.at.from);
        }
        qdot_analysis_free(fresh);
    }
}

static void
a_near_name_is_a_fix(void **state)
{
    qdot_analysis *a = *state;
    qdot_remark r;

    analyse(a, "coord theta\nprint thet + 1\n");
    assert_true(qdot_analysis_remark(a, 0, &r));
    assert_string_equal(r.fix, "theta");
    assert_int_equal(r.at.from, 18);
    assert_int_equal(r.at.to, 22);
}

/* --- names ---------------------------------------------------------------------------- */

/* The text with the name at byte `at` renamed, or the message of the refusal. */
static void
renamed(qdot_analysis *a, const char *text, size_t at, const char *name, const char *expected)
{
    qdot_occurrence_list places = {0};
    qdot_text other = {0};
    size_t from = 0;
    qdot_status status;

    analyse(a, text);
    status = qdot_names_rename(a, at, name, &places);
    for (size_t i = 0; i < places.n; i++) {
        qdot_text_add_n(&other, text + from, places.at[i].at.from - from);
        qdot_text_add(&other, name);
        from = places.at[i].at.to;
    }
    qdot_text_add(&other, text + from);
    assert_string_equal(status == QDOT_OK ? qdot_text_str(&other) : qdot_last_error()->message, expected);
    qdot_text_clear(&other);
    qdot_free(places.at);
}

static void
names_are_renamed(void **state)
{
    renamed(*state, "coord theta\nds2((θ, 1)) == dtheta^2 + dθ*theta'\n", 6, "phi", "coord phi\nds2((phi, 1)) == dphi^2 + dphi*phi'\n");
    renamed(*state, "param m\nf(m) = m^2\nf(m)\n", 6, "mu", "param mu\nf(m) = m^2\nf(mu)\n");
    renamed(*state, "param m\nf(m) = m^2\nf(m)\n", 10, "u", "param m\nf(u) = u^2\nf(m)\n");
    renamed(*state, "print n1^2 for n1 = 1..3\n", 15, "j", "print j^2 for j = 1..3\n");
    renamed(*state, "coord x\nlagrangian x'^2\nrun 0..1 as a\nvalue(a.x, 1)\n", 36, "b",
            "coord x\nlagrangian x'^2\nrun 0..1 as b\nvalue(b.x, 1)\n");
    renamed(*state, "coord x\nprint integral(x^2, x)\nprint x^2 for x = 1..2\nsum(x, x, 1, 2)\nreset\n", 6, "z",
            "coord z\nprint integral(z^2, z)\nprint z^2 for z = 1..2\nsum(x, x, 1, 2)\nreset\n");
    renamed(*state, "print integral(u^2, u)\nparam m\n", 21, "v", "print integral(v^2, v)\nparam m\n");
    renamed(*state, "param L > 0 [m]\nparam m\n", 22, "mass1", "param L > 0 [m]\nparam mass1\n");
    renamed(*state, "body rod mass 1 inertia 1 at (0, 0) angle 0\njoint hinge J between ground, rod at (0, 0) angle th\nth'\n", 94, "ph",
            "body rod mass 1 inertia 1 at (0, 0) angle 0\njoint hinge J between ground, rod at (0, 0) angle ph\nph'\n");
    renamed(*state, "coord x, y, a\nbody rod mass 1 inertia 1 at (x, y) angle a\njoint hinge J between ground, rod at (0, 0)\nreaction(J)\nlambda[J, 1]\n",
            70, "pin",
            "coord x, y, a\nbody rod mass 1 inertia 1 at (x, y) angle a\njoint hinge pin between ground, rod at (0, 0)\nreaction(pin)\nlambda[pin, 1]\n");
}

static void
names_are_not_renamed_to_what_is_taken(void **state)
{
    renamed(*state, "param m, k\nm + k\n", 6, "k", "`k` stands in this script already");
    renamed(*state, "param m\nm + 1\n", 6, "sin", "`sin` is a word of the language");
    renamed(*state, "param m\nm + 1\n", 6, "2x", "`2x` is no name: a letter, then letters, digits, _");
    renamed(*state, "param m\nsin(m)\n", 8, "cos1", "`sin` is a word of the language");
    renamed(*state, "coord x\nx + yy\n", 12, "zz", "`yy` is not declared in this script");
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(each_statement_has_its_fault, begin, end),
        cmocka_unit_test_setup_teardown(the_rest_of_a_torn_text_is_read, begin, end),
        cmocka_unit_test_setup_teardown(what_takes_long_is_parsed_only, begin, end),
        cmocka_unit_test_setup_teardown(names_that_a_statement_binds_are_known, begin, end),
        cmocka_unit_test_setup_teardown(reset_forgets_names_of_runs, begin, end),
        cmocka_unit_test_setup_teardown(a_removed_run_has_no_values, begin, end),
        cmocka_unit_test_setup_teardown(no_file_is_written, begin, end),
        cmocka_unit_test_setup_teardown(a_refuted_check_is_a_warning, begin, end),
        cmocka_unit_test_setup_teardown(a_fault_has_no_train, begin, end),
        cmocka_unit_test_setup_teardown(blocks_and_loops, begin, end),
        cmocka_unit_test_setup_teardown(a_change_says_the_same_as_the_whole, begin, end),
        cmocka_unit_test_setup_teardown(a_near_name_is_a_fix, begin, end),
        cmocka_unit_test_setup_teardown(names_are_renamed, begin, end),
        cmocka_unit_test_setup_teardown(names_are_not_renamed_to_what_is_taken, begin, end),
    };

    return cmocka_run_group_tests_name("lang/analysis", tests, NULL, NULL);
}
