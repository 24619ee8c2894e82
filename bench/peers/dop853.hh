/* dop853.hh -- DOP853 as a user would have it: Hairer's step control, a plain state.
 *
 * The error of a step is his mean over the components in units of tol (1 + |y_i|); the
 * coefficients are those of lib/ode/dop853.def.
 */
#ifndef BENCH_PEERS_DOP853_HH
#define BENCH_PEERS_DOP853_HH

#include <cmath>
#include <cstring>

/* A coefficient of the table for T. */
template <class T> constexpr T
coefficient(double a, __float128 wide)
{
    return sizeof(T) == sizeof(double) ? T(a) : T(wide);
}

/* Hairer's control: whether a step with that error, in units of what is allowed, counts; *h is then the
 * length of the next one, else of this one once more. */
template <class T> bool
accepts(double ratio, bool *refused, T *h)
{
    const double factor = std::fmin(6, std::fmax(0.333, 0.9 * std::pow(ratio, -1.0 / 8)));
    const bool counts = ratio <= 1;

    *h *= *refused || !counts ? std::fmin(factor, 1) : factor;
    *refused = !counts;
    return counts;
}

/* y [n] from 0 to t1 by f(y, d); the steps taken and refused, or -1 where it stalls. */
template <int n, class T, class F> long
dop853(F f, T t1, T *y, T tol)
{
    T k[13][n], z[n], t = 0, h = 0;
    long steps = 0;

#define A(j, a) +coefficient<T>(a, a##Q) * k[j][i]
    f(y, k[0]);
    {
        /* his first step, order 8 */
        T size = 0, slope = 0, bend = 0;

        for (int i = 0; i < n; i++) {
            const T scale = tol * (1 + (y[i] < 0 ? -y[i] : y[i]));

            size += y[i] * y[i] / (scale * scale);
            slope += k[0][i] * k[0][i] / (scale * scale);
        }
        h = size < 1e-10 || slope < 1e-10 ? T(1e-6) : root(size / slope) / 100;
        for (int i = 0; i < n; i++)
            z[i] = y[i] + h * k[0][i];
        f(z, k[1]);
        for (int i = 0; i < n; i++) {
            const T scale = tol * (1 + (y[i] < 0 ? -y[i] : y[i]));

            bend += (k[1][i] - k[0][i]) * (k[1][i] - k[0][i]) / (scale * scale);
        }
        const double most = std::fmax((double)root(bend) / (double)h,
                                      (double)root(slope));
        h = std::fmin(100 * (double)h,
                      most > 1e-15 ? std::pow(0.01 / most, 1.0 / 8) : 1e-6);
    }
    for (bool refused = false; t < t1;) {
        T e5 = 0, e3 = 0, next;
        double ratio;
        const bool last = t + h * T(1.01) >= t1;

        if (last)
            h = t1 - t;
        if (++steps > 100000000 || t + h == t)
            return -1;
#define STAGE(s, c, terms)                                                               \
    for (int i = 0; i < n; i++)                                                          \
        z[i] = y[i] + h * (terms);                                                       \
    f(z, k[s]);
#include "ode/dop853.def"
        for (int i = 0; i < n; i++) {
#define A(j, a) +coefficient<T>(a, a##Q) * k[j][i]
#define WEIGHTS(terms) const T sum = (terms);
#define ERROR5(terms) T fifth = (terms);
#define THIRD(terms) T third = sum - (terms);
#include "ode/dop853.def"
            z[i] = y[i] + h * sum;

            const T from = y[i] < 0 ? -y[i] : y[i], to = z[i] < 0 ? -z[i] : z[i];
            const T scale = 1 / (tol * (1 + (from > to ? from : to)));

            fifth *= scale;
            third *= scale;
            e5 += fifth * fifth;
            e3 += third * third;
        }
        const T size = e5 + e3 / 100;
        ratio = size > 0 ? (double)(h * e5 / root(size * n)) : 0;
        if (!(ratio < 1e300))
            ratio = 1e300;
        next = last ? t1 : t + h;
        if (accepts(ratio, &refused, &h)) {
            t = next;
            std::memcpy(y, z, sizeof z);
            f(y, k[0]);
        }
    }
    return steps;
}

#endif
