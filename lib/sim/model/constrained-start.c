/* constrained-start.c -- decides whether a run may start at a state, and moves the start onto the
 * constraints. */
#include <math.h>
#include <string.h>

#include "num/row-space.h"
#include "sim/model/constrained-parts.h"
#include "sim/model/constrained.h"

/* A start state may violate a constraint by this much: users type rounded decimals. */
static const double start_tolerance = 1e-9;

/* How far beside a start its constraints are looked at, and what is left of a row there
 * that was dependent upon the others only at the start. */
static const double beside = 1e-3, independent = 1e-7;

/* Constraints are redundant near the start if a velocity leaves a residual smaller than this. */
static const double hidden = 1e-9;

enum { tries = 4, iterations = 12 };

/* --- a start at which constraints happen to be dependent ----------------------------- */

typedef struct {
    qdot_constrained *h;
    double t;
    double *y; /* [2n] another state near the start */
    double *A; /* [m x n] gradients of the holonomic constraints (0 for others), or of all constraints */
    double *b, *x;
    qdot_row_space rows;
} place;

/* Evaluate the constraint gradients A at p->y: of the holonomic constraints, or of all. */
static void
evaluate_gradients(place *p, bool all)
{
    const size_t n = p->h->plan->n, m = p->h->c->m;
    qdot_constrained_level *l = p->h->at[QDOT_ACCELERATION];

    qdot_constrained_load(p->h, p->t, p->y);
    qdot_constrained_metric(p->h, l);
    memcpy(p->A, l->saddle.A, m * n * sizeof *p->A);
    for (size_t k = 0; k < m && !all; k++)
        if (p->h->c->rows[k].kind != QDOT_HOLONOMIC)
            memset(p->A + k * n, 0, n * sizeof *p->A);
}

/* Find another state on the constraints near y, in a random direction; returns whether it was found. */
static bool
find_nearby_state(place *p, const double *y, int which)
{
    const size_t n = p->h->plan->n, m = p->h->c->m;
    uint64_t seed = 12345 + (uint64_t)which;
    double length = 0, size = 1, most = INFINITY;

    memcpy(p->y, y, 2 * n * sizeof *y);
    evaluate_gradients(p, false);
    qdot_row_space_factor(&p->rows, p->A, start_tolerance, false);
    for (size_t i = 0; i < n; i++) {
        seed = seed * 1103515245 + 12345;
        p->x[i] = (double)(seed >> 16 & 0x7fff) / 0x4000 - 1;
    }
    qdot_row_space_tangent(&p->rows, p->x);
    for (size_t i = 0; i < n; i++) {
        length = fmax(length, fabs(p->x[i]));
        size = fmax(size, fabs(y[i]));
    }
    for (size_t i = 0; i < n; i++)
        p->y[i] += length > 1e-6 ? beside * size * p->x[i] / length : 0;
    for (int k = 0; k < iterations; k++) {
        qdot_constrained_load(p->h, p->t, p->y);
        qdot_constrained_positions(p->h);
        most = 0;
        for (size_t r = 0; r < m; r++) {
            p->b[r] = -p->h->f[r];
            most = fmax(most, fabs(p->b[r]));
        }
        if (!(most > 1e-13 * size))
            break;
        evaluate_gradients(p, false);
        qdot_row_space_factor(&p->rows, p->A, start_tolerance, false);
        qdot_row_space_shortest(&p->rows, p->b, p->x, NULL);
        for (size_t i = 0; i < n; i++)
            p->y[i] += p->x[i];
    }
    return most < 1e-10 * size;
}

/* The constraints of which `row` is a combination at the start, and itself, into `names`; their
 * number. */
static size_t
append_dependent_constraints(place *p, const double *y, size_t row, qdot_text *names)
{
    const size_t n = p->h->plan->n, m = p->h->c->m;
    bool *in = qdot_calloc(m + 1, sizeof *in);
    double *part = qdot_calloc(m + 1, sizeof *part);
    size_t count = 1;

    if (in && part) {
        memcpy(p->y, y, 2 * n * sizeof *y);
        evaluate_gradients(p, true);
        for (size_t k = 0; k < m; k++) {
            p->b[k] = 0;
            for (size_t i = 0; i < n && k != row; i++)
                p->b[k] += p->A[k * n + i] * p->A[row * n + i];
        }
        memset(p->A + row * n, 0, n * sizeof *p->A);
        qdot_row_space_factor(&p->rows, p->A, start_tolerance, false);
        qdot_row_space_shortest(&p->rows, p->b, p->x, part);
        in[row] = true;
        for (size_t k = 0; k < m; k++)
            if (k != row && fabs(part[k]) > QDOT_CONSTRAINED_PART) {
                in[k] = true;
                count++;
            }
        qdot_constrained_name(p->h->c, in, names);
    }
    qdot_free(in);
    qdot_free(part);
    return count;
}

static qdot_status
fail_dependent_constraints(place *p, const double *y, size_t row)
{
    qdot_text names = {0};
    const size_t count = append_dependent_constraints(p, y, row, &names);

    if (qdot_text_status(&names) == QDOT_OK)
        qdot_fail(QDOT_ESINGULAR,
                  count == 1 ? "at the start %.200s has no direction, its slopes being 0 there: "
                               "what the motion is from there is not determined"
                             : "at the start %.200s depend on each other, as they do not "
                               "beside it: what the motion is from there is not determined",
                  qdot_text_str(&names));
    qdot_text_clear(&names);
    (void)qdot_hint(count == 1 ? "a start beside that place, or the condition without a square: "
                                 "`x = 0`, not `x^2 = 0`"
                               : "a start beside that place");
    return QDOT_ESINGULAR;
}

/* --- hidden conditions: constraints that follow only from several others together ------ */

/* x = t and x' = y have one direction, and the second is no repetition: y = 1. One alone that stands
 * in for nothing has none. */
static qdot_status
fail_hidden_condition(place *p, const double *y, size_t row, const char *of)
{
    qdot_text names = {0};
    const size_t count = append_dependent_constraints(p, y, row, &names);

    if (count == 1) {
        if (qdot_text_status(&names) == QDOT_OK)
            qdot_fail(QDOT_ESINGULAR,
                      "at the start %.200s has no direction: what the motion is from there is not "
                      "determined",
                      qdot_text_str(&names));
        qdot_text_clear(&names);
        (void)qdot_hint("a start beside that place");
        return QDOT_ESINGULAR;
    }
    if (qdot_text_status(&names) == QDOT_OK)
        qdot_fail(QDOT_EINVAL,
                  "%.200s together leave a condition on %s that is none of the constraints: it "
                  "holds at the start, but not beside it",
                  qdot_text_str(&names), of);
    qdot_text_clear(&names);
    (void)qdot_hint("that condition as a constraint too");
    return QDOT_EINVAL;
}

/* No position was found a little later: x = t^2 and x = t^2 + t^3 separate after the start. Names
 * rows that do not hold although the independent ones do. */
static qdot_status
check_not_separated(place *p, const double *y, double t)
{
    const size_t m = p->h->c->m;
    double met = 0, most = 0, before;
    size_t worst = 0;

    for (size_t j = 0; j < m; j++) {
        const size_t r = p->rows.order[j];

        if (j < p->rows.rank) {
            met = fmax(met, fabs(p->b[r]));
        } else if (fabs(p->b[r]) > most) {
            most = fabs(p->b[r]);
            worst = r;
        }
    }
    qdot_constrained_load(p->h, t, y);
    qdot_constrained_positions(p->h);
    before = fabs(p->h->f[worst]);
    return most > 1e-10 && most > 1e3 * (met + before) ? fail_hidden_condition(p, y, worst, "time")
                                                       : QDOT_OK;
}

/* Change the velocities at p->y so that the independent rows hold; *worst: the other row that is
 * broken most, and by how much. Returns whether there are such velocities. */
static bool
choose_nearby_velocities(place *p, size_t *worst, double *by)
{
    const size_t n = p->h->plan->n, m = p->h->c->m;
    double *v = p->y + n, size = 1, most = INFINITY;

    for (size_t i = 0; i < n; i++)
        size = fmax(size, fabs(v[i]));
    for (size_t i = 0; i < n; i++) /* irregular changes, so that they break all symmetries of the scene */
        v[i] += beside * size * sin(1.0 + 7.0 * (double)i);
    for (int k = 0; k < iterations && most > 1e-12 * size; k++) {
        qdot_constrained_load(p->h, p->t, p->y);
        qdot_constrained_velocities(p->h);
        for (size_t r = 0; r < m; r++)
            p->b[r] = -p->h->w[r];
        evaluate_gradients(p, true);
        for (size_t r = 0; r < m; r++)
            if (p->h->c->rows[r].kind == QDOT_ACCELERATION)
                memset(p->A + r * n, 0, n * sizeof *p->A);
        qdot_row_space_factor(&p->rows, p->A, independent, false);
        most = *by = 0;
        for (size_t j = 0; j < m; j++) {
            const size_t r = p->rows.order[j];

            if (j < p->rows.rank) {
                most = fmax(most, fabs(p->b[r]));
            } else if (fabs(p->b[r]) > *by) {
                *by = fabs(p->b[r]);
                *worst = r;
            }
        }
        qdot_row_space_shortest(&p->rows, p->b, p->x, NULL);
        for (size_t i = 0; i < n; i++)
            v[i] += p->x[i];
    }
    *by /= size;
    return most < 1e-9 * size;
}

/* Check for a hidden condition implied by the constraints, at a state near the start, or if `later` just after it. */
static qdot_status
check_hidden_condition(place *p, const double *y, bool later)
{
    size_t worst = 0;
    double by = 0;

    if (!choose_nearby_velocities(p, &worst, &by))
        return QDOT_OK;
    if (by > hidden)
        return fail_hidden_condition(p, y, worst, later ? "time" : "positions");
    if (qdot_constrained_solve(p->h, p->t, p->y, p->h->a, NULL) != QDOT_OK ||
        qdot_constrained_check_repeated(p->h, QDOT_EINVAL) == QDOT_OK)
        return QDOT_OK;
    worst = qdot_constrained_contradicting(p->h);
    return fail_hidden_condition(p, y, worst,
                                 later                                              ? "time"
                                 : p->h->c->rows[worst].kind == QDOT_ACCELERATION ? "positions or velocities"
                                                                          : "velocities");
}

/* Rows that are redundant at the start must be so near it, too: else the rank, which is kept,
 * would hold at the start only. */
static qdot_status
check_start_independence(qdot_constrained *h, double t, const double *y)
{
    const size_t n = h->plan->n, m = h->c->m;
    const qdot_saddle *s = &h->at[QDOT_ACCELERATION]->saddle;
    const size_t rank = s->rank, repeated = rank < m ? s->pivot[rank] : 0;
    place p = {.h = h, .t = t};
    bool holds;
    qdot_status status;

    if (rank == m)
        return QDOT_OK;
    /* false if constraints contradict each other already at the start */
    holds = qdot_constrained_contradicting(h) == SIZE_MAX;
    p.y = qdot_calloc(3 * n + m * n + m, sizeof *p.y);
    if (!p.y)
        return QDOT_ENOMEM;
    p.x = p.y + 2 * n;
    p.A = p.x + n;
    p.b = p.A + m * n;
    status = qdot_row_space_init(&p.rows, m, n);
    for (int k = 0; k < tries && status == QDOT_OK; k++) {
        const bool later = k + 1 == tries; /* the last try is at a slightly later time */

        p.t = later ? t + beside : t;
        if (!find_nearby_state(&p, y, k)) {
            if (later && holds)
                status = check_not_separated(&p, y, t);
            continue;
        }
        evaluate_gradients(&p, true);
        qdot_row_space_factor(&p.rows, p.A, independent, false);
        if (p.rows.rank <= rank && holds)
            status = check_hidden_condition(&p, y, later);
        else if (p.rows.rank > rank && !later)
            status = fail_dependent_constraints(&p, y, repeated);
    }
    p.t = t;
    if (status == QDOT_OK) { /* restore the state at which the tapes are evaluated */
        memcpy(p.y, y, 2 * n * sizeof *y);
        evaluate_gradients(&p, true);
        status = qdot_constrained_solve(h, t, y, h->a, NULL);
    }
    qdot_row_space_clear(&p.rows);
    qdot_free(p.y);
    return status;
}

/* --- checking a start --------------------------------------------------------------- */

static qdot_status
fail_violated_at_start(const qdot_constrained *h, size_t row, double residual, const char *what)
{
    qdot_fail(QDOT_EINVAL, "the start breaks the %s%s: %s is %.3g, not 0",
              h->c->rows[row].multiplier == QDOT_NIL ? "" : "constraint ", h->c->rows[row].name, what, residual);
    return qdot_hint("start values that fulfil it");
}

qdot_status
qdot_constrained_start(qdot_constrained *h, double t, double *y, double *low)
{
    const size_t n = h->plan->n;
    qdot_constrained_level *l = h->at[QDOT_HOLONOMIC];
    double moved;

    qdot_constrained_load(h, t, y);
    qdot_constrained_residuals(h);
    for (size_t k = 0; k < h->c->m; k++)
        if (!(fabs(h->f[k]) <= start_tolerance))
            return fail_violated_at_start(h, k, h->f[k], "left - right");
    for (size_t k = 0; k < h->c->m; k++)
        if (!(fabs(h->w[k]) <= start_tolerance))
            return fail_violated_at_start(h, k, h->w[k],
                                          h->c->rows[k].kind == QDOT_HOLONOMIC
                              ? "the time derivative of left - right"
                              : "left - right");
    /* first set the bounds by which residuals are judged */
    if (l->m > 0) {
        QDOT_TRY(qdot_constrained_factor_metric(h, l));
        qdot_constrained_raise_bounds(l, y, h->f_bound);
    }
    l = h->at[QDOT_VELOCITY];
    if (l->m > 0) {
        QDOT_TRY(qdot_constrained_factor_metric(h, l));
        qdot_constrained_raise_bounds(l, y + n, h->w_bound);
    }
    QDOT_TRY(qdot_constrained_project(t, y, low, &moved, h));
    QDOT_TRY(qdot_constrained_solve(h, t, y, h->a, NULL));
    QDOT_TRY(check_start_independence(h, t, y));
    return qdot_constrained_check_repeated(h, QDOT_EINVAL);
}
