/* write-gnuplot.c -- formulas in gnuplot's enhanced text: x_{max}, 10^{−9}, θ with a dot.
 *
 * An index of digits is written with small digits, θ₁: so a power stands well beside it. Above another index a power is
 * set by `@`, which takes no room; the index has another size then, since gnuplot's SVG omits a size that equals that of
 * the power. A power within a power stands in a line: gnuplot's letters do not get smaller twice.
 */
#include <string.h>

#include "base/utf8.h"
#include "formula/walk.h"
#include "formula/write.h"

static const char *const signs[] = {
#define QDOT_SIGN(name, plain, unicode, latex, mathml, duty) unicode,
#include "formula/sign.def"
#undef QDOT_SIGN
};

typedef struct {
    qdot_text *out;
    size_t raised; /* number of exponents that contain the present node */
} writer;

enum { MOST_DOTS = 2 };

/* The k-th child of a node; 0 if the node has fewer children. */
static qdot_formula_id
get_kth_child(const qdot_formula *f, const qdot_formula_node *node, uint32_t k)
{
    qdot_formula_id child = node->child;

    for (uint32_t i = 0; i <= k && child != 0; i++) {
        if (i > 0 && child == node->child)
            return 0;
        child = qdot_formula_at(f, child)->next;
    }
    return child;
}

/* The node itself, or, for a row or span with a single child, that child; found through several such levels. */
static const qdot_formula_node *
skip_single_child_rows(const qdot_formula *f, qdot_formula_id id)
{
    const qdot_formula_node *node = qdot_formula_at(f, id);

    while ((node->kind == QDOT_FORMULA_ROW || node->kind == QDOT_FORMULA_SPAN) && node->child != 0 &&
           qdot_formula_at(f, node->child)->next == node->child)
        node = qdot_formula_at(f, node->child);
    return node;
}

static bool
is_text(const qdot_formula_node *node, qdot_formula_role role)
{
    return node->kind == QDOT_FORMULA_TEXT && node->what == role;
}

/* Whether an index consists of digits only, which are written as subscript characters. */
static bool
has_low_digits(const qdot_formula *f, const qdot_formula_node *index)
{
    return is_text(skip_single_child_rows(f, get_kth_child(f, index, 1)), QDOT_TEXT_NUMBER);
}

/* The number of primes that are written after an accented letter and its index, where there is no room for dots. */
static uint32_t
primes_of_accent(const qdot_formula *f, const qdot_formula_node *accent)
{
    const qdot_formula_node *letter;

    if (accent->kind != QDOT_FORMULA_ACCENT)
        return 0;
    letter = skip_single_child_rows(f, get_kth_child(f, accent, 0));
    return accent->n <= MOST_DOTS && letter->kind == QDOT_FORMULA_TEXT &&
                   qdot_utf8_columns(f->text.at + letter->child, letter->n) == 1
               ? 0
               : accent->n;
}

/* Whether a root needs no brackets, as √2 and √θ₁. */
static bool
root_needs_no_brackets(const qdot_formula *f, const qdot_formula_node *root)
{
    const qdot_formula_node *first = qdot_formula_at(f, get_kth_child(f, root, 0));

    first = first->kind == QDOT_FORMULA_SPAN ? skip_single_child_rows(f, get_kth_child(f, root, 0)) : first;
    return get_kth_child(f, root, 1) == 0 &&
           (first->kind == QDOT_FORMULA_TEXT || first->kind == QDOT_FORMULA_INDEX || first->kind == QDOT_FORMULA_ACCENT);
}

/* Whether the exponent of a power is set directly above the index of its base. */
static bool
exponent_is_above_index(const qdot_formula *f, const qdot_formula_node *power)
{
    const qdot_formula_node *base = qdot_formula_at(f, get_kth_child(f, power, 0));

    return base->kind == QDOT_FORMULA_INDEX && !has_low_digits(f, base) &&
           primes_of_accent(f, qdot_formula_at(f, get_kth_child(f, base, 0))) == 0 &&
           is_text(qdot_formula_at(f, get_kth_child(f, power, 1)), QDOT_TEXT_NUMBER);
}

/* --- looking into a part ------------------------------------------------------------------ */

/* What a part of a formula contains: signs between terms, products or fractions at its top; a power anywhere. */
typedef struct {
    bool terms, factors, power;
} contents;

static qdot_status
note_contents_of_node(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    contents *c = walk->user;
    const qdot_formula_duty duty = qdot_formula_sign_duty(node);
    bool top = true;

    for (size_t i = 0; i < walk->open.n; i++) {
        const uint8_t kind = qdot_formula_at(walk->formula, walk->open.at[i].id)->kind;

        top = top && (kind == QDOT_FORMULA_ROW || kind == QDOT_FORMULA_SPAN);
    }
    c->power = c->power || node->kind == QDOT_FORMULA_POWER;
    c->terms = c->terms || (top && duty != QDOT_DUTY_NONE && duty != QDOT_DUTY_TIMES);
    c->factors = c->factors || (top && (duty == QDOT_DUTY_TIMES || node->kind == QDOT_FORMULA_FRACTION));
    return QDOT_OK;
}

static qdot_status
ignore_end_of_node(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    (void)walk;
    (void)node;
    return QDOT_OK;
}

static qdot_status
find_contents(const qdot_formula *f, qdot_formula_id id, contents *c)
{
    qdot_formula_walk walk = {.formula = f, .user = c, .enter = note_contents_of_node, .leave = ignore_end_of_node};

    *c = (contents){0};
    return qdot_formula_pass(&walk, id);
}

/* --- writing ------------------------------------------------------------------------------ */

/* Append text; a backslash before each character that is a command in enhanced text makes gnuplot print it. */
static void
append_escaped(qdot_text *out, const char *text, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        if (strchr("^_{}@&~\\", text[i]) != NULL)
            qdot_text_char(out, '\\');
        qdot_text_char(out, text[i]);
    }
}

/* Whether the present text is an exponent that was already written, above the index of its base. */
static bool
is_written_exponent(const qdot_formula_walk *walk)
{
    const qdot_formula_node *outer = qdot_formula_outer(walk);

    return outer != NULL && outer->kind == QDOT_FORMULA_POWER && walk->open.at[walk->open.n - 1].k == 1 &&
           exponent_is_above_index(walk->formula, outer);
}

/* Whether the present text is the digits of an index, which are written as subscript characters. */
static bool
is_subscript_text(const qdot_formula_walk *walk)
{
    for (size_t i = walk->open.n; i-- > 0;) {
        const qdot_formula_node *outer = qdot_formula_at(walk->formula, walk->open.at[i].id);

        if (outer->kind == QDOT_FORMULA_INDEX)
            return walk->open.at[i].k == 1 && has_low_digits(walk->formula, outer);
        if (outer->kind != QDOT_FORMULA_ROW && outer->kind != QDOT_FORMULA_SPAN)
            return false;
    }
    return false;
}

static void
gnuplot_add_text(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    static const char *const low[] = {"₀", "₁", "₂", "₃", "₄", "₅", "₆", "₇", "₈", "₉"};
    qdot_text *out = ((writer *)walk->user)->out;
    const char *text = walk->formula->text.at + node->child;

    if (node->what != QDOT_TEXT_NUMBER) {
        append_escaped(out, text, node->n);
        return;
    }
    if (is_written_exponent(walk))
        return;
    if (!is_subscript_text(walk)) {
        append_escaped(out, text, node->n);
        return;
    }
    for (uint32_t i = 0; i < node->n; i++)
        if (text[i] >= '0' && text[i] <= '9')
            qdot_text_add(out, low[text[i] - '0']);
}

/* A sign, in an exponent without its blanks. After an index a zero-width space comes first, as readers of SVG drop a
 * blank there. */
static void
gnuplot_add_sign(const writer *w, unsigned sign)
{
    const char *text = sign == QDOT_SIGN_TIMES ? signs[QDOT_SIGN_POINT] : signs[sign];
    size_t n = strlen(text);

    if (w->raised > 0 && n > 2 && text[0] == ' ' && text[n - 1] == ' ') {
        qdot_text_add_n(w->out, text + 1, n - 2);
        return;
    }
    if (text[0] == ' ' && w->out->n > 0 && w->out->at[w->out->n - 1] == '}')
        qdot_text_add(w->out, "\u200b");
    qdot_text_add(w->out, text);
}

/* Append a bracket before or after a numerator or denominator that needs one when the fraction is in one line. */
static qdot_status
gnuplot_add_bracket(const writer *w, const qdot_formula *f, const qdot_formula_node *fraction, uint32_t k, char bracket)
{
    contents c;

    QDOT_TRY(find_contents(f, get_kth_child(f, fraction, k), &c));
    if (c.terms || (k == 1 && c.factors))
        qdot_text_char(w->out, bracket);
    return QDOT_OK;
}

static qdot_status
gnuplot_enter(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    static const char *const opening[] = {"(", "[", "|", "⌊"};
    writer *w = walk->user;

    switch (node->kind) {
    case QDOT_FORMULA_TEXT: gnuplot_add_text(walk, node); break;
    case QDOT_FORMULA_SIGN: gnuplot_add_sign(w, node->what); break;
    case QDOT_FORMULA_FRACTION: return gnuplot_add_bracket(w, walk->formula, node, 0, '(');
    case QDOT_FORMULA_ROOT: qdot_text_add(w->out, root_needs_no_brackets(walk->formula, node) ? "√" : "√("); break;
    case QDOT_FORMULA_BRACKET: qdot_text_add(w->out, opening[node->what]); break;
    case QDOT_FORMULA_TABLE: qdot_text_char(w->out, '['); break;
    default: break;
    }
    return QDOT_OK;
}

/* Write what stands between a base and its exponent. */
static qdot_status
begin_exponent(writer *w, const qdot_formula *f, const qdot_formula_node *power)
{
    contents c;

    if (exponent_is_above_index(f, power))
        return QDOT_OK;
    QDOT_TRY(find_contents(f, get_kth_child(f, power, 1), &c));
    qdot_text_add(w->out, c.power ? "\\^(" : "^{");
    w->raised += !c.power;
    return QDOT_OK;
}

static void
begin_index(const writer *w, const qdot_formula_walk *walk, const qdot_formula_node *index)
{
    const qdot_formula *f = walk->formula;
    const qdot_formula_node *outer = walk->open.n > 1 ? qdot_formula_at(f, walk->open.at[walk->open.n - 2].id) : NULL;

    if (has_low_digits(f, index))
        return;
    if (outer == NULL || outer->kind != QDOT_FORMULA_POWER || walk->open.at[walk->open.n - 2].k != 0 ||
        !exponent_is_above_index(f, outer)) {
        qdot_text_add(w->out, "_{");
        return;
    }
    outer = qdot_formula_at(f, get_kth_child(f, outer, 1));
    qdot_text_add(w->out, "@^{");
    append_escaped(w->out, f->text.at + outer->child, outer->n);
    qdot_text_add(w->out, "}_{/*0.97 ");
}

static qdot_status
gnuplot_between(qdot_formula_walk *walk, const qdot_formula_node *node, uint32_t k)
{
    writer *w = walk->user;

    switch (node->kind) {
    case QDOT_FORMULA_FRACTION:
        QDOT_TRY(gnuplot_add_bracket(w, walk->formula, node, 0, ')'));
        qdot_text_char(w->out, '/');
        return gnuplot_add_bracket(w, walk->formula, node, 1, '(');
    case QDOT_FORMULA_POWER: return begin_exponent(w, walk->formula, node);
    case QDOT_FORMULA_INDEX: begin_index(w, walk, node); break;
    case QDOT_FORMULA_TENSOR: qdot_text_add(w->out, k == 1 ? "^{" : "}_{"); break;
    case QDOT_FORMULA_TABLE: qdot_text_add(w->out, k % node->n ? ", " : "; "); break;
    case QDOT_FORMULA_CASES: qdot_text_add(w->out, k % 2 ? " if " : "; "); break;
    default: break;
    }
    return QDOT_OK;
}

static void
gnuplot_add_primes(const writer *w, uint32_t n)
{
    for (; n > 0; n--)
        qdot_text_add(w->out, "′");
}

static void
gnuplot_end_accent(const qdot_formula_walk *walk, const qdot_formula_node *node)
{
    const writer *w = walk->user;
    const qdot_formula_node *outer = qdot_formula_outer(walk);
    const uint32_t primes = primes_of_accent(walk->formula, node);

    if (primes == 0)
        qdot_text_add(w->out, node->n == 1 ? "\u0307" : node->n == 2 ? "\u0308" : "");
    else if (outer == NULL || outer->kind != QDOT_FORMULA_INDEX)
        gnuplot_add_primes(w, primes);
}

static qdot_status
write_end_of_exponent(writer *w, const qdot_formula *f, const qdot_formula_node *power)
{
    contents c;

    if (exponent_is_above_index(f, power))
        return QDOT_OK;
    QDOT_TRY(find_contents(f, get_kth_child(f, power, 1), &c));
    qdot_text_char(w->out, c.power ? ')' : '}');
    w->raised -= !c.power;
    return QDOT_OK;
}

static qdot_status
gnuplot_leave(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    static const char *const closing[] = {")", "]", "|", "⌋"};
    writer *w = walk->user;

    switch (node->kind) {
    case QDOT_FORMULA_FRACTION: return gnuplot_add_bracket(w, walk->formula, node, 1, ')');
    case QDOT_FORMULA_POWER: return write_end_of_exponent(w, walk->formula, node);
    case QDOT_FORMULA_INDEX:
        qdot_text_add(w->out, has_low_digits(walk->formula, node) ? "" : "}");
        gnuplot_add_primes(w, primes_of_accent(walk->formula, qdot_formula_at(walk->formula, get_kth_child(walk->formula, node, 0))));
        break;
    case QDOT_FORMULA_ACCENT: gnuplot_end_accent(walk, node); break;
    case QDOT_FORMULA_PRIMES: gnuplot_add_primes(w, node->n); break;
    case QDOT_FORMULA_ROOT: qdot_text_add(w->out, root_needs_no_brackets(walk->formula, node) ? "" : ")"); break;
    case QDOT_FORMULA_BRACKET: qdot_text_add(w->out, closing[node->what]); break;
    case QDOT_FORMULA_TABLE: qdot_text_char(w->out, ']'); break;
    case QDOT_FORMULA_TENSOR: qdot_text_char(w->out, '}'); break;
    case QDOT_FORMULA_CASES: qdot_text_add(w->out, " otherwise"); break;
    default: break;
    }
    return QDOT_OK;
}

qdot_status
qdot_formula_write_gnuplot(const qdot_formula *f, qdot_formula_id id, qdot_text *out)
{
    writer w = {.out = out};
    qdot_formula_walk walk = {
        .formula = f, .user = &w, .enter = gnuplot_enter, .between = gnuplot_between, .leave = gnuplot_leave};

    QDOT_TRY(qdot_formula_pass(&walk, id));
    return qdot_text_status(out);
}
