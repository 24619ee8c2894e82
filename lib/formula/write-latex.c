/* write-latex.c -- writes formulas in LaTeX. */
#include <inttypes.h>
#include <string.h>

#include "formula/name.h"
#include "formula/walk.h"
#include "formula/write.h"

static const char *const signs[] = {
#define QDOT_SIGN(name, plain, unicode, latex, mathml, duty) latex,
#include "formula/sign.def"
#undef QDOT_SIGN
};

typedef struct {
    qdot_text *out;
    size_t name, times; /* output positions at which a name of several letters, and a product sign, ended last */
    bool parted;        /* the last product sign stands after a name of several letters */
} writer;

/* Functions with a LaTeX command. */
static const struct {
    const char *name, *command;
} functions[] = {
    {"sin", "\\sin"},     {"cos", "\\cos"},     {"tan", "\\tan"},     {"sec", "\\sec"},   {"csc", "\\csc"},
    {"cot", "\\cot"},     {"asin", "\\arcsin"}, {"acos", "\\arccos"}, {"atan", "\\arctan"}, {"sinh", "\\sinh"},
    {"cosh", "\\cosh"},   {"tanh", "\\tanh"},   {"exp", "\\exp"},     {"log", "\\log"},   {"min", "\\min"},
    {"max", "\\max"},
};

static void
latex_add_function(qdot_text *out, const char *name, size_t n)
{
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        if (strncmp(functions[i].name, name, n) == 0 && functions[i].name[n] == '\0') {
            qdot_text_add(out, functions[i].command);
            return;
        }
    qdot_text_add(out, "\\operatorname{");
    qdot_text_add_n(out, name, n);
    qdot_text_char(out, '}');
}

/* Append a name in roman type; if it contains accented letters as text, since LaTeX formulas have none. */
static void
latex_add_roman(qdot_text *out, const char *name, size_t n)
{
    static const char *const others[2][3] = {{"\\backslash ", "\\hat{}", "\\sim "},
                                             {"\\textbackslash{}", "\\textasciicircum{}", "\\textasciitilde{}"}};
    static const char letters[] = "\\^~";
    bool text = false;

    for (size_t i = 0; i < n; i++)
        text = text || (unsigned char)name[i] >= 0x80;
    qdot_text_add(out, text ? "\\text{" : "\\mathrm{");
    for (size_t i = 0; i < n; i++) {
        const char *other = strchr(letters, name[i]);

        if (other != NULL) {
            qdot_text_add(out, others[text][other - letters]);
            continue;
        }
        qdot_text_add(out, strchr("_%#&${}", name[i]) != NULL ? "\\" : "");
        qdot_text_char(out, name[i]);
    }
    qdot_text_char(out, '}');
}

/* Append a product sign: a blank, which LaTeX does not print. */
static void
latex_add_times(writer *w)
{
    w->parted = w->name == w->out->n && w->name > 0;
    qdot_text_add(w->out, signs[QDOT_SIGN_TIMES]);
    w->times = w->out->n;
}

/* Append a name: Greek letters as LaTeX commands, other names of several letters in roman type. */
static void
latex_add_name(qdot_text *out, const char *name, size_t n)
{
    if (n > 1 && qdot_name_greek(name) != NULL) {
        for (size_t i = 0; i + 1 < n; i += 2) {
            qdot_text_add(out, i > 0 ? " \\" : "\\");
            qdot_text_add(out, qdot_name_greek(name + i));
        }
        return;
    }
    if (n == 1) {
        qdot_text_char(out, *name);
        return;
    }
    latex_add_roman(out, name, n);
}

static void
latex_add_text(qdot_text *out, const qdot_formula_node *node, const char *text)
{
    if (node->what == QDOT_TEXT_NAME)
        latex_add_name(out, text, node->n);
    else if (node->what == QDOT_TEXT_FUNCTION)
        latex_add_function(out, text, node->n);
    else if (node->what == QDOT_TEXT_LABEL)
        latex_add_roman(out, text, node->n);
    else
        qdot_text_add_n(out, text, node->n);
}

static const char *const dots[] = {"", "\\dot{", "\\ddot{", "\\dddot{", "\\ddddot{"};

enum { MOST_DOTS = 4 };

static qdot_status
latex_enter(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    static const char *const opening[] = {"\\left(", "\\left[", "\\left|", "\\left\\lfloor "};
    writer *w = walk->user;
    qdot_text *out = w->out;

    if (w->parted && w->times == out->n && qdot_name_is_long_at_begin(walk->formula, node))
        qdot_text_add(out, "\\, ");
    switch (node->kind) {
    case QDOT_FORMULA_TEXT:
        latex_add_text(out, node, walk->formula->text.at + node->child);
        w->name = qdot_name_is_long_at_end(walk->formula, node) ? out->n : w->name;
        break;
    case QDOT_FORMULA_SIGN:
        if (node->what == QDOT_SIGN_TIMES)
            latex_add_times(w);
        else
            qdot_text_add(out, signs[node->what]);
        break;
    case QDOT_FORMULA_FRACTION:
        qdot_text_add(out, node->flags & QDOT_FORMULA_SLANTED ? "" : node->flags & QDOT_FORMULA_SMALL ? "\\tfrac{"
                                                                                                    : "\\frac{");
        break;
    case QDOT_FORMULA_ROOT: qdot_text_add(out, "\\sqrt{"); break;
    case QDOT_FORMULA_ACCENT: qdot_text_add(out, node->n <= MOST_DOTS ? dots[node->n] : ""); break;
    case QDOT_FORMULA_BRACKET:
        qdot_text_add(out, node->flags & QDOT_FORMULA_FIXED ? "(" : opening[node->what]);
        break;
    case QDOT_FORMULA_TABLE: qdot_text_add(out, "\\begin{pmatrix}"); break;
    case QDOT_FORMULA_CASES: qdot_text_add(out, "\\begin{cases} "); break;
    default: break;
    }
    return QDOT_OK;
}

static qdot_status
latex_between(qdot_formula_walk *walk, const qdot_formula_node *node, uint32_t k)
{
    qdot_text *out = ((const writer *)walk->user)->out;

    switch (node->kind) {
    case QDOT_FORMULA_FRACTION:
        qdot_text_add(out, node->flags & QDOT_FORMULA_SLANTED ? "/" : "}{");
        break;
    case QDOT_FORMULA_POWER: qdot_text_add(out, "^{"); break;
    case QDOT_FORMULA_INDEX: qdot_text_add(out, "_{"); break;
    case QDOT_FORMULA_TENSOR: qdot_text_add(out, k == 1 ? "^{" : "}{}_{"); break;
    case QDOT_FORMULA_TABLE: qdot_text_add(out, k % node->n ? " & " : " \\\\ "); break;
    case QDOT_FORMULA_CASES: qdot_text_add(out, k % 2 ? " & \\text{if } " : " \\\\ "); break;
    default: break;
    }
    return QDOT_OK;
}

/* Append the order of a derivative, which has too many dots to draw, after its base and index. */
static void
latex_add_order(qdot_text *out, const qdot_formula_node *accent)
{
    if (accent->kind == QDOT_FORMULA_ACCENT && accent->n > MOST_DOTS)
        qdot_text_format(out, "^{(%" PRIu32 ")}", accent->n);
}

static void
latex_leave_accent(const qdot_formula_walk *walk, const qdot_formula_node *node, qdot_text *out)
{
    const qdot_formula_node *outer = qdot_formula_outer(walk);

    if (node->n > 0 && node->n <= MOST_DOTS)
        qdot_text_char(out, '}');
    else if (outer == NULL || outer->kind != QDOT_FORMULA_INDEX)
        latex_add_order(out, node);
}

static qdot_status
latex_leave(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    static const char *const closing[] = {"\\right)", "\\right]", "\\right|", "\\right\\rfloor "};
    writer *w = walk->user;
    qdot_text *out = w->out;

    switch (node->kind) {
    case QDOT_FORMULA_FRACTION: qdot_text_add(out, node->flags & QDOT_FORMULA_SLANTED ? "" : "}"); break;
    case QDOT_FORMULA_ROOT:
    case QDOT_FORMULA_POWER:
    case QDOT_FORMULA_TENSOR: qdot_text_char(out, '}'); break;
    case QDOT_FORMULA_INDEX:
        qdot_text_char(out, '}');
        latex_add_order(out, qdot_formula_at(walk->formula, qdot_formula_at(walk->formula, node->child)->next));
        break;
    case QDOT_FORMULA_ACCENT:
        latex_leave_accent(walk, node, out);
        w->name = qdot_name_is_long_at_end(walk->formula, node) ? out->n : w->name;
        break;
    case QDOT_FORMULA_PRIMES:
        for (uint32_t i = 0; i < node->n && node->n <= 3; i++)
            qdot_text_char(out, '\'');
        if (node->n > 3)
            qdot_text_format(out, "^{(%" PRIu32 ")}", node->n);
        break;
    case QDOT_FORMULA_BRACKET:
        qdot_text_add(out, node->flags & QDOT_FORMULA_FIXED ? ")" : closing[node->what]);
        break;
    case QDOT_FORMULA_TABLE: qdot_text_add(out, "\\end{pmatrix}"); break;
    case QDOT_FORMULA_CASES: qdot_text_add(out, " & \\text{otherwise} \\end{cases}"); break;
    default: break;
    }
    return QDOT_OK;
}

qdot_status
qdot_formula_write_latex(const qdot_formula *f, qdot_formula_id id, qdot_text *out)
{
    return qdot_formula_write_latex_part(f, id, (qdot_formula_before){0}, out);
}

qdot_status
qdot_formula_write_latex_part(const qdot_formula *f, qdot_formula_id id, qdot_formula_before before, qdot_text *out)
{
    const bool behind = before.sign != 0 && qdot_formula_sign_duty(qdot_formula_at(f, before.sign)) == QDOT_DUTY_TIMES &&
                        before.factor != 0;
    writer w = {.out = out,
                .times = out->n,
                .parted = behind && qdot_name_is_long_at_end(f, qdot_formula_at(f, before.factor))};
    qdot_formula_walk walk = {
        .formula = f, .user = &w, .enter = latex_enter, .between = latex_between, .leave = latex_leave};

    QDOT_TRY(qdot_formula_pass(&walk, id));
    return qdot_text_status(out);
}
