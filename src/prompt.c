/* prompt.c -- the conversation at a terminal: readline, its history and completion.
 *
 * Readline is used through its callbacks: it never waits by itself, so a Ctrl-C reaches
 * us at a known place, and while a statement is carried out the terminal is as the
 * program found it.
 */
#include "prompt.h"

#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <readline/readline.h>

#include "base/terminal.h"
#include "base/wrap.h"
#include "completion.h"
#include "history.h"
#include "input-colours.h"
#include "lang/session/history.h"
#include "lang/session/outcome.h"
#include "lang/session/output.h"
#include "pager.h"
#include "signals.h"
#include "startup.h"

/* --- reading a line ----------------------------------------------------------------- */

static struct {
    char *line; /* the line from readline, to be freed; NULL: end of input */
    bool ready;
} answer;

static void
store_line(char *line)
{
    answer.line = line;
    answer.ready = true;
    rl_callback_handler_remove(); /* resets the terminal */
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

/* Readline may take a signal between characters that come in one go, and go on to the end of a line: what was
 * typed before Ctrl-C then stands in it. */
static void
discard_line(void)
{
    if (answer.ready) {
        free(answer.line);
        return;
    }
    rl_callback_sigcleanup();
    rl_free_line_state();
    rl_callback_handler_remove();
    fputc('\n', rl_outstream);
    fflush(rl_outstream);
}

typedef enum { LINE, CLEARED, ENDED } line_kind;

/* Read one line into *line (to be freed). Returns CLEARED if Ctrl-C was pressed. */
static line_kind
read_line(const char *prompt, char **line)
{
    answer.line = NULL;
    answer.ready = false;
    qdot_signals_waiting();
    (void)qdot_signals_take();
    rl_callback_handler_install(prompt, store_line);
    for (;;) {
        /* check before waiting: readline may have received a signal while it showed the prompt */
        rl_check_signals();
        if (qdot_signals_take()) {
            discard_line();
            return CLEARED;
        }
        if (answer.ready)
            break;
        if (wait_for_input())
            rl_callback_read_char();
    }
    *line = answer.line;
    return answer.line != NULL ? LINE : ENDED;
}

/* --- reading and carrying out statements -------------------------------------------- */

static void
prepare_readline(qdot_session *session)
{
    qdot_completion_install(session);
    rl_readline_name = "qdot";
    /* standard output may be a file, or hold only JSON */
    rl_outstream = session->output->json || !isatty(STDOUT_FILENO) ? stderr : stdout;
    rl_persistent_signal_handlers = 1;
    rl_variable_bind("enable-bracketed-paste", "off");
    /* where the locale knows only ASCII, do not take the bytes of θ for keys with Meta */
    rl_variable_bind("input-meta", "on");
    rl_variable_bind("output-meta", "on");
    rl_variable_bind("convert-meta", "off");
    qdot_input_colours_install(session);
}

/* Write `qdot 3> `, where %3 is the next value's name; lines that continue a statement are aligned below. */
static void
write_prompt(const qdot_session *session, bool first, qdot_text *prompt)
{
    const bool colours = qdot_terminal_has_colours(rl_outstream);
    qdot_text plain = {0};
    int width;

    qdot_text_truncate(prompt, 0);
    qdot_text_format(&plain, "qdot %zu> ", session->history->values.n + 1);
    width = (int)plain.n;
    if (!first) {
        qdot_text_truncate(&plain, 0);
        qdot_text_format(&plain, "%*s", width, "...> ");
    }
    /* readline does not count the characters between \001 and \002 */
    qdot_text_format(prompt, "%s%s%s", colours ? "\001" QDOT_BOLD QDOT_BLUE "\002" : "",
                     qdot_text_str(&plain), colours ? "\001" QDOT_COLOUR_END "\002" : "");
    qdot_text_clear(&plain);
}

/* Read a whole statement, with its continuation lines, into `text`. */
static line_kind
read_statement(const qdot_session *session, qdot_text *text)
{
    qdot_text prompt = {0};
    line_kind kind = LINE;

    qdot_text_truncate(text, 0);
    do {
        char *line = NULL;

        if (text->n > 0)
            qdot_text_char(text, '\n');
        qdot_completion_continue(qdot_text_str(text));
        qdot_input_colours_continue(qdot_text_str(text));
        write_prompt(session, text->n == 0, &prompt);
        kind = read_line(qdot_text_str(&prompt), &line);
        if (kind != LINE)
            break;
        qdot_text_add(text, line);
        free(line);
    } while (!text->failed && qdot_script_is_incomplete(text->at, text->n));
    qdot_completion_continue("");
    qdot_input_colours_continue("");
    qdot_text_clear(&prompt);
    if (text->n > 0 && text->at[text->n - 1] == '\n')
        qdot_text_truncate(text, text->n - 1); /* remove the newline that was added for a further line, as none came */
    /* keep a statement that was given up, too: it may be recalled and corrected */
    if (!text->failed && text->n > 0)
        qdot_history_note(text->at);
    /* after Ctrl-D with an open bracket, carry out the text, so that its error is reported */
    return kind == ENDED && text->n > 0 ? LINE : kind;
}

/* Replace `?word` by `help word`, and `??word` by `help search word`. */
static void
expand_help_shortcut(qdot_text *text)
{
    const size_t blanks = strspn(qdot_text_str(text), " \t");
    qdot_text whole = {0};

    if (text->failed || text->n == blanks || text->at[blanks] != '?')
        return;
    qdot_text_add(&whole, text->at[blanks + 1] == '?' ? "help search " : "help ");
    qdot_text_add(&whole, text->at + blanks + (text->at[blanks + 1] == '?' ? 2 : 1));
    qdot_text_clear(text);
    *text = whole;
}

static void
carry_out_input(qdot_session *session, qdot_text *text)
{
    bool pages;

    expand_help_shortcut(text);
    qdot_text_char(text, '\n');
    pages = !text->failed && !qdot_script_takes_long(text->at, text->n) && qdot_pager_begin(session);
    qdot_signals_computing();
    if (text->failed)
        fprintf(stderr, "qdot: out of memory\n");
    else
        (void)qdot_script_run_text(session, "prompt", text->at, text->n);
    fflush(session->output->out);
    fflush(session->output->err);
    if (pages)
        qdot_pager_end(session);
    if (text->failed)
        qdot_text_clear(text);
}

static void
print_greeting(void)
{
    size_t columns = 0, rows;
    qdot_text lines = {0};

    (void)qdot_terminal_size(rl_outstream, &columns, &rows);
    qdot_wrap("qdot " PACKAGE_VERSION
              ". Write r(q), get the mechanics. `help` helps, Ctrl-D leaves.\n",
              columns, &lines);
    fputs(qdot_text_str(&lines), rl_outstream);
    qdot_text_clear(&lines);
}

void
qdot_prompt_run(qdot_session *session, bool banner, bool startup)
{
    qdot_text text = {0};
    line_kind kind = LINE;

    prepare_readline(session);
    qdot_history_begin();
    if (banner)
        print_greeting();
    qdot_signals_patient(true);
    if (startup)
        qdot_startup_read(session);
    while (kind != ENDED && !session->outcome->quit) {
        kind = read_statement(session, &text);
        if (kind == LINE)
            carry_out_input(session, &text);
    }
    if (kind == ENDED)
        fputc('\n', rl_outstream);
    fflush(rl_outstream);
    qdot_signals_patient(false);
    qdot_text_clear(&text);
    qdot_history_end();
}
