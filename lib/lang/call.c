/* call.c -- what name(...) means. */
#include <string.h>

#include "base/text.h"
#include "expr/calculus.h"
#include "expr/tensor.h"
#include "lang/code.h"
#include "lang/number.h"

/* Forms that an error lists. */
enum { most_described = 6 };

/* --- functions of the user's ---------------------------------------------------------- */

typedef struct {
    qdot_expr formal, body;
} mapping;

static qdot_expr
put_in(qdot_pool *pool, qdot_expr scalar, void *user)
{
    const mapping *m = user;

    return qdot_subs(pool, m->body, 1, &m->formal, &scalar);
}

static bool
is_shaped(const qdot_pool *pool, qdot_expr e)
{
    const qdot_kind kind = qdot_expr_kind(pool, e);

    return kind == QDOT_VEC || kind == QDOT_MAT;
}

/* Whether an argument has the form of a formal: a number, a vector or matrix of its size. */
static bool
goes_with(const qdot_pool *pool, qdot_expr formal, qdot_expr arg)
{
    if (!is_shaped(pool, formal) || !is_shaped(pool, arg))
        return !is_shaped(pool, formal) && qdot_expr_is_scalar(pool, arg);
    return qdot_expr_kind(pool, formal) == qdot_expr_kind(pool, arg) &&
           qdot_expr_count(pool, formal) == qdot_expr_count(pool, arg) &&
           qdot_expr_node(pool, formal)->op == qdot_expr_node(pool, arg)->op;
}

/* The form of the function that these arguments go with; nil if there is none. */
static qdot_expr
find_form(const qdot_pool *pool, const qdot_name *entry, uint32_t n, const qdot_expr *args)
{
    for (uint32_t k = 0; k < qdot_expr_count(pool, entry->value); k++) {
        const qdot_expr form = qdot_expr_arg(pool, entry->value, k);
        uint32_t i = 0;

        while (i < n && goes_with(pool, qdot_expr_arg(pool, form, i), args[i]))
            i++;
        if (i == n)
            return form;
    }
    return QDOT_NIL;
}

/* The body of a form with its formals replaced, all at once. */
static qdot_status
apply_form(qdot_session *s, qdot_expr form, uint32_t n, const qdot_expr *args,
           qdot_expr *value)
{
    qdot_pool *pool = s->pool;
    qdot_vec(qdot_expr) from = {0}, to = {0};
    qdot_status status = QDOT_OK;

    for (uint32_t i = 0; i < n && status == QDOT_OK; i++) {
        const qdot_expr formal = qdot_expr_arg(pool, form, i);
        const bool shaped = is_shaped(pool, formal);

        for (uint32_t j = 0; j < (shaped ? qdot_expr_count(pool, formal) : 1); j++) {
            if (status == QDOT_OK)
                status = qdot_vec_push(&from, shaped ? qdot_expr_arg(pool, formal, j) : formal);
            if (status == QDOT_OK)
                status = qdot_vec_push(&to, shaped ? qdot_expr_arg(pool, args[i], j) : args[i]);
        }
    }
    if (status == QDOT_OK) {
        *value = qdot_subs(pool, qdot_expr_arg(pool, form, n), (uint32_t)from.n, from.at, to.at);
        status = qdot_resolve_check(pool, *value);
    }
    qdot_free(from.at);
    qdot_free(to.at);
    return status;
}

/* "(vector of 3, number)" */
static void
describe_form(const qdot_pool *pool, qdot_expr form, uint32_t n, qdot_text *to)
{
    for (uint32_t i = 0; i < n; i++) {
        const qdot_expr formal = qdot_expr_arg(pool, form, i);
        const uint32_t entries = is_shaped(pool, formal) ? qdot_expr_count(pool, formal) : 1;

        qdot_text_add(to, i == 0 ? "(" : ", ");
        if (!is_shaped(pool, formal))
            qdot_text_add(to, "number");
        else if (qdot_expr_kind(pool, formal) == QDOT_VEC)
            qdot_text_format(to, "vector of %u", entries);
        else
            qdot_text_format(to, "%u by %u matrix", entries / qdot_expr_node(pool, formal)->op,
                             qdot_expr_node(pool, formal)->op);
    }
    qdot_text_add(to, ")");
}

static qdot_status
no_form(const qdot_session *s, const qdot_name *entry, uint32_t n, const qdot_expr *args)
{
    const qdot_expr first = qdot_expr_arg(s->pool, entry->value, 0);
    const uint32_t forms = qdot_expr_count(s->pool, entry->value);
    const bool alone = forms == 1;
    qdot_text list = {0};
    uint32_t odd = 0;

    while (odd + 1 < n && goes_with(s->pool, qdot_expr_arg(s->pool, first, odd), args[odd]))
        odd++;
    if (alone && !is_shaped(s->pool, qdot_expr_arg(s->pool, first, odd)))
        return qdot_fail(QDOT_ETYPE, "`%.200s` is a function of numbers, not of %s", entry->name,
                         qdot_resolve_kind(s->pool, args[odd]));
    for (uint32_t k = 0; k < forms && k < most_described; k++) {
        qdot_text_add(&list, k == 0 ? "" : ", ");
        describe_form(s->pool, qdot_expr_arg(s->pool, entry->value, k), n, &list);
    }
    if (forms > most_described)
        qdot_text_add(&list, " ...");
    qdot_fail(QDOT_ETYPE, "what `%.200s` is defined as has no meaning for %s%s", entry->name,
              qdot_resolve_kind(s->pool, args[odd]), n > 1 ? " there" : "");
    if (qdot_text_status(&list) == QDOT_OK)
        qdot_hint("it has one for %s", qdot_text_str(&list));
    qdot_text_clear(&list);
    return QDOT_ETYPE;
}

/* Of one argument also on every member of a list, vector, matrix or equation, where the body
 * itself has no meaning for such a one. */
static qdot_status
apply_to(qdot_session *s, const qdot_name *entry, qdot_expr arg, qdot_expr *value)
{
    const qdot_expr zero = QDOT_ZERO;
    qdot_expr form = find_form(s->pool, entry, 1, &arg);
    mapping m;

    if (form != QDOT_NIL)
        return apply_form(s, form, 1, &arg, value);
    form = find_form(s->pool, entry, 1, &zero);
    if (form == QDOT_NIL)
        return no_form(s, entry, 1, &arg);
    m = (mapping){qdot_expr_arg(s->pool, form, 0), qdot_expr_arg(s->pool, form, 1)};
    *value = qdot_value_map(s->pool, arg, put_in, &m);
    return qdot_resolve_check(s->pool, *value);
}

/* f of each member of a list: a vector among them is one. */
static qdot_status
apply_to_members(qdot_session *s, const qdot_name *entry, qdot_expr list, qdot_expr *value)
{
    const uint32_t n = qdot_expr_count(s->pool, list);
    qdot_expr *made = qdot_malloc((n + 1) * sizeof *made);
    qdot_status status = made != NULL ? QDOT_OK : QDOT_ENOMEM;

    for (uint32_t i = 0; i < n && status == QDOT_OK; i++)
        status = apply_to(s, entry, qdot_expr_arg(s->pool, list, i), made + i);
    if (status == QDOT_OK) {
        *value = qdot_list(s->pool, n, made);
        status = qdot_resolve_check(s->pool, *value);
    }
    qdot_free(made);
    return status;
}

static qdot_status
apply_derivative(qdot_session *s, const qdot_name *entry, unsigned primes, qdot_expr arg,
                 qdot_expr *value)
{
    const qdot_expr zero = QDOT_ZERO, form = find_form(s->pool, entry, 1, &zero);
    mapping m;

    if (form == QDOT_NIL)
        return qdot_resolve_no_prime(entry->name, "is no function of a number");
    m = (mapping){qdot_expr_arg(s->pool, form, 0), qdot_expr_arg(s->pool, form, 1)};
    for (; primes > 0; primes--)
        m.body = qdot_diff(s->pool, m.body, m.formal);
    QDOT_TRY(qdot_resolve_check(s->pool, m.body));
    *value = qdot_value_map(s->pool, arg, put_in, &m);
    return qdot_resolve_check(s->pool, *value);
}

static qdot_status
apply_function(qdot_session *s, const qdot_name *entry, unsigned primes, uint32_t n,
               const qdot_expr *args, qdot_expr *value)
{
    const uint32_t arity = qdot_expr_count(s->pool, entry->formals);
    qdot_expr form;

    if (n != arity)
        return qdot_fail(QDOT_ETYPE, "`%.200s` takes %u argument%s, not %u", entry->name,
                         arity, arity == 1 ? "" : "s", n);
    if (primes > 0 && n != 1)
        return qdot_resolve_no_prime(entry->name,
                                     "has several arguments: a prime does not say which");
    if (primes > 0)
        return apply_derivative(s, entry, primes, args[0], value);
    if (n == 1)
        return qdot_expr_kind(s->pool, args[0]) == QDOT_LIST
                   ? apply_to_members(s, entry, args[0], value)
                   : apply_to(s, entry, args[0], value);
    form = find_form(s->pool, entry, n, args);
    return form != QDOT_NIL ? apply_form(s, form, n, args, value) : no_form(s, entry, n, args);
}

/* --- calls ---------------------------------------------------------------------------- */

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
    if (run != NULL && qdot_number_is_range(row->name))
        QDOT_TRY(qdot_number_range(s, run, row->name, n, args, NULL, value));
    else if (run != NULL)
        QDOT_TRY(qdot_number_value(s, run, n, args, value));
    else
        QDOT_TRY(row->call(s, n, args, value));
    QDOT_TRY(qdot_resolve_check(s->pool, *value));
    if (row->over != NULL) {
        *over = row->over(s, n, args);
        return qdot_resolve_check(s->pool, *over);
    }
    return QDOT_OK;
}

static qdot_status
not_a_function(const qdot_name *entry, const char *name, uint32_t n, const qdot_expr *args)
{
    qdot_fail(QDOT_ESYNTAX, "`%.200s` is not a function", name);
    if (entry != NULL && entry->kind == QDOT_NAME_COORD && n == 1 && args[0] == QDOT_T)
        return qdot_hint("a coordinate depends on the time by itself: write %.80s", name);
    return qdot_hint("a product is written %.80s*(...)", name);
}

qdot_status
qdot_resolve_call(qdot_cursor *c, const qdot_token *token, unsigned primes,
                  uint32_t indices, uint32_t n, const qdot_expr *values, const char *run,
                  qdot_expr *value, qdot_expr *over)
{
    qdot_session *s = c->session;
    const qdot_expr *args = values + indices;
    const qdot_builtin *row = indices == 0 ? qdot_builtin_find(token->text) : NULL;
    const qdot_name *entry;
    qdot_text spelled = {0};
    qdot_status status;

    *over = QDOT_NIL;
    status = qdot_resolve_member(s, token->text, indices, values, &spelled);
    entry = status == QDOT_OK ? qdot_names_find(s->names, spelled.at) : NULL;
    if (status != QDOT_OK)
        ;
    else if (entry != NULL && entry->kind == QDOT_NAME_FUNCTION)
        status = apply_function(s, entry, primes, n, args, value);
    else if (entry != NULL && entry->kind == QDOT_NAME_UFUN)
        status = qdot_resolve_undefined(s, entry, primes, n, args, value);
    else if (row != NULL && primes == 0)
        status = call_builtin(s, row, n, args, run, value, over);
    else if (row != NULL)
        status = qdot_resolve_no_prime(token->text, "takes no prime: write diff(...)");
    else if (entry != NULL || qdot_quantity_find(token->text) != NULL ||
             qdot_scene_has_label(s->scene, spelled.at) ||
             strcmp(token->text, "pi") == 0 || strcmp(token->text, "t") == 0 ||
             qdot_names_is_family(s->names, token->text))
        status = not_a_function(entry, spelled.at, n, args);
    else
        status = qdot_hints_unknown_function(c, token);
    qdot_text_clear(&spelled);
    return status;
}
