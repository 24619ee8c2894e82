/* write-mathml.c -- formulas in presentation MathML. */
#include <inttypes.h>

#include "formula/walk.h"
#include "formula/write.h"

static const char *const signs[] = {
#define QDOT_SIGN(name, plain, unicode, latex, mathml) mathml,
#include "formula/sign.def"
#undef QDOT_SIGN
};

/* What stands around the children of a node, or around a text. */
typedef struct {
    const char *open, *close;
} tags;

static const tags elements[] = {
    [QDOT_FORMULA_ROW] = {"<mrow>", "</mrow>"},
    [QDOT_FORMULA_FRACTION] = {"<mfrac>", "</mfrac>"},
    [QDOT_FORMULA_ROOT] = {"<msqrt>", "</msqrt>"},
    [QDOT_FORMULA_POWER] = {"<msup>", "</msup>"},
    [QDOT_FORMULA_INDEX] = {"<msub>", "</msub>"},
    [QDOT_FORMULA_PRIMES] = {"<msup><mrow>", NULL},
    [QDOT_FORMULA_TABLE] = {"<mrow><mo>(</mo><mtable><mtr><mtd>", "</mtd></mtr></mtable><mo>)</mo></mrow>"},
    [QDOT_FORMULA_CASES] = {"<mrow><mo>{</mo><mtable columnalign=\"left\"><mtr><mtd>",
                            "</mtd><mtd><mtext>otherwise</mtext></mtd></mtr></mtable></mrow>"},
    [QDOT_FORMULA_APPLY] = {NULL, NULL},
};

static const tags brackets[] = {
    [QDOT_BRACKET_ROUND] = {"<mrow><mo>(</mo>", "<mo>)</mo></mrow>"},
    [QDOT_BRACKET_SQUARE] = {"<mrow><mo>[</mo>", "<mo>]</mo></mrow>"},
    [QDOT_BRACKET_BARS] = {"<mrow><mo>|</mo>", "<mo>|</mo></mrow>"},
    [QDOT_BRACKET_FLOOR] = {"<mrow><mo>⌊</mo>", "<mo>⌋</mo></mrow>"},
};

static const tags texts[] = {[QDOT_TEXT_NAME] = {"<mi>", "</mi>"},
                             [QDOT_TEXT_NUMBER] = {"<mn>", "</mn>"},
                             [QDOT_TEXT_FUNCTION] = {"<mi>", "</mi>"},
                             [QDOT_TEXT_WORDS] = {"<mtext>", "</mtext>"}};

/* Derivatives with as many dots, or else with their order behind. */
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

static qdot_status
mathml_enter(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    qdot_text *out = walk->user;

    switch (node->kind) {
    case QDOT_FORMULA_TEXT: mathml_add_text(out, node, walk->formula->text.at + node->child); break;
    case QDOT_FORMULA_SIGN: qdot_text_add(out, signs[node->what]); break;
    case QDOT_FORMULA_ACCENT: qdot_text_add(out, node->n <= MOST_DOTS ? "<mover>" : "<msup>"); break;
    case QDOT_FORMULA_BRACKET: qdot_text_add(out, brackets[node->what].open); break;
    default:
        if (elements[node->kind].open != NULL)
            qdot_text_add(out, elements[node->kind].open);
    }
    return QDOT_OK;
}

static qdot_status
mathml_between(qdot_formula_walk *walk, const qdot_formula_node *node, uint32_t k)
{
    static const char cell[] = "</mtd><mtd>", row[] = "</mtd></mtr><mtr><mtd>";
    qdot_text *out = walk->user;

    if (node->kind == QDOT_FORMULA_TABLE)
        qdot_text_add(out, k % node->n ? cell : row);
    else if (node->kind == QDOT_FORMULA_CASES)
        qdot_text_add(out, k % 2 ? "</mtd><mtd><mtext>if&#xA0;</mtext>" : row);
    else if (node->kind == QDOT_FORMULA_APPLY)
        qdot_text_add(out, "<mo>&#x2061;</mo>");
    return QDOT_OK;
}

static void
mathml_leave_accent(qdot_text *out, uint32_t n)
{
    static const char *const marks[] = {"", "˙", "¨", "⃛"};

    if (n <= MOST_DOTS)
        qdot_text_format(out, "<mo>%s</mo></mover>", marks[n]);
    else
        qdot_text_format(out, "<mrow><mo>(</mo><mn>%" PRIu32 "</mn><mo>)</mo></mrow></msup>", n);
}

static void
mathml_leave_primes(qdot_text *out, uint32_t n)
{
    qdot_text_add(out, "</mrow><mo>");
    for (uint32_t i = 0; i < n && n <= 3; i++)
        qdot_text_add(out, "′");
    if (n > 3)
        qdot_text_format(out, "(%" PRIu32 ")", n);
    qdot_text_add(out, "</mo></msup>");
}

static qdot_status
mathml_leave(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    qdot_text *out = walk->user;

    switch (node->kind) {
    case QDOT_FORMULA_ACCENT: mathml_leave_accent(out, node->n); break;
    case QDOT_FORMULA_PRIMES: mathml_leave_primes(out, node->n); break;
    case QDOT_FORMULA_BRACKET: qdot_text_add(out, brackets[node->what].close); break;
    default:
        if (elements[node->kind].close != NULL)
            qdot_text_add(out, elements[node->kind].close);
    }
    return QDOT_OK;
}

qdot_status
qdot_formula_write_mathml(const qdot_formula *f, qdot_formula_id id, qdot_text *out)
{
    qdot_formula_walk walk = {
        .formula = f, .user = out, .enter = mathml_enter, .between = mathml_between, .leave = mathml_leave};

    QDOT_TRY(qdot_formula_pass(&walk, id));
    return qdot_text_status(out);
}
