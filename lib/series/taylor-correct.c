/* taylor-correct.c -- what follows when the newest coefficients of inputs become known. */
#include <string.h>

#include "base/memory.h"
#include "series/taylor-steps.h"
#include "series/taylor.h"

/* A change of row `to` by a note[x] + b note[y] + c note[z]; factors from order 0. */
struct qdot_taylor_change {
    double *row;
    uint32_t to, x, y, z;
    double a, b, c;
    const qdot_taylor_step *step;
    bool second; /* of two rows of the step */
    bool rate;   /* its slope is the step's c times the order */
    bool varies; /* slopes are made of rows that move */
    int lead;
};

/* A row that holds j x_j: its change is k note[x], and nothing is made of it. */
struct qdot_taylor_scaled_change {
    double *row;
    uint32_t x;
    int lead;
};

struct qdot_taylor_changes {
    size_t n;     /* inputs that change */
    double *note; /* [rows] what is added to the newest coefficient */
    struct qdot_taylor_change *changes; /* in the order of the steps */
    struct qdot_taylor_scaled_change *scaled;
    size_t n_changes, n_scaled;
    bool stale; /* order 0 is a new one */
    bool begun; /* slopes that do not vary are there */
    bool changes_zero; /* a slope is made of numbers of order 0 that change */
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

/* --- which rows change and are read again ------------------------------------------- */

static size_t
number(const qdot_taylor *t, const double *row)
{
    return (size_t)(row - t->coefficients) / t->stride;
}

/* Whether orders below the newest are read too. */
static bool
looks_back(const qdot_taylor_step *s)
{
    return s->op >= QDOT_T_MUL;
}

static bool
operands_in(const qdot_taylor *t, const qdot_taylor_step *s, const bool *set)
{
    return set[number(t, s->x)] || set[number(t, s->y)] || set[number(t, s->z)];
}

/* changes: what depends on the inputs; read: what is asked for again after a correction. */
static void
mark(const qdot_taylor *t, size_t n, const bool *kept, bool *changes, bool *read)
{
    const qdot_taylor_step *s;

    for (size_t i = 0; i < n; i++)
        changes[i] = true;
    for (s = t->steps; s->op != QDOT_T_END; s++)
        if (operands_in(t, s, changes)) {
            changes[number(t, s->to)] = true;
            if (s->second)
                changes[number(t, s->second)] = true;
        }
    for (size_t i = 0; i < t->outputs; i++)
        if (!kept || kept[i])
            read[number(t, t->output[i])] = true;
    while (s != t->steps) {
        const size_t to = number(t, (--s)->to);

        if (looks_back(s)) {
            /* a function's own rows are its history; a product's are not */
            read[to] |= s->op > QDOT_T_NMADD;
            read[number(t, s->x)] = read[number(t, s->y)] = true;
            if (s->op > QDOT_T_NMADD || read[to])
                read[number(t, s->z)] = true;
        } else if (read[to]) {
            read[number(t, s->x)] = read[number(t, s->y)] = read[number(t, s->z)] = true;
        }
    }
}

/* --- the list ----------------------------------------------------------------------- */

static void
add_change(qdot_taylor *t, const qdot_taylor_step *s, bool second)
{
    struct qdot_taylor_changes *c = t->changes;
    double *row = second ? s->second : s->to;

    c->changes[c->n_changes++] =
        (struct qdot_taylor_change){.row = row,
                                    .to = (uint32_t)number(t, row),
                                    .x = (uint32_t)number(t, s->x),
                                    .y = (uint32_t)number(t, s->y),
                                    .z = (uint32_t)number(t, s->z),
                                    .step = s,
                                    .second = second,
                                    .rate = s->op == QDOT_T_RATE,
                                    .varies = s->op > QDOT_T_SUB && s->op != QDOT_T_RATE,
                                    .lead = s->lead};
}

static void
add_scaled(qdot_taylor *t, const qdot_taylor_step *s, double *row, const double *x)
{
    struct qdot_taylor_changes *c = t->changes;

    c->scaled[c->n_scaled++] =
        (struct qdot_taylor_scaled_change){row, (uint32_t)number(t, x), s->lead};
}

/* What changes by one step, a second row after the first. */
static void
list(qdot_taylor *t, const qdot_taylor_step *s)
{
    add_change(t, s, false);
    switch (s->op) {
    case QDOT_T_SINCOS:
    case QDOT_T_SINHCOSH:
    case QDOT_T_TANH: add_change(t, s, true); break;
    case QDOT_T_ATAN2:
        add_scaled(t, s, s->second, s->x);
        add_scaled(t, s, s->third, s->y);
        break;
    }
    if (s->d)
        add_scaled(t, s, s->d,
                   s->op == QDOT_T_RATIO || s->op == QDOT_T_ATAN2 ? s->to : s->x);
}

static qdot_status
make_changes(qdot_taylor *t, size_t n)
{
    struct qdot_taylor_changes *c = qdot_calloc(1, sizeof *c);

    qdot_taylor_changes_free(t);
    t->changes = c;
    if (!c)
        return QDOT_ENOMEM;
    c->n = n;
    c->stale = true;
    c->note = qdot_calloc(t->rows + 1, sizeof *c->note);
    c->changes = qdot_calloc(2 * t->length + 1, sizeof *c->changes);
    c->scaled = qdot_calloc(3 * t->length + 1, sizeof *c->scaled);
    return c->note && c->changes && c->scaled ? QDOT_OK : QDOT_ENOMEM;
}

qdot_status
qdot_taylor_follow_motion(qdot_taylor *t)
{
    QDOT_TRY(make_changes(t, 0));
    for (const qdot_taylor_step *s = t->steps; s->op != QDOT_T_END; s++)
        if (s->kept) {
            list(t, s);
            t->changes->changes_zero |= s->lead == 0 && looks_back(s);
        }
    return QDOT_OK;
}

qdot_status
qdot_taylor_affine(qdot_taylor *t, size_t n, const bool *kept)
{
    bool *changes = qdot_calloc(t->rows + 1, sizeof *changes);
    bool *read = qdot_calloc(t->rows + 1, sizeof *read);
    const qdot_status status = make_changes(t, n);

    if (!changes || !read || status != QDOT_OK) {
        qdot_free(changes);
        qdot_free(read);
        return QDOT_ENOMEM;
    }
    mark(t, n, kept, changes, read);
    for (const qdot_taylor_step *s = t->steps; s->op != QDOT_T_END; s++) {
        const bool twice = s->second && s->op != QDOT_T_ATAN2;

        if (changes[number(t, s->to)] &&
            (read[number(t, s->to)] || (twice && read[number(t, s->second)])))
            list(t, s);
    }
    qdot_free(changes);
    qdot_free(read);
    return QDOT_OK;
}

/* --- numbers ------------------------------------------------------------------------ */

/* Slopes of a number by x, y and z of its step; the fourth is 0. */
typedef double slopes __attribute__((vector_size(32)));

/* Derivatives of a step's row by its operands, at order 0: what is linear in coefficients of order
 * k holds at order 1. */
static void
differentiate(struct qdot_taylor_change *change)
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

void
qdot_taylor_change_row(qdot_taylor *t, double *row, int k, double by)
{
    t->changes->note[number(t, row)] = by;
    row[k] += by;
}

void
qdot_taylor_follow(qdot_taylor *t, int k)
{
    struct qdot_taylor_changes *all = t->changes;
    double *note = all->note;

    if (all->stale) {
        for (size_t i = 0; i < all->n_changes; i++)
            if (all->changes[i].varies || !all->begun)
                differentiate(all->changes + i);
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

void
qdot_taylor_correct(qdot_taylor *t, int k, const double *newest)
{
    for (size_t i = 0; i < t->changes->n; i++)
        qdot_taylor_change_row(t, qdot_taylor_input(t, i), k, newest[i]);
    qdot_taylor_follow(t, k);
}
