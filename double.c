/* double -- equations of motion, written by qdot.
 *
 * coord theta1
 * coord theta2
 * particle a mass m1 at (L1*sin(theta1), -L1*cos(theta1))
 * particle b mass m2 at (L1*sin(theta1) + L2*sin(theta2), -L1*cos(theta1) - L2*cos(theta2))
 * gravity (0, -g)
 *
 *     M(q, t) q'' = f(q, q', t),   state = (q, q')
 *
 *     cc -c double.c                                functions to call
 *     cc -Ddouble_MAIN double.c -lm && ./a.out      a table of t, q, q'
 */
#include <math.h>
#include <string.h>

enum { double_N = 2, double_M = 0, double_EVENTS = 0 };

typedef struct {
    double m1;
    double m2;
    double L1;
    double L2;
    double g;
} double_parameters;

/* The values of `set` (NAN: none), the start, the time span and the tolerance. */
extern const double_parameters double_values;
extern const char *const double_coordinates[2];
extern const double double_start[4], double_span[2], double_tolerance;

void double_equations(double t, const double *state, const double_parameters *p, double *M, double *f);
int double_accelerations(double t, const double *state, const double_parameters *p, double *a, double *lambda);
int double_derivative(double t, const double *state, const double_parameters *p, double *dy);
int double_jacobian(double t, const double *state, const double_parameters *p, double *J);
double double_energy(double t, const double *state, const double_parameters *p);

const double_parameters double_values = {
    .m1 = 1.0, /* m1 */
    .m2 = 1.0, /* m2 */
    .L1 = 1.0, /* L1 */
    .L2 = 1.0, /* L2 */
    .g = 9.81, /* g */
};
const char *const double_coordinates[2] = { "theta1", "theta2" };
const double double_start[4] = { 2.0, 2.0, 0.0, 0.0 };
const double double_span[2] = { 0.0, 2.0 }, double_tolerance = 1e-12;

/* M [n x n], row by row, and f [n]. */
void double_equations(double t, const double *state, const double_parameters *p, double *M, double *f)
{
    (void)t;
    (void)state;
    (void)p;
    memset(M, 0, 2 * 2 * sizeof *M);
    memset(f, 0, 2 * sizeof *f);
    const double theta1 = state[0];
    const double theta2 = state[1];
    const double theta1_dot = state[2];
    const double theta2_dot = state[3];
    const double m1 = p->m1;
    const double m2 = p->m2;
    const double L1 = p->L1;
    const double L2 = p->L2;
    const double g = p->g;
    const double w1 = m1 + m2;
    const double w2 = sin(theta1);
    const double w3 = cos(theta1);
    const double w4 = sin(theta2);
    const double w5 = cos(theta2);
    const double w6 = L2*(m2*L1);
    const double w7 = (w2*w4 + w3*w5)*w6;
    const double w8 = (w2*w5 - w3*w4)*w6;
    const double w9 = -(w8*(theta2_dot*theta2_dot) + w2*(g*(L1*w1)));
    M[0] = w1*(L1*L1);
    M[1] = w7;
    M[2] = w7;
    M[3] = m2*(L2*L2);
    f[0] = w9;
    f[1] = w8*(theta1_dot*theta1_dot) - w4*(g*(m2*L2));
}

/* Solve K x = b for columns of b at once [size x columns], by elimination with pivots; 1: K is singular. */
static int
solve(int size, int columns, double *K, double *b)
{
    for (int k = 0; k < size; k++) {
        int pivot = k;

        for (int i = k + 1; i < size; i++)
            if (fabs(K[i * size + k]) > fabs(K[pivot * size + k]))
                pivot = i;
        if (!(fabs(K[pivot * size + k]) > 0))
            return 1;
        for (int j = 0; j < size; j++) {
            const double x = K[k * size + j];

            K[k * size + j] = K[pivot * size + j];
            K[pivot * size + j] = x;
        }
        for (int j = 0; j < columns; j++) {
            const double x = b[k * columns + j];

            b[k * columns + j] = b[pivot * columns + j];
            b[pivot * columns + j] = x;
        }
        for (int i = k + 1; i < size; i++) {
            const double l = K[i * size + k] / K[k * size + k];

            for (int j = k; j < size; j++)
                K[i * size + j] -= l * K[k * size + j];
            for (int j = 0; j < columns; j++)
                b[i * columns + j] -= l * b[k * columns + j];
        }
    }
    for (int k = size - 1; k >= 0; k--)
        for (int j = 0; j < columns; j++) {
            for (int i = k + 1; i < size; i++)
                b[k * columns + j] -= K[k * size + i] * b[i * columns + j];
            b[k * columns + j] /= K[k * size + k];
        }
    return 0;
}

/* The matrix of the equations [r x r], r = n + m, and their right side [r]. */
static void
system_of(double t, const double *state, const double_parameters *p, double *K, double *b)
{
    double_equations(t, state, p, K, b);
}

/* q'' [n] and the multipliers [m] (NULL: not wanted); 1: the matrix is singular. */
int
double_accelerations(double t, const double *state, const double_parameters *p, double *a, double *lambda)
{
    double K[2 * 2], b[2];

    system_of(t, state, p, K, b);
    if (solve(2, 1, K, b) != 0)
        return 1;
    memcpy(a, b, 2 * sizeof *a);
    (void)lambda;
    return 0;
}

/* state' [2n] = (q', q''). */
int
double_derivative(double t, const double *state, const double_parameters *p, double *dy)
{
    memmove(dy, state + 2, 2 * sizeof *dy);
    return double_accelerations(t, state, p, dy + 2, NULL);
}

/* d(state')/d(state) [2n x 2n], row by row, exact derivatives. */
int
double_jacobian(double t, const double *state, const double_parameters *p, double *J)
{
    double K[2 * 2], solved[2], R[2 * 4], acc[2];

    system_of(t, state, p, K, solved);
    if (solve(2, 1, K, solved) != 0)
        return 1;
    memcpy(acc, solved, sizeof acc);
    (void)acc;
    system_of(t, state, p, K, solved);
    memset(R, 0, sizeof R);
    const double theta1 = state[0];
    const double theta2 = state[1];
    const double theta1_dot = state[2];
    const double theta2_dot = state[3];
    const double theta1_ddot = acc[0];
    const double theta2_ddot = acc[1];
    const double m1 = p->m1;
    const double m2 = p->m2;
    const double L1 = p->L1;
    const double L2 = p->L2;
    const double g = p->g;
    const double w1 = sin(theta1);
    const double w2 = cos(theta1);
    const double w3 = sin(theta2);
    const double w4 = cos(theta2);
    const double w5 = L2*(m2*L1);
    const double w6 = (w1*w4 - w2*w3)*w5;
    const double w7 = theta2_ddot*w6;
    const double w8 = (w1*w3 + w2*w4)*w5;
    const double w9 = w8*(theta2_dot*theta2_dot);
    const double w10 = w8*(theta1_dot*theta1_dot) + theta1_ddot*w6;
    R[0] = w7 - w9 - w2*(g*(L1*(m1 + m2)));
    R[1] = w9 - w7;
    R[3] = theta2_dot*w6*(-2.0);
    R[4] = w10;
    R[5] = -(w4*(g*(m2*L2)) + w10);
    R[6] = theta1_dot*w6*2.0;
    if (solve(2, 4, K, R) != 0)
        return 1;
    memset(J, 0, 2 * 4 * sizeof *J);
    for (int i = 0; i < 2; i++)
        J[i * 4 + 2 + i] = 1;
    memcpy(J + 2 * 4, R, 2 * 4 * sizeof *J);
    return 0;
}

/* The energy sum p q' - L. */
double
double_energy(double t, const double *state, const double_parameters *p)
{
    (void)t;
    (void)state;
    (void)p;
    const double theta1 = state[0];
    const double theta2 = state[1];
    const double theta1_dot = state[2];
    const double theta2_dot = state[3];
    const double m1 = p->m1;
    const double m2 = p->m2;
    const double L1 = p->L1;
    const double L2 = p->L2;
    const double g = p->g;
    const double w1 = m1 + m2;
    const double w2 = cos(theta1);
    const double w3 = cos(theta2);
    const double w4 = (sin(theta1)*sin(theta2) + w2*w3)*(L2*(m2*L1));
    const double w5 = theta1_dot*(theta2_dot*w4 + theta1_dot*(w1*(L1*L1)));
    const double w6 = theta2_dot*(theta1_dot*w4 + theta2_dot*(m2*(L2*L2))) + w5;
    return w6*0.5 - (w3*(g*(m2*L2)) + w2*(g*(L1*w1)));
}

#ifdef double_MAIN
#include <stdio.h>

/* One step h of the method of Dormand and Prince, order 5: state, and the error relative to the tolerance. */
static int
step(double t, double h, const double_parameters *p, double tol, const double *state, double *to, double *error)
{
    static const double c[7] = { 0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1, 1 };
    static const double a[7][6] = {
        { 0 },
        { 1. / 5 },
        { 3. / 40, 9. / 40 },
        { 44. / 45, -56. / 15, 32. / 9 },
        { 19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729 },
        { 9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656 },
        { 35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84 }
    };
    static const double e[7] = { 71. / 57600, 0, -71. / 16695, 71. / 1920, -17253. / 339200, 22. / 525, -1. / 40 };
    double k[7][4];

    for (int s = 0; s < 7; s++) {
        for (int i = 0; i < 4; i++) {
            to[i] = state[i];
            for (int r = 0; r < s; r++)
                to[i] += h * a[s][r] * k[r][i];
        }
        if (double_derivative(t + c[s] * h, to, p, k[s]) != 0)
            return 1;
    }
    *error = 0;
    for (int i = 0; i < 4; i++) {
        double d = 0;

        for (int s = 0; s < 7; s++)
            d += h * e[s] * k[s][i];
        *error = fmax(*error, fabs(d) / (tol * fmax(1, fabs(to[i]))));
    }
    return !(*error < INFINITY);
}

int
main(void)
{
    const double_parameters p = double_values;
    const double t0 = double_span[0], t1 = double_span[1];
    double state[4], next[4], t = t0, h = (t1 - t0) / 1000, error;

    memcpy(state, double_start, sizeof state);
    for (int row = 0; row <= 100; row++) {
        const double end = row < 100 ? t0 + (t1 - t0) * row / 100 : t1;

        while (fabs(end - t) > 1e-14 * fmax(1, fabs(t))) {
            const double tried = fabs(h) < fabs(end - t) ? h : end - t;

            if (step(t, tried, &p, double_tolerance, state, next, &error) != 0)
                return 1;
            if (error <= 1) {
                t = tried == h ? t + tried : end;
                memcpy(state, next, sizeof state);
            }
            if (error > 1 || tried == h)
                h = tried * fmin(5, fmax(0.2, 0.9 * pow(error + 1e-10, -0.2)));
            if (fabs(h) < 1e-14 * fmax(1, fabs(t)))
                return 1;
        }
        printf("%.17g", t);
        for (int i = 0; i < 4; i++)
            printf(" %.17g", state[i]);
        printf("\n");
    }
    return 0;
}
#endif
