/* kit.h -- scenes of the tests: expressions read from text, statements by the scene's
 * adders.
 *
 * The reader is the tests' own (numbers, names with ' and [..], + - * / ^, functions,
 * vectors and undefined functions), so that mech is tested without the language above it.
 */
#ifndef QDOT_TEST_MECH_KIT_H
#define QDOT_TEST_MECH_KIT_H

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "mech/scene/scene.h"
#include "normal/prove/decide.h"

typedef struct {
    qdot_pool *pool;
    qdot_scene *scene;
    const char *at; /* of the reader */
    struct {
        char name[32];
        uint32_t id, arity;
        qdot_expr formals[4];
    } ufun[8];
    size_t ufuns;
} kit;

static inline void
must(qdot_status status)
{
    if (status != QDOT_OK)
        fail_msg("status %d: %s", (int)status, qdot_last_error()->message);
}

static inline void
kit_open(kit *k)
{
    *k = (kit){0};
    k->pool = qdot_pool_new();
    assert_non_null(k->pool);
    k->scene = qdot_scene_new(k->pool);
    assert_non_null(k->scene);
}

static inline void
kit_close(kit *k)
{
    qdot_scene_free(k->scene);
    qdot_pool_free(k->pool);
}

/* What the scene answered is the status `want` with these words in its message; the pool is as before. */
static inline void
refused(kit *k, qdot_status got, qdot_status want, const char *words)
{
    assert_int_equal(got, want);
    if (!strstr(qdot_last_error()->message, words))
        fail_msg("said: %s", qdot_last_error()->message);
    must(qdot_pool_check(k->pool));
}

/* angle nil in space, rotation nil in the plane */
static inline qdot_status
declare_body(qdot_scene *s, const char *name, qdot_expr mass, qdot_expr inertia, qdot_expr about,
         qdot_expr position, qdot_expr angle, qdot_expr rotation)
{
    const qdot_body body = {.mass = mass,
                            .inertia = inertia,
                            .position = position,
                            .angle = angle,
                            .rotation = rotation};

    return qdot_scene_body(s, name, &body, about);
}

static qdot_expr kit_sum(kit *k);

static inline void
kit_blank(kit *k)
{
    while (*k->at == ' ')
        k->at++;
}

static inline bool
kit_eat(kit *k, char c)
{
    kit_blank(k);
    if (*k->at != c)
        return false;
    k->at++;
    return true;
}

/* A name, its arguments or primes. */
static inline qdot_expr
kit_name(kit *k)
{
    char name[64];
    size_t n = 0;
    uint32_t count = 0, primes = 0;
    qdot_expr arg[4], e;
    qdot_fun_id id;

    while (isalnum((unsigned char)*k->at) || *k->at == '_')
        name[n++] = *k->at++;
    if (*k->at == '[')
        do
            name[n++] = *k->at;
        while (*k->at++ != ']');
    name[n] = '\0';
    if (*k->at == '(') {
        k->at++;
        do
            arg[count++] = kit_sum(k);
        while (kit_eat(k, ','));
        assert_true(kit_eat(k, ')'));
        if (strcmp(name, "sqrt") == 0)
            return qdot_sqrt(k->pool, arg[0]);
        if (strcmp(name, "diff") == 0)
            return qdot_diff(k->pool, arg[0], arg[1]);
        if (strcmp(name, "dot") == 0)
            return qdot_dot(k->pool, arg[0], arg[1]);
        for (size_t u = 0; u < k->ufuns; u++)
            if (strcmp(k->ufun[u].name, name) == 0)
                return qdot_ufun_apply(k->pool, k->ufun[u].id, arg, NULL);
        assert_true(qdot_fun_find(name, &id));
        return qdot_fun(k->pool, id, count, arg);
    }
    for (; *k->at == '\''; k->at++)
        primes++;
    if (strcmp(name, "t") == 0)
        return QDOT_T;
    if (strcmp(name, "pi") == 0)
        return QDOT_PI;
    if (strncmp(name, "lambda[", 7) == 0)
        return qdot_symbol_get(k->pool, QDOT_MULTIPLIER, name);
    for (size_t i = 0; i < k->scene->coordinates.n; i++) {
        qdot_expr q = k->scene->coordinates.at[i];
        const char *text = qdot_expr_symbol(k->pool, q)->name;

        if (strcmp(text, name) == 0)
            return qdot_symbol_jet(k->pool, q, primes);
        if (name[0] == 'd' && strcmp(text, name + 1) == 0)
            return qdot_symbol_of(k->pool, QDOT_DIFFERENTIAL, q);
        if (strncmp(name, "delta_", 6) == 0 && strcmp(text, name + 6) == 0)
            return qdot_symbol_of(k->pool, QDOT_DELTA, q);
    }
    if (strcmp(name, "dt") == 0)
        return qdot_symbol_of(k->pool, QDOT_DIFFERENTIAL, QDOT_T);
    assert_int_equal(primes, 0);
    e = qdot_symbol_get(k->pool, QDOT_PARAM, name);
    if (!qdot_expr_symbol(k->pool, e)->lo)
        qdot_symbol_domain(k->pool, e, QDOT_ZERO, true, QDOT_NIL, false);
    return e;
}

static inline qdot_expr
kit_atom(kit *k)
{
    qdot_expr e[9];
    uint32_t n = 0;
    size_t length;

    kit_blank(k);
    if (kit_eat(k, '(')) {
        do
            e[n++] = kit_sum(k);
        while (kit_eat(k, ','));
        if (!kit_eat(k, ')'))
            fail_msg("no ) before: %s", k->at);
        return n == 1 ? e[0] : qdot_vector(k->pool, n, e);
    }
    if (isdigit((unsigned char)*k->at)) {
        length = strspn(k->at, "0123456789.");
        k->at += length;
        return qdot_expr_decimal(k->pool, k->at - length, length);
    }
    return kit_name(k);
}

static inline qdot_expr
kit_power(kit *k)
{
    qdot_expr base = kit_atom(k);

    if (!kit_eat(k, '^'))
        return base;
    if (kit_eat(k, '-'))
        return qdot_value_pow(k->pool, base, qdot_neg(k->pool, kit_power(k)));
    return qdot_value_pow(k->pool, base, kit_power(k));
}

static inline qdot_expr
kit_product(kit *k)
{
    qdot_expr e;

    if (kit_eat(k, '-'))
        return qdot_value_neg(k->pool, kit_product(k));
    e = kit_power(k);
    for (;;) {
        if (kit_eat(k, '*'))
            e = qdot_value_mul(k->pool, e, kit_power(k));
        else if (kit_eat(k, '/'))
            e = qdot_value_div(k->pool, e, kit_power(k));
        else
            return e;
    }
}

static qdot_expr
kit_sum(kit *k)
{
    qdot_expr e = kit_product(k);

    for (;;) {
        if (kit_eat(k, '+'))
            e = qdot_value_add(k->pool, e, kit_product(k));
        else if (kit_eat(k, '-'))
            e = qdot_value_sub(k->pool, e, kit_product(k));
        else
            return e;
    }
}

/* The expression written in `text` (a printf format). */
static inline qdot_expr QDOT_PRINTF(2, 3) E(kit *k, const char *format, ...)
{
    char text[4096];
    const char *before = k->at;
    va_list args;
    qdot_expr e;

    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    k->at = text;
    e = kit_sum(k);
    kit_blank(k);
    if (*k->at)
        fail_msg("cannot read: %s", k->at);
    k->at = before;
    must(qdot_pool_check(k->pool));
    return e;
}

/* Coordinates, separated by blanks; "r>0" declares a sign. */
static inline void
coords(kit *k, const char *names)
{
    char name[32];
    int length;

    for (; sscanf(names, " %31s%n", name, &length) == 1; names += length) {
        char *sign = strchr(name, '>');
        qdot_expr q;

        if (sign)
            *sign = '\0';
        q = qdot_symbol_get(k->pool, QDOT_COORD, name);
        if (sign)
            qdot_symbol_domain(k->pool, q, QDOT_ZERO, true, QDOT_NIL, false);
        must(qdot_scene_coordinate(k->scene, q));
    }
}

/* An undefined function of the named symbols, separated by commas. */
static inline void
function(kit *k, const char *name, const char *formals)
{
    qdot_expr list = E(k, "(%s, 0)", formals); /* always a vector */
    uint32_t n = qdot_expr_count(k->pool, list) - 1;

    for (uint32_t i = 0; i < n; i++)
        k->ufun[k->ufuns].formals[i] = qdot_expr_arg(k->pool, list, i);
    snprintf(k->ufun[k->ufuns].name, sizeof k->ufun[0].name, "%s", name);
    must(qdot_ufun_declare(k->pool, name, n, k->ufun[k->ufuns].formals,
                           &k->ufun[k->ufuns].id));
    k->ufuns++;
}

static inline void
particle(kit *k, const char *name, const char *mass, const char *position)
{
    qdot_expr m = E(k, "%s", mass);

    must(qdot_scene_particle(k->scene, name, m, E(k, "%s", position)));
}

static inline void
gravity(kit *k, const char *field)
{
    must(qdot_scene_gravity(k->scene, E(k, "%s", field)));
}

static inline void
force(kit *k, const char *F, const char *point)
{
    qdot_force f = {.force = E(k, "%s", F), .point = E(k, "%s", point)};

    must(qdot_scene_force(k->scene, &f));
}

static inline void
torque(kit *k, const char *tau, const char *coordinate)
{
    qdot_torque t = {.torque = E(k, "%s", tau), .coordinate = E(k, "%s", coordinate)};

    must(qdot_scene_torque(k->scene, &t));
}

static inline void
constraint(kit *k, const char *label, const char *left, const char *right)
{
    must(qdot_scene_constraint(k->scene, label, E(k, "%s", left), E(k, "%s", right)));
}

static inline void
assume(kit *k, const char *left, const char *right)
{
    must(qdot_scene_assume(
        k->scene, qdot_rel(k->pool, QDOT_EQ, E(k, "%s", left), E(k, "%s", right)), false));
}

/* e, shown when a test fails. */
static inline const char *
show(kit *k, qdot_expr e)
{
    static qdot_text text[4];
    static int next;
    qdot_text *out = &text[next++ % 4];

    qdot_text_clear(out);
    if (e == QDOT_NIL)
        return "nil";
    must(qdot_print(k->pool, e, QDOT_PLAIN, out));
    return qdot_text_str(out);
}

static inline void
same_at(kit *k, qdot_expr got, qdot_expr want, int line)
{
    qdot_decision seen;
    qdot_facts facts = qdot_scene_facts(k->scene);

    must(qdot_pool_check(k->pool));
    must(qdot_decide_equal(k->pool, got, want, &facts, &seen));
    if (seen.verdict != QDOT_PROVED)
        fail_msg("line %d: %s: %s, want %s", line,
                 seen.verdict == QDOT_REFUTED ? "refuted" : "undecided", show(k, got),
                 show(k, want));
}

/* Proved equal to what is written. */
#define SAME(k, got, ...) same_at(k, got, E(k, __VA_ARGS__), __LINE__)
/* Printed so. */
#define READS(k, got, text) assert_string_equal(show(k, got), text)

static inline qdot_expr
lhs(kit *k, qdot_expr equation)
{
    must(qdot_pool_check(k->pool));
    assert_int_equal(qdot_expr_kind(k->pool, equation), QDOT_REL);
    return qdot_expr_arg(k->pool, equation, 0);
}

static inline qdot_expr
rhs(kit *k, qdot_expr equation)
{
    must(qdot_pool_check(k->pool));
    return qdot_expr_arg(k->pool, equation, 1);
}

/* name_body(kit *) as a test with a kit of its own. */
#define TEST(name)                                                                       \
    static void name(void **state_)                                                      \
    {                                                                                    \
        kit k_, *k = &k_;                                                                \
        (void)state_;                                                                    \
        kit_open(k);                                                                     \
        name##_body(k);                                                                  \
        must(qdot_pool_check(k->pool));                                                  \
        kit_close(k);                                                                    \
    }

static inline void
symbolic_double_pendulum(kit *k)
{
    coords(k, "theta1 theta2");
    particle(k, "a", "m1", "(L1*sin(theta1), -L1*cos(theta1))");
    particle(k, "b", "m2",
             "(L1*sin(theta1) + L2*sin(theta2), -L1*cos(theta1) - L2*cos(theta2))");
    gravity(k, "(0, -g)");
}

#endif
