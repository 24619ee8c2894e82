/* method-table.c -- the table of integration methods declared in method.h. */
#include "ode/method.h"

#include <string.h>

#include <gsl/gsl_odeiv2.h>

#include "ode/dop853.h"
#include "ode/geometric/geometric.h"
#include "ode/radau.h"

static const qdot_ode_method methods[] = {
    {"rk8pd", 8, false, false, false, 8, "rk8pd", 1e-2, 5e-15,
     "Runge-Kutta of order 8: smooth scenes at any tolerance",
     &gsl_odeiv2_step_rk8pd, false, NULL, NULL},
    {"rkf45", 5, false, false, false, 5, "rk8pd", 1e-2, 5e-16,
     "Runge-Kutta-Fehlberg of order 5: coarse tolerances, cheap or rough scenes",
     &gsl_odeiv2_step_rkf45, false, NULL, NULL},
    {"msadams", 12, false, true, false, 0, "rk8pd", 1e-2, 5e-16,
     "Adams, orders 1 to 12: smooth scenes whose evaluation is expensive",
     &gsl_odeiv2_step_msadams, false, NULL, NULL},
    {"msbdf", 5, true, true, true, 0, "bsimp", 0.1, 3e-16,
     "backward differences, orders 1 to 5: stiff scenes, moderate tolerances",
     &gsl_odeiv2_step_msbdf, false, NULL, NULL},
    {"bsimp", 12, true, false, true, 0, "bsimp", 1e-6, 3e-16,
     "implicit Bulirsch-Stoer: stiff scenes that are smooth, tight tolerances",
     &gsl_odeiv2_step_bsimp, false, NULL, NULL},
    {"dop853", 8, false, false, false, 8, "dop853", 1e-2, 1e-15,
     "Runge-Kutta of order 8 with a polynomial of its own: as rk8pd, much output", NULL,
     false, &qdot_dop853, NULL},
    {"radau", 13, true, false, true, 0, "radau", 0.2, 1e-14,
     "Radau IIA, orders 5, 9 and 13: stiff scenes at any tolerance", NULL, false, &qdot_radau,
     NULL},
    {"taylor", 40, false, false, false, 0, "taylor", 1e-2, 1e-16,
     "Taylor series, order by tolerance: smooth scenes, the fastest where it fits", NULL,
     true, NULL, NULL},
    {"verlet", 2, false, false, false, 3, "rk8pd", 1e-2, 1e-15,
     "Stoermer-Verlet, symplectic: long times at coarse tolerances, M constant, V(q, t)", NULL,
     false, NULL, &qdot_verlet},
    {"composition8", 8, false, false, false, 9, "rk8pd", 1e-2, 1e-15,
     "17 steps of verlet composed to order 8: long times, M constant, V(q, t)", NULL,
     false, NULL, &qdot_composition8},
    {"gauss4", 4, false, false, false, 5, "rk8pd", 1e-2, 1e-15,
     "Gauss collocation of order 4, symplectic: long times at coarse tolerances",
     NULL, false, NULL, &qdot_gauss4},
    {"gauss6", 6, false, false, false, 7, "rk8pd", 1e-2, 1e-15,
     "Gauss collocation of order 6, symplectic: long times",
     NULL, false, NULL, &qdot_gauss6},
    {"gauss8", 8, false, false, false, 9, "rk8pd", 1e-2, 1e-15,
     "Gauss collocation of order 8, symplectic: long times at tight tolerances",
     NULL, false, NULL, &qdot_gauss8},
    {"gauss12", 12, false, false, false, 13, "rk8pd", 1e-2, 1e-15,
     "Gauss collocation of order 12, symplectic: long times at the last digits",
     NULL, false, NULL, &qdot_gauss12},
    {"variational", 10, false, false, false, 11, "rk8pd", 1e-2, 1e-15,
     "variational of order 10, symplectic: long times, also with constraints on positions",
     NULL, false, NULL, &qdot_variational},
};

size_t
qdot_ode_method_count(void)
{
    return sizeof methods / sizeof methods[0];
}

const qdot_ode_method *
qdot_ode_method_at(size_t i)
{
    return i < qdot_ode_method_count() ? &methods[i] : NULL;
}

const qdot_ode_method *
qdot_ode_method_find(const char *name)
{
    for (size_t i = 0; i < qdot_ode_method_count(); i++)
        if (strcmp(methods[i].name, name) == 0)
            return &methods[i];
    return NULL;
}
