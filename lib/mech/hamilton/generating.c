/* generating.c -- a generating function of a canonical transformation. */
#include "mech/hamilton/generating.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/function.h"
#include "expr/node.h"
#include "normal/integral/antiderivative.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/simultaneous.h"

/* What the four types differ in. */
static const struct {
    bool old_momenta, new_momenta; /* F is of p, not q; of P, not Q */
    int old_sign, new_sign;        /* of the derivatives by the old and the new variables */
} types[] = {{false, false, 1, -1}, {false, true, 1, 1}, {true, false, -1, -1}, {true, true, -1, 1}};

typedef struct {
    qdot_pool *pool;
    const qdot_transformation *x;
    const qdot_facts *facts;
    size_t n;
    int type;
    const qdot_expr *variable[2]; /* [n] the old and the new variables of F */
    const qdot_expr *sought;      /* [n] the old ones that are solved for */
    const qdot_expr *equal;       /* [n] the new variables as functions of the old ones */
    const qdot_expr *other;       /* [n] the other new ones, as functions of the old ones */
    qdot_expr *u, *a, *f;         /* [2n] the variables of F, its derivatives; [n] equations */
} search;

/* What is 0 where the new variable k has the value of its function; atan2(y, x) = Q as y cos(Q) - x sin(Q) = 0. */
static qdot_expr
equation_of(const search *s, size_t k)
{
    qdot_pool *pool = s->pool;
    const qdot_expr e = s->equal[k], Q = s->variable[1][k];

    if (qdot_expr_kind(pool, e) == QDOT_FUN && qdot_expr_node(pool, e)->op == QDOT_ATAN2)
        return qdot_sub(pool, qdot_mul(pool, qdot_expr_arg(pool, e, 0), qdot_fun1(pool, QDOT_COS, Q)),
                        qdot_mul(pool, qdot_expr_arg(pool, e, 1), qdot_fun1(pool, QDOT_SIN, Q)));
    return qdot_sub(pool, e, Q);
}

/* The derivatives of F, in its variables, by a solution for the sought ones. */
static void
find_derivatives(const search *s, qdot_expr values)
{
    for (size_t k = 0; k < 2 * s->n; k++) {
        const bool new = k >= s->n;
        const int sign = new ? types[s->type].new_sign : types[s->type].old_sign;
        qdot_expr e = qdot_simultaneous_put(s->pool, new ? s->other[k - s->n] : s->sought[k], values);

        e = qdot_simplify(s->pool, e, s->facts);
        s->a[k] = sign < 0 ? qdot_neg(s->pool, e) : e;
    }
}

/* Whether the derivatives of F are what they must be, for all old coordinates and momenta. */
static bool
are_derivatives_proved(const search *s, qdot_expr F)
{
    for (size_t k = 0; k < 2 * s->n; k++) {
        const bool new = k >= s->n;
        const int sign = new ? types[s->type].new_sign : types[s->type].old_sign;
        const qdot_expr wanted = new ? s->other[k - s->n] : s->sought[k];
        qdot_expr slope = qdot_diff(s->pool, F, s->u[k]);

        slope = slope == QDOT_NIL ? slope : qdot_subs(s->pool, slope, (uint32_t)s->n, s->variable[1], s->equal);
        if (slope == QDOT_NIL ||
            !qdot_is_zero(s->pool, sign < 0 ? qdot_add(s->pool, slope, wanted) : qdot_sub(s->pool, slope, wanted), s->facts))
            return false;
    }
    return true;
}

static qdot_status
try_type(search *s, qdot_expr *F)
{
    qdot_pool *pool = s->pool;
    qdot_simultaneous found = {0};
    qdot_status status;

    for (size_t k = 0; k < s->n; k++) {
        s->u[k] = s->variable[0][k];
        s->u[s->n + k] = s->variable[1][k];
        s->f[k] = equation_of(s, k);
    }
    QDOT_TRY(qdot_pool_check(pool));
    status = qdot_simultaneous_all(pool, s->n, s->f, s->sought, QDOT_NIL, s->facts, &found);
    for (size_t i = 0; status == QDOT_OK && i < found.found.n && *F == QDOT_NIL; i++) {
        find_derivatives(s, found.found.at[i].values);
        status = qdot_pool_check(pool);
        if (status == QDOT_OK)
            *F = qdot_potential_of(pool, 2 * s->n, s->u, s->a, s->facts);
        if (*F != QDOT_NIL && !are_derivatives_proved(s, *F))
            *F = QDOT_NIL;
    }
    qdot_simultaneous_clear(&found);
    return status;
}

/* Choose variables and equations of a type. */
static void
set_type(search *s, int type)
{
    const qdot_transformation *x = s->x;
    const bool p = types[type].old_momenta, P = types[type].new_momenta;

    s->type = type;
    s->variable[0] = p ? x->p : x->q;
    s->variable[1] = P ? x->P : x->Q;
    s->sought = p ? x->q : x->p;
    s->equal = P ? x->P_of : x->Q_of;
    s->other = P ? x->Q_of : x->P_of;
}

qdot_status
qdot_generating_find(qdot_pool *pool, const qdot_transformation *x, const qdot_facts *facts, int *type, qdot_expr *F)
{
    search s = {.pool = pool, .x = x, .facts = facts, .n = x->n};
    qdot_status status;

    *F = QDOT_NIL;
    s.u = qdot_calloc(5 * x->n + 1, sizeof *s.u);
    status = s.u == NULL ? QDOT_ENOMEM : QDOT_OK;
    s.a = s.u + 2 * x->n;
    s.f = s.a + 2 * x->n;
    for (int k = 0; k < 4 && status == QDOT_OK && *F == QDOT_NIL; k++) {
        set_type(&s, k);
        status = try_type(&s, F);
        if (status != QDOT_OK)
            status = qdot_grave(status); /* past a budget: another type may be simpler */
        *type = k + 1;
    }
    qdot_free(s.u);
    return status;
}
