/* joint.c -- combines several runs: an expression of values along all of them, as a function of t. */
#include "sim/read/joint.h"

#include <string.h>

#include "expr/calculus.h"
#include "expr/symbol.h"
#include "sim/course/run-state.h"

void
qdot_joint_clear(qdot_joint *j)
{
    qdot_free(j->plans);
    qdot_free(j->courses);
    qdot_free(j->inputs);
    qdot_tape_free(j->of.tape);
    *j = (qdot_joint){0};
}

/* Make new symbols for the inputs of the k-th run's tape; the first run keeps its own symbols. */
static qdot_status
make_input_symbols(const qdot_plan *plan, size_t k, qdot_expr *own)
{
    qdot_text name = {0};
    qdot_status status = QDOT_OK;

    if (k == 0)
        memcpy(own, plan->inputs, qdot_plan_inputs(plan) * sizeof *own);
    for (size_t i = 0; k > 0 && i < qdot_plan_inputs(plan) && status == QDOT_OK; i++) {
        qdot_text_clear(&name);
        qdot_text_format(&name, "%zu#%s", k,
                         qdot_expr_symbol(plan->pool, plan->inputs[i])->name);
        status = qdot_text_status(&name);
        if (status == QDOT_OK)
            own[i] = qdot_symbol_get(plan->pool, QDOT_FORMAL, qdot_text_str(&name));
    }
    qdot_text_clear(&name);
    return status == QDOT_OK ? qdot_pool_check(plan->pool) : status;
}

/* Express the value of member m by the inputs `own` of its run, and by t, which all runs share. */
static qdot_expr
express_member(qdot_joint *j, const qdot_run_member *m, const qdot_expr *own)
{
    const qdot_plan *plan = j->plans[m->run];
    const size_t time = 2 * plan->n, behind = time + 1;
    qdot_expr e = qdot_plan_reading(plan, m->value);

    j->of.accelerations =
        j->of.accelerations || qdot_reading_of_accelerations(plan->pool, e);
    if (m->run > 0)
        e = qdot_reader_own_history(plan, e, own);
    e = qdot_subs(plan->pool, e, time, plan->inputs, own);
    return qdot_subs(plan->pool, e, qdot_plan_inputs(plan) - behind, plan->inputs + behind,
                     own + behind);
}

/* Make the inputs of all runs, and replace the members in the expression by their values. */
static qdot_status
combine_inputs_and_expression(qdot_joint *j, const qdot_run_expression *x, size_t *begin, qdot_expr *from, qdot_expr *to)
{
    for (size_t k = 0; k < x->n; k++) {
        QDOT_TRY(make_input_symbols(j->plans[k], k, j->inputs + begin[k]));
        begin[k + 1] = begin[k] + qdot_plan_inputs(j->plans[k]);
    }
    for (size_t i = 0; i < x->m; i++) {
        from[i] = x->members[i].symbol;
        to[i] = express_member(j, x->members + i, j->inputs + begin[x->members[i].run]);
    }
    j->e = qdot_subs(j->plans[0]->pool, x->e, x->m, from, to);
    return qdot_pool_check(j->plans[0]->pool);
}

qdot_status
qdot_joint_init(qdot_joint *j, const qdot_run_expression *x)
{
    size_t inputs = 0, *begin;
    qdot_expr *from;
    qdot_status status;

    *j = (qdot_joint){0};
    j->plans = qdot_calloc(x->n, sizeof *j->plans);
    j->courses = qdot_calloc(x->n, sizeof *j->courses);
    if (!j->plans || !j->courses)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < x->n; k++) {
        j->plans[k] = x->runs[k]->plan;
        j->courses[k] = &x->runs[k]->course;
        inputs += qdot_plan_inputs(j->plans[k]);
    }
    j->inputs = qdot_calloc(inputs, sizeof *j->inputs);
    begin = qdot_calloc(x->n + 1, sizeof *begin);
    from = qdot_calloc(2 * x->m + 1, sizeof *from);
    status = j->inputs && begin && from ? combine_inputs_and_expression(j, x, begin, from, from + x->m) : QDOT_ENOMEM;
    qdot_free(begin);
    qdot_free(from);
    j->of.plan = j->plans[0];
    j->of.n_more = x->n - 1;
    j->of.more = j->plans + 1;
    j->of.inputs = j->inputs;
    return status == QDOT_OK ? qdot_reader_lower_beside(&j->of, 1, &j->e, &j->of) : status;
}
