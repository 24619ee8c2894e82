/* motion-of-residual.c -- writes d'Alembert's residual, along its tree of functions, as rows of a
 * series program. */
#include "sim/form/motion-of-residual.h"

#include "base/memory.h"

typedef struct {
    const qdot_plan *plan;
    const qdot_residual *residual;
    qdot_motion *motion;
    qdot_program_builder *program;
    qdot_program_row *inputs;         /* [2n + 1] program rows of the inputs q, q', t */
    qdot_program_row *places, *forces; /* program rows of the outputs of the tapes `places` and `forces` */
    qdot_program_row *x, *F; /* [functions] program rows of x'' and of the force F of each function x */
    qdot_program_row *E;              /* [n] program rows of the residuals E_i of the equations */
} builder;

static void
add_row_to_sum(builder *b, qdot_program_row *sum, qdot_program_row more)
{
    *sum = *sum == QDOT_NO_ROW
               ? more
               : qdot_program_operation(b->program, QDOT_OP_ADD, *sum, more, more);
}

static void
add_product(builder *b, qdot_program_row *sum, qdot_program_row x, qdot_program_row y)
{
    *sum = qdot_program_operation(b->program, *sum == QDOT_NO_ROW ? QDOT_OP_MUL : QDOT_OP_MADD,
                                  x, y, *sum == QDOT_NO_ROW ? y : *sum);
}

/* Add the program rows of the tree of functions: values from the root down, forces from the leaves up. */
static void
add_tree_rows(builder *b)
{
    const qdot_residual *r = b->residual;

    for (size_t f = 0; f < r->functions; f++) {
        b->x[f] = qdot_program_rate(b->program, qdot_program_rate(b->program, b->places[f]));
        if (r->parent[f] != UINT32_MAX)
            add_row_to_sum(b, &b->x[f], b->x[r->parent[f]]);
        b->F[f] = QDOT_NO_ROW;
    }
    for (size_t w = 0; w < r->n_weights; w++) {
        const qdot_residual_weight *weight = r->weights + w;
        const qdot_program_constant c = {weight->w, weight->low, weight->side, weight->exact};

        if (weight->exact == QDOT_ONE)
            add_row_to_sum(b, &b->F[weight->to], b->x[weight->from]);
        else
            add_product(b, &b->F[weight->to], qdot_program_number(b->program, c),
                        b->x[weight->from]);
    }
    for (size_t f = r->functions; f-- > 0;)
        if (r->parent[f] != UINT32_MAX && b->F[f] != QDOT_NO_ROW)
            add_row_to_sum(b, &b->F[r->parent[f]], b->F[f]);
}

/* Program rows of sum_f dd_f/dq_i F_f + dV/dq_i, into E: the tape `adjoint` of F and s = 1. */
static qdot_status
add_adjoint(builder *b)
{
    const qdot_residual *r = b->residual;
    const size_t inputs = 2 * b->plan->n + 1;
    const qdot_program_constant zero = {.exact = QDOT_ZERO}, one = {.value = 1, .exact = QDOT_ONE};
    qdot_program_row *in = qdot_calloc(inputs + r->functions + 1, sizeof *in);

    if (!in)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < inputs; i++)
        in[i] = b->inputs[i];
    for (size_t f = 0; f < r->functions; f++)
        in[inputs + f] = b->F[f] == QDOT_NO_ROW ? qdot_program_number(b->program, zero) : b->F[f];
    in[inputs + r->functions] = qdot_program_number(b->program, one);
    qdot_program_append(b->program, r->adjoint, in, b->E);
    qdot_free(in);
    return QDOT_OK;
}

static void
subtract_applied_forces(builder *b)
{
    for (size_t i = 0; i < b->plan->n; i++) {
        const uint32_t at = b->residual->force[i];

        if (at != UINT32_MAX) {
            const qdot_program_row Q =
                at & QDOT_RESIDUAL_FORCES ? b->forces[at ^ QDOT_RESIDUAL_FORCES] : b->places[at];

            b->E[i] = qdot_program_operation(b->program, QDOT_OP_SUB, b->E[i], Q, Q);
        }
    }
}

static void
add_equations(builder *b)
{
    const qdot_residual *r = b->residual;

    for (size_t i = 0; i < b->plan->n; i++) {
        const uint32_t at = r->force[i];

        b->E[i] = QDOT_NO_ROW;
        if (at != UINT32_MAX)
            b->E[i] = qdot_program_operation(b->program, QDOT_OP_NEG,
                                         at & QDOT_RESIDUAL_FORCES
                                             ? b->forces[at ^ QDOT_RESIDUAL_FORCES]
                                             : b->places[at],
                                         0, 0);
    }
    for (size_t j = 0; j < r->n_slopes; j++) {
        const qdot_residual_slope *s = r->slopes + j;

        if (b->F[s->function] != QDOT_NO_ROW)
            add_product(b, &b->E[s->coordinate], b->places[s->output], b->F[s->function]);
    }
}

static qdot_status
add_unknowns(builder *b)
{
    const qdot_plan *p = b->plan;

    for (size_t k = 0; k < p->structure.blocks; k++) {
        const qdot_plan_block *block = p->blocks + k;

        for (size_t i = 0; i < block->n; i++) {
            const qdot_program_row at = (qdot_program_row)block->index[i];
            const qdot_motion_unknown u = {.row = QDOT_NO_ROW,
                                           .once = (qdot_program_row)p->n + at,
                                           .twice = at};

            QDOT_TRY(qdot_motion_solve(b->motion, u, b->E[at]));
        }
        QDOT_TRY(qdot_motion_end_block(b->motion));
    }
    return QDOT_OK;
}

static qdot_status
build_residual_motion(builder *b)
{
    const qdot_residual *r = b->residual;
    const size_t inputs = 2 * b->plan->n + 1;
    const size_t places = qdot_tape_outputs(r->places);
    const size_t forces = r->forces ? qdot_tape_outputs(r->forces) : 0;

    b->inputs = qdot_calloc(inputs + places + forces + 2 * r->functions + b->plan->n,
                            sizeof *b->inputs);
    if (!b->inputs)
        return QDOT_ENOMEM;
    b->places = b->inputs + inputs;
    b->forces = b->places + places;
    b->x = b->forces + forces;
    b->F = b->x + r->functions;
    b->E = b->F + r->functions;
    for (size_t i = 0; i < inputs; i++)
        b->inputs[i] = (qdot_program_row)i;
    qdot_program_append(b->program, r->places, b->inputs, b->places);
    if (r->forces)
        qdot_program_append(b->program, r->forces, b->inputs, b->forces);
    add_tree_rows(b);
    if (r->adjoint) {
        QDOT_TRY(add_adjoint(b));
        subtract_applied_forces(b);
    } else {
        add_equations(b);
    }
    return add_unknowns(b);
}

qdot_status
qdot_motion_of_residual(const qdot_plan *plan, const qdot_residual *residual,
                        qdot_motion *motion)
{
    const size_t inputs = 2 * plan->n + 1;
    builder b = {.plan = plan, .residual = residual, .motion = motion};
    qdot_status status;

    *motion = (qdot_motion){0};
    QDOT_TRY(qdot_program_begin(inputs, inputs, false, &motion->program, &b.program));
    status = qdot_motion_complete(motion, b.program, build_residual_motion(&b));
    qdot_free(b.inputs);
    return status;
}
