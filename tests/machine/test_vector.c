/* test_vector.c -- lanes as they should be after each operation, by code that is run. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "machine/asm.h"
#include "num/kinds.h"
#include "series/taylor-text.h"

enum { LANES = 8, FREE = 8 };

typedef void function(const double *in, double *out);

/* Runs what was written; in: two vectors, perhaps a double whose bits are all 1. */
static void
run(qdot_asm *x, const double *in, double *out)
{
    qdot_taylor_text *text = qdot_calloc(1, sizeof *text);
    const unsigned char *first;
    function *f;

    assert_non_null(text);
    atomic_init(&text->users, 1);
    qdot_asm_return(x);
    assert_int_equal(x->status, QDOT_OK);
    assert_true(qdot_taylor_text_fill(text, x->bytes.at, x->bytes.n));
    first = qdot_taylor_text_first(text);
    memcpy(&f, &first, sizeof f);
    f(in, out);
    qdot_taylor_text_give(text);
    qdot_free(x->bytes.at);
}

static const double numbers[2 * LANES] = {3, -5, 7, 11, -13, 17, 19, -23,
                                          2, 4,  -6, 8, 10, -12, 14, 16};

static void
all(qdot_asm *m, qdot_asm_operation op, int reg, int first, qdot_operand b)
{
    qdot_asm_do(m, op, QDOT_ASM_ALL, reg, first, b);
}

static qdot_operand
in(size_t i)
{
    return qdot_asm_at(QDOT_ASM_ROWS, (int32_t)(i * sizeof(double)));
}

/* Low and high in registers or in memory, or no high. */
static void
lanes_slide(void **state)
{
    (void)state;
    if (!qdot_asm_is_here())
        skip();
    for (int how = 0; how < 8; how++) {
        const bool low_in_memory = how & 1, high_in_memory = how & 2, last = how & 4;
        qdot_asm x = {.kind = qdot_asm_kind()};
        const int n = qdot_asm_lanes(&x), a = FREE, b = FREE + 1;
        const qdot_operand low = low_in_memory ? in(0) : qdot_asm_in(a);
        const qdot_operand high = high_in_memory ? in(LANES) : qdot_asm_in(b);
        double out[LANES];

        qdot_asm_begin_lanes(&x);
        all(&x, QDOT_ASM_LOAD, a, 0, in(0));
        all(&x, QDOT_ASM_LOAD, b, 0, in(LANES));
        qdot_asm_slide(&x, low_in_memory ? 0 : a, low, last ? NULL : &high, 1);
        all(&x, QDOT_ASM_STORE, low_in_memory ? 0 : a, 0,
            qdot_asm_at(QDOT_ASM_CONSTANTS, 0));
        run(&x, numbers, out);
        for (int i = 0; i < n; i++)
            assert_true(out[i] == (i < n - 1 ? numbers[i + 1] : last ? 0 : numbers[LANES]));
    }
}

/* The products of lanes that were known before the newest, and with it, as it goes on. */
static void
lanes_come_to_be_known(void **state)
{
    (void)state;
    if (!qdot_asm_is_here())
        skip();
    for (int newest = 0; newest < LANES; newest++)
        for (qdot_asm_lane_set lanes = QDOT_ASM_ALL_LANES; lanes <= QDOT_ASM_KNOWN_LANES;
             lanes++) {
            qdot_asm x = {.kind = qdot_asm_kind()};
            const int n = qdot_asm_lanes(&x);
            double of[2 * LANES + 1], out[LANES];

            memcpy(of, numbers, sizeof numbers);
            memset(of + 2 * LANES, 0xff, sizeof *of);
            qdot_asm_begin_lanes(&x);
            qdot_asm_first_lane(&x, in(2 * LANES));
            for (int i = 0; i < newest; i++)
                qdot_asm_next_lane(&x);
            all(&x, QDOT_ASM_LOAD, FREE, 0, in(LANES));
            all(&x, QDOT_ASM_SPREAD, FREE + 1, 0, in(2));
            qdot_asm_add_product(&x, FREE, FREE + 1, in(0), lanes, 1);
            all(&x, QDOT_ASM_STORE, FREE, 0, qdot_asm_at(QDOT_ASM_CONSTANTS, 0));
            run(&x, of, out);
            for (int i = 0; i < n; i++) {
                const bool added = lanes == QDOT_ASM_ALL_LANES || i < newest ||
                                   (lanes == QDOT_ASM_KNOWN_LANES && i == newest);

                assert_true(out[i] == numbers[LANES + i] + (added ? 7 * numbers[i] : 0));
            }
        }
}

/* AVX-512 alone. */
static void
a_lane_is_inserted(void **state)
{
    qdot_asm x = {.kind = 2};
    double out[LANES];

    (void)state;
    if (qdot_asm_kind() < 2)
        skip();
    qdot_asm_first_lane(&x, in(0));
    qdot_asm_next_lane(&x);
    all(&x, QDOT_ASM_LOAD, FREE, 0, in(0));
    qdot_asm_insert(&x, FREE, in(LANES));
    all(&x, QDOT_ASM_STORE, FREE, 0, qdot_asm_at(QDOT_ASM_CONSTANTS, 0));
    run(&x, numbers, out);
    for (int i = 0; i < LANES; i++)
        assert_true(out[i] == (i == 1 ? numbers[LANES] : numbers[i]));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lanes_slide),
        cmocka_unit_test(lanes_come_to_be_known),
        cmocka_unit_test(a_lane_is_inserted),
    };
    int failed = 0;

    for (size_t kind = qdot_asm_kind() + 1; kind-- > 0;) {
        qdot_kind_limit(kind);
        failed += cmocka_run_group_tests(tests, NULL, NULL);
    }
    return failed;
}
