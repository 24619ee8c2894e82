/* scene.c -- declarations: each function checks its arguments, then adds an item. */

#include "mech/scene/scene.h"

#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "mech/scene/access.h"
#include "mech/scene/cache.h"
#include "normal/simplify/kinks.h"

/* The kinds of symbols that a declaration must not contain, and their names in messages. */
enum {
    NO_VIRTUAL = QDOT_HAS_MULTIPLIER | QDOT_HAS_DIFFERENTIAL | QDOT_HAS_DELTA,
    NO_SYMBOLS = NO_VIRTUAL | QDOT_HAS_MOMENTUM,
    NO_RATE = NO_VIRTUAL | QDOT_HAS_ACCELERATION | QDOT_HAS_VELOCITY,
    NO_ACCELERATION = NO_SYMBOLS | QDOT_HAS_ACCELERATION,
    NOT_IN_FORCES = NO_ACCELERATION & ~QDOT_HAS_MULTIPLIER,
    NO_VELOCITY = NO_ACCELERATION | QDOT_HAS_VELOCITY,
    NO_PLACE = NO_VELOCITY | QDOT_HAS_COORD
};

/* Beside the flags of what an expression must not hold, such as QDOT_HAS_VELOCITY: coordinates at an earlier time, x(t - 1), are
 * allowed in it. */
static const uint32_t may_be_delayed = 1u << 31;

static const struct {
    uint32_t flag;
    const char *words;
} contents[] = {
    {QDOT_HAS_MULTIPLIER, "multipliers"},     {QDOT_HAS_MOMENTUM, "momenta"},
    {QDOT_HAS_DIFFERENTIAL, "differentials"}, {QDOT_HAS_DELTA, "virtual displacements"},
    {QDOT_HAS_ACCELERATION, "accelerations"}, {QDOT_HAS_VELOCITY, "velocities"},
    {QDOT_HAS_COORD, "coordinates"},
};

qdot_scene *
qdot_scene_new(qdot_pool *pool)
{
    qdot_scene *s = qdot_calloc(1, sizeof *s);

    if (!s)
        return NULL;
    s->pool = pool;
    s->version = 1;
    s->derived = qdot_calloc(1, sizeof *s->derived);
    s->texts = qdot_arena_new();
    if (!s->derived || !s->texts) {
        qdot_scene_free(s);
        return NULL;
    }
    return s;
}

void
qdot_scene_forget_dropped(qdot_scene *s)
{
    for (size_t i = 0; i < s->dropped.n; i++)
        qdot_free(s->dropped.at[i]);
    s->dropped.n = 0;
}

void
qdot_scene_free(qdot_scene *s)
{
    if (!s)
        return;
    qdot_free(s->events.at);
    qdot_free(s->states.at);
    qdot_free(s->higher.at);
    qdot_scene_forget_dropped(s);
    qdot_free(s->dropped.at);
    qdot_free(s->coordinates.at);
    qdot_free(s->particles.at);
    qdot_free(s->bodies.at);
    qdot_free(s->gravities.at);
    qdot_free(s->potentials.at);
    qdot_free(s->springs.at);
    qdot_free(s->dampers.at);
    qdot_free(s->dissipations.at);
    qdot_free(s->forces.at);
    qdot_free(s->torques.at);
    qdot_free(s->constraints.at);
    qdot_free(s->joints.at);
    qdot_free(s->assumed.at);
    qdot_free(s->conditions.at);
    qdot_free(s->relations.at);
    qdot_free(s->inputs.at);
    qdot_free(s->outputs.at);
    if (s->kept)
        s->kept_free(s->kept);
    if (s->derived)
        qdot_derived_free(s->derived);
    if (s->texts)
        qdot_arena_free(s->texts);
    qdot_free(s);
}

/* --- checks of declarations ----------------------------------------------------------- */

static qdot_status
refuse_forbidden_symbols(qdot_scene *s, qdot_expr e, const char *what, uint32_t forbidden)
{
    uint32_t holds = qdot_mech_holds(s, e) & forbidden;

    for (size_t i = 0; holds && i < sizeof contents / sizeof *contents; i++)
        if (holds & contents[i].flag)
            return qdot_fail(QDOT_EINVAL, "%s cannot contain %s", what, contents[i].words);
    return forbidden & may_be_delayed ? QDOT_OK : qdot_scene_refuse_delays(s, e, what);
}

static qdot_status
require_scalar(qdot_scene *s, qdot_expr e, const char *what, uint32_t forbidden)
{
    QDOT_TRY(qdot_pool_check(s->pool));
    if (e == QDOT_NIL)
        return qdot_fail(QDOT_EINVAL, "%s is missing", what);
    if (!qdot_expr_is_scalar(s->pool, e))
        return qdot_fail(QDOT_ETYPE, "%s must be a number, not a vector", what);
    return refuse_forbidden_symbols(s, e, what, forbidden);
}

/* Fail because the dimension differs from the scene's; with a hint if gravity alone determined that. */
static qdot_status
fail_with_dimension(qdot_scene *s, const char *what, uint32_t n, uint32_t space)
{
    qdot_text field = {0};
    qdot_status status = qdot_fail(QDOT_ETYPE, "%s has %u component%s in a scene of %u dimension%s", what, n,
                                   n == 1 ? "" : "s", space, space == 1 ? "" : "s");

    if (s->gravities.n != 1 || s->particles.n + s->bodies.n > 0)
        return status;
    if (qdot_scene_print_at(s, QDOT_GRAVITY, 0, &field) == QDOT_OK && field.n > 1 && field.n < 80)
        status = qdot_hint("`%.*s` made it so: `remove gravity`, then gravity %s", (int)field.n - 1,
                           qdot_text_str(&field), n == 2 ? "(0, -g)" : n == 3 ? "(0, 0, -g)" : "-g");
    qdot_text_clear(&field);
    return status;
}

/* Check a position, field or force: its dimension must be the scene's, which the first declaration sets. */
static qdot_status
require_vector(qdot_scene *s, qdot_expr e, const char *what, uint32_t forbidden)
{
    uint32_t n = qdot_mech_dimension(s->pool, e), space = qdot_scene_dimension(s);

    QDOT_TRY(qdot_pool_check(s->pool));
    if (e == QDOT_NIL)
        return qdot_fail(QDOT_EINVAL, "%s is missing", what);
    if (n < 1 || n > 3)
        return qdot_fail(QDOT_ETYPE, "%s must have 1, 2 or 3 components", what);
    for (uint32_t i = 0; i < n; i++)
        if (!qdot_expr_is_scalar(s->pool, qdot_mech_component(s->pool, e, i)))
            return qdot_fail(QDOT_ETYPE, "component %u of %s is not a number", i + 1,
                             what);
    if (space && n != space)
        return fail_with_dimension(s, what, n, space);
    return refuse_forbidden_symbols(s, e, what, forbidden);
}

qdot_status
qdot_scene_need_new_label(const qdot_scene *s, const char *name)
{
    if (name && qdot_scene_has_label(s, name)) {
        qdot_fail(QDOT_ENAME, "%s is a label of the scene already", name);
        return qdot_hint("`remove %s` takes it out", name);
    }
    return QDOT_OK;
}

qdot_status
qdot_scene_need_no_lagrangian(const qdot_scene *s, const char *what)
{
    const bool hamiltonian = s->hamiltonian != QDOT_NIL;

    if (s->lagrangian == QDOT_NIL && !hamiltonian)
        return QDOT_OK;
    (void)qdot_fail(QDOT_EINVAL, "the scene states its %s: %s beside it would not count",
                    hamiltonian ? "Hamiltonian" : "Lagrangian", what);
    return qdot_hint("put its term into the formula of `%s`; `reset scene` begins anew",
                     hamiltonian ? "hamiltonian" : "lagrangian");
}

qdot_status
qdot_scene_copy_text(qdot_scene *s, const char *text, char **copy)
{
    *copy = text ? qdot_arena_strndup(s->texts, text, strlen(text)) : NULL;
    return *copy || !text ? QDOT_OK : QDOT_ENOMEM;
}

void
qdot_scene_changed(qdot_scene *s)
{
    if (s->derived->newest < s->version)
        s->derived->newest = s->version;
    s->version = ++s->derived->newest;
}

static qdot_status
mark_changed(qdot_scene *s)
{
    qdot_scene_changed(s);
    return QDOT_OK;
}

/* --- adding items --------------------------------------------------------------------- */

qdot_status
qdot_scene_coordinate(qdot_scene *s, qdot_expr q)
{
    QDOT_TRY(qdot_pool_check(s->pool));
    if (q == QDOT_NIL || !qdot_expr_is_coordinate(s->pool, q))
        return qdot_fail(QDOT_ETYPE, "a coordinate must be a name");
    for (size_t i = 0; i < s->coordinates.n; i++)
        if (s->coordinates.at[i] == q)
            return qdot_fail(QDOT_ENAME, "%s is a coordinate already",
                             qdot_expr_symbol(s->pool, q)->name);
    if (s->higher.n > 0) {
        qdot_fail(QDOT_ENOTBUILT, "not built yet: a coordinate declared after a Lagrangian with second derivatives");
        return qdot_hint("declare it before");
    }
    QDOT_TRY(qdot_vec_push(&s->coordinates, q));
    return mark_changed(s);
}

static qdot_status
require_mass(qdot_scene *s, qdot_expr mass)
{
    QDOT_TRY(require_scalar(s, mass, "a mass", NO_VELOCITY));
    if ((qdot_expr_node(s->pool, mass)->sign & QDOT_NEG) == QDOT_NEG)
        return qdot_fail(QDOT_EDOMAIN, "a mass cannot be negative");
    return QDOT_OK;
}

qdot_status
qdot_scene_particle(qdot_scene *s, const char *name, qdot_expr mass, qdot_expr position)
{
    qdot_particle p = {NULL, mass, position};

    qdot_scene_forget_dropped(s);
    QDOT_TRY(qdot_scene_need_no_lagrangian(s, "a particle"));
    QDOT_TRY(qdot_scene_need_new_label(s, name));
    QDOT_TRY(require_mass(s, mass));
    QDOT_TRY(require_vector(s, position, "a position", NO_VELOCITY));
    QDOT_TRY(qdot_scene_refuse_states(s, position, "a position", 0));
    QDOT_TRY(qdot_scene_copy_text(s, name, &p.name));
    QDOT_TRY(qdot_vec_push(&s->particles, p));
    return mark_changed(s);
}

static qdot_status
require_energy_term(qdot_scene *s, qdot_scene_kind kind, qdot_expr e)
{
    switch (kind) {
    case QDOT_GRAVITY:
        QDOT_TRY(qdot_scene_need_no_lagrangian(s, "gravity"));
        return require_vector(s, e, "a uniform field", NO_PLACE);
    case QDOT_POTENTIAL:
        QDOT_TRY(qdot_scene_need_no_lagrangian(s, "a potential"));
        QDOT_TRY(qdot_scene_refuse_states(s, e, "a potential", 1));
        return require_scalar(s, e, "a potential", NO_ACCELERATION);
    default:
        QDOT_TRY(qdot_scene_refuse_states(s, e, "a dissipation function", 1));
        e = qdot_higher_in_jets(s, e);
        return require_scalar(s, e, "a dissipation function", NOT_IN_FORCES);
    }
}

/* The gravity field without label; NULL if there is none. */
static qdot_term *
unlabelled_gravity(const qdot_scene *s)
{
    for (size_t i = 0; i < s->gravities.n; i++)
        if (!s->gravities.at[i].name)
            return &s->gravities.at[i];
    return NULL;
}

qdot_status
qdot_scene_term(qdot_scene *s, qdot_scene_kind kind, const char *name, qdot_expr e)
{
    qdot_term term = {.e = e}, *before = NULL;
    qdot_status status;

    qdot_scene_forget_dropped(s);
    QDOT_TRY(qdot_scene_need_new_label(s, name));
    QDOT_TRY(require_energy_term(s, kind, e));
    if (kind == QDOT_POTENTIAL)
        term.e = qdot_kinks_cancel(s->pool, e);
    QDOT_TRY(qdot_pool_check(s->pool));
    if (kind == QDOT_GRAVITY && !name)
        before = unlabelled_gravity(s);
    if (before) {
        before->e = e;
        return mark_changed(s);
    }
    QDOT_TRY(qdot_scene_copy_text(s, name, &term.name));
    status = kind == QDOT_GRAVITY     ? qdot_vec_push(&s->gravities, term)
             : kind == QDOT_POTENTIAL ? qdot_vec_push(&s->potentials, term)
                                      : qdot_vec_push(&s->dissipations, term);
    return status == QDOT_OK ? mark_changed(s) : status;
}

qdot_status
qdot_scene_gravity(qdot_scene *s, qdot_expr field)
{
    return qdot_scene_term(s, QDOT_GRAVITY, NULL, field);
}

qdot_status
qdot_scene_potential(qdot_scene *s, qdot_expr V)
{
    return qdot_scene_term(s, QDOT_POTENTIAL, NULL, V);
}

qdot_status
qdot_scene_dissipation(qdot_scene *s, qdot_expr D)
{
    return qdot_scene_term(s, QDOT_DISSIPATION, NULL, D);
}

/* Check a spring or damper, and append a copy of it to its list. */
static qdot_status
add_spring_or_damper(qdot_scene *s, const qdot_link *link, bool damper)
{
    qdot_link copy = *link;
    const char *what = damper ? "an end of a damper" : "an end of a spring";
    qdot_expr u, u2;
    qdot_status status;

    QDOT_TRY(qdot_scene_need_new_label(s, link->name));
    for (int k = 0; k < 2; k++)
        QDOT_TRY(require_vector(s, link->at[k], what, NO_VELOCITY));
    if (qdot_mech_dimension(s->pool, link->at[0]) !=
        qdot_mech_dimension(s->pool, link->at[1]))
        return qdot_fail(QDOT_ETYPE, "the ends are in spaces of different dimension");
    QDOT_TRY(require_scalar(s, link->stiffness, damper ? "a coefficient" : "a stiffness",
                            damper ? NO_ACCELERATION : NO_VELOCITY));
    if (damper)
        copy.rest = QDOT_NIL;
    else if (copy.rest == QDOT_NIL)
        copy.rest = QDOT_ZERO;
    else
        QDOT_TRY(require_scalar(s, copy.rest, "a rest length", NO_VELOCITY));
    u = qdot_value_sub(s->pool, link->at[0], link->at[1]);
    u2 = qdot_mech_dot(s->pool, u, u);
    QDOT_TRY(qdot_pool_check(s->pool));
    if (u2 == QDOT_ZERO)
        return qdot_fail(QDOT_EINVAL, "both ends are at one point");
    status = qdot_scene_copy_text(s, link->name, &copy.name);
    for (int k = 0; k < 2 && status == QDOT_OK; k++)
        status = qdot_scene_copy_text(s, link->end[k], &copy.end[k]);
    if (status == QDOT_OK)
        status =
            damper ? qdot_vec_push(&s->dampers, copy) : qdot_vec_push(&s->springs, copy);
    return status == QDOT_OK ? mark_changed(s) : status;
}

qdot_status
qdot_scene_spring(qdot_scene *s, const qdot_link *spring)
{
    qdot_scene_forget_dropped(s);
    QDOT_TRY(qdot_scene_need_no_lagrangian(s, "a spring"));
    if ((qdot_expr_node(s->pool, spring->rest)->sign & QDOT_NEG) == QDOT_NEG) {
        qdot_fail(QDOT_EINVAL, "the rest length of a spring cannot be negative");
        return qdot_hint("`rest 0`, or none, makes a spring that pulls at any length");
    }
    return add_spring_or_damper(s, spring, false);
}

qdot_status
qdot_scene_damper(qdot_scene *s, const qdot_link *damper)
{
    qdot_scene_forget_dropped(s);
    return add_spring_or_damper(s, damper, true);
}

qdot_status
qdot_scene_force(qdot_scene *s, const qdot_force *force)
{
    qdot_force copy = *force;

    qdot_scene_forget_dropped(s);
    QDOT_TRY(qdot_scene_need_new_label(s, force->name));
    QDOT_TRY(require_vector(s, force->force, "a force", NOT_IN_FORCES | may_be_delayed));
    QDOT_TRY(require_vector(s, force->point, "the point of a force", NO_VELOCITY));
    if (qdot_mech_dimension(s->pool, force->force) !=
        qdot_mech_dimension(s->pool, force->point))
        return qdot_fail(QDOT_ETYPE, "a force of %u components at a point of %u",
                         qdot_mech_dimension(s->pool, force->force),
                         qdot_mech_dimension(s->pool, force->point));
    if (force->material && (!force->on || !qdot_scene_find_body(s, force->on)))
        return qdot_fail(QDOT_EINVAL, "only a body has material at other places than its own");
    QDOT_TRY(qdot_scene_copy_text(s, force->name, &copy.name));
    QDOT_TRY(qdot_scene_copy_text(s, force->on, &copy.on));
    QDOT_TRY(qdot_vec_push(&s->forces, copy));
    return mark_changed(s);
}

qdot_status
qdot_scene_torque(qdot_scene *s, const qdot_torque *torque)
{
    qdot_torque copy = *torque;

    qdot_scene_forget_dropped(s);
    QDOT_TRY(qdot_scene_need_new_label(s, torque->name));
    QDOT_TRY(qdot_pool_check(s->pool));
    if (torque->coordinate != QDOT_NIL) {
        size_t i;

        QDOT_TRY(require_scalar(s, torque->torque, "a generalized force", NOT_IN_FORCES | may_be_delayed));
        if (!qdot_mech_index(s, torque->coordinate, &i))
            return qdot_pool_check(s->pool);
        if (qdot_scene_state_of(s, torque->coordinate)) {
            const char *name = qdot_expr_symbol(s->pool, torque->coordinate)->name;

            qdot_fail(QDOT_EINVAL, "%s is a state: no force acts on it", name);
            return qdot_hint("what changes it is its rate, state %s' = ...", name);
        }
    } else {
        uint32_t n = qdot_mech_dimension(s->pool, torque->torque), wanted;

        if (torque->body < 0 || (size_t)torque->body >= s->bodies.n)
            return qdot_fail(QDOT_EINVAL, "a torque acts on a coordinate or a body");
        wanted = s->bodies.at[torque->body].angle == QDOT_NIL ? 3 : 1;
        if (n != wanted)
            return qdot_fail(QDOT_ETYPE,
                             wanted == 3 ? "a torque on a body in space has 3 components"
                                         : "a torque on a plane body is a number");
        QDOT_TRY(refuse_forbidden_symbols(s, torque->torque, "a torque", NOT_IN_FORCES | may_be_delayed));
    }
    QDOT_TRY(qdot_scene_copy_text(s, torque->name, &copy.name));
    QDOT_TRY(qdot_vec_push(&s->torques, copy));
    return mark_changed(s);
}

/* What makes T - V, so that L and H follow; NULL: nothing. */
static const char *
parts_of_lagrangian(const qdot_scene *s)
{
    return s->particles.n    ? "particles"
           : s->bodies.n     ? "bodies"
           : s->gravities.n  ? "gravity"
           : s->potentials.n ? "a potential"
           : s->springs.n    ? "springs"
                             : NULL;
}

qdot_status
qdot_scene_lagrangian(qdot_scene *s, qdot_expr L)
{
    const char *beside = parts_of_lagrangian(s);

    if (beside) {
        (void)qdot_fail(QDOT_EINVAL, "a stated Lagrangian beside %s: L would not be T - V", beside);
        return qdot_hint("`lagrange_function` shows the one that follows; `reset scene` takes the scene away");
    }
    QDOT_TRY(require_scalar(s, L, "a Lagrangian", NO_SYMBOLS));
    QDOT_TRY(qdot_scene_refuse_states(s, L, "a Lagrangian", 1));
    L = qdot_kinks_cancel(s->pool, L);
    QDOT_TRY(qdot_pool_check(s->pool));
    QDOT_TRY(qdot_higher_state(s, &L));
    s->lagrangian = L;
    s->hamiltonian = QDOT_NIL;
    return mark_changed(s);
}

qdot_status
qdot_scene_hamiltonian(qdot_scene *s, qdot_expr H, qdot_expr L)
{
    const char *beside = parts_of_lagrangian(s);

    if (beside) {
        (void)qdot_fail(QDOT_EINVAL, "a stated Hamiltonian beside %s: H follows from these", beside);
        return qdot_hint("`hamiltonian` alone shows it; `reset scene` takes the scene away");
    }
    QDOT_TRY(require_scalar(s, H, "a Hamiltonian", NO_RATE));
    QDOT_TRY(qdot_scene_refuse_states(s, H, "a Hamiltonian", 1));
    if (!(qdot_mech_holds(s, H) & QDOT_HAS_MOMENTUM)) {
        (void)qdot_fail(QDOT_EINVAL, "no momentum stands in this Hamiltonian");
        return qdot_hint("the momentum of a coordinate x is written p[x]: hamiltonian p[x]^2/2");
    }
    qdot_higher_forget(s);
    s->hamiltonian = H;
    s->lagrangian = L;
    return mark_changed(s);
}

/* --- inputs, outputs -------------------------------------------------------------------- */

qdot_status
qdot_scene_input(qdot_scene *s, qdot_expr symbol)
{
    for (size_t i = 0; i < s->inputs.n; i++)
        if (s->inputs.at[i] == symbol)
            return QDOT_OK;
    QDOT_TRY(qdot_vec_push(&s->inputs, symbol));
    return mark_changed(s);
}

qdot_status
qdot_scene_outputs(qdot_scene *s, size_t n, const qdot_expr *e)
{
    for (size_t i = 0; i < n; i++)
        QDOT_TRY(refuse_forbidden_symbols(s, e[i], "an output", NO_SYMBOLS & ~(uint32_t)QDOT_HAS_MULTIPLIER));
    s->outputs.n = 0;
    for (size_t i = 0; i < n; i++)
        QDOT_TRY(qdot_vec_push(&s->outputs, e[i]));
    return mark_changed(s);
}

/* --- the statement `assume` ----------------------------------------------------------- */

static qdot_status
add_relation(qdot_scene *s, qdot_expr e)
{
    QDOT_TRY(qdot_pool_check(s->pool));
    if (e == QDOT_ZERO)
        return QDOT_OK;
    for (size_t i = 0; i < s->relations.n; i++)
        if (s->relations.at[i] == e)
            return QDOT_OK;
    return qdot_vec_push(&s->relations, e);
}

/* A relation between undefined functions holds for all values of their arguments, so its
 * derivatives by these are relations too: the first and the second are kept. */
static qdot_status
add_derivatives_of_relation(qdot_scene *s, qdot_expr relation)
{
    qdot_pool *pool = s->pool;
    qdot_vec(qdot_expr) by = {0};
    qdot_expr atoms = qdot_expr_atoms(pool, relation, true);
    qdot_status status = qdot_pool_check(pool);
    uint32_t n = status == QDOT_OK ? qdot_expr_count(pool, atoms) : 0;

    for (uint32_t i = 0; i < n && status == QDOT_OK; i++) {
        qdot_expr f = qdot_expr_arg(pool, atoms, i), inner;
        uint32_t m;

        if (qdot_expr_kind(pool, f) != QDOT_UFUN)
            continue;
        inner = qdot_expr_atoms(pool, f, false);
        status = qdot_pool_check(pool);
        m = status == QDOT_OK ? qdot_expr_count(pool, inner) : 0;
        for (uint32_t j = 0; j < m && status == QDOT_OK; j++) {
            qdot_expr x = qdot_expr_arg(pool, inner, j);
            bool known = qdot_expr_is_class(pool, x, QDOT_CONST);

            for (size_t k = 0; k < by.n; k++)
                known |= by.at[k] == x;
            if (!known)
                status = qdot_vec_push(&by, x);
        }
    }
    for (size_t i = 0; i < by.n && status == QDOT_OK; i++) {
        qdot_expr first = qdot_diff(pool, relation, by.at[i]);

        status = add_relation(s, first);
        for (size_t j = i; j < by.n && status == QDOT_OK; j++)
            status = add_relation(s, qdot_diff(pool, first, by.at[j]));
    }
    qdot_free(by.at);
    return status;
}

qdot_status
qdot_scene_assume(qdot_scene *s, qdot_expr relation, bool turned)
{
    const qdot_assumption said = {.relation = relation, .turned = turned};
    qdot_pool *pool = s->pool;
    size_t before = s->relations.n;
    qdot_expr f;
    qdot_status status;

    QDOT_TRY(qdot_pool_check(pool));
    if (relation == QDOT_NIL || qdot_expr_kind(pool, relation) != QDOT_REL)
        return qdot_fail(QDOT_ETYPE, "an equation or an inequality belongs here");
    if (qdot_expr_node(pool, relation)->op != QDOT_EQ) {
        QDOT_TRY(qdot_vec_push(&s->conditions, relation));
        status = qdot_vec_push(&s->assumed, said);
        if (status != QDOT_OK)
            s->conditions.n--;
        return status == QDOT_OK ? mark_changed(s) : status;
    }
    f = qdot_sub(pool, qdot_expr_arg(pool, relation, 0),
                 qdot_expr_arg(pool, relation, 1));
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(require_scalar(s, f, "a relation", 0));
    if (qdot_expr_kind(pool, f) == QDOT_NUM) {
        if (f == QDOT_ZERO)
            return QDOT_OK;
        return qdot_fail(QDOT_EINVAL, "this can never hold");
    }
    status = qdot_vec_push(&s->assumed, said);
    if (status == QDOT_OK) {
        status = add_relation(s, f);
        if (status == QDOT_OK)
            status = add_derivatives_of_relation(s, f);
        if (status != QDOT_OK) {
            s->assumed.n--;
            s->relations.n = before;
            return status;
        }
    }
    return status == QDOT_OK ? mark_changed(s) : status;
}
