/* plot-rows.h -- the rows of a sweep as a figure: each number over what was swept.
 *
 * Tests  tests/script/sweeps/sweep.sh
 */
#ifndef QDOT_LANG_PLOT_ROWS_H
#define QDOT_LANG_PLOT_ROWS_H

#include "lang/language/cursor.h"

/* Whether the cursor stands before the name of a table of rows, with options of a figure or nothing
 * behind it; or before these alone, where there are branches of equilibria. */
bool qdot_plot_rows_is(const qdot_cursor *c);
/* `NAME` with options: a curve for each number, over the one thing swept; over two, a map for each; of
 * random draws and of sections, points: the other numbers over the first. */
QDOT_MUST_CHECK qdot_status qdot_plot_rows(qdot_cursor *c);

#endif
