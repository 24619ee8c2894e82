/* motion-cost.c -- models of costs, fitted to scenes. */
#include "sim/form/motion-cost.h"

#include "num/kinds.h"
#include "sim/model/constrained.h"

static double
of_calls(const qdot_motion_work *w)
{
    return (double)qdot_tape_calls(w->tape);
}

static double
of_length(const qdot_motion_work *w)
{
    return (double)qdot_taylor_length(w->taylor);
}

/* Code by AVX-512: an order costs little; by AVX2 the orders of a further vector cost as much as
 * the instructions that it is read by; by SSE2 all vectors do. What every step takes is known
 * better here than of kernels, for it decides. */
static void
explicit_as_code(const qdot_motion_work *w, qdot_ode_code *code)
{
    static const struct {
        double order, pair, vector;
    } costs[] = {{1.8, 0.15, 0}, {1, 0.03, 16}, {1, 0.03, 0}}; /* by kind */
    const size_t kind = qdot_kind_is_here(2) ? 2 : qdot_kind_is_here(1);
    const double length = of_length(w),
                 convolutions = qdot_taylor_convolutions(w->taylor);
    double *c = code->cost;
    bool solves = false;

    code->worth = 800 + 5000 / (length + 1);
    if (!qdot_taylor_may_be_code())
        return;
    c[0] = 160 + 20 * of_calls(w) + 3 * length + 10 * (double)w->solvers->plan->n;
    c[1] = costs[kind].order * (3 + 0.4 * length + 0.6 * convolutions);
    c[2] = costs[kind].pair * convolutions;
    code->wider = costs[kind].vector * convolutions;
    code->narrow = 10;
    code->of_vector = 8;
    for (size_t b = 0; b < w->solvers->n; b++) {
        const double n = (double)w->solvers->at[b].n;

        if (n == 1)
            continue;
        solves = true;
        c[0] += 20 * n + n * n * n;
        c[1] += n * n;
    }
    code->digits = solves ? QDOT_ODE_DIGITS : 24;
    code->by_stability = !solves && kind > 1;
}

void
qdot_motion_cost_explicit(const qdot_motion_work *w, qdot_ode_series *series)
{
    const double length = of_length(w),
                 convolutions = qdot_taylor_convolutions(w->taylor);
    const double all = (double)w->solvers->plan->n;
    double *c = series->cost;

    c[0] = 60 + 15 * of_calls(w) + 2 * length + 10 * all;
    c[1] = 1.5 + 1.2 * length + 3.5 * convolutions + 2 * all;
    c[2] = 0.12 * convolutions;
    for (size_t b = 0; b < w->solvers->n; b++) {
        const double n = (double)w->solvers->at[b].n;

        if (n == 1)
            continue;
        c[1] += 5 * n + 0.5 * n * n;
        if (!w->solvers->at[b].constant)
            c[0] += 5 * n + 0.2 * n * n * n;
    }
    if (series->code.write)
        explicit_as_code(w, &series->code);
}

/* Orders that are one vector (series/taylor-code.h); loops where there are two, with the first
 * orders; instructions that are kept decoded. */
enum { narrow = 18 };
static const double loops = 3.7, decoded = 3000;

/* Without the projection: with it loose tolerances had orders that take a second vector, and paid
 * for it when the code is written (a car axis: 8 % fewer steps, a quarter more time). More vectors
 * are loops of their own, read anew in every step where all of them are more than a processor keeps
 * decoded. */
void
qdot_motion_cost_bordered(const qdot_motion_work *w, qdot_ode_series *series)
{
    const double all = (double)w->solvers->at[0].n, length = of_length(w);
    const double sums = qdot_taylor_convolutions(w->taylor);
    const double instructions =
        7 * length + 12 * sums + 1.5 * all * all; /* of an order */
    qdot_ode_code *code = &series->code;

    code->worth = 400;
    code->digits = QDOT_ODE_DIGITS;
    code->cost[0] =
        160 + 20 * of_calls(w) + 3 * length + 20 * all + 0.5 * all * all * all;
    code->cost[1] = 3 + 0.4 * length + 0.6 * sums + all * all;
    code->cost[2] = 0.03 * sums;
    code->narrow = narrow;
    code->of_vector = 16;
    code->wider = loops * instructions > decoded ? 0.3 * instructions : 0;
}

void
qdot_motion_cost_constrained(const qdot_motion_work *w, const qdot_saddle_solver *solver,
                             qdot_ode_series *series)
{
    const qdot_saddle *matrix = &solver->matrix;
    const double all = (double)(matrix->n + matrix->m);
    const double filled = matrix->patterned ? (double)matrix->sparse.filled : all * all;
    const double solve = 30 + 6 * all + 2.5 * filled;
    const double length = of_length(w), convolutions = qdot_taylor_convolutions(w->taylor);
    double *c = series->cost;

    c[0] = 500 + qdot_constrained_cost(solver->plan) + 15 * of_calls(w) + 4 * length + 5 * all +
           3 * filled * filled / all + (matrix->inverse ? all * solve : 0);
    c[1] = 20 + 1.2 * length + 3.5 * convolutions + 10 * (double)matrix->n +
           (matrix->inverse ? 0.5 * all * all : solve);
    c[2] = 0.12 * convolutions;
}

/* Nineteen scenes at orders 8 to 30, of 2 to 16 coordinates, to 20 %. */
void
qdot_motion_cost_implicit(const qdot_motion_work *w, qdot_ode_series *series)
{
    double *c = series->cost, *code = series->code.cost, squares = 0, cubes = 0;
    const double length = of_length(w),
                 convolutions = qdot_taylor_convolutions(w->taylor);

    for (size_t b = 0; b < w->solvers->n; b++) {
        const double n = (double)w->solvers->at[b].n;

        squares += n > 1 ? n * n : 0;
        cubes += n > 1 ? n * n * n : 0;
    }
    c[0] = 180 + 60 * of_calls(w) + 1.1 * (double)qdot_tape_operations(w->tape) +
           11 * length + 0.5 * cubes;
    c[1] = 190 + 3.2 * length + 2.7 * squares;
    c[2] = 0.17 * convolutions;
    series->code.worth = 1500;
    if (!series->code.write)
        return;
    code[0] = c[0];
    code[1] = 15 + 0.4 * length + 1.4 * squares;
    code[2] = 0.15 * convolutions;
}
