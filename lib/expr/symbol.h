/* symbol.h -- symbols, with what was declared of them, and undefined functions.
 *
 * Tests  tests/expr/test_pool.c
 */
#ifndef QDOT_EXPR_SYMBOL_H
#define QDOT_EXPR_SYMBOL_H

#include "expr/id.h"

/* Classes of symbols, in the order in which factors are printed; 10 to 13 are taken by bits of `holds`. */
typedef enum {
    QDOT_CONST,        /* pi, true, false */
    QDOT_PARAM,        /* a parameter */
    QDOT_FORMAL,       /* a formal argument, a loop index, an unknown of an equation */
    QDOT_TIME,         /* the symbol t */
    QDOT_COORD,        /* a coordinate or, with order > 0, its time derivative q', q'' ... */
    QDOT_MOMENTUM,     /* p[q], the independent variable of a Hamiltonian or Routhian */
    QDOT_MULTIPLIER,   /* Lagrange multiplier of a constraint: lambda[rod], lambda[pin, 1] */
    QDOT_DIFFERENTIAL, /* dq, dt: a differential in a constraint or one-form */
    QDOT_DELTA,        /* delta[q], a virtual displacement */
    QDOT_WORDS, /* a text, as latex(e) gives it; printed as it stands, has no value as a number */
    QDOT_BOUND = 14, /* the variable of an integral within its integrand (integral.h) */
    QDOT_INFINITE    /* infinity */
} qdot_class;

/* The kinds of symbols in an expression, as a set of bits in qdot_node.holds (node.h). */
enum {
    QDOT_HAS_PARAM = 1 << QDOT_PARAM,
    QDOT_HAS_FORMAL = 1 << QDOT_FORMAL,
    QDOT_HAS_TIME = 1 << QDOT_TIME,
    QDOT_HAS_COORD = 1 << QDOT_COORD, /* a coordinate itself, not its derivatives */
    QDOT_HAS_MOMENTUM = 1 << QDOT_MOMENTUM,
    QDOT_HAS_MULTIPLIER = 1 << QDOT_MULTIPLIER,
    QDOT_HAS_DIFFERENTIAL = 1 << QDOT_DIFFERENTIAL,
    QDOT_HAS_DELTA = 1 << QDOT_DELTA,
    QDOT_HAS_WORDS = 1 << QDOT_WORDS,
    QDOT_HAS_VELOCITY = 1 << 10,     /* a first time derivative q' of a coordinate */
    QDOT_HAS_ACCELERATION = 1 << 11, /* a time derivative q'', q''' ... of a coordinate */
    QDOT_HAS_UFUN = 1 << 12,
    QDOT_HAS_FUN = 1 << 13,          /* an elementary function or an integral */
    QDOT_HAS_BOUND = 1 << QDOT_BOUND,       /* the variable of an integral, outside of that integral */
    QDOT_HAS_INFINITY = 1 << QDOT_INFINITE  /* infinity, not as the end of an integral */
};

typedef struct {
    qdot_class class;
    const char *name;  /* plain: "theta[1]", "theta[1]'", "dr", "lambda[rod]", "delta[r]" */
    qdot_expr base; /* for a time derivative, momentum, differential or delta: its coordinate (or t), or a LIST of them */
    uint32_t order;    /* order of the time derivative: 0 for q and p[q], 1 for q' and p[q]', 2 for q'' */
    uint32_t rank;     /* order of declaration; a time derivative has its coordinate's */
    qdot_expr lo, hi;  /* bounds of the declared domain; nil: unbounded */
    bool lo_open, hi_open;
    bool hidden;       /* the symbol cannot be found by its name */
    uint8_t sign;
} qdot_symbol;

/* The symbol of a class by its name, made if new. class: CONST, PARAM, FORMAL, COORD,
 * MULTIPLIER, WORDS. */
qdot_expr qdot_symbol_get(qdot_pool *pool, qdot_class class, const char *name);
/* Hide x from its name: qdot_symbol_get will make a new symbol, about which nothing is known.
 * Expressions with x stay as they are; one expression must not contain both symbols. */
void qdot_symbol_hide(qdot_pool *pool, qdot_expr x);
/* Make x known under its name again; another symbol of that name is hidden. */
void qdot_symbol_show(qdot_pool *pool, qdot_expr x);
/* Whether a parameter, coordinate, formal argument or multiplier has that name. */
bool qdot_symbol_is_known(const qdot_pool *pool, const char *name);
/* As qdot_symbol_is_known, without formal arguments. */
bool qdot_symbol_is_declared(const qdot_pool *pool, const char *name);
/* The order-th time derivative of a coordinate or momentum (order 0: itself) or of a time derivative. */
qdot_expr qdot_symbol_jet(qdot_pool *pool, qdot_expr coordinate, uint32_t order);
/* The symbol dq or dt, p[q], or delta[q] for `class` DIFFERENTIAL, MOMENTUM or DELTA. A momentum may belong to a velocity too,
 * p[q'], that of Ostrogradsky. The differential of a LIST of coordinates is their product wedge(dr, dphi), a
 * symbol of its own (mech/geometry/forms.h); the list is its base. */
qdot_expr qdot_symbol_of(qdot_pool *pool, qdot_class class, qdot_expr coordinate);
/* Declare the domain lo < x < hi of x, before x is used (nil: no bound; open: strict, else with the bound itself). */
void qdot_symbol_domain(qdot_pool *pool, qdot_expr x, qdot_expr lo, bool lo_open,
                        qdot_expr hi, bool hi_open);
/* The symbol data of e; NULL unless e is a SYM. Valid until the next constructor call. */
const qdot_symbol *qdot_expr_symbol(const qdot_pool *pool, qdot_expr e);
bool qdot_expr_is_class(const qdot_pool *pool, qdot_expr e, qdot_class class);
/* Whether e contains no symbol except pi, true and false, and no undefined function. */
bool qdot_expr_is_constant(const qdot_pool *pool, qdot_expr e);
/* Whether e is the coordinate itself (order 0). */
bool qdot_expr_is_coordinate(const qdot_pool *pool, qdot_expr e);

/* --- undefined functions: declaring and applying -------------------------------------- */

typedef struct {
    const char *name;
    uint32_t arity;
    qdot_expr formals; /* a LIST of the declared arguments, symbols */
} qdot_ufun;

/* Declare x(formals); the same name with the same formals again is the same function. */
QDOT_MUST_CHECK qdot_status qdot_ufun_declare(qdot_pool *pool, const char *name,
                                              uint32_t arity, const qdot_expr *formals,
                                              uint32_t *id);
/* Declare the function `id` with other arguments, as many: an argument that was a symbol of its
 * own now means a coordinate. Expressions built before keep their arguments. */
QDOT_MUST_CHECK qdot_status qdot_ufun_redeclare(qdot_pool *pool, uint32_t id,
                                                qdot_expr formals);
const qdot_ufun *qdot_ufun_get(const qdot_pool *pool, uint32_t id);
/* Apply the undefined function x to `args`, with derivatives of the given orders (NULL: none). */
qdot_expr qdot_ufun_apply(qdot_pool *pool, uint32_t id, const qdot_expr *args,
                          const uint32_t *orders);

/* What a coordinate was at another time, x(u) or for order 1 x'(u): an undefined function called as the coordinate, which
 * is its declared argument. qdot_ufun_delayed: the coordinate of such a function; nil of others. */
qdot_expr qdot_delayed(qdot_pool *pool, qdot_expr coordinate, qdot_expr u, uint32_t order);
qdot_expr qdot_ufun_delayed(const qdot_pool *pool, uint32_t id);
/* Whether e holds such a function. */
bool qdot_has_delayed(qdot_pool *pool, qdot_expr e);

#endif
