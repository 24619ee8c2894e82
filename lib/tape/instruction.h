/* instruction.h -- the data of a finished tape.
 *
 * Its places, in order: the inputs, the constants, computed values.
 */
#ifndef QDOT_TAPE_INSTRUCTION_H
#define QDOT_TAPE_INSTRUCTION_H

#include "expr/id.h"

typedef enum {
#define X(ID, ...) QDOT_OP_##ID,
#include "tape/operation.def"
#undef X
    QDOT_OP_COUNT,
    /* Operations that exist only while a tape is being written: */
    QDOT_OP_INPUT = QDOT_OP_COUNT, /* a: index of the input */
    QDOT_OP_CONSTANT,              /* a: index of the constant */
    QDOT_OP_SECOND /* a: the SINCOS instruction of which this is the second result, the cosine */
} qdot_op;

typedef struct {
    const char *name;
    int operands, operations, calls;
} qdot_operation;

extern const qdot_operation qdot_operations[QDOT_OP_COUNT];

/* An instruction of the finished tape; operands are places in the work space. For SINCOS y is the cosine's. */
typedef struct {
    uint32_t op, to, x, y, z;
} qdot_instruction;

struct qdot_tape {
    bool approximate; /* it holds limits of which a fixed number of steps is made, to 28 digits (elliptic.h) */
    size_t inputs, constants, outputs, length, places, operations, calls;
    double *constant;       /* [constants] the constants as doubles */
    signed char *side;      /* [constants] sign of the exact value less the double; of a factor 1, by
                               how many doubles rounding moves what it multiplies (rounding.h) */
    double *low;            /* [constants] exact constant - its double; 0 in a tape with perturbed constants */
    qdot_expr *exact;       /* [constants] exact constants as expressions, for any precision */
    uint32_t *output;       /* [outputs] place of each output in the work space */
    qdot_instruction *code; /* [length] the instructions */
};

#endif
