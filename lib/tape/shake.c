/* shake.c -- copies a tape with its constants replaced by neighbouring doubles, to show rounding errors. */
#include "tape/shake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "tape/instruction.h"

static void *
copy_bytes(const void *from, size_t size)
{
    void *to = qdot_malloc(size);

    if (to && size)
        memcpy(to, from, size);
    return to;
}

qdot_status
qdot_tape_shake(const qdot_tape *tape, qdot_tape **shaken)
{
    qdot_tape *t = copy_bytes(tape, sizeof *t);

    *shaken = NULL;
    if (!t)
        return QDOT_ENOMEM;
    t->constant = copy_bytes(tape->constant, t->constants * sizeof *t->constant);
    t->side = copy_bytes(tape->side, t->constants * sizeof *t->side);
    t->low = qdot_calloc(t->constants, sizeof *t->low);
    t->exact = copy_bytes(tape->exact, t->constants * sizeof *t->exact);
    t->output = copy_bytes(tape->output, t->outputs * sizeof *t->output);
    t->code = copy_bytes(tape->code, t->length * sizeof *t->code);
    if (!t->constant || !t->side || !t->low || !t->exact || !t->output || !t->code) {
        qdot_tape_free(t);
        return QDOT_ENOMEM;
    }
    for (size_t i = 0; i < t->constants; i++)
        t->constant[i] = qdot_shake_double(t->constant[i], t->side[i]);
    *shaken = t;
    return QDOT_OK;
}

double
qdot_shake_double(double x, int side)
{
    for (int k = 0; k < abs(side); k++)
        x = nextafter(x, side * INFINITY);
    return x;
}
