/* higher.c -- Lagrangians of second and higher derivatives: total derivatives left out, coordinates for q'', q'''' ... */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/scene/access.h"
#include "mech/scene/scene.h"
#include "normal/integral/antiderivative.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"

enum { MOST_ORDER = 8 /* the highest derivative in a Lagrangian */ };

const qdot_higher *
qdot_higher_find(const qdot_scene *s, qdot_expr u)
{
    for (size_t k = 0; k < s->higher.n; k++)
        if (s->higher.at[k].u == u)
            return &s->higher.at[k];
    return NULL;
}

uint32_t
qdot_higher_order(const qdot_scene *s, qdot_expr q)
{
    uint32_t order = 1;

    for (size_t k = 0; k < s->higher.n; k++)
        order += s->higher.at[k].base == q;
    return order;
}

qdot_status
qdot_higher_refuse(const qdot_scene *s, const char *what)
{
    if (s->higher.n == 0)
        return QDOT_OK;
    return qdot_fail(QDOT_ENOTBUILT, "not built yet: %s of a Lagrangian with %s''", what,
                     qdot_expr_symbol(s->pool, s->higher.at[0].base)->name);
}

/* --- q'', q''' ... and the coordinates for them ------------------------------------------------------------ */

/* Replace derivatives of q by those of the coordinates u, or back. */
static qdot_expr
exchange(const qdot_scene *s, qdot_expr e, bool to_motion)
{
    qdot_pool *pool = s->pool;
    qdot_vec(qdot_expr) from = {0}, to = {0};
    qdot_status status = QDOT_OK;

    for (size_t k = 0; k < s->higher.n && status == QDOT_OK; k++) {
        const qdot_higher *h = &s->higher.at[k];
        const bool last = h->order + 2 == 2 * qdot_higher_order(s, h->base);

        for (uint32_t j = 0; j <= (last ? MOST_ORDER : 1) && status == QDOT_OK; j++) {
            const qdot_expr jet = qdot_symbol_jet(pool, h->base, h->order + j), own = qdot_symbol_jet(pool, h->u, j);

            status = qdot_vec_push(&from, to_motion ? jet : own);
            if (status == QDOT_OK)
                status = qdot_vec_push(&to, to_motion ? own : jet);
        }
    }
    e = status == QDOT_OK ? qdot_subs(pool, e, from.n, from.at, to.at) : qdot_pool_fail(pool);
    qdot_free(from.at);
    qdot_free(to.at);
    return e;
}

qdot_expr
qdot_higher_in_motion(const qdot_scene *s, qdot_expr e)
{
    if (s->higher.n == 0 || e == QDOT_NIL || !(qdot_expr_node(s->pool, e)->holds & QDOT_HAS_ACCELERATION))
        return e;
    return exchange(s, e, true);
}

qdot_expr
qdot_higher_in_jets(const qdot_scene *s, qdot_expr e)
{
    return s->higher.n == 0 || e == QDOT_NIL ? e : exchange(s, e, false);
}

/* --- total derivatives -------------------------------------------------------------------------------------- */

/* The order of the highest derivative of q in e. */
static uint32_t
order_in(const qdot_scene *s, qdot_expr e, qdot_expr q)
{
    uint32_t order = 0;

    for (uint32_t k = 1; k <= MOST_ORDER && e != QDOT_NIL; k++)
        if (qdot_expr_contains(s->pool, e, qdot_symbol_jet(s->pool, q, k)))
            order = k;
    return order;
}

static uint32_t
highest_order(const qdot_scene *s, qdot_expr e)
{
    uint32_t order = 0;

    for (size_t i = 0; i < s->coordinates.n; i++) {
        const uint32_t own = order_in(s, e, s->coordinates.at[i]);

        order = own > order ? own : order;
    }
    return order;
}

/* Take a total derivative dG/dt out of L: dG/dq^(order - 1) is the coefficient of each q^(order) in which L is linear and which is
 * the highest derivative of q. *done: there is none such. x, a [coordinates] are scratch. */
static qdot_status
take_out_derivative(qdot_scene *s, uint32_t order, qdot_expr *L, qdot_expr *x, qdot_expr *a, bool *done)
{
    qdot_pool *pool = s->pool;
    const qdot_facts facts = qdot_scene_facts(s);
    const char *name = NULL;
    size_t n = 0;
    qdot_expr G;

    for (size_t i = 0; i < s->coordinates.n; i++) {
        const qdot_expr top = qdot_symbol_jet(pool, s->coordinates.at[i], order);
        const qdot_expr slope = qdot_simplify(pool, qdot_diff(pool, *L, top), &facts);

        QDOT_TRY(qdot_pool_check(pool));
        if (order_in(s, *L, s->coordinates.at[i]) != order || slope == QDOT_ZERO || highest_order(s, slope) >= order)
            continue;
        name = qdot_expr_symbol(pool, s->coordinates.at[i])->name;
        x[n] = qdot_symbol_jet(pool, s->coordinates.at[i], order - 1);
        a[n++] = slope;
    }
    *done = n == 0;
    if (*done)
        return QDOT_OK;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < i; j++)
            if (!qdot_is_zero(pool, qdot_sub(pool, qdot_diff(pool, a[i], x[j]), qdot_diff(pool, a[j], x[i])), &facts)) {
                QDOT_TRY(qdot_pool_check(pool));
                return qdot_fail(QDOT_ENOTBUILT, "not built yet: a Lagrangian linear in %s, whose equations are of odd order",
                                 qdot_expr_symbol(pool, qdot_symbol_jet(pool, x[i], 1))->name);
            }
    G = qdot_potential_of(pool, n, x, a, &facts);
    QDOT_TRY(qdot_pool_check(pool));
    if (G == QDOT_NIL)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: a Lagrangian linear in a derivative of %s whose coefficient has no integral that was found",
                         name);
    *L = qdot_simplify(pool, qdot_sub(pool, *L, qdot_ddt(pool, G)), &facts);
    for (size_t i = 0; i < n; i++)
        if (qdot_expr_contains(pool, *L, qdot_symbol_jet(pool, x[i], 1)))
            *L = qdot_simplify(pool, qdot_expand(pool, *L), &facts);
    for (size_t i = 0; i < n; i++)
        if (qdot_expr_contains(pool, *L, qdot_symbol_jet(pool, x[i], 1)))
            return qdot_fail(QDOT_ENOTBUILT, "not built yet: a Lagrangian linear in a derivative of %s that does not simplify", name);
    return qdot_pool_check(pool);
}

static qdot_status
leave_out_derivatives(qdot_scene *s, qdot_expr *L)
{
    qdot_expr *room = qdot_calloc(2 * s->coordinates.n + 1, sizeof *room);
    qdot_status status = room == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (uint32_t order = highest_order(s, *L); order > 1 && status == QDOT_OK; order--)
        for (bool done = false; !done && status == QDOT_OK;)
            status = take_out_derivative(s, order, L, room, room + s->coordinates.n, &done);
    qdot_free(room);
    return status;
}

/* --- the coordinates ------------------------------------------------------------------------------------------ */

/* Declare the coordinates that stand for the derivatives of q, of which L holds those up to `order`. */
static qdot_status
add_coordinates(qdot_scene *s, qdot_expr q, uint32_t order)
{
    for (uint32_t k = 1; k < order; k++) {
        const qdot_expr jet = qdot_symbol_jet(s->pool, q, 2 * k);
        qdot_expr u;

        QDOT_TRY(qdot_pool_check(s->pool));
        u = qdot_symbol_get(s->pool, QDOT_COORD, qdot_expr_symbol(s->pool, jet)->name);
        QDOT_TRY(qdot_pool_check(s->pool));
        QDOT_TRY(qdot_vec_push(&s->coordinates, u));
        QDOT_TRY(qdot_vec_push(&s->higher, ((qdot_higher){u, q, 2 * k})));
    }
    return QDOT_OK;
}

/* sum 1/2 q'^2 over all coordinates. */
static qdot_expr
unit_kinetic_energy(qdot_scene *s)
{
    qdot_expr sum = QDOT_ZERO;

    for (size_t i = 0; i < s->coordinates.n; i++)
        sum = qdot_add(s->pool, sum, qdot_pow_int(s->pool, qdot_mech_jet(s, i, 1), 2));
    return qdot_mul(s->pool, QDOT_HALF, sum);
}

void
qdot_higher_forget(qdot_scene *s)
{
    s->coordinates.n -= s->higher.n; /* the last */
    s->higher.n = 0;
    s->higher_lagrangian = QDOT_NIL;
}

qdot_status
qdot_higher_state(qdot_scene *s, qdot_expr *L)
{
    qdot_expr left = qdot_higher_in_jets(s, *L);
    const size_t n = s->coordinates.n - s->higher.n;

    QDOT_TRY(qdot_pool_check(s->pool));
    if (highest_order(s, left) > 1 && s->constraints.n > 0)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: a Lagrangian with second derivatives beside constraints");
    if (highest_order(s, left) > 1)
        QDOT_TRY(qdot_scene_refuse_states(s, left, "a Lagrangian with second derivatives", 0));
    if (highest_order(s, left) > MOST_ORDER / 2)
        return qdot_fail(QDOT_ELIMIT, "a Lagrangian holds derivatives up to the order %d", MOST_ORDER / 2);
    qdot_higher_forget(s);
    if (highest_order(s, left) > 1)
        QDOT_TRY(leave_out_derivatives(s, &left));
    *L = left;
    for (size_t i = 0; i < n; i++)
        QDOT_TRY(add_coordinates(s, s->coordinates.at[i], order_in(s, left, s->coordinates.at[i])));
    if (s->higher.n == 0)
        return QDOT_OK;
    s->higher_lagrangian = qdot_higher_in_motion(s, left);
    *L = unit_kinetic_energy(s);
    return qdot_pool_check(s->pool);
}
