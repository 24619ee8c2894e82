/* piece-layer.c -- checks that a layer about a branch point (sim/model/layer.h) may be passed, and finds what
 * comes to rest in one. */
#include "expr/node.h"
#include "expr/symbol.h"
#include "sim/course/piece.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "ode/scale.h"
#include "sim/model/layer.h"

/* Motion left out within a friction layer may be as large as the tolerance, or this if the
 * tolerance is smaller. */
static const double least_left_out = 16 * DBL_EPSILON;

static const qdot_surface *
surface_of(const qdot_piece *x, size_t i)
{
    return &x->c->stage->switches.surfaces.at[i];
}

/* Whether the piece before the one in the layer held the motion on surface i, at u = 0. */
static bool
was_held_on_surface(const qdot_piece *x, size_t i)
{
    const qdot_trajectory *tr = &x->c->tr;
    const size_t n = tr->pieces.n;

    return n > 1
           && x->c->stage->modes.at[tr->pieces.at[n - 2].mode]->side[i] == QDOT_SIDE_SLIDES;
}

static bool
depends_on_time_only(const qdot_piece *x, size_t i)
{
    return qdot_layers_in_time(x->c->stage->switches.pool, surface_of(x, i));
}

/* The time spent in the layer divided by 1 + power, the factor of C w^p at the layer's boundary |u| = w. */
static double
weighted_time_in_layer(const qdot_piece *x, size_t i)
{
    const qdot_trajectory *tr = &x->c->tr;

    return (x->start.t - tr->t[tr->pieces.at[tr->pieces.n - 1].first]) / (1 + surface_of(x, i)->power);
}

static bool
contains_velocities(const qdot_piece *x, size_t i)
{
    return (qdot_expr_node(x->c->stage->switches.pool, surface_of(x, i)->u)->holds
            & (QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER))
           != 0;
}

/* Closer to the middle of a layer than this fraction of its half width, its power law is negligible. */
static const double beside_middle = 0x1p-10;

/* What else than the power switches at u = 0, as a dashpot that acts in contact alone: the rates of a mode beyond the layer
 * less those of the mode inside, jump [n], at the time `back` before the start, by its velocities. 0 where the power has no
 * value there. */
static qdot_status
find_force_jump(qdot_piece *x, size_t beyond, size_t inside, double back, double *jump)
{
    const size_t n = x->n / 2;
    const qdot_ode_system *in = x->c->systems.at + inside, *out = x->c->systems.at + beyond;
    double *y = qdot_malloc(2 * x->n * sizeof *y), *rates = y + x->n;
    qdot_status status = y ? QDOT_OK : QDOT_ENOMEM;

    memset(jump, 0, x->n * sizeof *jump);
    if (status == QDOT_OK) {
        memcpy(y, x->start.y, x->n * sizeof *y);
        for (size_t i = 0; i < n; i++)
            y[i] -= back * y[n + i];
        status = in->rhs(x->start.t - back, y, rates, in->user);
    }
    if (status == QDOT_OK)
        status = out->rhs(x->start.t - back, y, jump, out->user);
    for (size_t k = 0; k < x->n && y; k++)
        jump[k] = status == QDOT_OK && k >= n ? jump[k] - rates[k] : 0;
    qdot_free(y);
    return qdot_grave(status);
}

/* The time from the rim of the layer of surface i, where the motion enters it, to its middle, with its sign; 0:
 * not known. */
static qdot_status
find_time_to_middle(qdot_piece *x, size_t i, double *half)
{
    const qdot_mode *m = qdot_piece_mode(x);
    double *rates = qdot_malloc(2 * x->n * sizeof *rates), rate = 0, noise = 0;
    qdot_status status = rates ? qdot_piece_rates(x, x->mode, rates) : QDOT_ENOMEM;

    for (size_t k = 0; k < x->n && rates; k++)
        rates[x->n + k] = fabs(rates[k]);
    for (size_t k = 0; k < m->m && status == QDOT_OK && rate == 0; k++)
        if (m->watched[k].kind == QDOT_WATCH_SURFACE && m->watched[k].index == i)
            status = qdot_watch_rate(qdot_piece_watch(x), x->start.t, x->start.y, NULL, rates, rates + x->n, k, &rate,
                                     &noise);
    *half = fabs(rate) > noise ? x->direction * surface_of(x, i)->layer / fabs(rate) : 0;
    qdot_free(rates);
    return status;
}

/* What switches beside the power of a place does so at its middle, and is made good: where the layer is entered, up to the
 * middle; where it is left on its other side, from there on. jumps [2 x n], of the side before and of that behind, where it is
 * left. */
static qdot_status
correct_for_force_jumps(qdot_piece *x, size_t i, bool leaves, double *jumps)
{
    const qdot_trajectory *tr = &x->c->tr;
    const size_t pieces = tr->pieces.n, n = x->n;
    size_t before;
    double half;

    if (depends_on_time_only(x, i) || contains_velocities(x, i))
        return QDOT_OK;
    if (!leaves) {
        QDOT_TRY(find_time_to_middle(x, i, &half));
        QDOT_TRY(find_force_jump(x, x->start.from, x->mode, -half * (1 - beside_middle), jumps));
        for (size_t k = 0; k < n; k++)
            x->start.y[k] += half * jumps[k];
        return QDOT_OK;
    }
    before = pieces < 2 ? x->mode : tr->pieces.at[pieces - 2].mode;
    if (!x->entered || x->c->stage->modes.at[before]->side[i] != -qdot_piece_mode(x)->side[i])
        return QDOT_OK;
    half = (x->start.t - tr->t[tr->pieces.at[pieces - 1].first]) / 2;
    QDOT_TRY(find_force_jump(x, before, x->start.from, half * (1 + beside_middle), jumps));
    QDOT_TRY(find_force_jump(x, x->mode, x->start.from, half * (1 - beside_middle), jumps + n));
    for (size_t k = 0; k < n; k++)
        x->start.y[k] += half * jumps[n + k];
    return QDOT_OK;
}

/* Entering a layer: the force that it leaves out, into x->rim [n]. Leaving it: what its power has left
 * out of velocities since, relative to its size. */
static qdot_status
pass_layer_boundary(qdot_piece *x, size_t i, bool leaves)
{
    qdot_course *c = x->c;
    const double time = weighted_time_in_layer(x, i);
    double *inside = qdot_calloc(4 * x->n, sizeof *inside), *beyond = inside + x->n, *jumps = beyond + x->n,
           most = 0;
    qdot_status status = inside ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_piece_rates(x, leaves ? x->start.from : x->mode, inside);
    if (status == QDOT_OK)
        status = qdot_piece_rates(x, leaves ? x->mode : x->start.from, beyond);
    if (status == QDOT_OK)
        status = correct_for_force_jumps(x, i, leaves, jumps);
    for (size_t k = 0; k < x->n && status == QDOT_OK; k++) {
        const double out = beyond[k] - inside[k],
                     mean = x->entered ? (x->rim[k] - jumps[k] + out - jumps[x->n + k]) / 2 : out;

        most = fmax(most, fabs(mean) / qdot_ode_size(c->stage->scales, k, x->start.y[k]));
        x->rim[k] = out;
        if (leaves && depends_on_time_only(x, i)) /* add the displacement within the layer */
            x->start.y[k] += mean * time;
    }
    qdot_free(inside);
    x->entered = !leaves;
    if (leaves && !depends_on_time_only(x, i) && !was_held_on_surface(x, i)) /* friction corrects this error itself */
        c->left_out += most * fabs(time);
    if (status == QDOT_OK && c->left_out > fmax(x->options->tol, least_left_out))
        qdot_piece_stop_at(x, i, 0, "a power of what passes 0 so slowly cannot be followed at", "");
    return status;
}

bool
qdot_piece_end_in_layers(qdot_piece *x)
{
    const qdot_mode *mode = qdot_piece_mode(x);
    bool any = false;

    for (size_t i = 0; i < x->c->stage->switches.surfaces.n && x->entered; i++) {
        if (surface_of(x, i)->layer == 0 || mode->side[i] != 0 || !depends_on_time_only(x, i))
            continue;
        for (size_t k = 0; k < x->n; k++)
            x->start.y[k] += x->rim[k] * weighted_time_in_layer(x, i);
        x->entered = false;
        any = true;
    }
    return any;
}

/* In the layer of surface i: whether the motion, by its velocities and accelerations now, is there
 * still when the run ends. */
static qdot_status
comes_to_rest(qdot_piece *x, size_t i, bool *yes)
{
    const size_t n = x->n / 2;
    const double h = x->t1 - x->start.t;
    double *y = qdot_malloc(2 * x->n * sizeof *y), *rates = y + x->n;
    int64_t *side = qdot_calloc(x->c->stage->switches.surfaces.n, sizeof *side);
    qdot_status status = y && side ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_piece_rates(x, x->mode, rates);
    for (size_t k = 0; k < n && status == QDOT_OK; k++) {
        y[k] = x->start.y[k] + h * (rates[k] + h / 2 * rates[n + k]);
        y[n + k] = x->start.y[n + k] + h * rates[n + k];
    }
    if (status == QDOT_OK)
        status = qdot_stage_sides(x->c->stage, x->t1, y, NULL, side);
    *yes = status == QDOT_OK && side[i] == 0;
    qdot_free(side);
    qdot_free(y);
    return status;
}

/* --- coming to rest -------------------------------------------------------------------------------- */

/* The friction force is compared at the layer's boundary |u| = w and at |u| equal to this fraction of w. */
static const double deeper = 0x1p-10;

/* The motion held at u = 0 of a surface at the start of a piece: y and its rates [n], the slopes of u by
 * q' [n/2] (`order` 1) or, if u holds none, by q (0), and u at the start. */
typedef struct {
    int order;
    double *y, *rates, *slopes, u;
} held_motion;

/* How fast |u|, of order 0 |du/dt|, falls at u = way `at` with the equations of that side, more than in the
 * motion held: *a. */
static qdot_status
find_deceleration(qdot_piece *x, size_t i, const held_motion *held, int way, double at, double *a)
{
    const size_t n = x->n / 2;
    const qdot_ode_system *system;
    double *y = qdot_malloc(2 * x->n * sizeof *y), *rates = y + x->n, square = 0;
    qdot_status status = y ? QDOT_OK : QDOT_ENOMEM;

    *a = 0;
    x->side[i] = way;
    if (status == QDOT_OK)
        status = qdot_piece_enter(x);
    if (status == QDOT_OK) {
        memcpy(y, held->y, x->n * sizeof *y);
        for (size_t k = 0; k < n; k++)
            square += held->slopes[k] * held->slopes[k];
        for (size_t k = 0; k < n; k++)
            y[(size_t)held->order * n + k] += way * at / square * held->slopes[k];
        system = x->c->systems.at + x->mode;
        status = system->rhs(x->start.t, y, rates, system->user);
    }
    for (size_t k = 0; k < n && status == QDOT_OK; k++)
        *a -= way * (held->order == 1 ? x->direction : 1) * held->slopes[k] * (rates[n + k] - held->rates[n + k]);
    qdot_free(y);
    return status;
}

/* The time until the motion comes to rest, its uncertainty, and the mean of u until then as a fraction of u now. */
typedef struct {
    double time, doubt, mean;
} remainder_of_motion;

/* u falls as c u^p from u0, p < 1: u0/(a(w) (1 - p)) (u0/w)^-p, and the mean of u until then is u0 (1 - p)/(2 -
 * p). */
static double
time_to_rest_by_power_law(double u0, double w, double rim, double p)
{
    return w / (rim * (1 - p)) * pow(u0 / w, 1 - p);
}

/* The uncertainty of du/dt caused by rounding of the velocities. */
static double
velocity_rounding(const qdot_piece *x, const double *slopes)
{
    const size_t n = x->n / 2;
    double sum = 0;

    for (size_t k = 0; k < n; k++)
        sum += 2 * DBL_EPSILON * fabs(slopes[k])
               * qdot_ode_size(x->c->stage->scales, n + k, x->start.y[n + k]);
    return sum;
}

/* How friction brings u at the start to rest, a = c u^p on either side: an infinite time if that never ends,
 * or if there is a side on which it does not. */
static qdot_status
find_remaining_motion(qdot_piece *x, size_t i, const held_motion *held, remainder_of_motion *left)
{
    const double w = surface_of(x, i)->layer, u0 = fmin(fabs(held->u), w);

    *left = (remainder_of_motion){0};
    for (int way = -1; way <= 1; way += 2) {
        double rim, half, inside, p, q;

        QDOT_TRY(find_deceleration(x, i, held, way, w, &rim));
        QDOT_TRY(find_deceleration(x, i, held, way, sqrt(deeper) * w, &half));
        QDOT_TRY(find_deceleration(x, i, held, way, deeper * w, &inside));
        p = inside > 0 ? log(inside / rim) / log(deeper) : 0;
        q = half > 0 ? log(half / rim) / (log(deeper) / 2) : 0;
        if (!(rim > 0 && p < 1))
            left->time = INFINITY;
        if (!(way * held->u > 0) || isinf(left->time))
            continue;
        left->time = time_to_rest_by_power_law(u0, w, rim, p);
        left->doubt = fabs(time_to_rest_by_power_law(u0, w, rim, q) - left->time)
                      + velocity_rounding(x, held->slopes) / (rim * pow(u0 / w, p));
        left->mean = (1 - p) / (2 - p);
    }
    return QDOT_OK;
}

/* Allowed error of the distance until rest, which neglects the change of the forces meanwhile. */
static const double way_left_out = 1e-12;

/* Whether the distance that the motion held on the surface would still cover is small enough to be ignored. */
static bool
is_distance_negligible(const qdot_piece *x, const held_motion *held, const remainder_of_motion *left)
{
    const size_t n = x->n / 2;
    const double duration = fabs(x->t1 - x->c->tr.t[0]);
    bool may = isfinite(left->time);

    for (size_t k = 0; k < n && may; k++)
        may = fabs(x->start.y[n + k] - held->y[n + k])
                  * fmax(left->doubt, left->time * (left->time / duration))
              <= way_left_out * qdot_ode_size(x->c->stage->scales, k, x->start.y[k]);
    return may;
}

/* Advance the motion held on the surface to the time of its rest, with its mean velocity until then. */
static qdot_status
go_to_rest(qdot_piece *x, size_t i, const held_motion *held, const remainder_of_motion *left)
{
    qdot_course *c = x->c;
    const size_t n = x->n / 2;
    const double end = x->start.t + x->direction * left->time,
                 after = x->direction * (end - x->t1) > 0 ? x->t1 : end;

    for (size_t k = 0; k < n; k++)
        held->y[k] += left->mean * (after - x->start.t) * (x->start.y[n + k] - held->y[n + k]);
    memcpy(x->start.y, held->y, x->n * sizeof *held->y);
    if (after == x->start.t)
        return QDOT_OK;
    QDOT_TRY(qdot_vec_push(&c->rests, ((qdot_course_rest){i, x->start.t, after})));
    x->late = left->doubt;
    QDOT_TRY(qdot_trajectory_begin_piece(&c->tr, x->mode, true, x->options, x->start.y));
    QDOT_TRY(qdot_trajectory_record(&c->tr, &c->systems.at[x->mode], x->options, after));
    x->start.t = after;
    x->start.from = x->mode;
    memcpy(x->start.y, c->tr.y + (c->tr.count - 1) * x->n, x->n * sizeof *x->start.y);
    return QDOT_OK;
}

/* Hold the motion on surface i from the start of a piece, in its own mode; the caller frees held->slopes. */
static qdot_status
hold_on_surface(qdot_piece *x, size_t i, int order, held_motion *held)
{
    const qdot_sliding_rows *rows;
    const qdot_ode_system *system;
    double *y = qdot_calloc(3 * x->n, sizeof *y), moved;

    *held = (held_motion){.order = order, .y = y + x->n, .rates = y + 2 * x->n, .slopes = y};
    x->side[i] = QDOT_SIDE_SLIDES;
    if (!y)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_piece_enter(x));
    rows = &qdot_piece_mode(x)->held;
    system = x->c->systems.at + x->mode;
    memcpy(held->y, x->start.y, x->n * sizeof *y);
    QDOT_TRY(qdot_sliding_rows_keep(rows, x->n / 2, x->start.t, held->y, &moved));
    QDOT_TRY(qdot_sliding_rows_value(rows, x->n / 2, x->start.t, x->start.y, i, order, &held->u,
                                     held->slopes));
    return system->rhs(x->start.t, held->y, held->rates, system->user);
}

/* Whether the motion comes to rest on surface i, in whose layer it is, and what is left of its way is
 * next to nothing; then it goes there, and x->mode is the one that holds it. */
static qdot_status
may_hold_on_surface(qdot_piece *x, size_t i, bool *may)
{
    held_motion held;
    remainder_of_motion left = {.time = INFINITY};
    qdot_status status = hold_on_surface(x, i, 1, &held);
    const size_t mode = x->mode;

    if (status == QDOT_OK)
        status = find_remaining_motion(x, i, &held, &left);
    *may = status == QDOT_OK && is_distance_negligible(x, &held, &left);
    x->side[i] = QDOT_SIDE_SLIDES;
    x->mode = mode;
    if (*may)
        status = go_to_rest(x, i, &held, &left);
    qdot_free(held.slopes);
    return *may ? status : qdot_grave(status);
}

/* Whether forces drive the motion, at rest in the layer of surface i, back into it from both rims: then it
 * stays. */
static qdot_status
is_driven_back(qdot_piece *x, size_t i, bool *yes)
{
    const size_t mode = x->mode;
    held_motion held;
    double up = 0, down = 0;
    qdot_status status = hold_on_surface(x, i, 0, &held);

    if (status == QDOT_OK)
        status = find_deceleration(x, i, &held, 1, surface_of(x, i)->layer, &up);
    if (status == QDOT_OK)
        status = find_deceleration(x, i, &held, -1, surface_of(x, i)->layer, &down);
    *yes = status == QDOT_OK && up > 0 && down > 0;
    qdot_free(held.slopes);
    x->side[i] = 0;
    x->mode = mode;
    return qdot_grave(status);
}

/* Record events whose function becomes 0 where the motion has come to rest. */
static qdot_status
record_events_at_rest(qdot_piece *x)
{
    const size_t m = qdot_piece_mode(x)->m;
    int *signs = qdot_calloc(m + 1, sizeof *signs);
    double *g = qdot_calloc(m + 1, sizeof *g);
    qdot_status status = signs && g ? QDOT_OK : QDOT_ENOMEM;

    x->t_act = x->start.t;
    x->roots.n = 0;
    if (status == QDOT_OK && m > 0)
        status = qdot_watch_look(qdot_piece_watch(x), x->start.t, x->start.y, NULL, signs, g, NULL);
    for (size_t k = 0; k < x->c->stage->events.n && status == QDOT_OK; k++) {
        const qdot_root root = {
            .function = k, .t = x->start.t, .way = -x->signs[k], .blur = x->late};

        if (x->signs[k] != 0 && signs[k] == 0)
            status = qdot_piece_meet(x, &root);
    }
    qdot_free(signs);
    qdot_free(g);
    return status;
}

qdot_status
qdot_piece_stop_in_layers(qdot_piece *x)
{
    const qdot_mode *old = qdot_piece_mode(x);
    size_t mode = x->mode;
    qdot_status status = QDOT_OK;
    bool any = false;

    for (size_t i = 0; i < x->c->stage->switches.surfaces.n && status == QDOT_OK; i++) {
        bool may = false;

        if (surface_of(x, i)->layer == 0 || x->side[i] != 0
            || (old->side[i] == QDOT_SIDE_SLIDES && !x->start.jumped)
            || !contains_velocities(x, i))
            continue;
        status = may_hold_on_surface(x, i, &may);
        x->side[i] = may ? QDOT_SIDE_SLIDES : 0;
        mode = may ? x->mode : mode;
        x->mode = mode;
        any |= may;
    }
    return status == QDOT_OK && any ? record_events_at_rest(x) : status;
}

/* --- passing through a layer ---------------------------------------------------------------------------- */

qdot_status
qdot_piece_check_layers(qdot_piece *x)
{
    const qdot_mode *old = x->c->stage->modes.at[x->start.from],
                    *now = qdot_piece_mode(x);
    const size_t surfaces = x->c->stage->switches.surfaces.n;

    for (size_t i = 0; i < surfaces && x->c->reason[0] == '\0'; i++) {
        bool stays = false, back = false;

        if (surface_of(x, i)->layer == 0)
            continue;
        if (x->start.jumped)
            x->entered = false;
        else if ((old->side[i] == 0) != (now->side[i] == 0))
            QDOT_TRY(pass_layer_boundary(x, i, old->side[i] == 0));
        /* a power less than 1 lets the motion leave the surface at any time */
        if (now->side[i] == 0 && surface_of(x, i)->power < 1 && !depends_on_time_only(x, i))
            QDOT_TRY(comes_to_rest(x, i, &stays));
        if (stays && !contains_velocities(x, i))
            QDOT_TRY(is_driven_back(x, i, &back));
        if (stays && !back)
            qdot_piece_stop_at(x, i, 0, "nothing says when the motion, at rest, leaves", "");
    }
    return QDOT_OK;
}
