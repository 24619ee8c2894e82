/* page.c -- answers as parts of a page: headings, formulas, curves. */
#include "show/page.h"
#include "show/scripts.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

#include "show/animation.h"

static const char style[] = {
#include "show/page-css.inc"
};

void
qdot_page_begin(qdot_text *out, const char *title)
{
    qdot_text_add(
        out, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
             "<meta name=\"viewport\" content=\"width=device-width\">\n"
             "<meta name=\"color-scheme\" content=\"light dark\">\n<title>");
    qdot_animation_escape(out, title);
    qdot_text_add(out, "</title>\n<style>\n");
    qdot_text_add(out, style);
    qdot_text_add(out, "</style>\n");
    qdot_animation_head(out);
    qdot_text_add(out, "</head>\n<body>\n<main>\n<h1>");
    qdot_animation_escape(out, title);
    qdot_text_add(out, "</h1>\n");
}

void
qdot_page_end(qdot_text *out)
{
    qdot_text_add(out, "</main>\n");
    qdot_animation_foot(out);
    qdot_text_add(out, "</body>\n</html>\n");
}

/* --- formulas ----------------------------------------------------------------------- */

static void
escape_n(qdot_text *out, const char *text, size_t n)
{
    char one[2] = {0};

    for (size_t i = 0; i < n; i++) {
        one[0] = text[i];
        qdot_animation_escape(out, one);
    }
}

static bool
begins(const char *text, const char *with)
{
    return strncmp(text, with, strlen(with)) == 0;
}

/* The operator before which a formula may be divided; its length, 0: none. */
static size_t
divides(const char *at)
{
    static const char *const operators[] = {"<mo>=</mo>", "<mo>+</mo>",
                                            "<mo>\u2212</mo>"};

    for (size_t i = 0; i < sizeof operators / sizeof *operators; i++)
        if (begins(at, operators[i]))
            return strlen(operators[i]);
    return 0;
}

/* What stands between <math ...> and </math>, [n]. */
static void
add_formula(qdot_text *out, const char *at, size_t n)
{
    qdot_text formula = {0};
    const char *end;
    bool operand = false; /* something stands before that an operator may follow */
    int depth = 0;

    qdot_page_add_mathml(&formula, at, n);
    at = qdot_text_str(&formula);
    end = at + formula.n;
    qdot_text_add(out, "<math>");
    while (at < end) {
        const char *close = memchr(at, '>', (size_t)(end - at));
        size_t mark = depth == 0 && operand ? divides(at) : 0;

        if (mark > 0) {
            qdot_text_add(out, "</math> <math><mo form=\"infix\">");
            qdot_text_add_n(out, at + 4, mark - 4);
            at += mark;
            operand = false;
            continue;
        }
        if (*at != '<' || close == NULL) {
            qdot_text_char(out, *at++);
            continue;
        }
        depth += at[1] == '/' ? -1 : close[-1] == '/' ? 0 : 1;
        qdot_text_add_n(out, at, (size_t)(close + 1 - at));
        operand = operand || depth == 0;
        at = close + 1;
    }
    qdot_text_add(out, "</math>");
    out->failed = out->failed || formula.failed;
    qdot_text_clear(&formula);
}

/* A text in which MathML may stand. */
static void
add_mixed(qdot_text *out, const char *at, const char *end)
{
    static const char close[] = "</math>";

    while (at < end) {
        const char *open = strstr(at, "<math"), *inside, *behind;

        if (open == NULL || open >= end) {
            escape_n(out, at, (size_t)(end - at));
            return;
        }
        escape_n(out, at, (size_t)(open - at));
        inside = memchr(open, '>', (size_t)(end - open));
        behind = inside != NULL ? strstr(inside, close) : NULL;
        if (behind == NULL || behind >= end) {
            escape_n(out, open, (size_t)(end - open));
            return;
        }
        add_formula(out, inside + 1, (size_t)(behind - inside - 1));
        at = behind + sizeof close - 1;
    }
}

/* `12. Title` */
static bool
is_heading(const char *at, const char *end)
{
    const char *c = at;

    while (c < end && isdigit((unsigned char)*c))
        c++;
    return c > at && end - c > 2 && c[0] == '.' && c[1] == ' ';
}

void
qdot_page_lines(qdot_text *out, const char *lines)
{
    while (*lines != '\0') {
        const char *end = strchr(lines, '\n'), *at = lines, *tag;
        bool set_in = *lines == ' ';

        if (end == NULL)
            end = lines + strlen(lines);
        lines = *end == '\n' ? end + 1 : end;
        while (at < end && *at == ' ')
            at++;
        if (at == end)
            continue;
        tag = is_heading(at, end)    ? "h3>"
              : set_in || *at == '<' ? "p class=\"formula\">"
                                     : "p>";
        qdot_text_char(out, '<');
        qdot_text_add(out, tag);
        add_mixed(out, at, end);
        qdot_text_add(out, tag[0] == 'h' ? "</h3>\n" : "</p>\n");
    }
}

void
qdot_page_verbatim(qdot_text *out, const char *text)
{
    qdot_text_add(out, "<pre>");
    qdot_animation_escape(out, text);
    qdot_text_add(out, "</pre>\n");
}

/* --- curves ------------------------------------------------------------------------- */

enum {
    WIDE = 640,
    HIGH = 170,
    LEFT = 64,
    RIGHT = 12,
    TOP = 10,
    BOTTOM = 26,
    POINTS = 1500
};

/* 1, 2 or 5 times a power of ten: at most `most` steps in the span. */
static double
nice_step(double span, double most)
{
    double ten = pow(10, floor(log10(span / most)));

    for (int i = 0; i < 3; i++) {
        static const double times[] = {1, 2, 5};

        if (span / (times[i] * ten) <= most)
            return times[i] * ten;
    }
    return 10 * ten;
}

typedef struct {
    double t0, t1, lo, hi;
} frame;

static double
across(const frame *f, double t)
{
    return LEFT + (t - f->t0) / (f->t1 - f->t0) * (WIDE - LEFT - RIGHT);
}

static double
down(const frame *f, double y)
{
    return HIGH - BOTTOM - (y - f->lo) / (f->hi - f->lo) * (HIGH - TOP - BOTTOM);
}

static void
add_number(qdot_text *out, double x, double step)
{
    qdot_text_double(out, fabs(x) < 1e-6 * step ? 0 : x, 6);
}

static void
add_axes(qdot_text *out, const frame *f)
{
    const double t_lo = fmin(f->t0, f->t1), t_hi = fmax(f->t0, f->t1);
    const double dt = nice_step(t_hi - t_lo, 8), dy = nice_step(f->hi - f->lo, 4);

    for (double k = ceil(t_lo / dt - 1e-9); k * dt <= t_hi + 1e-9 * dt; k++) {
        qdot_text_format(
            out,
            "<path class=\"grid\" d=\"M%.1f %d V%d\"/><text x=\"%.1f\" y=\"%d\" "
            "text-anchor=\"middle\">",
            across(f, k * dt), TOP, HIGH - BOTTOM, across(f, k * dt), HIGH - 9);
        add_number(out, k * dt, dt);
        qdot_text_add(out, "</text>");
    }
    for (double k = ceil(f->lo / dy - 1e-9); k * dy <= f->hi + 1e-9 * dy; k++) {
        qdot_text_format(
            out,
            "<path class=\"grid\" d=\"M%d %.1f H%d\"/><text x=\"%d\" y=\"%.1f\" "
            "text-anchor=\"end\">",
            LEFT, down(f, k * dy), WIDE - RIGHT, LEFT - 6, down(f, k * dy) + 4);
        add_number(out, k * dy, dy);
        qdot_text_add(out, "</text>");
    }
}

void
qdot_page_curve(qdot_text *out, const char *name, double t0, double t1, const double *y,
                size_t n)
{
    frame f = {t0, t1, INFINITY, -INFINITY};
    size_t step = n / POINTS + 1;
    bool open = false;
    double margin;

    for (size_t k = 0; k < n; k++) {
        if (!isfinite(y[k]))
            continue;
        f.lo = fmin(f.lo, y[k]);
        f.hi = fmax(f.hi, y[k]);
    }
    if (!(f.lo <= f.hi) || t0 == t1)
        return;
    margin = f.hi - f.lo > 1e-12 * fmax(fabs(f.lo), fabs(f.hi)) ? 0.05 * (f.hi - f.lo)
             : f.hi != 0                                        ? 0.1 * fabs(f.hi)
                                                                : 1;
    f.lo -= margin;
    f.hi += margin;
    qdot_text_format(out,
                     "<figure>\n<svg viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"",
                     WIDE, HIGH);
    qdot_animation_escape(out, name);
    qdot_text_add(out, " against t\">");
    add_axes(out, &f);
    qdot_text_add(out, "<path class=\"curve\" d=\"");
    for (size_t k = 0; k < n; k = k + step < n || k + 1 == n ? k + step : n - 1) {
        double t = t0 + (t1 - t0) * (double)k / (double)(n - 1);

        if (isfinite(y[k]))
            qdot_text_format(out, "%s%.1f %.1f", open ? "L" : "M", across(&f, t),
                             down(&f, y[k]));
        open = isfinite(y[k]);
    }
    qdot_text_add(out, "\"/></svg>\n<figcaption>");
    qdot_animation_escape(out, name);
    qdot_text_add(out, " against t</figcaption>\n</figure>\n");
}

/* --- error against time ------------------------------------------------------------- */

enum { TALL = 330, COLOURS = 8 };

/* Of what is above 0: powers of ten around the range; false: nothing is. */
static bool
decades(const qdot_page_points *list, size_t n, bool of_y, double *lo, double *hi)
{
    *lo = INFINITY;
    *hi = -INFINITY;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < list[i].n; k++) {
            double x = list[i].x[k], y = list[i].y[k];

            if (!(x > 0 && y > 0 && isfinite(x) && isfinite(y)))
                continue;
            *lo = fmin(*lo, floor(log10(of_y ? y : x)));
            *hi = fmax(*hi, ceil(log10(of_y ? y : x)));
        }
    if (*lo == *hi)
        (*hi)++;
    return *lo < *hi;
}

static void
add_decades(qdot_text *out, const frame *f)
{
    const double dx = ceil((f->t1 - f->t0) / 7), dy = ceil((f->hi - f->lo) / 8);

    for (double k = f->t0; k <= f->t1; k += dx)
        qdot_text_format(
            out,
            "<path class=\"grid\" d=\"M%.1f %d V%d\"/><text x=\"%.1f\" y=\"%d\" "
            "text-anchor=\"middle\">1e%.0f</text>",
            across(f, k), TOP, TALL - 2 * BOTTOM, across(f, k), TALL - 2 * BOTTOM + 17,
            k);
    for (double k = f->lo; k <= f->hi; k += dy) {
        double y =
            TALL - 2 * BOTTOM - (k - f->lo) / (f->hi - f->lo) * (TALL - TOP - 2 * BOTTOM);

        qdot_text_format(
            out,
            "<path class=\"grid\" d=\"M%d %.1f H%d\"/><text x=\"%d\" y=\"%.1f\" "
            "text-anchor=\"end\">1e%.0f</text>",
            LEFT, y, WIDE - RIGHT, LEFT - 6, y + 4, k);
    }
}

static void
add_log_curve(qdot_text *out, const frame *f, const qdot_page_points *p, size_t i,
              size_t n)
{
    const size_t key = LEFT + i * (WIDE - LEFT - RIGHT) / n;
    bool open = false;

    qdot_text_format(out, "<g class=\"k%zu\"><path class=\"marked\" d=\"", i % COLOURS);
    for (int pass = 0; pass < 2; pass++) {
        for (size_t k = 0; k < p->n; k++) {
            double x, y;

            if (!(p->x[k] > 0 && p->y[k] > 0 && isfinite(p->x[k]) && isfinite(p->y[k])))
                continue;
            x = across(f, log10(p->x[k]));
            y = TALL - 2 * BOTTOM -
                (log10(p->y[k]) - f->lo) / (f->hi - f->lo) * (TALL - TOP - 2 * BOTTOM);
            if (pass == 0)
                qdot_text_format(out, "%s%.1f %.1f", open ? "L" : "M", x, y);
            else
                qdot_text_format(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\"/>", x, y);
            open = true;
        }
        qdot_text_add(out, pass == 0 ? "\"/>" : "");
    }
    qdot_text_format(out,
                     "<circle cx=\"%zu\" cy=\"%d\" r=\"3\"/><text x=\"%zu\" y=\"%d\">",
                     key, TALL - 8, key + 8, TALL - 4);
    qdot_animation_escape(out, p->label);
    qdot_text_add(out, "</text></g>\n");
}

void
qdot_page_log_log(qdot_text *out, const char *caption, size_t n,
                  const qdot_page_points *list)
{
    frame f;

    if (!decades(list, n, false, &f.t0, &f.t1) || !decades(list, n, true, &f.lo, &f.hi))
        return;
    qdot_text_format(out,
                     "<figure>\n<svg viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"",
                     WIDE, TALL);
    qdot_animation_escape(out, caption);
    qdot_text_add(out, "\">");
    add_decades(out, &f);
    for (size_t i = 0; i < n; i++)
        add_log_curve(out, &f, &list[i], i, n);
    qdot_text_add(out, "</svg>\n<figcaption>");
    qdot_animation_escape(out, caption);
    qdot_text_add(out, "</figcaption>\n</figure>\n");
}
