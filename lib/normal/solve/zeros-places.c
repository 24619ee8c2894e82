/* zeros-places.c -- decides whether a zero that is proved counts: inside its ranges, defined, and not listed before. */
#include <float.h>
#include <math.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/walk.h"
#include "normal/refute/ball.h"
#include "normal/solve/zeros-task.h"

enum { MOST = QDOT_ZEROS_MOST_UNKNOWNS, BITS = 128 };

/* --- the zero of a system ------------------------------------------------------------------------------ */

static double
distance(const qdot_zeros_task *t, size_t j, double a, double b)
{
    double d = a - b;

    return fabs(t->range[j].turn ? d - 2 * M_PI * round(d / (2 * M_PI)) : d);
}

static bool
zeros_overlap(const qdot_zeros_task *t, const qdot_zero_place *a, const qdot_zero_place *b)
{
    for (size_t j = 0; j < t->n; j++)
        if (distance(t, j, a->at[j], b->at[j]) >
            a->radius[j] + b->radius[j] + (t->range[j].turn ? 4e-15 : 0))
            return false;
    return true;
}

/* Whether the zero b, with its error radius, lies in the box in which a is the only zero of its system. */
static bool
lies_in_uniqueness_box_of(const qdot_zeros_task *t, const qdot_zero_place *a,
                          const qdot_zero_place *b)
{
    for (size_t j = 0; j < t->n; j++) {
        double reach = fmin(a->alone[j].hi - a->at[j], a->at[j] - a->alone[j].lo);

        if (distance(t, j, a->at[j], b->at[j]) + b->radius[j] +
                (t->range[j].turn ? 4e-15 : 0) >
            reach)
            return false;
    }
    return true;
}

qdot_status
qdot_zeros_exact_place(const qdot_zeros_task *t, const qdot_expr *f,
                       const qdot_zero_place *p, qdot_expr *value, bool *found)
{
    *found = false;
    for (unsigned choice = 0; choice < 1u << t->n && !*found; choice++) {
        bool all = true;

        for (size_t j = 0; j < t->n && all; j++) {
            double more = p->radius[j] + 4 * DBL_EPSILON * fabs(p->at[j]);

            value[j] = qdot_zeros_candidate(
                t->pool, (qdot_interval){p->at[j] - more, p->at[j] + more},
                choice >> j & 1);
            all = value[j] != QDOT_NIL;
        }
        QDOT_TRY(qdot_pool_check(t->pool));
        if (all)
            QDOT_TRY(qdot_zeros_vanish(t->pool, t->n, f, t->n, t->x, value, found));
    }
    return QDOT_OK;
}

static qdot_status
append_undecided_box(qdot_zeros_task *t, const qdot_zero_place *p)
{
    qdot_zero_box box;

    for (size_t j = 0; j < t->n; j++)
        box.at[j] = (qdot_interval){p->at[j] - p->radius[j], p->at[j] + p->radius[j]};
    return qdot_vec_push(&t->doubt, box);
}

typedef struct {
    const qdot_zeros_task *t;
    const qdot_zero_place *p;
} point;

static bool
value_of_unknown_at_zero(void *user, qdot_expr atom, arb_t value, slong prec)
{
    const point *at = user;
    size_t j = qdot_expr_place(at->t->n, at->t->x, atom);

    (void)prec;
    if (j == at->t->n)
        return false;
    arb_set_d(value, at->p->at[j]);
    mag_set_d(arb_radref(value), at->p->radius[j]);
    return true;
}

/* Whether every function F of the problem is defined at the zero p of one system of its factors. */
static qdot_status
functions_are_defined(qdot_zeros_task *t, const qdot_expr *f, const qdot_zero_place *p,
                      bool *defined, bool *known)
{
    point at = {t, p};
    qdot_expr value[MOST];
    qdot_ball ball;
    bool exact;

    QDOT_TRY(qdot_ball_begin(&ball, t->pool, t->n, t->F));
    qdot_ball_eval(&ball, BITS, value_of_unknown_at_zero, &at);
    *defined = *known = true;
    for (size_t i = 0; i < t->n; i++)
        *defined &= qdot_ball_get(&ball, t->F[i]) != NULL;
    qdot_ball_end(&ball);
    if (*defined)
        return QDOT_OK;
    QDOT_TRY(qdot_zeros_exact_place(t, f, p, value, &exact));
    *known = exact;
    *defined = exact;
    for (size_t i = 0; i < t->n && *defined; i++) {
        qdot_expr e = qdot_subs(t->pool, t->F[i], t->n, t->x, value);
        qdot_status status = qdot_pool_check(t->pool);

        if (status != QDOT_EDOMAIN)
            QDOT_TRY(status);
        *defined = status == QDOT_OK &&
                   (e == QDOT_ZERO || !isinf(qdot_ball_bounds(t->pool, e).hi));
    }
    return QDOT_OK;
}

/* --- zeros near the ends of ranges ----------------------------------------------------------------------- */

typedef enum { INSIDE, OUTSIDE, AT_END, NOT_KNOWN } side;

/* Whether the zero p of f lies on the face x_j = end: an equation vanishes on all of it and the others
 * have a zero there that is p. */
static qdot_status
lies_on_face(qdot_zeros_task *t, const qdot_expr *f, const qdot_zero_place *p, size_t j,
             qdot_expr end, bool *yes)
{
    qdot_expr left[MOST], x[MOST];
    double at[MOST];
    size_t m = 0, k = 0;
    qdot_zeros_system s;
    qdot_zero_place found;
    qdot_status status;

    *yes = false;
    for (size_t i = 0; i < t->n; i++) {
        bool zero;

        QDOT_TRY(qdot_zeros_vanish(t->pool, 1, &f[i], 1, &t->x[j], &end, &zero));
        if (zero)
            continue;
        left[m] = qdot_subs(t->pool, f[i], 1, &t->x[j], &end);
        QDOT_TRY(qdot_pool_check(t->pool));
        m++;
    }
    if (m + 1 != t->n)
        return QDOT_OK;
    if (m == 0) {
        *yes = true;
        return QDOT_OK;
    }
    for (size_t i = 0; i < t->n; i++)
        if (i != j) {
            x[k] = t->x[i];
            at[k++] = p->at[i];
        }
    status = qdot_zeros_system_begin(&s, t->pool, m, left, x);
    if (status == QDOT_OK && qdot_zeros_prove(&s, at, &found)) {
        *yes = true;
        for (size_t i = 0; i < m; i++) {
            const qdot_interval *a = &p->alone[i + (i >= j)];

            *yes &= found.at[i] - found.radius[i] >= a->lo &&
                    found.at[i] + found.radius[i] <= a->hi;
        }
    }
    if (status == QDOT_OK)
        qdot_zeros_system_end(&s);
    return status;
}

/* Find on which side of the end the zero p lies, if it is the only one of one unknown, from signs
 * of f there and of f'. */
static qdot_status
find_side_by_sign(qdot_zeros_task *t, const qdot_expr *f, const qdot_zero_place *p,
                  qdot_expr end, bool upper, side *where)
{
    qdot_expr at_end = qdot_subs(t->pool, f[0], 1, t->x, &end);
    qdot_enclosure *bounds;
    qdot_interval y, slope;

    QDOT_TRY(qdot_pool_check(t->pool));
    y = qdot_ball_bounds(t->pool, at_end);
    QDOT_TRY(qdot_enclosure_new(t->pool, 1, f, 1, t->x, &bounds));
    qdot_enclosure_eval(bounds, p->alone, true);
    slope = qdot_enclosure_get(bounds, 0)->slope[0];
    qdot_enclosure_free(bounds);
    if ((y.lo <= 0 && y.hi >= 0) || (slope.lo <= 0 && slope.hi >= 0))
        return QDOT_OK;
    *where = ((y.lo > 0) == (slope.lo > 0)) == upper ? INSIDE : OUTSIDE;
    return QDOT_OK;
}

/* Find on which side of a bound of the unknown x_j the zero p of f lies. */
static qdot_status
find_side(qdot_zeros_task *t, const qdot_expr *f, const qdot_zero_place *p, size_t j,
          bool upper, side *where)
{
    qdot_expr end = upper ? t->range[j].hi : t->range[j].lo, value[MOST];
    qdot_interval e = upper ? t->hi[j] : t->lo[j];
    double lo = p->at[j] - p->radius[j], hi = p->at[j] + p->radius[j];
    bool yes;

    *where = INSIDE;
    if (end == QDOT_NIL || t->range[j].turn || (upper ? hi < e.lo : lo > e.hi))
        return QDOT_OK;
    *where = OUTSIDE;
    if (upper ? lo > e.hi : hi < e.lo)
        return QDOT_OK;
    *where = NOT_KNOWN;
    if (e.lo < p->alone[j].lo || e.hi > p->alone[j].hi)
        return QDOT_OK;
    QDOT_TRY(lies_on_face(t, f, p, j, end, &yes));
    if (!yes && t->n == 1)
        return find_side_by_sign(t, f, p, end, upper, where);
    if (!yes) {
        QDOT_TRY(qdot_zeros_exact_place(t, f, p, value, &yes));
        yes = yes &&
              qdot_ball_bounds(t->pool, qdot_sub(t->pool, value[j], end)).lo == 0 &&
              value[j] == end;
    }
    if (yes)
        *where = AT_END;
    return QDOT_OK;
}

/* Whether the zero p lies within the ranges of all unknowns: INSIDE, OUTSIDE or NOT_KNOWN. */
static qdot_status
locate_zero_in_ranges(qdot_zeros_task *t, const qdot_expr *f, qdot_zero_place *p, side *where)
{
    bool unknown = false;

    for (size_t j = 0; j < t->n; j++) {
        if (t->range[j].turn) { /* an angle: shift x into -pi < x <= pi */
            double turns = ceil((p->at[j] - p->radius[j] - M_PI) / (2 * M_PI) - 1e-15);

            p->at[j] -= 2 * M_PI * turns;
            p->alone[j].lo -= 2 * M_PI * turns;
            p->alone[j].hi -= 2 * M_PI * turns;
            if (turns != 0)
                p->radius[j] += 1e-15;
            continue;
        }
        for (int upper = 0; upper < 2; upper++) {
            bool open = upper ? t->range[j].hi_open : t->range[j].lo_open;

            QDOT_TRY(find_side(t, f, p, j, upper, where));
            if (*where == OUTSIDE || (*where == AT_END && open)) {
                *where = OUTSIDE;
                return QDOT_OK;
            }
            unknown |= *where == NOT_KNOWN;
        }
    }
    *where = unknown ? NOT_KNOWN : INSIDE;
    return QDOT_OK;
}

qdot_status
qdot_zeros_add(qdot_zeros_task *t, size_t system, qdot_zero_place p, bool again)
{
    const qdot_expr *f = t->f[system];
    bool defined, known;
    side where;

    QDOT_TRY(locate_zero_in_ranges(t, f, &p, &where));
    if (where == OUTSIDE)
        return QDOT_OK;
    QDOT_TRY(functions_are_defined(t, f, &p, &defined, &known));
    if (!known || (defined && where == NOT_KNOWN))
        return append_undecided_box(t, &p);
    if (!defined)
        return QDOT_OK;
    for (size_t k = 0; k < t->found.n; k++) {
        qdot_zeros_member *m = &t->found.at[k];
        qdot_expr value[MOST];
        bool same;

        if (!zeros_overlap(t, &m->place, &p))
            continue;
        if (m->system == system) {
            bool turns = false;

            for (size_t j = 0; j < t->n; j++)
                turns |= t->range[j].turn;
            if (!again && !turns)
                continue;
            if (lies_in_uniqueness_box_of(t, &m->place, &p) || lies_in_uniqueness_box_of(t, &p, &m->place))
                return QDOT_OK;
            return append_undecided_box(t, &p);
        }
        QDOT_TRY(qdot_zeros_exact_place(t, f, &p, value, &same));
        if (same)
            QDOT_TRY(qdot_zeros_vanish(t->pool, t->n, t->f[m->system], t->n, t->x, value,
                                       &same));
        m->place.simple = false;
        return same ? QDOT_OK : append_undecided_box(t, &p);
    }
    return qdot_vec_push(&t->found, ((qdot_zeros_member){p, system}));
}
