/* test_ensemble-steps.c -- what is seen of members on their way. */
#include "expr/exact.h"
#include "sim/ensembles.h"

#include <stdlib.h>

#include "ode/companion.h"

enum { MEMBERS = 13, STATE = 4 };

/* Members of a chain of two from angles apart, the lower one's zeros looked for. */
typedef struct {
    fixture f;
    qdot_ensemble_event event;
    qdot_ensemble_bound bound;
    qdot_ensemble_watching watching;
    qdot_ensemble *e;
    double start[MEMBERS * STATE], y[MEMBERS * STATE];
    qdot_ensemble_result results[MEMBERS];
} members;

static void
run_all(members *x, bool leave, double bound)
{
    chain(&x->f, 2);
    x->f.request.t1 = qdot_expr_int(x->f.pool, 4);
    x->f.request.tol = 1e-10;
    x->event = (qdot_ensemble_event){x->f.scene->coordinates.at[1], -1, 2};
    x->bound = (qdot_ensemble_bound){0, bound};
    x->watching = (qdot_ensemble_watching){
        .n_events = 1, .n_bounds = 1, .events = &x->event, .bounds = &x->bound, .leave = leave};
    x->e = prepare(&x->f, 0, NULL);
    must(qdot_ensemble_follow(x->e, &x->watching, 10000));
    for (size_t i = 0; i < MEMBERS * STATE; i++)
        x->start[i] = i % STATE < 2 ? 0.2 + 0.07 * (double)(i / STATE) : 0;
    memcpy(x->y, x->start, sizeof x->y);
    must(qdot_ensemble_run(x->e, MEMBERS, x->y, NULL, true, x->results));
}

static void
let_go(members *x)
{
    qdot_ensemble_free(x->e);
    end(&x->f);
}

/* The state at a place is that of an ensemble that ends there; an event is a zero there. */
static void
states_and_events_are_of_the_way(void **state)
{
    size_t places, found = 0;
    const double *part = qdot_companion_places(&places);
    members x, short_way;

    (void)state;
    run_all(&x, false, 100);
    for (size_t m = 0; m < MEMBERS; m++) {
        double whole[STATE];

        assert_false(qdot_ensemble_left(x.e, m));
        assert_true(qdot_ensemble_state(x.e, 0, m, places, whole));
        assert_memory_equal(whole, x.y + m * STATE, sizeof whole);
        for (size_t pass = 0; pass < QDOT_ENSEMBLE_PASSES; pass++) {
            assert_true(qdot_ensemble_state(x.e, pass, m, 0, whole));
            assert_true(fabs(qdot_ensemble_time(x.e, 0) - 4 * part[0]) < 1e-12);
            for (size_t k = 0; k < 2; k++) {
                const double t = qdot_ensemble_event_time(x.e, pass, m, 0, k);

                assert_true(isnan(t) || (t > 0 && t <= 4));
                found += !isnan(t);
            }
        }
    }
    assert_true(found >= 3 * MEMBERS);
    /* the run up to the first occurrence ends at 0 */
    for (size_t m = 0; m < 3; m++) {
        const double t = qdot_ensemble_event_time(x.e, 0, m, 0, 0);
        double y[STATE];
        qdot_ensemble_result result;
        char text[64];

        snprintf(text, sizeof text, "%.30f", t);
        chain(&short_way.f, 2);
        short_way.f.request.t1 = number(&short_way.f, text);
        short_way.f.request.tol = 1e-10;
        short_way.e = prepare(&short_way.f, 0, NULL);
        memcpy(y, x.start + m * STATE, sizeof y);
        must(qdot_ensemble_run(short_way.e, 1, y, NULL, false, &result));
        if (!(fabs(y[1]) < 1e-8 && y[3] < 0))
            fail_msg("member %zu: angle %.3g, rate %.3g at its zero", m, y[1], y[3]);
        let_go(&short_way);
    }
    let_go(&x);
}

/* Members that leave when all is found have found the same. */
static void
members_leave_with_the_same_events(void **state)
{
    members whole, leaving;

    (void)state;
    run_all(&whole, false, 100);
    run_all(&leaving, true, 100);
    for (size_t m = 0; m < MEMBERS; m++)
        for (size_t pass = 0; pass < QDOT_ENSEMBLE_PASSES; pass++)
            for (size_t k = 0; k < 2; k++) {
                const double a = qdot_ensemble_event_time(whole.e, pass, m, 0, k);
                const double b = qdot_ensemble_event_time(leaving.e, pass, m, 0, k);

                assert_memory_equal(&a, &b, sizeof a);
            }
    let_go(&whole);
    let_go(&leaving);
}

/* An only companion shows the errors of the method: ends are no further from those under a tighter
 * tolerance than stated, nor much nearer. */
static void
one_companion_shows_the_method(void **state)
{
    members x, close;

    (void)state;
    run_all(&close, false, 100);
    run_all(&x, false, 100);
    qdot_ensemble_free(x.e);
    x.f.request.tol = 1e-7;
    x.e = prepare(&x.f, 0, NULL);
    must(qdot_ensemble_follow(x.e, &x.watching, 10000));
    qdot_ensemble_companions(x.e, 1);
    memcpy(x.y, x.start, sizeof x.y);
    must(qdot_ensemble_run(x.e, MEMBERS, x.y, NULL, true, x.results));
    for (size_t m = 0; m < MEMBERS; m++) {
        const double stated = x.results[m].error;
        double off = 0;

        for (size_t i = m * STATE; i < (m + 1) * STATE; i++)
            off = fmax(off, fabs(x.y[i] - close.y[i]) / fmax(1, fabs(x.y[i])));
        assert_false(qdot_ensemble_left(x.e, m));
        if (!(off <= stated && stated <= 3 * off))
            fail_msg("member %zu: off by %.3g, stated %.3g", m, off, stated);
    }
    let_go(&x);
    let_go(&close);
}

/* A bound that the first angle swings past leaves all members that reach it. */
static void
members_near_a_bound_are_left(void **state)
{
    members x;

    (void)state;
    run_all(&x, false, -0.5);
    assert_false(qdot_ensemble_left(x.e, 0)); /* it swings between -0.3 and 0.3 */
    assert_true(qdot_ensemble_left(x.e, MEMBERS - 1));
    let_go(&x);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(states_and_events_are_of_the_way),
        cmocka_unit_test(members_leave_with_the_same_events),
        cmocka_unit_test(one_companion_shows_the_method),
        cmocka_unit_test(members_near_a_bound_are_left),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
