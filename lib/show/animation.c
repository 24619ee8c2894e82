/* animation.c -- a run as a page that plays it: the data as JSON, beside the player. */
#include "show/animation.h"

#include <math.h>
#include <string.h>

/* The player, as lists of bytes that end in 0; the Makefile writes them. */
static const char style[] = {
#include "show/player-css.inc"
};
static const char program[] = {
#include "show/player-js.inc"
};

void
qdot_animation_clear(qdot_animation *a)
{
    for (size_t i = 0; i < a->states.n; i++) {
        qdot_free(a->states.at[i].name);
        qdot_free(a->states.at[i].rate);
    }
    for (size_t i = 0; i < a->facts.n; i++)
        qdot_free(a->facts.at[i].text);
    qdot_free(a->title);
    qdot_free(a->values);
    qdot_free(a->points.at);
    qdot_free(a->particles.at);
    qdot_free(a->links.at);
    qdot_free(a->bodies.at);
    qdot_free(a->states.at);
    qdot_free(a->energies.at);
    qdot_free(a->facts.at);
    *a = (qdot_animation){0};
}

/* --- JSON within a page ------------------------------------------------------------- */

/* A string; < as \u003c, so that no text ends the element that it stands in. */
static void
add_string(qdot_text *out, const char *text)
{
    qdot_text json = {0};
    const char *rest;

    qdot_text_json(&json, text);
    rest = qdot_text_str(&json);
    out->failed = out->failed || json.failed;
    for (size_t n; *rest != '\0'; rest += n) {
        n = strcspn(rest, "<");
        qdot_text_add_n(out, rest, n);
        if (rest[n] == '<') {
            qdot_text_add(out, "\\u003c");
            n++;
        }
    }
    qdot_text_clear(&json);
}

static void
json_add_field(qdot_text *out, const char *name, double x, int digits)
{
    qdot_text_format(out, "\"%s\":", name);
    qdot_text_double(out, isfinite(x) ? x : 0, digits);
    qdot_text_char(out, ',');
}

static void
add_numbers(qdot_text *out, const char *name, const double *at, size_t n)
{
    qdot_text_format(out, ",\"%s\":[", name);
    for (size_t i = 0; i < n; i++) {
        qdot_text_add(out, i > 0 ? "," : "");
        qdot_text_double(out, isfinite(at[i]) ? at[i] : 0, 7);
    }
    qdot_text_char(out, ']');
}

static void
add_indices(qdot_text *out, const char *name, const size_t *at, size_t n)
{
    qdot_text_format(out, ",\"%s\":[", name);
    for (size_t i = 0; i < n; i++)
        qdot_text_format(out, "%s%zu", i > 0 ? "," : "", at[i]);
    qdot_text_char(out, ']');
}

/* --- columns ------------------------------------------------------------------------ */

enum { STEPS = 65534, UNKNOWN = 65535, PORTION = 3 * 1024 };

static void
add_base64(qdot_text *out, const unsigned char *bytes, size_t n)
{
    static const char digit[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    char block[PORTION / 3 * 4];
    size_t used = 0;

    for (size_t i = 0; i < n; i += 3) {
        unsigned long three = (unsigned long)bytes[i] << 16 |
                              (unsigned long)(i + 1 < n ? bytes[i + 1] : 0) << 8 |
                              (unsigned long)(i + 2 < n ? bytes[i + 2] : 0);

        block[used++] = digit[three >> 18];
        block[used++] = digit[three >> 12 & 63];
        block[used++] = i + 1 < n ? digit[three >> 6 & 63] : '=';
        block[used++] = i + 2 < n ? digit[three & 63] : '=';
    }
    qdot_text_add_n(out, block, used);
}

/* [*lo, *hi] of what is finite; false: nothing is. */
static bool
finite_range(const double *x, size_t n, double *lo, double *hi)
{
    bool any = false;

    for (size_t k = 0; k < n; k++) {
        if (!isfinite(x[k]))
            continue;
        *lo = any ? fmin(*lo, x[k]) : x[k];
        *hi = any ? fmax(*hi, x[k]) : x[k];
        any = true;
    }
    return any;
}

/* A number where all are the same to 12 digits, which is more than the state has right. */
static void
add_column(qdot_text *out, const double *x, size_t n)
{
    double lo = 0, hi = 0, step;
    bool any = finite_range(x, n, &lo, &hi);
    unsigned char bytes[PORTION];
    size_t used = 0;

    if (!any || hi - lo <= 1e-12 * fmax(fabs(lo), fabs(hi))) {
        qdot_text_double(out, (lo + hi) / 2, 12);
        return;
    }
    step = hi / STEPS - lo / STEPS;
    qdot_text_add(out, "{\"a\":");
    qdot_text_double(out, lo, 12);
    qdot_text_add(out, ",\"b\":");
    qdot_text_double(out, step, 12);
    qdot_text_add(out, ",\"d\":\"");
    for (size_t k = 0; k < n; k++) {
        double u = isfinite(x[k]) ? fmin(STEPS, round((x[k] - lo) / step)) : UNKNOWN;
        unsigned word = (unsigned)fmax(0, u);

        bytes[used++] = (unsigned char)(word & 255);
        bytes[used++] = (unsigned char)(word >> 8);
        if (used == PORTION) {
            add_base64(out, bytes, used);
            used = 0;
        }
    }
    add_base64(out, bytes, used);
    qdot_text_add(out, "\"}");
}

/* --- what is drawn ------------------------------------------------------------------ */

static void
animation_add_bodies(const qdot_animation *a, qdot_text *out)
{
    for (size_t i = 0; i < a->bodies.n; i++) {
        const qdot_animation_body *b = &a->bodies.at[i];
        bool space = a->dimension == 3;

        qdot_text_add(out, i > 0 ? ",{\"name\":" : "{\"name\":");
        add_string(out, b->name);
        qdot_text_format(out, ",\"point\":%zu,\"shape\":\"%s\"", b->point,
                         space     ? "ellipsoid"
                         : b->disc ? "disc"
                                   : "bar");
        add_indices(out, "axes", b->axes, space ? 6 : 2);
        add_numbers(out, "half", b->half, space ? 3 : b->disc ? 1 : 2);
        if (space)
            add_numbers(out, "principal", b->principal, 9);
        else
            add_numbers(out, "turn", b->turn, 2);
        if (b->n_arms > 0)
            add_indices(out, "arms", b->arms, b->n_arms);
        qdot_text_char(out, '}');
    }
}

static void
add_things(const qdot_animation *a, qdot_text *out)
{
    static const char *const kinds[] = {[QDOT_ANIMATION_ROD] = "rod",
                                        [QDOT_ANIMATION_SPRING] = "spring",
                                        [QDOT_ANIMATION_DAMPER] = "damper"};

    qdot_text_add(out, "\"points\":[");
    for (size_t i = 0; i < a->points.n; i++) {
        const size_t *at = a->points.at[i].at;

        qdot_text_format(out, "%s[%zu,%zu", i > 0 ? "," : "", at[0], at[1]);
        if (a->dimension == 3)
            qdot_text_format(out, ",%zu", at[2]);
        qdot_text_char(out, ']');
    }
    qdot_text_add(out, "],\n\"particles\":[");
    for (size_t i = 0; i < a->particles.n; i++) {
        qdot_text_add(out, i > 0 ? ",{\"name\":" : "{\"name\":");
        add_string(out, a->particles.at[i].name);
        qdot_text_format(out, ",\"point\":%zu,\"size\":", a->particles.at[i].point);
        qdot_text_double(out, a->particles.at[i].size, 3);
        qdot_text_char(out, '}');
    }
    qdot_text_add(out, "],\n\"links\":[");
    for (size_t i = 0; i < a->links.n; i++)
        qdot_text_format(out, "%s{\"kind\":\"%s\",\"from\":%zu,\"to\":%zu}",
                         i > 0 ? "," : "", kinds[a->links.at[i].kind],
                         a->links.at[i].ends[0], a->links.at[i].ends[1]);
    qdot_text_add(out, "],\n\"bodies\":[");
    animation_add_bodies(a, out);
}

static void
add_diagrams(const qdot_animation *a, qdot_text *out)
{
    qdot_text_add(out, "],\n\"states\":[");
    for (size_t i = 0; i < a->states.n; i++) {
        const qdot_animation_state *s = &a->states.at[i];

        qdot_text_add(out, i > 0 ? ",{\"name\":" : "{\"name\":");
        add_string(out, s->name);
        qdot_text_add(out, ",\"rate\":");
        add_string(out, s->rate);
        qdot_text_format(out, ",\"q\":%zu,\"v\":%zu}", s->q, s->v);
    }
    qdot_text_add(out, "],\n\"energies\":[");
    for (size_t i = 0; i < a->energies.n; i++) {
        qdot_text_add(out, i > 0 ? ",{\"name\":" : "{\"name\":");
        add_string(out, a->energies.at[i].name);
        qdot_text_format(out, ",\"channel\":%zu}", a->energies.at[i].column);
    }
    qdot_text_add(out, "],\n\"facts\":[");
    for (size_t i = 0; i < a->facts.n; i++) {
        qdot_text_add(out, i > 0 ? ",[" : "[");
        add_string(out, a->facts.at[i].name);
        qdot_text_char(out, ',');
        add_string(out, a->facts.at[i].text);
        qdot_text_char(out, ']');
    }
    qdot_text_char(out, ']');
}

/* --- the page ----------------------------------------------------------------------- */

void
qdot_animation_escape(qdot_text *out, const char *text)
{
    qdot_text_html(out, text, strlen(text), true);
}

void
qdot_animation_head(qdot_text *out)
{
    qdot_text_add(out, "<style>\n");
    qdot_text_add(out, style);
    qdot_text_add(out, "</style>\n");
}

void
qdot_animation_section(const qdot_animation *a, qdot_text *out)
{
    qdot_text_add(
        out, "<section class=\"animation\">\n"
             "<noscript>A moving picture, drawn by JavaScript, stands here.</noscript>\n"
             "<script type=\"application/json\">\n{");
    if (a->title != NULL) {
        qdot_text_add(out, "\"title\":");
        add_string(out, a->title);
        qdot_text_add(out, ",\n");
    }
    qdot_text_format(out, "\"dimension\":%u,", a->dimension);
    json_add_field(out, "t0", a->t0, 15);
    json_add_field(out, "t1", a->t1, 15);
    json_add_field(out, "speed", a->speed, 6);
    json_add_field(out, "trail", a->trail, 6);
    qdot_text_format(out, "\"frames\":%zu", a->frames);
    add_numbers(out, "up", a->up, 3);
    qdot_text_add(out, ",\n");
    add_things(a, out);
    add_diagrams(a, out);
    qdot_text_add(out, ",\n\"channels\":[\n");
    for (size_t i = 0; i < a->columns; i++) {
        qdot_text_add(out, i > 0 ? ",\n" : "");
        add_column(out, a->values + i * a->frames, a->frames);
    }
    qdot_text_add(out, "]}\n</script>\n</section>\n");
}

void
qdot_animation_foot(qdot_text *out)
{
    qdot_text_add(out, "<script>\n");
    qdot_text_add(out, program);
    qdot_text_add(out, "</script>\n");
}

qdot_status
qdot_animation_page(const qdot_animation *a, qdot_text *out)
{
    qdot_text_add(
        out, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
             "<meta name=\"viewport\" content=\"width=device-width\">\n"
             "<meta name=\"color-scheme\" content=\"light dark\">\n<title>");
    qdot_animation_escape(out, a->title != NULL ? a->title : "qdot");
    qdot_text_add(out, "</title>\n"
                       "<style>body{margin:0;background:#fff}"
                       "@media (prefers-color-scheme:dark){body{background:#15181c}}"
                       "@media print{body{background:#fff}}</style>\n");
    qdot_animation_head(out);
    qdot_text_add(out, "</head>\n<body>\n");
    qdot_animation_section(a, out);
    qdot_animation_foot(out);
    qdot_text_add(out, "</body>\n</html>\n");
    return qdot_text_status(out);
}
