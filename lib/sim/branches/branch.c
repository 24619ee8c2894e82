/* branch.c -- follows a curve step by step and finds the bifurcations between two of its points. */
#include "sim/branches/branch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/interrupt.h"
#include "sim/branches/branch-marks.h"
#include "sim/branches/branch-points.h"

/* Lengths along curves: p's range, one radian and the typical size of each coordinate count as 1. */
static const double first_step = 2e-3, far_away = 100;
/* Smallest cosine of the angle between the tangents at neighbouring points of a curve. */
static const double straight = 0.99;
/* A point that is farther away than the step, by more than this factor, belongs to another curve. */
static const double longer = 1.02;
/* Between neighbouring orbits, multipliers turn and grow by less than this, unless the step is short. */
static const double turned = 0.5, grown = 1;
/* Bifurcations of different kinds that are closer than this (in arclength) count as one. */
static const double together = 1e-6;
/* The smallest step (arclength) that still tells two curves that do not cross from each other. */
static const double nearest = 1e-8;
/* If rounding hides signs at a step's ends, they are evaluated beyond it by this fraction of the step. */
static const double beyond = 0.05;
/* A determinant smaller than this, relative to the largest so far, has an uncertain sign. */
static const double doubtful = 1e-13;
/* HALVINGS: number of bisections for a bifurcation that Newton's method does not find. */
enum { MOST_POINTS = 20000, UNKNOWN = 20, HALVINGS = 52 };

/* --- bifurcations between two points ---------------------------------------------------------- */

/* Whether p is stationary along the curve at a, as at a fold: the tangent has no component along p. */
static bool
is_vertical(const qdot_path *x, const qdot_path_point *a)
{
    return fabs(a->t[x->n]) * sqrt(x->weight[x->n]) < x->upright;
}

/* Whether no bifurcation of the given kind lies between the points a and b of the branch. */
static bool
has_no_bifurcation_between(const qdot_path *x, qdot_bifurcation_kind kind, const qdot_path_point *a,
                           const qdot_path_point *b)
{
    if (kind == QDOT_FOLD)
        return a->t[x->n] * b->t[x->n] > 0 || (is_vertical(x, a) && is_vertical(x, b));
    if (kind == QDOT_DOUBLING)
        return a->flip == b->flip;
    if (kind == QDOT_HALVING)
        return qdot_path_halves(x, a->y, b->y) > 0;
    return kind == QDOT_HOPF ? a->growing == b->growing : (a->det < 0) == (b->det < 0);
}

/* The test function of a bifurcation of that kind at arclength s from a; 0: there is none, or no point. here:
 * room. */
static double
test_function_at(qdot_path *x, qdot_bifurcation_kind kind, const qdot_path_point *a, double s,
                 qdot_path_point *here)
{
    int steps;

    if (!qdot_path_go(x, a, s, here, &steps) || qdot_path_product(x, a->t, here->t) < straight)
        return 0;
    return kind == QDOT_FOLD ? here->t[x->n] * sqrt(x->weight[x->n]) : here->det;
}

/* To the errors, how far ahead of a the determinant would vanish if it went on as behind a, up to its
 * fourth power. */
static void
add_error_of_extrapolated_zero(qdot_path *x, const qdot_path_point *a, double length, qdot_path_point *here,
                               qdot_bifurcation *out)
{
    const double back = 10 * length, before = test_function_at(x, QDOT_PITCHFORK, a, -back, here),
                 way = 4 * back * fabs(a->det / (a->det - before));

    for (size_t i = 0; i <= x->n; i++)
        out->error[i] += (before != 0 && way < 1 ? way : 1) / sqrt(x->weight[i]);
}

/* Below, the value that changes its sign is rounding at that point: of a tangent that grows as the determinant
 * falls. */
static double
test_function_rounding(const qdot_path *x, qdot_bifurcation_kind kind, const qdot_path_point *here)
{
    if (kind != QDOT_FOLD)
        return doubtful * x->most_det;
    return 100 * x->upright * fmax(1, fmin(fabs(x->most_det / here->det), 1e8));
}

/* Where it may lie, as far as signs are beyond rounding: widen in->from and in->to, also beyond the step
 * of `length`; errors by the places there. */
static void
widen_to_clear_signs(qdot_path *x, qdot_bifurcation_bracket *in, double length, qdot_path_point *here,
                     qdot_bifurcation *out)
{
    const double middle = (in->from + in->to) / 2;
    const double start = in->to - in->from;
    double sign[2] = {0, 0}, first[2] = {0, 0};

    for (size_t i = 0; i <= x->n; i++)
        out->error[i] = 1e-12 / sqrt(x->weight[i]);
    for (int side = 0; side < 2; side++) {
        double d = fmax((in->to - in->from) / 2, 1e-10), s = middle;

        for (; sign[side] == 0; d *= 2) {
            const double f = test_function_at(x, out->kind, in->a, s = side ? middle + d : middle - d, here);

            first[side] = first[side] == 0 ? f : first[side];
            if (fabs(f) > test_function_rounding(x, out->kind, here))
                sign[side] = f;
            else if (s < -beyond || s > length + beyond)
                break;
        }
        if (side)
            in->to = s;
        else
            in->from = s;
        for (size_t i = 0; i <= x->n; i++)
            out->error[i] = fmax(out->error[i], sign[side] != 0 ? fabs(here->y[i] - out->y[i])
                                                                : beyond / sqrt(x->weight[i]));
    }
    if (out->kind == QDOT_FOLD) /* at a fold p is extremal between the two points, not at one of them */
        out->error[x->n] = fmax(out->error[x->n], fmax(fabs(sign[0]), fabs(sign[1])) * (in->to - in->from) /
                                                      sqrt(x->weight[x->n]));
    in->changes = sign[0] * sign[1] < 0;
    in->stays = sign[0] * sign[1] > 0;
    in->jumps = out->kind == QDOT_PITCHFORK &&
                (start > 1e-6 * length ||
                 fmin(fabs(first[0]), fabs(first[1])) > 1e-3 * fabs(in->a->det));
    if (in->jumps)
        add_error_of_extrapolated_zero(x, in->a, length, here, out);
}

/* Bisect between the point a and arclength in->to; out->y: the middle of the last interval, out->error: its length. */
static qdot_status
bisect_for_bifurcation(qdot_path *x, qdot_bifurcation_bracket *in, int halvings, qdot_bifurcation *out)
{
    const qdot_path_point *a = in->a;
    const double unit = 1 / sqrt(x->weight[x->n]);
    qdot_path_point middle;
    const double length = in->to;
    double from = 0, s = length;
    qdot_status status = qdot_path_point_begin(x, &middle);
    int steps;

    memcpy(out->y, a->y, x->width * sizeof *out->y);
    for (int k = 0; k < halvings && status == QDOT_OK; k++) {
        const double half = (from + s) / 2;

        if (!qdot_path_go(x, a, half, &middle, &steps) ||
            qdot_path_product(x, a->t, middle.t) < straight)
            break; /* stop: the point is too near to a crossing, or the step has jumped to another curve */
        memcpy(out->y, middle.y, x->width * sizeof *out->y);
        if (out->kind == QDOT_HOPF || out->kind == QDOT_DOUBLING)
            status = x->judge(x, &middle);
        if (has_no_bifurcation_between(x, out->kind, a, &middle))
            from = half;
        else
            s = half;
    }
    in->from = from;
    in->to = s;
    for (size_t i = 0; i <= x->n; i++)
        out->error[i] = (s - from + 1e-8) * (i < x->n ? 1 / sqrt(x->weight[i]) : unit);
    for (size_t i = x->n + 1; i < x->width; i++)
        out->error[i] = NAN;
    if (status == QDOT_OK && x->dips && (out->kind == QDOT_FOLD || out->kind == QDOT_PITCHFORK))
        widen_to_clear_signs(x, in, length, &middle, out);
    qdot_path_point_end(&middle);
    return status;
}

/* Whether the curve has this mark already and has not left its surroundings since: a crossing at which the curve
 * turns is told by either sign. */
static bool
is_last_point(const qdot_path *x, const qdot_branch *branch, const double *y, size_t mark)
{
    for (size_t k = branch->n; k-- > 0 && qdot_path_distance(x, branch->y + k * x->width, y) < first_step;)
        if (branch->mark[k] == mark)
            return true;
    return false;
}

/* Record a bifurcation and add its point to the branch. Takes ownership of b->y and of `other`. */
static qdot_status
record_bifurcation(qdot_branch_search *s, qdot_bifurcation *b, double *other, qdot_branch *branch)
{
    qdot_path *x = s->x;
    qdot_path_point here = {0};
    size_t mark;
    qdot_status status = qdot_path_point_begin(x, &here);

    if (status != QDOT_OK) {
        qdot_free(b->y);
        qdot_free(other);
        return status;
    }
    memcpy(here.y, b->y, x->width * sizeof *b->y);
    status = x->judge(x, &here);
    memcpy(b->y + x->n + 1, here.y + x->n + 1, (x->width - x->n - 1) * sizeof *b->y);
    if (status != QDOT_OK) {
        qdot_free(b->y);
        qdot_free(other);
        qdot_path_point_end(&here);
        return status;
    }
    qdot_branch_turn_back(x, b->y);
    status = qdot_branch_mark(s, b, other, &mark);
    if (status == QDOT_OK && !is_last_point(x, branch, here.y, mark))
        status = qdot_branch_add(x, branch, here.y, here.stability, mark);
    qdot_path_point_end(&here);
    return status;
}

/* The bifurcation of that kind between a and the point at `length` from it: a point of the branch.
 * beside [n + 1]: of a crossing in this step, at which a fold is none; NULL: none. */
static qdot_status
locate_bifurcation(qdot_branch_search *s, const qdot_path_point *a, double length, qdot_bifurcation_kind kind,
                   const double *beside, qdot_branch *branch)
{
    qdot_path *x = s->x;
    const size_t w = x->width;
    qdot_bifurcation b = {.kind = kind, .y = qdot_calloc(2 * w, sizeof *b.y)};
    qdot_bifurcation_bracket in = {.a = a, .to = length};
    double *guess = qdot_calloc(w, sizeof *guess), *other = qdot_calloc(x->n + 1, sizeof *other);
    qdot_bifurcation_answer answer = QDOT_BIFURCATION_NONE;
    bool nothing = false, other_curve; /* the points ahead lie on another curve, which does not cross the one being followed */
    qdot_status status = b.y && guess && other ? QDOT_OK : QDOT_ENOMEM;

    b.error = b.y + w;
    if (status == QDOT_OK)
        status = bisect_for_bifurcation(x, &in, x->halvings, &b);
    if (status == QDOT_OK) {
        memcpy(guess, b.y, w * sizeof *guess);
        status = s->find(s->user, &in, &b, other, &answer);
        if (answer == QDOT_BIFURCATION_FOUND && !(qdot_path_distance(x, guess, b.y) < length))
            answer = QDOT_BIFURCATION_NONE;
    }
    if (status == QDOT_OK && answer == QDOT_BIFURCATION_NONE && x->halvings < UNKNOWN) {
        b.kind = kind;
        in = (qdot_bifurcation_bracket){.a = a, .to = length};
        status = bisect_for_bifurcation(x, &in, UNKNOWN, &b);
        memcpy(guess, b.y, w * sizeof *guess);
    }
    s->over = kind == QDOT_HALVING                ? QDOT_END_HALF
              : answer == QDOT_BIFURCATION_REST ? QDOT_END_REST
                                                : QDOT_END_STOPPED;
    if (status == QDOT_OK && s->over == QDOT_END_REST)
        status = qdot_branch_add(x, branch, b.y, a->stability, 0);
    other_curve = kind == QDOT_PITCHFORK && in.jumps && answer == QDOT_BIFURCATION_NONE;
    s->leapt = status == QDOT_OK && kind == QDOT_PITCHFORK && length > nearest &&
               (answer == QDOT_BIFURCATION_APART || other_curve);
    if (other_curve && !s->leapt)
        s->over = QDOT_END_LOST;
    if (kind == QDOT_FOLD && answer == QDOT_BIFURCATION_NONE && in.stays)
        nothing = true; /* no fold: the curve is vertical in p there, and only rounding turned its tangent */
    if (status == QDOT_OK && kind == QDOT_FOLD && answer == QDOT_BIFURCATION_NONE && !nothing && x->dips)
        status = qdot_branch_fold_is_crossing(s, &in, &b, other, &answer, &nothing);
    if (status == QDOT_OK && x->dips && kind == QDOT_FOLD && b.kind != QDOT_FOLD && answer == QDOT_BIFURCATION_FOUND)
        status = qdot_branch_fold_beside(s, &in, &b);
    if (status == QDOT_OK && !nothing && !s->leapt && s->over != QDOT_END_REST) {
        if (answer != QDOT_BIFURCATION_FOUND) {
            b.kind = kind == QDOT_HALVING || (kind == QDOT_FOLD && in.changes) ? kind : QDOT_NOT_SIMPLE;
            b.frequency = 0;
            memcpy(b.y, guess, w * sizeof *guess);
        }
        if (beside == NULL || (x->dips && answer == QDOT_BIFURCATION_FOUND) ||
            qdot_path_distance(x, beside, b.y) >= 1e-4) {
            status = record_bifurcation(s, &b, other, branch);
            b.y = other = NULL;
        }
    }
    qdot_free(b.y);
    qdot_free(guess);
    qdot_free(other);
    return status;
}

/* Find all bifurcations between the points a and b of a curve, which are `length` apart. */
static qdot_status
find_bifurcations_between(qdot_branch_search *s, const qdot_path_point *a, const qdot_path_point *b,
                          double length, qdot_branch *branch)
{
    const size_t w = s->x->width, before = branch->n;
    const bool known = a->growing >= 0 && b->growing >= 0;
    const double *crossing = NULL;

    if (length > first_step &&
        (fabs(a->phase - b->phase) > turned || fabs(a->growth - b->growth) > grown)) {
        s->leapt = true;
        return QDOT_OK;
    }
    if (!has_no_bifurcation_between(s->x, QDOT_HALVING, a, b)) {
        s->leapt = length > first_step;
        return s->leapt ? QDOT_OK : locate_bifurcation(s, a, length, QDOT_HALVING, NULL, branch);
    }
    if (a->flip * b->flip < 0 && length > together &&
        (!has_no_bifurcation_between(s->x, QDOT_PITCHFORK, a, b) || !has_no_bifurcation_between(s->x, QDOT_FOLD, a, b))) {
        s->leapt = true; /* the step leapt over two bifurcations */
        return QDOT_OK;
    }
    if (!has_no_bifurcation_between(s->x, QDOT_PITCHFORK, a, b)) {
        QDOT_TRY(locate_bifurcation(s, a, length, QDOT_PITCHFORK, NULL, branch));
        if (s->leapt || s->over != QDOT_END_STOPPED)
            return QDOT_OK;
        if (branch->n > before)
            crossing = branch->y + before * w;
    }
    if (!has_no_bifurcation_between(s->x, QDOT_FOLD, a, b) && crossing == NULL)
        return locate_bifurcation(s, a, length, QDOT_FOLD, NULL, branch);
    if (!has_no_bifurcation_between(s->x, QDOT_FOLD, a, b)) {
        double *const at = qdot_calloc(w, sizeof *at);
        qdot_status status = at ? QDOT_OK : QDOT_ENOMEM;

        if (status == QDOT_OK) {
            memcpy(at, crossing, w * sizeof *at);
            status = locate_bifurcation(s, a, length, QDOT_FOLD, at, branch);
        }
        qdot_free(at);
        return status;
    }
    if (crossing != NULL)
        return QDOT_OK;
    if (a->flip * b->flip < 0)
        return locate_bifurcation(s, a, length, QDOT_DOUBLING, NULL, branch);
    if (known && s->x->dips && (a->growing - b->growing) % 2 != 0)
        /* nothing new: a real eigenvalue passes 0 at a nearby fold or crossing, already reported */
        return QDOT_OK;
    if (known && llabs(a->growing - b->growing) >= s->x->least_jump)
        return locate_bifurcation(s, a, length, QDOT_HOPF, NULL, branch);
    return QDOT_OK;
}

/* --- steps along a branch ----------------------------------------------------------------- */

/* The index of the unknown (n for p) that has passed its bound, *held being that bound; n + 1 if none has. */
static size_t
find_passed_bound(const qdot_path *x, const double *y, double *held)
{
    for (size_t i = 0; i <= x->n; i++) {
        const double lo = i < x->n ? qdot_path_end_of(x, i, false, y[x->n]) : x->least;
        const double hi = i < x->n ? qdot_path_end_of(x, i, true, y[x->n]) : x->most;

        *held = y[i] < lo ? lo : hi;
        if (!(y[i] >= lo && y[i] <= hi))
            return i;
    }
    return x->n + 1;
}

/* Move b along the curve beyond a to the point where y_i = held; *length: its distance from a. False: not found. */
static bool
find_point_at_bound(qdot_path *x, const qdot_path_point *a, size_t i, double held, qdot_path_point *b,
                    double *length)
{
    const double part = (held - a->y[i]) / (b->y[i] - a->y[i]);
    double far = *length;

    for (size_t k = 0; k <= x->n; k++)
        b->y[k] = a->y[k] + part * (b->y[k] - a->y[k]);
    b->y[i] = held;
    if (!qdot_path_hold(x, i, b->y))
        return false;
    *length = qdot_path_distance(x, a->y, b->y);
    return *length <= 1.01 * far && qdot_path_tangent(x, a->t, b) &&
           qdot_path_product(x, a->t, b->t) > straight;
}

/* Put b at the last place within all ends, which move with p, on the way of this length from a; *length. False:
 * not found. */
static bool
find_end_by_bisection(qdot_path *x, const qdot_path_point *a, qdot_path_point *b, double *length)
{
    double inside = 0, outside = *length, held;
    int steps;

    for (int k = 0; k < HALVINGS; k++) {
        const double middle = inside + (outside - inside) / 2;

        if (!qdot_path_go(x, a, middle, b, &steps))
            return false;
        *(find_passed_bound(x, b->y, &held) > x->n ? &inside : &outside) = middle;
    }
    if (!(inside > 0) || !qdot_path_go(x, a, inside, b, &steps))
        return false;
    *length = qdot_path_distance(x, a->y, b->y);
    return qdot_path_product(x, a->t, b->t) > straight;
}

/* One step from a to b, of a length that it adapts, at most `most`; *last: nothing lies behind b, or
 * behind a if *length is 0. */
static void
make_step(qdot_path *x, const qdot_path_point *a, double most, double *step, qdot_path_point *b,
          double *length, qdot_branch_end *why, bool *last)
{
    *why = QDOT_END_LOST;
    for (*step = fmin(*step, most); *step > x->shortest && x->failure == QDOT_OK;
         *step /= 2) {
        int steps;
        double held;
        size_t i;

        *length = *step;
        x->reason[0] = '\0';
        if (!qdot_path_go(x, a, *step, b, &steps) ||
            qdot_path_product(x, a->t, b->t) < straight ||
            qdot_path_distance(x, a->y, b->y) > longer * *step) {
            if (steps > 1) /* F was defined at the next points of the curve, so the curve does not end for an undefined F */
                x->reason[0] = '\0';
            continue;
        }
        i = find_passed_bound(x, b->y, &held);
        if (i > x->n) {
            *step *= steps <= 4 ? 1.5 : 1;
            *last = false;
            return;
        }
        *why = i == x->n ? QDOT_END_RANGE : QDOT_END_DOMAIN;
        *last = true;
        if (x->end != NULL && i < x->n ? find_end_by_bisection(x, a, b, length) : find_point_at_bound(x, a, i, held, b, length))
            return;
    }
    *length = 0;
    *last = true;
}

/* The scaled distance of two places a and b; angles are not reduced modulo full turns. */
static double
unreduced_distance(const qdot_path *x, const double *a, const double *b)
{
    double sum = 0;

    for (size_t i = 0; i < x->n; i++)
        sum += x->weight[i] * (a[i] - b[i]) * (a[i] - b[i]);
    return sqrt(sum);
}

/* Whether the curve has returned to its start in the same direction; if so b is set to the start. */
static bool
is_closed(const qdot_path *x, const qdot_path_point *start, const qdot_path_point *a,
          qdot_path_point *b)
{
    const double apart = qdot_path_distance(x, start->y, b->y),
                 step = qdot_path_distance(x, a->y, b->y);

    if (apart > step || qdot_path_product(x, start->t, b->t) < 0.9)
        return false;
    for (size_t i = 0; i <= x->n; i++)
        b->y[i] = start->y[i] + (i < x->n && x->angle[i]
                                     ? 2 * M_PI * round((b->y[i] - start->y[i]) / (2 * M_PI))
                                     : 0);
    return true;
}

/* Judge the stability of b and find bifurcations between a and b; notes if the user has interrupted. */
static qdot_status
examine_step(qdot_branch_search *s, const qdot_path_point *a, qdot_path_point *b, double length,
             qdot_branch *branch)
{
    qdot_status status = qdot_interrupt_check();

    s->over = QDOT_END_STOPPED;
    if (status == QDOT_OK)
        status = s->x->judge(s->x, b);
    if (status == QDOT_OK && !b->blurred)
        status = find_bifurcations_between(s, a, b, length, branch);
    s->all->interrupted = status == QDOT_EINTR;
    return status == QDOT_EINTR ? QDOT_OK : status;
}

/* Inspect the step from a to b (length 0: no step could be made); *ends: the branch ends with it. */
static qdot_status
check_for_end(qdot_branch_search *s, const qdot_path_point *a, qdot_path_point *b, double length,
              qdot_branch *branch, bool *ends)
{
    *ends = true;
    if (s->x->failure == QDOT_EINTR) {
        s->all->interrupted = true;
        branch->end[1] = QDOT_END_STOPPED;
        return QDOT_OK;
    }
    QDOT_TRY(s->x->failure);
    if (length == 0) {
        memcpy(branch->reason[1], s->x->reason, sizeof s->x->reason);
        return QDOT_OK;
    }
    QDOT_TRY(examine_step(s, a, b, length, branch));
    if (s->all->interrupted)
        branch->end[1] = QDOT_END_STOPPED;
    else if (b->blurred)
        branch->end[1] = QDOT_END_BLURRED;
    else if (s->over != QDOT_END_STOPPED)
        branch->end[1] = s->over;
    else
        *ends = false;
    return QDOT_OK;
}

/* Look whether something dips to 0 between the latest points; *again: a, `gone` and the branch are
 * those of an earlier point, from which the way is gone by shorter steps. */
static qdot_status
check_for_dips(qdot_branch_search *s, qdot_dips *d, const qdot_path_point *b, double length,
               qdot_path_point *a, double *gone, qdot_branch *branch, bool *again)
{
    size_t place;
    bool both;

    *again = false;
    switch (qdot_dips_look(s->x, d, b, *gone + length, &place)) {
    case QDOT_DIPS_AGAIN:
        *again = true;
        qdot_path_point_copy(s->x, &d->at[0], a);
        *gone = d->gone[0];
        branch->n = d->count[0];
        d->n = 1;
        return QDOT_OK;
    case QDOT_DIPS_ZERO:
        QDOT_TRY(qdot_branch_mark_pair(s, d, place, *gone + length - d->gone[0], branch, &both));
        return both ? QDOT_OK : qdot_branch_mark_zero(s, d, place, *gone + length - d->gone[0], branch);
    default:
        return QDOT_OK;
    }
}

/* Follow the branch from `start` to its end; a and b are work space for points. */
static qdot_status
follow_branch(qdot_branch_search *s, const qdot_path_point *start, qdot_path_point *a, qdot_path_point *b,
              qdot_dips *d, qdot_branch *branch)
{
    qdot_path *x = s->x;
    double step = first_step, length, gone = 0, far = 0;
    const size_t most = s->most_points > 0 ? s->most_points : MOST_POINTS;
    bool last = false;

    branch->end[1] = QDOT_END_STOPPED;
    qdot_dips_add(x, d, a, 0, branch->n);
    while (!last && branch->n < most) {
        const size_t before = branch->n;
        bool again = false, ends;

        make_step(x, a, fmin(fmin(x->longest * fmax(1, far), d->careful), qdot_branch_longest_near(s, a->y)), &step, b,
                  &length, &branch->end[1], &last);
        QDOT_TRY(check_for_end(s, a, b, length, branch, &ends));
        if (ends)
            return QDOT_OK;
        if (s->leapt) {
            step = length / 2;
            last = s->leapt = false;
            continue;
        }
        if (branch->n > before)
            qdot_dips_forget(d);
        else if (x->dips)
            QDOT_TRY(check_for_dips(s, d, b, length, a, &gone, branch, &again));
        if (again) {
            step = d->careful;
            last = false;
            continue;
        }
        if (gone > 3 * length && is_closed(x, start, a, b)) {
            branch->end[1] = QDOT_END_CLOSED;
            return qdot_branch_add(x, branch, b->y, start->stability, 0);
        }
        QDOT_TRY(qdot_branch_add(x, branch, b->y, b->stability, 0));
        gone += length;
        qdot_dips_add(x, d, b, gone, branch->n);
        far = unreduced_distance(x, start->y, b->y);
        if (b->rests || (!last && far > far_away)) {
            branch->end[1] = b->rests ? QDOT_END_REST : QDOT_END_FAR;
            return QDOT_OK;
        }
        qdot_path_point_copy(x, b, a);
        if (!last)
            branch->end[1] = QDOT_END_STOPPED;
    }
    return QDOT_OK;
}

qdot_status
qdot_branch_follow(qdot_branch_search *s, const qdot_path_point *start, qdot_branch *branch)
{
    qdot_path_point a = {0}, b = {0};
    qdot_dips dips = {0};
    qdot_status status = qdot_path_point_begin(s->x, &a);

    if (status == QDOT_OK)
        status = qdot_path_point_begin(s->x, &b);
    if (status == QDOT_OK)
        status = qdot_dips_begin(s->x, &dips);
    if (status == QDOT_OK) {
        qdot_path_point_copy(s->x, start, &a);
        status = follow_branch(s, start, &a, &b, &dips, branch);
    }
    qdot_dips_end(&dips);
    qdot_path_point_end(&a);
    qdot_path_point_end(&b);
    return status;
}
