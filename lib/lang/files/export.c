/* export.c -- the statement `export LANGUAGE WHAT to "FILE"`. */
#include <string.h>

#include "lang/answer/answer.h"
#include "lang/ask/ask.h"
#include "lang/declare/export-scene.h"
#include "lang/files/redirect.h"
#include "lang/commands/handlers.h"
#include "lang/language/read.h"
#include "lang/language/token-text.h"

enum { LATEX = -1 };

static const struct language {
    const char *word, *ending;
    int language;
} languages[] = {
    {"c", ".c", QDOT_EXPORT_C},           {"python", ".py", QDOT_EXPORT_PYTHON},
    {"julia", ".jl", QDOT_EXPORT_JULIA},  {"matlab", ".m", QDOT_EXPORT_MATLAB},
    {"octave", ".m", QDOT_EXPORT_MATLAB}, {"latex", ".tex", LATEX},
};

static qdot_status
read_language(qdot_cursor *c, const struct language **to)
{
    for (size_t i = 0; i < sizeof languages / sizeof *languages; i++)
        if (qdot_cursor_accept_word(c, languages[i].word)) {
            *to = &languages[i];
            return QDOT_OK;
        }
    (void)qdot_cursor_expected(c, "c, python, julia, matlab or latex");
    return qdot_hint("export c eom to \"eom.c\"");
}

/* What is exported: the motion, or the value of an expression with its text. */
typedef struct {
    bool motion;
    qdot_expr value;
    qdot_text name;
} operand;

static qdot_status
read_operand(qdot_cursor *c, const struct language *l, operand *o)
{
    const qdot_token *start = c->at;

    if (qdot_cursor_is_word(c, "to") && c->at[1].kind == QDOT_TOKEN_STRING) {
        (void)qdot_cursor_expected(c, "`eom` or an expression");
        return qdot_hint("export %s eom to \"eom%s\"", l->word, l->ending);
    }
    if (l->language != LATEX && qdot_cursor_is_word(c, "eom") && qdot_token_is_word(c->at + 1, "to") &&
        qdot_names_find(c->session->names, "eom") == NULL) {
        o->motion = true;
        c->at++;
        return QDOT_OK;
    }
    QDOT_TRY(qdot_read_value(c, &o->value));
    qdot_token_text(c->session, start, c->at, &o->name);
    return qdot_text_status(&o->name);
}

/* The file: its ending must be the language's. *name: without folder and ending, of `storage`. */
static qdot_status
read_file(qdot_cursor *c, const struct language *l, const char **path, qdot_text *name)
{
    const qdot_token *at;
    const char *base;
    size_t n, ending = strlen(l->ending);

    if (!qdot_cursor_accept_word(c, "to") || c->at->kind != QDOT_TOKEN_STRING) {
        (void)qdot_cursor_expected(c, "`to` and the name of a file in quotes");
        return qdot_hint("export %s eom to \"eom%s\"", l->word, l->ending);
    }
    at = c->at;
    QDOT_TRY(qdot_read_string(c, path));
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->error_at = at->start;
    base = strrchr(*path, '/') == NULL ? *path : strrchr(*path, '/') + 1;
    n = strlen(base);
    if (!qdot_ends_in(base, l->ending)) {
        (void)qdot_fail(QDOT_EINVAL, "`%.200s`: source text in %s is a `%s` file", *path, l->word,
                        l->ending);
        return qdot_hint("export %s ... to \"%.*s%s\"", l->word,
                         (int)(strchr(base, '.') == NULL ? n : strcspn(base, ".")), base, l->ending);
    }
    qdot_text_add_n(name, base, n - ending);
    return qdot_text_status(name);
}

/* As `EXPR to "x.tex"`. */
static qdot_status
write_latex(qdot_session *session, const operand *o, const char *path)
{
    qdot_redirect redirect;

    QDOT_TRY(qdot_redirect_begin(&redirect, session, path));
    return qdot_redirect_end(&redirect,
                             qdot_ask_answer(session, qdot_text_str(&o->name), o->value, QDOT_NIL));
}

qdot_status
qdot_export_statement(qdot_cursor *c)
{
    const qdot_token *start;
    const struct language *l = NULL;
    operand o = {0};
    qdot_text name = {0}, source = {0};
    const char *path = NULL;
    qdot_status status;

    QDOT_TRY(read_language(c, &l));
    start = c->at;
    status = read_operand(c, l, &o);
    if (status == QDOT_OK)
        status = read_file(c, l, &path, &name);
    if (status == QDOT_OK)
        c->error_at = start->start;
    if (status == QDOT_OK && l->language == LATEX) {
        status = write_latex(c->session, &o, path);
    } else if (status == QDOT_OK) {
        status = o.motion ? qdot_export_scene(c->session, qdot_text_str(&name),
                                              (qdot_export_language)l->language, &source)
                          : qdot_export_value(c->session, qdot_text_str(&o.name), o.value,
                                              qdot_text_str(&name),
                                              (qdot_export_language)l->language, &source);
        if (status == QDOT_OK)
            status = qdot_answer_in_file(c->session, path, &source);
    }
    qdot_text_clear(&o.name);
    qdot_text_clear(&name);
    qdot_text_clear(&source);
    return status;
}
