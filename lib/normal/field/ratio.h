/* ratio.h -- quotients of polynomials in the generators of a field (field.h), and arithmetic with
 * them within its budget.
 */
#ifndef QDOT_NORMAL_RATIO_H
#define QDOT_NORMAL_RATIO_H

#include <flint/fmpz_mpoly.h>
#include <flint/fmpz_vec.h>

#include "expr/id.h"
#include "normal/field/lattice.h"
#include "normal/field/map.h"

typedef enum {
    QDOT_GEN_PLAIN, /* a symbol, or a function for which there are no rules */
    QDOT_GEN_ROOT,
    QDOT_GEN_ABS,
    QDOT_GEN_SIN,
    QDOT_GEN_COS,
    QDOT_GEN_SINH,
    QDOT_GEN_COSH,
    QDOT_GEN_EXP
} qdot_gen_kind;

typedef struct {
    qdot_gen_kind kind;
    bool fast; /* is a velocity, acceleration, multiplier, momentum, differential or delta */
    qdot_expr expr; /* the expression that the generator represents */
    qdot_expr of;   /* ROOT, ABS: the argument b; sines, cosines, EXP: the base angle */
    uint32_t order; /* for ROOT: the degree q of the root */
    uint32_t pair;  /* SIN <-> COS, SINH <-> COSH: variable of the other function of this angle */
} qdot_gen;

/* A quotient n/d of polynomials; d is not zero. */
typedef struct {
    fmpz_mpoly_t n, d;
} qdot_ratio;

typedef struct {
    slong var;
    slong power;
    fmpz_mpoly_t poly; /* the relation var^power - ... = 0 */
} qdot_rule;

typedef enum {
    QDOT_FIELD_GOES,
    QDOT_FIELD_OVER,      /* the budget is used up */
    QDOT_FIELD_UNDEFINED, /* a denominator is zero everywhere */
    QDOT_FIELD_FAILED     /* out of memory, interrupted, or the pool failed: see `status` */
} qdot_field_state;

typedef struct {
    qdot_pool *pool;
    fmpz_mpoly_ctx_t ctx;
    bool has_ctx;
    slong n;       /* number of generators */
    qdot_gen *gen; /* [n] the generators, one for each variable of the polynomials */
    qdot_rule *rule;
    size_t n_rules;
    qdot_lattice circular, hyperbolic, exponential;
    qdot_map vars;  /* maps an expression to the variable of its generator */
    qdot_map nodes; /* maps a node to its index in `value` */
    qdot_expr *node;
    qdot_ratio *value;
    size_t n_nodes;
    int64_t work;
    bool patient; /* a person asked for factors: those of long polynomials are found, and long fractions cancelled, too */
    qdot_field_state state;
    qdot_status status;
} qdot_field;

bool qdot_field_goes(const qdot_field *f);

/* The variable of the field that stands for this generator; -1 if there is none. */
slong qdot_field_var(const qdot_field *f, qdot_expr e);

/* The rewriting rule for a power of the variable v; NULL if there is none. */
qdot_rule *qdot_field_rule(const qdot_field *f, slong v);

/* Split p = c primitive with an integer c, p not 0; positive: the leading coefficient of `primitive` is > 0. */
void qdot_field_primitive(qdot_field *f, fmpz_t c, fmpz_mpoly_t primitive, const fmpz_mpoly_t p,
                          bool positive);

/* Charge the cost of multiplying a terms by b terms to the budget; false if that is exhausted. */
bool qdot_field_charge(qdot_field *f, int64_t a, int64_t b);

/* Reduce p modulo the rules of the field. */
void qdot_field_reduce(qdot_field *f, fmpz_mpoly_t p);
/* Set a = b c, reduced by the rules. */
void qdot_field_mul(qdot_field *f, fmpz_mpoly_t a, const fmpz_mpoly_t b,
                    const fmpz_mpoly_t c);
/* Set g = gcd(a, b), or 1 if that would cost too much. */
void qdot_field_gcd(qdot_field *f, fmpz_mpoly_t g, const fmpz_mpoly_t a,
                    const fmpz_mpoly_t b);

void qdot_ratio_init(qdot_field *f, qdot_ratio *r); /* set *r to 0/1 */
void qdot_ratio_clear(qdot_field *f, qdot_ratio *r);
void qdot_ratio_set(qdot_field *f, qdot_ratio *r, const qdot_ratio *a);
void qdot_ratio_add(qdot_field *f, qdot_ratio *r, const qdot_ratio *a,
                    const qdot_ratio *b);
void qdot_ratio_sub(qdot_field *f, qdot_ratio *r, const qdot_ratio *a,
                    const qdot_ratio *b);
void qdot_ratio_mul(qdot_field *f, qdot_ratio *r, const qdot_ratio *a,
                    const qdot_ratio *b);
/* Set r to a/b; if b is zero the field gets the status QDOT_FIELD_UNDEFINED. */
void qdot_ratio_div(qdot_field *f, qdot_ratio *r, const qdot_ratio *a,
                    const qdot_ratio *b);
void qdot_ratio_pow(qdot_field *f, qdot_ratio *r, const qdot_ratio *a, int64_t n);
void qdot_ratio_scale(qdot_field *f, qdot_ratio *r, const fmpq_t c);
/* Cancel common factors, and make the leading coefficient of the denominator positive. */
void qdot_ratio_cancel(qdot_field *f, qdot_ratio *r);
/* r = k r', with primitive numerator and denominator of r' and a positive leading coefficient
 * below; r becomes r'. */
void qdot_ratio_content(qdot_field *f, fmpq_t k, qdot_ratio *r);

/* The polynomial p as an expanded expression; qdot_ratio_expr: the quotient r as one. */
qdot_expr qdot_field_expr(qdot_field *f, const fmpz_mpoly_t p);
qdot_expr qdot_field_ratio_expr(qdot_field *f, const qdot_ratio *r);

#endif
