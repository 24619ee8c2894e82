/* integral.c -- integral(e, x) and integral(e, x, a, b): reads the arguments, maps over lists, vectors and matrices. */
#include "lang/functions/builtin.h"

#include "base/text.h"
#include "expr/integral.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/value-kind.h"
#include "lang/functions/algebra.h"
#include "lang/session/momenta.h"
#include "lang/session/units.h"
#include "mech/scene/things.h"
#include "normal/integral/antiderivative.h"
#include "normal/integral/definite.h"

typedef struct {
    qdot_session *session;
    qdot_expr x, lo, hi; /* lo, hi: nil for an antiderivative */
    qdot_status status;
} integration;

/* Fail because the integral of e diverges, or its integrand is not real, at a place (nil: not known). */
static qdot_status
refuse_place(qdot_session *s, const char *what, const char *where, qdot_expr at)
{
    qdot_text text = {0};
    qdot_status status = at == QDOT_NIL ? QDOT_OK : qdot_print(s->pool, at, QDOT_PLAIN, &text);

    if (status == QDOT_OK)
        status = qdot_text_status(&text);
    if (status == QDOT_OK)
        status = at == QDOT_NIL ? qdot_fail(QDOT_EDOMAIN, "%s", what)
                                : qdot_fail(QDOT_EDOMAIN, "%s %s %.200s", what, where, qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

/* Integrate the scalar e from lo to hi; what is not found stands as an integral. */
static qdot_expr
integrate_between(integration *i, qdot_expr e, const qdot_facts *facts)
{
    qdot_definite_answer answer;

    i->status = qdot_definite_by_cases(i->session->pool, e, i->x, i->lo, i->hi, facts, &answer);
    if (i->status != QDOT_OK)
        return QDOT_NIL;
    switch (answer.kind) {
    case QDOT_DEFINITE_FOUND: return answer.value;
    case QDOT_DEFINITE_DIVERGES:
        i->status = refuse_place(i->session, "the integral diverges", "at", answer.at);
        break;
    case QDOT_DEFINITE_UNDEFINED:
        i->status = refuse_place(i->session, "the integrand is not real in a part of the range", "that begins at", answer.at);
        break;
    default: return qdot_integral(i->session->pool, e, i->x, i->lo, i->hi);
    }
    return QDOT_NIL;
}

/* Integrate a scalar; of an antiderivative that is not found, an integral stands. */
static qdot_expr
integrate_scalar(qdot_pool *pool, qdot_expr e, void *user)
{
    integration *i = user;
    qdot_facts facts = qdot_scene_facts(i->session->scene);

    if (i->status != QDOT_OK)
        return QDOT_NIL;
    return i->lo == QDOT_NIL ? qdot_antiderivative_or_integral(pool, e, i->x, &facts) : integrate_between(i, e, &facts);
}

/* Whether x is a symbol over which one may integrate. */
static qdot_status
check_variable(qdot_session *s, qdot_expr x)
{
    if (qdot_expr_is_class(s->pool, x, QDOT_DIFFERENTIAL)) {
        (void)qdot_fail(QDOT_ETYPE, "the variable of an integral is the symbol, not its differential");
        return qdot_hint("write `%.60s` in place of `%.60s`", qdot_expr_symbol(s->pool, x)->name + 1, qdot_expr_symbol(s->pool, x)->name);
    }
    if (qdot_expr_kind(s->pool, x) == QDOT_SYM && x != QDOT_PI && x != QDOT_TRUE && x != QDOT_FALSE)
        return QDOT_OK;
    return qdot_fail(QDOT_ETYPE, "integral(e, x) takes a symbol for x: a parameter, a coordinate, a velocity or t");
}

qdot_status
qdot_call_integral(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    integration i = {.session = s, .x = args[1], .status = QDOT_OK};
    qdot_expr e, result;

    if (n == 3) {
        qdot_fail(QDOT_ETYPE, "integral takes 2 or 4 arguments, not 3");
        return qdot_hint("as in integral(e, x, a, b)");
    }
    QDOT_TRY(check_variable(s, args[1]));
    if (n == 4) {
        i.lo = args[2];
        i.hi = args[3];
        for (int k = 2; k < 4; k++) {
            if (!qdot_expr_is_scalar(s->pool, args[k]) && qdot_infinite(s->pool, args[k]) == 0)
                return qdot_fail(QDOT_ETYPE, "a bound of an integral is a number, not %s",
                                 qdot_value_kind_words(s->pool, args[k]));
            QDOT_TRY(qdot_units_join(s, args[1], args[k], "an integral over %s has an end that is %s"));
        }
    }
    e = qdot_momenta_for(s, args[0], args[1]);
    result = qdot_value_map(s->pool, e, integrate_scalar, &i);
    if (i.status != QDOT_OK)
        return i.status;
    return qdot_value_kind_give(s->pool, result, value);
}
