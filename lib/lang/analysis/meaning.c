/* meaning.c -- whether the names of an expression that is not evaluated are known. */
#include "lang/analysis/meaning.h"

#include <string.h>

#include "lang/functions/builtin.h"
#include "lang/functions/quantity.h"
#include "lang/language/enclosing.h"
#include "lang/language/hints.h"
#include "lang/session/names.h"
#include "lang/syntax/form.h"
#include "mech/scene/scene.h"
#include "mech/scene/things.h"

/* Whether runs and tables get the name by themselves: run1, sweep2, branches, hoop_bifurcations. */
static bool
is_given(const char *name)
{
    static const char *const words[] = {"branches", "residuals", "poincare", "bifurcations"};
    const size_t run = strncmp(name, "run", 3) == 0 ? 3 : strncmp(name, "sweep", 5) == 0 ? 5 : 0;

    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(name, words[i]) == 0)
            return true;
    return qdot_ends_in(name, "_bifurcations") ||
           (run > 0 && name[run] != '\0' && name[run + strspn(name + run, "0123456789")] == '\0');
}

/* The latest row of the list that has the name; NULL: none has. */
static const qdot_unknown *
find_latest(const qdot_analysis *a, const char *name)
{
    for (size_t i = a->unknown.n; i > a->forgotten; i--)
        if (strcmp(a->unknown.at[i - 1].name, name) == 0)
            return &a->unknown.at[i - 1];
    return NULL;
}

/* Whether a run may have the name: what it may be in a.x, where no other name hides it. */
static bool
may_be_run(const qdot_analysis *a, const char *name)
{
    const qdot_unknown *latest = find_latest(a, name);

    return latest != NULL ? !latest->gone : is_given(name);
}

bool
qdot_meaning_is_unknown(const qdot_analysis *a, const char *name)
{
    const bool declared = qdot_names_find(a->session->names, name) != NULL;

    for (size_t i = a->unknown.n; i > a->forgotten; i--) {
        const qdot_unknown *unknown = &a->unknown.at[i - 1];

        if (strcmp(unknown->name, name) != 0)
            continue;
        if (unknown->gone)
            return false;
        if (!unknown->label || !declared)
            return true;
    }
    return is_given(name) && !declared;
}

/* Add a row to the list: the latest of a name holds. */
static qdot_status
add_unknown_row(qdot_analysis *a, const char *name, bool label, bool gone)
{
    const qdot_unknown row = {qdot_strdup(name), label, gone};
    const qdot_status status = row.name != NULL ? qdot_vec_push(&a->unknown, row) : QDOT_ENOMEM;

    if (status != QDOT_OK)
        qdot_free(row.name);
    return status;
}

qdot_status
qdot_meaning_add_unknown(qdot_analysis *a, const char *name, bool label)
{
    if (qdot_meaning_is_unknown(a, name))
        return QDOT_OK;
    return add_unknown_row(a, name, label, false);
}

qdot_status
qdot_meaning_remove_label(qdot_analysis *a, const char *name, bool *removed)
{
    const qdot_unknown *latest = find_latest(a, name);

    *removed = latest != NULL && latest->label;
    return *removed ? add_unknown_row(a, name, false, true) : QDOT_OK;
}

/* Whether the brackets that open at `open` hold a range a..b, or one argument: max(x) is the largest value along a run. */
static bool
holds_range(const qdot_token *open, const qdot_token *to)
{
    const qdot_token *behind = qdot_token_behind_bracket(open);
    int depth = 0;
    bool one = true;

    for (const qdot_token *k = open; k < behind && k < to; k++) {
        depth += qdot_token_bracket(k);
        one = one && !(depth == 1 && qdot_token_is(k, ","));
        if (qdot_token_is(k, ".."))
            return true;
    }
    return one;
}

/* Whether the name at k calls a function that reads a run. */
static bool
reads_run(const qdot_token *k, const qdot_token *to)
{
    const qdot_builtin *builtin = qdot_builtin_find(k->text);

    if (k + 1 >= to || !qdot_token_is(k + 1, "(") || builtin == NULL)
        return false;
    if (strcmp(k->text, "max") == 0 || strcmp(k->text, "min") == 0)
        return holds_range(k + 1, to);
    return (builtin->flags & QDOT_BUILTIN_RUN) != 0;
}

static bool
is_label_of_event(const qdot_analysis *a, const char *name)
{
    const qdot_scene *scene = a->session->scene;

    for (size_t i = 0; i < scene->events.n; i++)
        if (scene->events.at[i].name != NULL && strcmp(scene->events.at[i].name, name) == 0)
            return true;
    return false;
}

bool
qdot_meaning_depends(const qdot_analysis *a, const qdot_token *from, const qdot_token *to)
{
    for (const qdot_token *k = from; k < to; k++) {
        if (qdot_token_is(k, "%") || (qdot_token_is(k, ".") && k > from && k[-1].kind == QDOT_TOKEN_NAME))
            return true;
        if (k->kind == QDOT_TOKEN_NAME &&
            (qdot_meaning_is_unknown(a, k->text) || reads_run(k, to) || is_label_of_event(a, k->text)))
            return true;
    }
    return false;
}

/* Whether a left side NAME(X, Y) may begin at the token: at the beginning of a statement, in a list of `set` or `function`. */
static bool
may_begin_left_side(const qdot_token *from, const qdot_token *k)
{
    return qdot_builtin_find(k->text) == NULL &&
           (k == from || k[-1].kind == QDOT_TOKEN_END || qdot_token_is(k - 1, "{") || qdot_token_is(k - 1, ",") ||
            qdot_token_is_word(k - 1, "set") || qdot_token_is_word(k - 1, "function"));
}

/* Whether the name at k is an argument on the left of NAME(X, Y) = ... */
static bool
is_formal(const qdot_token *from, const qdot_token *k, const qdot_token *to)
{
    const qdot_token *open = k, *close = k;

    while (open > from && (open->kind == QDOT_TOKEN_NAME || qdot_token_is(open, ",")))
        open--;
    while (close < to && (close->kind == QDOT_TOKEN_NAME || qdot_token_is(close, ",")))
        close++;
    return open > from && qdot_token_is(open, "(") && open->glued && open[-1].kind == QDOT_TOKEN_NAME &&
           may_begin_left_side(from, open - 1) && close + 1 < to &&
           qdot_token_is(close, ")") && qdot_token_is(close + 1, "=");
}

/* Whether the name at k is the index of a sum: the second argument of sum(E, K, A, B). */
static bool
is_index_of_sum(const qdot_token *from, const qdot_token *k, const qdot_token *to)
{
    int depth = 0;
    int commas = 0;

    if (k + 1 >= to || !qdot_token_is(k + 1, ","))
        return false;
    for (const qdot_token *b = k - 1; b > from; b--) {
        depth -= qdot_token_bracket(b);
        if (depth < 0)
            return commas == 1 && qdot_token_is_word(b - 1, "sum");
        commas += depth == 0 && qdot_token_is(b, ",");
    }
    return false;
}

/* Whether the name at k is an index of `for K = ..., J = ...`. */
static bool
is_index_of_loop(const qdot_token *from, const qdot_token *k, const qdot_token *to)
{
    if (k + 1 >= to || !qdot_token_is(k + 1, "="))
        return false;
    for (const qdot_token *b = k - 1; b >= from && b->kind != QDOT_TOKEN_END; b--)
        if (qdot_token_is_word(b, "for") || (b == k - 1 && qdot_token_is_word(b, "vs")))
            return true;
    return false;
}

qdot_bound_kind
qdot_meaning_binds(const qdot_token *from, const qdot_token *to, const qdot_token *k)
{
    if (k <= from || k->kind != QDOT_TOKEN_NAME)
        return QDOT_BOUND_NOT;
    if (is_formal(from, k, to) || is_index_of_sum(from, k, to))
        return QDOT_BOUND_ARGUMENT;
    return is_index_of_loop(from, k, to) ? QDOT_BOUND_LOOP : QDOT_BOUND_NOT;
}

/* Whether the name is bound anywhere within the tokens. */
static bool
is_bound(const qdot_token *from, const qdot_token *to, const char *name)
{
    for (const qdot_token *k = from + 1; k < to; k++)
        if (qdot_token_is_word(k, name) && qdot_meaning_binds(from, to, k) != QDOT_BOUND_NOT)
            return true;
    return false;
}

/* Whether the name is a differential or displacement, dtheta, of a name that is known. */
static bool
is_differential(const qdot_analysis *a, const char *name)
{
    const size_t n = name[0] == 'd' && strncmp(name, "delta", 5) != 0 ? 1 : strncmp(name, "delta", 5) == 0 ? 5 : 0;

    return n > 0 && (name[n] == '\0' || strcmp(name + n, "t") == 0 || qdot_cursor_knows(a->session, name + n) ||
                     qdot_meaning_is_unknown(a, name + n));
}

/* Whether the statement gives the name a meaning of its own. */
static bool
is_of_statement(const qdot_meaning *m, const char *name)
{
    static const struct {
        const char *statement, *option, *name;
    } rows[] = {{"sweep", "sweep", "normal"}, {"sweep", "sweep", "uniform"}, {"plot", "bode", "s"}};

    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        for (const qdot_token *k = m->from; k < m->to && strcmp(name, rows[i].name) == 0; k++)
            if (qdot_token_is_word(k, rows[i].statement) && (k == m->from || k[-1].kind == QDOT_TOKEN_END || qdot_token_is(k - 1, "{")))
                for (const qdot_token *option = k; option < m->to && option->kind != QDOT_TOKEN_END; option++)
                    if (qdot_token_is_word(option, rows[i].option))
                        return true;
    return false;
}

static bool
is_known(const qdot_meaning *m, const char *name)
{
    static const char *const words[] = {"true", "false", "infinity", "lambda", "delta", "left", "right", "I", "i"};

    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(name, words[i]) == 0)
            return true;
    return qdot_cursor_knows(m->a->session, name) || qdot_scene_is_family(m->a->session->scene, name) ||
           qdot_meaning_is_unknown(m->a, name) || is_differential(m->a, name) || is_of_statement(m, name) ||
           is_bound(m->from, m->to, name);
}

qdot_status
qdot_meaning_expression(void *data, qdot_cursor *c, const qdot_compiled *program)
{
    const qdot_meaning *m = data;

    for (size_t i = 0; i < program->code.list.n && !m->uncertain; i++) {
        const qdot_postfix *code = &program->code.list.at[i];
        const qdot_token *token = code->token;
        const bool run = code->op == QDOT_POSTFIX_MEMBER;
        const bool call = code->op == QDOT_POSTFIX_CALL || code->op == QDOT_POSTFIX_RANGE;

        if (run && !may_be_run(m->a, token->text)) {
            c->error_at = token->start;
            return qdot_hints_unknown_run(token->text);
        }
        if ((!call && code->op != QDOT_POSTFIX_NAME && code->op != QDOT_POSTFIX_INDEX_NAME) || token == NULL ||
            token->kind != QDOT_TOKEN_NAME || is_known(m, token->text) || qdot_enclosing_binds(c, token))
            continue;
        c->error_at = token->start;
        return call ? qdot_hints_unknown_function(c, token) : qdot_hints_unknown(c, token, NULL);
    }
    return QDOT_OK;
}
