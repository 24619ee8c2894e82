/* figure-image.c -- draws a figure into an image file or a window. */
#include "show/figure.h"

#include <math.h>
#include <string.h>

#include "base/process.h"
#include "base/sink.h"
#include "show/figure-parts.h"
#include "show/gnuplot.h"

/* --- kinds of image ----------------------------------------------------------------- */

/* Image formats; gnuplot chooses its terminal itself, because installations differ in those they have. */
static const qdot_figure_kind kinds[] = {
    {".svg", 96 / 2.54, 1.2, 96. / 72, 1.6,
     "set terminal svg enhanced background '#ffffff'", "", "</svg>"},
    {".png", 200 / 2.54, 2.6, 200. / 96, 1.4,
     "png = strstrt(GPVAL_TERMINALS, 'pngcairo') > 0 ? 'pngcairo' : 'png'\n"
     "set terminal @png enhanced",
     "", "IEND\xae\x42\x60\x82"},
    {".pdf", 1, 1.5, 0.75, 1.4, "set terminal pdfcairo enhanced fontscale 1", "cm", "%%EOF"},
    {".eps", 1, 1.5, 0.75, 1.4, "set terminal epscairo enhanced fontscale 1", "cm", "%%EOF"},
    {".tikz", 1, 1, 1, 1.4, NULL, "cm", ""}, /* figure-tikz.c */
};

static const char window_terminal[] = "if (strstrt(GPVAL_TERMINALS, 'qt') > 0) {\n"
                                      "set terminal qt enhanced\n"
                                      "} else {\n"
                                      "if (strstrt(GPVAL_TERMINALS, 'wxt') > 0) {\n"
                                      "set terminal wxt enhanced\n"
                                      "} else {\n"
                                      "if (strstrt(GPVAL_TERMINALS, 'x11') > 0) {\n"
                                      "set terminal x11 enhanced\n"
                                      "} else {\n"
                                      "exit error 'this gnuplot cannot open a window'\n"
                                      "}\n"
                                      "}\n"
                                      "}\n";

enum { KINDS = sizeof kinds / sizeof *kinds };

static const qdot_figure_kind *
find_image_kind(const char *path)
{
    const char *slash = strrchr(path, '/'), *dot;

    dot = strrchr(slash != NULL ? slash : path, '.');
    for (int i = 0; dot != NULL && i < KINDS; i++)
        if (strcmp(dot, kinds[i].ending) == 0)
            return &kinds[i];
    return NULL;
}

bool
qdot_figure_is_file(const char *path)
{
    return find_image_kind(path) != NULL;
}

static void
add_terminal_command(const qdot_figure_drawing *d)
{
    qdot_text *s = d->script;

    if (d->kind == NULL) {
        qdot_text_add(s, window_terminal);
        return;
    }
    qdot_text_add(s, d->kind->before);
    qdot_text_add(s, " size ");
    qdot_text_double(s, d->kind->dots > 1 ? round(d->width * d->kind->dots) : d->width, 6);
    qdot_text_add(s, d->kind->behind);
    qdot_text_char(s, ',');
    qdot_text_double(s, d->kind->dots > 1 ? round(d->height * d->kind->dots) : d->height, 6);
    qdot_text_format(s, "%s font 'sans%s,", d->kind->behind,
                     strcmp(d->kind->ending, ".svg") == 0 ? "-serif" : "");
    qdot_text_double(s, d->points * d->kind->point, 4);
    qdot_text_add(s, "' linewidth ");
    qdot_text_double(s, d->kind->line, 4);
    qdot_text_char(s, '\n');
}

/* --- writing image, script and data ------------------------------------------------- */

/* Append the path with its file-name ending replaced by another one. */
static void
add_path_with_ending(qdot_text *out, const char *path, const char *ending)
{
    qdot_text_add_n(out, path, (size_t)(strrchr(path, '.') - path));
    qdot_text_add(out, ending);
}

static const char *
file_name_of(const char *path)
{
    const char *slash = strrchr(path, '/');

    return slash != NULL ? slash + 1 : path;
}

/* The first line of files that `keep` leaves; files of the same names without it are never overwritten. */
static const char mark[] = "# left by qdot's keep\n";

/* Append a file name such that gnuplot does not take it for a pipe or an option (`|program`,
 * `<program`, `-`, `+`). */
static void
add_file_name(qdot_text *out, const char *name)
{
    qdot_text_format(out, "%s%s", strchr("|<>-+ ", name[0]) != NULL ? "./" : "", name);
}

/* Check that NAME.gp and NAME.dat do not exist yet as files that the user wrote. */
static qdot_status
check_kept_files(const char *path)
{
    static const char *const endings[] = {".gp", ".dat"};
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < sizeof endings / sizeof *endings && status == QDOT_OK; i++) {
        qdot_text name = {0};

        add_path_with_ending(&name, path, endings[i]);
        status = qdot_text_status(&name);
        if (status == QDOT_OK && !qdot_sink_is_free(name.at, mark)) {
            qdot_fail(QDOT_EIO, "`%.200s` exists, and was not written by `keep`", name.at);
            status = qdot_hint("give the figure another name, or move that file away");
        }
        qdot_text_clear(&name);
    }
    return status;
}

/* Write NAME.gp and NAME.dat beside NAME.svg; `gnuplot NAME.gp` in their folder draws the figure. */
static qdot_status
write_kept_script(const qdot_figure_drawing *like, const char *path)
{
    qdot_text script = {0}, data = {0}, script_path = {0}, data_path = {0}, image_name = {0},
              data_name = {0};
    qdot_figure_drawing d = *like;
    qdot_status status;

    add_path_with_ending(&script_path, path, ".gp");
    add_path_with_ending(&data_path, path, ".dat");
    status = qdot_text_status(&data_path);
    add_file_name(&image_name, file_name_of(path));
    add_file_name(&data_name, file_name_of(data_path.at != NULL ? data_path.at : ""));
    qdot_text_add(&data, mark);
    qdot_text_add(&script, mark);
    if (status == QDOT_OK)
        status = qdot_figure_add_data(d.figure, &data);
    if (status == QDOT_OK) {
        d.script = &script;
        d.data = qdot_text_str(&data_name);
        add_terminal_command(&d);
        qdot_text_add(&script, "set output ");
        qdot_figure_add_quoted(&script, qdot_text_str(&image_name));
        qdot_text_char(&script, '\n');
        status = qdot_figure_add_script(&d);
    }
    if (status == QDOT_OK)
        status = qdot_text_status(&script_path);
    if (status == QDOT_OK && (image_name.failed || data_name.failed))
        status = QDOT_ENOMEM;
    if (status == QDOT_OK)
        status = qdot_sink_write(data_path.at, data.at, data.n);
    if (status == QDOT_OK)
        status = qdot_sink_write(script_path.at, script.at, script.n);
    qdot_text_clear(&script);
    qdot_text_clear(&data);
    qdot_text_clear(&script_path);
    qdot_text_clear(&data_path);
    qdot_text_clear(&image_name);
    qdot_text_clear(&data_name);
    return status;
}

/* Write a figure as a file for LaTeX, with script and data in the same file. */
static qdot_status
write_tikz(const qdot_figure *figure, const qdot_figure_kind *kind, const char *path)
{
    qdot_text text = {0};
    qdot_figure_drawing d = {.figure = figure, .script = &text, .kind = kind};
    qdot_status status = qdot_figure_size(figure, &d.width, &d.height, &d.points);

    if (status == QDOT_OK && figure->keep) {
        qdot_fail(QDOT_EINVAL, "`keep` leaves a script of gnuplot, which draws no .tikz");
        status = qdot_hint("a .tikz has its data in it: leave `keep` out");
    }
    if (status == QDOT_OK)
        status = qdot_figure_add_tikz(&d);
    if (status == QDOT_OK)
        status = qdot_sink_write(path, text.at, text.n);
    qdot_text_clear(&text);
    return status;
}

/* Fail if a list of n names or colours is longer than the number of curves. */
static qdot_status
check_list_length(const char *list, size_t n, size_t curves)
{
    return n <= curves ? QDOT_OK : qdot_fail(QDOT_EINVAL, "%s names %zu curves, but there %s %zu", list, n,
                                             curves == 1 ? "is" : "are", curves);
}

static qdot_status
check_curves(const qdot_figure *figure)
{
    for (size_t i = 0; i < figure->n; i++) {
        if (figure->panels[i].n == 0 && figure->panels[i].map == NULL)
            return qdot_fail(QDOT_EINVAL, "a plot needs a curve");
        QDOT_TRY(check_list_length("the legend", figure->panels[i].n_legend, figure->panels[i].n));
        QDOT_TRY(check_list_length("`colour`", figure->panels[i].n_colours, figure->panels[i].n));
    }
    return QDOT_OK;
}

/* Draw the figure as an image of this kind, which is appended; kind and image NULL: in a window. */
static qdot_status
draw_by_gnuplot(qdot_figure_drawing *d, qdot_text *image)
{
    qdot_text script = {0};
    qdot_status status;

    QDOT_TRY(qdot_figure_size(d->figure, &d->width, &d->height, &d->points));
    d->script = &script;
    add_terminal_command(d);
    status = qdot_figure_add_script(d);
    if (status == QDOT_OK)
        status = qdot_gnuplot_run(&script, image != NULL ? d->kind->end : NULL, image);
    d->script = NULL;
    qdot_text_clear(&script);
    return status;
}

/* The same as SVG, without gnuplot. */
static qdot_status
draw_svg(qdot_figure_drawing *d, qdot_text *image)
{
    QDOT_TRY(qdot_figure_size(d->figure, &d->width, &d->height, &d->points));
    d->script = image;
    return qdot_figure_add_svg(d);
}

/* Draw an image: by gnuplot, or where it is missing and the image is a .svg, without it. */
static qdot_status
draw_image(qdot_figure_drawing *d, qdot_text *image)
{
    return strcmp(d->kind->ending, ".svg") == 0 && !qdot_gnuplot_is_here() ? draw_svg(d, image) : draw_by_gnuplot(d, image);
}

/* Draw an image into a file, and what `keep` leaves beside it. */
static qdot_status
write_image(qdot_figure_drawing *d, const char *path)
{
    qdot_text image = {0};
    qdot_status status = d->figure->keep ? check_kept_files(path) : QDOT_OK;

    if (status == QDOT_OK)
        status = draw_image(d, &image);
    if (status == QDOT_OK)
        status = qdot_sink_write(path, image.at, image.n);
    if (status == QDOT_OK && d->figure->keep)
        status = write_kept_script(d, path);
    qdot_text_clear(&image);
    return status;
}

qdot_status
qdot_figure_svg(const qdot_figure *figure, qdot_text *element)
{
    qdot_figure_drawing d = {.figure = figure, .kind = find_image_kind(".svg")};
    qdot_text image = {0};
    const char *begin;
    qdot_status status = check_curves(figure);

    if (status == QDOT_OK)
        status = draw_image(&d, &image);
    if (status == QDOT_OK) {
        begin = strstr(image.at, "<svg");
        qdot_text_add(element, begin != NULL ? begin : image.at);
        status = qdot_text_status(element);
    }
    qdot_text_clear(&image);
    return status;
}

qdot_status
qdot_figure_write(const qdot_figure *figure, const char *path)
{
    qdot_figure_drawing d = {.figure = figure};

    if (qdot_rank() > 0)
        return QDOT_OK;
    QDOT_TRY(check_curves(figure));
    if (path == NULL)
        return draw_by_gnuplot(&d, NULL);
    d.kind = find_image_kind(path);
    if (d.kind == NULL) {
        qdot_fail(QDOT_EINVAL, "`%.200s` does not say which kind of figure to write", path);
        return qdot_hint("end its name in .svg, .png, .pdf, .eps or .tikz");
    }
    return d.kind->before == NULL ? write_tikz(figure, d.kind, path) : write_image(&d, path);
}
