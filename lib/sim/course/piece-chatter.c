/* piece-chatter.c -- where a motion oscillates about a surface too fast to be followed
 * (sim/course/chatter.h), it slides. */
#include "expr/node.h"
#include "expr/symbol.h"
#include "sim/course/piece.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "ode/scale.h"

/* The rounding error of the surface's function u, in units of the rounding of its coordinates. */
static const double ulps = 4;
/* Where u is near 0 by the size of its coordinates there is no such rounding. A motion that would cross more often than
 * that until the end is not followed if it is as slow, and as near, in parts of the sizes of the state. */
static const double most_crossings = 2e4, slow = 1e-4, near = 1e-8;
/* Read in doubles, each crossing changes the swings by the rounding of u over their width: where that comes to more until
 * the end they are not followed, if they are as slow in parts of the state. */
static const double most_lost = 0.01, slow_in_doubles = 1e-3;
/* The factor by which the speed of an oscillation that is not followed may grow until the end of the run. */
static const double most_growth = 10;

/* The motion held on surface i, where u = 0, at the start of a piece of the run. */
typedef struct {
    qdot_piece *x;
    size_t i, n, mode[3]; /* index of the surface; number of coordinates; modes for sides -1, 0 (sliding), 1 */
    double *y;            /* [2n] the state, moved onto the surface */
    double *slopes;       /* [n] gradient du/dq */
    double *along; /* [n] direction in which the forces of both sides push, scaled to du/dq . along = 1 */
    double *rates, *moved; /* [4n], [2n] scratch */
    double u, v;           /* u and du/dt before the state was moved onto the surface u = 0 */
    double square;         /* the squared length |du/dq|^2 */
} held_motion;

/* How fast the motion on the side `way` is pulled back, at y + by rates and a speed `more`: *a; its acceleration less
 * that held, into rates [n] behind. */
static qdot_status
find_acceleration_to_surface(held_motion *h, int way, const double *flow, double by, double more, double *a)
{
    const size_t n = h->n;
    const qdot_ode_system *held = h->x->c->systems.at + h->mode[1],
                          *free = h->x->c->systems.at + h->mode[1 + way];
    const double t = h->x->start.t + by;

    memcpy(h->moved, h->y, 2 * n * sizeof *h->moved);
    for (size_t k = 0; k < 2 * n && flow; k++)
        h->moved[k] += by * flow[k];
    for (size_t k = 0; k < n; k++)
        h->moved[n + k] += more * h->slopes[k] / h->square;
    QDOT_TRY(held->rhs(t, h->moved, h->rates, held->user));
    QDOT_TRY(free->rhs(t, h->moved, h->rates + 2 * n, free->user));
    *a = 0;
    for (size_t k = 0; k < n; k++)
        *a -= way * h->slopes[k] * (h->rates[3 * n + k] - h->rates[n + k]);
    return QDOT_OK;
}

/* Make the modes below, on and above the surface, and move the start state onto the surface. */
static qdot_status
make_three_modes(held_motion *h)
{
    static const int64_t sides[] = {-1, QDOT_SIDE_SLIDES, 1};
    qdot_piece *x = h->x;
    const qdot_sliding_rows *rows;
    double moved;

    for (size_t k = 0; k < 3; k++) {
        x->side[h->i] = sides[k];
        QDOT_TRY(qdot_piece_enter(x));
        h->mode[k] = x->mode;
    }
    rows = &x->c->stage->modes.at[h->mode[1]]->held;
    memcpy(h->y, x->start.y, x->n * sizeof *h->y);
    QDOT_TRY(qdot_sliding_rows_keep(rows, h->n, x->start.t, h->y, &moved));
    QDOT_TRY(qdot_sliding_rows_value(rows, h->n, x->start.t, x->start.y, h->i, 1, &h->v, NULL));
    QDOT_TRY(qdot_sliding_rows_value(rows, h->n, x->start.t, x->start.y, h->i, 0, &h->u, h->slopes));
    for (size_t k = 0; k < h->n; k++)
        h->square += h->slopes[k] * h->slopes[k];
    return QDOT_OK;
}

/* Find the accelerations towards the surface from below and from above, and their difference's direction. */
static qdot_status
find_accelerations_to_surface(held_motion *h, double a[2])
{
    for (size_t k = 0; k < 2; k++) {
        QDOT_TRY(find_acceleration_to_surface(h, k ? 1 : -1, NULL, 0, 0, &a[k]));
        for (size_t j = 0; j < h->n; j++)
            h->along[j] += (k ? -1 : 1) * h->rates[3 * h->n + j];
    }
    for (size_t j = 0; j < h->n; j++)
        h->along[j] /= a[0] + a[1];
    return QDOT_OK;
}

/* Find the rate d(log v)/dt of growth of the speed v with which the motion oscillates about the surface. */
static qdot_status
find_growth_rate(held_motion *h, const double a[2], double *growth)
{
    const size_t n = h->n;
    const double step = 0x1p-20 * (h->x->t1 - h->x->start.t), speed = 0x1p-20 * fmax(1, fabs(h->v));
    const qdot_ode_system *held = h->x->c->systems.at + h->mode[1];
    double *flow = qdot_malloc((2 * n + 1) * sizeof *flow), sum = 0, weights = 0;
    qdot_status status = flow ? held->rhs(h->x->start.t, h->y, flow, held->user) : QDOT_ENOMEM;

    for (size_t k = 0; k < 2 && status == QDOT_OK; k++) {
        const int way = k ? 1 : -1;
        double later = a[k], faster = a[k], slower = a[k];

        if (step != 0)
            status = find_acceleration_to_surface(h, way, flow, step, 0, &later);
        if (status == QDOT_OK)
            status = find_acceleration_to_surface(h, way, NULL, 0, speed, &faster);
        if (status == QDOT_OK)
            status = find_acceleration_to_surface(h, way, NULL, 0, -speed, &slower);
        sum += ((step != 0 ? (later - a[k]) / step / a[k] : 0) - way * (faster - slower) / (2 * speed)) / (3 * a[k]);
        weights += 1 / a[k];
    }
    *growth = sum / weights;
    qdot_free(flow);
    return status;
}

/* Whether an oscillation of amplitude `place` and this period is too fast to be followed until the
 * end of the run. */
static bool
is_oscillation_too_fast(const held_motion *h, double place, double period)
{
    const double *scales = h->x->c->stage->scales, *y = h->x->start.y;
    const bool in_two = h->x->method->series && !h->x->options->alternates;
    double rounding = 0, places = 0, speeds = 0, crossings = fabs(h->x->t1 - h->x->start.t) / period;

    for (size_t k = 0; k < h->n; k++) {
        rounding += ulps / 2 * DBL_EPSILON * fabs(h->slopes[k] * y[k]);
        places += near * fabs(h->slopes[k]) * qdot_ode_size(scales, k, y[k]);
        speeds += fabs(h->slopes[k]) * qdot_ode_size(scales, h->n + k, y[h->n + k]);
    }
    if (!in_two && fabs(h->v) <= slow_in_doubles * speeds && crossings * rounding > most_lost * place)
        return true;
    return place <= rounding
           || (place <= places && fabs(h->v) <= slow * speeds && crossings > most_crossings);
}

/* *may: whether the motion may be taken to slide on the surface from here; then the start is moved onto it. */
static qdot_status
start_sliding_if_allowed(held_motion *h, bool *may)
{
    qdot_piece *x = h->x;
    double a[2] = {0}, growth = 0, v, place, period;
    qdot_course_chatter chatter;

    QDOT_TRY(make_three_modes(h));
    QDOT_TRY(find_accelerations_to_surface(h, a));
    if (!(a[0] > 0 && a[1] > 0 && isfinite(a[0]) && isfinite(a[1])))
        return QDOT_OK;
    place = fabs(h->u) + h->v * h->v / (2 * fmin(a[0], a[1]));
    v = sqrt(h->v * h->v + 2 * fmax(a[0], a[1]) * fabs(h->u));
    period = v / a[0] + v / a[1];
    if (!is_oscillation_too_fast(h, place, period))
        return QDOT_OK;
    QDOT_TRY(find_growth_rate(h, a, &growth));
    growth = fmax(0, growth * x->direction) * fabs(x->t1 - x->start.t);
    if (!(growth <= log(most_growth)))
        return QDOT_OK;
    *may = true;
    memcpy(x->start.y, h->y, x->n * sizeof *h->y);
    chatter = (qdot_course_chatter){.surface = h->i, .t = x->start.t, .end = x->t1,
                                    .place = place, .speed = v * exp(growth),
                                    .mode = {h->mode[0], h->mode[1], h->mode[2]},
                                    .along = qdot_calloc(2 * h->n + 1, sizeof *chatter.along)};
    if (!chatter.along)
        return QDOT_ENOMEM;
    memcpy(chatter.along, h->along, h->n * sizeof *h->along);
    memcpy(chatter.along + h->n, h->slopes, h->n * sizeof *h->slopes);
    if (qdot_vec_push(&x->c->chatters, chatter) == QDOT_OK)
        return QDOT_OK;
    qdot_free(chatter.along);
    return QDOT_ENOMEM;
}

static qdot_status
try_to_slide(qdot_piece *x, size_t i, bool *may)
{
    const size_t n = x->n / 2, mode = x->mode;
    const int64_t side = x->side[i];
    held_motion h = {.x = x, .i = i, .n = n};
    qdot_status status;

    *may = false;
    h.y = qdot_calloc(10 * n + 1, sizeof *h.y);
    h.slopes = h.y + 2 * n;
    h.along = h.slopes + n;
    h.rates = h.along + n;
    h.moved = h.rates + 4 * n;
    status = h.y ? start_sliding_if_allowed(&h, may) : QDOT_ENOMEM;
    x->side[i] = *may ? QDOT_SIDE_SLIDES : side;
    x->mode = *may ? h.mode[1] : mode;
    qdot_free(h.y);
    return *may ? status : qdot_grave(status);
}

/* Those that have left their surface end; one companion leaves it faster than that by twice what is not known, to the
 * side to which the run leaves. */
static void
end_finished_chatters(qdot_piece *x)
{
    const size_t n = x->n / 2;

    for (size_t k = 0; k < x->c->chatters.n; k++) {
        qdot_course_chatter *chatter = &x->c->chatters.at[k];

        if (chatter->ended || x->side[chatter->surface] == QDOT_SIDE_SLIDES)
            continue;
        chatter->ended = true;
        chatter->end = x->start.t;
        for (size_t i = 0; i < n && !x->start.jumped && x->c->early > 0; i++)
            x->start.y[n + i] += 2 * (double)x->side[chatter->surface] * chatter->speed * chatter->along[i];
    }
}

bool
qdot_piece_is_of_places(const qdot_piece *x, size_t i)
{
    const qdot_surface *s = &x->c->stage->switches.surfaces.at[i];

    return !s->steps && s->layer == 0
           && (qdot_expr_node(x->c->stage->switches.pool, s->u)->holds
               & (QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER))
                  == 0
           && (qdot_expr_node(x->c->stage->switches.pool, s->u)->holds & QDOT_HAS_COORD) != 0;
}

qdot_status
qdot_piece_stop_chatter(qdot_piece *x, bool anew)
{
    const size_t own = qdot_switches_own(&x->c->stage->switches);

    end_finished_chatters(x);
    if (x->t1 == x->start.t)
        return QDOT_OK;
    for (size_t i = 0; i < own; i++) {
        bool crossed = anew, may;

        for (size_t k = 0; k < x->crossed.n && !crossed; k++)
            crossed = x->crossed.at[k] == i;
        if (!crossed || (x->side[i] != 1 && x->side[i] != -1) || !qdot_piece_is_of_places(x, i)
            || qdot_piece_holds_massless(x, i)) /* a massless coordinate cannot oscillate about its surface */
            continue;
        QDOT_TRY(try_to_slide(x, i, &may));
    }
    return QDOT_OK;
}
