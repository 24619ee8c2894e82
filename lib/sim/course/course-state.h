/* course-state.h -- the data of a course: trajectory, systems by mode, occurrences, ends. */
#ifndef QDOT_SIM_COURSE_STATE_H
#define QDOT_SIM_COURSE_STATE_H

#include "ode/trajectory.h"
#include "sim/bind/bind.h"
#include "sim/course/stage.h"
#include "sim/watch/watch.h"

typedef struct {
    size_t event;
    double t;
    int way; /* left - right as t grows: 1 rises, -1 falls, 0 touches 0 */
    double within, bend, blur; /* if the event only touches: shape of the touch, as in qdot_root */
} qdot_occurrence;

/* A stretch of time in which the function of an event was so small that rounding of the run hides its sign: whether the
 * event occurs there is not known. It has decayed; or, `touched`, it is that of an event that rises or falls and touches 0
 * in the middle of the stretch, as if it had two crossings there that rounding does not tell apart, or none. */
typedef struct {
    size_t event;
    double from, to;
    bool touched;
} qdot_course_faded;

/* The root of a watched function at which a piece ended. */
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

/* The motion was taken to slide along a surface about which it oscillates too fast (sim/course/chatter.h). */
typedef struct {
    size_t surface;
    double t, end; /* start and end of the time during which the motion is held on the surface */
    double unsure; /* error of `end` for a contact, which may have begun with u = 0 only within rounding */
    double speed;         /* bound of |du/dt| */
    double place;         /* magnitude |u| at the start */
    size_t mode[3];       /* indices of the modes: below the surface, sliding on it, above */
    double *along;        /* [n] a direction with du = 1, then the slopes du/dq [n]; owned */
    bool ended;           /* the motion has left the surface */
    bool steady; /* no oscillation: rounding error of a moving position, constant until `end` */
} qdot_course_chatter;

typedef struct qdot_course {
    qdot_stage *stage; /* events, bounds and modes of the run; borrowed */
    bool shaken;
    bool no_series;   /* the method does not use Taylor series */
    bool exact;       /* starts at the requested start, which is known in two doubles */
    int early; /* for companions +-1: sign of the shift in qdot_piece_make_up; 0: the run itself */
    double touch_tol; /* an extremum within this tolerance touches 0: that of the run, or less if
                         the run is more exact (sim/error/touches.h) */
    double passed_over; /* the least tolerance by which a touch of an event with a direction was one,
                           and so nothing; 0: there was none */
    /* evaluations for states within steps, and the number that ends the run with QDOT_ELIMIT;
     * 0: no limit */
    uint64_t looked, most_looked;
    double left_out; /* velocities omitted by layers so far, relative to their scales (ode/scale.h) */
    const struct qdot_course *leader; /* for a companion: the run, which decides when a contact lasts; else NULL */
    size_t most_pieces; /* a companion with more pieces is given up; 0: no limit */
    qdot_trajectory tr;
    qdot_vec(qdot_bind *) binds;         /* by mode; NULL for modes that have not occurred yet */
    qdot_vec(qdot_ode_system) systems;   /* [modes] the same as systems of differential equations */
    qdot_vec(qdot_watch *) watches;      /* [modes] root finders of the modes */
    qdot_vec(qdot_occurrence) occurrences;
    qdot_vec(qdot_course_faded) faded; /* spans in which an event is lost in rounding, by time for each event */
    qdot_vec(qdot_course_end) ends; /* roots that ended pieces, by time; one piece may have several at one time */
    qdot_vec(qdot_course_rest) rests;
    qdot_vec(qdot_course_chatter) chatters;
    size_t stopped_by; /* index of the event that stopped the run; SIZE_MAX: none */
    char reason[400];  /* why the course ended early; "": it did not */
    bool failed;       /* `reason` is a failure, not an event's `stop` */
    bool began_on;     /* a watched function was 0 at the start */
} qdot_course;

#endif
