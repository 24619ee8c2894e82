/* stepper.c -- steps by GSL or by a method of our own, with the state kept as a sum of two doubles. */
#include "ode/stepper.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

#include <gsl/gsl_errno.h>

#include "base/memory.h"
#include "num/sum.h"
#include "ode/run.h"
#include "ode/scale.h"

static pthread_once_t handler_once = PTHREAD_ONCE_INIT;

static void
turn_off_gsl_handler(void)
{
    gsl_set_error_handler_off();
}

qdot_status
qdot_ode_stepper_rhs(qdot_ode_stepper *s, double t, const double *y, double *dydt)
{
    s->evaluations++;
    QDOT_TRY(s->system->rhs(t, y, dydt, s->system->user));
    if (!qdot_ode_all_finite(dydt, s->system->n))
        return qdot_fail(QDOT_EDOMAIN, "the right-hand side is not finite");
    return QDOT_OK;
}

static inline void
add_increment(qdot_ode_stepper *s, const double *z, double *y)
{
    for (size_t i = 0; i < s->system->n; i++)
        y[i] = s->y[i] + (s->carry[i] + s->scale[i] * z[i]);
}

/* The functions that GSL calls. After any failure except GSL_EBADFUNC its multistep methods
 * restore their history; s->broken keeps the original status. */
static int
rhs_for_gsl(double t, const double *z, double *zdot, void *user)
{
    qdot_ode_stepper *s = user;

    if (s->method->multistep) {
        s->broken = qdot_ode_stepper_rhs(s, t, z, zdot);
    } else {
        add_increment(s, z, s->trial);
        s->broken = qdot_ode_stepper_rhs(s, t, s->trial, zdot);
        if (s->method->stiff)
            for (size_t i = 0; i < s->system->n; i++)
                zdot[i] /= s->scale[i];
    }
    return s->broken == QDOT_OK ? GSL_SUCCESS : GSL_FAILURE;
}

static int
jacobian_for_gsl(double t, const double *z, double *dfdy, double *dfdt, void *user)
{
    qdot_ode_stepper *s = user;
    const size_t n = s->system->n;
    const double *y = z;

    if (!s->method->multistep) {
        add_increment(s, z, s->trial);
        y = s->trial;
    }
    s->jacobians++;
    if (s->method->multistep)
        s->factorisations++;
    s->broken = s->system->jacobian(t, y, dfdy, dfdt, s->system->user);
    if (s->broken == QDOT_OK && !(qdot_ode_all_finite(dfdy, n * n) && qdot_ode_all_finite(dfdt, n)))
        s->broken = qdot_fail(QDOT_EDOMAIN, "the Jacobian is not finite");
    if (s->broken != QDOT_OK)
        return GSL_FAILURE;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++)
            dfdy[i * n + j] *= s->scale[j] / s->scale[i];
        dfdt[i] /= s->scale[i];
    }
    return GSL_SUCCESS;
}

/* GSL's object for step control, which GSL's multistep methods only ask for the tolerated error. */
typedef struct {
    double tol;
    const double *scales; /* [n] scales s_i of the system (scale.h) */
} level_of_error;

static int
tolerated_error_for_gsl(void *state, const double y, const double dydt, const double h,
                        const size_t ind, double *level)
{
    const level_of_error *of = state;

    (void)dydt;
    (void)h;
    *level = of->tol * qdot_ode_size(of->scales, ind, y);
    return GSL_SUCCESS;
}

static void *
allocate_control_for_gsl(void)
{
    return qdot_calloc(1, sizeof(level_of_error));
}

static int
ignore_control_options(void *state, double tol, double eps_rel, double a_y, double a_dydt)
{
    (void)eps_rel;
    (void)a_y;
    (void)a_dydt;
    ((level_of_error *)state)->tol = tol;
    return GSL_SUCCESS;
}

static int
keep_step_for_gsl(void *state, size_t n, unsigned order, const double *y,
                  const double *error, const double *dydt, double *h)
{
    (void)state;
    (void)n;
    (void)order;
    (void)y;
    (void)error;
    (void)dydt;
    (void)h;
    return GSL_ODEIV_HADJ_NIL;
}

static int
ignore_driver_of_gsl(void *state, const gsl_odeiv2_driver *driver)
{
    (void)state;
    (void)driver;
    return GSL_SUCCESS;
}

static const gsl_odeiv2_control_type control_type = {
    "qdot",      allocate_control_for_gsl,  ignore_control_options, keep_step_for_gsl,
    tolerated_error_for_gsl, ignore_driver_of_gsl, qdot_free,
};

static bool
stepper_allocate(qdot_ode_stepper *s, size_t n)
{
    const gsl_odeiv2_step_type *const *type = s->method->stepper;
    const size_t stages = s->method->kernel ? s->method->kernel->stages : 0;
    const qdot_part parts[] = {{&s->y, n},     {&s->carry, n},      {&s->dydt, n},
                               {&s->z, n},     {&s->error, n},      {&s->zdot, n},
                               {&s->scale, n}, {&s->trial, n},      {&s->trial_dydt, n},
                               {&s->moved, n}, {&s->moved_carry, n}, {&s->stages, stages * n}};

    if (qdot_calloc_parts(&s->room, sizeof parts / sizeof parts[0], parts) != QDOT_OK)
        return false;
    if (s->method->kernel)
        return !s->method->kernel->open || s->method->kernel->open(s) == QDOT_OK;
    s->step = gsl_odeiv2_step_alloc(*type, n);
    s->control = gsl_odeiv2_control_alloc(&control_type);
    if (!s->step || !s->control)
        return qdot_fail(QDOT_ENOMEM, "out of memory for the integrator"), false;
    return true;
}

qdot_status
qdot_ode_stepper_new(const qdot_ode_system *system, const qdot_ode_method *method,
                     double tol, qdot_ode_stepper **out)
{
    qdot_ode_stepper *s;

    *out = NULL;
    if (system->n == 0)
        return qdot_fail(QDOT_EINVAL, "there is nothing to integrate");
    QDOT_TRY(qdot_ode_check_tolerance(tol));
    if (!method->stepper && !method->kernel)
        return qdot_fail(QDOT_EINVAL, "%s is no stepper", method->name);
    if (method->needs_jacobian && !system->jacobian)
        return qdot_fail(QDOT_EINVAL, "%s needs the Jacobian of the equations",
                         method->name);
    pthread_once(&handler_once, turn_off_gsl_handler);
    s = qdot_calloc(1, sizeof *s);
    if (!s)
        return QDOT_ENOMEM;
    s->method = method;
    s->system = system;
    s->tol = tol;
    if (!stepper_allocate(s, system->n)) {
        qdot_ode_stepper_free(s);
        return QDOT_ENOMEM;
    }
    *out = s;
    if (!s->step)
        return QDOT_OK;
    s->inner = (gsl_odeiv2_system){rhs_for_gsl, jacobian_for_gsl, system->n, s};
    s->driver = (gsl_odeiv2_driver){.sys = &s->inner, .s = s->step, .c = s->control};
    gsl_odeiv2_control_init(s->control, tol, 0, 0, 0);
    ((level_of_error *)s->control->state)->scales = system->scales;
    gsl_odeiv2_step_set_driver(s->step, &s->driver);
    return QDOT_OK;
}

void
qdot_ode_stepper_free(qdot_ode_stepper *s)
{
    if (!s)
        return;
    if (s->step)
        gsl_odeiv2_step_free(s->step);
    if (s->control)
        gsl_odeiv2_control_free(s->control);
    if (s->method->kernel && s->method->kernel->close)
        s->method->kernel->close(s);
    qdot_free(s->room);
    qdot_free(s);
}

static void
choose_scales(qdot_ode_stepper *s)
{
    bool scaled = s->method->stiff && !s->method->multistep && !s->method->kernel;

    for (size_t i = 0; i < s->system->n; i++)
        s->scale[i] = scaled ? ldexp(1, ilogb(qdot_ode_size(s->system->scales, i, s->y[i]))) : 1;
}

void
qdot_ode_stepper_start(qdot_ode_stepper *s, const double *y)
{
    memcpy(s->y, y, s->system->n * sizeof *y);
    memset(s->carry, 0, s->system->n * sizeof *y);
    s->dydt_known = false;
    choose_scales(s);
    if (s->step)
        gsl_odeiv2_step_reset(s->step);
    else if (s->method->kernel->restart)
        s->method->kernel->restart(s);
}

/* The error of the step just tried divided by the tolerance; INFINITY if anything is not finite. */
static double
error_ratio_of_step(const qdot_ode_stepper *s)
{
    double ratio = 0;

    for (size_t i = 0; i < s->system->n; i++) {
        double size = qdot_ode_size(s->system->scales, i,
                                    fmax(fabs(s->y[i]), fabs(s->trial[i])));
        double r = fabs(s->error[i]) * s->scale[i] / (s->tol * size);

        if (!(r <= ratio))
            ratio = r;
        if (!isfinite(s->trial[i]) || !isfinite(r))
            return INFINITY;
    }
    return ratio;
}

/* Try a step of a multistep method of GSL, for which s->z is the new state itself. */
static int
apply_multistep(qdot_ode_stepper *s, double t, double h)
{
    const size_t n = s->system->n;
    int gsl;

    memcpy(s->z, s->y, n * sizeof *s->z);
    gsl = gsl_odeiv2_step_apply(s->step, t, h, s->z, s->error, NULL, NULL, &s->inner);
    memcpy(s->trial, s->z, n * sizeof *s->z);
    return gsl;
}

static int
apply_onestep(qdot_ode_stepper *s, double t, double h)
{
    const size_t n = s->system->n;
    int gsl;

    for (size_t i = 0; i < n; i++) {
        s->z[i] = 0;
        s->zdot[i] = s->dydt[i] / s->scale[i];
    }
    gsl = gsl_odeiv2_step_apply(s->step, t, h, s->z, s->error, s->zdot, NULL, &s->inner);
    if (s->method->stiff) /* count factorisations: an extrapolation method of order 2k factors k + 1 matrices */
        s->factorisations += gsl_odeiv2_step_order(s->step) / 2 + 1;
    add_increment(s, s->z, s->trial);
    return gsl;
}

/* Try a step by a method of GSL. */
static qdot_status
apply_gsl(qdot_ode_stepper *s, double t, double h, double *ratio)
{
    int gsl = s->method->multistep ? apply_multistep(s, t, h) : apply_onestep(s, t, h);

    if (s->broken != QDOT_OK)
        return s->broken;
    if (gsl == GSL_SUCCESS)
        *ratio = error_ratio_of_step(s);
    return QDOT_OK;
}

qdot_status
qdot_ode_stepper_try(qdot_ode_stepper *s, double t, double h, double *ratio)
{
    s->broken = QDOT_OK;
    *ratio = INFINITY;
    if (!s->method->multistep && !s->dydt_known) {
        QDOT_TRY(qdot_ode_stepper_rhs(s, t, s->y, s->dydt));
        s->dydt_known = true;
    }
    if (s->method->kernel)
        QDOT_TRY(s->method->kernel->step(s, t, h, ratio));
    else
        QDOT_TRY(apply_gsl(s, t, h, ratio));
    if (*ratio <= 1 && s->system->following)
        QDOT_TRY(s->system->following->derive(t + h, s->trial,
                                              s->system->following->user));
    if (*ratio <= 1 && !s->method->multistep)
        return qdot_ode_stepper_rhs(s, t + h, s->trial, s->trial_dydt);
    return QDOT_OK;
}

qdot_status
qdot_ode_stepper_project(qdot_ode_stepper *s, double t, double *ratio)
{
    const size_t n = s->system->n;
    double by;

    s->projected = false;
    if (!s->system->project || s->method->multistep)
        return QDOT_OK;
    for (size_t i = 0; i < n; i++) {
        s->moved[i] = s->y[i];
        s->moved_carry[i] = s->carry[i];
        qdot_sum_advance(&s->moved[i], &s->moved_carry[i], s->scale[i] * s->z[i]);
    }
    QDOT_TRY(s->system->project(t, s->moved, s->moved_carry, &by, s->system->user));
    if (by == 0)
        return QDOT_OK;
    *ratio = fmax(*ratio, by / fmax(100 * s->tol, 1e-13));
    memcpy(s->trial, s->moved, n * sizeof *s->trial);
    s->projected = true;
    return QDOT_OK;
}

/* Compute, at the end of the step in s->trial, those components that are functions of the others. */
static void
derive_components(qdot_ode_stepper *s)
{
    const qdot_ode_following *f = s->system->following;

    for (size_t k = 0; f && k < f->n; k++) {
        s->y[f->index[k]] = s->trial[f->index[k]];
        s->carry[f->index[k]] = 0;
    }
}

void
qdot_ode_stepper_accept(qdot_ode_stepper *s)
{
    const size_t n = s->system->n;

    if (s->method->kernel && s->method->kernel->accepted)
        s->method->kernel->accepted(s);
    if (s->projected) {
        memcpy(s->y, s->moved, n * sizeof *s->y);
        memcpy(s->carry, s->moved_carry, n * sizeof *s->carry);
        s->projected = false;
        s->dydt_known = false;
        choose_scales(s);
        return;
    }

    if (s->method->multistep) {
        memcpy(s->y, s->z, n * sizeof *s->y);
        derive_components(s);
        return;
    }
    for (size_t i = 0; i < n; i++)
        qdot_sum_advance(&s->y[i], &s->carry[i], s->scale[i] * s->z[i]);
    derive_components(s);
    memcpy(s->dydt, s->trial_dydt, n * sizeof *s->dydt);
    choose_scales(s);
}

double
qdot_ode_stepper_error_power(const qdot_ode_stepper *s)
{
    if (s->method->kernel && s->method->kernel->power)
        return s->method->kernel->power(s);
    if (s->method->error_power)
        return s->method->error_power;
    return gsl_odeiv2_step_order(s->step) + 1.0;
}
