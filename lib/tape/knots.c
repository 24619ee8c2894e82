/* knots.c -- follows values that are linear in time along a tape, to the tables that are read at them. */
#include "tape/knots.h"

#include <float.h>
#include <math.h>

#include "num/past.h"
#include "num/samples.h"
#include "tape/instruction.h"

bool
qdot_knots_any(const qdot_tape *tape)
{
    for (size_t k = 0; k < tape->length; k++)
        if (tape->code[k].op == QDOT_OP_LOOKUP)
            return true;
    return false;
}

/* What is known of a value: a + b t, or nothing. */
typedef struct {
    bool known;
    double a, b;
} line;

static line
combine(line x, double p, line y, double q)
{
    return (line){x.known && y.known, p * x.a + q * y.a, p * x.b + q * y.b};
}

static line
product(line x, line y)
{
    if (x.known && x.b == 0)
        return combine(y, x.a, y, 0);
    if (y.known && y.b == 0)
        return combine(x, y.a, x, 0);
    return (line){0};
}

static line
line_of_result(const qdot_instruction *i, const line *at)
{
    const line x = at[i->x], y = at[i->y], z = at[i->z];

    switch (i->op) {
    case QDOT_OP_NEG: return combine(x, -1, x, 0);
    case QDOT_OP_ADD: return combine(x, 1, y, 1);
    case QDOT_OP_SUB: return combine(x, 1, y, -1);
    case QDOT_OP_MUL: return product(x, y);
    case QDOT_OP_DIV: return y.known && y.b == 0 && y.a != 0 ? combine(x, 1 / y.a, x, 0) : (line){0};
    case QDOT_OP_MADD: return combine(product(x, y), 1, z, 1);
    case QDOT_OP_MSUB: return combine(product(x, y), 1, z, -1);
    case QDOT_OP_NMADD: return combine(z, 1, product(x, y), -1);
    default: return (line){0};
    }
}

static qdot_status
add_line(const qdot_instruction *i, const line *at, qdot_knots *knots)
{
    const line x = at[i->x], handle = at[i->z];
    const bool followed = x.known && x.b != 0;
    const qdot_knots_line new = {followed ? x.a : NAN, followed ? x.b : 0, handle.a};

    if (i->op != QDOT_OP_LOOKUP || !qdot_samples_finds(handle.a) || !(followed || qdot_past_has(handle.a)))
        return QDOT_OK;
    for (size_t k = 0; k < knots->n; k++)
        if (knots->at[k].a == new.a && knots->at[k].b == new.b && knots->at[k].handle == new.handle)
            return QDOT_OK;
    return qdot_vec_push(knots, new);
}

qdot_status
qdot_knots_find(const qdot_tape *tape, size_t time, qdot_knots *knots)
{
    line *at = qdot_calloc(tape->places + 1, sizeof *at);
    qdot_status status = at ? QDOT_OK : QDOT_ENOMEM;

    if (at && time < tape->inputs)
        at[time] = (line){true, 0, 1};
    for (size_t k = 0; k < tape->constants && at; k++)
        at[tape->inputs + k] = (line){true, tape->constant[k], 0};
    for (size_t k = 0; k < tape->length && status == QDOT_OK; k++) {
        const qdot_instruction *i = tape->code + k;
        const line result = line_of_result(i, at);

        status = add_line(i, at, knots);
        at[i->to] = result;
        if (i->op == QDOT_OP_SINCOS)
            at[i->y] = (line){0};
    }
    qdot_free(at);
    return status;
}

bool
qdot_knots_ended(const qdot_tape *tape, const double *in, double *handle, double *at)
{
    static const double near = 1e-9;
    double *work = qdot_malloc((tape->places + tape->outputs + 1) * sizeof *work);
    bool ended = false;

    for (size_t k = 0; k < tape->length && work && !ended; k++) {
        const qdot_instruction *i = tape->code + k;
        struct qdot_tape before = *tape;
        double lo, hi;

        if (i->op != QDOT_OP_LOOKUP)
            continue;
        before.length = k;
        before.outputs = 0;
        qdot_tape_eval(&before, in, work + tape->places, work);
        *handle = work[i->z];
        *at = work[i->x];
        ended = qdot_samples_range(*handle, &lo, &hi) && (*at < lo + near * (hi - lo) || *at > hi - near * (hi - lo));
    }
    qdot_free(work);
    return ended;
}

/* The last time in the piece in which a line is at t, and the first one behind it. Of the time itself these are two doubles;
 * a + b t, or a place in a period, is rounded elsewhere, and surely on this side of the knot, or that one, some roundings away. */
static void
end_of_piece(const qdot_knots_line *l, double t, int direction, double *last, double *first)
{
    const double blur = qdot_samples_blur(l->handle), u = l->a + l->b * t;
    const bool plain = l->a == 0 && l->b == 1 && blur == 0, up = l->b * direction > 0;
    double lo, hi, more, knot, inside;

    qdot_samples_bounds(l->handle, u, &lo, &hi);
    more = plain ? 0 : 4 * DBL_EPSILON * (fabs(u) + fabs(up ? hi : lo) + fabs(l->a) + blur);
    knot = up ? hi + more : plain ? nextafter(lo, -INFINITY) : lo - more;
    inside = up ? plain ? nextafter(hi, -INFINITY) : hi - more : plain ? lo : lo + more;
    *first = isfinite(knot) ? (knot - l->a) / l->b : direction * INFINITY;
    *last = isfinite(knot) ? (inside - l->a) / l->b : direction * INFINITY;
}

double
qdot_knots_next(size_t n, const qdot_knots_line *lines, double t, int direction)
{
    double next = direction * INFINITY;

    for (size_t k = 0; k < n; k++) {
        double last, first, end;

        end_of_piece(&lines[k], t, direction, &last, &first);
        end = qdot_samples_jumps(lines[k].handle) && direction * (last - t) > 0 ? last : first;
        if (direction * (end - t) > 0 && direction * (next - end) > 0)
            next = end;
    }
    return next;
}
