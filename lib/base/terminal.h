/* terminal.h -- the terminal that a stream writes to. */
#ifndef QDOT_BASE_TERMINAL_H
#define QDOT_BASE_TERMINAL_H

#include <stdbool.h>
#include <stdio.h>

/* Its size in characters; one that does not tell its size has 80 x 24. false: the stream goes
 * elsewhere. */
bool qdot_terminal_size(FILE *stream, size_t *columns, size_t *rows);

#endif
