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

/* Read `A to B`, the range of the horizontal axis. */
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

/* Read an option whose word has been stepped over. */
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

/* --- options of a record -------------------------------------------------------------- */

static qdot_status
range_find(qdot_record *r, const qdot_filled *place, double least, double most, qdot_figure_range *range)
{
    if (!isfinite(least) || !isfinite(most) || !(least < most)) {
        qdot_record_blame(r, place);
        (void)qdot_fail(QDOT_EINVAL, "nothing lies between %.6g and %.6g", least, most);
        return qdot_hint("the least comes first");
    }
    *range = (qdot_figure_range){least, most, true};
    return QDOT_OK;
}

/* Take the range `A to B` of the horizontal axis from the parts of a statement. */
static qdot_status
abscissa_find(qdot_record *r, const qdot_filled *a, qdot_panel_choice *p)
{
    double least, most;

    QDOT_TRY(qdot_record_number(r, a, &least));
    QDOT_TRY(qdot_record_number(r, qdot_record_next(r, a, "B"), &most));
    return range_find(r, a, least, most, &p->range[0]);
}

/* A..B */
static qdot_status
ordinate_find(qdot_record *r, const qdot_filled *range, qdot_panel_choice *p)
{
    double least, most;
    qdot_expr from, to;

    QDOT_TRY(qdot_record_range(r, range, &from, &to));
    QDOT_TRY(qdot_session_number(r->cursor.session, from, &least, NULL));
    QDOT_TRY(qdot_session_number(r->cursor.session, to, &most, NULL));
    return range_find(r, range, least, most, &p->range[1]);
}

static qdot_status
length_find(qdot_record *r, const qdot_filled *part, double *length)
{
    QDOT_TRY(qdot_record_number(r, part, length));
    if (*length >= least_size && *length <= most_size)
        return QDOT_OK;
    qdot_record_blame(r, part);
    return qdot_fail(QDOT_EINVAL, "a figure is %.0f to %.0f cm wide and high, not %.6g",
                     least_size, most_size, *length);
}

/* X, ... */
static qdot_status
labels_find(qdot_record *r, const qdot_filled *first, qdot_panel_choice *p)
{
    const qdot_filled *end = r->parts.at + r->parts.n;

    for (const qdot_filled *part = first; part < end; part += 2) {
        if (p->n_labels == 3) {
            qdot_record_blame(r, part);
            return qdot_fail(QDOT_EINVAL, "a figure has no more than three axes");
        }
        p->labels[p->n_labels++] = qdot_record_text(part);
        if (part + 1 == end || !qdot_filled_is(part + 1, ","))
            break;
    }
    return QDOT_OK;
}

/* Take one option: its word is this part, its value the next. */
static qdot_status
one_find(qdot_record *r, const qdot_filled *word, qdot_figure_choice *f, qdot_panel_choice *p)
{
    const qdot_filled *hole = word + 1;

    if (qdot_filled_is(word, "from"))
        return abscissa_find(r, hole, p);
    if (qdot_filled_is(word, "range"))
        return ordinate_find(r, hole, p);
    if (qdot_filled_is(word, "labels"))
        return labels_find(r, hole, p);
    if (qdot_filled_is(word, "size")) {
        QDOT_TRY(length_find(r, hole, &f->width));
        return length_find(r, qdot_record_next(r, hole, "H"), &f->height);
    }
    if (qdot_filled_is(word, "log")) {
        p->logs = true;
        p->log[0] = !qdot_filled_is(hole, "y");
        p->log[1] = !qdot_filled_is(hole, "x");
    } else if (qdot_filled_is(word, "title")) {
        p->title = qdot_record_text(hole);
    } else if (qdot_filled_is(word, "keep")) {
        f->keep = true;
    } else if (qdot_filled_is(word, "to") && hole->from->kind == QDOT_TOKEN_STRING) {
        f->path = qdot_record_text(hole);
    }
    return QDOT_OK;
}

qdot_status
qdot_figure_option_find(qdot_record *r, const qdot_filled *from, const qdot_filled *to,
                        qdot_figure_choice *figure, qdot_panel_choice *panel)
{
    for (const qdot_filled *part = from; part < to; part++)
        if (part->node->kind == QDOT_USAGE_WORD)
            QDOT_TRY(one_find(r, part, figure, panel));
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
