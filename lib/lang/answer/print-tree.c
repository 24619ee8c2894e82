/* print-tree.c -- writes expressions as JSON arrays in prefix form. */
#include "lang/answer/print-tree.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include <flint/fmpz.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/integral.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/unit.h"
#include "expr/walk.h"

/* What is still to be written: an expression, or with QDOT_NIL a text, or without one a number; a comma before it. */
typedef struct {
    qdot_expr e;
    const char *text; /* of the program or of the pool */
    uint32_t number;
    bool comma;
} item;

typedef struct {
    qdot_pool *pool;
    qdot_text *out;
    qdot_vec(item) rest; /* what is to be written, the last one first */
    qdot_vec(item) row;  /* the parts of the present node, in order */
    qdot_status status;
} tree;

/* --- parts of a node ------------------------------------------------------------------------- */

static void
add_item(tree *t, item part)
{
    if (t->status == QDOT_OK)
        t->status = qdot_vec_push(&t->row, part);
}

static void
add_expr(tree *t, qdot_expr e)
{
    add_item(t, (item){.e = e, .comma = true});
}

/* An array opens as the next entry of the present one. */
static void
add_open(tree *t, const char *open)
{
    add_item(t, (item){.text = open, .comma = true});
}

static void
add_close(tree *t)
{
    add_item(t, (item){.text = "]"});
}

static void
add_args(tree *t, qdot_expr e, uint32_t from, uint32_t to)
{
    for (uint32_t i = from; i < to; i++)
        add_expr(t, qdot_expr_arg(t->pool, e, i));
}

/* Write the opening of the array of a word, whose other entries are added. */
static void
open_array(tree *t, const char *word)
{
    qdot_text_char(t->out, '[');
    qdot_text_json(t->out, word);
}

static void
put_parts_on_stack(tree *t)
{
    for (size_t i = t->row.n; i-- > 0 && t->status == QDOT_OK;)
        t->status = qdot_vec_push(&t->rest, t->row.at[i]);
    t->row.n = 0;
}

/* --- numbers and symbols ----------------------------------------------------------------------- */

static void
write_integer(tree *t, const fmpz_t n)
{
    const size_t most = COEFF_IS_MPZ(*n) ? fmpz_sizeinbase(n, 10) + 2 : 24;
    char few[24], *digits = most > sizeof few ? qdot_malloc(most) : few;

    if (digits == NULL) {
        t->status = QDOT_ENOMEM;
        return;
    }
    if (COEFF_IS_MPZ(*n))
        fmpz_get_str(digits, 10, n);
    else
        snprintf(digits, most, "%lld", (long long)*n);
    qdot_text_format(t->out, "\"%s\"", digits);
    if (digits != few)
        qdot_free(digits);
}

static void
write_rational(tree *t, qdot_expr e)
{
    const fmpq *x = qdot_expr_rational(t->pool, e);
    const bool whole = !COEFF_IS_MPZ(x->den) && x->den == 1;

    qdot_text_add(t->out, whole ? "" : "[\"/\",");
    write_integer(t, &x->num);
    if (whole)
        return;
    qdot_text_char(t->out, ',');
    write_integer(t, &x->den);
    qdot_text_char(t->out, ']');
}

/* A symbol that belongs to a coordinate: its momentum, differential, virtual displacement; a product of differentials. */
static void
write_symbol_of(tree *t, const qdot_symbol *s)
{
    const uint32_t n = s->class == QDOT_DIFFERENTIAL && qdot_expr_kind(t->pool, s->base) == QDOT_LIST
                           ? qdot_expr_count(t->pool, s->base)
                           : 0;

    open_array(t, n > 0                           ? "wedge"
                  : s->class == QDOT_MOMENTUM     ? "p"
                  : s->class == QDOT_DIFFERENTIAL ? "d"
                                                  : "delta");
    for (uint32_t i = 0; i < n; i++) {
        add_open(t, "[\"d\"");
        add_expr(t, qdot_expr_arg(t->pool, s->base, i));
        add_close(t);
    }
    if (n == 0)
        add_expr(t, s->base);
    add_close(t);
}

static void
write_symbol(tree *t, qdot_expr e)
{
    const qdot_symbol *s = qdot_expr_symbol(t->pool, e);

    if (s->class == QDOT_WORDS) {
        t->status = qdot_fail(QDOT_ETYPE, "a text is no expression");
    } else if (qdot_unit_symbol_base(t->pool, e) >= 0) {
        qdot_text_format(t->out, "[\"unit\",\"%.*s\"]", (int)strlen(s->name) - 2, s->name + 1); /* of "[kg]" */
    } else if (s->order > 0) {
        const qdot_expr base = s->class == QDOT_MOMENTUM ? qdot_symbol_of(t->pool, QDOT_MOMENTUM, s->base) : s->base;
        const uint32_t order = qdot_expr_symbol(t->pool, e)->order;

        open_array(t, "'");
        add_expr(t, base);
        add_item(t, (item){.number = order, .comma = true});
        add_close(t);
    } else if (s->class == QDOT_MOMENTUM || s->class == QDOT_DIFFERENTIAL || s->class == QDOT_DELTA) {
        write_symbol_of(t, s);
    } else {
        qdot_text_json(t->out, e == QDOT_INFINITY ? "infinity" : s->name);
    }
}

/* --- sums, products, functions ------------------------------------------------------------------ */

/* The factors of a product without its coefficient: b, or ["^",b,e]. */
static void
add_factors(tree *t, qdot_expr product)
{
    const uint32_t n = qdot_expr_count(t->pool, product);

    for (uint32_t i = 1; i < n; i += 2) {
        const qdot_expr base = qdot_expr_arg(t->pool, product, i), exponent = qdot_expr_arg(t->pool, product, i + 1);

        if (exponent == QDOT_ONE) {
            add_expr(t, base);
            continue;
        }
        add_open(t, "[\"^\"");
        add_expr(t, base);
        add_expr(t, exponent);
        add_close(t);
    }
}

static void
write_sum(tree *t, qdot_expr e)
{
    const uint32_t n = qdot_expr_count(t->pool, e);
    const qdot_expr constant = qdot_expr_arg(t->pool, e, 0);

    open_array(t, "+");
    for (uint32_t i = 1; i < n; i += 2) {
        const qdot_expr term = qdot_expr_arg(t->pool, e, i), coefficient = qdot_expr_arg(t->pool, e, i + 1);

        if (coefficient == QDOT_ONE) {
            add_expr(t, term);
            continue;
        }
        add_open(t, "[\"*\"");
        add_expr(t, coefficient);
        if (qdot_expr_kind(t->pool, term) == QDOT_PROD)
            add_factors(t, term);
        else
            add_expr(t, term);
        add_close(t);
    }
    if (constant != QDOT_ZERO)
        add_expr(t, constant);
    add_close(t);
}

static void
write_product(tree *t, qdot_expr e)
{
    const qdot_expr coefficient = qdot_expr_arg(t->pool, e, 0);

    if (coefficient == QDOT_ONE && qdot_expr_count(t->pool, e) == 3) { /* a power */
        open_array(t, "^");
        add_args(t, e, 1, 3);
    } else {
        open_array(t, "*");
        if (coefficient != QDOT_ONE)
            add_expr(t, coefficient);
        add_factors(t, e);
    }
    add_close(t);
}

static bool
is_if(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_kind(pool, e) == QDOT_FUN && qdot_expr_node(pool, e)->op == QDOT_IF;
}

static void
write_function(tree *t, qdot_expr e)
{
    const qdot_fun_id id = (qdot_fun_id)qdot_expr_node(t->pool, e)->op;

    if (id == QDOT_LOOKUP) {
        t->status = qdot_fail(QDOT_ETYPE, "the values of a table of data are no formula");
        return;
    }
    if (id == QDOT_HOLD) { /* has no meaning but for the order of a computation */
        add_item(t, (item){.e = qdot_expr_arg(t->pool, e, 0)});
        return;
    }
    open_array(t, qdot_fun_name(id));
    for (; is_if(t->pool, e) && is_if(t->pool, qdot_expr_arg(t->pool, e, 2)); e = qdot_expr_arg(t->pool, e, 2))
        add_args(t, e, 0, 2);
    add_args(t, e, 0, qdot_expr_count(t->pool, e));
    add_close(t);
}

/* Whether the n arguments are different symbols, by which a derivative can be written. */
static bool
are_different_symbols(const qdot_pool *pool, const qdot_expr *args, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        if (qdot_expr_kind(pool, args[i]) != QDOT_SYM)
            return false;
        for (uint32_t j = 0; j < i; j++)
            if (args[i] == args[j])
                return false;
    }
    return true;
}

/* An undefined function with its derivatives; a coordinate at another time, x(u), has them as velocities: ["'",["apply","x",u],1]. */
static void
write_undefined(tree *t, qdot_expr e)
{
    const uint32_t n = qdot_expr_count(t->pool, e) / 2, id = qdot_expr_node(t->pool, e)->op;
    const bool delayed = qdot_ufun_delayed(t->pool, id) != QDOT_NIL;
    const bool plain = are_different_symbols(t->pool, qdot_expr_args(t->pool, e), n);
    const char *name = qdot_ufun_get(t->pool, id)->name;
    int64_t total = 0;

    for (uint32_t i = 0; i < n; i++) {
        int64_t order = 0;

        (void)qdot_expr_to_int(t->pool, qdot_expr_arg(t->pool, e, n + i), &order);
        total += order;
    }
    if (total > 0 && !plain && !delayed) {
        open_array(t, "D");
        qdot_text_char(t->out, ',');
        for (uint32_t i = 0; i < n; i++) {
            int64_t order = 0;

            (void)qdot_expr_to_int(t->pool, qdot_expr_arg(t->pool, e, n + i), &order);
            qdot_text_format(t->out, "%s%" PRId64, i > 0 ? "," : "[", order);
        }
        qdot_text_add(t->out, "],");
        qdot_text_json(t->out, name);
        add_args(t, e, 0, n);
        add_close(t);
        return;
    }
    if (total > 0 && delayed)
        qdot_text_add(t->out, "[\"'\",");
    for (int64_t i = 0; i < total && !delayed; i++)
        qdot_text_add(t->out, "[\"diff\",");
    open_array(t, "apply");
    qdot_text_char(t->out, ',');
    qdot_text_json(t->out, name);
    add_args(t, e, 0, n);
    add_close(t);
    if (total > 0 && delayed) {
        add_item(t, (item){.number = (uint32_t)total, .comma = true});
        add_close(t);
        return;
    }
    for (uint32_t i = 0; i < n; i++) {
        int64_t order = 0;

        (void)qdot_expr_to_int(t->pool, qdot_expr_arg(t->pool, e, n + i), &order);
        for (int64_t k = 0; k < order; k++) {
            add_expr(t, qdot_expr_arg(t->pool, e, i));
            add_close(t);
        }
    }
}

/* --- integrals ------------------------------------------------------------------------------------ */

/* Whether a symbol or function of this name occurs in f. */
static qdot_status
is_name_in(const qdot_pool *pool, qdot_expr f, const char *name, bool *found)
{
    qdot_walk w;

    *found = false;
    QDOT_TRY(qdot_walk_begin(pool, f, &w));
    for (size_t i = 0; i < w.n && !*found; i++) {
        const qdot_symbol *s = qdot_expr_symbol(pool, w.at[i]);

        *found = s != NULL ? strcmp(s->name, name) == 0
                           : qdot_expr_kind(pool, w.at[i]) == QDOT_UFUN &&
                                 strcmp(qdot_ufun_get(pool, qdot_expr_node(pool, w.at[i])->op)->name, name) == 0;
    }
    qdot_walk_end(&w);
    return QDOT_OK;
}

/* A definite integral, with a name for its variable that means nothing else within it. */
static void
write_integral(tree *t, qdot_expr e)
{
    qdot_expr f = qdot_expr_arg(t->pool, e, 0), x;
    char name[80];
    bool taken = true;

    open_array(t, "integral");
    if (!qdot_integral_is_definite(t->pool, e)) {
        add_args(t, e, 0, qdot_expr_count(t->pool, e));
        add_close(t);
        return;
    }
    snprintf(name, sizeof name, "%.60s", qdot_integral_name(t->pool, e));
    for (unsigned k = 0; taken && t->status == QDOT_OK; k++) {
        if (k > 0)
            snprintf(name, sizeof name, "u%u", k);
        t->status = is_name_in(t->pool, f, name, &taken);
    }
    if (t->status != QDOT_OK)
        return;
    x = qdot_symbol_get(t->pool, QDOT_FORMAL, name);
    f = qdot_integral_open(t->pool, e, x);
    t->status = qdot_pool_check(t->pool);
    add_expr(t, f);
    add_expr(t, x);
    add_args(t, e, 1, 3);
    add_close(t);
}

/* --- all kinds --------------------------------------------------------------------------------------- */

static void
write_matrix(tree *t, qdot_expr e)
{
    const uint32_t columns = qdot_expr_node(t->pool, e)->op, n = qdot_expr_count(t->pool, e);

    open_array(t, "matrix");
    for (uint32_t i = 0; i < n; i += columns) {
        add_open(t, "[");
        for (uint32_t k = i; k < i + columns; k++)
            add_item(t, (item){.e = qdot_expr_arg(t->pool, e, k), .comma = k > i});
        add_close(t);
    }
    add_close(t);
}

static void
write_array(tree *t, const char *word, qdot_expr e)
{
    open_array(t, word);
    add_args(t, e, 0, qdot_expr_count(t->pool, e));
    add_close(t);
}

static void
write_node(tree *t, qdot_expr e)
{
    static const char *const relations[] = {[QDOT_EQ] = "=", [QDOT_LT] = "<", [QDOT_LE] = "<="};
    static const char *const logic[] = {[QDOT_AND] = "and", [QDOT_OR] = "or", [QDOT_NOT] = "not"};
    const uint32_t op = qdot_expr_node(t->pool, e)->op;

    switch (qdot_expr_kind(t->pool, e)) {
    case QDOT_NUM: write_rational(t, e); break;
    case QDOT_SYM: write_symbol(t, e); break;
    case QDOT_SUM: write_sum(t, e); break;
    case QDOT_PROD: write_product(t, e); break;
    case QDOT_FUN: write_function(t, e); break;
    case QDOT_UFUN: write_undefined(t, e); break;
    case QDOT_INTEGRAL: write_integral(t, e); break;
    case QDOT_REL: write_array(t, relations[op], e); break;
    case QDOT_LOGIC: write_array(t, logic[op], e); break;
    case QDOT_VEC: write_array(t, "vector", e); break;
    case QDOT_MAT: write_matrix(t, e); break;
    case QDOT_LIST: write_array(t, "list", e); break;
    }
    put_parts_on_stack(t);
}

static void
write_item(tree *t, const item *i)
{
    qdot_text_add(t->out, i->comma ? "," : "");
    if (i->e != QDOT_NIL)
        write_node(t, i->e);
    else if (i->text != NULL)
        qdot_text_add(t->out, i->text);
    else
        qdot_text_format(t->out, "%u", i->number);
}

qdot_status
qdot_print_tree(qdot_pool *pool, qdot_expr e, qdot_text *out)
{
    tree t = {.pool = pool, .out = out};

    t.status = qdot_vec_push(&t.rest, ((item){.e = e}));
    while (t.rest.n > 0 && t.status == QDOT_OK) {
        const item next = t.rest.at[--t.rest.n];

        write_item(&t, &next);
        if (t.status == QDOT_OK)
            t.status = out->failed ? QDOT_ENOMEM : qdot_interrupt_check();
    }
    qdot_free(t.rest.at);
    qdot_free(t.row.at);
    return t.status;
}
