/* cost.c -- models of the computing time of a step, with measured coefficients. */
#include "sim/plan/cost.h"

#include <math.h>
#include <string.h>

#include "num/kinds.h"
#include "ode/taylor.h"
#include "series/lanes-motion.h"
#include "series/taylor.h"
#include "sim/form/canonical.h"
#include "sim/form/residual.h"
#include "sim/model/constraints.h"

/* --- measured coefficients of cost models -------------------------------------------- */

/* The quantities in which cost models are linear: 1, then fields of a qdot_work. */
enum {
    ONE, CALLS, OPERATIONS, LENGTH, CONVOLUTIONS, COORDINATES, UNKNOWNS, SQUARES, CUBES, FACTORED,
    FACTORED_CUBES, FILLED, FILLING, VECTORS, PRODUCTS, BEGUN, FEATURES
};

typedef struct {
    double start[FEATURES]; /* coefficients of the cost c[0], which is independent of the order of the series */
    double order[FEATURES]; /* coefficients of the cost c[1] per order of the series */
    double pair[FEATURES];  /* coefficients of the cost c[2] per square of the order */
} model;

/* The cost of M q'' = f by compiled kernels, measured first; costs of other forms are relative to it. */
static const model explicit_kernels = {
    .start = {[ONE] = 60, [CALLS] = 15, [LENGTH] = 2, [COORDINATES] = 10, [FACTORED] = 5,
              [FACTORED_CUBES] = 0.2},
    .order = {[ONE] = 1.5, [LENGTH] = 1.2, [CONVOLUTIONS] = 3.5, [COORDINATES] = 2, [UNKNOWNS] = 5,
              [SQUARES] = 0.5},
    .pair = {[CONVOLUTIONS] = 0.12}};

/* Parts that are alike as vectors: 6 to 100 bodies that attract each other. */
static const model explicit_alike = {
    .start = {[ONE] = 60, [VECTORS] = 20, [COORDINATES] = 10},
    .order = {[VECTORS] = 12, [COORDINATES] = 4},
    .pair = {[VECTORS] = 0.2}};

/* The same as code, whose orders and pairs are those of `kinds` times this: expansions of the
 * five scenes of bench/numeric. What every step takes is known better here than of kernels,
 * for it decides. */
static const model explicit_code = {
    .start = {[ONE] = 160, [CALLS] = 20, [LENGTH] = 3, [COORDINATES] = 10, [UNKNOWNS] = 20,
              [CUBES] = 1},
    .order = {[ONE] = 3, [LENGTH] = 0.4, [CONVOLUTIONS] = 0.6},
    .pair = {[CONVOLUTIONS] = 1}};

/* An order of code costs little by AVX-512; by AVX2 the orders of a further vector cost as
 * much as the instructions that it is read by; by SSE2 all vectors do. */
static const struct {
    double order, pair, vector;
} kinds[] = {{1.8, 0.15, 0}, {1, 0.03, 16}, {1, 0.03, 0}};

/* The cost of steps that solve for q'' and multipliers in machine code: measured with bench/constraints. */
static const model bordered_code = {
    .start = {[ONE] = 160, [CALLS] = 20, [LENGTH] = 3, [UNKNOWNS] = 20, [CUBES] = 0.5},
    .order = {[ONE] = 3, [LENGTH] = 0.4, [CONVOLUTIONS] = 0.6, [SQUARES] = 1},
    .pair = {[CONVOLUTIONS] = 0.03}};

/* d'Alembert's residual, stage by stage: nineteen scenes at orders 8 to 30, of 2 to 16
 * coordinates, to 20 %. */
static const model implicit_kernels = {
    .start = {[ONE] = 180, [CALLS] = 60, [OPERATIONS] = 1.1, [LENGTH] = 11, [CUBES] = 0.5},
    .order = {[ONE] = 190, [LENGTH] = 3.2, [SQUARES] = 2.7},
    .pair = {[CONVOLUTIONS] = 0.17}};
static const model implicit_code = {
    .start = {[ONE] = 180, [CALLS] = 60, [OPERATIONS] = 1.1, [LENGTH] = 11, [CUBES] = 0.5},
    .order = {[ONE] = 15, [LENGTH] = 0.4, [SQUARES] = 1.4},
    .pair = {[CONVOLUTIONS] = 0.15}};

/* Along a tree, in vectors of eight nodes; vectors take 1.8 times what counts of their work say.
 * Applied forces with velocities have a program of their own, by kernels. */
static const model tree_vectors = {
    .start = {[ONE] = 720, [CALLS] = 36, [COORDINATES] = 72},
    .order = {[ONE] = 36, [BEGUN] = 1.8, [PRODUCTS] = 0.72, [COORDINATES] = 1.8, [LENGTH] = 1.2,
              [CONVOLUTIONS] = 3.5},
    .pair = {[VECTORS] = 0.54, [CONVOLUTIONS] = 0.12}};

/* With AVX2 that is too low for all but a path in a plane of one vector: by 1.7 and more, of
 * which some is left to runs that end before code of another form pays. */
static const double by_halves = 1.3;

/* Constraints by their own coefficients: pendulums and chains in Cartesian coordinates, up to 64
 * links. Solved by the factor, then by an inverse. */
static const model constrained_factor = {
    .start = {[ONE] = 500, [CALLS] = 15, [LENGTH] = 4, [UNKNOWNS] = 5, [FILLING] = 3},
    .order = {[ONE] = 50, [LENGTH] = 1.2, [CONVOLUTIONS] = 3.5, [COORDINATES] = 10, [UNKNOWNS] = 6,
              [FILLED] = 2.5},
    .pair = {[CONVOLUTIONS] = 0.12}};
static const model constrained_inverse = {
    .start = {[ONE] = 500, [CALLS] = 15, [LENGTH] = 4, [UNKNOWNS] = 35, [SQUARES] = 6, [FILLING] = 3},
    .order = {[ONE] = 20, [LENGTH] = 1.2, [CONVOLUTIONS] = 3.5, [COORDINATES] = 10, [SQUARES] = 0.5},
    .pair = {[CONVOLUTIONS] = 0.12}};

/* The costs of eight members in lanes: by kernels with AVX-512; as machine code, fitted to five
 * scenes at orders 8 to 26 within 8 %. */
static const model lanes_kernels = {
    .start = {[ONE] = 300, [CALLS] = 100, [LENGTH] = 5, [COORDINATES] = 20, [CUBES] = 1.0 / 6},
    .order = {[LENGTH] = 2, [CONVOLUTIONS] = 3, [COORDINATES] = 10, [UNKNOWNS] = 5, [SQUARES] = 1},
    .pair = {[CONVOLUTIONS] = 0.1}};
static const model lanes_code = {
    .start = {[ONE] = 60, [CALLS] = 60, [COORDINATES] = 60, [CUBES] = 1.0 / 6},
    .order = {[COORDINATES] = 10},
    .pair = {[CONVOLUTIONS] = 0.123}};

/* A projection costs three evaluations of residuals and gradients, for positions and for velocities, and one of M. */
enum { PROJECTIONS = 3 };
static const double of_projection = 150, of_call = 10, of_row = 60, of_slope = 15,
                    of_coordinate = 10;

/* Beside an expansion whose multipliers are eliminated: whether its rows are independent is
 * looked at. */
static const double of_pivots = 200;

/* Machine code is worth writing if this many expansions (divided by p) follow: writing takes 40 to 300 us. */
static const struct {
    double of_explicit, by_length, of_implicit, of_eliminated, of_bordered;
} worth = {800, 5000, 1500, 500, 400};

/* Orders that are one vector (series/taylor-code.h): of constraints; loops where there are
 * two, with the first orders; instructions that are kept decoded. */
enum { narrow = 18, narrow_explicit = 10 };
static const double loops = 3.7, decoded = 3000;

/* The highest order of a series; the tolerance at which the forms of equations are compared. */
enum { most_order = 40 };
static const double middle_tol = 1e-9;

/* --- costs of forms of the equations -------------------------------------------------- */

static double
sum_of_features(const double *by, const double *features)
{
    double s = 0;

    for (int i = 0; i < FEATURES; i++)
        s += by[i] * features[i];
    return s;
}

static void
apply_cost_model(const model *m, const qdot_work *w, double *c)
{
    const double features[FEATURES] = {
        [ONE] = 1, [CALLS] = w->calls, [OPERATIONS] = w->operations, [LENGTH] = w->length,
        [CONVOLUTIONS] = w->convolutions, [COORDINATES] = w->coordinates,
        [UNKNOWNS] = w->unknowns, [SQUARES] = w->squares, [CUBES] = w->cubes,
        [FACTORED] = w->factored, [FACTORED_CUBES] = w->factored_cubes, [FILLED] = w->filled,
        [FILLING] = w->filled > 0 ? w->filled * w->filled / w->unknowns : 0,
        [VECTORS] = w->vectors, [PRODUCTS] = w->products, [BEGUN] = w->begun};

    c[0] = sum_of_features(m->start, features);
    c[1] = sum_of_features(m->order, features);
    c[2] = sum_of_features(m->pair, features);
}

qdot_ode_cost
qdot_cost_explicit(const qdot_work *w)
{
    const size_t kind = qdot_kind_is_here(2) ? 2 : qdot_kind_is_here(1);
    const bool solves = w->unknowns > 0;
    qdot_ode_cost c = {0};

    apply_cost_model(w->vectors > 0 ? &explicit_alike : &explicit_kernels, w, c.kernels);
    if (!w->code)
        return c;
    c.worth = worth.of_explicit + worth.by_length / (w->length + 1);
    if (!qdot_taylor_may_be_code())
        return c;
    apply_cost_model(&explicit_code, w, c.code);
    c.code[1] = kinds[kind].order * c.code[1] + w->squares;
    c.code[2] *= kinds[kind].pair;
    c.wider = kinds[kind].vector * w->convolutions;
    c.narrow = narrow_explicit;
    c.of_vector = 8;
    c.digits = solves ? QDOT_ODE_DIGITS : 24;
    c.by_stability = !solves && kind > 1;
    return c;
}

qdot_ode_cost
qdot_cost_implicit(const qdot_work *w)
{
    qdot_ode_cost c = {.worth = worth.of_implicit};

    apply_cost_model(&implicit_kernels, w, c.kernels);
    if (w->code && qdot_lanes_may_be_code())
        apply_cost_model(&implicit_code, w, c.code);
    return c;
}

qdot_ode_cost
qdot_cost_tree(const qdot_work *w)
{
    const bool one = w->nodes == w->coordinates && w->nodes <= 8;
    qdot_ode_cost c = {0};

    apply_cost_model(&tree_vectors, w, c.kernels);
    for (int k = 0; k < 3 && !one && !qdot_kind_is_here(2); k++)
        c.kernels[k] *= by_halves;
    return c;
}

double
qdot_cost_projection(const qdot_plan *p)
{
    const qdot_constraints *c = p->constraints;
    const double operations = (double)(qdot_tape_operations(c->positions) +
                                       qdot_tape_operations(c->velocities));
    const double calls = (double)(qdot_tape_calls(c->positions) + qdot_tape_calls(c->velocities));

    if (p->treatment != QDOT_RUN_PROJECT)
        return 0;
    return of_projection + PROJECTIONS * (operations + of_call * calls) +
           (double)qdot_tape_operations(c->metric) + of_call * (double)qdot_tape_calls(c->metric) +
           of_row * (double)c->m + of_slope * (double)c->n_slopes + of_coordinate * (double)p->n;
}

qdot_ode_cost
qdot_cost_constrained(const qdot_plan *p, const qdot_work *w)
{
    qdot_ode_cost c = {0};

    apply_cost_model(w->inverted ? &constrained_inverse : &constrained_factor, w, c.kernels);
    if (w->inverted) /* computing the inverse costs one solution of the linear system for each column */
        c.kernels[0] += 2.5 * w->filled * w->unknowns;
    c.kernels[0] += qdot_cost_projection(p);
    return c;
}

qdot_ode_cost
qdot_cost_eliminated(const qdot_plan *p, const qdot_work *w)
{
    qdot_ode_cost c = qdot_cost_explicit(w);

    c.kernels[0] += of_pivots + qdot_cost_projection(p);
    c.worth = worth.of_eliminated;
    c.digits = QDOT_ODE_DIGITS;
    c.by_stability = false;
    return c;
}

/* Without the projection: with it loose tolerances had orders that take a second vector, and
 * paid for it when the code is written (a car axis: 8 % fewer steps, a quarter more time).
 * More vectors are loops of their own, read anew in every step where all of them are more
 * than a processor keeps decoded. */
qdot_ode_cost
qdot_cost_bordered(const qdot_work *w, const qdot_ode_cost *other)
{
    const double instructions = 7 * w->length + 12 * w->convolutions + 1.5 * w->squares;
    qdot_ode_cost c = {.worth = worth.of_bordered,
                       .digits = QDOT_ODE_DIGITS,
                       .narrow = narrow,
                       .of_vector = 16,
                       .wider = loops * instructions > decoded ? 0.3 * instructions : 0};

    apply_cost_model(&bordered_code, w, c.code);
    memcpy(c.kernels, other->kernels, sizeof c.kernels);
    return c;
}

qdot_ode_cost
qdot_cost_least(size_t n, double convolutions)
{
    const double m = (double)n;
    const qdot_work w = {.convolutions = convolutions, .squares = m * m,
                         .factored_cubes = m * m * m};
    qdot_ode_cost c = {0};

    apply_cost_model(&explicit_kernels, &w, c.kernels);
    return c;
}

qdot_ode_cost
qdot_cost_lanes(const qdot_work *w)
{
    qdot_ode_cost c = {0};

    apply_cost_model(&lanes_kernels, w, c.kernels);
    if (qdot_lanes_may_be_code())
        apply_cost_model(&lanes_code, w, c.code);
    return c;
}

/* --- costs with other units ---------------------------------------------------------- */

void
qdot_cost_precise(const qdot_plan *p, mpfr_prec_t bits, double cost[3])
{
    const double limbs = ceil((double)bits / 64), term = 9 + 1.3 * limbs * limbs;
    const double operation = 40 + 1.3 * limbs * limbs;
    const qdot_residual *r = p->residual;
    const qdot_canonical *h = p->canonical;
    const qdot_tape *tape = h ? h->rates : r ? r->places : p->tape;
    double length = (double)qdot_tape_operations(tape);
    double convolutions = p->constraints ? length
                          : h            ? h->motion.program.convolutions
                          : r            ? p->convolutions_residual
                                         : p->convolutions_derived;

    if (r && !h)
        length += 8 * (double)(r->functions + r->n_weights);
    cost[0] = 60 * operation * (double)qdot_tape_calls(tape) + operation * length;
    cost[1] = operation * (length + 4 * (double)p->n) + convolutions * 40;
    cost[2] = 0.5 * convolutions * term;
    for (size_t b = 0; b < p->structure.blocks && !h; b++) {
        double n = (double)p->blocks[b].n;

        if (n > 1) {
            cost[1] += 2 * n * n * operation;
            cost[0] += 2 * n * n * n / 3 * operation;
        }
    }
}

double
qdot_cost_evaluation(const qdot_tape *tape)
{
    return (double)(qdot_tape_operations(tape) + 15 * qdot_tape_calls(tape));
}

/* --- comparing costs ----------------------------------------------------------------- */

qdot_ode_cost
qdot_cost_of_kernels(const qdot_ode_cost *cost)
{
    qdot_ode_cost c = *cost;

    c.code[0] = 0;
    return c;
}

double
qdot_cost_steps(const qdot_ode_cost *cost)
{
    return qdot_ode_taylor_cost(cost, most_order, middle_tol);
}

/* Of kernels the projection is there already. Forms take orders far from each other (18 and
 * 26). Steps of a motion without singularities, as rolling, are longer by the order than its
 * radius says; whether it has some is not known, so the mean is taken: of nine scenes at
 * 1e-4, 1e-6, 1e-8, with AVX2, 24 take the faster of elimination and bordered code, three
 * lose 3, 9 and 12 %. */
double
qdot_cost_constrained_steps(const qdot_plan *p, const qdot_ode_cost *cost, double tol)
{
    qdot_ode_series series = {.most = most_order, .cost = *cost};
    const int order = qdot_ode_taylor_order(&series, tol, false, 0);

    if (series.cost.code[0] > 0)
        series.cost.code[0] += qdot_cost_projection(p);
    return qdot_ode_taylor_cost(&series.cost, most_order, tol) / sqrt(order);
}
