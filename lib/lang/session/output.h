/* output.h -- where answers go, and in what form.
 *
 * Answers go to `out`, errors to `err`; both are written through lang/answer/write.h, which
 * handles --json and styles.
 */
#ifndef QDOT_LANG_OUTPUT_H
#define QDOT_LANG_OUTPUT_H

#include <stdio.h>

#include "expr/print-name.h"
#include "lang/session/parts.h"

/* The kinds of output that are coloured on a terminal. */
typedef enum { QDOT_COLOURS_ANSWERS = 1, QDOT_COLOURS_ERRORS = 2 } qdot_colours;

typedef struct qdot_output {
    FILE *out, *err;
    qdot_style style;
    bool flat; /* formulas are written on one line, also on a terminal */
    struct qdot_formula_page *page;  /* page that collects answers for a file; NULL: none */
    struct qdot_formula_page *block; /* page with the present statement's equations (lang/answer/sheet); NULL: none yet */
    const char *unit; /* unit of the present answer, as "m/s"; NULL: none is written */
    char *const *units; /* units of the numbers of the present answer, where these differ; each NULL: none; NULL: one unit for all */
    bool json, timing;
    bool display; /* with `json`: figures and pages without a file are answers, and formulas are also in MathML */
    FILE *console; /* the stream of notices; NULL: the same as that of answers */
    bool console_json;
    FILE *pages, *screen; /* `out` is `pages` while answers to the terminal `screen` are collected */
    unsigned colours;     /* bits qdot_colours: streams that show colours */
} qdot_output;

#endif
