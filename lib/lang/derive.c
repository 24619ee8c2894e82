/* derive.c -- the whole derivation, from r(q) to the equations, as a textbook would. */
#include "lang/statement.h"

#include "expr/calculus.h"
#include "lang/answer.h"
#include "mech/quantity.h"
#include "normal/simplify.h"

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

/* `    name = value`, name being printed as it stands. */
static qdot_status
line(derivation *d, const char *name, const char *of, qdot_expr value)
{
    QDOT_TRY(qdot_pool_check(d->session->pool));
    qdot_text_format(&d->text, "    %s", name);
    if (of != NULL) {
        qdot_text_char(&d->text, '[');
        qdot_print_name(of, d->session->style, &d->text);
        qdot_text_char(&d->text, ']');
    }
    qdot_text_add(&d->text, " = ");
    QDOT_TRY(qdot_print(d->session->pool, value, d->session->style, &d->text));
    qdot_text_char(&d->text, '\n');
    return QDOT_OK;
}

static const char *
name_of(const derivation *d, size_t i)
{
    return qdot_expr_symbol(d->session->pool, d->session->scene->coordinates.at[i])->name;
}

/* r and v = sum dr/dq q' + dr/dt of everything that has a mass. */
static qdot_status
kinematics(derivation *d)
{
    qdot_scene *s = d->session->scene;
    qdot_facts facts = qdot_scene_facts(s);

    heading(d, "Positions: r(q, t)");
    for (size_t i = 0; i < s->particles.n; i++)
        QDOT_TRY(line(d, "r", s->particles.at[i].name, s->particles.at[i].position));
    for (size_t i = 0; i < s->bodies.n; i++)
        QDOT_TRY(line(d, "r", s->bodies.at[i].name, s->bodies.at[i].position));
    heading(d, "Velocities: v = sum dr/dq q' + dr/dt");
    for (size_t i = 0; i < s->particles.n + s->bodies.n; i++) {
        bool particle = i < s->particles.n;
        const char *name =
            particle ? s->particles.at[i].name : s->bodies.at[i - s->particles.n].name;
        qdot_expr r = particle ? s->particles.at[i].position
                               : s->bodies.at[i - s->particles.n].position;
        qdot_expr v = qdot_simplify(s->pool, qdot_ddt(s->pool, r), &facts);

        QDOT_TRY(line(d, "v", name, v));
        if (!particle)
            QDOT_TRY(line(d, "spin", name, qdot_scene_spin(s, name)));
    }
    return QDOT_OK;
}

static qdot_status
energies(derivation *d)
{
    qdot_scene *s = d->session->scene;

    if (s->lagrangian == QDOT_NIL) {
        heading(d, "Kinetic energy: T = 1/2 sum m v.v = 1/2 q'.M q'");
        QDOT_TRY(line(d, "M", NULL, qdot_mech_mass_matrix(s)));
        QDOT_TRY(line(d, "T", NULL, qdot_mech_kinetic(s)));
        heading(d, "Potential energy");
        QDOT_TRY(line(d, "V", NULL, qdot_mech_potential(s)));
    }
    heading(d, s->lagrangian == QDOT_NIL ? "Lagrangian: L = T - V"
                                         : "Lagrangian, as stated");
    return line(d, "L", NULL, qdot_mech_lagrangian(s));
}

static qdot_status
equations(derivation *d)
{
    qdot_scene *s = d->session->scene;

    heading(d, "Momenta: p = dL/dq'");
    for (size_t i = 0; i < s->coordinates.n; i++)
        QDOT_TRY(
            line(d, "p", name_of(d, i), qdot_mech_momentum(s, s->coordinates.at[i])));
    heading(d, "Generalized forces: Q = sum F.dr/dq, with -dV/dq");
    for (size_t i = 0; i < s->coordinates.n; i++)
        QDOT_TRY(line(d, "Q", name_of(d, i), qdot_mech_force(s, s->coordinates.at[i])));
    if (s->constraints.n > 0) {
        heading(d, "Constraints");
        for (size_t i = 0; i < s->constraints.n; i++) {
            qdot_text_add(&d->text, "    ");
            QDOT_TRY(
                qdot_print(s->pool, s->constraints.at[i].f, d->session->style, &d->text));
            qdot_text_add(&d->text, " = 0\n");
        }
    }
    heading(d, s->constraints.n > 0
                   ? "Lagrange's equations: d/dt dT/dq' - dT/dq = Q + sum lambda df/dq"
                   : "Lagrange's equations: d/dt dT/dq' - dT/dq = Q");
    for (size_t i = 0; i < s->coordinates.n; i++) {
        qdot_expr equation = qdot_mech_equation(s, s->coordinates.at[i]);

        QDOT_TRY(qdot_pool_check(s->pool));
        qdot_text_add(&d->text, "    ");
        QDOT_TRY(qdot_print(s->pool, equation, d->session->style, &d->text));
        qdot_text_char(&d->text, '\n');
    }
    return QDOT_OK;
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
    if (status == QDOT_OK && c->session->scene->lagrangian == QDOT_NIL)
        status = kinematics(&d);
    if (status == QDOT_OK)
        status = energies(&d);
    if (status == QDOT_OK)
        status = equations(&d);
    if (status == QDOT_OK)
        status = qdot_text_status(&d.text);
    if (status == QDOT_OK)
        status = qdot_answer_text(c->session, "derive", qdot_text_str(&d.text));
    qdot_text_clear(&d.text);
    return status;
}
