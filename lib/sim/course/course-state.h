/* course-state.h -- the data of a course: trajectory, systems by mode, occurrences, ends. */
#ifndef QDOT_SIM_COURSE_STATE_H
#define QDOT_SIM_COURSE_STATE_H

#include "ode/trajectory.h"
#include "sim/course/bind.h"
#include "sim/course/stage.h"
#include "sim/course/watch.h"

typedef struct {
    size_t event;
    double t;
    int way; /* left - right goes up or down as t grows; 0: it touches 0 */
} qdot_occurrence;

/* What ended a piece. */
typedef struct {
    size_t piece, function; /* of the trajectory; of the mode */
    double t;
    qdot_watched what;
    double late; /* by how much t is behind it; 0: it lies at t */
} qdot_course_end;

typedef struct qdot_course {
    qdot_stage *stage; /* borrowed */
    bool shaken;
    bool no_series;   /* of systems for a method without */
    int early;        /* of companions, +-1: see make_up */
    double touch_tol; /* within which an extremum touches 0: that of the run */
    /* evaluations for the states within steps that were looked at, and how many end the run
     * as QDOT_ELIMIT; 0: any */
    uint64_t looked, most_looked;
    size_t most_pieces; /* after which a companion is given up; 0: any */
    qdot_trajectory tr;
    qdot_vec(qdot_bind *) binds;         /* by mode, as far as they were met; NULL else */
    qdot_vec(qdot_ode_system) systems;   /* by mode */
    qdot_vec(qdot_watch *) watches;      /* by mode */
    qdot_vec(qdot_occurrence) occurrences;
    qdot_vec(qdot_course_end) ends; /* in their order; several at one time may be of one piece */
    size_t stopped_by; /* the event; SIZE_MAX: none */
    char reason[400];  /* why it ended early; "" */
    bool failed;       /* that is a failure */
} qdot_course;

#endif
