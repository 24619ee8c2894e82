/* export-writer.h -- a file of source text while it is written. Internal to show/.
 *
 * export.c names what a tape reads and follows the template; export-motion.c writes what the words of
 * a motion's template stand for.
 */
#ifndef QDOT_SHOW_EXPORT_WRITER_H
#define QDOT_SHOW_EXPORT_WRITER_H

#include "show/export-language.h"

typedef struct qdot_export_writer {
    const qdot_export_language *language;
    const qdot_export_system *system;    /* the motion to be exported; NULL: an expression is */
    const qdot_export_expression *value; /* the expression to be exported; NULL: a motion is */
    size_t inputs;
    char **words;   /* [inputs] names of the inputs in the language */
    char **sources; /* [inputs] expressions from which the inputs are read; NULL: they are arguments of the function */
    char *name;     /* name of the function or the group of functions */
    char temporary[16];
    qdot_export_tables tables;
    qdot_text *out;
} qdot_export_writer;

/* The index of the first parameter among the inputs of a motion's tape. */
static inline size_t
qdot_export_first_parameter(const qdot_export_system *x)
{
    return 1 + 3 * x->n + x->m;
}

/* Write the statements of a function, each line after `indent`; the targets are as in qdot_export_frame. */
QDOT_MUST_CHECK qdot_status qdot_export_write_code(qdot_export_writer *w,
                                                   const qdot_export_function *f,
                                                   const char *indent, const char *const *targets);
/* Write a number; NaN in the syntax of the language. */
void qdot_export_write_number(const qdot_export_writer *w, double x);

/* Write n > 0 numbers, four in a line. */
void qdot_export_write_numbers(qdot_export_writer *w, size_t n, const double *x, const char *indent);

/* Write the text that replaces a word of a motion's template. */
QDOT_MUST_CHECK qdot_status qdot_export_motion_word(qdot_export_writer *w, const char *word,
                                                    const char *indent);
/* Whether a motion has what a letter of a template's line requires (export-language.h). */
bool qdot_export_motion_has(const qdot_export_system *x, char what);
/* Whether a tape (may be NULL) contains one of the operations from first to last. */
bool qdot_export_tape_uses(const qdot_tape *tape, qdot_op first, qdot_op last);

#endif
