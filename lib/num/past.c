/* past.c -- the pieces of a run so far, and the search for the one that holds a time. */
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
    bool jumps; /* an unknown has another value where the piece begins than where the one before ends */
} piece;

struct qdot_past {
    size_t n;
    uint32_t *called;
    double end;
    qdot_vec(piece) pieces;        /* the first one is that before the start */
    qdot_vec(double) coefficients; /* [pieces x n x COEFFICIENTS] */
};

static _Thread_local qdot_past *reading;

qdot_status
qdot_past_new(size_t n, const uint32_t *called, qdot_past **out)
{
    qdot_past *h = qdot_calloc(1, sizeof *h);

    *out = h;
    if (!h)
        return QDOT_ENOMEM;
    h->n = n;
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
    if (reading == h)
        reading = NULL;
    qdot_free(h->called);
    qdot_free(h->pieces.at);
    qdot_free(h->coefficients.at);
    qdot_free(h);
}

void
qdot_past_read(qdot_past *h)
{
    reading = h;
}

/* --- writing ---------------------------------------------------------------------------- */

/* A jump by less is rounding of the value; one that is taken for a jump costs a step. */
static const double no_jump = 64 * DBL_EPSILON;

/* A step shorter than this, relative to times and delays, only goes over a jump of the equations: the piece before it goes on
 * to its end. Knots that are nearer to each other are not told apart. */
static const double no_length = 64 * DBL_EPSILON;

/* Whether the unknowns x, at a time, are others than the last piece makes them there. */
static bool
is_jump(const qdot_past *h, double t, const double *x, size_t stride)
{
    const piece *last = h->pieces.n > 0 ? &h->pieces.at[h->pieces.n - 1] : NULL;
    const double s = last ? (t - last->t) * last->rate : 0;

    for (size_t i = 0; i < h->n && last; i++) {
        const double *c = h->coefficients.at + ((h->pieces.n - 1) * h->n + i) * COEFFICIENTS;
        double y = 0;

        for (int k = QDOT_PAST_ORDER; k >= 0; k--)
            y = y * s + c[k];
        if (fabs(y - x[i * stride]) > no_jump * fmax(fabs(y), fabs(x[i * stride])))
            return true;
    }
    return false;
}

static qdot_status
add_piece(qdot_past *h, double t, double rate, int p, const double *x, size_t stride)
{
    /* before the start velocities are 0, whatever they are from there on */
    const bool jumps = h->pieces.n == 1 || is_jump(h, t, x, stride);

    QDOT_TRY(qdot_vec_push(&h->pieces, ((piece){t, rate, jumps})));
    for (size_t i = 0; i < h->n; i++)
        for (int k = 0; k < COEFFICIENTS; k++)
            QDOT_TRY(qdot_vec_push(&h->coefficients, k <= p ? x[i * stride + (size_t)k] : 0));
    return QDOT_OK;
}

static void
keep_pieces(qdot_past *h, size_t count)
{
    h->pieces.n = count;
    h->coefficients.n = count * h->n * COEFFICIENTS;
}

qdot_status
qdot_past_begin(qdot_past *h, double t, const double *y)
{
    keep_pieces(h, 0);
    h->end = t;
    return add_piece(h, t, 0, 0, y, 1);
}

qdot_status
qdot_past_add(qdot_past *h, double t, double unit, int p, const double *x, size_t stride)
{
    const double least = no_length * (fabs(t) + fabs(t - h->pieces.at[0].t));
    size_t count = h->pieces.n;

    while (count > 1 && h->pieces.at[count - 1].t >= (count > 2 ? t - least : t))
        count--;
    keep_pieces(h, count);
    return add_piece(h, t, 1 / unit, p, x, stride);
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

/* Whether u is behind the end by more than rounding of times: nothing is known of it yet. */
static bool
is_behind_end(const qdot_past *h, double u)
{
    return u - h->end > 1e-12 * (fabs(u) + fabs(h->end));
}

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

double
qdot_past_lookup(double handle, double x)
{
    const long long of = qdot_past_has(handle) ? (long long)(handle - first_handle) : -1;
    const int item = (int)(of % ITEMS);
    size_t i = 0, at;

    if (of < 0 || !reading || reading->pieces.n == 0 || !isfinite(x) || item > COEFFICIENT + QDOT_PAST_ORDER)
        return NAN;
    if (item == PIECE)
        return is_behind_end(reading, x) ? NAN : (double)piece_at(reading, x);
    at = x >= 0 && x < (double)reading->pieces.n ? (size_t)x : reading->pieces.n - 1;
    if (item == KNOT)
        return reading->pieces.at[at].t;
    if (item == RATE)
        return reading->pieces.at[at].rate;
    while (i < reading->n && reading->called[i] != (uint32_t)(of / ITEMS))
        i++;
    return i < reading->n ? reading->coefficients.at[(at * reading->n + i) * COEFFICIENTS + (size_t)(item - COEFFICIENT)]
                          : NAN;
}

void
qdot_past_bounds(double x, double *lo, double *hi)
{
    size_t at;

    *lo = *hi = NAN;
    if (!reading || reading->pieces.n == 0 || !isfinite(x))
        return;
    at = piece_at(reading, x);
    *lo = at == 0 ? -INFINITY : reading->pieces.at[at].t;
    *hi = at + 1 < reading->pieces.n ? reading->pieces.at[at + 1].t : reading->end;
}

bool
qdot_past_jumps(double x)
{
    const size_t at = reading && reading->pieces.n > 0 && isfinite(x) ? piece_at(reading, x) : 0;

    return reading && at + 1 < reading->pieces.n && reading->pieces.at[at + 1].jumps;
}
