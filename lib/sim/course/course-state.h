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
    int way; /* 1, -1: left - right rises, falls as t grows; 0: it touches 0 */
    double within, bend, blur; /* shape of a touch, as in qdot_root */
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
    size_t piece, function; /* index of the piece; of the function watched in its mode */
    double t;
    qdot_watched what;
    double late; /* t less the true time of the root; 0: the root is at t */
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
    double t, end;        /* until when */
    double unsure;        /* by how much `end` of a contact errs, for it began where u is 0 but for rounding */
    double speed;         /* |u'| at most */
    double place;         /* |u| at the start */
    size_t mode[3];       /* below the surface, on it, above */
    double *along;        /* [n] of u = 1, then the slopes of u [n]; owned */
    bool ended;           /* the motion has left the surface */
    bool steady;          /* no chatter: the rounding of a place that moves, as large until `end` */
} qdot_course_chatter;

typedef struct qdot_course {
    qdot_stage *stage; /* borrowed */
    bool shaken;
    bool no_series;   /* the method does not use Taylor series */
    bool exact;       /* it starts where the run was said to start, known in two doubles */
    int early;        /* of companions, +-1: the sign in qdot_piece_make_up; 0: the run itself */
    double touch_tol; /* an extremum within this tolerance touches 0: that of the run, or less if
                         the run is more exact (sim/error/touches.h) */
    double passed_over; /* the least tolerance by which a touch of an event with a direction was one,
                           and so nothing; 0: there was none */
    /* evaluations for states within steps, and the number that ends the run with QDOT_ELIMIT;
     * 0: no limit */
    uint64_t looked, most_looked;
    double left_out; /* of velocities by layers so far, relative to their sizes (ode/scale.h) */
    const struct qdot_course *leader; /* of a companion: the run, which says when a contact lasts; else NULL */
    size_t most_pieces; /* a companion with more is given up; 0: no limit */
    qdot_trajectory tr;
    qdot_vec(qdot_bind *) binds;         /* by mode; NULL for modes that have not occurred yet */
    qdot_vec(qdot_ode_system) systems;   /* by mode */
    qdot_vec(qdot_watch *) watches;      /* by mode */
    qdot_vec(qdot_occurrence) occurrences;
    qdot_vec(qdot_course_faded) faded; /* of each event in order of time */
    qdot_vec(qdot_course_end) ends; /* in order of time; one piece may have several at one time */
    qdot_vec(qdot_course_rest) rests;
    qdot_vec(qdot_course_chatter) chatters;
    size_t stopped_by; /* the event; SIZE_MAX: none */
    char reason[400];  /* why the course ended early; "": it did not */
    bool failed;       /* the reason is a failure, not an event's `stop` */
    bool began_on;     /* it started on a zero of a function that is watched */
} qdot_course;

#endif
