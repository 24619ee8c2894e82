/* continuation.c -- finds which curves are known already, and follows the others through their crossings. */
#include "sim/branches/continuation.h"

#include <math.h>
#include <string.h>

#include "sim/branches/branch-marks.h"
#include "sim/branches/branch-points.h"

/* Places that are one: rounding at a place near a fold. First steps along the other curve of a crossing. Of a unit
 * direction: below, it has no part along p. */
static const double same = 1e-6, leaps[] = {1e-3, 1e-2, 1e-4}, upright = 1e-8;
/* A residual counts as 0 below this fraction of the residuals at shifted unknowns. */
static const double zero = 1e-9;
enum { MOST_BRANCHES = 400 };

void
qdot_continuation_clear(qdot_continuation *x)
{
    for (size_t i = 0; i < x->branches.n; i++)
        qdot_branch_clear(&x->branches.at[i]);
    for (size_t i = 0; i < x->bifurcations.n; i++)
        qdot_free(x->bifurcations.at[i].y);
    qdot_free(x->branches.at);
    qdot_free(x->bifurcations.at);
    qdot_free(x->left.at);
    qdot_free(x->size);
    *x = (qdot_continuation){0};
}

/* --- curves that are known already ------------------------------------------------------------- */

/* Whether y lies on the curve between its points `from` and `to`; `here` is work space. */
static bool
lies_between(qdot_path *x, const double *from, const double *to, const double *y,
             qdot_path_point *here)
{
    const size_t n = x->n;
    double along = 0, length = 0, off, part;

    for (size_t i = 0; i <= n; i++) {
        double d = y[i] - from[i];

        if (i < n && x->angle[i])
            d -= 2 * M_PI * round(d / (2 * M_PI));
        along += x->weight[i] * d * (to[i] - from[i]);
        length += x->weight[i] * (to[i] - from[i]) * (to[i] - from[i]);
    }
    if (!(length > 0))
        return qdot_path_distance(x, from, y) < same;
    part = along / length;
    length = sqrt(length);
    if (part < -0.01 || part > 1.01)
        return false;
    for (size_t i = 0; i <= n; i++)
        here->y[i] = from[i] + part * (to[i] - from[i]);
    off = qdot_path_distance(x, here->y, y);
    if (off < same)
        return true;
    if (off > 0.1 * length)
        return false;
    for (size_t i = 0; i <= n; i++)
        here->t[i] = x->weight[i] * (to[i] - from[i]);
    return qdot_path_solve(x, here->t, here->y, &(int){0}) &&
           qdot_path_distance(x, here->y, y) < same;
}

qdot_status
qdot_continuation_knows(qdot_branch_search *s, const double *y, bool *known)
{
    const size_t m = s->x->width;
    qdot_path_point here = {0};
    qdot_status status = qdot_path_point_begin(s->x, &here);

    *known = false;
    for (size_t i = 0; i < s->all->branches.n && status == QDOT_OK && !*known; i++) {
        const qdot_branch *b = &s->all->branches.at[i];

        for (size_t k = 1; k < b->n && !*known; k++)
            *known = lies_between(s->x, b->y + (k - 1) * m, b->y + k * m, y, &here);
    }
    qdot_path_point_end(&here);
    return status;
}

/* --- following branches ------------------------------------------------------------------- */

/* One branch of two ways that begin at the same place: the first backwards, `middle` if not NULL, the
 * second. */
static qdot_status
join_branches(qdot_branch_search *s, const qdot_branch *back, const double *middle, qdot_stability stability,
              size_t mark, const qdot_branch *on)
{
    const size_t m = s->x->width;
    qdot_branch whole = {.end = {back->end[1], on->end[1]}};
    qdot_status status = QDOT_OK;

    memcpy(whole.reason[0], back->reason[1], sizeof whole.reason[0]);
    memcpy(whole.reason[1], on->reason[1], sizeof whole.reason[1]);

    for (size_t k = back->n; k-- > 0 && status == QDOT_OK;)
        status = qdot_branch_add(s->x, &whole, back->y + k * m, back->stability[k], back->mark[k]);
    if (status == QDOT_OK)
        status = qdot_branch_add(s->x, &whole, middle, stability, mark);
    for (size_t k = 0; k < on->n && status == QDOT_OK; k++)
        status = qdot_branch_add(s->x, &whole, on->y + k * m, on->stability[k], on->mark[k]);
    if (status == QDOT_OK)
        status = qdot_vec_push(&s->all->branches, whole);
    if (status != QDOT_OK)
        qdot_branch_clear(&whole);
    return status;
}

/* Renumber the points of a closed branch so that it begins and ends at its first bifurcation. */
static qdot_status
rotate_closed_branch(const qdot_path *x, qdot_branch *branch)
{
    const size_t m = x->width, last = branch->n - 1;
    double *y = qdot_calloc(m, sizeof *y);
    qdot_branch turned = {.end = {QDOT_END_CLOSED, QDOT_END_CLOSED}};
    qdot_status status = y ? QDOT_OK : QDOT_ENOMEM;
    size_t first = 0;

    while (first < last && branch->mark[first] == 0)
        first++;
    for (size_t k = 0; k <= last && status == QDOT_OK; k++) { /* closed curve: the last point is the first one again */
        const size_t from = first + k < last ? first + k : first + k - last;

        for (size_t i = 0; i < m; i++)
            y[i] = branch->y[from * m + i] +
                   (first + k < last ? 0 : branch->y[last * m + i] - branch->y[i]);
        status = qdot_branch_add(x, &turned, y, branch->stability[from], branch->mark[from]);
    }
    qdot_free(y);
    if (status != QDOT_OK || first == last) {
        qdot_branch_clear(&turned);
        return status;
    }
    qdot_branch_clear(branch);
    *branch = turned;
    return QDOT_OK;
}

/* Follow the curve in both directions from a point with known tangent; p grows along the second.
 * *alone: no other point was found. */
static qdot_status
follow_in_both_directions(qdot_branch_search *s, qdot_path_point *a, bool *alone)
{
    const size_t m = s->x->n + 1;
    qdot_branch back = {.end = {QDOT_END_RANGE, QDOT_END_RANGE}}, on = {0};
    qdot_status status = s->x->judge(s->x, a);

    if (a->t[m - 1] < 0)
        for (size_t i = 0; i < m; i++)
            a->t[i] = -a->t[i];
    if (status == QDOT_OK && qdot_path_tangent(s->x, a->t, a))
        status = qdot_branch_follow(s, a, &on);
    back.end[1] = on.end[1];
    if (status == QDOT_OK && on.end[1] != QDOT_END_CLOSED) {
        for (size_t i = 0; i < m; i++)
            a->t[i] = -a->t[i];
        a->det = -a->det;
        status = qdot_branch_follow(s, a, &back);
    }
    *alone = on.n + back.n == 0 && on.end[1] == QDOT_END_LOST && back.end[1] == QDOT_END_LOST;
    if (status == QDOT_OK && !*alone)
        status = join_branches(s, &back, a->y, a->stability, 0, &on);
    if (status == QDOT_OK && on.end[1] == QDOT_END_CLOSED)
        status = rotate_closed_branch(s->x, &s->all->branches.at[s->all->branches.n - 1]);
    qdot_branch_clear(&back);
    qdot_branch_clear(&on);
    return status;
}

/* The largest |F| at y, with each unknown shifted by the fraction `part` of its typical size. */
static double
largest_residual(qdot_branch_search *s, const double *y, double part, double *room)
{
    double most = 0;

    memcpy(room, y, (s->x->n + 1) * sizeof *room);
    for (size_t i = 0; i < s->x->n; i++)
        room[i] += part * s->all->size[i];
    s->x->at(s->x, room);
    for (size_t i = 0; i < s->x->n; i++)
        most = isfinite(s->x->F[i]) ? fmax(most, fabs(s->x->F[i])) : INFINITY;
    return most;
}

/* From a place y at its p: polished, its curve followed unless it is known; *left: it has no single direction, or
 * nothing is found beside it. */
static qdot_status
follow_from_point(qdot_branch_search *s, const double *y, bool *left)
{
    qdot_path *x = s->x;
    const size_t m = x->n + 1;
    double *up = qdot_calloc(m, sizeof *up);
    qdot_path_point a = {0};
    bool known = true, alone = false;
    qdot_status status = up ? qdot_path_point_begin(x, &a) : QDOT_ENOMEM;

    if (status == QDOT_OK) {
        memcpy(a.y, y, m * sizeof *y);
        up[m - 1] = 1;
        known = qdot_path_is_inside(x, a.y);
        if (known && qdot_path_hold(x, m - 1, a.y) &&
            qdot_path_distance(x, a.y, y) < 1e-3 && qdot_path_tangent(x, up, &a)) {
            status = qdot_continuation_knows(s, a.y, &known);
            if (status == QDOT_OK && !known)
                status = follow_in_both_directions(s, &a, &alone);
            known = false;
        }
        *left = alone || (known && largest_residual(s, y, 0, up) < zero * largest_residual(s, y, 0.3, up));
    }
    qdot_path_point_end(&a);
    qdot_free(up);
    return status;
}

/* --- crossings of branches ----------------------------------------------------------------- */

/* Whether dp/ds changes its sign between the crossing `start` and a: then the step leapt over a fold. */
static bool
has_fold_between(const qdot_path *x, const qdot_path_point *start, const qdot_path_point *a)
{
    return start->t[x->n] * a->t[x->n] < 0 && fabs(start->t[x->n]) * sqrt(x->weight[x->n]) > upright;
}

/* A first point a beyond a crossing at y along `other`, times `way`, by a few lengths, not `over` a fold unless that is
 * said; false: none. */
static bool
point_beyond_crossing(qdot_path *x, const double *y, const double *other, double way, bool over,
                      qdot_path_point *start, qdot_path_point *a)
{
    const size_t m = x->n + 1;
    int steps;

    for (size_t k = 0; k < sizeof leaps / sizeof *leaps; k++) {
        double along = 0, length;

        for (size_t i = 0; i < m; i++) {
            start->y[i] = y[i];
            start->t[i] = way * other[i];
        }
        if (!qdot_path_go(x, start, leaps[k], a, &steps))
            continue;
        for (size_t i = 0; i < m; i++)
            along += x->weight[i] * (a->y[i] - y[i]) * start->t[i];
        length = qdot_path_distance(x, a->y, y);
        if (along > 0.9 * length && a->y[m - 1] >= x->least && a->y[m - 1] <= x->most &&
            (over || !has_fold_between(x, start, a)))
            return true;
    }
    return false;
}

/* A fold beside the crossing `start` on the curve through a: too near to the crossing for a first step to end before it.
 * To the arm. */
static qdot_status
add_fold_near_crossing(qdot_branch_search *s, const qdot_path_point *start, const qdot_path_point *a, qdot_branch *arm)
{
    qdot_path *x = s->x;
    const size_t n = x->n, w = x->width;
    qdot_bifurcation b = {.kind = QDOT_NOT_SIMPLE, .y = qdot_calloc(2 * w, sizeof *b.y)};
    qdot_path_point here = {0};
    qdot_bifurcation_bracket in = {.a = &here, .to = qdot_path_distance(x, start->y, a->y)};
    size_t mark = 0;
    qdot_status status = b.y ? qdot_path_point_begin(x, &here) : QDOT_ENOMEM;

    if (status == QDOT_OK) {
        b.error = b.y + w;
        memcpy(b.y, start->y, w * sizeof *b.y);
        qdot_path_point_copy(x, a, &here);
        for (size_t i = 0; i <= n; i++) /* direction back to the crossing */
            here.t[i] = -here.t[i];
        status = qdot_branch_fold_beside(s, &in, &b);
    }
    if (status == QDOT_OK && b.kind == QDOT_FOLD) {
        memcpy(here.y, b.y, w * sizeof *b.y);
        status = x->judge(x, &here);
        qdot_branch_turn_back(x, b.y);
        if (status == QDOT_OK) {
            status = qdot_branch_mark(s, &b, NULL, &mark);
            b.y = NULL;
        }
        if (status == QDOT_OK)
            status = qdot_branch_add(x, arm, here.y, here.stability, mark);
    }
    qdot_free(b.y);
    qdot_path_point_end(&here);
    return status;
}

/* Follow one arm of the curve that crosses at y; `arm` stays empty if there is none or if it is
 * known already. */
static qdot_status
follow_one_side_of_crossing(qdot_branch_search *s, const double *y, const double *other, double way,
                            qdot_branch *arm)
{
    qdot_path_point start = {0}, a = {0};
    bool known = true, over = false;
    qdot_status status = qdot_path_point_begin(s->x, &start);

    arm->end[1] = QDOT_END_RANGE;
    if (status == QDOT_OK)
        status = qdot_path_point_begin(s->x, &a);
    if (status == QDOT_OK && (point_beyond_crossing(s->x, y, other, way, false, &start, &a) ||
                              (over = point_beyond_crossing(s->x, y, other, way, true, &start, &a)))) {
        if (!qdot_path_is_inside(s->x, a.y))
            arm->end[1] = QDOT_END_DOMAIN;
        if (arm->end[1] == QDOT_END_RANGE)
            status = qdot_continuation_knows(s, a.y, &known);
    }
    if (status == QDOT_OK && !known) {
        status = s->x->judge(s->x, &a);
        if (status == QDOT_OK && over && s->x->dips)
            status = add_fold_near_crossing(s, &start, &a, arm);
        if (status == QDOT_OK)
            status = qdot_branch_add(s->x, arm, a.y, a.stability, 0);
        if (status == QDOT_OK)
            status = qdot_branch_follow(s, &a, arm);
    }
    qdot_path_point_end(&start);
    qdot_path_point_end(&a);
    return status;
}

/* Follow the second curve at a bifurcation, along the direction `other`: on both sides, or only on one. */
static qdot_status
follow_second_curve(qdot_branch_search *s, size_t at, const double *other, bool both)
{
    const size_t m = s->x->width;
    qdot_branch back = {.end = {QDOT_END_RANGE, QDOT_END_RANGE}}, on = {0};
    qdot_path_point middle = {0};
    qdot_status status = qdot_path_point_begin(s->x, &middle);

    if (status == QDOT_OK) {
        memcpy(middle.y, s->all->bifurcations.at[at].y, m * sizeof *middle.y);
        status = follow_one_side_of_crossing(s, middle.y, other, 1, &on);
    }
    if (status == QDOT_OK && both && on.end[1] != QDOT_END_CLOSED)
        status = follow_one_side_of_crossing(s, middle.y, other, -1, &back);
    if (status == QDOT_OK && on.n + back.n > 0)
        status = s->x->judge(s->x, &middle);
    if (status == QDOT_OK && on.n + back.n > 0)
        status = join_branches(s, &back, middle.y, middle.stability, at + 1, &on);
    qdot_branch_clear(&back);
    qdot_branch_clear(&on);
    qdot_path_point_end(&middle);
    return status;
}

/* Follow the second curve of every crossing in the list, which grows as further crossings are found. */
static qdot_status
follow_crossings(qdot_branch_search *s, size_t *done)
{
    qdot_status status = QDOT_OK;

    for (; *done < s->crossings.n && status == QDOT_OK && !s->all->interrupted &&
           s->all->branches.n < MOST_BRANCHES;
         ++*done) {
        const qdot_branch_crossing one = s->crossings.at[*done];

        status = follow_second_curve(s, one.at, one.other, true);
    }
    return status;
}

/* --- the whole continuation ----------------------------------------------------------------- */

/* Append the point y to s->all->left, the points that lie on no curve followed so far. */
static qdot_status
append_unfollowed_point(qdot_branch_search *s, const double *y)
{
    for (size_t i = 0; i <= s->x->n; i++)
        QDOT_TRY(qdot_vec_push(&s->all->left, y[i]));
    return QDOT_OK;
}

/* Remove from s->all->left, the points that are on no curve, those that lie on a curve already followed. */
static qdot_status
remove_known_points(qdot_branch_search *s)
{
    const size_t m = s->x->n + 1, n = s->all->left.n;
    size_t kept = 0;

    for (size_t k = 0; k < n; k += m) {
        bool known;

        QDOT_TRY(qdot_continuation_knows(s, s->all->left.at + k, &known));
        if (known)
            continue;
        memmove(s->all->left.at + kept, s->all->left.at + k, m * sizeof *s->all->left.at);
        kept += m;
    }
    s->all->left.n = kept;
    return QDOT_OK;
}

qdot_status
qdot_continuation_follow(qdot_branch_search *s, const double *at, size_t count)
{
    const size_t m = s->x->n + 1;
    size_t done = 0;

    for (size_t k = 0; k < count && !s->all->interrupted; k++) {
        bool left = false;

        if (s->all->branches.n >= MOST_BRANCHES)
            return qdot_fail(QDOT_ELIMIT, "more than %d branches", MOST_BRANCHES);
        QDOT_TRY(follow_from_point(s, at + k * m, &left));
        if (left)
            QDOT_TRY(append_unfollowed_point(s, at + k * m));
        QDOT_TRY(follow_crossings(s, &done));
    }
    return remove_known_points(s);
}

qdot_status
qdot_continuation_arm(qdot_branch_search *s, size_t at, const double *other, bool crossings)
{
    size_t done = 0;

    QDOT_TRY(follow_second_curve(s, at, other, false));
    return crossings ? follow_crossings(s, &done) : QDOT_OK;
}

qdot_status
qdot_continuation_finish(qdot_branch_search *s, qdot_status status)
{
    for (size_t i = 0; i < s->crossings.n; i++)
        qdot_free(s->crossings.at[i].other);
    qdot_free(s->crossings.at);
    qdot_free(s->pairs.at);
    if (status == QDOT_OK)
        status = s->x->failure;
    if (status != QDOT_EINTR)
        return status;
    s->all->interrupted = true;
    return QDOT_OK;
}
