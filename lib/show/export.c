/* export.c -- writes a whole file of source text from a template: chooses names, replaces words. */
#include "show/export.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "show/export-data.h"

typedef qdot_export_writer writer;

/* --- names in the exported file --------------------------------------------------------- */

static bool
is_part_of_name(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

/* Append a name as an identifier of letters, digits and _: theta[1]'' becomes theta_1_ddot. */
static void
append_identifier(const char *name, qdot_text *out)
{
    size_t primes = 0;

    for (; *name != '\0'; name++) {
        if (is_part_of_name(*name))
            qdot_text_char(out, *name);
        else if (*name == '[' || *name == ',')
            qdot_text_char(out, '_');
        primes += *name == '\'';
    }
    if (primes > 0)
        qdot_text_format(out, "_%.*sdot", (int)primes - 1, "dddddddd");
}

/* Whether the text of an operation uses the name, as `exp(&a)` uses exp; np.exp uses np only. */
static bool
is_used_by_operation(const qdot_export_language *s, const char *name)
{
    const size_t n = strlen(name);

    for (int op = 0; op < QDOT_OP_COUNT; op++) {
        const char *const text = s->operation[op];

        for (const char *at = text; at != NULL && (at = strstr(at, name)) != NULL; at++)
            if ((at == text || (!is_part_of_name(at[-1]) && strchr(".&#", at[-1]) == NULL)) &&
                !is_part_of_name(at[n]))
                return true;
    }
    return false;
}

static bool
is_reserved(const qdot_export_language *s, const char *word)
{
    char between[80];

    if (is_used_by_operation(s, word))
        return true;
    if (strlen(word) > sizeof between - 3)
        return false;
    snprintf(between, sizeof between, " %s ", word);
    return strstr(s->reserved, between) != NULL;
}

static bool
word_is_taken(const writer *w, size_t n, const char *word)
{
    for (size_t i = 0; i < n; i++)
        if (strcmp(w->words[i], word) == 0)
            return true;
    return is_reserved(w->language, word);
}

/* Name input i of the exported function after its symbol, with _ appended until the name is new. */
static qdot_status
name_input(writer *w, size_t i, const char *name)
{
    qdot_text word = {0};
    qdot_status status;

    append_identifier(name, &word);
    while (word_is_taken(w, i, qdot_text_str(&word)) && !word.failed)
        qdot_text_char(&word, '_');
    status = qdot_text_status(&word);
    if (status == QDOT_OK && (w->words[i] = qdot_strdup(word.at)) == NULL)
        status = QDOT_ENOMEM;
    qdot_text_clear(&word);
    return status;
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
static qdot_status
name_array_element(writer *w, size_t i, const char *name, const char *primes, const char *format,
                   size_t k)
{
    qdot_text text = {0};
    qdot_status status;

    qdot_text_format(&text, "%s%s", name, primes);
    status = qdot_text_status(&text);
    if (status == QDOT_OK)
        status = name_input(w, i, text.at);
    qdot_text_truncate(&text, 0);
    qdot_text_format(&text, format, k + w->language->first);
    if (status == QDOT_OK)
        status = qdot_text_status(&text);
    if (status == QDOT_OK && (w->sources[i] = qdot_strdup(text.at)) == NULL)
        status = QDOT_ENOMEM;
    qdot_text_clear(&text);
    return status;
}

static qdot_status
name_parameter(writer *w, size_t i, const char *name)
{
    qdot_text text = {0};
    qdot_status status;

    QDOT_TRY(name_input(w, i, name));
    qdot_text_format(&text, w->language->parameter, w->words[i]);
    status = qdot_text_status(&text);
    if (status == QDOT_OK && (w->sources[i] = qdot_strdup(text.at)) == NULL)
        status = QDOT_ENOMEM;
    qdot_text_clear(&text);
    return status;
}
#pragma GCC diagnostic pop

/* Name the inputs of an exported motion: t, q, q', q'', lambda, parameters, sides of surfaces. */
static qdot_status
name_motion_inputs(writer *w)
{
    const qdot_export_system *x = w->system;
    const size_t n = x->n;

    if ((w->words[0] = qdot_strdup("t")) == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++)
        QDOT_TRY(name_array_element(w, 1 + i, x->q[i].name, "", w->language->state, i));
    for (size_t i = 0; i < n; i++)
        QDOT_TRY(name_array_element(w, 1 + n + i, x->q[i].name, "'", w->language->state, n + i));
    for (size_t i = 0; i < n; i++)
        QDOT_TRY(name_array_element(w, 1 + 2 * n + i, x->q[i].name, "''", w->language->acceleration, i));
    for (size_t i = 0; i < x->m; i++)
        QDOT_TRY(name_array_element(w, 1 + 3 * n + i, x->lambda[i].name, "", w->language->multiplier, i));
    for (size_t i = 0; i < x->k; i++)
        QDOT_TRY(name_parameter(w, qdot_export_first_parameter(x) + i, x->parameters[i].name));
    for (size_t i = 0; i < x->s; i++)
        QDOT_TRY(name_array_element(w, qdot_export_first_parameter(x) + x->k + i, "side", "",
                                    w->language->side, i));
    return QDOT_OK;
}

static qdot_status
name_expression_inputs(writer *w)
{
    for (size_t i = 0; i < w->value->k; i++)
        QDOT_TRY(name_input(w, i, w->value->arguments[i].name));
    return QDOT_OK;
}

/* Choose a prefix [16] of names, such that prefix and digit are not a name of the scene; the last try is taken in any case. */
static void
choose_prefix(const writer *w, size_t n_tries, const char *const *tries, char *prefix)
{
    for (size_t k = 0; k < n_tries; k++) {
        size_t n = strlen(tries[k]);
        bool free_ = true;

        for (size_t i = 0; i < w->inputs; i++)
            free_ &= strncmp(w->words[i], tries[k], n) != 0 ||
                     !isdigit((unsigned char)w->words[i][n]);
        snprintf(prefix, sizeof w->temporary, "%s", tries[k]);
        if (free_)
            return;
    }
}

/* Choose the name of the exported functions from the name of the file. */
static qdot_status
choose_function_name(writer *w, const char *file)
{
    qdot_text name = {0};
    bool changed = isdigit((unsigned char)*file) || *file == '_' || *file == '\0';
    qdot_status status;

    qdot_text_add(&name, changed ? "f_" : "");
    for (const char *c = file; *c != '\0'; c++) {
        bool fits = is_part_of_name(*c);

        qdot_text_char(&name, fits ? *c : '_');
        changed |= !fits;
    }
    /* in C, the names of a motion's functions only begin with the name chosen from the file */
    if ((w->system == NULL || w->language != &qdot_export_c) &&
        is_reserved(w->language, qdot_text_str(&name))) {
        qdot_text_char(&name, '_');
        changed = true;
    }
    status = qdot_text_status(&name);
    if (status == QDOT_OK && changed && w->language->exact_name) {
        (void)qdot_fail(QDOT_EINVAL, "`%.100s` is no name of a function, which the file of a function "
                                     "of Matlab has to bear", file);
        status = qdot_hint("letters, digits and _, as in \"%.100s.m\"", name.at);
    }
    if (status == QDOT_OK && (w->name = qdot_strdup(name.at)) == NULL)
        status = QDOT_ENOMEM;
    qdot_text_clear(&name);
    return status;
}

/* --- parts of a template ------------------------------------------------------------------ */

qdot_status
qdot_export_write_code(writer *w, const qdot_export_function *f, const char *indent,
                       const char *const *targets)
{
    const qdot_export_frame frame = {.language = w->language,
                                     .words = (const char *const *)w->words,
                                     .sources = (const char *const *)w->sources,
                                     .indent = indent,
                                     .temporary = w->temporary,
                                     .targets = targets,
                                     .tables = &w->tables};

    return f->tape == NULL ? QDOT_OK : qdot_export_code(&frame, f, w->out);
}

void
qdot_export_write_number(const writer *w, double x)
{
    if (isnan(x))
        qdot_text_add(w->out, w->language->nan);
    else
        qdot_export_number(x, w->out);
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
static qdot_status
write_function_arguments(writer *w, bool more)
{
    if (w->value->k == 0 && !more)
        qdot_text_add(w->out, w->language->no_argument);
    for (size_t i = 0; i < w->value->k; i++) {
        double x = w->value->arguments[i].value;

        qdot_text_add(w->out, i > 0 ? ", " : "");
        if (isnan(x)) {
            qdot_text_format(w->out, w->language->argument, w->words[i]);
        } else {
            qdot_text value = {0};

            qdot_export_number(x, &value);
            qdot_text_format(w->out, w->language->argument_value, w->words[i],
                             qdot_text_str(&value));
            w->out->failed |= value.failed;
            qdot_text_clear(&value);
        }
    }
    qdot_text_add(w->out, more && w->value->k > 0 ? ", " : "");
    return QDOT_OK;
}
#pragma GCC diagnostic pop

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
static void
write_result_shape(writer *w)
{
    const qdot_export_block *b = &w->value->value.block[0];

    if (b->columns == 0)
        qdot_text_format(w->out, w->language->vector_shape, b->rows);
    else
        qdot_text_format(w->out, w->language->matrix_shape, b->rows, b->columns);
}
#pragma GCC diagnostic pop

/* Write the lines of the scene as comments of the exported file. */
static qdot_status
write_scene_comments(writer *w, const char *text)
{
    while (*text != '\0') {
        size_t n = strcspn(text, "\n");

        qdot_text_add(w->out, w->language->comment);
        qdot_text_add(w->out, n > 0 ? " " : "");
        qdot_text_add_n(w->out, text, n);
        qdot_text_char(w->out, '\n');
        text += n + (text[n] == '\n');
    }
    return QDOT_OK;
}

/* Write what replaces a word that motions and expressions share; *known: it is such a word. */
static qdot_status
write_common_word(writer *w, const char *word, const char *indent, bool *known)
{
    *known = true;
    if (strcmp(word, "name") == 0)
        qdot_text_add(w->out, w->name);
    else if (strcmp(word, "file") == 0)
        qdot_text_add(w->out, w->system != NULL ? w->system->file : w->value->file);
    else if (strcmp(word, "origin") == 0)
        return write_scene_comments(w, w->system != NULL ? w->system->origin : w->value->origin);
    else if (strcmp(word, "tables") == 0)
        return qdot_export_write_tables(w);
    else if (w->system == NULL && strncmp(word, "arguments", 9) == 0)
        return write_function_arguments(w, word[9] == ',');
    else if (w->system == NULL && strcmp(word, "code") == 0)
        return qdot_export_write_code(w, &w->value->value, indent, NULL);
    else if (w->system == NULL && strcmp(word, "shape") == 0)
        write_result_shape(w);
    else if (w->system == NULL && strcmp(word, "size") == 0)
        qdot_text_format(w->out, "%zu", qdot_tape_outputs(w->value->value.tape));
    else
        *known = false;
    return QDOT_OK;
}

static bool
has_template_feature(const writer *w, char what)
{
    const qdot_tape *tape = w->system == NULL ? w->value->value.tape : NULL;

    if (what == 't' || what == 'n')
        return (what == 't' ? w->tables.columns.n : w->tables.lines.n) > 0;
    if (w->system != NULL)
        return qdot_export_motion_has(w->system, what);
    switch (what) {
    case 'h': return qdot_export_tape_uses(tape, QDOT_OP_SELECT, QDOT_OP_SELECT);
    case 'f': return qdot_export_tape_uses(tape, QDOT_OP_ERF, QDOT_OP_ERFC);
    default:
        return qdot_export_tape_uses(tape, QDOT_OP_SQRT, QDOT_OP_POW) ||
               qdot_export_tape_uses(tape, QDOT_OP_ASIN, QDOT_OP_ACOS) ||
               qdot_export_tape_uses(tape, QDOT_OP_ACOSH, QDOT_OP_ATANH) ||
               qdot_export_tape_uses(tape, QDOT_OP_LOG, QDOT_OP_LOG);
    }
}

/* --- templates of the languages ----------------------------------------------------------- */

/* Write one line of the template; a word alone on its line is replaced by lines that have the same indent. */
static qdot_status
write_template_line(writer *w, const char *line, size_t n)
{
    const char *const end = line + n;
    char word[32], indent[32];
    size_t blanks = strspn(line, " ");
    bool lines = blanks < n && line[blanks] == '$' && n > blanks + 1 && end[-1] == '$' &&
                 memchr(line + blanks + 1, '$', n - blanks - 2) == NULL;

    snprintf(indent, sizeof indent, "%.*s", (int)blanks, line);
    if (lines)
        line += blanks;
    while (line < end) {
        const char *at = memchr(line, '$', (size_t)(end - line));
        const char *close = at == NULL ? NULL : memchr(at + 1, '$', (size_t)(end - at - 1));
        bool known;

        if (close == NULL) {
            qdot_text_add_n(w->out, line, (size_t)(end - line));
            break;
        }
        qdot_text_add_n(w->out, line, (size_t)(at - line));
        snprintf(word, sizeof word, "%.*s", (int)(close - at - 1), at + 1);
        QDOT_TRY(write_common_word(w, word, indent, &known));
        if (!known)
            QDOT_TRY(qdot_export_motion_word(w, word, indent));
        line = close + 1;
    }
    qdot_text_add(w->out, lines ? "" : "\n");
    return qdot_text_status(w->out);
}

static qdot_status
write_template_text(writer *w, const char *text)
{
    while (*text != '\0') {
        size_t n = strcspn(text, "\n");
        const char *line = text;
        bool wanted = true;

        text += n + 1;
        while ((line[0] == '?' || line[0] == '!') && line[2] == ' ') {
            wanted &= has_template_feature(w, line[1]) == (line[0] == '?');
            line += 3;
            n -= 3;
        }
        if (wanted)
            QDOT_TRY(write_template_line(w, line, n));
    }
    return QDOT_OK;
}

static qdot_status
write_exported_file(writer *w, const char *file, const char *text)
{
    qdot_status status = choose_function_name(w, file);

    w->words = qdot_calloc(w->inputs + 1, sizeof *w->words);
    w->sources = qdot_calloc(w->inputs + 1, sizeof *w->sources);
    if (w->words == NULL || w->sources == NULL)
        status = QDOT_ENOMEM;
    if (status == QDOT_OK)
        status = w->system != NULL ? name_motion_inputs(w) : name_expression_inputs(w);
    if (status == QDOT_OK)
        status = qdot_export_find_tables(w);
    if (status == QDOT_OK) {
        choose_prefix(w, 5, (const char *const[]){"w", "u", "z", "w_", "temporary_"}, w->temporary);
        choose_prefix(w, 3, (const char *const[]){"table_", "data_", "table__"}, w->tables.prefix);
        status = write_template_text(w, text);
        if (status == QDOT_OK && w->system != NULL && w->language->motion != NULL)
            status = write_template_text(w, w->language->motion);
    }
    for (size_t i = 0; w->words != NULL && w->sources != NULL && i < w->inputs; i++) {
        qdot_free(w->words[i]);
        qdot_free(w->sources[i]);
    }
    qdot_free(w->words);
    qdot_free(w->sources);
    qdot_free(w->name);
    qdot_export_tables_clear(&w->tables);
    return status;
}

qdot_status
qdot_export_system_write(const qdot_export_system *system, const qdot_export_language *language,
                         qdot_text *out)
{
    writer w = {.language = language,
                .system = system,
                .inputs = qdot_export_first_parameter(system) + system->k + system->s,
                .out = out};

    return write_exported_file(&w, system->file, w.language->system);
}

qdot_status
qdot_export_expression_write(const qdot_export_expression *e, const qdot_export_language *language,
                             qdot_text *out)
{
    writer w = {.language = language, .value = e, .inputs = e->k, .out = out};

    return write_exported_file(&w, e->file,
                               e->value.block[0].array == NULL ? w.language->value : w.language->values);
}
