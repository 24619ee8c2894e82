/* export-given.c -- finds the values that `set` gave to functions and parameters. */
#include "lang/declare/export-given.h"

#include <math.h>

#include "expr/node.h"
#include "expr/symbol.h"
#include "lang/session/bind.h"
#include "expr/unit.h"
#include "lang/session/values.h"
#include "sim/model/substitute.h"

/* What the value of an input may hold, and that of a parameter may not. */
enum { MOVING = QDOT_HAS_TIME | QDOT_HAS_COORD | QDOT_HAS_VELOCITY };

qdot_status
qdot_given_functions_find(qdot_session *s, qdot_given_functions *f)
{
    for (size_t i = 0; i < s->values->set_symbols.n; i++)
        if (qdot_expr_kind(s->pool, s->values->set_symbols.at[i]) == QDOT_UFUN ||
            (qdot_expr_node(s->pool, s->values->set_values.at[i])->holds & MOVING) != 0) {
            QDOT_TRY(qdot_vec_push(&f->heads, s->values->set_symbols.at[i]));
            QDOT_TRY(qdot_vec_push(&f->bodies, s->values->set_values.at[i]));
        }
    return QDOT_OK;
}

void
qdot_given_functions_clear(qdot_given_functions *f)
{
    qdot_free(f->heads.at);
    qdot_free(f->bodies.at);
}

qdot_expr
qdot_export_bound(qdot_session *s, qdot_expr e)
{
    qdot_given_functions f = {0};

    if (qdot_given_functions_find(s, &f) != QDOT_OK)
        e = qdot_pool_fail(s->pool);
    if (f.heads.n > 0 && e != QDOT_NIL)
        e = qdot_substitute(s->pool, e, f.heads.n, f.heads.at, f.bodies.at);
    qdot_given_functions_clear(&f);
    return e == QDOT_NIL ? e : qdot_expr_in_si(s->pool, e);
}

qdot_status
qdot_export_value_of(qdot_session *s, qdot_expr parameter, double *value)
{
    *value = NAN;
    return qdot_session_value_set(s, parameter) == QDOT_NIL ? QDOT_OK : qdot_session_number(s, parameter, value, NULL);
}
