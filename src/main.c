/* main.c -- the program: reads options, runs scripts in their order, then the prompt; gives the exit status. */
#include <errno.h>
#include <getopt.h>
#include <langinfo.h>
#include <locale.h>
#include <stdio.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "base/terminal.h"
#include "expr/print-name.h"
#include "lang/session/outcome.h"
#include "lang/session/output.h"
#include "lang/session/session.h"
#include "lang/workbench/script.h"
#ifdef HAVE_JANSSON
# include "lsp/server.h"
#endif
#include "num/kinds.h"
#include "parallel/ranks.h"
#include "progress-line.h"
#include "prompt.h"
#include "signals.h"
#include "stream.h"

enum { DONE = 0, FAILED = 1, MISUSED = 2 }; /* exit statuses of the program */

static const char usage[] =
    "Usage: qdot [OPTION]... [FILE]...\n"
    "Write positions r(q), get the mechanics: equations of motion derived exactly,\n"
    "integrated fast, with the error stated.\n"
    "\n"
    "Each FILE is a script; they and the texts of -e are carried out in the order\n"
    "given, in one session. Without any, or with -i after them, statements are read\n"
    "from the terminal with a prompt, or else from standard input.\n"
    "\n"
    "  -e, --execute=STATEMENTS  carry out STATEMENTS\n"
    "  -i, --interactive         continue at the prompt afterwards\n"
    "      --json                print a JSON object for each result, nothing else\n"
    "      --lsp                 serve an editor: the Language Server Protocol on standard\n"
    "                            input and output\n"
    "      --no-init             do not read the prompt's startup file,\n"
    "                            $XDG_CONFIG_HOME/qdot/init.lag\n"
    "  -q, --quiet               print no banner\n"
    "      --processor=KIND      compute as if the processor had no more than KIND:\n"
    "                            any, avx2, avx512\n"
    "  -h, --help                print this help and exit\n"
    "  -V, --version             print the version and exit\n"
    "  -                         standard input as a script\n"
    "\n"
    "Exit status: 0 if all went well; 1 if a statement failed or a check was\n"
    "refuted; 2 for bad usage or a syntax error.\n"
    "\n"
    "At the prompt `help` lists the language; `info qdot` is the whole manual.\n";

static const char version[] =
    "qdot " PACKAGE_VERSION "\n"
#ifdef HAVE_MPI
    "With OpenMPI: mpirun -n RANKS qdot FILE divides sweeps among its ranks.\n"
#endif
#ifdef QDOT_ONE_THREAD
    "With --disable-threads: one thread of one process computes.\n"
#endif
    "License GPLv3+: GNU GPL version 3 or later <https://gnu.org/licenses/gpl.html>.\n"
    "This is free software: you are free to change and redistribute it.\n"
    "There is NO WARRANTY, to the extent permitted by law.\n";

/* --- the command line --------------------------------------------------------------- */

/* A script, or the text of an option -e, in the order given on the command line. */
typedef struct {
    const char *text; /* a file name, or statements */
    bool statements;
} task;

typedef struct {
    qdot_vec(task) tasks;
    bool interactive, json, quiet, no_init, server;
    const char *task;  /* what the server has this process do; NULL: it is the server */
    const char *print; /* text of --help or --version, printed instead of running anything */
} options;

static const struct option names[] = {
    {"execute", required_argument, NULL, 'e'},
    {"interactive", no_argument, NULL, 'i'},
    {"json", no_argument, NULL, 'j'},
    {"lsp", optional_argument, NULL, 'l'}, /* the argument is for processes of the server */
    {"quiet", no_argument, NULL, 'q'},
    {"no-init", no_argument, NULL, 'n'},
    {"processor", required_argument, NULL, 'p'},
    {"help", no_argument, NULL, 'h'},
    {"version", no_argument, NULL, 'V'},
    {NULL, 0, NULL, 0},
};

static qdot_status
fail_usage(void)
{
    fputs("Try 'qdot --help'.\n", stderr);
    return qdot_fail(QDOT_EINVAL, "bad usage");
}

/* Limit by name the kinds of processors (num/kinds.h) whose special code may be used. */
static qdot_status
limit_processor(const char *name)
{
    static const char *const kinds[] = {"any", "avx2", "avx512"};

    for (size_t kind = 0; kind < sizeof kinds / sizeof *kinds; kind++)
        if (strcmp(name, kinds[kind]) == 0) {
            qdot_kind_limit(kind);
            return QDOT_OK;
        }
    fprintf(stderr, "qdot: --processor=%s: it is any, avx2 or avx512\n", name);
    return fail_usage();
}

static qdot_status
options_read(int argc, char **argv, options *o)
{
    int c;

    /* the leading `-` makes getopt return other arguments as option 1, in their order */
    while ((c = getopt_long(argc, argv, "-e:hiqV", names, NULL)) != -1) {
        switch (c) {
        case 1: QDOT_TRY(qdot_vec_push(&o->tasks, ((task){optarg, false}))); break;
        case 'e': QDOT_TRY(qdot_vec_push(&o->tasks, ((task){optarg, true}))); break;
        case 'i': o->interactive = true; break;
        case 'j': o->json = true; break;
        case 'l': o->server = true; o->task = optarg; break;
        case 'n': o->no_init = true; break;
        case 'q': o->quiet = true; break;
        case 'h': o->print = o->print != NULL ? o->print : usage; break;
        case 'V': o->print = o->print != NULL ? o->print : version; break;
        case 'p': QDOT_TRY(limit_processor(optarg)); break;
        default: return fail_usage();
        }
    }
    for (; optind < argc; optind++) /* arguments after `--` are file names */
        QDOT_TRY(qdot_vec_push(&o->tasks, ((task){argv[optind], false})));
    return QDOT_OK;
}

/* --- carrying out scripts and statements -------------------------------------------- */

/* Greek and superscripts for a terminal that shows them, ASCII that parses back
 * elsewhere. */
static qdot_style
choose_output_style(void)
{
    return qdot_terminal_is(stdout) && strcmp(nl_langinfo(CODESET), "UTF-8") == 0
               ? QDOT_UNICODE
               : QDOT_PLAIN;
}

static int
run_tasks(qdot_session *session, const options *o)
{
    int status = DONE;

    for (size_t i = 0; i < o->tasks.n && !session->outcome->failed && !session->outcome->quit; i++) {
        const task *t = &o->tasks.at[i];

        qdot_signals_computing();
        status = t->statements
                     ? qdot_script_run_text(session, "-e", t->text, strlen(t->text))
                     : qdot_script_run_file(session, t->text);
    }
    if ((o->tasks.n > 0 && !o->interactive) || session->outcome->quit)
        return status;
    if (qdot_terminal_is(stdin)) {
        qdot_prompt_run(session, !o->quiet, !o->no_init);
    } else if (o->interactive && o->json) {
        qdot_stream_run(session);
    } else {
        int last;

        qdot_signals_computing();
        last = qdot_script_run_file(session, "-");
        status = last > status ? last : status;
    }
    return status;
}

/* The exit status of the program: `status`, or FAILED if standard output could not be written completely. */
static int
final_exit_status(int status)
{
    int reason = 0;

    errno = 0;
    if (fflush(stdout) != 0 || ferror(stdout))
        reason = errno != 0 ? errno : EIO;
    if (close(STDOUT_FILENO) != 0 && errno != EBADF && reason == 0)
        reason = errno;
    if (reason == 0)
        return status;
    fprintf(stderr, "qdot: cannot write standard output: %s\n", strerror(reason));
    return status != DONE ? status : FAILED;
}

/* What a run gives back is there for the next: asked for anew it is a page fault every 4 kB, a
 * tenth of a short run. Threads share one arena: they allocate little, and one of their own costs
 * each ten pages and two system calls. */
static void
keep_freed_memory(void)
{
#ifdef __GLIBC__
    mallopt(M_ARENA_MAX, 1);
    mallopt(M_TRIM_THRESHOLD, 1 << 26);
    mallopt(M_TOP_PAD, 1 << 20);
    mallopt(M_MMAP_THRESHOLD, 1 << 22); /* set explicitly, because the first mallopt call fixes it at a low value */
#endif
}

/* If mpirun started this process, join its group of processes as one rank. */
static qdot_status
join_ranks(const options *o)
{
    size_t kind = 2;
    const qdot_error *error = qdot_last_error();

    while (!qdot_kind_is_here(kind))
        kind--;
    if (qdot_ranks_begin(&kind) != QDOT_OK) {
        fprintf(stderr, "qdot: %s\n", error->message);
        if (error->hint[0] != '\0')
            fprintf(stderr, "hint: %s\n", error->hint);
        return error->status;
    }
    qdot_kind_limit(kind);
    if (qdot_ranks_count() == 1 || !o->interactive)
        return QDOT_OK;
    if (qdot_rank() == 0)
        fputs("qdot: several ranks have no prompt: give them a script\n", stderr);
    return QDOT_EINVAL;
}

/* Serve an editor until it ends that. */
static int
serve_editor(const char *program, const char *task)
{
#ifdef HAVE_JANSSON
    return qdot_lsp_run(program, task);
#else
    (void)program, (void)task;
    fputs("qdot: --lsp: this program was built without jansson, which the language server needs\n"
          "hint: install it (Debian: libjansson-dev) and build qdot anew\n",
          stderr);
    return FAILED;
#endif
}

/* Make the session of a rank other than 0, which computes, but whose answers rank 0 gives. */
static qdot_session *
make_silent_session(void)
{
    FILE *nowhere = fopen("/dev/null", "w");

    return nowhere != NULL ? qdot_session_new(nowhere, nowhere) : NULL;
}

int
main(int argc, char **argv)
{
    options o = {0};
    qdot_session *session;
    int status;

    keep_freed_memory();
    /* for a terminal, which asks for it; reading a locale takes as long as a short script. No other
     * category: numbers stay as in C */
    if (qdot_terminal_is(stdin) || qdot_terminal_is(stdout))
        setlocale(LC_CTYPE, "");
    if (options_read(argc, argv, &o) != QDOT_OK) {
        qdot_free(o.tasks.at);
        return MISUSED;
    }
    if (o.print != NULL) {
        qdot_free(o.tasks.at);
        if (!qdot_ranks_are_others())
            fputs(o.print, stdout);
        return final_exit_status(DONE);
    }
    if (o.server) {
        qdot_free(o.tasks.at);
        return serve_editor(argv[0], o.task);
    }
    if (join_ranks(&o) != QDOT_OK) {
        qdot_free(o.tasks.at);
        return qdot_ranks_end(FAILED);
    }
    session = qdot_rank() == 0 ? qdot_session_new(stdout, stderr) : make_silent_session();
    if (session == NULL) {
        fputs("qdot: out of memory\n", stderr);
        qdot_free(o.tasks.at);
        return qdot_ranks_end(FAILED);
    }
    session->output->json = o.json;
    if (!o.json && qdot_terminal_has_colours(stdout))
        session->output->colours |= QDOT_COLOURS_ANSWERS;
    if (qdot_terminal_has_colours(stderr))
        session->output->colours |= QDOT_COLOURS_ERRORS;
    session->output->style = o.json ? QDOT_PLAIN : choose_output_style();
    if (qdot_terminal_is(stderr) && !o.json)
        qdot_progress_line_install();
    qdot_signals_install();
    status = run_tasks(session, &o);
    qdot_session_free(session);
    qdot_free(o.tasks.at);
    return qdot_ranks_end(final_exit_status(status));
}
