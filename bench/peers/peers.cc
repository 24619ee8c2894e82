/* peers -- one scene by one peer, over a ladder of tolerances.
 *
 *   peers METHOD SCENE FROM TO STEPS MOST
 *
 *   METHOD    rk8pd (GSL), dop853 (dop853.hh), rkf78 (Boost.odeint), adams (CVODE),
 *             fehlberg (ARKODE's explicit order 8)
 *   FROM TO   exponents of the first and last tolerance, STEPS a decade
 *   MOST      seconds: no tighter tolerance after a run that takes longer
 *
 * A line a tolerance: `tol seconds evaluations y...`, or `tol failed`. Tolerances are
 * both absolute and relative. A run of less than 2 ms is repeated, and the mean taken.
 */
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include <boost/numeric/odeint.hpp>

#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "scenes.hh"

#include "dop853.hh"
#include "names.hh"

static long evaluations;

static double
seconds()
{
    timespec now;

    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/* --- GSL ---------------------------------------------------------------------------- */

template <class S> static int
gsl_f(double, const double *y, double *d, void *)
{
    evaluations++;
    S::f(y, d);
    return GSL_SUCCESS;
}

template <class S> static bool
rk8pd(double *y, double tol)
{
    gsl_odeiv2_system system = {gsl_f<S>, nullptr, S::size, nullptr};
    gsl_odeiv2_driver *driver =
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-3, tol, tol);
    double t = 0;
    int status = gsl_odeiv2_driver_apply(driver, &t, S::template end<double>(), y);

    gsl_odeiv2_driver_free(driver);
    return status == GSL_SUCCESS;
}

/* --- Boost.odeint ------------------------------------------------------------------- */

template <class S> static bool
rkf78(double *y, double tol)
{
    using namespace boost::numeric::odeint;
    using state = std::array<double, S::size>;
    state x;

    std::copy(y, y + S::size, x.begin());
    integrate_adaptive(
        make_controlled<runge_kutta_fehlberg78<state>>(tol, tol),
        [](const state &at, state &d, double) {
            evaluations++;
            S::f(at.data(), d.data());
        },
        x, 0.0, S::template end<double>(), 1e-3);
    std::copy(x.begin(), x.end(), y);
    return true;
}

/* --- SUNDIALS ----------------------------------------------------------------------- */

template <class S> static int
sundials_f(realtype, N_Vector y, N_Vector d, void *)
{
    evaluations++;
    S::f(N_VGetArrayPointer(y), N_VGetArrayPointer(d));
    return 0;
}

static void
silent(int, const char *, const char *, char *, void *)
{
}

template <class S> static bool
adams(double *y, double tol)
{
    SUNContext context;
    SUNContext_Create(nullptr, &context);
    N_Vector x = N_VMake_Serial(S::size, y, context);
    SUNNonlinearSolver solver = SUNNonlinSol_FixedPoint(x, 0, context);
    void *memory = CVodeCreate(CV_ADAMS, context);
    double t, end = S::template end<double>();
    bool good;

    CVodeSetErrHandlerFn(memory, silent, nullptr);
    CVodeInit(memory, sundials_f<S>, 0, x);
    CVodeSStolerances(memory, tol, tol);
    CVodeSetMaxNumSteps(memory, 100000000);
    CVodeSetNonlinearSolver(memory, solver);
    CVodeSetStopTime(memory, end);
    good = CVode(memory, end, x, &t, CV_NORMAL) >= 0;
    CVodeFree(&memory);
    SUNNonlinSolFree(solver);
    N_VDestroy(x);
    SUNContext_Free(&context);
    return good;
}

template <class S> static bool
fehlberg(double *y, double tol)
{
    SUNContext context;
    SUNContext_Create(nullptr, &context);
    N_Vector x = N_VMake_Serial(S::size, y, context);
    void *memory = ERKStepCreate(sundials_f<S>, 0, x, context);
    double t, end = S::template end<double>();
    bool good;

    ERKStepSetErrHandlerFn(memory, silent, nullptr);
    ERKStepSetTableNum(memory, ARKODE_FEHLBERG_13_7_8);
    ERKStepSStolerances(memory, tol, tol);
    ERKStepSetMaxNumSteps(memory, 100000000);
    ERKStepSetStopTime(memory, end);
    good = ERKStepEvolve(memory, end, x, &t, ARK_NORMAL) >= 0;
    ERKStepFree(&memory);
    N_VDestroy(x);
    SUNContext_Free(&context);
    return good;
}

/* --- the ladder --------------------------------------------------------------------- */

template <class S> static bool
hairer(double *y, double tol)
{
    return dop853<S::size>(
               [](const double *x, double *d) {
                   evaluations++;
                   S::f(x, d);
               },
               S::template end<double>(), y, tol) >= 0;
}

template <class S> static bool
run(const std::string &method, double *y, double tol)
{
    if (method == "rk8pd")
        return rk8pd<S>(y, tol);
    if (method == "dop853")
        return hairer<S>(y, tol);
    if (method == "rkf78")
        return rkf78<S>(y, tol);
    if (method == "adams")
        return adams<S>(y, tol);
    if (method == "fehlberg")
        return fehlberg<S>(y, tol);
    std::fprintf(stderr, "there is no method %s\n", method.c_str());
    std::exit(2);
}

template <class S> static int
climb(const std::string &method, double from, double to, double a_decade, double most)
{
    for (int k = 0;; k++) {
        const double power = from - k / a_decade, tol = std::pow(10, power);
        double y[S::size], began, taken;
        bool good = true;
        int runs = 0;

        if (power < to - 1e-9)
            return 0;
        evaluations = 0;
        began = seconds();
        do {
            S::start(y);
            good = run<S>(method, y, tol);
            for (double x : y)
                good = good && std::isfinite(x);
            runs++;
            taken = seconds() - began;
        } while (good && taken < 0.002);
        std::printf("%.3g", tol);
        if (good) {
            std::printf(" %.9f %ld", taken / runs, evaluations / runs);
            for (double x : y)
                std::printf(" %.17g", x);
        } else {
            std::printf(" failed");
        }
        std::printf("\n");
        std::fflush(stdout);
        if (taken > most)
            return 0;
    }
}

int
main(int argc, char **argv)
{
    if (argc != 7) {
        std::fprintf(stderr, "usage: peers METHOD SCENE FROM TO STEPS MOST\n");
        return 2;
    }
    gsl_set_error_handler_off();
    return with_scene(argv[2], [&](auto scene) {
        return climb<decltype(scene)>(argv[1], std::atof(argv[3]), std::atof(argv[4]),
                                      std::atof(argv[5]), std::atof(argv[6]));
    });
}
