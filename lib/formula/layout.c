/* layout.c -- writes a formula as a sequence of boxes, and chooses where to break its lines. */
#include "formula/layout.h"

#include <string.h>

#include "base/interrupt.h"
#include "base/utf8.h"
#include "base/wrap.h"
#include "formula/draw.h"

/* A line is rather broken earlier, by these parts of its length, than one bracket deeper, between
 * factors, before a sign and not a relation, within a text; later behind `spring s1: `. */
static const double deeper = 0.35, between_factors = 0.75, before_sign = 0.15, after_word = 0.3,
                    after_label = -0.35;

/* Of lines that follow, where no relation gives one; the least that is left for what stands there, and for the
 * beginning of a name that is cut. */
enum { usual_indent = 4, least_room = 16, least_cut = 8 };

/* A box that is not broken any further, and the number of brackets around it. */
typedef struct {
    uint32_t box, depth;
} item;

typedef struct {
    qdot_boxes boxes;
    const qdot_layout_request *request;
    size_t width, indent;
    size_t labels; /* number of leading items that belong to names or words before the value */
    size_t name;   /* index of the first label item that belongs to the name, after words such as `spring s1: ` */
    bool several;  /* relations outside brackets, and words: each is one of several formulas */
    qdot_vec(item) todo;  /* stack of nodes still to be written */
    qdot_vec(item) items; /* the items in reading order */
    qdot_vec(qdot_draw_item) line;
    qdot_status status;
} layout;

static const qdot_box *
get_box(const layout *l, uint32_t box)
{
    return l->boxes.box.at + box;
}

/* --- parts of an item that is too wide for a line --------------------------------------------- */

/* Push a box onto the stack of boxes still to be written; the last one pushed is the leftmost. */
static void
push_box(layout *l, uint32_t box, uint32_t depth)
{
    const item x = {box, depth};

    if (l->status == QDOT_OK)
        l->status = qdot_vec_push(&l->todo, x);
}

static void
push_text(layout *l, const char *text, qdot_box_role role, uint32_t depth)
{
    qdot_box x = {.kind = QDOT_BOX_TEXT, .role = (uint8_t)role};

    x.first = (uint32_t)l->boxes.text.n;
    x.count = (uint32_t)strlen(text);
    x.columns = (uint32_t)qdot_utf8_columns(text, x.count);
    qdot_text_add(&l->boxes.text, text);
    if (l->status == QDOT_OK)
        l->status = qdot_text_status(&l->boxes.text);
    if (l->status == QDOT_OK)
        l->status = qdot_vec_push(&l->boxes.box, x);
    if (l->status == QDOT_OK)
        push_box(l, (uint32_t)(l->boxes.box.n - 1), depth);
}

/* Push a box in brackets, unless it is a name. */
static void
push_bracketed(layout *l, uint32_t box, uint32_t depth)
{
    const bool name = get_box(l, box)->kind == QDOT_BOX_TEXT;

    if (!name)
        push_text(l, ")", QDOT_BOX_CLOSING, depth);
    push_box(l, box, depth + !name);
    if (!name)
        push_text(l, "(", QDOT_BOX_OPENING, depth);
}

/* Push the boxes of a row; its brackets get the height of one line. */
static void
push_row_of_boxes(layout *l, const qdot_box *row, uint32_t depth)
{
    uint32_t inside = 0;

    for (uint32_t k = row->count; k-- > 0;) {
        const uint32_t child = l->boxes.children.at[row->first + k];
        qdot_box *x = l->boxes.box.at + child;
        const bool bracket = x->kind == QDOT_BOX_TEXT &&
                             (x->role == QDOT_BOX_OPENING || x->role == QDOT_BOX_CLOSING);

        if (bracket) {
            x->above = x->below = 0;
            inside = x->role == QDOT_BOX_CLOSING;
        }
        push_box(l, child, depth + (bracket ? 0 : inside));
    }
}

static void
push_table(layout *l, const qdot_box *table, uint32_t depth)
{
    for (uint32_t k = table->count; k-- > 0;) {
        push_box(l, l->boxes.children.at[table->first + k], depth);
        if (k > 0)
            push_text(l, k % table->across > 0 ? ", " : ";",
                      k % table->across > 0 ? QDOT_BOX_COMMA : QDOT_BOX_END, depth);
    }
}

/* Push bytes [from, from + n) of a text, as a box, onto the stack of boxes to be written. */
static void
push_piece(layout *l, qdot_box whole, size_t from, size_t n, uint32_t depth)
{
    whole.first += (uint32_t)from;
    whole.count = (uint32_t)n;
    whole.columns = (uint32_t)qdot_utf8_columns(l->boxes.text.at + whole.first, n);
    if (l->status == QDOT_OK)
        l->status = qdot_vec_push(&l->boxes.box, whole);
    push_box(l, (uint32_t)(l->boxes.box.n - 1), depth);
}

/* Push an index without brackets onto the stack of boxes to be written; its commas become _, as typed. */
static void
push_index(layout *l, uint32_t index, uint32_t depth)
{
    const qdot_box row = *get_box(l, index);

    if (row.kind != QDOT_BOX_ROW)
        push_box(l, index, depth);
    for (uint32_t k = row.kind == QDOT_BOX_ROW ? row.count : 0; k-- > 0;) {
        const uint32_t child = l->boxes.children.at[row.first + k];
        const qdot_box *x = get_box(l, child);

        if (x->kind == QDOT_BOX_TEXT && x->role == QDOT_BOX_COMMA)
            push_text(l, "_", QDOT_BOX_NAME, depth);
        else
            push_box(l, child, depth);
    }
    push_text(l, "_", QDOT_BOX_NAME, depth);
}

/* A name and its indices in one line, as they are typed, k_long_name; a power that stands above the indices behind
 * them. */
static void
push_indexed(layout *l, const qdot_box *sub, uint32_t depth)
{
    const uint32_t base = l->boxes.children.at[sub->first], index = l->boxes.children.at[sub->first + 1];
    const uint32_t letters = get_box(l, base)->columns - sub->across;
    const qdot_box whole = *get_box(l, base);
    size_t n = 0;

    if (whole.kind != QDOT_BOX_TEXT) {
        push_index(l, index, depth);
        push_bracketed(l, base, depth);
        return;
    }
    while (n < whole.count && qdot_utf8_columns(l->boxes.text.at + whole.first, n + 1) <= letters)
        n++;
    if (n < whole.count)
        push_piece(l, whole, n, whole.count - n, depth);
    push_index(l, index, depth);
    push_piece(l, whole, 0, n, depth);
}

static void
push_parts(layout *l, qdot_box x, uint32_t depth)
{
    const uint32_t *of = l->boxes.children.at + x.first;

    switch (x.kind) {
    case QDOT_BOX_ROW: push_row_of_boxes(l, &x, depth); break;
    case QDOT_BOX_TABLE: push_table(l, &x, depth); break;
    case QDOT_BOX_SUB: push_indexed(l, &x, depth); break;
    case QDOT_BOX_ROOT:
        push_bracketed(l, of[0], depth);
        push_text(l, "√", QDOT_BOX_NAME, depth);
        break;
    default:
        push_bracketed(l, of[1], depth);
        push_text(l, x.kind == QDOT_BOX_FRACTION ? "/" : "^",
                  x.kind == QDOT_BOX_FRACTION ? QDOT_BOX_OVER : QDOT_BOX_NAME, depth);
        push_bracketed(l, of[0], depth);
    }
}

/* Of lines that follow: behind the first relation, where there is one not far from the left; else
 * a little more than the blanks that the first begins with. */
static size_t
continuation_indent(const layout *l)
{
    const qdot_box *all = get_box(l, (uint32_t)(l->boxes.box.n - 1));
    size_t columns = 0, blanks = 0;

    for (uint32_t k = 0; k < all->count; k++) {
        const qdot_box *b = get_box(l, l->boxes.children.at[all->first + k]);

        if (k == 0 && b->kind == QDOT_BOX_TEXT)
            while (blanks < b->count && l->boxes.text.at[b->first + blanks] == ' ')
                blanks++;
        columns += b->columns;
        if (columns > blanks + l->width / 3)
            break;
        if (b->kind == QDOT_BOX_TEXT &&
            (b->role == QDOT_BOX_RELATION || b->role == QDOT_BOX_COMMA))
            return columns;
    }
    return blanks + usual_indent;
}

/* Whether breaking a box costs more than a line: a fraction, a root, a matrix. */
static bool
is_drawn(const layout *l, const qdot_box *b)
{
    bool table = false;

    for (uint32_t k = 0; b->kind == QDOT_BOX_ROW && k < b->count; k++)
        table = table || get_box(l, l->boxes.children.at[b->first + k])->kind == QDOT_BOX_TABLE;
    return b->kind != QDOT_BOX_ROW || table;
}

/* The formula as boxes that fit into a line. What is drawn may have all of it but the usual
 * indent. */
static qdot_status
split_formula_into_items(layout *l)
{
    const uint32_t all = (uint32_t)(l->boxes.box.n - 1);

    l->indent = continuation_indent(l);

    push_row_of_boxes(l, get_box(l, all), 0);
    while (l->status == QDOT_OK && l->todo.n > 0) {
        const item x = l->todo.at[--l->todo.n];
        const qdot_box *b = get_box(l, x.box);

        if (b->kind == QDOT_BOX_TEXT || b->columns <= l->width - l->indent) {
            l->status = qdot_vec_push(&l->items, x);
        } else if (is_drawn(l, b) && b->columns <= l->width - usual_indent) {
            l->indent = usual_indent;
            l->status = qdot_vec_push(&l->items, x);
        } else {
            push_parts(l, *b, x.depth);
        }
        if (l->status == QDOT_OK)
            l->status = qdot_interrupt_check();
    }
    return l->status;
}

/* --- breaking a formula into lines ------------------------------------------------------------ */

static qdot_box_role
item_role(const layout *l, size_t i)
{
    const qdot_box *b = get_box(l, l->items.at[i].box);

    return b->kind == QDOT_BOX_TEXT ? (qdot_box_role)b->role : QDOT_BOX_NAME;
}

/* Whether item i, which is higher than a line, follows a relation and does not fit into a line with it: then the
 * relation ends a line. */
static bool
needs_own_line(const layout *l, size_t i)
{
    const qdot_box *b;

    if (i == 0 || i >= l->items.n || item_role(l, i - 1) != QDOT_BOX_RELATION)
        return false;
    b = get_box(l, l->items.at[i].box);
    return qdot_box_height(b) > 1 &&
           get_box(l, l->items.at[i - 1].box)->columns + b->columns > l->width - l->indent;
}

/* Whether a line may begin with item i. */
static bool
may_begin_line(const layout *l, size_t i)
{
    if (needs_own_line(l, i) || needs_own_line(l, i + 1))
        return needs_own_line(l, i);
    switch (item_role(l, i)) {
    case QDOT_BOX_RELATION:
    case QDOT_BOX_SIGN:
    case QDOT_BOX_TIMES:
    case QDOT_BOX_OVER: return true;
    default:
        return i > 0 && (item_role(l, i - 1) == QDOT_BOX_COMMA || item_role(l, i - 1) == QDOT_BOX_WORD);
    }
}

/* Whether item i is a word with a colon. */
static bool
is_end_of_label(const layout *l, size_t i)
{
    const qdot_box *b = get_box(l, l->items.at[i].box);

    return b->count >= 2 && l->boxes.text.at[b->first + b->count - 2] == ':';
}

/* The cost of a line break before item i, as a fraction of a line. */
static double
cost_of_break(const layout *l, size_t i)
{
    const qdot_box_role role = item_role(l, i);

    if (i > 0 && item_role(l, i - 1) == QDOT_BOX_WORD)
        return is_end_of_label(l, i - 1) ? after_label : after_word;
    if (needs_own_line(l, i))
        return 0;
    if (role == QDOT_BOX_RELATION && l->several)
        return between_factors;
    return deeper * l->items.at[i].depth + (role == QDOT_BOX_RELATION ? 0
                                            : role == QDOT_BOX_SIGN   ? before_sign
                                                                      : between_factors);
}

/* Whether a line that begins with item `from` ends before item i in any case: behind a row of a matrix, and before
 * the value of a name that an earlier line has begun with. */
static bool
must_break_before(const layout *l, size_t from, size_t i)
{
    return item_role(l, i - 1) == QDOT_BOX_END ||
           (i == l->labels && from > l->name && item_role(l, i) == QDOT_BOX_RELATION);
}

/* Where the line that begins with item `from` in column x ends: the number of its last item and
 * one. */
static size_t
choose_line_end(const layout *l, size_t from, size_t x)
{
    const double room = (double)l->width - (double)x;
    size_t columns = 0, best = 0, i = from;
    double least = 0;

    for (; i < l->items.n; i++) {
        if (i > from && must_break_before(l, from, i))
            return i;
        if (i > from && x + columns > l->indent && may_begin_line(l, i)) {
            const double lost = 1 - (double)columns / room + cost_of_break(l, i);

            if (best == 0 || lost <= least) {
                best = i;
                least = lost;
            }
        }
        columns += get_box(l, l->items.at[i].box)->columns;
        if (columns > l->width - x && best > 0)
            return best;
    }
    return l->items.n;
}

/* Remove the space before a sign that begins a line, and make a product sign visible there. */
static qdot_status
trim_item_at_line_begin(layout *l, size_t i)
{
    const qdot_box *b = get_box(l, l->items.at[i].box);
    const uint32_t depth = l->items.at[i].depth;
    const qdot_box_role role = item_role(l, i);
    qdot_text rest = {0};

    if (role == QDOT_BOX_TIMES)
        qdot_text_add(&rest, "·");
    else if (b->kind == QDOT_BOX_TEXT && l->boxes.text.at[b->first] == ' ')
        qdot_text_add_n(&rest, l->boxes.text.at + b->first + 1, b->count - 1);
    else
        return QDOT_OK;
    l->status = qdot_text_status(&rest);
    if (l->status == QDOT_OK)
        push_text(l, rest.at, role, depth);
    qdot_text_clear(&rest);
    if (l->status == QDOT_OK)
        l->items.at[i] = l->todo.at[--l->todo.n];
    return l->status;
}

static void
count_labels(layout *l)
{
    for (; l->labels < l->items.n && get_box(l, l->items.at[l->labels].box)->label; l->labels++)
        if (item_role(l, l->labels) == QDOT_BOX_WORD && is_end_of_label(l, l->labels))
            l->name = l->labels + 1;
}

/* Count the relations in `x = 0, y = 1, stable when a > 0`: a line break is preferred between them. */
static void
count_relations(layout *l)
{
    size_t relations = 0, words = 0;

    for (size_t i = 0; i < l->items.n; i++) {
        relations += l->items.at[i].depth == 0 && item_role(l, i) == QDOT_BOX_RELATION;
        words += item_role(l, i) == QDOT_BOX_WORD;
    }
    l->several = relations > 1 && words > 1;
}

/* --- lines that have no place to be broken at ---------------------------------------------------- */

/* Replace item i of the formula by the boxes that are on the stack. */
static qdot_status
replace_item(layout *l, size_t i)
{
    const size_t n = l->todo.n;

    QDOT_TRY(l->status);
    for (size_t k = 1; k < n; k++)
        QDOT_TRY(qdot_vec_push(&l->items, l->items.at[i]));
    memmove(l->items.at + i + n, l->items.at + i + 1, (l->items.n - i - n) * sizeof *l->items.at);
    for (size_t k = 0; k < n; k++)
        l->items.at[i + k] = l->todo.at[n - 1 - k];
    l->labels += i < l->labels ? n - 1 : 0;
    l->todo.n = 0;
    return QDOT_OK;
}

/* Split item i, a name or a number, into two, the first of which is not wider than `room`. */
static qdot_status
split_item_at_width(layout *l, size_t i, size_t room)
{
    const item x = l->items.at[i];
    qdot_box whole = *get_box(l, x.box);
    const size_t n = qdot_wrap_cut(l->boxes.text.at + whole.first, whole.count, room);

    push_piece(l, whole, n, whole.count - n, x.depth);
    whole.role = QDOT_BOX_NAME;
    push_piece(l, whole, 0, n, x.depth);
    return replace_item(l, i);
}

/* The index of the widest among items [from, end) that consists of parts; `end` if there is none. */
static size_t
widest_divisible_item(const layout *l, size_t from, size_t end)
{
    size_t widest = end;

    for (size_t i = from; i < end; i++) {
        const qdot_box *b = get_box(l, l->items.at[i].box);

        if (b->kind != QDOT_BOX_TEXT &&
            (widest == end || b->columns > get_box(l, l->items.at[widest].box)->columns))
            widest = i;
    }
    return widest;
}

/* The line of items [from, *end) from column x on is wider than the terminal: what has parts is taken apart, and the
 * line is to be ended anew; where nothing has any it ends before the item that is too much, or within that. */
static qdot_status
make_line_narrower(layout *l, size_t from, size_t x, size_t *end)
{
    size_t i = widest_divisible_item(l, from, *end), columns;

    if (i < *end) {
        push_parts(l, *get_box(l, l->items.at[i].box), l->items.at[i].depth);
        *end = 0;
        return replace_item(l, i);
    }
    for (i = from; (columns = get_box(l, l->items.at[i].box)->columns) + x <= l->width; i++)
        x += columns;
    *end = i;
    if (i > from && (columns + l->indent <= l->width || x + least_cut > l->width))
        return QDOT_OK;
    *end = 0;
    return split_item_at_width(l, i, l->width - x);
}

/* Write items [from, end) as a line from column x on; once enough lines are drawn, only count the line. */
static qdot_status
write_line_of_items(layout *l, size_t from, size_t end, size_t x, qdot_text *out, qdot_layout_size *size)
{
    qdot_draw_colour colour = {.code = l->request->paint, .end = l->request->end};

    l->line.n = 0;
    for (size_t i = from; i < end; i++) {
        const qdot_draw_item at = {l->items.at[i].box, x};

        QDOT_TRY(qdot_vec_push(&l->line, at));
        x += get_box(l, at.box)->columns;
        if (i < l->labels)
            colour.columns = x;
    }
    if (x > size->columns)
        size->columns = x;
    if (size->lines >= l->request->shown)
        size->lines += qdot_draw_height(&l->boxes, l->line.at, l->line.n);
    else
        QDOT_TRY(qdot_draw_line(&l->boxes, l->line.at, l->line.n, &colour, out, &size->lines));
    return qdot_interrupt_check();
}

/* Whether items [from, end) from column x on are too wide; a blank at the end is not drawn. */
static bool
is_too_wide(const layout *l, size_t from, size_t end, size_t x)
{
    const qdot_box *last = get_box(l, l->items.at[end - 1].box);
    const bool blank = last->kind == QDOT_BOX_TEXT && last->count > 0 &&
                       l->boxes.text.at[last->first + last->count - 1] == ' ';

    for (size_t i = from; i < end; i++)
        x += get_box(l, l->items.at[i].box)->columns;
    return x > l->width + blank;
}

static qdot_status
write_lines(layout *l, qdot_text *out, qdot_layout_size *size)
{
    for (size_t from = 0, end; from < l->items.n; from = end) {
        size_t x = from > 0 ? l->indent : 0;

        if (from > 0)
            QDOT_TRY(trim_item_at_line_begin(l, from));
        do {
            end = choose_line_end(l, from, x);
            if (is_too_wide(l, from, end, x))
                QDOT_TRY(make_line_narrower(l, from, x, &end));
        } while (end == 0);
        QDOT_TRY(write_line_of_items(l, from, end, x, out, size));
    }
    return QDOT_OK;
}

qdot_status
qdot_layout_part(const qdot_formula *f, qdot_formula_id id, const qdot_layout_request *request, qdot_text *out,
                 qdot_layout_size *size)
{
    layout l = {.request = request,
                .width = request->width < least_room ? least_room : request->width};
    qdot_status status = qdot_boxes_build(f, id, &l.boxes);

    if (status == QDOT_OK)
        status = split_formula_into_items(&l);
    count_labels(&l);
    count_relations(&l);
    if (status == QDOT_OK)
        status = write_lines(&l, out, size);
    qdot_boxes_clear(&l.boxes);
    qdot_free(l.todo.at);
    qdot_free(l.items.at);
    qdot_free(l.line.at);
    return status;
}

qdot_status
qdot_layout(const qdot_formula *f, qdot_formula_id id, size_t width, qdot_text *out, qdot_layout_size *size)
{
    const qdot_layout_request request = {.width = width, .shown = SIZE_MAX};
    qdot_layout_size own = {0};

    return qdot_layout_part(f, id, &request, out, size ? size : &own);
}
