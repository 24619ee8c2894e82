/* peers.cc -- members of a sweep by hand-written peers: see `sweeps`.
 *
 *     peers SCENE METHOD TARGET [THREADS] < CSV
 *     peers cpu|wall COMMAND ...     seconds of the processor, or of the clock, that the command takes
 *
 *   METHOD  dop853 (peers/dop853.hh), rkf78 (Boost.odeint); wide, wide78: the same with eight members a
 *           vector, or four (wide.hh)
 *   THREADS by OpenMP, by the clock; without it one, by the processor's time
 *   CSV     a header; what the scene sweeps, then the coordinates at its end
 *
 * Takes the loosest tolerance of a ladder, two a decade, by which the median of the members' errors at
 * the end, over max(1, |q|), is at most TARGET. Prints: scene, method, target, tolerance, that error,
 * members a second.
 */
#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cstdlib>
#include <cstdio>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include "scenes.hh"

#include "dop853.hh"
#include "wide.hh"

template <> const wide gravity<wide> = wide(9.81);

/* --- scenes, with the start that a number makes ------------------------------------------ */

struct pendulum_swept : pendulum {
    static constexpr double t1 = 20;
    static void at(double a, double *y) { y[0] = a, y[1] = 0; }
};

struct double_swept : twofold {
    static constexpr double t1 = 10;
    static void at(double a, double *y) { y[0] = a, y[1] = 1, y[2] = y[3] = 0; }
};

struct henon_swept {
    static constexpr int size = 4;
    static constexpr double t1 = 100;
    static void at(double a, double *y) { y[0] = 0, y[1] = 0.1, y[2] = a, y[3] = 0; }
    template <class T> static void f(const T *y, T *d)
    {
        d[0] = y[2];
        d[1] = y[3];
        d[2] = -y[0] - T(2) * y[0] * y[1];
        d[3] = -y[1] - y[0] * y[0] + y[1] * y[1];
    }
};

struct spherical_swept : spherical_pole {
    static constexpr double t1 = 20;
    static void at(double a, double *y) { y[0] = a, y[1] = y[2] = 0, y[3] = 1; }
};

struct kepler_swept : kepler_polar {
    static constexpr double t1 = 20;
    static void at(double a, double *y) { y[0] = 1, y[1] = y[2] = 0, y[3] = a; }
};

struct chain_swept : chain_linear<8> {
    static constexpr double t1 = 5;
    static void at(double a, double *y)
    {
        for (int i = 0; i < 8; i++)
            y[i] = a, y[8 + i] = 0;
    }
};

/* --- methods ------------------------------------------------------------------------------ */

typedef std::vector<double> numbers;

/* The error of a step as odeint's own checker has it, of the worst of four members. */
struct worst_of_four {
    double tol;

    template <class State, class Deriv, class Err, class Time>
    double error(const State &x, const Deriv &d, Err &err, Time h) const
    {
        double most = 0;

        for (size_t i = 0; i < x.size(); i++)
            most = std::fmax(most, worst(size_of(err[i])
                                         / (wide(tol) * (wide(1) + size_of(x[i])
                                                         + wide(std::fabs(h)) * size_of(d[i])))));
        return most;
    }
    template <class Algebra, class State, class Deriv, class Err, class Time>
    double error(Algebra &, const State &x, const Deriv &d, Err &err, Time h) const
    {
        return error(x, d, err, h);
    }
};

/* One of a method, through T: double, or four members. */
template <class S, class T> void
fehlberg(T *y, double tol)
{
    using namespace boost::numeric::odeint;
    typedef std::array<T, S::size> state;
    typedef runge_kutta_fehlberg78<state, double, state, double, array_algebra> stepper;
    const auto f = [](const state &at, state &d, double) { S::template f<T>(at.data(), d.data()); };
    state x;

    std::copy(y, y + S::size, x.begin());
    if constexpr (std::is_same<T, double>::value)
        integrate_adaptive(make_controlled<stepper>(tol, tol), f, x, 0.0, S::t1, 0.01);
    else
        integrate_adaptive(controlled_runge_kutta<stepper, worst_of_four>(worst_of_four{tol}), f, x,
                           0.0, S::t1, 0.01);
    std::copy(x.begin(), x.end(), y);
}

template <class S> void
run_four(const std::string &method, const numbers &starts, size_t m, double tol, numbers &ends)
{
    const size_t n = S::size, members = starts.size();
    wide y[S::size];
    double one[S::size];

    for (size_t l = 0; l < WIDTH; l++) {
        S::at(starts[std::min(m + l, members - 1)], one);
        for (size_t i = 0; i < n; i++)
            y[i][(int)l] = one[i];
    }
    if (method == "wide")
        dop853_wide<S::size>(S::template f<wide>, S::t1, y, tol);
    else
        fehlberg<S, wide>(y, tol);
    for (size_t l = 0; l < WIDTH && m + l < members; l++)
        for (size_t i = 0; i < n; i++)
            ends[(m + l) * n + i] = y[i][(int)l];
}

template <class S> void
run_all(const std::string &method, const numbers &starts, double tol, numbers &ends, int threads)
{
    const size_t n = S::size, members = starts.size();
    const bool vectors = method.substr(0, 4) == "wide";

#pragma omp parallel for num_threads(threads) schedule(dynamic)
    for (size_t m = 0; m < members; m += vectors ? WIDTH : 1) {
        double *y = &ends[m * n];

        if (vectors) {
            run_four<S>(method, starts, m, tol, ends);
            continue;
        }
        S::at(starts[m], y);
        if (method == "dop853")
            dop853<S::size, double>(S::template f<double>, S::t1, y, tol);
        else
            fehlberg<S, double>(y, tol);
    }
}

static double
seconds_of(int who)
{
    struct rusage r;

    getrusage(who, &r);
    return (double)(r.ru_utime.tv_sec + r.ru_stime.tv_sec)
           + 1e-6 * (double)(r.ru_utime.tv_usec + r.ru_stime.tv_usec);
}

static double
clock_now(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int
time_command(bool by_clock, char **argv)
{
    const double begun = clock_now();
    int status = 0;

    if (fork() == 0) {
        if (!freopen("/dev/null", "w", stdout))
            _exit(1);
        execvp(argv[0], argv);
        _exit(1);
    }
    wait(&status);
    printf("%.4f\n", by_clock ? clock_now() - begun : seconds_of(RUSAGE_CHILDREN));
    return status != 0;
}

template <class S> int
measure(const char *scene, const std::string &method, double target, int threads)
{
    const auto now = [=] { return threads > 1 ? clock_now() : seconds_of(RUSAGE_SELF); };
    const size_t n = S::size;
    numbers starts, want, ends, errors;
    char line[4096];

    if (!fgets(line, sizeof line, stdin))
        return 1;
    while (fgets(line, sizeof line, stdin)) {
        char *at = line;

        starts.push_back(strtod(at, &at));
        for (size_t i = 0; i < n / 2; i++)
            want.push_back(strtod(at + 1, &at));
    }
    ends.resize(starts.size() * n);
    for (int k = 2; k > -12; k--) {
        const double tol = target * std::pow(10, 0.5 * k);
        double begun, seconds;
        long rounds = 0;

        if (tol < 2e-16)
            break;
        run_all<S>(method, starts, tol, ends, 1);
        errors.clear();
        for (size_t m = 0; m < starts.size(); m++) {
            double worst = 0;

            for (size_t i = 0; i < n / 2; i++) {
                const double q = want[m * n / 2 + i], off = std::fabs(ends[m * n + i] - q);

                worst = std::fmax(worst, off / std::fmax(1, std::fabs(q)));
            }
            errors.push_back(worst);
        }
        std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
        if (!(errors[errors.size() / 2] <= target))
            continue;
        begun = now();
        do {
            run_all<S>(method, starts, tol, ends, threads);
            rounds++;
            seconds = now() - begun;
        } while (seconds < 0.3);
        printf("%s %s %.0e %.1e %.1e %.3g\n", scene, method.c_str(), target, tol,
               errors[errors.size() / 2], (double)rounds * (double)starts.size() / seconds);
        return 0;
    }
    printf("%s %s %.0e - - -\n", scene, method.c_str(), target);
    return 0;
}

int
main(int argc, char **argv)
{
    if (argc > 2 && (std::string(argv[1]) == "cpu" || std::string(argv[1]) == "wall"))
        return time_command(argv[1][0] == 'w', argv + 2);
    if (argc != 4 && argc != 5)
        return 2;
    const std::string scene = argv[1];
    const double target = atof(argv[3]);
    const int threads = argc > 4 ? atoi(argv[4]) : 1;

#define SCENE(name)                                                                      \
    if (scene == #name)                                                                  \
        return measure<name##_swept>(#name, argv[2], target, threads);
    SCENE(pendulum)
    SCENE(double)
    SCENE(henon)
    SCENE(spherical)
    SCENE(kepler)
    SCENE(chain)
    return 2;
}
