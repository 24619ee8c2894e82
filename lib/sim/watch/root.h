/* root.h -- a root of a function within a step; how the states within a step are read. */
#ifndef QDOT_SIM_ROOT_H
#define QDOT_SIM_ROOT_H

#include "ode/integrate.h"

typedef struct {
    size_t function;
    double t;
    int way;         /* the sign of g after the root, in the direction of the run; 0: it only
                        touches */
    double residual; /* the larger |g| at the two doubles next to the root */
    bool exact;      /* g is exactly 0 at t */
    bool pole;       /* g changes sign by a pole: not a root */
    bool turned; /* the function of interest changes sign in the opposite direction to g (qdot_watch_turns) */
    bool stays; /* g stays 0 for a while after t; `way` is the direction from its sign before to 0 */
    /* The root is at t - late; rounding of g leaves that uncertain by `blur`. In the direction of the
     * run: not negative. */
    double late, blur;
    bool cubic;  /* g crosses 0 like an odd power above the first, however slowly */
    bool deep;   /* it is located in many digits */
    bool rests; /* no crossing: what rounding alone has held at 0 is pushed to the side of `way` from t on */
    bool several; /* there are more crossings, too close to be separated in doubles */
    double flat; /* width in t around the root in which rounding hides the sign of g; 0: a few doubles */
    double rounding; /* for functions of t only: error of the root by rounding of g */
    double moved;    /* shift of t to the time of another root of the same instant */
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
    bool alone; /* no other thread uses the pool of expressions at this time */
    const qdot_ode_system *system; /* equations of motion, for q'' and multipliers */
    /* Whether a step ends at this root, so that later roots are not wanted; NULL: steps do not end at roots. */
    bool (*ends)(const qdot_root *root, void *user);
} qdot_watch_reader;

#endif
