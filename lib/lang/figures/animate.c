/* animate.c -- the statement `animate`: a moving picture of a run. */
#include <math.h>
#include <string.h>

#include "lang/answer/answer.h"
#include "lang/figures/animated.h"
#include "lang/figures/figure-file.h"
#include "lang/commands/handlers.h"
#include "lang/language/read.h"
#include "lang/session/bind.h"
#include "lang/session/runs.h"

typedef struct {
    const char *run, *path;
    qdot_animated_options drawn;
} options;

static bool
is_option(const qdot_cursor *c)
{
    static const char *const words[] = {"from", "to", "title", "trail", "speed"};

    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (qdot_cursor_is_word(c, words[i]))
            return true;
    return false;
}

static qdot_status
read_time(qdot_cursor *c, const char *word, double *t)
{
    const qdot_token *start;

    QDOT_TRY(qdot_cursor_once(c, word, !isnan(*t)));
    start = c->at;
    QDOT_TRY(qdot_read_number(c, t));
    if (isfinite(*t))
        return QDOT_OK;
    c->error_at = start->start;
    return qdot_fail(QDOT_EDOMAIN, "`%s` needs a finite number", word);
}

/* A number that is not negative, of `speed` above 0. */
static qdot_status
read_length(qdot_cursor *c, const char *word, bool zero, double *value)
{
    const qdot_token *start = c->at;

    QDOT_TRY(read_time(c, word, value));
    if (*value > 0 || (zero && *value == 0))
        return QDOT_OK;
    c->error_at = start->start;
    return qdot_fail(QDOT_EDOMAIN, "`%s` needs a number %s 0", word,
                     zero ? "not below" : "above");
}

static qdot_status
animate_read_options(qdot_cursor *c, options *o)
{
    if (c->at->kind == QDOT_TOKEN_NAME && !is_option(c))
        QDOT_TRY(qdot_read_name(c, &o->run));
    while (!qdot_cursor_is_end(c)) {
        if (qdot_cursor_accept_word(c, "from")) {
            QDOT_TRY(read_time(c, "from", &o->drawn.from));
        } else if (qdot_cursor_is_word(c, "to") && c->at[1].kind != QDOT_TOKEN_STRING &&
                   !isnan(o->drawn.from)) {
            c->at++;
            QDOT_TRY(read_time(c, "to", &o->drawn.to));
        } else if (qdot_cursor_accept_word(c, "to")) {
            QDOT_TRY(qdot_figure_file_read(c, &o->path));
        } else if (qdot_cursor_accept_word(c, "title")) {
            QDOT_TRY(qdot_cursor_once(c, "title", o->drawn.title != NULL));
            QDOT_TRY(qdot_figure_title_read(c, &o->drawn.title));
        } else if (qdot_cursor_accept_word(c, "trail")) {
            QDOT_TRY(read_length(c, "trail", true, &o->drawn.trail));
        } else if (qdot_cursor_accept_word(c, "speed")) {
            QDOT_TRY(read_length(c, "speed", false, &o->drawn.speed));
        } else {
            return qdot_cursor_expected(
                c, "`from`, `to`, `title`, `trail`, `speed` or the end of the statement");
        }
    }
    return o->path != NULL
               ? QDOT_OK
               : qdot_cursor_expected(c, "`to` and the name of a file in quotes");
}

static qdot_status
write_picture(qdot_session *session, const qdot_animation *a, const char *path)
{
    qdot_text page = {0};
    qdot_status status;

    if (qdot_ends_in(path, ".gif")) {
        QDOT_TRY(qdot_animation_gif(a, path));
        return qdot_answer_file(session, path);
    }
    status = qdot_animation_page(a, &page);
    if (status == QDOT_OK)
        status = qdot_answer_in_file(session, path, &page);
    qdot_text_clear(&page);
    return status;
}

qdot_status
qdot_animate_statement(qdot_cursor *c)
{
    const qdot_token *start = c->at;
    options o = {.drawn = {NAN, NAN, NULL, NAN, NAN, false}};
    qdot_named_run *run;
    qdot_animation a;
    qdot_status status;

    QDOT_TRY(animate_read_options(c, &o));
    c->error_at = start->start;
    if (!qdot_ends_in(o.path, ".html") && !qdot_ends_in(o.path, ".gif")) {
        (void)qdot_fail(QDOT_EINVAL,
                        "`%.200s` does not say what moving picture it is to be", o.path);
        return qdot_hint("end its name in .html or .gif");
    }
    QDOT_TRY(qdot_runs_find(c->session, o.run, &run));
    status = qdot_animated_make(c->session, run, &o.drawn, &a);
    if (status == QDOT_OK)
        status = write_picture(c->session, &a, o.path);
    qdot_animation_clear(&a);
    return status;
}
