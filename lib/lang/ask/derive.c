/* derive.c -- the statement `derive`: the whole derivation from r(q) to the equations, as in a textbook. */
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "lang/ask/derive-lines.h"
#include "lang/session/names.h"
#include "lang/session/speeds.h"
#include "lang/session/units.h"
#include "lang/syntax/record.h"
#include "mech/dynamics/quantity.h"
#include "mech/geometry/metric.h"
#include "mech/hamilton/hamilton.h"
#include "normal/form/common.h"
#include "normal/simplify/simplify.h"

static qdot_status derive_print(qdot_record *r);

QDOT_STATEMENT(derive) = {
    .word = "derive",
    .group = QDOT_ASKING,
    .usage = "derive",
    .summary = "the derivation from r(q) to the equations, step by step",
    .example = "derive",
    .alone = true,
    .handler = derive_print,
};

static qdot_derived_symbol
make_symbol(const char *letter)
{
    return (qdot_derived_symbol){.letter = letter};
}

/* Simplify e for printing, unless e is longer than a page. */
static qdot_expr
simplify_for_page(qdot_derivation *d, qdot_expr e)
{
    enum { PAGE = 4000 };
    qdot_facts facts = qdot_scene_facts(d->session->scene);

    if (e == QDOT_NIL || qdot_expr_size(d->session->pool, e) > PAGE)
        return e;
    return qdot_common_out(d->session->pool, qdot_simplify(d->session->pool, e, &facts));
}

/* Append the angular velocity omega of a body; in space also along the body's own axes, as for its inertia. */
static qdot_status
write_angular_velocity(qdot_derivation *d, const qdot_body *b)
{
    qdot_scene *s = d->session->scene;
    const qdot_derived_symbol omega = {.letter = "omega", .of = b->name};
    qdot_expr w = qdot_scene_spin(s, b->name);

    if (b->angle != QDOT_NIL)
        return qdot_derive_equation(d, omega, w);
    QDOT_TRY(qdot_derive_equation(d, omega, w));
    w = qdot_value_mul(s->pool, qdot_transpose(s->pool, b->rotation), w);
    qdot_derive_label(d, "along the axes of the body", NULL, NULL, NULL);
    return qdot_derive_equation(d, omega, simplify_for_page(d, w));
}

/* Write the angle by which a body in the plane is turned, unless it is constant. */
static qdot_status
write_turning_angle(qdot_derivation *d, const qdot_body *b)
{
    if (b->angle == QDOT_NIL || qdot_expr_kind(d->session->pool, b->angle) == QDOT_NUM)
        return QDOT_OK;
    qdot_derive_label(d, "angle", b->name, NULL, NULL);
    QDOT_TRY(qdot_sheet_formula(&d->sheet, b->angle));
    qdot_sheet_words(&d->sheet, "\n");
    return QDOT_OK;
}

/* List the assumptions of the steps that follow. */
static qdot_status
write_assumptions(qdot_derivation *d)
{
    const qdot_scene *s = d->session->scene;

    if (s->assumed.n > 0)
        qdot_derive_step(d, "Assumed", NULL);
    for (size_t i = 0; i < s->assumed.n; i++)
        QDOT_TRY(qdot_derive_relation(d, s->assumed.at[i].relation));
    return QDOT_OK;
}

/* Write what kind of quantity each parameter and coordinate is, with its unit, once a unit has been written. */
static qdot_status
write_units(qdot_derivation *d)
{
    qdot_session *session = d->session;
    const qdot_name *name;

    if (!qdot_units_on(session))
        return QDOT_OK;
    qdot_derive_step(d, "Units", NULL);
    for (size_t i = 0; (name = qdot_names_at(session->names, i)) != NULL; i++) {
        qdot_text words = {0}, unit = {0};
        qdot_status status = QDOT_OK;

        if (name->kind == QDOT_NAME_FUNCTION ||
            !(qdot_expr_is_class(session->pool, name->value, QDOT_PARAM) || qdot_expr_is_class(session->pool, name->value, QDOT_COORD)))
            continue;
        if (qdot_units_words(session, name->value, &words) == QDOT_DIMENSION_KNOWN) {
            qdot_units_label(session, name->value, &unit);
            qdot_sheet_format(&d->sheet, unit.n > 0 ? "    %s [%s]: " : "    %s: ", qdot_text_str(&words), qdot_text_str(&unit));
            status = qdot_sheet_formula(&d->sheet, name->value);
            qdot_sheet_words(&d->sheet, "\n");
        }
        d->sheet.formula.failed = d->sheet.formula.failed || words.failed || unit.failed;
        qdot_text_clear(&words);
        qdot_text_clear(&unit);
        QDOT_TRY(status);
    }
    return QDOT_OK;
}

/* Write position r, velocity v = sum dr/dq q' + dr/dt, and v^2 of everything that has mass. */
static qdot_status
write_kinematics(qdot_derivation *d)
{
    qdot_scene *s = d->session->scene;
    size_t n = s->particles.n + s->bodies.n;

    for (int step = 0; step < 3; step++) {
        qdot_derive_step(d, step == 0 ? "Positions" : step == 1 ? "Velocities" : "Squares of speeds",
                   step == 0   ? "r(q, t)"
                   : step == 1 ? "v = sum dr/dq q' + dr/dt"
                            : "v^2 = v.v");
        for (size_t i = 0; i < n; i++) {
            const qdot_massive one = qdot_scene_massive(s, i);
            qdot_derived_symbol x = {.letter = step == 0 ? "r" : "v", .of = one.name, .square = step == 2};

            QDOT_TRY(qdot_derive_equation(d, x,
                                         step == 0   ? one.position
                                         : step == 1 ? simplify_for_page(d, qdot_ddt(s->pool, one.position))
                                                     : qdot_mech_speed2(s, one.position)));
            if (step == 0 && one.body)
                QDOT_TRY(write_turning_angle(d, one.body));
            if (step == 1 && one.body)
                QDOT_TRY(write_angular_velocity(d, one.body));
        }
    }
    return QDOT_OK;
}

/* Write the contribution of each particle and body to T, then T itself. */
static qdot_status
write_kinetic_energy(qdot_derivation *d)
{
    qdot_scene *s = d->session->scene;
    const size_t n = s->particles.n + s->bodies.n;
    bool plane = false, space = false;
    qdot_energy_part part;

    for (size_t i = 0; i < s->bodies.n; i++)
        *(s->bodies.at[i].angle != QDOT_NIL ? &plane : &space) = true;
    qdot_derive_step(d, "Kinetic energy",
               plane && space ? "T = 1/2 sum m v^2 + 1/2 sum omega.I omega (I omega^2)"
               : space        ? "T = 1/2 sum m v^2 + 1/2 sum omega.I omega"
               : plane        ? "T = 1/2 sum m v^2 + 1/2 sum I omega^2"
                           : "T = 1/2 sum m v^2");
    for (size_t k = 0; n > 1 && qdot_mech_kinetic_part(s, k, &part); k++) {
        const qdot_derived_symbol T = {.letter = "T", .of = part.name};

        qdot_derive_label(d, part.kind, part.name, NULL, NULL);
        QDOT_TRY(qdot_derive_equation(d, T, part.value));
    }
    if (n > 1)
        qdot_derive_label(d, "together", NULL, NULL, NULL);
    QDOT_TRY(qdot_derive_equation(d, make_symbol("T"), qdot_mech_kinetic(s)));
    if (s->coordinates.n == 1)
        return QDOT_OK;
    qdot_derive_label(d, "mass matrix", NULL, NULL, NULL);
    return qdot_derive_equation(d, make_symbol("M"), qdot_mech_mass_matrix(s));
}

/* Write the contribution of each field, potential and spring to V, then V itself. */
static qdot_status
write_potential_energy(qdot_derivation *d)
{
    qdot_scene *s = d->session->scene;
    qdot_energy_part part;
    bool several = qdot_mech_potential_part(s, 1, &part);

    qdot_derive_step(d, "Potential energy",
               s->gravities.n > 0 && s->potentials.n + s->springs.n == 0 ? "V = -sum m g.r" : NULL);
    for (size_t k = 0; several && qdot_mech_potential_part(s, k, &part); k++) {
        char number[24];

        snprintf(number, sizeof number, "%zu", k + 1);
        if (strcmp(part.kind, "potential") == 0)
            qdot_derive_label(d, part.name != NULL ? "potential energy" : "potential energy as declared",
                             part.name, NULL, NULL);
        else
            qdot_derive_label(d, "potential energy", part.kind,
                             strcmp(part.kind, "gravity") == 0 ? " on " : " ", part.name);
        QDOT_TRY(qdot_derive_equation(d, (qdot_derived_symbol){.letter = "V", .of = number}, part.value));
    }
    if (several)
        qdot_derive_label(d, "together", NULL, NULL, NULL);
    return qdot_derive_equation(d, make_symbol("V"), qdot_mech_potential(s));
}

static qdot_status
write_energies(qdot_derivation *d)
{
    qdot_scene *s = d->session->scene;

    if (s->lagrangian != QDOT_NIL) {
        qdot_derive_step(d, s->hamiltonian != QDOT_NIL ? "Lagrangian, with q' = dH/dp solved for p" : "Lagrangian, as stated",
                   s->hamiltonian != QDOT_NIL ? "L = sum p q' - H" : NULL);
        return qdot_derive_equation(d, make_symbol("L"), qdot_mech_lagrangian(s));
    }
    QDOT_TRY(write_kinetic_energy(d));
    QDOT_TRY(write_potential_energy(d));
    qdot_derive_step(d, "Lagrangian", "L = T - V");
    return qdot_derive_equation(d, make_symbol("L"), qdot_mech_lagrangian(s));
}

static qdot_derived_symbol
make_coordinate_symbol(const qdot_derivation *d, const char *letter, qdot_expr q)
{
    return (qdot_derived_symbol){.letter = letter,
                    .of = qdot_expr_symbol(d->session->pool, q)->name,
                    .coordinate = q};
}

/* Write p = dL/dq', then the left side of the equations, with F = T, or F = L if a Lagrangian is stated. */
static qdot_status
write_left_sides(qdot_derivation *d)
{
    qdot_scene *s = d->session->scene;
    qdot_pool *pool = s->pool;
    bool stated = s->lagrangian != QDOT_NIL;
    qdot_expr F = stated ? qdot_mech_lagrangian(s) : qdot_mech_kinetic(s);
    char letter = stated ? 'L' : 'T';

    qdot_derive_step(d, "Momenta", "p = dL/dq'");
    for (size_t i = 0; i < s->coordinates.n; i++) {
        qdot_expr q = s->coordinates.at[i];

        if (qdot_scene_state_of(s, q) == NULL)
            QDOT_TRY(qdot_derive_equation(d, make_coordinate_symbol(d, "p", q), qdot_mech_momentum(s, q)));
    }
    qdot_derive_step(d, stated ? "Derivatives of L" : "Derivatives of T", NULL);
    for (size_t i = 0; i < s->coordinates.n; i++) {
        qdot_expr q = s->coordinates.at[i];
        qdot_expr slope = qdot_diff(pool, F, qdot_symbol_jet(pool, q, 1));

        if (qdot_scene_state_of(s, q) != NULL)
            continue;
        slope = simplify_for_page(d, slope);
        if (slope != QDOT_NIL && slope != qdot_mech_momentum(s, q))
            QDOT_TRY(qdot_derive_derivative(d, letter, false, true, i, slope));
        QDOT_TRY(qdot_derive_derivative(d, letter, true, true, i, simplify_for_page(d, qdot_ddt(pool, slope))));
        QDOT_TRY(qdot_derive_derivative(d, letter, false, false, i, simplify_for_page(d, qdot_diff(pool, F, q))));
    }
    return QDOT_OK;
}

/* The reaction term "sum lambda df/dq", in the form for the kinds of constraints in the scene. */
static const char *
reaction_term(const qdot_scene *s)
{
    static const char *const words[] = {[QDOT_HOLONOMIC] = " + sum lambda df/dq",
                                        [QDOT_VELOCITY] = " + sum lambda df/dq'",
                                        [QDOT_ACCELERATION] = " + sum lambda df/dq''"};
    int kind = s->constraints.at[0].kind;

    for (size_t i = 1; i < s->constraints.n; i++)
        if ((int)s->constraints.at[i].kind != kind)
            return " + sum lambda df/dq (df/dq', df/dq'')";
    return words[kind];
}

static bool
contains_velocity(const qdot_scene *s, qdot_expr e)
{
    return (qdot_expr_node(s->pool, e)->holds & QDOT_HAS_VELOCITY) != 0;
}

/* Whether a force acts on a material point that may move within its body. */
static bool
acts_on_material_point(const qdot_scene *s)
{
    for (size_t i = 0; i < s->forces.n; i++)
        if (s->forces.at[i].material)
            return true;
    return false;
}

static bool
has_no_forces(qdot_scene *s)
{
    for (size_t i = 0; i < s->coordinates.n; i++)
        if (qdot_mech_force(s, s->coordinates.at[i]) != QDOT_ZERO)
            return false;
    return true;
}

/* Write f' = 0 and f'' = 0, as far as they follow from a constraint of this kind, f(q, t) = 0 or f(q, q', t) = 0. */
static qdot_status
write_constraint_derivatives(qdot_derivation *d, const qdot_constraint *c)
{
    enum { LINE = 60 };
    qdot_pool *pool = d->session->pool;
    qdot_expr f = c->f;

    for (int k = (int)c->kind; k < 2; k++) {
        const bool once = k == (int)c->kind;

        f = qdot_ddt(pool, f);
        if (f == QDOT_NIL || qdot_expr_size(pool, f) > LINE)
            break;
        qdot_derive_label(d, once ? "differentiated" : "differentiated twice", NULL, NULL, NULL);
        QDOT_TRY(qdot_derive_relation(d, qdot_rel(pool, QDOT_EQ, f, QDOT_ZERO)));
    }
    return qdot_pool_check(pool);
}

/* Whether a force is written as a generalized force: all of them, or if L is stated only those not
 * contained in L. */
static bool
is_generalized_force(const qdot_derivation *d, const qdot_force_source *source)
{
    return d->session->scene->lagrangian == QDOT_NIL || !source->conservative;
}

/* Write the work of each force and torque in a virtual displacement delta q. */
static qdot_status
write_virtual_work(qdot_derivation *d)
{
    qdot_scene *s = d->session->scene;
    qdot_force_source source;
    size_t sources = 0;

    for (size_t k = 0; qdot_mech_source_at(s, k, &source); k++)
        sources += is_generalized_force(d, &source);
    if (sources < 2)
        return QDOT_OK;
    qdot_derive_step(d, "Virtual work of what acts",
               acts_on_material_point(s) ? "deltaW = sum F.dv/dq' deltaq" : "deltaW = sum F.dr/dq deltaq");
    for (size_t k = 0; qdot_mech_source_at(s, k, &source); k++) {
        const bool on = source.name != NULL && (strcmp(source.kind, "force") == 0 ||
                                                strcmp(source.kind, "torque") == 0);
        qdot_expr W = QDOT_ZERO;

        if (!is_generalized_force(d, &source))
            continue;
        for (size_t i = 0; i < s->coordinates.n; i++) {
            const qdot_expr q = s->coordinates.at[i];

            W = qdot_add(s->pool, W,
                         qdot_mul(s->pool, qdot_mech_source_force(s, &source, q),
                                  qdot_symbol_of(s->pool, QDOT_DELTA, q)));
        }
        qdot_derive_label(d, "virtual work", source.kind, on ? " on " : " ", source.name);
        QDOT_TRY(qdot_derive_equation(d, make_symbol("deltaW"), W));
    }
    return QDOT_OK;
}

/* Begin the step of generalized forces: "sum F.dr/dq - dV/dq - dD/dq'", with the terms that occur. */
static qdot_status
begin_forces_step(qdot_derivation *d)
{
    qdot_scene *s = d->session->scene;
    const bool stated = s->lagrangian != QDOT_NIL;
    const bool forces = s->forces.n + s->torques.n + s->dampers.n > 0;
    const qdot_expr V = stated ? QDOT_ZERO : qdot_mech_potential(s);
    qdot_text formula = {0};
    qdot_status status;

    QDOT_TRY(qdot_pool_check(s->pool));
    qdot_text_format(&formula, "Q = %s%s%s",
                     !forces          ? ""
                     : acts_on_material_point(s) ? "sum F.dv/dq'"
                                      : "sum F.dr/dq",
                     contains_velocity(s, V) ? forces ? " + d/dt dV/dq' - dV/dq"
                                                   : "d/dt dV/dq' - dV/dq"
                     : stated             ? ""
                     : forces             ? " - dV/dq"
                                          : "-dV/dq",
                     s->dissipations.n == 0 ? ""
                     : forces || !stated    ? " - dD/dq'"
                                            : "-dD/dq'");
    status = qdot_text_status(&formula);
    if (status == QDOT_OK)
        qdot_derive_step(d, stated ? "Generalized forces beside L" : "Generalized forces",
                   qdot_text_str(&formula));
    qdot_text_clear(&formula);
    return status;
}

/* Whether the equations have a right side Q; with a stated L only if there are forces besides it. */
static bool
has_forces(const qdot_scene *s)
{
    return s->lagrangian == QDOT_NIL ||
           s->forces.n + s->torques.n + s->dampers.n + s->dissipations.n > 0;
}

static qdot_status
write_right_sides(qdot_derivation *d)
{
    qdot_scene *s = d->session->scene;

    if (has_forces(s)) {
        QDOT_TRY(write_virtual_work(d));
        QDOT_TRY(begin_forces_step(d));
        if (has_no_forces(s))
            qdot_sheet_words(&d->sheet, "    none\n");
        for (size_t i = 0; i < s->coordinates.n && !has_no_forces(s); i++) {
            qdot_expr q = s->coordinates.at[i];

            if (qdot_scene_state_of(s, q) == NULL)
                QDOT_TRY(qdot_derive_equation(d, make_coordinate_symbol(d, "Q", q), qdot_mech_force(s, q)));
        }
    }
    if (s->constraints.n == 0)
        return QDOT_OK;
    qdot_derive_step(d, "Constraints", "f = left - right = 0");
    for (size_t i = 0; i < s->constraints.n; i++) {
        const qdot_constraint *c = &s->constraints.at[i];

        if (c->label != NULL)
            qdot_derive_label(d, "constraint", NULL, " ", c->name);
        QDOT_TRY(qdot_derive_relation(d, qdot_rel(s->pool, QDOT_EQ, c->left, c->right)));
        QDOT_TRY(write_constraint_derivatives(d, c));
    }
    return QDOT_OK;
}

static qdot_status
write_equations_of_motion(qdot_derivation *d)
{
    qdot_scene *s = d->session->scene;
    const bool stated = s->lagrangian != QDOT_NIL, right = has_forces(s);
    qdot_text formula = {0};
    qdot_status status;

    qdot_text_format(&formula, "d/dt d%c/dq' - d%c/dq = %s%s", stated ? 'L' : 'T',
                     stated ? 'L' : 'T', right ? "Q" : "",
                     s->constraints.n == 0 ? right ? "" : "0"
                     : right               ? reaction_term(s)
                                           : reaction_term(s) + 3);
    status = qdot_text_status(&formula);
    if (status == QDOT_OK)
        qdot_derive_step(d, "Lagrange's equations", qdot_text_str(&formula));
    qdot_text_clear(&formula);
    QDOT_TRY(status);
    for (size_t i = 0; i < s->coordinates.n; i++)
        if (qdot_scene_state_of(s, s->coordinates.at[i]) == NULL)
            QDOT_TRY(qdot_derive_relation(d, qdot_mech_equation(s, s->coordinates.at[i])));
    if (s->constraints.n > 0)
        qdot_sheet_format(&d->sheet,
                         "    with the constraints %zu equations for %zu coordinate%s and "
                         "%zu multiplier%s\n",
                         s->coordinates.n + s->constraints.n, s->coordinates.n,
                         s->coordinates.n == 1 ? "" : "s", s->constraints.n,
                         s->constraints.n == 1 ? "" : "s");
    return QDOT_OK;
}

/* Write the equations of first order, z' = rate. */
static qdot_status
write_states(qdot_derivation *d)
{
    qdot_scene *s = d->session->scene;

    if (s->states.n > 0)
        qdot_derive_step(d, "States", NULL);
    for (size_t i = 0; i < s->states.n; i++)
        QDOT_TRY(qdot_derive_relation(d, qdot_mech_equation(s, s->states.at[i].z)));
    return QDOT_OK;
}

/* Write the speeds, the velocities in them, and the equations projected on the velocities that the constraints allow. */
static qdot_status
write_speeds(qdot_derivation *d)
{
    qdot_session *session = d->session;
    qdot_pool *pool = session->pool;
    qdot_speeds speeds;
    qdot_expr all = QDOT_NIL;
    qdot_status status;

    QDOT_TRY(qdot_session_speeds(session, &speeds));
    status = speeds.n > 0 ? qdot_session_speeds_eom(session, QDOT_NIL, &all) : QDOT_OK;
    for (size_t k = 0; k < speeds.n && status == QDOT_OK; k++) {
        if (k == 0)
            qdot_derive_step(d, "Speeds", "u = E(q, q', t)");
        status = qdot_derive_relation(d, qdot_rel(pool, QDOT_EQ, speeds.symbol[k], speeds.value[k]));
    }
    for (uint32_t i = 0; speeds.n > 0 && i < qdot_expr_count(pool, all) && status == QDOT_OK; i++) {
        const uint32_t n = qdot_expr_count(pool, all), velocities = n - (uint32_t)speeds.n;

        if (i == 0)
            qdot_derive_step(d, "Velocities in speeds", "q' = sum b u + g");
        if (i == velocities)
            qdot_derive_step(d, "Equations of the speeds", "sum b (M q'' - f) = 0");
        status = qdot_derive_relation(d, qdot_expr_arg(pool, all, (i + (uint32_t)speeds.n) % n));
    }
    qdot_free((void *)speeds.symbol);
    return status;
}

/* Write the momenta that are constant because L does not contain their coordinates. */
static qdot_status
write_conserved_momenta(qdot_derivation *d)
{
    qdot_cyclic *list;
    size_t n, kept = 0;
    qdot_status status = QDOT_OK;

    QDOT_TRY(qdot_mech_cyclic(d->session->scene, &list, &n));
    for (size_t i = 0; i < n; i++)
        if (list[i].rate == QDOT_NIL)
            list[kept++] = list[i];
    if (kept > 0)
        qdot_derive_step(d, "Momenta of cyclic coordinates are conserved", "dL/dq = 0");
    for (size_t i = 0; i < kept && status == QDOT_OK; i++)
        status = qdot_derive_equation(d, make_coordinate_symbol(d, "p", list[i].coordinate), list[i].momentum);
    qdot_free(list);
    return status;
}

static qdot_status
write_hamiltons_equations(qdot_derivation *d)
{
    qdot_scene *s = d->session->scene;
    const qdot_expr all = qdot_hamilton_equations(s);

    QDOT_TRY(qdot_pool_check(s->pool));
    qdot_derive_step(d, "Hamilton's function, as stated", NULL);
    QDOT_TRY(qdot_derive_equation(d, make_symbol("H"), s->hamiltonian));
    qdot_derive_step(d, "Hamilton's equations", has_forces(s) ? "q' = dH/dp, p' = -dH/dq + Q" : "q' = dH/dp, p' = -dH/dq");
    for (uint32_t i = 0; i < qdot_expr_count(s->pool, all); i++)
        QDOT_TRY(qdot_derive_relation(d, qdot_expr_arg(s->pool, all, i)));
    return QDOT_OK;
}

static qdot_status
derive_print(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_derivation d = {.session = session};
    qdot_status status = QDOT_OK;

    if (session->scene->coordinates.n == 0) {
        (void)qdot_fail(QDOT_EINVAL,
                        "there is nothing to derive: no coordinate is declared");
        return qdot_hint("coord theta");
    }
    d.sheet = qdot_sheet_begin(session);
    d.sheet.whole = true;
    status = write_assumptions(&d);
    if (status == QDOT_OK)
        status = write_units(&d);
    if (session->scene->states.n == session->scene->coordinates.n) /* nothing moves */
        return qdot_sheet_end(&d.sheet, "derive", status == QDOT_OK ? write_states(&d) : status);
    if (status == QDOT_OK && session->scene->hamiltonian != QDOT_NIL) {
        status = write_hamiltons_equations(&d);
        if (status == QDOT_OK && session->scene->lagrangian == QDOT_NIL)
            return qdot_sheet_end(&d.sheet, "derive", status);
    }
    if (status == QDOT_OK && session->scene->lagrangian == QDOT_NIL)
        status = write_kinematics(&d);
    if (status == QDOT_OK)
        status = write_energies(&d);
    if (status == QDOT_OK)
        status = write_left_sides(&d);
    if (status == QDOT_OK)
        status = write_right_sides(&d);
    if (status == QDOT_OK)
        status = write_equations_of_motion(&d);
    if (status == QDOT_OK)
        status = write_states(&d);
    if (status == QDOT_OK)
        status = write_speeds(&d);
    if (status == QDOT_OK)
        status = write_conserved_momenta(&d);
    return qdot_sheet_end(&d.sheet, "derive", status);
}
