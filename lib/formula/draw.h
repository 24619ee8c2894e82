/* draw.h -- boxes drawn into lines of characters. Internal to formula/.
 *
 * Tests  tests/formula/test_layout.c
 */
#ifndef QDOT_FORMULA_DRAW_H
#define QDOT_FORMULA_DRAW_H

#include "formula/box.h"

/* A box to be drawn, and the column at which it begins. */
typedef struct {
    uint32_t box;
    size_t x;
} qdot_draw_item;

/* Colour for the first columns of the baseline: terminal codes before and after them; code NULL: none. */
typedef struct {
    size_t columns;
    const char *code, *end;
} qdot_draw_colour;

/* Append boxes [n] beside each other on one baseline, as many lines as they are high; *lines grows
 * by these. Errors: QDOT_ENOMEM, QDOT_ELIMIT. */
QDOT_MUST_CHECK qdot_status qdot_draw_line(const qdot_boxes *boxes, const qdot_draw_item *items,
                                           size_t n, const qdot_draw_colour *colour,
                                           qdot_text *out, size_t *lines);
/* The number of lines that drawing the items takes. */
size_t qdot_draw_height(const qdot_boxes *boxes, const qdot_draw_item *items, size_t n);

#endif
