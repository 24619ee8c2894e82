/* chart.c -- which groups of coordinates can be replaced, and the scene without them. */
#include "mech/study/chart.h"

#include <string.h>

#include "expr/calculus.h"
#include "expr/print.h"
#include "expr/walk.h"
#include "mech/scene/access.h"
#include "mech/scene/scene.h"
#include "mech/study/chart-body.h"

/* With more coordinates groups are not looked for. */
enum { MOST_COORDINATES = 12 };

/* Nor with more work than so many calls of constructors, some tenths of a second: those found by
 * then are all. */
static const uint64_t most_work = 300000;

void
qdot_chart_clear(qdot_chart *c)
{
    qdot_scene_free(c->scene);
    qdot_free(c->moved.at);
    qdot_free(c->fresh.at);
    qdot_free(c->distances.at);
    qdot_free(c->unit.at);
    qdot_text_clear(&c->names);
    *c = (qdot_chart){0};
}

/* --- the formulas of a group ------------------------------------------------------------- */

/* A chart that is being made. */
typedef struct {
    qdot_chart *c;
    qdot_scene *s;
    qdot_pool *pool;
    const qdot_expr *q; /* of the scene given */
} work;

static const char *
name_of(const work *w, size_t i)
{
    return qdot_expr_symbol(w->pool, w->q[i])->name;
}

static qdot_expr
sine(const work *w, qdot_expr e)
{
    return qdot_fun1(w->pool, QDOT_SIN, e);
}

static qdot_expr
cosine(const work *w, qdot_expr e)
{
    return qdot_fun1(w->pool, QDOT_COS, e);
}

static qdot_expr
times(const work *w, qdot_expr a, qdot_expr b)
{
    return qdot_mul(w->pool, a, b);
}

static qdot_expr
square_sum(const work *w, size_t n, const qdot_expr *x)
{
    qdot_expr sum = QDOT_ZERO;

    for (size_t i = 0; i < n; i++)
        sum = qdot_add(w->pool, sum, times(w, x[i], x[i]));
    return sum;
}

/* A symbol of its own for coordinate i. */
static qdot_expr
own_symbol(const work *w, const char *what, size_t i)
{
    char name[120];

    snprintf(name, sizeof name, "%s#%.80s", what, name_of(w, i));
    return qdot_symbol_get(w->pool, QDOT_FORMAL, name);
}

/* Say that the group is written in its new coordinates k ..., or in `what`. */
static void
add_name(work *w, size_t k, const char *what)
{
    qdot_text *names = &w->c->names;

    if (what)
        qdot_text_format(names, "%s%s", names->n > 0 ? ", " : "", what);
    for (; !what && k < w->c->fresh.n; k++)
        qdot_text_format(names, "%s%s", names->n > 0 ? ", " : "",
                         qdot_expr_symbol(w->pool, w->c->fresh.at[k].q)->name);
}

/* A new coordinate: it is called by what it is in those given. */
static qdot_status
add_fresh(work *w, qdot_expr given, qdot_expr *q)
{
    qdot_text name = {0};
    qdot_status status = qdot_print(w->pool, given, QDOT_PLAIN, &name);

    if (status == QDOT_OK)
        *q = qdot_symbol_get(w->pool, QDOT_COORD, qdot_text_str(&name));
    qdot_text_clear(&name);
    QDOT_TRY(status);
    return qdot_vec_push(&w->c->fresh, ((qdot_chart_fresh){*q, given}));
}

static qdot_status
add_length(work *w, size_t i, qdot_expr value)
{
    return qdot_vec_push(&w->c->moved,
                         ((qdot_chart_moved){.q = w->q[i], .value = value}));
}

/* The angle i = atan2(y, x), where x^2 + y^2 = norm^2. */
static qdot_status
add_angle(work *w, size_t i, qdot_expr x, qdot_expr y, qdot_expr norm)
{
    return qdot_vec_push(&w->c->moved,
                         ((qdot_chart_moved){.q = w->q[i],
                                             .angle = true,
                                             .cosine = qdot_div(w->pool, x, norm),
                                             .sine = qdot_div(w->pool, y, norm),
                                             .x = x,
                                             .y = y,
                                             .bare = own_symbol(w, "angle", i)}));
}

static qdot_status
put_plane(work *w, const size_t *index, qdot_expr sign)
{
    const qdot_expr r = w->q[index[0]], phi = w->q[index[1]];
    const qdot_expr N = own_symbol(w, "distance", index[1]);
    qdot_expr x[2];

    QDOT_TRY(add_fresh(w, times(w, r, cosine(w, phi)), x));
    QDOT_TRY(add_fresh(w, times(w, r, sine(w, phi)), x + 1));
    QDOT_TRY(
        qdot_vec_push(&w->c->distances, ((qdot_chart_distance){N, square_sum(w, 2, x)})));
    QDOT_TRY(add_length(w, index[0], times(w, sign, N)));
    return add_angle(w, index[1], times(w, sign, x[0]), times(w, sign, x[1]), N);
}

/* r is 1 on a sphere: index [2] is then of theta, phi. */
static qdot_status
put_space(work *w, const size_t *index, qdot_expr sign, bool sphere)
{
    const size_t i = index[sphere ? 0 : 1], j = index[sphere ? 1 : 2];
    const qdot_expr theta = w->q[i], phi = w->q[j],
                    r = sphere ? QDOT_ONE : w->q[index[0]];
    const qdot_expr N = own_symbol(w, "distance", j);
    qdot_expr x[3], across = times(w, r, sine(w, theta)), R;

    QDOT_TRY(add_fresh(w, times(w, across, cosine(w, phi)), x));
    QDOT_TRY(add_fresh(w, times(w, across, sine(w, phi)), x + 1));
    QDOT_TRY(add_fresh(w, times(w, r, cosine(w, theta)), x + 2));
    QDOT_TRY(
        qdot_vec_push(&w->c->distances, ((qdot_chart_distance){N, square_sum(w, 2, x)})));
    R = sphere ? QDOT_ONE : qdot_sqrt(w->pool, square_sum(w, 3, x));
    if (sphere)
        QDOT_TRY(qdot_vec_push(&w->c->unit, square_sum(w, 3, x)));
    else
        QDOT_TRY(add_length(w, index[0], R));
    QDOT_TRY(add_angle(w, i, x[2], times(w, sign, N), R));
    return add_angle(w, j, times(w, sign, x[0]), times(w, sign, x[1]), N);
}

static qdot_status
put_body(work *w, const size_t *index, qdot_expr sign)
{
    const qdot_expr phi = w->q[index[0]], theta = w->q[index[1]], psi = w->q[index[2]];
    const qdot_expr tilt = times(w, QDOT_HALF, theta);
    const qdot_expr sum = times(w, QDOT_HALF, qdot_add(w->pool, phi, psi));
    const qdot_expr difference = times(w, QDOT_HALF, qdot_sub(w->pool, phi, psi));
    const qdot_expr N = own_symbol(w, "distance", index[1]);
    const qdot_expr given[] = {times(w, cosine(w, tilt), cosine(w, sum)),
                               times(w, sine(w, tilt), cosine(w, difference)),
                               times(w, sine(w, tilt), sine(w, difference)),
                               times(w, cosine(w, tilt), sine(w, sum))};
    qdot_expr e[4], R[9];

    for (size_t k = 0; k < 4; k++)
        QDOT_TRY(add_fresh(w, given[k], e + k));
    QDOT_TRY(qdot_vec_push(&w->c->unit, square_sum(w, 4, e)));
    qdot_chart_body_axes(w->pool, e, R);
    QDOT_TRY(qdot_vec_push(
        &w->c->distances,
        ((qdot_chart_distance){
            N, times(w, qdot_expr_int(w->pool, 4),
                     times(w, square_sum(w, 2, e + 1),
                           square_sum(w, 2, (qdot_expr[]){e[0], e[3]})))})));
    QDOT_TRY(add_angle(w, index[0], qdot_neg(w->pool, times(w, sign, R[5])),
                       times(w, sign, R[2]), N));
    QDOT_TRY(add_angle(w, index[1], R[8], times(w, sign, N), QDOT_ONE));
    QDOT_TRY(add_angle(w, index[2], times(w, sign, R[7]), times(w, sign, R[6]), N));
    return qdot_chart_body_replace(w->s, w->c->scene,
                                   qdot_scene_euler(w->pool, phi, theta, psi), R,
                                   w->c->hindrance, sizeof w->c->hindrance);
}

static size_t
size_of(qdot_chart_kind kind)
{
    return kind == QDOT_CHART_PLANE || kind == QDOT_CHART_SPHERE ? 2 : 3;
}

static qdot_status
put_group(work *w, const qdot_chart_group *g, int sign)
{
    const qdot_expr way = sign < 0 ? QDOT_MINUS_ONE : QDOT_ONE;
    const size_t before = w->c->fresh.n;
    char what[200];

    switch (g->kind) {
    case QDOT_CHART_PLANE: QDOT_TRY(put_plane(w, g->index, way)); break;
    case QDOT_CHART_SPACE: QDOT_TRY(put_space(w, g->index, way, false)); break;
    case QDOT_CHART_SPHERE: QDOT_TRY(put_space(w, g->index, way, true)); break;
    default: QDOT_TRY(put_body(w, g->index, way));
    }
    snprintf(what, sizeof what, "the unit quaternion of %.50s, %.50s, %.50s",
             name_of(w, g->index[0]), name_of(w, g->index[1]), name_of(w, g->index[2]));
    add_name(w, before, g->kind == QDOT_CHART_BODY ? what : NULL);
    return QDOT_OK;
}

/* --- the scene anew ------------------------------------------------------------------------ */

static bool
is_moved(const qdot_chart *c, qdot_expr q)
{
    for (size_t i = 0; i < c->moved.n; i++)
        if (c->moved.at[i].q == q)
            return true;
    return false;
}

/* Whether the angle is singular at 0 and pi, as it lies between N and an axis. */
static bool
is_tilt(const qdot_chart *c, const qdot_chart_moved *m)
{
    for (size_t i = 0; i < c->distances.n; i++)
        if (qdot_expr_contains(c->pool, m->y, c->distances.at[i].symbol))
            return true;
    return false;
}

static qdot_expr
regular(qdot_expr e, void *user)
{
    qdot_chart *c = user;
    const qdot_expr now = c->hindrance[0] == '\0' ? qdot_chart_regular(c, e) : e;
    qdot_text text = {0};

    if (now != QDOT_NIL || qdot_pool_failed(c->pool))
        return now;
    if (c->open) {
        bool turns;
        const qdot_expr singular = qdot_chart_express(c, e, NULL, &turns);

        if (!turns)
            return qdot_mech_tidy(c->of, singular);
    }
    if (qdot_print(c->pool, e, QDOT_PLAIN, &text) == QDOT_OK)
        snprintf(c->hindrance, sizeof c->hindrance, "%.140s is not smooth there",
                 qdot_text_str(&text));
    qdot_text_clear(&text);
    return e;
}

/* A domain ends at singular places alone, which are none of the new coordinates. */
static void
check_domain(work *w, const qdot_chart_moved *m)
{
    const qdot_symbol *x = qdot_expr_symbol(w->pool, m->q);
    const bool within = !m->angle
                            ? x->lo == QDOT_ZERO && x->hi == QDOT_NIL
                            : x->lo == QDOT_ZERO && x->hi == QDOT_PI && is_tilt(w->c, m);

    if ((x->lo != QDOT_NIL || x->hi != QDOT_NIL) && !within)
        snprintf(w->c->hindrance, sizeof w->c->hindrance,
                 "the domain of %.80s ends elsewhere", x->name);
}

/* Whether e holds an angle outside of sin and cos that would jump after a turn; in a domain between
 * singular places it has no turns. */
static bool
jumps(const qdot_chart *c, qdot_expr e)
{
    const qdot_expr now = qdot_chart_put(c, e);

    for (size_t i = 0; i < c->moved.n && now != QDOT_NIL; i++) {
        const qdot_chart_moved *m = c->moved.at + i;

        if (m->angle && qdot_expr_symbol(c->pool, m->q)->lo == QDOT_NIL &&
            qdot_expr_contains(c->pool, now, m->bare))
            return true;
    }
    return false;
}

/* Events are watched in the new coordinates: they set none that is replaced, and hold nothing that
 * jumps. */
static qdot_status
copy_event(qdot_chart *c, const qdot_event *event)
{
    qdot_event own = *event;
    bool some = jumps(c, event->left) || jumps(c, event->right);
    qdot_status status = QDOT_OK;

    own.left = qdot_chart_express(c, event->left, NULL, NULL);
    own.right = qdot_chart_express(c, event->right, NULL, NULL);
    own.values.at = qdot_calloc(own.values.n + 1, sizeof *own.values.at);
    if (!own.values.at)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < own.values.n; i++) {
        const qdot_symbol *target = qdot_expr_symbol(c->pool, own.targets.at[i]);

        some |= is_moved(c, target && target->base != QDOT_NIL ? target->base
                                                               : own.targets.at[i]);
        own.values.at[i] = qdot_chart_express(c, event->values.at[i], NULL, NULL);
        some |= jumps(c, event->values.at[i]);
    }
    if (some)
        snprintf(c->hindrance, sizeof c->hindrance, "event %.80s needs the angle itself",
                 event->name);
    else
        status = qdot_pool_check(c->pool);
    if (!some && status == QDOT_OK)
        status = qdot_scene_event(c->scene, &own);
    qdot_free(own.values.at);
    return status;
}

/* Nor are those that hold a root N. */
static void
check_places(qdot_chart *c)
{
    for (size_t k = 0; k < c->distances.n && c->open; k++)
        for (size_t i = 0; i < c->scene->particles.n; i++)
            if (qdot_expr_contains(c->pool, c->scene->particles.at[i].position,
                                   qdot_sqrt(c->pool, c->distances.at[k].square)))
                snprintf(c->hindrance, sizeof c->hindrance, "a place is not smooth");
}

/* Places that hold the length of a group itself are not smooth where it is 0. */
static void
check_lengths(qdot_chart *c)
{
    for (size_t k = 0; k < c->moved.n; k++)
        for (size_t i = 0; i < c->scene->particles.n && !c->moved.at[k].angle; i++)
            if (qdot_expr_contains(
                    c->pool, c->scene->particles.at[i].position,
                    qdot_mul(c->pool, c->moved.at[k].value, c->moved.at[k].value)))
                snprintf(c->hindrance, sizeof c->hindrance,
                         "a place holds %.80s otherwise",
                         qdot_expr_symbol(c->pool, c->moved.at[k].q)->name);
}

static qdot_status
complete(work *w)
{
    qdot_chart *c = w->c;
    const qdot_scene *s = w->s;

    for (size_t i = 0; i < c->fresh.n; i++)
        QDOT_TRY(qdot_scene_coordinate(c->scene, c->fresh.at[i].q));
    for (size_t i = 0; i < c->moved.n; i++)
        check_domain(w, c->moved.at + i);
    QDOT_TRY(qdot_scene_map(c->scene, regular, c));
    check_lengths(c);
    check_places(c);
    for (size_t i = 0; i < c->unit.n && c->hindrance[0] == '\0'; i++)
        QDOT_TRY(qdot_scene_constraint(c->scene, NULL, c->unit.at[i], QDOT_ONE));
    for (size_t i = 0; i < s->events.n && c->hindrance[0] == '\0'; i++)
        QDOT_TRY(copy_event(c, &s->events.at[i]));
    return qdot_pool_check(w->pool);
}

static bool
is_taken(const qdot_chart_groups *groups, size_t i)
{
    for (size_t k = 0; k < groups->n; k++)
        for (size_t j = 0; j < size_of(groups->at[k].kind); j++)
            if (groups->at[k].index[j] == i)
                return true;
    return false;
}

/* The coordinates that stay, and the things; a generalized force on one that goes has no place. */
static qdot_status
begin_scene(work *w, const qdot_chart_groups *groups)
{
    const qdot_scene *s = w->s;
    qdot_chart *c = w->c;

    for (size_t i = 0; i < s->coordinates.n; i++) {
        if (!is_taken(groups, i)) {
            QDOT_TRY(qdot_scene_coordinate(c->scene, w->q[i]));
            continue;
        }
        for (size_t k = 0; k < s->torques.n; k++)
            if (s->torques.at[k].coordinate == w->q[i])
                snprintf(c->hindrance, sizeof c->hindrance,
                         "a generalized force acts on %.60s", name_of(w, i));
    }
    return c->hindrance[0] == '\0' ? qdot_scene_copy_things(s, c->scene) : QDOT_OK;
}

qdot_status
qdot_chart_make(qdot_scene *s, const qdot_chart_groups *groups, const int *sign,
                bool open, qdot_chart *c)
{
    work w = {c, s, s->pool, s->coordinates.at};

    *c = (qdot_chart){
        .pool = s->pool, .of = s, .scene = qdot_scene_new(s->pool), .open = open};
    if (!c->scene)
        return QDOT_ENOMEM;
    QDOT_TRY(begin_scene(&w, groups));
    for (size_t i = 0; i < groups->n && c->hindrance[0] == '\0'; i++)
        QDOT_TRY(put_group(&w, groups->at + i, sign ? sign[i] : 1));
    if (c->hindrance[0] == '\0')
        QDOT_TRY(complete(&w));
    QDOT_TRY(qdot_text_status(&c->names));
    if (c->hindrance[0] != '\0') {
        qdot_scene_free(c->scene);
        c->scene = NULL;
    }
    return QDOT_OK;
}

/* --- which groups there are ------------------------------------------------------------------ */

/* The distance from the singular place, in the coordinates given. */
static qdot_expr
distance_of(const qdot_scene *s, const qdot_chart_group *g)
{
    const qdot_expr *q = s->coordinates.at;
    const size_t *i = g->index;

    switch (g->kind) {
    case QDOT_CHART_PLANE: return q[i[0]];
    case QDOT_CHART_SPACE:
        return qdot_mul(s->pool, q[i[0]], qdot_fun1(s->pool, QDOT_SIN, q[i[1]]));
    case QDOT_CHART_SPHERE: return qdot_fun1(s->pool, QDOT_SIN, q[i[0]]);
    default: return qdot_fun1(s->pool, QDOT_SIN, q[i[1]]);
    }
}

/* Take the group if the scene is regular without it. */
static qdot_status
try_group(qdot_scene *s, bool open, qdot_chart_group g, qdot_chart_groups *groups)
{
    const qdot_chart_groups one = {.n = 1, .at = &g};
    qdot_chart chart = {0};
    qdot_status status;
    bool good;

    for (size_t k = 0; k < size_of(g.kind); k++)
        if (is_taken(groups, g.index[k]))
            return QDOT_OK;
    status = qdot_chart_make(s, &one, NULL, open, &chart);
    good = chart.scene != NULL;
    qdot_chart_clear(&chart);
    if (status == QDOT_EINVAL || status == QDOT_ETYPE || status == QDOT_EDOMAIN)
        return QDOT_OK;
    g.distance = distance_of(s, &g);
    return status == QDOT_OK && good ? qdot_vec_push(groups, g) : status;
}

/* Which pairs of coordinates stand in one term of a place, or of the Lagrangian. */
typedef struct {
    bool at[MOST_COORDINATES][MOST_COORDINATES];
} joined;

static void
join_pairs(const qdot_scene *s, qdot_expr e, bool rates, joined *pairs)
{
    const size_t n = s->coordinates.n;

    for (size_t i = 0; i < n && e != QDOT_NIL; i++) {
        const qdot_expr q = s->coordinates.at[i];
        const qdot_expr slope =
            qdot_expr_contains(s->pool, e, q) ? qdot_diff(s->pool, e, q) : QDOT_NIL;

        for (size_t j = 0; j < n && slope != QDOT_NIL; j++) {
            const qdot_expr with = s->coordinates.at[j];

            if (qdot_expr_contains(s->pool, slope, with) ||
                (rates &&
                 qdot_expr_contains(s->pool, slope, qdot_symbol_jet(s->pool, with, 1))))
                pairs->at[i][j] = pairs->at[j][i] = true;
        }
    }
}

/* rates: those in one term with the rate of another, too. */
static joined
find_pairs(const qdot_scene *s, bool rates)
{
    joined pairs = {0};

    for (size_t i = 0; i < s->particles.n + s->bodies.n; i++) {
        const qdot_expr r = i < s->particles.n
                                ? s->particles.at[i].position
                                : s->bodies.at[i - s->particles.n].position;

        for (uint32_t d = 0; d < qdot_mech_dimension(s->pool, r); d++)
            join_pairs(s, qdot_mech_component(s->pool, r, d), false, &pairs);
    }
    join_pairs(s, s->lagrangian, rates, &pairs);
    return pairs;
}

/* Whether the coordinates are all joined, as those of a group are. */
static bool
may_be(const joined *pairs, const size_t *index, size_t n)
{
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < i; j++)
            if (!pairs->at[index[i]][index[j]])
                return false;
    return true;
}

static qdot_status
try_kind(qdot_scene *s, bool open, qdot_chart_kind kind, const joined *pairs,
         qdot_chart_groups *groups)
{
    const size_t n = s->coordinates.n, third = size_of(kind) == 3 ? n : 1;

    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            for (size_t k = 0; k < third; k++) {
                const qdot_chart_group g = {.kind = kind,
                                            .index = {i, j, third > 1 ? k : 0}};

                if (i != j && (third == 1 || (k != i && k != j)) &&
                    (kind == QDOT_CHART_BODY ? qdot_chart_body_fits(s, g.index)
                                             : may_be(pairs, g.index, size_of(kind))))
                    QDOT_TRY(try_group(s, open, g, groups));
            }
    return QDOT_OK;
}

qdot_status
qdot_chart_find(qdot_scene *s, bool open, qdot_chart_groups *groups)
{
    static const qdot_chart_kind order[] = {QDOT_CHART_BODY, QDOT_CHART_SPACE,
                                            QDOT_CHART_PLANE, QDOT_CHART_SPHERE};
    const size_t first = open ? 1 : 0, end = open ? 3 : sizeof order / sizeof *order;
    joined pairs;
    uint64_t rest;
    qdot_status status = QDOT_OK, pending;

    if (s->constraints.n > 0 || s->coordinates.n > MOST_COORDINATES)
        return QDOT_OK;
    rest = qdot_pool_budget(s->pool, most_work);
    pairs = find_pairs(s, open);
    for (size_t k = first; k < end && status == QDOT_OK; k++)
        status = try_kind(s, open, order[k], &pairs, groups);
    pending = qdot_pool_check(s->pool);
    status = status == QDOT_OK ? pending : status;
    (void)qdot_pool_budget(s->pool, rest);
    return status == QDOT_ELIMIT ? QDOT_OK : status;
}
