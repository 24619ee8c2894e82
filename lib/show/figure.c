/* figure.c -- curves as a gnuplot script, and its image as a file. */
#include "show/show.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/utf8.h"
#include "show/gnuplot.h"
#include "show/sink.h"

enum { EXACT = 17, BLOCK = 4096 };

/* --- kinds of image ----------------------------------------------------------------- */

/* A terminal is chosen at gnuplot's side, because which ones it has differs. */
typedef struct {
    const char *ending, *terminal;
} kind;

static const kind kinds[] = {
    {".svg", "set terminal svg size 800,500 noenhanced font 'sans-serif,15' "
             "background '#ffffff' linewidth 1.2\n"},
    {".png",
     "if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {\n"
     "set terminal pngcairo size 1200,750 noenhanced font 'sans,15' linewidth 1.8\n"
     "} else {\n"
     "set terminal png size 1200,750 noenhanced linewidth 2\n"
     "}\n"},
    {".pdf",
     "set terminal pdfcairo size 16cm,10cm noenhanced font 'sans,11' linewidth 1.5\n"},
};

static const char window_terminal[] = "if (strstrt(GPVAL_TERMINALS, 'qt') > 0) {\n"
                                      "set terminal qt noenhanced\n"
                                      "} else {\n"
                                      "if (strstrt(GPVAL_TERMINALS, 'wxt') > 0) {\n"
                                      "set terminal wxt noenhanced\n"
                                      "} else {\n"
                                      "if (strstrt(GPVAL_TERMINALS, 'x11') > 0) {\n"
                                      "set terminal x11 noenhanced\n"
                                      "} else {\n"
                                      "exit error 'this gnuplot cannot open a window'\n"
                                      "}\n"
                                      "}\n"
                                      "}\n";

static const char look[] = "set encoding utf8\n"
                           "set datafile missing 'NaN'\n"
                           "set border 3 linecolor '#404040'\n"
                           "set tics nomirror out textcolor '#202020'\n"
                           "set grid linetype 1 linecolor '#e0e0e0' linewidth 0.7\n"
                           "set samples 2\n";

/* Okabe and Ito's palette: told apart by eyes that do not see all colours. */
static const char *const colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                      "#56b4e9", "#e69f00", "#000000", "#8a6d00"};

enum { KINDS = sizeof kinds / sizeof *kinds, COLOURS = sizeof colours / sizeof *colours };

static const kind *
kind_of(const char *path)
{
    const char *slash = strrchr(path, '/'), *dot;

    dot = strrchr(slash != NULL ? slash : path, '.');
    for (int i = 0; dot != NULL && i < KINDS; i++)
        if (strcmp(dot, kinds[i].ending) == 0)
            return &kinds[i];
    return NULL;
}

/* --- the script --------------------------------------------------------------------- */

/* Between double quotes gnuplot reads \042 as the character of that octal code, so
 * every character that could mean something to it (quotes, backslash, backquote ...)
 * is written so; digits too, which it would take into the code before them. A line
 * break would end the command: it becomes a blank, as other control characters do. */
static void
add_quoted(qdot_text *script, const char *text)
{
    qdot_text_char(script, '"');
    for (const char *c = text != NULL ? text : ""; *c != '\0';) {
        size_t n = qdot_utf8_length(c);

        if (n == 0)
            qdot_text_add(script, "\xEF\xBF\xBD");
        else if (n > 1 || isalpha((unsigned char)*c))
            qdot_text_add_n(script, c, n);
        else if ((unsigned char)*c < 0x20 || *c == 0x7f)
            qdot_text_char(script, ' ');
        else
            qdot_text_format(script, "\\%03o", (unsigned char)*c);
        c += n > 0 ? n : 1;
    }
    qdot_text_char(script, '"');
}

static bool
shows(const qdot_figure *figure, double x, double y)
{
    return isfinite(x) && isfinite(y) && (!figure->log_x || x > 0) &&
           (!figure->log_y || y > 0);
}

/* What of the figure can be shown. */
typedef struct {
    size_t points;
    double x_least, x_most, y_least, y_most;
} extent;

/* The points of curve i as the data block $c<i>. A point that can't be shown breaks
 * the line. */
static qdot_status
add_points(qdot_text *script, const qdot_figure *figure, size_t i, extent *seen)
{
    qdot_text_format(script, "$c%zu << END\n", i);
    for (size_t k = 0; k < figure->rows[i]; k++) {
        double x = figure->x[i].at[k], y = figure->y[i].at[k];

        if (shows(figure, x, y)) {
            bool first = seen->points++ == 0;

            seen->x_least = first ? x : fmin(seen->x_least, x);
            seen->x_most = first ? x : fmax(seen->x_most, x);
            seen->y_least = first ? y : fmin(seen->y_least, y);
            seen->y_most = first ? y : fmax(seen->y_most, y);
            qdot_text_double(script, x, EXACT);
            qdot_text_char(script, ' ');
            qdot_text_double(script, y, EXACT);
        }
        qdot_text_char(script, '\n');
        if (k % BLOCK == BLOCK - 1)
            QDOT_TRY(qdot_interrupt_check());
    }
    qdot_text_add(script, "END\n");
    return qdot_text_status(script);
}

/* 1, 2 or 5 times a power of ten, so that `span` takes between 4 and 10 steps; 0 for
 * no span. */
static double
nice_step(double span)
{
    double ten = pow(10, floor(log10(span / 4))), times = span / 4 / ten;

    return !isfinite(ten) || ten == 0 ? 0
           : times < 2                ? ten
           : times < 5                ? 2 * ten
                                      : 5 * ten;
}

/* Powers of ten as tics of a long logarithmic axis, of which at most nine are labelled: where not
 * every one is, gnuplot's own marks between them stand on the right half only. */
static void
add_log_axis(qdot_text *script, char axis, double least, double most)
{
    const double decades = log10(most / least);

    qdot_text_format(script, "set logscale %c\nset format %c '%%.0e'\n", axis, axis);
    if (!(decades > 5))
        return;
    qdot_text_format(script, "set %ctics 1e%d\n", axis, (int)ceil(decades / 8));
    if (decades > 8)
        qdot_text_format(script, "unset m%ctics\n", axis);
}

static void
add_axes(qdot_text *script, const qdot_figure *figure, const extent *seen)
{
    double step =
        nice_step(fmax(seen->x_most - seen->x_least, seen->y_most - seen->y_least));

    if (figure->title != NULL && figure->title[0] != '\0') {
        qdot_text_add(script, "set title ");
        add_quoted(script, figure->title);
        qdot_text_char(script, '\n');
    }
    qdot_text_add(script, "set xlabel ");
    add_quoted(script, figure->x_label);
    qdot_text_add(script, "\nset ylabel ");
    add_quoted(script, figure->y_label);
    qdot_text_char(script, '\n');
    if (figure->equal_axes) {
        qdot_text_add(script, "set size ratio -1\n");
        for (const char *axis = "xy"; *axis != '\0' && step > 0; axis++) {
            qdot_text_format(script, "set %ctics ", *axis);
            qdot_text_double(script, step, EXACT);
            qdot_text_char(script, '\n');
        }
    } else {
        qdot_text_add(script, "set autoscale xfix\n");
    }
    if (figure->log_x)
        add_log_axis(script, 'x', seen->x_least, seen->x_most);
    if (figure->log_y)
        add_log_axis(script, 'y', seen->y_least, seen->y_most);
    qdot_text_add(script, figure->curves > 1 ? "set key outside right top Left reverse\n"
                                             : "unset key\n");
}

static void
add_curves(qdot_text *script, const qdot_figure *figure)
{
    qdot_text_add(script, "plot ");
    for (size_t i = 0; i < figure->curves; i++) {
        bool point = figure->rows[i] == 1;

        qdot_text_format(
            script, "%s$c%zu using 1:2 with %s linecolor rgb '%s'%s", i == 0 ? "" : ", ",
            i,
            point           ? "points pointtype 7"
            : figure->marks ? "linespoints pointtype 7 pointsize 0.6 linewidth 1.4"
                            : "lines linewidth 1.4",
            colours[i % COLOURS],
            !point && i / COLOURS % 2 == 1 ? " dashtype 2" : "");
        qdot_text_add(script, " title ");
        add_quoted(script, figure->y[i].label);
    }
    qdot_text_char(script, '\n');
}

static qdot_status
write_script(qdot_text *script, const qdot_figure *figure, const char *terminal)
{
    extent seen = {0};

    qdot_text_add(script, terminal);
    qdot_text_add(script, look);
    for (size_t i = 0; i < figure->curves; i++)
        QDOT_TRY(add_points(script, figure, i, &seen));
    if (seen.points == 0)
        return qdot_fail(QDOT_EDOMAIN, "no point of the plot is finite%s",
                         figure->log_x || figure->log_y ? " and positive" : "");
    add_axes(script, figure, &seen);
    add_curves(script, figure);
    return qdot_text_status(script);
}

/* --- the figure --------------------------------------------------------------------- */

qdot_status
qdot_figure_write(const qdot_figure *figure, const char *path)
{
    const char *terminal = window_terminal;
    qdot_text script = {0}, image = {0};
    qdot_status status;

    if (figure->curves == 0)
        return qdot_fail(QDOT_EINVAL, "a plot needs a curve");
    if (path != NULL) {
        const kind *k = kind_of(path);

        if (k == NULL) {
            qdot_fail(QDOT_EINVAL, "`%.200s` does not say what figure it is to be", path);
            return qdot_hint("end its name in .svg, .png or .pdf");
        }
        terminal = k->terminal;
    }
    status = write_script(&script, figure, terminal);
    if (status == QDOT_OK)
        status = qdot_gnuplot_run(&script, path != NULL ? &image : NULL);
    if (status == QDOT_OK && path != NULL)
        status = qdot_sink_write(path, image.at, image.n);
    qdot_text_clear(&script);
    qdot_text_clear(&image);
    return status;
}
