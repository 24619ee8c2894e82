/* stage-sides.c -- finds on which side of each surface a state lies; nested surfaces from the inside out. */
#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "sim/course/stage.h"
#include "sim/model/delay.h"
#include "sim/model/layer.h"
#include "sim/model/term-magnitude.h"

/* Relative error of evaluating u, in units of the sum of the magnitudes of its terms. */
static const double rounding = 4 * DBL_EPSILON;

/* Relative to max(1, |y_i|), the change `which` (0 or 1) of component i of a state, to test whether u is constant. The
 * sines of whole numbers are linearly independent over the rationals: a change by c/(i + 1) would leave 3 y_2 - 4 y_3
 * as it is. */
static double
test_displacement(size_t which, size_t i)
{
    return ldexp(sin((double)(2 * i + which + 1)), -8);
}

/* The largest value of a floor: beyond it all doubles are integers. */
static const double most_steps = 0x1p53;

/* The function values u of all surfaces with their rounding errors, for the present sides. */
typedef struct {
    const qdot_stage *s;
    size_t m, n; /* number of surfaces; number of components of the state */
    double t;
    const double *y;
    double *u, *noise; /* [m] values of the surfaces' functions u; their uncertainty by rounding of the state and of u */
    bool *flat;        /* [m] small changes of the state change u only by rounding */
    double *before;    /* [m] u with the sides of the previous pass */
    uint8_t *open; /* for each gate (if, max, abs), then each surface [m]: whether it has to be evaluated */
    double *out, *in, *work;
} decision;

size_t
qdot_stage_inputs(const qdot_stage *s, qdot_expr *in)
{
    size_t k = 0;

    for (uint32_t order = 0; order < 2; order++)
        for (size_t i = 0; i < s->n; i++)
            in[k++] = qdot_symbol_jet(s->scene->pool,
                                      qdot_parameter_states_coordinate(s->scene, s->request, i),
                                      order);
    in[k++] = QDOT_T;
    return k;
}

/* Whether e has a lookup and derivatives 0 by all of these symbols [k]: it is constant between the points of tables. */
static bool
is_constant_in_pieces(qdot_pool *pool, qdot_expr e, size_t k, const qdot_expr *in)
{
    bool constant = qdot_expr_find_function(pool, e, 1, (qdot_fun_id[]){QDOT_LOOKUP}, QDOT_NIL) != QDOT_NIL;

    for (size_t i = 0; i < k && constant; i++)
        constant = qdot_diff(pool, e, in[i]) == QDOT_ZERO;
    return constant;
}

/* Fill s->in_pieces for surfaces with functions u of the symbols in [k]. */
static qdot_status
find_surfaces_in_pieces(qdot_stage *s, size_t k, const qdot_expr *in, const qdot_expr *u)
{
    const size_t m = qdot_switches_own(&s->switches);

    s->in_pieces = qdot_calloc(m + 1, sizeof *s->in_pieces);
    for (size_t i = 0; i < m && s->in_pieces; i++)
        s->in_pieces[i] = is_constant_in_pieces(s->scene->pool, u[i], k, in);
    return s->in_pieces ? QDOT_OK : QDOT_ENOMEM;
}

qdot_status
qdot_stage_lower_sides(qdot_stage *s)
{
    qdot_pool *pool = s->scene->pool;
    const size_t n = s->n, m = qdot_switches_own(&s->switches);
    size_t k = 0;
    qdot_expr *u = qdot_calloc(2 * m + 1, sizeof *u);
    qdot_expr *in = qdot_calloc(2 * n + 1 + m, sizeof *in);
    qdot_status status = u && in ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK)
        k = qdot_stage_inputs(s, in);
    for (size_t i = 0; i < m && status == QDOT_OK; i++) {
        in[k++] = s->switches.surfaces.at[i].side;
        status = qdot_switches_freeze(&s->switches, NULL, NULL, 1, &s->switches.surfaces.at[i].u,
                                      u + i);
        u[m + i] = qdot_term_magnitude(pool, u[i]);
    }
    if (status == QDOT_OK)
        status = find_surfaces_in_pieces(s, 2 * n + 1, in, u);
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    if (status == QDOT_OK)
        status = qdot_tape_new(pool, k, in, 2 * m, u, &s->sides);
    qdot_free(u);
    qdot_free(in);
    return status;
}

static void
free_decision(decision *d)
{
    qdot_free(d->u);
    qdot_free(d->flat);
    qdot_free(d->open);
}

static qdot_status
begin_decision(decision *d, const qdot_stage *s, double t, const double *y)
{
    size_t m = qdot_switches_own(&s->switches);
    const size_t n = 2 * s->n;

    *d = (decision){.s = s, .m = m, .n = n, .t = t, .y = y};
    d->u = qdot_calloc(5 * m + n + 1 + m + qdot_tape_work(s->sides) + 1, sizeof *d->u);
    d->flat = qdot_calloc(m, sizeof *d->flat);
    d->open = qdot_calloc(s->switches.gates.gates.n + m + 1, sizeof *d->open);
    if (!d->u || !d->flat || !d->open)
        return QDOT_ENOMEM;
    d->noise = d->u + m;
    d->before = d->noise + m;
    d->out = d->before + m;
    d->in = d->out + 2 * m;
    d->work = d->in + n + 1 + m;
    memcpy(d->in, y, n * sizeof *d->in);
    d->in[n] = t;
    return QDOT_OK;
}

/* Evaluate the functions of all surfaces at the state d->in, for the given sides, into d->out. */
static void
evaluate_surfaces(decision *d, const int64_t *side)
{
    for (size_t i = 0; i < d->m; i++)
        d->in[d->n + 1 + i] =
            side[i] == QDOT_SIDE_SLIDES || side[i] == QDOT_SIDE_IDLE ? 0 : (double)side[i];
    qdot_tape_eval(d->s->sides, d->in, d->out, d->work);
    memcpy(d->in, d->y, d->n * sizeof *d->in);
    d->in[d->n] = d->t;
}

/* Whether component i of the state is a parameter that events set: it is constant between events. */
static bool
is_parameter(const decision *d, size_t i)
{
    return i < d->n && i % d->s->n >= d->s->n - d->s->n_states;
}

/* Compute u, its error and whether u is flat, of all surfaces, for the given sides. */
static void
measure_surfaces(decision *d, const int64_t *side)
{
    const double forwards = d->s->back ? -1 : 1; /* in time, where tables of data are read on */

    evaluate_surfaces(d, side);
    for (size_t i = 0; i < d->m; i++) {
        d->u[i] = d->out[i];
        d->noise[i] = rounding * d->out[d->m + i];
        d->flat[i] = true;
    }
    for (size_t k = 0; k <= d->n; k++) {
        d->in[k] += (k == d->n ? forwards : 1) * 2 * DBL_EPSILON * (k == d->n ? fabs(d->in[k]) : d->in[k]);
        evaluate_surfaces(d, side);
        for (size_t i = 0; i < d->m; i++)
            d->noise[i] += isfinite(d->out[i]) ? fabs(d->out[i] - d->u[i]) : 0;
    }
    for (size_t k = 0; k < 2; k++) {
        for (size_t i = 0; i <= d->n; i++)
            if (!is_parameter(d, i))
                d->in[i] += (i == d->n ? forwards * fabs(test_displacement(k, i)) : test_displacement(k, i)) * fmax(1, fabs(d->in[i]));
        evaluate_surfaces(d, side);
        for (size_t i = 0; i < d->m; i++)
            d->flat[i] = d->flat[i] && (d->s->in_pieces[i] || fabs(d->out[i] - d->u[i]) <=
                                                                  fmax(d->noise[i], rounding * d->out[d->m + i]));
    }
}

/* Find the surfaces that affect the equations if the other surfaces have the given sides. */
static void
find_relevant_surfaces(decision *d, const int64_t *side)
{
    const qdot_gates *gates = &d->s->switches.gates;

    if (gates->branches)
        qdot_gates_open(gates, side, NULL, d->open);
    else
        memset(d->open + gates->gates.n, 1, d->m);
}

static bool
is_surface_evaluated(const decision *d, size_t i)
{
    return d->open[d->s->switches.gates.gates.n + i] != 0;
}

/* Decide the side of surface i from u; if u = 0, it keeps the side `kept`, unless `anew` is set. */
static qdot_status
decide_side(const decision *d, size_t i, bool anew, int64_t kept, int64_t *side)
{
    const bool steps = d->s->switches.surfaces.at[i].steps;
    const double u = d->u[i], near = steps ? round(u) : 0;
    const double layer = d->s->switches.surfaces.at[i].layer;
    const bool on = fabs(u - near) <= d->noise[i];

    *side = kept;
    if (isnan(u) || (!anew && !d->flat[i] && fabs(u - d->before[i]) <= d->noise[i]))
        return QDOT_OK;
    if (steps && !(fabs(u) < most_steps))
        return qdot_fail(QDOT_EDOMAIN, "a floor or mod is too large at t = %.15g", d->t);
    if (layer > 0)
        *side = fabs(u) <= layer ? 0 : u > 0 ? 1 : -1;
    else if (!on)
        *side = steps ? (int64_t)floor(u) : u > 0 ? 1 : -1;
    else if (d->flat[i] || (steps && (anew || kept != (int64_t)near - 1)))
        *side = (int64_t)near;
    else if (anew)
        *side = 1;
    return QDOT_OK;
}

/* Find the accelerations f_i/M_ii at the start, into a [n]; 0 if not finite or with multipliers. */
static qdot_status
find_start_accelerations(const decision *d, double *a)
{
    const qdot_switches *s = &d->s->switches;
    const size_t n = d->s->n - d->s->n_states;
    qdot_expr *e = qdot_calloc(2 * n + d->n + 1, sizeof *e), *in = e + 2 * n;
    qdot_tape *tape = NULL;
    double *out = NULL;
    qdot_status status = e ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        e[i] = qdot_expr_arg(s->pool, s->forcing, (uint32_t)i);
        e[n + i] = qdot_expr_arg(s->pool, s->mass, (uint32_t)(i * n + i));
        if (qdot_expr_node(s->pool, e[i])->holds & QDOT_HAS_MULTIPLIER)
            e[i] = QDOT_ZERO;
    }
    if (status == QDOT_OK)
        qdot_stage_inputs(d->s, in);
    if (status == QDOT_OK)
        status = qdot_tape_new(s->pool, d->n + 1, in, 2 * n, e, &tape);
    if (status == QDOT_OK)
        out = qdot_calloc(2 * n + qdot_tape_work(tape) + 1, sizeof *out);
    if (status == QDOT_OK && !out)
        status = QDOT_ENOMEM;
    if (status == QDOT_OK)
        qdot_tape_eval(tape, d->in, out, out + 2 * n);
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        a[i] = isfinite(out[i] / out[n + i]) ? out[i] / out[n + i] : 0;
    qdot_free(out);
    qdot_tape_free(tape);
    qdot_free(e);
    return status;
}

/* Find |du/dt| of all surfaces, rate [m], if each coordinate q_i changes at the rate w[i]. */
static void
surface_rates(decision *d, const int64_t *side, const double *w, double *rate)
{
    const double h = 0x1p-20;

    for (size_t i = 0; i < d->s->n - d->s->n_states; i++)
        d->in[i] += h * w[i];
    evaluate_surfaces(d, side);
    for (size_t i = 0; i < d->m; i++)
        rate[i] = fabs(d->out[i] - d->u[i]) / h;
}

qdot_status
qdot_stage_layers(qdot_stage *s, double t, const double *y, double latest, double tol)
{
    const size_t m = qdot_switches_own(&s->switches);
    bool some = false;
    decision d;
    int64_t *side;
    double *a, *speed, *bend;
    qdot_status status;

    for (size_t i = 0; i < m; i++)
        some |= s->switches.surfaces.at[i].power > 0;
    if (!some)
        return QDOT_OK;
    side = qdot_calloc(m, sizeof *side);
    a = qdot_calloc(s->n + 2 * m, sizeof *a);
    speed = a + s->n;
    bend = speed + m;
    status = begin_decision(&d, s, t, y);
    if (!side || !a)
        status = QDOT_ENOMEM;
    if (status == QDOT_OK)
        status = find_start_accelerations(&d, a);
    if (status == QDOT_OK) {
        evaluate_surfaces(&d, side);
        memcpy(d.u, d.out, m * sizeof *d.u);
        surface_rates(&d, side, y + s->n, speed);
        surface_rates(&d, side, a, bend);
        for (size_t i = 0; i < m; i++)
            speed[i] = fmax(fmax(speed[i], sqrt(2 * bend[i] * fabs(d.u[i]))), fabs(d.u[i]));
        qdot_layers_measure(s->switches.pool, m, s->switches.surfaces.at, speed, latest, tol);
    }
    qdot_free(side);
    qdot_free(a);
    free_decision(&d);
    return status;
}

qdot_status
qdot_stage_sides(const qdot_stage *s, double t, const double *y, const int64_t *old, int64_t *side)
{
    /* surfaces other than contacts; contacts keep their side */
    const size_t m = qdot_switches_own(&s->switches);
    int64_t *kept;
    decision d;
    bool changed = true;
    qdot_status status;

    if (m == 0)
        return QDOT_OK;
    kept = qdot_calloc(m, sizeof *kept);
    status = begin_decision(&d, s, t, y);
    if (!kept)
        status = QDOT_ENOMEM;
    if (status == QDOT_OK) {
        if (old) {
            memcpy(kept, side, m * sizeof *kept);
            measure_surfaces(&d, old);
            memcpy(d.before, d.u, m * sizeof *d.before);
        } else {
            memset(side, 0, m * sizeof *side);
        }
    }
    /* repeat at most as often as surfaces and branches can be nested */
    for (size_t pass = 0; pass <= 2 * m && changed && status == QDOT_OK; pass++) {
        measure_surfaces(&d, side);
        find_relevant_surfaces(&d, side);
        changed = false;
        for (size_t i = 0; i < m && status == QDOT_OK; i++) {
            const int64_t was = side[i];

            if (is_surface_evaluated(&d, i))
                status = decide_side(&d, i, !old || old[i] == QDOT_SIDE_IDLE || kept[i] == QDOT_SIDE_IDLE,
                                     kept[i] == QDOT_SIDE_IDLE ? 0 : kept[i], &side[i]);
            else
                side[i] = QDOT_SIDE_IDLE;
            changed |= side[i] != was;
        }
    }
    qdot_free(kept);
    free_decision(&d);
    return status;
}

qdot_status
qdot_stage_sign_ahead(const qdot_stage *s, size_t surface, double t, double until, const double *y, const int64_t *side, int *sign)
{
    const qdot_expr u = s->switches.surfaces.at[surface].u;
    decision d;
    qdot_status status;

    *sign = 0;
    if (surface >= qdot_switches_own(&s->switches) || s->switches.surfaces.at[surface].steps ||
        (qdot_expr_node(s->switches.pool, u)->holds & (QDOT_HAS_COORD | QDOT_HAS_VELOCITY)))
        return QDOT_OK;
    status = begin_decision(&d, s, t, y);
    for (double part = 0x1p-30; status == QDOT_OK && part < 1 && *sign == 0; part *= 2) {
        d.in[d.n] = t + part * (until - t);
        evaluate_surfaces(&d, side);
        if (fabs(d.out[surface]) > rounding * d.out[d.m + surface])
            *sign = d.out[surface] > 0 ? 1 : -1;
    }
    free_decision(&d);
    return status;
}

qdot_status
qdot_stage_describe(const qdot_stage *s, size_t surface, int64_t side, qdot_text *out)
{
    const qdot_surface *x = &s->switches.surfaces.at[surface];

    for (size_t c = 0; x->puck > 0 && c < s->switches.pucks.at[x->puck - 1].k; c++) {
        qdot_text_add(out, c > 0 ? " = " : "");
        QDOT_TRY(qdot_print(s->switches.pool, s->switches.pucks.at[x->puck - 1].rest[c], QDOT_PLAIN,
                            out));
    }
    if (x->puck == 0)
        QDOT_TRY(qdot_print(s->switches.pool, qdot_delay_written(s->switches.pool, x->u), QDOT_PLAIN, out));
    qdot_text_format(out, " = %" PRId64, x->steps ? side : 0);
    return qdot_text_status(out);
}
