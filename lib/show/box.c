/* box.c -- MathML to boxes: tags by a stack, sizes when a tag ends. */
#include "show/box.h"

#include <string.h>

#include "base/interrupt.h"
#include "base/utf8.h"

typedef enum {
    MI, MN, MO, MTEXT, MROW, MFRAC, MSQRT, MSUP, MSUB, MOVER, MTABLE, MTR, MTD, TAGS
} tag;

static const struct {
    const char *name;
    size_t length;
} tags[TAGS] = {{"mi", 2},    {"mn", 2},   {"mo", 2},   {"mtext", 5}, {"mrow", 4},
                {"mfrac", 5}, {"msqrt", 5}, {"msup", 4}, {"msub", 4},  {"mover", 5},
                {"mtable", 6}, {"mtr", 3},  {"mtd", 3}};

typedef struct {
    tag tag;
    size_t children; /* where its own begin on the stack of finished boxes */
    uint32_t across; /* cells of the rows of a table */
    bool label;      /* <mrow class="name"> */
} element;

typedef struct {
    qdot_boxes *to;
    qdot_vec(element) open;
    qdot_vec(uint32_t) done; /* finished, of elements that are open */
    qdot_text spelled, copy; /* work space */
} reader;

static qdot_status
malformed(void)
{
    return qdot_fail(QDOT_EINVAL, "no formula that can be laid out");
}

/* --- texts ---------------------------------------------------------------------------------- */

static const char *
text_of(const qdot_boxes *b, const qdot_box *x)
{
    return b->text.at + x->first;
}

static bool
is_text(const qdot_boxes *b, uint32_t i)
{
    return b->box.at[i].kind == QDOT_BOX_TEXT;
}

static bool
says(const qdot_boxes *b, uint32_t i, const char *text)
{
    const qdot_box *x = b->box.at + i;

    return is_text(b, i) && x->count == strlen(text) && memcmp(text_of(b, x), text, x->count) == 0;
}

static qdot_status
box_finish(reader *r, qdot_box x)
{
    QDOT_TRY(qdot_vec_push(&r->to->box, x));
    return qdot_vec_push(&r->done, (uint32_t)(r->to->box.n - 1));
}

/* What has been added to the text from `from` on. */
static qdot_status
finish_text(reader *r, size_t from, qdot_box_role role)
{
    const qdot_text *t = &r->to->text;
    qdot_box x = {.kind = QDOT_BOX_TEXT, .role = (uint8_t)role, .first = (uint32_t)from};

    QDOT_TRY(qdot_text_status(t));
    if (t->n > UINT32_MAX)
        return qdot_fail(QDOT_ELIMIT, "the formula is too long to be laid out");
    x.count = (uint32_t)(t->n - from);
    x.columns = x.count > 0 ? (uint32_t)qdot_utf8_columns(t->at + from, x.count) : 0;
    return box_finish(r, x);
}

/* The characters up to the next tag, entities decoded. */
static const char *
add_characters(qdot_text *to, const char *at)
{
    static const struct {
        const char *name, *text;
    } known[] = {{"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}, {"&#x2061;", ""},
                 {"&#x2062;", "\u202F"}, {"&#xA0;", " "}};

    while (*at != '\0' && *at != '<') {
        const char *end = at;
        size_t i = 0;

        while (*end != '\0' && *end != '<' && (end == at || *end != '&'))
            end++;
        while (*at == '&' && i < sizeof known / sizeof *known &&
               strncmp(at, known[i].name, strlen(known[i].name)) != 0)
            i++;
        if (*at == '&' && i < sizeof known / sizeof *known) {
            qdot_text_add(to, known[i].text);
            at += strlen(known[i].name);
        } else {
            qdot_text_add_n(to, at, (size_t)(end - at));
            at = end;
        }
    }
    return at;
}

/* How an operator is written beside others, and its role. */
static const struct {
    const char *sign, *written;
    qdot_box_role role;
} operators[] = {
    {"=", " = ", QDOT_BOX_RELATION}, {"<", " < ", QDOT_BOX_RELATION},
    {">", " > ", QDOT_BOX_RELATION}, {"≤", " ≤ ", QDOT_BOX_RELATION},
    {"≥", " ≥ ", QDOT_BOX_RELATION}, {":", ": ", QDOT_BOX_COMMA},
    {"+", " + ", QDOT_BOX_SIGN},     {"−", " − ", QDOT_BOX_SIGN},
    {"±", " ± ", QDOT_BOX_SIGN},     {"∧", " and ", QDOT_BOX_SIGN},
    {"∨", " or ", QDOT_BOX_SIGN},    {"¬", "not ", QDOT_BOX_NAME},
    {"\u202F", "\u202F", QDOT_BOX_TIMES}, {"⋅", "·", QDOT_BOX_TIMES},
    {",", ", ", QDOT_BOX_COMMA},     {"(", "(", QDOT_BOX_OPENING},
    {"[", "[", QDOT_BOX_OPENING},    {"{", "{", QDOT_BOX_OPENING},
    {"⌊", "⌊", QDOT_BOX_OPENING},    {")", ")", QDOT_BOX_CLOSING},
    {"]", "]", QDOT_BOX_CLOSING},    {"⌋", "⌋", QDOT_BOX_CLOSING},
};

/* Whether an operator stands where a term begins: a sign there is no sign of two. */
static bool
term_begins(const reader *r)
{
    const size_t first = r->open.n > 1 ? r->open.at[r->open.n - 2].children : 0;
    uint8_t role;

    if (r->done.n == first)
        return true;
    role = r->to->box.at[r->done.at[r->done.n - 1]].role;
    return role == QDOT_BOX_RELATION || role == QDOT_BOX_SIGN || role == QDOT_BOX_COMMA ||
           role == QDOT_BOX_OPENING || role == QDOT_BOX_WORD;
}

/* A word of a text is one by the blank behind it. */
static qdot_status
finish_words(reader *r, size_t from)
{
    const qdot_text *t = &r->to->text;

    QDOT_TRY(finish_text(
        r, from, t->n > from && t->at[t->n - 1] == ' ' ? QDOT_BOX_WORD : QDOT_BOX_NAME));
    r->to->box.at[r->done.at[r->done.n - 1]].label = 1;
    return QDOT_OK;
}

static qdot_status
finish_operator(reader *r, size_t from)
{
    qdot_text *t = &r->to->text;

    QDOT_TRY(qdot_text_status(t));
    for (size_t i = 0; i < sizeof operators / sizeof *operators; i++) {
        const char *sign = operators[i].sign;

        if (t->n == from || *sign != t->at[from] || strcmp(t->at + from, sign) != 0)
            continue;
        if (operators[i].role == QDOT_BOX_SIGN && term_begins(r))
            return finish_text(r, from, QDOT_BOX_NAME);
        qdot_text_truncate(t, from);
        qdot_text_add(t, operators[i].written);
        return finish_text(r, from, operators[i].role);
    }
    if (strcmp(t->n > from ? t->at + from : "", "|") == 0)
        return finish_text(r, from, term_begins(r) ? QDOT_BOX_OPENING : QDOT_BOX_CLOSING);
    return finish_text(r, from, QDOT_BOX_NAME);
}

/* --- what has its own character --------------------------------------------------------------- */

typedef struct {
    const char *of, *is;
} character;

static const character superscripts[] = {
    {"0", "⁰"}, {"1", "¹"}, {"2", "²"}, {"3", "³"}, {"4", "⁴"}, {"5", "⁵"}, {"6", "⁶"},
    {"7", "⁷"}, {"8", "⁸"}, {"9", "⁹"}, {"−", "⁻"}, {"n", "ⁿ"}, {"i", "ⁱ"}, {"(", "⁽"},
    {")", "⁾"}, {"′", "′"}, {"'", "′"}};
static const character subscripts[] = {
    {"0", "₀"}, {"1", "₁"}, {"2", "₂"}, {"3", "₃"}, {"4", "₄"}, {"5", "₅"}, {"6", "₆"}, {"7", "₇"},
    {"8", "₈"}, {"9", "₉"}, {"a", "ₐ"}, {"e", "ₑ"}, {"h", "ₕ"}, {"i", "ᵢ"}, {"j", "ⱼ"}, {"k", "ₖ"},
    {"l", "ₗ"}, {"m", "ₘ"}, {"n", "ₙ"}, {"o", "ₒ"}, {"p", "ₚ"}, {"r", "ᵣ"}, {"s", "ₛ"}, {"t", "ₜ"},
    {"u", "ᵤ"}, {"v", "ᵥ"}, {"x", "ₓ"}, {"β", "ᵦ"}, {"γ", "ᵧ"}, {"ρ", "ᵨ"}, {"φ", "ᵩ"}, {"χ", "ᵪ"}};
static const character fractions[] = {
    {"1/2", "½"}, {"1/3", "⅓"}, {"2/3", "⅔"}, {"1/4", "¼"}, {"3/4", "¾"}, {"1/5", "⅕"},
    {"2/5", "⅖"}, {"3/5", "⅗"}, {"4/5", "⅘"}, {"1/6", "⅙"}, {"5/6", "⅚"}, {"1/8", "⅛"},
    {"3/8", "⅜"}, {"5/8", "⅝"}, {"7/8", "⅞"}};

#define COUNT(table) (sizeof(table) / sizeof *(table))

/* Append the text by characters of a table; false, and nothing appended, where one has none. */
static bool
translate(qdot_text *to, const char *text, size_t bytes, const character *table, size_t count)
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
spell(const qdot_boxes *b, uint32_t i, qdot_text *copy)
{
    const qdot_box *x = b->box.at + i;

    if (x->kind == QDOT_BOX_TEXT) {
        qdot_text_add_n(copy, text_of(b, x), x->count);
        return true;
    }
    if (x->kind != QDOT_BOX_ROW)
        return false;
    for (uint32_t k = 0; k < x->count; k++) {
        const qdot_box *y = b->box.at + b->children.at[x->first + k];

        if (y->kind != QDOT_BOX_TEXT)
            return false;
        qdot_text_add_n(copy, text_of(b, y), y->count);
    }
    return true;
}

/* --- elements --------------------------------------------------------------------------------- */

static void
beside(qdot_box *row, const qdot_box *x)
{
    row->columns += x->columns;
    if (x->above > row->above)
        row->above = x->above;
    if (x->below > row->below)
        row->below = x->below;
}

/* Widths of the columns of a table, and what its rows take. */
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
            beside(&row, b->box.at + b->children.at[table->first + r * table->across + c]);
        height += qdot_box_height(&row) + (r > 0 && row.above > 0);
    }
    table->above = (height - 1) / 2;
    table->below = height - 1 - table->above;
    return QDOT_OK;
}

/* Brackets are as high as what they hold; around a table they are square. */
static void
stretch(qdot_boxes *b, const qdot_box *row)
{
    const uint32_t *child = b->children.at + row->first;
    bool table = false;

    for (uint32_t k = 0; k < row->count; k++)
        table = table || b->box.at[child[k]].kind == QDOT_BOX_TABLE;
    for (uint32_t k = 0; k < row->count; k++) {
        qdot_box *x = b->box.at + child[k];

        if (x->kind != QDOT_BOX_TEXT || (x->role != QDOT_BOX_OPENING && x->role != QDOT_BOX_CLOSING))
            continue;
        x->above = row->above;
        x->below = row->below;
        if (table && b->text.at[x->first] == '(')
            b->text.at[x->first] = '[';
        if (table && b->text.at[x->first] == ')')
            b->text.at[x->first] = ']';
    }
}

static qdot_status
finish_row(reader *r, qdot_box x)
{
    qdot_boxes *b = r->to;

    if (x.count == 1)
        return qdot_vec_push(&r->done, b->children.at[x.first]);
    for (uint32_t k = 0; k < x.count; k++)
        beside(&x, b->box.at + b->children.at[x.first + k]);
    stretch(b, &x);
    return box_finish(r, x);
}

/* ½ where there is such a character. */
static qdot_status
finish_fraction(reader *r, qdot_box x)
{
    qdot_boxes *b = r->to;
    const uint32_t *of = b->children.at + x.first;
    const qdot_box *up, *down;

    if (is_text(b, of[0]) && is_text(b, of[1])) {
        const size_t from = b->text.n;

        qdot_text_truncate(&r->spelled, 0);
        spell(b, of[0], &r->spelled);
        qdot_text_char(&r->spelled, '/');
        spell(b, of[1], &r->spelled);
        for (size_t k = 0; k < COUNT(fractions) && !r->spelled.failed; k++)
            if (strcmp(qdot_text_str(&r->spelled), fractions[k].of) == 0)
                qdot_text_add(&b->text, fractions[k].is);
        if (b->text.n > from)
            return finish_text(r, from, QDOT_BOX_NAME);
    }
    up = b->box.at + of[0];
    down = b->box.at + of[1];
    x.columns = up->columns > down->columns ? up->columns : down->columns;
    x.above = qdot_box_height(up);
    x.below = qdot_box_height(down);
    return box_finish(r, x);
}

/* The script by characters of its own, in the row of its base; *own: it has them. */
static qdot_status
append_script(reader *r, const qdot_box *x, bool super, bool *own)
{
    qdot_boxes *b = r->to;
    const uint32_t base = b->children.at[x->first], script = b->children.at[x->first + 1];
    const size_t from = b->text.n;
    qdot_box row = {.kind = QDOT_BOX_ROW};

    qdot_text_truncate(&r->spelled, 0);
    qdot_text_truncate(&r->copy, 0);
    *own = b->box.at[base].above + b->box.at[base].below == 0 && spell(b, script, &r->spelled);
    if (*own && is_text(b, base)) {
        spell(b, base, &r->copy);
        qdot_text_add_n(&b->text, qdot_text_str(&r->copy), r->copy.n);
    }
    *own = *own && translate(&b->text, qdot_text_str(&r->spelled), r->spelled.n,
                             super ? superscripts : subscripts,
                             super ? COUNT(superscripts) : COUNT(subscripts));
    b->text.failed = b->text.failed || r->spelled.failed || r->copy.failed;
    if (!*own) {
        qdot_text_truncate(&b->text, from);
        return QDOT_OK;
    }
    QDOT_TRY(finish_text(r, from, QDOT_BOX_NAME));
    if (is_text(b, base))
        return QDOT_OK;
    row.first = (uint32_t)b->children.n;
    row.count = 2;
    QDOT_TRY(qdot_vec_push(&b->children, base));
    QDOT_TRY(qdot_vec_push(&b->children, r->done.at[--r->done.n]));
    return finish_row(r, row);
}

static qdot_status
finish_script(reader *r, qdot_box x)
{
    qdot_boxes *b = r->to;
    const bool super = x.kind == QDOT_BOX_SUPER;
    const qdot_box *base, *script;
    bool own;

    QDOT_TRY(append_script(r, &x, super, &own));
    if (own)
        return QDOT_OK;
    base = b->box.at + b->children.at[x.first];
    script = b->box.at + b->children.at[x.first + 1];
    x.columns = base->columns + script->columns;
    x.above = super ? base->above + qdot_box_height(script) - (base->above > 0) : base->above;
    x.below = super ? base->below : base->below + qdot_box_height(script);
    return box_finish(r, x);
}

/* A mark over the first letter: θ and ˙ become θ̇. */
static qdot_status
finish_marked(reader *r, const qdot_box *x)
{
    static const character marks[] = {{"˙", "\u0307"}, {"¨", "\u0308"}, {"⃛", "\u20DB"}};
    qdot_boxes *b = r->to;
    const uint32_t *of = b->children.at + x->first;
    const size_t from = b->text.n;
    const qdot_box *base = b->box.at + of[0];
    const qdot_text *copy = &r->copy;
    size_t letter;

    if (!is_text(b, of[0]) || base->count == 0)
        return malformed();
    qdot_text_truncate(&r->copy, 0);
    spell(b, of[0], &r->copy);
    letter = qdot_utf8_length(qdot_text_str(copy));
    qdot_text_add_n(&b->text, qdot_text_str(copy), letter);
    for (size_t k = 0; k < COUNT(marks); k++)
        if (says(b, of[1], marks[k].of))
            qdot_text_add(&b->text, marks[k].is);
    qdot_text_add_n(&b->text, qdot_text_str(copy) + letter, copy->n - letter);
    b->text.failed = b->text.failed || copy->failed;
    return finish_text(r, from, QDOT_BOX_NAME);
}

static qdot_status
finish_root(reader *r, qdot_box x)
{
    const qdot_box *under = r->to->box.at + r->to->children.at[x.first];

    x.columns = under->columns + qdot_box_root_sign(under);
    x.above = under->above + 1;
    x.below = under->below;
    return box_finish(r, x);
}

/* The finished boxes of an element become its children: one row, where it wants one. */
static qdot_status
take_children(reader *r, const element *e, bool one, qdot_box *x)
{
    qdot_boxes *b = r->to;
    const size_t count = r->done.n - e->children;

    if (one && count != 1) {
        qdot_box row = {.kind = QDOT_BOX_ROW};

        QDOT_TRY(take_children(r, e, false, &row));
        QDOT_TRY(finish_row(r, row));
        return take_children(r, e, true, x);
    }
    x->first = (uint32_t)b->children.n;
    x->count = (uint32_t)count;
    for (size_t k = 0; k < count; k++)
        QDOT_TRY(qdot_vec_push(&b->children, r->done.at[e->children + k]));
    r->done.n = e->children;
    return QDOT_OK;
}

static qdot_status
end_element(reader *r)
{
    const element e = r->open.at[--r->open.n];
    element *outer = r->open.n > 0 ? r->open.at + r->open.n - 1 : NULL;
    const size_t count = r->done.n - e.children;
    qdot_box x = {0};

    switch (e.tag) {
    case MROW:
    case MTD:
        QDOT_TRY(take_children(r, &e, false, &x));
        x.kind = QDOT_BOX_ROW;
        QDOT_TRY(finish_row(r, x));
        if (e.label)
            r->to->box.at[r->done.at[r->done.n - 1]].label = 1;
        return QDOT_OK;
    case MSQRT:
        QDOT_TRY(take_children(r, &e, true, &x));
        x.kind = QDOT_BOX_ROOT;
        return finish_root(r, x);
    case MTR: /* its cells stay for the table */
        if (!outer || outer->tag != MTABLE || count == 0 ||
            (outer->across > 0 && outer->across != count))
            return malformed();
        outer->across = (uint32_t)count;
        return QDOT_OK;
    case MTABLE:
        if (count == 0)
            return malformed();
        QDOT_TRY(take_children(r, &e, false, &x));
        x.kind = QDOT_BOX_TABLE;
        x.across = e.across;
        QDOT_TRY(measure_table(r->to, &x));
        return box_finish(r, x);
    default: break;
    }
    if (count != 2)
        return malformed();
    QDOT_TRY(take_children(r, &e, false, &x));
    x.kind = e.tag == MFRAC ? QDOT_BOX_FRACTION : e.tag == MSUB ? QDOT_BOX_SUB : QDOT_BOX_SUPER;
    return e.tag == MFRAC   ? finish_fraction(r, x)
           : e.tag == MOVER ? finish_marked(r, &x)
                            : finish_script(r, x);
}

/* --- reading ------------------------------------------------------------------------------- */

static tag
tag_at(const char *at)
{
    int i = 0;

    while (i < TAGS && (strncmp(tags[i].name, at, tags[i].length) != 0 ||
                        (at[tags[i].length] != '>' && at[tags[i].length] != ' ')))
        i++;
    return (tag)i;
}

static qdot_status
begin_element(reader *r, tag t, bool label, const char **at)
{
    const size_t from = r->to->text.n;
    qdot_status status;

    QDOT_TRY(qdot_vec_push(&r->open,
                           ((element){.tag = t, .children = r->done.n, .label = label})));
    if (t > MTEXT)
        return QDOT_OK;
    *at = add_characters(&r->to->text, *at);
    status = t == MO      ? finish_operator(r, from)
             : t == MTEXT ? finish_words(r, from)
                          : finish_text(r, from, QDOT_BOX_NAME);
    return status;
}

static qdot_status
read_tag(reader *r, const char **at)
{
    const bool ends = (*at)[1] == '/';
    const char *name = *at + 1 + ends, *end = strchr(name, '>');
    const tag t = tag_at(name);

    if (end == NULL || t == TAGS || (ends && (r->open.n == 0 || r->open.at[r->open.n - 1].tag != t)))
        return malformed();
    *at = end + 1;
    if (!ends)
        return begin_element(r, t, t == MROW && (size_t)(end - name) > tags[t].length, at);
    if (t <= MTEXT) {
        r->open.n--;
        return QDOT_OK;
    }
    return end_element(r);
}

static qdot_status
box_read_all(reader *r, const char *at)
{
    const element all = {.tag = MROW};
    qdot_box x = {.kind = QDOT_BOX_ROW};

    while (*at != '\0') {
        if (*at != '<')
            return malformed();
        QDOT_TRY(read_tag(r, &at));
        QDOT_TRY(qdot_interrupt_check());
    }
    if (r->open.n > 0)
        return malformed();
    QDOT_TRY(take_children(r, &all, false, &x));
    for (uint32_t k = 0; k < x.count; k++)
        beside(&x, r->to->box.at + r->to->children.at[x.first + k]);
    return box_finish(r, x);
}

qdot_status
qdot_boxes_read(const char *mathml, qdot_boxes *boxes)
{
    reader r = {.to = boxes};
    qdot_status status;

    *boxes = (qdot_boxes){0};
    status = box_read_all(&r, mathml);
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
