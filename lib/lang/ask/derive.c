/* derive.c -- the statement `derive`: the whole derivation from r(q) to the equations, as in a textbook. */
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "lang/answer/notation.h"
#include "lang/answer/sheet.h"
#include "lang/syntax/record.h"
#include "mech/dynamics/quantity.h"
#include "mech/geometry/metric.h"
#include "mech/study/hamilton.h"
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

typedef struct {
    qdot_session *session;
    qdot_sheet sheet;
    int step;
} derivation;

/* Whether symbols are written in one line, v[bob]^2, rather than with raised and lowered parts. */
static bool
is_written_in_one_line(const derivation *d)
{
    return d->sheet.form == QDOT_SHEET_DRAWN || d->sheet.notation != QDOT_NOTATION_DRAWN;
}

/* The notation in which the formulas within a line are written. */
static qdot_notation_kind
notation_within_line(const derivation *d)
{
    return d->sheet.notation == QDOT_NOTATION_SCRIPT ? QDOT_NOTATION_SCRIPT : QDOT_NOTATION_LINE;
}

/* Begin a step of the derivation: `3. Title: formula`, the formula in the notation of qdot_notation_add; NULL: none. */
static void
begin_step(derivation *d, const char *title, const char *formula)
{
    qdot_sheet *s = &d->sheet;
    qdot_text line = {0};

    qdot_sheet_format(s, "%s%d. %s%s", d->step > 0 ? "\n" : "", d->step + 1, title, formula != NULL ? ": " : "");
    d->step++;
    if (formula != NULL && is_written_in_one_line(d)) {
        qdot_notation_print(formula, notation_within_line(d), &line);
        qdot_sheet_words(s, qdot_text_str(&line));
    } else if (formula != NULL) {
        qdot_sheet_open(s);
        qdot_notation_add(&s->formula, s->at, formula, QDOT_NOTATION_DRAWN);
        qdot_sheet_close(s);
    }
    qdot_sheet_words(s, "\n");
    s->formula.failed = s->formula.failed || line.failed;
    qdot_text_clear(&line);
}

/* What a line is of, before its formula: `    potential energy of gravity on bob: `; the last two
 * may be NULL. */
static void
write_line_label(derivation *d, const char *what, const char *of, const char *joined, const char *name)
{
    qdot_sheet_format(&d->sheet, "    %s%s%s%s%s: ", what, of != NULL ? " of " : "", of != NULL ? of : "",
                      name != NULL ? joined : "", name != NULL ? name : "");
}

/* Append ` = value`, and end the formula and its line. */
static qdot_status
write_equal_to(derivation *d, qdot_expr value)
{
    qdot_sheet_sign(&d->sheet, QDOT_SIGN_EQUALS);
    QDOT_TRY(qdot_sheet_expr(&d->sheet, value));
    qdot_sheet_close(&d->sheet);
    qdot_sheet_words(&d->sheet, "\n");
    return QDOT_OK;
}

/* A textbook symbol with the particle, body or coordinate it belongs to: r[bob], drawn as r with a subscript. */
typedef struct {
    const char *letter;   /* the symbol as qdot_notation_add reads it */
    const char *of;       /* subscript: a label or coordinate name; NULL: none */
    qdot_expr coordinate; /* coordinate of the subscript; nil: `of` is a label */
    bool square;
} symbol;

/* Add a symbol, squared or not, in one line of text: letter, index in brackets, square. */
static qdot_status
append_symbol_in_line(derivation *d, const symbol *x)
{
    const bool script = notation_within_line(d) == QDOT_NOTATION_SCRIPT;
    qdot_text text = {0};
    qdot_status status = QDOT_OK;

    qdot_notation_print(x->letter, notation_within_line(d), &text);
    if (x->of != NULL) {
        qdot_text_char(&text, '[');
        if (x->coordinate != QDOT_NIL)
            status = qdot_print(d->session->pool, x->coordinate, script ? QDOT_PLAIN : QDOT_UNICODE, &text);
        else
            qdot_text_add(&text, x->of);
        qdot_text_char(&text, ']');
    }
    qdot_text_add(&text, !x->square ? "" : script ? "^2" : "²");
    if (status == QDOT_OK)
        qdot_formula_add_text(&d->sheet.formula, d->sheet.at, QDOT_TEXT_WORDS, qdot_text_str(&text), text.n);
    d->sheet.formula.failed = d->sheet.formula.failed || text.failed;
    qdot_text_clear(&text);
    return status;
}

/* Add a symbol, squared or not, to a drawn formula: index below, square above. */
static qdot_status
append_drawn_symbol(derivation *d, const symbol *x)
{
    qdot_formula *f = &d->sheet.formula;
    const qdot_formula_id outer = d->sheet.at,
                          power = x->square ? qdot_formula_add(f, outer, QDOT_FORMULA_POWER, 0, 0) : outer;
    qdot_formula_id index, row;
    qdot_status status = QDOT_OK;

    if (x->of == NULL) {
        qdot_notation_add(f, power, x->letter, QDOT_NOTATION_DRAWN);
    } else {
        index = qdot_formula_add(f, power, QDOT_FORMULA_INDEX, 0, 0);
        row = qdot_formula_add(f, index, QDOT_FORMULA_ROW, 0, 0);
        qdot_notation_add(f, row, x->letter, QDOT_NOTATION_DRAWN);
        d->sheet.at = qdot_formula_add(f, index, QDOT_FORMULA_ROW, 0, 0);
        if (x->coordinate != QDOT_NIL)
            status = qdot_sheet_expr(&d->sheet, x->coordinate);
        else
            qdot_formula_add_text(f, d->sheet.at, QDOT_TEXT_LABEL, x->of, strlen(x->of));
    }
    if (x->square)
        qdot_formula_add_text(f, power, QDOT_TEXT_NUMBER, "2", 1);
    d->sheet.at = outer;
    return status;
}

/* Indent the line if it is still empty. */
static void
indent_empty_line(derivation *d)
{
    if (qdot_sheet_at_begin(&d->sheet))
        qdot_sheet_words(&d->sheet, "    ");
}

/* Append a line with the equation `symbol = value`. */
static qdot_status
write_equation_line(derivation *d, symbol x, qdot_expr value)
{
    QDOT_TRY(qdot_pool_check(d->session->pool));
    indent_empty_line(d);
    qdot_sheet_open(&d->sheet);
    QDOT_TRY(is_written_in_one_line(d) ? append_symbol_in_line(d, &x) : append_drawn_symbol(d, &x));
    return write_equal_to(d, value);
}

static symbol
make_symbol(const char *letter)
{
    return (symbol){.letter = letter};
}

/* Append `dF/dq' = value`, with d/dt before it (total), or `dF/dq = value` (not `fast`); if possible as fractions. */
static qdot_status
write_derivative_of_function(derivation *d, char F, bool total, bool fast, size_t i, qdot_expr value)
{
    qdot_session *s = d->session;
    qdot_sheet *sheet = &d->sheet;
    qdot_formula *f = &sheet->formula;
    qdot_expr q = qdot_symbol_jet(s->pool, s->scene->coordinates.at[i], fast);
    qdot_formula_id outer, fraction;

    QDOT_TRY(qdot_pool_check(s->pool));
    qdot_sheet_words(sheet, "    ");
    qdot_sheet_open(sheet);
    outer = sheet->at;
    if (total) {
        qdot_notation_add(f, outer, "d/dt", sheet->notation);
        qdot_sheet_sign(sheet, QDOT_SIGN_BESIDE);
    }
    fraction = qdot_formula_add(f, outer, QDOT_FORMULA_FRACTION, 0, 0);
    for (int side = 0; side < 2; side++) {
        sheet->at = qdot_formula_add(f, fraction, QDOT_FORMULA_ROW, 0, 0);
        qdot_sheet_sign(sheet, QDOT_SIGN_PARTIAL);
        qdot_sheet_sign(sheet, QDOT_SIGN_BLANK);
        if (side == 0)
            qdot_formula_add_text(f, sheet->at, QDOT_TEXT_NAME, &F, 1);
        else
            QDOT_TRY(qdot_sheet_expr(sheet, q));
    }
    sheet->at = outer;
    return write_equal_to(d, value);
}

/* Append a relation on a line of its own. */
static qdot_status
write_relation(derivation *d, qdot_expr e)
{
    QDOT_TRY(qdot_pool_check(d->session->pool));
    indent_empty_line(d);
    QDOT_TRY(qdot_sheet_formula(&d->sheet, e));
    qdot_sheet_words(&d->sheet, "\n");
    return QDOT_OK;
}

/* Simplify e for printing, unless e is longer than a page. */
static qdot_expr
simplify_for_page(derivation *d, qdot_expr e)
{
    enum { PAGE = 4000 };
    qdot_facts facts = qdot_scene_facts(d->session->scene);

    if (e == QDOT_NIL || qdot_expr_size(d->session->pool, e) > PAGE)
        return e;
    return qdot_common_out(d->session->pool, qdot_simplify(d->session->pool, e, &facts));
}

/* Append the angular velocity omega of a body; in space also along the body's own axes, as for its inertia. */
static qdot_status
write_angular_velocity(derivation *d, const qdot_body *b)
{
    qdot_scene *s = d->session->scene;
    const symbol omega = {.letter = "omega", .of = b->name};
    qdot_expr w = qdot_scene_spin(s, b->name);

    if (b->angle != QDOT_NIL)
        return write_equation_line(d, omega, w);
    QDOT_TRY(write_equation_line(d, omega, w));
    w = qdot_value_mul(s->pool, qdot_transpose(s->pool, b->rotation), w);
    write_line_label(d, "along the axes of the body", NULL, NULL, NULL);
    return write_equation_line(d, omega, simplify_for_page(d, w));
}

/* Write the angle by which a body in the plane is turned, unless it is constant. */
static qdot_status
write_turning_angle(derivation *d, const qdot_body *b)
{
    if (b->angle == QDOT_NIL || qdot_expr_kind(d->session->pool, b->angle) == QDOT_NUM)
        return QDOT_OK;
    write_line_label(d, "angle", b->name, NULL, NULL);
    QDOT_TRY(qdot_sheet_formula(&d->sheet, b->angle));
    qdot_sheet_words(&d->sheet, "\n");
    return QDOT_OK;
}

/* List the assumptions of the steps that follow. */
static qdot_status
write_assumptions(derivation *d)
{
    const qdot_scene *s = d->session->scene;

    if (s->assumed.n > 0)
        begin_step(d, "Assumed", NULL);
    for (size_t i = 0; i < s->assumed.n; i++)
        QDOT_TRY(write_relation(d, s->assumed.at[i].relation));
    return QDOT_OK;
}

/* Write position r, velocity v = sum dr/dq q' + dr/dt, and v^2 of everything that has mass. */
static qdot_status
write_kinematics(derivation *d)
{
    qdot_scene *s = d->session->scene;
    size_t n = s->particles.n + s->bodies.n;

    for (int step = 0; step < 3; step++) {
        begin_step(d, step == 0 ? "Positions" : step == 1 ? "Velocities" : "Squares of speeds",
                   step == 0   ? "r(q, t)"
                   : step == 1 ? "v = sum dr/dq q' + dr/dt"
                            : "v^2 = v.v");
        for (size_t i = 0; i < n; i++) {
            bool particle = i < s->particles.n;
            const qdot_body *b = particle ? NULL : &s->bodies.at[i - s->particles.n];
            const char *name = particle ? s->particles.at[i].name : b->name;
            qdot_expr r = particle ? s->particles.at[i].position : b->position;
            symbol x = {.letter = step == 0 ? "r" : "v", .of = name, .square = step == 2};

            QDOT_TRY(write_equation_line(d, x,
                                         step == 0   ? r
                                         : step == 1 ? simplify_for_page(d, qdot_ddt(s->pool, r))
                                                     : qdot_mech_speed2(s, r)));
            if (step == 0 && !particle)
                QDOT_TRY(write_turning_angle(d, b));
            if (step == 1 && !particle)
                QDOT_TRY(write_angular_velocity(d, b));
        }
    }
    return QDOT_OK;
}

/* Write the contribution of each particle and body to T, then T itself. */
static qdot_status
write_kinetic_energy(derivation *d)
{
    qdot_scene *s = d->session->scene;
    const size_t n = s->particles.n + s->bodies.n;
    bool plane = false, space = false;
    qdot_energy_part part;

    for (size_t i = 0; i < s->bodies.n; i++)
        *(s->bodies.at[i].angle != QDOT_NIL ? &plane : &space) = true;
    begin_step(d, "Kinetic energy",
               plane && space ? "T = 1/2 sum m v^2 + 1/2 sum omega.I omega (I omega^2)"
               : space        ? "T = 1/2 sum m v^2 + 1/2 sum omega.I omega"
               : plane        ? "T = 1/2 sum m v^2 + 1/2 sum I omega^2"
                           : "T = 1/2 sum m v^2");
    for (size_t k = 0; n > 1 && qdot_mech_kinetic_part(s, k, &part); k++) {
        const symbol T = {.letter = "T", .of = part.name};

        write_line_label(d, part.kind, part.name, NULL, NULL);
        QDOT_TRY(write_equation_line(d, T, part.value));
    }
    if (n > 1)
        write_line_label(d, "together", NULL, NULL, NULL);
    QDOT_TRY(write_equation_line(d, make_symbol("T"), qdot_mech_kinetic(s)));
    if (s->coordinates.n == 1)
        return QDOT_OK;
    write_line_label(d, "mass matrix", NULL, NULL, NULL);
    return write_equation_line(d, make_symbol("M"), qdot_mech_mass_matrix(s));
}

/* Write the contribution of each field, potential and spring to V, then V itself. */
static qdot_status
write_potential_energy(derivation *d)
{
    qdot_scene *s = d->session->scene;
    qdot_energy_part part;
    bool several = qdot_mech_potential_part(s, 1, &part);

    begin_step(d, "Potential energy",
               s->gravities.n > 0 && s->potentials.n + s->springs.n == 0 ? "V = -sum m g.r" : NULL);
    for (size_t k = 0; several && qdot_mech_potential_part(s, k, &part); k++) {
        char number[24];

        snprintf(number, sizeof number, "%zu", k + 1);
        if (strcmp(part.kind, "potential") == 0)
            write_line_label(d, part.name != NULL ? "potential energy" : "potential energy as declared",
                             part.name, NULL, NULL);
        else
            write_line_label(d, "potential energy", part.kind,
                             strcmp(part.kind, "gravity") == 0 ? " on " : " ", part.name);
        QDOT_TRY(write_equation_line(d, (symbol){.letter = "V", .of = number}, part.value));
    }
    if (several)
        write_line_label(d, "together", NULL, NULL, NULL);
    return write_equation_line(d, make_symbol("V"), qdot_mech_potential(s));
}

static qdot_status
write_energies(derivation *d)
{
    qdot_scene *s = d->session->scene;

    if (s->lagrangian != QDOT_NIL) {
        begin_step(d, s->hamiltonian != QDOT_NIL ? "Lagrangian, with q' = dH/dp solved for p" : "Lagrangian, as stated",
                   s->hamiltonian != QDOT_NIL ? "L = sum p q' - H" : NULL);
        return write_equation_line(d, make_symbol("L"), qdot_mech_lagrangian(s));
    }
    QDOT_TRY(write_kinetic_energy(d));
    QDOT_TRY(write_potential_energy(d));
    begin_step(d, "Lagrangian", "L = T - V");
    return write_equation_line(d, make_symbol("L"), qdot_mech_lagrangian(s));
}

static symbol
make_coordinate_symbol(const derivation *d, const char *letter, qdot_expr q)
{
    return (symbol){.letter = letter,
                    .of = qdot_expr_symbol(d->session->pool, q)->name,
                    .coordinate = q};
}

/* Write p = dL/dq', then the left side of the equations, with F = T, or F = L if a Lagrangian is stated. */
static qdot_status
write_left_sides(derivation *d)
{
    qdot_scene *s = d->session->scene;
    qdot_pool *pool = s->pool;
    bool stated = s->lagrangian != QDOT_NIL;
    qdot_expr F = stated ? qdot_mech_lagrangian(s) : qdot_mech_kinetic(s);
    char letter = stated ? 'L' : 'T';

    begin_step(d, "Momenta", "p = dL/dq'");
    for (size_t i = 0; i < s->coordinates.n; i++) {
        qdot_expr q = s->coordinates.at[i];

        if (qdot_scene_state_of(s, q) == NULL)
            QDOT_TRY(write_equation_line(d, make_coordinate_symbol(d, "p", q), qdot_mech_momentum(s, q)));
    }
    begin_step(d, stated ? "Derivatives of L" : "Derivatives of T", NULL);
    for (size_t i = 0; i < s->coordinates.n; i++) {
        qdot_expr q = s->coordinates.at[i];
        qdot_expr slope = qdot_diff(pool, F, qdot_symbol_jet(pool, q, 1));

        if (qdot_scene_state_of(s, q) != NULL)
            continue;
        slope = simplify_for_page(d, slope);
        if (slope != QDOT_NIL && slope != qdot_mech_momentum(s, q))
            QDOT_TRY(write_derivative_of_function(d, letter, false, true, i, slope));
        QDOT_TRY(write_derivative_of_function(d, letter, true, true, i, simplify_for_page(d, qdot_ddt(pool, slope))));
        QDOT_TRY(write_derivative_of_function(d, letter, false, false, i, simplify_for_page(d, qdot_diff(pool, F, q))));
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
write_constraint_derivatives(derivation *d, const qdot_constraint *c)
{
    enum { LINE = 60 };
    qdot_pool *pool = d->session->pool;
    qdot_expr f = c->f;

    for (int k = (int)c->kind; k < 2; k++) {
        const bool once = k == (int)c->kind;

        f = qdot_ddt(pool, f);
        if (f == QDOT_NIL || qdot_expr_size(pool, f) > LINE)
            break;
        write_line_label(d, once ? "differentiated" : "differentiated twice", NULL, NULL, NULL);
        QDOT_TRY(write_relation(d, qdot_rel(pool, QDOT_EQ, f, QDOT_ZERO)));
    }
    return qdot_pool_check(pool);
}

/* Whether a force is written as a generalized force: all of them, or if L is stated only those not
 * contained in L. */
static bool
is_generalized_force(const derivation *d, const qdot_force_source *source)
{
    return d->session->scene->lagrangian == QDOT_NIL || !source->conservative;
}

/* Write the work of each force and torque in a virtual displacement delta q. */
static qdot_status
write_virtual_work(derivation *d)
{
    qdot_scene *s = d->session->scene;
    qdot_force_source source;
    size_t sources = 0;

    for (size_t k = 0; qdot_mech_source_at(s, k, &source); k++)
        sources += is_generalized_force(d, &source);
    if (sources < 2)
        return QDOT_OK;
    begin_step(d, "Virtual work of what acts",
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
        write_line_label(d, "virtual work", source.kind, on ? " on " : " ", source.name);
        QDOT_TRY(write_equation_line(d, make_symbol("deltaW"), W));
    }
    return QDOT_OK;
}

/* Begin the step of generalized forces: "sum F.dr/dq - dV/dq - dD/dq'", with the terms that occur. */
static qdot_status
begin_forces_step(derivation *d)
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
        begin_step(d, stated ? "Generalized forces beside L" : "Generalized forces",
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
write_right_sides(derivation *d)
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
                QDOT_TRY(write_equation_line(d, make_coordinate_symbol(d, "Q", q), qdot_mech_force(s, q)));
        }
    }
    if (s->constraints.n == 0)
        return QDOT_OK;
    begin_step(d, "Constraints", "f = left - right = 0");
    for (size_t i = 0; i < s->constraints.n; i++) {
        const qdot_constraint *c = &s->constraints.at[i];

        if (c->label != NULL)
            write_line_label(d, "constraint", NULL, " ", c->name);
        QDOT_TRY(write_relation(d, qdot_rel(s->pool, QDOT_EQ, c->left, c->right)));
        QDOT_TRY(write_constraint_derivatives(d, c));
    }
    return QDOT_OK;
}

static qdot_status
write_equations_of_motion(derivation *d)
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
        begin_step(d, "Lagrange's equations", qdot_text_str(&formula));
    qdot_text_clear(&formula);
    QDOT_TRY(status);
    for (size_t i = 0; i < s->coordinates.n; i++)
        if (qdot_scene_state_of(s, s->coordinates.at[i]) == NULL)
            QDOT_TRY(write_relation(d, qdot_mech_equation(s, s->coordinates.at[i])));
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
write_states(derivation *d)
{
    qdot_scene *s = d->session->scene;

    if (s->states.n > 0)
        begin_step(d, "States", NULL);
    for (size_t i = 0; i < s->states.n; i++)
        QDOT_TRY(write_relation(d, qdot_mech_equation(s, s->states.at[i].z)));
    return QDOT_OK;
}

/* Write the momenta that are constant because L does not contain their coordinates. */
static qdot_status
write_conserved_momenta(derivation *d)
{
    qdot_cyclic *list;
    size_t n, kept = 0;
    qdot_status status = QDOT_OK;

    QDOT_TRY(qdot_mech_cyclic(d->session->scene, &list, &n));
    for (size_t i = 0; i < n; i++)
        if (list[i].rate == QDOT_NIL)
            list[kept++] = list[i];
    if (kept > 0)
        begin_step(d, "Momenta of cyclic coordinates are conserved", "dL/dq = 0");
    for (size_t i = 0; i < kept && status == QDOT_OK; i++)
        status = write_equation_line(d, make_coordinate_symbol(d, "p", list[i].coordinate), list[i].momentum);
    qdot_free(list);
    return status;
}

static qdot_status
write_hamiltons_equations(derivation *d)
{
    qdot_scene *s = d->session->scene;
    const qdot_expr all = qdot_hamilton_equations(s);

    QDOT_TRY(qdot_pool_check(s->pool));
    begin_step(d, "Hamilton's function, as stated", NULL);
    QDOT_TRY(write_equation_line(d, make_symbol("H"), s->hamiltonian));
    begin_step(d, "Hamilton's equations", has_forces(s) ? "q' = dH/dp, p' = -dH/dq + Q" : "q' = dH/dp, p' = -dH/dq");
    for (uint32_t i = 0; i < qdot_expr_count(s->pool, all); i++)
        QDOT_TRY(write_relation(d, qdot_expr_arg(s->pool, all, i)));
    return QDOT_OK;
}

static qdot_status
derive_print(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    derivation d = {.session = session};
    qdot_status status = QDOT_OK;

    if (session->scene->coordinates.n == 0) {
        (void)qdot_fail(QDOT_EINVAL,
                        "there is nothing to derive: no coordinate is declared");
        return qdot_hint("coord theta");
    }
    d.sheet = qdot_sheet_begin(session);
    d.sheet.whole = true;
    status = write_assumptions(&d);
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
        status = write_conserved_momenta(&d);
    return qdot_sheet_end(&d.sheet, "derive", status);
}
