/* orbit-path.h -- curves of periodic orbits over a parameter p: a path (path.h) by shooting.
 *
 * With z = (q, q') the start and z(T; z, p) where the orbit is after its period,
 *
 *     z(T; z, p) - z + lambda grad h = 0
 *     q_k' = 0, or q_k = c          a phase                       T = T(p)   where a drive has its period
 *     h(z, p) = E                   where the energy h is conserved
 *
 * Where motions near by grow, the period is cut into K segments (flow.h), with a state at the beginning of each as further
 * unknowns behind these, z_k+1 - phi(z_k) = 0 as further equations. Under constraints all states are brought onto them first:
 * what F has to 0 lies on them.
 *
 * The unknowns are z, T and, where h is conserved, lambda, which is 0: it takes the place of the equation that
 * depends on the others. Orbits of such a scene are families even at one value of all parameters: p is then the
 * energy, or a number of the start; with a parameter of the scene the energy stays what it was.
 *
 * F' is exact, by the variational equations (response.h), and so are the slopes B of the segments along the constraints; the
 * eigenvalues of their product are the multipliers. Their errors are how far B is from that of a second run, of a tolerance 100 times as large.
 *
 * The phase: a velocity that is 0 at the start stays so, the one that changes fastest; else the start is moved to a turning
 * point of a coordinate; where p is a number of the start, the coordinate that changes fastest is held. The determinant
 * is divided by the rate of what is held, with which it would change its sign.
 *
 * Source  Keller, as in path.h; Munoz-Almaraz, Freire, Galan, Doedel, Vanderbauwhede, Physica D 181 (2003) 1.
 * Tests   tests/sim/branches/test_orbits.c, tests/script/continue/continue-orbit.lag
 */
#ifndef QDOT_SIM_ORBIT_PATH_H
#define QDOT_SIM_ORBIT_PATH_H

#include "sim/branches/path.h"
#include "sim/study/flow.h"
#include "tape/tape.h"

/* The kind of the parameter p of a family of orbits: a parameter of the scene, the energy, or a start value. */
typedef enum { QDOT_ORBIT_PARAMETER, QDOT_ORBIT_ENERGY, QDOT_ORBIT_START } qdot_orbit_family;

typedef struct {
    qdot_scene *scene;
    /* The run that the family is based on: parameter values (including that of p), t0, method. Its
     * start values are not used. */
    const qdot_run_request *request;
    qdot_orbit_family family;
    qdot_expr parameter; /* a parameter of the scene, or q, q' of the start; nil: the energy */
    double p, T;         /* parameter and period of the first orbit; if the parameter is the energy, p is computed */
    const double *z;     /* [2n] start state of the first orbit */
    double least, most;
    size_t segments;     /* number of segments, for an orbit of doubled period; 0: choose it */
} qdot_orbit_of;

typedef struct {
    qdot_path path; /* first member, so a pointer to it can be cast to this type */
    qdot_orbit_of of;
    size_t n, K, c; /* number of coordinates; of orbit segments; of multipliers: 2n minus those fixed by constraints */
    bool driven, conserved, asymptotic;
    size_t phase;   /* index of the component of the start state z that is held fixed; 2n: none */
    double held, rate; /* value of the component held fixed; its time derivative along the first orbit */
    double energy;     /* energy of the first orbit */
    double size;       /* largest change of a coordinate along the first orbit */
    double t0;
    qdot_tape *period; /* the period T as a function of p, for a driven system; NULL: not driven */
    double *period_work;
    qdot_flow flow[2]; /* fine and coarse integration; the additional expression is the energy h */
    size_t by;                  /* index of the flow map in use: 0 fine, 1 coarse */
    double *values, *slopes; /* latest evaluation: values [K x 2 x m], derivatives [K x 2 x m x (2n + p)] */
    double *y;                  /* [n + 1] point of the latest evaluation */
    bool known;                 /* the latest evaluation succeeded */
    double *B, *E; /* [K x c x c] transfer matrices of the segments, and their errors */
    double *sizes;              /* [2n] size of each component along the first orbit */
    double *domain;             /* [2 path.n] lower and upper bound of each unknown */
    bool *angle;                /* [path.n] all false: no unknown is an angle */
} qdot_orbit_path;

/* From {0}, of->z taken over; ended in any case. QDOT_EINVAL: the drive has not the period
 * of the orbit, it rests, or p is of another kind. y [path.n + 1] is the first place, size
 * [path.width] how large each number is. */
QDOT_MUST_CHECK qdot_status qdot_orbit_path_begin(qdot_orbit_path *x, const qdot_orbit_of *of,
                                                  double *size, double *y);
void qdot_orbit_path_end(qdot_orbit_path *x);

/* In y: unknowns, p, then the largest value of each coordinate [n], the moduli of the multipliers [c]. The most that there
 * are of a scene: */
size_t qdot_orbit_path_most(size_t n);

/* Find the monodromy matrix B at y by the flow map in use; false if there is none. E is not changed. */
bool qdot_orbit_path_monodromy(qdot_orbit_path *x, const double *y);
/* Use the flow map with the fine tolerance (0) or the coarse one (1) from now on. */
void qdot_orbit_path_ask(qdot_orbit_path *x, size_t by);

#endif
