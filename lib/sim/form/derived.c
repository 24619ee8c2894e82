/* derived.c -- makes the Taylor series program of a plan, and frees plans. */
#include "sim/form/derived.h"

#include "sim/form/canonical.h"
#include "sim/form/phase-space.h"
#include "base/memory.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "sim/form/motion-of-equations.h"
#include "sim/form/residual.h"
#include "sim/model/constraints.h"

static void
free_motion(qdot_plan *plan)
{
    if (plan->motion)
        qdot_motion_clear(plan->motion);
    qdot_free(plan->motion);
    plan->motion = NULL;
}

qdot_status
qdot_plan_make_motion(qdot_plan *plan)
{
    free_motion(plan);
    plan->motion = qdot_calloc(1, sizeof *plan->motion);
    return plan->motion ? qdot_motion_of_equations(plan, plan->motion) : QDOT_ENOMEM;
}

qdot_status
qdot_plan_make_motion_of_members(qdot_plan *plan)
{
    free_motion(plan);
    plan->motion = qdot_calloc(1, sizeof *plan->motion);
    return plan->motion ? qdot_motion_of_members(plan, plan->motion) : QDOT_ENOMEM;
}

void
qdot_plan_drop_bordered(qdot_plan *plan)
{
    qdot_tape_free(plan->bordered);
    plan->bordered = NULL;
    free_motion(plan);
}

void
qdot_plan_free(qdot_plan *p)
{
    if (!p || p->uses-- > 0)
        return;
    for (size_t b = 0; p->blocks && b < p->structure.blocks; b++) {
        qdot_free(p->blocks[b].M);
        qdot_free(p->blocks[b].side);
    }
    for (size_t i = 0; p->names && i < p->n; i++)
        qdot_free(p->names[i]);
    qdot_free(p->blocks);
    qdot_structure_clear(&p->structure);
    qdot_free(p->names);
    qdot_free(p->inputs);
    qdot_free(p->multipliers);
    qdot_free(p->scaled);
    qdot_free(p->M);
    qdot_free(p->f);
    qdot_free(p->massless);
    qdot_free(p->symbols);
    qdot_free(p->values);
    qdot_tape_free(p->tape);
    qdot_residual_free(p->residual);
    qdot_canonical_free(p->canonical);
    qdot_phase_space_free(p->phase_space);
    qdot_constraints_free(p->constraints);
    for (size_t k = 0; k < p->n_parts; k++)
        qdot_plan_free(p->parts[k]);
    qdot_free(p->parts);
    qdot_free(p->place);
    qdot_plan_free(p->reduced);
    qdot_plan_free(p->eliminated);
    qdot_free(p->kept);
    qdot_tape_free(p->momenta);
    qdot_tape_free(p->bordered);
    qdot_free(p->share);
    qdot_free(p->read_side);
    free_motion(p);
    qdot_free(p);
}

size_t
qdot_plan_operations(const qdot_plan *p, size_t *calls)
{
    const qdot_plan *moving = p->reduced ? p->reduced : p;
    const qdot_tape *tapes[] = {moving->tape, NULL, NULL};
    size_t operations = 0, of_calls = 0;

    if (!moving->tape) {
        tapes[0] = moving->residual->places;
        tapes[1] = moving->residual->adjoint ? moving->residual->adjoint : moving->residual->forces;
        tapes[2] = moving->residual->adjoint ? moving->residual->forces : NULL;
    }
    for (int i = 0; i < 3 && tapes[i]; i++) {
        operations += qdot_tape_operations(tapes[i]);
        of_calls += qdot_tape_calls(tapes[i]);
    }
    if (calls)
        *calls = of_calls;
    return operations;
}

static bool
holds_time(const qdot_plan *p, qdot_expr e)
{
    return (qdot_expr_node(p->pool, e)->holds & QDOT_HAS_TIME) != 0;
}

bool
qdot_plan_is_driven(const qdot_plan *p)
{
    bool time = false;

    for (size_t i = 0; i < p->n && !p->M; i++)
        time |= holds_time(p, p->residual->applied[i]); /* only forces need a test: positions do not depend on t */
    for (size_t i = 0; i < p->n && p->M; i++) {
        time |= holds_time(p, p->f[i]);
        for (size_t j = 0; j < p->n; j++)
            time |= holds_time(p, p->M[i * p->n + j]);
    }
    for (size_t i = 0; p->constraints && i < p->constraints->m; i++)
        time |= holds_time(p, p->constraints->rows[i].f);
    return time;
}
