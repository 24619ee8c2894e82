/* derive-lines.h -- the lines of `derive`: numbered steps, and equations of a textbook's symbols.
 *
 * A symbol is drawn with its subscript, or written in one line, v[bob]^2, where formulas are. Errors are those of the
 * sheet and the pool.
 */
#ifndef QDOT_LANG_DERIVE_LINES_H
#define QDOT_LANG_DERIVE_LINES_H

#include "lang/answer/sheet.h"

typedef struct {
    qdot_session *session;
    qdot_sheet sheet;
    int step;
} qdot_derivation;

/* A textbook symbol with the particle, body or coordinate it belongs to: r[bob], drawn as r with a subscript. */
typedef struct {
    const char *letter;   /* the symbol as qdot_notation_add reads it */
    const char *of;       /* subscript: a label or coordinate name; NULL: none */
    qdot_expr coordinate; /* coordinate of the subscript; nil: `of` is a label */
    bool square;
} qdot_derived_symbol;

/* Begin a step of the derivation: `3. Title: formula`, the formula in the notation of qdot_notation_add; NULL: none. */
void qdot_derive_step(qdot_derivation *d, const char *title, const char *formula);
/* What a line is of, before its formula: `    potential energy of gravity on bob: `; the last two
 * may be NULL. */
void qdot_derive_label(qdot_derivation *d, const char *what, const char *of, const char *joined, const char *name);
/* Append a line with the equation `symbol = value`. */
QDOT_MUST_CHECK qdot_status qdot_derive_equation(qdot_derivation *d, qdot_derived_symbol x, qdot_expr value);
/* Append `dF/dq' = value`, with d/dt before it (total), or `dF/dq = value` (not `fast`); if possible as fractions. */
QDOT_MUST_CHECK qdot_status qdot_derive_derivative(qdot_derivation *d, char F, bool total, bool fast, size_t i, qdot_expr value);
/* Append a relation on a line of its own. */
QDOT_MUST_CHECK qdot_status qdot_derive_relation(qdot_derivation *d, qdot_expr e);

#endif
