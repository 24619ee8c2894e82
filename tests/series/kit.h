/* kit.h -- series of a tape, for tests. */
#ifndef TESTS_SERIES_KIT_H
#define TESTS_SERIES_KIT_H

#include "series/taylor.h"
#include "tape/tape.h"

/* The series of a tape whose inputs from `moving` on are numbers. */
static inline qdot_status
taylor_moving(const qdot_tape *tape, size_t moving, int most, qdot_taylor **taylor)
{
    qdot_program program;
    qdot_status status;

    *taylor = NULL;
    QDOT_TRY(qdot_program_init(tape, moving, false, &program));
    status = qdot_taylor_of_program(&program, false, most, taylor);
    qdot_program_clear(&program);
    return status;
}

static inline qdot_status
taylor_of_tape(const qdot_tape *tape, int most, qdot_taylor **taylor)
{
    return taylor_moving(tape, qdot_tape_inputs(tape), most, taylor);
}

#endif
