/* derive.c -- the whole derivation, from r(q) to the equations, as a textbook would. */
#include <stdio.h>

#include "expr/calculus.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/answer/formula.h"
#include "lang/commands/statement.h"
#include "mech/dynamics/quantity.h"
#include "normal/form/common.h"
#include "normal/simplify/simplify.h"

typedef struct {
    qdot_session *session;
    qdot_text text;
    int step;
} derivation;

static void
heading(derivation *d, const char *title)
{
    qdot_text_format(&d->text, "%s%d. %s\n", d->step > 0 ? "\n" : "", d->step + 1, title);
    d->step++;
}

/* ` = value`, the end of a formula and of its line. */
static qdot_status
equals(derivation *d, qdot_expr value)
{
    qdot_text_add(&d->text, qdot_formula_equals(d->session));
    QDOT_TRY(qdot_formula_print(d->session, value, d->session->style, &d->text));
    qdot_formula_bracket(d->session, false, &d->text);
    qdot_text_char(&d->text, '\n');
    return QDOT_OK;
}

/* `    name = value`, the name `before[of]behind` in the style of the session. */
static qdot_status
named(derivation *d, const char *before, const char *of, const char *behind,
      qdot_expr value)
{
    qdot_session *s = d->session;
    qdot_text name = {0};
    qdot_status status;

    QDOT_TRY(qdot_pool_check(s->pool));
    qdot_text_add(&name, before);
    qdot_text_add(&name, of);
    qdot_text_add(&name, behind);
    qdot_text_add(&d->text, "    ");
    qdot_formula_bracket(s, true, &d->text);
    status = qdot_text_status(&name);
    if (status == QDOT_OK)
        status = qdot_formula_name(s, qdot_text_str(&name), &d->text);
    qdot_text_clear(&name);
    QDOT_TRY(status);
    return equals(d, value);
}

/* `    d/dt dF/dq' = value` (total), `dF/dq' = value` or, not `fast`, `dF/dq = value`; drawn as a fraction
 * where the style draws. */
static qdot_status
slope_is(derivation *d, char F, bool total, bool fast, size_t i, qdot_expr value)
{
    qdot_session *s = d->session;
    qdot_expr q = s->scene->coordinates.at[i];
    bool latex = s->style == QDOT_LATEX;
    char before[16];

    if (!latex && s->style != QDOT_MATHML) {
        snprintf(before, sizeof before, "%sd%c/d", total ? "d/dt " : "", F);
        return named(d, before, qdot_expr_symbol(s->pool, q)->name, fast ? "'" : "",
                     value);
    }
    q = qdot_symbol_jet(s->pool, q, fast);
    QDOT_TRY(qdot_pool_check(s->pool));
    qdot_text_add(&d->text, "    ");
    qdot_formula_bracket(s, true, &d->text);
    if (total)
        qdot_text_add(&d->text, latex ? "\\frac{d}{dt} "
                                      : "<mfrac><mi>d</mi><mrow><mi>d</mi><mi>t</mi></mrow></mfrac>"
                                        "<mo>&#x2062;</mo>");
    qdot_text_format(&d->text,
                     latex ? "\\frac{\\partial %c}{\\partial "
                           : "<mfrac><mrow><mo>∂</mo><mi>%c</mi></mrow><mrow><mo>∂</mo>",
                     F);
    QDOT_TRY(qdot_print(s->pool, q, s->style, &d->text));
    qdot_text_add(&d->text, latex ? "}" : "</mrow></mfrac>");
    return equals(d, value);
}

/* The relation as it stands, behind its label: in LaTeX as text. */
static qdot_status
relation(derivation *d, const char *label, qdot_expr e)
{
    bool latex = d->session->style == QDOT_LATEX;

    QDOT_TRY(qdot_pool_check(d->session->pool));
    qdot_text_add(&d->text, "    ");
    if (label != NULL) {
        qdot_text_add(&d->text, latex ? "\\text{" : "");
        for (const char *c = label; *c != '\0'; c++) {
            qdot_text_add(&d->text, latex && *c == '_' ? "\\" : "");
            qdot_text_char(&d->text, *c);
        }
        qdot_text_add(&d->text, latex ? "}: " : ": ");
    }
    QDOT_TRY(qdot_formula(d->session, e, &d->text));
    qdot_text_char(&d->text, '\n');
    return QDOT_OK;
}

static const char *
name_of(const derivation *d, size_t i)
{
    return qdot_expr_symbol(d->session->pool, d->session->scene->coordinates.at[i])->name;
}

/* In the form for people, unless it is larger than a page. */
static qdot_expr
tidy(derivation *d, qdot_expr e)
{
    enum { PAGE = 4000 };
    qdot_facts facts = qdot_scene_facts(d->session->scene);

    if (e == QDOT_NIL || qdot_expr_size(d->session->pool, e) > PAGE)
        return e;
    return qdot_common_out(d->session->pool, qdot_simplify(d->session->pool, e, &facts));
}

/* w, in space also along the body's own axes, in which its inertia is given. */
static qdot_status
spin(derivation *d, const qdot_body *b)
{
    qdot_scene *s = d->session->scene;
    qdot_expr w = qdot_scene_spin(s, b->name);

    if (b->angle != QDOT_NIL)
        return named(d, "w[", b->name, "]", w);
    QDOT_TRY(named(d, "w[", b->name, "]", w));
    w = qdot_value_mul(s->pool, qdot_transpose(s->pool, b->rotation), w);
    qdot_text_add(&d->text, "    along the axes of the body:\n");
    return named(d, "w[", b->name, "]", tidy(d, w));
}

/* What the steps below may use beside the laws of algebra. */
static qdot_status
assumptions(derivation *d)
{
    const qdot_scene *s = d->session->scene;

    if (s->assumed.n > 0)
        heading(d, "Assumed");
    for (size_t i = 0; i < s->assumed.n; i++)
        QDOT_TRY(relation(d, NULL, s->assumed.at[i].relation));
    return QDOT_OK;
}

/* r, v = sum dr/dq q' + dr/dt and v^2 of everything that has a mass. */
static qdot_status
kinematics(derivation *d)
{
    qdot_scene *s = d->session->scene;
    size_t n = s->particles.n + s->bodies.n;

    for (int step = 0; step < 3; step++) {
        heading(d, step == 0   ? "Positions: r(q, t)"
                   : step == 1 ? "Velocities: v = sum dr/dq q' + dr/dt"
                               : "Speeds: v^2 = v.v");
        for (size_t i = 0; i < n; i++) {
            bool particle = i < s->particles.n;
            const qdot_body *b = particle ? NULL : &s->bodies.at[i - s->particles.n];
            const char *name = particle ? s->particles.at[i].name : b->name;
            qdot_expr r = particle ? s->particles.at[i].position : b->position;

            if (step == 0)
                QDOT_TRY(named(d, "r[", name, "]", r));
            else if (step == 1)
                QDOT_TRY(named(d, "v[", name, "]", tidy(d, qdot_ddt(s->pool, r))));
            else
                QDOT_TRY(named(d, "v[", name, "]^2", qdot_mech_speed2(s, r)));
            if (step == 1 && !particle)
                QDOT_TRY(spin(d, b));
        }
    }
    return QDOT_OK;
}

static qdot_status
energies(derivation *d)
{
    qdot_scene *s = d->session->scene;
    bool plane = false, space = false;

    if (s->lagrangian != QDOT_NIL) {
        heading(d, "Lagrangian, as stated");
        return named(d, "L", "", "", qdot_mech_lagrangian(s));
    }
    for (size_t i = 0; i < s->bodies.n; i++)
        *(s->bodies.at[i].angle != QDOT_NIL ? &plane : &space) = true;
    heading(d, plane && space
                   ? "Kinetic energy: T = 1/2 sum m v^2 + 1/2 sum w.I w (I w^2)"
               : space ? "Kinetic energy: T = 1/2 sum m v^2 + 1/2 sum w.I w"
               : plane ? "Kinetic energy: T = 1/2 sum m v^2 + 1/2 sum I w^2"
                       : "Kinetic energy: T = 1/2 sum m v^2");
    QDOT_TRY(named(d, "T", "", "", qdot_mech_kinetic(s)));
    if (s->coordinates.n > 1)
        QDOT_TRY(named(d, "M", "", "", qdot_mech_mass_matrix(s)));
    heading(d, "Potential energy");
    QDOT_TRY(named(d, "V", "", "", qdot_mech_potential(s)));
    heading(d, "Lagrangian: L = T - V");
    return named(d, "L", "", "", qdot_mech_lagrangian(s));
}

/* p = dL/dq', then what stands on the left: F = T, or L where it is stated. */
static qdot_status
left_sides(derivation *d)
{
    qdot_scene *s = d->session->scene;
    qdot_pool *pool = s->pool;
    bool stated = s->lagrangian != QDOT_NIL;
    qdot_expr F = stated ? qdot_mech_lagrangian(s) : qdot_mech_kinetic(s);
    char letter = stated ? 'L' : 'T';

    heading(d, "Momenta: p = dL/dq'");
    for (size_t i = 0; i < s->coordinates.n; i++)
        QDOT_TRY(named(d, "p[", name_of(d, i), "]",
                       qdot_mech_momentum(s, s->coordinates.at[i])));
    heading(d, stated ? "Slopes of L" : "Slopes of T");
    for (size_t i = 0; i < s->coordinates.n; i++) {
        qdot_expr q = s->coordinates.at[i];
        qdot_expr slope = qdot_diff(pool, F, qdot_symbol_jet(pool, q, 1));

        slope = tidy(d, slope);
        if (slope != QDOT_NIL && slope != qdot_mech_momentum(s, q))
            QDOT_TRY(slope_is(d, letter, false, true, i, slope));
        QDOT_TRY(slope_is(d, letter, true, true, i, tidy(d, qdot_ddt(pool, slope))));
        QDOT_TRY(slope_is(d, letter, false, false, i, tidy(d, qdot_diff(pool, F, q))));
    }
    return QDOT_OK;
}

/* "sum lambda df/dq" by the kinds of constraints there are. */
static const char *
reaction(const qdot_scene *s)
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
holds_velocity(const qdot_scene *s, qdot_expr e)
{
    return (qdot_expr_node(s->pool, e)->holds & QDOT_HAS_VELOCITY) != 0;
}

/* Whether a force acts on material at a place that may move within its body. */
static bool
on_material(const qdot_scene *s)
{
    for (size_t i = 0; i < s->forces.n; i++)
        if (s->forces.at[i].material)
            return true;
    return false;
}

static bool
no_forces(qdot_scene *s)
{
    for (size_t i = 0; i < s->coordinates.n; i++)
        if (qdot_mech_force(s, s->coordinates.at[i]) != QDOT_ZERO)
            return false;
    return true;
}

/* f' = 0 and f'' = 0, as far as the constraint has them to give. */
static qdot_status
slopes(derivation *d, const qdot_constraint *c)
{
    static const char *const names[] = {"f'", "f''"};
    enum { LINE = 60 };
    qdot_pool *pool = d->session->pool;
    qdot_expr f = c->f;

    for (int k = (int)c->kind; k < 2; k++) {
        f = qdot_ddt(pool, f);
        if (f == QDOT_NIL || qdot_expr_size(pool, f) > LINE)
            break;
        QDOT_TRY(relation(d, names[k - (int)c->kind],
                          qdot_rel(pool, QDOT_EQ, f, QDOT_ZERO)));
    }
    return qdot_pool_check(pool);
}

static qdot_status
right_sides(derivation *d)
{
    qdot_scene *s = d->session->scene;
    bool stated = s->lagrangian != QDOT_NIL;
    bool applied = s->forces.n + s->torques.n + s->dampers.n + s->dissipations.n > 0;

    if (!stated || applied) {
        qdot_text title = {0};
        bool forces = s->forces.n + s->torques.n + s->dampers.n > 0;
        qdot_expr V = stated ? QDOT_ZERO : qdot_mech_potential(s);

        QDOT_TRY(qdot_pool_check(s->pool));
        qdot_text_format(&title, "Generalized forces%s: Q =%s%s%s%s",
                         stated ? " beside L" : "",
                         !forces            ? ""
                         : on_material(s) ? " sum F.dv/dq'"
                                          : " sum F.dr/dq",
                         forces && holds_velocity(s, V) ? " +" : "",
                         holds_velocity(s, V) ? " d/dt dV/dq' - dV/dq"
                         : stated             ? ""
                         : forces             ? " - dV/dq"
                                              : " -dV/dq",
                         s->dissipations.n == 0 ? ""
                         : forces || !stated    ? " - dD/dq'"
                                                : " -dD/dq'");
        QDOT_TRY(qdot_text_status(&title));
        heading(d, qdot_text_str(&title));
        qdot_text_clear(&title);
        if (no_forces(s))
            qdot_text_add(&d->text, "    none\n");
        for (size_t i = 0; i < s->coordinates.n && !no_forces(s); i++)
            QDOT_TRY(named(d, "Q[", name_of(d, i), "]",
                           qdot_mech_force(s, s->coordinates.at[i])));
    }
    if (s->constraints.n == 0)
        return QDOT_OK;
    heading(d, "Constraints: f = left - right = 0");
    for (size_t i = 0; i < s->constraints.n; i++) {
        const qdot_constraint *c = &s->constraints.at[i];

        QDOT_TRY(relation(d, c->label == NULL ? NULL : c->name,
                          qdot_rel(s->pool, QDOT_EQ, c->left, c->right)));
        QDOT_TRY(slopes(d, c));
    }
    return QDOT_OK;
}

static qdot_status
equations(derivation *d)
{
    qdot_scene *s = d->session->scene;
    bool stated = s->lagrangian != QDOT_NIL;
    bool right =
        !stated || s->forces.n + s->torques.n + s->dampers.n + s->dissipations.n > 0;
    qdot_text title = {0};

    qdot_text_format(&title, "Lagrange's equations: d/dt d%c/dq' - d%c/dq = %s%s",
                     stated ? 'L' : 'T', stated ? 'L' : 'T', right ? "Q" : "",
                     s->constraints.n == 0 ? right ? "" : "0"
                     : right               ? reaction(s)
                                           : reaction(s) + 3);
    QDOT_TRY(qdot_text_status(&title));
    heading(d, qdot_text_str(&title));
    qdot_text_clear(&title);
    for (size_t i = 0; i < s->coordinates.n; i++)
        QDOT_TRY(relation(d, NULL, qdot_mech_equation(s, s->coordinates.at[i])));
    if (s->constraints.n > 0)
        qdot_text_format(&d->text,
                         "    with the constraints %zu equations for %zu coordinate%s and "
                         "%zu multiplier%s\n",
                         s->coordinates.n + s->constraints.n, s->coordinates.n,
                         s->coordinates.n == 1 ? "" : "s", s->constraints.n,
                         s->constraints.n == 1 ? "" : "s");
    return QDOT_OK;
}

/* What is constant along the motion because L does not hold the coordinate. */
static qdot_status
conserved_momenta(derivation *d)
{
    qdot_pool *pool = d->session->pool;
    qdot_cyclic *list;
    size_t n, kept = 0;
    qdot_status status;

    QDOT_TRY(qdot_mech_cyclic(d->session->scene, &list, &n));
    for (size_t i = 0; i < n; i++)
        if (list[i].rate == QDOT_NIL)
            list[kept++] = list[i];
    if (kept > 0)
        heading(d, "Cyclic coordinates: dL/dq = 0, p is conserved");
    status = QDOT_OK;
    for (size_t i = 0; i < kept && status == QDOT_OK; i++) {
        const char *name = qdot_expr_symbol(pool, list[i].coordinate)->name;

        status = named(d, "p[", name, "]", list[i].momentum);
    }
    qdot_free(list);
    return status;
}

qdot_status
qdot_derive_all(qdot_cursor *c)
{
    derivation d = {.session = c->session};
    qdot_status status = qdot_cursor_expect_end(c);

    if (status == QDOT_OK && c->session->scene->coordinates.n == 0) {
        (void)qdot_fail(QDOT_EINVAL,
                        "there is nothing to derive: no coordinate is declared");
        status = qdot_hint("coord theta");
    }
    if (status == QDOT_OK)
        status = assumptions(&d);
    if (status == QDOT_OK && c->session->scene->lagrangian == QDOT_NIL)
        status = kinematics(&d);
    if (status == QDOT_OK)
        status = energies(&d);
    if (status == QDOT_OK)
        status = left_sides(&d);
    if (status == QDOT_OK)
        status = right_sides(&d);
    if (status == QDOT_OK)
        status = equations(&d);
    if (status == QDOT_OK)
        status = conserved_momenta(&d);
    return qdot_answer_written(c->session, "derive", status, &d.text);
}
