/* export-motion.c -- replaces the words in the template of a motion's source text. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "show/export-data.h"

typedef qdot_export_writer writer;

static bool
has_statement_terminator(const qdot_export_language *s)
{
    return strchr(s->number, ';') != NULL;
}

/* --- parameters and events ------------------------------------------------------------------ */

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
static qdot_status
declare_parameters(writer *w, const char *indent)
{
    const size_t at = qdot_export_first_parameter(w->system);

    for (size_t i = 0; i < w->system->k; i++) {
        qdot_text value = {0}, *out = w->out;

        w->out = &value;
        qdot_export_write_number(w, w->system->parameters[i].value);
        w->out = out;
        qdot_text_add(out, indent);
        qdot_text_format(out, w->language->declared, w->words[at + i], qdot_text_str(&value),
                         w->system->parameters[i].name);
        qdot_text_char(out, '\n');
        out->failed |= value.failed;
        qdot_text_clear(&value);
    }
    return QDOT_OK;
}

/* Write, for each parameter, a statement of the exported file that fails if the parameter has no value. */
static qdot_status
write_parameter_checks(writer *w, const char *indent)
{
    for (size_t i = 0; i < w->system->k; i++) {
        qdot_text_add(w->out, indent);
        qdot_text_format(w->out, w->language->check,
                         w->words[qdot_export_first_parameter(w->system) + i],
                         w->system->parameters[i].name);
        qdot_text_char(w->out, '\n');
    }
    return QDOT_OK;
}

/* Write the assignments of event k, one for each of its targets (a coordinate, velocity or parameter). */
static qdot_status
write_event_assignments(writer *w, size_t k, const char *indent)
{
    const qdot_export_event *e = &w->system->event[k];
    const size_t n = w->system->n, own = qdot_export_first_parameter(w->system);
    const qdot_export_function f = {.tape = e->effect};
    char **targets;
    qdot_text deep = {0};
    qdot_status status = QDOT_OK;

    if (e->effect == NULL)
        return QDOT_OK;
    qdot_text_add(w->out, indent);
    qdot_text_format(w->out, w->language->effect_begin, k + w->language->first);
    qdot_text_format(&deep, "%s    ", indent);
    if ((targets = qdot_calloc(e->n_targets, sizeof *targets)) == NULL)
        status = QDOT_ENOMEM;
    for (size_t i = 0; i < e->n_targets && status == QDOT_OK; i++) {
        size_t to = e->targets[i];
        qdot_text line = {0};

        qdot_text_format(&line, "%s = %%s%s", w->sources[to < 2 * n ? 1 + to : own + to - 2 * n],
                         has_statement_terminator(w->language) ? ";" : "");
        status = qdot_text_status(&line);
        targets[i] = line.at;
    }
    if (status == QDOT_OK)
        status = qdot_text_status(&deep);
    if (status == QDOT_OK)
        status = qdot_export_write_code(w, &f, deep.at, (const char *const *)targets);
    if (*w->language->effect_end != '\0')
        qdot_text_format(w->out, "%s%s", indent, w->language->effect_end);
    for (size_t i = 0; targets != NULL && i < e->n_targets; i++)
        qdot_text_clear(&(qdot_text){.at = targets[i]});
    qdot_free(targets);
    qdot_text_clear(&deep);
    return status;
}
#pragma GCC diagnostic pop

/* Write the members of a struct in C: "double a, b;". */
static qdot_status
write_struct_members(writer *w, const char *indent)
{
    const size_t at = qdot_export_first_parameter(w->system);

    for (size_t i = 0; i < w->system->k; i++)
        qdot_text_format(w->out, "%sdouble %s;\n", indent, w->words[at + i]);
    return QDOT_OK;
}

static qdot_status
write_all_event_effects(writer *w, const char *indent)
{
    for (size_t k = 0; k < w->system->n_events; k++)
        QDOT_TRY(write_event_assignments(w, k, indent));
    return QDOT_OK;
}

/* --- lists in the exported file ------------------------------------------------------------- */

static void
write_separator(const writer *w, size_t i)
{
    qdot_text_add(w->out, i > 0 ? w->language->separator : "");
}

/* Write quoted names, "theta", "x", separated. */
static qdot_status
write_names(writer *w, size_t n, const qdot_export_name *list)
{
    for (size_t i = 0; i < n; i++) {
        write_separator(w, i);
        qdot_text_format(w->out, "\"%s\"", list[i].name);
    }
    return QDOT_OK;
}

static qdot_status
write_start_state(writer *w)
{
    for (size_t i = 0; i < 2 * w->system->n; i++) {
        write_separator(w, i);
        qdot_export_write_number(w, w->system->start[i]);
    }
    return QDOT_OK;
}

/* Write a list about the events; `what` is the first letter of what is listed: names, ways, stops, effects. */
static qdot_status
write_event_list(writer *w, char what)
{
    for (size_t i = 0; i < w->system->n_events; i++) {
        const qdot_export_event *e = &w->system->event[i];

        write_separator(w, i);
        if (what == 'n')
            qdot_text_format(w->out, "\"%s\"", e->name);
        else
            qdot_text_format(w->out, "%d", what == 'w'   ? e->way
                                           : what == 's' ? e->stop
                                                         : e->effect != NULL);
    }
    return QDOT_OK;
}

/* Write a list about the switching surfaces; `what` is the first letter of what is listed: names, steps, moves. */
static qdot_status
write_surface_list(writer *w, char what)
{
    for (size_t i = 0; i < w->system->s; i++) {
        const qdot_export_surface *s = &w->system->surface[i];

        write_separator(w, i);
        if (what == 'n')
            qdot_text_format(w->out, "\"%s %s\"",
                             "the equations do not say how the motion goes on where", s->text);
        else
            qdot_text_format(w->out, "%d", what == 's' ? s->steps : s->moves);
    }
    return QDOT_OK;
}

static qdot_status
write_constraint_orders(writer *w)
{
    for (size_t i = 0; i < w->system->m; i++) {
        write_separator(w, i);
        qdot_text_format(w->out, "%d", w->system->orders[i]);
    }
    return QDOT_OK;
}

/* --- rows of numbers ------------------------------------------------------------------------ */

enum { A_LINE = 4, ROWS = 16, TERMS = 12 };

void
qdot_export_write_numbers(writer *w, size_t n, const double *x, const char *indent)
{
    for (size_t i = 0; i < n; i++) {
        if (i % A_LINE == 0 && i > 0)
            qdot_text_format(w->out, "%s\n%s", w->language->line_end, indent);
        qdot_export_number(x[i], w->out);
        qdot_text_add(w->out, i + 1 == n ? "" : (i + 1) % A_LINE == 0 ? "," : ", ");
    }
}

static qdot_status
write_matrix(writer *w, size_t rows, size_t columns, const double *x, const char *indent)
{
    for (size_t i = 0; i < rows; i++) {
        qdot_text_format(w->out, "%s%s", indent, w->language->row_begin);
        qdot_export_write_numbers(w, columns, x + i * columns, indent);
        qdot_text_format(w->out, "%s\n", w->language->row_end);
    }
    return QDOT_OK;
}

/* Write one row of numbers, without the brackets of a matrix row. */
static qdot_status
write_number_row(writer *w, size_t n, const double *x, const char *indent)
{
    qdot_text_add(w->out, indent);
    qdot_export_write_numbers(w, n, x, indent);
    qdot_text_format(w->out, "%s\n", w->language->line_end);
    return QDOT_OK;
}

/* Write a matrix that marks with 1 which components of the state each event sets. */
static qdot_status
write_event_target_matrix(writer *w, const char *indent)
{
    const size_t width = 2 * w->system->n;
    double *x = qdot_calloc(w->system->n_events * width + 1, sizeof *x);
    qdot_status status = x != NULL ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < w->system->n_events && x != NULL; i++)
        for (size_t k = 0; k < w->system->event[i].n_targets; k++)
            if (w->system->event[i].targets[k] < width)
                x[i * width + w->system->event[i].targets[k]] = 1;
    if (status == QDOT_OK)
        status = write_matrix(w, w->system->n_events, width, x, indent);
    qdot_free(x);
    return status;
}

/* Write the Runge-Kutta coefficients (ode/dop853.def) that a word of the template asks for. */
static qdot_status
write_method_coefficients(writer *w, const char *word, const char *indent)
{
    double nodes[ROWS] = {0}, stages[ROWS][ROWS] = {{0}}, fifth[TERMS] = {0}, third[TERMS] = {0};
    double curve[4][ROWS] = {{0}};
    double *to;

    nodes[TERMS] = 1;
#define A(j, a) to[j] = a;
#define STAGE(row, c, terms) nodes[row] = c; to = stages[row]; terms
#define DENSE_STAGE(row, c, terms) nodes[row] = c; to = stages[row]; terms
#define WEIGHTS(terms) to = stages[TERMS]; terms
#define ERROR5(terms) to = fifth; terms
#define THIRD(terms) to = third; terms
#define DENSE(p, terms) to = curve[(p) - 3]; terms
#include "ode/dop853.def"
    return strcmp(word, "nodes") == 0    ? write_number_row(w, ROWS, nodes, indent)
           : strcmp(word, "stages") == 0 ? write_matrix(w, ROWS, ROWS, stages[0], indent)
           : strcmp(word, "fifth") == 0  ? write_number_row(w, TERMS, fifth, indent)
           : strcmp(word, "third") == 0  ? write_number_row(w, TERMS, third, indent)
                                         : write_matrix(w, 4, ROWS, curve[0], indent);
}

/* --- words of the template ------------------------------------------------------------------ */

static bool
word_is_in_list(const char *word, const char *list)
{
    char between[40];

    snprintf(between, sizeof between, " %s ", word);
    return strstr(list, between) != NULL;
}

qdot_status
qdot_export_motion_word(writer *w, const char *word, const char *indent)
{
    const qdot_export_system *x = w->system;
    const struct {
        const char *word;
        const qdot_export_function *function;
    } functions[] = {{"equations", &x->equations}, {"slopes", &x->slopes},
                     {"velocities", &x->velocities},
                     {"energy", &x->energy},       {"constraints", &x->positions},
                     {"events", &x->events},       {"switches", &x->switches}};
    const struct {
        const char *word;
        size_t count;
    } counts[] = {{"n", x->n},        {"2n", 2 * x->n},       {"m", x->m},
                  {"r", x->n + x->m}, {"e", x->n_events},     {"s", x->s},
                  {"w", x->n_events + x->s}, {"m1", x->m > 0 ? x->m : 1}};

    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        if (strcmp(functions[i].word, word) == 0)
            return qdot_export_write_code(w, functions[i].function, indent, NULL);
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        if (strcmp(counts[i].word, word) == 0) {
            qdot_text_format(w->out, "%zu", counts[i].count);
            return QDOT_OK;
        }
    if (word_is_in_list(word, " t0 t1 ")) {
        qdot_export_write_number(w, word[1] == '0' ? x->t0 : x->t1);
        return QDOT_OK;
    }
    if (strcmp(word, "tol") == 0) {
        qdot_text_format(w->out, "%.3g", x->tol);
        return QDOT_OK;
    }
    if (word_is_in_list(word, " nodes stages fifth third curve "))
        return write_method_coefficients(w, word, indent);
    if (strncmp(word, "event ", 6) == 0)
        return write_event_list(w, word[6]);
    if (strncmp(word, "surface ", 8) == 0)
        return write_surface_list(w, word[8]);
    return strcmp(word, "fields") == 0        ? write_struct_members(w, indent)
           : strcmp(word, "parameters") == 0  ? declare_parameters(w, indent)
           : strcmp(word, "checks") == 0      ? write_parameter_checks(w, indent)
           : strcmp(word, "start") == 0       ? write_start_state(w)
           : strcmp(word, "coordinates") == 0 ? write_names(w, x->n, x->q)
           : strcmp(word, "multipliers") == 0 ? write_names(w, x->m, x->lambda)
           : strcmp(word, "orders") == 0      ? write_constraint_orders(w)
           : strcmp(word, "knots") == 0       ? qdot_export_write_knots(w, indent)
           : strcmp(word, "sets") == 0        ? write_event_target_matrix(w, indent)
           : strcmp(word, "effects") == 0
               ? write_all_event_effects(w, indent)
               : qdot_fail(QDOT_EINVAL, "the template has an unknown word: %.40s", word);
}

/* --- conditions on template lines ----------------------------------------------------------- */

bool
qdot_export_tape_uses(const qdot_tape *tape, qdot_op first, qdot_op last)
{
    for (size_t i = 0; tape != NULL && i < tape->length; i++)
        if (tape->code[i].op >= first && tape->code[i].op <= last)
            return true;
    return false;
}

static bool
any_tape_uses(const qdot_export_system *x, qdot_op first, qdot_op last)
{
    const qdot_tape *const tapes[] = {x->equations.tape, x->slopes.tape, x->velocities.tape, x->energy.tape,
                                      x->positions.tape, x->events.tape, x->switches.tape};

    for (size_t i = 0; i < sizeof tapes / sizeof *tapes; i++)
        if (qdot_export_tape_uses(tapes[i], first, last))
            return true;
    for (size_t i = 0; i < x->n_events; i++)
        if (qdot_export_tape_uses(x->event[i].effect, first, last))
            return true;
    return false;
}

/* Whether a tape takes accelerations or Lagrange multipliers as inputs. */
static bool
tape_reads_accelerations(const qdot_export_system *x, const qdot_tape *tape)
{
    const size_t from = 1 + 2 * x->n, to = qdot_export_first_parameter(x);

    for (size_t i = 0; tape != NULL && i < tape->length; i++) {
        const size_t places[] = {tape->code[i].x, tape->code[i].y, tape->code[i].z};

        for (size_t k = 0; k < 3; k++)
            if (places[k] >= from && places[k] < to)
                return true;
    }
    for (size_t i = 0; tape != NULL && i < tape->outputs; i++)
        if (tape->output[i] >= from && tape->output[i] < to)
            return true;
    return false;
}

static bool
has_event_effect(const qdot_export_system *x, bool that_reads)
{
    for (size_t i = 0; i < x->n_events; i++)
        if (x->event[i].effect != NULL && (!that_reads || tape_reads_accelerations(x, x->event[i].effect)))
            return true;
    return false;
}

bool
qdot_export_motion_has(const qdot_export_system *x, char what)
{
    switch (what) {
    case 'a': return tape_reads_accelerations(x, x->events.tape);
    case 'b': return has_event_effect(x, true);
    case 'c': return x->m > 0;
    case 'd': return has_event_effect(x, false);
    case 'e': return x->n_events > 0;
    case 'f': return any_tape_uses(x, QDOT_OP_ERF, QDOT_OP_ERFC);
    case 'h': return any_tape_uses(x, QDOT_OP_SELECT, QDOT_OP_SELECT);
    case 'j': return x->slopes.tape != NULL;
    case 'k': return x->k > 0;
    case 'l': return x->s > 0 && x->switches.block[1].rows > 0;
    case 'p': return x->positions.tape != NULL;
    case 's': return x->s > 0;
    case 'z': return x->velocities.tape != NULL;
    case 'w': return x->n_events + x->s > 0;
    default:
        return any_tape_uses(x, QDOT_OP_SQRT, QDOT_OP_POW) || any_tape_uses(x, QDOT_OP_ASIN, QDOT_OP_ACOS) ||
               any_tape_uses(x, QDOT_OP_ACOSH, QDOT_OP_ATANH) || any_tape_uses(x, QDOT_OP_LOG, QDOT_OP_LOG);
    }
}
