/* tables.c -- asks each tape that a plan's equations are evaluated from for the tables of data it reads. */
#include "sim/form/tables.h"

#include <math.h>

#include "base/memory.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "num/samples.h"
#include "sim/form/residual.h"
#include "sim/model/constraints.h"
#include "tape/instruction.h"

void
qdot_plan_tapes(const qdot_plan *p, const qdot_tape *tapes[QDOT_PLAN_TAPES])
{
    tapes[0] = p->tape;
    tapes[1] = p->residual ? p->residual->places : NULL;
    tapes[2] = p->residual ? p->residual->forces : NULL;
    tapes[3] = p->constraints ? p->constraints->positions : NULL;
    tapes[4] = p->constraints ? p->constraints->velocities : NULL;
    tapes[5] = p->reduced ? p->reduced->tape : NULL;
    tapes[6] = p->residual ? p->residual->adjoint : NULL;
}

bool
qdot_tables_any(const qdot_plan *plan)
{
    const qdot_tape *tapes[QDOT_PLAN_TAPES];

    qdot_plan_tapes(plan, tapes);
    for (size_t k = 0; k < QDOT_PLAN_TAPES; k++)
        if (tapes[k] && qdot_knots_any(tapes[k]))
            return true;
    return false;
}

qdot_status
qdot_tables_check_digits(const qdot_plan *plan)
{
    const qdot_tape *tapes[QDOT_PLAN_TAPES];

    qdot_plan_tapes(plan, tapes);
    for (size_t k = 0; k < QDOT_PLAN_TAPES; k++)
        if (tapes[k])
            QDOT_TRY(qdot_tape_check_digits(tapes[k]));
    return QDOT_OK;
}

qdot_status
qdot_tables_knots(const qdot_plan *plan, qdot_knots *knots)
{
    const qdot_tape *tapes[QDOT_PLAN_TAPES];

    qdot_plan_tapes(plan, tapes);
    for (size_t k = 0; k < QDOT_PLAN_TAPES; k++)
        if (tapes[k])
            QDOT_TRY(qdot_knots_find(tapes[k], 2 * plan->n, knots));
    return QDOT_OK;
}

bool
qdot_tables_ended(const qdot_plan *plan, const double *in, double *handle, double *at)
{
    const qdot_tape *tapes[QDOT_PLAN_TAPES];

    qdot_plan_tapes(plan, tapes);
    for (size_t k = 0; k < QDOT_PLAN_TAPES - 1; k++) /* what a reduced plan reads the whole one reads */
        if (tapes[k] && qdot_knots_ended(tapes[k], in, handle, at))
            return true;
    return false;
}

const char *
qdot_tables_name(const qdot_plan *plan, double handle)
{
    for (size_t i = 0; i < plan->n_values; i++) {
        qdot_expr lookup;
        int64_t own;

        if (qdot_expr_kind(plan->pool, plan->symbols[i]) != QDOT_UFUN)
            continue;
        lookup = qdot_expr_find_function(plan->pool, plan->values[i], 1, (qdot_fun_id[]){QDOT_LOOKUP}, QDOT_NIL);
        if (lookup != QDOT_NIL && qdot_expr_to_int(plan->pool, qdot_expr_arg(plan->pool, lookup, 1), &own) &&
            qdot_samples_is_same(handle, (double)own))
            return qdot_ufun_get(plan->pool, qdot_expr_node(plan->pool, plan->symbols[i])->op)->name;
    }
    return NULL;
}

/* Fail if the time t is outside the table that is read at a line. */
static qdot_status
check_time_in_table(const qdot_plan *plan, const qdot_knots_line *line, double t, bool starts)
{
    const double u = line->a + line->b * t;
    const char *name = qdot_tables_name(plan, line->handle);
    double lo, hi, end;

    if (!qdot_samples_range(line->handle, &lo, &hi) || !isnan(qdot_samples_lookup(line->handle, u)))
        return QDOT_OK;
    end = ((u < lo ? lo : hi) - line->a) / line->b;
    (void)qdot_fail(QDOT_EDOMAIN, "the data%s%.100s %s at t = %.10g: the run %s t = %.10g", name ? " of " : "", name ? name : "",
                    end < t ? "end" : "begin", end, starts ? "starts at" : "goes to", t);
    return qdot_hint("`hold` or `periodic` behind the statement `data` go on beyond the ends");
}

qdot_status
qdot_tables_reach(const qdot_plan *plan, double t0, double t1)
{
    qdot_knots knots = {0};
    qdot_status status = qdot_tables_knots(plan, &knots);

    for (size_t k = 0; k < knots.n && status == QDOT_OK; k++) {
        status = check_time_in_table(plan, &knots.at[k], t0, true);
        if (status == QDOT_OK)
            status = check_time_in_table(plan, &knots.at[k], t1, false);
    }
    qdot_free(knots.at);
    return status;
}

/* Whether a tape reads a table that jumps at knots. */
static bool
reads_steps(const qdot_tape *tape)
{
    for (size_t k = 0; k < tape->length; k++)
        if (tape->code[k].op == QDOT_OP_LOOKUP && qdot_samples_jumps(tape->constant[tape->code[k].z - tape->inputs]))
            return true;
    return false;
}

/* Whether an output of the tape jumps at the time t, for which input number `time` stands: its values just before and just behind
 * differ, and by as much ten times nearer, where those of a steep line differ by a tenth. in [inputs]; out [4 x outputs] and work
 * are scratch. */
static bool
jumps_at(const qdot_tape *tape, size_t time, double *in, double t, double *out, double *work)
{
    const double near = 1e-9 * fmax(1, fabs(t)), places[] = {-near, near, -near / 10, near / 10};
    const size_t n = qdot_tape_outputs(tape);

    for (size_t k = 0; k < 4; k++) {
        in[time] = t + places[k];
        qdot_tape_eval(tape, in, out + k * n, work);
    }
    for (size_t k = 0; k < n; k++) {
        const double by = fabs(out[k] - out[n + k]);

        if (by > 1e-5 * fmax(1, fabs(out[k])) && fabs(out[2 * n + k] - out[3 * n + k]) > by / 2)
            return true;
    }
    return false;
}

/* Whether the outputs of the tape jump at one of the first knots; y [n]. */
static qdot_status
jumps_at_knots(const qdot_tape *tape, size_t n, const double *y, double t0, double t1, bool *jumps)
{
    enum { LOOKED_AT = 16 };
    const int direction = t1 < t0 ? -1 : 1;
    qdot_knots knots = {0};
    double *in = qdot_calloc(tape->inputs + 4 * tape->outputs + tape->places + 1, sizeof *in), t = t0;
    qdot_status status = in ? qdot_knots_find(tape, n, &knots) : QDOT_ENOMEM;

    for (size_t k = 0; in && k < n; k++)
        in[k] = y[k] + 0.01 * (double)(k + 1) * fmax(1, fabs(y[k])); /* a factor that is 0 at the start hides no jump */
    for (int k = 0; k < LOOKED_AT && status == QDOT_OK && !*jumps; k++) {
        t = qdot_knots_next(knots.n, knots.at, t, direction);
        if (direction * (t1 - t) < 0)
            break;
        *jumps = jumps_at(tape, n, in, t, in + tape->inputs, in + tape->inputs + 4 * tape->outputs);
    }
    qdot_free(knots.at);
    qdot_free(in);
    return status;
}

qdot_status
qdot_tables_refuse_jumps(const qdot_plan *plan, const double *y, double t0, double t1)
{
    const qdot_tape *tapes[2] = {plan->constraints ? plan->constraints->positions : NULL,
                                 plan->constraints ? plan->constraints->velocities : NULL};
    bool jumps = false;

    for (int k = 0; k < 2 && plan->n_massless > 0 && !jumps; k++)
        if (tapes[k]) {
            if (reads_steps(tapes[k]))
                jumps = !plan->method->series; /* a Taylor step over the jump moves the rate onto its equation */
            else
                QDOT_TRY(jumps_at_knots(tapes[k], 2 * plan->n, y, t0, t1, &jumps));
        }
    if (!jumps)
        return QDOT_OK;
    (void)qdot_fail(QDOT_ENOTBUILT, "not built yet: rates of states, and equations of other coordinates without mass, that jump at points of data");
    return qdot_hint(plan->method->series ? "`linear`, and two rows a moment apart where the data jump" : "method taylor goes over the jumps of `steps`");
}
