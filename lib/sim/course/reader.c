/* reader.c -- reads the state of a run at a time, its accelerations if needed, and evaluates a tape there. */
#include "sim/course/reader.h"

#include <math.h>
#include <string.h>

#include "expr/node.h"
#include "expr/symbol.h"
#include "ode/companion.h"
#include "ode/scale.h"
#include "sim/model/delay.h"
#include "sim/model/sliding.h"
#include "tape/rounding.h"

bool
qdot_reading_of_accelerations(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_node(pool, e)->holds & (QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER);
}

void
qdot_reader_clear(qdot_reader *r)
{
    for (size_t k = 0; k < r->n_courses; k++)
        qdot_trajectory_close(r->courses[k].cursor);
    if (r->past)
        qdot_past_read(NULL);
    qdot_free(r->past);
    qdot_free(r->courses);
    qdot_free(r->in);
    qdot_free(r->work);
}

static const qdot_plan *
plan_of_course(const qdot_reading *of, size_t k)
{
    return k == 0 ? of->plan : of->more[k - 1];
}

qdot_expr
qdot_reader_own_history(const qdot_plan *plan, qdot_expr e, const qdot_expr *own)
{
    return plan->delayed ? qdot_delay_rename(plan->pool, e, 2 * plan->n, plan->inputs, own) : e;
}

/* Note the history of course k, whose inputs begin at `begin`. */
static qdot_status
add_history(qdot_reader *r, size_t k, size_t begin)
{
    const qdot_reading *of = &r->of;
    const qdot_past *history = r->courses[k].course->history;

    if (!history)
        return QDOT_OK;
    if (!r->past)
        r->past = qdot_calloc(1 + of->n_more, sizeof *r->past);
    if (!r->past)
        return QDOT_ENOMEM;
    r->past[k] = (qdot_past_reading){history, of->n_more > 0 ? of->inputs + begin : of->plan->inputs};
    return QDOT_OK;
}

void
qdot_reader_recall(const qdot_reader *r)
{
    if (r->past)
        qdot_past_read_several(r->n_courses, r->past);
}

qdot_status
qdot_reader_init_along(qdot_reader *r, const qdot_reading *of, const qdot_course *const *courses)
{
    *r = (qdot_reader){.of = *of};
    r->in = qdot_calloc(qdot_tape_inputs(of->tape), sizeof *r->in);
    r->work = qdot_calloc(qdot_tape_work(of->tape) + 1, sizeof *r->work);
    r->courses = qdot_calloc(1 + of->n_more, sizeof *r->courses);
    if (!r->in || !r->work || !r->courses)
        return QDOT_ENOMEM;
    for (size_t begin = 0; r->n_courses <= of->n_more; r->n_courses++) {
        const size_t k = r->n_courses;

        r->courses[k] = (qdot_reader_course){
            .course = courses[k], .n = plan_of_course(of, k)->n, .in = r->in + begin};
        QDOT_TRY(qdot_trajectory_open(&courses[k]->tr, qdot_course_systems(courses[k]),
                                      &r->courses[k].cursor));
        QDOT_TRY(add_history(r, k, begin));
        begin += qdot_plan_inputs(plan_of_course(of, k));
    }
    return QDOT_OK;
}

qdot_status
qdot_reader_init(qdot_reader *r, const qdot_reading *of, const qdot_course *course)
{
    return qdot_reader_init_along(r, of, &course);
}

static qdot_status
read_accelerations(const qdot_reader_course *c, double t)
{
    const size_t mode = qdot_trajectory_mode_read(c->cursor);

    return qdot_bind_accelerations(qdot_course_systems(c->course) + mode, t, c->in,
                                   c->in + 2 * c->n + 1);
}

/* Read the sides of surfaces in this piece, the sliding shares of surfaces and of discs, as inputs
 * of the tape. */
static qdot_status
read_sides(const qdot_plan *p, const qdot_reader_course *c)
{
    const qdot_switches *s = &c->course->stage->switches;
    const qdot_mode *m = c->course->stage->modes.at[qdot_trajectory_mode_read(c->cursor)];
    const size_t surfaces = s->surfaces.n, pucks = s->n_puck_symbols, own = p->n_sides - pucks;
    double *sides = c->in + qdot_plan_inputs(p) - p->n_sides;

    if (m->shares) {
        double *out = qdot_malloc((surfaces + pucks + qdot_tape_work(m->shares) + 1) * sizeof *out);

        if (!out)
            return QDOT_ENOMEM;
        qdot_tape_eval(m->shares, c->in, out, out + surfaces + pucks);
        memcpy(sides, out, own * sizeof *sides);
        memcpy(sides + own, out + surfaces, pucks * sizeof *sides);
        qdot_free(out);
    }
    for (size_t i = 0; i < own; i++)
        sides[i] = m->side[i] == QDOT_SIDE_SLIDES ? fmin(fmax(sides[i], -1), 1)
                   : m->side[i] == QDOT_SIDE_IDLE ? 0
                                                  : (double)m->side[i];
    return QDOT_OK;
}

qdot_status
qdot_reader_evaluate(qdot_reader *r, double t, double *out)
{
    for (size_t k = 0; k < r->n_courses; k++) {
        r->courses[k].in[2 * r->courses[k].n] = t;
        if (r->of.accelerations)
            QDOT_TRY(read_accelerations(r->courses + k, t));
        if (plan_of_course(&r->of, k)->read_side)
            QDOT_TRY(read_sides(plan_of_course(&r->of, k), r->courses + k));
    }
    qdot_reader_recall(r);
    qdot_tape_eval(r->of.tape, r->in, out, r->work);
    return QDOT_OK;
}

qdot_status
qdot_reader_roundings(qdot_reader *r, double t, double *bounds)
{
    const size_t inputs = qdot_tape_inputs(r->of.tape);
    double *e = qdot_calloc(inputs + 2 * qdot_tape_work(r->of.tape) + 1, sizeof *e);
    qdot_status status = e ? QDOT_OK : QDOT_ENOMEM;

    for (size_t k = 0; k < r->n_courses && r->of.accelerations && status == QDOT_OK; k++) {
        const qdot_reader_course *c = r->courses + k;
        const double *a = c->in + 2 * c->n + 1;
        const size_t mode = qdot_trajectory_mode_read(c->cursor);

        status = qdot_bind_roundings(qdot_course_systems(c->course) + mode, t, c->in, a,
                                     e + (a - r->in));
    }
    qdot_reader_recall(r);
    if (status == QDOT_OK)
        qdot_rounding_bounds(r->of.tape, r->in, e, bounds, e + inputs);
    qdot_free(e);
    return status;
}

qdot_status
qdot_reader_read(qdot_reader *r, const size_t *pieces, double t, double *out)
{
    for (size_t k = 0; k < r->n_courses; k++) {
        const qdot_reader_course *c = r->courses + k;

        QDOT_TRY(pieces == NULL ? qdot_trajectory_read(c->cursor, t, c->in)
                                : qdot_trajectory_read_piece(c->cursor, pieces[k], t, c->in));
        for (size_t i = 0; i < 2 * c->n && r->moved > 0; i++)
            c->in[i] = qdot_companion_moved(c->in[i], qdot_ode_scale(c->course->stage->scales, i),
                                            i, (size_t)r->moved - 1);
    }
    return qdot_reader_evaluate(r, t, out);
}

qdot_status
qdot_reader_at(qdot_reader *r, size_t piece, double t, double *out)
{
    return qdot_reader_read(r, piece == SIZE_MAX ? NULL : &piece, t, out);
}

qdot_status
qdot_reader_go_on(qdot_reader *r, size_t piece, double t, double h, double low, double *more,
                  double *values)
{
    const qdot_status status = qdot_reader_at(r, piece, t + h, more);

    if (qdot_reader_has_nothing(status))
        return QDOT_OK;
    QDOT_TRY(status);
    for (size_t j = 0; j < r->of.m; j++)
        if (isfinite(more[j]))
            values[j] += (more[j] - values[j]) / h * low;
    return QDOT_OK;
}

qdot_status
qdot_reader_lower_beside(const qdot_reading *other, size_t m, const qdot_expr *exprs,
                         qdot_reading *of)
{
    const qdot_plan *p = other->plan;
    size_t inputs = 0;
    qdot_expr *e = qdot_malloc((m + 1) * sizeof *e);
    qdot_status status = e ? QDOT_OK : QDOT_ENOMEM;

    *of = *other;
    of->m = m;
    of->exprs = exprs;
    of->tape = NULL;
    for (size_t k = 0; k <= of->n_more; k++)
        inputs += qdot_plan_inputs(plan_of_course(of, k));
    for (size_t j = 0; j < m && status == QDOT_OK; j++) {
        e[j] = of->n_more == 0 ? qdot_plan_reading(p, exprs[j]) : exprs[j];
        status = qdot_pool_check(p->pool);
        if (status == QDOT_OK && qdot_reading_of_accelerations(p->pool, e[j]))
            of->accelerations = true;
    }
    if (status == QDOT_OK)
        status = qdot_tape_new(p->pool, inputs, of->inputs, m, e, &of->tape);
    qdot_free(e);
    return status;
}

qdot_status
qdot_reader_lower(const qdot_plan *plan, size_t m, const qdot_expr *exprs, qdot_reading *of)
{
    const qdot_reading one = {.plan = plan, .inputs = plan->inputs};

    return qdot_reader_lower_beside(&one, m, exprs, of);
}
