/* field.c -- finds the generators of expressions and sets up the field that they generate. */
#include "normal/field/field.h"

#include <stdlib.h>

#include <flint/fmpz_factor.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "normal/field/value.h"

static void
stop_field(qdot_field *f, qdot_status status)
{
    if (status == QDOT_OK || f->state != QDOT_FIELD_GOES)
        return;
    f->state = status == QDOT_ELIMIT ? QDOT_FIELD_OVER : QDOT_FIELD_FAILED;
    f->status = status;
}

/* --- which generators occur -------------------------------------------------------- */

struct found {
    qdot_gen *at;
    size_t n, capacity;
    qdot_expr *stack;
    size_t depth, stack_capacity;
    qdot_map known;
};

static qdot_status
add_generator(struct found *g, qdot_gen gen)
{
    if (gen.expr == QDOT_NIL)
        return QDOT_EINVAL;
    if (qdot_map_get(&g->known, gen.expr, NULL))
        return QDOT_OK;
    QDOT_TRY(qdot_map_set(&g->known, gen.expr, 0));
    QDOT_TRY(qdot_grow(&g->at, &g->capacity, g->n + 1, sizeof *g->at));
    g->at[g->n++] = gen;
    return QDOT_OK;
}

static qdot_status
nodes_push(struct found *g, qdot_expr e)
{
    QDOT_TRY(qdot_grow(&g->stack, &g->stack_capacity, g->depth + 1, sizeof *g->stack));
    g->stack[g->depth++] = e;
    return QDOT_OK;
}

/* b^(1/q) occurs. Roots of one base share the least common order; the expression comes
 * later. */
static qdot_status
add_root(struct found *g, qdot_expr base, ulong q)
{
    for (size_t i = 0; i < g->n; i++)
        if (g->at[i].kind == QDOT_GEN_ROOT && g->at[i].of == base) {
            ulong a = g->at[i].order, b = q;

            while (b != 0) {
                ulong rest = a % b;

                a = b;
                b = rest;
            }
            if (g->at[i].order / a > 10000 / q)
                return qdot_fail(QDOT_ELIMIT, "roots of too high an order");
            g->at[i].order = (uint32_t)(g->at[i].order / a * q);
            return QDOT_OK;
        }
    QDOT_TRY(qdot_grow(&g->at, &g->capacity, g->n + 1, sizeof *g->at));
    g->at[g->n++] = (qdot_gen){.kind = QDOT_GEN_ROOT, .of = base, .order = (uint32_t)q};
    return QDOT_OK;
}

/* Add the prime factors of an integer as bases of roots; a large integer is not factored. */
static qdot_status
add_number_root(qdot_pool *pool, struct found *g, qdot_expr base, ulong q)
{
    qdot_status status = QDOT_OK;
    fmpz_factor_t factors;
    fmpz_t n;

    fmpz_init(n);
    fmpz_set(n, fmpq_numref(qdot_expr_rational(pool, base)));
    if (fmpz_bits(n) > 64) {
        fmpz_clear(n);
        QDOT_TRY(nodes_push(g, base));
        return add_root(g, base, q);
    }
    fmpz_factor_init(factors);
    fmpz_factor(factors, n);
    for (slong i = 0; i < factors->num && status == QDOT_OK; i++) {
        qdot_expr prime = qdot_expr_fmpz(pool, factors->p + i);

        status = nodes_push(g, prime);
        if (status == QDOT_OK)
            status = add_root(g, prime, q);
    }
    fmpz_factor_clear(factors);
    fmpz_clear(n);
    return status;
}

static qdot_status
field_add_power(qdot_field *f, struct found *g, qdot_expr base, qdot_expr exponent)
{
    const fmpq *x = qdot_expr_rational(f->pool, exponent);
    ulong q;

    if (x == NULL || !fmpz_abs_fits_ui(fmpq_denref(x)) ||
        fmpz_cmp_ui(fmpq_denref(x), 10000) > 0)
        return add_generator(g, (qdot_gen){.kind = QDOT_GEN_PLAIN,
                                     .expr = qdot_pow(f->pool, base, exponent)});
    q = fmpz_get_ui(fmpq_denref(x));
    if (q == 1)
        return nodes_push(g, base);
    if (qdot_expr_kind(f->pool, base) == QDOT_NUM)
        return add_number_root(f->pool, g, base, q);
    QDOT_TRY(nodes_push(g, base));
    return add_root(g, base, q);
}

static qdot_status
add_offset_roots(qdot_field *f, struct found *g)
{
    for (size_t i = 0; i < f->circular.n_rows; i++) {
        slong d = fmpz_get_si(fmpq_denref(&f->circular.row[i].pi));

        if (d % 4 == 0)
            QDOT_TRY(add_number_root(f->pool, g, qdot_expr_int(f->pool, 2), 2));
        if (d % 3 == 0)
            QDOT_TRY(add_number_root(f->pool, g, qdot_expr_int(f->pool, 3), 2));
    }
    return QDOT_OK;
}

static qdot_status
add_generators_of_function(qdot_field *f, struct found *g, qdot_expr e)
{
    qdot_expr arg = qdot_expr_arg(f->pool, e, 0);
    uint32_t row;

    switch (qdot_expr_node(f->pool, e)->op) {
    case QDOT_SIN:
    case QDOT_COS:
    case QDOT_TAN:
    case QDOT_SEC:
    case QDOT_CSC:
    case QDOT_COT: return qdot_lattice_add(&f->circular, f->pool, arg, true, &row);
    case QDOT_SINH:
    case QDOT_COSH:
    case QDOT_TANH: return qdot_lattice_add(&f->hyperbolic, f->pool, arg, false, &row);
    case QDOT_EXP: return qdot_lattice_add(&f->exponential, f->pool, arg, false, &row);
    case QDOT_ABS:
        QDOT_TRY(nodes_push(g, arg));
        return add_generator(g, (qdot_gen){.kind = QDOT_GEN_ABS, .expr = e, .of = arg});
    default: return add_generator(g, (qdot_gen){.kind = QDOT_GEN_PLAIN, .expr = e});
    }
}

#define FAST                                                                             \
    (QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER |                   \
     QDOT_HAS_MOMENTUM | QDOT_HAS_DIFFERENTIAL | QDOT_HAS_DELTA)

static qdot_status
add_generators_of_node(qdot_field *f, struct found *g, qdot_expr e)
{
    qdot_pool *pool = f->pool;
    uint32_t n = qdot_expr_count(pool, e);

    switch (qdot_expr_kind(pool, e)) {
    case QDOT_NUM: return QDOT_OK;
    case QDOT_SYM:
        return add_generator(g, (qdot_gen){.kind = QDOT_GEN_PLAIN,
                                     .expr = e,
                                     .fast = qdot_expr_node(pool, e)->holds & FAST});
    case QDOT_SUM:
        for (uint32_t i = 1; i < n; i += 2)
            QDOT_TRY(nodes_push(g, qdot_expr_arg(pool, e, i)));
        return QDOT_OK;
    case QDOT_PROD:
        for (uint32_t i = 1; i < n; i += 2)
            QDOT_TRY(field_add_power(f, g, qdot_expr_arg(pool, e, i),
                                     qdot_expr_arg(pool, e, i + 1)));
        return QDOT_OK;
    case QDOT_FUN: return add_generators_of_function(f, g, e);
    case QDOT_INTEGRAL:
    case QDOT_UFUN: return add_generator(g, (qdot_gen){.kind = QDOT_GEN_PLAIN, .expr = e});
    default: return qdot_fail(QDOT_ETYPE, "a number is needed here");
    }
}

static int
compare_ascending(const void *a, const void *b)
{
    qdot_expr x = *(const qdot_expr *)a, y = *(const qdot_expr *)b;

    return x < y ? -1 : x > y;
}

/* The number of terms and factors of e, or of the argument of a function e. */
static slong
node_length(const qdot_pool *pool, qdot_expr e)
{
    qdot_kind kind = qdot_expr_kind(pool, e);

    if (kind == QDOT_FUN)
        e = qdot_expr_arg(pool, e, 0);
    return kind == QDOT_SUM || kind == QDOT_PROD || kind == QDOT_FUN
               ? (slong)qdot_expr_count(pool, e)
               : 0;
}

/* Collect all nodes on which the values depend, children first. */
static qdot_status
field_find_generators(qdot_field *f, struct found *g, size_t n, const qdot_expr *e)
{
    size_t capacity = 0, rows = 0;
    qdot_expr at;

    for (size_t i = 0; i < n; i++)
        QDOT_TRY(nodes_push(g, e[i]));
    while (g->depth > 0 || rows < f->circular.n_rows) {
        if (g->depth == 0) { /* repeat, because new angles may lead to new roots */
            rows = f->circular.n_rows;
            QDOT_TRY(add_offset_roots(f, g));
            continue;
        }
        at = g->stack[--g->depth];

        if (at == QDOT_NIL)
            return qdot_pool_failed(f->pool) ? qdot_pool_check(f->pool) : QDOT_EINVAL;
        if (qdot_map_get(&f->nodes, at, NULL))
            continue;
        QDOT_TRY(qdot_map_set(&f->nodes, at, 0));
        QDOT_TRY(qdot_grow(&f->node, &capacity, f->n_nodes + 1, sizeof *f->node));
        f->node[f->n_nodes++] = at;
        if (!qdot_field_charge(f, 8, 8 + node_length(f->pool, at)))
            return f->state == QDOT_FIELD_FAILED ? f->status : QDOT_ELIMIT;
        QDOT_TRY(add_generators_of_node(f, g, at));
    }
    qsort(f->node, f->n_nodes, sizeof *f->node, compare_ascending);
    for (size_t i = 0; i < f->n_nodes; i++)
        QDOT_TRY(qdot_map_set(&f->nodes, f->node[i], (uint32_t)i));
    return QDOT_OK;
}

/* --- order of generators; rules of the trigonometric ones -------------------------- */

/* Write hyperbolic functions in terms of exponentials if both occur. */
static qdot_status
merge_hyperbolic(qdot_field *f)
{
    uint32_t row;

    if (f->exponential.n_rows == 0)
        return QDOT_OK;
    for (size_t i = 0; i < f->hyperbolic.n_rows; i++)
        QDOT_TRY(qdot_lattice_add(&f->exponential, f->pool, f->hyperbolic.row[i].arg,
                                  false, &row));
    qdot_lattice_clear(&f->hyperbolic);
    return QDOT_OK;
}

static qdot_status
add_sine_cosine_pairs(qdot_field *f, struct found *g, const qdot_lattice *l, qdot_fun_id s,
                      qdot_fun_id c, qdot_gen_kind ks, qdot_gen_kind kc)
{
    for (size_t j = 0; j < l->n_bases; j++) {
        qdot_expr b = l->base[j];
        qdot_gen gs = {.kind = ks, .expr = qdot_fun1(f->pool, s, b), .of = b};
        qdot_gen gc = {.kind = kc, .expr = qdot_fun1(f->pool, c, b), .of = b};

        if (gs.expr == QDOT_NIL || gc.expr == QDOT_NIL)
            return qdot_pool_check(f->pool);
        QDOT_TRY(qdot_grow(&g->at, &g->capacity, g->n + 2, sizeof *g->at));
        g->at[g->n++] = gs;
        g->at[g->n++] = gc;
    }
    return QDOT_OK;
}

static qdot_status
add_exponentials(qdot_field *f, struct found *g)
{
    for (size_t j = 0; j < f->exponential.n_bases; j++) {
        qdot_expr b = f->exponential.base[j];
        qdot_gen e = {
            .kind = QDOT_GEN_EXP, .expr = qdot_fun1(f->pool, QDOT_EXP, b), .of = b};

        if (e.expr == QDOT_NIL)
            return qdot_pool_check(f->pool);
        QDOT_TRY(qdot_grow(&g->at, &g->capacity, g->n + 1, sizeof *g->at));
        g->at[g->n++] = e;
    }
    return QDOT_OK;
}

/* The rank of a generator: roots and absolute values (outer ones first), sines, cosines, the rest. */
static int
generator_rank(qdot_gen_kind kind)
{
    static const int place[] = {
        [QDOT_GEN_ROOT] = 0, [QDOT_GEN_ABS] = 0,  [QDOT_GEN_SIN] = 1,
        [QDOT_GEN_SINH] = 2, [QDOT_GEN_COS] = 3,  [QDOT_GEN_COSH] = 4,
        [QDOT_GEN_EXP] = 5,  [QDOT_GEN_PLAIN] = 6};

    return place[kind];
}

static int
compare_generators(const void *a, const void *b, void *pool)
{
    const qdot_gen *x = a, *y = b;
    int d = generator_rank(x->kind) - generator_rank(y->kind);

    if (d != 0)
        return d;
    if (generator_rank(x->kind) == 0 && x->of != y->of)
        return x->of > y->of ? -1 : 1;
    if (x->of != QDOT_NIL && x->of != y->of)
        return qdot_expr_compare(pool, x->of, y->of);
    return qdot_expr_compare(pool, y->expr,
                             x->expr); /* reversed: accelerations come before parameters */
}

static void
pair_sines_with_cosines(qdot_field *f)
{
    for (slong i = 0; i < f->n; i++)
        for (slong j = i + 1; j < f->n; j++)
            if (f->gen[i].of == f->gen[j].of && f->gen[i].of != QDOT_NIL &&
                ((f->gen[i].kind == QDOT_GEN_SIN && f->gen[j].kind == QDOT_GEN_COS) ||
                 (f->gen[i].kind == QDOT_GEN_SINH && f->gen[j].kind == QDOT_GEN_COSH))) {
                f->gen[i].pair = (uint32_t)j;
                f->gen[j].pair = (uint32_t)i;
                break;
            }
}

/* Rules in the order of their variables; those of roots are filled in when the value of
 * the base is known (value.c). */
static qdot_status
make_rewriting_rules(qdot_field *f)
{
    ulong *exp = qdot_calloc((size_t)f->n + 1, sizeof *exp);

    f->rule = qdot_calloc((size_t)f->n + 1, sizeof *f->rule);
    if (exp == NULL || f->rule == NULL) {
        qdot_free(exp);
        return QDOT_ENOMEM;
    }
    for (slong v = 0; v < f->n && generator_rank(f->gen[v].kind) < 3; v++) {
        qdot_rule *rule = &f->rule[f->n_rules++];

        rule->var = v;
        fmpz_mpoly_init(rule->poly, f->ctx);
        if (generator_rank(f->gen[v].kind) == 0)
            continue;
        rule->power = 2;
        exp[v] = 2;
        fmpz_mpoly_push_term_si_ui(rule->poly, 1, exp, f->ctx);
        exp[v] = 0;
        exp[f->gen[v].pair] = 2;
        fmpz_mpoly_push_term_si_ui(rule->poly, f->gen[v].kind == QDOT_GEN_SIN ? 1 : -1,
                                   exp, f->ctx);
        exp[f->gen[v].pair] = 0;
        fmpz_mpoly_push_term_si_ui(rule->poly, f->gen[v].kind == QDOT_GEN_SIN ? -1 : 1,
                                   exp, f->ctx);
    }
    qdot_free(exp);
    return QDOT_OK;
}

/* Find base angles of which the arguments (a lattice) are integer combinations; the work is charged to the budget. */
static qdot_status
solve_lattice(qdot_field *f, qdot_lattice *l)
{
    size_t least = l->n_rows < l->n_monos ? l->n_rows : l->n_monos;

    if (!qdot_field_charge(f, (slong)(1 + l->n_rows * l->n_monos / 64), (slong)(1 + least)))
        return f->state == QDOT_FIELD_FAILED ? f->status : QDOT_ELIMIT;
    return qdot_lattice_solve(l, f->pool);
}

static qdot_status
field_settle_generators(qdot_field *f, struct found *g)
{
    for (size_t i = 0; i < g->n; i++)
        if (g->at[i].kind == QDOT_GEN_ROOT) {
            g->at[i].expr = qdot_pow(f->pool, g->at[i].of,
                                     qdot_expr_ratio(f->pool, 1, (int64_t)g->at[i].order));
            if (g->at[i].expr == QDOT_NIL)
                return qdot_pool_check(f->pool);
        }
    QDOT_TRY(merge_hyperbolic(f));
    if (f->circular.n_rows > 0) {
        QDOT_TRY(solve_lattice(f, &f->circular));
        QDOT_TRY(add_sine_cosine_pairs(f, g, &f->circular, QDOT_SIN, QDOT_COS, QDOT_GEN_SIN,
                                       QDOT_GEN_COS));
    }
    if (f->hyperbolic.n_rows > 0) {
        QDOT_TRY(solve_lattice(f, &f->hyperbolic));
        QDOT_TRY(add_sine_cosine_pairs(f, g, &f->hyperbolic, QDOT_SINH, QDOT_COSH, QDOT_GEN_SINH,
                                       QDOT_GEN_COSH));
    }
    if (f->exponential.n_rows > 0) {
        QDOT_TRY(solve_lattice(f, &f->exponential));
        QDOT_TRY(add_exponentials(f, g));
    }
    if (g->n > 1)
        qsort_r(g->at, g->n, sizeof *g->at, compare_generators, f->pool);
    f->gen = g->at;
    g->at = NULL;
    f->n = (slong)g->n;
    pair_sines_with_cosines(f);
    for (slong v = 0; v < f->n; v++)
        QDOT_TRY(qdot_map_set(&f->vars, f->gen[v].expr, (uint32_t)v));
    fmpz_mpoly_ctx_init(f->ctx, f->n, ORD_LEX);
    f->has_ctx = true;
    return make_rewriting_rules(f);
}

void
qdot_field_begin(qdot_field *f, qdot_pool *pool, size_t n, const qdot_expr *e,
                 int64_t work)
{
    struct found g = {0};
    qdot_status status;

    *f = (qdot_field){.pool = pool, .work = work, .status = QDOT_OK};
    if (qdot_pool_failed(pool)) {
        f->state = QDOT_FIELD_FAILED;
        f->status = qdot_last_error()->status;
        return;
    }
    status = field_find_generators(f, &g, n, e);
    if (status == QDOT_OK)
        status = field_settle_generators(f, &g);
    if (status == QDOT_OK)
        status = qdot_value_all(f);
    stop_field(f, status);
    qdot_free(g.at);
    qdot_free(g.stack);
    qdot_map_clear(&g.known);
}

void
qdot_field_end(qdot_field *f)
{
    if (f->has_ctx) {
        for (size_t i = 0; f->value != NULL && i < f->n_nodes; i++)
            qdot_ratio_clear(f, &f->value[i]);
        for (size_t i = 0; i < f->n_rules; i++)
            fmpz_mpoly_clear(f->rule[i].poly, f->ctx);
        fmpz_mpoly_ctx_clear(f->ctx);
    }
    qdot_free(f->value);
    qdot_free(f->rule);
    qdot_free(f->gen);
    qdot_free(f->node);
    qdot_map_clear(&f->vars);
    qdot_map_clear(&f->nodes);
    qdot_lattice_clear(&f->circular);
    qdot_lattice_clear(&f->hyperbolic);
    qdot_lattice_clear(&f->exponential);
    f->has_ctx = false;
}

const qdot_ratio *
qdot_field_value(qdot_field *f, qdot_expr e)
{
    uint32_t i;

    if (f->state != QDOT_FIELD_GOES || !qdot_map_get(&f->nodes, e, &i))
        return NULL;
    return &f->value[i];
}

void
qdot_field_cancelled(qdot_field *f, qdot_ratio *r, qdot_expr e)
{
    qdot_ratio_init(f, r);
    qdot_ratio_set(f, r, qdot_field_value(f, e));
    qdot_ratio_cancel(f, r);
}
