/* test_complete.c -- what TAB offers, and the usage texts that it goes by. */
#include "lang/talk.h"

#include "base/memory.h"
#include "lang/files/redirect.h"
#include "lang/source/source.h"
#include "lang/syntax/statement.h"
#include "lang/syntax/match.h"
#include "lang/workbench/complete.h"

static const char scene[] =
    "param mu, m[k] for k = 1..2; param part, party; function wire(s)\n"
    "coord theta, phi; coord q[k] for k = 1..3\n"
    "anchor = (0, 0); f(u) = u^2\n"
    "particle bob mass mu at (theta, phi); particle partner mass part at (phi, theta)\n"
    "potential well: mu*theta^2/2; constraint rod: theta^2 + phi^2 = 4\n"
    "spring s1 between bob, anchor stiffness part\n"
    "event cross: theta = 0 rising\n";

/* The words that may stand behind `line`, whose last word is completed, with blanks between. */
static char *
offers(talk *k, const char *line)
{
    static char text[1 << 14];
    size_t length = strlen(line), n;
    char **words;

    while (length > 0 &&
           (strchr("abcdefghijklmnopqrstuvwxyz0123456789_", line[length - 1]) != NULL ||
            (unsigned char)line[length - 1] >= 0x80))
        length--;
    assert_int_equal(qdot_complete(k->session, line, length, line + length, &words, &n),
                     QDOT_OK);
    text[0] = '\0';
    for (size_t i = 0; i < n; i++) {
        assert_true(i == 0 || strcmp(words[i - 1], words[i]) < 0);
        strcat(strcat(text, i > 0 ? " " : ""), words[i]);
    }
    for (size_t i = 0; i < n; i++)
        qdot_free(words[i]);
    qdot_free(words);
    return text;
}

/* Exactly these. */
static void
what_may_stand_is_offered_and_no_more(void **state)
{
    static const char *const cases[][2] = {
        {"part", "part particle partner party"},
        {"print p[", "phi q[ theta"},
        {"check p[th", "theta"},
        {"eom[", "phi q[ theta"},
        {"check p[θ", "θ"},
        {"plot φ vs τ", ""},
        {"print μ", "μ"},
        {"metric((theta, phi))[theta, p", "phi"},
        {"lambda[", "rod"},
        {"q[", "1 2 3"},
        {"m[", "1 2"},
        {"run 0..1 t", "to tol"},
        {"run 0..1 ", "as constraints digits for method to tol with"},
        {"run 0..1 tol 1e-9 ", "as constraints for method to with"},
        {"run 0..1 digits 30 constraints none ", "as for method to with"},
        {"run 0..1 method ta", "taylor"},
        {"run 0..1 method auto constraints ", "baumgarte none project"},
        {"run 0..1 with ", "m[ mu part party phi q[ theta"},
        {"run 0..1 with mu = 2, p", "part party phi"},
        {"run 0..1 as ", ""},
        {"plan tol 1e-9 m", "method"},
        {"remove ", "bob cross damper dissipation force gravity partner potential rod s1 "
                    "spring torque "
                    "well"},
        {"modes at ", "equilibria steady"},
        {"run ", "anchor cross f m[ mu part party pi t wire"},
        {"run s", "scalar_curvature scale_factors sec series sign simplify sin sinh size solve speed2 spin sqrt stability subs sum"},
        {"force (0, 1) ", "at on"},
        {"force (0, 1) on ", "bob partner phi q[ theta"},
        {"force (0, 1) on bob ", "at for"},
        {"force (0, 1) on bob at m", "material"},
        {"torque 3 on ", "phi q[ theta"},
        {"spring s2 between b", "bob"},
        {"spring s2 between bob, a", "anchor"},
        {"spring s2 between bob, anchor ", "stiffness"},
        {"spring s2 between bob, anchor stiffness 3 ", "for rest"},
        {"particle a ", "mass"},
        {"particle a mass mu ", "at"},
        {"body disk mass m[1] inertia 2 ", "about at"},
        {"body disk mass m[1] inertia 2 at anchor ", "angle euler rotation"},
        {"start t", "theta"},
        {"start theta = 2, p", "phi"},
        {"start theta ", "="},
        {"find theta = 1 such that ret", "returns"},
        {"save ", "history session to"},
        {"start theta = 2 ", "exactly for"},
        {"set p", "part party"},
        {"set w", "wire"},
        {"plot theta | plot theta vs phi ", "colour equal for from keep labels legend lines log points range size ticks title to xlabel ylabel"},
        {"plot theta log x ti", "ticks title"},
        {"plot theta, phi colour red, b", "black blue"},
        {"plot theta log ", "x xy y"},
        {"style ", "flat latex mathml plain unicode"},
        {"timing ", "off on"},
        {"check integrable ", "rod"},
        {"check conser", "conserved"},
        {"event e: theta = 0 ", "falling for rising stop then"},
        {"event e: theta = 0 falling ", "for stop then"},
        {"event e: theta = 0 then theta' = -theta', p", "part party phi"},
        {"reset ", "for scale scene start"},
        {"param ", ""},
        {"coord ", ""},
        {"run 0..20", ""},
        {"x = 3 ", "for to"},
        {"x = anch", "anchor"},
        {"T ", "for to"},
        {"wave = partn", "partner"},
        {"print theta*anc", "anchor"},
        {"table theta, theta' ", "every"},
        {"set mu = 1; timing ", "off on"},
        {"set mu = 1\ntiming o", "off on"},
        {"{ timing o", "off on"},
        {"print (1 +\n anch", "anchor"},
        {"print \"text\"", ""},
        {"print (1 + theta)", ""},
        {"help search energy ", "for to"},
    };
    talk *k = *state;

    assert_int_equal(say(k, scene), 0);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *found = offers(k, cases[i][0]);

        if (strcmp(found, cases[i][1]) != 0)
            print_error("`%s`\n  offers  `%s`\n  and not `%s`\n", cases[i][0], found,
                        cases[i][1]);
    }
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_string_equal(offers(k, cases[i][0]), cases[i][1]);
}

/* Whether `word` is among the words that `text` holds. */
static bool
holds(const char *text, const char *word)
{
    size_t n = strlen(word);

    for (const char *at = strstr(text, word); at != NULL; at = strstr(at + 1, word))
        if ((at == text || at[-1] == ' ') && (at[n] == ' ' || at[n] == '\0'))
            return true;
    return false;
}

/* Exactly the languages of the table, and LaTeX. */
static void
languages_of_exports_are_offered(void **state)
{
    static const char *const languages[] = {
        "latex",
#define LANGUAGE(word, title, ending, language) #word,
#include "show/export-languages.def"
    };
    const char *found = offers(*state, "export ");
    size_t letters = strlen(found) + 1;

    for (size_t i = 0; i < sizeof languages / sizeof *languages; i++) {
        assert_true(holds(found, languages[i]));
        letters -= strlen(languages[i]) + 1;
    }
    assert_int_equal(letters, 0);
}

/* Operands are expressions: no statement stands there. */
static void
operands_take_no_statements(void **state)
{
    static const char *const places[] = {
        "print ",     "print 2*", "x = ", "sin(",
        "potential ", "check ",   "(1, ", "plot theta, "};
    talk *k = *state;

    assert_int_equal(say(k, scene), 0);
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const char *found = offers(k, places[i]);

        if (!holds(found, "theta"))
            fail_msg("`%s` offers `%s`", places[i], found);
        assert_true(holds(found, "theta") && holds(found, "energy"));
        assert_false(holds(found, "sin")); /* functions are many: a letter of theirs is typed first */
        assert_true(holds(found, "q[") && holds(found, "f") && holds(found, "pi"));
        assert_false(holds(found, "particle") || holds(found, "quit") ||
                     holds(found, "poincare"));
    }
    assert_true(holds(offers(k, ""), "particle"));
    assert_false(holds(offers(k, ""), "theta"));
    assert_true(holds(offers(k, "t"), "theta"));
}

static void
greek_letters_are_offered(void **state)
{
    char **words;
    size_t n;

    (void)state;
    for (int letter = 0; letter < 2; letter++) {
        assert_int_equal(qdot_complete_greek("thet", letter, &words, &n), QDOT_OK);
        assert_int_equal(n, 1);
        assert_string_equal(words[0], letter ? "θ" : "theta");
        qdot_free(words[0]);
        qdot_free(words);
    }
    assert_int_equal(qdot_complete_greek("e", true, &words, &n), QDOT_OK);
    assert_int_equal(n, 2);
    assert_string_equal(words[0], "\\epsilon");
    assert_string_equal(words[1], "\\eta");
    for (size_t i = 0; i < n; i++)
        qdot_free(words[i]);
    qdot_free(words);
}

/* A usage text is a grammar that takes the statement's own example. */
static void
every_example_follows_its_usage(void **state)
{
    const qdot_statement *row;
    qdot_usage u;
    talk *k = *state;

    for (size_t i = 0; (row = qdot_statement_at(i)) != NULL; i++) {
        qdot_source *source;
        qdot_record record;
        qdot_next next = {0};
        bool whole = false;
        size_t at;

        if (!qdot_usage_compile_with_end(&u, row->word, row->usage, qdot_redirect_answers(row)))
            fail_msg("the usage of `%s` cannot be read: %s", row->word, row->usage);
        assert_int_equal(
            qdot_source_new("example", row->example, strlen(row->example), &source, &at),
            QDOT_OK);
        assert_int_equal(qdot_match_begun(&(qdot_cursor){.session = k->session, .source = source, .at = source->tokens.at}, row,
                                          &u, true, &next, &record),
                         QDOT_OK);
        qdot_record_free(&record);
        for (int n = 0; n < next.n; n++)
            whole = whole || next.at[n].node->kind == QDOT_USAGE_END;
        if (!whole)
            fail_msg("`%s` does not follow `%s`", row->example, row->usage);
        qdot_source_free(source);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(what_may_stand_is_offered_and_no_more, begin,
                                        end),
        cmocka_unit_test_setup_teardown(languages_of_exports_are_offered, begin, end),
        cmocka_unit_test_setup_teardown(operands_take_no_statements, begin, end),
        cmocka_unit_test_setup_teardown(greek_letters_are_offered, begin, end),
        cmocka_unit_test_setup_teardown(every_example_follows_its_usage, begin, end),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
