/* plot-rows.h -- the rows of a sweep as a figure: each number over what was swept.
 *
 * Tests  tests/script/sweeps/sweep.sh
 */
#ifndef QDOT_LANG_PLOT_ROWS_H
#define QDOT_LANG_PLOT_ROWS_H

#include "lang/syntax/record.h"

/* Whether the statement `plot` names a table of rows, or nothing. */
bool qdot_plot_rows_is(const qdot_record *r);
/* `[NAME]` with options: a curve for each number, over the one thing swept; over two, a map for each; of
 * random draws and of sections, points: the other numbers over the first. Without a name: the branches of equilibria or
 * orbits. */
QDOT_MUST_CHECK qdot_status qdot_plot_rows(qdot_record *r);

#endif
