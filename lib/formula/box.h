/* box.h -- a formula as boxes: what stands beside, above and below what, and how large it is.
 *
 * Boxes are numbered, those within a box before it. A box has columns, and rows above and below
 * its baseline row. Internal to formula/.
 *
 * Tests  tests/formula/test_layout.c
 */
#ifndef QDOT_FORMULA_BOX_H
#define QDOT_FORMULA_BOX_H

#include <stdbool.h>
#include <stdint.h>

#include "base/memory.h"
#include "base/text.h"
#include "formula/formula.h"

typedef enum {
    QDOT_BOX_TEXT,
    QDOT_BOX_ROW,      /* children side by side */
    QDOT_BOX_FRACTION, /* two children: numerator, denominator */
    QDOT_BOX_ROOT,
    QDOT_BOX_SUPER, /* base, superscript */
    QDOT_BOX_SUB,   /* base, subscript */
    QDOT_BOX_TABLE  /* cells of a table, row by row */
} qdot_box_kind;

/* The role of a text box in its row. */
typedef enum {
    QDOT_BOX_NAME, /* a number or a name */
    QDOT_BOX_RELATION,
    QDOT_BOX_SIGN, /* + or - between two terms, `and`, `or` */
    QDOT_BOX_TIMES,
    QDOT_BOX_OVER, /* the / of a fraction written on one line */
    QDOT_BOX_COMMA,
    QDOT_BOX_END,  /* end of a row of a matrix written on several lines */
    QDOT_BOX_WORD, /* a word of a text, with the blank after it */
    QDOT_BOX_OPENING, /* an opening bracket, as high as its row */
    QDOT_BOX_CLOSING
} qdot_box_role;

typedef struct {
    uint8_t kind, role;
    uint8_t label; /* whether the text belongs to the words or the name that precede the value in an answer */
    uint32_t first, count; /* first child and number of children; for a text its first byte and length */
    uint32_t columns, above, below;
    uint32_t across; /* for a table: cells in a row; for a subscript: columns of the base above it */
} qdot_box;

typedef struct {
    qdot_vec(qdot_box) box;
    qdot_vec(uint32_t) children;
    qdot_text text;
} qdot_boxes;

/* The boxes of a node and what is below it, the last of which is all of it. Clear them in any case. Errors:
 * QDOT_ENOMEM, QDOT_ELIMIT, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_boxes_build(const qdot_formula *f, qdot_formula_id id, qdot_boxes *boxes);
void qdot_boxes_clear(qdot_boxes *boxes);

/* The columns of a root sign in front of its radicand. */
static inline uint32_t
qdot_box_root_sign(const qdot_box *under)
{
    return under->above + under->below == 0 ? 1 : under->above + under->below + 3;
}

/* The height of a box, in lines of text. */
static inline uint32_t
qdot_box_height(const qdot_box *b)
{
    return b->above + 1 + b->below;
}

enum { QDOT_BOX_GAP = 2 }; /* blank columns between the columns of a table */

#endif
