/* root.h -- a root of a function within a step; how the states within a step are read. */
#ifndef QDOT_SIM_ROOT_H
#define QDOT_SIM_ROOT_H

#include "ode/integrate.h"

typedef struct {
    size_t function;
    double t;
    int way;         /* the sign of g after the root, in the direction of the run; 0: it only
                        touches */
    double residual; /* |g| at the doubles on both sides of it, the larger */
    bool exact;      /* g is 0 at t */
    bool pole;       /* g changes its sign through infinity: it is no root */
    bool turned;     /* g is watched in place of a function that changes its sign the other way (qdot_watch_turns) */
    bool stays;      /* g is 0 from here on for a while; `way` leads to 0, from the sign before */
    /* The root is at t - late; rounding of g leaves that uncertain by `blur`. In the direction of the
     * run: not negative. */
    double late, blur;
    bool cubic;  /* g grows around it like an odd power above the first: the motion crosses, however slowly */
    bool deep;   /* it is located in many digits */
    bool several; /* other crossings lie so near that doubles do not show them */
    double flat; /* so far around it rounding of the state hides g; 0: less than a few doubles of t */
    double rounding; /* of a function of t alone: so far rounding of its operations may move the root */
    double moved;    /* so far t was put later, to that of another root of the same instant */
    /* For a touch: the tolerance below which |g| counts as 0 (0 if rounding decides), and g''. */
    double within, bend;
} qdot_root;

/* The direction of the function asked for by the user; `way` is that of the watched function. */
static inline int
qdot_root_way(const qdot_root *root)
{
    return root->turned ? -root->way : root->way;
}

typedef struct {
    qdot_status (*read)(double t, double *y, void *user);
    /* Read the state at t as sums of two doubles; only for steps with a series, otherwise NULL. */
    qdot_status (*read_two)(double t, qdot_two *y, void *user);
    void *user;
    bool alone; /* no other thread uses the pool of expressions meanwhile */
    const qdot_ode_system *system; /* for accelerations and multipliers */
    /* Whether a step ends at this root, so that later roots are not wanted; NULL: steps do not end at roots. */
    bool (*ends)(const qdot_root *root, void *user);
} qdot_watch_reader;

#endif
