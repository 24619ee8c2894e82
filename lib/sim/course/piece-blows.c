/* piece-blows.c -- blows at one instant that never end: bodies in a row that stick.
 *
 * Where several contacts are met at one instant each blow may set off another one: x = y, y = z, x = y, ... They are
 * carried out one by one, as pieces without length. With restitutions below 1 there may be infinitely many, by which the
 * speeds with which the bodies approach go to 0 as a geometric series does. So once an event has come more often at one
 * instant the following blows are tried on the velocities alone: either they end, and the run goes through them, or no
 * approach is left that rounding does not hide. That is where the run goes on, and what touches then may last there.
 *
 * Nothing is looked for between them: only coordinates and velocities that `then` sets change, and time stands still.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "sim/course/piece.h"
#include "sim/model/contact.h"

/* The largest number of simultaneous impacts that are computed one after another. */
enum { MOST_BLOWS = 200000 };
/* A sequence of impacts has ended by itself if the last reversed speed exceeded its rounding error by this factor. */
static const double seen = 0x1p14;
/* The approach speeds that remain at other contacts count as rounding up to this multiple of their errors. */
static const double left_over = 64;

/* Factor from the rounding error of the largest velocity so far to the uncertainty of a velocity. */
static const double hidden = 4;

/* A contact whose bodies touch at this instant. */
typedef struct {
    size_t event, surface;
    int way;   /* sign of du/dt when the bodies meet, in the direction of the run */
    bool lasted; /* the contact lasted (its bodies stayed together) in the mode of the piece that ended */
    bool held;   /* the contact lasts: its impact comes first, and not together with others */
    bool due;
    double rate, noise; /* present speed of approach (du/dt times `way`); its rounding error */
} touch;

typedef struct {
    qdot_piece *x;
    qdot_vec(touch) at;
    double *y, *low;         /* [2n] the state is the sum y + low (double-double) */
    double *old, *old_low;   /* [2n] the state before an impact */
    double *rates, *fast, *slopes; /* [2n] scratch */
    size_t blows;
    double last;   /* approach speed at the last impact, divided by its rounding error */
} blows;

/* The sign of du/dt with which the motion reaches event i, u being the event's function. */
static int
sign_of_approach(const qdot_piece *x, size_t i)
{
    const int asked = qdot_piece_way_asked(x, i);

    return asked != 0 ? asked : -x->left[i];
}

static qdot_status
find_touching_contacts(blows *b)
{
    qdot_piece *x = b->x;
    const qdot_switches *s = &x->c->stage->switches;

    for (size_t i = 0; i < x->c->stage->events.n; i++) {
        const int way = sign_of_approach(x, i);
        touch new = {.event = i, .surface = qdot_contacts_surface(s, i, way), .way = way};

        if (way == 0 || new.surface == SIZE_MAX)
            continue;
        new.lasted = new.held = qdot_piece_mode(x)->side[new.surface] == QDOT_SIDE_SLIDES;
        if (new.lasted || x->touching[i])
            QDOT_TRY(qdot_vec_push(&b->at, new));
    }
    return QDOT_OK;
}

/* Find the approach speed du/dt of a contact in the state reached by the impacts so far. */
static qdot_status
measure_approach_speed(blows *b, touch *c)
{
    qdot_piece *x = b->x;
    const size_t n = x->n / 2;
    double rate, noise = 0;

    if (c->lasted) {
        QDOT_TRY(qdot_sliding_rows_value(&qdot_piece_mode(x)->held, n, x->start.t, b->y, c->surface, 1, &rate,
                                         b->slopes));
        for (size_t i = 0; i < n; i++)
            noise += hidden * DBL_EPSILON * fabs(b->slopes[i]) * x->largest[n + i];
    } else {
        memset(b->rates, 0, x->n * sizeof *b->rates);
        memset(b->fast, 0, x->n * sizeof *b->fast);
        memcpy(b->rates, b->y + n, n * sizeof *b->rates);
        memcpy(b->fast, x->largest + n, n * sizeof *b->fast);
        QDOT_TRY(qdot_watch_rate(qdot_piece_watch(x), x->start.t, b->y, NULL, b->rates, b->fast, c->event, &rate,
                                 &noise));
    }
    c->rate = rate * c->way * x->direction;
    c->noise = noise;
    return QDOT_OK;
}

static qdot_status
measure_approach_speeds(blows *b)
{
    for (size_t k = 0; k < b->at.n; k++)
        QDOT_TRY(measure_approach_speed(b, &b->at.at[k]));
    return QDOT_OK;
}

static bool
is_approaching(const touch *c)
{
    return c->rate > c->noise;
}

static qdot_status
apply_impact(blows *b, touch *c)
{
    qdot_piece *x = b->x;

    memcpy(b->old, b->y, x->n * sizeof *b->old);
    memcpy(b->old_low, b->low, x->n * sizeof *b->old_low);
    QDOT_TRY(qdot_piece_change(x, &x->c->stage->events.at[c->event], x->start.t, b->old, b->old_low, b->y, b->low));
    for (size_t i = 0; i < x->n; i++)
        x->largest[i] = fmax(x->largest[i], fabs(b->y[i]));
    b->last = c->rate / c->noise;
    b->blows++;
    c->held = c->due = false;
    return QDOT_OK;
}

/* The next blows, as pieces without length have them: a contact that lasts and is pushed into first, and alone; else all
 * that approach, one after the other, but for those that one before them has turned back. *any: there were some. */
static qdot_status
apply_next_impact(blows *b, bool *any)
{
    bool pushed = false;

    *any = false;
    QDOT_TRY(measure_approach_speeds(b));
    for (size_t k = 0; k < b->at.n; k++)
        pushed |= b->at.at[k].held && is_approaching(&b->at.at[k]);
    for (size_t k = 0; k < b->at.n; k++) {
        touch *c = &b->at.at[k];

        c->due = is_approaching(c) && (c->held || !pushed);
        c->held = c->held && fabs(c->rate) <= c->noise; /* held on only at speed 0 within rounding */
    }
    for (size_t k = 0; k < b->at.n; k++) {
        touch *c = &b->at.at[k];

        if (!c->due)
            continue;
        QDOT_TRY(measure_approach_speed(b, c));
        if (!is_approaching(c))
            continue;
        QDOT_TRY(apply_impact(b, c));
        *any = true;
    }
    return QDOT_OK;
}

/* The contacts that the blows leave without speed last from here on, if they may. What speed rounding hides there is shown
 * by companions, whose bodies are moved by it together. */
static qdot_status
record_state_after_impacts(blows *b)
{
    qdot_piece *x = b->x;

    for (size_t i = x->n / 2; i < x->n; i++)
        b->y[i] += x->c->early * hidden * DBL_EPSILON * x->largest[i];
    memcpy(x->start.y, b->y, x->n * sizeof *b->y);
    memcpy(x->start.low_of, b->y, x->n * sizeof *b->y);
    memcpy(x->start.low, b->low, x->n * sizeof *x->start.low);
    for (size_t k = 0; k < b->at.n; k++) {
        const touch *c = &b->at.at[k];
        bool lasts, soon;

        x->side[c->surface] = 0;
        if (fabs(c->rate) > left_over * c->noise)
            continue;
        QDOT_TRY(qdot_piece_rest(x, c->event, c->way, 0, &lasts, &soon));
    }
    return QDOT_OK;
}

qdot_status
qdot_piece_try_blows(qdot_piece *x, bool *endless, bool *known)
{
    blows b = {.x = x};
    bool any = true;
    qdot_status status;

    *endless = false;
    *known = true;
    b.y = qdot_malloc(7 * x->n * sizeof *b.y);
    b.low = b.y + x->n;
    b.old = b.low + x->n;
    b.old_low = b.old + x->n;
    b.rates = b.old_low + x->n;
    b.fast = b.rates + x->n;
    b.slopes = b.fast + x->n;
    status = b.y ? find_touching_contacts(&b) : QDOT_ENOMEM;
    if (status == QDOT_OK) {
        memcpy(b.y, x->start.y, x->n * sizeof *b.y);
        qdot_piece_low(x, b.low);
    }
    while (status == QDOT_OK && any && b.blows < MOST_BLOWS) {
        status = qdot_interrupt_check();
        if (status == QDOT_OK)
            status = apply_next_impact(&b, &any);
    }
    *known = !any;
    *endless = !any && b.blows > 0 && b.last <= seen;
    if (status == QDOT_OK && *endless)
        status = record_state_after_impacts(&b);
    qdot_free(b.y);
    qdot_free(b.at.at);
    return status;
}
