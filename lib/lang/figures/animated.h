/* animated.h -- makes a moving picture of a run. */
#ifndef QDOT_LANG_ANIMATED_H
#define QDOT_LANG_ANIMATED_H

#include "lang/session/parts.h"
#include "lang/session/runs.h"
#include "show/animation.h"

/* The choice of which part of a run an animation shows, and how. */
typedef struct {
    double from, to;   /* first and last time; NaN: the whole run */
    const char *title; /* title of the animation, borrowed; NULL: none */
    double
        trail; /* length of the trails behind moving points, in units of t; NaN: that of four seconds of the animation */
    double speed; /* units of t in a second; NaN: 1, or what makes the picture last about
                          20 s where that would be shorter than 4 s or longer than 60 s */
    bool bare;         /* draw no picture of the motion, only phase portraits and energies */
} qdot_animated_options;

/* Particles, bodies, rods (mech/study/rods.h), springs and dampers of the scene along the run,
 * its states, T, V and T + V, and lines that tell of its error. Between 1201 and 20001 frames: 60 in a second
 * and four in a step of the run where that is not more; a notice tells if there is less than one a
 * step. *a is the caller's, to be cleared in any case. QDOT_EINVAL: the scene has nothing to draw,
 * or has other coordinates than the run; QDOT_EDOMAIN: times outside the run. */
QDOT_MUST_CHECK qdot_status qdot_animated_make(qdot_session *session,
                                               const qdot_named_run *run,
                                               const qdot_animated_options *options,
                                               qdot_animation *a);

/* Add to the animation only the lines of text about the run, without a picture. */
QDOT_MUST_CHECK qdot_status qdot_animated_facts(qdot_session *session,
                                                const qdot_named_run *run,
                                                qdot_animation *a);

#endif
