/* formula.h -- a formula as a tree: what stands beside, above and below what.
 *
 *     -b/(2 a)  drawn     SPAN(SIGN minus, FRACTION(ROW(NAME b), ROW(NUMBER 2, SIGN times, NAME a)))
 *               in a line  SPAN(SIGN minus, FRACTION(SPAN(NAME b), BRACKET(NUMBER 2, SIGN times, NAME a)))
 *
 * Nodes are numbered; node 0 is nil. Children of a node form a circular list, so two nodes may share one: the tree is
 * a directed acyclic graph, as the expression is that it was made of. A tree is made for one notation, because
 * brackets depend on it; it knows nothing of expressions.
 *
 * Nil absorbs: where memory runs out the formula is marked as failed, nil is returned, and what is done with nil does
 * nothing. Ask once, at the end (qdot_formula_status), as of a qdot_text.
 *
 * Tests  tests/formula/test_formula.c
 */
#ifndef QDOT_FORMULA_FORMULA_H
#define QDOT_FORMULA_FORMULA_H

#include <stdbool.h>
#include <stdint.h>

#include "base/memory.h"
#include "base/text.h"

/* How what a tree says is written: as the language reads it, for the eye in a line, and with fractions, roots and
 * powers drawn (LaTeX, MathML, boxes). */
typedef enum { QDOT_NOTATION_SCRIPT, QDOT_NOTATION_LINE, QDOT_NOTATION_DRAWN } qdot_notation_kind;

typedef uint32_t qdot_formula_id;

typedef enum {
    QDOT_FORMULA_SPAN,     /* children side by side, as if they were children of the parent */
    QDOT_FORMULA_ROW,      /* children side by side, as one unit */
    QDOT_FORMULA_TEXT,     /* a text, with one of the roles of qdot_formula_role */
    QDOT_FORMULA_SIGN,     /* a sign of sign.def */
    QDOT_FORMULA_FRACTION, /* two children: numerator, denominator */
    QDOT_FORMULA_ROOT,     /* the square root of all children */
    QDOT_FORMULA_POWER,    /* two children: base, exponent */
    QDOT_FORMULA_INDEX,    /* base, subscript */
    QDOT_FORMULA_ACCENT,   /* one child with n dots above it */
    QDOT_FORMULA_PRIMES,   /* one child followed by n primes */
    QDOT_FORMULA_BRACKET,  /* all children in brackets of the given shape */
    QDOT_FORMULA_TABLE,    /* cells of a matrix or table, n in a row, in brackets */
    QDOT_FORMULA_TENSOR,   /* three children: base, upper indices, lower indices */
    QDOT_FORMULA_CASES,    /* value, condition, value, condition, ..., value otherwise */
    QDOT_FORMULA_APPLY     /* two children: a function and its bracket */
} qdot_formula_kind;

/* The roles of a TEXT node. */
typedef enum {
    QDOT_TEXT_NAME,     /* a name; drawn with Greek letters (θ) and subscripts */
    QDOT_TEXT_NUMBER,   /* an integer or a decimal number without its sign */
    QDOT_TEXT_FUNCTION, /* the name of a function */
    QDOT_TEXT_LABEL,    /* the name of a thing, as it was typed */
    QDOT_TEXT_WORDS     /* a text for people; in LaTeX it is LaTeX already */
} qdot_formula_role;

/* The kinds of a BRACKET node. */
typedef enum {
    QDOT_BRACKET_ROUND,
    QDOT_BRACKET_SQUARE,
    QDOT_BRACKET_BARS,
    QDOT_BRACKET_FLOOR
} qdot_formula_shape;

/* The function that a sign has in its row of a formula. */
typedef enum {
    QDOT_DUTY_NONE,
    QDOT_DUTY_COLON,
    QDOT_DUTY_RELATION,
    QDOT_DUTY_TERMS, /* a plus or minus between two terms */
    QDOT_DUTY_ERROR,
    QDOT_DUTY_LOGIC, /* the word `and` or `or` */
    QDOT_DUTY_TIMES,
    QDOT_DUTY_COMMA
} qdot_formula_duty;

/* Signs and letters; each output notation has its own spelling of them. */
typedef enum {
#define QDOT_SIGN(name, plain, unicode, latex, mathml, duty) QDOT_SIGN_##name,
#include "formula/sign.def"
#undef QDOT_SIGN
    QDOT_SIGNS
} qdot_formula_sign;

/* Flags of nodes: variants of how a node is written. */
enum {
    QDOT_FORMULA_SLANTED = 1, /* FRACTION of numbers, or an exponent: LaTeX writes it with a slash */
    QDOT_FORMULA_RAISED = 2, /* POWER on one line: the integer exponent is written by superscript digits */
    QDOT_FORMULA_BARE = 4,    /* ROOT on one line: √x, without brackets */
    QDOT_FORMULA_FIXED = 8,   /* BRACKET: LaTeX keeps its height at one line */
    QDOT_FORMULA_SMALL = 16,  /* FRACTION: LaTeX writes it in the height of a line */
    QDOT_FORMULA_LABEL = 32   /* any node: part of the name of an answer, before its value */
};

typedef struct {
    uint8_t kind, what, flags; /* kind of the node; its role, sign or shape; flags */
    qdot_formula_id next; /* next child of its parent; of the last child: the first child; 0: it is in no list */
    uint32_t child;            /* the last child, 0: none; for TEXT the index of its first byte */
    uint32_t n;                /* number of bytes, dots, primes, or cells in a row */
} qdot_formula_node;

/* Start with `qdot_formula f = {0};`, free with qdot_formula_clear. */
typedef struct {
    qdot_vec(qdot_formula_node) nodes; /* all nodes of the formula; nodes.at[0] stands for nil */
    qdot_text text;                    /* the bytes of all TEXT nodes */
    bool failed;
    uint32_t stamp; /* stamp of the cache that refers to nodes of this formula (expr/printed) */
} qdot_formula;

void qdot_formula_clear(qdot_formula *f);
/* Remove all nodes of the formula, but keep its memory for reuse. */
void qdot_formula_empty(qdot_formula *f);

/* QDOT_ENOMEM if memory ran out in any earlier call; otherwise QDOT_OK. */
QDOT_MUST_CHECK qdot_status qdot_formula_status(const qdot_formula *f);

/* Create a formula node that has no children and no parent. */
qdot_formula_id qdot_formula_new(qdot_formula *f, qdot_formula_kind kind, unsigned what, unsigned flags);

/* Make child, which has no parent yet, the last child of parent. */
void qdot_formula_append(qdot_formula *f, qdot_formula_id parent, qdot_formula_id child);

/* Create a node and append it to parent; returns the node. */
qdot_formula_id qdot_formula_add(qdot_formula *f, qdot_formula_id parent, qdot_formula_kind kind, unsigned what,
                                 unsigned flags);
qdot_formula_id qdot_formula_add_sign(qdot_formula *f, qdot_formula_id parent, qdot_formula_sign sign);
qdot_formula_id qdot_formula_add_text(qdot_formula *f, qdot_formula_id parent, qdot_formula_role role,
                                      const char *text, size_t n);
/* Append a text node whose text is what f->text contains from byte `from` on. */
qdot_formula_id qdot_formula_add_tail(qdot_formula *f, qdot_formula_id parent, qdot_formula_role role, size_t from);

/* Set the number of dots, of primes, or of cells in a row. */
void qdot_formula_count(qdot_formula *f, qdot_formula_id id, uint32_t n);

/* Make node `to` a copy of node `of`, with the same children. */
void qdot_formula_share(qdot_formula *f, qdot_formula_id to, qdot_formula_id of);

/* Replace a SPAN with a single child, itself no SPAN, by that child, which may be filled later. */
void qdot_formula_unwrap(qdot_formula *f, qdot_formula_id id);

/* The node with this number, which must not be nil. */
static inline const qdot_formula_node *
qdot_formula_at(const qdot_formula *f, qdot_formula_id id)
{
    return f->nodes.at + id;
}

/* The next child after `child` (0: the first one); 0 after the last. Nil has no children. */
static inline qdot_formula_id
qdot_formula_child(const qdot_formula *f, qdot_formula_id parent, qdot_formula_id child)
{
    const qdot_formula_id last = parent == 0 ? 0 : qdot_formula_at(f, parent)->child;

    return child == last ? 0 : qdot_formula_at(f, child != 0 ? child : last)->next;
}

/* The parts of a row of a formula, from left to right. */
typedef struct {
    qdot_vec(qdot_formula_id) part, todo; /* the parts; nodes still to be looked at (scratch) */
} qdot_formula_parts;

/* Append the children of a node, those of SPANs in their place; a SPAN that is a label stays one part. Errors:
 * QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_formula_find_parts(const qdot_formula *f, qdot_formula_id id,
                                                    qdot_formula_parts *parts);
void qdot_formula_parts_clear(qdot_formula_parts *parts);

/* The function of a node that is a sign; QDOT_DUTY_NONE for other nodes. */
qdot_formula_duty qdot_formula_sign_duty(const qdot_formula_node *node);

/* Append a text in LaTeX: the signs between its terms and sides outside braces are nodes, what stands between them
 * WORDS. */
void qdot_formula_add_latex(qdot_formula *f, qdot_formula_id parent, const char *text, size_t n);

/* Whether a node has no children. */
static inline bool
qdot_formula_is_leaf(const qdot_formula_node *node)
{
    return node->kind == QDOT_FORMULA_TEXT || node->kind == QDOT_FORMULA_SIGN;
}

#endif
