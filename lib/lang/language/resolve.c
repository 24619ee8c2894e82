/* resolve.c -- what a name and name[...] mean, and primes.
 *
 * In order: what a loop or sum binds, declared names, reserved ones (pi, t, dtheta),
 * the values of the scene, labels.
 */
#include <string.h>

#include "base/text.h"
#include "base/utf8.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/tensor.h"
#include "expr/value-kind.h"
#include "lang/functions/builtin.h"
#include "lang/functions/entry.h"
#include "lang/functions/quotient.h"
#include "lang/functions/short-names.h"
#include "lang/language/enclosing.h"
#include "lang/language/evaluator.h"
#include "lang/language/hints.h"
#include "lang/session/unmade.h"
#include "lang/session/evaluation.h"
#include "lang/session/history.h"
#include "lang/session/member.h"
#include "lang/session/momenta.h"
#include "lang/session/speeds.h"
#include "lang/source/letters.h"
#include "mech/dynamics/rate.h"
#include "mech/scene/scene.h"
#include "mech/scene/things.h"
#include "mech/hamilton/phase-constraints.h"
#include "mech/hamilton/phase-symbols.h"

bool
qdot_resolve_is_function(const qdot_session *session, const char *name)
{
    const qdot_name *n = qdot_names_find(session->names, name);

    return n != NULL && (n->kind == QDOT_NAME_FUNCTION || n->kind == QDOT_NAME_UFUN);
}

qdot_status
qdot_resolve_label(qdot_session *s, const char *name, uint32_t n, const qdot_expr *index,
                   const char **label)
{
    const qdot_name *known;
    const qdot_particle *particle;
    const qdot_body *body;
    qdot_text spelled = {0};
    qdot_status status;

    *label = NULL;
    if (s->scene->particles.n + s->scene->bodies.n == 0)
        return QDOT_OK;
    known = qdot_names_find(s->names, name);
    if (known != NULL) {
        *label = n == 0 ? known->label : NULL;
        return QDOT_OK;
    }
    for (uint32_t i = 0; i < n; i++)
        if (qdot_expr_kind(s->pool, index[i]) != QDOT_NUM)
            return QDOT_OK;
    status = qdot_entry_name(s, name, n, index, &spelled);
    if (status == QDOT_OK) {
        particle = qdot_scene_find_particle(s->scene, spelled.at);
        body = qdot_scene_find_body(s->scene, spelled.at);
        *label = particle != NULL ? particle->name : body != NULL ? body->name : NULL;
    }
    qdot_text_clear(&spelled);
    return status;
}

/* --- primes: time derivatives ------------------------------------------------------- */

qdot_status
qdot_resolve_no_prime(const char *name, const char *why)
{
    qdot_fail(QDOT_ETYPE, "`%.200s` %s", name, why);
    return qdot_hint("the time derivative of an expression is ddt(...)");
}

static qdot_status
differentiate_in_time(qdot_session *s, unsigned primes, qdot_expr *value)
{
    if (primes > 0) {
        QDOT_TRY(qdot_member_refuse(s, *value));
        *value = qdot_momenta_to_velocities(s, *value);
    }
    for (; primes > 0; primes--) {
        *value = qdot_ddt(s->pool, *value);
        QDOT_TRY(qdot_value_kind_check(s->pool, *value));
    }
    return QDOT_OK;
}

qdot_status
qdot_resolve_undefined(qdot_session *s, const qdot_name *entry, unsigned primes, uint32_t n,
                       const qdot_expr *args, qdot_expr *value)
{
    const qdot_ufun *f = qdot_ufun_get(s->pool, entry->ufun);

    if (n != f->arity)
        return qdot_fail(QDOT_ETYPE, "`%.200s` takes %u argument%s, not %u", entry->name,
                         f->arity, f->arity == 1 ? "" : "s", n);
    if (primes > 0 && n != 1) {
        qdot_fail(QDOT_ETYPE, "`%.200s` has %u arguments: a prime does not say which",
                  entry->name, n);
        return qdot_hint("write diff(%.40s(...), s)", entry->name);
    }
    for (uint32_t i = 0; i < n; i++)
        if (!qdot_expr_is_scalar(s->pool, args[i]))
            return qdot_fail(QDOT_ETYPE, "`%.200s` is a function of numbers, not of %s",
                             entry->name, qdot_value_kind_words(s->pool, args[i]));
    *value = qdot_ufun_apply(s->pool, entry->ufun, args, primes > 0 ? &primes : NULL);
    return qdot_value_kind_check(s->pool, *value);
}

/* Evaluate a name that is declared or bound, followed by `primes` primes. */
static qdot_status
resolve_declared(qdot_session *s, const qdot_name *entry, unsigned primes, qdot_expr *value)
{
    *value = entry->value;
    if (entry->kind == QDOT_NAME_FUNCTION) {
        qdot_fail(QDOT_ETYPE, "`%.200s` is a function: its argument goes in ( )",
                  entry->name);
        return qdot_hint("write %.80s(...)", entry->name);
    }
    if (primes == 0)
        return QDOT_OK;
    if ((qdot_expr_is_class(s->pool, *value, QDOT_COORD) || entry->kind == QDOT_NAME_COORD) &&
        entry->kind != QDOT_NAME_VALUE && entry->kind != QDOT_NAME_ARGUMENT) {
        *value = qdot_symbol_jet(s->pool, *value, primes);
        return qdot_value_kind_check(s->pool, *value);
    }
    if (entry->kind == QDOT_NAME_VALUE || entry->kind == QDOT_NAME_ARGUMENT)
        return differentiate_in_time(s, primes, value);
    if (entry->kind == QDOT_NAME_UFUN) {
        const qdot_ufun *f = qdot_ufun_get(s->pool, entry->ufun);
        qdot_expr first = f->arity > 0 ? qdot_expr_arg(s->pool, f->formals, 0) : QDOT_NIL;

        if (f->arity != 1) {
            qdot_resolve_no_prime(entry->name, "has several arguments: a prime does not say which");
            return qdot_hint("write `diff(%.40s, s)` or `ddt(%.40s)`", entry->name,
                             entry->name);
        }
        return qdot_resolve_undefined(s, entry, primes, 1, &first, value);
    }
    return qdot_resolve_no_prime(entry->name,
                    entry->kind == QDOT_NAME_PARAM
                        ? "is a parameter: a prime goes after a coordinate"
                        : "is no coordinate: a prime goes after a coordinate");
}

/* --- names without index ------------------------------------------------------------ */

static qdot_status
resolve_reserved(const char *name, unsigned primes, bool *found, qdot_expr *value)
{
    static const struct {
        const char *name;
        qdot_expr value;
    } fixed[] = {
        {"pi", QDOT_PI}, {"t", QDOT_T}, {"true", QDOT_TRUE}, {"false", QDOT_FALSE}, {"infinity", QDOT_INFINITY}};

    *found = true;
    for (size_t i = 0; i < sizeof fixed / sizeof *fixed; i++)
        if (strcmp(name, fixed[i].name) == 0) {
            *value = fixed[i].value;
            return primes > 0 ? qdot_resolve_no_prime(name, "is no coordinate") : QDOT_OK;
        }
    *found = false;
    return QDOT_OK;
}

/* Evaluate a differential dtheta, dtheta[1] or dt, or a virtual displacement deltatheta, deltatheta[1]. */
static qdot_status
resolve_differential(qdot_session *s, const char *name, bool *found, qdot_expr *value)
{
    static const struct {
        const char *prefix;
        qdot_class class;
    } kinds[] = {{"d", QDOT_DIFFERENTIAL}, {"delta", QDOT_DELTA}};

    *found = false;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        size_t n = strlen(kinds[i].prefix);
        const qdot_name *q;

        if (strncmp(name, kinds[i].prefix, n) != 0 || name[n] == '\0')
            continue;
        if (kinds[i].class == QDOT_DIFFERENTIAL && strcmp(name + n, "t") == 0) {
            *value = qdot_symbol_of(s->pool, QDOT_DIFFERENTIAL, QDOT_T);
        } else {
            q = qdot_names_find(s->names, name + n);
            if (q == NULL || !qdot_expr_is_coordinate(s->pool, q->value) ||
                q->kind != QDOT_NAME_COORD)
                continue;
            *value = qdot_symbol_of(s->pool, kinds[i].class, q->value);
        }
        *found = true;
        return qdot_value_kind_check(s->pool, *value);
    }
    return QDOT_OK;
}

/* Evaluate the name of a particle or body: its position; with primes its velocity or acceleration. */
static qdot_status
resolve_label(qdot_session *s, const char *name, unsigned primes, bool *found,
              qdot_expr *value)
{
    *found = qdot_scene_has_label(s->scene, name);
    if (!*found)
        return QDOT_OK;
    if (qdot_scene_find_particle(s->scene, name) == NULL &&
        qdot_scene_find_body(s->scene, name) == NULL) {
        qdot_fail(QDOT_ENAME, "`%.200s` is a label without a value", name);
        for (size_t i = 0; i < s->scene->constraints.n; i++)
            if (s->scene->constraints.at[i].label != NULL && strcmp(s->scene->constraints.at[i].label, name) == 0)
                return qdot_hint("its multiplier is `lambda[%.80s]`", s->scene->constraints.at[i].name);
        return qdot_hint("only particles and bodies have a position");
    }
    *value = qdot_scene_position(s->scene, name);
    QDOT_TRY(qdot_value_kind_check(s->pool, *value));
    return differentiate_in_time(s, primes, value);
}

static qdot_status
evaluate_quantity(qdot_session *s, const qdot_quantity *row, unsigned primes, uint32_t n,
                  const qdot_expr *index, qdot_expr *value)
{
    QDOT_TRY(qdot_session_refuse_unmade(s, row->name));
    QDOT_TRY(qdot_short_names_note(s, row, row->get(s, n, index, value)));
    QDOT_TRY(qdot_value_kind_check(s->pool, *value));
    if (primes == 0 || strcmp(row->name, "p") == 0) /* p[x]' is the rate of dL/dx' */
        return differentiate_in_time(s, primes, value);
    (void)qdot_fail(QDOT_ETYPE, "`%s` is a value of the scene, no coordinate", row->name);
    return qdot_hint("write ddt(%s%s)", row->name, n > 0 ? "[...]" : "");
}

/* Find the coordinates by which the entries of a quantity are indexed; nil: by numbers only. */
static qdot_status
index_coordinates_of(qdot_session *s, const qdot_quantity *row, qdot_expr *over)
{
    *over = QDOT_NIL;
    if (!row->over_coordinates)
        return QDOT_OK;
    if (strcmp(row->name, "eom") == 0 && qdot_session_has_speeds(s))
        return qdot_session_speeds_members(s, over);
    /* there is an equation for each coordinate, but a momentum for each derivative */
    *over = qdot_list(s->pool, (uint32_t)(s->scene->coordinates.n - (strcmp(row->name, "momenta") == 0 ? 0 : s->scene->higher.n)),
                      s->scene->coordinates.at);
    return qdot_value_kind_check(s->pool, *over);
}

/* The argument that an undefined function was declared with, where nothing else is called so:
 * function x(s), then diff(x(s), s). Nil if there is none. */
static qdot_expr
bound_argument(const qdot_session *s, const char *name)
{
    const qdot_name *one;

    for (size_t i = 0; (one = qdot_names_at(s->names, i)) != NULL; i++)
        for (uint32_t k = 0;
             one->kind == QDOT_NAME_UFUN && k < qdot_expr_count(s->pool, one->formals); k++) {
            qdot_expr formal = qdot_expr_arg(s->pool, one->formals, k);

            if (qdot_expr_is_class(s->pool, formal, QDOT_FORMAL) &&
                strcmp(qdot_expr_symbol(s->pool, formal)->name, name) == 0)
                return formal;
        }
    return QDOT_NIL;
}

/* In a declaration a speed is what it is in velocities, of which the scene is made. */
static qdot_status
replace_speeds_if_declaring(qdot_session *s, qdot_expr *value)
{
    if (!s->evaluation->declares || !qdot_session_has_speeds(s))
        return QDOT_OK;
    return qdot_value_kind_give(s->pool, qdot_session_speeds_replaced(s, *value), value);
}

/* Evaluate theta[2], bob[2] or dtheta[2], given the spelling of the member. */
static qdot_status
resolve_spelled_member(qdot_session *s, const char *spelled, unsigned primes, bool *found,
                       qdot_expr *value)
{
    const qdot_name *entry = qdot_names_find(s->names, spelled);

    *found = entry != NULL;
    if (entry != NULL) {
        QDOT_TRY(resolve_declared(s, entry, primes, value));
        return replace_speeds_if_declaring(s, value);
    }
    QDOT_TRY(resolve_label(s, spelled, primes, found, value));
    if (*found)
        return QDOT_OK;
    return resolve_differential(s, spelled, found, value);
}

/* Whether a token is written with subscript characters, as x₁. */
static bool
has_subscripts(const qdot_source *source, const qdot_token *token)
{
    const char *text = source->text + token->start;

    for (size_t i = 0; i < token->length; i += qdot_utf8_length(text + i)) {
        size_t length;

        if (qdot_letters_subscript(qdot_utf8_decode(text + i, &length)) >= 0)
            return true;
    }
    return false;
}

/* Evaluate a name such as x₁: as x1; if that is not declared, as x[1] or x_1. */
static qdot_status
resolve_subscript(qdot_cursor *c, const qdot_token *token, unsigned primes, bool *found, qdot_expr *value)
{
    qdot_text spelled = {0};
    qdot_status status = QDOT_OK;

    *found = false;
    if (!has_subscripts(c->source, token))
        return QDOT_OK;
    for (unsigned form = 0; status == QDOT_OK && !*found &&
                            qdot_subscript_means(token->text, form, &spelled); form++) {
        const char *name = qdot_text_str(&spelled);

        status = qdot_text_status(&spelled);
        if (status == QDOT_OK)
            status = resolve_spelled_member(c->session, name, primes, found, value);
        if (status == QDOT_OK && !*found && primes == 0) {
            *value = bound_argument(c->session, name);
            *found = *value != QDOT_NIL;
        }
    }
    qdot_text_clear(&spelled);
    return status;
}

/* Whether the name is a coordinate that a loop holds at a value: in what is asked it is the coordinate,
 * and the value is put in at the end. */
static bool
is_held_by_loop(const qdot_session *s, const char *name)
{
    for (size_t i = 0; i < s->evaluation->held.n && !s->evaluation->declares; i++) {
        const qdot_symbol *symbol = qdot_expr_symbol(s->pool, s->evaluation->held.at[i].symbol);

        if (symbol->class == QDOT_COORD && strcmp(symbol->name, name) == 0)
            return true;
    }
    return false;
}

static qdot_expr
scalar_on_motion(qdot_pool *pool, qdot_expr e, void *scene)
{
    (void)pool;
    return qdot_rate_on_motion(scene, qdot_phase_constraints_put(scene, e));
}

/* Replace multipliers in the value at `token` by what the equations make of them, where these are asked for. */
static qdot_status
replace_multipliers_if_asked(const qdot_cursor *c, const qdot_token *token, qdot_expr *value)
{
    qdot_session *s = c->session;

    if (!(qdot_expr_node(s->pool, *value)->holds & QDOT_HAS_MULTIPLIER) || !qdot_enclosing_asks_multipliers(c, token))
        return QDOT_OK;
    return qdot_value_kind_give(s->pool, qdot_value_map(s->pool, *value, scalar_on_motion, s->scene), value);
}

/* Whether a token is the word `left` or `right` as the last argument of a call, limit(E, x = a, left). */
static bool
is_side_of_limit(const qdot_token *token)
{
    return (strcmp(token->text, "left") == 0 || strcmp(token->text, "right") == 0) && qdot_token_is(token - 1, ",") &&
           qdot_token_is(token + 1, ")");
}

qdot_status
qdot_resolve_name(qdot_cursor *c, const qdot_token *token, unsigned primes,
                  qdot_expr *value, qdot_expr *over)
{
    qdot_session *s = c->session;
    const char *name = token->text;
    const qdot_name *entry = qdot_names_find(s->names, name);
    const qdot_quantity *row;
    bool found;

    *over = QDOT_NIL;
    if (entry != NULL && entry->kind == QDOT_NAME_INDEX && is_held_by_loop(s, name))
        entry = qdot_names_declared(s->names, name);
    if (entry != NULL) {
        if (entry->kind == QDOT_NAME_VALUE) {
            QDOT_TRY(resolve_subscript(c, token, primes, &found, value));
            if (found)
                return qdot_fail(QDOT_ENAME, "`%.200s`, or what is "
                                             "printed so?", name);
        }
        *over = entry->over;
        QDOT_TRY(resolve_declared(s, entry, primes, value));
        QDOT_TRY(replace_speeds_if_declaring(s, value));
        return entry->kind == QDOT_NAME_VALUE ? replace_multipliers_if_asked(c, token, value) : QDOT_OK;
    }
    QDOT_TRY(resolve_reserved(name, primes, &found, value));
    if (found)
        return QDOT_OK;
    QDOT_TRY(resolve_differential(s, name, &found, value));
    if (found)
        return primes > 0 ? qdot_resolve_no_prime(name, "is no coordinate") : QDOT_OK;
    row = qdot_quantity_find(name);
    if (row != NULL && row->least == 0) {
        QDOT_TRY(evaluate_quantity(s, row, primes, 0, NULL, value));
        return index_coordinates_of(s, row, over);
    }
    QDOT_TRY(resolve_label(s, name, primes, &found, value));
    if (found)
        return QDOT_OK;
    *value = bound_argument(s, name);
    if (*value != QDOT_NIL)
        return primes > 0 ? qdot_resolve_no_prime(name, "is no coordinate") : QDOT_OK;
    QDOT_TRY(resolve_subscript(c, token, primes, &found, value));
    if (found)
        return QDOT_OK;
    if (qdot_names_is_family(s->names, name)) {
        qdot_fail(QDOT_ENAME, "`%.200s` is a family", name);
        return qdot_hint("write %.80s[1]", name);
    }
    if (qdot_builtin_find(name) != NULL &&
        !(qdot_builtin_find(name)->flags & QDOT_BUILTIN_SHORT))
        return qdot_hints_bare_function(c, token);
    if (is_side_of_limit(token) || (primes == 0 && qdot_enclosing_binds(c, token))) {
        *value = qdot_symbol_get(s->pool, QDOT_FORMAL, name);
        return qdot_value_kind_check(s->pool, *value);
    }
    if (primes == 0 && qdot_quotient_is_laplace(s, name)) {
        *value = qdot_quotient_laplace(s);
        return qdot_value_kind_check(s->pool, *value);
    }
    return qdot_hints_unknown(c, token, NULL);
}

/* --- names with an index ------------------------------------------------------------ */

/* Whether all indices contain numbers and parameters only: no coordinates, no labels. */
static bool
are_integer_indices(qdot_session *s, uint32_t n, const qdot_expr *index)
{
    const uint32_t constant = QDOT_HAS_PARAM | QDOT_HAS_FUN;

    for (uint32_t i = 0; i < n; i++)
        if (!qdot_expr_is_scalar(s->pool, index[i]) ||
            (qdot_expr_node(s->pool, index[i])->holds & ~constant) != 0)
            return false;
    return true;
}

/* Whether p[q] beside this quantity or function is the momentum as a symbol. */
static bool
is_word_of_momenta(const char *word)
{
    const qdot_builtin *function = qdot_builtin_find(word);

    return strcmp(word, "hamiltonian") == 0 || strcmp(word, "H") == 0 ||
           (function != NULL && (function->flags & QDOT_BUILTIN_MOMENTA));
}

/* Whether `t` is written in momenta: hamiltonian, routhian, poisson(...), rate(...), or a name, or a value
 * of before, in which momenta stand. */
static bool
is_independent_momentum(const qdot_session *s, const qdot_token *t)
{
    const qdot_name *entry;
    qdot_expr e = QDOT_NIL;

    if (t->kind == QDOT_TOKEN_NAME) {
        entry = qdot_names_find(s->names, t->text);
        if (entry == NULL)
            return is_word_of_momenta(t->text) ||
                   (s->scene->hamiltonian != QDOT_NIL && strcmp(t->text, "eom") == 0);
        e = entry->value;
    } else if (t->kind == QDOT_TOKEN_OPERATOR && strcmp(t->text, "%") == 0) {
        e = s->history->values.n > 0 ? s->history->values.at[s->history->values.n - 1] : QDOT_NIL;
    }
    return e != QDOT_NIL && (qdot_expr_node(s->pool, e)->holds & QDOT_HAS_MOMENTUM);
}

/* Whether the statement is NAME = ..., NAME[...] = ..., NAME(...) = ... */
static bool
is_definition(const qdot_token *name)
{
    const qdot_token *next = name + 1;
    int64_t depth = 0;

    if (name->kind != QDOT_TOKEN_NAME || next->kind != QDOT_TOKEN_OPERATOR)
        return false;
    if (qdot_token_bracket(next) == 1 && next->glued)
        do {
            depth += qdot_token_bracket(next);
            next++;
        } while (depth > 0 && next->kind != QDOT_TOKEN_END);
    return qdot_token_is(next, "=");
}

/* Whether the statement is `check conserved ...`: momenta have rates of their own. */
static bool
is_claim_of_conservation(const qdot_token *first)
{
    return qdot_token_is_word(first, "check") &&
           (qdot_token_is_word(first + 1, "conserved") ||
            (qdot_token_is_word(first + 1, "not") && qdot_token_is_word(first + 2, "conserved")));
}

/* Whether the statement of `token` is written in momenta: then p[q] is the independent symbol. A
 * definition keeps it; so does what stands beside something canonical. */
static bool
stands_beside_momenta(const qdot_cursor *c, const qdot_token *token)
{
    const qdot_token *first = qdot_enclosing_statement(c, token);

    if (is_definition(first) || is_claim_of_conservation(first) || qdot_phase_space_needed(c->session->scene))
        return true;
    for (token = first; token->kind != QDOT_TOKEN_END; token++)
        if (is_independent_momentum(c->session, token) ||
            (qdot_token_is_word(token, "p") && qdot_token_is(token + 1, "[") && qdot_enclosing_is_variable(first, token)))
            return true;
    return false;
}

/* Evaluate p[theta] as an independent variable of the Hamiltonian; with a prime its rate. */
static qdot_status
resolve_independent_momentum(qdot_session *s, qdot_expr q, unsigned primes, qdot_expr *value)
{
    if (s->scene->higher.n > 0 && qdot_expr_is_class(s->pool, q, QDOT_COORD))
        q = qdot_higher_in_jets(s->scene, q); /* p[x'] is a momentum too */
    else if (!qdot_expr_is_coordinate(s->pool, q))
        return qdot_fail(QDOT_ETYPE, "p[ ] takes a coordinate");
    *value = qdot_symbol_jet(s->pool, qdot_symbol_of(s->pool, QDOT_MOMENTUM, q), primes);
    return qdot_value_kind_check(s->pool, *value);
}

/* eom[theta], mass_matrix[a, b]; eom[1] is the first of the list. equilibria[1] is asked of the quantity itself, which
 * tells the conditions of its members. */
static qdot_status
evaluate_quantity_entry(qdot_session *s, const qdot_quantity *row, unsigned primes, uint32_t n,
                        const qdot_expr *index, qdot_expr *value)
{
    const bool by_number = row->most == 1 && !row->over_coordinates && n == 1;

    if (row->least == 0 && (row->most == 0 || (are_integer_indices(s, n, index) && !by_number))) {
        QDOT_TRY(evaluate_quantity(s, row, primes, 0, NULL, value));
        return qdot_entry_of(s, *value, QDOT_NIL, n, index, value);
    }
    if ((int)n < row->least || (int)n > row->most)
        return qdot_fail(QDOT_ETYPE, "`%s[ ]` takes %d ind%s, not %u", row->name,
                         row->most, row->most == 1 ? "ex" : "ices", n);
    return evaluate_quantity(s, row, primes, n, index, value);
}

/* Whether name[...] could be a family member: theta[1], bob[1], dtheta[1], deltatheta[1]. */
static bool
may_be_family(const qdot_session *s, const char *name)
{
    const qdot_name *entry = qdot_names_find(s->names, name);

    if (entry != NULL &&
        (entry->kind == QDOT_NAME_INDEX || entry->kind == QDOT_NAME_ARGUMENT))
        return false; /* a function argument hides the family of that name */
    if (qdot_names_is_family(s->names, name))
        return true;
    if (entry != NULL)
        return false;
    return qdot_scene_is_family(s->scene, name) ||
           (name[0] == 'd' && qdot_names_is_family(s->names, name + 1)) ||
           (strncmp(name, "delta", 5) == 0 && qdot_names_is_family(s->names, name + 5));
}

static qdot_status
report_unknown_member(qdot_cursor *c, const qdot_token *token, const char *spelled)
{
    const qdot_name *other = qdot_names_first_member(c->session->names, token->text);

    if (!qdot_names_is_family(c->session->names, token->text))
        return qdot_hints_unknown(c, token, spelled);
    qdot_fail(QDOT_ENAME,
              "`%.200s` is not declared, though other members of its family are",
              spelled);
    if (other == NULL || (other->kind != QDOT_NAME_PARAM && other->kind != QDOT_NAME_COORD))
        return QDOT_ENAME;
    return qdot_hint("`%s %.100s` declares it", other->kind == QDOT_NAME_PARAM ? "param" : "coord",
                     spelled);
}

/* Evaluate name[...] as a family member: theta[1], bob[1], dtheta[1]; *found: it is one. */
static qdot_status
resolve_member(qdot_cursor *c, const qdot_token *token, unsigned primes, uint32_t n,
               const qdot_expr *index, bool *found, qdot_expr *value)
{
    qdot_session *s = c->session;
    qdot_text spelled = {0};
    qdot_status status;

    *found = false;
    if (!may_be_family(s, token->text))
        return QDOT_OK;
    status = qdot_entry_name(s, token->text, n, index, &spelled);
    if (status == QDOT_OK)
        status = resolve_spelled_member(s, spelled.at, primes, found, value);
    if (status == QDOT_OK && !*found && qdot_names_is_family(s->names, token->text))
        status = report_unknown_member(c, token, spelled.at);
    qdot_text_clear(&spelled);
    return status;
}

/* Fail with QDOT_ENAME: neither the family member nor the family has been declared. */
static qdot_status
report_unknown_index(qdot_cursor *c, const qdot_token *token, uint32_t n, const qdot_expr *index)
{
    qdot_text spelled = {0};
    qdot_status status;

    for (uint32_t i = 0; i < n; i++)
        if (qdot_expr_kind(c->session->pool, index[i]) != QDOT_NUM)
            return qdot_hints_unknown(c, token, NULL);
    status = qdot_entry_name(c->session, token->text, n, index, &spelled);
    if (status == QDOT_OK)
        status = qdot_hints_unknown(c, token, spelled.at);
    qdot_text_clear(&spelled);
    return status;
}

qdot_status
qdot_resolve_index(qdot_cursor *c, const qdot_token *token, unsigned primes, uint32_t n,
                   const qdot_expr *index, qdot_expr *value)
{
    qdot_session *s = c->session;
    const char *name = token->text;
    const qdot_quantity *row = qdot_quantity_find(name);
    const qdot_name *entry = qdot_names_find(s->names, name);
    qdot_expr whole, over;
    bool found;

    /* p[theta] is the momentum even if a plain p is declared */
    if (row != NULL && strcmp(name, "p") == 0 && n == 1 && primes <= 1 &&
        (entry == NULL || !are_integer_indices(s, n, index)) && stands_beside_momenta(c, token))
        return resolve_independent_momentum(s, index[0], primes, value);
    if (row != NULL && row->least > 0 && !(entry || qdot_scene_is_family(s->scene, name))) {
        QDOT_TRY(evaluate_quantity_entry(s, row, primes, n, index, value));
        return replace_multipliers_if_asked(c, token, value);
    }
    if (row != NULL && row->least > 0 && !are_integer_indices(s, n, index)) {
        QDOT_TRY(evaluate_quantity_entry(s, row, primes, n, index, value));
        return replace_multipliers_if_asked(c, token, value);
    }
    QDOT_TRY(resolve_member(c, token, primes, n, index, &found, value));
    if (found)
        return QDOT_OK;
    if (entry != NULL || row == NULL) {
        if (entry == NULL && !qdot_scene_has_label(s->scene, name)) {
            if (qdot_builtin_find(name) != NULL)
                return qdot_hints_bare_function(c, token);
            return report_unknown_index(c, token, n, index);
        }
        QDOT_TRY(qdot_resolve_name(c, token, 0, &whole, &over));
        if (qdot_expr_is_scalar(s->pool, whole))
            return qdot_fail(QDOT_ETYPE, "`%.200s` is a number: it has no entries", name);
        QDOT_TRY(qdot_entry_of(s, whole, over, n, index, value));
        return differentiate_in_time(s, primes, value);
    }
    return evaluate_quantity_entry(s, row, primes, n, index, value);
}
