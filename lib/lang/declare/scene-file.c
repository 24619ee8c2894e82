/* scene-file.c -- writes all declarations of a scene as the statements that make them again. */
#include "lang/declare/scene-file.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/unit.h"
#include "lang/answer/answer.h"
#include "lang/declare/session-file.h"
#include "lang/declare/session-remarks.h"
#include "lang/language/function.h"
#include "lang/language/read.h"
#include "lang/language/token-text.h"
#include "lang/session/history.h"
#include "lang/session/measured.h"
#include "lang/session/output.h"
#include "lang/session/phase.h"
#include "lang/session/runs.h"
#include "lang/session/speeds.h"
#include "lang/session/typed.h"
#include "lang/session/units.h"
#include "lang/session/values.h"
#include "lang/source/source.h"
#include "lang/syntax/mention.h"

bool
qdot_scene_file_is(const char *path)
{
    const char *dot = strrchr(path, '.');

    return dot != NULL && strcmp(dot, ".lag") == 0;
}

static qdot_status
append_text_and_expression(qdot_session *s, const char *before, qdot_expr e, qdot_text *out)
{
    qdot_text_add(out, before);
    return qdot_print(s->pool, e, QDOT_PLAIN, out);
}

/* --- writing definitions -------------------------------------------------------------- */

/* Write `param m > 0`, `function x(s, t)`, `coord theta` in order of declaration, which is also
 * that of terms. */
static qdot_status
append_declarations(qdot_session *s, qdot_text *out)
{
    const qdot_name *name;

    for (size_t i = 0; (name = qdot_names_at(s->names, i)) != NULL; i++) {
        if (name->kind == QDOT_NAME_UFUN && name->body != NULL) {
            qdot_text_add(out, "data ");
            qdot_token_text(s, name->body->from, name->body->to, out);
        } else if (name->kind == QDOT_NAME_UFUN) {
            QDOT_TRY(append_text_and_expression(s, "function ", name->value, out));
        } else if (name->kind == QDOT_NAME_SPEED) {
            qdot_text_format(out, "speed %s = ", name->name);
            QDOT_TRY(append_text_and_expression(s, "", qdot_expr_arg(s->pool, name->formals, 0), out));
        } else if ((name->kind == QDOT_NAME_PARAM || name->kind == QDOT_NAME_COORD)
                   && qdot_scene_state_of(s->scene, name->value) == NULL) { /* states come with the scene's things */
            qdot_text_add(out, name->kind == QDOT_NAME_PARAM ? "param " : "coord ");
            QDOT_TRY(qdot_scene_print_domain(s->scene, name->value, out));
            qdot_units_in_brackets(s, name->value, out);
        } else {
            continue;
        }
        qdot_text_char(out, '\n');
    }
    return QDOT_OK;
}

/* Parse a text as the right side of a definition, in which momenta are kept as momenta. */
static qdot_status
parse_definition_text(const qdot_text *text, qdot_source **source)
{
    qdot_text line = {0};
    qdot_status status;
    size_t at;

    qdot_text_format(&line, "it = %s", qdot_text_str(text));
    status = qdot_text_status(&line);
    if (status == QDOT_OK)
        status = qdot_source_new("a definition", qdot_text_str(&line), line.n, source, &at);
    qdot_text_clear(&line);
    return status;
}

/* Whether a definition's text evaluates to exactly this value, indexed by the same coordinates, where no linear motion has
 * been asked for. */
static qdot_status
evaluates_to_value(qdot_session *s, const qdot_text *text, qdot_expr value, qdot_expr over, bool *is)
{
    const qdot_linear linear = s->history->linear;
    const size_t unit_facts = s->units->facts.n;
    qdot_source *source = NULL;
    qdot_expr read = QDOT_NIL, its_over = QDOT_NIL;
    qdot_status status;

    *is = false;
    QDOT_TRY(qdot_text_status(text));
    s->history->linear = (qdot_linear){0};
    status = parse_definition_text(text, &source);
    if (status == QDOT_OK) {
        qdot_cursor c = {.session = s, .source = source, .at = source->tokens.at + 2};

        status = qdot_read_named(&c, &read, &its_over);
        *is = status == QDOT_OK && qdot_cursor_is_end(&c) && read == value &&
              its_over == over;
    }
    qdot_source_free(source);
    s->history->linear = linear;
    qdot_units_back_to(s, unit_facts);
    (void)!qdot_pool_check(s->pool); /* clear the failure: that a text cannot be evaluated here is no error */
    return qdot_grave(status);
}

/* Whether a definition's text means the same at any later time: it does not contain `%`, the latest value. */
static bool
has_lasting_meaning(const qdot_function_body *body)
{
    return !qdot_mention_is_in(body->from, body->to, "%");
}

enum { VALUE, SAID, FORMS };

/* Write the right side of a definition in the form number `form`; write nothing if it does not have that form. */
static qdot_status
append_definition_form(qdot_session *s, const qdot_name *name, qdot_expr value, int form, qdot_text *out)
{
    if (form == SAID) {
        if (name->body != NULL && has_lasting_meaning(name->body))
            qdot_token_text(s, name->body->from, name->body->to, out);
        return QDOT_OK;
    }
    return qdot_print(s->pool, value, QDOT_PLAIN, out);
}

/* Write a definition in the first form that evaluates to its value again; *is: there is one. */
static qdot_status
append_first_valid_form(qdot_session *s, const qdot_name *name, qdot_expr value, qdot_expr over,
                        qdot_text *out, bool *is)
{
    qdot_status status = QDOT_OK;

    for (int form = 0; form < FORMS && status == QDOT_OK && !*is; form++) {
        qdot_text right = {0};

        status = append_definition_form(s, name, value, form, &right);
        if (status == QDOT_OK && right.n > 0)
            status = evaluates_to_value(s, &right, value, over, is);
        if (status == QDOT_OK && *is)
            qdot_text_format(out, "%s = %s\n", name->name, qdot_text_str(&right));
        qdot_text_clear(&right);
    }
    return status;
}

static qdot_status
append_definition(qdot_session *s, const qdot_name *name, qdot_text *lost, qdot_text *out)
{
    const qdot_expr value = name->value;
    bool is = false;

    if (qdot_measured_occurs(s, value))
        return QDOT_OK; /* its value comes from a run: written by lang/declare/session-file */
    QDOT_TRY(append_first_valid_form(s, name, value, name->over, out, &is));
    if (!is && name->over != QDOT_NIL) /* try again with a value whose entries are indexed by numbers */
        QDOT_TRY(append_first_valid_form(s, name, value, QDOT_NIL, out, &is));
    if (is)
        return QDOT_OK;
    qdot_text_format(lost, "# %s: no statement gives this value\n", name->name);
    return qdot_answer_notice(s, "`%.200s` is not written: no statement gives its value again",
                              name->name);
}

static qdot_status
append_definitions(qdot_session *s, qdot_text *lost, qdot_text *out)
{
    const qdot_name *name;

    for (size_t i = 0; (name = qdot_names_at(s->names, i)) != NULL; i++) {
        if (name->kind == QDOT_NAME_FUNCTION) {
            QDOT_TRY(qdot_function_print(s, name, out));
            qdot_text_char(out, '\n');
        } else if (name->kind == QDOT_NAME_VALUE) {
            QDOT_TRY(append_definition(s, name, lost, out));
        }
    }
    return QDOT_OK;
}

/* --- writing values and start --------------------------------------------------------- */

/* Write the line `WORD SYMBOL = VALUE`, ended by `last`. */
static qdot_status
append_value_line(qdot_session *s, const char *word, qdot_expr symbol, qdot_expr value, const char *last, bool remarks,
                  qdot_text *out)
{
    const size_t from = out->n;

    QDOT_TRY(append_text_and_expression(s, word, symbol, out));
    QDOT_TRY(append_text_and_expression(s, " = ", value, out));
    qdot_text_add(out, last);
    if (remarks)
        qdot_session_remarks_end_line(s, value, s->runs->n, from, out);
    else
        qdot_text_char(out, '\n');
    return QDOT_OK;
}

/* Whether a function that was set has its values from a table: its statement `data` is written. */
static bool
is_function_of_data(const qdot_session *s, qdot_expr symbol)
{
    const qdot_name *name = qdot_expr_kind(s->pool, symbol) == QDOT_UFUN
                                ? qdot_names_find(s->names, qdot_ufun_get(s->pool, qdot_expr_node(s->pool, symbol)->op)->name)
                                : NULL;

    return name != NULL && name->kind == QDOT_NAME_UFUN && name->body != NULL;
}

static qdot_status
append_value_lines(qdot_session *s, const char *word, size_t n, const qdot_expr *symbols,
                   const qdot_expr *values, bool remarks, qdot_text *out)
{
    for (size_t i = 0; i < n; i++)
        if (qdot_unit_symbol_base(s->pool, symbols[i]) < 0 /* a unit is always 1 */
            && !is_function_of_data(s, symbols[i]))
            QDOT_TRY(append_value_line(s, word, symbols[i], values[i], "", remarks, out));
    return QDOT_OK;
}

/* Write `start` lines in the order of the coordinates, as `start RUN` stores the values in another order. */
static qdot_status
append_start_lines(qdot_session *s, bool remarks, qdot_text *out)
{
    size_t left = s->values->start_symbols.n;

    for (size_t i = 0; i < 3 * s->scene->coordinates.n; i++) {
        const qdot_expr q = s->scene->coordinates.at[i / 3];
        const qdot_expr jet = i % 3 == 2 ? qdot_symbol_of(s->pool, QDOT_MOMENTUM, q) : qdot_symbol_jet(s->pool, q, i % 3);

        const qdot_expr value = qdot_session_value_started(s, jet);

        if (value != QDOT_NIL)
            QDOT_TRY(append_value_line(s, "start ", jet, value,
                                       --left == 0 && s->values->start_exactly ? " exactly" : "", remarks, out));
    }
    for (size_t k = 0; k < s->values->start_symbols.n; k++)
        if (qdot_session_is_speed(s, s->values->start_symbols.at[k]))
            QDOT_TRY(append_value_line(s, "start ", s->values->start_symbols.at[k], s->values->start_values.at[k],
                                       --left == 0 && s->values->start_exactly ? " exactly" : "", remarks, out));
    return QDOT_OK;
}

/* --- settings of the session ---------------------------------------------------------- */

static void
append_settings(const qdot_session *s, qdot_text *out)
{
    static const char *const styles[] = {[QDOT_PLAIN] = "plain",
                                         [QDOT_UNICODE] = "unicode",
                                         [QDOT_LATEX] = "latex",
                                         [QDOT_MATHML] = "mathml"};

    qdot_text_format(out, "style %s\n", styles[s->output->style]);
    qdot_text_add(out, s->output->flat ? "style flat\n" : "");
    qdot_text_add(out, s->output->timing ? "timing on\n" : "");
}

static const char history_header[] = "# statements typed in qdot\n";

/* --- writing the file ----------------------------------------------------------------- */

static qdot_status
append_all_statements(qdot_session *s, bool session, qdot_text *lost, qdot_text *out)
{
    qdot_text_add(out, qdot_session_file_header);
    QDOT_TRY(append_declarations(s, out));
    QDOT_TRY(qdot_scene_print_things(s->scene, out));
    QDOT_TRY(append_definitions(s, lost, out));
    QDOT_TRY(append_value_lines(s, "set ", s->values->set_symbols.n, s->values->set_symbols.at, s->values->set_values.at, session, out));
    QDOT_TRY(append_start_lines(s, session, out));
    QDOT_TRY(append_value_lines(s, "scale ", s->values->scale_symbols.n, s->values->scale_symbols.at, s->values->scale_values.at, session, out));
    if (session)
        append_settings(s, out);
    return qdot_session_file_runs(s, session, lost, out);
}

qdot_status
qdot_scene_file_list(qdot_session *session, qdot_text *out)
{
    const qdot_scene *s = session->scene;

    for (size_t i = 0; i < s->coordinates.n; i++) {
        const qdot_expr q = s->coordinates.at[i];

        if (qdot_scene_state_of(s, q) != NULL || qdot_higher_find(s, q) != NULL)
            continue;
        qdot_text_add(out, "coord ");
        QDOT_TRY(qdot_scene_print_domain(s, q, out));
        qdot_units_in_brackets(session, q, out);
        qdot_text_char(out, '\n');
    }
    return qdot_scene_print_things(s, out);
}

qdot_status
qdot_scene_file_text(qdot_session *s, qdot_scene_file what, qdot_text *out)
{
    qdot_text lost = {0};
    unsigned paused;
    qdot_status status;

    if (what == QDOT_FILE_HISTORY) {
        qdot_text_add(out, history_header);
        qdot_text_add(out, qdot_text_str(&s->typed->all));
        out->failed = out->failed || s->typed->all.failed;
        return qdot_text_status(out);
    }
    paused = qdot_phase_pause(s);
    status = append_all_statements(s, what == QDOT_FILE_SESSION, &lost, out);
    if (status == QDOT_OK)
        status = qdot_phase_resume(s, paused);
    if (status == QDOT_OK)
        qdot_session_remarks_lost(s, &lost, out);
    qdot_text_clear(&lost);
    return status == QDOT_OK ? qdot_text_status(out) : status;
}

/* Refuse to overwrite a regular file that does not begin with the header of a scene or session file. */
static qdot_status
check_may_overwrite(const char *path, const char *header)
{
    const size_t length = strlen(header);
    char begin[64] = "";
    struct stat info;
    FILE *file;
    size_t n;

    if (stat(path, &info) != 0 || !S_ISREG(info.st_mode) || (file = fopen(path, "rbe")) == NULL)
        return QDOT_OK; /* the attempt to write will report the reason */
    n = fread(begin, 1, length < sizeof begin ? length : sizeof begin - 1, file);
    fclose(file);
    if (n == 0 || strcmp(begin, header) == 0)
        return QDOT_OK;
    (void)qdot_fail(QDOT_EINVAL, "`%.200s` exists and was not written by `%s to`", path,
                    header == history_header ? "save history" : "scene");
    return qdot_hint("another name; only files that begin with `%.*s` are overwritten", (int)length - 1, header);
}

qdot_status
qdot_scene_file_write(qdot_cursor *c, const qdot_token *name, qdot_scene_file what)
{
    const char *path = name->text, *dot = strrchr(path, '.');
    qdot_text text = {0};
    qdot_status status;

    if (dot != NULL && strchr(dot, '/') != NULL) /* the dot belongs to the name of a folder */
        dot = NULL;
    if (!qdot_scene_file_is(path)) {
        c->error_at = name->start;
        (void)qdot_fail(QDOT_ESYNTAX, "`%.200s`: statements are written to a file whose name ends in `.lag`", path);
        return qdot_hint("save %s to \"%.*s.lag\"", what == QDOT_FILE_HISTORY ? "history" : "session",
                         (int)(dot != NULL ? dot - path : (int64_t)strlen(path)), path);
    }
    status = qdot_scene_file_text(c->session, what, &text);
    c->error_at = name->start;
    if (status == QDOT_OK)
        status = check_may_overwrite(path, what == QDOT_FILE_HISTORY ? history_header : qdot_session_file_header);
    if (status == QDOT_OK)
        status = qdot_answer_in_file(c->session, path, &text);
    qdot_text_clear(&text);
    return status;
}
