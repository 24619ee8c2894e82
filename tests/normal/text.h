/* text.h -- expressions for the tests of this floor, from text: the arithmetic of the
 * language with a fixed set of names.
 *
 * params   m m1 m2 L L1 L2 g a b > 0; p k c e without a sign coords   r rho > 0, 0 <
 * theta < pi, phi theta1 theta2 psi x y z u v w without bounds, s t; dNAME; lam (a
 * multiplier); f(s), h(s), f'(s), f''(s): undefined functions
 */
#ifndef QDOT_TESTS_NORMAL_TEXT_H
#define QDOT_TESTS_NORMAL_TEXT_H

#include <ctype.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "expr/expr.h"
#include "expr/print.h"

typedef struct {
    qdot_pool *pool;
    const char *at;
    uint32_t f, h;
} text;

static qdot_expr text_sum(text *s);

static qdot_expr
text_symbol(qdot_pool *pool, const char *name)
{
    static const char *const positive[] = {"m",  "m1", "m2", "L", "L1",
                                           "L2", "g",  "a",  "b"};
    static const char *const params[] = {"p", "k", "c", "e"};
    qdot_expr x;

    if (strcmp(name, "pi") == 0)
        return QDOT_PI;
    if (strcmp(name, "t") == 0)
        return QDOT_T;
    if (strcmp(name, "lam") == 0)
        return qdot_symbol_get(pool, QDOT_MULTIPLIER, "lambda[rod]");
    for (size_t i = 0; i < sizeof positive / sizeof *positive; i++)
        if (strcmp(name, positive[i]) == 0) {
            x = qdot_symbol_get(pool, QDOT_PARAM, name);
            qdot_symbol_domain(pool, x, QDOT_ZERO, true, QDOT_NIL, false);
            return x;
        }
    for (size_t i = 0; i < sizeof params / sizeof *params; i++)
        if (strcmp(name, params[i]) == 0)
            return qdot_symbol_get(pool, QDOT_PARAM, name);
    if (name[0] == 'd' && name[1] != '\0')
        return qdot_symbol_of(pool, QDOT_DIFFERENTIAL, text_symbol(pool, name + 1));
    x = qdot_symbol_get(pool, QDOT_COORD, name);
    if (strcmp(name, "r") == 0 || strcmp(name, "rho") == 0)
        qdot_symbol_domain(pool, x, QDOT_ZERO, true, QDOT_NIL, false);
    if (strcmp(name, "theta") == 0)
        qdot_symbol_domain(pool, x, QDOT_ZERO, true, QDOT_PI, true);
    return x;
}

static void
text_blank(text *s)
{
    while (*s->at == ' ')
        s->at++;
}

static qdot_expr
text_primary(text *s)
{
    char name[32];
    size_t n = 0;
    uint32_t primes = 0;
    qdot_expr args[4], x;
    qdot_fun_id id;

    text_blank(s);
    if (*s->at == '(') {
        s->at++;
        x = text_sum(s);
        text_blank(s);
        s->at++;
        return x;
    }
    if (isdigit((unsigned char)*s->at)) {
        const char *start = s->at;

        while (isdigit((unsigned char)*s->at) || *s->at == '.')
            s->at++;
        if (*s->at == 'e' && s->at[1] == '-') {
            s->at += 2;
            while (isdigit((unsigned char)*s->at))
                s->at++;
        }
        return qdot_expr_decimal(s->pool, start, (size_t)(s->at - start));
    }
    while (isalnum((unsigned char)*s->at) && n + 1 < sizeof name)
        name[n++] = *s->at++;
    name[n] = '\0';
    if (n == 0) {
        fprintf(stderr, "not understood: %s\n", s->at);
        abort();
    }
    while (*s->at == '\'') {
        primes++;
        s->at++;
    }
    if (*s->at != '(') {
        x = text_symbol(s->pool, name);
        return primes > 0 ? qdot_symbol_jet(s->pool, x, primes) : x;
    }
    n = 0;
    do {
        s->at++;
        args[n++] = text_sum(s);
        text_blank(s);
    } while (*s->at == ',');
    s->at++;
    if (strcmp(name, "sqrt") == 0)
        return qdot_sqrt(s->pool, args[0]);
    if (strcmp(name, "f") == 0 || strcmp(name, "h") == 0)
        return qdot_ufun_apply(s->pool, *name == 'f' ? s->f : s->h, args, &primes);
    if (!qdot_fun_find(name, &id)) {
        fprintf(stderr, "no function %s\n", name);
        abort();
    }
    return qdot_fun(s->pool, id, (uint32_t)n, args);
}

static qdot_expr
text_power(text *s)
{
    qdot_expr x;

    text_blank(s);
    if (*s->at == '-') {
        s->at++;
        return qdot_neg(s->pool, text_power(s));
    }
    x = text_primary(s);
    text_blank(s);
    if (*s->at == '^') {
        s->at++;
        x = qdot_pow(s->pool, x, text_power(s));
    }
    return x;
}

static qdot_expr
text_product(text *s)
{
    qdot_expr x;

    text_blank(s);
    if (*s->at == '-') { /* weaker than a product */
        s->at++;
        return qdot_neg(s->pool, text_product(s));
    }
    x = text_power(s);
    for (;;) {
        text_blank(s);
        if (*s->at == '*') {
            s->at++;
            x = qdot_mul(s->pool, x, text_power(s));
        } else if (*s->at == '/') {
            s->at++;
            x = qdot_div(s->pool, x, text_power(s));
        } else {
            return x;
        }
    }
}

static qdot_expr
text_sum(text *s)
{
    qdot_expr x = text_product(s);

    for (;;) {
        text_blank(s);
        if (*s->at == '+') {
            s->at++;
            x = qdot_add(s->pool, x, text_product(s));
        } else if (*s->at == '-') {
            s->at++;
            x = qdot_sub(s->pool, x, text_product(s));
        } else {
            return x;
        }
    }
}

/* The expression that a text says. */
static inline qdot_expr
text_read(qdot_pool *pool, const char *at)
{
    text s = {.pool = pool, .at = at};
    qdot_expr formal = qdot_symbol_get(pool, QDOT_COORD, "s"), x;

    if (qdot_ufun_declare(pool, "f", 1, &formal, &s.f) != QDOT_OK ||
        qdot_ufun_declare(pool, "h", 1, &formal, &s.h) != QDOT_OK)
        abort();
    x = text_sum(&s);
    if (*s.at != '\0') {
        fprintf(stderr, "left over: %s\n", s.at);
        abort();
    }
    return x;
}

/* Its text; to be freed. */
static inline char *
text_write(const qdot_pool *pool, qdot_expr e)
{
    qdot_text out = {0};

    if (e == QDOT_NIL)
        return strdup("nil");
    if (qdot_print(pool, e, QDOT_PLAIN, &out) != QDOT_OK)
        abort();
    return out.at;
}

#endif
