/* precise-course.c -- runs in MPFR piece by piece: locates the end of each and applies the change
 * of state there. */
#include "sim/digits/precise-course.h"

#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "sim/digits/precise-formula.h"
#include "sim/digits/precise-hold.h"

#define RN MPFR_RNDN

/* Largest distance of a root from the same root in doubles, as a fraction of the piece's duration. */
static const double pad = 0x1p-8;

enum { MOST_BOUNCES = 1000000 };

/* Functions are computed with this many times the state's digits: even a multiple root keeps the accuracy. */
enum { FLAT = 8 };

/* --- preparing a course in MPFR ------------------------------------------------------ */

void
qdot_precise_course_clear(qdot_precise_side *s)
{
    if (!s->course)
        return;
    for (size_t i = 0; i < s->course->formulas.n; i++)
        qdot_precise_free(s->course->formulas.at[i].program);
    qdot_free(s->course->formulas.at);
    for (size_t i = 0; i < s->course->holds.n; i++)
        qdot_precise_hold_free(s->course->holds.at[i]);
    qdot_free(s->course->holds.at);
    qdot_free(s->course->set);
    qdot_free(s->course->segment_of);
    qdot_reals_clear(&s->course->numbers);
    qdot_free(s->course);
    s->course = NULL;
}

static const qdot_mode *
mode_at_index(const qdot_precise_side *s, size_t mode)
{
    return s->guide->stage->modes.at[mode];
}

static qdot_precise_formula *
find_formula(const qdot_precise_side *s, size_t mode, size_t function, size_t event)
{
    for (size_t i = 0; i < s->course->formulas.n; i++) {
        qdot_precise_formula *f = &s->course->formulas.at[i];

        if (f->function == function && f->event == event
            && (function == SIZE_MAX || f->mode == mode))
            return f;
    }
    return NULL;
}

static qdot_status
add_formula(qdot_precise_side *s, size_t mode, size_t function, size_t event)
{
    const qdot_mode *m = mode_at_index(s, mode);
    const qdot_plan *p = m->plan;
    qdot_precise_formula f = {.mode = mode, .function = function, .event = event};
    qdot_tape *own = NULL;
    const qdot_tape *tape;
    qdot_status status = QDOT_OK;

    if (find_formula(s, mode, function, event))
        return QDOT_OK;
    if (function == SIZE_MAX) {
        tape = s->guide->stage->events.at[event].then;
        f.accelerations = s->guide->stage->events.at[event].accelerations;
    } else {
        const qdot_expr e = event == QDOT_PRECISE_RATE ? qdot_ddt(p->pool, m->functions[function])
                                          : m->functions[function];

        QDOT_TRY(qdot_pool_check(p->pool));
        status = qdot_tape_new(p->pool, qdot_plan_inputs(p), p->inputs, 1, &e, &own);
        tape = own;
        f.accelerations = qdot_expr_node(p->pool, e)->holds
                          & (QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER);
    }
    if (status == QDOT_OK)
        status = qdot_tape_check_digits(tape);
    if (status == QDOT_OK)
        status = qdot_precise_new(p->pool, tape, 0, (function == SIZE_MAX ? 1 : FLAT) * s->start.bits, &f.program);
    qdot_tape_free(own);
    if (status == QDOT_OK && (status = qdot_vec_push(&s->course->formulas, f)) != QDOT_OK)
        qdot_precise_free(f.program);
    return status;
}

/* Prepare the projection that brings states of a mode onto its constraints after an event changed them. */
static qdot_status
add_projection(qdot_precise_side *s, size_t mode)
{
    while (s->course->holds.n <= mode)
        QDOT_TRY(qdot_vec_push(&s->course->holds, NULL));
    return s->course->holds.at[mode] != NULL
               ? QDOT_OK
               : qdot_precise_hold_new(mode_at_index(s, mode)->plan, s->start.bits,
                                       &s->course->holds.at[mode]);
}

static size_t
piece_at_time(const qdot_course *g, double t)
{
    return qdot_trajectory_piece_of(&g->tr, qdot_trajectory_locate(&g->tr, t, 0));
}

/* Among the ends [n] of piece k the one at which a lasting contact begins; NULL: none. *many:
 * several contacts begin. */
static const qdot_course_end *
find_start_of_contact(const qdot_course *g, size_t k, const qdot_course_end *ends, size_t n, bool *many)
{
    const qdot_switches *x = &g->stage->switches;
    const qdot_course_end *found = NULL;
    size_t count = 0;

    for (size_t i = qdot_switches_own(x); k + 1 < g->tr.pieces.n && i < x->surfaces.n; i++) {
        const qdot_mode *from = g->stage->modes.at[g->tr.pieces.at[k].mode];
        const qdot_mode *to = g->stage->modes.at[g->tr.pieces.at[k + 1].mode];

        if (!x->surfaces.at[i].contact || to->side[i] != QDOT_SIDE_SLIDES
            || from->side[i] == QDOT_SIDE_SLIDES)
            continue;
        count++;
        for (size_t j = 0; j < n; j++)
            if (ends[j].what.kind == QDOT_WATCH_EVENT
                && ends[j].what.index == x->surfaces.at[i].event)
                found = &ends[j];
    }
    *many = count > 1;
    return found;
}

qdot_status
qdot_precise_beyond_doubles(double t)
{
    qdot_fail(QDOT_ELIMIT,
              "what happens at t = %.15g cannot be told apart in doubles, which `digits` "
              "follows through events and switches",
              t);
    return qdot_hint("a run that ends before t = %.6g", t);
}

qdot_status
qdot_precise_course_init(qdot_precise_side *s)
{
    const qdot_course *g = s->guide;
    const size_t n = g->tr.n;

    s->course = qdot_calloc(1, sizeof *s->course);
    if (!s->course)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_reals_init(&s->course->numbers, 1 + 2 * n + NUMBERS, s->start.bits));
    s->course->set = qdot_calloc(n + 1, sizeof *s->course->set);
    s->course->segment_of = qdot_calloc(g->tr.pieces.n + 1, sizeof *s->course->segment_of);
    if (!s->course->set || !s->course->segment_of)
        return QDOT_ENOMEM;
    s->course->y = s->course->numbers.at + 1;
    s->course->old = s->course->y + n;
    s->course->at = s->course->old + n;
    QDOT_TRY(qdot_reals_init(&s->times, g->occurrences.n + 1, s->start.bits));
    for (size_t i = 0; i < g->tr.pieces.n; i++) {
        size_t mode = g->tr.pieces.at[i].mode;

        if (!s->binds[mode])
            QDOT_TRY(qdot_precise_bind_new(mode_at_index(s, mode)->plan, s->order,
                                           s->start.bits, &s->binds[mode]));
        if (mode_at_index(s, mode)->plan->n_massless > 0)
            QDOT_TRY(add_projection(s, mode));
    }
    for (size_t i = 0; i < g->faded.n; i++)
        if (g->faded.at[i].touched && qdot_staged_event_acts(&g->stage->events.at[g->faded.at[i].event]))
            return qdot_precise_beyond_doubles(g->faded.at[i].from);
    for (size_t i = 0; i < g->ends.n; i++) {
        const qdot_course_end *e = &g->ends.at[i];
        bool many;
        size_t mode = g->tr.pieces.at[e->piece].mode;

        QDOT_TRY(add_formula(s, mode, e->function, SIZE_MAX));
        if (find_start_of_contact(g, e->piece, e, 1, &many))
            QDOT_TRY(add_formula(s, mode, e->function, QDOT_PRECISE_RATE));
        if (e->what.kind == QDOT_WATCH_EVENT
            && g->stage->events.at[e->what.index].then) {
            QDOT_TRY(add_formula(s, mode, SIZE_MAX, e->what.index));
            QDOT_TRY(add_projection(s, mode));
        }
    }
    for (size_t i = 0; i < g->occurrences.n; i++)
        QDOT_TRY(add_formula(s, g->tr.pieces.at[piece_at_time(g, g->occurrences.at[i].t)].mode,
                             g->occurrences.at[i].event, SIZE_MAX));
    return QDOT_OK;
}

/* --- pieces -------------------------------------------------------------------------- */

static double
piece_duration(const qdot_course *g, size_t piece)
{
    const qdot_trajectory *tr = &g->tr;

    return fabs(tr->t[qdot_trajectory_last_of(tr, piece)] - tr->t[tr->pieces.at[piece].first]);
}

/* Carry out the changes at the ends [n] of a piece, each on what those before it have made: s->course->y becomes the
 * state after. */
static qdot_status
apply_changes(qdot_precise_side *s, size_t segment, const qdot_course_end *ends, size_t n,
              mpfr_srcptr t)
{
    const qdot_stage *stage = s->guide->stage;
    const size_t mode = s->segments.at[segment].mode, size = s->guide->tr.n;

    for (size_t k = 0; k < n; k++) {
        const qdot_staged_event *e = &stage->events.at[ends[k].what.index];
        const qdot_precise_formula *f;

        if (ends[k].what.kind != QDOT_WATCH_EVENT || !e->then)
            continue;
        for (size_t i = 0; i < size; i++)
            mpfr_set(s->course->old[i], s->course->y[i], RN);
        f = find_formula(s, mode, SIZE_MAX, ends[k].what.index);
        QDOT_TRY(qdot_precise_formula_evaluate(s, f, mode, t, (const mpfr_t *)s->course->old));
        memset(s->course->set, 0, size * sizeof *s->course->set);
        for (size_t i = 0; i < e->changes; i++) {
            mpfr_set(s->course->y[e->targets[i]], qdot_precise_output(f->program, i)[0],
                     RN);
            s->course->set[e->targets[i]] = true;
        }
        if (s->course->holds.at[mode])
            QDOT_TRY(qdot_precise_hold_put(s->course->holds.at[mode], t, s->course->y,
                                           e->positions ? s->course->set : NULL,
                                           e->velocities ? s->course->set + size / 2 : NULL));
    }
    return QDOT_OK;
}

/* Shorten a segment so that it ends at t. */
static qdot_status
shorten_segment(qdot_precise_side *s, size_t segment, mpfr_srcptr t)
{
    qdot_precise_run *run = &s->segments.at[segment].run;

    QDOT_TRY(qdot_precise_state_in(s, segment, t, s->course->y));
    while (run->count > 2
           && (mpfr_cmp(qdot_precise_point(run, run->count - 2)[0], t) == 0
               || (mpfr_cmp(qdot_precise_point(run, run->count - 2)[0], t) > 0)
                      == (mpfr_cmp(qdot_precise_point(run, run->count - 1)[0], t) > 0)))
        run->count--;
    qdot_precise_cut(run, t, (const mpfr_t *)s->course->y);
    s->result.t = run->result.t;
    s->near = SIZE_MAX;
    return QDOT_OK;
}

/* End the piece at the root of the function that ended it in doubles: shorten the segment to that time. */
static qdot_status
end_piece_at_root(qdot_precise_side *s, size_t k, size_t segment, const qdot_course_end *ends, size_t n)
{
    const size_t mode = s->segments.at[segment].mode;
    mpfr_t *at = s->course->at;
    mpfr_ptr t = s->course->numbers.at[0];
    bool found;

    QDOT_TRY(qdot_precise_locate(s, segment, find_formula(s, mode, ends[0].function, SIZE_MAX), ends[0].t,
                    2 * pad * piece_duration(s->guide, k), &found));
    if (!found)
        return qdot_precise_beyond_doubles(ends[0].t);
    mpfr_set(t, at[X], RN);
    for (size_t k = 1; k < n; k++) { /* further events at the same time are carried out at this root, too */
        const qdot_precise_formula *f = find_formula(s, mode, ends[k].function, SIZE_MAX);

        QDOT_TRY(qdot_precise_formula_at(s, segment, f, t, at[F_X]));
        if (qdot_real_log2(at[F_X]) > 0.75 * s->log2_tol)
            return qdot_precise_beyond_doubles(ends[0].t);
    }
    QDOT_TRY(shorten_segment(s, segment, t));
    return apply_changes(s, segment, ends, n, t);
}

static void
add_to_result(qdot_precise_side *s, const qdot_ode_result *r)
{
    qdot_ode_stats sum = s->result.stats;

    sum.steps += r->stats.steps;
    sum.rejected += r->stats.rejected;
    sum.evaluations += r->stats.evaluations;
    sum.cpu += r->stats.cpu;
    s->result = *r;
    s->result.stats = sum;
}

/* Put the rates of first-order states into y at the start of a piece of that mode: they may have jumped. */
static qdot_status
take_rates(qdot_precise_side *s, size_t mode)
{
    const qdot_plan *p = mode_at_index(s, mode)->plan;

    if (p->n_massless == 0)
        return QDOT_OK;
    for (size_t i = 0; i < p->n; i++)
        s->course->set[i] = !p->massless[i];
    return qdot_precise_hold_put(s->course->holds.at[mode], s->course->numbers.at[0], s->course->y, NULL, s->course->set);
}

/* Integrate piece k from the time numbers.at[0] and the state y. */
static qdot_status
run_piece(qdot_precise_side *s, size_t k, const qdot_course_end *ends, size_t n)
{
    const qdot_trajectory *tr = &s->guide->tr;
    const qdot_trajectory_piece *piece = &tr->pieces.at[k];
    const size_t last = qdot_trajectory_last_of(tr, k), segment = s->segments.n;
    qdot_precise_options options = {.log2_tol = s->log2_tol, .order = s->order};
    mpfr_ptr t = s->course->numbers.at[0], goal = s->course->at[X];
    qdot_status status;

    QDOT_TRY(take_rates(s, piece->mode));
    if (n == 0 && piece->first != last && k + 1 < tr->pieces.n) /* the piece ended in doubles without a root that is known */
        return qdot_precise_beyond_doubles(tr->t[last]);
    s->course->segment_of[k] = segment;
    QDOT_TRY(qdot_vec_push(&s->segments, ((qdot_precise_segment){
                                             .mode = piece->mode, .jumped = piece->jumped})));
    if (n > 0) {
        double way = s->guide->tr.t[tr->count - 1] < s->guide->tr.t[0] ? -1 : 1;

        mpfr_set_d(goal, ends[0].t, RN);
        mpfr_set_d(s->course->at[W], way * pad * piece_duration(s->guide, k), RN);
        mpfr_add(goal, goal, s->course->at[W], RN);
    } else if (piece->first == last) {
        mpfr_set(goal, t, RN);
    } else if (s->guide->failed) { /* what follows the failure of the run in doubles is not known */
        mpfr_set_d(goal, tr->t[last], RN);
    } else {
        mpfr_set(goal, s->start.at[1], RN);
    }
    s->near = SIZE_MAX;
    status = qdot_precise_integrate(qdot_precise_bind_system(s->binds[piece->mode]),
                                    &options, t, goal, (const mpfr_t *)s->course->y,
                                    &s->segments.at[segment].run);
    add_to_result(s, &s->segments.at[segment].run.result);
    QDOT_TRY(status);
    return n > 0 ? end_piece_at_root(s, k, segment, ends, n) : QDOT_OK;
}

/* --- coming to rest at a contact ----------------------------------------------------- */

/* The rate of u after the impact, at the state y, into at[SPEED], and before the impact into
 * at[SPEED_BEFORE]. */
static qdot_status
find_impact_speeds(qdot_precise_side *s, size_t mode, const qdot_precise_formula *rate, mpfr_srcptr t)
{
    mpfr_t *at = s->course->at;

    QDOT_TRY(qdot_precise_formula_evaluate(s, rate, mode, t, (const mpfr_t *)s->course->old));
    mpfr_set(at[SPEED_BEFORE], qdot_precise_output(rate->program, 0)[0], RN);
    QDOT_TRY(qdot_precise_formula_evaluate(s, rate, mode, t, (const mpfr_t *)s->course->y));
    mpfr_set(at[SPEED], qdot_precise_output(rate->program, 0)[0], RN);
    return mpfr_number_p(at[SPEED]) && mpfr_number_p(at[SPEED_BEFORE])
               ? QDOT_OK
               : qdot_fail(QDOT_EDOMAIN, "the velocity at a contact has no value");
}

/* Whether the next flight is so low that the rounding of positions hides it. */
static bool
is_flight_lost_in_rounding(const qdot_precise_side *s)
{
    const size_t n = s->guide->tr.n / 2;
    const mpfr_t *at = (const mpfr_t *)s->course->at;
    double size = 0;

    for (size_t i = 0; i < n; i++)
        size = fmax(size, qdot_real_log2(s->course->y[i]));
    return mpfr_zero_p(at[SPEED]) || mpfr_zero_p(at[FLIGHT])
           || qdot_real_log2(at[SPEED]) + qdot_real_log2(at[FLIGHT]) <= size + 14 - (double)s->start.bits;
}

static qdot_status
fail_does_not_rest(double t)
{
    qdot_fail(QDOT_ELIMIT, "`digits` does not follow the bounces that come to rest at t = %.10g", t);
    return qdot_hint("a run in doubles rests there; digits are right until before t = %.6g", t);
}

/* Integrate one more flight in the present mode, to the next impact on the same surface. */
static qdot_status
integrate_flight(qdot_precise_side *s, size_t mode, const qdot_precise_formula *f, const qdot_course_end *end)
{
    qdot_precise_options options = {.log2_tol = s->log2_tol, .order = s->order};
    const size_t segment = s->segments.n;
    mpfr_t *at = s->course->at;
    mpfr_ptr t = s->course->numbers.at[0];
    bool found;
    qdot_status status;

    mpfr_set(at[BEGAN], t, RN);
    mpfr_mul_d(at[X], at[FLIGHT], 1.25, RN);
    mpfr_add(at[X], at[X], t, RN);
    QDOT_TRY(qdot_vec_push(&s->segments,
                           ((qdot_precise_segment){.mode = mode, .jumped = true})));
    s->near = SIZE_MAX;
    status = qdot_precise_integrate(qdot_precise_bind_system(s->binds[mode]), &options, t, at[X],
                                    (const mpfr_t *)s->course->y, &s->segments.at[segment].run);
    add_to_result(s, &s->segments.at[segment].run.result);
    QDOT_TRY(status);
    mpfr_mul_d(at[LO], at[FLIGHT], 0.75, RN);
    mpfr_add(at[LO], at[LO], t, RN);
    mpfr_set(at[HI], at[X], RN);
    QDOT_TRY(qdot_precise_find_root(s, segment, f, &found));
    if (!found)
        return fail_does_not_rest(end->t);
    mpfr_set(t, at[X], RN);
    QDOT_TRY(shorten_segment(s, segment, t));
    QDOT_TRY(apply_changes(s, segment, end, 1, t));
    mpfr_sub(at[FLIGHT], t, at[BEGAN], RN);
    return QDOT_OK;
}

/* Piece k ended with an impact behind which the run in doubles rests: the bounces that are too low for doubles
 * follow, until all digits hide them too. Then the impulse that the last one takes up leaves the contact at rest. */
static qdot_status
bounce_to_rest(qdot_precise_side *s, size_t k, const qdot_course_end *end)
{
    const size_t mode = s->guide->tr.pieces.at[k].mode, n = s->guide->tr.n;
    const qdot_precise_formula *f = find_formula(s, mode, end->function, SIZE_MAX),
                  *rate = find_formula(s, mode, end->function, QDOT_PRECISE_RATE);
    const qdot_precise_run *flight = &s->segments.at[s->course->segment_of[k]].run;
    mpfr_t *at = s->course->at;
    mpfr_ptr t = s->course->numbers.at[0];

    QDOT_TRY(find_impact_speeds(s, mode, rate, t));
    mpfr_sub(at[FLIGHT], t, qdot_precise_point(flight, 0)[0], RN);
    for (size_t count = 0;; count++) {
        QDOT_TRY(qdot_interrupt_check());
        if (mpfr_zero_p(at[SPEED]) || mpfr_zero_p(at[SPEED_BEFORE]))
            break;
        mpfr_div(at[W], at[SPEED], at[SPEED_BEFORE], RN);
        mpfr_abs(at[W], at[W], RN);
        /* durations of low flights are in proportion to their speeds, whose ratio is W */
        mpfr_mul(at[FLIGHT], at[FLIGHT], at[W], RN);
        if (is_flight_lost_in_rounding(s))
            break;
        if (count == MOST_BOUNCES || mpfr_cmp_d(at[W], 1) >= 0)
            return fail_does_not_rest(end->t);
        QDOT_TRY(integrate_flight(s, mode, f, end));
        QDOT_TRY(find_impact_speeds(s, mode, rate, t));
    }
    mpfr_sub(at[W], at[SPEED_BEFORE], at[SPEED], RN);
    if (mpfr_zero_p(at[W]))
        return QDOT_OK;
    mpfr_div(at[W], at[SPEED_BEFORE], at[W], RN);
    for (size_t i = n / 2; i < n; i++) {
        mpfr_sub(at[X], s->course->y[i], s->course->old[i], RN);
        mpfr_fma(s->course->y[i], at[X], at[W], s->course->old[i], RN);
    }
    return QDOT_OK;
}

/* Find, in all digits, the times of the occurrences that the run in doubles has found. */
static qdot_status
find_occurrence_times(qdot_precise_side *s)
{
    const qdot_course *g = s->guide;

    for (size_t i = 0; i < g->occurrences.n; i++) {
        const qdot_occurrence *o = &g->occurrences.at[i];
        const size_t piece = piece_at_time(g, o->t), segment = s->course->segment_of[piece];
        const qdot_course_end *end = NULL;
        bool found = false;

        for (size_t k = 0; k < g->ends.n; k++)
            if (g->ends.at[k].t == o->t)
                end = &g->ends.at[k];
        mpfr_set_nan(s->times.at[i]);
        if (end && end->what.kind == QDOT_WATCH_EVENT && end->what.index == o->event) {
            const qdot_precise_run *run =
                &s->segments.at[s->course->segment_of[end->piece]].run;

            mpfr_set(s->times.at[i], qdot_precise_point(run, run->count - 1)[0], RN);
            continue;
        }
        /* skip touches, where no sign changes, except of |u| and u^2, for which the function is u */
        if ((o->way == 0 && (o->within > 0 || !g->stage->events.at[o->event].touches)) || segment >= s->segments.n)
            continue;
        QDOT_TRY(qdot_precise_locate(s, segment,
                        find_formula(s, s->segments.at[segment].mode, o->event, SIZE_MAX), o->t,
                        pad * pad * piece_duration(g, piece), &found));
        if (found)
            mpfr_set(s->times.at[i], s->course->at[X], RN);
    }
    return QDOT_OK;
}

/* Whether an end belongs to piece k: also one at which the next piece, which has steps, begins: bodies that touch behind the blow that
 * ended piece k are pushed together there. */
static bool
is_end_of_piece(const qdot_course *g, const qdot_course_end *end, size_t k)
{
    return end->piece == k
           || (end->piece == k + 1 && piece_duration(g, k + 1) > 0 && end->t == g->tr.t[g->tr.pieces.at[k + 1].first]);
}

static qdot_status
follow_pieces(qdot_precise_side *s)
{
    const qdot_course *g = s->guide;
    const qdot_course_end *rest;
    size_t at = 0;
    bool many;

    if (g->ends.n > 0 && g->ends.at[0].t == g->tr.t[0])
        return qdot_fail(QDOT_ELIMIT, "`digits` does not follow an event that acts where the run starts: start with what "
                                      "it makes of the velocities");
    mpfr_set(s->course->numbers.at[0], s->start.at[0], RN);
    for (size_t i = 0; i < g->tr.n; i++)
        mpfr_set(s->course->y[i], s->start.at[2 + i], RN);
    for (size_t k = 0; k < g->tr.pieces.n; k++) {
        size_t first = at;

        QDOT_TRY(qdot_interrupt_check());
        while (at < g->ends.n && is_end_of_piece(g, &g->ends.at[at], k))
            at++;
        QDOT_TRY(run_piece(s, k, g->ends.at + first, at - first));
        rest = find_start_of_contact(g, k, g->ends.at + first, at - first, &many);
        if (rest && many)
            return qdot_fail(QDOT_ELIMIT, "`digits` does not come to rest at several contacts at once, as "
                                          "at t = %.15g", rest->t);
        if (rest)
            QDOT_TRY(bounce_to_rest(s, k, rest));
    }
    return find_occurrence_times(s);
}

void
qdot_precise_course_run(qdot_precise_side *s)
{
    s->status = follow_pieces(s);
    if (s->status != QDOT_OK && s->result.outcome != QDOT_ODE_FAILED) {
        s->result.outcome = QDOT_ODE_FAILED;
        memcpy(s->result.reason, qdot_last_error()->message, sizeof s->result.reason);
    }
}
