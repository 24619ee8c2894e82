/* limit.c -- limit(E, x = a), limit(E, x = a, left|right): the limit of E as x tends to a.
 *
 * QDOT_EDOMAIN: the limits from both sides differ; no limit was found. Of a vector or list, that of each entry.
 *
 * Tests  tests/script/integral/limit.lag, tests/bad/integral/limit-*.lag
 */
#include "lang/functions/builtin.h"

#include <string.h>

#include "expr/integral.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/value-kind.h"
#include "expr/walk.h"
#include "lang/session/momenta.h"
#include "mech/scene/things.h"
#include "normal/calculus/limit.h"

typedef struct {
    qdot_session *session;
    qdot_facts facts;
    qdot_expr x, at;
    int side;
    qdot_status status;
} task;

static qdot_status
fail_with_both_sides(task *t, qdot_expr e, const qdot_limit_answer *found)
{
    qdot_text left = {0}, right = {0}, of = {0}, at = {0};
    qdot_status status = qdot_print(t->session->pool, found->left, QDOT_PLAIN, &left);

    if (status == QDOT_OK)
        status = qdot_print(t->session->pool, found->right, QDOT_PLAIN, &right);
    if (status == QDOT_OK)
        status = qdot_print(t->session->pool, e, QDOT_PLAIN, &of);
    if (status == QDOT_OK)
        status = qdot_print(t->session->pool, t->at, QDOT_PLAIN, &at);
    if (status == QDOT_OK)
        status = qdot_fail(QDOT_EDOMAIN, "the limit does not exist: from the left it is %.100s, from the right %.100s",
                           qdot_text_str(&left), qdot_text_str(&right));
    if (status == QDOT_EDOMAIN && of.n < 100)
        (void)qdot_hint("from one side: `limit(%s, %.60s = %.60s, right)`", qdot_text_str(&of),
                        qdot_expr_symbol(t->session->pool, t->x)->name, qdot_text_str(&at));
    qdot_text_clear(&of);
    qdot_text_clear(&at);
    qdot_text_clear(&left);
    qdot_text_clear(&right);
    return status;
}

/* Fail because the limit depends on a sign that is not known. */
static qdot_status
fail_with_sign(task *t, qdot_expr undecided)
{
    qdot_text text = {0};
    qdot_status status = qdot_print(t->session->pool, undecided, QDOT_PLAIN, &text);

    if (status == QDOT_OK)
        status = qdot_fail(QDOT_EDOMAIN, "the limit depends on the sign of %.100s", qdot_text_str(&text));
    if (status == QDOT_EDOMAIN)
        (void)qdot_hint("declare a domain from which it follows, as in param a > 0, b < 1");
    qdot_text_clear(&text);
    return status;
}

static qdot_expr
limit_of_scalar(qdot_pool *pool, qdot_expr e, void *user)
{
    task *t = user;
    qdot_limit_answer found;

    if (t->status != QDOT_OK)
        return e;
    t->status = qdot_limit(pool, &t->facts, e, t->x, t->at, t->side, &found);
    if (t->status != QDOT_OK)
        return e;
    switch (found.kind) {
    case QDOT_LIMIT_VALUE:
    case QDOT_LIMIT_INFINITE: return found.value;
    case QDOT_LIMIT_NONE: t->status = fail_with_both_sides(t, e, &found); return e;
    case QDOT_LIMIT_UNDEFINED:
        t->status = qdot_fail(QDOT_EDOMAIN, "the expression is not defined there");
        return e;
    case QDOT_LIMIT_NOT_FOUND: break;
    }
    if (found.undecided != QDOT_NIL) {
        t->status = fail_with_sign(t, found.undecided);
        return e;
    }
    t->status = qdot_fail(QDOT_EDOMAIN, "no limit was found");
    (void)qdot_hint("it may depend on a sign (param a > 0), or not exist; series(E, x = a, n) shows more");
    return e;
}

static qdot_status
read_side(const task *t, qdot_expr word, int *side)
{
    const qdot_symbol *s = qdot_expr_symbol(t->session->pool, word);

    *side = s == NULL || s->class != QDOT_FORMAL ? 0
            : strcmp(s->name, "right") == 0     ? 1
            : strcmp(s->name, "left") == 0      ? -1
                                                : 0;
    if (*side != 0)
        return QDOT_OK;
    (void)qdot_fail(QDOT_ETYPE, "the side of a limit is `left` or `right`");
    return qdot_hint("as in limit(1/t, t = 0, right)");
}

qdot_status
qdot_call_limit(qdot_session *session, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    qdot_pool *pool = session->pool;
    task t = {.session = session, .facts = qdot_scene_facts(session->scene)};
    qdot_expr e = args[0];

    if (!qdot_value_kind_is_equation(pool, args[1])) {
        (void)qdot_fail(QDOT_ETYPE, "a limit is taken at a place, not at %s", qdot_value_kind_words(pool, args[1]));
        return qdot_hint("as in limit(sin(t)/t, t = 0)");
    }
    t.x = qdot_expr_arg(pool, args[1], 0);
    t.at = qdot_expr_arg(pool, args[1], 1);
    QDOT_TRY(qdot_value_kind_need_symbol(pool, t.x, "a limit is of a symbol: limit(E, x = a), not of %s"));
    if (qdot_infinite(pool, t.at) == 0)
        QDOT_TRY(qdot_infinity_refuse(pool, t.at));
    if (qdot_expr_contains(pool, t.at, t.x))
        return qdot_fail(QDOT_EDOMAIN, "the place of a limit holds its symbol");
    if (n == 3)
        QDOT_TRY(read_side(&t, args[2], &t.side));
    if (qdot_expr_is_class(pool, e, QDOT_WORDS))
        return qdot_fail(QDOT_ETYPE, "limit takes numbers, not a text");
    e = qdot_momenta_for(session, e, t.x);
    QDOT_TRY(qdot_value_kind_check(pool, e));
    *value = qdot_value_map(pool, e, limit_of_scalar, &t);
    QDOT_TRY(t.status);
    return qdot_value_kind_check(pool, *value);
}
