/* test_rows.c -- a tape at many points gives the numbers that it gives at each. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "tape/random.h"
#include "tape/rows.h"

enum { INPUTS = 3, OUTPUTS = 4, MOST = 3 * QDOT_TAPE_ROWS + 5, TAPES = 400 };

/* Of n points, each number is the same bit by bit, or both are no number. */
static void
compare(const qdot_tape *tape, size_t n, const double *in)
{
    const size_t work = qdot_tape_work(tape);
    double *one = malloc((work + 1) * sizeof *one), *many = malloc((work + 1) * QDOT_TAPE_ROWS * sizeof *many);
    double seen[MOST * OUTPUTS], wanted[OUTPUTS];

    qdot_tape_eval_rows(tape, n, in, seen, many);
    for (size_t k = 0; k < n; k++) {
        qdot_tape_eval(tape, in + k * INPUTS, wanted, one);
        for (size_t i = 0; i < OUTPUTS; i++)
            if (memcmp(&wanted[i], &seen[k * OUTPUTS + i], sizeof *wanted) != 0 &&
                !(wanted[i] != wanted[i] && seen[k * OUTPUTS + i] != seen[k * OUTPUTS + i]))
                fail_msg("point %zu, output %zu: %.17g, not %.17g", k, i, seen[k * OUTPUTS + i], wanted[i]);
    }
    free(one);
    free(many);
}

static void
rows_are_points(void **state)
{
    static const size_t numbers[] = {0, 1, QDOT_TAPE_ROWS - 1, QDOT_TAPE_ROWS, QDOT_TAPE_ROWS + 1, MOST};
    double in[MOST * INPUTS];

    (void)state;
    for (size_t i = 0; i < MOST * INPUTS; i++)
        in[i] = ((double)roll(20001) - 10000) / 2500;
    for (int k = 0; k < TAPES; k++) {
        qdot_pool *pool = qdot_pool_new();
        qdot_expr have[30], inputs[INPUTS];
        qdot_tape *tape;

        for (int i = 0; i < INPUTS; i++)
            have[i] = inputs[i] = coordinate(pool, "q", i);
        for (unsigned i = INPUTS; i < 30; i++)
            have[i] = random_node(pool, have, i < 12 ? i : 12);
        if (qdot_tape_new(pool, INPUTS, inputs, OUTPUTS, have + 30 - OUTPUTS, &tape) == QDOT_OK) {
            compare(tape, numbers[(size_t)k % (sizeof numbers / sizeof *numbers)], in);
            qdot_tape_free(tape);
        }
        qdot_pool_free(pool);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(rows_are_points)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
