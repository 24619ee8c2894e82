/* animate.c -- the statement `animate`: makes a moving picture of a run. */
#include <math.h>
#include <string.h>

#include "lang/answer/answer.h"
#include "lang/figures/animated.h"
#include "lang/figures/figure-file.h"
#include "lang/session/bind.h"
#include "lang/session/runs.h"
#include "lang/syntax/record.h"

static qdot_status carry_out_animate(qdot_record *r);

#define OPTIONS "animate [RUN] [from A [to B]] [title TEXT] [trail T] [speed S] "

QDOT_STATEMENT(animate) = {
    .word = "animate",
    .group = QDOT_NUMBERS,
    .usage = OPTIONS "to \"FILE.html\"",
    .displayed = OPTIONS "[to \"FILE.html\"]",
    .summary = "an animation of a run: particles, bodies, rods, springs, dampers, with a phase portrait "
               "and the energies beside it",
    .example = "animate to \"double.html\"",
    .handler = carry_out_animate,
};

/* Read the finite number of an option; *t is NaN if the option is missing. */
static qdot_status
read_time(qdot_record *r, const qdot_filled *part, double *t)
{
    *t = NAN;
    if (part == NULL)
        return QDOT_OK;
    QDOT_TRY(qdot_record_number(r, part, t));
    if (isfinite(*t))
        return QDOT_OK;
    qdot_record_blame(r, part);
    return qdot_fail(QDOT_EDOMAIN, "`%s` needs a finite number", part->node->before);
}

/* Read a number that must be positive, or with `zero` not negative. */
static qdot_status
read_length(qdot_record *r, const qdot_filled *part, bool zero, double *value)
{
    QDOT_TRY(read_time(r, part, value));
    if (part == NULL || *value > 0 || (zero && *value == 0))
        return QDOT_OK;
    qdot_record_blame(r, part);
    return qdot_fail(QDOT_EDOMAIN, "`%s` needs a number %s 0", part->node->before,
                     zero ? "not below" : "above");
}

static qdot_status
read_options(qdot_record *r, qdot_animated_options *drawn)
{
    const qdot_filled *title = qdot_record_hole(r, "title", NULL);

    if (title != NULL)
        drawn->title = qdot_record_text(title);
    QDOT_TRY(read_time(r, qdot_record_hole(r, "from", "A"), &drawn->from));
    QDOT_TRY(read_time(r, qdot_record_hole(r, "to", "B"), &drawn->to));
    QDOT_TRY(read_length(r, qdot_record_hole(r, "trail", "T"), true, &drawn->trail));
    return read_length(r, qdot_record_hole(r, "speed", "S"), false, &drawn->speed);
}

static qdot_status
write_picture(qdot_session *session, const char *run, const qdot_animation *a, const char *path)
{
    qdot_text page = {0};
    qdot_status status;

    if (path == NULL) {
        status = qdot_animation_page(a, &page);
        return qdot_answer_shown(session, "page", "text/html", a->title != NULL ? a->title : run, status, &page);
    }
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

static qdot_status
carry_out_animate(qdot_record *r)
{
    const qdot_filled *name = qdot_record_hole(r, "animate", "RUN");
    const qdot_filled *file = qdot_record_hole(r, "to", "\"FILE.html\"");
    const char *path = file != NULL ? qdot_record_text(file) : NULL, *of = NULL;
    qdot_session *session = r->cursor.session;
    qdot_animated_options drawn = {NAN, NAN, NULL, NAN, NAN, false};
    qdot_named_run *run;
    qdot_animation a;
    qdot_status status;

    if (name != NULL)
        QDOT_TRY(qdot_record_name(r, name, &of));
    QDOT_TRY(read_options(r, &drawn));
    r->cursor.error_at = r->start->start;
    if (path != NULL && !qdot_ends_in(path, ".html") && !qdot_ends_in(path, ".gif")) {
        (void)qdot_fail(QDOT_EINVAL,
                        "`%.200s` does not say which kind of animation to write", path);
        return qdot_hint("end its name in .html or .gif");
    }
    QDOT_TRY(qdot_runs_find(session, of, &run));
    status = qdot_animated_make(session, run, &drawn, &a);
    if (status == QDOT_OK)
        status = write_picture(session, run->name, &a, path);
    qdot_animation_clear(&a);
    return status;
}
