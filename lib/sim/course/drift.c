/* drift.c -- measures drifts max |c - c0| / max(1, |c0|) of conserved quantities along a trajectory. */
#include "sim/course/drift.h"

#include <math.h>

#include "base/interrupt.h"
#include "expr/symbol.h"
#include "series/lanes.h"
#include "sim/form/residual.h"
#include "sim/model/absent.h"
#include "sim/model/contact.h"
#include "sim/model/term-magnitude.h"

void
qdot_drifts_clear(qdot_drifts *d)
{
    for (size_t i = 0; i < d->n; i++)
        qdot_free((char *)d->at[i].name);
    qdot_free(d->at);
    *d = (qdot_drifts){0};
}

qdot_status
qdot_drifts_set(qdot_drifts *d, const qdot_drift *energy)
{
    qdot_drifts_clear(d);
    d->at = qdot_calloc(1, sizeof *d->at);
    if (!d->at)
        return QDOT_ENOMEM;
    *d->at = *energy;
    d->at->name = qdot_strdup(energy->name);
    if (!d->at->name)
        return QDOT_ENOMEM;
    d->n = 1;
    d->energy = true;
    return QDOT_OK;
}

/* Whether the equations switch at a point, which is stored twice: there sign(0) is 0, on
 * neither side. */
static bool
is_switching_interval(const qdot_trajectory *tr, size_t piece, size_t k)
{
    const qdot_trajectory_piece *at = tr->pieces.at;

    return (piece > 0 && at[piece].first == k && !at[piece].jumped)
           || (piece + 1 < tr->pieces.n && at[piece + 1].first == k + 1
               && !at[piece + 1].jumped);
}

/* Write point k of the trajectory into one lane of the tape's inputs, for evaluation of several points at once. */
static void
load_lane(const qdot_trajectory *tr, size_t k, size_t lane, double *in)
{
    const double *y = tr->y + k * tr->n;

    for (size_t i = 0; i < tr->n; i++)
        in[i * QDOT_LANES + lane] = y[i];
    in[tr->n * QDOT_LANES + lane] = tr->t[k];
}

/* The quantity at as many points as there are lanes, from the first on; c one group. Lanes beyond
 * the last point repeat it. */
static void
drift_evaluate(const qdot_tape *tape, const qdot_trajectory *tr, size_t first, double *in,
               double *c, double *work)
{
    for (size_t l = 0; l < QDOT_LANES; l++)
        load_lane(tr, first + l < tr->count ? first + l : tr->count - 1, l, in);
    qdot_lanes_eval(tape, in, c, work);
}

/* Whether a contact with a moving surface, which does work, holds the motion in this mode. */
static bool
is_driven(const qdot_stage *stage, size_t mode)
{
    for (size_t i = stage ? qdot_switches_own(&stage->switches) : 0; stage && i < stage->switches.surfaces.n; i++)
        if (stage->modes.at[mode]->side[i] == QDOT_SIDE_SLIDES && qdot_contacts_moves(&stage->switches, i))
            return true;
    return false;
}

/* An event that changes a quantity by more than this, relative to max(1, |quantity|), does not conserve it. */
static const double of_event = 1e-10;

static qdot_status
measure_drift(const qdot_tape *tape, const qdot_trajectory *tr, const qdot_stage *stage, qdot_drift *drift)
{
    size_t n = tr->n;
    double *in = qdot_malloc(QDOT_LANES * (n + 1) * sizeof *in);
    double *work = qdot_malloc(QDOT_LANES * (qdot_tape_work(tape) + 1) * sizeof *work);
    double c[QDOT_LANES], start = 0, last = 0;
    qdot_status status = in && work ? QDOT_OK : QDOT_ENOMEM;
    size_t piece = 0;

    drift->drift = 0;
    for (size_t k = 0; k < tr->count && status == QDOT_OK; k++) {
        double change;

        if (k % 1024 == 0)
            status = qdot_interrupt_check();
        if (k % QDOT_LANES == 0)
            drift_evaluate(tape, tr, k, in, c, work);
        change = c[k % QDOT_LANES];
        if (k == 0)
            drift->start = start = change;
        /* a change made by an event is not drift */
        for (; piece < tr->pieces.n && tr->pieces.at[piece].first <= k; piece++)
            if (tr->pieces.at[piece].jumped) {
                drift->changed = drift->changed ||
                                 !(fabs(change - last) <= of_event * fmax(1, fabs(last)));
                start = change;
            }
        last = change;
        if (piece > 0 && is_driven(stage, tr->pieces.at[piece - 1].mode)) {
            drift->changed = true;
            start = change;
            continue;
        }
        if (piece > 0 && is_switching_interval(tr, piece - 1, k))
            continue;
        /* nor is a change by a lasting contact, which has its own mode: its impacts took energy */
        if (drift->changed && piece > 0 && tr->pieces.at[piece - 1].mode != tr->pieces.at[0].mode) {
            start = change;
            continue;
        }
        change = fabs(change - start);
        if (fabs(start) > 1)
            change /= fabs(start);
        if (!(change <= drift->drift)) /* also true for a NaN, which then stays */
            drift->drift = change;
    }
    qdot_free(in);
    qdot_free(work);
    return status;
}

/* Measure the drift of a quantity along the run and append it to the list. */
static qdot_status
record_drift(const qdot_tape *tape, const qdot_trajectory *tr, const qdot_stage *stage, qdot_expr quantity,
             const char *name, qdot_drifts *d)
{
    qdot_drift x = {.quantity = quantity};

    QDOT_TRY(measure_drift(tape, tr, stage, &x));
    if (!isfinite(x.start)) /* infinite or undefined at the start: no drift can be measured */
        return QDOT_OK;
    if (!(x.name = qdot_strdup(name)))
        return QDOT_ENOMEM;
    d->at[d->n++] = x;
    return QDOT_OK;
}

static qdot_status
make_quantity_tape(const qdot_plan *p, qdot_expr quantity, qdot_tape **tape)
{
    const qdot_expr e = qdot_plan_substitute(p, quantity);

    *tape = NULL;
    QDOT_TRY(qdot_pool_check(p->pool));
    return qdot_tape_new(p->pool, 2 * p->n + 1, p->inputs, 1, &e, tape);
}

/* absent [n]: coordinates that the conserved energy does not seem to depend on; only these can be
 * cyclic. */
static qdot_status
measure_energy(qdot_scene *scene, const qdot_plan *p, const qdot_trajectory *tr, const qdot_stage *stage,
               qdot_drifts *d, bool *absent)
{
    bool conserved = false;
    qdot_tape *made = NULL;
    const qdot_tape *tape;
    qdot_expr h;
    qdot_status status = qdot_mech_energy_conserved(scene, &conserved);

    if (status != QDOT_OK || !conserved)
        return qdot_grave(status);
    h = p->M ? qdot_mech_numeric_energy(scene) : p->residual->h;
    status = qdot_pool_check(p->pool);
    if (status == QDOT_OK && h != QDOT_NIL && p->M)
        status = make_quantity_tape(p, h, &made);
    tape = p->M ? made : p->residual->energy;
    if (status != QDOT_OK || h == QDOT_NIL)
        return qdot_grave(status);
    status = record_drift(tape, tr, stage, h, "energy", d);
    d->energy = d->n == 1;
    if (status == QDOT_OK && p->M)
        status = qdot_absent_find(tape, p->n, absent);
    qdot_tape_free(made);
    return status;
}

/* Whether the run, or the part with this coordinate, was integrated with the conjugate momentum kept constant. */
static bool
is_momentum_constant(const qdot_plan *p, const qdot_trajectory *tr, qdot_expr coordinate)
{
    for (size_t i = 0; i == 0 || i < tr->n_tracks; i++) {
        const qdot_plan *r = tr->n_tracks > 0 ? p->parts[i]->reduced : p->reduced;

        for (size_t k = 0; r && k < r->n_kept; k++)
            if (r->inputs[r->kept[k]] == coordinate)
                return true;
    }
    return false;
}

/* Measure the drift of the momentum of coordinate i, if it should be conserved. */
static qdot_status
measure_momentum(qdot_scene *scene, const qdot_plan *p, const qdot_trajectory *tr, const qdot_stage *stage,
                 size_t i, qdot_drifts *d)
{
    qdot_cyclic cyclic;
    qdot_expr symbol;
    qdot_tape *tape;
    qdot_status status;
    char *name;
    bool is;

    QDOT_TRY(qdot_mech_cyclic_at(scene, i, &cyclic, &is));
    if (!is || cyclic.rate != QDOT_NIL)
        return QDOT_OK;
    symbol = qdot_symbol_of(p->pool, QDOT_MOMENTUM, cyclic.coordinate);
    QDOT_TRY(qdot_pool_check(p->pool));
    name = qdot_strdup(qdot_expr_symbol(p->pool, symbol)->name);
    if (!name)
        return QDOT_ENOMEM;
    status = qdot_grave(make_quantity_tape(p, cyclic.momentum, &tape));
    if (tape)
        status = record_drift(tape, tr, stage, cyclic.momentum, name, d);
    qdot_tape_free(tape);
    qdot_free(name);
    if (status == QDOT_OK && d->n > 0 && is_momentum_constant(p, tr, cyclic.coordinate)
        && d->at[d->n - 1].quantity == cyclic.momentum) {
        d->at[d->n - 1].kept = true;
        d->at[d->n - 1].drift = 0;
    }
    return status;
}

/* Find the largest sum, along the run, of the magnitudes of a quantity's terms; 0 if not known. */
static qdot_status
find_largest_terms(const qdot_plan *p, const qdot_trajectory *tr, qdot_expr quantity, double *most)
{
    const qdot_expr terms = qdot_term_magnitude(p->pool, qdot_plan_substitute(p, quantity));
    qdot_tape *tape = NULL;
    qdot_drift of = {.quantity = terms};
    qdot_status status = qdot_grave(make_quantity_tape(p, terms, &tape));

    *most = 0;
    if (status == QDOT_OK && tape)
        status = measure_drift(tape, tr, NULL, &of);
    if (tape)
        *most = fabs(of.start) + of.drift * fmax(1, fabs(of.start));
    qdot_tape_free(tape);
    return status;
}

/* What an error of tol in every component of the state at point k, relative to max(1, |y_i|), changes the
 * quantity by: sum_i |c(y + tol max(1, |y_i|) e_i) - c(y)|; not finite where that leaves its domain. */
static double
error_at_point(const qdot_tape *tape, const qdot_trajectory *tr, size_t k, double tol, double *in, double *work)
{
    const size_t n = tr->n, moved = QDOT_LANES - 1; /* each lane changes one component of the state, the last lane none */
    const double *y = tr->y + k * n;
    double c[QDOT_LANES], sum = 0;

    for (size_t first = 0; first < n; first += moved) {
        for (size_t l = 0; l < QDOT_LANES; l++)
            load_lane(tr, k, l, in);
        for (size_t l = 0; l < moved && first + l < n; l++)
            in[(first + l) * QDOT_LANES + l] += tol * fmax(1, fabs(y[first + l]));
        qdot_lanes_eval(tape, in, c, work);
        for (size_t l = 0; l < moved && first + l < n; l++)
            sum += fabs(c[l] - c[moved]);
    }
    return sum;
}

/* What errors of tol in every step change a quantity by; not finite if a state is within tol of the end of
 * its domain. */
static qdot_status
find_largest_error(const qdot_tape *tape, const qdot_trajectory *tr, double tol, double *spread)
{
    double *in = qdot_malloc(QDOT_LANES * (tr->n + 1) * sizeof *in);
    double *work = qdot_malloc(QDOT_LANES * (qdot_tape_work(tape) + 1) * sizeof *work);
    qdot_status status = in && work ? QDOT_OK : QDOT_ENOMEM;

    *spread = 0;
    for (size_t k = 0; k < tr->count && status == QDOT_OK; k++) {
        if (k % 1024 == 0)
            status = qdot_interrupt_check();
        *spread += error_at_point(tape, tr, k, tol, in, work);
    }
    qdot_free(in);
    qdot_free(work);
    return status;
}

qdot_status
qdot_drifts_contradict(const qdot_drifts *d, const qdot_plan *p, const qdot_trajectory *tr,
                       double tol, bool *contradict)
{
    static const double most = 100;
    qdot_tape *tape;
    double spread;
    qdot_status status;

    *contradict = false;
    if (!d->energy || !p->M || !(d->at[0].drift > most * tol * (double)tr->result.stats.steps))
        return QDOT_OK;
    QDOT_TRY(qdot_grave(make_quantity_tape(p, d->at[0].quantity, &tape)));
    if (!tape)
        return QDOT_OK;
    status = find_largest_error(tape, tr, tol, &spread);
    qdot_tape_free(tape);
    *contradict = !(d->at[0].drift * fmax(1, fabs(d->at[0].start)) <= most * spread && isfinite(spread));
    return status;
}

/* Divide the drifts of quantities that are smaller than 1 by the sizes of the quantities' terms. */
static qdot_status
make_relative(const qdot_plan *p, const qdot_trajectory *tr, qdot_drifts *d)
{
    for (size_t i = 0; i < d->n; i++) {
        double terms;

        if (fabs(d->at[i].start) > 1 || !(d->at[i].drift > 0))
            continue;
        QDOT_TRY(find_largest_terms(p, tr, d->at[i].quantity, &terms));
        if (terms > 0 && terms < 1)
            d->at[i].drift /= terms;
    }
    return QDOT_OK;
}

qdot_status
qdot_drifts_measure(qdot_scene *scene, const qdot_plan *p, const qdot_trajectory *tr,
                    const qdot_stage *stage, qdot_drifts *d)
{
    bool *asked = qdot_malloc((p->n + 1) * sizeof *asked); /* [n] whether coordinate i may be cyclic */
    qdot_status status = asked ? QDOT_OK : QDOT_ENOMEM;

    d->at = qdot_calloc(p->n + 1, sizeof *d->at);
    if (!d->at)
        status = QDOT_ENOMEM;
    for (size_t i = 0; i < p->n && asked; i++)
        asked[i] = p->M || p->constraints || !p->residual || !p->residual->absent || p->residual->absent[i];
    if (status == QDOT_OK)
        status = measure_energy(scene, p, tr, stage, d, asked);
    for (size_t i = 0; i < scene->coordinates.n && status == QDOT_OK; i++)
        if (asked[i])
            status = measure_momentum(scene, p, tr, stage, i, d);
    if (status == QDOT_OK && stage && stage->scales)
        status = make_relative(p, tr, d);
    qdot_free(asked);
    return qdot_grave(status);
}
