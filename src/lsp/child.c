/* child.c -- the process that runs a script for a command of the editor. */
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "qdot.h"
#include "tasks.h"

enum { MOST = 1 << 28 };

static void
handle_interrupt(int signal_number)
{
    (void)signal_number;
    qdot_interrupt_set();
}

static void
write_object(json_t *line)
{
    char *text = line != NULL ? json_dumps(line, JSON_COMPACT) : NULL;

    if (text != NULL) {
        fputs(text, stdout);
        fputc('\n', stdout);
        if (fflush(stdout) != 0)
            qdot_interrupt_set(); /* nobody reads it any more */
    }
    free(text);
    json_decref(line);
}

static void
tell_progress(void *data, const char *what, double done, double left)
{
    (void)data;
    write_object(json_pack("{s:s, s:f, s:o}", "progress", what, "done", isfinite(done) ? done : 0, "left",
                         isfinite(left) ? json_real(left) : json_null()));
}

/* Sort the objects of an answer for display into figures and formulas. */
static void
sort_answers(const char *answers, json_t *figures, json_t *latex, qdot_text *text)
{
    while (answers != NULL && *answers != '\0') {
        const char *end = strchr(answers, '\n');
        const size_t n = end != NULL ? (size_t)(end - answers) : strlen(answers);
        json_t *object = json_loadb(answers, n, 0, NULL);
        const char *kind = json_string_value(json_object_get(object, "kind"));
        const json_t *typeset = json_object_get(json_object_get(object, "typeset"), "latex");
        const char *plain = json_string_value(json_object_get(object, "plain")),
                   *name = json_string_value(json_object_get(object, "name")),
                   *said = json_string_value(json_object_get(object, "text"));

        if (kind != NULL && (strcmp(kind, "figure") == 0 || strcmp(kind, "page") == 0))
            (void)json_array_append(figures, object);
        if (json_is_string(typeset))
            (void)json_array_append(latex, (json_t *)typeset);
        if (plain != NULL)
            qdot_text_format(text, "%s%s%s\n", name != NULL ? name : "", name != NULL ? " = " : "", plain);
        else if (said != NULL)
            qdot_text_format(text, "%s\n", said);
        json_decref(object);
        answers = end != NULL ? end + 1 : NULL;
    }
}

int
qdot_task_run(const char *kind)
{
    const bool run = strcmp(kind, "run") == 0;
    qdot_system *system = NULL;
    qdot_text script = {0}, text = {0};
    char *answers = NULL;
    json_t *figures = json_array(), *latex = json_array(), *result;
    qdot_result status;

    (void)signal(SIGINT, handle_interrupt);
    if (!qdot_text_add_stream(&script, stdin, MOST) || script.failed || qdot_system_new(&system) != QDOT_RESULT_OK)
        return 1;
    (void)qdot_system_progress(system, tell_progress, NULL);
    status = qdot_system_ask(system, qdot_text_str(&script), run ? QDOT_NOTATION_UNICODE : QDOT_NOTATION_DISPLAY, &answers);
    if (run)
        qdot_text_format(&text, "%s%s", qdot_system_notices(system), answers != NULL ? answers : "");
    else
        sort_answers(answers, figures, latex, &text);
    result = json_pack("{s:s, s:s, s:i, s:o, s:o}", "text", qdot_text_str(&text), "error", qdot_system_error(system), "status",
                       (int)status, "latex", latex, "figures", figures);
    write_object(result);
    qdot_string_free(answers);
    qdot_system_free(system);
    qdot_text_clear(&script);
    qdot_text_clear(&text);
    return 0;
}
