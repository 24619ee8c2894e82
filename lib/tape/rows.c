/* rows.c -- evaluates a tape at many points, a block of them at a time. */
#include "tape/rows.h"

#include <math.h>
#include <string.h>

#include "num/samples.h"
#include "tape/instruction.h"

enum { ROWS = QDOT_TAPE_ROWS };

static void
evaluate_block(const qdot_tape *tape, double *work)
{
    double first[ROWS], second[ROWS]; /* results, apart from the operands, whose places they may get */

    for (const qdot_instruction *i = tape->code, *const end = i + tape->length; i < end; i++) {
        const double *const x = work + (size_t)i->x * ROWS, *const y = work + (size_t)i->y * ROWS,
                     *const z = work + (size_t)i->z * ROWS;

        switch ((qdot_op)i->op) {
#define a (x[r])
#define b (y[r])
#define c (z[r])
#define d (first[r])
#define e (second[r])
#define X(ID, name, operands, operations, calls, statement, ...)                         \
    case QDOT_OP_##ID:                                                                   \
        for (int r = 0; r < ROWS; r++) {                                                 \
            statement;                                                                   \
        }                                                                                \
        break;
#include "tape/operation.def"
#undef X
#undef a
#undef b
#undef c
#undef d
#undef e
        default: break; /* others are no operations of a finished tape */
        }
        memcpy(work + (size_t)i->to * ROWS, first, sizeof first);
        if (i->op == QDOT_OP_SINCOS)
            memcpy(work + (size_t)i->y * ROWS, second, sizeof second);
    }
}

/* The inputs of `rows` points, each to its places; the last point stands for those that are missing in the block. */
static void
spread_inputs(const qdot_tape *tape, size_t rows, const double *in, double *work)
{
    for (size_t i = 0; i < tape->inputs; i++)
        for (size_t r = 0; r < ROWS; r++)
            work[i * ROWS + r] = in[(r < rows ? r : rows - 1) * tape->inputs + i];
}

void
qdot_tape_eval_rows(const qdot_tape *tape, size_t n, const double *in, double *out, double *work)
{
    for (size_t k = 0; k < tape->constants; k++)
        for (size_t r = 0; r < ROWS; r++)
            work[(tape->inputs + k) * ROWS + r] = tape->constant[k];
    for (size_t at = 0; at < n; at += ROWS) {
        const size_t rows = n - at < ROWS ? n - at : ROWS;

        spread_inputs(tape, rows, in + at * tape->inputs, work);
        evaluate_block(tape, work);
        for (size_t r = 0; r < rows; r++)
            for (size_t k = 0; k < tape->outputs; k++)
                out[(at + r) * tape->outputs + k] = work[(size_t)tape->output[k] * ROWS + r];
    }
}
