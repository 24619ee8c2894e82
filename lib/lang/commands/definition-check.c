/* definition-check.c -- refuses names that `=` cannot define, and suggests the line that was meant. */
#include "lang/commands/definition-check.h"

#include <string.h>

#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "lang/answer/answer.h"
#include "lang/commands/definition-parts.h"
#include "lang/functions/builtin.h"
#include "lang/functions/quantity.h"
#include "lang/functions/short-names.h"
#include "lang/language/hints.h"
#include "lang/language/token-text.h"
#include "lang/session/runs.h"
#include "lang/syntax/form.h"
#include "lang/syntax/outline.h"
#include "mech/scene/things.h"

typedef qdot_assignment assignment;

/* --- the right side --------------------------------------------------------------------- */

static uint32_t
dynamic_symbols_of_name(const qdot_session *s, const char *name)
{
    const uint32_t motion = QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION |
                            QDOT_HAS_TIME | QDOT_HAS_MOMENTUM | QDOT_HAS_MULTIPLIER;
    const qdot_name *known = qdot_names_find(s->names, name);

    if (known != NULL)
        return known->kind == QDOT_NAME_INDEX || known->value == QDOT_NIL
                   ? 0
                   : qdot_expr_node(s->pool, known->value)->holds & motion;
    known = qdot_names_first_member(s->names, name);
    if (known != NULL)
        return known->value == QDOT_NIL ? 0 : qdot_expr_node(s->pool, known->value)->holds & motion;
    if (strcmp(name, "t") == 0)
        return QDOT_HAS_TIME;
    return qdot_quantity_find(name) != NULL || qdot_scene_has_label(s->scene, name)
               ? QDOT_HAS_COORD
               : 0;
}

static void
read_right_side(assignment *a)
{
    for (qdot_mention m = qdot_definition_right(&a->as); qdot_mention_next(&m);)
        a->moves |= strcmp(m.name, "%") != 0 && dynamic_symbols_of_name(a->session, m.name) != 0;
    qdot_token_text_written(a->session, a->as.equals + 1, a->as.behind, &a->right);
    if (a->as.loop) {
        qdot_text_add(&a->loop, " ");
        qdot_token_text_written(a->session, a->as.behind, qdot_outline_end(a->as.behind), &a->loop);
    }
}

/* --- names of the left side ------------------------------------------------------------- */

/* The declared name on the left side: of NAME[...] the member, or any member of the family where the index
 * has yet to be evaluated. A member of numbers that is not declared, x[0] before x[1] ... x[n], is none. */
static const qdot_name *
find_declared_name(const assignment *a)
{
    const qdot_session *s = a->session;
    const char *name = a->as.name->text;
    const qdot_name *known = qdot_names_find(s->names, name);
    qdot_text member = {0};

    if (known != NULL || !a->as.member)
        return known;
    qdot_definition_member(&a->as, &member);
    if (member.n > 0) {
        known = member.failed ? NULL : qdot_names_find(s->names, qdot_text_str(&member));
        qdot_text_clear(&member);
        return known;
    }
    return qdot_names_first_member(s->names, name);
}

static bool
is_run_name(const qdot_session *s, const char *name)
{
    for (size_t i = 0; i < s->runs->n; i++)
        if (strcmp(s->runs->at[i].name, name) == 0)
            return true;
    return false;
}

/* Whether the name is dNAME or deltaNAME with a coordinate NAME. */
static bool
is_differential(const qdot_session *s, const char *name)
{
    static const char *const prefixes[] = {"d", "delta"};

    for (size_t i = 0; i < sizeof prefixes / sizeof *prefixes; i++) {
        const size_t n = strlen(prefixes[i]);
        const qdot_name *q =
            strncmp(name, prefixes[i], n) == 0 ? qdot_names_find(s->names, name + n) : NULL;

        if (q != NULL && q->kind == QDOT_NAME_COORD)
            return true;
    }
    return false;
}

/* Append an unused name made of `name` and a number, as "force1". */
static void
add_free_name(const qdot_session *s, const char *name, qdot_text *out)
{
    const size_t length = strlen(name);
    const char *parted = length > 0 && strchr("0123456789", name[length - 1]) ? "_" : "";
    qdot_text text = {0};

    for (unsigned i = 1; i < 1000; i++) {
        qdot_text_truncate(&text, 0);
        qdot_text_format(&text, "%s%s%u", name, parted, i);
        if (qdot_names_find(s->names, qdot_text_str(&text)) == NULL &&
            !qdot_names_is_family(s->names, qdot_text_str(&text)) &&
            !qdot_scene_has_label(s->scene, qdot_text_str(&text)) &&
            !is_run_name(s, qdot_text_str(&text)) && !is_differential(s, qdot_text_str(&text)))
            break;
    }
    qdot_text_add(out, qdot_text_str(&text));
    qdot_text_clear(&text);
}

/* --- suggested lines -------------------------------------------------------------------- */

/* Suggest the definition NAME1 = RIGHT with an unused name NAME1 and the same indices and arguments. */
static void
suggest_other_name(assignment *a)
{
    add_free_name(a->session, a->as.name->text, &a->line);
    qdot_token_text_written(a->session, a->as.name + 1, a->as.equals, &a->line);
    qdot_text_format(&a->line, " = %s", qdot_text_str(&a->right));
}

/* Suggest the line `WORD LEFT = RIGHT`, such as `set m = 3`, for the definition LEFT = RIGHT. */
static void
suggest_statement_line(assignment *a, const char *word)
{
    qdot_text_format(&a->line, "%s ", word);
    qdot_token_text_written(a->session, a->as.name, a->as.equals, &a->line);
    qdot_text_format(&a->line, " = %s", qdot_text_str(&a->right));
}

/* `check LEFT == RIGHT`; an equation on the right in brackets. Of an equation of motion, beside what is
 * none, the residual. */
static void
suggest_check(assignment *a)
{
    const bool equation = a->as.equation || strcmp(a->as.name->text, "eom") != 0;

    qdot_text_add(&a->line, equation ? "check " : "check residual(");
    qdot_token_text_written(a->session, a->as.name, a->as.equals, &a->line);
    qdot_text_format(&a->line, !equation ? ") == %s" : a->as.chained ? " == (%s)" : " == %s",
                     qdot_text_str(&a->right));
}

/* Fail at the name; %s in the message stands for the name, a second %s for the coordinate in dNAME
 * or deltaNAME. */
static qdot_status
refuse_with_suggestion(assignment *a, const char *message, const char *name)
{
    a->c->error_at = a->as.name->start;
    QDOT_TRY(qdot_text_status(&a->line));
    (void)qdot_fail(QDOT_ENAME, message, name, name + (strncmp(name, "delta", 5) == 0 ? 5 : 1));
    return qdot_hint("write %s%s", qdot_text_str(&a->line), qdot_text_str(&a->loop));
}

/* --- definitions of coordinates --------------------------------------------------------- */

static bool
has_equations_of_motion(const qdot_scene *s)
{
    return s->particles.n + s->bodies.n > 0 || s->lagrangian != QDOT_NIL;
}

/* q'' = E: suggest to compare it with the equation of motion, or if there are no masses a scene
 * with that equation. */
static qdot_status
refuse_acceleration(assignment *a)
{
    const qdot_token *prime = a->as.equals - 2;
    qdot_text q = {0};
    qdot_status status;

    qdot_token_text_written(a->session, a->as.name, prime, &q);
    if (has_equations_of_motion(a->session->scene) || a->as.accelerations || a->loop.n > 0) {
        qdot_text_format(&a->line, "check eom[%s] == (%s'' = %s)", qdot_text_str(&q),
                         qdot_text_str(&q), qdot_text_str(&a->right));
        status = refuse_with_suggestion(a, "equations of motion follow from the scene: `%.100s''` is not assigned",
                                        qdot_text_str(&q));
    } else {
        qdot_text_format(&a->line, "lagrangian %s'^2/2; force %s on %s", qdot_text_str(&q),
                         qdot_text_str(&a->right), qdot_text_str(&q));
        status = refuse_with_suggestion(a, "equations of motion follow from a scene, which has nothing yet that moves: "
                         "`%.100s''` is not assigned", qdot_text_str(&q));
    }
    qdot_text_clear(&q);
    return status;
}

/* Refuse q = E or q' = E for a coordinate q: suggest `start`, or `constraint` if E depends on coordinates or time. */
static qdot_status
refuse_coordinate(assignment *a)
{
    const qdot_name *known = find_declared_name(a);
    const size_t primes = a->as.primes;

    if (a->as.chained) { /* for a = b = c: the right side is itself an equation */
        qdot_text_add(&a->line, "(");
        qdot_token_text_written(a->session, a->as.name, a->as.behind, &a->line);
        qdot_text_char(&a->line, ')');
        return refuse_with_suggestion(a, "`%.200s` is a coordinate: an equation as a value is written in brackets",
                                      known->name);
    }
    if (primes == 2)
        return refuse_acceleration(a);
    if (a->as.call || /* as in theta(t) = 2*t, or in theta[1] = 2 without a family theta */
        (a->as.member && strcmp(known->name, a->as.name->text) == 0 && primes == 0))
        qdot_text_format(&a->line, "%s %s = %s", a->moves ? "constraint" : "start", known->name,
                         qdot_text_str(&a->right));
    else
        suggest_statement_line(a, a->moves ? "constraint" : "start");
    if (a->moves)
        return refuse_with_suggestion(a, "`%.200s` is a coordinate; an equation for it is a constraint",
                                      known->name);
    if (primes > 0 || known->file == NULL)
        return refuse_with_suggestion(a, "`%.200s` is a coordinate: its motion follows from a start", known->name);
    a->c->error_at = a->as.name->start;
    QDOT_TRY(qdot_text_status(&a->line));
    (void)qdot_fail(QDOT_ENAME, "`%.200s` was declared as a coordinate at %s:%u", known->name,
                    known->file, known->line);
    return qdot_hint("write %s%s", qdot_text_str(&a->line), qdot_text_str(&a->loop));
}

/* --- words of statements ---------------------------------------------------------------- */

/* Refuse potential = E in a scene with a stated Lagrangian L: suggest the Lagrangian L - (E). */
static qdot_status
refuse_beside_lagrangian(assignment *a, const char *word)
{
    const qdot_scene *scene = a->session->scene;
    const bool potential = strcmp(word, "potential") == 0;
    qdot_status status;

    a->c->error_at = a->as.name->start;
    if (potential && a->as.components == 1) {
        qdot_text_add(&a->line, "lagrangian ");
        QDOT_TRY(qdot_print(a->session->pool, scene->lagrangian, QDOT_PLAIN, &a->line));
        qdot_text_format(&a->line, " - (%s)", qdot_text_str(&a->right));
        QDOT_TRY(qdot_text_status(&a->line));
    }
    status = qdot_scene_need_no_lagrangian(scene, potential ? "a potential" : "gravity");
    return a->line.n > 0 ? qdot_hint("write %s%s", qdot_text_str(&a->line), qdot_text_str(&a->loop)) : status;
}

static qdot_status
refuse_statement_word(assignment *a, const qdot_statement *row)
{
    const qdot_scene *s = a->session->scene;

    if ((strcmp(row->word, "lagrangian") == 0 || strcmp(row->word, "hamiltonian") == 0) && qdot_definition_is_of_name(&a->as) &&
        s->particles.n + s->bodies.n > 0) {
        a->c->error_at = a->as.name->start;
        (void)qdot_fail(QDOT_ENAME, "`%s` is not stated beside particles: it follows from their masses and `potential`",
                        row->word);
        return qdot_hint("`%s` shows it", row->word[0] == 'l' ? "lagrange_function" : row->word);
    }
    if (s->lagrangian != QDOT_NIL && qdot_definition_is_of_name(&a->as) &&
        (strcmp(row->word, "potential") == 0 || strcmp(row->word, "gravity") == 0))
        return refuse_beside_lagrangian(a, row->word);
    if (!qdot_definition_statement(a, row))
        suggest_other_name(a);
    return refuse_with_suggestion(a, "`%s` is a word of the language: it is no name to define", row->word);
}

/* --- reserved words, labels ------------------------------------------------------------- */

/* Refuse lambda = 3 by suggesting a parameter of that name, and dtheta = 3 by suggesting a velocity. */
static qdot_status
refuse_reserved_name(assignment *a, const char *why)
{
    const char *name = a->as.name->text;
    bool family = strcmp(name, "lambda") == 0 || strcmp(name, "delta") == 0;
    qdot_derivative_name meant;

    if (!a->moves && qdot_definition_is_of_name(&a->as) && qdot_hints_derivative(a->session, name, false, &meant))
        qdot_text_format(&a->line, "start %s' = %s", meant.base, qdot_text_str(&a->right));
    else if (family && !a->moves && a->loop.n == 0 && a->as.components == 1)
        suggest_statement_line(a, "param");
    else
        suggest_other_name(a);
    return refuse_with_suggestion(a, why, name);
}

/* `bob = (1, 2)`, `bob' = (1, 2)` of a particle at (x, y): where it starts, or how fast. False: it is placed
 * otherwise. */
static bool
suggest_start_values(assignment *a, qdot_expr at, bool velocity)
{
    const qdot_pool *pool = a->session->pool;
    const bool one = qdot_expr_is_scalar(pool, at);
    const uint32_t n = one ? 1 : qdot_expr_count(pool, at);

    if (a->moves || a->as.components != n)
        return false;
    for (uint32_t i = 0; i < n; i++)
        if (!qdot_expr_is_class(pool, one ? at : qdot_expr_arg(pool, at, i), QDOT_COORD))
            return false;
    for (uint32_t i = 0; i < n; i++) {
        qdot_text_format(&a->line, "%s%s%s = ", i > 0 ? ", " : "start ",
                         qdot_expr_symbol(pool, one ? at : qdot_expr_arg(pool, at, i))->name, velocity ? "'" : "");
        qdot_definition_component(a->session, &a->as, i, &a->line);
    }
    return true;
}

/* The position of the particle or body of that name; nil if there is none. */
static qdot_expr
position_of_label(const qdot_scene *s, const char *label)
{
    const qdot_particle *particle = qdot_scene_find_particle(s, label);
    const qdot_body *body = qdot_scene_find_body(s, label);

    return particle != NULL ? particle->position : body != NULL ? body->position : QDOT_NIL;
}

static qdot_status
refuse_label(assignment *a, const char *label)
{
    const qdot_scene *s = a->session->scene;
    const qdot_expr at = position_of_label(s, label);

    if (at != QDOT_NIL && suggest_start_values(a, at, false))
        return refuse_with_suggestion(a, "`%.200s` is placed by the coordinates of its position", label);
    suggest_other_name(a);
    return refuse_with_suggestion(a,
                                  qdot_scene_find_particle(s, label) != NULL ? "`%.200s` is a particle of the scene"
                                  : at != QDOT_NIL ? "`%.200s` is a body of the scene"
                                  : is_run_name(a->session, label)
                    ? "`%.200s` is a run"
                    : "`%.200s` is a label of the scene",
                                  label);
}

/* Refuse bob' = (1, 2) for a particle whose position depends on coordinates: suggest their start values. */
static qdot_status
refuse_velocity_of_particle(assignment *a)
{
    const qdot_expr at = position_of_label(a->session->scene, a->as.name->text);

    read_right_side(a);
    return at != QDOT_NIL && suggest_start_values(a, at, true)
               ? refuse_with_suggestion(a, "`%.200s'` follows from the coordinates of its position", a->as.name->text)
               : QDOT_OK;
}

/* The label of a run or a thing of the scene (particle, spring, force ...) on the left side, or a family; NULL: none. */
static const char *
label_on_left_side(const assignment *a)
{
    const qdot_session *s = a->session;
    const char *name = a->as.name->text;

    if (qdot_definition_is_of_name(&a->as) || a->as.call)
        return qdot_scene_has_label(s->scene, name) || is_run_name(s, name) ? name : NULL;
    return a->as.member && qdot_scene_is_family(s->scene, name) ? name : NULL;
}

/* --- values of the language with an index ------------------------------------------------- */

/* Whether the left side is a member of a built-in quantity: eom[theta] = ..., p[x] = 3, conserved[1] = ... */
static bool
is_member_of_quantity(const assignment *a)
{
    static const char *const lists[] = {"conserved", "ds2", "speed2"};
    const qdot_quantity *row = qdot_quantity_find(a->as.name->text);

    if (row == NULL || !a->as.member)
        return false;
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        if (strcmp(row->name, lists[i]) == 0)
            return true;
    return row->most > 0 || row->over_coordinates;
}

static qdot_status
refuse_member(assignment *a)
{
    const qdot_name *q = qdot_definition_coordinate(a->session);

    if (strcmp(a->as.name->text, "p") == 0 && !a->moves) {
        suggest_statement_line(a, "set"); /* suggest `set`, for the value of a momentum in H or R */
    } else {
        /* suggest a Lagrangian first, as there are no equations of motion yet */
        if (!has_equations_of_motion(a->session->scene) && q != NULL)
            qdot_text_format(&a->line, "lagrangian %s'^2/2; ", q->name);
        suggest_check(a);
    }
    return refuse_with_suggestion(a, "`%s[ ]` is a value of the language: it follows from the scene", a->as.name->text);
}

/* --- checking a definition ---------------------------------------------------------------- */

/* The reason why a reserved word cannot be defined; NULL if it can. */
static const char *
reason_for_reserved(const qdot_session *s, const char *name)
{
    static const char *const words[][2] = {
        {"pi", "`%s` is reserved: it is the number 3.14159..."},
        {"t", "`%s` is reserved: it is the time"},
        {"dt", "`%s` is reserved: it is the differential of the time"},
        {"and", "`%s` is reserved: it joins conditions"},
        {"or", "`%s` is reserved: it joins conditions"},
        {"not", "`%s` is reserved: it turns a condition round"},
        {"true", "`%s` is reserved: it is what holds"},
        {"false", "`%s` is reserved: it is what does not hold"},
        {"lambda", "`%s` is reserved: lambda[NAME] is the multiplier of a constraint"},
        {"delta", "`%s` is reserved: delta[NAME] is the virtual displacement of a coordinate"}};

    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(words[i][0], name) == 0)
            return words[i][1];
    if (!is_differential(s, name))
        return NULL;
    return strncmp(name, "delta", 5) == 0 && qdot_names_find(s->names, name + 5) != NULL
               ? "`%s` is reserved: it is the virtual displacement of the coordinate `%s`"
               : "`%s` is reserved: it is the differential of the coordinate `%s`";
}

/* Whether the line is in the syntax of another system, as x = symbols('x'); other hints exist for these. */
static bool
is_syntax_of_other_system(const assignment *a)
{
    const char *applied = qdot_definition_applied(&a->as);

    /* a range in another system's syntax: x = 0:0.1:1 */
    return a->as.colon || a->as.range || (applied != NULL && !qdot_cursor_knows(a->session, applied));
}

/* Refuse m = ... for a parameter m: suggest `set` for a value, m = 3; another name for m = x or m(t) = t. */
static qdot_status
refuse_parameter(assignment *a, const qdot_name *known)
{
    if (a->moves || a->as.chained)
        suggest_other_name(a);
    else if (a->as.call)
        qdot_text_format(&a->line, "set %s = %s", known->name, qdot_text_str(&a->right));
    else
        suggest_statement_line(a, "set");
    a->c->error_at = a->as.name->start;
    QDOT_TRY(qdot_text_status(&a->line));
    (void)(known->file != NULL
               ? qdot_fail(QDOT_ENAME, "`%.200s` was declared as a parameter at %s:%u",
                           known->name, known->file, known->line)
               : qdot_fail(QDOT_ENAME, "`%.200s` is a parameter", known->name));
    return qdot_hint("write %s%s", qdot_text_str(&a->line), qdot_text_str(&a->loop));
}

static qdot_status
check_definition(assignment *a)
{
    const qdot_session *s = a->session;
    const char *name = a->as.name->text, *label, *why;
    const qdot_name *known = find_declared_name(a);
    const qdot_statement *row = qdot_statement_find(name);

    if (known != NULL && known->kind == QDOT_NAME_PARAM && !is_member_of_quantity(a))
        return is_syntax_of_other_system(a) ? QDOT_OK : refuse_parameter(a, known);
    if (known != NULL) /* a plain name p that is also used as p[x] */
        return known->name[0] == 'p' && known->name[1] == '\0' && is_member_of_quantity(a)
                   ? refuse_member(a)
                   : QDOT_OK;
    if (row != NULL && row->nameable)
        return QDOT_OK;
    if (row != NULL)
        return refuse_statement_word(a, row);
    if (is_member_of_quantity(a))
        return refuse_member(a);
    why = reason_for_reserved(s, name);
    if (why != NULL)
        return refuse_reserved_name(a, why);
    label = label_on_left_side(a);
    return label != NULL ? refuse_label(a, label) : QDOT_OK;
}

/* f(x) = E of a function of the user's, with declared names as its arguments, is an equation; it looks like a definition
 * where these are the arguments it was defined with. */
static qdot_status
check_applied_function(const assignment *a, const qdot_name *known)
{
    const qdot_pool *pool = a->session->pool;
    const uint32_t n = qdot_expr_count(pool, known->formals);
    uint32_t i = 0;

    for (; i < n; i++) {
        const qdot_token *argument = qdot_definition_argument(&a->as, i);

        if (argument == NULL || strcmp(argument->text, qdot_expr_symbol(pool, qdot_expr_arg(pool, known->formals, i))->name) != 0)
            return QDOT_OK;
    }
    return qdot_definition_argument(&a->as, i) == NULL
               ? qdot_answer_notice(a->session,
                                    "`%.100s` is a function already, so this is an equation; with an argument that "
                                    "is not declared it would define `%.100s` anew",
                                    known->name, known->name)
               : QDOT_OK;
}

/* NAME(names) = EXPR that is no definition: of a function of the language it is an equation of what is declared, and with a
 * name that means nothing it was meant as a definition; NAME(pi) = ... of a name without a meaning is neither. */
static qdot_status
check_function(assignment *a)
{
    const qdot_builtin *builtin = qdot_builtin_find(a->as.name->text);
    const qdot_name *known = qdot_names_find(a->session->names, a->as.name->text);
    const qdot_token *taken = NULL, *argument;
    bool unknown = false;

    if (a->as.equals == NULL || !a->as.call || a->as.primes > 0)
        return QDOT_OK;
    for (size_t i = 0; (argument = qdot_definition_argument(&a->as, i)) != NULL; i++) {
        unknown |= !qdot_cursor_knows(a->session, argument->text);
        taken = taken == NULL && !qdot_statement_is_free_argument(a->session, argument->text) ? argument : taken;
    }
    if (known != NULL)
        return known->kind == QDOT_NAME_FUNCTION ? check_applied_function(a, known) : QDOT_OK;
    if (builtin == NULL && taken != NULL && !qdot_cursor_knows(a->session, a->as.name->text)) {
        a->c->error_at = taken->start;
        (void)qdot_fail(QDOT_ENAME, "`%.100s` is a word of the language: an argument has a name of its own", taken->text);
        return qdot_hint("as in %.100s(s) = s^2", a->as.name->text);
    }
    if (builtin == NULL || !unknown)
        return QDOT_OK;
    read_right_side(a);
    suggest_other_name(a);
    return refuse_with_suggestion(a, "`%s` is a function of the language: it is not defined anew", a->as.name->text);
}

static qdot_status
check_statement(assignment *a)
{
    const qdot_definition *as = &a->as;
    const qdot_form form = qdot_statement_form(a->session, as->name);
    const qdot_name *known = find_declared_name(a);
    const bool defines = form == QDOT_FORM_DEFINITION;

    if (known != NULL && known->kind == QDOT_NAME_COORD && as->primes < 3 && !(as->member && as->apart) &&
        (defines || (form == QDOT_FORM_VALUE && !as->call))) {
        read_right_side(a);
        return is_syntax_of_other_system(a) ? QDOT_OK : refuse_coordinate(a);
    }
    if (form == QDOT_FORM_VALUE)
        return known == NULL && as->equals == as->name + 2 && as->primes == 1 ? refuse_velocity_of_particle(a) : check_function(a);
    if (!defines)
        return QDOT_OK;
    read_right_side(a);
    return check_definition(a);
}

qdot_status
qdot_definition_check(qdot_cursor *c, const qdot_token *end)
{
    assignment a = {.c = c, .session = c->session};
    qdot_status status = QDOT_OK;

    if (qdot_definition_find(c->at, end, &a.as))
        status = check_statement(&a);
    qdot_text_clear(&a.right);
    qdot_text_clear(&a.loop);
    qdot_text_clear(&a.line);
    return status;
}
