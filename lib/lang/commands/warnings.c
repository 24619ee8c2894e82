/* warnings.c -- gives notices for statements that are allowed but often mistaken. */
#include "lang/commands/warnings.h"

#include <string.h>

#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/functions/builtin.h"
#include "lang/functions/short-names.h"
#include "lang/language/function.h"
#include "lang/language/hints.h"
#include "lang/language/token-text.h"
#include "lang/session/bind.h"
#include "lang/session/phase.h"
#include "lang/session/values.h"
#include "mech/scene/scene.h"

static const uint32_t motion = QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION;

/* --- notices at definitions ----------------------------------------------------------- */

/* Names of built-in values that users define by mistake, with the statement they probably meant. */
static const struct {
    const char *name;
    const char *statement; /* the statement that sets the value; NULL: it follows from masses */
} names[] = {
    {"V", "potential"},
    {"potential_energy", "potential"},
    {"L", "lagrangian"},
    {"lagrange_function", "lagrangian"},
    {"T", NULL},
    {"kinetic", NULL},
    {"H", NULL},
    {"energy", NULL},
};

/* Whether the scene has masses or a Lagrangian, so that it has equations of motion. */
static bool
has_equations_of_motion(const qdot_scene *s)
{
    return s->particles.n > 0 || s->bodies.n > 0 || s->lagrangian != QDOT_NIL;
}

/* Append the statement suggested instead: "; `potential k*x^2` does" */
static void
append_suggestion(qdot_cursor *c, const qdot_definition *d, const qdot_name *entry, size_t row, qdot_text *text)
{
    const qdot_scene *s = c->session->scene;
    const char *word = names[row].statement;
    bool stated = s->lagrangian != QDOT_NIL;

    if (word == NULL) {
        qdot_text_add(text, "; masses do, `particle NAME mass M at R`, or all of L, "
                            "`lagrangian L`");
        return;
    }
    if ((strcmp(word, "lagrangian") == 0 && has_equations_of_motion(s)) ||
        (stated && strcmp(word, "potential") == 0)) {
        qdot_text_add(text, ": these follow from what is declared");
        return;
    }
    qdot_text_format(text, "; `%s ", word);
    if (entry->kind == QDOT_NAME_FUNCTION)
        qdot_token_text(c->session, d->name, d->equals, text);
    else
        qdot_token_text(c->session, d->equals + 1, c->at, text);
    qdot_text_add(text, "` does");
}

static qdot_status
give_warning(qdot_cursor *c, const qdot_definition *d, const qdot_name *entry, size_t row, const char *hidden)
{
    qdot_text text = {0};
    qdot_status status;

    qdot_text_format(&text, "`%s` names %s and enters no equation of motion", entry->name,
                     entry->kind == QDOT_NAME_FUNCTION ? "a function" : "an expression");
    append_suggestion(c, d, entry, row, &text);
    status = qdot_text_status(&text);
    if (status == QDOT_OK)
        status = qdot_answer_notice(c->session, "%.600s%s", qdot_text_str(&text), hidden);
    qdot_text_clear(&text);
    return status;
}

/* Whether a name, not an argument of the function, stands for something that contains the symbol. */
static bool
definition_contains_symbol(const qdot_session *s, const char *name, qdot_expr symbol)
{
    const qdot_name *known = qdot_names_find(s->names, name);

    if (known != NULL)
        return known->kind == QDOT_NAME_VALUE && qdot_expr_contains(s->pool, known->value, symbol);
    return (qdot_quantity_find(name) != NULL || qdot_scene_has_label(s->scene, name)) &&
           qdot_scene_contains(s->scene, symbol);
}

/* Whether the body of a function uses a symbol as a variable of calculus, as in diff(V, x). */
static bool
uses_symbol_as_variable(const qdot_name *f)
{
    static const char *const words[] = {"diff", "subs", "integral", "limit", "series", "solve"};

    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (qdot_mention_is_in(f->body->from, f->body->to, words[i]))
            return true;
    return false;
}

/* Give a notice for f(x) = V if V contains a declared x under another name: f(3) still depends on that x. */
static qdot_status
warn_of_argument(qdot_session *session, const qdot_name *f)
{
    const qdot_pool *pool = session->pool;
    const uint32_t n = uses_symbol_as_variable(f) ? 0 : qdot_expr_count(pool, f->formals);

    for (uint32_t i = 0; i < n; i++) {
        const char *formal = qdot_expr_symbol(pool, qdot_expr_arg(pool, f->formals, i))->name;
        const qdot_name *declared = qdot_names_find(session->names, formal);

        if (declared == NULL || (declared->kind != QDOT_NAME_COORD && declared->kind != QDOT_NAME_PARAM))
            continue;
        for (qdot_mention m = qdot_mention_in(f->body->from, f->body->to); qdot_mention_next(&m);)
            if (qdot_function_mentions(pool, f, m.name) && definition_contains_symbol(session, m.name, declared->value))
                return qdot_answer_notice(session,
                                          "the %s in `%.100s` is the declared one, not the argument of %.100s; "
                                          "`subs(%.100s, %s = ...)` has another in its place",
                                          formal, m.name, f->name, m.name, formal);
    }
    return QDOT_OK;
}

qdot_status
qdot_warnings_anew(qdot_session *session, const qdot_name *entry)
{
    const qdot_name *old = qdot_names_declared(session->names, entry->name);
    const bool function = entry->kind == QDOT_NAME_FUNCTION;

    if (old == NULL || old->kind != (function ? QDOT_NAME_VALUE : QDOT_NAME_FUNCTION) ||
        (!function && entry->kind != QDOT_NAME_VALUE))
        return QDOT_OK;
    return qdot_answer_notice(session, "`%.100s` is a %s from here on, and no longer the %s of %.200s:%u", entry->name,
                              function ? "function" : "value", function ? "value" : "function", old->file, old->line);
}

/* Whether the name being defined occurs anywhere else in the text. */
static bool
is_name_used_elsewhere(const qdot_cursor *c, const qdot_definition *d)
{
    const qdot_token *first = c->source->tokens.at;

    return qdot_mention_is_in(first, d->name, d->name->text) ||
           qdot_mention_is_in(d->name + 1, first + c->source->tokens.n, d->name->text);
}

/* Give a notice for thetadot = 2 with a coordinate theta and no use of thetadot: suggest `start theta' = 2`. */
static qdot_status
warn_of_velocity_name(qdot_cursor *c, const qdot_definition *d, const qdot_name *entry)
{
    qdot_session *session = c->session;
    qdot_derivative_name meant;
    const char *name = d->name->text;
    const qdot_name *member = NULL;
    qdot_text line = {0};
    qdot_status status;

    if (entry->kind != QDOT_NAME_VALUE || !qdot_expr_is_scalar(session->pool, entry->value) ||
        (qdot_expr_node(session->pool, entry->value)->holds & (motion | QDOT_HAS_TIME)) ||
        !(qdot_hints_derivative(session, name, true, &meant) || qdot_hints_derivative(session, name, false, &meant)) ||
        strcmp(meant.primes, "'") != 0 || is_name_used_elsewhere(c, d))
        return QDOT_OK;
    if (meant.family && qdot_definition_is_of_name(d))
        member = qdot_names_first_member(session->names, meant.base);
    qdot_text_add(&line, member != NULL ? member->name : meant.base);
    qdot_token_text(session, d->name + 1, d->equals, &line);
    qdot_text_add(&line, "' = ");
    qdot_token_text(session, d->equals + 1, c->at, &line);
    status = qdot_text_status(&line);
    if (status == QDOT_OK)
        status = qdot_answer_notice(session, "`%.100s` is a name of its own and no velocity; `start %.300s` gives that of %.100s",
                                    entry->name, qdot_text_str(&line), meant.base);
    qdot_text_clear(&line);
    return status;
}

qdot_status
qdot_warnings_definition(qdot_cursor *c, const qdot_definition *d, const qdot_name *entry)
{
    qdot_session *session = c->session;
    const qdot_quantity *hidden = qdot_quantity_find(entry->name);
    bool function = entry->kind == QDOT_NAME_FUNCTION;
    const char *longer;
    char words[120] = "";

    if (d != NULL)
        QDOT_TRY(function ? warn_of_argument(session, entry) : warn_of_velocity_name(c, d, entry));
    if (hidden != NULL && hidden->least > 0) /* only name[...] is predefined, not the plain name */
        hidden = NULL;
    longer = hidden != NULL ? qdot_short_names_long(hidden) : NULL;
    if (longer != NULL)
        snprintf(words, sizeof words, "; the language's is `%s`", longer);
    else if (hidden != NULL)
        snprintf(words, sizeof words, "; it hides the language's");
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(names[i].name, entry->name) == 0 &&
            (function || entry->kind == QDOT_NAME_VALUE) &&
            (function || (qdot_expr_node(session->pool, entry->value)->holds & motion)) &&
            (names[i].statement != NULL || !has_equations_of_motion(session->scene)))
            return give_warning(c, d, entry, i, words);
    if (hidden == NULL && (qdot_builtin_find(entry->name) == NULL ||
                           (!function && entry->kind != QDOT_NAME_UFUN)))
        return QDOT_OK;
    return qdot_answer_notice(session, "`%s` is now your own%s", entry->name,
                              hidden != NULL ? words : "; it hides the language's");
}

/* --- notices about the scene ---------------------------------------------------------- */

qdot_status
qdot_warnings_twice(qdot_session *session, qdot_scene_kind kind)
{
    static const char *const words[] = {
        [QDOT_GRAVITY] = "gravity",         [QDOT_POTENTIAL] = "potential",
        [QDOT_SPRING] = "spring",           [QDOT_DAMPER] = "damper",
        [QDOT_DISSIPATION] = "dissipation", [QDOT_FORCE] = "force",
        [QDOT_TORQUE] = "torque"};
    const qdot_scene *s = session->scene;
    bool on_coordinate = kind == QDOT_TORQUE && s->torques.at[s->torques.n - 1].force;
    const char *word = words[on_coordinate ? QDOT_FORCE : kind];
    size_t number = on_coordinate        ? qdot_scene_count(s, QDOT_FORCE)
                    : kind == QDOT_FORCE ? s->forces.n
                                         : qdot_scene_count(s, kind);

    if (!qdot_scene_said_twice(s, kind))
        return QDOT_OK;
    return qdot_answer_notice(session,
                              "the scene has this %s already: it counts as often as it is given; "
                              "`remove %s %zu` takes one away",
                              word, word, number);
}

qdot_status
qdot_warnings_place(qdot_cursor *c, qdot_expr place, const char *body,
                    const qdot_token *action, const qdot_token *at)
{
    qdot_session *session = c->session;
    qdot_text within = {0}, text = {0};
    qdot_status status = qdot_scene_moves_within(session->scene, place, body, &within);

    if (status == QDOT_OK && within.n > 0) {
        const char *bodies = qdot_text_str(&within);

        qdot_token_text(session, action, at, &text);
        qdot_text_format(&text, " on %.*s at material ", (int)strcspn(bodies, ","), bodies);
        qdot_token_text(session, at + 1, c->at, &text);
        status = qdot_text_status(&text);
        if (status == QDOT_OK)
            status = qdot_answer_notice(
                session,
                "this place moves within %.200s, and the force follows it; on the material that "
                "is there (friction at a contact): `force %.600s`",
                bodies, qdot_text_str(&text));
    }
    qdot_text_clear(&within);
    qdot_text_clear(&text);
    return status;
}

qdot_status
qdot_warnings_start(qdot_session *session)
{
    if (session->values->start_symbols.n > 0)
        return QDOT_OK;
    return qdot_answer_notice_once(
        session, session->scene->constraints.n + session->scene->eliminated.n > 0
                     ? "no `start` was given: what the constraints leave open begins at 0"
                     : qdot_phase_has(session)
                     ? "no `start` was given: all coordinates and momenta begin at 0"
                     : "no `start` was given: all coordinates and velocities begin at 0");
}

qdot_status
qdot_warnings_inputs(qdot_session *session, size_t n, const qdot_expr *symbols)
{
    for (size_t i = 0; i < session->scene->inputs.n; i++) {
        const qdot_expr input = session->scene->inputs.at[i], value = qdot_session_bind(session, input);

        QDOT_TRY(qdot_pool_check(session->pool));
        if (value != input && value != QDOT_ZERO && qdot_expr_place(n, symbols, input) >= n)
            QDOT_TRY(qdot_answer_notice(session, "the input `%.100s` counts as 0 here: its value of `set` is for runs",
                                        qdot_expr_symbol(session->pool, input)->name));
    }
    return QDOT_OK;
}

qdot_status
qdot_warnings_mass(qdot_session *session, const char *name, qdot_expr mass)
{
    if (!(qdot_expr_node(session->pool, mass)->holds & QDOT_HAS_TIME))
        return QDOT_OK;
    return qdot_answer_notice(session,
                              "the mass of %.80s changes with time: the equations say d(m v)/dt = F, as if mass came "
                              "and went at rest, without thrust; mass that moves at u beside %.80s needs the force "
                              "m'*(v + u) as well", name, name);
}
