/* layer.h -- layers about the branch points of powers.
 *
 *     |u|^p,  max(u, 0)^p,  if(u < 0, 0, u^p),  (t - a)^p     p > 0 no integer
 *
 * have no Taylor series at u = 0, and neither has a motion that passes there: no step can. But
 * the power is small there. In a layer |u| <= w it counts as 0, as side 0 of the surface u = 0;
 * beyond the layer, steps grow with the distance from the branch point.
 *
 * What is left out, while u passes with the velocity u', changes velocities by up to
 *
 *     C w^p/(p + 1) 2 w/|u'|,     C w^p the force at the rim of the layer.
 *
 * So a layer is as thin as doubles of t can follow the motion through it, w = 2^-42 T U for times
 * up to T, where U is the larger of |u'| and sqrt(2 |u''| |u|) at the start and |u| there in a unit
 * of time. By series it is, of powers above 1, wider than the error of a step just behind its rim, where the power is too
 * little for its coefficients to keep the step within their radius: u would seem to turn back to the rim.
 * That is w = 16 tol^(5/4) U, at most (tol/100)^(1/(1 + p)) U. What was left out is added up
 * (sim/course/piece-layer.c): a run that leaves out more than its tolerance ends. In a layer of the time it is
 * known, and added to the velocities; so is, in a layer of places, what else switches at u = 0, as a dashpot in contact.
 *
 * Tests  tests/script/runs/broken-powers.lag, tests/script/contacts/contact-dashpots.lag, tests/bad/digits/broken-power-digits.lag
 */
#ifndef QDOT_SIM_LAYER_H
#define QDOT_SIM_LAYER_H

#include "sim/model/surface.h"

/* Whether factor k of a product is a power with a non-integer exponent; *p receives the exponent. */
bool qdot_layers_is_broken(const qdot_pool *pool, qdot_expr product, uint32_t k, double *p);

/* Set `power` of every surface [m] whose u stands under such a power in e [n], to the least of its
 * exponents. None has one whose u stands under a negative broken power as well: the force is
 * infinite there. */
QDOT_MUST_CHECK qdot_status qdot_layers_find(qdot_pool *pool, size_t m, qdot_surface *surfaces,
                                             size_t n, const qdot_expr *e);

/* Set `layer` of these surfaces [m], for times up to `latest` and speed [m], U above: where it is 0,
 * the largest of them, or 1. */
void qdot_layers_measure(const qdot_pool *pool, size_t m, qdot_surface *surfaces, const double *speed,
                         double latest, double tol);

/* The half width of the layer around a surface u = 0, as an exact number. */
qdot_expr qdot_layers_rim(qdot_pool *pool, const qdot_surface *surface);

/* For a motion held in a layer: the force ratio (share) that reaches -1 or 1 when the motion leaves the layer. */
qdot_expr qdot_layers_share(qdot_pool *pool, qdot_expr share);

/* Whether a surface's function u depends on t only, so that the effect of its layer is known. */
bool qdot_layers_in_time(const qdot_pool *pool, const qdot_surface *surface);

/* Whether factor k of a product is a power of a u that has a layer: *surface; *only: the sign of u on the one
 * side where the power is not 0, else 0. */
bool qdot_layers_has(qdot_pool *pool, size_t m, const qdot_surface *surfaces, qdot_expr product,
                     uint32_t k, size_t *surface, int *only);
/* Whether a node is a product with a factor that is a power of some surface's function u with a layer. */
bool qdot_layers_hold(qdot_pool *pool, size_t m, const qdot_surface *surfaces, qdot_expr node);

#endif
