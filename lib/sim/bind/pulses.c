/* pulses.c -- halves a step until no force can act unseen between the points at which it was evaluated. */
#include "sim/bind/pulses.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"

enum {
    FEW = 16,
    MOST = QDOT_CHEBYSHEV_MOST,
    DEEPEST = 46,
    MOST_PARTS = 2000,
    LEAST_PARTS = 50
};

/* What is nothing beside the largest value; what a sum has to be beyond, in tolerances of largest
 * values and in tolerances. */
static const double nothing = 1e-6, tolerances = 10, least = 1e-11, floor_of_it = 0.01;

/* The largest change of u within a step at which power series and differences still resolve a force e^u. */
static const double short_reach = 10;

/* The share of the allowed error granted to unexamined intervals: for all of them together, and for each. */
static const double unknown_in_all = 0.5, unknown_on_one = 0.1;

/* A part begins what is missed if it is that much shorter than the step, and its values change by
 * that much of what those of any part do. */
static const double brief = 0.125, felt = 1e-3;

void
qdot_pulses_clear(qdot_pulses *p)
{
    qdot_polynomial_bounds_clear(&p->bounds);
    qdot_free(p->in);
    *p = (qdot_pulses){0};
}

qdot_status
qdot_pulses_init(qdot_pulses *p, const qdot_plan *plan, const qdot_tape *tape,
                 qdot_disc_hiding hiding, int nodes)
{
    const size_t n = plan->n, outputs = qdot_tape_outputs(tape),
                 inputs = qdot_tape_inputs(tape);
    const size_t m = plan->constraints ? n : outputs;
    double *at;

    *p = (qdot_pulses){.tape = tape,
                       .n = n,
                       .m = m,
                       .hiding = hiding,
                       .nodes = nodes,
                       .most = MOST_PARTS};
    QDOT_TRY(qdot_polynomial_bounds_init(&p->bounds, tape, 2 * n));
    at = qdot_calloc(inputs + qdot_tape_work(tape) + outputs + (2 * MOST + 6) * m +
                         (MOST_PARTS + DEEPEST + 1) * (m + 1) + 4 * n,
                     sizeof *at);
    if (!at)
        return QDOT_ENOMEM;
    p->in = at;
    p->work = p->in + inputs;
    p->out = p->work + qdot_tape_work(tape);
    p->largest = p->out + outputs;
    p->beyond = p->largest + m;
    p->all = p->beyond + m;
    p->allowed = p->all + m;
    p->left = p->allowed + m;
    p->values = p->left + m;
    p->whole = p->values + m * MOST;
    p->ends = p->whole + m * MOST;
    p->parts = p->ends + 4 * p->n;
    return QDOT_OK;
}

/* The mean velocity of coordinate i over the step, minus the average of its velocities at both ends of the step. */
static double
velocity_discrepancy(const qdot_pulses *p, const qdot_pulses_step *s, size_t i)
{
    return (s->to[i] - s->from[i]) / (s->b - s->a) - 0.5 * (s->from[p->n + i] + s->to[p->n + i]);
}

/* Interpolate positions and velocities at t by the cubic polynomial through both ends of the step. */
static void
interpolate(const qdot_pulses *p, const qdot_pulses_step *s, double t, double *y)
{
    const size_t n = p->n;
    const double h = s->b - s->a, x = (t - s->a) / h, left = 1 - x;

    for (size_t i = 0; i < n; i++) {
        const double v0 = s->from[n + i], v1 = s->to[n + i];
        const double bend = velocity_discrepancy(p, s, i);

        y[n + i] = v0 * left + v1 * x + 6 * x * left * bend;
        y[i] = s->from[i] +
               h * x * (v0 * (1 - 0.5 * x) + 0.5 * v1 * x + x * (3 - 2 * x) * bend);
    }
}

/* Evaluate the state at t: by the step's own interpolation if it has one, else by cubic polynomials. */
static qdot_status
evaluate_state(qdot_pulses *p, qdot_pulses_step *s, double t, double *y)
{
    if (s->read)
        return s->read(t, y, s->user);
    interpolate(p, s, t, y);
    return QDOT_OK;
}

static double
chebyshev_time(double a, double b, int nodes, int j)
{
    return qdot_chebyshev_place(a, b, qdot_chebyshev_node(nodes, j));
}

/* Evaluate the tape's outputs at the Chebyshev nodes of [a, b]; *finite: all are finite numbers. */
static qdot_status
sample_outputs(qdot_pulses *p, qdot_pulses_step *s, double a, double b, int nodes, bool *finite)
{
    *finite = true;
    for (int j = 0; j < nodes && *finite; j++) {
        const double t = chebyshev_time(a, b, nodes, j);

        QDOT_TRY(evaluate_state(p, s, t, p->in));
        p->in[2 * p->n] = t;
        qdot_tape_eval(p->tape, p->in, p->out, p->work);
        s->evaluations++;
        qdot_polynomial_bounds_sample(&p->bounds, j, p->in);
        for (size_t i = 0; i < p->m; i++) {
            p->values[i * MOST + (size_t)j] = p->out[i];
            *finite = *finite && isfinite(p->out[i]);
        }
    }
    for (size_t i = 0; i < p->m && *finite; i++)
        for (int j = 0; j < nodes; j++)
            p->largest[i] = fmax(p->largest[i], fabs(p->values[i * MOST + (size_t)j]));
    return QDOT_OK;
}

/* Whether the polynomials through the values represent the functions, up to a negligible error, or
 * these change by nothing more, or by so little over the part that it may be missed. False if a
 * function is singular. */
static bool
shows_no_pulse(qdot_pulses *p, double a, double b, int nodes)
{
    double c[MOST];
    bool enclosed = false, unknown = false;

    qdot_polynomial_bounds_look(&p->bounds, a, b, nodes, NULL, NULL);
    for (size_t i = 0; i < p->m; i++) {
        const double enough = nothing * p->largest[i] + 1e-300;
        double width;

        qdot_chebyshev_fit(nodes, p->values + i * MOST, c);
        if (p->bounds.miss[i] + qdot_chebyshev_tail(nodes, c) <= enough)
            continue;
        if (!enclosed)
            qdot_polynomial_bounds_enclose(&p->bounds, a, b, nodes);
        enclosed = true;
        width = p->bounds.box[i].hi - p->bounds.box[i].lo;
        if (width <= enough)
            continue;
        if (!(width * fabs(b - a) <= fmin(unknown_on_one * p->allowed[i], p->left[i])))
            return false;
        unknown = true;
    }
    for (size_t i = 0; i < p->m && unknown; i++)
        p->left[i] -= (p->bounds.box[i].hi - p->bounds.box[i].lo) * fabs(b - a);
    return true;
}

/* Add the difference between the part's values and the step's polynomials; *peak: its largest yet,
 * at s->t. */
static void
record_part(qdot_pulses *p, qdot_pulses_step *s, double a, double b, double *peak)
{
    double *part = p->parts + p->n_parts++ * (p->m + 1);

    part[0] = a;
    for (size_t i = 0; i < p->m; i++) {
        const double *v = p->values + i * MOST;
        double sum = 0, all = 0, low = v[0], high = v[0];

        for (int j = 0; j < FEW; j++) {
            const double t = chebyshev_time(a, b, FEW, j),
                         x = (2 * t - s->a - s->b) / (s->b - s->a);
            const double d =
                fabs(v[j] - qdot_chebyshev_at(p->nodes, p->whole + i * MOST, x));

            sum += d / FEW;
            all += fabs(v[j]) / FEW;
            low = fmin(low, v[j]);
            high = fmax(high, v[j]);
            if (d > *peak * p->largest[i]) {
                *peak = d / p->largest[i];
                s->t = t;
            }
        }
        p->beyond[i] += sum * fabs(b - a);
        p->all[i] += all * fabs(b - a);
        part[i + 1] = (high - low) * fabs(b - a);
    }
}

/* The largest allowed error of an output whose integral over the step is `all`. */
static double
allowed_error(const qdot_pulses_step *s, double all)
{
    return fmax(fmax(tolerances * s->tol, least) * all, floor_of_it * s->tol);
}

/* Set the error allowed for each output, from its values at the Chebyshev nodes of the step. */
static void
set_allowed_errors(qdot_pulses *p, const qdot_pulses_step *s)
{
    for (size_t i = 0; i < p->m; i++) {
        double all = 0;

        for (int j = 0; j < p->nodes; j++)
            all += fabs(p->values[i * MOST + (size_t)j]) / p->nodes;
        p->allowed[i] = allowed_error(s, all * fabs(s->b - s->a));
        p->left[i] = unknown_in_all * p->allowed[i];
    }
}

/* Whether the step is so short that what falls off like an exponential cannot fall off on it: its
 * state within what the ends and their velocities let it be, and as much again. */
static bool
is_short_step(qdot_pulses *p, const qdot_pulses_step *s)
{
    const size_t n = p->n;
    const double h = fabs(s->b - s->a);
    qdot_polynomial_bounds *bounds = &p->bounds;
    size_t last;

    for (size_t i = 0; i < n; i++) {
        const double v0 = s->from[n + i], v1 = s->to[n + i], bend = fabs(velocity_discrepancy(p, s, i));

        bounds->centre[i] = 0.5 * (s->from[i] + s->to[i]);
        bounds->radius[i] = h * (fmax(fabs(v0), fabs(v1)) + 2 * bend);
        bounds->centre[n + i] = 0.5 * (v0 + v1);
        bounds->radius[n + i] = fabs(v1 - v0) + 4 * bend;
    }
    bounds->centre[2 * n] = 0.5 * (s->a + s->b);
    bounds->radius[2 * n] = 0.5 * h;
    return qdot_disc_hiders(p->tape, p->hiding, bounds->centre, bounds->radius, short_reach,
                            &last, bounds->work) == 0;
}

/* Whether the interval [a, b] is so short that no force can rise and fall within it. */
static qdot_status
is_short_part(qdot_pulses *p, qdot_pulses_step *s, double a, double b, bool *is)
{
    const qdot_pulses_step part = {.a = a, .b = b, .from = p->ends, .to = p->ends + 2 * p->n};

    QDOT_TRY(evaluate_state(p, s, a, p->ends));
    QDOT_TRY(evaluate_state(p, s, b, p->ends + 2 * p->n));
    *is = is_short_step(p, &part);
    return QDOT_OK;
}

/* Examine the parts of a step whose points do not suffice, from left to right; *all: as many as that
 * takes. */
static qdot_status
examine_parts(qdot_pulses *p, qdot_pulses_step *s, bool *all)
{
    double ends[DEEPEST + 1], from = s->a, peak = 0;
    bool finite, sure;
    int looked = 0;

    memset(p->beyond, 0, p->m * sizeof *p->beyond);
    memset(p->all, 0, p->m * sizeof *p->all);
    set_allowed_errors(p, s);
    p->n_parts = 0;
    ends[0] = s->b;
    for (int depth = 1; depth > 0; looked++) {
        const double to = ends[depth - 1];

        QDOT_TRY(qdot_interrupt_check());
        QDOT_TRY(sample_outputs(p, s, from, to, FEW, &finite));
        sure = !finite || shows_no_pulse(p, from, to, FEW);
        if (!sure)
            QDOT_TRY(is_short_part(p, s, from, to, &sure));
        if (!sure && depth < DEEPEST && looked < p->most) {
            ends[depth++] = 0.5 * (from + to);
            continue;
        }
        if (finite)
            record_part(p, s, from, to, &peak);
        from = to;
        depth--;
    }
    p->parts[p->n_parts * (p->m + 1)] = s->b;
    *all = looked < p->most;
    return QDOT_OK;
}

/* The time at which a missed force of output i begins: the first short interval with a change of
 * that output. */
static void
find_pulse_start(const qdot_pulses *p, size_t i, qdot_pulses_step *s)
{
    const size_t row = p->m + 1;
    const double most = brief * fabs(s->b - s->a), *end = p->parts + p->n_parts * row;
    double change = 0;

    s->begins = s->a;
    s->part = most;
    for (const double *part = p->parts; part < end; part += row)
        if (fabs(part[row] - part[0]) <= most)
            change = fmax(change, part[i + 1]);
    for (const double *part = p->parts; part < end; part += row)
        if (fabs(part[row] - part[0]) <= most && part[i + 1] >= felt * change) {
            s->begins = part[0];
            s->part = fabs(part[row] - part[0]);
            return;
        }
}

/* Find the smallest disc in the complex plane around an interval of four numbers, enlarged by rounding. */
static void
enclosing_disc(const double *x, double *centre, double *radius)
{
    const double lo = fmin(fmin(x[0], x[1]), fmin(x[2], x[3])),
                 hi = fmax(fmax(x[0], x[1]), fmax(x[2], x[3]));

    *centre = 0.5 * (lo + hi);
    *radius = 0.5 * (hi - lo) + 4 * DBL_EPSILON * fmax(fabs(lo), fabs(hi));
}

/* Find discs that enclose the cubics of positions and velocities, from their Bezier control points. */
static void
enclose_cubics(qdot_pulses *p, const qdot_pulses_step *s)
{
    const size_t n = p->n;
    const double third = (s->b - s->a) / 3;
    qdot_polynomial_bounds *bounds = &p->bounds;

    for (size_t i = 0; i < n; i++) {
        const double x0 = s->from[i], x1 = s->to[i], v0 = s->from[n + i], v1 = s->to[n + i];
        const double between = 0.5 * (v0 + v1) + 3 * velocity_discrepancy(p, s, i);

        enclosing_disc((double[]){x0, x0 + third * v0, x1 - third * v1, x1}, bounds->centre + i,
                       bounds->radius + i);
        enclosing_disc((double[]){v0, between, between, v1}, bounds->centre + n + i,
                       bounds->radius + n + i);
    }
}

/* Whether the polynomial with the Chebyshev coefficients `slope` has one sign, tested on halves to
 * the given depth. */
static bool
is_monotonic_polynomial(const double *slope, int depth)
{
    double parts[2][FEW - 1];

    if (qdot_chebyshev_sign(FEW - 1, slope) != 0)
        return true;
    if (depth == 0)
        return false;
    qdot_chebyshev_halves(FEW - 1, slope, parts[0], parts[1]);
    return is_monotonic_polynomial(parts[0], depth - 1) && is_monotonic_polynomial(parts[1], depth - 1);
}

/* Whether the argument of tape instruction k is monotonic in the step. */
static bool
has_monotonic_argument(qdot_pulses *p, const qdot_pulses_step *s, size_t k)
{
    enum { depth = 4 };
    double values[FEW], c[FEW], slope[FEW], result;

    for (int j = 0; j < FEW; j++) {
        p->in[2 * p->n] = chebyshev_time(s->a, s->b, FEW, j);
        interpolate(p, s, p->in[2 * p->n], p->in);
        values[j] = qdot_disc_argument(p->tape, k, p->in, &result, p->bounds.work);
    }
    qdot_chebyshev_fit(FEW, values, c);
    qdot_chebyshev_derivative(FEW, c, slope);
    return qdot_chebyshev_tail(FEW, c) <= nothing * qdot_chebyshev_spread(FEW, c) &&
           is_monotonic_polynomial(slope, depth);
}

/* The argument of tape instruction k at an end of the step, where the state is y and the time is t. */
static double
argument_at_end(qdot_pulses *p, size_t k, const double *y, double t)
{
    double result;

    memcpy(p->in, y, 2 * p->n * sizeof *y);
    p->in[2 * p->n] = t;
    qdot_disc_argument(p->tape, k, p->in, &result, p->bounds.work);
    return result;
}

/* Whether nothing falls off or rises on the way of the step but one function that grows with its
 * argument, of which forces are a multiple, and the argument goes one way: if the function is nearly
 * the same at the step's ends it is so on all of it. */
static bool
forces_show_at_ends(qdot_pulses *p, const qdot_pulses_step *s)
{
    qdot_polynomial_bounds *bounds = &p->bounds;
    size_t found, k;

    double most;

    enclose_cubics(p, s);
    found = qdot_disc_hiders(p->tape, p->hiding, bounds->centre, bounds->radius,
                             0.5 * short_reach, &k, bounds->work);
    if (found != 1)
        return found == 0;
    return qdot_disc_is_plain(p->tape, k, bounds->centre, bounds->radius, &most,
                              bounds->work) &&
           most * fabs(argument_at_end(p, k, s->to, s->b) - argument_at_end(p, k, s->from, s->a)) *
                   fabs(s->b - s->a) <=
               floor_of_it * s->tol &&
           has_monotonic_argument(p, s, k);
}

/* The error of output i due to forces that the step missed, divided by its allowed error. */
static double
missed_error_ratio(const qdot_pulses *p, const qdot_pulses_step *s, size_t i)
{
    return p->beyond[i] / allowed_error(s, p->all[i]);
}

qdot_status
qdot_pulses_look(qdot_pulses *p, qdot_pulses_step *s)
{
    size_t worst = 0;
    bool finite, all;

    s->missed = false;
    if (is_short_step(p, s) || (!s->read && forces_show_at_ends(p, s)))
        return QDOT_OK;
    qdot_polynomial_bounds_begin(&p->bounds, NULL);
    memset(p->allowed, 0, 2 * p->m * sizeof *p->allowed);
    for (int nodes = FEW; nodes <= p->nodes; nodes *= 4) {
        QDOT_TRY(sample_outputs(p, s, s->a, s->b, nodes, &finite));
        if (!finite || shows_no_pulse(p, s->a, s->b, nodes))
            return QDOT_OK;
    }
    for (size_t i = 0; i < p->m; i++)
        qdot_chebyshev_fit(p->nodes, p->values + i * MOST, p->whole + i * MOST);
    QDOT_TRY(examine_parts(p, s, &all));
    for (size_t i = 1; i < p->m; i++)
        worst = missed_error_ratio(p, s, i) > missed_error_ratio(p, s, worst) ? i : worst;
    s->missed = missed_error_ratio(p, s, worst) > 1;
    if (s->missed) {
        find_pulse_start(p, worst, s);
        p->most = MOST_PARTS;
    } else if (!all) { /* examine fewer parts next time: even the largest number might not be enough */
        p->most = p->most > 2 * LEAST_PARTS ? p->most / 2 : LEAST_PARTS;
    }
    return QDOT_OK;
}
