/* minimal.c -- solves constraints one after another and rewrites the scene in the remaining
 * coordinates. */
#include "mech/coordinates/minimal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/integrated.h"
#include "mech/scene/access.h"
#include "mech/scene/scene.h"

typedef struct {
    qdot_scene *s;
    qdot_pool *pool;
    qdot_minimal *out;
    bool *solved;    /* [constraints] the constraint has been solved for a coordinate */
    bool *gone;      /* [n] the coordinate has been eliminated */
    qdot_expr *angle; /* [n] symbols of the new angles; the first out->fresh entries are used */
    qdot_expr *held; /* [constraints] left sides f(q, t) of holonomic constraints f = 0 */
    const qdot_minimal_start *start;
} work;

void
qdot_minimal_clear(qdot_minimal *m)
{
    qdot_scene_free(m->scene);
    qdot_free(m->given);
    qdot_free(m->angle);
    *m = (qdot_minimal){0};
}

static bool
is_time_dependent(const work *w, qdot_expr e)
{
    return qdot_mech_holds(w->s, e) &
           (QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_UFUN);
}

/* Record that coordinate i equals `value`, and insert `value` into the solutions for other coordinates. */
static void
record_solution(work *w, size_t i, qdot_expr value)
{
    qdot_expr q = w->s->coordinates.at[i];

    w->gone[i] = true;
    w->out->given[i] = value;
    for (size_t k = 0; k < w->out->n; k++)
        if (k != i)
            w->out->given[k] = qdot_subs(w->pool, w->out->given[k], 1, &q, &value);
}

/* The function f with the solutions inserted for those coordinates that were solved for. */
static qdot_expr
insert_solutions(const work *w, qdot_expr f)
{
    return qdot_mech_tidy(w->s, qdot_subs(w->pool, f, w->out->n, w->s->coordinates.at,
                                          w->out->given));
}

/* Solve a constraint f = c x + g = 0 for the first coordinate x whose coefficient c is constant. */
static bool
solve_linear(work *w, qdot_expr f, qdot_expr whole)
{
    (void)whole;
    for (size_t i = 0; i < w->out->n; i++) {
        qdot_expr x = w->s->coordinates.at[i], c = qdot_diff(w->pool, f, x), g;

        if (w->gone[i] || c == QDOT_NIL || c == QDOT_ZERO || is_time_dependent(w, c) ||
            qdot_mech_holds(w->s, c) & QDOT_HAS_TIME)
            continue;
        g = qdot_mech_tidy(w->s, qdot_sub(w->pool, f, qdot_mul(w->pool, c, x)));
        if (g == QDOT_NIL || qdot_expr_contains(w->pool, g, x))
            continue;
        record_solution(w, i, qdot_mech_tidy(w->s, qdot_neg(w->pool, qdot_div(w->pool, g, c))));
        return true;
    }
    return false;
}

enum { most_axes = 3 };

/* A circle or sphere: its centre and its squared radius. */
typedef struct {
    qdot_expr centre[most_axes], square;
} ball;

/* Whether f = s ((x - a)^2 + ... - l^2) as a function of the coordinates x [m], where 2 s is its second derivative. */
static bool
is_circle_or_sphere(const work *w, qdot_expr f, size_t m, const qdot_expr *x, ball *of)
{
    static const qdot_expr zero[most_axes] = {QDOT_ZERO, QDOT_ZERO, QDOT_ZERO};
    qdot_pool *pool = w->pool;
    qdot_expr s = qdot_diff(pool, qdot_diff(pool, f, x[0]), x[0]);

    if (s == QDOT_NIL || s == QDOT_ZERO || is_time_dependent(w, s))
        return false;
    of->square = QDOT_ZERO;
    for (size_t i = 0; i < m; i++) {
        const qdot_expr slope = qdot_diff(pool, f, x[i]);

        for (size_t j = 0; j <= i; j++) {
            const qdot_expr second = qdot_diff(pool, slope, x[j]);

            if (qdot_mech_tidy(w->s, j < i ? second : qdot_sub(pool, second, s)) !=
                QDOT_ZERO)
                return false;
        }
        of->centre[i] =
            qdot_neg(pool, qdot_div(pool, qdot_subs(pool, slope, m, x, zero), s));
        of->square = qdot_add(pool, of->square,
                              qdot_mul(pool, of->centre[i], of->centre[i]));
    }
    of->square = qdot_sub(pool, of->square,
                          qdot_div(pool,
                                   qdot_mul(pool, qdot_expr_int(pool, 2),
                                            qdot_subs(pool, f, m, x, zero)),
                                   s));
    of->square = qdot_mech_tidy(w->s, of->square);
    return of->square != QDOT_NIL && of->square != QDOT_ZERO && !is_time_dependent(w, of->square);
}

/* Make a new angle, equal to atan2(y, x) of the given coordinates. */
static qdot_expr
add_new_angle(work *w, qdot_expr y, qdot_expr x)
{
    const qdot_expr sides[] = {y, x};
    char name[32];
    qdot_expr u;

    snprintf(name, sizeof name, "angle#%zu", w->out->fresh + 1);
    u = qdot_symbol_get(w->pool, QDOT_COORD, name);
    w->out->angle[w->out->fresh] = qdot_fun(w->pool, QDOT_ATAN2, 2, sides);
    w->angle[w->out->fresh++] = u;
    return u;
}

static qdot_expr
multiply_by_function(qdot_pool *pool, qdot_expr a, qdot_fun_id f, qdot_expr u)
{
    return qdot_mul(pool, a, qdot_fun1(pool, f, u));
}

/* Solve f = 0, a circle, by x = a + l sin u, y = b - l cos u; whole: f as declared, from which u is found. */
static bool
solve_circle(work *w, qdot_expr f, qdot_expr whole)
{
    qdot_pool *pool = w->pool;

    for (size_t i = 0; i < w->out->n; i++)
        for (size_t j = i + 1; j < w->out->n; j++) {
            const qdot_expr x[] = {w->s->coordinates.at[i], w->s->coordinates.at[j]};
            qdot_expr l, u;
            ball now, given;

            if (w->gone[i] || w->gone[j] || !is_circle_or_sphere(w, f, 2, x, &now) ||
                !is_circle_or_sphere(w, whole, 2, x, &given))
                continue;
            l = qdot_mech_tidy(w->s, qdot_sqrt(pool, now.square));
            u = add_new_angle(w, qdot_sub(pool, x[0], given.centre[0]),
                              qdot_sub(pool, given.centre[1], x[1]));
            record_solution(w, i, qdot_add(pool, now.centre[0], multiply_by_function(pool, l, QDOT_SIN, u)));
            record_solution(w, j, qdot_sub(pool, now.centre[1], multiply_by_function(pool, l, QDOT_COS, u)));
            return true;
        }
    return false;
}

/* The axis of a sphere about which its angles are taken: the coordinate that is least from
 * the centre at the start, so that the poles are far. */
static size_t
choose_axis(const work *w, const qdot_expr *x, const ball *given)
{
    size_t best = 2;
    double least = INFINITY;

    for (size_t k = most_axes; k-- > 0;) {
        const double from = fabs(
            w->start->size(qdot_sub(w->pool, x[k], given->centre[k]), w->start->user));

        if (from < least) {
            least = from;
            best = k;
        }
    }
    return best;
}

/* Solve a sphere by x = a + l sin u cos v, y = b + l sin u sin v, z = c - l cos u, with z as its axis. */
static bool
solve_sphere_about_axis(work *w, const size_t *index, const qdot_expr *x, const ball *now,
                        const ball *given)
{
    qdot_pool *pool = w->pool;
    const size_t axis = choose_axis(w, x, given);
    const size_t i = (axis + 1) % most_axes, j = (axis + 2) % most_axes;
    qdot_expr dx = qdot_sub(pool, x[i], given->centre[i]);
    qdot_expr dy = qdot_sub(pool, x[j], given->centre[j]);
    qdot_expr dz = qdot_sub(pool, given->centre[axis], x[axis]);
    qdot_expr l = qdot_mech_tidy(w->s, qdot_sqrt(pool, now->square)), u, v, out;

    u = add_new_angle(w, qdot_sqrt(pool, qdot_add(pool, qdot_mul(pool, dx, dx),
                                                  qdot_mul(pool, dy, dy))),
                      dz);
    v = add_new_angle(w, dy, dx);
    out = multiply_by_function(pool, l, QDOT_SIN, u);
    record_solution(w, index[i], qdot_add(pool, now->centre[i], multiply_by_function(pool, out, QDOT_COS, v)));
    record_solution(w, index[j], qdot_add(pool, now->centre[j], multiply_by_function(pool, out, QDOT_SIN, v)));
    record_solution(w, index[axis], qdot_sub(pool, now->centre[axis], multiply_by_function(pool, l, QDOT_COS, u)));
    return true;
}

static bool
solve_sphere(work *w, qdot_expr f, qdot_expr whole)
{
    const size_t n = w->out->n;

    for (size_t i = 0; i < n; i++)
        for (size_t j = i + 1; j < n; j++)
            for (size_t k = j + 1; k < n && !w->gone[i] && !w->gone[j]; k++) {
                const qdot_expr *q = w->s->coordinates.at;
                const qdot_expr x[] = {q[i], q[j], q[k]};
                const size_t index[] = {i, j, k};
                ball now, given;

                if (!w->gone[k] && is_circle_or_sphere(w, f, 3, x, &now) &&
                    is_circle_or_sphere(w, whole, 3, x, &given))
                    return solve_sphere_about_axis(w, index, x, &now, &given);
            }
    return false;
}

/* The function that constraint k keeps at 0: f, or its integral F minus F at the start; nil: there is neither. */
static qdot_expr
conserved_function(work *w, size_t k)
{
    const qdot_constraint *c = &w->s->constraints.at[k];
    qdot_expr mu, F;

    if (c->kind == QDOT_HOLONOMIC)
        return c->f;
    F = c->kind == QDOT_VELOCITY ? qdot_integrated_of(w->s, k, &mu) : QDOT_NIL;
    return F == QDOT_NIL ? QDOT_NIL
                         : qdot_sub(w->pool, F, w->start->value(F, w->start->user));
}

/* Solve what can be solved until nothing more can; QDOT_OK with a reason if something is
 * left. */
static qdot_status
solve_all_constraints(work *w)
{
    static bool (*const ways[])(work *, qdot_expr, qdot_expr) = {solve_linear, solve_circle,
                                                                 solve_sphere};
    size_t c = w->s->constraints.n, left = c;
    bool progress = true;

    for (size_t k = 0; k < c; k++) {
        w->held[k] = conserved_function(w, k);
        QDOT_TRY(qdot_pool_check(w->pool));
        if (w->held[k] == QDOT_NIL) {
            snprintf(w->out->reason, sizeof w->out->reason,
                     "constraint %.60s is not holonomic", w->s->constraints.at[k].name);
            return QDOT_OK;
        }
    }
    while (left > 0 && progress) {
        progress = false;
        for (size_t way = 0; way < sizeof ways / sizeof *ways && !progress; way++)
            for (size_t k = 0; k < c && !progress; k++) {
                qdot_expr whole = w->held[k], f;

                if (w->solved[k])
                    continue;
                f = insert_solutions(w, whole);
                w->solved[k] = f == QDOT_ZERO ||
                               ways[way](w, f, whole);
                progress = w->solved[k];
                left -= w->solved[k];
                QDOT_TRY(qdot_pool_check(w->pool));
            }
    }
    for (size_t k = 0; k < c && left > 0; k++)
        if (!w->solved[k]) {
            snprintf(w->out->reason, sizeof w->out->reason,
                     "constraint %.60s is linear in no coordinate, and no circle or sphere",
                     w->s->constraints.at[k].name);
            break;
        }
    return QDOT_OK;
}

/* --- the scene anew ----------------------------------------------------------------- */

static qdot_status
make_minimal_scene(work *w)
{
    qdot_scene *to = qdot_scene_new(w->pool);
    qdot_minimal *m = w->out;

    m->scene = to;
    if (!to)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < m->n; i++)
        if (!w->gone[i])
            QDOT_TRY(qdot_scene_coordinate(to, w->s->coordinates.at[i]));
    for (size_t k = 0; k < m->fresh; k++)
        QDOT_TRY(qdot_scene_coordinate(to, w->angle[k]));
    QDOT_TRY(qdot_scene_copy_things(w->s, to));
    for (size_t i = 0; i < m->n; i++) {
        qdot_expr rate;

        if (!w->gone[i])
            continue;
        rate = qdot_ddt(w->pool, m->given[i]);
        QDOT_TRY(qdot_pool_check(w->pool));
        QDOT_TRY(qdot_scene_replace(to, qdot_mech_jet(w->s, i, 1), rate));
        QDOT_TRY(qdot_scene_replace(to, w->s->coordinates.at[i], m->given[i]));
    }
    return QDOT_OK;
}

/* Whether a generalized force acts on an eliminated coordinate, so that there is no minimal form. */
static bool
force_acts_on_eliminated(work *w)
{
    for (size_t k = 0; k < w->s->torques.n; k++)
        for (size_t i = 0; i < w->out->n; i++)
            if (w->gone[i] && w->s->torques.at[k].coordinate == w->s->coordinates.at[i]) {
                snprintf(w->out->reason, sizeof w->out->reason,
                         "a generalized force acts on %.60s, which would go",
                         qdot_expr_symbol(w->pool, w->s->coordinates.at[i])->name);
                return true;
            }
    return false;
}

qdot_status
qdot_minimal_make(qdot_scene *s, const qdot_minimal_start *start, qdot_minimal *m)
{
    size_t n = s->coordinates.n;
    work w = {.s = s, .pool = s->pool, .out = m, .start = start};
    qdot_status status;

    *m = (qdot_minimal){.n = n};
    m->given = qdot_calloc(n + 1, sizeof *m->given);
    m->angle = qdot_calloc(n + 1, sizeof *m->angle);
    w.angle = qdot_calloc(n + 1, sizeof *w.angle);
    w.gone = qdot_calloc(n + 1, sizeof *w.gone);
    w.solved = qdot_calloc(s->constraints.n + 1, sizeof *w.solved);
    w.held = qdot_calloc(s->constraints.n + 1, sizeof *w.held);
    status = m->given && m->angle && w.angle && w.gone && w.solved && w.held ? QDOT_OK
                                                                             : QDOT_ENOMEM;
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        m->given[i] = s->coordinates.at[i];
    if (status == QDOT_OK)
        status = solve_all_constraints(&w);
    if (status == QDOT_OK && m->reason[0] == '\0' && !force_acts_on_eliminated(&w))
        status = make_minimal_scene(&w);
    qdot_free(w.angle);
    qdot_free(w.gone);
    qdot_free(w.solved);
    qdot_free(w.held);
    if (status != QDOT_OK)
        qdot_minimal_clear(m);
    return status;
}
