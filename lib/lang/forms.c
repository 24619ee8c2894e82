/* forms.c -- what a function is of numbers, of vectors and of matrices.
 *
 * NAME(u) = EXPR is evaluated when it is defined, so each kind of argument that it may be
 * called with gets an evaluation of its own: of a vector, with its components as symbols.
 */
#include "base/text.h"
#include "lang/code.h"
#include "lang/declare.h"

/* A number, a vector, a square matrix: what an argument may be, in a plane or in space. */
enum { kinds = 3 };

/* With more arguments, or a body of more nodes, only numbers. */
enum { most_arguments = 3, most_nodes = 100000 };

/* v[1], v[2] or A[1,1] ... as symbols, as many as `name` has in `dimension`. */
static qdot_expr
shape(qdot_pool *pool, const char *name, int kind, uint32_t dimension)
{
    const uint32_t count = kind == 2 ? dimension * dimension : dimension;
    qdot_expr entries[9];
    qdot_text text = {0};

    for (uint32_t i = 0; i < count; i++) {
        qdot_text_clear(&text);
        if (kind == 2)
            qdot_text_format(&text, "%s[%u,%u]", name, i / dimension + 1, i % dimension + 1);
        else
            qdot_text_format(&text, "%s[%u]", name, i + 1);
        entries[i] = qdot_text_status(&text) == QDOT_OK
                         ? qdot_symbol_get(pool, QDOT_FORMAL, qdot_text_str(&text))
                         : QDOT_NIL;
    }
    qdot_text_clear(&text);
    return kind == 2 ? qdot_matrix(pool, dimension, dimension, entries)
                     : qdot_vector(pool, dimension, entries);
}

/* The arguments of the form number `code`, a digit each. QDOT_NIL: it is none. */
static qdot_expr
arguments(qdot_pool *pool, qdot_expr formals, unsigned code, uint32_t dimension)
{
    const uint32_t n = qdot_expr_count(pool, formals);
    qdot_expr args[most_arguments];

    for (uint32_t i = 0; i < n; i++, code /= kinds) {
        const qdot_expr formal = qdot_expr_arg(pool, formals, i);
        const int kind = (int)(code % kinds);

        if (kind != 0 && formal == QDOT_T)
            return QDOT_NIL;
        args[i] = kind == 0 ? formal
                            : shape(pool, qdot_expr_symbol(pool, formal)->name, kind, dimension);
    }
    return qdot_list(pool, n, args);
}

typedef struct {
    qdot_cursor *c;
    const qdot_token *start;
    size_t n;
    const qdot_token *const *names;
    qdot_vec(qdot_expr) forms;
} reading;

/* Evaluate the body for one form and keep it. */
static qdot_status
take(reading *r, qdot_expr args)
{
    qdot_pool *pool = r->c->session->pool;
    qdot_vec(qdot_expr) form = {0};
    qdot_expr body = QDOT_NIL, made;
    qdot_status status;

    r->c->at = r->start;
    status = qdot_declare_read_body(r->c, args, r->n, r->names, &body);
    for (uint32_t i = 0; i < r->n && status == QDOT_OK; i++)
        status = qdot_vec_push(&form, qdot_expr_arg(pool, args, i));
    if (status == QDOT_OK)
        status = qdot_vec_push(&form, body);
    if (status == QDOT_OK) {
        made = qdot_list(pool, (uint32_t)form.n, form.at);
        status = qdot_resolve_check(pool, made);
        if (status == QDOT_OK)
            status = qdot_vec_push(&r->forms, made);
    }
    qdot_free(form.at);
    return status;
}

/* Those of vectors and matrices; one that has no meaning is no error. *end: behind the body. */
static qdot_status
take_shaped(reading *r, qdot_expr formals, const qdot_token **end)
{
    qdot_pool *pool = r->c->session->pool;
    unsigned codes = 1;

    for (size_t i = 0; i < r->n; i++)
        codes *= kinds;
    for (uint32_t dimension = 2; dimension <= 3; dimension++)
        for (unsigned code = 1; code < codes; code++) {
            const qdot_expr args = arguments(pool, formals, code, dimension);
            qdot_status status;

            if (args == QDOT_NIL)
                continue;
            status = take(r, args);
            if (status == QDOT_ENOMEM || status == QDOT_EINTR)
                return status;
            if (status == QDOT_OK)
                *end = r->c->at;
        }
    return qdot_pool_check(pool);
}

/* Whether forms beside that for numbers, of this outcome, are to be looked for. */
static bool
may_be_shaped(const reading *r, qdot_status status, size_t nodes)
{
    return (status == QDOT_OK || status == QDOT_ETYPE) && r->n <= most_arguments &&
           nodes < most_nodes;
}

qdot_status
qdot_declare_read_forms(qdot_cursor *c, qdot_expr formals, size_t n,
                        const qdot_token *const *names, qdot_expr *forms)
{
    qdot_pool *pool = c->session->pool;
    const size_t nodes = qdot_pool_count(pool);
    reading r = {.c = c, .start = c->at, .n = n, .names = names};
    qdot_status status = take(&r, formals);
    const qdot_token *end = c->at;
    const size_t error_at = c->error_at;
    const qdot_error error = *qdot_last_error();

    if (may_be_shaped(&r, status, qdot_pool_count(pool) - nodes)) {
        const qdot_status shaped = take_shaped(&r, formals, &end);

        if (shaped != QDOT_OK)
            status = shaped;
        else if (r.forms.n > 0)
            status = QDOT_OK;
        else
            status = qdot_fail_again(&error);
        c->error_at = error_at;
    }
    c->at = end;
    if (status == QDOT_OK) {
        *forms = qdot_list(pool, (uint32_t)r.forms.n, r.forms.at);
        status = qdot_resolve_check(pool, *forms);
    }
    qdot_free(r.forms.at);
    return status;
}
