/* plot.c -- makes a figure from panels of curves. */
#include <string.h>

#include "lang/figures/figure-file.h"
#include "lang/figures/plot-bode.h"
#include "lang/figures/plot-parts.h"
#include "lang/figures/plot.h"
#include "lang/figures/plot-rows.h"
#include "lang/session/units.h"
#include "lang/answer/answer.h"
#include "show/pole.h"

enum { LONGEST_LABEL = 48 };

typedef qdot_vec(qdot_plot_panel) panels;

/* --- curves and panels -------------------------------------------------------------- */

static void
free_curve(qdot_plot_curve *curve)
{
    qdot_free(curve->label);
    qdot_free(curve->axis);
    qdot_free(curve->unit);
    qdot_tape_free(curve->tape);
    qdot_free(curve->work);
    if (!curve->borrowed)
        qdot_free(curve->response);
    qdot_trace_clear(&curve->points);
    qdot_free(curve);
}

void
qdot_plot_panel_clear(qdot_plot_panel *p)
{
    for (size_t i = 0; i < p->curves.n; i++)
        free_curve(p->curves.at[i]);
    qdot_free(p->curves.at);
    qdot_free(p->items.at);
    for (size_t i = 0; i < p->passes.n; i++)
        qdot_free(p->passes.at[i]);
    qdot_free(p->passes.at);
    for (size_t i = 0; i < p->made.n; i++)
        qdot_named_run_release(&p->made.at[i]);
    qdot_free(p->made.at);
    qdot_free(p->variable);
    qdot_operands_free(&p->operands);
    qdot_operands_free(&p->versus);
}

qdot_status
qdot_plot_curve_add(qdot_plot_panel *p, const char *label, const char *axis,
                    qdot_plot_curve **added)
{
    qdot_plot_curve *curve = qdot_calloc(1, sizeof *curve);

    if (curve == NULL)
        return QDOT_ENOMEM;
    curve->label = qdot_strdup(label);
    curve->axis = qdot_strdup(axis);
    if (curve->label == NULL || curve->axis == NULL ||
        qdot_vec_push(&p->curves, curve) != QDOT_OK) {
        free_curve(curve);
        return QDOT_ENOMEM;
    }
    *added = curve;
    return QDOT_OK;
}

qdot_status
qdot_plot_curve_unit(qdot_session *session, qdot_plot_curve *curve, qdot_expr e)
{
    qdot_text unit = {0};

    qdot_units_label(session, e, &unit);
    if (unit.n > 0)
        curve->unit = unit.at;
    else
        qdot_text_clear(&unit);
    return unit.failed ? QDOT_ENOMEM : QDOT_OK;
}

/* --- making the figure -------------------------------------------------------------- */

/* Objects of the session that a figure borrows while it is drawn. */
typedef struct {
    qdot_panel *panels;
    qdot_curve *curves;
    qdot_text *labels; /* [4 n] labels of the x and y axis of each panel, then their units */
    size_t n;
} frame;

static void
free_frame(frame *f)
{
    for (size_t i = 0; f->labels != NULL && i < 4 * f->n; i++)
        qdot_text_clear(&f->labels[i]);
    qdot_free(f->labels);
    qdot_free(f->panels);
    qdot_free(f->curves);
}

/* Join the different labels of an axis; an axis whose labels are too long gets none. */
static void
join_axis_labels(const qdot_plot_panel *p, qdot_text *x, qdot_text *y)
{
    for (size_t i = 0; i < p->curves.n; i++) {
        bool known = false;

        for (size_t k = 0; k < i; k++)
            known = known || strcmp(p->curves.at[k]->axis, p->curves.at[i]->axis) == 0;
        if (!known)
            qdot_text_format(y, "%s%s", y->n > 0 ? ", " : "", p->curves.at[i]->axis);
    }
    for (size_t i = 0; i < p->versus.n; i++) {
        bool known = false;

        for (size_t k = 0; k < i; k++)
            known = known || strcmp(p->versus.at[k].label, p->versus.at[i].label) == 0;
        if (!known)
            qdot_text_format(x, "%s%s", x->n > 0 ? ", " : "", p->versus.at[i].label);
    }
    if (p->versus.n == 0)
        qdot_text_add(x, p->variable != NULL ? p->variable : "t");
    if (y->n > LONGEST_LABEL)
        qdot_text_truncate(y, 0);
    if (x->n > LONGEST_LABEL)
        qdot_text_truncate(x, 0);
}

/* Join the units of an axis, one for each label where they differ; there is none where a label has none. */
static void
join_units(qdot_text *unit, const char *const *each, size_t n)
{
    bool same = true, all = n > 0;

    for (size_t i = 0; i < n; i++) {
        all = all && each[i] != NULL;
        same = same && all && strcmp(each[i], each[0]) == 0;
    }
    for (size_t i = 0; i < (same ? 1 : n) && all; i++)
        qdot_text_format(unit, "%s%s", i > 0 ? ", " : "", each[i]);
}

/* The unit of the y axis from those of the curves whose labels are joined there. */
static qdot_status
write_unit_of_ordinate(const qdot_plot_panel *p, qdot_text *unit)
{
    const char **each = qdot_calloc(p->curves.n + 1, sizeof *each);
    size_t n = 0;

    if (each == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < p->curves.n; i++) {
        bool known = false;

        for (size_t k = 0; k < i; k++)
            known = known || strcmp(p->curves.at[k]->axis, p->curves.at[i]->axis) == 0;
        if (!known)
            each[n++] = p->curves.at[i]->unit;
    }
    join_units(unit, each, n);
    qdot_free(each);
    return qdot_text_status(unit);
}

/* The unit of the x axis: of the one abscissa, the variable or t; several have none. */
static qdot_status
write_unit_of_abscissa(qdot_session *session, const qdot_plot_panel *p, qdot_text *unit)
{
    if (p->versus.n > 1 || (p->versus.n == 1 && p->versus.at[0].columns.n == 0))
        return QDOT_OK;
    if (p->versus.n == 1)
        qdot_units_label(session, p->versus.at[0].columns.at[0], unit);
    else if (p->over != QDOT_NIL)
        qdot_units_label(session, p->over, unit);
    else if (p->variable == NULL)
        qdot_units_label(session, QDOT_T, unit);
    return qdot_text_status(unit);
}

/* Write the units of the axes of a panel. */
static qdot_status
give_units(qdot_session *session, const qdot_plot_panel *p, qdot_text *units, qdot_panel *panel)
{
    if (!qdot_units_on(session))
        return QDOT_OK;
    if (panel->equal) {
        for (int k = 0; k < 3; k++)
            panel->unit[k] = p->curves.at[0]->unit;
        return QDOT_OK;
    }
    QDOT_TRY(write_unit_of_abscissa(session, p, &units[0]));
    QDOT_TRY(write_unit_of_ordinate(p, &units[1]));
    for (int k = 0; k < 2; k++)
        panel->unit[k] = units[k].n > 0 ? qdot_text_str(&units[k]) : NULL;
    return QDOT_OK;
}

/* Label the axes of a panel; a path has the axes x, y, z, and its label becomes the title. */
static void
label_panel(const qdot_plot_panel *p, qdot_text *labels, qdot_panel *panel)
{
    static const char *const space[] = {"x", "y", "z"};

    if (panel->equal) {
        for (int k = 0; k < (panel->curves[0].z != NULL ? 3 : 2); k++)
            panel->axis[k] = (qdot_figure_label){space[k], false};
        if (panel->n == 1)
            panel->title = panel->curves[0].label;
        return;
    }
    join_axis_labels(p, &labels[0], &labels[1]);
    for (int k = 0; k < 2; k++)
        panel->axis[k] = (qdot_figure_label){qdot_text_str(&labels[k]), true};
}

static bool
shows_drifts_only(const qdot_plot_panel *p)
{
    bool all = p->items.n > 0;

    for (size_t i = 0; i < p->items.n; i++)
        all = all && p->items.at[i].drift;
    return all;
}

static void
copy_curve_for_figure(const qdot_plot_curve *from, const qdot_panel_choice *choice, qdot_curve *to)
{
    *to = (qdot_curve){.label = {from->label, !from->literal},
                       .rows = from->points.n,
                       .x = from->points.at[0],
                       .y = from->points.at[1],
                       .z = from->points.at[2],
                       .points = from->data && !choice->lines,
                       .shown = from->shown};
}

/* Look for poles of the curves of a panel whose vertical range was not given. */
static qdot_status
find_poles(qdot_plot_panel *p)
{
    const bool path = p->operands.n > 0 && p->operands.at[0].vector;

    if (path || p->choice.range[1].set || p->choice.points || (p->choice.logs && p->choice.log[1]))
        return QDOT_OK;
    for (size_t k = 0; k < p->curves.n; k++) {
        qdot_plot_curve *curve = p->curves.at[k];

        if (curve->drift || curve->data)
            continue;
        QDOT_TRY(qdot_pole_find(&curve->source, &curve->points, &curve->shown));
        curve->source.jumps = curve->source.jumps || curve->shown.set;
    }
    return QDOT_OK;
}

/* Build the figure from the points computed so far. */
static qdot_status
build_figure(qdot_record *r, const panels *all, frame *f)
{
    size_t n = 0, next = 0;

    for (size_t i = 0; i < all->n; i++)
        n += all->at[i].curves.n;
    f->n = all->n;
    f->panels = qdot_calloc(all->n, sizeof *f->panels);
    f->curves = qdot_calloc(n, sizeof *f->curves);
    f->labels = qdot_calloc(4 * all->n, sizeof *f->labels);
    if (f->panels == NULL || f->curves == NULL || f->labels == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < all->n; i++) {
        const qdot_plot_panel *p = &all->at[i];
        qdot_panel *panel = &f->panels[i];

        *panel = (qdot_panel){.curves = f->curves + next, .n = p->curves.n};
        for (size_t k = 0; k < panel->n; k++)
            copy_curve_for_figure(p->curves.at[k], &p->choice, &f->curves[next + k]);
        next += panel->n;
        panel->equal = p->operands.n > 0 && p->operands.at[0].vector;
        panel->log[1] = shows_drifts_only(p);
        label_panel(p, f->labels + 4 * i, panel);
        QDOT_TRY(give_units(r->cursor.session, p, f->labels + 4 * i + 2, panel));
        QDOT_TRY(qdot_figure_option_apply(r, &p->choice, panel));
        for (int k = 0; k < 2; k++)
            QDOT_TRY(qdot_text_status(&f->labels[4 * i + (size_t)k]));
    }
    return QDOT_OK;
}

/* Add points where curves bend, for the scale at which each panel shows them. */
static qdot_status
refine_curves(panels *all, const qdot_figure *figure, frame *f)
{
    size_t next = 0;

    for (size_t i = 0; i < all->n; i++) {
        qdot_plot_panel *p = &all->at[i];
        qdot_figure_view view;

        QDOT_TRY(qdot_figure_get_view(figure, i, &view));
        for (size_t k = 0; k < p->curves.n; k++, next++) {
            qdot_plot_curve *curve = p->curves.at[k];

            if (curve->data)
                continue;
            QDOT_TRY(qdot_trace_refine(&curve->source, &view, &curve->points));
            copy_curve_for_figure(curve, &p->choice, &f->curves[next]);
        }
    }
    return QDOT_OK;
}

/* Give a notice if logarithmic axes leave out points, except for values of 0 with which a drift begins. */
static qdot_status
give_notice_of_left_out(qdot_session *session, const qdot_figure *figure)
{
    for (size_t i = 0; i < figure->n; i++) {
        const qdot_panel *p = &figure->panels[i];

        for (size_t k = 0; k < p->n; k++)
            for (size_t j = 0; j < p->curves[k].rows; j++)
                if ((p->log[0] && p->curves[k].x[j] < 0) ||
                    (p->log[1] && p->curves[k].y[j] < 0))
                    return qdot_answer_notice(session, "values below 0 cannot be shown on a "
                                                       "logarithmic axis and are left out");
    }
    return QDOT_OK;
}

/* --- the statement `plot` ----------------------------------------------------------- */

/* Read the parts of one panel, up to the next `|`; a Bode diagram has two. */
static qdot_status
read_panel(const qdot_plot_said *said, const qdot_plot_runs *runs, qdot_figure_choice *figure, panels *all)
{
    const qdot_filled *vs = qdot_plot_find_word(said, "vs");
    qdot_plot_panel empty = {0}, *p;

    QDOT_TRY(qdot_vec_push(all, empty));
    if (qdot_plot_bode_is(said)) {
        QDOT_TRY(qdot_vec_push(all, empty));
        return qdot_plot_bode(said, &all->at[all->n - 2], &all->at[all->n - 1], figure);
    }
    p = &all->at[all->n - 1];
    if (said->from == said->to || (!qdot_filled_is(said->from, "EXPR") && qdot_plot_data_find(said) != said->from))
        return qdot_record_expected(said->record, said->from[-1].to, "an expression");
    QDOT_TRY(vs != NULL && qdot_filled_is(vs + 1, "NAME") ? qdot_plot_over(said, p, figure)
                                                          : qdot_plot_run(said, runs, p, figure));
    return qdot_plot_data_add(said, p);
}

static qdot_status
read_panels(qdot_record *r, const qdot_plot_runs *runs, qdot_figure_choice *figure, panels *all)
{
    const qdot_filled *end = r->parts.at + r->parts.n;
    qdot_plot_said said = {.record = r};

    for (said.to = r->parts.at; said.to < end; ) {
        said.from = said.to + (said.to == r->parts.at ? 1 : 2); /* the token after `plot` or `| plot` */
        for (said.to = said.from; said.to < end && !qdot_filled_is(said.to, "|");)
            said.to++;
        QDOT_TRY(read_panel(&said, runs, figure, all));
    }
    return QDOT_OK;
}

qdot_status
qdot_plot_figure(qdot_record *r, const qdot_plot_runs *runs)
{
    qdot_figure_choice choice = {0};
    panels all = {0};
    frame f = {0};
    qdot_status status;

    if (qdot_plot_rows_is(r))
        return qdot_plot_rows(r);
    status = read_panels(r, runs, &choice, &all);
    for (size_t i = 0; i < all.n && status == QDOT_OK; i++)
        status = find_poles(&all.at[i]);
    if (status == QDOT_OK)
        status = build_figure(r, &all, &f);
    if (status == QDOT_OK) {
        const qdot_figure figure = {.panels = f.panels,
                                    .n = f.n,
                                    .width = choice.width,
                                    .height = choice.height,
                                    .keep = choice.keep};

        status = refine_curves(&all, &figure, &f);
        if (status == QDOT_OK)
            status = give_notice_of_left_out(r->cursor.session, &figure);
        if (status == QDOT_OK)
            status = qdot_figure_file_show(r->cursor.session, &figure, choice.path);
    }
    free_frame(&f);
    for (size_t i = 0; i < all.n; i++)
        qdot_plot_panel_clear(&all.at[i]);
    qdot_free(all.at);
    return status;
}
