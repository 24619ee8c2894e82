/* tape.c -- reads and evaluates finished tapes in double precision. */
#include "tape/tape.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "num/samples.h"
#include "tape/instruction.h"

void
qdot_tape_free(qdot_tape *tape)
{
    if (!tape)
        return;
    qdot_free(tape->constant);
    qdot_free(tape->side);
    qdot_free(tape->low);
    qdot_free(tape->exact);
    qdot_free(tape->output);
    qdot_free(tape->code);
    qdot_free(tape);
}

qdot_status
qdot_tape_check_digits(const qdot_tape *tape)
{
    return tape->approximate ? qdot_fail(QDOT_ENOTBUILT, "not built yet: digits with elliptic functions") : QDOT_OK;
}

size_t
qdot_tape_inputs(const qdot_tape *tape)
{
    return tape->inputs;
}

size_t
qdot_tape_outputs(const qdot_tape *tape)
{
    return tape->outputs;
}

size_t
qdot_tape_work(const qdot_tape *tape)
{
    return tape->places;
}

size_t
qdot_tape_operations(const qdot_tape *tape)
{
    return tape->operations;
}

size_t
qdot_tape_calls(const qdot_tape *tape)
{
    return tape->calls;
}

void
qdot_tape_eval(const qdot_tape *tape, const double *in, double *out, double *work)
{
    static const void *const row[] = {
#define X(ID, ...) &&do_##ID,
#include "tape/operation.def"
#undef X
    };
    const qdot_instruction *i = tape->code, *const end = i + tape->length;

    if (tape->inputs)
        memcpy(work, in, tape->inputs * sizeof *work);
    if (tape->constants)
        memcpy(work + tape->inputs, tape->constant, tape->constants * sizeof *work);
    if (i < end)
        goto *row[i->op];
    goto done;
#define a (work[i->x])
#define b (work[i->y])
#define c (work[i->z])
#define d (work[i->to])
#define e (work[i->y])
#define X(ID, name, operands, operations, calls, statement, ...)                         \
    do_##ID:                                                                             \
    statement;                                                                           \
    if (++i == end)                                                                      \
        goto done;                                                                       \
    goto *row[i->op];
#include "tape/operation.def"
#undef X
#undef a
#undef b
#undef c
#undef d
#undef e
done:
    for (size_t k = 0; k < tape->outputs; k++)
        out[k] = work[tape->output[k]];
}
