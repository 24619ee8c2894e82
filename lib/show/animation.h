/* animation.h -- a run as a moving picture: its data, and the page that shows them.
 *
 * Knows columns of numbers at equal times and what is drawn with them, not scenes. A column may
 * hold the same number everywhere. NaN: unknown there, nothing is drawn.
 *
 * The page is one file: the data as JSON, the style (lib/show/player.css) and the program that
 * draws them (lib/show/player.js). A column becomes 16-bit numbers a + b u, u = 0 .. 65534
 * (65535: unknown), in base64: 1/65534 of its range, less than a screen or printer shows.
 *
 * Tests  tests/show/test_animation.c, tests/script/figures/animate.sh
 */
#ifndef QDOT_SHOW_ANIMATION_H
#define QDOT_SHOW_ANIMATION_H

#include "base/memory.h"
#include "base/text.h"

enum { QDOT_ANIMATION_ARMS = 8 };

typedef struct {
    size_t at[3]; /* indices of the columns that hold x, y and, in space, z of a point */
} qdot_animation_point;

typedef struct {
    const char *name;
    size_t point;
    double size; /* diameter of the dot that shows a particle; 1 for the heaviest particle */
} qdot_animation_particle;

typedef enum {
    QDOT_ANIMATION_ROD,
    QDOT_ANIMATION_SPRING,
    QDOT_ANIMATION_DAMPER
} qdot_animation_kind;

typedef struct {
    qdot_animation_kind kind;
    size_t ends[2]; /* indices of the points at both ends */
} qdot_animation_link;

/* The solid of uniform density with its mass and moments: in the plane a disc or, where something
 * is fastened to it, a rectangle with its length that way; in space an ellipsoid. */
typedef struct {
    const char *name;
    size_t point; /* index of the point at the centre of the body */
    size_t axes
        [6];   /* columns of the rotation's first column (plane) or first two columns (space) */
    bool disc; /* in the plane: the body is drawn as a disc of radius half[0] */
    double half[3];      /* half the side lengths; in space half axes of the ellipsoid */
    double turn[2];      /* rectangle: direction of its long side in the body frame */
    double principal[9]; /* in space: unit vectors of the principal axes in the body frame */
    size_t arms[QDOT_ANIMATION_ARMS]; /* indices of points to which an arm from the centre is drawn */
    size_t n_arms;
} qdot_animation_body;

typedef struct {
    char *name, *rate; /* names of the coordinate and of its velocity, with their units; owned */
    size_t q, v;       /* indices of the columns of the coordinate and of its velocity */
} qdot_animation_state;

typedef struct {
    const char *name;
    size_t column;
} qdot_animation_energy;

typedef struct {
    const char *name;
    char *text; /* text of a fact that is shown below the picture; owned */
} qdot_animation_fact;

typedef struct {
    char *title;        /* title of the page, owned; NULL: none */
    char *time, *energy; /* units of t and of the energies, owned; NULL: none */
    unsigned dimension; /* dimension of space, 2 or 3 */
    double up[3];       /* the direction in space that is upward in the picture, a unit vector */
    double t0, t1;      /* times of the first and last frame */
    size_t frames;      /* number of frames, at least 2 */
    double speed;       /* units of t shown in one second */
    double trail;       /* length of the trails in units of t */
    size_t columns;
    double *values; /* [columns x frames] values, column by column; owned */
    qdot_vec(qdot_animation_point) points;
    qdot_vec(qdot_animation_particle) particles;
    qdot_vec(qdot_animation_link) links;
    qdot_vec(qdot_animation_body) bodies;
    qdot_vec(qdot_animation_state) states;    /* coordinates with a phase portrait */
    qdot_vec(qdot_animation_energy) energies; /* energies, drawn against t */
    qdot_vec(qdot_animation_fact) facts;      /* facts printed below the picture */
} qdot_animation;

void qdot_animation_clear(qdot_animation *a);

/* Append the whole web page to `out`. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_animation_page(const qdot_animation *a, qdot_text *out);

/* As an animated GIF through gnuplot: at most 400 pictures, 25 a second where that is enough; a scene
 * in space as the page shows it first. Errors: QDOT_EIO: gnuplot is missing, cannot write GIF files or fails;
 * QDOT_EDOMAIN: no place is finite. */
QDOT_MUST_CHECK qdot_status qdot_animation_gif(const qdot_animation *a, const char *path);

/* Its parts, for a page with more on it: what stands in <head> (once), the animation (a
 * <section>), and what stands behind the last section. */
void qdot_animation_head(qdot_text *out);
void qdot_animation_section(const qdot_animation *a, qdot_text *out);
void qdot_animation_foot(qdot_text *out);

/* Append `text` to a page, with the characters & < > " written as entities. */
void qdot_animation_escape(qdot_text *out, const char *text);

#endif
