/* derivative.c -- computes the columns of a tape's Jacobian, several directions at the same time. */
#include "tape/derivative.h"

#include <math.h>
#include <string.h>

#include "num/batch.h"
#include "num/samples.h"
#include "tape/instruction.h"

#define BATCH_BODY "tape/derivative.def"
#include "num/batch-kinds.def"

typedef void forward(const qdot_tape *tape, double *work, double *slopes);

static forward *const kinds[] = {
    portable_forward,
#ifdef QDOT_X86_KINDS
    avx2_forward,
    avx512_forward,
#endif
};

size_t
qdot_derivative_work(const qdot_tape *tape)
{
    return (1 + QDOT_LANES) * tape->places;
}

/* Set the initial values; the derivatives of the inputs from ... from + count - 1 are the unit
 * directions, all others 0. */
static void
derivative_load(const qdot_tape *tape, const double *in, size_t from, size_t count, double *work,
                double *slopes)
{
    const size_t loaded = tape->inputs + tape->constants;

    if (tape->inputs)
        memcpy(work, in, tape->inputs * sizeof *work);
    if (tape->constants)
        memcpy(work + tape->inputs, tape->constant, tape->constants * sizeof *work);
    memset(slopes, 0, loaded * QDOT_LANES * sizeof *slopes);
    for (size_t j = 0; j < count; j++)
        slopes[(from + j) * QDOT_LANES + j] = 1;
}

void
qdot_derivative_eval(const qdot_tape *tape, const double *in, size_t from, size_t columns,
                     double *out, double *J, double *work)
{
    double *slopes = work + tape->places;

    for (size_t done = 0; done < columns || done == 0; done += QDOT_LANES) {
        size_t count = columns - done < QDOT_LANES ? columns - done : QDOT_LANES;

        derivative_load(tape, in, from + done, count, work, slopes);
        kinds[qdot_batch_kind()](tape, work, slopes);
        for (size_t k = 0; k < tape->outputs; k++)
            memcpy(J + k * columns + done, slopes + tape->output[k] * QDOT_LANES,
                   count * sizeof *J);
    }
    for (size_t k = 0; k < tape->outputs; k++)
        out[k] = work[tape->output[k]];
}
