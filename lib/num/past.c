/* past.c -- the pieces of a run so far, the breaking points among their ends, and the search for the piece that holds a time. */
#include "num/past.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"

enum { PIECE, KNOT, RATE, COEFFICIENT, ITEMS = 64 };
enum { COEFFICIENTS = QDOT_PAST_ORDER + 1 };

/* Handles begin here, beyond those of tables of data; the last is below 2^53. */
static const double first_handle = 0x1p40;

typedef struct {
    double t, rate;
    double valid;  /* the time to which the series holds, beyond its own end too, if no breaking point is between */
    double before; /* how long before t it holds, under the same condition */
    int order;     /* of the breaking point at t: the lowest derivative that jumps; QDOT_PAST_SMOOTH: it is none */
} piece;

typedef struct {
    double tau;
    int gain;
    bool watched; /* what is read is looked at for its sign */
} delay;

struct qdot_past {
    size_t n;
    uint32_t *called;
    double end;
    double restart;  /* the time of the breaking point that was reported last */
    double expanded; /* the begin of the step whose series is being computed; -INFINITY: values are read */
    qdot_vec(delay) delays;
    qdot_vec(piece) pieces;        /* the first one is that before the start */
    qdot_vec(size_t) breaks;       /* the pieces, but the first one, that begin at breaking points */
    qdot_vec(double) coefficients; /* [pieces x n x COEFFICIENTS] */
};

/* What this thread reads: one history, or several. */
static _Thread_local qdot_past_reading only;
static _Thread_local const qdot_past_reading *several;
static _Thread_local size_t n_several;
static _Thread_local double asked_within = INFINITY;

qdot_status
qdot_past_new(size_t n, const uint32_t *called, qdot_past **out)
{
    qdot_past *h = qdot_calloc(1, sizeof *h);

    *out = h;
    if (!h)
        return QDOT_ENOMEM;
    h->n = n;
    h->restart = NAN;
    h->expanded = -INFINITY;
    h->called = qdot_calloc(n + 1, sizeof *h->called);
    if (!h->called) {
        qdot_past_free(h);
        *out = NULL;
        return QDOT_ENOMEM;
    }
    memcpy(h->called, called, n * sizeof *called);
    return QDOT_OK;
}

void
qdot_past_free(qdot_past *h)
{
    if (!h)
        return;
    if (only.history == h)
        only.history = NULL;
    qdot_free(h->called);
    qdot_free(h->delays.at);
    qdot_free(h->pieces.at);
    qdot_free(h->breaks.at);
    qdot_free(h->coefficients.at);
    qdot_free(h);
}

void
qdot_past_read(qdot_past *h)
{
    only = (qdot_past_reading){h, h ? h->called : NULL};
    several = NULL;
}

void
qdot_past_read_several(size_t n, const qdot_past_reading *of)
{
    several = of;
    n_several = n;
}

void
qdot_past_expand(qdot_past *h, double t)
{
    h->expanded = t;
}

/* --- searching -------------------------------------------------------------------------- */

/* The number of the piece that holds u: 0 before the start, and from there on those that begin at t_1, t_2 ... */
static size_t
piece_at(const qdot_past *h, double u)
{
    size_t low = 0, high = h->pieces.n;

    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;

        if (h->pieces.at[middle].t <= u)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* The first piece after piece j that begins at a breaking point; the number of pieces if there is none. */
static size_t
break_after(const qdot_past *h, size_t j)
{
    size_t low = 0, high = h->breaks.n;

    while (low < high) {
        const size_t middle = low + (high - low) / 2;

        if (h->breaks.at[middle] <= j)
            low = middle + 1;
        else
            high = middle;
    }
    return low < h->breaks.n ? h->breaks.at[low] : h->pieces.n;
}

/* The piece for a step from t that reads u: of that which holds u and those that begin behind u and before t, with no breaking point
 * between, the one that holds longest. */
static size_t
longest_piece_at(const qdot_past *h, double u, double t)
{
    const piece *p = h->pieces.at;
    const size_t j = piece_at(h, u), end = break_after(h, j);
    size_t longest = j;

    for (size_t k = j + 1; k < end && p[k].t < t && p[k].t - u <= p[k].before; k++)
        if (p[k].valid > p[longest].valid)
            longest = k;
    return longest;
}

/* The time to which a step from t can read y(u), u = t - tau, in one piece, breaking points apart. */
static double
reads_until(const qdot_past *h, double u, double t)
{
    const size_t j = piece_at(h, u), k = longest_piece_at(h, u, t);
    const double end = j + 1 < h->pieces.n ? h->pieces.at[j + 1].t : h->end;

    return fmin(t, fmax(end, h->pieces.at[k].valid));
}

/* What rounding of times a time tau apart may be. */
static double
blur_of_times(double t, double tau)
{
    return 4 * DBL_EPSILON * (fabs(t - tau) + fabs(t) + tau);
}

double
qdot_past_next(const qdot_past *h, double t)
{
    double next = INFINITY;

    for (size_t d = 0; d < h->delays.n; d++) {
        const double tau = h->delays.at[d].tau, u = t - tau, blur = blur_of_times(t, tau);
        const size_t k = break_after(h, piece_at(h, u));
        double until = reads_until(h, u, t), end;
        bool jumps = false;

        if (k < h->pieces.n && h->pieces.at[k].t <= until) {
            until = h->pieces.at[k].t;
            jumps = h->pieces.at[k].order == 0 || h->delays.at[d].watched;
        }
        end = jumps && until - blur + tau > t ? until - blur + tau : until + blur + tau;
        next = end > t && end < next ? end : next;
    }
    return next;
}

/* --- writing ---------------------------------------------------------------------------- */

/* A jump by less is rounding of the value; one that is taken for a jump costs a step. */
static const double no_jump = 64 * DBL_EPSILON;

/* A step shorter than this, relative to times and delays, only goes over a jump of the equations: the piece before it goes on
 * to its end. Ends that are nearer to each other are not told apart. */
static const double no_length = 64 * DBL_EPSILON;

qdot_status
qdot_past_delay(qdot_past *h, double tau, int gain)
{
    for (size_t d = 0; d < h->delays.n; d++)
        if (h->delays.at[d].tau == tau) {
            h->delays.at[d].gain = gain < h->delays.at[d].gain ? gain : h->delays.at[d].gain;
            h->delays.at[d].watched |= gain == QDOT_PAST_SMOOTH;
            return QDOT_OK;
        }
    return qdot_vec_push(&h->delays, ((delay){tau, gain, gain == QDOT_PAST_SMOOTH}));
}

/* Unknown i of a piece at w = (u - t)/unit; *size: the sum of the sizes of its terms. */
static double
value_in_piece(const qdot_past *h, size_t piece, size_t i, double w, double *size)
{
    const double *c = h->coefficients.at + (piece * h->n + i) * COEFFICIENTS;
    double y = 0;

    *size = 0;
    for (int k = QDOT_PAST_ORDER; k >= 0; k--) {
        y = y * w + c[k];
        *size = *size * fabs(w) + fabs(c[k]);
    }
    return y;
}

/* Whether two pieces differ at u by more than a part `least` of their size. */
static bool
differ_at(const qdot_past *h, size_t a, size_t b, double u, double least)
{
    const piece *p = h->pieces.at;

    for (size_t i = 0; i < h->n; i++) {
        double size_a, size_b;
        const double x = value_in_piece(h, a, i, (u - p[a].t) * p[a].rate, &size_a);
        const double y = value_in_piece(h, b, i, (u - p[b].t) * p[b].rate, &size_b);

        if (!(fabs(x - y) <= least * fmax(size_a, size_b)))
            return true;
    }
    return false;
}

/* The order of the breaking point at t by what the equations read there; QDOT_PAST_SMOOTH: it is none. */
static int
order_by_delays(const qdot_past *h, double t)
{
    int order = t == h->restart ? 0 : QDOT_PAST_SMOOTH;

    for (size_t d = 0; d < h->delays.n; d++) {
        const delay *by = &h->delays.at[d];
        const double u = t - by->tau, near = 4 * blur_of_times(t, by->tau);
        const piece *read = &h->pieces.at[piece_at(h, u + near)];

        if (read > h->pieces.at && read->order < QDOT_PAST_SMOOTH && u - read->t <= near && read->order + by->gain < order)
            order = read->order + by->gain;
    }
    return order;
}

/* The time to which a step from t, whose coefficients allow `holds`, has read series that hold. */
static double
valid_until(const qdot_past *h, double t, double holds)
{
    for (size_t d = 0; d < h->delays.n; d++) {
        const double tau = h->delays.at[d].tau;

        if (h->delays.at[d].gain < QDOT_PAST_SMOOTH)
            holds = fmin(holds, h->pieces.at[longest_piece_at(h, t - tau, t)].valid + tau);
    }
    return holds;
}

/* Whether the last piece begins with a breaking point of this order: one that is seen before the next one, or a delay, is over. Where
 * it is not, the piece before it is the same function, as far as both hold. */
static int
order_that_is_seen(qdot_past *h, int order, int p)
{
    const size_t last = h->pieces.n - 1;
    piece *now = &h->pieces.at[last], *was = now - 1;
    double far;

    if (order > p)
        return QDOT_PAST_SMOOTH;
    if (order == 0 && differ_at(h, last - 1, last, now->t, no_jump))
        return 0;
    far = fmin(fmin(was->valid - now->t, now->before), now->valid - now->t);
    for (size_t d = 0; d < h->delays.n; d++)
        far = fmin(far, h->delays.at[d].tau);
    if (!(far > 0) || differ_at(h, last - 1, last, now->t + far, 4 * DBL_EPSILON) ||
        differ_at(h, last - 1, last, now->t + 0.7 * far, 4 * DBL_EPSILON))
        return order > 0 ? order : 1;
    now->before = far;
    was->valid = fmin(was->valid, now->valid);
    return QDOT_PAST_SMOOTH;
}

static void
keep_pieces(qdot_past *h, size_t count)
{
    h->pieces.n = count;
    h->coefficients.n = count * h->n * COEFFICIENTS;
    while (h->breaks.n > 0 && h->breaks.at[h->breaks.n - 1] >= count)
        h->breaks.n--;
}

static qdot_status
add_piece(qdot_past *h, const piece *new, int p, const double *x, size_t stride)
{
    QDOT_TRY(qdot_vec_push(&h->pieces, *new));
    for (size_t i = 0; i < h->n; i++)
        for (int k = 0; k < COEFFICIENTS; k++)
            QDOT_TRY(qdot_vec_push(&h->coefficients, k <= p ? x[i * stride + (size_t)k] : 0));
    return QDOT_OK;
}

qdot_status
qdot_past_begin(qdot_past *h, double t, const double *y)
{
    keep_pieces(h, 0);
    h->end = h->restart = t;
    return add_piece(h, &(piece){t, 0, INFINITY, 0, QDOT_PAST_SMOOTH}, 0, y, 1);
}

void
qdot_past_restart(qdot_past *h, double t)
{
    if (h)
        h->restart = t;
}

qdot_status
qdot_past_add(qdot_past *h, double t, double unit, int p, double holds, const double *x, size_t stride)
{
    const double least = no_length * (fabs(t) + fabs(t - h->pieces.at[0].t));
    size_t count = h->pieces.n;
    int order = QDOT_PAST_SMOOTH;

    for (; count > 1 && h->pieces.at[count - 1].t >= (count > 2 ? t - least : t); count--)
        if (h->pieces.at[count - 1].t <= t && h->pieces.at[count - 1].order < order)
            order = h->pieces.at[count - 1].order; /* what began with a piece that is hardly there begins now */
    keep_pieces(h, count);
    {
        const int by_delays = order_by_delays(h, t);
        const piece new = {t, 1 / unit, valid_until(h, t, holds), 0.5 * (holds - t), QDOT_PAST_SMOOTH};

        order = by_delays < order ? by_delays : order;
        QDOT_TRY(add_piece(h, &new, p, x, stride));
    }
    if (order < QDOT_PAST_SMOOTH)
        order = order_that_is_seen(h, order, p);
    h->pieces.at[count].order = order;
    return order < QDOT_PAST_SMOOTH ? qdot_vec_push(&h->breaks, count) : QDOT_OK;
}

void
qdot_past_reach(qdot_past *h, double t)
{
    if (h)
        h->end = t;
}

/* --- reading ---------------------------------------------------------------------------- */

static double
handle_of(uint32_t called, int item)
{
    return first_handle + (double)called * ITEMS + item;
}

long long
qdot_past_piece(uint32_t called)
{
    return (long long)handle_of(called, PIECE);
}

long long
qdot_past_knot(uint32_t called)
{
    return (long long)handle_of(called, KNOT);
}

long long
qdot_past_rate(uint32_t called)
{
    return (long long)handle_of(called, RATE);
}

long long
qdot_past_coefficient(uint32_t called, int k)
{
    return (long long)handle_of(called, COEFFICIENT + k);
}

bool
qdot_past_has(double handle)
{
    return handle >= first_handle && handle <= first_handle + (double)UINT32_MAX * ITEMS + ITEMS;
}

bool
qdot_past_finds(double handle)
{
    return qdot_past_has(handle) && (long long)(handle - first_handle) % ITEMS == PIECE;
}

bool
qdot_past_is_value(double handle, uint32_t *called)
{
    const long long of = qdot_past_has(handle) ? (long long)(handle - first_handle) : PIECE;

    *called = (uint32_t)(of / ITEMS);
    return of % ITEMS == COEFFICIENT;
}

long long
qdot_past_rename(double handle, uint32_t called)
{
    return (long long)handle_of(called, (int)((long long)(handle - first_handle) % ITEMS));
}

/* Whether u is behind the end by more than rounding of times: nothing is known of it yet. */
static bool
is_behind_end(const qdot_past *h, double u)
{
    return u - h->end > 1e-12 * (fabs(u) + fabs(h->end));
}

/* The history that is read and has the unknown of a handle, and which of its unknowns that is; NULL: none. */
static const qdot_past *
history_of(double handle, size_t *i)
{
    const size_t n = several ? n_several : 1;
    uint32_t called;

    if (!qdot_past_has(handle))
        return NULL;
    (void)qdot_past_is_value(handle, &called);
    for (size_t k = 0; k < n; k++) {
        const qdot_past_reading *r = several ? &several[k] : &only;

        for (*i = 0; r->history && r->history->pieces.n > 0 && *i < r->history->n; ++*i)
            if (r->called[*i] == called)
                return r->history;
    }
    return NULL;
}

double
qdot_past_lookup(double handle, double x)
{
    size_t i, at;
    const qdot_past *h = history_of(handle, &i);
    const int item = h ? (int)((long long)(handle - first_handle) % ITEMS) : 0;

    if (!h || !isfinite(x) || item > COEFFICIENT + QDOT_PAST_ORDER)
        return NAN;
    if (item == PIECE)
        return is_behind_end(h, x) ? NAN : (double)longest_piece_at(h, x, h->expanded);
    at = x >= 0 && x < (double)h->pieces.n ? (size_t)x : h->pieces.n - 1;
    if (item == KNOT)
        return h->pieces.at[at].t;
    if (item == RATE)
        return h->pieces.at[at].rate;
    return h->coefficients.at[(at * h->n + i) * COEFFICIENTS + (size_t)(item - COEFFICIENT)];
}

double
qdot_past_piece_end(double handle, double x)
{
    size_t i;
    const qdot_past *h = history_of(handle, &i);
    const size_t j = h ? piece_at(h, x) : 0;

    return h && j + 1 < h->pieces.n ? h->pieces.at[j + 1].t : INFINITY;
}

void
qdot_past_ask_within(double real)
{
    asked_within = real;
}

bool
qdot_past_is_smooth(double handle, double x, double r)
{
    const double real = fmin(r, asked_within), blur = 16 * DBL_EPSILON * (fabs(x) + real);
    size_t i, j, next;
    const qdot_past *h = history_of(handle, &i);
    const piece *p;

    if (!h || !isfinite(x))
        return false;
    j = piece_at(h, x);
    p = &h->pieces.at[j];
    next = break_after(h, j);
    return x + real <= blur + fmax(p->valid, j + 1 < h->pieces.n ? p[1].t : h->end) &&
           (next == h->pieces.n || x + real <= blur + h->pieces.at[next].t) &&
           (j == 0 || x - real >= (p->order < QDOT_PAST_SMOOTH ? p->t : p->t - p->before) - blur);
}
