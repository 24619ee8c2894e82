/* work.c -- counts the operations of one Taylor expansion of a motion. */
#include "sim/form/work.h"

qdot_work
qdot_work_of_motion(const qdot_plan *plan, const qdot_motion *motion,
                    const qdot_tape *tape)
{
    /* products of K in explicit equations are not steps (series/taylor-motion.h) */
    const size_t written = qdot_motion_is_explicit(motion) ? motion->written : 0;
    qdot_work w = {.coordinates = (double)plan->n,
                   .length =
                       (double)(motion->program.length - motion->program.still - written),
                   .convolutions = motion->program.convolutions,
                   .calls = (double)qdot_tape_calls(tape),
                   .operations = (double)qdot_tape_operations(tape)};
    size_t k = 0;

    for (size_t b = 0; b + 1 < motion->blocks.n; b++, k++) {
        const double n = (double)(motion->blocks.at[b + 1] - motion->blocks.at[b]);

        if (n < 2)
            continue;
        w.unknowns += n;
        w.squares += n * n;
        w.cubes += n * n * n;
        while (!plan->constraints && plan->blocks[k].n == 1) /* skip blocks of one unknown, which are given explicitly */
            k++;
        if (!plan->constraints && plan->blocks[k].constant)
            continue;
        w.factored += n;
        w.factored_cubes += n * n * n;
    }
    return w;
}
