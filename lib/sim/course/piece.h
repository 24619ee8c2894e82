/* piece.h -- a piece of a course: what is known while it is integrated and where it ends.
 *
 * For course.c only. The loop over pieces is there; here the sides that a piece goes by are
 * found (side-search.c, piece-sides.c), their mode is entered (piece-enter.c), the piece is
 * integrated from its start with every step looked at (piece.c), and what happens where it ends
 * is done (piece-end.c).
 *
 * Tests  as course.h
 */
#ifndef QDOT_SIM_PIECE_H
#define QDOT_SIM_PIECE_H

#include "sim/course/course-state.h"

typedef enum {
    QDOT_PIECE_GOES_ON,
    QDOT_PIECE_RETRIED, /* broken off behind its first step: x->well says why */
    QDOT_PIECE_ENDS     /* at t_act */
} qdot_piece_intent;

/* How often a thing happened since. */
typedef struct {
    qdot_watched_kind kind;
    size_t index, n; /* n: how often since `since` */
    double since;
    double last, interval, ratio; /* the last time, how long before it the one before was, and
                                     that over the interval before */
    size_t steady;                /* how often that ratio was the same, in a row */
} qdot_piece_repeat;

/* A surface that the motion does not leave towards the side at hand: what else there is. */
typedef struct {
    size_t surface, n;
    long sides[3]; /* [n] the first one is that at hand */
} qdot_piece_doubt;

/* The arrays and the cursor belong to course.c, which frees them. */
typedef struct {
    qdot_course *c;
    const qdot_ode_options *options;
    const qdot_ode_method *method;
    double t1, direction;
    size_t n;           /* of y */
    size_t mode;        /* of the piece */
    struct {
        double t, *y; /* [n] */
        size_t from;  /* the mode before */
        bool jumped;  /* an event has changed the state */
    } start;
    long *side;         /* [surfaces] */
    bool *functions_on; /* [functions] likewise */
    int *before;        /* [functions] */
    int *signs;         /* [functions] of the mode before, where its piece ended */
    double *residual;   /* [functions] */
    bool first_step;
    /* The sides: tried, then other ones beside those that go well, then known. */
    enum { QDOT_SIDES_TRIED, QDOT_SIDES_COMPARED, QDOT_SIDES_KNOWN } search;
    bool well;          /* RETRIED: the motion leaves to its sides, others may do as well */
    bool far; /* the step needed no look */

    /* What the step at hand showed. */
    qdot_piece_intent intent;
    double t_act;
    double *y_act;             /* [n] the state there, of methods without series */
    bool broken_off;           /* by us, so that it is no failure */
    qdot_vec(qdot_root) roots; /* that occur at t_act */
    qdot_vec(qdot_root) fired; /* those that ended the piece before */
    qdot_vec(size_t) crossed;  /* the surfaces among these, of a state that did not jump */
    size_t noted;              /* occurrences before this step */

    /* Reading within the step. */
    qdot_watch_reader reader;
    const qdot_ode_expanded *expanded;
    qdot_trajectory step; /* its two ends */
    qdot_trajectory_cursor *cursor;
    double *y;      /* [n] scratch */
    size_t resting; /* the event of a contact that lasts */

    /* Sides tried from one point: [tries x surfaces]; the surfaces in doubt. */
    qdot_vec(long) tried;
    qdot_vec(qdot_piece_doubt) doubts;
    /* Times at which things happened, by kind and index. */
    qdot_vec(qdot_piece_repeat) repeats;
} qdot_piece;

static inline const qdot_mode *
qdot_piece_mode(const qdot_piece *x)
{
    return x->c->stage->modes.at[x->mode];
}

static inline qdot_watch *
qdot_piece_watch(const qdot_piece *x)
{
    return x->c->watches.at[x->mode];
}

/* The sides of a piece from its start, decided from x->side; old [surfaces]: those that held
 * before, NULL: all are decided anew. Errors as qdot_stage_sides. */
QDOT_MUST_CHECK static inline qdot_status
qdot_piece_sides(qdot_piece *x, const long *old)
{
    return qdot_stage_sides(x->c->stage, x->start.t, x->start.y, old, x->side);
}

/* Everything of the mode with the sides x->side, which becomes x->mode. */
QDOT_MUST_CHECK qdot_status qdot_piece_enter(qdot_piece *x);

/* One piece from its start, the last point, by the sides that it leaves well; x->side are what
 * is tried first. c->reason where there are none, or more than one way to go on. */
QDOT_MUST_CHECK qdot_status qdot_piece_search(qdot_piece *x);

/* What is known of the functions where the piece before ended, by those of the mode at hand. */
void qdot_piece_carry(qdot_piece *x);

/* What is asked of a mode that is tried before it is integrated, with what is known of its
 * functions: c->reason where it cannot be entered. */
QDOT_MUST_CHECK qdot_status qdot_piece_cross(qdot_piece *x, bool first);

/* A piece ends at the first double behind the root that ends it, in all courses alike: that is
 * late, and never early, which adds up. A companion goes on as if it had left before the root,
 * the other one as if later still: by half the time between doubles. In this time it goes by
 * one mode, and takes back what it went by the other; SIZE_MAX is none. */
QDOT_MUST_CHECK qdot_status qdot_piece_make_up(qdot_piece *x, size_t by, size_t instead_of);
/* Whether a companion's state may be moved so: not along constraints. */
bool qdot_piece_makes_up(const qdot_piece *x);

/* The watch of x->mode, at the start of a piece: x->before and x->residual say what is known
 * of its functions there, x->functions_on is made. Errors as qdot_watch_begin. */
QDOT_MUST_CHECK qdot_status qdot_piece_begin(qdot_piece *x);

/* Integrate from the start, the last point of the trajectory, to x->t1 or to what ends the
 * piece: then x->intent, x->t_act and x->roots say where and what; c->reason, if it is a
 * contact that lasts. Errors as qdot_trajectory_resume. */
QDOT_MUST_CHECK qdot_status qdot_piece_integrate(qdot_piece *x);

/* All that occurs at x->t_act, in order; x->start.y is the state there, and then the one
 * behind. *over: the run ends, for c->reason or for the event c->stopped_by; x->start.jumped:
 * the state has been changed. QDOT_EDOMAIN where an event gives a value that is none. */
QDOT_MUST_CHECK qdot_status qdot_piece_act(qdot_piece *x, bool *over);

/* The run ends here, for a reason that is a failure or not. */
void qdot_piece_stop(qdot_piece *x, bool failed);

/* After a first step: whether the motion leaves all surfaces towards the sides that it goes
 * by. Where not, x->side has other ones and x->doubts the surfaces. */
QDOT_MUST_CHECK qdot_status qdot_piece_leaves_well(qdot_piece *x, bool *well);

/* Where it does: whether other sides might do as well. */
bool qdot_piece_is_open(const qdot_piece *x);
/* x->doubts become the surfaces of which that is so. */
QDOT_MUST_CHECK qdot_status qdot_piece_doubt_open(qdot_piece *x);

#endif
