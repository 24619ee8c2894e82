/* test_tree-alone.c -- long chains, whose M and f are never derived: the same motion, and work
 * that grows with the text; plans kept with their scene. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "sim/scenes.h"

#include <math.h>

#include "sim/bind/bind.h"
#include "sim/course/run-state.h"
#include "sim/course/stage.h"
#include "sim/form/residual.h"
#include "sim/plan/plan.h"

enum { LONGEST = 200 };

/* A chain of n links, from rest. */
typedef struct {
    fixture f;
    size_t n;
    qdot_expr q[LONGEST], q0[LONGEST], v0[LONGEST];
} long_chain;

static void
make_long(long_chain *c, size_t n)
{
    fixture *f = &c->f;
    qdot_expr x = QDOT_ZERO, y = QDOT_ZERO;

    begin(f);
    c->n = n;
    for (size_t k = 0; k < n; k++) {
        char name[32];

        snprintf(name, sizeof name, "theta[%zu]", k + 1);
        c->q[k] = coordinate(f, name);
        c->q0[k] = qdot_expr_int(f->pool, (int64_t)(k % 3));
        c->v0[k] = QDOT_ZERO;
    }
    for (size_t k = 0; k < n; k++) {
        char name[32];

        x = qdot_add(f->pool, x, qdot_fun1(f->pool, QDOT_SIN, c->q[k]));
        y = qdot_sub(f->pool, y, qdot_fun1(f->pool, QDOT_COS, c->q[k]));
        snprintf(name, sizeof name, "bob[%zu]", k + 1);
        must(qdot_scene_particle(f->scene, name, parameter(f, "m"),
                                 qdot_vector(f->pool, 2, (qdot_expr[]){x, y})));
    }
    must(qdot_scene_gravity(
        f->scene, qdot_vector(f->pool, 2, (qdot_expr[]){QDOT_ZERO, number(f, "-9.81")})));
    set(f, "m", "1");
    f->request.q0 = c->q0;
    f->request.v0 = c->v0;
    f->request.t1 = number(f, "0.1");
    f->request.tol = 1e-9;
}

static qdot_stage
stage(long_chain *c)
{
    qdot_stage s = {0};

    must(qdot_stage_begin(&s, c->f.scene, &c->f.request));
    return s;
}

static qdot_run *
run_long(long_chain *c)
{
    qdot_run *r;

    must(qdot_run_new(c->f.scene, &c->f.request, &r));
    assert_int_equal(qdot_run_get_report(r)->status, QDOT_RUN_DONE);
    return r;
}

static void
fill_state(const long_chain *c, double *y)
{
    for (size_t i = 0; i < 2 * c->n; i++)
        y[i] = 1.3 * sin(7.0 * (double)i + 1);
}

/* Both plans of one scene: the one of a run has no M, the one of others has. */
static void
accelerations_are_those_of_the_derived_form(void **state)
{
    enum { N = 40 };
    long_chain c;
    double y[2 * N], a[N], b[N], size = 0;
    qdot_bind *alone, *whole;
    qdot_ode_system system;
    qdot_plan *derived;
    qdot_stage s;

    (void)state;
    make_long(&c, N);
    s = stage(&c);
    assert_null(s.modes.at[0]->plan->M);
    assert_null(s.modes.at[0]->plan->tape);
    must(qdot_plan_new(c.f.scene, &c.f.request, &derived));
    assert_non_null(derived->M);
    must(qdot_bind_new(s.modes.at[0]->plan, false, &alone));
    must(qdot_bind_new(derived, false, &whole));
    fill_state(&c, y);
    system = qdot_bind_system(alone);
    must(qdot_bind_accelerations(&system, 0, y, a));
    system = qdot_bind_system(whole);
    must(qdot_bind_accelerations(&system, 0, y, b));
    for (size_t i = 0; i < N; i++)
        size = fmax(size, fabs(b[i]));
    for (size_t i = 0; i < N; i++)
        assert_true(fabs(a[i] - b[i]) <= 1e-10 * size);
    qdot_bind_free(alone);
    qdot_bind_free(whole);
    qdot_plan_free(derived);
    qdot_stage_clear(&s);
    end(&c.f);
}

/* h along the tree against mech's. */
static void
energy_is_that_of_mech(void **state)
{
    enum { N = 40 };
    long_chain c;
    double y[2 * N + 1], h, e, *work;
    qdot_tape *tape;
    qdot_expr whole;
    const qdot_plan *p;
    qdot_stage s;

    (void)state;
    make_long(&c, N);
    s = stage(&c);
    p = s.modes.at[0]->plan;
    whole = qdot_plan_substitute(p, qdot_mech_energy(c.f.scene));
    must(qdot_tape_new(c.f.pool, 2 * N + 1, p->inputs, 1, &whole, &tape));
    work = qdot_calloc(qdot_tape_work(tape) + qdot_tape_work(p->residual->energy) + 1,
                       sizeof *work);
    assert_non_null(work);
    fill_state(&c, y);
    y[2 * N] = 0;
    qdot_tape_eval(tape, y, &e, work);
    qdot_tape_eval(p->residual->energy, y, &h, work);
    assert_true(fabs(h - e) <= 1e-12 * fabs(e));
    for (size_t i = 0; i < N; i++)
        assert_false(p->residual->absent[i]);
    qdot_free(work);
    qdot_tape_free(tape);
    qdot_stage_clear(&s);
    end(&c.f);
}

/* Nodes that a run of a chain makes beside its places. */
static size_t
nodes_of_run(size_t n)
{
    long_chain c;
    size_t before, made;

    make_long(&c, n);
    before = qdot_pool_count(c.f.pool);
    qdot_run_free(run_long(&c));
    made = qdot_pool_count(c.f.pool) - before;
    end(&c.f);
    return made;
}

static void
work_grows_with_the_chain(void **state)
{
    const size_t once = nodes_of_run(LONGEST / 2), twice = nodes_of_run(LONGEST);

    (void)state;
    assert_true(once > 0);
    if (twice > 2.1 * (double)once)
        fail_msg("%zu nodes for %d links, %zu for %d", once, LONGEST / 2, twice, LONGEST);
}

static void
short_chains_are_derived(void **state)
{
    long_chain c;
    qdot_stage s;

    (void)state;
    make_long(&c, QDOT_MANY_COORDINATES - 1);
    s = stage(&c);
    assert_non_null(s.modes.at[0]->plan->M);
    assert_non_null(s.modes.at[0]->plan->tape);
    qdot_stage_clear(&s);
    end(&c.f);
}

/* What reads M gets it: first orders in two doubles, methods without series. */
static void
what_reads_M_has_it(void **state)
{
    long_chain c;
    qdot_stage s;

    (void)state;
    make_long(&c, QDOT_MANY_COORDINATES);
    c.f.request.tol = 1e-15;
    s = stage(&c);
    assert_non_null(s.modes.at[0]->plan->M);
    qdot_stage_clear(&s);
    c.f.request.tol = 1e-9;
    c.f.request.method = "rk8pd";
    s = stage(&c);
    assert_non_null(s.modes.at[0]->plan->M);
    qdot_stage_clear(&s);
    end(&c.f);
}

/* A force with a switch in it, from the tip of a long chain. */
static void
switches_are_found_without_M(void **state)
{
    long_chain c;
    qdot_stage s;

    (void)state;
    make_long(&c, QDOT_MANY_COORDINATES);
    must(qdot_scene_potential(c.f.scene, qdot_fun1(c.f.pool, QDOT_ABS, c.q[5])));
    s = stage(&c);
    assert_int_equal(s.switches.surfaces.n, 1);
    assert_non_null(s.modes.at[0]->plan->M);
    qdot_stage_clear(&s);
    end(&c.f);
}

/* --- a second run ---------------------------------------------------------------------- */

static void
a_second_run_takes_the_plan(void **state)
{
    static const size_t lengths[] = {3, 40};

    (void)state;
    for (size_t k = 0; k < 2; k++) {
        long_chain c;
        qdot_run *first, *second;
        size_t nodes;

        make_long(&c, lengths[k]);
        first = run_long(&c);
        nodes = qdot_pool_count(c.f.pool);
        c.q0[0] = qdot_expr_int(c.f.pool, 1);
        c.f.request.t1 = QDOT_ONE;
        c.f.request.tol = 1e-8;
        second = run_long(&c);
        assert_ptr_equal(first->plan, second->plan);
        assert_int_equal(qdot_pool_count(c.f.pool), nodes);
        qdot_run_free(first); /* the other one still reads it */
        assert_int_equal(second->plan->n, lengths[k]);
        qdot_run_free(second);
        end(&c.f);
    }
}

/* Of chains by each of their forms: series of a run and of companions are made of the programs that
 * the plan has, and a second run neither derives nor lowers nor translates anything. */
static void
nothing_is_made_twice(void **state)
{
    static const size_t lengths[] = {1, 2, 6, 40};
    static const double tols[] = {1e-9, 1e-15};

    (void)state;
    for (size_t k = 0; k < sizeof lengths / sizeof *lengths; k++) {
        long_chain c;
        qdot_run *first, *second;
        qdot_bind *bind;
        size_t made;
        size_t nodes;

        make_long(&c, lengths[k]);
        c.f.request.tol = tols[k % 2];
        first = run_long(&c);
        made = qdot_program_made();
        assert_true(made > 0);
        for (int shaken = 0; shaken < 2; shaken++) {
            must(qdot_bind_new(first->plan, shaken, &bind));
            qdot_bind_free(bind);
        }
        assert_int_equal(qdot_program_made(), made);
        nodes = qdot_pool_count(c.f.pool);
        second = run_long(&c);
        assert_int_equal(qdot_program_made(), made);
        assert_int_equal(qdot_pool_count(c.f.pool), nodes);
        assert_ptr_equal(first->plan, second->plan);
        qdot_run_free(first);
        qdot_run_free(second);
        end(&c.f);
    }
}

static void
what_differs_is_planned_anew(void **state)
{
    long_chain c;
    qdot_run *first, *second;

    (void)state;
    make_long(&c, 3);
    first = run_long(&c);
    c.f.values[0] = number(&c.f, "2");
    second = run_long(&c);
    assert_ptr_not_equal(first->plan, second->plan);
    qdot_run_free(second);
    c.f.values[0] = QDOT_ONE;
    second = run_long(&c); /* both are kept */
    assert_ptr_equal(first->plan, second->plan);
    qdot_run_free(second);
    c.f.request.method = "rk8pd";
    second = run_long(&c);
    assert_ptr_not_equal(first->plan, second->plan);
    qdot_run_free(second);
    c.f.request.method = "auto";
    must(qdot_scene_potential(c.f.scene, c.q[0]));
    second = run_long(&c);
    assert_ptr_not_equal(first->plan, second->plan);
    qdot_run_free(second);
    qdot_run_free(first);
    end(&c.f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(accelerations_are_those_of_the_derived_form),
        cmocka_unit_test(energy_is_that_of_mech),
        cmocka_unit_test(work_grows_with_the_chain),
        cmocka_unit_test(short_chains_are_derived),
        cmocka_unit_test(what_reads_M_has_it),
        cmocka_unit_test(switches_are_found_without_M),
        cmocka_unit_test(a_second_run_takes_the_plan),
        cmocka_unit_test(nothing_is_made_twice),
        cmocka_unit_test(what_differs_is_planned_anew),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
