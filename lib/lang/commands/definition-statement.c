/* definition-statement.c -- suggests the statement that was meant by WORD = ..., such as gravity = 9.81. */
#include <string.h>

#include "expr/node.h"
#include "lang/commands/definition-parts.h"
#include "lang/commands/statement-form.h"
#include "lang/language/token-text.h"
#include "mech/scene/scene.h"
#include "mech/scene/things.h"

typedef qdot_assignment assignment;

/* The coordinate declared first, or NULL. */
const qdot_name *
qdot_definition_coordinate(const qdot_session *s)
{
    const qdot_name *name;

    for (size_t i = 0; (name = qdot_names_at(s->names, i)) != NULL; i++)
        if (name->kind == QDOT_NAME_COORD)
            return name;
    return NULL;
}

/* The number of components if the right side is a vector (a, b); 1 if it is none. */
size_t
qdot_definition_components(const assignment *a)
{
    size_t n = 1;
    long depth = 0;

    if (!qdot_token_is(a->equals + 1, "(") ||
        qdot_statement_behind_bracket(a->equals + 1) != a->behind)
        return 1;
    for (const qdot_token *k = a->equals + 1; k < a->behind; k++) {
        depth += qdot_token_bracket(k);
        n += depth == 1 && qdot_token_is(k, ",");
    }
    return n;
}

void
qdot_definition_component(const assignment *a, size_t i, qdot_text *out)
{
    const bool vector = qdot_definition_components(a) > 1;
    const qdot_token *k = a->equals + 1 + vector, *const end = a->behind - vector, *from = k;
    long depth = 0;

    for (; k < end; k++) {
        if (depth == 0 && qdot_token_is(k, ",")) {
            if (i-- == 0)
                break;
            from = k + 1;
        }
        depth += qdot_token_bracket(k);
    }
    qdot_token_text_written(a->session, from, k, out);
}

static bool
is_sum(const assignment *a)
{
    long depth = 0;

    for (const qdot_token *k = a->equals + 1; k < a->behind; k++) {
        depth += qdot_token_bracket(k);
        if (depth == 0 && (qdot_token_is(k, "+") || qdot_token_is(k, "-")))
            return true;
    }
    return false;
}

/* Suggest the line WORD RIGHT BEHIND, where RIGHT is the right side of the definition. */
static void
write_statement(assignment *a, const char *word, const char *behind)
{
    qdot_text_format(&a->line, "%s %s%s", word, qdot_text_str(&a->right), behind);
}

/* The number of dimensions of the scene; 0: nothing is placed yet. */
static uint32_t
count_dimensions(const qdot_session *s)
{
    const qdot_scene *scene = s->scene;
    const qdot_expr at = scene->particles.n > 0 ? scene->particles.at[0].position
                         : scene->bodies.n > 0  ? scene->bodies.at[0].position
                                                : QDOT_NIL;

    return at == QDOT_NIL                         ? 0
           : qdot_expr_is_scalar(s->pool, at) ? 1
                                                  : qdot_expr_count(s->pool, at);
}

/* Suggest gravity (0, -g) with the last n components of the right side, preceded by zeros if there
 * are fewer. */
static void
write_components(assignment *a, uint32_t n)
{
    const size_t said = qdot_definition_components(a);

    qdot_text_add(&a->line, n > 1 ? "gravity (" : "gravity ");
    for (size_t i = said; i < n; i++)
        qdot_text_add(&a->line, "0, ");
    for (size_t i = said > n ? said - n : 0; i < said; i++) {
        qdot_definition_component(a, i, &a->line);
        qdot_text_add(&a->line, i + 1 < said ? ", " : "");
    }
    qdot_text_add(&a->line, n > 1 ? ")" : "");
}

/* gravity = g: along the last axis, downwards; gravity = (0, -g) with as many components as the scene has. False: it is
 * no field. */
static bool
write_gravity(assignment *a)
{
    const uint32_t n = count_dimensions(a->session);
    const char *right = qdot_text_str(&a->right);
    const bool down = *right == '-'; /* the user already points gravity downwards */
    const bool whole = is_sum(a) && !down;

    if (qdot_definition_components(a) > 1 && n > 0 && n <= 3 && qdot_definition_components(a) != n)
        write_components(a, n);
    else if (qdot_definition_components(a) > 1 || n == 1)
        write_statement(a, "gravity", "");
    else
        qdot_text_format(&a->line, "gravity (0, %s%s%s%s%s)", n == 3 ? "0, " : "", down ? "" : "-",
                         whole ? "(" : "", right, whole ? ")" : "");
    return true;
}

/* Whether the right side contains `on` and a target. */
static bool
says_on(const assignment *a)
{
    long depth = 0;

    for (const qdot_token *k = a->equals + 1; k < a->behind; k++) {
        depth += qdot_token_bracket(k);
        if (depth == 0 && k > a->equals + 1 && qdot_token_is_word(k, "on"))
            return true;
    }
    return false;
}

/* Whether the right side is a vector though it is not written as one: it holds the position or the velocity of a thing,
 * or a name of a vector, outside the arguments of functions. */
static bool
holds_vector(const assignment *a)
{
    const qdot_session *s = a->session;
    long depth = 0, arguments = 0; /* bracket depth at which a function's arguments begin; 0: outside of a function */

    for (const qdot_token *k = a->equals + 1; k < a->behind; k++) {
        const qdot_name *known = k->kind == QDOT_TOKEN_NAME ? qdot_names_find(s->names, k->text) : NULL;
        const qdot_particle *particle = k->kind == QDOT_TOKEN_NAME ? qdot_scene_find_particle(s->scene, k->text) : NULL;
        const qdot_expr e = known != NULL ? known->value : particle != NULL ? particle->position : QDOT_NIL;

        if (qdot_token_is(k, "(") && k > a->equals + 1 && k[-1].kind == QDOT_TOKEN_NAME && arguments == 0)
            arguments = depth + 1;
        depth += qdot_token_bracket(k);
        if (depth < arguments)
            arguments = 0;
        if (arguments == 0 && e != QDOT_NIL && qdot_expr_kind(s->pool, e) == QDOT_VEC && !qdot_token_is(k + 1, "[") &&
            !qdot_token_is(k + 1, "("))
            return true;
    }
    return false;
}

/* force = F: a vector on the first thing that has as many dimensions, a number on a coordinate. False:
 * there is none. */
static bool
write_force(assignment *a, const char *word)
{
    const qdot_scene *s = a->session->scene;
    const qdot_name *q = qdot_definition_coordinate(a->session);
    const char *on = q != NULL ? q->name : NULL;
    const bool vector = qdot_definition_components(a) > 1 || holds_vector(a);
    qdot_text behind = {0};

    if (says_on(a))
        return write_statement(a, word, ""), true;
    if (vector)
        on = strcmp(word, "force") != 0 ? NULL
             : s->particles.n > 0       ? s->particles.at[0].name
             : s->bodies.n > 0          ? s->bodies.at[0].name
                                        : NULL;
    if (on == NULL)
        return false;
    qdot_text_format(&behind, " on %s", on);
    write_statement(a, word, qdot_text_str(&behind));
    qdot_text_clear(&behind);
    return true;
}

/* spring = k: suggest a spring between the first particle and the origin. False: there is no particle. */
static bool
write_link(assignment *a, const char *word)
{
    static const char *const origin[] = {"", "0", "(0, 0)", "(0, 0, 0)"};
    const qdot_scene *s = a->session->scene;
    const uint32_t n = count_dimensions(a->session);

    if (s->particles.n == 0 || n > 3 || qdot_definition_components(a) > 1)
        return false;
    qdot_text_format(&a->line, "%s between %s, %s %s %s", word, s->particles.at[0].name, origin[n],
                     strcmp(word, "spring") == 0 ? "stiffness" : "coefficient",
                     qdot_text_str(&a->right));
    return true;
}

/* constraint = A = B: suggest that equation; constraint = E: suggest E = 0. */
static void
write_constraint(assignment *a)
{
    bool equation = false;

    for (const qdot_token *k = a->equals + 1; k < a->behind; k++)
        equation |= qdot_token_is(k, "=") || qdot_token_is(k, "==");
    write_statement(a, "constraint", equation ? "" : " = 0");
}

/* What stands behind these words may be written behind an equation sign by mistake; false: it is a
 * value, for which a name was sought. */
bool
qdot_definition_statement(assignment *a, const qdot_statement *row)
{
    static const char *const terms[] = {"potential", "dissipation", "lagrangian", "hamiltonian"};
    static const char *const options[][2] = {{"style", "plain unicode flat latex mathml"},
                                             {"timing", "on off"}};
    const qdot_scene *s = a->session->scene;
    const char *word = row->word;
    const qdot_token *right = a->equals + 1;
    bool stated = s->lagrangian != QDOT_NIL;

    /* with arguments, as in gravity(x) = ..., it is a function */
    if (!qdot_statement_is_built(row) || a->name + 1 != a->equals)
        return false;
    if ((stated && (strcmp(word, "potential") == 0 || strcmp(word, "gravity") == 0)) ||
        ((strcmp(word, "lagrangian") == 0 || strcmp(word, "hamiltonian") == 0) &&
         s->particles.n + s->bodies.n > 0))
        return false;
    for (size_t i = 0; i < sizeof terms / sizeof *terms; i++)
        if (strcmp(word, terms[i]) == 0 && qdot_definition_components(a) == 1)
            return write_statement(a, word, ""), true;
    for (size_t i = 0; i < sizeof options / sizeof *options; i++)
        if (strcmp(word, options[i][0]) == 0 && right->kind == QDOT_TOKEN_NAME &&
            right + 1 == a->behind && qdot_has_word(options[i][1], right->text))
            return write_statement(a, word, ""), true;
    if (strcmp(word, "gravity") == 0)
        return !a->primed && write_gravity(a);
    if (strcmp(word, "constraint") == 0 && a->moves && qdot_definition_components(a) == 1)
        return write_constraint(a), true;
    if (strcmp(word, "force") == 0 || strcmp(word, "torque") == 0)
        return write_force(a, word);
    if (strcmp(word, "spring") == 0 || strcmp(word, "damper") == 0)
        return write_link(a, word);
    for (const qdot_token *k = right; k < a->behind && !row->alone; k++)
        if (qdot_token_is(k, "..") || k->kind == QDOT_TOKEN_STRING)
            /* the statement was meant: run = 0..5, include = "x.lag" */
            return write_statement(a, word, ""), true;
    return false;
}
