/* form.c -- tells the kind of a statement from its first tokens. */
#include "lang/syntax/form.h"

#include <string.h>

#include "base/text.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "lang/functions/builtin.h"
#include "lang/functions/quantity.h"
#include "lang/session/names.h"
#include "mech/scene/scene.h"

const qdot_statement *
qdot_statement_row(const qdot_token *word)
{
    return word->kind == QDOT_TOKEN_NAME ? qdot_statement_find(word->text) : NULL;
}

/* --- definitions of functions --------------------------------------------------------- */

bool
qdot_statement_is_free_argument(const qdot_session *session, const char *name)
{
    static const char *const reserved[] = {"pi", "true", "false", "and", "or", "not", "dt", "lambda", "delta"};
    const qdot_builtin *builtin = qdot_builtin_find(name);
    const qdot_name *q;

    if (builtin != NULL && !(builtin->flags & QDOT_BUILTIN_SHORT))
        return false;
    for (size_t i = 0; i < sizeof reserved / sizeof *reserved; i++)
        if (strcmp(name, reserved[i]) == 0)
            return false;
    if (name[0] != 'd' || name[1] == '\0')
        return true;
    q = qdot_names_find(session->names, name + 1);
    return q == NULL || q->kind != QDOT_NAME_COORD;
}

/* Whether `name` is argument number i in the definition of the function. */
static bool
is_argument_at(const qdot_session *session, const qdot_name *function, uint32_t i, const char *name)
{
    const qdot_symbol *formal;

    if (i >= qdot_expr_count(session->pool, function->formals))
        return false;
    formal = qdot_expr_symbol(session->pool, qdot_expr_arg(session->pool, function->formals, i));
    return formal != NULL && strcmp(formal->name, name) == 0;
}

/* Whether `name` is declared now, so that it could be an argument's value. */
static bool
is_declared(const qdot_session *session, const char *name)
{
    return qdot_names_find(session->names, name) != NULL ||
           qdot_scene_has_label(session->scene, name);
}

/* Whether an argument in the bracket after `name` occurs on the right side of the equation sign. */
static bool
right_side_uses_arguments(const qdot_token *name, const qdot_token *equals)
{
    for (const qdot_token *k = equals + 1; k->kind != QDOT_TOKEN_END; k++)
        for (const qdot_token *argument = name + 2; argument < equals; argument += 2)
            if (k->kind == QDOT_TOKEN_NAME && strcmp(k->text, argument->text) == 0)
                return true;
    return false;
}

/* Whether NAME(names) = RIGHT, of a function of the user's, is an equation: a declared name stands in place of its own
 * argument, or all are declared and the right side is of none of them, f(x) = 0. */
static bool
is_equation_of_function(const qdot_session *session, const qdot_name *known, const qdot_token *name, const qdot_token *equals)
{
    bool all = true, other = false;
    uint32_t i = 0;

    for (const qdot_token *k = name + 2; k < equals; k += 2, i++) {
        const bool declared = is_declared(session, k->text);

        all = all && declared;
        other = other || (declared && !is_argument_at(session, known, i, k->text));
    }
    return other || (all && !right_side_uses_arguments(name, equals));
}

/* Whether the statement begins with NAME(names) =, the definition of a function. */
static bool
defines_function(const qdot_session *session, const qdot_token *name)
{
    const qdot_builtin *builtin = qdot_builtin_find(name->text);
    const qdot_name *known = qdot_names_find(session->names, name->text);
    const qdot_token *k = name + 2;

    if (builtin != NULL && !(builtin->flags & QDOT_BUILTIN_SHORT) &&
        (known == NULL || known->kind != QDOT_NAME_UFUN))
        return false;
    for (;; k += 2) {
        if (k->kind != QDOT_TOKEN_NAME || !qdot_statement_is_free_argument(session, k->text))
            return false;
        if (!qdot_token_is(k + 1, ","))
            break;
    }
    return qdot_token_is(k + 1, ")") && qdot_token_is(k + 2, "=") &&
           !(known != NULL && known->kind == QDOT_NAME_FUNCTION && is_equation_of_function(session, known, name, k + 2));
}

/* NAME =, NAME[...] =, NAME(names) =. Behind a statement's word a bracket opens an
 * operand unless it is written close to it. */
static bool
is_definition(const qdot_session *session, const qdot_token *name, bool word)
{
    const qdot_token *next = name + 1;

    if (qdot_token_is(next, "="))
        return true;
    if (!(qdot_token_is(next, "[") || qdot_token_is(next, "(")) || (word && !next->glued))
        return false;
    if (qdot_token_is(next, "("))
        return defines_function(session, name);
    return qdot_token_is(qdot_token_behind_bracket(next), "=");
}

/* --- statements that begin with a word -------------------------------------------------- */

/* Whether a minus is a sign, as in `potential -k/x`: a blank before it, none after it. */
static bool
is_unary_minus(const qdot_token *token)
{
    return qdot_token_is(token, "-") && !token->glued && token[1].glued;
}

/* Whether the token begins the operand of a statement: a name, a number, a sign, or a bracket that is
 * not written close to the statement's word. */
static bool
begins_operand(const qdot_token *token)
{
    static const char *const words[] = {"and", "or", "to", "when", "within", "for", "at"};

    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (qdot_token_is_word(token, words[i]))
            return false;
    return token->kind == QDOT_TOKEN_NAME || token->kind == QDOT_TOKEN_NUMBER ||
           qdot_token_is(token, "sqrt") || qdot_token_is(token, "%") || (qdot_token_is(token, "(") && !token->glued) || is_unary_minus(token);
}

bool
qdot_statement_is_name(const qdot_session *session, const qdot_token *name,
                       const qdot_statement *row)
{
    static const char *const binary[] = {"*", "/",  "^",  "'", "==", "<",
                                         ">", "<=", ">=", "=", "!=", "."};
    const qdot_token *next = name + 1;
    bool declared = qdot_names_find(session->names, name->text) != NULL ||
                    qdot_names_is_family(session->names, name->text);

    /* `linearize[A]` is a value, which it is not without an index */
    if (!row->alone && qdot_quantity_find(row->word) != NULL && qdot_quantity_find(row->word)->least > 0)
        return declared || (qdot_token_is(next, "[") && next->glued);
    /* `hamiltonian` without an operand is a value; followed by an operand it is a statement */
    if (!row->alone && qdot_quantity_find(row->word) != NULL)
        return declared || !begins_operand(next);
    if (row->alone)
        return (next->kind != QDOT_TOKEN_END && !(next->kind == QDOT_TOKEN_NAME && qdot_has_word(row->usage, next->text)) &&
                !(qdot_token_is_word(next, "to") && next[1].kind != QDOT_TOKEN_OPERATOR)) ||
               declared;
    for (size_t i = 0; i < sizeof binary / sizeof *binary; i++)
        if (qdot_token_is(next, binary[i]))
            return true;
    return declared &&
           (next->kind == QDOT_TOKEN_END || qdot_token_is(next, "+") ||
            (qdot_token_is(next, "-") && !is_unary_minus(next)) ||
            ((qdot_token_is(next, "(") || qdot_token_is(next, "[")) && next->glued));
}

/* --- comparisons typed as statements ---------------------------------------------------- */

/* Whether the tokens are a comparison A == B outside of brackets, without `and`, `or`, `not`. */
static bool
is_comparison(const qdot_token *first)
{
    bool equal = false;
    int64_t depth = 0;

    for (const qdot_token *k = first; k->kind != QDOT_TOKEN_END; k++) {
        depth += qdot_token_bracket(k);
        if (depth != 0)
            continue;
        if (k->kind == QDOT_TOKEN_NAME && qdot_is_connective(k->text))
            return false;
        equal |= qdot_token_is(k, "==");
    }
    return equal;
}

/* Whether the statement begins with an unknown name that is followed by another name. */
static bool
is_unknown(const qdot_session *session, const qdot_token *name)
{
    return name->kind == QDOT_TOKEN_NAME && name[1].kind == QDOT_TOKEN_NAME &&
           !qdot_token_is_word(name + 1, "and") && !qdot_token_is_word(name + 1, "or") &&
           !qdot_token_is_word(name, "not") && !qdot_cursor_knows(session, name->text);
}

qdot_form
qdot_statement_form(const qdot_session *session, const qdot_token *first)
{
    const qdot_statement *row = qdot_statement_row(first);

    if (first->kind == QDOT_TOKEN_NAME && is_definition(session, first, row != NULL))
        return QDOT_FORM_DEFINITION;
    if (row != NULL && !qdot_statement_is_name(session, first, row))
        return QDOT_FORM_WORD;
    if (is_unknown(session, first))
        return QDOT_FORM_UNKNOWN;
    return is_comparison(first) ? QDOT_FORM_COMPARISON : QDOT_FORM_VALUE;
}
