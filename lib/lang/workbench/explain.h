/* explain.h -- what stands at a place of a text: help on a word of the language, what a name of the session means.
 *
 * The text is not carried out: its names are those that the session knows already.
 *
 * Tests  tests/lang/workbench/test_explain.c, tests/api/test_typing.c
 */
#ifndef QDOT_LANG_EXPLAIN_H
#define QDOT_LANG_EXPLAIN_H

#include "base/text.h"
#include "expr/print-name.h"
#include "lang/session/parts.h"

typedef enum {
    QDOT_EXPLAINED_NOTHING, /* a number, a sign, a comment, an unknown name */
    QDOT_EXPLAINED_STATEMENT,
    QDOT_EXPLAINED_OPTION,   /* a word within a statement, as `tol` in run 0..1 tol 1e-9 */
    QDOT_EXPLAINED_QUANTITY, /* a value of the scene, as T or eom[theta] */
    QDOT_EXPLAINED_FUNCTION, /* a function of the language */
    QDOT_EXPLAINED_NAME,     /* declared or defined by the user */
    QDOT_EXPLAINED_LABEL,    /* of a particle, body, constraint, force ... */
    QDOT_EXPLAINED_RUN,
    QDOT_EXPLAINED_TOPIC     /* another word of the language: pi, t, a method */
} qdot_explained_kind;

/* Start with {0}; free with qdot_explained_clear. A text that is empty is not known, or makes no sense for the word. */
typedef struct {
    qdot_explained_kind kind;
    size_t from, to;    /* bytes [from, to) of the text */
    qdot_text word;     /* as the language spells it: "theta1", "eom[theta]" */
    qdot_text usage;    /* how it is written, "sin(x)"; of a name the statement that declares it, "param m > 0 = 2" */
    qdot_text sentence; /* what it is or does */
    qdot_text example;
    qdot_expr value;    /* the expression that it stands for; nil: none */
    qdot_text formula;  /* that expression in the style that was asked for */
    qdot_text dimension; /* "a length [m]", where units are used */
    const char *file;   /* where a name was declared: borrowed from the session; NULL: not known */
    uint32_t line, column;
} qdot_explained;

/* Explain the word at byte `cursor` of the text [length], or the one that ends there. Quantities that follow by
 * differentiation alone have their formula in scenes of at most QDOT_EXPLAINED_COORDINATES coordinates: no more, so that
 * an answer comes at once. Errors: QDOT_ENOMEM, QDOT_EINTR; a text that cannot be read is none. */
enum { QDOT_EXPLAINED_COORDINATES = 8 };
QDOT_MUST_CHECK qdot_status qdot_explain(qdot_session *session, const char *text, size_t length, size_t cursor,
                                         qdot_style style, qdot_explained *out);
void qdot_explained_clear(qdot_explained *explained);

/* The kind in a word: "statement", "option", ...; "" of NOTHING. */
const char *qdot_explained_kind_word(qdot_explained_kind kind);

/* Append all that is known as lines of text; nothing for NOTHING. */
void qdot_explained_print(const qdot_explained *explained, qdot_text *out);

/* Append an object of JSON with its fields "word", "from", "to", "kind", "usage", "text", "formula", "dimension",
 * "example", "file", "line", "column"; those that are not known are left out. */
void qdot_explained_json(const qdot_explained *explained, qdot_text *out);

#endif
