/* value.c -- any expression along a run, and its error. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "expr/print.h"
#include "sim/constraints.h"
#include "sim/integrated.h"
#include "sim/precise.h"

/* A tape of the expressions and the states they are read at. */
typedef struct {
    const qdot_plan *plan;
    const qdot_tape *tape;
    qdot_trajectory_cursor *cursor;
    const qdot_course *course;
    bool accelerations; /* the tape reads q'' or lambda */
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
reader_init(reader *r, const qdot_plan *plan, const qdot_tape *tape,
            const qdot_course *course, bool accelerations)
{
    *r = (reader){
        .plan = plan, .tape = tape, .course = course, .accelerations = accelerations};
    r->in = qdot_calloc(qdot_tape_inputs(tape), sizeof *r->in);
    r->dydt = qdot_calloc(2 * plan->n, sizeof *r->dydt);
    r->work = qdot_calloc(qdot_tape_work(tape) + 1, sizeof *r->work);
    if (!r->in || !r->dydt || !r->work)
        return QDOT_ENOMEM;
    return qdot_trajectory_open(&course->tr, qdot_course_systems(course), &r->cursor);
}

/* out [outputs of the tape] at t; within that piece of the run, unless it is SIZE_MAX. */
static qdot_status
read_at(reader *r, size_t piece, double t, double *out)
{
    size_t n = r->plan->n;

    QDOT_TRY(piece == SIZE_MAX
                 ? qdot_trajectory_read(r->cursor, t, r->in)
                 : qdot_trajectory_read_piece(r->cursor, piece, t, r->in));
    r->in[2 * n] = t;
    if (r->accelerations) {
        size_t mode = qdot_trajectory_mode_read(r->cursor);
        const qdot_ode_system *system = qdot_course_systems(r->course) + mode;
        qdot_held *held = qdot_bind_held(r->course->binds.at[mode]);

        if (held) {
            QDOT_TRY(qdot_held_solve(held, t, r->in, r->in + 2 * n + 1,
                                     r->in + 3 * n + 1));
            qdot_tape_eval(r->tape, r->in, out, r->work);
            return QDOT_OK;
        }
        QDOT_TRY(system->rhs(t, r->in, r->dydt, system->user));
        memcpy(r->in + 2 * n + 1, r->dydt + n, n * sizeof *r->in);
    }
    qdot_tape_eval(r->tape, r->in, out, r->work);
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

/* The piece of a run that a time falls in: the later of two. */
static size_t
piece_at(const qdot_trajectory *tr, double t)
{
    size_t k = qdot_trajectory_locate(tr, t, 0), low = 0, high = tr->pieces.n;

    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;

        if (tr->pieces.at[middle].first <= k)
            low = middle;
        else
            high = middle;
    }
    return low;
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
    QDOT_TRY(qdot_run_companion(run));
    if (!qdot_run_comparable(run))
        return QDOT_OK;
    status = reader_init(&r, run->plan, tape, &run->companion, accelerations);
    for (size_t i = 0; i < k && status == QDOT_OK; i++) {
        double *e = errors + i * m;

        status = qdot_interrupt_check();
        if (status == QDOT_OK)
            status = read_at(&r, piece_at(&run->course.tr, times[i]), times[i], e);
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
        reader_init(&r, run->plan, tape, &run->course, accelerations);

    for (size_t i = 0; i < k && status == QDOT_OK; i++) {
        status = qdot_interrupt_check();
        if (status == QDOT_OK)
            status = read_at(&r, SIZE_MAX, times[i], values + i * m);
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
