/* usage.h -- what may stand next in a statement, by the usage text of its row.
 *
 * The usage texts that `help` prints are a grammar:
 *
 *     word          a word of the language               tol, method
 *     HOLE          what a person writes                 EXPR, T0..T1, "FILE", F(ARGUMENTS)
 *     [ ... ]       may be left out; several, one directly after the other, come in any order
 *     a|b|c         one of these words or holes
 *     A ... | B     alternatives, within [ ] or of the whole. An alternative that does not begin
 *                   with the statement's word replaces the usage from the last word before the
 *                   first bar: `force F on PARTICLE | at POINT`
 *     X, Y, ...     a list, of X and Y in any order
 *     (X, Y)        as many expressions, in brackets
 *     [| run ...]   the sign, behind which the statement begins again
 *     , : = < > ==  themselves; around `==` the two sides are read as one expression, and a new
 *                   name with its bounds as one: NAME [> 0], LO < NAME < HI
 *
 * Two or more clauses `word HOLE` outside of brackets may come in any order too, with the options
 * among them: `particle NAME mass M at R`;
 * one behind options, `[title TEXT] to "FILE"`, or between an operand and options, `EXPR every DT [to "FILE"]`, too. Each must be there; of alternatives that end them,
 * `angle A | rotation MATRIX`, one. TAB offers them as they are written.
 *
 * Every statement may go on with `for NAME = A..B, ...`, and one that answers with `to "FILE"`.
 *
 * The text is compiled to a small automaton, as a regular expression would be. A hole takes
 * tokens as the language does: a name, number or string directly after a complete operand does
 * not belong to it.
 *
 * Tests  tests/lang/workbench/test_complete.c: every row compiles, and its example follows its usage.
 */
#ifndef QDOT_LANG_USAGE_H
#define QDOT_LANG_USAGE_H

#include "lang/source/token.h"

enum { QDOT_USAGE_NODES = 200, QDOT_USAGE_TEXT = 48 };

/* A node of the automaton for a usage text; `before` is the word that precedes it in that text. */
typedef struct {
    enum {
        QDOT_USAGE_WORD,
        QDOT_USAGE_SIGN,
        QDOT_USAGE_HOLE,
        QDOT_USAGE_FORK,
        QDOT_USAGE_END
    } kind;
    char text[QDOT_USAGE_TEXT], before[QDOT_USAGE_TEXT];
    int next, other; /* indices of the following nodes; other: second branch of a FORK, < 0: none */
    int hole;         /* for HOLE (a placeholder): index of its row in holes.def */
    int alternative;  /* index of the form of the statement to which the node belongs */
    uint64_t enters; /* for FORK: bit of the option that begins at `next`, which may be given once */
    uint64_t needs;   /* for FORK of a required clause: bits of the clauses of which one must be given */
    uint64_t later; /* for FORK of an option among clauses: bits of the clauses after it in the text */
    uint64_t forgets; /* for FORK of a list: bits of the options that each item may have anew */
} qdot_usage_node;

typedef struct {
    const char *word; /* first word of the statement */
    qdot_usage_node node[QDOT_USAGE_NODES];
    int n;
} qdot_usage;

/* Compile; `word` is the statement's, "" where the usage has none. false: too large, or no usage text; nothing may be asked
 * then. */
bool qdot_usage_compile(qdot_usage *u, const char *word, const char *usage);

/* The same with what may follow any statement; answers: `to "FILE"` may follow, too. */
bool qdot_usage_compile_with_end(qdot_usage *u, const char *word, const char *usage, bool answers);

/* Whether the name is a word of the usage. */
bool qdot_usage_has_word(const qdot_usage *u, const char *name);

#endif
