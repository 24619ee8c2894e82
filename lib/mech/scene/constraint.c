/* constraint.c -- constraints f = left - right = 0: their kind, derivatives and reactions. */

#include "mech/scene/constraint.h"

#include <stdio.h>
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "mech/scene/access.h"
#include "normal/prove/decide.h"

/* Find the highest derivative of a coordinate in f; -1 if f has no coordinate. */
static qdot_status
find_highest_derivative(qdot_pool *pool, qdot_expr f, int *order)
{
    qdot_expr atoms = qdot_expr_atoms(pool, f, false);

    *order = -1;
    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; i < qdot_expr_count(pool, atoms); i++) {
        const qdot_symbol *x = qdot_expr_symbol(pool, qdot_expr_arg(pool, atoms, i));

        if (x && x->class == QDOT_COORD && (int)x->order > *order)
            *order = (int)x->order;
    }
    return QDOT_OK;
}

/* The number of the next constraint without label: 1 + those declared, counted by
 * statement. */
static size_t
next_constraint_number(const qdot_scene *s)
{
    size_t statements = 0, highest_number = 0;

    for (size_t i = 0; i < s->constraints.n; i++) {
        const qdot_constraint *c = &s->constraints.at[i];
        const char *comma = strchr(c->name, ',');
        size_t stem = comma ? (size_t)(comma - c->name) : strlen(c->name);
        const char *before = i ? c[-1].name : "";

        statements += strncmp(before, c->name, stem) != 0 ||
                      (before[stem] != ',' && before[stem] != '\0');
        if (!c->label) {
            size_t number = 0;

            for (size_t k = 0; k < stem; k++)
                number = 10 * number + (size_t)(c->name[k] - '0');
            if (number > highest_number)
                highest_number = number;
        }
    }
    return (statements > highest_number ? statements : highest_number) + 1;
}

/* Refuse f if an earlier constraint is g = +-f + a non-zero number: no state satisfies both. */
static qdot_status
refuse_contradiction(const qdot_scene *s, const char *name, qdot_expr f)
{
    for (size_t i = 0; i < s->constraints.n; i++) {
        qdot_expr g = s->constraints.at[i].f, d = qdot_sub(s->pool, f, g);

        if (d != QDOT_NIL && qdot_expr_kind(s->pool, d) == QDOT_SUM)
            d = qdot_add(s->pool, f, g);
        if (d == QDOT_NIL || d == QDOT_ZERO || qdot_expr_kind(s->pool, d) != QDOT_NUM)
            continue;
        return qdot_fail(QDOT_EINVAL, "constraint %s contradicts constraint %s", name,
                         s->constraints.at[i].name);
    }
    return qdot_pool_check(s->pool);
}

static qdot_status
fail_without_coordinates(void)
{
    qdot_fail(QDOT_EINVAL, "a constraint without coordinates");
    return qdot_hint("`assume` states a relation between parameters, `set` gives values");
}

static qdot_status
is_linear_in_velocities(qdot_scene *s, qdot_expr f, bool *linear)
{
    *linear = true;
    for (size_t i = 0; i < s->coordinates.n && *linear; i++) {
        qdot_expr slope = qdot_diff(s->pool, f, qdot_mech_jet(s, i, 2));

        QDOT_TRY(qdot_pool_check(s->pool));
        *linear = !(qdot_mech_holds(s, slope) & QDOT_HAS_ACCELERATION);
    }
    return QDOT_OK;
}

/* Check that a constraint on accelerations is linear in these, or becomes so by simplification. */
static qdot_status
make_linear_in_accelerations(qdot_scene *s, const char *name, qdot_expr *f)
{
    bool linear;

    QDOT_TRY(is_linear_in_velocities(s, *f, &linear));
    if (linear)
        return QDOT_OK;
    *f = qdot_mech_tidy(s, *f);
    QDOT_TRY(qdot_pool_check(s->pool));
    QDOT_TRY(is_linear_in_velocities(s, *f, &linear));
    if (linear)
        return QDOT_OK;
    qdot_fail(QDOT_EINVAL, "constraint %s is not linear in the accelerations", name);
    return qdot_hint("solve it for one of them: x'' = ...");
}

static qdot_status
add_constraint_component(qdot_scene *s, const char *label, const char *stem, uint32_t component,
                         qdot_expr left, qdot_expr right)
{
    qdot_pool *pool = s->pool;
    qdot_facts facts = qdot_scene_facts(s);
    qdot_text name = {0}, symbol = {0};
    qdot_constraint c = {.left = left, .right = right};
    qdot_status status;
    int order;
    bool holds;

    c.f = qdot_sub(pool, left, right);
    QDOT_TRY(qdot_pool_check(pool));
    qdot_text_add(&name, stem);
    if (component)
        qdot_text_format(&name, ", %u", component);
    qdot_text_format(&symbol, "lambda[%s]", qdot_text_str(&name));
    status = qdot_text_status(&symbol);
    holds = c.f == QDOT_ZERO || qdot_is_zero(pool, c.f, &facts);
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    if (status == QDOT_OK && holds) {
        status = qdot_scene_drop(s, qdot_text_str(&name), NULL);
    } else if (status == QDOT_OK) {
        status = find_highest_derivative(pool, c.f, &order);
        if (status == QDOT_OK && order < 0)
            status = fail_without_coordinates();
        else if (status == QDOT_OK && order > 2)
            status = qdot_fail(QDOT_EINVAL, "a constraint on a third derivative");
        else if (status == QDOT_OK)
            status = refuse_contradiction(s, qdot_text_str(&name), c.f);
        if (status == QDOT_OK && order == 2)
            status = make_linear_in_accelerations(s, qdot_text_str(&name), &c.f);
        if (status == QDOT_OK) {
            c.kind = order == 0   ? QDOT_HOLONOMIC
                     : order == 1 ? QDOT_VELOCITY
                                  : QDOT_ACCELERATION;
            c.multiplier = qdot_symbol_get(pool, QDOT_MULTIPLIER, qdot_text_str(&symbol));
            status = qdot_pool_check(pool);
            if (status == QDOT_OK)
                status = qdot_scene_copy_text(s, qdot_text_str(&name), &c.name);
            if (status == QDOT_OK)
                status = qdot_scene_copy_text(s, label, &c.label);
            if (status == QDOT_OK)
                status = qdot_vec_push(&s->constraints, c);
        }
    }
    qdot_text_clear(&name);
    qdot_text_clear(&symbol);
    return status;
}

qdot_status
qdot_scene_constraint(qdot_scene *s, const char *label, qdot_expr left, qdot_expr right)
{
    qdot_pool *pool = s->pool;
    uint32_t n = qdot_mech_dimension(pool, left),
             other = qdot_mech_dimension(pool, right);
    size_t before = s->constraints.n;
    char number[24];
    const char *stem = label;
    qdot_status status = QDOT_OK;

    qdot_scene_forget_dropped(s);
    QDOT_TRY(qdot_pool_check(pool));
    if (n == 0 || other == 0)
        return qdot_fail(QDOT_ETYPE,
                         "a constraint is an equation between numbers or vectors");
    if (n != other)
        return qdot_fail(QDOT_ETYPE, "the sides have %u and %u components", n, other);
    if ((qdot_mech_holds(s, left) | qdot_mech_holds(s, right)) &
        (QDOT_HAS_MOMENTUM | QDOT_HAS_MULTIPLIER | QDOT_HAS_DIFFERENTIAL |
         QDOT_HAS_DELTA))
        return qdot_fail(QDOT_EINVAL,
                         "a constraint holds coordinates, their derivatives, t "
                         "and parameters only");
    if (!((qdot_mech_holds(s, left) | qdot_mech_holds(s, right)) &
          (QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION)))
        return fail_without_coordinates();
    QDOT_TRY(qdot_scene_refuse_delays(s, left, "a constraint"));
    QDOT_TRY(qdot_scene_refuse_delays(s, right, "a constraint"));
    QDOT_TRY(qdot_scene_refuse_states(s, left, "a constraint", 0));
    QDOT_TRY(qdot_scene_refuse_states(s, right, "a constraint", 0));
    QDOT_TRY(qdot_scene_need_new_label(s, label));
    if (!label) {
        snprintf(number, sizeof number, "%zu", next_constraint_number(s));
        stem = number;
    }
    for (uint32_t i = 0; i < n && status == QDOT_OK; i++)
        status = add_constraint_component(s, label, stem, n > 1 ? i + 1 : 0,
                                          qdot_mech_component(pool, left, i),
                                          qdot_mech_component(pool, right, i));
    if (status != QDOT_OK) {
        s->constraints.n = before;
        qdot_scene_forget_dropped(s);
        return status;
    }
    qdot_scene_changed(s);
    return QDOT_OK;
}

qdot_expr
qdot_mech_constraint_derivative(qdot_scene *s, size_t i, unsigned order)
{
    static const unsigned most[] = {
        [QDOT_HOLONOMIC] = 2, [QDOT_VELOCITY] = 1, [QDOT_ACCELERATION] = 0};
    qdot_expr f;

    if (i >= s->constraints.n)
        return qdot_mech_fail(s, QDOT_EINVAL, "there is no constraint %zu", i + 1);
    if (order > most[s->constraints.at[i].kind])
        return qdot_mech_fail(s, QDOT_EINVAL, "constraint %s holds derivatives already",
                              s->constraints.at[i].name);
    f = s->constraints.at[i].f;
    for (unsigned k = 0; k < order; k++)
        f = qdot_ddt(s->pool, f);
    return qdot_mech_tidy(s, f);
}

qdot_expr
qdot_constraint_slope(qdot_scene *s, size_t constraint, size_t i)
{
    const qdot_constraint *c = &s->constraints.at[constraint];

    return qdot_diff(s->pool, c->f, qdot_mech_jet(s, i, (uint32_t)c->kind));
}

qdot_expr
qdot_constraint_reaction(qdot_scene *s, size_t i)
{
    qdot_pool *pool = s->pool;
    qdot_expr sum = QDOT_ZERO;

    for (size_t k = 0; k < s->constraints.n; k++) {
        qdot_expr slope = qdot_constraint_slope(s, k, i);

        if (slope == QDOT_ZERO)
            continue;
        slope = qdot_mech_tidy(s, slope);
        sum = qdot_add(pool, sum, qdot_mul(pool, s->constraints.at[k].multiplier, slope));
    }
    return sum;
}

qdot_status
qdot_constraint_facts(qdot_scene *s, qdot_expr **relations, qdot_facts *facts)
{
    qdot_facts known = qdot_scene_facts(s);
    size_t n = 0;
    qdot_expr *r = qdot_calloc(known.n_relations + 3 * s->constraints.n + 1, sizeof *r);

    *relations = NULL;
    if (!r)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < known.n_relations; i++)
        r[n++] = known.relations[i];
    for (size_t i = 0; i < s->constraints.n; i++) {
        qdot_expr f = s->constraints.at[i].f;

        r[n++] = f;
        for (int k = s->constraints.at[i].kind; k < QDOT_VELOCITY; k++)
            r[n++] = f = qdot_ddt(s->pool, f);
    }
    *facts = known;
    facts->n_relations = n;
    facts->relations = *relations = r;
    return qdot_pool_check(s->pool);
}
