/* test_highlight.c -- what each byte of a text that is being typed is. */
#include "lang/talk.h"

#include "base/memory.h"
#include "lang/workbench/highlight.h"

/* Each byte of the text a letter: W word, n name, 0 number, s string, c comment, x wrong, else as it
 * is. */
static void
is_seen_as(talk *k, const char *text, const char *expected)
{
    static const char letters[] = {
        [QDOT_HIGHLIGHT_WORD] = 'W',    [QDOT_HIGHLIGHT_NAME] = 'n',
        [QDOT_HIGHLIGHT_NUMBER] = '0',  [QDOT_HIGHLIGHT_STRING] = 's',
        [QDOT_HIGHLIGHT_COMMENT] = 'c', [QDOT_HIGHLIGHT_WRONG] = 'x'};
    uint8_t kinds[200];
    char seen[200];
    const size_t n = strlen(text);

    assert_true(n < sizeof kinds);
    assert_int_equal(qdot_highlight_text(k->session, text, n, kinds), QDOT_OK);
    for (size_t i = 0; i < n; i++)
        seen[i] = kinds[i] == QDOT_HIGHLIGHT_PLAIN ? text[i] : letters[kinds[i]];
    seen[n] = '\0';
    assert_string_equal(seen, expected);
}

static void
statements_and_their_options(void **state)
{
    talk *k = *state;

    say(k, "param m; coord q");
    is_seen_as(k, "particle bob mass m at q", "WWWWWWWW bob WWWW n WW n");
    is_seen_as(k, "param L; run 0..1 tol 1e-3", "WWWWW n; WWW 0..0 WWW 0000");
    is_seen_as(k, "T to \"a.tex\"", "n WW sssssss");
    is_seen_as(k, "print k for k = 1..3", "WWWWW k WWW k = 0..0");
    is_seen_as(k, "{ T; print q } for k = 1..2", "{ n; WWWWW n } WWW k = 0..0");
    is_seen_as(k, "run 0..10 [s] tol 1e-9 as a", "WWW 0..00 [s] WWW 0000 WW a");
    is_seen_as(k, "plot ½ m l from 0 to ½ keep", "WWWW 00 n l WWWW 0 WW 00 WWWW");
    is_seen_as(k, "find q = 1 such that returns after T and q = 1 run 0..1 as c",
               "WWWW n = 0 WWWW WWWW WWWWWWW WWWWW n and n = 0 WWW 0..0 WW c");
    is_seen_as(k, "find q = 1 such that q = ½ and q = 2 as c", "WWWW n = 0 WWWW WWWW n = 00 and n = 0 WW c");
    is_seen_as(k, "T == V when eom", "n == n WWWW nnn");
    is_seen_as(k, "save session to \"a.lag\"", "WWWW WWWWWWW WW sssssss");
}

/* The words of some statements are values, too. */
static void
words_of_statements_and_values(void **state)
{
    talk *k = *state;

    say(k, "param m; coord q");
    is_seen_as(k, "modes at equilibria[2]", "WWWWW WW nnnnnnnnnn[0]");
    is_seen_as(k, "modes", "WWWWW");
    is_seen_as(k, "modes[1]; modes + 1", "nnnnn[0]; nnnnn + 0");
    is_seen_as(k, "{ forces; dof } for k = 1..2", "{ WWWWWW; WWW } WWW k = 0..0");
    is_seen_as(k, "equilibria for m = 1..2", "WWWWWWWWWW WWW n = 0..0");
    is_seen_as(k, "hamiltonian p[q]^2/2", "WWWWWWWWWWW n[n]^0/0");
    is_seen_as(k, "hamiltonian √2; hamiltonian - T", "WWWWWWWWWWW √0; nnnnnnnnnnn - n");
    is_seen_as(k, "linearize at equilibria[1]; linearize[A]", "WWWWWWWWW WW nnnnnnnnnn[0]; nnnnnnnnn[A]");
}

static void
words_used_as_names_are_no_statements(void **state)
{
    talk *k = *state;

    is_seen_as(k, "run*2", "run*0");
    is_seen_as(k, "gravity = 9.81", "gravity = 0000");
    is_seen_as(k, "mass", "mass");
    is_seen_as(k, "run 0..1 with tol = 2", "WWW 0..0 WWWW tol = 0");
}

static void
names_are_known_or_not(void **state)
{
    talk *k = *state;

    say(k, "coord theta1; param m; particle bob mass m at theta1");
    is_seen_as(k, "sin(theta1)*thet + bob", "nnn(nnnnnn)*thet + nnn");
    is_seen_as(k, "θ̇₁ + θ",
               "nnnnnnn + θ"); /* a letter of 2 bytes, a dot of 2, an index of 3 */
}

static void
what_is_not_finished_is_read(void **state)
{
    talk *k = *state;

    is_seen_as(k, "", "");
    is_seen_as(k, "print \"half a tex", "WWWWW sssssssssss");
    is_seen_as(k, "sin((1 + 2", "nnn((0 + 0");
    is_seen_as(k, "1 # and \"so\" on", "0 ccccccccccccc");
    is_seen_as(k, "1 + 2) + sin(2)", "0 + 0x + nnn(0)");
    is_seen_as(k, "\\the", "\\the");
    is_seen_as(k, "print (1 +\nsin(2", "WWWWW (0 +\nnnn(0");
    is_seen_as(k, "# one\nparam m # two", "ccccc\nWWWWW m ccccc");
}

/* Any bytes: nothing is read or written beyond the text. */
static void
any_bytes_are_read(void **state)
{
    static const char alphabet[] = "a1 \"#()[]{};\\\n\x80\xCE\xB8'.=*%\t\x01";
    talk *k = *state;

    srand(5);
    for (int trial = 0; trial < 3000; trial++) {
        char text[24];
        uint8_t kinds[24];
        const size_t n = (size_t)rand() % sizeof text;

        for (size_t i = 0; i < n; i++)
            text[i] = alphabet[(size_t)rand() % (sizeof alphabet - 1)];
        text[n] = '\0';
        assert_int_equal(qdot_highlight_text(k->session, text, n, kinds), QDOT_OK);
        for (size_t i = 0; i < n; i++)
            assert_true(kinds[i] <= QDOT_HIGHLIGHT_WRONG);
    }
}

static void
memory_may_run_out(void **state)
{
    talk *k = *state;
    uint8_t kinds[40];

    for (int64_t i = 0;; i++) {
        qdot_status status;

        qdot_memory_fail_at(i);
        status = qdot_highlight_text(k->session, "print sin(2)) \"a\" # b", 21, kinds);
        qdot_memory_fail_at(-1);
        if (status == QDOT_OK) {
            assert_true(i > 3);
            return;
        }
        assert_int_equal(status, QDOT_ENOMEM);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(statements_and_their_options, begin, end),
        cmocka_unit_test_setup_teardown(words_of_statements_and_values, begin, end),
        cmocka_unit_test_setup_teardown(words_used_as_names_are_no_statements, begin,
                                        end),
        cmocka_unit_test_setup_teardown(names_are_known_or_not, begin, end),
        cmocka_unit_test_setup_teardown(what_is_not_finished_is_read, begin, end),
        cmocka_unit_test_setup_teardown(any_bytes_are_read, begin, end),
        cmocka_unit_test_setup_teardown(memory_may_run_out, begin, end),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
