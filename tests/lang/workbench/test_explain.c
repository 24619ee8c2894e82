/* test_explain.c -- what stands at a place of a text. */
#include "lang/talk.h"

#include "base/memory.h"
#include "lang/workbench/explain.h"

/* What is explained at the byte of the text: "KIND: WORD: USAGE: FORMULA: DIMENSION at LINE:COLUMN". */
static void
is_explained(talk *k, const char *text, size_t at, const char *expected)
{
    qdot_explained x = {0};
    qdot_text seen = {0};

    assert_int_equal(qdot_explain(k->session, text, strlen(text), at, QDOT_PLAIN, &x), QDOT_OK);
    qdot_text_format(&seen, "%s", qdot_explained_kind_word(x.kind));
    if (x.kind != QDOT_EXPLAINED_NOTHING) {
        qdot_text_format(&seen, ": %s: %.30s: %s: %s", qdot_text_str(&x.word), qdot_text_str(&x.usage),
                         qdot_text_str(&x.formula), qdot_text_str(&x.dimension));
        assert_true(at >= x.from && at <= x.to && x.to <= strlen(text));
    }
    if (x.file != NULL)
        qdot_text_format(&seen, " at %u:%u", x.line, x.column);
    assert_string_equal(qdot_text_str(&seen), expected);
    qdot_text_clear(&seen);
    qdot_explained_clear(&x);
}

static void
words_of_statements(void **state)
{
    talk *k = *state;

    is_explained(k, "particle bob", 3, "statement: particle: particle NAME mass M at R: : ");
    is_explained(k, "particle bob", 8, "statement: particle: particle NAME mass M at R: : ");
    is_explained(k, "run 0..1 tol 1", 10, "option: tol: run T0..T1 tol E: : ");
    is_explained(k, "run 0..1 method dop853", 17, "topic: dop853: dop853: : ");
    is_explained(k, "x = 1; gravity (0, 1)", 8, "statement: gravity: gravity [NAME:] VECTOR: : ");
    is_explained(k, "sin(1)", 1, "function: sin: sin(x): : ");
    is_explained(k, "1 + 2", 2, "");
    is_explained(k, "# run", 3, "");
    is_explained(k, "\"run\"", 3, "");
    is_explained(k, "nosuch", 3, "");
    is_explained(k, "", 0, "");
}

static void
names_and_quantities(void **state)
{
    talk *k = *state;

    say(k, "param m > 0 = 2\ncoord theta, x[1]\nparticle bob mass m at (cos(theta), sin(theta))\n"
           "particle puck mass 1 at (x[1], 0)\nw = 2*m^2\nf(u) = u^2");
    is_explained(k, "m", 0, "name: m: param m > 0 = 2: :  at 1:7");
    is_explained(k, "1 + θ'", 5, "name: theta: coord theta: :  at 2:7");
    is_explained(k, "x[1]", 0, "name: x[1]: coord x[1]: :  at 2:14");
    is_explained(k, "2*w", 2, "name: w: w = 2*m^2: 2*m^2:  at 5:1");
    is_explained(k, "f(1)", 0, "name: f: f(u) = u^2: :  at 6:1");
    is_explained(k, "bob", 0, "label: bob: particle bob mass m at (cos(th: : ");
    is_explained(k, "T", 0, "quantity: T: T: 1/2*m*theta'^2 + 1/2*x[1]'^2: ");
    is_explained(k, "p[ theta ] + 1", 0, "quantity: p[theta]: p[theta]: m*theta': ");
    is_explained(k, "§ (T", 4, "quantity: T: T: 1/2*m*theta'^2 + 1/2*x[1]'^2: ");
    is_explained(k, "equilibria", 0, "quantity: equilibria: equilibria or equilibria[2]: : ");
}

static void
an_empty_scene_has_no_formulas(void **state)
{
    talk *k = *state;

    is_explained(k, "eom", 0, "quantity: eom: eom or eom[theta]: : ");
    say(k, "param h = 3 [m]");
    is_explained(k, "h", 0, "name: h: param h = 3 [m]: : a length [m] at 1:7");
}

/* Any text is read at any byte, and whatever allocation fails is told. */
static void
any_text_and_any_memory(void **state)
{
    static const char pieces[] = "T\0eom[\0theta]\0 (\0)\0\"\0#\0\n\0\xc2\xa7\0run 0..1 tol \0{\0}\0;\0'\0m\0\\";
    talk *k = *state;
    uint32_t seed = 1;

    say(k, "param m = 2\ncoord theta\nparticle bob mass m at (cos(theta), sin(theta))");
    for (int i = 0; i < 500; i++) {
        qdot_text text = {0};

        for (int j = 0; j < 8; j++) {
            seed = seed * 1664525 + 1013904223;
            qdot_text_add(&text, pieces + (seed >> 8) % sizeof pieces);
        }
        for (size_t at = 0; at <= text.n; at++) {
            qdot_explained x = {0};

            assert_int_equal(qdot_explain(k->session, qdot_text_str(&text), text.n, at, QDOT_UNICODE, &x), QDOT_OK);
            qdot_explained_clear(&x);
        }
        qdot_text_clear(&text);
    }
    for (long n = 0;; n++) {
        qdot_explained x = {0};
        qdot_status status;

        qdot_memory_fail_at(n);
        status = qdot_explain(k->session, "p[theta]", 8, 0, QDOT_PLAIN, &x);
        qdot_memory_fail_at(-1);
        if (status == QDOT_OK)
            assert_string_equal(qdot_text_str(&x.formula), "m*theta'");
        else
            assert_int_equal(status, QDOT_ENOMEM);
        qdot_explained_clear(&x);
        if (status == QDOT_OK)
            return;
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(words_of_statements, begin, end),
        cmocka_unit_test_setup_teardown(names_and_quantities, begin, end),
        cmocka_unit_test_setup_teardown(any_text_and_any_memory, begin, end),
        cmocka_unit_test_setup_teardown(an_empty_scene_has_no_formulas, begin, end),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
