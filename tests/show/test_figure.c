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
#include "show/show.h"

enum { POINTS = 200 };

static char folder[] = "qdot-figure-XXXXXX";
static double t[POINTS], wave[POINTS], other[POINTS];
static const qdot_column x[] = {{"t", t}, {"t", t}};
static const qdot_column y[] = {{"theta_1", wave}, {"theta_2", other}};
static const size_t rows[] = {POINTS, POINTS};

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

static qdot_figure
two_curves(void)
{
    return (qdot_figure){.title = "two",
                         .x_label = "t",
                         .y_label = "theta",
                         .curves = 2,
                         .x = x,
                         .y = y,
                         .rows = rows};
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

static void
each_ending_gives_its_kind_of_file(void **state)
{
    const qdot_figure figure = two_curves();
    const struct {
        const char *path, *begins;
    } all[] = {{"a.svg", "<?xml"}, {"a.png", "\x89PNG"}, {"a.b.pdf", "%PDF"}};

    (void)state;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        char *text;

        assert_int_equal(qdot_figure_write(&figure, all[i].path), QDOT_OK);
        text = take(all[i].path);
        assert_memory_equal(text, all[i].begins, strlen(all[i].begins));
        free(text);
    }
}

static void
an_unknown_ending_is_an_error(void **state)
{
    const char *const bad[] = {"a.gif", "a", "svg", "", "a.svg/b", "a.svg.txt"};
    const qdot_figure figure = two_curves();

    (void)state;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(qdot_figure_write(&figure, bad[i]), QDOT_EINVAL);
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
    const qdot_column cx = {"x", at}, cy = {"y", height};
    const size_t n = 6;
    const qdot_figure figure = {.curves = 1, .x = &cx, .y = &cy, .rows = &n};
    double px[16], py[16];
    char *text;

    (void)state;
    assert_int_equal(qdot_figure_write(&figure, "a.svg"), QDOT_OK);
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
    const qdot_column strange[] = {
        {"it's \"x_1^2\" `id` @y {/Bold z} \\n $c0 \"12%d%%", wave},
        {"θ̇ & <b>\nplot sin(x)", other}};
    qdot_figure figure = two_curves();
    char *text;

    (void)state;
    figure.y = strange;
    figure.title = "a\\";
    figure.x_label = "'; system 'touch harm'; '";
    assert_int_equal(qdot_figure_write(&figure, "a.svg"), QDOT_OK);
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
    const qdot_figure figure = two_curves();

    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        assert_int_equal(qdot_figure_write(&figure, names[i]), QDOT_OK);
        free(take(names[i]));
    }
}

static void
one_curve_has_no_key_two_have(void **state)
{
    qdot_figure figure = two_curves();
    char *text;

    (void)state;
    assert_int_equal(qdot_figure_write(&figure, "a.svg"), QDOT_OK);
    text = take("a.svg");
    assert_non_null(strstr(text, ">theta_2<"));
    free(text);
    figure.curves = 1;
    assert_int_equal(qdot_figure_write(&figure, "a.svg"), QDOT_OK);
    text = take("a.svg");
    assert_null(strstr(text, ">theta_1<"));
    free(text);
}

static void
points_that_are_not_finite_break_the_line(void **state)
{
    const double at[] = {0, 1, 2, 3, 4}, height[] = {1, INFINITY, 3, NAN, 1e308};
    const qdot_column cx = {"x", at}, cy = {"y", height};
    size_t n = 3;
    const qdot_figure figure = {.curves = 1, .x = &cx, .y = &cy, .rows = &n};
    const double none[] = {NAN, INFINITY};
    const qdot_column nothing = {"y", none};
    qdot_figure empty = figure;

    (void)state;
    assert_int_equal(qdot_figure_write(&figure, "a.svg"), QDOT_OK);
    free(take("a.svg"));
    n = 2;
    empty.y = &nothing;
    assert_int_equal(qdot_figure_write(&empty, "a.svg"), QDOT_EDOMAIN);
    n = 0;
    assert_int_equal(qdot_figure_write(&empty, "a.svg"), QDOT_EDOMAIN);
    empty.curves = 0;
    assert_int_equal(qdot_figure_write(&empty, "a.svg"), QDOT_EINVAL);
    assert_int_equal(access("a.svg", F_OK), -1);
}

static void
flat_lone_and_logarithmic_curves_are_drawn(void **state)
{
    const double at[] = {1e-15, 1e-9, 1e-3}, flat[] = {2, 2, 2}, signs[] = {-1, 1e-12, 1};
    const qdot_column cx = {"x", at}, cy = {"y", flat}, cs = {"y", signs};
    size_t n = 3;
    qdot_figure figure = {.curves = 1, .x = &cx, .y = &cy, .rows = &n};

    (void)state;
    assert_int_equal(qdot_figure_write(&figure, "a.svg"), QDOT_OK);
    free(take("a.svg"));
    figure.equal_axes = true;
    assert_int_equal(qdot_figure_write(&figure, "a.svg"), QDOT_OK);
    free(take("a.svg"));
    figure.equal_axes = false;
    figure.log_x = figure.log_y = true;
    figure.y = &cs;
    assert_int_equal(qdot_figure_write(&figure, "a.svg"), QDOT_OK);
    free(take("a.svg"));
    n = 1;
    figure.y = &cy;
    assert_int_equal(qdot_figure_write(&figure, "a.svg"), QDOT_OK);
    free(take("a.svg"));
    figure.y = &cs;
    assert_int_equal(qdot_figure_write(&figure, "a.svg"), QDOT_EDOMAIN);
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
    const qdot_column cx = {"x", at}, cy = {"y", height};
    const size_t n = 3;
    const qdot_figure figure = {.curves = 1, .x = &cx, .y = &cy, .rows = &n, .log_y = true};
    char *text;

    (void)state;
    assert_int_equal(qdot_figure_write(&figure, "a.svg"), QDOT_OK);
    text = take("a.svg");
    assert_int_equal(times(text, "1e-10<"), 1);
    assert_true(times(text, "1e-") >= 5 && times(text, "1e-") <= 9);
    assert_true(times(text, " M") <= 10); /* no marks of 2, 3, ... 9 times what is labelled */
    free(text);
}

static void
paths_have_equal_axes(void **state)
{
    const double at[] = {0, 4, 4, 0, 0}, height[] = {0, 0, 1, 1, 0};
    const qdot_column cx = {"x", at}, cy = {"y", height};
    const size_t n = 5;
    const qdot_figure figure = {
        .curves = 1, .x = &cx, .y = &cy, .rows = &n, .equal_axes = true};
    double px[8], py[8];
    char *text;

    (void)state;
    assert_int_equal(qdot_figure_write(&figure, "a.svg"), QDOT_OK);
    text = take("a.svg");
    assert_int_equal(path_points(text, px, py, 8), n);
    assert_non_null(strstr(text, "> 1<")); /* one step of tics for both axes */
    assert_null(strstr(text, "> 0.5<"));
    free(text);
    assert_true(fabs(fabs((px[1] - px[0]) / (py[2] - py[1])) - 4) < 0.1);
}

static void
a_locale_with_commas_changes_nothing(void **state)
{
    const qdot_figure figure = two_curves();
    char *plain, *comma;

    (void)state;
    assert_int_equal(qdot_figure_write(&figure, "a.svg"), QDOT_OK);
    plain = take("a.svg");
    if (setlocale(LC_ALL, "de_DE.UTF-8") == NULL) {
        free(plain);
        skip();
    }
    assert_int_equal(qdot_figure_write(&figure, "a.svg"), QDOT_OK);
    setlocale(LC_ALL, "C");
    comma = take("a.svg");
    assert_string_equal(plain, comma);
    free(plain);
    free(comma);
}

static void
a_missing_gnuplot_is_said_with_a_hint(void **state)
{
    const qdot_figure figure = two_curves();
    char *path = strdup(getenv("PATH"));
    qdot_status status;

    (void)state;
    setenv("PATH", "/nowhere", 1);
    status = qdot_figure_write(&figure, "a.svg");
    setenv("PATH", path, 1);
    free(path);
    assert_int_equal(status, QDOT_EIO);
    assert_string_equal(qdot_last_error()->hint, "apt install gnuplot-nox");
    assert_int_equal(access("a.svg", F_OK), -1);
}

/* Put a program `gnuplot` with this body first in the path, draw, take it away again. */
static qdot_status
with_gnuplot(const char *body, const char *figure_path)
{
    const qdot_figure figure = two_curves();
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
    status = qdot_figure_write(&figure, figure_path);
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
    assert_string_equal(qdot_last_error()->hint, "apt install gnuplot-nox");
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
    const qdot_figure figure = two_curves();

    (void)state;
    assert_int_equal(qdot_figure_write(&figure, "missing/a.svg"), QDOT_EIO);
    assert_non_null(strstr(qdot_last_error()->message, "missing/a.svg"));
    if (access("/dev/full", W_OK) == 0) {
        assert_int_equal(symlink("/dev/full", "full.svg"), 0);
        assert_int_equal(qdot_figure_write(&figure, "full.svg"), QDOT_EIO);
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
    const qdot_figure figure = two_curves();
    int in = dup(0), out;
    qdot_status status;

    (void)state;
    fflush(stdout);
    out = dup(1);
    close(0);
    close(1);
    status = qdot_figure_write(&figure, "a.svg");
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
    const qdot_figure figure = two_curves();
    long n = 0;

    (void)state;
    for (qdot_status status = QDOT_ENOMEM; status != QDOT_OK; n++) {
        qdot_memory_fail_at(n);
        status = qdot_figure_write(&figure, "a.svg");
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
