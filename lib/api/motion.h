/* motion.h -- inside of lib/api: a run of the equations of motion that the caller of the library holds. */
#ifndef QDOT_API_MOTION_H
#define QDOT_API_MOTION_H

#include "api/system.h"
#include "base/memory.h"
#include "lang/session/runs.h"

struct qdot_motion {
    qdot_system *system; /* the system to which the run belongs; this counts as one use of it */
    qdot_named_run run;  /* the run; held here even if the session forgets it */
    bool named;          /* the session keeps the run, too, when the motion is freed */
    qdot_arena *arena;
    const char **coordinates; /* names of the coordinates [qdot_motion_coordinates], in the arena */
};

/* The index of the run among the session's runs; runs.n if the session no longer has it. */
size_t qdot_api_place(const qdot_motion *motion);

#endif
