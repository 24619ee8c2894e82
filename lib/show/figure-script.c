/* figure-script.c -- writes a figure as a gnuplot script: data, panels, axes, keys, curves. */
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "show/figure-parts.h"

enum { EXACT = 17, BLOCK = 4096 };

static const char look[] = "set encoding utf8\n"
                           "set datafile missing 'NaN'\n"
                           "set border 3 linecolor '#404040'\n"
                           "set tics nomirror out textcolor '#202020'\n"
                           "set tics scale 0.6\n"
                           "set xtics offset 0,0.3\n"
                           "set grid linetype 1 linecolor '#e0e0e0' linewidth 0.7\n"
                           "set samples 2\n";

static const int marks[] = {7, 5, 9, 11, 13, 6, 4, 8, 10, 12, 1, 2, 3, 15, 14};

enum {
    MARKS = sizeof marks / sizeof *marks,
    MANY_MARKS = 24 /* largest number of marks drawn on a curve with a line */
};

/* --- writing the data --------------------------------------------------------------- */

/* Write the points of a curve, one per line, with a blank line where the curve is interrupted. */
static qdot_status
curve_add_points(qdot_text *out, const qdot_panel *panel, const qdot_curve *curve)
{
    bool open = false;

    for (size_t k = 0; k < curve->rows; k++) {
        if (k % BLOCK == BLOCK - 1)
            QDOT_TRY(qdot_interrupt_check());
        if (!qdot_figure_shows(panel, curve, k)) {
            qdot_text_add(out, open ? "\n" : "");
            open = false;
            continue;
        }
        qdot_text_double(out, curve->x[k], EXACT);
        qdot_text_char(out, ' ');
        qdot_text_double(out, curve->y[k], EXACT);
        if (curve->z != NULL) {
            qdot_text_char(out, ' ');
            qdot_text_double(out, curve->z[k], EXACT);
        }
        qdot_text_char(out, '\n');
        open = true;
    }
    return qdot_text_status(out);
}

/* Write all curves as gnuplot data blocks, named $p<panel>c<curve>. */
static qdot_status
add_data_blocks(const qdot_figure_drawing *d)
{
    for (size_t i = 0; i < d->figure->n; i++) {
        if (d->figure->panels[i].map != NULL) {
            qdot_text_format(d->script, "$p%zuc0 << END\n", i);
            QDOT_TRY(qdot_figure_map_add_data(d->figure->panels[i].map, d->script));
            qdot_text_add(d->script, "END\n");
        }
        for (size_t k = 0; k < d->figure->panels[i].n; k++) {
            qdot_text_format(d->script, "$p%zuc%zu << END\n", i, k);
            QDOT_TRY(curve_add_points(d->script, &d->figure->panels[i],
                                      &d->figure->panels[i].curves[k]));
            qdot_text_add(d->script, "END\n");
        }
    }
    return QDOT_OK;
}

/* Append the first lines of a data set: blank lines after the previous one, and a label as comment. */
static void
begin_data_set(qdot_text *out, bool first, const char *label)
{
    qdot_text_add(out, first ? "# " : "\n\n# ");
    for (; label != NULL && *label != '\0'; label++)
        qdot_text_char(out, (unsigned char)*label < 0x20 ? ' ' : *label);
    qdot_text_char(out, '\n');
}

/* Write all curves and maps as data sets for gnuplot, separated by two blank lines, with names as comments. */
qdot_status
qdot_figure_add_data(const qdot_figure *figure, qdot_text *out)
{
    for (size_t i = 0; i < figure->n; i++) {
        const qdot_panel *panel = &figure->panels[i];

        if (panel->map != NULL) {
            begin_data_set(out, i == 0, panel->map->label.text);
            QDOT_TRY(qdot_figure_map_add_data(panel->map, out));
        }
        for (size_t k = 0; k < panel->n; k++) {
            begin_data_set(out, i + k == 0, panel->curves[k].label.text);
            QDOT_TRY(curve_add_points(out, panel, &panel->curves[k]));
        }
    }
    return qdot_text_status(out);
}

/* --- drawing one panel -------------------------------------------------------------- */

/* Write the legend; `high` is the height of the axes in cm if it was fixed. */
static void
add_legend(const qdot_figure_drawing *d, const qdot_panel *panel, double high)
{
    const size_t rows = qdot_figure_legend_rows(d, panel);

    if (rows == 0)
        qdot_text_add(d->script, "unset key\n");
    else if (qdot_figure_has_legend_beside(d, panel))
        qdot_text_format(d->script,
                         "set key at graph 1.02, graph 1 left top vertical maxrows %zu Left reverse "
                         "samplen 2.5 spacing %.2f\n",
                         panel->n, qdot_figure_legend_spacing(d, panel));
    else if (qdot_figure_is_space(panel))
        qdot_text_add(d->script, "set key inside right top vertical Left reverse samplen 2.5\n");
    else {
        qdot_text_add(d->script, "set key at graph 1, graph ");
        qdot_text_double(d->script, 1 + 0.15 / fmax(high, 0.1), 6);
        qdot_text_format(d->script,
                         " right bottom vertical maxrows %zu Left reverse samplen 2.5\n",
                         rows);
    }
}

/* Write the panel's title, which stands above the legend. */
static void
add_title(const qdot_figure_drawing *d, const qdot_panel *panel)
{
    qdot_text *s = d->script;
    qdot_text both = {0};
    qdot_figure_label note = {panel->note, false};

    if (panel->note == NULL && (panel->title.text == NULL || panel->title.text[0] == '\0')) {
        qdot_text_add(s, "unset title\n");
        return;
    }
    qdot_text_add(s, "set title ");
    if (panel->note == NULL) {
        qdot_figure_add_label(s, &panel->title);
    } else {
        qdot_figure_add_markup(&both, &panel->title);
        qdot_figure_add_quoted(s, qdot_text_str(&both));
        qdot_text_add(s, ".\"\\n{/*0.8 \".");
        qdot_text_truncate(&both, 0);
        qdot_figure_add_markup(&both, &note);
        qdot_figure_add_quoted(s, qdot_text_str(&both));
        qdot_text_add(s, ".\"}\" enhanced");
    }
    if (!qdot_figure_has_legend_beside(d, panel) && !qdot_figure_is_space(panel))
        qdot_text_format(s, " offset 0,%.1f", 1.1 * (double)qdot_figure_legend_rows(d, panel));
    qdot_text_char(s, '\n');
    s->failed = s->failed || both.failed;
    qdot_text_clear(&both);
}

static void
add_view_of_space(const qdot_figure_drawing *d, const qdot_panel *panel,
                  const qdot_figure_axis *axes)
{
    const qdot_figure_room room = {d->width, d->height / (double)d->figure->n, d->points,
                                   panel};
    qdot_text *script = d->script;
    double side[3], seen[3], zoom;

    for (int k = 0; k < 3; k++)
        side[k] = axes[k].most - axes[k].least;
    qdot_figure_see_box(side, &room, &zoom, seen);
    qdot_text_format(script, "set view %d,%d,", QDOT_FIGURE_TILT, QDOT_FIGURE_TURN);
    qdot_text_double(script, zoom, 4);
    qdot_text_add(script, "\nset view equal xyz\nset border 31\n"
                          "set xtics offset -0.6,-0.4\nset ytics offset 0.8,-0.3\n"
                          "set xyplane at ");
    qdot_text_double(script, axes[2].least, EXACT);
    qdot_text_char(script, '\n');
}

static void
add_axes(const qdot_figure_drawing *d, size_t i, const qdot_figure_axis *axes)
{
    const qdot_panel *panel = &d->figure->panels[i];
    const bool shared = qdot_figure_is_shared(d->figure, i);
    const int n = qdot_figure_is_space(panel) ? 3 : 2;

    for (int k = 0; k < n; k++) {
        size_t width = 0;
        const char name = "xyz"[k];
        const bool plain =
            !axes[k].log && axes[k].over == 0 && axes[k].offset_text[0] == '\0' && axes[k].power == 0;

        qdot_figure_add_axis(d->script, name, &axes[k], k == 0 && shared, &width);
        if (d->kind == NULL && plain && !(k == 0 && shared)) /* a window can be zoomed, so gnuplot has to choose the tics */
            qdot_text_format(d->script, "set %ctics autofreq\n", name);
        if (n == 3) /* write the labels of three axes as free text: gnuplot misplaces its own if the box has unequal sides */
            qdot_figure_add_edge_label(d->script, k, axes, &panel->axis[k], panel->unit[k], width);
        else
            qdot_figure_add_axis_label(d->script, name, &axes[k],
                                       k == 0 && shared ? &(qdot_figure_label){0}
                                                        : &panel->axis[k],
                                       panel->unit[k]);
    }
    if (n == 3)
        add_view_of_space(d, panel, axes);
}

/* Write where gnuplot finds a curve's data columns; floor: a space curve projected onto the floor of the box. */
static void
add_data_source(const qdot_figure_drawing *d, size_t i, size_t k, const qdot_figure_axis *axes, bool floor)
{
    const qdot_panel *panel = &d->figure->panels[i];
    size_t index = k;

    for (size_t j = 0; j < i; j++)
        index += d->figure->panels[j].map != NULL ? 1 : d->figure->panels[j].n;
    if (d->data != NULL) {
        qdot_figure_add_quoted(d->script, d->data);
        qdot_text_format(d->script, " index %zu", index);
    } else {
        qdot_text_format(d->script, "$p%zuc%zu", i, k);
    }
    qdot_text_add(d->script, " using ");
    qdot_figure_add_column(d->script, 1, &axes[0]);
    qdot_text_char(d->script, ':');
    qdot_figure_add_column(d->script, 2, &axes[1]);
    if (!qdot_figure_is_space(panel))
        return;
    qdot_text_char(d->script, ':');
    if (!floor) {
        qdot_figure_add_column(d->script, 3, &axes[2]);
        return;
    }
    qdot_text_char(d->script, '(');
    qdot_text_double(d->script, axes[2].least, EXACT);
    qdot_text_char(d->script, ')');
}

/* The size of separate marks: smaller if there are more than FEW, so that every mark can be seen. */
static double
mark_size(size_t rows)
{
    enum { FEW = 600 };

    return rows <= FEW ? 0.3 : fmax(0.08, 0.3 * sqrt((double)FEW / (double)rows));
}

static void
add_curves(const qdot_figure_drawing *d, size_t i, const qdot_figure_axis *axes)
{
    const qdot_panel *panel = &d->figure->panels[i];
    const bool space = qdot_figure_is_space(panel);

    if (panel->map != NULL) {
        qdot_figure_map_add_colours(panel->map, d->script);
        qdot_text_add(d->script, "plot ");
        add_data_source(d, i, 0, axes, false);
        qdot_text_add(d->script, ":3 with image notitle\n"
                                 "unset colorbox\nset datafile missing 'NaN'\n");
        return;
    }
    qdot_text_add(d->script, space ? "splot " : "plot ");
    for (size_t k = 0; space && k < panel->n; k++) {
        add_data_source(d, i, k, axes, true);
        qdot_text_add(d->script,
                      " with lines linewidth 1 linecolor rgb '#d0d0d0' notitle, ");
    }
    for (size_t k = 0; k < panel->n; k++) {
        const qdot_figure_style style = qdot_figure_style_of(panel, k);

        qdot_text_add(d->script, k == 0 ? "" : ", ");
        add_data_source(d, i, k, axes, false);
        if (style.dots)
            qdot_text_format(d->script, " with %spoints pointtype 7 pointsize %.3g", style.line ? "lines" : "",
                             mark_size(panel->curves[k].rows));
        else if (style.marks)
            qdot_text_format(d->script, " with %spoints pointtype %d pointsize 0.8", style.line ? "lines" : "",
                             marks[style.look % MARKS]);
        else
            qdot_text_add(d->script, " with lines");
        if (panel->marks && panel->curves[k].rows > MANY_MARKS) /* not a mark at every point: they would hide each other */
            qdot_text_format(d->script, " pointinterval %zu",
                             panel->curves[k].rows / (MANY_MARKS / 2));
        qdot_text_format(d->script, " linewidth 1.4 linecolor rgb '%s'", style.colour);
        if (style.dash != NULL)
            qdot_text_format(d->script, " dashtype %s", style.dash);
        const qdot_figure_label label = qdot_figure_curve_label(panel, k);

        qdot_text_add(d->script, " title ");
        qdot_figure_add_label(d->script, &label);
    }
    qdot_text_char(d->script, '\n');
}

/* --- placing several panels ----------------------------------------------------------- */

static void
set_margin_position(qdot_text *s, const char *what, double at)
{
    qdot_text_format(s, "set %smargin at screen ", what);
    qdot_text_double(s, at, 6);
    qdot_text_char(s, '\n');
}

/* Set the margins of panel i, `high` cm above each other: all panels have the same horizontal ends. */
static qdot_status
set_margins(const qdot_figure_drawing *d, size_t i, double *high)
{
    qdot_figure_place at;

    QDOT_TRY(qdot_figure_place_panel(d, i, &at));
    *high = at.top - at.bottom;
    if (qdot_figure_is_space(&d->figure->panels[i])) { /* gnuplot scales a three-dimensional box to its place by itself */
        qdot_text_add(d->script, "unset xlabel\nunset ylabel\nunset label 1\nunset margins\nset origin 0,");
        qdot_text_double(d->script, at.low / d->height, 6);
        qdot_text_add(d->script, "\nset size 1,");
        qdot_text_double(d->script, (at.high - at.low) / d->height, 6);
        qdot_text_char(d->script, '\n');
        return QDOT_OK;
    }
    set_margin_position(d->script, "l", at.left / d->width);
    set_margin_position(d->script, "r", at.right / d->width);
    set_margin_position(d->script, "t", at.top / d->height);
    set_margin_position(d->script, "b", at.bottom / d->height);
    return QDOT_OK;
}

static qdot_status
add_panel(const qdot_figure_drawing *d, size_t i)
{
    const qdot_panel *panel = &d->figure->panels[i];
    qdot_figure_axis axes[3];
    double high = d->height;

    QDOT_TRY(qdot_figure_choose_axes(d, i, axes));
    if (d->figure->n > 1 || !qdot_figure_is_space(panel))
        QDOT_TRY(set_margins(d, i, &high));
    add_title(d, panel);
    add_axes(d, i, axes);
    add_legend(d, panel, high);
    if (!qdot_figure_is_space(panel))
        qdot_text_format(d->script, "set size %s\n", panel->equal ? "ratio -1" : "noratio");
    add_curves(d, i, axes);
    if (d->figure->n > 1 && qdot_figure_is_space(panel))
        qdot_text_add(d->script, "set origin 0,0\nset size 1,1\nset border 3\n"
                                 "set xtics offset 0,0.3\nset ytics offset 0,0\n"
                                 "unset label 2\nunset label 3\nunset label 4\n");
    return qdot_text_status(d->script);
}

qdot_status
qdot_figure_add_script(const qdot_figure_drawing *d)
{
    qdot_text_add(d->script, look);
    if (d->data == NULL)
        QDOT_TRY(add_data_blocks(d));
    qdot_text_add(d->script, d->figure->n > 1 ? "set multiplot\n" : "");
    for (size_t i = 0; i < d->figure->n; i++)
        QDOT_TRY(add_panel(d, i));
    qdot_text_add(d->script, d->figure->n > 1 ? "unset multiplot\n" : "");
    return qdot_text_status(d->script);
}
