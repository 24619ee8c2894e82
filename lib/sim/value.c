/* value.c -- any expression along a run, and its error. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "expr/print.h"
#include "ode/companion.h"
#include "sim/constraints.h"
#include "sim/integrated.h"
#include "sim/precise.h"
#include "tape/shake.h"

/* A tape of the expressions and the states they are read at. */
typedef struct {
    const qdot_plan *plan;
    const qdot_tape *tape;
    qdot_trajectory_cursor *cursor;
    qdot_ode_system system;
    bool accelerations; /* the tape reads q'' or lambda */
    qdot_held *held;    /* of a scene with constraints */
    double *in;         /* [3n + 1 + m] */
    double *dydt;       /* [2n] */
    double *work;
} reader;

static void
reader_clear(reader *r)
{
    qdot_trajectory_close(r->cursor);
    qdot_free(r->in);
    qdot_free(r->dydt);
    qdot_free(r->work);
}

static qdot_status
reader_init(reader *r, const qdot_plan *plan, const qdot_tape *tape, qdot_bind *bind,
            const qdot_trajectory *tr, bool accelerations)
{
    *r = (reader){.plan = plan, .tape = tape, .accelerations = accelerations};
    r->system = qdot_bind_system(bind);
    r->held = qdot_bind_held(bind);
    r->in = qdot_calloc(qdot_tape_inputs(tape), sizeof *r->in);
    r->dydt = qdot_calloc(2 * plan->n, sizeof *r->dydt);
    r->work = qdot_calloc(qdot_tape_work(tape) + 1, sizeof *r->work);
    if (!r->in || !r->dydt || !r->work)
        return QDOT_ENOMEM;
    return qdot_trajectory_open(tr, &r->system, &r->cursor);
}

/* out [outputs of the tape] at t. */
static qdot_status
read_at(reader *r, double t, double *out)
{
    size_t n = r->plan->n;

    QDOT_TRY(qdot_trajectory_read(r->cursor, t, r->in));
    r->in[2 * n] = t;
    if (r->accelerations && r->held) {
        QDOT_TRY(qdot_held_solve(r->held, t, r->in, r->in + 2 * n + 1,
                                 r->in + 3 * n + 1));
    } else if (r->accelerations) {
        QDOT_TRY(r->system.rhs(t, r->in, r->dydt, r->system.user));
        memcpy(r->in + 2 * n + 1, r->dydt + n, n * sizeof *r->in);
    }
    qdot_tape_eval(r->tape, r->in, out, r->work);
    return QDOT_OK;
}

/* --- the second run ----------------------------------------------------------------- */

/* Its trajectory, over all that the run covers; where it ends early errors are
 * unknown. */
static qdot_status
make_companion(qdot_run *run)
{
    const qdot_ode_method *method = run->plan->method;
    qdot_ode_options options = {.order_more = QDOT_COMPANION_ORDERS};
    double t0 = qdot_shake_double(run->t0, run->t0_side);
    double t1 = run->tr.t[run->tr.count - 1];
    qdot_ode_system system;
    double *y;
    qdot_status status;

    if (run->has_companion)
        return QDOT_OK;
    if (!run->shaken) {
        status = qdot_bind_new(run->plan, true, &run->shaken);
        if (status != QDOT_OK)
            return status == QDOT_ESINGULAR ? QDOT_OK : status;
    }
    system = qdot_bind_system(run->shaken);
    if (method->stiff) /* series may get stuck */
        system.series = NULL;
    options.tol = qdot_companion_tolerance(&system, method, run->report.tol);
    y = qdot_malloc(system.n * sizeof *y);
    if (!y)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < system.n; i++)
        y[i] = qdot_companion_moved(run->start[i], i, 0);
    if (system.project) {
        double by;

        status = system.project(t0, y, NULL, &by, system.user);
        if (status != QDOT_OK) {
            qdot_free(y);
            return status == QDOT_ENOMEM ? status : QDOT_OK;
        }
    }
    status =
        qdot_trajectory_run(&run->companion, &system,
                            qdot_companion_method(&system, method), &options, t0, t1, y);
    qdot_free(y);
    if (status == QDOT_EINTR || status == QDOT_ENOMEM)
        return status;
    run->has_companion = true;
    return QDOT_OK;
}

/* --- asking ------------------------------------------------------------------------- */

static qdot_status
undefined(const qdot_run *run, qdot_expr e, double t)
{
    qdot_text text = {0};
    qdot_status status = qdot_print(run->plan->pool, e, QDOT_PLAIN, &text);

    if (status == QDOT_OK)
        status = qdot_fail(QDOT_EDOMAIN, "%.200s is undefined at t = %.15g",
                           qdot_text_str(&text), t);
    qdot_text_clear(&text);
    return status;
}

static qdot_status
read_errors(qdot_run *run, const qdot_tape *tape, bool accelerations, size_t k,
            const double *times, const double *values, double *errors)
{
    size_t m = qdot_tape_outputs(tape);
    reader r = {0};
    qdot_status status;

    for (size_t i = 0; i < k * m; i++)
        errors[i] = NAN;
    QDOT_TRY(make_companion(run));
    if (!run->has_companion || run->companion.count == 0)
        return QDOT_OK;
    status =
        reader_init(&r, run->plan, tape, run->shaken, &run->companion, accelerations);
    for (size_t i = 0; i < k && status == QDOT_OK; i++) {
        double *e = errors + i * m;

        status = qdot_interrupt_check();
        /* The companion's first point may lie one double beside t0. */
        if (status == QDOT_OK)
            status = read_at(&r, times[i] == run->t0 ? run->companion.t[0] : times[i], e);
        if (status == QDOT_EDOMAIN || status == QDOT_EFAILED
            || status == QDOT_ESINGULAR) {
            for (size_t j = 0; j < m; j++)
                e[j] = NAN;
            status = QDOT_OK;
            continue;
        }
        for (size_t j = 0; j < m && status == QDOT_OK; j++) {
            double x = values[i * m + j];

            e[j] = fabs(e[j] - x) + DBL_EPSILON * fabs(x);
        }
    }
    reader_clear(&r);
    return status;
}

static qdot_status
read_values(qdot_run *run, const qdot_tape *tape, bool accelerations,
            const qdot_expr *exprs, size_t k, const double *times, double *values)
{
    size_t m = qdot_tape_outputs(tape);
    reader r = {0};
    qdot_status status =
        reader_init(&r, run->plan, tape, run->bind, &run->tr, accelerations);

    for (size_t i = 0; i < k && status == QDOT_OK; i++) {
        status = qdot_interrupt_check();
        if (status == QDOT_OK)
            status = read_at(&r, times[i], values + i * m);
        for (size_t j = 0; j < m && status == QDOT_OK; j++)
            if (!isfinite(values[i * m + j]))
                status = undefined(run, exprs[j], times[i]);
    }
    reader_clear(&r);
    return status;
}

static qdot_status
lower(const qdot_run *run, size_t m, const qdot_expr *exprs, qdot_tape **tape,
      bool *accelerations)
{
    const qdot_plan *p = run->plan;
    const size_t rows = p->constraints ? p->constraints->m : 0;
    qdot_expr *e = qdot_malloc((m + 1) * sizeof *e);
    qdot_status status = e ? QDOT_OK : QDOT_ENOMEM;

    *accelerations = false;
    for (size_t j = 0; j < m && status == QDOT_OK; j++) {
        e[j] = qdot_plan_substitute(p, exprs[j]);
        status = qdot_pool_check(p->pool);
        if (status == QDOT_OK
            && qdot_expr_node(p->pool, e[j])->holds
                   & (QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER))
            *accelerations = true;
    }
    if (status == QDOT_OK)
        status = qdot_tape_new(p->pool, 3 * p->n + 1 + rows, p->inputs, m, e, tape);
    qdot_free(e);
    return status;
}

qdot_status
qdot_run_values(qdot_run *run, size_t m, const qdot_expr *exprs, size_t k,
                const double *times, double *values, double *errors)
{
    bool accelerations;
    qdot_tape *tape;
    qdot_status status;

    if (run->precise)
        return qdot_precise_pair_sample_values(run->precise, m, exprs, k, times, values,
                                               errors);
    QDOT_TRY(lower(run, m, exprs, &tape, &accelerations));
    status = read_values(run, tape, accelerations, exprs, k, times, values);
    if (status == QDOT_OK && errors)
        status = read_errors(run, tape, accelerations, k, times, values, errors);
    qdot_tape_free(tape);
    return status;
}
