/* function.c -- functions defined by the user, whose definition is evaluated anew, as text, at each call. */
#include "lang/language/function.h"

#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/tensor.h"
#include "expr/value-kind.h"
#include "lang/language/evaluator.h"
#include "lang/language/formals.h"
#include "lang/language/token-text.h"
#include "lang/session/evaluation.h"
#include "lang/session/member.h"
#include "lang/source/source.h"
#include "mech/scene/things.h"
#include "normal/prove/decide.h"

static bool
is_argument_name(const qdot_pool *pool, qdot_expr formals, const char *name)
{
    for (uint32_t i = 0; i < qdot_expr_count(pool, formals); i++)
        if (strcmp(qdot_expr_symbol(pool, qdot_expr_arg(pool, formals, i))->name, name) == 0)
            return true;
    return false;
}

static bool
is_captured_index(const qdot_function_body *body, const char *name)
{
    for (size_t i = 0; i < body->captured.n; i++)
        if (strcmp(body->captured.at[i], name) == 0)
            return true;
    return false;
}

/* Store the present values of loop indices that the body mentions; the function keeps them. */
static qdot_status
capture_loop_indices(qdot_session *s, qdot_function_body *body, qdot_expr formals, qdot_expr *values)
{
    qdot_vec(qdot_expr) list = {0};
    qdot_status status = QDOT_OK;

    for (const qdot_token *k = body->from; k < body->to && status == QDOT_OK; k++) {
        const qdot_name *bound;

        if (k->kind != QDOT_TOKEN_NAME || is_argument_name(s->pool, formals, k->text) ||
            is_captured_index(body, k->text))
            continue;
        bound = qdot_names_find(s->names, k->text);
        if (bound == NULL || bound->kind != QDOT_NAME_INDEX)
            continue;
        status = qdot_vec_push(&list, bound->value);
        if (status == QDOT_OK)
            status = qdot_vec_push(&body->captured, k->text);
    }
    if (status == QDOT_OK) {
        *values = qdot_list(s->pool, (uint32_t)list.n, list.at);
        status = qdot_value_kind_check(s->pool, *values);
    }
    qdot_free(list.at);
    return status;
}

/* Bind the names that the body may see; hide what is bound around the call. *outer: what
 * disclose() takes. args NULL: the formals stand for themselves. */
static qdot_status
bind_names_of_body(qdot_session *s, const qdot_name *entry, const qdot_argument *args, size_t *outer)
{
    const qdot_function_body *body = entry->body;
    qdot_status status = QDOT_OK;

    *outer = qdot_names_enclose(s->names);
    for (size_t i = 0; i < body->captured.n && status == QDOT_OK; i++)
        status = qdot_names_push(s->names, body->captured.at[i],
                                 qdot_expr_arg(s->pool, entry->value, (uint32_t)i));
    for (uint32_t i = 0; i < qdot_expr_count(s->pool, entry->formals) && status == QDOT_OK;
         i++) {
        const qdot_expr formal = qdot_expr_arg(s->pool, entry->formals, i);

        status = qdot_names_push_argument(s->names, qdot_expr_symbol(s->pool, formal)->name,
                                          args != NULL ? args[i].value : formal,
                                          args != NULL ? args[i].label : NULL);
    }
    return status;
}

/* --- reading definitions ------------------------------------------------------------ */

/* Parse the body from the cursor to the end of the statement, and step over it. */
static qdot_status
read_body(qdot_cursor *c, qdot_name *entry)
{
    qdot_function_body *body = entry->body;
    qdot_postfix_list program = {0};
    qdot_status status;
    size_t outer;

    status = bind_names_of_body(c->session, entry, NULL, &outer);
    if (status == QDOT_OK)
        status = qdot_parse(c, QDOT_PARSE_VALUE, &program);
    qdot_names_disclose(c->session->names, outer);
    qdot_free(program.list.at);
    QDOT_TRY(status);
    body->to = c->at;
    QDOT_TRY(qdot_cursor_expect_end(c));
    return capture_loop_indices(c->session, body, entry->formals, &entry->value);
}

qdot_status
qdot_function_read(qdot_cursor *c, qdot_name *entry)
{
    const qdot_token **names = NULL;
    qdot_status status;
    size_t n = 0;

    *entry = (qdot_name){.name = (char *)c->at->text, .kind = QDOT_NAME_FUNCTION};
    c->at++;
    status = qdot_formals_read(c, &entry->formals, &names, &n);
    qdot_free(names);
    QDOT_TRY(status);
    QDOT_TRY(qdot_cursor_expect_op(c, "="));
    entry->body = qdot_function_body_new(c->source, c->at, c->at);
    return entry->body != NULL ? read_body(c, entry) : QDOT_ENOMEM;
}

/* --- calling functions -------------------------------------------------------------- */

/* Add to the error the place in the function's definition where it occurred; for nested calls the innermost. */
static qdot_status
add_place_to_error(qdot_session *s, const qdot_name *entry, size_t at, qdot_status status)
{
    const qdot_error error = *qdot_last_error();
    uint32_t line, column;

    if (s->evaluation->placed || error.status != status || qdot_grave(status) != QDOT_OK)
        return status;
    s->evaluation->placed = true;
    qdot_source_locate(entry->body->source, at, &line, &column);
    (void)qdot_fail(status, "in the body of `%.100s` (%.150s:%u:%u): %s", entry->name,
                    entry->body->source->name, line, column, error.message);
    return error.hint[0] != '\0' ? qdot_hint("%s", error.hint) : status;
}

/* Parse the body and evaluate it; its arguments are bound to their values. */
static qdot_status
evaluate_body(qdot_cursor *c, const qdot_function_body *body, qdot_expr *value, qdot_expr *over)
{
    qdot_postfix_list program = {0};
    const char *run = NULL;
    qdot_status status = qdot_parse(c, QDOT_PARSE_VALUE, &program);

    if (status == QDOT_OK && c->at != body->to)
        status = qdot_cursor_expected(c, "the end of the statement");
    if (status == QDOT_OK)
        status = qdot_evaluate(c, &program, value, over, &run);
    qdot_free(program.list.at);
    if (status != QDOT_OK || run == NULL)
        return status;
    *value = qdot_member_of(c->session, run, *value);
    return qdot_value_kind_check(c->session->pool, *value);
}

/* Evaluate the definition of a function for these arguments. */
static qdot_status
apply_function(qdot_session *s, const qdot_name *entry, const qdot_argument *args, qdot_expr *value,
               qdot_expr *over)
{
    qdot_cursor c = {.session = s,
                     .source = entry->body->source,
                     .at = entry->body->from,
                     .error_at = entry->body->from->start};
    qdot_status status;
    size_t outer;

    s->evaluation->placed = false;
    if (s->evaluation->calls >= QDOT_FUNCTION_DEPTH)
        return qdot_fail(QDOT_ELIMIT,
                         "the recursion of `%.200s` does not end: %d calls within one another",
                         entry->name, QDOT_FUNCTION_DEPTH);
    s->evaluation->calls++;
    status = bind_names_of_body(s, entry, args, &outer);
    if (status == QDOT_OK)
        status = evaluate_body(&c, entry->body, value, over);
    qdot_names_disclose(s->names, outer);
    s->evaluation->calls--;
    return status == QDOT_OK ? QDOT_OK : add_place_to_error(s, entry, c.error_at, status);
}

/* --- member by member --------------------------------------------------------------- */

typedef struct {
    qdot_session *s;
    const qdot_name *entry;
    unsigned primes;
} mapping;

static qdot_status evaluate_derivative(mapping *m, qdot_expr arg, qdot_expr *value);

static qdot_expr
apply_to_scalar_component(qdot_pool *pool, qdot_expr scalar, void *user)
{
    mapping *m = user;
    const qdot_argument arg = {.value = scalar};
    qdot_expr value, over;
    qdot_status status = m->primes > 0 ? evaluate_derivative(m, scalar, &value)
                                       : apply_function(m->s, m->entry, &arg, &value, &over);

    return status == QDOT_OK ? value : qdot_pool_fail(pool);
}

static qdot_status apply_to_argument(mapping *m, const qdot_argument *arg, qdot_expr *value,
                                     qdot_expr *over);

static qdot_status
apply_to_members(mapping *m, qdot_expr list, qdot_expr *value)
{
    qdot_pool *pool = m->s->pool;
    const uint32_t n = qdot_expr_count(pool, list);
    qdot_expr *made = qdot_malloc((n + 1) * sizeof *made), over;
    qdot_status status = made != NULL ? QDOT_OK : QDOT_ENOMEM;

    for (uint32_t i = 0; i < n && status == QDOT_OK; i++) {
        const qdot_argument arg = {.value = qdot_expr_arg(pool, list, i)};

        status = apply_to_argument(m, &arg, made + i, &over);
    }
    if (status == QDOT_OK) {
        *value = qdot_list(pool, n, made);
        status = qdot_value_kind_check(pool, *value);
    }
    qdot_free(made);
    return status;
}

/* Apply the function to each member of a vector or list, after it failed for the vector as a whole. */
static qdot_status
apply_by_components(mapping *m, qdot_expr arg, qdot_expr *value)
{
    const qdot_error error = *qdot_last_error();
    qdot_status status;

    if (m->s->evaluation->passed != NULL)
        m->s->evaluation->passed->spoiled = true; /* in a call by components the parts need not be defined */
    if (qdot_expr_kind(m->s->pool, arg) == QDOT_LIST) {
        status = apply_to_members(m, arg, value);
    } else {
        *value = qdot_value_map(m->s->pool, arg, apply_to_scalar_component, m);
        status = qdot_value_kind_check(m->s->pool, *value);
    }
    return status == QDOT_ETYPE ? qdot_fail_again(&error) : status;
}

static qdot_status
apply_to_argument(mapping *m, const qdot_argument *arg, qdot_expr *value, qdot_expr *over)
{
    const qdot_status status = apply_function(m->s, m->entry, arg, value, over);

    if (status != QDOT_ETYPE || qdot_expr_is_scalar(m->s->pool, arg->value))
        return status;
    *over = QDOT_NIL;
    return apply_by_components(m, arg->value, value);
}

/* --- derivatives f'(a) -------------------------------------------------------------- */

/* The derivative by the argument, at a scalar. The body is evaluated at a symbol and that
 * differentiated: right where the value at a is that at the symbol with a put in. It is not of
 * f(u) = diff(u, x), which depends on what u is made of. */
static qdot_status
evaluate_derivative(mapping *m, qdot_expr arg, qdot_expr *value)
{
    qdot_pool *pool = m->s->pool;
    const qdot_facts facts = qdot_scene_facts(m->s->scene);
    /* the symbol of the argument has a blank in its name, so that no declared name equals it */
    const qdot_argument at = {.value = arg},
                        symbol = {.value = qdot_symbol_get(pool, QDOT_FORMAL, "an argument")};
    qdot_expr direct, body, put, over;

    QDOT_TRY(apply_function(m->s, m->entry, &at, &direct, &over));
    QDOT_TRY(apply_function(m->s, m->entry, &symbol, &body, &over));
    put = qdot_subs(pool, body, 1, &symbol.value, &arg);
    QDOT_TRY(qdot_value_kind_check(pool, put));
    if (put != direct &&
        (!qdot_expr_is_scalar(pool, put) || !qdot_expr_is_scalar(pool, direct) ||
         !qdot_is_zero(pool, qdot_sub(pool, put, direct), &facts))) {
        QDOT_TRY(qdot_pool_check(pool));
        (void)qdot_fail(QDOT_ETYPE, "`%.200s` is no function of a number alone: its value "
                        "depends on what the argument is made of", m->entry->name);
        return qdot_hint("write diff(%.40s(...), s)", m->entry->name);
    }
    for (unsigned k = m->primes; k > 0; k--)
        body = qdot_diff(pool, body, symbol.value);
    *value = qdot_subs(pool, body, 1, &symbol.value, &arg);
    return qdot_value_kind_check(pool, *value);
}

qdot_status
qdot_function_call(qdot_session *s, const qdot_name *entry, unsigned primes, uint32_t n,
                   const qdot_argument *args, qdot_expr *value, qdot_expr *over)
{
    const uint32_t arity = qdot_expr_count(s->pool, entry->formals);
    mapping m = {.s = s, .entry = entry, .primes = primes};

    *over = QDOT_NIL;
    if (n != arity)
        return qdot_fail(QDOT_ETYPE, "`%.200s` takes %u argument%s, not %u", entry->name,
                         arity, arity == 1 ? "" : "s", n);
    if (primes > 0 && n != 1)
        return qdot_resolve_no_prime(entry->name,
                                     "has several arguments: a prime does not say which");
    if (primes == 0)
        return n == 1 ? apply_to_argument(&m, args, value, over)
                      : apply_function(s, entry, args, value, over);
    if (s->evaluation->passed != NULL)
        s->evaluation->passed->spoiled = true;
    *value = qdot_value_map(s->pool, args[0].value, apply_to_scalar_component, &m);
    return qdot_value_kind_check(s->pool, *value);
}

/* --- the function itself ------------------------------------------------------------ */

qdot_status
qdot_function_print(qdot_session *s, const qdot_name *entry, qdot_text *out)
{
    const uint32_t arity = qdot_expr_count(s->pool, entry->formals);
    qdot_status status;
    size_t outer;

    qdot_text_format(out, "%s(", entry->name);
    for (uint32_t i = 0; i < arity; i++)
        qdot_text_format(out, "%s%s", i > 0 ? ", " : "",
                         qdot_expr_symbol(s->pool, qdot_expr_arg(s->pool, entry->formals, i))
                             ->name);
    qdot_text_add(out, ") = ");
    status = bind_names_of_body(s, entry, NULL, &outer);
    if (status == QDOT_OK)
        qdot_token_text(s, entry->body->from, entry->body->to, out);
    qdot_names_disclose(s->names, outer);
    return status == QDOT_OK ? qdot_text_status(out) : status;
}

bool
qdot_function_mentions(const qdot_pool *pool, const qdot_name *entry, const char *name)
{
    const size_t length = strcspn(name, "[");

    for (const qdot_token *k = entry->body->from; k < entry->body->to; k++)
        if (k->kind == QDOT_TOKEN_NAME && strlen(k->text) == length &&
            strncmp(k->text, name, length) == 0 && !is_argument_name(pool, entry->formals, k->text))
            return true;
    return false;
}
