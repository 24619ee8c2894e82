/* export-parts.h -- a motion or an expression described for the writers of source text (export.h).
 *
 * Every tape of a motion has the same inputs, in this order:
 *
 *     t, q [n], q' [n], q'' [n], lambda [m], parameters [k], sides [s]
 *
 * Where equations switch they are written for one side of every surface (sim/model/switch.h): a side
 * is -1, 0 or 1, or the integer of a floor.
 */
#ifndef QDOT_SHOW_EXPORT_PARTS_H
#define QDOT_SHOW_EXPORT_PARTS_H

#include "tape/tape.h"

/* How a language writes what is exported (export-language.h). */
typedef struct qdot_export_language qdot_export_language;
#define LANGUAGE(word, title, ending, language) extern const qdot_export_language qdot_export_##language;
#include "show/export-languages.def"

/* A name of the scene, and if it is a parameter, its value (NaN: none). */
typedef struct {
    const char *name; /* the plain name: "theta[1]" */
    double value;
} qdot_export_name;

/* Consecutive outputs of a tape that the exported file returns as one array. */
typedef struct {
    const char *array; /* name of the array, as "M"; NULL: a single number, the function's value */
    size_t rows, columns; /* size of the array; columns 0: a vector */
} qdot_export_block;

typedef struct {
    const qdot_tape *tape; /* the expressions; NULL: nothing to compute */
    size_t blocks;
    qdot_export_block block[4];
} qdot_export_function;

/* A surface at which the equations switch. */
typedef struct {
    const char *text; /* equation of the surface: "x' = 0" */
    bool steps;       /* the side of the surface is floor(u), otherwise the sign of u (u = 0: the surface) */
    bool moves;       /* u depends on coordinates or velocities, not on time alone */
} qdot_export_surface;

/* What an event does: its targets are y [0 ... 2n - 1], then parameters [2n ...]; one output of the
 * tape for each. */
typedef struct {
    const char *name;
    int way; /* direction in which left - right of the event passes 0; 1: rising, -1: falling, 0: either */
    bool stop;
    size_t n_targets;
    const size_t *targets;
    const qdot_tape *effect; /* new values of what the event sets; NULL: it sets nothing */
} qdot_export_event;

typedef struct {
    const char *file;   /* file name without folder and ending */
    const char *origin; /* description of the scene, written as comment lines */
    size_t n, m, k, s;  /* numbers of coordinates, constraint rows, parameters, surfaces */
    const qdot_export_name *q, *lambda, *parameters;
    const double *start; /* [2n] start state */
    double t0, t1, tol;
    qdot_export_function equations; /* M, f of M q'' = f; with constraints also A, gamma */
    qdot_export_function slopes;    /* d(residuals)/dy [(n + m) x 2n]; residuals: f + A^T lambda - M q'',
                                       gamma - A q''; then, if there are velocities, d(velocities)/dy [n x 2n] */
    qdot_export_function velocities; /* q', of first-order states their rates [n]; no tape: the scene has no states */
    qdot_export_function energy;    /* the energy, one number */
    qdot_export_function positions; /* f [m] of constraints without derivatives, df/dt and f of those
                                       on velocities [m], else 0 */
    qdot_export_function events;    /* left - right of each event */
    qdot_export_function switches; /* u [s] of the switching surfaces; `level`: the terms of T - V that switch [0 or 1] */
    const int *orders; /* [m] how often each constraint is differentiated by time until q'' occurs: 2, 1 or 0 */
    const qdot_export_surface *surface;
    size_t n_events;
    const qdot_export_event *event;
} qdot_export_system;

/* One expression, or several, to be exported as a function of its symbols. */
typedef struct {
    const char *file, *origin;
    size_t k;
    const qdot_export_name *arguments; /* [k] inputs of the tape; those with a value come last */
    qdot_export_function value;        /* the expression as one array */
} qdot_export_expression;

#endif
