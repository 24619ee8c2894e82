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

/* Append the lines of `text`, none wider than `width` columns where a blank allows it; width 0: as
 * they are. Codes for colours take no columns.
 *
 * A line is broken at blanks, but not beside = or ±, and not behind + or -. What follows is
 * indented to the second column, if the line has one behind two blanks or more, else by two more
 * than the line.
 *
 * Lines with QDOT_WRAP_CELL that follow each other are a table, the first its head. If it is too
 * wide, its columns stand in blocks one below the other, each with the first columns, as many as
 * tell one row from the next; where no other column fits beside them, each cell is a line "name
 * value".
 *
 * Text that is longer than what there is memory for marks `out` (qdot_text_status). */
void qdot_wrap(const char *text, size_t width, qdot_text *out);

#endif
