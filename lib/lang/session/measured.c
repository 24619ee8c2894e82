/* measured.c -- results of runs, represented by symbols in expressions. */
#include "lang/session/measured.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"

qdot_expr
qdot_measured_rational(qdot_pool *pool, double x)
{
    if (!isfinite(x)) {
        (void)qdot_fail(QDOT_EDOMAIN, "a number of the run is not finite");
        return qdot_pool_fail(pool);
    }
    return qdot_expr_of_double(pool, x);
}

/* Write a number of a run as in formulas: with all requested digits, or as few as identify the double. */
static void
write_number(qdot_session *session, const qdot_measured *m, qdot_text *out)
{
    const mpfr_prec_t bits = (mpfr_prec_t)(3.33 * m->digits) + 64;
    char *text = NULL;
    mpfr_t x;

    if (m->digits > 0) {
        mpfr_init2(x, bits);
        if (qdot_constant_real(session->pool, m->exact, x) == QDOT_OK &&
            mpfr_asprintf(&text, "%.*Rg", m->digits, x) > 0)
            qdot_text_add(out, text);
        if (text != NULL)
            mpfr_free_str(text);
        mpfr_clear(x);
        if (text != NULL)
            return;
    }
    qdot_text_double(out, m->value + 0.0, qdot_double_digits(m->value, 15));
}

/* Make a new symbol for a number of a run; its name is the number, then # and a counter that is not printed. */
qdot_expr
qdot_measured_add(qdot_session *session, qdot_measured m)
{
    qdot_text name = {0};

    write_number(session, &m, &name);
    qdot_text_format(&name, "#%zu", session->measured->n + 1);
    m.symbol = qdot_text_status(&name) == QDOT_OK
                   ? qdot_symbol_get(session->pool, QDOT_FORMAL, qdot_text_str(&name))
                   : qdot_pool_fail(session->pool);
    qdot_text_clear(&name);
    if (m.symbol == QDOT_NIL)
        return QDOT_NIL;
    return qdot_vec_push(session->measured, m) == QDOT_OK
               ? m.symbol
               : qdot_pool_fail(session->pool);
}

const qdot_measured *
qdot_measured_find(const qdot_session *session, qdot_expr symbol)
{
    const qdot_symbol *s = qdot_expr_symbol(session->pool, symbol);
    const char *mark = s != NULL && s->class == QDOT_FORMAL ? strrchr(s->name, '#') : NULL;
    const size_t i = mark != NULL ? (size_t)strtoull(mark + 1, NULL, 10) : 0;

    return i >= 1 && i <= session->measured->n && session->measured->at[i - 1].symbol == symbol
               ? &session->measured->at[i - 1]
               : NULL;
}

qdot_expr
qdot_measured_new(qdot_session *session, double value, double error)
{
    return qdot_measured_add(session, (qdot_measured){.value = value, .error = error});
}

bool
qdot_measured_occurs(qdot_session *session, qdot_expr e)
{
    if (!(qdot_expr_node(session->pool, e)->holds & QDOT_HAS_FORMAL))
        return false;
    for (size_t i = 0; i < session->measured->n; i++)
        if (qdot_expr_contains(session->pool, e, session->measured->at[i].symbol))
            return true;
    return false;
}

qdot_expr
qdot_measured_as_rationals(qdot_session *session, qdot_expr e)
{
    for (size_t i = 0; i < session->measured->n && e != QDOT_NIL; i++) {
        qdot_expr from = session->measured->at[i].symbol, to;

        if (!(qdot_expr_node(session->pool, e)->holds & QDOT_HAS_FORMAL))
            return e;
        if (!qdot_expr_contains(session->pool, e, from))
            continue;
        to = session->measured->at[i].digits > 0
                 ? session->measured->at[i].exact
                 : qdot_measured_rational(session->pool, session->measured->at[i].value);
        e = qdot_subs(session->pool, e, 1, &from, &to);
    }
    return e;
}
