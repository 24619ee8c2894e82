/* test_figure-svg.c -- figures in SVG without gnuplot: points, axes, labels, maps, boxes. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "show/figure-parts.h"

enum { MOST = 64 };

/* The figure as SVG; the caller frees it. */
static char *
svg_of(const qdot_panel *panels, size_t n)
{
    const qdot_figure figure = {.panels = panels, .n = n};
    qdot_text text = {0};
    qdot_figure_drawing d = {.figure = &figure, .script = &text};

    assert_int_equal(qdot_figure_size(&figure, &d.width, &d.height, &d.points), QDOT_OK);
    assert_int_equal(qdot_figure_add_svg(&d), QDOT_OK);
    assert_memory_equal(text.at, "<svg ", 5);
    assert_string_equal(text.at + text.n - 7, "</svg>\n");
    return text.at;
}

/* The points "M x y L x y ..." of the path that begins at `path`; returns how many. */
static size_t
points_of(const char *path, double at[][2])
{
    const char *c = strstr(path, " d=\"");
    size_t n = 0;

    assert_non_null(c);
    for (c += 4; *c != '"' && n < MOST; n++) {
        char *end;

        assert_true(*c == 'M' || *c == 'L');
        at[n][0] = strtod(c + 1, &end);
        at[n][1] = strtod(end, &end);
        c = end;
    }
    return n;
}

/* Where the tic with this number stands, along x or y (0, 1), by its label. */
static double
place_of_number(const char *svg, const char *number, int axis)
{
    char wanted[64];
    const char *end, *c;

    snprintf(wanted, sizeof wanted, ">%s</text>", number);
    end = strstr(svg, wanted);
    assert_non_null(end);
    for (c = end; strncmp(c, "<text", 5) != 0; c--) {
    }
    return strtod(strstr(c, axis == 0 ? " x=\"" : " y=\"") + 4, NULL);
}

/* Numbers of an axis stand beside the points that have these values. */
static void
points_are_where_the_numbers_say(void **state)
{
    const double x[] = {0, 2, 4, 10}, y[] = {-1, 1, 0, 1};
    const qdot_curve curve = {.rows = 4, .x = x, .y = y};
    const qdot_panel panel = {.curves = &curve, .n = 1, .axis = {{"t", false}, {"y", false}}};
    char *svg = svg_of(&panel, 1);
    double at[MOST][2];

    (void)state;
    assert_int_equal(points_of(strstr(svg, "#0072b2"), at), 4);
    for (int i = 0; i < 4; i++) {
        char number[32];

        snprintf(number, sizeof number, "%g", x[i]);
        assert_true(fabs(at[i][0] - place_of_number(svg, number, 0)) < 0.02);
    }
    assert_true(fabs(at[1][1] - at[3][1]) < 0.02);
    assert_true(fabs((at[0][1] + at[1][1]) / 2 - at[2][1]) < 0.02);
    assert_true(fabs((place_of_number(svg, "1.0", 1) - place_of_number(svg, "0.0", 1)) - (at[1][1] - at[2][1])) < 0.02);
    free(svg);
}

/* Numbers at the end of an axis are whole: a digit is 0.56 letters wide. */
static void
long_numbers_stay_in_the_figure(void **state)
{
    const double x[] = {0, 70000}, y[] = {0, 1};
    const qdot_curve curve = {.rows = 2, .x = x, .y = y};
    const qdot_panel panel = {.curves = &curve, .n = 1, .axis = {{"t", false}, {"y", false}}};
    char *svg = svg_of(&panel, 1);
    const double wide = strtod(strstr(svg, "width=\"") + 7, NULL);
    const double letter = strtod(strstr(svg, "font-size=\"") + 11, NULL);

    (void)state;
    assert_true(letter > 5);
    assert_true(place_of_number(svg, "70000", 0) + 2.5 * 0.56 * letter <= wide);
    free(svg);
}

static void
powers_of_ten_are_equally_far_on_a_logarithmic_axis(void **state)
{
    const double x[] = {1, 10, 1000}, y[] = {1, 2, 3};
    const qdot_curve curve = {.rows = 3, .x = x, .y = y};
    const qdot_panel panel = {.curves = &curve, .n = 1, .log = {true, false}};
    char *svg = svg_of(&panel, 1);
    double at[MOST][2];

    (void)state;
    assert_int_equal(points_of(strstr(svg, "#0072b2"), at), 3);
    assert_true(fabs((at[2][0] - at[1][0]) - 2 * (at[1][0] - at[0][0])) < 0.05);
    assert_true(fabs(at[1][0] - place_of_number(svg, "10", 0)) < 0.02);
    free(svg);
}

/* What cannot be shown interrupts the line; what is far away stays finite. */
static void
lines_are_interrupted(void **state)
{
    const double x[] = {0, 1, 2, 3, 4}, y[] = {0, 1, NAN, 1e300, 0};
    const qdot_curve curve = {.rows = 5, .x = x, .y = y};
    const qdot_panel panel = {.curves = &curve, .n = 1, .range = {{0}, {0, 1, true}}};
    char *svg = svg_of(&panel, 1);
    const char *path = strstr(strstr(svg, "#0072b2"), " d=\"") + 4, *second = strchr(path + 1, 'M');
    double at[MOST][2];

    (void)state;
    assert_non_null(second);
    assert_true(second < strchr(path, '"'));
    assert_int_equal(points_of(strstr(svg, "#0072b2"), at), 4);
    assert_true(at[2][1] <= -1e5 && at[2][1] >= -1e6);
    free(svg);
}

static void
labels_are_set_with_greek_letters_dots_and_powers(void **state)
{
    const double x[] = {0, 1}, y[] = {0, 1};
    const qdot_curve curves[] = {{.rows = 2, .x = x, .y = y, .label = {"theta1'^2", true}},
                                 {.rows = 2, .x = x, .y = y, .label = {"<a> & \"b\"_{c}", false}}};
    const qdot_panel panel = {.curves = curves, .n = 2, .axis = {{"V_eff", true}, {"theta'", true}}, .unit = {NULL, "rad/s^2"},
                              .title = {"T_1^2", true}};
    char *svg = svg_of(&panel, 1);

    (void)state;
    assert_non_null(strstr(svg, "&lt;a&gt; &amp; \"b\"_{c}</text>"));
    assert_non_null(strstr(svg, ">V<tspan dy=\"0.371em\" font-size=\"70%\">eff</tspan></text>"));
    assert_non_null(strstr(svg, ">θ\u0307₁<tspan dy=\"-0.6em\" font-size=\"70%\">2</tspan></text>"));
    assert_non_null(strstr(svg, ">θ\u0307 [rad/s<tspan dy=\"-0.6em\" font-size=\"70%\">2</tspan><tspan dy=\"0.42em\">]</tspan></text>"));
    free(svg);
}

/* A power above an index takes its room back; what follows stands on the line again. */
static void
a_power_stands_above_an_index(void **state)
{
    const double x[] = {0, 1}, y[] = {0, 1};
    const qdot_curve curve = {.rows = 2, .x = x, .y = y};
    const qdot_panel panel = {.curves = &curve, .n = 1, .axis = {{"v_max^2 + 1", true}}};
    char *svg = svg_of(&panel, 1);

    (void)state;
    assert_non_null(strstr(svg, ">v<tspan dy=\"-0.6em\" font-size=\"70%\">2</tspan>"
                                "<tspan dy=\"0.971em\" dx=\"-0.56em\" font-size=\"70%\">max</tspan><tspan dy=\"-0.26em\">"));
    free(svg);
}

/* Parallel projection: what is in the middle is drawn in the middle, and all is within the figure. */
static void
paths_in_space_are_projected(void **state)
{
    const double x[] = {0, 1, 2}, y[] = {0, 0.5, 1}, z[] = {1, 2, 3};
    const qdot_curve curve = {.rows = 3, .x = x, .y = y, .z = z};
    const qdot_panel panel = {.curves = &curve, .n = 1, .equal = true, .axis = {{"x", false}, {"y", false}, {"z", false}}};
    char *svg = svg_of(&panel, 1);
    double at[MOST][2];

    (void)state;
    assert_int_equal(points_of(strstr(svg, "#0072b2"), at), 3);
    for (int i = 0; i < 2; i++) {
        assert_true(fabs((at[0][i] + at[2][i]) / 2 - at[1][i]) < 0.02);
        for (int k = 0; k < 3; k++)
            assert_true(at[k][i] > 0 && at[k][i] < 529);
    }
    assert_int_equal(points_of(strstr(svg, "#d0d0d0"), at), 3); /* on the floor */
    free(svg);
}

/* Each cell has its colour once: the areas of all cells are those of the grid, blank ones apart. */
static void
maps_have_every_cell(void **state)
{
    const double value[] = {0, 0, 1, NAN, 0.5, 1};
    const qdot_figure_map map = {.n = {3, 2}, .least = {0, 0}, .most = {2, 1}, .value = value};
    const qdot_panel panel = {.map = &map};
    char *svg = svg_of(&panel, 1);
    unsigned cells = 0;

    (void)state;
    for (const char *c = strstr(svg, "crispEdges"); (c = strchr(c, 'M')) != NULL && c < strstr(svg, "</g>"); c++) {
        unsigned i, j, n;

        if (sscanf(c, "M%u %uh%uv1", &i, &j, &n) == 3)
            cells += n;
    }
    assert_int_equal(cells, 5);
    assert_non_null(strstr(svg, "<path fill=\"#440255\" d=\"M0 0h2v1h-2z\"/>"));
    assert_non_null(strstr(svg, "d=\"M2 0h1v1h-1zM2 1h1v1h-1z\"/>"));
    free(svg);
}

/* All values alike, or so near to each other that doubles have nothing between them: no division by 0. */
static void
axes_without_width_are_drawn(void **state)
{
    const double x[] = {1, 1}, y[] = {3, nextafter(3, 4)};
    const qdot_curve curve = {.rows = 2, .x = x, .y = y};
    const qdot_panel panel = {.curves = &curve, .n = 1};
    char *svg = svg_of(&panel, 1);

    (void)state;
    assert_null(strstr(svg, "nan"));
    assert_null(strstr(svg, "inf"));
    free(svg);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_are_where_the_numbers_say),
        cmocka_unit_test(long_numbers_stay_in_the_figure),
        cmocka_unit_test(powers_of_ten_are_equally_far_on_a_logarithmic_axis),
        cmocka_unit_test(lines_are_interrupted),
        cmocka_unit_test(labels_are_set_with_greek_letters_dots_and_powers),
        cmocka_unit_test(a_power_stands_above_an_index),
        cmocka_unit_test(paths_in_space_are_projected),
        cmocka_unit_test(maps_have_every_cell),
        cmocka_unit_test(axes_without_width_are_drawn),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
