/* wrap.h -- text for a terminal: lines broken at blanks, tables folded, to the width of a window.
 *
 * Tests  tests/base/test_wrap.c
 */
#ifndef QDOT_BASE_WRAP_H
#define QDOT_BASE_WRAP_H

#include "base/text.h"

/* Stands in a table before each cell but the first of a row. It takes no column; qdot_wrap removes
 * it. The blanks that align a cell belong to that cell. */
#define QDOT_WRAP_CELL "\x1f"

/* Append the lines of `text`, none wider than `width` columns; width 0: as they are. Codes for
 * colours take no columns.
 *
 * A line is broken at blanks, but not beside = or ±, and not behind + or -; a word only where it is
 * longer than a line (qdot_wrap_cut). What follows is indented to the second column, if the line has one behind two blanks or more, else by two more
 * than the line.
 *
 * Lines with QDOT_WRAP_CELL that follow each other are a table, the first its head. If it is too
 * wide, its columns stand in blocks one below the other, each with the first columns, as many as
 * tell one row from the next; where no other column fits beside them, each cell is a line "name
 * value", the
 * value below its name where it does not fit beside it.
 *
 * Text that is longer than what there is memory for marks `out` (qdot_text_status). */
void qdot_wrap(const char *text, size_t width, qdot_text *out);

/* How many bytes of a word of n bytes (in a text that ends with NUL) stand in a line of `room` columns: all; else up
 * to behind a comma, a bracket or the like in the second half of the room; else as many as fit, and one letter in any
 * case. */
size_t qdot_wrap_cut(const char *text, size_t n, size_t room);

#endif
