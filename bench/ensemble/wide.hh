/* wide.hh -- DOP853 with as many members in a vector as the processor has lanes, eight with AVX-512, else
 * four, as an expert would write it by hand: one step for all of them, the worst deciding; sines by
 * glibc's vectors.
 */
#ifndef BENCH_ENSEMBLE_WIDE_HH
#define BENCH_ENSEMBLE_WIDE_HH

#include <cmath>
#include <cstring>
#include <immintrin.h>

#include "dop853.hh"

#ifdef __AVX512F__
enum { WIDTH = 8 };
typedef __m512d packed;
extern "C" packed _ZGVeN8v_sin(packed), _ZGVeN8v_cos(packed);
#define VECTOR_OF(name) _ZGVeN8v_##name
#else
enum { WIDTH = 4 };
typedef __m256d packed;
extern "C" packed _ZGVdN4v_sin(packed), _ZGVdN4v_cos(packed);
#define VECTOR_OF(name) _ZGVdN4v_##name
#endif

struct wide {
    packed v;

    wide() = default;
    wide(double x) : v(x - packed{}) {}
    wide(packed x) : v(x) {}
    double &operator[](int l) { return ((double *)&v)[l]; }
    friend wide operator+(wide a, wide b) { return wide(a.v + b.v); }
    friend wide operator-(wide a, wide b) { return wide(a.v - b.v); }
    friend wide operator*(wide a, wide b) { return wide(a.v * b.v); }
    friend wide operator/(wide a, wide b) { return wide(a.v / b.v); }
    wide operator-() const { return wide(-v); }
    wide operator+() const { return *this; }
    wide &operator+=(wide b) { return *this = *this + b; }
    wide &operator-=(wide b) { return *this = *this - b; }
    wide &operator*=(wide b) { return *this = *this * b; }
    wide &operator/=(wide b) { return *this = *this / b; }
};

inline void
sine_cosine(wide x, wide *s, wide *c)
{
    s->v = VECTOR_OF(sin)(x.v);
    c->v = VECTOR_OF(cos)(x.v);
}

inline double
worst(wide x)
{
    double most = 0;

    for (int l = 0; l < WIDTH; l++)
        most = x[l] <= most ? most : x[l];
    return most;
}

inline wide
larger(wide a, wide b)
{
    return wide(a.v > b.v ? a.v : b.v);
}

inline wide
size_of(wide a)
{
    return larger(a, -a);
}

/* y [n] from 0 to t1, as dop853 of dop853.hh; the first step is tried out. */
template <int n, class F> long
dop853_wide(F f, double t1, wide *y, double tol)
{
    wide k[13][n], z[n];
    double t = 0, h = 1e-2 * std::pow(tol / 1e-6, 0.125);
    long steps = 0;

    f(y, k[0]);
    for (bool refused = false; t < t1;) {
        wide e5 = 0, e3 = 0;
        double ratio = 0, next;
        const bool last = t + h * 1.01 >= t1;

        if (last)
            h = t1 - t;
        if (++steps > 100000000 || t + h == t)
            return -1;
#define A(j, a) +wide(a) * k[j][i]
#define STAGE(s, c, terms)                                                               \
    for (int i = 0; i < n; i++)                                                          \
        z[i] = y[i] + wide(h) * (terms);                                                 \
    f(z, k[s]);
#include "ode/dop853.def"
        for (int i = 0; i < n; i++) {
#define A(j, a) +wide(a) * k[j][i]
#define WEIGHTS(terms) const wide sum = (terms);
#define ERROR5(terms) wide fifth = (terms);
#define THIRD(terms) wide third = sum - (terms);
#include "ode/dop853.def"
            z[i] = y[i] + wide(h) * sum;

            const wide scale = wide(1 / tol) / (wide(1) + larger(size_of(y[i]), size_of(z[i])));

            fifth *= scale;
            third *= scale;
            e5 += fifth * fifth;
            e3 += third * third;
        }
        for (int l = 0; l < WIDTH; l++) {
            const double size = e5[l] + e3[l] / 100;
            const double own = size > 0 ? h * e5[l] / std::sqrt(size * n) : 0;

            ratio = own <= ratio ? ratio : own;
        }
        if (!(ratio < 1e300))
            ratio = 1e300;
        next = last ? t1 : t + h;
        if (accepts(ratio, &refused, &h)) {
            t = next;
            std::memcpy((void *)y, z, sizeof z);
            f(y, k[0]);
        }
    }
    return steps;
}

#endif
