/* call.c -- decides what name(...) means in an expression: a function call, or a product. */
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/value-kind.h"
#include "lang/functions/builtin.h"
#include "lang/functions/entry.h"
#include "lang/functions/quantity.h"
#include "lang/language/evaluator.h"
#include "lang/language/function.h"
#include "lang/language/hints.h"
#include "lang/session/unmade.h"
#include "lang/session/along.h"
#include "lang/session/member.h"
#include "lang/session/range.h"
#include "mech/scene/scene.h"

static qdot_status
refuse_values_along_runs(qdot_session *s, const qdot_builtin *row, uint32_t n, const qdot_expr *args)
{
    qdot_status status = QDOT_OK;

    for (uint32_t k = 0; k < n && status == QDOT_OK && (row->flags & QDOT_BUILTIN_FORMULA); k++)
        status = qdot_member_refuse(s, args[k]);
    return status == QDOT_OK
               ? status
               : qdot_hint("the run is written outside, as in `a.(%s(...))`", row->name);
}

static qdot_status
call_builtin(qdot_session *s, const qdot_builtin *row, uint32_t n, const qdot_expr *args,
             const char *run, qdot_expr *value, qdot_expr *over)
{
    if ((int)n < row->least || (row->most >= 0 && (int)n > row->most)) {
        if (row->least == row->most)
            qdot_fail(QDOT_ETYPE, "%s takes %d argument%s, not %u", row->name, row->least,
                      row->least == 1 ? "" : "s", n);
        else if (row->most < 0)
            qdot_fail(QDOT_ETYPE, "%s takes %d arguments or more, not %u", row->name,
                      row->least, n);
        else
            qdot_fail(QDOT_ETYPE, "%s takes %d %s %d arguments, not %u", row->name,
                      row->least, row->most == row->least + 1 ? "or" : "to",
                      row->most, n);
        return qdot_hint("as in %s", row->usage);
    }
    QDOT_TRY(refuse_values_along_runs(s, row, n, args));
    if (run != NULL && qdot_range_is_word(row->name))
        QDOT_TRY(qdot_range_value(s, run, row->name, n, args, NULL, value));
    else if (run != NULL)
        QDOT_TRY(qdot_along_value(s, run, n, args, value));
    else
        QDOT_TRY(row->call(s, n, args, value));
    QDOT_TRY(qdot_value_kind_check(s->pool, *value));
    if (row->over != NULL) {
        *over = row->over(s, n, args);
        return qdot_value_kind_check(s->pool, *over);
    }
    return QDOT_OK;
}

qdot_status
qdot_resolve_over_range(qdot_session *session, const char *name, uint32_t n,
                        const qdot_expr *args, qdot_expr *value)
{
    const qdot_builtin *row = qdot_builtin_find(name);

    QDOT_TRY(refuse_values_along_runs(session, row, n, args));
    QDOT_TRY(row->call(session, n, args, value));
    return qdot_value_kind_check(session->pool, *value);
}

static qdot_status
call_function(qdot_session *s, const qdot_name *entry, const qdot_call *call,
              qdot_expr *value, qdot_expr *over)
{
    qdot_argument *args = qdot_calloc(call->n + 1, sizeof *args);
    qdot_status status = args == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (uint32_t i = 0; i < call->n && status == QDOT_OK; i++)
        args[i] = (qdot_argument){.value = call->values[call->indices + i],
                                  .label = call->labels[call->indices + i]};
    if (status == QDOT_OK)
        status = qdot_function_call(s, entry, call->primes, call->n, args, value, over);
    qdot_free(args);
    return status;
}

/* A coordinate at an earlier time, x(t - tau). */
static qdot_status
resolve_delayed(const qdot_session *s, const qdot_name *entry, unsigned primes, qdot_expr u, qdot_expr *value)
{
    const uint32_t moving = QDOT_HAS_TIME | QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER |
                            QDOT_HAS_MOMENTUM | QDOT_HAS_UFUN;
    const qdot_expr delay = qdot_sub(s->pool, QDOT_T, u);

    QDOT_TRY(qdot_pool_check(s->pool));
    if (qdot_expr_node(s->pool, delay)->holds & moving) {
        qdot_fail(QDOT_ENOTBUILT, "not built yet: delays that change in time");
        return qdot_hint("%.80s(t - tau), tau a number or a parameter", entry->name);
    }
    if (primes > 1)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: delayed accelerations");
    *value = qdot_delayed(s->pool, entry->value, u, primes);
    return qdot_value_kind_check(s->pool, *value);
}

static qdot_status
report_not_a_function(const qdot_name *entry, const char *name, uint32_t n, const qdot_expr *args)
{
    qdot_fail(QDOT_ESYNTAX, "`%.200s` is not a function", name);
    if (entry != NULL && entry->kind == QDOT_NAME_COORD && n == 1 && args[0] == QDOT_T)
        return qdot_hint("a coordinate depends on the time by itself: write %.80s", name);
    return qdot_hint("a product is written %.80s*(...)", name);
}

/* Whether the name is that of a coordinate, followed by a time other than t. */
static bool
is_delayed(const qdot_session *s, const qdot_name *entry, uint32_t n, const qdot_expr *args)
{
    return entry != NULL && entry->kind == QDOT_NAME_COORD && n == 1 && args[0] != QDOT_NIL && args[0] != QDOT_T &&
           qdot_expr_is_scalar(s->pool, args[0]) && (qdot_expr_node(s->pool, args[0])->holds & QDOT_HAS_TIME) != 0;
}

/* Whether the name stands for something that is not a function. */
static bool
is_name_of_value(const qdot_session *s, const qdot_name *entry, const char *name, const char *spelled)
{
    return entry != NULL || qdot_quantity_find(name) != NULL ||
           qdot_scene_has_label(s->scene, spelled) || strcmp(name, "pi") == 0 ||
           strcmp(name, "t") == 0 || qdot_names_is_family(s->names, name);
}

qdot_status
qdot_resolve_call(qdot_cursor *c, const qdot_call *call, qdot_expr *value,
                  qdot_expr *over)
{
    qdot_session *s = c->session;
    const char *name = call->token->text;
    const qdot_expr *args = call->values + call->indices;
    const qdot_builtin *row = call->indices == 0 ? qdot_builtin_find(name) : NULL;
    const qdot_name *entry;
    qdot_text spelled = {0};
    qdot_status status;

    *over = QDOT_NIL;
    status = qdot_entry_name(s, name, call->indices, call->values, &spelled);
    entry = status == QDOT_OK ? qdot_names_find(s->names, spelled.at) : NULL;
    if (status == QDOT_OK && row != NULL && (row->flags & QDOT_BUILTIN_SHORT) &&
        (entry != NULL || qdot_scene_has_label(s->scene, spelled.at) || qdot_names_is_family(s->names, name)))
        row = NULL;
    if (status != QDOT_OK)
        ;
    else if (entry != NULL && entry->kind == QDOT_NAME_FUNCTION)
        status = call_function(s, entry, call, value, over);
    else if (entry != NULL && entry->kind == QDOT_NAME_UFUN)
        status = qdot_resolve_undefined(s, entry, call->primes, call->n, args, value);
    else if (row != NULL && call->primes == 0) {
        status = qdot_session_refuse_unmade(s, name);
        if (status == QDOT_OK)
            status = call_builtin(s, row, call->n, args, call->run, value, over);
    } else if (row != NULL)
        status = qdot_resolve_no_prime(name, "takes no prime: write diff(...)");
    else if (is_delayed(s, entry, call->n, args))
        status = resolve_delayed(s, entry, call->primes, args[0], value);
    else if (is_name_of_value(s, entry, name, spelled.at))
        status = report_not_a_function(entry, spelled.at, call->n, args);
    else
        status = qdot_hints_unknown_function(c, call->token);
    qdot_text_clear(&spelled);
    return status;
}
