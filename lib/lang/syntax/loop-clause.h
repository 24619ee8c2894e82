/* loop-clause.h -- the clause `for NAME = A..B, NAME = [1, 2, 5]` behind a statement or block, as a record.
 *
 * Its parts behind the word are NAME, `=`, A..B and a comma, again and again; those of `plot ... for` are the same.
 */
#ifndef QDOT_LANG_LOOP_CLAUSE_H
#define QDOT_LANG_LOOP_CLAUSE_H

#include "lang/syntax/record.h"

/* The clause `for NAME = A..B, ...` as a statement that is in no table, so that it can be read by its usage text. */
extern const qdot_statement qdot_loop_clause;

/* Read the clause whose word `for` is at the cursor, up to the end of the statement; usage: that of qdot_loop_clause. Free
 * the record in any case. QDOT_ESYNTAX with the place in record->cursor.error_at. */
QDOT_MUST_CHECK qdot_status qdot_loop_clause_read(const qdot_cursor *c, const qdot_usage *usage, qdot_record *record);
/* Fail after the values of a loop index because they are neither a range nor a list. */
qdot_status qdot_loop_clause_need_range(qdot_record *r, const qdot_filled *values);
/* Whether the values of a loop index begin as a list: [1, 2, 5]. */
bool qdot_loop_clause_is_list(const qdot_filled *values);

#endif
