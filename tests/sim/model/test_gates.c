/* test_gates.c -- branches that are not taken hold no switch, and need not be defined. */
#include "expr/build.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "sim/scenes.h"

#include <stdlib.h>

#include "sim/model/gates.h"
#include "sim/model/switch.h"

typedef struct {
    qdot_pool *pool;
    qdot_expr x, y;
    qdot_surface at[4];
    qdot_gates gates;
    uint8_t *open;
} gated;

static void
surface(gated *g, size_t i, qdot_expr u)
{
    bool turned;

    g->at[i].u = qdot_gates_upright(g->pool, u, &turned);
}

static void
gate(gated *g, size_t m, qdot_expr e)
{
    must(qdot_gates_find(g->pool, m, g->at, 1, &e, true, &g->gates));
    g->open = calloc(g->gates.gates.n + m + 1, sizeof *g->open);
}

static void
expect_open(gated *g, const int64_t *side, const char *which)
{
    qdot_gates_open(&g->gates, side, NULL, g->open);
    for (size_t i = 0; which[i]; i++)
        if ((g->open[g->gates.gates.n + i] != 0) != (which[i] == 'o'))
            fail_msg("surface %zu is %s", i, which[i] == 'o' ? "closed" : "open");
}

static void
gated_begin(gated *g)
{
    *g = (gated){.pool = qdot_pool_new()};
    g->x = qdot_symbol_get(g->pool, QDOT_COORD, "x");
    g->y = qdot_symbol_get(g->pool, QDOT_COORD, "y");
}

static void
gated_end(gated *g)
{
    qdot_gates_clear(&g->gates);
    free(g->open);
    qdot_pool_free(g->pool);
}

/* if(x < 0, abs(y), 0): y is looked at for x < 0 only, where the motion slides along x = 0, and where that is
 * not known. */
static void
a_branch_is_open_where_it_is_taken(void **state)
{
    gated g;

    (void)state;
    gated_begin(&g);
    surface(&g, 0, g.x);
    surface(&g, 1, g.y);
    gate(&g, 2,
         qdot_fun(g.pool, QDOT_IF, 3,
                  (qdot_expr[]){qdot_rel(g.pool, QDOT_LT, g.x, QDOT_ZERO),
                                qdot_fun1(g.pool, QDOT_ABS, g.y), QDOT_ZERO}));
    assert_true(g.gates.branches);
    expect_open(&g, (int64_t[]){-1, QDOT_SIDE_IDLE}, "oo");
    expect_open(&g, (int64_t[]){0, 1}, "oc");
    expect_open(&g, (int64_t[]){1, 1}, "oc");
    expect_open(&g, (int64_t[]){QDOT_SIDE_SLIDES, 1}, "oo");
    expect_open(&g, (int64_t[]){QDOT_SIDE_OPEN, 1}, "oo");
    expect_open(&g, NULL, "oo");
    gated_end(&g);
}

/* if(x > 0 and y > 0, 1, 0): the second comparison is looked at where the first holds. */
static void
a_condition_is_read_until_it_is_decided(void **state)
{
    gated g;

    (void)state;
    gated_begin(&g);
    surface(&g, 0, g.x);
    surface(&g, 1, g.y);
    gate(&g, 2,
         qdot_fun(g.pool, QDOT_IF, 3,
                  (qdot_expr[]){qdot_logic(g.pool, QDOT_AND, 2,
                                           (qdot_expr[]){qdot_rel(g.pool, QDOT_LT, QDOT_ZERO, g.x),
                                                         qdot_rel(g.pool, QDOT_LT, QDOT_ZERO, g.y)}),
                                QDOT_ONE, QDOT_ZERO}));
    expect_open(&g, (int64_t[]){1, -1}, "oo");
    expect_open(&g, (int64_t[]){-1, -1}, "oc");
    gated_end(&g);
}

/* max(x, y, abs(x + y)): where x is more than both, y - abs(x + y) decides nothing, and x + y is still looked at,
 * for x - abs(x + y) needs it. */
static void
what_is_least_need_not_be_compared(void **state)
{
    gated g;
    qdot_expr third;

    (void)state;
    gated_begin(&g);
    third = qdot_fun1(g.pool, QDOT_ABS, qdot_add(g.pool, g.x, g.y));
    surface(&g, 0, qdot_add(g.pool, g.x, g.y));
    surface(&g, 1, qdot_sub(g.pool, g.x, g.y));
    surface(&g, 2, qdot_sub(g.pool, g.x, third));
    surface(&g, 3, qdot_sub(g.pool, g.y, third));
    gate(&g, 4, qdot_fun(g.pool, QDOT_MAX, 3, (qdot_expr[]){g.x, g.y, third}));
    expect_open(&g, (int64_t[]){1, 1, g.at[2].u == qdot_sub(g.pool, g.x, third) ? 1 : -1, 1}, "oooc");
    gated_end(&g);
}

/* Frozen to x > 0 if(x < 0, log(min(x, 0)), x) is x, and the logarithm of 0 is not formed. */
static void
what_is_closed_is_not_formed(void **state)
{
    fixture f;
    qdot_switches s = {0};
    qdot_expr x, e, frozen;
    int64_t side[4] = {0};

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    must(qdot_scene_particle(f.scene, "p", QDOT_ONE, x));
    e = qdot_fun(f.pool, QDOT_IF, 3,
                 (qdot_expr[]){qdot_rel(f.pool, QDOT_LT, x, QDOT_ZERO),
                               qdot_fun1(f.pool, QDOT_LOG,
                                         qdot_fun(f.pool, QDOT_MIN, 2, (qdot_expr[]){x, QDOT_ZERO})),
                               x});
    must(qdot_scene_torque(f.scene, &(qdot_torque){.coordinate = x, .torque = e}));
    must(qdot_switches_find(f.scene, &f.request, &s));
    assert_int_equal(s.surfaces.n, 1);
    side[0] = s.surfaces.at[0].u == x ? 1 : -1;
    must(qdot_switches_freeze(&s, side, NULL, 1, &e, &frozen));
    assert_int_equal(frozen, x);
    qdot_switches_clear(&s);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_branch_is_open_where_it_is_taken),
        cmocka_unit_test(a_condition_is_read_until_it_is_decided),
        cmocka_unit_test(what_is_least_need_not_be_compared),
        cmocka_unit_test(what_is_closed_is_not_formed),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
