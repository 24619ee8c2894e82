/* domain.c -- the declared domains of the coordinates, and whether a state lies inside. */
#include "sim/model/domain.h"

#include <math.h>
#include <string.h>

#include "expr/constant.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "sim/model/parameter-states.h"

void
qdot_domains_clear(qdot_domains *d)
{
    for (size_t i = 0; i < d->n; i++)
        qdot_free(d->at[i].text);
    qdot_free(d->at);
    *d = (qdot_domains){0};
}

/* Describe a domain, as in "0 < theta <= pi". */
static qdot_status
domain_describe(const qdot_plan *p, const qdot_symbol *s, const char *name, char **text)
{
    qdot_text t = {0};
    qdot_status status = QDOT_OK;

    if (s->lo != QDOT_NIL) {
        status = qdot_print(p->pool, s->lo, QDOT_PLAIN, &t);
        qdot_text_add(&t, s->lo_open ? " < " : " <= ");
    }
    qdot_text_add(&t, name);
    if (s->hi != QDOT_NIL && status == QDOT_OK) {
        qdot_text_add(&t, s->hi_open ? " < " : " <= ");
        status = qdot_print(p->pool, s->hi, QDOT_PLAIN, &t);
    }
    if (status == QDOT_OK)
        status = qdot_text_status(&t);
    if (status == QDOT_OK) {
        *text = qdot_strdup(qdot_text_str(&t));
        status = *text ? QDOT_OK : QDOT_ENOMEM;
    }
    qdot_text_clear(&t);
    return status;
}

static qdot_status
evaluate_bound(const qdot_plan *p, const char *name, qdot_expr e, double none, double *value)
{
    bool some, moves;

    *value = none;
    if (e == QDOT_NIL)
        return QDOT_OK;
    e = qdot_plan_substitute(p, e);
    QDOT_TRY(qdot_pool_check(p->pool));
    QDOT_TRY(qdot_parameter_states_occur(p, e, &some, &moves));
    if (some) {
        qdot_fail(QDOT_EINVAL,
                  "the domain of %.100s holds a parameter that an event sets: it would move",
                  name);
        return qdot_hint("an event that stops the run, with the bound in it");
    }
    return qdot_constant_double(p->pool, e, value);
}

qdot_status
qdot_domains_find(const qdot_plan *p, qdot_domains *d)
{
    d->at = qdot_calloc(p->n, sizeof *d->at);
    if (!d->at)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < p->n; i++) {
        const qdot_symbol s = *qdot_expr_symbol(p->pool, p->inputs[i]);
        qdot_domain *x = d->at + d->n;

        if (s.lo == QDOT_NIL && s.hi == QDOT_NIL)
            continue;
        *x = (qdot_domain){.coordinate = i, .lo_open = s.lo_open, .hi_open = s.hi_open};
        QDOT_TRY(evaluate_bound(p, p->names[i], s.lo, -INFINITY, &x->lo));
        QDOT_TRY(evaluate_bound(p, p->names[i], s.hi, INFINITY, &x->hi));
        QDOT_TRY(domain_describe(p, &s, p->names[i], &x->text));
        d->n++;
    }
    return QDOT_OK;
}

static bool
is_inside(const qdot_domain *d, double x)
{
    return (d->lo_open ? x > d->lo : x >= d->lo) && (d->hi_open ? x < d->hi : x <= d->hi);
}

const qdot_domain *
qdot_domains_outside(const qdot_domains *d, const double *y)
{
    for (size_t i = 0; i < d->n; i++)
        if (!is_inside(d->at + i, y[d->at[i].coordinate]))
            return d->at + i;
    return NULL;
}

qdot_status
qdot_domains_watch(double t, const double *y, bool *stop, void *user)
{
    qdot_domains *d = user;

    (void)t;
    d->left = qdot_domains_outside(d, y);
    *stop = d->left != NULL;
    return QDOT_OK;
}
