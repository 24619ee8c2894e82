/* scenes.h -- small scenes built through the interface of mech, for the tests of sim. */
#ifndef QDOT_TESTS_SIM_SCENES_H
#define QDOT_TESTS_SIM_SCENES_H

#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "mech/dynamics/quantity.h"
#include "sim/run/run.h"

enum { MOST_COORDINATES = 8, MOST_VALUES = 32 };

/* A scene with what a run of it needs. */
typedef struct {
    qdot_pool *pool;
    qdot_scene *scene;
    qdot_expr q0[MOST_COORDINATES], v0[MOST_COORDINATES];
    qdot_expr symbols[MOST_VALUES], values[MOST_VALUES];
    qdot_run_request request;
} fixture;

#define must(call)                                                                       \
    do {                                                                                 \
        if ((call) != QDOT_OK)                                                           \
            fail_msg("%s: %s", #call, qdot_last_error()->message);                       \
    } while (0)

static inline qdot_expr
number(fixture *f, const char *decimal)
{
    bool minus = *decimal == '-';
    qdot_expr e = qdot_expr_decimal(f->pool, decimal + minus, strlen(decimal + minus));

    return minus ? qdot_neg(f->pool, e) : e;
}

static inline qdot_expr
parameter(fixture *f, const char *name)
{
    return qdot_symbol_get(f->pool, QDOT_PARAM, name);
}

static inline qdot_expr
coordinate(fixture *f, const char *name)
{
    qdot_expr q = qdot_symbol_get(f->pool, QDOT_COORD, name);

    must(qdot_scene_coordinate(f->scene, q));
    return q;
}

static inline qdot_expr
velocity(fixture *f, qdot_expr q)
{
    return qdot_symbol_jet(f->pool, q, 1);
}

static inline void
set(fixture *f, const char *name, const char *value)
{
    f->symbols[f->request.n_values] = parameter(f, name);
    f->values[f->request.n_values++] = number(f, value);
}

/* The parameter is itself its value; returns it. */
static inline qdot_expr
set_free(fixture *f, const char *name)
{
    const qdot_expr p = parameter(f, name);

    f->symbols[f->request.n_values] = p;
    f->values[f->request.n_values++] = p;
    return p;
}

static inline void
begin(fixture *f)
{
    memset(f, 0, sizeof *f);
    f->pool = qdot_pool_new();
    f->scene = qdot_scene_new(f->pool);
    for (int i = 0; i < MOST_COORDINATES; i++)
        f->q0[i] = f->v0[i] = QDOT_ZERO;
    f->request = (qdot_run_request){
        .symbols = f->symbols,
        .values = f->values,
        .q0 = f->q0,
        .v0 = f->v0,
        .t0 = QDOT_ZERO,
        .t1 = QDOT_ONE,
        .tol = 1e-12,
        .method = "auto",
    };
}

static inline void
end(fixture *f)
{
    qdot_scene_free(f->scene);
    qdot_pool_free(f->pool);
}

static inline qdot_expr
times(fixture *f, qdot_expr a, qdot_expr b)
{
    return qdot_mul(f->pool, a, b);
}

static inline qdot_expr
pair(fixture *f, qdot_expr x, qdot_expr y)
{
    return qdot_vector(f->pool, 2, (qdot_expr[]){x, y});
}

/* A chain of n pendulums, masses 1, lengths 1, g = 9.81 (as parameters m, l, g). */
static inline void
chain(fixture *f, int n)
{
    qdot_expr m, l, x = QDOT_ZERO, y = QDOT_ZERO, q;
    char name[32];

    begin(f);
    m = parameter(f, "m");
    l = parameter(f, "l");
    for (int i = 0; i < n; i++) {
        snprintf(name, sizeof name, "theta[%d]", i + 1);
        q = coordinate(f, name);
        x = qdot_add(f->pool, x, times(f, l, qdot_fun1(f->pool, QDOT_SIN, q)));
        y = qdot_sub(f->pool, y, times(f, l, qdot_fun1(f->pool, QDOT_COS, q)));
        snprintf(name, sizeof name, "bob[%d]", i + 1);
        must(qdot_scene_particle(f->scene, name, m, pair(f, x, y)));
    }
    must(qdot_scene_gravity(
        f->scene, pair(f, QDOT_ZERO, qdot_neg(f->pool, parameter(f, "g")))));
    set(f, "m", "1");
    set(f, "l", "1");
    set(f, "g", "9.81");
}

static inline void
pendulum(fixture *f)
{
    chain(f, 1);
    f->q0[0] = qdot_expr_int(f->pool, 2);
}

static inline qdot_run *
run(fixture *f)
{
    qdot_run *r = NULL;

    must(qdot_run_new(f->scene, &f->request, &r));
    return r;
}

/* Out of memory at the n-th allocation of a run, for n up to where it passes. */
static inline void
survives_failed_allocations(fixture *f)
{
    qdot_status status = QDOT_ENOMEM;
    int64_t n = 0;

    f->request.t1 = QDOT_ZERO; /* no second thread, whose allocations would count */
    for (; status != QDOT_OK && n < 100000; n += 1 + n / 40) {
        qdot_run *r = NULL;

        f->scene->version++; /* derive again */
        qdot_memory_fail_at(n);
        status = qdot_run_new(f->scene, &f->request, &r);
        qdot_memory_fail_at(-1);
        assert_true(status == QDOT_OK || status == QDOT_ENOMEM);
        assert_true((status == QDOT_OK) == (r != NULL));
        qdot_run_free(r);
    }
    assert_true(status == QDOT_OK && n > 20);
}

#endif
