/* export-tables.h -- tables of data (num/samples.h) in exported programs.
 *
 * An exported program holds the knots of each axis and the coefficients of each power as arrays, and reads them as a tape does:
 *
 *     find_piece(x, KNOTS, n, beyond, jumps)     the number of the piece that holds x
 *     knot_of(piece, KNOTS, n, beyond)           the knot from which its polynomial counts
 *     entry_of(piece, COEFFICIENTS, period)      its coefficient
 *     knot_after(next, t, way, a, b, KNOTS, n, beyond, jumps)   the nearer of `next` and where a + b t passes a knot
 *
 * so that the interpolation is the same. beyond: 0: no value there, 1: the value at the end, 2: periodic. These calls are written
 * the same way in all the languages. Steps of the exported integrator end at knots as those of runs do (tape/knots.h): a
 * rounding behind them, of tables that jump first a rounding before.
 *
 * Tests  tests/meta/exports.test
 */
#ifndef QDOT_SHOW_EXPORT_TABLES_H
#define QDOT_SHOW_EXPORT_TABLES_H

#include "base/text.h"
#include "num/samples.h"
#include "tape/knots.h"

typedef struct {
    qdot_vec(double) columns; /* handles of what is written as an array: of knots, of coefficients */
    qdot_knots lines;         /* where a motion reads tables at a + b t */
    char prefix[16];          /* what the names of arrays begin with */
} qdot_export_tables;

void qdot_export_tables_clear(qdot_export_tables *tables);

/* Write find_piece(...), knot_of(...) or entry_of(...) for the tape's lookup(x, handle): which of them, and of which table, the
 * handle tells. x: the source text of the place, or of the number of a piece. */
void qdot_export_lookup(const qdot_export_tables *tables, double handle, const char *x, qdot_text *out);

/* Write ", NAME, n, beyond": the axis of a view (num/samples.h) as an argument. */
void qdot_export_axis(const qdot_export_tables *tables, const qdot_samples_view *view, qdot_text *out);

/* Append the arrays of the tables that a tape (may be NULL) reads. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_export_tables_find(qdot_export_tables *tables, const qdot_tape *tape);

#endif
