/* box.c -- lays out a formula as nested boxes; a box is measured when all its children are. */
#include "formula/box.h"

#include <inttypes.h>
#include <string.h>

#include "base/utf8.h"
#include "formula/walk.h"

typedef struct {
    qdot_boxes *to;
    qdot_vec(size_t)
        open; /* for each open formula node: index in `done` of its first finished box */
    qdot_vec(uint32_t) done; /* finished boxes of nodes that are still open */
    qdot_text spelled, copy; /* scratch texts */
} reader;

/* --- boxes of texts ------------------------------------------------------------------------- */

static const char *
get_box_text(const qdot_boxes *b, const qdot_box *x)
{
    return b->text.at + x->first;
}

static bool
is_text(const qdot_boxes *b, uint32_t i)
{
    return b->box.at[i].kind == QDOT_BOX_TEXT;
}

static qdot_status
append_finished_box(reader *r, qdot_box x)
{
    QDOT_TRY(qdot_vec_push(&r->to->box, x));
    return qdot_vec_push(&r->done, (uint32_t)(r->to->box.n - 1));
}

/* Make a box of the text added from byte `from` on. */
static qdot_status
make_text_box(reader *r, size_t from, qdot_box_role role)
{
    const qdot_text *t = &r->to->text;
    qdot_box x = {.kind = QDOT_BOX_TEXT, .role = (uint8_t)role, .first = (uint32_t)from};

    QDOT_TRY(qdot_text_status(t));
    if (t->n > UINT32_MAX)
        return qdot_fail(QDOT_ELIMIT, "the formula is too long to be laid out");
    x.count = (uint32_t)(t->n - from);
    x.columns = x.count > 0 ? (uint32_t)qdot_utf8_columns(t->at + from, x.count) : 0;
    return append_finished_box(r, x);
}

static qdot_status
append_text_box(reader *r, const char *text, qdot_box_role role)
{
    const size_t from = r->to->text.n;

    qdot_text_add(&r->to->text, text);
    return make_text_box(r, from, role);
}

/* Whether a term begins here, so that a + or - here is the sign of one operand, not of two. */
static bool
is_at_begin_of_term(const reader *r)
{
    const size_t first = r->open.n > 0 ? r->open.at[r->open.n - 1] : 0;
    uint8_t role;

    if (r->done.n == first)
        return true;
    role = r->to->box.at[r->done.at[r->done.n - 1]].role;
    return role == QDOT_BOX_RELATION || role == QDOT_BOX_SIGN || role == QDOT_BOX_COMMA ||
           role == QDOT_BOX_OPENING || role == QDOT_BOX_WORD;
}

/* Append words of a text as one box: a word of a relation if the text ends in a blank, otherwise a name. */
static qdot_status
append_word_box(reader *r, const char *text, size_t n)
{
    const size_t from = r->to->text.n;

    qdot_text_add_n(&r->to->text, text, n);
    QDOT_TRY(make_text_box(r, from,
                           n > 0 && text[n - 1] == ' ' ? QDOT_BOX_WORD : QDOT_BOX_NAME));
    r->to->box.at[r->done.at[r->done.n - 1]].label = 1;
    return QDOT_OK;
}

static qdot_status
append_leaf_box(reader *r, const qdot_formula *f, const qdot_formula_node *leaf)
{
    const char *const text = f->text.at + leaf->child;
    const size_t from = r->to->text.n;

    if (leaf->what == QDOT_TEXT_WORDS || leaf->what == QDOT_TEXT_LABEL)
        return append_word_box(r, text, leaf->n);
    qdot_text_add_n(&r->to->text, text, leaf->n);
    return make_text_box(r, from, QDOT_BOX_NAME);
}

static qdot_status
append_sign_box(reader *r, const qdot_formula_node *node)
{
    static const char *const written[] = {
#define QDOT_SIGN(name, plain, unicode, latex, mathml, duty) unicode,
#include "formula/sign.def"
#undef QDOT_SIGN
    };
    static const qdot_box_role roles[] = {
        [QDOT_DUTY_NONE] = QDOT_BOX_NAME,         [QDOT_DUTY_COLON] = QDOT_BOX_COMMA,
        [QDOT_DUTY_RELATION] = QDOT_BOX_RELATION, [QDOT_DUTY_TERMS] = QDOT_BOX_SIGN,
        [QDOT_DUTY_ERROR] = QDOT_BOX_SIGN,        [QDOT_DUTY_LOGIC] = QDOT_BOX_SIGN,
        [QDOT_DUTY_TIMES] = QDOT_BOX_TIMES,       [QDOT_DUTY_COMMA] = QDOT_BOX_COMMA};
    unsigned sign = node->what;

    if (sign == QDOT_SIGN_BLANK)
        return QDOT_OK;
    if (sign == QDOT_SIGN_NEGATIVE || sign == QDOT_SIGN_MINUS)
        sign = is_at_begin_of_term(r) ? QDOT_SIGN_NEGATIVE : QDOT_SIGN_MINUS;
    else if (sign == QDOT_SIGN_COMMA_BELOW)
        sign = QDOT_SIGN_COMMA;
    else if (sign == QDOT_SIGN_BESIDE)
        sign = QDOT_SIGN_TIMES;
    return append_text_box(r, written[sign],
                           sign == QDOT_SIGN_MINUS ? QDOT_BOX_SIGN
                                                : roles[qdot_formula_sign_duty(node)]);
}

/* --- what has its own character --------------------------------------------------------------- */

typedef struct {
    const char *of, *is;
} character;

static const character superscripts[] = {
    {"0", "⁰"}, {"1", "¹"}, {"2", "²"}, {"3", "³"}, {"4", "⁴"}, {"5", "⁵"},
    {"6", "⁶"}, {"7", "⁷"}, {"8", "⁸"}, {"9", "⁹"}, {"−", "⁻"}, {"n", "ⁿ"},
    {"i", "ⁱ"}, {"(", "⁽"}, {")", "⁾"}, {"′", "′"}, {"'", "′"}};
static const character subscripts[] = {
    {"0", "₀"}, {"1", "₁"}, {"2", "₂"}, {"3", "₃"}, {"4", "₄"}, {"5", "₅"}, {"6", "₆"},
    {"7", "₇"}, {"8", "₈"}, {"9", "₉"}, {"a", "ₐ"}, {"e", "ₑ"}, {"h", "ₕ"}, {"i", "ᵢ"},
    {"j", "ⱼ"}, {"k", "ₖ"}, {"l", "ₗ"}, {"m", "ₘ"}, {"n", "ₙ"}, {"o", "ₒ"}, {"p", "ₚ"},
    {"r", "ᵣ"}, {"s", "ₛ"}, {"t", "ₜ"}, {"u", "ᵤ"}, {"v", "ᵥ"}, {"x", "ₓ"}, {"β", "ᵦ"},
    {"γ", "ᵧ"}, {"ρ", "ᵨ"}, {"φ", "ᵩ"}, {"χ", "ᵪ"}};
static const character fractions[] = {
    {"1/2", "½"}, {"1/3", "⅓"}, {"2/3", "⅔"}, {"1/4", "¼"}, {"3/4", "¾"},
    {"1/5", "⅕"}, {"2/5", "⅖"}, {"3/5", "⅗"}, {"4/5", "⅘"}, {"1/6", "⅙"},
    {"5/6", "⅚"}, {"1/8", "⅛"}, {"3/8", "⅜"}, {"5/8", "⅝"}, {"7/8", "⅞"}};

#define COUNT(table) (sizeof(table) / sizeof *(table))

/* Append a text in the raised or lowered characters of a table; if one is missing, append nothing, return false. */
static bool
append_script_characters(qdot_text *to, const char *text, size_t bytes, const character *table,
                         size_t count)
{
    const size_t from = to->n;

    for (size_t i = 0, n; i < bytes; i += n) {
        size_t k = 0;

        n = qdot_utf8_length(text + i);
        while (k < count && (table[k].of[0] != text[i] || strlen(table[k].of) != n ||
                             memcmp(table[k].of, text + i, n) != 0))
            k++;
        if (n == 0 || k == count) {
            qdot_text_truncate(to, from);
            return false;
        }
        qdot_text_add(to, table[k].is);
    }
    return bytes > 0;
}

/* The texts of a box, one behind the other, if it has nothing else: appended to `copy`, which is not the
 * text of the boxes. */
static bool
append_box_texts(const qdot_boxes *b, uint32_t i, qdot_text *copy)
{
    const qdot_box *x = b->box.at + i;

    if (x->kind == QDOT_BOX_TEXT) {
        qdot_text_add_n(copy, get_box_text(b, x), x->count);
        return true;
    }
    if (x->kind != QDOT_BOX_ROW)
        return false;
    for (uint32_t k = 0; k < x->count; k++) {
        const qdot_box *y = b->box.at + b->children.at[x->first + k];

        if (y->kind != QDOT_BOX_TEXT)
            return false;
        qdot_text_add_n(copy, get_box_text(b, y), y->count);
    }
    return true;
}

/* --- sizes of boxes --------------------------------------------------------------------------- */

static void
enlarge_row_by_box(qdot_box *row, const qdot_box *x)
{
    row->columns += x->columns;
    if (x->above > row->above)
        row->above = x->above;
    if (x->below > row->below)
        row->below = x->below;
}

/* Find the column widths and row heights of a table. */
static qdot_status
measure_table(qdot_boxes *b, qdot_box *table)
{
    const uint32_t rows = table->count / table->across;
    uint32_t height = 0;

    for (uint32_t c = 0; c < table->across; c++) {
        uint32_t widest = 0;

        for (uint32_t r = 0; r < rows; r++) {
            const qdot_box *x =
                b->box.at + b->children.at[table->first + r * table->across + c];

            widest = x->columns > widest ? x->columns : widest;
        }
        table->columns += widest + (c > 0 ? QDOT_BOX_GAP : 0);
    }
    for (uint32_t r = 0; r < rows; r++) {
        qdot_box row = {0};

        for (uint32_t c = 0; c < table->across; c++)
            enlarge_row_by_box(&row,
                               b->box.at + b->children.at[table->first + r * table->across + c]);
        height += qdot_box_height(&row) + (r > 0 && row.above > 0);
    }
    table->above = (height - 1) / 2;
    table->below = height - 1 - table->above;
    return QDOT_OK;
}

/* Make brackets as high as their contents. */
static void
stretch_brackets(qdot_boxes *b, const qdot_box *row)
{
    const uint32_t *child = b->children.at + row->first;

    for (uint32_t k = 0; k < row->count; k++) {
        qdot_box *x = b->box.at + child[k];

        if (x->kind != QDOT_BOX_TEXT ||
            (x->role != QDOT_BOX_OPENING && x->role != QDOT_BOX_CLOSING))
            continue;
        x->above = row->above;
        x->below = row->below;
    }
}

static qdot_status
finish_row(reader *r, qdot_box x)
{
    qdot_boxes *b = r->to;

    if (x.count == 1)
        return qdot_vec_push(&r->done, b->children.at[x.first]);
    for (uint32_t k = 0; k < x.count; k++)
        enlarge_row_by_box(&x, b->box.at + b->children.at[x.first + k]);
    stretch_brackets(b, &x);
    return append_finished_box(r, x);
}

/* Finish a fraction; as ½ if there is such a character. */
static qdot_status
finish_fraction(reader *r, qdot_box x)
{
    qdot_boxes *b = r->to;
    const uint32_t *of = b->children.at + x.first;
    const qdot_box *up, *down;

    if (is_text(b, of[0]) && is_text(b, of[1])) {
        const size_t from = b->text.n;

        qdot_text_truncate(&r->spelled, 0);
        append_box_texts(b, of[0], &r->spelled);
        qdot_text_char(&r->spelled, '/');
        append_box_texts(b, of[1], &r->spelled);
        for (size_t k = 0; k < COUNT(fractions) && !r->spelled.failed; k++)
            if (strcmp(qdot_text_str(&r->spelled), fractions[k].of) == 0)
                qdot_text_add(&b->text, fractions[k].is);
        if (b->text.n > from)
            return make_text_box(r, from, QDOT_BOX_NAME);
    }
    up = b->box.at + of[0];
    down = b->box.at + of[1];
    x.columns = up->columns > down->columns ? up->columns : down->columns;
    x.above = qdot_box_height(up);
    x.below = qdot_box_height(down);
    return append_finished_box(r, x);
}

/* Write a super- or subscript as characters such as ², next to its base; *own: such characters exist. */
static qdot_status
append_script(reader *r, const qdot_box *x, bool super, bool *own)
{
    qdot_boxes *b = r->to;
    const uint32_t base = b->children.at[x->first], script = b->children.at[x->first + 1];
    const size_t from = b->text.n;
    qdot_box row = {.kind = QDOT_BOX_ROW};

    qdot_text_truncate(&r->spelled, 0);
    qdot_text_truncate(&r->copy, 0);
    *own = b->box.at[base].above + b->box.at[base].below == 0 &&
           append_box_texts(b, script, &r->spelled);
    if (*own && is_text(b, base)) {
        append_box_texts(b, base, &r->copy);
        qdot_text_add_n(&b->text, qdot_text_str(&r->copy), r->copy.n);
    }
    *own = *own && append_script_characters(&b->text, qdot_text_str(&r->spelled), r->spelled.n,
                                            super ? superscripts : subscripts,
                                            super ? COUNT(superscripts) : COUNT(subscripts));
    b->text.failed = b->text.failed || r->spelled.failed || r->copy.failed;
    if (!*own) {
        qdot_text_truncate(&b->text, from);
        return QDOT_OK;
    }
    QDOT_TRY(make_text_box(r, from, QDOT_BOX_NAME));
    if (is_text(b, base))
        return QDOT_OK;
    row.first = (uint32_t)b->children.n;
    row.count = 2;
    QDOT_TRY(qdot_vec_push(&b->children, base));
    QDOT_TRY(qdot_vec_push(&b->children, r->done.at[--r->done.n]));
    return finish_row(r, row);
}

/* Set a super- or subscript as a raised or lowered box next to its base. */
static qdot_status
finish_script_beside_base(reader *r, qdot_box x)
{
    const qdot_boxes *b = r->to;
    const bool super = x.kind == QDOT_BOX_SUPER;
    const qdot_box *base = b->box.at + b->children.at[x.first],
                   *script = b->box.at + b->children.at[x.first + 1];

    x.columns = base->columns + (script->columns > x.across ? script->columns - x.across : 0);
    x.above =
        super ? base->above + qdot_box_height(script) - (base->above > 0) : base->above;
    x.below = super ? base->below : base->below + qdot_box_height(script);
    return append_finished_box(r, x);
}

/* Write a symbol with index and exponent, as p_θ², with ² above the θ, if such a character exists (*own). */
static qdot_status
append_above_index(reader *r, const qdot_box *x, bool *own)
{
    qdot_boxes *b = r->to;
    const qdot_box base = b->box.at[b->children.at[x->first]];
    const uint32_t power = b->children.at[x->first + 1];
    qdot_box upper = {.kind = QDOT_BOX_SUPER, .count = 2, .first = (uint32_t)b->children.n};
    qdot_box lower = {.kind = QDOT_BOX_SUB, .count = 2};
    uint32_t letter, index, whole;

    *own = false;
    if (base.kind != QDOT_BOX_SUB)
        return QDOT_OK;
    letter = b->children.at[base.first];
    index = b->children.at[base.first + 1];
    QDOT_TRY(qdot_vec_push(&b->children, letter));
    QDOT_TRY(qdot_vec_push(&b->children, power));
    QDOT_TRY(append_script(r, &upper, true, own));
    if (!*own)
        return QDOT_OK;
    whole = r->done.at[--r->done.n];
    lower.first = (uint32_t)b->children.n;
    lower.across = b->box.at[whole].columns - b->box.at[letter].columns;
    QDOT_TRY(qdot_vec_push(&b->children, whole));
    QDOT_TRY(qdot_vec_push(&b->children, index));
    return finish_script_beside_base(r, lower);
}

static qdot_status
finish_script(reader *r, qdot_box x)
{
    bool own;

    QDOT_TRY(append_script(r, &x, x.kind == QDOT_BOX_SUPER, &own));
    if (!own && x.kind == QDOT_BOX_SUPER)
        QDOT_TRY(append_above_index(r, &x, &own));
    return own ? QDOT_OK : finish_script_beside_base(r, x);
}

/* Finish a symbol with upper indices, then lower ones. */
static qdot_status
finish_tensor(reader *r, qdot_box x)
{
    qdot_boxes *b = r->to;
    const uint32_t below = b->children.at[x.first + 2];
    qdot_box lower = {.kind = QDOT_BOX_SUB, .count = 2};

    x.kind = QDOT_BOX_SUPER;
    x.count = 2;
    QDOT_TRY(finish_script(r, x));
    lower.first = (uint32_t)b->children.n;
    QDOT_TRY(qdot_vec_push(&b->children, r->done.at[--r->done.n]));
    QDOT_TRY(qdot_vec_push(&b->children, below));
    return finish_script(r, lower);
}

/* Put dots over the first letter: θ with one dot is θ̇; a drawn box gets none. */
static qdot_status
finish_accent(reader *r, const qdot_box *x, uint32_t dots)
{
    static const char *const marks[] = {"", "\u0307", "\u0308", "\u20DB"};
    qdot_boxes *b = r->to;
    const uint32_t base = b->children.at[x->first];
    const size_t from = b->text.n;
    const qdot_text *copy = &r->copy;
    size_t letter;

    if (!is_text(b, base) || b->box.at[base].count == 0)
        return qdot_vec_push(&r->done, base);
    qdot_text_truncate(&r->copy, 0);
    append_box_texts(b, base, &r->copy);
    letter = qdot_utf8_length(qdot_text_str(copy));
    qdot_text_add_n(&b->text, qdot_text_str(copy), letter);
    qdot_text_add(&b->text, marks[dots]);
    qdot_text_add_n(&b->text, qdot_text_str(copy) + letter, copy->n - letter);
    b->text.failed = b->text.failed || copy->failed;
    return make_text_box(r, from, QDOT_BOX_NAME);
}

static qdot_status
finish_root(reader *r, qdot_box x)
{
    const qdot_box *under = r->to->box.at + r->to->children.at[x.first];

    x.columns = under->columns + qdot_box_root_sign(under);
    x.above = under->above + 1;
    x.below = under->below;
    return append_finished_box(r, x);
}

/* --- nodes of the formula as boxes ------------------------------------------------------------ */

/* Close the innermost open formula node; the boxes finished since it was opened become the children of box x. */
static qdot_status
close_node(reader *r, qdot_box *x)
{
    qdot_boxes *b = r->to;
    const size_t from = r->open.n > 0 ? r->open.at[--r->open.n] : 0;

    x->first = (uint32_t)b->children.n;
    x->count = (uint32_t)(r->done.n - from);
    for (size_t k = from; k < r->done.n; k++)
        QDOT_TRY(qdot_vec_push(&b->children, r->done.at[k]));
    r->done.n = from;
    return QDOT_OK;
}

/* Close the innermost formula node as one row; a row of a single box is replaced by that box. */
static qdot_status
close_row(reader *r)
{
    qdot_box row = {.kind = QDOT_BOX_ROW};

    QDOT_TRY(close_node(r, &row));
    return finish_row(r, row);
}

static qdot_status
open_node(reader *r)
{
    return qdot_vec_push(&r->open, r->done.n);
}

/* Whether each child of a formula node becomes a box of its own. */
static bool
has_box_per_child(const qdot_formula_node *node)
{
    switch (node->kind) {
    case QDOT_FORMULA_FRACTION:
    case QDOT_FORMULA_POWER:
    case QDOT_FORMULA_INDEX:
    case QDOT_FORMULA_TENSOR:
    case QDOT_FORMULA_TABLE:
    case QDOT_FORMULA_CASES: return true;
    default: return false;
    }
}

/* Whether all children of a formula node form one box, which the node decorates, with a root sign or dots. */
static bool
decorates_one_box(const qdot_formula_node *node)
{
    return node->kind == QDOT_FORMULA_ROOT || node->kind == QDOT_FORMULA_ACCENT ||
           node->kind == QDOT_FORMULA_PRIMES;
}

/* Whether the boxes of a formula node become part of the row that contains the node. */
static bool
joins_outer_row(const qdot_formula_node *node)
{
    return node->kind == QDOT_FORMULA_APPLY ||
           (node->kind == QDOT_FORMULA_SPAN && !(node->flags & QDOT_FORMULA_LABEL));
}

static qdot_status
box_enter(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    static const char *const opening[] = {"(", "[", "|", "⌊"};
    reader *r = walk->user;

    if (node->kind == QDOT_FORMULA_TEXT)
        return append_leaf_box(r, walk->formula, node);
    if (node->kind == QDOT_FORMULA_SIGN)
        return append_sign_box(r, node);
    if (joins_outer_row(node))
        return QDOT_OK;
    QDOT_TRY(open_node(r));
    if (node->kind == QDOT_FORMULA_BRACKET)
        return append_text_box(r, opening[node->what], QDOT_BOX_OPENING);
    if (node->kind == QDOT_FORMULA_TABLE || node->kind == QDOT_FORMULA_CASES) {
        QDOT_TRY(append_text_box(r, node->kind == QDOT_FORMULA_CASES ? "{" : "[",
                                 QDOT_BOX_OPENING));
        QDOT_TRY(open_node(r));
    }
    return has_box_per_child(node) || decorates_one_box(node) ? open_node(r) : QDOT_OK;
}

static qdot_status
box_between(qdot_formula_walk *walk, const qdot_formula_node *node, uint32_t k)
{
    reader *r = walk->user;

    if (!has_box_per_child(node))
        return QDOT_OK;
    QDOT_TRY(close_row(r));
    QDOT_TRY(open_node(r));
    return node->kind == QDOT_FORMULA_CASES && k % 2 == 1 ? append_word_box(r, "if ", 3)
                                                          : QDOT_OK;
}

/* Finish a table with its brackets. */
static qdot_status
finish_table_node(reader *r, const qdot_formula_node *node)
{
    qdot_box table = {.kind = QDOT_BOX_TABLE,
                      .across = node->kind == QDOT_FORMULA_CASES ? 2 : node->n};

    if (node->kind == QDOT_FORMULA_CASES)
        QDOT_TRY(append_word_box(r, "otherwise", 9));
    QDOT_TRY(close_node(r, &table));
    QDOT_TRY(measure_table(r->to, &table));
    QDOT_TRY(append_finished_box(r, table));
    if (node->kind != QDOT_FORMULA_CASES)
        QDOT_TRY(append_text_box(r, "]", QDOT_BOX_CLOSING));
    return close_row(r);
}

/* Append primes, or the order of a derivative in brackets. */
static qdot_status
append_derivative_order(reader *r, uint32_t n)
{
    const size_t from = r->to->text.n;

    for (uint32_t k = 0; k < n && n <= 3; k++)
        qdot_text_add(&r->to->text, "′");
    if (n > 3)
        qdot_text_format(&r->to->text, "(%" PRIu32 ")", n);
    return make_text_box(r, from, QDOT_BOX_NAME);
}

/* Finish a formula node that decorates boxes or contains whole boxes. */
static qdot_status
finish_structure_node(reader *r, const qdot_formula_node *node)
{
    const bool ordered = node->kind == QDOT_FORMULA_PRIMES ||
                         (node->kind == QDOT_FORMULA_ACCENT && node->n > 3);
    qdot_box x = {.kind = node->kind == QDOT_FORMULA_FRACTION ? QDOT_BOX_FRACTION
                          : node->kind == QDOT_FORMULA_ROOT   ? QDOT_BOX_ROOT
                          : node->kind == QDOT_FORMULA_INDEX  ? QDOT_BOX_SUB
                                                              : QDOT_BOX_SUPER};

    if (ordered)
        QDOT_TRY(append_derivative_order(r, node->n));
    QDOT_TRY(close_node(r, &x));
    switch (node->kind) {
    case QDOT_FORMULA_FRACTION: return finish_fraction(r, x);
    case QDOT_FORMULA_ROOT: return finish_root(r, x);
    case QDOT_FORMULA_TENSOR: return finish_tensor(r, x);
    case QDOT_FORMULA_ACCENT:
        return ordered ? finish_script(r, x) : finish_accent(r, &x, node->n);
    default: return finish_script(r, x);
    }
}

static qdot_status
box_leave(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    static const char *const closing[] = {")", "]", "|", "⌋"};
    reader *r = walk->user;

    if (joins_outer_row(node))
        return QDOT_OK;
    if (has_box_per_child(node) || decorates_one_box(node)) {
        QDOT_TRY(close_row(r));
        return node->kind == QDOT_FORMULA_TABLE || node->kind == QDOT_FORMULA_CASES
                   ? finish_table_node(r, node)
                   : finish_structure_node(r, node);
    }
    if (node->kind == QDOT_FORMULA_BRACKET)
        QDOT_TRY(append_text_box(r, closing[node->what], QDOT_BOX_CLOSING));
    QDOT_TRY(close_row(r));
    if (node->flags & QDOT_FORMULA_LABEL)
        r->to->box.at[r->done.at[r->done.n - 1]].label = 1;
    return QDOT_OK;
}

/* Finish the formula as one row, even if it has one box. */
static qdot_status
finish_formula(reader *r)
{
    qdot_box x = {.kind = QDOT_BOX_ROW};

    QDOT_TRY(close_node(r, &x));
    for (uint32_t k = 0; k < x.count; k++)
        enlarge_row_by_box(&x, r->to->box.at + r->to->children.at[x.first + k]);
    return append_finished_box(r, x);
}

qdot_status
qdot_boxes_build(const qdot_formula *f, qdot_formula_id id, qdot_boxes *boxes)
{
    reader r = {.to = boxes};
    qdot_formula_walk walk = {.formula = f,
                              .user = &r,
                              .enter = box_enter,
                              .between = box_between,
                              .leave = box_leave};
    qdot_status status;

    *boxes = (qdot_boxes){0};
    status = qdot_formula_pass(&walk, id);
    if (status == QDOT_OK)
        status = finish_formula(&r);
    qdot_free(r.open.at);
    qdot_free(r.done.at);
    qdot_text_clear(&r.spelled);
    qdot_text_clear(&r.copy);
    return status;
}

void
qdot_boxes_clear(qdot_boxes *b)
{
    qdot_free(b->box.at);
    qdot_free(b->children.at);
    qdot_text_clear(&b->text);
    *b = (qdot_boxes){0};
}
