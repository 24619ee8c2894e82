/* motion-of-constraints.c -- writes M q'' + A^T mu = f and the constraints as rows of a series program. */
#include "sim/form/motion-of-constraints.h"

#include "base/memory.h"
#include "sim/model/constrained.h"
#include "sim/model/constraints.h"

typedef struct {
    const qdot_plan *plan;
    const qdot_constraints *c;
    qdot_motion *motion;
    qdot_program_builder *program;
    qdot_program_row *inputs;          /* [2n + 1] program rows of the inputs q, q', t */
    qdot_program_row *f, *M, *A, *row; /* program rows of outputs f [n], M [n_masses], A [n_slopes], constraints [m] */
    qdot_motion_line *lines; /* [n + m] equations of the accelerations a, then of the multipliers mu */
} builder;

static qdot_program_row
add_operation(const builder *b, qdot_op op, qdot_program_row x, qdot_program_row y,
              qdot_program_row z)
{
    return qdot_program_operation(b->program, op, x, y, z);
}

/* Add the program row that computes sum + factor * x. */
static qdot_program_row
add_scaled_row(const builder *b, double factor, qdot_program_row x, qdot_program_row sum)
{
    const qdot_program_constant c = {.value = factor, .exact = QDOT_NIL};

    return add_operation(b, QDOT_OP_MADD, qdot_program_number(b->program, c), x, sum);
}

static void
add_constraint(const builder *b, size_t k)
{
    const double r = b->plan->treatment == QDOT_RUN_BAUMGARTE ? QDOT_CONSTRAINED_RATE : 0;
    qdot_program_row *E = &b->lines[b->plan->n + k].E;

    if (b->c->rows[k].kind == QDOT_ACCELERATION) {
        b->lines[b->plan->n + k].right = b->row[k];
        return;
    }
    *E = qdot_program_rate(b->program, b->row[k]);
    if (b->c->rows[k].kind == QDOT_VELOCITY) {
        *E = r > 0 ? add_scaled_row(b, r, b->row[k], *E) : *E;
        return;
    }
    if (r > 0)
        *E = add_scaled_row(b, 2 * r, b->row[k], *E);
    *E = qdot_program_rate(b->program, *E);
    if (r > 0)
        *E = add_scaled_row(b, r * r, b->row[k], *E);
}

static qdot_status
set_matrix_entry(const builder *b, size_t i, size_t j, qdot_program_row K)
{
    return qdot_vec_push(&b->motion->entries,
                         ((qdot_motion_entry){(uint32_t)i, (uint32_t)j, K}));
}

static qdot_status
add_equations(builder *b)
{
    const qdot_constraints *c = b->c;
    const size_t n = b->plan->n;
    size_t steps;

    for (size_t i = 0; i < n + c->m; i++)
        b->lines[i] =
            (qdot_motion_line){qdot_program_unknown(b->program), QDOT_NO_ROW, QDOT_NO_ROW};
    for (size_t k = 0; k < c->n_masses; k++)
        QDOT_TRY(set_matrix_entry(b, c->masses[k].row, c->masses[k].column, b->M[k]));
    for (size_t k = 0; k < c->n_slopes; k++) {
        if (c->sign[k] < 0)
            b->A[k] = add_operation(b, QDOT_OP_NEG, b->A[k], 0, 0);
        QDOT_TRY(set_matrix_entry(b, n + c->slopes[k].row, c->slopes[k].column, b->A[k]));
    }
    for (size_t k = 0; k < c->m; k++)
        add_constraint(b, k);
    qdot_motion_write(b->motion, b->program, 0, b->lines, n, n + c->m);
    for (size_t i = 0; i < n + c->m; i++)
        b->lines[i].right = i < n ? b->f[i] : QDOT_NO_ROW;
    steps = b->motion->program.steps.n;
    qdot_motion_write(b->motion, b->program, 0, b->lines, 0, n);
    b->motion->written = b->motion->program.steps.n - steps;
    return QDOT_OK;
}

static qdot_status
add_unknowns(const builder *b)
{
    const size_t n = b->plan->n;

    for (size_t i = 0; i < n + b->c->m; i++) {
        qdot_motion_unknown u = {
            .row = b->lines[i].u, .once = QDOT_NO_ROW, .twice = QDOT_NO_ROW};

        if (i < n) {
            u.once = (qdot_program_row)(n + i);
            u.twice = (qdot_program_row)i;
            QDOT_TRY(qdot_vec_push(&b->motion->right, b->f[i]));
        }
        QDOT_TRY(qdot_motion_solve(b->motion, u, b->lines[i].E));
    }
    return qdot_motion_end_block(b->motion);
}

static qdot_status
build_constrained_motion(builder *b)
{
    const size_t n = b->plan->n, m = b->c->m, inputs = 2 * n + 1;
    const size_t outputs = n + b->c->n_masses + b->c->n_slopes + m;

    b->inputs = qdot_calloc(inputs + outputs, sizeof *b->inputs);
    b->lines = qdot_calloc(n + m, sizeof *b->lines);
    if (!b->inputs || !b->lines)
        return QDOT_ENOMEM;
    b->f = b->inputs + inputs;
    b->M = b->f + n;
    b->A = b->M + b->c->n_masses;
    b->row = b->A + b->c->n_slopes;
    for (size_t i = 0; i < inputs; i++)
        b->inputs[i] = (qdot_program_row)i;
    qdot_program_append(b->program, b->c->series, b->inputs, b->f);
    QDOT_TRY(add_equations(b));
    return add_unknowns(b);
}

qdot_status
qdot_motion_of_constraints(qdot_plan *plan)
{
    qdot_motion *motion = &plan->constraints->motion;
    const size_t inputs = 2 * plan->n + 1;
    builder b = {.plan = plan, .c = plan->constraints, .motion = motion};
    qdot_status status;

    qdot_motion_clear(motion);
    QDOT_TRY(qdot_program_begin(inputs, inputs, false, &motion->program, &b.program));
    status = qdot_motion_complete(motion, b.program, build_constrained_motion(&b));
    qdot_free(b.inputs);
    qdot_free(b.lines);
    return status;
}
