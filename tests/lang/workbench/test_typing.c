/* test_typing.c -- words of statements that are being typed: at random ways through each usage they are coloured, and TAB
 * offers them. */
#include "lang/talk.h"

#include "base/memory.h"
#include "lang/files/redirect.h"
#include "lang/syntax/holes.h"
#include "lang/syntax/statement.h"
#include "lang/syntax/usage.h"
#include "lang/workbench/complete.h"
#include "lang/workbench/highlight.h"

static const char scene[] = "param mu, k > 0; coord theta, phi; function wire(s)\n"
                            "particle bob mass mu at (theta, phi)\n"
                            "constraint rod: theta^2 + phi^2 = 4\n";

enum { WAYS = 60, WORDS = 64, TEXT = 1 << 12 };

static uint32_t seed = 1;

static uint32_t
random_below(uint32_t n)
{
    seed = seed * 1664525 + 1013904223;
    return (seed >> 8) % n;
}

/* A text for the hole of a usage. */
static const char *
sample_of_hole(const qdot_usage_node *hole)
{
    static const char *const expressions[] = {
        "theta", "9.81 [m/s^2]", "(k + 1) [s]", "½", "½ mu θ²", "√2", "theta' in [deg/s]", "-theta", "theta[1]", "%",
        "if(theta > 0 and k > 1, 1, 2)", "2*sin²(θ)", "solve(theta = 1, theta)[1]", "phi''", "pi [deg]", "k^2/3 - 1e-3"};
    static const char *const ranges[] = {"0..10", "0..10 [s]", "0..½", "-pi..2*pi", "(1/2) [s]..20 [s]"};
    static const char *const samples[] = {
        [QDOT_HOLE_CONDITION] = "value(theta, ½) = 2 and phi = 3", [QDOT_HOLE_EQUATION] = "½ θ = phi",
        [QDOT_HOLE_COMPARISON] = "theta == 3 [m]", [QDOT_HOLE_NAME] = "gamma",
        [QDOT_HOLE_DOMAIN] = "gamma > 0 [kg]", [QDOT_HOLE_COORDINATE] = "theta", [QDOT_HOLE_CALL] = "wire(s)",
        [QDOT_HOLE_BODY] = "s^2", [QDOT_HOLE_WORD] = "gamma", [QDOT_HOLE_TOPIC] = "energy", [QDOT_HOLE_TEXT] = "\"f.csv\""};

    const qdot_hole_class class = qdot_hole_at(hole->hole)->class;

    if (strcmp(hole->text, "RUN") == 0)
        return "run1";
    if (class == QDOT_HOLE_RANGE || class == QDOT_HOLE_VALUES)
        return ranges[random_below(sizeof ranges / sizeof *ranges)];
    return class < sizeof samples / sizeof *samples && samples[class] != NULL
               ? samples[class]
               : expressions[random_below(sizeof expressions / sizeof *expressions)];
}

/* A statement, and where its words stand in it. */
typedef struct {
    char text[TEXT];
    size_t length, at[WORDS];
    const char *word[WORDS];
    int n;
} typed;

static void
append(typed *s, const char *text)
{
    const char *blank = s->length == 0 || strcmp(text, ",") == 0 || strcmp(text, ":") == 0 ? "" : " ";

    assert_true(s->length + strlen(text) + 2 < TEXT);
    s->length += (size_t)sprintf(s->text + s->length, "%s%s", blank, text);
}

static void
append_tuple(typed *s, const char *names)
{
    char text[64] = "(theta";

    for (; *names != '\0'; names++)
        if (*names == ',')
            strcat(text, ", k");
    append(s, strcat(text, ")"));
}

/* A random way through the usage; false: it needs a table of rows, which is not there, or is too long. */
static bool
walk(const qdot_usage *u, typed *s)
{
    const qdot_usage_node *node = u->node;
    uint64_t taken = 0;

    *s = (typed){.length = 0};
    for (int steps = 0; node->kind != QDOT_USAGE_END; steps++) {
        if (steps > 400 || s->n == WORDS || s->length > TEXT / 2)
            return false;
        if (node->kind == QDOT_USAGE_FORK) {
            const bool free = (taken & (node->enters | node->needs)) == 0;
            const bool into = node->other < 0 || (free && (node->needs != 0 || random_below(2) == 0));

            if (!free && node->other < 0)
                return false;
            taken &= ~node->forgets;
            taken |= into ? node->enters : 0;
            node = &u->node[into ? node->next : node->other];
            continue;
        }
        if (node->kind == QDOT_USAGE_HOLE && qdot_hole_at(node->hole)->class == QDOT_HOLE_ROWS)
            return false;
        if (node->kind == QDOT_USAGE_HOLE && qdot_hole_at(node->hole)->class == QDOT_HOLE_TUPLE)
            append_tuple(s, node->text);
        else
            append(s, node->kind == QDOT_USAGE_HOLE ? sample_of_hole(node) : node->text);
        if (node->kind == QDOT_USAGE_WORD) {
            s->at[s->n] = s->length - strlen(node->text);
            s->word[s->n++] = node->text;
        }
        node = &u->node[node->next];
    }
    return true;
}

/* Whether TAB offers the word where its first letter is typed. */
static bool
is_offered(talk *k, const typed *s, int i)
{
    const char first[] = {s->word[i][0], '\0'};
    bool found = false;
    char **words;
    size_t n;

    assert_int_equal(qdot_complete(k->session, s->text, s->at[i], first, &words, &n), QDOT_OK);
    for (size_t j = 0; j < n; j++) {
        found = found || strcmp(words[j], s->word[i]) == 0;
        qdot_free(words[j]);
    }
    qdot_free(words);
    return found;
}

static void
words_of_random_statements_are_coloured_and_offered(void **state)
{
    const qdot_statement *row;
    talk *k = *state;
    int words = 0;

    assert_int_equal(say(k, scene), 0);
    for (size_t i = 0; (row = qdot_statement_at(i)) != NULL; i++)
        for (int way = 0; way < WAYS; way++) {
            static uint8_t kinds[TEXT];
            static qdot_usage u;
            static typed s;

            assert_true(qdot_usage_compile_with_end(&u, row->word, row->usage, qdot_redirect_answers(row)));
            if (!walk(&u, &s))
                continue;
            assert_int_equal(qdot_highlight_text(k->session, s.text, s.length, kinds), QDOT_OK);
            for (int n = 0; n < s.n; n++, words++) {
                if (kinds[s.at[n]] != QDOT_HIGHLIGHT_WORD)
                    fail_msg("`%s` is not coloured at byte %zu of: %s", s.word[n], s.at[n], s.text);
                if (n > 0 && !is_offered(k, &s, n))
                    fail_msg("`%s` is not offered at byte %zu of: %s", s.word[n], s.at[n], s.text);
            }
        }
    assert_true(words > 2000);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(words_of_random_statements_are_coloured_and_offered, begin, end),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
