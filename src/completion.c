/* completion.c -- completes words at the prompt when TAB is pressed. */
#include "completion.h"

#include <langinfo.h>
#include <stdlib.h>
#include <string.h>

#include <readline/readline.h>

#include "base/memory.h"
#include "base/text.h"
#include "lang/workbench/complete.h"

static qdot_session *session; /* the session; global, because readline's callbacks get no argument */
static const char *lines = "";

/* The completions that were found, which readline takes one by one. */
static struct {
    char **at;
    size_t n, next;
} words;

/* The next completion found; allocated by malloc, as readline frees it. */
static char *
next_completion(const char *prefix, int again)
{
    char *word = NULL;

    (void)prefix;
    if (again == 0)
        words.next = 0;
    if (words.next < words.n) {
        word = strdup(words.at[words.next]);
        qdot_free(words.at[words.next++]);
    }
    if (word != NULL)
        return word;
    while (words.next < words.n)
        qdot_free(words.at[words.next++]);
    qdot_free(words.at);
    words.at = NULL;
    words.n = 0;
    return NULL;
}

static qdot_status
find_words(const char *prefix, int start)
{
    qdot_text before = {0};
    qdot_status status;

    qdot_text_add(&before, lines);
    qdot_text_add_n(&before, rl_line_buffer, (size_t)start);
    status = qdot_text_status(&before);
    if (status == QDOT_OK && prefix[0] == '\\')
        status = qdot_complete_greek(
            prefix + 1, strcmp(nl_langinfo(CODESET), "UTF-8") == 0, &words.at, &words.n);
    else if (status == QDOT_OK)
        status = qdot_complete(session, qdot_text_str(&before), before.n, prefix,
                               &words.at, &words.n);
    qdot_text_clear(&before);
    return status;
}

static char **
complete_word(const char *prefix, int start, int end)
{
    const qdot_place p = qdot_complete_place(rl_line_buffer, (size_t)start);

    (void)end;
    rl_completion_append_character = '\0';
    if (p == QDOT_PLACE_QUOTED)
        return NULL; /* readline then completes file names and their closing quote */
    rl_attempted_completion_over = 1;
    if (p == QDOT_PLACE_COMMENT || find_words(prefix, start) != QDOT_OK)
        return NULL;
    return rl_completion_matches(prefix, next_completion);
}

/* The characters that separate words left of the cursor; within quotes only the quote. */
static char *
word_break_characters(void)
{
    static char quote[] = "\"";

    return qdot_complete_place(rl_line_buffer, (size_t)rl_point) == QDOT_PLACE_QUOTED ? quote : NULL;
}

void
qdot_completion_install(qdot_session *s)
{
    session = s;
    rl_attempted_completion_function = complete_word;
    rl_basic_word_break_characters = QDOT_COMPLETE_BREAKS;
    rl_completer_quote_characters = "\"";
    rl_completion_word_break_hook = word_break_characters;
    rl_variable_bind("expand-tilde", "on"); /* ~ has no meaning in the language */
}

void
qdot_completion_continue(const char *before)
{
    lines = before;
}
