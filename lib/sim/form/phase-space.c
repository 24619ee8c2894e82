/* phase-space.c -- canonical momenta p and their rates as tapes; q' from p by the factors of M. */
#include "sim/form/phase-space.h"

#include <string.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "num/ldlt.h"
#include "sim/model/substitute.h"

struct qdot_phase {
    const qdot_phase_space *space;
    qdot_ode_phase callbacks;
    qdot_ldlt ldlt;
    double *in, *out, *M, *work; /* inputs [2n + 1]; outputs [n + n(n + 1)/2]; M [n x n]; scratch */
};

void
qdot_phase_space_free(qdot_phase_space *s)
{
    if (!s)
        return;
    qdot_tape_free(s->momenta);
    qdot_tape_free(s->masses);
    qdot_tape_free(s->forces);
    qdot_free(s);
}

/* --- making the expressions --------------------------------------------------------- */

/* Write the momenta p [n] with the plan's parameter values; switching functions stay as they are in
 * every mode. */
static qdot_status
find_momenta(qdot_scene *scene, const qdot_plan *plan, qdot_expr *p)
{
    const size_t states = plan->n_states;
    const qdot_expr all = qdot_mech_momenta(scene);

    QDOT_TRY(qdot_pool_check(plan->pool));
    for (size_t i = 0; i < plan->n; i++)
        p[i] = i < plan->n - states
                   ? qdot_plan_substitute(plan, qdot_expr_arg(plan->pool, all, (uint32_t)i))
                   : plan->inputs[plan->n + i];
    return qdot_pool_check(plan->pool);
}

/* The time derivative of p without the terms of accelerations: sum_j dp/dq_j q_j' + dp/dt. */
static qdot_expr
rate_without_accelerations(const qdot_plan *plan, qdot_expr p)
{
    qdot_pool *pool = plan->pool;
    qdot_expr sum = qdot_diff(pool, p, QDOT_T);

    for (size_t j = 0; j < plan->n; j++)
        sum = qdot_add(pool, sum, qdot_mul(pool, qdot_diff(pool, p, plan->inputs[j]),
                                           plan->inputs[plan->n + j]));
    return sum;
}

static bool
contains_velocity(const qdot_plan *plan, qdot_expr e)
{
    return (qdot_expr_node(plan->pool, e)->holds & QDOT_HAS_VELOCITY) != 0;
}

/* Write the expressions for the tapes of make_phase_tapes: p [n], p' [n], b [n] and M. */
static qdot_status
write_expressions(qdot_scene *scene, const qdot_plan *plan, qdot_expr *p, bool *needed)
{
    const size_t n = plan->n;
    qdot_pool *pool = plan->pool;
    qdot_expr *force = p + n, *b = force + n, *M = b + n, *zero = M + n * (n + 1) / 2;

    *needed = scene->constraints.n > 0;
    QDOT_TRY(find_momenta(scene, plan, p));
    for (size_t i = 0; i < n; i++)
        zero[i] = QDOT_ZERO;
    for (size_t i = 0; i < n; i++) {
        const qdot_expr moved = rate_without_accelerations(plan, p[i]);

        *needed = *needed || moved != QDOT_ZERO;
        force[i] = qdot_add(pool, plan->f[i], moved);
        b[i] = qdot_substitute(pool, p[i], n, plan->inputs + n, zero);
        for (size_t j = 0; j <= i; j++) {
            *M = plan->M[i * n + j];
            QDOT_TRY(qdot_pool_check(pool));
            if (contains_velocity(plan, *M++))
                return qdot_fail(QDOT_ENOTBUILT, "%s needs momenta that are linear in velocities",
                                 plan->method->name);
        }
    }
    return qdot_pool_check(pool);
}

static qdot_status
make_phase_tapes(const qdot_plan *plan, const qdot_expr *p, qdot_phase_space *s)
{
    const size_t n = plan->n, inputs = 2 * n + 1;

    QDOT_TRY(qdot_tape_new(plan->pool, inputs, plan->inputs, n, p, &s->momenta));
    QDOT_TRY(qdot_tape_new(plan->pool, inputs, plan->inputs, n, p + n, &s->forces));
    return qdot_tape_new(plan->pool, inputs, plan->inputs, n + n * (n + 1) / 2, p + 2 * n,
                         &s->masses);
}

qdot_status
qdot_phase_space_new(qdot_scene *scene, const qdot_plan *plan, qdot_phase_space **space)
{
    const size_t n = plan->n;
    qdot_expr *p = qdot_calloc(4 * n + n * (n + 1) / 2, sizeof *p);
    qdot_phase_space *s = qdot_calloc(1, sizeof *s);
    bool needed = false;
    qdot_status status = p && s ? write_expressions(scene, plan, p, &needed) : QDOT_ENOMEM;

    *space = NULL;
    if (status == QDOT_OK && needed) {
        s->n = n;
        status = make_phase_tapes(plan, p, s);
    }
    qdot_free(p);
    if (status == QDOT_OK && needed)
        *space = s;
    else
        qdot_phase_space_free(s);
    return status;
}

/* --- evaluating momenta and forces -------------------------------------------------- */

static void
evaluate_tape(qdot_phase *x, const qdot_tape *tape, double t, const double *q, const double *v,
              double *out)
{
    const size_t n = x->space->n;

    memcpy(x->in, q, n * sizeof *q);
    if (v)
        memcpy(x->in + n, v, n * sizeof *v);
    x->in[2 * n] = t;
    qdot_tape_eval(tape, x->in, out, x->work);
}

static qdot_status
find_momenta_of_state(double t, const double *q, const double *v, double *p, void *user)
{
    qdot_phase *x = user;

    evaluate_tape(x, x->space->momenta, t, q, v, p);
    return QDOT_OK;
}

static qdot_status
find_velocities(double t, const double *q, const double *p, double *v, void *user)
{
    qdot_phase *x = user;
    const size_t n = x->space->n;
    const double *M = x->out + n;
    size_t failed;

    evaluate_tape(x, x->space->masses, t, q, NULL, x->out);
    for (size_t i = 0; i < n; i++) {
        v[i] = p[i] - x->out[i];
        for (size_t j = 0; j <= i; j++)
            x->M[i * n + j] = *M++;
    }
    if (qdot_ldlt_factor(&x->ldlt, x->M, &failed) != QDOT_OK)
        return qdot_fail(QDOT_ESINGULAR, "the mass matrix is singular");
    qdot_ldlt_solve(&x->ldlt, x->M, v);
    return QDOT_OK;
}

static qdot_status
find_momentum_rates(double t, const double *q, const double *v, double *F, void *user)
{
    qdot_phase *x = user;

    evaluate_tape(x, x->space->forces, t, q, v, F);
    return QDOT_OK;
}

static size_t
largest_tape_work(const qdot_phase_space *s)
{
    const qdot_tape *tapes[] = {s->momenta, s->masses, s->forces};
    size_t most = 0;

    for (int i = 0; i < 3; i++)
        most = qdot_tape_work(tapes[i]) > most ? qdot_tape_work(tapes[i]) : most;
    return most;
}

qdot_status
qdot_phase_new(const qdot_phase_space *space, qdot_phase **phase)
{
    const size_t n = space->n, outputs = n + n * (n + 1) / 2;
    qdot_phase *x = qdot_calloc(1, sizeof *x);

    *phase = x;
    if (!x)
        return QDOT_ENOMEM;
    x->space = space;
    x->callbacks = (qdot_ode_phase){find_momenta_of_state, find_velocities, find_momentum_rates, x};
    x->in = qdot_calloc(2 * n + 1 + outputs + n * n + largest_tape_work(space) + 1, sizeof *x->in);
    if (!x->in)
        return QDOT_ENOMEM;
    x->out = x->in + 2 * n + 1;
    x->M = x->out + outputs;
    x->work = x->M + n * n;
    return qdot_ldlt_init(&x->ldlt, n);
}

void
qdot_phase_free(qdot_phase *x)
{
    if (!x)
        return;
    qdot_ldlt_clear(&x->ldlt);
    qdot_free(x->in);
    qdot_free(x);
}

const qdot_ode_phase *
qdot_phase_get(const qdot_phase *x)
{
    return &x->callbacks;
}
