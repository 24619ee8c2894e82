/* history.c -- keeps the statements typed at the prompt in a file between sessions. */
#include "history.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <readline/history.h>

#include "base/text.h"

enum { ENTRIES = 10000, END_OF_LINE = 0x1E };

static qdot_text path; /* path of the history file; empty: none */

/* Create the folders above `file` that are missing, as `mkdir -p` does. */
static bool
make_folders(char *file)
{
    for (char *slash = strchr(file + 1, '/'); slash != NULL;
         slash = strchr(slash + 1, '/')) {
        bool made;

        *slash = '\0';
        made = mkdir(file, 0700) == 0 || errno == EEXIST;
        *slash = '/';
        if (!made)
            return false;
    }
    return true;
}

static void
find_history_path(void)
{
    const char *state = getenv("XDG_STATE_HOME"), *home = getenv("HOME");

    if (state != NULL && state[0] == '/')
        qdot_text_format(&path, "%s/qdot/history", state);
    else if (home != NULL && home[0] == '/')
        qdot_text_format(&path, "%s/.local/state/qdot/history", home);
}

/* Replace every character `from` of the text by `to`. */
static void
replace_characters(char *text, char from, char to)
{
    for (; (text = strchr(text, from)) != NULL; text++)
        *text = to;
}

void
qdot_history_begin(void)
{
    int fd;

    using_history();
    find_history_path();
    if (path.n == 0)
        return;
    if (!make_folders(path.at) ||
        (fd = open(path.at, O_WRONLY | O_CREAT | O_CLOEXEC, 0600)) < 0) {
        fprintf(stderr, "qdot: history is not kept: %s: %s\n", path.at, strerror(errno));
        qdot_text_truncate(&path, 0);
        return;
    }
    close(fd);
    history_truncate_file(path.at, ENTRIES);
    read_history(path.at);
    stifle_history(ENTRIES);
    for (int i = 0; i < history_length; i++)
        replace_characters(history_get(history_base + i)->line, END_OF_LINE, '\n');
}

void
qdot_history_note(const char *statement)
{
    HIST_ENTRY *last =
        history_length > 0 ? history_get(history_base + history_length - 1) : NULL;

    if (statement[strspn(statement, " \t\n")] == '\0' ||
        (last != NULL && strcmp(last->line, statement) == 0))
        return;
    add_history(statement);
    last = history_get(history_base + history_length - 1);
    if (path.n == 0 || last == NULL)
        return;
    replace_characters(last->line, '\n', END_OF_LINE);
    append_history(1, path.at);
    replace_characters(last->line, END_OF_LINE, '\n');
}

void
qdot_history_end(void)
{
    qdot_text_clear(&path);
}
