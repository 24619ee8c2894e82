/* session.h -- a session: its declarations, values, runs and history.
 *
 * A session reads statements from sources (scripts, -e texts, prompt lines) and writes answers to
 * `out`, errors to `err`. All output goes through lang/answer/answer.h, which handles --json and
 * styles.
 */
#ifndef QDOT_LANG_SESSION_H
#define QDOT_LANG_SESSION_H

#include <stdio.h>

#include "expr/print.h"
#include "lang/session/conditions.h"
#include "lang/session/names.h"
#include "lang/session/row-table.h"
#include "lang/session/typed.h"
#include "mech/dynamics/quantity.h"
#include "sim/run/run.h"

/* How a number was obtained from a run, from which its sensitivities are found (lang/slopes/slopes.h). */
typedef enum {
    QDOT_ORIGIN_OTHER, /* of several runs, or of none */
    QDOT_ORIGIN_VALUE, /* e at a time */
    QDOT_ORIGIN_RANGE, /* e over a range: `range`, between ends */
    QDOT_ORIGIN_EVENT  /* the time of an event */
} qdot_origin_kind;

typedef struct {
    qdot_origin_kind kind;
    qdot_range_kind range;
    qdot_expr e, time; /* as they were written, numbers of runs in them as symbols */
    double ends[2];
    qdot_expr said[2]; /* the ends as they were written, nil: those of the run */
    const char *run, *event; /* borrowed, for the statement; run NULL: the latest */
} qdot_origin;

/* A result of a run; in expressions a FORMAL symbol stands for it. */
typedef struct {
    qdot_expr symbol;
    double value, error; /* error NaN: unknown */
    int digits;          /* > 0: of a run with `digits`, whose number is */
    qdot_expr exact;     /* ... this rational; digits 0: nil, or the value that `set` has of it */
    bool plain;          /* without requested digits: a number with --json, not a string */
    qdot_origin origin;
} qdot_measured;

/* a.EXPR within an expression, represented by a FORMAL symbol. */
typedef struct {
    qdot_expr symbol, value;
    char *run;
} qdot_member;

/* A named run; shared by the session and the states that `undo` keeps. */
typedef struct {
    char *name; /* "a", "run1" */
    char *text; /* the statement without its name: "run 0..20 tol 1e-9" */
    qdot_run *run;
    qdot_conditions *conditions; /* that it was made under; NULL: nobody told */
    unsigned *uses;
} qdot_named_run;
void qdot_named_run_release(qdot_named_run *run); /* one use less; the last frees it */

/* Subexpressions of the two sides of a check: each must be defined where the sides are compared. */
typedef struct {
    qdot_vec(qdot_expr) value;
    qdot_vec(qdot_expr) root; /* of powers among them, base and exponent in turn */
    bool spoiled;      /* a function that may take its argument apart (subs) was called */
    unsigned branches; /* open branches of ifs: subexpressions there need not be defined */
} qdot_passed;

/* A parameter or coordinate with a value for the present pass of a loop (lang/session/held). */
typedef struct {
    qdot_expr symbol, value;
    qdot_expr before; /* its value of `set` or `start`; nil: none */
} qdot_held;

/* A start value taken by `start RUN`, and its differences from the ends of both companions
 * (qdot_run_end_apart). */
typedef struct {
    qdot_expr symbol, value;
    double apart[2];
} qdot_start_error;

/* Which output goes to a terminal that shows colours. */
typedef enum { QDOT_COLOURS_ANSWERS = 1, QDOT_COLOURS_ERRORS = 2 } qdot_colours;

typedef struct qdot_session {
    qdot_pool *pool;
    qdot_scene *scene;
    qdot_names *names;
    FILE *out, *err;
    qdot_style style;
    bool flat; /* formulas stand in one line on a terminal too */
    struct qdot_formula_page *page;  /* what answers become a page of, for a file; NULL: none */
    struct qdot_formula_page *block; /* of the present statement: its equations (lang/answer/sheet); NULL: none yet */
    bool json, timing, interactive;
    FILE *console; /* where notices go; NULL: with the answers */
    bool console_json;
    FILE *pages, *screen; /* out is `pages` while answers for the terminal `screen` are collected */
    unsigned colours;     /* qdot_colours */
    bool failed;                 /* the latest text or file stopped at an error */
    bool refuted;                /* a check was refuted: exit 1 at the end */
    size_t verdicts[3];          /* number of checks by qdot_verdict */
    qdot_vec(qdot_expr) history; /* %1 is history.at[0] */
    qdot_vec(qdot_expr) history_over; /* coordinates its entries go by; nil, or shorter: none */
    qdot_expr series, series_in; /* the latest series(...) and the LIST of what it is in, or nil */
    qdot_vec(qdot_measured) measured;
    qdot_vec(qdot_member) members;
    qdot_vec(qdot_expr) set_symbols, set_values; /* values of parameters, the latest */
    qdot_vec(qdot_expr) start_symbols, start_values; /* q or q' -> value */
    qdot_vec(qdot_expr) start_open; /* of these, while `find` changes others: constraints may change them */
    qdot_vec(qdot_expr) scale_symbols, scale_values; /* q, q' or t -> what `scale` said */
    qdot_vec(qdot_start_error) start_errors; /* of the latest `start RUN`; one counts while the start has that value */
    bool start_exactly; /* the latest `start` had `exactly` */
    qdot_vec(qdot_named_run) runs;
    qdot_vec(qdot_row_table *) tables; /* of many runs; shared likewise */
    qdot_kept_studies studies; /* of work and precision, so that a report need not repeat them */
    qdot_vec(
        char *) including; /* files being read, for include cycles and relative paths */
    bool quit;             /* after `quit` */
    bool declares;         /* the present statement declares part of a scene */
    const char *taken;     /* short name of a value that it read (lang/functions/short-names);
                              NULL */
    qdot_vec(char *) told; /* notices that are given once */
    qdot_vec(char *) remarks; /* lines with remarks of files of sessions that were read (lang/declare/session-remarks) */
    unsigned calls;        /* depth of nested function calls */
    bool placed;           /* the present error already names its place in a body */
    qdot_vec(qdot_held) held; /* by the loops under way, innermost last */
    size_t loops;          /* open loops: what they refer to must outlive them */
    qdot_vec(struct qdot_partial_sum) partial_sums; /* of the outermost (language/partial-sum) */
    struct qdot_undo *undo; /* NULL: no statement yet */
    void (*undo_free)(struct qdot_undo *undo); /* set with it */
    qdot_typed typed;      /* the statement under way, and all before it (lang/workbench/statement-count) */
    qdot_passed *passed;   /* while the sides of a check are read; else NULL */
    const char *claim;     /* while it is answered, what it says; else NULL */
} qdot_session;

qdot_session *qdot_session_new(FILE *out, FILE *err); /* NULL: no memory */
void qdot_session_free(qdot_session *session);

/* Add a value to the history: `%` from now on. over: the LIST of coordinates its entries go by, or
 * nil. */
QDOT_MUST_CHECK qdot_status qdot_session_remember(qdot_session *session, qdot_expr value,
                                                  qdot_expr over);
/* From now on the symbol (a parameter, a momentum) or undefined function (applied to formal symbols
 * that stand in `value`) has this value for numbers. *status: QDOT_ENOMEM; unchanged if all is well. */
void qdot_session_set(qdot_session *session, qdot_expr symbol, qdot_expr value,
                      qdot_status *status);
/* Set the value of q or q' with which runs start. */
QDOT_MUST_CHECK qdot_status qdot_session_start(qdot_session *session, qdot_expr jet,
                                               qdot_expr value);
/* Set a parameter's value or a start value, depending on the symbol. */
QDOT_MUST_CHECK qdot_status qdot_session_put(qdot_session *session, qdot_expr symbol,
                                             qdot_expr value);
/* The values of `set` and `start`, saved while others are tried. */
typedef struct {
    qdot_vec(qdot_expr) set_symbols, set_values, start_symbols, start_values;
} qdot_kept_values;
/* Save the values (QDOT_ENOMEM: nothing is saved); _restore puts them back and frees the copy. */
QDOT_MUST_CHECK qdot_status qdot_session_keep_values(const qdot_session *session,
                                                     qdot_kept_values *kept);
void qdot_session_restore_values(qdot_session *session, qdot_kept_values *kept);
/* Append the path of a file that is read, `name` as the present script says it: "dir/other.lag" for
 * "other.lag" in "dir/this.lag". */
void qdot_session_path(const qdot_session *session, const char *name, qdot_text *path);
/* Exchange everything that `reset` clears; what does not belong to a scene stays: style, files ... */
void qdot_session_exchange(qdot_session *session, qdot_session *other);

#endif
