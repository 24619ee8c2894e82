/* branch-marks.c -- the list of bifurcations found, without repetition; pairs of them between two
 * points of a curve. */
#include "sim/branches/branch-marks.h"

#include <math.h>
#include <string.h>

#include "sim/branches/branch-points.h"
#include "sim/branches/fold-guess.h"

/* Bifurcations of one kind within this distance are one, if they are located no better; beside their errors where
 * they are proved. */
static const double together = 1e-6, rounded = 1e-11;
/* Two crossings within this distance: between them the curves that cross lie so near to each other that a long step goes
 * over from one to the other. Within 10 times `together` no step is short enough to tell these apart. */
static const double close_together = 1e-2;

/* How far apart two bifurcations of a kind may be found that are one: those that are not located better
 * than by their errors, and those of equations with accurate test functions, by these. */
static double
coincidence_tolerance(const qdot_path *x, const qdot_bifurcation *a, const qdot_bifurcation *b)
{
    const double errors = sqrt(qdot_path_product(x, a->error, a->error)) +
                          sqrt(qdot_path_product(x, b->error, b->error));

    if (a->kind == QDOT_NOT_SIMPLE)
        return together + errors;
    return x->dips ? 4 * errors + rounded : together;
}

/* The index of a bifurcation in the list of those found; the length of the list if it is new. */
static size_t
index_of_bifurcation(const qdot_branch_search *s, const qdot_bifurcation *b)
{
    size_t i = 0;

    while (i < s->all->bifurcations.n &&
           (s->all->bifurcations.at[i].kind != b->kind ||
            qdot_path_distance(s->x, s->all->bifurcations.at[i].y, b->y) >
                coincidence_tolerance(s->x, &s->all->bifurcations.at[i], b)))
        i++;
    return i;
}

/* Record with which earlier crossings the latest one, at bifurcation `at`, forms a close pair. */
static qdot_status
record_close_pairs(qdot_branch_search *s, size_t at)
{
    for (size_t k = 0; k + 1 < s->crossings.n; k++) {
        const size_t other = s->crossings.at[k].at;
        const double gap = qdot_path_distance(s->x, s->all->bifurcations.at[at].y, s->all->bifurcations.at[other].y);

        if (gap < close_together && gap > 10 * together)
            QDOT_TRY(qdot_vec_push(&s->pairs, ((qdot_branch_pair){at, other, gap})));
    }
    return QDOT_OK;
}

double
qdot_branch_longest_near(const qdot_branch_search *s, const double *y)
{
    double longest = INFINITY;

    for (size_t i = 0; i < s->pairs.n; i++) {
        const qdot_branch_pair *p = &s->pairs.at[i];
        const double near = fmin(qdot_path_distance(s->x, s->all->bifurcations.at[p->a].y, y),
                                 qdot_path_distance(s->x, s->all->bifurcations.at[p->b].y, y));

        longest = fmin(longest, fmax(p->gap / 4, near / 2));
    }
    return longest;
}

void
qdot_branch_turn_back(const qdot_path *x, double *y)
{
    for (size_t i = 0; i < x->n; i++)
        if (x->angle[i])
            y[i] -= 2 * M_PI * ceil((y[i] - M_PI) / (2 * M_PI) - 1e-9);
}

qdot_status
qdot_branch_mark(qdot_branch_search *s, qdot_bifurcation *b, double *other, size_t *mark)
{
    const size_t i = index_of_bifurcation(s, b);
    qdot_status status = QDOT_OK;

    *mark = i + 1;
    if (i < s->all->bifurcations.n) {
        qdot_free(b->y);
        qdot_free(other);
        return QDOT_OK;
    }
    status = qdot_vec_push(&s->all->bifurcations, *b);
    if (status != QDOT_OK)
        qdot_free(b->y);
    if (status == QDOT_OK && (b->kind == QDOT_PITCHFORK || b->kind == QDOT_TRANSCRITICAL)) {
        status = qdot_vec_push(&s->crossings, ((qdot_branch_crossing){i, other}));
        other = status == QDOT_OK ? NULL : other;
        if (status == QDOT_OK)
            status = record_close_pairs(s, i);
    }
    qdot_free(other);
    return status;
}

qdot_status
qdot_branch_fold_is_crossing(qdot_branch_search *s, const qdot_bifurcation_bracket *in, qdot_bifurcation *fold,
                             double *other, qdot_bifurcation_answer *answer, bool *outside)
{
    const qdot_path *x = s->x;
    qdot_bifurcation b = {.kind = QDOT_PITCHFORK, .y = qdot_calloc(2 * x->width, sizeof *b.y)};
    qdot_bifurcation_answer found = QDOT_BIFURCATION_NONE;
    qdot_status status = b.y ? QDOT_OK : QDOT_ENOMEM;
    bool same;

    if (status == QDOT_OK) {
        b.error = b.y + x->width;
        memcpy(b.y, fold->y, x->width * sizeof *b.y);
        status = s->find(s->user, in, &b, other, &found);
    }
    same = status == QDOT_OK && found == QDOT_BIFURCATION_FOUND;
    for (size_t i = 0; i <= x->n && same; i++)
        same = fabs(b.y[i] - fold->y[i]) <= fold->error[i] + b.error[i];
    for (size_t i = 0; i < x->n && same; i++) /* an end point of an open domain does not belong to the branch */
        *outside = *outside || b.y[i] - b.error[i] <= qdot_path_end_of(x, i, false, b.y[x->n]) ||
                   b.y[i] + b.error[i] >= qdot_path_end_of(x, i, true, b.y[x->n]);
    if (same) {
        memcpy(fold->y, b.y, 2 * x->width * sizeof *b.y);
        fold->kind = b.kind;
        *answer = QDOT_BIFURCATION_FOUND;
    }
    qdot_free(b.y);
    return status;
}

qdot_status
qdot_branch_fold_beside(qdot_branch_search *s, const qdot_bifurcation_bracket *in, qdot_bifurcation *b)
{
    static const double apart[] = {3e-3, 1e-2, 1e-3, 3e-2, 1e-4};
    const size_t w = s->x->width;
    qdot_bifurcation fold = {.y = qdot_calloc(2 * w, sizeof *fold.y)};
    qdot_bifurcation_answer one = QDOT_BIFURCATION_NONE;
    qdot_status status = fold.y ? QDOT_OK : QDOT_ENOMEM;

    for (size_t k = 0; k < sizeof apart / sizeof *apart && status == QDOT_OK && one != QDOT_BIFURCATION_FOUND; k++) {
        bool turns;

        fold.kind = QDOT_FOLD;
        fold.error = fold.y + w;
        memcpy(fold.y, b->y, w * sizeof *fold.y);
        status = qdot_fold_guess(s->x, in->a, b->y, apart[k], fold.y, &turns);
        if (status == QDOT_OK && turns)
            status = s->find(s->user, in, &fold, NULL, &one);
        if (one == QDOT_BIFURCATION_FOUND && !(qdot_path_distance(s->x, b->y, fold.y) < 3 * apart[k]))
            one = QDOT_BIFURCATION_NONE;
    }
    if (status == QDOT_OK && one == QDOT_BIFURCATION_FOUND) {
        memcpy(b->y, fold.y, 2 * w * sizeof *b->y);
        b->kind = QDOT_FOLD;
    }
    qdot_free(fold.y);
    return status;
}

/* Search a crossing of branches from the point at arclength `way` from a. *found: false if none is near. */
static qdot_status
find_crossing_from(qdot_branch_search *s, const qdot_path_point *a, double way, qdot_path_point *room,
                   qdot_bifurcation *b, double *other, bool *found)
{
    qdot_path *x = s->x;
    qdot_bifurcation_bracket in = {.a = a, .to = fabs(way)};
    qdot_bifurcation_answer answer = QDOT_BIFURCATION_NONE;
    int steps;

    *found = qdot_path_go(x, a, way, room, &steps);
    if (!*found)
        return QDOT_OK;
    memcpy(b->y, room->y, x->width * sizeof *b->y);
    b->kind = QDOT_PITCHFORK;
    QDOT_TRY(s->find(s->user, &in, b, other, &answer));
    *found = answer == QDOT_BIFURCATION_FOUND && qdot_path_distance(x, a->y, b->y) < 4 * fabs(way);
    qdot_branch_turn_back(x, b->y);
    return QDOT_OK;
}

/* How far y lies behind a point of the curve, along the tangent there. Angles of y are moved by full turns, next to those
 * of that point. */
static double
arclength_from(const qdot_path *x, const qdot_path_point *place, double *y)
{
    double way = 0;

    for (size_t i = 0; i <= x->n; i++) {
        if (i < x->n && x->angle[i])
            y[i] += 2 * M_PI * round((place->y[i] - y[i]) / (2 * M_PI));
        way += x->weight[i] * place->t[i] * (y[i] - place->y[i]);
    }
    return way;
}

/* Insert a->y, which lies `way` behind the kept point `place`, into the points of the branch in the order of the
 * curve. */
static qdot_status
insert_branch_point(qdot_branch_search *s, qdot_dips *d, size_t place, double way, qdot_path_point *a, size_t mark,
                    qdot_branch *branch)
{
    qdot_path *x = s->x;
    size_t at = d->count[0];

    QDOT_TRY(x->judge(x, a));
    for (size_t k = 1; k < d->n; k++)
        if (arclength_from(x, &d->at[place], d->at[k].y) < way)
            at = d->count[k];
    QDOT_TRY(qdot_branch_insert(x, branch, at, a->y, a->stability, mark));
    for (size_t k = 0; k < d->n; k++)
        d->count[k] += d->count[k] > at;
    return QDOT_OK;
}

/* The crossings b [2] and a point between them, which has a stability of its own, become points of the branch. Takes
 * what they own. */
static qdot_status
insert_two_bifurcations(qdot_branch_search *s, qdot_dips *d, size_t place, qdot_bifurcation *b, double **other,
                        qdot_path_point *a, qdot_branch *branch)
{
    qdot_path *x = s->x;
    const double way[2] = {arclength_from(x, &d->at[place], b[0].y), arclength_from(x, &d->at[place], b[1].y)};
    qdot_status status = QDOT_OK;
    int steps;

    for (int k = 0; k < 2 && status == QDOT_OK; k++) {
        size_t mark = 0;

        memcpy(a->y, b[k].y, x->width * sizeof *a->y);
        qdot_branch_turn_back(x, b[k].y);
        status = qdot_branch_mark(s, &b[k], other[k], &mark);
        b[k].y = other[k] = NULL;
        if (status == QDOT_OK)
            status = insert_branch_point(s, d, place, way[k], a, mark, branch);
    }
    if (status == QDOT_OK && qdot_path_go(x, &d->at[place], (way[0] + way[1]) / 2, a, &steps))
        status = insert_branch_point(s, d, place, (way[0] + way[1]) / 2, a, 0, branch);
    return status;
}

qdot_status
qdot_branch_mark_pair(qdot_branch_search *s, qdot_dips *d, size_t place, double way, qdot_branch *branch,
          bool *both)
{
    qdot_path *x = s->x;
    const size_t w = x->width;
    qdot_bifurcation b[2] = {{.y = qdot_calloc(2 * w, sizeof(double))},
                             {.y = qdot_calloc(2 * w, sizeof(double))}};
    double *other[2] = {qdot_calloc(x->n + 1, sizeof(double)), qdot_calloc(x->n + 1, sizeof(double))};
    qdot_path_point room = {0};
    qdot_status status =
        b[0].y && b[1].y && other[0] && other[1] ? qdot_path_point_begin(x, &room) : QDOT_ENOMEM;

    *both = status == QDOT_OK;
    for (int k = 0; k < 2 && *both && status == QDOT_OK; k++) {
        b[k].error = b[k].y + w;
        status = find_crossing_from(s, &d->at[place], k == 0 ? -way : way, &room, &b[k], other[k], both);
    }
    *both = *both && status == QDOT_OK &&
            qdot_path_distance(x, b[0].y, b[1].y) > coincidence_tolerance(x, &b[0], &b[1]);
    if (*both && status == QDOT_OK)
        status = insert_two_bifurcations(s, d, place, b, other, &room, branch);
    for (int k = 0; k < 2; k++) {
        qdot_free(b[k].y);
        qdot_free(other[k]);
    }
    qdot_path_point_end(&room);
    return status;
}

qdot_status
qdot_branch_mark_zero(qdot_branch_search *s, const qdot_dips *d, size_t place, double apart, qdot_branch *branch)
{
    qdot_path *x = s->x;
    const size_t w = x->width;
    const qdot_path_point *here = &d->at[place];
    qdot_bifurcation b = {.kind = QDOT_NOT_SIMPLE, .y = qdot_calloc(2 * w, sizeof *b.y)};
    size_t mark = 0;
    qdot_status status = b.y ? QDOT_OK : QDOT_ENOMEM;

    if (status != QDOT_OK)
        return status;
    b.error = b.y + w;
    memcpy(b.y, here->y, w * sizeof *b.y);
    for (size_t i = 0; i < w; i++)
        b.error[i] = i <= x->n ? apart / sqrt(x->weight[i]) : NAN;
    qdot_branch_turn_back(x, b.y);
    status = qdot_branch_mark(s, &b, NULL, &mark);
    if (status == QDOT_OK && d->count[place] > 0)
        branch->mark[d->count[place] - 1] = mark;
    return status;
}
