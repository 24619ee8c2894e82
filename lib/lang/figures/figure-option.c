/* figure-option.c -- reads the options of a figure. */
#include "lang/figures/figure-option.h"

#include <math.h>
#include <string.h>

#include "lang/session/bind.h"

static const double least_size = 3, most_size = 100; /* smallest and largest size of a figure in cm */

static qdot_status
read_axis_range(qdot_record *r, const qdot_filled *place, double least, double most, qdot_figure_range *range)
{
    if (!isfinite(least) || !isfinite(most) || !(least < most)) {
        qdot_record_blame(r, place);
        (void)qdot_fail(QDOT_EINVAL, "nothing lies between %.6g and %.6g", least, most);
        return qdot_hint("the least comes first");
    }
    *range = (qdot_figure_range){least, most, true};
    return QDOT_OK;
}

/* Read the range `A to B` of the horizontal axis from the parts of the statement. */
static qdot_status
read_abscissa_range(qdot_record *r, const qdot_filled *a, qdot_panel_choice *p)
{
    double least, most;

    QDOT_TRY(qdot_record_number(r, a, &least));
    QDOT_TRY(qdot_record_number(r, qdot_record_next(r, a, "B"), &most));
    return read_axis_range(r, a, least, most, &p->range[0]);
}

/* Read the range A..B of the vertical axis from the parts of the statement. */
static qdot_status
read_ordinate_range(qdot_record *r, const qdot_filled *range, qdot_panel_choice *p)
{
    double least, most;
    qdot_expr from, to;

    QDOT_TRY(qdot_record_range(r, range, &from, &to));
    QDOT_TRY(qdot_session_number(r->cursor.session, from, &least, NULL));
    QDOT_TRY(qdot_session_number(r->cursor.session, to, &most, NULL));
    return read_axis_range(r, range, least, most, &p->range[1]);
}

static qdot_status
read_length(qdot_record *r, const qdot_filled *part, double *length)
{
    QDOT_TRY(qdot_record_number(r, part, length));
    if (*length >= least_size && *length <= most_size)
        return QDOT_OK;
    qdot_record_blame(r, part);
    return qdot_fail(QDOT_EINVAL, "a figure is %.0f to %.0f cm wide and high, not %.6g",
                     least_size, most_size, *length);
}

/* Read a list of texts X, ..., of which there may be at most `most`. */
static qdot_status
read_texts(qdot_record *r, const qdot_filled *first, size_t most, const char **texts, size_t *n)
{
    const qdot_filled *end = r->parts.at + r->parts.n;

    for (const qdot_filled *part = first; part < end; part += 2) {
        if (*n == most) {
            qdot_record_blame(r, part);
            return most == 3 ? qdot_fail(QDOT_EINVAL, "a figure has no more than three axes")
                             : qdot_fail(QDOT_EINVAL, "a legend has no more than %zu names", most);
        }
        texts[(*n)++] = qdot_record_text(part);
        if (part + 1 == end || !qdot_filled_is(part + 1, ","))
            break;
    }
    return QDOT_OK;
}

/* Fail because the word is no name of a colour; the hint lists the names of colours. */
static qdot_status
refuse_colour(qdot_record *r, const qdot_filled *part)
{
    qdot_text names = {0};

    for (size_t i = 0; qdot_figure_colour_name(i) != NULL; i++)
        qdot_text_format(&names, "%s%s", i > 0 ? ", " : "", qdot_figure_colour_name(i));
    qdot_record_blame(r, part);
    (void)qdot_fail(QDOT_ENAME, "there is no colour `%.40s`", part->from->text);
    (void)qdot_hint("the colours are %s", qdot_text_str(&names));
    qdot_text_clear(&names);
    return QDOT_ENAME;
}

/* Read the colours of the curves, in their order, after the word `colour`. */
static qdot_status
read_colours(qdot_record *r, const qdot_filled *first, qdot_panel_choice *p)
{
    const qdot_filled *end = r->parts.at + r->parts.n;

    for (const qdot_filled *part = first; part < end; part += 2) {
        const char *name;
        size_t i = 0;

        while ((name = qdot_figure_colour_name(i)) != NULL && !qdot_filled_is_word(part, name))
            i++;
        if (name == NULL)
            return refuse_colour(r, part);
        if (p->n_colours == QDOT_FIGURE_LEGEND) {
            qdot_record_blame(r, part);
            return qdot_fail(QDOT_EINVAL, "`colour` has no more than %d names", QDOT_FIGURE_LEGEND);
        }
        p->colours[p->n_colours++] = i;
        if (part + 1 == end || !qdot_filled_is(part + 1, ","))
            break;
    }
    return QDOT_OK;
}

/* Read the texts of all axes, after `labels`, or of one axis, after `xlabel` or `ylabel`. */
static qdot_status
read_labels(qdot_record *r, const qdot_filled *word, qdot_panel_choice *p)
{
    const bool x = qdot_filled_is(word, "xlabel"), y = qdot_filled_is(word, "ylabel");

    if (x || y ? p->n_labels > 0 : p->labels[0] != NULL || p->labels[1] != NULL) {
        qdot_record_blame(r, word);
        return qdot_fail(QDOT_EINVAL, "`labels` names the axes: no `xlabel` or `ylabel` beside it");
    }
    if (!x && !y)
        return read_texts(r, word + 1, 3, p->labels, &p->n_labels);
    p->labels[y] = qdot_record_text(word + 1);
    return QDOT_OK;
}

/* Whether an earlier panel has already given this option of the whole figure. */
static bool
is_already_given(const qdot_figure_choice *f, const qdot_filled *word)
{
    return (qdot_filled_is(word, "size") && f->width > 0) || (qdot_filled_is(word, "keep") && f->keep) ||
           (qdot_filled_is(word, "to") && f->path != NULL && qdot_filled_is_text(word + 1));
}

/* Read one option of a figure: `word` is its keyword, the next part of the statement its value. */
static qdot_status
read_option(qdot_record *r, const qdot_filled *word, qdot_figure_choice *f, qdot_panel_choice *p)
{
    const qdot_filled *hole = word + 1;

    if (is_already_given(f, word)) {
        qdot_record_blame(r, word);
        return qdot_fail(QDOT_EINVAL, "`%s` is given twice", word->from->text);
    }
    if (qdot_filled_is(word, "from"))
        return read_abscissa_range(r, hole, p);
    if (qdot_filled_is(word, "range"))
        return read_ordinate_range(r, hole, p);
    if (qdot_filled_is(word, "labels") || qdot_filled_is(word, "xlabel") || qdot_filled_is(word, "ylabel"))
        return read_labels(r, word, p);
    if (qdot_filled_is(word, "legend"))
        return read_texts(r, hole, QDOT_FIGURE_LEGEND, p->legend, &p->n_legend);
    if (qdot_filled_is(word, "colour"))
        return read_colours(r, hole, p);
    if (qdot_filled_is(word, "size")) {
        QDOT_TRY(read_length(r, hole, &f->width));
        return read_length(r, qdot_record_next(r, hole, "H"), &f->height);
    }
    if (qdot_filled_is(word, "log")) {
        p->logs = true;
        p->log[0] = !qdot_filled_is(hole, "y");
        p->log[1] = !qdot_filled_is(hole, "x");
    } else if (qdot_filled_is(word, "ticks")) {
        p->ticks = word;
        hole = word + 2; /* the part of the statement after the word `pi` */
        if (hole < r->parts.at + r->parts.n) {
            p->pi[0] = qdot_filled_is(hole, "x") || qdot_filled_is(hole, "xy");
            p->pi[1] = qdot_filled_is(hole, "y") || qdot_filled_is(hole, "xy");
        }
    } else if (qdot_filled_is(word, "title")) {
        p->title = qdot_record_text(hole);
    } else if (qdot_filled_is(word, "equal")) {
        p->equal = true;
    } else if (qdot_filled_is(word, "points")) {
        p->points = true;
    } else if (qdot_filled_is(word, "lines")) {
        p->lines = true;
    } else if (qdot_filled_is(word, "keep")) {
        f->keep = true;
    } else if (qdot_filled_is(word, "to") && qdot_filled_is_text(hole)) {
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
            QDOT_TRY(read_option(r, part, figure, panel));
    return QDOT_OK;
}

/* Whether the abscissa is the time, so that angles are on the ordinate. */
static bool
abscissa_is_time(const qdot_panel *panel)
{
    return panel->axis[0].formula && panel->axis[0].text != NULL && strcmp(panel->axis[0].text, "t") == 0;
}

qdot_status
qdot_figure_option_no_angles(qdot_record *r, const qdot_panel_choice *choice)
{
    if (choice->ticks == NULL)
        return QDOT_OK;
    qdot_record_blame(r, choice->ticks);
    (void)qdot_fail(QDOT_EINVAL, "neither axis of this figure is an angle");
    return qdot_hint("leave out `ticks pi`");
}

/* Fail at the option: axis k of the panel, which is logarithmic, is to have tics at multiples of pi. */
static qdot_status
refuse_angles(qdot_record *r, const qdot_filled *ticks, const qdot_panel *panel, int k)
{
    qdot_record_blame(r, ticks);
    (void)qdot_fail(QDOT_EINVAL, "the %s axis is logarithmic: it has no tics at multiples of pi",
                    k == 0 ? "horizontal" : "vertical");
    return panel->log[1 - k] ? qdot_hint("leave out `ticks pi`")
                             : qdot_hint("leave out `ticks pi`; `ticks pi %s` is for the other axis", k == 0 ? "y" : "x");
}

qdot_status
qdot_figure_option_apply(qdot_record *r, const qdot_panel_choice *choice, qdot_panel *panel)
{
    for (int k = 0; k < 2; k++) {
        panel->range[k] = choice->range[k];
        panel->log[k] = choice->logs ? choice->log[k] : panel->log[k];
        panel->pi[k] = choice->ticks != NULL && (choice->pi[k] || (!choice->pi[1 - k] && k == abscissa_is_time(panel)));
    }
    for (int k = 0; k < 2; k++)
        if (panel->pi[k] && panel->log[k])
            return refuse_angles(r, choice->ticks, panel, k);
    panel->degrees = choice->degrees;
    panel->equal = panel->equal || choice->equal;
    panel->points = choice->points || (panel->points && !choice->lines);
    panel->marks = panel->marks && !choice->lines;
    panel->lines = choice->lines;
    panel->n_colours = choice->n_colours;
    memcpy(panel->colours, choice->colours, sizeof panel->colours);
    panel->n_legend = choice->n_legend;
    memcpy(panel->legend, choice->legend, sizeof panel->legend);
    if (choice->title != NULL)
        panel->title = (qdot_figure_label){choice->title, false};
    for (size_t k = 0; k < 3; k++)
        if (choice->labels[k] != NULL) {
            panel->axis[k] = (qdot_figure_label){choice->labels[k], false};
            panel->unit[k] = NULL;
        }
    if (choice->degrees)
        panel->unit[1] = NULL;
    return QDOT_OK;
}
