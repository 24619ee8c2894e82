/* member.c -- `a.x` inside a larger expression: values along several runs at once.
 *
 * Where a.EXPR meets an operator it becomes a symbol of its own, spelled "a.EXPR", that
 * the session remembers. An expression of such symbols is evaluated run by run, and then
 * itself; what is along no run named is along the latest.
 */
#include "expr/node.h"
#include "lang/session/member.h"
#include "lang/session/momenta.h"

#include <string.h>

#include "expr/calculus.h"
#include "expr/print.h"
#include "expr/tensor.h"
#include "expr/walk.h"

const qdot_member *
qdot_member_find(const qdot_session *session, qdot_expr symbol)
{
    for (size_t i = 0; i < session->members->n; i++)
        if (session->members->at[i].symbol == symbol)
            return &session->members->at[i];
    return NULL;
}

/* Make the symbol that represents the scalar expression e along the run, as in a.x. */
static qdot_expr
make_symbol_along_run(qdot_session *session, const char *run, qdot_expr e)
{
    qdot_pool *pool = session->pool;
    bool plain = qdot_expr_kind(pool, e) == QDOT_SYM && !qdot_symbol_is_number(pool, e);
    qdot_member m = {.value = e};
    qdot_text name = {0}, text = {0};
    qdot_status status;

    for (size_t i = 0; i < session->members->n; i++)
        if (session->members->at[i].value == e &&
            strcmp(session->members->at[i].run, run) == 0)
            return session->members->at[i].symbol;
    status = qdot_print(pool, e, QDOT_PLAIN, &text);
    qdot_text_format(&name, plain ? "%s.%s" : "%s.(%s)", run, qdot_text_str(&text));
    if (status == QDOT_OK)
        status = qdot_text_status(&name);
    if (status == QDOT_OK)
        m.symbol = qdot_symbol_get(pool, QDOT_FORMAL, qdot_text_str(&name));
    m.run = status == QDOT_OK && m.symbol != QDOT_NIL ? qdot_strdup(run) : NULL;
    if (m.run == NULL || qdot_vec_push(session->members, m) != QDOT_OK) {
        qdot_free(m.run);
        m.symbol = QDOT_NIL;
    }
    qdot_text_clear(&name);
    qdot_text_clear(&text);
    return m.symbol != QDOT_NIL ? m.symbol : qdot_pool_fail(pool);
}

typedef struct {
    qdot_session *session;
    const char *run;
} naming;

static qdot_expr
symbol_for_scalar(qdot_pool *pool, qdot_expr scalar, void *user)
{
    const naming *n = user;

    (void)pool;
    return make_symbol_along_run(n->session, n->run, scalar);
}

qdot_expr
qdot_member_of(qdot_session *session, const char *run, qdot_expr e)
{
    naming n = {session, run};

    e = qdot_momenta_to_velocities(session, e);
    if (e == QDOT_NIL)
        return QDOT_NIL;
    return qdot_expr_is_scalar(session->pool, e)
               ? make_symbol_along_run(session, run, e)
               : qdot_value_map(session->pool, e, symbol_for_scalar, &n);
}

bool
qdot_member_any(const qdot_session *session, qdot_expr e)
{
    if (!(qdot_expr_node(session->pool, e)->holds & QDOT_HAS_FORMAL))
        return false;
    for (size_t i = 0; i < session->members->n; i++)
        if (qdot_expr_contains(session->pool, e, session->members->at[i].symbol))
            return true;
    return false;
}

qdot_status
qdot_member_refuse(const qdot_session *session, qdot_expr e)
{
    if (e == QDOT_NIL || !qdot_member_any(session, e))
        return QDOT_OK;
    for (size_t i = 0; i < session->members->n; i++) {
        const qdot_member *m = &session->members->at[i];
        const char *name = qdot_expr_symbol(session->pool, m->symbol)->name;

        if (!qdot_expr_contains(session->pool, e, m->symbol))
            continue;
        (void)qdot_fail(QDOT_EINVAL, "%.200s is along the run %.100s: here it has no value", name,
                        m->run);
        return qdot_hint("value(%.200s, 0) is its value at t = 0", name);
    }
    return QDOT_OK;
}

/* --- values along a single run ------------------------------------------------------- */

/* Whether e refers to one run only; *run: the name of that run, NULL if no run is named. */
static bool
is_along_one_run(const qdot_session *session, qdot_expr e, const char **run)
{
    const char *only = NULL;
    bool one = true;

    for (size_t i = 0; i < session->members->n; i++) {
        const qdot_member *m = &session->members->at[i];

        if (!qdot_expr_contains(session->pool, e, m->symbol))
            continue;
        one = one && (only == NULL || strcmp(only, m->run) == 0);
        only = m->run;
    }
    if (only != NULL && (qdot_expr_node(session->pool, e)->holds & QDOT_MEMBER_MOTION))
        one = false;
    *run = only;
    return one;
}

static qdot_expr
replace_symbols_by_values(qdot_session *session, qdot_expr e)
{
    for (size_t i = session->members->n; i-- > 0 && e != QDOT_NIL;) {
        qdot_expr from = session->members->at[i].symbol, to = session->members->at[i].value;

        e = qdot_subs(session->pool, e, 1, &from, &to);
    }
    return e;
}

qdot_status
qdot_member_resolve(qdot_session *session, const char **run, qdot_expr *e, bool *mixed)
{
    const char *own;

    *mixed = false;
    if (!qdot_member_any(session, *e))
        return QDOT_OK;
    if (!is_along_one_run(session, *e, &own) || (*run != NULL && strcmp(*run, own) != 0)) {
        *mixed = true;
        return QDOT_OK;
    }
    *run = own;
    *e = replace_symbols_by_values(session, *e);
    return qdot_pool_check(session->pool);
}
