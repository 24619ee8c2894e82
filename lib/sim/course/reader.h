/* reader.h -- expressions read along a course, or along several courses at once.
 *
 * Several courses have the time in common. The inputs of their tape are those of each plan, course
 * by course; the expressions hold symbols of their own for each course, with parameter values in
 * place already (sim/read/joint.h).
 */
#ifndef QDOT_SIM_READER_H
#define QDOT_SIM_READER_H

#include "num/past.h"
#include "sim/course/course.h"

/* Expressions along a run, compiled to a tape. */
typedef struct {
    const qdot_plan *plan; /* plan of the first course; borrowed, as all except `tape` */
    size_t m;
    const qdot_expr *exprs; /* [m] the expressions as given */
    qdot_tape *tape; /* outputs: the expressions along one course with its parameter values */
    bool accelerations;     /* `tape` reads q'' or multipliers of some course */
    size_t n_more;          /* number of further courses */
    const qdot_plan *const *more; /* [n_more] plans of the further courses */
    const qdot_expr *inputs;      /* inputs of the tape over all courses */
} qdot_reading;

/* Whether the expression e contains an acceleration q'' or a Lagrange multiplier. */
bool qdot_reading_of_accelerations(const qdot_pool *pool, qdot_expr e);

/* The state of one course (stored run): where it is read, and its position among the inputs of the tape. */
typedef struct {
    const qdot_course *course;
    qdot_trajectory_cursor *cursor;
    size_t n;   /* number of coordinates */
    double *in; /* this course's part of the reader's inputs: q, q', t, q'', lambda, sides of surfaces */
} qdot_reader_course;

/* Evaluates the expressions of a reading at times of its courses. */
typedef struct {
    qdot_reading of;
    size_t n_courses;
    qdot_reader_course *courses; /* [n_courses] the courses */
    qdot_past_reading *past;     /* [n_courses] their histories, of runs with delays; NULL: none has delays */
    int moved; /* k = 1, 2: change states by one double, as at the start of companion run k - 1; 0: leave them */
    double *in; /* [inputs] inputs of the tape */
    double *work;
} qdot_reader;

/* Compile exprs [m] to a tape, which the caller frees; NULL on errors. */
QDOT_MUST_CHECK qdot_status qdot_reader_lower(const qdot_plan *plan, size_t m,
                                              const qdot_expr *exprs, qdot_reading *of);
/* Compile exprs [m] to a tape that is read along the same runs as `other`, of which only the runs are used. */
QDOT_MUST_CHECK qdot_status qdot_reader_lower_beside(const qdot_reading *other, size_t m,
                                                     const qdot_expr *exprs, qdot_reading *of);

/* Initialise a reader along 1 + of->n_more courses. The tape and the courses are borrowed; clear r
 * in any case. */
QDOT_MUST_CHECK qdot_status qdot_reader_init_along(qdot_reader *r, const qdot_reading *of,
                                                   const qdot_course *const *courses);
/* Initialise a reader of expressions along one course. */
QDOT_MUST_CHECK qdot_status qdot_reader_init(qdot_reader *r, const qdot_reading *of,
                                             const qdot_course *course);
void qdot_reader_clear(qdot_reader *r);

/* e, by the inputs of a plan, with lookups in the history of the unknowns that are called as own [2n] says. */
qdot_expr qdot_reader_own_history(const qdot_plan *plan, qdot_expr e, const qdot_expr *own);

/* Let lookups of this thread read the histories of the courses (num/past.h). */
void qdot_reader_recall(const qdot_reader *r);

/* Evaluate the tape at t into out; course k is read in piece number pieces[k], or NULL: in the
 * piece that contains t. */
QDOT_MUST_CHECK qdot_status qdot_reader_read(qdot_reader *r, const size_t *pieces, double t,
                                             double *out);
/* Evaluate along one run at t, in the given piece of it; SIZE_MAX: in the piece that contains t. */
QDOT_MUST_CHECK qdot_status qdot_reader_at(qdot_reader *r, size_t piece, double t,
                                           double *out);

/* Take values [m], read at t, on to t + low by their slopes over h; where one is not finite at t + h it
 * stays. more [m] is room. A failure of reading there (qdot_reader_has_nothing) leaves all. */
QDOT_MUST_CHECK qdot_status qdot_reader_go_on(qdot_reader *r, size_t piece, double t, double h,
                                              double low, double *more, double *values);

/* Whether a failure of reading means that the expression is undefined there, or the course ended.
 *  */
static inline bool
qdot_reader_has_nothing(qdot_status status)
{
    return status == QDOT_EDOMAIN || status == QDOT_EFAILED || status == QDOT_ESINGULAR;
}

/* Bounds for the rounding of the expressions, that of q'' included, where they were read last, at t
 * (tape/rounding.h). Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_reader_roundings(qdot_reader *r, double t, double *bounds);

/* Evaluate the tape for the states in r->in, in the modes of the pieces that were read last. */
QDOT_MUST_CHECK qdot_status qdot_reader_evaluate(qdot_reader *r, double t, double *out);

#endif
