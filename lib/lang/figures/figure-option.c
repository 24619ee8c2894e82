/* figure-option.c -- options of a figure, read in any order, each once. */
#include "lang/figures/figure-option.h"

#include <math.h>
#include <string.h>

#include "lang/figures/figure-file.h"
#include "lang/language/read.h"
#include "lang/session/bind.h"

static const double least_size = 3, most_size = 100; /* cm */

static qdot_status
expected(qdot_cursor *c, const char *what)
{
    c->error_at = c->at->start;
    return qdot_fail(QDOT_ESYNTAX, "expected %s", what);
}

static qdot_status
read_text(qdot_cursor *c, const char **text)
{
    if (c->at->kind != QDOT_TOKEN_STRING)
        return expected(c, "a text in quotes");
    return qdot_read_string(c, text);
}

static qdot_status
set_range(qdot_cursor *c, const qdot_token *start, double least, double most,
          qdot_figure_range *range)
{
    if (!isfinite(least) || !isfinite(most) || !(least < most)) {
        c->error_at = start->start;
        (void)qdot_fail(QDOT_EINVAL, "nothing lies between %.6g and %.6g", least, most);
        return qdot_hint("the least comes first");
    }
    *range = (qdot_figure_range){least, most, true};
    return QDOT_OK;
}

/* A to B */
static qdot_status
read_from(qdot_cursor *c, qdot_panel_choice *p)
{
    const qdot_token *start = c->at;
    double least, most;

    QDOT_TRY(qdot_cursor_once(c, "from", p->range[0].set));
    QDOT_TRY(qdot_read_number(c, &least));
    if (!qdot_cursor_accept_word(c, "to"))
        return expected(c, "`to`, as in from 0 to 5");
    QDOT_TRY(qdot_read_number(c, &most));
    return set_range(c, start, least, most, &p->range[0]);
}

/* A..B */
static qdot_status
read_ordinate(qdot_cursor *c, qdot_panel_choice *p)
{
    const qdot_token *start = c->at;
    double least, most;
    qdot_expr from, to;

    QDOT_TRY(qdot_cursor_once(c, "range", p->range[1].set));
    QDOT_TRY(qdot_read_range(c, &from, &to));
    QDOT_TRY(qdot_session_number(c->session, from, &least, NULL));
    QDOT_TRY(qdot_session_number(c->session, to, &most, NULL));
    return set_range(c, start, least, most, &p->range[1]);
}

static qdot_status
read_log(qdot_cursor *c, qdot_panel_choice *p)
{
    QDOT_TRY(qdot_cursor_once(c, "log", p->logs));
    p->logs = true;
    p->log[0] = qdot_cursor_is_word(c, "x") || qdot_cursor_is_word(c, "xy");
    p->log[1] = qdot_cursor_is_word(c, "y") || qdot_cursor_is_word(c, "xy");
    if (!p->log[0] && !p->log[1])
        return expected(c, "x, y or xy");
    c->at++;
    return QDOT_OK;
}

static qdot_status
read_labels(qdot_cursor *c, qdot_panel_choice *p)
{
    QDOT_TRY(qdot_cursor_once(c, "labels", p->n_labels > 0));
    do {
        if (p->n_labels == 3)
            return qdot_fail(QDOT_EINVAL, "a figure has no more than three axes");
        QDOT_TRY(read_text(c, &p->labels[p->n_labels++]));
    } while (qdot_cursor_accept_op(c, ","));
    return QDOT_OK;
}

static qdot_status
read_length(qdot_cursor *c, double *length)
{
    const qdot_token *start = c->at;

    QDOT_TRY(qdot_read_number(c, length));
    if (*length >= least_size && *length <= most_size)
        return QDOT_OK;
    c->error_at = start->start;
    return qdot_fail(QDOT_EINVAL, "a figure is %.0f to %.0f cm wide and high, not %.6g",
                     least_size, most_size, *length);
}

/* W, H */
static qdot_status
read_size(qdot_cursor *c, qdot_figure_choice *f)
{
    QDOT_TRY(qdot_cursor_once(c, "size", f->width > 0));
    QDOT_TRY(read_length(c, &f->width));
    if (!qdot_cursor_accept_op(c, ","))
        return expected(c, "`,` and the height in cm");
    return read_length(c, &f->height);
}

static const char *const words[] = {"from", "range", "log",  "title",
                                    "labels", "size", "keep", "to"};

bool
qdot_figure_option_is(const qdot_token *token)
{
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (qdot_token_is_word(token, words[i]))
            return true;
    return false;
}

/* The option whose word was stepped over. */
static qdot_status
figure_option_read(qdot_cursor *c, const char *word, qdot_figure_choice *f, qdot_panel_choice *p)
{
    if (strcmp(word, "from") == 0)
        return read_from(c, p);
    if (strcmp(word, "range") == 0)
        return read_ordinate(c, p);
    if (strcmp(word, "log") == 0)
        return read_log(c, p);
    if (strcmp(word, "labels") == 0)
        return read_labels(c, p);
    if (strcmp(word, "size") == 0)
        return read_size(c, f);
    if (strcmp(word, "to") == 0)
        return qdot_figure_file_read(c, &f->path);
    if (strcmp(word, "title") == 0) {
        QDOT_TRY(qdot_cursor_once(c, "title", p->title != NULL));
        return read_text(c, &p->title);
    }
    QDOT_TRY(qdot_cursor_once(c, "keep", f->keep));
    f->keep = true;
    return QDOT_OK;
}

qdot_status
qdot_figure_option_read(qdot_cursor *c, qdot_figure_choice *figure, qdot_panel_choice *panel)
{
    while (qdot_figure_option_is(c->at)) {
        const char *word = c->at->text;

        c->at++;
        QDOT_TRY(figure_option_read(c, word, figure, panel));
    }
    return QDOT_OK;
}

void
qdot_figure_option_apply(const qdot_panel_choice *choice, qdot_panel *panel)
{
    for (int k = 0; k < 2; k++) {
        panel->range[k] = choice->range[k];
        panel->log[k] = choice->logs ? choice->log[k] : panel->log[k];
    }
    if (choice->title != NULL)
        panel->title = (qdot_figure_label){choice->title, false};
    for (size_t k = 0; k < choice->n_labels; k++)
        panel->axis[k] = (qdot_figure_label){choice->labels[k], false};
}
