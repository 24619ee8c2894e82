/* history.h -- the statements typed, kept between sessions.
 *
 * A statement of several lines is one entry. In the file each entry is a line, in which the byte
 * 0x1E (the record separator of ASCII, which no text holds) stands for the end of a line: so a
 * file of single lines, as older versions wrote it, reads as it did.
 *
 * Tests  tests/src/test_prompt.c
 */
#ifndef QDOT_HISTORY_H
#define QDOT_HISTORY_H

/* Read the file $XDG_STATE_HOME/qdot/history, or else ~/.local/state/qdot/history. If it cannot
 * be written, a message says so, and history lasts as long as the session. */
void qdot_history_begin(void);

/* Add a statement, at once to the file too, so that no crash loses it. Blanks and repetitions are
 * left out. */
void qdot_history_note(const char *statement);

void qdot_history_end(void);

#endif
