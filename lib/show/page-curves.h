/* page-curves.h -- figures of curves on a page, as SVG.
 *
 * Curves differ in colour, and in dashes or marks too, so that they do on grey paper.
 *
 * Tests  tests/show/test_page-curves.c, tests/script/files/report.sh, tests/script/files/report-runs.sh
 */
#ifndef QDOT_SHOW_PAGE_CURVES_H
#define QDOT_SHOW_PAGE_CURVES_H

#include "base/text.h"

/* A curve: y [n] at equidistant times from t0 to t1; nothing is drawn at NaN. */
typedef struct {
    const char *label; /* name in the legend, which is drawn for two or more curves */
    double t0, t1;
    size_t n;
    const double *y; /* [n] values; borrowed */
} qdot_page_course;

/* Append a figure of courses [n] against t, with the caption `NAME against t`; nothing if they have
 * no finite number. The axis of t runs as the course does, of several from left to right. */
void qdot_page_courses(qdot_text *out, const char *name, size_t n,
                       const qdot_page_course *list);

/* A curve of a figure: points x [n], y [n]. */
typedef struct {
    const char *label;
    size_t n;
    const double *x, *y; /* [n] coordinates; borrowed */
} qdot_page_points;

/* Append a figure of curves [n] with logarithmic axes, a mark at every point; a point that is not
 * above 0 is left out. x, y: what the axes show. */
void qdot_page_log_log(qdot_text *out, const char *caption, const char *x, const char *y,
                       size_t n, const qdot_page_points *list);

#endif
