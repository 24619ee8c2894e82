/* zeros-box.c -- excludes boxes, proves that they contain one zero, or halves them. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "normal/solve/zeros-parts.h"

enum { MOST = QDOT_ZEROS_MOST_UNKNOWNS, ROUNDS = 8, NEWTON = 12, INTERRUPT = 64 };

/* The width, relative to the unknown, below which a box is not halved further. */
static const double narrow = 1e-13;

typedef enum { DONE, SPLIT, DOUBT } verdict;

qdot_status
qdot_zeros_system_begin(qdot_zeros_system *s, qdot_pool *pool, size_t n,
                        const qdot_expr *f, const qdot_expr *x)
{
    *s = (qdot_zeros_system){.pool = pool, .n = n, .f = f, .x = x, .least = 1e-30};
    QDOT_TRY(qdot_isolate_begin(&s->isolate, pool, n, f, x));
    qdot_status status = qdot_enclosure_new(pool, n, f, n, x, &s->bounds);
    if (status != QDOT_OK) {
        qdot_isolate_end(&s->isolate);
        s->bounds = NULL;
    }
    return status;
}

void
qdot_zeros_system_end(qdot_zeros_system *s)
{
    if (s->bounds != NULL)
        qdot_isolate_end(&s->isolate);
    qdot_enclosure_free(s->bounds);
    qdot_enclosure_free(s->also);
    qdot_free(s->todo.at);
    qdot_free(s->small.at);
    qdot_free(s->doubt.at);
    qdot_free(s->found.at);
    *s = (qdot_zeros_system){0};
}

/* --- f and its slopes ------------------------------------------------------------------------- */

/* Enclosures of f over a box. */
typedef struct {
    qdot_interval y[MOST], slope[MOST][MOST];
    bool nowhere, zero_free; /* f is undefined in the whole box; f is proved to have no zero in the box */
    bool smooth;             /* f is continuous with bounded derivatives in the box */
} image;

static void
evaluate_over_box(qdot_zeros_system *s, const qdot_interval *X, image *to)
{
    size_t n = s->n;

    s->evaluations++;
    qdot_enclosure_eval(s->bounds, X, true);
    to->nowhere = to->zero_free = false;
    to->smooth = true;
    for (size_t i = 0; i < n; i++) {
        const qdot_enclosure_value *v = qdot_enclosure_get(s->bounds, i);

        to->nowhere |= v->state == QDOT_ENCLOSURE_NOWHERE;
        to->zero_free |= v->y.lo > 0 || v->y.hi < 0;
        to->smooth &= v->state == QDOT_ENCLOSURE_WHOLE;
        to->y[i] = v->y;
        for (size_t j = 0; j < n; j++) {
            to->slope[i][j] = v->slope[j];
            to->smooth &= isfinite(v->slope[j].lo) && isfinite(v->slope[j].hi);
        }
    }
}

/* Whether one of the additional expressions has no zero in the box. */
static bool
others_exclude_box(qdot_zeros_system *s, const qdot_interval *X)
{
    if (s->also == NULL)
        return false;
    qdot_enclosure_eval(s->also, X, false);
    for (size_t i = 0; i < s->others; i++) {
        const qdot_enclosure_value *v = qdot_enclosure_get(s->also, i);

        if (v->state == QDOT_ENCLOSURE_NOWHERE || v->y.lo > 0 || v->y.hi < 0)
            return true;
    }
    return false;
}

static double
interval_width(qdot_interval a)
{
    return a.hi - a.lo;
}

static double
interval_midpoint(qdot_interval a)
{
    double m = 0.5 * a.lo + 0.5 * a.hi;

    return fmin(fmax(m, a.lo), a.hi);
}

static qdot_interval
subtract_number(qdot_interval a, double b)
{
    return qdot_interval_sum(a, qdot_interval_point(-b));
}

/* C = A^-1 by Gauss-Jordan elimination; A is destroyed; false if it is singular. */
static bool
invert(size_t n, double A[MOST][MOST], double C[MOST][MOST])
{
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            C[i][j] = i == j;
    for (size_t c = 0; c < n; c++) {
        size_t p = c;
        double pivot;

        for (size_t i = c + 1; i < n; i++)
            if (fabs(A[i][c]) > fabs(A[p][c]))
                p = i;
        pivot = A[p][c];
        if (!(fabs(pivot) > 0) || !isfinite(pivot))
            return false;
        for (size_t k = 0; k < n; k++) {
            double a = A[p][k], b = C[p][k];

            A[p][k] = A[c][k];
            C[p][k] = C[c][k];
            A[c][k] = a / pivot;
            C[c][k] = b / pivot;
        }
        for (size_t i = 0; i < n; i++) {
            double by = A[i][c];

            for (size_t k = 0; i != c && by != 0 && k < n; k++) {
                A[i][k] -= by * A[c][k];
                C[i][k] -= by * C[c][k];
            }
        }
    }
    return true;
}

/* Set C to the inverse of the matrix of the midpoints of the derivatives' enclosures. */
static bool
invert_midpoint_matrix(size_t n, const image *f, double C[MOST][MOST])
{
    double A[MOST][MOST];

    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            A[i][j] = interval_midpoint(f->slope[i][j]);
    return invert(n, A, C);
}

/* Compute R = 1 - C f'(X), where C is an approximate inverse of the Jacobian f'; returns its norm, the largest row sum. */
static double
norm_of_remainder(size_t n, double C[MOST][MOST], const image *f, qdot_interval R[MOST][MOST])
{
    double norm = 0;

    for (size_t i = 0; i < n; i++) {
        double row = 0;

        for (size_t j = 0; j < n; j++) {
            qdot_interval d = qdot_interval_point(i == j);

            for (size_t k = 0; k < n; k++)
                d = qdot_interval_sum(d,
                                      qdot_interval_product(qdot_interval_point(-C[i][k]),
                                                            f->slope[k][j], false));
            R[i][j] = d;
            row += fmax(fabs(d.lo), fabs(d.hi));
        }
        norm = fmax(norm, row * (1 + 8 * DBL_EPSILON));
    }
    return norm;
}

bool
qdot_zeros_is_regular(const qdot_enclosure *bounds, size_t n)
{
    qdot_interval R[MOST][MOST];
    double C[MOST][MOST];
    image f;

    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            f.slope[i][j] = qdot_enclosure_get(bounds, i)->slope[j];
            if (isinf(f.slope[i][j].lo) || isinf(f.slope[i][j].hi))
                return false;
        }
    return invert_midpoint_matrix(n, &f, C) && norm_of_remainder(n, C, &f, R) < 1;
}

/* Component i of Krawczyk's image K of the box X about its middle m: K - m = -C f(m) + R (X - m). */
static qdot_interval
krawczyk_component(size_t n, size_t i, double C[MOST][MOST], qdot_interval R[MOST][MOST],
                   const image *at_m, const qdot_interval *X, const double *m)
{
    qdot_interval K = qdot_interval_point(0);

    for (size_t k = 0; k < n; k++) {
        K = qdot_interval_sum(
            K, qdot_interval_product(qdot_interval_point(-C[i][k]), at_m->y[k], false));
        K = qdot_interval_sum(K,
                              qdot_interval_product(R[i][k], subtract_number(X[k], m[k]), false));
    }
    return K;
}

/* --- proof of one zero ------------------------------------------------------------------------------ */

/* Prove a zero near z by Krawczyk's test in doubles over small boxes about z; for zeros at kinks. */
static bool
prove_zero_near(qdot_zeros_system *s, const double *z, qdot_zero_place *place)
{
    size_t n = s->n;

    for (double size = 1e-14; size < 1e-5; size *= 1e2) {
        qdot_interval X[MOST], point[MOST], R[MOST][MOST];
        double C[MOST][MOST];
        image f, at_z;
        bool inside;

        for (size_t i = 0; i < n; i++) {
            double r = size * fmax(fabs(z[i]), 1e-3);

            X[i] = (qdot_interval){z[i] - r, z[i] + r};
            point[i] = qdot_interval_point(z[i]);
        }
        evaluate_over_box(s, X, &f);
        evaluate_over_box(s, point, &at_z);
        inside = f.smooth && at_z.smooth && invert_midpoint_matrix(n, &f, C) &&
                 norm_of_remainder(n, C, &f, R) < 1;
        for (size_t i = 0; i < n && inside; i++) {
            qdot_interval K = krawczyk_component(n, i, C, R, &at_z, X, z);

            inside = K.lo > X[i].lo - z[i] && K.hi < X[i].hi - z[i];
            place->radius[i] = fmax(fabs(K.lo), fabs(K.hi));
            place->alone[i] = X[i];
            place->at[i] = z[i];
        }
        if (inside)
            return true;
    }
    return false;
}

bool
qdot_zeros_prove(qdot_zeros_system *s, const double *x0, qdot_zero_place *place)
{
    size_t n = s->n;
    double z[MOST], length = INFINITY;

    place->simple = true;
    memcpy(z, x0, n * sizeof *z);
    for (int k = 0; k < NEWTON && length > 1e-15; k++) {
        qdot_interval X[MOST];
        double C[MOST][MOST];
        image f;

        for (size_t i = 0; i < n; i++)
            X[i] = qdot_interval_point(z[i]);
        evaluate_over_box(s, X, &f);
        if (!f.smooth || !invert_midpoint_matrix(n, &f, C))
            break;
        length = 0;
        for (size_t i = 0; i < n; i++) {
            double step = 0;

            for (size_t j = 0; j < n; j++)
                step -= C[i][j] * interval_midpoint(f.y[j]);
            z[i] += step;
            length = fmax(length, fabs(step) / fmax(fabs(z[i]), 1e-3));
        }
        if (!isfinite(length))
            return false;
    }
    memcpy(place->at, z, n * sizeof *z);
    s->evaluations += 8;
    if (!qdot_isolate_prove(&s->isolate, place->at, place->radius))
        return prove_zero_near(s, z, place);
    for (size_t i = 0; i < n; i++) {
        double r = s->isolate.unique[i] * (1 - DBL_EPSILON);

        place->alone[i] = (qdot_interval){place->at[i] - r, place->at[i] + r};
    }
    return true;
}

static bool
is_within(size_t n, const qdot_interval *a, const qdot_interval *b)
{
    for (size_t i = 0; i < n; i++)
        if (!(a[i].lo >= b[i].lo && a[i].hi <= b[i].hi))
            return false;
    return true;
}

static bool
lies_in_uniqueness_box(const qdot_zeros_system *s, const qdot_interval *X)
{
    for (size_t k = s->found.n; k-- > 0;)
        if (is_within(s->n, X, s->found.at[k].alone))
            return true;
    return false;
}

/* Whether all points of the box X are known to be zeros, by a range that the caller gave (qdot_zeros_range.held). */
static bool
box_has_only_zeros(const qdot_zeros_system *s, const qdot_interval *X)
{
    for (size_t k = 0; k < s->ranges; k++) {
        bool inside = true;

        qdot_enclosure_eval(s->held[k], X, false);
        for (size_t i = 0; i < qdot_enclosure_count(s->held[k]) && inside; i++) {
            const qdot_enclosure_value *v = qdot_enclosure_get(s->held[k], i);

            inside = v->state == QDOT_ENCLOSURE_WHOLE && v->y.lo > 0;
        }
        if (inside)
            return true;
    }
    return false;
}

static void
box_of_zero(size_t n, const qdot_zero_place *place, qdot_interval *to)
{
    for (size_t i = 0; i < n; i++)
        to[i] = (qdot_interval){place->at[i] - place->radius[i],
                                place->at[i] + place->radius[i]};
}

/* If the box X, which contains at most one zero, contains a known one: record X as its uniqueness box. */
static bool
contains_known_zero(qdot_zeros_system *s, const qdot_interval *X)
{
    for (size_t k = 0; k < s->found.n; k++) {
        qdot_interval z[MOST];

        box_of_zero(s->n, &s->found.at[k], z);
        if (is_within(s->n, z, X)) {
            if (is_within(s->n, s->found.at[k].alone, X))
                memcpy(s->found.at[k].alone, X, s->n * sizeof *X);
            return true;
        }
    }
    return false;
}

/* If a box slightly larger than the box X contains at most one zero: find this zero and prove it. */
static qdot_status
prove_zero_in(qdot_zeros_system *s, const qdot_interval *X, const double *m, bool *settled)
{
    size_t n = s->n;
    qdot_interval wide[MOST], R[MOST][MOST], z[MOST];
    double C[MOST][MOST];
    qdot_zero_place place;
    image f;

    *settled = false;
    for (size_t i = 0; i < n; i++) {
        double more = 0.2 * interval_width(X[i]) + 1e-14 * fmax(fabs(m[i]), 1e-3);

        wide[i] = (qdot_interval){X[i].lo - more, X[i].hi + more};
    }
    evaluate_over_box(s, wide, &f);
    if (!f.smooth || !invert_midpoint_matrix(n, &f, C) || !(norm_of_remainder(n, C, &f, R) < 1))
        return QDOT_OK;
    *settled = contains_known_zero(s, wide);
    if (*settled || !qdot_zeros_prove(s, m, &place))
        return QDOT_OK;
    box_of_zero(n, &place, z);
    if (!is_within(n, z, wide))
        return QDOT_OK;
    *settled = true;
    memcpy(place.alone, wide, n * sizeof *wide);
    return qdot_vec_push(&s->found, place);
}

/* --- deciding about one box ----------------------------------------------------------------------------- */

static bool
is_too_narrow_to_halve(const qdot_zeros_system *s, const qdot_interval *X)
{
    for (size_t i = 0; i < s->n; i++)
        if (interval_width(X[i]) > narrow * fmax(fabs(X[i].lo), fabs(X[i].hi)) + s->least)
            return false;
    return true;
}

/* Whether X is so small that rounding hides the change of an equation over it, so that halving does
 * not help. */
static bool
box_is_small(size_t n, const qdot_interval *X)
{
    for (size_t i = 0; i < n; i++)
        if (interval_width(X[i]) > 1e-5 * fmax(1, fabs(X[i].lo)))
            return false;
    return true;
}

/* Try to exclude X by f(m) + f'(X) (X - m) for each equation; *noisy: the rounding of f(m) is
 * larger than the change. */
static bool
excludes_zeros(size_t n, const image *f, const image *at_m, const qdot_interval *X,
               const double *m, bool *noisy)
{
    bool one = false;

    *noisy = true;
    for (size_t i = 0; i < n; i++) {
        qdot_interval e = at_m->y[i];

        for (size_t j = 0; j < n; j++)
            e = qdot_interval_sum(
                e, qdot_interval_product(f->slope[i][j], subtract_number(X[j], m[j]), false));
        if (e.lo > 0 || e.hi < 0)
            return true;
        if (interval_width(at_m->y[i]) > 0.25 * interval_width(e))
            one = true;
        else
            *noisy = false;
    }
    *noisy |= one && box_is_small(n, X);
    return false;
}

/* Whether rounding errors of f(m) make Krawczyk's image about as wide as the small box X, as near a multiple zero. */
static bool
rounding_hides_zero(size_t n, double C[MOST][MOST], const image *at_m,
                    const qdot_interval *X)
{
    if (!box_is_small(n, X))
        return false;
    for (size_t i = 0; i < n; i++) {
        double noise = 0;

        for (size_t k = 0; k < n; k++)
            noise += fabs(C[i][k]) * interval_width(at_m->y[k]);
        if (noise > 0.25 * interval_width(X[i]))
            return true;
    }
    return false;
}

/* The direction (index of an unknown) in which f changes most over the box X, along which X is halved. */
static size_t
widest_direction(size_t n, const image *f, const qdot_interval *X)
{
    size_t best = 0;
    double most = -1;

    for (size_t j = 0; j < n; j++) {
        double change = 0;

        for (size_t i = 0; i < n && f->smooth; i++) {
            double size = fmax(fabs(f->slope[i][j].lo), fabs(f->slope[i][j].hi)), all = 0;

            for (size_t k = 0; k < n; k++)
                all +=
                    fmax(fabs(f->slope[i][k].lo), fabs(f->slope[i][k].hi)) * interval_width(X[k]);
            change = fmax(change, all > 0 ? size * interval_width(X[j]) / all : 0);
        }
        if (!f->smooth)
            change = interval_width(X[j]) / fmax(1, fmax(fabs(X[j].lo), fabs(X[j].hi)));
        if (change > most && nextafter(X[j].lo, INFINITY) < X[j].hi) {
            most = change;
            best = j;
        }
    }
    return best;
}

/* Exclude the box X, shrink it, or find its zero. */
static qdot_status
examine_box(qdot_zeros_system *s, qdot_interval *X, image *f, verdict *how)
{
    size_t n = s->n;

    *how = DONE;
    for (int round = 0; round < ROUNDS; round++) {
        qdot_interval point[MOST], R[MOST][MOST];
        double C[MOST][MOST], m[MOST], gain = 1, norm;
        image at_m;
        bool noisy, settled;

        if (lies_in_uniqueness_box(s, X) || box_has_only_zeros(s, X))
            return QDOT_OK;
        evaluate_over_box(s, X, f);
        if (f->nowhere || f->zero_free || others_exclude_box(s, X))
            return QDOT_OK;
        *how = is_too_narrow_to_halve(s, X) ? DOUBT : SPLIT;
        if (!f->smooth)
            return QDOT_OK;
        for (size_t i = 0; i < n; i++) {
            m[i] = interval_midpoint(X[i]);
            point[i] = qdot_interval_point(m[i]);
        }
        evaluate_over_box(s, point, &at_m);
        if (excludes_zeros(n, f, &at_m, X, m, &noisy)) {
            *how = DONE;
            return QDOT_OK;
        }
        if (noisy)
            *how = DOUBT;
        if (!invert_midpoint_matrix(n, f, C))
            return QDOT_OK;
        norm = norm_of_remainder(n, C, f, R);
        if (rounding_hides_zero(n, C, &at_m, X))
            *how = DOUBT;
        if (norm < 0.9) {
            QDOT_TRY(prove_zero_in(s, X, m, &settled));
            if (settled) {
                *how = DONE;
                return QDOT_OK;
            }
        }
        for (size_t i = 0; i < n; i++) {
            qdot_interval K = krawczyk_component(n, i, C, R, &at_m, X, m), was = X[i];

            K = qdot_interval_sum(K, qdot_interval_point(m[i]));
            X[i] = (qdot_interval){fmax(K.lo, was.lo), fmin(K.hi, was.hi)};
            if (!(X[i].lo <= X[i].hi)) {
                *how = DONE;
                return QDOT_OK;
            }
            if (interval_width(was) > 0)
                gain = fmin(gain, interval_width(X[i]) / interval_width(was));
        }
        if (gain > 0.7)
            return QDOT_OK;
    }
    return QDOT_OK;
}

/* Where an interval is cut in two: near the middle, or by magnitude if it spans many orders of magnitude. */
static double
cutting_point(qdot_interval X)
{
    double lo = X.lo, hi = X.hi;

    if (lo < 0 && hi > 0) {
        if (fmin(-lo, hi) < 1e-3 * fmax(-lo, hi))
            return -lo < hi ? -lo : -hi;
    } else if (lo >= 0 && hi > 100 * lo && lo > 0) {
        return sqrt(lo) * sqrt(hi);
    } else if (hi <= 0 && -lo > 100 * -hi && hi < 0) {
        return -sqrt(-lo) * sqrt(-hi);
    }
    return lo + 0.485 * (hi - lo); /* not the middle, where zeros often lie */
}

static qdot_status
halve_box(qdot_zeros_system *s, const qdot_interval *X, size_t j)
{
    qdot_zero_box a, b;
    double at = cutting_point(X[j]);

    if (!(at > X[j].lo && at < X[j].hi))
        at = interval_midpoint(X[j]);
    memcpy(a.at, X, s->n * sizeof *X);
    b = a;
    a.at[j].hi = at;
    b.at[j].lo = at;
    QDOT_TRY(qdot_vec_push(&s->todo, b));
    return qdot_vec_push(&s->todo, a);
}

/* Whether the box X is small and therefore treated last: near multiple zeros the search takes long. */
static bool
is_treated_later(qdot_zeros_system *s, const qdot_interval *X)
{
    return s->n > 1 && !s->late && box_is_small(s->n, X);
}

/* The next box: of one unknown the one that waits longest, so that zeros which gather at a point do not keep
 * the search there. */
static bool
next_box(qdot_zeros_system *s, qdot_zero_box *box)
{
    if (s->n == 1) {
        if (s->next == s->todo.n)
            return false;
        *box = s->todo.at[s->next++];
        return true;
    }
    if (s->todo.n == 0) {
        if (s->late || s->small.n == 0)
            return false;
        qdot_free(s->todo.at);
        memcpy(&s->todo, &s->small, sizeof s->todo);
        memset(&s->small, 0, sizeof s->small);
        s->late = true;
    }
    *box = s->todo.at[--s->todo.n];
    return true;
}

qdot_status
qdot_zeros_search(qdot_zeros_system *s)
{
    for (uint64_t step = 0;; step++) {
        qdot_zero_box box;
        verdict how;
        image f;

        if (!next_box(s, &box))
            return QDOT_OK;
        if (step % INTERRUPT == 0)
            QDOT_TRY(qdot_interrupt_check());
        if (s->evaluations > s->budget || s->doubt.n >= QDOT_ZEROS_DOUBTS) {
            s->exhausted = true;
            return QDOT_OK;
        }
        QDOT_TRY(examine_box(s, box.at, &f, &how));
        if (how == SPLIT && is_treated_later(s, box.at))
            QDOT_TRY(qdot_vec_push(&s->small, box));
        else if (how == SPLIT)
            QDOT_TRY(halve_box(s, box.at, widest_direction(s->n, &f, box.at)));
        else if (how == DOUBT)
            QDOT_TRY(qdot_vec_push(&s->doubt, box));
    }
}

/* --- undecided boxes that touch ---------------------------------------------------------------------------- */

static bool
boxes_touch(size_t n, const qdot_interval *a, const qdot_interval *b)
{
    for (size_t i = 0; i < n; i++) {
        double slack = fmax(interval_width(a[i]), interval_width(b[i])) + 1e-12 * fabs(a[i].lo);

        if (a[i].lo > b[i].hi + slack || b[i].lo > a[i].hi + slack)
            return false;
    }
    return true;
}

void
qdot_zeros_join(qdot_zeros_system *s)
{
    for (size_t k = 0; k < s->doubt.n; k++)
        for (size_t l = k + 1; l < s->doubt.n;) {
            qdot_interval *a = s->doubt.at[k].at, *b = s->doubt.at[l].at;

            if (!boxes_touch(s->n, a, b)) {
                l++;
                continue;
            }
            for (size_t i = 0; i < s->n; i++)
                a[i] = qdot_interval_around(a[i], b[i]);
            s->doubt.at[l] = s->doubt.at[--s->doubt.n];
            l = k + 1; /* start again, as the larger box may touch more boxes */
        }
}
