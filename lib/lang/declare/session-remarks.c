/* session-remarks.c -- comments in scene and session files about numbers of runs: writes and preserves them. */
#include "lang/declare/session-remarks.h"

#include <string.h>

#include "base/number-text.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/print.h"
#include "lang/session/measured.h"
#include "lang/session/names.h"
#include "lang/session/runs.h"
#include "lang/session/text-list.h"

const char qdot_session_file_header[] = "# a scene written by qdot\n";

/* --- numbers of runs in values ---------------------------------------------------------- */

bool
qdot_session_file_is_long(const qdot_session *s, qdot_expr value)
{
    qdot_text text = {0};
    bool is = qdot_expr_kind(s->pool, value) == QDOT_NUM &&
              qdot_print(s->pool, value, QDOT_PLAIN, &text) == QDOT_OK && text.n > 13;

    qdot_text_clear(&text);
    return is;
}

static void
append_error(double error, qdot_text *out)
{
    if (error == error)
        qdot_number_text_bound(out, error);
    else
        qdot_text_add(out, "unknown");
}

/* Write a comment after the value if it is a long number from a run, with its error. */
static void
append_comment_with_error(const qdot_session *s, qdot_expr value, size_t runs, qdot_text *out)
{
    if (!qdot_session_file_is_long(s, value))
        return;
    for (size_t i = 0; i < s->measured->n; i++) {
        const qdot_measured *m = &s->measured->at[i];

        if (value != m->exact &&
            (m->digits > 0 || value != qdot_expr_of_double(s->pool, m->value)))
            continue;
        qdot_text_add(out, " # a number of a run, its error ");
        append_error(m->error, out);
        return;
    }
    for (size_t k = 0; k < runs; k++) {
        const qdot_run_report *report = qdot_run_get_report(s->runs->at[k].run);

        for (size_t i = 0; i < report->n; i++) {
            if (value != qdot_expr_of_double(s->pool, report->q[i]) &&
                value != qdot_expr_of_double(s->pool, report->v[i]))
                continue;
            qdot_text_format(out, " # from the end of %s, its error ", s->runs->at[k].name);
            append_error(report->error, out);
            return;
        }
    }
}

void
qdot_session_remarks_end_line(const qdot_session *s, qdot_expr value, size_t runs, size_t from, qdot_text *out)
{
    const size_t end = out->n;
    qdot_text line = {0};

    append_comment_with_error(s, value, runs, out);
    if (out->n == end) {
        qdot_text_format(&line, "%s # ", qdot_text_str(out) + from);
        for (size_t i = 0; i < s->remarks->n && out->n == end && line.n > 0; i++)
            if (strncmp(s->remarks->at[i], line.at, line.n) == 0)
                qdot_text_add(out, s->remarks->at[i] + line.n - 3);
        qdot_text_clear(&line);
    }
    qdot_text_char(out, '\n');
}

/* --- comments kept from files that were read --------------------------------------------- */

static bool
is_remembered_comment(const qdot_session *s, const char *line)
{
    for (size_t i = 0; i < s->remarks->n; i++)
        if (strcmp(s->remarks->at[i], line) == 0)
            return true;
    return false;
}

qdot_status
qdot_session_remarks_keep(qdot_session *s, const char *text, size_t length)
{
    const size_t skipped = strlen(qdot_session_file_header);
    const char *end = text + length;

    if (length < skipped || memcmp(text, qdot_session_file_header, skipped) != 0)
        return QDOT_OK;
    for (const char *line = text + skipped, *next; line < end; line = next + 1) {
        char *copy;

        next = memchr(line, '\n', (size_t)(end - line));
        next = next != NULL ? next : end;
        if (memchr(line, '#', (size_t)(next - line)) == NULL)
            continue;
        copy = qdot_malloc((size_t)(next - line) + 1);
        if (copy == NULL)
            return QDOT_ENOMEM;
        memcpy(copy, line, (size_t)(next - line));
        copy[next - line] = '\0';
        if (is_remembered_comment(s, copy) || qdot_vec_push(s->remarks, copy) != QDOT_OK)
            qdot_free(copy);
    }
    return QDOT_OK;
}

/* Whether a comment "# NAME: ..." or "# run ... as NAME: ..." concerns a name or run that exists again. */
static bool
comment_concerns_existing(const qdot_session *s, const char *line)
{
    const char *colon = strstr(line, ": "), *from = line + 2;
    char name[128];
    size_t n;

    for (const char *k = colon; k != NULL && strncmp(line, "# run ", 6) == 0 && k > from; k--)
        if (k[-1] == ' ') {
            from = k;
            break;
        }
    n = colon != NULL && colon > from ? (size_t)(colon - from) : 0;
    if (n == 0 || n >= sizeof name)
        return false;
    memcpy(name, from, n);
    name[n] = '\0';
    for (size_t k = 0; k < s->runs->n; k++)
        if (strcmp(s->runs->at[k].name, name) == 0)
            return true;
    return qdot_names_find(s->names, name) != NULL;
}

void
qdot_session_remarks_lost(const qdot_session *s, const qdot_text *more, qdot_text *out)
{
    for (size_t i = 0; i < s->remarks->n; i++)
        if (s->remarks->at[i][0] == '#' && !comment_concerns_existing(s, s->remarks->at[i]))
            qdot_text_format(out, "%s\n", s->remarks->at[i]);
    qdot_text_add(out, qdot_text_str(more));
}
