/* export-language.h -- what the writer of exports knows of a language. Internal to show/.
 *
 * A template (export-LANGUAGE.template for a motion) is the source text of an export with $words$
 * to be replaced. A line that begins with `?x ` is left out unless the system has x, one that begins
 * with `!x ` if it has:
 *
 *     c constraints   p constraints without accelerations   e events, d events that set something
 *     k parameters   h conditions (if)   f erf or erfc   g operations that may be undefined
 *     s surfaces at which the equations switch, l T - V among what does   w events or surfaces
 *     a events, b what events set depend on accelerations or multipliers   j a Jacobian
 */
#ifndef QDOT_SHOW_EXPORT_LANGUAGE_H
#define QDOT_SHOW_EXPORT_LANGUAGE_H

#include "base/text.h"
#include "show/export-parts.h"
#include "show/export-tables.h"
#include "tape/instruction.h"

struct qdot_export_language {
    const char *comment; /* characters that begin a comment line */
    bool exact_name;     /* the file name must be a valid name in the programming language */
    const char *reserved; /* words that cannot be names beside those in `operation`, a blank before and after each */
    const char *nan;     /* the language's expression for a missing value */

    /* printf formats that define a named number and a named truth value, from name and value */
    const char *number, *truth;
    /* printf formats: element %zu of y, q'', lambda, the sides of a condition; a parameter by its name */
    const char *state, *acceleration, *multiplier, *parameter, *side;
    /* printf: an element of an array (array, index), (array, row, column); entry NULL: rows are one
     * behind the other. */
    const char *element, *entry;
    size_t first; /* index of an array's first element: 0 or 1 */
    const char *vector_shape, *matrix_shape; /* printf formats of array shapes: (rows), (rows, columns) */
    const char *result; /* printf format that returns a function's single number */
    const char *separator; /* separates the elements of a list in brackets */

    /* printf format of a declared parameter, from name, value and plain name */
    const char *declared;
    /* printf formats of an argument of an expression (name), and of one with a value (name, value) */
    const char *argument, *argument_value, *no_argument;
    /* printf format: a statement that refuses a parameter without a value (name, plain name) */
    const char *check;
    /* the beginning and end of a matrix row; the end of a line that is continued */
    const char *row_begin, *row_end, *line_end;
    /* texts before (printf format with an index) and after the statements of an event that changes something */
    const char *effect_begin, *effect_end;

    /* Operations as text that stands for itself within others (export-languages.def).
     * NULL: + - * / and what is made of them. */
    const char *operation[QDOT_OP_COUNT];

    /* Tables of data (export-tables.h): texts before (printf of the name) and after the numbers of one; the functions that read
     * them, and the one that finds the next knot of a motion. */
    const char *table_begin, *table_end, *table_functions, *knot_function;

    /* templates of files: for a motion (in two parts; motion NULL: in one), for an expression, for several expressions */
    const char *system, *motion, *value, *values;
};

/* The statements that compute a function. `words` [inputs] name the inputs of the tape, `sources`
 * say where they come from (NULL: they are there). targets, if not NULL, [outputs]: the statements
 * (printf of the value) that use the outputs, instead of the blocks. Each line begins with `indent`.
 * temporary: what the names of intermediate values begin with. */
typedef struct {
    const qdot_export_language *language;
    const char *const *words, *const *sources;
    const char *indent, *temporary;
    const char *const *targets;
    const qdot_export_tables *tables;
} qdot_export_frame;

/* Write the source text of a file in the language. Errors: QDOT_EINVAL (a constant is not finite), QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_export_code(const qdot_export_frame *frame,
                                             const qdot_export_function *function,
                                             qdot_text *out);

/* Append the shortest decimal number with a decimal point that reads back as x. */
void qdot_export_number(double x, qdot_text *out);

#endif
