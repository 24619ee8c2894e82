/* reader.h -- plain text back to an expression: a small reader of the language's formulas, apart
 * from the one of lang/, for what print.c writes.
 */
#ifndef TESTS_EXPR_READER_H
#define TESTS_EXPR_READER_H

#include <ctype.h>

#include "expr/spec.h"

typedef struct {
    qdot_pool *pool;
    const char *at;
    const qdot_expr *names; /* the symbols that may occur */
    size_t n_names;
    const uint32_t *functions; /* the undefined functions */
    size_t n_functions;
} reader;

static qdot_expr read_equation(reader *r);

static inline bool
accept(reader *r, const char *text)
{
    size_t n = strlen(text);

    while (*r->at == ' ')
        r->at++;
    if (strncmp(r->at, text, n) != 0)
        return false;
    r->at += n;
    return true;
}

static inline void
expect(reader *r, const char *text)
{
    if (!accept(r, text))
        fail_msg("%s expected before: %.40s", text, r->at);
}

/* a, b, c up to `close`. */
static inline uint32_t
read_list(reader *r, qdot_expr *args, const char *close)
{
    uint32_t n = 0;

    if (accept(r, close))
        return 0;
    do {
        assert_true(n < 64);
        args[n++] = read_equation(r);
    } while (accept(r, ","));
    expect(r, close);
    return n;
}

static inline qdot_expr
read_call(reader *r, const char *name, uint32_t primes)
{
    qdot_expr args[64], from[32], to[32];
    uint32_t n;
    qdot_fun_id id;

    n = read_list(r, args, ")");
    if (strcmp(name, "sqrt") == 0)
        return qdot_sqrt(r->pool, args[0]);
    if (strcmp(name, "diff") == 0) {
        int64_t times = 1;

        if (n == 3)
            assert_true(qdot_expr_to_int(r->pool, args[2], &times));
        for (; times > 0; times--)
            args[0] = qdot_diff(r->pool, args[0], args[1]);
        return args[0];
    }
    if (strcmp(name, "subs") == 0) {
        for (uint32_t i = 1; i < n; i++) {
            from[i - 1] = qdot_expr_arg(r->pool, args[i], 0);
            to[i - 1] = qdot_expr_arg(r->pool, args[i], 1);
        }
        return qdot_subs(r->pool, args[0], n - 1, from, to);
    }
    if (qdot_fun_find(name, &id))
        return qdot_fun(r->pool, id, n, args);
    for (size_t i = 0; i < r->n_functions; i++)
        if (strcmp(qdot_ufun_get(r->pool, r->functions[i])->name, name) == 0)
            return qdot_ufun_apply(r->pool, r->functions[i], args,
                                   primes > 0 ? &primes : NULL);
    fail_msg("no function %s", name);
    return QDOT_NIL;
}

static inline qdot_expr
read_name(reader *r)
{
    char name[64];
    size_t n = 0;
    uint32_t primes = 0;

    while (isalnum((unsigned char)*r->at) || *r->at == '_')
        name[n++] = *r->at++;
    if (*r->at == '[') {
        while (*r->at != ']')
            name[n++] = *r->at++;
        name[n++] = *r->at++;
    }
    for (; *r->at == '\''; r->at++)
        primes++;
    name[n] = '\0';
    if (*r->at == '(') {
        r->at++;
        return read_call(r, name, primes);
    }
    if (strcmp(name, "pi") == 0)
        return QDOT_PI;
    if (strcmp(name, "t") == 0)
        return QDOT_T;
    for (size_t i = 0; i < r->n_names; i++)
        if (strcmp(qdot_expr_symbol(r->pool, r->names[i])->name, name) == 0)
            return primes > 0 ? qdot_symbol_jet(r->pool, r->names[i], primes)
                              : r->names[i];
    fail_msg("no name %s", name);
    return QDOT_NIL;
}

static inline qdot_expr
read_operand(reader *r)
{
    const char *start;
    qdot_expr args[64];
    uint32_t n;

    if (accept(r, "(")) {
        n = read_list(r, args, ")");
        return n == 1 ? args[0] : qdot_vector(r->pool, n, args);
    }
    if (accept(r, "["))
        return qdot_list(r->pool, read_list(r, args, "]"), args);
    if (!isdigit((unsigned char)*r->at))
        return read_name(r);
    for (start = r->at; isdigit((unsigned char)*r->at) || *r->at == '.'; r->at++)
        ;
    if (*r->at == 'e' && r->at[1] == '-')
        for (r->at += 2; isdigit((unsigned char)*r->at); r->at++)
            ;
    return qdot_expr_decimal(r->pool, start, (size_t)(r->at - start));
}

/* Right-associative, above the unary minus on its left. */
static inline qdot_expr
read_power(reader *r)
{
    qdot_expr base = read_operand(r);

    if (!accept(r, "^"))
        return base;
    if (accept(r, "-"))
        return qdot_pow(r->pool, base, qdot_neg(r->pool, read_power(r)));
    return qdot_pow(r->pool, base, read_power(r));
}

static inline qdot_expr
read_signed(reader *r)
{
    bool minus = accept(r, "-");
    qdot_expr e = read_power(r);

    return minus ? qdot_neg(r->pool, e) : e;
}

/* A sign stands below * and /: -a*b is (-a)*b, which is the same. */
static inline qdot_expr
read_term(reader *r)
{
    qdot_expr e = read_signed(r);

    for (;;) {
        if (accept(r, "*"))
            e = qdot_value_mul(r->pool, e, read_signed(r));
        else if (accept(r, "/"))
            e = qdot_value_div(r->pool, e, read_signed(r));
        else
            return e;
    }
}

static inline qdot_expr
read_sum(reader *r)
{
    qdot_expr e = read_term(r);

    for (;;) {
        if (accept(r, "+"))
            e = qdot_value_add(r->pool, e, read_term(r));
        else if (accept(r, "-"))
            e = qdot_value_sub(r->pool, e, read_term(r));
        else
            return e;
    }
}

static qdot_expr
read_equation(reader *r)
{
    qdot_expr e = read_sum(r);

    if (accept(r, "<="))
        return qdot_rel(r->pool, QDOT_LE, e, read_sum(r));
    if (accept(r, "<"))
        return qdot_rel(r->pool, QDOT_LT, e, read_sum(r));
    if (accept(r, "="))
        return qdot_rel(r->pool, QDOT_EQ, e, read_sum(r));
    return e;
}

static inline qdot_expr
read_text(reader *r, const char *text)
{
    qdot_expr e;

    r->at = text;
    e = read_equation(r);
    if (*r->at != '\0')
        fail_msg("not read: %.40s", r->at);
    return e;
}

#endif
