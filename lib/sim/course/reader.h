/* reader.h -- expressions read along a course. */
#ifndef QDOT_SIM_READER_H
#define QDOT_SIM_READER_H

#include "sim/course/course.h"

/* Expressions of a plan, lowered. */
typedef struct {
    const qdot_plan *plan; /* borrowed, as everything except the tape */
    size_t m;
    const qdot_expr *exprs; /* [m] as given */
    qdot_tape *tape;        /* of these with the parameter values of the plan */
    bool accelerations;     /* it reads q'' or multipliers */
} qdot_reading;

/* Reads such expressions along a course. */
typedef struct {
    qdot_reading of;
    qdot_trajectory_cursor *cursor;
    const qdot_course *course;
    int moved;  /* 1, 2: states are moved by one double, as the start of companion 0, 1; 0: not */
    double *in; /* [3n + 1 + m] */
    double *work;
} qdot_reader;

/* Lower exprs [m]; the tape is the caller's to free, NULL on errors. */
QDOT_MUST_CHECK qdot_status qdot_reader_lower(const qdot_plan *plan, size_t m,
                                              const qdot_expr *exprs, qdot_reading *of);

/* The tape and the course are borrowed; clear it in any case. */
QDOT_MUST_CHECK qdot_status qdot_reader_init(qdot_reader *r, const qdot_reading *of,
                                             const qdot_course *course);
void qdot_reader_clear(qdot_reader *r);

/* out [outputs of the tape] at t in the given piece of the run; SIZE_MAX: any piece. */
QDOT_MUST_CHECK qdot_status qdot_reader_at(qdot_reader *r, size_t piece, double t,
                                           double *out);

/* Whether a failure of reading means that the expression is undefined there, or the course ended.
 *  */
static inline bool
qdot_reader_has_nothing(qdot_status status)
{
    return status == QDOT_EDOMAIN || status == QDOT_EFAILED || status == QDOT_ESINGULAR;
}

/* out for the state in r->in [2n], with the equations of the piece that was read last. */
QDOT_MUST_CHECK qdot_status qdot_reader_evaluate(qdot_reader *r, double t, double *out);

#endif
