/* memo.h -- answers to questions that were asked before.
 *
 * A question is an expression, a LIST of all that the answer depends on, and a number that says what is asked of it. The
 * declared domains are part of every question: all answers are forgotten when one changes. While the work of the pool is
 * limited (qdot_pool_budget) nothing is found or kept, because an answer then depends on what is left. There is a slot for
 * each hash, which keeps the newest answer; so a memo only saves time.
 *
 * Tests  tests/expr/test_memo.c
 */
#ifndef QDOT_EXPR_MEMO_H
#define QDOT_EXPR_MEMO_H

#include <stddef.h>

#include "expr/id.h"

/* The size in bytes of the largest answer that the table of answers can hold. */
#define QDOT_MEMO_BYTES 48

/* The kinds of questions with stored answers; the lower 8 bits hold further data on which an answer depends. */
enum { QDOT_MEMO_LESS = 1 << 8, QDOT_MEMO_SHORTEST = 2 << 8, QDOT_MEMO_ROTATION = 3 << 8 };

/* Copy the stored answer to a question, of `size` bytes, to *answer; false if none is stored. */
bool qdot_memo_find(const qdot_pool *pool, qdot_expr question, uint32_t asked, void *answer, size_t size);

/* Store an answer of `size` bytes, if there is memory. */
void qdot_memo_keep(qdot_pool *pool, qdot_expr question, uint32_t asked, const void *answer, size_t size);

#endif
