/* reference -- end states of the scenes, in 113 bits, for bench/peers/reference.
 *
 *   reference SCENE [TOLERANCE]
 *
 * DOP853 in __float128 at two tolerances, chains by their tensions, and what the two
 * differ by, relative to max(1, |y|). The coefficients have 30 digits: nothing below
 * 1e-28 counts. Build: g++ -std=gnu++17 -O2 -I../../lib reference.cc -lquadmath
 */
#include <cstdio>

#include "scenes.hh"

#include "dop853.hh"
#include "names.hh"

using wide = __float128;

template <class S> static int
print(double tol)
{
    wide y[2][S::size], worst = 0;

    for (int k = 0; k < 2; k++) {
        S::start(y[k]);
        if (dop853<S::size>([](const wide *x, wide *d) { S::f(x, d); },
                            S::template end<wide>(), y[k], wide(k ? tol / 100 : tol)) < 0)
            return 1;
    }
    for (int i = 0; i < S::size; i++) {
        wide difference = fabsq(y[0][i] - y[1][i]) / fmaxq(1, fabsq(y[1][i]));
        char text[64];

        worst = fmaxq(worst, difference);
        quadmath_snprintf(text, sizeof text, "%.24Qg", y[1][i]);
        std::puts(text);
    }
    std::fprintf(stderr, "# tolerances %g and %g differ by %.1e\n", tol, tol / 100,
                 (double)worst);
    return 0;
}

int
main(int argc, char **argv)
{
    if (argc < 2)
        return 2;
    return with_scene(argv[1], [&](auto scene) {
        return print<decltype(scene)>(argc > 2 ? std::atof(argv[2]) : 1e-20);
    });
}
