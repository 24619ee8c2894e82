/* taylor-correct.c -- updates rows of coefficients when the newest coefficients of inputs become known. */
#include <string.h>

#include "base/memory.h"
#include "series/taylor-steps.h"
#include "series/taylor.h"

/* How row `to` changes: by a note[x] + b note[y] + c note[z], where a, b, c follow from coefficients of order 0. */
struct qdot_taylor_change {
    double *row;
    uint32_t to, x, y, z;
    double a, b, c;
    const qdot_taylor_step *step;
    bool second; /* the row changed is the second of the two rows that the step writes */
    bool rate;   /* the step is a time derivative (RATE): its factor is c times the order */
    bool varies; /* a, b or c depend on order 0 of rows that vary in time, so that they change from step to step */
    int lead;
};

/* A row that contains j x_j: at order k it changes by k times the change of x. No other row depends on it. */
struct qdot_taylor_scaled_change {
    double *row;
    uint32_t x;
    int lead;
};

struct qdot_taylor_changes {
    double *note; /* [rows] the change of the newest coefficient of each row */
    struct qdot_taylor_change *changes; /* [n_changes] the changes of rows in the order of the steps */
    struct qdot_taylor_scaled_change *scaled;
    size_t n_changes, n_scaled;
    bool stale; /* the coefficients of order 0 have changed: the factors a, b, c must be computed again */
    bool begun; /* the factors that are constant in time have been computed */
    bool changes_zero; /* some factor depends on order 0 of rows that vary in time */
};

void
qdot_taylor_changes_free(qdot_taylor *t)
{
    if (!t->changes)
        return;
    qdot_free(t->changes->note);
    qdot_free(t->changes->changes);
    qdot_free(t->changes->scaled);
    qdot_free(t->changes);
    t->changes = NULL;
}

void
qdot_taylor_changes_stale(qdot_taylor *t, int k)
{
    if (t->changes && (k <= 0 || (k == 1 && t->changes->changes_zero)))
        t->changes->stale = true;
}

/* --- making the list of changes ----------------------------------------------------- */

static void
append_change(qdot_taylor *t, const qdot_taylor_step *s, bool second)
{
    struct qdot_taylor_changes *c = t->changes;
    double *row = second ? s->second : s->to;

    c->changes[c->n_changes++] =
        (struct qdot_taylor_change){.row = row,
                                    .to = qdot_taylor_row(t, row),
                                    .x = qdot_taylor_row(t, s->x),
                                    .y = qdot_taylor_row(t, s->y),
                                    .z = qdot_taylor_row(t, s->z),
                                    .step = s,
                                    .second = second,
                                    .rate = s->op == QDOT_T_RATE,
                                    .varies = s->op > QDOT_T_SUB && s->op != QDOT_T_RATE,
                                    .lead = s->lead};
}

static void
append_scaled_change(qdot_taylor *t, const qdot_taylor_step *s, double *row, const double *x)
{
    struct qdot_taylor_changes *c = t->changes;

    c->scaled[c->n_scaled++] =
        (struct qdot_taylor_scaled_change){row, qdot_taylor_row(t, x), s->lead};
}

/* List how a step changes the rows that it writes, the second result after the first. */
static void
list(qdot_taylor *t, const qdot_taylor_step *s)
{
    append_change(t, s, false);
    switch (s->op) {
    case QDOT_T_SINCOS:
    case QDOT_T_SINHCOSH:
    case QDOT_T_TANH: append_change(t, s, true); break;
    case QDOT_T_ATAN2:
        append_scaled_change(t, s, s->second, s->x);
        append_scaled_change(t, s, s->third, s->y);
        break;
    }
    if (s->d)
        append_scaled_change(t, s, s->d,
                             s->op == QDOT_T_RATIO || s->op == QDOT_T_ATAN2 ? s->to : s->x);
}

static qdot_status
list_all_changes(qdot_taylor *t)
{
    struct qdot_taylor_changes *c = qdot_calloc(1, sizeof *c);

    t->changes = c;
    if (!c)
        return QDOT_ENOMEM;
    c->stale = true;
    c->note = qdot_calloc(t->rows + 1, sizeof *c->note);
    c->changes = qdot_calloc(2 * t->length + 1, sizeof *c->changes);
    c->scaled = qdot_calloc(3 * t->length + 1, sizeof *c->scaled);
    return c->note && c->changes && c->scaled ? QDOT_OK : QDOT_ENOMEM;
}

qdot_status
qdot_taylor_follow_motion(qdot_taylor *t)
{
    QDOT_TRY(list_all_changes(t));
    for (const qdot_taylor_step *s = t->steps; s->op != QDOT_T_END; s++)
        if (s->kept) {
            list(t, s);
            t->changes->changes_zero |= s->lead == 0 && qdot_recurrence_looks_back(s->op);
        }
    return QDOT_OK;
}

/* --- evaluating the changes --------------------------------------------------------- */

/* Derivatives of the value of a step by its operands x, y and z; the fourth number is 0. */
typedef double slopes __attribute__((vector_size(32)));

/* Derivatives of a step's row by its operands, at order 0: what is linear in coefficients of order
 * k holds at order 1. */
static void
compute_factors(struct qdot_taylor_change *change)
{
    const qdot_taylor_step *i = change->step;
    const slopes NEWEST_x = {1, 0, 0, 0}, NEWEST_y = {0, 1, 0, 0}, NEWEST_z = {0, 0, 1, 0};
    slopes NEWEST_to = {0}, NEWEST_second = {0}, NEWEST_third = {0}, NEWEST_d = {0};
    slopes U1, U2, by;
    const int k = 1;

#define NOTE(row) NEWEST_##row
#define ZERO(row) i->row[0]
#define OVER_ZERO(p, row) (p) * i->c
#define OVER_TWICE_ZERO(p, row) OVER_ZERO(p, row)
#define FUSED(a, b, c) (a) * (b) + (c)
#define NOTHING (slopes){0}
#include "series/linear.def"
    by = change->second ? NEWEST_second : NEWEST_to;
    change->a = i->newest & QDOT_X_NEWEST ? by[0] : 0;
    change->b = i->newest & QDOT_Y_NEWEST ? by[1] : 0;
    change->c = i->newest & QDOT_Z_NEWEST ? by[2] : 0;
}

double *
qdot_taylor_change_of(const qdot_taylor *t, const double *row)
{
    return t->changes->note + qdot_taylor_row(t, row);
}

void
qdot_taylor_follow(qdot_taylor *t, int k)
{
    struct qdot_taylor_changes *all = t->changes;
    double *note = all->note;

    if (all->stale) {
        for (size_t i = 0; i < all->n_changes; i++)
            if (all->changes[i].varies || !all->begun)
                compute_factors(all->changes + i);
        all->stale = false;
        all->begun = true;
    }
    for (size_t i = 0; i < all->n_changes; i++) {
        const struct qdot_taylor_change *c = all->changes + i;
        const double d = c->rate
                             ? (k + c->lead + 1) * c->step->c * note[c->x]
                             : c->a * note[c->x] + c->b * note[c->y] + c->c * note[c->z];

        note[c->to] = d;
        c->row[k + c->lead] += d;
    }
    for (size_t i = 0; i < all->n_scaled; i++) {
        const int order = k + all->scaled[i].lead;

        all->scaled[i].row[order] += order * note[all->scaled[i].x];
    }
}
