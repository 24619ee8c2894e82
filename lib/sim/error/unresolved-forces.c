/* unresolved-forces.c -- what the equations are between the points of steps. */
#include "sim/error/unresolved-forces.h"

#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "sim/course/polynomial-bounds.h"
#include "sim/course/reader.h"
#include "tape/disc.h"

enum { FEW = 16, MANY = QDOT_CHEBYSHEV_MOST, DEEPEST = 30, MOST_PARTS = 400 };

/* What is nothing beside the largest value; what a sum has to be beyond, in tolerances of largest
 * values and in tolerances. */
static const double nothing = 1e-6, tolerances = 10, least = 1e-11, floor_of_it = 0.01;

/* e^10: series and differences see that. */
static const double short_reach = 10;

typedef struct {
    const qdot_plan *plan; /* whose tape is read; NULL: none yet */
    qdot_reader reader;
    qdot_polynomial_bounds bounds;
    size_t piece, m;
    double tol;
    qdot_disc_hiding hiding; /* what may have been stepped over */
    double *out;    /* [m] */
    double *largest; /* [m] met so far */
    double *values; /* [m x MANY] of a part */
    double *whole;  /* [m x MANY] coefficients of the step */
    double *beyond; /* [m] the sum of what parts show beyond them, */
    double *all;    /* [m] and of what they show */
    double a, b;    /* the step */
    double peak, t; /* the largest of that, and where */
} search;

static void
leave_plan(search *s)
{
    qdot_reader_clear(&s->reader);
    qdot_polynomial_bounds_clear(&s->bounds);
    qdot_free(s->out);
    *s = (search){.tol = s->tol, .hiding = s->hiding};
}

static qdot_status
take_plan(search *s, const qdot_course *course, const qdot_plan *plan)
{
    const size_t m = qdot_tape_outputs(plan->tape);

    leave_plan(s);
    s->plan = plan;
    s->m = m;
    QDOT_TRY(qdot_reader_init(
        &s->reader, &(qdot_reading){.plan = plan, .m = m, .tape = plan->tape}, course));
    QDOT_TRY(qdot_polynomial_bounds_init(&s->bounds, plan->tape, 2 * plan->n));
    s->out = qdot_calloc((2 * MANY + 4) * m + 1, sizeof *s->out);
    if (!s->out)
        return QDOT_ENOMEM;
    s->largest = s->out + m;
    s->beyond = s->largest + m;
    s->all = s->beyond + m;
    s->values = s->all + m;
    s->whole = s->values + m * MANY;
    return QDOT_OK;
}

static double
time_at(double a, double b, int nodes, int j)
{
    return qdot_chebyshev_place(a, b, qdot_chebyshev_node(nodes, j));
}

/* Values at the nodes of a ... b; *finite: all are numbers. */
static qdot_status
sample(search *s, double a, double b, int nodes, bool *finite)
{
    *finite = true;
    for (int j = 0; j < nodes && *finite; j++) {
        QDOT_TRY(qdot_reader_at(&s->reader, s->piece, time_at(a, b, nodes, j), s->out));
        qdot_polynomial_bounds_sample(&s->bounds, j, s->reader.in);
        for (size_t i = 0; i < s->m; i++) {
            s->values[i * MANY + (size_t)j] = s->out[i];
            s->largest[i] = fmax(s->largest[i], fabs(s->out[i]));
            *finite = *finite && isfinite(s->out[i]);
        }
    }
    return QDOT_OK;
}

/* Whether the polynomials through the values represent the functions, up to a negligible error.
 * False if a function is singular. */
static bool
is_sure(search *s, double a, double b, int nodes)
{
    double c[MANY];

    qdot_polynomial_bounds_look(&s->bounds, a, b, nodes, NULL, NULL);
    for (size_t i = 0; i < s->m; i++) {
        qdot_chebyshev_fit(nodes, s->values + i * MANY, c);
        if (fmax(s->bounds.miss[i], qdot_chebyshev_tail(nodes, c)) >
            nothing * s->largest[i] + 1e-300)
            return false;
    }
    return true;
}

/* Add the difference between the part's values and the step's polynomials. */
static void
add_beyond(search *s, double a, double b, int nodes)
{
    for (size_t i = 0; i < s->m; i++) {
        double sum = 0, all = 0;

        for (int j = 0; j < nodes; j++) {
            const double t = time_at(a, b, nodes, j);
            const double x = (2 * t - s->a - s->b) / (s->b - s->a);
            const double d = fabs(s->values[i * MANY + (size_t)j] -
                                  qdot_chebyshev_at(MANY, s->whole + i * MANY, x));

            sum += d / nodes;
            all += fabs(s->values[i * MANY + (size_t)j]) / nodes;
            if (d > s->peak * s->largest[i]) {
                s->peak = d / s->largest[i];
                s->t = t;
            }
        }
        s->beyond[i] += sum * fabs(b - a);
        s->all[i] += all * fabs(b - a);
    }
}

/* Examine the parts of a step whose points do not suffice, from left to right. */
static qdot_status
look_at_parts(search *s)
{
    double ends[DEEPEST + 1], from = s->a;
    bool finite;

    memset(s->beyond, 0, s->m * sizeof *s->beyond);
    memset(s->all, 0, s->m * sizeof *s->all);
    s->peak = 0;
    ends[0] = s->b;
    for (int depth = 1, parts = 0; depth > 0; parts++) {
        const double to = ends[depth - 1];

        QDOT_TRY(qdot_interrupt_check());
        QDOT_TRY(sample(s, from, to, FEW, &finite));
        if (finite && depth < DEEPEST && parts < MOST_PARTS && !is_sure(s, from, to, FEW)) {
            ends[depth++] = 0.5 * (from + to);
            continue;
        }
        if (finite)
            add_beyond(s, from, to, FEW);
        from = to;
        depth--;
    }
    return QDOT_OK;
}

/* Whether the step is so short that what falls off like an exponential cannot fall off on it: its
 * state within what the ends and their velocities let it be, and as much again. */
static bool
is_short(search *s, const double *from, const double *to)
{
    const size_t n = s->plan->n;
    const double h = fabs(s->b - s->a);
    qdot_polynomial_bounds *bounds = &s->bounds;

    for (size_t i = 0; i < n; i++) {
        const double bend = fabs((to[i] - from[i]) / (s->b - s->a)
                                 - 0.5 * (from[n + i] + to[n + i]));

        bounds->centre[i] = 0.5 * (from[i] + to[i]);
        bounds->radius[i] = h * (fmax(fabs(from[n + i]), fabs(to[n + i])) + 2 * bend);
        bounds->centre[n + i] = 0.5 * (from[n + i] + to[n + i]);
        bounds->radius[n + i] = fabs(to[n + i] - from[n + i]) + 4 * bend;
    }
    bounds->centre[2 * n] = 0.5 * (s->a + s->b);
    bounds->radius[2 * n] = 0.5 * h;
    return qdot_disc_reach(s->plan->tape, s->hiding, bounds->centre, bounds->radius, bounds->work) <=
           short_reach;
}

static qdot_status
look_at_step(search *s, bool *found)
{
    bool finite;

    qdot_polynomial_bounds_begin(&s->bounds);
    QDOT_TRY(sample(s, s->a, s->b, FEW, &finite));
    if (!finite || is_sure(s, s->a, s->b, FEW))
        return QDOT_OK;
    QDOT_TRY(sample(s, s->a, s->b, MANY, &finite));
    if (!finite || is_sure(s, s->a, s->b, MANY))
        return QDOT_OK;
    for (size_t i = 0; i < s->m; i++)
        qdot_chebyshev_fit(MANY, s->values + i * MANY, s->whole + i * MANY);
    QDOT_TRY(look_at_parts(s));
    for (size_t i = 0; i < s->m; i++)
        *found = *found
                 || s->beyond[i] > fmax(fmax(tolerances * s->tol, least) * s->all[i],
                                        floor_of_it * s->tol);
    return QDOT_OK;
}

static qdot_status
go_through(search *s, const qdot_course *course, bool *found)
{
    const qdot_trajectory *tr = &course->tr;

    for (size_t k = 0; k < tr->pieces.n && !*found; k++) {
        const qdot_trajectory_piece *p = tr->pieces.at + k;
        const size_t end = k + 1 < tr->pieces.n ? p[1].first : tr->count;
        const qdot_plan *plan = course->stage->modes.at[p->mode]->plan;

        if (!plan->tape || !qdot_disc_may_hide(plan->tape, s->hiding))
            continue;
        if (plan != s->plan)
            QDOT_TRY(take_plan(s, course, plan));
        s->piece = k;
        for (size_t j = p->first; j + 1 < end && !*found; j++) {
            s->a = tr->t[j];
            s->b = tr->t[j + 1];
            if (!is_short(s, tr->y + j * tr->n, tr->y + (j + 1) * tr->n))
                QDOT_TRY(look_at_step(s, found));
        }
    }
    return QDOT_OK;
}

qdot_status
qdot_unresolved_forces_find(const qdot_course *course, bool *found, double *t)
{
    search s = {.tol = course->tr.tol};
    qdot_status status;

    *found = false;
    if (!course->tr.method || course->tr.method->stiff)
        return QDOT_OK;
    s.hiding = course->tr.method->series ? QDOT_HIDES_EXPONENTIALS : QDOT_HIDES_QUOTIENTS;
    status = go_through(&s, course, found);
    *t = s.t;
    leave_plan(&s);
    return qdot_grave(status);
}
