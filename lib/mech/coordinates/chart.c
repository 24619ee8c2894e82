/* chart.c -- finds groups of coordinates that can be replaced by regular ones, and makes the scene in these. */
#include "mech/coordinates/chart.h"

#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/coordinates/chart-body.h"
#include "mech/scene/access.h"
#include "mech/scene/scene.h"

/* In scenes with more coordinates than this no groups to be replaced are searched for. */
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
    qdot_free(c->roots.at);
    qdot_free(c->signs.at);
    qdot_free(c->unit.at);
    qdot_text_clear(&c->names);
    *c = (qdot_chart){0};
}

/* --- the scene anew ------------------------------------------------------------------------ */

static bool
is_replaced(const qdot_chart *c, qdot_expr q)
{
    for (size_t i = 0; i < c->moved.n; i++)
        if (c->moved.at[i].q == q)
            return true;
    return false;
}

/* Whether e, in the coordinates of the given scene, contains an angle elsewhere than in sin and cos. */
static bool
contains_bare_angle(const qdot_chart *c, qdot_expr e)
{
    const qdot_expr now = qdot_chart_put(c, e);

    for (size_t i = 0; i < c->moved.n && now != QDOT_NIL; i++)
        if (c->moved.at[i].bare != QDOT_NIL &&
            qdot_expr_contains(c->pool, now, c->moved.at[i].bare))
            return true;
    return false;
}

static qdot_expr
make_regular(qdot_expr e, void *user)
{
    qdot_chart *c = user;
    const qdot_expr now = c->hindrance[0] == '\0' ? qdot_chart_regular(c, e) : e;
    qdot_text text = {0};

    if (now != QDOT_NIL || qdot_pool_failed(c->pool))
        return now;
    if (c->open && !contains_bare_angle(c, e))
        return qdot_mech_tidy(c->of, qdot_chart_express(c, e, NULL, NULL));
    if (qdot_print(c->pool, e, QDOT_PLAIN, &text) == QDOT_OK)
        snprintf(c->hindrance, sizeof c->hindrance, "%.140s is not smooth there",
                 qdot_text_str(&text));
    qdot_text_clear(&text);
    return e;
}

/* A domain ends at singular places alone, which are none of the new coordinates. Where one does
 * the sign of the coordinate stays. */
static void
check_domain(qdot_chart *c, qdot_chart_moved *m)
{
    const qdot_symbol *x = qdot_expr_symbol(c->pool, m->q);

    if ((x->lo != QDOT_NIL && x->lo != m->ends[0]) || (x->hi != QDOT_NIL && x->hi != m->ends[1]))
        snprintf(c->hindrance, sizeof c->hindrance, "the domain of %.80s ends elsewhere", x->name);
    if (x->lo == QDOT_NIL && x->hi == QDOT_NIL)
        return;
    m->between = x->lo != QDOT_NIL && x->hi != QDOT_NIL;
    if (m->sign > 0)
        c->signs.at[m->sign - 1].fixed = true;
}

/* Whether e holds an angle outside of sin and cos that would jump after a turn, in a domain between
 * singular places it has no turns; or a root that may change its sign. */
static bool
may_angle_jump(qdot_chart *c, qdot_expr e)
{
    qdot_expr now = qdot_chart_put(c, e);

    for (size_t i = 0; i < c->roots.n && now != QDOT_NIL; i++)
        if (c->roots.at[i].value != QDOT_NIL)
            now = qdot_subs(c->pool, now, 1, &c->roots.at[i].symbol, &c->roots.at[i].value);
    for (size_t i = 0; i < c->moved.n && now != QDOT_NIL; i++) {
        const qdot_chart_moved *m = c->moved.at + i;

        if (m->bare != QDOT_NIL && !m->between && qdot_expr_contains(c->pool, now, m->bare))
            return true;
    }
    for (size_t i = 0; i < c->signs.n && now != QDOT_NIL; i++) {
        const qdot_chart_sign *s = c->signs.at + i;
        const bool holds = !s->fixed && qdot_expr_contains(c->pool, now, s->symbol);

        if (holds && s->branch)
            return true;
        c->signed_events |= holds;
    }
    return false;
}

/* Events are watched in the new coordinates: they set none that is replaced, and hold nothing that
 * jumps. */
static qdot_status
copy_event(qdot_chart *c, const qdot_event *event)
{
    qdot_event own = *event;
    bool some = may_angle_jump(c, event->left) || may_angle_jump(c, event->right);
    qdot_status status = QDOT_OK;

    own.left = qdot_chart_express(c, event->left, NULL, NULL);
    own.right = qdot_chart_express(c, event->right, NULL, NULL);
    own.values.at = qdot_calloc(own.values.n + 1, sizeof *own.values.at);
    if (!own.values.at)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < own.values.n; i++) {
        const qdot_symbol *target = qdot_expr_symbol(c->pool, own.targets.at[i]);

        some |= is_replaced(c, target && target->base != QDOT_NIL ? target->base
                                                               : own.targets.at[i]);
        own.values.at[i] = qdot_chart_express(c, event->values.at[i], NULL, NULL);
        some |= may_angle_jump(c, event->values.at[i]);
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

/* Reject a chart if a position contains the root N (a distance), which is not smooth at N = 0. */
static void
check_positions(qdot_chart *c)
{
    for (size_t k = 0; k < c->roots.n && c->open; k++)
        for (size_t i = 0; i < c->scene->particles.n; i++)
            if (qdot_expr_contains(c->pool, c->scene->particles.at[i].position,
                                   qdot_sqrt(c->pool, c->roots.at[k].square)))
                snprintf(c->hindrance, sizeof c->hindrance, "a place is not smooth");
}

/* Reject a chart if a position contains a length of a replaced group by itself, which is not smooth at 0. */
static void
check_lengths_in_positions(qdot_chart *c)
{
    for (size_t k = 0; k < c->moved.n; k++)
        for (size_t i = 0; i < c->scene->particles.n && c->moved.at[k].sort == QDOT_CHART_LENGTH; i++)
            if (qdot_expr_contains(
                    c->pool, c->scene->particles.at[i].position,
                    qdot_mul(c->pool, c->moved.at[k].value, c->moved.at[k].value)))
                snprintf(c->hindrance, sizeof c->hindrance,
                         "a place holds %.80s otherwise",
                         qdot_expr_symbol(c->pool, c->moved.at[k].q)->name);
}

static qdot_status
complete_scene(qdot_chart *c)
{
    const qdot_scene *s = c->of;

    for (size_t i = 0; i < c->fresh.n; i++)
        QDOT_TRY(qdot_scene_coordinate(c->scene, c->fresh.at[i].q));
    for (size_t i = 0; i < c->moved.n; i++)
        check_domain(c, c->moved.at + i);
    QDOT_TRY(qdot_scene_map(c->scene, make_regular, c));
    check_lengths_in_positions(c);
    check_positions(c);
    for (size_t i = 0; i < c->unit.n && c->hindrance[0] == '\0'; i++)
        QDOT_TRY(qdot_scene_constraint(c->scene, NULL, c->unit.at[i], QDOT_ZERO));
    for (size_t i = 0; i < s->events.n && c->hindrance[0] == '\0'; i++)
        QDOT_TRY(copy_event(c, &s->events.at[i]));
    return qdot_pool_check(c->pool);
}

static bool
is_coordinate_in_group(const qdot_chart_groups *groups, size_t i)
{
    for (size_t k = 0; k < groups->n; k++)
        for (size_t j = 0; j < qdot_chart_size(groups->at[k].kind); j++)
            if (groups->at[k].index[j] == i)
                return true;
    return false;
}

/* Copy the constraints of the scene s, with their names and multipliers, to another scene. */
static qdot_status
copy_constraints(const qdot_scene *s, qdot_scene *to)
{
    for (size_t i = 0; i < s->constraints.n; i++) {
        qdot_constraint own = s->constraints.at[i];

        QDOT_TRY(qdot_scene_copy_text(to, own.name, &own.name));
        QDOT_TRY(qdot_scene_copy_text(to, own.label, &own.label));
        QDOT_TRY(qdot_vec_push(&to->constraints, own));
    }
    return QDOT_OK;
}

/* Copy the other coordinates and all things to the new scene; refuse a generalized force on a replaced coordinate. */
static qdot_status
copy_scene(qdot_chart *c, const qdot_chart_groups *groups)
{
    const qdot_scene *s = c->of;

    for (size_t i = 0; i < s->coordinates.n; i++) {
        const qdot_expr q = s->coordinates.at[i];

        if (!is_coordinate_in_group(groups, i)) {
            QDOT_TRY(qdot_scene_coordinate(c->scene, q));
            continue;
        }
        for (size_t k = 0; k < s->torques.n; k++)
            if (s->torques.at[k].coordinate == q)
                snprintf(c->hindrance, sizeof c->hindrance, "a generalized force acts on %.60s",
                         qdot_expr_symbol(c->pool, q)->name);
    }
    if (c->hindrance[0] != '\0')
        return QDOT_OK;
    QDOT_TRY(qdot_scene_copy_things(s, c->scene));
    return copy_constraints(s, c->scene);
}

qdot_status
qdot_chart_make(qdot_scene *s, const qdot_chart_groups *groups, const int *sign,
                bool open, qdot_chart *c)
{
    *c = (qdot_chart){
        .pool = s->pool, .of = s, .scene = qdot_scene_new(s->pool), .open = open};
    if (!c->scene)
        return QDOT_ENOMEM;
    QDOT_TRY(copy_scene(c, groups));
    for (size_t i = 0; i < groups->n && c->hindrance[0] == '\0'; i++)
        QDOT_TRY(qdot_chart_add(c, groups->at + i, sign ? sign[i] : 1));
    if (c->hindrance[0] == '\0')
        QDOT_TRY(complete_scene(c));
    QDOT_TRY(qdot_text_status(&c->names));
    if (c->hindrance[0] != '\0') {
        qdot_scene_free(c->scene);
        c->scene = NULL;
    }
    return QDOT_OK;
}

/* --- finding groups -------------------------------------------------------------------------- */

/* Add the group to the list if the scene is regular in the new coordinates of the group. */
static qdot_status
add_group_if_regular(qdot_scene *s, bool open, qdot_chart_group g, qdot_chart_groups *groups)
{
    const qdot_chart_groups one = {.n = 1, .at = &g};
    qdot_chart chart = {0};
    qdot_status status;
    bool good;

    for (size_t k = 0; k < qdot_chart_size(g.kind); k++)
        if (is_coordinate_in_group(groups, g.index[k]))
            return QDOT_OK;
    status = qdot_chart_make(s, &one, NULL, open, &chart);
    good = chart.scene != NULL;
    qdot_chart_clear(&chart);
    if (status == QDOT_EINVAL || status == QDOT_ETYPE || status == QDOT_EDOMAIN)
        return QDOT_OK;
    g.distance = qdot_chart_distance(s, &g);
    return status == QDOT_OK && good ? qdot_vec_push(groups, g) : status;
}

/* Which pairs of coordinates stand in one term of a place, or of the Lagrangian; and which
 * coordinates stand there in cosh or sinh, or outside of functions. */
typedef struct {
    bool at[MOST_COORDINATES][MOST_COORDINATES];
    bool hyperbolic[MOST_COORDINATES], square[MOST_COORDINATES];
} joined;

/* Whether e contains f(q) for this function f; function 0: q as a factor, or by itself. */
static bool
contains_function(qdot_pool *pool, qdot_expr e, uint16_t function, qdot_expr q)
{
    bool holds = false;
    qdot_walk w;

    if (qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return false;
    for (size_t i = 0; i < w.n && !holds; i++) {
        const qdot_node *node = qdot_expr_node(pool, w.at[i]);

        if (function)
            holds = node->kind == QDOT_FUN && node->op == function &&
                    qdot_expr_arg(pool, w.at[i], 0) == q;
        else
            for (uint32_t k = 0; node->kind == QDOT_PROD && k < qdot_expr_count(pool, w.at[i]); k++)
                holds = holds || qdot_expr_arg(pool, w.at[i], k) == q;
    }
    qdot_walk_end(&w);
    return holds;
}

static void
mark_coupled_coordinates(const qdot_scene *s, qdot_expr e, bool rates, joined *pairs)
{
    const size_t n = s->coordinates.n;

    for (size_t i = 0; i < n && e != QDOT_NIL; i++) {
        const qdot_expr q = s->coordinates.at[i];
        const qdot_expr slope =
            qdot_expr_contains(s->pool, e, q) ? qdot_diff(s->pool, e, q) : QDOT_NIL;

        for (size_t j = 0; j < n && slope != QDOT_NIL; j++) {
            const qdot_expr with = s->coordinates.at[j];

            pairs->at[i][j] |= qdot_expr_contains(s->pool, slope, with);
            if (rates && qdot_expr_contains(s->pool, slope, qdot_symbol_jet(s->pool, with, 1)))
                pairs->at[i][j] = pairs->at[j][i] = true;
        }
        pairs->hyperbolic[i] |= contains_function(s->pool, e, QDOT_COSH, q);
        pairs->square[i] |= contains_function(s->pool, e, 0, q);
    }
}

/* Find pairs of coordinates that occur together in positions; rates: also in one term of L with
 * their velocities. */
static joined
find_coupled_coordinates(const qdot_scene *s, bool rates)
{
    joined pairs = {0};

    for (size_t i = 0; i < s->particles.n + s->bodies.n; i++)
        for (uint32_t d = 0; d < qdot_mech_dimension(s->pool, qdot_scene_massive(s, i).position); d++)
            mark_coupled_coordinates(s, qdot_mech_component(s->pool, qdot_scene_massive(s, i).position, d), false, &pairs);
    mark_coupled_coordinates(s, s->lagrangian, rates, &pairs);
    return pairs;
}

/* Whether each two of these coordinates occur together in some expression, so that they may form a group. */
static bool
are_coupled_in_pairs(const joined *pairs, const size_t *index, size_t n)
{
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < i; j++)
            if (!pairs->at[index[i]][index[j]])
                return false;
    return true;
}

/* Test quickly whether coordinates may form a group, by the functions of them that occur. */
static bool
may_form_group(const qdot_scene *s, const qdot_chart_group *g, const joined *pairs)
{
    const size_t n = qdot_chart_size(g->kind);

    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < i; j++)
            if (g->index[i] == g->index[j])
                return false;
    if (g->kind == QDOT_CHART_BODY)
        return qdot_chart_body_fits(s, g->index);
    if (n == 0)
        return true;
    if (!are_coupled_in_pairs(pairs, g->index, n))
        return false;
    switch (g->kind) {
    case QDOT_CHART_ELLIPTIC:
    case QDOT_CHART_PROLATE:
    case QDOT_CHART_OBLATE:
        return pairs->hyperbolic[g->index[0]] && !pairs->hyperbolic[g->index[1]];
    case QDOT_CHART_PARABOLIC:
    case QDOT_CHART_PARABOLOIDS: return pairs->square[g->index[0]] && pairs->square[g->index[1]];
    default: return true;
    }
}

static qdot_status
try_groups_of_kind(qdot_scene *s, bool open, qdot_chart_kind kind, bool turned, const joined *pairs,
                   qdot_chart_groups *groups)
{
    const size_t n = s->coordinates.n, third = qdot_chart_size(kind) == 3 ? n : 1;

    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            for (size_t k = 0; k < third; k++) {
                /* unused indices must be 0, as the function `may_form_group` expects */
                const qdot_chart_group g = {
                    .kind = kind, .index = {i, j, third > 1 ? k : 0}, .turned = turned};

                if (may_form_group(s, &g, pairs))
                    QDOT_TRY(add_group_if_regular(s, open, g, groups));
            }
    return QDOT_OK;
}

/* Try whether square roots of expressions of coordinates, in a position r, are groups that can be replaced. */
static qdot_status
try_root_groups(qdot_scene *s, qdot_expr r, qdot_chart_groups *groups)
{
    qdot_pool *pool = s->pool;
    qdot_vec(qdot_expr) found = {0};
    qdot_status status;
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin(pool, r, &w));
    status = QDOT_OK;
    for (size_t i = 0; i < w.n && status == QDOT_OK; i++) {
        const qdot_node *node = qdot_expr_node(pool, w.at[i]);

        for (uint32_t f = 1; node->kind == QDOT_PROD && f + 1 < qdot_expr_count(pool, w.at[i])
                             && status == QDOT_OK; f += 2) {
            const qdot_expr base = qdot_expr_arg(pool, w.at[i], f);

            if (qdot_expr_arg(pool, w.at[i], f + 1) == QDOT_HALF
                && qdot_expr_node(pool, base)->holds & QDOT_HAS_COORD)
                status = qdot_vec_push(&found, base);
        }
    }
    qdot_walk_end(&w);
    for (size_t i = 0; i < found.n && status == QDOT_OK; i++) {
        bool known = false;

        for (size_t k = 0; k < groups->n; k++)
            known = known || groups->at[k].square == found.at[i];
        if (!known)
            status = add_group_if_regular(
                s, false, (qdot_chart_group){.kind = QDOT_CHART_ROOT, .square = found.at[i]}, groups);
    }
    qdot_free(found.at);
    return status;
}

qdot_status
qdot_chart_find(qdot_scene *s, bool open, qdot_chart_groups *groups)
{
    static const struct {
        qdot_chart_kind kind;
        bool turned;
    } order[] = {{QDOT_CHART_BODY, false},       {QDOT_CHART_SPACE, false},
                 {QDOT_CHART_SPACE, true},       {QDOT_CHART_PARABOLOIDS, false},
                 {QDOT_CHART_PROLATE, false},    {QDOT_CHART_PROLATE, true},
                 {QDOT_CHART_OBLATE, false},     {QDOT_CHART_OBLATE, true},
                 {QDOT_CHART_PLANE, false},      {QDOT_CHART_PARABOLIC, false},
                 {QDOT_CHART_ELLIPTIC, false},   {QDOT_CHART_ELLIPTIC, true},
                 {QDOT_CHART_SPHERE, false},     {QDOT_CHART_SPHERE, true}};
    joined pairs;
    uint64_t rest;
    qdot_status status = QDOT_OK, pending;

    if (s->coordinates.n > MOST_COORDINATES)
        return QDOT_OK;
    rest = qdot_pool_budget(s->pool, most_work);
    pairs = find_coupled_coordinates(s, open);
    for (size_t k = 0; k < sizeof order / sizeof *order && status == QDOT_OK; k++)
        if (!open || order[k].kind == QDOT_CHART_PLANE || order[k].kind == QDOT_CHART_SPACE)
            status = try_groups_of_kind(s, open, order[k].kind, order[k].turned, &pairs, groups);
    for (size_t i = 0; i < s->particles.n + s->bodies.n && status == QDOT_OK && !open; i++)
        status = try_root_groups(s, qdot_scene_massive(s, i).position, groups);
    pending = qdot_pool_check(s->pool);
    status = status == QDOT_OK ? pending : status;
    (void)qdot_pool_budget(s->pool, rest);
    return status == QDOT_ELIMIT ? QDOT_OK : status;
}
