/* input-colours.h -- colours for what is typed at the prompt, while it is typed.
 *
 * Tests  tests/src/test_screen.c
 */
#ifndef QDOT_SRC_INPUT_COLOURS_H
#define QDOT_SRC_INPUT_COLOURS_H

#include "lang/session/parts.h"

/* Colour the line being typed from now on, if rl_outstream shows colours. */
void qdot_input_colours_install(qdot_session *session);
/* Set the earlier lines of a statement that has several lines. */
void qdot_input_colours_continue(const char *before);

#endif
