/* test_typing.c -- calls for texts that are being typed: completion, colours, whether one is finished. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <string.h>

#include "qdot.h"

static int
begin(void **state)
{
    qdot_system *s;

    if (qdot_system_new(&s) != QDOT_RESULT_OK)
        return 1;
    *state = s;
    return qdot_system_declare(s, "coord theta\nparam thickness = 1") != QDOT_RESULT_OK;
}

static int
end(void **state)
{
    qdot_system_free(*state);
    return 0;
}

/* The completions at the end of the text: where the word begins, and the words. */
static void
expect_words(qdot_system *s, const char *text, size_t start, const char *wanted)
{
    size_t at = 99;
    char *words;

    assert_int_equal(qdot_system_complete(s, text, strlen(text), &at, &words), QDOT_RESULT_OK);
    assert_string_equal(words, wanted);
    if (wanted[0] != '\0')
        assert_int_equal(at, start);
    qdot_string_free(words);
}

static void
words_are_completed_in_their_place(void **state)
{
    qdot_system *s = *state;
    size_t at;
    char *words;

    expect_words(s, "2*thet", 2, "theta");
    expect_words(s, "coord x\npartic", 8, "particle");
    expect_words(s, "run 0..1 metho", 9, "method");
    expect_words(s, "print \\theta", 6, "θ");
    expect_words(s, "print θ", 6, "θ");
    expect_words(s, "x # partic", 0, "");
    expect_words(s, "plot x to \"partic", 0, "");
    expect_words(s, "nosuchword", 0, "");
    assert_int_equal(qdot_system_complete(s, "partic)", 6, &at, &words), QDOT_RESULT_OK);
    assert_string_equal(words, "particle");
    qdot_string_free(words);
    assert_int_equal(qdot_system_complete(s, "x", 2, &at, &words), QDOT_RESULT_INVALID);
    assert_string_equal(qdot_system_error(s), "complete: the text has no byte 2");
    assert_null(words);
    assert_int_equal(qdot_system_complete(s, NULL, 0, &at, &words), QDOT_RESULT_INVALID);
    assert_int_equal(qdot_system_complete(NULL, "x", 0, &at, &words), QDOT_RESULT_INVALID);
}

static void
words_are_explained(void **state)
{
    qdot_system *s = *state;
    char *text;

    assert_int_equal(qdot_system_explain(s, "2*thickness", 5, QDOT_NOTATION_JSON, &text), QDOT_RESULT_OK);
    assert_string_equal(text, "{\"word\":\"thickness\",\"from\":2,\"to\":11,\"kind\":\"name\",\"usage\":\"param thickness = 1\","
                              "\"text\":\"a parameter\",\"file\":\"declare\",\"line\":2,\"column\":7}");
    qdot_string_free(text);
    assert_int_equal(qdot_system_explain(s, "units", 2, QDOT_NOTATION_PLAIN, &text), QDOT_RESULT_OK);
    assert_int_equal(strncmp(text, "units [EXPR]\n    the dimension", 30), 0);
    qdot_string_free(text);
    assert_int_equal(qdot_system_explain(s, "1 + 1", 2, QDOT_NOTATION_JSON, &text), QDOT_RESULT_OK);
    assert_string_equal(text, "");
    qdot_string_free(text);
    assert_int_equal(qdot_system_explain(s, "T", 2, QDOT_NOTATION_JSON, &text), QDOT_RESULT_INVALID);
    assert_null(text);
    assert_int_equal(qdot_system_explain(s, "T", 0, QDOT_NOTATION_MATHML, &text), QDOT_RESULT_INVALID);
    assert_int_equal(qdot_system_explain(s, NULL, 0, QDOT_NOTATION_JSON, &text), QDOT_RESULT_INVALID);
}

static void
unfinished_texts_are_known(void **state)
{
    static const char *const open[] = {"{ print k", "f(1,", "1 + \\\n", "\"}\" [", "{ # }"};
    static const char *const whole[] = {"", "{ print k } for k = 1..2", "f(1)", "# (", "\"(\"", "x)"};

    (void)state;
    for (size_t i = 0; i < sizeof open / sizeof *open; i++)
        assert_int_equal(qdot_text_unfinished(open[i]), 1);
    for (size_t i = 0; i < sizeof whole / sizeof *whole; i++)
        assert_int_equal(qdot_text_unfinished(whole[i]), 0);
    assert_int_equal(qdot_text_unfinished(NULL), 0);
}

static void
every_byte_has_its_kind(void **state)
{
    static const char text[] = "plot theta to \"a\" # b\n2 ]";
    unsigned char kinds[sizeof text];

    assert_int_equal(qdot_system_highlight(*state, text, sizeof text - 1, kinds), QDOT_RESULT_OK);
    assert_int_equal(kinds[0], QDOT_LEXEME_WORD);
    assert_int_equal(kinds[4], QDOT_LEXEME_PLAIN);
    assert_int_equal(kinds[5], QDOT_LEXEME_NAME);
    assert_int_equal(kinds[9], QDOT_LEXEME_NAME);
    assert_int_equal(kinds[11], QDOT_LEXEME_WORD);
    assert_int_equal(kinds[14], QDOT_LEXEME_STRING);
    assert_int_equal(kinds[18], QDOT_LEXEME_COMMENT);
    assert_int_equal(kinds[22], QDOT_LEXEME_NUMBER);
    assert_int_equal(kinds[24], QDOT_LEXEME_WRONG);
    assert_int_equal(qdot_system_highlight(*state, NULL, 0, kinds), QDOT_RESULT_INVALID);
}

int
main(void)
{
#define IN_A_SCENE(test) cmocka_unit_test_setup_teardown(test, begin, end)
    const struct CMUnitTest tests[] = {
        IN_A_SCENE(words_are_completed_in_their_place),
        IN_A_SCENE(words_are_explained),
        cmocka_unit_test(unfinished_texts_are_known),
        IN_A_SCENE(every_byte_has_its_kind),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
