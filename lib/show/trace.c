/* trace.c -- samples a curve, with more points where it bends. */
#include "show/trace.h"

#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"

enum { ROUNDS = 14 };

static const double bend = 0.06, shortest = 0.02; /* largest angle between chords in radians; shortest chord in cm */

void
qdot_trace_clear(qdot_trace *p)
{
    qdot_free(p->s);
    for (int i = 0; i < 3; i++)
        qdot_free(p->at[i]);
    *p = (qdot_trace){0};
}

/* Allocate a traced curve with n points without values. */
static qdot_status
trace_reserve(qdot_trace *p, size_t axes, size_t n)
{
    bool good;

    *p = (qdot_trace){.n = n};
    p->s = qdot_calloc(n + 1, sizeof *p->s);
    good = p->s != NULL;
    for (size_t i = 0; i < axes; i++) {
        p->at[i] = qdot_calloc(n + 1, sizeof *p->at[i]);
        good = good && p->at[i] != NULL;
    }
    if (good)
        return QDOT_OK;
    qdot_trace_clear(p);
    return QDOT_ENOMEM;
}

qdot_status
qdot_trace_begin(const qdot_trace_source *source, size_t n, const double *s,
                  qdot_trace *p)
{
    double *values = qdot_calloc(source->axes * n + 1, sizeof *values);
    qdot_status status = values == NULL ? QDOT_ENOMEM : QDOT_OK;

    *p = (qdot_trace){0};
    if (status == QDOT_OK)
        status = trace_reserve(p, source->axes, n);
    if (status == QDOT_OK) {
        memcpy(p->s, s, n * sizeof *s);
        status = source->values(source->user, n, s, values);
    }
    for (size_t i = 0; i < source->axes && status == QDOT_OK; i++)
        memcpy(p->at[i], values + i * n, n * sizeof *values);
    qdot_free(values);
    if (status != QDOT_OK)
        qdot_trace_clear(p);
    return status;
}

/* --- the curve as it is drawn --------------------------------------------------------- */

/* A point of the curve in cm on the figure; side: -1 or 1 for each axis whose range it exceeds. */
typedef struct {
    double at[3];
    int side[3];
    bool shown;
} place;

static place
place_of_point(const qdot_figure_view *v, const qdot_trace *p, size_t axes, size_t k)
{
    place one = {.shown = true};

    for (size_t i = 0; i < axes; i++) {
        double x = p->at[i][k], least = v->least[i], most = v->most[i];

        if (v->log[i]) {
            x = x > 0 ? log(x) : NAN;
            least = log(least);
            most = log(most);
        }
        one.shown = one.shown && isfinite(x);
        one.at[i] = (x - least) / (most - least) * v->length[i];
        one.side[i] = (x > most) - (x < least);
    }
    return one;
}

/* Whether both ends of a segment lie beyond the same side of the view. */
static bool
segment_is_outside(const place *a, const place *b)
{
    for (int i = 0; i < 3; i++)
        if (a->side[i] != 0 && a->side[i] == b->side[i])
            return true;
    return false;
}

/* Whether a segment of the curve jumps from above the visible range to below it, or back. */
static bool
jumps_across_view(const place *a, const place *b)
{
    return a->shown && b->shown && a->side[1] * b->side[1] < 0;
}

static double
segment_length(const place *a, const place *b)
{
    return hypot(hypot(b->at[0] - a->at[0], b->at[1] - a->at[1]), b->at[2] - a->at[2]);
}

/* The angle between the segments a-b and b-c. */
static double
angle_between_segments(const place *a, const place *b, const place *c)
{
    double u[3], w[3], dot = 0, cross = 0;

    for (int i = 0; i < 3; i++) {
        u[i] = b->at[i] - a->at[i];
        w[i] = c->at[i] - b->at[i];
        dot += u[i] * w[i];
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;

        cross = hypot(cross, u[j] * w[k] - u[k] * w[j]);
    }
    return atan2(cross, dot);
}

/* Mark the segments (k: from point k to k + 1) that have to be halved; returns their number. */
static size_t
mark_to_halve(const place *places, size_t n, bool jumps, bool *halve)
{
    size_t marked = 0;

    memset(halve, 0, n * sizeof *halve);
    for (size_t k = 0; k + 1 < n; k++) {
        const place *a = &places[k], *b = a + 1, *c = a + 2;

        if (a->shown != b->shown || (jumps && jumps_across_view(a, b)))
            halve[k] = true;
        if (k + 2 >= n || !a->shown || !b->shown || !c->shown)
            continue;
        if (!(angle_between_segments(a, b, c) > bend))
            continue;
        halve[k] = halve[k] || (segment_length(a, b) > shortest && !segment_is_outside(a, b));
        halve[k + 1] = segment_length(b, c) > shortest && !segment_is_outside(b, c);
    }
    for (size_t k = 0; k + 1 < n; k++)
        marked += halve[k];
    return marked;
}

/* --- adding points where a curve bends ------------------------------------------------ */

/* Insert the points of `more`, each into the segment (marked in `halve`) that it halves. */
static qdot_status
insert_points(qdot_trace *p, const qdot_trace *more, size_t axes, const bool *halve)
{
    qdot_trace all;
    size_t at = 0, next = 0;

    QDOT_TRY(trace_reserve(&all, axes, p->n + more->n));
    for (size_t k = 0; k < p->n; k++) {
        const bool follows = k + 1 < p->n && halve[k];

        for (size_t i = 0; i < axes; i++) {
            all.at[i][at] = p->at[i][k];
            if (follows)
                all.at[i][at + 1] = more->at[i][next];
        }
        all.s[at++] = p->s[k];
        if (follows)
            all.s[at++] = more->s[next++];
    }
    qdot_trace_clear(p);
    *p = all;
    return QDOT_OK;
}

/* Halve once the segments at a bend, at an end of a gap, or that jump across the view; *done: none was halved. */
static qdot_status
halve_segments(const qdot_trace_source *source, const qdot_figure_view *view,
               qdot_trace *p, bool *done)
{
    place *places = qdot_calloc(p->n, sizeof *places);
    bool *halve = qdot_calloc(p->n, sizeof *halve);
    double *s = qdot_calloc(p->n, sizeof *s);
    qdot_trace more = {0};
    qdot_status status = places && halve && s ? QDOT_OK : QDOT_ENOMEM;
    size_t n = 0;

    *done = true;
    for (size_t k = 0; k < p->n && status == QDOT_OK; k++)
        places[k] = place_of_point(view, p, source->axes, k);
    if (status == QDOT_OK && mark_to_halve(places, p->n, source->jumps, halve) > 0) {
        for (size_t k = 0; k + 1 < p->n; k++) {
            const double middle = p->s[k] + (p->s[k + 1] - p->s[k]) / 2;

            halve[k] = halve[k] && middle != p->s[k] && middle != p->s[k + 1] &&
                       p->n + n < QDOT_TRACE_MOST;
            if (halve[k])
                s[n++] = middle;
        }
        *done = n == 0;
        if (n > 0)
            status = qdot_trace_begin(source, n, s, &more);
        if (status == QDOT_OK && n > 0)
            status = insert_points(p, &more, source->axes, halve);
    }
    qdot_trace_clear(&more);
    qdot_free(places);
    qdot_free(halve);
    qdot_free(s);
    return status;
}

/* Interrupt the curve where a segment jumps across the whole visible range, as at a pole. */
static void
break_jumps(const qdot_figure_view *view, qdot_trace *p, size_t axes)
{
    for (size_t k = 0; k + 1 < p->n; k++) {
        const place a = place_of_point(view, p, axes, k), b = place_of_point(view, p, axes, k + 1);

        if (jumps_across_view(&a, &b))
            p->at[1][k] = NAN;
    }
}

qdot_status
qdot_trace_refine(const qdot_trace_source *source, const qdot_figure_view *view,
                   qdot_trace *p)
{
    bool done = false;

    for (int round = 0; round < ROUNDS && !done; round++) {
        QDOT_TRY(qdot_interrupt_check());
        QDOT_TRY(halve_segments(source, view, p, &done));
    }
    if (source->jumps)
        break_jumps(view, p, source->axes);
    return QDOT_OK;
}
