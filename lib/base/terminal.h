/* terminal.h -- finds properties of the terminal to which a stream writes. */
#ifndef QDOT_BASE_TERMINAL_H
#define QDOT_BASE_TERMINAL_H

#include <stdbool.h>
#include <stdio.h>

/* Whether a stream is a terminal; false for the pseudo-terminals that mpirun gives its ranks. */
bool qdot_terminal_is(const FILE *stream);

/* The size of the terminal in characters; 80 x 24 if it is not known. false: the stream goes
 * elsewhere. */
bool qdot_terminal_size(const FILE *stream, size_t *columns, size_t *rows);

/* Whether colours may be shown on the stream: it is a terminal, TERM is not `dumb`, and NO_COLOR is
 * not set, or empty. */
bool qdot_terminal_has_colours(FILE *stream);

#define QDOT_RED "\033[31m"
#define QDOT_GREEN "\033[32m"
#define QDOT_YELLOW "\033[33m"
#define QDOT_BLUE "\033[34m"
#define QDOT_MAGENTA "\033[35m"
#define QDOT_CYAN "\033[36m"
#define QDOT_GREY "\033[90m"
#define QDOT_BOLD "\033[1m"
#define QDOT_COLOUR_END "\033[0m"

#endif
