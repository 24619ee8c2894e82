/* range-seek.c -- searches extrema by intervals, and bounds the values that were not evaluated.
 *  */
#include "base/interrupt.h"
#include "sim/read/range-parts.h"

enum { NODES = 16, MOST = 256 };

/* Relative to the largest value: smaller excesses are not searched, at the end and while seeking;
 * and what is negligible in a mean. */
static const double slack = 0x1p-46, closer = 0x1p-52, nothing = 0x1p-80;

static double
size_of_extrema(const qdot_range_scan *s)
{
    const double size = fmax(fabs(s->largest), fabs(s->smallest));

    return isfinite(size) ? size : 0; /* 0: no value has been found yet */
}

static double
tolerated_excess(const qdot_range_scan *s, double x)
{
    return fmax(slack * fabs(x), QDOT_RANGE_NOISES * s->noise);
}

/* Enclose the values between a and b; ends of the step are left out by one double: values there may be isolated. */
static void
enclose_values(qdot_range_scan *s, double a, double b, int nodes)
{
    if (a == s->ends[0])
        a = nextafter(a, b);
    if (b == s->ends[1])
        b = nextafter(b, a);
    qdot_polynomial_bounds_enclose(&s->bounds, a, b, nodes);
}

/* --- searching for extrema ----------------------------------------------------------- */

/* An interval of the step with an upper bound of the values (of their negatives, to find the minimum). */
typedef struct {
    double a, b, most;
} stretch;

static qdot_status
bound_interval(qdot_range_scan *s, double sign, stretch *x)
{
    const qdot_range_part p = {.a = x->a, .b = x->b};
    double best = NAN;

    for (int j = 0; j < NODES; j++) {
        const double t = qdot_range_time(&p, qdot_chebyshev_node(NODES, j));
        double v;

        QDOT_TRY(qdot_reader_read(&s->reader, s->pieces, t, &v));
        qdot_polynomial_bounds_sample(&s->bounds, j, s->reader.in);
        if (isfinite(v) && t != s->ends[0] && t != s->ends[1])
            best = fmax(best, sign * v);
    }
    enclose_values(s, p.a, p.b, NODES);
    x->most = sign > 0 ? s->bounds.box->hi : -s->bounds.box->lo;
    if (!isnan(best))
        qdot_range_meet(s, sign * best);
    return QDOT_OK;
}

static size_t
interval_with_largest_bound(const stretch *at, size_t n)
{
    size_t k = 0;

    for (size_t i = 1; i < n; i++)
        if (at[i].most > at[k].most
            || (at[i].most == at[k].most
                && fabs(at[i].b - at[i].a) > fabs(at[k].b - at[k].a)))
            k = i;
    return k;
}

static qdot_status
search_extremum(qdot_range_scan *s, double sign)
{
    stretch at[MOST] = {{s->ends[0], s->ends[1], INFINITY}};
    size_t n = 1;

    for (size_t looked = 0; n > 0 && looked < 2 * MOST;) {
        const size_t k = interval_with_largest_bound(at, n);
        const double best = sign > 0 ? s->largest : -s->smallest;
        const qdot_range_part p = {.a = at[k].a, .b = at[k].b};
        const double middle = qdot_range_time(&p, 0);

        if (at[k].most <= best + closer * fabs(best))
            break;
        at[k] = at[--n];
        if (qdot_range_is_short(s, &p))
            continue;
        for (int half = 0; half < 2 && n < MOST; half++, looked++, n++) {
            at[n] = half == 0 ? (stretch){p.a, middle, 0} : (stretch){middle, p.b, 0};
            QDOT_TRY(bound_interval(s, sign, &at[n]));
        }
        QDOT_TRY(qdot_interrupt_check());
    }
    return QDOT_OK;
}

qdot_status
qdot_range_seek(qdot_range_scan *s)
{
    qdot_status status = QDOT_OK;

    if (s->kind != QDOT_RANGE_MIN)
        status = search_extremum(s, 1);
    if (status == QDOT_OK && s->kind != QDOT_RANGE_MAX)
        status = search_extremum(s, -1);
    return qdot_grave(status);
}

/* --- intervals left undecided -------------------------------------------------------- */

static void
record_bounds(qdot_range_scan *s, const qdot_range_part *p, double lo, double hi)
{
    s->highest = fmax(s->highest, hi);
    s->lowest = fmin(s->lowest, lo);
    s->left += (hi - lo) * fabs(p->b - p->a);
}

bool
qdot_range_is_beneath(qdot_range_scan *s, const qdot_range_part *p)
{
    const qdot_interval *box = s->bounds.box;
    bool below, above;

    enclose_values(s, p->a, p->b, p->n);
    below = box->hi <= s->largest + tolerated_excess(s, s->largest);
    above = box->lo >= s->smallest - tolerated_excess(s, s->smallest);
    if (s->kind == QDOT_RANGE_MEAN ? !(box->hi - box->lo <= nothing * size_of_extrema(s))
        : s->kind == QDOT_RANGE_MAX ? !below
        : s->kind == QDOT_RANGE_MIN ? !above
                                    : !below || !above)
        return false;
    record_bounds(s, p, box->lo, box->hi);
    return true;
}

void
qdot_range_bound_blurred(qdot_range_scan *s, const qdot_range_part *p, double low, double high)
{
    double off;

    enclose_values(s, p->a, p->b, p->n);
    off = fmin(qdot_range_miss(s, p), s->bounds.box->hi - s->bounds.box->lo);
    s->highest = fmax(s->highest, fmin(s->bounds.box->hi, high + off));
    s->lowest = fmin(s->lowest, fmax(s->bounds.box->lo, low - off));
    s->left += off * fabs(p->b - p->a);
}

void
qdot_range_leave_open(qdot_range_scan *s, const qdot_range_part *p, bool shortest)
{
    qdot_polynomial_bounds *h = &s->bounds;
    double lo, hi;

    enclose_values(s, p->a, p->b, p->n);
    lo = h->box->lo;
    hi = h->box->hi;
    /* use only the values at nodes near a pole, at a removable singularity as of sin(x)/x, or at a switch */
    if (shortest
        && (!isfinite(lo) || !isfinite(hi) || qdot_range_is_beside_switch(s, p)))
        return;
    if (qdot_polynomial_bounds_within(h, p->a, p->b, p->n) &&
        isfinite(h->out_radius[0])) {
        lo = fmax(lo, h->out[0] - h->out_radius[0]);
        hi = fmin(hi, h->out[0] + h->out_radius[0]);
    }
    if ((s->kind != QDOT_RANGE_MIN && isinf(hi)) || (s->kind != QDOT_RANGE_MAX && isinf(lo)))
        s->open = true;
    else
        record_bounds(s, p, lo, hi);
}
