/* constrained-put.c -- moves a state onto the constraints after an event has set some of its values. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "series/two.h"
#include "sim/model/constrained-parts.h"
#include "sim/model/constrained.h"

enum { most_iterations = 30 };

/* Smaller components count as this large when rounding errors are estimated. */
static const double least_size = 0x1p-10;

/* The variables q or q' of a state, their constraint rows, and the system with a further row for
 * each value set. */
typedef struct {
    const qdot_constrained_level *level;
    double *x, *low; /* [n] the values are the sums x + low; low NULL: 0 */
    const bool *set; /* [n] which values the event has set */
    const double *residual;
    const qdot_tape *tape; /* tape whose outputs are the residuals of this level's constraints */
    void (*find)(qdot_constrained *h);
    qdot_saddle saddle;
} part;

/* The state y + low at time t + t_low, to be moved onto the constraints; who: the event that set values. */
typedef struct {
    double t, t_low;
    const double *y, *low; /* [2n] state y + low; low NULL: 0 */
    const char *who;
} place;

/* Fill the system: M and A at the loaded state, a unit row for each value that was set; right-hand
 * side -f and zeros. */
static void
evaluate_level(qdot_constrained *h, part *p)
{
    const qdot_constraints *c = h->c;
    const size_t n = h->plan->n;
    qdot_saddle *s = &p->saddle;
    const double *out = h->out;
    size_t at = 0, held = p->level->m;

    qdot_tape_eval(qdot_constrained_tape(h->metric, c->metric), h->in, h->out, h->work);
    for (size_t k = 0; k < c->n_masses; k++, out++)
        s->M[c->masses[k].row * n + c->masses[k].column] =
            s->M[c->masses[k].column * n + c->masses[k].row] = *out;
    for (size_t k = 0; k < c->n_slopes; k++, out++) {
        while (at < p->level->m && p->level->row[at] < c->slopes[k].row)
            at++;
        if (at < p->level->m && p->level->row[at] == c->slopes[k].row)
            s->A[at * n + c->slopes[k].column] = *out;
    }
    for (size_t i = 0; i < n; i++)
        if (p->set[i])
            s->A[held++ * n + i] = 1;
    memset(s->x, 0, (n + s->m) * sizeof *s->x);
    for (size_t k = 0; k < p->level->m; k++)
        s->x[n + k] = -p->residual[p->level->row[k]];
}

/* What the terms of row k may be near the state: slopes and values of it, each at its largest. (The
 * slopes at a located event are uncertain by the rounding of its time.) */
static double
residual_rounding(const qdot_constrained *h, const part *p, size_t k)
{
    const qdot_constraints *c = h->c;
    double slope = 0, value = 0;

    for (size_t i = 0; i < c->n_slopes; i++)
        if (c->slopes[i].row == p->level->row[k]) {
            slope = fmax(slope, fabs(p->saddle.A[k * h->plan->n + c->slopes[i].column]));
            value = fmax(value, fabs(p->x[c->slopes[i].column]));
        }
    return slope * value;
}

/* Find the largest ratio of a residual to its rounding error, and for which constraint it occurs. */
static double
find_worst_residual(const qdot_constrained *h, const part *p, size_t *worst)
{
    double most = 0;

    for (size_t k = 0; k < p->level->m; k++) {
        const double size = fmax(qdot_saddle_row_size(&p->saddle, k, p->x, least_size),
                                 residual_rounding(h, p, k));
        const double now = fabs(p->residual[p->level->row[k]]) / (DBL_EPSILON * size);

        if (!(now <= most)) {
            most = now;
            *worst = p->level->row[k];
        }
    }
    return most;
}

static qdot_status
fail_violated_by_event(const qdot_constrained *h, size_t row, const char *who)
{
    return qdot_fail(QDOT_EDOMAIN,
                     "the event %.100s sets values that constraint %.200s does not allow",
                     who, h->c->rows[row].name);
}

/* Add to noise [m] the change of the residuals r [m] if component k of the state, or t, changes by
 * 4 rounding errors. */
static void
add_rounding_of_state(qdot_constrained *h, const part *p, const place *at, double *y, size_t k, const double *r, double *noise)
{
    const size_t n = h->plan->n;
    const double more = 1 + 4 * DBL_EPSILON, kept = k < 2 * n ? y[k] : at->t;

    if (k < 2 * n)
        y[k] *= more;
    qdot_constrained_load(h, k < 2 * n ? at->t : at->t * more, y);
    p->find(h);
    for (size_t i = 0; i < p->level->m; i++)
        noise[i] += fabs(p->residual[p->level->row[i]] - r[i]);
    if (k < 2 * n)
        y[k] = kept;
}

/* Whether residuals are what rounding of the state and of t makes of them: terms cancel that hold none of the unknowns, as
 * in the equation of a coordinate without mass whose velocity becomes 0. */
static qdot_status
is_violation_rounding(qdot_constrained *h, const part *p, const place *at, bool *is)
{
    const size_t n = h->plan->n, m = p->level->m;
    double *y = qdot_calloc(2 * n + 2 * m + 1, sizeof *y), *r = y + 2 * n, *noise = r + m;

    if (!y)
        return QDOT_ENOMEM;
    memcpy(y, at->y, 2 * n * sizeof *y);
    qdot_constrained_load(h, at->t, y);
    p->find(h);
    for (size_t i = 0; i < m; i++)
        r[i] = p->residual[p->level->row[i]];
    for (size_t k = 0; k <= 2 * n; k++)
        add_rounding_of_state(h, p, at, y, k, r, noise);
    *is = true;
    for (size_t i = 0; i < m; i++)
        *is = *is && fabs(r[i]) <= noise[i];
    qdot_constrained_load(h, at->t, at->y);
    p->find(h);
    qdot_free(y);
    return QDOT_OK;
}

/* Move the state by Newton's method to the nearest one on the constraints, in the metric of M. */
static qdot_status
project_state(qdot_constrained *h, part *p, const place *at)
{
    const size_t n = h->plan->n;
    double before = INFINITY;
    size_t worst = 0, failed;
    bool rounding;

    for (int k = 0; k < most_iterations; k++) {
        double now;

        qdot_constrained_load(h, at->t, at->y);
        p->find(h);
        evaluate_level(h, p);
        now = find_worst_residual(h, p, &worst);
        if (now <= 1 || (now < 1e3 && !(now < 0.5 * before)))
            return QDOT_OK;
        if (!isfinite(now) || (k > 5 && !(now < before)))
            break;
        before = now;
        if (qdot_saddle_factor(&p->saddle, &failed) != QDOT_OK) {
            QDOT_TRY(qdot_interrupt_check());
            if (now < 1e3) /* the event has set all values, and only rounding errors remain */
                return QDOT_OK;
            break;
        }
        qdot_saddle_solve_refined(&p->saddle);
        for (size_t i = 0; i < n; i++)
            if (!p->set[i])
                p->x[i] += p->saddle.x[i];
    }
    QDOT_TRY(is_violation_rounding(h, p, at, &rounding));
    return rounding ? QDOT_OK : fail_violated_by_event(h, worst, at->who);
}

/* Evaluate the level's residuals in double-double precision, as right-hand side of the linear system. */
static qdot_status
evaluate_residuals_in_double_double(const qdot_constrained *h, part *p, const place *at)
{
    const size_t n = h->plan->n;
    qdot_saddle *s = &p->saddle;
    qdot_tape_two *two;

    QDOT_TRY(qdot_tape_two_new(p->tape, 0, 2 * n + 1, &two));
    for (size_t i = 0; i < 2 * n; i++)
        *qdot_tape_two_input(two, i) = (qdot_two){at->y[i], at->low[i]};
    *qdot_tape_two_input(two, 2 * n) = (qdot_two){at->t, at->t_low};
    qdot_tape_two_order(two, 0);
    memset(s->x, 0, (n + s->m) * sizeof *s->x);
    for (size_t k = 0; k < p->level->m; k++) {
        const qdot_two f = qdot_tape_two_output(two, k)[0];

        s->x[n + k] = -(f.hi + f.lo);
    }
    qdot_tape_two_free(two);
    return QDOT_OK;
}

/* One step of Newton's method more, with residuals in two doubles: y + low then keeps the constraints to the places of
 * low. Else each of many impacts would leave a rounding of y, and these add up. */
static qdot_status
project_in_double_double(qdot_constrained *h, part *p, const place *at)
{
    size_t failed;

    QDOT_TRY(evaluate_residuals_in_double_double(h, p, at));
    if (qdot_saddle_factor(&p->saddle, &failed) != QDOT_OK) /* the matrix is singular if the event has set all values */
        return qdot_interrupt_check();
    qdot_saddle_solve_refined(&p->saddle);
    for (size_t i = 0; i < h->plan->n; i++) {
        const qdot_two moved = qdot_two_add_double((qdot_two){p->x[i], p->low[i]}, p->saddle.x[i]);

        if (p->set[i] || !isfinite(moved.hi))
            continue;
        p->x[i] = moved.hi;
        p->low[i] = moved.lo;
    }
    return QDOT_OK;
}

static qdot_status
put_on_constraints(qdot_constrained *h, part *p, const place *at)
{
    size_t count = 0;
    qdot_status status;

    if (p->level->m == 0 || !p->set)
        return QDOT_OK;
    for (size_t i = 0; i < h->plan->n; i++)
        count += p->set[i];
    status = qdot_saddle_init(&p->saddle, h->plan->n, p->level->m + count,
                              h->plan->indefinite);
    if (status == QDOT_OK)
        status = project_state(h, p, at);
    if (status == QDOT_OK && p->low)
        status = project_in_double_double(h, p, at);
    qdot_saddle_clear(&p->saddle);
    return status;
}

qdot_status
qdot_constrained_put(qdot_constrained *h, double t, double t_low, double *y, double *low,
                     const bool *q_set, const bool *v_set, const char *who)
{
    const size_t n = h->plan->n;
    const place at = {t, t_low, y, low, who};
    part q = {.level = h->at[QDOT_HOLONOMIC],
              .x = y,
              .low = low,
              .set = q_set,
              .residual = h->f,
              .tape = qdot_constrained_tape(h->positions, h->c->positions),
              .find = qdot_constrained_positions};
    part v = {.level = h->at[QDOT_VELOCITY],
              .x = y + n,
              .low = low ? low + n : NULL,
              .set = v_set,
              .residual = h->w,
              .tape = qdot_constrained_tape(h->velocities, h->c->velocities),
              .find = qdot_constrained_velocities};

    QDOT_TRY(put_on_constraints(h, &q, &at));
    return put_on_constraints(h, &v, &at);
}
