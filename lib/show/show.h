/* show.h -- columns of numbers as tables and data files.
 *
 * Knows columns of doubles and their labels, not scenes. Numbers are written in the C locale.
 */
#ifndef QDOT_SHOW_SHOW_H
#define QDOT_SHOW_SHOW_H

#include <stddef.h>

#include "base/text.h"

typedef struct {
    const char *label; /* UTF-8 */
    const double *at;  /* [rows] borrowed */
} qdot_column;

/* Rows as text, aligned columns, header first; `digits` significant. `mark` stands before each cell
 * but the first of a row: "" or QDOT_WRAP_CELL of base/wrap.h. */
QDOT_MUST_CHECK qdot_status qdot_table_text(size_t columns, const qdot_column *column, size_t rows,
                                            int digits, const char *mark, qdot_text *out);
/* Comma-separated values, header quoted by RFC 4180 where needed, 17 digits. path "-": stdout. */
QDOT_MUST_CHECK qdot_status qdot_table_csv(size_t columns, const qdot_column *column,
                                           size_t rows, const char *path);
/* The same with columns of texts among them, as qdot_data has them: texts [columns] of [rows]. */
QDOT_MUST_CHECK qdot_status qdot_table_csv_texts(size_t columns, const qdot_column *column,
                                                 char *const *const *texts, size_t rows,
                                                 const char *path);
#endif
