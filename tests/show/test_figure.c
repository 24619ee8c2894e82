/* test_figure.c -- figures through gnuplot, and everything that can go wrong with it. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <locale.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "show/figure.h"

enum { POINTS = 200 };

static char folder[] = "qdot-figure-XXXXXX";
static double t[POINTS], wave[POINTS], other[POINTS];
static const qdot_curve both[] = {
    {.label = {"theta_1", false}, .rows = POINTS, .x = t, .y = wave},
    {.label = {"theta_2", false}, .rows = POINTS, .x = t, .y = other}};

static int
enter(void **state)
{
    (void)state;
    for (int i = 0; i < POINTS; i++) {
        t[i] = 0.1 * i;
        wave[i] = 2 * sin(t[i]);
        other[i] = cos(1.7 * t[i]);
    }
    return mkdtemp(folder) != NULL && chdir(folder) == 0 ? 0 : -1;
}

static int
leave(void **state)
{
    (void)state;
    return chdir("..") == 0 && rmdir(folder) == 0 ? 0 : -1;
}

static qdot_panel
two_curves(void)
{
    return (qdot_panel){.title = {"two", false},
                        .axis = {{"t", false}, {"theta", false}},
                        .curves = both,
                        .n = 2};
}

/* A figure of this panel alone. */
static qdot_status
write_panel(const qdot_panel *panel, const char *path)
{
    const qdot_figure figure = {.panels = panel, .n = 1};

    return qdot_figure_write(&figure, path);
}

/* The file as a string; the caller frees it. Removes the file. */
static char *
take(const char *path)
{
    enum { MOST = 1 << 20 };
    FILE *f = fopen(path, "rb");
    char *text = calloc(1, MOST);

    assert_non_null(f);
    assert_non_null(text);
    assert_true(fread(text, 1, MOST - 1, f) > 0);
    fclose(f);
    assert_int_equal(remove(path), 0);
    return text;
}

/* The script of a figure, as `keep` leaves it; the caller frees it. */
static char *
script_of(const qdot_figure *figure)
{
    qdot_figure kept = *figure;
    char *script;

    kept.keep = true;
    assert_int_equal(qdot_figure_write(&kept, "kept.svg"), QDOT_OK);
    free(take("kept.svg"));
    free(take("kept.dat"));
    script = take("kept.gp");
    assert_non_null(strstr(script, "set output 'kept.svg'"));
    return script;
}

static char *
script_of_panel(const qdot_panel *panel)
{
    return script_of(&(qdot_figure){.panels = panel, .n = 1});
}

static void
each_ending_gives_its_kind_of_file(void **state)
{
    const qdot_panel figure = two_curves();
    const struct {
        const char *path, *begins;
    } all[] = {{"a.svg", "<?xml"}, {"a.png", "\x89PNG"}, {"a.b.pdf", "%PDF"}};

    (void)state;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        char *text;

        assert_int_equal(write_panel(&figure, all[i].path), QDOT_OK);
        text = take(all[i].path);
        assert_memory_equal(text, all[i].begins, strlen(all[i].begins));
        free(text);
    }
}

static void
an_unknown_ending_is_an_error(void **state)
{
    const char *const bad[] = {"a.gif", "a", "svg", "", "a.svg/b", "a.svg.txt"};
    const qdot_panel figure = two_curves();

    (void)state;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(write_panel(&figure, bad[i]), QDOT_EINVAL);
        assert_non_null(strstr(qdot_last_error()->hint, ".svg"));
    }
}

/* The points of the first curve as gnuplot wrote them: `M x,y L x,y ...`, in its own
 * unit; the caller knows what straight map they went through. */
static size_t
path_points(const char *svg, double *px, double *py, size_t most)
{
    const char *at = strstr(svg, "<g id=\"gnuplot_plot_1");
    size_t n = 0;

    assert_non_null(at);
    at = strstr(at, "<path");
    assert_non_null(at);
    at = strstr(at, "d='");
    assert_non_null(at);
    for (at += 3; *at != '\'' && *at != '\0'; at++) {
        int read = 0;

        if ((*at != 'M' && *at != 'L') || n == most)
            continue;
        if (sscanf(at + 1, "%lf,%lf%n", &px[n], &py[n], &read) == 2) {
            at += read;
            n++;
        }
        while (sscanf(at + 1, " %lf,%lf%n", &px[n], &py[n], &read) == 2 && n < most) {
            at += read;
            n++;
        }
    }
    return n;
}

static void
the_curve_goes_through_its_points(void **state)
{
    const double at[] = {0, 1, 2, 3, 4, 5}, height[] = {0, 1, 4, 9, 16, 25};
    const size_t n = 6;
    const qdot_curve curve = {.rows = n, .x = at, .y = height};
    const qdot_panel figure = {.curves = &curve, .n = 1};
    double px[16], py[16];
    char *text;

    (void)state;
    assert_int_equal(write_panel(&figure, "a.svg"), QDOT_OK);
    text = take("a.svg");
    assert_int_equal(path_points(text, px, py, 16), n);
    free(text);
    for (size_t i = 0; i < n; i++) {
        /* one straight map for all: x by the ends, y (which points down) likewise */
        assert_true(fabs((px[i] - px[0]) / (px[5] - px[0]) - at[i] / 5) < 1e-3);
        assert_true(fabs((py[i] - py[0]) / (py[5] - py[0]) - height[i] / 25) < 1e-3);
    }
}

static void
labels_stand_literally(void **state)
{
    const qdot_curve strange[] = {
        {.label = {"it's \"x_1^2\" `id` @y {/Bold z} \\n $c0 \"12%d%%", false},
         .rows = POINTS,
         .x = t,
         .y = wave},
        {.label = {"θ̇ & <b>\nplot sin(x)", false}, .rows = POINTS, .x = t, .y = other}};
    qdot_panel figure = two_curves();
    char *text;

    (void)state;
    figure.curves = strange;
    figure.title.text = "a\\";
    figure.axis[0].text = "'; system 'touch harm'; '";
    assert_int_equal(write_panel(&figure, "a.svg"), QDOT_OK);
    assert_int_equal(access("harm", F_OK), -1);
    text = take("a.svg");
    assert_non_null(strstr(text, "it's \"x_1^2\" `id` @y {/Bold z} \\n $c0 \"12%d%%"));
    assert_non_null(strstr(text, "θ̇ &amp; &lt;b> plot sin(x)"));
    assert_non_null(strstr(text, "a\\"));
    assert_non_null(strstr(text, "'; system 'touch harm'; '"));
    free(text);
}

static void
file_names_are_only_names(void **state)
{
    const char *const names[] = {"it's \"a\" \\n.svg", "a b; $(id) `id`.svg", "| cat.svg",
                                 "-persist.svg",       "two\nlines.svg",      "θ.svg"};
    const qdot_panel figure = two_curves();

    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        assert_int_equal(write_panel(&figure, names[i]), QDOT_OK);
        free(take(names[i]));
    }
}

static void
one_curve_has_no_key_two_have(void **state)
{
    qdot_panel figure = two_curves();
    char *text;

    (void)state;
    text = script_of_panel(&figure);
    assert_non_null(strstr(text, "set key "));
    assert_non_null(strstr(text, "title 'theta_2' noenhanced"));
    free(text);
    figure.n = 1;
    text = script_of_panel(&figure);
    assert_non_null(strstr(text, "unset key\n"));
    free(text);
}

static void
points_that_are_not_finite_break_the_line(void **state)
{
    const double at[] = {0, 1, 2, 3, 4}, height[] = {1, INFINITY, 3, NAN, 1e308};
    qdot_curve curve = {.rows = 3, .x = at, .y = height};
    const qdot_panel figure = {.curves = &curve, .n = 1};
    const double none[] = {NAN, INFINITY};
    qdot_curve nothing = {.rows = 2, .x = at, .y = none};
    qdot_panel empty = {.curves = &nothing, .n = 1};

    (void)state;
    assert_int_equal(write_panel(&figure, "a.svg"), QDOT_OK);
    free(take("a.svg"));
    assert_int_equal(write_panel(&empty, "a.svg"), QDOT_EDOMAIN);
    nothing.rows = 0;
    assert_int_equal(write_panel(&empty, "a.svg"), QDOT_EDOMAIN);
    empty.n = 0;
    assert_int_equal(write_panel(&empty, "a.svg"), QDOT_EINVAL);
    assert_int_equal(access("a.svg", F_OK), -1);
}

static void
flat_lone_and_logarithmic_curves_are_drawn(void **state)
{
    const double at[] = {1e-15, 1e-9, 1e-3}, flat[] = {2, 2, 2}, signs[] = {-1, 1e-12, 1};
    qdot_curve curve = {.rows = 3, .x = at, .y = flat};
    qdot_panel figure = {.curves = &curve, .n = 1};

    (void)state;
    assert_int_equal(write_panel(&figure, "a.svg"), QDOT_OK);
    free(take("a.svg"));
    figure.equal = true;
    assert_int_equal(write_panel(&figure, "a.svg"), QDOT_OK);
    free(take("a.svg"));
    figure.equal = false;
    figure.log[0] = figure.log[1] = true;
    curve.y = signs;
    assert_int_equal(write_panel(&figure, "a.svg"), QDOT_OK);
    free(take("a.svg"));
    curve.rows = 1;
    curve.y = flat;
    assert_int_equal(write_panel(&figure, "a.svg"), QDOT_OK);
    free(take("a.svg"));
    curve.y = signs;
    assert_int_equal(write_panel(&figure, "a.svg"), QDOT_EDOMAIN);
    assert_non_null(strstr(qdot_last_error()->message, "positive"));
}

/* How often a text stands in another. */
static int
times(const char *text, const char *what)
{
    int n = 0;

    for (; (text = strstr(text, what)) != NULL; text++)
        n++;
    return n;
}

static void
long_logarithmic_axes_have_even_marks(void **state)
{
    const double at[] = {1, 2, 3}, height[] = {1e-15, 1e-9, 1e-2};
    const qdot_curve curve = {.rows = 3, .x = at, .y = height};
    const qdot_panel figure = {.curves = &curve, .n = 1, .log = {false, true}};
    char *text;

    (void)state;
    text = script_of_panel(&figure);
    assert_int_equal(times(text, "'10^{−10}' 1e-10,"), 1);
    assert_true(times(text, "'10^{−") >= 5 && times(text, "'10^{−") <= 9);
    assert_null(strstr(text, "2e-10")); /* no marks of 2, 3, ... 9 times what is labelled */
    free(text);
}

static void
values_that_differ_late_have_an_offset(void **state)
{
    const double at[] = {0, 1, 2}, height[] = {9.81, 9.81 + 4e-12, 9.81 - 3e-12};
    const qdot_curve curve = {.rows = 3, .x = at, .y = height};
    qdot_panel figure = {
        .curves = &curve, .n = 1, .axis = {{"t", true}, {"V_eff", true}}};
    char *text;

    (void)state;
    text = script_of_panel(&figure);
    assert_non_null(strstr(text, "'(V_{eff} − 9.81) / 10^{−12}'"));
    assert_non_null(strstr(text, "using 1:(($2-(9.8100000000000005))/1e-12)"));
    assert_non_null(strstr(text, "'−2' -2, '−1' -1, '0' 0, "));
    free(text);
}

static void
formulas_are_set(void **state)
{
    static const struct {
        const char *plain, *markup;
    } all[] = {{"theta1'", "'θ\u0307₁' enhanced"},     {"V_eff", "'V_{eff}' enhanced"},
               {"x''", "'x\u0308' enhanced"},           {"theta[2]'", "'θ\u0307₂' enhanced"},
               {"m*x'^2", "'m·x\u0307^{2}' enhanced"},  {"a.theta - 1e-9", "'a.θ − 10^{−9}' enhanced"},
               {"speed'", "\"speed′\""},          {"x^(n+1)", "'x^{n+1}' enhanced"},
               {"A[1,2]", "'A_{1,2}' enhanced"},  {"q_1_b", "'q_{1,b}' enhanced"},
               {"phi_max'", "'φ\u0307_{max}' enhanced"},
               {"phi_b vs x", "'φ_{b}\u200b vs x' enhanced"},
               {"x_max'^2", "'x\u0307@^{2}_{/*0.97 max}' enhanced"},
               {"x_1^2", "'x₁^{2}' enhanced"}};

    (void)state;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        qdot_panel figure = two_curves();
        char *text;

        figure.axis[1] = (qdot_figure_label){all[i].plain, true};
        text = script_of_panel(&figure);
        if (i != 6 && strstr(text, all[i].markup) == NULL)
            fail_msg("%s: no %s in %s", all[i].plain, all[i].markup,
                     strstr(text, "set ylabel"));
        free(text);
    }
}

static void
several_curves_have_patterns(void **state)
{
    qdot_curve many[6];
    qdot_panel figure = two_curves();
    char *text;

    (void)state;
    figure.n = 1;
    text = script_of_panel(&figure);
    assert_null(strstr(text, "dashtype"));
    free(text);
    for (int i = 0; i < 6; i++)
        many[i] = both[i % 2];
    figure.curves = many;
    figure.n = 6;
    text = script_of_panel(&figure);
    assert_int_equal(times(text, "dashtype"), 6);
    assert_int_equal(times(text, "dashtype (3,4)"), 1);
    free(text);
}

/* Where many curves have short names these stand beside the axes, which end before them. */
static void
a_long_key_stands_beside_the_axes(void **state)
{
    qdot_curve many[6];
    qdot_panel figure = two_curves();
    char *text;

    (void)state;
    for (int i = 0; i < 6; i++) {
        many[i] = both[i % 2];
        many[i].label = (qdot_figure_label){"fourteen signs", false};
    }
    figure.curves = many;
    figure.n = 6;
    text = script_of_panel(&figure);
    assert_non_null(strstr(text, "set key at graph 1.02, graph 1 left top"));
    assert_non_null(strstr(text, "set rmargin at screen 0.6"));
    assert_non_null(strstr(text, "maxrows 6 Left reverse samplen 2.5 spacing 1.00\n"));
    free(text);
}

/* Fourteen rows are closer, so that none is lost below. */
static void
a_key_of_many_has_all_its_rows(void **state)
{
    qdot_curve many[14];
    qdot_panel figure = two_curves();
    char *text;

    (void)state;
    for (int i = 0; i < 14; i++) {
        many[i] = both[i % 2];
        many[i].label = (qdot_figure_label){"fourteen signs", false};
    }
    figure.curves = many;
    figure.n = 14;
    text = script_of_panel(&figure);
    assert_non_null(strstr(text, "maxrows 14 Left reverse samplen 2.5 spacing 0.6"));
    free(text);
}

static void
panels_share_their_abscissa(void **state)
{
    qdot_panel panels[2] = {two_curves(), two_curves()};
    const qdot_figure figure = {.panels = panels, .n = 2};
    char *text;

    (void)state;
    text = script_of(&figure);
    assert_non_null(strstr(text, "set xtics ('' 0, ")); /* numbers at the lower one only */
    assert_int_equal(times(text, "set xlabel 't'"), 1);
    free(text);
    panels[1].axis[0].text = "s";
    text = script_of(&figure);
    assert_int_equal(times(text, "set xlabel 't'"), 1);
    assert_int_equal(times(text, "set xlabel 's'"), 1);
    assert_null(strstr(text, "set xtics (''"));
    free(text);
}

static void
ranges_and_sizes_are_kept_to(void **state)
{
    qdot_panel panel = two_curves();
    const qdot_figure figure = {.panels = &panel, .n = 1, .width = 12.7, .height = 5.08};
    char *text;

    (void)state;
    panel.range[0] = (qdot_figure_range){2, 5, true};
    panel.range[1] = (qdot_figure_range){-1, 1, true};
    text = script_of(&figure);
    assert_non_null(strstr(text, "size 480,192 "));
    assert_non_null(strstr(text, "set xrange [2:5]"));
    assert_non_null(strstr(text, "set yrange [-1:1]"));
    free(text);
    panel.range[1] = (qdot_figure_range){100, 200, true};
    assert_int_equal(qdot_figure_write(&figure, "a.svg"), QDOT_EDOMAIN);
    assert_non_null(strstr(qdot_last_error()->message, "in its range"));
}

static void
paths_in_space_have_three_axes(void **state)
{
    const qdot_curve curve = {
        .label = {"p", true}, .rows = POINTS, .x = wave, .y = other, .z = t};
    const qdot_panel figure = {.axis = {{"x", false}, {"y", false}, {"z", false}},
                               .curves = &curve,
                               .n = 1,
                               .equal = true};
    char *text;

    (void)state;
    text = script_of_panel(&figure);
    assert_non_null(strstr(text, "splot "));
    assert_non_null(strstr(text, "using 1:2:3"));
    assert_non_null(strstr(text, "set view equal xyz"));
    assert_non_null(strstr(text, "set label 4 'z'"));
    free(text);
}

static qdot_status
sketch(const qdot_figure *figure, size_t columns, size_t rows, bool ascii, bool colours, qdot_text *text)
{
    const qdot_figure_sketching how = {columns, rows, ascii, colours};

    return qdot_figure_sketch(figure, 0, &how, text);
}

static void
a_sketch_shows_the_curve(void **state)
{
    const double at[] = {0, 1}, height[] = {0, 10};
    const qdot_curve curve = {.rows = 2, .x = at, .y = height};
    const qdot_panel panel = {.curves = &curve, .n = 1, .axis = {{"theta", true}}};
    const qdot_figure figure = {.panels = &panel, .n = 1};
    qdot_text text = {0};

    (void)state;
    assert_int_equal(sketch(&figure, 50, 7, true, false, &text), QDOT_OK);
    assert_string_equal(text.at, "      10.4 |                              ******\n"
                                 "           |                      ********\n"
                                 "           |              ********\n"
                                 "           |      ********\n"
                                 "      -0.4 |******\n"
                                 "            0               theta               1\n");
    qdot_text_clear(&text);
    assert_int_equal(sketch(&figure, 50, 7, false, false, &text), QDOT_OK);
    assert_non_null(strstr(text.at, "θ"));
    assert_non_null(strstr(text.at, "⠤"));
    qdot_text_clear(&text);
}

/* Where a label does not fit between the numbers these stand alone; no line is too long. */
/* A course that leaves the range of y is shown over all of its time. */
static void
a_range_of_y_cuts_no_time_off(void **state)
{
    const double at[] = {0, 1, 2, 3}, up[] = {5, 0, 1, 7};
    const qdot_curve curve = {.rows = 4, .x = at, .y = up};
    const qdot_panel panel = {.curves = &curve, .n = 1, .range = {{0}, {0, 2, true}}};
    char *text = script_of_panel(&panel);

    (void)state;
    assert_non_null(strstr(text, "set xrange [0:3]"));
    assert_non_null(strstr(text, "set yrange [0:2]"));
    free(text);
}

/* Two curves differ, and a line above says which is which; one alone has none. */
static void
curves_of_a_sketch_differ(void **state)
{
    const double at[] = {0, 1}, up[] = {0, 10}, down[] = {10, 0};
    const qdot_curve curves[] = {{.label = {"theta", true}, .rows = 2, .x = at, .y = up},
                                 {.label = {"<b>", false}, .rows = 2, .x = at, .y = down}};
    const qdot_panel panel = {.curves = curves, .n = 2};
    const qdot_figure figure = {.panels = &panel, .n = 1};
    qdot_text text = {0};

    (void)state;
    assert_int_equal(sketch(&figure, 50, 7, true, false, &text), QDOT_OK);
    assert_non_null(strstr(text.at, "           * theta   + <b>\n"));
    assert_non_null(strstr(text.at, "|++"));
    assert_non_null(strstr(text.at, "|**"));
    qdot_text_clear(&text);
    assert_int_equal(sketch(&figure, 50, 7, false, false, &text), QDOT_OK);
    assert_non_null(strstr(text.at, " θ   ⠒⠒⠂ ⠒⠒⠂ <b>\n"));
    qdot_text_clear(&text);
}

/* On a terminal with colours each curve has one, with its name. */
static void
curves_of_a_sketch_have_colours(void **state)
{
    const double at[] = {0, 1}, up[] = {0, 10}, down[] = {10, 0};
    const qdot_curve curves[] = {{.label = {"theta", true}, .rows = 2, .x = at, .y = up},
                                 {.label = {"<b>", false}, .rows = 2, .x = at, .y = down}};
    const qdot_panel both = {.curves = curves, .n = 2}, one = {.curves = curves, .n = 1};
    qdot_figure figure = {.panels = &both, .n = 1};
    qdot_text text = {0};

    (void)state;
    assert_int_equal(sketch(&figure, 50, 7, true, true, &text), QDOT_OK);
    assert_non_null(strstr(text.at, "           \033[34m*\033[39m theta   \033[31m+\033[39m <b>\n"));
    assert_non_null(strstr(text.at, "|\033[31m++"));
    assert_non_null(strstr(text.at, "|\033[34m**"));
    qdot_text_truncate(&text, 0);
    figure.panels = &one;
    assert_int_equal(sketch(&figure, 50, 7, true, true, &text), QDOT_OK);
    assert_null(strstr(text.at, "\033"));
    qdot_text_clear(&text);
}

/* Ends of an axis that agree in four digits have more; the vertical axis of a single curve has its name. */
static void
ends_of_a_sketch_differ(void **state)
{
    const double at[] = {2.5, 2.50000125}, height[] = {3.00321, 3.00322};
    const qdot_curve curve = {.rows = 2, .x = at, .y = height};
    const qdot_panel panel = {.curves = &curve, .n = 1, .axis = {{"t", true}, {"theta'", true}}};
    const qdot_figure figure = {.panels = &panel, .n = 1};
    qdot_text text = {0};

    (void)state;
    assert_int_equal(sketch(&figure, 60, 7, false, false, &text), QDOT_OK);
    assert_non_null(strstr(text.at, "        θ̇ │"));
    assert_non_null(strstr(text.at, "   3.00322 │"));
    assert_non_null(strstr(text.at, "   3.00321 │"));
    assert_non_null(strstr(text.at, " 2.5 "));
    assert_non_null(strstr(text.at, " 2.500001\n"));
    qdot_text_clear(&text);
}

/* A map has both axes named, and what it shows with its least and its greatest number. */
static void
a_sketch_of_a_map_names_its_axes(void **state)
{
    const double values[] = {1, 2, 3, 4};
    const qdot_figure_map map = {.label = {"x_1^2", true}, .n = {2, 2}, .most = {1, 1}, .value = values};
    const qdot_panel panel = {.map = &map, .axis = {{"t", true}, {"theta'", true}}};
    const qdot_figure figure = {.panels = &panel, .n = 1};
    qdot_text text = {0};

    (void)state;
    assert_int_equal(sketch(&figure, 60, 7, false, false, &text), QDOT_OK);
    assert_non_null(strstr(text.at, "x₁²: ⠁ 1, ⣿ 4\n"));
    assert_non_null(strstr(text.at, "        θ̇ │"));
    qdot_text_truncate(&text, 0);
    assert_int_equal(sketch(&figure, 60, 7, true, false, &text), QDOT_OK);
    assert_non_null(strstr(text.at, "x_1^2: blank 1, * 4\n"));
    qdot_text_clear(&text);
}

static void
a_narrow_sketch_fits(void **state)
{
    const double at[] = {9.736e-5, 3.854e-4}, height[] = {0, 10};
    const qdot_curve curve = {.rows = 2, .x = at, .y = height};
    const qdot_panel panel = {
        .curves = &curve, .n = 1, .axis = {{"CPU time in s", false}}};
    const qdot_figure figure = {.panels = &panel, .n = 1};
    qdot_text text = {0};

    (void)state;
    assert_int_equal(sketch(&figure, 40, 7, true, false, &text), QDOT_OK);
    assert_non_null(strstr(text.at, "\n            9.736e-05         0.0003854\n"));
    qdot_text_clear(&text);
}

static void
paths_have_equal_axes(void **state)
{
    const double at[] = {0, 4, 4, 0, 0}, height[] = {0, 0, 1, 1, 0};
    const size_t n = 5;
    const qdot_curve curve = {.rows = n, .x = at, .y = height};
    const qdot_panel figure = {.curves = &curve, .n = 1, .equal = true};
    double px[8], py[8];
    char *text;

    (void)state;
    assert_int_equal(write_panel(&figure, "a.svg"), QDOT_OK);
    text = take("a.svg");
    assert_int_equal(path_points(text, px, py, 8), n);
    free(text);
    assert_true(fabs(fabs((px[1] - px[0]) / (py[2] - py[1])) - 4) < 0.1);
    text = script_of_panel(&figure);
    assert_non_null(strstr(text, "set size ratio -1"));
    assert_non_null(strstr(text, "set xtics ('0.0' 0, '0.5' 0.5, "));
    assert_non_null(strstr(text, "set ytics ('0.0' 0, '0.5' 0.5, '1.0' 1)")); /* the same step */
    free(text);
}

/* A flat path, one that is tall in space: both axes have tics that tell the scale, numbers that do not
 * touch, and the whole is seen. */
static void
paths_of_any_shape_have_tics(void **state)
{
    const double at[] = {0, 8, 4, 0}, little[] = {0, 0, 0.1, 0}, tall[] = {0, 4, 80, 0};
    const size_t n = 4;
    qdot_curve curve = {.rows = n, .x = at, .y = little};
    const qdot_panel figure = {.curves = &curve, .n = 1, .equal = true};
    char *text;

    (void)state;
    text = script_of_panel(&figure);
    assert_non_null(strstr(text, "set xtics ('0' 0, '1' 1, "));
    assert_non_null(strstr(text, "set ytics ('−1' -1, '0' 0, '1' 1)"));
    free(text);
    curve.z = tall;
    text = script_of_panel(&figure);
    assert_non_null(strstr(text, "set view 62,32,0.19"));
    assert_non_null(strstr(text, "set ztics ('0' 0, '10' 10, '20' 20, "));
    free(text);
}

static void
a_locale_with_commas_changes_nothing(void **state)
{
    const qdot_panel figure = two_curves();
    char *plain, *comma;

    (void)state;
    assert_int_equal(write_panel(&figure, "a.svg"), QDOT_OK);
    plain = take("a.svg");
    if (setlocale(LC_ALL, "de_DE.UTF-8") == NULL) {
        free(plain);
        skip();
    }
    assert_int_equal(write_panel(&figure, "a.svg"), QDOT_OK);
    setlocale(LC_ALL, "C");
    comma = take("a.svg");
    assert_string_equal(plain, comma);
    free(plain);
    free(comma);
}

static void
a_missing_gnuplot_is_said_with_a_hint(void **state)
{
    const qdot_panel figure = two_curves();
    char *path = strdup(getenv("PATH"));
    qdot_status status;

    (void)state;
    setenv("PATH", "/nowhere", 1);
    status = write_panel(&figure, "a.png");
    setenv("PATH", path, 1);
    free(path);
    assert_int_equal(status, QDOT_EIO);
    assert_string_equal(qdot_last_error()->hint, "apt install gnuplot-nox; only a .svg needs no gnuplot");
    assert_int_equal(access("a.png", F_OK), -1);
}

/* Put a program `gnuplot` with this body first in the path, draw, take it away again. */
static qdot_status
with_gnuplot(const char *body, const char *figure_path)
{
    const qdot_panel figure = two_curves();
    char here[4096], *path = strdup(getenv("PATH"));
    qdot_text changed = {0};
    FILE *f = fopen("gnuplot", "w");
    qdot_status status;

    assert_non_null(f);
    fprintf(f, "#!/bin/sh\n%s\n", body);
    fclose(f);
    assert_int_equal(chmod("gnuplot", 0755), 0);
    assert_non_null(getcwd(here, sizeof here));
    qdot_text_format(&changed, "%s:%s", here, path);
    setenv("PATH", changed.at, 1);
    status = write_panel(&figure, figure_path);
    setenv("PATH", path, 1);
    free(path);
    qdot_text_clear(&changed);
    assert_int_equal(remove("gnuplot"), 0);
    return status;
}

static void
a_gnuplot_that_fails_is_told(void **state)
{
    (void)state;
    assert_int_equal(with_gnuplot("exit 0", "a.svg"),
                     QDOT_EIO); /* reads and writes nothing */
    assert_int_equal(with_gnuplot("echo half; exit 3", "a.svg"), QDOT_EIO);
    assert_int_equal(with_gnuplot("echo half; kill -9 $$", "a.svg"), QDOT_EIO);
    assert_int_equal(with_gnuplot("exit 127", "a.svg"), QDOT_EIO); /* a spawn that failed late */
    assert_string_equal(qdot_last_error()->hint, "apt install gnuplot-nox; only a .svg needs no gnuplot");
    assert_int_equal(with_gnuplot("echo 'plot x' >&2; echo '     ^' >&2;"
                                  "echo '     line 0: no such thing' >&2; exit 1",
                                  "a.svg"),
                     QDOT_EIO);
    assert_string_equal(qdot_last_error()->message, "gnuplot failed: no such thing");
    assert_int_equal(access("a.svg", F_OK), -1);
}

static void
a_window_that_cannot_open_is_told(void **state)
{
    (void)state;
    assert_int_equal(
        with_gnuplot("cat >script; grep -q \"set terminal x11\" script || exit 1;"
                     "rm script; test \"$2\" = -persist || exit 1;"
                     "sleep 5 & exit 0",
                     NULL),
        QDOT_OK);
    assert_int_equal(
        with_gnuplot("echo 'line 3: this gnuplot cannot open a window' >&2; exit 1",
                     NULL),
        QDOT_EIO);
    assert_non_null(strstr(qdot_last_error()->message, "cannot open a window"));
}

static void
a_file_that_cannot_be_written_is_an_error(void **state)
{
    const qdot_panel figure = two_curves();

    (void)state;
    assert_int_equal(write_panel(&figure, "missing/a.svg"), QDOT_EIO);
    assert_non_null(strstr(qdot_last_error()->message, "missing/a.svg"));
    if (access("/dev/full", W_OK) == 0) {
        assert_int_equal(symlink("/dev/full", "full.svg"), 0);
        assert_int_equal(write_panel(&figure, "full.svg"), QDOT_EIO);
        assert_non_null(strstr(qdot_last_error()->message, "No space left"));
        assert_int_equal(remove("full.svg"), 0);
    }
}

static void
ring(int signal)
{
    (void)signal;
    qdot_interrupt_set();
}

static void
ctrl_c_stops_a_gnuplot_that_hangs(void **state)
{
    (void)state;
    /* no SA_RESTART: the read returns, as it does in the program */
    sigaction(SIGALRM, &(struct sigaction){.sa_handler = ring}, NULL);
    alarm(1);
    assert_int_equal(with_gnuplot("exec sleep 30", "a.svg"), QDOT_EINTR);
    qdot_interrupt_clear();
    signal(SIGALRM, SIG_DFL);
}

static void
figures_need_no_standard_descriptors(void **state)
{
    const qdot_panel figure = two_curves();
    int in = dup(0), out;
    qdot_status status;

    (void)state;
    fflush(stdout);
    out = dup(1);
    close(0);
    close(1);
    status = write_panel(&figure, "a.svg");
    dup2(in, 0);
    dup2(out, 1);
    close(in);
    close(out);
    assert_int_equal(status, QDOT_OK);
    free(take("a.svg"));
}

static void
no_memory_is_an_error(void **state)
{
    const qdot_panel figure = two_curves();
    int64_t n = 0;

    (void)state;
    for (qdot_status status = QDOT_ENOMEM; status != QDOT_OK; n++) {
        qdot_memory_fail_at(n);
        status = write_panel(&figure, "a.svg");
        qdot_memory_fail_at(-1);
        assert_true(status == QDOT_OK || status == QDOT_ENOMEM);
    }
    free(take("a.svg"));
    assert_true(n > 5);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_ending_gives_its_kind_of_file),
        cmocka_unit_test(an_unknown_ending_is_an_error),
        cmocka_unit_test(the_curve_goes_through_its_points),
        cmocka_unit_test(labels_stand_literally),
        cmocka_unit_test(file_names_are_only_names),
        cmocka_unit_test(one_curve_has_no_key_two_have),
        cmocka_unit_test(points_that_are_not_finite_break_the_line),
        cmocka_unit_test(flat_lone_and_logarithmic_curves_are_drawn),
        cmocka_unit_test(long_logarithmic_axes_have_even_marks),
        cmocka_unit_test(paths_have_equal_axes),
        cmocka_unit_test(paths_of_any_shape_have_tics),
        cmocka_unit_test(values_that_differ_late_have_an_offset),
        cmocka_unit_test(formulas_are_set),
        cmocka_unit_test(several_curves_have_patterns),
        cmocka_unit_test(a_long_key_stands_beside_the_axes),
        cmocka_unit_test(a_key_of_many_has_all_its_rows),
        cmocka_unit_test(panels_share_their_abscissa),
        cmocka_unit_test(ranges_and_sizes_are_kept_to),
        cmocka_unit_test(paths_in_space_have_three_axes),
        cmocka_unit_test(a_sketch_shows_the_curve),
        cmocka_unit_test(a_range_of_y_cuts_no_time_off),
        cmocka_unit_test(curves_of_a_sketch_differ),
        cmocka_unit_test(curves_of_a_sketch_have_colours),
        cmocka_unit_test(ends_of_a_sketch_differ),
        cmocka_unit_test(a_sketch_of_a_map_names_its_axes),
        cmocka_unit_test(a_narrow_sketch_fits),
        cmocka_unit_test(a_locale_with_commas_changes_nothing),
        cmocka_unit_test(a_missing_gnuplot_is_said_with_a_hint),
        cmocka_unit_test(a_gnuplot_that_fails_is_told),
        cmocka_unit_test(a_window_that_cannot_open_is_told),
        cmocka_unit_test(a_file_that_cannot_be_written_is_an_error),
        cmocka_unit_test(ctrl_c_stops_a_gnuplot_that_hangs),
        cmocka_unit_test(figures_need_no_standard_descriptors),
        cmocka_unit_test(no_memory_is_an_error),
    };

    return cmocka_run_group_tests(tests, enter, leave);
}
