/* write-mathml.c -- writes formulas in presentation MathML, also in the variant for HTML pages. */
#include <inttypes.h>
#include <string.h>

#include "formula/name.h"
#include "formula/walk.h"
#include "formula/write.h"

static const char *const signs[] = {
#define QDOT_SIGN(name, plain, unicode, latex, mathml, duty) mathml,
#include "formula/sign.def"
#undef QDOT_SIGN
};

typedef struct {
    qdot_text *out;
    bool page;              /* write the form for HTML pages */
    bool behind_times;      /* the last thing written was a multiplication sign */
    bool behind_name;       /* ... and that sign stands after a name of several letters */
    size_t name;            /* position in the output where the last name of several letters ended */
    qdot_vec(uint8_t) flat; /* for each open bracket: whether its contents are about one line high */
    qdot_vec(
        size_t) above; /* for each open tensor: where its upper indices begin and end in `out` */
} writer;

/* The MathML tags around the children of a node, or around a text. */
typedef struct {
    const char *open, *close;
} tags;

static const tags elements[] = {
    [QDOT_FORMULA_ROW] = {"<mrow>", "</mrow>"},
    [QDOT_FORMULA_FRACTION] = {"<mfrac>", "</mfrac>"},
    [QDOT_FORMULA_ROOT] = {"<msqrt>", "</msqrt>"},
    [QDOT_FORMULA_POWER] = {"<msup>", "</msup>"},
    [QDOT_FORMULA_INDEX] = {"<msub>", "</msub>"},
    [QDOT_FORMULA_TABLE] = {"<mrow><mo>(</mo><mtable><mtr><mtd>",
                            "</mtd></mtr></mtable><mo>)</mo></mrow>"},
    [QDOT_FORMULA_TENSOR] = {"<msubsup>", "</msubsup>"},
    [QDOT_FORMULA_CASES] =
        {"<mrow><mo>{</mo><mtable columnalign=\"left\"><mtr><mtd>",
         "</mtd><mtd><mtext>otherwise</mtext></mtd></mtr></mtable></mrow>"},
    [QDOT_FORMULA_APPLY] = {NULL, NULL},
};

static const tags brackets[] = {
    [QDOT_BRACKET_ROUND] = {"<mrow><mo>(</mo>", "<mo>)</mo></mrow>"},
    [QDOT_BRACKET_SQUARE] = {"<mrow><mo>[</mo>", "<mo>]</mo></mrow>"},
    [QDOT_BRACKET_BARS] = {"<mrow><mo>|</mo>", "<mo>|</mo></mrow>"},
    [QDOT_BRACKET_FLOOR] = {"<mrow><mo>⌊</mo>", "<mo>⌋</mo></mrow>"},
};

static const tags flat_round = {"<mrow><mo stretchy=\"false\">(</mo>",
                                "<mo stretchy=\"false\">)</mo></mrow>"};

static const tags texts[] = {[QDOT_TEXT_NAME] = {"<mi>", "</mi>"},
                             [QDOT_TEXT_NUMBER] = {"<mn>", "</mn>"},
                             [QDOT_TEXT_FUNCTION] = {"<mi>", "</mi>"},
                             [QDOT_TEXT_LABEL] = {"<mtext>", "</mtext>"},
                             [QDOT_TEXT_WORDS] = {"<mtext>", "</mtext>"}};

/* The most dots on a derivative; a higher order is written after it. */
enum { MOST_DOTS = 3 };

void
qdot_formula_escape(const char *text, size_t n, qdot_text *out)
{
    for (; n > 0; text++, n--)
        if (*text == '&' || *text == '<')
            qdot_text_add(out, *text == '&' ? "&amp;" : "&lt;");
        else
            qdot_text_char(out, *text);
}

static void
mathml_add_text(qdot_text *out, const qdot_formula_node *node, const char *text)
{
    qdot_text_add(out, texts[node->what].open);
    if (node->what == QDOT_TEXT_WORDS)
        qdot_formula_escape(text, node->n, out);
    else
        qdot_text_add_n(out, text, node->n);
    qdot_text_add(out, texts[node->what].close);
}

/* --- the form for pages ------------------------------------------------------------------------- */

/* Stop the traversal at a node that is higher than one line: a fraction, a root or a table. */
static qdot_status
stop_at_high_node(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    (void)walk;
    return node->kind == QDOT_FORMULA_FRACTION || node->kind == QDOT_FORMULA_ROOT ||
                   node->kind == QDOT_FORMULA_TABLE || node->kind == QDOT_FORMULA_CASES
               ? QDOT_ELIMIT
               : QDOT_OK;
}

static qdot_status
ignore_node_end(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    (void)walk;
    (void)node;
    return QDOT_OK;
}

/* Begin a bracket; on web pages a round one around a single line does not stretch. */
static qdot_status
mathml_open_bracket(writer *w, const qdot_formula *f, const qdot_formula_node *node)
{
    bool flat = w->page && node->what == QDOT_BRACKET_ROUND;

    if (flat) {
        qdot_formula_walk walk = {.formula = f, .enter = stop_at_high_node, .leave = ignore_node_end};
        const qdot_status status =
            qdot_formula_pass(&walk, (qdot_formula_id)(node - f->nodes.at));

        flat = status == QDOT_OK;
        if (status != QDOT_ELIMIT)
            QDOT_TRY(status);
    }
    qdot_text_add(w->out, flat ? flat_round.open : brackets[node->what].open);
    return qdot_vec_push(&w->flat, flat);
}

static void
mathml_close_bracket(writer *w, const qdot_formula_node *node)
{
    qdot_text_add(w->out, w->flat.at[--w->flat.n] ? flat_round.close
                                                  : brackets[node->what].close);
}

/* The node that is written for `id`, without SPANs and rows of a single child around it. */
static const qdot_formula_node *
skip_plain_rows(const qdot_formula *f, qdot_formula_id id)
{
    const qdot_formula_node *node = qdot_formula_at(f, id);

    while ((node->kind == QDOT_FORMULA_SPAN || node->kind == QDOT_FORMULA_ROW) &&
           node->child != 0 && qdot_formula_at(f, node->child)->next == node->child)
        node = qdot_formula_at(f, node->child);
    return node;
}

/* The first child, without SPANs and rows of a single child around it. */
static const qdot_formula_node *
first_child(const qdot_formula *f, const qdot_formula_node *node)
{
    return node->child == 0 ? node : skip_plain_rows(f, qdot_formula_at(f, node->child)->next);
}

/* Whether an exponent (or primes) of a name with an index is written directly above the index. */
static bool
is_above_index(const writer *w, const qdot_formula *f, const qdot_formula_node *node)
{
    return w->page &&
           (node->kind == QDOT_FORMULA_POWER || node->kind == QDOT_FORMULA_PRIMES) &&
           first_child(f, node)->kind == QDOT_FORMULA_INDEX;
}

/* Whether the present node is an indexed name, alone or in a row, that is the base of a power written above its index. */
static bool
is_index_below(const writer *w, const qdot_formula_walk *walk)
{
    for (size_t i = walk->open.n; w->page && i-- > 0;) {
        const qdot_formula_node *node =
            qdot_formula_at(walk->formula, walk->open.at[i].id);

        if (node->kind != QDOT_FORMULA_SPAN && node->kind != QDOT_FORMULA_ROW)
            return walk->open.at[i].k == 0 && is_above_index(w, walk->formula, node);
        if (node->child == 0 ||
            qdot_formula_at(walk->formula, node->child)->next != node->child)
            return false;
    }
    return false;
}

/* Whether the name of a function has several letters: sin x, sin^2 x. */
static bool
is_word_applied(const qdot_formula *f, const qdot_formula_node *apply)
{
    const qdot_formula_node *name = first_child(f, apply);

    if (name->kind == QDOT_FORMULA_POWER || name->kind == QDOT_FORMULA_PRIMES)
        name = first_child(f, name);
    return name->kind == QDOT_FORMULA_TEXT && name->n >= 2 &&
           f->text.at[name->child] >= 'a' && f->text.at[name->child] <= 'z';
}

/* Whether a node is an invisible product sign. */
static bool
is_times(const qdot_formula_node *node)
{
    return qdot_formula_sign_duty(node) == QDOT_DUTY_TIMES && node->what != QDOT_SIGN_DOT;
}

/* --- writing the nodes ------------------------------------------------------------------------------ */

static qdot_status
mathml_enter(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    writer *w = walk->user;
    const bool behind_times = w->behind_times;
    qdot_text *out = w->out;

    w->behind_times = node->kind == QDOT_FORMULA_SPAN ? behind_times : is_times(node);
    if (is_times(node))
        w->behind_name = w->name == out->n && w->name > 0;
    if (w->page && behind_times &&
        ((node->kind == QDOT_FORMULA_APPLY && is_word_applied(walk->formula, node)) ||
         (w->behind_name && qdot_name_is_long_at_begin(walk->formula, node))))
        qdot_text_add(out, "<mspace width=\"0.17em\"></mspace>");
    switch (node->kind) {
    case QDOT_FORMULA_TEXT:
        mathml_add_text(out, node, walk->formula->text.at + node->child);
        w->name = qdot_name_is_long_at_end(walk->formula, node) ? out->n : w->name;
        break;
    case QDOT_FORMULA_SIGN: qdot_text_add(out, signs[node->what]); break;
    case QDOT_FORMULA_ACCENT:
        qdot_text_add(out, node->n <= MOST_DOTS ? "<mover accent=\"true\">" : "<msup>");
        break;
    case QDOT_FORMULA_BRACKET: return mathml_open_bracket(w, walk->formula, node);
    case QDOT_FORMULA_PRIMES:
        qdot_text_add(out, is_above_index(w, walk->formula, node) ? "<msubsup>"
                                                                  : "<msup><mrow>");
        break;
    default:
        if (is_above_index(w, walk->formula, node))
            qdot_text_add(out, "<msubsup>");
        else if (elements[node->kind].open != NULL && !is_index_below(w, walk))
            qdot_text_add(out, elements[node->kind].open);
    }
    return QDOT_OK;
}

static qdot_status
mathml_between(qdot_formula_walk *walk, const qdot_formula_node *node, uint32_t k)
{
    static const char cell[] = "</mtd><mtd>", row[] = "</mtd></mtr><mtr><mtd>";
    writer *w = walk->user;
    qdot_text *out = w->out;

    if (node->kind == QDOT_FORMULA_TABLE)
        qdot_text_add(out, k % node->n ? cell : row);
    else if (node->kind == QDOT_FORMULA_CASES)
        qdot_text_add(out, k % 2 ? "</mtd><mtd><mtext>if&#xA0;</mtext>" : row);
    else if (node->kind == QDOT_FORMULA_APPLY)
        qdot_text_add(out, "<mo>&#x2061;</mo>");
    else if (node->kind == QDOT_FORMULA_TENSOR)
        return qdot_vec_push(&w->above, out->n);
    return QDOT_OK;
}

static void
mathml_leave_accent(const writer *w, uint32_t n)
{
    static const char *const marks[] = {"", "˙", "¨", "⃛"};
    const char *const fixed = w->page ? " stretchy=\"false\"" : "";

    if (n <= MOST_DOTS)
        qdot_text_format(w->out, "<mo>%s</mo></mover>", marks[n]);
    else
        qdot_text_format(
            w->out, "<mrow><mo%s>(</mo><mn>%" PRIu32 "</mn><mo%s>)</mo></mrow></msup>",
            fixed, n, fixed);
}

static void
mathml_leave_primes(qdot_text *out, uint32_t n, bool above_index)
{
    qdot_text_add(out, above_index ? "<mo>" : "</mrow><mo>");
    for (uint32_t i = 0; i < n && n <= 3; i++)
        qdot_text_add(out, "′");
    if (n > 3)
        qdot_text_format(out, "(%" PRIu32 ")", n);
    qdot_text_add(out, above_index ? "</mo></msubsup>" : "</mo></msup>");
}

/* Exchange lower and upper indices, as MathML needs the lower ones first. */
static void
mathml_exchange_indices(writer *w)
{
    const size_t middle = w->above.at[--w->above.n], from = w->above.at[--w->above.n];
    qdot_text above = {0};

    qdot_text_add_n(&above, w->out->at + from, middle - from);
    if (above.failed || w->out->failed) {
        w->out->failed = true;
    } else {
        memmove(w->out->at + from, w->out->at + middle, w->out->n - middle);
        qdot_text_truncate(w->out, w->out->n - above.n);
        qdot_text_add_n(w->out, qdot_text_str(&above), above.n);
    }
    qdot_text_clear(&above);
}

static qdot_status
mathml_leave(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    writer *w = walk->user;

    w->behind_times = w->behind_times && node->kind == QDOT_FORMULA_SPAN;
    if (node->kind == QDOT_FORMULA_TENSOR)
        mathml_exchange_indices(w);
    switch (node->kind) {
    case QDOT_FORMULA_ACCENT:
        mathml_leave_accent(w, node->n);
        w->name = qdot_name_is_long_at_end(walk->formula, node) ? w->out->n : w->name;
        break;
    case QDOT_FORMULA_PRIMES:
        mathml_leave_primes(w->out, node->n, is_above_index(w, walk->formula, node));
        break;
    case QDOT_FORMULA_BRACKET: mathml_close_bracket(w, node); break;
    default:
        if (is_above_index(w, walk->formula, node))
            qdot_text_add(w->out, "</msubsup>");
        else if (elements[node->kind].close != NULL && !is_index_below(w, walk))
            qdot_text_add(w->out, elements[node->kind].close);
    }
    return QDOT_OK;
}

static qdot_status
mathml_write(writer w, const qdot_formula *f, qdot_formula_id id, qdot_text *out)
{
    qdot_formula_walk walk = {.formula = f,
                              .user = &w,
                              .enter = mathml_enter,
                              .between = mathml_between,
                              .leave = mathml_leave};
    const qdot_status status = qdot_formula_pass(&walk, id);

    qdot_free(w.flat.at);
    qdot_free(w.above.at);
    return status == QDOT_OK ? qdot_text_status(out) : status;
}

qdot_status
qdot_formula_write_mathml(const qdot_formula *f, qdot_formula_id id, qdot_text *out)
{
    return mathml_write((writer){.out = out}, f, id, out);
}

qdot_status
qdot_formula_write_page(const qdot_formula *f, qdot_formula_id id, qdot_formula_before before,
                        qdot_text *out)
{
    const writer w = {.out = out,
                      .page = true,
                      .behind_times = before.sign != 0 && is_times(qdot_formula_at(f, before.sign)),
                      .behind_name = before.factor != 0 &&
                                     qdot_name_is_long_at_end(f, qdot_formula_at(f, before.factor))};

    return mathml_write(w, f, id, out);
}
