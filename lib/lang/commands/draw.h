/* draw.h -- expressions along runs, for tables (draw.c) and curves (plot.c). */
#ifndef QDOT_LANG_DRAW_H
#define QDOT_LANG_DRAW_H

#include "lang/commands/number.h"
#include "show/show.h"

typedef struct {
    char *label;                 /* the source text; owned */
    qdot_session *session;
    qdot_run *run;               /* NULL: the latest */
    bool mixed;                  /* of several runs: `run` is the first of them */
    bool vector;                 /* a path */
    qdot_number_columns columns; /* its components */
} qdot_draw_operand;

typedef qdot_vec(qdot_draw_operand) qdot_draw_operands;

void qdot_draw_free(qdot_draw_operands *list);
/* `E1, a.E2, ...` */
QDOT_MUST_CHECK qdot_status qdot_draw_read(qdot_cursor *c, qdot_draw_operands *list);
/* The latest run for those that name none; QDOT_EINVAL where there is none. */
QDOT_MUST_CHECK qdot_status qdot_draw_runs(qdot_session *session,
                                           qdot_draw_operands *list);
/* Along its run at times [rows]: values [components * rows], component by component. */
QDOT_MUST_CHECK qdot_status qdot_draw_values(const qdot_draw_operand *o, size_t rows,
                                             const double *times, double *values);
/* A figure to a file; path NULL: into a window where there is one, else NAME-1.svg beside
 * the script. */
QDOT_MUST_CHECK qdot_status qdot_draw_show(qdot_session *session,
                                           const qdot_figure *figure, const char *path);
/* The quoted name behind `to`. */
QDOT_MUST_CHECK qdot_status qdot_draw_read_file(qdot_cursor *c, const char **path);

#endif
