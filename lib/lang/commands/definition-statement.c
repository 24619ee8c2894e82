/* definition-statement.c -- suggests the statement that was meant by WORD = ..., such as gravity = 9.81. */
#include <string.h>

#include "expr/node.h"
#include "lang/commands/definition-parts.h"
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

/* Suggest the line WORD RIGHT BEHIND, where RIGHT is the right side of the definition. */
static void
suggest_statement(assignment *a, const char *word, const char *behind)
{
    qdot_text_format(&a->line, "%s %s%s", word, qdot_text_str(&a->right), behind);
}

/* The number of dimensions of the scene; 0: nothing has been placed in it yet. */
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
suggest_gravity_vector(assignment *a, uint32_t n)
{
    const size_t said = a->as.components;

    qdot_text_add(&a->line, n > 1 ? "gravity (" : "gravity ");
    for (size_t i = said; i < n; i++)
        qdot_text_add(&a->line, "0, ");
    for (size_t i = said > n ? said - n : 0; i < said; i++) {
        qdot_definition_component(a->session, &a->as, i, &a->line);
        qdot_text_add(&a->line, i + 1 < said ? ", " : "");
    }
    qdot_text_add(&a->line, n > 1 ? ")" : "");
}

/* gravity = g: along the last axis, downwards; gravity = (0, -g) with as many components as the scene has. False: it is
 * no field. */
static bool
suggest_gravity(assignment *a)
{
    const uint32_t n = count_dimensions(a->session);
    const char *right = qdot_text_str(&a->right);
    const bool down = *right == '-'; /* the user's vector already points gravity downwards */
    const bool whole = a->as.sum && !down;

    if (a->as.components > 1 && n > 0 && n <= 3 && a->as.components != n)
        suggest_gravity_vector(a, n);
    else if (a->as.components > 1 || n == 1)
        suggest_statement(a, "gravity", "");
    else
        qdot_text_format(&a->line, "gravity (0, %s%s%s%s%s)", n == 3 ? "0, " : "", down ? "" : "-",
                         whole ? "(" : "", right, whole ? ")" : "");
    return true;
}

/* Whether the right side is a vector though it is not written as one: it holds the position or the velocity of a thing,
 * or a name of a vector, outside the arguments of functions. */
static bool
right_side_is_vector(const assignment *a)
{
    const qdot_session *s = a->session;
    const qdot_token *at = NULL;
    const char *term;

    while ((term = qdot_definition_next_term(&a->as, &at)) != NULL) {
        const qdot_name *known = qdot_names_find(s->names, term);
        const qdot_particle *particle = qdot_scene_find_particle(s->scene, term);
        const qdot_expr e = known != NULL ? known->value : particle != NULL ? particle->position : QDOT_NIL;

        if (e != QDOT_NIL && qdot_expr_kind(s->pool, e) == QDOT_VEC)
            return true;
    }
    return false;
}

/* force = F: a vector on the first thing that has as many dimensions, a number on a coordinate. False:
 * there is none. */
static bool
suggest_force(assignment *a, const char *word)
{
    const qdot_scene *s = a->session->scene;
    const qdot_name *q = qdot_definition_coordinate(a->session);
    const char *on = q != NULL ? q->name : NULL;
    const bool vector = a->as.components > 1 || right_side_is_vector(a);
    qdot_text behind = {0};

    if (a->as.on)
        return suggest_statement(a, word, ""), true;
    if (vector)
        on = strcmp(word, "force") != 0 ? NULL
             : s->particles.n > 0       ? s->particles.at[0].name
             : s->bodies.n > 0          ? s->bodies.at[0].name
                                        : NULL;
    if (on == NULL)
        return false;
    qdot_text_format(&behind, " on %s", on);
    suggest_statement(a, word, qdot_text_str(&behind));
    qdot_text_clear(&behind);
    return true;
}

/* For `spring = k`: suggest a spring between the first particle and the origin. False: there is no particle. */
static bool
suggest_spring_or_damper(assignment *a, const char *word)
{
    static const char *const origin[] = {"", "0", "(0, 0)", "(0, 0, 0)"};
    const qdot_scene *s = a->session->scene;
    const uint32_t n = count_dimensions(a->session);

    if (s->particles.n == 0 || n > 3 || a->as.components > 1)
        return false;
    qdot_text_format(&a->line, "%s between %s, %s %s %s", word, s->particles.at[0].name, origin[n],
                     strcmp(word, "spring") == 0 ? "stiffness" : "coefficient",
                     qdot_text_str(&a->right));
    return true;
}

/* For `constraint = A = B` suggest a constraint with that equation; for `constraint = E`, with E = 0. */
static void
suggest_constraint(assignment *a)
{
    suggest_statement(a, "constraint", a->as.comparison ? "" : " = 0");
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
    const char *right = qdot_definition_word(&a->as);
    bool stated = s->lagrangian != QDOT_NIL;

    /* with arguments, as in gravity(x) = ..., the name is that of a function */
    if (!qdot_definition_is_of_name(&a->as))
        return false;
    if ((stated && (strcmp(word, "potential") == 0 || strcmp(word, "gravity") == 0)) ||
        ((strcmp(word, "lagrangian") == 0 || strcmp(word, "hamiltonian") == 0) &&
         s->particles.n + s->bodies.n > 0))
        return false;
    for (size_t i = 0; i < sizeof terms / sizeof *terms; i++)
        if (strcmp(word, terms[i]) == 0 && a->as.components == 1)
            return suggest_statement(a, word, ""), true;
    for (size_t i = 0; i < sizeof options / sizeof *options; i++)
        if (strcmp(word, options[i][0]) == 0 && right != NULL && qdot_has_word(options[i][1], right))
            return suggest_statement(a, word, ""), true;
    if (strcmp(word, "gravity") == 0)
        return !a->as.primed && suggest_gravity(a);
    if (strcmp(word, "constraint") == 0 && a->moves && a->as.components == 1)
        return suggest_constraint(a), true;
    if (strcmp(word, "force") == 0 || strcmp(word, "torque") == 0)
        return suggest_force(a, word);
    if (strcmp(word, "spring") == 0 || strcmp(word, "damper") == 0)
        return suggest_spring_or_damper(a, word);
    if (!row->alone && (a->as.range || a->as.text)) /* the statement was meant: run = 0..5, include = "x.lag" */
        return suggest_statement(a, word, ""), true;
    return false;
}
