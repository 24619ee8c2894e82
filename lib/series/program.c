/* program.c -- translates a tape to the steps of a series program, each operation by the column `series` of
 * tape/operation.def. */
#include "series/program.h"

#include <stdatomic.h>
#include <string.h>

typedef qdot_program_row row;

typedef struct qdot_program_builder builder;

struct qdot_program_builder {
    qdot_program *program;
    bool values_only;
    row *at; /* [places] the row that holds the present value of each place (storage cell) of the tape */
    /* [rows] row of the sine in the pair (sin, cos) of an argument; QDOT_NO_ROW: there is none yet */
    qdot_vec(row) sincos, sinhcosh;
    qdot_program_step nothing;       /* after a failure steps are written into this one and ignored */
    qdot_status status;
};

static row
add_new_row(builder *b, qdot_program_source source, int at, bool still)
{
    const qdot_program_row_info info = {.source = source, .still = still, .at = at};

    if (b->status == QDOT_OK)
        b->status = qdot_vec_push(&b->program->rows, info);
    if (b->status == QDOT_OK)
        b->status = qdot_vec_push(&b->sincos, QDOT_NO_ROW);
    if (b->status == QDOT_OK)
        b->status = qdot_vec_push(&b->sinhcosh, QDOT_NO_ROW);
    return b->status == QDOT_OK ? (row)(b->program->rows.n - 1) : 0;
}

static bool
row_is_constant(const builder *b, row r)
{
    return b->status == QDOT_OK && b->program->rows.at[r].still;
}

static void
append_step(builder *b, qdot_program_step step)
{
    if (b->status == QDOT_OK)
        b->status = qdot_vec_push(&b->program->steps, step);
}

/* The step that was appended to the program last. */
static qdot_program_step *
last_step(builder *b)
{
    return b->status == QDOT_OK ? b->program->steps.at + b->program->steps.n - 1 : &b->nothing;
}

double
qdot_recurrence_cost(int op)
{
    static const double cost[QDOT_T_COUNT] = {
#define RECURRENCE(ID, cost, body) [QDOT_T_##ID] = cost,
#include "series/recurrence.def"
    };

    return cost[op];
}

static row
program_emit(builder *b, qdot_recurrence op, int zero, row x, row y, row z)
{
    const bool still = row_is_constant(b, x) && row_is_constant(b, y) && row_is_constant(b, z);
    const row to = add_new_row(b, QDOT_ROW_COMPUTED, 0, still);

    b->program->convolutions += still ? 0 : qdot_recurrence_cost(op);
    append_step(b, (qdot_program_step){.op = (uint16_t)op,
                              .zero = (uint16_t)zero,
                              .sign = 1,
                              .still = still,
                              .to = to,
                              .second = QDOT_NO_ROW,
                              .third = QDOT_NO_ROW,
                              .d = QDOT_NO_ROW,
                              .x = x,
                              .y = y,
                              .z = z});
    return to;
}

/* Give the last step of the program the additional row d that its recurrence needs. */
static void
add_row_d(builder *b)
{
    const row d = add_new_row(b, QDOT_ROW_COMPUTED, 0, last_step(b)->still);

    last_step(b)->d = d;
}

static void
add_second_row(builder *b)
{
    const row second = add_new_row(b, QDOT_ROW_COMPUTED, 0, last_step(b)->still);

    last_step(b)->second = second;
}

static void
add_third_row(builder *b)
{
    const row third = add_new_row(b, QDOT_ROW_COMPUTED, 0, last_step(b)->still);

    last_step(b)->third = third;
}

/* Append the step constant * x, or constant * x plus or minus z. */
static row
append_scaled(builder *b, qdot_op op, row constant, row x, row z)
{
    static const qdot_recurrence scale[QDOT_OP_COUNT] = {[QDOT_OP_MUL] = QDOT_T_SCALE,
                                                        [QDOT_OP_MADD] = QDOT_T_SCALEADD,
                                                        [QDOT_OP_MSUB] = QDOT_T_SCALESUB,
                                                        [QDOT_OP_NMADD] =
                                                            QDOT_T_SCALEOFF};

    return program_emit(b, scale[op], op, constant, x, z);
}

static row
append_product(builder *b, qdot_op op, row x, row y, row z)
{
    static const qdot_recurrence plain[QDOT_OP_COUNT] = {[QDOT_OP_MUL] = QDOT_T_MUL,
                                                        [QDOT_OP_MADD] = QDOT_T_MADD,
                                                        [QDOT_OP_MSUB] = QDOT_T_MSUB,
                                                        [QDOT_OP_NMADD] = QDOT_T_NMADD};
    row square;

    if (row_is_constant(b, x))
        return append_scaled(b, op, x, y, z);
    if (row_is_constant(b, y))
        return append_scaled(b, op, y, x, z);
    if (x != y) /* take the later row as the first factor, as rows are computed in order */
        return x > y ? program_emit(b, plain[op], op, x, y, z) : program_emit(b, plain[op], op, y, x, z);
    square = program_emit(b, QDOT_T_SQUARE, QDOT_OP_MUL, x, x, x);
    if (op == QDOT_OP_MADD)
        return program_emit(b, QDOT_T_ADD, QDOT_OP_ADD, square, z, z);
    if (op == QDOT_OP_MSUB)
        return program_emit(b, QDOT_T_SUB, QDOT_OP_SUB, square, z, z);
    if (op == QDOT_OP_NMADD)
        return program_emit(b, QDOT_T_SUB, QDOT_OP_SUB, z, square, square);
    return square;
}

/* Find the row of the sine of x, or hyperbolic sine; *cosine: the row of the cosine. Both are made together. */
static row
pair(builder *b, qdot_recurrence op, row x, row *cosine)
{
    row *made;
    row to;

    if (b->status != QDOT_OK)
        return *cosine = 0;
    made = op == QDOT_T_SINCOS ? b->sincos.at + x : b->sinhcosh.at + x;
    if (*made != QDOT_NO_ROW) {
        *cosine = *made + 1;
        return *made;
    }
    to = program_emit(b, op, op == QDOT_T_SINCOS ? QDOT_OP_SINCOS : QDOT_ZERO_SINHCOSH, x, x, x);
    add_second_row(b);
    add_row_d(b);
    *cosine = to + 1;
    if (b->status == QDOT_OK)
        (op == QDOT_T_SINCOS ? b->sincos.at : b->sinhcosh.at)[x] = to;
    return to;
}

static row
integer_row(builder *b, int n)
{
    return add_new_row(b, QDOT_ROW_WHOLE, n, true);
}

static row
append_sum(builder *b, qdot_op op, row x, row y)
{
    return program_emit(b, op == QDOT_OP_ADD ? QDOT_T_ADD : QDOT_T_SUB, op, x, y, y);
}

static row
root(builder *b, row x)
{
    return program_emit(b, QDOT_T_SQRT, QDOT_OP_SQRT, x, x, x);
}

/* The row of c + d x^2, c and d being 1 or -1, not both -1. */
static row
quadratic(builder *b, int c, int d, row x)
{
    const row square = append_product(b, QDOT_OP_MUL, x, x, x), one = integer_row(b, 1);

    if (c < 0)
        return append_sum(b, QDOT_OP_SUB, square, one);
    return append_sum(b, d > 0 ? QDOT_OP_ADD : QDOT_OP_SUB, one, square);
}

/* The row of an inverse function or a logarithm f with f(x)' = sign x'/u. */
static row
ratio(builder *b, qdot_op f, int sign, row x, row u)
{
    const row to = program_emit(b, QDOT_T_RATIO, f, x, u, u);

    last_step(b)->sign = sign;
    add_row_d(b);
    return to;
}

/* The row of a function f with f(x)' = x' slope. */
static row
along(builder *b, qdot_op f, row x, row slope)
{
    const row to = program_emit(b, QDOT_T_ALONG, f, x, slope, slope);

    add_row_d(b);
    return to;
}

/* The row of a number of a table: f(x)' = x' 0. */
static row
constant_in_pieces(builder *b, qdot_op f, row x, row zero, row handle)
{
    const row to = program_emit(b, QDOT_T_ALONG, f, x, zero, handle);

    add_row_d(b);
    return to;
}

static row
exponential(builder *b, row x)
{
    const row to = program_emit(b, QDOT_T_EXP, QDOT_OP_EXP, x, x, x);

    add_row_d(b);
    return to;
}

static row
tangent(builder *b, row x)
{
    const row to = program_emit(b, QDOT_T_TANH, QDOT_OP_TANH, x, x, x);

    add_second_row(b);
    add_row_d(b);
    return to;
}

/* The row of an operation of which only the value, of order 0, is found. */
static row
no_series(builder *b, qdot_op op, row x, row y, row z)
{
    return program_emit(b, QDOT_T_VALUE, op, x, y, z);
}

static row
emit_power(builder *b, row x, row exponent)
{
    row to, l;

    if (row_is_constant(b, exponent)) {
        to = program_emit(b, QDOT_T_POW, QDOT_OP_POW, x, exponent, exponent);
        add_row_d(b);
        return to;
    }
    l = append_product(b, QDOT_OP_MUL, ratio(b, QDOT_OP_LOG, 1, x, x), exponent, exponent);
    to = program_emit(b, QDOT_T_EXP, QDOT_ZERO_POWER, l, x, exponent);
    add_row_d(b);
    return to;
}

static row
arctangent(builder *b, row y, row x)
{
    row xx = append_product(b, QDOT_OP_MUL, x, x, x), u = append_product(b, QDOT_OP_MADD, y, y, xx);
    row to = program_emit(b, QDOT_T_ATAN2, QDOT_OP_ATAN2, y, x, u);

    add_second_row(b);
    add_third_row(b);
    add_row_d(b);
    return to;
}

static row
append_instruction(builder *p, const qdot_instruction *i, row *second)
{
    const qdot_op op = (qdot_op)i->op;
    const row x = p->at[i->x];
    const row y = qdot_operations[op].operands > 1 ? p->at[i->y] : x;
    const row z = qdot_operations[op].operands > 2 ? p->at[i->z] : y;
    row other;

    switch (op) {
#define X(ID, name, operands, operations, calls, statement, slopes, interval, disc, two, precise, series) \
    case QDOT_OP_##ID: return series;
#include "tape/operation.def"
#undef X
    default: return 0;
    }
}

/* The name of the first operation on the tape that has no Taylor series; NULL if all have one. */
const char *
qdot_program_hindrance(const qdot_tape *tape)
{
    for (size_t i = 0; i < tape->length; i++)
        if (tape->code[i].op >= QDOT_OP_ABS)
            return qdot_operations[tape->code[i].op].name;
    return NULL;
}

/* Move the steps whose rows are constant in time to the front, otherwise keeping their order. */
static qdot_status
move_constant_steps_first(qdot_program *p)
{
    qdot_program_step *moving = qdot_calloc(p->steps.n + 1, sizeof *moving);
    size_t n = 0;

    if (!moving)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < p->steps.n; i++)
        if (p->steps.at[i].still)
            p->steps.at[p->still++] = p->steps.at[i];
        else
            moving[n++] = p->steps.at[i];
    for (size_t i = 0; i < n; i++)
        p->steps.at[p->still + i] = moving[i];
    p->length = p->still + n;
    qdot_free(moving);
    return QDOT_OK;
}

static atomic_size_t made;

size_t
qdot_program_made(void)
{
    return made;
}

qdot_status
qdot_program_begin(size_t inputs, size_t moving, bool values_only, qdot_program *program,
                   qdot_program_builder **out)
{
    builder *b = qdot_calloc(1, sizeof *b);

    made++;
    *program = (qdot_program){.inputs = inputs, .moving = moving};
    *out = b;
    if (!b)
        return QDOT_ENOMEM;
    b->program = program;
    b->values_only = values_only;
    for (size_t i = 0; i < inputs; i++)
        add_new_row(b, QDOT_ROW_INPUT, (int)i, i >= moving);
    return QDOT_OK;
}

row
qdot_program_number(builder *b, qdot_program_constant number)
{
    if (b->status == QDOT_OK)
        b->status = qdot_vec_push(&b->program->constants, number);
    return add_new_row(b, QDOT_ROW_CONSTANT, (int)b->program->constants.n - 1, true);
}

row
qdot_program_unknown(builder *b)
{
    return add_new_row(b, QDOT_ROW_UNKNOWN, 0, false);
}

row
qdot_program_operation(builder *b, qdot_op op, row x, row y, row z)
{
    switch (op) {
    case QDOT_OP_NEG: return program_emit(b, QDOT_T_NEG, op, x, x, x);
    case QDOT_OP_ADD:
    case QDOT_OP_SUB: return append_sum(b, op, x, y);
    default: return append_product(b, op, x, y, z);
    }
}

row
qdot_program_rate(builder *b, row x)
{
    return program_emit(b, QDOT_T_RATE, QDOT_ZERO_RATE, x, x, x);
}

static void
append_tape(builder *b, const qdot_tape *tape, const row *in, row *out)
{
    for (size_t i = 0; i < tape->inputs; i++)
        b->at[i] = in[i];
    for (size_t i = 0; i < tape->constants; i++)
        b->at[tape->inputs + i] = qdot_program_number(
            b, (qdot_program_constant){tape->constant[i], tape->low[i], tape->side[i],
                                       tape->exact[i]});
    for (size_t i = 0; i < tape->length && b->status == QDOT_OK; i++) {
        const qdot_instruction *instruction = tape->code + i;
        row second = QDOT_NO_ROW, to = append_instruction(b, instruction, &second);

        b->at[instruction->to] = to;
        if (instruction->op == QDOT_OP_SINCOS)
            b->at[instruction->y] = second;
    }
    for (size_t i = 0; i < tape->outputs; i++)
        out[i] = b->at[tape->output[i]];
}

void
qdot_program_append(builder *b, const qdot_tape *tape, const row *in, row *out)
{
    const char *hindrance = b->values_only ? NULL : qdot_program_hindrance(tape);

    if (b->status == QDOT_OK && hindrance)
        b->status = qdot_fail(QDOT_ENOTBUILT,
                              "not built yet: Taylor series of equations that switch (%s)",
                              hindrance);
    b->at = qdot_calloc(tape->places + 1, sizeof *b->at);
    if (b->status == QDOT_OK && !b->at)
        b->status = QDOT_ENOMEM;
    if (b->status == QDOT_OK)
        append_tape(b, tape, in, out);
    else
        memset(out, 0, tape->outputs * sizeof *out);
    qdot_free(b->at);
}

qdot_status
qdot_program_end(builder *b)
{
    qdot_status status = b->status;

    if (status == QDOT_OK)
        status = move_constant_steps_first(b->program);
    if (status == QDOT_OK) {
        append_step(b, (qdot_program_step){.op = QDOT_T_END});
        status = b->status;
    }
    if (status != QDOT_OK)
        qdot_program_clear(b->program);
    qdot_free(b->sincos.at);
    qdot_free(b->sinhcosh.at);
    qdot_free(b);
    return status;
}

qdot_status
qdot_program_init(const qdot_tape *tape, size_t moving, bool values_only,
                  qdot_program *program)
{
    const size_t most = tape->inputs > tape->outputs ? tape->inputs : tape->outputs;
    row *rows = qdot_calloc(most + 1, sizeof *rows);
    builder *b = NULL;

    *program = (qdot_program){0};
    if (!rows)
        return QDOT_ENOMEM;
    if (qdot_program_begin(tape->inputs, moving, values_only, program, &b) != QDOT_OK) {
        qdot_free(rows);
        return QDOT_ENOMEM;
    }
    for (row i = 0; i < tape->inputs; i++)
        rows[i] = i;
    qdot_program_append(b, tape, rows, rows);
    for (size_t i = 0; i < tape->outputs && b->status == QDOT_OK; i++)
        b->status = qdot_vec_push(&program->outputs, rows[i]);
    qdot_free(rows);
    return qdot_program_end(b);
}

void
qdot_program_clear(qdot_program *program)
{
    qdot_free(program->rows.at);
    qdot_free(program->constants.at);
    qdot_free(program->steps.at);
    qdot_free(program->outputs.at);
    *program = (qdot_program){0};
}
