/* finish.c -- makes a tape of the written code: removes unused values, fuses multiplications into
 * sums, shares places. */
#include <string.h>

#include "tape/code.h"
#include "tape/tape.h"

typedef struct {
    qdot_code *code;
    size_t m;
    const qdot_value *outputs;
    uint32_t *uses;  /* [values.n] number of operations that read each value; outputs count as read */
    uint32_t *last;  /* [values.n] the last value that is computed from this one; an output is kept to the end */
    uint32_t *place; /* [values.n] place of each value in the work space */
    uint32_t *constant; /* [values.n] for a constant: its index among the constants that are used */
} finish;

static qdot_code_value *
code_value_at(finish *f, qdot_value v)
{
    return f->code->values.at + v;
}

/* The number of operands of a value: how many of a, b, c it has. */
static int
count_operands(const qdot_code_value *v)
{
    if (v->op == QDOT_OP_INPUT || v->op == QDOT_OP_CONSTANT)
        return 0;
    return v->op == QDOT_OP_SECOND ? 1 : qdot_operations[v->op].operands;
}

static void
change_operand_uses(finish *f, qdot_value v, uint32_t change)
{
    const qdot_code_value *x = code_value_at(f, v);
    const qdot_value args[3] = {x->a, x->b, x->c};

    for (int i = 0; i < count_operands(x); i++)
        f->uses[args[i]] += change;
}

/* Count how often each value is used, from the outputs down; unused values get 0. */
static void
count_uses(finish *f)
{
    size_t n = f->code->values.n;

    memset(f->uses, 0, n * sizeof *f->uses);
    for (size_t i = 0; i < f->m; i++)
        f->uses[f->outputs[i]]++;
    for (size_t v = n; v-- > 0;)
        if (f->uses[v] > 0)
            change_operand_uses(f, (qdot_value)v, 1);
}

/* Where only one of a sine and a cosine is used, compute only that one. */
static void
replace_unused_sincos(finish *f)
{
    for (size_t v = 0; v < f->code->values.n; v++) {
        qdot_code_value *x = code_value_at(f, (qdot_value)v);

        if (x->op == QDOT_OP_SECOND && f->uses[v] > 0 && f->uses[x->a] == 1) {
            /* only the second result is used */
            *x = (qdot_code_value){QDOT_OP_COS, code_value_at(f, x->a)->a, 0, 0};
        }
    }
    count_uses(f);
    for (size_t v = 0; v + 1 < f->code->values.n; v++) {
        qdot_code_value *x = code_value_at(f, (qdot_value)v);

        if (x->op == QDOT_OP_SINCOS && f->uses[v] > 0) {
            const qdot_code_value *next = code_value_at(f, (qdot_value)v + 1);

            if (next->op != QDOT_OP_SECOND || f->uses[v + 1] == 0)
                x->op = QDOT_OP_SIN;
        }
    }
}

/* The product that computes the value `v`, if only one operation reads `v`; else NULL. */
static const qdot_code_value *
product_used_once(finish *f, qdot_value v)
{
    return f->uses[v] == 1 && code_value_at(f, v)->op == QDOT_OP_MUL ? code_value_at(f, v) : NULL;
}

static void
fuse_products_into_sums(finish *f)
{
    for (size_t v = 0; v < f->code->values.n; v++) {
        qdot_code_value *x = code_value_at(f, (qdot_value)v);
        const qdot_code_value *p;

        if (f->uses[v] == 0)
            continue;
        if (x->op == QDOT_OP_ADD || x->op == QDOT_OP_SUB) {
            if ((p = product_used_once(f, x->b))) {
                f->uses[x->b] = 0;
                x->op = x->op == QDOT_OP_ADD ? QDOT_OP_MADD : QDOT_OP_NMADD;
                *x = (qdot_code_value){x->op, p->a, p->b, x->a};
            } else if ((p = product_used_once(f, x->a))) {
                f->uses[x->a] = 0;
                x->op = x->op == QDOT_OP_ADD ? QDOT_OP_MADD : QDOT_OP_MSUB;
                *x = (qdot_code_value){x->op, p->a, p->b, x->b};
            }
        }
    }
}

/* Find last[v], the last use of v, for all values v that are used. */
static void
find_last_uses(finish *f)
{
    for (size_t v = 0; v < f->code->values.n; v++) {
        const qdot_code_value *x = code_value_at(f, (qdot_value)v);
        const qdot_value args[3] = {x->a, x->b, x->c};

        f->last[v] = (uint32_t)v;
        if (f->uses[v] > 0)
            for (int i = 0; i < count_operands(x); i++)
                f->last[args[i]] = (uint32_t)v;
    }
    for (size_t i = 0; i < f->m; i++)
        f->last[f->outputs[i]] = UINT32_MAX;
}

typedef struct {
    uint32_t *free; /* places in the work space whose values are no longer needed */
    size_t n_free;
    uint32_t next; /* the first place of the work space that was never used */
} places;

static uint32_t
allocate_place(places *p)
{
    return p->n_free ? p->free[--p->n_free] : p->next++;
}

/* Whether a value is computed by an instruction of its own. */
static bool
has_own_instruction(finish *f, size_t v)
{
    qdot_op op = code_value_at(f, (qdot_value)v)->op;

    return f->uses[v] > 0 && op < QDOT_OP_COUNT;
}

static void
assign_places(finish *f, qdot_tape *tape, places *p)
{
    qdot_instruction *out = tape->code;
    size_t n = f->code->values.n;

    for (size_t v = 0; v < n; v++) {
        const qdot_code_value *x = code_value_at(f, (qdot_value)v);
        const qdot_value args[3] = {x->a, x->b, x->c};
        qdot_instruction i = {.op = x->op};
        uint32_t *const arg_places[3] = {&i.x, &i.y, &i.z};

        if (!has_own_instruction(f, v))
            continue;
        for (int k = 0; k < count_operands(x); k++)
            *arg_places[k] = f->place[args[k]];
        for (int k = 0; k < count_operands(x); k++) {
            qdot_value a = args[k];
            bool again = (k > 0 && args[0] == a) || (k > 1 && args[1] == a);

            if (!again && f->last[a] == v
                && f->place[a] >= tape->inputs + tape->constants)
                p->free[p->n_free++] = f->place[a];
        }
        f->place[v] = i.to = allocate_place(p);
        if (x->op == QDOT_OP_SINCOS)
            f->place[v + 1] = i.y = allocate_place(p);
        *out++ = i;
        tape->operations += (size_t)qdot_operations[x->op].operations;
        tape->calls += (size_t)qdot_operations[x->op].calls;
    }
    tape->length = (size_t)(out - tape->code);
}

static qdot_status
build_tape(finish *f, qdot_tape *tape)
{
    size_t n = f->code->values.n, computed = 0;
    places p = {0};

    tape->approximate = f->code->approximate;
    tape->inputs = f->code->inputs;
    tape->outputs = f->m;
    for (size_t v = 0; v < n; v++) {
        const qdot_code_value *x = code_value_at(f, (qdot_value)v);

        if (x->op == QDOT_OP_CONSTANT && f->uses[v] > 0)
            f->constant[v] = (uint32_t)tape->constants++;
        computed += has_own_instruction(f, v);
    }
    tape->constant = qdot_malloc(tape->constants * sizeof *tape->constant);
    tape->side = qdot_malloc(tape->constants * sizeof *tape->side);
    tape->low = qdot_malloc(tape->constants * sizeof *tape->low);
    tape->exact = qdot_malloc(tape->constants * sizeof *tape->exact);
    tape->code = qdot_malloc(computed * sizeof *tape->code);
    tape->output = qdot_malloc(f->m * sizeof *tape->output);
    p.free = qdot_malloc((computed + 1) * 4 * sizeof *p.free);
    if (!tape->constant || !tape->side || !tape->low || !tape->exact || !tape->code
        || !tape->output || !p.free) {
        qdot_free(p.free);
        return QDOT_ENOMEM;
    }
    for (size_t v = 0; v < n; v++) {
        const qdot_code_value *x = code_value_at(f, (qdot_value)v);

        if (x->op == QDOT_OP_INPUT)
            f->place[v] = x->a;
        else if (x->op == QDOT_OP_CONSTANT && f->uses[v] > 0) {
            f->place[v] = (uint32_t)tape->inputs + f->constant[v];
            tape->constant[f->constant[v]] = f->code->constants.at[x->a];
            tape->side[f->constant[v]] = f->code->sides.at[x->a];
            tape->low[f->constant[v]] = f->code->lows.at[x->a];
            tape->exact[f->constant[v]] = f->code->exact.at[x->a];
        }
    }
    p.next = (uint32_t)(tape->inputs + tape->constants);
    assign_places(f, tape, &p);
    tape->places = p.next;
    for (size_t i = 0; i < f->m; i++)
        tape->output[i] = f->place[f->outputs[i]];
    qdot_free(p.free);
    return QDOT_OK;
}

qdot_status
qdot_code_finish(qdot_code *code, size_t m, const qdot_value *outputs, qdot_tape **tape)
{
    finish f = {.code = code, .m = m, .outputs = outputs};
    size_t n = code->values.n + 1;
    qdot_status status = code->status;

    *tape = NULL;
    if (status != QDOT_OK)
        return status;
    f.uses = qdot_calloc(4 * n, sizeof *f.uses);
    *tape = qdot_calloc(1, sizeof **tape);
    if (!f.uses || !*tape)
        status = QDOT_ENOMEM;
    else {
        f.last = f.uses + n;
        f.place = f.last + n;
        f.constant = f.place + n;
        count_uses(&f);
        replace_unused_sincos(&f);
        count_uses(&f);
        fuse_products_into_sums(&f);
        count_uses(&f);
        find_last_uses(&f);
        status = build_tape(&f, *tape);
    }
    qdot_free(f.uses);
    if (status != QDOT_OK) {
        qdot_tape_free(*tape);
        *tape = NULL;
    }
    return status;
}
