/* figure-axis.c -- axes of a figure: their tics, offset, power of ten.
 *
 * Tics are listed one by one, so that they are the same whatever gnuplot's version, and differ
 * from each other however near the values are.
 */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/utf8.h"
#include "show/figure-parts.h"

enum { EXACT = 17, TIC = 12, MOST_TICS = 40 };

/* A tic distance, 1, 2 or 5 times a power of ten, that divides `span` into about `steps`; 0 if
 * there is none. */
static double
rounded_tic_step(double span, double steps)
{
    const double ten = pow(10, floor(log10(span / steps))), times = span / steps / ten;

    return !isfinite(ten) || ten == 0 ? 0
           : times < 1.5              ? ten
           : times < 3.5              ? 2 * ten
           : times < 7.5              ? 5 * ten
                                      : 10 * ten;
}

/* Tic steps of an axis of angles, as fractions of pi: those with which angles are easy to read. */
static const struct {
    int times, over;
} angles[] = {{1, 12}, {1, 6}, {1, 4}, {1, 2}, {1, 1}, {2, 1}, {4, 1}, {10, 1}, {20, 1}, {50, 1}, {100, 1}};

/* Set the tic distance of an axis of angles, the nearest to `steps` in the span; false: the span is too small, or so
 * large that turns are not counted any more. */
static bool
choose_angle_step(qdot_figure_axis *a, double steps)
{
    const double wanted = (a->most - a->least) / steps;
    enum { ANGLES = sizeof angles / sizeof *angles };
    size_t best = 0;

    if (wanted < M_PI / 20 || wanted > 150 * M_PI)
        return false;
    for (size_t i = 1; i < ANGLES; i++)
        if (fabs(log(angles[i].times * M_PI / (angles[i].over * wanted))) <
            fabs(log(angles[best].times * M_PI / (angles[best].over * wanted))))
            best = i;
    a->times = angles[best].times;
    a->over = angles[best].over;
    a->step = a->times * M_PI / a->over;
    return true;
}

/* The tic distance of an axis in degrees: a part of a turn, the nearest to `steps` in the span; 0: the span is too small or
 * too large for these. */
static double
degree_step(double span, double steps)
{
    static const double degrees[] = {15, 30, 45, 90, 180, 360, 720};
    const double wanted = span / steps;
    double best = degrees[0];

    if (wanted < 10 || wanted > 1000)
        return 0;
    for (size_t i = 1; i < sizeof degrees / sizeof *degrees; i++)
        if (fabs(log(degrees[i] / wanted)) < fabs(log(best / wanted)))
            best = degrees[i];
    return best;
}

bool
qdot_figure_add_pi(qdot_text *out, double x)
{
    enum { PARTS = 12 };
    const double parts = round(x * PARTS / M_PI);
    int64_t above = llabs((int64_t)parts), below = PARTS;

    if (!(fabs(parts) < 1e9) || fabs(x * PARTS / M_PI - parts) > 1e-9 * fmax(1, fabs(parts)))
        return false;
    for (int64_t k = PARTS; k > 1; k--)
        if (above % k == 0 && below % k == 0) {
            above /= k;
            below /= k;
        }
    if (above == 0) {
        qdot_text_char(out, '0');
        return true;
    }
    qdot_text_add(out, parts < 0 ? "−" : "");
    if (above > 1)
        qdot_text_format(out, "%" PRId64, above);
    qdot_text_add(out, "π");
    if (below > 1)
        qdot_text_format(out, "/%" PRId64, below);
    return true;
}

/* Write a number as printf does, but with a decimal point in every locale. */
static void
print_number(char *out, size_t size, const char *format, int digits, double value)
{
    snprintf(out, size, format, digits, value);
    for (; *out != '\0'; out++)
        if (*out == ',')
            *out = '.';
}

/* Append a number with a typographic minus sign. */
static void
add_signed(qdot_text *out, const char *number)
{
    if (number[0] == '-')
        qdot_text_add(out, "−");
    qdot_text_add(out, number + (number[0] == '-'));
}

/* --- offset and power ----------------------------------------------------------------- */

/* Choose the offset subtracted from an axis's numbers: their middle, rounded to few digits. */
static void
choose_offset(qdot_figure_axis *a)
{
    const double span = a->most - a->least, middle = a->least + span / 2;
    const double digits = floor(log10(fabs(middle))) - ceil(log10(span));
    char number[32], *exponent;
    int power;

    snprintf(number, sizeof number, "%.*e", (int)fmin(fmax(digits, 0), 16), middle);
    a->offset = strtod(number, NULL); /* in the locale in which it was printed */
    print_number(number, sizeof number, "%.*e", (int)fmin(fmax(digits, 0), 16), middle);
    exponent = strchr(number, 'e');
    power = atoi(exponent + 1);
    if (power >= -5 && power < 16) {
        print_number(number, sizeof number, "%.*f", (int)fmin(fmax(digits - power, 0), 20),
                     a->offset);
        exponent = NULL;
    } else {
        *exponent = '\0';
    }
    if (strchr(number, '.') != NULL) { /* remove zeros at the end */
        size_t n = strlen(number);

        while (number[n - 1] == '0')
            n--;
        number[n - (number[n - 1] == '.')] = '\0';
    }
    snprintf(a->offset_text, sizeof a->offset_text, "%s", number + (number[0] == '-'));
    if (exponent != NULL)
        snprintf(a->offset_text + strlen(a->offset_text),
                 sizeof a->offset_text - strlen(a->offset_text), "·10^{%s%d}",
                 power < 0 ? "−" : "", abs(power));
}

int
qdot_figure_power(double least, double most)
{
    const double largest = fmax(fabs(least), fabs(most));

    return largest >= 2e-3 && largest < 1e5
               ? 0
               : (int)fmin(fmax(floor(log10(largest)), -300), 300);
}

qdot_figure_axis
qdot_figure_axis_of(double least, double most, qdot_figure_tics tics, double steps, const int *power)
{
    qdot_figure_axis a = {.least = least, .most = most, .log = tics == QDOT_TICS_LOG};
    double largest = fmax(fabs(least), fabs(most));

    if (a.log || !isfinite(most - least) || !(most > least))
        return a;
    if (tics == QDOT_TICS_PI && choose_angle_step(&a, steps))
        return a;
    if (tics == QDOT_TICS_DEGREES)
        a.step = degree_step(most - least, steps);
    if (a.step > 0)
        return a;
    if (rounded_tic_step(most - least, steps) < 2e-5 * largest && (least > 0) == (most > 0)) {
        choose_offset(&a);
        a.least -= a.offset;
        a.most -= a.offset;
    }
    a.power = power != NULL ? *power : qdot_figure_power(a.least, a.most);
    a.least /= pow(10, a.power);
    a.most /= pow(10, a.power);
    a.step = rounded_tic_step(a.most - a.least, steps);
    return a;
}

/* --- tics of an axis ------------------------------------------------------------------ */

static double
first_tic_index(const qdot_figure_axis *a)
{
    return ceil(a->least / a->step - 1e-9);
}

static double
last_tic_index(const qdot_figure_axis *a)
{
    return floor(a->most / a->step + 1e-9);
}

int
qdot_figure_count_tics(const qdot_figure_axis *a)
{
    return a->step > 0 ? (int)fmin(last_tic_index(a) - first_tic_index(a) + 1, MOST_TICS) : 0;
}

/* The list of an axis's tics while it is being filled. */
typedef struct {
    qdot_figure_tic *at;
    size_t n;
} tics;

static void
append_tic(tics *t, double at, qdot_text *label, size_t letters, bool minor)
{
    qdot_figure_tic *tic = &t->at[t->n];

    if (t->n == QDOT_FIGURE_TICS)
        return;
    *tic = (qdot_figure_tic){.at = at, .letters = letters, .minor = minor};
    if (!label->failed && label->n < sizeof tic->label)
        memcpy(tic->label, qdot_text_str(label), label->n);
    t->n++;
}

static void
list_linear_tics(const qdot_figure_axis *a, tics *t)
{
    const int decimals = (int)fmax(0, -floor(log10(a->step) + 1e-9));
    const double first = first_tic_index(a), last = last_tic_index(a);
    qdot_text label = {0};

    for (double k = first; k <= last && k < first + MOST_TICS; k++) {
        char number[64];

        qdot_text_truncate(&label, 0);
        print_number(number, sizeof number, "%.*f", decimals, k == 0 ? 0 : k * a->step);
        if (a->over == 0 || !qdot_figure_add_pi(&label, k * a->step))
            add_signed(&label, number);
        append_tic(t, k == 0 ? 0 : k * a->step, &label, qdot_utf8_columns(qdot_text_str(&label), label.n), false);
    }
    qdot_text_clear(&label);
}

/* Append times 10^power (times: 1 ... 9) as 0.1, 1, 20 if `plain`, otherwise as 2·10^k. Returns the number of letters. */
static size_t
add_power_of_ten(qdot_text *label, int times, int power, bool plain)
{
    if (plain && power >= 0) {
        qdot_text_double(label, times * pow(10, power), 4);
    } else if (plain) {
        qdot_text_double(label, times / pow(10, -power), 4);
    } else {
        if (times > 1 || power == 0)
            qdot_text_format(label, power != 0 ? "%d·" : "%d", times);
        if (power != 0)
            qdot_text_format(label, "10^{%s%d}", power < 0 ? "−" : "", abs(power));
    }
    return label->n - (plain || label->n < 5 ? 0 : 5);
}

/* Whether times * 10^k has a number on an axis of so many powers of ten: at most nine powers; on
 * a short axis 2 and 5 times them too, on a very short one all, or those that are apart if they are
 * no plain numbers. */
static bool
is_numbered_log_tic(int times, int k, double decades, bool plain)
{
    const int stride = (int)ceil(decades / 8);

    if (times == 1)
        return k % stride == 0;
    if (decades < 0.6)
        return plain || times < 4 || times % 2 == 0;
    return decades < 1.9 && (times == 2 || times == 5);
}

static void
list_log_tics(const qdot_figure_axis *a, tics *t)
{
    const double low = log10(a->least), high = log10(a->most), decades = high - low;
    const bool plain = low > -2.01 && high < 3.99;
    qdot_text label = {0};

    for (int k = (int)floor(low); k <= (int)ceil(high); k++)
        for (int times = 1; times < (decades > 8 ? 2 : 10); times++) {
            const double at = times * pow(10, k);
            const bool large = is_numbered_log_tic(times, k, decades, plain);
            size_t letters = 0;

            if (at < a->least * (1 - 1e-12) || at > a->most * (1 + 1e-12))
                continue;
            qdot_text_truncate(&label, 0);
            if (large)
                letters = add_power_of_ten(&label, times, k, plain);
            append_tic(t, at, &label, letters, !large);
        }
    qdot_text_clear(&label);
}

/* Choose tics like those of a linear axis for a logarithmic one that spans less than a factor of two. */
static void
list_short_log_tics(const qdot_figure_axis *a, tics *t)
{
    const double step = rounded_tic_step(a->most - a->least, 5);
    qdot_text label = {0};

    for (double k = ceil(a->least / step); k <= floor(a->most / step) && step > 0; k++) {
        qdot_text_truncate(&label, 0);
        qdot_text_double(&label, k * step, 4);
        append_tic(t, k * step, &label, label.n, false);
    }
    qdot_text_clear(&label);
}

size_t
qdot_figure_find_tics(const qdot_figure_axis *a, qdot_figure_tic *list)
{
    tics t = {list, 0};

    if (!a->log && a->step > 0)
        list_linear_tics(a, &t);
    else if (a->log && a->most < 2 * a->least)
        list_short_log_tics(a, &t);
    else if (a->log)
        list_log_tics(a, &t);
    return t.n;
}

void
qdot_figure_add_axis(qdot_text *script, char name, const qdot_figure_axis *a, bool bare,
                     size_t *width)
{
    qdot_figure_tic tics[QDOT_FIGURE_TICS];
    size_t n;

    if (!a->log && a->step == 0) { /* the step is too small for doubles: let gnuplot choose */
        qdot_text_format(script, "set %crange [*:*]\nset %ctics autofreq\n", name, name);
        return;
    }
    qdot_text_format(script, a->log ? "set logscale %c\n" : "unset logscale %c\n", name);
    qdot_text_format(script, "set %crange [", name);
    qdot_text_double(script, a->least, EXACT);
    qdot_text_char(script, ':');
    qdot_text_double(script, a->most, EXACT);
    qdot_text_format(script, "]\nset %ctics (", name);
    n = qdot_figure_find_tics(a, tics);
    for (size_t i = 0; i < n; i++) {
        qdot_text_add(script, i > 0 ? ", " : "");
        qdot_figure_add_quoted(script, bare ? "" : tics[i].label);
        qdot_text_char(script, ' ');
        qdot_text_double(script, tics[i].at, TIC);
        qdot_text_add(script, tics[i].minor ? " 1" : "");
        *width = tics[i].letters > *width ? tics[i].letters : *width;
    }
    qdot_text_add(script, ")\n");
}

/* --- the label of an axis ------------------------------------------------------------- */

qdot_figure_label
qdot_figure_moved_label(char name, const qdot_figure_label *label, bool *compound)
{
    static const char *const letters[] = {"x", "y", "z"};
    const bool own = label->text != NULL && label->text[0] != '\0';

    *compound = own && strpbrk(label->text, " ,+-*/") != NULL;
    return own ? *label : (qdot_figure_label){letters[name - 'x'], false};
}

/* Append the label of an axis together with the offset and the power of ten of its numbers. */
static void
add_scaled_label(qdot_text *markup, char name, const qdot_figure_axis *a,
                 const qdot_figure_label *label)
{
    const bool moved = a->offset_text[0] != '\0', scaled = a->power != 0;
    bool compound;
    const qdot_figure_label own = qdot_figure_moved_label(name, label, &compound);

    compound = compound && (moved || scaled);
    qdot_text_add(markup, moved && scaled ? "(" : "");
    qdot_text_add(markup, compound ? "(" : "");
    qdot_figure_add_markup(markup, &own);
    qdot_text_add(markup, compound ? ")" : "");
    if (moved)
        qdot_text_format(markup, a->offset > 0 ? " − %s" : " + %s", a->offset_text);
    qdot_text_add(markup, moved && scaled ? ")" : "");
    if (scaled)
        qdot_text_format(markup, " / 10^{%s%d}", a->power < 0 ? "−" : "", abs(a->power));
}

/* Whether the label of an axis is set as it is, without offset, power of ten or unit. */
static bool
is_label_alone(const qdot_figure_axis *a, const qdot_figure_label *label, const char *unit)
{
    const bool named = label->text != NULL && label->text[0] != '\0', in_unit = unit != NULL && *unit != '\0';

    return a->offset_text[0] == '\0' && a->power == 0 && !(named && in_unit);
}

void
qdot_figure_add_axis_markup(qdot_text *markup, char name, const qdot_figure_axis *a, const qdot_figure_label *label,
                            const char *unit)
{
    if (is_label_alone(a, label, unit)) {
        qdot_figure_add_markup(markup, label);
        return;
    }
    add_scaled_label(markup, name, a, label);
    if (label->text != NULL && label->text[0] != '\0')
        qdot_figure_add_unit_markup(markup, unit);
}

/* Append the label in quotes, with gnuplot's keyword for reading it as markup or as plain text. */
static void
axis_add_label(qdot_text *script, char name, const qdot_figure_axis *a,
               const qdot_figure_label *label, const char *unit)
{
    qdot_text markup = {0};

    if (is_label_alone(a, label, unit)) {
        qdot_figure_add_label(script, label);
        return;
    }
    qdot_figure_add_axis_markup(&markup, name, a, label, unit);
    qdot_figure_add_quoted(script, qdot_text_str(&markup));
    qdot_text_add(script, " enhanced");
    script->failed = script->failed || markup.failed;
    qdot_text_clear(&markup);
}

void
qdot_figure_add_axis_label(qdot_text *script, char name, const qdot_figure_axis *a,
                           const qdot_figure_label *label, const char *unit)
{
    const bool above = name == 'y' && a->offset_text[0] != '\0'; /* above the axis: the label is long */

    if (name == 'y')
        qdot_text_add(script, "unset label 1\n");
    if (above)
        qdot_text_add(script, "unset ylabel\nset label 1 ");
    else
        qdot_text_format(script, "set %clabel ", name);
    axis_add_label(script, name, a, label, unit);
    qdot_text_add(script, above         ? " at graph 0, graph 1 offset -4,0.9 left\n"
                          : name == 'x' ? " offset 0,0.5\n"
                                        : "\n");
}

void
qdot_figure_add_edge_label(qdot_text *script, int k, const qdot_figure_axis *axes,
                           const qdot_figure_label *label, const char *unit, size_t width)
{
    /* positions of the axis labels: the middle of the two front edges of the box, the upper end of the left one */
    const double at[3][3] = {
        {(axes[0].least + axes[0].most) / 2, axes[1].least, axes[2].least},
        {axes[0].most, (axes[1].least + axes[1].most) / 2, axes[2].least},
        {axes[0].least, axes[1].least, axes[2].most}};

    qdot_text_format(script, "set label %d ", k + 2);
    axis_add_label(script, "xyz"[k], &axes[k], label, unit);
    qdot_text_add(script, " at first ");
    for (int i = 0; i < 3; i++) { /* coordinates with a precision of a thousandth of the axis */
        const double part = pow(10, floor(log10(axes[i].most - axes[i].least)) - 3);

        qdot_text_add(script, i > 0 ? ", first " : "");
        qdot_text_double(script, part * round(at[k][i] / part), 6);
    }
    if (k == 1) /* place the label after the numbers of the axis */
        qdot_text_format(script, " offset %.1f,-1.7 left\n", 2.4 + 0.8 * (double)width);
    else
        qdot_text_add(script, k == 0 ? " offset -3,-2.6 right\n" : " offset 0,1.2 center\n");
}

void
qdot_figure_add_column(qdot_text *script, int column, const qdot_figure_axis *a)
{
    if (a->offset == 0 && a->power == 0) {
        qdot_text_format(script, "%d", column);
        return;
    }
    qdot_text_format(script, "(($%d", column);
    if (a->offset != 0) {
        qdot_text_add(script, "-(");
        qdot_text_double(script, a->offset, EXACT);
        qdot_text_char(script, ')');
    }
    qdot_text_char(script, ')');
    if (a->power != 0)
        qdot_text_format(script, "/1e%d", a->power);
    qdot_text_char(script, ')');
}
