/* digits-table.h -- tables along runs with `digits`.
 *
 * Tests  tests/script/digits/digits-table.lag
 */
#ifndef QDOT_LANG_DIGITS_TABLE_H
#define QDOT_LANG_DIGITS_TABLE_H

#include "lang/commands/operands.h"

/* The smallest number of `digits` with which the operands' runs were made; 0 if one was made without that option. */
int qdot_digits_table_of(const qdot_operands *list);

/* A table at exact times [rows], nil: the end of the run; beside [rows], NULL: none: the row is that point of
 * the run, on its side of an event. Text, rows of JSON (the time a number, the
 * others strings) or, with a path, a file by its ending (data-file.h); run as there. */
QDOT_MUST_CHECK qdot_status qdot_digits_table(qdot_session *session,
                                              const qdot_operands *list, qdot_run *run,
                                              size_t rows, const qdot_expr *times,
                                              const bool *beside, const char *path);

#endif
