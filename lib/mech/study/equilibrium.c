/* equilibrium.c -- all equilibria of a scene: exactly, otherwise numerically; with their stability. */
#include "mech/study/equilibrium.h"

#include <math.h>

#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/dynamics/generic.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/study/equilibrium-search.h"
#include "mech/linear/linear-motion.h"
#include "mech/study/stability.h"
#include "normal/solve/conditions.h"
#include "normal/solve/solve.h"

/* What exact solution may take before it gives way to numbers: scenes of books take some
 * units, a chain of four links between two supports would take minutes. */
enum { WORK = 1500 };

static bool
contains_time(const qdot_rest *r, qdot_expr e)
{
    return (qdot_mech_holds(r->s, e) & QDOT_HAS_TIME) != 0;
}

static qdot_status
find_unknowns(qdot_rest *r)
{
    qdot_scene *s = r->s;

    for (size_t i = 0; i < s->coordinates.n; i++)
        if (qdot_expr_contains(r->pool, r->system.equations, s->coordinates.at[i]))
            QDOT_TRY(qdot_vec_push(&r->system.unknowns, s->coordinates.at[i]));
    r->system.places = r->system.unknowns.n;
    for (size_t k = 0; k < s->constraints.n; k++)
        if (qdot_expr_contains(r->pool, r->system.equations, s->constraints.at[k].multiplier))
            QDOT_TRY(qdot_vec_push(&r->system.unknowns, s->constraints.at[k].multiplier));
    r->searched = r->system.unknowns.n;
    for (uint32_t k = 0; r->friction != QDOT_NIL && k < qdot_expr_count(r->pool, r->friction); k++)
        QDOT_TRY(qdot_vec_push(&r->system.unknowns, qdot_expr_arg(r->pool, r->friction, k)));
    return QDOT_OK;
}

static qdot_status
begin_first_branch(qdot_rest *r, qdot_expr equations)
{
    qdot_expr none = qdot_list(r->pool, 0, NULL);
    qdot_simultaneous_branch first = {
        .equations = equations, .known = none, .conditions = r->sliding, .whole = equations};

    QDOT_TRY(qdot_pool_check(r->pool));
    QDOT_TRY(qdot_rest_corners(r, equations));
    return qdot_vec_push(&r->system.todo, first);
}

/* --- equilibria at all times --------------------------------------------------------------- */

/* Those equations of an equilibrium that give coordinates, without those that give multipliers. */
static qdot_expr
coordinate_equations(const qdot_rest *r, qdot_expr equations)
{
    qdot_expr list = qdot_list(r->pool, 0, NULL);

    for (uint32_t k = 0; k < qdot_expr_count(r->pool, equations); k++) {
        qdot_expr one = qdot_expr_arg(r->pool, equations, k);

        if (qdot_expr_is_class(r->pool, qdot_expr_arg(r->pool, one, 0), QDOT_COORD))
            list = qdot_list_appended(r->pool, list, 1, &one);
    }
    return list;
}

/* Of the places found at one time those at which the equations hold for all, multipliers as they
 * are then. Where some hold for a part of a family only, that part is not looked for. */
static qdot_status
keep_equilibria_for_all_times(qdot_rest *r)
{
    size_t n = r->found.n;
    qdot_equilibrium *before = r->found.at;
    qdot_status status = QDOT_OK;

    r->found.at = NULL;
    r->found.n = r->found.capacity = 0;
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        qdot_simultaneous_branch b = {.known = coordinate_equations(r, before[i].equations),
                              .conditions = before[i].exists};
        size_t had = r->found.n, kept = had;

        b.equations = qdot_simultaneous_put(r->pool, r->system.equations, b.known);
        status = qdot_pool_check(r->pool);
        if (status == QDOT_EDOMAIN)
            status = QDOT_OK;
        else if (status == QDOT_OK)
            status = qdot_vec_push(&r->system.todo, b);
        if (status == QDOT_OK)
            status = qdot_rest_solve(r);
        for (size_t k = had; k < r->found.n; k++)
            if (!contains_time(r, coordinate_equations(r, r->found.at[k].equations)))
                r->found.at[kept++] = r->found.at[k];
        r->found.n = kept;
        if (kept == had && qdot_expr_count(r->pool, b.known) < r->system.places)
            r->system.complete = false;
    }
    qdot_free(before);
    return status;
}

/* --- numerical search ------------------------------------------------------------------------- */

/* The name of a symbol in e that is not an unknown and has no value; NULL: there is none. */
static const char *
symbol_without_value(const qdot_rest *r, qdot_expr e)
{
    qdot_expr atoms = qdot_expr_atoms(r->pool, e, true);

    for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(r->pool, atoms); i++) {
        qdot_expr x = qdot_expr_arg(r->pool, atoms, i);
        bool is_unknown = qdot_expr_is_class(r->pool, x, QDOT_CONST);

        for (size_t k = 0; k < r->searched; k++)
            is_unknown |= r->system.unknowns.at[k] == x;
        if (is_unknown)
            continue;
        return qdot_expr_kind(r->pool, x) == QDOT_SYM
                   ? qdot_expr_symbol(r->pool, x)->name
                   : qdot_ufun_get(r->pool, qdot_expr_node(r->pool, x)->op)->name;
    }
    return NULL;
}

/* Whether u agrees with a known value to within 1e-7, `off` being the difference; an angle up to full turns. */
static bool
value_is_known(const qdot_pool *pool, qdot_expr angles, qdot_expr u, double off)
{
    return fabs(qdot_expr_contains(pool, angles, u) ? remainder(off, 2 * M_PI) : off) < 1e-7;
}

/* Whether the point x [searched] is one of the equilibria known exactly. */
static bool
equilibrium_is_known(const qdot_rest *r, const double *x, qdot_expr angles, qdot_binder bind, void *user)
{
    for (size_t i = 0; i < r->found.n; i++) {
        qdot_expr all = r->found.at[i].equations;
        bool same = !r->found.at[i].numeric;

        for (uint32_t k = 0; same && k < qdot_expr_count(r->pool, all); k++) {
            qdot_expr one = qdot_expr_arg(r->pool, all, k), e;
            double off;

            e = qdot_sub(r->pool, qdot_expr_arg(r->pool, one, 0),
                         qdot_expr_arg(r->pool, one, 1));
            e = e == QDOT_NIL || bind == NULL ? e : bind(user, e);
            same = e != QDOT_NIL &&
                   qdot_generic_evaluate(
                       r->pool, 1, &e,
                       &(qdot_generic_point){r->searched, r->system.unknowns.at, x, 1},
                       &off) == QDOT_OK &&
                   value_is_known(r->pool, angles, qdot_expr_arg(r->pool, one, 0), off);
        }
        if (same)
            return true;
    }
    return false;
}

/* Whether the energy is defined at the point x, the values of the `searched` unknowns. */
static qdot_status
energy_is_defined_at(const qdot_rest *r, const double *x, qdot_expr energy, bool *yes)
{
    double value;

    QDOT_TRY(qdot_generic_evaluate(r->pool, 1, &energy,
                                   &(qdot_generic_point){r->searched, r->system.unknowns.at, x, 1}, &value));
    *yes = !isnan(value);
    return QDOT_OK;
}

/* Those coordinates that are angles in `equations`, a LIST. */
static qdot_expr
angle_coordinates(const qdot_rest *r, qdot_expr equations)
{
    qdot_expr angles = qdot_list(r->pool, 0, NULL);

    for (size_t k = 0; k < r->system.places; k++)
        if (qdot_rest_window(r, k, equations).turn)
            angles = qdot_list_appended(r->pool, angles, 1, &r->system.unknowns.at[k]);
    return angles;
}

static qdot_status
add_numeric_equilibria(qdot_rest *r, const qdot_places *places, qdot_expr angles, qdot_binder bind, void *user)
{
    size_t n = r->searched;
    qdot_expr *list = qdot_malloc((n + 1) * sizeof *list),
              energy = bind == NULL ? r->energy : bind(user, r->energy);
    qdot_status status = list == NULL ? QDOT_ENOMEM : qdot_pool_check(r->pool);

    for (size_t k = 0; k < places->n && status == QDOT_OK; k++) {
        qdot_equilibrium one = {.numeric = true};
        bool defined;

        status = energy_is_defined_at(r, places->at + k * n, energy, &defined);
        if (status != QDOT_OK || !defined)
            continue;
        if (equilibrium_is_known(r, places->at + k * n, angles, bind, user))
            continue;
        for (size_t i = 0; i < n; i++)
            list[i] = qdot_rel(r->pool, QDOT_EQ, r->system.unknowns.at[i],
                               qdot_generic_decimal(r->pool, places->at[k * n + i]));
        one.equations = qdot_list(r->pool, (uint32_t)n, list);
        status = qdot_pool_check(r->pool);
        if (status == QDOT_OK)
            status = qdot_vec_push(&r->found, one);
    }
    qdot_free(list);
    return status;
}

static qdot_status
search_numerically(qdot_rest *r, qdot_binder bind, void *user, qdot_equilibria *out)
{
    qdot_pool *pool = r->pool;
    const size_t n = r->searched;
    qdot_expr bound = bind == NULL ? r->system.equations : bind(user, r->system.equations), *e;
    qdot_places places;
    const char *name;
    qdot_status status;

    QDOT_TRY(qdot_pool_check(pool));
    if (r->friction != QDOT_NIL)
        return qdot_fail(QDOT_EFAILED, "the equilibria cannot be solved for exactly; under dry "
                                       "friction they are regions, which are not searched for in "
                                       "numbers");
    name = symbol_without_value(r, bound);
    for (size_t k = 0; k < r->system.places && name == NULL; k++) /* also parameters in domain bounds */
        for (int which = 0; which < 2 && name == NULL; which++) {
            qdot_expr end = qdot_rest_domain_end(r, k, which);

            name = end == QDOT_NIL ? NULL : symbol_without_value(r, end);
        }
    if (name != NULL) {
        QDOT_TRY(qdot_rest_unsolved(r, &out->unsolved));
        QDOT_TRY(qdot_rest_symmetric(r));
        out->unset = name;
        if (r->found.n > 0)
            return QDOT_OK;
        qdot_fail(QDOT_EUNSET,
                  "the equilibria cannot be solved for exactly; numbers need a "
                  "value of `%.100s`",
                  name);
        return qdot_hint("set %.100s = ...", name);
    }
    if (qdot_expr_count(pool, bound) != n && r->found.n > 0)
        return QDOT_OK; /* keep the equilibria that were found exactly */
    if (qdot_expr_count(pool, bound) != n)
        return qdot_fail(QDOT_EFAILED,
                         "the equilibria cannot be found: %u equations for %zu unknowns",
                         qdot_expr_count(pool, bound), n);
    e = qdot_malloc((n + 1) * sizeof *e);
    if (e == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++)
        e[i] = qdot_expr_arg(pool, bound, (uint32_t)i);
    status = qdot_rest_search(r, e, &places);
    if (status == QDOT_OK) {
        out->starts = places.starts;
        out->reach = places.reach;
        out->unproved = places.unproved;
        status = add_numeric_equilibria(r, &places, angle_coordinates(r, bound), bind, user);
        qdot_places_clear(&places);
    }
    qdot_free(e);
    return status;
}

/* --- all equilibria ---------------------------------------------------------------------- */

static bool
contains_integer(qdot_pool *pool, qdot_expr e)
{
    return qdot_solve_one_member(pool, e) != e;
}

/* Whether the equations are periodic in every coordinate that contains an integer: then all members
 * are equivalent. */
static qdot_status
members_are_equivalent(qdot_rest *r, const qdot_equilibrium *e, bool *yes)
{
    *yes = true;
    for (uint32_t i = 0; i < qdot_expr_count(r->pool, e->equations) && *yes; i++) {
        qdot_expr one = qdot_expr_arg(r->pool, e->equations, i), period;

        if (!contains_integer(r->pool, one))
            continue;
        QDOT_TRY(qdot_simultaneous_period(&r->system, qdot_expr_arg(r->pool, one, 0), &period));
        *yes = period != QDOT_NIL;
    }
    return qdot_pool_check(r->pool);
}

/* One place of a family: the integers that count its members are 0. All members are alike, for a family has the
 * period of the equations of motion. */
static qdot_status
judge_member(qdot_rest *r, qdot_judge *judge, qdot_equilibrium *e)
{
    qdot_pool *pool = r->pool;
    qdot_expr left = QDOT_NIL;
    qdot_equilibrium one = *e;
    bool alike;

    e->stability = QDOT_STABILITY_UNDECIDED;
    e->stable_when = QDOT_NIL;
    if (e->may_jump)
        return QDOT_OK;
    if (qdot_solve_integers(pool, e->equations) == 0)
        return qdot_judge_place(judge, e);
    QDOT_TRY(members_are_equivalent(r, e, &alike));
    if (!alike) { /* keep only a verdict that holds for all integers n */
        QDOT_TRY(qdot_judge_place(judge, e));
        if (e->stability == QDOT_UNSTABLE || (e->stable_when != QDOT_NIL && contains_integer(pool, e->stable_when))) {
            e->stability = QDOT_STABILITY_UNDECIDED;
            e->stable_when = QDOT_NIL;
        }
        return QDOT_OK;
    }
    one.equations = qdot_solve_one_member(pool, e->equations);
    for (uint32_t i = 0; e->exists != QDOT_NIL && i < qdot_expr_count(pool, e->exists); i++)
        if (!contains_integer(pool, qdot_expr_arg(pool, e->exists, i)))
            left = qdot_conditions_and(pool, left, qdot_expr_arg(pool, e->exists, i));
    one.exists = left;
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(qdot_judge_place(judge, &one));
    e->stability = one.stability;
    e->stable_when = one.stable_when;
    return QDOT_OK;
}

/* Stability, wherever what is in the LIST `special` is not 0; `first`: up to the first that is not unstable, wherever
 * what that divides by is not 0. */
static qdot_status
judge_all_equilibria(qdot_rest *r, qdot_expr special, bool first, qdot_binder bind, void *user)
{
    qdot_judge *judge;
    qdot_status status = qdot_judge_new(r->s, r->system.equations, bind, user, &judge);

    if (status == QDOT_OK) {
        judge->forces = r->forces;
        judge->friction = r->friction;
        judge->slips = r->slips;
        judge->nonzero = special;
        status = qdot_rest_by_signs(r, r->forces, &judge->by_signs);
    }
    for (size_t i = 0; i < r->found.n && status == QDOT_OK; i++) {
        if (first)
            status = qdot_rest_special(r, 1, &r->found.at[i], &judge->nonzero);
        if (status == QDOT_OK)
            status = judge_member(r, judge, &r->found.at[i]);
        if (first && !qdot_equilibrium_is_unstable(&r->found.at[i]))
            r->found.n = i + 1;
    }
    qdot_judge_free(judge);
    return status;
}

qdot_status
qdot_rest_begin(qdot_rest *r, qdot_scene *s)
{
    const qdot_facts facts = qdot_scene_facts(s);
    qdot_status status;

    *r = (qdot_rest){.s = s, .pool = s->pool};
    QDOT_TRY(qdot_assumptions_read(s->pool, &facts, qdot_list(s->pool, (uint32_t)s->coordinates.n, s->coordinates.at),
                                   &r->assumed));
    r->facts = r->assumed.facts;
    r->system = (qdot_simultaneous){.pool = r->pool,
                                    .facts = r->facts,
                                    .alike = qdot_rest_moves_alike,
                                    .user = s,
                                    .work = WORK,
                                    .complete = true};
    QDOT_TRY(qdot_pool_check(r->pool));
    QDOT_TRY(qdot_rest_equations(r, &r->system.equations));
    r->energy = qdot_rest_value(s, qdot_list(s->pool, 0, NULL), qdot_mech_lagrangian(s));
    status = qdot_pool_check(r->pool);
    if (status == QDOT_EDOMAIN) { /* L is undefined at rest and is not examined */
        r->energy = QDOT_ZERO;
        status = QDOT_OK;
    }
    r->system.defined = r->energy;
    QDOT_TRY(status);
    QDOT_TRY(qdot_rest_domain(r));
    return find_unknowns(r);
}

void
qdot_rest_end(qdot_rest *r)
{
    qdot_simultaneous_clear(&r->system);
    qdot_assumptions_clear(&r->assumed);
    qdot_free(r->found.at);
}

qdot_status
qdot_rest_find_exactly(qdot_rest *r)
{
    qdot_expr equations = r->system.equations;
    bool lasting = contains_time(r, r->system.equations);

    if (lasting)
        QDOT_TRY(qdot_rest_at_all_times(r, r->system.equations, &equations));
    QDOT_TRY(begin_first_branch(r, equations));
    QDOT_TRY(qdot_rest_solve(r));
    return lasting ? keep_equilibria_for_all_times(r) : QDOT_OK;
}

qdot_status
qdot_rest_find(qdot_rest *r, qdot_binder bind, void *user, qdot_equilibria *out)
{
    r->bind = bind;
    r->user = user;
    QDOT_TRY(qdot_rest_find_exactly(r));
    r->formulas = r->system.complete;
    if (!r->system.complete && !contains_time(r, r->system.equations))
        QDOT_TRY(search_numerically(r, bind, user, out));
    QDOT_TRY(qdot_rest_ranges(r));
    QDOT_TRY(qdot_rest_leave_out_twice(r));
    QDOT_TRY(qdot_rest_tips(r));
    QDOT_TRY(qdot_rest_leave_out_jumps(r, &out->jump));
    r->system.complete = r->system.complete && !r->unresolved;
    return QDOT_OK;
}

/* An error if the domain of an angle is assumed: its places are listed for one turn of the declared domain alone, so
 * those that lie where it is assumed to be may be among the other turns. */
static qdot_status
need_declared_angles(qdot_rest *r)
{
    for (size_t k = 0; k < r->system.places; k++) {
        const qdot_expr u = r->system.unknowns.at[k];
        qdot_expr period;

        if (!qdot_expr_contains(r->pool, r->assumed.domain, u))
            continue;
        QDOT_TRY(qdot_simultaneous_period(&r->system, u, &period));
        if (period == QDOT_NIL)
            continue;
        (void)qdot_fail(QDOT_EFAILED, "equilibria recur in %s, whose domain is assumed, not declared",
                        qdot_expr_symbol(r->pool, u)->name);
        return qdot_hint("declare it, as in coord %s > 0", qdot_expr_symbol(r->pool, u)->name);
    }
    return QDOT_OK;
}

/* Remove equilibria outside the assumed domains of coordinates; if that depends on parameters add a
 * condition. */
static qdot_status
keep_assumed_domains(qdot_rest *r)
{
    size_t kept = 0;

    if (r->assumed.domain == QDOT_NIL)
        return QDOT_OK;
    QDOT_TRY(need_declared_angles(r));
    for (size_t i = 0; i < r->found.n; i++) {
        qdot_equilibrium one = r->found.at[i];
        qdot_expr domain = qdot_conditions_at(
            r->pool, qdot_simultaneous_put(r->pool, r->assumed.domain, one.equations), 0, NULL, NULL, &r->facts);

        QDOT_TRY(qdot_pool_check(r->pool));
        one.exists = qdot_conditions_all(r->pool, one.exists, domain);
        if (one.exists != QDOT_FALSE)
            r->found.at[kept++] = one;
    }
    r->found.n = kept;
    return qdot_pool_check(r->pool);
}

static qdot_status
find_equilibria(qdot_scene *s, bool first_only, qdot_binder bind, void *user, qdot_equilibria *out)
{
    qdot_rest r;
    qdot_status status = qdot_rest_begin(&r, s);

    *out = (qdot_equilibria){0};
    if (status == QDOT_OK)
        status = qdot_rest_find(&r, bind, user, out);
    if (status == QDOT_OK && first_only) /* the first place must satisfy the assumptions on coordinates */
        status = keep_assumed_domains(&r);
    if (status == QDOT_OK && !first_only)
        status = qdot_rest_special(&r, r.found.n, r.found.at, &out->special);
    if (status == QDOT_OK && !first_only && r.found.n == 0 && r.system.complete)
        status = qdot_rest_none(&r, &out->special);
    if (status == QDOT_OK)
        status = judge_all_equilibria(&r, out->special, first_only, bind, user);
    if (status == QDOT_OK && !first_only)
        status = qdot_rest_ends(&r, &out->special);
    if (status == QDOT_OK && !first_only)
        status = qdot_rest_meetings(&r, &out->meeting);
    if (status == QDOT_OK && !first_only)
        status = qdot_rest_undefined(&r, &out->undefined, &out->special);
    if (status == QDOT_OK && !first_only) /* only now: ends of regions were sought without the assumptions on coordinates */
        status = keep_assumed_domains(&r);
    if (status == QDOT_OK && (r.found.n == 0 || !first_only))
        status = qdot_rest_pole(&r, &out->pole);
    out->at = r.found.at;
    out->n = r.found.n;
    out->complete = r.system.complete && (out->pole == NULL || out->n > 0);
    out->recurs = r.system.recurs && r.found.n > 0;
    r.found.at = NULL;
    qdot_rest_end(&r);
    if (status != QDOT_OK)
        qdot_equilibria_clear(out);
    return status;
}

void
qdot_equilibria_clear(qdot_equilibria *e)
{
    qdot_free(e->at);
    *e = (qdot_equilibria){0};
}

qdot_status
qdot_equilibrium_find(qdot_scene *s, qdot_binder bind, void *user, qdot_equilibria *out)
{
    return find_equilibria(s, false, bind, user, out);
}

qdot_status
qdot_equilibrium_first(qdot_scene *s, qdot_binder bind, void *user, qdot_equilibria *out)
{
    return find_equilibria(s, true, bind, user, out);
}

qdot_status
qdot_equilibrium_judge(qdot_scene *s, qdot_binder bind, void *user, qdot_equilibrium *one)
{
    qdot_rest r;
    qdot_status status = qdot_rest_begin(&r, s);

    if (status == QDOT_OK)
        status = qdot_vec_push(&r.found, *one);
    if (status == QDOT_OK)
        status = judge_all_equilibria(&r, QDOT_NIL, true, bind, user);
    if (status == QDOT_OK)
        *one = r.found.at[0];
    qdot_rest_end(&r);
    return status;
}
