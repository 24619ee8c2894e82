/* prompt.c -- the conversation at a terminal: readline, its history and completion.
 *
 * Readline is used through its callbacks: it never waits by itself, so a Ctrl-C reaches
 * us at a known place, and while a statement is carried out the terminal is as the
 * program found it.
 */
#include "prompt.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <readline/history.h>
#include <readline/readline.h>

#include "base/memory.h"
#include "lang/commands/complete.h"
#include "signals.h"

enum { HISTORY_LINES = 10000 };

static const char first_prompt[] = "qdot> ", next_prompt[] = " ...> ";

static qdot_session *completing; /* readline's callbacks have no argument of ours */

/* --- history ------------------------------------------------------------------------ */

/* Create the folders above `path` that are missing, as `mkdir -p` does. */
static bool
make_folders(char *path)
{
    for (char *slash = strchr(path + 1, '/'); slash != NULL;
         slash = strchr(slash + 1, '/')) {
        bool made;

        *slash = '\0';
        made = mkdir(path, 0700) == 0 || errno == EEXIST;
        *slash = '/';
        if (!made)
            return false;
    }
    return true;
}

/* Where history is kept, "" if the environment names no place. */
static void
history_path(qdot_text *path)
{
    const char *state = getenv("XDG_STATE_HOME"), *home = getenv("HOME");

    if (state != NULL && state[0] == '/')
        qdot_text_format(path, "%s/qdot/history", state);
    else if (home != NULL && home[0] == '/')
        qdot_text_format(path, "%s/.local/state/qdot/history", home);
}

/* Read what earlier sessions left; `path` is emptied where none can be kept. */
static void
history_begin(qdot_text *path)
{
    int fd;

    using_history();
    history_path(path);
    if (path->n == 0)
        return;
    if (!make_folders(path->at) ||
        (fd = open(path->at, O_WRONLY | O_CREAT | O_CLOEXEC, 0600)) < 0) {
        fprintf(stderr, "qdot: history is not kept: %s: %s\n", path->at, strerror(errno));
        qdot_text_truncate(path, 0);
        return;
    }
    close(fd);
    history_truncate_file(path->at, HISTORY_LINES);
    read_history(path->at);
    stifle_history(HISTORY_LINES);
}

/* Add a line at once, so that no crash loses it; blanks and repetitions are left out. */
static void
history_note(const char *line, const qdot_text *path)
{
    HIST_ENTRY *last =
        history_length > 0 ? history_get(history_base + history_length - 1) : NULL;

    if (line[strspn(line, " \t")] == '\0' ||
        (last != NULL && strcmp(last->line, line) == 0))
        return;
    add_history(line);
    if (path->n > 0)
        append_history(1, path->at);
}

/* --- completion --------------------------------------------------------------------- */

/* Readline takes and frees what is returned, so it comes from malloc. */
static char *
next_word(const char *prefix, int again)
{
    static char **words;
    static size_t n, at;
    char *word = NULL;

    if (again == 0) {
        words = NULL;
        n = at = 0;
        if (qdot_complete(completing, prefix, &words, &n) != QDOT_OK)
            n = 0;
    }
    if (at < n) {
        word = strdup(words[at]);
        qdot_free(words[at++]);
    }
    if (word != NULL)
        return word;
    while (at < n)
        qdot_free(words[at++]);
    qdot_free(words);
    words = NULL;
    return NULL;
}

/* Within quotes a file name is completed, elsewhere a word of the language. */
static char **
complete(const char *prefix, int start, int end)
{
    bool quoted = false;

    (void)end;
    for (int i = 0; i < start; i++) {
        if (!quoted && rl_line_buffer[i] == '#')
            break;
        quoted ^= rl_line_buffer[i] == '"';
    }
    rl_completion_append_character = quoted ? '"' : '\0';
    if (quoted)
        return NULL;
    rl_attempted_completion_over = 1;
    return rl_completion_matches(prefix, next_word);
}

/* --- a line ------------------------------------------------------------------------- */

static struct {
    char *line; /* from readline, to be freed; NULL: the end of input */
    bool ready;
} answer;

static void
take_line(char *line)
{
    answer.line = line;
    answer.ready = true;
    rl_callback_handler_remove(); /* gives the terminal back */
}

/* Sleep until there is input or a signal; false: a signal. Signals can come only while
 * it sleeps, so none is missed between a look and the sleep. */
static bool
wait_for_input(void)
{
    struct pollfd input = {.fd = STDIN_FILENO, .events = POLLIN};
    sigset_t held, before;
    bool came = false;

    sigemptyset(&held);
    sigaddset(&held, SIGINT);
    sigaddset(&held, SIGTSTP);
    sigaddset(&held, SIGWINCH);
    sigprocmask(SIG_BLOCK, &held, &before);
    if (rl_pending_signal() == 0)
        came = ppoll(&input, 1, NULL, &before) > 0;
    sigprocmask(SIG_SETMASK, &before, NULL);
    return came;
}

typedef enum { LINE, CLEARED, ENDED } line_kind;

/* One line into *line (to be freed). CLEARED: Ctrl-C. */
static line_kind
read_line(const char *prompt, char **line)
{
    answer.line = NULL;
    answer.ready = false;
    qdot_signals_waiting();
    (void)qdot_signals_take();
    rl_callback_handler_install(prompt, take_line);
    while (!answer.ready) {
        /* before it sleeps: readline may have taken a signal while it showed the prompt */
        rl_check_signals();
        if (qdot_signals_take()) {
            rl_callback_sigcleanup();
            rl_free_line_state();
            rl_callback_handler_remove();
            fputc('\n', rl_outstream);
            fflush(rl_outstream);
            return CLEARED;
        }
        if (wait_for_input())
            rl_callback_read_char();
    }
    *line = answer.line;
    return answer.line != NULL ? LINE : ENDED;
}

/* --- the conversation --------------------------------------------------------------- */

static void
prepare(qdot_session *session)
{
    completing = session;
    rl_readline_name = "qdot";
    /* standard output may be a file, or hold only JSON */
    rl_outstream = session->json || !isatty(STDOUT_FILENO) ? stderr : stdout;
    rl_attempted_completion_function = complete;
    rl_basic_word_break_characters = " \t\n\"'`@$><=;|&{}()[]+-*/^,:.!%~#";
    rl_completer_quote_characters = "\"";
    rl_persistent_signal_handlers = 1;
    rl_variable_bind("enable-bracketed-paste", "off");
}

/* Read a whole statement, with its continuation lines, into `text`. */
static line_kind
read_statement(qdot_text *text, const qdot_text *history)
{
    qdot_text_truncate(text, 0);
    do {
        char *line = NULL;
        line_kind kind = read_line(text->n == 0 ? first_prompt : next_prompt, &line);

        if (kind == ENDED &&
            text->n > 0) /* Ctrl-D with a bracket open: let its error be told */
            return LINE;
        if (kind != LINE)
            return kind;
        history_note(line, history);
        qdot_text_add(text, line);
        qdot_text_char(text, '\n');
        free(line);
    } while (!text->failed && qdot_script_is_incomplete(text->at, text->n));
    return LINE;
}

void
qdot_prompt_run(qdot_session *session, bool banner)
{
    qdot_text text = {0}, history = {0};
    line_kind kind = LINE;

    prepare(session);
    history_begin(&history);
    if (banner)
        fprintf(rl_outstream, "qdot " PACKAGE_VERSION ". Write r(q), get the mechanics. "
                              "`help` helps, Ctrl-D leaves.\n");
    session->interactive = true;
    while (kind != ENDED && !session->quit) {
        kind = read_statement(&text, &history);
        if (kind != LINE)
            continue;
        qdot_signals_computing();
        if (text.failed)
            fprintf(stderr, "qdot: out of memory\n");
        else
            (void)qdot_script_run_text(session, "prompt", text.at, text.n);
        fflush(session->out);
        fflush(session->err);
        if (text.failed)
            qdot_text_clear(&text);
    }
    if (kind == ENDED)
        fputc('\n', rl_outstream);
    fflush(rl_outstream);
    session->interactive = false;
    qdot_text_clear(&text);
    qdot_text_clear(&history);
}
