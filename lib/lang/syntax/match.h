/* match.h -- the tokens of a statement, read by the usage of its row.
 *
 * At each token a word of the usage goes before a hole, a sign before an expression. If a name and
 * an expression may stand there, it is a name where what follows a name follows: `gravity g: ...`.
 * Alternatives are followed side by side until the tokens tell them apart.
 *
 * Where no token fits, the usage says what would: its words, the end, a sign; a row of
 * expected.def says it where a person would say it better.
 *
 * Tests  tests/lang/syntax/test_syntax.c
 */
#ifndef QDOT_LANG_MATCH_H
#define QDOT_LANG_MATCH_H

#include "lang/syntax/record.h"

/* Read the statement at the cursor, whose first token is its word, up to its end. *u: of
 * qdot_usage_compile(row); it must stay as long as the record. Free the record in any case.
 * QDOT_ESYNTAX with the place in record->cursor.error_at. */
QDOT_MUST_CHECK qdot_status qdot_match(const qdot_cursor *c, const qdot_statement *row,
                                       const qdot_usage *u, qdot_record *record);

/* The operands of the row's statement at the cursor, its word not among the tokens: "0..20 tol 1e-9" of `run`. The record
 * has its own usage. Errors as before, and QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_match_operands(const qdot_cursor *c, const qdot_statement *row,
                                                qdot_record *record);
/* As qdot_match_operands, for tokens that end before `end`, within a statement. */
QDOT_MUST_CHECK qdot_status qdot_match_operands_to(const qdot_cursor *c, const qdot_token *end,
                                                   const qdot_statement *row, qdot_record *record);
/* What may come next in a statement that is being typed. */
enum { QDOT_NEXT = 96 };
typedef struct {
    struct {
        const qdot_usage_node *node; /* a word, sign or hole, the end; forks lead to others */
        uint64_t taken;              /* bits of the options that have been given */
    } at[QDOT_NEXT];
    int n;
    bool ordered; /* asked for: clauses only in the order of the usage, although they may come in any */
    bool inside; /* the statement ends within a hole; then n is 0 */
} qdot_next;

/* Read the statement at the cursor as far as it goes, which need not be whole. The record has the parts that were read; of
 * one that does not fit, and of those behind it, nothing. Names need not be declared: they may be in the text itself.
 * word: the statement's word is the first token; otherwise it is not among the tokens. u has no word: an expression, row is
 * NULL then. *next: for the end of the tokens, NULL: not asked for. QDOT_ENOMEM; free the record in any case. */
QDOT_MUST_CHECK qdot_status qdot_match_begun(const qdot_cursor *c, const qdot_statement *row, const qdot_usage *u, bool word,
                                             qdot_next *next, qdot_record *record);

/* Carry out what was read; statements of numbers see the phase space of a scene that states H alone (lang/session/phase). */
QDOT_MUST_CHECK qdot_status qdot_match_handle(const qdot_statement *row, qdot_record *record);
/* Read the operands and carry the statement out; the cursor ends after them, or its error_at at the failure. */
QDOT_MUST_CHECK qdot_status qdot_match_carry_out(qdot_cursor *c, const qdot_statement *row);

#endif
