/* interval.c -- evaluates a tape over intervals: each value is a pair of bounds. */
#include "tape/interval.h"

#include <math.h>
#include <string.h>

#include "num/past.h"
#include "num/samples.h"
#include "tape/instruction.h"

/* --- operations that occur only in tapes ------------------------------------------------ */

static bool
is_true(qdot_interval a)
{
    return a.lo > 0 || a.hi < 0;
}

static bool
is_false(qdot_interval a)
{
    return a.lo == 0 && a.hi == 0;
}

static qdot_interval
either(bool surely, bool never)
{
    return (qdot_interval){surely, !never};
}

static double
softplus_of_double(double x)
{
    return fmax(x, 0) + log1p(exp(-fabs(x)));
}

/* The numbers of a table for all places of an interval: of pieces, from the first to the last; of what pieces have, around
 * those of these pieces. One piece of a history may hold for all. */
static qdot_interval
lookup_of_interval(qdot_interval a, qdot_interval handle)
{
    const double lo = qdot_samples_lookup(handle.lo, a.lo), hi = qdot_samples_lookup(handle.lo, a.hi), most_pieces = 64;
    const double middle = a.lo + (a.hi - a.lo) / 2;
    qdot_interval d = qdot_interval_point(lo);

    if (isnan(lo) || isnan(hi))
        return qdot_interval_whole;
    if (qdot_past_finds(handle.lo) && qdot_past_is_smooth(handle.lo, middle, a.hi - middle))
        return qdot_interval_point(qdot_past_lookup(handle.lo, middle));
    if (qdot_samples_finds(handle.lo) && lo <= hi)
        return (qdot_interval){lo, hi};
    if (!(a.hi - a.lo <= most_pieces))
        return qdot_interval_whole;
    for (double piece = a.lo; piece <= a.hi; piece++)
        d = qdot_interval_around(d, qdot_interval_point(qdot_samples_lookup(handle.lo, piece)));
    return d;
}

/* --- evaluating a tape --------------------------------------------------------------- */

size_t
qdot_interval_work(const qdot_tape *tape)
{
    return tape->places;
}

/* Apply an operation of the tape to numbers; finite results become intervals of length 0. */
static void
apply_to_numbers(const qdot_instruction *i, double a, double b, double c, qdot_interval *to,
                 qdot_interval *second)
{
    double d = 0, e = 0;

    switch (i->op) {
#define X(ID, name, operands, operations, calls, statement, ...)                         \
    case QDOT_OP_##ID:                                                                   \
        statement;                                                                       \
        break;
#include "tape/operation.def"
#undef X
    }
    (void)b, (void)c;
    *to = isfinite(d) ? qdot_interval_point(d)
          : isnan(d)  ? qdot_interval_whole
                      : qdot_interval_outward(d, d);
    *second = isfinite(e) ? qdot_interval_point(e) : qdot_interval_whole;
}

static void
interval_execute(const qdot_instruction *i, qdot_interval *work)
{
    const int operands = qdot_operations[i->op].operands;
    const qdot_interval a = work[i->x],
                        b = operands > 1 ? work[i->y] : qdot_interval_point(0);
    const qdot_interval c = operands > 2 ? work[i->z] : qdot_interval_point(0);
    const bool same = operands > 1 && i->x == i->y;
    qdot_interval d = qdot_interval_whole, e = qdot_interval_whole;

    if (qdot_interval_is_point(a) && qdot_interval_is_point(b) &&
        qdot_interval_is_point(c))
        apply_to_numbers(i, a.lo, b.lo, c.lo, &d, &e);
    else
        switch (i->op) {
#define X(ID, name, operands_of, operations, calls, statement, slopes, interval, ...)    \
    case QDOT_OP_##ID:                                                                   \
        interval;                                                                        \
        break;
#include "tape/operation.def"
#undef X
        }
    work[i->to] = d;
    if (i->op == QDOT_OP_SINCOS)
        work[i->y] = e;
}

void
qdot_interval_eval(const qdot_tape *tape, const qdot_interval *in, qdot_interval *out,
                   qdot_interval *work)
{
    if (tape->inputs)
        memcpy(work, in, tape->inputs * sizeof *work);
    for (size_t k = 0; k < tape->constants; k++)
        work[tape->inputs + k] = qdot_interval_point(tape->constant[k]);
    for (size_t k = 0; k < tape->length; k++)
        interval_execute(tape->code + k, work);
    for (size_t k = 0; k < tape->outputs; k++)
        out[k] = work[tape->output[k]];
}
