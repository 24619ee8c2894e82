/* usage-read.c -- finds what may come next in a statement, from its usage and the tokens so far. */
#include "lang/syntax/usage.h"

static void
add_state(qdot_usage *u, int node, bool inside, uint64_t taken)
{
    const qdot_usage_node *at = &u->node[node];

    for (int i = 0; i < u->states; i++)
        if (u->state[i].node == node && u->state[i].inside == inside &&
            u->state[i].taken == taken)
            return;
    if (u->states >= QDOT_USAGE_STATES)
        return; /* beyond this number of states some possible continuations are not offered */
    u->state[u->states++] = (qdot_usage_state){node, inside, taken};
    if (inside) {
        if (u->operand)
            add_state(u, at->next, false, taken);
    } else if (at->kind == QDOT_USAGE_FORK) {
        const bool missing = at->needs != 0 && (taken & at->needs) == 0;

        taken &= ~at->forgets;
        if ((taken & (at->enters | at->needs | at->later)) == 0)
            add_state(u, at->next, false, taken | at->enters);
        if (at->other >= 0 && !(missing && u->node[at->other].needs != at->needs))
            add_state(u, at->other, false, taken);
    }
}

bool
qdot_usage_begin(qdot_usage *u, const char *word, const char *usage, bool answers)
{
    if (!qdot_usage_compile(u, word, usage, answers ? "[to \"FILE\"] [for NAME = A..B, NAME = A..B, ...]"
                                                    : "[for NAME = A..B, NAME = A..B, ...]"))
        return false;
    u->suits = NULL;
    add_state(u, 0, false, 0);
    return true;
}

static bool
is_connective(const qdot_token *token)
{
    return qdot_token_is_word(token, "and") || qdot_token_is_word(token, "or") ||
           qdot_token_is_word(token, "not");
}

/* Whether a token continues the expression in a placeholder: it follows an operator, or is one. */
static bool
continues_expression(const qdot_usage *u, const qdot_usage_node *hole, const qdot_token *token)
{
    if (token->kind == QDOT_TOKEN_END || qdot_token_is(token, ",") ||
        qdot_token_is(token, ":") || qdot_token_is(token, "|"))
        return false;
    if (qdot_token_is(token, "=") && u->node[hole->next].kind == QDOT_USAGE_SIGN)
        return false; /* an equals sign of the usage, as in NAME = VALUE */
    if (!u->operand || is_connective(token))
        return true;
    if (token->kind == QDOT_TOKEN_OPERATOR && strchr("([", token->text[0]) != NULL)
        return token->glued;
    return token->kind == QDOT_TOKEN_OPERATOR ||
           (token->kind == QDOT_TOKEN_NUMBER && token->glued &&
            qdot_token_is(token - 1, "%"));
}

/* Whether the token may be the first one of the expression or name in a placeholder. */
static bool
may_begin_placeholder(const qdot_usage *u, const qdot_usage_node *hole, const qdot_token *token)
{
    return token->kind != QDOT_TOKEN_END && !qdot_token_is(token, ",") &&
           !qdot_token_is(token, ":") && !qdot_token_is(token, "=") &&
           (u->suits == NULL || u->suits(u->user, hole, token));
}

/* Whether an operand ends with the token, or with the pair of brackets that it opens. */
static bool
token_ends_operand(const qdot_token *token)
{
    if (token->kind != QDOT_TOKEN_OPERATOR)
        return token->kind != QDOT_TOKEN_END && !is_connective(token);
    return strchr("([{)]}'%", token->text[0]) != NULL;
}

/* Whether the token is the word or sign that this state of the usage automaton expects. */
static bool
is_expected_token(const qdot_usage *u, const qdot_usage_state *state, const qdot_token *token)
{
    const qdot_usage_node *at = &u->node[state->node];
    const bool same = (at->kind == QDOT_USAGE_WORD && token->kind == QDOT_TOKEN_NAME) ||
                      (at->kind == QDOT_USAGE_SIGN && token->kind == QDOT_TOKEN_OPERATOR);

    return same && !state->inside && strcmp(at->text, token->text) == 0;
}

static void
advance_states(qdot_usage *u, const qdot_token *token)
{
    qdot_usage_state old[QDOT_USAGE_STATES];
    const int n = u->states;
    const bool operand = u->operand, after = token_ends_operand(token);
    bool word = false; /* whether the token is a word of the usage, and so does not begin an expression */

    memcpy(old, u->state, sizeof *old * (size_t)n);
    u->states = 0;
    for (int i = 0; i < n; i++)
        word = word || (u->node[old[i].node].kind == QDOT_USAGE_WORD &&
                        is_expected_token(u, &old[i], token));
    for (int i = 0; i < n; i++) {
        const qdot_usage_node *at = &u->node[old[i].node];

        u->operand = operand;
        if (at->kind == QDOT_USAGE_HOLE &&
            (old[i].inside ? continues_expression(u, at, token) : may_begin_placeholder(u, at, token) && !word)) {
            u->operand = after;
            add_state(u, old[i].node, true, old[i].taken);
        } else if (is_expected_token(u, &old[i], token)) {
            u->operand = after;
            add_state(u, at->next, false, old[i].taken);
        }
    }
    u->operand = after;
}

void
qdot_usage_read(qdot_usage *u, const qdot_token *from, const qdot_token *to)
{
    while (from < to) {
        int depth = 0;

        advance_states(u, from);
        do {
            depth += qdot_token_bracket(from);
            from++;
        } while (depth > 0 && from < to);
    }
}

bool
qdot_usage_takes(const qdot_usage *u, const char *word)
{
    const qdot_token token = {.kind = QDOT_TOKEN_NAME, .text = word};

    for (int i = 0; i < u->states; i++)
        if (u->node[u->state[i].node].kind == QDOT_USAGE_WORD && is_expected_token(u, &u->state[i], &token))
            return true;
    return false;
}

bool
qdot_usage_is_whole(const qdot_usage *u)
{
    for (int i = 0; i < u->states; i++)
        if (u->node[u->state[i].node].kind == QDOT_USAGE_END)
            return true;
    return false;
}
