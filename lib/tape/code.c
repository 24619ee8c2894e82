/* code.c -- writes the code of a tape: reuses equal values, collects constants, computes powers by products. */
#include "tape/code.h"

#include <string.h>

#include "expr/constant.h"
#include "expr/exact.h"

const qdot_operation qdot_operations[QDOT_OP_COUNT] = {
#define X(ID, name, operands, operations, calls, statement, ...)                         \
    [QDOT_OP_##ID] = {name, operands, operations, calls},
#include "tape/operation.def"
#undef X
};

static qdot_value
code_append(qdot_code *code, qdot_op op, qdot_value a, qdot_value b, qdot_value c)
{
    qdot_code_value v = {op, a, b, c};

    if (code->status != QDOT_OK)
        return 0;
    if (code->values.n >= UINT32_MAX - 2) {
        code->status = qdot_fail(QDOT_ELIMIT, "too many operations");
        return 0;
    }
    code->status = qdot_vec_push(&code->values, v);
    return code->status == QDOT_OK ? (qdot_value)(code->values.n - 1) : 0;
}

/* chain[n]: a factor f, x^n = (x^f)^(n/f), or 0, x^n = x^(n-1) x, whichever takes the
 * fewest multiplications. Knuth, TAOCP 2, 4.6.3: the factor method. */
static void
find_power_products(unsigned char chain[QDOT_CODE_MOST_POWER + 1])
{
    unsigned char cost[QDOT_CODE_MOST_POWER + 1] = {0};

    for (int n = 2; n <= QDOT_CODE_MOST_POWER; n++) {
        cost[n] = cost[n - 1] + 1;
        chain[n] = 0;
        for (int f = 2; f * f <= n; f++)
            if (n % f == 0 && cost[f] + cost[n / f] <= cost[n]) {
                cost[n] = cost[f] + cost[n / f];
                chain[n] = (unsigned char)f;
            }
    }
}

void
qdot_code_init(qdot_code *code, qdot_pool *pool, size_t inputs)
{
    memset(code, 0, sizeof *code);
    code->pool = pool;
    code->inputs = inputs;
    find_power_products(code->chain);
    for (size_t i = 0; i < inputs; i++)
        code_append(code, QDOT_OP_INPUT, (qdot_value)i, 0, 0);
}

void
qdot_code_clear(qdot_code *code)
{
    qdot_free(code->values.at);
    qdot_free(code->constants.at);
    qdot_free(code->sides.at);
    qdot_free(code->lows.at);
    qdot_free(code->exact.at);
    qdot_keymap_clear(&code->seen);
    qdot_keymap_clear(&code->by_expr);
}

qdot_value
qdot_code_op(qdot_code *code, qdot_op op, qdot_value a, qdot_value b, qdot_value c)
{
    uint32_t value;

    if (code->status != QDOT_OK)
        return 0;
    if ((op == QDOT_OP_ADD || op == QDOT_OP_MUL || op == QDOT_OP_EQ) && b < a) {
        qdot_value swap = a;

        a = b;
        b = swap;
    }
    if (op == QDOT_OP_NEG && code->values.at[a].op == QDOT_OP_NEG)
        return code->values.at[a].a;
    value = qdot_keymap_get(&code->seen, op, a, b, c);
    if (value != QDOT_KEYMAP_NONE)
        return value;
    value = code_append(code, op, a, b, c);
    if (code->status == QDOT_OK)
        code->status = qdot_keymap_set(&code->seen, op, a, b, c, value);
    return value;
}

qdot_value
qdot_code_constant(qdot_code *code, qdot_expr e)
{
    uint32_t value;
    double x, low;
    int side;

    if (code->status != QDOT_OK)
        return 0;
    value = qdot_keymap_get(&code->by_expr, e, 0, 0, 0);
    if (value != QDOT_KEYMAP_NONE)
        return value;
    code->status = qdot_constant_split(code->pool, e, &x, &side, &low);
    if (code->status == QDOT_OK)
        code->status = qdot_vec_push(&code->constants, x);
    if (code->status == QDOT_OK)
        code->status = qdot_vec_push(&code->sides, (signed char)side);
    if (code->status == QDOT_OK)
        code->status = qdot_vec_push(&code->lows, low);
    if (code->status == QDOT_OK)
        code->status = qdot_vec_push(&code->exact, e);
    if (code->status != QDOT_OK)
        return 0;
    value = code_append(code, QDOT_OP_CONSTANT, (qdot_value)(code->constants.n - 1), 0, 0);
    if (code->status == QDOT_OK)
        code->status = qdot_keymap_set(&code->by_expr, e, 0, 0, 0, value);
    return value;
}

void
qdot_code_sincos(qdot_code *code, qdot_value a, qdot_value *sine, qdot_value *cosine)
{
    *sine = qdot_code_op(code, QDOT_OP_SINCOS, a, 0, 0);
    *cosine = qdot_code_op(code, QDOT_OP_SECOND, *sine, 0, 0);
}

qdot_value
qdot_code_power(qdot_code *code, qdot_value a, int64_t n)
{
    const unsigned char *chain = code->chain;
    struct {
        int power;        /* the value is raised to this power; 0: none */
        qdot_value times; /* the factor by which the result is multiplied */
    } todo[2 * QDOT_CODE_MOST_POWER];
    int depth = 0;

    if (n < 0) {
        a = qdot_code_op(code, QDOT_OP_DIV, qdot_code_constant(code, QDOT_ONE), a, 0);
        n = -n;
    }
    if (n > QDOT_CODE_MOST_POWER)
        return qdot_code_op(code, QDOT_OP_POW, a,
                            qdot_code_constant(code, qdot_expr_int(code->pool, n)), 0);
    todo[depth++].power = (int)n;
    while (depth > 0) {
        int k = todo[--depth].power;

        if (k == 0)
            a = qdot_code_op(code, QDOT_OP_MUL, a, todo[depth].times, 0);
        else if (k > 1 && chain[k]) {
            todo[depth++].power = k / chain[k];
            todo[depth++].power = chain[k];
        } else if (k > 1) {
            todo[depth].power = 0;
            todo[depth++].times = a;
            todo[depth++].power = k - 1;
        }
    }
    return a;
}
