/* test_relative.c -- chains of angles are products in their differences; what is no function of these is left alone. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "normal/prove/decide.h"
#include "normal/simplify/relative.h"
#include "normal/text.h"

static const struct {
    const char *from, *to; /* to NULL: nothing is found */
} forms[] = {
    {"v*(sin(x - z) - sin(x - 2*y + z))/(2*L)", "v*cos(x - y)*sin(y - z)/L"},
    {"sin(x)*cos(z) - cos(x)*sin(z) - sin(x - y)*cos(y - z)", "cos(x - y)*sin(y - z)"},
    {"m*cos(x)^2 + m*sin(x)^2 + k*sin(x)*sin(y) + k*cos(x)*cos(y)", "m + k*cos(x - y)"},
    {"(cos(x - y)*cos(x) - cos(y))^2 + (cos(x - y)*sin(x) - sin(y))^2", "sin(x - y)^2"},
    {"sin(x)*cos(y)", NULL}, /* turns with both */
    {"x*cos(x - y)", NULL},  /* an angle outside */
    {"cos(x - y + 1)", NULL},
    {"cos(x/2 - y/2)", NULL},
    {"sin(x)*cos(y)/sin(z)", NULL},
    {"cos(x)*cos(z)/sin(y - z) + sin(x)*sin(z)/sin(y - z)", "cos(x - z)/sin(y - z)"},
    {"sin(x)^2", NULL},
    {"m*k", NULL},
};

static void
differences_are_found(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    const qdot_facts facts = {0};

    (void)state;
    (void)text_read(pool, "x + y + z"); /* names in the order of a scene */
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        const qdot_expr e = text_read(pool, forms[i].from), got = qdot_simplify_relative(pool, e, &facts);

        if (forms[i].to == NULL) {
            if (got != QDOT_NIL)
                fail_msg("%s: a form was found", forms[i].from);
            continue;
        }
        if (got != text_read(pool, forms[i].to))
            fail_msg("%s: another form", forms[i].from);
    }
    assert_int_equal(qdot_pool_check(pool), QDOT_OK);
    qdot_pool_free(pool);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(differences_are_found),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
