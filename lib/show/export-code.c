/* export-code.c -- the operations of a tape as statements of a language.
 *
 * A tape reuses places; here every operation is a value of its own again. Values that nothing needs
 * are left out, those used once stand within the expression that uses them if they are short.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "show/export-language.h"

enum { LONGEST = 44 }; /* in characters: longer expressions are not written inside other ones */

/* How strongly the outermost operation of an expression's text binds. */
enum { SUM, PRODUCT, WHOLE };

typedef struct {
    uint32_t op; /* the operation; QDOT_OP_COUNT: an input or a constant */
    uint32_t args[3];
    uint32_t uses;
    char *text;
    uint8_t binds;
    bool second, truth; /* the cosine of an operation SINCOS; the value is true or false */
} value;

typedef struct {
    const qdot_export_frame *frame;
    const qdot_tape *tape;
    value *values;
    size_t n;
    uint32_t *outputs; /* [tape->outputs] index of the value of each output */
    qdot_text *out;
    size_t named;
} writer;

/* --- values of the tape ----------------------------------------------------------------- */

static int
count_operands(uint32_t op)
{
    if (op == QDOT_OP_COUNT)
        return 0;
    if (op == QDOT_OP_ERF || op == QDOT_OP_ERFC || op == QDOT_OP_SOFTPLUS)
        return 1; /* only one: the second operand on the tape serves the derivative */
    return qdot_operations[op].operands;
}

static bool
gives_truth_value(uint32_t op)
{
    return op >= QDOT_OP_LT && op <= QDOT_OP_NOT;
}

static qdot_status
read_values_from_tape(writer *w)
{
    const qdot_tape *t = w->tape;
    size_t loaded = t->inputs + t->constants;
    uint32_t *at = qdot_malloc(t->places * sizeof *at); /* [places] index of the value in each place */

    w->values = qdot_calloc(loaded + 2 * t->length + 1, sizeof *w->values);
    w->outputs = qdot_malloc(t->outputs * sizeof *w->outputs);
    if (at == NULL || w->values == NULL || w->outputs == NULL) {
        qdot_free(at);
        return QDOT_ENOMEM;
    }
    for (; w->n < loaded; w->n++) {
        w->values[w->n].op = QDOT_OP_COUNT;
        at[w->n] = (uint32_t)w->n;
    }
    for (size_t i = 0; i < t->length; i++) {
        const qdot_instruction *x = t->code + i;
        const uint32_t args[3] = {x->x, x->y, x->z};
        value v = {.op = x->op, .truth = gives_truth_value(x->op)};

        for (int k = 0; k < count_operands(x->op); k++)
            v.args[k] = at[args[k]];
        at[x->to] = (uint32_t)w->n;
        w->values[w->n++] = v;
        if (x->op == QDOT_OP_SINCOS) {
            v.second = true;
            at[x->y] = (uint32_t)w->n;
            w->values[w->n++] = v;
        }
    }
    for (size_t i = 0; i < t->outputs; i++)
        w->outputs[i] = at[t->output[i]];
    qdot_free(at);
    return QDOT_OK;
}

/* The value of output i if it is a constant; else NaN. */
static double
constant_output(const writer *w, size_t i)
{
    uint32_t v = w->outputs[i];
    const qdot_tape *t = w->tape;

    return v >= t->inputs && v < t->inputs + t->constants ? t->constant[v - t->inputs] : NAN;
}

static void
count_uses_of_values(writer *w)
{
    for (size_t i = 0; i < w->tape->outputs; i++)
        w->values[w->outputs[i]].uses++;
    for (size_t v = w->n; v-- > 0;)
        if (w->values[v].uses > 0)
            for (int k = 0; k < count_operands(w->values[v].op); k++)
                w->values[w->values[v].args[k]].uses++;
}

/* --- writing expressions ---------------------------------------------------------------- */

void
qdot_export_number(double x, qdot_text *out)
{
    char text[40];

    snprintf(text, sizeof text, "%.*g", qdot_double_digits(x, 15), x);
    qdot_text_add(out, text);
    if (strpbrk(text, ".en") == NULL)
        qdot_text_add(out, ".0");
}

static void
add_operand(const writer *w, uint32_t v, int least, qdot_text *out)
{
    bool bracket = w->values[v].binds < least;

    qdot_text_add(out, bracket ? "(" : "");
    qdot_text_add(out, w->values[v].text);
    qdot_text_add(out, bracket ? ")" : "");
}

/* Write `left SIGN right`; both operands are evaluated in the order of the tape. */
static void
write_infix(const writer *w, uint32_t left, int least, const char *sign, uint32_t right, int right_least,
            qdot_text *out)
{
    add_operand(w, left, least, out);
    qdot_text_add(out, sign);
    add_operand(w, right, right_least, out);
}

static int
write_arithmetic(const writer *w, const value *v, qdot_text *out)
{
    const uint32_t a = v->args[0], b = v->args[1], c = v->args[2];

    switch (v->op) {
    case QDOT_OP_NEG:
        qdot_text_char(out, '-');
        add_operand(w, a, PRODUCT, out);
        return SUM;
    case QDOT_OP_ADD:
        /* subtract a negative constant: x - 1.0 in place of x + (-1.0) */
        if (w->values[b].op == QDOT_OP_COUNT && *w->values[b].text == '-') {
            add_operand(w, a, SUM, out);
            qdot_text_format(out, " - %s", w->values[b].text + 1);
        } else {
            write_infix(w, a, SUM, " + ", b, PRODUCT, out);
        }
        return SUM;
    case QDOT_OP_SUB: write_infix(w, a, SUM, " - ", b, PRODUCT, out); return SUM;
    case QDOT_OP_MUL: write_infix(w, a, PRODUCT, "*", b, WHOLE, out); return PRODUCT;
    case QDOT_OP_DIV: write_infix(w, a, PRODUCT, "/", b, WHOLE, out); return PRODUCT;
    case QDOT_OP_MADD:
        write_infix(w, a, PRODUCT, "*", b, WHOLE, out);
        qdot_text_add(out, " + ");
        add_operand(w, c, PRODUCT, out);
        return SUM;
    case QDOT_OP_MSUB:
        write_infix(w, a, PRODUCT, "*", b, WHOLE, out);
        qdot_text_add(out, " - ");
        add_operand(w, c, PRODUCT, out);
        return SUM;
    default: /* the remaining operation: NMADD */
        add_operand(w, c, SUM, out);
        qdot_text_add(out, " - ");
        write_infix(w, a, PRODUCT, "*", b, WHOLE, out);
        return SUM;
    }
}

static const char *
format_of_operation(const writer *w, const value *v)
{
    uint32_t op = v->op == QDOT_OP_SINCOS ? v->second ? QDOT_OP_COS : QDOT_OP_SIN : v->op;

    return w->frame->language->operation[op];
}

static int
write_value(const writer *w, const value *v, qdot_text *out)
{
    const char *text = format_of_operation(w, v);

    if (v->op == QDOT_OP_LOOKUP) {
        qdot_export_lookup(w->frame->tables, w->tape->constant[v->args[2] - w->tape->inputs], w->values[v->args[0]].text, out);
        return WHOLE;
    }
    if (text == NULL)
        return write_arithmetic(w, v, out);
    for (; *text != '\0'; text++)
        if ((*text == '&' || *text == '#') && text[1] >= 'a' && text[1] <= 'c') {
            add_operand(w, v->args[text[1] - 'a'], *text == '#' ? WHOLE : SUM, out);
            text++;
        } else {
            qdot_text_char(out, *text);
        }
    return WHOLE;
}

/* Whether the text of an operation uses an operand twice, so that the operand must be a variable. */
static bool
uses_operand_twice(const char *text, char operand_name)
{
    int n = 0;

    for (; text != NULL && *text != '\0'; text++)
        n += (*text == '&' || *text == '#') && text[1] == operand_name;
    return n > 1;
}

/* --- writing statements ----------------------------------------------------------------- */

/* Append a text by a printf format taken from our own tables. */
static void
add_formatted(qdot_text *out, const char *format, const char *text)
{
    const char *at = strstr(format, "%s");

    qdot_text_add_n(out, format, (size_t)(at - format));
    qdot_text_add(out, text);
    qdot_text_add(out, at + 2);
}

static void
declare_variable(writer *w, const char *word, bool truth, const char *text)
{
    qdot_text line = {0};

    add_formatted(&line, truth ? w->frame->language->truth : w->frame->language->number, word);
    if (line.failed) {
        w->out->failed = true; /* there was no memory for the format */
    } else {
        qdot_text_add(w->out, w->frame->indent);
        add_formatted(w->out, qdot_text_str(&line), text);
        qdot_text_char(w->out, '\n');
    }
    qdot_text_clear(&line);
}

/* Store the text of a value; or assign it to a variable and store the variable's name as the text. */
static qdot_status
store_text_of_value(writer *w, value *v, qdot_text *text, int binds, bool name)
{
    char word[40];

    QDOT_TRY(qdot_text_status(text));
    if (name || (v->uses > 1 && v->op != QDOT_OP_COUNT) || text->n > LONGEST) {
        snprintf(word, sizeof word, "%s%zu", w->frame->temporary, ++w->named);
        declare_variable(w, word, v->truth, qdot_text_str(text));
        v->text = qdot_strdup(word);
        v->binds = WHOLE;
    } else {
        v->text = qdot_strdup(qdot_text_str(text));
        v->binds = (uint8_t)binds;
    }
    return v->text == NULL ? QDOT_ENOMEM : QDOT_OK;
}

static qdot_status
write_inputs(writer *w)
{
    const qdot_tape *t = w->tape;

    for (size_t i = 0; i < t->inputs + t->constants; i++) {
        value *v = &w->values[i];
        qdot_text text = {0};

        if (v->uses == 0)
            continue;
        if (i < t->inputs) {
            if (w->frame->sources[i] != NULL)
                declare_variable(w, w->frame->words[i], false, w->frame->sources[i]);
            qdot_text_add(&text, w->frame->words[i]);
            v->binds = WHOLE;
        } else {
            if (!isfinite(t->constant[i - t->inputs]))
                return qdot_fail(QDOT_EINVAL, "what is to be exported contains a number too "
                                              "large for a double");
            qdot_export_number(t->constant[i - t->inputs], &text);
            v->binds = t->constant[i - t->inputs] < 0 ? SUM : WHOLE;
        }
        v->text = qdot_strdup(qdot_text_str(&text));
        qdot_text_clear(&text);
        if (v->text == NULL)
            return QDOT_ENOMEM;
    }
    return QDOT_OK;
}

/* Mark the values that must become variables because an operation uses them twice. */
static void
mark_values_used_twice(const writer *w, bool *must)
{
    for (size_t i = 0; i < w->n; i++) {
        const value *v = &w->values[i];

        for (int k = 0; v->uses > 0 && k < count_operands(v->op); k++)
            if (uses_operand_twice(format_of_operation(w, v), (char)('a' + k)))
                must[v->args[k]] = true;
    }
}

static qdot_status
write_values(writer *w)
{
    bool *must = qdot_calloc(w->n + 1, sizeof *must);
    qdot_status status = must == NULL ? QDOT_ENOMEM : write_inputs(w);

    if (must != NULL)
        mark_values_used_twice(w, must);
    for (size_t i = w->tape->inputs + w->tape->constants; i < w->n && status == QDOT_OK; i++) {
        value *v = &w->values[i];
        qdot_text text = {0};
        int binds;

        if (v->uses == 0)
            continue;
        binds = write_value(w, v, &text);
        status = store_text_of_value(w, v, &text, binds, must[i]);
        qdot_text_clear(&text);
    }
    qdot_free(must);
    return status;
}

/* --- writing outputs -------------------------------------------------------------------- */

/* Write an assignment to element k of an output by a format from our tables, with array, indices and value. */
static void
write_element(writer *w, const qdot_export_block *b, size_t k, const char *text)
{
    const qdot_export_language *s = w->frame->language;
    qdot_text line = {0};

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
    if (b->columns == 0 || s->entry == NULL)
        qdot_text_format(&line, s->element, b->array, k + s->first);
    else
        qdot_text_format(&line, s->entry, b->array, k / b->columns + s->first,
                         k % b->columns + s->first);
#pragma GCC diagnostic pop
    qdot_text_add(w->out, w->frame->indent);
    qdot_text_add(w->out, qdot_text_str(&line));
    qdot_text_add(w->out, " = ");
    qdot_text_add(w->out, text);
    qdot_text_add(w->out, strchr(s->number, ';') != NULL ? ";\n" : "\n");
    w->out->failed = w->out->failed || line.failed;
    qdot_text_clear(&line);
}

static void
write_assignment(writer *w, const char *target, const char *text)
{
    qdot_text_add(w->out, w->frame->indent);
    add_formatted(w->out, target, text);
    qdot_text_char(w->out, '\n');
}

/* Write the assignments of the outputs; elements that are 0 keep their initial value. */
static void
write_outputs(writer *w, const qdot_export_function *f)
{
    size_t at = 0;

    for (size_t i = 0; w->frame->targets != NULL && i < w->tape->outputs; i++)
        write_assignment(w, w->frame->targets[i], w->values[w->outputs[i]].text);
    for (size_t b = 0; w->frame->targets == NULL && b < f->blocks; b++) {
        const qdot_export_block *block = &f->block[b];
        size_t size = block->rows * (block->columns == 0 ? 1 : block->columns);

        if (block->array == NULL) {
            write_assignment(w, w->frame->language->result, w->values[w->outputs[at++]].text);
            continue;
        }
        for (size_t k = 0; k < size; k++, at++)
            if (constant_output(w, at) != 0)
                write_element(w, block, k, w->values[w->outputs[at]].text);
    }
}

qdot_status
qdot_export_code(const qdot_export_frame *frame, const qdot_export_function *function,
                 qdot_text *out)
{
    writer w = {.frame = frame, .tape = function->tape, .out = out};
    qdot_status status = read_values_from_tape(&w);

    if (status == QDOT_OK) {
        count_uses_of_values(&w);
        status = write_values(&w);
    }
    if (status == QDOT_OK)
        write_outputs(&w, function);
    for (size_t i = 0; w.values != NULL && i < w.n; i++)
        qdot_free(w.values[i].text);
    qdot_free(w.values);
    qdot_free(w.outputs);
    return status == QDOT_OK ? qdot_text_status(out) : status;
}
