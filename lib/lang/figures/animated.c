/* animated.c -- makes an animation of a run: particles as points, springs and rods as lines, bodies. */
#include "lang/figures/animated.h"

#include <math.h>
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/figures/solid.h"
#include "lang/session/units.h"
#include "mech/study/rods.h"

enum {
    FEWEST = 1201,
    MOST = 20001,
    MOST_NUMBERS = 2000000, /* largest number of values in all columns */
    MOST_STATES = 24,       /* largest number of coordinates with a phase portrait */
    A_SECOND = 60,
};

typedef struct {
    qdot_session *session;
    qdot_scene *scene;
    qdot_run *run;
    qdot_animation *a;
    qdot_rods rods;
    bool upright; /* one-dimensional motion is drawn vertically, because there is gravity */
    qdot_vec(qdot_expr) columns; /* expressions that are stored for each frame */
    qdot_vec(qdot_expr) places;  /* positions of the points as expressions, multiplied out */
    qdot_vec(qdot_expr) once;    /* expressions needed at the first frame only */
    double *first;               /* the values of `once` at the first frame */
} builder;

static uint32_t
dimension_of_position(const qdot_pool *pool, qdot_expr r)
{
    return qdot_expr_kind(pool, r) == QDOT_VEC ? qdot_expr_count(pool, r) : 1;
}

static qdot_expr
component_of_position(const qdot_pool *pool, qdot_expr r, uint32_t d)
{
    return qdot_expr_kind(pool, r) == QDOT_VEC ? qdot_expr_arg(pool, r, d) : r;
}

/* --- columns and points ------------------------------------------------------------- */

static qdot_status
find_or_add_column(builder *b, qdot_expr e, size_t *at)
{
    QDOT_TRY(qdot_pool_check(b->scene->pool));
    for (size_t i = 0; i < b->columns.n; i++)
        if (b->columns.at[i] == e) {
            *at = i;
            return QDOT_OK;
        }
    *at = b->columns.n;
    return qdot_vec_push(&b->columns, e);
}

static qdot_status
find_or_add_point(builder *b, qdot_expr r, size_t *at)
{
    qdot_pool *pool = b->scene->pool;
    uint32_t n = dimension_of_position(pool, r);
    qdot_animation_point p = {{0}};

    r = qdot_expand(pool, r);
    QDOT_TRY(qdot_pool_check(pool));
    for (size_t i = 0; i < b->places.n; i++)
        if (b->places.at[i] == r) {
            *at = i;
            return QDOT_OK;
        }
    for (uint32_t d = 0; d < b->a->dimension; d++) {
        bool given = n > 1 ? d < n : d == (b->upright ? 1 : 0);

        QDOT_TRY(
            find_or_add_column(b, given ? component_of_position(pool, r, n > 1 ? d : 0) : QDOT_ZERO, &p.at[d]));
    }
    *at = b->a->points.n;
    QDOT_TRY(qdot_vec_push(&b->places, r));
    return qdot_vec_push(&b->a->points, p);
}

static qdot_status
request_first_value(builder *b, qdot_expr e)
{
    QDOT_TRY(qdot_pool_check(b->scene->pool));
    return qdot_vec_push(&b->once, e);
}

/* --- things of the scene ------------------------------------------------------------ */

static qdot_status
add_particles(builder *b)
{
    for (size_t i = 0; i < b->scene->particles.n; i++) {
        const qdot_particle *p = &b->scene->particles.at[i];
        qdot_animation_particle one = {.name = p->name};

        QDOT_TRY(find_or_add_point(b, p->position, &one.point));
        QDOT_TRY(request_first_value(b, p->mass));
        QDOT_TRY(qdot_vec_push(&b->a->particles, one));
    }
    return QDOT_OK;
}

static qdot_status
add_spring_or_rod(builder *b, qdot_animation_kind kind, const qdot_expr ends[2])
{
    qdot_animation_link link = {.kind = kind};

    QDOT_TRY(find_or_add_point(b, ends[0], &link.ends[0]));
    QDOT_TRY(find_or_add_point(b, ends[1], &link.ends[1]));
    return qdot_vec_push(&b->a->links, link);
}

static qdot_status
add_springs_and_rods(builder *b)
{
    const qdot_scene *s = b->scene;
    qdot_status status = qdot_mech_rods(b->scene, &b->rods);

    for (size_t i = 0; i < b->rods.n && status == QDOT_OK; i++)
        status = add_spring_or_rod(b, QDOT_ANIMATION_ROD, b->rods.at[i].ends);
    for (size_t i = 0; i < s->springs.n && status == QDOT_OK; i++)
        status = add_spring_or_rod(b, QDOT_ANIMATION_SPRING, s->springs.at[i].at);
    for (size_t i = 0; i < s->dampers.n && status == QDOT_OK; i++)
        status = add_spring_or_rod(b, QDOT_ANIMATION_DAMPER, s->dampers.at[i].at);
    return status;
}

/* Add the arms by which body i is drawn, as points; in the plane also their positions in the body's frame. */
static qdot_status
add_arms(builder *b, size_t i, qdot_animation_body *one)
{
    qdot_scene *s = b->scene;
    const qdot_body *body = &s->bodies.at[i];
    qdot_arms arms = {0};
    qdot_status status = qdot_mech_arms(s, i, &b->rods, &arms);

    for (size_t k = 0; k < arms.n && k < QDOT_ANIMATION_ARMS && status == QDOT_OK; k++) {
        qdot_expr own =
            qdot_value_mul(s->pool, qdot_transpose(s->pool, body->rotation),
                           qdot_value_sub(s->pool, arms.at[k], body->position));

        status = find_or_add_point(b, arms.at[k], &one->arms[one->n_arms++]);
        for (uint32_t d = 0; d < 2 && status == QDOT_OK && body->angle != QDOT_NIL; d++)
            status = request_first_value(b, component_of_position(s->pool, own, d));
    }
    qdot_free(arms.at);
    return status;
}

static qdot_status
add_bodies(builder *b)
{
    qdot_pool *pool = b->scene->pool;

    for (size_t i = 0; i < b->scene->bodies.n; i++) {
        const qdot_body *body = &b->scene->bodies.at[i];
        qdot_animation_body one = {.name = body->name};
        uint32_t n = dimension_of_position(pool, body->position);

        QDOT_TRY(find_or_add_point(b, body->position, &one.point));
        for (uint32_t k = 0; k < (n == 3 ? 6 : 2); k++)
            QDOT_TRY(find_or_add_column(b, qdot_expr_arg(pool, body->rotation, k % n * n + k / n),
                                        &one.axes[k]));
        QDOT_TRY(request_first_value(b, body->mass));
        if (n == 3)
            for (uint32_t k = 0; k < 9; k++)
                QDOT_TRY(request_first_value(b, qdot_expr_arg(pool, body->inertia, k)));
        else
            QDOT_TRY(request_first_value(b, body->inertia));
        QDOT_TRY(add_arms(b, i, &one));
        QDOT_TRY(qdot_vec_push(&b->a->bodies, one));
    }
    return QDOT_OK;
}

/* Choose the upward direction of the picture in space: against gravity, otherwise z. */
static qdot_status
request_gravity(builder *b)
{
    qdot_expr g = QDOT_NIL;

    for (size_t i = 0; i < b->scene->gravities.n; i++)
        g = g == QDOT_NIL
                ? b->scene->gravities.at[i].e
                : qdot_value_add(b->scene->pool, g, b->scene->gravities.at[i].e);
    for (uint32_t d = 0; d < 3; d++)
        QDOT_TRY(
            request_first_value(b, g == QDOT_NIL ? QDOT_ZERO : component_of_position(b->scene->pool, g, d)));
    return QDOT_OK;
}

/* --- choices that depend on the values at the first frame --------------------------- */

static void
scale_particles_by_mass(builder *b, const double **x)
{
    double most = 0;

    for (size_t i = 0; i < b->a->particles.n; i++)
        most = fmax(most, (*x)[i]);
    for (size_t i = 0; i < b->a->particles.n; i++) {
        double part = cbrt((*x)[i] / most);

        b->a->particles.at[i].size = isfinite(part) ? fmax(0.45, part) : 0.45;
    }
    *x += b->a->particles.n;
}

static void
set_body_shapes(builder *b, const double **x)
{
    for (size_t i = 0; i < b->a->bodies.n; i++) {
        qdot_animation_body *one = &b->a->bodies.at[i];
        double arms[QDOT_ANIMATION_ARMS][2];
        const double *mass = *x;

        if (b->a->dimension == 3) {
            qdot_solid_space(*mass, mass + 1, one);
            *x += 10;
            continue;
        }
        for (size_t k = 0; k < one->n_arms; k++)
            memcpy(arms[k], mass + 2 + 2 * k, sizeof arms[k]);
        qdot_solid_plane(mass[0], mass[1], (const double(*)[2])arms, one->n_arms, one);
        *x += 2 + 2 * one->n_arms;
    }
}

static void
set_upward_direction(builder *b, const double *x)
{
    double size = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);

    for (int d = 0; d < 3; d++)
        b->a->up[d] = size > 0 ? 0 - x[d] / size : d == 2;
}

/* --- phase portraits and energies --------------------------------------------------- */

static qdot_status
add_phase_portraits(builder *b)
{
    qdot_pool *pool = b->scene->pool;

    for (size_t i = 0; i < b->scene->coordinates.n && i < MOST_STATES; i++) {
        qdot_expr q = b->scene->coordinates.at[i], v = qdot_symbol_jet(pool, q, 1);
        qdot_text name = {0}, rate = {0};
        qdot_animation_state one = {0};

        QDOT_TRY(find_or_add_column(b, q, &one.q));
        QDOT_TRY(find_or_add_column(b, v, &one.v));
        if (qdot_print(pool, q, QDOT_UNICODE, &name) == QDOT_OK)
            qdot_units_in_brackets(b->session, q, &name);
        if (qdot_print(pool, v, QDOT_UNICODE, &rate) == QDOT_OK)
            qdot_units_in_brackets(b->session, v, &rate);
        if (qdot_pool_failed(pool) || qdot_text_status(&name) != QDOT_OK || qdot_text_status(&rate) != QDOT_OK ||
            qdot_vec_push(&b->a->states, one) != QDOT_OK) {
            qdot_text_clear(&name);
            qdot_text_clear(&rate);
            return QDOT_ENOMEM;
        }
        b->a->states.at[i].name = name.at;
        b->a->states.at[i].rate = rate.at;
    }
    return QDOT_OK;
}

/* The scalar product v.v of a vector, or the square of a number. */
static qdot_expr
norm_squared(qdot_pool *pool, qdot_expr v)
{
    return v != QDOT_NIL && qdot_expr_kind(pool, v) == QDOT_VEC ? qdot_dot(pool, v, v)
                                                                : qdot_mul(pool, v, v);
}

/* The kinetic energy T, not simplified, as only numbers are needed. */
static qdot_expr
kinetic_energy(qdot_scene *s)
{
    qdot_pool *pool = s->pool;
    qdot_expr twice = QDOT_ZERO;

    for (size_t i = 0; i < s->particles.n + s->bodies.n; i++) {
        const qdot_massive one = qdot_scene_massive(s, i);
        const qdot_body *b = one.body;
        qdot_expr w;

        twice = qdot_add(pool, twice, qdot_mul(pool, one.mass, norm_squared(pool, qdot_ddt(pool, one.position))));
        if (b == NULL)
            continue;
        w = qdot_scene_spin(s, b->name);
        if (b->angle == QDOT_NIL) {
            w = qdot_value_mul(pool, qdot_transpose(pool, b->rotation), w);
            twice = qdot_add(pool, twice,
                             qdot_dot(pool, w, qdot_value_mul(pool, b->inertia, w)));
        } else {
            twice =
                qdot_add(pool, twice, qdot_mul(pool, b->inertia, qdot_mul(pool, w, w)));
        }
    }
    return qdot_mul(pool, QDOT_HALF, twice);
}

/* *unit: that of e; NULL if it has none. */
static qdot_status
find_unit(const builder *b, qdot_expr e, char **unit)
{
    qdot_text text = {0};

    qdot_units_label(b->session, e, &text);
    if (text.n > 0)
        *unit = text.at;
    else
        qdot_text_clear(&text);
    return text.failed ? QDOT_ENOMEM : QDOT_OK;
}

static qdot_status
add_energy_parts(builder *b)
{
    qdot_scene *s = b->scene;
    qdot_expr T = kinetic_energy(s), V = qdot_mech_potential(s);
    qdot_animation_energy list[3] = {{"T", 0}, {"V", 0}, {"T + V", 0}};
    bool magnetic;

    QDOT_TRY(qdot_pool_check(s->pool));
    magnetic = (qdot_expr_node(s->pool, V)->holds & QDOT_HAS_VELOCITY) != 0;
    if (magnetic)
        list[2].name = "h";
    QDOT_TRY(find_or_add_column(b, T, &list[0].column));
    if (!magnetic)
        QDOT_TRY(find_or_add_column(b, V, &list[1].column));
    QDOT_TRY(find_or_add_column(b, magnetic ? qdot_mech_numeric_energy(s) : qdot_add(s->pool, T, V),
                                &list[2].column));
    for (int i = 0; i < 3; i++)
        if (i != 1 || !magnetic)
            QDOT_TRY(qdot_vec_push(&b->a->energies, list[i]));
    return QDOT_OK;
}

/* T, V and their sum; where V holds velocities, as of a magnetic field, T and the energy h; of a
 * stated Lagrangian h alone. */
static qdot_status
add_energies(builder *b)
{
    qdot_scene *s = b->scene;
    qdot_animation_energy h = {"h", 0};

    QDOT_TRY(find_unit(b, qdot_mech_numeric_energy(s), &b->a->energy));
    if (s->lagrangian == QDOT_NIL)
        return add_energy_parts(b);
    QDOT_TRY(find_or_add_column(b, qdot_mech_numeric_energy(s), &h.column));
    return qdot_vec_push(&b->a->energies, h);
}
/* --- times of the frames ------------------------------------------------------------ */

static qdot_status
set_time_span(builder *b, const qdot_animated_options *o)
{
    const qdot_run_report *r = qdot_run_get_report(b->run);
    const double lo = fmin(r->t0, r->t1), hi = fmax(r->t0, r->t1);

    QDOT_TRY(find_unit(b, QDOT_T, &b->a->time));
    b->a->t0 = isnan(o->from) ? r->t0 : o->from;
    b->a->t1 = isnan(o->to) ? r->t1 : o->to;
    if (fmin(b->a->t0, b->a->t1) < lo || fmax(b->a->t0, b->a->t1) > hi)
        return qdot_fail(QDOT_EDOMAIN,
                         "t = %.10g..%.10g lies outside the run, t = %.10g..%.10g",
                         b->a->t0, b->a->t1, r->t0, r->t1);
    if (b->a->t0 == b->a->t1)
        return qdot_fail(QDOT_EDOMAIN, "nothing moves between t = %.10g and itself",
                         b->a->t0);
    return QDOT_OK;
}

/* The largest number at most x that is 1, 2 or 5 times a power of ten. */
static double
round_down_to_1_2_5(double x)
{
    double ten = pow(10, floor(log10(x)));

    return x / ten >= 5 ? 5 * ten : x / ten >= 2 ? 2 * ten : ten;
}

static qdot_status
choose_frames(builder *b, const qdot_animated_options *o)
{
    const qdot_run_report *r = qdot_run_get_report(b->run);
    const double span = fabs(b->a->t1 - b->a->t0);
    const double steps = (double)r->steps * span / fabs(r->t1 - r->t0);
    double frames, most;

    b->a->speed = !isnan(o->speed)          ? o->speed
                  : span >= 4 && span <= 60 ? 1
                                            : round_down_to_1_2_5(span / 20 * (1 + 1e-9));
    b->a->trail = isnan(o->trail) ? fmin(span, 4 * b->a->speed) : o->trail;
    frames = fmax(A_SECOND * span / fmin(1, b->a->speed), 4 * steps);
    most = fmin(MOST, fmax(FEWEST, (double)MOST_NUMBERS / (double)(b->columns.n + 1)));
    b->a->frames = (size_t)fmin(most, fmax(FEWEST, ceil(frames) + 1));
    if (steps <= (double)b->a->frames)
        return QDOT_OK;
    return qdot_answer_notice(
        b->session,
        "%zu frames for %.0f steps of the run: faster motion is not "
        "seen; `from A to B` draws a part of it",
        b->a->frames, steps);
}

static qdot_status
evaluate_frames(builder *b)
{
    const size_t m = b->columns.n, n = b->a->frames;
    double *times = qdot_calloc(n, sizeof *times);
    double *rows = qdot_calloc(m * n, sizeof *rows);
    qdot_status status = QDOT_ENOMEM;

    b->a->columns = m;
    b->a->values = qdot_calloc(m * n, sizeof *rows);
    b->first = qdot_calloc(b->once.n, sizeof *b->first);
    if (times != NULL && rows != NULL && b->a->values != NULL && b->first != NULL) {
        for (size_t k = 0; k < n; k++)
            times[k] = k + 1 == n ? b->a->t1
                                  : b->a->t0 + (b->a->t1 - b->a->t0) * (double)k /
                                                   (double)(n - 1);
        status = qdot_run_values(b->run, m, b->columns.at, n, times, rows, NULL);
    }
    if (status == QDOT_OK)
        status = qdot_run_values(b->run, b->once.n, b->once.at, 1, times, b->first, NULL);
    for (size_t k = 0; k < n && status == QDOT_OK; k++)
        for (size_t i = 0; i < m; i++)
            b->a->values[i * n + k] = rows[k * m + i];
    qdot_free(times);
    qdot_free(rows);
    return status;
}

/* --- making the animation ----------------------------------------------------------- */

static qdot_status
check_scene(builder *b, bool bare)
{
    const qdot_run_report *r = qdot_run_get_report(b->run);
    const qdot_scene *s = b->scene;
    bool same = s->coordinates.n == r->n - r->n_states;

    for (size_t i = 0; i < s->coordinates.n && same; i++)
        same = s->coordinates.at[i] == r->coordinates[i];
    if (!same) {
        (void)qdot_fail(QDOT_EINVAL, "the scene has other coordinates than the run");
        return qdot_hint("only the present scene is drawn: `run` it again");
    }
    if (bare || s->particles.n + s->bodies.n > 0)
        return QDOT_OK;
    (void)qdot_fail(QDOT_EINVAL, "the scene has no particle and no body to draw");
    return s->lagrangian != QDOT_NIL ? qdot_hint("a stated Lagrangian does not say where "
                                                 "anything is; `plot` shows the run")
                                     : qdot_hint("particle bob mass m at (x, y)");
}

/* Add everything that the animation shows. */
static qdot_status
add_all_things(builder *b)
{
    const qdot_scene *s = b->scene;
    qdot_expr r =
        s->particles.n > 0 ? s->particles.at[0].position : s->bodies.at[0].position;

    b->a->dimension = dimension_of_position(s->pool, r) == 3 ? 3 : 2;
    b->upright = s->gravities.n > 0;
    QDOT_TRY(add_particles(b));
    QDOT_TRY(add_springs_and_rods(b));
    QDOT_TRY(add_bodies(b));
    return b->a->dimension == 3 ? request_gravity(b) : QDOT_OK;
}

/* Use the values at the first frame, in the order in which add_all_things asked for them. */
static void
use_first_values(builder *b)
{
    const double *x = b->first;

    scale_particles_by_mass(b, &x);
    set_body_shapes(b, &x);
    if (b->a->dimension == 3)
        set_upward_direction(b, x);
}

static qdot_status
build_animation(builder *b, const qdot_animated_options *o)
{
    QDOT_TRY(check_scene(b, o->bare));
    QDOT_TRY(set_time_span(b, o));
    b->a->dimension = 2;
    if (o->title != NULL && (b->a->title = qdot_strdup(o->title)) == NULL)
        return QDOT_ENOMEM;
    if (!o->bare)
        QDOT_TRY(add_all_things(b));
    QDOT_TRY(add_phase_portraits(b));
    QDOT_TRY(add_energies(b));
    QDOT_TRY(choose_frames(b, o));
    QDOT_TRY(evaluate_frames(b));
    use_first_values(b);
    return QDOT_OK;
}

qdot_status
qdot_animated_make(qdot_session *session, const qdot_named_run *run,
                   const qdot_animated_options *options, qdot_animation *a)
{
    builder b = {.session = session, .scene = session->scene, .run = run->run, .a = a};
    qdot_status status;

    *a = (qdot_animation){0};
    status = build_animation(&b, options);
    if (status == QDOT_OK)
        status = qdot_animated_facts(session, run, a);
    qdot_free(b.rods.at);
    qdot_free(b.columns.at);
    qdot_free(b.places.at);
    qdot_free(b.once.at);
    qdot_free(b.first);
    return status;
}
