/* print-parts.h -- inside the printers: pieces still to be written, and words by style. */
#ifndef QDOT_EXPR_PRINT_PARTS_H
#define QDOT_EXPR_PRINT_PARTS_H

#include "expr/pool.h"
#include "expr/print-name.h"

/* How tightly the context of a piece binds: decides whether it needs brackets. */
enum { TOP, TERM, FACTOR, BASE, MAGNITUDE = -1, DENOMINATOR = -2, NUMERATOR = -3 };

/* A piece: a text (or a name), or an order of derivative, or an expression in its context;
 * `coefficient` not nil: times it (a NUM). */
struct piece {
    const char *text;
    qdot_expr e, coefficient;
    int context;
    uint32_t order;
    bool raised; /* a unicode superscript */
    bool turned; /* -1 times the sum e; for a product, with its difference negated */
    bool name;   /* a name, written in the style: theta as θ */
    bool own;    /* the piece owns the text */
    bool ends;   /* a mark, no text: the output from `from` on is the text of e */
    size_t from;
};

typedef qdot_vec(struct piece) pieces;

typedef struct {
    const qdot_pool *pool;
    qdot_style style;
    qdot_expr ascending; /* a LIST: order terms by their degree in these; nil: canonical order */
    qdot_expr below; /* a difference in denominators of several matrix entries: keeps its sign */
    bool below_turned, turning; /* it is negated; such an entry is being opened */
    qdot_text *out;
    pieces todo; /* a stack */
    pieces next; /* of the node being opened, in reading order */
    qdot_status status;
} printer;

/* Whether e has the difference that keeps its sign as its denominator. */
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

/* The difference among the factors of e that takes a minus sign before them (pool.h). */
static inline qdot_expr
turnable(const printer *p, qdot_expr e)
{
    qdot_expr b = qdot_expr_turnable(p->pool, e);

    return b != QDOT_NIL && b == p->below && is_over_below(p, e) ? QDOT_NIL : b;
}

static inline void
piece(printer *p, struct piece x)
{
    if (qdot_vec_push(&p->next, x) != QDOT_OK)
        p->status = QDOT_ENOMEM;
}

static inline void
print_text(printer *p, const char *text)
{
    piece(p, (struct piece){.text = text});
}

static inline void
child(printer *p, qdot_expr e, int context)
{
    piece(p, (struct piece){.e = e, .context = context});
}

static inline void
print_name_text(printer *p, const char *text)
{
    piece(p, (struct piece){.text = text, .name = true});
}

/* The text of this style. */
static inline const char *
styled(const printer *p, const char *plain, const char *unicode, const char *latex,
       const char *mathml)
{
    switch (p->style) {
    case QDOT_PLAIN: return plain;
    case QDOT_UNICODE: return unicode;
    case QDOT_LATEX: return latex;
    default: return mathml;
    }
}

/* Whether fractions, roots and powers are drawn, not written in a line. */
static inline bool
is_drawn(const printer *p)
{
    return p->style == QDOT_LATEX || p->style == QDOT_MATHML;
}

static inline void
open_bracket(printer *p)
{
    print_text(p, styled(p, "(", "(", "\\left(", "<mrow><mo>(</mo>"));
}

static inline void
print_close_bracket(printer *p)
{
    print_text(p, styled(p, ")", ")", "\\right)", "<mo>)</mo></mrow>"));
}

static inline const char *
comma(const printer *p)
{
    return styled(p, ", ", ", ", ", ", "<mo>,</mo>");
}

static inline void
children(printer *p, qdot_expr e, uint32_t from, uint32_t to, const char *between)
{
    for (uint32_t i = from; i < to; i++) {
        if (i > from)
            print_text(p, between);
        child(p, ARGS(p->pool, e)[i], TOP);
    }
}

/* c * e, e without a coefficient (or the number 1); a context below 0: the sign is already
 * written; flip: a difference is negated instead of a minus sign. (print-product.c) */
void qdot_print_scaled(printer *p, qdot_expr c, qdot_expr e, int context, bool flip);
/* (print-function.c) */
void qdot_print_function(printer *p, qdot_expr e, int context);
void qdot_print_ufun(printer *p, qdot_expr e, int context);
/* The text before a base with a superscript; the exponent, negated in a denominator, and the text
 * after it. (print-product.c) */
void qdot_print_raise(printer *p);
void qdot_print_exponent(printer *p, qdot_expr e, bool turned);

#endif
