/* variation-scene.c -- writes the scene of variational equations: coordinates, constraints, events, start. */
#include "sim/study/variation-scene.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/dynamics/integrated.h"
#include "sim/model/massless-jump.h"

/* A start value counts as moved by the projection if it changed by more than this. */
static const double moved = 1e-9;

/* Only sizes below this become scales; larger ones use the scale 1. */
static const double well_below = 1e-2;

/* The state that coordinate i of the given scene is. Where the new scene keeps equations of massless coordinates as
 * constraints, this one and its slopes are states of it instead. NULL: it is none, or no such equations are kept. */
static const qdot_state *
state_of(const qdot_variation *v, size_t i)
{
    return v->w > 0 ? qdot_scene_state_of(v->of, qdot_variation_jet(v, i, 0)) : NULL;
}

/* Give the states of the new scene and their slopes their rates. */
static qdot_status
add_rates(const qdot_variation *v)
{
    for (size_t i = 0; i < v->n; i++) {
        const qdot_state *state = state_of(v, i);

        if (!state)
            continue;
        QDOT_TRY(qdot_scene_state(v->scene, state->z, qdot_variation_with_numbers(v, state->rate)));
        for (size_t k = 0; k < v->k; k++)
            QDOT_TRY(qdot_scene_state(v->scene, v->y[k * v->n + i], qdot_variation_of(v, state->rate, k)));
    }
    return QDOT_OK;
}

/* Add a coordinate q; *T gains 1/2 q'^2, so that its equation of motion is q'' = acceleration. */
static qdot_status
add_coordinate(qdot_scene *to, qdot_expr q, qdot_expr *T)
{
    qdot_pool *pool = to->pool;
    const qdot_expr v = qdot_symbol_jet(pool, q, 1);

    *T = qdot_add(pool, *T, qdot_mul(pool, QDOT_HALF, qdot_mul(pool, v, v)));
    return qdot_scene_coordinate(to, q);
}

static qdot_status
add_acceleration(qdot_scene *to, qdot_expr q, qdot_expr acceleration)
{
    const qdot_torque torque = {.torque = acceleration, .coordinate = q, .force = true};

    return acceleration == QDOT_ZERO ? QDOT_OK : qdot_scene_torque(to, &torque);
}

static qdot_status
add_constraints(const qdot_variation *v)
{
    qdot_scene *s = v->of;

    for (size_t c = 0; c < v->m + v->w; c++) {
        qdot_expr mu, f;

        if (c >= v->m && state_of(v, v->massless[c - v->m]))
            continue;
        f = c < v->m ? qdot_integrated_rate(s, c, &mu) : v->G[c - v->m];
        QDOT_TRY(qdot_scene_constraint(v->scene, NULL, qdot_variation_with_numbers(v, f),
                                       QDOT_ZERO));
        for (size_t k = 0; k < v->k; k++) {
            const qdot_expr slope = qdot_variation_of(v, f, k);

            QDOT_TRY(qdot_pool_check(s->pool));
            QDOT_TRY(qdot_scene_constraint(v->scene, NULL, slope, QDOT_ZERO));
        }
    }
    return QDOT_OK;
}

/* The event with the saltation of y. Room: z [2n] for (q, q') before it, put [2n] for what becomes of them, after [3n] for
 * (q, q', q'') after it with numbers; expressions of the state before. */
static qdot_status
find_jump_of_derivatives(const qdot_variation *v, const qdot_event *event, qdot_expr *z, qdot_expr *put,
                         qdot_expr *after, qdot_event *own)
{
    const qdot_massless_rows rows = {v->n_massless, v->G, v->massless, v->of_positions};
    qdot_pool *pool = v->of->pool;
    const qdot_expr g = qdot_sub(pool, event->left, event->right);
    const size_t n = v->n;

    QDOT_TRY(qdot_massless_jump(v->of, event, &rows, put));
    for (size_t i = 0; i < 2 * n; i++) {
        z[i] = qdot_variation_jet(v, i % n, i >= n);
        after[i] = qdot_variation_with_motion(v, qdot_variation_with_numbers(v, put[i]));
        QDOT_TRY(qdot_vec_push(&own->targets, z[i]));
        QDOT_TRY(qdot_vec_push(&own->values, after[i]));
    }
    QDOT_TRY(qdot_pool_check(pool));
    for (size_t i = 0; i < n; i++)
        after[2 * n + i] = qdot_subs(pool, v->a[i], 2 * n, z, after);
    for (size_t k = 0; k < v->k; k++) {
        const qdot_expr slope = qdot_variation_with_motion(v, qdot_variation_of(v, g, k));
        const qdot_expr time = qdot_hold(
            pool, qdot_neg(pool, qdot_div(pool, slope, qdot_variation_rate(v, g))));

        for (size_t i = 0; i < 2 * n; i++) {
            const qdot_expr h = put[i];
            const qdot_expr along =
                qdot_sub(pool, qdot_variation_rate(v, h), after[n + i]);

            QDOT_TRY(qdot_vec_push(&own->targets,
                                   qdot_variation_slope_jet(v, k, i % n, i >= n)));
            QDOT_TRY(
                qdot_vec_push(&own->values, qdot_add(pool, qdot_variation_of(v, h, k),
                                                     qdot_mul(pool, along, time))));
        }
    }
    return qdot_pool_check(pool);
}

/* Add the events that change the state, with the jumps of the derivatives at them (saltation). */
static qdot_status
add_events(const qdot_variation *v)
{
    qdot_expr *room = qdot_malloc((7 * v->n + 1) * sizeof *room);
    qdot_status status = room ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < v->of->events.n && status == QDOT_OK; i++) {
        const qdot_event *event = &v->of->events.at[i];
        qdot_event own = {.name = event->name, .way = event->way, .stop = event->stop};

        if (event->targets.n == 0)
            continue;
        own.left = qdot_variation_with_numbers(v, event->left);
        own.right = qdot_variation_with_numbers(v, event->right);
        status = find_jump_of_derivatives(v, event, room, room + 2 * v->n, room + 4 * v->n, &own);
        if (status == QDOT_OK)
            status = qdot_scene_event(v->scene, &own);
        qdot_free(own.targets.at);
        qdot_free(own.values.at);
    }
    qdot_free(room);
    return status;
}

/* --- the start of the derivatives --------------------------------------------------------- */

/* Whether the equation of a massless coordinate determines coordinate i, or its velocity. */
static bool
is_determined_by_massless(const qdot_variation *v, bool velocity, size_t i)
{
    for (size_t c = 0; c < v->w; c++)
        if (v->massless[c] == i && (velocity || v->of_positions[c]))
            return true;
    return false;
}

/* How many constraints hold coordinates (velocities: them too), and how many of these the start leaves
 * open. Where none holds coordinates none is open: what is not named is 0. */
static void
count_undetermined(const qdot_variation *v, bool velocities, size_t *held, size_t *open)
{
    const bool *named = velocities ? v->request->v_named : v->request->q_named;

    *held = *open = 0;
    for (size_t c = 0; c < v->m; c++)
        *held += v->of->constraints.at[c].kind == QDOT_HOLONOMIC ||
                 (velocities && v->of->constraints.at[c].kind == QDOT_VELOCITY);
    for (size_t i = 0; i < v->n && *held > 0; i++)
        *open += named && !named[i] && !is_determined_by_massless(v, velocities, i);
}

static bool
starts_at_rest(const qdot_variation *v)
{
    for (size_t i = 0; i < v->n; i++)
        if (!is_determined_by_massless(v, true, i) &&
            (v->request->v0[i] != QDOT_ZERO || !v->request->v_named || v->request->v_named[i]))
            return false;
    return true;
}

/* A start that leaves more values open than the constraints solve for takes those nearest to 0: their
 * slopes are known only where all velocities are 0. */
static qdot_status
check_undetermined(const qdot_variation *v)
{
    size_t held, open;

    for (int velocities = 0; velocities < 2 && v->m > 0; velocities++) {
        count_undetermined(v, velocities, &held, &open);
        if (open <= held || (velocities && starts_at_rest(v)))
            continue;
        (void)qdot_fail(
            QDOT_ENOTBUILT,
            "not built yet: slopes of a start that leaves %zu %s to %zu constraints",
            open, velocities ? "velocities" : "coordinates", held);
        return qdot_hint("`start` may name all but %zu of them", held);
    }
    return QDOT_OK;
}

static qdot_status
fail_constrained_direction(const qdot_variation *v, size_t k)
{
    (void)qdot_fail(QDOT_EINVAL,
                    "the constraints do not let the start change with %.100s alone: it "
                    "names all else",
                    v->by[k].name);
    return qdot_hint("leave a value unnamed in `start`, so that it follows");
}

/* Check a linear condition on the derivatives: fail if no choice of the free ones satisfies it at the start. */
static qdot_status
check_condition(const qdot_variation *v, qdot_expr e, size_t k)
{
    qdot_pool *pool = v->of->pool;
    const size_t all = (v->k + 1) * v->n;
    const qdot_expr t = QDOT_T;
    double value;

    for (size_t j = 0; j < 2 * all && e != QDOT_NIL; j++) {
        const qdot_expr z =
            qdot_symbol_jet(pool, v->scene->coordinates.at[j % all], j >= all);

        if (v->named[j])
            e = qdot_subs(pool, e, 1, &z, &v->start[j]);
    }
    e = e == QDOT_NIL ? e : qdot_subs(pool, e, 1, &t, &v->request->t0);
    QDOT_TRY(qdot_pool_check(pool));
    if (qdot_expr_node(pool, e)->holds & (QDOT_HAS_COORD | QDOT_HAS_VELOCITY))
        return QDOT_OK;
    QDOT_TRY(qdot_constant_double(pool, e, &value));
    return fabs(value) <= moved ? QDOT_OK : fail_constrained_direction(v, k);
}

/* Check that the constraints' derivative Df = 0 at the start; if holonomic also its time derivative. */
static qdot_status
check_conditions(const qdot_variation *v)
{
    for (size_t c = 0; c < v->m; c++)
        for (size_t k = 0; k < v->k; k++) {
            const qdot_constraint *of = &v->of->constraints.at[c];
            qdot_expr e, mu;

            if (of->kind == QDOT_ACCELERATION || !v->by[k].start)
                continue;
            e = qdot_variation_of(v, qdot_integrated_rate(v->of, c, &mu), k);
            QDOT_TRY(check_condition(v, e, k));
            if (of->kind == QDOT_HOLONOMIC)
                QDOT_TRY(check_condition(v, qdot_ddt(v->of->pool, e), k));
        }
    return QDOT_OK;
}

/* A pseudo-random number of size 1e-6 for initial directions: so small that constraints move the
 * start by its square only. */
static qdot_expr
irregular_start_value(qdot_pool *pool, size_t k, size_t i)
{
    uint64_t x = (k * 1000 + i + 1) * 6364136223846793005u;

    x = (x ^ x >> 31) * 1442695040888963407u;
    return qdot_div(pool, qdot_expr_int(pool, (int64_t)(x >> 40) - (1 << 23)),
                    qdot_expr_int(pool, (INT64_C(1) << 23) * 1000000));
}

/* Component i < 2n of the derivative in direction k at the start. */
static qdot_expr
start_of_derivative(const qdot_variation *v, size_t k, size_t i)
{
    return v->by[k].start ? v->by[k].start[i] : irregular_start_value(v->of->pool, k, i);
}

/* Write the start of q, y, q', y'; values that the original start solves for are solved for in all
 * directions. */
static void
write_start_values(const qdot_variation *v)
{
    const qdot_run_request *r = v->request;
    const size_t n = v->n, all = (v->k + 1) * n;
    size_t held, open;

    count_undetermined(v, false, &held, &open);
    for (size_t k = 0; k <= v->k; k++)
        for (size_t i = 0; i < n; i++) {
            v->start[k * n + i] = k == 0 ? r->q0[i] : start_of_derivative(v, k - 1, i);
            v->start[all + k * n + i] = k == 0 ? r->v0[i] : start_of_derivative(v, k - 1, n + i);
            v->named[k * n + i] = k == 0 || open == 0 || r->q_named[i];
            v->named[all + k * n + i] = k == 0 || !r->v_named || r->v_named[i];
        }
    /* do not prescribe values that follow from the equations of massless coordinates */
    for (size_t j = 0; j < 2 * all && v->w > 0; j++) {
        const size_t i = j % all % n;

        v->named[j] = (v->m == 0 || v->named[j]) && !is_determined_by_massless(v, j >= all, i);
    }
}

/* Find scales for the request: dz_i/ds gets (scale of z_i)/(scale of s), if that is well below 1. */
static qdot_status
find_scales_of_derivatives(qdot_variation *v)
{
    const double *said = v->request->scales;
    const size_t n = v->n, all = (v->k + 1) * n;
    bool any = said != NULL;

    for (size_t k = 0; k < v->k; k++)
        any = any || v->by[k].scale > 0;
    if (!any)
        return QDOT_OK;
    v->scales = qdot_calloc(2 * all + 1, sizeof *v->scales);
    if (v->scales == NULL)
        return QDOT_ENOMEM;
    for (size_t k = 0; k <= v->k; k++)
        for (size_t i = 0; i < 2 * n; i++) {
            const double of = said != NULL ? said[i] : 0, by = k > 0 ? v->by[k - 1].scale : 0;

            const double slope = (of > 0 ? of : 1) / (by > 0 ? by : 1);

            v->scales[(i < n ? 0 : all) + k * n + i % n] = k == 0 ? of : slope < well_below ? slope : 0;
        }
    return QDOT_OK;
}

qdot_run_request
qdot_variation_request(const qdot_variation *v)
{
    qdot_run_request r = *v->request;

    r.q0 = v->start;
    r.v0 = v->start + (v->k + 1) * v->n;
    r.q_named = v->named;
    r.v_named = v->named + (v->k + 1) * v->n;
    r.exactly = false;
    r.no_drifts = true;
    r.scales = v->scales;
    r.apart = NULL; /* no errors of the start: the derivatives belong to exactly this start */
    r.n_values = 0;
    r.symbols = r.values = NULL;
    /* use `auto`, as the given method may not fit the variational scene */
    r.method = strcmp(r.method, "radau") == 0 ? r.method : "auto";
    return r;
}

qdot_status
qdot_variation_check_state(const qdot_variation *v, const double *y)
{
    const size_t all = (v->k + 1) * v->n;

    for (size_t j = v->n; j < 2 * all && v->m + v->w > 0; j++) {
        const size_t i = j % all;
        double wanted;

        if (!v->named[j] || i < v->n)
            continue;
        QDOT_TRY(qdot_constant_double(v->of->pool, v->start[j], &wanted));
        if (!(fabs(y[j] - wanted) <= moved * fmax(1, fabs(wanted))))
            return fail_constrained_direction(v, i / v->n - 1);
    }
    return QDOT_OK;
}

qdot_status
qdot_variation_check_start(const qdot_variation *v, qdot_run *run)
{
    const double t0 = qdot_run_get_report(run)->t0;
    const size_t all = (v->k + 1) * v->n;
    qdot_expr *z = qdot_calloc(2 * all + 1, sizeof *z);
    double *y = qdot_calloc(2 * all + 1, sizeof *y);
    qdot_status status = z && y ? QDOT_OK : QDOT_ENOMEM;

    for (size_t j = 0; j < 2 * all && z; j++)
        z[j] = qdot_symbol_jet(v->of->pool, v->scene->coordinates.at[j % all], j >= all);
    if (status == QDOT_OK && v->m + v->w > 0)
        status = qdot_run_values(run, 2 * all, z, 1, &t0, y, NULL);
    if (status == QDOT_OK)
        status = qdot_variation_check_state(v, y);
    qdot_free(z);
    qdot_free(y);
    return status;
}

/* --- the whole variational scene ------------------------------------------------------------ */

qdot_status
qdot_variation_write(qdot_variation *v, const qdot_expr *b)
{
    qdot_expr T = QDOT_ZERO;

    QDOT_TRY(check_undetermined(v));
    write_start_values(v);
    QDOT_TRY(find_scales_of_derivatives(v));
    v->scene = qdot_scene_new(v->of->pool);
    if (!v->scene)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < (v->k + 1) * v->n; i++) {
        const qdot_expr q = i < v->n ? qdot_variation_jet(v, i, 0) : v->y[i - v->n];

        QDOT_TRY(state_of(v, i % v->n) ? qdot_scene_state(v->scene, q, QDOT_NIL) : add_coordinate(v->scene, q, &T));
    }
    QDOT_TRY(qdot_pool_check(v->of->pool));
    if (T != QDOT_ZERO)
        QDOT_TRY(qdot_scene_lagrangian(v->scene, T));
    for (size_t i = 0; i < (v->k + 1) * v->n; i++)
        if (!state_of(v, i % v->n))
            QDOT_TRY(i < v->n ? add_acceleration(v->scene, qdot_variation_jet(v, i, 0), v->a[i])
                              : add_acceleration(v->scene, v->y[i - v->n], b[i - v->n]));
    QDOT_TRY(add_rates(v));
    QDOT_TRY(check_conditions(v));
    QDOT_TRY(add_constraints(v));
    return add_events(v);
}
