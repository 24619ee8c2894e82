/* euler-lagrange.h -- equations of a Lagrangian density L in fields y(x_1 ... x_m) and their partial derivatives.
 *
 *     sum over J of (-1)^(|J| + 1) d_J (dL/dy_J) = 0,   y_J = d^|J| y / dx_1^j1 ... dx_m^jm
 *
 * where each y_J that occurs in L counts as one variable and d_J is the total derivative. With first derivatives
 * only this is sum d/dx_i (dL/dy_i) - dL/dy = 0, so that L = T - V gives the signs of Lagrange's equations.
 *
 *   density    the density L, a scalar
 *   field      an undefined function at its declared arguments, or a coordinate q of the scene (then t is the
 *              only variable and the derivatives are q', q'' ...)
 *   variables  [m] symbols: the arguments of the field over which the density is integrated
 *
 * Nil on failure; the pool keeps the cause. QDOT_ETYPE: an argument is of the wrong kind; QDOT_EINVAL: the density
 * has the field at another place or differentiates it by what is no variable.
 *
 * Source  Gelfand & Fomin, Calculus of Variations, 42; Goldstein, Classical Mechanics (1980), 12-2.
 * Tests   tests/mech/fields/test_euler-lagrange.c
 */
#ifndef QDOT_MECH_EULER_LAGRANGE_H
#define QDOT_MECH_EULER_LAGRANGE_H

#include "mech/scene/things.h"

/* The equation of one field, simplified. */
qdot_expr qdot_fields_euler_lagrange(qdot_scene *s, qdot_expr density, qdot_expr field, uint32_t m,
                                     const qdot_expr *variables);

/* The canonical energy-momentum tensor of fields [n] with a density that has first derivatives only, a MAT over the
 * variables (row i, column k; m = 1: a scalar):
 *     T_ik = sum over the fields of (dL/d(d_i y)) d_k y - delta_ik L,   sum_i d_i T_ik = -(dL/dx_k) explicit. */
qdot_expr qdot_fields_energy_momentum(qdot_scene *s, qdot_expr density, uint32_t n, const qdot_expr *fields,
                                      uint32_t m, const qdot_expr *variables);

#endif
