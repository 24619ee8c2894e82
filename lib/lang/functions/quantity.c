/* quantity.c -- the table of quantities of a scene: T, V, L, eom, p[theta] ... */
#include "lang/functions/quantity.h"

#include <inttypes.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/value-kind.h"
#include "lang/answer/answer.h"
#include "lang/functions/cyclic-momenta.h"
#include "lang/functions/entry.h"
#include "lang/functions/equilibria.h"
#include "lang/functions/linear.h"
#include "lang/functions/separation.h"
#include "lang/session/bind.h"
#include "lang/session/labels.h"
#include "lang/session/phase.h"
#include "lang/session/speeds.h"
#include "lang/session/units.h"
#include "mech/dynamics/ostrogradsky.h"
#include "mech/dynamics/quantity.h"
#include "mech/dynamics/statics.h"
#include "mech/geometry/metric.h"
#include "mech/scene/scene.h"
#include "mech/study/bodies.h"
#include "mech/hamilton/hamilton.h"
#include "mech/study/noether.h"
#include "mech/hamilton/phase-space.h"
#include "mech/study/reactions.h"

/* --- checks before a quantity is evaluated ------------------------------------------ */

static qdot_status
require_equations_of_motion(const qdot_session *s)
{
    const qdot_scene *scene = s->scene;

    QDOT_TRY(qdot_hamilton_need_lagrangian(s->scene));
    if (scene->particles.n > 0 || scene->bodies.n > 0 || scene->lagrangian != QDOT_NIL
        || (scene->states.n > 0 && scene->states.n == scene->coordinates.n))
        return QDOT_OK;
    qdot_fail(QDOT_EINVAL, "the scene has nothing that moves");
    return qdot_hint("declare a `particle`, a `body` or a `lagrangian`");
}

static qdot_status
require_coordinates(const qdot_session *s)
{
    QDOT_TRY(require_equations_of_motion(s));
    if (s->scene->coordinates.n > 0)
        return QDOT_OK;
    qdot_fail(QDOT_EINVAL, "the scene has no coordinates");
    return qdot_hint("declare them: coord theta");
}

/* Check that the scene has equations of motion or, where nothing has mass, of equilibrium. */
static qdot_status
require_equations(const qdot_session *s)
{
    return qdot_statics_applies(s->scene) && qdot_statics_acts(s->scene) && s->scene->coordinates.n > 0 ? QDOT_OK
                                                                                                        : require_coordinates(s);
}

/* Check the index of name[theta]: it must be a coordinate. */
static qdot_status
check_coordinate_index(qdot_session *s, const char *name, qdot_expr index)
{
    QDOT_TRY(require_equations(s));
    if (qdot_expr_is_coordinate(s->pool, index) || (s->scene->higher.n > 0 && qdot_expr_is_class(s->pool, index, QDOT_COORD)))
        return QDOT_OK;
    return qdot_fail(QDOT_ETYPE, "%s[ ] takes a coordinate", name);
}

/* --- energies and other single expressions of the scene ------------------------------- */

static qdot_expr
cyclic_routhian(qdot_scene *s)
{
    return qdot_hamilton_routhian(s, 0, NULL);
}

static qdot_expr
whole_momentum(qdot_scene *s)
{
    return qdot_bodies_momentum(s, NULL);
}

static qdot_expr
whole_angular_momentum(qdot_scene *s)
{
    return qdot_bodies_angular_momentum(s, NULL, QDOT_NIL);
}

/* Define the getter of a quantity: `call` gives its value, after `need` has checked the scene. */
#define OF_SCENE(word, need, call)                                                       \
    static qdot_status get_##word(qdot_session *s, uint32_t n, const qdot_expr *index,   \
                                  qdot_expr *value)                                      \
    {                                                                                    \
        (void)n, (void)index;                                                            \
        QDOT_TRY(need(s));                                                               \
        return qdot_value_kind_give(s->pool, call(s->scene), value);                     \
    }
OF_SCENE(T, require_equations_of_motion, qdot_mech_kinetic)
OF_SCENE(L, require_equations_of_motion, qdot_mech_lagrangian)
OF_SCENE(routhian, require_coordinates, cyclic_routhian)
OF_SCENE(virtual_work, require_equations, qdot_mech_virtual_work)
OF_SCENE(momentum, require_equations_of_motion, whole_momentum)
OF_SCENE(angular_momentum, require_equations_of_motion, whole_angular_momentum)
#undef OF_SCENE

/* Say which momenta are functions of the coordinates. */
static qdot_status
notice_primary_constraints(qdot_session *s)
{
    const qdot_expr list = qdot_hamilton_linear(s->scene);
    qdot_text text = {0};
    qdot_status status = qdot_pool_check(s->pool);

    if (status != QDOT_OK || list == QDOT_NIL)
        return status;
    qdot_text_add(&text, "L is linear in some velocities: ");
    for (uint32_t i = 0; i < qdot_expr_count(s->pool, list) && status == QDOT_OK; i++) {
        const qdot_expr q = qdot_expr_arg(s->pool, list, i);

        qdot_text_format(&text, "%sp[%s] = ", i > 0 ? ", " : "", qdot_expr_symbol(s->pool, q)->name);
        status = qdot_print(s->pool, qdot_mech_momentum(s->scene, q), QDOT_PLAIN, &text);
    }
    qdot_text_add(&text, qdot_expr_count(s->pool, list) > 1 ? " are constraints between coordinates and momenta"
                                                            : " is a constraint between coordinates and momenta");
    return qdot_answer_notice_once_text(s, status, &text);
}

/* A stated H is known even where no Lagrangian follows from it. */
static qdot_status
get_hamiltonian(qdot_session *s, uint32_t n, const qdot_expr *index, qdot_expr *value)
{
    (void)n, (void)index;
    if (s->scene->hamiltonian == QDOT_NIL)
        QDOT_TRY(require_coordinates(s));
    QDOT_TRY(qdot_value_kind_give(s->pool, qdot_hamilton_hamiltonian(s->scene), value));
    return notice_primary_constraints(s);
}

/* With an H alone, sum p q' - L is H. */
static qdot_status
get_energy(qdot_session *s, uint32_t n, const qdot_expr *index, qdot_expr *value)
{
    if (qdot_phase_space_needed(s->scene))
        return get_hamiltonian(s, n, index, value);
    QDOT_TRY(require_equations_of_motion(s));
    return qdot_value_kind_give(s->pool, qdot_mech_energy(s->scene), value);
}

/* With an H alone, those of its phase space, in momenta. */
static qdot_status
get_conserved(qdot_session *s, uint32_t n, const qdot_expr *index, qdot_expr *value)
{
    qdot_expr found = QDOT_NIL;
    qdot_status status = qdot_phase_begin(s, false);

    (void)n, (void)index;
    if (status == QDOT_OK)
        status = require_coordinates(s);
    if (status == QDOT_OK && s->scene->eliminated.n > 0)
        status = qdot_fail(QDOT_ENOTBUILT, "not built yet: the list of conserved quantities with constraints by an H from which no "
                                           "Lagrangian follows");
    if (status == QDOT_OK)
        found = qdot_noether_conserved(s->scene);
    qdot_phase_end(s);
    QDOT_TRY(status);
    if (qdot_phase_space_needed(s->scene))
        found = qdot_phase_space_outward(s->scene, found);
    return qdot_value_kind_give(s->pool, found, value);
}

static qdot_status
get_V(qdot_session *s, uint32_t n, const qdot_expr *index, qdot_expr *value)
{
    (void)n, (void)index;
    if (s->scene->potentials.n == 0 && s->scene->springs.n == 0)
        QDOT_TRY(require_equations_of_motion(s));
    return qdot_value_kind_give(s->pool, qdot_mech_potential(s->scene), value);
}

/* --- geometry: one value for each particle (for each body if there are no particles) --- */

static qdot_status
apply_to_each_position(qdot_session *s, qdot_expr (*of)(qdot_scene *, qdot_expr), qdot_expr *value)
{
    qdot_scene *scene = s->scene;
    bool bodies = scene->particles.n == 0;
    uint32_t n = (uint32_t)(bodies ? scene->bodies.n : scene->particles.n);
    qdot_expr *list;

    if (n == 0) {
        qdot_fail(QDOT_EINVAL, "the scene has no particle");
        return qdot_hint("of a vector R it is ds2(R), speed2(R)");
    }
    list = qdot_malloc(n * sizeof *list);
    if (list == NULL)
        return QDOT_ENOMEM;
    for (uint32_t i = 0; i < n; i++)
        list[i] = of(scene, bodies ? scene->bodies.at[i].position
                                   : scene->particles.at[i].position);
    *value = n == 1 ? list[0] : qdot_list(s->pool, n, list);
    qdot_free(list);
    return qdot_value_kind_check(s->pool, *value);
}

#define OF_POSITION(word)                                                                \
    static qdot_status get_##word(qdot_session *s, uint32_t n, const qdot_expr *index,   \
                                  qdot_expr *value)                                      \
    {                                                                                    \
        (void)n, (void)index;                                                            \
        return apply_to_each_position(s, qdot_mech_##word, value);                                \
    }
OF_POSITION(ds2)
OF_POSITION(speed2)
#undef OF_POSITION

static qdot_status
get_mass_matrix(qdot_session *s, uint32_t n, const qdot_expr *index, qdot_expr *value)
{
    qdot_expr M, coordinates;

    QDOT_TRY(require_coordinates(s));
    QDOT_TRY(qdot_value_kind_give(s->pool, qdot_mech_mass_matrix(s->scene), &M));
    if (n == 0)
        return qdot_value_kind_give(s->pool, M, value);
    for (uint32_t i = 0; i < n; i++)
        QDOT_TRY(check_coordinate_index(s, "mass_matrix", index[i]));
    coordinates =
        qdot_list(s->pool, (uint32_t)s->scene->coordinates.n, s->scene->coordinates.at);
    QDOT_TRY(qdot_value_kind_check(s->pool, coordinates));
    return qdot_entry_of(s, M, coordinates, n, index, value);
}

/* --- momenta, forces, equations ----------------------------------------------------- */

/* Define higher_or_WORD: qdot_mech_WORD, but Ostrogradsky's where the Lagrangian holds second or higher derivatives. */
#define HIGHER(all)                                                                      \
    static qdot_expr higher_or_##all(qdot_scene *s)                                      \
    {                                                                                    \
        return s->higher.n > 0 ? qdot_ostrogradsky_##all(s) : qdot_mech_##all(s);        \
    }
#define HIGHER_OF(one)                                                                   \
    static qdot_expr higher_or_##one(qdot_scene *s, qdot_expr q)                         \
    {                                                                                    \
        return s->higher.n > 0 ? qdot_ostrogradsky_##one(s, q) : qdot_mech_##one(s, q);  \
    }
HIGHER(momenta)
HIGHER(equations)
HIGHER(accels)
HIGHER_OF(momentum)
HIGHER_OF(equation)
HIGHER_OF(accel)
#undef HIGHER
#undef HIGHER_OF

/* Define the getter of a quantity: its name gives the LIST for all coordinates, name[q] the value for one. */
#define BY_COORDINATE(word, need, all, one)                                              \
    static qdot_status get_##word(qdot_session *s, uint32_t n, const qdot_expr *index,   \
                                  qdot_expr *value)                                      \
    {                                                                                    \
        QDOT_TRY(need(s));                                                               \
        if (n == 0)                                                                      \
            return qdot_value_kind_give(s->pool, all(s->scene), value);                  \
        QDOT_TRY(check_coordinate_index(s, #word, index[0]));                                        \
        return qdot_value_kind_give(s->pool, one(s->scene, index[0]), value);            \
    }
BY_COORDINATE(momenta, require_coordinates, higher_or_momenta, higher_or_momentum)
BY_COORDINATE(lagrange, require_equations, higher_or_equations, higher_or_equation)
BY_COORDINATE(accel, require_coordinates, higher_or_accels, higher_or_accel)
BY_COORDINATE(forces, require_equations, qdot_mech_forces, qdot_mech_force)
#undef BY_COORDINATE

/* Equations in speeds where these are declared; Hamilton's where H is stated; else Lagrange's. */
static qdot_status
get_eom(qdot_session *s, uint32_t n, const qdot_expr *index, qdot_expr *value)
{
    if (qdot_session_has_speeds(s)) {
        QDOT_TRY(require_equations(s));
        return qdot_session_speeds_eom(s, n > 0 ? index[0] : QDOT_NIL, value);
    }
    if (s->scene->hamiltonian == QDOT_NIL)
        return get_lagrange(s, n, index, value);
    if (n == 0)
        return qdot_value_kind_give(s->pool, qdot_hamilton_equations(s->scene), value);
    if (!qdot_expr_is_coordinate(s->pool, index[0]))
        return qdot_fail(QDOT_ETYPE, "eom[ ] takes a coordinate");
    return qdot_value_kind_give(s->pool, qdot_hamilton_equation(s->scene, index[0]), value);
}

#define OF_COORDINATE(word, one)                                                         \
    static qdot_status get_##word(qdot_session *s, uint32_t n, const qdot_expr *index,   \
                                  qdot_expr *value)                                      \
    {                                                                                    \
        (void)n;                                                                         \
        QDOT_TRY(check_coordinate_index(s, #word, index[0]));                                        \
        return qdot_value_kind_give(s->pool, one(s->scene, index[0]), value);            \
    }
OF_COORDINATE(p, higher_or_momentum)
OF_COORDINATE(Q, qdot_mech_force)
#undef OF_COORDINATE

static qdot_status
get_delta(qdot_session *s, uint32_t n, const qdot_expr *index, qdot_expr *value)
{
    (void)n;
    if (!qdot_expr_is_coordinate(s->pool, index[0]))
        return qdot_fail(QDOT_ETYPE, "delta[ ] takes a coordinate");
    return qdot_value_kind_give(s->pool, qdot_symbol_of(s->pool, QDOT_DELTA, index[0]),
                                value);
}

/* --- multipliers of constraints ----------------------------------------------------- */

/* The number of constraints that are declared, also where the phase space of an H has them eliminated. */
static size_t
count_constraints(const qdot_scene *scene)
{
    return scene->constraints.n + scene->eliminated.n;
}

/* Nothing is called `name`, "rod, 2": the constraint before the comma, if there is one, has
 * fewer components. */
static qdot_status
report_no_component(qdot_session *s, const char *name)
{
    const size_t length = strcspn(name, ",");
    size_t components = 0;
    qdot_words names = {0};
    qdot_status status;

    for (size_t i = 0; name[length] != '\0' && i < count_constraints(s->scene); i++) {
        const qdot_constraint *c = &s->scene->constraints.at[i];

        if (strlen(c->name) == length && strncmp(c->name, name, length) == 0) {
            qdot_fail(QDOT_ENAME, "constraint `%s` has one component only", c->name);
            return qdot_hint("write lambda[%.80s]", c->name);
        }
        components += c->label != NULL && strlen(c->label) == length &&
                      strncmp(c->label, name, length) == 0;
    }
    if (components == 0) {
        for (size_t i = 0; i < count_constraints(s->scene); i++)
            (void)qdot_vec_push(&names, s->scene->constraints.at[i].name); /* if memory runs out the hint lacks this name */
        (void)qdot_fail(QDOT_ENAME, "there is no constraint `%.200s`", name);
        status = qdot_labels_hint(name, &names);
        qdot_free(names.at);
        return status;
    }
    return qdot_fail(QDOT_ENAME, "constraint `%.*s` has %zu components, and no `%.200s`",
                     (int)length, name, components, name);
}

/* Evaluate lambda[rod], lambda[pin, 1], or lambda[2] for a constraint without a label. */
static qdot_status
get_lambda(qdot_session *s, uint32_t n, const qdot_expr *index, qdot_expr *value)
{
    const qdot_symbol *label = qdot_expr_symbol(s->pool, index[0]);
    qdot_text name = {0};
    const qdot_constraint *found = NULL, *first = NULL;
    qdot_status status = QDOT_OK;
    int64_t k;

    if (label != NULL && label->class == QDOT_FORMAL)
        qdot_text_add(&name, label->name);
    else if ((status = qdot_session_integer(s, index[0], &k)) == QDOT_OK)
        qdot_text_format(&name, "%" PRId64, k);
    if (status == QDOT_OK && n == 2 &&
        (status = qdot_session_integer(s, index[1], &k)) == QDOT_OK)
        qdot_text_format(&name, ", %" PRId64, k);
    if (status == QDOT_OK)
        status = qdot_text_status(&name);
    for (size_t i = 0; status == QDOT_OK && i < count_constraints(s->scene); i++) {
        const qdot_constraint *c = &s->scene->constraints.at[i];

        if (strcmp(c->name, name.at) == 0)
            found = c;
        if (n == 1 && c->label != NULL && strcmp(c->label, name.at) == 0 && first == NULL)
            first = c;
    }
    if (found != NULL) {
        *value = s->scene->eliminated.n > 0 ? s->scene->eliminated.at[found - s->scene->constraints.at].multiplier
                                            : found->multiplier;
    } else if (status == QDOT_OK && first != NULL) {
        status = qdot_fail(QDOT_ENAME, "`%.200s` has a multiplier for each component",
                           name.at);
        qdot_hint("write lambda[%.80s, 1]", name.at);
    } else if (status == QDOT_OK) {
        status = report_no_component(s, name.at);
    }
    qdot_text_clear(&name);
    return status;
}

/* --- cyclic coordinates, degrees of freedom ----------------------------------------- */

static qdot_status
get_cyclic(qdot_session *s, uint32_t n, const qdot_expr *index, qdot_expr *value)
{
    QDOT_TRY(require_coordinates(s));
    return qdot_session_cyclic(s, n, index, value);
}

/* Find the number of degrees of freedom. */
static qdot_status
get_dof(qdot_session *s, uint32_t n, const qdot_expr *index, qdot_expr *value)
{
    qdot_dof dof;

    (void)n, (void)index;
    QDOT_TRY(qdot_mech_dof(s->scene, &dof));
    return qdot_value_kind_give(s->pool, qdot_expr_int(s->pool, (int64_t)dof.freedom),
                                value);
}

/* --- equilibria, stability, modes --------------------------------------------------- */

/* All equilibria or steady motions as a LIST, or one of them; as `find` has them. */
static qdot_status
get_rests(qdot_session *s, const char *word, qdot_equilibria_search *find, uint32_t n, const qdot_expr *index,
          qdot_expr *value)
{
    qdot_equilibria all = {0};
    qdot_status status = qdot_phase_begin(s, true);
    int64_t k = 0;

    if (status == QDOT_OK)
        status = require_equations(s);
    if (status == QDOT_OK)
        status = find(s, &all);
    if (status == QDOT_OK)
        status = qdot_equilibria_list(s, &all, value);
    if (status == QDOT_OK && n > 0)
        status = qdot_entry_of(s, *value, QDOT_NIL, 1, index, value);
    if (status == QDOT_OK && n > 0)
        status = qdot_session_integer(s, index[0], &k);
    if (status == QDOT_OK && n > 0)
        status = qdot_equilibria_notice(s, word, k, &all.at[k - 1]);
    qdot_equilibria_clear(&all);
    qdot_phase_end(s);
    if (status == QDOT_OK && qdot_phase_space_needed(s->scene))
        *value = qdot_phase_space_outward(s->scene, *value);
    return status;
}

static qdot_status
get_equilibria(qdot_session *s, uint32_t n, const qdot_expr *index, qdot_expr *value)
{
    return get_rests(s, "equilibria", qdot_equilibria_find, n, index, value);
}

static qdot_status
get_steady(qdot_session *s, uint32_t n, const qdot_expr *index, qdot_expr *value)
{
    return get_rests(s, "steady", qdot_equilibria_steady, n, index, value);
}

#define VERDICT(name, verdict)                                                           \
    static qdot_status get_##name(qdot_session *s, uint32_t n, const qdot_expr *index,   \
                                  qdot_expr *value)                                      \
    {                                                                                    \
        (void)n, (void)index;                                                            \
        return qdot_value_kind_give(s->pool, qdot_equilibria_word(s->pool, verdict), value); \
    }
VERDICT(stable, QDOT_STABLE)
VERDICT(unstable, QDOT_UNSTABLE)
VERDICT(to_first_order, QDOT_STABLE_TO_FIRST_ORDER)
VERDICT(undecided, QDOT_STABILITY_UNDECIDED)
#undef VERDICT

/* Find the frequencies of the modes, about the place of the latest `modes at` while the scene is the same; modes[k, x]: the
 * amplitude of x in mode k. */
static qdot_status
get_modes(qdot_session *s, uint32_t n, const qdot_expr *index, qdot_expr *value)
{
    const qdot_scene *scene = s->scene;
    const bool shown = s->history->modes_version == qdot_phase_version(s);
    qdot_modes modes;
    qdot_status status = QDOT_OK;
    int64_t k = 1;

    QDOT_TRY(require_coordinates(s));
    if (n > 0)
        QDOT_TRY(qdot_session_integer(s, index[0], &k));
    if (n == 2)
        QDOT_TRY(check_coordinate_index(s, "modes[k, q]: q", index[1]));
    QDOT_TRY(qdot_equilibria_modes_at(s, shown ? s->history->modes_at : QDOT_NIL, &modes));
    if (n > 0 && (k < 1 || (size_t)k > modes.n))
        status = qdot_fail(QDOT_EDOMAIN, "there are %zu modes, counted from 1", modes.n);
    else if (n == 0)
        *value = qdot_list(s->pool, (uint32_t)modes.n, modes.frequency);
    else if (n == 1)
        *value = modes.frequency[k - 1];
    for (size_t i = 0; i < scene->coordinates.n && n == 2 && status == QDOT_OK; i++)
        if (scene->coordinates.at[i] == index[1])
            *value = modes.amplitude[(size_t)(k - 1) * scene->coordinates.n + i];
    qdot_modes_clear(&modes);
    status = status == QDOT_OK && n < 2 ? qdot_units_give_rate(s, value) : status;
    return status == QDOT_OK ? qdot_value_kind_check(s->pool, *value) : status;
}

/* --- the linear motion ---------------------------------------------------------------- */

/* linearize[A]: a part of the latest linear motion. */
static qdot_status
get_linearize(qdot_session *s, uint32_t n, const qdot_expr *index, qdot_expr *value)
{
    const qdot_symbol *part = qdot_expr_symbol(s->pool, index[0]);
    const qdot_linear *x;

    (void)n;
    QDOT_TRY(qdot_linear_latest(s, &x));
    *value = QDOT_NIL;
#define PART(word)                                                                       \
    if (part != NULL && strcmp(part->name, #word) == 0)                                  \
        *value = x->word;
    PART(A)
    PART(B)
    PART(C)
    PART(D)
    PART(states)
    PART(inputs)
    PART(outputs)
#undef PART
    if (*value != QDOT_NIL)
        return QDOT_OK;
    (void)qdot_fail(QDOT_EINVAL, "the latest linear motion has no such part");
    return qdot_hint("linearize[A]; B, D belong to `input`, C, D to `output`");
}

/* --- reactions of constraints ------------------------------------------------------- */

static qdot_status
get_reactions(qdot_session *s, uint32_t n, const qdot_expr *index, qdot_expr *value)
{
    (void)n, (void)index;
    QDOT_TRY(require_equations(s));
    if (s->scene->constraints.n > 0)
        return qdot_value_kind_give(s->pool, qdot_mech_reaction_list(s->scene), value);
    qdot_fail(QDOT_EINVAL, "the scene has no constraints");
    return qdot_hint("constraint rod: x^2 + y^2 = L^2");
}

/* --- names of list members ---------------------------------------------------------- */

static qdot_expr
make_momentum_symbol(qdot_scene *s, qdot_expr q)
{
    return qdot_ostrogradsky_symbol(s, q);
}

static qdot_expr
make_acceleration_symbol(qdot_scene *s, qdot_expr q)
{
    return qdot_symbol_jet(s->pool, q, 2 * qdot_higher_order(s, q));
}

static qdot_expr
make_force_symbol(qdot_scene *s, qdot_expr q)
{
    qdot_pool *pool = s->pool;
    qdot_text name = {0};
    qdot_expr symbol;

    qdot_text_format(&name, "Q[%s]", qdot_expr_symbol(pool, q)->name);
    symbol = qdot_text_status(&name) == QDOT_OK
                 ? qdot_symbol_get(pool, QDOT_FORMAL, qdot_text_str(&name))
                 : qdot_pool_fail(pool);
    qdot_text_clear(&name);
    return symbol;
}

/* --- the table of quantities -------------------------------------------------------- */

static const qdot_quantity rows[] = {
    {"T", 0, 0, get_T, "T", "kinetic energy (also `kinetic`)", "T", false, NULL},
    {"kinetic", 0, 0, get_T, "kinetic", "kinetic energy T", "kinetic", false, NULL},
    {"V", 0, 0, get_V, "V", "potential energy (also `potential_energy`)", "V", false,
     NULL},
    {"potential_energy", 0, 0, get_V, "potential_energy", "potential energy V",
     "potential_energy", false, NULL},
    {"L", 0, 0, get_L, "L", "Lagrange function T - V (also `lagrange_function`)", "L",
     false, NULL},
    {"lagrange_function", 0, 0, get_L, "lagrange_function", "Lagrange function T - V",
     "lagrange_function", false, NULL},
    {"energy", 0, 0, get_energy, "energy", "Jacobi energy function h = sum p q' - L",
     "energy", false, NULL},
    {"ds2", 0, 0, get_ds2, "ds2",
     "line element, one for each particle; ds2(R) of a vector", "ds2", false, NULL},
    {"speed2", 0, 0, get_speed2, "speed2", "(ds/dt)^2, one for each particle", "speed2",
     false, NULL},
    {"mass_matrix", 0, 2, get_mass_matrix, "mass_matrix or mass_matrix[q1, q2]",
     "mass matrix M(q, t)", "mass_matrix", true, NULL},
    {"momenta", 0, 1, get_momenta, "momenta or momenta[theta]",
     "generalized momenta dL/dq'", "momenta", true, make_momentum_symbol},
    {"p", 1, 1, get_p, "p[theta]", "generalized momentum dL/dtheta'", "p[theta]", false,
     NULL},
    {"momentum", 0, 0, get_momentum, "momentum", "momentum of the scene, the sum of m r'", "momentum", false, NULL},
    {"angular_momentum", 0, 0, get_angular_momentum, "angular_momentum",
     "angular momentum of the scene about the origin; in the plane a number", "angular_momentum", false, NULL},
    {"forces", 0, 1, get_forces, "forces", "generalized forces, with their parts",
     "forces", true, make_force_symbol},
    {"Q", 1, 1, get_Q, "Q[theta]", "generalized force: all that is applied", "Q[theta]",
     false, NULL},
    {"virtual_work", 0, 0, get_virtual_work, "virtual_work",
     "virtual work, the sum of Q[q]*delta[q]", "virtual_work", false, NULL},
    {"delta", 1, 1, get_delta, "delta[theta]", "virtual displacement of a coordinate",
     "delta[theta]", false, NULL},
    {"eom", 0, 1, get_eom, "eom or eom[theta]", "Lagrange's equations; Hamilton's where H is stated", "eom", true,
     NULL},
    {"accel", 0, 1, get_accel, "accel or accel[theta]", "accelerations, solved for",
     "accel[theta]", true, make_acceleration_symbol},
    {"lambda", 1, 2, get_lambda, "lambda[rod] or lambda[pin, 1]",
     "multiplier of a constraint", "lambda[rod]", false, NULL},
    {"cyclic", 0, 1, get_cyclic, "cyclic or cyclic[phi]",
     "coordinates absent from L, with their momenta", "cyclic", false, NULL},
    {"dof", 0, 0, get_dof, "dof", "degrees of freedom", "dof", false, NULL},
    {"hamiltonian", 0, 0, get_hamiltonian, "hamiltonian",
     "Hamilton's function H(q, p, t); beside it p[theta] is the independent momentum",
     "diff(hamiltonian, p[theta])", false, NULL},
    {"H", 0, 0, get_hamiltonian, "H", "Hamilton's function (also `hamiltonian`)", "H", false,
     NULL},
    {"routhian", 0, 0, get_routhian, "routhian or routhian(phi)",
     "Routh's function L - sum p q', the velocities of cyclic coordinates, or of those named, "
     "replaced by their momenta",
     "routhian", false, NULL},
    {"reactions", 0, 0, get_reactions, "reactions",
     "forces of the constraints on each particle and body, by their multipliers",
     "reactions",
     false, NULL},
    {"hamilton_jacobi", 0, 1, qdot_session_get_jacobi, "hamilton_jacobi or hamilton_jacobi[r]",
     "the equation of Hamilton and Jacobi; the separated equation of a coordinate, p[r] = dS/dr", "hamilton_jacobi", false, NULL},
    {"complete_integral", 0, 0, qdot_session_get_integral, "complete_integral",
     "the solution S(q, t) of the equation of Hamilton and Jacobi with as many constants as coordinates", "complete_integral", false,
     NULL},
    {"conserved", 0, 0, get_conserved, "conserved or conserved[2]",
     "every conserved quantity found: cyclic momenta, the energy, those of translations, "
     "rotations and boosts; each is proved",
     "conserved", false, NULL},
    {"equilibria", 0, 1, get_equilibria, "equilibria or equilibria[2]",
     "the equilibria, a list of equations each; typed alone, with their stability",
     "equilibria", false, NULL},
    {"steady", 0, 1, get_steady, "steady or steady[2]",
     "the steady motions, a list of equations each, rates of cyclic coordinates standing for themselves; typed alone, "
     "with their stability",
     "steady", false, NULL},
    {"stable", 0, 0, get_stable, "stable", "a verdict of stability(equilibria[1])",
     "check stability(equilibria[1]) == stable", false, NULL},
    {"unstable", 0, 0, get_unstable, "unstable", "a verdict of stability(equilibria[1])",
     "check stability(equilibria[1]) == unstable", false, NULL},
    {"stable_to_first_order", 0, 0, get_to_first_order, "stable_to_first_order",
     "a verdict of stability(equilibria[1]): the linear motion stays near",
     "check stability(equilibria[1]) == stable_to_first_order", false, NULL},
    {"undecided", 0, 0, get_undecided, "undecided", "a verdict of stability(equilibria[1])",
     "check stability(equilibria[1]) == undecided", false, NULL},
    {"modes", 0, 2, get_modes, "modes, modes[k] or modes[k, theta]",
     "angular frequencies of the normal modes about the first equilibrium that is not "
     "unstable, ascending; modes[k, theta] is an amplitude, the first of a mode being 1; a complex one is [re, im]",
     "modes", false, NULL},
    {"linearize", 1, 1, get_linearize, "linearize[A]",
     "a part of the latest linear motion x' = A x + B u, y = C x + D u: a matrix, or the list [states], [inputs], [outputs]", "linearize[A]", false, NULL},
};

const qdot_quantity *
qdot_quantity_at(size_t i)
{
    return i < sizeof rows / sizeof *rows ? &rows[i] : NULL;
}

const qdot_quantity *
qdot_quantity_find(const char *name)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (rows[i].name[0] == name[0] && strcmp(rows[i].name, name) == 0)
            return &rows[i];
    return NULL;
}
