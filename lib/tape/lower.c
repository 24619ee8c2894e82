/* lower.c -- compiles the expression graph to the code of a tape: sums, products, functions, node by node. */
#include <string.h>

#include "expr/build.h"
#include "expr/constant.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/rational.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "tape/angle.h"
#include "tape/code.h"
#include "tape/elliptic.h"
#include "tape/logistic.h"
#include "tape/tape.h"

/* One term of a group of terms whose coefficients are equal up to sign. */
typedef struct {
    qdot_value value;
    bool minus;
    uint32_t next; /* next term of the same group; UINT32_MAX: none */
} term;

typedef struct {
    qdot_expr magnitude;
    uint32_t first, last;
} group;

/* Data about a node of the expression, stored by the node's index in the walk. */
typedef struct {
    qdot_value bare;    /* value of the node without its constant factor */
    qdot_expr factor;   /* constant factor: node = factor * bare */
    uint32_t negatives; /* number of products that contain the node with a negative exponent */
    bool root;          /* one of these exponents is half an odd number, as in 1/sqrt(x) */
} known;

typedef struct {
    qdot_pool *pool;
    qdot_walk walk;
    known *known; /* [walk.n] data of each node */
    qdot_code code;
    bool series; /* Taylor series will be computed with this tape */
    qdot_angles *angles;

    /* Work space of the function compile_sum: */
    qdot_vec(term) terms;
    qdot_vec(group) groups;
    qdot_keymap by_magnitude;
} lowering;

static qdot_value
write_operation(lowering *l, qdot_op id, qdot_value a, qdot_value b)
{
    return qdot_code_op(&l->code, id, a, b, 0);
}

static qdot_value
value_of_node(lowering *l, qdot_expr e)
{
    return qdot_expr_is_constant(l->pool, e) ? qdot_code_constant(&l->code, e)
                                        : (qdot_value)qdot_walk_get(&l->walk, e);
}

/* If a value is the negative -x of another one, return x and reverse *minus; otherwise return the value. */
static qdot_value
remove_sign(lowering *l, qdot_value v, bool *minus)
{
    if (l->code.status == QDOT_OK && l->code.values.at[v].op == QDOT_OP_NEG) {
        *minus = !*minus;
        return l->code.values.at[v].a;
    }
    return v;
}

/* --- lowering sums ------------------------------------------------------------------ */

/* Add coefficient * v to the group of terms that have the same |coefficient|. */
static qdot_status
add_term_to_group(lowering *l, qdot_expr coefficient, qdot_value v)
{
    bool minus = qdot_expr_is_negative(l->pool, coefficient);
    qdot_expr magnitude = minus ? qdot_neg(l->pool, coefficient) : coefficient;
    uint32_t g = qdot_keymap_get(&l->by_magnitude, magnitude, 0, 0, 0);
    uint32_t n = (uint32_t)l->terms.n;

    v = remove_sign(l, v, &minus);
    QDOT_TRY(qdot_vec_push(&l->terms, ((term){v, minus, UINT32_MAX})));
    if (g != QDOT_KEYMAP_NONE) {
        l->terms.at[l->groups.at[g].last].next = n;
        l->groups.at[g].last = n;
        return QDOT_OK;
    }
    g = (uint32_t)l->groups.n;
    QDOT_TRY(qdot_vec_push(&l->groups, ((group){magnitude, n, n})));
    return qdot_keymap_set(&l->by_magnitude, magnitude, 0, 0, 0, g);
}

/* A sum while its code is being written; it begins with a positive term if there is one. */
typedef struct {
    bool begun;
    qdot_value value;
} total;

static void
add_to_total(lowering *l, total *t, qdot_value v, bool minus)
{
    if (!t->begun)
        *t = (total){true, minus ? write_operation(l, QDOT_OP_NEG, v, 0) : v};
    else
        t->value = write_operation(l, minus ? QDOT_OP_SUB : QDOT_OP_ADD, t->value, v);
}

/* The sum of a group's terms, the first positive one in front; all negative: *minus
 * and the sum of their opposites. */
static qdot_value
sum_of_group(lowering *l, const group *g, bool *minus)
{
    uint32_t lead = g->first;
    total t = {0};

    while (lead != UINT32_MAX && l->terms.at[lead].minus)
        lead = l->terms.at[lead].next;
    *minus = lead == UINT32_MAX;
    if (*minus)
        lead = g->first;
    add_to_total(l, &t, l->terms.at[lead].value, false);
    for (uint32_t i = g->first; i != UINT32_MAX; i = l->terms.at[i].next)
        if (i != lead)
            add_to_total(l, &t, l->terms.at[i].value, l->terms.at[i].minus != *minus);
    return t.value;
}

static qdot_status
compile_sum(lowering *l, qdot_expr e, known *k)
{
    qdot_pool *pool = l->pool;
    uint32_t n = qdot_expr_count(pool, e);
    qdot_expr constant = qdot_expr_arg(pool, e, 0);
    struct addend {
        qdot_value value;
        bool minus;
    } *addends;
    size_t count = 0, lead = 0;
    total t = {0};

    l->terms.n = l->groups.n = 0;
    qdot_keymap_clear(&l->by_magnitude);
    for (uint32_t i = 1; i + 1 < n; i += 2) {
        qdot_expr x = qdot_expr_arg(pool, e, i), c = qdot_expr_arg(pool, e, i + 1);
        const known *kt = l->known + qdot_walk_index(&l->walk, x);

        if (qdot_expr_is_constant(pool, x))
            constant = qdot_add(pool, constant, qdot_mul(pool, c, x));
        else
            QDOT_TRY(add_term_to_group(l, qdot_mul(pool, c, kt->factor), kt->bare));
    }
    if (qdot_pool_failed(pool))
        return qdot_pool_check(pool);
    addends = qdot_malloc((l->groups.n + 1) * sizeof *addends);
    if (!addends)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < l->groups.n; i++) {
        const group *g = l->groups.at + i;
        struct addend *a = addends + count++;

        a->value = sum_of_group(l, g, &a->minus);
        if (g->magnitude != QDOT_ONE)
            a->value = write_operation(l, QDOT_OP_MUL, a->value,
                                       qdot_code_constant(&l->code, g->magnitude));
    }
    if (constant != QDOT_ZERO)
        addends[count++] = (struct addend){qdot_code_constant(&l->code, constant), false};
    while (lead < count && addends[lead].minus)
        lead++;
    k->factor = QDOT_ONE;
    if (lead == count) { /* all terms are negative: write minus the sum of their opposites */
        for (size_t i = 0; i < count; i++)
            add_to_total(l, &t, addends[i].value, false);
        k->factor = QDOT_MINUS_ONE;
    } else {
        add_to_total(l, &t, addends[lead].value, false);
        for (size_t i = 0; i < count; i++)
            if (i != lead)
                add_to_total(l, &t, addends[i].value, addends[i].minus);
    }
    k->bare = t.value;
    qdot_free(addends);
    return QDOT_OK;
}

/* --- lowering products -------------------------------------------------------------- */

typedef struct {
    bool some;
    qdot_value value;
} product;

static void
multiply_product(lowering *l, product *p, qdot_value v)
{
    *p = (product){true, p->some ? write_operation(l, QDOT_OP_MUL, p->value, v) : v};
}

/* Twice a rational exponent if that is an integer of moderate size; otherwise 0. */
static int64_t
twice_exponent(const qdot_pool *pool, qdot_expr exponent)
{
    const fmpq *x = qdot_expr_rational(pool, exponent);

    if (!x || !qdot_rational_is_small(x) || x->den > 2 || x->num > 1000000 || x->num < -1000000)
        return 0;
    return x->den == 1 ? 2 * x->num : x->num;
}

/* Multiply the numerator (over) or the denominator (under) by v^(half/2). */
static void
multiply_by_power(lowering *l, product *over, product *under, const known *k, qdot_value v,
                  int64_t half)
{
    bool shared = k->negatives > 1;
    qdot_value root;

    if (half % 2 == 0 && !(half < 0 && shared && k->root)) {
        if (half > 0 || shared)
            multiply_product(l, over, qdot_code_power(&l->code, v, half / 2));
        else
            multiply_product(l, under, qdot_code_power(&l->code, v, -half / 2));
        return;
    }
    root = write_operation(l, QDOT_OP_SQRT, v, 0);
    if (half < 0 && shared) {
        multiply_product(l, over, qdot_code_power(&l->code, root, half));
        return;
    }
    if (half < 0) {
        over = under;
        half = -half;
    }
    if (half > 1)
        multiply_product(l, over, qdot_code_power(&l->code, v, half / 2));
    multiply_product(l, over, root);
}

static qdot_status
compile_product(lowering *l, qdot_expr e, known *k)
{
    qdot_pool *pool = l->pool;
    uint32_t n = qdot_expr_count(pool, e);
    qdot_expr factor = qdot_expr_arg(pool, e, 0);
    product over = {0}, under = {0};
    bool minus = false;

    for (uint32_t i = 1; i + 1 < n; i += 2) {
        qdot_expr b = qdot_expr_arg(pool, e, i), p = qdot_expr_arg(pool, e, i + 1);
        bool constant = qdot_expr_is_constant(pool, b);
        int64_t half = twice_exponent(pool, p);

        if (constant && qdot_expr_is_constant(pool, p))
            factor = qdot_mul(pool, factor, qdot_pow(pool, b, p));
        else if (half != 0) {
            const known *kb = l->known + qdot_walk_index(&l->walk, b);
            qdot_value v = value_of_node(l, b);
            bool odd = false;

            if (half % 2 == 0)
                v = remove_sign(l, v, &odd);
            if (odd && (half / 2) % 2 != 0)
                minus = !minus;
            multiply_by_power(l, &over, &under, kb, v, half);
        } else
            multiply_product(l, &over, write_operation(l, QDOT_OP_POW, value_of_node(l, b), value_of_node(l, p)));
    }
    if (qdot_pool_failed(pool))
        return qdot_pool_check(pool);
    if (under.some && !over.some)
        multiply_product(l, &over, qdot_code_constant(&l->code, QDOT_ONE));
    k->bare = under.some ? write_operation(l, QDOT_OP_DIV, over.value, under.value) : over.value;
    k->factor = minus ? qdot_neg(pool, factor) : factor;
    return QDOT_OK;
}

/* Count for each base in how many products it occurs with a negative exponent. */
static void
count_negative_powers(lowering *l)
{
    for (size_t i = 0; i < l->walk.n; i++) {
        qdot_expr e = l->walk.at[i];
        uint32_t n = qdot_expr_count(l->pool, e);

        if (qdot_expr_kind(l->pool, e) != QDOT_PROD)
            continue;
        for (uint32_t k = 1; k + 1 < n; k += 2) {
            int64_t half = twice_exponent(l->pool, qdot_expr_arg(l->pool, e, k + 1));
            known *b = l->known + qdot_walk_index(&l->walk, qdot_expr_arg(l->pool, e, k));

            if (half < 0) {
                b->negatives++;
                b->root |= half % 2 != 0;
            }
        }
    }
}

/* --- lowering functions and relations ----------------------------------------------- */

/* For each function that is a single operation: that operation; NEG stands for none. */
#define QDOT_OP_NONE QDOT_OP_NEG

static const qdot_op direct[QDOT_FUNCTION_KINDS] = {
#define X(ID, name, least, most, traits, lo, hi, inverse, operation, ...) [QDOT_##ID] = QDOT_OP_##operation,
#include "expr/function.def"
#undef X
};

/* Write the operation for all operands of e, from left to right: ((a op b) op c) ... */
static qdot_value
write_left_to_right(lowering *l, qdot_op id, qdot_expr e)
{
    qdot_value v = value_of_node(l, qdot_expr_arg(l->pool, e, 0));

    for (uint32_t i = 1; i < qdot_expr_count(l->pool, e); i++)
        v = write_operation(l, id, v, value_of_node(l, qdot_expr_arg(l->pool, e, i)));
    return v;
}

/* Compile the argument of `hold`: its value includes the constant factor, so readers apply only a sign. */
static void
compile_hold(lowering *l, qdot_expr x, known *k)
{
    const known *inner = l->known + qdot_walk_index(&l->walk, x);
    bool minus = qdot_expr_is_negative(l->pool, inner->factor);
    qdot_expr magnitude = minus ? qdot_neg(l->pool, inner->factor) : inner->factor;

    k->bare = inner->bare;
    if (magnitude != QDOT_ONE)
        k->bare = write_operation(l, QDOT_OP_MUL, k->bare, qdot_code_constant(&l->code, magnitude));
    k->factor = minus ? QDOT_MINUS_ONE : QDOT_ONE;
}

/* Write erf or erfc with its derivative, from which their Taylor series are made. */
static qdot_value
write_error_function(lowering *l, qdot_fun_id f, qdot_value x)
{
    qdot_expr over =
        qdot_mul(l->pool, qdot_expr_int(l->pool, f == QDOT_ERF ? 2 : -2),
                 qdot_pow(l->pool, QDOT_PI, qdot_expr_ratio(l->pool, -1, 2)));
    qdot_value square = write_operation(l, QDOT_OP_MUL, x, x);
    qdot_value e = write_operation(l, QDOT_OP_EXP, write_operation(l, QDOT_OP_NEG, square, 0), 0);

    return write_operation(l, f == QDOT_ERF ? QDOT_OP_ERF : QDOT_OP_ERFC, x,
                           write_operation(l, QDOT_OP_MUL, e, qdot_code_constant(&l->code, over)));
}

/* Write log(1 + e^d) with its derivative (1 + tanh(d/2))/2; log(1 + e^-d) shares the same tanh. */
static qdot_value
write_softplus(lowering *l, qdot_expr d)
{
    const known *k = l->known + qdot_walk_index(&l->walk, d);
    const bool minus = qdot_expr_is_negative(l->pool, k->factor);
    qdot_expr half = qdot_mul(l->pool, QDOT_HALF, minus ? qdot_neg(l->pool, k->factor) : k->factor);
    qdot_value x = k->bare, one_half = qdot_code_constant(&l->code, QDOT_HALF), y;

    if (half != QDOT_ONE)
        x = write_operation(l, QDOT_OP_MUL, x, qdot_code_constant(&l->code, half));
    y = write_operation(l, QDOT_OP_MUL, write_operation(l, QDOT_OP_TANH, x, 0), one_half);
    y = write_operation(l, minus ? QDOT_OP_SUB : QDOT_OP_ADD, one_half, y);
    return write_operation(l, QDOT_OP_SOFTPLUS, value_of_node(l, d), y);
}

static qdot_status
compile_elliptic(lowering *l, qdot_expr e, qdot_fun_id f, known *k)
{
    const uint32_t n = qdot_expr_count(l->pool, e);
    qdot_value x[3] = {0};

    for (uint32_t i = 0; i < n && i < 3; i++)
        x[i] = value_of_node(l, qdot_expr_arg(l->pool, e, i));
    if (qdot_code_elliptic(&l->code, f, n, x, &k->bare))
        return QDOT_OK;
    return qdot_fail(QDOT_ENOTBUILT, "not built yet: %s of %u arguments in the numbers of a run or a figure",
                     qdot_fun_name(f), (unsigned)n);
}

static qdot_status
compile_function(lowering *l, qdot_expr e, known *k)
{
    qdot_fun_id f = (qdot_fun_id)qdot_expr_node(l->pool, e)->op;
    qdot_expr x = qdot_expr_arg(l->pool, e, 0), d;
    qdot_value s, c;

    if (f == QDOT_HOLD) {
        compile_hold(l, x, k);
        return QDOT_OK;
    }
    if (f == QDOT_LOOKUP) {
        k->bare = qdot_code_op(&l->code, QDOT_OP_LOOKUP, value_of_node(l, x), qdot_code_constant(&l->code, QDOT_ZERO),
                               value_of_node(l, qdot_expr_arg(l->pool, e, 1)));
        return QDOT_OK;
    }
    d = qdot_logistic_argument(l->pool, e);
    if (d != QDOT_NIL && !qdot_expr_is_constant(l->pool, d)) {
        k->bare = write_softplus(l, d);
        return QDOT_OK;
    }
    if (direct[f] == QDOT_OP_SELECT) {
        k->bare = qdot_code_op(&l->code, QDOT_OP_SELECT, value_of_node(l, x),
                               value_of_node(l, qdot_expr_arg(l->pool, e, 1)),
                               value_of_node(l, qdot_expr_arg(l->pool, e, 2)));
        return QDOT_OK;
    }
    if (direct[f] != QDOT_OP_NONE) {
        k->bare = qdot_operations[direct[f]].operands == 1
                      ? write_operation(l, direct[f], value_of_node(l, x), 0)
                      : write_left_to_right(l, direct[f], e);
        return QDOT_OK;
    }
    if (f == QDOT_ERF || f == QDOT_ERFC) {
        k->bare = write_error_function(l, f, value_of_node(l, x));
        return QDOT_OK;
    }
    switch ((int)f) {
    case QDOT_SIN:
    case QDOT_COS:
    case QDOT_TAN:
    case QDOT_SEC:
    case QDOT_CSC:
    case QDOT_COT:
        break;
    default: return compile_elliptic(l, e, f, k);
    }
    qdot_angles_pair(l->angles, &l->walk, &l->code, x, &s, &c);
    if (f == QDOT_SIN || f == QDOT_COS)
        k->bare = f == QDOT_SIN ? s : c;
    else if (f == QDOT_TAN || f == QDOT_COT)
        k->bare = write_operation(l, QDOT_OP_DIV, f == QDOT_TAN ? s : c, f == QDOT_TAN ? c : s);
    else
        k->bare = write_operation(l, QDOT_OP_DIV, qdot_code_constant(&l->code, QDOT_ONE),
                                  f == QDOT_SEC ? c : s);
    return QDOT_OK;
}

static qdot_status
compile_node(lowering *l, size_t i)
{
    static const qdot_op relations[] = {
        [QDOT_EQ] = QDOT_OP_EQ, [QDOT_LT] = QDOT_OP_LT, [QDOT_LE] = QDOT_OP_LE};
    static const qdot_op logics[] = {
        [QDOT_AND] = QDOT_OP_AND, [QDOT_OR] = QDOT_OP_OR, [QDOT_NOT] = QDOT_OP_NOT};
    qdot_expr e = l->walk.at[i];
    const qdot_node *node = qdot_expr_node(l->pool, e);
    known *k = l->known + i;

    k->factor = QDOT_ONE;
    switch ((qdot_kind)node->kind) {
    case QDOT_NUM:
        return QDOT_OK;
    case QDOT_SYM:
    case QDOT_UFUN: /* user functions cannot occur here: they were refused at the start */
        return qdot_constant_unset(l->pool, e);
    case QDOT_SUM:
        return compile_sum(l, e, k);
    case QDOT_PROD:
        return compile_product(l, e, k);
    case QDOT_FUN:
        return compile_function(l, e, k);
    case QDOT_INTEGRAL:
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: an integral in the numbers of a run or a figure");
    case QDOT_REL:
        k->bare = write_left_to_right(l, relations[node->op], e);
        return QDOT_OK;
    case QDOT_LOGIC:
        k->bare = node->op == QDOT_NOT
                      ? write_operation(l, QDOT_OP_NOT, value_of_node(l, qdot_expr_arg(l->pool, e, 0)), 0)
                      : write_left_to_right(l, logics[node->op], e);
        return QDOT_OK;
    case QDOT_VEC:
    case QDOT_MAT:
    case QDOT_LIST:
        break;
    }
    return qdot_fail(QDOT_ETYPE, "a number belongs here, not a vector, matrix or list");
}

/* The value of a node including its constant factor. */
static qdot_value
value_with_factor(lowering *l, const known *k)
{
    bool minus = qdot_expr_is_negative(l->pool, k->factor);
    qdot_expr magnitude = minus ? qdot_neg(l->pool, k->factor) : k->factor;
    qdot_value v = k->bare;

    if (magnitude != QDOT_ONE)
        return write_operation(l, QDOT_OP_MUL, v, qdot_code_constant(&l->code, k->factor));
    return minus ? write_operation(l, QDOT_OP_NEG, v, 0) : v;
}

/* Refuse symbols and functions that are not inputs of the tape; the message lists all of them. */
static qdot_status
refuse_unknown_symbols(lowering *l)
{
    qdot_vec(qdot_expr) unset = {0};
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < l->walk.n && status == QDOT_OK; i++) {
        qdot_expr e = l->walk.at[i];
        qdot_kind kind = qdot_expr_kind(l->pool, e);

        if ((kind == QDOT_SYM || kind == QDOT_UFUN) && !(qdot_walk_get(&l->walk, e) >> 32) &&
            !qdot_expr_is_constant(l->pool, e))
            status = qdot_vec_push(&unset, e);
    }
    if (status == QDOT_OK)
        status = qdot_constant_unset_all(l->pool, unset.n, unset.at);
    qdot_free(unset.at);
    return status;
}

static qdot_status
compile_nodes(lowering *l, size_t n, const qdot_expr *inputs)
{
    count_negative_powers(l);
    for (size_t i = 0; i < n; i++) {
        size_t at = qdot_walk_index(&l->walk, inputs[i]);

        if (at != SIZE_MAX) {
            l->known[at].bare = (qdot_value)i;
            l->known[at].factor = QDOT_ONE;
            qdot_walk_set(&l->walk, inputs[i], (1ull << 32) | i);
        }
    }
    QDOT_TRY(refuse_unknown_symbols(l));
    for (size_t i = 0; i < l->walk.n; i++) {
        qdot_expr e = l->walk.at[i];

        if (qdot_walk_get(&l->walk, e) >> 32 || qdot_expr_is_constant(l->pool, e))
            continue;
        QDOT_TRY(compile_node(l, i));
        qdot_walk_set(&l->walk, e, value_with_factor(l, l->known + i));
        QDOT_TRY(l->code.status);
    }
    return qdot_pool_check(l->pool);
}

static qdot_status
compile_outputs(lowering *l, size_t n, const qdot_expr *inputs, size_t m, const qdot_expr *outputs,
                qdot_tape **tape)
{
    qdot_value *results = qdot_malloc(m * sizeof *results);
    qdot_status status = results ? QDOT_OK : QDOT_ENOMEM;

    l->known = qdot_calloc(l->walk.n + 1, sizeof *l->known);
    if (status == QDOT_OK && !l->known)
        status = QDOT_ENOMEM;
    if (status == QDOT_OK)
        status = qdot_angles_new(l->pool, &l->walk, l->series, &l->angles);
    if (status == QDOT_OK)
        status = compile_nodes(l, n, inputs);
    if (status == QDOT_OK) {
        for (size_t i = 0; i < m; i++)
            results[i] = value_of_node(l, outputs[i]);
        status = qdot_code_finish(&l->code, m, results, tape);
    }
    qdot_free(results);
    return status;
}

/* Rewrite the outputs [m], into *finite (owned), so that quotients of exponentials do not overflow; walk these. */
static qdot_status
rewrite_quotients(lowering *l, size_t m, const qdot_expr *outputs, qdot_expr **finite)
{
    qdot_expr all = qdot_logistic_form(l->pool, qdot_list(l->pool, (uint32_t)m, outputs));

    qdot_walk_end(&l->walk);
    QDOT_TRY(qdot_pool_check(l->pool));
    *finite = qdot_malloc(m * sizeof **finite);
    if (!*finite)
        return QDOT_ENOMEM;
    memcpy(*finite, qdot_expr_args(l->pool, all), m * sizeof **finite);
    return qdot_walk_begin_by_height(l->pool, m, *finite, &l->walk);
}

static qdot_status
make_tape(qdot_pool *pool, bool series, size_t n, const qdot_expr *inputs, size_t m,
          const qdot_expr *outputs, qdot_tape **tape)
{
    lowering l = {.pool = pool, .series = series};
    qdot_expr *finite = NULL;
    qdot_status status;

    *tape = NULL;
    QDOT_TRY(qdot_pool_check(pool));
    for (size_t i = 0; i < n; i++)
        if (inputs[i] == QDOT_NIL || qdot_expr_kind(pool, inputs[i]) != QDOT_SYM)
            return qdot_fail(QDOT_EINVAL, "the inputs of a tape are symbols");
    for (size_t i = 0; i < m; i++)
        if (outputs[i] == QDOT_NIL)
            return qdot_fail(QDOT_EINVAL, "no expression to evaluate");
    QDOT_TRY(qdot_walk_begin_by_height(pool, m, outputs, &l.walk));
    if (qdot_logistic_occurs(&l.walk)) {
        status = rewrite_quotients(&l, m, outputs, &finite);
        if (status != QDOT_OK) {
            qdot_free(finite);
            return status;
        }
        outputs = finite;
    }
    qdot_code_init(&l.code, pool, n);
    status = compile_outputs(&l, n, inputs, m, outputs, tape);
    qdot_free(finite);
    qdot_code_clear(&l.code);
    qdot_angles_free(l.angles);
    qdot_free(l.known);
    qdot_free(l.terms.at);
    qdot_free(l.groups.at);
    qdot_keymap_clear(&l.by_magnitude);
    qdot_walk_end(&l.walk);
    return status;
}

qdot_status
qdot_tape_new(qdot_pool *pool, size_t n, const qdot_expr *inputs, size_t m,
              const qdot_expr *outputs, qdot_tape **tape)
{
    return make_tape(pool, false, n, inputs, m, outputs, tape);
}

qdot_status
qdot_tape_new_for_series(qdot_pool *pool, size_t n, const qdot_expr *inputs, size_t m,
                         const qdot_expr *outputs, qdot_tape **tape)
{
    return make_tape(pool, true, n, inputs, m, outputs, tape);
}
