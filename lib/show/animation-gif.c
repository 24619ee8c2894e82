/* animation-gif.c -- writes a run as an animated GIF, drawn frame by frame by gnuplot. */
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/process.h"
#include "base/sink.h"
#include "show/animation.h"
#include "show/gnuplot.h"

enum { MOST_PICTURES = 400, A_SECOND = 25, PIXELS = 560, TRAIL_POINTS = 240 };

/* The view of a scene: its projection, and the visible part of the plane. */
typedef struct {
    const qdot_animation *a;
    double right[3], up[3];
    double lo[2], hi[2];
    double size; /* size of the scene, by which the width of springs is chosen */
} view;

typedef struct {
    double x, y;
} place;

/* --- from the scene to the plane ---------------------------------------------------- */

static void
cross_product(const double u[3], const double v[3], double w[3])
{
    for (int d = 0; d < 3; d++)
        w[d] = u[(d + 1) % 3] * v[(d + 2) % 3] - u[(d + 2) % 3] * v[(d + 1) % 3];
}

/* Set the initial view of the player: from the side and a little from above. */
static void
set_initial_view(view *w)
{
    const double yaw = -0.6, pitch = 0.32, *u = w->a->up;
    double e1[3] = {0}, e2[3], size;
    int k = 0;

    for (int d = 0; d < 3; d++)
        k = fabs(u[d]) < fabs(u[k]) - 1e-9 ? d : k;
    for (int d = 0; d < 3; d++)
        e1[d] = (d == k) - u[k] * u[d];
    size = sqrt(e1[0] * e1[0] + e1[1] * e1[1] + e1[2] * e1[2]);
    for (int d = 0; d < 3; d++)
        e1[d] /= size;
    cross_product(u, e1, e2);
    for (int d = 0; d < 3; d++) {
        w->right[d] = cos(yaw) * e1[d] + sin(yaw) * e2[d];
        w->up[d] = cos(pitch) * u[d] - sin(pitch) * (sin(yaw) * e1[d] - cos(yaw) * e2[d]);
    }
}

static place
project_point(const view *w, const double r[3])
{
    place p = {0, 0};

    if (w->a->dimension < 3)
        return (place){r[0], r[1]};
    for (int d = 0; d < 3; d++) {
        p.x += r[d] * w->right[d];
        p.y += r[d] * w->up[d];
    }
    return p;
}

static void
point_position(const qdot_animation *a, size_t point, size_t frame, double r[3])
{
    for (unsigned d = 0; d < 3; d++)
        r[d] = d < a->dimension ? a->values[a->points.at[point].at[d] * a->frames + frame]
                                : 0;
}

static place
place_in_view(const view *w, size_t point, size_t frame)
{
    double r[3];

    point_position(w->a, point, frame, r);
    return project_point(w, r);
}

static void
extend_view(view *w, place p, double more)
{
    if (!isfinite(p.x) || !isfinite(p.y))
        return;
    w->lo[0] = fmin(w->lo[0], p.x - more);
    w->hi[0] = fmax(w->hi[0], p.x + more);
    w->lo[1] = fmin(w->lo[1], p.y - more);
    w->hi[1] = fmax(w->hi[1], p.y + more);
}

/* Find a view that contains all points of all frames, with a margin. */
static qdot_status
fit_view(view *w)
{
    const qdot_animation *a = w->a;
    double width, height;

    w->lo[0] = w->lo[1] = INFINITY;
    w->hi[0] = w->hi[1] = -INFINITY;
    for (size_t i = 0; i < a->points.n; i++)
        for (size_t k = 0; k < a->frames; k++)
            extend_view(w, place_in_view(w, i, k), 0);
    for (size_t i = 0; i < a->bodies.n; i++)
        for (size_t k = 0; k < a->frames; k++) {
            const double *h = a->bodies.at[i].half;

            extend_view(w, place_in_view(w, a->bodies.at[i].point, k),
                        sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]));
        }
    if (!(w->hi[0] >= w->lo[0]))
        return qdot_fail(QDOT_EDOMAIN, "no place of the picture is finite");
    width = w->hi[0] - w->lo[0];
    height = w->hi[1] - w->lo[1];
    w->size = fmax(width, height);
    w->size = w->size > 0 ? w->size : 1;
    extend_view(w, (place){w->lo[0], w->lo[1]},
                0.07 * w->size + fmax(0, 0.15 * w->size - width / 2));
    extend_view(w, (place){w->hi[0], w->hi[1]},
                0.07 * w->size + fmax(0, 0.15 * w->size - height / 2));
    return QDOT_OK;
}

/* --- lines of a frame --------------------------------------------------------------- */

static void
add_place(qdot_text *out, place p)
{
    if (isfinite(p.x) && isfinite(p.y)) {
        qdot_text_double(out, p.x, 6);
        qdot_text_char(out, ' ');
        qdot_text_double(out, p.y, 6);
    }
    qdot_text_char(out, '\n');
}

/* The point at the fraction `along` of the way from a to b, shifted sideways by the distance `aside`. */
static place
point_beside(place a, place b, double along, double aside)
{
    double dx = b.x - a.x, dy = b.y - a.y, length = hypot(dx, dy);

    if (!(length > 0))
        return a;
    return (place){a.x + dx * along - dy / length * aside,
                   a.y + dy * along + dx / length * aside};
}

static void
add_spring(const view *w, place a, place b, double aside, qdot_text *out)
{
    const double size = 0.017 * w->size;

    add_place(out, a);
    add_place(out, point_beside(a, b, 0, aside));
    for (int k = 0; k <= 9 * 12; k++) {
        double part = k / (9.0 * 12), fade = fmin(1, 12 * fmin(part, 1 - part));

        add_place(out, point_beside(a, b, 0.12 + 0.76 * part,
                                    aside + fade * size * sin(2 * M_PI * k / 12)));
    }
    add_place(out, point_beside(a, b, 1, aside));
    add_place(out, b);
    qdot_text_char(out, '\n');
}

static void
add_damper(const view *w, place a, place b, double aside, qdot_text *out)
{
    const double s = 0.017 * w->size;
    const double lines[][2] = {{0, 0},
                               {0, aside},
                               {0.26, aside},
                               {NAN, 0},
                               {0.74, aside + s},
                               {0.26, aside + s},
                               {0.26, aside - s},
                               {0.74, aside - s},
                               {NAN, 0},
                               {0.5, aside + 0.7 * s},
                               {0.5, aside - 0.7 * s},
                               {NAN, 0},
                               {0.5, aside},
                               {1, aside},
                               {1, 0},
                               {NAN, 0}};

    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
        if (isnan(lines[i][0]))
            qdot_text_char(out, '\n');
        else
            add_place(out, point_beside(a, b, lines[i][0], lines[i][1]));
}

static bool
have_same_ends(const qdot_animation_link *a, const qdot_animation_link *b)
{
    return (a->ends[0] == b->ends[0] && a->ends[1] == b->ends[1]) ||
           (a->ends[0] == b->ends[1] && a->ends[1] == b->ends[0]);
}

/* Draw springs, dampers or rods (one kind); springs and dampers between the same two points stand side by side. */
static void
draw_links(const view *w, qdot_animation_kind kind, size_t frame, qdot_text *out)
{
    const qdot_animation *a = w->a;

    for (size_t i = 0; i < a->links.n; i++) {
        const qdot_animation_link *link = &a->links.at[i];
        place from, to;
        double before = 0, all = 0;

        if (link->kind != kind)
            continue;
        for (size_t j = 0; j < a->links.n && kind != QDOT_ANIMATION_ROD; j++)
            if (a->links.at[j].kind != QDOT_ANIMATION_ROD &&
                have_same_ends(link, &a->links.at[j])) {
                all++;
                before += j < i;
            }
        from = place_in_view(w, link->ends[link->ends[0] > link->ends[1]], frame);
        to = place_in_view(w, link->ends[link->ends[0] <= link->ends[1]], frame);
        before = all > 0 ? (before - (all - 1) / 2) * 0.055 * w->size : 0;
        if (kind == QDOT_ANIMATION_SPRING) {
            add_spring(w, from, to, before, out);
        } else if (kind == QDOT_ANIMATION_DAMPER) {
            add_damper(w, from, to, before, out);
        } else {
            add_place(out, from);
            add_place(out, to);
            qdot_text_char(out, '\n');
        }
    }
}

/* Draw the closed line c + u cos(phi) + v sin(phi) for a full turn of phi. */
static void
draw_ellipse(const view *w, const double c[3], const double u[3], const double v[3],
             qdot_text *out)
{
    for (int k = 0; k <= 40; k++) {
        double r[3], at = 2 * M_PI * k / 40;

        for (int d = 0; d < 3; d++)
            r[d] = c[d] + cos(at) * u[d] + sin(at) * v[d];
        add_place(out, project_point(w, r));
    }
    qdot_text_char(out, '\n');
}

static void
draw_rectangle(const view *w, const qdot_animation_body *b, const double r[3],
               const double c[2], qdot_text *out)
{
    const double x[3] = {c[0] * b->half[0], c[1] * b->half[0], 0};
    const double y[3] = {-c[1] * b->half[0], c[0] * b->half[0], 0};

    if (b->disc) {
        draw_ellipse(w, r, x, y, out);
        add_place(out, (place){r[0], r[1]});
        add_place(out, (place){r[0] + x[0], r[1] + x[1]});
    } else {
        const double along[2] = {c[0] * b->turn[0] - c[1] * b->turn[1],
                                 c[1] * b->turn[0] + c[0] * b->turn[1]};

        for (int k = 0; k <= 4; k++) {
            double s = k % 4 < 2 ? b->half[0] : -b->half[0];
            double h = (k + 1) % 4 < 2 ? b->half[1] : -b->half[1];

            add_place(out, (place){r[0] + s * along[0] - h * along[1],
                                   r[1] + s * along[1] + h * along[0]});
        }
    }
    qdot_text_char(out, '\n');
}

static void
draw_bodies(const view *w, size_t frame, qdot_text *out)
{
    const qdot_animation *a = w->a;

    for (size_t i = 0; i < a->bodies.n; i++) {
        const qdot_animation_body *b = &a->bodies.at[i];
        double r[3], m[6] = {0}, own[3][3], axis[3][3];

        point_position(a, b->point, frame, r);
        for (unsigned k = 0; k < (a->dimension == 3 ? 6 : 2); k++)
            m[k] = a->values[b->axes[k] * a->frames + frame];
        for (size_t k = 0; k < b->n_arms; k++) {
            add_place(out, project_point(w, r));
            add_place(out, place_in_view(w, b->arms[k], frame));
            qdot_text_char(out, '\n');
        }
        if (a->dimension < 3) {
            draw_rectangle(w, b, r, m, out);
            continue;
        }
        memcpy(own, m, sizeof m);
        cross_product(own[0], own[1], own[2]);
        for (int k = 0; k < 3; k++)
            for (int d = 0; d < 3; d++)
                axis[k][d] = b->half[k] * (b->principal[3 * k] * own[0][d] +
                                           b->principal[3 * k + 1] * own[1][d] +
                                           b->principal[3 * k + 2] * own[2][d]);
        for (int k = 0; k < 3; k++)
            draw_ellipse(w, r, axis[k], axis[(k + 1) % 3], out);
    }
}

static void
draw_trail(const view *w, size_t point, size_t frame, qdot_text *out)
{
    const qdot_animation *a = w->a;
    double back = a->trail / fabs(a->t1 - a->t0) * (double)(a->frames - 1);
    size_t from = back >= (double)frame ? 0 : frame - (size_t)back;
    size_t step = (frame - from) / TRAIL_POINTS + 1;

    for (size_t k = from; k < frame; k += step)
        add_place(out, place_in_view(w, point, k));
    add_place(out, place_in_view(w, point, frame));
    qdot_text_char(out, '\n');
}

static void
draw_points(const view *w, size_t frame, qdot_text *out)
{
    for (size_t i = 0; i < w->a->particles.n; i++) {
        place p = place_in_view(w, w->a->particles.at[i].point, frame);

        if (!isfinite(p.x) || !isfinite(p.y))
            continue;
        qdot_text_double(out, p.x, 6);
        qdot_text_char(out, ' ');
        qdot_text_double(out, p.y, 6);
        qdot_text_char(out, ' ');
        qdot_text_double(out, 2.2 * w->a->particles.at[i].size, 3);
        qdot_text_char(out, '\n');
    }
}

/* --- the script for gnuplot --------------------------------------------------------- */

/* The styles in which gnuplot draws the layers of a frame, one after the other. */
static const char *const layers[] = {
    "using 1:2 with lines linecolor rgb '#9cc4e4' linewidth 1.2",
    "using 1:2 with lines linecolor rgb '#4a525b' linewidth 3",
    "using 1:2 with lines linecolor rgb '#009e73' linewidth 1.6",
    "using 1:2 with lines linecolor rgb '#cc79a7' linewidth 1.8",
    "using 1:2 with lines linecolor rgb '#0072b2' linewidth 1.8",
    "using 1:2:3 with points pointtype 7 pointsize variable linecolor rgb '#d55e00'",
};
enum { LAYERS = sizeof layers / sizeof *layers };

static void
add_layer_of_frame(const view *w, int layer, size_t frame, qdot_text *out)
{
    const qdot_animation *a = w->a;

    switch (layer) {
    case 0:
        for (size_t i = 0; i < a->particles.n; i++)
            draw_trail(w, a->particles.at[i].point, frame, out);
        for (size_t i = 0; i < a->bodies.n; i++)
            draw_trail(w, a->bodies.at[i].point, frame, out);
        break;
    case 1: draw_links(w, QDOT_ANIMATION_ROD, frame, out); break;
    case 2: draw_links(w, QDOT_ANIMATION_SPRING, frame, out); break;
    case 3: draw_links(w, QDOT_ANIMATION_DAMPER, frame, out); break;
    case 4: draw_bodies(w, frame, out); break;
    default: draw_points(w, frame, out);
    }
}

static void
add_frame(const view *w, size_t frame, qdot_text *script)
{
    const qdot_animation *a = w->a;
    bool first = true;

    for (int i = 0; i < LAYERS; i++) {
        size_t before;

        qdot_text_format(script, "$l%d << END\n", i);
        before = script->n;
        add_layer_of_frame(w, i, frame, script);
        if (script->n == before)
            qdot_text_add(script, "NaN NaN NaN\n");
        qdot_text_add(script, "END\n");
    }
    qdot_text_add(script, "set label 1 't = ");
    qdot_text_double(
        script, a->t0 + (a->t1 - a->t0) * (double)frame / (double)(a->frames - 1), 4);
    qdot_text_add(script, "' at graph 0.03, graph 0.96\nplot ");
    for (int i = 0; i < LAYERS; i++) {
        qdot_text_format(script, "%s$l%d %s notitle", first ? "" : ", ", i, layers[i]);
        first = false;
    }
    qdot_text_char(script, '\n');
}

static void
add_axis_range(qdot_text *script, char axis, double lo, double hi)
{
    qdot_text_format(script, "set %crange [", axis);
    qdot_text_double(script, lo, 8);
    qdot_text_char(script, ':');
    qdot_text_double(script, hi, 8);
    qdot_text_add(script, "]\n");
}

static void
add_settings(const view *w, double delay, qdot_text *script)
{
    double width = w->hi[0] - w->lo[0], height = w->hi[1] - w->lo[1];
    int x = (int)(PIXELS * fmin(1, width / height)),
        y = (int)(PIXELS * fmin(1, height / width));

    qdot_text_format(
        script,
        "if (strstrt(GPVAL_TERMINALS, 'gif') == 0) {\n"
        "exit error 'this gnuplot cannot write GIF files'\n"
        "}\n"
        "set terminal gif animate delay %d loop 0 size %d,%d background '#ffffff'\n"
        "set encoding utf8\nset datafile missing 'NaN'\nunset border\nunset tics\n"
        "unset key\nset size ratio -1\nset margins 0,0,0,0\n",
        (int)fmax(2, round(delay)), x < 200 ? 200 : x, y < 200 ? 200 : y);
    add_axis_range(script, 'x', w->lo[0], w->hi[0]);
    add_axis_range(script, 'y', w->lo[1], w->hi[1]);
}

qdot_status
qdot_animation_gif(const qdot_animation *a, const char *path)
{
    const double seconds = fabs(a->t1 - a->t0) / a->speed;
    const double pictures = fmax(
        2, fmin(fmin(MOST_PICTURES, (double)a->frames), ceil(seconds * A_SECOND) + 1));
    qdot_text script = {0}, image = {0};
    view w = {.a = a};
    qdot_status status;

    if (qdot_rank() > 0)
        return QDOT_OK;
    set_initial_view(&w);
    QDOT_TRY(fit_view(&w));
    add_settings(&w, 100 * seconds / (pictures - 1), &script);
    status = QDOT_OK;
    for (size_t k = 0; k < (size_t)pictures && status == QDOT_OK; k++) {
        add_frame(&w,
                  (size_t)round((double)(a->frames - 1) * (double)k / (pictures - 1)),
                  &script);
        status = qdot_interrupt_check();
    }
    if (status == QDOT_OK)
        status = qdot_gnuplot_run(&script, ";", &image);
    if (status == QDOT_OK)
        status = qdot_sink_write(path, image.at, image.n);
    qdot_text_clear(&script);
    qdot_text_clear(&image);
    return status;
}
