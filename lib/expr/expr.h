/* expr.h -- expressions: interned nodes in a pool, and their canonical constructors.
 *
 * A qdot_expr is a 32-bit id in a pool; 0 is nil. Nodes are interned: two expressions that are
 * built alike have the same id, so equality of form is an integer compare. The pool owns every
 * node; nothing is freed before the pool is. Children have smaller ids than their parents, so id
 * order is topological and a pass over an expression is a loop (expr/walk.h).
 *
 * Failure. Constructors never fail in the middle: nil absorbs, the pool keeps the first cause,
 * and the caller asks once with qdot_pool_check().
 *
 * Everything is real. Canonical form: sums are maps term -> rational coefficient, products maps
 * base -> exponent with one rational coefficient, so like terms meet at construction. A number
 * times a sum stays a product (2*(x + y)) until it is added to something.
 *
 * Tests  tests/expr/
 */
#ifndef QDOT_EXPR_EXPR_H
#define QDOT_EXPR_EXPR_H

#include <stdbool.h>
#include <stdint.h>

#include <flint/fmpq.h>

#include "base/status.h"

typedef uint32_t qdot_expr;
typedef struct qdot_pool qdot_pool;

#define QDOT_NIL 0u

typedef enum {
    QDOT_NUM = 1, /* an exact rational; qdot_expr_rational() */
    QDOT_SYM,     /* a symbol; qdot_expr_symbol() */
    QDOT_SUM,     /* args: c0, t1, c1, t2, c2, ...: c0 + c1 t1 + ...; every c a NUM, no t a NUM
                     or SUM or a PROD with a coefficient other than 1 */
    QDOT_PROD,    /* args: c, b1, e1, b2, e2, ...: c b1^e1 b2^e2 ...; a power is {1, b, e} */
    QDOT_FUN,     /* op: a qdot_fun_id; args: its arguments */
    QDOT_UFUN,    /* op: an undefined function; args: a1 ... an, then n orders (NUMs) of partial
                     derivatives: D1^o1 ... Dn^on x (a1, ..., an) */
    QDOT_REL,     /* op: a qdot_rel_op; args: left, right */
    QDOT_LOGIC,   /* op: a qdot_logic_op; args: operands */
    QDOT_VEC,     /* args: components, 2 or more */
    QDOT_MAT,     /* op: columns; args: entries, row by row */
    QDOT_LIST     /* args: members, 0 or more */
} qdot_kind;

typedef enum {
#define X(ID, ...) QDOT_##ID,
#include "expr/function.def"
#undef X
    QDOT_FUNCTION_COUNT,
    QDOT_HOLD = QDOT_FUNCTION_COUNT, /* qdot_hold; no row and no name in the language */
    QDOT_FUNCTION_KINDS
} qdot_fun_id;

typedef enum { QDOT_EQ, QDOT_LT, QDOT_LE } qdot_rel_op; /* a > b is kept as b < a */
typedef enum { QDOT_AND, QDOT_OR, QDOT_NOT } qdot_logic_op;

/* Classes of symbols; the order is the order in which factors are printed. */
typedef enum {
    QDOT_CONST,        /* pi, true, false */
    QDOT_PARAM,        /* a parameter */
    QDOT_FORMAL,       /* a formal argument, an index, an unknown */
    QDOT_TIME,         /* t */
    QDOT_COORD,        /* a coordinate or, with order > 0, its time derivative q', q'' ... */
    QDOT_MOMENTUM,     /* p[q], the independent variable of a Hamiltonian or Routhian */
    QDOT_MULTIPLIER,   /* lambda[rod], lambda[pin, 1] */
    QDOT_DIFFERENTIAL, /* dq, dt */
    QDOT_DELTA,        /* delta[q], a virtual displacement */
    QDOT_WORDS         /* a text, what latex(e) gives: its name as it stands; no number */
} qdot_class;

/* What is known of a sign; a set. Zero is QDOT_GE0 | QDOT_LE0. */
enum { QDOT_GE0 = 1, QDOT_LE0 = 2, QDOT_NE0 = 4 };
#define QDOT_POS (QDOT_GE0 | QDOT_NE0)
#define QDOT_NEG (QDOT_LE0 | QDOT_NE0)

/* What an expression contains; a set, in qdot_node.holds. */
enum {
    QDOT_HAS_PARAM = 1 << QDOT_PARAM,
    QDOT_HAS_FORMAL = 1 << QDOT_FORMAL,
    QDOT_HAS_TIME = 1 << QDOT_TIME,
    QDOT_HAS_COORD = 1 << QDOT_COORD, /* a coordinate itself, order 0 */
    QDOT_HAS_MOMENTUM = 1 << QDOT_MOMENTUM,
    QDOT_HAS_MULTIPLIER = 1 << QDOT_MULTIPLIER,
    QDOT_HAS_DIFFERENTIAL = 1 << QDOT_DIFFERENTIAL,
    QDOT_HAS_DELTA = 1 << QDOT_DELTA,
    QDOT_HAS_WORDS = 1 << QDOT_WORDS,
    QDOT_HAS_VELOCITY = 1 << 10,     /* order 1 */
    QDOT_HAS_ACCELERATION = 1 << 11, /* order 2 or more */
    QDOT_HAS_UFUN = 1 << 12,
    QDOT_HAS_FUN = 1 << 13
};

typedef struct {
    uint8_t kind; /* qdot_kind */
    uint8_t sign; /* QDOT_GE0 ... */
    uint16_t op;  /* by kind, see above */
    uint32_t n;   /* number of args */
    uint32_t at;  /* index of the first arg; for NUM and SYM the index in its table */
    uint32_t holds;
    uint32_t hash;
    uint32_t touches; /* a hash set of its symbols: a symbol whose bit is not set does not occur
                          */
    uint32_t height;  /* of the tree: 0 for a NUM or SYM */
    uint32_t size;    /* operations as a tree, at most 2^32 - 1: ask qdot_expr_size() */
} qdot_node;

/* --- the pool ------------------------------------------------------------------------- */

qdot_pool *qdot_pool_new(void); /* NULL: no memory */
void qdot_pool_free(qdot_pool *pool);
size_t qdot_pool_count(const qdot_pool *pool); /* nodes so far */
size_t qdot_pool_bytes(const qdot_pool *pool); /* their memory, without large numbers */

/* The first failure since the last check, QDOT_OK if none. It becomes the thread's last error
 * again, and the pool drops it and is usable as before. */
QDOT_MUST_CHECK qdot_status qdot_pool_check(qdot_pool *pool);

/* Record a failure in the pool (the thread's last error); returns nil. */
qdot_expr qdot_pool_fail(qdot_pool *pool);

/* Whether a failure is pending: for loops that want to stop early. */
bool qdot_pool_failed(const qdot_pool *pool);

/* Allow at most `work` further constructor calls (a node of n args counts 1 + n/16), then
 * QDOT_ELIMIT; UINT64_MAX: no limit. Returns the rest of the previous limit, for restoring it. */
uint64_t qdot_pool_budget(qdot_pool *pool, uint64_t work);

/* Record that a simplification stopped at its work budget: the form is right, but a shorter one
 * may exist. _taken: whether that happened since its last call. */
void qdot_pool_unfinished(qdot_pool *pool);
bool qdot_pool_unfinished_taken(qdot_pool *pool);

/* --- reading -------------------------------------------------------------------------- */

const qdot_node *qdot_expr_node(const qdot_pool *pool, qdot_expr e);
/* The bits QDOT_GE0, QDOT_LE0, QDOT_NE0 that its node knows of e; nil: 0. */
uint8_t qdot_expr_sign(const qdot_pool *pool, qdot_expr e);
/* The args [n]; valid until the next constructor call. */
const qdot_expr *qdot_expr_args(const qdot_pool *pool, qdot_expr e);
qdot_kind qdot_expr_kind(const qdot_pool *pool, qdot_expr e);
qdot_expr qdot_expr_arg(const qdot_pool *pool, qdot_expr e, uint32_t i);
uint32_t qdot_expr_count(const qdot_pool *pool, qdot_expr e);

bool qdot_expr_is_scalar(const qdot_pool *pool, qdot_expr e); /* NUM ... UFUN, no words */
/* The rational of a NUM; NULL for any other kind. Valid until the next constructor call. */
const fmpq *qdot_expr_rational(const qdot_pool *pool, qdot_expr e);
/* Whether e is an integer that fits; *value it. */
bool qdot_expr_to_int(const qdot_pool *pool, qdot_expr e, long *value);

/* Total, structural order, the same on every machine: <0, 0, >0. The order of factors. */
int qdot_expr_compare(const qdot_pool *pool, qdot_expr a, qdot_expr b);

/* Whether a minus sign would be printed in front. */
bool qdot_expr_is_negative(const qdot_pool *pool, qdot_expr e);

/* --- numbers -------------------------------------------------------------------------- */

/* Always the same ids. */
#define QDOT_ZERO 1u
#define QDOT_ONE 2u
#define QDOT_MINUS_ONE 3u
#define QDOT_HALF 4u
#define QDOT_PI 5u
#define QDOT_TRUE 6u
#define QDOT_FALSE 7u
#define QDOT_T 8u /* the time */

qdot_expr qdot_expr_int(qdot_pool *pool, long n);
qdot_expr qdot_expr_ratio(qdot_pool *pool, long n, long d);
qdot_expr qdot_expr_fmpq(qdot_pool *pool, const fmpq_t x);
/* "9.81" is 981/100, "1e-3" is 1/1000; more than 10^6 digits: QDOT_ELIMIT. */
qdot_expr qdot_expr_decimal(qdot_pool *pool, const char *text, size_t length);
/* The rational that a finite double is. */
qdot_expr qdot_expr_of_double(qdot_pool *pool, double x);

/* --- symbols -------------------------------------------------------------------------- */

typedef struct {
    qdot_class class;
    const char *name;  /* plain: "theta[1]", "theta[1]'", "dr", "lambda[rod]", "delta[r]" */
    qdot_expr base;    /* of a jet, momentum, differential, delta: the coordinate (or t) */
    uint32_t order;    /* of a jet: 0 q, 1 q', 2 q'' */
    uint32_t rank;     /* order of declaration; a jet has its coordinate's */
    qdot_expr lo, hi;  /* declared domain, nil where there is none */
    bool lo_open, hi_open;
    bool hidden;       /* not to be found by its name */
    uint8_t sign;
} qdot_symbol;

/* The symbol of a class by its name, made if new. class: CONST, PARAM, FORMAL, COORD,
 * MULTIPLIER, WORDS. */
qdot_expr qdot_symbol_get(qdot_pool *pool, qdot_class class, const char *name);
/* Hide x from its name: qdot_symbol_get will make a new symbol, about which nothing is known.
 * Expressions with x stay as they are; one expression must not contain both symbols. */
void qdot_symbol_hide(qdot_pool *pool, qdot_expr x);
/* Give x its name back; another symbol of that name is hidden. */
void qdot_symbol_show(qdot_pool *pool, qdot_expr x);
/* Whether a parameter, coordinate, formal argument or multiplier has that name. */
bool qdot_symbol_is_known(const qdot_pool *pool, const char *name);
/* The same without formal arguments. */
bool qdot_symbol_is_declared(const qdot_pool *pool, const char *name);
/* The order-th time derivative of a coordinate (order 0: itself) or of a time derivative. */
qdot_expr qdot_symbol_jet(qdot_pool *pool, qdot_expr coordinate, uint32_t order);
/* dq or dt, p[q], delta[q]. class: DIFFERENTIAL, MOMENTUM, DELTA. */
qdot_expr qdot_symbol_of(qdot_pool *pool, qdot_class class, qdot_expr coordinate);
/* Declare lo < x < hi (nil: no bound; open: strict). Before x is used. */
void qdot_symbol_domain(qdot_pool *pool, qdot_expr x, qdot_expr lo, bool lo_open,
                        qdot_expr hi, bool hi_open);
/* NULL unless e is a SYM. Valid until the next constructor call. */
const qdot_symbol *qdot_expr_symbol(const qdot_pool *pool, qdot_expr e);
bool qdot_expr_is_class(const qdot_pool *pool, qdot_expr e, qdot_class class);
/* Whether e is the coordinate itself (order 0). */
bool qdot_expr_is_coordinate(const qdot_pool *pool, qdot_expr e);

/* --- undefined functions -------------------------------------------------------------- */

typedef struct {
    const char *name;
    uint32_t arity;
    qdot_expr formals; /* a LIST of the declared arguments, symbols */
} qdot_ufun;

/* Declare x(formals); the same name twice with the same formals is the same function. */
QDOT_MUST_CHECK qdot_status qdot_ufun_declare(qdot_pool *pool, const char *name,
                                              uint32_t arity, const qdot_expr *formals,
                                              uint32_t *id);
/* Declare the function `id` with other arguments, as many: an argument that was a symbol of its
 * own now means a coordinate. Expressions built before keep their arguments. */
QDOT_MUST_CHECK qdot_status qdot_ufun_redeclare(qdot_pool *pool, uint32_t id,
                                                qdot_expr formals);
const qdot_ufun *qdot_ufun_get(const qdot_pool *pool, uint32_t id);
/* x(args), derivatives of the given orders (NULL: none). */
qdot_expr qdot_ufun_apply(qdot_pool *pool, uint32_t id, const qdot_expr *args,
                          const uint32_t *orders);

/* --- constructors: scalars ------------------------------------------------------------ */

qdot_expr qdot_add(qdot_pool *pool, qdot_expr a, qdot_expr b);
qdot_expr qdot_sub(qdot_pool *pool, qdot_expr a, qdot_expr b);
qdot_expr qdot_neg(qdot_pool *pool, qdot_expr a);
qdot_expr qdot_mul(qdot_pool *pool, qdot_expr a, qdot_expr b);
qdot_expr qdot_div(qdot_pool *pool, qdot_expr a, qdot_expr b); /* b = 0: QDOT_EDOMAIN */
qdot_expr qdot_pow(qdot_pool *pool, qdot_expr a, qdot_expr b); /* 0^-1, (-1)^(1/2): EDOMAIN */
qdot_expr qdot_pow_int(qdot_pool *pool, qdot_expr a, long n);
qdot_expr qdot_sqrt(qdot_pool *pool, qdot_expr a);
qdot_expr qdot_sum(qdot_pool *pool, size_t n, const qdot_expr *terms);     /* n = 0: 0 */
qdot_expr qdot_product(qdot_pool *pool, size_t n, const qdot_expr *factors); /* n = 0: 1 */

/* An elementary function with its special values, parity and inverse pairs applied. Number of
 * arguments as in the table, else QDOT_ETYPE; outside the domain (log 0): QDOT_EDOMAIN. */
qdot_expr qdot_fun(qdot_pool *pool, qdot_fun_id id, uint32_t n, const qdot_expr *args);
qdot_expr qdot_fun1(qdot_pool *pool, qdot_fun_id id, qdot_expr x);
/* e as one value that surrounding sums and products do not merge: hold(a + b) + c stays a sum of
 * two terms, so that a + b is computed once, and exp(-hold(log(a))) an exponential. For a
 * number, a symbol or another function: e itself. Only in equations for numerical runs. */
qdot_expr qdot_hold(qdot_pool *pool, qdot_expr e);
/* By name: false if there is none. */
bool qdot_fun_find(const char *name, qdot_fun_id *id);
const char *qdot_fun_name(qdot_fun_id id);

/* --- constructors: the rest; no arithmetic on them here (expr/tensor.h) ----------------- */

/* Between scalars; numbers are decided at once (QDOT_TRUE, QDOT_FALSE), except EQ, which stays
 * an equation. */
qdot_expr qdot_rel(qdot_pool *pool, qdot_rel_op op, qdot_expr a, qdot_expr b);
qdot_expr qdot_logic(qdot_pool *pool, qdot_logic_op op, uint32_t n, const qdot_expr *args);
qdot_expr qdot_vector(qdot_pool *pool, uint32_t n, const qdot_expr *components);
qdot_expr qdot_matrix(qdot_pool *pool, uint32_t rows, uint32_t columns,
                      const qdot_expr *entries);
qdot_expr qdot_list(qdot_pool *pool, uint32_t n, const qdot_expr *members);
/* The same kind and op with other args, canonical again. */
qdot_expr qdot_rebuild(qdot_pool *pool, qdot_expr e, const qdot_expr *args);

#endif
