/* constrained-put.c -- brings a state onto the constraints after an event has set some values. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "sim/model/constrained-parts.h"
#include "sim/model/constrained.h"

enum { most_iterations = 30 };

/* Values below it count as so large where rounding is judged. */
static const double least_size = 0x1p-10;

/* q or q' of y, its rows, and a system that holds those and the values set. */
typedef struct {
    const qdot_constrained_level *level;
    double *x;
    const bool *set; /* [n] */
    const double *residual;
    void (*find)(qdot_constrained *h);
    qdot_saddle saddle;
} part;

/* Fill the system: M and A at the loaded state, a unit row for each value set, -f and zeros. */
static void
fill(qdot_constrained *h, part *p)
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
size_near(const qdot_constrained *h, const part *p, size_t k)
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

/* The largest ratio of a residual to its rounding, and its row. */
static double
excess(const qdot_constrained *h, const part *p, size_t *worst)
{
    double most = 0;

    for (size_t k = 0; k < p->level->m; k++) {
        const double size = fmax(qdot_saddle_row_size(&p->saddle, k, p->x, least_size),
                                 size_near(h, p, k));
        const double now = fabs(p->residual[p->level->row[k]]) / (DBL_EPSILON * size);

        if (!(now <= most)) {
            most = now;
            *worst = p->level->row[k];
        }
    }
    return most;
}

static qdot_status
refuse(const qdot_constrained *h, size_t row, const char *who)
{
    return qdot_fail(QDOT_EDOMAIN,
                     "the event %.100s sets values that constraint %.200s does not allow",
                     who, h->c->rows[row].name);
}

/* Newton's method by the shortest way in the metric of M. */
static qdot_status
bring(qdot_constrained *h, part *p, double t, const double *y, const char *who)
{
    const size_t n = h->plan->n;
    double before = INFINITY;
    size_t worst = 0, failed;

    for (int k = 0; k < most_iterations; k++) {
        double now;

        qdot_constrained_load(h, t, y);
        p->find(h);
        fill(h, p);
        now = excess(h, p, &worst);
        if (now <= 1 || (now < 1e3 && !(now < 0.5 * before)))
            return QDOT_OK;
        if (!isfinite(now) || (k > 5 && !(now < before)))
            break;
        before = now;
        if (qdot_saddle_factor(&p->saddle, &failed) != QDOT_OK) {
            QDOT_TRY(qdot_interrupt_check());
            if (now < 1e3) /* all values are set, and rounding is all that is left */
                return QDOT_OK;
            break;
        }
        qdot_saddle_solve_refined(&p->saddle);
        for (size_t i = 0; i < n; i++)
            if (!p->set[i])
                p->x[i] += p->saddle.x[i];
    }
    return refuse(h, worst, who);
}

static qdot_status
put(qdot_constrained *h, part *p, double t, const double *y, const char *who)
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
        status = bring(h, p, t, y, who);
    qdot_saddle_clear(&p->saddle);
    return status;
}

qdot_status
qdot_constrained_put(qdot_constrained *h, double t, double *y, const bool *q_set,
                     const bool *v_set, const char *who)
{
    const size_t n = h->plan->n;
    part q = {.level = h->at[QDOT_HOLONOMIC],
              .x = y,
              .set = q_set,
              .residual = h->f,
              .find = qdot_constrained_positions};
    part v = {.level = h->at[QDOT_VELOCITY],
              .x = y + n,
              .set = v_set,
              .residual = h->w,
              .find = qdot_constrained_velocities};

    QDOT_TRY(put(h, &q, t, y, who));
    return put(h, &v, t, y, who);
}
