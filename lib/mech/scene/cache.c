/* cache.c -- results computed from a scene, which are cleared when the scene changes. */
#include "mech/scene/cache.h"

void
qdot_kinematics_clear(qdot_kinematics *k)
{
    if (k->dy != k->dx && k->dy)
        for (size_t i = 0; i <= k->n; i++)
            qdot_free(k->dy[i].at);
    if (k->dx)
        for (size_t i = 0; i <= k->n; i++)
            qdot_free(k->dx[i].at);
    if (k->dy != k->dx)
        qdot_free(k->dy);
    qdot_free(k->dx);
    qdot_free(k->rest.at);
    qdot_free(k->place.at);
    qdot_free(k->terms.at);
    qdot_free(k->bits.at);
    qdot_free(k->weight.at);
    qdot_free(k->slots.at);
    *k = (qdot_kinematics){0};
}

static void
clear_results(qdot_derived *d)
{
    qdot_kinematics_clear(&d->kinematics);
    qdot_free(d->square_spring);
    qdot_free(d->square_damper);
    qdot_free(d->M);
    qdot_free(d->b);
    qdot_free(d->slopes.at);
    qdot_free(d->momentum);
    qdot_free(d->force);
    qdot_free(d->rest);
    qdot_free(d->left);
    qdot_free(d->equation);
    qdot_free(d->speeds);
    qdot_free(d->higher);
    qdot_free(d->accel);
    qdot_free(d->lambda);
    qdot_free(d->friction);
    qdot_free(d->integral);
    qdot_free(d->factor);
    qdot_free(d->integral_known);
    qdot_free(d->independent);
    qdot_free(d->patterns.at);
    for (size_t k = 0; k < d->divided.n; k++)
        qdot_free(d->divided.at[k].part);
    qdot_free(d->divided.at);
    qdot_free(d->cyclic);
}

void
qdot_derived_free(qdot_derived *d)
{
    if (!d)
        return;
    clear_results(d);
    qdot_free(d);
}

qdot_derived *
qdot_derived_get(qdot_scene *s)
{
    qdot_derived *d = s->derived;

    if (d->version != s->version) {
        clear_results(d);
        *d = (qdot_derived){
            .newest = d->newest, .version = s->version, .n = s->coordinates.n};
    }
    return d;
}

bool
qdot_derived_array(qdot_scene *s, qdot_expr **array, size_t n)
{
    if (*array)
        return true;
    *array = qdot_calloc(n ? n : 1, sizeof **array);
    if (*array)
        return true;
    qdot_pool_fail(s->pool);
    return false;
}
