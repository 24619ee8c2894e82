/* routh.c -- eliminates the velocities of cyclic coordinates (Routh) if that reduces the computing cost. */
#include "sim/plan/routh.h"

#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/simplify/simplify.h"
#include "series/program.h"
#include "sim/form/derived.h"
#include "sim/plan/cost.h"
#include "sim/plan/form.h"

/* Expressions with more operations than this are not simplified. */
enum { SHORT = 120, SHORT_ENTRY = 60 };

/* Cancellation in a velocity is ignored while the sum of its terms' sizes is below `harmless` times
 * max(1, |velocity|). Above, the rounding of a term counts `roundings` times over a run. */
static const double harmless = 4, roundings = 64;

/* Three ways of inserting the eliminated velocities into the other equations. */
typedef enum { PUT_IN, HELD, SIMPLIFIED, WAYS } way;

typedef struct {
    qdot_plan *p; /* the plan with all coordinates; borrowed */
    qdot_scene *scene;
    const qdot_run_request *request;
    qdot_pool *pool;
    qdot_facts facts;
    size_t n, h;
    bool *cyclic;         /* [n] whether the coordinate is cyclic */
    bool *gone;           /* [n] whether the coordinate's velocity is eliminated */
    size_t *order;        /* [h] coordinates in the order of elimination */
    qdot_expr *M, *f;     /* M [n x n] and f [n] after the eliminations so far */
    qdot_expr *kept;      /* [n] symbol of the conserved momentum p_c of cyclic coordinate c */
    qdot_expr *momentum;  /* [n] the momentum dL/dq_c' as an expression */
    qdot_expr *rest;      /* [n] p_c - b_c after the eliminations so far (b_c: velocity-free part of p_c) */
    qdot_expr *above;     /* [n] pivot * q_c' in terms of momenta and velocities not eliminated before it */
    qdot_expr *rate;      /* [n] q_c' in terms of momenta and velocities not eliminated before it */
    double *in, *out, *work;
} routh;

/* --- which coordinates are cyclic ---------------------------------------------------- */

/* Irregular sample values in (0.3, 1.7), an interval that most domains contain. */
static double
sample_place(size_t i)
{
    return 0.3 + 1.4 * fmod(0.5545497 * (double)(i + 1), 1);
}

/* Whether M and f seem to be independent of q_i, tested at a few values. */
static bool
seems_independent_of(const routh *e, size_t i)
{
    const qdot_tape *tape = e->p->tape;
    const size_t inputs = 2 * e->n + 1, outputs = qdot_tape_outputs(tape);
    double *there = e->out + outputs;

    for (size_t k = 0; k < 2; k++) {
        for (size_t j = 0; j < inputs; j++)
            e->in[j] = sample_place(j + 7 * k);
        qdot_tape_eval(tape, e->in, e->out, e->work);
        e->in[i] = sample_place(i + 7 * k + 3);
        qdot_tape_eval(tape, e->in, there, e->work);
        for (size_t j = 0; j < outputs; j++)
            if (fabs(e->out[j] - there[j]) > 1e-9 * (1 + fabs(there[j])))
                return false;
    }
    return true;
}

/* Whether row i of the mass matrix M contains no velocities, so that p_i is linear in them. */
static bool
is_momentum_linear(const routh *e, size_t i)
{
    for (size_t j = 0; j < e->n; j++)
        if (qdot_expr_node(e->pool, e->M[i * e->n + j])->holds & QDOT_HAS_VELOCITY)
            return false;
    return true;
}

/* The index in the scene of the coordinate with index i in the plan. */
static size_t
index_in_scene(const routh *e, size_t i)
{
    return e->p->place ? e->p->place[i] : i;
}

/* Whether coordinate i stands for a parameter that events set (sim/model/parameter-states.h). */
static bool
is_parameter_coordinate(const routh *e, size_t i)
{
    return index_in_scene(e, i) >= e->scene->coordinates.n;
}

/* The number of other coordinates that M couples with coordinate i. */
static size_t
count_coupled(const routh *e, size_t i)
{
    size_t n = 0;

    for (size_t j = 0; j < e->n; j++)
        n += j != i && e->M[i * e->n + j] != QDOT_ZERO;
    return n;
}

static qdot_status
find_cyclic_coordinates(routh *e, bool *some)
{
    *some = false;
    for (size_t i = 0; i < e->n; i++) {
        qdot_cyclic c;
        bool is, applied;

        if (is_parameter_coordinate(e, i) || !seems_independent_of(e, i) || !is_momentum_linear(e, i) ||
            count_coupled(e, i) >= QDOT_ROUTH_COUPLED)
            continue;
        QDOT_TRY(qdot_interrupt_check());
        QDOT_TRY(qdot_mech_cyclic_at(e->scene, index_in_scene(e, i), &c, &is));
        if (!is || c.rate != QDOT_NIL)
            continue;
        QDOT_TRY(qdot_mech_applied_holds(e->scene, c.coordinate, &applied));
        if (applied)
            continue;
        e->momentum[i] = qdot_plan_substitute(e->p, c.momentum);
        e->kept[i] = qdot_symbol_of(e->pool, QDOT_MOMENTUM, c.coordinate);
        e->cyclic[i] = *some = true;
        QDOT_TRY(qdot_pool_check(e->pool));
    }
    return QDOT_OK;
}

/* --- eliminating velocities ---------------------------------------------------------- */

static qdot_expr
velocity_symbol(const routh *e, size_t i)
{
    return e->p->inputs[e->n + i];
}

static qdot_expr
simplify_if_short(routh *e, qdot_expr x, unsigned most)
{
    if (qdot_pool_failed(e->pool) || qdot_expr_size(e->pool, x) > most)
        return x;
    return qdot_simplify(e->pool, x, &e->facts);
}

/* M and f do not depend on a cyclic coordinate, but it may still appear in their expressions: put 0
 * in its place. */
static void
remove_cyclic_coordinates(routh *e)
{
    qdot_pool *pool = e->pool;

    for (size_t c = 0; c < e->n; c++) {
        const qdot_expr q = e->p->inputs[c], zero = QDOT_ZERO;

        if (!e->cyclic[c])
            continue;
        for (size_t i = 0; i < e->n && !qdot_pool_failed(pool); i++) {
            e->f[i] = qdot_subs(pool, e->f[i], 1, &q, &zero);
            for (size_t j = 0; j < e->n; j++)
                e->M[i * e->n + j] = qdot_subs(pool, e->M[i * e->n + j], 1, &q, &zero);
            if (e->cyclic[i])
                e->momentum[i] = qdot_subs(pool, e->momentum[i], 1, &q, &zero);
        }
    }
    for (size_t c = 0; c < e->n && !qdot_pool_failed(pool); c++) {
        qdot_expr b = e->momentum[c];

        if (!e->cyclic[c])
            continue;
        for (size_t i = 0; i < e->n; i++) {
            const qdot_expr v = velocity_symbol(e, i), zero = QDOT_ZERO;

            b = qdot_subs(pool, b, 1, &v, &zero);
        }
        e->rest[c] = qdot_sub(pool, e->kept[c], b);
    }
}

/* Solve equation c for q_c' and eliminate q_c' from the remaining equations. */
static void
eliminate_velocity(routh *e, size_t c)
{
    qdot_pool *pool = e->pool;
    const size_t n = e->n;
    const qdot_expr pivot = e->M[c * n + c];
    qdot_expr rate = e->rest[c];

    e->gone[c] = true;
    for (size_t i = 0; i < n && !qdot_pool_failed(pool); i++) {
        qdot_expr factor;

        if (e->gone[i] || e->M[i * n + c] == QDOT_ZERO)
            continue;
        rate = qdot_sub(pool, rate, qdot_mul(pool, e->M[c * n + i], velocity_symbol(e, i)));
        factor = qdot_div(pool, e->M[i * n + c], pivot);
        for (size_t j = i; j < n; j++)
            if (!e->gone[j] && e->M[c * n + j] != QDOT_ZERO)
                e->M[i * n + j] = e->M[j * n + i] = simplify_if_short(
                    e,
                    qdot_sub(pool, e->M[i * n + j],
                             qdot_mul(pool, factor, e->M[c * n + j])),
                    SHORT_ENTRY);
        e->f[i] = qdot_sub(pool, e->f[i], qdot_mul(pool, factor, e->f[c]));
        if (e->cyclic[i])
            e->rest[i] = qdot_sub(pool, e->rest[i], qdot_mul(pool, factor, e->rest[c]));
    }
    e->above[c] = rate;
    e->rate[c] = qdot_div(pool, rate, pivot);
}

/* Whether the pivot of i vanishes only where M is singular. An indefinite M may be regular although
 * one of its diagonal blocks is singular. */
static bool
may_be_pivot(const routh *e, size_t i)
{
    const uint8_t sign = qdot_expr_node(e->pool, e->M[i * e->n + i])->sign;

    return !e->p->indefinite || count_coupled(e, i) == 0 || (sign & (QDOT_GE0 | QDOT_LE0));
}

/* The cyclic coordinate, of those not yet eliminated, with the shortest pivot; SIZE_MAX: none. */
static size_t
choose_shortest_pivot(const routh *e)
{
    size_t best = SIZE_MAX;
    uint64_t least = UINT64_MAX;

    for (size_t i = 0; i < e->n; i++)
        if (e->cyclic[i] && !e->gone[i] && may_be_pivot(e, i)
            && qdot_expr_size(e->pool, e->M[i * e->n + i]) < least) {
            best = i;
            least = qdot_expr_size(e->pool, e->M[i * e->n + i]);
        }
    return best;
}

/* --- the plan for the remaining coordinates -------------------------------------------- */

static qdot_status
begin_reduced_plan(const routh *e, qdot_plan **out)
{
    const qdot_plan *p = e->p;
    const size_t n = e->n;
    qdot_plan *r;

    QDOT_TRY(qdot_plan_of_part(p, n, e->h, out));
    r = *out;
    r->n_states = p->n_states;
    r->n_kept = e->h;
    r->kept = qdot_calloc(e->h, sizeof *r->kept);
    if (!r->kept)
        return QDOT_ENOMEM;
    memcpy(r->inputs, p->inputs, (2 * n + 1) * sizeof *r->inputs);
    memcpy(r->M, e->M, n * n * sizeof *r->M);
    memcpy(r->f, e->f, n * sizeof *r->f);
    memcpy(r->kept, e->order, e->h * sizeof *r->kept);
    for (size_t i = 0; i < n; i++) {
        r->names[i] = qdot_strdup(p->names[i]);
        if (!r->names[i])
            return QDOT_ENOMEM;
    }
    for (size_t k = 0; k < e->h; k++)
        r->inputs[2 * n + 1 + k] = e->kept[e->order[k]];
    return QDOT_OK;
}

/* Replace the eliminated velocities in the equations of r, one after the other, by their
 * expressions, which are left in `rates` [h]. */
static void
insert_velocities(routh *e, qdot_plan *r, way how, qdot_expr *rates)
{
    qdot_pool *pool = e->pool;
    const size_t n = e->n;

    for (size_t k = 0; k < e->h; k++)
        rates[k] = how == SIMPLIFIED ? simplify_if_short(e, e->rate[e->order[k]], SHORT)
                                     : e->rate[e->order[k]];
    for (size_t k = 0; k < e->h && !qdot_pool_failed(pool); k++) {
        const qdot_expr v = velocity_symbol(e, e->order[k]);
        const qdot_expr rate = how == HELD ? qdot_hold(pool, rates[k]) : rates[k];

        for (size_t j = 0; j < k; j++)
            rates[j] = qdot_subs(pool, rates[j], 1, &v, &rate);
        for (size_t i = 0; i < n && !qdot_pool_failed(pool); i++) {
            if (e->gone[i])
                continue;
            r->f[i] = qdot_subs(pool, r->f[i], 1, &v, &rate);
            if (how == SIMPLIFIED)
                r->f[i] = simplify_if_short(e, r->f[i], SHORT);
            for (size_t j = 0; j < n; j++)
                if (!e->gone[j])
                    r->M[i * n + j] =
                        qdot_subs(pool, r->M[i * n + j], 1, &v, &rate);
        }
    }
}

/* Find the computing cost of a step of plan r, or of one evaluation if it has no Taylor series. */
static qdot_status
find_cost(qdot_plan *r)
{
    if (r->smooth)
        QDOT_TRY(qdot_plan_measure(r));
    if (!r->smooth || !r->method->series)
        r->cost = qdot_cost_evaluation(r->tape);
    return QDOT_OK;
}

static qdot_status
fill_reduced_plan(routh *e, way how, qdot_plan *r)
{
    const size_t n = e->n;
    bool *left = qdot_calloc(n, sizeof *left);
    qdot_expr *rates = qdot_calloc(e->h, sizeof *rates);
    qdot_status status = left && rates ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; left && i < n; i++)
        left[i] = !e->gone[i];
    if (status == QDOT_OK) {
        insert_velocities(e, r, how, rates);
        status = qdot_pool_check(e->pool);
    }
    if (status == QDOT_OK)
        status = qdot_plan_structure(r, left);
    if (status == QDOT_OK)
        status = qdot_plan_lower(r, 2 * n + 1 + e->h, e->h, rates);
    for (size_t k = 0; status == QDOT_OK && k < e->h; k++)
        rates[k] = e->momentum[e->order[k]];
    if (status == QDOT_OK)
        status = qdot_tape_new(e->pool, 2 * n + 1, r->inputs, e->h, rates, &r->momenta);
    qdot_free(left);
    qdot_free(rates);
    /* the expressions of momenta may contain switching functions */
    if (status == QDOT_OK)
        r->smooth = r->smooth && !qdot_program_hindrance(r->tape);
    return status == QDOT_OK ? find_cost(r) : status;
}

/* Whether an eliminated velocity is a sum, so that products with it may be multiplied out. */
static bool
has_sum_velocity(const routh *e)
{
    for (size_t k = 0; k < e->h; k++) {
        qdot_expr x = e->rate[e->order[k]];

        if (qdot_expr_kind(e->pool, x) == QDOT_SUM)
            return true;
        if (qdot_expr_kind(e->pool, x) != QDOT_PROD)
            continue;
        for (uint32_t i = 1; i + 1 < qdot_expr_count(e->pool, x); i += 2)
            if (qdot_expr_kind(e->pool, qdot_expr_arg(e->pool, x, i)) == QDOT_SUM)
                return true;
    }
    return false;
}

static double
cost_of_full_plan(const qdot_plan *p)
{
    return p->method->series ? p->cost : qdot_cost_evaluation(p->tape);
}

/* Compare the ways of inserting eliminated velocities; use the cheapest, if cheaper than the full equations. */
static qdot_status
choose_insertion(routh *e)
{
    double least = cost_of_full_plan(e->p);
    const bool sums = has_sum_velocity(e);
    qdot_status status = QDOT_OK;

    for (way how = PUT_IN; how < WAYS && status == QDOT_OK; how++) {
        qdot_plan *r;

        if (how == SIMPLIFIED && !sums)
            continue;
        status = begin_reduced_plan(e, &r);
        if (status == QDOT_OK)
            status = fill_reduced_plan(e, how, r);
        if (status == QDOT_OK && r->smooth == e->p->smooth && r->cost < least) {
            least = r->cost;
            r->subtracts = sums;
            qdot_plan_free(e->p->reduced);
            e->p->reduced = r;
            r = NULL;
        }
        qdot_plan_free(r);
    }
    return status;
}

/* --- whether velocities cancel digits ------------------------------------------------- */

/* For each eliminated velocity: its pivot, then the terms of its numerator. */
typedef qdot_vec(qdot_expr) expressions;

static qdot_status
list_velocity_terms(const routh *e, expressions *out)
{
    for (size_t k = 0; k < e->h; k++) {
        qdot_expr x = e->above[e->order[k]];
        uint32_t count = qdot_expr_kind(e->pool, x) == QDOT_SUM
                             ? qdot_expr_count(e->pool, x)
                             : 0;

        QDOT_TRY(qdot_vec_push(out, e->M[e->order[k] * (e->n + 1)]));
        for (uint32_t i = 1; i + 1 < count; i += 2)
            QDOT_TRY(qdot_vec_push(out, qdot_mul(e->pool, qdot_expr_arg(e->pool, x, i),
                                                 qdot_expr_arg(e->pool, x, i + 1))));
    }
    return qdot_pool_check(e->pool);
}

/* Set the tape's inputs in [2n + 1 + h]: the start state of the run and the momenta there. */
static qdot_status
find_start_inputs(routh *e, const qdot_plan *r, double *in)
{
    const qdot_run_request *q = e->request;
    const size_t n = e->n;
    double *work;

    for (size_t i = 0; i < 2 * n + 1; i++) {
        qdot_expr x = i < n       ? q->q0[index_in_scene(e, i)]
                      : i < 2 * n ? q->v0[index_in_scene(e, i - n)]
                                  : q->t0;

        x = qdot_plan_substitute(e->p, x);
        QDOT_TRY(qdot_pool_check(e->pool));
        QDOT_TRY(qdot_constant_double(e->pool, x, &in[i]));
    }
    work = qdot_calloc(qdot_tape_work(r->momenta) + 1, sizeof *work);
    if (!work)
        return QDOT_ENOMEM;
    qdot_tape_eval(r->momenta, in, in + 2 * n + 1, work);
    qdot_free(work);
    return QDOT_OK;
}

/* By how much rounding errors grow: the largest, over c, of sum |terms| / (|pivot| max(1, |q_c'|)),
 * where q_c' = sum of terms / pivot. */
static double
largest_term_sum(const routh *e, const double *in, const double *out)
{
    double most = 0;

    for (size_t k = 0; k < e->h; k++) {
        const qdot_expr x = e->above[e->order[k]];
        const double pivot = fabs(*out++), v = in[e->n + e->order[k]];
        uint32_t count = qdot_expr_kind(e->pool, x) == QDOT_SUM
                             ? qdot_expr_count(e->pool, x)
                             : 0;
        double sum = 0;

        for (uint32_t i = 1; i + 1 < count; i += 2)
            sum += fabs(*out++);
        most = fmax(most, sum / pivot / fmax(1, fabs(v)));
    }
    return most;
}

/* *too_far: the terms of a velocity cancel so far that rounding exceeds the tolerance. A spinning
 * top's p_phi - p_psi cos(theta) does that. */
static qdot_status
check_cancellation(routh *e, bool *too_far)
{
    const qdot_plan *r = e->p->reduced;
    const size_t inputs = 2 * e->n + 1 + e->h;
    expressions terms = {0};
    qdot_tape *tape = NULL;
    double *in = qdot_calloc(inputs, sizeof *in), *out = NULL, most = 0;
    qdot_status status = in ? list_velocity_terms(e, &terms) : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = find_start_inputs(e, r, in);
    if (status == QDOT_OK)
        status = qdot_tape_new(e->pool, inputs, r->inputs, terms.n, terms.at, &tape);
    if (status == QDOT_OK
        && !(out = qdot_calloc(terms.n + qdot_tape_work(tape) + 1, sizeof *out)))
        status = QDOT_ENOMEM;
    if (status == QDOT_OK) {
        qdot_tape_eval(tape, in, out, out + terms.n);
        most = largest_term_sum(e, in, out);
    }
    *too_far = !(most <= harmless || most * roundings * 0x1p-53 <= e->request->tol);
    qdot_tape_free(tape);
    qdot_free(terms.at);
    qdot_free(in);
    qdot_free(out);
    return status;
}

/* --- the whole reduction ------------------------------------------------------------- */

static void
routh_clear(routh *e)
{
    qdot_free(e->cyclic);
    qdot_free(e->order);
    qdot_free(e->M);
    qdot_free(e->in);
}

static qdot_status
routh_init(routh *e)
{
    const size_t n = e->n, outputs = qdot_tape_outputs(e->p->tape);

    e->cyclic = qdot_calloc(2 * n, sizeof *e->cyclic);
    e->order = qdot_calloc(n, sizeof *e->order);
    e->M = qdot_calloc(n * n + 6 * n, sizeof *e->M);
    e->in = qdot_calloc(2 * n + 1 + 2 * outputs + qdot_tape_work(e->p->tape) + 1,
                        sizeof *e->in);
    if (!e->cyclic || !e->order || !e->M || !e->in)
        return QDOT_ENOMEM;
    e->gone = e->cyclic + n;
    e->f = e->M + n * n;
    e->kept = e->f + n;
    e->momentum = e->kept + n;
    e->rest = e->momentum + n;
    e->above = e->rest + n;
    e->rate = e->above + n;
    e->out = e->in + 2 * n + 1;
    e->work = e->out + 2 * outputs;
    memcpy(e->M, e->p->M, n * n * sizeof *e->M);
    memcpy(e->f, e->p->f, n * sizeof *e->f);
    return QDOT_OK;
}

static qdot_status
reduce_plan(routh *e)
{
    bool some, too_far = false;

    QDOT_TRY(find_cyclic_coordinates(e, &some));
    if (!some)
        return QDOT_OK;
    remove_cyclic_coordinates(e);
    for (size_t c; !qdot_pool_failed(e->pool) && (c = choose_shortest_pivot(e)) != SIZE_MAX;) {
        e->order[e->h++] = c;
        eliminate_velocity(e, c);
    }
    QDOT_TRY(qdot_pool_check(e->pool));
    if (e->h > 0)
        QDOT_TRY(choose_insertion(e));
    if (e->p->reduced && has_sum_velocity(e) && e->request->q0 && e->request->v0) {
        e->p->by_start = true;
        QDOT_TRY(check_cancellation(e, &too_far));
    }
    if (too_far) {
        qdot_plan_free(e->p->reduced);
        e->p->reduced = NULL;
    }
    return QDOT_OK;
}

qdot_status
qdot_routh_reduce(qdot_plan *plan, qdot_scene *scene, const qdot_run_request *request)
{
    routh e = {.p = plan,
               .scene = scene,
               .request = request,
               .pool = plan->pool,
               .facts = qdot_scene_facts(scene),
               .n = plan->n};
    qdot_status status = request->by_clock ? QDOT_OK : routh_init(&e);

    if (status == QDOT_OK && !request->by_clock)
        status = reduce_plan(&e);
    routh_clear(&e);
    /* a pivot vanishes, or an expression is undefined at the start: keep the full equations */
    if (status == QDOT_EDOMAIN || status == QDOT_ESINGULAR || status == QDOT_ELIMIT) {
        qdot_plan_free(plan->reduced);
        plan->reduced = NULL;
        return QDOT_OK;
    }
    return status;
}
