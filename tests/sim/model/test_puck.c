/* test_puck.c -- velocities whose direction is in a force: found, held, read. */
#include "expr/build.h"
#include "expr/exact.h"
#include "sim/scenes.h"

#include "expr/calculus.h"
#include "expr/walk.h"
#include "normal/prove/decide.h"
#include "sim/model/puck.h"

/* A particle in a plane with a force (a(w), b(w)), w = (x' + c y, y' - c x). */
typedef struct {
    fixture f;
    qdot_expr x, y, u, v, square;
    qdot_switches switches;
} plane;

static qdot_expr
over_root(plane *p, qdot_expr e)
{
    return qdot_mul(p->f.pool, e,
                    qdot_pow(p->f.pool, p->square, qdot_neg(p->f.pool, QDOT_HALF)));
}

static void
begin_plane(plane *p, int64_t c)
{
    qdot_pool *pool;

    *p = (plane){0};
    begin(&p->f);
    pool = p->f.pool;
    p->x = coordinate(&p->f, "x");
    p->y = coordinate(&p->f, "y");
    must(qdot_scene_particle(p->f.scene, "p", QDOT_ONE, p->x));
    must(qdot_scene_particle(p->f.scene, "q", QDOT_ONE, p->y));
    p->u = qdot_add(pool, velocity(&p->f, p->x),
                    qdot_mul(pool, qdot_expr_int(pool, c), p->y));
    p->v = qdot_sub(pool, velocity(&p->f, p->y),
                    qdot_mul(pool, qdot_expr_int(pool, c), p->x));
    p->square = qdot_add(pool, qdot_pow_int(pool, p->u, 2), qdot_pow_int(pool, p->v, 2));
}

static void
pull(plane *p, qdot_expr of, qdot_expr force)
{
    must(
        qdot_scene_torque(p->f.scene, &(qdot_torque){.coordinate = of, .torque = force}));
}

static void
find(plane *p)
{
    must(qdot_switches_find(p->f.scene, &p->f.request, &p->switches));
    must(qdot_pucks_find(p->f.scene, &p->f.request, &p->switches));
}

static void
end_plane(plane *p)
{
    qdot_switches_clear(&p->switches);
    end(&p->f);
}

/* On a turntable: d = w, G = 1, and the friction is -3 s at rest. */
static void
directions_are_found(void **state)
{
    plane p;
    const qdot_puck *puck;
    qdot_facts facts;
    qdot_expr e, read;

    (void)state;
    begin_plane(&p, 2);
    pull(&p, p.x, qdot_mul(p.f.pool, qdot_expr_int(p.f.pool, -3), over_root(&p, p.u)));
    pull(&p, p.y, qdot_mul(p.f.pool, qdot_expr_int(p.f.pool, -3), over_root(&p, p.v)));
    find(&p);
    assert_int_equal(p.switches.pucks.n, 1);
    assert_int_equal(qdot_switches_own(&p.switches), 0);
    puck = &p.switches.pucks.at[0];
    assert_int_equal(puck->k, 2);
    assert_true(puck->rest[0] == p.u && puck->rest[1] == p.v);
    assert_true(puck->metric[0] == QDOT_ONE && puck->metric[1] == QDOT_ZERO);
    facts = qdot_scene_facts(p.f.scene);
    e = qdot_mul(p.f.pool, qdot_expr_int(p.f.pool, -3), over_root(&p, p.u));
    must(qdot_puck_hold(p.f.pool, puck, &facts, 1, &e));
    assert_true(e == qdot_mul(p.f.pool, qdot_expr_int(p.f.pool, -3), puck->share[0]));
    /* the square of the friction is read as well, a force like 1/|w| is not */
    read = qdot_pow_int(p.f.pool, over_root(&p, p.u), 2);
    must(qdot_puck_reading(p.f.pool, puck, &read));
    assert_true(qdot_expr_contains(p.f.pool, read, puck->share[0]));
    read = over_root(&p, QDOT_ONE);
    assert_int_equal(qdot_puck_reading(p.f.pool, puck, &read), QDOT_EFAILED);
    e = over_root(&p, QDOT_ONE);
    assert_int_equal(qdot_puck_hold(p.f.pool, puck, &facts, 1, &e), QDOT_EFAILED);
    end_plane(&p);
}

/* sqrt(1 + |w|^2) vanishes nowhere. */
static void
smooth_roots_are_none(void **state)
{
    plane p;

    (void)state;
    begin_plane(&p, 0);
    p.square = qdot_add(p.f.pool, p.square, QDOT_ONE);
    pull(&p, p.x, over_root(&p, p.u));
    find(&p);
    assert_int_equal(p.switches.pucks.n, 0);
    end_plane(&p);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(directions_are_found),
        cmocka_unit_test(smooth_roots_are_none),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
