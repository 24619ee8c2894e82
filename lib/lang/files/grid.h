/* grid.h -- a grid of numbers along runs, a column for each expression, for the statements `table` and `save`. */
#ifndef QDOT_LANG_GRID_H
#define QDOT_LANG_GRID_H

#include "lang/commands/operands.h"
#include "table/table.h"

typedef struct {
    qdot_dataset table;
    bool measured;           /* whether the numbers get errors; set it before the grid is filled */
    double *values, *errors; /* all cells, column by column; errors NULL: there are none */
    char **labels, **units; /* [table.n]; of a column without a unit: NULL */
} qdot_grid;

/* Evaluate t and every operand at these times [rows] into the grid's columns; free the grid in any case. */
QDOT_MUST_CHECK qdot_status qdot_grid_fill(qdot_grid *g, const qdot_operands *list, size_t rows,
                                           const double *times);
void qdot_grid_free(qdot_grid *g);
/* Write the columns to a file, in the form of its ending; path NULL: as an answer. run: the run of
 * all columns, or NULL. */
QDOT_MUST_CHECK qdot_status qdot_grid_write(qdot_session *session, qdot_grid *g, qdot_run *run,
                                            const char *path);

#endif
