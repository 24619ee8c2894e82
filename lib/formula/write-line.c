/* write-line.c -- writes a formula on one line, as input of the language or for human readers. */
#include <inttypes.h>

#include "formula/walk.h"
#include "formula/write.h"

static const struct {
    const char *text;
    size_t n;
} signs[][2] = {
#define QDOT_SIGN(name, plain, unicode, latex, mathml, duty) {{plain, sizeof plain - 1}, {unicode, sizeof unicode - 1}},
#include "formula/sign.def"
#undef QDOT_SIGN
};

typedef struct {
    qdot_text *out;
    bool script;
} writer;

static void
append_superscript_digits(qdot_text *out, const char *digits, size_t n)
{
    static const char *const superscript[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};

    for (size_t i = 0; i < n; i++)
        qdot_text_add(out, superscript[digits[i] - '0']);
}

static qdot_status
line_enter(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    static const char *const opening[] = {"(", "[", "|", "⌊"};
    const writer *w = walk->user;
    const qdot_formula_node *outer;

    switch (node->kind) {
    case QDOT_FORMULA_TEXT:
        outer = w->script ? NULL : qdot_formula_outer(walk);
        if (outer != NULL && outer->kind == QDOT_FORMULA_POWER && (outer->flags & QDOT_FORMULA_RAISED) &&
            walk->open.at[walk->open.n - 1].k == 1)
            append_superscript_digits(w->out, walk->formula->text.at + node->child, node->n);
        else
            qdot_text_add_n(w->out, walk->formula->text.at + node->child, node->n);
        break;
    case QDOT_FORMULA_SIGN:
        qdot_text_add_n(w->out, signs[node->what][!w->script].text, signs[node->what][!w->script].n);
        break;
    case QDOT_FORMULA_ROOT:
        qdot_text_add(w->out, node->flags & QDOT_FORMULA_BARE ? "√" : w->script ? "sqrt(" : "√(");
        break;
    case QDOT_FORMULA_BRACKET: qdot_text_add(w->out, opening[node->what]); break;
    case QDOT_FORMULA_TABLE: qdot_text_char(w->out, '['); break;
    default: break;
    }
    return QDOT_OK;
}

static qdot_status
line_between(qdot_formula_walk *walk, const qdot_formula_node *node, uint32_t k)
{
    const writer *w = walk->user;

    if (node->kind == QDOT_FORMULA_FRACTION)
        qdot_text_char(w->out, '/');
    else if (node->kind == QDOT_FORMULA_POWER && !(node->flags & QDOT_FORMULA_RAISED))
        qdot_text_char(w->out, '^');
    else if (node->kind == QDOT_FORMULA_TABLE)
        qdot_text_add(w->out, k % node->n ? ", " : "; ");
    return QDOT_OK;
}

static void
append_primes(const writer *w, uint32_t n)
{
    char digits[16];

    for (uint32_t i = 0; i < n && n <= 3; i++)
        qdot_text_add(w->out, w->script ? "'" : "′");
    if (n > 3) {
        qdot_text_add(w->out, "⁽");
        append_superscript_digits(w->out, digits, (size_t)snprintf(digits, sizeof digits, "%" PRIu32, n));
        qdot_text_add(w->out, "⁾");
    }
}

/* Whether a table, such as a matrix, has a single row. */
static bool
is_single_row_table(const qdot_formula *f, const qdot_formula_node *table)
{
    qdot_formula_id last = table->child;

    for (uint32_t k = 0; k < table->n; k++)
        last = qdot_formula_at(f, last)->next;
    return last == table->child;
}

static qdot_status
line_leave(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    static const char *const closing[] = {")", "]", "|", "⌋"};
    const writer *w = walk->user;

    switch (node->kind) {
    case QDOT_FORMULA_ROOT: qdot_text_add(w->out, node->flags & QDOT_FORMULA_BARE ? "" : ")"); break;
    case QDOT_FORMULA_BRACKET: qdot_text_add(w->out, closing[node->what]); break;
    case QDOT_FORMULA_TABLE: /* a matrix with one row must not look like a list */
        qdot_text_add(w->out, is_single_row_table(walk->formula, node) ? ";]" : "]");
        break;
    case QDOT_FORMULA_PRIMES: append_primes(w, node->n); break;
    default: break;
    }
    return QDOT_OK;
}

qdot_status
qdot_formula_write_line(const qdot_formula *f, qdot_formula_id id, qdot_notation_kind notation, qdot_text *out)
{
    writer w = {.out = out, .script = notation == QDOT_NOTATION_SCRIPT};
    qdot_formula_walk walk = {
        .formula = f, .user = &w, .enter = line_enter, .between = line_between, .leave = line_leave};

    QDOT_TRY(qdot_formula_pass(&walk, id));
    return qdot_text_status(out);
}
