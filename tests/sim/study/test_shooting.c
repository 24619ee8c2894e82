/* test_shooting.c -- unstable orbits by multiple shooting, against closed forms. */
#include "expr/build.h"
#include "expr/function.h"
#include "sim/scenes.h"

#include <math.h>

#include "base/interrupt.h"
#include "sim/study/shooting.h"

/* x'' = g x + A cos(3 t): x = -A cos(3 t)/(9 + g) returns, and what is near it grows as exp(sqrt(g) t). */
typedef struct {
    fixture f;
    qdot_expr x, A;
} driven;

static const double free_low[] = {-INFINITY, -INFINITY}, free_high[] = {INFINITY, INFINITY};

static void
build(driven *d, const char *g)
{
    fixture *f = &d->f;
    qdot_pool *pool;
    qdot_expr phase;

    begin(f);
    pool = f->pool;
    d->x = coordinate(f, "x");
    d->A = set_free(f, "A");
    phase = qdot_fun1(pool, QDOT_COS, times(f, number(f, "3"), QDOT_T));
    must(qdot_scene_particle(f->scene, "b", QDOT_ONE, d->x));
    must(qdot_scene_potential(
        f->scene, qdot_neg(pool, qdot_add(pool, times(f, times(f, number(f, g), QDOT_HALF), times(f, d->x, d->x)),
                                          times(f, d->A, times(f, phase, d->x))))));
}

/* Three periods of the drive. */
static qdot_expr
three_turns(driven *d)
{
    return times(&d->f, number(&d->f, "2"), QDOT_PI);
}

static qdot_status
shoot(driven *d, size_t k, const qdot_expr *unknowns, const qdot_expr *start, qdot_expr period, double *u,
      bool *found, size_t *segments)
{
    static const char *const names[] = {"u1", "u2"};
    const qdot_shooting_of of = {.scene = d->f.scene,
                                 .request = &d->f.request,
                                 .k = k,
                                 .unknowns = unknowns,
                                 .names = names,
                                 .start = start,
                                 .period = period,
                                 .low = free_low,
                                 .high = free_high};

    double error[2];
    qdot_shooting_result r = {.u = u, .error = error};
    const qdot_status status = qdot_shooting_find(&of, &r);

    *found = r.found;
    *segments = r.segments;
    for (size_t i = 0; i < k && r.found; i++)
        if (!(error[i] > 0 && error[i] < 1e-8))
            fail_msg("error %g", error[i]);
    if (r.found)
        assert_int_equal(r.rank, k);
    return status;
}

/* exp(6 pi) = 1.5e8 in one period of the search. */
static void
a_start_is_found(void **state)
{
    double u[] = {0.01, 0.5};
    size_t segments;
    bool found;
    driven d;

    (void)state;
    build(&d, "9");
    {
        const qdot_expr start[] = {d.x, velocity(&d.f, d.x)};

        d.f.values[0] = QDOT_ONE;
        must(shoot(&d, 2, start, start, three_turns(&d), u, &found, &segments));
    }
    assert_true(found && segments > 10);
    assert_true(fabs(u[0] + 1 / 18.0) < 1e-11 && fabs(u[1]) < 1e-11);
    end(&d.f);
}

/* The start's time counts: at pi/12 the drive has turned by 45 degrees. */
static void
a_drive_goes_on_through_the_segments(void **state)
{
    double u[] = {0, 0.1};
    size_t segments;
    bool found;
    driven d;

    (void)state;
    build(&d, "9");
    d.f.request.t0 = qdot_div(d.f.pool, QDOT_PI, number(&d.f, "12"));
    {
        const qdot_expr start[] = {d.x, velocity(&d.f, d.x)};

        d.f.values[0] = QDOT_ONE;
        must(shoot(&d, 2, start, start, three_turns(&d), u, &found, &segments));
    }
    assert_true(found);
    assert_true(fabs(u[0] + sqrt(0.5) / 18) < 1e-11 && fabs(u[1] - 3 * sqrt(0.5) / 18) < 1e-11);
    end(&d.f);
}

/* x(0) = 1 belongs to A = -18. */
static void
a_parameter_is_found(void **state)
{
    double u[] = {-17, 0.1};
    size_t segments;
    bool found;
    driven d;

    (void)state;
    build(&d, "9");
    {
        const qdot_expr v = velocity(&d.f, d.x);

        must(shoot(&d, 2, (qdot_expr[]){d.A, v}, (qdot_expr[]){QDOT_ONE, v}, three_turns(&d), u, &found,
                   &segments));
    }
    assert_true(found);
    assert_true(fabs(u[0] + 18) < 1e-9 && fabs(u[1]) < 1e-10);
    end(&d.f);
}

/* Of x'' = g x + A cos(3 t) nothing is found, and the guess stays; returns the segments. */
static size_t
segments_in_vain(const char *g, qdot_expr A)
{
    double u[] = {0.3, 0.2};
    size_t segments;
    bool found;
    driven d;

    build(&d, g);
    {
        const qdot_expr start[] = {d.x, velocity(&d.f, d.x)};

        d.f.values[0] = A;
        must(shoot(&d, 2, start, start, three_turns(&d), u, &found, &segments));
    }
    assert_true(!found && u[0] == 0.3 && u[1] == 0.2);
    end(&d.f);
    return segments;
}

/* One segment does. */
static void
nothing_is_searched_where_nothing_grows(void **state)
{
    (void)state;
    assert_int_equal(segments_in_vain("-1.5", QDOT_ONE), 1);
}

/* The only periodic motion is a rest, which is no orbit. */
static void
a_rest_is_no_orbit(void **state)
{
    (void)state;
    assert_true(segments_in_vain("9", QDOT_ZERO) > 1);
}

static void
constraints_are_refused(void **state)
{
    double u[] = {0.3};
    size_t segments;
    bool found;
    driven d;

    (void)state;
    build(&d, "9");
    must(qdot_scene_constraint(d.f.scene, "c", d.x, QDOT_ONE));
    assert_int_equal(shoot(&d, 1, &d.x, (qdot_expr[]){d.x, QDOT_ZERO}, QDOT_ONE, u, &found, &segments),
                     QDOT_ENOTBUILT);
    end(&d.f);
}

static void
survives_failed_allocations_and_interrupts(void **state)
{
    qdot_status status = QDOT_ENOMEM;
    driven d;
    int64_t n = 0;

    (void)state;
    build(&d, "9");
    d.f.values[0] = QDOT_ONE;
    for (int press = 0; press < 2; press++, status = QDOT_ENOMEM)
        for (n = 0; status != QDOT_OK && n < 1000000; n += 1 + n / 3) {
            const qdot_expr start[] = {d.x, velocity(&d.f, d.x)};
            double u[] = {0.01, 0.5};
            size_t segments;
            bool found;

            d.f.scene->version++; /* derive again */
            (press ? qdot_memory_press_at : qdot_memory_fail_at)(n);
            status = shoot(&d, 2, start, start, three_turns(&d), u, &found, &segments);
            (press ? qdot_memory_press_at : qdot_memory_fail_at)(-1);
            qdot_interrupt_clear();
            assert_true(status == QDOT_OK || status == (press ? QDOT_EINTR : QDOT_ENOMEM));
            assert_true(status != QDOT_OK || found);
        }
    assert_true(n > 20);
    end(&d.f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_start_is_found),
        cmocka_unit_test(a_drive_goes_on_through_the_segments),
        cmocka_unit_test(a_parameter_is_found),
        cmocka_unit_test(nothing_is_searched_where_nothing_grows),
        cmocka_unit_test(a_rest_is_no_orbit),
        cmocka_unit_test(constraints_are_refused),
        cmocka_unit_test(survives_failed_allocations_and_interrupts),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
