/* export.c -- the statement `export LANGUAGE WHAT to "FILE"`: writes the motion or an expression in that language. */
#include <string.h>

#include "lang/answer/answer.h"
#include "lang/ask/ask.h"
#include "lang/declare/export-scene.h"
#include "lang/files/redirect.h"
#include "lang/language/token-text.h"
#include "lang/session/phase.h"
#include "lang/syntax/record.h"

static qdot_status carry_out_export(qdot_record *r);

QDOT_STATEMENT(export) = {
    .word = "export",
    .group = QDOT_WORKBENCH,
    .usage = "export "
#define LANGUAGE(word, title, ending, language) #word "|"
#include "show/export-languages.def"
             "latex EXPR to \"FILE\"",
    .summary = "the equations of motion as functions to call (M, f, accelerations, Jacobian, constraints, "
               "events), or an expression as a function of its symbols",
    .example = "export c eom to \"eom.c\"",
    .handler = carry_out_export,
};

static const struct language {
    const char *word, *ending;
    const qdot_export_language *source; /* writer of the language; NULL: LaTeX, which exports formulas, no program */
} languages[] = {
#define LANGUAGE(word, title, ending, language) {#word, ending, &qdot_export_##language},
#include "show/export-languages.def"
    {"latex", ".tex", NULL},
};

/* What is exported: the equations of motion, or an expression with its text. */
typedef struct {
    bool motion;
    qdot_expr value;
    qdot_text name;
} operand;

static qdot_status
read_exported_object(qdot_record *r, const struct language *l, operand *o)
{
    const qdot_filled *part = qdot_record_hole(r, NULL, "EXPR");
    qdot_session *session = r->cursor.session;

    if (l->source != NULL && qdot_filled_is_word(part, "eom") &&
        qdot_names_find(session->names, "eom") == NULL) {
        o->motion = true;
        return QDOT_OK;
    }
    QDOT_TRY(qdot_record_value(r, part, &o->value));
    qdot_token_text(session, part->from, part->to, &o->name);
    return qdot_text_status(&o->name);
}

/* Read the file name, whose ending must be that of the language. *name: the name without folder and
 * ending, in `storage`. */
static qdot_status
read_file_name(qdot_record *r, const struct language *l, const char **path, qdot_text *name)
{
    const qdot_filled *file = qdot_record_hole(r, "to", NULL);
    const char *base;
    size_t n, ending = strlen(l->ending);

    *path = qdot_record_text(file);
    qdot_record_blame(r, file);
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

/* Write an operand as a LaTeX file, as the statement `EXPR to "x.tex"` does. */
static qdot_status
write_latex(qdot_session *session, const operand *o, const char *path)
{
    qdot_redirect redirect;

    QDOT_TRY(qdot_redirect_begin(&redirect, session, path));
    return qdot_redirect_end(&redirect,
                             qdot_ask_answer(session, qdot_text_str(&o->name), o->value, QDOT_NIL));
}

/* Export the equations that runs integrate: in its phase space where the scene states H alone. */
static qdot_status
export_motion(qdot_session *session, const char *name, const qdot_export_language *language, qdot_text *source)
{
    qdot_status status = qdot_phase_begin(session, false);

    if (status == QDOT_OK)
        status = qdot_export_scene(session, name, language, source);
    qdot_phase_end(session);
    return status;
}

static qdot_status
carry_out_export(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    const struct language *l = languages;
    operand o = {0};
    qdot_text name = {0}, source = {0};
    const char *path = NULL;
    qdot_status status;

    while (qdot_record_word(r, l->word) == NULL)
        l++;
    status = read_exported_object(r, l, &o);
    if (status == QDOT_OK)
        status = read_file_name(r, l, &path, &name);
    if (status == QDOT_OK)
        qdot_record_blame(r, qdot_record_hole(r, NULL, "EXPR"));
    if (status == QDOT_OK && l->source == NULL) {
        status = write_latex(session, &o, path);
    } else if (status == QDOT_OK) {
        status = o.motion ? export_motion(session, qdot_text_str(&name), l->source, &source)
                          : qdot_export_value(session, qdot_text_str(&o.name), o.value,
                                              qdot_text_str(&name),
                                              l->source, &source);
        if (status == QDOT_OK)
            status = qdot_answer_in_file(session, path, &source);
    }
    qdot_text_clear(&o.name);
    qdot_text_clear(&name);
    qdot_text_clear(&source);
    return status;
}
