/* hamilton-jacobi.c -- writes the equation of Hamilton and Jacobi, its separated parts and its complete integral. */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "mech/hamilton/hamilton.h"
#include "mech/hamilton/separation.h"
#include "normal/integral/antiderivative.h"
#include "normal/solve/conditions.h"

qdot_status
qdot_separation_equation(qdot_scene *s, qdot_expr H, const qdot_constant_names *names, qdot_expr *equation)
{
    static const char *const letters[] = {"S", "W", "Sigma"};
    qdot_pool *pool = s->pool;
    const uint32_t n = (uint32_t)s->coordinates.n + 1;
    qdot_expr *args = qdot_calloc(n, sizeof *args), S;
    const char *name = letters[0];
    uint32_t id;
    qdot_status status;

    if (args == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; names != NULL && i < sizeof letters / sizeof *letters; i++)
        if (names->is_free(names->user, letters[i])) {
            name = letters[i];
            break;
        }
    for (uint32_t i = 0; i < n; i++)
        args[i] = i + 1 < n ? s->coordinates.at[i] : QDOT_T;
    status = qdot_ufun_declare(pool, name, n, args, &id);
    S = status == QDOT_OK ? qdot_ufun_apply(pool, id, args, NULL) : QDOT_NIL;
    for (uint32_t i = 0; i + 1 < n && status == QDOT_OK; i++)
        H = qdot_subs(pool, H, 1, (qdot_expr[]){qdot_symbol_of(pool, QDOT_MOMENTUM, args[i])},
                      (qdot_expr[]){qdot_diff(pool, S, args[i])});
    if (status == QDOT_OK)
        *equation = qdot_rel(pool, QDOT_EQ, H, qdot_neg(pool, qdot_diff(pool, S, QDOT_T)));
    qdot_free(args);
    return status == QDOT_OK ? qdot_pool_check(pool) : status;
}

qdot_expr
qdot_separated_equation(qdot_pool *pool, const qdot_separated *x)
{
    qdot_expr p = x->p;

    if (x->shift == QDOT_NIL)
        return qdot_rel(pool, QDOT_EQ, x->relation, QDOT_ZERO);
    if (x->square == QDOT_NIL)
        return qdot_rel(pool, QDOT_EQ, p, x->shift);
    p = qdot_sub(pool, p, x->shift);
    return qdot_rel(pool, QDOT_EQ, qdot_mul(pool, p, p), x->square);
}

bool
qdot_separation_is_free(const qdot_separation *x)
{
    for (size_t i = 0; i < x->n; i++)
        if (!x->of[i].cyclic)
            return false;
    return x->verdict == QDOT_SEPARATES;
}

qdot_expr
qdot_separation_integral(qdot_scene *s, const qdot_separation *x)
{
    const qdot_facts of_scene = qdot_scene_facts(s);
    qdot_expr room[QDOT_CONDITIONS_MOST];
    const qdot_facts facts = qdot_facts_and(s->pool, &of_scene, x->signs, room);
    qdot_pool *pool = s->pool;
    const qdot_expr E = qdot_separation_is_free(x) ? x->H : x->energy;
    qdot_expr S = E == QDOT_NIL ? QDOT_ZERO : qdot_neg(pool, qdot_mul(pool, E, QDOT_T));

    if (x->verdict != QDOT_SEPARATES)
        return x->S;
    for (size_t i = 0; i < x->n; i++) {
        const qdot_separated *one = &x->of[i];
        qdot_expr part;

        if (one->cyclic) {
            part = qdot_mul(pool, one->p, one->q);
        } else if (one->shift == QDOT_NIL) {
            return QDOT_NIL;
        } else {
            part = one->shift == QDOT_ZERO ? QDOT_ZERO : qdot_antiderivative_or_integral(pool, one->shift, one->q, &facts);
            if (one->square != QDOT_NIL)
                part = qdot_add(pool, part, qdot_antiderivative_or_integral(pool, qdot_sqrt(pool, one->square), one->q, &facts));
        }
        S = qdot_add(pool, S, part);
    }
    return S;
}
