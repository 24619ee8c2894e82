/* terminal.c -- the size of a terminal, asked of the system. */
#include "base/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

bool
qdot_terminal_size(FILE *stream, size_t *columns, size_t *rows)
{
    const int file = fileno(stream);
    struct winsize size = {0};

    if (file < 0 || !isatty(file))
        return false;
    if (ioctl(file, TIOCGWINSZ, &size) != 0)
        size = (struct winsize){0};
    *columns = size.ws_col > 0 ? size.ws_col : 80;
    *rows = size.ws_row > 0 ? size.ws_row : 24;
    return true;
}
