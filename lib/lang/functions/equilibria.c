/* equilibria.c -- finds equilibria and modes of a scene; numerical ones with the session's parameter values. */
#include "lang/functions/equilibria.h"

#include <inttypes.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/list.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "lang/answer/answer.h"
#include "lang/functions/solve-conditions.h"
#include "lang/session/bind.h"
#include "lang/session/history.h"
#include "lang/session/values.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/saved.h"
#include "mech/study/steady.h"
#include "normal/inequality/less.h"
#include "normal/solve/solve.h"

static qdot_expr
insert_session_values(void *session, qdot_expr e)
{
    return qdot_session_bind(session, e);
}

/* The same with the rates of steady motions at the values of `start`. */
static qdot_expr
insert_values_and_rates(void *user, qdot_expr e)
{
    qdot_session *session = user;
    const qdot_values *values = session->values;

    for (size_t i = 0; i < values->start_symbols.n && e != QDOT_NIL; i++) {
        const qdot_expr rate = values->start_symbols.at[i];

        if (qdot_expr_symbol(session->pool, rate)->class == QDOT_COORD && qdot_expr_symbol(session->pool, rate)->order == 1) {
            const qdot_expr symbol = qdot_steady_rate(session->pool, rate);

            e = qdot_subs(session->pool, e, 1, &symbol, &values->start_values.at[i]);
        }
    }
    return e == QDOT_NIL ? e : qdot_session_bind(session, e);
}

static qdot_status
require_coordinates(const qdot_session *session)
{
    if (session->scene->coordinates.n > 0)
        return QDOT_OK;
    (void)qdot_fail(QDOT_EINVAL, "the scene has no coordinates");
    return qdot_hint("declare them: coord theta");
}

/* While equilibria are looked for inputs are 0: put 0 in their place, and back. */
static qdot_status
inputs_rest(qdot_scene *scene, qdot_scene_saved *saved)
{
    qdot_status status = QDOT_OK;

    *saved = (qdot_scene_saved){0};
    if (scene->inputs.n > 0)
        status = qdot_scene_save(scene, saved);
    for (size_t i = 0; i < scene->inputs.n && status == QDOT_OK; i++)
        status = qdot_scene_replace(scene, scene->inputs.at[i], QDOT_ZERO);
    if (status != QDOT_OK)
        qdot_scene_restore(scene, saved);
    return status;
}

/* While inputs are 0 find equilibria, or (steady) steady motions, with the parameter values of the session. */
static qdot_status
find_with_inputs_at_rest(qdot_session *session, bool steady, qdot_equilibria *out)
{
    qdot_scene_saved saved;
    qdot_status status;

    *out = (qdot_equilibria){0};
    QDOT_TRY(require_coordinates(session));
    QDOT_TRY(inputs_rest(session->scene, &saved));
    status = steady ? qdot_steady_find(session->scene, session->history->steady_in, insert_values_and_rates, session, out)
                    : qdot_equilibrium_find(session->scene, insert_session_values, session, out);
    qdot_scene_restore(session->scene, &saved);
    return status;
}

qdot_status
qdot_equilibria_find(qdot_session *session, qdot_equilibria *out)
{
    return find_with_inputs_at_rest(session, false, out);
}

qdot_status
qdot_equilibria_steady(qdot_session *session, qdot_equilibria *out)
{
    return find_with_inputs_at_rest(session, true, out);
}

qdot_expr
qdot_equilibria_value(qdot_pool *pool, const qdot_equilibrium *e)
{
    return e->range == QDOT_NIL ? e->equations
                                : qdot_list_appended(pool, e->equations, qdot_expr_count(pool, e->range),
                                                     qdot_expr_args(pool, e->range));
}

/* Select the equations from `list`, leaving out the inequalities that describe a range of equilibria. */
static qdot_expr
select_equations(qdot_pool *pool, qdot_expr list)
{
    qdot_expr equations = qdot_list(pool, 0, NULL);

    for (uint32_t i = 0; i < qdot_expr_count(pool, list); i++) {
        qdot_expr one = qdot_expr_arg(pool, list, i);

        if (qdot_expr_node(pool, one)->op == QDOT_EQ)
            equations = qdot_list_appended(pool, equations, 1, &one);
    }
    return equations;
}

qdot_status
qdot_equilibria_list(qdot_session *session, const qdot_equilibria *all, qdot_expr *value)
{
    qdot_expr *members = qdot_malloc((all->n + 1) * sizeof *members);

    if (members == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < all->n; i++)
        members[i] = qdot_equilibria_value(session->pool, &all->at[i]);
    *value = qdot_list(session->pool, (uint32_t)all->n, members);
    qdot_free(members);
    return qdot_pool_check(session->pool);
}

/* The conditions for the equilibrium, with the session's values inserted. */
static qdot_expr
existence_with_values(qdot_session *session, qdot_expr exists)
{
    qdot_expr bound = qdot_session_bind(session, exists);

    return bound == QDOT_NIL ? QDOT_NIL : qdot_conditions_at(session->pool, bound, 0, NULL, NULL, NULL);
}

qdot_status
qdot_equilibria_notice(qdot_session *session, const char *word, int64_t k, const qdot_equilibrium *e)
{
    qdot_text text = {0};
    qdot_expr now;
    qdot_status status;

    if (e->exists == QDOT_NIL)
        return QDOT_OK;
    now = existence_with_values(session, e->exists);
    QDOT_TRY(qdot_pool_check(session->pool));
    if (now == QDOT_NIL) /* the condition holds */
        return QDOT_OK;
    qdot_text_format(&text, "%s[%" PRId64 "] exists when ", word, k);
    status = qdot_solve_print_conditions(session->pool, "", e->exists, &text);
    if (now == QDOT_FALSE)
        qdot_text_add(&text, ": not with the values of `set`");
    return qdot_answer_condition_text(session, status, &text);
}

/* --- the verdict as a value ------------------------------------------------------------------ */

static const char *const verdict_names[] = {
    [QDOT_STABLE] = "stable",
    [QDOT_UNSTABLE] = "unstable",
    [QDOT_STABLE_TO_FIRST_ORDER] = "stable_to_first_order",
    [QDOT_STABILITY_UNDECIDED] = "undecided",
};

qdot_expr
qdot_equilibria_word(qdot_pool *pool, qdot_stability stability)
{
    return qdot_symbol_get(pool, QDOT_FORMAL, verdict_names[stability]);
}

bool
qdot_equilibria_is_word(qdot_pool *pool, qdot_expr e)
{
    for (size_t i = 0; i < sizeof verdict_names / sizeof *verdict_names; i++)
        if (e == qdot_equilibria_word(pool, (qdot_stability)i))
            return true;
    return false;
}

static qdot_expr
equilibrium_as_value(qdot_pool *pool, const qdot_equilibrium *e)
{
    qdot_expr word = qdot_equilibria_word(pool, e->stability), when[3];

    if (e->stable_when == QDOT_NIL)
        return word;
    when[0] = qdot_expr_count(pool, e->stable_when) == 1
                  ? qdot_expr_arg(pool, e->stable_when, 0)
                  : qdot_logic(pool, QDOT_AND, qdot_expr_count(pool, e->stable_when),
                               qdot_expr_args(pool, e->stable_when));
    when[1] = word;
    when[2] = qdot_equilibria_word(pool, QDOT_STABILITY_UNDECIDED);
    return qdot_fun(pool, QDOT_IF, 3, when);
}

qdot_status
qdot_equilibria_stability(qdot_session *session, qdot_expr equations, qdot_expr *value)
{
    qdot_equilibria all;
    size_t at = 0;
    qdot_status status = qdot_equilibria_find(session, &all);

    while (status == QDOT_OK && at < all.n && qdot_equilibria_value(session->pool, &all.at[at]) != equations)
        at++;
    if (status == QDOT_OK && at == all.n) {
        (void)qdot_fail(QDOT_EINVAL, "this is not an equilibrium of the scene");
        status = qdot_hint("stability(equilibria[1])");
    }
    if (status == QDOT_OK) {
        *value = equilibrium_as_value(session->pool, &all.at[at]);
        status = qdot_pool_check(session->pool);
    }
    qdot_equilibria_clear(&all);
    return status;
}

/* Whether the solution was found numerically: a value has 15 decimal digits. */
static bool
is_found_numerically(qdot_session *session, qdot_expr equations)
{
    for (uint32_t i = 0; i < qdot_expr_count(session->pool, equations); i++) {
        qdot_expr one = qdot_expr_arg(session->pool, equations, i);
        const fmpq *value =
            qdot_expr_rational(session->pool, qdot_expr_arg(session->pool, one, 1));

        if (value != NULL && fmpz_bits(fmpq_denref(value)) > 32)
            return true;
    }
    return false;
}

/* --- normal modes -------------------------------------------------------------------------- */

static qdot_status
report_no_equilibrium(const qdot_equilibria *all)
{
    if (all->n == 0)
        return qdot_fail(QDOT_EINVAL, all->complete ? "the scene has no equilibrium"
                                                    : "no equilibrium was found");
    (void)qdot_fail(QDOT_EINVAL, "every equilibrium is unstable");
    return qdot_hint("modes at equilibria[1]");
}

/* Append ", WORD CONDITIONS" unless the session's values satisfy these; *never if they contradict them. */
static qdot_status
print_existence_conditions(qdot_session *session, const char *word, qdot_expr conditions, qdot_text *text, bool *never)
{
    qdot_expr now = conditions == QDOT_NIL ? QDOT_NIL : existence_with_values(session, conditions);

    QDOT_TRY(qdot_pool_check(session->pool));
    *never = *never || now == QDOT_FALSE;
    return now == QDOT_NIL ? QDOT_OK : qdot_solve_print_conditions(session->pool, word, conditions, text);
}

/* Append ", unstable when CONDITIONS" unless the session's values contradict these. */
static qdot_status
print_instability(qdot_session *session, qdot_expr conditions, qdot_text *text)
{
    const qdot_expr now = conditions == QDOT_NIL ? QDOT_FALSE : existence_with_values(session, conditions);

    QDOT_TRY(qdot_pool_check(session->pool));
    return now == QDOT_FALSE ? QDOT_OK
                             : qdot_solve_print_conditions(session->pool, ", unstable when ", conditions, text);
}

/* Give the notice `modes about x = 0, stable when a < 0`, if the equilibrium or its stability has conditions. */
static qdot_status
give_notice_of_equilibrium(qdot_session *session, const qdot_equilibrium *e)
{
    qdot_pool *pool = session->pool;
    qdot_text text = {0}, place = {0};
    bool never = false, first = true;
    qdot_status status = print_existence_conditions(session, ", exists when ", e->exists, &text, &never);

    if (status == QDOT_OK)
        status = e->stability == QDOT_UNSTABLE
                     ? print_instability(session, e->stable_when, &text)
                     : print_existence_conditions(session, ", stable when ", e->stable_when, &text, &never);
    for (uint32_t i = 0; i < qdot_expr_count(pool, e->equations) && status == QDOT_OK; i++) {
        qdot_expr one = qdot_expr_arg(pool, e->equations, i);

        /* this equation is for a constraint's multiplier, not for a coordinate */
        if (!qdot_expr_is_class(pool, qdot_expr_arg(pool, one, 0), QDOT_COORD))
            continue;
        qdot_text_add(&place, first ? "modes about " : ", ");
        first = false;
        status = qdot_print(pool, one, QDOT_PLAIN, &place);
    }
    qdot_text_add(&place, first ? "modes about every place" : "");
    if (status == QDOT_OK)
        status = qdot_text_status(&place);
    if (status == QDOT_OK && qdot_text_str(&text)[0] != 0)
        status = qdot_answer_condition(session, "%s%s%s", qdot_text_str(&place), qdot_text_str(&text),
                                         never ? ": not with the values of `set`" : "");
    qdot_text_clear(&place);
    qdot_text_clear(&text);
    return status;
}

/* Give a notice for each mode of oscillation whose squared frequency is not proved positive. */
static qdot_status
give_notice_of_unproved_modes(qdot_session *session, const qdot_modes *modes)
{
    const qdot_facts facts = qdot_scene_facts(session->scene);
    qdot_status status = QDOT_OK;

    for (size_t k = 0; k < modes->n && status == QDOT_OK; k++) {
        qdot_expr square = qdot_session_bind(session, qdot_pow_int(session->pool, modes->frequency[k], 2));
        qdot_decision d;

        QDOT_TRY(qdot_pool_check(session->pool));
        QDOT_TRY(qdot_decide_less(session->pool, QDOT_ZERO, square, false, &facts, &d));
        if (d.verdict != QDOT_PROVED)
            status = qdot_answer_condition(session, "modes[%zu] is real only where its square is not negative", k + 1);
    }
    return status;
}

/* Find the first equilibrium that is not unstable. */
static qdot_status
find_first_not_unstable(qdot_session *session, qdot_equilibrium *place)
{
    qdot_equilibria all;
    size_t at = 0;
    qdot_status status;

    QDOT_TRY(require_coordinates(session));
    QDOT_TRY(qdot_equilibrium_first(session->scene, insert_session_values, session, &all));
    while (at < all.n && qdot_equilibrium_is_unstable(&all.at[at]))
        at++;
    status = at < all.n ? QDOT_OK : report_no_equilibrium(&all);
    if (status == QDOT_OK)
        *place = all.at[at];
    qdot_equilibria_clear(&all);
    return status;
}

/* Judge the stability of an equilibrium given by its equations; it exists where their values are defined. */
static qdot_status
judge_stability(qdot_session *session, qdot_equilibrium *place)
{
    const qdot_facts facts = qdot_scene_facts(session->scene);

    place->exists = qdot_conditions_of_domain(session->pool, place->equations, QDOT_NIL);
    place->exists = qdot_conditions_at(session->pool, place->exists, 0, NULL, NULL, &facts);
    place->exists = place->exists == QDOT_FALSE ? QDOT_NIL : qdot_conditions_generic(session->pool, place->exists);
    QDOT_TRY(qdot_pool_check(session->pool));
    return qdot_equilibrium_judge(session->scene, insert_session_values, session, place);
}

/* Whether velocities are among the equations, as steady motions have them. */
static bool
names_velocities(const qdot_pool *pool, qdot_expr equations)
{
    for (uint32_t i = 0; equations != QDOT_NIL && i < qdot_expr_count(pool, equations); i++) {
        const qdot_expr left = qdot_expr_arg(pool, qdot_expr_arg(pool, equations, i), 0);

        if (qdot_expr_is_class(pool, left, QDOT_COORD) && qdot_expr_symbol(pool, left)->order > 0)
            return true;
    }
    return false;
}

/* The modes about a place, to *modes, and unless they are numbers the place's stability if `judge`. */
static qdot_status
find_modes_about(qdot_session *session, bool judge, qdot_equilibrium *place, qdot_modes *modes)
{
    QDOT_TRY(qdot_rest_multipliers(session->scene, &place->equations));
    place->numeric = is_found_numerically(session, place->equations);
    QDOT_TRY(qdot_modes_about(session->scene, place->equations, place->numeric, insert_session_values, session, modes));
    return judge && !modes->numeric ? judge_stability(session, place) : QDOT_OK;
}

/* The same about a steady motion, in coordinates that turn along. */
static qdot_status
find_modes_of_steady_motion(qdot_session *session, qdot_equilibrium *place, qdot_modes *modes)
{
    const size_t n = session->scene->coordinates.n;
    qdot_turning turning;
    qdot_status status = qdot_turning_begin(session->scene, place->equations, &turning, &place->equations);

    if (status == QDOT_OK)
        status = find_modes_about(session, true, place, modes);
    if (status == QDOT_EINVAL && turning.n > 0)
        (void)qdot_hint("modes at steady[1]");
    qdot_turning_end(session->scene, &turning);
    if (status == QDOT_OK) {
        place->equations = qdot_turning_with_rates(&turning, place->equations);
        place->exists = qdot_turning_with_rates(&turning, place->exists);
        place->stable_when = qdot_turning_with_rates(&turning, place->stable_when);
        for (size_t k = 0; k < modes->n; k++)
            modes->frequency[k] = qdot_turning_with_rates(&turning, modes->frequency[k]);
        for (size_t k = 0; k < modes->n * n; k++)
            modes->amplitude[k] = qdot_turning_with_rates(&turning, modes->amplitude[k]);
        status = qdot_pool_check(session->pool);
    }
    qdot_turning_clear(&turning);
    return status;
}

/* As qdot_equilibria_modes_at, of a scene whose inputs are 0. */
static qdot_status
find_modes_at(qdot_session *session, qdot_expr equations, qdot_modes *modes)
{
    qdot_equilibrium place = {.equations = equations};
    qdot_status status;

    if (equations == QDOT_NIL)
        QDOT_TRY(find_first_not_unstable(session, &place));
    place.equations = qdot_solve_one_member(session->pool, select_equations(session->pool, place.equations));
    QDOT_TRY(qdot_pool_check(session->pool));
    status = names_velocities(session->pool, place.equations)
                 ? find_modes_of_steady_motion(session, &place, modes)
                 : find_modes_about(session, equations != QDOT_NIL, &place, modes);
    if (status == QDOT_OK && !modes->numeric)
        status = give_notice_of_equilibrium(session, &place);
    if (!modes->numeric && status == QDOT_OK && place.stability != QDOT_STABLE &&
        place.stability != QDOT_STABLE_TO_FIRST_ORDER)
        status = give_notice_of_unproved_modes(session, modes);
    if (status == QDOT_OK && modes->unordered)
        status = qdot_answer_notice(session, "the declared signs do not decide the order of the modes: it is that at one "
                                             "choice of the parameters");
    if (status != QDOT_OK)
        qdot_modes_clear(modes);
    return status;
}

qdot_status
qdot_equilibria_modes_at(qdot_session *session, qdot_expr equations, qdot_modes *modes)
{
    qdot_scene_saved saved;
    qdot_status status;

    *modes = (qdot_modes){0};
    QDOT_TRY(inputs_rest(session->scene, &saved));
    status = find_modes_at(session, equations, modes);
    qdot_scene_restore(session->scene, &saved);
    return status;
}
