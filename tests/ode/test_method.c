#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include "ode/method.h"
#include "ode/problems.h"

static void
every_row_is_found_by_its_name(void **state)
{
    (void)state;
    assert_int_equal(qdot_ode_method_count(), 15);
    for (size_t i = 0; i < qdot_ode_method_count(); i++) {
        const qdot_ode_method *m = qdot_ode_method_at(i), *partner;

        assert_ptr_equal(qdot_ode_method_find(m->name), m);
        partner = qdot_ode_method_find(m->partner);
        assert_non_null(partner);
        assert_false(partner->multistep);
        assert_true(!partner->needs_jacobian || m->needs_jacobian);
        assert_string_not_equal(m->fits, "");
    }
    assert_null(qdot_ode_method_at(15));
    assert_null(qdot_ode_method_find("rk9"));
}

/* From the errors at h and h/4, Henon-Heiles against its Taylor series in long double. */
static void
order_matches_table(void **state)
{
    static const struct {
        const char *name;
        double h;
    } rows[] = {{"rk8pd", 0.4}, {"rkf45", 0.04}, {"bsimp", 4}};

    (void)state;
    for (size_t i = 0; i < 3; i++) {
        const qdot_ode_method *m = qdot_ode_method_find(rows[i].name);
        double error[2], seen;

        for (int k = 0; k < 2; k++) {
            qdot_ode_options o = {.tol = 1, .h_fixed = rows[i].h / (k ? 4 : 1)};
            qdot_ode_result r;
            double y[4];

            memcpy(y, henon.y0, sizeof y);
            assert_int_equal(qdot_ode_integrate(&henon.system, m, &o, 0, 8, y, &r),
                             QDOT_OK);
            assert_int_equal(r.stats.steps, (uint64_t)round(8 / o.h_fixed));
            error[k] = true_error(&henon, 8, y);
        }
        seen = log2(error[0] / error[1]) / 2;
        if (fabs(seen - m->order) > 0.5)
            fail_msg("%s: order %.2f (%g, %g), table says %d", m->name, seen, error[0],
                     error[1], m->order);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_row_is_found_by_its_name),
        cmocka_unit_test(order_matches_table),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
