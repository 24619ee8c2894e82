/* scripts.h -- the examples in which allocations fail, and the form of the test that QDOT_RELIABILITY asks for. */
#ifndef QDOT_TESTS_RELIABILITY_SCRIPTS_H
#define QDOT_TESTS_RELIABILITY_SCRIPTS_H

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static const char *const scripts[] = {
    "virtual-work", "holonomic-in-disguise", "bowling-ball", "peaucellier", "polar", "over-the-edge", "geometry",
    "consistent-start", "generalized-momenta", "static-equilibrium", "velocity", "rolling-disk", "cylindrical",
    "sensitivity", "pendulum-period", "rolling-wheel", "half-pipe", "degrees-of-freedom", "spherical",
    "knife-edge", "bead-on-wire", "line-element", "slider-crank", "boundary-value", "metrics", "hamiltonian",
    "vector-operators", "acceleration-constraint", "curvature", "modes", "four-bar", "tautochrone", "routh",
    "kepler", "kinetic-energy", "car-axis", "fit", "rotating-hoop", "collision", "dry-friction",
};

enum { SCRIPTS = sizeof scripts / sizeof *scripts };

static inline bool
is_form(const char *form)
{
    const char *asked = getenv("QDOT_RELIABILITY");

    return asked != NULL && strcmp(asked, form) == 0;
}

#endif
