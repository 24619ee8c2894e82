/* show.h -- columns of numbers as figures, tables and data files.
 *
 * Knows columns of doubles and their labels, not scenes. File names and labels reach gnuplot quoted; numbers
 * are written in the C locale.
 */
#ifndef QDOT_SHOW_SHOW_H
#define QDOT_SHOW_SHOW_H

#include <stddef.h>

#include "base/text.h"

typedef struct {
    const char *label; /* UTF-8 */
    const double *at;  /* [rows] borrowed */
} qdot_column;

typedef struct {
    const char *title;
    const char *x_label, *y_label;
    size_t curves;             /* curve i: x[i] against y[i] */
    const qdot_column *x, *y;  /* [curves]; y[i].label is the key; one curve has no key */
    const size_t *rows;        /* [curves] */
    bool equal_axes;           /* paths */
    bool log_x, log_y;
    bool marks;                /* a mark at every point, joined by lines */
} qdot_figure;

/* Type by ending: .svg .png .pdf through gnuplot; QDOT_EINVAL for another; QDOT_EIO where gnuplot is missing or
 * fails or the file cannot be written. window (path NULL): a gnuplot window that persists. */
QDOT_MUST_CHECK qdot_status qdot_figure_write(const qdot_figure *figure, const char *path);

/* Rows as text, aligned columns, header first; `digits` significant. */
QDOT_MUST_CHECK qdot_status qdot_table_text(size_t columns, const qdot_column *column,
                                            size_t rows, int digits, qdot_text *out);
/* Comma-separated values, header quoted by RFC 4180 where needed, 17 digits. path "-": stdout. */
QDOT_MUST_CHECK qdot_status qdot_table_csv(size_t columns, const qdot_column *column,
                                           size_t rows, const char *path);
#endif
