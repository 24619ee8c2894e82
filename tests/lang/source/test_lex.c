/* test_lex.c -- bytes to tokens; places and reports. */
#include "lang/reading.h"

/* Tokens of a text, one blank between; END is |. A glued one is marked by no blank: ~. */
static void
assert_tokens(const char *text, const char *expected)
{
    qdot_source *source;
    qdot_text seen = {0};
    size_t at;

    if (qdot_source_new("a.lag", text, strlen(text), &source, &at) != QDOT_OK)
        fail_msg("%s: %s", text, qdot_last_error()->message);
    for (size_t i = 0; i < source->tokens.n; i++) {
        const qdot_token *t = &source->tokens.at[i];

        if (i > 0)
            qdot_text_char(&seen, ' ');
        qdot_text_add(&seen, t->kind == QDOT_TOKEN_END      ? "|"
                             : t->kind == QDOT_TOKEN_STRING ? "\""
                                                            : "");
        qdot_text_add(&seen, t->text);
    }
    assert_string_equal(qdot_text_str(&seen), expected);
    assert_int_equal(source->tokens.at[source->tokens.n - 1].kind, QDOT_TOKEN_END);
    qdot_text_clear(&seen);
    qdot_source_free(source);
}

static void
assert_no_lex(const char *text, size_t length, size_t place, const char *message)
{
    qdot_source *source = NULL;
    size_t at = 999;

    assert_int_equal(qdot_source_new("a.lag", text, length, &source, &at), QDOT_ESYNTAX);
    if (at != place || strstr(qdot_last_error()->message, message) == NULL)
        fail_msg("%s: at %zu: %s", text, at, qdot_last_error()->message);
    qdot_source_free(source);
}

static void
greek_is_spelled(void **state)
{
    (void)state;
    assert_tokens("θ1 θ₁ δθ ϕ ϵ ϑ Ω",
                  "theta1 theta1 deltatheta phi epsilon theta Omega |");
    assert_tokens("Θ₁₂_é", "Theta12_é |");
    assert_tokens("2·π − x ≤ ≥ x′", "2 * pi - x <= >= x ' |");
}

static void
numbers_and_ranges_part(void **state)
{
    (void)state;
    assert_tokens("9.81 1e-3 .5 1..3 1...5 2E+4 5. 2e 3x",
                  "9.81 1e-3 .5 1 .. 3 1 .. .5 2E+4 "
                  "5 . 2 e 3 x |");
    assert_no_lex("1.5.2", 5, 3, "one decimal point");
}

static void
operators_are_longest_first(void **state)
{
    (void)state;
    assert_tokens("a**b==c<=d>=e=f q''", "a ^ b == c <= d >= e = f q ' ' |");
}

static void
newlines_end_statements_outside_brackets(void **state)
{
    (void)state;
    assert_tokens("a\n\n;b; # note\n(c\n+d)\n", "a | b | ( c + d ) |");
    assert_tokens("a \\\n b\r\nc", "a b | c |");
    assert_tokens("{ a; b\n c } for", "{ a | b | c | } for |");
    assert_tokens("{\n(a\nb)\n}", "{ ( a b ) | } |");
    assert_tokens("[1, 2; 3]", "[ 1 , 2 ; 3 ] |");
    assert_tokens("", "|");
    assert_tokens("# only a note", "|");
    assert_tokens("\xEF\xBB\xBF"
                  "a",
                  "a |");
}

static void
strings_keep_their_text(void **state)
{
    (void)state;
    assert_tokens("\"a b # é\" \"\" \"q\\\"\\\\n\"", "\"a b # é \" \"q\"\\n |");
    assert_no_lex("a \"bc\nd", 7, 2, "no closing quote");
    assert_no_lex("\"bc", 3, 0, "no closing quote");
}

static void
gluing_is_seen(void **state)
{
    qdot_source *source;
    size_t at;

    (void)state;
    assert_int_equal(qdot_source_new("a", "a[1] [b", 4, &source, &at), QDOT_OK);
    assert_true(source->tokens.at[1].glued);
    qdot_source_free(source);
    assert_int_equal(qdot_source_new("a", "a [1]", 5, &source, &at), QDOT_OK);
    assert_false(source->tokens.at[1].glued);
    assert_true(source->tokens.at[2].glued);
    qdot_source_free(source);
}

static void
junk_is_refused_at_its_place(void **state)
{
    (void)state;
    assert_no_lex("a + \0b", 6, 4, "not text");
    assert_no_lex("a # \0b", 6, 4, "not text");
    assert_no_lex("ab\x01", 3, 2, "not text");
    assert_no_lex("ab \xFF", 4, 3, "not UTF-8");
    assert_no_lex("ab \xC3", 4, 3, "not UTF-8");
    assert_no_lex("x = \xD7\x90", 6, 4, "no meaning");
    assert_no_lex("a $ b", 5, 2, "`$`");
    assert_no_lex("+\xC2\xB2", 3, 1, "raised digit");
    assert_string_equal(qdot_last_error()->hint, "write `^2`");
    assert_no_lex("a \\ b", 5, 2, "end of a line");
}

static void
brackets_must_match(void **state)
{
    (void)state;
    assert_no_lex("(a]", 3, 2, "`]` does not close `(`");
    assert_no_lex("a)", 2, 1, "closes nothing");
    assert_no_lex("a\nb(c\n", 6, 3, "never closed");
}

static void
places_count_characters(void **state)
{
    const char *text = "\xEF\xBB\xBF"
                       "a\nθ + β\n";
    qdot_source *source;
    uint32_t line, column;
    size_t at;

    (void)state;
    assert_int_equal(qdot_source_new("a", text, strlen(text), &source, &at), QDOT_OK);
    qdot_source_locate(source, 3, &line, &column);
    assert_int_equal(line, 1);
    assert_int_equal(column, 1);
    qdot_source_locate(source, (size_t)(strstr(text, "β") - text), &line, &column);
    assert_int_equal(line, 2);
    assert_int_equal(column, 5);
    qdot_source_locate(source, 9999, &line, &column);
    assert_int_equal(line, 3);
    qdot_source_free(source);
}

static void
report_shows_line_and_caret(void **state)
{
    const char *text = "a = 1\nθ + zz\r\nb";
    qdot_error error = {.message = "unknown name `zz`", .hint = "did you mean `z`?"};
    qdot_source *source;
    qdot_text out = {0};
    size_t at;

    (void)state;
    assert_int_equal(qdot_source_new("a.lag", text, strlen(text), &source, &at), QDOT_OK);
    qdot_source_report(source, 11, &error, false, 0, &out);
    assert_string_equal(out.at, "a.lag:2:5: error: unknown name `zz`\n"
                                "  θ + zz\n"
                                "      ^\n"
                                "  hint: did you mean `z`?\n");
    qdot_text_clear(&out);
    qdot_source_free(source);
}

/* A line of a megabyte is cut; the caret still stands under its character. */
static void
report_cuts_long_lines(void **state)
{
    enum { LENGTH = 1000000, PLACE = 777777 };
    char *text = qdot_malloc(LENGTH + 1);
    qdot_error error = {.message = "here"};
    qdot_source *source;
    qdot_text out = {0};
    size_t at;
    const char *line, *caret;

    (void)state;
    memset(text, 'a', LENGTH);
    text[PLACE] = 'Z';
    text[LENGTH] = '\0';
    assert_int_equal(qdot_source_new("a.lag", text, LENGTH, &source, &at), QDOT_OK);
    qdot_source_report(source, PLACE, &error, false, 0, &out);
    assert_true(out.n < 400);
    line = strchr(out.at, '\n') + 1;
    caret = strchr(line, '\n') + 1;
    assert_int_equal(strchr(line, 'Z') - line, strchr(caret, '^') - caret);
    qdot_text_clear(&out);
    qdot_source_free(source);
    qdot_free(text);
}

static void
many_brackets_are_read(void **state)
{
    enum { DEPTH = 100000 };
    char *text = qdot_malloc(2 * DEPTH + 2);
    qdot_source *source;
    size_t at;

    (void)state;
    memset(text, '(', DEPTH);
    text[DEPTH] = '1';
    memset(text + DEPTH + 1, ')', DEPTH);
    assert_int_equal(qdot_source_new("a", text, 2 * DEPTH + 1, &source, &at), QDOT_OK);
    assert_int_equal(source->tokens.n, 2 * DEPTH + 2);
    qdot_source_free(source);
    qdot_free(text);
}

/* Every allocation that can fail does so cleanly. */
static void
memory_may_run_out(void **state)
{
    const char *text = "param θ = (1 + 2)*[3, 4] \"text\"\nb";
    qdot_status status = QDOT_ENOMEM;

    (void)state;
    for (int64_t n = 0; status != QDOT_OK; n++) {
        qdot_source *source;
        size_t at;

        assert_true(n < 1000);
        qdot_memory_fail_at(n);
        status = qdot_source_new("a", text, strlen(text), &source, &at);
        qdot_memory_fail_at(-1);
        assert_true(status == QDOT_OK || status == QDOT_ENOMEM);
        qdot_source_free(source);
    }
}

/* The text of the token behind the name and its index where the statement ends at token `end`; 0: where it ends. */
static void
assert_behind_index(const char *text, size_t end, const char *expected)
{
    qdot_source *source;
    size_t at;

    assert_int_equal(qdot_source_new("a.lag", text, strlen(text), &source, &at), QDOT_OK);
    if (end > 0)
        source->tokens.at[end].kind = QDOT_TOKEN_END;
    assert_string_equal(qdot_token_behind_index(source->tokens.at)->text, expected);
    qdot_source_free(source);
}

static void
an_index_ends_with_its_bracket(void **state)
{
    (void)state;
    assert_behind_index("x + 1", 0, "+");
    assert_behind_index("x[1] + 1", 0, "+");
    assert_behind_index("x[f(2), y[3]] < 1", 0, "<");
    assert_behind_index("x[1][2]", 0, "[");
    assert_behind_index("x [m] > 0", 0, "["); /* a unit */
    assert_behind_index("x(2)", 0, "(");
    assert_behind_index("x[k for k]", 3, "["); /* not closed */
    assert_behind_index("x", 0, "");
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(greek_is_spelled),
        cmocka_unit_test(numbers_and_ranges_part),
        cmocka_unit_test(operators_are_longest_first),
        cmocka_unit_test(newlines_end_statements_outside_brackets),
        cmocka_unit_test(strings_keep_their_text),
        cmocka_unit_test(gluing_is_seen),
        cmocka_unit_test(an_index_ends_with_its_bracket),
        cmocka_unit_test(junk_is_refused_at_its_place),
        cmocka_unit_test(brackets_must_match),
        cmocka_unit_test(places_count_characters),
        cmocka_unit_test(report_shows_line_and_caret),
        cmocka_unit_test(report_cuts_long_lines),
        cmocka_unit_test(many_brackets_are_read),
        cmocka_unit_test(memory_may_run_out),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
