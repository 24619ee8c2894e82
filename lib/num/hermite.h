/* hermite.h -- interpolates a motion between two of its points.
 *
 * With y, v = y' and a = y'' known at t0 and t0 + h and s = (t - t0)/h, the polynomial of degree
 * five through them,
 *
 *     y(t) = y0 + h v0 s + h^2 a0 s^2/2 + c3 s^3 + c4 s^4 + c5 s^5,
 *
 * with an error of h^6 max|y'''''' |/46080. If a is not known at the ends,
 * qdot_hermite_cubic_ends gives that of the cubic through y and v, with an error of h^4
 * max|y''''|/384.
 *
 * Source  Stoer & Bulirsch, Introduction to Numerical Analysis, 2.1.5.
 * Tests   tests/num/test_hermite.c
 */
#ifndef QDOT_NUM_HERMITE_H
#define QDOT_NUM_HERMITE_H

/* The value y, the first derivative v and the second derivative a at one end of an interval. */
typedef struct {
    double y, v, a;
} qdot_hermite_end;

/* The value at t0 + s h of the polynomial through both ends; its derivative there goes into *v (unless NULL). */
double qdot_hermite_at(const qdot_hermite_end *from, const qdot_hermite_end *to, double h,
                       double s, double *v);

/* Set the second derivatives a at both ends to those of the cubic polynomial through y and v. */
void qdot_hermite_cubic_ends(qdot_hermite_end *from, qdot_hermite_end *to, double h);

#endif
