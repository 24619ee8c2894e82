/* terminal.c -- asks the system for the size of a terminal. */
#include "base/terminal.h"

#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "base/process.h"

bool
qdot_terminal_is(const FILE *stream)
{
    const int file = fileno((FILE *)stream);

    return file >= 0 && isatty(file) && !qdot_ranks_are_there();
}

bool
qdot_terminal_size(const FILE *stream, size_t *columns, size_t *rows)
{
    const int file = fileno((FILE *)stream);
    struct winsize size = {0};

    if (!qdot_terminal_is(stream))
        return false;
    if (ioctl(file, TIOCGWINSZ, &size) != 0)
        size = (struct winsize){0};
    *columns = size.ws_col > 0 ? size.ws_col : 80;
    *rows = size.ws_row > 0 ? size.ws_row : 24;
    return true;
}

bool
qdot_terminal_has_colours(FILE *stream)
{
    const char *term = getenv("TERM"), *no = getenv("NO_COLOR");

    return qdot_terminal_is(stream) && term != NULL && term[0] != '\0' &&
           strcmp(term, "dumb") != 0 && (no == NULL || no[0] == '\0');
}
