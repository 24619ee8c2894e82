/* export-massless.c -- rows of M and f for export; for massless coordinates their equations are
 * differentiated. */
#include "lang/declare/export-massless.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/quantity.h"
#include "sim/model/gates.h"
#include "sim/model/massless-jump.h"

static qdot_expr
derivative_of_coordinate(const qdot_scene *s, size_t i, uint32_t order)
{
    return qdot_symbol_jet(s->pool, s->coordinates.at[i], order);
}

static bool
is_massless(const qdot_scene *s, const qdot_expr *M, size_t i)
{
    for (size_t j = 0; j < s->coordinates.n; j++)
        if (M[i * s->coordinates.n + j] != QDOT_ZERO)
            return false;
    for (size_t k = 0; k < s->constraints.n; k++)
        for (uint32_t order = 0; order < 3; order++)
            if (qdot_expr_contains(s->pool, s->constraints.at[k].f, derivative_of_coordinate(s, i, order)))
                return false;
    return true;
}

/* Whether f contains no velocity of a coordinate without mass. */
static bool
has_no_massless_velocity(const qdot_scene *s, const bool *massless, qdot_expr f)
{
    for (size_t j = 0; j < s->coordinates.n; j++)
        if (massless[j] && qdot_expr_contains(s->pool, f, derivative_of_coordinate(s, j, 1)))
            return false;
    return true;
}

/* Whether the velocity, or position, that f_i = 0 determines may jump: f_i jumps, or has a kink and determines a
 * position. */
static qdot_status
check_jumps(const qdot_scene *s, const bool *massless, size_t i, qdot_expr f)
{
    const bool of_positions = has_no_massless_velocity(s, massless, f);
    bool jumps = false;
    qdot_walk walk;

    QDOT_TRY(qdot_walk_begin(s->pool, f, &walk));
    for (size_t k = 0; k < walk.n; k++)
        jumps = jumps
                || (qdot_gates_is_switch(s->pool, walk.at[k])
                    && (of_positions
                        || !(qdot_expr_is_function(s->pool, walk.at[k], QDOT_ABS)
                             || qdot_expr_is_function(s->pool, walk.at[k], QDOT_MIN)
                             || qdot_expr_is_function(s->pool, walk.at[k], QDOT_MAX))));
    qdot_walk_end(&walk);
    if (!jumps)
        return QDOT_OK;
    (void)qdot_fail(QDOT_ENOTBUILT,
                    "not built yet: exports where the equation of %.100s, with which no mass moves, switches: what it "
                    "determines jumps there",
                    qdot_expr_symbol(s->pool, s->coordinates.at[i])->name);
    return qdot_hint("a small mass, or `save` of a run");
}

/* The time derivative of an equation f = 0 that has accelerations: the second if f has no velocity of a massless q. */
static qdot_expr
accelerated_rate(const qdot_scene *s, const bool *massless, qdot_expr f)
{
    const qdot_expr rate = qdot_ddt(s->pool, f);

    return has_no_massless_velocity(s, massless, f) ? qdot_ddt(s->pool, rate) : rate;
}

/* Split the equation `rate` = 0, linear in q'', into a row of M and f: rate = M q'' - f. zeros [n]: all 0. */
static void
split_equation(const qdot_scene *s, const qdot_expr *accelerations, const qdot_expr *zeros, qdot_expr rate, qdot_expr *M,
               qdot_expr *f)
{
    const size_t n = s->coordinates.n;

    for (size_t j = 0; j < n; j++)
        M[j] = qdot_diff(s->pool, rate, accelerations[j]);
    *f = qdot_neg(s->pool, qdot_subs(s->pool, rate, n, accelerations, zeros));
}

qdot_status
qdot_export_massless(qdot_scene *scene, qdot_expr *M, qdot_expr *f, bool *any)
{
    const size_t n = scene->coordinates.n;
    const qdot_expr mass = qdot_mech_numeric_mass(scene), forcing = qdot_mech_numeric_forcing(scene);
    bool *massless = qdot_calloc(n + 1, sizeof *massless);
    qdot_expr *accelerations = qdot_calloc(2 * n + 1, sizeof *accelerations);
    qdot_status status = massless != NULL && accelerations != NULL ? qdot_pool_check(scene->pool) : QDOT_ENOMEM;

    *any = false;
    for (size_t i = 0; i < n * n && status == QDOT_OK; i++)
        M[i] = qdot_expr_arg(scene->pool, mass, (uint32_t)i);
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        f[i] = qdot_expr_arg(scene->pool, forcing, (uint32_t)i);
        massless[i] = is_massless(scene, M, i);
        *any = *any || (massless[i] && qdot_scene_state_of(scene, scene->coordinates.at[i]) == NULL);
        accelerations[i] = derivative_of_coordinate(scene, i, 2);
        accelerations[n + i] = QDOT_ZERO;
    }
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        if (massless[i]) {
            if (qdot_scene_state_of(scene, scene->coordinates.at[i]) == NULL)
                status = check_jumps(scene, massless, i, f[i]);
            if (status != QDOT_OK)
                break;
            split_equation(scene, accelerations, accelerations + n, accelerated_rate(scene, massless, f[i]), M + i * n, f + i);
            status = qdot_pool_check(scene->pool);
        }
    qdot_free(massless);
    qdot_free(accelerations);
    return status;
}

/* --- events of a scene with massless coordinates ------------------------------------------ */

/* Set the targets and new values of the event `own`: the parameters that the event sets, and the q, q' that change. */
static qdot_status
set_changed_targets(const qdot_scene *s, const qdot_event *event, const qdot_expr *after, qdot_event *own)
{
    const size_t n = s->coordinates.n;

    for (size_t k = 0; k < event->targets.n; k++)
        if (qdot_expr_is_class(s->pool, event->targets.at[k], QDOT_PARAM)) {
            QDOT_TRY(qdot_vec_push(&own->targets, event->targets.at[k]));
            QDOT_TRY(qdot_vec_push(&own->values, event->values.at[k]));
        }
    for (size_t i = 0; i < 2 * n; i++)
        if (after[i] != derivative_of_coordinate(s, i % n, i >= n)) {
            QDOT_TRY(qdot_vec_push(&own->targets, derivative_of_coordinate(s, i % n, i >= n)));
            QDOT_TRY(qdot_vec_push(&own->values, after[i]));
        }
    return QDOT_OK;
}

/* Fill rows with the equations of coordinates without mass. G, coordinate, of_positions [n] are the arrays of rows;
 * massless [n] tells which coordinates these are. */
static qdot_status
find_rows(qdot_scene *s, qdot_massless_rows *rows, qdot_expr *G, size_t *coordinate, bool *of_positions, bool *massless)
{
    const size_t n = s->coordinates.n;
    const qdot_expr mass = qdot_mech_numeric_mass(s), forcing = qdot_mech_numeric_forcing(s);

    QDOT_TRY(qdot_pool_check(s->pool));
    for (size_t i = 0; i < n; i++)
        massless[i] = is_massless(s, qdot_expr_args(s->pool, mass), i);
    for (size_t i = 0; i < n; i++)
        if (massless[i]) {
            G[rows->w] = qdot_expr_arg(s->pool, forcing, (uint32_t)i);
            of_positions[rows->w] = has_no_massless_velocity(s, massless, G[rows->w]);
            coordinate[rows->w++] = i;
        }
    return QDOT_OK;
}

qdot_status
qdot_export_event_with_massless(qdot_scene *scene, const qdot_event *event, qdot_event *own)
{
    const size_t n = scene->coordinates.n;
    qdot_expr *room = qdot_calloc(3 * n + 1, sizeof *room);
    size_t *coordinate = qdot_calloc(n + 1, sizeof *coordinate);
    bool *flags = qdot_calloc(2 * n + 1, sizeof *flags);
    qdot_massless_rows rows = {.G = room, .coordinate = coordinate, .of_positions = flags};
    qdot_status status = room != NULL && coordinate != NULL && flags != NULL
                             ? find_rows(scene, &rows, room, coordinate, flags, flags + n)
                             : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_massless_jump(scene, event, &rows, room + n);
    if (status == QDOT_OK)
        status = set_changed_targets(scene, event, room + n, own);
    qdot_free(room);
    qdot_free(coordinate);
    qdot_free(flags);
    return status;
}
