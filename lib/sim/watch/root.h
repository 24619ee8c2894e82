/* root.h -- a root (time of an event or switch) within a step; how the states within a step are read. */
#ifndef QDOT_SIM_ROOT_H
#define QDOT_SIM_ROOT_H

#include "ode/integrate.h"

typedef struct {
    size_t function;
    double t;
    int way;         /* the sign of g after the root, in the direction of the run; 0: it only
                        touches */
    double residual; /* larger magnitude of g at the two doubles of t next to the root */
    bool exact;      /* the watched function g is exactly 0 at the double t */
    bool pole;       /* g changes its sign by a pole (through infinity): this is not a root */
    bool jump; /* g is made of another piece of a table of data from t on: on the side `way` of 0 or, if it `stays`, 0 */
    bool turned; /* the user's function changes its sign in the opposite direction to g (qdot_watch_turns) */
    bool stays; /* g stays 0 for some time after t; `way` is the direction from g's sign before t to 0 */
    /* The root is at t - late; rounding of g leaves that uncertain by `blur`. In the direction of the
     * run: not negative. */
    double late, blur;
    bool cubic;  /* g crosses 0 like an odd power (t - root)^m, m > 1, however slowly */
    bool deep;   /* the root has been located in multiple precision */
    bool rests; /* no crossing: what rounding alone has held at 0 is pushed to the side of `way` from t on */
    bool several; /* there are more crossings near this one, too close to be separated in doubles */
    double flat; /* width of the time interval about the root in which rounding hides the sign of g; 0: a few doubles */
    double rounding; /* if g depends on t only: error of the root caused by rounding of g */
    double moved;    /* shift of t to the time of another root that occurs at the same instant */
    /* If g touches 0: tolerance below which |g| counts as 0 (0 if rounding decides), and g'': */
    double within, bend;
} qdot_root;

/* The direction in which the user's function passes 0; `way` is that of the watched function g. */
static inline int
qdot_root_way(const qdot_root *root)
{
    return root->turned ? -root->way : root->way;
}

typedef struct {
    qdot_status (*read)(double t, double *y, void *user);
    /* Read the state at t in double-double precision; NULL for steps without a Taylor series. */
    qdot_status (*read_two)(double t, qdot_two *y, void *user);
    void *user;
    bool alone; /* no other thread uses the pool of expressions at present */
    const qdot_ode_system *system; /* equations of motion, to find accelerations q'' and multipliers */
    /* Whether the step ends at this root, so that later roots are not needed; NULL: steps do not end at roots. */
    bool (*ends)(const qdot_root *root, void *user);
} qdot_watch_reader;

#endif
