/* pool.h -- the fields of a pool, and functions for the files of expr/ only. */
#ifndef QDOT_EXPR_POOL_H
#define QDOT_EXPR_POOL_H

#include <flint/fmpq.h>

#include "base/memory.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/rational.h"
#include "expr/symbol.h"

typedef struct qdot_memo qdot_memo;

/* What the variable of a definite integral is called in print. */
typedef struct {
    qdot_expr integral;
    const char *name;
} qdot_variable;

/* What a square matrix was first made of (expr/factors). */
typedef struct {
    qdot_expr matrix, a, b;
} qdot_factors;

struct qdot_pool {
    qdot_vec(qdot_node) nodes;     /* nodes.at[0] is nil */
    qdot_vec(qdot_expr) args;
    qdot_vec(fmpq *) numbers; /* numbers in the arena, at fixed addresses; read only: FLINT must not free them */
    qdot_vec(qdot_symbol) symbols;
    qdot_vec(qdot_ufun) ufuns;
    qdot_vec(qdot_variable) variables; /* the names of the variables of integrals, ascending by node */
    qdot_vec(qdot_factors) factors;     /* what square matrices were made of, ascending by matrix */
    uint32_t *table; /* open hash table of node ids, mask + 1 slots */
    uint32_t mask;
    qdot_arena *arena; /* memory for names and limbs of large numbers */
    qdot_error error;  /* the first failure; status QDOT_OK: none */
    uint64_t budget;
    bool unfinished;
    struct qdot_printed *printed; /* cache of printed texts, which printing may change in a const pool */
    qdot_memo *memo;              /* stored answers (expr/memo); NULL: none yet */
    uint32_t domains;             /* how many times the domain of a symbol has changed */
    bool estimated;               /* a number of an integral was found whose error is an estimate */
    bool choices;                 /* some expression in the pool contains if(...) */
};

/* The node with these args, created if new; args may point into the pool. Nil on failure. */
qdot_expr qdot_pool_intern(qdot_pool *pool, qdot_kind kind, uint16_t op, uint32_t n,
                           const qdot_expr *args, uint8_t sign);
/* The symbol if it is there, else nil; *hash that of its node. What has a base is known by it, whatever its name. */
qdot_expr qdot_pool_find_symbol(const qdot_pool *pool, const qdot_symbol *wanted, uint32_t *hash);
/* The symbol, made if new. Nil on failure. */
qdot_expr qdot_pool_make_symbol(qdot_pool *pool, const qdot_symbol *wanted);
/* Record the failure `status` with its message, and return nil. */
qdot_expr qdot_pool_refuse(qdot_pool *pool, qdot_status status, const char *format, ...)
    QDOT_PRINTF(3, 4);

/* Order of terms in a sum: accelerations, velocities ... first, then in the usual order of textbooks. */
int qdot_expr_compare_terms(const qdot_pool *pool, qdot_expr a, qdot_expr b);

/* _strip: e without its numerical coefficient; _unscale, for any scalar: also that coefficient, c. */
qdot_expr qdot_expr_strip(qdot_pool *pool, qdot_expr e);
qdot_expr qdot_expr_unscale(qdot_pool *pool, qdot_expr e, fmpq_t c);

/* -1 times a SUM, with every coefficient negated, so that -(a - b) becomes b - a. */
qdot_expr qdot_sum_turned(qdot_pool *pool, qdot_expr sum);
/* Whether e, as a factor of a product, combines only with factors of the same base. */
bool qdot_expr_is_atom(const qdot_pool *pool, qdot_expr e);

/* A difference among the factors of e that can take a minus sign before them: -m*(a - b) is
 * written m*(b - a). Nil if there is none. */
qdot_expr qdot_expr_turnable(const qdot_pool *pool, qdot_expr e);

/* The sum c[0] terms[0] + c[1] terms[1] + ... of n terms; every c is a number. */
qdot_expr qdot_sum_scaled(qdot_pool *pool, size_t n, const qdot_expr *c, const qdot_expr *terms);
/* The PROD e with the factor b^x at args[i] replaced by x b^(x - 1) inner. */
qdot_expr qdot_product_derived(qdot_pool *pool, qdot_expr e, uint32_t i, qdot_expr inner);

/* Compute y = x^n if it has not too many digits; x must not be 0 for n < 0. False: refused. */
bool qdot_number_power(qdot_pool *pool, fmpq_t y, const fmpq_t x, const fmpz_t n);
/* b^e = c base^exponent, e not an integer: c takes everything rational, the remaining exponent is
 * in (0, 1), usually 1/q of an integer free of q-th powers; base 1: nothing remains. False:
 * refused. */
bool qdot_number_root(qdot_pool *pool, const fmpq_t b, const fmpq_t e, fmpq_t c,
                      qdot_expr *base, qdot_expr *exponent);

/* The sign of a product or sum, from its canonical args. */
uint8_t qdot_sign_of_product(const qdot_pool *pool, uint32_t n, const qdot_expr *args);
uint8_t qdot_sign_of_sum(const qdot_pool *pool, uint32_t n, const qdot_expr *args);
/* Sign of a sum from the exact bounds of its terms (bounds.c): 2 - cos u > 0, cosh v - cos u
 * >= 0, 1 - x > 0 for x declared below 1. 0: unknown. */
uint8_t qdot_sign_by_bounds(const qdot_pool *pool, uint32_t n, const qdot_expr *args);
uint8_t qdot_sign_of_function(const qdot_pool *pool, qdot_fun_id id, const qdot_expr *args);

/* The partial derivative of f(args) with respect to args[i]. */
qdot_expr qdot_fun_derivative(qdot_pool *pool, qdot_fun_id id, uint32_t n,
                              const qdot_expr *args, uint32_t i);

/* Note that a matrix is a b, or for nil b the transpose of a (expr/factors); returns the matrix. Nil on failure. */
qdot_expr qdot_factors_note(qdot_pool *pool, qdot_expr matrix, qdot_expr a, qdot_expr b);

/* The number of operations in node e, found from those of its children, at most QDOT_SIZE_LARGE. */
uint32_t qdot_size_kept(const qdot_pool *pool, qdot_expr e);

struct qdot_walk;
/* As qdot_walk_begin, but only into nodes with a bit of `holds` or of `touches`; the root is
 * always included. */
QDOT_MUST_CHECK qdot_status qdot_walk_begin_where(const qdot_pool *pool, qdot_expr e,
                                                  uint32_t holds, uint32_t touches,
                                                  struct qdot_walk *w);

/* As qdot_walk_map, but only nodes with these properties are visited; others stay unchanged. */
qdot_expr qdot_walk_map_where(qdot_pool *pool, qdot_expr e, uint32_t holds, uint32_t touches,
                              qdot_expr (*leaf)(qdot_pool *pool, qdot_expr node, void *user),
                              void *user);

/* Whether Ctrl-C was pressed; the pool has failed then. */
bool qdot_pool_interrupted(qdot_pool *pool);

/* Refuse a number with more digits than the language allows, and return true. */
bool qdot_number_too_large(qdot_pool *pool, const fmpq_t x);

#define QDOT_MAX_BITS 3321929 /* 10^6 decimal digits in bits */
#define QDOT_SIZE_LARGE UINT32_MAX
/* bit of node.touches: the expression contains a vector, an equation or the like */
#define QDOT_TOUCHES_VALUE (1u << 31)
#define NODE(pool, e) (&(pool)->nodes.at[e])
#define ARGS(pool, e) ((pool)->args.at + (pool)->nodes.at[e].at)
#define WHERE(pool, e, h, t) ((NODE(pool, e)->holds & (h)) | (NODE(pool, e)->touches & (t)))
#define RATIONAL(pool, e) ((const fmpq *)(pool)->numbers.at[(pool)->nodes.at[e].at])
/* Short names for qdot_expr_rational and qdot_pool_failed, as macros. */
#define NUMBER(pool, e)                                                                  \
    ((e) != QDOT_NIL && NODE(pool, e)->kind == QDOT_NUM ? RATIONAL(pool, e) : NULL)
#define FAILED(pool) ((pool)->error.status != QDOT_OK)

/* As qdot_expr_is_scalar, for use within expr/. */
static inline bool
qdot_pool_is_scalar(const qdot_pool *pool, qdot_expr e)
{
    return e != QDOT_NIL && NODE(pool, e)->kind <= QDOT_INTEGRAL && e != QDOT_TRUE &&
           e != QDOT_FALSE && !(NODE(pool, e)->holds & QDOT_HAS_WORDS);
}

#endif
