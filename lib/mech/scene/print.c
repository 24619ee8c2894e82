/* print.c -- prints a scene as the statements that declare it. */
#include <stdlib.h>
#include <string.h>

#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "mech/scene/access.h"
#include "mech/scene/body-joint.h"
#include "mech/scene/scene.h"

static qdot_status
print_expression(const qdot_scene *s, qdot_expr e, qdot_text *out)
{
    return qdot_print(s->pool, e, QDOT_PLAIN, out);
}

qdot_status
qdot_scene_print_domain(const qdot_scene *s, qdot_expr symbol, qdot_text *out)
{
    const qdot_symbol x = *qdot_expr_symbol(s->pool, symbol);

    if (x.lo != QDOT_NIL && x.hi != QDOT_NIL) {
        QDOT_TRY(print_expression(s, x.lo, out));
        qdot_text_add(out, x.lo_open ? " < " : " <= ");
    }
    qdot_text_add(out, x.name);
    if (x.hi != QDOT_NIL) {
        qdot_text_add(out, x.hi_open ? " < " : " <= ");
        QDOT_TRY(print_expression(s, x.hi, out));
    } else if (x.lo != QDOT_NIL) {
        qdot_text_add(out, x.lo_open ? " > " : " >= ");
        QDOT_TRY(print_expression(s, x.lo, out));
    }
    return QDOT_OK;
}

/* Print an option with its value, such as " mass M" or " at R". */
static qdot_status
print_option(const qdot_scene *s, const char *word, qdot_expr e, qdot_text *out)
{
    qdot_text_format(out, " %s ", word);
    return print_expression(s, e, out);
}

static qdot_status
print_inertia(const qdot_scene *s, qdot_expr I, qdot_text *out)
{
    qdot_pool *pool = s->pool;
    bool diagonal = qdot_expr_kind(pool, I) == QDOT_MAT;

    for (uint32_t k = 0; diagonal && k < 9; k++)
        diagonal = k % 4 == 0 || qdot_expr_arg(pool, I, k) == QDOT_ZERO;
    if (!diagonal)
        return print_option(s, "inertia", I, out);
    qdot_text_add(out, " inertia (");
    for (uint32_t k = 0; k < 3; k++) {
        qdot_text_add(out, k ? ", " : "");
        QDOT_TRY(print_expression(s, qdot_expr_arg(pool, I, 4 * k), out));
    }
    qdot_text_char(out, ')');
    return QDOT_OK;
}

static qdot_status
print_body(const qdot_scene *s, const qdot_body *b, qdot_text *out)
{
    qdot_text_format(out, "body %s", b->name ? b->name : "");
    QDOT_TRY(print_option(s, "mass", b->mass, out));
    QDOT_TRY(print_inertia(s, b->inertia, out));
    QDOT_TRY(print_option(s, "at", b->position, out));
    if (b->angle != QDOT_NIL)
        QDOT_TRY(print_option(s, "angle", b->angle, out));
    else
        QDOT_TRY(print_option(s, "rotation", b->rotation, out));
    qdot_text_char(out, '\n');
    return QDOT_OK;
}

static qdot_status
print_spring_or_damper(const qdot_scene *s, const qdot_link *link, bool damper, qdot_text *out)
{
    qdot_text_format(out, "%s%s%s between", damper ? "damper" : "spring",
                     link->name ? " " : "", link->name ? link->name : "");
    for (int k = 0; k < 2; k++) {
        qdot_text_add(out, k ? ", " : " ");
        if (link->end[k])
            qdot_text_add(out, link->end[k]);
        else
            QDOT_TRY(print_expression(s, link->at[k], out));
    }
    QDOT_TRY(print_option(s, damper ? "coefficient" : "stiffness", link->stiffness, out));
    if (!damper && link->rest != QDOT_ZERO)
        QDOT_TRY(print_option(s, "rest", link->rest, out));
    qdot_text_char(out, '\n');
    return QDOT_OK;
}

static qdot_status
print_force(const qdot_scene *s, const qdot_force *f, qdot_text *out)
{
    qdot_text_add(out, "force ");
    if (f->name)
        qdot_text_format(out, "%s: ", f->name);
    QDOT_TRY(print_expression(s, f->force, out));
    if (f->on)
        qdot_text_format(out, " on %s", f->on);
    if (f->material)
        QDOT_TRY(print_option(s, "at material", f->point, out));
    else if (!f->on)
        QDOT_TRY(print_option(s, "at", f->point, out));
    qdot_text_char(out, '\n');
    return QDOT_OK;
}

static qdot_status
print_torque(const qdot_scene *s, const qdot_torque *t, qdot_text *out)
{
    qdot_text_add(out, t->force ? "force " : "torque ");
    if (t->name)
        qdot_text_format(out, "%s: ", t->name);
    QDOT_TRY(print_expression(s, t->torque, out));
    qdot_text_format(out, " on %s\n",
                     t->coordinate != QDOT_NIL
                         ? qdot_expr_symbol(s->pool, t->coordinate)->name
                         : s->bodies.at[t->body].name);
    return QDOT_OK;
}

/* Components of a vector constraint stand together; the place of one that was left out,
 * as it holds identically, is 0 = 0. */
static int64_t
constraint_component_number(const qdot_constraint *c)
{
    const char *comma = strchr(c->name, ',');

    return comma ? strtoll(comma + 1, NULL, 10) : 0;
}

static bool
together(const qdot_constraint *a, const qdot_constraint *b)
{
    size_t stem = strcspn(a->name, ",");

    return constraint_component_number(a) && constraint_component_number(b) > constraint_component_number(a) &&
           strcspn(b->name, ",") == stem && strncmp(a->name, b->name, stem) == 0;
}

static qdot_status
print_constraint_side(const qdot_scene *s, size_t from, size_t to, bool right, qdot_text *out)
{
    const qdot_constraint *c = s->constraints.at;
    int64_t place = 1, last = constraint_component_number(&c[to - 1]);

    if (last == 0)
        return print_expression(s, right ? c[from].right : c[from].left, out);
    if (last < 2)
        last = 2; /* print at least two components: further ones hold identically and were left out */
    qdot_text_char(out, '(');
    for (size_t i = from; place <= last; place++) {
        qdot_text_add(out, place > 1 ? ", " : "");
        if (i < to && constraint_component_number(&c[i]) == place) {
            QDOT_TRY(print_expression(s, right ? c[i].right : c[i].left, out));
            i++;
        } else {
            qdot_text_char(out, '0');
        }
    }
    qdot_text_char(out, ')');
    return QDOT_OK;
}

static qdot_status
print_constraints(const qdot_scene *s, qdot_text *out)
{
    const qdot_constraint *c = s->constraints.at;
    const qdot_body_joint *joint;

    for (size_t i = 0, j; i < s->constraints.n; i = j) {
        for (j = i + 1; j < s->constraints.n && together(&c[j - 1], &c[j]); j++)
            ;
        if ((joint = qdot_scene_find_joint(s, c[i].label)) != NULL) {
            QDOT_TRY(qdot_body_joint_print(s, joint, out));
            continue;
        }
        qdot_text_add(out, "constraint ");
        if (c[i].label)
            qdot_text_format(out, "%s: ", c[i].label);
        QDOT_TRY(print_constraint_side(s, i, j, false, out));
        qdot_text_add(out, " = ");
        QDOT_TRY(print_constraint_side(s, i, j, true, out));
        qdot_text_char(out, '\n');
    }
    return QDOT_OK;
}

static qdot_status
print_statement(const qdot_scene *s, const char *word, qdot_expr e, qdot_text *out)
{
    qdot_text_format(out, "%s ", word);
    QDOT_TRY(print_expression(s, e, out));
    qdot_text_char(out, '\n');
    return QDOT_OK;
}

static qdot_status
print_term(const qdot_scene *s, const char *word, const qdot_term *term, qdot_text *out)
{
    qdot_text_format(out, "%s ", word);
    if (term->name)
        qdot_text_format(out, "%s: ", term->name);
    QDOT_TRY(print_expression(s, term->e, out));
    qdot_text_char(out, '\n');
    return QDOT_OK;
}

qdot_status
qdot_scene_print_at(const qdot_scene *s, qdot_scene_kind kind, size_t k, qdot_text *out)
{
    switch (kind) {
    case QDOT_GRAVITY: return print_term(s, "gravity", &s->gravities.at[k], out);
    case QDOT_POTENTIAL: return print_term(s, "potential", &s->potentials.at[k], out);
    case QDOT_SPRING: return print_spring_or_damper(s, &s->springs.at[k], false, out);
    case QDOT_DAMPER: return print_spring_or_damper(s, &s->dampers.at[k], true, out);
    case QDOT_DISSIPATION: return print_term(s, "dissipation", &s->dissipations.at[k], out);
    case QDOT_FORCE:
        if (k < s->forces.n)
            return print_force(s, &s->forces.at[k], out);
        /* fallthrough */
    case QDOT_TORQUE:
        return print_torque(s, &s->torques.at[qdot_scene_torque_at(s, kind, k)], out);
    }
    return QDOT_OK;
}

/* Whether item k of that kind holds the multiplier of a constraint, which is then declared before it. */
static bool
holds_multiplier(const qdot_scene *s, qdot_scene_kind kind, size_t k)
{
    qdot_expr e = QDOT_NIL;

    if (kind == QDOT_DISSIPATION)
        e = s->dissipations.at[k].e;
    else if (kind == QDOT_FORCE && k < s->forces.n)
        e = s->forces.at[k].force;
    else if (kind == QDOT_FORCE || kind == QDOT_TORQUE)
        e = s->torques.at[qdot_scene_torque_at(s, kind, k)].torque;
    return e != QDOT_NIL && (qdot_mech_holds(s, e) & QDOT_HAS_MULTIPLIER) != 0;
}

/* Print the items whose kind lies between the two given kinds, in the order of the enum of kinds: those that hold
 * multipliers, or those that do not. */
static qdot_status
print_kinds(const qdot_scene *s, qdot_scene_kind from, qdot_scene_kind to, bool multipliers, qdot_text *out)
{
    for (qdot_scene_kind kind = from; kind <= to; kind++)
        for (size_t k = 0; k < qdot_scene_count(s, kind); k++)
            if (holds_multiplier(s, kind, k) == multipliers)
                QDOT_TRY(qdot_scene_print_at(s, kind, k, out));
    return QDOT_OK;
}

static qdot_status
print_assumption(const qdot_scene *s, const qdot_assumption *said, qdot_text *out)
{
    bool strict = qdot_expr_node(s->pool, said->relation)->op == QDOT_LT;

    if (!said->turned)
        return print_statement(s, "assume", said->relation, out);
    qdot_text_add(out, "assume ");
    QDOT_TRY(print_expression(s, qdot_expr_arg(s->pool, said->relation, 1), out));
    qdot_text_add(out, strict ? " > " : " >= ");
    QDOT_TRY(print_expression(s, qdot_expr_arg(s->pool, said->relation, 0), out));
    qdot_text_char(out, '\n');
    return QDOT_OK;
}

/* Print `WORD A, B`; nothing for an empty list. */
static qdot_status
print_list(const qdot_scene *s, const char *word, size_t n, const qdot_expr *e, qdot_text *out)
{
    for (size_t i = 0; i < n; i++) {
        qdot_text_add(out, i == 0 ? word : ", ");
        QDOT_TRY(print_expression(s, e[i], out));
    }
    if (n > 0)
        qdot_text_char(out, '\n');
    return QDOT_OK;
}

qdot_status
qdot_scene_print(const qdot_scene *s, qdot_text *out)
{
    for (size_t i = 0; i < s->coordinates.n; i++) {
        if (qdot_scene_state_of(s, s->coordinates.at[i]) || qdot_higher_find(s, s->coordinates.at[i]))
            continue;
        qdot_text_add(out, "coord ");
        QDOT_TRY(qdot_scene_print_domain(s, s->coordinates.at[i], out));
        qdot_text_char(out, '\n');
    }
    return qdot_scene_print_things(s, out);
}

qdot_status
qdot_scene_print_state(const qdot_scene *s, qdot_expr z, qdot_text *out)
{
    const qdot_state *state = qdot_scene_state_of(s, z);

    qdot_text_format(out, "state %s'", qdot_expr_symbol(s->pool, z)->name);
    if (state->rate == QDOT_NIL)
        return QDOT_OK;
    qdot_text_add(out, " = ");
    return print_expression(s, state->rate, out);
}

/* Print the states in one statement, whose right sides may hold one another. */
static qdot_status
print_states(const qdot_scene *s, qdot_text *out)
{
    size_t printed = 0;

    for (size_t k = 0; k < s->states.n; k++) {
        if (s->states.at[k].rate == QDOT_NIL)
            continue;
        qdot_text_format(out, "%s%s' = ", printed++ ? ", " : "state ",
                         qdot_expr_symbol(s->pool, s->states.at[k].z)->name);
        QDOT_TRY(print_expression(s, s->states.at[k].rate, out));
    }
    if (printed)
        qdot_text_char(out, '\n');
    return QDOT_OK;
}

qdot_status
qdot_scene_print_things(const qdot_scene *s, qdot_text *out)
{
    QDOT_TRY(print_list(s, "input ", s->inputs.n, s->inputs.at, out));
    QDOT_TRY(print_states(s, out));
    for (size_t i = 0; i < s->assumed.n; i++)
        QDOT_TRY(print_assumption(s, &s->assumed.at[i], out));
    for (size_t i = 0; i < s->particles.n; i++) {
        qdot_text_format(out, "particle %s",
                         s->particles.at[i].name ? s->particles.at[i].name : "");
        QDOT_TRY(print_option(s, "mass", s->particles.at[i].mass, out));
        QDOT_TRY(print_option(s, "at", s->particles.at[i].position, out));
        qdot_text_char(out, '\n');
    }
    for (size_t i = 0; i < s->bodies.n; i++)
        QDOT_TRY(print_body(s, &s->bodies.at[i], out));
    QDOT_TRY(print_kinds(s, QDOT_GRAVITY, QDOT_DISSIPATION, false, out));
    if (s->hamiltonian != QDOT_NIL)
        QDOT_TRY(print_statement(s, "hamiltonian", s->hamiltonian, out));
    else if (s->higher_lagrangian != QDOT_NIL)
        QDOT_TRY(print_statement(s, "lagrangian", s->higher_lagrangian, out));
    else if (s->lagrangian != QDOT_NIL)
        QDOT_TRY(print_statement(s, "lagrangian", s->lagrangian, out));
    QDOT_TRY(print_kinds(s, QDOT_FORCE, QDOT_TORQUE, false, out));
    QDOT_TRY(print_constraints(s, out));
    QDOT_TRY(print_kinds(s, QDOT_DISSIPATION, QDOT_TORQUE, true, out));
    QDOT_TRY(print_list(s, "output ", s->outputs.n, s->outputs.at, out));
    for (size_t i = 0; i < s->events.n; i++)
        QDOT_TRY(qdot_event_print(s, &s->events.at[i], out));
    return qdot_text_status(out);
}
