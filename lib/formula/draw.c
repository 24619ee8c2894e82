/* draw.c -- draws boxes into a grid of characters, with a stack of the boxes still to be drawn. */
#include "formula/draw.h"

#include <string.h>

#include "base/utf8.h"

/* A character of the grid (0: a space) and the accent over it (0: none). */
typedef struct {
    uint32_t c, mark;
} cell;

/* A box to be drawn, the column of its left end and the line of its baseline. */
typedef struct {
    uint32_t box;
    size_t x, y;
} task;

typedef struct {
    const qdot_boxes *boxes;
    cell *grid; /* [rows x columns] the characters drawn */
    size_t columns, rows;
    qdot_vec(task) todo;
    qdot_status status;
} canvas;

static void
put_character(canvas *c, size_t x, size_t y, uint32_t character)
{
    if (x < c->columns && y < c->rows)
        c->grid[y * c->columns + x].c = character;
}

static void
push_box_to_draw(canvas *c, uint32_t box, size_t x, size_t y)
{
    const task t = {box, x, y};

    if (c->status == QDOT_OK)
        c->status = qdot_vec_push(&c->todo, t);
}

static const qdot_box *
get_box(const canvas *c, uint32_t i)
{
    return c->boxes->box.at + i;
}

static void
draw_text(canvas *c, const char *text, size_t bytes, size_t x, size_t y)
{
    for (size_t i = 0, n; i < bytes; i += n > 0 ? n : 1) {
        const uint32_t character = qdot_utf8_decode(text + i, &n);

        if (qdot_utf8_columns(text + i, n) > 0)
            put_character(c, x++, y, character);
        else if (x > 0 && x - 1 < c->columns && y < c->rows)
            c->grid[y * c->columns + x - 1].mark = character;
    }
}

/* Draw a bracket as high as its row: upper end, repeated part, lower end, middle. */
static void
draw_bracket(canvas *c, const qdot_box *b, size_t x, size_t y)
{
    static const struct {
        const char *sign;
        uint32_t top, on, bottom, middle;
    } tall[] = {{"(", 0x239B, 0x239C, 0x239D, 0x239C}, {")", 0x239E, 0x239F, 0x23A0, 0x239F},
                {"[", 0x23A1, 0x23A2, 0x23A3, 0x23A2}, {"]", 0x23A4, 0x23A5, 0x23A6, 0x23A5},
                {"{", 0x23A7, 0x23AA, 0x23A9, 0x23A8}, {"|", 0x2502, 0x2502, 0x2502, 0x2502},
                {"⌊", 0x23A2, 0x23A2, 0x23A3, 0x23A2}, {"⌋", 0x23A5, 0x23A5, 0x23A6, 0x23A5}};
    const char *text = c->boxes->text.at + b->first;
    const size_t height = qdot_box_height(b), first = y - b->above;

    for (size_t i = 0; i < sizeof tall / sizeof *tall; i++) {
        if (strlen(tall[i].sign) != b->count || memcmp(tall[i].sign, text, b->count) != 0)
            continue;
        for (size_t r = 0; r < height; r++)
            put_character(c, x, first + r,
                          r == 0            ? tall[i].top
                          : r + 1 == height ? tall[i].bottom
                          : r == height / 2 ? tall[i].middle
                                  : tall[i].on);
    }
}

static void
draw_fraction(canvas *c, const qdot_box *b, size_t x, size_t y)
{
    const uint32_t *of = c->boxes->children.at + b->first;
    const qdot_box *up = get_box(c, of[0]), *down = get_box(c, of[1]);

    for (size_t i = 0; i < b->columns; i++)
        put_character(c, x + i, y, 0x2500);
    push_box_to_draw(c, of[0], x + (b->columns - up->columns) / 2, y - up->below - 1);
    push_box_to_draw(c, of[1], x + (b->columns - down->columns) / 2, y + down->above + 1);
}

static void
draw_root(canvas *c, const qdot_box *b, size_t x, size_t y)
{
    const uint32_t of = c->boxes->children.at[b->first];
    const qdot_box *under = get_box(c, of);
    const size_t sign = qdot_box_root_sign(under), height = qdot_box_height(under);

    for (size_t i = height > 1 ? sign - 1 : sign; i < b->columns; i++)
        put_character(c, x + i, y - under->above - 1, '_');
    if (height == 1) {
        put_character(c, x, y, 0x221A);
    } else {
        put_character(c, x, y + under->below, 0x2572);
        for (size_t r = 0; r < height; r++)
            put_character(c, x + 1 + r, y + under->below - r, 0x2571);
    }
    push_box_to_draw(c, of, x + sign, y);
}

static void
draw_script(canvas *c, const qdot_box *b, size_t x, size_t y)
{
    const uint32_t *of = c->boxes->children.at + b->first;
    const qdot_box *base = get_box(c, of[0]), *script = get_box(c, of[1]);

    push_box_to_draw(c, of[0], x, y);
    push_box_to_draw(c, of[1], x + base->columns - (b->kind == QDOT_BOX_SUB ? b->across : 0),
                     b->kind == QDOT_BOX_SUB ? y + base->below + 1 + script->above
                                  : y - base->above - (base->above == 0) - script->below);
}

static void
draw_table(canvas *c, const qdot_box *b, size_t x, size_t y)
{
    const uint32_t *of = c->boxes->children.at + b->first;
    const uint32_t rows = b->count / b->across;

    for (uint32_t j = 0; j < b->across; j++) {
        size_t at = y - b->above, widest = 0;

        for (uint32_t i = 0; i < rows; i++)
            if (get_box(c, of[i * b->across + j])->columns > widest)
                widest = get_box(c, of[i * b->across + j])->columns;
        for (uint32_t i = 0; i < rows; i++) {
            const qdot_box *own = get_box(c, of[i * b->across + j]);
            uint32_t above = 0, below = 0;

            for (uint32_t k = 0; k < b->across; k++) {
                const qdot_box *other = get_box(c, of[i * b->across + k]);

                above = other->above > above ? other->above : above;
                below = other->below > below ? other->below : below;
            }
            at += above + (i > 0 && above > 0);
            push_box_to_draw(c, of[i * b->across + j], x + (widest - own->columns) / 2, at);
            at += below + 1;
        }
        x += widest + QDOT_BOX_GAP;
    }
}

static void
draw_row(canvas *c, const qdot_box *b, size_t x, size_t y)
{
    for (uint32_t k = 0; k < b->count; k++) {
        const uint32_t child = c->boxes->children.at[b->first + k];

        push_box_to_draw(c, child, x, y);
        x += get_box(c, child)->columns;
    }
}

static void
box_draw(canvas *c, task t)
{
    const qdot_box *b = get_box(c, t.box);

    switch (b->kind) {
    case QDOT_BOX_TEXT:
        if (b->above + b->below > 0)
            draw_bracket(c, b, t.x, t.y);
        else
            draw_text(c, c->boxes->text.at + b->first, b->count, t.x, t.y);
        break;
    case QDOT_BOX_ROW: draw_row(c, b, t.x, t.y); break;
    case QDOT_BOX_FRACTION: draw_fraction(c, b, t.x, t.y); break;
    case QDOT_BOX_ROOT: draw_root(c, b, t.x, t.y); break;
    case QDOT_BOX_TABLE: draw_table(c, b, t.x, t.y); break;
    default: draw_script(c, b, t.x, t.y);
    }
}

static void
append_utf8_character(qdot_text *out, uint32_t c)
{
    if (c < 0x80) {
        qdot_text_char(out, (char)(c != 0 ? c : ' '));
        return;
    }
    if (c < 0x800) {
        qdot_text_char(out, (char)(0xC0 | c >> 6));
    } else if (c < 0x10000) {
        qdot_text_char(out, (char)(0xE0 | c >> 12));
        qdot_text_char(out, (char)(0x80 | (c >> 6 & 0x3F)));
    } else {
        qdot_text_char(out, (char)(0xF0 | c >> 18));
        qdot_text_char(out, (char)(0x80 | (c >> 12 & 0x3F)));
        qdot_text_char(out, (char)(0x80 | (c >> 6 & 0x3F)));
    }
    qdot_text_char(out, (char)(0x80 | (c & 0x3F)));
}

/* Write the lines of the grid without trailing spaces; the first columns of the baseline are in colour. */
static void
write_grid(const canvas *c, size_t baseline, const qdot_draw_colour *colour, qdot_text *out)
{
    for (size_t y = 0; y < c->rows; y++) {
        const cell *row = c->grid + y * c->columns;
        const size_t painted = y == baseline && colour->code ? colour->columns : 0;
        bool inside = false;
        size_t n = c->columns;

        while (n > 0 && (row[n - 1].c == 0 || row[n - 1].c == ' '))
            n--;
        for (size_t x = 0; x < n; x++) {
            const bool blank = row[x].c == 0 || row[x].c == ' ';

            if (!inside && x < painted && !blank)
                qdot_text_add(out, colour->code);
            inside = inside || (x < painted && !blank);
            append_utf8_character(out, row[x].c);
            if (row[x].mark != 0)
                append_utf8_character(out, row[x].mark);
            if (inside && (x + 1 == painted || x + 1 == n)) {
                qdot_text_add(out, colour->end);
                inside = false;
            }
        }
        qdot_text_char(out, '\n');
    }
}

/* Find how many lines items next to each other need above and below their baseline. */
static void
measure_items(const qdot_boxes *boxes, const qdot_draw_item *items, size_t n, size_t *above,
              size_t *below)
{
    *above = *below = 0;
    for (size_t i = 0; i < n; i++) {
        const qdot_box *b = boxes->box.at + items[i].box;

        *above = b->above > *above ? b->above : *above;
        *below = b->below > *below ? b->below : *below;
    }
}

size_t
qdot_draw_height(const qdot_boxes *boxes, const qdot_draw_item *items, size_t n)
{
    size_t above, below;

    measure_items(boxes, items, n, &above, &below);
    return above + 1 + below;
}

qdot_status
qdot_draw_line(const qdot_boxes *boxes, const qdot_draw_item *items, size_t n,
               const qdot_draw_colour *colour, qdot_text *out, size_t *lines)
{
    canvas c = {.boxes = boxes};
    size_t above, below;
    qdot_status status;

    measure_items(boxes, items, n, &above, &below);
    for (size_t i = 0; i < n; i++) {
        const qdot_box *b = boxes->box.at + items[i].box;

        if (items[i].x + b->columns > c.columns)
            c.columns = items[i].x + b->columns;
    }
    c.rows = above + 1 + below;
    if (c.columns > SIZE_MAX / sizeof *c.grid / c.rows)
        return qdot_fail(QDOT_ELIMIT, "the formula is too large to be laid out");
    c.grid = qdot_calloc(c.rows * c.columns + 1, sizeof *c.grid);
    if (!c.grid)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++) {
        push_box_to_draw(&c, items[i].box, items[i].x, above);
        while (c.status == QDOT_OK && c.todo.n > 0)
            box_draw(&c, c.todo.at[--c.todo.n]);
    }
    if (c.status == QDOT_OK)
        write_grid(&c, above, colour, out);
    *lines += c.rows;
    status = c.status;
    qdot_free(c.grid);
    qdot_free(c.todo.at);
    return status != QDOT_OK ? status : qdot_text_status(out);
}
