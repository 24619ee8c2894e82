/* motion-of-equations.c -- writes M q'' = f, perhaps with constraints, as rows of a Taylor series program. */
#include "sim/form/motion-of-equations.h"

#include "base/memory.h"
#include "expr/constant.h"
#include "series/alike-kinds.h"
#include "sim/model/constraints.h"

/* Builds the equations for the unknowns: first q'' of the coordinates, then the constraints' multipliers. */
typedef struct {
    const qdot_plan *plan;
    const qdot_tape *tape; /* the plan's tape, or for machine code the one with constraints (plan->bordered) */
    size_t n; /* number of coordinates that move; those after them in the plan are constant */
    qdot_motion *motion;
    qdot_program_builder *program;
    qdot_program_row *outputs; /* program rows of the outputs of `tape` */
    qdot_motion_line *lines;   /* [n + m] equations in the motion's order; right-hand sides f, gamma */
    uint32_t *place; /* [n + m] index among the unknowns of each coordinate and multiplier */
} builder;

static bool
is_input_constant(const builder *b, size_t i)
{
    return i >= b->n && i < b->plan->n;
}

/* Set the matrix entries K_ij = K_ji to the program row `at`. */
static qdot_status
set_symmetric_entry(builder *b, size_t i, size_t j, qdot_program_row at)
{
    return qdot_vec_push(&b->motion->entries, ((qdot_motion_entry){b->place[i], b->place[j], at}));
}

/* The k-th of the next equations determines the acceleration of coordinate i and has the right-hand
 * side `right`. */
static void
set_equation(builder *b, size_t i, size_t k, qdot_program_row right)
{
    b->place[i] = (uint32_t)(b->motion->solved.n + k);
    b->lines[b->place[i]] =
        (qdot_motion_line){qdot_program_unknown(b->program), right, QDOT_NO_ROW};
}

static qdot_status
add_unknown_acceleration(builder *b, size_t i)
{
    const qdot_motion_line *line = b->lines + b->place[i];
    qdot_motion_unknown u = {.row = line->u, .once = QDOT_NO_ROW, .twice = QDOT_NO_ROW};

    if (i < b->n) {
        u.once = (qdot_program_row)(b->n + i);
        u.twice = (qdot_program_row)i;
    }
    QDOT_TRY(qdot_vec_push(&b->motion->right, line->right));
    return qdot_motion_solve(b->motion, u, line->E);
}

/* Find the program row of a constant entry of M; *row is QDOT_NO_ROW if the entry is 0. */
static qdot_status
find_constant_row(builder *b, qdot_expr e, qdot_program_row *row)
{
    qdot_program_constant c = {.exact = e};
    int side;

    QDOT_TRY(qdot_constant_split(b->plan->pool, e, &c.value, &side, &c.low));
    c.side = (signed char)side;
    *row = c.value != 0 ? qdot_program_number(b->program, c) : QDOT_NO_ROW;
    return QDOT_OK;
}

/* Add the equations of a block of M; its f and its entries are the outputs from *at on. */
static qdot_status
add_block(builder *b, const qdot_plan_block *block, size_t *at)
{
    const qdot_plan *p = b->plan;
    const size_t n = block->n, entries = b->motion->entries.n, first = b->motion->solved.n;

    for (size_t i = 0; i < n; i++)
        set_equation(b, block->index[i], i, b->outputs[(*at)++]);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++) {
            const size_t row = block->index[i], column = block->index[j];
            qdot_program_row M;

            if (block->constant)
                QDOT_TRY(find_constant_row(b, p->M[row * p->n + column], &M));
            else
                M = b->outputs[(*at)++];
            if (M != QDOT_NO_ROW)
                QDOT_TRY(set_symmetric_entry(b, row, column, M));
        }
    qdot_motion_write(b->motion, b->program, entries, b->lines, first, first + n);
    for (size_t i = 0; i < n; i++)
        QDOT_TRY(add_unknown_acceleration(b, block->index[i]));
    return qdot_motion_end_block(b->motion);
}

static qdot_status
add_all_blocks(builder *b)
{
    const qdot_plan *p = b->plan;
    size_t at = 0;

    for (size_t k = 0; k < p->structure.blocks; k++) {
        const qdot_plan_block *block = p->blocks + k;
        const qdot_program_row i = (qdot_program_row)block->index[0];

        if (block->n > 1)
            QDOT_TRY(add_block(b, block, &at));
        else if (is_input_constant(b, i))
            at++;
        else
            QDOT_TRY(qdot_motion_give(b->motion, b->outputs[at++],
                                      (qdot_program_row)b->n + i, i));
    }
    for (size_t c = 0; c < p->n_kept; c++)
        QDOT_TRY(qdot_motion_give(b->motion, b->outputs[at++], (qdot_program_row)p->kept[c],
                                  QDOT_NO_ROW));
    return QDOT_OK;
}

static qdot_status
add_constrained_equations(builder *b)
{
    const qdot_constraints *c = b->plan->constraints;
    const size_t n = b->plan->n;
    const qdot_program_row *M = b->outputs + n, *A = M + c->n_masses, *gamma = A + c->n_slopes;

    size_t count = 0;

    for (size_t i = 0; i < n + c->m; i++)
        if (!is_input_constant(b, i))
            set_equation(b, i, count++, i < n ? b->outputs[i] : gamma[i - n]);
    for (size_t k = 0; k < c->n_masses; k++)
        if (!is_input_constant(b, c->masses[k].row))
            QDOT_TRY(set_symmetric_entry(b, c->masses[k].row, c->masses[k].column, M[k]));
    for (size_t k = 0; k < c->n_slopes; k++)
        QDOT_TRY(set_symmetric_entry(b, n + c->slopes[k].row, c->slopes[k].column, A[k]));
    qdot_motion_write(b->motion, b->program, 0, b->lines, 0, count);
    for (size_t i = 0; i < n + c->m; i++)
        if (!is_input_constant(b, i))
            QDOT_TRY(add_unknown_acceleration(b, i));
    return qdot_motion_end_block(b->motion);
}

/* The program row of input i of the plan's tape; parameters treated as coordinates have velocity 0. */
static qdot_program_row
row_of_input(const builder *b, size_t i)
{
    const size_t n = b->n, all = b->plan->n, numbers = all - n;
    const qdot_program_constant zero = {.exact = QDOT_ZERO};

    if (i < all)
        return (qdot_program_row)(i < n ? i : n + 1 + i);
    if (i < 2 * all && i - all >= n)
        return qdot_program_number(b->program, zero);
    return (qdot_program_row)(i == 2 * all ? i - 2 * numbers : i - numbers); /* the input with index 2 `all` is t */
}

static qdot_status
build_explicit_motion(builder *b)
{
    const qdot_tape *tape = b->tape;
    const size_t outputs = qdot_tape_outputs(tape), inputs = qdot_tape_inputs(tape);
    const size_t size = b->plan->n + (b->plan->constraints ? b->plan->constraints->m : 0);
    size_t steps;

    b->outputs = qdot_calloc(inputs + outputs + 1, sizeof *b->outputs);
    b->lines = qdot_calloc(size + 1, sizeof *b->lines);
    b->place = qdot_calloc(size + 1, sizeof *b->place);
    if (!b->outputs || !b->lines || !b->place)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < inputs; i++)
        b->outputs[outputs + i] = row_of_input(b, i);
    qdot_program_append(b->program, tape, b->outputs + outputs, b->outputs);
    for (size_t i = 0; i < outputs; i++)
        QDOT_TRY(qdot_vec_push(&b->motion->program.outputs, b->outputs[i]));
    steps = b->motion->program.steps.n;
    QDOT_TRY(b->plan->constraints ? add_constrained_equations(b) : add_all_blocks(b));
    b->motion->written = b->motion->program.steps.n - steps;
    return QDOT_OK;
}

static qdot_status
make_motion(const qdot_plan *plan, size_t n, qdot_motion *motion)
{
    const qdot_tape *tape = plan->bordered ? plan->bordered : plan->tape;
    const size_t inputs = qdot_tape_inputs(tape) - (plan->n - n);
    builder b = {.plan = plan, .tape = tape, .n = n, .motion = motion};
    qdot_status status;

    *motion = (qdot_motion){0};
    QDOT_TRY(qdot_program_begin(inputs, 2 * n + 1, false, &motion->program, &b.program));
    status = qdot_motion_complete(motion, b.program, build_explicit_motion(&b));
    qdot_free(b.outputs);
    qdot_free(b.lines);
    qdot_free(b.place);
    return status;
}

qdot_status
qdot_motion_of_equations(const qdot_plan *plan, qdot_motion *motion)
{
    qdot_status status;

    QDOT_TRY(make_motion(plan, plan->n, motion));
    status = qdot_alike_find(motion);
    if (status != QDOT_OK)
        qdot_motion_clear(motion);
    return status;
}

qdot_status
qdot_motion_of_members(const qdot_plan *plan, qdot_motion *motion)
{
    return make_motion(plan, plan->n - plan->n_states, motion);
}
