/* domain.h -- the declared domains of coordinates, as numbers. */
#ifndef QDOT_SIM_DOMAIN_H
#define QDOT_SIM_DOMAIN_H

#include "ode/trajectory.h"
#include "sim/model/equations.h"

typedef struct {
    size_t coordinate; /* the index of the coordinate */
    double lo, hi;     /* bounds of the domain; -inf, inf: unbounded */
    bool lo_open, hi_open;
    char *text; /* the domain as text: "0 < theta < pi" */
} qdot_domain;

/* The domains of a run's coordinates. Start from {0}. */
typedef struct {
    size_t n;
    qdot_domain *at;
    const qdot_domain *left; /* the domain that the run has left, set by qdot_domains_watch; NULL: none */
} qdot_domains;

/* Find the domains of the plan's coordinates; bounds may contain parameters. Errors: QDOT_EUNSET
 * ... */
QDOT_MUST_CHECK qdot_status qdot_domains_find(const qdot_plan *plan,
                                              qdot_domains *domains);
void qdot_domains_clear(qdot_domains *domains);

/* The first domain that does not contain its coordinate in the state y [n ...]; NULL if all do. */
const qdot_domain *qdot_domains_outside(const qdot_domains *domains, const double *y);

/* For qdot_ode_options.accepted: stop at the first accepted step that ends outside, in a run with
 * `digits`. user: a qdot_domains. */
qdot_status qdot_domains_watch(double t, const double *y, bool *stop, void *user);

#endif
