/* token-text.c -- writes tokens as a person would type them. */
#include "lang/language/token-text.h"

#include <string.h>

#include "expr/print-name.h"
#include "expr/print.h"
#include "lang/language/evaluator.h"
#include "lang/source/letters.h"

/* Whether a sign after this token stands between two operands. */
static bool
sign_follows_operand(const qdot_token *token)
{
    if (token->kind == QDOT_TOKEN_NAME)
        return !qdot_token_is_word(token, "and") && !qdot_token_is_word(token, "or") &&
               !qdot_token_is_word(token, "not");
    return token->kind == QDOT_TOKEN_NUMBER || token->kind == QDOT_TOKEN_STRING ||
           qdot_token_is(token, ")") || qdot_token_is(token, "]") || qdot_token_is(token, "'") ||
           qdot_token_is(token, "%");
}

static bool
is_spaced_sign(const qdot_token *token)
{
    static const char *const spaced[] = {"+", "-", "=", "==", "<", ">", "<=", ">=", "!="};

    for (size_t i = 0; i < sizeof spaced / sizeof *spaced; i++)
        if (qdot_token_is(token, spaced[i]))
            return true;
    return false;
}

/* Whether the token is a word between claims, behind which a bracket holds a claim or an expression, no argument. */
static bool
is_joining_word(const qdot_token *token)
{
    static const char *const words[] = {"and", "or", "not", "conserved", "when", "within"};

    for (size_t i = 0; token->kind == QDOT_TOKEN_NAME && i < sizeof words / sizeof *words; i++)
        if (qdot_token_is_word(token, words[i]))
            return true;
    return false;
}

/* Whether the name is a coordinate to which a loop assigns a value at present. */
static bool
is_coordinate_set_by_loop(const qdot_session *session, const char *name)
{
    const qdot_name *known = qdot_names_declared(session->names, name);

    return known != NULL && known->kind == QDOT_NAME_COORD;
}

/* Append the value of a loop index in place of its name; false if the token is not a loop index. */
static bool
add_index_value(qdot_session *session, const qdot_token *token, qdot_text *out)
{
    const qdot_name *name = token->kind == QDOT_TOKEN_NAME
                                ? qdot_names_find(session->names, token->text)
                                : NULL;
    qdot_text value = {0};
    bool printed, whole;

    if (name == NULL || name->kind != QDOT_NAME_INDEX || is_coordinate_set_by_loop(session, token->text))
        return false;
    printed = qdot_print(session->pool, name->value, QDOT_PLAIN, &value) == QDOT_OK;
    whole = strspn(qdot_text_str(&value), "0123456789") == value.n;
    if (printed)
        qdot_text_format(out, whole ? "%s" : "(%s)", qdot_text_str(&value));
    qdot_text_clear(&value);
    return printed;
}

/* Append x₁ as x[1] or x_1, whichever is declared; false if neither is. */
static bool
add_subscripted_name(const qdot_session *session, const qdot_token *token, qdot_text *out)
{
    qdot_text spelled = {0};
    bool is = false;

    if (token->kind == QDOT_TOKEN_NAME && token->length != strlen(token->text) &&
        qdot_names_find(session->names, token->text) == NULL)
        for (unsigned form = 0;
             !is && qdot_subscript_means(token->text, form, &spelled); form++)
            is = qdot_names_find(session->names, qdot_text_str(&spelled)) != NULL;
    qdot_text_add(out, is ? qdot_text_str(&spelled) : "");
    qdot_text_clear(&spelled);
    return is;
}

/* Signs that the letters at hand cannot say: ½, √2, sin²(x). False: there are none here; *used: how
 * many tokens they are. */
static bool
add_sign(const qdot_token *k, const qdot_token *to, qdot_text *out, size_t *used)
{
    static const char *const raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};

    *used = 1;
    if (k->kind == QDOT_TOKEN_NUMBER && strchr(k->text, '/') != NULL) {
        qdot_text_format(out, "(%s)", k->text);
        return true;
    }
    if (qdot_token_is(k, "sqrt")) {
        qdot_text_add(out, k + 1 < to && qdot_token_is(k + 1, "(") ? "sqrt" : "√");
        return true;
    }
    if (!qdot_token_is(k, "^") || k + 2 >= to || k[1].start != k->start ||
        !qdot_token_is(k + 2, "("))
        return false;
    for (const char *digit = k[1].text; *digit != '\0'; digit++)
        qdot_text_add(out, raised[*digit - '0']);
    *used = 2;
    return true;
}

/* Append tokens as text; with `indices` the present values of loop indices replace their names. */
static void
write_tokens(qdot_session *session, const qdot_token *from, const qdot_token *to,
             bool indices, qdot_text *out)
{
    int depth = 0, member = 0; /* bracket depth; depth of the brackets of an index x[1,2], or 0 */

    for (const qdot_token *k = from; k < to; k++) {
        bool binary = k > from && sign_follows_operand(k - 1) && is_spaced_sign(k);
        bool words = k > from && k->kind != QDOT_TOKEN_OPERATOR &&
                     (k[-1].kind != QDOT_TOKEN_OPERATOR || sign_follows_operand(k - 1));
        size_t used;

        if (words && qdot_token_is(k - 1, "%"))
            words = false;
        if (qdot_token_is(k, "[") && k > from && !k->glued && sign_follows_operand(k - 1))
            words = true; /* a unit */
        if (qdot_token_is(k, "(") && k > from && !k->glued && is_joining_word(k - 1))
            words = true;
        if (k > from && qdot_cursor_is_shown_product(&(qdot_cursor){.session = session}, k, depth > 0))
            qdot_text_char(out, '*');
        else
            qdot_text_add(out, binary || words ? " " : "");
        if (k->kind == QDOT_TOKEN_STRING)
            qdot_text_format(out, "\"%s\"", k->text);
        else if (add_sign(k, to, out, &used))
            k += used - 1;
        else if (!(indices && add_index_value(session, k, out)) && !add_subscripted_name(session, k, out))
            qdot_text_add(out, k->text);
        if (qdot_token_is(k, "[") || qdot_token_is(k, "(")) {
            depth++;
            if (member == 0 && k > from && k[-1].kind == QDOT_TOKEN_NAME &&
                qdot_names_is_family(session->names, k[-1].text))
                member = depth;
        } else if (qdot_token_is(k, "]") || qdot_token_is(k, ")")) {
            if (member == depth--)
                member = 0;
        }
        if (binary || (qdot_token_is(k, ",") && member == 0 && k + 1 < to) ||
            (qdot_token_is(k, ";") && k + 1 < to && !qdot_token_is(k + 1, "]")))
            qdot_text_char(out, ' ');
    }
}

void
qdot_token_text(qdot_session *session, const qdot_token *from, const qdot_token *to,
                qdot_text *out)
{
    write_tokens(session, from, to, true, out);
}

void
qdot_token_text_written(qdot_session *session, const qdot_token *from, const qdot_token *to,
                        qdot_text *out)
{
    write_tokens(session, from, to, false, out);
}
