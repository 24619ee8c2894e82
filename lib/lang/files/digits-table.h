/* digits-table.h -- tables along runs with `digits`.
 *
 * Tests  tests/script/digits-table.lag
 */
#ifndef QDOT_LANG_DIGITS_TABLE_H
#define QDOT_LANG_DIGITS_TABLE_H

#include "lang/commands/operands.h"

/* The fewest digits of the operands' runs, where all of them have `digits`; else 0. */
int qdot_digits_table_of(const qdot_operands *list);

/* A table of `rows` times from + k step, exact: text, rows of JSON (the time a number, the
 * others strings) or, with a path, a file of text or of comma-separated values. */
QDOT_MUST_CHECK qdot_status qdot_digits_table(qdot_session *session,
                                              const qdot_operands *list,
                                              qdot_expr from, qdot_expr step, size_t rows,
                                              const char *path);

#endif
