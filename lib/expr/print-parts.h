/* print-parts.h -- internal to the printers: parts still to be printed, and the nodes to which they belong. */
#ifndef QDOT_EXPR_PRINT_PARTS_H
#define QDOT_EXPR_PRINT_PARTS_H

#include <flint/fmpq.h>

#include "expr/pool.h"
#include "expr/print-name.h"
#include "formula/formula.h"

/* The context in which an expression is printed, which decides whether it needs brackets. */
enum { TOP, TERM, FACTOR, BASE, MAGNITUDE = -1, DENOMINATOR = -2, NUMERATOR = -3 };

/* An expression to print in its context, multiplied by `coefficient` (a NUM) unless that is nil. */
struct part {
    qdot_expr e, coefficient;
    int context;
    bool turned; /* print -1 times the sum e; for a product, with one difference negated */
    qdot_formula_id at; /* the empty node of the formula (a SPAN) that this part will fill */
    uint32_t binder; /* of the innermost integral around e, an index in printer.binders; 0: there is none */
};

/* An integral in whose integrand something is printed, with the name of its variable. */
struct binder {
    uint32_t outer; /* the integral around it */
    qdot_expr integral;
    char own[8]; /* the name, if that with which the integral was made means something else here; else "" */
};

typedef struct {
    const qdot_pool *pool;
    qdot_notation_kind notation;
    qdot_expr ascending; /* a LIST of symbols: order terms by their degree in them; nil: canonical order */
    qdot_expr below; /* a difference that is in the denominators of several matrix entries, all printed with the same sign */
    bool fractions; /* decimals are printed as fractions, too: 1/5 beside 5/3 */
    bool below_turned, turning; /* that difference was negated; an entry with it is being written */
    qdot_formula *out;
    qdot_formula_id at;     /* the formula node to which children are appended */
    qdot_vec(struct part) todo; /* stack of parts still to be printed */
    uint32_t binder;            /* of the part that is being printed */
    qdot_vec(struct binder) binders; /* binders.at[0] is none */
    qdot_status status;
} printer;

/* Whether e has p->below, a difference common to several denominators, as a factor in its denominator. */
static inline bool
is_over_below(const printer *p, qdot_expr e)
{
    for (uint32_t i = 1; p->below != QDOT_NIL && NODE(p->pool, e)->kind == QDOT_PROD &&
                         i < NODE(p->pool, e)->n;
         i += 2)
        if (ARGS(p->pool, e)[i] == p->below)
            return ARGS(p->pool, e)[i + 1] == QDOT_MINUS_ONE;
    return false;
}

/* The factor of e, a difference such as a - b, into which a minus sign can be absorbed: b - a. */
static inline qdot_expr
turnable(const printer *p, qdot_expr e)
{
    qdot_expr b = qdot_expr_turnable(p->pool, e);

    return b != QDOT_NIL && b == p->below && is_over_below(p, e) ? QDOT_NIL : b;
}

static inline bool
is_drawn(const printer *p)
{
    return p->notation == QDOT_NOTATION_DRAWN;
}

/* Append x as the next child: numbers and names at once, otherwise an empty node to be filled
 * later. (print.c) */
void qdot_print_part(printer *p, struct part x);

static inline void
child(printer *p, qdot_expr e, int context)
{
    qdot_print_part(p, (struct part){.e = e, .context = context});
}

static inline void
print_sign(printer *p, qdot_formula_sign sign)
{
    qdot_formula_add_sign(p->out, p->at, sign);
}

/* Append text unchanged to the formula, in a superscript as well as in a line. */
void qdot_print_text(printer *p, const char *text);

/* Begin a child node of the formula; what follows is appended to it until p->at is set to the returned value. */
static inline qdot_formula_id
print_begin(printer *p, qdot_formula_kind kind, unsigned what, unsigned flags)
{
    const qdot_formula_id outer = p->at;

    p->at = qdot_formula_add(p->out, outer, kind, what, flags);
    return outer;
}

/* Begin round brackets around what is printed next, if they are needed. */
static inline qdot_formula_id
print_begin_bracket(printer *p, bool needed)
{
    return needed ? print_begin(p, QDOT_FORMULA_BRACKET, QDOT_BRACKET_ROUND, 0) : p->at;
}

/* Begin one of several children of a formula node: as a row of its own in drawn formulas. */
static inline qdot_formula_id
print_begin_row(printer *p)
{
    return print_begin(p, is_drawn(p) ? QDOT_FORMULA_ROW : QDOT_FORMULA_SPAN, 0, 0);
}

/* Begin the only child of a formula node; written in a line, it needs no node of its own. */
static inline qdot_formula_id
print_begin_one(printer *p)
{
    return is_drawn(p) ? print_begin(p, QDOT_FORMULA_ROW, 0, 0) : p->at;
}

static inline void
children(printer *p, qdot_expr e, uint32_t from, uint32_t to)
{
    for (uint32_t i = from; i < to; i++) {
        if (i > from)
            print_sign(p, QDOT_SIGN_COMMA);
        child(p, ARGS(p->pool, e)[i], TOP);
    }
}

/* Print a name that belongs to no symbol, such as a function's. (print-symbol.c) */
void qdot_print_spelled(printer *p, const char *name);
void qdot_print_symbol_parts(printer *p, qdot_expr e);
/* Whether x is written as a decimal number here, 9.81: its denominator has a factor 5 and no other prime factors except
 * 2; at most 40 digits if that is longer than the fraction. (print-number.c) */
bool qdot_print_says_decimal(const printer *p, const fmpq_t x);
/* Whether x is an integer, a decimal number or a single character such as ½: a root may directly follow it. */
bool qdot_print_is_compact(const printer *p, const fmpq_t x);
/* Whether e holds a fraction that has no decimal form beside decimals that are short fractions. Errors: QDOT_ENOMEM,
 * QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_print_wants_fractions(const qdot_pool *pool, qdot_expr e, bool *wants);
/* Print the rational x; bracket 1: a negative number in brackets, 2: a fraction in brackets, too. (print-number.c) */
void qdot_print_number(printer *p, const fmpq_t x, int bracket);
void qdot_print_integer(printer *p, uint32_t n);
/* c * e, e without a coefficient (or the number 1); a context below 0: the sign is already
 * written; flip: a difference is negated instead of a minus sign. (print-product.c) */
void qdot_print_scaled(printer *p, qdot_expr c, qdot_expr e, int context, bool flip);
/* Print the application of an elementary or undefined function. (print-function.c) */
void qdot_print_function(printer *p, qdot_expr e, int context);
void qdot_print_ufun(printer *p, qdot_expr e, int context);
/* Print an integral, and the variable of an integral. (print-integral.c) */
void qdot_print_integral(printer *p, qdot_expr e, int context);
void qdot_print_bound(printer *p, qdot_expr e);

#endif
