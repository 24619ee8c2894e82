/* unset.c -- the errors that name what has no value where a number is wanted. */
#include "expr/constant.h"

#include "base/text.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/pool.h"
#include "expr/print.h"
#include "expr/symbol.h"

/* Append an undefined function with its arguments as declared, x(s, t), whatever arguments e applies it to. */
static void
add_function(const qdot_pool *pool, qdot_expr e, qdot_text *text)
{
    const qdot_ufun *f = qdot_ufun_get(pool, qdot_expr_node(pool, e)->op);

    qdot_text_add(text, f->name);
    for (uint32_t i = 0; i < f->arity; i++) {
        qdot_text_add(text, i ? ", " : "(");
        if (qdot_print(pool, qdot_expr_arg(pool, f->formals, i), QDOT_PLAIN, text) != QDOT_OK)
            break;
    }
    qdot_text_char(text, ')');
}

qdot_status
qdot_constant_unset(const qdot_pool *pool, qdot_expr e)
{
    static const char *const what[] = {
        [QDOT_PARAM] = "parameter",       [QDOT_FORMAL] = "name",
        [QDOT_TIME] = "the time",         [QDOT_COORD] = "coordinate",
        [QDOT_MOMENTUM] = "momentum",     [QDOT_MULTIPLIER] = "multiplier",
        [QDOT_DIFFERENTIAL] = "the differential", [QDOT_DELTA] = "the displacement",
    };
    const qdot_symbol *s = qdot_expr_symbol(pool, e);
    qdot_text text = {0};

    if (s != NULL && s->class == QDOT_BOUND) {
        qdot_fail(QDOT_ENOTBUILT, "not built yet: an integral in the numbers of a run or a figure");
        return qdot_hint("the integral of f(x) along a run is a state: `state z' = f(x)*x'`");
    }
    if (s != NULL && s->class >= QDOT_WORDS)
        return qdot_fail(QDOT_EUNSET, "%s has no value", s->name);
    if (s) {
        const char *kind = what[s->class];

        if (s->class == QDOT_COORD && s->order > 0)
            kind = s->order == 1 ? "velocity" : "acceleration";
        qdot_fail(QDOT_EUNSET, "%s %s has no value", kind, s->name);
        if (s->class == QDOT_PARAM || s->class == QDOT_MOMENTUM)
            qdot_hint("set %s = ...", s->name);
        return QDOT_EUNSET;
    }
    add_function(pool, e, &text);
    qdot_fail(QDOT_EUNSET, "function %.200s has no value", qdot_text_str(&text));
    qdot_hint("set %.180s = ...", qdot_text_str(&text));
    qdot_text_clear(&text);
    return QDOT_EUNSET;
}

/* Whether the statement `set` can give e a value. */
static bool
is_settable(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_kind(pool, e) == QDOT_UFUN || qdot_expr_is_class(pool, e, QDOT_PARAM) ||
           qdot_expr_is_class(pool, e, QDOT_MOMENTUM);
}

/* Whether a and b are applications of the same undefined function, perhaps to different arguments. */
static bool
is_same_function(const qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    return qdot_expr_kind(pool, a) == QDOT_UFUN && qdot_expr_kind(pool, b) == QDOT_UFUN &&
           qdot_expr_node(pool, a)->op == qdot_expr_node(pool, b)->op;
}

qdot_status
qdot_constant_unset_all(const qdot_pool *pool, size_t n, const qdot_expr *e)
{
    enum { MOST = 160 }; /* largest number of bytes of names that a message shows */
    qdot_text names = {0}, values = {0}, one = {0};
    qdot_expr first = QDOT_NIL;
    size_t settable = 0, left = 0;
    bool applied = false, plain = true;

    if (n == 0)
        return QDOT_OK;
    for (size_t i = 0; i < n; i++)
        applied = applied || qdot_expr_kind(pool, e[i]) == QDOT_UFUN;
    /* an argument of an undefined function is set by the function's definition: not listed */
    for (size_t i = 0; i < n; i++)
        if (!is_settable(pool, e[i]) &&
            !(applied && (qdot_expr_is_class(pool, e[i], QDOT_FORMAL) || e[i] == QDOT_T)))
            return qdot_constant_unset(pool, e[i]);
    for (size_t i = 0; i < n; i++) {
        if (!is_settable(pool, e[i]))
            continue;
        if (i > 0 && is_same_function(pool, e[i - 1], e[i]))
            continue;
        qdot_text_truncate(&one, 0);
        if (qdot_expr_kind(pool, e[i]) == QDOT_UFUN)
            add_function(pool, e[i], &one);
        else
            qdot_text_add(&one, qdot_expr_symbol(pool, e[i])->name);
        if (values.n > MOST) {
            left++;
            continue;
        }
        qdot_text_format(&names, "%s%s", settable > 0 ? ", " : "", qdot_text_str(&one));
        if (settable == 0)
            first = e[i];
        plain = plain && qdot_expr_is_class(pool, e[i], QDOT_PARAM);
        qdot_text_format(&values, "%s%s = ...", settable > 0 ? ", " : "", qdot_text_str(&one));
        settable++;
    }
    if (left > 0)
        qdot_text_format(&names, " and %zu more", left);
    if (settable < 2)
        (void)qdot_constant_unset(pool, first);
    else
        (void)qdot_fail(QDOT_EUNSET, "%s%s have no value", plain ? "parameters " : "",
                        qdot_text_str(&names));
    if (settable > 1)
        (void)qdot_hint("set %s", qdot_text_str(&values));
    qdot_text_clear(&names);
    qdot_text_clear(&values);
    qdot_text_clear(&one);
    return QDOT_EUNSET;
}
