/* test_page-curves.c -- figures of curves on a page: where they end, what the key and the axes say. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "show/page-curves.h"

static size_t
count(const char *text, const char *what)
{
    size_t n = 0;

    for (; (text = strstr(text, what)) != NULL; text++)
        n++;
    return n;
}

/* The ends of the curve are where its axes say; what is not finite breaks it. */
static void
course_has_its_ends(void **state)
{
    static double y[5001];
    const qdot_page_course c = {NULL, 0, 10, 5001, y};
    qdot_text out = {0};
    const char *curve, *last = NULL;

    (void)state;
    for (int k = 0; k < 5001; k++)
        y[k] = k;
    qdot_page_courses(&out, "a<b", 1, &c);
    assert_non_null(strstr(out.at, "a&lt;b against t"));
    curve = strstr(out.at, "class=\"curve\" d=\"M64.0 ");
    assert_non_null(curve);
    for (const char *at = curve; (at = strchr(at, 'L')) != NULL; at++)
        last = at;
    assert_true(strncmp(last, "L622.0 ", 7) == 0);
    qdot_text_clear(&out);
    for (int k = 0; k < 5001; k++)
        y[k] = NAN;
    qdot_page_courses(&out, "none", 1, &c);
    assert_int_equal(out.n, 0);
    qdot_text_clear(&out);
}

/* Both are drawn to one scale, over both times; the key names them. */
static void
courses_share_their_axes(void **state)
{
    const double up[] = {0, 1, 2}, far[] = {-3, -3.5, -4};
    const qdot_page_course list[] = {{"up", 0, 1, 3, up}, {"<far>", 4, 2, 3, far}};
    qdot_text out = {0};

    (void)state;
    qdot_page_courses(&out, "x", 2, list);
    assert_int_equal(qdot_text_status(&out), QDOT_OK);
    assert_non_null(strstr(out.at, "class=\"curve\" d=\"M64.0 "));
    assert_non_null(strstr(out.at, "L203.5 ")); /* t = 1 of 0 .. 4 */
    assert_non_null(strstr(out.at, "class=\"curve\" d=\"M622.0 ")); /* backwards from 4 */
    assert_non_null(strstr(out.at, ">up</text>"));
    assert_non_null(strstr(out.at, ">&lt;far&gt;</text>"));
    assert_non_null(strstr(out.at, ">\u22124</text>"));
    assert_int_equal(count(out.at, "<g class=\"dashed k"), 2);
    qdot_text_clear(&out);
}

/* Marks where both numbers are above 0, powers of ten at the axes. */
static void
logarithms_of_positive_points(void **state)
{
    const double x[] = {1e-3, 1e-2, 0, 1e-1}, y[] = {1e-6, 1e-9, 1e-10, NAN};
    const qdot_page_points list[] = {{"a", 4, x, y}};
    qdot_text out = {0};

    (void)state;
    qdot_page_log_log(&out, "caption", "time", "error", 1, list);
    assert_int_equal(count(out.at, "class=\"mark\""), 2 + 1); /* one of the key */
    assert_non_null(strstr(out.at, "M64.0 10.0L622.0 "));
    assert_non_null(strstr(out.at, ">\u22129</tspan>"));
    assert_non_null(strstr(out.at, ">time</text>"));
    assert_non_null(strstr(out.at, ">error</text>"));
    qdot_text_clear(&out);
    qdot_page_log_log(&out, "caption", "time", "error", 1,
                      &(qdot_page_points){"none", 1, x + 2, y});
    assert_int_equal(out.n, 0);
    qdot_text_clear(&out);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(course_has_its_ends),
        cmocka_unit_test(courses_share_their_axes),
        cmocka_unit_test(logarithms_of_positive_points),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
