/* qdot.h -- the public interface of libqdot: Lagrangian mechanics for C, C++ and others.
 *
 *     qdot_system *s;
 *     qdot_motion *m;
 *     double t[2] = {1, 2}, theta[2], error[2];
 *
 *     qdot_system_new(&s);
 *     qdot_system_declare(s, "coord theta\n"
 *                            "particle bob mass 1 at (sin(theta), -cos(theta))\n"
 *                            "gravity (0, -9.81)\n"
 *                            "start theta = 2");
 *     qdot_system_run(s, "0..10 tol 1e-12", &m);
 *     qdot_motion_values(m, "theta", 2, t, 1, theta, error);
 *
 * A system holds what has been declared; a motion is one run of it. Scenes, expressions and options are
 * text in the language of the program `qdot`, which its manual describes: `info qdot`.
 *
 * Results   Every function that can fail returns a qdot_result; 0 is success. On failure outputs are
 *           unspecified unless stated otherwise, and qdot_system_error() says what went wrong.
 * Units     Numbers have the units that the scene is written in; angles are in radians.
 * Text      UTF-8, ended by a NUL. A `const char *` that a function returns is borrowed: do not free
 *           it. A `char **` receives a string of the caller's: free it with qdot_string_free().
 * Threads   Two threads may use two systems at the same time. One system and its motions must not be
 *           used by two threads at the same time; only qdot_system_interrupt() may be called by any.
 *           qdot_interrupt_set() concerns all systems.
 * Process   The library never exits, prints or installs a signal handler. It reads and writes files only
 *           where a statement says so (`include`, `to "FILE"`, `save`); `plot` starts gnuplot. It expects
 *           the numeric locale to be that of C (LC_NUMERIC) and turns GSL's error handler off. Exact
 *           computations run on a thread of the library's, and while they do GMP's and FLINT's memory
 *           functions are the library's: other threads must not use GMP with memory functions of their
 *           own. Do not unload the library, nor use it in a child after fork().
 */
#ifndef QDOT_H
#define QDOT_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* --- results of calls ----------------------------------------------------------------- */

typedef enum {
    QDOT_RESULT_OK = 0,
    QDOT_RESULT_INVALID = 1,     /* an argument that makes no sense: NULL, a count that does not fit */
    QDOT_RESULT_SYNTAX = 2,      /* text that is not in the language */
    QDOT_RESULT_NAME = 3,        /* a name that is unknown, or taken */
    QDOT_RESULT_TYPE = 4,        /* a vector where a number belongs, wrong dimensions */
    QDOT_RESULT_DOMAIN = 5, /* a value that is undefined: 1/0, log 0, a time outside the motion */
    QDOT_RESULT_UNSET = 6,       /* a parameter or function without a value */
    QDOT_RESULT_SINGULAR = 7,    /* a matrix without an inverse */
    QDOT_RESULT_LIMIT = 8,       /* larger than a stated limit of work or size */
    QDOT_RESULT_FAILED = 9,      /* a numerical method gave up; the message says where and why */
    QDOT_RESULT_NOT_BUILT = 10,  /* a word of the language that this version does not carry out */
    QDOT_RESULT_IO = 11,         /* a file or pipe cannot be read or written */
    QDOT_RESULT_NO_MEMORY = 12,
    QDOT_RESULT_INTERRUPTED = 13 /* interrupted by qdot_interrupt_set() or qdot_system_interrupt() */
} qdot_result;

/* A result code in a few words, such as "unknown or taken name"; never NULL. */
const char *qdot_result_text(qdot_result result);

/* The version of the library, such as "0.1.0". */
const char *qdot_version(void);

/* Free a string that a function returned through a `char **`; NULL is allowed. */
void qdot_string_free(char *text);

/* Stop the computation under way, in whatever thread: it returns QDOT_RESULT_INTERRUPTED. If there is
 * none, the next one returns so. May be called from a signal handler. */
void qdot_interrupt_set(void);

/* --- creating and asking systems ------------------------------------------------------ */

typedef struct qdot_system qdot_system;

/* The notations in which formulas are written. MathML: only the contents of the element <math>. */
typedef enum {
    QDOT_NOTATION_PLAIN = 0, /* the language itself: 1/2*m*r'^2 */
    QDOT_NOTATION_UNICODE = 1,
    QDOT_NOTATION_LATEX = 2,
    QDOT_NOTATION_MATHML = 3,
    QDOT_NOTATION_JSON = 4,   /* qdot_system_ask() only: one object a line, as of `qdot --json` */
    QDOT_NOTATION_DISPLAY = 5, /* qdot_system_ask() only: such objects, for a program that shows them */
    QDOT_NOTATION_TREE = 6 /* qdot_system_derive() only: an array of JSON, for a program that computes */
} qdot_notation;

typedef enum {
    QDOT_TRUTH_PROVED = 0,
    QDOT_TRUTH_REFUTED = 1,
    QDOT_TRUTH_UNDECIDED = 2
} qdot_truth;

/* Make *system an empty system, owned by the caller. Errors: NO_MEMORY, INVALID; *system is then NULL. */
qdot_result qdot_system_new(qdot_system **system);

/* Free the system; NULL is allowed. Its motions stay usable: what they need of it is freed with the
 * last of them. */
void qdot_system_free(qdot_system *system);

/* Stop the computation of this system, which returns QDOT_RESULT_INTERRUPTED; other systems go on. If none
 * is under way, nothing happens. May be called from another thread while the system is in use, or from a
 * signal handler; not after qdot_system_free(). NULL is allowed. */
void qdot_system_interrupt(qdot_system *system);

/* Called in the computing thread when a run, sweep or other integration has lasted half a second, then a few
 * times a second: what is computed ("run", borrowed), the part that is done, 0..1, and the seconds that are
 * left by estimate (NaN: not known yet). It may call qdot_system_interrupt() and functions of other systems,
 * none else of this one. Derivations tell nothing. */
typedef void (*qdot_progress_hook)(void *data, const char *what, double done, double left);

/* Set the hook of this system; NULL: none. */
qdot_result qdot_system_progress(qdot_system *system, qdot_progress_hook hook, void *data);

/* Whether `undo` reaches back over calls, as it does at the prompt, or only to the beginning of its own call
 * (kept = 0, as it is at first). What it needs for that takes 256 MB at most. A qdot_system_run() and the end of its
 * motion are no statements: those before them can no longer be undone. */
void qdot_system_keep_undo(qdot_system *system, int kept);

/* What errors call the text of a later qdot_system_ask(), and the place of what it declares: with "In[3]", "`x` was declared as a
 * coordinate at In[3]:2" names a cell of a notebook. The name is copied; NULL: `ask`, as at first. Errors: NO_MEMORY, INVALID. */
qdot_result qdot_system_source(qdot_system *system, const char *name);

/* What went wrong in the last call on the system or one of its motions; "" if it succeeded. The first
 * line is "CALL:LINE:COLUMN: error: ..." where a text is to blame, CALL being `declare`, `ask`,
 * `derive`, `decide`, `number`, `run`, `motion`, `table`, `values`, `over`, `compile` or `variables`, or what
 * qdot_system_source() has named; then come the
 * line, a caret below the place and often a hint. Borrowed until the next such call. */
const char *qdot_system_error(const qdot_system *system);

/* What should be known of the last call although it succeeded, a line each: "notice: ...";
 * "" if there is nothing. Borrowed until the next such call. */
const char *qdot_system_notices(const qdot_system *system);

/* Carry out statements: coordinates, particles, forces, constraints, `set`, `start`, ... Their answers
 * are not kept. The first statement that fails ends the call; those before it stay in effect. `undo`
 * reaches back to the beginning of the call (but see qdot_system_keep_undo). */
qdot_result qdot_system_declare(qdot_system *system, const char *text);

/* The same, with the answers as the program prints them. *answers: the caller's; after a failure the
 * answers up to there, or NULL.
 *
 * In QDOT_NOTATION_DISPLAY each line is a JSON object. Besides the fields of `qdot --json`, which are for programs,
 * each kind with something to read has
 *     "text"     what the prompt prints, one or several lines, formulas in Unicode
 *     "html"     the same as a part of a page: text escaped, formulas in MathML, classes and no style
 *     "typeset"  expr, number, numbers: an object with the line `name = value ± error [unit]` in "latex" (for
 *                mathematics mode), "mathml" (an element <math>) and "unicode"
 *     "cells"    columns, row, unit: the cells of the row as texts, numbers with their errors: "1.25 ± 3e-13"
 * These are rounded and worded; a program that shows answers places one of them and does nothing more. "html" is
 *     expr, number, numbers   <math>, a table of equations where the formula is longer than a line
 *     check                   <div class="check">, besides with the class "holds", "fails" or "undecided"
 *     run                     <table class="run">: the end state with errors, and what is known of the run
 *     columns                 <tr> with <th>;  row, unit  <tr> with <td>: to be put into a <table>; a row that failed has
 *                             a cell more, with the reason; cells of words have the class "words"
 *     text                    <p>, <h2>, <math> where formulas stand in it, as in those of `derive`; else <pre class="text">
 *     notice, error, file     <pre> with that class
 * which looks as it should within an element of the class "qdot" on a page with qdot_display_style(). An expr has
 * "mathml", too (as of that notation).
 *
 * What would be shown in a window or go to a file that no statement names is
 *     {"kind":"figure","mime":"image/svg+xml","name":"theta","data":"<svg ..."}
 * and `animate` and `report` need no file; then they give
 *     {"kind":"page","mime":"text/html","name":"run1","data":"<!DOCTYPE html>..."}
 * Each object has "statement", a number that counts over all calls, and "line" of the text. Notices are objects among
 * the answers, so qdot_system_notices() is empty; the error of a failed text is the last object. */
qdot_result qdot_system_ask(qdot_system *system, const char *text, qdot_notation notation,
                            char **answers);

/* How the classes of "html" look, as CSS; never NULL. */
const char *qdot_display_style(void);

/* A number as answers have it: "1.25 ± 3e-13", with the digits that its error leaves; error 0: exact, NaN: unknown.
 * *text: the caller's. INVALID: NULL. NO_MEMORY. */
qdot_result qdot_number_write(double value, double error, char **text);

/* The value of one expression: "T", "eom", "H", "diff(L, theta)", "accel[x]". A list is written with a
 * member a line. *formula: the caller's, NULL on failure. TYPE: numbers of a run stand in it.
 *
 * QDOT_NOTATION_TREE is exact, an array of JSON in prefix form:
 *     "3", ["/","1","3"]                  numbers, in decimal digits
 *     "m", "theta[1]", "pi", "t"          names; ["'","theta",1] is theta', ["p","theta"] its momentum
 *     ["+",a,b,...]  ["*",a,b,...]  ["^",a,b]  ["sin",a]  ["atan2",a,b]
 *     ["=",a,b]  ["<",a,b]  ["<=",a,b]  ["and",a,...]  ["or",a,...]  ["not",a]  "true"  "false"
 *     ["if",condition,a,condition,b,...,else]
 *     ["list",a,...]  ["vector",a,b,...]  ["matrix",[a,b],[c,d]]
 *     ["integral",f,"x",a,b], without ends a function of x with the derivative f; "infinity"
 *     ["apply","f","x"], an undefined function; its derivative ["diff",["apply","f","x"],"x"], in general
 *     ["D",[1,0],"f",a,b], by the first argument
 *     ["delta","theta"]  ["d","theta"]  ["wedge",["d","r"],["d","phi"]]  ["unit","kg"] */
qdot_result qdot_system_derive(qdot_system *system, const char *expression, qdot_notation notation,
                               char **formula);

/* Whether a claim holds: what may stand behind `check`, "T == 1/2*m*v^2", "conserved energy",
 * "A < B when x > 0". Undecided is a success: there is neither a proof nor a counterexample. */
qdot_result qdot_system_decide(qdot_system *system, const char *claim, qdot_truth *truth);

/* The number that a scalar expression is, with the present values of parameters. *error (may be NULL):
 * what it may be off by where numbers of a run stand in it; 0: exact but for rounding; NaN: unknown. */
qdot_result qdot_system_number(qdot_system *system, const char *expression, double *value,
                               double *error);

/* --- texts that are being typed --------------------------------------------------------- */

/* The words that may stand where the text is being typed: they complete the word that begins at byte *start and
 * ends at byte `cursor` <= strlen(text). *words: the caller's; one a line, sorted, "" if there are none. What
 * stands in `text` is not carried out: names declared in it are not known. INVALID: no such byte. */
qdot_result qdot_system_complete(qdot_system *system, const char *text, size_t cursor, size_t *start,
                                 char **words);

/* What the word at byte `cursor` <= strlen(text) is, or the one that ends there: of a word of the language how it
 * is used, of a name its declaration; "" if nothing is known. *explanation: the caller's. PLAIN, UNICODE, LATEX:
 * lines of text, in which a formula is in that notation; JSON: an object with those of the fields that are known,
 *     "word", "from", "to" (bytes of the text), "kind" ("statement", "option", "quantity", "function", "name",
 *     "label", "run", "topic"), "usage", "text", "example", "formula" (LaTeX), "dimension", "file", "line", "column"
 * Quantities of the scene have a formula only if it comes at once: T, V, L, eom, p[q] ... in scenes of up to 8
 * coordinates. The text is not carried out. INVALID: no such byte, another notation. */
qdot_result qdot_system_explain(qdot_system *system, const char *text, size_t cursor, qdot_notation notation,
                                char **explanation);

/* 1 if the text cannot be a whole yet, because a bracket is open or its last line ends in a backslash; else 0. */
int qdot_text_unfinished(const char *text);

/* What a byte of a text belongs to, for colours. */
typedef enum {
    QDOT_LEXEME_PLAIN = 0,
    QDOT_LEXEME_WORD = 1,  /* the word of a statement, or of an option in its place */
    QDOT_LEXEME_NAME = 2,  /* a declared name or label, a value or function of the language */
    QDOT_LEXEME_NUMBER = 3,
    QDOT_LEXEME_STRING = 4,
    QDOT_LEXEME_COMMENT = 5,
    QDOT_LEXEME_WRONG = 6  /* a closing bracket without an opening one, a character without meaning */
} qdot_lexeme;

/* A qdot_lexeme for each byte of the text [length], into kinds [length]. Names are those of the system; the text
 * is not carried out. */
qdot_result qdot_system_highlight(qdot_system *system, const char *text, size_t length,
                                  unsigned char *kinds);

/* --- functions of many values ----------------------------------------------------------- */

typedef struct qdot_function qdot_function;

/* Compile expressions, "T, V" or "[theta', accel[theta]]", as functions of variables such as
 * "theta, theta', t": coordinates, velocities, parameters, t, momenta p[theta]; a parameter among them is one,
 * also if it has a value, others have that which they have now. Components of vectors, entries of matrices (row
 * by row) and members of lists are outputs of their own. *function: the caller's, NULL on failure.
 * UNSET: a symbol that has no value and is no variable. TYPE: equations; a variable that is none. */
qdot_result qdot_system_compile(qdot_system *system, const char *expressions, const char *variables,
                                qdot_function **function);

/* Free a function; NULL is allowed. It may outlive its system, and be freed in another thread. */
void qdot_function_free(qdot_function *function);

/* The numbers of variables and of outputs. */
size_t qdot_function_inputs(const qdot_function *function);
size_t qdot_function_outputs(const qdot_function *function);

/* The values at n points: inputs [n][qdot_function_inputs], outputs [n][qdot_function_outputs], row by row, which
 * may not overlap. NaN: undefined, or larger than a double can be. Rounding errors are those of doubles: nothing is
 * estimated. Threads may use one function at the same time. INVALID, NO_MEMORY. */
qdot_result qdot_function_values(const qdot_function *function, size_t n, const double *inputs, double *outputs);

/* --- tables ------------------------------------------------------------------------------ */

typedef struct qdot_table qdot_table;

/* A copy of a table that the system has by name: the rows of `sweep`, `poincare`, `continue` (`branches`), `fit`
 * (`residuals`). name NULL: the one that was made last. *table: the caller's, NULL on failure; it may outlive
 * its system. NAME: there is no such table. */
qdot_result qdot_system_table(qdot_system *system, const char *name, qdot_table **table);

/* Free a table; NULL is allowed. */
void qdot_table_free(qdot_table *table);

/* The numbers of rows and of columns. */
size_t qdot_table_rows(const qdot_table *table);
size_t qdot_table_columns(const qdot_table *table);

/* The name of column i, as "max(theta)", and the unit of its numbers, as "m/s", "" if none. Borrowed from the
 * table, like all below; NULL for a column that is not there. */
const char *qdot_table_column_name(const qdot_table *table, size_t i);
const char *qdot_table_column_unit(const qdot_table *table, size_t i);

/* The numbers of column i [rows], NaN: none, as in a row that failed; and their errors [rows], estimated,
 * absolute, 0: exact, NaN: unknown. NULL: a column of text. */
const double *qdot_table_numbers(const qdot_table *table, size_t i);
const double *qdot_table_errors(const qdot_table *table, size_t i);

/* A cell of a column of text, "" if it is empty: why the row failed, or the kind of a point. NULL: a column of
 * numbers, or there is no such cell. */
const char *qdot_table_cell(const qdot_table *table, size_t i, size_t row);

/* --- making and reading motions ------------------------------------------------------- */

typedef struct qdot_motion qdot_motion;

/* Integrate: what may stand behind `run`, "0..10", "0..10 tol 1e-9 method dop853 with m = 2". A run
 * named by `as NAME` stays in the system under that name when its motion is freed; any other goes with
 * it. *motion: the caller's. FAILED, INTERRUPTED: *motion is the motion so far, NULL if there is none;
 * any other error: NULL. */
qdot_result qdot_system_run(qdot_system *system, const char *text, qdot_motion **motion);

/* A run that the system has by this name, made by a statement: `run 0..20 as a`, or `run1`, ... without a name.
 * name NULL: the latest. The run stays in the system when its motion is freed. *motion: the caller's, NULL on
 * failure. NAME: there is no such run. */
qdot_result qdot_system_motion(qdot_system *system, const char *name, qdot_motion **motion);

/* Free a motion; NULL is allowed. */
void qdot_motion_free(qdot_motion *motion);

/* The system to which the motion belongs, for qdot_system_error(); borrowed. */
const qdot_system *qdot_motion_system(const qdot_motion *motion);

typedef struct {
    double start, end; /* times of the first and last state; the end may be earlier than requested */
    double tolerance;
    double error;            /* of the state at the end: the largest of its components relative to
                                max(1, |value|); estimated; NaN: unknown */
    double horizon;          /* time after which no digit of the state is reliable; NaN: none */
    double energy_drift; /* max |h - h0| / max(1, |h0|), h the energy; NaN: h is not conserved */
    double constraint_drift; /* the largest |f| of the constraints f = 0; NaN: there are none */
    double cpu;              /* CPU seconds of the integration alone */
    size_t steps, rejected, evaluations;
    const char *method; /* name of the integration method, such as "taylor"; borrowed from the motion, like the next two */
    const char *reason;      /* why the integration ended before the requested time; NULL: it did not */
    const char *doubt; /* why the error of the motion is unknown; NULL: it is known, or no reason can be given */
} qdot_motion_summary;

/* Fill in *summary; pass sizeof *summary as `size`, so that later versions may have more members. */
qdot_result qdot_motion_summarize(const qdot_motion *motion, qdot_motion_summary *summary, size_t size);

/* The number n of coordinates; the name of the i-th, i < n, borrowed from the motion, else NULL.
 * Parameters that events set stand behind the coordinates. */
size_t qdot_motion_coordinates(const qdot_motion *motion);
const char *qdot_motion_coordinate(const qdot_motion *motion, size_t i);

/* The state at the end: coordinates q [n], velocities v [n]; either may be NULL. INVALID where n is not
 * that of the coordinates. */
qdot_result qdot_motion_end(const qdot_motion *motion, size_t n, double *q, double *v);

/* An expression in coordinates, velocities, accelerations, t and parameters at times [n], in any order.
 *
 *   k       components of the expression: 1 for a scalar, 3 for "[theta, theta', energy]"
 *   values  [n][k] row by row
 *   errors  [n][k], estimated, absolute; NaN: unknown; NULL: not wanted
 *
 * Parameters have the values of the run. A quantity of the scene, such as energy, is that of the scene as it is now:
 * if that has changed since the run was made, qdot_system_notices() says so. TYPE: the expression has not k components. DOMAIN: a time
 * outside the motion. NAME: the run is no longer in the system, because of `reset`, `remove` or a later
 * run of its name. */
qdot_result qdot_motion_values(qdot_motion *motion, const char *expression, size_t n,
                               const double *times, size_t k, double *values, double *errors);

typedef enum {
    QDOT_OVER_MAX = 0,
    QDOT_OVER_MIN = 1,
    QDOT_OVER_MEAN = 2, /* mean of the expression over time */
    QDOT_OVER_DRIFT = 3 /* max |e - e0| / max(1, |e0|), where e0 is the value of the expression e at that of the
                           two times to which the motion comes first */
} qdot_over;

/* The largest or least value of a scalar expression between two times of the motion in any order, its mean or its
 * drift, with its error; error may be NULL. Extrema between steps are found. Errors as above. */
qdot_result qdot_motion_over(qdot_motion *motion, qdot_over what, const char *expression, double from,
                             double to, double *value, double *error);

/* The times at which the integration steps end, [*n] in the order of the run; borrowed from the motion. */
const double *qdot_motion_steps(const qdot_motion *motion, size_t *n);

/* *n: how many events occurred; the i-th in the order of the run: its name (borrowed), time, the error of
 * the time (NaN: unknown) and way (1 rising, -1 falling, 0 it touched). Outputs of the second may be
 * NULL. NAME: the run is no longer in the system, as above. */
qdot_result qdot_motion_events(qdot_motion *motion, size_t *n);
qdot_result qdot_motion_event(qdot_motion *motion, size_t i, const char **name, double *t,
                              double *error, int *way);

/* How many quantities are known to be conserved; the i-th: its name (borrowed), its value at the start
 * and its drift as above. Any output may be NULL. */
size_t qdot_motion_conserved(const qdot_motion *motion);
qdot_result qdot_motion_drift(const qdot_motion *motion, size_t i, const char **name, double *start,
                              double *drift);

#ifdef __cplusplus
}
#endif

#endif
