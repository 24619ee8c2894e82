/* noether.c -- symmetries linear in q and t, and the quantities that they conserve. */
#include "mech/study/noether.h"

#include <math.h>
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/generic-null.h"
#include "mech/dynamics/integrated.h"
#include "mech/dynamics/quantity.h"
#include "mech/dynamics/virtual-work.h"
#include "mech/scene/access.h"
#include "mech/scene/constraint.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"
#include "normal/integral/antiderivative.h"
#include "normal/solve/null-space.h"

enum { MOST_COORDINATES = 16 };

/* An unknown coefficient in the linear ansatz for a symmetry. */
typedef struct {
    enum { BOOST, ROTATION, TRANSLATION, TIME } kind;
    size_t i, j; /* indices in xi_i: b t for a boost, c q_j for a rotation, a for a translation */
} unknown;

typedef struct {
    qdot_scene *s;
    qdot_pool *pool;
    qdot_facts facts;
    qdot_expr L;
    size_t n;
    qdot_expr *E;     /* [n] Lagrange's expressions E_i = d/dt dL/dq_i' - dL/dq_i */
    qdot_expr *slope; /* [3*n*n] derivatives dE_i/dq_j, dE_i/dq_j', dE_i/dq_j'' */
    qdot_vec(unknown) unknowns;
    qdot_vec(qdot_expr) found;
} search;

/* --- conditions for a symmetry ------------------------------------------------------ */

static qdot_expr
noether_jet(const search *f, size_t i, uint32_t order)
{
    return qdot_mech_jet(f->s, i, order);
}

static qdot_expr
noether_slope(const search *f, uint32_t order, size_t i, size_t j)
{
    return f->slope[(order * f->n + i) * f->n + j];
}

/* Euler-Lagrange expression i of the change of L under one unknown coefficient: dE_i(xi) + sum_j dxi_j/dq_i E_j. */
static qdot_expr
variation_component(const search *f, const unknown *u, size_t i)
{
    qdot_pool *pool = f->pool;
    qdot_expr sum = QDOT_ZERO;

    switch (u->kind) {
    case TRANSLATION: return noether_slope(f, 0, i, u->i);
    case TIME: return qdot_diff(pool, f->E[i], QDOT_T);
    case BOOST:
        return qdot_add(pool, qdot_mul(pool, QDOT_T, noether_slope(f, 0, i, u->i)),
                        noether_slope(f, 1, i, u->i));
    case ROTATION:
        for (uint32_t order = 0; order < 3; order++)
            sum = qdot_add(pool, sum,
                           qdot_mul(pool, noether_jet(f, u->j, order), noether_slope(f, order, i, u->i)));
        return i == u->j ? qdot_add(pool, sum, f->E[u->i]) : sum;
    }
    return sum;
}

/* The component xi_j of the symmetry that belongs to one unknown. */
static qdot_expr
symmetry_component(const search *f, const unknown *u, size_t j)
{
    if (u->kind == TIME || u->i != j)
        return QDOT_ZERO;
    return u->kind == TRANSLATION ? QDOT_ONE
           : u->kind == BOOST     ? QDOT_T
                                  : noether_jet(f, u->j, 0);
}

/* The work sum_j (xi_j - tau q_j') F_j of a force F along a symmetry (xi, tau). */
static qdot_expr
work_along_symmetry(const search *f, const unknown *u, const qdot_expr *F)
{
    qdot_expr sum = QDOT_ZERO;

    if (u->kind != TIME)
        return qdot_mul(f->pool, symmetry_component(f, u, u->i), F[u->i]);
    for (size_t j = 0; j < f->n; j++)
        sum = qdot_sub(f->pool, sum, qdot_mul(f->pool, noether_jet(f, j, 1), F[j]));
    return sum;
}

/* The work of a constraint's reaction along a symmetry, on the constraint f = 0: multiples of f are removed. */
static qdot_expr
reaction_work(const search *f, const unknown *u, size_t k, const qdot_expr *F)
{
    const qdot_constraint *c = &f->s->constraints.at[k];
    qdot_expr work;

    if (u->kind == TIME && c->kind == QDOT_HOLONOMIC)
        return qdot_diff(f->pool, c->f, QDOT_T);
    work = work_along_symmetry(f, u, F);
    if (u->kind == TIME && c->kind == QDOT_VELOCITY)
        work = qdot_add(f->pool, work, c->f);
    return work;
}

static size_t
number_of_conditions(const search *f)
{
    return f->n + 1 + f->s->constraints.n;
}

/* Fill the matrix of all conditions on the coefficients, with a column for each of the unknowns [m]. */
static bool
fill_conditions(const search *f, const unknown *u, size_t m, qdot_expr *e)
{
    qdot_expr *F = qdot_calloc(f->n + 1, sizeof *F);

    if (F == NULL) {
        qdot_pool_fail(f->pool);
        return false;
    }
    for (size_t i = 0; i < f->n; i++)
        for (size_t j = 0; j < m; j++)
            e[i * m + j] = variation_component(f, &u[j], i);
    for (size_t i = 0; i < f->n; i++)
        F[i] = qdot_force_total(f->s, i, false, true);
    for (size_t j = 0; j < m; j++)
        e[f->n * m + j] = work_along_symmetry(f, &u[j], F);
    for (size_t k = 0; k < f->s->constraints.n; k++) {
        for (size_t i = 0; i < f->n; i++)
            F[i] = qdot_constraint_slope(f->s, k, i);
        for (size_t j = 0; j < m; j++)
            e[(f->n + 1 + k) * m + j] = reaction_work(f, &u[j], k, F);
    }
    qdot_free(F);
    return !qdot_pool_failed(f->pool);
}

/* --- excluding unknowns by numbers at random points --------------------------------------- */

/* Set possible [columns]: whether some vector of the null space of e, with the same parameters at all points, has a
 * component in the column. */
static qdot_status
mark_reachable_columns(const search *f, const qdot_expr *e, size_t columns, bool *possible)
{
    qdot_pool *pool = f->pool;
    qdot_vec(qdot_expr) parameters = {0};
    qdot_vec(double) values = {0};
    double *basis = NULL;
    size_t count = 0;
    const qdot_expr whole = qdot_list(pool, (uint32_t)(number_of_conditions(f) * columns), e),
                    atoms = qdot_expr_atoms(pool, whole, false);
    qdot_status status = qdot_pool_check(pool);

    for (uint32_t i = 0; status == QDOT_OK && i < qdot_expr_count(pool, atoms); i++) {
        qdot_expr x = qdot_expr_arg(pool, atoms, i);

        if (!qdot_expr_is_class(pool, x, QDOT_PARAM))
            continue;
        status = qdot_vec_push(&parameters, x);
        if (status == QDOT_OK)
            status = qdot_vec_push(&values, qdot_generic_value(pool, x, 1));
    }
    if (status == QDOT_OK)
        status = qdot_generic_null(pool, number_of_conditions(f), columns, e,
                                   &(qdot_generic_point){parameters.n, parameters.at, values.at, 0}, &basis, &count);
    for (size_t j = 0; status == QDOT_OK && j < columns; j++) {
        double along = 0;

        for (size_t k = 0; k < count; k++)
            along = hypot(along, basis[k * columns + j]);
        possible[j] = along > 1e-6;
    }
    qdot_free(parameters.at);
    qdot_free(values.at);
    qdot_free(basis);
    return status;
}

/* --- from a symmetry to its conserved quantity -------------------------------------------- */

/* The component xi_j of the symmetry with coefficients v [m] of the unknowns. */
static qdot_expr
combine_symmetry_component(const search *f, const unknown *u, size_t m, const qdot_expr *v, size_t j)
{
    qdot_expr sum = QDOT_ZERO;

    for (size_t k = 0; k < m; k++)
        if (v[k] != QDOT_ZERO)
            sum = qdot_add(f->pool, sum, qdot_mul(f->pool, v[k], symmetry_component(f, &u[k], j)));
    return sum;
}

/* K with dK/dt = F, F linear in q': dK/dq_i = dF/dq_i', one coordinate after another, then t. False:
 * none was found. */
static bool
antiderivative_in_time(const search *f, qdot_expr F, qdot_expr *K)
{
    qdot_pool *pool = f->pool;
    qdot_expr rest = F;

    *K = QDOT_ZERO;
    for (size_t i = 0; i <= f->n && rest != QDOT_ZERO; i++) {
        qdot_expr x = i < f->n ? noether_jet(f, i, 0) : QDOT_T, part;

        part = qdot_antiderivative(
            pool, i < f->n ? qdot_diff(pool, rest, noether_jet(f, i, 1)) : rest, x, &f->facts);
        if (part == QDOT_NIL)
            break;
        *K = qdot_add(pool, *K, part);
        rest = qdot_expand(pool, qdot_sub(pool, rest, qdot_ddt(pool, part)));
    }
    if (qdot_pool_failed(pool))
        return false;
    *K = qdot_simplify(pool, *K, &f->facts);
    return *K != QDOT_NIL &&
           qdot_is_zero(pool, qdot_sub(pool, qdot_ddt(pool, *K), F), &f->facts);
}

/* Whether applied forces and reactions do no work along the symmetry with coefficients v: rows of e times v vanish. */
static bool
forces_do_no_work(const search *f, size_t m, const qdot_expr *e, const qdot_expr *v)
{
    for (size_t i = f->n; i < number_of_conditions(f); i++) {
        qdot_expr sum = QDOT_ZERO;

        for (size_t k = 0; k < m; k++)
            if (v[k] != QDOT_ZERO)
                sum = qdot_add(f->pool, sum, qdot_mul(f->pool, v[k], e[i * m + k]));
        if (!qdot_is_zero(f->pool, sum, &f->facts))
            return false;
    }
    return true;
}

/* Multiply the coefficients v [m] by their common denominator, and return it. */
static qdot_expr
remove_denominators(qdot_pool *pool, size_t m, const qdot_expr *v)
{
    qdot_expr all = QDOT_ONE;
    fmpz_t lcm;

    fmpz_init_set_ui(lcm, 1);
    for (size_t k = 0; k < m && all != QDOT_NIL; k++) {
        qdot_expr rest = qdot_mul(pool, v[k], all);
        const fmpq *c = qdot_expr_rational(pool, v[k]);

        if (rest != QDOT_NIL && qdot_expr_kind(pool, rest) == QDOT_PROD) {
            c = qdot_expr_rational(pool, qdot_expr_arg(pool, rest, 0));
            for (uint32_t i = 1; i < qdot_expr_count(pool, rest); i += 2) {
                qdot_expr x = qdot_expr_arg(pool, rest, i + 1);

                if (qdot_expr_is_negative(pool, x))
                    all = qdot_mul(pool, all,
                                   qdot_pow(pool, qdot_expr_arg(pool, rest, i),
                                            qdot_neg(pool, x)));
            }
        }
        if (c != NULL)
            fmpz_lcm(lcm, lcm, fmpq_denref(c));
    }
    if (!fmpz_is_one(lcm)) {
        fmpq_t c;

        fmpq_init(c);
        fmpq_set_fmpz(c, lcm);
        all = qdot_mul(pool, all, qdot_expr_fmpq(pool, c));
        fmpq_clear(c);
    }
    fmpz_clear(lcm);
    return all;
}

/* Choose the sign that books use: positive for the energy, else for x y' - y x', else for a translation. */
static void
choose_conventional_sign(const search *f, const unknown *u, size_t m, qdot_expr *v)
{
    qdot_pool *pool = f->pool;
    size_t lead = m;
    int best = 0;

    for (size_t k = m; k-- > 0;) { /* search from the end, where the unknowns of the first coordinates are */
        int rank = u[k].kind == TIME                          ? 4
                   : u[k].kind == ROTATION && u[k].i > u[k].j ? 3
                   : u[k].kind == TRANSLATION                 ? 2
                                                              : 1;

        v[k] = qdot_simplify(pool, v[k], NULL);
        if (v[k] != QDOT_ZERO && rank > best) {
            best = rank;
            lead = k;
        }
    }
    if (lead < m && v[lead] != QDOT_NIL && qdot_expr_is_negative(pool, v[lead]))
        for (size_t k = 0; k < m; k++)
            v[k] = qdot_neg(pool, v[k]);
}

/* The quantity tau h - sum, in the shorter of two forms: with h as the energy is printed, or expanded. */
static qdot_expr
express_by_energy(const search *f, qdot_expr tau, qdot_expr sum)
{
    qdot_pool *pool = f->pool;
    qdot_expr h = qdot_mul(pool, tau, qdot_mech_energy(f->s)), apart, whole;

    apart = qdot_sub(pool, h, qdot_simplify(pool, sum, &f->facts));
    whole = qdot_simplify(pool, qdot_expand(pool, qdot_sub(pool, h, sum)), &f->facts);
    if (apart == QDOT_NIL || whole == QDOT_NIL)
        return QDOT_NIL;
    return qdot_expr_size(pool, whole) < qdot_expr_size(pool, apart) ? whole : apart;
}

/* The conserved quantity of the symmetry v; nil unless it is proved. */
static qdot_expr
quantity(const search *f, const unknown *u, size_t m, const qdot_expr *e,
         const qdot_expr *v)
{
    qdot_pool *pool = f->pool;
    qdot_expr change = QDOT_ZERO, sum = QDOT_ZERO, tau = QDOT_ZERO, K;
    const uint32_t motion = QDOT_HAS_COORD | QDOT_HAS_VELOCITY;

    if (!forces_do_no_work(f, m, e, v))
        return QDOT_NIL;
    for (size_t k = 0; k < m; k++)
        if (u[k].kind == TIME)
            tau = v[k];
    for (size_t j = 0; j < f->n; j++) {
        qdot_expr xi = combine_symmetry_component(f, u, m, v, j), q = noether_jet(f, j, 0), qdot = noether_jet(f, j, 1);

        change = qdot_add(pool, change, qdot_mul(pool, xi, qdot_diff(pool, f->L, q)));
        change =
            qdot_add(pool, change,
                     qdot_mul(pool, qdot_ddt(pool, xi), qdot_diff(pool, f->L, qdot)));
        if (xi != QDOT_ZERO)
            sum = qdot_add(pool, sum, qdot_mul(pool, xi, qdot_mech_momentum(f->s, q)));
    }
    if (tau != QDOT_ZERO)
        change =
            qdot_add(pool, change, qdot_mul(pool, tau, qdot_diff(pool, f->L, QDOT_T)));
    change = qdot_simplify(pool, change, &f->facts);
    if (change == QDOT_NIL || !antiderivative_in_time(f, change, &K))
        return QDOT_NIL;
    sum = qdot_sub(pool, sum, K);
    if (tau == QDOT_ZERO)
        sum = qdot_simplify(pool, sum, &f->facts);
    else
        sum = express_by_energy(f, tau, sum);
    return qdot_mech_holds(f->s, sum) & motion ? sum : QDOT_NIL;
}

/* The conserved quantity for coefficients v, or for v without denominators if that is shorter. */
static qdot_expr
shortest_quantity(const search *f, size_t m, const qdot_expr *e, qdot_expr *v)
{
    qdot_pool *pool = f->pool;
    qdot_expr by, one, other;

    choose_conventional_sign(f, f->unknowns.at, m, v);
    one = quantity(f, f->unknowns.at, m, e, v);
    by = remove_denominators(pool, m, v);
    if (one == QDOT_NIL || by == QDOT_ONE || by == QDOT_NIL)
        return one;
    for (size_t k = 0; k < m; k++)
        v[k] = qdot_simplify(pool, qdot_mul(pool, v[k], by), NULL);
    other = quantity(f, f->unknowns.at, m, e, v);
    /* of two equally long expressions take the one without fractions: 3*m1*x1' + 2*m2*x2' */
    return other != QDOT_NIL &&
                   qdot_expr_size(pool, other) <
                       qdot_expr_size(pool, one) + (qdot_expr_kind(pool, by) == QDOT_NUM)
               ? other
               : one;
}

/* --- the search for symmetries -------------------------------------------------------- */

static qdot_status
noether_add_unknown(search *f, int kind, size_t i, size_t j)
{
    unknown u = {.i = i, .j = j};

    u.kind = kind;
    return qdot_vec_push(&f->unknowns, u);
}

/* List the unknown coefficients of symmetries that are not conserved quantities already. Later ones are preferred
 * as pivots, so complicated ones come first. */
static qdot_status
list_unknowns(search *f, const bool *cyclic, bool energy)
{
    for (size_t i = f->n; i-- > 0;)
        QDOT_TRY(noether_add_unknown(f, BOOST, i, 0));
    for (size_t i = f->n; i-- > 0;)
        for (size_t j = f->n; j-- > 0;)
            if (j >= i)
                QDOT_TRY(noether_add_unknown(f, ROTATION, i, j));
    for (size_t i = f->n; i-- > 0;)
        for (size_t j = i; j-- > 0;)
            QDOT_TRY(noether_add_unknown(f, ROTATION, i, j));
    if (!energy)
        QDOT_TRY(noether_add_unknown(f, TIME, 0, 0));
    for (size_t i = f->n; i-- > 0;)
        if (!cyclic[i])
            QDOT_TRY(noether_add_unknown(f, TRANSLATION, i, 0));
    return QDOT_OK;
}

static qdot_status
fill_euler_lagrange(search *f)
{
    qdot_pool *pool = f->pool;
    size_t n = f->n;

    f->E = qdot_calloc(n + 3 * n * n + 1, sizeof *f->E);
    if (f->E == NULL)
        return QDOT_ENOMEM;
    f->slope = f->E + n;
    for (size_t i = 0; i < n; i++) {
        qdot_expr p = qdot_diff(pool, f->L, noether_jet(f, i, 1));

        f->E[i] = qdot_sub(pool, qdot_ddt(pool, p), qdot_diff(pool, f->L, noether_jet(f, i, 0)));
        for (uint32_t order = 0; order < 3; order++)
            for (size_t j = 0; j < n; j++)
                f->slope[(order * n + i) * n + j] =
                    qdot_diff(pool, f->E[i], noether_jet(f, j, order));
    }
    return qdot_pool_check(pool);
}

/* Find all symmetries of the ansatz that random numerical points have not excluded. */
static qdot_status
search_linear(search *f)
{
    size_t all = f->unknowns.n, m = 0, count = 0;
    qdot_expr *e = qdot_calloc(number_of_conditions(f) * all + 1, sizeof *e), *basis = NULL;
    bool *possible = qdot_calloc(all + 1, sizeof *possible);
    qdot_status status = QDOT_ENOMEM;

    if (e != NULL && possible != NULL)
        status = fill_euler_lagrange(f);
    if (status == QDOT_OK && !fill_conditions(f, f->unknowns.at, all, e))
        status = qdot_pool_check(f->pool);
    if (status == QDOT_OK)
        status = mark_reachable_columns(f, e, all, possible);
    if (status == QDOT_OK) {
        for (size_t j = 0; j < all; j++)
            if (possible[j])
                f->unknowns.at[m++] = f->unknowns.at[j];
        if (m > 0 && !fill_conditions(f, f->unknowns.at, m, e))
            status = qdot_pool_check(f->pool);
    }
    if (status == QDOT_OK && m > 0)
        status = qdot_null_space(f->pool, number_of_conditions(f), m, e, &basis, &count);
    if (status == QDOT_ELIMIT) /* what is guessed here is proved below */
        status = qdot_generic_null_exact(f->pool, number_of_conditions(f), m, e, &basis, &count);
    for (size_t k = count; k-- > 0 && status == QDOT_OK;) {
        qdot_expr one = shortest_quantity(f, m, e, basis + k * m);
        bool jumps = true;

        status = qdot_pool_check(f->pool);
        if (status == QDOT_OK && one != QDOT_NIL) /* leave out a quantity that may jump where derivatives of L jump */
            status = qdot_jumps(f->pool, one, UINT32_MAX, &jumps);
        if (status == QDOT_OK && !jumps)
            status = qdot_vec_push(&f->found, one);
    }
    qdot_free(basis);
    qdot_free(possible);
    qdot_free(e);
    qdot_free(f->E);
    f->E = NULL;
    return status == QDOT_ELIMIT ? QDOT_OK : status;
}

static qdot_status
conserved(search *f)
{
    qdot_cyclic *list = NULL;
    size_t count = 0;
    bool *cyclic = qdot_calloc(f->n + 1, sizeof *cyclic), energy = false, jumps = false;
    qdot_status status =
        cyclic == NULL ? QDOT_ENOMEM : qdot_mech_cyclic(f->s, &list, &count);

    for (size_t k = 0; k < count && status == QDOT_OK; k++)
        for (size_t i = 0; i < f->n; i++)
            if (list[k].coordinate == f->s->coordinates.at[i] &&
                list[k].rate == QDOT_NIL) {
                cyclic[i] = true;
                status = qdot_vec_push(&f->found, list[k].momentum);
            }
    if (status == QDOT_OK)
        status = qdot_mech_energy_conserved(f->s, &energy);
    if (status == QDOT_OK && energy) {
        qdot_expr h = qdot_mech_energy(f->s);

        status = qdot_pool_check(f->pool);
        if (status == QDOT_OK &&
            qdot_mech_holds(f->s, h) & (QDOT_HAS_COORD | QDOT_HAS_VELOCITY))
            status = qdot_vec_push(&f->found, h);
    }
    if (status == QDOT_OK && f->n <= MOST_COORDINATES)
        status = list_unknowns(f, cyclic, energy);
    if (status == QDOT_OK && f->unknowns.n > 0) {
        f->L = qdot_mech_lagrangian(f->s);
        status = qdot_pool_check(f->pool);
        if (status == QDOT_OK)
            status = qdot_jumps(f->pool, f->L, QDOT_HAS_TIME, &jumps);
        if (status == QDOT_OK && !jumps)
            status = search_linear(f);
    }
    for (size_t k = 0; k < f->s->constraints.n && status == QDOT_OK; k++) { /* integrable velocity constraints */
        qdot_expr mu, F = QDOT_NIL;

        if (f->s->constraints.at[k].kind == QDOT_VELOCITY)
            F = qdot_integrated_of(f->s, k, &mu);
        status = qdot_pool_check(f->pool);
        if (status == QDOT_OK && F != QDOT_NIL)
            status = qdot_vec_push(&f->found, F);
    }
    qdot_free(list);
    qdot_free(cyclic);
    return status;
}

qdot_expr
qdot_noether_conserved(qdot_scene *s)
{
    search f = {
        .s = s, .pool = s->pool, .facts = qdot_scene_facts(s), .n = s->coordinates.n};
    qdot_status status = qdot_scene_need_no_states(s, "symmetries");
    qdot_expr result = QDOT_NIL;

    if (status == QDOT_OK)
        status = conserved(&f);

    if (status == QDOT_OK)
        result = qdot_list(s->pool, (uint32_t)f.found.n, f.found.at);
    else
        qdot_pool_fail(s->pool);
    qdot_free(f.unknowns.at);
    qdot_free(f.found.at);
    return result;
}
