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
    bool flat; /* formulas stand in one line on a terminal too */
    struct qdot_formula_page *page;  /* what answers become a page of, for a file; NULL: none */
    struct qdot_formula_page *block; /* of the present statement: its equations (lang/answer/sheet); NULL: none yet */
    bool json, timing;
    FILE *console; /* where notices go; NULL: with the answers */
    bool console_json;
    FILE *pages, *screen; /* out is `pages` while answers for the terminal `screen` are collected */
    unsigned colours;     /* qdot_colours */
} qdot_output;

#endif
