/* bind.c -- the right-hand side of the equations of motion: evaluates the tape, then solves for q''. */
#include "sim/bind/bind.h"

#include <math.h>
#include <string.h>

#include "expr/symbol.h"
#include "ode/apart.h"
#include "series/taylor.h"
#include "sim/bind/bind-state.h"
#include "sim/form/residual.h"
#include "sim/form/tables.h"
#include "sim/model/delay.h"
#include "tape/rounding.h"
#include "tape/shake.h"

static const qdot_tape *
reduced_equations_tape(const qdot_bind *b)
{
    return b->reduced ? b->reduced : b->plan->reduced->tape;
}

void
qdot_bind_free(qdot_bind *b)
{
    if (!b)
        return;
    qdot_blocks_clear(&b->blocks);
    qdot_constrained_free(b->held);
    qdot_motion_series_free(b->direct);
    qdot_tree_series_free(b->tree);
    qdot_tree_series_free(b->elsewhere);
    qdot_motion_series_free(b->elsewhere_back);
    qdot_guarded_free(b->guarded);
    qdot_leading_free(b->leading);
    qdot_phase_free(b->phase);
    qdot_motion_series_free(b->tied);
    qdot_tape_free(b->tape);
    if (b->reduced_blocks.plan)
        qdot_blocks_clear(&b->reduced_blocks);
    qdot_momenta_free(b->momenta);
    qdot_tape_free(b->reduced);
    for (size_t k = 0; b->parts && k < b->plan->n_parts; k++)
        qdot_bind_free(b->parts[k]);
    qdot_free(b->parts);
    qdot_free(b->systems);
    qdot_free(b->listed);
    qdot_free(b->index);
    qdot_free(b->part_scales);
    qdot_free(b->in);
    qdot_free(b->out);
    qdot_free(b->work);
    qdot_free(b->slopes);
    qdot_free(b->slopes_work);
    qdot_free(b->knots.at);
    qdot_pulses_clear(&b->pulses);
    qdot_free(b);
}

/* --- the equations as a system of ode/ ---------------------------------------------- */

/* The accelerations of the blocks, from the outputs that begin at `out`; *end: the first output
 * after these. */
static qdot_status
solve_blocks(qdot_blocks *blocks, const double *out, double *a, const double **end)
{
    for (size_t k = 0; k < blocks->plan->structure.blocks; k++) {
        const qdot_plan_block *block = blocks->plan->blocks + k;
        double *x = blocks->at[k].x;

        if (block->n == 1) {
            a[block->index[0]] = *out++;
            continue;
        }
        memcpy(x, out, block->n * sizeof *out);
        out += block->n;
        if (!block->constant) {
            out = qdot_blocks_unpack(blocks, k, out);
            QDOT_TRY(qdot_blocks_factor(blocks, k));
        }
        qdot_blocks_solve(blocks, k, x);
        for (size_t i = 0; i < block->n; i++)
            a[block->index[i]] = x[i];
    }
    *end = out;
    return QDOT_OK;
}

/* The series of a plan without a mass matrix that is read apart from the one of the run. */
static qdot_status
make_separate_series(qdot_bind *b, const qdot_ode_series **series)
{
    const qdot_plan *p = b->plan;
    const qdot_residual *r = p->residual;

    if (r->adjoint) {
        if (!b->elsewhere_back)
            QDOT_TRY(qdot_motion_series_of_residual(p, &r->motion, NULL, b->shaken, &b->elsewhere_back));
        *series = qdot_motion_series_get(b->elsewhere_back);
        return QDOT_OK;
    }
    if (!b->elsewhere)
        QDOT_TRY(qdot_tree_series_new(p, r, b->shaken, &b->elsewhere));
    *series = qdot_tree_series_get(b->elsewhere);
    return QDOT_OK;
}

/* q'' at the inputs for a plan without a mass matrix: from the first coefficients of a series. */
static qdot_status
accelerations_from_separate_series(qdot_bind *b, double *a)
{
    const qdot_plan *p = b->plan;
    const qdot_ode_series *series;

    QDOT_TRY(make_separate_series(b, &series));
    QDOT_TRY(series->begin(b->in[2 * p->n], b->in, 1, series->user));
    for (size_t i = 0; i < p->n; i++)
        a[i] = series->x[(p->n + i) * series->stride + 1];
    return QDOT_OK;
}

/* Find the accelerations q'' at the loaded state, into a [n]. */
qdot_status
qdot_bind_accelerate(qdot_bind *b, double *a)
{
    const qdot_plan *p = b->plan;
    const double *end;

    if (b->held)
        return qdot_constrained_solve(b->held, b->in[2 * p->n], b->in, a, NULL);
    if (!p->tape)
        return accelerations_from_separate_series(b, a);
    qdot_tape_eval(qdot_bind_equations(b), b->in, b->out, b->work);
    QDOT_TRY(solve_blocks(&b->blocks, b->out, a, &end));
    for (size_t i = 0; i < p->n; i++)
        if (!isfinite(a[i]))
            return qdot_fail(QDOT_EDOMAIN, "the acceleration of %s is undefined",
                             p->names[i]);
    return QDOT_OK;
}

static qdot_status
right_hand_side(double t, const double *y, double *dydt, void *user)
{
    qdot_bind *b = user;
    size_t n = b->plan->n;

    qdot_bind_load(b, t, y);
    memcpy(dydt, y + n, n * sizeof *y);
    return qdot_bind_accelerate(b, dydt + n);
}

/* The right-hand side by the reduced plan. For cyclic coordinates, whose momenta are constant, only
 * rates are given. */
static qdot_status
reduced_right_hand_side(double t, const double *y, double *dydt, void *user)
{
    qdot_bind *b = user;
    const qdot_plan *r = b->plan->reduced;
    const size_t n = r->n;
    const double *rates;

    qdot_bind_load(b, t, y);
    memcpy(b->in + 2 * n + 1, qdot_momenta_hi(b->momenta), r->n_kept * sizeof *y);
    memcpy(dydt, y + n, n * sizeof *y);
    memset(dydt + n, 0, n * sizeof *y);
    qdot_tape_eval(reduced_equations_tape(b), b->in, b->out, b->work);
    QDOT_TRY(solve_blocks(&b->reduced_blocks, b->out, dydt + n, &rates));
    for (size_t k = 0; k < r->n_kept; k++)
        dydt[r->kept[k]] = rates[k];
    for (size_t i = 0; i < n; i++)
        if (!isfinite(dydt[i] + dydt[n + i]))
            return qdot_fail(QDOT_EDOMAIN, "the acceleration of %s is undefined",
                             r->names[i]);
    return QDOT_OK;
}

qdot_status
qdot_bind_accelerations(const qdot_ode_system *system, double t, const double *y,
                        double *a)
{
    qdot_bind *b = system->user;

    if (b->held)
        return qdot_constrained_accelerate(b->held, t, y, a);
    qdot_bind_load(b, t, y);
    return qdot_bind_accelerate(b, a);
}

/* The rounding error x of f - M a for a block, where the outputs of the tape have the errors `of`.
 * Returns the errors of the outputs after the block's. */
static const double *
sum_rounding_errors(const qdot_plan_block *block, const double *of, const double *a, double *x)
{
    const double *M = of + block->n;

    for (size_t i = 0; i < block->n; i++)
        x[i] = of[i];
    for (size_t i = 0; i < block->n && !block->constant && block->n > 1; i++)
        for (size_t j = 0; j <= i; j++, M++) {
            x[i] += *M * fabs(a[block->index[j]]);
            if (i != j)
                x[j] += *M * fabs(a[block->index[i]]);
        }
    return M;
}

/* Find the uncertainty e of q'' caused by rounding of the equations, or by underflow alone. */
static qdot_status
find_acceleration_errors(const qdot_ode_system *system, double t, const double *y, const double *a, bool underflows, double *e)
{
    qdot_bind *b = system->user;
    const qdot_plan *p = b->plan;
    const qdot_tape *tape = p->tape ? qdot_bind_equations(b) : NULL;
    const double *at;
    double *of;

    memset(e, 0, p->n * sizeof *e);
    if (b->held || !tape)
        return QDOT_OK;
    of = qdot_malloc((qdot_tape_outputs(tape) + 2 * qdot_tape_work(tape) + 1) * sizeof *of);
    if (!of)
        return QDOT_ENOMEM;
    qdot_bind_load(b, t, y);
    if (underflows)
        qdot_rounding_underflows(tape, b->in, of, of + qdot_tape_outputs(tape));
    else
        qdot_rounding_bounds(tape, b->in, NULL, of, of + qdot_tape_outputs(tape));
    at = of;
    for (size_t k = 0; k < p->structure.blocks; k++) {
        const qdot_plan_block *block = p->blocks + k;
        double *x = b->blocks.at[k].x;

        at = sum_rounding_errors(block, at, a, x);
        if (block->n > 1)
            qdot_blocks_solve(&b->blocks, k, x);
        for (size_t i = 0; i < block->n; i++)
            e[block->index[i]] = fabs(x[i]);
    }
    qdot_free(of);
    return QDOT_OK;
}

qdot_status
qdot_bind_roundings(const qdot_ode_system *system, double t, const double *y, const double *a, double *e)
{
    return find_acceleration_errors(system, t, y, a, false, e);
}

qdot_status
qdot_bind_underflows(const qdot_ode_system *system, double t, const double *y, const double *a, double *e)
{
    return find_acceleration_errors(system, t, y, a, true, e);
}

static qdot_status
project_onto_constraints(double t, double *y, double *carry, double *moved, void *user)
{
    qdot_constrained *held = ((qdot_bind *)user)->held;

    QDOT_TRY(qdot_constrained_check_accelerations(held, t, y));
    return qdot_constrained_project(t, y, carry, moved, held);
}

static double
constraint_independence(double t, const double *y, void *user)
{
    return qdot_constrained_independence(((qdot_bind *)user)->held, t, y);
}

/* Whether a step passes over forces that act for a shorter time than the step lasts (sim/bind/pulses.h). */
static qdot_status
inspect_step_for_pulses(qdot_ode_look *step, void *user)
{
    qdot_bind *b = user;
    qdot_pulses_step s = {.a = step->t,
                          .b = step->t_end,
                          .tol = step->tol,
                          .from = step->y,
                          .to = step->y_end};

    if (!b->pulses.tape)
        QDOT_TRY(qdot_pulses_init(&b->pulses, b->plan, qdot_bind_equations(b), QDOT_HIDES_QUOTIENTS,
                                  b->plan->method->multistep ? 16 : QDOT_CHEBYSHEV_MOST));
    QDOT_TRY(qdot_pulses_look(&b->pulses, &s));
    step->evaluations += s.evaluations;
    step->until = !s.missed ? s.b : s.begins != s.a ? s.begins : s.a + (s.b > s.a ? s.part : -s.part);
    return QDOT_OK;
}

static bool
may_hide_short_forces(const qdot_bind *b)
{
    return b->plan->tape && qdot_disc_may_hide(b->plan->tape, QDOT_HIDES_QUOTIENTS);
}

/* --- delays --------------------------------------------------------------------------- */

static const qdot_ode_series *
series_that_reads(const qdot_bind *b)
{
    qdot_past_read(b->history);
    return b->series;
}

static qdot_status
begin_remembering(double t, const double *y, double unit, void *user)
{
    const qdot_bind *b = user;
    const qdot_ode_series *s = series_that_reads(b);
    qdot_status status;

    if (t == b->knot)
        qdot_past_restart(b->history, t);
    qdot_past_expand(b->history, t);
    status = s->begin(t, y, unit, s->user);
    qdot_past_expand(b->history, -INFINITY);
    return status;
}

static qdot_status
extend_remembering(int p, void *user)
{
    const qdot_ode_series *s = series_that_reads(user);

    return s->extend(p, s->user);
}

static double
near_remembering(int p, double step, double least, void *user)
{
    const qdot_ode_series *s = series_that_reads(user);

    return s->near ? s->near(p, step, least, s->user) : step;
}

static qdot_status
prepare_remembering(int p, void *user)
{
    const qdot_ode_series *s = series_that_reads(user);

    return s->prepare ? s->prepare(p, s->user) : QDOT_OK;
}

/* By how much the order of a breaking point grows where the unknown of a handle is read: accelerations and rates of states are one order
 * below the unknowns, positions of what has mass one more; the unknowns are q and q' (num/past.h). */
static int
gain_of_delay(const qdot_plan *p, double handle)
{
    uint32_t called;

    (void)qdot_past_is_value(handle, &called);
    return (qdot_expr_is_coordinate(p->pool, called) ? 1 : 0) + (p->n_massless == 0 ? 1 : 0);
}

qdot_status
qdot_bind_remember(qdot_bind *b, qdot_past *history)
{
    b->history = history;
    b->knot = NAN;
    for (size_t k = 0; k < b->knots.n && history; k++)
        if (qdot_past_has(b->knots.at[k].handle))
            QDOT_TRY(qdot_past_delay(history, -b->knots.at[k].a, gain_of_delay(b->plan, b->knots.at[k].handle)));
    if (!b->series || !history)
        return QDOT_OK;
    b->remembering = *b->series;
    b->remembering.begin = begin_remembering;
    b->remembering.extend = extend_remembering;
    b->remembering.near = near_remembering;
    b->remembering.prepare = prepare_remembering;
    b->remembering.noise = NULL;
    b->remembering.ahead = NULL;
    b->remembering.crossed = NULL;
    b->remembering.user = b;
    b->remembering.most = b->series->most < QDOT_PAST_ORDER ? b->series->most : QDOT_PAST_ORDER;
    return QDOT_OK;
}

qdot_status
qdot_bind_add_knots(qdot_bind *b, const qdot_tape *tape)
{
    qdot_knots delays = {0};
    qdot_status status = b->history ? qdot_delay_find_knots(tape, 2 * b->plan->n, &delays) : QDOT_OK;

    for (size_t k = 0; k < delays.n && status == QDOT_OK; k++)
        status = qdot_past_delay(b->history, -delays.at[k].a, QDOT_PAST_SMOOTH);
    qdot_free(delays.at);
    QDOT_TRY(status);
    return qdot_knots_find(tape, 2 * b->plan->n, &b->knots);
}

/* The next time at which a step ends because a table of data that the equations read has a knot, or because of their delays. */
static double
next_knot(double t, int direction, void *user)
{
    qdot_bind *b = user;
    const double knot = qdot_knots_next(b->knots.n, b->knots.at, t, direction);

    if (!b->history)
        return knot;
    b->knot = knot;
    return fmin(knot, qdot_past_next(b->history, t));
}

qdot_constrained *
qdot_bind_held(qdot_bind *b)
{
    return b->held;
}

qdot_ode_system
qdot_bind_system(qdot_bind *b)
{
    return (qdot_ode_system){
        .n = 2 * b->plan->n,
        .rhs = b->momenta ? reduced_right_hand_side : right_hand_side,
        .jacobian = qdot_plan_needs_jacobian(b->plan) ? qdot_bind_jacobian : NULL,
        .user = b,
        .mass_form = b->mass_form.residual ? &b->mass_form : NULL,
        .halves = b->plan->halves,
        .phase = b->phase ? qdot_phase_get(b->phase) : NULL,
        .bonds = b->phase && b->held ? &b->bonds : NULL,
        .series = b->history && b->series ? &b->remembering : b->series,
        .leading = b->leading ? qdot_leading_get(b->leading) : NULL,
        .following = b->momenta ? qdot_momenta_following(b->momenta) : NULL,
        .until = b->knots.n > 0 || b->history ? next_knot : NULL,
        .look = may_hide_short_forces(b) ? inspect_step_for_pulses : NULL,
        .parts = b->listed,
        .n_parts = b->listed ? b->plan->n_parts : 0,
        .project = b->held && b->plan->treatment == QDOT_RUN_PROJECT ? project_onto_constraints : NULL,
        .margin = b->held ? constraint_independence : NULL,
        .scales = b->scales,
    };
}

qdot_status
qdot_bind_scale(qdot_bind *b, const double *scales)
{
    double *at;

    b->scales = scales;
    if (!b->listed || !scales)
        return QDOT_OK;
    if (!b->part_scales)
        b->part_scales = qdot_calloc(2 * b->plan->n, sizeof *b->part_scales);
    if (!(at = b->part_scales))
        return QDOT_ENOMEM;
    for (size_t k = 0; k < b->plan->n_parts; k++) {
        qdot_ode_part_gather(b->listed + k, scales, at);
        QDOT_TRY(qdot_bind_scale(b->parts[k], at));
        b->systems[k] = qdot_bind_system(b->parts[k]);
        at += b->systems[k].n;
    }
    return QDOT_OK;
}

qdot_status
qdot_bind_check(qdot_bind *b, double t, double *y, double *low)
{
    const qdot_plan *p = b->plan;
    qdot_tape *masses = NULL;
    qdot_status status = QDOT_OK;
    qdot_expr M = QDOT_NIL;
    double *work = NULL, m;

    if (b->held) {
        status = qdot_constrained_start(b->held, t, y, low);
        return status == QDOT_EDOMAIN ? QDOT_OK : status; /* the run itself will report an undefined force */
    }
    qdot_bind_load(b, t, y);
    for (size_t k = 0; k < p->structure.blocks && status == QDOT_OK; k++) {
        const qdot_plan_block *block = p->blocks + k;

        if (block->n > 1)
            continue; /* skip larger blocks: their solver tests for a singular mass matrix itself */
        M = p->M[block->index[0] * (p->n + 1)];
        QDOT_TRY(qdot_tape_new(p->pool, 2 * p->n + 1, p->inputs, 1, &M, &masses));
        work = qdot_malloc((qdot_tape_work(masses) + 1) * sizeof *work);
        if (work)
            qdot_tape_eval(masses, b->in, &m, work);
        status = work ? QDOT_OK : QDOT_ENOMEM;
        qdot_free(work);
        qdot_tape_free(masses);
        if (status == QDOT_OK && (p->indefinite ? m == 0 : !(m > 0)))
            status = qdot_blocks_singular(p, block, 0);
    }
    if (status == QDOT_OK) {
        status = qdot_bind_accelerate(b, b->in + 2 * p->n + 1);
        if (status == QDOT_EDOMAIN) /* not an error here: the run reports with its time where the equations are undefined */
            status = QDOT_OK;
    }
    return status;
}

void
qdot_bind_tell_code(const qdot_bind *b, qdot_text *to)
{
    const char *why = "machine code is made where equations are taken as M q'' = f";
    const size_t bytes = b->direct    ? qdot_motion_series_code(b->direct, &why)
                         : b->guarded ? qdot_guarded_code(b->guarded, &why)
                                      : 0;

    if (b->tree)
        qdot_text_add(to, "kernels, like steps as vectors");
    else if (bytes > 0)
        qdot_text_format(to, "machine code for %s, %.1f kB",
                         b->plan->form == QDOT_FORM_RESIDUAL ? "AVX2" : qdot_taylor_code_kind(),
                         1e-3 * (double)bytes);
    else
        qdot_text_format(to, "kernels; %s", why);
}

size_t
qdot_bind_factored(const qdot_bind *b)
{
    size_t parts = 0;

    for (size_t k = 0; b->parts && k < b->plan->n_parts; k++)
        parts += qdot_bind_factored(b->parts[k]);
    return parts + b->blocks.factored +
           (b->held ? qdot_constrained_factored(b->held) : 0) +
           (b->tied ? qdot_motion_series_factored(b->tied) : 0) +
           (b->direct ? qdot_motion_series_factored(b->direct) : 0) +
           (b->tree ? qdot_tree_series_eliminated(b->tree) : 0) +
           b->reduced_blocks.factored;
}

/* Make the constraint solver, which keeps the state on the constraints. */
static qdot_status
make_constraint_solver(qdot_bind *b, bool shaken)
{
    const qdot_plan *p = b->plan;

    QDOT_TRY(qdot_constrained_new(p, shaken, &b->held));
    b->bonds = qdot_constrained_bonds(b->held);
    if (!p->smooth)
        return QDOT_OK;
    QDOT_TRY(qdot_motion_series_of_constraints(p, shaken, &b->tied));
    b->series = qdot_motion_series_get(b->tied);
    if (p->form != QDOT_FORM_ELIMINATED && p->form != QDOT_FORM_BORDERED)
        return QDOT_OK;
    QDOT_TRY(qdot_guarded_new(p, p->eliminated ? p->eliminated : p, shaken, b->series, &b->guarded));
    b->series = qdot_guarded_series(b->guarded);
    return QDOT_OK;
}

/* Make one bind for each part of a plan whose equations decouple. */
static qdot_status
make_part_binds(qdot_bind *b, bool shaken)
{
    const qdot_plan *p = b->plan;
    qdot_ode_part *listed;
    size_t *at;

    if (p->n_parts == 0)
        return QDOT_OK;
    b->parts = qdot_calloc(p->n_parts, sizeof(qdot_bind *));
    b->systems = qdot_calloc(p->n_parts, sizeof *b->systems);
    b->listed = listed = qdot_calloc(p->n_parts, sizeof *listed);
    b->index = at = qdot_calloc(2 * p->n, sizeof *b->index);
    if (!b->parts || !b->systems || !listed || !at)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < p->n_parts; k++) {
        const qdot_plan *r = p->parts[k];

        QDOT_TRY(qdot_bind_new(r, shaken, &b->parts[k]));
        b->systems[k] = qdot_bind_system(b->parts[k]);
        listed[k] = (qdot_ode_part){b->systems + k, at};
        for (size_t i = 0; i < 2 * r->n; i++)
            *at++ = i < r->n ? r->place[i] : p->n + r->place[i - r->n];
    }
    return QDOT_OK;
}

/* Make the double-double evaluation of the first Taylor coefficients for plan p. */
static qdot_status
make_leading_coefficients(qdot_bind *b, const qdot_plan *p)
{
    return b->plan->leading ? qdot_leading_new(p, b->series, &b->leading) : QDOT_OK;
}

/* Make the system of the reduced plan, in which the momenta of cyclic coordinates are constant. */
static qdot_status
make_reduced_system(qdot_bind *b, bool shaken)
{
    const qdot_plan *r = b->plan->reduced;

    if (shaken)
        QDOT_TRY(qdot_tape_shake(r->tape, &b->reduced));
    QDOT_TRY(qdot_blocks_init(&b->reduced_blocks, r, shaken));
    QDOT_TRY(qdot_momenta_new(r, reduced_equations_tape(b), &b->momenta));
    if (!r->smooth)
        return QDOT_OK;
    QDOT_TRY(qdot_motion_series_new(r, shaken, &b->direct));
    qdot_motion_series_keep(b->direct, qdot_momenta_hi(b->momenta), qdot_momenta_lo(b->momenta));
    b->series = qdot_motion_series_get(b->direct);
    QDOT_TRY(make_leading_coefficients(b, r));
    if (b->leading)
        qdot_leading_keep(b->leading, qdot_momenta_hi(b->momenta),
                          qdot_momenta_lo(b->momenta));
    return QDOT_OK;
}

/* Allocate work space for M q'' = f, unless the plan has only the recursive equations of a tree. */
static qdot_status
make_equation_solvers(qdot_bind *b, bool shaken)
{
    if (shaken)
        QDOT_TRY(qdot_tape_shake(b->plan->tape, &b->tape));
    QDOT_TRY(make_part_binds(b, shaken));
    return qdot_blocks_init(&b->blocks, b->plan, shaken);
}

static qdot_status
make_bind(qdot_bind *b, bool shaken)
{
    const qdot_plan *p = b->plan;
    const qdot_tape *tapes[2] = {p->tape, p->reduced ? p->reduced->tape : NULL};
    size_t out = 0, work = 0;

    for (int i = 0; i < 2; i++)
        if (tapes[i]) {
            out = qdot_tape_outputs(tapes[i]) > out ? qdot_tape_outputs(tapes[i]) : out;
            work = qdot_tape_work(tapes[i]) > work ? qdot_tape_work(tapes[i]) : work;
        }
    b->in = qdot_calloc(3 * p->n + 1, sizeof *b->in);
    b->out = qdot_calloc(out + 1, sizeof *b->out);
    b->work = qdot_calloc(work + 1, sizeof *b->work);
    if (!b->in || !b->out || !b->work)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_tables_knots(p, &b->knots));
    QDOT_TRY(qdot_bind_make_slopes(b));
    if (p->phase_space)
        QDOT_TRY(qdot_phase_new(p->phase_space, &b->phase));
    if (p->constraints)
        return make_constraint_solver(b, shaken);
    if (p->tape)
        QDOT_TRY(make_equation_solvers(b, shaken));
    if (p->reduced)
        return make_reduced_system(b, shaken);
    if (!p->smooth)
        return QDOT_OK;
    if (p->form == QDOT_FORM_TREE) {
        QDOT_TRY(qdot_tree_series_new(p, p->residual, shaken, &b->tree));
        b->series = qdot_tree_series_get(b->tree);
        return make_leading_coefficients(b, p);
    }
    QDOT_TRY(p->form == QDOT_FORM_RESIDUAL
                 ? qdot_motion_series_of_residual(p, &p->residual->motion, p->residual->masses,
                                                  shaken, &b->direct)
                 : qdot_motion_series_new(p, shaken, &b->direct));
    b->series = qdot_motion_series_get(b->direct);
    return make_leading_coefficients(b, p);
}

qdot_status
qdot_bind_new(const qdot_plan *plan, bool shaken, qdot_bind **bind)
{
    qdot_bind *b = qdot_calloc(1, sizeof *b);
    qdot_status status;

    *bind = NULL;
    if (!b)
        return QDOT_ENOMEM;
    b->plan = plan;
    b->shaken = shaken;
    status = make_bind(b, shaken);
    if (status != QDOT_OK) {
        qdot_bind_free(b);
        b = NULL;
    }
    *bind = b;
    return status;
}
