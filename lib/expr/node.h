/* node.h -- what a node of an expression is, and reading it.
 *
 * Tests  tests/expr/test_pool.c, tests/expr/test_order.c
 */
#ifndef QDOT_EXPR_NODE_H
#define QDOT_EXPR_NODE_H

#include "expr/id.h"

/* A set of bits that tell what is known of a sign. Zero is QDOT_GE0 | QDOT_LE0. */
enum { QDOT_GE0 = 1, QDOT_LE0 = 2, QDOT_NE0 = 4 };
#define QDOT_POS (QDOT_GE0 | QDOT_NE0)
#define QDOT_NEG (QDOT_LE0 | QDOT_NE0)

typedef struct {
    uint8_t kind; /* qdot_kind */
    uint8_t sign; /* what is known of the sign of the value: bits QDOT_GE0 ... */
    uint16_t op;  /* meaning depends on the kind, see qdot_kind (id.h) */
    uint32_t n;   /* number of args */
    uint32_t at; /* index of its first argument in pool->args; for NUM and SYM its index in their table */
    uint32_t holds; /* the kinds of symbols in it: bits QDOT_HAS_PARAM ... (symbol.h) */
    uint32_t hash;
    uint32_t touches; /* a hash set of its symbols: a symbol whose bit is not set does not occur
                          */
    uint32_t height;  /* height of the expression tree: 0 for a NUM or SYM */
    uint32_t size; /* operations of the expression as a tree, at most 2^32 - 1: ask qdot_expr_size() */
} qdot_node;

const qdot_node *qdot_expr_node(const qdot_pool *pool, qdot_expr e);
/* What is stored in the node of e about its sign, as bits QDOT_GE0, QDOT_LE0, QDOT_NE0; nil: 0. */
uint8_t qdot_expr_sign(const qdot_pool *pool, qdot_expr e);
/* The args of a node; valid until the next constructor call. */
const qdot_expr *qdot_expr_args(const qdot_pool *pool, qdot_expr e);
qdot_kind qdot_expr_kind(const qdot_pool *pool, qdot_expr e);
qdot_expr qdot_expr_arg(const qdot_pool *pool, qdot_expr e, uint32_t i);
uint32_t qdot_expr_count(const qdot_pool *pool, qdot_expr e);

bool qdot_expr_is_scalar(const qdot_pool *pool, qdot_expr e); /* true for NUM ... UFUN, but not for a text */
/* The canonical order of factors: total, structural, the same on every machine; returns <0, 0, >0. */
int qdot_expr_compare(const qdot_pool *pool, qdot_expr a, qdot_expr b);

/* Whether a minus sign would be printed in front. */
bool qdot_expr_is_negative(const qdot_pool *pool, qdot_expr e);

#endif
