/* wide.hh -- DOP853 with four members in a vector, as an expert would write it by hand: one step for all
 * of them, the worst of the four deciding; sines by glibc's vectors.
 */
#ifndef BENCH_ENSEMBLE_WIDE_HH
#define BENCH_ENSEMBLE_WIDE_HH

#include <cmath>
#include <cstring>
#include <immintrin.h>

#include "dop853.hh"

extern "C" {
__m256d _ZGVdN4v_sin(__m256d);
__m256d _ZGVdN4v_cos(__m256d);
}

struct wide {
    __m256d v;

    wide() = default;
    wide(double x) : v(_mm256_set1_pd(x)) {}
    wide(__m256d x) : v(x) {}
    double &operator[](int l) { return ((double *)&v)[l]; }
    friend wide operator+(wide a, wide b) { return wide(_mm256_add_pd(a.v, b.v)); }
    friend wide operator-(wide a, wide b) { return wide(_mm256_sub_pd(a.v, b.v)); }
    friend wide operator*(wide a, wide b) { return wide(_mm256_mul_pd(a.v, b.v)); }
    friend wide operator/(wide a, wide b) { return wide(_mm256_div_pd(a.v, b.v)); }
    wide operator-() const { return wide(_mm256_sub_pd(_mm256_setzero_pd(), v)); }
    wide operator+() const { return *this; }
    wide &operator+=(wide b) { return *this = *this + b; }
    wide &operator-=(wide b) { return *this = *this - b; }
    wide &operator*=(wide b) { return *this = *this * b; }
    wide &operator/=(wide b) { return *this = *this / b; }
};

inline void
sine_cosine(wide x, wide *s, wide *c)
{
    s->v = _ZGVdN4v_sin(x.v);
    c->v = _ZGVdN4v_cos(x.v);
}

inline double
worst(wide x)
{
    double most = 0;

    for (int l = 0; l < 4; l++)
        most = x[l] <= most ? most : x[l];
    return most;
}

inline wide
larger(wide a, wide b)
{
    return wide(_mm256_max_pd(a.v, b.v));
}

inline wide
size_of(wide a)
{
    return wide(_mm256_andnot_pd(_mm256_set1_pd(-0.0), a.v));
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
        for (int l = 0; l < 4; l++) {
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
