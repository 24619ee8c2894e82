/* scene-units.c -- what a scene says of dimensions that was declared before the first unit was written. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/session/names.h"
#include "lang/session/units.h"
#include "lang/session/values.h"
#include "mech/scene/things.h"

static const int none[QDOT_BASES] = {0}, length[QDOT_BASES] = {1}, mass[QDOT_BASES] = {0, 1}, inertia[QDOT_BASES] = {2, 1},
                 acceleration[QDOT_BASES] = {1, 0, -2}, energy[QDOT_BASES] = {2, 1, -2},
                 force[QDOT_BASES] = {1, 1, -2}, stiffness[QDOT_BASES] = {0, 1, -2}, damping[QDOT_BASES] = {0, 1, -1};

/* Fail again, with the thing of the scene that does not agree before the message. */
static qdot_status
blame_thing(qdot_status status, const char *kind, const char *name)
{
    const qdot_error why = *qdot_last_error();

    if (status != QDOT_ETYPE)
        return status;
    (void)qdot_fail(QDOT_ETYPE, "with units the scene does not agree: %s%s%.60s: %.380s", kind, name != NULL ? " " : "",
                    name != NULL ? name : "", why.message);
    return qdot_hint("numbers in the scene that are no pure numbers need units, such as 1 [m]");
}

/* Note that the summands of arguments of sines, cosines and tangents in e are angles. */
static qdot_status
note_angles_within(qdot_session *session, qdot_expr e)
{
    const qdot_pool *pool = session->pool;
    qdot_status status;
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin(pool, e, &w));
    status = QDOT_OK;
    for (size_t i = 0; i < w.n && status == QDOT_OK; i++) {
        const qdot_node *node = qdot_expr_node(pool, w.at[i]);

        if (node->kind == QDOT_FUN && (node->op == QDOT_SIN || node->op == QDOT_COS || node->op == QDOT_TAN))
            status = qdot_units_angles_in(session, qdot_expr_arg(pool, w.at[i], 0));
    }
    qdot_walk_end(&w);
    return status;
}

/* Infer what e says of dimensions, which must agree within it, and, with `is`, that it is of this dimension; format words the
 * failure. Nothing if e is nil or 0. */
static qdot_status
infer(qdot_session *session, qdot_expr e, const int *is, const char *format)
{
    if (e == QDOT_NIL || e == QDOT_ZERO)
        return QDOT_OK;
    QDOT_TRY(qdot_units_visit(session, e));
    QDOT_TRY(note_angles_within(session, e));
    return is != NULL ? qdot_units_fix(session, e, qdot_dimension_make(is), format) : QDOT_OK;
}

/* Infer what e says, and that e times x is of the dimension of L. */
static qdot_status
infer_energy(qdot_session *session, qdot_expr e, qdot_expr x, const char *format)
{
    QDOT_TRY(infer(session, e, NULL, NULL));
    return qdot_units_energy(session, qdot_mul(session->pool, e, x), format);
}

static qdot_status
infer_from_masses(qdot_session *session)
{
    const qdot_scene *s = session->scene;

    for (size_t i = 0; i < s->particles.n; i++) {
        const qdot_particle *p = &s->particles.at[i];

        QDOT_TRY(blame_thing(infer(session, p->mass, mass, "its mass is a mass, not %s"), "particle", p->name));
        QDOT_TRY(blame_thing(infer(session, p->position, length, "its place has lengths, not %s"), "particle", p->name));
    }
    for (size_t i = 0; i < s->bodies.n; i++) {
        const qdot_body *b = &s->bodies.at[i];

        QDOT_TRY(blame_thing(infer(session, b->mass, mass, "its mass is a mass, not %s"), "body", b->name));
        QDOT_TRY(blame_thing(infer(session, b->position, length, "its place has lengths, not %s"), "body", b->name));
        QDOT_TRY(blame_thing(infer(session, b->inertia, inertia, "its inertia is a moment of inertia, not %s"), "body", b->name));
        QDOT_TRY(blame_thing(infer(session, b->rotation, none, "its rotation has numbers, not %s"), "body", b->name));
        QDOT_TRY(blame_thing(infer(session, b->angle, none, "its angle is an angle, not %s"), "body", b->name));
        if (b->angle != QDOT_NIL)
            QDOT_TRY(qdot_units_angles_in(session, b->angle));
    }
    return QDOT_OK;
}

static qdot_status
infer_from_link(qdot_session *session, const char *kind, const qdot_link *x, const int *coefficient, const char *format)
{
    for (int k = 0; k < 2; k++)
        QDOT_TRY(blame_thing(infer(session, x->at[k], length, "its end has lengths, not %s"), kind, x->name));
    QDOT_TRY(blame_thing(infer(session, x->stiffness, coefficient, format), kind, x->name));
    return blame_thing(infer(session, x->rest, length, "its rest length is a length, not %s"), kind, x->name);
}

static qdot_status
infer_from_forces(qdot_session *session)
{
    const qdot_scene *s = session->scene;

    for (size_t i = 0; i < s->gravities.n; i++)
        QDOT_TRY(blame_thing(infer(session, s->gravities.at[i].e, acceleration, "it is an acceleration, not %s"), "gravity",
                       s->gravities.at[i].name));
    for (size_t i = 0; i < s->potentials.n; i++)
        QDOT_TRY(blame_thing(infer(session, s->potentials.at[i].e, energy, "it is an energy, not %s"), "potential", s->potentials.at[i].name));
    for (size_t i = 0; i < s->dissipations.n; i++)
        QDOT_TRY(blame_thing(infer_energy(session, s->dissipations.at[i].e, QDOT_T, "times time it is %s, not %s"), "dissipation",
                             s->dissipations.at[i].name));
    for (size_t i = 0; i < s->springs.n; i++)
        QDOT_TRY(infer_from_link(session, "spring", &s->springs.at[i], stiffness, "its stiffness is a stiffness, not %s"));
    for (size_t i = 0; i < s->dampers.n; i++)
        QDOT_TRY(infer_from_link(session, "damper", &s->dampers.at[i], damping, "its coefficient is a damping coefficient, not %s"));
    for (size_t i = 0; i < s->forces.n; i++) {
        QDOT_TRY(blame_thing(infer(session, s->forces.at[i].force, force, "it is a force, not %s"), "force", s->forces.at[i].name));
        QDOT_TRY(blame_thing(infer(session, s->forces.at[i].point, length, "its place has lengths, not %s"), "force", s->forces.at[i].name));
    }
    for (size_t i = 0; i < s->torques.n; i++) {
        const qdot_torque *x = &s->torques.at[i];
        const qdot_status status = x->coordinate != QDOT_NIL
                                       ? infer_energy(session, x->torque, x->coordinate, "times its coordinate it is %s, not %s")
                                       : infer(session, x->torque, energy, "it is a torque (as an energy), not %s");

        QDOT_TRY(blame_thing(status, x->force ? "force" : "torque", x->name));
    }
    return QDOT_OK;
}

/* Infer what a stated L or H says; it is an energy unless its dimension follows from what it holds. */
static qdot_status
infer_from_function(qdot_session *session, qdot_expr e, const char *kind)
{
    qdot_dimension is;

    QDOT_TRY(blame_thing(infer(session, e, NULL, NULL), kind, NULL));
    return e != QDOT_NIL && qdot_units_of(session, e, &is) == QDOT_DIMENSION_FREE
               ? qdot_units_fix(session, e, qdot_dimension_make(energy), "%s")
               : QDOT_OK;
}

static qdot_status
infer_from_equations(qdot_session *session)
{
    const qdot_scene *s = session->scene;

    for (size_t i = 0; i < s->constraints.n; i++) {
        const qdot_constraint *c = &s->constraints.at[i];

        QDOT_TRY(blame_thing(qdot_units_join(session, c->left, c->right, "%s is set equal to %s"), "constraint", c->name));
        QDOT_TRY(blame_thing(infer(session, c->f, NULL, NULL), "constraint", c->name));
    }
    for (size_t i = 0; i < s->states.n; i++) {
        const qdot_state *x = &s->states.at[i];

        if (x->rate != QDOT_NIL)
            QDOT_TRY(blame_thing(qdot_units_join(session, qdot_symbol_jet(session->pool, x->z, 1), x->rate,
                                           "the rate of the state is %s, its right side %s"),
                           "state", qdot_expr_symbol(session->pool, x->z)->name));
    }
    for (size_t i = 0; i < s->events.n; i++) {
        const qdot_event *e = &s->events.at[i];

        QDOT_TRY(blame_thing(qdot_units_join(session, e->left, e->right, "%s is set equal to %s"), "event", e->name));
        for (size_t k = 0; k < e->targets.n; k++)
            QDOT_TRY(blame_thing(qdot_units_join(session, e->targets.at[k], e->values.at[k], "%s is set equal to %s"), "event", e->name));
    }
    return QDOT_OK;
}

/* Infer from values of symbols or functions that these have the same dimension; a bare number says nothing. */
static qdot_status
infer_from_values(qdot_session *session, size_t n, const qdot_expr *symbols, const qdot_expr *values)
{
    for (size_t i = 0; i < n; i++) {
        const qdot_symbol *x = qdot_expr_symbol(session->pool, symbols[i]);

        if (!qdot_expr_is_constant(session->pool, values[i]))
            QDOT_TRY(blame_thing(qdot_units_join(session, symbols[i], values[i], "a value of %s is %s"), "the value of",
                                 x != NULL ? x->name : "a function"));
    }
    return QDOT_OK;
}

/* Infer from the bounds of a symbol that these have its dimension; a bare number says nothing. */
static qdot_status
infer_from_bounds(qdot_session *session, const qdot_name *name)
{
    const qdot_symbol x = *qdot_expr_symbol(session->pool, name->value);
    const qdot_expr bounds[] = {x.lo, x.hi};

    for (int k = 0; k < 2; k++)
        if (bounds[k] != QDOT_NIL && !qdot_expr_is_constant(session->pool, bounds[k]))
            QDOT_TRY(blame_thing(qdot_units_join(session, name->value, bounds[k], "the name is %s, its bound %s"), "the bounds of", name->name));
    return QDOT_OK;
}

/* Infer what the named expressions say, and the bounds and values of parameters and coordinates. */
static qdot_status
infer_from_names(qdot_session *session)
{
    const qdot_values *v = session->values;
    const qdot_name *name;

    for (size_t i = 0; (name = qdot_names_at(session->names, i)) != NULL; i++)
        if (name->kind == QDOT_NAME_VALUE)
            QDOT_TRY(blame_thing(infer(session, name->value, NULL, NULL), "the definition of", name->name));
        else if (name->kind == QDOT_NAME_PARAM || name->kind == QDOT_NAME_COORD)
            QDOT_TRY(infer_from_bounds(session, name));
    QDOT_TRY(infer_from_values(session, v->set_symbols.n, v->set_symbols.at, v->set_values.at));
    return infer_from_values(session, v->start_symbols.n, v->start_symbols.at, v->start_values.at);
}

qdot_status
qdot_units_of_scene(qdot_session *session)
{
    const qdot_scene *s = session->scene;
    const qdot_expr stated = s->higher_lagrangian != QDOT_NIL ? s->higher_lagrangian : s->lagrangian;

    QDOT_TRY(infer_from_masses(session));
    QDOT_TRY(infer_from_function(session, stated, "lagrangian"));
    QDOT_TRY(infer_from_function(session, s->hamiltonian, "hamiltonian"));
    QDOT_TRY(infer_from_forces(session));
    QDOT_TRY(infer_from_equations(session));
    return infer_from_names(session);
}
