/* text.h -- a table as text: columns under each other, the heads first.
 *
 * A column is as wide as its widest cell, or as it says; numbers end below each other.
 *
 * Tests  tests/table/test_text.c
 */
#ifndef QDOT_TABLE_TEXT_H
#define QDOT_TABLE_TEXT_H

#include "table/table.h"

typedef struct {
    unsigned in;      /* where the table is written: QDOT_IN_TERMINAL or QDOT_IN_TXT */
    int digits;       /* significant digits of all numbers; 0: as each column states */
    const char *mark; /* written before each cell except the first of a row: "" or QDOT_WRAP_CELL (base/wrap.h) */
} qdot_table_text_options;

QDOT_MUST_CHECK qdot_status qdot_table_text(const qdot_dataset *t, const qdot_table_text_options *options,
                                            qdot_text *out);

#endif
