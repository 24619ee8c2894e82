/* steady-momenta.c -- the stability of a steady motion at fixed momenta of its cyclic coordinates. */
#include "mech/study/steady-momenta.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/list.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "mech/dynamics/quantity.h"
#include "normal/inequality/less.h"
#include "normal/simplify/positive.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/conditions.h"

enum { MOST_RESTING = 4 };

qdot_status
qdot_steady_is_conservative(qdot_scene *s, bool *is)
{
    qdot_force_source source;

    *is = s->constraints.n == 0 && s->states.n == 0;
    for (size_t k = 0; *is && qdot_mech_source_at(s, k, &source); k++)
        *is = source.conservative;
    return *is ? qdot_mech_energy_conserved(s, is) : qdot_pool_check(s->pool);
}

typedef struct {
    qdot_scene *s;
    qdot_pool *pool;
    size_t k, n;
    const qdot_expr *turning; /* [n] */
    qdot_expr resting[MOST_RESTING], L;
    size_t values;
    qdot_expr *symbol, *value; /* [values] of the steady motion */
} fixed_momenta;

static qdot_expr
second_slope_there(const fixed_momenta *x, qdot_expr a, qdot_expr b)
{
    return qdot_subs(x->pool, qdot_diff(x->pool, qdot_diff(x->pool, x->L, a), b), x->values, x->symbol, x->value);
}

/* H [k x k]; nil entries on failure, which the pool keeps. */
static qdot_status
energy_slopes(const fixed_momenta *x, const qdot_facts *facts, qdot_expr *H)
{
    const size_t n = x->n, k = x->k;
    qdot_expr *W = qdot_calloc(n * n + k * n + 1, sizeof *W), *C = W + n * n, inverse;

    if (W == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n * n; i++)
        W[i] = qdot_simplify(x->pool, second_slope_there(x, qdot_symbol_jet(x->pool, x->turning[i / n], 1),
                                                        qdot_symbol_jet(x->pool, x->turning[i % n], 1)), facts);
    for (size_t i = 0; i < k * n; i++)
        C[i] = second_slope_there(x, x->resting[i / n], qdot_symbol_jet(x->pool, x->turning[i % n], 1));
    inverse = qdot_inverse(x->pool, qdot_matrix(x->pool, (uint32_t)n, (uint32_t)n, W));
    for (size_t i = 0; i < k * k && inverse != QDOT_NIL; i++) {
        qdot_expr sum = qdot_neg(x->pool, second_slope_there(x, x->resting[i / k], x->resting[i % k]));

        for (size_t a = 0; a < n * n; a++)
            sum = qdot_add(x->pool, sum, qdot_product(x->pool, 3, (qdot_expr[]){C[i / k * n + a / n],
                                                                                qdot_expr_arg(x->pool, inverse, (uint32_t)a),
                                                                                C[i % k * n + a % n]}));
        H[i] = qdot_simplify(x->pool, sum, facts);
    }
    qdot_free(W);
    return qdot_pool_check(x->pool);
}

/* e, stable to first order under conditions of its own, is stable wherever the conditions `when` hold: the first remain where
 * they do not imply these. */
static qdot_status
join_verdicts(const fixed_momenta *x, const qdot_facts *facts, qdot_expr when, qdot_equilibrium *e)
{
    if (e->stability == QDOT_STABLE_TO_FIRST_ORDER && when != QDOT_NIL) {
        qdot_expr room[QDOT_CONDITIONS_MOST];
        const qdot_facts linear = qdot_facts_and(x->pool, facts, e->stable_when, room);

        if (qdot_conditions_at(x->pool, when, 0, NULL, NULL, &linear) != QDOT_NIL)
            e->otherwise_to_first_order = e->stable_when == QDOT_NIL ? qdot_list(x->pool, 0, NULL) : e->stable_when;
    }
    e->stability = QDOT_STABLE;
    e->stable_when = when;
    return qdot_pool_check(x->pool);
}

/* Ask that the leading minors of H are positive; their conditions into *when. */
static qdot_status
judge_energy(const fixed_momenta *x, const qdot_facts *facts, const qdot_expr *H, qdot_equilibrium *e)
{
    qdot_expr known[MOST_RESTING], when = QDOT_NIL;

    for (size_t m = 1; m <= x->k; m++) {
        qdot_expr part[MOST_RESTING * MOST_RESTING], minor, answer;
        qdot_decision d;

        for (size_t i = 0; i < m * m; i++)
            part[i] = H[i / m * x->k + i % m];
        minor = m == 1 ? H[0] : qdot_det(x->pool, qdot_matrix(x->pool, (uint32_t)m, (uint32_t)m, part));
        minor = qdot_simplify(x->pool, minor, facts);
        answer = qdot_positive(x->pool, minor, facts, m - 1, known);
        QDOT_TRY(qdot_pool_check(x->pool));
        if (answer == QDOT_FALSE && x->k == 1) {
            QDOT_TRY(qdot_decide_less(x->pool, minor, QDOT_ZERO, true, facts, &d));
            if (d.verdict == QDOT_PROVED) {
                e->stability = QDOT_UNSTABLE;
                e->stable_when = QDOT_NIL;
            }
        }
        if (answer == QDOT_FALSE)
            return QDOT_OK;
        known[m - 1] = minor;
        if (answer != QDOT_TRUE)
            when = qdot_conditions_and(x->pool, when, answer);
    }
    return join_verdicts(x, facts, when, e);
}

/* The coordinates that rest, and the values of the steady motion; *few: they are few enough. */
static qdot_status
read_steady_motion(fixed_momenta *x, const qdot_equilibrium *e, bool *few)
{
    const uint32_t count = qdot_expr_count(x->pool, e->equations);
    qdot_scene *s = x->s;

    x->L = qdot_mech_lagrangian(s);
    *few = true;
    for (size_t i = 0; i < s->coordinates.n; i++) {
        const qdot_expr q = s->coordinates.at[i], rate = qdot_symbol_jet(x->pool, q, 1), zero = QDOT_ZERO;

        if (qdot_expr_place(x->n, x->turning, q) < x->n)
            continue;
        *few = *few && x->k < MOST_RESTING;
        if (*few)
            x->resting[x->k++] = q;
        x->L = qdot_subs(x->pool, x->L, 1, &rate, &zero);
    }
    x->symbol = qdot_calloc(2 * (size_t)count + 1, sizeof *x->symbol);
    if (x->symbol == NULL)
        return QDOT_ENOMEM;
    x->value = x->symbol + count;
    for (uint32_t i = 0; i < count; i++) {
        x->symbol[x->values] = qdot_expr_arg(x->pool, qdot_expr_arg(x->pool, e->equations, i), 0);
        x->value[x->values++] = qdot_expr_arg(x->pool, qdot_expr_arg(x->pool, e->equations, i), 1);
    }
    return qdot_pool_check(x->pool);
}

qdot_status
qdot_steady_at_momenta(qdot_scene *s, size_t n, const qdot_expr *turning, qdot_equilibrium *e)
{
    fixed_momenta x = {.s = s, .pool = s->pool, .n = n, .turning = turning};
    qdot_expr room[QDOT_CONDITIONS_MOST], H[MOST_RESTING * MOST_RESTING];
    qdot_facts facts = qdot_scene_facts(s);
    bool few = false;
    qdot_status status;

    if (e->numeric || e->range != QDOT_NIL)
        return QDOT_OK;
    facts = qdot_facts_and(s->pool, &facts, e->exists, room);
    status = read_steady_motion(&x, e, &few);
    if (status == QDOT_OK && few && x.k > 0) {
        status = energy_slopes(&x, &facts, H);
        if (status == QDOT_ESINGULAR || status == QDOT_EDOMAIN) /* at a pole of the coordinates H has no value */
            status = QDOT_OK;
        else if (status == QDOT_OK)
            status = judge_energy(&x, &facts, H, e);
    }
    qdot_free(x.symbol);
    return status;
}
