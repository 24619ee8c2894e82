/* pool.h -- the pool from inside: what the files of expr/ share and nobody else sees. */
#ifndef QDOT_EXPR_POOL_H
#define QDOT_EXPR_POOL_H

#include "base/memory.h"
#include "expr/expr.h"

struct qdot_pool {
    qdot_vec(qdot_node) nodes;     /* [0] is nil */
    qdot_vec(qdot_expr) args;
    qdot_vec(fmpq) numbers;
    qdot_vec(qdot_symbol) symbols;
    qdot_vec(qdot_ufun) ufuns;
    uint32_t *table; /* open hash table of ids */
    uint32_t mask;
    qdot_arena *arena; /* names */
    qdot_error error;  /* status QDOT_OK: none */
    uint64_t budget;
};

/* The node with these args, made if new; args may lie in the pool. Nil on failure. */
qdot_expr qdot_pool_intern(qdot_pool *pool, qdot_kind kind, uint16_t op, uint32_t n,
                           const qdot_expr *args, uint8_t sign);
/* Record `status` with its message and return nil. */
qdot_expr qdot_pool_refuse(qdot_pool *pool, qdot_status status, const char *format, ...)
    QDOT_PRINTF(3, 4);

/* Order of terms in a sum: accelerations, velocities ... first, then as a book sorts. */
int qdot_expr_compare_terms(const qdot_pool *pool, qdot_expr a, qdot_expr b);

/* c * term as one node, c a rational; and the other way: *c and the rest, of any scalar. */
qdot_expr qdot_expr_scale(qdot_pool *pool, const fmpq_t c, qdot_expr term);
qdot_expr qdot_expr_unscale(qdot_pool *pool, qdot_expr e, fmpq_t c);

/* Sign of a product or sum from its canonical args. */
uint8_t qdot_sign_of_product(const qdot_pool *pool, uint32_t n, const qdot_expr *args);
uint8_t qdot_sign_of_sum(const qdot_pool *pool, uint32_t n, const qdot_expr *args);
uint8_t qdot_sign_of_function(const qdot_pool *pool, qdot_fun_id id, const qdot_expr *args);

/* d f(args) / d args[i]. */
qdot_expr qdot_fun_derivative(qdot_pool *pool, qdot_fun_id id, uint32_t n,
                              const qdot_expr *args, uint32_t i);

/* Numbers of more digits than the language allows: refuses and returns true. */
bool qdot_number_too_large(qdot_pool *pool, const fmpq_t x);

#define QDOT_MAX_BITS 3321929 /* 10^6 decimal digits */
#define NODE(pool, e) (&(pool)->nodes.at[e])
#define ARGS(pool, e) ((pool)->args.at + (pool)->nodes.at[e].at)
#define RATIONAL(pool, e) (&(pool)->numbers.at[(pool)->nodes.at[e].at])

#endif
