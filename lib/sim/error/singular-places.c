/* singular-places.c -- finds the times of a run at which constraints become nearly dependent. */
#include "sim/error/singular-places.h"

#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "num/hermite.h"
#include "sim/model/constraints.h"

/* Constraints are dependent if q is below `dependent` or below a hundred tolerances, but at most
 * `most_dependent`. */
static const double dependent = 1e-5, most_dependent = 1e-3;

/* A minimum below `shallow` of the points beside it is examined; if the sections reduce it to no
 * less than `floor_of_minimum`, it does not go to 0. */
static const double shallow = 0.75, floor_of_minimum = 0.2;

/* Times what counts as 0: between two minima that are one place, which a run came to in steps as
 * short as rounding, q stays below it. */
static const double away = 10;

enum { sections = 60, closed_in = 12, most_told = 60 };

/* The steps of few may be long, and so may one beside shorter ones: they are looked at within,
 * too. */
enum { few_steps = 100, parts_of_a_step = 4, most_parts = 64 };

/* Constraints that become dependent on each other (none if unknown), and the times at which they do. */
typedef struct {
    const qdot_constraints *of;
    bool *rows; /* [of->m] which constraints belong to the set, owned */
    qdot_vec(double) times;
} group;

typedef struct {
    const qdot_course *course;
    qdot_trajectory_cursor *cursor;
    qdot_constrained *held; /* the constraint solver in the mode of the present piece */
    size_t piece, end; /* index of the present piece; of the first point after it */
    double *y; /* [2n] scratch state */
    size_t step; /* index of the stored point at which the step ends to which `between` belongs */
    double *between; /* [4n] dy/dt at both ends of this step, for methods without series */
    bool sloped;     /* `between` is known; otherwise derivatives come from interpolating cubics */
    double enough; /* values of the measure q of independence below this count as 0 */
    double t[3], q[3]; /* time and independence q at the last three points that were evaluated in the piece */
    size_t taken;      /* the number of points evaluated */
    double most;       /* largest q since the last reported singular place */
    qdot_vec(group) groups;
} search;

/* Prepare to read states in the step that ends at stored point k. */
static void
search_enter_step(search *s, size_t k)
{
    const qdot_trajectory *tr = &s->course->tr;
    const qdot_ode_system *system =
        qdot_course_systems(s->course) + tr->pieces.at[s->piece].mode;

    s->step = k;
    s->sloped = true;
    for (size_t i = 0; i < 2 && s->sloped; i++) {
        const size_t at = k - 1 + i;

        s->sloped = system->rhs(tr->t[at], tr->y + at * tr->n, s->between + i * tr->n,
                                system->user)
                    == QDOT_OK;
    }
}

/* The state at t by polynomials through the ends of a step: what a method without series knows
 * between them costs steps of its own, which are tiny about the places that are looked for. */
static void
interpolate(search *s, double t)
{
    const qdot_trajectory *tr = &s->course->tr;
    const size_t n = tr->n / 2, first = tr->pieces.at[s->piece].first;
    const double way = tr->t[tr->count - 1] < tr->t[0] ? -1 : 1;
    size_t k = s->step > first ? s->step : first + 1;

    while (k > first + 1 && way * (t - tr->t[k - 1]) < 0)
        k--;
    while (k < s->end - 1 && way * (t - tr->t[k]) > 0)
        k++;
    if (k != s->step)
        search_enter_step(s, k);
    for (size_t i = 0; i < n; i++) {
        const double *y = tr->y + (k - 1) * tr->n, *z = y + tr->n, h = tr->t[k] - tr->t[k - 1];
        qdot_hermite_end from = {y[i], y[n + i], s->between[n + i]};
        qdot_hermite_end to = {z[i], z[n + i], s->between[tr->n + n + i]};

        if (!s->sloped)
            qdot_hermite_cubic_ends(&from, &to, h);
        s->y[i] = qdot_hermite_at(&from, &to, h, (t - tr->t[k - 1]) / h, s->y + n + i);
    }
}

static qdot_status
measure_independence(search *s, double t, double *q)
{
    if (s->between)
        interpolate(s, t);
    else
        QDOT_TRY(qdot_trajectory_read_piece(s->cursor, s->piece, t, s->y));
    *q = qdot_constrained_independence(s->held, t, s->y);
    return QDOT_OK;
}

/* The minimum about t[1] between t[0] and t[2], where q is more, by golden sections; s->y is a
 * state within rounding of it. */
static qdot_status
minimise_independence(search *s, const double *t, const double *q, double *at, double *least)
{
    static const double golden = 0.3819660112501051;
    const double start = fmin(q[0], q[2]);
    double a = t[0], b = t[2], m = t[1], qm = q[1];

    for (int k = 0; k < sections; k++) {
        const bool right = b - m > m - a;
        const double u = right ? m + golden * (b - m) : m - golden * (m - a);
        double qu;

        QDOT_TRY(qdot_interrupt_check());
        if (k == closed_in && qm > floor_of_minimum * start)
            break;
        QDOT_TRY(measure_independence(s, u, &qu));
        if (qu < qm) {
            *(right ? &a : &b) = m;
            m = u;
            qm = qu;
        } else {
            *(right ? &b : &a) = u;
        }
    }
    *at = m;
    return measure_independence(s, *at, least);
}

/* Whether the constraints of two modes are the same. */
static bool
are_same_constraints(const qdot_constraints *a, const qdot_constraints *b)
{
    bool same = a->m == b->m;

    for (size_t k = 0; k < a->m && same && a != b; k++)
        same = strcmp(a->rows[k].name, b->rows[k].name) == 0;
    return same;
}

/* Whether all constraints of group g are among `rows`; an empty group matches only an empty set. */
static bool
is_subset_of_rows(const group *g, const bool *rows)
{
    bool some = false, others = false;

    for (size_t k = 0; k < g->of->m; k++) {
        if (g->rows[k] && !rows[k])
            return false;
        some = some || g->rows[k];
        others = others || rows[k];
    }
    return some == others;
}

static void
clear_group(group *g)
{
    qdot_free(g->rows);
    qdot_free(g->times.at);
}

/* Give the places of all groups whose rows are among those of group i to it, in the order of time; to whom
 * *i points then. */
static qdot_status
merge_subsets(search *s, size_t *i)
{
    const double way = s->course->tr.t[s->course->tr.count - 1] < s->course->tr.t[0] ? -1 : 1;

    for (size_t j = s->groups.n; j-- > 0;) {
        group *to = s->groups.at + *i, *from = s->groups.at + j;

        if (j == *i || !are_same_constraints(from->of, to->of) || !is_subset_of_rows(from, to->rows))
            continue;
        for (size_t k = 0; k < from->times.n; k++) {
            QDOT_TRY(qdot_vec_push(&to->times, from->times.at[k]));
            for (size_t l = to->times.n - 1;
                 l > 0 && way * to->times.at[l] < way * to->times.at[l - 1]; l--) {
                const double later = to->times.at[l - 1];

                to->times.at[l - 1] = to->times.at[l];
                to->times.at[l] = later;
            }
        }
        clear_group(from);
        memmove(from, from + 1, (--s->groups.n - j) * sizeof *from);
        *i -= j < *i;
    }
    return QDOT_OK;
}

/* Find the group to which the rows `mine` belong: its rows are a subset or a superset; else make a
 * new group. Takes `mine`. */
static qdot_status
find_or_add_group(search *s, group *mine, size_t *i)
{
    qdot_status status;

    for (*i = 0; *i < s->groups.n; ++*i) {
        const group *g = s->groups.at + *i;

        if (are_same_constraints(g->of, mine->of) && is_subset_of_rows(mine, g->rows))
            break;
    }
    if (*i < s->groups.n) {
        clear_group(mine);
        return QDOT_OK;
    }
    status = qdot_vec_push(&s->groups, *mine);
    if (status == QDOT_OK)
        return merge_subsets(s, i);
    clear_group(mine);
    return status;
}

static qdot_status
record_singular_time(search *s, double t)
{
    group mine = {.of = qdot_constrained_of(s->held)};
    size_t i;

    mine.rows = qdot_calloc(mine.of->m, sizeof *mine.rows);
    if (!mine.rows)
        return QDOT_ENOMEM;
    (void)qdot_constrained_near(s->held, t, s->y, mine.rows); /* if this fails, no constraint is marked */
    QDOT_TRY(find_or_add_group(s, &mine, &i));
    if (s->groups.at[i].times.n > 0 && s->most < away * s->enough)
        return QDOT_OK;
    s->most = 0;
    return qdot_vec_push(&s->groups.at[i].times, t);
}

/* Whether q [3], at three points in a row, may come down to 0 about the middle one: it is
 * least there, and not by little. */
static bool
is_deep_minimum(const double *q)
{
    return q[1] <= q[0] && q[1] < q[2] && q[1] < shallow * fmax(q[0], q[2]);
}

/* Take the independence q at time t as the newest point; record a singular point if q has had a minimum near 0. */
static qdot_status
take_point(search *s, double t, double q)
{
    double at, least;

    memmove(s->t, s->t + 1, 2 * sizeof *s->t);
    memmove(s->q, s->q + 1, 2 * sizeof *s->q);
    s->t[2] = t;
    s->q[2] = q;
    s->most = fmax(s->most, s->q[1]); /* the newest value may lie after the minimum that will be reported */
    if (++s->taken < 3 || !is_deep_minimum(s->q))
        return QDOT_OK;
    QDOT_TRY(minimise_independence(s, s->t, s->q, &at, &least));
    return least < s->enough ? record_singular_time(s, at) : QDOT_OK;
}

/* The number of intervals into which the step that ends at stored point k is divided, by its
 * neighbours' length. */
static int
parts_of_step(const qdot_trajectory *tr, size_t first, size_t k, size_t end)
{
    const double *t = tr->t + k, h = fabs(t[0] - t[-1]);
    double beside = h;

    if (k > first + 1)
        beside = fmin(beside, fabs(t[-1] - t[-2]));
    if (k + 1 < end)
        beside = fmin(beside, fabs(t[1] - t[0]));
    if (tr->count >= few_steps && h < parts_of_a_step * beside)
        return 1;
    return (int)fmin(most_parts, parts_of_a_step * h / fmax(beside, h / most_parts));
}

/* Measure the constraints' independence at inner points of the step that ends at stored point k. */
static qdot_status
take_inner_points(search *s, size_t k, int parts)
{
    const double *t = s->course->tr.t + k - 1;

    for (int j = 1; j < parts; j++) {
        const double inner = t[0] + (t[1] - t[0]) * j / parts;
        double q;

        QDOT_TRY(measure_independence(s, inner, &q));
        QDOT_TRY(take_point(s, inner, q));
    }
    return QDOT_OK;
}

static qdot_status
search_whole_run(search *s)
{
    const qdot_trajectory *tr = &s->course->tr;

    for (s->piece = 0; s->piece < tr->pieces.n; s->piece++) {
        const qdot_trajectory_piece *p = tr->pieces.at + s->piece;
        const size_t end = s->piece + 1 < tr->pieces.n ? p[1].first : tr->count;

        s->taken = 0;
        s->end = end;
        s->step = 0;
        s->held = qdot_bind_held(s->course->binds.at[p->mode]);
        for (size_t k = p->first; k < end; k++) {
            if (k % 1024 == 0)
                QDOT_TRY(qdot_interrupt_check());
            if (k > p->first)
                QDOT_TRY(take_inner_points(s, k, parts_of_step(tr, p->first, k, end)));
            QDOT_TRY(take_point(s, tr->t[k],
                                qdot_constrained_independence(s->held, tr->t[k],
                                                              tr->y + k * tr->n)));
        }
    }
    return QDOT_OK;
}

static void
describe_group(const group *g, qdot_text *to)
{
    const size_t told = g->times.n < most_told ? g->times.n : most_told;

    qdot_text_add(to, to->n > 0 ? "\n" : "");
    qdot_constrained_say_dependent(g->of, g->rows, to);
    qdot_text_add(to, " about t = ");
    for (size_t i = 0; i < told; i++)
        qdot_text_format(to, "%s%.4g",
                         i == 0                                   ? ""
                         : i + 1 == told && told == g->times.n ? " and "
                                                                  : ", ",
                         g->times.at[i]);
    if (told < g->times.n)
        qdot_text_format(to, " and %zu times more", g->times.n - told);
    qdot_text_add(to, "; the run goes over it, at the accuracy left there");
}

qdot_status
qdot_singular_places_tell(const qdot_course *course, qdot_text *to)
{
    search s = {.course = course,
                .enough = fmin(most_dependent, fmax(dependent, 100 * course->touch_tol))};
    const qdot_constrained *first =
        course->binds.n > 0 && course->binds.at[0] ? qdot_bind_held(course->binds.at[0])
                                                   : NULL;
    qdot_status status;

    /* a single constraint cannot depend on others */
    if (!first || qdot_constrained_rows(first) < 2 || course->tr.count < 2)
        return QDOT_OK;
    s.y = qdot_calloc(course->tr.n, sizeof *s.y);
    if (!course->tr.method->series)
        s.between = qdot_calloc(2 * course->tr.n, sizeof *s.between);
    status = s.y && (s.between || course->tr.method->series)
                 ? qdot_trajectory_open(&course->tr, qdot_course_systems(course), &s.cursor)
                 : QDOT_ENOMEM;
    if (status == QDOT_OK)
        status = search_whole_run(&s);
    for (size_t i = 0; i < s.groups.n; i++) {
        if (status == QDOT_OK)
            describe_group(s.groups.at + i, to);
        clear_group(s.groups.at + i);
    }
    qdot_free(s.groups.at);
    qdot_trajectory_close(s.cursor);
    qdot_free(s.between);
    qdot_free(s.y);
    return status == QDOT_OK ? qdot_text_status(to) : status;
}
