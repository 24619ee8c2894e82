/* test_animation.c -- the page of a moving picture: its data decoded again, its texts escaped. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "show/animation.h"

enum { FRAMES = 4001 };

/* Two columns that move, one that does not, one unknown in part. */
static void
make(qdot_animation *a, const char *title)
{
    const qdot_animation_point point = {{0, 1, 2}};
    const qdot_animation_particle dot = {"<b>&\"", 0, 1};
    const qdot_animation_fact fact = {"run", qdot_strdup("</script><!-- a < b")};

    *a = (qdot_animation){
        .dimension = 2, .t1 = 8, .frames = FRAMES, .speed = 1, .columns = 4};
    a->title = title != NULL ? qdot_strdup(title) : NULL;
    a->values = qdot_calloc(4 * FRAMES, sizeof *a->values);
    assert_non_null(a->values);
    for (int k = 0; k < FRAMES; k++) {
        a->values[k] = 3 + sin(0.01 * k);
        a->values[FRAMES + k] = -1e-7 * k;
        a->values[2 * FRAMES + k] = 2.5;
        a->values[3 * FRAMES + k] = k % 2 == 0 ? k : NAN;
    }
    assert_int_equal(qdot_vec_push(&a->points, point), QDOT_OK);
    assert_int_equal(qdot_vec_push(&a->particles, dot), QDOT_OK);
    assert_int_equal(qdot_vec_push(&a->facts, fact), QDOT_OK);
}

static int
digit_of(char c)
{
    static const char digits[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *found = strchr(digits, c);

    return c != '\0' && found != NULL ? (int)(found - digits) : 0;
}

/* The channel that begins at `at` read back; its length. */
static size_t
decode(const char *at, double *values)
{
    double a, b;
    const char *data = strstr(at, "\"d\":\"");
    unsigned char bytes[3];
    size_t n = 0, used = 0;
    unsigned word = 0;

    assert_int_equal(sscanf(at, "{\"a\":%lf,\"b\":%lf", &a, &b), 2);
    assert_non_null(data);
    for (data += 5; *data != '"'; data += 4) {
        uint64_t three = 0;
        int kept = data[3] != '=' ? 3 : data[2] != '=' ? 2 : 1;

        for (int i = 0; i < 4; i++)
            three = three << 6 | (uint64_t)digit_of(data[i]);
        for (int i = 0; i < 3; i++)
            bytes[i] = (unsigned char)(three >> (16 - 8 * i));
        for (int i = 0; i < kept; i++) {
            word = used % 2 == 0 ? bytes[i] : word | (unsigned)bytes[i] << 8;
            if (used++ % 2 == 1)
                values[n++] = word == 65535 ? NAN : a + b * word;
        }
    }
    return n;
}

/* Within half of 1/65534 of the column's range, which is all that the encoding loses. */
static void
numbers_come_back(void **state)
{
    static double values[FRAMES + 8];
    qdot_animation a;
    qdot_text page = {0};
    const char *at;

    (void)state;
    make(&a, "a run");
    assert_int_equal(qdot_animation_page(&a, &page), QDOT_OK);
    at = strstr(page.at, "\"channels\":[\n");
    assert_non_null(at);
    at += 13;
    for (int i = 0; i < 4; i++) {
        const double *x = a.values + i * FRAMES;
        double range = i == 0 ? 2 : i == 1 ? 1e-7 * FRAMES : FRAMES;

        if (i == 2) {
            assert_true(strncmp(at, "2.5,\n", 5) == 0);
        } else {
            assert_int_equal(decode(at, values), FRAMES);
            for (int k = 0; k < FRAMES; k++) {
                assert_int_equal(isnan(values[k]), isnan(x[k]));
                assert_true(isnan(x[k]) ||
                            fabs(values[k] - x[k]) <= 0.51 / 65534 * range);
            }
        }
        at = strchr(at, '\n') + 1;
    }
    qdot_text_clear(&page);
    qdot_animation_clear(&a);
}

/* The data end where they should: no text of the scene ends the element, and the page loads
 * nothing. */
static void
texts_stay_texts(void **state)
{
    qdot_animation a;
    qdot_text page = {0};
    const char *json, *end;

    (void)state;
    make(&a, "</title><script>alert(1)</script>");
    assert_int_equal(qdot_animation_page(&a, &page), QDOT_OK);
    json = strstr(page.at, "application/json");
    assert_non_null(json);
    end = strstr(json, "</script>");
    assert_non_null(end);
    assert_non_null(strstr(end, "</section>"));
    assert_true(strstr(json, "<!--") == NULL);
    assert_non_null(strstr(json, "\\u003c/script>\\u003c!-- a \\u003c b"));
    assert_null(strstr(page.at, "<script>alert"));
    assert_null(strstr(page.at, "http:"));
    assert_null(strstr(page.at, "https:"));
    assert_null(strstr(page.at, "src="));
    qdot_text_clear(&page);
    qdot_animation_clear(&a);
}

/* Without the data the page is small. */
static void
page_is_small(void **state)
{
    qdot_animation a;
    qdot_text page = {0};

    (void)state;
    make(&a, NULL);
    a.frames = 2;
    assert_int_equal(qdot_animation_page(&a, &page), QDOT_OK);
    assert_true(page.n < 60000);
    assert_true(strncmp(page.at, "<!DOCTYPE html>", 15) == 0);
    assert_string_equal(page.at + page.n - 8, "</html>\n");
    qdot_text_clear(&page);
    qdot_animation_clear(&a);
}

/* At every allocation: QDOT_ENOMEM, nothing lost. */
static void
memory_may_run_out(void **state)
{
    qdot_animation a;
    qdot_status status = QDOT_ENOMEM;

    (void)state;
    make(&a, "a run");
    for (int64_t n = 0; status != QDOT_OK && n < 1000; n++) {
        qdot_text page = {0};

        qdot_memory_fail_at(n);
        status = qdot_animation_page(&a, &page);
        qdot_memory_fail_at(-1);
        assert_true(status == QDOT_OK || status == QDOT_ENOMEM);
        qdot_text_clear(&page);
    }
    assert_int_equal(status, QDOT_OK);
    qdot_animation_clear(&a);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_come_back),
        cmocka_unit_test(texts_stay_texts),
        cmocka_unit_test(page_is_small),
        cmocka_unit_test(memory_may_run_out),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
