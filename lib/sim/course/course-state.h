/* course-state.h -- the data of a course (one run with its events): trajectory, occurrences, ends of pieces. */
#ifndef QDOT_SIM_COURSE_STATE_H
#define QDOT_SIM_COURSE_STATE_H

#include "ode/trajectory.h"
#include "sim/bind/bind.h"
#include "sim/course/stage.h"
#include "sim/watch/watch.h"

struct qdot_past;

typedef struct {
    size_t event;
    double t;
    int way; /* sign of d(left - right)/dt of the event: 1 rises, -1 falls; 0: it only touches 0 */
    double within, bend, blur; /* if the event only touches 0: shape of the touch, as in qdot_root */
} qdot_occurrence;

/* A stretch of time in which the function of an event was so small that rounding of the run hides its sign: whether the
 * event occurs there is not known. It has decayed; or, `touched`, it is that of an event that rises or falls and touches 0
 * in the middle of the stretch, as if it had two crossings there that rounding does not tell apart, or none. */
typedef struct {
    size_t event;
    double from, to;
    bool touched;
} qdot_course_faded;

/* The root of a watched function (event, bound or switching surface) at which a piece of the run ended. */
typedef struct {
    size_t piece, function; /* index of the piece; index of the function among those watched in its mode */
    double t;
    qdot_watched what;
    double late; /* t minus the true time of the root; 0: the root is exactly at t */
} qdot_course_end;

/* A disc on a rough plane that came to rest in the piece of the run that begins at t; it has
 * stopped at `after`. */
typedef struct {
    size_t surface;
    double t, after;
} qdot_course_rest;

/* A time during which the motion, oscillating too fast about a surface, is taken to slide along it (chatter.h). */
typedef struct {
    size_t surface;
    double t, end; /* start and end of the time during which the motion is held on the surface */
    double unsure; /* error of the time `end` for a contact that may have begun with u = 0 only within rounding */
    double speed;         /* bound of |du/dt|, u being the surface's function */
    double place;         /* magnitude |u| of the surface's function at the start */
    size_t mode[3];       /* indices of the modes: below the surface, sliding on it, above */
    double *along;        /* [n] a direction in which u changes by 1, then the gradient du/dq [n]; owned */
    bool ended;           /* the motion has left the surface */
    bool steady; /* not an oscillation but a rounding error of a moving position, constant until `end` */
} qdot_course_chatter;

typedef struct qdot_course {
    qdot_stage *stage; /* events, bounds and modes of the run; borrowed */
    bool shaken;
    bool no_series;   /* the method does not use Taylor series */
    bool exact;       /* starts at the user's start state, which is known in double-double precision */
    int early; /* for the two companion runs, +-1: sign of the time shift in qdot_piece_make_up; 0: the run itself */
    double touch_tol; /* an extremum within this tolerance touches 0: that of the run, or less if
                         the run is more exact (sim/error/touches.h) */
    double passed_over; /* the least tolerance by which a touch of an event with a direction was one,
                           and so nothing; 0: there was none */
    /* evaluations for states within steps, and the number that ends the run with QDOT_ELIMIT;
     * 0: no limit */
    uint64_t looked, most_looked;
    double left_out; /* velocities left out in layers about u = 0 so far (layer.h), relative to their scales (ode/scale.h) */
    const struct qdot_course *leader; /* for a companion run: the main run, which decides when a contact lasts; else NULL */
    size_t most_pieces; /* a companion run with more pieces than this is given up; 0: no limit */
    qdot_trajectory tr;
    struct qdot_past *history; /* of a run with delays: its states so far (num/past.h); NULL: none; owned */
    qdot_vec(qdot_bind *) binds;         /* equations of each mode; NULL: the mode has not occurred yet */
    qdot_vec(qdot_ode_system) systems;   /* [modes] the equations of each mode as a system of differential equations */
    qdot_vec(qdot_watch *) watches;      /* [modes] root finders of the modes */
    qdot_vec(qdot_occurrence) occurrences;
    qdot_vec(qdot_course_faded) faded; /* times when rounding hides an event, sorted by time for each event */
    qdot_vec(qdot_course_end) ends; /* roots that ended pieces, sorted by time; one piece may have several at one time */
    qdot_vec(qdot_course_rest) rests;
    qdot_vec(qdot_course_chatter) chatters;
    size_t stopped_by; /* index of the event that stopped the run; SIZE_MAX: no event did */
    char reason[400];  /* why the run ended early; "": it did not */
    bool failed;       /* `reason` is a failure, not an event's `stop` */
    bool began_on;     /* the function of an event, bound or surface was 0 at the start */
} qdot_course;

#endif
