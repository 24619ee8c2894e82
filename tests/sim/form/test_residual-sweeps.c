/* test_residual-sweeps.c -- d'Alembert's residual as a tree, and orders by elimination along it
 * against M q'' = f. */
#include "expr/build.h"
#include "expr/function.h"
#include "sim/scenes.h"

#include <math.h>

#include "sim/form/motion-series.h"
#include "sim/form/residual-sweeps.h"
#include "sim/plan/plan.h"

/* A scene's plan, residual and tree. */
typedef struct {
    qdot_plan *plan;
    qdot_residual *residual;
    qdot_residual_tree *tree;
} found;

static found
find(fixture *f)
{
    found at;

    f->request.method = "taylor";
    must(qdot_plan_new(f->scene, &f->request, &at.plan));
    must(qdot_residual_new(f->scene, at.plan, &at.residual));
    assert_non_null(at.residual);
    must(qdot_residual_tree_new(at.residual, at.plan->n, &at.tree));
    return at;
}

static void
release(found *at)
{
    qdot_residual_tree_free(at->tree);
    qdot_residual_free(at->residual);
    qdot_plan_free(at->plan);
}

/* A point without a pattern. */
static double
at_random(size_t i)
{
    return 1.3 * sin(7.0 * (double)i + 1);
}

static void
compare(const qdot_ode_series *a, size_t n, const double *q, size_t stride, int p)
{
    for (size_t i = 0; i < n; i++) {
        double size = 0;

        for (int k = 0; k <= p; k++) {
            const double x = a->x[i * a->stride + (size_t)k];
            const double z = q[i * stride + (size_t)k];

            size = fmax(size, fabs(x));
            if (!(fabs(x - z) <= 1e-11 * (1e-3 + size)))
                fail_msg("coordinate %zu, order %d: %.17g and %.17g", i, k, x, z);
        }
    }
}

/* Coefficients along the tree are those of M q'' = f. */
static void
orders_agree(const found *at)
{
    enum { P = 22 };
    const qdot_plan *p = at->plan;
    const size_t n = p->n;
    const double unit = 0.125;
    double *y = qdot_calloc(2 * n, sizeof *y), *first = qdot_calloc(n, sizeof *first);
    double *w = qdot_calloc(at->residual->n_weights, sizeof *w), *q, lost;
    qdot_residual_sweeps *tree;
    qdot_motion_series *direct;
    qdot_taylor *places;
    const qdot_ode_series *a;
    size_t stride;

    for (size_t i = 0; i < 2 * n; i++)
        y[i] = at_random(i);
    for (size_t i = 0; i < n; i++)
        first[i] = unit * y[n + i];
    for (size_t k = 0; k < at->residual->n_weights; k++)
        w[k] = at->residual->weights[k].w;
    must(qdot_motion_series_new(p, false, &direct));
    a = qdot_motion_series_get(direct);
    must(a->begin(0, y, unit, a->user));
    must(a->extend(P, a->user));
    must(qdot_residual_programs(at->residual));
    must(qdot_taylor_of_program(&at->residual->of_places, false, 30, &places));
    stride = qdot_taylor_stride(places);
    q = qdot_taylor_input(places, 0);
    for (size_t i = 0; i < n; i++) {
        q[i * stride] = y[i];
        q[i * stride + 1] = first[i];
    }
    qdot_taylor_order(places, 0);
    must(qdot_residual_sweeps_new(at->residual, n, places, w, &tree));
    assert_non_null(tree);
    assert_true(qdot_residual_sweeps_begin(tree, places, first, &lost));
    for (int m = 2; m <= P; m++)
        qdot_residual_sweeps_order(tree, m, unit * unit, NULL);
    qdot_residual_sweeps_rows(tree, P, 1 / unit, q, qdot_taylor_input(places, n), stride);
    compare(a, n, q, stride, P);
    qdot_residual_sweeps_free(tree);
    qdot_motion_series_free(direct);
    qdot_taylor_free(places);
    qdot_free(w);
    qdot_free(first);
    qdot_free(y);
}

static void
a_chain_is_a_path(void **state)
{
    static const int lengths[] = {3, 8, 9, 15, 19};

    (void)state;
    for (size_t l = 0; l < sizeof lengths / sizeof *lengths; l++) {
        const size_t n = (size_t)lengths[l];
        fixture f;
        found at;

        chain(&f, lengths[l]);
        at = find(&f);
        assert_non_null(at.tree);
        assert_int_equal(at.tree->nodes, n);
        assert_int_equal(at.tree->m, 2);
        assert_int_equal(at.tree->c, 1);
        for (size_t e = 2; e < 2 * n; e++)
            assert_int_equal(at.tree->parent[e], e - 2);
        orders_agree(&at);
        release(&at);
        end(&f);
    }
}

static qdot_expr
fun(fixture *f, qdot_fun_id id, qdot_expr x)
{
    return qdot_fun1(f->pool, id, x);
}

/* A chain in space, two angles a link. */
static void
a_chain_in_space_is_a_path_too(void **state)
{
    qdot_expr x = QDOT_ZERO, y = QDOT_ZERO, z = QDOT_ZERO, m;
    char name[32];
    fixture f;
    found at;

    (void)state;
    begin(&f);
    m = parameter(&f, "m");
    for (int k = 1; k <= 5; k++) {
        qdot_expr u, v;

        snprintf(name, sizeof name, "u[%d]", k);
        u = coordinate(&f, name);
        snprintf(name, sizeof name, "v[%d]", k);
        v = coordinate(&f, name);
        x = qdot_add(f.pool, x, times(&f, fun(&f, QDOT_SIN, u), fun(&f, QDOT_COS, v)));
        y = qdot_add(f.pool, y, times(&f, fun(&f, QDOT_SIN, u), fun(&f, QDOT_SIN, v)));
        z = qdot_sub(f.pool, z, fun(&f, QDOT_COS, u));
        snprintf(name, sizeof name, "bob[%d]", k);
        must(qdot_scene_particle(f.scene, name, m,
                                 qdot_vector(f.pool, 3, (qdot_expr[]){x, y, z})));
    }
    must(qdot_scene_gravity(
        f.scene, qdot_vector(f.pool, 3,
                             (qdot_expr[]){QDOT_ZERO, QDOT_ZERO, number(&f, "-9.81")})));
    set(&f, "m", "1.5");
    at = find(&f);
    assert_non_null(at.tree);
    assert_int_equal(at.tree->nodes, 5);
    assert_int_equal(at.tree->m, 3);
    assert_int_equal(at.tree->c, 2);
    for (size_t e = 3; e < 15; e++)
        assert_int_equal(at.tree->parent[e], e - 3);
    orders_agree(&at);
    release(&at);
    end(&f);
}

/* Link k of a plane, from (x, y) on; where it ends. */
static void
hang(fixture *f, int k, qdot_expr length, qdot_expr *x, qdot_expr *y)
{
    char name[32];
    qdot_expr q;

    snprintf(name, sizeof name, "q[%d]", k);
    q = coordinate(f, name);
    *x = qdot_add(f->pool, *x, times(f, length, fun(f, QDOT_SIN, q)));
    *y = qdot_sub(f->pool, *y, times(f, length, fun(f, QDOT_COS, q)));
}

static void
bob(fixture *f, int k, const char *mass, qdot_expr x, qdot_expr y)
{
    char name[32];

    snprintf(name, sizeof name, "bob[%d]", k);
    must(qdot_scene_particle(f->scene, name, number(f, mass), pair(f, x, y)));
}

static void
branches_are_a_tree(void **state)
{
    qdot_expr x = QDOT_ZERO, y = QDOT_ZERO, one;
    fixture f;
    found at;

    (void)state;
    begin(&f);
    one = number(&f, "1.25");
    hang(&f, 1, one, &x, &y);
    bob(&f, 1, "1", x, y);
    for (int arm = 0; arm < 2; arm++) {
        qdot_expr ax = x, ay = y;

        for (int k = 2; k <= 3; k++) {
            hang(&f, 2 * arm + k, one, &ax, &ay);
            bob(&f, 2 * arm + k, arm ? "0.4" : "2", ax, ay);
        }
    }
    must(qdot_scene_gravity(f.scene, pair(&f, QDOT_ZERO, number(&f, "-9.81"))));
    at = find(&f);
    assert_non_null(at.tree);
    assert_int_equal(at.tree->nodes, 5);
    assert_int_equal(at.tree->parent[2 * 3], 0);
    assert_int_equal(at.tree->parent[2 * 1], 0);
    orders_agree(&at);
    release(&at);
    end(&f);
}

/* Two links on every link: what the last ones hang on was told long before. */
static void
far_parents_are_found(void **state)
{
    enum { N = 31 };
    qdot_expr x[N], y[N], one;
    fixture f;
    found at;

    (void)state;
    begin(&f);
    one = number(&f, "1");
    for (int k = 0; k < N; k++) {
        x[k] = k > 0 ? x[(k - 1) / 2] : QDOT_ZERO;
        y[k] = k > 0 ? y[(k - 1) / 2] : QDOT_ZERO;
        hang(&f, k, one, x + k, y + k);
        bob(&f, k, "1.5", x[k], y[k]);
    }
    must(qdot_scene_gravity(f.scene, pair(&f, QDOT_ZERO, number(&f, "-9.81"))));
    at = find(&f);
    assert_non_null(at.tree);
    assert_int_equal(at.tree->nodes, N);
    for (uint32_t k = 1; k < N; k++)
        assert_int_equal(at.tree->parent[2 * k], 2 * ((k - 1) / 2));
    orders_agree(&at);
    release(&at);
    end(&f);
}

/* Three links with a mass in the middle of each, and one at its end. */
static found
rods(fixture *f, bool ends)
{
    qdot_expr x = QDOT_ZERO, y = QDOT_ZERO, half;

    begin(f);
    half = number(f, "0.5");
    for (int k = 1; k <= 3; k++) {
        qdot_expr middle_x, middle_y, q;
        char name[32];

        snprintf(name, sizeof name, "q[%d]", k);
        q = coordinate(f, name);
        middle_x = qdot_add(f->pool, x, times(f, half, fun(f, QDOT_SIN, q)));
        middle_y = qdot_sub(f->pool, y, times(f, half, fun(f, QDOT_COS, q)));
        x = qdot_add(f->pool, x, fun(f, QDOT_SIN, q));
        y = qdot_sub(f->pool, y, fun(f, QDOT_COS, q));
        bob(f, 2 * k, "1", middle_x, middle_y);
        if (ends)
            bob(f, 2 * k + 1, "1", x, y);
    }
    must(qdot_scene_gravity(f->scene, pair(f, QDOT_ZERO, number(f, "-9.81"))));
    return find(f);
}

/* One angle moves both masses: they are one node. */
static void
masses_that_move_together_are_a_node(void **state)
{
    fixture f;
    found at;

    (void)state;
    at = rods(&f, true);
    assert_non_null(at.tree);
    assert_int_equal(at.tree->nodes, 3);
    assert_int_equal(at.tree->m, 4);
    orders_agree(&at);
    release(&at);
    end(&f);
}

/* From a middle to the next there are two angles, each of which moves two of them. */
static void
a_coordinate_of_two_nodes_has_no_tree(void **state)
{
    fixture f;
    found at;

    (void)state;
    at = rods(&f, false);
    assert_null(at.tree);
    release(&at);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_chain_is_a_path),
        cmocka_unit_test(a_chain_in_space_is_a_path_too),
        cmocka_unit_test(branches_are_a_tree),
        cmocka_unit_test(far_parents_are_found),
        cmocka_unit_test(masses_that_move_together_are_a_node),
        cmocka_unit_test(a_coordinate_of_two_nodes_has_no_tree),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
