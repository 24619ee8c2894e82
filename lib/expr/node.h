/* node.h -- what a node of an expression is, and reading it.
 *
 * Tests  tests/expr/test_pool.c, tests/expr/test_order.c
 */
#ifndef QDOT_EXPR_NODE_H
#define QDOT_EXPR_NODE_H

#include "expr/id.h"

/* Bits for what is known of the sign of an expression: >= 0, <= 0, != 0. Zero has the first two. */
enum { QDOT_GE0 = 1, QDOT_LE0 = 2, QDOT_NE0 = 4 };
#define QDOT_POS (QDOT_GE0 | QDOT_NE0)
#define QDOT_NEG (QDOT_LE0 | QDOT_NE0)

typedef struct {
    uint8_t kind; /* kind of the expression, a qdot_kind */
    uint8_t sign; /* what is known of the sign of the value: bits QDOT_GE0 ... */
    uint16_t op;  /* meaning depends on the kind, see qdot_kind (id.h) */
    uint32_t n;   /* number of args */
    uint32_t at; /* index of its first argument in pool->args; for NUM and SYM its index in their table */
    uint32_t holds; /* the kinds of symbols in it: bits QDOT_HAS_PARAM ... (symbol.h) */
    uint32_t hash;
    uint32_t touches; /* a hash set of its symbols: a symbol whose bit is not set does not occur
                          */
    uint32_t height;  /* height of the expression tree: 0 for a NUM or SYM */
    uint32_t size; /* number of operations written as a tree, up to 2^32 - 1; qdot_expr_size() gives more */
} qdot_node;

const qdot_node *qdot_expr_node(const qdot_pool *pool, qdot_expr e);
/* What the node of e stores about the sign of e, as bits QDOT_GE0, QDOT_LE0, QDOT_NE0; 0 for nil. */
uint8_t qdot_expr_sign(const qdot_pool *pool, qdot_expr e);
/* The args of a node; valid until the next constructor call. */
const qdot_expr *qdot_expr_args(const qdot_pool *pool, qdot_expr e);
qdot_kind qdot_expr_kind(const qdot_pool *pool, qdot_expr e);
qdot_expr qdot_expr_arg(const qdot_pool *pool, qdot_expr e, uint32_t i);
uint32_t qdot_expr_count(const qdot_pool *pool, qdot_expr e);

bool qdot_expr_is_scalar(const qdot_pool *pool, qdot_expr e); /* true for NUM ... INTEGRAL, but not for a text */
/* Compare factors in the canonical order, which is total and the same on every machine; returns <0, 0, >0. */
int qdot_expr_compare(const qdot_pool *pool, qdot_expr a, qdot_expr b);

/* Whether the expression would be printed with a minus sign in front. */
bool qdot_expr_is_negative(const qdot_pool *pool, qdot_expr e);

#endif
