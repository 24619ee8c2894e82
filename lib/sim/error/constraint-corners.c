/* constraint-corners.c -- points of a run at which constraints are nearly dependent, and whether
 * the motion turns there. */
#include "sim/error/constraint-corners.h"

#include <float.h>
#include <math.h>

#include "base/interrupt.h"
#include "sim/bind/bind.h"
#include "sim/model/constrained.h"

/* What is left of a row counts as nothing below this; the motion is looked at where so many times
 * as much is left, and where `apart` is. */
static const double nothing = 1e-3, beside = 4, apart = 0.1;

/* At a corner the directions differ by a cosine of at most `turned`; the speed beside it is at
 * least `kept` of the usual. */
static const double turned = 0.5, kept = 0.3;

typedef struct {
    const qdot_trajectory *tr;
    qdot_constrained *held;
    size_t first, last; /* indices of the first and last point of the piece */
} piece;

static double
remaining_independence(const piece *p, size_t k, size_t *row)
{
    return qdot_constrained_remains(p->held, p->tr->t[k], p->tr->y + k * p->tr->n, row);
}

/* From point k in the direction `way`: the first point with more than `left` of each row; else the
 * end of the piece. */
static size_t
find_independent_point(const piece *p, size_t k, int way, double left)
{
    size_t row;

    while (k != (way > 0 ? p->last : p->first) && remaining_independence(p, k, &row) <= left)
        k = way > 0 ? k + 1 : k - 1;
    return k;
}

static double
velocities_product(const piece *p, size_t a, size_t b)
{
    const size_t n = p->tr->n / 2;
    const double *u = p->tr->y + a * p->tr->n + n, *v = p->tr->y + b * p->tr->n + n;
    double sum = 0;

    for (size_t i = 0; i < n; i++)
        sum += u[i] * v[i];
    return sum;
}

/* Whether the direction of motion changes abruptly at point k, where constraint rows have the
 * fraction `least` left. */
static bool
is_constraint_corner(const piece *p, size_t k, double least)
{
    const double near = beside * fmax(least, DBL_MIN);
    const size_t before = find_independent_point(p, k, -1, near), after = find_independent_point(p, k, 1, near);
    const size_t far = find_independent_point(p, k, -1, apart);
    const double speed = sqrt(velocities_product(p, before, before)), on = sqrt(velocities_product(p, after, after));

    return velocities_product(p, before, after) < turned * speed * on
           && fmin(speed, on) > kept * sqrt(velocities_product(p, far, far));
}

static qdot_status
find_corner_in_piece(const piece *p, bool *found, double *t, size_t *row)
{
    double last = INFINITY, now = INFINITY;
    size_t of = 0;

    for (size_t k = p->first; k <= p->last && !*found; k++) {
        const double next = remaining_independence(p, k, &of);

        if (k % 1024 == 0)
            QDOT_TRY(qdot_interrupt_check());
        if (now < nothing && now <= last && now < next && is_constraint_corner(p, k - 1, now)) {
            *found = true;
            *t = p->tr->t[k - 1];
            (void)remaining_independence(p, k - 1, row);
        }
        last = now;
        now = next;
    }
    return QDOT_OK;
}

qdot_status
qdot_constraint_corners_find(const qdot_course *c, bool *found, double *t, size_t *row)
{
    const qdot_trajectory *tr = &c->tr;

    *found = false;
    for (size_t i = 0; i < tr->pieces.n && !*found; i++) {
        const qdot_trajectory_piece *at = tr->pieces.at + i;
        const piece p = {.tr = tr,
                         .held = c->binds.at[at->mode] ? qdot_bind_held(c->binds.at[at->mode])
                                                       : NULL,
                         .first = at->first,
                         .last = qdot_trajectory_last_of(tr, i)};

        if (p.held && tr->n_tracks == 0)
            QDOT_TRY(find_corner_in_piece(&p, found, t, row));
    }
    return QDOT_OK;
}
