/* scenes.hh -- the scenes of bench/numeric as their users write them: y' = f(y) by hand.
 *
 * y holds the coordinates, then the velocities. T is double, or __float128 for the
 * references. Masses and lengths are 1, g = 9.81; peers/scene has the same for qdot.
 */
#ifndef BENCH_PEERS_SCENES_HH
#define BENCH_PEERS_SCENES_HH

#include <array>
#include <cmath>
#include <quadmath.h>

inline void sine_cosine(double x, double *s, double *c) { sincos(x, s, c); }
inline void sine_cosine(__float128 x, __float128 *s, __float128 *c) { sincosq(x, s, c); }
inline double root(double x) { return std::sqrt(x); }
inline __float128 root(__float128 x) { return sqrtq(x); }

template <class T> const T gravity = T(981) / 100;
template <class T> const T pi = T(M_PIq);

/* --- one and two bodies ------------------------------------------------------------- */

struct pendulum {
    static constexpr int size = 2;
    template <class T> static T end() { return 1000; }
    template <class T> static void start(T *y) { y[0] = 2, y[1] = 0; }
    template <class T> static void f(const T *y, T *d)
    {
        T s, c;

        sine_cosine(y[0], &s, &c);
        d[0] = y[1];
        d[1] = -gravity<T> * s;
    }
};

struct twofold {
    static constexpr int size = 4;
    template <class T> static T end() { return 20; }
    template <class T> static void start(T *y) { y[0] = y[1] = 2, y[2] = y[3] = 0; }
    template <class T> static void f(const T *y, T *d)
    {
        T s1, c1, s2, c2;

        sine_cosine(y[0], &s1, &c1);
        sine_cosine(y[1], &s2, &c2);
        const T s = s1 * c2 - c1 * s2, c = c1 * c2 + s1 * s2;
        const T a = -s * y[3] * y[3] - 2 * gravity<T> * s1;
        const T b = s * y[2] * y[2] - gravity<T> * s2, w = 1 / (2 - c * c);
        d[0] = y[2];
        d[1] = y[3];
        d[2] = (a - c * b) * w;
        d[3] = (2 * b - c * a) * w;
    }
};

struct kepler_polar {
    static constexpr int size = 4;
    template <class T> static T end() { return 200 * pi<T>; }
    template <class T> static void start(T *y)
    {
        y[0] = T(1) / 10, y[1] = y[2] = 0, y[3] = 10 * root(T(19));
    }
    template <class T> static void f(const T *y, T *d)
    {
        const T w = 1 / y[0];

        d[0] = y[2];
        d[1] = y[3];
        d[2] = y[0] * y[3] * y[3] - w * w;
        d[3] = -2 * y[2] * y[3] * w;
    }
};

struct spherical_pole {
    static constexpr int size = 4;
    template <class T> static T end() { return 100; }
    template <class T> static void start(T *y)
    {
        y[0] = 1, y[1] = y[2] = 0, y[3] = T(1) / 100;
    }
    template <class T> static void f(const T *y, T *d)
    {
        T s, c;

        sine_cosine(y[0], &s, &c);
        d[0] = y[2];
        d[1] = y[3];
        d[2] = s * (c * y[3] * y[3] - gravity<T>);
        d[3] = -2 * c / s * y[2] * y[3];
    }
};

/* (r, theta); the spring of stiffness 1e6 and rest length 1. */
struct stiff_spring {
    static constexpr int size = 4;
    template <class T> static T end() { return 10; }
    template <class T> static void start(T *y)
    {
        y[0] = T(100000981) / 100000000, y[1] = 1, y[2] = y[3] = 0;
    }
    template <class T> static void f(const T *y, T *d)
    {
        T s, c;

        sine_cosine(y[1], &s, &c);
        d[0] = y[2];
        d[1] = y[3];
        d[2] = y[0] * y[3] * y[3] + gravity<T> * c - 1000000 * (y[0] - 1);
        d[3] = -(gravity<T> * s + 2 * y[2] * y[3]) / y[0];
    }
};

/* --- chains of N links, from horizontal rest ---------------------------------------- */

template <int N> struct chain_start {
    static constexpr int size = 2 * N;
    template <class T> static T end() { return 5; }
    template <class T> static void start(T *y)
    {
        for (int i = 0; i < N; i++)
            y[i] = pi<T> / 2, y[N + i] = 0;
    }
};

/* The mass matrix M_ij = (N - max(i, j)) cos(theta_i - theta_j), i, j = 0 .. N-1, by
 * Cholesky's method; the innermost loops run along rows. */
template <int N> struct chain : chain_start<N> {
    template <class T> static void f(const T *y, T *d)
    {
        const T *w = y + N;
        T s[N], c[N], M[N][N], x[N];

        for (int i = 0; i < N; i++) {
            sine_cosine(y[i], s + i, c + i);
            x[i] = -(N - i) * gravity<T> * s[i];
        }
        for (int i = 0; i < N; i++) {
            T sum = 0;

            for (int j = 0; j < i; j++)
                sum += (N - i) * (s[i] * c[j] - c[i] * s[j]) * w[j] * w[j];
            for (int j = i; j < N; j++) {
                sum += (N - j) * (s[i] * c[j] - c[i] * s[j]) * w[j] * w[j];
                M[i][j] = (N - j) * (c[i] * c[j] + s[i] * s[j]);
            }
            x[i] -= sum;
        }
        for (int k = 0; k < N; k++) {
            const T r = 1 / root(M[k][k]);

            for (int j = k; j < N; j++)
                M[k][j] *= r;
            x[k] *= r;
            for (int i = k + 1; i < N; i++) {
                for (int j = i; j < N; j++)
                    M[i][j] -= M[k][i] * M[k][j];
                x[i] -= M[k][i] * x[k];
            }
            M[k][k] = r;
        }
        for (int i = N - 1; i >= 0; i--) {
            for (int j = i + 1; j < N; j++)
                x[i] -= M[i][j] * x[j];
            x[i] *= M[i][i];
        }
        for (int i = 0; i < N; i++)
            d[i] = w[i], d[N + i] = x[i];
    }
};

/* With u_k along link k and a_k the acceleration of bob k, a_k = -T_k u_k + T_k+1 u_k+1
 * + g, and (a_k - a_k-1).u_k = -w_k^2 is a tridiagonal system for the tensions. */
template <int N> struct chain_linear : chain_start<N> {
    template <class T> static void f(const T *y, T *d)
    {
        const T *w = y + N;
        T s[N], c[N], next[N], diagonal[N], t[N];

        for (int i = 0; i < N; i++)
            sine_cosine(y[i], s + i, c + i);
        for (int i = 0; i + 1 < N; i++)
            next[i] = -(s[i] * s[i + 1] + c[i] * c[i + 1]);
        diagonal[0] = 1;
        t[0] = w[0] * w[0] + gravity<T> * c[0];
        for (int i = 1; i < N; i++) {
            const T factor = next[i - 1] / diagonal[i - 1];

            diagonal[i] = 2 - factor * next[i - 1];
            t[i] = w[i] * w[i] - factor * t[i - 1];
        }
        t[N - 1] /= diagonal[N - 1];
        for (int i = N - 2; i >= 0; i--)
            t[i] = (t[i] - next[i] * t[i + 1]) / diagonal[i];
        for (int i = 0; i < N; i++) {
            d[i] = w[i];
            d[N + i] = i ? t[i - 1] * (s[i - 1] * c[i] - c[i - 1] * s[i])
                         : -gravity<T> * s[0];
            if (i + 1 < N)
                d[N + i] += t[i + 1] * (s[i + 1] * c[i] - c[i + 1] * s[i]);
        }
    }
};

#endif
