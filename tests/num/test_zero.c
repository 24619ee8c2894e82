#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <math.h>
#include <string.h>
#include <cmocka.h>

#include "num/zero.h"

/* Where x^2 + y^2 = 4 and x y = 1, beside: x + y = sqrt(6), which follows. */
static qdot_status
circle(const double *u, double *f, double *error, double *slope, void *user)
{
    const size_t m = *(const size_t *)user;
    const double all[3][3] = {{u[0] * u[0] + u[1] * u[1] - 4, 2 * u[0], 2 * u[1]},
                              {u[0] * u[1] - 1, u[1], u[0]},
                              {u[0] + u[1] - sqrt(6), 1, 1}};

    for (size_t i = 0; i < m; i++) {
        f[i] = all[i][0];
        error[i] = 1e-12;
        for (size_t j = 0; slope != NULL && j < 2; j++)
            slope[2 * i + j] = all[i][1 + j];
    }
    return QDOT_OK;
}

/* As many equations as unknowns, and one more that agrees: the same zero, its errors from those of F. */
static void
zeros_of_square_and_tall_systems(void **state)
{
    (void)state;
    for (size_t m = 2; m <= 3; m++) {
        double u[2] = {2.385, 0.3}, error[2], f[3], f_error[3];
        const qdot_zero_problem p = {.n = 2, .m = m, .at = circle, .user = &m};
        qdot_zero_result r = {.u = u, .error = error, .f = f, .f_error = f_error};

        assert_int_equal(qdot_zero_find(&p, &r), QDOT_OK);
        assert_int_equal(r.answer, QDOT_ZERO_FOUND);
        assert_int_equal(r.rank, 2);
        assert_true(fabs(u[0] - (sqrt(6) + sqrt(2)) / 2) <= error[0]);
        assert_true(fabs(u[1] - (sqrt(6) - sqrt(2)) / 2) <= error[1]);
        assert_true(error[0] < 3e-12 && error[0] > 1e-13);
    }
}

/* One equation of two unknowns: a point of the circle near the guess, which the least steps keep on its ray. */
static void
a_family_gives_the_near_solution(void **state)
{
    size_t m = 1;
    double u[2] = {1.2, 0.9}, error[2], f, f_error;
    const qdot_zero_problem p = {.n = 2, .m = 1, .at = circle, .user = &m};
    qdot_zero_result r = {.u = u, .error = error, .f = &f, .f_error = &f_error};

    (void)state;
    assert_int_equal(qdot_zero_find(&p, &r), QDOT_OK);
    assert_int_equal(r.answer, QDOT_ZERO_FOUND);
    assert_int_equal(r.rank, 1);
    assert_true(fabs(hypot(u[0], u[1]) - 2) < 1e-11);
    assert_true(fabs(u[0] - 1.6) < 0.1 && fabs(u[1] - 1.2) < 0.1);
}

/* An oscillator's x(1) = -0.38, x'(2) = -0.04 by its start: linear, with the zero 400 units from the guess along the
 * direction that hardly moves F there. */
static qdot_status
oscillator_at(const double *u, double *f, double *error, double *slope, void *user)
{
    const double *omega = user, w = *omega, all[4] = {cos(w), sin(w) / w, -w * sin(2 * w), cos(2 * w)};
    const double goal[2] = {-0.38, -0.04};

    for (size_t i = 0; i < 2; i++) {
        f[i] = all[2 * i] * u[0] + all[2 * i + 1] * u[1] - goal[i];
        error[i] = 1e-15;
    }
    if (slope != NULL)
        memcpy(slope, all, sizeof all);
    return QDOT_OK;
}

static void
a_far_zero_along_a_weak_direction(void **state)
{
    double omega = 1.62, u[2] = {0.02, -0.49}, error[2], f[2], f_error[2];
    const qdot_zero_problem p = {.n = 2, .m = 2, .at = oscillator_at, .user = &omega};
    qdot_zero_result r = {.u = u, .error = error, .f = f, .f_error = f_error};
    const double a = cos(omega), b = sin(omega) / omega, c = -omega * sin(2 * omega), d = cos(2 * omega);

    (void)state;
    assert_int_equal(qdot_zero_find(&p, &r), QDOT_OK);
    assert_int_equal(r.answer, QDOT_ZERO_FOUND);
    assert_true(fabs(u[0] - (-0.38 * d + 0.04 * b) / (a * d - b * c)) <= error[0]);
    assert_true(fabs(u[1] - (-0.04 * a + 0.38 * c) / (a * d - b * c)) <= error[1]);
    assert_true(error[0] < 1e-11);
}

/* sin 8u = 0 from 4 on; 10 pi/8 is not wanted, and is the answer where no other zero can be had. */
static qdot_status
sine_at(const double *u, double *f, double *error, double *slope, void *user)
{
    const double *most = user;

    *f = u[0] < 1 || u[0] > *most ? NAN : sin(8 * u[0]);
    *error = 1e-16;
    if (slope != NULL)
        *slope = 8 * cos(8 * u[0]);
    return QDOT_OK;
}

static qdot_status
is_beyond_the_first(const double *u, size_t rank, bool *is, void *user)
{
    (void)user;
    (void)rank;
    *is = u[0] > 4.1;
    return QDOT_OK;
}

static void
a_zero_that_is_not_wanted(void **state)
{
    double most[2] = {30, 4.2}, u[4];

    (void)state;
    for (int k = 0; k < 2; k++) {
        const qdot_zero_problem p = {
            .n = 1, .m = 1, .at = sine_at, .user = &most[k], .wanted = is_beyond_the_first};
        qdot_zero_result r = {.u = u, .error = u + 1, .f = u + 2, .f_error = u + 3};

        u[0] = 4;
        assert_int_equal(qdot_zero_find(&p, &r), QDOT_OK);
        assert_int_equal(r.answer, QDOT_ZERO_FOUND);
        assert_true(fabs(sin(8 * u[0])) < 1e-13 && (u[0] > 4.1) == (k == 0));
        assert_true(u[1] < 1e-14 && fabs(u[2]) < 1e-13);
    }
}

/* F jumps from -0.3 to 0.3, known to 0.1, where slopes are large: that is no zero. */
static qdot_status
wild_at(const double *u, double *f, double *error, double *slope, void *user)
{
    (void)user;
    *f = u[0] - 1.1 > 0 ? 0.3 : -0.3;
    *error = 0.1;
    if (slope != NULL)
        *slope = 1e6;
    return QDOT_OK;
}

static void
what_is_not_known_is_no_zero(void **state)
{
    double u[4] = {1};
    const qdot_zero_problem p = {.n = 1, .m = 1, .at = wild_at};
    qdot_zero_result r = {.u = u, .error = u + 1, .f = u + 2, .f_error = u + 3};

    (void)state;
    assert_int_equal(qdot_zero_find(&p, &r), QDOT_OK);
    assert_int_not_equal(r.answer, QDOT_ZERO_FOUND);
}

/* x + y = 3 twice, the second time with y by a thousandth more: y = 0, of values known to *user. */
static qdot_status
alike_at(const double *u, double *f, double *error, double *slope, void *user)
{
    for (size_t i = 0; i < 2; i++) {
        const double by = i == 0 ? 1 : 1 + 1e-3;

        f[i] = u[0] + by * u[1] - 3;
        error[i] = *(const double *)user;
        if (slope != NULL) {
            slope[2 * i] = 1;
            slope[2 * i + 1] = by;
        }
    }
    return QDOT_OK;
}

static void
a_zero_that_may_be_anywhere(void **state)
{
    double error[2] = {1e-3, 1e-9}, u[2], off[2], f[2], f_error[2];

    (void)state;
    for (int k = 0; k < 2; k++) {
        const qdot_zero_problem p = {.n = 2, .m = 2, .at = alike_at, .user = &error[k]};
        qdot_zero_result r = {.u = u, .error = off, .f = f, .f_error = f_error};

        u[0] = 1.5;
        u[1] = 1;
        assert_int_equal(qdot_zero_find(&p, &r), QDOT_OK);
        assert_int_equal(r.answer, k == 0 ? QDOT_ZERO_VAGUE : QDOT_ZERO_FOUND);
        assert_true(fabs(u[0] - 3) <= off[0] && fabs(u[1]) <= off[1]);
    }
}

typedef struct {
    double (*of)(double);
    double from, to; /* where it can be had */
    int known;       /* whether slopes are */
} one;

static qdot_status
one_at(const double *u, double *f, double *error, double *slope, void *user)
{
    const one *x = user;

    *f = u[0] < x->from || u[0] > x->to ? NAN : x->of(u[0]);
    *error = 1e-14;
    if (slope != NULL)
        *slope = x->known ? (x->of(u[0] + 1e-6) - x->of(u[0] - 1e-6)) / 2e-6 : NAN;
    return QDOT_OK;
}

static double
steep(double u)
{
    return atan(40 * (u - 0.3)); /* Newton alone leaves it from the middle of 0..5 */
}

static double
pole(double u)
{
    return 1 / (u - 0.3);
}

static double
touch(double u)
{
    return (u - 0.3) * (u - 0.3);
}

static double
above(double u)
{
    return 1 + (u - 0.3) * (u - 0.3);
}

static double
flat(double u)
{
    (void)u;
    return 1;
}

static qdot_zero_result
between(one x, double low, double high, double *room)
{
    const qdot_zero_problem p = {
        .n = 1, .m = 1, .at = one_at, .user = &x, .low = &low, .high = &high};
    qdot_zero_result r = {
        .u = room, .error = room + 1, .f = room + 2, .f_error = room + 3};

    room[0] = low + (high - low) / 2;
    assert_int_equal(qdot_zero_find(&p, &r), QDOT_OK);
    return r;
}

/* With slopes and without; from ends of one sign too, with two zeros between; at a touch. */
static void
bounds_lead_to_a_zero(void **state)
{
    double u[4];

    (void)state;
    for (int known = 0; known < 2; known++) {
        assert_int_equal(between((one){steep, 0, 5, known}, 0, 5, u).answer, QDOT_ZERO_FOUND);
        assert_true(fabs(u[0] - 0.3) <= u[1] && u[1] < 1e-12);
        assert_int_equal(between((one){sin, 0, 9, known}, 0.5, 7.3, u).answer, QDOT_ZERO_FOUND);
        assert_true(fabs(sin(8 * u[0])) < 1e-13 && u[0] > 0.5);
        assert_int_equal(between((one){sin, 0, 9, known}, 0, 2, u).answer, QDOT_ZERO_FOUND);
        assert_true(u[0] == 0 || known == 0);
    }
    assert_int_equal(between((one){touch, 0, 1, 1}, 0, 1, u).answer, QDOT_ZERO_FOUND);
    assert_true(fabs(u[0] - 0.3) <= 10 * u[1]);
}

static void
what_is_no_zero_is_told(void **state)
{
    double u[4];

    (void)state;
    assert_int_equal(between((one){pole, 0, 1, 1}, 0, 1, u).answer, QDOT_ZERO_JUMP);
    assert_true(fabs(u[0] - 0.3) < 1e-12);
    assert_int_equal(between((one){above, 0, 1, 1}, 0, 1, u).answer, QDOT_ZERO_NONE);
    assert_int_equal(between((one){flat, 0, 1, 1}, 0, 1, u).answer, QDOT_ZERO_FLAT);
    assert_int_equal(between((one){sin, 8, 9, 1}, 0, 1, u).answer, QDOT_ZERO_NOWHERE);
}

/* Polynomials, their slopes, and errors as those of a run. */
typedef struct {
    enum { NEAR_MISS, FIFTH_ORDER, POINT, DOUBLE_LINE, NOTHING } kind;
    double slope_error[2], size[1];
} shape;

static qdot_status
shape_at(const double *u, double *f, double *error, double *slope, void *user)
{
    shape *x = user;
    const double a = u[0] - 1.1, b = u[1] - 2.3, line = a + 2 * b;
    double J[2] = {0, 0};

    *error = 1e-15;
    x->size[0] = 1;
    x->slope_error[0] = x->slope_error[1] = 1e-13;
    switch (x->kind) {
    case NEAR_MISS: *f = a * a + 1e-5; J[0] = 2 * a; break;
    case FIFTH_ORDER: *f = a * a * a * a * a; J[0] = 5 * a * a * a * a; break;
    case POINT: *f = a * a + 3 * b * b; J[0] = 2 * a; J[1] = 6 * b; break;
    case DOUBLE_LINE: *f = line * line; J[0] = 2 * line; J[1] = 4 * line; break;
    default: *f = 3e-16; J[0] = 2e-14; J[1] = -1e-15;
    }
    if (slope != NULL)
        memcpy(slope, J, sizeof J);
    return QDOT_OK;
}

static qdot_zero_result
search_shape(int kind, double u0, double u1, double *room)
{
    shape x = {.kind = kind};
    const qdot_zero_problem p = {.n = 2, .m = 1, .at = shape_at, .user = &x, .slope_error = x.slope_error,
                                 .size = x.size, .verify = true};
    qdot_zero_result r = {.u = room, .error = room + 2, .f = room + 4, .f_error = room + 5};

    room[0] = u0;
    room[1] = u1;
    assert_int_equal(qdot_zero_find(&p, &r), QDOT_OK);
    return r;
}

static void
a_least_value_is_no_zero(void **state)
{
    double room[6];
    const qdot_zero_result r = search_shape(NEAR_MISS, 0.3, 1, room);

    (void)state;
    assert_int_equal(r.answer, QDOT_ZERO_NONE);
    assert_true(fabs(r.u[0] - 1.1) < 1e-3);
}

static void
errors_grow_with_the_order(void **state)
{
    double room[6];
    const qdot_zero_result r = search_shape(FIFTH_ORDER, 0.4, 1, room);

    (void)state;
    assert_int_equal(r.answer, QDOT_ZERO_FOUND);
    assert_int_equal(r.rank, 1);
    assert_true(fabs(r.u[0] - 1.1) <= r.error[0] && r.error[0] < 0.02);
}

/* What J leaves open is looked at: a point, from beside it and from itself; a line; the whole plane. */
static void
points_are_told_from_families(void **state)
{
    double room[6];
    qdot_zero_result r = search_shape(POINT, 1.7, 2.8, room);

    (void)state;
    assert_int_equal(r.answer, QDOT_ZERO_FOUND);
    assert_int_equal(r.rank, 2);
    assert_true(hypot(r.u[0] - 1.1, r.u[1] - 2.3) <= r.error[0] + r.error[1] && r.error[0] < 1e-5);
    r = search_shape(POINT, 1.1, 2.3, room);
    assert_int_equal(r.answer, QDOT_ZERO_FOUND);
    assert_int_equal(r.rank, 2);
    assert_true(r.error[0] > 1e-9 && r.error[0] < 1e-5);
    r = search_shape(DOUBLE_LINE, 0.5, 1.7, room);
    assert_int_equal(r.answer, QDOT_ZERO_FOUND);
    assert_int_equal(r.rank, 1);
    assert_false(r.vague_rank);
    assert_true(fabs(r.u[0] - 1.1 + 2 * (r.u[1] - 2.3)) <= r.error[0] + 2 * r.error[1]);
    r = search_shape(NOTHING, 0.4, 1.7, room);
    assert_int_equal(r.answer, QDOT_ZERO_FOUND);
    assert_int_equal(r.rank, 0);
    assert_true(r.u[0] == 0.4 && r.u[1] == 1.7 && r.error[0] < 1e-15);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(zeros_of_square_and_tall_systems),
        cmocka_unit_test(a_far_zero_along_a_weak_direction),
        cmocka_unit_test(a_zero_that_is_not_wanted),
        cmocka_unit_test(what_is_not_known_is_no_zero),
        cmocka_unit_test(a_zero_that_may_be_anywhere),
        cmocka_unit_test(a_family_gives_the_near_solution),
        cmocka_unit_test(bounds_lead_to_a_zero),
        cmocka_unit_test(what_is_no_zero_is_told),
        cmocka_unit_test(a_least_value_is_no_zero),
        cmocka_unit_test(errors_grow_with_the_order),
        cmocka_unit_test(points_are_told_from_families),
    };

    return cmocka_run_group_tests_name("zero", tests, NULL, NULL);
}
